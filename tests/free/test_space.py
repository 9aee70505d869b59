"""Cells of the free space, against closed forms, brute-force floods and exact overlap tests."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely

import oracles
from cfree import (
    FormatError,
    FreeSpace,
    Pose,
    Poses,
    Scene,
    boundary,
    free_space,
    largest_disc,
    load_scene,
    save,
)
from cfree.exact.half_angle import tau_in_chart
from cfree.formats.boundaries.boundary_file import CELL_COLUMNS, load_boundary, load_space, save_boundary
from compared import plain_of, scene_of
from examples import POLYGONS
from flood import flood
from shapes import KINDS, PlainScene, box, mapped, random_scene
from spaces import ROD, TIGHT, hollow, space_of

ROOT = Path(__file__).parents[2]
SMALL = [path for path in POLYGONS if path.stat().st_size < 6_000]


def check_against_flood(plain: PlainScene, space: FreeSpace, steps: int) -> int:
    """How many cells the flood tells apart with certainty."""
    found = flood(plain, steps)
    cell = space.locate(Poses(found.xy, found.theta))
    assert np.all(cell >= 0)
    for numbers, other in ((found.certain, cell), (cell, found.possible)):
        pairs = np.unique(np.column_stack([numbers, other]), axis=0)
        assert len(np.unique(pairs[:, 0])) == len(pairs)  # one `other` for each number
    return len(np.unique(found.possible))


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
def test_cells_are_those_of_a_flood(kind: str) -> None:
    for seed in range(1):
        plain = random_scene(seed, kind)
        check_against_flood(plain, space_of(plain), 60)


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("path", SMALL, ids=lambda path: path.stem)
def test_cells_of_examples_are_those_of_a_flood(path: Path) -> None:
    scene = load_scene(path)
    check_against_flood(plain_of(scene), free_space(boundary(scene, threads=1)), 80)


@pytest.mark.slow
def test_a_rod_in_a_tight_box_has_two_caged_cells() -> None:
    plain = PlainScene([ROD], [TIGHT])
    space = space_of(plain)
    assert [(c.bounded, c.caged, c.turns) for c in space.cells] == [(False, False, 1), (True, True, 0), (True, True, 0)]
    assert check_against_flood(plain, space, 400) == 3
    assert space.locate([Pose(0, 0, 0), Pose(0, 0, math.pi)]).tolist() in ([1, 2], [2, 1])
    for cell in space.cells[1:]:
        start, stop = cell.theta_range
        # the diagonal of the rod, (6, 2), is as high as the box at its extreme angle: 6 sin + 2 cos = 4
        extreme = math.asin(4 / math.hypot(6, 2)) - math.atan2(2, 6)
        assert stop - start == pytest.approx(2 * extreme, abs=1e-12)


def test_no_obstacles() -> None:
    space = free_space(boundary(Scene(robot=ROD[0])))
    assert len(space) == 1 and not space.cells[0].bounded and space.locate(Pose(0, 0)) == 0
    assert space.locate([]).tolist() == []
    empty = free_space(boundary(Scene(robot=ROD[0], workspace=box(0, 0, 1, 1)[0])))
    assert len(empty) == 0 and empty.locate(Pose(0, 0)) == -1


def test_a_room_in_a_room() -> None:
    # robot at large in the outer room, around a box whose inside is a room, too
    plain = PlainScene([box(0, 0, 1, 1)], [hollow((10, 10, 30, 30), (12, 12, 28, 28))], bounds=(0, 0, 40, 40))
    space = space_of(plain)
    assert sorted((c.caged, c.full_turn, len(c.components)) for c in space.cells) == [(False, True, 2), (True, True, 1)]
    assert space.depth.tolist().count(2) == 1
    inside, outside = space.locate([Pose(20, 20), Pose(5, 5)])
    assert space.cells[inside].caged and not space.cells[outside].caged
    assert space.locate([Pose(50, 5), Pose(11, 11)]).tolist() == [-1, -1]


def test_poses_on_the_boundary_are_in_the_cell_they_bound() -> None:
    plain = PlainScene([box(0, 0, 1, 1)], [hollow((-1, -1, 5, 5), (0, 0, 4, 4))])
    space = space_of(plain)
    third = Fraction(1, 3)
    inside = [Pose(0, third), Pose(3, third), Pose(3, 3), Pose(0, 0), Pose(4, 4, "180deg"), Pose(1, 2, "90deg")]
    assert space.locate(inside).tolist() == [1] * 6
    assert space.locate([Pose(-2, third), Pose(5, third), Pose(-2, -2)]).tolist() == [0] * 3
    tiny = Fraction(1, 10**40)
    assert space.locate([Pose(-tiny, third), Pose(tiny, third), Pose(3 + tiny, 3)]).tolist() == [-1, 1, -1]
    turned = Pose(2, 2, {"tau": "1/3"})  # lowest corner at the origin of the robot: on the floor
    assert space.locate([Pose(2, 0, {"tau": "1/3"}), Pose(2, -tiny, {"tau": "1/3"}), turned]).tolist() == [1, -1, 1]


def test_an_exact_fit_is_free_and_in_no_cell() -> None:
    square = box(0, 0, 1, 1)
    space = space_of(PlainScene([square], [hollow((-1, -1, 2, 2), (0, 0, 1, 1))]))
    assert space.locate([Pose(0, 0), Pose(1, 0, "90deg"), Pose("1/9", 0)]).tolist() == [-2, -2, -1]
    assert len(space) == 1


def test_an_exact_fit_longer_than_one_patch() -> None:
    walls = [hollow((-1, -1, 6, 3), (0, 0, 4, 2)), box(1, 0, 4, 1)]  # a bent corridor as wide as the robot
    space = space_of(PlainScene([box(0, 0, 1, 1)], walls))
    xs = [Fraction(k, 2) for k in range(7)]
    assert space.locate([Pose(x, 1) for x in xs]).tolist() == [-2] * 7
    assert space.locate([Pose(x + 1, 1, "90deg") for x in xs]).tolist() == [-2] * 7


@pytest.mark.parametrize("kind", ["touching", "holed"])
def test_one_pose_in_doubles_is_in_the_cell_of_its_exact_pose(kind: str) -> None:
    plain, rng = random_scene(1, kind), np.random.default_rng(3)
    space = space_of(plain)
    x0, y0, x1, y1 = oracles.box_of([*plain.obstacles, *([plain.workspace] if plain.workspace else [])])
    found = []
    for x, y, theta in rng.uniform((x0, y0, -7), (x1, y1, 7), (60, 3)).tolist():
        for row in ((x, y, theta), (float(round(x)), float(round(y)), round(theta) * math.pi / 2)):
            found.append(space.locate([Pose(*row)]).tolist()[0])
            for given in (row, list(row), np.array(row), Pose(*row), (Fraction(row[0]), *row[1:])):
                assert space.locate(given) == found[-1]
    assert len(set(found)) > 1
    for wrong in ((0, 0, math.nan), (0, 0), "000"):
        with pytest.raises((TypeError, ValueError), match="poses"):
            space.locate(wrong)  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", KINDS)
def test_location_agrees_with_exact_overlap(kind: str) -> None:
    rng = np.random.default_rng(0)
    for seed in range(2):
        plain = random_scene(seed + 7, kind)
        space = space_of(plain)
        x0, y0, x1, y1 = oracles.box_of([*plain.obstacles, *([plain.workspace] if plain.workspace else [])])
        for _ in range(25):  # simple numbers: many contacts
            x, y = (
                Fraction(int(rng.integers(2 * math.floor(a), 2 * math.ceil(b))), 2) for a, b in ((x0, x1), (y0, y1))
            )
            tau = rng.choice([Fraction(0), Fraction(1), Fraction(-1), Fraction(1, 2), Fraction(-3, 7), None])
            free = not oracles.exact_is_forbidden(
                plain.robot, plain.obstacles, x, y, tau, plain.bounds, plain.workspace
            )
            assert (space.locate(Pose(x, y, {"tau": tau})) != -1) == free


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_removing_an_obstacle_never_splits_a_cell(seed: int) -> None:
    plain = random_scene(seed, "bounds")
    found = flood(plain, 40)
    poses = Poses(found.xy, found.theta)
    spaces = [space_of(plain._replace(obstacles=plain.obstacles[:k])) for k in (len(plain.obstacles), 1, 0)]
    for more, fewer in pairwise(space.locate(poses) for space in spaces):
        assert np.all(fewer >= 0)
        assert len(np.unique(np.column_stack([more, fewer]), axis=0)) == len(np.unique(more))


def length(ring: list[tuple[float, float]]) -> float:
    return sum(math.dist(p, q) for p, q in zip(ring, ring[1:] + ring[:1], strict=True))


def area(ring: list[tuple[float, float]]) -> float:
    return float(sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(ring, ring[1:] + ring[:1], strict=True)) / 2)


def test_volume_around_a_convex_pair() -> None:
    A, O, wide = [(0, 0), (3, 0), (1, 2)], [(5, 5), (9, 6), (8, 9), (5, 8)], 100
    forbidden = 2 * math.pi * (area(A) + area(O)) + length(A) * length(O)
    (cell,) = free_space(boundary(Scene(A, [O], bounds=(-wide, -wide, wide, wide)))).cells
    assert cell.volume == pytest.approx(2 * math.pi * (2 * wide) ** 2 - forbidden, rel=1e-13)
    (open_cell,) = free_space(boundary(Scene(A, [O]))).cells
    assert open_cell.volume == math.inf


def test_volume_of_a_square_in_a_square() -> None:
    # a unit square about its middle, turned by less than a quarter turn, is |cos| + |sin| wide
    room = PlainScene([box(0, 0, 1, 1)], [hollow((-1, -1, 5, 5), (0, 0, 4, 4))])
    width = np.array([4.0, 1.0])  # integral over the quarter turn of (4 - c - s)^2
    quarter = width[0] ** 2 * math.pi / 2 - 2 * width[0] * 2 + (math.pi / 2 + 1)
    assert space_of(room).cells[1].volume == pytest.approx(4 * quarter, rel=1e-12)


@pytest.mark.parametrize("kind", ["bounds", "workspace"])
def test_volumes_agree_with_random_poses(kind: str) -> None:
    rng = np.random.default_rng(1)
    for seed in range(4):
        space = space_of(random_scene(seed, kind))
        assert space.boundary.features.rim is not None
        x0, y0, x1, y1 = space.boundary.features.rim
        n, whole = 3000, 2 * math.pi * (x1 - x0) * (y1 - y0)
        where = space.locate(Poses(rng.uniform((x0, y0), (x1, y1), (n, 2)), rng.uniform(0, math.tau, n)))
        share = np.bincount(where + 1, minlength=len(space) + 1)[1:] / n
        expected = space.volumes / whole
        assert np.all(np.abs(share - expected) <= 5 * np.sqrt(expected / n) + 5 / n)


def test_largest_discs_are_in_their_cells_and_have_that_room() -> None:
    scene = load_scene(ROOT / "examples/scenes/flat.json")
    space = free_space(boundary(scene))
    plain = plain_of(scene)
    for cell in space.cells:
        assert largest_disc(cell) is not None
        pose, room = largest_disc(cell)
        assert space.locate(pose) == cell.index and room > 0
        around = room * 0.999 * np.exp(1j * np.arange(0, math.tau, 0.3))
        for step in around:
            x, y = float(pose.x) + step.real, float(pose.y) + step.imag
            assert not oracles.overlaps(plain.robot, plain.obstacles, (x, y, pose.theta))


@pytest.mark.parametrize("name", ["benchmr_parking1", "nest_shirts", "flat"])
def test_many_poses_are_in_the_cells_that_each_of_them_is_in(name: str) -> None:
    space = free_space(boundary(load_scene(ROOT / f"examples/scenes/{name}.json")))
    rng = np.random.default_rng(3)
    xy = space.boundary.features.obstacles.xy
    poses = Poses(rng.uniform(xy.min(0), xy.max(0), (3000, 2)), rng.uniform(0, math.tau, 3000))
    found = space.locate(poses)
    assert len(np.unique(found)) > 1
    for threads in (1, 3):
        np.testing.assert_array_equal(space.locate(poses, threads=threads), found)
    assert space.locate([poses[k] for k in range(300)]).tolist() == found[:300].tolist()
    assert [scanned(space, poses[k]) for k in range(300)] == found[:300].tolist()
    with pytest.raises(ValueError, match="threads: 0"):
        space.locate(poses, threads=0)


def scanned(space: FreeSpace, pose: Pose) -> int:
    """Where a pose is by all segments of its slice, in doubles."""
    x, y, cut = float(pose.x), float(pose.y), space.surfaces.slice(pose.theta)
    (x0, y0), (x1, y1) = cut.segments[:, 0].T, cut.segments[:, 1].T
    crossed = ((y0 > y) != (y1 > y)) & (x0 + (y - y0) / np.where(y1 == y0, 1, y1 - y0) * (x1 - x0) < x)
    around = np.flatnonzero(np.bincount(space.component[cut.trapezoids[crossed]], minlength=len(space.parent)) % 2)
    if len(around) == 0:
        return space.outside
    deepest = around[np.argmax(space.depth[around])]
    return int(space.cell_of[deepest]) if space.free_inside[deepest] else -1


def test_location_at_critical_orientations_and_beside_them() -> None:
    # and at half-angle tangents k / 64: dyadic ones may be where a list of the index ends
    plain = random_scene(5, "bounds")
    space = space_of(plain)
    table, rng = space.surfaces.trapezoids, np.random.default_rng(0)
    ends = list(zip(table.chart.tolist(), table.tau_to.tolist(), strict=True))[::40]
    beside = [(c, float(np.nextafter(t, side))) for c, t in ends for side in (-1, 1) if abs(t) < 1]
    assert plain.bounds is not None
    x0, y0, x1, y1 = map(float, plain.bounds)
    for chart, tau in [(c, k / 64) for c in (0, 1) for k in range(-64, 65, 4)] + ends + beside:
        x, y = (Fraction(round(8 * c), 8) for c in rng.uniform((x0, y0), (x1, y1)))
        pose = Pose(x, y, {"tau": tau_in_chart(chart, Fraction(tau))})
        forbidden = oracles.exact_is_forbidden(plain.robot, plain.obstacles, x, y, pose.tau, plain.bounds, None)
        assert (space.locate(pose) == -1) == forbidden
        segments = space.surfaces.slice(pose.theta).segments
        if shapely.distance(shapely.Point(float(x), float(y)), shapely.MultiLineString(list(segments))) > 1e-6:
            assert space.locate(pose) == scanned(space, pose)


def test_motions_of_the_scene_change_nothing() -> None:
    # turned by the angle of (3, 4), and moved; the robot is turned in its own frame, too
    def image(x: Fraction, y: Fraction) -> tuple[Fraction, Fraction]:
        return Fraction(3 * x - 4 * y, 5) + 7, Fraction(4 * x + 3 * y, 5) - 11

    def turned(x: Fraction, y: Fraction) -> tuple[Fraction, Fraction]:
        return -y, x

    for seed in range(3):
        plain = random_scene(seed, "holed")
        plain = PlainScene([ROD], [TIGHT]) if seed == 0 else plain_of(scene_of(plain))
        moved = PlainScene(
            [mapped(shape, turned) for shape in plain.robot],
            [mapped(shape, lambda x, y: image(Fraction(x), Fraction(y))) for shape in plain.obstacles],
        )
        facts = []
        for each in (plain, moved):
            cells = space_of(each).cells
            facts.append(sorted((c.caged, c.turns, len(c.components), c.volume, np.ptp(c.theta_range)) for c in cells))
        assert [f[:3] for f in facts[0]] == [f[:3] for f in facts[1]]
        np.testing.assert_allclose([f[3:] for f in facts[0]], [f[3:] for f in facts[1]], rtol=1e-9)


def test_cells_in_a_file(tmp_path: Path) -> None:
    space = space_of(PlainScene([ROD], [TIGHT]))
    path = tmp_path / "cells.npz"
    save(space, path)
    again = load_space(path)
    assert [c.theta_range for c in again.cells] == [c.theta_range for c in space.cells]
    assert again.locate([Pose(0, 0), Pose(9, 9)]).tolist() == space.locate([Pose(0, 0), Pose(9, 9)]).tolist()
    assert len(load_boundary(path).trapezoids) == len(space.component)
    save(space.boundary, path)
    with pytest.raises(FormatError, match="no cells are in it"):
        load_space(path)
    for name, wrong in (
        ("parent", space.parent + 1),
        ("component", space.component + 1),
        ("turns", space.turns * 1.0),
    ):
        columns = {f"cells_{c}": getattr(space, c) for c in CELL_COLUMNS} | {f"cells_{name}": wrong}
        save_boundary(space.boundary, path, columns)
        with pytest.raises(FormatError, match=f"cells_{name}"):
            load_space(path)


def test_slits_of_bounds_are_in_no_cell() -> None:
    # below the obstacle, its vertex at the reference point upwards, the robot can only slide along the bounds
    scene = Scene(robot=[(0, 0), (-1, -2), (1, -2)], obstacles=[box(1, 0, 4, 3)[0]], bounds=(0, 0, 5, 5))
    space = free_space(boundary(scene))
    assert space.surfaces is not space.boundary
    check_against_flood(plain_of(scene), space, 60)
    poses = [Pose(2, 0), Pose(2, 0, {"tau": "1/9"}), Pose(2, 0, {"tau": 1}), Pose(2, Fraction(1, 10**30)), Pose(1, 0)]
    assert space.locate(poses).tolist() == [-2, -2, -1, -1, space.locate(Pose("99/100", 0))]


def test_a_touching_pair_parts_the_plane_at_one_height_only() -> None:
    # rays through vertices and along level edges: every position of a grid of half integers
    plain = PlainScene([box(0, 0, 1, 1)], [box(0, 0, 2, 2), box(2, 2, 4, 4), hollow((-4, -4, 8, 8), (-3, -3, 7, 7))])
    space = space_of(plain)
    steps = [Fraction(k, 2) for k in range(-8, 16)]
    found = space.locate([Pose(x, y) for x in steps for y in steps]).reshape(len(steps), -1)
    for i, x in enumerate(steps):
        for j, y in enumerate(steps):
            forbidden = oracles.exact_is_forbidden(plain.robot, plain.obstacles, x, y, Fraction(0))
            assert (found[i, j] == -1) == forbidden
