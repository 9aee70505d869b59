"""Read numbers as exact rationals.

A float stands for the exact value of its double, a `Decimal` or a string for the decimal as written (``"0.1"`` is
1/10). ``"1/3"``, integers and fractions stand for themselves. All decisions use these values.
"""

from __future__ import annotations

import math
import re
import reprlib
from collections.abc import Iterable
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from typing import cast

from cfree.libraries import ArrayLike, Floats, is_numpy, np

Number = int | float | Fraction | Decimal | str
ExactPoint = tuple[Fraction, Fraction]
IntPoint = tuple[int, int]

LARGEST = 10**150  # of all lengths
# longer numbers are refused: no coordinate needs them, and Python prints integers of at most 4300 digits
MAX_DIGITS = 4000
_QUOTIENT = re.compile(r"\s*([+-]?[0-9]+)\s*/\s*([+-]?[0-9]+)\s*")


def to_fraction(value: Number) -> Fraction:
    """Exact value of a number.

    Parameters
    ----------
    value : int, float, Fraction, Decimal or str
        NumPy scalars count as the Python numbers they hold.

    Returns
    -------
    Fraction

    Raises
    ------
    ValueError
        If `value` is no number, is not finite, or has more than `MAX_DIGITS` digits.

    Examples
    --------
    >>> to_fraction("0.1"), to_fraction("1/3"), to_fraction(0.5)
    (Fraction(1, 10), Fraction(1, 3), Fraction(1, 2))
    >>> to_fraction(0.1) == to_fraction("0.1")
    False
    """
    return value if type(value) is Fraction else Fraction(*to_ratio(value))


def to_ratio(value: Number) -> tuple[int, int]:
    """Numerator and positive denominator of a number in lowest terms: `to_fraction` without the object.

    Examples
    --------
    >>> to_ratio(0.75)
    (3, 4)
    """
    if type(value) is Fraction:  # the usual types first
        return value.as_integer_ratio()
    if type(value) is Decimal:
        return _decimal_ratio(value)
    if isinstance(value, bool) or is_numpy(value, "bool_"):
        raise ValueError(f"{value} is a truth value; give a number")
    if isinstance(value, int) or is_numpy(value, "integer"):
        return int(value), 1
    if isinstance(value, float) or is_numpy(value, "floating"):
        number = cast(float, value)
        if not math.isfinite(number):
            raise ValueError(f"{value} is not finite; give a finite number")
        return number.as_integer_ratio()
    if isinstance(value, Fraction):
        return value.numerator, value.denominator
    if isinstance(value, Decimal):
        return _decimal_ratio(value)
    if isinstance(value, str):
        return _string_ratio(value)
    raise ValueError(f"{_excerpt(value)} is no number; give one, or a string like '1/3'")


def is_single(value: object) -> bool:
    """True if a value has no parts: a number of any kind, not a row of them.

    Examples
    --------
    >>> is_single(1), is_single("1/3"), is_single([1, 2])
    (True, True, False)
    """
    return isinstance(value, int | float | Fraction | Decimal | str) or bool(np.ndim(value) == 0)  # type: ignore[arg-type]


def common_denominator(fractions: Iterable[Fraction]) -> int:
    """Least positive integer that makes every fraction whole.

    Examples
    --------
    >>> common_denominator([Fraction(1, 4), Fraction(5, 6)])
    12
    """
    return math.lcm(*{fraction.denominator for fraction in fractions})


def rational_root(square: Fraction) -> Fraction | None:
    """Return the square root of a number that is not negative, None if it is irrational.

    Examples
    --------
    >>> rational_root(Fraction(9, 4)), rational_root(Fraction(2))
    (Fraction(3, 2), None)
    """
    root = Fraction(math.isqrt(square.numerator), math.isqrt(square.denominator))
    return root if root * root == square else None


def simplest_between(low: Fraction, high: Fraction) -> Fraction:
    """Fraction of least denominator in a closed interval, the nearest to 0 of those.

    Parameters
    ----------
    low, high : Fraction
        low <= high.

    Notes
    -----
    It has the common beginning of the two continued fractions, then the least number that separates them.

    Examples
    --------
    >>> simplest_between(Fraction(33, 100), Fraction(34, 100)), simplest_between(Fraction(-3), Fraction(-5, 2))
    (Fraction(1, 3), Fraction(-3, 1))
    """
    if low <= 0:
        return -simplest_between(-high, -low) if high < 0 else Fraction(0)
    (a, b), (c, d) = low.as_integer_ratio(), high.as_integer_ratio()
    p, q, previous_p, previous_q = 1, 0, 0, 1  # the last two convergents
    while (whole := -(-a // b)) * d > c:
        floor = whole - 1
        p, q, previous_p, previous_q = floor * p + previous_p, floor * q + previous_q, p, q
        a, b, c, d = d, c - floor * d, b, a - floor * b
    return Fraction(whole * p + previous_p, whole * q + previous_q)


def angle(x: int, y: int) -> float:
    """Angle of an integer vector of any size, in (-pi, pi].

    Examples
    --------
    >>> angle(10**400, 10**400) == math.pi / 4
    True
    """
    size = max(abs(x), abs(y))
    return math.atan2(y / size, x / size)


def finite(name: str, values: ArrayLike) -> Floats:
    """Convert values to doubles; NaN and infinity are errors."""
    array = np.asarray(values, dtype=np.float64)
    if not np.isfinite(array).all():
        raise ValueError(f"{name}: {array[~np.isfinite(array)][0]} is not finite; give finite numbers")
    return array


def _decimal_ratio(value: Decimal) -> tuple[int, int]:
    if not value.is_finite():
        raise ValueError(f"{value} is not finite; give a finite number")
    _, digits, exponent = value.as_tuple()
    assert isinstance(exponent, int)  # only NaN and infinity have letters there
    if len(digits) + abs(exponent) > MAX_DIGITS:
        raise ValueError(f"{_excerpt(value)} has more than {MAX_DIGITS} digits; give fewer")
    return value.as_integer_ratio()


def _string_ratio(text: str) -> tuple[int, int]:
    if len(text) > MAX_DIGITS:
        raise ValueError(f"{_excerpt(text)} has {len(text)} characters; give at most {MAX_DIGITS}")
    quotient = _QUOTIENT.fullmatch(text)
    if quotient:
        numerator, denominator = int(quotient[1]), int(quotient[2])
        if denominator == 0:
            raise ValueError(f"{text!r} divides by zero; give a finite number")
        return Fraction(numerator, denominator).as_integer_ratio()
    try:
        return _decimal_ratio(Decimal(text))
    except InvalidOperation:
        raise ValueError(f"{_excerpt(text)} is no number; write it like '0.1', '-2e3' or '1/3'") from None


def _excerpt(value: object) -> str:
    """The beginning of a value, for a message."""
    return reprlib.repr(value)
