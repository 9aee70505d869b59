"""Read the values of JSON scenes, each with its fault; `docs/scene-format.md` describes them.

`scene_from_plain` reads only scenes without faults, which are nearly all. `scene_format.py` finds all faults and their
places, which takes longer.
"""

from __future__ import annotations

from collections.abc import Callable, Set
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from math import isfinite
from types import NoneType
from typing import Any

import cfree._core as _core
from cfree.errors import CfreeError, InvalidPolygonError, InvalidPoseError
from cfree.exact.half_angle import require_unit
from cfree.exact.number import LARGEST, to_fraction
from cfree.exact.pose import Pose
from cfree.formats.text.json_text import Literal, number_of
from cfree.polygons.polygon import Polygon, polygon_of
from cfree.scene.goals import Goal
from cfree.scene.scene import Scene
from cfree.vehicles.vehicle import Car, DifferentialDrive, Vehicle

VERSION = 1
MAX_NESTING = 32
MAX_NAME = 1000
MAX_TEXT = 100_000
POLYGON = frozenset({"outer", "holes"})
OBSTACLE = POLYGON | {"name"}


class Fault(ValueError):
    """A fault of a value, or of a part within it; ``{got}`` in the message becomes the value as written in the file."""

    def __init__(self, message: str, within: tuple[str | int, ...] = ()) -> None:
        super().__init__(message)
        self.within = within


def coordinate(value: object) -> Fraction:
    if isinstance(value, (int, Decimal, str)) and not isinstance(value, bool):
        try:
            return to_fraction(value)
        except ValueError as error:
            if "is no number" not in str(error):
                raise Fault(str(error).replace(repr(value), "{got}")) from None
    raise Fault('expected a number or "p/q", got {got}')


def list_of(length: int, form: str) -> Callable[[object], list[Any]]:
    """Return a check of lists of a fixed length."""

    def check(value: object) -> list[Any]:
        if isinstance(value, list) and len(value) == length:
            return value
        raise Fault(f"expected {form}, got {{got}}")

    return check


def angle(value: Any) -> Any:
    """Return an angle that `Pose` accepts; a check of its own gives a fault its place."""
    value = number_of(value) if isinstance(value, Literal) else value
    if isinstance(value, (int, Decimal, str, dict)) and not isinstance(value, bool) and value != {"tau": None}:
        try:
            Pose(0, 0, value)
            if isinstance(value, str):
                require_unit(value)
            return value
        except InvalidPoseError as error:
            if "is no " not in str(error):
                raise Fault(str(error).replace(repr(value), "{got}")) from None
    raise Fault('expected radians, "90deg" or {"tau": "p/q"}, got {got}')


def pose(value: tuple[Fraction, Fraction, Any]) -> Pose:
    if max(abs(value[0]), abs(value[1])) > LARGEST:
        raise Fault("a position beyond 1e150; give one nearer to the scene")
    return Pose(*value)


def place(value: tuple[Fraction, Fraction]) -> tuple[Fraction, Fraction]:
    pose((*value, 0))
    return value


VEHICLES: dict[str, tuple[str, ...]] = {
    "car": ("type", "turning_radius", "axle", "heading", "gears", "wheelbase"),
    "differential": ("type", "axle", "heading"),
}


def vehicle(value: Any) -> Vehicle:
    """Return a car or a differential drive."""
    if not isinstance(value, dict):
        raise Fault('expected a vehicle {"type": "car" or "differential", ...}, got {got}')
    if "type" not in value:
        raise Fault('key "type" is missing; add "car" or "differential"')
    kind = value["type"]
    if not isinstance(kind, str) or kind not in VEHICLES:
        remedy = '; a forklift is a "differential" about its fixed axle' if kind == "forklift" else ""
        raise Fault(f'expected "car" or "differential", got {{got}}{remedy}', ("type",))
    keys = VEHICLES[kind]
    for key in value:
        if key not in keys:
            from difflib import get_close_matches

            guess = get_close_matches(key, keys, 1)
            remedy = f'did you mean "{guess[0]}"?' if guess else f"the keys here are {', '.join(keys)}"
            raise Fault(f'unknown key "{key[:40]}"; {remedy}', (key,))
    if kind == "car" and "turning_radius" not in value:
        raise Fault('key "turning_radius" is missing; add it')
    members = {key: _member(key, value[key]) for key in keys[1:] if key in value}
    return Car(**members) if kind == "car" else DifferentialDrive(**members)


def _member(key: str, value: Any) -> Any:
    """Return a member of a vehicle; a fault has its place."""
    try:
        value = _MEMBERS[key](value)
        Car(**{"turning_radius": 1, key: value})
    except Fault as fault:
        raise Fault(str(fault), (key, *fault.within)) from None
    except (TypeError, ValueError) as error:
        raise Fault(str(error).removeprefix(f"{key}: "), (key,)) from None
    return value


def _radius(value: Any) -> Any:
    if isinstance(value, list):
        return _numbers("a length, or two as [left, right]")(value)
    return coordinate(value)


def _numbers(form: str) -> Callable[[Any], tuple[Fraction, Fraction]]:
    """Return a reader of two numbers; a fault in one of them has its place."""
    check = list_of(2, form)

    def read(value: Any) -> tuple[Fraction, Fraction]:
        numbers = []
        for k, part in enumerate(check(value)):
            try:
                numbers.append(coordinate(part))
            except Fault as fault:
                raise Fault(str(fault), (k,)) from None
        return numbers[0], numbers[1]

    return read


_MEMBERS: dict[str, Callable[[Any], Any]] = {
    "turning_radius": _radius,
    "axle": _numbers("[x, y]"),
    "heading": angle,
    "gears": lambda value: value,
    "wheelbase": coordinate,
}


def vehicle_record(vehicle: Vehicle) -> dict[str, Any]:
    """Return a vehicle as JSON members, exactly; `vehicle` reads them.

    Examples
    --------
    >>> record = vehicle_record(Car((4, 5), axle=("-1.3", 0)))
    >>> record
    {'type': 'car', 'turning_radius': ['4', '5'], 'axle': ['-13/10', '0']}
    >>> from cfree.formats.scenes.scene_values import vehicle
    >>> vehicle(record)
    Car((4, 5), axle=(-13/10, 0))
    """
    left, right = map(str, vehicle.radii)
    heading = {"tau": "inf" if vehicle.heading is None else str(vehicle.heading)}
    return {
        "type": vehicle.kind,
        **({"turning_radius": left if left == right else [left, right]} if vehicle.kind == "car" else {}),
        "axle": [*map(str, vehicle.axle)],
        **({} if vehicle.heading == 0 else {"heading": heading}),
        **({} if vehicle.gears == "both" else {"gears": vehicle.gears}),
        **({} if vehicle.wheelbase is None else {"wheelbase": str(vehicle.wheelbase)}),
    }


def not_empty(value: tuple[Fraction, ...]) -> tuple[Fraction, ...]:
    xmin, ymin, xmax, ymax = value
    if xmin >= xmax or ymin >= ymax:
        raise Fault("{got} is empty; give [xmin, ymin, xmax, ymax] with xmin < xmax and ymin < ymax")
    return value


def known_version(value: object) -> int:
    if type(value) is not int or value != VERSION:
        raise Fault(f"expected version {VERSION}, the only one this cfree reads, got {{got}}")
    return value


def is_encodable(text: str) -> bool:
    """True if a text has no half of a surrogate pair."""
    return text.isascii() or not any("\ud800" <= character <= "\udfff" for character in text)


def plain(value: Any, depth: int = MAX_NESTING) -> Any:
    """Return free-form JSON with floats, if it is shallow and encodable, so that it can be saved again."""
    value = number_of(value) if isinstance(value, Literal) else value
    if not isinstance(value, (dict, list, str, int, float, Decimal, NoneType)):
        raise Fault("a polygon, where its numbers are to be kept")
    if depth == 0:
        raise Fault(f"nested more than {MAX_NESTING} deep; flatten it")
    if isinstance(value, dict):
        return {plain(key): plain(part, depth - 1) for key, part in value.items()}
    if isinstance(value, list):
        return [plain(part, depth - 1) for part in value]
    if isinstance(value, str) and not is_encodable(value):
        raise Fault("there is half a surrogate pair in {got}; give whole characters")
    if isinstance(value, Decimal) and value.is_finite():  # decoding has noted the others
        value = float(value)
        if not isfinite(value):
            raise Fault("a number in {got} is too large for a double; give smaller ones")
    return value


# scenes without faults


@dataclass(frozen=True, slots=True)
class Named:
    """A polygon that was read from an object with a name, which may be null."""

    polygon: Polygon
    name: str | None


def shape_at_once(members: dict[str, Any]) -> Polygon | Named | dict[str, Any]:
    """Return the polygon of a decoded JSON object, so that its numbers need not be kept; other objects as they are."""
    polygon = plain_polygon(members, OBSTACLE) if "outer" in members else None
    if polygon is None:
        return members
    return Named(polygon, members["name"]) if "name" in members else polygon


def scene_from_plain(data: object) -> Scene | None:
    """Return the scene of a decoded JSON value, if it has no fault."""
    if not isinstance(data, dict) or not data.keys() <= READERS.keys() | _SHAPES:
        return None
    robot, obstacles, workspace = data.get("robot"), data.get("obstacles", []), data.get("workspace")
    robot = [robot] if isinstance(robot, (dict, Polygon, Named)) or is_ring(robot) else robot
    obstacles = [obstacles] if is_ring(obstacles) else obstacles
    if not isinstance(robot, list) or not isinstance(obstacles, list):
        return None
    parts, bodies = [plain_polygon(part, POLYGON) for part in robot], [plain_polygon(o, OBSTACLE) for o in obstacles]
    room = None if workspace is None else plain_polygon(workspace, POLYGON)
    if None in parts or None in bodies or (room is None and workspace is not None):
        return None
    if data.get("goal") is not None and data.get("goals"):
        return None
    names = [o.name if isinstance(o, Named) else o.get("name") if isinstance(o, dict) else None for o in obstacles]
    try:
        others = {key: read(data[key]) for key, read in READERS.items() if key in data}
        return Scene(parts, bodies, obstacle_names=names, workspace=room, **others)
    except (CfreeError, Fault):
        return None


def is_ring(value: Any) -> bool:
    """True if a decoded JSON value is a list that begins with a point: a ring, and no list of rings or shapes.

    Examples
    --------
    >>> is_ring([[0, 0], [1, 0]]), is_ring([[[0, 0], [1, 0]]]), is_ring([{"outer": []}]), is_ring([])
    (True, False, False, False)
    """
    if not isinstance(value, list) or not value or not isinstance(value[0], list):
        return False
    return bool(value[0]) and not isinstance(value[0][0], (list, dict))


def plain_polygon(data: Any, keys: Set[str]) -> Polygon | None:
    """Return the polygon of a decoded JSON value, which the core reads, if it has no fault."""
    if isinstance(data, Polygon):
        return data
    if isinstance(data, Named):
        return data.polygon if "name" in keys else None
    data = {"outer": data} if is_ring(data) else data
    if not isinstance(data, dict) or not data.keys() <= keys:
        return None
    name, holes = data.get("name"), data.get("holes", [])
    if not isinstance(holes, list) or not (name is None or is_text(name, MAX_NAME)):
        return None
    try:
        core = _core.Polygon.of([data.get("outer"), *holes])
    except InvalidPolygonError:
        return None
    return None if core is None else polygon_of(core)


def is_text(value: Any, most: int) -> bool:
    """True if a value is encodable text of limited length."""
    return type(value) is str and len(value) <= most and is_encodable(value)


def _text(value: Any) -> str:
    if is_text(value, MAX_TEXT):
        return str(value)
    raise Fault("no text")


def _object(value: Any) -> dict[str, Any]:
    if isinstance(value, dict):
        return {**plain(value)}
    raise Fault("no object")


def _bounds(value: Any) -> tuple[Fraction, ...] | None:
    return None if value is None else not_empty(tuple(map(coordinate, list_of(4, "bounds")(value))))


def _configuration(value: Any) -> Pose | None:
    return None if value is None else _pose(value)


def _pose(value: Any) -> Pose:
    x, y, theta = list_of(3, "a configuration")(value)
    return pose((coordinate(x), coordinate(y), angle(theta)))


def _goal(value: Any) -> Goal:
    """Return a pose or a place; null is a fault."""
    if isinstance(value, list) and len(value) == 2:
        x, y = map(coordinate, value)
        return place((x, y))
    return _pose(value)


_SHAPES = {"robot", "obstacles", "workspace"}
READERS: dict[str, Callable[[Any], Any]] = {
    "version": lambda value: known_version(number_of(value) if isinstance(value, Literal) else value),
    **dict.fromkeys(("name", "note", "units"), _text),
    "source": lambda value: {key: _text(text) for key, text in _object(value).items()},
    "bounds": _bounds,
    "start": _configuration,
    "goal": lambda value: None if value is None else _goal(value),
    "goals": lambda value: [_goal(goal) for goal in (value if isinstance(value, list) else [None])],
    "vehicle": lambda value: None if value is None else vehicle(value),
    "check": _object,
}
