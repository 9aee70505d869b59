"""Repair the polygons of a JSON scene before it is read, with the option `repair`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from cfree.exact.number import ExactPoint, to_fraction
from cfree.formats.drawings.mending import mended
from cfree.formats.drawings.source import Source

_ROLES = {"robot": "robot", "obstacles": "obstacle", "workspace": "workspace"}


def repaired_scene(source: Source, data: Mapping[str, Any]) -> dict[str, Any]:
    """Return a decoded scene whose polygons are united by their fill rule; round shapes and faults stay as they are."""
    result = dict(data)
    for key, role in _ROLES.items():
        value = result.get(key)
        items = value if isinstance(value, list) and not _is_ring(value) else [value]
        shapes = [shape for item in items for shape in _repaired(source, item, role)]
        if value is not None:
            result[key] = shapes if key == "obstacles" or len(shapes) > 1 else shapes[0]
    return result


def _repaired(source: Source, item: Any, role: str) -> list[Any]:
    name = item.get("name") if isinstance(item, dict) else None
    rings = [item] if _is_ring(item) else _rings(item)
    try:
        points = [[_point(point) for point in ring] for ring in rings]
    except (TypeError, ValueError):
        return [item]
    if not points or any(len(ring) < 3 for ring in points):
        return [item]
    polygons = mended(source, [points], role, name if isinstance(name, str) else None)
    named = {} if name is None else {"name": name}
    return [{"outer": outer, "holes": holes} | named for outer, *holes in (p.exact_rings for p in polygons)] or [item]


def _rings(item: Any) -> list[Any]:
    is_polygon = isinstance(item, dict) and item.keys() <= {"outer", "holes", "name"} and _is_ring(item.get("outer"))
    return [item["outer"], *item.get("holes", [])] if is_polygon else []


def _is_ring(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(p, list) and len(p) == 2 for p in value)


def _point(point: Any) -> ExactPoint:
    x, y = map(to_fraction, point)
    return x, y
