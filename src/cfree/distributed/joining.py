"""Components of tiles joined over the borders into closed surfaces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import gcd

import numpy as np
from numpy.typing import NDArray

from cfree.distributed.shard import Shard
from cfree.errors import InvariantError

Ints = NDArray[np.int64]


@dataclass
class JoinedSurfaces:
    """Closed surfaces, numbered by their first trapezoid.

    Attributes
    ----------
    first : (tiles + 1,) int64
        Components of tile k are first[k] to first[k + 1] - 1.
    surface, lift : (components,) int64
        For each component its surface, and the number of turns by which it is lifted against the first one.
    lead : (surfaces,) int64
        For each surface the feature of its first trapezoid.
    faces, euler, turns : (surfaces,) int64
    """

    first: Ints
    surface: Ints
    lift: Ints
    lead: Ints
    faces: Ints
    euler: Ints
    turns: Ints

    def __len__(self) -> int:
        return len(self.faces)


def join(tiles: int, glued: Callable[[int], Shard]) -> JoinedSurfaces:
    """Join the results of `glue_tile`.

    Parameters
    ----------
    tiles : int
    glued : callable
        Function that returns the shard of a tile, called for one after the other, and for those around it.
    """
    tables: list[Shard] = []
    for tile in range(tiles):
        shard = glued(tile)
        tables.append({name: shard[name] for name in ("least", "faces", "sides", "vertices", "turns")})
    first = np.cumsum([0, *(len(table["faces"]) for table in tables)])
    total = {name: np.concatenate([t[name] for t in tables]) for name in tables[0]} if tables else {}
    forest = _Forest(int(first[-1]))
    for tile in range(tiles):
        border = glued(tile)["border"]
        for other in np.unique(border[:, 1]).tolist():
            there = glued(other)
            rows = border[border[:, 1] == other]
            ends = first[other] + there["component"][rows[:, 2]]
            rise = rows[:, 3] - there["lift"][rows[:, 2]]
            for link in np.unique(np.stack([first[tile] + rows[:, 0], ends, rise], axis=1), axis=0).tolist():
                forest.join(*link)
    roots, lift = forest.settled()
    if not len(roots):
        nothing = np.zeros(0, np.int64)
        return JoinedSurfaces(first, nothing, nothing, nothing, nothing, nothing, nothing)
    order = np.lexsort(total["least"].T[::-1])
    leaders: dict[int, int] = {}
    for component in order.tolist():
        leaders.setdefault(int(roots[component]), component)
    number = {root: k for k, root in enumerate(leaders)}
    surface = np.array([number[root] for root in roots.tolist()])
    lead = np.array(list(leaders.values()))
    turns = np.zeros(len(leaders), np.int64)
    np.gcd.at(turns, surface, total["turns"])
    for root, divisor in forest.divisors.items():
        k = number[int(roots[root])]
        turns[k] = gcd(int(turns[k]), divisor)
    counts = {name: np.zeros(len(leaders), np.int64) for name in ("faces", "sides", "vertices")}
    for name, count in counts.items():
        np.add.at(count, surface, total[name])
    euler = counts["vertices"] - counts["sides"] // 2 + counts["faces"]
    if np.any(counts["sides"] % 2) or np.any(euler % 2) or np.any(euler > 2):
        raise InvariantError(f"Euler numbers {euler.tolist()}; those of closed surfaces are even and at most 2")
    features = total["least"][lead, 0]
    return JoinedSurfaces(first, surface, lift - lift[lead[surface]], features, counts["faces"], euler, turns)


class _Forest:
    """Sets of components, each with its lift against the root of its set."""

    def __init__(self, count: int) -> None:
        self.parent = list(range(count))
        self.lift = [0] * count
        self.divisors: dict[int, int] = {}  # for roots, the number of turns of their loops

    def find(self, x: int) -> tuple[int, int]:
        path = []
        while self.parent[x] != x:
            path.append(x)
            x = self.parent[x]
        total = 0
        for y in reversed(path):
            total += self.lift[y]
            self.parent[y], self.lift[y] = x, total
        return x, total

    def join(self, one: int, other: int, rise: int) -> None:
        """Join two sets; `other` is lifted by `rise` against `one`."""
        (a, p), (b, q) = self.find(one), self.find(other)
        if a == b:
            if p + rise != q:
                self.divisors[a] = gcd(self.divisors.get(a, 0), p + rise - q)
            return
        self.parent[b], self.lift[b] = a, p + rise - q
        if b in self.divisors:
            self.divisors[a] = gcd(self.divisors.get(a, 0), self.divisors.pop(b))

    def settled(self) -> tuple[Ints, Ints]:
        pairs = [self.find(x) for x in range(len(self.parent))]
        roots, lifts = np.array(pairs, np.int64).reshape(-1, 2).T
        return roots, lifts
