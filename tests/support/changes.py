"""Random scenes, and random changes of them: obstacles that touch, coincide and share lines among them."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from typing import Any

from cfree.errors import InvalidPolygonError
from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene


def box(x: float, y: float, width: float, height: float) -> Polygon:
    """Return a rectangle, of which a corner and the size are given."""
    x0, y0 = Fraction(x), Fraction(y)
    x1, y1 = x0 + Fraction(width), y0 + Fraction(height)
    return Polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


BAR = box(0, 0, 2, 1)
ROBOTS = [
    [BAR],
    [Polygon([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)])],
    [box(0, 0, 1, 1), box(2, 0, 1, 1)],
    [Polygon([("1/2", 0), (2, 0), (0, 1)])],
]


def random_scene(generator: random.Random) -> tuple[Scene, int, int]:
    """Return a scene, its size, and the denominator of its coordinates."""
    size, digits = generator.choice([8, 15, 30]), generator.choice([1, 2, 10, 100])
    obstacles = [_shape(generator, size, digits) for _ in range(generator.randint(1, 14))]
    rooms: list[dict[str, Any]] = [
        {},
        {"bounds": (-1, -1, size + 1, size + 3)},
        {"workspace": box(-2, -2, size + 6, size + 6)},
    ]
    return Scene(generator.choice(ROBOTS), obstacles, **generator.choice(rooms)), size, digits


def changed(generator: random.Random, scene: Scene, size: int, digits: int) -> Scene:
    """Return a scene with an obstacle more, less or moved, or with its obstacles in another order."""

    def length() -> Fraction:
        if generator.random() < 0.5:
            return Fraction(generator.randint(-2, 2))
        parts = digits if generator.random() < 0.5 else generator.choice([3, 8, 10, 1000, 10**9, 10**6 + 3, 2**40])
        return Fraction(round(generator.uniform(-3, 3) * parts), parts)

    count, kind = len(scene.obstacles), generator.random()
    if kind < 0.2 or not count:
        again = count and generator.random() < 0.3
        return scene.with_obstacle(generator.choice(scene.obstacles) if again else _shape(generator, size, digits))
    if kind < 0.35:
        return scene.without_obstacle(generator.randrange(count))
    if kind < 0.5:
        obstacles = generator.sample(scene.obstacles, count)
        return Scene(scene.robot, obstacles, bounds=scene.bounds, workspace=scene.workspace)
    turn = generator.choice([0, 0, 0, "90deg", "180deg", "17deg"])
    return scene.moved(generator.randrange(count), (length(), length(), turn))


def _ring(generator: random.Random, size: int, digits: int) -> list[ExactPoint]:
    """Return a ring; on a grid of units many edges are on one line, touch and coincide."""

    def grid(value: float) -> Fraction:
        return Fraction(round(value * digits), digits)

    x, y, kind = generator.uniform(0, size), generator.uniform(0, size), generator.random()
    if kind < 0.6:
        return list(box(int(x), int(y), generator.randint(1, 4), generator.choice([1, 2, 0.125])).exact_vertices)
    if kind < 0.7:
        l_shape = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)]
        return [(grid(x) + a, grid(y) + b) for a, b in l_shape]
    radius, angles = (
        generator.uniform(0.5, 2),
        sorted(generator.uniform(0, math.tau) for _ in range(generator.randint(3, 6))),
    )
    return [(grid(x + radius * math.cos(angle)), grid(y + radius * math.sin(angle))) for angle in angles]


def _shape(generator: random.Random, size: int, digits: int) -> Polygon:
    while True:
        try:
            return Polygon(_ring(generator, size, digits))
        except InvalidPolygonError:
            continue
