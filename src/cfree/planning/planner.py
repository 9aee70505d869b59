"""`Planner`: paths of motions that are proved free, or proofs that there is no path, for many queries in one scene."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from cfree.arguments import checked
from cfree.collision.motion_checker import MotionChecker
from cfree.exact.number import Number
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.free.space import FreeSpace
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import NONE, Preferences
from cfree.planning.caller import Phase, Work
from cfree.planning.goals import AllSeparated, plan_any, refuse_far, several
from cfree.planning.options import Options, to_distance, to_seconds
from cfree.planning.pose_planner import PosePlanner
from cfree.planning.proof import Proof
from cfree.scene.goals import Goal
from cfree.scene.scene import Scene
from cfree.value import Value
from cfree.vehicles.vehicle import Vehicle

LARGE = 20_000  # least number of vertices of a scene of which a path needs only some obstacles


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
    vehicle : Car or DifferentialDrive, optional
        As in `plan`, for all queries; None is a robot that moves in any direction.
    """

    scene: Scene
    space: FreeSpace | None = None
    max_seconds: float | None = None
    preferences: Preferences = NONE
    progress: Callable[[float], object] | None = None
    phase: Phase = field(default=nullcontext, repr=False)
    stop: threading.Event = field(default_factory=threading.Event, repr=False)  # ends the work in other threads
    work: Work | None = field(default=None, repr=False)  # limits a query
    vehicle: Vehicle | None = None

    @property
    def _content(self) -> tuple[Scene, float | None, Preferences, Vehicle | None]:
        """The settings, without computed data."""
        return self.scene, self.max_seconds, self.preferences, self.vehicle

    def __reduce__(self) -> tuple[Any, ...]:
        return Planner, (self.scene, self.space, self.max_seconds, self.preferences), {"vehicle": self.vehicle}

    @cached_property
    def _poses(self) -> PosePlanner:
        return PosePlanner(self.scene, self.space)

    @property
    def checker(self) -> MotionChecker:
        """Checker of motions in the scene."""
        return self._poses.checker

    @property
    def angle_scale(self) -> float:
        """Length per radian: the robot's radius about its reference point."""
        return self._poses.angle_scale

    @property
    def free_space(self) -> FreeSpace:
        """The free space, computed at first use."""
        self.space = self._poses.free_space(self._options())
        return self.space

    @checked
    def updated(self, scene: Scene) -> Planner:
        """Return a planner for another scene that shares what still holds in it, with the settings of this one.

        Both scenes need the same robot. This planner stays as it is.

        Parameters
        ----------
        scene : Scene
            Such as the scene of this planner with an obstacle moved, or read anew. Obstacles are matched by their
            vertices.

        Notes
        -----
        Patches, closed surfaces and proofs are shared where nothing within the robot's reach has changed, and
        the free space is computed with `reuse` of this one's. The last paths of this planner answer queries between
        poses that one free motion each joins to them: short searches lead them around what is in their way.
        So paths may be others than those of a new planner; each is checked in the new scene. Nothing is shared among
        round shapes. While this planner answers a query in another thread, the call waits for it.

        Examples
        --------
        >>> from cfree import Polygon
        >>> ring = Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(1, 1), (1, 8), (8, 8), (8, 1)]])
        >>> scene = Scene([(0, 0), (1, 0), (0, "0.5")], [ring, [(20, 0), (21, 0), (21, 1)]])
        >>> planner = Planner(scene)
        >>> planner.plan((4, 4, 0), (12, 4, 0)).of
        'closed'
        >>> planner.updated(scene.moved(1, (0, 3, 0))).plan((4, 4, 0), (12, 4, 0)).of
        'closed'
        >>> isinstance(planner.updated(scene.without_obstacle(0)).plan((4, 4, 0), (12, 4, 0)), Path)
        True
        """
        other = replace(self, scene=scene, space=None, stop=threading.Event())
        other._poses = self._poses.updated(scene)
        return other

    @checked
    def plan(
        self,
        start: PoseLike,
        goal: PoseLike,
        *,
        clearance: Number | None = None,
        improve: float | None = None,
        objective: Objective = "balanced",
    ) -> Path | Proof:
        """See `cfree.plan`."""
        start = to_pose(start, "start")
        goal = to_pose(goal, "goal")
        options = self._options(clearance, improve, objective)
        refuse_far(start, goal)
        return answer_for_one(self._poses, start, goal, options)

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
        start = to_pose(start, "start")
        ends = several(goals)
        options = self._options(clearance, improve, objective)
        refuse_far(start, ends)
        return answer_for_any(self._poses, start, ends, options)

    def _options(
        self, clearance: Number | None = None, improve: float | None = None, objective: Objective = "balanced"
    ) -> Options:
        """Check the options of a query, and add those of all queries."""
        return Options(
            improve=to_seconds(improve),
            clearance=to_distance(clearance),
            objective=objective,
            preferences=self.preferences,
            max_seconds=self.max_seconds,
            progress=self.progress,
            vehicle=self.vehicle,
            phase=self.phase,
            stop=self.stop,
            work=self.work,
        )


def answer_for_one(planner: PosePlanner, start: Pose, goal: Pose, options: Options) -> Path | Proof:
    """Answer a query for one pose."""
    if options.clearance:
        from cfree.planning.clearance import plan_at_distance

        return plan_at_distance(planner.scene, start, goal, options)
    return _path_in_parts(planner, start, goal, options) or planner.path_or_proof(start, goal, options)


def _path_in_parts(planner: PosePlanner, start: Pose, goal: Pose, options: Options) -> Path | None:
    """Path in a scene of many obstacles by those near it; None if another way is better, or decides."""
    scene, is_limited = planner.scene, options.work is not None
    if planner.has_space or is_limited or planner.is_among_arcs or scene.curved:
        return None
    if sum(map(len, scene.obstacles)) < LARGE:
        return None
    from cfree.planning.large import ground_of, path_around

    return path_around(ground_of(planner), start, goal, options)


def answer_for_any(planner: PosePlanner, start: Pose, goals: Sequence[Goal], options: Options) -> Path | AllSeparated:
    """Answer a query for several goals, any of which will do."""
    if options.clearance:
        from cfree.planning.clearance import plan_any_at_distance

        return plan_any_at_distance(planner.scene, start, goals, options)
    return plan_any(planner, start, goals, options)
