"""Gauss and Bonnet's theorem on the closed surfaces of a boundary: curvature adds up to 2 pi times Euler's number.

The curvature of a closed surface with edges is in three places: on faces, K; along edges, the geodesic curvatures of
both faces there; and at vertices, 2 pi minus the angles of the faces around. Each is computed from the equations of
surfaces and curves. Every face satisfies the theorem alone, so that the sum is V - E + F of any gluing: it checks K,
geodesic curvatures and angles, and not the gluing. `gauss_map` checks that. docs/theory/surface-geometry.md, "Gauss
and Bonnet".
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.arguments import checked
from cfree.forbidden.boundary import Boundary
from cfree.geometry.ruled import Floats, check_scale
from cfree.value import Value


@dataclass(frozen=True, eq=False)
class GaussBonnet(Value):
    """Curvature of closed surfaces, by place; see `gauss_bonnet`.

    Attributes
    ----------
    faces : (F,) float64
        Integral of K over each trapezoid.
    sides : (H,) float64
        Integral of the geodesic curvature along each coedge, as its loop runs: positive where it turns left, seen from
        the free side. 0 along walls, which are straight lines.
    sides_error : (H,) float64
        How much of that changes when the intervals of quadrature are halved: a measured error.
    angles : (H,) float64, radians
        Between a coedge and the one before it: the face's angle there.
    vertices : (V,) float64
        2 pi minus the angles around each vertex.
    euler : (C,) float64
        Of each closed surface: all of these, over 2 pi.
    error : (C,) float64
        What quadrature may have missed of `euler`, as measured in the same way.
    gap : float
        The farthest that two faces put a vertex that they share from each other, in length: by rounding, if they fit.
    """

    faces: Floats
    sides: Floats
    sides_error: Floats
    angles: Floats
    vertices: Floats
    euler: Floats
    error: Floats
    gap: float

    def __repr__(self) -> str:
        sums = ", ".join(f"{x:.9f}" for x in self.euler[:8]) + ", ..." * (len(self.euler) > 8)
        return f"GaussBonnet(euler [{sums}], gap {self.gap:.1e})"


@checked
def gauss_bonnet(boundary: Boundary, *, angle_scale: float = 1.0) -> GaussBonnet:
    """Curvature of faces, along edges and at vertices of a boundary's closed surfaces, and its sum.

    Parameters
    ----------
    boundary : Boundary
    angle_scale : float, length per radian
        1 in the paper. It moves curvature from one place to another; the sums stay as they are.

    Returns
    -------
    GaussBonnet

    Raises
    ------
    IncompleteError
        If the boundary is incomplete.
    ValueError
        If `angle_scale` is not positive.

    Notes
    -----
    The sum is V - E + F of whatever gluing is given, even of a wrong one: it checks curvatures and angles of faces. The
    gluing is checked by `gauss_map`, and by `gap`.

    Time is linear in the number of coedges, some microseconds each.

    Examples
    --------
    >>> import cfree
    >>> scene = cfree.Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]])
    >>> result = cfree.boundary(scene)
    >>> found = gauss_bonnet(result)
    >>> bool(np.all(abs(found.euler - result.complex.euler) < 1e-8)), found.gap < 1e-12
    (True, True)
    """
    w, cells = check_scale(angle_scale), boundary.complex
    faces, faces_off = _core.trapezoid_curvatures(boundary.core, w)
    sides, sides_error, turns, starts = _core.side_curvatures(boundary.core_complex, w)
    angles = math.pi - turns
    vertices = math.tau - np.bincount(cells.vertex, angles, cells.vertices).astype(np.float64)
    surface, of_vertex = cells.component[cells.face], np.zeros(cells.vertices, np.int32)
    of_vertex[cells.vertex] = surface

    def summed(*parts: tuple[NDArray[Any], NDArray[Any]]) -> Floats:
        """Sums over closed surfaces, with one rounding: terms are many, and large ones cancel."""
        sums = [math.fsum(x for values, of in parts for x in values[of == k].tolist()) for k in range(cells.components)]
        return np.array(sums, np.float64) / math.tau

    euler = summed((faces, cells.component), (sides, surface), (vertices, of_vertex))
    error = summed((faces_off, cells.component), (sides_error, surface))
    return GaussBonnet(
        faces, sides, sides_error, angles, vertices, euler, error, _gap(boundary, starts.reshape(-1, 3), w)
    )


def _gap(boundary: Boundary, starts: Floats, w: float) -> float:
    """Between the places where faces put the vertex at which their coedges start."""
    cells = boundary.complex
    low, high = np.full((cells.vertices, 3), np.inf), np.full((cells.vertices, 3), -np.inf)
    seam = 0.75 * math.tau * w  # there it is -pi/2 as well
    starts[:, 2] = np.where(np.abs(starts[:, 2] - seam) < 1e-12 * w, starts[:, 2] - math.tau * w, starts[:, 2])
    known = np.isfinite(starts[:, 0])
    np.minimum.at(low, cells.vertex[known], starts[known])
    np.maximum.at(high, cells.vertex[known], starts[known])
    met = np.isfinite(low[:, 0])
    return float(np.linalg.norm(high[met] - low[met], axis=1).max(initial=0.0))
