"""Numbers p + q sqrt(n), and angles of exact directions, such as the ends of contact patches.

An angle whose (cos, sin) is (c, s) up to length, c and s integers, has the half-angle tangent

    tan(phi / 2) = s / (w + c) = (w - c) / s,    w = sqrt(n),    n = c^2 + s^2:

one square root, and no function of an angle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import total_ordering

from cfree.arguments import checked
from cfree.exact.half_angle import chart_of_direction, tau_in_chart
from cfree.exact.number import Number, angle, to_fraction
from cfree.exact.orientation import Order, compare_with_surd

SQUARES = 100  # least number whose square is not looked for in a radicand


@checked
@total_ordering
@dataclass(frozen=True, slots=True, init=False, eq=False)
class Surd:
    """The number p + q sqrt(n).

    Parameters
    ----------
    p, q : int, float, Fraction, Decimal or str
        Stored as fractions.
    n : int
        At least 0. If it is a square, the root goes into `p`; other square factors stay in `n`.

    Notes
    -----
    Equality and order are those of the numbers, not of their representations; also with rational ones and floats.

    Examples
    --------
    >>> x = Surd(Fraction(-1), Fraction(1), 2)
    >>> print(x, float(x), x.compare("0.414"))
    -1 + sqrt(2) 0.41421356237309503 Order.AFTER
    >>> Surd(0, 1, 8) == Surd(0, 2, 2), Surd(1, 2, 9)
    (True, Surd(p=Fraction(7, 1), q=Fraction(0, 1), n=0))
    >>> Surd(0, 1, 2) < Surd(3, -1, 2) < 1.6, Surd("1/4") == 0.25
    (True, True)
    """

    p: Fraction
    q: Fraction
    n: int

    def __init__(self, p: Number, q: Number = 0, n: int = 0) -> None:
        rational, factor, root = to_fraction(p), to_fraction(q), math.isqrt(n)
        if root * root == n or factor == 0:
            rational, factor, n = rational + factor * root, Fraction(0), 0
        for name, value in (("p", rational), ("q", factor), ("n", n)):
            object.__setattr__(self, name, value)

    def __str__(self) -> str:
        if self.q == 0:
            return str(self.p)
        root = f"sqrt({self.n})" if abs(self.q) == 1 else f"{abs(self.q)} sqrt({self.n})"
        before = str(self.p) if self.p else ""
        return f"{before} {'-' if self.q < 0 else '+'} {root}".removeprefix(" + ").strip()

    @classmethod
    @checked
    def root(cls, square: Number) -> Surd:
        """Return the square root of a number that is not negative.

        Examples
        --------
        >>> print(Surd.root(Fraction(9, 8)), "=", Surd.root(Fraction(9, 8)).reduced)
        1/8 sqrt(72) = 3/4 sqrt(2)
        """
        n, d = to_fraction(square).as_integer_ratio()
        return cls(0, Fraction(1, d), n * d)

    @property
    def reduced(self) -> Surd:
        """The same number, without squares of numbers below `SQUARES` in its radicand."""
        n, q = self.n, self.q
        for k in range(2, SQUARES):
            while n and n % (k * k) == 0:
                n, q = n // (k * k), q * k
        return Surd(self.p, q, n)

    def __add__(self, other: int | Fraction) -> Surd:
        return Surd(self.p + other, self.q, self.n)

    def __sub__(self, other: int | Fraction) -> Surd:
        return Surd(self.p - other, self.q, self.n)

    def __mul__(self, factor: int | Fraction) -> Surd:
        return Surd(self.p * factor, self.q * factor, self.n)

    __rmul__ = __mul__

    def __truediv__(self, divisor: int | Fraction) -> Surd:
        return Surd(self.p / divisor, self.q / divisor, self.n)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, int | float | Fraction):
            return self.q == 0 and self.p == other
        if not isinstance(other, Surd):
            return NotImplemented
        return self._key == other._key

    def __lt__(self, other: Surd | float | Fraction) -> bool:
        if isinstance(other, int | float | Fraction):
            return other > 0 if math.isinf(other) else self.compare(other) is Order.BEFORE
        if not isinstance(other, Surd):
            return NotImplemented
        if other.q == 0:
            return self.compare(other.p) is Order.BEFORE
        if self.q == 0:
            return other.compare(self.p) is Order.AFTER
        bits = 64
        while self != other:
            (a, b), (c, d) = self.neighbours(bits), other.neighbours(bits)
            if b <= c or d <= a:
                return b <= c
            bits *= 2
        return False

    def __hash__(self) -> int:
        return hash(self._key if self.q else self.p)

    def __float__(self) -> float:
        """Round to the nearest double."""
        bits = 64
        while True:
            low, high = map(float, self.neighbours(bits))
            if low == high:
                return low
            bits *= 2

    @checked
    def compare(self, x: Number) -> Order:
        """Order of this number and a rational one."""
        order = compare_with_surd(to_fraction(x), self.p, self.q, self.n)
        return {Order.BEFORE: Order.AFTER, Order.SAME: Order.SAME, Order.AFTER: Order.BEFORE}[order]

    @checked
    def neighbours(self, bits: int) -> tuple[Fraction, Fraction]:
        """Return the multiples of 2^-bits next below and above; the number itself, twice, if it is rational.

        Examples
        --------
        >>> Surd(0, 1, 2).neighbours(3), Surd("1/3").neighbours(3)
        ((Fraction(11, 8), Fraction(3, 2)), (Fraction(1, 3), Fraction(1, 3)))
        """
        if self.q == 0:
            return self.p, self.p
        d = math.lcm(self.p.denominator, self.q.denominator)
        whole, factor = int(self.p * d) << bits, int(self.q * d) << bits
        root = math.isqrt(factor * factor * self.n)
        low = (whole + root if factor > 0 else whole - root - 1) // d
        return Fraction(low, 1 << bits), Fraction(low + 1, 1 << bits)

    @property
    def floats_around(self) -> tuple[float, float]:
        """The greatest double that is not above the number, and the least that is not below.

        Examples
        --------
        >>> Surd("1/4").floats_around, Surd(0, 1, 2).floats_around
        ((0.25, 0.25), (1.414213562373095, 1.4142135623730951))
        """
        near = float(self)
        below = near if self >= near else math.nextafter(near, -math.inf)
        return below, near if self <= near else math.nextafter(near, math.inf)

    @property
    def _key(self) -> tuple[Fraction, bool, Fraction]:
        return self.p, self.q > 0, self.q * self.q * self.n


@checked
@dataclass(frozen=True, slots=True, init=False)
class ExactAngle:
    """The angle of a direction with integer coordinates.

    Parameters
    ----------
    c, s : int
        (cos, sin) times any positive number; not both 0. They are stored without common divisors, so that equal angles
        are equal.

    Examples
    --------
    >>> phi = ExactAngle(2, 2)
    >>> phi, phi.n, str(phi.tau), str(phi.cos)
    (ExactAngle(c=1, s=1), 2, '-1 + sqrt(2)', '1/2 sqrt(2)')
    >>> print(ExactAngle(-3, 4).tau, ExactAngle(-1, 0).tau)
    2 None
    """

    c: int
    s: int

    def __init__(self, c: int, s: int) -> None:
        divisor = math.gcd(c, s)
        if divisor == 0:
            raise ValueError("the direction (0, 0) has no angle; give another")
        object.__setattr__(self, "c", c // divisor)
        object.__setattr__(self, "s", s // divisor)

    @property
    def n(self) -> int:
        """c^2 + s^2."""
        return self.c * self.c + self.s * self.s

    @property
    def cos(self) -> Surd:
        """c / sqrt(n)."""
        return Surd(0, Fraction(self.c, self.n), self.n)

    @property
    def sin(self) -> Surd:
        """s / sqrt(n)."""
        return Surd(0, Fraction(self.s, self.n), self.n)

    @property
    def tau(self) -> Surd | None:
        """Half-angle tangent, None at the half turn; a root of s tau^2 + 2 c tau - s."""
        return _half_tangent(self.c, self.s)

    @property
    def theta(self) -> float:
        """Angle in radians, in (-pi, pi]."""
        return angle(self.c, self.s)

    @checked
    def neighbours(self, bits: int) -> tuple[Fraction | None, Fraction | None]:
        """Return rational half-angle tangents next to this angle, clockwise and counter-clockwise.

        Parameters
        ----------
        bits : int
            tau is a multiple of 2^-bits if it is in [-1, 1], else 1 / tau is. Each angle is at most 2^(1 - bits)
            radians away.

        Returns
        -------
        pair of Fraction or None
            Both are the angle itself if that is rational. None is the half turn.

        Examples
        --------
        >>> ExactAngle(1, 1).neighbours(4), ExactAngle(-100, 1).neighbours(4)
        ((Fraction(3, 8), Fraction(7, 16)), (Fraction(16, 1), None))
        """
        chart, (c, s) = chart_of_direction(self.c, self.s)
        local = _half_tangent(c, s)
        assert local is not None  # at most a right angle
        low, high = local.neighbours(bits)
        return tau_in_chart(chart, low), tau_in_chart(chart, high)


def _half_tangent(c: int, s: int) -> Surd | None:
    if s == 0:
        return Surd(0) if c > 0 else None
    return Surd(Fraction(-c, s), Fraction(1, s), c * c + s * s)
