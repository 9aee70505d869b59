"""Least distances along a path, by halving its motions."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cfree.features import WORKSPACE
from cfree.motion import Motion, Rotation, Translation
from cfree.path import Clearance, Path
from cfree.pose import Pose

if TYPE_CHECKING:
    from cfree.polygon import Polygon
    from cfree.scene import Scene

Floats = NDArray[np.float64]
ROUNDING = 2.0**-40  # relative to the coordinates: a thousand times what placing and measuring round away


def least_clearance(path: Path, scene: Scene, tolerance: float | None) -> Clearance | None:
    """See `Path.clearance`."""
    import shapely

    walls = [*enumerate(scene.obstacles), *([(WORKSPACE, scene.workspace)] if scene.workspace else [])]
    if not walls:
        return None
    segments, wall_edges = _edges(walls)
    tree = shapely.STRtree(shapely.linestrings(segments))
    robot, robot_edges = _edges(list(enumerate(scene.robot)))
    radius = float(np.hypot(robot[..., 0], robot[..., 1]).max())
    if tolerance is None:
        tolerance = 1e-3 * radius
    if not tolerance > 0:
        raise ValueError(f"tolerance {tolerance}: give a positive one")
    poles = [c for m in path.motions if isinstance(m, Rotation) for c in m.pole]
    places = [c for q in path.poses for c in (q.x, q.y)]
    size = float(max(np.abs(segments).max(), max(abs(float(c)) for c in places + poles) + radius))
    motions = path.motions or (Translation((0, 0)),)
    reach = np.array([_reach(q, m, robot) for q, m in zip(path.poses, motions, strict=False)])
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
        lines = shapely.linestrings(placed.reshape(-1, 2, 2))
        (_, wall), distance = tree.query_nearest(lines, return_distance=True, all_matches=False)
        distance = distance.reshape(len(motion), -1)
        nearest, edge = distance.min(axis=1), distance.argmin(axis=1)
        k = int(nearest.argmin())
        if nearest[k] < best[0]:
            found = int(edge[k])
            best = float(nearest[k]), int(motion[k]), float(middle[k]), found, int(wall[k * len(robot) + found])
        bound = nearest - reach[motion] * (high - low) / 2
        open_ = bound < best[0] - tolerance
        least = min(least, float(bound[~open_].min(initial=math.inf)))
        motion, low, middle, high = motion[open_], low[open_], middle[open_], high[open_]
        motion, low, high = np.tile(motion, 2), np.concatenate((low, middle)), np.concatenate((middle, high))
    value, at, share, i, j = best
    return Clearance(max(0.0, least - ROUNDING * size), value, at, share, robot_edges[i], wall_edges[j])


def _edges(shapes: list[tuple[int, Polygon]]) -> tuple[Floats, list[tuple[int, int]]]:
    """Ends of all edges, (n, 2, 2), and their names."""
    ends = [np.stack((shape.vertices, shape.vertices[shape.next]), axis=1) for _, shape in shapes]
    return np.concatenate(ends), [(k, i) for k, shape in shapes for i in range(len(shape))]


def _reach(pose: Pose, motion: Motion, robot: Floats) -> float:
    """How far any point of the robot travels at most, in the whole motion."""
    if isinstance(motion, Translation):
        return motion.length
    corners = pose.apply(robot) - [float(c) for c in motion.pole]
    return float(np.hypot(corners[..., 0], corners[..., 1]).max()) * abs(motion.turn)
