"""A field of stones, small enough for many tiles to be quick."""

from __future__ import annotations

import random

import cfree
from cfree import Curved

ROBOT = [(0, 0), (2, 0), (0, 1)]


def stones(count: int, seed: int = 0) -> list[list[tuple[int, int]]]:
    rng = random.Random(seed)
    return [
        [(10 * x, 10 * y), (10 * x + rng.randint(2, 9), 10 * y + 1), (10 * x + 1, 10 * y + rng.randint(3, 9))]
        for x in range(count)
        for y in range(count)
    ]


def pebbles(count: int, seed: int = 0) -> list[Curved]:
    """The stones with round corners, every other one as a disc."""
    rings = stones(count, seed)
    return [Curved(ring, grown="1/4") if k % 2 else Curved.circle(ring[0], 2) for k, ring in enumerate(rings)]


ROUND_ROBOT = Curved(ROBOT, grown="1/4")
SCENE = cfree.Scene(ROBOT, stones(4), bounds=(-9, -9, 49, 49), start=(-5, -5, 0), goal=(45, 45, "90deg"))
