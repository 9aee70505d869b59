"""Distances of the placed robot from obstacles and workspace, and the closest edges, in double precision."""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any

import cfree._core as _core
from cfree.exact.pose import Poses
from cfree.libraries import Floats, Ints, np
from cfree.scene.features import WORKSPACE
from cfree.scene.scene import robot_radius

if TYPE_CHECKING:
    from collections.abc import Sequence

    from cfree.collision.motion import Motion
    from cfree.exact.pose import Pose
    from cfree.polygons.polygon import Polygon
    from cfree.scene.scene import Scene

Name = tuple[int, int]  # polygon and edge
Least = tuple[float, float, int, float, int, int]
"""A certified lower bound of a distance, the least one found, its motion, its share of it, and the two edges."""


class EdgeDistances:
    """The edges of obstacles, workspace and robot, prepared once.

    Attributes
    ----------
    robot_names : list of (polygon, edge)
    radius : float
        Radius of the robot about its reference point.
    names : list of (obstacle, edge)
        -2 stands for the workspace.
    """

    def __init__(self, scene: Scene) -> None:
        self._robot = [*enumerate(scene.robot)]
        self._others = [*enumerate(scene.obstacles), *([(WORKSPACE, scene.workspace)] if scene.workspace else [])]
        self.radius = robot_radius(scene)
        self.robot_names, self.names = _names(self._robot), _names(self._others)

    @cached_property
    def robot(self) -> Floats:
        """Ends (e, 2, 2) of the robot's edges at rest."""
        return _ends(self._robot)

    @cached_property
    def segments(self) -> Floats:
        """Ends (w, 2, 2) of the edges of obstacles and workspace."""
        return _ends(self._others)

    @cached_property
    def _unit(self) -> float:
        """A power of two near their size, so that squares of tiny and huge numbers stay in range."""
        return 2.0 ** (math.frexp(np.abs(self.segments).max(initial=0) or 1.0)[1])

    def least(self, poses: Sequence[Pose], motions: Sequence[Motion], tolerance: float) -> Least:
        """Return the least distance along free motions from pose to pose; see `Least`."""
        robot = self.robot if any(motion.kind == "slide" for motion in motions) else None
        return self._handle.least(poses, motions, robot, tolerance)

    @cached_property
    def _handle(self) -> _core.EdgeDistances:
        """The same edges, for distances along motions."""
        robot, others = ([shape._handle for _, shape in shapes] for shapes in (self._robot, self._others))
        return _core.EdgeDistances(robot, others)

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


def _ends(shapes: list[tuple[int, Polygon]]) -> Floats:
    """Return the ends of all edges, (n, 2, 2)."""
    ends = [np.stack((shape.vertices, shape.vertices[shape.next]), axis=1) for _, shape in shapes]
    return np.concatenate([np.empty((0, 2, 2)), *ends])


def _names(shapes: list[tuple[int, Polygon]]) -> list[Name]:
    """Return the names of all edges."""
    return [(k, i) for k, shape in shapes for i in range(len(shape))]
