"""Features of the plane that grow, and where two of them meet.

A feature is a segment, a point or an arc, grown by a radius. Two arcs may meet in several places, one after the other.
docs/theory/separations.md, "The widest way of a disc".
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import cast

from cfree.exact.number import ExactPoint
from cfree.exact.orientation import Meeting, crossing_point, meet
from cfree.exact.surd import Surd
from cfree.exact.vectors import along, cross, dot, foot, minus
from cfree.scene.scene import Bounds

NOTHING = Surd(0)
BEYOND = 1  # from bounds to points outside of them
SIDES = 1, -1
NONE, ONE = Fraction(0), Fraction(1)
LEFTWARDS, DOWNWARDS, RIGHTWARDS, UPWARDS = (-ONE, NONE), (NONE, -ONE), (ONE, NONE), (NONE, ONE)


@dataclass(frozen=True, slots=True)
class Rim:
    """The circle of an arc, of which it is at most a quarter.

    A convex arc is counter-clockwise, and its tangents meet in `corner`. A concave one is clockwise. From its `corner`,
    some point beyond, segments lead to all of the arc through the shape.
    """

    center: ExactPoint
    radius: Fraction
    corner: ExactPoint
    is_convex: bool


@dataclass(frozen=True, slots=True)
class PointOnLine:
    """The point `base + share direction`."""

    base: ExactPoint
    direction: ExactPoint
    share: Surd

    def is_right_of(self, p: ExactPoint, direction: ExactPoint) -> bool:
        """True if the point is to the right of a directed line, and not on it."""
        return self.share * cross(direction, self.direction) + cross(direction, minus(self.base, p)) < 0

    def __iter__(self) -> Iterator[float]:
        return (float(self.share * d + c) for c, d in zip(self.base, self.direction, strict=True))


@dataclass(frozen=True, slots=True)
class Feature:
    """A segment, a point, or the arc of a rim from p to q, grown by a radius.

    Its owner is an obstacle or the workspace.
    """

    p: ExactPoint
    q: ExactPoint
    radius: Fraction
    owner: int
    rim: Rim | None = None

    @property
    def start(self) -> ExactPoint:
        """A point from which segments lead to all of the feature through its shape."""
        return self.p if self.rim is None or self.rim.is_convex else self.rim.corner

    @property
    def hull(self) -> tuple[ExactPoint, ...]:
        """Points around the feature, before it grows."""
        return (self.p, self.q) if self.rim is None else (self.p, self.q, self.rim.corner)

    @property
    def numbers(self) -> tuple[Fraction, ...]:
        """All of its numbers."""
        more = (*self.rim.center, self.rim.radius, *self.rim.corner) if self.rim else ()
        return *self.p, *self.q, self.radius, *more

    def mapped(self, point: Callable[[ExactPoint], ExactPoint], length: Callable[[Fraction], Fraction]) -> Feature:
        """Return the image under a similarity that keeps orientations."""
        rim = self.rim and Rim(
            point(self.rim.center), length(self.rim.radius), point(self.rim.corner), self.rim.is_convex
        )
        return Feature(point(self.p), point(self.q), length(self.radius), self.owner, rim)

    def may_touch(self, other: Feature) -> bool:
        """False if the boxes of two features are apart."""
        by = self.radius + other.radius
        return all(
            min(mine) - by <= max(others) and min(others) <= max(mine) + by
            for mine, others in zip(zip(*self.hull, strict=True), zip(*other.hull, strict=True), strict=True)
        )

    def has_normal(self, direction: ExactPoint) -> bool:
        """True if the ray from the rim's center in a direction meets the arc."""
        (first, last), center = self._ends
        return cross(minus(first, center), direction) >= 0 <= cross(direction, minus(last, center))

    def has_point(self, x: PointOnLine) -> bool:
        """True if a point of the rim's circle is on the arc."""
        (first, last), center = self._ends
        return not x.is_right_of(center, minus(first, center)) and not x.is_right_of(center, minus(center, last))

    @property
    def _ends(self) -> tuple[tuple[ExactPoint, ExactPoint], ExactPoint]:
        """The arc's ends counter-clockwise, and its center."""
        assert self.rim is not None
        return (self.p, self.q) if self.rim.is_convex else (self.q, self.p), self.rim.center


@dataclass(frozen=True, slots=True)
class Encounter:
    """Two features that meet when all have grown so far; `other` is None for the bounds.

    `way` leads from one feature to the other one: to nearest points of them, or to the one where they meet. It ends in
    the other one's start, or in a point outside of the bounds.
    """

    growth: Surd
    one: Feature
    other: Feature | None
    way: tuple[ExactPoint | PointOnLine, ...]

    @property
    def place(self) -> tuple[float, float]:
        """The point in which they meet, rounded."""
        points = [tuple(map(float, point)) for point in self.way[1:-1]]
        (x, y), (u, v) = points[0], points[-1]
        own, apart = float(self.growth) + float(self.one.radius), ((u - x) ** 2 + (v - y) ** 2) ** 0.5
        share = min(1.0, own / apart) if apart else 0.0
        return x + share * (u - x), y + share * (v - y)

    def divided(self, scale: int) -> Encounter:
        """Return the encounter with all numbers divided by one."""

        def point(p: ExactPoint) -> ExactPoint:
            return Fraction(p[0], scale), Fraction(p[1], scale)

        def length(x: Fraction) -> Fraction:
            return Fraction(x, scale)

        way = (
            PointOnLine(point(p.base), point(p.direction), p.share) if isinstance(p, PointOnLine) else point(p)
            for p in self.way
        )
        other = self.other and self.other.mapped(point, length)
        return Encounter(self.growth / scale, self.one.mapped(point, length), other, tuple(way))

    def crosses(self, ends: tuple[ExactPoint, ExactPoint]) -> bool:
        """True if the way crosses the rays from two points in the direction of x an odd number of times in sum."""
        return sum(_is_crossed(u, v, end) for u, v in pairwise(self.way) for end in ends) % 2 == 1


def _is_crossed(u: ExactPoint | PointOnLine, v: ExactPoint | PointOnLine, end: ExactPoint) -> bool:
    """True if a segment crosses the ray from a point in the direction of x; its lower end counts."""
    if isinstance(u, PointOnLine):
        u, v = v, u
    u = cast(ExactPoint, u)
    if isinstance(v, PointOnLine):
        is_up = v.is_right_of(end, LEFTWARDS)
        if (u[1] > end[1]) == is_up:
            return False
        to_end = minus(end, u)
        return v.is_right_of(u, to_end) if is_up else v.is_right_of(u, (-to_end[0], -to_end[1]))
    if (u[1] > end[1]) == (v[1] > end[1]):
        return False
    side = cross(minus(v, u), minus(end, u))
    return side > 0 if v[1] > u[1] else side < 0


# --- two features ---


def encounters(f: Feature, g: Feature) -> Iterator[Encounter]:
    """Yield the encounters of two features; of arcs one for each pair of points that are nearest to each other."""
    if f.rim is None and g.rim is None:
        yield _of_segments(f, g)
        return
    for one, other in ((f, g), (g, f)):
        if one.rim is None:
            continue
        for end in {other.p, other.q}:
            towards = minus(end, one.rim.center)
            if any(towards) and one.has_normal(towards):
                yield _across(one, other, one.rim.center, end, one.rim.radius, 0)
        if other.rim is None:
            yield from _of_arc_and_segment(one, one.rim, other)
    if f.rim is not None and g.rim is not None and f.rim.center != g.rim.center:
        yield from _of_arcs(f, f.rim, g, g.rim)


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


def _of_segments(f: Feature, g: Feature) -> Encounter:
    square, a, b = nearest(f, g)
    growth = (Surd.root(square) - (f.radius + g.radius)) / 2
    return Encounter(max(NOTHING, growth), f, g, (f.start, a, b, g.start))


def _of_arc_and_segment(f: Feature, rim: Rim, g: Feature) -> Iterator[Encounter]:
    """Yield encounters with the inside of a segment."""
    direction = minus(g.q, g.p)
    whole = dot(direction, direction)
    if not whole:
        return
    share = Fraction(dot(direction, minus(rim.center, g.p)), whole)
    at = along(g.p, share, direction)
    towards = minus(at, rim.center)
    left = rim.radius**2 - dot(towards, towards)
    if left <= 0 < share < 1 and f.has_normal(towards):
        yield _across(f, g, rim.center, at, rim.radius, 0)
    if left >= 0:
        half = Surd.root(Fraction(left) / whole)
        for sign in SIDES:
            x = PointOnLine(at, direction, sign * half)
            if not half * sign < -share and not half * sign > 1 - share and f.has_point(x):
                yield Encounter(NOTHING, f, g, (f.start, x, g.start))


def _of_arcs(f: Feature, one: Rim, g: Feature, other: Rim) -> Iterator[Encounter]:
    """Yield encounters of the insides of two arcs."""
    x, y = between = minus(other.center, one.center)
    for sign in SIDES:
        if f.has_normal((sign * x, sign * y)):
            for turn in SIDES:
                if g.has_normal((turn * x, turn * y)):
                    yield _across(f, g, one.center, other.center, sign * one.radius, turn * other.radius)
    whole = dot(between, between)
    share = (1 + Fraction(one.radius**2 - other.radius**2) / whole) / 2
    left = Fraction(one.radius**2) / whole - share * share
    if left >= 0:
        for sign in SIDES:
            at = PointOnLine(along(one.center, share, between), (-y, x), sign * Surd.root(left))
            if f.has_point(at) and g.has_point(at):
                yield Encounter(NOTHING, f, g, (f.start, at, g.start))


def _across(f: Feature, g: Feature, a: ExactPoint, b: ExactPoint, own: Fraction, more: Fraction | int) -> Encounter:
    """Return the encounter of a point `own` from `a` in the direction of `b`, and one `more` beyond `b`."""
    direction = minus(b, a)
    square = Fraction(dot(direction, direction))
    length = Surd.root(square)
    signed = length + (more - own)
    sign = -1 if signed < 0 else 1
    growth = (signed * sign - (f.radius + g.radius)) / 2
    if growth < 0:  # they overlap as they are
        growth, step = NOTHING, min(signed * sign, Surd(f.radius))
    else:
        step = growth + f.radius
    far = step * sign + own  # from a to where they meet
    share = Surd(far.q / length.q, length.q * far.p / square, length.n) if length.q else far / length.p
    return Encounter(growth, f, g, (f.start, PointOnLine(a, direction, share), g.start))


def at_rim(f: Feature, bounds: Bounds) -> Iterator[Encounter]:
    """Yield the encounters of a feature with the four half planes outside of the bounds.

    Their corners are joined outside by a path that no ray crosses: left of the bounds, below or above.
    """
    x0, y0, x1, y1 = bounds
    corners = (x0 - BEYOND, y0 - BEYOND), (x1 + BEYOND, y0 - BEYOND), (x0 - BEYOND, y1 + BEYOND)
    for direction, corner in zip((LEFTWARDS, DOWNWARDS, RIGHTWARDS, UPWARDS), (0, 0, 1, 2), strict=True):
        a = _farthest(f, direction)
        if a is None:
            continue
        (x, y), (u, v) = a, direction
        b = (min(x, x0) if u < 0 else max(x, x1) if u else x, min(y, y0) if v < 0 else max(y, y1) if v else y)
        distance = abs(a[0] - b[0]) + abs(a[1] - b[1])
        yield Encounter(max(NOTHING, Surd(distance - f.radius)), f, None, (f.start, a, b, corners[corner]))


def _farthest(f: Feature, direction: ExactPoint) -> ExactPoint | None:
    """Return the farthest point along an axis; None if it is an end of an arc."""
    if f.rim is None:
        return max((f.p, f.q), key=lambda p: dot(p, direction))
    return along(f.rim.center, f.rim.radius, direction) if f.has_normal(direction) else None
