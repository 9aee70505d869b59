"""Pi and arctangents of rationals, to any precision."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from math import isqrt

GUARD = 32  # extra bits
HALVINGS = 10


@cache
def pi(bits: int) -> Fraction:
    """Pi with an error below 2^-bits."""
    return 4 * arctangent(Fraction(1), bits + 2)


def arctangent(tangent: Fraction, bits: int) -> Fraction:
    """Arctangent with an error below 2^-bits, for at most a million bits.

    Notes
    -----
    The angle is halved ten times, x -> x / (1 + sqrt(1 + x^2)), and then x - x^3 / 3 + x^5 / 5 - ... In units of the
    last bit, a halving halves the error so far and adds less than 3/2, so that it stays below 3. Now x < 1/500, and
    each of at most bits / 16 + 3 terms errs by less than 2. Doubling ten times makes that 2^10 (bits / 8 + 10) < 2^32.

    Examples
    --------
    >>> float(arctangent(Fraction(1, 3), 100)), float(arctangent(Fraction(-(10**400)), 100))
    (0.3217505543966422, -1.5707963267948966)
    """
    one = 1 << (bits + GUARD)
    x = abs(tangent.numerator) * one // tangent.denominator
    for _ in range(HALVINGS):
        x = x * one // (one + isqrt(one * one + x * x))
    total, power, square, k = 0, x, x * x, 1
    while power:
        total += power // k if k % 4 == 1 else -(power // k)
        power, k = power * square // (one * one), k + 2
    return Fraction((total << HALVINGS) * (1 if tangent > 0 else -1), one)
