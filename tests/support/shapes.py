"""Named shapes and seeded random scenes, as plain coordinates: `(outer, holes)`, rings as lists of points.

Outer rings are counter-clockwise, holes clockwise; no vertex is collinear with its neighbours unless a
docstring states it.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import shapely

Point = tuple[Any, Any]
Shape = tuple[list[Point], list[list[Point]]]


class PlainScene(NamedTuple):
    """A scene's polygons and bounds, without any class of the package."""

    robot: list[Shape]
    obstacles: list[Shape]
    bounds: tuple[Any, Any, Any, Any] | None = None
    workspace: Shape | None = None


# --- named shapes ---


def triangle() -> Shape:
    return [(0, 0), (4, 0), (1, 3)], []


def box(x0: Any, y0: Any, x1: Any, y1: Any) -> Shape:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)], []


def regular(n: int, radius: float = 1.0, centre: Point = (0.0, 0.0), turn: float = 0.0) -> Shape:
    """Regular n-gon with vertices rounded to doubles, the first in the direction `turn`."""
    angles = [turn + 2 * math.pi * k / n for k in range(n)]
    return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles], []


def rational_regular(n: int, radius: Fraction | int = 1, centre: Point = (0, 0), digits: int = 3) -> Shape:
    """Nearly regular n-gon whose rational vertices lie exactly on a circle; regular only for n = 4."""
    half_tangents = [math.tan(math.pi * k / n) if 2 * k != n else None for k in range(n)]
    ring = []
    for value in half_tangents:
        c, s = Fraction(-1), Fraction(0)
        if value is not None:
            t = Fraction(value).limit_denominator(10**digits)
            c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
        ring.append((centre[0] + radius * c, centre[1] + radius * s))
    return ring, []


def l_shape(arm: Any = 3, width: Any = 1) -> Shape:
    return [(0, 0), (arm, 0), (arm, width), (width, width), (width, arm), (0, arm)], []


def u_shape(span: Any = 4, depth: Any = 3, wall: Any = 1) -> Shape:
    inner = span - wall
    outside = [(0, 0), (span, 0), (span, depth)]
    return [*outside, (inner, depth), (inner, wall), (wall, wall), (wall, depth), (0, depth)], []


def comb(teeth: int = 4, depth: Any = 3, gap: Any = 1, tooth: Any = 1) -> Shape:
    """A back of height 1 with `teeth` teeth upwards, `gap` apart."""
    ring: list[Point] = [(0, 0), (teeth * tooth + (teeth - 1) * gap, 0)]
    for k in reversed(range(teeth)):
        left = k * (tooth + gap)
        ring += [(left + tooth, 1 + depth), (left, 1 + depth)]
        ring += [(left, 1), (left - gap, 1)] if k else []
    return ring, []


def hook() -> Shape:
    """A J that hangs into a comb; its reference point is on the side of the stem."""
    ring = [(-1, -4), (2, -4), (2, -2), (1, -2), (1, -3), (0, -3), (0, 2), (-1, 2)]
    return [(Fraction(x, 4), Fraction(y, 4)) for x, y in ring], []


def frame(size: Any = 6, wall: Any = 1) -> Shape:
    """A square ring: a polygon with one hole."""
    inner = size - wall
    return box(0, 0, size, size)[0], [[(wall, wall), (wall, inner), (inner, inner), (inner, wall)]]


def star(spikes: int = 5, outer: float = 2.0, inner: float = 0.8, centre: Point = (0.0, 0.0)) -> Shape:
    ring = []
    for k in range(2 * spikes):
        radius, a = (inner if k % 2 else outer), math.pi * k / spikes
        ring.append((centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)))
    return ring, []


def paper_like() -> PlainScene:
    """Two triangles as in the paper's Fig. 9, coordinates of our own; reference point inside the robot."""
    robot = [(Fraction(-1, 2), Fraction(-1, 2)), (1, Fraction(-1, 4)), (Fraction(-1, 4), Fraction(3, 4))], []
    return PlainScene([robot], [([(0, 0), (3, Fraction(1, 2)), (1, 2)], [])])


NAMED: dict[str, Callable[[], Shape]] = {
    "triangle": triangle,
    "square": lambda: box(0, 0, 2, 2),
    "pentagon": lambda: regular(5),
    "rational_hexagon": lambda: rational_regular(6),
    "l_shape": l_shape,
    "u_shape": u_shape,
    "comb": comb,
    "hook": hook,
    "frame": frame,
    "star": star,
}


# --- moving shapes ---


def star_among_squares(spikes: int = 32) -> PlainScene:
    """Of which trimming takes much longer than the tenth of a second after which limits are looked at again."""
    squares = [box(x, y, x + 1, y + 1) for x in range(0, 24, 4) for y in range(0, 24, 4)]
    return PlainScene([star(spikes, 2.0, 1.0)], squares)


def moved(shape: Shape, dx: Any, dy: Any) -> Shape:
    return mapped(shape, lambda x, y: (x + dx, y + dy))


def scaled(shape: Shape, factor: Any) -> Shape:
    """Shape scaled about the origin by a positive factor."""
    return mapped(shape, lambda x, y: (x * factor, y * factor))


def quarter_turned(shape: Shape, quarters: int = 1) -> Shape:
    for _ in range(quarters % 4):
        shape = mapped(shape, lambda x, y: (-y, x))
    return shape


def mirrored(shape: Shape) -> Shape:
    """Shape mirrored in the y-axis, rings reversed so that their orientation stays."""
    outer, holes = mapped(shape, lambda x, y: (-x, y))
    return outer[::-1], [hole[::-1] for hole in holes]


def mapped(shape: Shape, image: Callable[[Any, Any], Point]) -> Shape:
    outer, holes = shape
    return [image(x, y) for x, y in outer], [[image(x, y) for x, y in hole] for hole in holes]


# --- seeded random scenes ---


def random_scene(seed: int, kind: str) -> PlainScene:
    """A small scene of one of the `KINDS`; the same seed gives the same scene for ever."""
    return _GENERATORS[kind](random.Random(f"{kind} {seed}"))


def random_convex(rng: random.Random, centre: Point = (0.0, 0.0), radius: float = 1.0) -> Shape:
    """3 to 8 vertices in random directions on an ellipse about the centre."""
    while True:
        angles = sorted(rng.uniform(0, 2 * math.pi) for _ in range(rng.randint(3, 8)))
        gaps = [b - a for a, b in zip(angles, [*angles[1:], angles[0] + 2 * math.pi], strict=True)]
        if min(gaps) > 0.1 and max(gaps) < 3:
            break
    a, b, turn = radius * rng.uniform(0.5, 1), radius * rng.uniform(0.5, 1), rng.uniform(0, math.pi)
    c, s = math.cos(turn), math.sin(turn)
    flat = [(a * math.cos(t), b * math.sin(t)) for t in angles]
    return [(centre[0] + c * x - s * y, centre[1] + s * x + c * y) for x, y in flat], []


def random_star(rng: random.Random, centre: Point = (0.0, 0.0), radius: float = 1.0) -> Shape:
    """Star-shaped about the centre, 4 to 9 vertices, mostly non-convex."""
    n = rng.randint(4, 9)
    angles = [2 * math.pi * (k + rng.uniform(-0.4, 0.4)) / n for k in range(n)]
    lengths = [radius * rng.uniform(0.3, 1) for _ in range(n)]
    corners = [(r * math.cos(t), r * math.sin(t)) for r, t in zip(lengths, angles, strict=True)]
    return [(centre[0] + x, centre[1] + y) for x, y in corners], []


def random_holed(rng: random.Random, centre: Point = (0.0, 0.0), radius: float = 1.0) -> Shape:
    """A random star with one hole like itself, or two triangular ones; every coordinate a generic double."""
    outer = random_star(rng, (0.0, 0.0), radius)[0]
    if rng.random() < 0.7:
        factor = rng.uniform(0.3, 0.8)
        holes = [[(factor * x, factor * y) for x, y in outer]]
    else:  # shrunk triangles of the fan about the origin, from which the whole star is visible
        holes = []
        for k in (0, 2):
            fan = [(0.0, 0.0), outer[k], outer[k + 1]]
            x, y = (sum(values) / 3 for values in zip(*fan, strict=True))
            holes.append([(x + 0.8 * (u - x), y + 0.8 * (v - y)) for u, v in fan])
    return moved((outer, [hole[::-1] for hole in holes]), *centre)


def random_lattice_shape(rng: random.Random, size: int = 5, points: int = 7) -> Shape:
    """A simple polygon with small integer vertices, monotone; three in a row may be collinear."""
    while True:
        chosen = sorted({(rng.randint(0, size), rng.randint(0, size)) for _ in range(points)})
        ring = monotone_ring(chosen)
        if ring:
            return quarter_turned((ring, []), rng.randint(0, 3))


def monotone_ring(points: Sequence[Point]) -> list[Point]:
    """A simple counter-clockwise ring through the distinct points; empty if they are collinear.

    Those right of the line from the lexicographically first to the last rise, those left of it fall.
    """
    ordered = sorted(points)
    if len(ordered) < 3:
        return []
    first, *middle, last = ordered
    left = [p for p in middle if _turn(first, last, p) > 0]
    level = [p for p in middle if _turn(first, last, p) == 0]
    right = [p for p in middle if _turn(first, last, p) < 0]
    if left:  # the level ones go where they do not touch the other chain
        return [first, *sorted(right + level), last, *left[::-1]]
    return [first, *right, last, *level[::-1]] if right else []


def _spread(rng: random.Random, count: int, side: float) -> list[Point]:
    return [(rng.uniform(0, side), rng.uniform(0, side)) for _ in range(count)]


def _scatter(rng: random.Random, make: Callable[..., Shape], count: int, side: float) -> list[Shape]:
    """Shapes of about unit radius that keep clear of each other."""
    placed: list[Shape] = []
    solid: list[shapely.Polygon] = []
    while len(placed) < count:
        shape = make(rng, _spread(rng, 1, side)[0], rng.uniform(0.5, 1.2))
        polygon = shapely.Polygon(*shape)
        if all(polygon.distance(other) > 0.01 for other in solid):
            placed.append(shape)
            solid.append(polygon)
    return placed


def _robot(rng: random.Random, make: Callable[..., Shape], radius: float = 0.6) -> Shape:
    """Robot with a reference point that may lie outside it."""
    return make(rng, (rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)), radius)


def _convex(rng: random.Random) -> PlainScene:
    return PlainScene([_robot(rng, random_convex)], _scatter(rng, random_convex, rng.randint(1, 6), 8.0))


def _nonconvex(rng: random.Random) -> PlainScene:
    return PlainScene([_robot(rng, random_star)], _scatter(rng, random_star, rng.randint(1, 6), 8.0))


def _holed(rng: random.Random) -> PlainScene:
    """Rings with room inside for the robot, or a ring as the robot with obstacles that fit its hole."""
    if rng.random() < 0.3:
        small = [random_star(rng, centre, 0.2) for centre in _spread(rng, rng.randint(1, 3), 4.0)]
        return PlainScene([_robot(rng, random_holed, 1.5)], small)
    obstacles = [random_holed(rng, centre, 2.0) for centre in _spread(rng, rng.randint(1, 3), 6.0)]
    return PlainScene([_robot(rng, random_star, 0.5)], obstacles)


def _overlapping(rng: random.Random) -> PlainScene:
    make = rng.choice([random_convex, random_star, random_holed])
    obstacles = [make(rng, centre, rng.uniform(0.5, 1.5)) for centre in _spread(rng, rng.randint(2, 7), 3.0)]
    obstacles += rng.sample(obstacles, 1) if rng.random() < 0.3 else []  # the same obstacle twice
    return PlainScene([_robot(rng, random_star)], obstacles)


def _touching(rng: random.Random) -> PlainScene:
    """Shapes cut into neighbours with exactly common edges, vertices, or a vertex on an edge."""
    obstacles: list[Shape] = []
    for shape in _scatter(rng, random_convex, rng.randint(1, 3), 6.0):
        ring = shape[0]
        cut = rng.randint(2, len(ring) - 1)
        halves = [[*ring[: cut + 1]], [ring[0], *ring[cut:]]]
        obstacles += [(half, []) for half in halves if len(half) > 2]
        p, q = ring[0], ring[1]  # a triangle with its tip in the vertex q, outside the shape
        far = (2 * q[0] - p[0], 2 * q[1] - p[1])
        tip = [q, (far[0] + 0.3 * (q[1] - p[1]), far[1] - 0.3 * (q[0] - p[0])), far]
        if rng.random() < 0.5:
            obstacles.append((tip if _turn(*tip) > 0 else tip[::-1], []))
    x = rng.randint(8, 9)
    obstacles += [box(x, 0, x + 2, 1), box(x + rng.randint(0, 2), 1, x + 3, 2)]  # a shared part of an edge
    return PlainScene([_robot(rng, rng.choice([random_convex, random_star]))], obstacles)


def _turn(p: Point, q: Point, r: Point) -> Any:
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def _axis_parallel(rng: random.Random) -> PlainScene:
    """Walls and furniture on a small integer grid; overlaps, touching and aligned edges are common."""
    obstacles = []
    for _ in range(rng.randint(1, 5)):
        x, y = rng.randint(0, 8), rng.randint(0, 8)
        shape = rng.choice([box(0, 0, rng.randint(1, 4), rng.randint(1, 4)), l_shape(), u_shape(), frame()])
        obstacles.append(moved(quarter_turned(shape, rng.randint(0, 3)), x, y))
    robot = rng.choice([box(0, 0, 1, 1), box(-1, 0, 1, 1), l_shape(2, 1), moved(u_shape(3, 2, 1), -1, -1)])
    return PlainScene([robot], obstacles)


def _several_robots(rng: random.Random) -> PlainScene:
    parts = [_robot(rng, rng.choice([random_convex, random_star]), 0.5) for _ in range(rng.randint(2, 3))]
    return PlainScene(parts, _scatter(rng, random_star, rng.randint(1, 4), 6.0))


def _regular(rng: random.Random) -> PlainScene:
    """Regular polygons, most of them alike: many contacts begin at the same angle."""
    n, rational = rng.randint(3, 8), rng.random() < 0.5

    def polygon(radius: int, x: int, y: int) -> Shape:
        return rational_regular(n, radius, (x, y)) if rational else regular(n, radius, (x, y))

    obstacles = [polygon(rng.randint(1, 2), 4 * k, rng.randint(0, 3)) for k in range(rng.randint(1, 4))]
    return PlainScene([polygon(1, 0, 0)], obstacles)


def _integer_grid(rng: random.Random) -> PlainScene:
    """Small integer coordinates, half of the time the robot congruent to an obstacle."""
    obstacles = []
    for _ in range(rng.randint(1, 4)):
        obstacles.append(moved(random_lattice_shape(rng), rng.randint(0, 6), rng.randint(0, 6)))
    if rng.random() < 0.5:
        robot = moved(quarter_turned(obstacles[0], rng.randint(0, 3)), rng.randint(-6, 6), rng.randint(-6, 6))
    else:
        robot = moved(random_lattice_shape(rng, 3, 5), -1, -1)
    return PlainScene([robot], obstacles)


def _bounded(rng: random.Random) -> PlainScene:
    scene = _nonconvex(rng) if rng.random() < 0.5 else _axis_parallel(rng)
    return scene._replace(bounds=(0, 0, rng.randint(4, 8), rng.randint(4, 8)))


def _walled(rng: random.Random) -> PlainScene:
    """A workspace the robot must stay in, cutting through some of the obstacles."""
    scene = _nonconvex(rng)
    rim = [(x + 4.0, y + 4.0) for x, y in random_star(rng, (0.0, 0.0), 6.0)[0]]
    around = moved(scaled(frame(), 2), -2, -2)
    return scene._replace(workspace=rng.choice([(rim, []), box(0, 0, 8, 7), around]))


_GENERATORS: dict[str, Callable[[random.Random], PlainScene]] = {
    "convex": _convex,
    "nonconvex": _nonconvex,
    "holed": _holed,
    "overlapping": _overlapping,
    "touching": _touching,
    "axis_parallel": _axis_parallel,
    "several_robots": _several_robots,
    "regular": _regular,
    "integer_grid": _integer_grid,
    "bounds": _bounded,
    "workspace": _walled,
}
KINDS = tuple(_GENERATORS)
