"""Arcs that are tangent to their neighbours but for rounding, made exactly tangent.

Files give an arc's bulge, or its radius and ends, in short decimals. A corner remains where it meets a line, often of
an angle of 1e-15, which exact decisions keep. If the directions of two lines are rational unit vectors, an arc of
rational radius is tangent to both at rational points. So lines get such directions, nearly their own, about their
middles; axis-parallel and Pythagorean ones stay.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

from cfree.curves.drawn import Line
from cfree.curves.rings import Arc, Bezier, Cubic, GivenRing, Piece, Segment, Span
from cfree.exact.number import ExactPoint, simplest_between

MOST_MOVED = 64  # tolerances that an end may move: more if lines are nearly parallel


def healed_ring(pieces: Sequence[Piece], tolerance: float, size: float) -> GivenRing | None:
    """Return a ring whose arcs are exactly tangent where they nearly are, or None if there is nothing to heal.

    Parameters
    ----------
    pieces : sequence of Line, Span and Cubic
        A closed ring.
    tolerance : float
        Angle to the tangents, in radians; part of the radius by which it may change.
    size : float
        Size of the shape.
    """
    count = len(pieces)
    arcs = {k for k in range(count) if count > 2 and _is_tangent(pieces, k, tolerance)}
    while True:
        lines = {j % count for k in arcs for j in (k - 1, k + 1)}
        moved = {k for k in lines if _exact_unit(_vector(pieces[k])) is None}
        # a line that moves needs a line, or an arc that follows it, at both ends
        stuck = {
            k
            for k in moved
            if any(j % count not in arcs and not isinstance(pieces[j % count], Line) for j in (k - 1, k + 1))
        }
        if not stuck:
            break
        arcs = {k for k in arcs if not {(k - 1) % count, (k + 1) % count} & stuck}
    if not arcs:
        return None
    on = {k: _line(pieces[k], tolerance) for k in range(count) if isinstance(pieces[k], Line)}
    for k in on:
        if k not in lines:
            on[k] = pieces[k].start, _vector(pieces[k])  # type: ignore[union-attr]
    ends: dict[int, ExactPoint] = {}  # the end of each piece
    centers: dict[int, ExactPoint] = {}
    for k in arcs:
        arc = pieces[k]
        assert isinstance(arc, Span)
        place = _tangent_arc(arc, on[(k - 1) % count], on[(k + 1) % count], tolerance)
        if place is None:
            return None
        ends[(k - 1) % count], ends[k], centers[k] = place
    for k in range(count):
        j = (k + 1) % count
        if k not in ends and {k, j} & moved:
            if not _cross(on[k][1], on[j][1]):
                return None
            ends[k] = _meeting(on[k], on[j])
    far = MOST_MOVED * tolerance * size
    if any(math.dist(map(float, p), map(float, _end(pieces[k]))) > far for k, p in ends.items()):
        return None
    return _path(pieces, ends, centers)


def _path(pieces: Sequence[Piece], ends: dict[int, ExactPoint], centers: dict[int, ExactPoint]) -> GivenRing:
    path: list[Segment] = [ends.get(len(pieces) - 1, _end(pieces[-1]))]
    for k, piece in enumerate(pieces):
        end = ends.get(k, _end(piece))
        match piece:
            case Line():
                path.append(end)
            case Cubic(points):
                path.append(Bezier(points[1:]))
            case Span() if k in centers:
                path.append(Arc(end, center=centers[k], clockwise=_cross(piece.u, piece.v) < 0))
            case Span():
                path.append(Arc(end, center=piece.center, conjugate=piece.v, clockwise=_cross(piece.u, piece.v) < 0))
    return tuple(path)


def _is_tangent(pieces: Sequence[Piece], k: int, tolerance: float) -> bool:
    """True if a piece is a circular arc of at most half a turn, nearly tangent to lines before and after it."""
    arc, before, after = pieces[k], pieces[k - 1], pieces[(k + 1) % len(pieces)]
    if not (isinstance(arc, Span) and isinstance(before, Line) and isinstance(after, Line)):
        return False
    if _dot(arc.u, arc.v) or _dot(arc.u, arc.u) != _dot(arc.v, arc.v):
        return False
    sweep = arc.quarters * math.pi / 2 + 2 * math.atan(float(arc.rest))
    back = _minus(arc.end, arc.center)
    leaving = (-back[1], back[0]) if _cross(arc.u, arc.v) > 0 else (back[1], -back[0])
    return sweep <= math.pi + tolerance and all(
        _dot(v, w) > 0 and abs(_cross(v, w)) <= tolerance * _dot(v, w)
        for v, w in ((arc.v, _vector(before)), (leaving, _vector(after)))
    )


def _tangent_arc(
    arc: Span, before: tuple[ExactPoint, ExactPoint], after: tuple[ExactPoint, ExactPoint], tolerance: float
) -> tuple[ExactPoint, ExactPoint, ExactPoint] | None:
    """Return start, end and center of an arc that is tangent to two lines with rational unit directions."""
    (a, d), (b, e) = before, after
    turn = 1 if _cross(arc.u, arc.v) > 0 else -1
    inward = (-turn * d[1], turn * d[0])
    sine, cosine = turn * _cross(d, e), _dot(d, e)
    if sine == 0:
        start = _along(a, _dot(_minus(_start(arc), a), d), d)
        radius = _dot(_minus(b, a), inward) / 2
        if cosine > 0 or radius <= 0:
            return None
        return start, _along(start, 2 * radius, inward), _along(start, radius, inward)
    if sine < 0:
        return None
    middle = Fraction(math.sqrt(_dot(arc.u, arc.u)))
    radius = simplest_between(middle * (1 - Fraction(tolerance)), middle * (1 + Fraction(tolerance)))
    corner, length = _meeting(before, after), radius * sine / (1 + cosine)
    start = _along(corner, -length, d)
    return start, _along(corner, length, e), _along(start, radius, inward)


def _line(piece: Piece, tolerance: float) -> tuple[ExactPoint, ExactPoint]:
    """Return a point of a line, and a rational unit vector along it, or nearly so."""
    assert isinstance(piece, Line)
    x, y = _vector(piece)
    if (unit := _exact_unit((x, y))) is not None:
        return piece.start, unit
    quarters = 0
    while not (x > 0 and -x < y <= x):
        x, y, quarters = y, -x, quarters + 1
    half = Fraction(math.tan(math.atan2(y, x) / 2))
    t = simplest_between(half - Fraction(tolerance) / 4, half + Fraction(tolerance) / 4)
    x, y = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    for _ in range(quarters):
        x, y = -y, x
    (p, q), (r, s) = piece.start, piece.end
    return ((p + r) / 2, (q + s) / 2), (x, y)


def _exact_unit(vector: ExactPoint) -> ExactPoint | None:
    square = _dot(vector, vector)
    length = Fraction(math.isqrt(square.numerator), math.isqrt(square.denominator))
    return (vector[0] / length, vector[1] / length) if length and length * length == square else None


def _meeting(one: tuple[ExactPoint, ExactPoint], other: tuple[ExactPoint, ExactPoint]) -> ExactPoint:
    (a, d), (b, e) = one, other
    return _along(a, _cross(_minus(b, a), e) / _cross(d, e), d)


def _start(arc: Span) -> ExactPoint:
    return arc.center[0] + arc.u[0], arc.center[1] + arc.u[1]


def _end(piece: Piece) -> ExactPoint:
    return piece.points[-1] if isinstance(piece, Cubic) else piece.end


def _vector(piece: Piece) -> ExactPoint:
    assert isinstance(piece, Line)
    return _minus(piece.end, piece.start)


def _minus(a: ExactPoint, b: ExactPoint) -> ExactPoint:
    return a[0] - b[0], a[1] - b[1]


def _along(a: ExactPoint, t: Fraction, d: ExactPoint) -> ExactPoint:
    return a[0] + t * d[0], a[1] + t * d[1]


def _cross(a: ExactPoint, b: ExactPoint) -> Fraction:
    return a[0] * b[1] - a[1] * b[0]


def _dot(a: ExactPoint, b: ExactPoint) -> Fraction:
    return a[0] * b[0] + a[1] * b[1]
