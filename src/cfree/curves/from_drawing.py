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
from cfree.exact.number import ExactPoint, rational_root, simplest_between
from cfree.exact.vectors import cross, minus

ROUNDING = 1e-14  # of doubles, relative to the largest of the numbers of an arc
SIMPLEST = 1000  # largest denominator of a proportion that is taken for the drawn one


def curved_of(outline: Outline) -> Curved:
    """Return the exact round shape of an outline whose curves are in doubles.

    Ends of lines stay exact. An arc of a circle that could be drawn with a rational center and radius has them:
    quarters and halves of circles, and arcs with other simple proportions. Another one goes through the drawn point in
    its middle. All moves are within the rounding of doubles.

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
    return start, Arc(start, center=center, conjugate=v, clockwise=cross(u, v) < 0)


def _items(segment: drawn.Segment, start: ExactPoint, end: ExactPoint) -> Sequence[Segment]:
    match segment:
        case drawn.Line():
            return [end]
        case drawn.Cubic((_, q, r, _), _):
            return [Bezier([exactly(q), exactly(r), end])]
        case drawn.Arc() if segment.circular and start != end:
            if (center := _simple_center(segment, start, end)) is None:
                return [Arc(end, through=exactly(drawn.middle(segment)))]
            return [Arc(end, center=center, clockwise=segment.is_clockwise)]
        case drawn.Arc():
            return [
                Arc(span.end, center=span.center, conjugate=span.v, clockwise=cross(span.u, span.v) < 0)
                for span in spans(segment, start, end)
            ]


def _simple_center(arc: drawn.Arc, start: ExactPoint, end: ExactPoint) -> ExactPoint | None:
    """Return the rational center that an arc of a circle was drawn about, if its radius is rational too; else None.

    The center is off the middle of the chord by a multiple of the chord, which must be a simple number.
    """
    half = abs(arc.last - arc.first) / (-2 if arc.is_clockwise else 2)
    multiple = 0.5 / math.tan(half)
    by = (1 + 4 * multiple * multiple) * ROUNDING
    rise = simplest_between(Fraction(multiple - by), Fraction(multiple + by))
    x, y = minus(end, start)
    square = (x * x + y * y) * (rise * rise + Fraction(1, 4))
    if rise.denominator > SIMPLEST or rational_root(square) is None:
        return None
    center = start[0] + x / 2 - rise * y, start[1] + y / 2 + rise * x
    to_middle = Fraction(math.tan(half / 2) / 2)
    middle = start[0] + x / 2 + to_middle * y, start[1] + y / 2 - to_middle * x
    apart = max(abs(float(p) - q) for p, q in zip(middle, drawn.middle(arc), strict=True))
    return center if apart <= ROUNDING * (max(map(abs, map(float, center))) + math.sqrt(square)) else None
