"""Geodesics of contact surfaces: their straightest curves.

Let alpha be the angle from the ruling, R^2 = w^2 + s^2, and V = dx / dphi, with parts s across the ruling and k along
it. Then

    phi' = sin(alpha) / R    L t' = cos(alpha) - k phi'    alpha' = -(s / R) phi' on e-v surfaces, 0 on v-e surfaces.

Geodesics of a v-e surface are straight when it is unrolled into the plane: only an elliptic integral has to be
inverted. On e-v surfaces R sin(alpha) + k cos(alpha), the product with the screw motion's velocity S_phi, is constant:
Clairaut's relation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from cfree.arguments import checked
from cfree.exact.number import finite
from cfree.geometry.development import distance_across
from cfree.geometry.ruled import Floats, Ruled, check_scale, read_ruled
from cfree.value import Value

CLOSE = 1e-10  # tolerance per length
MOST_STEPS = 1 << 13


@dataclass(frozen=True, eq=False, repr=False)
class Geodesic(Value):
    """Points of geodesics; see `geodesic`.

    Attributes
    ----------
    t, phi : (...) float64
        Coordinates on the surface.
    xi : (...) float64, radians
        Direction there, from the ruling towards increasing phi.
    error : (...) float64
        Distance by which halving the steps has moved the point, as a length.
    """

    t: Floats
    phi: Floats
    xi: Floats
    error: Floats


@checked
def geodesic(
    ruled: ArrayLike, t: ArrayLike, phi: ArrayLike, xi: ArrayLike, length: ArrayLike, *, angle_scale: float = 1.0
) -> Geodesic:
    """Follow geodesics from points in directions, over lengths.

    Parameters
    ----------
    ruled : (..., 8) float
        `Surface.ruled`, or rows of `Boundary.ruled`; all arguments are broadcast against each other.
    t, phi : (...) float
        Starting point. Geodesics continue beyond the patch, over the whole surface.
    xi : (...) float, radians
        Angle from the ruling, S_t, towards increasing phi.
    length : (...) float
        Length in the metric dx^2 + dy^2 + angle_scale^2 dtheta^2; backwards if negative.
    angle_scale : float, length per radian
        1 in the paper.

    Returns
    -------
    Geodesic

    Raises
    ------
    ValueError
        If a number is not finite, `angle_scale` is not positive, or a row is no contact surface.

    Notes
    -----
    On e-v surfaces: Runge and Kutta's method of order four, with steps halved until that moves points less than 1e-10
    of the longest length. On v-e surfaces geodesics are straight in `develop`, and only an integral is inverted, to
    rounding.

    Examples
    --------
    The ruling itself, and a geodesic along the axis of a helicoid, its striction curve.

    >>> from cfree.contact import EdgeVertex, contact_surface
    >>> from cfree import Polygon
    >>> S = contact_surface(Polygon([(-1, 0), (1, 0), (0, 1)]), Polygon([(0, 0), (1, 0), (0, 1)]), EdgeVertex(0, 0))
    >>> float(geodesic(S.ruled, 0, 0, 0, 1).t)
    0.5
    >>> ends = geodesic(S.ruled, 0.5, 0, np.pi / 2, [1, 2])
    >>> ends.t, ends.phi                    # the axis is a straight line
    (array([0.5, 0.5]), array([1., 2.]))
    """
    w, rows = check_scale(angle_scale), np.concatenate(read_ruled(ruled), axis=-1)
    start = [finite(name, values) for name, values in (("t", t), ("phi", phi), ("xi", xi), ("length", length))]
    shape = np.broadcast_shapes(rows.shape[:-1], *(values.shape for values in start))
    surfaces = read_ruled(np.broadcast_to(rows, (*shape, 8)))
    t, phi, xi, length = (np.broadcast_to(values, shape).astype(np.float64) for values in start)
    turns = surfaces.is_edge_vertex
    across = np.where(turns, 0.0, length * np.sin(xi))
    straight = _straight(surfaces, phi, across, w)
    # v-e: Y of `develop` grows by the length along the ruling
    offset = surfaces.across_and_along(t, phi)[0] - surfaces.across_and_along(t, straight)[0]
    along = t + (length * np.cos(xi) + offset) / surfaces.L
    bent, error = _bent(surfaces, np.stack([t, phi, xi]), np.where(turns, length, 0.0), w)
    ends = np.where(turns, bent, np.stack([along, straight, xi]))
    return Geodesic(ends[0], ends[1], ends[2], error)


def _straight(rows: Ruled, phi: Floats, across: Floats, w: float) -> Floats:
    """Angles at a distance across the rulings of v-e surfaces, by Newton's method; a radian is at least w long."""
    angle = phi + across / np.hypot(w, rows.across_and_along(np.zeros(()), phi)[0])
    for _ in range(60):
        left = across - distance_across(rows, phi, angle, w)
        step = left / np.hypot(w, rows.across_and_along(np.zeros(()), angle)[0])
        # a step is too long if some place on its way is steeper than this one
        angle = angle + np.clip(step, -0.5, 0.5)
        if not step.size or np.abs(step).max() <= 4e-16 * max(1.0, float(np.abs(angle).max())):
            break
    return angle


def _bent(rows: Ruled, start: Floats, length: Floats, w: float) -> tuple[Floats, Floats]:
    """Ends of geodesics of e-v surfaces, and the distance by which halving the steps has moved them."""

    def slope(state: Floats) -> Floats:
        t, phi, alpha = state
        s, k = rows.across_and_along(t, phi)
        R = np.hypot(w, s)
        turn = np.sin(alpha) / R
        return np.stack([(np.cos(alpha) - k * turn) / rows.L, turn, -s / R * turn])

    def run(steps: int) -> Floats:
        state, h = start, length / steps
        for _ in range(steps):
            a = slope(state)
            b = slope(state + h / 2 * a)
            c = slope(state + h / 2 * b)
            d = slope(state + h * c)
            state = state + h / 6 * (a + 2 * b + 2 * c + d)
        return state

    enough, steps, coarse = CLOSE * float(np.abs(length).max(initial=0.0)), 16, run(8)
    while True:
        fine = run(steps)
        s, k = rows.across_and_along(fine[0], fine[1])
        dt, dphi, _ = fine - coarse
        error: Floats = np.hypot(rows.L * dt + k * dphi, np.hypot(w, s) * dphi)
        if error.max(initial=0.0) <= enough or steps == MOST_STEPS:
            return fine, error
        coarse, steps = fine, 2 * steps
