"""Words of messages: counted things, and long lists cut short."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

MOST_DIGITS = 17
"""Enough for every double."""

MOST_NAMES = 8
"""Names in one message at most; longer lists end with their count."""


MOST_OF_ABBREVIATION = 4
"""Characters."""

ENDINGS = {"vertex": "vertices", "patch": "patches"}
"""Nouns whose plural takes more than an s."""


def counted(count: int, noun: str, plural: str | None = None) -> str:
    """Return a number with its noun, in the singular for one.

    Examples
    --------
    >>> counted(1, "polygon"), counted(1200, "polygon"), counted(0, "contact patch")
    ('1 polygon', '1,200 polygons', '0 contact patches')
    """
    return f"{count:,} {noun if count == 1 else plural or plural_of(noun)}"


def ends(low: float, high: float, digits: int) -> tuple[str, str]:
    """Return the ends of an interval with so many digits, or more if that tells them apart.

    Examples
    --------
    >>> ends(1.25, 1.5, 4), ends(1.1963812, 1.1963826, 5), ends(2.0, 2.0, 3)
    (('1.25', '1.5'), ('1.196381', '1.196383'), ('2', '2'))
    """
    while digits < MOST_DIGITS and low != high and f"{low:.{digits}g}" == f"{high:.{digits}g}":
        digits += 1
    return f"{low:.{digits}g}", f"{high:.{digits}g}"


def coordinate(value: float) -> str:
    """Return a coordinate with three decimals, or with six digits if these are more; without an exponent.

    Examples
    --------
    >>> coordinate(1021500.0), coordinate(2003000.25), coordinate(0.123456789), coordinate(-0.0), coordinate(1e300)
    ('1021500', '2003000.25', '0.123457', '0', '1e+300')
    """
    before = math.floor(math.log10(abs(value))) + 1 if value and math.isfinite(value) else 0
    return f"{value + 0.0:.{min(MOST_DIGITS - 1, max(6, before + 3))}g}"


def near(value: float, size: float) -> str:
    """Return a coordinate to a hundredth of a size, however large it is.

    Examples
    --------
    >>> near(456789.1234, 0.9), near(-6.0, 0.9), near(123.4, 2000.0)
    ('456789.123', '-6', '123')
    """
    decimals = min(MOST_DIGITS, max(0, 2 - math.floor(math.log10(size)))) if size > 0 else 6
    text = f"{value:.{decimals}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text == "-0" else text


_AFTER_THE_NOUN = re.compile(
    r"(?<=.)(?=[,:(]|\s+(?:around|in|of|on|at|by|with|without|within|from|to|for|that|which|whose|so|as|after|before|beside|below|"
    r"beyond|outside|inside|between|under|over|through|not|and|or|drawn|closed|read|made|left|joined|painted|rounded|"
    r"stretched|used|shorter|far|than|is|are|forbids?)\b)"
)
_VERB = re.compile(
    r"(?<=^ that )(is|has|does|crosses or touches|crosses|misses|stands|paints|divides|overlaps)\b( itself| its)?"
)
"""The verb of a clause about the noun, and what refers to the noun."""
_PLURALS = {"is": "are", "has": "have", "does": "do", "crosses or touches": "cross or touch", "crosses": "cross"}
_PLURALS |= {"misses": "miss", " itself": " themselves", " its": " their", "": ""}


def noun_and_rest(phrase: str) -> tuple[str, str]:
    """Divide a noun with its attributes after the noun.

    Examples
    --------
    >>> noun_and_rest("outline closed by a join"), noun_and_rest("open line")
    (('outline', ' closed by a join'), ('open line', ''))
    """
    noun, *rest = _AFTER_THE_NOUN.split(phrase, maxsplit=1)
    return noun, "".join(rest)


def plural_of(phrase: str) -> str:
    """Return the plural of a noun with its attributes.

    Examples
    --------
    >>> plural_of("open line"), plural_of("entity in paper space"), plural_of("ring drawn twice"), plural_of("vertex")
    ('open lines', 'entities in paper space', 'rings drawn twice', 'vertices')
    >>> plural_of("ring that crosses itself"), plural_of("line with a width, read as a wall")
    ('rings that cross themselves', 'lines with a width, read as walls')
    """
    noun, rest = noun_and_rest(phrase)
    rest = _VERB.sub(lambda verb: _PLURALS.get(verb[1], verb[1].removesuffix("s")) + _PLURALS[verb[2] or ""], rest)
    rest = re.sub(r"read as a (solid|wall)\b", r"read as \1s", rest)
    if word := re.search(r"\b(vertex|patch)$", noun):
        return f"{noun[: word.start()]}{ENDINGS[word[1]]}{rest}"
    if re.search(r"[^aeiou]y$", noun):
        return f"{noun[:-1]}ies{rest}"
    return f"{noun}{'es' if re.search(r'(s|x|ch|sh)$', noun) else 's'}{rest}"


def is_abbreviation(units: str) -> bool:
    """True if units are short enough to stand after each number.

    Examples
    --------
    >>> is_abbreviation("m"), is_abbreviation("corridor widths"), is_abbreviation("")
    (True, False, False)
    """
    return 0 < len(units) <= MOST_OF_ABBREVIATION


def listed(names: Sequence[str], by: str = "; ") -> str:
    """Join names in one line; a long list is cut after `MOST_NAMES`.

    Examples
    --------
    >>> listed(["a", "b"]), listed([str(k) for k in range(53)], ", ")
    ('a; b', '0, 1, 2, 3, 4, 5, 6, 7, ... of 53')
    """
    shown = list(names[:MOST_NAMES])
    return by.join([*shown, f"... of {len(names):,}"] if len(names) > MOST_NAMES else shown)
