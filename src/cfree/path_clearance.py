"""Least distances along a path, by halving its motions."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from cfree.mesh import robot_radius
from cfree.motion import Translation
from cfree.nearest import Walls
from cfree.pace import reach
from cfree.path import Clearance, Path

if TYPE_CHECKING:
    from cfree.scene import Scene

MOST = 1 << 16  # parts of motions looked at together: where more would be needed, what is known is the bound
ROUNDING = 2.0**-40  # relative to the coordinates: a thousand times what placing and measuring round away


def least_clearance(path: Path, scene: Scene, tolerance: float | None) -> Clearance | None:
    """See `Path.clearance`."""
    if tolerance is None:
        found = least_clearance(path, scene, 1e-3 * robot_radius(scene))
        if found is None or found.least > 0 or found.found == 0:
            return found
        return least_clearance(path, scene, found.found / 4)
    walls = Walls(scene)
    if not len(walls.segments):
        return None
    segments, robot = walls.segments, walls.robot
    radius = float(np.hypot(robot[..., 0], robot[..., 1]).max())
    if not tolerance > 0:
        raise ValueError(f"tolerance {tolerance}: give a positive one")
    motions = path.motions or (Translation((0, 0)),)
    travel = np.array([reach(q, m, robot) for q, m in zip(path.poses, motions, strict=False)])
    places = max(abs(float(c)) for q in path.poses for c in (q.x, q.y))
    size = max(float(np.abs(segments).max()), places + radius + float(travel.max()))
    motion, low, high = np.arange(len(motions)), np.zeros(len(motions)), np.ones(len(motions))
    least, best = math.inf, (math.inf, 0, 0.0, 0, 0)
    while len(motion):
        middle = (low + high) / 2
        placed = np.empty((len(motion), *robot.shape))
        for k in np.unique(motion):
            placed[motion == k] = (
                motions[k]
                .sample(path.poses[k], middle[motion == k])
                .apply(robot.reshape(-1, 2))
                .reshape(-1, *robot.shape)
            )
        nearest, edge, wall = walls.nearest(placed)
        k = int(nearest.argmin())
        if nearest[k] < best[0]:
            best = float(nearest[k]), int(motion[k]), float(middle[k]), int(edge[k]), int(wall[k])
        bound = nearest - travel[motion] * (high - low) / 2
        open_ = bound < best[0] - tolerance
        if open_.sum() > MOST:
            open_[:] = False
        least = min(least, float(bound[~open_].min(initial=math.inf)))
        motion, low, middle, high = motion[open_], low[open_], middle[open_], high[open_]
        motion, low, high = np.tile(motion, 2), np.concatenate((low, middle)), np.concatenate((middle, high))
    value, at, share, i, j = best
    return Clearance(max(0.0, least - ROUNDING * size), value, at, share, walls.robot_names[i], walls.names[j])
