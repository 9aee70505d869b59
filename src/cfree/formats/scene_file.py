"""Scenes and polygons read from files, scenes written to files; `docs/scene-format.md` describes them.

Numbers are the decimals they are written as. A file with faults raises one error that names all of them.
"""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from os import PathLike
from pathlib import Path

from cfree.arguments import checked
from cfree.collector import collection_paused
from cfree.errors import UnsupportedError
from cfree.exact.half_angle import Angle
from cfree.exact.number import MAX_DIGITS
from cfree.exact.pose import Pose
from cfree.formats.atomic import replacing
from cfree.formats.findings import Findings, read_text
from cfree.formats.json_text import read_json, read_literals, with_numbers
from cfree.formats.scene_values import scene_from_plain
from cfree.polygons.polygon import Polygon
from cfree.scene.goals import Goal
from cfree.scene.scene import Scene, default_name

_TEXTS = ("name", "note", "units", "source")


@checked
def load_scene(path: str | PathLike[str]) -> Scene:
    """Read a scene from a JSON scene, a GeoJSON or a WKT file.

    Parameters
    ----------
    path : path
        What is in the file decides how it is read, except that a ``.wkt`` file is always WKT.

    Returns
    -------
    Scene

    Raises
    ------
    FormatError
        If the file cannot be read: place, value and remedy of every fault, ``file:line:column`` first.

    Examples
    --------
    >>> scene = load_scene("examples/scenes/benchmr_parking1.json")
    >>> scene
    Scene('benchmr_parking1', robot: 20 vertices; 13 obstacles: 225 vertices)
    >>> scene.start.x
    Fraction(-3, 1)
    """
    findings = _open(path)
    with collection_paused():
        return scene_from_wkt(findings) if is_wkt(findings) else scene_from_json(findings, read_literals(findings))


def scene_from_wkt(findings: Findings) -> Scene:
    """The scene that WKT holds."""
    from cfree.formats.shapes import scene_from_shapes
    from cfree.formats.wkt import wkt_shapes

    return scene_from_shapes(findings, wkt_shapes(findings), "begin its line with robot:")


def scene_from_json(findings: Findings, data: object) -> Scene:
    """The scene, or the GeoJSON, that JSON with literals is."""
    if _is_geojson(data):
        from cfree.formats.geojson import geojson_shapes
        from cfree.formats.shapes import scene_from_shapes

        remedy = 'give its feature the property "role": "robot"'
        return scene_from_shapes(findings, geojson_shapes(findings, with_numbers(data)), remedy)
    if not findings and (scene := scene_from_plain(data)):
        return scene
    from cfree.formats.scene_format import scene_from_models

    return scene_from_models(findings, with_numbers(data))


def scene_from_text(name: str, text: str) -> Scene:
    """Scene from the JSON text that `scene_text` makes; `name` stands for the file in errors."""
    findings = Findings(name, text)
    return scene_from_json(findings, read_literals(findings))


@checked
def load_polygons(path: str | PathLike[str]) -> tuple[Polygon, ...]:
    """Read the polygons of a GeoJSON or a WKT file, whatever their roles, in the order of the file.

    Raises
    ------
    FormatError
        As `load_scene` does.
    """
    findings = _open(path)
    if is_wkt(findings):
        from cfree.formats.wkt import wkt_shapes

        shapes = wkt_shapes(findings)
    else:
        from cfree.formats.geojson import geojson_shapes

        shapes = geojson_shapes(findings, read_json(findings))
    findings.fail_if_any()
    return tuple(shape.polygon for shape in shapes)


def save_scene(scene: Scene, path: str | PathLike[str]) -> None:
    """Write a scene as JSON; `load_scene` gives an equal one.

    Raises
    ------
    UnsupportedError
        If the name of the file says GeoJSON or WKT, which hold less than a scene.
    """
    target = Path(os.path.realpath(path))
    if target.suffix.lower() in (".wkt", ".geojson"):
        raise UnsupportedError(f"{target.name}: scenes are written as JSON only; name the file .json")
    with replacing(target) as unfinished:
        unfinished.write_text(scene_text(scene), encoding="utf-8", newline="\n")


def scene_text(scene: Scene) -> str:
    """JSON text of a scene, one shape a line.

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
        _shape(polygon, "" if name == default_name(k) else name)
        for k, (polygon, name) in enumerate(zip(scene.obstacles, scene.obstacle_names, strict=True))
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
    if scene.check:
        lines["check"] = _json(scene.check)
    return "{\n" + ",\n".join(f'  "{key}": {text}' for key, text in lines.items()) + "\n}\n"


def number_text(value: Fraction) -> str:
    """Exact JSON of a number: a decimal if one of moderate length is exact, else ``"p/q"`` in quotes.

    Examples
    --------
    >>> number_text(Fraction(-1, 8)), number_text(Fraction(1, 3))
    ('-0.125', '"1/3"')
    """
    bits = value.numerator.bit_length() + value.denominator.bit_length()
    if bits > 3 * MAX_DIGITS:  # a digit has 3.3 bits, and a point may add some zeros
        raise UnsupportedError(f"a number has about {bits * 0.301:.0f} digits; round it before saving")
    rest, places = value.denominator, 0
    for prime in (2, 5):
        power = 0
        while rest % prime == 0 and power < 80:
            rest, power = rest // prime, power + 1
        places = max(places, power)
    if rest != 1:
        return f'"{value}"'
    digits = str(abs(value.numerator) * 10**places // value.denominator).rjust(places + 1, "0")
    whole, decimals = digits[: len(digits) - places], digits[len(digits) - places :]
    return f"{'-' if value < 0 else ''}{whole}{decimals and '.'}{decimals}"


# reading


def _open(path: str | PathLike[str]) -> Findings:
    return Findings(os.fspath(path), read_text(Path(path)))


def is_wkt(findings: Findings) -> bool:
    """By the name of the file, or by what is in it."""
    if Path(findings.file).suffix.lower() == ".wkt":
        return True
    return findings.text.lstrip()[:1] not in "{[" and bool(re.search("POLYGON", findings.text, re.IGNORECASE))


def _is_geojson(data: object) -> bool:
    return isinstance(data, Mapping) and "type" in data


# writing


def _shape(polygon: Polygon, name: str = "") -> str:
    rings = []
    for start, stop in zip(polygon.ring_offsets, polygon.ring_offsets[1:], strict=False):
        points = (f"[{number_text(x)}, {number_text(y)}]" for x, y in polygon.exact_vertices[start:stop])
        rings.append(f"[{', '.join(points)}]")
    members = {"name": _json(name) if name else "", "outer": rings[0], "holes": ", ".join(rings[1:])}
    members["holes"] = members["holes"] and f"[{members['holes']}]"
    return "{" + ", ".join(f'"{key}": {text}' for key, text in members.items() if text) + "}"


def _list(shapes: Sequence[str]) -> str:
    return "[" + ",".join(f"\n    {shape}" for shape in shapes) + ("\n  ]" if shapes else "]")


def _goal_text(goal: Goal) -> str:
    """A pose, or a place."""
    if not isinstance(goal, Pose):
        return f"[{', '.join(map(number_text, goal))}]"
    return f"[{number_text(goal.x)}, {number_text(goal.y)}, {_angle_text(goal)}]"


def _angle_text(pose: Pose) -> str:
    """Theta so that reading it gives this pose: in round degrees, else in the radians given, else as tau."""
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
