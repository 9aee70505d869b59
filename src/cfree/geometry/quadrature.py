"""Integrals over the trapezoids of a boundary: along t in closed form, over theta by quadrature."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from cfree.geometry.ruled import Floats

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary
    from cfree.forbidden.columns import Ints

NODES = 8  # over an interval of orientations
CLOSE = 1e-12
HALVINGS = 12

# (which trapezoids, their limits of t, theta) to the integral over t
Integrand = Callable[["Ints", Floats, Floats, Floats], Floats]


def trapezoid_integrals(boundary: Boundary, along_t: Integrand) -> Floats:
    """Integral over theta of an integral along t, for each trapezoid.

    Notes
    -----
    Gauss-Legendre quadrature on intervals that are halved until halving changes less than 1e-12 of the value, or of the
    mean of all, in absolute value: a measured error, no proved one.
    """
    table = boundary.trapezoids
    nodes, weights = np.polynomial.legendre.leggauss(NODES)

    def integrals(which: Ints, start: Floats, stop: Floats) -> Floats:
        half, total = (stop - start) / 2, np.zeros(len(which))
        for node, weight in zip(nodes, weights, strict=True):
            theta = start + half * (1 + node)
            lower, upper = (np.clip(t, 0, 1) for t in boundary.limits(which, theta))
            total += weight * half * along_t(which, lower, np.maximum(lower, upper), theta)
        return total

    which, start, stop = np.arange(len(table), dtype=np.int32), table.theta_from, table.theta_to
    coarse = integrals(which, start, stop)
    found, mean = np.zeros(len(table)), np.abs(coarse).sum() / max(1, len(table))
    for _ in range(HALVINGS):
        middle = (start + stop) / 2
        parts = integrals(which, start, middle), integrals(which, middle, stop)
        fine = parts[0] + parts[1]
        done = abs(fine - coarse) <= CLOSE * np.maximum(abs(fine), mean)
        np.add.at(found, which[done], fine[done])
        rest = ~done
        coarse = np.concatenate([part[rest] for part in parts])
        start, stop = np.concatenate((start[rest], middle[rest])), np.concatenate((middle[rest], stop[rest]))
        which = np.concatenate((which[rest], which[rest]))
    np.add.at(found, which, coarse)
    return found
