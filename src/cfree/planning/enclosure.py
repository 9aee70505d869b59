"""Features that grow in the plane until they separate two points.

The nerve of grown convex sets has the cycles of their union. So features are the nodes of a graph, with an edge for
each place where two meet. An edge is also a path in the plane, through both features; its parity tells how often it
crosses the two rays from the points in the direction of x, modulo 2. The points are separated when a cycle of odd
parity appears.
docs/theory/separations.md, "The widest way of a disc".
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple, cast

from cfree.exact.number import ExactPoint, common_denominator
from cfree.exact.surd import Surd
from cfree.libraries import Array, np, shapely
from cfree.planning.encounters import Encounter, Feature, at_rim, encounters
from cfree.scene.scene import Bounds

STEPS, RATIO = 18, 1.5  # growths up to which features are joined in turn, up to the limit
LONGEST = 256  # bits of a common denominator
SLACK = 1e-9  # widening of boxes, relative to all numbers: far more than their rounding


def first_enclosure(
    features: Sequence[Feature], bounds: Bounds | None, ends: tuple[ExactPoint, ExactPoint], limit: Surd
) -> Encounter | None:
    """Return the encounter at which growing features first separate two points; None if none does below a limit.

    Notes
    -----
    Below the limit no feature reaches the points. They are within the bounds, the outside of which does not grow.
    """
    scale = _scale_of(features, bounds, ends)
    scaled = [f.mapped(lambda p: _point(p, scale), lambda x: _times(x, scale)) for f in features]
    rim = bounds and cast(Bounds, tuple(_times(c, scale) for c in bounds))
    near, chains = _Near(features), _Chains(len(features) + 1, (_point(ends[0], scale), _point(ends[1], scale)))
    limit = limit * scale
    seen = set[tuple[int, int]]()
    waiting = [_Waiting.of(met, k, -1) for k, f in enumerate(scaled) for met in at_rim(f, rim)] if rim else []
    for step in range(STEPS, -1, -1):
        most = float(limit) / RATIO**step if step else math.inf  # then all that are left
        new = near.pairs(min(most, math.nextafter(float(limit), math.inf)) / scale) - seen
        seen |= new
        waiting += [_Waiting.of(met, i, j) for i, j in new for met in encounters(scaled[i], scaled[j])]
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
        hulls = [[*zip(*f.hull, strict=True)] for f in features]
        self._radius = np.array([f.radius for f in features], np.float64)
        self._low, self._high = (
            np.array([[end(axis) for axis in hull] for hull in hulls], np.float64).T for end in (min, max)
        )
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


# --- integers: much quicker than fractions, and equal to them ---


def _scale_of(features: Sequence[Feature], bounds: Bounds | None, ends: Sequence[ExactPoint]) -> int:
    """Return a number that makes all coordinates and radii whole; 1 if that is very large."""
    numbers = {c for f in features for c in f.numbers} | {c for p in ends for c in p} | {*(bounds or ())}
    scale = common_denominator(numbers)
    return scale if scale.bit_length() <= LONGEST else 1


def _times(x: Fraction, by: int) -> Fraction:
    product = x * by
    return cast(Fraction, product.numerator) if product.denominator == 1 else product


def _point(p: ExactPoint, by: int) -> ExactPoint:
    return _times(p[0], by), _times(p[1], by)
