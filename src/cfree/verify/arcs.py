"""Shapes of segments and circular arcs at a pose: decide exactly if the interiors of two of them meet.

Without growth they meet if a boundary point of one is in the interior of the other, or both have a part of their
boundaries in common with the interiors on one side of it. So each segment and arc is cut where it meets the other
boundary, and one point of each part is tried. Shapes that are grown by discs meet if their cores are nearer than the
radii together: two parts of the boundaries are, or one core is inside of the other.

An arc turns by at most a right angle. Its ends are rational, as are its center and the square of its radius. So where
two parts cross, and all points tried, have coordinates a + b sqrt(k).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, cmp_to_key
from itertools import chain, pairwise, product
from typing import Any

from flint import arb, ctx, fmpq

from cfree.curves.curved import Curved
from cfree.curves.drawn import Line
from cfree.curves.rings import Span
from cfree.exact.number import ExactPoint
from cfree.scene.scene import AnyShape
from cfree.verify.surds import NONE, Number, Surd, between, order, sum_sign, surd_sign
from cfree.verify.surfaces import cross, dot, minus

Point = tuple[Number, Number]
ZERO, ONE = fmpq(0), fmpq(1)


@dataclass(frozen=True)
class Spot:
    """A point (x0 + x1 sqrt(k), y0 + y1 sqrt(k))."""

    x0: Number
    x1: Number
    y0: Number
    y1: Number
    k: Number

    @staticmethod
    def of(point: Point) -> Spot:
        return Spot(point[0], ZERO, point[1], ZERO, ZERO)

    def over(self, a: Point, vector: Point) -> Surd:
        """Cross product of a vector with that from a point to this one."""
        (ax, ay), (u, v) = a, vector
        return u * (self.y0 - ay) - v * (self.x0 - ax), u * self.y1 - v * self.x1, self.k

    def along(self, a: Point, vector: Point) -> Surd:
        """Scalar product, likewise."""
        (ax, ay), (u, v) = a, vector
        return u * (self.x0 - ax) + v * (self.y0 - ay), u * self.x1 + v * self.y1, self.k

    def square_from(self, a: Point) -> Surd:
        """Square of the distance from a point."""
        dx, dy = self.x0 - a[0], self.y0 - a[1]
        square = dx * dx + dy * dy + self.k * (self.x1 * self.x1 + self.y1 * self.y1)
        return square, 2 * (dx * self.x1 + dy * self.y1), self.k


@dataclass(frozen=True)
class Part:
    """A segment from p to q, or an arc about a center; the interior of the shape is on its left."""

    p: Point
    q: Point
    center: Point | None = None
    turn: int = 0  # 1 counter-clockwise, -1 clockwise

    @cached_property
    def chord(self) -> Point:
        return minus(self.q, self.p)

    @cached_property
    def square(self) -> Number:
        """Square of the radius."""
        assert self.center is not None
        return dot(minus(self.p, self.center), minus(self.p, self.center))

    def moved(self, x: Number, y: Number, c: Number, s: Number) -> Part:
        def at(point: Point | None) -> Any:
            return point and (x + c * point[0] - s * point[1], y + s * point[0] + c * point[1])

        return Part(at(self.p), at(self.q), at(self.center), self.turn)

    def points_to(self, vector: Point) -> bool:
        """True if the arc has a point in this direction from its center."""
        assert self.center is not None
        begin, end = minus(self.p, self.center), minus(self.q, self.center)
        return bool(self.turn * cross(begin, vector) >= 0 and self.turn * cross(vector, end) >= 0)

    def holds(self, spot: Spot) -> bool:
        """True if a point on the line or circle is on this part."""
        if self.center is None:
            a, b, k = spot.along(self.p, self.chord)
            return surd_sign((a, b, k)) >= 0 and surd_sign((dot(self.chord, self.chord) - a, -b, k)) >= 0
        begin, end = minus(self.p, self.center), minus(self.q, self.center)
        one, other = spot.over(self.center, begin), spot.over(self.center, end)
        forward = add(spot.along(self.center, begin), spot.along(self.center, end))
        return self.turn * surd_sign(one) >= 0 and self.turn * surd_sign(other) <= 0 and surd_sign(forward) > 0

    def share(self, spot: Spot) -> Surd:
        """Share t of the chord at which it is met from the center, or by a point of a segment."""
        if self.center is None:
            a, b, k = spot.along(self.p, self.chord)
            square = dot(self.chord, self.chord)
            return a / square, b / square, k
        first = spot.over(self.center, minus(self.p, self.center))
        last = spot.over(self.center, minus(self.q, self.center))
        a, b, k = first
        c, d = a - last[0], b - last[1]
        norm = c * c - d * d * k
        return (a * c - b * d * k) / norm, (b * c - a * d) / norm, k

    def at(self, share: Number) -> Spot:
        """The point at a share of the chord."""
        x, y = self.p[0] + share * self.chord[0], self.p[1] + share * self.chord[1]
        if self.center is None:
            return Spot.of((x, y))
        (cx, cy), (u, v) = self.center, (x - self.center[0], y - self.center[1])
        return Spot(cx, u, cy, v, self.square / (u * u + v * v))

    def runs_along(self, other: Part) -> bool:
        """True if both are on one line, or one circle."""
        if self.center is None or other.center is None:
            if self.center is not None or other.center is not None:
                return False
            return not cross(self.chord, other.chord) and not cross(self.chord, minus(other.p, self.p))
        return self.center == other.center and bool(self.square == other.square)

    def runs_with(self, other: Part) -> bool:
        """True if both run in one direction, on one line or circle."""
        return self.turn == other.turn if self.center else bool(dot(self.chord, other.chord) > 0)


@dataclass(frozen=True)
class Region:
    """A shape with its interior on the left of all parts, grown by a disc.

    Attributes
    ----------
    rings : tuple of tuple of Part
    grown : fmpq
        Radius of the disc.
    """

    rings: tuple[tuple[Part, ...], ...]
    grown: Number = ZERO

    @cached_property
    def parts(self) -> tuple[Part, ...]:
        return tuple(chain.from_iterable(self.rings))

    def moved(self, x: Number, y: Number, c: Number, s: Number) -> Region:
        return Region(tuple(tuple(part.moved(x, y, c, s) for part in ring) for ring in self.rings), self.grown)

    def holds(self, spot: Spot) -> bool:
        """True if a point that is not on the boundary is inside, without growth.

        Notes
        -----
        It is inside an odd number of rings: polygons of chords, and regions between an arc and its chord. A point on a
        chord is moved by an infinitesimal (1, e), where e is infinitesimal relative to 1.
        """
        inside = False
        y0, y1, k = spot.y0, spot.y1, spot.k
        for part in self.parts:
            u, v = part.chord
            side = surd_sign(spot.over(part.p, part.chord)) or (-1 if v > 0 else 1 if v < 0 else 1 if u > 0 else -1)
            begins, ends = (surd_sign((point[1] - y0, -y1, k)) > 0 for point in (part.p, part.q))
            inside ^= begins != ends and side == (1 if v > 0 else -1)
            if part.center is not None and side == -part.turn:
                a, b, _ = spot.square_from(part.center)
                inside ^= surd_sign((a - part.square, b, k)) < 0
        return inside


def add(x: Surd, y: Surd) -> Surd:
    """Sum of two numbers with one square root."""
    return x[0] + y[0], x[1] + y[1], x[2]


def exact(point: ExactPoint) -> Point:
    return rational(point[0]), rational(point[1])


def rational(value: Fraction | int) -> Number:
    return fmpq(value.numerator, value.denominator)


# --- shapes ---


def is_of_arcs(shape: AnyShape) -> bool:
    """True if all edges of a shape are segments and circular arcs."""
    if not isinstance(shape, Curved) or shape.grown:
        return True
    return all(
        isinstance(piece, Line) or (isinstance(piece, Span) and _is_circular(piece))
        for curve in shape.curves
        for piece in curve
    )


def _is_circular(span: Span) -> bool:
    (a, b), (c, d) = span.u, span.v
    return a * c + b * d == 0 and a * a + b * b == c * c + d * d


def region_of(shape: AnyShape) -> Region:
    """Region of a shape of segments and circular arcs."""
    if isinstance(shape, Curved) and not shape.grown:
        rings = [[*chain.from_iterable(map(_parts_of, curve))] for curve in shape.curves]
        grown = ZERO
    else:
        polygon = shape._base() if isinstance(shape, Curved) else shape
        rings = [[*segments([exact(p) for p in ring])] for ring in polygon.exact_rings]
        grown = rational(shape.grown) if isinstance(shape, Curved) else ZERO
    return Region(tuple(directed(ring, 1 if k == 0 else -1) for k, ring in enumerate(rings)), grown)


def segments(ring: Sequence[Point]) -> Iterator[Part]:
    """The sides of a polygon's ring."""
    return (Part(p, q) for p, q in pairwise([*ring, ring[0]]))


def directed(ring: Sequence[Part], turn: int) -> tuple[Part, ...]:
    """The ring in the direction that goes around its inside counter-clockwise (1) or clockwise (-1)."""
    return tuple(ring) if _area_sign(ring) == turn else reversed_ring(ring)


def reversed_ring(ring: Sequence[Part]) -> tuple[Part, ...]:
    return tuple(Part(part.q, part.p, part.center, -part.turn) for part in reversed(ring))


def _area_sign(ring: Sequence[Part]) -> int:
    """Sign of the area to the left of a ring."""
    bits = 64
    while True:
        with ctx.workprec(bits):
            area = arb(0)
            for part in ring:
                area += arb(cross(part.p, part.q)) / 2
                if part.center is not None:
                    begin, end = minus(part.p, part.center), minus(part.q, part.center)
                    sine, cosine = cross(begin, end), dot(begin, end)
                    area += (arb(part.square) * arb.atan2(arb(sine), arb(cosine)) - arb(sine)) / 2
            if area > 0 or area < 0:
                return 1 if area > 0 else -1
        bits *= 2


def _parts_of(piece: Any) -> Iterator[Part]:
    if isinstance(piece, Line):
        yield Part(exact(piece.start), exact(piece.end))
        return
    assert isinstance(piece, Span)
    (a, b), (c, d) = piece.u, piece.v
    turn, zero = (1 if a * d - b * c > 0 else -1), Fraction(0)
    ends = [piece.at(k, zero) for k in range(piece.quarters + 1)]
    if piece.rest:
        ends.append(piece.end)
    center = exact(piece.center)
    for p, q in pairwise(map(exact, ends)):
        yield Part(p, q, center, turn)


# --- pairs ---


def overlap(one: Region, other: Region) -> bool:
    """True if the interiors of two regions meet."""
    radius = one.grown + other.grown
    if not radius:
        return any(_enters(one, other)) or any(_enters(other, one))
    if any(is_nearer(f, g, radius) for f, g in product(one.parts, other.parts)):
        return True
    corners = ((region, Spot.of(ring[0].p)) for region, its in ((other, one), (one, other)) for ring in its.rings)
    return any(region.holds(corner) for region, corner in corners)


def _enters(one: Region, other: Region) -> Iterator[bool]:
    """For each piece between cuts of the boundary, true if it is inside the other region or runs with its boundary."""
    for part in one.parts:
        cuts, along = [(ZERO, ZERO, ZERO), (ONE, ZERO, ZERO)], []
        for its in other.parts:
            if part.runs_along(its):
                along.append(its)
                ends = (Spot.of(point) for point in (its.p, its.q))
                cuts += [part.share(end) for end in ends if part.holds(end)]
            else:
                cuts += [part.share(spot) for spot in crossings(part, its)]
        for low, high in pairwise(sorted(cuts, key=cmp_to_key(order))):
            if order(low, high) == 0:
                continue
            spot = part.at(between(low, high))
            shared = [its for its in along if its.holds(spot)]
            if any(part.runs_with(its) for its in shared):
                yield True
            elif not shared:
                yield other.holds(spot)


def crossings(one: Part, other: Part) -> Iterator[Spot]:
    """Yield the common points of two parts that are not on one line or circle."""
    if one.center is None and other.center is not None:
        one, other = other, one
    for spot in _of_lines(one, other) if one.center is None else _of_circle(one, other):
        if one.holds(spot) and other.holds(spot):
            yield spot


def _of_lines(one: Part, other: Part) -> Iterator[Spot]:
    if angle := cross(one.chord, other.chord):
        share = cross(minus(other.p, one.p), other.chord) / angle
        yield Spot.of((one.p[0] + share * one.chord[0], one.p[1] + share * one.chord[1]))


def _of_circle(circle: Part, other: Part) -> Iterator[Spot]:
    """Points of a circle on a line, or on another circle: on the line through both its points."""
    center, square = circle.center, circle.square
    assert center is not None
    if other.center is None:
        direction, foot = other.chord, minus(other.p, center)
        share = -dot(foot, direction) / dot(direction, direction)
        foot = foot[0] + share * direction[0], foot[1] + share * direction[1]
    else:
        apart = minus(other.center, center)
        length = dot(apart, apart)
        if not length:
            return
        share = (length + square - other.square) / (2 * length)
        foot, direction = (share * apart[0], share * apart[1]), (-apart[1], apart[0])
    rest = (square - dot(foot, foot)) / dot(direction, direction)
    if rest < 0:
        return
    x, y, (u, v) = center[0] + foot[0], center[1] + foot[1], direction
    yield Spot(x, u, y, v, rest)
    if rest:
        yield Spot(x, -u, y, -v, rest)


def is_nearer(one: Part, other: Part, radius: Number) -> bool:
    """True if two parts have points nearer than a distance."""
    if one.runs_along(other):
        ends = ((part, Spot.of(end)) for part, its in ((one, other), (other, one)) for end in (its.p, its.q))
        if any(part.holds(end) for part, end in ends):
            return True
    elif any(True for _ in crossings(one, other)):
        return True
    if any(is_near(point, other, radius) for point in (one.p, one.q)):
        return True
    if any(is_near(point, one, radius) for point in (other.p, other.q)):
        return True
    if one.center is None:
        one, other = other, one
    if one.center is None:
        return False
    if other.center is None:
        return _are_near(one, other, radius)
    apart = minus(other.center, one.center)
    square = dot(apart, apart)
    if not square:
        return False  # an end of one is nearest to the other
    back = -apart[0], -apart[1]
    squares = square, one.square, other.square
    for first, last in product((1, -1), repeat=2):
        if one.points_to(apart if first > 0 else back) and other.points_to(apart if last > 0 else back):
            gap = {frozenset({0}): ONE, frozenset({1}): fmpq(-first), frozenset({2}): fmpq(last)}
            if all(sum_sign({**{r: k * v for r, v in gap.items()}, NONE: -radius}, squares) < 0 for k in (1, -1)):
                return True
    return False


def _are_near(arc: Part, segment: Part, radius: Number) -> bool:
    """True if an arc is near where the perpendicular from its center meets a segment."""
    assert arc.center is not None
    to, length = minus(segment.p, arc.center), dot(segment.chord, segment.chord)
    share = -dot(to, segment.chord)
    if not 0 <= share <= length:
        return False
    height = cross(segment.chord, to)
    foot = (-segment.chord[1] * height, segment.chord[0] * height)
    if not height or not arc.points_to(foot):
        return False
    squares = height * height / length, arc.square
    gap = {frozenset({0}): ONE, frozenset({1}): -ONE}
    return all(sum_sign({**{r: k * v for r, v in gap.items()}, NONE: -radius}, squares) < 0 for k in (1, -1))


def is_near(point: Point, part: Part, radius: Number) -> bool:
    """True if a point is nearer to a part than a distance, at an end of it or perpendicularly."""
    if part.center is None:
        to, length = minus(point, part.p), dot(part.chord, part.chord)
        share = dot(to, part.chord)
        if share <= 0 or share >= length:
            end = to if share <= 0 else minus(point, part.q)
            return bool(dot(end, end) < radius * radius)
        height = cross(part.chord, to)
        return bool(height * height < radius * radius * length)
    for end in (part.p, part.q):
        to = minus(point, end)
        if dot(to, to) < radius * radius:
            return True
    to = minus(point, part.center)
    square = dot(to, to)
    if not square:
        return bool(part.square < radius * radius)
    if not part.points_to(to):
        return False
    gap = {frozenset({0}): ONE, frozenset({1}): -ONE}
    squares = square, part.square
    return all(sum_sign({**{r: k * v for r, v in gap.items()}, NONE: -radius}, squares) < 0 for k in (1, -1))
