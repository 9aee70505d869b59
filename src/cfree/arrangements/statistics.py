"""Statistics of an arrangement: its cells, counts by kind, and a bound on the number of vertices."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import comb
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.scene.features import SceneFeatures


@dataclass(frozen=True, slots=True)
class DepthCell:
    """A cell of an arrangement.

    Attributes
    ----------
    index : int
    pairs : tuple of (int, int)
        Pairs of a robot polygon and an obstacle whose interiors meet in it; see `Arrangement.sets`.
    euler : int
        Euler characteristic: 1 for a ball, 0 if it surrounds the circle of theta once and has no holes.
    surfaces : int
        Number of closed surfaces that bound it.
    volume : float
        Volume in length^2 radians; infinite for the first cell.
    """

    index: int
    pairs: tuple[tuple[int, int], ...]
    euler: int
    surfaces: int
    volume: float

    @property
    def depth(self) -> int:
        """Number of pairs that overlap."""
        return len(self.pairs)


@dataclass(frozen=True, slots=True)
class ArrangementStatistics:
    """Counts of vertices, edges, faces and cells by kind.

    Attributes
    ----------
    vertices, edges, faces, cells, max_depth : int
    vertices_by_kind, edges_by_kind, faces_by_contact : dict of str to int
    vertices_by_degree, vertices_by_pairs, faces_by_depth, cells_by_depth : dict of int to int
    bounds : dict of str to int
        Greatest possible numbers of vertices, constants included. ``"surfaces"``: k patches have 4 for each three, 2
        for each of their helices with each patch, 1 for each of their edge-edge segments with each patch, and 4 corners
        each.
    """

    vertices: int
    edges: int
    faces: int
    cells: int
    max_depth: int
    vertices_by_kind: dict[str, int] = field(hash=False)
    vertices_by_degree: dict[int, int] = field(hash=False)
    vertices_by_pairs: dict[int, int] = field(hash=False)
    edges_by_kind: dict[str, int] = field(hash=False)
    faces_by_contact: dict[str, int] = field(hash=False)
    faces_by_depth: dict[int, int] = field(hash=False)
    cells_by_depth: dict[int, int] = field(hash=False)
    bounds: dict[str, int] = field(hash=False)


def counted(values: NDArray[Any], names: Sequence[str] = ()) -> Any:
    """Count each value, by name if there are names; without names, only values that occur are listed.

    Examples
    --------
    >>> counted(np.array([3, 1, 3])), counted(np.array([1, 1]), ("left", "right"))
    ({1: 1, 3: 2}, {'left': 0, 'right': 2})
    """
    count = np.bincount(values, minlength=len(names)).tolist()
    return {names[k] if names else k: n for k, n in enumerate(count) if names or n}


def vertex_bounds(features: SceneFeatures) -> dict[str, int]:
    """Bounds on the number of vertices; see `ArrangementStatistics.bounds`."""
    k = features.patches
    return {"surfaces": 4 * comb(k, 3) + 6 * k * k + 4 * k}


def pseudo_vertex_bound(surfaces: int) -> int:
    """Greatest possible number of poses on three of this many surfaces, if these meet in points."""
    return 4 * comb(surfaces, 3)
