"""Meshes among rounded shapes: closed, within their error of the boundary and it within theirs, with its volume."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import trimesh

import cfree._core as core
from arc_rings import HALF, LENS, random_arcs, shape
from cfree import Scene, boundary
from cfree.forbidden.boundary import Boundary
from cfree.forbidden.kinds import PatchKind
from cfree.forbidden.mesh import Mesh
from cfree.scene.scene import robot_radius
from closed_meshes import check_closed
from rounded_scenes import DISCS, MIXED, SCENES, TRIANGLE, disc, grown, random_scene
from rounded_ties import SCENES as TIES
from rounded_ties import features_of

THICK = 1e-8  # in radians; the curves of lower trapezoids have no place in doubles


def check_error(mesh: Mesh, result: Boundary, seed: int = 0) -> None:
    """Points of triangles are within the error of their trapezoids, and points of trapezoids of their triangles."""
    rng, table = np.random.default_rng(seed), result.trapezoids
    is_thick = table.theta_to - table.theta_from > THICK
    chosen = rng.choice(np.flatnonzero(is_thick[mesh.trapezoid]), 3000)
    weights = rng.dirichlet((1, 1, 1), len(chosen))
    weights[::2] = np.array([[1, 1, 0], [0, 1, 1], [1, 0, 1]])[chosen[::2] % 3] / 2  # it is largest on edges
    points = (mesh.vertices[mesh.triangles[chosen]] * weights[..., None]).sum(axis=1)
    off = distance_in_slice(result, mesh.trapezoid[chosen], points, mesh.angle_scale)
    assert off.max() <= mesh.error * (1 + 1e-6)

    by_face = np.argsort(mesh.trapezoid, kind="stable")
    start = np.searchsorted(mesh.trapezoid[by_face], np.arange(len(table) + 1))
    for k in rng.choice(np.flatnonzero(is_thick), 100):
        low, high = table.theta_from[k], table.theta_to[k]
        theta = np.array([low + (high - low) * rng.beta(0.5, 0.5)])
        lower, upper = result.limits([k], theta)
        t = lower + (upper - lower) * rng.choice([0, 1, rng.random()])
        x, y = result.evaluate([table.patch[k]], t, theta)[0]
        point = np.array([[x, y, theta[0] * mesh.angle_scale]])
        triangles = mesh.vertices[mesh.triangles[by_face[start[k] : start[k + 1]]]]
        near = trimesh.triangles.closest_point(triangles, np.repeat(point, len(triangles), axis=0))
        assert np.linalg.norm(near - point, axis=1).min() <= mesh.error * (1 + 1e-6)


def distance_in_slice(result: Boundary, trapezoid: Any, points: Any, scale: float) -> Any:
    """Distances within the slice, to the segment or the arc there."""
    table = result.trapezoids
    patch = table.patch[trapezoid]
    theta = np.clip(points[:, 2] / scale, table.theta_from[trapezoid], table.theta_to[trapezoid])
    lower, upper = result.limits(trapezoid, theta)
    a, b = (result.evaluate(patch, t, theta) for t in (lower, upper))
    along, square = ((points[:, :2] - a) * (b - a)).sum(axis=1), ((b - a) ** 2).sum(axis=1)
    share = np.divide(along, square, out=np.zeros_like(along), where=square > 0).clip(0, 1)
    foot = a + share[:, None] * (b - a)
    arcs = result.patch_kind[patch] == PatchKind.ARC_ARC
    p, c, s = result.ruled[patch], np.cos(theta), np.sin(theta)
    center = p[:, :2] - np.stack([c * p[:, 4] - s * p[:, 5], s * p[:, 4] + c * p[:, 5]], axis=1)
    begin = np.pi / 2 * (result.contact_kind[patch] >> 4)
    psi = np.arctan2(*(points[:, :2] - center).T[::-1]) - begin
    psi = np.remainder(psi + np.pi / 2, 2 * np.pi) - np.pi / 2
    psi = np.clip(psi, 2 * np.arctan(lower), 2 * np.arctan(upper)) + begin
    on_arc = center + result.patch_radius[patch, None] * np.stack([np.cos(psi), np.sin(psi)], axis=1)
    foot[arcs] = on_arc[arcs]
    return np.hypot(*(points[:, :2] - foot).T)


def volume(mesh: Mesh) -> float:
    """Flux of (x, y, 0) / 2 towards the free side: nothing passes the seam."""
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    return float(((a + b + c) * np.cross(b - a, c - a))[:, :2].sum()) / 12 / mesh.angle_scale


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_meshes_of_rounded_shapes_are_closed_and_close(name: str) -> None:
    result = boundary(SCENES[name], threads=1)
    for share in (0.3, 0.03, 0.004):
        mesh = result.mesh(share * robot_radius(result.scene))
        check_closed(mesh, result)
        check_error(mesh, result)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(20))
def test_meshes_of_random_rounded_scenes_are_closed_and_close(seed: int) -> None:
    result = boundary(random_scene(seed), threads=1)
    for share in (0.5, 0.05):
        mesh = result.mesh(share * robot_radius(result.scene), angle_scale=(0.3, 1, 3)[seed % 3])
        check_closed(mesh, result)
        check_error(mesh, result, seed)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(20))
def test_meshes_among_arcs_as_sides_are_closed_and_close(seed: int) -> None:
    result = boundary(random_arcs(seed), threads=1)
    for share in (0.3, 0.03):
        mesh = result.mesh(share * robot_radius(result.scene))
        check_closed(mesh, result)
        check_error(mesh, result, seed)


HALVES = Scene(shape(HALF, 1, 2, "1/2"), [shape(LENS, 9, 0), shape(HALF, 0, 9)])


def check_vertices(result: Boundary) -> None:
    """The vertices of the cell complex are on the trapezoids that have them as corners."""
    complex, table = result.complex, result.trapezoids
    face = complex.face
    x, y, theta = (array[complex.vertex] for array in (complex.x, complex.y, complex.theta))
    low, high = table.theta_from[face], table.theta_to[face]
    theta = theta + np.where(theta < low - 1e-6, math.tau, 0) - np.where(theta > high + 1e-6, math.tau, 0)
    off = distance_in_slice(result, face, np.stack([x, y, theta], axis=1), 1.0)
    assert off[high - low > THICK].max() < 1e-3 * robot_radius(result.scene)


def test_vertices_among_arcs_as_sides_are_on_their_trapezoids() -> None:
    check_vertices(boundary(HALVES, threads=1))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
def test_vertices_of_random_scenes_are_on_their_trapezoids(seed: int) -> None:
    check_vertices(boundary(random_arcs(seed) if seed % 2 else random_scene(seed), threads=1))


def test_a_mesh_of_arcs_as_sides_is_closed_and_close() -> None:
    result = boundary(HALVES, threads=1)
    mesh = result.mesh(0.1)
    check_closed(mesh, result)
    check_error(mesh, result)


def test_a_mesh_of_arcs_is_closed_and_close() -> None:
    result = boundary(MIXED, threads=1)
    mesh = result.mesh(0.1)
    check_closed(mesh, result)
    check_error(mesh, result)
    assert {*mesh.kind.tolist()} == {PatchKind.VERTEX_EDGE, PatchKind.EDGE_VERTEX, PatchKind.ARC_ARC}


@pytest.mark.slow
@pytest.mark.parametrize("name", TIES)
def test_meshes_of_scenes_with_ties_are_closed(name: str) -> None:
    cells = core.glue(core.compute_boundary(features_of(name).scene, 1, False, lambda share: True), 1)
    mesh = core.mesh(cells, 0.1, 1.0, False)
    identified = np.arange(len(mesh.xyz))
    identified[mesh.seam[:, 1]] = mesh.seam[:, 0]
    corners = identified[mesh.corners]
    edges = np.stack([corners.ravel(), np.roll(corners, -1, axis=1).ravel()], axis=1)
    found, count = np.unique(edges, axis=0, return_counts=True)
    assert np.isfinite(mesh.xyz).all() and np.all(count == 1)
    assert np.array_equal(found, np.unique(edges[:, ::-1], axis=0))
    assert len(np.unique(corners)) - len(corners) // 2 == cells.vertices - len(cells.twin) // 2 + len(cells.component)


def test_volumes_of_meshes_tend_to_those_of_convex_pairs() -> None:
    """2 pi (A + O) + per A per O + 2 pi rho (per A + per O) + 2 pi^2 rho^2, of a triangle and a point, both grown."""
    one = Scene(grown(TRIANGLE, "1/4"), [disc(4, 1, "1/2")])
    around = sum(math.dist(p, q) for p, q in zip(TRIANGLE, TRIANGLE[1:] + TRIANGLE[:1], strict=True))
    expected = 2 * math.pi * 2.5 + 2 * math.pi * 0.75 * around + 2 * math.pi**2 * 0.75**2
    result = boundary(one)
    errors = [abs(volume(result.mesh(error)) - expected) for error in (0.1, 0.01, 0.001)]
    assert errors[0] > 8 * errors[1] > 64 * errors[2]
    assert errors[2] < 1e-3 * expected


def test_trimesh_calls_meshes_of_rounded_shapes_watertight() -> None:
    mesh = boundary(DISCS).mesh(0.02)
    low, high = mesh.seam.T
    identified = np.arange(len(mesh.vertices))
    identified[high] = low
    closed = trimesh.Trimesh(mesh.vertices, identified[mesh.triangles], process=False)
    assert closed.is_watertight and closed.is_winding_consistent


def test_a_disc_needs_no_triangles_in_theta() -> None:
    """Nothing depends on theta among discs about the reference point: as many triangles for any length per radian."""
    round_pair = Scene(disc(0, 0, 1), [disc(5, 0, 2)])
    result = boundary(round_pair)
    few = result.mesh(0.01)
    assert len(few.triangles) < 1000
    assert math.isclose(volume(few), 2 * math.pi * 9 * math.pi, rel_tol=0.01)
