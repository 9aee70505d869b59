"""Search for missing contacts: all free ones at one angle, computed from scratch, are compared with the file's.

The remainder of the closed contacts outside open pillars must equal the trapezoids, ends included, and isolated parts
at that angle. Both are compared as sets of points: segments on one line are united, and a point may lie on any of them.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from decimal import Decimal
from fractions import Fraction
from itertools import pairwise

from cfree.exact.algebraic import Number
from cfree.verify.heights import Interval, left_over
from cfree.verify.isolated import pieces
from cfree.verify.surfaces import LineKey, Turn, Vector, point_at, position_of
from cfree.verify.trapezoids import Reader
from cfree.verify.world import World

Wrong = list[tuple[str, str]]  # where, what


class Places:
    """A set of points that consists of segments and points of lines."""

    def __init__(self, parts: Iterable[tuple[LineKey, Interval]]) -> None:
        on: dict[LineKey, list[Interval]] = defaultdict(list)
        self.points: set[Vector] = set()
        for key, (lo, hi) in parts:
            if lo < hi:
                on[key].append((lo, hi))
            else:
                self.points.add(point_at(key, lo))
        self.segments = {key: united(intervals) for key, intervals in on.items()}
        self._ends = {point_at(key, x) for key, them in self.segments.items() for interval in them for x in interval}

    def has(self, point: Vector) -> bool:
        if point in self._ends or point in self.points:
            return True
        positions = ((position_of(key, point), intervals) for key, intervals in self.segments.items())
        return any(x is not None and any(lo <= x <= hi for lo, hi in intervals) for x, intervals in positions)


def united(intervals: Iterable[Interval]) -> list[Interval]:
    result: list[Interval] = []
    for lo, hi in sorted(intervals):
        if result and lo <= result[-1][1]:
            result[-1] = result[-1][0], max(hi, result[-1][1])
        else:
            result.append((lo, hi))
    return result


def compared(reader: Reader, turn: Turn) -> tuple[int, Wrong]:
    """Compare scene and file at one angle: the number of segments and points, and the places where the two differ."""
    listed = list(pieces(reader, turn))
    true, stored = free_contacts(reader.world, turn), Places((piece.line, (piece.lo, piece.hi)) for piece in listed)
    wrong = []
    for line in true.segments.keys() | stored.segments.keys():
        ours, theirs = true.segments.get(line, []), stored.segments.get(line, [])
        if ours != theirs:
            text = "on this line other contacts are free" if ours else "a contact of the file is not free"
            wrong.append((point_at(line, (ours or theirs)[0][0]), text))
    wrong += [(point, "a free point is not in the file") for point in true.points if not stored.has(point)]
    wrong += [(point, "a point of the file is not free") for point in stored.points if not true.has(point)]
    sheets: dict[tuple[LineKey, bool], list[Interval]] = defaultdict(list)
    for piece in listed:
        if piece.facing is not None:
            sheets[piece.line, piece.facing].append((piece.lo, piece.hi))
    for (line, _), intervals in sheets.items():
        if any(p[1] > q[0] for p, q in pairwise(sorted(intervals))):
            wrong.append((point_at(line, min(intervals)[0]), "trapezoids on one another"))
    number = sum(map(len, true.segments.values())) + len(true.points)
    return number, sorted((place(reader.world, turn, point), text) for point, text in wrong)


def free_contacts(world: World, turn: Turn) -> Places:
    """Parts of all contacts that open pillars leave, their ends included."""

    def left() -> Iterator[tuple[LineKey, Interval]]:
        for surface, intervals in left_over(world, turn):
            line = turn.line(surface)
            for interval in intervals:
                lo, hi = sorted(map(line.position, interval))
                yield line.key, (lo, hi)

    return Places(left())


def place(world: World, turn: Turn, point: Vector) -> str:
    """Text of a place in the scene's coordinates, rounded; they may be beyond doubles."""
    x, y, w = (n.rounded(Fraction(1, 10**9)) if isinstance(n, Number) else Fraction(n) for n in (*point, turn.w))
    true = (c / w / world.scale for c in (x, y))
    shown = (f"{Decimal(c.numerator) / Decimal(c.denominator):.6g}" for c in true)
    return f"{turn}, near ({', '.join(shown)})"
