"""Read the footprints of robots in the parameters of nav2 and of ROS 1's navigation.

A costmap has a ``footprint``, or else a ``robot_radius``, and a ``footprint_padding``. TEB has a ``footprint_model``.
The polygons of the collision monitor are zones around the robot, unless a role says that one is the robot. Different
footprints of one file are parts of one robot: what each forbids is forbidden.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from cfree.curves.drawn import Ring, arc_of_circle
from cfree.curves.hulls import Outline, polygon_of
from cfree.errors import FormatError
from cfree.exact.number import to_fraction
from cfree.formats.drawings.footprints import footprint
from cfree.formats.drawings.source import Source, shapes_of, tolerance_of
from cfree.formats.drawings.yaml_nodes import above_zero, fault, mappings, members, written
from cfree.formats.padding import contains, padded
from cfree.formats.shapes import IGNORE, Shape, Shapes
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import AnyShape

ROBOT = "give one: --robot with a footprint or a file, or shapes.scene(robot)"
ROBOT_FRAME = "robot frame"
"""Key of a scene's source for the name of the robot's frame; "frame" has that of the world's."""
_MODEL = "footprint_model"
_FRAME = "robot_base_frame"
_MOST_COMPARED = 50


@dataclass(frozen=True)
class _Footprint:
    """The polygons of one robot, and their padding; None without one of its own."""

    polygons: tuple[Polygon, ...]
    padding: Fraction | None = None
    is_disc: bool = False


def read_parameters(source: Source, root: Any) -> Shapes:
    """Read all footprints at any depth."""
    reader = _Reader(source)
    for name, keys in mappings(source, root):
        reader.read(name, keys)
    source.findings.fail_if_any()
    different = list(dict.fromkeys(reader.footprints))
    if not different and not reader.zones:
        message = 'no "image" of a map, no "footprint" and no "robot_radius"; give one of them'
        if reader.others:
            message = f'no footprint; give one of the zones the role, such as --role "{reader.others[0]}=robot"'
        source.findings.at(0, "", message)
    if len(different) > 1:
        source.note("guess", "different footprint: the robot is all of them", "more", count=len(different))
    least = to_fraction(source.reading.padding)
    parts: list[AnyShape] = []
    for one in different:
        by = max(reader.padding if one.padding is None else one.padding, least)
        for polygon in one.polygons:
            for part in padded(source, polygon, by, one.is_disc):
                _add(parts, part)
    shapes = [Shape("robot", None, part) for part in parts] + reader.zones
    settings = {"units": "m", "source": {ROBOT_FRAME: reader.frame}}
    return shapes_of(source, "nav2 parameters", shapes, settings, ROBOT)


def _add(parts: list[AnyShape], part: AnyShape) -> None:
    """Add a part of the robot unless another one contains it, and drop those that it contains; of many keep all."""
    if isinstance(part, Polygon) and len(parts) < _MOST_COMPARED:
        plain = [other for other in parts if isinstance(other, Polygon)]
        if any(contains(other, part) for other in plain):
            return
        inside = [other for other in plain if contains(part, other)]
        parts[:] = [other for other in parts if other not in inside]
    parts.append(part)


class _Reader:
    def __init__(self, source: Source) -> None:
        self.source = source
        self.footprints: list[_Footprint] = []
        self.zones: list[Shape] = []
        self.others: list[str] = []
        self.frame = "base_link"
        self.padding = Fraction(0)  # the largest of mappings without a footprint

    def read(self, name: str, keys: dict[str, Any]) -> None:
        """Read one mapping of parameters."""
        if _FRAME in keys and (frame := written(self.source, keys[_FRAME])):
            self.frame = frame
        self.costmap(keys)
        model = members(keys.get(_MODEL)) or {
            key[len(_MODEL) + 1 :]: node for key, node in keys.items() if key.startswith((f"{_MODEL}.", f"{_MODEL}/"))
        }
        if model:
            self.teb(model)
        if "points" in keys or (self.text(keys, "type") == "circle" and "radius" in keys):
            self.zone(name, keys)

    def costmap(self, keys: dict[str, Any]) -> None:
        outline, radius = keys.get("footprint"), keys.get("robot_radius")
        has_outline = outline is not None and written(self.source, outline).strip() not in ("", "[]")
        polygon = None
        if has_outline:
            polygon = self.polygon(outline, "footprint")
            if radius is not None:
                self.source.note("info", "unused robot_radius: there is a footprint")
        elif radius is not None:
            polygon = self.disc(radius, "robot_radius")
        padding = self.padding_of(keys)
        if polygon:
            self.footprints.append(_Footprint((polygon,), padding, not has_outline))
        elif padding:
            self.padding = max(self.padding, padding)

    def padding_of(self, keys: dict[str, Any]) -> Fraction | None:
        node = keys.get("footprint_padding")
        if node is None:
            return None
        try:
            value = to_fraction(written(self.source, node))
            if abs(value) >= 10**9:
                raise ValueError("1e9 or more; give a shorter length")
        except ValueError as error:
            fault(self.source, node, "footprint_padding", str(error))
            return Fraction(0)
        if value < 0:
            self.source.note("info", "negative footprint_padding, not applied", "more", size=float(-value))
        return value

    def teb(self, model: dict[str, Any]) -> None:
        """Read a ``footprint_model``."""
        kind = self.text(model, "type").strip().lower()
        polygons: list[Polygon | None] = []
        if kind == "polygon" and "vertices" in model:
            polygons = [self.polygon(model["vertices"], f"{_MODEL}.vertices")]
        elif kind in ("circular", "circle") and "radius" in model:
            polygons = [self.disc(model["radius"], f"{_MODEL}.radius")]
        elif kind == "two_circles":
            for end, sign in (("front", 1), ("rear", -1)):
                if f"{end}_radius" not in model:
                    continue
                offset = self.number(model, f"{end}_offset") * sign
                polygons.append(self.disc(model[f"{end}_radius"], f"{_MODEL}.{end}_radius", float(offset)))
        else:
            what = "footprint_model without area" if kind in ("point", "line") else "footprint_model"
            self.source.note("lost", what, "less", where=kind[:40] or "no type", remedy="--robot")
        if solid := tuple(polygon for polygon in polygons if polygon):
            self.footprints.append(_Footprint(solid, is_disc="circ" in kind))

    def zone(self, name: str, keys: dict[str, Any]) -> None:
        """Read a polygon or circle of the collision monitor, if it has a role."""
        role = self.source.wanted_role(name)
        if role is None:
            self.others.append(name)
            remedy = f'--role "{name}=robot"'
            self.source.note("hidden", "zone without a role", where=name, remedy=remedy)
        if role is None or role == IGNORE:
            return
        polygon = self.polygon(keys["points"], name) if "points" in keys else self.disc(keys["radius"], name)
        if polygon and role == "robot":
            self.footprints.append(_Footprint((polygon,), is_disc="points" not in keys))
        elif polygon:
            self.zones.append(Shape(role, name, polygon))

    def polygon(self, node: Any, key: str) -> Polygon | None:
        """Read points in text, or in lists of pairs or of numbers."""
        text = written(self.source, node)
        numbers = text.strip("[] ").split(",")
        if text.count("[") == 1 and len(numbers) % 2 == 0:
            text = f"[{', '.join(f'[{x}, {y}]' for x, y in zip(numbers[::2], numbers[1::2], strict=True))}]"
        try:
            return footprint(text)
        except FormatError as error:
            fault(self.source, node, key, str(error).removeprefix("footprint: "))
            return None

    def disc(self, node: Any, key: str, x: float = 0.0) -> Polygon | None:
        """Read a radius, and return a polygon around the disc."""
        try:
            radius = float(above_zero(written(self.source, node)))
        except ValueError as error:
            fault(self.source, node, key, str(error))
            return None
        ring: Ring = [arc_of_circle((x, 0.0), radius)]
        tolerance = tolerance_of(self.source, [ring])
        self.source.note("near", "polygon around a disc", "near", where=key, size=tolerance, remedy="--tolerance")
        return polygon_of(Outline(ring), tolerance, spend=self.source.spend)

    def number(self, keys: dict[str, Any], key: str) -> Fraction:
        if key not in keys:
            return Fraction(0)
        try:
            value = to_fraction(written(self.source, keys[key]))
            if abs(value) >= 10**9:
                raise ValueError("1e9 or more; give a shorter length")
            return value
        except ValueError as error:
            fault(self.source, keys[key], key, str(error))
            return Fraction(0)

    def text(self, keys: dict[str, Any], key: str) -> str:
        return written(self.source, keys[key]) if key in keys else ""
