"""Repair polygons of a file, if the option `repair` is on, and name it where they are refused."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from fractions import Fraction

from cfree.errors import InvalidPolygonError
from cfree.exact.number import ExactPoint
from cfree.formats.drawings.source import Source
from cfree.polygons.polygon import Polygon
from cfree.polygons.repair import united
from cfree.scene.scene import explained

_FAULTS = ("split it", "spike", "remove this", "touch", "overlap", "cross", "outside", "inside of")


def mended(
    source: Source, parts: Sequence[Sequence[Sequence[ExactPoint]]], role: str, name: str | None = None
) -> list[Polygon]:
    """Return the union of polygons that are given together; note what was repaired.

    Parameters
    ----------
    parts : sequence of sequences of rings
        The rings of each polygon, the outer one first.
    role : str
        Of ambiguous parts an obstacle or a robot gets most, and a workspace least.
    """
    where = name or role
    polygons = list(united(parts, "evenodd" if role == "workspace" else "nonzero"))
    drawn = _valid(parts)
    if len(drawn) == len(parts) == len(polygons) and _area(drawn) == _area(polygons):
        return drawn
    if not polygons:
        source.note("lost", "polygon without an interior", "less", count=len(parts), where=where)
    else:
        x, y = parts[0][0][0]
        place = float(x), float(y)
        source.note("mended", "polygon that crosses itself or others", "unknown", where=where, at=place)
    return polygons


def repairable(error: InvalidPolygonError) -> str:
    """Return the message of an error, with the option that repairs the polygon."""
    message = explained(error)
    return f"{message}, or give --repair" if any(word in message for word in _FAULTS) else message


def _valid(parts: Sequence[Sequence[Sequence[ExactPoint]]]) -> list[Polygon]:
    polygons = []
    for outer, *holes in parts:
        with suppress(InvalidPolygonError):
            polygons.append(Polygon(outer, holes))
    return polygons


def _area(polygons: Sequence[Polygon]) -> Fraction:
    return sum((polygon.exact_area for polygon in polygons), Fraction(0))
