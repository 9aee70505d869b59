"""Geodesics of contact surfaces: where one gets by going straight ahead on them.

With alpha the angle from the ruling, R^2 = w^2 + s^2, and V = dx / dphi, which is s across the ruling and k along it,

    phi' = sin(alpha) / R    L t' = cos(alpha) - k phi'    alpha' = -(s / R) phi' on e-v surfaces, 0 on v-e surfaces.

A v-e surface unrolled into the plane has straight geodesics: only an elliptic integral is left to be inverted. On e-v
surfaces R sin(alpha) + k cos(alpha), the product with the screw motion's velocity S_phi, stays the same: Clairaut's
relation.
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

CLOSE = 1e-10  # of the length
MOST_STEPS = 1 << 13


@dataclass(frozen=True, eq=False, repr=False)
class Geodesic(Value):
    """Points of geodesics; see `geodesic`.

    Attributes
    ----------
    t, phi : (...) float64
        Where they are on the surface.
    xi : (...) float64, radians
        Their direction there, from the ruling towards increasing phi.
    error : (...) float64
        In length: by how much halving the steps has moved the point.
    """

    t: Floats
    phi: Floats
    xi: Floats
    error: Floats


@checked
def geodesic(
    ruled: ArrayLike, t: ArrayLike, phi: ArrayLike, xi: ArrayLike, length: ArrayLike, *, angle_scale: float = 1.0
) -> Geodesic:
    """Points of geodesics from a point in a direction, at lengths.

    Parameters
    ----------
    ruled : (..., 8) float
        `Surface.ruled`, or rows of `Boundary.ruled`; all arguments are broadcast against each other.
    t, phi : (...) float
        Where they start. They go on beyond the patch, over the whole surface.
    xi : (...) float, radians
        Angle from the ruling, S_t, towards increasing phi.
    length : (...) float
        How far to go, in the metric dx^2 + dy^2 + angle_scale^2 dtheta^2; back if negative.
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
    By Runge and Kutta's method of order four, with steps halved until that moves points less than 1e-10 of the longest
    length; on v-e surfaces, where the way is straight in `develop`, only an integral is inverted, to rounding.

    Examples
    --------
    The ruling itself, and a way across the striction curve of a helicoid.

    >>> from cfree.contact import EdgeVertex, contact_surface
    >>> from cfree import Polygon
    >>> S = contact_surface(Polygon([(-1, 0), (1, 0), (0, 1)]), Polygon([(0, 0), (1, 0), (0, 1)]), EdgeVertex(0, 0))
    >>> float(geodesic(S.ruled, 0, 0, 0, 1).t)
    0.5
    >>> found = geodesic(S.ruled, 0.5, 0, np.pi / 2, [1, 2])
    >>> found.t, found.phi                  # the axis is a straight line
    (array([0.5, 0.5]), array([1., 2.]))
    """
    w, rows = check_scale(angle_scale), np.concatenate(read_ruled(ruled), axis=-1)
    start = [finite(name, of) for name, of in (("t", t), ("phi", phi), ("xi", xi), ("length", length))]
    shape = np.broadcast_shapes(rows.shape[:-1], *(of.shape for of in start))
    surfaces = read_ruled(np.broadcast_to(rows, (*shape, 8)))
    t, phi, xi, length = (np.broadcast_to(of, shape).astype(np.float64) for of in start)
    turns = surfaces.is_edge_vertex
    across = np.where(turns, 0.0, length * np.sin(xi))
    straight = _straight(surfaces, phi, across, w)
    # v-e: Y of `develop` grows by the length along the ruling
    offset = surfaces.across_and_along(t, phi)[0] - surfaces.across_and_along(t, straight)[0]
    along = t + (length * np.cos(xi) + offset) / surfaces.L
    bent, error = _bent(surfaces, np.stack([t, phi, xi]), np.where(turns, length, 0.0), w)
    found = np.where(turns, bent, np.stack([along, straight, xi]))
    return Geodesic(found[0], found[1], found[2], error)


def _straight(rows: Ruled, phi: Floats, across: Floats, w: float) -> Floats:
    """Angles so far across the rulings of v-e surfaces, by Newton's method: the length grows by w or more a radian."""
    at = phi + across / np.hypot(w, rows.across_and_along(np.zeros(()), phi)[0])
    for _ in range(60):
        left = across - distance_across(rows, phi, at, w)
        step = left / np.hypot(w, rows.across_and_along(np.zeros(()), at)[0])
        # a step may be too long by as much as the steepest place is steeper than this one
        at = at + np.clip(step, -0.5, 0.5)
        if not step.size or np.abs(step).max() <= 4e-16 * max(1.0, float(np.abs(at).max())):
            break
    return at


def _bent(rows: Ruled, start: Floats, length: Floats, w: float) -> tuple[Floats, Floats]:
    """Geodesics of e-v surfaces, and by how much halving the steps has moved their ends."""

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
