"""What the process that asks holds of a scene: a few numbers a vertex, and no obstacles."""

from __future__ import annotations

import tracemalloc
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from cfree import Polygon, Scene
from cfree.distributed.division import divide_scene
from cfree.distributed.store import store_scene
from stones import ROBOT

CORNERS = np.array([(0, 0), (3, -1), (6, 0), (7, 3), (6, 6), (3, 7), (0, 6), (-1, 3)])


def obstacles(count: int) -> Iterator[Polygon]:
    return (Polygon(CORNERS + np.array([20 * (k % 50), 20 * (k // 50)])) for k in range(count))


def most_held(count: int, folder: Path) -> tuple[int, int]:
    """In bytes, while obstacles are stored, and while they are divided."""
    tracemalloc.start()
    try:
        store = store_scene(Scene(ROBOT), obstacles(count), folder / "scene")
        stored = tracemalloc.get_traced_memory()[1]
        assert store.reach > 0  # read once, with room for the longest of files
        tracemalloc.reset_peak()
        divide_scene(store, count // 100, folder / "tiles", "key")
        return stored, tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.slow
def test_obstacles_are_not_held(tmp_path: Path) -> None:
    few, many = 1_100, 2_500  # both more than is written at a time
    most_held(few, tmp_path / "first")
    (stored, divided), (stored_of_many, divided_of_many) = (
        most_held(count, tmp_path / str(count)) for count in (few, many)
    )
    vertices = len(CORNERS) * (many - few)
    assert (stored_of_many - stored) / vertices < 50
    assert (divided_of_many - divided) / vertices < 200
