"""Transforms of SVG and CSS as exact maps: functions, origins, and the placement of a viewBox in its viewport."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache
from typing import Any

from cfree.curves.drawn import IDENTITY, Affine, compose, decimal, translation
from cfree.exact.number import ExactPoint
from cfree.formats.drawings.svg_lengths import NUMBER, SPACE, Axis, number

_FUNCTION = re.compile(rf"[ \t\n\r\f,]*([A-Za-z0-9]+){SPACE}*\(([^()]*)\)")
_REST = re.compile(r"[ \t\n\r\f,]*")
_ARGUMENT = re.compile(rf"({NUMBER})([A-Za-z]+|%)?")
_GAP = re.compile(rf"{SPACE}*,?{SPACE}*")
_ANGLES = {"deg": Fraction(1), "grad": Fraction(9, 10), "turn": Fraction(360)}
_ATTRIBUTE = {"matrix": (6,), "translate": (1, 2), "scale": (1, 2), "rotate": (1, 3), "skewX": (1,), "skewY": (1,)}
_CSS = {
    "matrix": (6,), "translate": (1, 2), "translatex": (1,), "translatey": (1,), "scale": (1, 2), "scalex": (1,),
    "scaley": (1,), "rotate": (1,), "skew": (1, 2), "skewx": (1,), "skewy": (1,),
}  # fmt: skip
_SHARES = {"left": "0%", "top": "0%", "center": "50%", "right": "100%", "bottom": "100%"}
LONGEST = 10**80
"""Maximum denominator of an entry of a map; a map with longer numbers is rounded to 14 digits."""
NEAREST, FARTHEST = Fraction(1, 10**40), Fraction(10**100)
"""Bounds of the entries of a map that are not 0."""
Length = Callable[[str, Axis], Fraction]
Point = Callable[[Any, Any], ExactPoint]


def attribute_map(text: str) -> Affine:
    """Return the map of a transform attribute; raise a ValueError with the remedy if it is none.

    Examples
    --------
    >>> [str(part) for part in attribute_map("translate(1 .5) scale(2)")]
    ['2', '0', '0', '2', '1', '1/2']
    """
    return _composed(text, _ATTRIBUTE, "translate(1 2) rotate(30)", _plain)


def css_map(text: str, length: Length) -> Affine:
    """Return the map of the property transform, whose lengths have units and whose angles do as well."""
    if text.strip().lower() == "none":
        return IDENTITY

    def value(name: str, place: int, digits: str, unit: str) -> Fraction:
        exact = Fraction(number(digits))
        if name.startswith("translate"):
            if not unit and exact:
                raise ValueError("a length without its unit")
            return length(digits + unit, "y" if place or name == "translatey" else "x")
        if name.startswith(("rotate", "skew")):
            if unit.lower() == "rad":
                return Fraction(math.degrees(exact))
            if unit.lower() not in _ANGLES and (unit or exact):
                raise ValueError("an angle without its unit")
            return exact * _ANGLES.get(unit.lower(), 1)
        if unit == "%" and name.startswith("scale"):
            return exact / 100
        if unit:
            raise ValueError(f"{unit} in {name}")
        return exact

    return _composed(text, _CSS, "translate(1px, 2px) rotate(30deg)", value, css=True)


def _plain(name: str, place: int, digits: str, unit: str) -> Fraction:
    if unit:
        raise ValueError(f"{unit} in {name}")
    return Fraction(number(digits))


def _composed(
    text: str,
    known: dict[str, tuple[int, ...]],
    example: str,
    value: Callable[[str, int, str, str], Fraction],
    css: bool = False,
) -> Affine:
    by, place = IDENTITY, 0
    try:
        while match := _FUNCTION.match(text, place):
            name = match[1].lower() if css else match[1]
            values = [value(name, k, *pair) for k, pair in enumerate(_arguments(match[2], css))]
            if len(values) not in known.get(name, ()):
                raise ValueError
            by = compose(by, _function(name.lower(), values))
            place = match.end()
    except (ValueError, OverflowError) as error:
        reason = f": {error}" if str(error) else ""
        raise ValueError(f"{text[:60]!r}{reason}; write it like {example}") from None
    if not _REST.fullmatch(text, place):
        raise ValueError(f"{text[:60]!r}; write it like {example}")
    return shortened(by)


def _arguments(text: str, css: bool) -> list[tuple[str, str]]:
    """Split arguments into numbers and units; in CSS they are separated by commas."""
    pairs: list[tuple[str, str]] = []
    text = text.strip(" \t\n\r\f")
    place = 0
    while place < len(text):
        gap = _GAP.match(text, place) if pairs else None
        place = gap.end() if gap else place
        if gap and css and "," not in gap[0]:
            raise ValueError("a comma is missing")
        match = _ARGUMENT.match(text, place)
        if not match:
            raise ValueError("no number")
        pairs.append((match[1], match[2] or ""))
        place = match.end()
    return pairs


def _function(name: str, values: list[Fraction]) -> Affine:
    zero, one = Fraction(0), Fraction(1)
    match name, values:
        case "matrix", [a, b, c, d, e, f]:
            return a, b, c, d, e, f
        case (("translate" | "translatex"), [x]):
            return translation(x, zero)
        case "translatey", [y]:
            return translation(zero, y)
        case "translate", [x, y]:
            return translation(x, y)
        case "scale", [x]:
            return x, zero, zero, x, zero, zero
        case "scale", [x, y]:
            return x, zero, zero, y, zero, zero
        case "scalex", [x]:
            return x, zero, zero, one, zero, zero
        case "scaley", [y]:
            return one, zero, zero, y, zero, zero
        case "rotate", [w]:
            c, s = _turn(w)
            return c, s, -s, c, zero, zero
        case "rotate", [w, x, y]:
            return around(x, y, _function("rotate", [w]))
        case "skew", [x, y]:
            return one, _slope(y), _slope(x), one, zero, zero
        case (("skewx" | "skew"), [x]):
            return one, zero, _slope(x), one, zero, zero
        case _, [y]:
            return one, _slope(y), zero, one, zero, zero
    raise AssertionError(name)


def _turn(degrees: Fraction) -> tuple[Fraction, Fraction]:
    """Return cosine and sine: exact for quarter turns, else decimals of 14 digits."""
    quarters, rest = divmod(degrees % 360, 90)
    angle = math.radians(rest)
    c, s = decimal(math.cos(angle)), decimal(math.sin(angle))
    for _ in range(int(quarters)):
        c, s = -s, c
    return c, s


def _slope(degrees: Fraction) -> Fraction:
    if degrees % 180 == 90:
        raise ValueError("a skew by a right angle")
    return decimal(math.tan(math.radians(degrees)))


def around(x: Fraction, y: Fraction, by: Affine) -> Affine:
    """Return a map about another origin."""
    return compose(compose(translation(x, y), by), translation(-x, -y))


def origin(text: str, length: Length) -> tuple[Fraction, Fraction]:
    """Return the point of transform-origin: lengths, shares, or left, center, top and so on."""
    words = text.split()
    if not 1 <= len(words) <= 3:
        raise ValueError(f"{text[:60]!r}; write it like 10px 20px")
    x, y = words[0].lower(), words[1].lower() if len(words) > 1 else "center"
    if x in ("top", "bottom") or y in ("left", "right"):
        x, y = y, x
    return length(_SHARES.get(x, x), "x"), length(_SHARES.get(y, y), "y")


def shortened(by: Affine) -> Affine:
    """Return a map, its entries rounded to 14 digits if some have very many.

    Raises
    ------
    ValueError
        If it enlarges or shrinks more than doubles can represent.
    """
    if any(abs(entry) > FARTHEST or 0 < abs(entry) < NEAREST for entry in by[:4]):
        raise ValueError("transform: a scale of less than 1e-40 or more than 1e100; scale the drawing")
    if all(entry.denominator < LONGEST and abs(entry.numerator) < LONGEST**2 for entry in by):
        return by
    a, b, c, d, e, f = (decimal(float(entry)) for entry in by)
    return a, b, c, d, e, f


@lru_cache(maxsize=64)
def placing(by: Affine) -> Point:
    """Return the function that maps a point exactly; its coordinates are decimals or fractions."""
    common = math.lcm(*(entry.denominator for entry in by))
    a, b, c, d, e, f = (int(entry * common) for entry in by)

    def place(x: Any, y: Any) -> ExactPoint:
        (p, m), (q, n) = x.as_integer_ratio(), y.as_integer_ratio()
        if m == n:
            whole = common * m
            return Fraction(a * p + c * q + e * m, whole), Fraction(b * p + d * q + f * m, whole)
        p, q, both = p * n, q * m, m * n
        whole = common * both
        return Fraction(a * p + c * q + e * both, whole), Fraction(b * p + d * q + f * both, whole)

    return place


def stretch(by: Affine) -> tuple[float, float]:
    """Return the largest and the least factor by which a map changes lengths."""
    a, b, c, d = map(float, by[:4])
    whole, spread = math.hypot(a + d, b - c), math.hypot(a - d, b + c)
    return (whole + spread) / 2, abs(whole - spread) / 2
