"""Files of meshes can be read again."""

import math
from pathlib import Path

import numpy as np
import pytest
import trimesh

from cfree.errors import UnsupportedError
from cfree.forbidden.boundary import boundary
from cfree.forbidden.kinds import COLOURS
from cfree.forbidden.mesh import Mesh
from cfree.formats.boundaries.mesh_file import MESH_SUFFIXES, save_mesh
from cfree.formats.scene_file import load_scene
from cfree.free.space import free_space
from cfree.plot.paint import painted
from cfree.scene.scene import Scene

SCENES = Path(__file__).parents[3] / "examples/scenes"


@pytest.fixture(scope="module")
def bounded_mesh() -> Mesh:
    return boundary(load_scene(SCENES / "paper_fig9.json")).mesh(0.05)


@pytest.mark.parametrize("suffix", MESH_SUFFIXES)
def test_files_hold_the_same_triangles(bounded_mesh: Mesh, suffix: str, tmp_path: Path) -> None:
    file = tmp_path / f"mesh{suffix}"
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
    if suffix != ".glb":
        assert np.allclose(again.face_normals, bounded_mesh.normals, atol=1e-3)
    if suffix in (".ply", ".obj"):
        assert (np.einsum("ij,ij->i", again.vertex_normals[again.faces[:, 0]], bounded_mesh.normals) > 0).all()


def test_painted_files_have_the_colours_of_triangles(tmp_path: Path) -> None:
    space = free_space(boundary(load_scene(SCENES / "degenerate_island.json")))
    mesh = space.surfaces.mesh(0.2)
    for by in ("K", "H", "cell"):
        shown = painted(mesh, space, by)
        assert shown.colours.shape == mesh.colours.shape and (shown.colours != mesh.colours).any()
        for suffix in (".ply", ".glb"):
            save_mesh(shown, tmp_path / f"mesh{suffix}")
            again = trimesh.load(tmp_path / f"mesh{suffix}", process=False)
            if suffix == ".glb":
                again = again.geometry["boundary"]
                assert (again.visual.vertex_colors.reshape(-1, 3, 4) == shown.colours[:, None]).all()
                assert len(again.faces) == len(mesh.triangles)
            else:
                assert (again.visual.face_colors == shown.colours).all()
    assert painted(shown, space, "contact") == mesh != shown


def test_colours_are_those_of_curvatures_and_cells() -> None:
    space = free_space(boundary(load_scene(SCENES / "degenerate_island.json")))
    mesh = space.surfaces.mesh(0.2)
    cells = painted(mesh, space, "cell").colours
    groups = {tuple(colour) for colour in cells.tolist()}
    assert len(groups) == len(set(space.cell_of.tolist())) > 1
    for component in range(len(space.cell_of)):
        assert len(np.unique(cells[space.component[mesh.trapezoid] == component], axis=0)) == 1
    flat = painted(mesh, space, "K").colours[mesh.kind == 1]
    assert (flat == flat[0]).all()  # v-e: K = 0
    steep = painted(mesh, space, "K").colours[mesh.kind == 2]
    assert not (steep == flat[0]).all(axis=1).any()
    middle = painted(mesh, space, "H").colours[mesh.kind == 3]  # bounds: planes, H = 0
    assert len(np.unique(middle, axis=0)) <= 1
    with pytest.raises(ValueError, match="not of this free space"):
        painted(boundary(load_scene(SCENES / "paper_fig9.json")).mesh(0.1), space, "K")


def test_files_without_a_mesh_are_refused(bounded_mesh: Mesh, tmp_path: Path) -> None:
    with pytest.raises(UnsupportedError, match=r"no mesh format; name the file \.glb, \.ply"):
        save_mesh(bounded_mesh, tmp_path / "mesh.dae")
    empty = boundary(Scene(robot=[(0, 0), (1, 0), (0, 1)])).mesh(0.1)
    assert len(empty.triangles) == 0 and math.isnan(empty.ratio)
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
