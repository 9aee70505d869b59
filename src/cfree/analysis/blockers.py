"""Which single obstacles, taken away, open a way: each is decided exactly, and few have to be."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from cfree.arguments import checked
from cfree.exact.number import Number
from cfree.exact.pose import PoseLike
from cfree.paths.path import Path
from cfree.planning.planner import Planner
from cfree.planning.separation import Separated
from cfree.scene.scene import Scene, required, with_obstacles


@checked
@dataclass(frozen=True)
class Blocker:
    """An obstacle without which there is a way.

    Parameters
    ----------
    obstacle : int
        Its number in the scene.
    path : Path
        From start to goal, free in the scene without it.
    """

    obstacle: int
    path: Path


@checked
def blockers(
    scene: Scene,
    start: PoseLike | None = None,
    goal: PoseLike | None = None,
    *,
    clearance: Number | None = None,
    progress: Callable[[float], object] | None = None,
) -> tuple[Blocker, ...]:
    """The obstacles that separate start and goal, each of them: without any one of these there is a path.

    Parameters
    ----------
    scene : Scene
    start, goal : Pose or (x, y, theta), optional
        Those of the scene unless given.
    clearance : number, optional
        As of `plan`: what the path has to keep.
    progress : callable, optional
        Called with the share that is done, from 0 to 1.

    Returns
    -------
    tuple of Blocker
        In the order of the scene. Empty if no single obstacle, taken away, opens a way: bounds and workspace are none.

    Raises
    ------
    ValueError
        If there is a path as it is.
    UndecidedError
        Of a clearance that is too near to the largest, with all obstacles or without one.

    Notes
    -----
    A surface that separates is made of poses of contact with some obstacles, and with these it stays one, whatever
    else is taken away, or put back. So if it separates "closed", only an obstacle whose contacts are on it can be one
    to return; and only one on the surfaces found so far, all of them, has to be decided. If paths are left that touch,
    "interior", each obstacle is.

    Examples
    --------
    >>> walls = [[(2, -9), (3, -9), (3, 9), (2, 9)], [(3, -9), (4, -9), (4, -2), (3, -2)], [(-9, 5), (-8, 5), (-8, 6)]]
    >>> scene = Scene([(0, 0), (1, 0), (1, 1), (0, 1)], walls, bounds=(-5, -5, 5, 5))
    >>> (wall,) = blockers(scene, (0, 0, 0), (4, 0, 0))
    >>> wall.obstacle, wall.path.scene.obstacle_names
    (0, ('obstacle 1', 'obstacle 2'))
    """
    start, goal = required(scene, start, goal)
    answer = Planner(scene).plan(start, goal, clearance=clearance, improve=0)
    if isinstance(answer, Path):
        raise ValueError("start and goal are joined: nothing is in the way")
    possible, found = _possible(answer, range(len(scene.obstacles))), list[Blocker]()
    for done, k in enumerate(todo := sorted(possible)):
        if progress is not None:
            progress(done / len(todo))
        if k in possible:
            answer = Planner(_without(scene, k)).plan(start, goal, clearance=clearance)
            if isinstance(answer, Path):
                found.append(Blocker(k, answer))
            else:  # its surfaces name obstacles by their numbers in a scene with one less
                numbers = [i for i in range(len(scene.obstacles)) if i != k]
                possible &= _possible(answer, numbers) | {blocker.obstacle for blocker in found}
    return tuple(found)


def _possible(proof: Separated, numbers: range | list[int]) -> set[int]:
    """Obstacles without which it may be no proof, by their numbers in the whole scene."""
    return {numbers[i] for i in proof.obstacles if i >= 0} if proof.of == "closed" else set(numbers)


def _without(scene: Scene, k: int) -> Scene:
    obstacles, names = list(scene.obstacles), list(scene.obstacle_names)
    del obstacles[k], names[k]
    return with_obstacles(scene, obstacles, names)
