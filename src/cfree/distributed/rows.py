"""Rows of shards put together into a boundary of the core."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.distributed.part import NO_EDGE, Part
from cfree.distributed.shard import Shard
from cfree.distributed.store import SceneStore
from cfree.distributed.trim import ENDS
from cfree.forbidden.columns import CODED, COLUMNS

Ints = NDArray[np.int64]


@dataclass
class Rows:
    """Trapezoids of some tiles, in the order of their features.

    Attributes
    ----------
    part : Part
        Features with all obstacles that are named.
    tile, row, feature : (n,) int64
        Tile, row and feature of each trapezoid.
    core : _core.Boundary
    """

    part: Part
    tile: Ints
    row: Ints
    feature: Ints
    core: _core.Boundary


def gathered(
    store: SceneStore,
    shards: Sequence[tuple[int, Shard, NDArray[np.bool_]]],
    obstacles: Ints | None = None,
    share_names: bool = True,
) -> Rows:
    """Trapezoids of shards, each with its tile's number and flags of the features taken; with more obstacles if given.

    Curves have the names of all on their line, as in a boundary that is computed whole. These names depend on the
    obstacles taken, and so do the last digits of doubles at the curves. Names that are not shared are those of the
    shards, which do not. Among round shapes none are shared.
    """
    tables = [_table(tile, shard, chosen) for tile, shard, chosen in shards]
    starts = np.cumsum([0, *(len(shard["keys"]) for _, shard, _ in shards)])
    for table, start in zip(tables, starts, strict=False):
        for name in CODED:
            table[name] = table[name] + start
    columns = {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}
    order = np.lexsort((columns["row"], columns["feature"]))
    columns = {name: column[order] for name, column in columns.items()}
    keys = np.concatenate([shard["keys"] for _, shard, _ in shards])
    used = np.zeros(len(keys), bool)
    for name in CODED:
        used[columns[name]] = True
    named = keys[used]
    vertices = [columns["feature"], named[:, 2], named[named[:, 3] != NO_EDGE, 3]]
    # the vertex after each feature's is of the same obstacle
    numbers = _obstacles_of(store, np.unique(np.concatenate(vertices)))
    part = Part(store, numbers if obstacles is None else np.union1d(numbers, obstacles))
    codes = np.zeros(len(keys), np.uint64)
    own = part.codes(named)
    codes[used] = part.features.core.named(own) if share_names and not store.is_round else own
    contacts = np.stack([part.local(columns["feature"]), columns["kind"], columns["robot"]], axis=1)
    # rows of one patch come one after the other
    is_first = np.append(True, np.any(contacts[1:] != contacts[:-1], axis=1))[: len(contacts)]
    patches = contacts[is_first].astype(np.int32)
    values = columns | {name: codes[columns[name]] for name in CODED}
    values["patch"] = (np.cumsum(is_first) - 1).astype(np.int32)
    trapezoids = _core.Trapezoids(**{name: np.ascontiguousarray(values[name]) for name in COLUMNS})
    listed = _core.Patches(patches[:, 1].astype(np.uint8), patches[:, 2].copy(), patches[:, 0].copy())
    trimmed = np.ones(len(patches), np.uint8)
    core = _core.Boundary(part.features.core, listed, trimmed, trapezoids, _no_parts())
    return Rows(part, columns["tile"], columns["row"], columns["feature"], core)


def _table(tile: int, shard: Shard, chosen: NDArray[np.bool_]) -> Shard:
    """Columns of the rows of some features; curves and angles by the shard's keys."""
    counts = np.diff(shard["start"])
    which = np.flatnonzero(np.repeat(chosen, counts))
    columns = {name: shard[name][which] for name in ("kind", "robot", "chart")}
    columns |= {"tile": np.full(len(which), tile), "row": which, "feature": np.repeat(shard["feature"], counts)[which]}
    columns |= {name: shard[name][which].astype(np.int64) for name in ("lower", "upper")}
    for end in ENDS:
        angle = shard[end][which]
        for k, name in enumerate(("first", "second")):
            columns[f"{end}_{name}"] = shard["angle_keys"][angle, k].astype(np.int64)
        for k, name in enumerate(("lo", "hi")):
            columns[f"{end}_{name}"] = shard["angle_tau"][angle, k]
        columns[f"{end}_place"] = shard["angle_place"][angle]
    return columns


def _obstacles_of(store: SceneStore, vertices: Ints) -> Ints:
    """Obstacles that have some vertices; those of workspace and bounds are in every part."""
    found = np.searchsorted(store.column("first"), vertices[vertices < store.vertices], side="right")
    if store.is_round:
        rest = store.rest.obstacles
        ends = vertices - (store.vertices + len(rest.core.point) - len(rest.owner_of_end))
        own = ends[(ends >= 0) & (ends < store.facts["ends"])]
        found = np.append(found, np.searchsorted(store.column("end"), own, side="right"))
    return np.unique(found - 1).astype(np.int64)


def _no_parts() -> _core.IsolatedParts:
    none = {name: np.zeros(0, np.float64) for name in COLUMNS}
    kinds = {"patch": np.int32, "chart": np.uint8, "from_place": np.uint8, "to_place": np.uint8}
    kinds |= dict.fromkeys(CODED, np.uint64)
    parts = _core.Trapezoids(**{name: none[name].astype(kinds.get(name, np.float64)) for name in COLUMNS})
    patch, t = np.zeros(0, np.int32), np.zeros(0)
    return _core.IsolatedParts(parts, patch, patch, patch, patch, t, t)
