"""`Unreachable`: a proof that a car without reverse gear cannot get to its goal, by boxes of poses."""

from __future__ import annotations

import math
import zlib
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Literal, NoReturn

from cfree.arguments import checked
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.planning.separation import NO_TRUTH_VALUE
from cfree.scene.digest import Stamp, Whole
from cfree.scene.goals import Moved
from cfree.scene.scene import Scene
from cfree.value import Answer, Shown
from cfree.vehicles.vehicle import Car, described


@checked
@dataclass(frozen=True)
class BoxGrid:
    """A grid of boxes of axle poses.

    Parameters
    ----------
    corner : pair of Fraction
        Lower left corner of the first box.
    side : Fraction
        Sides of the boxes in x and y.
    step : Fraction
        Length of travel after which the boxes hold the car again.
    columns, rows, slices : int
        Boxes along x, along y, and in a turn; the first slice begins at 0.
    """

    corner: ExactPoint
    side: Fraction
    step: Fraction
    columns: int
    rows: int
    slices: int

    @property
    def turn(self) -> float:
        """Width of a slice, in radians."""
        return math.tau / self.slices

    @property
    def count(self) -> int:
        """Number of boxes."""
        return self.columns * self.rows * self.slices


@checked
@dataclass(frozen=True, repr=False)
class Unreachable(Shown, Answer):
    """A proof that no path of a car without reverse gear leads from start to goal.

    It holds for all paths whose curvature is measurable and within the car's, not only for those of lines and arcs. It
    has no truth value, as `Separated` has none.

    Parameters
    ----------
    start, goal : Pose
    vehicle : Car
    at : "start" or "goal"
        "start": the boxes hold every axle pose that the car reaches from its start, after each step of travel. "goal":
        every one from which it reaches its goal, with all headings turned by half a turn.
    pieces : tuple of tuples of (x, y)
        Convex polygons inside the robot, counterclockwise in its frame: the proof is about them alone.
    grid : BoxGrid
    boxes : bytes
        Those of the grid that the proof lists: a bit for each, compressed by zlib. Bits go from the lowest of a byte to
        its highest, along the columns of a row, the rows of a slice, and the slices.

    Notes
    -----
    A box that is not listed is forbidden as a whole, or no listed box leads there in one step. Theory, "Vehicles",
    "Forward only", has the proof that this is enough.
    """

    start: Pose
    goal: Pose
    vehicle: Car
    at: Literal["start", "goal"]
    pieces: tuple[tuple[ExactPoint, ...], ...]
    grid: BoxGrid
    boxes: bytes
    units: str = field(default="", compare=False)
    frame: str = field(default="world", compare=False)
    scene: Scene | None = field(default=None, compare=False)
    stamp: Stamp | None = field(default=None, compare=False)
    curved: Scene | None = field(default=None, compare=False)
    moved: Moved | None = None
    whole: Whole | None = field(default=None, compare=False)

    @property
    def clearance(self) -> Fraction:
        """0: it is about paths that may touch."""
        return Fraction(0)

    @property
    def of(self) -> Literal["paths"]:
        """It holds for all paths."""
        return "paths"

    @property
    def obstacles(self) -> tuple[int, ...]:
        """None: all obstacles near the boxes matter."""
        return ()

    @property
    def pose(self) -> Pose:
        """The end that the boxes start from."""
        return self.start if self.at == "start" else self.goal

    @property
    def margin(self) -> float:
        """Length by which the boxes make the robot smaller, at most: a box is forbidden if the smaller one overlaps."""
        axle = self.vehicle.axle
        return margin_of(
            self.grid, max((math.dist(point, axle) for piece in self.pieces for point in piece), default=0.0)
        )

    @cached_property
    def count(self) -> int:
        """Number of boxes listed."""
        try:
            bits = zlib.decompressobj().decompress(self.boxes, (self.grid.count + 7) // 8)
        except zlib.error:
            return 0
        return int.from_bytes(bits, "little").bit_count()

    def __bool__(self) -> NoReturn:
        raise TypeError(f"{type(self).__name__}: {NO_TRUTH_VALUE}")

    def __repr__(self) -> str:
        return f"Unreachable(at={self.at!r}, {self.count:,} boxes of side {float(self.grid.side):g})"

    def said(self) -> str:
        """Return the sentence: it is about both ends."""
        return self.sentence()

    def sentence(self) -> str:
        """Write the proof in a sentence."""
        return f"no path of {described(self.vehicle, self.units)} leads from the start to the goal"


def margin_of(grid: BoxGrid, reach: float) -> float:
    """Return the length by which boxes make a robot smaller, at most; its points are within a reach of the axle."""
    return math.sqrt(0.5) * float(grid.side) + reach * grid.turn / 2
