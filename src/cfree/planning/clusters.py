"""Vertices of a cell complex that doubles do not tell apart, as candidates for places where cells meet."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cfree.forbidden.columns import Floats, Ints


def clusters(points: Floats, near: float) -> list[Ints]:
    """Points in groups of two or more; any two that differ by at most `near` in every coordinate are in one group.

    Notes
    -----
    By gaps in one sorted coordinate after another, in O(n log n) time for each of them. A group may be longer than
    `near`: nothing is decided here.

    Examples
    --------
    >>> clusters(np.array([[0.0, 1], [5, 1], [1e-12, 1], [0, 2]]), 1e-9)
    [array([0, 2], dtype=int32)]
    """
    label = np.zeros(len(points), np.int64)
    for column in points.T:
        order = np.lexsort((column, label))
        value, group = column[order], label[order]
        starts: NDArray[np.bool_] = np.r_[True, (np.diff(value) > near) | (np.diff(group) != 0)][: len(order)]
        label[order] = np.cumsum(starts)
    order = np.argsort(label, kind="stable")
    groups = np.split(order, np.flatnonzero(np.diff(label[order])) + 1)
    return [group.astype(np.int32) for group in groups if len(group) > 1]
