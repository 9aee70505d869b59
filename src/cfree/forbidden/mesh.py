"""Triangle meshes of the boundary with a proved bound of their error, and files of them.

Every closed surface of the boundary becomes a closed mesh: faces of the cell complex share the points on their common
edges. Angles become heights: z = angle_scale * theta, theta from -pi/2 to 3 pi/2, where the charts end; there the
mesh is cut, and `Mesh.seam` lists which vertices at the bottom and at the top are one pose.

The bound and the choice of the points are in docs/theory.md, "Meshes"; the work is done in `mesh.cpp`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.errors import InvariantError, UnsupportedError
from cfree.formats.atomic import checked_suffix, replacing
from cfree.value import Value

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary
    from cfree.scene.scene import Scene

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

KINDS = {1: "v-e", 2: "e-v", 3: "bound"}
COLOURS = {1: "#d7301f", 2: "#3a9a3a", 3: "#b4b9c1"}
"""Colour of each kind of patch: the paper's red and green, and light grey for the bounds."""

MESH_SUFFIXES = (".glb", ".ply", ".obj", ".stl")
MOST_TRIANGLES = 10_000_000
"""Larger meshes are refused: they would take some gigabytes."""
ROUNDING = 1e-10
"""Errors must be above this part of the largest coordinate near the obstacles: places are computed in doubles."""
FINEST = 1e-15
"""And above this part of all coordinates, to which they are rounded in the end."""


@dataclass(frozen=True, eq=False)
class Mesh(Value):
    """Closed surfaces of triangles, counter-clockwise as seen from the free side; see `Boundary.mesh`.

    Attributes
    ----------
    vertices : (n, 3) float64
        x, y, angle_scale * theta, in the scene's unit of length; theta from -pi/2 to 3 pi/2.
    triangles : (m, 3) int32
    trapezoid : (m,) int32
        Trapezoid of each triangle.
    patch : (m,) int32
        Patch of each triangle.
    kind : (m,) uint8
        Kind of that patch: 1 v-e, 2 e-v, 3 bound.
    seam : (k, 2) int32
        Vertices at theta = -pi/2 and at 3 pi/2 that are the same pose.
    error : float
        No point of a triangle is farther from the boundary.
    angle_scale : float
        Length per radian.
    least : float
        Triangles that the best known density asks for on the e-v patches.
    """

    vertices: Floats
    triangles: Ints
    trapezoid: Ints
    patch: Ints
    kind: NDArray[np.uint8]
    seam: Ints
    error: float
    angle_scale: float
    least: float

    def __repr__(self) -> str:
        n = len(self.triangles)
        return f"Mesh({len(self.vertices):,} vertices, {n:,} triangles, error {self.error:g})"

    @property
    def ratio(self) -> float:
        """Triangles on e-v patches over those of the best known density; NaN if there is no such patch.

        The density (sqrt(3)/4) sqrt(-K) / error of Atariah, Rote and Wintraecken holds for small errors: 1.033 is what
        vertices on the surface can reach, and small patches need more for their rims.
        """
        return int(np.count_nonzero(self.kind == 2)) / self.least if self.least > 0 else math.nan

    @property
    def normals(self) -> Floats:
        """Unit normals of the triangles, (m, 3), to the free side; 0 for triangles without area."""
        a, b, c = (self.vertices[self.triangles[:, k]] for k in range(3))
        return _unit(np.cross(b - a, c - a))

    @property
    def colours(self) -> NDArray[np.uint8]:
        """Red, green, blue and 255 of each triangle, (m, 4), by kind."""
        table = np.zeros((4, 4), dtype=np.uint8)
        for kind, colour in COLOURS.items():
            table[kind] = *bytes.fromhex(colour[1:]), 255
        return table[self.kind]


def triangulated(boundary: Boundary, error: float, angle_scale: float | None) -> Mesh:
    """The mesh of `Boundary.mesh`."""
    from cfree import _core

    scale = robot_radius(boundary.scene) if angle_scale is None else angle_scale
    if not 0 < error < math.inf:
        raise ValueError(f"error: {error}; give a length above 0, such as {robot_radius(boundary.scene) / 100:.1g}")
    if not 0 < scale < math.inf:
        raise ValueError(f"angle_scale: {scale}; give a length per radian above 0")
    f, t, c = boundary.features, boundary.trapezoids, boundary.complex
    x, y = np.ascontiguousarray((c.near + f.moved(c.theta, [0, 0, *f.frame[2:]])).T)  # from the origin of the obstacles
    size, away = (float(max(np.abs(xy).max(initial=0.0) for xy in pair)) for pair in ((x, y), (c.x, c.y)))
    if error < (finest := max(ROUNDING * size, FINEST * away)):
        raise UnsupportedError(f"mesh error {error:g}: doubles of {away:g} allow for no less than {finest:g}")
    try:
        found = _core.mesh(
            f.robot.near_shape(), f.obstacles.near_shape(), f.robot.xy.ravel(), f.obstacles.near.ravel(),
            boundary.contact_kind, boundary.contact_robot, boundary.contact_obstacle,
            t.patch, t.chart, t.lower, t.upper,
            c.first, c.face, c.side, c.twin, c.edge, c.vertex, x, y, c.theta, c.edges,
            error, scale, MOST_TRIANGLES,
        )  # fmt: skip
    except RuntimeError as fault:
        raise InvariantError(f"mesh with error {error}: {fault}", state=boundary.scene) from fault
    xyz, corners, trapezoid, seam, least, coarsest, expected = found
    if expected > MOST_TRIANGLES:
        raise UnsupportedError(_too_many(error, coarsest, expected))
    vertices = xyz.reshape(-1, 3)
    vertices[:, 2] *= scale
    vertices[:, :2] += f.frame[:2]
    patch = t.patch[trapezoid]
    kind = boundary.patch_kind[patch]
    return Mesh(vertices, corners.reshape(-1, 3), trapezoid, patch, kind, seam.reshape(-1, 2), error, scale, least)


def _too_many(error: float, coarsest: float, expected: float) -> str:
    size = f"a mesh with error {error:g} would have about {expected:.2g} triangles, more than {MOST_TRIANGLES:,}"
    if coarsest >= MOST_TRIANGLES:
        return f"{size}, and at least {coarsest:.2g} with any error; mesh a smaller scene"
    # what accuracy adds grows at most as 1 / error, and at least as its root
    larger = error * ((expected - coarsest) / (MOST_TRIANGLES - coarsest)) ** 2
    digit = 10.0 ** math.floor(math.log10(larger))
    return f"{size}; an error of {math.ceil(larger / digit) * digit:g} is possible"


def _unit(vectors: Floats) -> Floats:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    units: Floats = np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)
    return units


def robot_radius(scene: Scene) -> float:
    """Distance of the robot's farthest vertex from its reference point."""
    return max(math.hypot(x, y) for part in scene.robot for x, y in part.vertices.tolist())


@checked
def save_mesh(mesh: Mesh, path: str | PathLike[str]) -> None:
    """Write a mesh to a file, whole or not at all.

    Parameters
    ----------
    mesh : Mesh
    path : path
        ``.glb`` has one coloured mesh for each kind of patch, theta upwards; ``.obj`` has colours of the vertices. In
        both each patch has vertices of its own, so that edges between patches look sharp. ``.ply`` has colours and
        patch ids of the triangles, and shared vertices: closed surfaces; ``.stl`` triangles only. All have normals,
        towards the free side.

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
    """Suffix of a file that `save_mesh` can write.

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
    """Mean normals at the vertices that triangles with these corners have."""
    normals = np.zeros((int(corners.max(initial=-1)) + 1, 3))
    for column in corners.T:
        np.add.at(normals, column, mesh.normals)
    return _unit(normals)


def _patches_apart(mesh: Mesh) -> tuple[Floats, NDArray[np.int64]]:
    """Vertices and corners, with a vertex for each patch at it."""
    count = len(mesh.vertices)
    at, corners = np.unique(mesh.patch[:, None] * np.int64(count) + mesh.triangles, return_inverse=True)
    return mesh.vertices[at % count], corners.reshape(-1, 3)


def _by_kind(mesh: Mesh) -> Any:
    """One mesh a kind, named, seen from both sides; glTF's second axis points up, so theta is turned there."""
    import trimesh

    visual: Any = trimesh.visual
    upright = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], dtype=np.float64)
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
        scene.add_geometry(shape, node_name=name, geom_name=name, transform=upright)
    return scene
