"""Robots of many vertices: boundaries among 40 convex obstacles, and first paths among many vertices.

Of boundaries, convex robots have vertices on a circle, stars every other one nearer to the middle, at somewhat random
angles. First paths are those of a wavy part of 68 vertices among 8,400 (`families.crowd`), beside OMPL's RRTConnect.
"""

from __future__ import annotations

import math
import statistics
import time

import numpy as np
from bench_plan import spent
from families import Floats, convex, crowd
from measure import Report
from ompl_rival import rival

import cfree

COUNTS, ROUNDS = (4, 8, 16, 32, 64, 128), 5
CROWDS, CAP, RUNS = 5, 20.0, 3  # questions; seconds and runs of OMPL
RADIUS = 2.0


def run(quick: bool) -> list[Report]:
    return [boundaries(quick), first_paths(quick)]


def boundaries(quick: bool) -> Report:
    report = Report(
        "Robots of many vertices",
        ("robot", "vertices", "trapezoids", "ms", "µs/trapezoid"),
        notes=["ms of the processor"],
    )
    obstacles = [ring.tolist() for ring in convex(40, 1, 7.0).rings()]
    for name, robot_of in (("convex", inscribed), ("star", star)):
        counts = [count for count in COUNTS[:3] if quick] or COUNTS[name == "star" :]
        times = []
        for count in counts:
            scene = cfree.Scene(robot_of(count).tolist(), obstacles)
            seconds, trapezoids = boundary_time(scene, 1 if quick else ROUNDS)
            times.append((count, seconds, seconds / trapezoids))
            report.rows.append(
                (name, str(count), f"{trapezoids:,}", f"{1e3 * seconds:.0f}", f"{1e6 * times[-1][2]:.1f}")
            )
        (first, low, each_of_first), (last, high, each_of_last) = times[0], times[-1]
        span = f"{name} robots, {first} to {last} vertices"
        if name == "convex":
            report.figure("time a trapezoid, last to first", span, each_of_last / each_of_first, "<=", 3)
        else:
            exponent = math.log(high / low) / math.log(last / first)
            report.figure("growth of time, exponent in the vertices", span, exponent, "<=", 1.3)
    return report


def first_paths(quick: bool) -> Report:
    report = Report(
        "A robot of 68 vertices among 8,400",
        ("scene", "answer", "first ms", "boundary ms", "RRTConnect ms", "solved", "first / RRT"),
        notes=["ms of the processor, medians of 3; boundary: one run on one thread"],
    )
    ratios, whole = dict[str, float](), dict[str, float]()
    for seed in range(1 if quick else CROWDS):
        name, scene = f"crowd {seed}", crowd(seed)

        def fresh(scene: cfree.Scene = scene) -> cfree.Scene:
            return cfree.Scene(
                scene.robot, scene.obstacles, workspace=scene.workspace, start=scene.start, goal=scene.goal
            )

        answer = cfree.plan(scene, improve=0)
        first = statistics.median(spent(lambda s: cfree.plan(s, improve=0), fresh()) for _ in range(3))
        whole[name] = spent(lambda s: cfree.boundary(s, threads=1, max_seconds=math.inf), fresh())
        runs = rival(fresh, CAP, 1 if quick else RUNS)
        theirs = statistics.median(runs.seconds)
        if isinstance(answer, cfree.Path):
            ratios[name] = first / theirs
        times = (f"{1e3 * seconds:.0f}" for seconds in (first, whole[name], theirs))
        solved = f"{runs.solved}/{len(runs.seconds)}"
        report.rows.append((name, type(answer).__name__, *times, solved, f"{first / theirs:.2f}"))
    worst, slowest = max(ratios, key=ratios.__getitem__), max(whole, key=whole.__getitem__)
    report.figure("first path of many vertices, in RRTConnect's time", f"the worst: {worst}", ratios[worst], "<=", 3)
    report.figure("boundary of many vertices, seconds", f"the worst: {slowest}", whole[slowest], "<=", 10)
    return report


def inscribed(count: int) -> Floats:
    return around(count, RADIUS * np.ones(count))


def star(count: int) -> Floats:
    noise = np.random.default_rng(count + 1).uniform(-0.1, 0.1, count)
    return around(count, RADIUS * (np.where(np.arange(count) % 2, 1.0, 0.5) + noise))


def around(count: int, radii: Floats) -> Floats:
    """Points at angles that are about equally far apart."""
    angles = math.tau * (np.arange(count) + np.random.default_rng(count).uniform(-0.3, 0.3, count)) / count
    return radii[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])


def boundary_time(scene: cfree.Scene, rounds: int) -> tuple[float, int]:
    """The least processor time of a boundary, and its trapezoids."""
    best, trapezoids = math.inf, 0
    for _ in range(rounds):
        fresh = cfree.Scene(scene.robot, scene.obstacles)
        begin = time.process_time()
        trapezoids = cfree.boundary(fresh, threads=1, max_seconds=math.inf).stats.trapezoids
        best = min(best, time.process_time() - begin)
    return best, trapezoids
