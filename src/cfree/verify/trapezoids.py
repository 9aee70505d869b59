"""One trapezoid: its angles, its curves, a point of it, and its oriented sides.

A trapezoid is {lower(theta) <= t <= upper(theta), start <= theta <= stop} on a patch. Oriented like (t, theta), it is
bounded by: start, from lower to upper; upper, from start to stop; stop, from upper to lower; lower, from stop to start.
A segment of a curve, or of a line at one angle, enters a sum as its end minus its beginning: segments of one curve
cancel if and only if their ends do. So a side is two signed ends, and a surface is closed if every end has the sum 0.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from hashlib import blake2b
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import fmpq_poly, fmpz_poly
from numpy.typing import NDArray

from cfree.verify.algebra import Root, between, compare, roots
from cfree.verify.surfaces import Curve, Fault, Surface, Turn, polynomial
from cfree.verify.world import World, name_of

if TYPE_CHECKING:
    from cfree.scene import Scene
    from cfree.trapezoids import Trapezoids

End = tuple[bytes, int]  # a point of a curve, or of a line at one angle, and its sign
Contacts = tuple[NDArray[np.uint8], NDArray[np.int32], NDArray[np.int32]]  # kind, robot and obstacle feature by patch


class Reader:
    """The trapezoids of a boundary with their names resolved in the scene."""

    def __init__(self, scene: Scene, contacts: Contacts, table: Trapezoids) -> None:
        self.world, self.contacts, self.table = World(scene), contacts, table
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
        try:
            return self._trapezoid(k)
        except IndexError:
            raise Fault("it names a feature that the scene does not have") from None

    def _trapezoid(self, k: int) -> Trapezoid:
        t = self.table
        patch, chart = int(t.patch[k]), int(t.chart[k])
        surface = self.surface(patch)
        start, stop = (self.angle(k, end, surface, chart) for end in ("from", "to"))
        if compare(start, stop) >= 0:
            raise Fault("it does not end after it begins")
        lower, upper = (self.curve(patch, chart, int(code)) for code in (t.lower[k], t.upper[k]))
        return Trapezoid(surface, chart, lower, upper, start, stop)

    def angle(self, k: int, end: str, surface: Surface, chart: int) -> Root:
        """One of a trapezoid's critical angles, as the root that its names and interval define."""
        names = ("first", "second", "lo", "hi", "place")
        first, second, low, high, place = (getattr(self.table, f"{end}_{name}")[k].item() for name in names)
        lo, hi = Fraction(low), Fraction(high)
        if not first:
            if lo != hi or abs(lo) != 1 or second or place:
                raise Fault(f"its {end} angle has no name and is no chart wall")
            return Root((int(-lo), 1), 0, lo, hi)
        found = [root for root, _ in roots(self.defining(first, second, surface, chart), lo, hi)]
        if place > len(found) or (len(found) != 1) == (place == 0):
            raise Fault(f"its {end} angle: {len(found)} roots in the interval, place {place}")
        root: Root = found[max(place, 1) - 1]
        if compare(root, wall(-1)) < 0 or compare(root, wall(1)) > 0:
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


def wall(side: int) -> Root:
    return Root((-side, 1), 0, Fraction(side), Fraction(side))


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
        while self.start.hi >= self.stop.lo:
            self.start.narrow()
            self.stop.narrow()
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
        if any(self._inside(curve.d, closed=True) for curve in (p, q)):
            raise Fault("a curve leaves the surface's line to infinity")
        for order in (p.n, q.d - q.n, self._gap):
            if self._changes(order):
                raise Fault("its curves cross each other, or t = 0 or t = 1")

    def _changes(self, poly: fmpz_poly) -> bool:
        return any(multiplicity % 2 for multiplicity in self._inside(poly))

    def _inside(self, poly: fmpz_poly, closed: bool = False) -> list[int]:
        """Multiplicities of the roots between start and stop."""
        if poly.degree() < 1:
            return []
        return [
            multiplicity
            for root, multiplicity in roots(poly, self.start.lo, self.stop.hi)
            if compare(self.start, root) < closed and compare(root, self.stop) < closed
        ]

    def sample(self, world: World, turn: Turn) -> None:
        """A point of it, strictly between its curves, that nothing covers. Proved there, and only there."""
        t = between(self.lower.at(turn.tau), self.upper.at(turn.tau))
        (x, y), (u, v), n, d = turn.start(self.surface), turn.along(self.surface), t.numerator, t.denominator
        if world.is_forbidden(turn, ((d * x + n * u, d * y + n * v), d * turn.w)):
            raise Fault(f"forbidden at tau = {turn.tau}, t = {t}")

    def ends(self) -> Iterator[End]:
        """The ends of its sides."""
        for curve, outwards in ((self.lower, -1), (self.upper, 1)):
            for angle, forwards in ((self.start, -1), (self.stop, 1)):
                yield digest(curve.key, angle_key(self.chart, angle)), outwards * forwards
        for angle, forwards in ((self.start, 1), (self.stop, -1)):
            points = [point(curve, angle) for curve in (self.lower, self.upper)]
            if points[0] != points[1]:
                line = self._line(angle, points[0])
                for at, upwards in zip(points, (-1, 1), strict=True):
                    yield digest(angle_key(self.chart, angle), line, at), forwards * upwards

    def _line(self, angle: Root, at: tuple[Any, Any]) -> tuple[Any, Any]:
        """The line of the surface at an angle, through a point of it: its slope and where it meets an axis."""
        s, m = self.surface, angle.field
        u, v = (
            fmpq_poly(polynomial(form, self.chart)) % m
            for form in ((s.q[0], -s.g[0], s.g[1]), (s.q[1], -s.g[1], -s.g[0]))
        )
        if u.degree() < 0:
            return None, at[0]
        slope = v * inverse(u, m) % m
        return slope, (at[1] - slope * at[0]) % m


def point(curve: Curve, angle: Root) -> tuple[Any, Any]:
    """Where a curve is at an angle, as two elements of the field of that angle."""
    m = angle.field
    z = fmpq_poly(curve.z) % m
    if z.degree() < 0:
        raise Fault("a curve leaves the surface's line to infinity")
    by = inverse(z, m)
    return fmpq_poly(curve.x) * by % m, fmpq_poly(curve.y) * by % m


def inverse(x: fmpq_poly, modulus: fmpq_poly) -> fmpq_poly:
    one, factor, _ = x.xgcd(modulus)
    assert one.degree() == 0  # the modulus is irreducible; the divisor is monic
    return factor


def angle_key(chart: int, angle: Root) -> tuple[Any, ...]:
    """Equal for equal angles; the charts share their ends."""
    poly, index = angle.key
    if poly in ((-1, 1), (1, 1)):
        return ("wall", chart == (poly == (1, 1)))
    return chart, poly, index


def digest(*key: Any) -> bytes:
    """32 bytes that stand for an exact key: different keys do not collide in practice, and travel cheaply."""

    def plain(x: Any) -> Any:
        if isinstance(x, fmpq_poly):
            return str(x.numer().coeffs()), str(x.denom())
        return tuple(map(plain, x)) if isinstance(x, tuple) else x

    return blake2b(repr(plain(key)).encode(), digest_size=32).digest()
