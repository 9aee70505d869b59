"""The second core: the whole boundary on one thread and on two, beside two at once on one thread each.

The latter share nothing but the machine: what they gain is all that two threads can gain here and now.
"""

from __future__ import annotations

import os
import statistics
import time
from concurrent.futures import ThreadPoolExecutor

from bench_boundary import Build, scene_of
from measure import REAL, Report, measured

import cfree

CASES = ("benchmr_warehouse", "nest_swim", "5000 convex")
AT_LEAST = 1.7
CELLS_AT_MOST = 0.8


def run(quick: bool) -> list[Report]:
    if (os.cpu_count() or 1) < 2:
        return [Report("Second core", (), notes=["one core only: nothing to compare"])]
    return [trimming(quick), with_cells(quick)]


def trimming(quick: bool) -> Report:
    report = Report(
        "Second core: trimming on one and on two threads",
        ("scene", "patches", "trapezoids", "one thread ms", "two threads ms", "two at once ms", "ratio",
         "two at once", "checksums"),
    )  # fmt: skip
    for case in CASES[:1] if quick else CASES:
        first, second = Build(case, threads=1), Build(case, threads=2)
        rivals = [Build(case, threads=1), Build(case, threads=1)]

        def at_once(rivals: list[Build] = rivals) -> float:
            with ThreadPoolExecutor(2) as pool:
                return max(pool.map(Build.__call__, rivals))

        one, two, both = measured(first, second, at_once, rounds=3 if quick or case == "5000 convex" else 25)
        stats, ratio = first.boundary.stats, one.best / two.best
        same = first.checksum() == second.checksum()
        verdict = "the same" if same else "DIFFERENT"
        report.rows.append((
            case, f"{stats.patches:,}", f"{stats.trapezoids:,}", one.text(), two.text(), both.text(),
            f"{ratio:.2f}", f"{2 * one.best / both.best:.2f}", f"{verdict}: {second.checksum()}",
        ))  # fmt: skip
        report.figure("second core, times faster", case, ratio, ">=", AT_LEAST)
        report.figure("same bytes for one thread and two", case, same, ">=", 1)
    return report


def with_cells(quick: bool) -> Report:
    """Boundary and cells of fresh scenes on two threads, in the time of the boundary alone on one."""
    report = Report(
        "Boundary and cells on two threads, beside the boundary on one",
        ("scene", "boundary, one thread ms", "with cells, one thread ms", "with cells, two threads ms", "ratio"),
    )
    ratios = {}
    for case in REAL[:1] if quick else REAL:

        def seconds(threads: int, has_cells: bool, case: str = case) -> float:
            scene = scene_of(case)
            start = time.perf_counter()
            boundary = cfree.boundary(scene, threads=threads)
            if has_cells:
                cfree.free_space(boundary, threads=threads)
            return time.perf_counter() - start

        alone, one, two = measured(
            lambda: seconds(1, False), lambda: seconds(1, True), lambda: seconds(2, True), rounds=3 if quick else 15
        )
        ratios[case] = two.best / alone.best
        report.rows.append((case, alone.text(), one.text(), two.text(), f"{ratios[case]:.2f}"))
    what = "boundary and cells on two threads, in the boundary's time on one"
    worst = max(ratios, key=ratios.__getitem__)
    report.figure(what, f"median of {len(ratios)} scenes", statistics.median(ratios.values()), "<=", CELLS_AT_MOST)
    report.notes.append(f"the worst: {worst}, {ratios[worst]:.2f}")
    return report
