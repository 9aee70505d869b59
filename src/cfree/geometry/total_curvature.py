"""Integrals of the Gaussian curvature over contact patches and trapezoids.

On e-v surfaces K v dt = -d(s / sqrt(w^2 + s^2)). So the integral of K along a ruling is a difference of two sines, of
the angles between the surface's normal and the plane at its ends. On v-e surfaces K = 0.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

import cfree._core as _core
from cfree.arguments import checked
from cfree.forbidden.boundary import Boundary
from cfree.geometry.ruled import Floats, along_rulings, check_scale, read_width


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
    w = check_scale(angle_scale)
    boundary.require_complete()
    return _core.trapezoid_curvatures(boundary.core, w)[0]
