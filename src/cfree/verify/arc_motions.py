"""Check motions among shapes of segments and circular arcs: between neighbouring events nothing changes.

Whether two interiors meet can change along a motion only where a corner of one shape reaches the line or circle of a
part of the other, or a line touches a circle, or two circles touch; with growth, where they are as far apart as the
radii together. Each of these places is a root of a polynomial in the parameter u. So one pose between any two
neighbouring roots decides the motion. docs/theory/motions.md has the proof.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from copy import copy
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import fmpq_poly
from numpy.typing import NDArray

from cfree.forbidden.columns import Ints
from cfree.verify.arcs import (
    ZERO,
    Part,
    Point,
    Region,
    overlap,
    rational,
    region_of,
    reversed_ring,
    segments,
)
from cfree.verify.course import ALL, EVEN, Course, Interval, Placed, Poly, bernstein, combined
from cfree.verify.polygons import near
from cfree.verify.positivity import positive, samples
from cfree.verify.surds import Number
from cfree.verify.surfaces import dot, minus

if TYPE_CHECKING:
    from cfree.scene.scene import Scene

Boxes = NDArray[np.float64]
FEW = 6  # parts of obstacles near the robot for which an interval is not halved
SHORTEST = 1 << 7  # denominator of the shortest intervals
MARGIN = 2.0**-30  # of coordinates: more than the rounding of boxes


@dataclass
class ArcWorld:
    """A scene of shapes with segments and circular arcs, all coordinates those of the scene.

    Attributes
    ----------
    robot, obstacles : list of Region
        The complement of the workspace is an obstacle.
    bounds : list of Fraction
        xmin, ymin, xmax, ymax; empty if there are none.
    """

    scene: Scene
    robot: list[Region] = field(default_factory=list)
    obstacles: list[Region] = field(default_factory=list)
    bounds: list[Fraction] = field(default_factory=list)
    scale: int = 1

    def __post_init__(self) -> None:
        scene = self.scene
        self.robot = [*map(region_of, scene.robot)]
        self.obstacles = [*map(region_of, scene.obstacles)]
        self.bounds = [*(scene.bounds or ())]
        if scene.workspace is not None:
            self.obstacles += _outside(scene, region_of(scene.workspace))
        self._rows = [(k, part) for k, region in enumerate(self.obstacles) for part in region.parts]
        grown = [[float(_fraction(self.obstacles[k].grown))] for k, _ in self._rows]
        self._boxes = _boxes([[*map(_rounded, _corners(part))] for _, part in self._rows], np.reshape(grown, (-1, 1)))
        self._around = np.array([_box_of(region) for region in self.obstacles]).reshape(-1, 4)

    def with_robot(self, by: Fraction) -> ArcWorld:
        """The scene with a robot that a disc makes larger."""
        world = copy(self)
        world.robot = [replace(region, grown=region.grown + rational(by)) for region in self.robot]
        return world

    def larger(self, by: Fraction) -> ArcWorld | None:
        """The scene with a robot that a disc makes larger, and smaller bounds; None if nothing is left of these."""
        world = self.with_robot(by)
        if self.bounds:
            x0, y0, x1, y1 = self.bounds
            world.bounds = [x0 + by, y0 + by, x1 - by, y1 - by]
            if x0 + by >= x1 - by or y0 + by >= y1 - by:
                return None
        return world

    def is_free(self, placed: Placed) -> bool:
        """True if a pose is free."""
        x, y = placed[:2]
        if self.bounds and not (self.bounds[0] <= x <= self.bounds[2] and self.bounds[1] <= y <= self.bounds[3]):
            return False
        for region in self.robot:
            moved = region.moved(*map(rational, placed))
            if any(overlap(moved, self.obstacles[k]) for k in near(self._around, _box_of(moved))):
                return False
        return True

    def collision(self, course: Course) -> Fraction | None:
        """Some u at which a pose is forbidden, if there is one."""
        if not self.is_free(course.at(Fraction(0))):
            return Fraction(0)
        for k, b in enumerate(self.bounds):
            way = -1 if k < 2 else 1
            over = combined((way * b.denominator, -way * b.numerator), (course.x, course.y)[k % 2], course.d)
            if (place := positive(over)) is not None:
                return place
        every = np.arange(len(self._rows), dtype=np.int32)
        places = (self._collision(course, region, ALL, every) for region in self.robot)
        return next((place for place in places if place is not None), None)

    def _collision(self, course: Course, region: Region, interval: Interval, rows: Ints) -> Fraction | None:
        """Likewise for one part of the robot, an interval of u, and the parts of obstacles that may be near."""
        a, b, n = interval
        around = _boxes_along(region, course, interval)
        whole = np.array([*around[:, :2].min(axis=0), *around[:, 2:].max(axis=0)])
        rows = rows[near(self._boxes[rows], whole)]
        if len(rows) > FEW and n < SHORTEST:
            halves = ((2 * a, a + b, 2 * n), (a + b, 2 * b, 2 * n))
            places = (self._collision(course, region, half, rows) for half in halves)
            return next((place for place in places if place is not None), None)
        if not len(rows):
            return None
        events, obstacles, moving = [], set[int](), Moving(course)
        for k in rows.tolist():
            number, other = self._rows[k]
            obstacles.add(number)
            radius = region.grown + self.obstacles[number].grown
            for i in near(around, self._boxes[k]):
                polys = moving.events(region.parts[i], other, radius)
                events += [poly for poly in polys if _may_vanish(poly, interval)]
        for u in samples(events, interval):
            placed = region.moved(*map(rational, course.at(u)))
            if any(overlap(placed, self.obstacles[k]) for k in obstacles):
                return u
        return None


class Moving:
    """A motion as quotients of polynomials over the rationals."""

    def __init__(self, course: Course) -> None:
        self.w, self.c, self.s, self.x, self.y, self.xi, self.eta = (
            fmpq_poly(list(poly)) for poly in (course.d, course.c, course.s, course.x, course.y, course.xi, course.eta)
        )

    def events(self, part: Part, other: Part, radius: Number) -> Iterator[Poly]:
        """Polynomials that vanish where a contact of a part of the robot and one of an obstacle may begin or end."""
        gap = radius * radius
        for polynomial in self._all(part, other, gap):
            yield tuple(int(c) for c in polynomial.numer().coeffs()) or (0,)

    def _all(self, part: Part, other: Part, gap: Number) -> Iterator[fmpq_poly]:
        if gap:
            yield self._square(part.p, other.p) - gap * self.w
        yield from self._on(part.p, other, ZERO, gap)
        yield from self._under(part, other.p, ZERO, gap)
        if part.center is not None:
            yield from self._on(part.center, other, part.square, gap)
        elif other.center is not None:
            yield from self._under(part, other.center, other.square, gap)

    def _on(self, point: Point, other: Part, square: Number, gap: Number) -> Iterator[fmpq_poly]:
        """A circle of the robot, its radius squared given, at a distance from a line or circle of an obstacle."""
        if other.center is not None:
            yield self._circles(self._square(point, other.center), square, other.square, gap)
            return
        x, y = self._from(point, other.p)
        (u, v), length = other.chord, dot(other.chord, other.chord)
        yield self._line(u * y - v * x, length, square, gap)

    def _under(self, part: Part, point: Point, square: Number, gap: Number) -> Iterator[fmpq_poly]:
        """A line or circle of the robot at a distance from a circle of an obstacle."""
        if part.center is not None:
            yield self._circles(self._square(part.center, point), part.square, square, gap)
            return
        (px, py), (u, v) = point, part.chord
        x = self.c * px + self.s * py - self.xi - self.w * part.p[0]
        y = self.c * py - self.s * px - self.eta - self.w * part.p[1]
        yield self._line(u * y - v * x, dot(part.chord, part.chord), square, gap)

    def _from(self, point: Point, other: Point) -> tuple[fmpq_poly, fmpq_poly]:
        """Place of a point of the robot from one of an obstacle, times w."""
        (a, b), (x, y) = point, other
        return self.x + self.c * a - self.s * b - self.w * x, self.y + self.s * a + self.c * b - self.w * y

    def _square(self, point: Point, other: Point) -> Any:
        """Square of their distance, times w."""
        x, y = self._from(point, other)
        quotient, rest = divmod(x * x + y * y, self.w)
        assert not rest
        return quotient

    def _line(self, height: fmpq_poly, length: Number, square: Number, gap: Number) -> Any:
        """Zero where a line is at a distance sqrt(square) or sqrt(square) +- sqrt(gap) from a point."""
        if not square and not gap:
            return height
        w = length * self.w * self.w
        difference = height * height - (square + gap) * w
        return difference * difference - 4 * square * gap * w * w if square and gap else difference

    def _circles(self, apart: fmpq_poly, one: Number, other: Number, gap: Number) -> Any:
        """Zero where two points are as far apart as a sum of the three radii, each with either sign; squares are given.

        With squares a, b, c of the radii and x of the distance:
        ((x - a - b - c)^2 - 4 (a b + b c + c a))^2 = 64 a b c x.
        """
        a, b, c = one, other, gap
        difference = apart - (a + b + c) * self.w
        products = a * b + b * c + c * a
        if not products:
            return difference
        squared = difference * difference - 4 * products * self.w * self.w
        return squared * squared - 64 * a * b * c * apart * self.w**3 if a and b and c else squared


def _may_vanish(poly: Poly, interval: Interval) -> bool:
    """False if Bernstein coefficients of one sign show that a polynomial has no root."""
    values = bernstein(poly, interval)
    return not (min(values) > 0 or max(values) < 0)


def _corners(part: Part) -> list[Point]:
    """Corners of a segment, or a triangle, around a part."""
    if part.center is None:
        return [part.p, part.q]
    begin, end = minus(part.p, part.center), minus(part.q, part.center)
    share = part.square / (part.square + dot(begin, end))
    return [
        part.p,
        part.q,
        (part.center[0] + share * (begin[0] + end[0]), part.center[1] + share * (begin[1] + end[1])),
    ]


def _boxes(parts: Sequence[Sequence[tuple[float, float]]], grown: Any) -> Boxes:
    """Boxes around points, grown by more than rounding."""
    rows = [[*map(min, zip(*points, strict=True)), *map(max, zip(*points, strict=True))] for points in parts]
    boxes = np.array(rows, float).reshape(-1, 4)
    margin = grown + MARGIN * (grown + (np.abs(boxes).max(axis=1, keepdims=True) if len(boxes) else 0.0))
    around: Boxes = boxes + margin * np.array([-1, -1, 1, 1])
    return around


def _box_of(region: Region) -> Boxes:
    """Box around a region."""
    corners = [_rounded(corner) for part in region.parts for corner in _corners(part)]
    around: Boxes = _boxes([corners], float(_fraction(region.grown)))[0]
    return around


def _boxes_along(region: Region, course: Course, interval: Interval) -> Boxes:
    """Boxes around the parts of a region on an interval of a motion; the whole plane if they are of no use."""
    d, *columns = (bernstein(poly, interval) for poly in (course.d, course.c, course.s, course.x, course.y))
    if min(d) * EVEN < max(d):
        return np.tile([-np.inf, -np.inf, np.inf, np.inf], (len(region.parts), 1))
    rows = [[float(Fraction(value, w)) for value, w in zip(column, d, strict=True)] for column in columns]
    places = list(zip(*rows, strict=True))
    moved = [
        [(x + c * u - s * v, y + s * u + c * v) for u, v in map(_rounded, _corners(part)) for c, s, x, y in places]
        for part in region.parts
    ]
    return _boxes(moved, float(_fraction(region.grown)))


def _rounded(point: Point) -> tuple[float, float]:
    return float(_fraction(point[0])), float(_fraction(point[1]))


def _fraction(value: Number) -> Fraction:
    return Fraction(int(value.p), int(value.q))


def _outside(scene: Scene, workspace: Region) -> list[Region]:
    """The complement of the workspace, in a frame that the robot does not reach: what is beyond, and its holes."""
    outer, *holes = workspace.rings
    far = [abs(c) for part in workspace.parts for point in _corners(part) for c in point]
    reach = [abs(c) for shape in scene.robot for part in region_of(shape).parts for p in _corners(part) for c in p]
    size = 1 + max(far) + 4 * max(reach) + 2 * workspace.grown + 4 * max(region_of(s).grown for s in scene.robot)
    frame = tuple(segments([(-size, -size), (size, -size), (size, size), (-size, size)]))
    return [Region((frame, reversed_ring(outer))), *(Region((reversed_ring(hole),)) for hole in holes)]
