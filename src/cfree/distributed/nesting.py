"""Nesting of closed surfaces, tile by tile: the first surface on a line from each towards -x.

On the line from a pose of a surface towards -x, at its orientation, the last point of the surface has its outside to
the left. A region begins there, and the next surface on the line bounds it from the left. The surface is inside that
one, or beside it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.distributed.joining import JoinedSurfaces
from cfree.errors import InvariantError

Ints = NDArray[np.int64]
ATTEMPTS, TRIES = 8, 8  # to find a line: number of tasks of each tile, and of tries in each of these
NONE = -1


class Place(NamedTuple):
    """A place on a line, n / d with d > 0; the double next to it decides, and the fraction between equal doubles."""

    near: float
    n: int
    d: int

    @classmethod
    def of(cls, n: int, d: int) -> Place:
        return cls(n / d, n, d)

    def __lt__(self, other: Place) -> bool:  # type: ignore[override]
        return self.near < other.near or (self.near == other.near and self.n * other.d < other.n * self.d)

    def __gt__(self, other: Place) -> bool:  # type: ignore[override]
        return other < self

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Place) and self.near == other.near and self.n * other.d == other.n * self.d


@dataclass(frozen=True)
class Line:
    """A line towards -x from a pose on a surface: integers X, Y, W, p, r in the form of the core, and the chart."""

    pose: tuple[int, int, int, int, int]
    chart: int
    is_free_before: bool
    row: int
    """The trapezoid that the pose is on, in the tile that gave it."""

    @cached_property
    def x(self) -> Place:
        return Place.of(self.pose[0], self.pose[2])

    @property
    def y(self) -> float:
        return self.pose[1] / self.pose[2]


@dataclass(frozen=True, slots=True)
class Crossing:
    surface: int
    x: Place
    is_free_before: bool


class TileSurfaces:
    """Parts of closed surfaces in one tile.

    Parameters
    ----------
    boundary : _core.Boundary
        Boundary of the tile's own trapezoids.
    surface : (n,) int64
        Surface of each of them.
    """

    def __init__(self, boundary: _core.Boundary, surface: Ints) -> None:
        self._location, self._surface = _core.PointLocation(boundary), surface
        rows = boundary.trapezoids
        # by surface, the widest first
        self._order = np.lexsort((rows.from_hi - rows.to_lo, surface))
        self._sorted = surface[self._order]

    def _row(self, surface: int, attempt: int) -> int:
        """Return a trapezoid of a surface that is in the tile; other attempts give others, and then the same again."""
        first = np.searchsorted(self._sorted, surface)
        return int(self._order[first + attempt % self._faces(surface)])

    def _faces(self, surface: int) -> int:
        """Return the number of trapezoids of a surface that are in the tile."""
        first, end = np.searchsorted(self._sorted, [surface, surface + 1]).tolist()
        return int(end - first)


class TileLines(TileSurfaces):
    """Lines through the trapezoids of one tile; see `TileSurfaces`."""

    def begin(self, surface: int, attempt: int) -> tuple[Line | None, list[Crossing] | None]:
        """Line from a surface that is in the tile, and its crossings here; other attempts give other lines."""
        for k in range(TRIES * attempt, TRIES * (attempt + 1)):
            line = self._line(surface, k)
            crossed = None if line is None else self.crossings(line, is_its_own=True)
            if is_general(line, crossed):
                return line, crossed
        return None, None

    def _line(self, surface: int, attempt: int) -> Line | None:
        row = self._row(surface, attempt)
        pose = self._location.pose_on(row, attempt)
        return None if pose is None else Line(*pose, row)

    def crossings(self, line: Line, is_its_own: bool = False) -> list[Crossing] | None:
        """Crossings of a line here; None if they cannot be decided for this line."""
        passages = self._location.passages(line.pose, line.chart, line.row if is_its_own else NONE)
        if passages is None:
            return None
        return [Crossing(int(self._surface[row]), Place.of(n, d), free) for row, n, d, free in passages]


@dataclass(frozen=True, slots=True)
class Question:
    """A query for the crossings of a surface's line in a tile; without a line, one is begun.

    Attributes
    ----------
    surface, attempt : int
    own : list of int
        The tiles that the surface is in.
    """

    surface: int
    attempt: int
    own: list[int]
    line: Line | None


Ends = tuple[Crossing, "Crossing | None"]
"""The last crossing of a surface on its line, and the next crossing."""


class Left(NamedTuple):
    """The region to the left of a surface: True if its outside is free, and the surface that bounds it, if any does."""

    is_free_before: bool
    beyond: int = NONE
    is_free_before_beyond: bool = False

    @classmethod
    def of(cls, last: Crossing, beyond: Crossing | None) -> Left:
        if beyond is None:
            return cls(last.is_free_before)
        return cls(last.is_free_before, beyond.surface, beyond.is_free_before)


@dataclass(frozen=True, slots=True)
class Answer:
    """The line and its crossings, unless the region to its left is decided."""

    surface: int
    line: Line | None = None
    crossed: list[Crossing] | None = None
    left: Left | None = None


def answered(lines: TileLines, tile: int, asked: Question, boxes: NDArray[np.float64], scale: float) -> Answer:
    """Answer of a tile to a query; `boxes` and `scale` as in `nest`."""
    surface, line = asked.surface, asked.line
    if line is not None:
        return Answer(surface, line, lines.crossings(line))
    line, crossed = lines.begin(surface, asked.attempt)
    if line is not None and crossed is not None:
        search = _Search(asked.attempt, line, {tile}, crossed)
        if _next(search, surface, asked.own, boxes, scale) is None:
            return Answer(surface, left=Left.of(*_ends(search, surface)))
        crossed = _kept(search, surface, asked.own)
    return Answer(surface, line, crossed)


@dataclass
class Nesting:
    """Nesting of closed surfaces: the next around each, or -1, and True if space is free just inside it."""

    parent: Ints
    free_inside: NDArray[np.bool_]


@dataclass(slots=True)
class _Search:
    """Facts known about one surface's line."""

    attempt: int = 0
    line: Line | None = None
    done: set[int] = field(default_factory=set)
    crossed: list[Crossing] = field(default_factory=list)


def nest(
    joined: JoinedSurfaces,
    present: Mapping[int, Ints],
    boxes: NDArray[np.float64],
    ask: Callable[[Mapping[int, list[Question]]], Iterable[Answer]],
    is_bounded: bool,
    scale: float,
) -> Nesting:
    """Nest closed surfaces.

    Parameters
    ----------
    joined : JoinedSurfaces
    present : mapping of tile to surfaces
        Surfaces in each tile.
    boxes : (tiles, 4) float64
        Boxes around the poses of each tile's trapezoids, in the user's units.
    ask : callable
        Function of queries by tile, which returns the answers.
    is_bounded : bool
        True if there is no free space far away.
    scale : float
        Factor from a unit of the user to integers of a line.
    """
    tiles_of: list[list[int]] = [[] for _ in range(len(joined))]
    for here, surfaces in present.items():
        for surface in surfaces.tolist():
            tiles_of[surface].append(here)
    for tiles in tiles_of:  # the leftmost of the surface comes first
        tiles.sort(key=lambda tile: (boxes[tile, 0], tile))
    left: list[Left | None] = [None] * len(tiles_of)
    searches: dict[int, _Search] = {}  # for surfaces that need more than one tile
    waiting: Sequence[int] = range(len(tiles_of))
    while waiting:
        questions: dict[int, list[Question]] = {}
        for surface in waiting:
            search = searches.get(surface) or _Search()
            own = tiles_of[surface]
            attempt, turn = divmod(search.attempt, len(own))
            tile = own[turn]
            if search.line is not None:
                following = _next(search, surface, own, boxes, scale)
                if following is None:
                    left[surface] = Left.of(*_ends(searches.pop(surface), surface))
                    continue
                search.done.add(tile := following)
            questions.setdefault(tile, []).append(Question(surface, attempt, own, search.line))
        for answer in ask(questions) if questions else ():
            surface = answer.surface
            search = searches.get(surface) or _Search()
            known = None if answer.crossed is None else search.crossed + answer.crossed
            if answer.left is not None:
                left[surface] = answer.left
                searches.pop(surface, None)
            elif is_general(answer.line, known):
                if search.line is None:
                    search.done.add(tiles_of[surface][search.attempt % len(tiles_of[surface])])
                search.line, search.crossed = answer.line, known or []
                search.crossed = _kept(search, surface, tiles_of[surface])
                searches[surface] = search
            elif search.attempt == ATTEMPTS * len(tiles_of[surface]):
                raise InvariantError(f"no line from closed surface {surface} in general position")
            else:
                searches[surface] = _Search(search.attempt + 1)
        waiting = [surface for surface in waiting if left[surface] is None]
    return _nested([one for one in left if one is not None], is_bounded)


def _next(search: _Search, surface: int, own: list[int], boxes: NDArray[np.float64], scale: float) -> int | None:
    """Tile to query next: one that the surface is in, or that may hold a crossing nearer than the known one."""
    assert search.line is not None
    y, x = search.line.y / scale, search.line.x.near / scale
    last, beyond = _ends(search, surface)
    low, high = boxes[:, 1] <= y, boxes[:, 3] >= y
    near = low & high & (boxes[:, 0] <= x)
    near[list(search.done)] = False
    edge = last.x.near / scale
    mine = [tile for tile in own if near[tile] and boxes[tile, 0] <= edge]
    if mine:
        return max(mine, key=lambda t: (boxes[t, 2], t))
    if beyond is not None:
        near &= boxes[:, 2] >= beyond.x.near / scale
    near &= boxes[:, 0] <= edge
    others = np.flatnonzero(near)
    return int(others[np.argmax(boxes[others, 2])]) if len(others) else None


def is_general(line: Line | None, crossed: list[Crossing] | None) -> bool:
    """True if there is a line, and it crosses surfaces one after the other."""
    if line is None or crossed is None:
        return False
    places = sorted([line.x, *(crossing.x for crossing in crossed)])
    return all(one != other for one, other in pairwise(places))


def _ends(search: _Search, surface: int) -> Ends:
    """Ends of the line, as far as known."""
    line = search.line
    assert line is not None
    own = [crossing for crossing in search.crossed if crossing.surface == surface]
    last = min([Crossing(surface, line.x, line.is_free_before), *own], key=lambda c: c.x)
    others = [c for c in search.crossed if c.surface != surface and c.x < last.x]
    return last, max(others, key=lambda c: c.x, default=None)


def _kept(search: _Search, surface: int, own: Sequence[int]) -> list[Crossing]:
    """Crossings that ends still depend on: the last one is the rightmost that it can be, and those to its left."""
    last, beyond = _ends(search, surface)
    if search.done.issuperset(own):
        return [c for c in search.crossed if c is last or c is beyond]
    return [c for c in search.crossed if c is last or (c.surface != surface and c.x < last.x)]


def _nested(left: Sequence[Left], is_bounded: bool) -> Nesting:
    """Nesting from the regions to the left of each surface."""
    count = len(left)
    free_inside = np.array([not one.is_free_before for one in left], np.bool_)
    parent = np.full(count, NONE, np.int64)
    beside = np.full(count, NONE, np.int64)
    for surface, (is_free, beyond, is_free_beyond) in enumerate(left):
        if beyond == NONE:
            if is_free == is_bounded:
                raise InvariantError(f"closed surface {surface} is around nothing, with the wrong side free")
            continue
        # the side right of a crossing is free exactly if the left one is not
        if is_free_beyond == is_free:
            raise InvariantError(f"closed surfaces {surface} and {beyond} have no region between them")
        inside = is_free == bool(free_inside[beyond])
        (parent if inside else beside)[surface] = beyond
    while np.any(beside >= 0):  # surfaces beside others take the parents of these
        which = np.flatnonzero(beside >= 0)
        target = beside[which]
        ready = beside[target] < 0
        if not ready.any():
            raise InvariantError("closed surfaces are beside each other in a circle")
        parent[which[ready]] = parent[target[ready]]
        beside[which[ready]] = NONE
    return Nesting(parent, free_inside)
