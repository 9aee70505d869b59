"""Exact real algebraic numbers: roots of integer polynomials, and polynomial expressions in one root.

A root is identified by its irreducible polynomial and its index among that polynomial's roots. Equal numbers thus have
equal keys, for any isolating interval. Python-flint factors, divides and reduces; signs are decided with Python's
integers.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import cached_property, lru_cache, total_ordering
from itertools import pairwise
from math import floor, inf, log2, nextafter
from typing import Any

from cfree.libraries import flint

Coefficients = tuple[int, ...]  # constant term first
Exact = Any  # int, Fraction or Number
SHORT = 2.0**-40
LEAST = Fraction(-2)  # roots are counted from this number; charts are [-1, 1]


@total_ordering
class Root:
    """An irreducible polynomial's only root in [lo, hi], which is within [-2, 2]; `narrow` halves the interval.

    Examples
    --------
    >>> (negative, _), (positive, _) = roots(flint.fmpz_poly([-2, 0, 1]), Fraction(-2), Fraction(2))
    >>> negative < positive, positive.key
    (True, ((-2, 0, 1), 1))
    """

    def __init__(self, poly: Coefficients, index: int, lo: Fraction, hi: Fraction) -> None:
        self.poly, self.lo, self.hi = poly, lo, hi
        self.key = poly, index
        self._hash = hash(self.key)

    def __reduce__(self) -> tuple[Any, ...]:  # the libraries' numbers do not pickle
        return Root, (*self.key, self.lo, self.hi)

    @classmethod
    def of(cls, x: Fraction) -> Root:
        return cls((-x.numerator, x.denominator), 0, x, x)

    @cached_property
    def value(self) -> Exact:
        """The number, for arithmetic."""
        return self.lo if len(self.poly) == 2 else Number(self, flint.fmpq_poly([0, 1]))

    @cached_property
    def modulus(self) -> flint.fmpq_poly:
        return flint.fmpq_poly(list(self.poly))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Root) and self.key == other.key

    def __hash__(self) -> int:
        return self._hash

    def __lt__(self, other: Root) -> bool:
        if self.key == other.key:
            return False
        part(self, other)
        return self.hi < other.lo

    @cached_property
    def _sign_below(self) -> int:
        """Sign of the polynomial at `lo`, which narrowing keeps."""
        return sign(self.poly, self.lo)

    def narrow(self) -> None:
        if self.lo is self.hi:  # the root is rational
            return
        (a, b), (c, d) = self.lo.as_integer_ratio(), self.hi.as_integer_ratio()
        if a * d < c * b:  # else it is, too
            middle = Fraction(a * d + c * b, 2 * b * d)
            if sign(self.poly, middle) == self._sign_below:
                self.lo = middle
            else:
                self.hi = middle


def part(x: Root, y: Root) -> None:
    """Narrow the intervals of two different numbers until they are disjoint."""
    while _at_most(x.lo, y.hi) and _at_most(y.lo, x.hi):
        x.narrow()
        y.narrow()


def _at_most(x: Fraction, y: Fraction) -> bool:
    """True if x <= y, in a fourth of that operator's time."""
    (a, b), (c, d) = x.as_integer_ratio(), y.as_integer_ratio()
    return a * d <= c * b


@total_ordering
class Number:
    """A number given as a reduced polynomial in an irrational root, with arithmetic and order.

    Examples
    --------
    >>> ((root, _),) = roots(flint.fmpz_poly([-1, 0, 2]), Fraction(0), Fraction(1))
    >>> x = root.value
    >>> x * x * 2 == 1, 1 / x == 2 * x, 7 < 10 * x < 8
    (True, True, True)
    """

    __slots__ = ("_bounds", "_hash", "poly", "root")

    def __init__(self, root: Root, poly: flint.fmpq_poly) -> None:
        self.root, self.poly = root, poly
        self._bounds: tuple[float, float] | None = None
        self._hash: int | None = None

    def __repr__(self) -> str:
        return str(self.poly)

    @property
    def key(self) -> tuple[int, ...]:
        """Numbers of one root are equal if their keys are: the denominator and the coefficients."""
        return int(self.poly.denom()), *map(int, self.poly.numer().coeffs())

    def __hash__(self) -> int:
        if self._hash is None:
            self._hash = hash(self.key)
        return self._hash

    def __add__(self, other: Number | Fraction | int) -> Number:
        return Number(self.root, self.poly + _poly(other))

    def __sub__(self, other: Number | Fraction | int) -> Number:
        return Number(self.root, self.poly - _poly(other))

    def __rsub__(self, other: Fraction | int) -> Number:
        return Number(self.root, _poly(other) - self.poly)

    def __neg__(self) -> Number:
        return Number(self.root, -self.poly)

    def __mul__(self, other: Number | Fraction | int) -> Number:
        return Number(self.root, self.poly * _poly(other) % self.root.modulus)

    def __truediv__(self, other: Number | Fraction | int) -> Number:
        if not isinstance(other, Number):
            return Number(self.root, self.poly / _poly(other))
        _, inverse, _ = other.poly.xgcd(self.root.modulus)  # the modulus is irreducible: their divisor is 1
        return Number(self.root, self.poly * inverse % self.root.modulus)

    def __rtruediv__(self, other: Fraction | int) -> Number:
        return Number(self.root, flint.fmpq_poly([_poly(other)])) / self

    __radd__, __rmul__ = __add__, __mul__

    def __eq__(self, other: object) -> bool:
        return bool(self.poly == _poly(other))

    def __lt__(self, other: Number | Fraction | int) -> bool:
        (lo, hi), (a, b) = _bounds_of(self), _bounds_of(other)
        if hi < a or lo > b:
            return hi < a
        difference = Number(self.root, self.poly - _poly(other))
        value, error, _ = difference._enclosed()
        while abs(value) <= error and difference.poly:
            self.root.narrow()
            value, error, _ = difference._enclosed()
        return value < 0

    def rounded(self, error: Fraction) -> Fraction:
        """Return a rational number that differs by at most `error`."""
        value, by, unit = self._enclosed()
        while by > error * unit:
            self.root.narrow()
            value, by, unit = self._enclosed()
        return Fraction(value, unit)

    def _enclosed(self) -> tuple[int, int, int]:
        """Value at the lower end of the root's interval, its greatest error, and the denominator of both."""
        coefficients, denominator = [int(c) for c in self.poly.numer().coeffs()], int(self.poly.denom())
        root = self.root
        value, power = homogeneous(coefficients, root.lo)
        width = root.hi - root.lo
        # (hi - lo) times the derivative, |x| <= 2
        steepest = sum(k * abs(c) << k - 1 for k, c in enumerate(coefficients) if k)
        return value * width.denominator, width.numerator * steepest * power, power * denominator * width.denominator


def _poly(other: Any) -> Any:
    if type(other) is Number:
        return other.poly
    return flint.fmpq(other.numerator, other.denominator) if type(other) is Fraction else other


def _bounds_of(x: Exact) -> tuple[float, float]:
    """Doubles below and above a number; those of a `Number` are kept."""
    try:
        if type(x) is not Number:
            value = x.numerator / x.denominator
            return nextafter(value, -inf), nextafter(value, inf)
        if x._bounds is None:
            middle, by, unit = x._enclosed()
            x._bounds = nextafter((middle - by) / unit, -inf), nextafter((middle + by) / unit, inf)
        return x._bounds
    except OverflowError:
        return -inf, inf


def ratio(x: Exact, y: Exact) -> Exact:
    return x / y if isinstance(x, Number) or isinstance(y, Number) else Fraction(x) / y


def near(x: Exact, bits: int) -> Fraction:
    """Return the number if it is rational, else a rational at most 2^-bits away."""
    return x.rounded(Fraction(1, 1 << bits)) if isinstance(x, Number) else Fraction(x)


def rounded(x: Exact) -> float:
    """Round to a double, within 0.51 units of its last place."""
    bits = 64
    while x != 0 and (abs(value := near(x, bits)).numerator << bits - 60) < value.denominator:
        bits *= 2
    return float(near(x, bits))


def at(poly: flint.fmpz_poly, x: Exact) -> Exact:
    """Value of a polynomial."""
    if isinstance(x, Number):
        return Number(x.root, flint.fmpq_poly(poly) % x.root.modulus)
    return Fraction(*homogeneous([int(c) for c in poly.coeffs()], x))


def homogeneous(poly: Sequence[int], x: Fraction) -> tuple[int, int]:
    """Numerator and positive denominator of a polynomial's value."""
    n, d = x.numerator, x.denominator
    value, power = 0, 1
    for k, coefficient in enumerate(reversed(poly)):
        if k:
            power *= d
        value = value * n + coefficient * power
    return value, power


def sign(poly: Sequence[int], x: Fraction) -> int:
    """Sign of a polynomial at a rational."""
    value, _ = homogeneous(poly, x)
    return (value > 0) - (value < 0)


@lru_cache(maxsize=1 << 14)
def factors(poly: Coefficients) -> tuple[tuple[Coefficients, int], ...]:
    """Irreducible factors that are not constant, and their multiplicities."""
    _, powers = flint.fmpz_poly(list(poly)).factor()
    return tuple((tuple(map(int, f.coeffs())), int(k)) for f, k in powers)


@lru_cache(maxsize=1 << 14)
def sturm_chain(poly: Coefficients) -> tuple[Coefficients, ...]:
    """Sturm's chain of a polynomial without multiple roots."""
    chain = [flint.fmpq_poly(list(poly)), flint.fmpq_poly(list(poly)).derivative()]
    while chain[-1].degree() > 0:
        chain.append(-(chain[-2] % chain[-1]))
    return tuple(tuple(map(int, p.numer().coeffs())) for p in chain)  # denominators are positive


def variations(poly: Coefficients, x: Fraction) -> int:
    signs = [s for s in (sign(p, x) for p in sturm_chain(poly)) if s]
    return sum(a != b for a, b in pairwise(signs))


def roots(poly: flint.fmpz_poly, lo: Fraction, hi: Fraction) -> list[tuple[Root, int]]:
    """Roots in a closed interval within (-2, 2), each once, in order, with their multiplicities."""
    result: list[tuple[Root, int]] = []
    for factor, multiplicity in factors(tuple(map(int, poly.coeffs()))):
        if len(factor) == 2:
            x = Fraction(-factor[0], factor[1])
            if lo <= x <= hi:
                result.append((Root.of(x), multiplicity))
        else:  # no rational roots: no end of an interval is a root
            result += [(root, multiplicity) for root in _isolated(factor, lo, hi)]
    return sorted(result, key=lambda item: item[0])


def _isolated(poly: Coefficients, lo: Fraction, hi: Fraction) -> Iterable[Root]:
    if len(poly) == 3 and (below := sign(poly, lo)) != sign(poly, hi):  # one of two roots; the other may be before it
        yield Root(poly, int(sign(poly, LEAST) != below), lo, hi)
        return
    todo = [(lo, hi, variations(poly, lo), variations(poly, hi))]
    while todo:
        a, b, at_a, at_b = todo.pop()
        if at_a - at_b == 1:
            yield Root(poly, variations(poly, LEAST) - at_a, a, b)
        elif at_a > at_b:
            middle = (a + b) / 2
            at_middle = variations(poly, middle)
            todo += [(a, middle, at_a, at_middle), (middle, b, at_middle, at_b)]


def between(lo: Fraction, hi: Fraction) -> Fraction:
    """Return a dyadic number of few digits in the middle third of an open interval."""
    first, last = float(lo), float(hi)
    if last - first > SHORT * max(1.0, abs(first), abs(last)):  # rounding moves the ends by much less
        power = 1 << max(0, 2 - floor(log2(last - first)))
        return Fraction(round((first + last) / 2 * power), power)
    third = (hi - lo) / 3
    lo, hi = lo + third, hi - third
    power = 1 << max(
        0, (third.denominator // third.numerator).bit_length() - 4
    )  # with fewer digits there is hardly one
    while (n := lo.numerator * power // lo.denominator + 1) * hi.denominator >= hi.numerator * power:
        power *= 2
    return Fraction(n, power)
