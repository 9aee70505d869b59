"""Trace marked cells of a grid exactly: polygons with holes, along the sides of the cells.

Cells that meet in a corner only are in different polygons. A polygon whose rings would touch in a corner is cut along
a row there, so that all rings are simple.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]
Runs = NDArray[np.intp]
Point = tuple[int, int]
KEPT_PARTS, KEPT_CELLS = 512, 1 << 18  # number of parts whose rings are kept, and the most cells of the box of one


def outlines(mask: Mask, spend: Callable[[int], object] = lambda steps: None) -> Iterator[list[list[Point]]]:
    """Yield the rings of each polygon, the outer one first; cell (row, column) is the unit square at (column, row).

    Parameters
    ----------
    mask : (rows, columns) array of bool
    spend : function of int
        It is called with numbers of steps.

    Examples
    --------
    >>> list(outlines(np.array([[True, True], [False, True]])))
    [[[(0, 0), (2, 0), (2, 2), (1, 2), (1, 1), (0, 1)]]]
    >>> ring = np.ones((3, 3), dtype=bool)
    >>> ring[1, 1] = False
    >>> [len(polygon) for polygon in outlines(ring)]
    [2]
    """
    waiting = [(mask, (0, 0))]
    while waiting:
        part, (x, y) = waiting.pop()
        for piece, (column, row) in reversed(list(_connected(part, spend))):
            traced = _traced_before if piece.size <= KEPT_CELLS else _traced
            cut, rings, steps = traced(piece.shape, np.packbits(piece).tobytes())
            spend(steps)
            if cut:
                waiting += [
                    (piece[cut:], (x + column, y + row + cut)),
                    (piece[:cut], (x + column, y + row)),
                ]
            else:
                yield [[(x + column + p, y + row + q) for p, q in ring] for ring in rings]


def _traced(shape: tuple[int, int], cells: bytes) -> tuple[int, list[list[Point]], int]:
    """Return the row along which a part has to be cut, or 0, its rings if it has not, and the steps that they took."""
    bits = np.frombuffer(cells, dtype=np.uint8)
    piece = np.unpackbits(bits, count=shape[0] * shape[1]).reshape(shape).astype(bool)
    pinches = _pinches(piece)
    if pinches.size:
        return int(pinches[len(pinches) // 2]), [], 0
    return 0, *_rings(piece)


_traced_before = lru_cache(KEPT_PARTS)(_traced)  # a map that changes keeps most of its parts


def specks(
    mask: Mask, free: Mask, fewer_than: int, spend: Callable[[int], object] = lambda steps: None
) -> Iterator[tuple[tuple[Runs, Runs], int]]:
    """Yield rows and columns of the cells of each small part, and their number.

    A part is connected over sides and corners. All cells around it are free, and inside of the grid.

    Examples
    --------
    >>> mask = np.zeros((5, 8), dtype=bool)
    >>> mask[1, 1] = mask[2, 2] = mask[3, 5] = mask[0, 7] = True
    >>> [(rows.tolist(), columns.tolist()) for (rows, columns), _ in specks(mask, ~mask, 3)]
    [([1, 2], [1, 2]), ([3], [5])]
    >>> [count for _, count in specks(mask, ~mask, 2)]
    [1]
    """
    inside = np.pad(free | mask, 1)  # what is outside of the grid is not free
    for rows, starts, stops in _parts(mask, spend, corners=True):
        count = int((stops - starts).sum())
        runs = list(zip(rows.tolist(), starts.tolist(), stops.tolist(), strict=True))
        if count < fewer_than and all(inside[row : row + 3, start : stop + 2].all() for row, start, stop in runs):
            columns = np.concatenate([np.arange(start, stop) for _, start, stop in runs])
            yield (np.repeat(rows, stops - starts), columns), count


def _parts(mask: Mask, spend: Callable[[int], object], corners: bool = False) -> Iterator[tuple[Runs, Runs, Runs]]:
    """Yield rows, starts and stops of the runs of each part of cells connected over sides, or also over corners."""
    rows, starts = np.nonzero(_steps(mask) > 0)
    _, stops = np.nonzero(_steps(mask) < 0)
    count = len(rows)
    spend(count)
    parent = list(range(count))

    def root(k: int) -> int:
        while parent[k] != k:
            parent[k] = parent[parent[k]]
            k = parent[k]
        return k

    first = np.searchsorted(rows, np.arange(mask.shape[0] + 1)).tolist()
    begin, end = starts.tolist(), (stops + corners).tolist()  # a run longer by one meets those over its corners
    for row in range(1, mask.shape[0]):
        a, b = first[row - 1], first[row]
        while a < first[row] and b < first[row + 1]:
            if begin[a] < end[b] and begin[b] < end[a]:
                parent[root(b)] = root(a)
            if end[a] < end[b]:
                a += 1
            else:
                b += 1
    runs = defaultdict(list)
    for k in range(count):
        runs[root(k)].append(k)
    for members in runs.values():
        yield rows[members], starts[members], stops[members]


def _connected(mask: Mask, spend: Callable[[int], object]) -> Iterator[tuple[Mask, Point]]:
    """Yield each part of cells connected over sides, cut to its box, and the box's corner."""
    for rows, starts, stops in _parts(mask, spend):
        left, right = int(starts.min()), int(stops.max())
        top, bottom = int(rows[0]), int(rows[-1]) + 1
        spend(1 + (right - left) * (bottom - top) // 1024)
        piece = np.zeros((bottom - top, right - left), dtype=bool)
        for row, start, stop in zip(rows.tolist(), starts.tolist(), stops.tolist(), strict=True):
            piece[row - top, start - left : stop - left] = True
        yield piece, (left, top)


def _steps(mask: Mask) -> NDArray[np.int8]:
    """Mark the starts of runs in a row with +1, and their ends with -1."""
    padded = np.pad(mask, ((0, 0), (1, 1))).astype(np.int8)
    return padded[:, 1:] - padded[:, :-1]


def _pinches(mask: Mask) -> NDArray[np.intp]:
    """Return the rows, in order, on which two marked cells meet only in a corner."""
    a, b, c, d = mask[:-1, :-1], mask[:-1, 1:], mask[1:, :-1], mask[1:, 1:]
    return np.nonzero(((a & d & ~b & ~c) | (b & c & ~a & ~d)).any(axis=1))[0] + 1


def _rings(mask: Mask) -> tuple[list[list[Point]], int]:
    """Return the rings around one part without pinches, the outer one first, its cells to the left; and their sides."""
    padded = np.pad(mask, 1)
    follow: dict[Point, Point] = {}
    count = 0
    sides = {
        (1, 0): padded[1:, 1:-1] & ~padded[:-1, 1:-1],  # the cell is above its lower side
        (-1, 0): padded[:-1, 1:-1] & ~padded[1:, 1:-1],
        (0, -1): padded[1:-1, 1:] & ~padded[1:-1, :-1],
        (0, 1): padded[1:-1, :-1] & ~padded[1:-1, 1:],
    }
    for (dx, dy), there in sides.items():
        rows, columns = np.nonzero(there)
        count += len(rows)
        for row, column in zip(rows.tolist(), columns.tolist(), strict=True):
            follow[column + (dx < 0), row + (dy < 0)] = dx, dy
    rings: list[list[Point]] = []
    while follow:
        start = p = min(follow) if not rings else next(iter(follow))
        ring, before = [], (0, 0)
        while p in follow:
            step = follow.pop(p)
            if step != before:
                ring.append(p)
            p, before = (p[0] + step[0], p[1] + step[1]), step
        assert p == start
        if len(ring) > 1 and before == _direction(ring[0], ring[1]):
            ring = ring[1:]
        rings.append(ring)
    return rings, count


def _direction(p: Point, q: Point) -> Point:
    x, y = q[0] - p[0], q[1] - p[1]
    return (x > 0) - (x < 0), (y > 0) - (y < 0)
