"""Read footprints of robots as nav2 writes them: lists of points in text."""

from __future__ import annotations

import re
from fractions import Fraction

from cfree.arguments import checked
from cfree.errors import FormatError, InvalidPolygonError
from cfree.exact.number import ExactPoint, to_fraction
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import explained

_NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_POINT = re.compile(rf"\s*[\[(]\s*({_NUMBER})\s*,\s*({_NUMBER})\s*[\])]\s*(,|$)\s*")


@checked
def footprint(text: str) -> Polygon:
    """Read the polygon in a nav2 parameter ``footprint``.

    Parameters
    ----------
    text : str
        Such as ``"[[0.5, 0.25], [0.5, -.25], ...]"``, in the robot's frame: metres, x forward, y to the left.

    Raises
    ------
    FormatError
        If the text is no polygon.

    Examples
    --------
    >>> footprint("[ [0.5, 0.25], [-.5,0.25], [-0.5, -0.25], [.5, -0.25] ]").exact_area
    Fraction(1, 2)
    """
    points: list[ExactPoint] = []
    whole = text.strip().strip("\"'").strip()
    if whole[:1] in ("[", "(") and whole[-1:] in ("]", ")"):
        rest, place = whole[1:-1].strip(), 0
        while place < len(rest):
            match = _POINT.match(rest, place)
            if not match:
                break
            points.append((_number(match[1]), _number(match[2])))
            place = match.end()
        else:
            if points:
                return _polygon(points)
    raise FormatError(
        f"footprint: {text[:60]!r}; write it like [[0.5, 0.25], [-0.5, 0.25], [-0.5, -0.25], [0.5, -0.25]]"
    )


def _polygon(points: list[ExactPoint]) -> Polygon:
    try:
        return Polygon(points)
    except InvalidPolygonError as error:
        raise FormatError(f"footprint: {explained(error)}") from None


def _number(text: str) -> Fraction:
    try:
        return to_fraction(text)
    except ValueError as error:
        raise FormatError(f"footprint: {error}") from None
