"""Triangles around the sides of a shape that is bounded by lines and arcs: proofs that pieces at arcs are in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from cfree.curves.rings import Span
from cfree.exact.number import ExactPoint
from cfree.exact.vectors import cross, dot, minus

ROUNDED = 2.0**-40  # relative; more than the rounding of a coordinate


@dataclass(frozen=True, slots=True)
class HullTriangle:
    """A line, or an arc in a triangle with its chord.

    Attributes
    ----------
    corners : tuple of 2 or 3 points
        The ends first.
    beyond : tuple of 2 points, or None
        Of a concave arc: points beyond the meeting point of its tangents, the second one farther, a corner.
    """

    corners: tuple[ExactPoint, ...]
    beyond: tuple[ExactPoint, ExactPoint] | None = None


def hull_triangle(start: ExactPoint, end: ExactPoint, arc: Span | None, wider: Fraction) -> HullTriangle:
    """Return the triangle of an arc of at most a quarter circle; of a concave one larger by a share of its height.

    Examples
    --------
    >>> zero, one = Fraction(0), Fraction(1)
    >>> quarter = Span((zero, zero), (zero, one), (one, zero), 1, zero)
    >>> found = hull_triangle(quarter.at(0, Fraction(0)), quarter.end, quarter, Fraction(1, 4))
    >>> [(str(x), str(y)) for x, y in found.beyond]
    [('17/16', '17/16'), ('9/8', '9/8')]
    """
    if arc is None:
        return HullTriangle((start, end))
    tangents = meeting_of_tangents(start, end, arc.center)
    if arc.sense > 0:
        return HullTriangle((start, end, tangents))

    def beyond(by: Fraction) -> ExactPoint:
        x, y = (t + by * (t - (p + q) / 2) for t, p, q in zip(tangents, start, end, strict=True))
        return x, y

    near, far = beyond(wider / 2), beyond(wider)
    return HullTriangle((start, end, far), (near, far))


def meeting_of_tangents(start: ExactPoint, end: ExactPoint, center: ExactPoint) -> ExactPoint:
    """Return the point in which the tangents of a circle at two of its points meet."""
    first, last = minus(start, center), minus(end, center)
    square = dot(first, first)
    share = square / (square + dot(first, last))
    return center[0] + share * (first[0] + last[0]), center[1] + share * (first[1] + last[1])


def meeting(triangles: Sequence[HullTriangle]) -> set[int]:
    """Return the numbers of those that have more in common with another one than one corner of both.

    Examples
    --------
    >>> p, q, r = ((Fraction(x), Fraction(y)) for x, y in [(0, 0), (1, 0), (0, 1)])
    >>> meeting([HullTriangle((p, q)), HullTriangle((q, r))])
    set()
    >>> meeting([HullTriangle((p, q, r)), HullTriangle((p, (p[0] - 1, p[1]))), HullTriangle((q, r))])
    {0, 2}
    """
    boxes = sorted((_box(triangle.corners), k) for k, triangle in enumerate(triangles))
    found = set()
    for n, ((_, x1, y0, y1), k) in enumerate(boxes):
        for (x2, _, y2, y3), other in boxes[n + 1 :]:
            if x2 > x1:
                break
            if y2 <= y1 and y0 <= y3 and not _meet_in_a_corner(triangles[k].corners, triangles[other].corners):
                found |= {k, other}
    return found


def _box(points: Sequence[ExactPoint]) -> tuple[float, float, float, float]:
    """Return the least and greatest x, then y, rounded outwards."""
    xs, ys = [[float(p[axis]) for p in points] for axis in (0, 1)]
    slack = ROUNDED * max(map(abs, (*xs, *ys)))
    return min(xs) - slack, max(xs) + slack, min(ys) - slack, max(ys) + slack


def _meet_in_a_corner(p: Sequence[ExactPoint], q: Sequence[ExactPoint]) -> bool:
    """True if two convex sets have at most one corner in common, and are apart otherwise."""
    common = [x for x in p if x in q]
    if len(common) > 1:
        return False
    if not common:
        lines = *combinations(p, 2), *combinations(q, 2), *_across(p), *_across(q)
        return any(_is_between(p, q, line) for line in lines)
    (at,) = common
    rest, others = [minus(x, at) for x in p if x != at], [minus(x, at) for x in q if x != at]
    for along in (*rest, *others):
        sides, other_sides = [cross(along, x) for x in rest], [cross(along, x) for x in others]
        for sign in (1, -1):
            least, most = min(sign * x for x in sides), max(sign * x for x in other_sides)
            if (least >= 0 > most) or (least > 0 >= most):
                return True
    return len(rest) == len(others) == 1 and cross(rest[0], others[0]) == 0 and dot(rest[0], others[0]) < 0


def _across(points: Sequence[ExactPoint]) -> list[tuple[ExactPoint, ExactPoint]]:
    """Return lines through the ends of a segment, across it; a triangle has none."""
    if len(points) > 2:
        return []
    (x, y), (z, w) = points
    return [(at, (at[0] - (w - y), at[1] + (z - x))) for at in points]


def _is_between(p: Sequence[ExactPoint], q: Sequence[ExactPoint], line: tuple[ExactPoint, ExactPoint]) -> bool:
    along = minus(line[1], line[0])
    sides, others = [[cross(along, minus(x, line[0])) for x in points] for points in (p, q)]
    return (max(sides) < min(others)) or (max(others) < min(sides))
