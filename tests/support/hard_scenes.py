"""Scenes made to be hard for predicates, family by family.

A scene is rings of numbers; they need not be polygons, as the predicates use vertices and edges alone.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from fractions import Fraction
from typing import Any, NamedTuple

from cfree.exact.number import to_fraction

Number = int | float | Fraction
Ring = list[tuple[Number, Number]]


class Rings(NamedTuple):
    robot: list[Ring]
    obstacles: list[Ring]

    def mapped(self, robot: Callable[..., Any], obstacles: Callable[..., Any]) -> Rings:
        return Rings(
            [[robot(to_fraction(x), to_fraction(y)) for x, y in ring] for ring in self.robot],
            [[obstacles(to_fraction(x), to_fraction(y)) for x, y in ring] for ring in self.obstacles],
        )


def lattice(rng: random.Random, size: int = 3) -> Rings:
    def ring() -> Ring:
        grid = [(x, y) for x in range(-size, size + 1) for y in range(-size, size + 1)]
        return rng.sample(grid, rng.randint(3, 5))  # type: ignore[return-value]

    return Rings([ring() for _ in range(rng.randint(1, 2))], [ring() for _ in range(rng.randint(1, 3))])


def congruent(rng: random.Random) -> Rings:
    """Obstacles are the robot under rational rigid motions and reflections: every angle of them ties."""
    robot = lattice(rng).robot[0]
    turns = [(1, 0), (0, 1), (-1, 0), (Fraction(3, 5), Fraction(4, 5)), (Fraction(-5, 13), Fraction(12, 13))]

    def image() -> Ring:
        (c, s), dx, dy = rng.choice(turns), rng.randint(-3, 3), rng.randint(-3, 3)
        return [(c * x - s * y + dx, s * x + c * y + dy) for x, y in robot]

    return Rings([robot, *([image()] if rng.random() < 0.3 else [])], [image() for _ in range(rng.randint(1, 3))])


def collinear(rng: random.Random) -> Rings:
    """Walls on a few lines, both ways; vertices that several shapes share."""

    def box() -> Ring:
        x, y = rng.sample(range(-2, 4), 2), rng.sample(range(-1, 2), 2)
        ring = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
        return ring[:: rng.choice([1, -1])]

    return Rings([box()], [box() for _ in range(rng.randint(1, 4))])


def tangent(rng: random.Random) -> Rings:
    """Circles of radius 5 about lines at distance 5, and of the like: double roots everywhere."""
    legs = [(3, 4), (4, 3), (5, 0), (0, 5), (-3, 4), (4, -3), (-4, -3), (-5, 0), (0, -5), (0, 0), (5, 5), (-5, 5)]
    return Rings([rng.sample(legs, rng.randint(3, 4))], [rng.sample(legs, rng.randint(3, 4)) for _ in range(2)])  # type: ignore[list-item]


def right_angles(rng: random.Random) -> Rings:
    """Edges along the axes and the diagonals: angles at the ends of charts and at 0."""
    legs = [(0, 0), (1, 0), (0, 1), (1, 1), (-1, 1), (2, 0), (0, 2), (-1, -1)]
    return Rings([rng.sample(legs, rng.randint(3, 4))], [rng.sample(legs, rng.randint(3, 4)) for _ in range(2)])  # type: ignore[list-item]


DEGENERATE = (lattice, congruent, collinear, tangent, right_angles)


NEARLY_NOTHING = [
    Fraction(1, 2**30),
    Fraction(1, 2**50),
    Fraction(1, 2**52),
    Fraction(1, 2**53),
    Fraction(1, 2**60),
    Fraction(1, 10**15),
    Fraction(1, 2**106),
    Fraction(1, 2**112),
    Fraction(1, 10**40),
    Fraction(1, 10**100),
    Fraction(1, 2**1000),
]


def disturbed(rng: random.Random) -> Rings:
    """A degenerate scene, some coordinates moved by nearly nothing."""
    epsilon, often = rng.choice(NEARLY_NOTHING), rng.choice([0.05, 0.25])

    def moved(x: Fraction, y: Fraction) -> Any:
        return tuple(c + rng.choice([-1, 1]) * epsilon if rng.random() < often else c for c in (x, y))

    return rng.choice(DEGENERATE)(rng).mapped(moved, moved)


def split_roots(rng: random.Random) -> Rings:
    """Circles that touch lines at rational angles, but for nearly nothing: two roots all but one, or none."""
    legs = [(3, 4), (5, 0), (0, 5), (-3, 4), (4, -3), (-4, -3)]
    c, s = rng.choice([(1, 0), (0, 1), (Fraction(3, 5), Fraction(4, 5)), (Fraction(-8, 17), Fraction(15, 17))])

    def height() -> Fraction:
        return rng.choice([-5, 5]) + rng.randint(-1, 1) * rng.choice(NEARLY_NOTHING)

    obstacles = [[(0, 0), (rng.randint(1, 3), 0), (rng.randint(-3, 3), height()), (rng.randint(-2, 2), height())]]
    rings = Rings([[(0, 0), *rng.sample(legs, 3)]], obstacles)
    if rng.random() < 0.5:
        rings = Rings(rings.obstacles, rings.robot)
    return rings.mapped(lambda x, y: (x, y), lambda x, y: (c * x - s * y, s * x + c * y))


def one_ulp(rng: random.Random) -> Rings:
    """A degenerate scene under a similarity rounded to doubles, some of them moved by one ulp."""
    scale = rng.choice([1.0, 0.1, 1e10, 1 / 3, 1e-7])
    dx, dy = rng.choice([0.0, 0.7, 1e5]), rng.choice([0.0, -0.3, 12.1])

    def double(c: float) -> float:
        return math.nextafter(c, rng.choice([-math.inf, math.inf])) if rng.random() < 0.3 else c

    def robot(x: Fraction, y: Fraction) -> Any:
        return double(float(x) * scale), double(float(y) * scale)

    def obstacles(x: Fraction, y: Fraction) -> Any:
        return double(float(x) * scale + dx), double(float(y) * scale + dy)

    return rng.choice(DEGENERATE)(rng).mapped(robot, obstacles)


def mixed_sizes(rng: random.Random) -> Rings:
    """Coordinates from 1e-100 to 1e100."""

    def size(x: Fraction, y: Fraction) -> Any:
        exponents = (rng.choice([-100, -91, -50, -17, -1, 0, 1, 16, 50, 100]) for _ in range(2))
        p, q = (c * Fraction(10) ** e for c, e in zip((x, y), exponents, strict=True))
        return p, q

    return distinct(rng.choice(DEGENERATE)(rng).mapped(size, size))


def sized_doubles(rng: random.Random) -> Rings:
    """The same with generic doubles."""

    def ring() -> Ring:
        return [
            (rng.gauss(0, 1) * 10.0 ** rng.randint(-100, 100), rng.gauss(0, 1) * 10.0 ** rng.randint(-100, 100))
            for _ in range(rng.randint(3, 4))
        ]

    return Rings([ring()], [ring() for _ in range(2)])


def small_robot(rng: random.Random) -> Rings:
    """A robot and obstacles of very different sizes, and the obstacles far away."""
    size, far = Fraction(10) ** rng.randint(-100, 100), rng.choice([0, 1, 10**20, 10**100])
    return rng.choice(DEGENERATE)(rng).mapped(lambda x, y: (x * size, y * size), lambda x, y: (x + far, y - far))


def huge_integers(rng: random.Random) -> Rings:
    """300 bits; half of the time a degenerate scene far from the origin, sheared by one unit."""

    def random_ring() -> Ring:
        return [(rng.getrandbits(300) - 2**299, rng.getrandbits(300) - 2**299) for _ in range(rng.randint(3, 4))]

    if rng.random() < 0.5:
        return Rings([random_ring()], [random_ring() for _ in range(2)])
    size, shift = 2**290 + rng.randint(-5, 5), rng.getrandbits(300)

    def moved(x: Fraction, y: Fraction) -> Any:
        return x * size + rng.choice([0, 0, 0, 1, -1]), y * size + shift

    return rng.choice(DEGENERATE)(rng).mapped(moved, moved)


def fractions(rng: random.Random) -> Rings:
    """Large denominators."""
    primes = [2**61 - 1, 2**89 - 1, 10**9 + 7, 998244353, 3**40]

    def near(x: Fraction, y: Fraction) -> Any:
        p, q = (c + Fraction(rng.randint(-1, 1), rng.choice(primes)) for c in (x, y))
        return p, q

    return rng.choice(DEGENERATE)(rng).mapped(near, near)


def near_walls(rng: random.Random) -> Rings:
    """Edges nearly parallel and nearly at right angles: angles next to 0 and to the ends of charts, on both sides."""
    epsilon = rng.choice([2.0**-26, 2.0**-50, 2.0**-52, 2.0**-53, 1e-15, 1e-16, 1e-30, 1e-100, 1e-200])

    def leg() -> tuple[Fraction, Fraction]:
        x, y = Fraction(rng.choice([-1, 1])), rng.randint(-2, 2) * Fraction(epsilon)
        return rng.choice([(x, y), (y, x), (x + y, x - y), (x, x + y)])

    def ring() -> Ring:
        x, y = Fraction(rng.randint(-1, 1)), Fraction(rng.randint(-1, 1))
        points = [(x, y)]
        while len(points) < 4:
            dx, dy = leg()
            x, y = x + dx, y + dy
            if (x, y) not in points:
                points.append((x, y))
        return points  # type: ignore[return-value]

    return Rings([ring()], [ring(), ring()])


def turned_far(rng: random.Random) -> Rings:
    """A degenerate scene turned by a rational of 5 to 40 digits, with origin and reference point far away."""
    p, q = (rng.randrange(10 ** rng.randint(4, 40)) + 1 for _ in range(2))
    c, s, w = q * q - p * p, 2 * p * q, p * p + q * q
    x0, y0 = rng.choice([(0, 0), (10**9, -(10**9)), (2**40, Fraction(1, 3))])
    dx, dy = rng.choice([(0, 0), (100, -60), (10**6, 1)])
    with_robot = rng.random() < 0.5

    def turned(x: Fraction, y: Fraction) -> tuple[Fraction, Fraction]:
        return (c * x - s * y) / w, (s * x + c * y) / w

    def world(x: Fraction, y: Fraction) -> Any:
        u, v = turned(x, y)
        return u + x0, v + y0

    def body(x: Fraction, y: Fraction) -> Any:
        return turned(x + dx, y + dy) if with_robot else (x + dx, y + dy)

    return rng.choice(DEGENERATE)(rng).mapped(body, world)


def distinct(rings: Rings) -> Rings:
    """Drop vertices that fell together; a ring of fewer than three becomes a triangle."""

    def part(those: list[Ring]) -> list[Ring]:
        unique = [list(dict.fromkeys(ring)) for ring in those]
        return [ring if len(ring) > 2 else [(0, 0), (1, 0), (0, 1)] for ring in unique]

    return Rings(part(rings.robot), part(rings.obstacles))


FAMILIES: dict[str, Callable[[random.Random], Rings]] = {
    make.__name__: make
    for make in (
        *DEGENERATE,
        disturbed,
        split_roots,
        one_ulp,
        mixed_sizes,
        sized_doubles,
        small_robot,
        huge_integers,
        fractions,
        near_walls,
        turned_far,
    )
}
