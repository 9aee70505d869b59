"""Nesting of closed surfaces among rounded shapes, tile by tile: the surfaces around a pose beside each.

Two poses are beside a trapezoid of a surface, one on its left and one on its right, and the lines from both towards -x
cross the same other trapezoids of all tiles. A surface is around them if the line from the left one crosses it an odd
number of times. Of those around a surface the one that is in most others is next. docs/theory/rounded-shapes.md.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from cfree.distributed.nesting import NONE, Nesting, TileSurfaces
from cfree.errors import InvariantError

Ints = NDArray[np.int64]
Integers = tuple[int, int, int, int, int]
ATTEMPTS, CLOSER = 24, 6  # to find a pair of poses; powers of four by which every other attempt is closer


@dataclass(frozen=True, slots=True)
class Beside:
    """Poses left and right of a surface: integers X, Y, W, p, r in the form of the core; and the chart."""

    left: Integers
    right: Integers
    chart: int
    is_forbidden_left: bool

    def box(self, scale: float) -> tuple[float, float, float]:
        """Bounds of x from above, and of y, in the user's units."""
        (x, y, w, *_) = self.right
        at_x, at_y = x / w / scale, y / w / scale
        return at_x + abs(at_x) * 2.0**-40, at_y - abs(at_y) * 2.0**-40, at_y + abs(at_y) * 2.0**-40


@dataclass(frozen=True, slots=True)
class RoundQuestion:
    """A query for the surfaces that a line crosses in a tile; without poses, a pair is begun."""

    surface: int
    attempt: int
    beside: Beside | None


@dataclass(frozen=True, slots=True)
class RoundAnswer:
    """The poses, and the surfaces crossed an odd number of times; None if the pair does not do."""

    surface: int
    beside: Beside | None = None
    odd: frozenset[int] | None = None


class RoundTileLines(TileSurfaces):
    """Lines through the trapezoids of one tile; see `TileSurfaces`."""

    def answered(self, asked: RoundQuestion) -> RoundAnswer:
        """Answer a query."""
        if asked.beside is not None:
            return RoundAnswer(asked.surface, asked.beside, self._odd(asked.beside))
        for k in range(self._faces(asked.surface)):  # where surfaces coincide, many faces have no pair
            row = self._row(asked.surface, asked.attempt // 2 + k)
            found = self._location.beside(row, asked.attempt, CLOSER * (asked.attempt % 2))
            if found is not None:
                beside = Beside(*found)
                _, _, crossed, _ = self._location.nearby(beside.left, beside.chart)
                return RoundAnswer(asked.surface, beside, self._odd_of(crossed))
        return RoundAnswer(asked.surface)

    def _odd(self, beside: Beside) -> frozenset[int] | None:
        left, right = (self._location.nearby(pose, beside.chart) for pose in (beside.left, beside.right))
        if left[0] or right[0] or not (left[3] and right[3]) or sorted(left[2]) != sorted(right[2]):
            return None
        return self._odd_of(left[2])

    def _odd_of(self, rows: list[int]) -> frozenset[int]:
        counts = Counter(self._surface[rows].tolist())
        return frozenset(surface for surface, count in counts.items() if count % 2)


@dataclass(slots=True)
class _Search:
    """Facts known about one surface's pair of poses."""

    attempt: int = 0
    beside: Beside | None = None
    odd: set[int] = field(default_factory=set)


def nest_round(
    count: int,
    present: Mapping[int, Ints],
    boxes: NDArray[np.float64],
    ask: Callable[[Mapping[int, list[RoundQuestion]]], Iterable[tuple[int, RoundAnswer]]],
    is_bounded: bool,
    scale: float,
) -> Nesting:
    """Nest closed surfaces.

    Parameters
    ----------
    count : int
        Number of surfaces.
    present : mapping of tile to surfaces
        Surfaces in each tile.
    boxes : (tiles, 4) float64
        Boxes around the poses of each tile's trapezoids, in the user's units.
    ask : callable
        Function of queries by tile, which returns tiles and answers.
    is_bounded : bool
        True if there is no free space far away.
    scale : float
        Factor from a unit of the user to integers of a pose.
    """
    tiles_of: list[list[int]] = [[] for _ in range(count)]
    for tile, surfaces in present.items():
        for surface in surfaces.tolist():
            tiles_of[surface].append(tile)
    for tiles in tiles_of:  # the leftmost of the surface comes first
        tiles.sort(key=lambda tile: (boxes[tile, 0], tile))
    with_faces = np.array(sorted(present), np.int64)
    searches = {surface: _Search() for surface in range(count)}
    waiting = list(range(count))
    while waiting:
        begun: dict[int, list[RoundQuestion]] = {}
        for surface in waiting:
            tile = tiles_of[surface][searches[surface].attempt % len(tiles_of[surface])]
            begun.setdefault(tile, []).append(RoundQuestion(surface, searches[surface].attempt, None))
        following: dict[int, list[RoundQuestion]] = {}
        failed = set[int]()
        for own, answer in ask(begun):
            search = searches[answer.surface]
            if answer.beside is None or answer.odd is None:
                failed.add(answer.surface)
                continue
            search.beside, search.odd = answer.beside, set(answer.odd)
            for tile in _tiles_on(answer.beside, with_faces, boxes, scale):
                if tile != own:
                    question = RoundQuestion(answer.surface, search.attempt, answer.beside)
                    following.setdefault(tile, []).append(question)
        for _, answer in ask(following) if following else ():
            if answer.odd is None:
                failed.add(answer.surface)
            else:
                searches[answer.surface].odd ^= answer.odd
        waiting = sorted(failed)
        for surface in waiting:
            if searches[surface].attempt == ATTEMPTS * len(tiles_of[surface]):
                raise InvariantError(f"no poses beside closed surface {surface} in general position")
            searches[surface] = _Search(searches[surface].attempt + 1)
    return _nested([searches[surface] for surface in range(count)], is_bounded)


def _tiles_on(beside: Beside, tiles: Ints, boxes: NDArray[np.float64], scale: float) -> list[int]:
    """Tiles that the lines towards -x may meet."""
    x, low, high = beside.box(scale)
    box = boxes[tiles]
    met: list[int] = tiles[(box[:, 0] <= x) & (box[:, 1] <= high) & (box[:, 3] >= low)].tolist()
    return met


def _nested(searches: list[_Search], is_bounded: bool) -> Nesting:
    """Nesting from the surfaces around the left pose of each."""
    count = len(searches)
    free_inside, around = np.zeros(count, np.bool_), list[set[int]]()
    for surface, search in enumerate(searches):
        assert search.beside is not None
        free_inside[surface] = (surface in search.odd) != search.beside.is_forbidden_left
        around.append(search.odd - {surface})
    parent = np.full(count, NONE, np.int64)
    for surface, others in enumerate(around):
        if others:
            parent[surface] = max(others, key=lambda other: len(around[other]))
    for surface, above in enumerate(parent.tolist()):
        is_free_around = not is_bounded if above == NONE else bool(free_inside[above])
        if is_free_around == free_inside[surface]:
            raise InvariantError(f"closed surface {surface} has one kind of space on both sides")
    return Nesting(parent, free_inside)
