"""Polygons strictly inside others, by exact tests: edges moved inwards."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np

from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon

FINER = 12  # bits of an inset that survive the rounding of its polygons


def inset(polygon: Polygon, by: Fraction) -> list[Polygon]:
    """Polygons strictly inside one, their edges moved inwards; none if nothing is left, or rounding is in the way.

    Notes
    -----
    Corners are mitred. If that leaves a simple polygon inside, it is taken, however small the inset; else what shapely
    makes of it. Both are rounded to a grid much finer than the inset, if that leaves them inside: numbers are short
    then, and edges that were nearly parallel to others are less so.

    Examples
    --------
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> [part.exact_area for part in inset(square, Fraction(1, 4))], inset(square, Fraction(1, 2))
    ([Fraction(1, 4)], [])
    """
    import shapely  # here: most plans need no inset

    grid = Fraction(2) ** (math.frexp(by)[1] - FINER)

    def snapped(points: Iterable[tuple[Any, Any]]) -> list[ExactPoint]:
        return [(round(Fraction(x) / grid) * grid, round(Fraction(y) / grid) * grid) for x, y in points]

    def candidates() -> Iterator[list[list[list[ExactPoint]]]]:
        if rings := _mitred(polygon, by):
            yield [[*map(snapped, rings)]]
            yield [rings]
        parts = shapely.get_parts(polygon.to_shapely().buffer(-float(by), join_style="mitre"))
        yield [[snapped(ring.coords) for ring in (part.exterior, *part.interiors)] for part in parts]

    for parts in candidates():
        found = []
        for outer, *holes in parts:
            try:
                smaller = Polygon(outer, holes)
            except ValueError:  # not simple, or too thin for the grid
                continue
            if smaller.core.is_inside(polygon.core):
                found.append(smaller)
        if found:
            return found
    return []


def _mitred(polygon: Polygon, by: Fraction) -> list[list[ExactPoint]]:
    """Rings whose edges have moved inwards, as far as directions of vertices can be rounded; none if an edge turns."""
    U = polygon.edges / np.hypot(*polygon.edges.T)[:, None]
    normal = np.stack((-U[:, 1], U[:, 0]), axis=1)
    before = normal[polygon.previous]
    m = (before + normal) / np.maximum(1 + (before * normal).sum(axis=1), 1e-9)[:, None]
    moved = [
        (x + by * Fraction(dx), y + by * Fraction(dy))
        for (x, y), (dx, dy) in zip(polygon.exact_vertices, m.tolist(), strict=True)
    ]
    ends = zip(moved, [moved[k] for k in polygon.next.tolist()], polygon.edge_numerators, strict=True)
    if any((x1 - x0) * u + (y1 - y0) * v <= 0 for (x0, y0), (x1, y1), (u, v) in ends):
        return []
    return [moved[i:j] for i, j in pairwise(polygon.ring_offsets)]
