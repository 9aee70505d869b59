"""Write meshes of a boundary as GLB, PLY, OBJ and STL."""

from __future__ import annotations

from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.errors import UnsupportedError
from cfree.forbidden.kinds import COLOURS, KINDS
from cfree.forbidden.mesh import Mesh, unit_vectors
from cfree.formats.text.atomic import checked_suffix, replacing
from cfree.libraries import Floats

MESH_SUFFIXES = (".glb", ".ply", ".obj", ".stl")


def save_mesh(mesh: Mesh, path: str | PathLike[str]) -> None:
    """Write a mesh to a file, whole or not at all.

    Parameters
    ----------
    mesh : Mesh
    path : path
        ``.glb`` has one coloured mesh for each kind of patch, theta upwards. A painted mesh is one mesh there, whose
        triangles have colours and vertices of their own. ``.obj`` has colours of the vertices. In both, each patch has
        vertices of its own, so that edges between patches look sharp. ``.ply`` has colours and patch ids of the
        triangles, and shared vertices: closed surfaces. ``.stl`` has triangles only. All have normals towards the
        free side.

    Raises
    ------
    UnsupportedError
        If the suffix is another, or there is no triangle to write.
    """
    suffix = check_mesh_path(path)
    if not len(mesh.triangles):
        raise UnsupportedError(f"{path}: the boundary is empty; there is no mesh to write")
    import trimesh

    if suffix == ".glb":
        data = (_by_kind(mesh) if mesh.paint is None else _by_triangle(mesh)).export(file_type="glb")
    else:
        vertices, corners = _patches_apart(mesh) if suffix == ".obj" else (mesh.vertices, mesh.triangles)
        shape: Any = trimesh.Trimesh(vertices, corners, vertex_normals=_normals_at(mesh, corners), process=False)
        if suffix == ".obj":
            colours = np.zeros((len(vertices), 4), dtype=np.uint8)
            colours[corners] = mesh.colours[:, None, :]
            shape.visual.vertex_colors = colours
        if suffix == ".ply":
            shape.visual.face_colors = mesh.colours
            shape.face_attributes["patch"] = mesh.patch.astype(np.int32)
        options = {".ply": {"vertex_normal": True}, ".obj": {"include_normals": True}}.get(suffix, {})
        data = shape.export(file_type=suffix[1:], **options)
    with replacing(path) as unfinished:
        unfinished.write_bytes(data.encode() if isinstance(data, str) else data)


def check_mesh_path(path: str | PathLike[str]) -> str:
    """Return the suffix of a file that `save_mesh` can write.

    Examples
    --------
    >>> check_mesh_path("parking.GLB")
    '.glb'
    >>> check_mesh_path("parking.dae")
    Traceback (most recent call last):
        ...
    cfree.errors.UnsupportedError: parking.dae: no mesh format; name the file .glb, .ply, .obj or .stl
    """
    return checked_suffix(path, "mesh", MESH_SUFFIXES)


def _normals_at(mesh: Mesh, corners: NDArray[np.integer[Any]]) -> Floats:
    """Return the mean normals at the vertices of triangles with these corners."""
    normals = np.zeros((int(corners.max(initial=-1)) + 1, 3))
    for column in corners.T:
        np.add.at(normals, column, mesh.normals)
    return unit_vectors(normals)


def _patches_apart(mesh: Mesh) -> tuple[Floats, NDArray[np.int64]]:
    """Return vertices and corners with separate vertices for each patch."""
    count = len(mesh.vertices)
    codes, corners = np.unique(mesh.patch[:, None] * np.int64(count) + mesh.triangles, return_inverse=True)
    return mesh.vertices[codes % count], corners.reshape(-1, 3)


UPRIGHT = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], dtype=np.float64)
"""The transform that turns theta to glTF's second axis, which points up."""


def _by_triangle(mesh: Mesh) -> Any:
    """Return one mesh; each triangle has its colour at three vertices of its own."""
    import trimesh

    vertices, corners = _patches_apart(mesh)
    normals = _normals_at(mesh, corners)[corners].reshape(-1, 3)
    apart = np.arange(corners.size).reshape(-1, 3)
    shape: Any = trimesh.Trimesh(vertices[corners].reshape(-1, 3), apart, vertex_normals=normals, process=False)
    shape.visual.vertex_colors = np.repeat(mesh.colours, 3, axis=0)
    scene = trimesh.Scene()
    scene.add_geometry(shape, node_name="boundary", geom_name="boundary", transform=UPRIGHT)
    return scene


def _by_kind(mesh: Mesh) -> Any:
    """Return one named mesh for each kind of patch, visible from both sides."""
    import trimesh

    visual: Any = trimesh.visual
    scene = trimesh.Scene()
    vertices, corners = _patches_apart(mesh)
    normals = _normals_at(mesh, corners)
    for kind, name in KINDS.items():
        faces = corners[mesh.kind == kind]
        if not len(faces):
            continue
        used, faces = np.unique(faces, return_inverse=True)
        glass = name == "bound"
        material = visual.material.PBRMaterial(
            name=name,
            baseColorFactor=[*bytes.fromhex(COLOURS[kind][1:]), 60 if glass else 255],
            alphaMode="BLEND" if glass else "OPAQUE",
            metallicFactor=0.0,
            roughnessFactor=0.9,
            doubleSided=True,
        )
        faces = faces.reshape(-1, 3)
        shape = trimesh.Trimesh(vertices[used], faces, vertex_normals=normals[used], process=False)
        shape.visual = visual.TextureVisuals(material=material)
        scene.add_geometry(shape, node_name=name, geom_name=name, transform=UPRIGHT)
    return scene
