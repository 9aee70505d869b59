"""Free motions of a film: paths of the planner, and destinations."""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cfree.collision.motion import rotations
from cfree.collision.motion_checker import MotionChecker
from cfree.errors import IncompleteError, UndecidedError
from cfree.exact.pose import Pose, Poses
from cfree.free.largest_disc import largest_disc
from cfree.free.space import FreeSpace, free_space
from cfree.paths.path import Path
from cfree.paths.travel import Travel
from cfree.planning.curved import CurvedPlanner
from cfree.planning.planner import Planner
from cfree.scene.scene import robot_radius
from cfree.scene.smooth import smooth

if TYPE_CHECKING:
    from collections.abc import Sequence

    from cfree.forbidden.boundary import Boundary
    from cfree.plot.workspace import Window
    from cfree.scene.scene import Scene
    from cfree.vehicles.vehicle import Vehicle

Floats = NDArray[np.float64]

SLICES = 72  # slices searched for a place for a full turn
GRID = 16  # candidate poses along each axis


class FreeMotions:
    """Motions of the robot that touch nothing.

    Parameters
    ----------
    boundary : Boundary
    window : four floats
        x0, y0, x1, y1 around the destinations.
    """

    def __init__(self, boundary: Boundary, window: Window) -> None:
        self._boundary, self._window, self._scene = boundary, window, boundary.scene

    @cached_property
    def _space(self) -> FreeSpace:
        return free_space(self._boundary)

    @cached_property
    def _planner(self) -> Planner | CurvedPlanner:
        return self._planner_for(None)

    def _planner_for(self, vehicle: Vehicle | None) -> Planner | CurvedPlanner:
        planner = Planner(self._scene, self._space, vehicle=vehicle)
        return CurvedPlanner(planner) if self._scene.curved else planner

    @cached_property
    def _shown(self) -> Scene:
        """The scene with polygons that look round."""
        return smooth(self._scene)

    def path(self, start: Pose, goal: Pose) -> Path | None:
        """Return a path, or None if start and goal are in no common cell, as when all paths touch something."""
        if self._space.common_cell(start, goal) is None:
            return None
        try:
            answer = self._planner.plan(start, goal)
        except UndecidedError:  # among round shapes
            return None
        return answer if isinstance(answer, Path) else None

    def driven(self, start: Pose, goal: Pose) -> Path | None:
        """Return a path of the scene's vehicle, or None if it has none, or none is found."""
        if self._scene.vehicle is None:
            return None
        try:
            answer = self._planner_for(self._scene.vehicle).plan(start, goal)
        except IncompleteError:
            return None
        return answer if isinstance(answer, Path) else None

    def full_turn(self) -> Path | None:
        """Return a full turn in place from theta = 0, at the roomiest place; None if it is not free."""
        import shapely

        angles = np.linspace(0, math.tau, SLICES, endpoint=False).tolist()
        forbidden = shapely.union_all([self._boundary.slice(angle).forbidden for angle in angles])
        free = shapely.box(*self._window).difference(forbidden)
        if free.is_empty:
            return None
        x, y = shapely.maximum_inscribed_circle(free).coords[0]
        path = Path(Pose(x, y, 0), rotations((x, y), "360deg"))
        return path if path.is_free(MotionChecker(self._scene)) else None

    def resting_pose(self) -> Pose | None:
        """Return a pose with much room in the largest cell; None if there is none."""
        if not len(self._boundary.trapezoids) or not len(self._space):
            return None
        disc = largest_disc(self._space.cells[int(np.argmax(self._space.volumes))])
        return None if disc is None else disc[0]

    def farthest(self, pose: Pose) -> Pose | None:
        """Return the farthest reachable pose of a grid; None if no pose of it is reachable."""
        reached = self._reached(pose)
        return _pose(reached[self._distances(reached, pose).argmax()]) if len(reached) else None

    def tried(self, start: Pose, goal: Pose) -> list[Pose]:
        """Return three reachable poses of a grid: the nearest to a goal, the farthest from that, and one more."""
        reached = self._reached(start)
        if not len(reached):
            return []
        apart = self._distances(reached, goal)
        rows = [reached[apart.argmin()]]
        for _ in range(2):  # each as far from all others as possible
            apart = np.min([self._distances(reached, _pose(row)) for row in rows], axis=0)
            rows.append(reached[apart.argmax()])
        return [_pose(row) for row in rows]

    def _reached(self, pose: Pose) -> Floats:
        """Return the poses x, y, theta of a grid that are in the cell of a pose."""
        x0, y0, x1, y1 = self._window
        axes = np.linspace(x0, x1, GRID), np.linspace(y0, y1, GRID), np.linspace(0, math.tau, GRID, endpoint=False)
        rows = np.stack([axis.ravel() for axis in np.meshgrid(*axes, indexing="ij")], axis=1)
        cells = self._space.locate(Poses(rows[:, :2], rows[:, 2]))
        reached: Floats = rows[cells == self._space.locate(pose)]
        return reached

    def _distances(self, rows: Floats, pose: Pose) -> Floats:
        x, y, theta = rows.T
        turn = np.abs(np.mod(theta - pose.theta + math.pi, math.tau) - math.pi)
        distances: Floats = np.hypot(x - float(pose.x), y - float(pose.y)) + robot_radius(self._scene) * turn
        return distances

    def travel(self, path: Path) -> float:
        """Return the robot's travel along a path."""
        return Travel(path, self._shown).total

    def poses(self, path: Path, shares: Sequence[float]) -> list[Pose]:
        """Return exact poses of a path at shares of the robot's travel."""
        if not path.motions:
            return [path.start] * len(shares)
        travel = Travel(path, self._shown)
        places = zip(*(column.tolist() for column in travel.places(travel.total * np.array(shares))), strict=True)
        return [path.motions[k].at(path.poses[k], path.motions[k].parameter(share)) for k, share in places]


def _pose(row: Floats) -> Pose:
    x, y, theta = row.tolist()
    return Pose(x, y, theta)
