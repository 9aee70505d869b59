"""Cell complexes glued in another way: wrong partners, wrong labels of vertices."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from cfree.forbidden.cell_complex import CellComplex


def classes(count: int, pairs: NDArray[np.int64]) -> NDArray[np.int32]:
    """Number of the class of each element, joined by pairs."""
    least = np.arange(count)
    while True:
        low = np.minimum(least[pairs[:, 0]], least[pairs[:, 1]])
        before = least.copy()
        np.minimum.at(least, pairs[:, 0], low)
        np.minimum.at(least, pairs[:, 1], low)
        if np.array_equal(before, least):
            return np.unique(least, return_inverse=True)[1].astype(np.int32)


def reglued(cells: CellComplex, twin: NDArray[np.int32]) -> CellComplex:
    """Closed surfaces that other twins make of the same faces."""
    h = np.arange(len(twin))
    before = np.array([cells.before(k) for k in h])
    vertex = classes(len(h), np.stack([h, twin[before]], axis=1))
    component = classes(len(cells.component), np.stack([cells.face, cells.face[twin]], axis=1))
    first = np.unique(vertex, return_index=True)[1]
    places = {name: getattr(cells, name)[cells.vertex[first]] for name in ("x", "y", "theta", "near")}
    counts = {"vertices": len(first), "components": int(component.max()) + 1}
    return replace(cells, twin=twin, vertex=vertex, component=component, **places, **counts)


def exchanged(cells: CellComplex, h: int, other: int) -> NDArray[np.int32]:
    """Twins, those of two coedges exchanged."""
    twin = cells.twin.copy()
    (a, b), (c, d) = (h, twin[h]), (other, twin[other])
    twin[[a, d, c, b]] = d, a, b, c
    return twin
