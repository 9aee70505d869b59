"""Real roots of integer polynomials, exactly: every critical angle is one of these numbers.

A root is known by its irreducible polynomial and its number among that polynomial's roots, so that equal numbers are
equal keys, whatever names and intervals they came with. Python-flint factors and divides; the signs of Sturm chains
are those of Python's integers.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import cmp_to_key, lru_cache
from itertools import pairwise

from flint import fmpq_poly, fmpz_poly

Coefficients = tuple[int, ...]  # constant term first
FIRST = Fraction(-2)  # roots are counted from here; charts are [-1, 1]


class Root:
    """An irreducible polynomial's only root in [lo, hi]; `narrow` halves the interval.

    Examples
    --------
    >>> (negative, _), (positive, _) = roots(fmpz_poly([-2, 0, 1]), Fraction(-2), Fraction(2))
    >>> compare(negative, positive), positive.key
    (-1, ((-2, 0, 1), 1))
    """

    __slots__ = ("hi", "key", "lo", "poly")

    def __init__(self, poly: Coefficients, index: int, lo: Fraction, hi: Fraction) -> None:
        self.poly, self.lo, self.hi = poly, lo, hi
        self.key = poly, index

    @property
    def field(self) -> fmpq_poly:
        """The polynomial, to compute modulo it."""
        return fmpq_poly(list(self.poly))

    def narrow(self) -> None:
        if self.lo < self.hi:  # else rational, and known
            middle = (self.lo + self.hi) / 2
            if sign(self.poly, middle) == sign(self.poly, self.lo):
                self.lo = middle
            else:
                self.hi = middle


def compare(x: Root, y: Root) -> int:
    """Sign of x - y."""
    if x.key == y.key:
        return 0
    while x.lo <= y.hi and y.lo <= x.hi:  # different numbers: they part
        x.narrow()
        y.narrow()
    return -1 if x.hi < y.lo else 1


in_order = cmp_to_key(compare)


def sign(poly: Sequence[int], x: Fraction) -> int:
    """Sign of a polynomial at a rational."""
    n, d = x.numerator, x.denominator
    value, power = 0, 1
    for coefficient in reversed(poly):
        value = value * n + coefficient * power
        power *= d
    return (value > 0) - (value < 0)


@lru_cache(maxsize=1 << 14)
def factors(poly: Coefficients) -> tuple[tuple[Coefficients, int], ...]:
    """Irreducible factors that are not constant, and their multiplicities."""
    _, found = fmpz_poly(list(poly)).factor()
    return tuple((tuple(map(int, f.coeffs())), int(k)) for f, k in found)


@lru_cache(maxsize=1 << 14)
def sturm_chain(poly: Coefficients) -> tuple[Coefficients, ...]:
    """Sturm's chain of a polynomial without multiple roots."""
    chain = [fmpq_poly(list(poly)), fmpq_poly(list(poly)).derivative()]
    while chain[-1].degree() > 0:
        chain.append(-(chain[-2] % chain[-1]))
    return tuple(tuple(map(int, p.numer().coeffs())) for p in chain)  # denominators are positive


def variations(poly: Coefficients, x: Fraction) -> int:
    signs = [s for s in (sign(p, x) for p in sturm_chain(poly)) if s]
    return sum(a != b for a, b in pairwise(signs))


def roots(poly: fmpz_poly, lo: Fraction, hi: Fraction) -> list[tuple[Root, int]]:
    """Roots in the closed interval, each once, in order, with their multiplicities; FIRST < lo."""
    found: list[tuple[Root, int]] = []
    for factor, multiplicity in factors(tuple(map(int, poly.coeffs()))):
        if len(factor) == 2:
            x = Fraction(-factor[0], factor[1])
            if lo <= x <= hi:
                found.append((Root(factor, 0, x, x), multiplicity))
        else:  # no rational roots: the ends of intervals are none
            found += [(root, multiplicity) for root in _isolated(factor, lo, hi)]
    return sorted(found, key=lambda item: in_order(item[0]))


def _isolated(poly: Coefficients, lo: Fraction, hi: Fraction) -> Iterable[Root]:
    todo = [(lo, hi, variations(poly, lo), variations(poly, hi))]
    while todo:
        a, b, at_a, at_b = todo.pop()
        if at_a - at_b == 1:
            yield Root(poly, variations(poly, FIRST) - at_a, a, b)
        elif at_a > at_b:
            middle = (a + b) / 2
            at_middle = variations(poly, middle)
            todo += [(a, middle, at_a, at_middle), (middle, b, at_middle, at_b)]


def between(lo: Fraction, hi: Fraction) -> Fraction:
    """A dyadic number of few digits in the middle third of an open interval."""
    third = (hi - lo) / 3
    lo, hi = lo + third, hi - third
    power = 1
    while (n := lo.numerator * power // lo.denominator + 1) * hi.denominator >= hi.numerator * power:
        power *= 2
    return Fraction(n, power)
