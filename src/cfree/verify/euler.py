"""The Euler characteristic from slices: components and holes at all angles that a file names, and between them.

The closed forbidden space M is cut at its critical angles. With compact support the characteristic is additive, and
that of a slab between two angles is minus that of a slice in it. So chi(M) is the sum, over critical angles, of that of
the slice there less that of a slice just after. Closed surfaces bound M, made thicker by nearly nothing, and have 2
chi(M) in total. Slices are computed from the scene alone; the file only gives the angles.
docs/theory/closed-surfaces.md, "Euler characteristic from slices", has the proof.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import cmp_to_key
from itertools import pairwise

from cfree.exact.algebraic import Exact, Root, between, near, part
from cfree.verify.angles import angles_of
from cfree.verify.missing import united
from cfree.verify.polygons import Ring, corners
from cfree.verify.section import Section
from cfree.verify.surfaces import LineKey, Turn, Vector, cross, dot, minus, point_at, position_of
from cfree.verify.trapezoids import Reader
from cfree.verify.world import World

Interval = tuple[Exact, Exact]
Arc = tuple[Vector, Vector]  # from point to point, times w; the forbidden side is on its left
CLOSE = Fraction(1, 1 << 40)  # distance to a critical angle, as a half-angle tangent
NEAR, BITS = 1e-6, 60  # distance of points to a line, in doubles, for points of size 1; bits to which these are rounded
ENDS = [Turn.of(chart, Fraction(-1)) for chart in (0, 1)]  # -90 and 90 degrees


def euler_from_slices(reader: Reader, report: Callable[[float], object] = lambda share: None) -> tuple[int | None, int]:
    """Euler characteristic of all closed surfaces together, and the number of angles with slices.

    Notes
    -----
    The first is None if free space has sheets of no width, between bounds and a wall: surfaces run around them, and M
    has them inside.
    """
    turns, world = critical_turns(reader), reader.world
    total = 0
    for k, (turn, following) in enumerate(pairwise([*turns, turns[0]])):
        report(k / len(turns))
        slice_at, slice_after = Outlines(world, turn), Outlines(world, after(turn, following))
        if slice_after.slits:
            return None, 2 * k + 2
        total += slice_at.characteristic - slice_after.characteristic
        total += sum(touching(slice_at, point) for point in slice_at.pinches)
    return 2 * total, 2 * len(turns)


def critical_turns(reader: Reader) -> list[Turn]:
    """Angles of all trapezoids and isolated parts and the ends of charts, each once, in cyclic order."""
    turns = angles_of(reader, reader.table, range(len(reader.table)))
    turns += angles_of(reader, reader.isolated, range(len(reader.isolated)))
    apart = {turn.key: turn for turn in turns + ENDS}

    def compared(x: Turn, y: Turn) -> int:
        return quarter(x) - quarter(y) or (x.root > y.root) - (x.root < y.root)

    return sorted(apart.values(), key=cmp_to_key(compared))


def quarter(turn: Turn) -> int:
    """Part of the circle: 0 at -90 degrees, 1 up to 90 degrees, 2 there, 3 beyond."""
    if turn.tau in (1, -1):
        return 2 if turn.chart == (turn.tau < 0) else 0
    return 3 if turn.chart else 1


def after(turn: Turn, following: Turn) -> Turn:
    """Rational angle between two that follow each other."""
    start = Root.of(Fraction(-1)) if quarter(turn) in (0, 2) else turn.root
    stop = Root.of(Fraction(1)) if quarter(following) in (0, 2) else following.root
    part(start, stop)
    return Turn.of(quarter(turn) // 2, between(start.hi, stop.lo))


class Outlines:
    """Arcs between forbidden and free positions at an angle, cut where others end on them.

    Attributes
    ----------
    onward, arriving : dict of point to list of Arc
        Arcs that begin, and arcs that end at a point.
    slits : bool
        True if some segment is free with forbidden positions on both sides. It is left out.
    """

    def __init__(self, world: World, turn: Turn) -> None:
        self.section = Section(world, turn)
        self.onward: dict[Vector, list[Arc]] = defaultdict(list)
        self.arriving: dict[Vector, list[Arc]] = defaultdict(list)
        arcs, self.slits = _arcs(self.section)
        for arc in arcs:
            self.onward[arc[0]].append(arc)
            self.arriving[arc[1]].append(arc)

    @property
    def pinches(self) -> list[Vector]:
        """Points that several arcs leave."""
        return [point for point, arcs in self.onward.items() if len(arcs) > 1]

    @property
    def characteristic(self) -> int:
        """Components less holes of the closed forbidden set, except for the one around the bounds.

        Notes
        -----
        Outlines, followed around free space, run counter-clockwise around components and clockwise around holes.
        """
        total, left = 0, {arc: None for arcs in self.onward.values() for arc in arcs}
        while left:
            arc, _ = left.popitem()
            loop = [arc[0]]
            while (arc := self._following(arc)) in left:
                del left[arc]
                loop.append(arc[0])
            area = sum(cross(minus(p, loop[0]), minus(q, loop[0])) for p, q in pairwise(loop))
            total += 1 if area > 0 else -1
        return total

    def _following(self, arc: Arc) -> Arc:
        """Return the arc that bounds the same free sector where one arrives: the first counter-clockwise from it."""
        point = arc[1]
        return self.onward[point][0] if len(self.onward[point]) == 1 else first_from(minus(*arc), self.onward[point])

    def sector(self, point: Vector, direction: Vector) -> Arc:
        """Forbidden sector at a point that holds a direction, named by the arc that leaves along it."""
        return first_from(direction, self.onward[point], backwards=True)


def first_from(direction: Vector, arcs: list[Arc], backwards: bool = False) -> Arc:
    """Arc that leaves first, counter-clockwise from a direction."""

    def compared(x: Arc, y: Arc) -> int:
        one, other = minus(x[1], x[0]), minus(y[1], y[0])
        sides = _half(direction, one) - _half(direction, other)
        turn = cross(one, other)
        return sides or (turn < 0) - (turn > 0)

    return (max if backwards else min)(arcs, key=cmp_to_key(compared))


def touching(outlines: Outlines, point: Vector) -> int:
    """Count the forbidden sectors at a point that only touch there, and do not meet just before or after the angle.

    Notes
    -----
    Surfaces that only touch in a point have a vertex there each, but M is connected in it: a tube, made thicker.
    """
    section = outlines.section
    sectors: dict[Arc, list[int]] = {arc: [] for arc in outlines.onward[point]}
    for k in section.at_point(point):
        ring = section.ring(k)
        middle = tuple(sum(p[axis] for p in ring) - len(ring) * point[axis] for axis in (0, 1))
        sectors[outlines.sector(point, middle)].append(k)
    sections = [Section(section.world, turn) for turn in beside(section.turn)]
    groups: list[list[int]] = []
    for numbers in sectors.values():
        joined = [g for g in groups if any(meet(s.ring(i), s.ring(j)) for s in sections for i in g for j in numbers)]
        groups = [g for g in groups if g not in joined] + [numbers + [k for g in joined for k in g]]
    return len(groups) - 1


def beside(turn: Turn) -> list[Turn]:
    """Rational angles just before and after one."""
    while turn.root.hi - turn.root.lo > CLOSE:
        turn.root.narrow()
    return [
        Turn.of(chart, tau) for chart, tau in ((turn.chart, turn.root.lo - CLOSE), (turn.chart, turn.root.hi + CLOSE))
    ]


def meet(one: Ring, other: Ring) -> bool:
    """True if two closed convex polygons have a point in common."""
    return not any(
        all(cross(minus(q, p), minus(x, p)) < 0 for x in theirs)
        for ours, theirs in ((one, other), (other, one))
        for _, p, q in corners(ours)
    )


def _half(back: Vector, ray: Vector) -> int:
    """Number of half turns from one direction to another: 0 for less than half a turn, 1 for half a turn or more."""
    side = cross(back, ray)
    return 0 if side > 0 or (side == 0 and dot(back, ray) > 0) else 1


def _arcs(section: Section) -> tuple[list[Arc], bool]:
    world, turn = section.world, section.turn
    on: dict[LineKey, dict[bool, list[Interval]]] = defaultdict(lambda: {True: [], False: []})
    for surface in world.contacts():
        if all(turn.value(limit) <= 0 for limit in surface.limits):
            line = turn.line(surface)
            for interval in section.on_contact(surface):
                lo, hi = sorted(map(line.position, interval))
                if lo < hi:
                    on[line.key][line.ascends].append((lo, hi))
    sides, slits = [], False
    for key, facing in on.items():
        ways = {ascends: united(intervals) for ascends, intervals in facing.items()}
        for ascends in (True, False):
            outside = _without(ways[ascends], ways[not ascends])
            slits = slits or outside != ways[ascends]
            sides += [(key, lo, hi, ascends) for lo, hi in outside]
    points = {point_at(key, x): None for key, *ends, _ in sides for x in ends}
    size = world.unit * turn.rounded.w  # no point is farther, but for rounding
    rough = {point: [float(near(x / Fraction(size), BITS)) for x in point] for point in points}
    arcs = []
    for key, lo, hi, ascends in sides:
        cuts = [lo, *sorted(_between(key, lo, hi, rough)), hi]
        ways_on = [(point_at(key, p), point_at(key, q)) for p, q in pairwise(cuts)]
        arcs += ways_on if ascends else [(q, p) for p, q in ways_on]
    return arcs, slits


def _between(key: LineKey, lo: Exact, hi: Exact, rough: dict[Vector, list[float]]) -> Iterator[Exact]:
    """Positions of points within an interval of a line. Doubles exclude those that are not near it."""
    (px, py), (qx, qy) = rough[point_at(key, lo)], rough[point_at(key, hi)]
    length = math.hypot(qx - px, qy - py)
    for point, (x, y) in rough.items():
        height = abs((qx - px) * (y - py) - (qy - py) * (x - px))
        if height <= NEAR * (length + NEAR):
            position = position_of(key, point)
            if position is not None and lo < position < hi:
                yield position


def _without(intervals: list[Interval], others: list[Interval]) -> list[Interval]:
    """Remainder of disjoint intervals outside of others, both in order."""
    rest = []
    for lo, hi in intervals:
        for begin, end in others:
            if begin < hi and lo < end:
                if lo < begin:
                    rest.append((lo, begin))
                lo = end
        if lo < hi:
            rest.append((lo, hi))
    return rest
