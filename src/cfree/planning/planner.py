"""Can the robot get from start to goal? A path of motions that are proved free, or a proof that there is none.

The core answers, `planner.hpp` says how; here are the objects, and paths are improved.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Any

import cfree._core as _core
from cfree.arguments import checked
from cfree.collision.motion import motion_between
from cfree.collision.motion_checker import MotionChecker
from cfree.collision.nearest_free import require_free
from cfree.collision.slide import Slide
from cfree.errors import InvalidPoseError, InvariantError
from cfree.exact.number import Number, to_fraction
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.free.space import FreeSpace, built_space
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import NONE, Preferences
from cfree.planning.caller import Caller, Phase, Work
from cfree.planning.core_ways import Slides, end_of, from_numbers, numbers_of, way_of
from cfree.planning.goals import AllSeparated, plan_any
from cfree.planning.improving import Improver
from cfree.planning.near_poles import near_poles
from cfree.planning.separation import Separated, known_scene
from cfree.scene.coordinate_range import LARGEST
from cfree.scene.goals import to_goals
from cfree.scene.scene import Scene, robot_radius
from cfree.value import Value

COMPLETE = 30_000  # contact patches at most of a grown robot whose free space is computed


@checked
@dataclass(eq=False)
class Planner(Value):
    """Answers many questions about one scene; what they need is computed once.

    Parameters
    ----------
    scene : Scene
    space : FreeSpace, optional
        Computed when needed, unless given.
    max_seconds, progress
        As in `plan`, for that computation.
    preferences : Preferences
        As in `plan`, for all questions.
    phase : callable, optional
        Called with the name of each long part of the work; gives a context for it, which gives what to call with the
        share of that part that is done, or None.
    """

    scene: Scene
    space: FreeSpace | None = None
    max_seconds: float | None = None
    preferences: Preferences = NONE
    progress: Callable[[float], object] | None = None
    phase: Phase = field(default=nullcontext, repr=False)
    stop: threading.Event = field(default_factory=threading.Event, repr=False)  # ends what runs in other threads
    work: Work | None = field(default=None, repr=False)  # ends a question
    _slides: Slides = field(default_factory=dict, repr=False)  # by the poses that they join

    @property
    def _content(self) -> tuple[Scene, float | None, Preferences]:
        """Not whether something has been computed."""
        return self.scene, self.max_seconds, self.preferences

    def __reduce__(self) -> tuple[Any, ...]:
        return Planner, (self.scene, self.space, self.max_seconds, self.preferences)

    @cached_property
    def checker(self) -> MotionChecker:
        return MotionChecker(self.scene)

    @cached_property
    def angle_scale(self) -> float:
        """Length per radian: the robot's radius about its reference point."""
        return robot_radius(self.scene)

    @cached_property
    def _known(self) -> _core.KnownScene:
        return known_scene(self.checker, self.space)

    @cached_property
    def _planner(self) -> _core.Planner:
        return _core.Planner(self._known, self.angle_scale)

    @property
    def free_space(self) -> FreeSpace:
        """The cells, computed when first asked for."""
        if self.space is None:
            built = self._known.build(self._caller())
            self.space = built_space(self.scene, self.checker.features, *built)
        return self.space

    @checked
    def plan(
        self,
        start: PoseLike,
        goal: PoseLike,
        *,
        clearance: Number | None = None,
        improve: float | None = None,
        objective: Objective = "balanced",
    ) -> Path | Separated:
        """See `cfree.plan`."""
        start = to_pose(start, "start")
        goal = to_pose(goal, "goal")
        distance = _wish(clearance, improve)
        _see_to_places({"start": start, "goal": goal})
        if distance is not None:
            from cfree.planning.clearance import plan_at_distance

            return plan_at_distance(self.scene, start, goal, distance, self._of, improve, objective)
        way = self.way(start, goal)
        assert way is not None, "all is asked"
        return self.improved(way, improve, objective) if isinstance(way, list) else way

    @checked
    def plan_any(
        self,
        start: PoseLike,
        goals: Sequence[Any],
        *,
        clearance: Number | None = None,
        improve: float | None = None,
        objective: Objective = "balanced",
    ) -> Path | AllSeparated:
        """See `cfree.plan`, for several goals, or places."""
        found = to_goals(goals)
        found = (found,) if isinstance(found, Pose) else found
        distance, start = _wish(clearance, improve), to_pose(start, "start")
        places = {f"goal {k}": goal if isinstance(goal, Pose) else Pose(*goal) for k, goal in enumerate(found)}
        _see_to_places({"start": start} | places)
        if distance is not None:
            from cfree.planning.clearance import plan_any_at_distance

            return plan_any_at_distance(self, start, found, distance, self._of, improve, objective)
        return plan_any(self, start, found, improve, objective)

    def _of(self, scene: Scene) -> Planner:
        """For the same question with another robot."""
        return Planner(scene, None, self.max_seconds, self.preferences, self.progress, self.phase, self.stop, self.work)

    @checked
    def improved(self, way: Sequence[Pose], improve: float | None, objective: Objective) -> Path:
        """A path from poses of one."""
        parts = self._without_slides(way)
        seconds = improve and improve / len(parts)
        with self.phase("clearer paths" if objective == "clear" else "shorter paths"):
            if objective == "clear":
                balanced = (self._improver(part).balanced(part, None) for part in parts)
                return self.path([q for part in balanced for q in self._cleared(part, seconds)])

            def better(part: Sequence[Pose]) -> Sequence[Pose]:
                improver = self._improver(part)
                method = improver.balanced if objective == "balanced" else improver.shortened
                return method(part, seconds)

            return self.path([q for part in parts for q in better(part)])

    @checked
    def way(self, start: Pose, goal: Pose, *, few: bool = False) -> list[Pose] | Separated | None:
        """Poses of a path, or a proof; None if few surfaces were to be enough, and are not. The same both ways."""
        try:
            found = self._planner.plan(end_of(start), end_of(goal), self._caller(), few)
        except InvariantError as error:
            error.state = self.scene, start, goal
            raise
        if found == "unclear":
            return None
        if isinstance(found, str):
            require_free(self.scene, start if found == "start" else goal, found)
            raise InvariantError(f"{found} is free, and it is not", state=(self.scene, start, goal))
        if isinstance(found, _core.Separation):
            return Separated._of(found, self.scene, start, goal)
        return way_of(found, self.checker.features, self._slides)

    @checked
    def barrier(self, start: Pose, goal: Pose) -> _core.Separation | None:
        """A closed surface between two poses at which the robot touches nothing, if there is one."""
        return self._known.barrier(numbers_of(start), numbers_of(goal), self._caller())

    @checked
    def walk(self, start: Pose, goal: Pose) -> list[Pose] | None:
        """Poses of a path along the boundary of the first cell that both are in or on the boundary of, if one is."""
        found = self._planner.walk(end_of(start), end_of(goal), self._caller())
        return None if found is None else way_of(found, self.checker.features, self._slides)

    def _caller(self) -> Caller:
        return Caller(self.phase, self.progress, self.max_seconds, self.stop, self.work)

    @checked
    def path(self, poses: Sequence[Pose]) -> Path:
        """Through these poses, without far poles where that is free; all of it checked once more.

        Raises
        ------
        InvariantError
            If a motion is not free: a fault of cfree.
        """
        parts = self._without_slides(poses)
        poses = [q for part in parts for q in near_poles(self.scene, self.checker, part)]
        motions = [self._slide(a, b) or motion_between(a, b) for a, b in pairwise(poses) if a != b]
        found = Path(poses[0], motions, self.scene.units, scene=self.scene)
        if not found.is_free(self.checker):
            raise InvariantError("a path is not free", state=found)
        return found

    def _slide(self, a: Pose, b: Pose) -> Slide | None:
        """The slide that joins two poses, if one does."""
        if not self._slides:
            return None
        back = self._slides.get((b, a))
        return back.reversed() if back else self._slides.get((a, b))

    def _without_slides(self, poses: Sequence[Pose]) -> list[Sequence[Pose]]:
        """Parts of a way, joined by slides."""
        after = [k for k in range(1, len(poses)) if self._slide(poses[k - 1], poses[k])]
        return [poses[i:j] for i, j in pairwise([0, *after, len(poses)])]

    def _cleared(self, poses: Sequence[Pose], seconds: float | None) -> Sequence[Pose]:
        from cfree.planning.keep_clear import clear

        end = time.perf_counter() + (seconds or 0)

        def way_of(scene: Scene, start: Pose, goal: Pose) -> Sequence[Pose] | None:
            larger = Planner(scene, preferences=self.preferences)
            found: Sequence[Pose] | None = larger.quick(start, goal)
            if found is None and larger.checker.features.patches <= COMPLETE:
                found = larger.walk(start, goal)
            if found is None or len(larger._without_slides(found)) > 1:
                return None
            left = seconds and max(0.0, end - time.perf_counter()) / 3
            return larger._improver(found).shortened(found, left)

        return clear(self.scene, self.checker, poses, self.angle_scale, way_of)

    @checked
    def quick(self, start: Pose, goal: Pose) -> Sequence[Pose] | None:
        """Poses of a path between free poses, if simple ways or a search find one."""
        found = self._planner.quick(end_of(start), end_of(goal), self._caller())
        return None if found is None else [*map(from_numbers, found)]

    def _improver(self, poses: Sequence[Pose]) -> Improver:
        costs = self.angle_scale, *self.preferences.factors
        searcher = _core.Searcher(self._known, [end_of(pose)[1] for pose in poses], costs)
        return Improver(self.scene, self.checker, searcher, self.preferences, self.stop)


def _wish(clearance: Number | None, improve: float | None) -> Fraction | None:
    """The clearance; what is wrong with either is said."""
    if improve is not None and not 0 <= improve < math.inf:
        raise ValueError(f"improve {improve}: give seconds, 0 or more")
    if clearance is not None and to_fraction(clearance) <= 0:
        raise ValueError(f"clearance {clearance}: give a length above 0")
    return None if clearance is None else to_fraction(clearance)


def _see_to_places(poses: Mapping[str, Pose]) -> None:
    for name, pose in poses.items():
        if max(abs(pose.x), abs(pose.y)) > LARGEST:
            raise InvalidPoseError(f"{name}: its position is beyond 1e150; give one nearer to the scene")
