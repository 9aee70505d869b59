"""Shapes of segments and circular arcs, decided on themselves: poses beside 32-gons, and questions of exact touch.

Poses: a car with rounded corners among 100 discs, beside the same with 32-gons; the processor's time, in turns.
Questions: touches, exact fits, and gaps that are just wide enough; each has an answer. Then the shipped scenes: their
first paths, or proofs.

    python benchmarks/run.py round
    python benchmarks/bench_round.py            # the questions and scenes alone, also for a commit without this file
"""

from __future__ import annotations

import gc
import math
import statistics
import time
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

import cfree
from cfree import Curved
from cfree.curves import Arc, Circle

ROUNDS, POSES, EDGES = 5, 20_000, 32
SCENES = Path(__file__).parents[1] / "examples" / "scenes"


def run(quick: bool) -> Any:
    from measure import Report

    report = Report("Segments and arcs", ("question", "answer", "ms"), notes=["ms of the processor"])
    count = POSES // 20 if quick else POSES
    report.figure("poses among discs, to 32-gons", f"{count} poses", poses_ratio(count), "<=", 1)
    for name, query in questions():
        seconds, answer = planned(query)
        report.rows.append((name, answer, f"{1e3 * seconds:.0f}"))
    return report


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


def around() -> list[tuple[float, float]]:
    return [(math.cos(math.tau * k / EDGES), math.sin(math.tau * k / EDGES)) for k in range(EDGES)]


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
