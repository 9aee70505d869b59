"""Shapes scaled and moved, exactly."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from cfree.curves.curved import Curved
from cfree.curves.rings import Arc, Bezier, Circle, Ellipse, GivenRing, Segment, Spline
from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon

AnyShape = Polygon | Curved
Map = Callable[[ExactPoint], ExactPoint]


def similar(
    shape: AnyShape, factor: Fraction = Fraction(1), shift: ExactPoint = (Fraction(0), Fraction(0))
) -> AnyShape:
    """Return a shape scaled about the origin by a factor above 0, then moved.

    Examples
    --------
    >>> similar(Polygon([(0, 0), (4, 0), (0, 4)]), Fraction(1, 2), (Fraction(1), Fraction(0))).bounds
    (1.0, 0.0, 3.0, 2.0)
    >>> similar(Curved.circle((1, 0), 2), Fraction(3)).path
    Circle(center=(Fraction(3, 1), Fraction(0, 1)), radius=Fraction(6, 1))
    """

    def place(p: ExactPoint) -> ExactPoint:
        return factor * p[0] + shift[0], factor * p[1] + shift[1]

    if isinstance(shape, Polygon):
        first, *others = (list(map(place, ring)) for ring in shape.exact_rings)
        return Polygon(first, others)
    outer, *holes = (_ring(ring, factor, place) for ring in (shape.path, *shape.holes))
    return Curved(outer, holes, grown=shape.grown * factor)


def _ring(ring: GivenRing, factor: Fraction, place: Map) -> GivenRing:
    match ring:
        case Circle(center, radius):
            return Circle(place(center), radius * factor)
        case Ellipse(center, (a, b), turned):
            return Ellipse(place(center), (a * factor, b * factor), {"tau": turned.tau})
        case _:
            return tuple(_segment(item, factor, place) for item in ring)


def _segment(item: Segment, factor: Fraction, place: Map) -> Segment:
    match item:
        case Arc(to, through, center, clockwise, conjugate):
            return Arc(
                place(to),
                through and place(through),
                center and place(center),
                clockwise,
                conjugate and (factor * conjugate[0], factor * conjugate[1]),
            )
        case Bezier(points):
            return Bezier(list(map(place, points)))
        case Spline(points):
            return Spline(list(map(place, points)))
        case _:
            return place(item)
