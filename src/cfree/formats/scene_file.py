"""Read scenes and polygons from files, write scenes to files; `docs/scene-format.md` describes them.

Numbers are exactly the decimals in the file. A file with faults raises one error that names all of them.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction
from os import PathLike
from pathlib import Path
from typing import Any, Literal

from cfree.arguments import checked
from cfree.collector import collection_paused
from cfree.curves.curved import Curved, healed_with_changes
from cfree.errors import InvalidPolygonError
from cfree.exact.half_angle import Angle
from cfree.exact.number import Number, to_fraction
from cfree.exact.pose import Pose
from cfree.formats.drawings.source import Progress, Reading
from cfree.formats.readers import read_file, read_json_file
from cfree.formats.scenes.reading_text import records
from cfree.formats.shapes import Shape, Shapes
from cfree.formats.text.atomic import checked_suffix, replacing
from cfree.formats.text.findings import Findings
from cfree.formats.text.number_text import number_text
from cfree.formats.units import METRES, factor, unit_of
from cfree.polygons.polygon import Polygon
from cfree.scene.goals import Goal
from cfree.scene.reading import Item, Note, Notes, together
from cfree.scene.scene import AnyShape, Scene, default_name
from cfree.vehicles.vehicle import Vehicle

_TEXTS = ("name", "note", "units", "source")
_LEAST, _MOST = Fraction(1, 10**300), Fraction(10**300)
"""Range of tolerances in the file's unit, so that they are doubles."""
_HEALED = "arc made exact"
EXPORTS = (".geojson", ".svg", ".dxf")
_SETTINGS = (*_TEXTS, "bounds", "start", "goal", "goals", "vehicle", "check", "version")


@checked
def load_scene(path: str | PathLike[str], *, heal: float = 0.0) -> Scene:
    """Read a scene from a file of any kind that `load_shapes` reads.

    Parameters
    ----------
    path : path
        JSON files are recognised by their content, all others by their suffix.
    heal : float
        Arcs of round shapes become exactly tangent where this moves them by no more, as for `load_shapes`.

    Returns
    -------
    Scene

    Raises
    ------
    FormatError
        If the file cannot be read, with place, value and remedy of every fault, ``file:line:column`` first.

    Examples
    --------
    >>> scene = load_scene("examples/scenes/benchmr_parking1.json")
    >>> scene
    Scene('benchmr_parking1', robot: 20 vertices; 13 obstacles: 225 vertices)
    >>> scene.start.x
    Fraction(-3, 1)
    """
    if heal:
        return read_shapes(path, Reading(curves=True, heal=heal)).scene()
    with collection_paused():
        content = read_file(path, Reading(curves=True))
        return content if isinstance(content, Scene) else content.scene()


@checked
def load_shapes(
    path: str | PathLike[str],
    *,
    tolerance: float | None = None,
    curves: bool = False,
    roles: Mapping[str, str] | None = None,
    units: str = "",
    scale: Number | None = None,
    join: float | None = None,
    join_holes: bool = False,
    heal: float = 0.0,
    strokes: float | Literal["ignore", "drawn"] = "ignore",
    repair: bool | None = None,
    holes: Literal["outlines", "nested"] = "outlines",
    fills: Literal["outlines", "hatches"] = "outlines",
    space: str = "",
    language: str = "en",
    min_area: float = 0.0,
    unknown: Literal["obstacle", "free"] = "obstacle",
    map_rules: Literal["strict", "nav2", "nav2-old", "ros1"] = "strict",
    occupied: int | None = None,
    free_thresh: float | None = None,
    unknown_grey: int | None = None,
    despeckle: int = 0,
    padding: float = 0.0,
) -> Shapes:
    """Read the shapes of a file of any kind, before they are a scene; `docs/formats.md` describes the kinds.

    Parameters
    ----------
    path : path
        A scene, GeoJSON, WKT, SVG, DXF, the YAML of a ROS map or of nav2 parameters, URDF, or nesting JSON.
    tolerance : float, optional
        Curves become polygons with this error at most, in the scene's unit: around robot and obstacles, inside the
        workspace. The default is a thousandth of the drawing's size.
    curves : bool
        Outlines of SVG and DXF with curves become round shapes, `Curved`, as for `load_scene`.
    roles : mapping of str to str, optional
        Roles of layers, groups or names: "robot", "obstacle", "workspace", or "ignore".
    units : str
        Unit of a file that names none: "mm", "m", "in" ...
    scale : number, optional
        All lengths are multiplied by it.
    join : float, optional
        Greatest gap of a drawing that is closed; 0 closes none. The default is a millionth of the drawing's size.
    join_holes : bool
        Outlines that a larger `join` closes may be holes. By default they are solid, whatever was meant.
    heal : float
        Arcs of round shapes become exactly tangent to lines and arcs beside them where rounding leaves a tiny corner
        and ends and middles of arcs move by no more than this length, in the scene's unit. 0 heals none. Polygons have
        no arcs: of a drawing give `curves` as well.
    strokes : float, "ignore" or "drawn"
        Unfilled lines are walls of this width, or of the width drawn; by default closed ones are solids, and open ones
        forbid nothing.
    repair : bool, optional
        Outlines that cross themselves are mended by their fill rule; by default in drawings, and not in JSON.
    holes : "outlines" or "nested"
        Nested unfilled elements of an SVG group are solids, or holes.
    fills : "outlines" or "hatches"
        Solids of a DXF layer: its outlines, or its hatches alone.
    space : str
        Layout of a DXF file; by default the model space.
    language : str
        Language of the branches of SVG's switch.
    min_area : float
        Shapes of a drawing of less area are left out, which is an assumption of the answer.
    unknown : "obstacle" or "free"
        The meaning of unknown cells of a map.
    map_rules : "strict", "nav2", "nav2-old" or "ros1"
        The map server whose rules decide which cells are free; a cell is free for "strict" if it is for all.
    occupied : int, optional
        Cells in scale or raw mode are forbidden from this value up, of 100.
    free_thresh : float, optional
        Threshold of free cells in place of the map's.
    unknown_grey : int, optional
        Grey value of unknown cells.
    despeckle : int
        Occupied specks of fewer cells are free, which is an assumption of the answer.
    padding : float
        The robot is padded as nav2 pads a footprint, in the unit of the robot's file.

    Raises
    ------
    FormatError
        If the file cannot be read.
    ValueError
        If an option makes no sense.
    ImportError
        If the reader's package is missing, with the command that installs it.

    Examples
    --------
    >>> shapes = load_shapes("examples/scenes/flat.json")
    >>> shapes.form, len(shapes.of("obstacle")) == len(shapes.scene().obstacles)
    ('scene', True)
    """
    options: dict[str, Any] = {name: value for name, value in locals().items() if name != "path"}
    options["roles"] = dict(roles or {})
    options["scale"] = None if scale is None else to_fraction(scale)
    return read_shapes(path, Reading(**options))


def read_shapes(path: str | PathLike[str], reading: Reading, progress: Progress | None = None) -> Shapes:
    """Read the shapes of a file with these options; `progress` as for `Source`."""
    drawn = reading
    if reading.tolerance and reading.scale:  # the tolerance is in the scene's unit
        tolerance = Fraction(reading.tolerance) / reading.scale
        drawn = replace(reading, tolerance=float(min(max(tolerance, _LEAST), _MOST)))
    with collection_paused():
        content = read_file(path, drawn, progress)
        shapes = shapes_in(content, os.fspath(path)) if isinstance(content, Scene) else content
        sized = _healed(_sized(shapes, reading.units, reading.scale), reading.heal)
        return replace(sized, padding=to_fraction(reading.padding))


def _healed(shapes: Shapes, heal: float) -> Shapes:
    """Return shapes whose arcs are exactly tangent where this moves them by no more than a length, with notes."""
    if not heal:
        return shapes
    notes, result = Notes(), []
    for shape in shapes.shapes:
        if isinstance(shape.polygon, Curved):
            polygon, changes = healed_with_changes(shape.polygon, heal)
            where = shape.name or shape.role
            shape = replace(shape, polygon=polygon)
            for change in changes:
                place = float(change.at[0]), float(change.at[1])
                item = Item("", place, change.size)
                notes.add(Note("mended", _HEALED, "near", 1, where, place, change.size, (item,)))
        result.append(shape)
    return replace(shapes, shapes=tuple(result), reading=together(shapes.reading, notes))


def _sized(shapes: Shapes, units: str, scale: Fraction | None) -> Shapes:
    """Return shapes with another scale, and with a unit if their file names none."""
    own = str(shapes.settings.get("units", ""))
    notes = []
    if units:
        if not unit_of(units):
            raise ValueError(f"units: {units!r} is no unit of length; give one of {', '.join(METRES)}")
        if unit_of(own) and unit_of(own) != unit_of(units) and scale is None:
            remedy = f"leave it out, or give the scale {factor(own, units)} as well"
            raise ValueError(f"units: {units!r}, and {shapes.file} is in {own}; {remedy}")
        if unit_of(own) != unit_of(units):
            notes.append(Note("info", f"unit taken as {unit_of(units)}"))
    if scale is not None and scale != 1:
        meant = next((unit for unit in METRES if not units and factor(own, unit) == scale), "")
        still, remedy = (f", still in {own}", f"--units {meant}") if meant else ("", "")
        notes.append(Note("warning" if meant else "info", f"lengths multiplied by {scale}{still}", remedy=remedy))
    if not notes:
        return shapes
    try:
        result = shapes.scaled(scale or 1)
    except InvalidPolygonError as error:
        raise ValueError(f"scale: the shapes would be too large: {error}") from None
    settings = {**result.settings, "units": unit_of(units)} if units else result.settings
    return replace(result, settings=settings, reading=together(result.reading, notes))


def scene_from_text(name: str, text: str) -> Scene:
    """Read a scene from the JSON text that `scene_text` makes; `name` stands for the file in errors."""
    findings = Findings(name, text)
    scene = read_json_file(findings)
    assert isinstance(scene, Scene)
    return scene


@checked
def load_polygons(path: str | PathLike[str]) -> tuple[Polygon, ...]:
    """Read the polygons of a file of any kind, with any role, in the order of the file.

    Raises
    ------
    FormatError
        If the file cannot be read, see `load_scene`.
    """
    return read_shapes(path, Reading()).polygons


def shapes_in(scene: Scene, file: str) -> Shapes:
    """Return the shapes and the settings of a scene."""
    named = zip(scene.obstacles, scene.obstacle_names, strict=True)
    shapes = [
        *(Shape("robot", None, part) for part in scene.robot),
        *(Shape("obstacle", None if name == default_name(k) else name, o) for k, (o, name) in enumerate(named)),
        *([Shape("workspace", None, scene.workspace)] if scene.workspace else []),
    ]
    settings = {key: value for key in _SETTINGS if (value := getattr(scene, key))}
    if "goal" in settings:
        settings.pop("goals", None)
    return Shapes("scene", tuple(shapes), settings, scene.reading, file)


def save_scene(scene: Scene, path: str | PathLike[str]) -> tuple[Note, ...]:
    """Write a scene as JSON, which gives an equal scene when read, or by the suffix as GeoJSON, SVG or DXF.

    Returns
    -------
    tuple of Note
        The differences of the file from the scene.

    Raises
    ------
    UnsupportedError
        If the suffix is of another format.
    """
    check_scene_path(path)
    target = Path(path)
    if target.suffix.lower() in EXPORTS:
        from cfree.formats.drawings.scene_texts import write_scene

        return write_scene(scene, target)
    with replacing(target) as unfinished:
        unfinished.write_text(scene_text(scene), encoding="utf-8", newline="\n")
    return ()


def check_scene_path(path: str | PathLike[str]) -> None:
    """Raise an error if no scene can be written to a file of this name; a pipe or a device gets JSON.

    Examples
    --------
    >>> check_scene_path("parking.stl")
    Traceback (most recent call last):
        ...
    cfree.errors.UnsupportedError: parking.stl: no scene format; name the file .json, .geojson, .svg or .dxf
    """
    if not os.path.exists(path) or os.path.isfile(path) or Path(path).suffix:
        checked_suffix(path, "scene", (".json", *EXPORTS))


def scene_text(scene: Scene) -> str:
    """Return the JSON text of a scene, one shape a line.

    Examples
    --------
    >>> print(scene_text(Scene(robot=[(0, 0), ("1/3", 0), (0, "0.1")], bounds=(0, 0, 1, 1))), end="")
    {
      "version": 1,
      "robot": {"outer": [[0, 0], ["1/3", 0], [0, 0.1]]},
      "obstacles": [],
      "bounds": [0, 0, 1, 1]
    }
    """
    robot = [_shape(part) for part in scene.robot]
    obstacles = [
        _shape(shape, "" if name == default_name(k) else name)
        for k, (shape, name) in enumerate(zip(scene.obstacles, scene.obstacle_names, strict=True))
    ]
    lines = {
        "version": str(scene.version),
        **{key: _json(value) for key in _TEXTS if (value := getattr(scene, key))},
        "robot": robot[0] if len(robot) == 1 else _list(robot),
        "obstacles": _list(obstacles),
    }
    if scene.workspace:
        lines["workspace"] = _shape(scene.workspace)
    if scene.bounds:
        lines["bounds"] = f"[{', '.join(map(number_text, scene.bounds))}]"
    for key, pose in (("start", scene.start), ("goal", scene.goal)):
        if pose:
            lines[key] = _goal_text(pose)
    if len(scene.goals) == 1:
        lines["goal"] = _goal_text(scene.goals[0])
    elif scene.goals:
        lines["goals"] = _list([_goal_text(goal) for goal in scene.goals])
    if scene.vehicle:
        lines["vehicle"] = _vehicle_text(scene.vehicle)
    if scene.check:
        lines["check"] = _json(scene.check)
    if scene.reading:
        lines["reading"] = _list([_json(record) for record in records(scene.reading, with_points=True)])
    return "{\n" + ",\n".join(f'  "{key}": {text}' for key, text in lines.items()) + "\n}\n"


# writing


def _vehicle_text(vehicle: Vehicle) -> str:
    left, right = map(number_text, vehicle.radii)
    members = {"type": f'"{vehicle.kind}"'}
    if vehicle.kind == "car":
        members["turning_radius"] = left if left == right else f"[{left}, {right}]"
    members["axle"] = f"[{', '.join(map(number_text, vehicle.axle))}]"
    if vehicle.heading != 0:
        members["heading"] = _angle_text(vehicle.frame)
    if vehicle.gears != "both":
        members["gears"] = f'"{vehicle.gears}"'
    if vehicle.wheelbase is not None:
        members["wheelbase"] = number_text(vehicle.wheelbase)
    return "{" + ", ".join(f'"{key}": {text}' for key, text in members.items()) + "}"


def _shape(polygon: AnyShape, name: str = "") -> str:
    if isinstance(polygon, Curved):
        from cfree.formats.scenes.curve_text import curved_text

        return curved_text(polygon, number_text, _angle_text, f'"name": {_json(name)}' if name else "")
    rings = []
    for ring in polygon.exact_rings:
        points = (f"[{number_text(x)}, {number_text(y)}]" for x, y in ring)
        rings.append(f"[{', '.join(points)}]")
    members = {"name": _json(name) if name else "", "outer": rings[0], "holes": ", ".join(rings[1:])}
    members["holes"] = members["holes"] and f"[{members['holes']}]"
    return "{" + ", ".join(f'"{key}": {text}' for key, text in members.items() if text) + "}"


def _list(shapes: Sequence[str]) -> str:
    return "[" + ",".join(f"\n    {shape}" for shape in shapes) + ("\n  ]" if shapes else "]")


def _goal_text(goal: Goal) -> str:
    """Return the JSON of a pose or a place."""
    if not isinstance(goal, Pose):
        return f"[{', '.join(map(number_text, goal))}]"
    return f"[{number_text(goal.x)}, {number_text(goal.y)}, {_angle_text(goal)}]"


def _angle_text(pose: Pose) -> str:
    """Return a text of theta that gives this pose when read: round degrees, else its radians, else tau."""
    if pose.tau == 0:
        return "0"
    in_degrees = f"{math.degrees(pose.theta):g}deg"
    texts: dict[str, Angle] = {f'"{in_degrees}"': in_degrees, repr(pose.theta): Decimal(repr(pose.theta))}
    for text, angle in texts.items():
        again = Pose(pose.x, pose.y, angle)
        if (again, again.theta, again.theta_error > 0) == (pose, pose.theta, pose.theta_error > 0):
            return text
    return f'{{"tau": "{pose.tau}"}}'


def _json(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
