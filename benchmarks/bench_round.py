"""Shapes of segments and circular arcs, decided on themselves: poses beside 32-gons, and questions of exact touch.

Poses: a car with rounded corners among 100 discs, beside the same with 32-gons; the processor's time, in turns.
Boundaries on one thread: a rounded triangle among triangles, beside the same with 28 and 100 directions in place of its
disc; half discs and lenses among themselves, in milliseconds.
Questions: touches, exact fits, and gaps that are just wide enough; each has an answer. Then the shipped scenes: their
first paths, or proofs.

    python benchmarks/run.py round
    python benchmarks/bench_round.py            # the questions and scenes alone, also for a commit without this file
"""

from __future__ import annotations

import gc
import math
import random
import statistics
import time
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import shapely

import cfree
from cfree import Curved
from cfree.curves import Arc, Circle

ROUNDS, POSES, EDGES = 5, 20_000, 32
CORE = [("-0.5", "-0.5"), ("1", "-0.2"), ("-0.2", "0.8")]
RADIUS = 0.2
GONS = {28: 0.7, 100: 0.1}
TURNS = [
    (Fraction(x, z), Fraction(y, z)) for x, y, z in ((1, 0, 1), (3, 4, 5), (-20, 21, 29), (-5, -12, 13), (8, -15, 17))
]
SCENES = Path(__file__).parents[1] / "examples" / "scenes"


def run(quick: bool) -> Any:
    from measure import Report

    report = Report("Segments and arcs", ("question", "answer", "ms"), notes=["ms of the processor"])
    count = POSES // 20 if quick else POSES
    report.figure("poses among discs, to 32-gons", f"{count} poses", poses_ratio(count), "<=", 1)
    for sides, target in GONS.items():
        ratio = boundary_ratio(12, sides, 3 if quick else 15)
        report.figure("boundary of a rounded robot, to that of polygons", f"{sides} directions", ratio, "<=", target)
    for name, scene in (
        ("boundary, rounded robot among 60", cfree.Scene(Curved(CORE, grown=str(RADIUS)), triangles(60))),
        (
            "boundary, half disc among 12 arcs",
            cfree.Scene(half_disc(Fraction(0), Fraction(0), Fraction(3, 5)), arcs(12)),
        ),
    ):
        found = [boundary_seconds(scene) for _ in range(1 if quick else ROUNDS)]
        report.rows.append((name, "", f"{1e3 * statistics.median(found):.0f}"))
    for name, query in questions():
        seconds, answer = planned(query)
        report.rows.append((name, answer, f"{1e3 * seconds:.0f}"))
    return report


def boundary_ratio(count: int, sides: int, rounds: int) -> float:
    """Time of a rounded robot's boundary to that of a polygon with `sides` directions for its disc: median of pairs."""
    gon = shapely.Polygon([(RADIUS * c, RADIUS * s) for c, s in around(sides)])
    corners = shapely.MultiPoint([(float(x) + u, float(y) + v) for x, y in CORE for u, v in gon.exterior.coords[1:]])
    polygon = [(round(x, 9), round(y, 9)) for x, y in shapely.orient_polygons(corners.convex_hull).exterior.coords[1:]]
    scenes = [cfree.Scene(robot, triangles(count)) for robot in (Curved(CORE, grown=str(RADIUS)), polygon)]
    pairs = [[boundary_seconds(scene) for scene in scenes] for _ in range(rounds + 1)][1:]
    return statistics.median(first / second for first, second in pairs)


def boundary_seconds(scene: cfree.Scene) -> float:
    fresh = cfree.Scene(scene.robot, scene.obstacles)
    gc.collect()
    begin = time.process_time()
    cfree.boundary(fresh, threads=1)
    return time.process_time() - begin


def triangles(count: int) -> list[list[tuple[float, float]]]:
    rng, side, found = random.Random(0), 3 * math.sqrt(count), list[list[tuple[float, float]]]()
    while len(found) < count:
        x, y, size = rng.uniform(0, side), rng.uniform(0, side), rng.uniform(0.6, 1.4)
        angles = sorted(rng.uniform(0, math.tau) for _ in range(3))
        ring = [(round(x + size * math.cos(a), 3), round(y + size * math.sin(a), 3)) for a in angles]
        if shapely.Polygon(ring).area > 0.3:
            found.append(ring)
    return found


def half_disc(x: Fraction, y: Fraction, r: Fraction, turn: tuple[Fraction, Fraction] = TURNS[0]) -> Curved:
    c, s = turn
    return Curved([(x - r * s, y + r * c), Arc((x + r * s, y - r * c), center=(x, y))])


def lens(x: Fraction, y: Fraction, size: Fraction, turn: tuple[Fraction, Fraction]) -> Curved:
    """Two arcs over one chord."""

    def at(a: int, b: int) -> tuple[Fraction, Fraction]:
        return x + size * (turn[0] * a - turn[1] * b), y + size * (turn[1] * a + turn[0] * b)

    return Curved([at(-4, 0), Arc(at(4, 0), center=at(0, 3)), Arc(at(-4, 0), center=at(0, -3))])


def arcs(count: int) -> list[Curved]:
    rng, side, found = random.Random(0), 3 * math.sqrt(count), list[Curved]()
    for k in range(count):
        x, y = (Fraction(round(1000 * rng.uniform(0, side)), 1000) for _ in range(2))
        turn = rng.choice(TURNS)
        if k % 2:
            found.append(half_disc(x, y, Fraction(rng.randint(5, 11), 10), turn))
        else:
            found.append(lens(x, y, Fraction(rng.randint(12, 25), 100), turn))
    return found


def poses_ratio(count: int) -> float:
    """Time to decide poses of a car with rounded corners among 100 discs, to that of 32-gons; the median of pairs."""
    rng = np.random.default_rng(1)
    places = [(10 * (k % 10) + 3 * math.sin(k), 10 * (k // 10) + 3 * math.cos(k)) for k in range(100)]
    discs = [Curved.circle((round(x, 3), round(y, 3)), "3/2") for x, y in places]
    car = Curved([("-1.5", "-0.4"), ("1.5", "-0.4"), ("1.5", "0.4"), ("-1.5", "0.4")], grown="1/2")
    round_scene = cfree.Scene(car, discs)
    gons = cfree.Scene(
        [ring(car.outer(1e-3)[0].vertices)],
        [[(round(x + 1.5 * c, 6), round(y + 1.5 * s, 6)) for c, s in around()] for x, y in places],
    )
    rows = np.column_stack([rng.uniform(-5, 100, (count, 2)), rng.uniform(0, math.tau, count)])
    ratios = []
    for scene in (round_scene, gons):
        cfree.is_free(scene, rows[:10])
    for _ in range(ROUNDS):
        seconds = []
        for scene in (round_scene, gons):
            begin = time.process_time()
            cfree.is_free(scene, rows)
            seconds.append(time.process_time() - begin)
        ratios.append(seconds[0] / seconds[1])
    return statistics.median(ratios)


def around(edges: int = EDGES) -> list[tuple[float, float]]:
    return [(math.cos(math.tau * k / edges), math.sin(math.tau * k / edges)) for k in range(edges)]


def ring(vertices: Any) -> list[tuple[float, float]]:
    return [(float(x), float(y)) for x, y in vertices]


def box(x0: Any, y0: Any, x1: Any, y1: Any) -> list[tuple[Any, Any]]:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def slanted(width: Fraction) -> list[tuple[Fraction, Fraction]]:
    half = width / 2
    points = [(-9, -4), (-3, -4), (-3, -half), (3, -half), (3, -4), (9, -4)]
    points += [(-x, -y) for x, y in points]
    return [(Fraction(4 * x - 3 * y) / 5, Fraction(3 * x + 4 * y) / 5) for x, y in points]  # type: ignore[arg-type]


def questions() -> Iterator[tuple[str, Any]]:
    """Yield names, and a scene with its start and goal, and options."""
    disc = Curved.circle((0, 0), 1)
    floor, above = box(-9, -9, 9, -1), Curved.circle((0, 3), 2)
    yield "disc on a floor, under a disc", ends(disc, [floor, above], (0, 0, 0), (5, 5, 0))
    arcs = Arc((1, 1), center=(1, 0)), Arc((-1, -1), center=(-1, 0))
    stadium = Curved([(-1, -1), (1, -1), arcs[0], (-1, 1), arcs[1]])
    corridor = [(-9, -4), (-3, -4), (-3, -1), (3, -1), (3, -4), (9, -4)]
    corridor += [(-x, -y) for x, y in corridor]
    yield "stadium through a corridor of its width", ends(stadium, [], (-6, 1, 0), (6, -1, 0), corridor)
    turned, (x, y) = {"tau": "1/3"}, (Fraction(24, 5), Fraction(18, 5))
    start, goal = (-x, -y, turned), (x, y, turned)
    for width in ("1.501", "1.5"):
        scene = cfree.Scene(box(-1, "-1/2", 1, "1/2"), workspace=slanted(Fraction(width)))
        yield f"clearance 1/4, slanted corridor {width} wide", (scene, start, goal, {"clearance": "1/4"})
    for radius in ("0.499999", "0.5"):
        pillars = [Curved.circle((2 * i, 2 * j), "1/2") for i in range(4) for j in range(4)]
        scene = cfree.Scene(Curved.circle((0, 0), radius), pillars, workspace=box(0, 0, 6, 6))
        yield f"disc {radius} between discs with gaps 1", (scene, (1, 1, 0), (5, 5, 0), {})
    bay = Arc((-2, 1), center=(-2, 0), clockwise=True)
    block = Curved([(-2, -5), (4, -5), (4, -1), (-2, -1), bay, (4, 1), (4, 5), (-8, 5), (-8, -5)])
    arcs = Arc((2, 1), center=(2, 0)), Arc((-2, -1), center=(-2, 0))
    peg = Curved([(-2, -1), (2, -1), arcs[0], (-2, 1), arcs[1]])
    yield "peg in a round slot of its radius", ends(peg, [block], (0, 0, 0), (12, 1, 1))
    half = Curved([(0, -2), Arc((0, 2), center=(0, 0))])
    yield (
        "half disc turns in a hole of its radius",
        ends(half, [Curved(box(-5, -5, 5, 5), [Circle((0, 0), 2)])], (0, 0, 0), (0, 0, "180deg")),
    )
    for path in sorted(SCENES.glob("round_*.json")):
        scene = cfree.load_scene(path)
        yield path.stem, (scene, scene.start, scene.goal, {})


def ends(robot: Any, obstacles: list[Any], start: Any, goal: Any, workspace: Any = None) -> Any:
    return cfree.Scene(robot, obstacles, workspace=workspace), start, goal, {}


def planned(query: Any) -> tuple[float, str]:
    """Seconds of the processor, the least of some rounds, and the kind of the answer."""
    scene, start, goal, options = query
    least, kind = math.inf, ""
    for _ in range(ROUNDS):
        if least > 5 and kind:
            break
        fresh = cfree.Scene(scene.robot, scene.obstacles, workspace=scene.workspace, bounds=scene.bounds)
        gc.collect()
        begin = time.process_time()
        try:
            kind = type(cfree.plan(fresh, start, goal, improve=0.0, **options)).__name__
        except cfree.CfreeError as error:
            kind = type(error).__name__
        least = min(least, time.process_time() - begin)
    return least, kind


if __name__ == "__main__":
    for name, query in questions():
        seconds, answer = planned(query)
        print(f"{name} | {answer} | {1e3 * seconds:.0f} ms", flush=True)
