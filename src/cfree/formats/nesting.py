"""Nesting: instances and layouts of strip packing, as the JSON of public sets has them.

Keys may be written ``placed_items`` or ``PlacedItems``. Placed items are obstacles, turned about the origin of their
shape, in radians, and then moved; the strip is the workspace where its length is known. Items without a layout have no
place: they are parts, of which a role may make one the robot.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from decimal import Decimal
from fractions import Fraction
from typing import Any

from pydantic import TypeAdapter, ValidationError

from cfree.errors import InvalidPolygonError, InvalidPoseError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.formats.json_positions import Path
from cfree.formats.json_types import Coordinate, Point
from cfree.formats.scene_format import report
from cfree.formats.shapes import IGNORE, PART, Shape, Shapes, shapes_of
from cfree.formats.source import Source
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import explained

_RING = TypeAdapter(list[Point])
_POINT = TypeAdapter(Point)
_NUMBER = TypeAdapter(Coordinate)
_SAME_ANGLE = 1e-5
"""Radians within which a turn is an allowed orientation: files have them in single precision."""


def read_nesting(source: Source, data: Any) -> Shapes:
    """What an instance, or an instance with its solution, says."""
    reader = _Reader(source)
    items = reader.items(data)
    placed = [shape for layout, path in reader.layouts(data) for shape in reader.placed(layout, path, items)]
    shapes = [shape for shape in placed if shape.role != IGNORE]
    wanted = source.reading.roles
    free = [(name, part, wanted.get(name, PART)) for name, _, parts in items.values() for part in parts]
    shapes += [Shape(role, name, part) for name, part, role in free if role != IGNORE and (role != PART or not placed)]
    if not placed and any(role == PART for _, _, role in free):
        source.dropped["items without a place: in no scene, unless a role says what they are"] += 1
    shapes += reader.strip(data)
    name = _member(data, "name")[0]
    settings = {"name": name} if isinstance(name, str) else {}
    remedy = 'give one, or give an item the role: roles={"item 0": "robot"}, --role "item 0=robot"'
    return shapes_of(source, "nesting", shapes, settings, remedy)


def _member(value: Any, *names: str) -> tuple[Any, str]:
    """The first member that there is, and its key."""
    for name in names:
        for key in (name, "".join(word.capitalize() for word in name.split("_"))):
            if isinstance(value, dict) and value.get(key) is not None:
                return value[key], key
    return None, names[0]


Item = tuple[str, list[float], list[Polygon]]


class _Reader:
    def __init__(self, source: Source) -> None:
        self.source = source
        self.findings = source.findings

    def items(self, data: Any) -> dict[int, Item]:
        """Name, allowed degrees and polygons, by id."""
        items, key = _member(data, "items")
        if not isinstance(items, list):
            self.findings.under((key,), "expected a list of items, got {got}")
            return {}
        found: dict[int, Item] = {}
        for k, item in enumerate(items):
            self.source.spend()
            number, _ = _member(item, "id")
            number = number if type(number) is int else k
            degrees, _ = _member(item, "allowed_orientations")
            allowed = [float(d) for d in degrees or () if isinstance(d, int | Decimal) and -(10**6) < d < 10**6]
            shape, at = _member(item, "shape")
            if number in found:
                self.findings.under((key, k), f"id {number} is there twice; keep one")
            found[number] = f"item {number}", allowed, self.polygons(shape, (key, k, at))
            demand, _ = _member(item, "demand")
            if type(demand) is int and demand > 1:
                self.source.changed["items that are wanted several times: once each"] += 1
        return found

    def polygons(self, shape: Any, path: Path) -> list[Polygon]:
        kind, _ = _member(shape, "type")
        data, key = _member(shape, "data")
        at = (*path, key)
        match str(kind).replace("_", "").lower():
            case "rectangle" if isinstance(data, dict):
                names = ("x_min", "y_min", "width", "height")
                x, y, w, h = (self.number(data, name, at) for name in names)
                return self.polygon([([(x, y), (x + w, y), (x + w, y + h), (x, y + h)], at)], at)
            case "simplepolygon":
                return self.polygon(self.rings([(data, at)]), at)
            case "polygon":
                return self.with_holes(data, at)
            case "multipolygon" if isinstance(data, list):
                return [polygon for k, part in enumerate(data) for polygon in self.with_holes(part, (*at, k))]
        self.findings.under(path, 'expected a shape {"type": "simple_polygon", "data": [[x, y], ...]}, got {got}')
        return []

    def with_holes(self, data: Any, path: Path) -> list[Polygon]:
        outer, key = _member(data, "outer")
        inner, holes = _member(data, "inner")
        rings = [(outer, (*path, key))]
        rings += [(ring, (*path, holes, k)) for k, ring in enumerate(inner if isinstance(inner, list) else ())]
        return self.polygon(self.rings(rings), path)

    def rings(self, given: list[tuple[Any, Path]]) -> list[tuple[list[ExactPoint], Path]]:
        found = []
        for ring, path in given:
            try:
                found.append((_RING.validate_python(ring), path))
            except ValidationError as error:
                self.report(error, path)
        return found if len(found) == len(given) else []

    def polygon(self, rings: list[tuple[list[ExactPoint], Path]], path: Path) -> list[Polygon]:
        """One, or none if something is wrong with it."""
        if not rings:
            return []
        try:
            return [Polygon(rings[0][0], [ring for ring, _ in rings[1:]])]
        except InvalidPolygonError as error:
            self.findings.under(path if error.ring is None else rings[error.ring][1], explained(error))
            return []

    def number(self, data: Any, name: str, path: Path) -> Fraction:
        value, key = _member(data, name)
        try:
            found: Fraction = _NUMBER.validate_python(value)
            return found
        except ValidationError as error:
            self.report(error, (*path, key) if value is not None else path)
            return Fraction(1)

    def report(self, error: ValidationError, path: Path) -> None:
        for item in error.errors(include_url=False, include_input=False):
            report(self.findings, (*path, *item["loc"]), item)

    def layouts(self, data: Any) -> Iterator[tuple[Any, Path]]:
        """The layout of the solution, wherever it is."""
        solution, key = _member(data, "solution")
        for value, path in ((data, ()), (solution, (key,))):
            single, at = _member(value, "layout")
            if single is not None:
                yield single, (*path, at)
            several, at = _member(value, "layouts")
            if isinstance(several, list) and several:
                if len(several) > 1:
                    self.source.dropped["layouts after the first"] += len(several) - 1
                yield several[0], (*path, at, 0)

    def placed(self, layout: Any, path: Path, items: dict[int, Item]) -> Iterator[Shape]:
        given, key = _member(layout, "placed_items")
        for k, one in enumerate(given if isinstance(given, list) else ()):
            self.source.spend()
            at = (*path, key, k)
            number, _ = _member(one, "item_id", "index")
            if type(number) is not int or number not in items:
                self.findings.under(at, "its item_id is no item's; give the id of an item")
                continue
            name, allowed, parts = items[number]
            pose = self.pose(_member(one, "transformation")[0], allowed, at)
            role = self.source.reading.roles.get(name, "obstacle")
            if role == "robot":
                continue  # it is in its own frame, not where it was placed
            for part in parts:
                outer, *holes = map(pose.apply_exact, part.exact_rings)
                yield Shape(role, name, Polygon(outer, holes))

    def pose(self, data: Any, allowed: list[float], path: Path) -> Pose:
        rotation, _ = _member(data, "rotation")
        translation, _ = _member(data, "translation")
        try:
            x, y = _POINT.validate_python(translation if translation is not None else [0, 0])
            turn: Fraction = _NUMBER.validate_python(rotation if rotation is not None else 0)
            if max(abs(x), abs(y)) > 10**100 or abs(turn) > 10**6:
                raise InvalidPoseError("a pose too far away; give one nearer")
            for degrees in allowed:
                if abs(math.remainder(float(turn) - math.radians(degrees), math.tau)) < _SAME_ANGLE:
                    return Pose(x, y, f"{degrees:.9g}deg")
            return Pose(x, y, turn)
        except ValidationError as error:
            self.report(error, path)
        except InvalidPoseError as error:
            self.findings.under(path, str(error))
        return Pose(0, 0)

    def strip(self, data: Any) -> list[Shape]:
        height, _ = _member(data, "strip_height")
        strip, _ = _member(data, "strip")
        if height is None and strip is not None:
            height, _ = _member(strip, "height")
        solution, where = _member(data, "solution")
        width, _ = _member(solution, "strip_width")
        if height is None or width is None:
            return []
        try:
            h, w = _NUMBER.validate_python(height), _NUMBER.validate_python(width)
            return [Shape("workspace", None, Polygon([(0, 0), (w, 0), (w, h), (0, h)]))]
        except (ValidationError, InvalidPolygonError):
            self.findings.under((where,), "strip_width and strip_height are no lengths; give numbers above 0")
            return []
