"""Cells by brute force: slices at many orientations, joined where that is certain, and where it is possible at all.

Between two slices a point of the robot moves by at most radius times step. A position with more room than that in one
slice is free up to the next: the parts it is in there are certainly one. If the robot is free in between, the same
robot without a rim so wide is free in the slice. Parts of that which do not meet are certainly not joined.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

import oracles
from shapes import PlainScene, Shape


class Flood(NamedTuple):
    """Poses with room around them. Those of equal `certain` are in one cell, of different `possible` in different."""

    xy: NDArray[np.float64]
    theta: NDArray[np.float64]
    certain: NDArray[np.int64]
    possible: NDArray[np.int64]


class _Sets:
    def __init__(self) -> None:
        self.above: dict[Hashable, Hashable] = {}

    def of(self, x: Hashable) -> Hashable:
        while self.above.setdefault(x, x) != x:
            x = self.above[x]
        return x

    def join(self, x: Hashable, y: Hashable) -> None:
        self.above[self.of(x)] = self.of(y)


def flood(plain: PlainScene, steps: int) -> Flood:
    thetas = [2 * math.pi * (k + 0.5) / steps for k in range(steps)]
    reach = 1.01 * oracles.robot_radius(plain.robot) * 2 * math.pi / steps
    certain, possible = _Sets(), _Sets()
    free = [_parts(_slice_of(plain, plain.robot, t)) for t in thetas]
    wide = [
        _parts(shapely.union_all([*parts, _slice_of(plain, thinner(plain.robot, reach), t)]))
        for parts, t in zip(free, thetas, strict=True)
    ]
    poses = []
    for k, theta in enumerate(thetas):
        after = (k + 1) % steps
        for core in _parts(shapely.union_all(shapely.buffer(free[k], -reach))):
            p = core.representative_point()
            here, there, around = (_at(parts, p) for parts in (free[k], free[after], wide[k]))
            certain.join((k, here), (after, there))
            poses.append((p.x, p.y, theta, (k, here), (k, around)))
        for i, part in enumerate(wide[k]):
            for j in np.flatnonzero(shapely.intersects(wide[after], part)).tolist():
                possible.join((k, i), (after, j))
    numbers: dict[Hashable, int] = {}
    columns = [
        [numbers.setdefault((name, sets.of(pose[c])), len(numbers)) for pose in poses]
        for name, sets, c in (("certain", certain, 3), ("possible", possible, 4))
    ]
    table = np.array([pose[:3] for pose in poses]).reshape(-1, 3)
    return Flood(table[:, :2], table[:, 2], np.array(columns[0], int), np.array(columns[1], int))


def thinner(robot: Sequence[Shape], by: float) -> list[Shape]:
    """Polygons whose points are at least so far from the robot's rim."""
    rings = [[np.array(ring, float) for ring in (outer, *holes)] for outer, holes in robot]
    solids = [shapely.Polygon(outer, holes) for outer, *holes in rings]
    cores = shapely.get_parts(shapely.buffer(solids, -by)).tolist()
    return [(list(x.exterior.coords)[:-1], [list(h.coords)[:-1] for h in x.interiors]) for x in cores if x.area > 0]


def _slice_of(plain: PlainScene, robot: Sequence[Shape], theta: float) -> shapely.Geometry:
    if not robot:
        return oracles.window(plain.robot, plain.obstacles, plain.bounds, plain.workspace)
    return oracles.free_slice(robot, plain.obstacles, theta, plain.bounds, plain.workspace)


def _parts(region: shapely.Geometry) -> list[shapely.Polygon]:
    return [part for part in shapely.get_parts(region).tolist() if part.area > 0]


def _at(parts: list[shapely.Polygon], p: shapely.Point) -> int:
    """The part that holds a point; rounding decides nothing, as there is room around it."""
    return int(np.flatnonzero(shapely.intersects(parts, p))[0])
