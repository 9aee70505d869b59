"""Shrink polygons by moving edges inwards; exact tests confirm that results are strictly inside."""

from __future__ import annotations

import math
from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import cfree._core as _core
from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon, polygon_of

FINER = 12  # bits of an inset that the rounding of its polygons leaves


def inset(polygon: Polygon, by: Fraction) -> list[Polygon]:
    """Return polygons strictly inside one, with edges moved inwards; none if nothing is left or rounding prevents it.

    Notes
    -----
    Corners are mitred. If that leaves a simple polygon inside, it is taken, for any inset (``inset.cpp``); else
    shapely's result is. Both are rounded to a grid much finer than the inset, if that leaves them inside: numbers are
    short then, and nearly parallel edges are less so.

    Examples
    --------
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> [part.exact_area for part in inset(square, Fraction(1, 4))], inset(square, Fraction(1, 2))
    ([Fraction(1, 4)], [])
    """
    if mitred := _core.inset(polygon._handle, by.numerator, by.denominator):
        return [polygon_of(mitred)]
    import shapely  # imported late: most insets are mitred

    grid = Fraction(2) ** (math.frexp(by)[1] - FINER)

    def snapped(points: Iterable[tuple[Any, Any]]) -> list[ExactPoint]:
        return [(round(Fraction(x) / grid) * grid, round(Fraction(y) / grid) * grid) for x, y in points]

    parts = []
    for part in shapely.get_parts(polygon.to_shapely().buffer(-float(by), join_style="mitre")):
        try:
            smaller = Polygon(snapped(part.exterior.coords), [snapped(ring.coords) for ring in part.interiors])
        except ValueError:  # not simple, or too thin for the grid
            continue
        if smaller._handle.is_inside(polygon._handle):
            parts.append(smaller)
    return parts
