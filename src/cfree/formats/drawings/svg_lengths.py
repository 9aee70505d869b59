"""Numbers and lengths of SVG: exact decimals, units, percents of the viewport."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Literal

from cfree.formats.drawings.source import Source

NUMBER = r"[+-]?(?:[0-9]++\.?+[0-9]*+|\.[0-9]++)(?:[eE][+-]?[0-9]++)?+"
"""Pattern of a number."""
SPACE = r"[ \t\n\r\f]"
MOST_DIGITS = 400
"""Maximum number of characters of a number."""
LEAST, GREATEST = -100, 150
"""Bounds of the decimal exponent of a number that is not 0."""
UNITS = {
    "px": Fraction(1), "in": Fraction(96), "cm": Fraction(9600, 254), "mm": Fraction(960, 254),
    "m": Fraction(960000, 254), "q": Fraction(240, 254), "pt": Fraction(4, 3), "pc": Fraction(16),
}  # fmt: skip
"""User units in a unit, 96 an inch."""
EM = Fraction(16)
"""Size of a letter if the file does not give one."""
Axis = Literal["x", "y", "diagonal"]

_LENGTH = re.compile(rf"{SPACE}*({NUMBER})([A-Za-z]+|%)?{SPACE}*")


def number(text: str) -> Decimal:
    """Return a number exactly; raise a ValueError if it is out of range or too long.

    Examples
    --------
    >>> number("-.5e-3")
    Decimal('-0.0005')
    """
    value = Decimal(text)
    if len(text) > MOST_DIGITS or (value and not LEAST <= value.adjusted() < GREATEST):
        raise ValueError(f"{text[:20]} is no coordinate; give 0, or one from 1e{LEAST} to 1e{GREATEST}")
    return value


@dataclass(frozen=True, slots=True)
class Measure:
    """Sizes that lengths depend on: the viewport's width and height, None if not known, and the size of a letter."""

    width: Fraction | None
    height: Fraction | None
    em: Fraction = EM

    def length(self, source: Source, text: str, axis: Axis) -> Fraction:
        """Return a length in user units; raise a ValueError with the remedy if the text is none.

        Examples
        --------
        >>> page = Measure(Fraction(30), Fraction(40))
        >>> [str(page.length(Source("a.svg"), text, "x")) for text in ("10%", "2.54cm", "-.5")]
        ['3', '96', '-1/2']
        """
        match = _LENGTH.fullmatch(text)
        if not match:
            word = "calc() is not read" if "(" in text else f"{text[:60]!r} is no length"
            raise ValueError(f"{word}; write it like 10 or 2.5mm")
        value, unit = Fraction(number(match[1])), (match[2] or "px").lower()
        if unit == "%":
            return value / 100 * self.whole(axis)
        if unit in ("em", "ex"):
            source.note("guess", f"length in {unit}: a letter is taken as {float(self.em):g} px high", "unknown")
            return value * self.em / (1 if unit == "em" else 2)
        if unit not in UNITS:
            raise ValueError(f"{text[:60]!r} is no length; write it like 10 or 2.5mm")
        return value * UNITS[unit]

    def whole(self, axis: Axis) -> Fraction:
        """Return the length that 100 % stands for."""
        if axis == "diagonal" and self.width is not None and self.height is not None:
            if self.width == self.height:
                return self.width
            return Fraction(math.sqrt((self.width**2 + self.height**2) / 2))
        side = self.width if axis == "x" else self.height
        if side is None:
            raise ValueError("a share of a size that the file does not give; give the svg a viewBox")
        return side


def unit_of(text: str) -> tuple[Fraction, str] | None:
    """Return the number and the unit of a length; None if it is a share, or no length.

    Examples
    --------
    >>> unit_of("210mm"), unit_of("100%")
    ((Fraction(210, 1), 'mm'), None)
    """
    match = _LENGTH.fullmatch(text)
    unit = (match[2] or "") if match else "%"
    return (Fraction(number(match[1])), unit) if match and (not unit or unit.lower() in UNITS) else None
