"""Exact fits among rounded shapes: free at one place each, and without room beside it at that angle."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from fractions import Fraction

from flint import arb

from cfree.forbidden.boundary import Boundary
from cfree.forbidden.columns import CURVE, SEGMENT
from cfree.verify.result import Finding
from cfree.verify.round_algebra import Turn
from cfree.verify.round_pieces import Reader
from cfree.verify.round_surfaces import Fault, UndecidedError, middle
from cfree.verify.round_world import Place

BESIDE = Fraction(1, 1 << 22)  # of the size: its square is far above what places may be off
WAYS = 16  # directions around a place
ALONG = 0.1  # sine of the angle with a segment below which a direction is along it
Covers = Callable[[Place, Turn, arb], bool]


class IsolatedParts:
    """The isolated parts of a boundary, in balls.

    Parameters
    ----------
    stored : Boundary
    reader : Reader
    covers : function
        True if something covers a place at an orientation by more than a distance.
    size : float
        The scene's.
    """

    def __init__(self, stored: Boundary, reader: Reader, covers: Covers, size: float) -> None:
        self._stored, self._reader, self._covers, self._size = stored, reader, covers, size
        self.checked = 0

    def findings(self, name: str) -> Iterator[Finding]:
        """Findings about all parts; those whose place is a limit of curves are not checked."""
        for k in range(len(self._stored.isolated)):
            try:
                fault = self._fault(k)
            except UndecidedError:
                continue
            except (Fault, IndexError) as error:
                fault = str(error) or "it names a feature that does not exist"
            self.checked += 1
            if fault:
                yield Finding(name, f"isolated part {k}", fault)

    def _fault(self, k: int) -> str:
        parts = self._stored.isolated
        start, stop = (self._angle(k, end) for end in ("from", "to"))
        kind, chart = int(parts.kind[k]), int(parts.chart[k])
        if start > stop or (kind == CURVE) != (start < stop):
            return "its angles are not in order"
        turn = self._reader.scale.turn(chart, (start + stop) // 2)
        ends = (a, b), (c, d) = self._point(k, "lower", turn), self._point(k, "upper", turn)
        place = (a + c) / 2, (b + d) / 2
        if kind == SEGMENT:
            place = middle(self._reader.surface(*self._contact(int(parts.patch[k]))[0]), *ends, turn)
        if not all(x.is_finite() and x.rad() < self._reader.scale.near for x in place):
            raise UndecidedError("the limit of a curve")
        if self._covers(place, turn, self._reader.scale.near):
            return "forbidden"
        along = complex(float((c - a).mid()), float((d - b).mid())) if kind == SEGMENT else 0j
        if kind == SEGMENT and not abs(along):
            return "a segment without length"
        by = float(BESIDE) * self._size
        for way in range(WAYS):
            step = cmath.rect(by, 0.1 + math.tau * way / WAYS)
            if kind == SEGMENT and abs((step.conjugate() * along).imag) < ALONG * by * abs(along):
                continue
            if not self._covers((place[0] + step.real, place[1] + step.imag), turn, self._reader.scale.near):
                return "there is room beside it"
        return ""

    def _contact(self, patch: int) -> tuple[tuple[int, int, int], int]:
        """Contact of a patch, and its quadrant."""
        stored = self._stored
        if not 0 <= patch < len(stored.contact_kind):
            raise IndexError
        kind = int(stored.contact_kind[patch])
        return (kind & 15, int(stored.contact_robot[patch]), int(stored.contact_obstacle[patch])), kind >> 4

    def _angle(self, k: int, end: str) -> int:
        parts = self._stored.isolated
        contact, _ = self._contact(int(getattr(parts, f"{end}_patch")[k]))
        names = [getattr(parts, f"{end}_{name}")[k].item() for name in ("first", "second", "lo", "hi", "place")]
        return int(self._reader.angle(contact, int(parts.chart[k]), *names))

    def _point(self, k: int, side: str, turn: Turn) -> Place:
        parts = self._stored.isolated
        contact, quadrant = self._contact(int(getattr(parts, f"{side}_patch")[k]))
        surface = self._reader.surface(*contact)
        return self._reader.curve(surface, quadrant, int(getattr(parts, side)[k])).point(turn)
