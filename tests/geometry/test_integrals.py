"""Integrals of curvature, Gauss and Bonnet, volumes and the kinematic formula: against quadrature and random poses."""

from __future__ import annotations

import math
import random
from pathlib import Path

import numpy as np
import pytest
import shapely
import shapely.affinity

import cfree
import shapes
from cfree.contact import angle_range, contact_surface, contacts
from cfree.errors import IncompleteError
from cfree.forbidden.boundary import Boundary, boundary
from cfree.formats.scene_file import load_scene
from cfree.free.space import free_space
from cfree.geometry import (
    gauss_bonnet,
    local_geometry,
    meeting_volume,
    patch_curvatures,
    trapezoid_areas,
    trapezoid_curvatures,
)
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene
from examples import FOLDER, POLYGONS

TRIANGLE = Polygon([(-1, -1), (3, -1), (0, 2)])
SQUARE = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
FAR = Polygon([(5, 1), (7, 2), (6, 4)])
NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def make(seed: int, kind: str) -> Boundary:
    plain = shapes.random_scene(seed, kind)
    robot, obstacles = ([Polygon(*shape) for shape in side] for side in (plain.robot, plain.obstacles))
    workspace = Polygon(*plain.workspace) if plain.workspace else None
    return boundary(Scene(robot=robot, obstacles=obstacles, bounds=plain.bounds, workspace=workspace), threads=1)


# the Gaussian curvature


@pytest.mark.parametrize("w", [0.1, 1.0, 7.0])
def test_curvatures_of_patches_are_integrals_of_k(w: float) -> None:
    x, weight = (NODES + 1) / 2, WEIGHTS / 2
    for robot, obstacle in ((TRIANGLE, SQUARE), (SQUARE, TRIANGLE), (FAR, SQUARE)):
        found = contacts(robot, obstacle)
        rows = np.array([contact_surface(robot, obstacle, contact).ruled for contact in found])
        width = np.array([angle_range(robot, obstacle, contact).phi_range for contact in found])
        parts = (np.arange(32)[:, None] + x).ravel() / 32
        at = local_geometry(rows[:, None], parts, 0.3, angle_scale=w)
        expected = width * ((at.gaussian_curvature * at.v) @ np.tile(weight / 32, 32))
        np.testing.assert_allclose(patch_curvatures(rows, width, angle_scale=w), expected, rtol=1e-10, atol=1e-15)


def test_short_edges_far_away_lose_no_digits() -> None:
    row = [0, 0, 0, 0, 1e6, 0, 1e-6, 0]  # s from 1e6 to 1e6 + 1e-6: the integrand is -1e-18 all along
    assert float(patch_curvatures(row, 1.0)) == pytest.approx(-1e-24, rel=1e-9)
    with pytest.raises(ValueError, match="phi_range"):
        patch_curvatures(row, -1.0)


@pytest.mark.parametrize("name", ["five_convex", "degenerate_island", "comb_hook"])
@pytest.mark.parametrize("w", [0.5, 3.0])
def test_integrals_over_trapezoids_are_those_of_other_quadrature(name: str, w: float) -> None:
    # over both parameters, with forty nodes each and the limits as Python has them
    result = boundary(load_scene(FOLDER / f"{name}.json"), threads=1)
    table = result.trapezoids
    x, k = (NODES + 1) / 2, np.repeat(np.arange(len(table)), 40)
    span = table.theta_to - table.theta_from
    theta = (table.theta_from[:, None] + span[:, None] * x).ravel()
    lower, upper = result.limits(k, theta)
    t = lower[:, None] + (upper - lower)[:, None] * x
    at = local_geometry(result.ruled[table.patch[k], None], t, theta[:, None], angle_scale=w)
    for found, of in ((trapezoid_areas, at.v), (trapezoid_curvatures, at.gaussian_curvature * at.v)):
        along = (of @ WEIGHTS) / 2 * (upper - lower)
        expected = along.reshape(-1, 40) @ WEIGHTS / 2 * span
        values = found(result, angle_scale=w)
        np.testing.assert_allclose(values, expected, atol=3e-7 * np.abs(expected).sum())
        assert np.median(np.abs(values - expected)) < 1e-12 * np.abs(expected).sum()


def test_trapezoids_of_one_pair_add_up_to_its_patches() -> None:
    result = boundary(Scene(robot=FAR, obstacles=SQUARE), threads=1)
    parts = np.bincount(result.trapezoids.patch, trapezoid_curvatures(result), len(result.patches))
    np.testing.assert_allclose(parts, patch_curvatures(result.ruled, result.phi_range), rtol=1e-11, atol=1e-15)


# geodesic curvature


def test_geodesic_curvatures_are_those_of_sampled_curves() -> None:
    # by differences of points and the surface's normal, over the middle of sides
    result = boundary(load_scene(FOLDER / "five_convex.json"), threads=1)
    cells, table, w, d = result.complex, result.trapezoids, 1.3, 1e-4
    found = gauss_bonnet(result, angle_scale=w)
    checked = 0
    for f in range(0, len(table), 7):
        for upper in (False, True):
            (here,) = np.nonzero(cells.side[cells.first[f] : cells.first[f + 1]] == (1 if upper else 3))
            low, high = table.theta_from[f], table.theta_to[f]
            if not len(here) or high - low < 0.01:
                continue
            n = 400
            theta = low + (high - low) * (np.arange(n) + 0.5) / n
            near = np.clip([theta - d, theta, theta + d], low + 1e-9, high - 1e-9)
            t = result.limits([f] * 3 * n, near.ravel())[int(upper)]
            points = np.column_stack([result.evaluate([table.patch[f]] * 3 * n, t, near.ravel()), w * near.ravel()])
            before, at, after = points.reshape(3, n, 3)
            left, right = np.diff(near, axis=0)[:, :, None]
            velocity = (after - before) / (left + right)
            acceleration = 2 * ((after - at) / right - (at - before) / left) / (left + right)
            normal = local_geometry(result.ruled[table.patch[f]], t.reshape(3, n)[1], theta, angle_scale=w).normal
            bend = np.einsum("ni,ni->n", np.cross(velocity, acceleration), normal) / (velocity**2).sum(axis=1)
            total = bend.mean() * (high - low) * (1 if upper else -1)
            assert found.sides[cells.first[f] + here].sum() == pytest.approx(total, abs=2e-3 * (1 + abs(total)))
            checked += 1
    assert checked > 60


def test_helices_turn_and_rulings_do_not() -> None:
    # of a robot edge whose line has the reference point: a circle's radius |a|, so kappa_g = |a| / (|a|^2 + w^2)
    robot, obstacle, w = Polygon([(1, 0), (3, 0), (2, 2)]), SQUARE, 0.8
    result = boundary(Scene(robot=robot, obstacles=obstacle), threads=1)
    cells, found = result.complex, gauss_bonnet(result, angle_scale=w)
    (patch,) = [k for k, p in enumerate(result.patches) if (p.kind, p.robot.index, p.obstacle.index) == ("e-v", 0, 0)]
    turned = {1: 0.0, 3: 0.0}
    for h in np.flatnonzero(result.trapezoids.patch[cells.face] == patch):
        if cells.side[h] in (0, 2):
            assert found.sides[h] == 0
        else:
            turned[int(cells.side[h])] += found.sides[h]
    width = result.phi_range[patch]
    for side, r, sign in ((3, 1, -1), (1, 3, 1)):
        assert turned[side] == pytest.approx(sign * width * r / math.hypot(r, w), rel=1e-12)


# Gauss and Bonnet


@pytest.mark.slow
@pytest.mark.parametrize("path", POLYGONS, ids=lambda path: path.stem)
def test_curvature_adds_up_to_the_euler_number_on_all_example_scenes(path: Path) -> None:
    result = boundary(load_scene(path), threads=1)
    found = gauss_bonnet(result)
    assert len(found.euler) == result.complex.components
    np.testing.assert_allclose(found.euler, result.complex.euler, atol=1e-8)
    assert found.error.max(initial=0.0) < 1e-8
    size = np.abs(result.complex.near).max(initial=1.0)
    assert found.gap < 1e-8 * size  # where surfaces meet at small angles, rounding moves their curves


@pytest.mark.parametrize("kind", shapes.KINDS)
def test_curvature_adds_up_on_random_surfaces_in_every_metric(kind: str) -> None:
    for seed in range(3):
        result = make(seed, kind)
        for w in (0.2, 4.0):
            found = gauss_bonnet(result, angle_scale=w)
            np.testing.assert_allclose(found.euler, result.complex.euler, atol=1e-8)
            inside = np.pi - np.where(np.isclose(found.angles, np.pi), np.pi, found.angles)
            assert inside.min(initial=0) > -1e-6 and inside.max(initial=0) < np.pi + 1e-6


def test_wrong_faces_at_a_vertex_leave_a_gap(monkeypatch: pytest.MonkeyPatch) -> None:
    result = boundary(load_scene(FOLDER / "paper_fig9.json"), threads=1)
    assert gauss_bonnet(result).gap < 1e-12
    wrong = result.complex.vertex.copy()
    wrong[wrong == 0] = 1
    monkeypatch.setitem(result.complex.__dict__, "vertex", wrong)
    found = gauss_bonnet(result)
    assert found.gap > 0.1 and abs(found.euler - result.complex.euler).max() < 1e-8


def test_a_box_around_the_circle_is_flat() -> None:
    # bounds hold the reference point: flat faces between vertical edges, around which a face turns by nothing
    result = boundary(Scene([(0, 0), (1, 0), (0, 1)], bounds=(0, 0, 3, 2)), threads=1)
    found = gauss_bonnet(result)
    assert not found.faces.any() and not found.sides.any()
    np.testing.assert_allclose(found.vertices, 0, atol=1e-15)
    assert np.array_equal(result.complex.euler, [0])


def test_incomplete_boundaries_have_no_sum() -> None:
    stopped = boundary(load_scene(FOLDER / "benchmr_parking1.json"), max_seconds=0)
    if not stopped.complete:
        for of in (gauss_bonnet, trapezoid_curvatures):
            with pytest.raises(IncompleteError):
                of(stopped)


# volumes


def test_volumes_are_within_their_estimates_of_closed_forms() -> None:
    rng = random.Random(5)
    pairs = [(TRIANGLE, SQUARE), (SQUARE, SQUARE), (FAR, TRIANGLE)]  # parallel edges, the reference point far away
    pairs += [
        (Polygon(*shapes.random_convex(rng)), Polygon(*shapes.random_convex(rng, (9.0, 4.0), 3))) for _ in range(20)
    ]
    sliver = Polygon([(0, 0), (4, 0), (4, 1), (0, 1e-7)])
    pairs += [(sliver, sliver), (sliver, TRIANGLE)]
    for robot, obstacle in pairs:
        space = free_space(boundary(Scene(robot=robot, obstacles=obstacle, bounds=(-40, -40, 50, 50)), threads=1))
        expected = math.tau * 90**2 - meeting_volume(robot, obstacle)
        assert len(space) == 1 and abs(space.volumes[0] - expected) <= space.volume_errors[0] + 1e-15 * expected
        assert space.volume_errors[0] < 1e-9 * expected
    assert free_space(boundary(Scene(TRIANGLE, SQUARE))).volume_errors.tolist() == [math.inf]


@pytest.mark.parametrize("name", ["degenerate_island", "sofa_corner", "flat"])
def test_volumes_are_within_their_estimates_of_areas_of_slices(name: str) -> None:
    # of Green's formula about the origin, with thirty-two nodes over each trapezoid, and the limits as Python has them
    space = free_space(boundary(load_scene(FOLDER / f"{name}.json"), threads=1))
    surfaces, table = space.surfaces, space.surfaces.trapezoids
    nodes, weights = np.polynomial.legendre.leggauss(32)
    for cell in space.cells:
        if not cell.bounded:
            continue
        faces = space.faces(cell.index)
        x = (nodes + 1) / 2
        span = (table.theta_to - table.theta_from)[faces]
        theta = table.theta_from[faces, None] + span[:, None] * x
        k = np.repeat(faces, 32)
        ends = [surfaces.evaluate(table.patch[k], t, theta.ravel()) for t in surfaces.limits(k, theta.ravel())]
        area = (ends[0][:, 0] * ends[1][:, 1] - ends[0][:, 1] * ends[1][:, 0]).reshape(-1, 32) / 2
        total = -float((area @ weights / 2 * span).sum())
        size = float(np.abs(area).max()) * math.tau
        assert (
            abs(cell.volume - total) <= space.volume_errors[cell.index] + 1e-8 * size
        )  # where surfaces meet at small angles, rounding moves their curves


def test_areas_of_cells_are_sums_of_trapezoids() -> None:
    space = free_space(boundary(load_scene(FOLDER / "degenerate_island.json"), threads=1))
    parts = trapezoid_areas(space.surfaces, angle_scale=2.0)
    expected = [parts[space.faces(cell.index)].sum() for cell in space.cells]
    np.testing.assert_allclose(space.areas(angle_scale=2.0), expected, rtol=1e-13)


# mean measures


def sampled(robot: Polygon, obstacle: Polygon, count: int) -> tuple[float, np.ndarray]:
    """Random poses around an obstacle: the measure of all of them, and of each what it cuts."""
    rng = np.random.default_rng(8)
    A, O = robot.to_shapely(), obstacle.to_shapely()
    reach = np.hypot(*robot.vertices.T).max()
    low, high = obstacle.vertices.min(axis=0) - reach, obstacle.vertices.max(axis=0) + reach
    found = []
    for _ in range(count):
        x, y = rng.uniform(low, high)
        theta = rng.uniform(0, math.tau)
        c, s = math.cos(theta), math.sin(theta)
        moved = shapely.affinity.affine_transform(A, [c, -s, s, c, x, y])
        common = moved.intersection(O)
        crossings = len(shapely.get_coordinates(moved.exterior.intersection(O.exterior)))
        found.append([not common.is_empty, common.area, common.length, crossings])
    return float(np.prod(high - low) * math.tau), np.array(found, dtype=float)


def test_mean_measures_of_a_moving_robot_are_those_of_integral_geometry() -> None:
    robot, obstacle = TRIANGLE, Polygon([(0, 0), (3, 0), (4, 1), (1, 3)])
    whole, found = sampled(robot, obstacle, 6000)
    A, B, L, M = robot.area, obstacle.area, robot.perimeter, obstacle.perimeter
    expected = [meeting_volume(robot, obstacle), math.tau * A * B, math.tau * (A * M + B * L), 4 * L * M]
    mean, off = whole * found.mean(axis=0), whole * found.std(axis=0) / math.sqrt(len(found))
    assert np.all(np.abs(mean - expected) < 4 * off) and np.all(off < 0.04 * np.array(expected))


def test_the_formula_is_for_convex_polygons() -> None:
    with pytest.raises(ValueError, match="obstacle: not convex"):
        meeting_volume(SQUARE, Polygon(*shapes.l_shape()))
    assert cfree.geometry.meeting_volume(SQUARE, SQUARE) == 16 * math.pi + 64
