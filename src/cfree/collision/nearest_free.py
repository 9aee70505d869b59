"""Forbidden poses, explained: what overlaps what, and a free pose near by."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
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
from cfree.scene.scene import Scene, box_of, robot_radius

if TYPE_CHECKING:
    from cfree.exact.pose import Floats

DIRECTIONS, GROWTH = 32, 1.5  # of the places looked at, on circles whose radii grow so
NEAREST, FARTHEST = 1e-6, 10.0  # these radii, in lengths of the robot
ROUNDS, TRIES, CLOSER, HALVINGS = 60, 64, 0.85, 45  # of the search for a nearer one
SAMPLES, MISSES, ENOUGH = 40_000, 3, 0.99  # before that, as many around the pose until so often nothing is gained
DIGITS, ROUGHLY = 18, 0.01  # digits of its numbers, fewer if they do; how much farther it may be for fewer
NOTHING = 1e-9  # of an offset: none
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
    checker = scene if isinstance(scene, PoseChecker) else PoseChecker(scene)
    return _on_circles(checker, to_pose(pose, "pose"), FARTHEST)


@checked
def nearest_free(scene: Scene | PoseChecker, pose: PoseLike) -> Pose | None:
    """The nearest free pose that a search finds, the pose itself if it is free.

    Parameters
    ----------
    scene : Scene or PoseChecker
    pose : Pose or (x, y, theta)

    Returns
    -------
    Pose or None
        Free, exactly, and always the same. How near it is counts the way of the reference point, plus the turning times
        the robot's length. That no other one is nearer is not proved. None if none is found.

    Notes
    -----
    `free_nearby` begins; random poses about the best one, closer and closer, and a bisection on the way to it go on.

    Examples
    --------
    >>> wall = [(2, 0), (3, 0), (3, 9), (2, 9)]
    >>> scene = Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=[wall])
    >>> nearest_free(scene, Pose("1.25", 2)) == Pose(1, 2)
    True
    """
    pose = to_pose(pose, "pose")
    checker = scene if isinstance(scene, PoseChecker) else PoseChecker(scene)
    if checker.is_free(pose):
        return pose
    length, (low, high) = _length(checker), _extent(checker.scene)
    x, y = np.clip((float(pose.x), float(pose.y)), low, high).tolist()
    inside = Pose(x, y, {"tau": pose.tau})
    found = inside if checker.is_free(inside) else _on_circles(checker, inside, _reach(checker.scene, inside) / length)
    if found is None:
        return None
    here = np.array([float(pose.x), float(pose.y), pose.theta])
    offset = _closer(checker, here, _offset(pose, found, length), length)
    most = _way(offset) + ROUGHLY * min(_way(offset), length)
    for digits in range(DIGITS):
        places = [near for turn in (0.0, offset[2]) for near in _rounded(pose, (*offset[:2], turn), length, digits)]
        ways = [(_way(_offset(pose, near, length)), k) for k, near in enumerate(places)]
        for way, k in sorted(ways):
            if way <= most and checker.is_free(places[k]):
                return places[k]
    return found


def _closer(checker: PoseChecker, here: Floats, first: Floats, length: float) -> Floats:
    """A shorter offset x, y, length times turn to a free pose, in doubles."""
    rng, best = np.random.default_rng(0), first

    def free(offsets: Floats) -> Floats:
        poses = Poses(here[:2] + offsets[:, :2], here[2] + offsets[:, 2] / length)
        return offsets[np.asarray(checker.is_free(poses))]

    misses = 0
    while misses < MISSES:
        found = free(_ball(rng, _way(best)))
        nearest = min(found, key=_way, default=best)
        misses = 0 if _way(nearest) < ENOUGH * _way(best) else misses + 1
        best = nearest
    for k in range(ROUNDS):
        about = best + rng.normal(size=(TRIES, 3)) * (_way(best) * CLOSER**k)
        about[::2, 2] = best[2] * (k % 2)  # half of them without turning, or turned as the best
        about = np.concatenate([about, best * rng.uniform(size=(TRIES // 4, 1))])
        found = free(about[[_way(row) < _way(best) for row in about]])
        best = min(found, key=_way, default=best)
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (low, middle) if len(free(middle * best[None])) else (middle, high)
    return high * best


def _ball(rng: np.random.Generator, way: float) -> Floats:
    """Random offsets that are a shorter way than one."""
    rows = rng.uniform(-way, way, size=(SAMPLES, 3))
    return rows[np.hypot(rows[:, 0], rows[:, 1]) + np.abs(rows[:, 2]) < way]


def _rounded(pose: Pose, offset: Sequence[float], length: float, digits: int) -> Iterator[Pose]:
    """The pose moved by about an offset, to places and by an angle of so many digits: each number down, and up."""
    size = max(abs(offset[0]), abs(offset[1]), 1e-300)
    unit = Fraction(10) ** (math.floor(math.log10(size)) - digits)
    degrees = math.degrees(offset[2] / length)
    rounded = round(degrees, digits - math.floor(math.log10(abs(degrees)))) if degrees else 0.0
    tau = (Pose(0, 0, f"{rounded:.12f}deg") @ Pose(0, 0, {"tau": pose.tau})).tau
    ends = []
    for c, d in ((pose.x, offset[0]), (pose.y, offset[1])):
        below = math.floor((c + Fraction(d)) / unit)
        ends.append([c] if abs(d) < NOTHING * size else [below * unit, (below + 1) * unit])
    yield from (Pose(x, y, {"tau": tau}) for x in ends[0] for y in ends[1])


def _offset(pose: Pose, other: Pose, length: float) -> Floats:
    turn = math.remainder(other.theta - pose.theta, math.tau)
    return np.array([float(other.x - pose.x), float(other.y - pose.y), length * turn])


def _way(offset: Floats) -> float:
    return math.hypot(offset[0], offset[1]) + abs(float(offset[2]))


def _length(checker: PoseChecker) -> float:
    """The longer side of the box around the robot's largest part."""
    return max(float(np.ptp(part.vertices, axis=0).max()) for part in checker.scene.robot)


def _extent(scene: Scene) -> tuple[Floats, Floats]:
    """Corners of the box that the reference point has to be in, or that is about all there is."""
    if scene.bounds:
        box = tuple(map(float, scene.bounds))
    elif scene.workspace:
        box = box_of(scene.workspace)
    else:
        return np.full(2, -np.inf), np.full(2, np.inf)
    return np.array(box[:2]), np.array(box[2:])


def _reach(scene: Scene, pose: Pose) -> float:
    """Distance from a pose beyond which there is nothing of a scene, or more."""
    shapes = [*scene.obstacles, *([scene.workspace] if scene.workspace else [])]
    boxes = np.array([box_of(shape) for shape in shapes]).reshape(-1, 2)
    room = np.array(scene.bounds, dtype=np.float64).reshape(-1, 2) if scene.bounds else boxes
    corners = np.concatenate([boxes, room, [(float(pose.x), float(pose.y))]])
    return FARTHEST * robot_radius(scene) + 2 * float(np.ptp(corners, axis=0).max())


def _on_circles(checker: PoseChecker, pose: Pose, farthest: float) -> Pose | None:
    """The nearest free one of many poses on circles, the largest of so many lengths of the robot."""
    length = _length(checker)
    offsets = [_circle(NEAREST * length * GROWTH**k, length) for k in range(_circles(farthest))]
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


def _circles(farthest: float) -> int:
    return math.ceil(math.log(farthest / NEAREST, GROWTH)) + 1


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
