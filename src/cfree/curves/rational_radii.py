"""Arcs of irrational radius between corners, given a rational radius near it.

With a rational unit vector n from the center to the arc's start A, and its end B, the circle through both has the
rational radius -|B - A|² / (2 n · (B - A)). So the ends stay, and only the middle moves.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

from cfree.curves.drawn import Line
from cfree.curves.healing import CHOICE_SHARE, Change, middle_of, segment_of, unit_near
from cfree.curves.rings import Arc, Cubic, GivenRing, Piece, Segment, Span
from cfree.exact.number import ExactPoint, rational_root
from cfree.exact.vectors import along, cross, dot, minus


def with_rational_radii(pieces: Sequence[Piece], tolerance: float) -> tuple[GivenRing, list[Change]] | None:
    """Return a ring whose circular arcs have rational radii, or None if none is to change.

    An arc that is exactly tangent to a neighbor stays, and so does one whose middle would move by more than `tolerance`.
    """
    path: list[Segment] = [_start(pieces[0])]
    changes: list[Change] = []
    for k, piece in enumerate(pieces):
        near = (pieces[k - 1], pieces[(k + 1) % len(pieces)])
        if isinstance(piece, Span) and (center := _center(piece, *near, tolerance)):
            changes.append(Change(_start(piece), _moved(piece, center)))
            path.append(Arc(piece.end, center=center, clockwise=piece.sense < 0))
        else:
            path.append(segment_of(piece))
    return (tuple(path), changes) if changes else None


def _center(arc: Span, before: Piece, after: Piece, tolerance: float) -> ExactPoint | None:
    """Return a new center of an arc, None if it stays."""
    start, end = _start(arc), arc.end
    if not arc.is_circular or start == end or rational_root(dot(arc.u, arc.u)) is not None:
        return None
    if _is_tangent(before, arc) or _is_tangent(arc, after):
        return None
    by = Fraction(tolerance / math.hypot(*map(float, arc.u)) / CHOICE_SHARE * min(1.0, abs(math.tan(arc.sweep / 2))))
    n, chord = unit_near(*arc.u, by), minus(end, start)
    center = along(start, dot(chord, chord) / (2 * dot(n, chord)), n)
    return center if dot(n, chord) < 0 and _moved(arc, center) <= tolerance else None


def _moved(arc: Span, center: ExactPoint) -> float:
    """Return how far the middle of an arc moves, or the center if that is less than doubles distinguish."""
    start, end, is_left = _start(arc), arc.end, arc.sense > 0
    moved = math.dist(*(middle_of(c, start, end, is_left) for c in (arc.center, center)))
    return moved or math.hypot(*map(float, minus(center, arc.center)))


def _is_tangent(piece: Piece, after: Piece) -> bool:
    return cross(_direction(piece, at_end=True), _direction(after, at_end=False)) == 0


def _direction(piece: Piece, *, at_end: bool) -> ExactPoint:
    """Return a vector along a piece at one of its ends."""
    match piece:
        case Line(start, end):
            return minus(end, start)
        case Cubic(points):
            p = points[3] if at_end else points[0]
            return next(v for q in (reversed(points) if at_end else points) if any(v := minus(q, p)))
    if not at_end:
        return piece.v
    angle, s = piece.quarters % 4, piece.rest
    c, d = 1 - s * s, 2 * s
    for _ in range(angle):
        c, d = -d, c
    (p, q), (r, t) = piece.u, piece.v
    return c * r - d * p, c * t - d * q


def _start(piece: Piece) -> ExactPoint:
    match piece:
        case Line(start, _):
            return start
        case Cubic(points):
            return points[0]
    return piece.at(0, Fraction(0))
