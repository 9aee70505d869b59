"""Polygons around discs and inside them."""

from __future__ import annotations

import math
from fractions import Fraction

from cfree.exact.number import ExactPoint

GRID, SLACK = 2**24, 2.0**-20  # for polygons of a disc of radius 1; SLACK exceeds their rounding


def around_disc(radius: Fraction, sides: int) -> list[ExactPoint]:
    """Return a polygon of 4 k sides around a disc about the origin; four sides touch it, in x and in y.

    Examples
    --------
    >>> ring = around_disc(Fraction(1), 8)
    >>> max(x for x, y in ring), round(math.hypot(*ring[0]) * math.cos(math.pi / 8), 4)
    (Fraction(1, 1), 1.0)
    """
    far = (1 + SLACK) / math.cos(math.pi / sides)
    ring = _ring(far, [math.pi * (2 * k + 1) / sides for k in range(sides)])
    # the touching sides are a little longer than necessary, so that their neighbours do not touch
    half = Fraction(math.ceil((math.tan(math.pi / sides) + 16 * SLACK) * GRID), GRID)
    for quarter in range(4):
        c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarter]
        k = quarter * sides // 4
        ring[k - 1], ring[k] = (c + half * s, s - half * c), (c - half * s, s + half * c)
    return [(radius * x, radius * y) for x, y in ring]


def inside_disc(radius: Fraction, sides: int) -> list[ExactPoint]:
    """Return a polygon whose vertices are in a disc about the origin, and not on its rim.

    Examples
    --------
    >>> [math.hypot(x, y) < 1 for x, y in inside_disc(Fraction(1), 4)]
    [True, True, True, True]
    """
    ring = _ring(1 - SLACK, [2 * math.pi * k / sides for k in range(sides)])
    return [(radius * x, radius * y) for x, y in ring]


def _ring(far: float, angles: list[float]) -> list[ExactPoint]:
    places = ((far * math.cos(a), far * math.sin(a)) for a in angles)
    return [(Fraction(round(x * GRID), GRID), Fraction(round(y * GRID), GRID)) for x, y in places]
