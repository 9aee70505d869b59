"""Convex features that grow in the plane until they separate two points.

The nerve of grown convex sets has the cycles of their union. So features are the nodes of a graph, with an edge for
each two that meet. An edge is also a path in the plane, through both features; its parity tells how often it crosses
the two rays from the points in the direction of x, modulo 2. The points are separated when a cycle of odd parity
appears.
docs/theory/separations.md, "The widest way of a disc".
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple, cast

from cfree.exact.number import ExactPoint, common_denominator
from cfree.exact.orientation import Meeting, crossing_point, meet
from cfree.exact.surd import Surd
from cfree.exact.vectors import along, cross, foot, minus
from cfree.libraries import Array, np, shapely
from cfree.scene.scene import Bounds

STEPS, RATIO = 18, 1.5  # growths up to which features are joined in turn, up to the limit
LONGEST = 256  # bits of a common denominator
SLACK = 1e-9  # widening of boxes, relative to all numbers: far more than their rounding
NOTHING = Surd(0)
BEYOND = 1  # from bounds to points outside of them


@dataclass(frozen=True, slots=True)
class Feature:
    """A segment or a point, grown by a radius; its owner is an obstacle or the workspace."""

    p: ExactPoint
    q: ExactPoint
    radius: Fraction
    owner: int

    def scaled(self, by: int | Fraction) -> Feature:
        """Return the feature with all numbers times a factor."""
        return Feature(_point(self.p, by), _point(self.q, by), _times(self.radius, by), self.owner)

    def may_touch(self, other: Feature) -> bool:
        """False if the boxes of two features are apart."""
        by = self.radius + other.radius
        return all(
            min(a, b) - by <= max(c, d) and min(c, d) <= max(a, b) + by
            for a, b, c, d in zip(self.p, self.q, other.p, other.q, strict=True)
        )


@dataclass(frozen=True, slots=True)
class Encounter:
    """Two features that meet when all have grown so far; nearest points of them. `other` is None for the bounds.

    `corner` is a point outside of the bounds.
    """

    growth: Surd
    one: Feature
    other: Feature | None
    a: ExactPoint
    b: ExactPoint
    corner: ExactPoint | None = None

    @property
    def place(self) -> tuple[float, float]:
        """The point in which they meet, rounded."""
        (x, y), (u, v) = ((float(c) for c in point) for point in (self.a, self.b))
        own = float(self.growth) + float(self.one.radius)
        share = min(1.0, own / math.hypot(u - x, v - y)) if self.a != self.b else 0.0
        return x + share * (u - x), y + share * (v - y)

    def divided(self, scale: int) -> Encounter:
        """Return the encounter with all numbers divided by one."""
        by = Fraction(1, scale)
        one, other = self.one.scaled(by), self.other and self.other.scaled(by)
        return Encounter(self.growth / scale, one, other, _point(self.a, by), _point(self.b, by))

    def crosses(self, ends: tuple[ExactPoint, ExactPoint]) -> bool:
        """True if the path through both crosses the two rays an odd number of times in sum."""
        last = self.corner if self.other is None else self.other.p
        assert last is not None, "that of bounds is given"
        path = list(pairwise((self.one.p, self.a, self.b, last)))
        return sum(_is_crossed(u, v, end) for u, v in path for end in ends) % 2 == 1


def first_enclosure(
    features: Sequence[Feature], bounds: Bounds | None, ends: tuple[ExactPoint, ExactPoint], limit: Surd
) -> Encounter | None:
    """Return the encounter at which growing features first separate two points; None if none does below a limit.

    Notes
    -----
    Below the limit no feature reaches the points. They are within the bounds, the outside of which does not grow.
    """
    scale = _scale_of(features, bounds, ends)
    scaled = [f.scaled(scale) for f in features]
    rim = bounds and cast(Bounds, tuple(_times(c, scale) for c in bounds))
    near, chains = _Near(features), _Chains(len(features) + 1, (_point(ends[0], scale), _point(ends[1], scale)))
    limit = limit * scale
    seen = set[tuple[int, int]]()
    waiting = [_Waiting.of(met, k, -1) for k, f in enumerate(scaled) for met in _at_rim(f, rim)] if rim else []
    for step in range(STEPS, -1, -1):
        most = float(limit) / RATIO**step if step else math.inf  # then all that are left
        new = near.pairs(min(most, math.nextafter(float(limit), math.inf)) / scale) - seen
        seen |= new
        waiting += [_Waiting.of(_encounter(scaled[i], scaled[j]), i, j) for i, j in new]
        waiting.sort(key=lambda each: each[:4])
        for count, each in enumerate(waiting):
            if each.growth >= most or not each.met.growth < limit:
                waiting = waiting[count:]
                break
            if chains.close(each.one, each.other, each.met):
                return each.met.divided(scale)
        else:
            waiting = []
    return None


class _Waiting(NamedTuple):
    """An encounter in the order of encounters: by its growth, rounded and then exact."""

    growth: float
    exact: Surd
    one: int
    other: int
    met: Encounter

    @classmethod
    def of(cls, met: Encounter, one: int, other: int) -> _Waiting:
        return cls(float(met.growth), met.growth, one, other, met)


class _Near:
    """Boxes of features."""

    def __init__(self, features: Sequence[Feature]) -> None:
        px, py, qx, qy, self._radius = np.array([(*f.p, *f.q, f.radius) for f in features], np.float64).T
        self._low, self._high = np.minimum([px, py], [qx, qy]), np.maximum([px, py], [qx, qy])
        self._unsure = SLACK * (np.abs([self._low, self._high]).max() + self._radius.max())
        self._tree = shapely.STRtree(self._boxes(0.0))

    def pairs(self, growth: float) -> set[tuple[int, int]]:
        """Return all pairs that meet up to a growth, and some more."""
        one, other = self._tree.query(self._boxes(2 * growth + self._radius.max() + self._radius))
        return {(i, j) for i, j in zip(one.tolist(), other.tolist(), strict=True) if i < j}

    def _boxes(self, by: Array | float) -> Array:
        by = by * (1 + SLACK) + self._unsure
        boxes: Array = shapely.box(*(self._low - by), *(self._high + by))
        return boxes


class _Chains:
    """Features joined to chains; each knows the parity of its path to the first of its chain."""

    def __init__(self, count: int, ends: tuple[ExactPoint, ExactPoint]) -> None:
        self._first, self._parity, self._ends = [*range(count)], [False] * count, ends

    def close(self, one: int, other: int, met: Encounter) -> bool:
        """Join two features; True if that closes a cycle of odd parity."""
        (first, odd), (second, also) = self._chain(one), self._chain(other)
        parity = met.crosses(self._ends) ^ odd ^ also
        if first == second:
            return parity
        self._first[second], self._parity[second] = first, parity
        return False

    def _chain(self, k: int) -> tuple[int, bool]:
        """Return the first feature of a chain, and the parity of the path to it; paths get shorter."""
        way = []
        while self._first[k] != k:
            way.append(k)
            k = self._first[k]
        odd = False
        for each in reversed(way):
            odd ^= self._parity[each]
            self._first[each], self._parity[each] = k, odd
        return k, odd


def _is_crossed(u: ExactPoint, v: ExactPoint, end: ExactPoint) -> bool:
    """True if a segment crosses the ray from a point in the direction of x; its lower end counts."""
    if (u[1] > end[1]) == (v[1] > end[1]):
        return False
    side = cross(minus(v, u), minus(end, u))
    return side > 0 if v[1] > u[1] else side < 0


# --- distances ---


def nearest(f: Feature, g: Feature) -> tuple[Fraction, ExactPoint, ExactPoint]:
    """Return the square of the distance of two segments, and a nearest point of each."""
    if f.p != f.q and g.p != g.q and meet(f.p, f.q, g.p, g.q) is Meeting.CROSS:
        common = crossing_point(f.p, f.q, g.p, g.q)
        return Fraction(0), common, common
    ways = [(*foot(p, there.p, there.q), k, p) for k, here, there in ((0, f, g), (1, g, f)) for p in (here.p, here.q)]
    square, share, k, p = min(ways)
    there = f if k else g
    at = along(there.p, share, minus(there.q, there.p))
    return (square, at, p) if k else (square, p, at)


def _encounter(f: Feature, g: Feature) -> Encounter:
    square, a, b = nearest(f, g)
    n, d = square.numerator, square.denominator
    half = Surd(Fraction(-f.radius - g.radius, 2), Fraction(1, 2 * d), n * d)  # (sqrt(n / d) - radii) / 2
    return Encounter(max(NOTHING, half), f, g, a, b)


def _at_rim(f: Feature, bounds: Bounds) -> Iterator[Encounter]:
    """Yield the encounters of a feature with the four half planes outside of the bounds.

    Their corners are joined outside by a path that no ray crosses: left of the bounds, below or above.
    """
    x0, y0, x1, y1 = bounds
    left, right = min(f.p, f.q), max(f.p, f.q)
    low, high = sorted((f.p, f.q), key=lambda p: p[1])
    for a, b, corner in (
        (left, (min(left[0], x0), left[1]), (x0 - BEYOND, y0 - BEYOND)),
        (low, (low[0], min(low[1], y0)), (x0 - BEYOND, y0 - BEYOND)),
        (right, (max(right[0], x1), right[1]), (x1 + BEYOND, y0 - BEYOND)),
        (high, (high[0], max(high[1], y1)), (x0 - BEYOND, y1 + BEYOND)),
    ):
        distance = abs(a[0] - b[0]) + abs(a[1] - b[1])
        yield Encounter(max(NOTHING, Surd(distance - f.radius)), f, None, a, b, corner)


# --- integers: much quicker than fractions, and equal to them ---


def _scale_of(features: Sequence[Feature], bounds: Bounds | None, ends: Sequence[ExactPoint]) -> int:
    """Return a number that makes all coordinates and radii whole; 1 if that is very large."""
    numbers = {c for f in features for c in (*f.p, *f.q, f.radius)} | {c for p in ends for c in p} | {*(bounds or ())}
    scale = common_denominator(numbers)
    return scale if scale.bit_length() <= LONGEST else 1


def _times(x: Fraction, by: int | Fraction) -> Fraction:
    product = x * by
    return cast(Fraction, product.numerator) if product.denominator == 1 else product


def _point(p: ExactPoint, by: int | Fraction) -> ExactPoint:
    return _times(p[0], by), _times(p[1], by)
