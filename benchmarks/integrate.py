"""Paths of vehicles driven by their controls alone, and looked at by shapely: a check without cfree's own geometry.

Gear, radius and length of each part of a path give speed and rate of turn. Runge and Kutta's method integrates these
from the start, in doubles; shapely then places the robot at many poses.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

import cfree
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import robot_radius

STEPS = 100  # looks a robot's radius of travel, or of turning
SHRUNK = 1e-6  # robot's radii by which it is smaller for shapely, as a path may touch
MOST = 6_000  # looks at a path

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Driving:
    """Outcome of a path driven by its controls.

    Parameters
    ----------
    miss : float
        Greatest distance from the exact poses between its parts, in robot's radii and radians.
    overlap : float
        Area of the robot in obstacles or outside, in squares of its radius.
    looks : int
    """

    miss: float
    overlap: float
    looks: int

    @property
    def is_right(self) -> bool:
        return self.miss < 1e-6 and self.overlap == 0


def driven(path: cfree.Path, scene: cfree.Scene) -> Driving:
    """Drive a path from its start, and look at the robot on the way."""
    assert path.vehicle is not None
    size, frame = robot_radius(scene), path.vehicle.frame
    travel = sum(part.length + size * abs(part.angle) for part in path.driving)
    step = max(size / STEPS, travel / MOST)
    start = path.start @ frame
    state = np.array([float(start.x), float(start.y), start.theta])
    miss, rows = 0.0, [state]
    for part in path.driving:
        speed = {"forward": 1.0, "backward": -1.0, "turning": 0.0}[part.gear]
        duration = part.length if speed else abs(part.angle)
        rate = math.copysign(1.0, part.angle) if not speed else speed / float(part.radius) if part.radius else 0.0
        count = max(2, math.ceil((part.length + size * abs(part.angle)) / step))
        rows += _integrated(state, speed, rate, duration / count, count)
        state = rows[-1]
        end = path.poses[part.last + 1] @ frame
        apart = math.hypot(state[0] - float(end.x), state[1] - float(end.y)) / size
        miss = max(miss, apart, abs(math.remainder(state[2] - end.theta, math.tau)))
    robots = _robots(np.array(rows), scene, frame)
    return Driving(miss, _overlap(robots, scene) / size**2, len(rows))


def _integrated(state: Floats, speed: float, rate: float, dt: float, count: int) -> Iterator[Floats]:
    """Yield states of x' = v cos h, y' = v sin h, h' = w by the classical method of Runge and Kutta."""

    def slope(at: Floats) -> Floats:
        return np.array([speed * math.cos(at[2]), speed * math.sin(at[2]), rate])

    for _ in range(count):
        a = slope(state)
        b = slope(state + dt / 2 * a)
        c = slope(state + dt / 2 * b)
        d = slope(state + dt * c)
        state = state + dt / 6 * (a + 2 * b + 2 * c + d)
        yield state


def _shape(polygon: Polygon) -> shapely.Polygon:
    outer, *holes = polygon.rings
    return shapely.Polygon(outer, holes)


def _robots(axles: Floats, scene: cfree.Scene, frame: cfree.Pose) -> NDArray[np.object_]:
    """Place the robot, a little smaller, at poses of its axle."""
    shape = shapely.union_all([_shape(part) for part in scene.robot]).buffer(-SHRUNK * robot_radius(scene))
    theta = axles[:, 2] - frame.theta
    c, s, ax, ay = np.cos(theta), np.sin(theta), float(frame.x), float(frame.y)
    x, y = axles[:, 0] - c * ax + s * ay, axles[:, 1] - s * ax - c * ay
    if scene.bounds is not None:
        x0, y0, x1, y1 = (float(bound) for bound in scene.bounds)
        slack = SHRUNK * robot_radius(scene)
        inside = (x >= x0 - slack) & (x <= x1 + slack) & (y >= y0 - slack) & (y <= y1 + slack)
        assert inside.all(), "the reference point leaves the bounds"
    placed = []
    for k in range(len(axles)):
        turn, shift = np.array([(c[k], s[k]), (-s[k], c[k])]), np.array([x[k], y[k]])
        placed.append(shapely.transform(shape, lambda points, turn=turn, shift=shift: points @ turn + shift))
    return np.array(placed, dtype=object)


def _overlap(robots: NDArray[np.object_], scene: cfree.Scene) -> float:
    """Return the greatest area that is not free."""
    most = 0.0
    if scene.obstacles:
        shapes = np.array([_shape(obstacle) for obstacle in scene.obstacles], dtype=object)
        first, second = shapely.STRtree(shapes).query(robots, predicate="intersects")
        if len(first):
            most = float(shapely.area(shapely.intersection(robots[first], shapes[second])).max())
    if scene.workspace is not None:
        outside = shapely.difference(robots, _shape(scene.workspace))
        most = max(most, float(shapely.area(outside).max()))
    return most
