"""Distances of the placed robot from obstacles and workspace, and the closest edges, in double precision."""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.exact.pose import Poses
from cfree.scene.features import WORKSPACE
from cfree.scene.scene import robot_radius

if TYPE_CHECKING:
    from cfree.polygons.polygon import Polygon
    from cfree.scene.scene import Scene

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Name = tuple[int, int]  # polygon and edge


class EdgeDistances:
    """The edges of obstacles, workspace and robot, prepared once.

    Attributes
    ----------
    robot : (e, 2, 2) float64
        Ends of the robot's edges at rest.
    robot_names : list of (polygon, edge)
    radius : float
        Radius of the robot about its reference point.
    segments : (w, 2, 2) float64
        Ends of the edges of obstacles and workspace.
    names : list of (obstacle, edge)
        -2 stands for the workspace.
    """

    def __init__(self, scene: Scene) -> None:
        shapes = [*enumerate(scene.obstacles), *([(WORKSPACE, scene.workspace)] if scene.workspace else [])]
        self.robot, self.robot_names = _edges(list(enumerate(scene.robot)))
        self.radius = robot_radius(scene)
        self.segments, self.names = _edges(shapes)
        # a power of two near their size, so that squares of tiny and huge numbers stay in range
        self._unit = 2.0 ** (math.frexp(np.abs(self.segments).max(initial=0) or 1.0)[1])

    @cached_property
    def _handle(self) -> _core.EdgeDistances:
        """The same edges, for distances along motions."""
        return _core.EdgeDistances(self.robot.reshape(-1, 4), self.segments.reshape(-1, 4))

    @cached_property
    def _tree(self) -> Any:
        import shapely

        return shapely.STRtree(shapely.linestrings(self.segments / self._unit))

    def placed(self, rows: Floats) -> Floats:
        """Return the robot's edges, (n, e, 2, 2), at rows x, y, theta."""
        return self.at(Poses(rows[:, :2], rows[:, 2]))

    def at(self, poses: Poses) -> Floats:
        """Return the robot's edges, (n, e, 2, 2), at some poses."""
        return poses.apply(self.robot.reshape(-1, 2)).reshape(len(poses), *self.robot.shape)

    def nearest(self, placed: Floats, within: float = math.inf) -> tuple[Floats, Ints, Ints]:
        """Return the least distances (n,) of the robot's edges, placed (n, e, 2, 2), and the two closest edges.

        No edge of an obstacle may be inside the robot, and there must be at least one. Distances of more than `within`
        are infinite.
        """
        import shapely

        lines = shapely.linestrings(placed.reshape(-1, 2, 2) / self._unit)
        most = within / self._unit if within < math.inf else None
        (line, near), distance = self._tree.query_nearest(
            lines, max_distance=most, return_distance=True, all_matches=False
        )
        table, other = np.full(placed.shape[:2], math.inf), np.zeros(placed.shape[:2], np.int64)
        table.flat[line], other.flat[line] = self._unit * distance, near
        edge = table.argmin(axis=1)
        rows = np.arange(len(placed))
        return table[rows, edge], edge, other[rows, edge]

    def between(self, edge: Floats, other: int) -> Floats:
        """Return the closest points, (2, 2), of an edge (2, 2) of the placed robot and of an edge of `segments`."""
        import shapely

        pair = (shapely.linestrings(ends / self._unit) for ends in (edge, self.segments[other]))
        return self._unit * np.asarray(shapely.get_coordinates(shapely.shortest_line(*pair)))


def _edges(shapes: list[tuple[int, Polygon]]) -> tuple[Floats, list[Name]]:
    """Return the ends of all edges, (n, 2, 2), and their names."""
    ends = [np.stack((shape.vertices, shape.vertices[shape.next]), axis=1) for _, shape in shapes]
    return np.concatenate([np.empty((0, 2, 2)), *ends]), [(k, i) for k, shape in shapes for i in range(len(shape))]
