"""Write exact numbers as JSON."""

from __future__ import annotations

from fractions import Fraction

from cfree.errors import UnsupportedError
from cfree.exact.number import MAX_DIGITS


def number_text(value: Fraction) -> str:
    """Return exact JSON of a number: a decimal if one of moderate length is exact, else ``"p/q"`` in quotes.

    Examples
    --------
    >>> number_text(Fraction(-1, 8)), number_text(Fraction(1, 3))
    ('-0.125', '"1/3"')
    """
    bits = value.numerator.bit_length() + value.denominator.bit_length()
    if bits > 3 * MAX_DIGITS:  # a digit has 3.3 bits, and a point may add some zeros
        raise UnsupportedError(f"a number has about {bits * 0.301:.0f} digits; round it before saving")
    rest, places = value.denominator, 0
    for prime in (2, 5):
        power = 0
        while rest % prime == 0 and power < 80:
            rest, power = rest // prime, power + 1
        places = max(places, power)
    if rest != 1:
        return f'"{value}"'
    digits = str(abs(value.numerator) * 10**places // value.denominator).rjust(places + 1, "0")
    whole, decimals = digits[: len(digits) - places], digits[len(digits) - places :]
    return f"{'-' if value < 0 else ''}{whole}{decimals and '.'}{decimals}"
