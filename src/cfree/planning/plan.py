"""`plan`: one planning query and its options."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Literal, cast, overload

from cfree.arguments import checked
from cfree.collision.approximations import Approximations
from cfree.exact.number import Number
from cfree.exact.pose import Pose, PoseLike
from cfree.free.space import FreeSpace
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import NONE, Preferences
from cfree.planning.curved import CurvedQuery
from cfree.planning.goals import AllSeparated, refuse_far
from cfree.planning.moved_ends import free_ends
from cfree.planning.options import Options, to_distance, to_seconds
from cfree.planning.planner import answer_for_any, answer_for_one
from cfree.planning.pose_planner import PosePlanner
from cfree.planning.proof import Proof
from cfree.scene.goals import Goal, to_goals
from cfree.scene.scene import Scene, required, vehicle_for
from cfree.vehicles.vehicle import Vehicle


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
    tolerance: float | None = None,
    nearest_free: bool = False,
    vehicle: Vehicle | Literal["any"] | None = None,
) -> Path | Proof: ...
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
    tolerance: float | None = None,
    nearest_free: bool = False,
    vehicle: Vehicle | Literal["any"] | None = None,
) -> Path | Proof | AllSeparated: ...
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
    tolerance: float | None = None,
    nearest_free: bool = False,
    vehicle: Vehicle | Literal["any"] | None = None,
) -> Path | Proof | AllSeparated:
    """Plan a path from start to goal with every motion proved free, or prove that there is none.

    Parameters
    ----------
    scene : Scene or FreeSpace
        If the free space is given, two calls of `locate` decide whether a path exists, unless exact fits join cells.
    start, goal : Pose or (x, y, theta), optional
        By default those of the scene. A goal may also be a place (x, y), at which any orientation will do, or a
        list of poses and places, any one of which will do; each of them must be free.
    clearance : number, optional
        Distance that the path keeps from obstacles and workspace, not from bounds. If no path keeps it, the answer is a
        proof.
    improve : float, seconds, optional
        Time for improving a path, 0 for the first one found; by default a fixed number of attempts. With a time, other
        paths are also tried, on all cores. Ctrl-C ends it early, and the path so far is the answer.
    objective : "balanced", "short" or "clear"
        The paths to prefer: short ones that keep a distance where there is room, short ones, or ones that keep away
        from obstacles; see Notes.
    preferences : Preferences, optional
        Cost factors, such as of going sideways. They influence which path is found, not if one is.
    max_seconds : float, optional
        Time limit for computing the free space; in a scene with round shapes, for the whole query.
    progress : callable, optional
        Called with the completed share of the free space, if that has to be computed.
    tolerance : float, optional
        The least error of the polygons for round shapes; by default a 2**14th of the robot's size. With neither this
        nor `max_seconds`, a query with round shapes ends undecided after 80,000 contact patches, about 10 s.
    nearest_free : bool
        Move a start or goal that is not free, or has less than the clearance, to the nearest free pose that a search
        finds. The answer has the requested ones: `Path.moved`, `Separated.moved`. Free ones stay, also places among
        segments and arcs at which the robot touches something; among other curves, if polygons prove them free.
    vehicle : Car, DifferentialDrive or "any", optional
        The machine that drives the path; by default the scene's, if it has one. With "any" the robot moves in any
        direction.

    Returns
    -------
    Path, Separated, Stuck, Unreachable or AllSeparated
        A path leads to the goal with the shortest path found. `AllSeparated` is for places and lists. `Stuck` is a
        proof that contacts at one end hold the vehicle. `Unreachable` is a proof by boxes of poses that a car without
        reverse gear has no path.

    Raises
    ------
    InvalidPoseError
        If there is no start or goal, or the robot overlaps an obstacle there, or has less than the clearance; at a
        place, in all orientations. Among round shapes a place counts as forbidden if polygons prove it.
    IncompleteError
        If `max_seconds` ran out. Subclass `UndecidedError`: the clearance is within 0.1 % of the largest possible
        (carries the interval), or the polygons for round shapes were too coarse (carries their error), or a vehicle
        needs too many manoeuvres (carries the proof that it can), or none without reverse gear were found.

    Notes
    -----
    A path's length is that of the reference point's path, plus the turning times the robot's radius about that point.
    The same query has the same answer everywhere, unless `improve` is a time. "balanced" keeps a share of the clearance
    at the path's bottleneck, and then of the clearance at the next bottleneck in each remaining part. Among such paths
    it prefers short ones of few motions. `clearance` certifies the distance that a path keeps. "clear" searches for a
    path of a robot grown by the largest margin that works, between the first and the last place on a short path where
    the grown robot fits.

    Among segments and arcs a robot without vehicle and preferences turns no more than it needs to on the way that was
    found. A balanced path still turns where that makes a very narrow place twice as wide.

    In a scene of polygons with 20,000 vertices and more, a path is planned among the obstacles near it, to a far goal
    along a route: docs/shards.md. Time and memory follow the path's length.

    A vehicle that reverses reaches every pose of its cell that touches nothing, whatever its turning radius. So
    `Separated` is a proof for every vehicle. "balanced" keeps half of the distance that a path of the robot keeps
    there, and no more than a twentieth of the robot's length. Where that takes many changes of direction, it keeps a
    quarter, an eighth or nothing, if the path then costs less than two thirds. The first path (`improve=0`) keeps none.

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
    options = Options(
        improve=to_seconds(improve),
        clearance=to_distance(clearance),
        objective=objective,
        preferences=preferences or NONE,
        tolerance=tolerance,
        nearest_free=nearest_free,
        max_seconds=max_seconds,
        progress=progress,
        vehicle=vehicle_for(scene, vehicle),
    )
    if not scene.curved and tolerance is not None:
        raise ValueError(f"tolerance {tolerance}: of scenes with round shapes; leave it out")
    if goal is None and scene.goals:
        goal = scene.goals
    goals = () if goal is None else to_goals(goal)
    begin, one = required(scene, start, goals if isinstance(goals, Pose) else Pose(0, 0) if goals else None)
    return _answer(scene, space, begin, goals if isinstance(goals, tuple) and goals else one, options)


def _answer(
    scene: Scene, space: FreeSpace | None, start: Pose, goals: Pose | tuple[Goal, ...], options: Options
) -> Path | Proof | AllSeparated:
    """Answer a query for one pose, or for several goals, any of which will do."""
    ends = None
    if options.nearest_free:
        ends = free_ends(scene, start, (goals,) if isinstance(goals, Pose) else goals, options.clearance or None)
        start, goals = ends.start, cast(Pose, ends.goals[0]) if isinstance(goals, Pose) else ends.goals
    refuse_far(start, goals)

    def ask(planner: PosePlanner, options: Options) -> Path | Proof | AllSeparated:
        if isinstance(goals, Pose):
            return answer_for_one(planner, start, goals, options)
        return answer_for_any(planner, start, goals, options)

    if scene.curved:
        query = CurvedQuery(Approximations(scene, options.tolerance), options)
        poses = (start, goals) if isinstance(goals, Pose) else (start, *goals)
        answer = query.answer(ask, poses, for_any=not isinstance(goals, Pose))
    else:
        answer = ask(PosePlanner(scene, space), options)
    return ends.marked(answer) if ends else answer
