"""The patches of one tile, trimmed by all obstacles near it."""

from __future__ import annotations

import hashlib

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.distributed.part import Part
from cfree.distributed.shard import Shard
from cfree.forbidden.columns import CODED

ENDS = ("from", "to")
MODULUS = 1 << 256


def trim_tile(part: Part, own: NDArray[np.int64], regularized: bool = False) -> Shard:
    """Trapezoids of the patches of some features: vertices of obstacles, and the edges that start there.

    Parameters
    ----------
    part : Part
        Features with all obstacles near them.
    own : (n,) int64
        Numbers of the vertices among all, in order.

    Returns
    -------
    dict of arrays
        ``feature``, (n,): `own`. ``start``, (n + 1,): rows of feature k are start[k] to start[k + 1] - 1. ``keys``,
        (k, 4): features as in `Part.keys`. For each angle ``angle_keys``, (a, 2), ``angle_tau``, (a, 2), and
        ``angle_place``. For each row ``kind`` and ``robot`` of its contact, ``chart``, the keys ``lower`` and
        ``upper``, and the angles ``from`` and ``to``.
    """
    features = part.local(own)
    core = _core.compute_boundary(part.features.core, 1, regularized, lambda share: True, features=features.tolist())
    rows, patches = core.trapezoids, core.patches
    codes = np.concatenate([getattr(rows, name) for name in CODED])
    distinct, number = np.unique(codes, return_inverse=True)
    keys = part.keys(distinct)
    order = np.lexsort(keys.T[::-1])  # by content: the same in any part
    rank = np.empty(len(order), np.uint32)
    rank[order] = np.arange(len(order), dtype=np.uint32)
    named = dict(zip(CODED, rank[number].reshape(len(CODED), -1), strict=True))
    ends = {name: np.concatenate([named[f"{end}_{name}"] for end in ENDS]) for name in ("first", "second")}
    for name in ("lo", "hi", "place"):
        ends[name] = np.concatenate([getattr(rows, f"{end}_{name}") for end in ENDS])
    by_angle = np.lexsort(list(ends.values()))
    is_new = np.zeros(len(by_angle), bool)
    is_new[:1] = True
    for column in ends.values():
        is_new[1:] |= column[by_angle[1:]] != column[by_angle[:-1]]
    number_of = np.empty(len(by_angle), np.uint32)
    number_of[by_angle] = np.cumsum(is_new) - 1
    angles = {name: column[by_angle[is_new]] for name, column in ends.items()}
    first_angle, last_angle = number_of.reshape(2, -1)
    obstacle = part.vertices[patches.obstacle[rows.patch]]
    return {
        "feature": own,
        "start": np.append(np.searchsorted(obstacle, own), len(obstacle)).astype(np.int64),
        "keys": keys[order],
        "angle_keys": np.stack([angles["first"], angles["second"]], axis=1),
        "angle_tau": np.stack([angles["lo"], angles["hi"]], axis=1),
        "angle_place": angles["place"],
        "kind": patches.kind[rows.patch],
        "robot": patches.robot[rows.patch],
        "chart": rows.chart,
        "lower": named["lower"],
        "upper": named["upper"],
        "from": first_angle,
        "to": last_angle,
    }


def digest(shard: Shard) -> int:
    """Sum over features, mod 2^256, of the SHA-256 of their rows: the same for any division into tiles.

    Rows are taken as integers of 64 bits, least byte first: feature; kind, robot, chart; the keys of both curves; for
    both angles the two keys, the bits of both ends, and the place.
    """
    keys = shard["keys"].astype("<i8")
    angles = np.concatenate(
        [
            keys[shard["angle_keys"]].reshape(-1, 8),
            shard["angle_tau"].astype("<f8").view("<i8").reshape(-1, 2),
            shard["angle_place"].astype("<i8")[:, None],
        ],
        axis=1,
    )
    counts = np.diff(shard["start"])
    rows = np.concatenate(
        [
            np.repeat(shard["feature"], counts)[:, None],
            *(shard[name].astype("<i8")[:, None] for name in ("kind", "robot", "chart")),
            *(keys[shard[name]] for name in ("lower", "upper")),
            *(angles[shard[name]] for name in ENDS),
        ],
        axis=1,
    ).astype("<i8")
    total, text, width = 0, np.ascontiguousarray(rows).tobytes(), 8 * rows.shape[1]
    for i, j in zip(shard["start"][:-1].tolist(), shard["start"][1:].tolist(), strict=True):
        if i < j:
            total += int.from_bytes(hashlib.sha256(text[width * i : width * j]).digest(), "big")
    return total % MODULUS
