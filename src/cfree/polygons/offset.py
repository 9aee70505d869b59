"""Polygons strictly inside others, by exact tests: edges moved inwards."""

from __future__ import annotations

import math
from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import cfree._core as _core
from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon, polygon_of

FINER = 12  # bits of an inset that survive the rounding of its polygons


def inset(polygon: Polygon, by: Fraction) -> list[Polygon]:
    """Polygons strictly inside one, their edges moved inwards; none if nothing is left, or rounding is in the way.

    Notes
    -----
    Corners are mitred. If that leaves a simple polygon inside, it is taken, however small the inset (``inset.cpp``);
    else what shapely makes of it. Both are rounded to a grid much finer than the inset, if that leaves them inside:
    numbers are short then, and edges that were nearly parallel to others are less so.

    Examples
    --------
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> [part.exact_area for part in inset(square, Fraction(1, 4))], inset(square, Fraction(1, 2))
    ([Fraction(1, 4)], [])
    """
    if mitred := _core.inset(polygon.core, by.numerator, by.denominator):
        return [polygon_of(mitred)]
    import shapely  # here: most insets are mitred

    grid = Fraction(2) ** (math.frexp(by)[1] - FINER)

    def snapped(points: Iterable[tuple[Any, Any]]) -> list[ExactPoint]:
        return [(round(Fraction(x) / grid) * grid, round(Fraction(y) / grid) * grid) for x, y in points]

    found = []
    for part in shapely.get_parts(polygon.to_shapely().buffer(-float(by), join_style="mitre")):
        try:
            smaller = Polygon(snapped(part.exterior.coords), [snapped(ring.coords) for ring in part.interiors])
        except ValueError:  # not simple, or too thin for the grid
            continue
        if smaller.core.is_inside(polygon.core):
            found.append(smaller)
    return found
