"""Sign decisions, all in this one Python file: exact integers or fractions in, a named answer out.

A point or a direction is a pair of exact numbers. There is no tolerance here, and no float.
"""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum
from fractions import Fraction

from cfree.exact.number import ExactPoint

Exact = int | Fraction
Vector = tuple[Exact, Exact]


class Orientation(Enum):
    """Side of a direction on which something lies."""

    LEFT = "left"
    COLLINEAR = "collinear"
    RIGHT = "right"


class Order(Enum):
    """Order of the first of two things relative to the second."""

    BEFORE = "before"
    SAME = "same"
    AFTER = "after"


class Location(Enum):
    """Location relative to a region."""

    INSIDE = "inside"
    BOUNDARY = "boundary"
    OUTSIDE = "outside"


class Meeting(Enum):
    """Intersection of two segments: none, one point inside both, one end point, or a length."""

    APART = "apart"
    CROSS = "cross"
    TOUCH = "touch"
    OVERLAP = "overlap"


# indexed by a sign: 0, 1, -1
_ORIENTATION = (Orientation.COLLINEAR, Orientation.LEFT, Orientation.RIGHT)


def turn(u: Vector, v: Vector) -> Orientation:
    """Side of direction v, seen along direction u.

    Examples
    --------
    >>> turn((1, 0), (0, 1))
    <Orientation.LEFT: 'left'>
    """
    d = u[0] * v[1] - u[1] * v[0]
    return _ORIENTATION[(d > 0) - (d < 0)]


def orient(p: Vector, q: Vector, r: Vector) -> Orientation:
    """Side of point r, seen from p towards q.

    Examples
    --------
    >>> orient((0, 0), (1, 0), (5, 0))
    <Orientation.COLLINEAR: 'collinear'>
    """
    d = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    return _ORIENTATION[(d > 0) - (d < 0)]


def is_opposed(u: Vector, v: Vector) -> bool:
    """True if two directions make more than a right angle.

    Examples
    --------
    >>> is_opposed((1, 0), (-1, 5))
    True
    """
    return u[0] * v[0] + u[1] * v[1] < 0


def compare_directions(u: Vector, v: Vector) -> Order:
    """Order of two directions by their angle in [0, 2 pi).

    Examples
    --------
    >>> compare_directions((0, -1), (1, 0))
    <Order.AFTER: 'after'>
    """
    upper_u, upper_v = is_upper(u), is_upper(v)
    if upper_u != upper_v:
        return Order.BEFORE if upper_u else Order.AFTER
    side = turn(u, v)
    if side is Orientation.COLLINEAR:
        return Order.SAME
    return Order.BEFORE if side is Orientation.LEFT else Order.AFTER


def compare_lengths(u: Vector, v: Vector) -> Order:
    """Order of two vectors by length.

    Examples
    --------
    >>> compare_lengths((3, 4), (0, 5))
    <Order.SAME: 'same'>
    """
    d = u[0] * u[0] + u[1] * u[1] - v[0] * v[0] - v[1] * v[1]
    return Order.SAME if d == 0 else Order.BEFORE if d < 0 else Order.AFTER


def compare_with_surd(x: Exact, p: Exact, q: Exact, n: int) -> Order:
    """Order of a number and p + q sqrt(n), n >= 0.

    Examples
    --------
    >>> compare_with_surd(Fraction(17, 12), 0, 1, 2), compare_with_surd(3, 1, 1, 4)
    (<Order.AFTER: 'after'>, <Order.SAME: 'same'>)
    """
    # the sign of r - s where r = x - p and s = q sqrt(n), from those of r, s and r^2 - s^2
    r, s = x - p, q * q * n if q >= 0 else -q * q * n
    d = (r * r if r >= 0 else -r * r) - s
    return Order.SAME if d == 0 else Order.BEFORE if d < 0 else Order.AFTER


def is_upper(u: Vector) -> bool:
    """True if the angle of a direction is in [0, pi).

    Examples
    --------
    >>> is_upper((1, 0)), is_upper((-1, 0))
    (True, False)
    """
    return u[1] > 0 or (u[1] == 0 and u[0] > 0)


def locate_in_sector(d: Vector, start: Vector, end: Vector) -> Location:
    """Location of a direction in the sector swept counter-clockwise from `start` to `end`.

    Two equal directions bound the whole turn, slit along them.

    Examples
    --------
    >>> locate_in_sector((1, 1), (1, 0), (0, 1)), locate_in_sector((1, 1), (0, 1), (1, 0))
    (<Location.INSIDE: 'inside'>, <Location.OUTSIDE: 'outside'>)
    """
    after_start, before_end, whole = turn(start, d), turn(d, end), turn(start, end)
    if (after_start is Orientation.COLLINEAR and not is_opposed(start, d)) or (
        before_end is Orientation.COLLINEAR and not is_opposed(end, d)
    ):
        return Location.BOUNDARY
    follows, precedes = after_start is Orientation.LEFT, before_end is Orientation.LEFT
    if whole is Orientation.LEFT:
        inside = follows and precedes
    elif whole is Orientation.RIGHT:
        inside = follows or precedes
    else:
        inside = follows or not is_opposed(start, end)
    return Location.INSIDE if inside else Location.OUTSIDE


def meet(p: Vector, q: Vector, r: Vector, s: Vector) -> Meeting:
    """Intersection of the segments pq and rs, of positive length.

    Examples
    --------
    >>> meet((0, 0), (2, 2), (0, 2), (2, 0)), meet((0, 0), (1, 0), (1, 0), (1, 1))
    (<Meeting.CROSS: 'cross'>, <Meeting.TOUCH: 'touch'>)
    """
    r_side, s_side = orient(p, q, r), orient(p, q, s)
    if r_side is s_side:
        if r_side is not Orientation.COLLINEAR:
            return Meeting.APART
        first, last = max(min(p, q), min(r, s)), min(max(p, q), max(r, s))
        if first == last:
            return Meeting.TOUCH
        return Meeting.OVERLAP if first < last else Meeting.APART
    p_side, q_side = orient(r, s, p), orient(r, s, q)
    if p_side is q_side:
        return Meeting.APART
    ends = (p_side, q_side, r_side, s_side)
    return Meeting.TOUCH if Orientation.COLLINEAR in ends else Meeting.CROSS


def is_inside_segment(point: Vector, p: Vector, q: Vector) -> bool:
    """True if a point lies on the segment pq, and not at an end.

    Examples
    --------
    >>> is_inside_segment((1, 1), (0, 0), (3, 3)), is_inside_segment((3, 3), (0, 0), (3, 3))
    (True, False)
    """
    return min(p, q) < point < max(p, q) and orient(p, q, point) is Orientation.COLLINEAR


def crossing_point(p: Vector, q: Vector, r: Vector, s: Vector) -> ExactPoint:
    """Point common to two lines that are not parallel, one through p and q, one through r and s.

    Examples
    --------
    >>> crossing_point((0, 0), (1, 1), (0, 1), (1, 0))
    (Fraction(1, 2), Fraction(1, 2))
    """
    ux, uy, vx, vy = q[0] - p[0], q[1] - p[1], s[0] - r[0], s[1] - r[1]
    along = Fraction((r[0] - p[0]) * vy - (r[1] - p[1]) * vx, ux * vy - uy * vx)
    return p[0] + along * ux, p[1] + along * uy


def locate(point: Vector, edges: Iterable[tuple[Vector, Vector]]) -> Location:
    """Location of a point in the region bounded by closed rings.

    Parameters
    ----------
    point : pair of exact numbers
    edges : iterable of (start, end)
        All edges of all rings, in any order.

    Examples
    --------
    >>> triangle = [((0, 0), (4, 0)), ((4, 0), (0, 4)), ((0, 4), (0, 0))]
    >>> locate((1, 1), triangle), locate((2, 2), triangle)
    (<Location.INSIDE: 'inside'>, <Location.BOUNDARY: 'boundary'>)
    """
    inside = False
    for start, end in edges:
        low, high = (start, end) if start[1] <= end[1] else (end, start)
        if low[1] <= point[1] <= high[1]:
            side = orient(low, high, point)
            # the ray towards +x owns the lower end of an edge, so a vertex counts once
            if side is Orientation.COLLINEAR:
                if min(low[0], high[0]) <= point[0] <= max(low[0], high[0]):
                    return Location.BOUNDARY
            elif side is Orientation.LEFT and point[1] < high[1]:
                inside = not inside
    return Location.INSIDE if inside else Location.OUTSIDE
