"""Polygons in the interior of others, decided by signs of integers."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import chain, pairwise

import numpy as np

from cfree.polygons.polygon import Polygon
from cfree.verify.polygons import Ring, boxes, corners, is_convex, near
from cfree.verify.surfaces import Vector, cross, dot, minus


def strictly_inside(inner: Polygon, outer: Polygon) -> bool:
    """True if all of a polygon, its boundary included, is in the interior of another.

    Notes
    -----
    This is so exactly if no edge of one meets an edge of the other, every ring of the one begins inside the other, and
    no ring of the other begins inside the one. Such a ring would be a hole.

    Examples
    --------
    >>> ring = Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(4, 4), (5, 4), (5, 5), (4, 5)]])
    >>> small = [(1, 1), (8, 1), (8, 8), (1, 8)]
    >>> strictly_inside(Polygon(small), ring), strictly_inside(Polygon(small, [[(3, 3), (6, 3), (6, 6), (3, 6)]]), ring)
    (False, True)
    """
    one, other = (_rings(p, inner.denominator * outer.denominator // p.denominator) for p in (inner, outer))
    edges = [list(chain.from_iterable(map(_edges, rings))) for rings in (one, other)]
    unit = max(abs(c) for ring in one + other for p in ring for c in p)
    around = boxes(edges[1], unit)
    for edge, box in zip(edges[0], boxes(edges[0], unit), strict=True):
        if any(_meet(edge, edges[1][k]) for k in near(around, np.asarray(box))):
            return False
    return all(encloses(other, ring[0]) for ring in one) and not any(encloses(one, ring[0]) for ring in other)


def is_near(polygon: Polygon, core: Polygon, distance: Fraction) -> bool:
    """True if one polygon is convex, and all of another is nearer to it than a distance.

    Notes
    -----
    This is so exactly if its vertices are: the points nearer to a convex set form a convex set.

    Examples
    --------
    >>> core, triangle = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), Polygon([(-3, -4), (1, 0), (0, 1)])
    >>> is_near(triangle, core, Fraction(5)), is_near(triangle, core, Fraction("5.01"))
    (False, True)
    """
    unit = math.lcm(polygon.denominator, core.denominator)
    (ring, *_), others = (_rings(p, unit // p.denominator) for p in (polygon, core))
    edges, square = _edges(others[0]), (distance * unit) ** 2
    return (
        len(others) == 1
        and all(map(is_convex, corners(others[0])))
        and all(
            all(_side(p, q, point) >= 0 for p, q in edges) or any(_square(point, p, q) < square for p, q in edges)
            for point in ring
        )
    )


def _square(point: Vector, a: Vector, b: Vector) -> Fraction:
    """Squared distance of a point from a segment."""
    u, v = minus(point, a), minus(b, a)
    share = min(max(Fraction(int(dot(u, v)), int(dot(v, v))), Fraction(0)), Fraction(1))
    return sum(((p - share * q) ** 2 for p, q in zip(u, v, strict=True)), Fraction(0))


def _rings(polygon: Polygon, factor: int) -> list[Ring]:
    points = [(x * factor, y * factor) for x, y in polygon.numerators]
    return [points[i:j] for i, j in pairwise(polygon.ring_offsets)]


def _edges(ring: Ring) -> list[Ring]:
    return [[p, q] for p, q in zip(ring, ring[1:] + ring[:1], strict=True)]


def _meet(first: Ring, second: Ring) -> bool:
    """True if two closed segments have a point in common."""
    (a, b), (c, d) = first, second
    sides = [_side(a, b, c), _side(a, b, d), _side(c, d, a), _side(c, d, b)]
    if sides[0] * sides[1] < 0 and sides[2] * sides[3] < 0:
        return True
    triples = ((a, b, c), (a, b, d), (c, d, a), (c, d, b))
    return any(side == 0 and dot(minus(p, r), minus(q, r)) <= 0 for side, (p, q, r) in zip(sides, triples, strict=True))


def _side(p: Vector, q: Vector, r: Vector) -> int:
    area = cross(minus(q, p), minus(r, p))
    return bool(area > 0) - bool(area < 0)


def encloses(rings: list[Ring], point: Vector) -> bool:
    """True if a point on none of the rings is inside an odd number of them. Counts crossings of a ray towards -x."""
    crossings = 0
    for ring in rings:
        for p, q in _edges(ring):
            if (p[1] > point[1]) != (q[1] > point[1]):
                crossings += (_side(p, q, point) < 0) == (q[1] > p[1])
    return crossings % 2 == 1
