"""Cells of free poses, tile by tile: the crossings of the line from a pose towards -x, at its orientation.

The nearest crossing decides the cell if the line is in general position and the pose on no face. Tiles are queried from
the pose outwards, until none can hold a nearer one. For other poses all tiles on the line are queried. A pose on faces
is in the first cell that they bound. Any other is inside the closed surfaces that a line just after its orientation
crosses an odd number of times; the innermost of them decides the cell. docs/theory/cells.md has the proofs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.collision.pose_checker import clamped
from cfree.distributed.nesting import NONE, Crossing, Place
from cfree.distributed.tasks import GLUED, Work, opened
from cfree.exact.half_angle import chart_of, tau_in_chart
from cfree.exact.pose import Pose, Poses
from cfree.free.space import FORBIDDEN, NO_CELL

Ints = NDArray[np.int64]
InChart = tuple[tuple[int, ...], int]
"""A pose in the form of the core: integers X, Y, W, p, r, and the chart."""
Around = tuple[list[int], list[int]]
"""The surfaces of the faces that hold a pose; and those crossed just after its orientation, once for each crossing."""
Ask = Callable[[Any, Mapping[int, list[int]]], Iterable[tuple[int, list[Any]]]]


class TileFaces:
    """The faces of one tile, to be crossed by lines from poses."""

    def __init__(self, work: Work, tile: int) -> None:
        rows = work.rows(tile, work.surfaces, around=False)
        self._boundary = rows.core
        self._component = work.shard(GLUED, tile)["component"][rows.row]
        self._is_round = work.store.is_round

    @cached_property
    def _lines(self) -> _core.PointLocation:
        return _core.PointLocation(self._boundary)

    @cached_property
    def _faces(self) -> _core.FreeSpace:
        """Free space of the tile alone, used only for searches near a pose: its one surface means nothing."""
        one, each = np.ones(1, np.int32), np.zeros(len(self._component), np.int32)
        return _core.FreeSpace(self._boundary, _core.Surfaces(each, -one, one.astype(np.uint8)))

    def crossings(self, pose: InChart, surface: Ints) -> list[Crossing] | None:
        """Crossings of the line from a pose; None if it is not in general position, or the pose on a face.

        Among round shapes also None: their places are irrational.
        """
        if self._is_round:
            return None
        passages = self._lines.passages(*pose, NONE)
        if passages is None:
            return None
        return [Crossing(int(surface[self._component[row]]), Place.of(n, d), free) for row, n, d, free in passages]

    def around(self, pose: InChart, surface: Ints) -> Around:
        on, _, crossed, _ = self._faces.nearby(*pose)
        return surface[self._component[on]].tolist(), surface[self._component[crossed]].tolist()


@lru_cache(maxsize=2)
def tile_faces(folder: str, stamp: str, tile: int) -> TileFaces:
    return TileFaces(opened(folder, stamp), tile)


def crossings_task(
    folder: str, stamp: str, tile: int, surface: Ints, poses: Sequence[InChart]
) -> list[list[Crossing] | None]:
    """Crossings of lines in a tile; `surface` is that of each of its components."""
    faces = tile_faces(folder, stamp, tile)
    return [faces.crossings(pose, surface) for pose in poses]


def around_task(folder: str, stamp: str, tile: int, surface: Ints, poses: Sequence[InChart]) -> list[Around]:
    """Surfaces at poses, and those crossed just after their orientations, in a tile."""
    faces = tile_faces(folder, stamp, tile)
    return [faces.around(pose, surface) for pose in poses]


def with_rational_tangents(poses: Poses) -> list[Pose]:
    """Exact poses that `FreeSpace.locate` takes doubles for: orientations have the rounded tangents of their halves."""
    chart, tau = chart_of(poses.theta)
    taus = (tau_in_chart(k, Fraction(value)) for k, value in zip(chart.tolist(), tau.tolist(), strict=True))
    return [Pose(x, y, {"tau": tau}) for (x, y), tau in zip(poses.xy.tolist(), taus, strict=True)]


@dataclass
class _Line:
    """Facts known about the line of a pose.

    Attributes
    ----------
    tiles : list of int
        Tiles that it may meet, the one that reaches farthest to the right last.
    asked : int
        Number of them queried so far.
    """

    tiles: list[int]
    asked: int = 0
    nearest: Crossing | None = None

    def next(self, right: NDArray[np.float64], scale: float) -> int | None:
        """Tile that may hold a crossing nearer than the known one."""
        if self.asked == len(self.tiles):
            return None
        tile = self.tiles[-1 - self.asked]
        if self.nearest is not None and right[tile] < self.nearest.x.near / scale:
            return None
        return tile

    def is_general(self, crossed: list[Crossing] | None) -> bool:
        """Take in the result of the next tile; False if that is not enough to decide the nearest crossing."""
        self.asked += 1
        if crossed is None:
            return False
        known = crossed if self.nearest is None else [self.nearest, *crossed]
        self.nearest = max(known, key=lambda crossing: crossing.x, default=None)
        return sum(crossing.x == self.nearest.x for crossing in known if self.nearest is not None) < 2


@dataclass(frozen=True)
class CellsOf:
    """The cells that closed surfaces bound.

    Attributes
    ----------
    parent, cell_of : (n,) int64
    free_inside : (n,) bool
        For each surface, as in `Surfaces`.
    outside : int
        The cell around all of them; `NO_CELL` if space is forbidden there.
    """

    parent: Ints
    cell_of: Ints
    free_inside: NDArray[np.bool_]
    outside: int

    def beside(self, nearest: Crossing | None) -> int:
        """Cell just right of a crossing, or left of all."""
        if nearest is None:
            return self.outside
        return NO_CELL if nearest.is_free_before else int(self.cell_of[nearest.surface])

    def at(self, on: set[int], odd: set[int]) -> int:
        """First cell bounded by a surface that a pose is on, or else the cell inside the innermost one around it."""
        if on:
            return int(min(self.cell_of[surface] for surface in on))
        if not odd:
            return self.outside
        inner = max(odd, key=self._depth)
        return int(self.cell_of[inner]) if self.free_inside[inner] else NO_CELL

    def _depth(self, surface: int) -> int:
        depth = 0
        while (surface := int(self.parent[surface])) >= 0:
            depth += 1
        return depth


def cells_of(
    poses: Sequence[InChart],
    present: Ints,
    boxes: NDArray[np.float64],
    scale: float,
    ask: Ask,
    known: CellsOf,
    is_alone: bool,
) -> list[int]:
    """The cell of each free pose.

    Parameters
    ----------
    poses : sequence of InChart
    present : (k,) int64
        The tiles that have faces.
    boxes : (tiles, 4) float64
        Boxes around the poses of each tile's faces, in the user's units.
    scale : float
        Factor from a unit of the user to integers of a pose.
    ask : callable
        Function of a task and the numbers of poses by tile, which returns tiles and the results of the task for their
        poses.
    known : CellsOf
    is_alone : bool
        True to query one tile at a time, and so each of them once; else all that are needed next.
    """
    result = [FORBIDDEN] * len(poses)
    lines = {k: _Line(_tiles_on(pose, present, boxes, scale)) for k, pose in enumerate(poses)}
    every = {k: line.tiles for k, line in lines.items()}
    special: list[int] = []
    while lines:
        questions: dict[int, list[int]] = {}
        for k, line in list(lines.items()):
            tile = line.next(boxes[:, 2], scale)
            if tile is None:
                result[k] = known.beside(line.nearest)
                del lines[k]
            else:
                questions.setdefault(tile, []).append(k)
        if is_alone and questions:  # wait for all lines that meet other tiles later
            tile = max(questions, key=lambda tile: (boxes[tile, 2], -tile))
            questions = {tile: questions[tile]}
        for tile, answers in ask(crossings_task, questions):
            for k, crossed in zip(questions[tile], answers, strict=True):
                if not lines[k].is_general(crossed):
                    special.append(k)
                    del lines[k]
    on: dict[int, set[int]] = {k: set() for k in special}
    odd: dict[int, set[int]] = {k: set() for k in special}
    questions = {}
    for k in special:
        for tile in every[k]:
            questions.setdefault(tile, []).append(k)
    for tile, answers in ask(around_task, questions):
        for k, (held, crossed) in zip(questions[tile], answers, strict=True):
            on[k] |= set(held)
            for surface in crossed:
                odd[k] ^= {surface}
    for k in special:
        result[k] = known.at(on[k], odd[k])
    return result


def _tiles_on(pose: InChart, present: Ints, boxes: NDArray[np.float64], scale: float) -> list[int]:
    """Tiles that the line towards -x may meet, the one that reaches farthest to the right last."""
    X, Y, W, *_ = pose[0]
    x, y = (clamped(Fraction(c, W)) / scale for c in (X, Y))
    box = boxes[present]
    met = present[(box[:, 0] <= x) & (box[:, 1] <= y) & (box[:, 3] >= y)]
    return [int(tile) for tile in met[np.lexsort((-met, boxes[met, 2]))]]
