"""Input rings of curves: circles, ellipses, and paths of points, arcs, Bézier curves and splines.

All numbers are exact. `exact_ring` converts each ring to lines, spans of ellipses and cubic Bézier curves. The center
and two conjugate radii of an arc are rational.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from cfree.arguments import checked
from cfree.curves.drawn import Line
from cfree.errors import InvalidPolygonError
from cfree.exact.half_angle import Angle
from cfree.exact.number import ExactPoint, Number, to_fraction
from cfree.exact.pose import Pose
from cfree.words import coordinate

Point = Sequence[Number]
DEGREE = 3  # degree of splines


@checked
@dataclass(frozen=True, init=False)
class Arc:
    """An arc of a circle or an ellipse, from the point before it.

    Parameters
    ----------
    to : (x, y)
        Its end; if it is the point before, the arc is a whole turn.
    through : (x, y), optional
        A point between the two: the arc is on the circle through all three.
    center : (x, y), optional
        Instead of `through`: the center, exactly equally far from both ends; rounded decimals rarely are.
    clockwise : bool
        Direction about `center`.
    conjugate : (x, y), optional
        With `center`: the arc is on an ellipse, whose conjugate radii are this vector and the one from the center to
        the point before.
    """

    to: ExactPoint
    through: ExactPoint | None
    center: ExactPoint | None
    clockwise: bool
    conjugate: ExactPoint | None

    def __init__(
        self,
        to: Point,
        through: Point | None = None,
        center: Point | None = None,
        clockwise: bool = False,
        conjugate: Point | None = None,
    ) -> None:
        if (through is None) == (center is None):
            raise InvalidPolygonError("an arc has a point to go through, or a center; give one of them")
        if center is None and (clockwise or conjugate is not None):
            raise InvalidPolygonError("clockwise, conjugate: of arcs about a center; give one, or leave them out")
        points = {"to": to, "through": through, "center": center, "conjugate": conjugate}
        for name, point in points.items():
            object.__setattr__(self, name, None if point is None else exact_point(point))
        object.__setattr__(self, "clockwise", clockwise)


@checked
@dataclass(frozen=True, init=False)
class Bezier:
    """A Bézier curve from the point before it.

    Parameters
    ----------
    points : two or three points (x, y)
        The other control points, the end last: degree 2 or 3.
    """

    points: tuple[ExactPoint, ...]

    def __init__(self, points: Sequence[Point]) -> None:
        if len(points) not in (2, 3):
            raise InvalidPolygonError(f"a Bézier curve has 2 or 3 points after the one before it, not {len(points)}")
        object.__setattr__(self, "points", tuple(map(exact_point, points)))


@checked
@dataclass(frozen=True, init=False)
class Spline:
    """A clamped uniform cubic B-spline from the point before it: it begins and ends at control points.

    Parameters
    ----------
    points : three points (x, y) or more
        The control points after the first, which is the point before it.
    """

    points: tuple[ExactPoint, ...]

    def __init__(self, points: Sequence[Point]) -> None:
        if len(points) < DEGREE:
            raise InvalidPolygonError(f"a spline has 3 points or more after the one before it, not {len(points)}")
        object.__setattr__(self, "points", tuple(map(exact_point, points)))


@checked
@dataclass(frozen=True, init=False)
class Circle:
    """A whole circle.

    Parameters
    ----------
    center : (x, y)
    radius : number
    """

    center: ExactPoint
    radius: Fraction

    def __init__(self, center: Point, radius: Number) -> None:
        object.__setattr__(self, "center", exact_point(center))
        object.__setattr__(self, "radius", _length(radius, "radius"))


@checked
@dataclass(frozen=True, init=False)
class Ellipse:
    """A whole ellipse.

    Parameters
    ----------
    center : (x, y)
    radii : (a, b)
    angle : angle
        Angle from the x-axis to the first radius, as in `cfree.Pose`.
    """

    center: ExactPoint
    radii: tuple[Fraction, Fraction]
    turned: Pose

    def __init__(self, center: Point, radii: Sequence[Number], angle: Angle = 0) -> None:
        if len(radii) != 2:
            raise InvalidPolygonError(f"an ellipse has 2 radii, not {len(radii)}")
        object.__setattr__(self, "center", exact_point(center))
        object.__setattr__(self, "radii", tuple(_length(radius, "radii") for radius in radii))
        object.__setattr__(self, "turned", Pose(0, 0, angle))


Segment = ExactPoint | Arc | Bezier | Spline
GivenRing = Circle | Ellipse | tuple[Segment, ...]


@dataclass(frozen=True, slots=True)
class Span:
    """Arc of an ellipse: center + u cos t + v sin t, for t from 0 to `quarters` right angles plus 2 arctan(`rest`)."""

    center: ExactPoint
    u: ExactPoint
    v: ExactPoint
    quarters: int
    rest: Fraction  # in [0, 1)

    def at(self, quarters: int, s: Fraction) -> ExactPoint:
        """Return the point after this many right angles plus 2 arctan(s)."""
        if not s:
            (x, y), (p, q), sign = self.center, (self.u, self.v)[quarters % 2], 1 if quarters % 4 < 2 else -1
            return x + sign * p, y + sign * q
        square = 1 + s * s
        c, d = (1 - s * s) / square, 2 * s / square
        for _ in range(quarters % 4):
            c, d = -d, c
        (x, y), (p, q), (r, t) = self.center, self.u, self.v
        return x + c * p + d * r, y + c * q + d * t

    @property
    def end(self) -> ExactPoint:
        return self.at(self.quarters, self.rest)

    @property
    def is_circular(self) -> bool:
        """True if it is on a circle: its conjugate radii are perpendicular and equally long."""
        (a, b), (c, d) = self.u, self.v
        return a * c + b * d == 0 and a * a + b * b == c * c + d * d

    @property
    def sense(self) -> int:
        """1 if it runs counter-clockwise, -1 if clockwise."""
        (a, b), (c, d) = self.u, self.v
        return 1 if a * d > b * c else -1

    @property
    def sweep(self) -> float:
        """Length of its interval of t, in radians: the angle turned on a circle."""
        return self.quarters * math.pi / 2 + 2 * math.atan(self.rest)


@dataclass(frozen=True, slots=True)
class Cubic:
    """A Bézier curve of degree 3."""

    points: tuple[ExactPoint, ExactPoint, ExactPoint, ExactPoint]


Piece = Line | Span | Cubic


def exact_point(point: Point) -> ExactPoint:
    if isinstance(point, str) or len(point) != 2:
        raise InvalidPolygonError(f"{point!r} is no point; give (x, y)")
    x, y = map(to_fraction, point)
    return x, y


def _length(value: Number, name: str) -> Fraction:
    if (length := to_fraction(value)) > 0:
        return length
    raise InvalidPolygonError(f"{name}: {value}; give a length above 0")


def given_ring(ring: Any) -> GivenRing:
    """Convert points to exact ones; other items stay as they are."""
    if isinstance(ring, Circle | Ellipse):
        return ring
    return tuple(item if isinstance(item, Arc | Bezier | Spline) else exact_point(item) for item in ring)


def exact_ring(ring: GivenRing) -> list[Piece]:
    """Convert an input ring to an exact closed curve.

    Raises
    ------
    InvalidPolygonError
        If a path does not begin with a point, or an arc does not end on its circle.

    Examples
    --------
    >>> half = exact_ring(given_ring([(1, 0), Arc((-1, 0), center=(0, 0))]))
    >>> half[0].quarters, half[0].rest, half[1].end == (1, 0)
    (2, Fraction(0, 1), True)
    """
    if isinstance(ring, Circle):
        zero = Fraction(0)
        return [Span(ring.center, (ring.radius, zero), (zero, ring.radius), 4, zero)]
    if isinstance(ring, Ellipse):
        (a, b), (*turn, w) = ring.radii, ring.turned.rotation
        c, s = (Fraction(n, w) for n in turn)
        return [Span(ring.center, (a * c, a * s), (-b * s, b * c), 4, Fraction(0))]
    if not ring or not isinstance(ring[0], tuple):
        raise InvalidPolygonError("a path begins with a point; give one first")
    place, pieces = ring[0], list[Piece]()
    for k, item in enumerate(ring[1:], 1):
        try:
            pieces += _pieces(place, item)
        except InvalidPolygonError as error:
            raise InvalidPolygonError(f"item {k} of the path: {error}") from None
        place = _end(item)
    return [*pieces, *([Line(place, ring[0])] if place != ring[0] else [])]


def items_of(ring: GivenRing) -> list[str]:
    """Return the names of the items of an input ring that the pieces of `exact_ring` belong to.

    Examples
    --------
    >>> items_of(given_ring([(1, 0), Arc((-1, 0), center=(0, 0))]))
    ['item 1', 'the closing line']
    """
    if isinstance(ring, Circle | Ellipse):
        return ["the circle" if isinstance(ring, Circle) else "the ellipse"]
    names, place = list[str](), ring[0]
    for k, item in enumerate(ring[1:], 1):
        assert isinstance(place, tuple)
        names += [f"item {k}"] * len(_pieces(place, item))
        place = _end(item)
    return names + (["the closing line"] if place != ring[0] else [])


def _end(item: Segment) -> ExactPoint:
    return item if isinstance(item, tuple) else item.to if isinstance(item, Arc) else item.points[-1]


def _pieces(start: ExactPoint, item: Segment) -> list[Piece]:
    match item:
        case Arc():
            return [_span(start, item)]
        case Bezier((p, q)):
            lower, upper = (_between(e, p, Fraction(2, 3)) for e in (start, q))
            return [Cubic((start, lower, upper, q))]
        case Bezier((p, q, r)):
            return [Cubic((start, p, q, r))]
        case Spline(points):
            return _cubics((start, *points))
        case _:
            assert isinstance(item, tuple)
            return [Line(start, item)] if item != start else []


def _between(p: ExactPoint, q: ExactPoint, share: Fraction) -> ExactPoint:
    return p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])


def _span(start: ExactPoint, arc: Arc) -> Span:
    clockwise = arc.clockwise
    if arc.through is not None:
        center, side = _circle_through(start, arc.through, arc.to)
        clockwise = side < 0
    else:
        assert arc.center is not None
        center = arc.center
    u = start[0] - center[0], start[1] - center[1]
    v = arc.conjugate or (-u[1], u[0])
    if clockwise != (arc.conjugate is not None and u[0] * v[1] - u[1] * v[0] < 0):
        v = -v[0], -v[1]
    det = u[0] * v[1] - u[1] * v[0]
    if not det:
        raise InvalidPolygonError("the radii of an arc are parallel, or 0; give others")
    x, y = arc.to[0] - center[0], arc.to[1] - center[1]
    c, s = (x * v[1] - y * v[0]) / det, (u[0] * y - u[1] * x) / det
    if c * c + s * s != 1:
        remedy = "give a point that it goes through instead of the center" if arc.conjugate is None else "give another"
        end = f"({coordinate(float(arc.to[0]))}, {coordinate(float(arc.to[1]))})"
        raise InvalidPolygonError(f"{end} is not on it, by a part of {float(abs(c * c + s * s - 1) / 2):.1e}; {remedy}")
    quarters = 0
    while not (c > 0 and s >= 0):
        c, s, quarters = s, -c, quarters + 1
    return Span(center, u, v, quarters or (0 if s else 4), s / (1 + c))


def _circle_through(p: ExactPoint, q: ExactPoint, r: ExactPoint) -> tuple[ExactPoint, Fraction]:
    """Center of the circle through three points, and the sense of the turn: above 0 counter-clockwise."""
    ax, ay, bx, by = q[0] - p[0], q[1] - p[1], r[0] - p[0], r[1] - p[1]
    cross = ax * by - ay * bx
    if not cross:
        raise InvalidPolygonError("three points on one line: there is no arc through them; give others")
    a, b = ax * ax + ay * ay, bx * bx + by * by
    return (p[0] + (a * by - b * ay) / (2 * cross), p[1] + (b * ax - a * bx) / (2 * cross)), cross


def _cubics(points: tuple[ExactPoint, ...]) -> list[Piece]:
    """Convert a clamped uniform cubic B-spline to Bézier curves, by its blossom."""
    count = len(points) - DEGREE
    knots = [min(max(k - DEGREE, 0), count) for k in range(len(points) + DEGREE + 1)]

    def blossom(span: int, *parameters: int) -> ExactPoint:
        row = list(points[span : span + DEGREE + 1])
        for level, t in enumerate(parameters, 1):
            for j in range(DEGREE, level - 1, -1):
                low, high = knots[span + j], knots[span + j + DEGREE + 1 - level]
                row[j] = _between(row[j - 1], row[j], Fraction(t - low, high - low))
        return row[DEGREE]

    pieces: list[Piece] = []
    for k in range(count):
        p, q, r, s = (blossom(k, *(k + (i >= 3 - j) for i in range(DEGREE))) for j in range(DEGREE + 1))
        pieces.append(Cubic((p, q, r, s)))
    return pieces
