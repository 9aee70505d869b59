"""Repair polygons of a file, if the option `repair` is on, and name it where they are refused."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from fractions import Fraction
from typing import Any

from pydantic import TypeAdapter, ValidationError

from cfree.errors import InvalidPolygonError
from cfree.exact.number import ExactPoint
from cfree.formats.drawings.source import Source
from cfree.formats.scenes.curve_format import ROUND_KEYS
from cfree.formats.scenes.json_types import Point
from cfree.formats.scenes.scene_values import is_ring
from cfree.polygons.polygon import Polygon
from cfree.polygons.repair import united
from cfree.scene.scene import explained

_RINGS = TypeAdapter(list[list[Point]])
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


def mended_scene(source: Source, data: dict[str, Any]) -> dict[str, Any]:
    """Return the decoded JSON of a scene with repaired polygons; all other faults stay."""
    result = dict(data)
    for key, role in (("robot", "robot"), ("obstacles", "obstacle")):
        value = data.get(key)
        shapes = value if isinstance(value, list) and not is_ring(value) else [value]
        parts = [part for shape in shapes for part in _mended_shape(source, shape, role)]
        if len(parts) != len(shapes) or any(a is not b for a, b in zip(parts, shapes, strict=True)):
            result[key] = parts
    room = _mended_shape(source, data.get("workspace"), "workspace")
    return {**result, "workspace": room[0]} if len(room) == 1 and room[0] is not None else result


def _mended_shape(source: Source, shape: Any, role: str) -> list[Any]:
    """Return the shapes for one of a scene: itself, unless it is a polygon that needs repair."""
    members = {"outer": shape} if is_ring(shape) else shape
    if not isinstance(members, dict) or members.keys() & ROUND_KEYS:
        return [shape]
    name = members.get("name")
    try:
        outer, *holes = _RINGS.validate_python([members.get("outer"), *(members.get("holes") or ())])
        Polygon(outer, holes)
    except (ValidationError, TypeError):
        return [shape]
    except InvalidPolygonError:
        with suppress(InvalidPolygonError):  # the reader of scenes names the fault
            polygons = mended(source, [[outer, *holes]], role, name if isinstance(name, str) else None)
            rings = [polygon.exact_rings for polygon in polygons]
            return [{**members, "outer": outer, "holes": holes} for outer, *holes in rings] or [shape]
    return [shape]


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
