"""Can the robot get from start to goal? A path of motions that are proved free, or a proof that there is none.

Cheap things come first: one motion, a turn and a straight way, then a search with random poses. What they do not
settle, the cells of the free space do: they name the answer, and a walk along a cell's boundary is a path.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any, get_args, overload

import cfree._core as _core
from cfree.arguments import checked
from cfree.collision.motion import Rotation, motion_between
from cfree.collision.motion_checker import MotionChecker
from cfree.collision.nearest_free import require_free
from cfree.collision.slide import Slide
from cfree.errors import IncompleteError, InvalidPoseError, InvariantError
from cfree.exact.number import Number, to_fraction
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.forbidden.boundary import boundary
from cfree.free.space import FreeSpace
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import NONE, Preferences
from cfree.planning.goals import AllSeparated, plan_any
from cfree.planning.improving import Improver
from cfree.planning.near_poles import near_poles
from cfree.planning.rrt_connect import Searcher, area, simple_ways
from cfree.planning.separation import Insets, Separated, inset_powers, separation
from cfree.planning.surroundings import STEP, Surroundings
from cfree.scene.coordinate_range import LARGEST
from cfree.scene.goals import to_goals
from cfree.scene.scene import Scene, required, robot_radius
from cfree.value import Value

if TYPE_CHECKING:
    from cfree.planning.boundary_walk import Walker
    from cfree.planning.exact_fits import Passages

Phase = Callable[[str], AbstractContextManager[Any]]
SEARCH = 10_000  # motions checked at most before all of the free space is built
QUICK = 1000  # before anything exact is
CHECKS = 1  # that take about as long as a trapezoid of a surface
COMPLETE = 30_000  # contact patches at most of a grown robot whose free space is computed
BLOCK = 200  # motions checked between two looks at the clock and at Ctrl-C


@overload
def plan(
    scene: Scene | FreeSpace,
    start: PoseLike | None,
    goal: Pose | tuple[Any, Any, Any],
    *,
    clearance: Number | None = None,
    improve: float | None = None,
    objective: Objective = "balanced",
    preferences: Preferences | None = None,
    max_seconds: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Path | Separated: ...
@overload
def plan(
    scene: Scene | FreeSpace,
    start: PoseLike | None = None,
    goal: PoseLike | Sequence[PoseLike] | None = None,
    *,
    clearance: Number | None = None,
    improve: float | None = None,
    objective: Objective = "balanced",
    preferences: Preferences | None = None,
    max_seconds: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Path | Separated | AllSeparated: ...
@checked
def plan(
    scene: Scene | FreeSpace,
    start: PoseLike | None = None,
    goal: PoseLike | Sequence[PoseLike] | None = None,
    *,
    clearance: Number | None = None,
    improve: float | None = None,
    objective: Objective = "balanced",
    preferences: Preferences | None = None,
    max_seconds: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Path | Separated | AllSeparated:
    """A path from start to goal, each motion of it proved free, or a proof that there is none.

    Parameters
    ----------
    scene : Scene or FreeSpace
        With its free space known, which of the two it is takes two calls of `locate`, unless exact fits join cells.
    start, goal : Pose or (x, y, theta), optional
        Those of the scene unless given. A goal may also be a place (x, y), at which any orientation will do, or a
        list of poses and places, any one of which will.
    clearance : number, optional
        A distance that the path keeps from obstacles and workspace; not from bounds. Or no path does, proved.
    improve : float, seconds, optional
        How long to improve a path, 0 for the first one found. A fixed number of attempts unless given; given a time,
        other ways are tried, too, on all cores. Ctrl-C ends it early, and the path so far is the answer.
    objective : "balanced", "short" or "clear"
        What to prefer: short paths that keep a distance where there is room, short ones, or paths that keep away from
        obstacles; see Notes.
    preferences : Preferences, optional
        What a machine would rather not do, such as going sideways. They decide which path is found, not whether one is.
    max_seconds : float, optional
        Give up if computing the free space takes longer.
    progress : callable, optional
        Called with the share of the free space that is computed, if it has to be.

    Returns
    -------
    Path, Separated or AllSeparated
        A path leads to the goal that is reached by the shortest path found. The last is for places and lists.

    Raises
    ------
    InvalidPoseError
        If there is no start or goal, or the robot overlaps an obstacle there, or is nearer than the clearance.
    IncompleteError
        If `max_seconds` were not enough. If the largest clearance of a path is within 0.1 % of the one asked for this
        is an `UndecidedError`, which has the interval.

    Notes
    -----
    A path's length is the way of the reference point, plus the turning times the robot's radius about that point. The
    same question has the same answer everywhere, unless a time is given. "balanced" keeps a share of the distance that
    the narrowest place of the way taken has, and of what is left beside that, of the narrowest place there; then it
    prefers short paths of few motions. What a path keeps, `clearance` certifies. "clear" looks for a path of a robot
    grown by a margin, as large as is found, between the first place on a short path where that one fits and the last.

    Examples
    --------
    >>> import cfree
    >>> wall = [(2, -9), (3, -9), (3, 1), (2, 1)]
    >>> scene = cfree.Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=[wall], bounds=(-5, -5, 5, 5))
    >>> path = plan(scene, cfree.Pose(0, 0), cfree.Pose(4, 0))
    >>> path.is_free(cfree.MotionChecker(scene)), path.goal == cfree.Pose(4, 0)
    (True, True)
    """
    space = scene if isinstance(scene, FreeSpace) else None
    scene = scene.boundary.scene if isinstance(scene, FreeSpace) else scene
    planner = Planner(scene, space, max_seconds, preferences or NONE, progress)
    if goal is None and scene.goals:
        goal = scene.goals
    if goal is not None and isinstance(goals := to_goals(goal), tuple):
        start, _ = required(scene, start, Pose(0, 0))
        return planner.plan_any(start, goals, clearance=clearance, improve=improve, objective=objective)
    return planner.plan(*required(scene, start, goal), clearance=clearance, improve=improve, objective=objective)


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
    _slides: dict[tuple[Pose, Pose], Slide] = field(default_factory=dict, repr=False)  # by the poses that they join
    _lock: threading.RLock = field(default_factory=threading.RLock, repr=False)  # of all that is kept for later

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
    def _walker(self) -> Walker:
        """Of the free space."""
        from cfree.planning.boundary_walk import Walker

        return Walker(self.free_space, self.checker, self.angle_scale, self._slides)

    @cached_property
    def _surroundings(self) -> Surroundings:
        return Surroundings(self.scene, self.checker)

    @cached_property
    def _insets(self) -> Insets:
        return Insets(self.scene)

    @cached_property
    def _passages(self) -> Passages:
        from cfree.planning.exact_fits import Passages

        return Passages(self._walker)

    @property
    def free_space(self) -> FreeSpace:
        """The cells, computed when first asked for."""
        from cfree.free.space import free_space

        if self.space is None:
            with self.phase("free space") as share:
                progress = share if callable(share) else self.progress
                found = boundary(self.scene, max_seconds=self.max_seconds, progress=progress)
            if not found.complete:
                raise self._late()
            with self.phase("cells"):
                self.space = free_space(found)
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
        distance = _wish(clearance, improve, objective)
        _see_to_places({"start": start, "goal": goal})
        if distance is not None:
            from cfree.planning.clearance import plan_at_distance

            return plan_at_distance(self.scene, start, goal, distance, self._of, improve, objective)
        way = self._way(start, goal)
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
        distance, start = _wish(clearance, improve, objective), to_pose(start, "start")
        places = {f"goal {k}": goal if isinstance(goal, Pose) else Pose(*goal) for k, goal in enumerate(found)}
        _see_to_places({"start": start} | places)
        return plan_any(self, start, found, distance, improve, objective)

    def _of(self, scene: Scene) -> Planner:
        """For the same question with another robot."""
        return Planner(scene, None, self.max_seconds, self.preferences, self.progress, self.phase, self.stop)

    @checked
    def improved(self, way: Sequence[Pose], improve: float | None, objective: Objective) -> Path:
        """A path from poses of one."""
        parts = self._without_slides(way)
        seconds = improve and improve / len(parts)
        with self.phase("clearer paths" if objective == "clear" else "shorter paths"):
            if objective == "clear":
                shorter = (self._improver(part).shortened(part, None) for part in parts)
                return self.path([q for part in shorter for q in self._cleared(part, seconds)])
            better = [
                improver.balanced(part, seconds) if objective == "balanced" else improver.shortened(part, seconds)
                for part in parts
                for improver in [self._improver(part)]
            ]
            return self.path([q for part in better for q in part])

    def _way(self, start: Pose, goal: Pose) -> list[Pose] | Separated:
        """Poses of a path, or a proof; the way back is the same."""
        ends = sorted((start, goal), key=lambda q: (q.x, q.y, q.tau is None, q.tau or 0))
        first, last = ends
        with self.phase("simple ways"):
            poses = self.checker.first_free(simple_ways(first, last)) if first != last else None
            if poses is None:  # a motion that is free has free ends
                for pose, name in ((start, "start"), (goal, "goal")):
                    if not self.checker.joins([pose, pose]):
                        require_free(self.scene, pose, name)
                if start == goal:
                    return [start]
                if self.space is not None and self.space.common_cell(first, last) is not None:
                    poses = self._searched(first, last, QUICK)
        if poses is None:
            with self._lock:
                answer = (self._by_few(first, last) if self.space is None else None) or self._known(first, last)
            if not isinstance(answer, list):
                return answer if first == start else answer.reversed()
            poses = answer
        return list(poses) if first == start else _reversed(poses)

    def _known(self, start: Pose, goal: Pose) -> list[Pose] | Separated:
        """What the free space says: poses of a path, or a proof."""
        quick, *others = inset_powers(self.scene)
        space = self.free_space
        with self.phase("path in a cell"):
            if (cell := space.common_cell(start, goal)) is not None:
                return self._walker.walk(start, goal, cell)
        with self.phase("proof"):
            proof = self._insets.closed(start, goal, quick)
        if proof is not None:
            return proof
        with self.phase("exact fits"):
            if (way := self._passages.path(start, goal)) is not None:
                return way
        with self.phase("closer proofs"):
            proof = separation(space, start, goal, others, self._insets)
        assert proof is not None, "not in one cell"
        if proof.of == "closed":
            return proof
        with self.phase("other exact fits"):
            return self._passages.path(start, goal, irrational=True) or proof

    def _by_few(self, start: Pose, goal: Pose) -> list[Pose] | Separated | None:
        """What a search finds, or the closed surfaces around the two poses say; None if that is unclear.

        In turns, by counted work: the same answer everywhere, in about twice the time of the better of both.
        """
        searcher = self._searcher([start, goal])
        search, begin = searcher.search(start, goal), time.perf_counter()
        with self.phase("search"):
            if route := search.run(QUICK):
                return searcher.poses(route)
        with self.phase("surfaces around the two poses"):
            most, found = STEP, self._surroundings.connecting(start, goal)
            while not found.run(most):
                self._look_up()
                if 2 * CHECKS * most <= self._checks and (route := search.run(CHECKS * most)):
                    return searcher.poses(route)
                if self.max_seconds is not None and time.perf_counter() - begin > self.max_seconds:
                    raise self._late()
                most *= 2
            if found.verdict == _core.Verdict.JOINED:
                return found.way(self.angle_scale, self._slides)
            end = found.inside if found.verdict == _core.Verdict.APART else None
            return self._insets.closed(start, goal, inset_powers(self.scene)[0], end)

    def _late(self) -> IncompleteError:
        return IncompleteError(f"{self.max_seconds} seconds were not enough to compute the free space; give more")

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
            found = larger.quick(start, goal)
            is_small = larger.checker.features.patches <= COMPLETE
            if found is None and is_small and (cell := larger.free_space.common_cell(start, goal)) is not None:
                found = larger._walker.walk(start, goal, cell)
            if found is None or len(larger._without_slides(found)) > 1:
                return None
            left = seconds and max(0.0, end - time.perf_counter()) / 3
            return larger._improver(found).shortened(found, left)

        return clear(self.scene, self.checker, poses, self.angle_scale, way_of)

    @property
    def _checks(self) -> int:
        """Motions that a search may check: these take about as long as the free space does."""
        return min(SEARCH, 500 + 3 * self.checker.features.patches // 2)

    @checked
    def quick(self, start: Pose, goal: Pose) -> Sequence[Pose] | None:
        """Poses of a path, if simple ways or a search find one."""
        return self.checker.first_free(simple_ways(start, goal)) or self._searched(start, goal)

    def _searched(self, start: Pose, goal: Pose, most: int = SEARCH) -> Sequence[Pose] | None:
        searcher = self._searcher([start, goal])
        search = searcher.search(start, goal)
        for _ in range(0, min(most, self._checks), BLOCK):
            self._look_up()
            if found := search.run(BLOCK):
                return searcher.poses(found)
        return None

    def _look_up(self) -> None:
        if self.stop.is_set():
            raise KeyboardInterrupt

    def _searcher(self, poses: Sequence[Pose]) -> Searcher:
        return Searcher(self.checker, area(self.scene, poses), self.angle_scale, self.preferences)

    def _improver(self, poses: Sequence[Pose]) -> Improver:
        return Improver(self.scene, self.checker, self._searcher(poses), self.preferences, self.stop)


def _wish(clearance: Number | None, improve: float | None, objective: str) -> Fraction | None:
    """The clearance; what is wrong with any of the three is said."""
    if objective not in get_args(Objective):
        raise ValueError(f'objective {objective!r}; give "balanced", "short" or "clear"')
    if improve is not None and not 0 <= improve < math.inf:
        raise ValueError(f"improve {improve}: give seconds, 0 or more")
    if clearance is not None and to_fraction(clearance) <= 0:
        raise ValueError(f"clearance {clearance}: give a length above 0")
    return None if clearance is None else to_fraction(clearance)


def _see_to_places(poses: Mapping[str, Pose]) -> None:
    for name, pose in poses.items():
        if max(abs(pose.x), abs(pose.y)) > LARGEST:
            raise InvalidPoseError(f"{name}: its position is beyond 1e150; give one nearer to the scene")


def _reversed(poses: Sequence[Pose]) -> list[Pose]:
    """The way back, in as many motions; half a turn, which could go on either side, in two."""
    back = [poses[-1]]
    for after, pose in pairwise(reversed(poses)):
        motion = motion_between(pose, after)
        if motion.tau is None:
            back.append(Rotation(motion.pole, "90deg").apply(pose))
        back.append(pose)
    return back
