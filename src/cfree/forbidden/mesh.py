"""Triangle meshes of the boundary with a proved bound of their error.

Every closed surface of the boundary becomes a closed mesh: faces of the cell complex share the points on their common
edges. Angles become heights: z = angle_scale * theta. Theta goes from -pi/2 to 3 pi/2, where the charts end. There the
mesh is cut, and `Mesh.seam` lists the pairs of vertices at the bottom and at the top that are one pose.

docs/theory/meshes.md has the bound and the choice of the points; `mesh.cpp` computes the mesh.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cfree._core as _core
from cfree.errors import InvariantError, UnsupportedError
from cfree.forbidden.cell_complex import CellComplex
from cfree.forbidden.kinds import COLOURS, PatchKind
from cfree.forbidden.record import BoundaryRecord
from cfree.libraries import Floats, Int32s, NDArray, np
from cfree.scene.scene import robot_radius
from cfree.value import Shown, Value
from cfree.words import counted

Ints = Int32s


MOST_TRIANGLES = 10_000_000
"""Larger meshes are refused: they would take some gigabytes."""
ROUNDING = 1e-10
"""Least error as a part of the largest coordinate near the obstacles: places are computed in doubles."""
FINEST = 1e-15
"""Least error as a part of all coordinates, to which the vertices are rounded in the end."""


@dataclass(frozen=True, eq=False)
class Mesh(Value, Shown):
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
        Kind of that patch: 1 v-e, 2 e-v, 3 bound, 4 an arc on an arc.
    seam : (k, 2) int32
        Vertices at theta = -pi/2 and at 3 pi/2 that are the same pose.
    error : float
        A bound of the Hausdorff distance, up to rounding: no point of a triangle is farther from the boundary, and no
        point of the boundary farther from the triangles. Trapezoids between angles less than 1e-9 radians apart are an
        exception: docs/theory/meshes.md, "Thin trapezoids".
    angle_scale : float
        Length per radian.
    least : float
        Number of triangles on the e-v patches at the best known density.
    paint : (m, 4) uint8, optional
        Colours that replace those of the kinds; see `cfree.plot.painted`.
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
    paint: NDArray[np.uint8] | None = None

    def __repr__(self) -> str:
        n = len(self.triangles)
        return f"Mesh({counted(len(self.vertices), 'vertex')}, {counted(n, 'triangle')}, error {self.error:g})"

    @property
    def ratio(self) -> float:
        """Triangles on e-v patches, as a multiple of the best known density's; NaN if there is no such patch.

        It has a meaning only together with `error`. The density (sqrt(3)/8) sqrt(-K) / error of Atariah, Rote and
        Wintraecken holds for small errors. Patches of few triangles need more for their rims: 1.2 to 1.5 at a
        thousandth of the robot's radius. Vertices on the surface can reach 1.033. (They write sqrt(3)/4 for the graph
        of a x^2 + 2 b x y + c y^2, where sqrt(-K) is twice sqrt(b^2 - a c).)
        """
        return int(np.count_nonzero(self.kind == PatchKind.EDGE_VERTEX)) / self.least if self.least > 0 else math.nan

    @property
    def normals(self) -> Floats:
        """Unit normals of the triangles, (m, 3), towards the free side; 0 for triangles without area."""
        a, b, c = (self.vertices[self.triangles[:, k]] for k in range(3))
        return unit_vectors(np.cross(b - a, c - a))

    @property
    def colours(self) -> NDArray[np.uint8]:
        """Red, green, blue and 255 of each triangle, (m, 4), by kind, or from `paint`."""
        if self.paint is not None:
            return self.paint
        table = np.zeros((1 + max(COLOURS), 4), dtype=np.uint8)
        for kind, colour in COLOURS.items():
            table[kind] = *bytes.fromhex(colour[1:]), 255
        return table[self.kind]


def triangulated(
    boundary: BoundaryRecord, cells: CellComplex, error: float, angle_scale: float | None, off_surface: bool
) -> Mesh:
    """Return the mesh of `Boundary.mesh`."""
    scale = robot_radius(boundary.scene) if angle_scale is None else angle_scale
    if not 0 < error < math.inf:
        raise ValueError(f"error: {error}; give a length above 0, such as {robot_radius(boundary.scene) / 100:.1g}")
    if not 0 < scale < math.inf:
        raise ValueError(f"angle_scale: {scale}; give a length per radian above 0")
    f, c = boundary.features, cells
    near = c.near + f.moved(c.theta, [0, 0, *f.frame[2:]])  # from the origin of the obstacles
    size, away = float(np.abs(near).max(initial=0.0)), float(max(np.abs(x).max(initial=0.0) for x in (c.x, c.y)))
    if error < (finest := max(ROUNDING * size, FINEST * away)):
        raise UnsupportedError(f"mesh error {error:g}: doubles of {away:g} allow for no less than {finest:g}")
    coarsest, expected = _core.estimate_mesh(boundary._complex_handle, error, scale)
    if expected > MOST_TRIANGLES:
        raise UnsupportedError(_too_many(error, coarsest, expected))
    try:
        mesh = _core.mesh(boundary._complex_handle, error, scale, off_surface)
    except RuntimeError as fault:
        raise InvariantError(f"mesh with error {error}: {fault}", state=boundary.scene) from fault
    patch = boundary.trapezoids.patch[mesh.face]
    kind = boundary.patch_kind[patch]
    return Mesh(mesh.xyz, mesh.corners, mesh.face, patch, kind, mesh.seam, error, scale, mesh.least)


def _too_many(error: float, coarsest: float, expected: float) -> str:
    size = f"a mesh with error {error:g} would have about {expected:.2g} triangles, more than {MOST_TRIANGLES:,}"
    if coarsest >= MOST_TRIANGLES:
        return f"{size}, and at least {coarsest:.2g} with any error; mesh a smaller scene"
    # the triangles added by accuracy grow at most as 1 / error, and at least as its root
    larger = error * ((expected - coarsest) / (MOST_TRIANGLES - coarsest)) ** 2
    digit = 10.0 ** math.floor(math.log10(larger))
    return f"{size}; an error of {math.ceil(larger / digit) * digit:g} is possible"


def unit_vectors(vectors: Floats) -> Floats:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    units: Floats = np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)
    return units
