"""`plan_many`: many planning queries in one scene, on all cores."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable
from typing import Literal

from cfree.arguments import checked
from cfree.errors import InvalidPoseError, UndecidedError
from cfree.exact.pose import PoseLike
from cfree.forbidden.boundary import boundary
from cfree.free.space import FreeSpace
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import NONE, Preferences
from cfree.planning.curved import CurvedPlanner
from cfree.planning.planner import Planner
from cfree.planning.proof import Proof
from cfree.scene.scene import Scene, vehicle_for
from cfree.vehicles.vehicle import Vehicle


@checked
def plan_many(
    scene: Scene | FreeSpace,
    queries: Iterable[tuple[PoseLike, PoseLike]],
    *,
    improve: float | None = None,
    objective: Objective = "balanced",
    preferences: Preferences | None = None,
    vehicle: Vehicle | Literal["any"] | None = None,
    threads: int | None = None,
    progress: Callable[[float], object] | None = None,
) -> list[Path | Proof]:
    """Answer many planning queries in one scene.

    Parameters
    ----------
    scene : Scene or FreeSpace
    queries : pairs (start, goal) of Pose or (x, y, theta)
    improve : float, seconds, optional
        As in `plan`, for each of them.
    objective : "balanced", "short" or "clear"
    preferences : Preferences, optional
        As in `plan`.
    vehicle : Car, DifferentialDrive or "any", optional
        As in `plan`.
    threads : int, optional
        All cores by default. The answers do not depend on it, unless `improve` is given.
    progress : callable, optional
        Called with the completed share, from 0 to 1.

    Returns
    -------
    list of Path, Separated, Stuck or Unreachable
        In the order of the queries, as from `plan` with the free space known; among round shapes as from `plan`.

    Raises
    ------
    InvalidPoseError
        If a start or a goal is forbidden; the message has the number of the query.
    UndecidedError
        If a query stays undecided, as `plan` has it; the message has its number.
    ValueError
        If `threads` is less than 1.

    Examples
    --------
    >>> import cfree
    >>> wall = [(2, -9), (3, -9), (3, 1), (2, 1)]
    >>> scene = cfree.Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=[wall], bounds=(-5, -5, 5, 5))
    >>> poses = [cfree.Pose(x, y) for x in (0, 4) for y in (-4, 4)]
    >>> [type(answer).__name__ for answer in plan_many(scene, [(poses[0], q) for q in poses[1:]])]
    ['Path', 'Path', 'Path']
    """
    from concurrent.futures import ThreadPoolExecutor

    from cfree.free.space import free_space

    if threads is not None and threads < 1:
        raise ValueError(f"threads: {threads}; give at least 1")
    todo, space = list(queries), scene if isinstance(scene, FreeSpace) else None
    world = scene if isinstance(scene, Scene) else scene.boundary.scene
    if space is None and not world.curved:
        space = free_space(boundary(world, max_seconds=math.inf))
    driver = vehicle_for(world, vehicle)
    planner, answers = Planner(world, space, preferences=preferences or NONE, vehicle=driver), list[Path | Proof]()

    def answer_to(number: int) -> Path | Proof:
        asked = CurvedPlanner(planner) if world.curved else planner  # each refines polygons of its own
        try:
            return asked.plan(*todo[number], improve=improve, objective=objective)
        except (InvalidPoseError, UndecidedError) as error:
            error.args = (f"query {number}: {error}",)
            raise

    with ThreadPoolExecutor(threads or os.cpu_count()) as pool:
        try:
            for answer in pool.map(answer_to, range(len(todo))):
                answers.append(answer)
                if progress is not None:
                    progress(len(answers) / len(todo))
        except BaseException:
            planner.stop.set()
            pool.shutdown(cancel_futures=True)
            raise
        finally:
            planner.stop.clear()
    return answers
