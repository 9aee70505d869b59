"""The trapezoids of one tile glued to each other and to those of the tiles around it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.distributed.rows import Rows
from cfree.distributed.shard import Shard

FIRST, LAST = 0, 2  # sides of trapezoids: at its first angle, and at its last


def glue_tile(rows: Rows, own: int) -> Shard:
    """Partners of the sides of a tile's trapezoids, and the parts of closed surfaces in it.

    Parameters
    ----------
    rows : Rows
        Rows of the tile, and of all features within reach of one of its own.
    own : int
        The tile's number.

    Returns
    -------
    dict of arrays
        ``component``, ``lift``, (n,): for each row of the tile; joined over sides within the tile. For each component
        ``least``, (c, 2): its first feature and row, ``faces``, ``sides``, ``vertices`` and ``turns``. For the sides to
        other tiles ``border``, (b, 4): component, other tile, other row, and the number of turns that lift it against
        the component.
    """
    is_own = rows.tile == own
    cells = _core.glue_own(rows.core, is_own.astype(np.int8), 1)
    turns, lift = _core.turns_of(cells)
    components = cells.components
    component, face, twin = cells.component, cells.face, cells.twin
    of_side = component[face]
    inside = of_side >= 0
    mine = np.flatnonzero(is_own)
    number = component[mine]
    # the first side of a vertex counts it
    _, first = np.unique(cells.vertex, return_index=True)
    counting = first[is_own[face[first]]]
    out = np.flatnonzero(inside & ~is_own[face[np.where(inside, twin, 0)]])
    other = face[twin[out]]
    rise = lift[face[out]] + _leaves(cells, rows, out) - _leaves(cells, rows, twin[out])
    border = np.stack([of_side[out], rows.tile[other], rows.row[other], rise], axis=1)
    least = np.full(components, len(component))
    np.minimum.at(least, number, mine)
    return {
        "component": _in_rows(rows, mine, number),
        "lift": _in_rows(rows, mine, lift[mine]),
        "least": np.stack([rows.feature[least], rows.row[least] - rows.row[_first_of(rows, least)]], axis=1),
        "faces": np.bincount(number, minlength=components),
        "sides": np.bincount(of_side[inside], minlength=components),
        "vertices": np.bincount(component[face[counting]], minlength=components),
        "turns": turns.astype(np.int64),
        "border": np.unique(border, axis=0).astype(np.int64),
    }


def _leaves(cells: _core.CellComplex, rows: Rows, sides: NDArray[Any]) -> NDArray[np.int64]:
    """Flags, 1 for sides that lead over theta = 3 pi / 2."""
    twins, chart = cells.twin[sides], rows.core.trapezoids.chart
    ends = (cells.side[sides] == LAST) & (chart[cells.face[sides]] == 1)
    begins = (cells.side[twins] == FIRST) & (chart[cells.face[twins]] == 0)
    return np.asarray(ends & begins, np.int64)


def _first_of(rows: Rows, which: NDArray[np.int64]) -> NDArray[np.int64]:
    """First rows of the features of some rows."""
    return np.asarray(np.searchsorted(rows.feature, rows.feature[which]), np.int64)


def _in_rows(rows: Rows, mine: NDArray[np.int64], values: NDArray[np.int32]) -> NDArray[np.int32]:
    """Values of the tile's own trapezoids, by their rows in its shard."""
    result = np.empty(len(mine), np.int32)
    result[rows.row[mine]] = values
    return result
