"""Angles for slices: those where something happens, in the file or by the scene alone, and generic ones.

An exact fit at one angle leaves no other trace in a file if it is lost. It needs two lines of contact that are one.
Either an edge of the robot is parallel to one of the obstacles, or two parallel edges of one of them face each other
across two vertices of the other.
"""

from __future__ import annotations

import random
from collections import defaultdict
from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import product
from typing import Any

import numpy as np

from cfree.exact.algebraic import between, roots
from cfree.verify.polygons import Corner, primitive, shortest
from cfree.verify.surfaces import ZERO, Fault, Form, Surface, Turn, Vector, cross, dot, minus, polynomial
from cfree.verify.trapezoids import Reader
from cfree.verify.world import World

LIMIT = 300  # of each kind, in large scenes


def orientation(reader: Reader, seed: int, number: int) -> Turn:
    """Critical angle for even numbers, each once before any twice; for odd ones any, or just after a critical one."""
    rng = random.Random(f"{seed} {number}")
    if number % 4 == 1:
        return anywhere(rng)
    if number % 4 == 3:
        return just_after_a_critical_angle(reader, rng)
    k, likely = number // 2, likely_angles(reader)
    if k < len(likely):
        return likely[k]
    critical = critical_angles(reader, seed)
    return critical[k % len(critical)]


def anywhere(rng: random.Random) -> Turn:
    return Turn.of(rng.randrange(2), Fraction(rng.randrange(-(1 << 16), 1 << 16) * 2 + 1, 1 << 17))


def just_after_a_critical_angle(reader: Reader, rng: random.Random) -> Turn:
    """Rational angle between two neighbouring critical angles, if doubles hold them apart."""
    t = reader.table
    if not len(t):
        return anywhere(rng)
    k = rng.randrange(len(t))
    chart, lo = int(t.chart[k]), float(t.from_hi[k])
    later = np.concatenate([ends[(t.chart == chart) & (ends > lo)] for ends in (t.from_lo, t.to_lo)])
    return Turn.of(chart, between(Fraction(lo), Fraction(float(later.min())))) if len(later) else anywhere(rng)


@lru_cache(maxsize=1)
def likely_angles(reader: Reader) -> list[Turn]:
    """Angles of the file's isolated parts, and right angles."""
    turns = angles_of(reader, reader.isolated, range(len(reader.isolated)))
    turns += [Turn.of(chart, Fraction(tau)) for chart in (0, 1) for tau in (0, 1)]
    return list({turn.key: turn for turn in turns}.values())


@lru_cache(maxsize=1)
def critical_angles(reader: Reader, seed: int) -> list[Turn]:
    """Likely angles first; then others, of file and scene, shuffled."""
    rng = random.Random(seed)
    others = angles_of(reader, reader.table, some(rng, range(len(reader.table))))
    for form in sorted({*parallel(reader.world, rng), *facing(reader.world, rng)}):
        for chart in (0, 1):
            if any(form):
                others += [Turn(chart, root) for root, _ in roots(polynomial(form, chart), Fraction(-1), Fraction(1))]
    rng.shuffle(others)
    return list({turn.key: turn for turn in likely_angles(reader) + others}.values())


def angles_of(reader: Reader, columns: Any, rows: Sequence[int]) -> list[Turn]:
    """Critical angles of trapezoids or isolated parts."""
    turns = []
    for k, end in product(rows, ("from", "to")):
        patch = int(getattr(columns, f"{end}_patch", columns.patch)[k])
        try:
            turns.append(Turn(int(columns.chart[k]), reader.angle(columns, k, end, patch)))
        except (Fault, IndexError):
            continue  # reported where it is checked
    return turns


def parallel(world: World, rng: random.Random) -> list[Form]:
    """Angles at which an edge of the robot is parallel to one of the obstacles or bounds."""
    robot = sorted({primitive(minus(q, p)) for _, p, q in world.robot_corners})
    obstacles = sorted({primitive(minus(q, p)) for _, p, q in world.obstacle_corners + world.bound_corners})
    return [(0, cross(g, f), -dot(g, f)) for g, f in some(rng, list(product(robot, obstacles)))]


def facing(world: World, rng: random.Random) -> list[Form]:
    """Angles at which two lines of contact are one: those of opposite edges of the obstacles, or of the robot."""
    robot, others = world.robot_corners, world.obstacle_corners + world.bound_corners
    pairs = [
        (Surface(a, ZERO, b, minus(end, b)), Surface(a2, ZERO, b2, ZERO))
        for (b, end, b2), (a, a2) in opposite(others, [*robot, (ZERO, ZERO, ZERO)], rng)
    ]
    pairs += [
        (Surface(a, minus(end, a), b, ZERO), Surface(a2, ZERO, b2, ZERO))
        for (a, end, a2), (b, b2) in opposite(robot, world.obstacle_corners, rng)
    ]
    return [first.form(minus(second.b, first.b), minus(second.a, first.a)) for first, second in pairs]


def opposite(edges: list[Corner], others: list[Corner], rng: random.Random) -> Sequence[Any]:
    """An edge, the start of one that runs the other way, and two vertices of the others."""
    directed: dict[Vector, list[Corner]] = defaultdict(list)
    for edge in edges:
        directed[shortest(minus(edge[2], edge[1]))].append(edge)
    facing = [
        (p, q, other)
        for _, p, q in some(rng, edges)
        for _, other, _ in some(rng, directed.get(shortest(minus(p, q)), []))
    ]
    vertices = some(rng, [point for _, point, _ in others])
    return some(rng, list(product(some(rng, facing), some(rng, list(product(vertices, repeat=2))))))


def some(rng: random.Random, items: Sequence[Any]) -> Sequence[Any]:
    return items if len(items) <= LIMIT else rng.sample(items, LIMIT)
