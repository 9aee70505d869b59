"""Boundaries of rounded shapes, against regions that shapely makes of their cores, and against closed formulas."""

from __future__ import annotations

import math
import pickle
import random
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import shapely

import cfree
from cfree import Curved, Pose, Scene, UnsupportedError, boundary, free_space
from cfree.curves import Arc
from cfree.forbidden.kinds import PatchKind
from cfree.polygons.polygon import Polygon
from rounded_scenes import DISCS, ELL, MIXED, ONE_RADIUS, SCENES, SQUARE, TRIANGLE, disc, grown, pieces, random_scene


def region(scene: Scene, theta: float) -> Any:
    """The forbidden positions at an orientation, by shapely: sums of pieces, grown by discs of 512 sides."""
    c, s = math.cos(theta), math.sin(theta)
    parts = []
    for obstacle in scene.obstacles:
        for robot in scene.robot:
            (ones, r), (others, rho) = pieces(robot), pieces(obstacle)
            for one in ones:
                turned = one @ np.array([[c, s], [-s, c]])
                for other in others:
                    points = (other[:, None] - turned[None]).reshape(-1, 2)
                    parts.append(shapely.MultiPoint(points).convex_hull.buffer(r + rho, quad_segs=128))
    return shapely.union_all(parts)


CRITICAL = 0.0, math.pi / 2


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_slices_are_the_grown_sums_of_the_cores(name: str) -> None:
    scene = SCENES[name]
    result = boundary(scene)
    for theta in [*CRITICAL, -1e-6, *np.linspace(0.1, 6.2, 9).tolist()]:
        cut = result.slice(theta)
        expected = region(scene, theta)
        off = cut.forbidden.symmetric_difference(expected).area
        assert off < 3 * cut.forbidden.length * (cut.error + 1e-4), (name, theta)
        around = shapely.boundary(expected)
        points = np.concatenate(cut.lines)
        assert shapely.distance(shapely.points(points), around).max() < 1e-3, (name, theta)
        if theta in CRITICAL:
            continue  # a gap without width has two sides here
        length = sum(shapely.LineString(line).length for line in cut.lines)
        assert math.isclose(length, around.length, rel_tol=1e-3), (name, theta)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(8))
def test_random_scenes_have_the_slices_of_their_cores(seed: int) -> None:
    scene = random_scene(seed)
    result = boundary(scene)
    space = free_space(result)
    assert np.all(result.complex.euler % 2 == 0)
    rng = random.Random(seed)
    for _ in range(4):
        theta = rng.uniform(0, math.tau)
        cut, expected = result.slice(theta), region(scene, theta)
        assert cut.forbidden.symmetric_difference(expected).area < 3 * expected.length * (cut.error + 1e-4)
        x0, y0, x1, y1 = expected.bounds
        for _ in range(10):
            x, y = rng.uniform(x0, x1), rng.uniform(y0, y1)
            if shapely.boundary(expected).distance(shapely.Point(x, y)) > 1e-2:
                assert (space.locate((x, y, theta)) == -1) == expected.contains(shapely.Point(x, y))


def test_boundary_has_the_same_bytes_for_any_number_of_threads() -> None:
    one, three = (boundary(MIXED, threads=n) for n in (1, 3))
    assert one == three
    assert all(
        getattr(one.trapezoids, c).tobytes() == getattr(three.trapezoids, c).tobytes() for c in ("lower", "to_lo")
    )


@pytest.mark.slow
@pytest.mark.parametrize("seed", [400, 402, 6, 12])
def test_critical_angles_are_as_narrow_as_doubles_allow(seed: int) -> None:
    """In the scene of seed 400 exact roots decide, whose isolating intervals are a quarter of a chart wide."""
    table = boundary(random_scene(seed)).trapezoids
    assert max((table.to_hi - table.to_lo).max(), (table.from_hi - table.from_lo).max()) < 2**-36


def test_boundary_is_pickled() -> None:
    result = boundary(MIXED)
    again = pickle.loads(pickle.dumps(result))
    assert again == result
    assert again.complex.euler.tolist() == result.complex.euler.tolist()


def test_patches_are_named_and_evaluated() -> None:
    result = boundary(MIXED)
    kinds = {patch.kind for patch in result.patches}
    assert kinds == {"v-e", "e-v", "arc-arc"}
    arc = next(patch for patch in result.patches if patch.kind == "arc-arc" and patch.is_live)
    assert arc.quadrant in range(4)
    t, phi = np.array([0.0, 0.5, 1.0]), np.full(3, 0.3)
    xy = result.evaluate(np.full(3, arc.index), t, phi)
    assert np.allclose(arc.surface(t, phi)[:, :2], xy)
    centre = result.ruled[arc.index]
    c, s = math.cos(0.3), math.sin(0.3)
    middle = centre[:2] - [c * centre[4] - s * centre[5], s * centre[4] + c * centre[5]]
    assert np.allclose(np.hypot(*(xy - middle).T), result.patch_radius[arc.index])
    assert result.patch_counts.contacts == len(result.patches)


def test_trapezoids_name_their_curves_and_angles() -> None:
    result = boundary(MIXED)
    parts = [result.trapezoid(k) for k in range(len(result.trapezoids))]
    names = {curve.kind for part in parts for curve in (part.lower, part.upper)}
    assert names <= {"v-e", "e-v", "arc-arc", "axis"}
    assert {angle.kind for part in parts for angle in (part.start, part.stop)} <= {
        "chart end", "parallel", "crossing", "touch"
    }  # fmt: skip
    assert {part.upper.obstacle.name for part in parts} == {"obstacle 0", "obstacle 1", "obstacle 2"}


@pytest.mark.parametrize("name", SCENES)
def test_live_parts_are_within_the_ranges_of_their_patches(name: str) -> None:
    result = boundary(SCENES[name])
    table = result.trapezoids
    middle = (table.theta_from + table.theta_to) / 2
    start, width = (x[table.patch] for x in (result.phi_min, result.phi_range))
    assert np.all(np.mod(middle - start, math.tau) <= width + 1e-9)


@pytest.mark.slow
def test_points_of_patches_are_in_contact() -> None:
    """Their shapes are as far apart as nothing: no pose nearer to the centre is free."""
    result = boundary(ONE_RADIUS)
    table = result.trapezoids
    theta = (table.theta_from + table.theta_to) / 2
    lower, upper = result.limits(np.arange(len(table)), theta)
    wide = (upper - lower > 1e-6) & (table.theta_to - table.theta_from > 1e-6)
    xy = result.evaluate(table.patch, (lower + upper) / 2, theta)
    off = [shapely.boundary(region(ONE_RADIUS, th)).distance(shapely.Point(p)) for th, p in
           zip(theta[wide].tolist()[::7], xy[wide][::7], strict=True)]  # fmt: skip
    assert max(off) < 1e-3


CONVEX = [
    (TRIANGLE, "1/10", SQUARE, "1/3"),
    (SQUARE, "1/2", SQUARE, "1/2"),
    (SQUARE, 0, TRIANGLE, "2/7"),
]


@pytest.mark.parametrize(("robot", "r", "obstacle", "s"), CONVEX)
def test_volume_of_a_convex_pair_is_its_closed_formula(robot: Any, r: Any, obstacle: Any, s: Any) -> None:
    scene = Scene(grown(robot, r) if r else robot, [grown(obstacle, s)], bounds=(-10, -10, 10, 10))
    space = free_space(boundary(scene))
    (A, B), rho = (shapely.Polygon(robot), shapely.Polygon(obstacle)), float(Fraction(r) + Fraction(s))
    lengths = A.length + B.length
    forbidden = (
        math.tau * (A.area + B.area) + A.length * B.length + math.tau * rho * lengths + math.tau * math.pi * rho**2
    )
    assert abs(float(space.volumes.sum()) - (math.tau * 400 - forbidden)) < 1e-9
    assert space.volume_errors.sum() < 1e-9


def test_volume_and_area_of_two_discs() -> None:
    space = free_space(boundary(Scene(disc("1/2", 0, 1), [disc(3, 0, 2)], bounds=(-9, -9, 9, 9))))
    assert abs(float(space.volumes.sum()) - math.tau * (18 * 18 - math.pi * 9)) < 1e-9
    # a cylinder that is sheared: the area element is 3 sqrt(1 + (sin(psi) / 2)^2)
    psi = np.linspace(0, math.tau, 20001)[:-1]
    expected = math.tau * 3 * float(np.sqrt(1 + (np.sin(psi) / 2) ** 2).mean()) * math.tau
    unbounded = free_space(boundary(Scene(disc("1/2", 0, 1), [disc(3, 0, 2)])))
    assert abs(float(unbounded.areas().sum()) - expected) < 1e-9


def test_curvature_of_a_torus_adds_up_with_its_smooth_joints() -> None:
    """Two discs touch in one smooth torus: the integral of K is 0."""
    from cfree.geometry import trapezoid_curvatures

    result = boundary(Scene(disc("1/2", "1/3", 1), [disc(3, 0, 2)]))
    assert abs(float(trapezoid_curvatures(result).sum())) < 1e-9


@pytest.mark.slow
def test_robot_grown_is_obstacles_grown() -> None:
    others = [grown(TRIANGLE, "1/5", 4, 0), disc(0, 4, "1/2")]
    more = [grown(TRIANGLE, "3/10", 4, 0), disc(0, 4, "3/5")]
    bounds = (-9, -9, 9, 9)
    first = boundary(Scene(grown(ELL, "1/10"), others, bounds=bounds))
    second = boundary(Scene(ELL, more, bounds=bounds))
    assert first.complex.euler.tolist() == second.complex.euler.tolist()
    assert np.allclose(free_space(first).volumes, free_space(second).volumes, atol=1e-9)


def test_a_small_radius_gives_the_cells_of_polygons() -> None:
    frame = Polygon([(-4, -4), (4, -4), (4, 4), (-4, 4)], [[(-2, -2), (-2, 2), (2, 2), (2, -2)]])
    rod = [("-1", "-1/10"), (1, "-1/10"), (1, "1/10"), (-1, "1/10")]
    sharp = free_space(boundary(Scene(rod, [frame])))
    soft = free_space(boundary(Scene(grown(rod, "1e-9"), [frame])))
    assert len(sharp) == len(soft) == 2
    assert sharp.complex.euler.tolist() == soft.complex.euler.tolist()
    assert math.isclose(sharp.volumes[1], soft.volumes[1], rel_tol=1e-7)


@pytest.mark.slow
@pytest.mark.parametrize("scale", [1, "1/3"])
def test_rigid_motions_and_scalings_of_the_obstacles_change_nothing(scale: Any) -> None:
    c, s, k = Fraction(3, 5), Fraction(4, 5), Fraction(scale)

    def moved(points: Any, by: Any, turned: bool) -> Curved:
        exact = [(Fraction(x), Fraction(y)) for x, y in points]
        if turned:
            exact = [(c * x - s * y + 7, s * x + c * y - 2) for x, y in exact]
        return Curved([(k * x, k * y) for x, y in exact], grown=k * Fraction(by))

    def made(turned: bool) -> Any:
        others = [moved(ELL, "1/5", turned), moved([(x + 4, y) for x, y in TRIANGLE], "1/10", turned)]
        return boundary(Scene(moved(TRIANGLE, "1/10", False), others))

    plain, turned = made(False), made(True)
    assert plain.complex.euler.tolist() == turned.complex.euler.tolist()
    areas = [float(free_space(b).areas(angle_scale=float(k)).sum()) / float(k) ** 2 for b in (plain, turned)]
    assert math.isclose(*areas, rel_tol=1e-8)


def test_poses_are_located_in_cells() -> None:
    walls = ((-3, -3, 3, -2), (-3, 2, 3, 3), (-3, -3, -2, 3), (2, -3, 3, 3))
    ring = [grown([(a, b), (c, b), (c, d), (a, d)], "1/10") for a, b, c, d in walls]
    space = free_space(boundary(Scene(disc(0, 0, 1), ring)))
    assert len(space) == 2
    assert space.cells[1].caged
    poses = [Pose(0, 0), Pose(9, 0), Pose("9/10", "9/10", "30deg"), Pose(1, 0), Pose("-2.5", 0)]
    assert space.locate(poses).tolist() == [1, 0, 1, -1, -1]
    assert [space.locate(pose) for pose in poses] == [1, 0, 1, -1, -1]
    assert space.reachable(Pose(0, 0)).index == 1
    assert space.common_cell(Pose(0, 0), Pose(9, 0)) is None


def test_a_corridor_as_wide_as_a_disc_is_in_no_cell() -> None:
    walls = [Polygon([(x, -2), (x + 3, -2), (x + 3, 2), (x, 2)]) for x in (-4, 1)]
    space = free_space(boundary(Scene(disc(0, 0, 1), walls)))
    assert len(space) == 1
    assert space.locate([(0, 0, 0), (0, 0, math.pi), (0, 3, 0)]).tolist() == [-2, -2, 0]


def test_rounded_robot_stays_in_a_workspace_of_lines() -> None:
    room = [(-3, -2), (3, -2), (3, 2), (-3, 2)]
    space = free_space(boundary(Scene(disc("1/2", 0, 1), [disc(0, 0, "1/2")], workspace=room)))
    covered = 2 * (math.sqrt(1.5**2 - 1) + 1.5**2 * math.asin(1 / 1.5))  # of a disc, between two lines
    assert abs(float(space.volumes.sum()) - math.tau * (4 * 2 - covered)) < 1e-9
    assert len(space) == 2
    assert not any(cell.caged for cell in space.cells)
    first, second = (space.locate(pose) for pose in (("-9/4", 0, 0), ("5/4", 0, 0)))
    assert {first, second} == {0, 1}
    assert space.locate([(0, 0, 0), (2, 0, 0)]).tolist() == [-1, -1]


REFUSED = {
    "ellipse": (Scene(disc(0, 0, 1), [Curved.ellipse((5, 0), (1, 2))]), "obstacle 0: not bounded by lines"),
    "cusp": (
        Scene(disc(0, 0, 1), [Curved([(0, 0), (4, 0), Arc((0, 4), center=(4, 4), clockwise=True)])]),
        "obstacle 0: not bounded by lines and arcs of rational radii, without cusps",
    ),
    "irrational radius": (
        Scene(Curved([(1, 0), Arc((0, 1), center=(0, 0)), Arc((1, 0), center=("1/2", "1/2"))]), [SQUARE]),
        r"robot: an arc of irrational radius; heal it, .* in Python by Curved.healed\(\)",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_other_round_scenes_are_refused_with_the_shape_and_a_remedy(name: str) -> None:
    scene, message = REFUSED[name]
    with pytest.raises(UnsupportedError, match=message) as refused:
        boundary(scene)
    assert "scene.outer(error)" in str(refused.value)


def test_the_checker_of_a_round_boundary_is_that_of_its_scene() -> None:
    checker = boundary(DISCS).checker
    poses = [cfree.Pose(x, 0, "30deg") for x in range(-3, 12)] + [cfree.Pose("1/2", 0), cfree.Pose("1/2", "-1e-30")]
    assert [checker.is_free(pose) for pose in poses] == cfree.is_free(DISCS, poses).tolist()
    table = np.array([[float(pose.x), float(pose.y), pose.theta] for pose in poses])
    assert cfree.is_free(checker, table).tolist() == cfree.is_free(DISCS, table).tolist()


def test_kinds_of_patches_have_colours() -> None:
    from cfree.forbidden.kinds import COLOURS, KINDS

    assert set(KINDS) == set(COLOURS) == set(PatchKind)
