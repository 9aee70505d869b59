r"""Triangle meshes of the boundary, and files of them.

Every trapezoid gets a plain grid: rows of constant theta, and as many columns as the twist of the surface asks for
(one if it is v-e: those do not twist). Two triangles a cell, counter-clockwise as seen from the free side, to which
S_t x S_phi points; the diagonals alternate, so that what they add on one side of the surface they take on the other.

    theta + step   o-------o-------o
                   |     / | \     |
                   |   /   |   \   |
                   | /     |     \ |
    theta          o-------o-------o    t ->

Angles become heights: z = angle_scale * theta, theta in [0, 2 pi]. Neighbouring trapezoids do not share vertices: the
mesh is for the eye, and carries no bound of its error.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cfree.errors import UnsupportedError
from cfree.files import replacing
from cfree.strips import Strips, step_for, strips

if TYPE_CHECKING:
    from cfree.forbidden import Boundary
    from cfree.scene import Scene

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

KINDS = {1: "v-e", 2: "e-v", 3: "bound"}
COLOURS = {1: "#d7301f", 2: "#3a9a3a", 3: "#b4b9c1"}
"""Colour of each kind of patch: the paper's red and green, and light grey for the bounds."""

MESH_SUFFIXES = (".glb", ".ply", ".obj", ".stl")
STEPS = math.radians(2), math.radians(10)
ROWS = 200_000  # the step is as small as this many rows allow
TWIST = 4
"""How many steps the normal may turn across a cell."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles of a boundary, counter-clockwise as seen from the free side.

    Attributes
    ----------
    vertices : (n, 3) float64
        x, y, angle_scale * theta, in the scene's unit of length.
    triangles : (m, 3) int64
    patch : (m,) int64
        Patch of each triangle.
    kind : (m,) uint8
        Kind of that patch: 1 v-e, 2 e-v, 3 bound.
    angle_scale : float
        Length per radian.
    """

    vertices: Floats
    triangles: Ints
    patch: Ints
    kind: NDArray[np.uint8]
    angle_scale: float

    @property
    def colours(self) -> NDArray[np.uint8]:
        """Red, green, blue and 255 of each triangle, (m, 4), by kind."""
        table = np.zeros((4, 4), dtype=np.uint8)
        for kind, colour in COLOURS.items():
            table[kind] = *bytes.fromhex(colour[1:]), 255
        return table[self.kind]


def boundary_mesh(boundary: Boundary, *, step: float | None = None, angle_scale: float | None = None) -> Mesh:
    """Mesh of all patches.

    Parameters
    ----------
    boundary : Boundary
    step : float, radians, optional
        Greatest height of a cell; if not given, 2 degrees, or up to 10 where the boundary is large.
    angle_scale : float, optional
        Length per radian; the robot's radius about its reference point if not given.

    Returns
    -------
    Mesh

    Notes
    -----
    Time and memory grow with the number of trapezoids plus the sum of their heights over `step`.

    Examples
    --------
    >>> from cfree.forbidden import boundary
    >>> from cfree.io import load_scene
    >>> mesh = boundary_mesh(boundary(load_scene("examples/scenes/paper_fig9.json")))
    >>> float(mesh.vertices[:, 2].max() / mesh.angle_scale) == 2 * math.pi
    True
    """
    scale = robot_radius(boundary.scene) if angle_scale is None else angle_scale
    step = step_for(boundary, ROWS, STEPS) if step is None else step
    if not (0 < step < math.inf and 0 < scale < math.inf):
        raise ValueError(f"step {step} and angle_scale {scale} must be finite and positive")
    rows = strips(boundary, step)
    columns = _columns(boundary, rows, scale, TWIST * step)
    # vertices: the points of each row
    width = columns[rows.part] + 1
    row = np.repeat(np.arange(len(width)), width)
    start = np.cumsum(width) - width
    share = ((np.arange(len(row)) - start[row]) / (width[row] - 1))[:, None]
    xy = (1 - share) * rows.points[row, 0] + share * rows.points[row, 1]
    vertices = np.column_stack((xy, scale * rows.theta[row]))
    # triangles: two of each cell between two rows
    cells = columns[rows.part[rows.joined]]
    lower = np.repeat(rows.joined, cells)
    column = np.arange(len(lower)) - np.repeat(np.cumsum(cells) - cells, cells)
    a, d = start[lower] + column, start[lower + 1] + column
    b, c = a + 1, d + 1
    rising = ((column + lower) % 2 == 0)[:, None]
    corners = np.where(rising, np.stack((a, b, c, a, c, d), axis=1), np.stack((a, b, d, b, c, d), axis=1))
    patch = np.repeat(boundary.trapezoids.patch[rows.trapezoid[lower]], 2).astype(np.int64)
    return Mesh(vertices, corners.reshape(-1, 3), patch, boundary.patch_kind[patch], scale)


def _columns(boundary: Boundary, rows: Strips, scale: float, twist: float) -> Ints:
    """Columns of each part, so that the normal turns by `twist` radians at most across a cell.

    Notes
    -----
    Along a row of an e-v surface the normal turns by atan(s / scale), s the position of the contact on the robot's
    edge, from the foot of the perpendicular from the reference point.
    """
    a, g = np.split(boundary.ruled[boundary.trapezoids.patch[rows.trapezoid], 4:], 2, axis=1)
    length = np.hypot(*g.T)
    along = np.divide((a * g).sum(axis=1), length, out=np.zeros(len(g)), where=length > 0)
    turn = np.ptp(np.arctan((along[:, None] + rows.t * length[:, None]) / scale), axis=1)
    most = np.zeros(rows.part.max(initial=-1) + 1)
    np.maximum.at(most, rows.part, turn)
    return np.maximum(1, np.ceil(most / twist)).astype(np.int64)


def robot_radius(scene: Scene) -> float:
    """Distance of the robot's farthest vertex from its reference point."""
    return max(math.hypot(x, y) for part in scene.robot for x, y in part.vertices.tolist())


def save_mesh(mesh: Mesh, path: str | PathLike[str]) -> None:
    """Write a mesh to a file, whole or not at all.

    Parameters
    ----------
    mesh : Mesh
    path : path
        ``.glb`` has one coloured mesh for each kind of patch, theta upwards; ``.ply`` has colours and patch ids of
        the triangles; ``.obj`` has colours of the vertices; ``.stl`` triangles only.

    Raises
    ------
    UnsupportedError
        If the name ends otherwise, or there is no triangle to write.
    """
    suffix = check_mesh_path(path)
    if not len(mesh.triangles):
        raise UnsupportedError(f"{path}: the boundary is empty; there is no mesh to write")
    import trimesh

    if suffix == ".glb":
        data = _by_kind(mesh).export(file_type="glb")
    else:
        shape: Any = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
        if suffix == ".obj":
            shape.visual.vertex_colors = _vertex_colours(mesh)
        if suffix == ".ply":
            shape.visual.face_colors = mesh.colours
            shape.face_attributes["patch"] = mesh.patch.astype(np.int32)
        data = shape.export(file_type=suffix[1:])
    with replacing(path) as unfinished:
        unfinished.write_bytes(data.encode() if isinstance(data, str) else data)


def check_mesh_path(path: str | PathLike[str]) -> str:
    """Suffix of a file that `save_mesh` can write.

    Examples
    --------
    >>> check_mesh_path("parking.GLB")
    '.glb'
    >>> check_mesh_path("parking.dae")
    Traceback (most recent call last):
        ...
    cfree.errors.UnsupportedError: parking.dae: no mesh format; name the file .glb, .ply, .obj, .stl
    """
    suffix = Path(path).suffix.lower()
    if suffix not in MESH_SUFFIXES:
        raise UnsupportedError(f"{path}: no mesh format; name the file {', '.join(MESH_SUFFIXES)}")
    return suffix


def _vertex_colours(mesh: Mesh) -> NDArray[np.uint8]:
    """Colours of the vertices: all triangles at one have the same."""
    colours = np.zeros((len(mesh.vertices), 4), dtype=np.uint8)
    colours[mesh.triangles] = mesh.colours[:, None, :]
    return colours


def _by_kind(mesh: Mesh) -> Any:
    """One mesh a kind, named, seen from both sides; glTF's second axis points up, so theta is turned there."""
    import trimesh

    visual: Any = trimesh.visual
    upright = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], dtype=np.float64)
    scene = trimesh.Scene()
    for kind, name in KINDS.items():
        faces = mesh.triangles[mesh.kind == kind]
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
        shape = trimesh.Trimesh(mesh.vertices[used], faces.reshape(-1, 3), process=False)
        shape.visual = visual.TextureVisuals(material=material)
        scene.add_geometry(shape, node_name=name, geom_name=name, transform=upright)
    return scene
