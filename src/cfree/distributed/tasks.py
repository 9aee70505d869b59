"""Tasks for one tile at a time, in this process or in any other that shares the folder.

A task writes one file and can be repeated at any time: a file that is there, sound, and of the same source, is kept.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.distributed.division import FILES, Division, Features
from cfree.distributed.exact_sums import exact_sums
from cfree.distributed.glue import glue_tile
from cfree.distributed.joining import JoinedSurfaces
from cfree.distributed.nesting import Answer, Question, TileLines, answered
from cfree.distributed.part import Part
from cfree.distributed.round_nesting import RoundAnswer, RoundQuestion, RoundTileLines
from cfree.distributed.rows import Rows, gathered
from cfree.distributed.shard import Shard, changed, key_of, read_json, read_shard, write_shard
from cfree.distributed.store import STORED, SceneStore
from cfree.distributed.tiles import BoxIndex
from cfree.distributed.trim import digest, trim_tile
from cfree.errors import FormatError

LISTS = 64  # lists of obstacles kept in memory
TRIMMED, REGULAR, GLUED = "trim", "regular", "glue"


class Work:
    """The folder of one computation, in the form that its tasks use.

    Parameters
    ----------
    folder : path
        It has ``plan.json``: the key of the whole computation.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.plan = read_json(folder / "plan.json")
        self.store = SceneStore(folder / "scene")
        self.store.check()
        self.division = Division.open(folder / "tiles", self.plan["key"])
        self.obstacles = lru_cache(maxsize=LISTS)(lambda tile: self.division.listed("obstacles", tile))

    @property
    def stamp(self) -> str:
        """Text that changes when more is known about all obstacles."""
        return stamp_of(self.folder)

    def path(self, stage: str, tile: int) -> Path:
        return self.folder / stage / f"{tile:06d}.npz"

    def key(self, stage: str, tile: int) -> str:
        """Key of the source of a shard."""
        return key_of(self.plan["key"], stage, tile)

    def shard(self, stage: str, tile: int) -> Shard:
        return read_shard(self.path(stage, tile), self.key(stage, tile))

    def make(self, stage: str, tile: int, compute: Callable[[], Shard]) -> Shard:
        """Return the existing shard, or else compute and write one."""
        try:
            return self.shard(stage, tile)
        except FormatError:
            shard, path = compute(), self.path(stage, tile)
            path.parent.mkdir(exist_ok=True)
            write_shard(path, shard, self.key(stage, tile))
            return shard

    @property
    def surfaces(self) -> str:
        """The stage whose trapezoids bound cells."""
        return REGULAR if self.plan.get("slits") else TRIMMED

    def rows(
        self,
        tile: int,
        stage: str,
        around: bool,
        obstacles: NDArray[np.int64] | None = None,
        share_names: bool = True,
    ) -> Rows:
        """Trapezoids of a tile, and those of features within reach of its own; other arguments as in `gathered`."""
        if not around:
            shard = self.shard(stage, tile)
            all_of_it = [(tile, shard, np.ones(len(shard["feature"]), bool))]
            return gathered(self.store, all_of_it, obstacles, share_names)
        features = Features(self.store)
        own = features.boxes(self.division.listed("features", tile))
        shards = []
        for other in self.division.listed("neighbours", tile).tolist():
            shard = self.shard(stage, other)
            chosen = np.full(len(shard["feature"]), other == tile)
            if other != tile:
                chosen[BoxIndex(features.boxes(shard["feature"])).near(own, self.store.reach)] = True
            shards.append((other, shard, chosen))
        return gathered(self.store, shards, obstacles, share_names)


def stamp_of(folder: Path) -> str:
    """Text that changes when more is known about all obstacles, or a file that every task needs has changed."""
    facts = [folder / "scene" / "facts.json", folder / "tiles" / "division.npz"]
    files = [*facts, *(folder / "scene" / name for name in STORED), *(folder / "tiles" / name for name in FILES)]
    return json.dumps([read_json(folder / "plan.json"), *map(changed, files)])


@lru_cache(maxsize=2)
def opened(folder: str, stamp: str) -> Work:
    """Work in a folder; `stamp` changes with the facts known about it."""
    return Work(Path(folder))


def trim_task(folder: str, stamp: str, tile: int, regularized: bool = False) -> dict[str, Any]:
    """Trim a tile's patches.

    Returns
    -------
    dict
        ``trapezoids``: their number; ``digest``; ``slits``: True if surfaces may coincide with opposite sides.
    """
    work = opened(folder, stamp)
    stage = REGULAR if regularized else TRIMMED

    def compute() -> Shard:
        own = work.division.listed("features", tile)
        part = Part(work.store, work.division.listed("obstacles", tile))
        shard = trim_tile(part, np.sort(own), regularized)
        total = digest(shard).to_bytes(32, "big")
        slits = _core.may_have_slits(part.features.core)
        return shard | {"digest": np.frombuffer(total, np.uint8), "slits": np.array([slits])}

    shard = work.make(stage, tile, compute)
    return {
        "trapezoids": len(shard["kind"]),
        "digest": shard["digest"].tobytes().hex(),
        "slits": bool(shard["slits"][0]),
    }


def glue_task(folder: str, stamp: str, tile: int) -> int:
    """Glue a tile's trapezoids to each other and to those around them; return the number of its components."""
    work = opened(folder, stamp)
    glued = work.make(GLUED, tile, lambda: glue_tile(work.rows(tile, work.surfaces, around=True), tile))
    return len(glued["faces"])


def nest_task(folder: str, stamp: str, tile: int, surface: np.ndarray[Any, Any], asked: list[Question]) -> list[Answer]:
    """Answer queries for crossings in a tile; `surface` is that of each component."""
    work = opened(folder, stamp)
    component = work.shard(GLUED, tile)["component"]
    lines = TileLines(work.rows(tile, work.surfaces, around=False).core, surface[component])
    scale = float(work.store.rest.scale)
    return [answered(lines, tile, question, work.division.boxes, scale) for question in asked]


def nest_round_task(
    folder: str, stamp: str, tile: int, surface: np.ndarray[Any, Any], asked: list[RoundQuestion]
) -> list[RoundAnswer]:
    """Answer queries for the surfaces around poses among round shapes in a tile; `surface` is that of components."""
    work = opened(folder, stamp)
    component = work.shard(GLUED, tile)["component"]
    rows = work.rows(tile, work.surfaces, around=False)
    lines = RoundTileLines(rows.core, surface[component[rows.row]])
    return [lines.answered(question) for question in asked]


def measure_task(
    folder: str, stamp: str, tile: int, surface: np.ndarray[Any, Any], origins: np.ndarray[Any, Any]
) -> dict[int, tuple[Fraction, Fraction, bool]]:
    """Share of a tile in the volumes of surfaces, estimates of the errors, and True if more than obstacles bound them.

    `surface` is that of each component, `origins` are the origins of the volumes, by surface.
    """
    work = opened(folder, stamp)
    rows = work.rows(tile, work.surfaces, around=False, share_names=False)  # same doubles for any tiling
    surface_of = surface[work.shard(GLUED, tile)["component"]]
    surfaces, known = np.unique(surface_of, return_inverse=True)
    known = known.reshape(-1)
    values, errors = _core.fluxes(rows.core, np.ascontiguousarray(origins[known]))
    foreign = np.zeros(len(surfaces), bool)
    foreign[known[rows.feature >= work.store.vertices]] = True
    sums = (exact_sums(column, known, len(surfaces)) for column in (values, errors))
    return dict(zip(surfaces.tolist(), zip(*sums, foreign.tolist(), strict=True), strict=True))


def surfaces_in(joined: JoinedSurfaces, tile: int) -> np.ndarray[Any, Any]:
    """Closed surfaces of the components of a tile."""
    return joined.surface[joined.first[tile] : joined.first[tile + 1]]
