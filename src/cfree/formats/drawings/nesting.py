"""Read nesting: instances and layouts of strip packing in the JSON of public sets.

Keys may be written ``placed_items`` or ``PlacedItems``. Placed items are obstacles, turned about the origin of their
shape, in radians, and then moved; the strip is the workspace if its length is known. Items without a layout have no
place: they are parts, and a role can make one of them the robot.
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
from cfree.formats.drawings.mending import mended, repairable
from cfree.formats.drawings.source import Source, shapes_of
from cfree.formats.scenes.json_types import Coordinate, Point
from cfree.formats.scenes.scene_format import report
from cfree.formats.shapes import IGNORE, PART, Shape, Shapes
from cfree.formats.text.json_positions import Path
from cfree.polygons.polygon import Polygon

_RING = TypeAdapter(list[Point])
_POINT = TypeAdapter(Point)
_NUMBER = TypeAdapter(Coordinate)
_SAME_ANGLE = 1e-5
"""Tolerance in radians of allowed orientations: files give angles in single precision."""


def read_nesting(source: Source, data: Any) -> Shapes:
    """Read an instance, or an instance with its solution."""
    reader = NestingReader(source)
    items = reader.items(data)
    placed = [shape for layout, path in reader.layouts(data) for shape in reader.placed(layout, path, items)]
    shapes = [shape for shape in placed if shape.role != IGNORE]
    free = [(name, part, source.wanted_role(name) or PART) for name, _, parts in items.values() for part in parts]
    shapes += [Shape(role, name, part) for name, part, role in free if role != IGNORE and (role != PART or not placed)]
    parts = {name for name, _, role in free if role == PART} - {shape.name for shape in placed}
    remedy = '--role "item 0=robot"'
    source.note("lost", "item without a place, in no scene", "less", count=len(parts), remedy=remedy)
    for name in dict.fromkeys(name for name, _, role in free if role == IGNORE):
        source.note("assumption", "ignored item", "less", where=name)
    shapes += reader.strip(data)
    name = _member(data, "name")[0]
    settings = {"name": name} if isinstance(name, str) else {}
    remedy = 'give one, or give an item the role: roles={"item 0": "robot"}, --role "item 0=robot"'
    return shapes_of(source, "nesting", shapes, settings, remedy)


def _member(value: Any, *names: str) -> tuple[Any, str]:
    """Return the first of some members that is present, and its key."""
    for name in names:
        for key in (name, "".join(word.capitalize() for word in name.split("_"))):
            if isinstance(value, dict) and value.get(key) is not None:
                return value[key], key
    return None, names[0]


MOST_DEGREES = 10**6
Item = tuple[str, list[float], list[Polygon]]


class NestingReader:
    """Read the parts of the JSON of an instance; faults are collected."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.findings = source.findings
        self.demand: dict[int, int] = {}

    def items(self, data: Any) -> dict[int, Item]:
        """Return name, allowed degrees and polygons of items by id."""
        items, key = _member(data, "items")
        if not isinstance(items, list):
            self.findings.under((key,), "expected a list of items, got {got}")
            return {}
        by_id: dict[int, Item] = {}
        for k, item in enumerate(items):
            self.source.spend()
            number, _ = _member(item, "id")
            number = number if type(number) is int else k
            allowed = self._degrees(item, (key, k))
            shape, shape_key = _member(item, "shape")
            if number in by_id:
                self.findings.under((key, k), f"id {number} is there twice; keep one")
            by_id[number] = f"item {number}", allowed, self.polygons(shape, (key, k, shape_key))
            demand = self._count(item, "demand", (key, k))
            self.demand[number] = 1 if demand is None else demand
            if self.demand[number] < 0:
                self.findings.under((key, k, "demand"), "expected a number of copies, 0 or more, got {got}")
            if self.demand[number] > 1:
                self.source.note("info", "item, wanted several times and read once")
        return by_id

    def bins(self, data: Any) -> dict[int, tuple[int, list[Polygon]]]:
        """Return stock, -1 if it has no limit, and polygons of bins by id; `containers` and `objects` are bins."""
        bins, key = _member(data, "bins", "containers", "objects")
        by_id: dict[int, tuple[int, list[Polygon]]] = {}
        for k, one in enumerate(bins if isinstance(bins, list) else ()):
            self.source.spend()
            number, stock = _member(one, "id")[0], self._count(one, "stock", (key, k))
            shape, shape_key = _member(one, "shape")
            polygons = self.polygons(shape, (key, k, shape_key))
            stock = -1 if stock is None else max(-1, stock)
            by_id[number if type(number) is int else k] = stock, polygons
        return by_id

    def _count(self, item: Any, name: str, path: tuple[Any, ...]) -> int | None:
        """Return a whole number; None without one."""
        value, key = _member(item, name)
        if value is None or type(value) is int:
            return value
        self.findings.under((*path, key), "expected a whole number, got {got}")
        return None

    def _degrees(self, item: Any, path: tuple[Any, ...]) -> list[float]:
        value, key = _member(item, "allowed_orientations")
        degrees = [] if value is None else value
        if isinstance(degrees, list) and all(type(d) in (int, Decimal) and abs(d) < MOST_DEGREES for d in degrees):
            return [float(d) for d in degrees]
        self.findings.under((*path, key), "expected a list of angles in degrees, got {got}")
        return []

    def strip_height(self, data: Any) -> Fraction | None:
        """Return the height of the strip; None if the instance has none."""
        height, key = _member(data, "strip_height")
        strip, strip_key = _member(data, "strip")
        if height is None and strip is not None:
            height, key = _member(strip, "height")[0], strip_key
        if height is None:
            return None
        try:
            value: Fraction = _NUMBER.validate_python(height)
        except ValidationError as error:
            self.report(error, (key,))
            return None
        if value <= 0:
            self.findings.under((key,), "the height of a strip; give a number above 0")
            return None
        return value

    def strip_width(self, data: Any) -> Fraction | None:
        """Return the length of the strip that the solution uses; None without one."""
        try:
            width = _member(_member(data, "solution")[0], "strip_width")[0]
            value: Fraction | None = None if width is None else _NUMBER.validate_python(width)
        except ValidationError:
            return None
        return value if value and value > 0 else None

    def all_layouts(self, data: Any) -> Iterator[tuple[Any, list[Any], Path]]:
        """Yield the container's id, the placed items, and their place in the file, of each layout of the solution."""
        solution, key = _member(data, "solution")
        for value, path in ((data, ()), (solution, (key,))):
            single, inner = _member(value, "layout")
            several, many = _member(value, "layouts")
            layouts = [(single, (*path, inner))] if single is not None else []
            layouts += [(one, (*path, many, k)) for k, one in enumerate(several if isinstance(several, list) else ())]
            for layout, place in layouts:
                container, _ = _member(layout, "container_id", "bin_id", "object_id")
                rows, rows_key = _member(layout, "placed_items")
                yield container, rows if isinstance(rows, list) else [], (*place, rows_key)

    def place_of(self, one: Any, items: dict[int, Item], path: Path) -> tuple[int, Pose] | None:
        """Return id and pose of a placed item; None if it is no item."""
        self.source.spend()
        number, _ = _member(one, "item_id", "index")
        if type(number) is not int or number not in items:
            self.findings.under(path, "its item_id is no item's; give the id of an item")
            return None
        return number, self.pose(_member(one, "transformation")[0], items[number][1], path)

    def polygons(self, shape: Any, path: Path) -> list[Polygon]:
        kind, _ = _member(shape, "type")
        data, key = _member(shape, "data")
        place = (*path, key)
        match str(kind).replace("_", "").lower():
            case "rectangle" if isinstance(data, dict):
                names = ("x_min", "y_min", "width", "height")
                x, y, w, h = (self.number(data, name, place) for name in names)
                return self.polygon([([(x, y), (x + w, y), (x + w, y + h), (x, y + h)], place)], place)
            case "simplepolygon":
                return self.polygon(self.rings([(data, place)]), place)
            case "polygon":
                return self.with_holes(data, place)
            case "multipolygon" if isinstance(data, list):
                return [polygon for k, part in enumerate(data) for polygon in self.with_holes(part, (*place, k))]
        self.findings.under(path, 'expected a shape {"type": "simple_polygon", "data": [[x, y], ...]}, got {got}')
        return []

    def with_holes(self, data: Any, path: Path) -> list[Polygon]:
        outer, key = _member(data, "outer")
        inner, holes = _member(data, "inner")
        rings = [(outer, (*path, key))]
        rings += [(ring, (*path, holes, k)) for k, ring in enumerate(inner if isinstance(inner, list) else ())]
        return self.polygon(self.rings(rings), path)

    def rings(self, rings: list[tuple[Any, Path]]) -> list[tuple[list[ExactPoint], Path]]:
        read = []
        for ring, path in rings:
            try:
                read.append((_RING.validate_python(ring), path))
            except ValidationError as error:
                self.report(error, path)
        return read if len(read) == len(rings) else []

    def polygon(self, rings: list[tuple[list[ExactPoint], Path]], path: Path) -> list[Polygon]:
        """Return one polygon, or none if it has a fault."""
        if not rings:
            return []
        if self.source.reading.repair:
            return mended(self.source, [[ring for ring, _ in rings]], "obstacle")
        try:
            return [Polygon(rings[0][0], [ring for ring, _ in rings[1:]])]
        except InvalidPolygonError as error:
            self.findings.under(path if error.ring is None else rings[error.ring][1], repairable(error))
            return []

    def number(self, data: Any, name: str, path: Path) -> Fraction:
        value, key = _member(data, name)
        try:
            number: Fraction = _NUMBER.validate_python(value)
            return number
        except ValidationError as error:
            self.report(error, (*path, key) if value is not None else path)
            return Fraction(1)

    def report(self, error: ValidationError, path: Path) -> None:
        for item in error.errors(include_url=False, include_input=False):
            report(self.findings, (*path, *item["loc"]), item)

    def layouts(self, data: Any) -> Iterator[tuple[Any, Path]]:
        """Yield the layout of the solution from any of its places."""
        solution, key = _member(data, "solution")
        for value, path in ((data, ()), (solution, (key,))):
            single, inner = _member(value, "layout")
            if single is not None:
                yield single, (*path, inner)
            several, inner = _member(value, "layouts")
            if isinstance(several, list) and several:
                if len(several) > 1:
                    self.source.note("lost", "layout after the first", "less", count=len(several) - 1)
                yield several[0], (*path, inner, 0)

    def placed(self, layout: Any, path: Path, items: dict[int, Item]) -> Iterator[Shape]:
        rows, key = _member(layout, "placed_items")
        robots: set[str] = set()
        for k, one in enumerate(rows if isinstance(rows, list) else ()):
            self.source.spend()
            place = (*path, key, k)
            number, _ = _member(one, "item_id", "index")
            if type(number) is not int or number not in items:
                self.findings.under(place, "its item_id is no item's; give the id of an item")
                continue
            name, allowed, parts = items[number]
            pose = self.pose(_member(one, "transformation")[0], allowed, place)
            role = self.source.wanted_role(name) or "obstacle"
            if role == "robot":  # it stays in its own frame
                is_first, robots = name not in robots, robots | {name}
                if is_first:
                    self.source.note("info", "unread place: its item is the robot", where=name)
                else:
                    self.source.note("lost", "further copy of the robot's item", "less", where=name)
                continue
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
            self.source.note("info", "strip without a length, no workspace", "less", count=int(height is not None))
            return []
        try:
            h, w = _NUMBER.validate_python(height), _NUMBER.validate_python(width)
            return [Shape("workspace", None, Polygon([(0, 0), (w, 0), (w, h), (0, h)]))]
        except (ValidationError, InvalidPolygonError):
            self.findings.under((where,), "strip_width and strip_height are no lengths; give numbers above 0")
            return []
