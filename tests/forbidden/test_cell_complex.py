"""The cell complex: closed surfaces, checked by arithmetic that shares nothing with the gluing."""

from __future__ import annotations

import contextlib
import math
import signal
import time
from fractions import Fraction
from itertools import pairwise, product
from pathlib import Path

import numpy as np
import pytest

import fuzz
from cfree import Boundary, Scene, boundary, load_scene
from cfree.forbidden.cell_complex import CellComplex, glue
from cfree.forbidden.record import glue_by
from compared import scene_of, turned
from examples import POLYGONS
from shapes import KINDS, PlainScene, box, random_scene

ROOT = Path(__file__).parents[2]
SMALL = [path for path in POLYGONS if path.stat().st_size < 20_000]
CASES = sorted((ROOT / "tests/cases").glob("*.json"))


def check(result: Boundary) -> CellComplex:
    """All that must hold of a closed, oriented cell complex."""
    cells = result.complex
    count = len(cells.twin)
    coedges = np.arange(count)
    assert np.array_equal(cells.twin[cells.twin], coedges) and np.all(cells.twin != coedges)
    assert len(cells.first) == len(result.trapezoids) + 1 and np.array_equal(
        cells.face, np.repeat(np.arange(len(result.trapezoids)), np.diff(cells.first))
    )
    after = coedges + 1
    after[cells.first[1:][np.diff(cells.first) > 0] - 1] = cells.first[:-1][np.diff(cells.first) > 0]
    # a twin runs the other way, along the same edge
    assert np.array_equal(cells.vertex[cells.twin], cells.vertex[after])
    assert np.array_equal(cells.edge[cells.twin], cells.edge)
    assert np.array_equal(cells.component[cells.face[cells.twin]], cells.component[cells.face])
    assert set(np.unique(cells.vertex)) == set(range(cells.vertices))
    assert set(np.unique(cells.edge)) == set(range(cells.edges))
    assert set(np.unique(cells.component)) == set(range(cells.components))
    assert np.all(cells.euler % 2 == 0) and np.all(cells.euler <= 2)
    check_places(result, cells)
    return cells


def check_places(result: Boundary, cells: CellComplex) -> None:
    """Every vertex is on the surfaces of all faces around it, at an angle of theirs, within their limits."""
    t = result.trapezoids
    face = cells.face
    size = max(1.0, float(np.abs([cells.x, cells.y]).max(initial=1.0)))
    theta = cells.theta[cells.vertex]
    turned = theta + 2 * math.pi * np.array([-1, 0, 1])[:, None]
    assert np.all(np.any((turned > t.theta_from[face] - 1e-6) & (turned < t.theta_to[face] + 1e-6), axis=0))
    ends = [result.evaluate(t.patch[face], np.full(len(face), at), theta) for at in (0.0, 1.0)]
    place = np.column_stack([cells.x, cells.y])[cells.vertex]
    along, away = ends[1] - ends[0], place - ends[0]
    length = np.hypot(*along.T)
    sideways = np.abs(along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]) / length
    forwards = (along * away).sum(axis=1) / length
    assert sideways.max(initial=0.0) < 1e-5 * size
    assert forwards.min(initial=0.0) > -1e-5 * size and (forwards - length).max(initial=0.0) < 1e-5 * size


@pytest.mark.parametrize("path", SMALL + CASES, ids=lambda path: path.stem)
def test_boundaries_are_closed(path: Path) -> None:
    check(boundary(load_scene(path), threads=1))


@pytest.mark.parametrize("kind", KINDS)
def test_random_boundaries_are_closed(kind: str) -> None:
    for seed in range(12):
        check(boundary(scene_of(random_scene(seed, kind)), threads=1))


def test_a_convex_pair_is_a_torus() -> None:
    scene = Scene([(0, 0), (3, 0), (1, 2)], [[(5, 5), (9, 6), (8, 9), (5, 8)]])
    cells = check(boundary(scene))
    assert cells.components == 1 and cells.euler.tolist() == [0]
    assert len(cells.pinched) == 0


def test_a_robot_in_a_room_and_around_it() -> None:
    room = ([(-6, -6), (6, -6), (6, 6), (-6, 6)], [[(-5, -5), (-5, 5), (5, 5), (5, -5)]])
    cells = check(boundary(scene_of(PlainScene([box(-1, -1, 1, 2)], [room]))))
    assert sorted(cells.euler.tolist()) == [0, 0]  # the inside and the outside, both round in theta


def test_a_niche_that_only_some_orientations_fit_is_a_sphere() -> None:
    # a rod in a box: it turns a little, but not round; its two orientations are two bounded cells
    hollow = ([(-5, -3), (5, -3), (5, 3), (-5, 3)], [[(-4, -2), (-4, 2), (4, 2), (4, -2)]])
    cells = check(boundary(scene_of(PlainScene([box(-3, -1, 3, 1)], [hollow]))))
    assert sorted(cells.euler.tolist()) == [0, 2, 2]


@pytest.mark.parametrize("k", [1, 20, 52, 90])
def test_edges_slide_along_parallel_ones_of_nearly_their_length_and_nearly_their_line(k: int) -> None:
    hair = Fraction(1, 2**k)
    for robot in ([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 0), (1, 0), (1, 2 - hair), (0, 2 - hair)]):
        for longer, off in product((-hair, 0, hair), (0, hair)):
            places = [(4, 0, 5 + longer, 1), (8, off, 9, 1 + off), (4, 4, 5, 5 + longer)]
            squares = [[(x, y), (u, y), (u, v), (x, v)] for x, y, u, v in places]
            slanted = [[turned((Fraction(3, 5), Fraction(4, 5)), p) for p in square] for square in squares]
            found = [check(boundary(Scene(robot, obstacles))) for obstacles in (squares, slanted)]
            assert sorted(found[0].euler) == sorted(found[1].euler)


def test_pinched_edges_pair_the_sides_of_free_sectors() -> None:
    # a corner of the triangle passes between the obstacle and the wall at one orientation
    room = [(-1, -1), (6, -1), (6, 6), (-1, 6)]
    scene = Scene([(-3, -1), (-4, 0), (-4, -2)], [[(1, 2), (3, 4), (1, 4)]], workspace=room)
    cells = check(boundary(scene))
    assert len(cells.pinched) > 0
    for edge in cells.pinched:
        around = cells.at_edge(int(edge))
        assert len(around) > 2 and len(around) % 2 == 0
        assert set(cells.twin[around].tolist()) == set(around.tolist())


@pytest.mark.slow
@pytest.mark.parametrize(("work", "name"), [("complex", "nest_swim"), ("mesh", "benchmr_parking1")])
def test_a_signal_ends_long_work(work: str, name: str) -> None:
    def stop(*_: object) -> None:
        raise TimeoutError

    def run(result: Boundary) -> float:
        start = time.process_time()
        with contextlib.suppress(TimeoutError):
            glue(result) if work == "complex" else result.mesh(0.0005)
        return time.process_time() - start

    result = boundary(load_scene(ROOT / f"examples/scenes/{name}.json"))
    assert work == "complex" or result.complex
    whole, before = run(result), signal.signal(signal.SIGPROF, stop)
    try:
        signal.setitimer(signal.ITIMER_PROF, 0.02)
        assert run(result) < 0.6 * whole
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def test_numbers_that_vanish_modulo_the_primes_of_fingerprints_change_nothing() -> None:
    rows = ("vertices", "edges", "components", "first", "side", "twin", "component")

    def arrays(factor: int) -> list[list[int]]:
        scene = fuzz.everywhere(fuzz.scene("lattices", 8), lambda x, y: (x * factor, y * factor))
        cells = check(boundary(scene_of(scene), threads=1))
        return [np.asarray(getattr(cells, name)).tolist() for name in rows]

    expected = arrays(1)
    assert all(arrays(factor) == expected for factor in (*fuzz.UNLUCKY, fuzz.UNLUCKY[1] * fuzz.UNLUCKY[2]))


def test_walkers_go_round() -> None:
    cells = boundary(Scene([(0, 0), (2, 0), (0, 1)], [[(5, 5), (8, 5), (6, 7)]])).complex
    seen = 0
    for vertex in range(cells.vertices):
        start = int(np.flatnonzero(cells.vertex == vertex)[0])
        around = list(cells.around_vertex(start))
        assert set(cells.vertex[around].tolist()) == {vertex}
        seen += len(around)
    assert seen == len(cells.twin)  # each coedge starts at one vertex
    for face in range(len(cells.component)):
        loop = cells.loop(face)
        assert [cells.before(h) for h in loop] == [loop[-1], *loop[:-1]]
        assert [int(f) for f in cells.neighbours(face)] == [int(cells.face[cells.twin[h]]) for h in loop]


def test_a_lost_trapezoid_is_noticed() -> None:
    from cfree import _core
    from cfree.forbidden.columns import COLUMNS, Trapezoids

    result = boundary(load_scene(ROOT / "examples/scenes/five_convex.json"))
    contacts = result.contact_kind, result.contact_robot, result.contact_obstacle
    for lost in range(0, len(result.trapezoids), 37):
        rest = Trapezoids(*(np.delete(getattr(result.trapezoids, name), lost) for name in COLUMNS))
        part = Boundary(result.scene, result.features, *contacts, rest, result.isolated, result.stats, result.trimmed)
        with pytest.raises(RuntimeError, match=r"partner|alternate"):
            _core.glue(part._handle, 1)


def test_any_number_of_threads_gives_the_same_complex() -> None:
    scene = load_scene(ROOT / "examples/scenes/benchmr_parking1.json")  # several blocks of everything
    found = []
    for threads in (1, 2, 5):
        result = boundary(scene, threads=1)
        glue_by(threads, result)
        found.append(result.complex)
    assert found[0] == found[1] == found[2]


def test_euler_numbers_do_not_depend_on_the_robots_frame() -> None:
    plain = random_scene(5, "nonconvex")
    found = []
    for quarters in range(4):
        turned = [[(x, y) for x, y in ring] for ring in (plain.robot[0][0],)]
        for _ in range(quarters):
            turned = [[(-y, x) for x, y in ring] for ring in turned]
        scene = scene_of(plain._replace(robot=[(turned[0], [])]))
        found.append(sorted(boundary(scene).complex.euler.tolist()))
    assert all(a == b for a, b in pairwise(found))
