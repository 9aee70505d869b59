"""The trimmed boundary: counts, volume, the laws it obeys, threads, Ctrl-C and odd scenes."""

import math
import os
import random
import signal
import subprocess
import sys
import time
from collections import Counter
from dataclasses import fields
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

import strategies
from cfree import Boundary, IncompleteError, Polygon, Pose, Scene, _core, boundary, load_scene, save
from cfree.contact import is_forbidden
from cfree.formats.boundaries.boundary_file import load_boundary
from cfree.scene.features import scene_features
from compared import edge, length, mistakes, part_of, scene_of, slit_length, vertex
from shapes import (
    KINDS,
    PlainScene,
    Shape,
    box,
    mapped,
    mirrored,
    moved,
    random_convex,
    random_scene,
    rational_regular,
    regular,
    scaled,
    star_among_squares,
)

TESTS = Path(__file__).parents[1]
ANGLES = (0.1234, 1.9876, 3.3333, 5.4321)
COSINE, SINE = Fraction(3, 5), Fraction(4, 5)  # of a rational turn
TURN = math.atan2(4, 3)
quick = settings(
    deadline=None,
    derandomize=True,
    max_examples=25,
    suppress_health_check=[HealthCheck.too_slow],
    database=None,
    phases=[Phase.explicit, Phase.generate],
)


def built(plain: PlainScene) -> Boundary:
    return boundary(scene_of(plain), threads=1)


def lengths(result: Boundary, angles=ANGLES) -> list[float]:
    return [length(result.slice(angle % (2 * math.pi)).segments) for angle in angles]


def areas(result: Boundary, angles=ANGLES) -> list[float]:
    return [result.slice(angle % (2 * math.pi)).forbidden.area for angle in angles]


def on_all(plain: PlainScene, change, change_robot=None) -> PlainScene:
    """The same map for all shapes, or another for the robot."""
    return PlainScene(
        [(change_robot or change)(shape) for shape in plain.robot], [change(shape) for shape in plain.obstacles]
    )


# --- counts and volume of one convex pair ---


def test_every_contact_of_a_convex_pair_is_live() -> None:
    #  robot: n = 3, obstacle: m = 4, no parallel edges but those of the obstacle
    result = built(PlainScene([([(0, 0), (2, 1), (0, 3)], [])], [([(10, 10), (14, 11), (13, 15), (9, 12)], [])]))
    assert result.stats.patches == result.stats.live_patches == 2 * 3 * 4
    assert Counter(patch.kind for patch in result.patches) == {"v-e": 12, "e-v": 12}


@pytest.mark.parametrize("seed", range(12))
def test_a_convex_pair_has_2nm_patches_nm_helices_and_nm_segments(seed: int) -> None:
    rng = random.Random(seed)
    plain = PlainScene([random_convex(rng)], [random_convex(rng, (4.0, 1.0), 2.0)])
    n, m = len(plain.robot[0][0]), len(plain.obstacles[0][0])
    result = built(plain)
    assert result.stats.patches == result.stats.live_patches == 2 * n * m
    columns = result.trapezoids
    assert set((columns.lower >> np.uint64(61)).tolist()) == {3} == set((columns.upper >> np.uint64(61)).tolist())
    assert len({*columns.lower.tolist(), *columns.upper.tolist()}) == n * m
    parallels = {*columns.from_first.tolist(), *columns.to_first.tolist()} - {0}
    assert {code >> 61 for code in parallels} == {4}
    assert len(parallels) == n * m


@pytest.mark.parametrize("seed", range(8))
def test_the_volume_of_a_convex_pair_is_the_papers(seed: int) -> None:
    rng = random.Random(100 + seed)
    plain = PlainScene([random_convex(rng)], [random_convex(rng, (4.0, 1.0), 2.0)])
    result = built(plain)
    # between critical angles the area of a slice is a + b cos + c sin: Gauss' rule is exact to rounding
    ends = np.unique(np.concatenate([result.trapezoids.theta_from, result.trapezoids.theta_to]))
    nodes, weights = np.polynomial.legendre.leggauss(12)
    volume = sum(
        (q - p) / 2 * weight * result.slice(float((p + q) / 2 + (q - p) / 2 * node)).forbidden.area
        for p, q in pairwise(ends)
        if q - p > 1e-12
        for node, weight in zip(nodes, weights, strict=True)
    )
    (robot,), (obstacle,) = result.scene.robot, result.scene.obstacles
    expected = 2 * math.pi * (robot.area + obstacle.area) + robot.perimeter * obstacle.perimeter
    assert math.isclose(volume, expected, rel_tol=1e-11)


@pytest.mark.parametrize("seed", range(3))
def test_obstacles_forbid_what_their_pillars_do_together(seed: int) -> None:
    """Section 3.4 with many obstacles, some of which overlap: inside at least one pillar is forbidden, else free."""
    rng = random.Random(seed)
    bodies = [random_convex(rng, (2.5 * k, rng.uniform(-1, 1)), 2.0) for k in range(4)]
    robot = random_convex(rng)
    together, alone = built(PlainScene([robot], bodies)), [built(PlainScene([robot], [body])) for body in bodies]
    assert together.stats.live_patches > max(one.stats.live_patches for one in alone)
    overlaps = 0
    for theta in ANGLES:
        pillars = [one.slice(theta).forbidden for one in alone]
        overlaps += shapely.union_all(pillars).area < sum(pillar.area for pillar in pillars) - 1e-3
        difference = together.slice(theta).forbidden.symmetric_difference(shapely.union_all(pillars))
        assert difference.area < 1e-9
    assert overlaps  # pillars meet, so patches are trimmed
    (A,), free = together.scene.robot, []
    for _ in range(200):
        pose = Pose(rng.uniform(-4, 12), rng.uniform(-5, 5), rng.uniform(0, 6))
        free.append(together.checker.is_free(pose))
        assert free[-1] == (not any(is_forbidden(A, O, pose) for O in together.scene.obstacles))
    assert {True, False} == set(free)


@pytest.mark.slow
@quick
@given(strategies.simple_polygons(), strategies.simple_polygons(), st.sampled_from(ANGLES))
def test_convex_pieces_forbid_what_the_whole_does_and_their_diagonals_make_no_surface(
    one: Shape, other: Shape, theta: float
) -> None:
    """Section 3's decomposition into convex obstacles, and its erratum."""
    A, O = Polygon(*one), Polygon(*other)
    v, w = A.exact_vertices, O.exact_vertices
    whole = boundary(Scene(robot=A, obstacles=O), threads=1)
    parts = [[[polygon.exact_vertices[k] for k in piece] for piece in polygon.pieces] for polygon in (A, O)]
    pieces = boundary(Scene(robot=parts[0], obstacles=parts[1]), threads=1)
    size = whole.slice(theta).forbidden.area
    assert whole.slice(theta).forbidden.symmetric_difference(pieces.slice(theta).forbidden).area < 1e-9 * size
    rims = (
        {frozenset((v[i], v[int(A.next[i])])) for i in range(len(A))},
        {frozenset((w[j], w[int(O.next[j])])) for j in range(len(O))},
    )
    for patch in whole.patches:  # of true edges only
        place, corners, rim = (patch.obstacle, w, rims[1]) if patch.kind == "v-e" else (patch.robot, v, rims[0])
        assert place.end is not None and frozenset((corners[place.index], corners[place.end])) in rim


def test_widths_of_vertex_patches_over_one_edge_tile_the_circle() -> None:
    result = built(PlainScene([rational_regular(7)], [([(3, 0), (5, 1), (4, 4)], [])]))
    for kind, features in (("v-e", "obstacle"), ("e-v", "robot")):
        ranges: dict[object, list[tuple[float, float]]] = {}
        for patch in result.patches:
            if patch.kind == kind:
                ranges.setdefault(getattr(patch, features), []).append((patch.phi_min, patch.phi_range))
        for around in ranges.values():
            around.sort()
            assert math.isclose(sum(width for _, width in around), 2 * math.pi)
            ends = np.sort([(start + width) % (2 * math.pi) for start, width in around])
            assert np.allclose(ends, [start for start, _ in around])


# --- laws ---


@pytest.mark.slow
@quick
@given(strategies.scenes(), st.integers(-9, 9), st.integers(-9, 9))
def test_moving_all_obstacles_moves_the_slices(plain: PlainScene, dx: int, dy: int) -> None:
    before = built(plain)
    after = built(plain._replace(obstacles=[moved(shape, dx, dy) for shape in plain.obstacles]))
    assert before.stats.live_patches == after.stats.live_patches
    for angle in ANGLES:
        p, q = before.slice(angle), after.slice(angle)
        assert p.patches.tolist() == q.patches.tolist()
        assert np.allclose(p.segments + np.array([dx, dy]), q.segments, atol=1e-9)


@pytest.mark.slow
@quick
@given(strategies.scenes(), st.integers(-9, 9), st.integers(-9, 9))
def test_moving_the_reference_point_moves_each_slice(plain: PlainScene, dx: int, dy: int) -> None:
    before = built(plain)
    after = built(plain._replace(robot=[moved(shape, dx, dy) for shape in plain.robot]))
    assert before.stats.live_patches == after.stats.live_patches
    for angle in ANGLES:
        c, s = math.cos(angle), math.sin(angle)
        p, q = before.slice(angle), after.slice(angle)
        assert p.patches.tolist() == q.patches.tolist()
        assert np.allclose(p.segments - (c * dx - s * dy, s * dx + c * dy), q.segments, atol=1e-9)


def rotated(shape: Shape) -> Shape:
    return mapped(shape, lambda x, y: (COSINE * x - SINE * y, SINE * x + COSINE * y))


@pytest.mark.slow
@quick
@given(strategies.scenes())
def test_turning_the_obstacles_turns_the_space(plain: PlainScene) -> None:
    before = built(plain)
    after = built(plain._replace(obstacles=[rotated(shape) for shape in plain.obstacles]))
    assert before.stats.patches == after.stats.patches  # not the live ones: who owns what is shared may change
    turned_angles = [angle + TURN for angle in ANGLES]
    assert np.allclose(lengths(before), lengths(after, turned_angles))
    assert np.allclose(areas(before), areas(after, turned_angles))


@pytest.mark.slow
@quick
@given(strategies.scenes())
def test_turning_the_robot_shifts_the_orientations(plain: PlainScene) -> None:
    before = built(plain)
    after = built(plain._replace(robot=[rotated(shape) for shape in plain.robot]))
    assert np.allclose(lengths(before), lengths(after, [angle - TURN for angle in ANGLES]))


@pytest.mark.slow
@quick
@given(strategies.scenes(), st.sampled_from([Fraction(1, 3), Fraction(7), Fraction(10**6), Fraction(1, 10**6)]))
def test_scaling_scales_the_slices(plain: PlainScene, factor: Fraction) -> None:
    before, after = built(plain), built(on_all(plain, lambda shape: scaled(shape, factor)))
    assert before.stats.live_patches == after.stats.live_patches
    assert np.allclose(np.multiply(lengths(before), float(factor)), lengths(after))
    assert np.allclose(np.multiply(areas(before), float(factor) ** 2), areas(after))


@quick
@given(strategies.scenes())
def test_mirroring_reverses_the_orientations(plain: PlainScene) -> None:
    before, after = built(plain), built(on_all(plain, mirrored))
    assert before.stats.patches == after.stats.patches
    assert np.allclose(lengths(before), lengths(after, [-angle for angle in ANGLES]))


def owners(result: Boundary) -> Counter[object]:
    """Live patches by the geometry of their features."""
    scene = result.scene

    def features(patch) -> object:
        if patch.kind == "e-v":
            return edge(scene, patch.robot, of_robot=True), vertex(scene, patch.obstacle, of_robot=False)
        return vertex(scene, patch.robot, of_robot=True), edge(scene, patch.obstacle, of_robot=False)

    return Counter(features(patch) for patch in result.patches if patch.is_live)


@quick
@given(strategies.scenes(), st.randoms(use_true_random=False))
def test_the_order_of_input_changes_nothing(plain: PlainScene, rng: random.Random) -> None:
    def relabelled(shape: Shape) -> Shape:
        rings = [shape[0], *shape[1]]
        first, *others = [ring[k:] + ring[:k] for ring in rings for k in [rng.randrange(len(ring))]]
        return first, others

    other = PlainScene(
        [relabelled(shape) for shape in rng.sample(plain.robot, len(plain.robot))],
        [relabelled(shape) for shape in rng.sample(plain.obstacles, len(plain.obstacles))],
    )
    before, after = built(plain), built(other)
    assert owners(before) == owners(after)
    assert np.allclose(lengths(before), lengths(after))


# but where bounds or a workspace change, or a diagonal names an angle: those are numbered after all rings
@pytest.mark.parametrize("kind", sorted({*KINDS} - {"bounds", "workspace", "integer_grid"}))
def test_what_the_robot_cannot_reach_leaves_names_and_intervals_alone(kind: str) -> None:
    plain = random_scene(3, kind)
    points = [
        point
        for shapes in (plain.robot, plain.obstacles)
        for outer, holes in shapes
        for r in (outer, *holes)
        for point in r
    ]
    away = 4 * math.ceil(max(abs(x) + abs(y) for x, y in points))
    both = PlainScene(plain.robot, [*plain.obstacles, *(moved(shape, away, 3 * away + 1) for shape in plain.obstacles)])
    alone, part = built(plain).trapezoids, built(both).trapezoids
    for column in fields(alone):
        assert np.array_equal(getattr(alone, column.name), getattr(part, column.name)[: len(alone.patch)]), column.name


ROBOT = box(0, 0, 1, 2)
COINCIDENT = {
    "tops on one line": [box(0, 0, 2, 2), box(4, 0, 6, 2)],
    "overlapping tops": [box(0, 0, 3, 2), box(2, 1, 6, 2)],
    "identical": [box(0, 0, 2, 2)] * 3,
    "a shared vertex": [box(0, 0, 2, 2), box(2, 2, 4, 4)],
    "a shared edge": [box(0, 0, 2, 2), box(2, 0, 4, 2)],
    "inside, with a common edge": [box(0, 0, 4, 4), box(1, 0, 2, 2)],
    "triangles about one vertex": [([(0, 0), (3, 0), (3, 1)], []), ([(0, 0), (0, 3), (-1, 3)], [])],
}


@pytest.mark.parametrize("name", COINCIDENT)
def test_coincident_surfaces_count_once(name: str) -> None:
    for robot in ([ROBOT], [box(0, 0, 1, 1), box(0, 1, 1, 2)], [box(0, 0, 1, 2), box(0, 0, 1, 1)]):
        plain = PlainScene(robot, COINCIDENT[name])
        result = built(plain)
        wrong = [line for k in range(12) for line in mistakes(plain, result, 0.05 + 0.52 * k)]
        assert not wrong
        cut = result.slice(0.777)
        assert (
            slit_length(np.concatenate([cut.segments, cut.segments[:, ::-1]]), 1e-9) / 2 <= length(cut.segments) + 1e-9
        )
        assert owners(result) == owners(built(PlainScene(robot[::-1], COINCIDENT[name][::-1])))


# --- odd scenes ---


def test_without_obstacles_nothing_is_forbidden() -> None:
    result = built(PlainScene([ROBOT], []))
    assert len(result.patches) == len(result.trapezoids) == 0
    assert result.slice(1.0).segments.shape == (0, 2, 2)
    assert result.slice(1.0).forbidden.is_empty


def test_bounds_alone_are_four_walls() -> None:
    result = built(PlainScene([ROBOT], [], bounds=(0, 0, 3, 2)))
    assert [patch.kind for patch in result.patches] == ["bound"] * 4
    for angle in (*ANGLES, 0.0, math.pi / 2, math.pi):
        assert math.isclose(length(result.slice(angle).segments), 10)
        assert shapely.Point(1, 1).within(shapely.box(*result.features.rim) - result.slice(angle).forbidden)


def test_a_robot_bigger_than_the_bounds_still_moves_its_reference_point() -> None:
    plain = PlainScene([box(-50, -50, 50, 50)], [box(60, 60, 61, 61)], bounds=(0, 0, 20, 20))
    assert not [line for k in range(8) for line in mistakes(plain, built(plain), 0.2 + 0.7 * k)]


def test_covered_bounds_leave_no_boundary() -> None:
    result = built(PlainScene([ROBOT], [box(-20, -20, 20, 20)], bounds=(0, 0, 1, 1)))
    assert result.stats.live_patches == 0
    assert shapely.box(0, 0, 1, 1).within(result.slice(1.0).forbidden)


def test_a_workspace_smaller_than_the_robot_leaves_no_boundary() -> None:
    result = built(PlainScene([box(0, 0, 5, 5)], [], workspace=box(0, 0, 4, 4)))
    assert result.stats.live_patches == 0


def test_holes_of_the_workspace_are_forbidden() -> None:
    holes = [box(3, 3, 4, 4)[0][::-1], box(8, 8, 9, 9)[0][::-1]]
    plain = PlainScene([ROBOT], [], workspace=(box(0, 0, 20, 20)[0], holes))
    assert not [line for k in range(8) for line in mistakes(plain, built(plain), 0.2 + 0.7 * k)]


def stars(scale: float, offset: float) -> PlainScene:
    plain = random_scene(5, "overlapping")
    return PlainScene(
        [scaled(shape, scale) for shape in plain.robot],
        [moved(scaled(shape, scale), offset, offset) for shape in plain.obstacles],
    )


@pytest.mark.parametrize("scale", [1e-150, 1e-6, 1e6, 1e30])
def test_tiny_and_huge_coordinates_give_the_same_boundary(scale: float) -> None:
    first, result = built(stars(1.0, 0.0)), built(stars(scale, 0.0))
    assert first.stats.live_patches == result.stats.live_patches
    assert np.allclose(lengths(first), np.divide(lengths(result), scale))


@pytest.mark.slow
@pytest.mark.parametrize(("scale", "offset"), [(1.0, 1e6), (1e-6, 1.0), (1.0, -1e9)])
def test_coordinates_far_from_the_origin_agree(scale: float, offset: float) -> None:
    plain = stars(scale, offset)
    result = built(plain)
    near = PlainScene(
        plain.robot,
        [
            mapped(shape, lambda x, y: (Fraction(x) - Fraction(offset), Fraction(y) - Fraction(offset)))
            for shape in plain.obstacles
        ],
    )
    assert not [line for k in range(6) for line in mistakes(near, built(near), 0.2 + k)]
    assert result.stats.live_patches == built(near).stats.live_patches
    assert np.allclose(lengths(result), lengths(built(near)), rtol=1e-6)


def test_thirds_are_exact() -> None:
    # a slot as wide as the robot, 1/3: both sides of it are live, and they lie on each other
    third = Fraction(1, 3)
    cut = built(PlainScene([box(0, 0, third, 1)], [box(-1, 0, 0, 2), box(third, 0, 1, 2)])).slice({"tau": "1/1000000"})
    assert cut.forbidden.geom_type == "Polygon"
    assert math.isclose(cut.forbidden.area, 7, rel_tol=1e-5)  # from x = -4/3 to 1, from y = -1 to 2


@pytest.mark.parametrize("n", range(3, 9))
def test_float_regular_polygons_are_decided(n: int) -> None:
    for m in (3, 4, 6, n):
        obstacles = [regular(m, 1, (3.0, 1.0)), regular(m, 2, (-3.0, 1.5)), regular(n, 1, (0.0, 3.0))]
        plain = PlainScene([regular(n)], obstacles)
        result = built(plain)
        assert not [line for k in range(4) for line in mistakes(plain, result, 0.3 + 1.5 * k)]


# --- threads, progress, interruption ---


def test_any_number_of_threads_gives_the_same_bytes(tmp_path: Path) -> None:
    for kind in KINDS:
        scene = scene_of(random_scene(7, kind))
        texts = []
        for threads in (1, 2, 5):
            path = tmp_path / f"{threads}.npz"
            save(boundary(scene, threads=threads), path)
            texts.append(path.read_bytes())
        assert texts[0] == texts[1] == texts[2], kind


def test_threads_below_one_are_refused() -> None:
    with pytest.raises(ValueError, match="at least 1"):
        boundary(scene_of(random_scene(0, "convex")), threads=0)


def test_progress_rises_from_0_to_1() -> None:
    seen: list[float] = []
    boundary(load_scene(TESTS.parent / "examples" / "scenes" / "benchmr_warehouse.json"), progress=seen.append)
    assert seen == sorted(seen)
    assert seen[0] >= 0 and seen[-1] == 1.0  # a fast machine is done before the first tenth of a second


def test_an_exception_in_progress_stops_the_work() -> None:
    def fail(_: float) -> None:
        raise RuntimeError("enough")

    start = time.perf_counter()
    with pytest.raises(RuntimeError, match="enough"):
        boundary(load_scene(TESTS.parent / "examples" / "scenes" / "benchmr_warehouse.json"), progress=fail)
    assert time.perf_counter() - start < 5


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_ctrl_c_stops_within_a_second() -> None:
    program = """
import sys
sys.path.insert(0, "benchmarks")
import families
from cfree import Polygon, Scene, boundary
arrays = families.grid(5000)
scene = Scene(robot=[arrays.robot], obstacles=[Polygon(ring) for ring in arrays.rings()])
boundary(scene, progress=lambda share: print("working", flush=True))
print("done", flush=True)
"""
    child = subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=TESTS.parent
    )
    assert child.stdout is not None and child.stderr is not None
    assert child.stdout.readline() == "working\n"
    child.send_signal(signal.SIGINT)
    start = time.perf_counter()
    output, errors = child.communicate(timeout=20)
    assert time.perf_counter() - start < 5  # a second, and a busy machine
    assert "KeyboardInterrupt" in errors
    assert "done" not in output


def test_repr_and_types() -> None:
    result = boundary(Scene(robot=[(0, 0), (1, 0), (0, 1)], obstacles=[Polygon([(3, 3), (5, 3), (4, 5)])]))
    assert repr(result) == f"Boundary(18 of 18 contact patches live, {len(result.trapezoids)} trapezoids)"
    with pytest.raises(ValueError, match="read-only"):
        result.trapezoids.patch[0] = 1


def test_a_limit_after_the_last_patch_leaves_no_isolated_part_out() -> None:
    squares = [[(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)] for x in range(0, 12, 2) for y in range(0, 12, 2)]
    features = scene_features(Scene(squares[0], squares))
    found = _core.compute_boundary(features.core, 1, False, lambda share: share < 1)
    assert found.trimmed.all() and len(found.isolated.parts.patch) == 40


def test_a_limit_leaves_a_boundary_that_answers_nothing(tmp_path: Path) -> None:
    scene = load_scene(TESTS.parent / "examples/scenes/benchmr_warehouse.json")
    for limit in ({"max_seconds": 0.0}, {"max_memory": 1.0}):
        assert not boundary(scene, threads=1, **limit).trimmed.any()
    for part in (boundary(scene, threads=1, max_seconds=0.0), part_of(scene_of(star_among_squares()))):
        assert not part.complete
        assert "INCOMPLETE" in repr(part)
        questions = (
            lambda part=part: part.slice(0.1),
            lambda part=part: part.complex,
            lambda part=part: part.mesh(0.1),
        )
        for ask in questions:
            with pytest.raises(IncompleteError, match=r"of [\d,]+ patches trimmed"):
                ask()
        save(part, tmp_path / "part.npz")
        loaded = load_boundary(tmp_path / "part.npz")
        assert not loaded.complete and np.array_equal(loaded.trimmed, part.trimmed)
    assert 0 < part.trimmed.sum() < len(part.trimmed)
    whole = boundary(part.scene)
    assert whole.complete
    done = np.isin(whole.trapezoids.patch, np.flatnonzero(part.trimmed))
    assert np.array_equal(whole.trapezoids.lower[done], part.trapezoids.lower)  # what was done is right


@pytest.mark.slow
def test_what_was_done_before_a_limit_is_right_wherever_it_falls() -> None:
    scene = scene_of(star_among_squares())
    whole = boundary(scene)
    assert whole.complete
    for _ in range(20):
        part = part_of(scene)
        assert 0 < part.trimmed.sum() < len(part.trimmed)
        done = np.isin(whole.trapezoids.patch, np.flatnonzero(part.trimmed))
        assert np.array_equal(whole.trapezoids.patch[done], part.trapezoids.patch)
        assert np.array_equal(whole.trapezoids.lower[done], part.trapezoids.lower)
