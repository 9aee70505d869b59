"""Meshes: closed, within their error of the boundary, facing the free side."""

import math
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

import cfree.forbidden.mesh
import oracles
import shapes
from cfree.errors import InvariantError, UnsupportedError
from cfree.forbidden.boundary import Boundary, boundary
from cfree.forbidden.mesh import Mesh
from cfree.formats.scene_file import load_scene
from cfree.geometry.ruled import read_ruled
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene, robot_radius
from closed_meshes import check_closed
from examples import POLYGONS

ROOT = Path(__file__).parents[2]
SCENES = ROOT / "examples/scenes"
SMALL = [path for path in POLYGONS if path.stat().st_size < 20_000]
CASES = sorted((ROOT / "tests/cases").glob("*.json"))
MESHES = ROOT / "tests/cases/meshes"
ERRORS = (0.3, 0.03)  # in robot's radii


@pytest.fixture(scope="module")
def triangles() -> Boundary:
    """The paper's example without bounds: one convex pair."""
    scene = load_scene(SCENES / "paper_fig9.json")
    return boundary(Scene(robot=scene.robot, obstacles=scene.obstacles))


def make(plain: shapes.PlainScene) -> Scene:
    robot, obstacles = ([Polygon(*shape) for shape in side] for side in (plain.robot, plain.obstacles))
    workspace = Polygon(*plain.workspace) if plain.workspace else None
    return Scene(robot=robot, obstacles=obstacles, bounds=plain.bounds, workspace=workspace)


# closed surfaces


@pytest.mark.slow
@pytest.mark.parametrize("path", SMALL + CASES, ids=lambda path: path.stem)
def test_meshes_are_closed_and_close(path: Path) -> None:
    result = boundary(load_scene(path), threads=1)
    size = np.abs([result.complex.x, result.complex.y]).max(initial=0.0)
    for share in ERRORS:
        error = share * robot_radius(result.scene)
        if error < 1e-10 * size:
            with pytest.raises(UnsupportedError, match="no less than"):
                result.mesh(error)
        mesh = result.mesh(max(error, 1e-9 * size))
        check_closed(mesh, result)
        check_error(mesh, result)


@pytest.mark.slow
@pytest.mark.parametrize("kind", shapes.KINDS)
def test_random_meshes_are_closed_and_close(kind: str) -> None:
    for seed in range(4):
        result = boundary(make(shapes.random_scene(seed, kind)), threads=1)
        for share in ERRORS:
            mesh = result.mesh(share * robot_radius(result.scene))
            check_closed(mesh, result)
            check_error(mesh, result)


def test_pinched_surfaces_have_vertices_of_their_own() -> None:
    room = [(-1, -1), (6, -1), (6, 6), (-1, 6)]
    result = boundary(Scene([(-3, -1), (-4, 0), (-4, -2)], [[(1, 2), (3, 4), (1, 4)]], workspace=room))
    assert len(result.complex.pinched) > 0
    mesh = result.mesh(0.01)
    check_closed(mesh, result)
    same = np.unique(mesh.vertices, axis=0)
    assert len(same) < len(mesh.vertices)


# the error


def check_error(mesh: Mesh, result: Boundary) -> None:
    """Points of triangles are within the error of their trapezoids, as evaluated by other code."""
    height = result.trapezoids.theta_to - result.trapezoids.theta_from
    (known,) = np.nonzero((height > 1e-9)[mesh.trapezoid])  # the curves of others have no place in doubles
    chosen = np.random.default_rng(1).choice(known, size=2000 if len(known) else 0)
    weights = np.random.default_rng(2).dirichlet((1, 1, 1), len(chosen))
    weights[::2] = np.array([[1, 1, 0], [0, 1, 1], [1, 0, 1]])[chosen[::2] % 3] / 2  # there it is largest
    points = (mesh.vertices[mesh.triangles[chosen]] * weights[..., None]).sum(axis=1)
    distance = distances(result, mesh.trapezoid[chosen], points, mesh.angle_scale, mesh.error)
    rounding = 1e-13 * np.abs(mesh.vertices).max(initial=0.0)
    assert distance.max(initial=0.0) <= mesh.error * (1 + 1e-6) + rounding


def distances(result: Boundary, trapezoid: Any, points: Any, scale: float, reach: float, steps: int = 41) -> Any:
    """Upper bounds of the distances to trapezoids: to the segments of slices near by."""
    table = result.trapezoids
    least = np.full(len(points), np.inf)
    for k in np.linspace(-1, 1, steps):
        theta = points[:, 2] / scale + k * reach / scale
        theta = np.clip(theta, table.theta_from[trapezoid], table.theta_to[trapezoid])
        a, b = (result.evaluate(table.patch[trapezoid], t, theta) for t in result.limits(trapezoid, theta))
        along = ((points[:, :2] - a) * (b - a)).sum(axis=1)
        length = ((b - a) ** 2).sum(axis=1)
        share = np.divide(along, length, out=np.zeros_like(along), where=length > 0).clip(0, 1)
        foot = a + share[:, None] * (b - a)
        across = points[:, :2] - foot
        least = np.minimum(least, np.hypot(np.hypot(*across.T), scale * theta - points[:, 2]))
    return least


@pytest.mark.parametrize(
    ("path", "error", "scale"),
    [
        (MESHES / "vertices_that_nearly_meet.json", 0.05, 2**0.5),
        (MESHES / "vertices_that_nearly_meet.json", 0.055, 1.5),
        (SCENES / "comb_hook.json", 0.2, 1.0),
        (ROOT / "tests/cases/zero_width/needle.json", 0.23, 4.0),
    ],
    ids=lambda value: getattr(value, "stem", str(value)),
)
def test_chords_of_curves_are_as_short_as_faces_need(path: Path, error: float, scale: float) -> None:
    """At these errors a chord within 7/10 of the error of its curve was beyond the bound of its face."""
    result = boundary(load_scene(path), threads=1)
    mesh = result.mesh(error, angle_scale=scale)
    check_closed(mesh, result)
    check_error(mesh, result)


@pytest.mark.parametrize("name", ["nearly_collinear_chain", "few_doubles_between_angles", "sliver_between_boxes"])
def test_triangles_of_thin_trapezoids_are_as_near_as_theory_says(name: str) -> None:
    result = boundary(load_scene(MESHES / f"{name}.json"), threads=1)
    mesh, table = result.mesh(0.05, angle_scale=1.5), result.trapezoids
    thin = (table.theta_to - table.theta_from < 1e-9)[mesh.trapezoid]
    assert thin.any()
    corners = mesh.vertices[mesh.triangles[thin]]
    theta = corners[..., 2] / mesh.angle_scale
    surface = read_ruled(result.ruled[mesh.patch[thin], None])
    start = result.evaluate(mesh.patch[thin, None], np.zeros_like(theta), theta)
    t = ((corners[..., :2] - start) * surface.ruling(theta)).sum(axis=-1) / surface.L
    radius = np.hypot(*result.features.robot.xy.T).max()
    for weights in np.random.default_rng(4).dirichlet((1, 1, 1), 20):
        at = result.evaluate(mesh.patch[thin], t @ weights, theta.mean(axis=1))
        off = np.linalg.norm(weights @ corners[..., :2] - at, axis=-1)
        assert off.max() <= 2e-9 * radius + 1e-13 * abs(corners).max()


@pytest.mark.parametrize("scale", [0.2, 1.0, 5.0])
def test_error_holds_in_the_metric_asked_for(triangles: Boundary, scale: float) -> None:
    for error in (0.2, 0.02, 0.002):
        mesh = triangles.mesh(error, angle_scale=scale)
        check_closed(mesh, triangles)
        check_error(mesh, triangles)


def test_robots_far_from_their_reference_point(triangles: Boundary) -> None:
    for shift in (5, 40):
        robot = [(x + shift, y - 3) for x, y in [(-1, -0.6), (1.2, -0.4), (-0.3, 1)]]
        result = boundary(Scene(robot=robot, obstacles=triangles.scene.obstacles))
        for scale in (1.0, float(shift)):
            mesh = result.mesh(0.05, angle_scale=scale)
            check_closed(mesh, result)
            check_error(mesh, result)


@pytest.mark.parametrize(
    "name", ["paper_fig9", "five_convex", "degenerate_island", "degenerate_hexagons", "sofa_corner"]
)
def test_every_point_of_the_boundary_is_near_the_mesh(name: str) -> None:
    # the other half of a Hausdorff distance: points within trapezoids and on their sides, to their own triangles
    result = boundary(load_scene(SCENES / f"{name}.json"), threads=1)
    for share in (0.1, 0.003):
        mesh = result.mesh(share * robot_radius(result.scene))
        worst = farthest_from_mesh(mesh, result, 1500)
        assert worst <= mesh.error * (1 + 1e-6)
        assert share > 0.01 or worst > 0.6 * mesh.error


def farthest_from_mesh(mesh: Mesh, result: Boundary, count: int) -> float:
    """The greatest distance of random points of the boundary to the triangles of their trapezoids."""
    rng, table = np.random.default_rng(3), result.trapezoids
    height = table.theta_to - table.theta_from
    k = rng.choice(np.flatnonzero(height > 1e-9), count)
    theta = table.theta_from[k] + height[k] * rng.choice([0, 1, 0.5, *rng.uniform(size=9)], count)
    lower, upper = result.limits(k, theta)
    t = lower + (upper - lower) * rng.choice([0, 1, 0.5, *rng.uniform(size=9)], count)
    points = np.column_stack([result.evaluate(table.patch[k], t, theta), mesh.angle_scale * theta])
    order = np.argsort(mesh.trapezoid, kind="stable")
    start = np.searchsorted(mesh.trapezoid[order], np.arange(len(table) + 1))
    counts = (start[1:] - start[:-1])[k]
    of = np.repeat(np.arange(count), counts)
    which = order[np.repeat(start[k], counts) + np.arange(len(of)) - np.repeat(np.cumsum(counts) - counts, counts)]
    corners = mesh.vertices[mesh.triangles[which]]
    closest = trimesh.triangles.closest_point(corners, points[of])
    least = np.full(count, np.inf)
    np.minimum.at(least, of, np.linalg.norm(closest - points[of], axis=1))
    return float(least.max())


@pytest.mark.slow
@pytest.mark.parametrize(("scale", "error"), [(0.3, 2e-4), (1.0, 3e-4)])
def test_vertices_off_the_surface_keep_both_bounds_and_save_triangles(
    triangles: Boundary, scale: float, error: float
) -> None:
    result = triangles
    for each in (100 * error, error):
        on, off = (result.mesh(each, angle_scale=scale, off_surface=which) for which in (False, True))
        check_closed(off, result)
        check_error(off, result)
        assert farthest_from_mesh(off, result, 300) <= each * (1 + 1e-6)
    assert off.ratio < 0.985 * on.ratio
    of = np.repeat(np.arange(len(off.triangles)), 3)
    apart = distances(result, off.trapezoid[of], off.vertices[off.triangles].reshape(-1, 3), scale, error)
    lifted = apart > 1e-6
    assert lifted.mean() > 0.2 and np.quantile(apart[lifted], [0.1, 0.9]) == pytest.approx(error / 3, rel=0.05)
    rim = np.isin(np.arange(len(off.vertices)), np.unique(off.seam))
    assert not np.isin(off.triangles.ravel()[lifted], np.flatnonzero(rim)).any()


def test_vertices_next_to_a_side_stay_on_the_surface_where_it_is_steep() -> None:
    # a third of the error in space is more than all of it within a slice, which is what counts there
    result = boundary(make(shapes.random_scene(104, "axis_parallel")))
    mesh = result.mesh(0.03 * robot_radius(result.scene), angle_scale=0.3, off_surface=True)
    check_closed(mesh, result)
    check_error(mesh, result)


def test_half_the_error_is_not_met(triangles: Boundary) -> None:
    # the bound is sharp: with few triangles to spare, some points are almost as far as allowed
    mesh = triangles.mesh(0.001)
    middles = mesh.vertices[mesh.triangles][:, [0, 1]].mean(axis=1)
    distance = distances(triangles, mesh.trapezoid, middles, mesh.angle_scale, mesh.error)
    assert distance.max() > 0.95 * mesh.error


# how many triangles


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "limits"),
    [("paper_fig9", {1e-2: 1.34, 1e-3: 1.2, 1e-4: 1.13}), ("degenerate_hexagons", {1e-2: 1.48, 1e-3: 1.22})],
)
def test_how_many_triangles_more_than_the_best_known_density_asks_for(name: str, limits: dict[float, float]) -> None:
    result = boundary(load_scene(SCENES / f"{name}.json"))
    radius = robot_radius(result.scene)
    ratios = [result.mesh(share * radius).ratio for share in limits]
    assert ratios == sorted(ratios, reverse=True)
    assert all(ratio < limit for ratio, limit in zip(ratios, limits.values(), strict=True))


def ratios_of_large_patches(mesh: Mesh, result: Boundary) -> Any:
    """Triangles of the e-v patches that have at least a hundred, as multiples of the best known density's."""
    table, patches = result.trapezoids, len(result.patch_kind)
    f = np.flatnonzero(result.patch_kind[table.patch] == 2)
    nodes, weights = np.polynomial.legendre.leggauss(8)
    high = (table.theta_to - table.theta_from)[f]
    theta = table.theta_from[f, None] + high[:, None] * (nodes + 1) / 2
    lower, upper = result.limits(np.repeat(f, 8), theta.ravel())
    ruled = np.repeat(result.ruled[table.patch[f]], 8, axis=0)
    length = np.hypot(*ruled[:, 6:8].T)
    start = (ruled[:, 4:6] * ruled[:, 6:8]).sum(axis=1) / length
    u = [np.arcsinh((start + t * length) / mesh.angle_scale) for t in (lower, upper)]
    wide = (u[1] - u[0]).reshape(-1, 8) @ weights / 2
    least = np.bincount(table.patch[f], math.sqrt(3) / 8 * mesh.angle_scale * high * wide / mesh.error, patches)
    assert least.sum() == pytest.approx(mesh.least, rel=1e-3)
    count = np.bincount(mesh.patch[mesh.kind == 2], minlength=patches)
    return count[count >= 100] / least[count >= 100]


@pytest.mark.parametrize(("corners", "middle", "most"), [((3, 4), 1.23, 1.6), ((5, 7), 1.32, 1.75)])
def test_large_patches_of_convex_pairs_are_near_the_best_known_density(
    corners: tuple[int, int], middle: float, most: float
) -> None:
    rng, found = random.Random(1), []
    for _ in range(3):
        shapes_of_pair = [
            [(r * math.cos(a), r * math.sin(a)) for a in sorted(rng.uniform(0, 2 * math.pi) for _ in range(n))]
            for n, r in zip(corners, (1, 1.5), strict=True)
        ]
        result = boundary(Scene(robot=shapes_of_pair[0], obstacles=[shapes_of_pair[1]]))
        found.extend(ratios_of_large_patches(result.mesh(0.001 * robot_radius(result.scene)), result))
    assert len(found) > 20
    assert np.median(found) < middle and max(found) < most


@pytest.mark.parametrize(("kind", "middle"), [("nonconvex", 1.6), ("workspace", 1.6)])
def test_large_patches_cut_by_others_need_more_for_their_curves(kind: str, middle: float) -> None:
    result = boundary(make(shapes.random_scene(1, kind)), threads=1)
    found = ratios_of_large_patches(result.mesh(0.001 * robot_radius(result.scene)), result)
    assert len(found) > 20 and np.median(found) < middle and min(found) < 1.25


def test_no_scene_needs_more_than_it_did_with_fewer_ways_to_lay_out_points() -> None:
    # counts at a hundredth of the robot's radius with rows and lattices, but neither columns nor bounds by edges
    for name, before in (
        ("paper_fig9", 1138),
        ("five_convex", 7868),
        ("degenerate_hexagons", 4789),
        ("comb_hook", 4378),
        ("degenerate_island", 2936),
    ):
        result = boundary(load_scene(SCENES / f"{name}.json"))
        assert len(result.mesh(0.01 * robot_radius(result.scene)).triangles) < before


def test_meshes_do_not_depend_on_the_number_of_threads() -> None:
    scene = load_scene(SCENES / "degenerate_island.json")
    assert boundary(scene, threads=1).mesh(0.01) == boundary(scene, threads=3).mesh(0.01)


def test_least_is_the_formula_of_theory(triangles: Boundary) -> None:
    # (sqrt 3 / 8) w phi_range [arsinh(s / w)] / error for each whole e-v patch
    mesh = triangles.mesh(0.01, angle_scale=0.7)
    robot, expected = triangles.scene.robot[0], 0.0
    for patch in triangles.patches:
        if patch.kind == "e-v":
            a, edge = robot.vertices[patch.robot.index], robot.edge(patch.robot.index)
            length = np.hypot(*edge)
            ends = np.array([a @ edge / length, a @ edge / length + length])
            expected += math.sqrt(3) / 8 * 0.7 * patch.phi_range * np.ptp(np.arcsinh(ends / 0.7)) / 0.01
    assert mesh.least == pytest.approx(expected, rel=1e-6)
    assert mesh.ratio == np.count_nonzero(mesh.kind == 2) / mesh.least


def test_patches_without_twist_are_strips(triangles: Boundary) -> None:
    # of a v-e surface every vertex is on the rim of its trapezoid
    mesh = triangles.mesh(0.001)
    count = np.bincount(mesh.trapezoid)
    strip = np.flatnonzero((np.bincount(mesh.trapezoid, mesh.kind == 1) > 0) & (count > 8))
    assert len(strip) > 5
    for k in strip:
        corners = mesh.triangles[mesh.trapezoid == k]
        assert len(np.unique(corners)) == len(corners) + 2


def test_errors_that_make_no_sense_are_refused(triangles: Boundary) -> None:
    for wrong in (0, -1, math.inf, math.nan):
        with pytest.raises(ValueError, match=r"error: .* above 0"):
            triangles.mesh(wrong)
        with pytest.raises(ValueError, match=r"angle_scale: .* above 0"):
            triangles.mesh(0.1, angle_scale=wrong)


def test_meshes_too_large_are_refused_before_they_are_made(
    triangles: Boundary, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(UnsupportedError, match=r"about .* triangles, more than 10,000,000; an error of .* is possible"):
        triangles.mesh(1e-9)
    monkeypatch.setattr(cfree.forbidden.mesh, "MOST_TRIANGLES", 3000)
    with pytest.raises(UnsupportedError, match="is possible") as raised:
        triangles.mesh(1e-4)
    possible = float(str(raised.value).split("an error of ")[1].split()[0])
    assert len(triangles.mesh(possible).triangles) <= 3000
    monkeypatch.setattr(cfree.forbidden.mesh, "MOST_TRIANGLES", 10)
    with pytest.raises(UnsupportedError, match="with any error; mesh a smaller scene"):
        triangles.mesh(1.0)


def test_estimates_are_near_the_truth(triangles: Boundary, monkeypatch: pytest.MonkeyPatch) -> None:
    meshes = [triangles.mesh(error) for error in (0.1, 0.01, 0.001)]
    for mesh in meshes:
        monkeypatch.setattr(cfree.forbidden.mesh, "MOST_TRIANGLES", len(mesh.triangles) // 2)
        with pytest.raises(UnsupportedError):
            triangles.mesh(mesh.error)
        monkeypatch.setattr(cfree.forbidden.mesh, "MOST_TRIANGLES", 2 * len(mesh.triangles))
        triangles.mesh(mesh.error)


def test_a_fault_of_the_core_is_named(triangles: Boundary, monkeypatch: pytest.MonkeyPatch) -> None:
    from cfree import _core

    def broken(*_: object) -> None:
        raise RuntimeError("no triangles close enough on trapezoid 3")

    monkeypatch.setattr(_core, "mesh", broken)
    with pytest.raises(InvariantError, match="trapezoid 3"):
        triangles.mesh(0.1)


# one convex pair


def normals(mesh: Mesh) -> Any:
    """Normals of the triangles, as long as twice their areas."""
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def test_counts_of_the_papers_example(triangles: Boundary) -> None:
    mesh = triangles.mesh(0.1)
    assert set(mesh.patch) == set(range(18))
    assert np.array_equal(mesh.kind, triangles.patch_kind[mesh.patch]) and set(mesh.kind) == {1, 2}
    assert np.array_equal(mesh.patch, triangles.trapezoids.patch[mesh.trapezoid])
    assert set(np.unique(mesh.triangles)) == set(range(len(mesh.vertices)))


@pytest.mark.slow
@pytest.mark.parametrize("scale", [1.0, 2.5])
def test_volume_inside_is_that_of_theory(triangles: Boundary, scale: float) -> None:
    # divergence theorem for (x, y, 0) / 2: the sections at the seam do not count
    mesh = triangles.mesh(2e-4, angle_scale=scale)
    middle = mesh.vertices[mesh.triangles].mean(axis=1)
    volume = 0.25 * float((middle[:, :2] * normals(mesh)[:, :2]).sum())
    (robot,), (obstacle,) = triangles.scene.robot, triangles.scene.obstacles
    expected = scale * (2 * math.pi * (robot.area + obstacle.area) + robot.perimeter * obstacle.perimeter)
    assert volume == pytest.approx(expected, rel=1e-4)


@pytest.mark.slow
def test_areas_of_edge_vertex_patches_are_those_of_theory(triangles: Boundary) -> None:
    # docs/theory/errata.md: area = phi_range * integral of sqrt(1 + s^2) ds along the robot's edge, angle_scale 1
    mesh = triangles.mesh(2e-4, angle_scale=1)
    area = np.bincount(mesh.patch, 0.5 * np.linalg.norm(normals(mesh), axis=1))
    robot = triangles.scene.robot[0]
    for patch in triangles.patches:
        if patch.kind == "e-v":
            a, edge = robot.vertices[patch.robot.index], robot.edge(patch.robot.index)
            length = np.hypot(*edge)
            ends = np.array([a @ edge / length, a @ edge / length + length])
            low, high = 0.5 * (ends * np.sqrt(1 + ends**2) + np.arcsinh(ends))
            assert area[patch.index] == pytest.approx(patch.phi_range * (high - low), rel=3e-3)


# any scene


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["nonconvex", "holed", "overlapping", "several_robots", "bounds", "workspace"])
def test_triangles_lie_on_the_boundary_and_face_the_free_side(kind: str) -> None:
    plain = shapes.random_scene(3, kind)
    result = boundary(make(plain))
    mesh = result.mesh(0.003 * robot_radius(result.scene))
    middle, normal = mesh.vertices[mesh.triangles].mean(axis=1), normals(mesh)
    x, y, z = middle.T
    large = np.flatnonzero(np.linalg.norm(normal, axis=1) > 1e-3)
    assert np.allclose(mesh.normals[large], normal[large] / np.linalg.norm(normal[large], axis=1)[:, None])
    assert len(large) > 50
    for k in random.Random(1).sample(large.tolist(), 25):
        theta = z[k] / mesh.angle_scale
        region = oracles.forbidden_slice(plain.robot, plain.obstacles, theta, plain.bounds, plain.workspace)
        outward = normal[k, :2] / np.linalg.norm(normal[k, :2])
        for side, inside in ((0.01, False), (-0.01, True)):
            px, py = (x[k], y[k]) + side * outward
            assert bool(region.contains(oracles.shapely.Point(px, py))) is inside


def test_vertices_lie_on_the_boundary_up_to_rounding() -> None:
    plain = shapes.random_scene(5, "nonconvex")
    mesh = boundary(make(plain)).mesh(0.5)
    for x, y, z in random.Random(2).sample(mesh.vertices.tolist(), 40):
        pose = x, y, z / mesh.angle_scale
        assert oracles.boundary_contact_distance(plain.robot, plain.obstacles, pose) < 1e-6


def test_angle_scale_is_the_robots_radius_unless_given(triangles: Boundary) -> None:
    assert triangles.mesh(0.1).angle_scale == robot_radius(triangles.scene) == math.hypot(1.2, 0.4)
