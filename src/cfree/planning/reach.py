"""Boxes of poses that a car without reverse gear may reach: too many, never too few; and a search within them.

A path back in time from the goal is one ahead, with all headings turned by half a turn and the radii swapped.
docs/theory/vehicles.md, "Forward only", has the proof.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Any, Literal

import cfree._core as _core
from cfree.exact.pose import Pose
from cfree.planning.first_motions import Touching, convex_pieces
from cfree.planning.unreachable import BoxGrid, Unreachable
from cfree.polygons.polygon import Polygon
from cfree.scene.frame import frame_of
from cfree.scene.scene import Scene
from cfree.vehicles.vehicle import Car

BOXES = (2**19, 2**22, 2**25)  # about so many at each fineness
WORK = 2**12  # words of 64 boxes by turns, from start and goal
STEP = 6  # of travel, in sides of a box; at most a turning radius
BITS = 8  # of lengths
NEAR, FAR_SMALLER = 4, 4  # robot reaches around an end; times that this is smaller than all

Side = Literal["start", "goal"]
SIDES: tuple[Side, Side] = ("start", "goal")
Area = tuple[float, float, float, float]


@dataclass(frozen=True)
class Level:
    """The boxes at one fineness.

    Attributes
    ----------
    grid : BoxGrid
    back : cfree._core.Boxes
        Those from which the goal may be reached.
    proof : Unreachable or None
        The proof that there is no path, if these boxes are one.
    """

    grid: BoxGrid
    back: _core.Boxes
    proof: Unreachable | None


class Reach:
    """What a car without reverse gear may reach in a scene, from its start or back from its goal.

    Parameters
    ----------
    scene : Scene
        Without round shapes.
    car : Car
    start, goal : Pose
        Free poses of the robot.
    """

    def __init__(self, scene: Scene, car: Car, start: Pose, goal: Pose) -> None:
        self.scene, self.car, self.start, self.goal = scene, car, start, goal
        self.ends = {"start": start @ car.frame, "goal": goal @ car.frame}
        self.touching = Touching(scene, car)
        self._levels = list[Level]()

    @cached_property
    def shapes(self) -> tuple[Any, Any]:
        """Convex pieces of the robot in the axle's frame, and of the obstacles, in doubles."""
        frame, room = self.touching.frame, self.scene.workspace
        shapes = [*self.scene.obstacles, *([frame] if frame else [])]
        shapes += [Polygon(hole) for hole in room.exact_rings[1:]] if room else []
        obstacles = [ring for shape in shapes for ring in convex_pieces(shape, Pose(0, 0))]
        return [*map(_rounded, self.touching.robot)], [*map(_rounded, obstacles)]

    @cached_property
    def area(self) -> Area:
        """Where the axle point may be; beyond it is outside of everything."""
        robot, obstacles = self.shapes
        far = self.touching.reach
        is_inside = any(all(a[0] * b[1] >= a[1] * b[0] for a, b in pairwise([*ring, ring[0]])) for ring in robot)
        room, bounds = self.scene.workspace, self.scene.bounds
        ends = [(float(pose.x), float(pose.y)) for pose in self.ends.values()]
        if room is not None:
            ends += [(float(x), float(y)) for x, y in room.exact_rings[0]]
            more = 0 if is_inside else far
        elif bounds is not None:
            x0, y0, x1, y1 = map(float, bounds)
            ends += [(x0, y0), (x1, y1)]
            more = math.hypot(*map(float, self.car.axle))
        else:
            ends += [p for ring in obstacles for p in ring]
            more = 2 * far
        x, y = ([p[k] for p in ends] for k in (0, 1))
        return min(x) - more, min(y) - more, max(x) + more, max(y) + more

    def around(self, at: Side) -> Area | None:
        """Return the area near an end, if it is far smaller than all: whoever cannot leave it gets nowhere else."""
        x, y, by = float(self.ends[at].x), float(self.ends[at].y), NEAR * self.touching.reach
        x0, y0, x1, y1 = self.area
        near = max(x0, x - by), max(y0, y - by), min(x1, x + by), min(y1, y + by)
        return near if FAR_SMALLER * _size(near) < _size(self.area) else None

    def grid(self, boxes: int, area: Area | None = None) -> BoxGrid:
        """Return a grid of about so many boxes, of all or of an area."""
        x0, y0, x1, y1 = area = self.area if area is None else area
        far = self.touching.reach
        side = _short((_size(area) * math.tau * far / boxes) ** (1 / 3))
        step = min(side * STEP, _short(float(min(self.car.radii))))
        slices = 2 * math.ceil(math.pi * far / float(side))
        rim = STEP + 4
        corner = _below(x0, side, rim), _below(y0, side, rim)
        columns, rows = (
            math.ceil((high - float(low)) / float(side)) + rim for low, high in zip(corner, (x1, y1), strict=True)
        )
        return BoxGrid(corner, side, step, columns, rows, slices)

    def boxes(self, grid: BoxGrid, at: Side) -> _core.Boxes:
        """Return the boxes reached from the start, or back from the goal, none of them computed yet."""
        robot, obstacles = self.shapes
        first, last = self.ends[at], self.ends["goal" if at == "start" else "start"]
        (rx, ry), (left, right) = self.touching.reference, map(float, self.car.radii)
        reference, turn = (float(rx), float(ry)), 0.0
        if at == "goal":
            robot = [[(-x, -y) for x, y in ring] for ring in robot]
            reference, turn, left, right = (-reference[0], -reference[1]), math.pi, right, left
        bounds = None if self.scene.bounds is None else [*map(float, self.scene.bounds)]
        sizes = [*map(float, (*grid.corner, grid.side, grid.step))]
        counts = grid.columns, grid.rows, grid.slices
        ends = [(float(q.x), float(q.y), (q.theta + turn) % math.tau) for q in (first, last)]
        return _core.Boxes(robot, obstacles, bounds, reference, (left, right), sizes, counts, *ends)

    def levels(self) -> Iterator[Level]:
        """Yield the boxes, finer and finer; the last ones are a proof, if any are. They are computed once."""
        yield from self._levels
        if self._levels and self._levels[-1].proof is not None:
            return
        for count in BOXES[len(self._levels) :]:
            self._levels.append(self._level(count))
            yield self._levels[-1]
            if self._levels[-1].proof is not None:
                return

    def _level(self, count: int) -> Level:
        """Return the boxes at one fineness; the area near an end has as many as all of the scene."""
        grid = self.grid(count)
        back = self.boxes(grid, "goal")
        boxes: list[tuple[BoxGrid, Side, _core.Boxes]]
        boxes = [(grid, "start", self.boxes(grid, "start")), (grid, "goal", back)]
        for side in SIDES:
            if (area := self.around(side)) is not None:
                near = self.grid(count, area)
                boxes.append((near, side, self.boxes(near, side)))
        while boxes:
            for done in [item for item in boxes if item[2].run(WORK)]:
                boxes.remove(done)
                if not done[2].meets_goal:
                    return Level(grid, back, self._proof(*done))
        return Level(grid, back, None)

    def _proof(self, grid: BoxGrid, at: Side, boxes: _core.Boxes) -> Unreachable:
        """Return the proof that boxes are."""
        scene = self.scene
        bits = zlib.compress(boxes.bits, 9)
        context = scene.units, frame_of(scene), scene
        pieces = tuple(ring for part in scene.robot for ring in convex_pieces(part, Pose(0, 0)))
        return Unreachable(self.start, self.goal, self.car, at, pieces, grid, bits, *context)


def _size(area: Area) -> float:
    return (area[2] - area[0]) * (area[3] - area[1])


def _rounded(ring: Any) -> list[tuple[float, float]]:
    return [(float(x), float(y)) for x, y in ring]


def _short(length: float) -> Fraction:
    """Return a length of few bits near a length."""
    unit = Fraction(2) ** (math.frexp(length)[1] - BITS)
    return unit * max(1, math.floor(length / float(unit)))


def _below(value: float, side: Fraction, count: int) -> Fraction:
    """Return a multiple of a side, so many of them below a value."""
    return (math.floor(value / float(side)) - count) * side
