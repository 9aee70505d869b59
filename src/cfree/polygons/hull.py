"""Convex hulls, exactly."""

from __future__ import annotations

from collections.abc import Iterable

from cfree.exact.number import ExactPoint
from cfree.exact.vectors import cross, minus


def convex_hull(points: Iterable[ExactPoint]) -> list[ExactPoint]:
    """Corners of the convex hull of points, counter-clockwise, by Andrew's monotone chain: O(n log n).

    Examples
    --------
    >>> convex_hull([(0, 0), (1, 0), (2, 0), (1, 1), (2, 2)])
    [(0, 0), (2, 0), (2, 2)]
    """
    ordered, ring = sorted(set(points)), list[ExactPoint]()
    for row in (ordered, ordered[::-1]):
        half: list[ExactPoint] = []
        for p in row:
            while len(half) > 1 and cross(minus(half[-1], half[-2]), minus(p, half[-2])) <= 0:
                half.pop()
            half.append(p)
        ring += half[:-1]
    return ring
