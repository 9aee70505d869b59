"""A boundary in the files of a folder, and questions to it that read only what they need."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.distributed.shard import VERSION, read_json, read_shard
from cfree.distributed.tasks import TRIMMED, Work
from cfree.errors import FormatError
from cfree.scene.scene import Scene
from cfree.value import Value

Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Surfaces:
    """Closed surfaces, numbered by their first trapezoid.

    Attributes
    ----------
    faces, euler, turns, parent, cell_of : (n,) int64
        As in `cfree.FreeSpace` and `cfree.CellComplex`.
    free_inside : (n,) bool
    """

    faces: Ints
    euler: Ints
    turns: Ints
    parent: Ints
    free_inside: NDArray[np.bool_]
    cell_of: Ints

    def __len__(self) -> int:
        return len(self.faces)


class Sharded(Value):
    """A boundary whose trapezoids are in the files of a folder; see `boundary`.

    Parameters
    ----------
    folder : path

    Attributes
    ----------
    tiles, obstacles, vertices, trapezoids, cells : int
        How many there are.
    digest : str
        Of all trapezoids: the same for any tiles, any number of workers, and any order.

    Raises
    ------
    FormatError
        If there is no boundary in the folder, or it is not finished.
    """

    @checked
    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)
        self.manifest = _manifest(self.folder)
        self.tiles, self.obstacles, self.vertices, self.trapezoids, self.cells = (
            int(self.manifest[name]) for name in ("tiles", "obstacles", "vertices", "trapezoids", "cells")
        )
        self.digest = str(self.manifest["digest"])

    @property
    def _content(self) -> tuple[Any, ...]:
        return tuple(sorted(self.manifest.items()))

    def __reduce__(self) -> tuple[Any, ...]:
        return Sharded, (self.folder,)

    def __repr__(self) -> str:
        return (
            f"Sharded({os.fspath(self.folder)!r}, {self.vertices:,} vertices, {self.trapezoids:,} trapezoids "
            f"in {self.tiles:,} tiles, {self.cells:,} cells)"
        )

    @cached_property
    def work(self) -> Work:
        return Work(self.folder)

    @cached_property
    def head(self) -> Scene:
        """The scene without its obstacles."""
        return self.work.store.head

    @cached_property
    def surfaces(self) -> Surfaces:
        """The closed surfaces, and how they are nested."""
        table = read_shard(self.folder / "cells.npz", self.manifest["key"])
        return Surfaces(**{name: table[name] for name in Surfaces.__annotations__})

    @checked
    def tile(self, number: int) -> dict[str, NDArray[Any]]:
        """The trapezoids of a tile, as `docs/shards.md` describes them."""
        return self.work.shard(TRIMMED, range(self.tiles)[number])


def _manifest(folder: Path) -> dict[str, Any]:
    path = folder / "manifest.json"
    if not path.exists():
        what = "is not finished; run it again" if (folder / "plan.json").exists() else "there is no boundary in it"
        raise FormatError(f"{folder}: {what}: cfree boundary SCENE --folder {folder}", path=str(folder))
    manifest = read_json(path)
    if manifest.get("version") != VERSION:
        raise FormatError(f"{path}: version {manifest.get('version')}; this cfree reads {VERSION}", path=str(path))
    return manifest
