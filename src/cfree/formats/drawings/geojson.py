"""Read polygons from GeoJSON (RFC 7946) with their decimals as written.

A feature's property ``role`` gives its role, ``name`` names an obstacle; the robot's feature may have
``bounds``, ``start``, ``goal``, ``goals``, ``units`` and so on, as a scene has them. Other properties are ignored.
"""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, TypeAdapter, ValidationError

from cfree.errors import InvalidPolygonError
from cfree.formats.scenes.json_types import Point
from cfree.formats.scenes.scene_format import report
from cfree.formats.scenes.scene_settings import read_settings
from cfree.formats.scenes.scene_values import is_encodable
from cfree.formats.shapes import ROLES, Shape
from cfree.formats.text.findings import Findings
from cfree.formats.text.json_positions import Path
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import explained, flat_shape

# further coordinates, such as heights, are ignored as the RFC allows
_RINGS = TypeAdapter(list[list[Annotated[Point, BeforeValidator(lambda p: p[:2] if isinstance(p, list) else p)]]])
_CHILDREN = {"FeatureCollection": "features", "GeometryCollection": "geometries"}
_FLAT = ("Point", "MultiPoint", "LineString", "MultiLineString")


def geojson_shapes(findings: Findings, data: object, settings: dict[str, Any] | None = None) -> list[Shape]:
    """Read a feature, a geometry or a collection; faults go to `findings`, the robot's properties to `settings`."""
    shapes: list[Shape] = []
    waiting: list[tuple[Any, Path, str, str | None]] = [(data, (), "obstacle", None)]
    while waiting:
        value, path, role, name = waiting.pop()
        kind = str(value.get("type")) if isinstance(value, dict) else ""
        if kind == "Feature":
            properties = value.get("properties")
            role, name = _role_and_name(findings, properties, (*path, "properties"))
            if role == "robot" and settings is not None:
                settings |= read_settings(findings, properties, (*path, "properties"))
            place = (*path, "geometry") if "geometry" in value else path
            waiting.append((value.get("geometry"), place, role, name))
        elif kind in _CHILDREN:
            key = _CHILDREN[kind]
            children = value.get(key)
            if isinstance(children, list):
                waiting += [(child, (*path, key, k), role, name) for k, child in enumerate(children)][::-1]
            else:
                findings.under(path, f'a {kind} needs a list "{key}"')
        elif kind in ("Polygon", "MultiPolygon"):
            if "coordinates" not in value:
                findings.under(path, f'a {kind} needs "coordinates"')
                continue
            coordinates, place = value["coordinates"], (*path, "coordinates")
            parts: list[tuple[Any, Path]] = [(coordinates, place)]
            if kind == "MultiPolygon" and isinstance(coordinates, list):
                parts = [(rings, (*place, k)) for k, rings in enumerate(coordinates)]
            polygons = [_polygon(findings, rings, where) for rings, where in parts]
            shapes += [Shape(role, name, polygon) for polygon in polygons if polygon]
        elif kind in _FLAT:
            findings.under(path, flat_shape(kind))
        else:
            findings.under(path, "expected a GeoJSON feature or geometry with polygons, got {got}")
    return shapes


def _role_and_name(findings: Findings, properties: object, path: Path) -> tuple[str, str | None]:
    if not isinstance(properties, dict):
        return "obstacle", None
    role, name = properties.get("role", "obstacle"), properties.get("name")
    if role not in ROLES:
        findings.under((*path, "role"), f"expected one of {', '.join(ROLES)}, got {{got}}")
    if not isinstance(name, str | None) or not is_encodable(name or ""):
        findings.under((*path, "name"), "expected text in quotes, got {got}")
    return role, name


def _polygon(findings: Findings, rings: object, path: Path) -> Polygon | None:
    try:
        outer, *holes = _RINGS.validate_python(rings) or [[]]
        return Polygon(outer, holes)
    except ValidationError as error:
        for item in error.errors(include_url=False, include_input=False):
            report(findings, (*path, *item["loc"]), item)
    except InvalidPolygonError as error:
        findings.under((*path, error.ring) if error.ring is not None and rings else path, explained(error))
    return None
