"""A boundary file, its names resolved in the scene; one trapezoid: its angles, curves, sides, and a point.

A trapezoid is {lower(theta) <= t <= upper(theta), start <= theta <= stop} on a patch.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import fmpz_poly
from numpy.typing import NDArray

from cfree.exact.algebraic import Coefficients, Exact, Root, between, factors, part, ratio, roots
from cfree.verify.surfaces import Curve, Fault, LineKey, Moving, Surface, Turn, Vector, polynomial
from cfree.verify.world import Feature, World, name_of
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.forbidden.columns import IsolatedParts, Trapezoids
    from cfree.scene.scene import Scene

Contacts = tuple[NDArray[np.uint8], NDArray[np.int32], NDArray[np.int32]]  # kind, robot and obstacle feature by patch
NAMES = ("first", "second", "lo", "hi", "place")
ENDS = {end: [f"{end}_{name}" for name in NAMES] for end in ("from", "to")}
MOST = 1 << 17  # cached places on curves
FIRST, LAST = Root.of(Fraction(-1)), Root.of(Fraction(1))  # of a chart
Side = tuple[bytes, Exact, Exact]  # a curve, or a line at one angle; angles, or positions, of its beginning and end


@dataclass(frozen=True, slots=True)
class Piece:
    """A trapezoid, or an isolated part, at one angle: a closed segment or a point of a line."""

    line: LineKey
    lo: Exact
    hi: Exact
    owner: tuple[str, int]
    facing: bool | None = None  # inside a trapezoid: True if positions grow with t


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
        self.moving = lru_cache(maxsize=64)(self._moving)
        self.curve = lru_cache(maxsize=4096)(self._curve)
        self.roots = lru_cache(maxsize=1 << 16)(_roots_between)
        self._places: dict[tuple[Any, ...], Exact] = {}

    def _surface(self, patch: int) -> Surface:
        kind, robot, obstacle = (int(column[patch]) for column in self.contacts)
        return self.world.contact((kind, robot, obstacle))

    def _moving(self, patch: int, chart: int) -> Moving:
        return Moving(self.surface(patch), chart)

    def _curve(self, patch: int, chart: int, code: int) -> Curve:
        return Curve(self.moving(patch, chart), self.world.curve(self.surface(patch), name_of(code)))

    def place(self, moving: Moving, curve: Curve, angle: Root) -> tuple[bytes, Exact]:
        """Line of a surface at an angle, and the position of a curve on it; trapezoids around it need the same."""
        axis, line = moving.line(angle)
        key = curve.key, axis, angle
        if (place := self._places.get(key)) is None:
            if len(self._places) > MOST:
                self._places.clear()
            place = self._places[key] = curve.place(axis, angle.value)
        return line, place

    def end(self, k: int, *, is_stop: bool, is_upper: bool, is_curve: bool) -> Hashable:
        """End of a curve of trapezoid k, on that curve or on the line at one of its angles, both known to be sound."""
        t = self.table
        patch, chart = int(t.patch[k]), int(t.chart[k])
        angle = self.angle(t, k, "to" if is_stop else "from", patch)
        curve = self.curve(patch, chart, int((t.upper if is_upper else t.lower)[k]))
        return (curve.digest, angle) if is_curve else self.place(self.moving(patch, chart), curve, angle)

    def trapezoid(self, k: int) -> Trapezoid:
        """Trapezoid k, its names resolved and its angles checked. Raises Fault."""
        t = self.table
        patch, chart = int(t.patch[k]), int(t.chart[k])
        start, stop = (self.angle(t, k, end, patch) for end in ("from", "to"))
        if start >= stop:
            raise Fault("it does not end after it begins")
        lower, upper = (self.curve(patch, chart, int(code)) for code in (t.lower[k], t.upper[k]))
        return Trapezoid(self, self.moving(patch, chart), lower, upper, start, stop)

    def angle(self, columns: Trapezoids, k: int, end: str, patch: int) -> Root:
        """Critical angle as the root that its names, on the surface of a patch, and its interval define."""
        first, second, low, high, place = (getattr(columns, name)[k].item() for name in ENDS[end])
        chart, surface = int(columns.chart[k]), self.surface(patch)
        if not first:
            if low != high or abs(low) != 1 or second or place:
                raise Fault(f"its {end} angle has no name and is no end of a chart")
            return FIRST if low < 0 else LAST
        if not -2 < low <= high < 2:
            raise Fault(f"its {end} angle is beyond the chart")
        roots = self.roots(self.defining(first, second, surface, chart), low, high)
        if place > len(roots) or (len(roots) != 1) == (place == 0):
            raise Fault(f"its {end} angle: {counted(len(roots), 'root')} in the interval, place {place}")
        root: Root
        root, is_inside = roots[max(place, 1) - 1]
        if not is_inside:
            raise Fault(f"its {end} angle is beyond the chart")
        return root

    def defining(self, first: int, second: int, surface: Surface, chart: int) -> Coefficients:
        """Polynomial that names define on a surface: one pair's condition, or that two curves meet."""
        if second:
            curves = (self.world.curve(surface, name_of(code)) for code in (first, second))
            (n, d), (m, e) = (tuple(polynomial(form, chart) for form in t) for t in curves)
            defined = n * e - m * d
        else:
            defined = polynomial(self.world.angle(surface, name_of(first)), chart)
        if defined.degree() < 0:
            raise Fault("an angle is named by what holds at every angle")
        return tuple(map(int, defined.coeffs()))

    def pieces(self, turn: Turn) -> Iterator[Piece]:
        """Trapezoids, ends included, at an angle. Faulty ones are left out, and reported elsewhere."""
        t = self.table
        for chart, here in turn.in_charts():
            there = turn if chart == turn.chart else Turn(chart, here)
            reaches = (t.from_lo <= float(here.hi)) & (float(here.lo) <= t.to_hi)
            for k in np.flatnonzero((t.chart == chart) & reaches).tolist():
                try:
                    patch = int(t.patch[k])
                    order = [self._order(here, k, end) for end in ("from", "to")]
                    if order[0] < 0 or order[1] > 0:
                        continue
                    line = turn.line(self.surface(patch))
                    lo, hi = (line.position(self._at(patch, there, int(c))) for c in (t.lower[k], t.upper[k]))
                except (Fault, IndexError):
                    continue
                facing = line.ascends if order == [1, -1] else None
                yield Piece(line.key, min(lo, hi), max(lo, hi), ("trapezoid", k), facing)

    def _at(self, patch: int, turn: Turn, code: int) -> Exact:
        """Value t of a curve at an angle: the quotient of its two forms, unless the denominator vanishes there."""
        n, d = map(turn.value, self.world.curve(self.surface(patch), name_of(code)))
        return ratio(n, d) if d != 0 else self.curve(patch, turn.chart, code).at(turn.tau)

    def _order(self, here: Root, k: int, end: str) -> int:
        """Order of an angle and one end of a trapezoid: -1 before, 0 at, 1 after it."""
        t = self.table
        if here.lo > Fraction(float(getattr(t, f"{end}_hi")[k])):
            return 1
        if here.hi < Fraction(float(getattr(t, f"{end}_lo")[k])):
            return -1
        angle = self.angle(t, k, end, int(t.patch[k]))
        return (here > angle) - (here < angle)


class Trapezoid:
    """A trapezoid whose names are understood; `check` raises Fault."""

    def __init__(self, reader: Reader, moving: Moving, lower: Curve, upper: Curve, start: Root, stop: Root) -> None:
        self._place = reader.place
        self.surface, self.chart, self._moving = moving.surface, moving.chart, moving
        self.lower, self.upper, self.start, self.stop = lower, upper, start, stop
        self._gap = upper.n * lower.d - lower.n * upper.d  # of one sign where the order is the same
        first, last = float(start.lo), float(stop.hi)
        self._interval = (first + last) / 2, (last - first) / 2 + 2.0**-50  # its middle, and half of a longer one

    def turn(self) -> Turn:
        """Rational angle strictly between start and stop where the curves, which may touch, do not."""
        if self._gap.degree() < 0:
            raise Fault("its two curves are one")
        part(self.start, self.stop)
        tau = between(self.start.hi, self.stop.lo)
        while (values := (self.lower.at(tau), self.upper.at(tau))) and values[0] == values[1]:
            tau = between(self.start.hi, tau)
        self._values = values
        return Turn.of(self.chart, tau)

    def check(self, turn: Turn) -> tuple[Exact, Exact]:
        """Prove that from start to stop the contact is in its range, and 0 <= lower <= upper <= 1.

        Returns
        -------
        lower, upper
            Values at the angle of `turn`, at which their order is compared.
        """
        p, q = self.lower, self.upper
        lower, upper = self._values
        if not 0 <= lower < upper <= 1:
            raise Fault(f"0 <= lower < upper <= 1 fails at tau = {turn.tau}")
        if any(turn.value(limit) >= 0 for limit in self.surface.limits):
            raise Fault(f"outside its patch's range at tau = {turn.tau}")
        if any(map(self._changes, self._moving.limits)):
            raise Fault("it reaches beyond its patch's range")
        if any(self._vanishes(curve.d) for curve in (p, q)):
            raise Fault("a curve leaves the surface's line to infinity")
        for order in (p.n, q.d - q.n, self._gap):
            if self._changes(order):
                raise Fault("its curves cross each other, or t = 0 or t = 1")
        return lower, upper

    def _changes(self, poly: fmpz_poly) -> bool:
        """True if a polynomial's sign changes between start and stop."""
        coefficients = [int(c) for c in poly.coeffs()]
        if len(coefficients) < 2 or self._keeps_sign(coefficients):
            return False
        odd = (factor for factor, times in factors(tuple(coefficients)) if times % 2)
        return any(self._has_root_inside(factor) for factor in odd)

    def _vanishes(self, poly: fmpz_poly) -> bool:
        """True if a polynomial has a root from start to stop, ends included."""
        coefficients = [int(c) for c in poly.coeffs()]
        return len(coefficients) > 1 and not self._keeps_sign(coefficients) and has_root(poly, self.start, self.stop)

    def _has_root_inside(self, factor: Coefficients) -> bool:
        """True if an irreducible polynomial has a root strictly between start and stop."""
        if self._keeps_sign(factor):
            return False
        if len(factor) == 3:
            for root in (self.start, self.stop):
                if root.poly == factor:  # the other root is the sum of both without this one
                    other = -factor[1] / factor[2] - float(root.lo)
                    off = float(root.hi - root.lo) + 2.0**-40 * (1 + abs(other))
                    if abs(other - self._interval[0]) > self._interval[1] + off:
                        return False
        roots_around = roots(fmpz_poly(list(factor)), self.start.lo, self.stop.hi)
        return any(self.start < root < self.stop for root, _ in roots_around)

    def _keeps_sign(self, coefficients: Sequence[int]) -> bool:
        """True if it is certain in doubles that a polynomial has no root from start to stop.

        Notes
        -----
        Its value in the middle is greater than all else of its Taylor polynomial there at the ends. Coefficients are
        divided by the greatest. Then, for a degree of at most 8 and |tau| < 2, no number is greater than 2^17, and 100
        operations are off by less than 2^-29.
        """
        if len(coefficients) > 9:
            return False
        most = max(map(abs, coefficients))
        c, (middle, radius) = [k / most for k in coefficients], self._interval
        for k in range(len(c) - 1):
            for j in range(len(c) - 2, k - 1, -1):
                c[j] += middle * c[j + 1]
        rest = 0.0
        for coefficient in reversed(c[1:]):
            rest = (rest + abs(coefficient)) * radius
        return abs(c[0]) > rest + 2.0**-28

    def sides(self) -> list[Side | None]:
        """Counter-clockwise in (t, theta): at start, upper, at stop, lower; None for a side of no length."""
        return [
            self._upright(self.start, self.lower, self.upper),
            (self.upper.digest, self.start, self.stop),
            self._upright(self.stop, self.upper, self.lower),
            (self.lower.digest, self.stop, self.start),
        ]

    def place(self, curve: Curve, angle: Root) -> tuple[bytes, Exact]:
        """Line at one of its ends, and the position of a curve on it."""
        return self._place(self._moving, curve, angle)

    def _upright(self, angle: Root, first: Curve, last: Curve) -> Side | None:
        (line, begin), (_, end) = (self.place(curve, angle) for curve in (first, last))
        return None if begin == end else (line, begin, end)


def _roots_between(poly: Coefficients, low: float, high: float) -> tuple[tuple[Root, bool], ...]:
    """Roots of a polynomial, each with True if it is in the chart."""
    all_roots = roots(fmpz_poly(list(poly)), Fraction(low), Fraction(high))
    return tuple((root, FIRST <= root <= LAST) for root, _ in all_roots)


def has_root(poly: fmpz_poly, start: Root, stop: Root) -> bool:
    """True if a polynomial has a root in the closed interval."""
    return poly.degree() > 0 and any(start <= root <= stop for root, _ in roots(poly, start.lo, stop.hi))
