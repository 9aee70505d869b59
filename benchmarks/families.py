"""Seeded scenes that grow: a size and a seed always give the same arrays, made without loops over obstacles.

    convex     random convex obstacles at constant density, a kite as the robot (about 4.3 vertices each)
    stars      random star-shaped obstacles at constant density, a kite as the robot
    combs      a row of combs with ever narrower gaps, a hook as the robot
    flats      a building of equal flats: walls with doors, furniture; all axis-parallel, a table as the robot
    warehouse  aisles of racks and round pillars, a rounded robot of 20 vertices
    grid       equal unit squares on the integer grid, some of them touching, a unit square as the robot
    city       blocks around courtyards with a door and four sheds each, streets between them, a car of 8 vertices

Obstacles may overlap or touch. `SIZES` holds the sizes the README of the benchmarks reports.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

KITE = np.array([(-0.9, -0.35), (0.7, -0.55), (1.0, 0.3), (-0.6, 0.6)])
HOOK = np.array([(-1, -4), (2, -4), (2, -2), (1, -2), (1, -3), (0, -3), (0, 2), (-1, 2)]) / 4
SIZES = {
    "convex": (60, 500, 5_000, 25_000),
    "stars": (50, 500, 5_000),
    "combs": (4, 16, 64),
    "flats": (4, 36, 400),
    "warehouse": (100, 1_000, 4_000),
    "grid": (50, 500, 5_000),
    "city": (4, 2_500, 25_000),
}


@dataclass(frozen=True, slots=True)
class SceneArrays:
    """One robot ring and the obstacles' outer rings, counter-clockwise.

    robot : (n, 2) float64; vertices : (N, 2) float64, ring after ring; offsets : (m + 1,) int64, ring k being
    vertices[offsets[k]:offsets[k + 1]].
    """

    robot: Floats
    vertices: Floats
    offsets: NDArray[np.int64]

    def rings(self) -> list[Floats]:
        return np.split(self.vertices, self.offsets[1:-1])


def convex(count: int, seed: int = 0, cell: float = 9.0) -> SceneArrays:
    """`count` obstacles inscribed in ellipses of half axes 0.4 to 1, one for each `cell` of area."""
    rng = np.random.default_rng(seed)
    sizes = rng.choice([3, 4, 5, 6], count, p=[0.2, 0.4, 0.3, 0.1])
    angles = _spread_angles(rng, sizes)
    axes = rng.uniform(0.4, 1.0, (count, 2))
    owner = np.repeat(np.arange(count), sizes)
    flat = axes[owner] * np.column_stack([np.cos(angles), np.sin(angles)])
    turned = _turn(flat, rng.uniform(0, 2 * np.pi, count)[owner])
    return SceneArrays(KITE, turned + _centres(rng, count, cell)[owner], _offsets(sizes))


def stars(count: int, seed: int = 0, cell: float = 16.0) -> SceneArrays:
    """Star-shaped obstacles of 5 to 11 vertices, mostly non-convex."""
    rng = np.random.default_rng(seed)
    sizes = rng.integers(5, 12, count)
    angles = _spread_angles(rng, sizes)
    radius = rng.uniform(0.4, 1.5, len(angles))[:, None]
    owner = np.repeat(np.arange(count), sizes)
    corners = radius * np.column_stack([np.cos(angles), np.sin(angles)])
    return SceneArrays(KITE, corners + _centres(rng, count, cell)[owner], _offsets(sizes))


def combs(count: int, seed: int = 0, teeth: int = 12) -> SceneArrays:
    """`count` combs one above the other, gaps from twice the hook's width down to just above it."""
    rng = np.random.default_rng(seed)
    width, rows = 0.75, np.arange(count)
    gaps = width * (1 + 2.0 ** -(1 + 8 * rows / count)) + rng.uniform(0, 0.01, count)
    k = np.arange(teeth - 1, -1, -1)
    left = k * (1 + gaps[:, None])  # (count, teeth): lower left corners of the teeth, the last one first
    high, low = np.full_like(left, 4.0), np.ones_like(left)
    corners = np.stack([left + 1, high, left, high, left, low, left - gaps[:, None], low], axis=-1)
    tops = corners.reshape(count, 4 * teeth, 2)[:, :-2]
    right = left[:, 0] + 1
    base = np.stack([np.zeros(count), np.zeros(count), right, np.zeros(count)], axis=-1).reshape(count, 2, 2)
    rings = np.concatenate([base, tops], axis=1) + np.column_stack([np.zeros(count), 7.0 * rows])[:, None]
    return _stack(HOOK, rings)


def flats(count: int, seed: int = 0) -> SceneArrays:
    """About `count` flats of 8 by 6 on a square floor: walls, a door each way, four pieces of furniture."""
    rng = np.random.default_rng(seed)
    side = max(1, round(count**0.5))
    x, y = (c.ravel() for c in np.meshgrid(8.0 * np.arange(side), 6.0 * np.arange(side)))
    door_x, door_y = rng.integers(1, 6, len(x)), rng.integers(1, 4, len(x))
    walls = [
        _boxes(x, y, door_x, 0.25),
        _boxes(x + door_x + 1.5, y, 6.5 - door_x, 0.25),
        _boxes(x, y, 0.25, door_y),
        _boxes(x, y + door_y + 1.5, 0.25, 4.5 - door_y),
    ]
    top, right = np.array([0, 6 * side, 8 * side, 0.25]), np.array([8 * side, 0, 0.25, 6 * side])
    outer = [_boxes(*wall[:, None]) for wall in (top, right)]
    furniture = []
    for u, v in ((1, 1), (5, 1), (1, 4), (5, 4)):  # on a quarter grid, so that many edges are aligned
        w, h = rng.integers(2, 8, len(x)) / 4, rng.integers(2, 5, len(x)) / 4
        furniture.append(_boxes(x + u + rng.integers(0, 3, len(x)) / 4, y + v, w, h))
    table = np.array([(-0.5, -0.25), (0.5, -0.25), (0.5, 0.25), (-0.5, 0.25)])
    return _stack(table, np.concatenate([*walls, *outer, *furniture]))


def warehouse(count: int, seed: int = 0) -> SceneArrays:
    """`count` obstacles: racks in aisles, slightly out of line, and for every three a pillar of 16."""
    rng = np.random.default_rng(seed)
    pillars = count // 4
    racks = count - pillars
    columns = max(1, round((racks / 2) ** 0.5))
    k = np.arange(racks)
    x, y = 7.0 * (k % columns), 4.0 * (k // columns)
    shifts = rng.uniform(-0.2, 0.2, (2, racks))
    long = _boxes(x + shifts[0], y + shifts[1], 5.5, 1.2)
    angles = 2 * np.pi * (np.arange(16) + 0.5) / 16
    circle = 0.3 * np.column_stack([np.cos(angles), np.sin(angles)])
    rows = max(1, -(-racks // columns))
    column, row = rng.integers(0, columns, pillars), rng.integers(0, rows, pillars)
    at = np.column_stack([7.0 * column - 0.75, 4.0 * row + 2.6]) + rng.uniform(-0.3, 0.3, (pillars, 2))
    sizes = np.concatenate([np.full(racks, 4), np.full(pillars, 16)])
    vertices = np.concatenate([long.reshape(-1, 2), (at[:, None] + circle).reshape(-1, 2)])
    turn = 2 * np.pi * (np.arange(20) + 0.5) / 20
    robot = np.column_stack([0.9 * np.cos(turn), 0.5 * np.sin(turn)])
    return SceneArrays(robot, vertices, _offsets(sizes))


def grid(count: int, seed: int = 0) -> SceneArrays:
    """Unit squares at a quarter of the points of an integer grid: sides and corners are shared."""
    rng = np.random.default_rng(seed)
    side = int(np.ceil(2 * count**0.5))
    k = rng.choice(side * side, count, replace=False)
    square = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])
    return _stack(square, _boxes((k % side).astype(float), (k // side).astype(float), 1.0, 1.0))


def city(blocks: int, seed: int = 0) -> SceneArrays:
    """About `blocks` city blocks of 40 vertices on a square: every second one in line, the others turned a little.

    A block is 60 wide, its streets 14, its courtyard 36, its door 3, the car 4.5 by 1.8.
    """
    rng = np.random.default_rng(seed)
    side = max(1, round(blocks**0.5))
    x, y = (74.0 * c.ravel() for c in np.meshgrid(np.arange(side), np.arange(side)))
    count = len(x)
    facade = np.empty((count, 24, 2))
    facade[:] = [(33, 0), (60, 0)] + 4 * [(60, 0)] + [(60, 60)] + 4 * [(0, 60)] + [(0, 60)] + 4 * [(0, 0)] + [
        (0, 0), (30, 0), (30, 12), (12, 12), (12, 48), (48, 48), (48, 12), (33, 12)
    ]  # fmt: skip
    facade[:, [0, 17, 18, 23], 0] += rng.integers(-17, 15, count)[:, None]  # the door
    for niche, along, sign in ((2, 1, 1), (7, 0, -1), (12, 1, -1)):  # one in each other side
        start, width, depth = rng.integers(5, 35, count), rng.integers(4, 16, count), rng.integers(2, 9, count)
        first = np.stack([start, start, start + width, start + width], axis=1)
        facade[:, niche : niche + 4, along] = first if sign > 0 else 60 - first
        facade[:, [niche + 1, niche + 2], 1 - along] += np.where(niche == 12, 1, -1) * depth[:, None]
    sheds = np.stack([_boxes(u + rng.uniform(0, 4, count), v + rng.uniform(0, 4, count), rng.uniform(2, 5, count), 3.0)
                      for u in (15, 35) for v in (18, 36)], axis=1)  # fmt: skip
    middle = np.array([30.0, 30.0])
    quarter = rng.integers(0, 4, count)
    turn = np.array([(1, 0), (0, 1), (-1, 0), (0, -1)])[quarter]
    angle = np.where(np.arange(count) % 2 == 0, 0.0, rng.uniform(-0.05, 0.05, count))

    def placed(corners: Floats) -> Floats:
        c, s = (turn.T[k].reshape(-1, *[1] * (corners.ndim - 2)) for k in (0, 1))
        u, v = np.moveaxis(corners - middle, -1, 0)
        u, v = c * u - s * v, s * u + c * v
        c, s = (f(angle).reshape(c.shape) for f in (np.cos, np.sin))
        at = np.column_stack([x, y]).reshape(count, *[1] * (corners.ndim - 2), 2)
        return np.stack([c * u - s * v, s * u + c * v], axis=-1) + middle + at

    sizes = np.concatenate([np.full(count, 24), np.full(4 * count, 4)])
    vertices = np.concatenate([placed(facade).reshape(-1, 2), placed(sheds).reshape(-1, 2)])
    chamfered = np.array([(-2.25, -0.6), (-1.95, -0.9), (1.95, -0.9), (2.25, -0.6)])
    return SceneArrays(np.concatenate([chamfered, -chamfered]), vertices, _offsets(sizes))


FAMILIES: dict[str, Callable[[int], SceneArrays]] = {
    "convex": convex,
    "stars": stars,
    "combs": combs,
    "flats": flats,
    "warehouse": warehouse,
    "grid": grid,
    "city": city,
}


def _spread_angles(rng: np.random.Generator, sizes: NDArray[np.int64]) -> Floats:
    """Rising angles for each ring, gaps from 0.2 to 1.8 of the mean: below pi for 4 and more."""
    offsets = _offsets(sizes)
    place = np.arange(offsets[-1]) - np.repeat(offsets[:-1], sizes)
    return 2 * np.pi * (place + rng.uniform(-0.4, 0.4, len(place))) / np.repeat(sizes, sizes)


def _centres(rng: np.random.Generator, count: int, cell: float) -> Floats:
    return rng.uniform(0, (count * cell) ** 0.5, (count, 2))


def _turn(points: Floats, angles: Floats) -> Floats:
    c, s = np.cos(angles), np.sin(angles)
    x, y = points.T
    return np.column_stack([c * x - s * y, s * x + c * y])


def _boxes(x: Floats, y: Floats, width: Floats | float, height: Floats | float) -> Floats:
    """(count, 4, 2) corners, counter-clockwise."""
    x, y, width, height = np.broadcast_arrays(x, y, width, height)
    corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
    return np.stack([np.column_stack(corner) for corner in corners], axis=1)


def _offsets(sizes: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.concatenate([[0], np.cumsum(sizes)])


def _stack(robot: Floats, rings: Floats) -> SceneArrays:
    """Rings of equal length, (count, length, 2)."""
    count, length, _ = rings.shape
    return SceneArrays(robot, rings.reshape(-1, 2), _offsets(np.full(count, length)))
