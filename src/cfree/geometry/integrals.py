"""Integrals over contact patches and trapezoids: of the area element v, and of K v.

The metric is dx^2 + dy^2 + angle_scale^2 dtheta^2, the area element v dt dphi (section 4). Integrals along a ruling are
exact; with ds = L dt,

    v, e-v:    integral of sqrt(w^2 + s^2) ds = [s sqrt(w^2 + s^2) + w^2 arsinh(s / w)] / 2 for any phi
    v, v-e:    sqrt(w^2 + s(phi)^2) L (t_1 - t_0)
    K v, e-v:  K v dt = -d(s / sqrt(w^2 + s^2)): a difference of two sines, of the angles between the surface's normal
               and the plane at the ends
    K v, v-e:  0
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

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
def patch_curvatures(ruled: ArrayLike, phi_range: ArrayLike, *, angle_scale: float = 1.0) -> Floats:
    """Integrals of K over whole patches, t in [0, 1], in closed form.

    Parameters
    ----------
    ruled : (..., 8) float
        `Surface.ruled` or `Boundary.ruled`; broadcast against phi_range.
    phi_range : (...) float, radians
        Width as in `angle_range` or `Boundary`; other widths give the integral over that part of the surface.
    angle_scale : float, length per radian
        1 in the paper.

    Returns
    -------
    (...) float64
        Integrals without unit: 0 on v-e patches, between -2 phi_range and 0 on e-v patches.

    Raises
    ------
    ValueError
        If a range is negative, a number not finite, `angle_scale` not positive, or a row no contact surface.

    Notes
    -----
    The value is phi_range times s_0 / sqrt(w^2 + s_0^2) - s_1 / sqrt(w^2 + s_1^2). Here s is the position along the
    robot's edge from the foot of the perpendicular from the reference point. The area of the Gauss map's image is minus
    that.

    Examples
    --------
    >>> from cfree.contact import EdgeVertex, angle_range, contact_surface
    >>> from cfree import Polygon
    >>> square = Polygon([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    >>> S, Phi = contact_surface(square, square, EdgeVertex(0, 0)), angle_range(square, square, EdgeVertex(0, 0))
    >>> float(patch_curvatures(S.ruled, Phi.phi_range) / (-np.pi / np.sqrt(2)))
    1.0
    """
    w, width = check_scale(angle_scale), read_width(phi_range)
    return width * along_rulings(_core.ruling_curvatures, ruled, np.zeros_like(width), w)


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
    return _over_trapezoids(_core.trapezoid_areas, boundary, angle_scale)


@checked
def trapezoid_curvatures(boundary: Boundary, *, angle_scale: float = 1.0) -> Floats:
    """Integrals of K over the trapezoids of a boundary, (T,).

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
    The integral over t is exact, the one over theta is by quadrature, as in `trapezoid_areas`.
    """
    return _over_trapezoids(_core.trapezoid_curvatures, boundary, angle_scale)


def _over_trapezoids(
    integrals: Callable[[Any, float], tuple[Floats, Floats]], boundary: Boundary, angle_scale: float
) -> Floats:
    """Return the integrals that the core computes, without their measured errors."""
    w = check_scale(angle_scale)
    boundary.require_complete()
    return integrals(boundary._handle, w)[0]
