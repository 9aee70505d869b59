"""Isolated parts: free curves, segments at one angle, and points that have no free pose beside them at their angles.

For a segment and a point everything is decided at their own angle, in its number field. For a curve that turns with
theta, its angles are decided, and that it has a place at all angles between them. That it is free and has no width is
checked at three rational ones.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise

from cfree.exact.algebraic import Exact, Number, Root, between, part, ratio
from cfree.forbidden.columns import CURVE, POINT, SEGMENT
from cfree.verify.section import Section
from cfree.verify.surfaces import Curve, Fault, Line, Turn, Vector, minus, point_at, position_of
from cfree.verify.trapezoids import Piece, Reader, has_root

NEAR = Fraction(1, 10**9)  # `first_t` and `last_t` are rounded


class IsolatedPart:
    """Isolated part k of a boundary, its names resolved; raises Fault."""

    def __init__(self, reader: Reader, k: int) -> None:
        p = self._columns = reader.isolated
        self.reader, self.index, self.chart = reader, k, int(p.chart[k])
        self.start = reader.angle(p, k, "from", int(p.from_patch[k]))
        self.stop = reader.angle(p, k, "to", int(p.to_patch[k]))
        if self.start > self.stop:
            raise Fault("it ends before it begins")
        self.lower, self.upper = (self._curve(side) for side in ("lower", "upper"))

    def _curve(self, side: str) -> tuple[int, Curve]:
        """A curve, and the patch on whose surface it is named."""
        code, patch = (int(getattr(self._columns, name)[self.index]) for name in (side, f"{side}_patch"))
        return patch, self.reader.curve(patch, self.chart, code)

    def end(self, turn: Turn, root: Root, curve: tuple[int, Curve]) -> tuple[Exact, Vector]:
        """t and the point, times w, of one of its curves at an angle."""
        t = curve[1].at(root.value)
        return t, turn.line(self.reader.surface(curve[0])).point(t)

    def piece(self, turn: Turn) -> Piece | None:
        """Closed piece at an angle, ends included."""
        for chart, here in turn.in_charts():
            if chart == self.chart and self.start <= here <= self.stop:
                line = turn.line(self.reader.surface(int(self._columns.patch[self.index])))
                ends: list[Exact] = [
                    position_of(line.key, self.end(turn, here, c)[1]) for c in (self.lower, self.upper)
                ]
                if None in ends:
                    raise Fault("its ends are not on the line of its patch")
                lo, hi = sorted(ends)
                return Piece(line.key, lo, hi, ("isolated part", self.index))
        return None

    def check(self) -> None:
        """Check that the part is named correctly, is free and has no width."""
        p, k = self._columns, self.index
        turns = [Turn(self.chart, root) for root in (self.start, self.stop)]
        ends = [self.end(turns[0], self.start, self.lower), self.end(turns[1], self.stop, self.upper)]
        for (t, _), column in zip(ends, (p.first_t, p.last_t), strict=True):
            if abs(_fraction(t) - Fraction(float(column[k]))) > NEAR * (1 + abs(_fraction(t))):
                raise Fault("the rounded t of an end is not that of its curve")
        if self.start < self.stop:
            kind = CURVE
            self._check_curve()
        else:
            piece = self.piece(turns[0])
            assert piece is not None
            kind = POINT if piece.lo == piece.hi else SEGMENT
            self._check_at(turns[0], piece)
        if kind != int(p.kind[k]):
            raise Fault("its angles or curves are equal, and named as if they were not")

    def _check_curve(self) -> None:
        if self.lower[1].key != self.upper[1].key:
            raise Fault("its two curves are not one")
        if any(has_root(curve.d, self.start, self.stop) for _, curve in (self.lower, self.upper)):
            raise Fault("its curve leaves the surface's line to infinity")
        part(self.start, self.stop)
        middle = between(self.start.hi, self.stop.lo)
        for tau in (between(self.start.hi, middle), middle, between(middle, self.stop.lo)):
            turn = Turn.of(self.chart, tau)
            piece = self.piece(turn)
            assert piece is not None
            self._check_at(turn, piece)

    def _check_at(self, turn: Turn, piece: Piece) -> None:
        """Check all of a point; of a segment all but finitely many points of its sides, where a free part may end."""
        surface = self.reader.surface(int(self._columns.patch[self.index]))
        patch = sorted(map(turn.line(surface).position, (0, 1)))
        if any(turn.value(limit) > 0 for limit in surface.limits) or piece.hi < patch[0] or patch[1] < piece.lo:
            raise Fault(f"the contact of its patch does not hold anywhere on it at {turn}")
        section = Section(self.reader.world, turn)
        begin, end = (point_at(piece.line, position) for position in (piece.lo, piece.hi))
        along = None
        inside = [begin]
        if begin != end:
            line, along = Line(begin, minus(end, begin)), minus(end, begin)
            if section.on_segment(line) != [(0, 1)]:
                raise Fault(f"part of it is forbidden at {turn}")
            cuts = [0, *section.touching(line), 1]
            inside = [line.point(ratio(lo + hi, 2)) for lo, hi in pairwise(cuts)]
        if not all(section.encloses(point, along) for point in inside):
            raise Fault(f"forbidden, or free to one side, at {turn}")
        for other in pieces(self.reader, turn):
            if other.owner != piece.owner and _overlap(piece, other):
                raise Fault(f"on {other.owner[0]} {other.owner[1]}")


def pieces(reader: Reader, turn: Turn) -> Iterator[Piece]:
    """Trapezoids and isolated parts at an angle."""
    yield from reader.pieces(turn)
    for isolated in resolved(reader):
        try:
            piece = isolated.piece(turn)
        except Fault:
            continue
        if piece is not None:
            yield piece


@lru_cache(maxsize=1)
def resolved(reader: Reader) -> list[IsolatedPart]:
    """All isolated parts. Faulty ones are left out, and reported where they are checked."""
    parts = []
    for k in range(len(reader.isolated)):
        with suppress(Fault, IndexError):
            parts.append(IsolatedPart(reader, k))
    return parts


def _overlap(mine: Piece, other: Piece) -> bool:
    """True if a piece has more in common with a segment than ends, or a point with anything."""
    if mine.lo == mine.hi:
        place = position_of(other.line, point_at(mine.line, mine.lo))
        return place is not None and other.lo <= place <= other.hi
    return mine.line == other.line and max(mine.lo, other.lo) < min(mine.hi, other.hi)


def _fraction(t: Exact) -> Fraction:
    return t.rounded(NEAR / 4) if isinstance(t, Number) else t
