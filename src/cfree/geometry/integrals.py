"""Areas of contact patches and of trapezoids, in the metric dx^2 + dy^2 + angle_scale^2 dtheta^2.

The area element is v dt dphi (section 4). The integral along a ruling is exact; with ds = L dt,

    e-v:  integral of sqrt(w^2 + s^2) ds = [s sqrt(w^2 + s^2) + w^2 arsinh(s / w)] / 2 for any phi
    v-e:  sqrt(w^2 + s(phi)^2) L (t_1 - t_0)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

import cfree._core as _core
from cfree.arguments import checked
from cfree.exact.number import finite
from cfree.forbidden.boundary import Boundary
from cfree.geometry.development import distance_across
from cfree.geometry.ruled import Floats, along_rulings, check_scale, read_ruled, read_width


@checked
def patch_areas(ruled: ArrayLike, phi_min: ArrayLike, phi_range: ArrayLike, *, angle_scale: float = 1.0) -> Floats:
    """Areas of whole patches, t in [0, 1], in closed form.

    Parameters
    ----------
    ruled : (..., 8) float
        `Surface.ruled` or `Boundary.ruled`; all arguments are broadcast against each other.
    phi_min, phi_range : (...) float, radians
        Range as in `angle_range` or `Boundary`; other ranges give the area of that part of the surface.
    angle_scale : float, length per radian
        1 in the paper.

    Returns
    -------
    (...) float64
        Areas in length^2.

    Raises
    ------
    ValueError
        If a range is negative, a number not finite, `angle_scale` not positive, or a row no contact surface.

    Notes
    -----
    An e-v patch has phi_range times the integral at the top of this file, for every phi_min. A v-e patch has the area
    of its development: L times an elliptic integral of the second kind. Both are differences. They lose digits if the
    edge is short and far from the foot of the perpendicular, or if the range is narrow: measured, about as many digits
    as s / L, or 1 / phi_range, has.

    Examples
    --------
    >>> from cfree.contact import EdgeVertex, angle_range, contact_surface
    >>> from cfree import Polygon
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> S, Phi = contact_surface(square, square, EdgeVertex(0, 0)), angle_range(square, square, EdgeVertex(0, 0))
    >>> float(patch_areas(S.ruled, Phi.phi_min, Phi.phi_range) / (np.pi / 4 * (np.sqrt(2) + np.arcsinh(1))))
    1.0
    """
    w = check_scale(angle_scale)
    rows = read_ruled(ruled)
    start, width = finite("phi_min", phi_min), read_width(phi_range)
    swept = width * along_rulings(_core.ruling_areas, ruled, start, w)
    unrolled = rows.L * distance_across(rows, start, start + width, w)
    return np.where(rows.is_edge_vertex, swept, unrolled)


@checked
def trapezoid_areas(boundary: Boundary, *, angle_scale: float = 1.0) -> Floats:
    """Areas of the trapezoids of a boundary, (T,), in length^2; they add up to the boundary's area.

    Parameters
    ----------
    boundary : Boundary
    angle_scale : float, length per radian
        1 in the paper.

    Raises
    ------
    IncompleteError
        If the boundary is incomplete.
    ValueError
        If `angle_scale` is not positive.

    Notes
    -----
    The integral over t is exact. The one over theta is by Gauss-Legendre quadrature, on intervals that are halved until
    halving changes less than 1e-12 of the value, or of the mean of all: a measured error, not a proved one. Time and
    memory are about linear in the number of trapezoids.
    """
    w = check_scale(angle_scale)
    boundary.require_complete()
    return _core.trapezoid_areas(boundary.core, w)[0]
