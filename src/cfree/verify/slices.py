"""Is anything missing? The contact segments at one rational angle, computed from scratch, against the file's.

At a fixed angle a contact is a segment, and a pair of convex pieces forbids the inside of a convex polygon, the pillar
O_k (+) -R A_p. What the open pillars leave of all segments is the boundary of the forbidden slice. Segments on one line
with one direction are united. A part of no length is left out: the trapezoids of a file are two-dimensional.
"""

from __future__ import annotations

import math
import random
from collections import defaultdict
from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import pairwise

import numpy as np

from cfree.verify.algebra import between
from cfree.verify.surfaces import Fault, Turn, Vector, cross, dot, minus
from cfree.verify.trapezoids import Reader
from cfree.verify.world import Ring, World, boxes, corners, near

Interval = tuple[Fraction, Fraction]
Line = tuple[Vector, int]  # primitive direction, and its cross product with w times any point of the line
Segments = dict[Line, list[Interval]]  # positions: the direction's dot product with w times a point


def compared(reader: Reader, seed: int, number: int) -> tuple[Turn, int, list[tuple[str, str]]]:
    """A random slice of scene and file: its angle, the number of its segments, and where the two differ."""
    rng = random.Random(f"{seed} {number}")
    while True:
        turn = just_after_a_critical_angle(reader, rng) if number % 2 else anywhere(rng)
        true = segments_of_scene(reader.world, turn)
        found = segments_of_file(reader, turn)
        if true is not None and found is not None:
            break
    wrong = []
    for line in true.keys() | found.keys():
        ours, theirs = united(true.get(line, [])), sorted(found.get(line, []))
        if any(p[1] > q[0] for p, q in pairwise(theirs)):
            wrong.append((place(line, theirs, turn, reader.world), "trapezoids on one another"))
        elif united(theirs) != ours:
            sizes = [total(line, intervals, turn, reader.world) for intervals in (ours, theirs)]
            text = "length {:.6g} of the line is boundary, {:.6g} in the file".format(*sizes)
            wrong.append((place(line, ours or theirs, turn, reader.world), text))
    return turn, sum(map(len, true.values())), sorted(wrong)


def anywhere(rng: random.Random) -> Turn:
    return Turn.of(rng.randrange(2), Fraction(rng.randrange(-(1 << 16), 1 << 16) * 2 + 1, 1 << 17))


def just_after_a_critical_angle(reader: Reader, rng: random.Random) -> Turn:
    """Between two neighbouring critical angles, if doubles hold them apart."""
    t = reader.table
    if not len(t):
        return anywhere(rng)
    k = rng.randrange(len(t))
    chart, lo = int(t.chart[k]), float(t.from_hi[k])
    later = np.concatenate([ends[(t.chart == chart) & (ends > lo)] for ends in (t.from_lo, t.to_lo)])
    return Turn.of(chart, between(Fraction(lo), Fraction(float(later.min())))) if len(later) else anywhere(rng)


def segments_of_scene(world: World, turn: Turn) -> Segments | None:
    """The boundary of the forbidden slice from contacts and convex pieces; None if edges are parallel."""
    w = turn.w
    parts = [[(-u, -v) for u, v in map(turn, part)] for part in world.parts]
    walls = [[(w * u, w * v) for u, v in wall] for wall in world.walls]
    pillars = [pillar(wall, part) for wall in walls for part in parts]
    pillars += [[(w * u, w * v) for u, v in ring] for ring in world.beyond]
    around = boxes(pillars, w * world.scale)
    found: Segments = defaultdict(list)
    for surface in world.contacts():
        limits = [turn.value(limit) for limit in surface.limits]
        if max(limits, default=-1) > 0:
            continue
        if 0 in limits:
            return None
        start, along = turn.start(surface), turn.along(surface)
        (box,) = boxes([[start, (start[0] + along[0], start[1] + along[1])]], w * world.scale)
        covered = [interval for k in near(around, box) for interval in crossing(pillars[k], start, along)]
        line = Positions(start, along)
        found[line.key] += [(line.at(p), line.at(q)) for p, q in left_over(covered)]
    return {key: united(intervals) for key, intervals in found.items() if intervals}


def segments_of_file(reader: Reader, turn: Turn) -> Segments | None:
    """The trapezoids at one angle; None if one of them begins or ends there."""
    t, tau = reader.table, turn.tau
    close = np.flatnonzero((t.chart == turn.chart) & (t.from_lo <= float(tau)) & (float(tau) <= t.to_hi))
    found: Segments = defaultdict(list)
    for k in close.tolist():
        patch = int(t.patch[k])
        try:
            surface = reader.surface(patch)
            sides = []
            for end in ("from", "to"):
                lo, hi = Fraction(float(getattr(t, f"{end}_lo")[k])), Fraction(float(getattr(t, f"{end}_hi")[k]))
                if lo <= tau <= hi:
                    angle = reader.angle(k, end, surface, turn.chart)
                    while angle.lo <= tau <= angle.hi and angle.lo < angle.hi:
                        angle.narrow()
                    lo, hi = angle.lo, angle.hi
                sides.append((tau > hi) - (tau < lo))
            if 0 in sides:
                return None
            if sides == [1, -1]:
                lower, upper = (reader.curve(patch, turn.chart, int(code)).at(tau) for code in (t.lower[k], t.upper[k]))
                line = Positions(turn.start(surface), turn.along(surface))
                found[line.key].append((line.at(lower), line.at(upper)))
        except (Fault, IndexError):
            continue  # reported where trapezoids are checked; the slice will differ as well
    return found


class Positions:
    """Points of a directed line, w times the real ones, by their dot product with its primitive direction."""

    def __init__(self, start: Vector, along: Vector) -> None:
        k = math.gcd(*along)
        direction = along[0] // k, along[1] // k
        self.key: Line = direction, cross(direction, start)
        self.start, self.along = dot(direction, start), dot(direction, along)

    def at(self, t: Fraction) -> Fraction:
        return self.start + t * self.along


def pillar(wall: Ring, part: Ring) -> Ring:
    """Sum of two convex polygons: their edges merged by direction."""
    p, q = (turned_to_lowest(ring) for ring in (wall, part))
    u, v = ([minus(end, start) for _, start, end in corners(ring)] for ring in (p, q))
    i = j = 0
    found = []
    while i < len(u) or j < len(v):
        x, y = p[i % len(p)], q[j % len(q)]
        found.append((x[0] + y[0], x[1] + y[1]))
        order = -1 if i == len(u) else 1 if j == len(v) else cross(u[i], v[j])
        i, j = i + (order >= 0), j + (order <= 0)
    return found


def turned_to_lowest(ring: Ring) -> Ring:
    k = min(range(len(ring)), key=lambda k: (ring[k][1], ring[k][0]))
    return ring[k:] + ring[:k]


def crossing(pillar: Ring, start: Vector, along: Vector) -> Iterator[Interval]:
    """The open interval of t, if any, at which a line is inside a convex polygon; none outside [0, 1]."""
    lo, hi = Fraction(0), Fraction(1)
    for _, p, q in corners(pillar):
        u = minus(q, p)
        height, slope = cross(u, minus(start, p)), cross(u, along)  # inside: height + t slope > 0
        if height <= 0 and height + slope <= 0:
            return
        if slope > 0:
            lo = max(lo, Fraction(-height, slope))
        elif slope < 0:
            hi = min(hi, Fraction(-height, slope))
    if lo < hi:
        yield lo, hi


def left_over(covered: Iterable[Interval]) -> Iterator[Interval]:
    """[0, 1] without open intervals; parts of no length are left out."""
    at = Fraction(0)
    for lo, hi in sorted(covered):
        if lo > at:
            yield at, lo
        at = max(at, hi)
    if at < 1:
        yield at, Fraction(1)


def united(intervals: Iterable[Interval]) -> list[Interval]:
    result: list[Interval] = []
    for lo, hi in sorted(intervals):
        if result and lo <= result[-1][1]:
            result[-1] = result[-1][0], max(hi, result[-1][1])
        else:
            result.append((lo, hi))
    return result


def total(line: Line, intervals: Iterable[Interval], turn: Turn, world: World) -> float:
    return float(sum(q - p for p, q in intervals) / (turn.w * world.scale)) / math.hypot(*line[0])


def place(line: Line, intervals: list[Interval], turn: Turn, world: World) -> str:
    """Where a line's first interval begins, in the scene's coordinates, rounded."""
    (u, v), offset = line
    along, size = intervals[0][0], (u * u + v * v) * turn.w * world.scale
    x, y = (u * along - v * offset) / size, (v * along + u * offset) / size
    return f"tau {turn.tau} in chart {turn.chart}, near ({float(x):.6g}, {float(y):.6g})"
