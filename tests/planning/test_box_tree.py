"""Boxes that meet others are found by a tree as by comparing all with all."""

from __future__ import annotations

import numpy as np
import pytest

from cfree.planning.box_tree import BoxTree


@pytest.mark.parametrize("count", [0, 1, 15, 16, 17, 300, 5000])
@pytest.mark.parametrize("kind", ["apart", "touching", "one around all"])
def test_boxes_that_meet_are_found(count: int, kind: str) -> None:
    rng = np.random.default_rng(count)
    low = rng.integers(0, 40, (count, 2)).astype(float) if kind == "touching" else rng.uniform(0, 400, (count, 2))
    size = rng.integers(0, 3, (count, 2)) if kind == "touching" else rng.exponential(2, (count, 2))
    if kind == "one around all":
        low[:1], size[:1] = -1, 500
    boxes = np.concatenate([low, low + size], axis=1)
    corners = rng.integers(0, 40, (30, 2)).astype(float)
    asked = np.concatenate([corners, corners + rng.integers(0, 2, (30, 2))], axis=1)
    asked[0] = -np.inf, -np.inf, 2, np.inf
    tree = BoxTree(boxes.tolist(), count)
    for some in (asked[:0], asked[:1], asked):
        meets = (boxes[:, None, :2] <= some[:, 2:]) & (boxes[:, None, 2:] >= some[:, :2])
        assert tree.meeting(some).tolist() == np.flatnonzero(meets.all(axis=2).any(axis=1)).tolist()
