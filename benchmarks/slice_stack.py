"""A planner over slices of theta that shapely makes: cells of a slice, joined to those of the next where they overlap.

Slices are made when the search first needs them; those at the start's and the goal's orientation are among them. Two
kinds: *sampled* slices are those of the robot at their orientation; *swept* ones are those of all orientations up to
half a step away, a little more of them, so that their paths are free.
"""

from __future__ import annotations

import math
from collections import deque

import numpy as np
import shapely
from shapely_slices import grouped, sums_by_hull, sums_by_merging

Box = tuple[float, float, float, float]
Turn = tuple[float, float, float, float]  # x, y, from theta, by


class Stack:
    """Slices of a scene in the order of their orientations.

    thetas : rising, (k,); `cells(k)`: the free polygons of one.
    """

    def __init__(
        self, robot: list[np.ndarray], obstacles: list[np.ndarray], box: Box, thetas: np.ndarray, swept: bool
    ) -> None:
        self.thetas, self.sums = thetas, sums_by_hull if swept else sums_by_merging
        widest = max(np.diff(thetas, append=thetas[0] + math.tau))
        self.robot = grouped([swept_over(piece, widest) for piece in robot] if swept else robot)
        self.obstacles, self.box = grouped(obstacles), shapely.box(*box)
        self._cells: dict[int, np.ndarray] = {}

    def cells(self, k: int) -> np.ndarray:
        if k not in self._cells:
            forbidden = shapely.union_all(self.sums(self.robot, self.obstacles, float(self.thetas[k])))
            parts = shapely.get_parts(shapely.difference(self.box, forbidden))
            self._cells[k] = parts[shapely.get_dimensions(parts) == 2]
            shapely.prepare(self._cells[k])
        return self._cells[k]

    def search(self, start: np.ndarray, goal: np.ndarray) -> list[Turn] | None:
        """Where to turn on the way from start to goal, whose orientations have slices; None: they are not joined."""
        count = len(self.thetas)
        first, last = (self.cell_of(pose) for pose in (start, goal))
        if first is None or last is None:
            return None
        came: dict[tuple[int, int], tuple[int, int] | None] = {first: None}
        queue = deque([first])
        while queue:
            at = queue.popleft()
            if at == last:
                return self.turns(came, last)
            for k in ((at[0] + 1) % count, (at[0] - 1) % count):
                here = self.cells(at[0])[at[1]]
                for cell in np.flatnonzero(shapely.intersects(here, self.cells(k))).tolist():
                    if (k, cell) not in came and not shapely.touches(here, self.cells(k)[cell]):
                        came[k, cell] = at
                        queue.append((k, cell))
        return None

    def cell_of(self, pose: np.ndarray) -> tuple[int, int] | None:
        """The cell that holds a pose, or is nearest: a pose may touch an obstacle."""
        k = int(np.abs(np.remainder(self.thetas - pose[2] + math.pi, math.tau) - math.pi).argmin())
        distances = shapely.distance(self.cells(k), shapely.Point(pose[:2]))
        near = 1e-6 * math.hypot(*np.array(self.box.bounds)[2:] - self.box.bounds[:2])
        return (k, int(distances.argmin())) if len(distances) and distances.min() < near else None

    def turns(self, came: dict[tuple[int, int], tuple[int, int] | None], last: tuple[int, int]) -> list[Turn]:
        """Where each step from slice to slice has most room, the first one first."""
        found: list[Turn] = []
        here, before = last, came[last]
        while before is not None:
            common = shapely.get_parts(self.cells(here[0])[here[1]] & self.cells(before[0])[before[1]])
            discs = shapely.maximum_inscribed_circle(common[shapely.get_dimensions(common) == 2])
            x, y = shapely.get_coordinates(discs[shapely.length(discs).argmax()])[0]
            by = math.remainder(self.thetas[here[0]] - self.thetas[before[0]], math.tau)
            found.append((x, y, float(self.thetas[before[0]]), by))
            here, before = before, came[before]
        return found[::-1]


def orientations(count: int, *poses: np.ndarray) -> np.ndarray:
    """`count` of them, evenly spaced, and those of some poses."""
    even = np.arange(count) * math.tau / count
    return np.unique(np.concatenate([even, [pose[2] % math.tau for pose in poses]]))


def swept_over(piece: np.ndarray, step: float) -> np.ndarray:
    """Points whose hull holds the piece at all angles up to half a step away: both ends, and where tangents meet."""
    half = step / 2
    return np.concatenate([rotated(piece, half), rotated(piece, -half), piece / math.cos(half)])


def rotated(points: np.ndarray, angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return points @ np.array([[c, s], [-s, c]])
