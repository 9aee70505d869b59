"""Pieces of a boundary between two angles, theta unrolled beyond full turns."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cfree.plot.pieces import WALL, Pieces, joined

if TYPE_CHECKING:
    from cfree.plot.workspace import Window

Floats = NDArray[np.float64]
Range = tuple[float, float]


def slab(pieces: Pieces, window: Window, degrees: Range) -> Pieces:
    """Repeat pieces of one turn and cut them off at two angles, without bounds and pieces outside the window.

    The walls of the bounds would hide everything.
    """
    x, y = pieces.corners[..., 0].mean(axis=1), pieces.corners[..., 1].mean(axis=1)
    inside = (x >= window[0]) & (x <= window[2]) & (y >= window[1]) & (y <= window[3])
    pieces = pieces.chosen(inside & (pieces.sort != WALL))
    low, high = degrees
    copies, count = [], 0
    for turn in range(math.floor(low / 360), math.ceil(high / 360)):
        corners = pieces.corners + np.array([0.0, 0.0, 360.0 * turn])
        copy = replace(pieces, corners=corners).between(low, high)
        copies.append(replace(copy, owner=np.where(copy.owner < 0, -1, copy.owner + count)))
        count += len(copy.corners)
    return joined(copies)


def distances(pieces: Pieces, rows: Floats, radius: float) -> Floats:
    """Return distances from the middles of pieces to poses x, y, degrees; a radian is as long as the radius."""
    scale = np.array([1.0, 1.0, math.radians(radius)])
    middle = pieces.corners.mean(axis=1) * scale
    least = np.full(len(middle), math.inf)
    for row in rows * scale:
        np.minimum(least, ((middle - row) ** 2).sum(axis=1), out=least)
    return np.asarray(np.sqrt(least))
