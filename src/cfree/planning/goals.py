"""Goals any one of which will do: poses, and places at which any orientation will.

The free orientations at a place are closed intervals; all of one are in the closure of one cell, as the robot can turn
there. So one pose stands for each of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Literal, NoReturn

from cfree.arguments import checked
from cfree.collision.nearest_free import require_free
from cfree.errors import InvalidPoseError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.paths.path import Objective, Path
from cfree.planning.separation import NO_TRUTH_VALUE, Separated
from cfree.scene.digest import Stamp
from cfree.scene.goals import Goal
from cfree.scene.scene import Scene
from cfree.value import Answer, Shown
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.exact.angle_interval import AngleInterval
    from cfree.planning.asked import Planner

BITS = 20  # of orientations next to the end of an interval, then twice as many, and so on
INWARD = math.radians(10)  # from the end of an interval, or a quarter of it


@checked
@dataclass(frozen=True, repr=False)
class AllSeparated(Shown, Answer):
    """A proof that no motion leads to any of several goals.

    It has no truth value, as `Separated` has none.

    Parameters
    ----------
    proofs : tuple of Separated
        From one start: of each goal that is a pose, and of each place one for every interval of free orientations.
    places : tuple of (x, y)
        Goals at which any orientation will do.
    of : "closed" or "interior"
        "closed": no path at all leads to any of them. "interior": no path that keeps a distance; a proof is so, or at a
        place an orientation is left out at which the robot fits exactly, and whose half-angle tangent is irrational.
    """

    proofs: tuple[Separated, ...]
    places: tuple[ExactPoint, ...]
    of: Literal["closed", "interior"]

    def __bool__(self) -> NoReturn:
        raise TypeError(f"{type(self).__name__}: {NO_TRUTH_VALUE}")

    def __repr__(self) -> str:
        counts = f"{counted(len(self.goals), 'goal')}, {counted(len(self.proofs), 'proof')}"
        return f"AllSeparated(of={self.of!r}, {counts})"

    @property
    def goals(self) -> tuple[Goal, ...]:
        """Places, and the poses that are at none of them."""
        poses = (proof.goal for proof in self.proofs)
        return *self.places, *(pose for pose in poses if (pose.x, pose.y) not in self.places)

    @property
    def start(self) -> Pose:
        """The same in all proofs."""
        return self.proofs[0].start

    @property
    def moved_goals(self) -> dict[Goal, Goal]:
        """Goals as they were asked for, by the free poses and places that they were moved to."""
        found = {}
        for proof in self.proofs:
            if proof.moved and proof.moved.goal is not None:
                is_place = not isinstance(proof.moved.goal, Pose)
                found[(proof.goal.x, proof.goal.y) if is_place else proof.goal] = proof.moved.goal
        return found

    @property
    def clearance(self) -> Fraction:
        """If not 0: no path leads to any of them that keeps at least this distance from obstacles and workspace."""
        return max(proof.clearance for proof in self.proofs)

    @property
    def units(self) -> str:
        """Unit of length."""
        return self.proofs[0].units

    @property
    def scene(self) -> Scene | None:
        """What it is a proof for; None if it was read from a file."""
        return self.proofs[0].scene

    @property
    def curved(self) -> Scene | None:
        """With round shapes, if it is a proof for these."""
        return self.proofs[0].curved

    @property
    def stamp(self) -> Stamp | None:
        """What the file said of the scene."""
        return self.proofs[0].stamp

    @property
    def obstacles(self) -> tuple[int, ...]:
        """Whose contacts form the surfaces; -1 is the bounds, -2 the workspace."""
        return tuple(sorted({k for proof in self.proofs for k in proof.obstacles}))


def plan_any(
    planner: Planner,
    start: Pose,
    goals: Sequence[Goal],
    improve: float | None,
    objective: Objective,
) -> Path | AllSeparated:
    """A path to one of the goals, of those that are found the shortest; or a proof for each of them."""
    require_free(planner.scene, start, "start")
    poses, is_whole = dict[Pose, None](), True
    for k, goal in enumerate(goals):
        name = name_of(goals, k)
        if isinstance(goal, Pose):
            require_free(planner.scene, goal, name)
            poses[goal] = None
        else:
            found = list(_poses_at(planner.scene, goal, start, name))
            poses |= dict.fromkeys(pose for pose in found if pose is not None)
            is_whole = is_whole and None not in found

    ways = [planner.way(start, pose, few=True) for pose in poses]
    if not any(isinstance(way, list) for way in ways):
        ways = [planner.way(start, pose) if way is None else way for way, pose in zip(ways, poses, strict=True)]
    free = [way for way in ways if isinstance(way, list)]
    if free:
        paths = [planner.improved(way, improve and improve / len(free), objective) for way in free]
        return cheapest(paths, planner)
    return all_separated([proof for proof in ways if isinstance(proof, Separated)], goals, is_whole=is_whole)


def name_of(goals: Sequence[Goal], k: int) -> str:
    """Name of a goal in messages."""
    return "goal" if len(goals) == 1 else f"goal {k}"


def cheapest(paths: Sequence[Path], planner: Planner) -> Path:
    """The path that costs least by the planner's preferences."""
    return min(paths, key=lambda path: planner.preferences.cost(path, planner.scene))


def all_separated(proofs: Sequence[Separated], goals: Sequence[Goal], *, is_whole: bool) -> AllSeparated:
    """Proofs for all goals as one; `is_whole` if no orientation at a place is left out."""
    is_closed = is_whole and all(proof.of == "closed" for proof in proofs)
    places = tuple(dict.fromkeys(goal for goal in goals if not isinstance(goal, Pose)))
    return AllSeparated(tuple(proofs), places, "closed" if is_closed else "interior")


def _poses_at(scene: Scene, place: ExactPoint, start: Pose, name: str) -> Iterator[Pose | None]:
    """One pose of each interval of free orientations, turned little from the start; None of one that is irrational."""
    from cfree.free.turn_in_place import turn_in_place

    x, y = place
    intervals = turn_in_place(scene, Pose(x, y))
    if not intervals:
        raise InvalidPoseError(f"{name} ({float(x):g}, {float(y):g}): no orientation is free there; give another place")
    for interval in intervals:
        yield pose_in(interval, start, place)


def pose_in(interval: AngleInterval, start: Pose, place: ExactPoint) -> Pose | None:
    """A pose at a place with its orientation in an interval, turned little from the start; None if irrational."""

    def pose(tau: Fraction | None) -> Pose:
        return Pose(*place, {"tau": tau})

    if interval.start is None or interval.stop is None or interval.contains({"tau": start.tau}):
        return pose(start.tau)
    if interval.is_single:
        low, high = interval.start.neighbours(BITS)
        return pose(low) if low == high else None
    first, last = interval.theta
    inward = min(INWARD, (last - first) / 4)
    to_first, to_last = (abs(math.remainder(start.theta - end, math.tau)) for end in (first, last))
    near = Pose(*place, first + inward if to_first < to_last else last - inward)
    bits = BITS
    while not interval.contains({"tau": near.tau}):  # it is that narrow
        near = pose(interval.start.neighbours(bits)[1])
        bits *= 2
    return near
