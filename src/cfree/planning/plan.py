"""One question, and all that may be wished of its answer."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, cast, overload

from cfree.arguments import checked
from cfree.exact.number import Number
from cfree.exact.pose import Pose, PoseLike
from cfree.free.space import FreeSpace
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import NONE, Preferences
from cfree.planning.curved import CurvedPlanner
from cfree.planning.goals import AllSeparated
from cfree.planning.moved_ends import free_ends
from cfree.planning.planner import Planner
from cfree.planning.separation import Separated
from cfree.scene.goals import to_goals
from cfree.scene.scene import Scene, required


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
    tolerance: float | None = None,
    nearest_free: bool = False,
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
    tolerance: float | None = None,
    nearest_free: bool = False,
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
        Give up if computing the free space takes longer; for a scene with round shapes, if all of it does.
    progress : callable, optional
        Called with the share of the free space that is computed, if it has to be.
    tolerance : float, optional
        The least error of the polygons for round shapes; a 2**14th of the robot's size if left out. If neither this nor
        `max_seconds` is given, a question about round shapes ends undecided after 100,000 contact patches, about 10 s.
    nearest_free : bool
        Move a start or goal that is not free, or keeps less than the clearance, to the nearest free pose that a search
        finds. The answer says so: `Path.moved`, `Separated.moved`.

    Returns
    -------
    Path, Separated or AllSeparated
        A path leads to the goal that is reached by the shortest path found. The last is for places and lists.

    Raises
    ------
    InvalidPoseError
        If there is no start or goal, or the robot overlaps an obstacle there, or is nearer than the clearance; at a
        place in all orientations.
    IncompleteError
        If `max_seconds` were not enough. If the largest clearance of a path is within 0.1 % of the one asked for this
        is an `UndecidedError`, which has the interval; so if polygons for round shapes do not tell, with their error.

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
    of_polygons = Planner(scene, space, max_seconds, preferences or NONE, progress)
    planner = CurvedPlanner(of_polygons, tolerance) if scene.curved else of_polygons
    if not scene.curved and tolerance is not None:
        raise ValueError(f"tolerance {tolerance}: of scenes with round shapes; leave it out")
    if goal is None and scene.goals:
        goal = scene.goals
    goals = () if goal is None else to_goals(goal)
    start, one = required(scene, start, goals if isinstance(goals, Pose) else Pose(0, 0) if goals else None)
    several = goals if isinstance(goals, tuple) and goals else None
    ends = free_ends(scene, start, several or (one,), clearance) if nearest_free else None
    if ends:
        start, several, one = ends.start, several and ends.goals, cast(Pose, ends.goals[0])
    answer: Path | Separated | AllSeparated
    if several:
        answer = planner.plan_any(start, several, clearance=clearance, improve=improve, objective=objective)
    else:
        answer = planner.plan(start, one, clearance=clearance, improve=improve, objective=objective)
    return ends.marked(answer) if ends else answer
