"""The search's turns beside the surfaces around two poses: how much it may guess."""

from __future__ import annotations

import math
import random

import pytest

from cfree import Path, Planner, PoseChecker, Scene

Place = tuple[float, float, float]


def wiggly(rng: random.Random, vertices: int = 68) -> list[tuple[float, float]]:
    """A ring of many vertices, each visible from the middle."""
    size, flat, waves, phase = rng.uniform(0.8, 1.3), rng.uniform(0.35, 1), rng.choice((2, 3)), rng.uniform(0, 6)
    angles = sorted(rng.uniform(0, math.tau) for _ in range(vertices))
    radii = [size * (1 + 0.25 * math.sin(waves * a + phase)) * (1 + 0.02 * rng.gauss(0, 1)) for a in angles]
    return [(round(r * math.cos(a), 4), round(flat * r * math.sin(a), 4)) for r, a in zip(radii, angles, strict=True)]


def crowd(seed: int, cell: float = 3.7, side: int = 11) -> tuple[Scene, list[tuple[Place, Place]]]:
    """Many such rings among which another one is moved, 8,228 vertices in all, and questions."""
    rng = random.Random(seed)
    rings = []
    for i in range(side):
        for j in range(side):
            turn = rng.uniform(0, math.tau)
            c, s = math.cos(turn), math.sin(turn)
            x, y = cell * i + rng.uniform(-0.3, 0.3), cell * j + rng.uniform(-0.3, 0.3)
            rings.append([(round(x + c * u - s * v, 4), round(y + s * u + c * v, 4)) for u, v in wiggly(rng)])
    edge = cell * (side - 1)
    scene = Scene(wiggly(rng), rings, bounds=(-2, -2, edge + 2, edge + 2))
    checker = PoseChecker(scene)

    def free() -> Place:
        while True:
            pose = rng.uniform(0, edge), rng.uniform(0, edge), rng.uniform(0, math.tau)
            if checker.is_free(pose):
                return pose

    return scene, [(free(), free()) for _ in range(4)]


@pytest.mark.slow
def test_a_robot_of_many_vertices_is_searched_for_as_long_as_its_patches_take() -> None:
    """Ways along surfaces have 600 and 800 motions; the search finds these paths after 40,000 guesses and more."""
    scene, asked = crowd(1)
    for start, goal in asked[2:]:
        path = Planner(scene).plan(start, goal, improve=0)
        assert isinstance(path, Path) and len(path) < 100
