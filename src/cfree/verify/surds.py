"""Exact signs of numbers with square roots: sums of rationals times products of square roots of rationals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isqrt
from typing import Any

from flint import fmpq

Number = Any  # fmpq
Surd = tuple[Number, Number, Number]  # a + b sqrt(k), k >= 0
Roots = frozenset[int]  # numbers of the square roots in a product
Sum = Mapping[Roots, Number]

NONE: Roots = frozenset()


def sign(value: Any) -> int:
    return int(value > 0) - int(value < 0)


def surd_sign(number: Surd) -> int:
    """Sign of a + b sqrt(k).

    Examples
    --------
    >>> [surd_sign((fmpq(a), fmpq(-1), fmpq(2))) for a in (1, 2)], surd_sign((fmpq(-3, 2), fmpq(1), fmpq(9, 4)))
    ([-1, 1], 0)
    """
    a, b, k = number
    one, other = sign(a), sign(b) if k else 0
    return one or other if one * other >= 0 else one * sign(a * a - b * b * k)


def order(x: Surd, y: Surd) -> int:
    """Sign of x - y.

    Examples
    --------
    >>> root = lambda k: (fmpq(0), fmpq(1), fmpq(k))
    >>> order(root(2), root(3)), order(root(8), (fmpq(0), fmpq(2), fmpq(2)))
    (-1, 0)
    """
    (a, b, k), (c, d, m) = x, y
    if not (b and k):
        return -surd_sign((c - a, d, m))
    if not (d and m):
        return surd_sign((a - c, b, k))
    return sum_sign({NONE: a - c, frozenset({0}): b, frozenset({1}): -d}, (k, m))


def sum_sign(terms: Sum, squares: Sequence[Number]) -> int:
    """Sign of a sum of products: each set of numbers stands for the product of the square roots of these squares.

    With A + B sqrt(k), its sign is that of A or B if they agree, else that of A^2 - B^2 k times that of A.

    Examples
    --------
    >>> one = fmpq(1)
    >>> sum_sign({frozenset({0}): one, frozenset({1}): one, frozenset({2}): -one}, (fmpq(2), fmpq(3), fmpq(9)))
    1
    >>> sum_sign({NONE: -one, frozenset({0}): one, frozenset({1}): -one}, (fmpq(9, 4), fmpq(1, 4)))
    0
    """
    last = max((max(roots) for roots in terms if roots), default=None)
    if last is None:
        return sign(terms.get(NONE, 0))
    without = {roots: value for roots, value in terms.items() if last not in roots}
    factor = {roots - {last}: value for roots, value in terms.items() if last in roots}
    one, other = sum_sign(without, squares), sum_sign(factor, squares) if squares[last] else 0
    if one * other >= 0:
        return one or other
    difference = _product(without, without, squares)
    for roots, value in _product(factor, factor, squares).items():
        difference[roots] = difference.get(roots, fmpq(0)) - squares[last] * value
    return one * sum_sign(difference, squares)


def _product(x: Sum, y: Sum, squares: Sequence[Number]) -> dict[Roots, Number]:
    result: dict[Roots, Number] = {}
    for one, a in x.items():
        for other, b in y.items():
            value = a * b
            for k in one & other:
                value *= squares[k]
            result[one ^ other] = result.get(one ^ other, fmpq(0)) + value
    return result


def between(x: Surd, y: Surd) -> Number:
    """A rational strictly between two different numbers, the lesser first."""
    bits = 16
    while True:
        _, low = _around(x, bits)
        high, _ = _around(y, bits)
        if low < high:
            return (low + high) / 2
        bits *= 2


def _around(number: Surd, bits: int) -> tuple[Number, Number]:
    """Rationals below and above a number, or equal to it."""
    a, b, k = number
    if not (b and k):
        return a, a
    low = fmpq(isqrt((int(k.p) << (2 * bits)) // int(k.q)), 1 << bits)
    ends = a + b * low, a + b * (low + fmpq(1, 1 << bits))
    return min(ends), max(ends)
