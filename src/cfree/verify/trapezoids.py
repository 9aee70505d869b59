"""What a boundary file says, its names resolved in the scene; one trapezoid: its angles, curves, sides, and a point.

A trapezoid is {lower(theta) <= t <= upper(theta), start <= theta <= stop} on a patch.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from hashlib import blake2b
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import fmpz_poly
from numpy.typing import NDArray

from cfree.exact.algebraic import Exact, Root, between, part, roots
from cfree.verify.section import Section
from cfree.verify.surfaces import Curve, Fault, LineKey, Surface, Turn, Vector, polynomial
from cfree.verify.world import Feature, World, name_of
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.forbidden.columns import IsolatedParts, Trapezoids
    from cfree.scene.scene import Scene

Contacts = tuple[NDArray[np.uint8], NDArray[np.int32], NDArray[np.int32]]  # kind, robot and obstacle feature by patch
Side = tuple[bytes, Exact, Exact]  # a curve, or a line at one angle; angles, or positions, where a side begins and ends


@dataclass(frozen=True, slots=True)
class Piece:
    """A trapezoid, or an isolated part, at one angle: a closed segment or a point of a line."""

    line: LineKey
    lo: Exact
    hi: Exact
    owner: tuple[str, int]
    facing: bool | None = None  # inside a trapezoid: whether positions grow with t


class Reader:
    """The columns of a boundary."""

    def __init__(
        self,
        scene: Scene,
        contacts: Contacts,
        table: Trapezoids,
        isolated: IsolatedParts,
        auxiliary: Mapping[Feature, Sequence[Vector]] | None = None,
    ) -> None:
        self.world, self.contacts, self.table, self.isolated = World(scene, auxiliary), contacts, table, isolated
        self.surface = lru_cache(maxsize=64)(self._surface)
        self.curve = lru_cache(maxsize=4096)(self._curve)

    def _surface(self, patch: int) -> Surface:
        kind, robot, obstacle = (int(column[patch]) for column in self.contacts)
        return self.world.contact((kind, robot, obstacle))

    def _curve(self, patch: int, chart: int, code: int) -> Curve:
        surface = self.surface(patch)
        return Curve(surface, chart, self.world.curve(surface, name_of(code)))

    def trapezoid(self, k: int) -> Trapezoid:
        """Trapezoid k, its names resolved and its angles checked. Raises Fault."""
        t = self.table
        patch, chart = int(t.patch[k]), int(t.chart[k])
        surface = self.surface(patch)
        start, stop = (self.angle(t, k, end, patch) for end in ("from", "to"))
        if start >= stop:
            raise Fault("it does not end after it begins")
        lower, upper = (self.curve(patch, chart, int(code)) for code in (t.lower[k], t.upper[k]))
        return Trapezoid(surface, chart, lower, upper, start, stop)

    def angle(self, columns: Trapezoids, k: int, end: str, patch: int) -> Root:
        """A critical angle as the root that its names, on the surface of a patch, and its interval define."""
        names = ("first", "second", "lo", "hi", "place")
        first, second, low, high, place = (getattr(columns, f"{end}_{name}")[k].item() for name in names)
        chart, surface = int(columns.chart[k]), self.surface(patch)
        lo, hi = Fraction(low), Fraction(high)
        if not first:
            if lo != hi or abs(lo) != 1 or second or place:
                raise Fault(f"its {end} angle has no name and is no end of a chart")
            return Root.of(lo)
        if not -2 < lo <= hi < 2:
            raise Fault(f"its {end} angle is beyond the chart")
        found = [root for root, _ in roots(self.defining(first, second, surface, chart), lo, hi)]
        if place > len(found) or (len(found) != 1) == (place == 0):
            raise Fault(f"its {end} angle: {counted(len(found), 'root')} in the interval, place {place}")
        root: Root = found[max(place, 1) - 1]
        if not Root.of(Fraction(-1)) <= root <= Root.of(Fraction(1)):
            raise Fault(f"its {end} angle is beyond the chart")
        return root

    def defining(self, first: int, second: int, surface: Surface, chart: int) -> fmpz_poly:
        """The polynomial that names define on a surface: one pair's condition, or that two curves meet."""
        if second:
            curves = (self.world.curve(surface, name_of(code)) for code in (first, second))
            (n, d), (m, e) = (tuple(polynomial(form, chart) for form in t) for t in curves)
            found = n * e - m * d
        else:
            found = polynomial(self.world.angle(surface, name_of(first)), chart)
        if found.degree() < 0:
            raise Fault("an angle is named by what holds at every angle")
        return found

    def pieces(self, turn: Turn) -> Iterator[Piece]:
        """Trapezoids, ends included, at an angle. What is faulty is left out, and reported elsewhere."""
        t = self.table
        for chart, here in turn.in_charts():
            reaches = (t.from_lo <= float(here.hi)) & (float(here.lo) <= t.to_hi)
            for k in np.flatnonzero((t.chart == chart) & reaches).tolist():
                try:
                    patch = int(t.patch[k])
                    order = [self._order(here, k, end) for end in ("from", "to")]
                    if order[0] < 0 or order[1] > 0:
                        continue
                    line = turn.line(self.surface(patch))
                    curves = (self.curve(patch, chart, int(code)) for code in (t.lower[k], t.upper[k]))
                    lo, hi = (line.position(curve.at(here.value)) for curve in curves)
                except (Fault, IndexError):
                    continue
                facing = line.ascends if order == [1, -1] else None
                yield Piece(line.key, min(lo, hi), max(lo, hi), ("trapezoid", k), facing)

    def _order(self, here: Root, k: int, end: str) -> int:
        """Is an angle before, at or after one end of a trapezoid?"""
        t = self.table
        if here.lo > Fraction(float(getattr(t, f"{end}_hi")[k])):
            return 1
        if here.hi < Fraction(float(getattr(t, f"{end}_lo")[k])):
            return -1
        angle = self.angle(t, k, end, int(t.patch[k]))
        return (here > angle) - (here < angle)


class Trapezoid:
    """A trapezoid whose names are understood; `check` and `sample` raise Fault."""

    def __init__(self, surface: Surface, chart: int, lower: Curve, upper: Curve, start: Root, stop: Root) -> None:
        self.surface, self.chart, self.lower, self.upper = surface, chart, lower, upper
        self.start, self.stop = start, stop
        self._gap = upper.n * lower.d - lower.n * upper.d  # of one sign where the order is the same

    def turn(self) -> Turn:
        """A rational angle strictly between start and stop where the curves, which may touch, do not."""
        if self._gap.degree() < 0:
            raise Fault("its two curves are one")
        part(self.start, self.stop)
        tau = between(self.start.hi, self.stop.lo)
        while self.lower.at(tau) == self.upper.at(tau):
            tau = between(self.start.hi, tau)
        return Turn.of(self.chart, tau)

    def check(self, turn: Turn) -> None:
        """From start to stop: in the contact's range, 0 <= lower <= upper <= 1. Proved, with the order at one angle."""
        p, q = self.lower, self.upper
        if not 0 <= p.at(turn.tau) < q.at(turn.tau) <= 1:
            raise Fault(f"0 <= lower < upper <= 1 fails at tau = {turn.tau}")
        if any(turn.value(limit) >= 0 for limit in self.surface.limits):
            raise Fault(f"outside its patch's range at tau = {turn.tau}")
        if any(self._changes(polynomial(limit, self.chart)) for limit in self.surface.limits):
            raise Fault("it reaches beyond its patch's range")
        if any(has_root(curve.d, self.start, self.stop) for curve in (p, q)):
            raise Fault("a curve leaves the surface's line to infinity")
        for order in (p.n, q.d - q.n, self._gap):
            if self._changes(order):
                raise Fault("its curves cross each other, or t = 0 or t = 1")

    def _changes(self, poly: fmpz_poly) -> bool:
        """Does a polynomial's sign change between start and stop?"""
        if poly.degree() < 1:
            return False
        found = roots(poly, self.start.lo, self.stop.hi)
        return any(times % 2 and self.start < root < self.stop for root, times in found)

    def sample(self, world: World, turn: Turn) -> None:
        """Nothing covers any of it at an angle. Proved there, and only there."""
        lower, upper = self.lower.at(turn.tau), self.upper.at(turn.tau)
        if not any(lo <= lower and upper <= hi for lo, hi in Section(world, turn).on_contact(self.surface)):
            raise Fault(f"forbidden at tau = {turn.tau}, somewhere from t = {lower} to {upper}")

    def sides(self) -> list[Side | None]:
        """Counter-clockwise in (t, theta): at start, upper, at stop, lower; None for a side of no length."""
        return [
            self._upright(self.start, self.lower, self.upper),
            (digest(self.upper.key), self.start, self.stop),
            self._upright(self.stop, self.upper, self.lower),
            (digest(self.lower.key), self.stop, self.start),
        ]

    def _upright(self, angle: Root, first: Curve, last: Curve) -> Side | None:
        turn = Turn(self.chart, angle)
        begin, end = first.at(turn.tau), last.at(turn.tau)
        if begin == end:
            return None
        line = turn.line(self.surface)
        return digest(turn.key, line.key), line.position(begin), line.position(end)


def has_root(poly: fmpz_poly, start: Root, stop: Root) -> bool:
    """In the closed interval."""
    return poly.degree() > 0 and any(start <= root <= stop for root, _ in roots(poly, start.lo, stop.hi))


def digest(*key: Any) -> bytes:
    """32 bytes that stand for an exact key: different keys do not collide in practice."""
    return blake2b(repr(key).encode(), digest_size=32).digest()
