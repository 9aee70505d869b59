"""A stored scene divided into tiles: the features of each, and the obstacles and tiles near them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cfree.distributed.shard import check_sums, file_sums, read_shard, write_shard
from cfree.distributed.store import SceneStore
from cfree.distributed.tiles import divide, grown_by, merged, near_each
from cfree.scene.features import SceneFeatures

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]
LISTS = ("features", "obstacles", "neighbours")
FILES = tuple(f"{name}.bin" for name in LISTS)


@dataclass(frozen=True)
class Division:
    """Tiles of a scene.

    Attributes
    ----------
    folder : Path
    first : mapping of name to (tiles + 1,) int64
        Beginning of each tile's part of a list: of its features, of the obstacles within reach of them, and of the
        tiles that have features within reach, itself among them.
    boxes : (tiles, 4) float64
        Boxes around the poses of each tile's patches.
    spans : (tiles, 4) float64
        Boxes around all obstacles within reach of a tile's features.
    """

    folder: Path
    first: dict[str, Ints]
    boxes: Floats
    spans: Floats

    def __len__(self) -> int:
        return len(self.boxes)

    def listed(self, name: str, tile: int) -> Ints:
        """A tile's part of one of the lists."""
        begin, end = self.first[name][tile : tile + 2].tolist()
        if begin == end:
            return np.zeros(0, np.int64)
        return np.array(np.memmap(self.folder / f"{name}.bin", np.int64, "r", 8 * begin, (end - begin,)))

    @classmethod
    def open(cls, folder: Path, key: str) -> Division:
        """Open the division that `divide_scene` has written.

        Raises
        ------
        FormatError
            If there is none of that key, or a file of it is damaged; the error names the remedy.
        """
        table = read_shard(folder / "division.npz", key)
        check_sums(folder, dict(zip(FILES, table["sums"].tolist(), strict=True)))
        return cls(folder, {name: table[name] for name in LISTS}, table["boxes"], table["spans"])


class Features:
    """All obstacle features that have patches: vertices of rings, and the edges that start there.

    Those of workspace and bounds are numbered after those of all obstacles.
    """

    def __init__(self, store: SceneStore) -> None:
        rest = store.rest.obstacles
        self._rings, self._emit = len(rest.previous), np.flatnonzero(rest.core.emit)
        self._count = store.vertices
        after = np.empty(self._rings, np.int64)
        after[rest.previous] = np.arange(self._rings)
        self._parts = (
            (store.column("xy"), store.column("next")),
            (rest.xy[: self._rings], after + self._count),
        )
        self._radii = (store.column("radius"), _reach(store.rest, self._rings)) if store.is_round else None

    @property
    def numbers(self) -> Ints:
        """Numbers of all features."""
        return np.concatenate([np.arange(self._count), self._emit + self._count])

    def points(self, numbers: Ints) -> Floats:
        """Vertices, (n, 2), rounded."""
        own = numbers < self._count
        xy = np.empty((len(numbers), 2))
        xy[own], xy[~own] = self._parts[0][0][numbers[own]], self._parts[1][0][numbers[~own] - self._count]
        return xy

    def boxes(self, numbers: Ints) -> Floats:
        """Boxes around the edges that start at vertices, (n, 4), and around their discs."""
        own = numbers < self._count
        after = np.empty(len(numbers), np.int64)
        after[own], after[~own] = self._parts[0][1][numbers[own]], self._parts[1][1][numbers[~own] - self._count]
        a, b = self.points(numbers), self.points(after)
        low, high = np.minimum(a, b), np.maximum(a, b)
        if self._radii is not None:
            reach = np.maximum(self._reach_of(numbers), self._reach_of(after))[:, None]
            low, high = low - reach, high + reach
        return np.concatenate([low, high], axis=1)

    def _reach_of(self, numbers: Ints) -> Floats:
        assert self._radii is not None
        own = numbers < self._count
        reach = np.empty(len(numbers))
        reach[own], reach[~own] = self._radii[0][numbers[own]], self._radii[1][numbers[~own] - self._count]
        return reach


def _reach(rest: SceneFeatures, rings: int) -> Floats:
    """Bounds of the distances of contacts from the vertices of workspace and bounds, which are grown by nothing."""
    reach: Floats = np.nextafter(np.abs(rest.obstacles.radius[:rings]), np.inf)
    return reach


def divide_scene(store: SceneStore, tiles: int, folder: Path, key: str) -> Division:
    """Divide a stored scene into about so many tiles."""
    folder.mkdir(parents=True, exist_ok=True)
    features = Features(store)
    numbers = features.numbers
    number = divide(features.points(numbers), tiles)
    count = int(number.max(initial=-1)) + 1
    order = np.argsort(number, kind="stable")
    sorted_features = numbers[order]
    starts = np.searchsorted(number[order], np.arange(count + 1))
    edges: list[Floats] = []
    boxes, spans = np.empty((count, 4)), np.empty((count, 4))
    box = store.column("box")
    for tile in range(count):
        own = features.boxes(np.sort(sorted_features[starts[tile] : starts[tile + 1]]))
        boxes[tile] = grown_by(np.concatenate([own[:, :2].min(axis=0), own[:, 2:].max(axis=0)]), store.radius)
        edges.append(merged(own))
    obstacles = near_each(edges, box, store.reach)
    for tile, near in enumerate(obstacles):
        spans[tile] = [*box[near, :2].min(axis=0, initial=np.inf), *box[near, 2:].max(axis=0, initial=-np.inf)]
    tile_of = np.repeat(np.arange(count), [len(e) for e in edges])
    around = near_each(edges, np.concatenate([np.zeros((0, 4)), *edges]), store.reach)
    lists = {"obstacles": obstacles, "neighbours": [np.unique(tile_of[near]) for near in around]}
    first = {"features": starts.astype(np.int64)}
    sorted_features.astype(np.int64).tofile(folder / "features.bin")
    for name, parts in lists.items():
        first[name] = np.cumsum([0, *map(len, parts)]).astype(np.int64)
        np.concatenate([np.zeros(0, np.int64), *parts]).astype(np.int64).tofile(folder / f"{name}.bin")
    sums = np.array(list(file_sums(folder / name for name in FILES).values()))
    write_shard(folder / "division.npz", first | {"boxes": boxes, "spans": spans, "sums": sums}, key)
    return Division.open(folder, key)
