"""A part of a scene: some obstacles, with the numbers of their vertices among all.

Vertices of obstacles come first, then those of workspace and bounds. Among rounded shapes ends of arcs follow, and
points beside them: those of obstacles, then those of the workspace.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from cfree.distributed.store import SceneStore
from cfree.scene.features import SceneFeatures, unpacked

Ints = NDArray[np.int64]
Codes = NDArray[np.uint64]
NO_EDGE = -1
ON_VERTEX = (2, 3, 5)  # kinds of features whose obstacle feature is a vertex: e-v, v-v and ends of quadrants
BRANCH = 8  # factor of a branch beside a kind


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
        self.features: SceneFeatures = store.features(store.shapes(numbers))

    @cached_property
    def vertices(self) -> Ints:
        """Numbers of the part's vertices among all, in order."""
        store, obstacles = self.store, self.features.obstacles
        ends, rest = len(obstacles.owner_of_end), store.rest.obstacles
        rest_ends = len(rest.owner_of_end)
        others = len(rest.core.point) - rest_ends
        own = _runs(store.column("first"), self.numbers, store.vertices)
        known = [own, np.arange(others) + store.vertices]
        if ends:
            begin = store.vertices + others
            known.append(_runs(store.column("end"), self.numbers, store.facts["ends"]) + begin)
            known.append(np.arange(rest_ends) + begin + store.facts["ends"])
        return np.concatenate(known).astype(np.int64)

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

        To the kind eight times the branch is added. Instead of the second end of an edge, a vertex has `NO_EDGE`; no
        feature is four zeros.
        """
        kind, robot, obstacle = (part.astype(np.int64) for part in unpacked(codes))
        on_vertex = np.isin(kind, ON_VERTEX)
        keys = np.zeros((len(codes), 4), np.int64)
        keys[:, 0], keys[:, 1] = kind + BRANCH * branches(codes), robot
        keys[on_vertex, 2] = self.vertices[obstacle[on_vertex]]
        keys[on_vertex, 3] = NO_EDGE
        keys[~on_vertex, 2:] = self.edges[obstacle[~on_vertex]]
        keys[kind == 0] = 0
        return keys

    def codes(self, keys: NDArray[np.int64]) -> Codes:
        """Codes of the core for the same features, by the numbers of this part."""
        (branch, kind), (robot, v, w) = np.divmod(keys[:, 0], BRANCH), keys.T[1:]
        obstacle = np.zeros(len(keys), np.int64)
        there, on_vertex = kind != 0, np.isin(kind, ON_VERTEX)
        obstacle[on_vertex] = self.local(v[on_vertex])
        on_edge = there & ~on_vertex
        obstacle[on_edge] = self._edge_numbers(v[on_edge], w[on_edge])
        packed = kind.astype(np.uint64) << np.uint64(61) | branch.astype(np.uint64) << np.uint64(59)
        packed |= robot.astype(np.uint64) << np.uint64(31)
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


def branches(codes: Codes) -> NDArray[np.int64]:
    """Bits of branches in packed pairs, 0 to 3."""
    return (codes >> np.uint64(59)).astype(np.int64) & 3


def _runs(first: Ints, numbers: Ints, total: int) -> Ints:
    """Numbers of all that some obstacles have, if obstacle k has those from first[k] on, of so many in all."""
    if not len(numbers):
        return np.zeros(0, np.int64)
    ends = np.append(first[1:], total)
    return np.concatenate([np.arange(first[k], ends[k]) for k in numbers])
