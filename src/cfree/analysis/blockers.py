"""Single obstacles whose removal opens a path: each is decided exactly, and few have to be."""

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
    """An obstacle without which there is a path.

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
    """Find each single obstacle whose removal opens a path from start to goal.

    Parameters
    ----------
    scene : Scene
    start, goal : Pose or (x, y, theta), optional
        By default those of the scene.
    clearance : number, optional
        Distance that the path must keep, as in `plan`.
    progress : callable, optional
        Called with the completed share, from 0 to 1.

    Returns
    -------
    tuple of Blocker
        In the order of the scene. Empty if the removal of no single obstacle opens a path. Bounds and workspace do not
        count as obstacles.

    Raises
    ------
    ValueError
        If there is a path with all obstacles.
    UndecidedError
        If the clearance is too near to the largest, with all obstacles or without one.

    Notes
    -----
    A separating surface consists of contacts with some obstacles, and remains one as long as these remain. So if the
    proof is "closed", only obstacles with contacts on it can be returned, and only those on all surfaces found so far
    have to be decided. If it is "interior", because paths in contact may remain, every obstacle has to be decided.

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
    if not isinstance(answer, Separated):
        raise ValueError("start and goal are joined: nothing is in the way")
    possible, result = _possible(answer, range(len(scene.obstacles))), list[Blocker]()
    for done, k in enumerate(todo := sorted(possible)):
        if progress is not None:
            progress(done / len(todo))
        if k in possible:
            answer = Planner(_without(scene, k)).plan(start, goal, clearance=clearance)
            if isinstance(answer, Path):
                result.append(Blocker(k, answer))
            elif isinstance(answer, Separated):  # its surfaces name obstacles by their numbers in a scene with one less
                numbers = [i for i in range(len(scene.obstacles)) if i != k]
                possible &= _possible(answer, numbers) | {blocker.obstacle for blocker in result}
    return tuple(result)


def _possible(proof: Separated, numbers: range | list[int]) -> set[int]:
    """Return the obstacles without which the proof may fail, by their numbers in the whole scene."""
    return {numbers[i] for i in proof.obstacles if i >= 0} if proof.of == "closed" else set(numbers)


def _without(scene: Scene, k: int) -> Scene:
    obstacles, names = list(scene.obstacles), list(scene.obstacle_names)
    del obstacles[k], names[k]
    return with_obstacles(scene, obstacles, names)
