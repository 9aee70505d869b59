"""Minkowski sums of convex polygons, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

Point = tuple[Any, Any]  # pairs of int, Fraction, or elements of a number field


def convex_sum(first: Sequence[Point], second: Sequence[Point]) -> list[Point]:
    """Minkowski sum of two convex rings, counter-clockwise.

    Examples
    --------
    >>> convex_sum([(0, 0), (1, 0), (0, 1)], [(0, 0), (2, 0), (2, 2), (0, 2)])
    [(0, 0), (3, 0), (3, 2), (2, 3), (0, 3)]
    """
    terms = ((first[i], second[j]) for i, j in summands(first, second))
    return [(x[0] + y[0], x[1] + y[1]) for x, y in terms]


def summands(first: Sequence[Point], second: Sequence[Point]) -> list[tuple[int, int]]:
    """Pairs of vertices that add up to the vertices of the sum; edges are merged by direction, in O(m + n)."""
    (p, u), (q, v) = (_from_the_lowest(ring) for ring in (first, second))
    i = j = 0
    pairs = []
    while i < len(u) or j < len(v):
        pairs.append((p[i % len(p)], q[j % len(q)]))
        order = -1 if i == len(u) else 1 if j == len(v) else u[i][0] * v[j][1] - u[i][1] * v[j][0]
        i, j = i + (order >= 0), j + (order <= 0)
    return pairs


def _from_the_lowest(ring: Sequence[Point]) -> tuple[list[int], list[Point]]:
    """Numbers of the vertices from the lowest on, and the edges that begin there."""
    k = min(range(len(ring)), key=lambda k: (ring[k][1], ring[k][0]))
    order = [*range(k, len(ring)), *range(k)]
    ends = [(ring[i], ring[(i + 1) % len(ring)]) for i in order]
    return order, [(x1 - x0, y1 - y0) for (x0, y0), (x1, y1) in ends]
