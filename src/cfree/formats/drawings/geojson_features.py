"""Read the polygons of GeoJSON features while the file is decoded, so that their numbers need not be kept.

A feature in which anything may be wrong stays as it is: `geojson.py` reads it with its faults and their places.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import cfree._core as _core
from cfree.errors import InvalidPolygonError
from cfree.formats.scenes.scene_values import Named, shape_at_once
from cfree.formats.text.json_text import with_numbers
from cfree.polygons.polygon import Polygon, polygon_of

_KEYS = frozenset({"type", "id", "bbox", "properties", "geometry"})


@dataclass(frozen=True, slots=True)
class ReadFeature:
    """A feature with its properties, and the polygons of its geometry."""

    properties: Any
    polygons: tuple[Polygon, ...]


class AtOnce:
    """Make values of decoded JSON objects: shapes of scenes, and features of GeoJSON.

    Attributes
    ----------
    keeps_properties : bool
        False if a value was made of a part of a feature's properties, which are then not as written.
    """

    def __init__(self) -> None:
        self.keeps_properties = True

    def __call__(self, members: dict[str, Any]) -> object:
        """Return the value of an object, or the object as it is."""
        if members.get("type") != "Feature":
            return shape_at_once(members)
        if _is_made(members.get("properties")):
            self.keeps_properties = False
        polygons = _polygons(members.get("geometry")) if members.keys() <= _KEYS else ()
        return ReadFeature(with_numbers(members.get("properties")), polygons) if polygons else members


def _is_made(value: Any) -> bool:
    """True if a value was made of an object in decoded JSON."""
    waiting = [value]
    while waiting:
        part = waiting.pop()
        if isinstance(part, (Polygon, Named, ReadFeature)):
            return True
        if isinstance(part, (list, dict)):
            waiting += part.values() if isinstance(part, dict) else part
    return False


def _polygons(geometry: Any) -> tuple[Polygon, ...]:
    """Return the polygons of a geometry without a fault; none of others."""
    if not isinstance(geometry, dict) or not isinstance(coordinates := geometry.get("coordinates"), list):
        return ()
    kind = geometry.get("type")
    parts = [coordinates] if kind == "Polygon" else coordinates if kind == "MultiPolygon" else []
    polygons = tuple(map(_polygon, parts))
    return () if None in polygons else polygons  # type: ignore[return-value]


def _polygon(rings: Any) -> Polygon | None:
    """Return the polygon of rings; further coordinates of points, such as heights, are ignored."""
    try:
        core = _core.Polygon.of(rings)
        if core is None and isinstance(rings, list) and all(isinstance(ring, list) for ring in rings):
            core = _core.Polygon.of([[p[:2] if isinstance(p, list) else p for p in ring] for ring in rings])
    except InvalidPolygonError:
        return None
    return None if core is None else polygon_of(core)
