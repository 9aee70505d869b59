"""Read polygons from GeoJSON (RFC 7946) with their decimals as written, and lines and points of a width as walls.

A feature's property ``role`` gives its role, ``name`` names an obstacle; the robot's feature may have ``bounds``,
``start``, ``goal``, ``goals``, ``units`` and so on, as a scene has them. A line may have a ``width``, a point a
``radius``. Other properties are ignored.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Annotated, Any

from pydantic import BeforeValidator, TypeAdapter, ValidationError

from cfree.curves.drawn import Line, points_along
from cfree.errors import InvalidPolygonError
from cfree.exact.number import ExactPoint
from cfree.formats.drawings.content import Curve
from cfree.formats.drawings.geojson_features import ReadFeature
from cfree.formats.drawings.mending import mended, repairable
from cfree.formats.drawings.source import CURVE_SHARE, Source
from cfree.formats.drawings.strokes import LEAST_SHARE, disc, length_of, usual_width, wall
from cfree.formats.scenes.json_types import Coordinate, Point
from cfree.formats.scenes.scene_format import report
from cfree.formats.scenes.scene_settings import read_settings
from cfree.formats.scenes.scene_values import is_encodable
from cfree.formats.shapes import IGNORE, ROLES, Shape
from cfree.formats.text.findings import Findings
from cfree.formats.text.json_positions import Path
from cfree.polygons.polygon import Polygon
from cfree.scene.reading import Kind
from cfree.scene.scene import explained, flat_shape

# further coordinates, such as heights, are ignored as the RFC allows
_POINT = Annotated[Point, BeforeValidator(lambda p: p[:2] if isinstance(p, list) else p)]
_POINTS = TypeAdapter(list[_POINT])
_RINGS = TypeAdapter(list[list[_POINT]])
_LENGTH = TypeAdapter(Coordinate)
_CHILDREN = {"FeatureCollection": "features", "GeometryCollection": "geometries"}
_FLAT = {"Point": 0, "MultiPoint": 1, "LineString": 0, "MultiLineString": 1}
"""Depth of the lists of single geometries."""
_LONGEST = 10**150
"""Bound of coordinates and widths of lines."""


@dataclass(frozen=True, slots=True)
class _Feature:
    """The feature around a geometry."""

    role: str = "obstacle"
    name: str | None = None
    properties: object = None
    path: Path = ()


def geojson_shapes(
    findings: Findings, data: object, settings: dict[str, Any] | None = None, source: Source | None = None
) -> list[Shape]:
    """Read a feature, a geometry or a collection.

    Parameters
    ----------
    findings : Findings
        For faults.
    data : object
        JSON with exact numbers; features may be read already.
    settings : dict, optional
        For the robot's properties.
    source : Source, optional
        For notes, and with options of reading; without it, lines and points are faults.
    """
    shapes: list[Shape] = []
    waiting: list[Iterator[_Part]] = [iter([(data, (), _Feature())])]  # the innermost collection last
    while waiting:
        if (part := next(waiting[-1], None)) is None:
            waiting.pop()
            continue
        value, path, feature = part
        is_read = isinstance(value, ReadFeature)
        kind = "Feature" if is_read else str(value.get("type")) if isinstance(value, dict) else ""
        if source is not None:
            source.spend()
        if kind == "Feature":
            properties = value.properties if is_read else value.get("properties")
            feature = _feature(findings, properties, (*path, "properties"), source)
            if feature.role == IGNORE:
                continue
            if feature.role == "robot" and settings is not None:
                settings |= read_settings(findings, feature.properties, feature.path)
            if is_read:
                if source is not None:
                    source.spend()  # the geometry
                shapes += [Shape(feature.role, feature.name, polygon) for polygon in value.polygons]
                continue
            place = (*path, "geometry") if "geometry" in value else path
            if value.get("geometry", 0) is None and source is not None:
                source.note("info", "feature without a geometry", where=feature.name or "")
            else:
                waiting.append(iter([(value.get("geometry"), place, feature)]))
        elif kind in _CHILDREN:
            key = _CHILDREN[kind]
            children = value.get(key)
            if isinstance(children, list):
                waiting.append(_parts(children, (*path, key), feature))
            else:
                findings.under(path, f'a {kind} needs a list "{key}"')
        elif kind in ("Polygon", "MultiPolygon"):
            if "coordinates" not in value:
                findings.under(path, f'a {kind} needs "coordinates"')
                continue
            coordinates, place = value["coordinates"], (*path, "coordinates")
            if source is not None and coordinates == []:
                source.note("info", "geometry without coordinates", where=feature.name or "")
                continue
            parts: list[tuple[Any, Path]] = [(coordinates, place)]
            if kind == "MultiPolygon" and isinstance(coordinates, list):
                parts = [(rings, (*place, k)) for k, rings in enumerate(coordinates)]
            polygons = _polygons(findings, parts, feature, source)
            shapes += [Shape(feature.role, feature.name, polygon) for polygon in polygons]
        elif kind in _FLAT:
            if source is None:
                findings.under(path, flat_shape(kind))
            else:
                flat = _Flat(source, findings, kind, (*path, "coordinates"), feature)
                shapes += [Shape(feature.role, feature.name, polygon) for polygon in flat.read(value)]
        else:
            findings.under(path, "expected a GeoJSON feature or geometry with polygons, got {got}")
    return shapes


_Part = tuple[Any, Path, _Feature]
"""A value, its place, and the feature around it."""


def _parts(children: list[Any], path: Path, feature: _Feature) -> Iterator[_Part]:
    """Yield the parts of a collection."""
    for k, child in enumerate(children):
        yield child, (*path, k), feature


def _feature(findings: Findings, properties: object, path: Path, source: Source | None) -> _Feature:
    """Return role and name of a feature; the options of reading count before the property."""
    if not isinstance(properties, dict):
        return _Feature()
    role, name = properties.get("role", "obstacle"), properties.get("name")
    if not isinstance(name, str | None) or not is_encodable(name or ""):
        findings.under((*path, "name"), "expected text in quotes, got {got}")
        name = None
    wanted = source.wanted_role(name) if source and name else None
    if wanted == IGNORE or (wanted is None and role == IGNORE):
        if source is not None:
            kind: Kind = "assumption" if wanted else "hidden"
            source.note(kind, "feature that is ignored", "less" if wanted else "none", where=name or "")
        return _Feature(IGNORE, name, properties, path)
    if wanted is None and role not in ROLES:
        findings.under((*path, "role"), f"expected one of {', '.join((*ROLES, IGNORE))}, got {{got}}")
    return _Feature(wanted or role, name, properties, path)


def _polygons(
    findings: Findings, parts: list[tuple[Any, Path]], feature: _Feature, source: Source | None
) -> list[Polygon]:
    """Return the polygons of a geometry; with the option `repair`, their union."""
    rings = [(_rings(findings, part, path), path) for part, path in parts]
    if source is not None and source.reading.repair:
        whole = [part for part, _ in rings if part and part[0]]
        try:
            return mended(source, whole, feature.role, feature.name) if whole and not findings else []
        except InvalidPolygonError as error:
            findings.under(parts[0][1], explained(error))
            return []
    return [polygon for part, path in rings if part is not None and (polygon := _polygon(findings, part, path, source))]


def _rings(findings: Findings, value: object, path: Path) -> list[list[ExactPoint]] | None:
    try:
        return _RINGS.validate_python(value) or [[]]
    except ValidationError as error:
        for item in error.errors(include_url=False, include_input=False):
            report(findings, (*path, *item["loc"]), item)
    return None


def _polygon(findings: Findings, rings: list[list[ExactPoint]], path: Path, source: Source | None) -> Polygon | None:
    try:
        outer, *holes = rings
        return Polygon(outer, holes)
    except InvalidPolygonError as error:
        message = repairable(error) if source else explained(error)
        findings.under((*path, error.ring) if error.ring is not None and rings != [[]] else path, message)
    return None


@dataclass(frozen=True, slots=True)
class _Flat:
    """A point, a line, or several of them."""

    source: Source
    findings: Findings
    kind: str
    path: Path
    feature: _Feature

    def read(self, geometry: dict[str, Any]) -> list[Polygon]:
        """Return the polygons around a geometry's lines or points, if they have a width; else note them."""
        if "coordinates" not in geometry:
            self.findings.under(self.path[:-1], f'a {self.kind} needs "coordinates"')
            return []
        is_point = self.kind.endswith("Point")
        coordinates = geometry["coordinates"]
        if self.kind == "Point":
            coordinates = [coordinates]
        parts = coordinates if self.kind == "MultiLineString" and isinstance(coordinates, list) else [coordinates]
        lines = [self.points(part, (*self.path, k) if len(parts) > 1 else self.path) for k, part in enumerate(parts)]
        if is_point:
            lines = [[p] for line in lines for p in line]
        half = self.half_width("radius" if is_point else "width")
        try:
            return [polygon for line in lines if line for polygon in self.wall(line, half, is_point=is_point)]
        except InvalidPolygonError as error:
            self.findings.under(self.path, explained(error))
            return []

    def points(self, value: object, path: Path) -> list[ExactPoint]:
        try:
            points = _POINTS.validate_python(value)
            if all(abs(x) < _LONGEST for point in points for x in point):
                return points
            self.findings.under(path, "a coordinate beyond 1e150; scale the drawing")
        except ValidationError as error:
            for item in error.errors(include_url=False, include_input=False):
                report(self.findings, (*path, *item["loc"]), item)
        return []

    def half_width(self, key: str) -> Fraction:
        """Return half the width of a line, or the radius of a point; 0 if there is none."""
        properties, strokes = self.feature.properties, self.source.reading.strokes
        if isinstance(properties, dict) and properties.get(key) is not None:
            try:
                length = _LENGTH.validate_python(properties[key])
            except ValidationError:
                length = Fraction(-1)
            if 0 <= length < _LONGEST:
                return length if key == "radius" else length / 2
            self.findings.under((*self.feature.path, key), "expected a length, 0 or more, below 1e150, got {got}")
        if key == "width" and isinstance(strokes, (int, float)):
            return Fraction(str(strokes)) / 2
        return Fraction(0)

    def wall(self, line: list[ExactPoint], half: Fraction, *, is_point: bool) -> list[Polygon]:
        segments = [Line(a, b) for a, b in pairwise(line) if a != b]
        closed = len(segments) > 2 and line[0] == line[-1]
        curve = Curve(list(segments), closed)
        at, name = (float(line[0][0]), float(line[0][1])), self.feature.name or ""
        if not half:
            if is_point:
                self.source.note("lost", "point without a radius", "less", where=name, at=at)
            else:
                remedy = f"--strokes {usual_width([curve]):g}" if segments else ""
                size, points = (length_of(curve.segments), points_along(curve.segments)) if segments else (0.0, [])
                self.source.note(
                    "lost", "open line", "less", where=name, at=at, size=size, remedy=remedy, points=points
                )
            return []
        if self.feature.role == "workspace":
            self.findings.under(self.path[:-1], f"a workspace needs a Polygon, and this is a {self.kind}")
            return []
        if not segments:
            error = self.source.reading.tolerance or float(half) * 4 / CURVE_SHARE
            size = max(error, float(half) * LEAST_SHARE)
            self.source.note("near", "point with a radius", "near", where=name, size=size)
            return [disc(line[0], half, error)]
        return wall(self.source, curve, [(2 * half, 2 * half)] * len(segments), "round", name)
