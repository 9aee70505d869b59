"""Integrals over the trapezoids of a boundary: along t in closed form, over theta by quadrature."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

import cfree._core as _core
from cfree.geometry.ruled import Floats

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary
    from cfree.forbidden.columns import Ints

NODES = 8  # over an interval of orientations

# (which trapezoids, their limits of t, theta) to the integral over t
Integrand = Callable[["Ints", Floats, Floats, Floats], Floats]


def trapezoid_integrals(boundary: Boundary, along_t: Integrand) -> Floats:
    """Integral over theta of an integral along t, for each trapezoid.

    Notes
    -----
    Gauss-Legendre quadrature on intervals that are halved until halving changes less than 1e-12 of the value, or of the
    mean of all, in absolute value: a measured error, no proved one.
    """
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    return _core.trapezoid_integrals(boundary.core, nodes.tolist(), weights.tolist(), along_t)
