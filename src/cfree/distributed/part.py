"""A part of a scene: some obstacles, with the numbers of their vertices among all."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from cfree.distributed.store import SceneStore
from cfree.scene.features import SceneFeatures, unpacked

Ints = NDArray[np.int64]
Codes = NDArray[np.uint64]
NO_EDGE = -1
ON_VERTEX = (2, 3)  # kinds of features whose obstacle feature is a vertex: e-v and v-v


class Part:
    """Features of some obstacles, and of workspace and bounds, whose vertices come after those of all obstacles.

    Parameters
    ----------
    store : SceneStore
    numbers : (n,) int64
        Numbers of the obstacles, in order.
    """

    def __init__(self, store: SceneStore, numbers: Ints) -> None:
        self.store, self.numbers = store, numbers
        self.polygons = store.polygons(numbers)
        self.features: SceneFeatures = store.features(self.polygons)

    @cached_property
    def vertices(self) -> Ints:
        """Numbers of the part's vertices among all."""
        first = self.store.column("first")
        own = [first[k] + np.arange(len(polygon)) for k, polygon in zip(self.numbers, self.polygons, strict=True)]
        count = sum(map(len, own))
        rest = np.arange(len(self.features.obstacles.core.point) - count) + self.store.vertices
        return np.concatenate([*own, rest]).astype(np.int64)

    @cached_property
    def edges(self) -> NDArray[np.int64]:
        """Numbers of the ends of each edge among all, (e, 2)."""
        obstacles = self.features.obstacles
        return np.stack([self.vertices[obstacles.v], self.vertices[obstacles.w]], axis=1)

    def local(self, vertices: Ints) -> NDArray[np.int32]:
        """Numbers in the part of vertices numbered among all."""
        place = np.searchsorted(self.vertices, vertices)
        if np.any(self.vertices[np.minimum(place, len(self.vertices) - 1)] != vertices):
            raise KeyError("a vertex that is not in this part")
        return place.astype(np.int32)

    def keys(self, codes: Codes) -> NDArray[np.int64]:
        """Keys of features common to all parts, (n, 4): kind, robot's feature, obstacle's vertex, or its edge's ends.

        Instead of the second end of an edge, a vertex has `NO_EDGE`; no feature is four zeros.
        """
        kind, robot, obstacle = (part.astype(np.int64) for part in unpacked(codes))
        on_vertex = np.isin(kind, ON_VERTEX)
        keys = np.zeros((len(codes), 4), np.int64)
        keys[:, 0], keys[:, 1] = kind, robot
        keys[on_vertex, 2] = self.vertices[obstacle[on_vertex]]
        keys[on_vertex, 3] = NO_EDGE
        keys[~on_vertex, 2:] = self.edges[obstacle[~on_vertex]]
        keys[kind == 0] = 0
        return keys

    def codes(self, keys: NDArray[np.int64]) -> Codes:
        """Codes of the core for the same features, by the numbers of this part."""
        kind, robot, v, w = keys.T
        obstacle = np.zeros(len(keys), np.int64)
        there, on_vertex = kind != 0, np.isin(kind, ON_VERTEX)
        obstacle[on_vertex] = self.local(v[on_vertex])
        on_edge = there & ~on_vertex
        obstacle[on_edge] = self._edge_numbers(v[on_edge], w[on_edge])
        packed = kind.astype(np.uint64) << np.uint64(61) | robot.astype(np.uint64) << np.uint64(31)
        return np.where(there, packed | obstacle.astype(np.uint64), 0).astype(np.uint64)

    def _edge_numbers(self, v: Ints, w: Ints) -> Ints:
        """Edges of the part by their ends."""
        keys = self._edge_keys(self.local(v), self.local(w))
        order, sorted_keys = self._edges_by_ends
        place = np.minimum(np.searchsorted(sorted_keys, keys), len(order) - 1)
        if np.any(sorted_keys[place] != keys):
            raise KeyError("an edge that is not in this part")
        return order[place]

    @cached_property
    def _edges_by_ends(self) -> tuple[Ints, Ints]:
        keys = self._edge_keys(self.features.obstacles.v, self.features.obstacles.w)
        order = np.argsort(keys)
        return order, keys[order]

    def _edge_keys(self, v: NDArray[np.int32], w: NDArray[np.int32]) -> Ints:
        """One number for both ends, by their numbers in the part."""
        return v.astype(np.int64) * len(self.vertices) + w
