"""A quick search for paths, and shorter ones: random poses, joined by motions that are proved free.

The core does both, in doubles where it guesses and exactly where it decides. A search that finds nothing shows nothing.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

import cfree._core as _core
from cfree.collision.motion_checker import MotionChecker
from cfree.exact.pose import Pose
from cfree.paths.preferences import NONE, Preferences
from cfree.scene.scene import robot_radius

if TYPE_CHECKING:
    from cfree.scene.scene import Scene

Places = tuple[float, float, float, float]
PLACE_BITS, ANGLE_BITS = 24, 20  # of random poses: few, for short integers
FINE_PLACE_BITS, FINE_ANGLE_BITS = 40, 36  # of poses on paths


def area(scene: Scene, poses: Sequence[Pose]) -> Places:
    """Of positions to try: bounds, else around the workspace, else with room around obstacles and poses."""
    if scene.bounds is not None:
        x0, y0, x1, y1 = map(float, scene.bounds)
        return x0, y0, x1, y1
    points = np.array([(float(q.x), float(q.y)) for q in poses]).reshape(-1, 2)
    around = [scene.workspace] if scene.workspace else scene.obstacles
    corners = np.concatenate([points, *(polygon.vertices for polygon in around)])
    margin = 0.0 if scene.workspace else 2 * robot_radius(scene)
    (x0, y0), (x1, y1) = (corners.min(axis=0) - margin).tolist(), (corners.max(axis=0) + margin).tolist()
    return x0, y0, x1, y1


def simple_ways(start: Pose, goal: Pose) -> list[list[Pose]]:
    """A turn and a straight way in either order, and one motion."""
    turned, moved = (Pose(p.x, p.y, {"tau": q.tau}) for p, q in ((start, goal), (goal, start)))
    return [list(dict.fromkeys(way)) for way in ([start, turned, goal], [start, moved, goal], [start, goal])]


class Searcher:
    """Searches in one scene."""

    def __init__(
        self, checker: MotionChecker, area: Places, angle_scale: float, preferences: Preferences = NONE
    ) -> None:
        self.checker = checker
        self._scale, self._shift = checker.units
        self._unit = float(Fraction(self._scale, 1 << self._shift))  # of lengths in the core's doubles
        self._area = [c * self._unit for c in area]
        x0, y0, x1, y1 = self._area
        self._extent = math.frexp(max(x1 - x0, y1 - y0) or 1.0)[1]
        self._weight = angle_scale * self._unit
        self._costs = [self._weight, *preferences.factors]

    def search(self, start: Pose, goal: Pose, seed: int = 0) -> Any:
        """To be run by ``run(checks)``, until it returns poses; see `poses`."""
        (p, at), (q, to) = map(self._configuration, (start, goal))
        grid = self._grid(PLACE_BITS, ANGLE_BITS)
        return _core.RrtConnect(self.checker.core, grid, self._area, self._weight, p, at, q, to, seed)

    def shortener(self, poses: Sequence[Pose], seed: int = 0) -> Any:
        """To be run by ``run(checks)``; ``path()`` is the best so far."""
        numbers, places = zip(*map(self._configuration, poses), strict=True)
        grid = self._grid(FINE_PLACE_BITS, FINE_ANGLE_BITS)
        return _core.Shortcut(self.checker.core, grid, self._costs, list(numbers), list(places), seed)

    def balanced(
        self, poses: Sequence[Pose], bounds: tuple[Fraction, Fraction, Fraction, Fraction] | None, seed: int
    ) -> Any:
        """A shortener of a path beside this one that keeps a distance from obstacles where there is room."""
        numbers, places = zip(*map(self._configuration, poses), strict=True)
        grid = self._grid(FINE_PLACE_BITS, FINE_ANGLE_BITS)
        x0, y0, x1, y1 = map(float, bounds) if bounds else (-math.inf, -math.inf, math.inf, math.inf)
        limits = [c * self._unit for c in (x0, y0, x1, y1)]
        return _core.balanced(
            self.checker.core, self._nearness, grid, limits, self._costs, list(numbers), list(places), seed
        )

    def poses(self, found: list[tuple[int, int, int, int, int]]) -> list[Pose]:
        """Exact poses from the core's."""
        poses = []
        for hx, hy, x, y, unit in found:
            tau = Fraction(hy, hx) if hx else None
            poses.append(Pose(Fraction(x, unit * self._scale), Fraction(y, unit * self._scale), {"tau": tau}))
        return poses

    @cached_property
    def _nearness(self) -> Any:
        return _core.Nearness(self.checker.features.core)

    def _grid(self, place_bits: int, angle_bits: int) -> list[int]:
        return [self._shift, place_bits - self._extent, angle_bits]

    def _configuration(self, pose: Pose) -> tuple[list[int], list[float]]:
        unit = math.lcm(pose.x.denominator, pose.y.denominator)
        hx, hy = (0, 1) if pose.tau is None else (pose.tau.denominator, pose.tau.numerator)
        numbers = [hx, hy, int(pose.x * unit) * self._scale, int(pose.y * unit) * self._scale, unit]
        theta = math.remainder(pose.theta, math.tau)
        return numbers, [float(pose.x) * self._unit, float(pose.y) * self._unit, theta]
