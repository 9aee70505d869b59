"""Explanations of forbidden poses: the parts that overlap, and a free pose near by."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from cfree.arguments import checked
from cfree.collision.arcs import arcs_of
from cfree.collision.motion import Translation
from cfree.collision.motion_checker import MotionChecker
from cfree.collision.pose_checker import PoseChecker, are_free, is_free, is_free_at
from cfree.curves.curved import Curved
from cfree.curves.rings import Span
from cfree.errors import InvalidPoseError
from cfree.exact.half_angle import normalize_angles, sum_of_angles
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose, PoseLike, pose_at, to_pose
from cfree.libraries import np
from cfree.scene.features import BOUNDS, WORKSPACE
from cfree.scene.naming import placed
from cfree.scene.scene import AnyShape, Scene, box_of, robot_radius, size_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from cfree.libraries import Floats

DIRECTIONS, GROWTH = 32, 1.5  # directions in which places are tried on circles, and ratio of successive radii
NEAREST, FARTHEST = 1e-6, 10.0  # least and greatest radius, in lengths of the robot
ROUNDS, TRIES, CLOSER, HALVINGS = 60, 64, 0.85, 45  # of the search for a nearer pose
SAMPLES, MISSES, ENOUGH = 40_000, 3, 0.99  # random poses in each round before that; rounds without a gain that end it
MOST_PEGS = 400  # poses at which two arcs have one center
DIGITS, ROUGHLY = 18, 0.01  # most digits of its numbers; how much farther it may be to have fewer
ROUND = 1e-3  # error of the polygons around ellipses, Bézier curves and splines, in robot sizes
NOTHING = 1e-9  # smaller parts of an offset count as 0
STILL = Translation((0, 0))
TURNS = (0.0, 1.0, -1.0, 5.0, -5.0, 15.0, -15.0, 45.0, -45.0, 90.0, -90.0, 180.0)  # degrees


class ForbiddenPoseError(InvalidPoseError):
    """A pose that is not free; `free` is a free pose near by, if one was found."""

    def __init__(self, message: str, *, free: Pose | None = None) -> None:
        super().__init__(message)
        self.free = free


@dataclass(frozen=True)
class Room:
    """The free poses of a scene: an exact test of one, and of many."""

    scene: Scene
    is_free: Callable[[Pose], bool]
    are_free: Callable[[Floats], NDArray[np.bool_]]


def room_of(scene: Scene | PoseChecker) -> Room:
    """Return the free poses of a scene; polygons around other curves than segments and arcs forbid a little more."""
    if isinstance(scene, Scene) and scene.curved and arcs_of(scene) is None:
        scene = scene.outer(ROUND * max(map(size_of, scene.robot)))
    checker = scene if isinstance(scene, PoseChecker) else PoseChecker(scene)
    return Room(checker.scene, lambda pose: is_free_at(checker, pose), lambda table: are_free(checker, table))


@checked
def require_free(scene: Scene | PoseChecker, pose: PoseLike, name: str = "pose") -> None:
    """Check, exactly, that a pose is free.

    Parameters
    ----------
    scene : Scene or PoseChecker
    pose : Pose or (x, y, theta)
    name : str, optional
        Name of the pose in the message.

    Raises
    ------
    ForbiddenPoseError
        If it is forbidden. The message names a part of the robot, the obstacle that it overlaps, and a free pose near
        by, which is the error's `free`, if one was found.

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
    refuse_forbidden(scene if isinstance(scene, PoseChecker) else PoseChecker(scene), to_pose(pose, "pose"), name)


def refuse_forbidden(checker: PoseChecker, pose: Pose, name: str) -> None:
    """Raise the error of `require_free` if a pose is forbidden; the arguments are not checked."""
    if is_free_at(checker, pose):
        return
    free = _on_circles(room_of(checker), pose, FARTHEST)
    advice = "no free pose was found near by; give another" if free is None else f"{_shown(free)} is free and near by"
    fault = _overlap(checker.scene, pose)
    raise ForbiddenPoseError(f"{name} {_shown(pose)} is forbidden: {fault}; {advice}", free=free)


@checked
def free_nearby(scene: Scene | PoseChecker, pose: PoseLike) -> Pose | None:
    """Return a free pose near another one, with few digits; not the nearest.

    Returns
    -------
    Pose or None
        The nearest of thousands of poses around it that is free, exactly; None if none is. The poses are on circles, a
        millionth to ten times the robot's length away, turned by up to half a turn. The result is always the same.

    Examples
    --------
    >>> wall = [(2, 0), (3, 0), (3, 9), (2, 9)]
    >>> found = free_nearby(Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=[wall]), Pose(1.25, 2))
    >>> float(found.x), float(found.y), found.tau
    (0.96, 2.0, Fraction(0, 1))
    """
    return _on_circles(room_of(scene), to_pose(pose, "pose"), FARTHEST)


@checked
def nearest_free(scene: Scene | PoseChecker, pose: PoseLike) -> Pose | None:
    """Search for the nearest free pose; return the pose itself if it is free.

    Parameters
    ----------
    scene : Scene or PoseChecker
    pose : Pose or (x, y, theta)

    Returns
    -------
    Pose or None
        Free, exactly, and always the same; None if none is found. The distance minimised is that of the reference
        point plus the angle turned times the robot's length. It is not proved that no other pose is nearer.

        Among segments and circular arcs the pose is free among these. Ellipses, Bézier curves and splines are replaced
        by polygons around them, within a thousandth of the robot's size, so that it may be farther away by as much.

    Notes
    -----
    The search begins with `free_nearby`, goes on with random poses closer and closer to the best one, and ends with a
    bisection between it and the pose.

    Examples
    --------
    >>> wall = [(2, 0), (3, 0), (3, 9), (2, 9)]
    >>> scene = Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=[wall])
    >>> nearest_free(scene, Pose("1.25", 2)) == Pose(1, 2)
    True
    """
    pose = to_pose(pose, "pose")
    if isinstance(scene, Scene) and scene.curved and is_free(scene, pose) is True:
        return pose
    return search_nearest(room_of(scene), pose)


def search_nearest(room: Room, pose: Pose) -> Pose | None:
    """Return the pose of `nearest_free`; the arguments are not checked."""
    if room.is_free(pose):
        return pose
    length, (low, high) = _length(room), _extent(room.scene)
    x, y = np.clip((float(pose.x), float(pose.y)), low, high).tolist()
    inside = pose_at(Fraction(x), Fraction(y), pose.tau)
    near = inside if room.is_free(inside) else _on_circles(room, inside, _reach(room.scene, inside) / length)
    held = _in_arcs(room, pose, length)
    if near is None or (held is not None and _way(_offset(pose, held, length)) < _way(_offset(pose, near, length))):
        near = held
    if near is None:
        return None
    here = np.array([float(pose.x), float(pose.y), pose.theta])
    offset = _closer(room, here, _offset(pose, near, length), length)
    most = _way(offset) + ROUGHLY * min(_way(offset), length)
    for digits in range(DIGITS):
        places = [place for turn in (0.0, offset[2]) for place in _rounded(pose, (*offset[:2], turn), length, digits)]
        ways = [(_way(_offset(pose, place, length)), k) for k, place in enumerate(places)]
        for way, k in sorted(ways):
            if way <= most and room.is_free(places[k]):
                return places[k]
    return near


def _closer(room: Room, here: Floats, first: Floats, length: float) -> Floats:
    """Return a shorter offset x, y, length times turn to a free pose, in doubles."""
    rng, best = np.random.default_rng(0), first

    def free(offsets: Floats) -> Floats:
        theta = normalize_angles(here[2] + offsets[:, 2] / length)
        return offsets[room.are_free(np.column_stack([here[:2] + offsets[:, :2], theta]))]

    misses = 0
    while misses < MISSES:
        offsets = free(_ball(rng, _way(best)))
        nearest = min(offsets, key=_way, default=best)
        misses = 0 if _way(nearest) < ENOUGH * _way(best) else misses + 1
        best = nearest
    for k in range(ROUNDS):
        about = best + rng.normal(size=(TRIES, 3)) * (_way(best) * CLOSER**k)
        about[::2, 2] = best[2] * (k % 2)  # half of them without turning, or turned as the best
        about = np.concatenate([about, best * rng.uniform(size=(TRIES // 4, 1))])
        offsets = free(about[[_way(row) < _way(best) for row in about]])
        best = min(offsets, key=_way, default=best)
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (low, middle) if len(free(middle * best[None])) else (middle, high)
    return high * best


def _ball(rng: np.random.Generator, way: float) -> Floats:
    """Return random offsets shorter than a limit."""
    rows = rng.uniform(-way, way, size=(SAMPLES, 3))
    return rows[np.hypot(rows[:, 0], rows[:, 1]) + np.abs(rows[:, 2]) < way]


def _rounded(pose: Pose, offset: Sequence[float], length: float, digits: int) -> Iterator[Pose]:
    """Yield the pose moved by an offset whose numbers are rounded to some digits, each of x and y down and up."""
    size = max(abs(offset[0]), abs(offset[1]), 1e-300)
    unit = Fraction(10) ** (math.floor(math.log10(size)) - digits)
    degrees = math.degrees(offset[2] / length)
    rounded = round(degrees, digits - math.floor(math.log10(abs(degrees)))) if degrees else 0.0
    tau = sum_of_angles(Pose(0, 0, f"{rounded:.12f}deg").tau, pose.tau)
    ends = []
    for c, d in ((pose.x, offset[0]), (pose.y, offset[1])):
        below = math.floor((c + Fraction(d)) / unit)
        ends.append([c] if abs(d) < NOTHING * size else [below * unit, (below + 1) * unit])
    yield from (pose_at(x, y, tau) for x in ends[0] for y in ends[1])


def _offset(pose: Pose, other: Pose, length: float) -> Floats:
    turn = math.remainder(other.theta - pose.theta, math.tau)
    return np.array([float(other.x - pose.x), float(other.y - pose.y), length * turn])


def _way(offset: Floats) -> float:
    return math.hypot(offset[0], offset[1]) + abs(float(offset[2]))


def _length(room: Room) -> float:
    """Return the longer side of the box around the robot's largest part."""
    return max(map(size_of, room.scene.robot))


def _extent(scene: Scene) -> tuple[Floats, Floats]:
    """Return the corners of the bounds, or else of the box around the workspace, or else of the whole plane."""
    if scene.bounds:
        box = tuple(map(float, scene.bounds))
    elif scene.workspace:
        box = box_of(scene.workspace)
    else:
        return np.full(2, -np.inf), np.full(2, np.inf)
    return np.array(box[:2]), np.array(box[2:])


def _others(scene: Scene) -> list[AnyShape]:
    return [*scene.obstacles, *([scene.workspace] if scene.workspace else [])]


def _reach(scene: Scene, pose: Pose) -> float:
    """Return a bound of the distance from a pose beyond which a scene has nothing."""
    boxes = np.array([box_of(shape) for shape in _others(scene)]).reshape(-1, 2)
    room = np.array(scene.bounds, dtype=np.float64).reshape(-1, 2) if scene.bounds else boxes
    corners = np.concatenate([boxes, room, [(float(pose.x), float(pose.y))]])
    return FARTHEST * robot_radius(scene) + 2 * float(np.ptp(corners, axis=0).max())


def _on_circles(room: Room, pose: Pose, farthest: float) -> Pose | None:
    """Return the nearest free one of many poses on circles, whose radii are at most `farthest` robot lengths."""
    length = _length(room)
    offsets = [_circle(NEAREST * length * GROWTH**k, length) for k in range(_circles(farthest))]
    turns = np.array([(0.0, 0.0, turn, 0.0) for turn in TURNS[1:]])
    table = np.concatenate([turns, *offsets])
    table = table[np.argsort(np.hypot(*table[:, :2].T) + length * np.radians(np.abs(table[:, 2])), kind="stable")]
    places = np.array([float(pose.x), float(pose.y)]) + table[:, :2]
    theta = normalize_angles(pose.theta + np.radians(table[:, 2]))
    free = room.are_free(np.column_stack([places, theta]))
    for k in np.flatnonzero(free).tolist():
        turn, digits = table[k, 2:].tolist()
        x, y = (Fraction(round(c, int(digits))) for c in places[k].tolist()) if digits else (pose.x, pose.y)
        near = pose_at(x, y, sum_of_angles(Pose(0, 0, f"{turn:g}deg").tau, pose.tau))
        if room.is_free(near):
            return near
    return None


def _in_arcs(room: Room, pose: Pose, length: float) -> Pose | None:
    """Return the nearest free pose at which an arc of the robot has the center of another arc, as a peg in its hole."""
    if not room.scene.curved:
        return None
    robot, others = (centers(shapes) for shapes in (room.scene.robot, _others(room.scene)))
    taus = [sum_of_angles(Pose(0, 0, f"{turn:g}deg").tau, pose.tau) for turn in TURNS]
    places = [
        pose_at(x - u, y - v, tau)
        for tau in taus
        for u, v in pose_at(Fraction(0), Fraction(0), tau).apply_exact(robot)
        for x, y in others
    ]
    nearest = sorted(places, key=lambda place: _way(_offset(pose, place, length)))[:MOST_PEGS]
    return next(filter(room.is_free, nearest), None)


def centers(shapes: Sequence[AnyShape]) -> list[ExactPoint]:
    """Return the centers of circular arcs."""
    pieces = (piece for shape in shapes if isinstance(shape, Curved) for ring in shape.curves for piece in ring)
    return [*dict.fromkeys(piece.center for piece in pieces if isinstance(piece, Span) and piece.is_circular)]


def _circles(farthest: float) -> int:
    return math.ceil(math.log(farthest / NEAREST, GROWTH)) + 1


def _circle(radius: float, length: float) -> Floats:
    """Return rows x, y, degrees, and the number of digits that a coordinate of that size needs."""
    phi = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    digits = max(1, 1 - math.floor(math.log10(radius)))
    turns = [turn for turn in TURNS if math.radians(abs(turn)) * length <= 4 * radius]
    rows = np.column_stack([radius * np.cos(phi), radius * np.sin(phi)])
    return np.concatenate([np.column_stack([rows, np.full((len(rows), 2), (turn, digits))]) for turn in turns])


def _overlap(scene: Scene, pose: Pose) -> str:
    contact = MotionChecker(scene)._first_contact(pose, STILL)
    if contact is None or contact.obstacle == BOUNDS:  # round shapes keep no bounds
        return "the reference point is outside the bounds"
    if contact.obstacle == WORKSPACE:
        return f"robot part {contact.robot} is not inside the workspace"
    return f"robot part {contact.robot} overlaps {placed(scene, contact.obstacle)}"


def _shown(pose: Pose) -> str:
    return f"({float(pose.x):.12g}, {float(pose.y):.12g}, {math.degrees(pose.theta):.6g} deg)"
