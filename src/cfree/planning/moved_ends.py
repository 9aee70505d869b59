"""Starts and goals that are not free, moved to the nearest free poses that a search finds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from cfree.collision.nearer import require_distance
from cfree.collision.nearest_free import ROUND, refuse_forbidden, room_of, search_nearest
from cfree.collision.pose_checker import PoseChecker, is_free, is_free_at
from cfree.errors import InvalidPoseError
from cfree.exact.pose import Pose, pose_at
from cfree.free.turn_in_place import free_orientations
from cfree.paths.path import Path
from cfree.planning.goals import AllSeparated, name_of
from cfree.planning.proof import Proof
from cfree.planning.round_places import is_free_place
from cfree.polygons.disc import around_disc
from cfree.scene.dilation import grown_by
from cfree.scene.goals import Goal, Moved, text_of
from cfree.scene.scene import Scene, grown_scene, size_of, with_robot

SIDES = 100  # sides of the polygon around a disc whose radius is a clearance


@dataclass(frozen=True)
class Ends:
    """A start and goals that are free, with the requested ones.

    Attributes
    ----------
    start : Pose
    goals : tuple of Pose or place
    requested_start : Pose or None
        The requested start; None if it was not moved.
    requested_goals : tuple of Pose, place or None
        The requested goals; None for those that were not moved.
    """

    start: Pose
    goals: tuple[Goal, ...]
    requested_start: Pose | None
    requested_goals: tuple[Goal | None, ...]

    def marked(self, answer: Path | Proof | AllSeparated) -> Path | Proof | AllSeparated:
        """Return the answer with the requested ends that were moved."""
        if isinstance(answer, AllSeparated):
            return replace(answer, proofs=tuple(replace(proof, moved=self._of(proof.goal)) for proof in answer.proofs))
        return replace(answer, moved=self._of(answer.goal))

    def _of(self, goal: Pose) -> Moved | None:
        """Return the requested ends of an answer for one of the goals; None if none was moved."""
        pairs = zip(self.goals, self.requested_goals, strict=True)
        its_goal = next((requested for end, requested in pairs if end in (goal, (goal.x, goal.y))), None)
        return None if its_goal is None and self.requested_start is None else Moved(self.requested_start, its_goal)


def free_ends(scene: Scene, start: Pose, goals: Sequence[Goal], clearance: Fraction | None) -> Ends:
    """Move start and goals that are not free to the nearest free poses that a search finds.

    Parameters
    ----------
    scene : Scene
    start : Pose
    goals : sequence of Pose or place
        A place is free if any orientation is.
    clearance : Fraction or None
        Distance that they must keep from obstacles and workspace.

    Raises
    ------
    InvalidPoseError
        If no free pose is found.
    """
    straight = scene.outer(max(map(size_of, scene.robot)) * ROUND) if scene.curved else scene
    ring = None if clearance is None else around_disc(clearance, SIDES)
    checker = PoseChecker(straight if ring is None else with_robot(straight, grown_by(straight, ring), straight.bounds))
    grown = grown_scene(scene, clearance) if scene.curved and clearance else scene

    def is_fit(end: Goal) -> bool:
        if not isinstance(end, Pose):
            if free_orientations(checker.scene, end):
                return True
            return scene.curved and is_free_place(grown, end) is True
        if clearance is None or scene.curved:
            return is_free_at(checker, end) or is_free(grown, end) is True
        try:
            refuse_forbidden(PoseChecker(scene), end, "pose")
            require_distance(scene, end, clearance)
        except InvalidPoseError:
            return False
        return True

    def moved(end: Goal, name: str) -> Goal:
        if is_fit(end):
            return end
        if isinstance(end, Pose):
            near = search_nearest(room_of(grown if scene.curved else checker), end)
        else:  # a little farther among round shapes, so that an interval of orientations is free
            near = search_nearest(room_of(checker), pose_at(*end, start.tau))
        if near is None:
            far = "" if clearance is None else f" and {float(clearance):g} away from everything"
            raise InvalidPoseError(f"{name} {text_of(end)}: no pose near by is free{far}; give another")
        return near if isinstance(end, Pose) else (near.x, near.y)

    begin = moved(start, "start")
    ends = tuple(moved(goal, name_of(goals, k)) for k, goal in enumerate(goals))
    assert isinstance(begin, Pose)
    requested = tuple(None if goal == end else goal for goal, end in zip(goals, ends, strict=True))
    return Ends(begin, ends, None if begin == start else start, requested)
