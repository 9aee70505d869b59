"""Meshes: on the boundary, facing the free side, with the volume of theory; files that can be read again."""

import math
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

import oracles
import shapes
from cfree.errors import UnsupportedError
from cfree.forbidden import Boundary, boundary
from cfree.io import load_scene
from cfree.mesh import COLOURS, MESH_SUFFIXES, Mesh, boundary_mesh, robot_radius, save_mesh
from cfree.polygon import Polygon
from cfree.scene import Scene

SCENES = Path("examples/scenes")


@pytest.fixture(scope="module")
def triangles() -> Boundary:
    """The paper's example without bounds: one convex pair."""
    scene = load_scene(SCENES / "paper_fig9.json")
    return boundary(Scene(robot=scene.robot, obstacles=scene.obstacles))


def make(plain: shapes.PlainScene) -> Scene:
    robot, obstacles = ([Polygon(*shape) for shape in side] for side in (plain.robot, plain.obstacles))
    workspace = Polygon(*plain.workspace) if plain.workspace else None
    return Scene(robot=robot, obstacles=obstacles, bounds=plain.bounds, workspace=workspace)


def normals(mesh: Mesh) -> Any:
    """Normals of the triangles, as long as twice their areas."""
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


# one convex pair


def test_counts_of_the_papers_example(triangles: Boundary) -> None:
    mesh = boundary_mesh(triangles, step=math.radians(5))
    assert set(mesh.patch) == set(range(18))
    assert np.bincount(mesh.kind).tolist()[0] == 0 and set(mesh.kind) == {1, 2}
    assert mesh.triangles.min() == 0 and mesh.triangles.max() == len(mesh.vertices) - 1


@pytest.mark.parametrize("scale", [1.0, 2.5])
def test_volume_inside_is_that_of_theory(triangles: Boundary, scale: float) -> None:
    # divergence theorem for (x, y, 0) / 2: the sections at 0 and 360 degrees do not count
    mesh = boundary_mesh(triangles, step=math.radians(0.5), angle_scale=scale)
    middle = mesh.vertices[mesh.triangles].mean(axis=1)
    volume = 0.25 * float((middle[:, :2] * normals(mesh)[:, :2]).sum())
    (robot,), (obstacle,) = triangles.scene.robot, triangles.scene.obstacles
    expected = scale * (2 * math.pi * (robot.area + obstacle.area) + robot.perimeter * obstacle.perimeter)
    assert volume == pytest.approx(expected, rel=1e-4)


def test_areas_of_edge_vertex_patches_are_those_of_theory(triangles: Boundary) -> None:
    # docs/theory.md: area = phi_range * integral of sqrt(1 + s^2) ds along the robot's edge, angle_scale 1
    mesh = boundary_mesh(triangles, step=math.radians(0.5), angle_scale=1)
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


@pytest.mark.parametrize("kind", ["nonconvex", "holed", "overlapping", "several_robots", "bounds", "workspace"])
def test_triangles_lie_on_the_boundary_and_face_the_free_side(kind: str) -> None:
    plain = shapes.random_scene(3, kind)
    mesh = boundary_mesh(boundary(make(plain)))
    middle, normal = mesh.vertices[mesh.triangles].mean(axis=1), normals(mesh)
    x, y, z = middle.T
    large = np.flatnonzero(np.linalg.norm(normal, axis=1) > 1e-3)
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
    mesh = boundary_mesh(boundary(make(plain)))
    for x, y, z in random.Random(2).sample(mesh.vertices.tolist(), 40):
        pose = x, y, z / mesh.angle_scale
        assert oracles.boundary_contact_distance(plain.robot, plain.obstacles, pose) < 1e-6


@pytest.mark.parametrize("name", ["comb_hook", "degenerate_collinear_walls", "degenerate_exact_fit", "flat"])
def test_parallel_edges_leave_no_gaps_in_the_numbers(name: str) -> None:
    result = boundary(load_scene(SCENES / f"{name}.json"))
    mesh = boundary_mesh(result)
    assert np.isfinite(mesh.vertices).all()
    assert set(mesh.patch) == set(result.trapezoids.patch)


def test_nothing_crosses_theta_zero(triangles: Boundary) -> None:
    mesh = boundary_mesh(triangles, angle_scale=1)
    heights = mesh.vertices[mesh.triangles][..., 2]
    assert mesh.vertices[:, 2].min() == 0 and mesh.vertices[:, 2].max() == 2 * math.pi
    assert np.ptp(heights, axis=1).max() <= math.radians(2) + 1e-12


def test_angle_scale_is_the_robots_radius_unless_given(triangles: Boundary) -> None:
    assert boundary_mesh(triangles).angle_scale == robot_radius(triangles.scene) == math.hypot(1.2, 0.4)
    for wrong in (0, -1, math.inf, math.nan):
        with pytest.raises(ValueError, match="positive"):
            boundary_mesh(triangles, angle_scale=wrong)
        with pytest.raises(ValueError, match="positive"):
            boundary_mesh(triangles, step=wrong)


# files


@pytest.fixture(scope="module")
def bounded_mesh() -> Mesh:
    return boundary_mesh(boundary(load_scene(SCENES / "paper_fig9.json")), step=math.radians(10))


@pytest.mark.parametrize("suffix", MESH_SUFFIXES)
def test_files_hold_the_same_triangles(bounded_mesh: Mesh, suffix: str, tmp_path: Path) -> None:
    file = tmp_path / "new" / f"mesh{suffix}"
    save_mesh(bounded_mesh, file)
    again = trimesh.load(file, process=False)
    if suffix == ".glb":
        assert sorted(again.geometry) == ["bound", "e-v", "v-e"]
        red = again.geometry["v-e"].visual.material.baseColorFactor
        assert bytes(red[:3]).hex() == COLOURS[1][1:]
        again = again.to_geometry().apply_transform(trimesh.transformations.rotation_matrix(math.pi / 2, (1, 0, 0)))
    assert len(again.triangles) == len(bounded_mesh.triangles)
    assert np.allclose(again.bounds, [bounded_mesh.vertices.min(axis=0), bounded_mesh.vertices.max(axis=0)], atol=1e-4)
    if suffix == ".ply":
        assert (again.visual.face_colors == bounded_mesh.colours).all()
        patch = again.metadata["_ply_raw"]["face"]["data"]["patch"]
        assert (patch.ravel() == bounded_mesh.patch).all()
    if suffix == ".obj":
        assert (again.visual.vertex_colors[again.faces[:, 0]] == bounded_mesh.colours).all()


def test_files_without_a_mesh_are_refused(bounded_mesh: Mesh, tmp_path: Path) -> None:
    with pytest.raises(UnsupportedError, match=r"no mesh format; name the file \.glb, \.ply"):
        save_mesh(bounded_mesh, tmp_path / "mesh.dae")
    empty = boundary_mesh(boundary(Scene(robot=[(0, 0), (1, 0), (0, 1)])))
    assert len(empty.triangles) == 0
    with pytest.raises(UnsupportedError, match="empty"):
        save_mesh(empty, tmp_path / "mesh.glb")
    assert not list(tmp_path.iterdir())


def test_saving_is_all_or_nothing(bounded_mesh: Mesh, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "mesh.stl"
    file.write_text("before")

    def full_disk(path: Path, data: bytes) -> int:
        path.touch()
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full_disk)
    with pytest.raises(OSError, match="No space"):
        save_mesh(bounded_mesh, file)
    assert [entry.name for entry in tmp_path.iterdir()] == ["mesh.stl"]
    assert file.read_text() == "before"
