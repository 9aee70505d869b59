"""Numbers in two forms: balls that hold the truth, and exact sums of products of square roots; and trigonometric forms.

Formulas about surfaces are written once, for both. Balls have as many bits as `precision` states; exact numbers decide
if a form vanishes at every angle.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from math import isqrt
from typing import Any

from flint import arb, arb_poly, ctx, fmpq, fmpq_poly

from cfree.verify.surds import sum_sign

Number = Any  # fmpq
Scalar = Any  # arb, or Surd
Ball = Any  # arb
Polynomial = Any  # arb_poly, or Surd
Point = tuple[Number, Number]


@contextmanager
def precision(bits: int) -> Iterator[None]:
    """Set the number of bits of balls."""
    before = ctx.prec
    ctx.prec = bits
    try:
        yield
    finally:
        ctx.prec = before


@dataclass(frozen=True)
class Surd:
    """A sum of polynomials in tau with rational coefficients, times products of square roots of rationals.

    Examples
    --------
    >>> two, three, six = (Surd.root(fmpq(k)) for k in (2, 3, 6))
    >>> (two * three - six).is_zero, (two + three - six).is_zero
    (True, False)
    """

    terms: Mapping[frozenset[Number], fmpq_poly]

    @staticmethod
    def number(q: Number) -> Surd:
        return Surd({frozenset(): fmpq_poly([q])})

    @staticmethod
    def root(square: Number) -> Surd:
        p, q = isqrt(int(square.p)), isqrt(int(square.q))
        if fmpq(p * p, q * q) == square:
            return Surd.number(fmpq(p, q))
        return Surd({frozenset([square]): fmpq_poly([1])})

    @staticmethod
    def poly(coefficients: list[Surd]) -> Surd:
        total = Surd({})
        for k, c in enumerate(coefficients):
            total = total + c * Surd({frozenset(): fmpq_poly([0] * k + [1])})
        return total

    def __add__(self, other: Surd) -> Surd:
        terms = dict(self.terms)
        for roots, value in other.terms.items():
            terms[roots] = terms.get(roots, fmpq_poly()) + value
        return Surd(terms)

    def __neg__(self) -> Surd:
        return Surd({roots: -value for roots, value in self.terms.items()})

    def __sub__(self, other: Surd) -> Surd:
        return self + -other

    def __mul__(self, other: Surd) -> Surd:
        terms: dict[frozenset[Number], fmpq_poly] = {}
        for one, a in self.terms.items():
            for two, b in other.terms.items():
                value = a * b
                for square in one & two:
                    value *= square
                terms[one ^ two] = terms.get(one ^ two, fmpq_poly()) + value
        return Surd(terms)

    @property
    def is_zero(self) -> bool:
        """True if all coefficients vanish: signs of sums of square roots, by squaring."""
        squares = sorted({square for roots in self.terms for square in roots})
        number = {square: k for k, square in enumerate(squares)}
        degree = max((value.degree() for value in self.terms.values()), default=-1)
        return all(
            sum_sign({frozenset(map(number.__getitem__, r)): value[k] for r, value in self.terms.items()}, squares) == 0
            for k in range(degree + 1)
        )


class Balls:
    """Balls, as the other form of numbers."""

    @staticmethod
    def number(q: Number) -> Ball:
        return arb(q)

    @staticmethod
    def root(square: Number) -> Ball:
        return arb(square).sqrt()

    @staticmethod
    def poly(coefficients: list[Ball]) -> Polynomial:
        return arb_poly(coefficients)


def root(x: Ball) -> Ball:
    """Square root of the positive part of a ball."""
    if x.lower() >= 0:
        return x.sqrt()
    if x.upper() <= 0:
        return arb(0)
    half = x.upper().sqrt().upper() / 2
    return arb(half, half.upper())


@dataclass(frozen=True, slots=True)
class Trig:
    """Form a + b cos(theta) + c sin(theta)."""

    a: Scalar
    b: Scalar
    c: Scalar

    def __add__(self, other: Trig) -> Trig:
        return Trig(self.a + other.a, self.b + other.b, self.c + other.c)

    def __sub__(self, other: Trig) -> Trig:
        return Trig(self.a - other.a, self.b - other.b, self.c - other.c)

    def times(self, k: Scalar) -> Trig:
        return Trig(self.a * k, self.b * k, self.c * k)

    def __neg__(self) -> Trig:
        return Trig(-self.a, -self.b, -self.c)

    def plus(self, k: Scalar) -> Trig:
        return Trig(self.a + k, self.b, self.c)

    @property
    def is_zero(self) -> bool:
        """True if an exact form vanishes at every angle."""
        return bool(self.a.is_zero and self.b.is_zero and self.c.is_zero)

    def at(self, turn: Turn) -> Ball:
        return self.a + self.b * turn.cos + self.c * turn.sin

    def coefficients(self, chart: int) -> list[Scalar]:
        """Coefficients of the quadratic in tau, the form times 1 + tau^2."""
        b, c = (-self.b, -self.c) if chart else (self.b, self.c)
        return [self.a + b, c + c, self.a - b]


@dataclass(frozen=True, slots=True)
class Turn:
    """An angle in balls: tau in a chart."""

    chart: int
    tau: Ball
    cos: Ball
    sin: Ball

    @classmethod
    def of(cls, chart: int, tau: arb) -> Turn:
        square, sign = tau * tau, -1 if chart else 1
        return cls(chart, tau, sign * (1 - square) / (1 + square), sign * 2 * tau / (1 + square))


BALL_ERROR = 0.5
Moving = tuple[Point, Point]  # p - R q


def dot(u: Moving, v: Moving) -> tuple[Number, Number, Number]:
    """Coefficients of the inner product of p - R q and r - R s."""
    (p, q), (r, s) = u, v
    return _dot(p, r) + _dot(q, s), -(_dot(p, s) + _dot(q, r)), _cross(p, s) - _cross(q, r)


def quarter(u: Moving) -> Moving:
    """Turn a moving vector to the left."""
    (p, q) = u
    return (-p[1], p[0]), (-q[1], q[0])


def cross(u: Moving, v: Moving) -> tuple[Number, Number, Number]:
    return dot(quarter(u), v)


def _dot(u: Point, v: Point) -> Number:
    return u[0] * v[0] + u[1] * v[1]


def _cross(u: Point, v: Point) -> Number:
    return u[0] * v[1] - u[1] * v[0]
