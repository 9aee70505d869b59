"""Exact closed sets of orientations: solutions of A + B cos theta + C sin theta <= 0, their unions and intersections.

Ends of arcs are sorted by doubles, and by square roots if these are too close. Then a set is a row of flags, one for
every end and one for every gap between two ends.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, cmp_to_key

from cfree.exact.algebraic import roots
from cfree.exact.angle_interval import AlgebraicAngle
from cfree.exact.orientation import Order
from cfree.exact.surd import Surd
from cfree.libraries import Flags, flint, np

CLOSE = 1e-13  # far above the error of an end's double: closer ends are compared exactly
Form = tuple[int, int, int]


@dataclass(frozen=True, eq=False)
class End:
    """End of an arc: A + B cos + C sin falls to zero at its start, and rises above zero at its stop."""

    form: Form
    stops: bool
    theta: float

    @cached_property
    def place(self) -> tuple[int, Surd]:
        """Chart, and tau in it, within [-1, 1]."""
        chart = int(math.cos(self.theta) < 0)
        tau = self.tau(chart)
        beyond = tau.compare(1) is Order.AFTER or tau.compare(-1) is Order.BEFORE
        return (1 - chart, self.tau(1 - chart)) if beyond else (chart, tau)

    def tau(self, chart: int) -> Surd:
        """Coordinate in a chart: a root of (A - B) tau^2 + 2 C tau + A + B; chart 1 reverses the signs of B and C."""
        A, B, C = _in_chart(self.form, chart)
        if A == B:
            return Surd(Fraction(-A, C))
        return Surd(Fraction(-C, A - B), Fraction(1 if self.stops else -1, A - B), B * B + C * C - A * A)

    @property
    def exact(self) -> AlgebraicAngle:
        chart, tau = self.place
        A, B, C = _in_chart(self.form, chart)
        near = roots(flint.fmpz_poly([A + B, 2 * C, A - B]), Fraction(-3, 2), Fraction(3, 2))
        (root,) = (x for x, _ in near if tau.compare(x.lo) is not Order.BEFORE and tau.compare(x.hi) is not Order.AFTER)
        return AlgebraicAngle(chart, root)


Arc = tuple[End, End]
Arcs = list[Arc] | bool  # all orientations, or none


def _in_chart(form: Form, chart: int) -> Form:
    A, B, C = form
    return (A, -B, -C) if chart else form


def where_not_positive(form: Form) -> Arcs:
    """Orientations at which A + B cos + C sin <= 0.

    Examples
    --------
    >>> ((start, stop),) = where_not_positive((-1, 0, 2))  # sin <= 1/2
    >>> round(math.degrees(start.theta)), round(math.degrees(stop.theta)), where_not_positive((-3, 1, 2))
    (150, 30, True)
    """
    A, B, C = form
    D = B * B + C * C - A * A
    if D < 0 or (D == 0 and A <= 0):
        return A <= 0
    size = max(abs(A), abs(B), abs(C))
    a, b, c, root = A / size, B / size, C / size, math.sqrt(D / size**2)
    start = math.atan2(root * b - a * c, -a * b - root * c)
    stop = math.atan2(-a * c - root * b, root * c - a * b)
    return [(End(form, False, start), End(form, True, stop))]


def union_of_intersections(families: Sequence[Sequence[Arcs]]) -> Arcs:
    """Orientations that are in all sets of at least one family.

    Examples
    --------
    >>> left, low = where_not_positive((0, 1, 0)), where_not_positive((0, 0, 1))
    >>> ((start, stop),) = union_of_intersections([[left, low]])
    >>> round(math.degrees(start.theta)) % 360, round(math.degrees(stop.theta)) % 360
    (180, 270)
    """
    open_ones = [[s for s in family if s is not True] for family in families if not any(s is False for s in family)]
    if any(not family for family in open_ones):
        return True
    lists = [[arcs for arcs in family if not isinstance(arcs, bool)] for family in open_ones]
    ends = [end for family in lists for arcs in family for arc in arcs for end in arc]
    if not ends:
        return False
    ranks, first = _ranked(ends)
    number = dict(zip(map(id, ends), ranks, strict=True))
    count = 2 * len(first)

    def flags(arcs: list[Arc]) -> Flags:
        row = np.zeros(count, bool)
        for start, stop in arcs:
            i, j = 2 * number[id(start)], 2 * number[id(stop)]
            row[i : j + 1] = True
            if j < i:
                row[i:] = row[: j + 1] = True
        return row

    inside = np.logical_or.reduce([np.logical_and.reduce([flags(arcs) for arcs in family]) for family in lists])
    if inside.all() or not inside.any():
        return bool(inside[0])
    starts = np.flatnonzero(inside & ~np.roll(inside, 1))
    stops = np.flatnonzero(inside & ~np.roll(inside, -1))
    if stops[0] < starts[0]:
        stops = np.roll(stops, -1)
    return [(first[i // 2], first[j // 2]) for i, j in zip(starts.tolist(), stops.tolist(), strict=True)]


def _ranked(ends: list[End]) -> tuple[list[int], list[End]]:
    """Ranks of ends, counter-clockwise from some gap on, equal for equal ends; and one end of each rank."""
    theta = np.array([end.theta for end in ends])
    order = np.argsort(theta)
    gaps = np.diff(theta[order], append=theta[order[0]] + math.tau)
    order = np.roll(order, -(int(np.argmax(gaps)) + 1))
    after = np.mod(np.diff(theta[order], prepend=theta[order[0]]), math.tau)
    apart = np.append(np.flatnonzero((after > CLOSE) & (np.arange(len(ends)) > 0)), len(ends))
    ranks, first, begin = [0] * len(ends), list[End](), 0
    key = cmp_to_key(_compare)
    for end in apart.tolist():
        group: list[int] = sorted(order[begin:end].tolist(), key=lambda k: key(ends[k]))
        for m, k in enumerate(group):
            if m == 0 or _compare(ends[group[m - 1]], ends[k]) != 0:
                first.append(ends[k])
            ranks[k] = len(first) - 1
        begin = end
    return ranks, first


def _compare(p: End, q: End) -> int:
    """Order of two ends that are close together."""
    if p.form == q.form and p.stops == q.stops:
        return 0
    chart = p.place[0]
    x, y = p.place[1], q.tau(chart)
    if x == y:
        return 0
    bits = 64
    while True:
        (low, high), (least, most) = x.neighbours(bits), y.neighbours(bits)
        if high < least or most < low:
            return -1 if high < least else 1
        bits *= 2
