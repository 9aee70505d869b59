"""Segments of outlines in drawings: lines, arcs of circles and ellipses, cubic Bézier curves.

Points of lines are exact, points of curves are doubles. A ring is a list of segments; each begins at the end of the one
before. `Affine` maps transform rings.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any

from cfree.exact.number import ExactPoint

Affine = tuple[Fraction, Fraction, Fraction, Fraction, Fraction, Fraction]
"""(a, b, c, d, e, f) takes (x, y) to (a x + c y + e, b x + d y + f), as SVG writes it."""
Vector = tuple[float, float]
Tips = tuple[ExactPoint, ExactPoint] | None
"""Exact first and last point of a curve, if known."""

ROUND = 1e-12  # relative difference of the radii of an arc that was meant as an arc of a circle
IDENTITY: Affine = (Fraction(1), Fraction(0), Fraction(0), Fraction(1), Fraction(0), Fraction(0))


@dataclass(frozen=True, slots=True)
class Line:
    """A straight segment from `start` to `end`."""

    start: ExactPoint
    end: ExactPoint


@dataclass(frozen=True, slots=True)
class Arc:
    """Points center + u cos t + v sin t, for t from `first` to `last`, in radians; u and v are conjugate radii.

    If `base`, the point at t = 0, is given, points near it are as exact as `base`, at any distance of the center.
    """

    center: Vector
    u: Vector
    v: Vector
    first: float
    last: float
    tips: Tips = None
    base: Vector | None = None

    def at(self, t: float, half: float = 0.0) -> Vector:
        """Return the point at t; with `half`, the intersection of the tangents at t - half and t + half."""
        scale = math.cos(half)
        origin, s = self.base or self.center, math.sin(t) / scale
        c = -2 * math.sin((t + half) / 2) * math.sin((t - half) / 2) / scale if self.base else math.cos(t) / scale
        return origin[0] + self.u[0] * c + self.v[0] * s, origin[1] + self.u[1] * c + self.v[1] * s

    @property
    def circular(self) -> bool:
        """True if its radii are perpendicular and equally long, but for rounding."""
        (a, b), (c, d) = self.u, self.v
        square = a * a + b * b
        return abs(c * c + d * d - square) <= ROUND * square and abs(a * c + b * d) <= ROUND * square

    @property
    def is_clockwise(self) -> bool:
        """True if it turns to the right."""
        return (self.u[0] * self.v[1] < self.u[1] * self.v[0]) == (self.last > self.first)

    @property
    def closed(self) -> bool:
        """True if it is a whole ellipse."""
        return abs(self.last - self.first) >= math.tau * (1 - 1e-12)


@dataclass(frozen=True, slots=True)
class Cubic:
    """A Bézier curve of degree 3."""

    points: tuple[Vector, Vector, Vector, Vector]
    tips: Tips = None


Segment = Line | Arc | Cubic
Ring = list[Segment]


def translation(x: Fraction, y: Fraction) -> Affine:
    """Translation by (x, y)."""
    return Fraction(1), Fraction(0), Fraction(0), Fraction(1), x, y


def straight(ring: Sequence[Segment]) -> bool:
    """True if a ring consists of lines only."""
    return all(isinstance(segment, Line) for segment in ring)


def turn(p: Sequence[Any], q: Sequence[Any], r: Sequence[Any]) -> Any:
    """Cross product of q - p and r - q, above 0 for a left turn; as exact as the points are."""
    return (q[0] - p[0]) * (r[1] - q[1]) - (q[1] - p[1]) * (r[0] - q[0])


def decimal(value: float) -> Fraction:
    """Return the decimal of a double's first 14 digits, which undoes the rounding of sums.

    Examples
    --------
    >>> decimal(0.1 + 0.2), decimal(-1e-20)
    (Fraction(3, 10), Fraction(-1, 100000000000000000000))
    """
    if not -1e150 < value < 1e150:
        raise ValueError(f"{value} is no coordinate; give one below 1e150")
    return Fraction(Decimal(f"{value:.14g}")) if abs(value) > 1e-150 else Fraction(0)


def point_of(x: float, y: float) -> ExactPoint:
    """Point of a drawing, as decimals of 14 digits."""
    return decimal(x), decimal(y)


def arc_of_circle(center: Vector, radius: float, first: float = 0.0, last: float = math.tau) -> Arc:
    """Arc of a circle, by default all of it; counter-clockwise if `last` is larger."""
    return Arc(center, (radius, 0.0), (0.0, radius), first, last)


def polyline(points: Sequence[ExactPoint]) -> Ring:
    """Closed ring through points."""
    return [Line(a, b) for a, b in zip(points, [*points[1:], *points[:1]], strict=True) if a != b]


def quadratic(a: Vector, b: Vector, c: Vector) -> Cubic:
    """Bézier curve of degree 2, as a cubic."""
    lower, upper = ((e[0] + 2 * (b[0] - e[0]) / 3, e[1] + 2 * (b[1] - e[1]) / 3) for e in (a, c))
    return Cubic((a, lower, upper, c))


def bulged(a: Vector, b: Vector, bulge: float) -> Arc:
    """Arc of a DXF polyline: `bulge` is the tangent of a quarter of its angle, to the left if above 0."""
    half = 2 * math.atan(bulge)
    dx, dy = b[0] - a[0], b[1] - a[1]
    middle, rise = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2), 1 / math.tan(half) / 2
    center = middle[0] - dy * rise, middle[1] + dx * rise
    first = math.atan2(a[1] - center[1], a[0] - center[0])
    radius = math.hypot(a[0] - center[0], a[1] - center[1])
    return arc_of_circle(center, radius, first, first + 2 * half)


def ends(segment: Segment) -> tuple[Vector, Vector]:
    """First and last point of a segment, in doubles."""
    match segment:
        case Line(start, end):
            return (float(start[0]), float(start[1])), (float(end[0]), float(end[1]))
        case Arc():
            return segment.at(segment.first), segment.at(segment.last)
        case Cubic(points, _):
            return points[0], points[3]


def middle(segment: Segment) -> Vector:
    """Point of a segment halfway in its parameter."""
    match segment:
        case Line():
            (x0, y0), (x1, y1) = ends(segment)
            return (x0 + x1) / 2, (y0 + y1) / 2
        case Arc():
            return segment.at((segment.first + segment.last) / 2)
        case Cubic((a, b, c, d), _):
            return (a[0] + 3 * b[0] + 3 * c[0] + d[0]) / 8, (a[1] + 3 * b[1] + 3 * c[1] + d[1]) / 8


def chord_points(segment: Segment, count: int) -> list[Vector]:
    """Points of a segment, evenly in its parameter, without the last one; of a line only the first."""
    match segment:
        case Line():
            return [ends(segment)[0]]
        case Arc(_, _, _, first, last):
            return [segment.at(first + (last - first) * k / count) for k in range(count)]
        case Cubic(points, _):
            return [cubic_at(points, k / count) for k in range(count)]


def cubic_at(p: Sequence[Vector], t: float) -> Vector:
    """Point of a Bézier curve of degree 3 at a parameter."""
    weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3)
    x, y = (sum(w * q[k] for w, q in zip(weights, p, strict=True)) for k in (0, 1))
    return x, y


def points_along(ring: Sequence[Segment], count: int = 16) -> list[Vector]:
    """Points along connected segments, `count` on each curve, with both ends."""
    return [*(p for segment in ring for p in chord_points(segment, count)), *(ends(s)[1] for s in ring[-1:])]


def reversed_ring(ring: Sequence[Segment]) -> Ring:
    """Reverse the direction of a ring."""
    return [_reversed(segment) for segment in reversed(ring)]


def _reversed(segment: Segment) -> Segment:
    match segment:
        case Line(start, end):
            return Line(end, start)
        case Arc(center, u, v, first, last, tips, base):
            return Arc(center, u, v, last, first, tips and tips[::-1], base)
        case Cubic((a, b, c, d), tips):
            return Cubic((d, c, b, a), tips and tips[::-1])


def carried(ring: Sequence[Segment], by: Affine) -> Ring:
    """Transform a ring: lines exactly, curves in doubles."""
    a, b, c, d, e, f = map(float, by)

    def direction(p: Vector) -> Vector:
        return a * p[0] + c * p[1], b * p[0] + d * p[1]

    def point(p: Vector) -> Vector:
        x, y = direction(p)
        return x + e, y + f

    moved: Ring = []
    for segment in ring:
        match segment:
            case Line(start, end):
                moved.append(Line(applied(by, start), applied(by, end)))
            case Arc(center, u, v, first, last):
                moved.append(Arc(point(center), direction(u), direction(v), first, last))
            case Cubic((p, q, r, s), _):
                moved.append(Cubic((point(p), point(q), point(r), point(s))))
    return moved


def applied(by: Affine, p: ExactPoint) -> ExactPoint:
    """Transform a point."""
    a, b, c, d, e, f = by
    return a * p[0] + c * p[1] + e, b * p[0] + d * p[1] + f


def compose(outer: Affine, inner: Affine) -> Affine:
    """Compose two maps: first `inner`, then `outer`."""
    a, b, c, d, _, _ = outer
    (x, y), (p, q, r, s) = applied(outer, (inner[4], inner[5])), inner[:4]
    return a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s, x, y
