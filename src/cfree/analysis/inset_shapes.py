"""Robots whose edges and arcs are moved inwards: round shapes stay round where their numbers stay rational."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any, cast

from cfree.collision.arcs import Curve, curves_of
from cfree.curves.curved import Curved
from cfree.curves.rings import Arc, Circle
from cfree.errors import InvalidPolygonError
from cfree.exact.number import ExactPoint
from cfree.exact.vectors import cross, dot, minus, unit
from cfree.polygons.offset import inset
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import AnyShape, polygons_for


def inset_shapes(shapes: Sequence[AnyShape], by: Fraction, error: float, *, outward: bool) -> list[AnyShape]:
    """Return shapes with edges and arcs moved inwards; nothing is left of those that are too thin.

    Discs, grown polygons, and rings whose arcs are joined smoothly or have rational corners stay round. Other round
    shapes are replaced by polygons around them, or inside, first. At concave arcs the inset of a polygon around may be
    a little smaller than that of the shape.

    Examples
    --------
    >>> [disc] = inset_shapes([Curved.circle((0, 0), 2)], Fraction(1, 2), 0.1, outward=True)
    >>> float(disc.path.radius), inset_shapes([disc], Fraction(2), 0.1, outward=True)
    (1.5, [])
    >>> stadium = Curved([(0, 0), (4, 0), Arc((4, 2), center=(4, 1)), (0, 2), Arc((0, 0), center=(0, 1))])
    >>> [smaller] = inset_shapes([stadium], Fraction(1, 4), 0.1, outward=True)
    >>> [float(b) for b in smaller.box]
    [-0.75, 0.25, 4.75, 1.75]
    """
    return [part for shape in shapes for part in _inset(shape, by, error, outward)]


def _inset(shape: AnyShape, by: Fraction, error: float, outward: bool) -> Sequence[AnyShape]:
    if isinstance(shape, Polygon):
        return inset(shape, by)
    if isinstance(shape.path, Circle) and not shape.holes and by >= shape.path.radius:
        return []
    if shape.grown and by >= shape.grown:
        core, left = shape._base(), by - shape.grown
        return inset(core, left) if left else [core]
    exact = exact_inset(shape, by)
    if exact is not None:
        return [exact]
    return [part for polygon in polygons_for(shape, error, outward) for part in inset(polygon, by)]


def exact_inset(shape: AnyShape, by: Fraction) -> AnyShape | None:
    """Return a polygon, or a shape of lines and arcs, with all of these moved inwards, exactly.

    None if a number is irrational, a piece vanishes, or parts would overlap; of a grown shape, if it would vanish.

    Examples
    --------
    >>> exact_inset(Polygon([(0, 0), (4, 0), (0, 3)]), Fraction(1, 2)).exact_vertices[1]
    (Fraction(5, 2), Fraction(1, 2))
    >>> exact_inset(Polygon([(0, 0), (4, 0), (0, 4)]), Fraction(1, 2)) is None
    True
    """
    if isinstance(shape, Curved) and isinstance(shape.path, Circle) and not shape.holes:
        center, radius = shape.path.center, shape.path.radius
        return Curved.circle(center, radius - by) if by < radius else None
    if isinstance(shape, Curved) and shape.grown:
        return Curved(shape.path, shape.holes, grown=shape.grown - by) if by < shape.grown else None
    curves = curves_of(shape)
    rings = [_moved(ring, by, is_hole=k > 0) for k, ring in enumerate(curves[1])] if curves else [None]
    outer, *holes = cast(list[Any], rings)
    if not outer or not all(holes):
        return None
    try:
        return type(shape)(outer, holes)
    except InvalidPolygonError:  # parts of it would overlap
        return None


def _moved(ring: Sequence[Curve], by: Fraction, *, is_hole: bool) -> list[ExactPoint | Arc] | None:
    """Return a ring moved to the shape's inside; None if it has other numbers than rationals, or pieces vanish."""
    if (double_area(ring) > 0) == is_hole:
        ring = [(end, start, center, -turn) for start, end, center, turn in reversed(ring)]
    joints = [_joint(one, other, by) for one, other in zip([ring[-1], *ring[:-1]], ring, strict=True)]
    path = list[ExactPoint | Arc]()
    for (start, end, center, turn), (p, q) in zip(ring, pairwise([*joints, joints[0]]), strict=True):
        if p is None or q is None:
            return None
        inner, outer = (minus(p, center), minus(start, center)) if turn else (minus(q, p), minus(end, start))
        if dot(inner, outer) <= 0:
            return None
        path += [] if path else [p]
        path.append(Arc(q, center=center, clockwise=turn < 0) if turn else q)
    return path


def _joint(one: Curve, other: Curve, by: Fraction) -> ExactPoint | None:
    """Return the place to which the joint of two pieces moves, if it is rational."""
    p = other[0]
    n, m = _normal(one, one[1]), _normal(other, p)
    if n is None or m is None:
        return None
    if n == m:
        return p[0] + by * n[0], p[1] + by * n[1]
    if one[3] or other[3] or not cross(n, m):
        return None
    share = by / (1 + dot(n, m))
    return p[0] + share * (n[0] + m[0]), p[1] + share * (n[1] + m[1])


def _normal(piece: Curve, at: ExactPoint) -> ExactPoint | None:
    """Return the unit vector to the left of a piece, if it is rational."""
    direction = unit(_along(piece, at))
    return direction and (-direction[1], direction[0])


def _along(piece: Curve, at: ExactPoint) -> ExactPoint:
    """Return a tangent of a piece, in its direction."""
    start, end, center, turn = piece
    x, y = minus(at, center)
    return (-turn * y, turn * x) if turn else minus(end, start)


def double_area(ring: Sequence[Curve]) -> float:
    """Return about twice the signed area inside a ring."""
    area = 0.0
    for start, end, center, turn in ring:
        area += float(cross(start, end))
        if turn:
            u, v = minus(start, center), minus(end, center)
            sweep = math.atan2(turn * float(cross(u, v)), float(dot(u, v))) % math.tau
            area += turn * float(dot(u, u)) * (sweep - math.sin(sweep))
    return area
