"""Single obstacles whose removal opens a path: each is decided exactly, and few have to be."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from cfree.arguments import checked
from cfree.errors import UndecidedError
from cfree.exact.number import Number
from cfree.exact.pose import PoseLike
from cfree.paths.path import Path
from cfree.planning.curved import CurvedPlanner
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


class Blockers(tuple[Blocker, ...]):
    """The single obstacles whose removal opens a path: a tuple of `Blocker`.

    Attributes
    ----------
    undecided : dict
        The reason for each obstacle without which it stayed undecided if there is a path, among round shapes.
    """

    undecided: dict[int, str]

    def __new__(cls, decided: Iterable[Blocker] = (), undecided: dict[int, str] | None = None) -> Blockers:
        result = super().__new__(cls, decided)
        result.undecided = undecided or {}
        return result

    def __getnewargs__(self) -> tuple[tuple[Blocker, ...], dict[int, str]]:
        return tuple(self), self.undecided

    def __repr__(self) -> str:
        more = "".join(f"; obstacle {k} is undecided" for k in self.undecided)
        return f"{tuple(self)!r}{more}"


@checked
def blockers(
    scene: Scene,
    start: PoseLike | None = None,
    goal: PoseLike | None = None,
    *,
    clearance: Number | None = None,
    progress: Callable[[float], object] | None = None,
) -> Blockers:
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
        count as obstacles. Among round shapes a path is free among these, and polygons inside of them prove that there
        is none. Where they do not, the tuple's dict `undecided` has the reason, by the number of the obstacle.

    Raises
    ------
    ValueError
        If there is a path with all obstacles.
    UndecidedError
        If the clearance is too near to the largest, with all obstacles or without one; or if polygons near round shapes
        do not decide with all obstacles.

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
    planner = _planner(scene)
    answer = planner.plan(start, goal, clearance=clearance, improve=0)
    if not isinstance(answer, Separated):
        raise ValueError("start and goal are joined: nothing is in the way")
    possible, result = _possible(planner, answer, range(len(scene.obstacles))), list[Blocker]()
    undecided = dict[int, str]()
    for done, k in enumerate(todo := sorted(possible)):
        if progress is not None:
            progress(done / len(todo))
        if k not in possible:
            continue
        planner = _planner(_without(scene, k))
        try:
            answer = planner.plan(start, goal, clearance=clearance)
        except UndecidedError as error:
            if not scene.curved:
                raise
            undecided[k] = str(error)
            continue
        if isinstance(answer, Path):
            result.append(Blocker(k, answer))
        elif isinstance(answer, Separated):  # its surfaces name obstacles by their numbers in a scene with one less
            numbers = [i for i in range(len(scene.obstacles)) if i != k]
            possible &= _possible(planner, answer, numbers) | {blocker.obstacle for blocker in result}
    return Blockers(result, {k: why for k, why in undecided.items() if k in possible})


def _planner(scene: Scene) -> Planner | CurvedPlanner:
    planner = Planner(scene)
    return CurvedPlanner(planner) if scene.curved else planner


def _possible(planner: Planner | CurvedPlanner, proof: Separated, numbers: range | list[int]) -> set[int]:
    """Return the obstacles without which the proof may fail, by their numbers in the whole scene."""
    if proof.of != "closed":
        return set(numbers)
    own: Iterable[int] = proof.obstacles
    if isinstance(planner, CurvedPlanner) and proof.rounded is None:  # polygons in place of obstacles
        own = map(planner.obstacle_of, own)
    return {numbers[i] for i in own if i >= 0}


def _without(scene: Scene, k: int) -> Scene:
    obstacles, names = list(scene.obstacles), list(scene.obstacle_names)
    del obstacles[k], names[k]
    return with_obstacles(scene, obstacles, names)
