"""The second core: the whole boundary on one thread and on two, beside two at once on one thread each.

The latter share nothing but the machine: what they gain is all that two threads can gain here and now.
"""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor

from bench_boundary import Build
from measure import Report, measured

CASES = ("benchmr_warehouse", "nest_swim", "5000 convex")
AT_LEAST = 1.7


def run(quick: bool) -> Report:
    report = Report(
        "Second core: trimming on one and on two threads",
        ("scene", "patches", "trapezoids", "one thread ms", "two threads ms", "two at once ms", "ratio",
         "two at once", "checksums"),
    )  # fmt: skip
    if (os.cpu_count() or 1) < 2:
        report.notes.append("one core only: nothing to compare")
        return report
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
