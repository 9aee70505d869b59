"""Units, scale and reference point of what was read: exact, and each change noted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any, Literal

from cfree.curves.curved import Curved
from cfree.curves.similar import similar
from cfree.exact.number import ExactPoint, Number, to_fraction
from cfree.exact.pose import Pose
from cfree.scene.reading import Note
from cfree.scene.scene import AnyShape
from cfree.vehicles.vehicle import Car, DifferentialDrive, Vehicle

Pivot = Literal["centroid"] | Sequence[Number]
FAR = 1
"""A reference point farther from the robot than this multiple of the robot's size is probably not meant."""


def scaled_settings(settings: Mapping[str, Any], ratio: Fraction) -> dict[str, Any]:
    """Return settings of a scene with all lengths multiplied by a ratio above 0."""
    result = dict(settings)
    if result.get("bounds") is not None:
        result["bounds"] = tuple(Fraction(c) * ratio for c in result["bounds"])
    for key in ("start", "goal"):
        if result.get(key) is not None:
            result[key] = _scaled_goal(result[key], ratio)
    if result.get("goals"):
        result["goals"] = tuple(_scaled_goal(goal, ratio) for goal in result["goals"])
    if result.get("vehicle") is not None:
        result["vehicle"] = fitted(result["vehicle"], ratio)
    return result


def _scaled_goal(goal: Any, ratio: Fraction) -> Any:
    if isinstance(goal, Pose):
        return Pose(goal.x * ratio, goal.y * ratio, {"tau": goal.tau})
    return goal[0] * ratio, goal[1] * ratio


def fitted(vehicle: Vehicle, ratio: Fraction = Fraction(1), origin: ExactPoint = (Fraction(0), Fraction(0))) -> Vehicle:
    """Return a vehicle of a robot whose lengths are multiplied by a ratio above 0, and whose origin is another point.

    Examples
    --------
    >>> fitted(Car((4, 5), axle=(1, 0)), Fraction(1, 2)), fitted(DifferentialDrive((1, 0)), origin=(Fraction(3), 0))
    (Car((2, 5/2), axle=(1/2, 0)), DifferentialDrive(axle=(-2, 0)))
    """
    (left, right), (x, y) = vehicle.radii, vehicle.axle
    axle, heading = (x * ratio - origin[0], y * ratio - origin[1]), {"tau": vehicle.heading}
    if vehicle.kind == "differential":
        return DifferentialDrive(axle, heading)
    wheelbase = None if vehicle.wheelbase is None else vehicle.wheelbase * ratio
    return Car((left * ratio, right * ratio), axle, heading, vehicle.gears, wheelbase)


def scaled_note(note: Note, ratio: float) -> Note:
    """Return a note with places and sizes multiplied by a ratio."""

    def place(p: tuple[float, float] | None) -> tuple[float, float] | None:
        return p and (p[0] * ratio, p[1] * ratio)

    items = tuple(
        replace(
            item,
            at=place(item.at),
            size=item.size and item.size * ratio,
            points=tuple((x * ratio, y * ratio) for x, y in item.points),
        )
        for item in note.items
    )
    return replace(note, at=place(note.at), size=note.size and note.size * ratio, items=items)


def about_pivot(parts: Sequence[AnyShape], pivot: Pivot) -> tuple[list[AnyShape], ExactPoint]:
    """Move the parts of a robot so that the pivot is the reference point; return them, and the pivot.

    Parameters
    ----------
    parts : sequence of shapes
    pivot : "centroid" or (x, y)
        The centroid of all parts, or a point in their coordinates.
    """
    x, y = centroid(parts) if isinstance(pivot, str) else map(to_fraction, pivot)
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


def settings_about(settings: Mapping[str, Any], pivot: ExactPoint, *, is_placed: bool) -> dict[str, Any]:
    """Return settings of a scene whose poses are those of another point of the robot.

    With `is_placed`, the robot is drawn at its place: this is the start if there is no other.
    """
    result = dict(settings)
    if is_placed and result.get("start") is None:
        result["start"] = Pose(0, 0)
    for key in ("start", "goal"):
        if isinstance(result.get(key), Pose):
            result[key] = _pose_about(result[key], pivot)
    if result.get("goals"):
        result["goals"] = tuple(
            _pose_about(goal, pivot) if isinstance(goal, Pose) else goal for goal in result["goals"]
        )
    if result.get("vehicle") is not None:
        result["vehicle"] = fitted(result["vehicle"], origin=pivot)
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
