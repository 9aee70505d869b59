"""Plan among some obstacles of a scene that has many: those near the paths found so far.

A surface among some obstacles that separates two poses separates them among all. A path among some is one among all if
all obstacles near it are included. So obstacles are added along the paths found, until one of the two is certain.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Protocol

from cfree.errors import UndecidedError
from cfree.exact.pose import Pose
from cfree.paths.path import Path
from cfree.planning.options import Options
from cfree.planning.pose_planner import PosePlanner
from cfree.planning.proof import Proof
from cfree.planning.separation import Separated
from cfree.planning.steps import step_planner
from cfree.scene.scene import Scene

MOST_STEPS = 10_000_000  # along a path, each as long as the robot's reach
MARGIN, WIDER = 2.0, 4.0
"""Distance around a path within which obstacles are added, in reaches of the robot; the factor if some were missing."""


class Known(Protocol):
    """Obstacles of a scene that have been needed so far."""

    @property
    def scene(self) -> Scene:
        """Scene with these."""

    @property
    def radius(self) -> float:
        """Radius of the robot."""

    def add_around(self, path: Path, margin: float = 0.0) -> bool:
        """Add obstacles that the robot may touch on a path, or within a margin of it; False if all were known."""


def check_length(path: Path, radius: float) -> None:
    """Check that a path is short enough to look at all places along it.

    Raises
    ------
    UndecidedError
        If it is too long.
    """
    if path.length > MOST_STEPS * radius:
        raise UndecidedError(
            f"a path was found that is {path.length:.3g} long, too long to look for all obstacles along it; "
            "give the scene bounds, or the vehicle a smaller turning radius"
        )


def add_ends(known: Known, start: Pose, goal: Pose) -> None:
    """Add obstacles around both ends of a query."""
    for end in (start, goal):
        known.add_around(Path(end, []), MARGIN * known.radius)


def proof_at_ends(known: Known, start: Pose, goal: Pose) -> Separated | None:
    """Proof by a few surfaces around the ends, which is fast where obstacles close one in; None without one."""
    add_ends(known, start, goal)
    return step_planner(known.scene).proof(start, goal)


def plan_around(
    known: Known, start: Pose, goal: Pose, options: Options, way: Sequence[Pose] | None = None
) -> Path | Proof:
    """Path or proof among the obstacles near the paths found; others are added until one of the two is certain.

    Parameters
    ----------
    known : Known
        Has what was needed in the end.
    start, goal : Pose
    options : Options
    way : sequence of Pose, optional
        Poses of a path that is free among all obstacles, and needs no search.
    """
    margin = MARGIN * known.radius

    def leads_farther(path: Path) -> bool:
        nonlocal margin
        if not known.add_around(path, margin):
            return False
        margin *= WIDER
        return True

    add_ends(known, start, goal)
    while True:
        planner = PosePlanner(known.scene)
        if way is None:
            found = planner.way(start, goal, options)
            if isinstance(found, Separated):  # further obstacles do not change that
                return found
            assert found is not None, "the search was complete"
            if leads_farther(planner.path(found)):
                continue
            way = found
        answer = _answered(planner, way, options, leads_farther)
        if answer is not None:
            return answer
        way = None if planner.has_slides else way


def _answered(
    planner: PosePlanner, way: Sequence[Pose], options: Options, leads_farther: Callable[[Path], bool]
) -> Path | Proof | None:
    """Answer by a way among the known obstacles; None if it leads farther, while proofs hold among more obstacles.

    A vehicle's first path comes before a better one.
    """
    is_twice = options.vehicle is not None and options.improve != 0
    answer: Path | Proof | None = None
    for own in (replace(options, improve=0.0), options) if is_twice else (options,):
        try:
            answer = planner.answered(way, own)
        except UndecidedError as error:  # a vehicle needs too many manoeuvres on a path, if that is free among all
            if not isinstance(error.path, Path) or not leads_farther(error.path):
                raise
            return None
        if not isinstance(answer, Path):
            return answer
        if leads_farther(answer):
            return None
    return answer
