"""Exact pieces of closed curves: their boxes, affine frames, the same in doubles, and the proof that a polygon fits.

A frame in which a thin ring is as high as it is long lets doubles tell its two sides apart.
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
from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon

Curve = Sequence[Piece]
Box = tuple[Fraction, Fraction, Fraction, Fraction]

THIN = Fraction(1, 64)  # height by length, from which on a ring has a frame of its own
TIGHT = 2**20  # parts of a curve's size by which its box may be larger


@dataclass(frozen=True, slots=True)
class Frame:
    """An affine frame: the point (a, b) stands for origin + a along + b across."""

    origin: ExactPoint
    along: ExactPoint
    across: ExactPoint

    def world(self, p: ExactPoint) -> ExactPoint:
        """Return the point that a pair of numbers stands for."""
        (x, y), (a, b), (c, d) = self.origin, self.along, self.across
        return x + p[0] * a + p[1] * c, y + p[0] * b + p[1] * d

    def local(self, curve: Curve) -> list[Piece]:
        """Return a curve in the frame's numbers."""
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
    """Return a power of two between half of a number and twice of it."""
    return Fraction(2) ** (value.numerator.bit_length() - value.denominator.bit_length())


def hull_points(piece: Piece) -> Iterator[ExactPoint]:
    """Points in whose hull a piece is."""
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
    """Center, conjugate radii, and tangent of half the angle, of parts of at most a right angle."""
    u, v = span.u, span.v
    for k in range(span.quarters + 1):
        rest = Fraction(1) if k < span.quarters else span.rest
        if rest:
            yield span.center, u, v, rest
        u, v = v, (-u[0], -u[1])


def box_of(curve: Curve) -> Box:
    """A box around a curve, larger by a 2**20th of its size at most."""
    boxes = [_box(piece) for piece in curve]
    x0, y0, x1, y1 = zip(*boxes, strict=True)
    return min(x0), min(y0), max(x1), max(y1)


def _box(piece: Piece) -> Box:
    low, high = ([_extreme(piece, axis, sign) for axis in (0, 1)] for sign in (-1, 1))
    return low[0], low[1], high[0], high[1]


def _extreme(piece: Piece, axis: int, sign: int) -> Fraction:
    """The greatest coordinate on an axis, or with the sign -1 the least."""
    match piece:
        case Line(start, end):
            return sign * max(sign * start[axis], sign * end[axis])
        case Cubic(points):
            return sign * _greatest([sign * p[axis] for p in points])
    values: list[Fraction] = []
    for _, u, v, rest in quarters_of(piece):
        # a cos t + b sin t is greatest where its derivative, b at the begin, changes its sign
        a, b, square = sign * u[axis], sign * v[axis], 1 + rest * rest
        cosine, sine = (1 - rest * rest) / square, 2 * rest / square
        values += [a, a * cosine + b * sine]
        if b > 0 > b * cosine - a * sine:
            values.append(_root_above(a * a + b * b))
    return sign * (sign * piece.center[axis] + max(values))


def _root_above(square: Fraction) -> Fraction:
    """A square root, exact if it is rational, else from above."""
    n, d = square.numerator, square.denominator
    root = Fraction(math.isqrt(n), math.isqrt(d))
    if root * root == square:
        return root
    scale = 1 << 2 * (60 + max(0, d.bit_length() - n.bit_length()))
    return Fraction(math.isqrt(n * scale // d) + 1, math.isqrt(scale))


def _greatest(values: list[Fraction]) -> Fraction:
    """A bound from above on a Bézier polynomial from 0 to 1, larger by a 2**20th of what its values span at most."""
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


# --- the same in doubles, and from doubles ---


def drawn_of(curve: Curve) -> drawn.Ring:
    """The curve in doubles, with exact ends."""

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
    """The exact curve for one in doubles: through the ends of its lines, each piece from where the one before ends.

    Curves in doubles do not quite end where their neighbours begin. Here the ends are decimals of 14 digits, and arcs
    become those of ellipses through them, so that nothing moves by more than doubles round.
    """
    joints = [_joint(ring[k - 1], segment) for k, segment in enumerate(ring)]
    pieces: list[Piece] = []
    for segment, start, end in zip(ring, joints, [*joints[1:], *joints[:1]], strict=True):
        match segment:
            case Line():
                pieces.append(Line(start, end))
            case drawn.Cubic((_, q, r, _), _):
                pieces.append(Cubic((start, _exactly(q), _exactly(r), end)))
            case drawn.Arc():
                pieces += _spans(segment, start, end)
    return pieces


def _joint(before: drawn.Segment, segment: drawn.Segment) -> ExactPoint:
    if isinstance(segment, Line):
        return segment.start
    if isinstance(before, Line):
        return before.end
    return segment.tips[0] if segment.tips else drawn.point_of(*drawn.ends(segment)[0])


def _exactly(p: drawn.Vector) -> ExactPoint:
    return Fraction(p[0]), Fraction(p[1])


def _spans(arc: drawn.Arc, start: ExactPoint, end: ExactPoint) -> Iterator[Span]:
    """Arcs of less than a right angle each."""
    count = math.floor(abs(arc.last - arc.first) / (math.pi / 2)) + 1
    step = (arc.last - arc.first) / count
    places = [start, *(_exactly(arc.at(arc.first + k * step)) for k in range(1, count)), end]
    tau = Fraction(math.tan(abs(step) / 2))
    square = 1 + tau * tau
    c, s = (1 - tau * tau) / square, 2 * tau / square
    center = _exactly(arc.center)
    for p, q in pairwise(places):
        u = p[0] - center[0], p[1] - center[1]
        v = (q[0] - center[0] - c * u[0]) / s, (q[1] - center[1] - c * u[1]) / s
        yield Span(center, u, v, 0, tau)


# --- the proof ---


def is_proved(ring: Polygon, number: int, curve: Curve, *, within: bool) -> bool:
    """True if a ring of a polygon is proved to be within a curve, or else around it; decided exactly by the core."""
    check: Callable[[int, list[object]], bool] = ring.core.is_within if within else ring.core.is_around
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
