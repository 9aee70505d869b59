"""Gauss and Bonnet's theorem on the closed surfaces of a boundary: curvature adds up to 2 pi times Euler's number.

The curvature of a closed surface with edges is in three places: on faces, K; along edges, the geodesic curvatures of
both faces there; and at vertices, 2 pi minus the angles of the faces around. Each is computed from the equations of
surfaces and curves. Every face satisfies the theorem alone, so the sum is V - E + F for any gluing: it checks K,
geodesic curvatures and angles, but not the gluing. `gauss_map` checks the gluing. docs/theory/surface-geometry.md,
"Gauss and Bonnet", has the proof.
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
        Integral of the geodesic curvature along each coedge, in the direction of its loop: positive for left turns,
        seen from the free side. It is 0 along walls that are straight lines.
    sides_error : (H,) float64
        Change of `sides` when the intervals of quadrature are halved: a measured error.
    angles : (H,) float64, radians
        The face's angle between a coedge and the one before it.
    vertices : (V,) float64
        2 pi minus the angles around each vertex.
    euler : (C,) float64
        Sum of the curvature of each closed surface, over 2 pi.
    error : (C,) float64
        Error of `euler` by quadrature, measured in the same way.
    gap : float
        Greatest distance between the places that two faces compute for a shared vertex, as a length. It is rounding if
        the faces fit.
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
    """Curvature on faces, along edges and at vertices of a boundary's closed surfaces, and its sum.

    Parameters
    ----------
    boundary : Boundary
    angle_scale : float, length per radian
        1 in the paper. It moves curvature from one place to another; the sums do not change.

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
    The sum is V - E + F for any gluing, even a wrong one: it checks curvatures and angles of faces. `gauss_map` and
    `gap` check the gluing.

    Among rounded shapes sums have half of the digits of doubles where circles are touched: angles there are known to
    1e-8, and `error` does not count this.

    Time is linear in the number of coedges, some microseconds each.

    Examples
    --------
    >>> import cfree
    >>> scene = cfree.Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]])
    >>> result = cfree.boundary(scene)
    >>> sums = gauss_bonnet(result)
    >>> bool(np.all(abs(sums.euler - result.complex.euler) < 1e-8)), sums.gap < 1e-12
    (True, True)
    """
    w, cells = check_scale(angle_scale), boundary.complex
    faces, faces_off = _core.trapezoid_curvatures(boundary._handle, w)
    sides, sides_error, turns, starts = _core.side_curvatures(boundary._complex_handle, w)
    angles = math.pi - turns
    vertices = math.tau - np.bincount(cells.vertex, angles, cells.vertices).astype(np.float64)
    surface, component = cells.component[cells.face], np.zeros(cells.vertices, np.int32)
    component[cells.vertex] = surface

    def summed(*parts: tuple[NDArray[Any], NDArray[Any]]) -> Floats:
        """Sums over closed surfaces, with one rounding: terms are many, and large ones cancel."""
        sums = [math.fsum(x for values, n in parts for x in values[n == k].tolist()) for k in range(cells.components)]
        return np.array(sums, np.float64) / math.tau

    euler = summed((faces, cells.component), (sides, surface), (vertices, component))
    error = summed((faces_off, cells.component), (sides_error, surface))
    return GaussBonnet(
        faces, sides, sides_error, angles, vertices, euler, error, _gap(boundary, starts.reshape(-1, 3), w)
    )


def _gap(boundary: Boundary, starts: Floats, w: float) -> float:
    """Greatest distance between the places that faces compute for the vertex at which their coedges start."""
    cells = boundary.complex
    low, high = np.full((cells.vertices, 3), np.inf), np.full((cells.vertices, 3), -np.inf)
    seam = 0.75 * math.tau * w  # 3 pi/2, the same place as -pi/2
    starts[:, 2] = np.where(np.abs(starts[:, 2] - seam) < 1e-12 * w, starts[:, 2] - math.tau * w, starts[:, 2])
    known = np.isfinite(starts[:, 0])
    np.minimum.at(low, cells.vertex[known], starts[known])
    np.maximum.at(high, cells.vertex[known], starts[known])
    met = np.isfinite(low[:, 0])
    return float(np.linalg.norm(high[met] - low[met], axis=1).max(initial=0.0))
