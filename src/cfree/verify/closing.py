"""Ends of the sides of many pieces, mod 2: equal names cancel first, the others are compared exactly.

A name tells why two things are equal, so it needs no arithmetic. A *line* at an angle has the points b - R a of some
vertices a of the robot and b of the obstacles, and all together are its name: any two of them determine it. A place on
it is one of them, or where another line crosses it. A curve is a place on the line of a contact at all angles.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from cfree.verify.columns import Columns, Ints, Span
from cfree.verify.surfaces import Vector, cross, minus
from cfree.verify.world import EDGE_VERTEX, HELIX, PARALLEL, VERTEX_EDGE, is_own, name_of

if TYPE_CHECKING:
    from cfree.verify.trapezoids import Trapezoid
    from cfree.verify.world import World

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
        piece = trapezoid(k)
        curve, angle = piece.upper if is_upper else piece.lower, piece.stop if is_stop else piece.start
        odd ^= {(curve.digest, angle) if is_curve else piece.place(curve, angle)}
    return len(odd)


def _unnamed(columns: Columns) -> list[tuple[int, bool, bool, bool]]:
    """Ends of sides that no equal name cancels: piece, if at its stop, if of its upper curve, and if along that."""
    names, t = Names(columns.reader.world), columns.table
    left: dict[Any, tuple[int, bool, bool, bool]] = {}

    def toggle(name: Any, end: tuple[int, bool, bool, bool]) -> None:
        if name in left:
            del left[name]
        else:
            left[name] = end

    pieces = np.flatnonzero(columns.named).tolist()
    contact, chart, codes = columns.contact.tolist(), t.chart.tolist(), (t.lower.tolist(), t.upper.tolist())
    for is_stop, (angles, numbers) in enumerate(zip((columns.start, columns.stop), numbered(columns), strict=True)):
        first, second, number, meet = (
            column.tolist() for column in (angles.first, angles.second, numbers, angles.meet)
        )
        for k in pieces:
            pair = (first[k], second[k]) if meet[k] else (0, 0) if second[k] else (first[k], 0)
            line = names.line(contact[k], pair[0] if not pair[1] else 0)
            for is_upper in (0, 1):
                code = codes[is_upper][k]
                toggle((chart[k], names.curve(contact[k], code), number[k]), (k, bool(is_stop), bool(is_upper), True))
                place = names.place(line, code, *pair)
                toggle((line, place, number[k]), (k, bool(is_stop), bool(is_upper), False))
    return list(left.values())


def numbered(columns: Columns) -> list[Ints]:
    """Numbers of the angles of both ends: equal numbers are of equal angles.

    Notes
    -----
    Each has a polynomial's only root in its interval. One polynomial that is monotone on an interval around two of them
    has one root there.
    """
    both = columns.start, columns.stop
    chart = np.tile(columns.table.chart, 2)
    lo, hi, ends = (np.concatenate([getattr(angles, name) for angles in both]) for name in ("lo", "hi", "ends"))
    rows = np.concatenate([angles.rows for angles in both])
    known: dict[Any, int] = {}
    keys = zip(chart.tolist(), rows.tolist(), strict=True)
    poly = np.array([known.setdefault((c, *row), len(known)) for c, row in keys], np.int64)
    order = np.lexsort((lo, poly))
    one, other = order[:-1], order[1:]
    same = (poly[one] == poly[other]) & (Span(lo[one], np.maximum(hi[one], hi[other])).signs(rows[one], 1) != 0)
    number = np.empty(len(poly), np.int64)
    number[order] = np.cumsum(np.append(True, ~same)[: len(poly)])
    number = np.where(ends != 0, -1 - (chart == (ends < 0)), number)  # the charts share their ends
    return [number[: len(number) // 2], number[len(number) // 2 :]]


class Names:
    """Names of lines, curves and places in a world."""

    def __init__(self, world: World) -> None:
        self.world = world
        self._numbers: tuple[dict[Vector, int], dict[Vector, int]] = {}, {}
        self.points = lru_cache(maxsize=None)(self._points)
        self.crossing = lru_cache(maxsize=None)(self._crossing)
        self.curve = lru_cache(maxsize=None)(self._curve)

    def _points(self, code: int) -> Points:
        """Points that are on the line of a surface, or on a helix, at every angle."""
        kind, i, j = name_of(code)
        world, (robot, obstacles) = self.world, self._numbers
        a = world.edge(world.robot, i) if kind == EDGE_VERTEX else (world.vertex(world.robot, i),)
        b = world.edge(world.obstacles, j) if kind == VERTEX_EDGE else (world.vertex(world.obstacles, j),)
        return frozenset(robot.setdefault(p, len(robot)) for p in a), frozenset(
            obstacles.setdefault(p, len(obstacles)) for p in b
        )

    def _curve(self, contact: int, code: int) -> Any:
        """Name of a curve."""
        one, other = self.points(contact), self.points(code)
        return common(one, other) or frozenset((one, other))

    def line(self, contact: int, angle: int) -> Points:
        """Name of a contact's line at an angle, which is named by one pair, or by none."""
        if not is_helix(angle):
            return self.crossing(contact, angle)
        a, b = self.points(contact)  # the vertices of the pair are on it, too
        c, d = self.points(angle)
        return (a, b | d) if c <= a else (a | c, b) if d <= b else (a, b)

    def _crossing(self, code: int, angle: int) -> Points:
        """Name of the line of a surface at an angle: with the other ends of edges that are parallel to it there."""
        (a, b), (kind, i, j), (of, e, f) = self.points(code), name_of(code), name_of(angle)
        robot, obstacles = (partial(self.world.edge, shape) for shape in (self.world.robot, self.world.obstacles))
        if of == PARALLEL and kind == VERTEX_EDGE and parallel(obstacles(j), obstacles(f)):
            return a.union(*self._along(0, i, robot(e))), b
        if of == PARALLEL and kind == EDGE_VERTEX and parallel(robot(i), robot(e)):
            return a, b.union(*self._along(1, j, obstacles(f)))
        return a, b

    def _along(self, which: int, k: int, edge: Edge) -> Iterator[set[int]]:
        """Yield the neighbours of a vertex of the robot, or of the obstacles, along a parallel edge."""
        shape, numbers = (self.world.robot, self.world.obstacles)[which], self._numbers[which]
        for neighbour in (int(shape.previous[k]), int(shape.w[k])) if is_own(shape, k) else ():
            other = shape.vertices[neighbour]
            if parallel((shape.vertices[k], other), edge):
                yield {numbers.setdefault(other, len(numbers))}

    def place(self, line: Points, code: int, first: int, second: int) -> Points:
        """Name of the place of a curve on a contact's line at an angle, where no curve named has a pole."""
        if second:  # both of them are there
            code, first = min(first, second) if code in (first, second) else code, 0
        if is_helix(first) and common(self.points(first), self.points(code)):
            return self.points(first)
        other = self.crossing(code, first)
        return common(line, other) or other


def is_helix(code: int) -> bool:
    return name_of(code)[0] == HELIX


def parallel(one: Edge, other: Edge) -> bool:
    return bool(cross(minus(*one), minus(*other)) == 0)


def common(one: Points, other: Points) -> Points | None:
    """A point that two names have in common."""
    a, b = one[0] & other[0], one[1] & other[1]
    return (frozenset((min(a),)), frozenset((min(b),))) if a and b else None
