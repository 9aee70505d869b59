"""Planning to any one of several goals: poses, and places at which any orientation is accepted.

The free orientations at a place are closed intervals. Each interval is in the closure of one cell, as the robot can
turn there, so one pose represents it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Literal, NoReturn

from cfree.arguments import checked
from cfree.collision.nearest_free import refuse_forbidden
from cfree.collision.pose_checker import PoseChecker
from cfree.errors import InvalidPoseError, UndecidedError
from cfree.exact.angle_interval import AngleInterval, orientation_of
from cfree.exact.number import LARGEST, ExactPoint
from cfree.exact.pose import Pose, pose_at
from cfree.paths.path import Path
from cfree.paths.preferences import Preferences
from cfree.planning.proof import Proof
from cfree.planning.separation import NO_TRUTH_VALUE, Separated
from cfree.scene.digest import Stamp
from cfree.scene.goals import Goal, to_goals
from cfree.scene.scene import Scene
from cfree.value import Answer, Shown
from cfree.words import coordinate, counted

if TYPE_CHECKING:
    from cfree.planning.options import Options
    from cfree.planning.pose_planner import PosePlanner

BITS = 20  # first number of bits of an orientation next to the end of an interval; doubled as often as needed
INWARD = math.radians(10)  # distance from the end of an interval, if a quarter of the interval is not less


@checked
@dataclass(frozen=True, repr=False)
class AllSeparated(Shown, Answer):
    """A proof that no motion leads to any of several goals.

    It has no truth value, as `Separated` has none.

    Parameters
    ----------
    proofs : tuple of Separated, Stuck or Unreachable
        All from one start: one for each goal that is a pose, and for each interval of free orientations at a place.
    places : tuple of (x, y)
        Goals at which any orientation will do.
    of : "closed", "interior" or "pieces"
        "closed": no path at all leads to any of them. "interior": no path that keeps a distance does. Then a proof is
        "interior", or an exact fit at a place is left out because its half-angle tangent is irrational. "pieces": no
        path of finitely many lines and arcs of the vehicle leads to any of them, as contacts or boxes show.
    """

    proofs: tuple[Proof, ...]
    places: tuple[ExactPoint, ...]
    of: Literal["closed", "interior", "pieces"]

    def __bool__(self) -> NoReturn:
        raise TypeError(f"{type(self).__name__}: {NO_TRUTH_VALUE}")

    def __repr__(self) -> str:
        counts = f"{counted(len(self.goals), 'goal')}, {counted(len(self.proofs), 'proof')}"
        return f"AllSeparated(of={self.of!r}, {counts})"

    @property
    def goals(self) -> tuple[Goal, ...]:
        """The places, and the poses that are at none of them."""
        poses = (proof.goal for proof in self.proofs)
        return *self.places, *(pose for pose in poses if (pose.x, pose.y) not in self.places)

    @property
    def start(self) -> Pose:
        """The start of all proofs."""
        return self.proofs[0].start

    @property
    def moved_goals(self) -> dict[Goal, Goal]:
        """The requested goals, by the free poses and places that they were moved to."""
        requested: dict[Goal, Goal] = {}
        for proof in self.proofs:
            if proof.moved and proof.moved.goal is not None:
                is_place = not isinstance(proof.moved.goal, Pose)
                requested[(proof.goal.x, proof.goal.y) if is_place else proof.goal] = proof.moved.goal
        return requested

    @property
    def clearance(self) -> Fraction:
        """Distance from obstacles and workspace, if not 0: no path that keeps it leads to any goal."""
        return max(proof.clearance for proof in self.proofs)

    @property
    def units(self) -> str:
        """Unit of length."""
        return self.proofs[0].units

    @property
    def scene(self) -> Scene | None:
        """The scene of the proof; None if it was read from a file."""
        return self.proofs[0].scene

    @property
    def curved(self) -> Scene | None:
        """The scene with round shapes, if it is a proof for these."""
        return self.proofs[0].curved

    @property
    def stamp(self) -> Stamp | None:
        """The scene's stamp in the file."""
        return self.proofs[0].stamp

    @property
    def obstacles(self) -> tuple[int, ...]:
        """The blocking obstacles, whose contacts form the separating surfaces; -1 is the bounds, -2 the workspace."""
        return tuple(sorted({k for proof in self.proofs for k in proof.obstacles}))


def several(goals: Any) -> tuple[Goal, ...]:
    """Convert an argument to several goals, or to one in a tuple."""
    ends = to_goals(goals)
    return (ends,) if isinstance(ends, Pose) else ends


def refuse_far(start: Pose, goals: Pose | Sequence[Goal]) -> None:
    """Raise `InvalidPoseError` if a position is too far away for the core's numbers."""
    ends = {"goal": goals} if isinstance(goals, Pose) else {f"goal {k}": goal for k, goal in enumerate(goals)}
    for name, end in ({"start": start} | ends).items():
        x, y = (end.x, end.y) if isinstance(end, Pose) else end
        if max(abs(x), abs(y)) > LARGEST:
            raise InvalidPoseError(f"{name}: its position is beyond 1e150; give one nearer to the scene")


def plan_any(planner: PosePlanner, start: Pose, goals: Sequence[Goal], options: Options) -> Path | AllSeparated:
    """Return the cheapest of the paths found to the goals, or a proof for each goal."""
    checker = PoseChecker(planner.scene)
    refuse_forbidden(checker, start, "start")
    poses, is_whole = dict[Pose, None](), True
    for k, goal in enumerate(goals):
        name = name_of(goals, k)
        if isinstance(goal, Pose):
            refuse_forbidden(checker, goal, name)
            poses[goal] = None
        else:
            at_place = list(_poses_at(planner.scene, goal, start, name))
            poses |= dict.fromkeys(pose for pose in at_place if pose is not None)
            is_whole = is_whole and None not in at_place

    paths, proofs, undecided = list[Path](), list[Proof](), None
    left = list(poses)
    for few in (True, False):
        ways = {pose: planner.way(start, pose, options, few=few) for pose in left}
        free = [way for way in ways.values() if isinstance(way, list)]
        for way in free:
            try:
                answer = planner.answered(way, options.shared(len(free)))
            except UndecidedError as error:  # of a vehicle
                undecided = error
                continue
            if isinstance(answer, Path):
                paths.append(answer)
            else:
                proofs.append(answer)
        if paths:
            return cheapest(paths, planner.scene, options.preferences)
        proofs += [way for way in ways.values() if isinstance(way, Separated)]
        left = [pose for pose, way in ways.items() if way is None]
    if undecided is not None:
        raise undecided
    order = {pose: k for k, pose in enumerate(poses)}
    return all_separated(sorted(proofs, key=lambda proof: order[proof.goal]), goals, is_whole=is_whole)


def name_of(goals: Sequence[Goal], k: int) -> str:
    """Return the name of a goal in messages."""
    return "goal" if len(goals) == 1 else f"goal {k}"


def no_orientation(name: str, place: ExactPoint, clearance: Fraction = Fraction(0)) -> InvalidPoseError:
    """Return the error of a place at which no orientation is free, or keeps a clearance."""
    where = f"{name} ({coordinate(float(place[0]))}, {coordinate(float(place[1]))})"
    if not clearance:
        return InvalidPoseError(f"{where}: no orientation is free there; give another place")
    near = f"the robot is nearer to something than {float(clearance):g}"
    return InvalidPoseError(f"{where}: however it is turned there, {near}; give another place, or less clearance")


def cheapest(paths: Sequence[Path], scene: Scene, preferences: Preferences) -> Path:
    """Return the path of least cost by preferences."""
    return min(paths, key=lambda path: preferences.cost(path, scene)) if len(paths) > 1 else paths[0]


def all_separated(proofs: Sequence[Proof], goals: Sequence[Goal], *, is_whole: bool) -> AllSeparated:
    """Combine the proofs for all goals; `is_whole` is True if no orientation at a place is left out."""
    is_closed = is_whole and all(proof.of == "closed" for proof in proofs)
    places = tuple(dict.fromkeys(goal for goal in goals if not isinstance(goal, Pose)))
    is_held = is_whole and all(not isinstance(proof, Separated) or proof.of == "closed" for proof in proofs)
    return AllSeparated(tuple(proofs), places, "closed" if is_closed else "pieces" if is_held else "interior")


def _poses_at(scene: Scene, place: ExactPoint, start: Pose, name: str) -> Iterator[Pose | None]:
    """Yield one pose for each interval of free orientations, turned little from the start; None if irrational."""
    from cfree.free.turn_in_place import free_orientations

    intervals = free_orientations(scene, place)
    if not intervals:
        raise no_orientation(name, place)
    for interval in intervals:
        yield pose_in(interval, start, place)


def pose_in(interval: AngleInterval, start: Pose, place: ExactPoint) -> Pose | None:
    """Return a pose at a place with an orientation in an interval, turned little from the start; None if irrational."""

    def pose(tau: Fraction | None) -> Pose:
        return pose_at(*place, tau)

    if interval.start is None or interval.stop is None or interval.contains(orientation_of(start.tau)):
        return pose(start.tau)
    if interval.is_single:
        low, high = interval.start.neighbours(BITS)
        return pose(low) if low == high else None
    first, last = interval.theta
    inward = min(INWARD, (last - first) / 4)
    to_first, to_last = (abs(math.remainder(start.theta - end, math.tau)) for end in (first, last))
    near = Pose(*place, first + inward if to_first < to_last else last - inward)
    bits = BITS
    while not interval.contains(orientation_of(near.tau)):  # the interval is too narrow
        near = pose(interval.start.neighbours(bits)[1])
        bits *= 2
    return near
