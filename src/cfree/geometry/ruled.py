"""Read and check contact surfaces given as rows of eight numbers p, q, a, g.

S(t, phi) = p + t q - R(phi) (a + t g), where q = E_j and g = 0 (v-e) or q = 0 and g = E_i (e-v): `Surface.ruled`, or
rows of `Boundary.ruled`. All arrays are broadcast against each other.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cfree.exact.number import finite

Floats = NDArray[np.float64]


class Ruled(NamedTuple):
    """Vectors of contact surfaces, (..., 2) each: one of q and g is 0."""

    p: Floats
    q: Floats
    a: Floats
    g: Floats

    @property
    def is_edge_vertex(self) -> NDArray[np.bool_]:
        """True for each e-v contact, (...)."""
        return np.asarray(self.g.any(axis=-1))

    @property
    def L(self) -> Floats:
        """Length of the edge, and of the rulings, (...)."""
        edge = self.q + self.g
        return np.hypot(edge[..., 0], edge[..., 1])

    def ruling(self, phi: Floats) -> Floats:
        """Unit vectors along S_t, (..., 2): along q, or along -R(phi) g."""
        d, is_edge = self._direction, self.is_edge_vertex
        return np.stack(_turned(np.where(is_edge, -np.cos(phi), 1.0), np.where(is_edge, -np.sin(phi), 0.0), d), -1)

    def across_and_along(self, t: Floats, phi: Floats) -> tuple[Floats, Floats]:
        """Parts s and k of V = dx / dphi, across the ruling and along it; on e-v surfaces phi does not matter."""
        d, is_edge = self._direction, self.is_edge_vertex
        # e-v: robot and obstacle are rotated back together, so that no rounding of phi enters
        ax, ay = _turned(np.where(is_edge, 1.0, np.cos(phi)), np.where(is_edge, 0.0, np.sin(phi)), self.a)
        sign = np.where(is_edge, 1.0, -1.0)
        s = sign * (d[..., 0] * ax + d[..., 1] * ay) + np.where(is_edge, t * self.L, 0.0)
        return s, sign * (ax * d[..., 1] - ay * d[..., 0])

    @property
    def _direction(self) -> Floats:
        direction: Floats = (self.q + self.g) / self.L[..., None]
        return direction


def read_ruled(ruled: ArrayLike) -> Ruled:
    """Split rows of eight numbers into four vectors.

    Raises
    ------
    ValueError
        If a row does not consist of eight finite numbers, or if not exactly one of its q and g is 0.

    Examples
    --------
    >>> read_ruled([0, 0, 1, 0, 0, 0, 0, 2])
    Traceback (most recent call last):
        ...
    ValueError: ruled: row [0. 0. 1. 0. 0. 0. 0. 2.] is no contact surface; one of q and g must be 0, the other not
    """
    rows = finite("ruled", ruled)
    if rows.ndim == 0 or rows.shape[-1] != 8:
        raise ValueError(f"ruled: shape {rows.shape}; give rows p, q, a, g of eight numbers, such as Surface.ruled")
    moves, turns = rows[..., 2:4].any(axis=-1), rows[..., 6:8].any(axis=-1)
    if (moves == turns).any():
        row = rows[moves == turns][0]
        raise ValueError(f"ruled: row {row} is no contact surface; one of q and g must be 0, the other not")
    return Ruled(rows[..., 0:2], rows[..., 2:4], rows[..., 4:6], rows[..., 6:8])


def along_rulings(
    integral: Callable[[Floats, Floats, float], Floats], ruled: ArrayLike, phi: Floats, w: float
) -> Floats:
    """Apply an integral of the core along whole rulings, t in [0, 1], at phi."""
    rows = np.concatenate(read_ruled(ruled), axis=-1)
    shape = np.broadcast_shapes(rows.shape[:-1], phi.shape)
    flat = np.ascontiguousarray(np.broadcast_to(rows, (*shape, 8)).reshape(-1, 8))
    return integral(flat, np.ascontiguousarray(np.broadcast_to(phi, shape).reshape(-1)), w).reshape(shape)


def read_width(phi_range: ArrayLike) -> Floats:
    """Check widths of contact ranges: finite and not negative."""
    width = finite("phi_range", phi_range)
    if np.any(width < 0):
        raise ValueError(f"phi_range: {width.min()} is negative; give the width of the range in radians")
    return width


def check_scale(angle_scale: float) -> float:
    """Check the length of a radian: finite and positive."""
    if not 0 < angle_scale < math.inf:
        raise ValueError(f"angle_scale: {angle_scale}; give a finite length per radian above 0")
    return float(angle_scale)


def _turned(c: Floats, n: Floats, u: Floats) -> tuple[Floats, Floats]:
    return c * u[..., 0] - n * u[..., 1], n * u[..., 0] + c * u[..., 1]
