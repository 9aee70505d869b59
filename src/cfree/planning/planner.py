"""`Planner`: paths of motions that are proved free, or proofs that there is no path, for many queries in one scene.

The C++ core plans (see `planner.hpp`); this module wraps its answers in objects and improves paths.
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
from cfree.scene.frame import frame_of
from cfree.scene.goals import to_goals
from cfree.scene.scene import Scene, robot_radius
from cfree.value import Value

COMPLETE = 30_000  # most contact patches of a grown robot whose free space is computed


@checked
@dataclass(eq=False)
class Planner(Value):
    """Planner for many queries in one scene; shared data are computed once.

    Parameters
    ----------
    scene : Scene
    space : FreeSpace, optional
        Computed at first use by default.
    max_seconds, progress
        As in `plan`, for that computation.
    preferences : Preferences
        As in `plan`, for all queries.
    phase : callable, optional
        Called with the name of each long part of the work; returns a context for it. The context's value is called with
        the completed share of that part, or is None.
    """

    scene: Scene
    space: FreeSpace | None = None
    max_seconds: float | None = None
    preferences: Preferences = NONE
    progress: Callable[[float], object] | None = None
    phase: Phase = field(default=nullcontext, repr=False)
    stop: threading.Event = field(default_factory=threading.Event, repr=False)  # ends the work in other threads
    work: Work | None = field(default=None, repr=False)  # limits a query
    _slides: Slides = field(default_factory=dict, repr=False)  # by the poses that they join

    @property
    def _content(self) -> tuple[Scene, float | None, Preferences]:
        """The settings, without computed data."""
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
        """The free space, computed at first use."""
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
        assert way is not None, "the search was complete"
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
        ends = to_goals(goals)
        ends = (ends,) if isinstance(ends, Pose) else ends
        distance, start = _wish(clearance, improve), to_pose(start, "start")
        places = {f"goal {k}": goal if isinstance(goal, Pose) else Pose(*goal) for k, goal in enumerate(ends)}
        _see_to_places({"start": start} | places)
        if distance is not None:
            from cfree.planning.clearance import plan_any_at_distance

            return plan_any_at_distance(self, start, ends, distance, self._of, improve, objective)
        return plan_any(self, start, ends, improve, objective)

    def _of(self, scene: Scene) -> Planner:
        """Return a planner with the same settings for the same query with another robot."""
        return Planner(scene, None, self.max_seconds, self.preferences, self.progress, self.phase, self.stop, self.work)

    @checked
    def improved(self, way: Sequence[Pose], improve: float | None, objective: Objective) -> Path:
        """Improve a path, given by its poses."""
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
        """Return poses of a path, or a proof; None if `few` surfaces do not decide. Swapped ends give the same."""
        try:
            answer = self._planner.plan(end_of(start), end_of(goal), self._caller(), few)
        except InvariantError as error:
            error.state = self.scene, start, goal
            raise
        if answer == "unclear":
            return None
        if isinstance(answer, str):
            require_free(self.scene, start if answer == "start" else goal, answer)
            raise InvariantError(f"{answer} is free, and it is not", state=(self.scene, start, goal))
        if isinstance(answer, _core.Separation):
            return Separated._of(answer, self.scene, start, goal)
        return way_of(answer, self.checker.features, self._slides)

    @checked
    def barrier(self, start: Pose, goal: Pose) -> _core.Separation | None:
        """Return a surface that separates two poses at which the robot touches nothing; None if there is none."""
        return self._known.barrier(numbers_of(start), numbers_of(goal), self._caller())

    @checked
    def walk(self, start: Pose, goal: Pose) -> list[Pose] | None:
        """Return poses of a path along the boundary of the first cell whose closure contains both; None without one."""
        way = self._planner.walk(end_of(start), end_of(goal), self._caller())
        return None if way is None else way_of(way, self.checker.features, self._slides)

    def _caller(self) -> Caller:
        return Caller(self.phase, self.progress, self.max_seconds, self.stop, self.work)

    @checked
    def path(self, poses: Sequence[Pose]) -> Path:
        """Return a path through these poses, without far poles where that is free; every motion is checked again.

        Raises
        ------
        InvariantError
            If a motion is not free: a fault of cfree.
        """
        parts = self._without_slides(poses)
        poses = [q for part in parts for q in near_poles(self.scene, self.checker, part)]
        motions = [self._slide(a, b) or motion_between(a, b) for a, b in pairwise(poses) if a != b]
        path = Path(poses[0], motions, self.scene.units, frame_of(self.scene), scene=self.scene)
        if not path.is_free(self.checker):
            raise InvariantError("a path is not free", state=path)
        return path

    def _slide(self, a: Pose, b: Pose) -> Slide | None:
        """Return the slide that joins two poses; None if there is none."""
        if not self._slides:
            return None
        back = self._slides.get((b, a))
        return back.reversed() if back else self._slides.get((a, b))

    def _without_slides(self, poses: Sequence[Pose]) -> list[Sequence[Pose]]:
        """Divide a path, given by its poses, at its slides."""
        after = [k for k in range(1, len(poses)) if self._slide(poses[k - 1], poses[k])]
        return [poses[i:j] for i, j in pairwise([0, *after, len(poses)])]

    def _cleared(self, poses: Sequence[Pose], seconds: float | None) -> Sequence[Pose]:
        from cfree.planning.keep_clear import clear

        end = time.perf_counter() + (seconds or 0)

        def way_of(scene: Scene, start: Pose, goal: Pose) -> Sequence[Pose] | None:
            larger = Planner(scene, preferences=self.preferences)
            way: Sequence[Pose] | None = larger.quick(start, goal)
            if way is None and larger.checker.features.patches <= COMPLETE:
                way = larger.walk(start, goal)
            if way is None or len(larger._without_slides(way)) > 1:
                return None
            left = seconds and max(0.0, end - time.perf_counter()) / 3
            return larger._improver(way).shortened(way, left)

        return clear(self.scene, self.checker, poses, self.angle_scale, way_of)

    @checked
    def quick(self, start: Pose, goal: Pose) -> Sequence[Pose] | None:
        """Return poses of a path between free poses; None if neither simple paths nor a search gives one."""
        way = self._planner.quick(end_of(start), end_of(goal), self._caller())
        return None if way is None else [*map(from_numbers, way)]

    def _improver(self, poses: Sequence[Pose]) -> Improver:
        costs = self.angle_scale, *self.preferences.factors
        searcher = _core.Searcher(self._known, [end_of(pose)[1] for pose in poses], costs)
        return Improver(self.scene, self.checker, searcher, self.preferences, self.stop)


def _wish(clearance: Number | None, improve: float | None) -> Fraction | None:
    """Check both options; return the clearance."""
    if improve is not None and not 0 <= improve < math.inf:
        raise ValueError(f"improve {improve}: give seconds, 0 or more")
    if clearance is not None and to_fraction(clearance) <= 0:
        raise ValueError(f"clearance {clearance}: give a length above 0")
    return None if clearance is None else to_fraction(clearance)


def _see_to_places(poses: Mapping[str, Pose]) -> None:
    for name, pose in poses.items():
        if max(abs(pose.x), abs(pose.y)) > LARGEST:
            raise InvalidPoseError(f"{name}: its position is beyond 1e150; give one nearer to the scene")
