"""Homology of cells over GF(2) from slices in doubles, by the sequence of Mayer and Vietoris.

The free space is made of planar slices, each thick in theta, that meet in the overlaps of neighbours. Slices are taken
on both sides of every critical angle, and so many between two of them that neighbours have the same components and
holes. It shares nothing with the package but the critical angles.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from functools import cache
from itertools import pairwise
from typing import NamedTuple

import shapely

import oracles
from shapes import PlainScene

NEAR = 2e-6  # distance of slices from a critical angle
THIN = 2e-5  # narrower parts of an overlap at a critical angle are not counted
ROUNDED, SLIVER = 1e-11, 1e-13
MOST = 40  # halvings between two critical angles


class Unclear(Exception):
    """A case too close for doubles."""


class Meeting(NamedTuple):
    """An overlap of two slices: its parts with their numbers in both, and the holes that their inner rings surround."""

    parts: list[tuple[int, int]]
    rings: list[tuple[int, frozenset[int], frozenset[int]]]  # part, holes of the one, and holes of the other slice


class Planar(NamedTuple):
    """A slice: its parts, and a point in each of their holes with the number of the part."""

    parts: list[shapely.Polygon]
    holes: list[tuple[int, shapely.Point]]


def sliced_homology(plain: PlainScene, angles: Sequence[float]) -> Counter[tuple[int, int, int]]:
    """Numbers of cells by their Betti numbers, in a scene with bounds or a workspace."""
    ends = sorted({a % math.tau for a in angles})
    ends = [a for k, a in enumerate(ends) if k == 0 or a - ends[k - 1] > 1e-9]
    if len(ends) > 1 and min(b - a for a, b in pairwise([*ends, ends[0] + math.tau])) < 20 * NEAR:
        raise Unclear

    @cache
    def cut(theta: float) -> Planar:
        region = oracles.free_slice(plain.robot, plain.obstacles, theta, plain.bounds, plain.workspace)
        parts = _polygons(shapely.buffer(region, -ROUNDED))
        holes = [(k, shapely.Polygon(ring).representative_point()) for k, p in enumerate(parts) for ring in p.interiors]
        return Planar(parts, holes)

    def joined(a: float, b: float, depth: int = 0) -> list[float]:
        """Return angles from a on, before b, neighbours of which have the same topology."""
        if _is_same(meeting(cut(a), cut(b), ROUNDED), cut(a), cut(b)):
            return [a]
        if depth == MOST:
            raise Unclear
        middle = (a + b) / 2
        return [*joined(a, middle, depth + 1), *joined(middle, b, depth + 1)]

    thetas, thin = list[float](), list[float]()
    for a, b in pairwise([*ends, ends[0] + math.tau]):
        inner = [*joined(a + NEAR, b - NEAR), b - NEAR]
        thetas += inner
        thin += [ROUNDED] * (len(inner) - 1) + [THIN]
    slices = [cut(theta) for theta in thetas]
    count = len(slices)
    meetings = [meeting(slices[k], slices[(k + 1) % count], thin[k]) for k in range(count)]
    return _cells(slices, meetings)


def meeting(one: Planar, other: Planar, thin: float) -> Meeting:
    parts, rings = list[tuple[int, int]](), list[tuple[int, frozenset[int], frozenset[int]]]()
    for i, p in enumerate(one.parts):
        for j, q in enumerate(other.parts):
            if p.intersects(q):
                for part in _polygons(shapely.buffer(p & q, -thin)):
                    for ring in part.interiors:
                        inside = shapely.Polygon(ring)
                        holes = [
                            frozenset(n for n, (m, x) in enumerate(planar.holes) if m == k and inside.contains(x))
                            for planar, k in ((one, i), (other, j))
                        ]
                        rings.append((len(parts), holes[0], holes[1]))
                    parts.append((i, j))
    return Meeting(parts, rings)


def _is_same(both: Meeting, one: Planar, other: Planar) -> bool:
    """True if each part and each hole of one slice goes on as one of the other."""
    pairs = (both.parts, one.parts, other.parts)
    if len({*map(len, pairs)}) > 1 or any(len({pair[k] for pair in both.parts}) < len(both.parts) for k in (0, 1)):
        return False
    if not len(both.rings) == len(one.holes) == len(other.holes):
        return False
    return all(
        all(len(ring[k]) == 1 for ring in both.rings) and len({ring[k] for ring in both.rings}) == len(both.rings)
        for k in (1, 2)
    )


def _cells(slices: list[Planar], meetings: list[Meeting]) -> Counter[tuple[int, int, int]]:
    count = len(slices)
    nodes = [(k, m) for k, planar in enumerate(slices) for m in range(len(planar.parts))]
    above = {node: node for node in nodes}

    def root(x: tuple[int, int]) -> tuple[int, int]:
        while above[x] != x:
            x = above[x]
        return x

    zero: list[tuple[tuple[int, int], set[object]]] = []  # a part of a meeting, and its boundary
    one: list[tuple[tuple[int, int], set[object]]] = []
    for k, both in enumerate(meetings):
        after = (k + 1) % count
        for i, j in both.parts:
            above[root((k, i))] = root((after, j))
            zero.append(((k, i), {(k, i)} ^ {(after, j)}))
        for part, holes, others in both.rings:
            one.append(((k, both.parts[part][0]), {(k, h) for h in holes} ^ {(after, h) for h in others}))
    roots = {root(node) for node in nodes}
    result = Counter[tuple[int, int, int]]()
    for cell in roots:
        parts = [node for node in nodes if root(node) == cell]
        holes = sum(root((k, m)) == cell for k, planar in enumerate(slices) for m, _ in planar.holes)
        columns = [[set(column) for node, column in table if root(node) == cell] for table in (zero, one)]
        ranks = [rank(table) for table in columns]
        b0 = len(parts) - ranks[0]
        b1 = holes - ranks[1] + len(columns[0]) - ranks[0]
        result[b0, b1, len(columns[1]) - ranks[1]] += 1
    return result


def rank(columns: list[set[object]]) -> int:
    """Rank over GF(2) of columns, each the set of its ones."""
    by_pivot: dict[object, set[object]] = {}
    for column in columns:
        while column:
            pivot = max(column)  # type: ignore[type-var]
            if pivot not in by_pivot:
                by_pivot[pivot] = column
                break
            column = column ^ by_pivot[pivot]
    return len(by_pivot)


def _polygons(region: shapely.Geometry) -> list[shapely.Polygon]:
    return [p for p in shapely.get_parts(region).tolist() if isinstance(p, shapely.Polygon) and p.area > SLIVER]
