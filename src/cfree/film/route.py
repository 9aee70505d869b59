"""Free motions for the eye: found on a grid, smoothed, and proved free by clearance.

The clearance of a position at one orientation is its distance from the forbidden region there. A move by d changes it
by at most d, a turn by alpha by at most 2 R sin(alpha / 2), R the robot's radius: so a known clearance makes
everything near it free. This is no planner: it prefers wide passages, knows none narrower than its grid, and never
turns through theta = 0, so that a film can show the motion in one piece.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cfree.scene.scene import robot_radius

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Cell = tuple[int, int, int]

TURNS = 96  # orientations of the grid
LENGTH = 72  # cells along the longer side of the window
MARGINS = 8, 4, 2, 1


class Clearance:
    """Clearances on a grid of poses, theta from 0 to 2 pi.

    Parameters
    ----------
    boundary : Boundary
    window : four floats
        x0, y0, x1, y1.
    fineness : int
        How much finer than usual the grid is.

    Notes
    -----
    Time: as many distances as the grid has points, about half a million, times the cube of `fineness`.
    """

    def __init__(self, boundary: Boundary, window: tuple[float, float, float, float], fineness: int = 1) -> None:
        import shapely

        x0, y0, x1, y1 = window
        self._boundary = boundary
        self.cell = max(x1 - x0, y1 - y0) / (LENGTH * fineness)
        self.radius = robot_radius(boundary.scene)
        self.origin = np.array([x0, y0, 0.0])
        turns = TURNS * fineness
        self.step = np.array([self.cell, self.cell, math.tau / turns])
        x = x0 + self.cell * np.arange(math.floor((x1 - x0) / self.cell + 1e-9) + 1)
        y = y0 + self.cell * np.arange(math.floor((y1 - y0) / self.cell + 1e-9) + 1)
        points = shapely.points(*np.meshgrid(x, y, indexing="ij"))
        self.grid = np.empty((*points.shape, turns + 1))
        for k in range(turns):
            region = boundary.slice(k * math.tau / turns).forbidden
            shapely.prepare(region)
            self.grid[..., k] = shapely.distance(points, region)
        self.grid[..., turns] = self.grid[..., 0]
        self.margin = max(self.cell, self.radius * math.tau / turns) / 2
        """More clearance than this in two neighbouring cells, and the way between them is free."""

    def poses(self, cells: Ints) -> Floats:
        """(n, 3) poses in the middle of cells."""
        return np.asarray(self.origin + cells * self.step)

    def at_least(self, poses: Floats) -> Floats:
        """Lower bound from the grid on the clearance at (n, 3) poses, theta in [0, 2 pi]; 0 outside the grid."""
        near = np.rint((poses - self.origin) / self.step).astype(np.int64)
        inside = ((near >= 0) & (near < self.grid.shape)).all(axis=1)
        near = np.clip(near, 0, np.array(self.grid.shape) - 1)
        dx, dy, turn = (poses - self.poses(near)).T
        bound = self.grid[tuple(near.T)] - np.hypot(dx, dy) - 2 * self.radius * np.abs(np.sin(turn / 2))
        return np.where(inside, bound, 0.0)

    def measured(self, poses: Floats) -> Floats:
        """Clearances at (n, 3) poses, each from its own slice."""
        import shapely

        regions = [self._boundary.slice(float(theta)).forbidden for theta in poses[:, 2]]
        return np.asarray(shapely.distance(shapely.points(poses[:, :2]), regions))

    def are_free(self, poses: Floats, clearance: Floats) -> bool:
        """Is all of a polyline free, because the clearance of its vertices says so? False: not proved."""
        dx, dy, turn = np.diff(poses, axis=0).T
        length = np.hypot(dx, dy) + self.radius * np.abs(turn)  # no point of the robot moves farther
        return bool((clearance > 0).all() and (length < clearance[:-1] + clearance[1:]).all())


def route(space: Clearance, start: Floats, goal: Floats | None) -> Floats | None:
    """A smooth free way from one pose (x, y, theta) to another, (n, 3); None if none was found.

    Parameters
    ----------
    space : Clearance
    start : (3,) float
    goal : (3,) float, optional
        If not given, the pose that is farthest on the grid.
    """
    first, last = _entrance(space, start), None if goal is None else _entrance(space, goal)
    if first is None or (goal is not None and last is None):
        return None
    for factor in MARGINS:
        cells = _search(space.grid > factor * space.margin, first, last)
        if cells is not None:
            ends = [] if goal is None else [goal[None]]
            pulled = _pulled(space, space.poses(cells), 0.6 * factor * space.margin)
            return _smoothed(space, np.concatenate([start[None], pulled, *ends]))
    return None


def _entrance(space: Clearance, pose: Floats) -> Cell | None:
    """The nearest cell with the margin that a straight free way leads to."""
    offsets = np.stack(np.meshgrid(*3 * [np.arange(-3, 4)], indexing="ij"), axis=-1).reshape(-1, 3)
    cells = np.rint((pose - space.origin) / space.step).astype(np.int64) + offsets
    cells = cells[((cells >= 0) & (cells < space.grid.shape)).all(axis=1)]
    cells = cells[space.grid[tuple(cells.T)] > space.margin]
    for cell in cells[np.argsort(np.linalg.norm((space.poses(cells) - pose) / space.step, axis=1))][:20]:
        way = np.linspace(pose, space.poses(cell), 40)
        if space.are_free(way, space.measured(way)):
            i, j, k = cell.tolist()
            return i, j, k
    return None


def _search(free: NDArray[np.bool_], first: Cell, last: Cell | None) -> Ints | None:
    """Shortest way over neighbouring free cells, breadth first; to the last one reached if no last one is given."""
    free = free.copy()
    free[first] = True
    if last is not None:
        free[last] = True
    distance = np.full(free.shape, -1)
    front = np.array([first])
    distance[first] = 0
    steps = np.concatenate((np.eye(3, dtype=np.int64), -np.eye(3, dtype=np.int64)))
    while len(front) and (last is None or distance[last] < 0):
        end = front[0]
        near = (front[:, None] + steps).reshape(-1, 3)
        near = near[((near >= 0) & (near < free.shape)).all(axis=1)]
        near = np.unique(near[free[tuple(near.T)] & (distance[tuple(near.T)] < 0)], axis=0)
        distance[tuple(near.T)] = distance[tuple(front[0])] + 1
        front = near
    end = end if last is None else np.array(last)
    if distance[tuple(end)] < 1:
        return None
    way = [end]
    while distance[tuple(way[-1])] > 0:
        near = way[-1] + steps
        near = near[((near >= 0) & (near < free.shape)).all(axis=1)]
        way.append(near[distance[tuple(near.T)] == distance[tuple(way[-1])] - 1][0])
    return np.array(way[::-1])


def _pulled(space: Clearance, poses: Floats, floor: float) -> Floats:
    """The same way with straight pieces in place of stairs, each proved free and to keep this clearance."""
    kept, k = [0], 0
    while k < len(poses) - 1:
        step = 1
        while k + 2 * step < len(poses) and _sees(space, poses[k], poses[k + 2 * step], floor):
            step *= 2
        k += step
        kept.append(k)
    return poses[kept]


def _sees(space: Clearance, pose: Floats, other: Floats, floor: float) -> bool:
    way = np.linspace(pose, other, 2 + int(np.abs((other - pose) / space.step).sum() * 2))
    return space.are_free(way, space.at_least(way) - floor)


def _smoothed(space: Clearance, corners: Floats) -> Floats:
    """Evenly spaced poses, averaged with their neighbours as far as most of their clearance stays."""
    scale = np.array([1.0, 1.0, space.radius])
    length = np.append(0, np.cumsum(np.linalg.norm(np.diff(corners * scale, axis=0), axis=1)))
    spacing = space.margin / 4
    count = max(9, math.ceil(length[-1] / spacing))
    even = np.linspace(0, length[-1], count)
    poses = np.stack([np.interp(even, length, column) for column in corners.T], axis=1)
    enough = 0.5 * np.minimum(space.measured(poses), 8 * space.margin)
    for width in (count // 4, count // 8, count // 16, count // 32, count // 64):
        smooth = _averaged(poses, width)
        clearance = space.measured(smooth)
        if width > 1 and space.are_free(smooth, clearance) and (clearance >= enough).all():
            return smooth
    return poses


def _averaged(poses: Floats, width: int) -> Floats:
    """A moving average with a hat of this half width, narrower towards both ends, which stay."""
    sums = np.concatenate((np.zeros((1, 3)), np.cumsum(poses, axis=0)))
    k = np.arange(len(poses))
    for _ in range(2):
        reach = np.minimum(np.minimum(k, k[::-1]), width // 2)
        poses = (sums[k + reach + 1] - sums[k - reach]) / (2 * reach + 1)[:, None]
        sums = np.concatenate((np.zeros((1, 3)), np.cumsum(poses, axis=0)))
    return poses
