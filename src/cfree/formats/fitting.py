"""Units, scale and reference point of what was read: exact, and each change noted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any, Literal

from cfree.curves.curved import Curved
from cfree.curves.similar import similar
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.formats.shapes import Shape, Shapes
from cfree.formats.text.findings import InvalidFileError, whole
from cfree.formats.units import METRES, factor, unit_of
from cfree.scene.reading import Note, together
from cfree.scene.scene import AnyShape

Pivot = Literal["centroid"] | ExactPoint
FAR = 1
"""A reference point farther from the robot than this multiple of the robot's size is probably not meant."""


def sized(shapes: Shapes, units: str = "", scale: Fraction | None = None) -> Shapes:
    """Return shapes with another scale, and with a unit if their file names none.

    Raises
    ------
    InvalidFileError
        If a unit is not known, or the file names another.
    """
    own = str(shapes.settings.get("units", ""))
    if units and not unit_of(units):
        raise InvalidFileError(shapes.file, [whole(f"--units {units}: no unit of length; give {', '.join(METRES)}")])
    if units and unit_of(own) and unit_of(own) != unit_of(units) and scale is None:
        ratio = factor(own, units)
        remedy = f"leave --units out, or give --scale {ratio} to convert"
        raise InvalidFileError(shapes.file, [whole(f"--units {units}: the file is in {own}; {remedy}")])
    if scale is not None and scale <= 0:
        raise InvalidFileError(shapes.file, [whole(f"--scale {scale}: no scale; give a number above 0")])
    notes = [Note("info", f"length multiplied by {scale}")] if scale not in (None, 1) else []
    if units:
        notes.append(Note("info", f"unit taken as {unit_of(units)}")) if not unit_of(own) else None
    result = scaled(shapes, scale or Fraction(1))
    settings = {**result.settings, **({"units": unit_of(units)} if units else {})}
    return replace(result, settings=settings, reading=together(result.reading, notes))


def scaled(shapes: Shapes, ratio: Fraction) -> Shapes:
    """Return shapes, poses, bounds and places of notes with all lengths multiplied by a ratio above 0."""
    if ratio == 1:
        return shapes
    moved = tuple(replace(shape, polygon=similar(shape.polygon, ratio)) for shape in shapes.shapes)
    notes = tuple(_scaled_note(note, float(ratio)) for note in shapes.reading)
    return replace(shapes, shapes=moved, settings=_settings(shapes.settings, ratio), reading=notes)


def _settings(settings: Mapping[str, Any], ratio: Fraction) -> dict[str, Any]:
    result = dict(settings)
    if result.get("bounds") is not None:
        result["bounds"] = tuple(Fraction(c) * ratio for c in result["bounds"])
    for key in ("start", "goal"):
        if result.get(key) is not None:
            result[key] = _scaled_goal(result[key], ratio)
    if result.get("goals"):
        result["goals"] = tuple(_scaled_goal(goal, ratio) for goal in result["goals"])
    return result


def _scaled_goal(goal: Any, ratio: Fraction) -> Any:
    if isinstance(goal, Pose):
        return Pose(goal.x * ratio, goal.y * ratio, {"tau": goal.tau})
    return goal[0] * ratio, goal[1] * ratio


def _scaled_note(note: Note, ratio: float) -> Note:
    def place(p: tuple[float, float] | None) -> tuple[float, float] | None:
        return p and (p[0] * ratio, p[1] * ratio)

    items = tuple(replace(item, at=place(item.at), size=item.size and item.size * ratio) for item in note.items)
    return replace(note, at=place(note.at), size=note.size and note.size * ratio, items=items)


def in_units_of(robot: Shapes, scene: Shapes) -> Shapes:
    """Return the robot's shapes in the unit of the scene's file; a file without a unit is taken to have the other's."""
    own, wanted = (str(shapes.settings.get("units", "")) for shapes in (robot, scene))
    ratio = factor(own, wanted)
    if ratio is None:
        named = [name for name in (own, wanted) if unit_of(name)]
        what = f"unit missing in one of two files: {named[0]} in both" if named else ""
        notes = [Note("info", what)] if named else []
        return replace(robot, reading=together(robot.reading, notes))
    if ratio == 1:
        return robot
    converted = scaled(robot, ratio)
    return replace(
        converted, reading=together(converted.reading, [Note("info", f"robot converted from {own} to {wanted}")])
    )


def pivoted(parts: Sequence[AnyShape], pivot: Pivot | None) -> tuple[list[AnyShape], ExactPoint | None]:
    """Move the parts of a robot so that the pivot is the reference point; return them, and the pivot.

    Parameters
    ----------
    parts : sequence of shapes
    pivot : "centroid", (x, y) or None
        The centroid of all parts, or a point in their coordinates.
    """
    if pivot is None:
        return list(parts), None
    x, y = centroid(parts) if pivot == "centroid" else pivot
    return [similar(part, shift=(-x, -y)) for part in parts], (x, y)


def centroid(parts: Sequence[AnyShape]) -> ExactPoint:
    """Return the centroid of shapes; exact for polygons, for round shapes that of polygons near them."""
    total = mx = my = Fraction(0)
    for part in parts:
        for polygon in part.outer(part.size / 1000) if isinstance(part, Curved) else (part,):
            for ring in polygon.exact_rings:
                for (x0, y0), (x1, y1) in zip(ring, [*ring[1:], ring[0]], strict=True):
                    cross = x0 * y1 - x1 * y0
                    total, mx, my = total + cross, mx + cross * (x0 + x1), my + cross * (y0 + y1)
    return mx / (3 * total), my / (3 * total)


def about(settings: Mapping[str, Any], pivot: ExactPoint) -> dict[str, Any]:
    """Return settings of a scene whose poses are those of another point of the robot."""
    result = dict(settings)
    for key in ("start", "goal"):
        if isinstance(result.get(key), Pose):
            result[key] = _pose_about(result[key], pivot)
    if result.get("goals"):
        result["goals"] = tuple(
            _pose_about(goal, pivot) if isinstance(goal, Pose) else goal for goal in result["goals"]
        )
    return result


def _pose_about(pose: Pose, pivot: ExactPoint) -> Pose:
    c, s = pose.cos, pose.sin
    x, y = pose.x + c * pivot[0] - s * pivot[1], pose.y + s * pivot[0] + c * pivot[1]
    return Pose(x, y, {"tau": pose.tau})


def far_reference(parts: Sequence[AnyShape]) -> tuple[Note, ...]:
    """Return a warning if the reference point is far outside of the robot."""
    boxes = [tuple(map(float, part.box if isinstance(part, Curved) else part.bounds)) for part in parts]
    x0, y0 = min(box[0] for box in boxes), min(box[1] for box in boxes)
    x1, y1 = max(box[2] for box in boxes), max(box[3] for box in boxes)
    off = max(x0, -x1, 0.0) + max(y0, -y1, 0.0)
    if off <= FAR * max(x1 - x0, y1 - y0):
        return ()
    what = "reference point far outside of the robot"
    return (Note("warning", what, "none", size=off, remedy="--pivot centroid"),)


def shapes_with(shapes: Shapes, parts: Sequence[AnyShape]) -> Shapes:
    """Return shapes with another robot."""
    others = tuple(shape for shape in shapes.shapes if shape.role != "robot")
    return replace(shapes, shapes=(*(Shape("robot", None, part) for part in parts), *others))
