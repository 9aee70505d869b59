"""Find the boxes that meet others among very many: a packed tree in four arrays, 34 to 45 bytes a box."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import chain

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]
WIDTH = 16  # boxes in a box of the next level


class BoxTree:
    """Tree of boxes around boxes that are near each other.

    Parameters
    ----------
    boxes : iterable of four numbers
        xmin, ymin, xmax, ymax.
    count : int
        Number of boxes.

    Examples
    --------
    >>> tree = BoxTree([(0, 0, 1, 1), (5, 5, 6, 6), (1, 1, 2, 2)], 3)
    >>> tree.meeting(np.array([(1.0, 1, 1, 1), (0, 0, 9, 0)])).tolist()
    [0, 2]
    """

    def __init__(self, boxes: Iterable[Sequence[float]], count: int) -> None:
        leaves = np.fromiter(chain.from_iterable(boxes), np.float64, 4 * count).reshape(-1, 4)
        strip = np.empty(count, np.int32)
        per_strip = WIDTH * math.ceil(math.sqrt(count / WIDTH) or 1)
        strip[(leaves[:, 0] + leaves[:, 2]).argsort(kind="stable")] = np.arange(count, dtype=np.int32) // per_strip
        self._numbers = np.lexsort((leaves[:, 1] + leaves[:, 3], strip)).astype(np.int32)
        for column in leaves.T:
            column[:] = column[self._numbers]
        self._levels = [leaves]  # from the boxes themselves to the few around all
        while len(level := self._levels[-1]) > WIDTH:
            first = np.arange(0, len(level), WIDTH)
            low, high = np.minimum.reduceat(level[:, :2], first), np.maximum.reduceat(level[:, 2:], first)
            self._levels.append(np.concatenate([low, high], axis=1))

    def meeting(self, boxes: Floats) -> Ints:
        """Return the numbers of the boxes that meet any of these, also if they only touch it, in order."""
        x0, y0, x1, y1 = boxes.T
        top = len(self._levels[-1])
        asked, node = np.repeat(np.arange(len(boxes)), top), np.tile(np.arange(top), len(boxes))
        for depth in reversed(range(len(self._levels))):
            level = self._levels[depth][node]
            meets = (level[:, 0] <= x1[asked]) & (level[:, 2] >= x0[asked])
            meets &= (level[:, 1] <= y1[asked]) & (level[:, 3] >= y0[asked])
            asked, node = asked[meets], node[meets]
            if depth:
                asked, node = np.repeat(asked, WIDTH), (WIDTH * node[:, None] + np.arange(WIDTH)).ravel()
                there = node < len(self._levels[depth - 1])
                asked, node = asked[there], node[there]
        return np.unique(self._numbers[node]).astype(np.int64)
