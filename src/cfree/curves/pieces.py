"""Exact pieces of closed curves: boxes, affine frames, rounding to doubles, and proofs that polygons contain them.

In a frame that makes a thin ring as high as it is long, doubles can distinguish its two sides.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from cfree.curves import drawn
from cfree.curves.drawn import Line
from cfree.curves.rings import Cubic, Piece, Span
from cfree.exact.number import ExactPoint, rational_root
from cfree.exact.vectors import minus
from cfree.polygons.polygon import Polygon

Curve = Sequence[Piece]
Box = tuple[Fraction, Fraction, Fraction, Fraction]

THIN = Fraction(1, 64)  # height / length below which a ring gets its own frame
TIGHT = 2**20  # a box may exceed its curve by size / TIGHT


@dataclass(frozen=True, slots=True)
class Frame:
    """An affine frame: the point (a, b) stands for origin + a along + b across."""

    origin: ExactPoint
    along: ExactPoint
    across: ExactPoint

    def world(self, p: ExactPoint) -> ExactPoint:
        """Convert a point from the frame's coordinates."""
        (x, y), (a, b), (c, d) = self.origin, self.along, self.across
        return x + p[0] * a + p[1] * c, y + p[0] * b + p[1] * d

    def local(self, curve: Curve) -> list[Piece]:
        """Convert a curve to the frame's coordinates."""
        (a, b), (c, d) = self.along, self.across
        det = a * d - b * c

        def direction(p: ExactPoint) -> ExactPoint:
            return (p[0] * d - p[1] * c) / det, (a * p[1] - b * p[0]) / det

        def point(p: ExactPoint) -> ExactPoint:
            return direction((p[0] - self.origin[0], p[1] - self.origin[1]))

        moved: list[Piece] = []
        for piece in curve:
            match piece:
                case Line(start, end):
                    moved.append(Line(point(start), point(end)))
                case Cubic((p, q, r, s)):
                    moved.append(Cubic((point(p), point(q), point(r), point(s))))
                case Span(center, u, v, quarters, rest):
                    moved.append(Span(point(center), direction(u), direction(v), quarters, rest))
        return moved

    @property
    def length(self) -> float:
        """Length of the longer axis."""
        return max(math.hypot(*map(float, axis)) for axis in (self.along, self.across))


def thin_frame(curve: Curve) -> Frame | None:
    """Return the frame in which a thin curve is about as high as it is long; None if it is not thin.

    Examples
    --------
    >>> from cfree.curves.rings import Ellipse, exact_ring
    >>> frame = thin_frame(exact_ring(Ellipse((0, 0), (1, Fraction(1, 1000)))))
    >>> frame.along, frame.across[1]
    ((Fraction(-2, 1), Fraction(1, 1024)), Fraction(-1, 256))
    >>> thin_frame(exact_ring(Ellipse((0, 0), (1, Fraction(1, 10))))) is None
    True
    """
    points = [p for piece in curve for p in hull_points(piece)]
    origin = points[0]
    offsets = [(x - origin[0], y - origin[1]) for x, y in points]
    far = max(offsets, key=lambda p: math.hypot(float(p[0]), float(p[1])))
    square = far[0] ** 2 + far[1] ** 2
    if not square:
        return None

    def height(d: ExactPoint) -> Fraction:
        heights = [d[0] * y - d[1] * x for x, y in offsets]
        return (max(heights) - min(heights)) / square

    thin = height(far)
    if not 0 < thin < THIN:
        return None
    digits = power_of_two(thin / 16 * max(abs(far[0]), abs(far[1])))
    along = round(far[0] / digits) * digits, round(far[1] / digits) * digits
    share = power_of_two(height(along))
    return Frame(origin, along, (-along[1] * share, along[0] * share))


def power_of_two(value: Fraction) -> Fraction:
    """Return a power of two between half of a number and its double."""
    return Fraction(2) ** (value.numerator.bit_length() - value.denominator.bit_length())


def hull_points(piece: Piece) -> Iterator[ExactPoint]:
    """Points whose convex hull contains a piece."""
    match piece:
        case Line(start, end):
            yield from (start, end)
        case Cubic(points):
            yield from points
        case Span():
            for start, u, v, rest in quarters_of(piece):
                yield start[0] + u[0], start[1] + u[1]
                yield start[0] + u[0] + v[0] * rest, start[1] + u[1] + v[1] * rest
            yield piece.end


def quarters_of(span: Span) -> Iterator[tuple[ExactPoint, ExactPoint, ExactPoint, Fraction]]:
    """Split a span into parts of at most a right angle: center, conjugate radii, tangent of half the angle."""
    u, v = span.u, span.v
    for k in range(span.quarters + 1):
        rest = Fraction(1) if k < span.quarters else span.rest
        if rest:
            yield span.center, u, v, rest
        u, v = v, (-u[0], -u[1])


def start_of(piece: Piece) -> ExactPoint:
    """Return the first point of a piece."""
    match piece:
        case Line(start, _):
            return start
        case Cubic(points):
            return points[0]
    return piece.at(0, Fraction(0))


def direction_of(piece: Piece, *, at_end: bool) -> ExactPoint:
    """Return a vector along a line, a circular arc or a cubic at its start, or at its end."""
    match piece:
        case Line(start, end):
            return minus(end, start)
        case Cubic(points):
            ordered = points[::-1] if at_end else points
            x, y = next((v for q in ordered[1:] if any(v := minus(q, ordered[0]))), (Fraction(0), Fraction(0)))
            return (-x, -y) if at_end else (x, y)
    x, y = minus(piece.end if at_end else start_of(piece), piece.center)
    return -piece.sense * y, piece.sense * x


def box_of(curve: Curve) -> Box:
    """Box around a curve, too large by at most a 2**20th of its size."""
    boxes = [_box(piece) for piece in curve]
    x0, y0, x1, y1 = zip(*boxes, strict=True)
    return min(x0), min(y0), max(x1), max(y1)


def _box(piece: Piece) -> Box:
    low, high = ([_extreme(piece, axis, sign) for axis in (0, 1)] for sign in (-1, 1))
    return low[0], low[1], high[0], high[1]


def _extreme(piece: Piece, axis: int, sign: int) -> Fraction:
    """Greatest coordinate on an axis; for sign -1 the least."""
    match piece:
        case Line(start, end):
            return sign * max(sign * start[axis], sign * end[axis])
        case Cubic(points):
            return sign * _greatest([sign * p[axis] for p in points])
    values: list[Fraction] = []
    for _, u, v, rest in quarters_of(piece):
        # a cos t + b sin t is greatest where its derivative, b at the beginning, changes its sign
        a, b, square = sign * u[axis], sign * v[axis], 1 + rest * rest
        cosine, sine = (1 - rest * rest) / square, 2 * rest / square
        values += [a, a * cosine + b * sine]
        if b > 0 > b * cosine - a * sine:
            values.append(_root_above(a * a + b * b))
    return sign * (sign * piece.center[axis] + max(values))


def _root_above(square: Fraction) -> Fraction:
    """Square root, exact if it is rational, else rounded up."""
    if (root := rational_root(square)) is not None:
        return root
    n, d = square.numerator, square.denominator
    scale = 1 << 2 * (60 + max(0, d.bit_length() - n.bit_length()))
    return Fraction(math.isqrt(n * scale // d) + 1, math.isqrt(scale))


def _greatest(values: list[Fraction]) -> Fraction:
    """Upper bound of a Bézier polynomial on [0, 1], too large by at most a 2**20th of the span of its coefficients."""
    error = (max(values) - min(values)) / TIGHT
    least, bound, waiting = max(values[0], values[-1]), max(values[0], values[-1]), [values]
    while waiting:
        row = waiting.pop()
        top = max(row)
        if top <= max(least, bound):
            continue
        if top <= least + error:
            bound = top
            continue
        left, right = [row[0]], [row[-1]]
        while len(row) > 1:
            row = [(p + q) / 2 for p, q in pairwise(row)]
            left.append(row[0])
            right.append(row[-1])
        least = max(least, left[-1])
        waiting += [left, right[::-1]]
    return max(least, bound)


# --- conversion to doubles and back ---


def drawn_of(curve: Curve) -> drawn.Ring:
    """Round a curve to doubles, with exact ends."""

    def rounded(p: ExactPoint) -> drawn.Vector:
        return float(p[0]), float(p[1])

    ring: drawn.Ring = []
    for piece in curve:
        match piece:
            case Line():
                ring.append(piece)
            case Cubic((p, q, r, s)):
                ring.append(drawn.Cubic((rounded(p), rounded(q), rounded(r), rounded(s)), (p, s)))
            case Span(center, u, v, quarters, rest):
                last = quarters * math.pi / 2 + 2 * math.atan(rest)
                tips = piece.at(0, Fraction(0)), piece.end
                ring.append(drawn.Arc(rounded(center), rounded(u), rounded(v), 0.0, last, tips, rounded(tips[0])))
    return ring


def exact_of(ring: Sequence[drawn.Segment]) -> list[Piece]:
    """Make a curve in doubles exact: through the ends of its lines, each piece from the end of the one before.

    Curves in doubles do not exactly end where their neighbours begin. Here the ends become decimals of 14 digits, and
    arcs become arcs of ellipses through these ends. All moves are within the rounding of doubles.
    """
    joints = joints_of(ring)
    pieces: list[Piece] = []
    for segment, start, end in zip(ring, joints, [*joints[1:], *joints[:1]], strict=True):
        match segment:
            case Line():
                pieces.append(Line(start, end))
            case drawn.Cubic((_, q, r, _), _):
                pieces.append(Cubic((start, exactly(q), exactly(r), end)))
            case drawn.Arc():
                pieces += spans(segment, start, end)
    return pieces


def joints_of(ring: Sequence[drawn.Segment]) -> list[ExactPoint]:
    """Return the exact starts of the segments of a ring in doubles; ends of lines are exact already."""
    return [_joint(ring[k - 1], segment) for k, segment in enumerate(ring)]


def _joint(before: drawn.Segment, segment: drawn.Segment) -> ExactPoint:
    if isinstance(segment, Line):
        return segment.start
    if isinstance(before, Line):
        return before.end
    return segment.tips[0] if segment.tips else drawn.point_of(*drawn.ends(segment)[0])


def exactly(p: drawn.Vector) -> ExactPoint:
    """Return a point in doubles as fractions."""
    return Fraction(p[0]), Fraction(p[1])


def spans(arc: drawn.Arc, start: ExactPoint, end: ExactPoint) -> Iterator[Span]:
    """Split an arc into spans of less than a right angle each."""
    count = math.floor(abs(arc.last - arc.first) / (math.pi / 2)) + 1
    step = (arc.last - arc.first) / count
    places = [start, *(exactly(arc.at(arc.first + k * step)) for k in range(1, count)), end]
    tau = Fraction(math.tan(abs(step) / 2))
    square = 1 + tau * tau
    c, s = (1 - tau * tau) / square, 2 * tau / square
    center = exactly(arc.center)
    for p, q in pairwise(places):
        u = p[0] - center[0], p[1] - center[1]
        v = (q[0] - center[0] - c * u[0]) / s, (q[1] - center[1] - c * u[1]) / s
        yield Span(center, u, v, 0, tau)


# --- the proof ---


def is_proved(ring: Polygon, number: int, curve: Curve, *, within: bool) -> bool:
    """True if a ring of a polygon is proved to be within a curve, or else around it; decided exactly by the core."""
    check: Callable[[int, list[object]], bool] = ring._handle.is_within if within else ring._handle.is_around
    return check(number, [*_for_core(curve)])


def _for_core(curve: Curve) -> Iterator[tuple[list[ExactPoint], Fraction | int]]:
    for piece in curve:
        match piece:
            case Line(start, end):
                yield [start, end], 0
            case Cubic(points):
                yield list(points), 0
            case Span():
                for center, u, v, rest in quarters_of(piece):
                    yield [center, u, v], rest
