"""Sums of doubles without rounding, so that they do not depend on the order of addition."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

DIGITS, LOW = 53, 27  # digits of a double's mantissa, and of its lower part
EXPONENT, LEAST = 12, 2048  # digits of an exponent; exponents are above -2048


def exact_sums(values: NDArray[np.float64], group: NDArray[np.int64], groups: int) -> list[Fraction]:
    """The exact sum of each group's values, which are finite and fewer than 2^26.

    Examples
    --------
    >>> exact_sums(np.array([1e16, 1.0, -1e16, 0.1]), np.array([0, 0, 0, 1]), 2)
    [Fraction(1, 1), Fraction(3602879701896397, 36028797018963968)]
    """
    mantissa, exponent = np.frexp(values)
    whole = np.ldexp(mantissa, DIGITS).astype(np.int64)
    keys, place = np.unique(group << EXPONENT | exponent + LEAST, return_inverse=True)
    place = place.reshape(-1)
    # sums of less than 2^26 parts of at most 27 digits each are integers below 2^53
    high = np.bincount(place, whole >> LOW, len(keys)).astype(np.int64)
    low = np.bincount(place, whole & ((1 << LOW) - 1), len(keys)).astype(np.int64)
    sums = [Fraction(0)] * groups
    for key, a, b in zip(keys.tolist(), high.tolist(), low.tolist(), strict=True):
        power = (key & (1 << EXPONENT) - 1) - LEAST
        sums[key >> EXPONENT] += ((a << LOW) + b) * Fraction(2) ** (power - DIGITS)
    return sums
