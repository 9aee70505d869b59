"""Units of length: their names in files, and exact factors between them."""

from __future__ import annotations

from fractions import Fraction

_INCH = Fraction(254, 10000)
METRES = {
    "m": Fraction(1),
    "km": Fraction(1000),
    "dm": Fraction(1, 10),
    "cm": Fraction(1, 100),
    "mm": Fraction(1, 1000),
    "um": Fraction(1, 10**6),
    "in": _INCH,
    "ft": 12 * _INCH,
    "yd": 36 * _INCH,
    "mi": 63360 * _INCH,
    "pt": _INCH / 72,
    "pc": _INCH / 6,
    "Q": Fraction(1, 4000),
}
"""Length of each unit in metres."""
_NAMES = {
    "metre": "m", "meter": "m", "metres": "m", "meters": "m",
    "kilometre": "km", "kilometer": "km", "kilometres": "km", "kilometers": "km",
    "decimetre": "dm", "decimeter": "dm", "decimetres": "dm", "decimeters": "dm",
    "centimetre": "cm", "centimeter": "cm", "centimetres": "cm", "centimeters": "cm",
    "millimetre": "mm", "millimeter": "mm", "millimetres": "mm", "millimeters": "mm",
    "micrometre": "um", "micrometer": "um", "microns": "um", "micron": "um", "µm": "um", "μm": "um",
    "inch": "in", "inches": "in", '"': "in", "foot": "ft", "feet": "ft", "'": "ft",
    "yard": "yd", "yards": "yd", "mile": "mi", "miles": "mi", "point": "pt", "points": "pt", "q": "Q",
}  # fmt: skip


def unit_of(text: str) -> str:
    """Return the usual short name of a unit of length, or an empty text if it is not known.

    Examples
    --------
    >>> unit_of("Millimeters"), unit_of("m"), unit_of("px")
    ('mm', 'm', '')
    """
    word = text.strip()
    return word if word in METRES else _NAMES.get(word.lower(), word.lower() if word.lower() in METRES else "")


def factor(source: str, target: str) -> Fraction | None:
    """Return the number of target units in a source unit; None if one of them is not known.

    Examples
    --------
    >>> factor("mm", "m"), factor("inches", "mm"), factor("px", "m")
    (Fraction(1, 1000), Fraction(127, 5), None)
    """
    a, b = unit_of(source), unit_of(target)
    return METRES[a] / METRES[b] if a and b else None
