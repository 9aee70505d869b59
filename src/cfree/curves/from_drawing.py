"""Round shapes from outlines of drawings: arcs of circles stay arcs, and curves stay curves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from cfree.curves import drawn
from cfree.curves.curved import Curved
from cfree.curves.hulls import Outline
from cfree.curves.pieces import exactly, joints_of, spans
from cfree.curves.rings import Arc, Bezier, Circle, GivenRing, Segment
from cfree.exact.number import ExactPoint


def curved_of(outline: Outline) -> Curved:
    """Return the exact round shape of an outline whose curves are in doubles.

    Ends of lines stay exact. An arc of a circle goes through the drawn point in its middle; all moves are within the
    rounding of doubles.

    Raises
    ------
    InvalidPolygonError
        If the rings bound no shape.

    Examples
    --------
    >>> half = [drawn.Line((Fraction(0), Fraction(0)), (Fraction(2), Fraction(0)))]
    >>> half += [drawn.arc_of_circle((1.0, 0.0), 1.0, 0.0, math.pi)]
    >>> curved_of(Outline(half)).box == (0, 0, 2, 1)
    True
    """
    outer, *holes = map(_path, outline.rings)
    return Curved(outer, holes)


def _path(ring: drawn.Ring) -> GivenRing:
    if len(ring) == 1 and isinstance(ring[0], drawn.Arc) and ring[0].closed:
        return _whole(ring[0])
    joints = joints_of(ring)
    path: list[Segment] = [joints[0]]
    for segment, (start, end) in zip(ring, pairwise([*joints, joints[0]]), strict=True):
        path += _items(segment, start, end)
    return tuple(path)


def _whole(arc: drawn.Arc) -> GivenRing:
    center, u, v = (drawn.point_of(*p) for p in (arc.center, arc.u, arc.v))
    if arc.circular:
        return Circle(center, drawn.decimal(math.hypot(*arc.u)))
    start = center[0] + u[0], center[1] + u[1]
    return start, Arc(start, center=center, conjugate=v, clockwise=u[0] * v[1] < u[1] * v[0])


def _items(segment: drawn.Segment, start: ExactPoint, end: ExactPoint) -> Sequence[Segment]:
    match segment:
        case drawn.Line():
            return [end]
        case drawn.Cubic((_, q, r, _), _):
            return [Bezier([exactly(q), exactly(r), end])]
        case drawn.Arc() if segment.circular and start != end:
            return [Arc(end, through=exactly(drawn.middle(segment)))]
        case drawn.Arc():
            return [
                Arc(span.end, center=span.center, conjugate=span.v, clockwise=_turn(span.u, span.v) < 0)
                for span in spans(segment, start, end)
            ]


def _turn(u: ExactPoint, v: ExactPoint) -> Fraction:
    return u[0] * v[1] - u[1] * v[0]
