"""Viewports of SVG: the viewBox, its place by preserveAspectRatio, and corners of boxes in the scene."""

from __future__ import annotations

import re
from fractions import Fraction

from cfree.curves.drawn import Affine
from cfree.exact.number import ExactPoint
from cfree.formats.drawings.svg_paths import read_numbers
from cfree.formats.drawings.svg_transforms import placing
from cfree.formats.drawings.xml_tree import Node

Size = tuple[Fraction, Fraction]


def box_of_view(node: Node) -> tuple[Fraction, ...]:
    """Return x, y, width and height of a viewBox; nothing if there is none. Raise a ValueError if it is wrong."""
    text = node.attributes.get("viewBox", "").strip()
    if not text or text == "none":
        return ()
    values, fault = read_numbers(text)
    if fault is not None or len(values) != 4 or min(values[2:]) < 0:
        raise ValueError(f"viewBox: {text[:60]!r}; write it like 0 0 100 50")
    return tuple(map(Fraction, values))


def corners_in(frame: Affine, place: Size, size: Size) -> tuple[ExactPoint, ...]:
    """Return the corners of a box in the scene."""
    (x, y), (w, h) = place, size
    put = placing(frame)
    return tuple(put(*p) for p in ((x, y), (x + w, y), (x + w, y + h), (x, y + h)))


def fitted(place: Size, size: Size, box: tuple[Fraction, ...], aspect: str) -> Affine:
    """Return the map from a viewBox to its viewport, by preserveAspectRatio; raise a ValueError if that is no rule.

    Examples
    --------
    >>> box = tuple(map(Fraction, (0, 0, 10, 20)))
    >>> [str(part) for part in fitted((Fraction(0), Fraction(0)), (Fraction(40), Fraction(40)), box, "")]
    ['2', '0', '0', '2', '10', '0']
    """
    words = aspect.split() or ["xMidYMid"]
    if words[0] == "defer":
        words.pop(0)
    align, mode = (*words, "meet")[:2]
    rule = re.fullmatch("none|x(Min|Mid|Max)Y(Min|Mid|Max)", align)
    if not rule or mode not in ("meet", "slice") or len(words) > 2:
        raise ValueError(f"preserveAspectRatio: {aspect[:60]!r}; write it like xMidYMid meet")
    x, y = size[0] / box[2], size[1] / box[3]
    if align != "none":
        x = y = min(x, y) if mode == "meet" else max(x, y)
    spare = [
        (whole - part * scale) * _PLACES.get(word, Fraction(0))
        for whole, part, scale, word in zip(size, box[2:], (x, y), rule.groups(), strict=True)
    ]
    return (
        x,
        Fraction(0),
        Fraction(0),
        y,
        place[0] - box[0] * x + spare[0],
        place[1] - box[1] * y + spare[1],
    )


_PLACES = {"Min": Fraction(0), "Mid": Fraction(1, 2), "Max": Fraction(1)}
