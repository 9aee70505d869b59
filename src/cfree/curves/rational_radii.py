"""Arcs of irrational radius between corners, given a rational radius near it.

With a rational unit vector n from the center to the arc's start A, and its end B, the circle through both has the
rational radius -|B - A|² / (2 n · (B - A)). So the ends stay, and only the middle moves.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

from cfree.curves.healing import CHOICE_SHARE, Change, middle_of, segment_of, unit_near
from cfree.curves.pieces import direction_of, start_of
from cfree.curves.rings import Arc, GivenRing, Piece, Segment, Span
from cfree.exact.number import ExactPoint, rational_root
from cfree.exact.vectors import along, cross, dot, minus


def with_rational_radii(pieces: Sequence[Piece], tolerance: float) -> tuple[GivenRing, list[Change]] | None:
    """Return a ring whose circular arcs have rational radii, or None if none is to change.

    An arc that is exactly tangent to a neighbor stays, and so does one whose middle would move by more than
    `tolerance`.
    """
    path: list[Segment] = [start_of(pieces[0])]
    changes: list[Change] = []
    for k, piece in enumerate(pieces):
        near = (pieces[k - 1], pieces[(k + 1) % len(pieces)])
        if isinstance(piece, Span) and (center := _center(piece, *near, tolerance)):
            changes.append(Change(start_of(piece), _moved(piece, center)))
            path.append(Arc(piece.end, center=center, clockwise=piece.sense < 0))
        else:
            path.append(segment_of(piece))
    return (tuple(path), changes) if changes else None


def _center(arc: Span, before: Piece, after: Piece, tolerance: float) -> ExactPoint | None:
    """Return a new center of an arc, None if it stays."""
    start, end = start_of(arc), arc.end
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
    start, end, is_left = start_of(arc), arc.end, arc.sense > 0
    moved = math.dist(*(middle_of(c, start, end, is_left) for c in (arc.center, center)))
    return moved or math.hypot(*map(float, minus(center, arc.center)))


def _is_tangent(piece: Piece, after: Piece) -> bool:
    return cross(direction_of(piece, at_end=True), direction_of(after, at_end=False)) == 0
