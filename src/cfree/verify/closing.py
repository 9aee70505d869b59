"""Ends of the sides of many pieces, mod 2: equal names cancel first, the others are compared exactly.

A name tells why two things are equal, so it needs no arithmetic. A *line* at an angle has the points b - R a of some
vertices a of the robot and b of the obstacles, and all together are its name: any two of them determine it. A place on
it is one of them, or where another line crosses it. A curve is a place on the line of a contact at all angles.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import fmpz_poly

from cfree.exact.algebraic import sign
from cfree.verify.columns import Angles, Columns, Span
from cfree.verify.polygons import primitive
from cfree.verify.surfaces import Vector, cross, minus
from cfree.verify.world import EDGE_VERTEX, HELIX, PARALLEL, VERTEX_EDGE, name_of

if TYPE_CHECKING:
    from cfree.verify.trapezoids import Trapezoid

Points = tuple[frozenset[int], frozenset[int]]  # vertices of the robot, and of the obstacles
Edge = tuple[Vector, Vector]


def odd_ends(columns: Columns, trapezoid: Callable[[int], Trapezoid]) -> int:
    """Number of places on curves and lines where an odd number of sides end: 0 if the surface is closed mod 2.

    Notes
    -----
    A sum mod 2 of segments of one line vanishes if its boundary does.
    """
    odd: set[Any] = set()
    for k in np.flatnonzero(~columns.named).tolist():
        for line, *both in filter(None, trapezoid(k).sides()):
            for end in both:
                odd ^= {(line, end)}
    for k, is_stop, is_upper, is_curve in _unnamed(columns):
        odd ^= {columns.reader.end(k, is_stop=is_stop, is_upper=is_upper, is_curve=is_curve)}
    return len(odd)


def _unnamed(columns: Columns) -> list[tuple[int, bool, bool, bool]]:
    """Ends of sides that no equal name cancels: piece, if at its stop, if of its upper curve, and if along that."""
    names, t = Names(columns), columns.table
    left: dict[Any, tuple[int, bool, bool, bool]] = {}
    contact, chart, codes = columns.contact.tolist(), t.chart.tolist(), (t.lower.tolist(), t.upper.tolist())
    angles, numbers = columns.angles, numbered(columns.angles)
    pairs = [
        (one, other) if meet else (0, 0) if other else (one, 0)
        for one, other, meet in zip(angles.first.tolist(), angles.second.tolist(), angles.meet.tolist(), strict=True)
    ]
    ends = columns.start.tolist(), columns.stop.tolist()
    once: dict[tuple[int, int, int], tuple[int, bool, bool]] = {}  # ends of one curve of a contact at one angle cancel
    for k in np.flatnonzero(columns.named).tolist():
        for is_upper in (False, True):
            for is_stop in (False, True):
                same = contact[k], codes[is_upper][k], ends[is_stop][k]
                if once.pop(same, None) is None:
                    once[same] = k, is_stop, is_upper
    for (its, code, end), (k, is_stop, is_upper) in once.items():
        number = numbers[end]
        line, place = (chart[k], names.curve(its, code), number), (names.place(its, code, *pairs[end]), number)
        for name, is_curve in ((line, True), (place, False)):
            if left.pop(name, None) is None:
                left[name] = k, is_stop, is_upper, is_curve
    return list(left.values())


def numbered(angles: Angles) -> list[int]:
    """Numbers of angles: equal numbers are of equal angles.

    Notes
    -----
    Each is a polynomial's only root in its interval. A polynomial that is monotone on an interval around two of them
    has one root there at most. So they are equal if both are of one polynomial, or of two with a common divisor that
    changes its sign there.
    """
    chart, lo, hi, rows, ends = angles.chart, angles.lo, angles.hi, angles.rows, angles.ends
    known: dict[Any, int] = {}
    keys = zip(chart.tolist(), rows.tolist(), strict=True)
    poly = np.array([known.setdefault((c, *row), len(known)) for c, row in keys], np.int64)
    order = np.lexsort((lo, poly))
    one, other = order[:-1], order[1:]
    span = Span(lo[one], np.maximum(hi[one], hi[other]))
    number = np.empty(len(poly), np.int64)
    parted = (poly[one] != poly[other]) | (span.signs(rows[one], 1) == 0)
    number[order] = np.append(0, np.cumsum(parted))[: len(poly)]
    order = np.lexsort((lo, chart))
    one, other = order[:-1], order[1:]
    near = (chart[one] == chart[other]) & (lo[other] <= hi[one]) & (poly[one] != poly[other])
    one, other = one[near], other[near]
    span = Span(lo[one], np.maximum(hi[one], hi[other]))
    monotone = (span.signs(rows[one], 1) != 0) & (span.signs(rows[other], 1) != 0)
    divisors: dict[Any, fmpz_poly] = {}
    for i, j in zip(one[monotone].tolist(), other[monotone].tolist(), strict=True):
        if number[i] == number[j]:
            continue
        both = poly[i], poly[j]
        if both not in divisors:
            divisors[both] = fmpz_poly(rows[i].tolist()).gcd(fmpz_poly(rows[j].tolist()))
        if divisors[both].degree() > 0:
            common = [int(c) for c in divisors[both].coeffs()]
            if sign(common, Fraction(lo[i])) * sign(common, Fraction(max(hi[i], hi[j]))) < 0:
                number[number == number[j]] = number[i]
    result: list[int] = np.where(ends != 0, -1 - (chart == (ends < 0)), number).tolist()  # the charts share their ends
    return result


class Names:
    """Names of lines, curves and places on the contacts of pieces."""

    def __init__(self, columns: Columns) -> None:
        self.world = columns.reader.world
        self._shapes = self.world.robot, self.world.obstacles
        self._numbers: tuple[dict[Vector, int], dict[Vector, int]] = {}, {}
        self._lines: tuple[dict[Any, set[int]], dict[Any, set[int]]] = defaultdict(set), defaultdict(set)
        self._names: dict[Any, int] = {}
        self.points = lru_cache(maxsize=None)(self._points)
        self.crossing = lru_cache(maxsize=None)(self._crossing)
        self.curve = lru_cache(maxsize=None)(self._curve)
        self.place = lru_cache(maxsize=None)(self._place)
        self.line = lru_cache(maxsize=None)(self._line)
        self._edge = lru_cache(maxsize=None)(self._edge_of)
        self._around = lru_cache(maxsize=None)(self._edges_around)
        edges: list[set[Edge]] = [set(), set()]
        for kind, *both in map(name_of, columns.names):
            for which, k in enumerate(both):
                edges[which].update([self._edge(which, k)] if kind == 2 - which else self._around(which, k))
        for which, its in enumerate(edges):
            for edge in its:
                self._lines[which][line_of(edge)].update(self._number(which, point) for point in edge)

    def _number(self, which: int, point: Vector) -> int:
        return self._numbers[which].setdefault(point, len(self._numbers[which]))

    def _edge_of(self, which: int, k: int) -> Edge:
        return self.world.edge(self._shapes[which], k)

    def _edges_around(self, which: int, k: int) -> list[Edge]:
        """Edges that begin or end at a vertex of the robot, or of the obstacles."""
        shape = self._shapes[which]
        if not self.world.is_own(shape, k):
            return []
        p = shape.vertices[k]
        return [(shape.vertices[int(shape.previous[k])], p), (p, shape.vertices[int(shape.w[k])])]

    def _along(self, which: int, edge: Edge) -> frozenset[int]:
        """Vertices of the robot, or of the obstacles, that are on one line with an edge."""
        return frozenset(self._lines[which][line_of(edge)])

    def _points(self, code: int) -> Points:
        """Points that are on the line of a surface, or on a helix, at every angle."""
        kind, *both = name_of(code)
        a, b = (
            self._along(which, self._edge(which, k))
            if kind == 2 - which
            else frozenset([self._number(which, self.world.vertex(self._shapes[which], k))])
            for which, k in enumerate(both)
        )
        return a, b

    def _name(self, what: Any) -> int:
        return self._names.setdefault(what, len(self._names))

    def _curve(self, contact: int, code: int) -> int:
        """Name of a curve on a contact."""
        one, other = self.points(contact), self.points(code)
        return self._name(other if is_helix(code) else common(one, other) or frozenset((one, other)))

    def _line(self, contact: int, angle: int) -> Points:
        """Name of a contact's line at an angle, which is named by one pair, or by none."""
        if angle >> 61 == PARALLEL:
            return self.crossing(contact, angle)
        if not is_helix(angle):
            return self.points(contact)
        a, b = self.points(contact)  # the vertices of the pair are on it, too
        c, d = self.points(angle)
        return (a, b | d) if c <= a else (a | c, b) if d <= b else (a, b)

    def _crossing(self, code: int, angle: int) -> Points:
        """Name of the line of a surface at an angle of parallel edges: with those that are parallel to it there."""
        points, (kind, *ends), (_, *edges) = self.points(code), name_of(code), name_of(angle)
        if kind not in (VERTEX_EDGE, EDGE_VERTEX):
            return points
        still, free = (1, 0) if kind == VERTEX_EDGE else (0, 1)  # the shape of its edge, and that of its vertex
        if not parallel(self._edge(still, ends[still]), self._edge(still, edges[still])):
            return points
        others = [edge for edge in self._around(free, ends[free]) if parallel(edge, self._edge(free, edges[free]))]
        along = points[free].union(*(self._along(free, edge) for edge in others))
        return (along, points[1]) if free == 0 else (points[0], along)

    def _place(self, contact: int, code: int, first: int, second: int) -> int:
        """Name of a line at an angle and the place of a curve on it, if no curve named here has a pole."""
        if second:  # both of these are there
            code, first = min(first, second) if code in (first, second) else code, 0
        line = self.line(contact, first)
        other = self.crossing(code, first) if first >> 61 == PARALLEL else self.points(code)
        if is_helix(first) and common(self.points(first), other):
            return self._name((line, self.points(first)))
        return self._name((line, common(line, other) or other))


def is_helix(code: int) -> bool:
    return code >> 61 == HELIX


def line_of(edge: Edge) -> Any:
    """Key, equal for edges on one line; an edge without length is on none but its own."""
    p, q = edge
    if p == q:
        return p
    u = primitive(minus(q, p))
    return u, cross(u, p)


def parallel(one: Edge, other: Edge) -> bool:
    return bool(cross(minus(*one), minus(*other)) == 0)


def common(one: Points, other: Points) -> Points | None:
    """A point that two names have in common."""
    a, b = one[0] & other[0], one[1] & other[1]
    return (frozenset((min(a),)), frozenset((min(b),))) if a and b else None
