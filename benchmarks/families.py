"""Seeded scenes, the same for the same arguments: those that grow, and questions with start and goal.

Those that grow are made without loops over obstacles, which may overlap or touch. `SIZES` holds the sizes the README of
the benchmarks reports:

    convex     random convex obstacles at constant density, a kite as the robot (about 4.3 vertices each)
    stars      random star-shaped obstacles at constant density, a kite as the robot
    combs      a row of combs with ever narrower gaps, a hook as the robot
    noisy      two equal combs in floats, one turned by half a turn: lines agree but for a rounding; size: teeth
    flats      a building of equal flats: walls with doors, furniture; all axis-parallel, a table as the robot
    warehouse  aisles of racks and round pillars, a rounded robot of 20 vertices
    grid       equal unit squares on the integer grid, some of them touching, a unit square as the robot
    city       blocks around courtyards with a door and four sheds each, streets between them, a car of 8 vertices

Questions, ten seeds each, none chosen by its answer:

    maze       corridors of a square of cells, few loops; a bar, a T or an L as the robot
    trap       from one bug trap into another, among convex obstacles; a bar, almost as wide as their mouths
    barrier    walls with two gates each, rooms with posts; a notched bar
    field      non-convex polygons at random, some overlapping; an L
    nest       non-convex parts dropped into a bin, one of them taken out
    throat     two furnished rooms and a throat that is wider by 10 % to 0.001 %; a rounded rectangle
    large      a star of 10 to 100 vertices among convex obstacles

Questions of another kind, for any seed:

    crowd      a narrow wavy part of 68 vertices among 140 round ones of 60, which touch nothing: 8,400 vertices

Changes, of scenes before:

    moves      some obstacles of any scene, with motions of three kinds
    frames     a costmap of rooms and things of ragged outlines, again and again: a block moves, cells flicker

Seeds 2, 5 and 8 of mazes, traps, barriers and throats are shut, most by little. Coordinates are doubles of full length.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import affinity

import cfree

Floats = NDArray[np.float64]
Box = tuple[float, float, float, float]

KITE = np.array([(-0.9, -0.35), (0.7, -0.55), (1.0, 0.3), (-0.6, 0.6)])
HOOK = np.array([(-1, -4), (2, -4), (2, -2), (1, -2), (1, -3), (0, -3), (0, 2), (-1, 2)]) / 4
CAR = np.array([(-2.25, -0.6), (-1.95, -0.9), (1.95, -0.9), (2.25, -0.6), (2.25, 0.6), (1.95, 0.9), (-1.95, 0.9),
                (-2.25, 0.6)])  # fmt: skip
BLOCK = 74.0
BAR = np.array([(-0.6, -0.2), (0.6, -0.2), (0.6, 0.2), (-0.6, 0.2)])
SEEDS = range(10)
MOVES = ("decimals", "doubles", "turns")
SIZES = {
    "convex": (60, 500, 5_000, 25_000),
    "stars": (50, 500, 5_000),
    "combs": (4, 16, 64),
    "noisy": (8, 14, 20),
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
    corners = turned(flat, rng.uniform(0, 2 * np.pi, count)[owner])
    return SceneArrays(KITE, corners + _centres(rng, count, cell)[owner], _offsets(sizes))


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


def noisy(teeth: int) -> SceneArrays:
    """Two equal combs in floats, one turned by half a turn: lines that should be one differ in the last digits."""
    pitch, x = 2.2, np.arange(teeth - 1, -1, -1) * 2.2
    tooth = [np.column_stack([x + 1, np.full(teeth, 4.0)]), np.column_stack([x, np.full(teeth, 4.0)])]
    gap = [np.column_stack([x, np.ones(teeth)]), np.column_stack([x - pitch + 1, np.ones(teeth)])]
    tops = np.stack([*tooth, *gap], axis=1).reshape(-1, 2)[:-2]
    comb = np.concatenate([[(0.0, 0.0), (x[0] + 1, 0.0)], tops])
    return _stack(turned(comb, math.pi), comb[None])


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
    side = max(1, round(blocks**0.5))
    rows = [city_row(side, row, seed) for row in range(side)]
    facades, sheds = (np.concatenate(parts) for parts in zip(*rows, strict=True))
    sizes = np.concatenate([np.full(len(facades), 24), np.full(4 * len(facades), 4)])
    return SceneArrays(CAR, np.concatenate([facades.reshape(-1, 2), sheds.reshape(-1, 2)]), _offsets(sizes))


def city_row(side: int, row: int, seed: int) -> tuple[Floats, Floats]:
    """Facades, (side, 24, 2), and sheds, (side, 4, 4, 2), of one row of blocks; the same whatever else there is.

    Of a facade the vertices 1 to 16 are the outside, 19 to 22 the courtyard, the others those of the door.
    """
    rng = np.random.default_rng([seed, row])
    facade = np.empty((side, 24, 2))
    facade[:] = [(33, 0), (60, 0)] + 4 * [(60, 0)] + [(60, 60)] + 4 * [(0, 60)] + [(0, 60)] + 4 * [(0, 0)] + [
        (0, 0), (30, 0), (30, 12), (12, 12), (12, 48), (48, 48), (48, 12), (33, 12)
    ]  # fmt: skip
    facade[:, [0, 17, 18, 23], 0] += rng.integers(-17, 15, side)[:, None]  # the door
    for niche, along, sign in ((2, 1, 1), (7, 0, -1), (12, 1, -1)):  # one in each other side
        start, width, depth = rng.integers(5, 35, side), rng.integers(4, 16, side), rng.integers(2, 9, side)
        first = np.stack([start, start, start + width, start + width], axis=1)
        facade[:, niche : niche + 4, along] = first if sign > 0 else 60 - first
        facade[:, [niche + 1, niche + 2], 1 - along] += np.where(niche == 12, 1, -1) * depth[:, None]
    sheds = np.stack([_boxes(u + rng.uniform(0, 4, side), v + rng.uniform(0, 4, side), rng.uniform(2, 5, side), 3.0)
                      for u in (15, 35) for v in (18, 36)], axis=1)  # fmt: skip
    middle = np.array([30.0, 30.0])
    turn = np.array([(1, 0), (0, 1), (-1, 0), (0, -1)])[rng.integers(0, 4, side)]
    angle = np.where((np.arange(side) + row * side) % 2 == 0, 0.0, rng.uniform(-0.05, 0.05, side))
    places = BLOCK * np.column_stack([np.arange(side), np.full(side, row)])

    def placed(corners: Floats) -> Floats:
        c, s = (turn.T[k].reshape(-1, *[1] * (corners.ndim - 2)) for k in (0, 1))
        u, v = np.moveaxis(corners - middle, -1, 0)
        u, v = c * u - s * v, s * u + c * v
        c, s = (f(angle).reshape(c.shape) for f in (np.cos, np.sin))
        at = places.reshape(side, *[1] * (corners.ndim - 2), 2)
        return np.stack([c * u - s * v, s * u + c * v], axis=-1) + middle + at

    return placed(facade), placed(sheds)


FAMILIES: dict[str, Callable[[int], SceneArrays]] = {
    "convex": convex,
    "stars": stars,
    "combs": combs,
    "noisy": noisy,
    "flats": flats,
    "warehouse": warehouse,
    "grid": grid,
    "city": city,
}


# --- questions ---


def maze(seed: int) -> cfree.Scene:
    """Walls between cells of a square that a walk over all of them did not pass."""
    rng = np.random.default_rng([1, seed])
    side = int(rng.integers(6, 11))
    way, seen, opened = [(0, 0)], {(0, 0)}, set()
    while way:
        x, y = way[-1]
        near = [(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)]
        fresh = [cell for cell in near if min(cell) >= 0 and max(cell) < side and cell not in seen]
        if not fresh:
            way.pop()
            continue
        cell = fresh[rng.integers(len(fresh))]
        seen.add(cell)
        opened.add(frozenset((way[-1], cell)))
        way.append(cell)
    last = (side - 1, side - 1)
    shut = _is_shut(seed)
    walls = []
    for x in range(side):
        for y in range(side):
            for other, wall in (((x + 1, y), _rectangle(x + 0.94, y - 0.06, 0.12, 1.12)),
                                ((x, y + 1), _rectangle(x - 0.06, y + 0.94, 1.12, 0.12))):  # fmt: skip
                is_open = frozenset(((x, y), other)) in opened or (not shut and rng.random() < 0.05)
                if max(other) < side and (not is_open or (shut and last in ((x, y), other))):
                    walls.append(wall)
    length, width = rng.uniform(0.35, 0.8), rng.uniform(0.1, 0.25)
    bar = shapely.box(-length / 2, -width / 2, length / 2, width / 2)
    arm = shapely.box(
        *[(0, 0, 0, 0), (-width / 2, 0, width / 2, 0.35), (-length / 2, 0, width - length / 2, 0.35)][seed % 3]
    )
    goal = (side - 0.7, side - 0.7, side - 0.3, side - 0.3)
    return _asked(rng, _ring(bar.union(arm)), walls, (0.3, 0.3, 0.7, 0.7), goal,
                  workspace=_rectangle(0, 0, side, side), turned=seed % 2 == 1)  # fmt: skip


def trap(seed: int) -> cfree.Scene:
    """From one bug trap into another."""
    rng = np.random.default_rng([2, seed])
    slack = -(10.0 ** rng.uniform(-4, -1)) if _is_shut(seed) else 10.0 ** rng.uniform(-2.5, -0.2)
    robot = BAR * (rng.uniform(0.7, 1.3), 1)
    half = 0.2 * (1 + slack)
    traps = []
    for at in (-5.5, 5.5):
        radius, k = rng.uniform(2.8, 3.6), int(rng.integers(3, 8))
        ring = shapely.Point(0, 0).buffer(radius, quad_segs=k) - shapely.Point(0, 0).buffer(radius - 0.4, quad_segs=k)
        lips = [shapely.box(0.45 * radius, y, 0.96 * radius, y + 0.3) for y in (half, -half - 0.3)]
        whole = shapely.unary_union([ring - shapely.box(0, -half, 2 * radius, half), *lips])
        body = affinity.rotate(max(shapely.get_parts(whole), key=shapely.area), rng.uniform(0, 360), origin=(0, 0))
        traps.append(_ring(affinity.translate(body, at, 0)))
    others = _scattered(rng, convex(60, seed, cell=7.0).rings(), (-12, -6, 12, 6), keep_off=traps)
    return _asked(
        rng,
        robot,
        [*traps, *others[:32]],
        (-6.5, -1, -4.5, 1),
        (4.5, -1, 6.5, 1),
        workspace=_rectangle(-12.5, -6.5, 25, 13),
    )


def barrier(seed: int) -> cfree.Scene:
    """Walls one after the other, two gates in each."""
    rng = np.random.default_rng([3, seed])
    count, walls = int(rng.integers(6, 11)), []
    closed = int(rng.integers(count)) if _is_shut(seed) else -1
    for k in range(count):
        x, below, above = 3.0 * k + 2, rng.uniform(-2.6, -0.9), rng.uniform(0.9, 2.6)
        wide = rng.uniform(0.42, 1.0, 2) if k != closed else 0.4 - 10.0 ** rng.uniform(-4, -1, 2)
        ends = [-3.5, below - wide[0] / 2, below + wide[0] / 2, above - wide[1] / 2, above + wide[1] / 2, 3.5]
        walls += [_rectangle(x, low, 0.3, high - low) for low, high in zip(ends[::2], ends[1::2], strict=True)]
        walls += [_rectangle(x + 1.5, y, 0.2, 0.2) for y in rng.uniform(-3, 3, 2)]
    robot = shapely.Polygon(BAR) - shapely.box(-0.2, 0, rng.uniform(0, 0.3), 1)
    return _asked(rng, _ring(robot), walls, (0.5, -2, 1, 2), (3.0 * count + 1, -2, 3.0 * count + 1.4, 2),
                  workspace=_rectangle(-0.5, -3.5, 3.0 * count + 2.5, 7), turned=True)  # fmt: skip


def field(seed: int) -> cfree.Scene:
    """Across star-shaped obstacles, dense or less so."""
    rng = np.random.default_rng([4, seed])
    count, cell = int(rng.integers(40, 120)), rng.uniform(7, 16)
    side = (count * cell) ** 0.5
    robot = np.array([(-0.9, -0.5), (0.9, -0.5), (0.9, -0.1), (-0.5, -0.1), (-0.5, 0.9), (-0.9, 0.9)]) * rng.uniform(
        0.5, 1
    )
    return _asked(rng, robot, stars(count, seed + 100, cell).rings(), (0, 0, side / 4, side / 4),
                  (0.75 * side, 0.75 * side, side, side), bounds=(0, 0, side, side))  # fmt: skip


def nest(seed: int) -> cfree.Scene:
    """Parts dropped where each comes to lie lowest, of some places and orientations; even seeds take a late one."""
    rng = np.random.default_rng([5, seed])
    wide, count = 12.0, 34
    heights = np.arange(14, 0, -0.06)
    bin_walls = [_rectangle(-0.5, -0.5, 13, 0.5), _rectangle(-0.5, 0, 0.5, 16), _rectangle(wide, 0, 0.5, 16)]
    heap, parts = shapely.unary_union([shapely.Polygon(wall) for wall in bin_walls]), []
    while len(parts) < count:
        part, tries = _part(rng), []
        for _ in range(6):
            placed = affinity.rotate(part, rng.uniform(0, 360) if seed % 2 else 90.0 * rng.integers(4), origin=(0, 0))
            x = rng.uniform(1, wide - 1)
            falls = shapely.polygons(_ring(placed) + np.column_stack([np.full_like(heights, x), heights])[:, None])
            hits = np.flatnonzero(shapely.intersects(heap, falls))
            if hits[0] > 0:
                tries.append(falls[hits[0] - 1])
        if tries:
            parts.append(min(tries, key=lambda placed: placed.bounds[3]))
            heap = heap.union(parts[-1])
    taken = int(rng.integers(0 if seed % 2 else count - 8, count))  # of the last ones that fell, or of all
    at = parts[taken].representative_point()
    robot = _ring(affinity.translate(parts[taken], -at.x, -at.y))
    top = heap.bounds[3]
    others = [_ring(part) for k, part in enumerate(parts) if k != taken]
    scene = cfree.Scene(robot, [*bin_walls, *others], start=(at.x, at.y, 0), bounds=(-6, -2, 18, top + 6))
    return replace(scene, goal=_free(rng, scene, (2, top + 2.5, 10, top + 5)))


def throat(seed: int) -> cfree.Scene:
    """Two furnished rooms and a throat between them."""
    rng = np.random.default_rng([6, seed])
    gap = 0.5 * (1 + (-1 if _is_shut(seed) else 1) * 10.0 ** -rng.uniform(1, 5))
    walls = [_rectangle(0, -5, 1, 5 - gap), _rectangle(0, gap, 1, 5 - gap)]
    rings = _scattered(rng, stars(60, seed + 200, 9).rings(), (-9, -4.5, 10, 4.5), keep_off=[_rectangle(-3, -2, 7, 4)])
    robot = shapely.box(-0.8, -0.4, 0.8, 0.4).buffer(0.1, quad_segs=int(rng.integers(1, 5)))
    return _asked(rng, _ring(robot), [*walls, *rings[:36]], (-9, -4, -3, 4), (4, -4, 10, 4),
                  workspace=_rectangle(-10, -5, 21, 10), turned=seed % 2 == 0)  # fmt: skip


def large(seed: int) -> cfree.Scene:
    """A robot of many vertices, among obstacles as large as it is."""
    rng = np.random.default_rng([7, seed])
    count, cell = 10 * (seed + 1), rng.uniform(8, 14)
    angles = 2 * np.pi * (np.arange(count) + rng.uniform(-0.3, 0.3, count)) / count
    waves = 1 + 0.35 * np.cos(int(rng.integers(2, 6)) * angles + rng.uniform(0, 6)) + rng.uniform(-0.05, 0.05, count)
    robot = 0.9 * waves[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    side = (40 * cell) ** 0.5
    return _asked(rng, robot, convex(40, seed + 300, cell).rings(), (0, 0, side / 4, side / 4),
                  (0.75 * side, 0.75 * side, side, side), bounds=(0, 0, side, side))  # fmt: skip


def crowd(seed: int) -> cfree.Scene:
    """A narrow robot of many vertices across rows of obstacles of as many."""
    rng = np.random.default_rng([8, seed])
    pitch, rows = rng.uniform(3.8, 4.4), 12

    def part(count: int) -> Floats:
        angles = 2 * np.pi * np.arange(count) / count
        waves = 1 + 0.2 * np.cos(int(rng.integers(2, 5)) * angles + rng.uniform(0, 6)) + rng.uniform(0, 0.01, count)
        return 1.25 * waves[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])

    obstacles = [part(60) + pitch * np.array(divmod(k, rows)) + rng.uniform(-0.3, 0.3, 2) for k in range(140)]
    far = pitch * (rows - 1)
    return _asked(rng, part(68) * (1.3, 0.35), obstacles, (-3, -3, 1, 1), (far - 1, far - 1, far + 3, far + 3),
                  workspace=_rectangle(-3.5, -3.5, far + 7, far + 7))  # fmt: skip


QUESTIONS: dict[str, Callable[[int], cfree.Scene]] = {
    "maze": maze,
    "trap": trap,
    "barrier": barrier,
    "field": field,
    "nest": nest,
    "throat": throat,
    "large": large,
}


def frames(count: int, cells: int = 200, seed: int = 0) -> Iterator[NDArray[np.int16]]:
    """Yield a costmap `count` times, cells of 0 and 100: a block moves through it, and six cells flicker each time."""
    rng = np.random.default_rng(seed)
    base = _costmap(rng, cells)
    for k in range(count):
        grid = base.copy()
        x, y = 20 + int((cells - 60) * (0.5 + 0.5 * np.sin(k / 40))), cells // 2 + int(20 * np.cos(k / 23))
        grid[y : y + 7, x : x + 7] = 100
        row, column = rng.integers(25, cells - 25, (2, 6))
        grid[row, column] = 100 - grid[row, column]
        yield grid


def _costmap(rng: np.random.Generator, cells: int) -> NDArray[np.int16]:
    """Three rooms with two doors between neighbours, round things of ragged outlines, and two free corners."""
    grid = np.zeros((cells, cells), np.int16)
    row, column = np.mgrid[:cells, :cells]
    for _ in range(cells * cells * 3 // 2000):
        x, y = rng.integers(12, cells - 12, 2)
        distance = np.hypot(column - x, row - y) + rng.normal(0, 0.4, grid.shape)
        grid[distance < rng.uniform(1.5, 4)] = 100
    for wall in (cells // 3, 2 * cells // 3):
        grid[wall : wall + 2] = 100
        for door in (cells // 4, 3 * cells // 4):
            grid[wall - 4 : wall + 6, door - 10 : door + 10] = 0
    for corner in (slice(6, 30), slice(cells - 36, cells - 12)):
        grid[corner, corner] = 0
    grid[:2] = grid[-2:] = 100
    grid[:, :2] = grid[:, -2:] = 100
    return grid


# --- parts of both ---


def moves(scene: cfree.Scene, kind: str, count: int, seed: int = 0) -> list[tuple[int, cfree.Pose]]:
    """Obstacles, and motions by up to a tenth of their size: shifts by decimals or doubles, turns about the middle."""
    rng = np.random.default_rng(seed)
    result = []
    for k in rng.choice(len(scene.obstacles), min(count, len(scene.obstacles)), replace=False).tolist():
        x0, y0, x1, y1 = scene.obstacles[k].bounds
        x, y = rng.uniform(-0.1, 0.1, 2) * max(x1 - x0, y1 - y0)
        if kind == "decimals":
            pose = cfree.Pose(f"{x:.2f}", f"{y:.2f}")
        elif kind == "doubles":
            pose = cfree.Pose(x, y)
        else:
            middle, turn = cfree.Pose((x0 + x1) / 2, (y0 + y1) / 2), cfree.Pose(0, 0, f"{rng.uniform(-10, 10):.1f}deg")
            pose = middle @ turn @ middle.inverse()
        result.append((k, pose))
    return result


def _spread_angles(rng: np.random.Generator, sizes: NDArray[np.int64]) -> Floats:
    """Rising angles for each ring, gaps from 0.2 to 1.8 of the mean: below pi for 4 and more."""
    offsets = _offsets(sizes)
    place = np.arange(offsets[-1]) - np.repeat(offsets[:-1], sizes)
    return 2 * np.pi * (place + rng.uniform(-0.4, 0.4, len(place))) / np.repeat(sizes, sizes)


def _centres(rng: np.random.Generator, count: int, cell: float) -> Floats:
    return rng.uniform(0, (count * cell) ** 0.5, (count, 2))


def turned(points: Floats, angles: Floats | float) -> Floats:
    """Return points turned about the origin: all by one angle, or each by its own."""
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


def _is_shut(seed: int) -> bool:
    return seed % 3 == 2


def _part(rng: np.random.Generator) -> shapely.Polygon:
    """A U, an L, a C with a hook, or a star."""
    size = rng.uniform(0.7, 1.3)
    if rng.random() < 0.3:
        count = int(rng.integers(6, 14))
        angles = 2 * np.pi * (np.arange(count) + rng.uniform(-0.3, 0.3, count)) / count
        return shapely.Polygon(
            size * rng.uniform(0.4, 1, count)[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
        )
    w, h, t = size * rng.uniform(0.8, 1.2, 3) * (1, 1, 0.3)
    right = shapely.box(w - t, -h, w, rng.uniform(-h + t, h))
    top = shapely.box(-w, h - t, rng.uniform(0, w) - t, h)
    sides = [shapely.box(-w, -h, w, t - h), shapely.box(-w, -h, t - w, h), right, top]
    return shapely.unary_union(sides[: rng.integers(2, 5)])


def _rectangle(x: float, y: float, width: float, height: float) -> Floats:
    return np.array([(x, y), (x + width, y), (x + width, y + height), (x, y + height)])


def _ring(polygon: shapely.Polygon) -> Floats:
    return np.array(polygon.exterior.coords)[:-1]


def _scattered(
    rng: np.random.Generator, rings: Sequence[Floats], area: Box, keep_off: Sequence[Floats]
) -> list[Floats]:
    """Rings with their centres anywhere in an area, but off some shapes."""
    x0, y0, x1, y1 = area
    free_of = shapely.union_all([shapely.Polygon(ring).convex_hull for ring in keep_off])
    moved = [ring - ring.mean(axis=0) + rng.uniform((x0, y0), (x1, y1)) for ring in rings]
    return [ring for ring in moved if not shapely.Polygon(ring).intersects(free_of)]


def _asked(
    rng: np.random.Generator, robot: Floats, obstacles: Sequence[Floats], start: Box, goal: Box, *,
    workspace: Floats | None = None, bounds: Box | None = None, turned: bool = False,
) -> cfree.Scene:  # fmt: skip
    """The scene with free poses in two boxes; all of it turned by some angle."""
    angle = rng.uniform(0, 2 * np.pi) if turned else 0.0
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([(c, s), (-s, c)])
    scene = cfree.Scene(robot, [ring @ turn for ring in obstacles], bounds=bounds,
                        workspace=None if workspace is None else workspace @ turn)  # fmt: skip
    return replace(scene, start=_free(rng, scene, start, turn), goal=_free(rng, scene, goal, turn))


def _free(rng: np.random.Generator, scene: cfree.Scene, area: Box, turn: Floats | None = None) -> cfree.Pose:
    """The first free pose of many."""
    x0, y0, x1, y1 = area
    rows = rng.uniform((x0, y0, 0), (x1, y1, 6), (2000, 3))
    if turn is not None:
        rows[:, :2] = rows[:, :2] @ turn
    row = rows[np.flatnonzero(cfree.PoseChecker(scene).is_free(rows))[0]]
    return cfree.Pose(*row.round(4).tolist())
