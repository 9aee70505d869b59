"""Forbidden poses, explained: what overlaps what, and a free pose near by."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from cfree.arguments import checked
from cfree.collision.motion import Translation
from cfree.collision.motion_checker import MotionChecker
from cfree.collision.pose_checker import PoseChecker
from cfree.errors import InvalidPoseError
from cfree.exact.pose import Pose, PoseLike, Poses, to_pose
from cfree.scene.features import BOUNDS, WORKSPACE
from cfree.scene.naming import placed
from cfree.scene.scene import Scene

if TYPE_CHECKING:
    from cfree.exact.pose import Floats

DIRECTIONS, GROWTH = 32, 1.5  # of the places looked at, on circles whose radii grow so
NEAREST, FARTHEST = 1e-6, 10.0  # these radii, in lengths of the robot
TURNS = (0.0, 1.0, -1.0, 5.0, -5.0, 15.0, -15.0, 45.0, -45.0, 90.0, -90.0, 180.0)  # degrees


class ForbiddenPoseError(InvalidPoseError):
    """A pose that is not free; `free` is a free pose near by, if one was found."""

    def __init__(self, message: str, *, free: Pose | None = None) -> None:
        super().__init__(message)
        self.free = free


@checked
def require_free(scene: Scene | PoseChecker, pose: PoseLike, name: str = "pose") -> None:
    """See that a pose is free, exactly.

    Parameters
    ----------
    scene : Scene or PoseChecker
    pose : Pose or (x, y, theta)
    name : str, optional
        What the message calls it.

    Raises
    ------
    ForbiddenPoseError
        If it is forbidden. The message names a part of the robot and what it overlaps, and a free pose near by, which
        is the error's `free`, if one was found.

    Examples
    --------
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> scene = Scene(robot=square, obstacles=[[(2, 0), (3, 0), (3, 9), (2, 9)]])
    >>> require_free(scene, Pose(1, 2))
    >>> require_free(scene, Pose(1.25, 2), "start")
    Traceback (most recent call last):
    cfree.collision.nearest_free.ForbiddenPoseError: start (1.25, 2, 0 deg) is forbidden: \
robot part 0 overlaps obstacle 0, 1 x 9 at (2.5, 4.5); (0.96, 2, 0 deg) is free and near by
    """
    pose = to_pose(pose, "pose")
    checker = scene if isinstance(scene, PoseChecker) else PoseChecker(scene)
    if checker.is_free(pose):
        return
    free = free_nearby(checker, pose)
    advice = "no free pose was found near by; give another" if free is None else f"{_shown(free)} is free and near by"
    fault = _overlap(checker.scene, pose)
    raise ForbiddenPoseError(f"{name} {_shown(pose)} is forbidden: {fault}; {advice}", free=free)


@checked
def free_nearby(scene: Scene | PoseChecker, pose: PoseLike) -> Pose | None:
    """A free pose that is near another one, of few digits; not the nearest.

    Returns
    -------
    Pose or None
        Of thousands of poses on circles around it, from a millionth to ten times the robot's length away and turned by
        up to half a turn, the nearest that is free, exactly; None if none is. Always the same.

    Examples
    --------
    >>> wall = [(2, 0), (3, 0), (3, 9), (2, 9)]
    >>> found = free_nearby(Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=[wall]), Pose(1.25, 2))
    >>> float(found.x), float(found.y), found.tau
    (0.96, 2.0, Fraction(0, 1))
    """
    pose = to_pose(pose, "pose")
    checker = scene if isinstance(scene, PoseChecker) else PoseChecker(scene)
    length = max(float(np.ptp(part.vertices, axis=0).max()) for part in checker.scene.robot)
    offsets = [_circle(NEAREST * length * GROWTH**k, length) for k in range(_circles())]
    turns = np.array([(0.0, 0.0, turn, 0.0) for turn in TURNS[1:]])
    table = np.concatenate([turns, *offsets])
    table = table[np.argsort(np.hypot(*table[:, :2].T) + length * np.radians(np.abs(table[:, 2])), kind="stable")]
    places = np.array([float(pose.x), float(pose.y)]) + table[:, :2]
    free = checker.is_free(Poses(places, pose.theta + np.radians(table[:, 2])))
    for k in np.flatnonzero(free).tolist():
        turn, digits = table[k, 2:].tolist()
        x, y = (round(c, int(digits)) for c in places[k].tolist()) if digits else (pose.x, pose.y)
        tilt = Pose(0, 0, f"{turn:g}deg")
        found = Pose(x, y, {"tau": (tilt @ Pose(0, 0, {"tau": pose.tau})).tau})
        if checker.is_free(found):
            return found
    return None


def _circles() -> int:
    return math.ceil(math.log(FARTHEST / NEAREST, GROWTH)) + 1


def _circle(radius: float, length: float) -> Floats:
    """Rows x, y, degrees, and the digits that a coordinate of that size needs."""
    phi = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    digits = max(1, 1 - math.floor(math.log10(radius)))
    turns = [turn for turn in TURNS if math.radians(abs(turn)) * length <= 4 * radius]
    rows = np.column_stack([radius * np.cos(phi), radius * np.sin(phi)])
    return np.concatenate([np.column_stack([rows, np.full((len(rows), 2), (turn, digits))]) for turn in turns])


def _overlap(scene: Scene, pose: Pose) -> str:
    found = MotionChecker(scene).first_contact(pose, Translation((0, 0)))
    assert found is not None  # both are exact
    if found.obstacle == BOUNDS:
        return "the reference point is outside the bounds"
    if found.obstacle == WORKSPACE:
        return f"robot part {found.robot} is not inside the workspace"
    return f"robot part {found.robot} overlaps {placed(scene, found.obstacle)}"


def _shown(pose: Pose) -> str:
    return f"({float(pose.x):.12g}, {float(pose.y):.12g}, {math.degrees(pose.theta):.6g} deg)"
