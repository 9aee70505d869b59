"""Obstacle features divided by place into tiles of equal counts, and the obstacles that a tile needs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]
BLOCK = 50_000  # boxes


def divide(points: Floats, tiles: int) -> NDArray[np.int32]:
    """The tile of each point: halves of halves along the longer side, by counts.

    Examples
    --------
    >>> divide(np.array([(0.0, 0), (1, 0), (8, 0), (9, 1), (9, 0), (10, 0)]), 3).tolist()
    [0, 0, 1, 2, 1, 2]
    """
    number = np.zeros(len(points), np.int32)
    waiting = [(np.arange(len(points)), 0, max(1, min(tiles, len(points))))]
    while waiting:
        inside, first, count = waiting.pop()
        if count == 1:
            number[inside] = first
            continue
        some = points[inside]
        along = int(np.argmax(np.ptp(some, axis=0)))
        # equal points keep the order of their numbers, so that the division depends on the points alone
        order = np.lexsort((inside, some[:, 1 - along], some[:, along]))
        half, cut = count // 2, len(inside) * (count // 2) // count
        waiting.append((inside[order[cut:]], first + half, count - half))
        waiting.append((inside[order[:cut]], first, half))
    return number


def grown_by(boxes: Floats, reach: float) -> Floats:
    """Boxes with a rim, wide enough for the rounding of their coordinates."""
    finite = np.abs(boxes[np.isfinite(boxes)])
    rim = reach + 16 * float(np.spacing(finite.max(initial=0.0)))
    return np.asarray(boxes + np.array([-rim, -rim, rim, rim]), np.float64)


class BoxIndex:
    """Index of many boxes, to find those that meet others."""

    def __init__(self, boxes: Floats) -> None:
        self._tree = shapely.STRtree(shapely.box(*boxes.T) if len(boxes) else [])

    def near(self, boxes: Floats, reach: float) -> Ints:
        """Numbers of the boxes within a distance of others along both axes, in order; rounding adds some."""
        grown = grown_by(boxes, reach)
        if not len(grown) or not len(self._tree):
            return np.zeros(0, np.int64)
        return np.unique(self._tree.query(shapely.box(*grown.T))[1]).astype(np.int64)


def near_each(groups: Sequence[Floats], boxes: Floats, reach: float) -> list[Ints]:
    """Result of `BoxIndex(boxes).near` for each group; groups are indexed, boxes queried a block at a time."""
    if not groups:
        return []
    group_of = np.repeat(np.arange(len(groups)), [len(group) for group in groups])
    tree = shapely.STRtree(shapely.box(*np.concatenate([grown_by(group, reach) for group in groups]).T))
    codes = [np.zeros(0, np.int64)]
    for begin in range(0, len(boxes), BLOCK):
        number, met = tree.query(shapely.box(*boxes[begin : begin + BLOCK].T))
        codes.append(np.unique(group_of[met] * len(boxes) + begin + number))
    group, numbers = np.divmod(np.sort(np.concatenate(codes)), max(1, len(boxes)))
    return np.split(numbers, np.searchsorted(group, np.arange(1, len(groups))))


def merged(boxes: Floats, side: int = 8) -> Floats:
    """Fewer boxes around all of them: one for those that begin in one place of a grid, large ones as they are."""
    if len(boxes) <= side * side:
        return boxes
    low, high = boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)
    step = np.maximum((high - low) / side, np.finfo(float).tiny)
    is_large = ((boxes[:, 2:] - boxes[:, :2]) > 2 * step).any(axis=1)
    small = boxes[~is_large]
    place = np.minimum(((small[:, :2] - low) / step).astype(np.int64), side - 1) @ np.array([side, 1])
    order = np.argsort(place, kind="stable")
    starts = np.flatnonzero(np.diff(place[order], prepend=-1))
    if not len(small):
        return boxes
    lows = np.minimum.reduceat(small[order, :2], starts)
    highs = np.maximum.reduceat(small[order, 2:], starts)
    return np.concatenate([np.concatenate([lows, highs], axis=1), boxes[is_large]])
