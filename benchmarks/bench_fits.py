"""Exact fits and near ones: seconds of processor time, on one core, of every step from a scene to a checked answer.

Polygons in their own holes, plates under arcades, doors with round tops in walls of such openings, combs and gears: at
rational places on circles and in floats, as they are and turned, with gaps of 0 and 2^-k.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import pairwise

from measure import Report

import cfree
import cfree.verify

AT_MOST = 5.0  # seconds
STEPS = ("boundary", "free space", "plan", "verify")
Ring = list[tuple[Fraction, Fraction]]
FRAME = [(-2, -2), (2, -2), (2, 2), (-2, 2)]


def run(quick: bool) -> Report:
    report = Report(
        "Exact fits and near ones, one thread", ("family", "scenes", *(f"{step} s, median (worst)" for step in STEPS))
    )
    for name, sizes, make in FAMILIES:
        chosen = sizes[:1] if quick else sizes
        rows = [seconds(scene) for size in chosen for scene in variants(make, size)]
        columns = list(zip(*rows, strict=True))
        report.rows.append((
            f"{name} {', '.join(map(str, chosen))}", str(len(rows)),
            *(f"{statistics.median(column):.2g} ({max(column):.2g})" for column in columns),
        ))  # fmt: skip
        for step, column in zip(STEPS, columns, strict=True):
            report.figure(f"{step}, the slowest scene", name, max(column), "<=", AT_MOST, " s")
    return report


def seconds(scene: cfree.Scene) -> list[float]:
    """Of each step."""
    clock, times = time.process_time, [time.process_time()]
    boundary = cfree.boundary(scene, threads=1)
    times.append(clock())
    cfree.free_space(boundary)
    times.append(clock())
    answer = cfree.plan(scene)
    times.append(clock())
    assert cfree.verify.answer(scene, answer).verified
    times.append(clock())
    return [last - first for first, last in pairwise(times)]


def variants(make: Callable[[int, bool, Fraction], cfree.Scene], size: int) -> Iterator[cfree.Scene]:
    for exact in (True, False):
        for gap in (Fraction(0), Fraction(1, 2**20), Fraction(1, 2**60)):
            yield make(size, exact, gap)


def arc(count: int, first: float, last: float, exact: bool) -> Ring:
    """Places on the unit circle, both ends included; ends at 0 and pi are there exactly."""
    places = []
    for k in range(count):
        angle = first + (last - first) * k / (count - 1)
        half = math.remainder(angle, math.tau) / 2
        if math.isclose(abs(half), math.pi / 2):
            places.append((Fraction(-1), Fraction(0)))
        elif exact or half == 0:
            tau = Fraction(round(1000 * math.tan(half)), 1000)
            places.append(((1 - tau**2) / (1 + tau**2), 2 * tau / (1 + tau**2)))
        else:
            places.append((Fraction(math.cos(angle)), Fraction(math.sin(angle))))
    return places


def grown(ring: Ring, gap: Fraction) -> Ring:
    return [(x * (1 + gap), y * (1 + gap)) for x, y in ring]


def in_its_hole(ring: Ring, gap: Fraction) -> cfree.Scene:
    frame = cfree.Polygon(FRAME, [grown(ring, gap)[::-1]])
    ends = {"start": cfree.Pose(0, 0), "goal": cfree.Pose("7/2", "7/2")}
    return cfree.Scene(ring, [frame], bounds=(-5, -5, 5, 5), **ends)


def polygon(count: int, exact: bool, gap: Fraction) -> cfree.Scene:
    """A regular polygon, nearly."""
    return in_its_hole(arc(count + 1, 0.1, 0.1 + math.tau, exact)[:-1], gap)


def gear(teeth: int, exact: bool, gap: Fraction) -> cfree.Scene:
    ring = arc(4 * teeth + 1, 0.05, 0.05 + math.tau, exact)[:-1]
    return in_its_hole([(x * r, y * r) for k, (x, y) in enumerate(ring) for r in [Fraction(4 - k % 4 // 2, 4)]], gap)


def arcade(arches: int, exact: bool, gap: Fraction) -> cfree.Scene:
    """A plate with round tops side by side, in a recess of its shape that is open below."""
    one = arc(5, 0, math.pi, exact)
    top = [(x + 2 * k + 1, y) for k in range(arches - 1, -1, -1) for x, y in one[k < arches - 1 :]]
    wide = 2 * arches
    block = [(-1, -1), (-1, 3), (wide + 1, 3), (wide + 1, -1), (wide + gap, -1), (wide + gap, gap)]
    block += [*((x, y + gap) for x, y in top[1:-1]), (-gap, gap), (-gap, -1)]
    ends = {"start": cfree.Pose(0, 0), "goal": cfree.Pose(1, -5)}
    return cfree.Scene([(0, -1), (wide, -1), *top], [block], bounds=(-2, -9, wide + 2, 4), **ends)


def doors(count: int, exact: bool, gap: Fraction) -> cfree.Scene:
    """From one opening with a round top to the last of a wall of them, which is as wide and as high."""
    top = arc(8, 0, math.pi, exact)
    wall = [(-2, -2), (-2, 3), (4 * count - 2, 3), (4 * count - 2, -2)]
    for x in range(4 * count - 4, -1, -4):
        wall += [(x + 1 + gap, -2), *((x + a, b) for a, b in grown(top, gap)), (x - 1 - gap, -2)]
    ends = {"start": cfree.Pose(0, 0), "goal": cfree.Pose(4 * count - 4, 0)}
    return cfree.Scene([(-1, -2), (1, -2), *top], [wall], bounds=(-3, -6, 4 * count, 4), **ends)


def comb(teeth: int, _: bool, gap: Fraction) -> cfree.Scene:
    """A comb between the teeth of another."""
    robot = [(0, -1), (2 * teeth - 1, -1)]
    block = [(-1, 0), (-1, 4), (2 * teeth, 4), (2 * teeth, 0)]
    for x in range(2 * teeth - 2, -1, -2):
        robot += [(x + 1, 0), (x + 1, 2), (x, 2), (x, 0)]
        block += [(x + 1 + gap, 0), (x + 1 + gap, 2 + gap), (x - gap, 2 + gap), (x - gap, 0)]
    robot = [place for place in robot if place not in ((0, 0), (2 * teeth - 1, 0))]
    ends = {"start": cfree.Pose(0, 0), "goal": cfree.Pose(0, -5)}
    return cfree.Scene(robot, [block], bounds=(-2, -8, 2 * teeth + 1, 5), **ends)


FAMILIES = (
    ("polygon in its hole", (5, 12, 24, 60), polygon),
    ("gear in its hole", (4, 12), gear),
    ("plate under an arcade", (1, 4, 10), arcade),
    ("wall of doors", (2, 10), doors),
    ("comb in a comb", (2, 10), comb),
)
