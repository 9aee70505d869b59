"""A boundary of which one obstacle has moved: with `reuse=`, beside the same computed anew.

Obstacles and motions are those of `families.moves`. Processor time of one thread, of a new scene each time, with its
features.
"""

from __future__ import annotations

import statistics
import time

from bench_exact import scene_of
from families import MOVES, moves
from measure import REAL, SCENES, Report, measured

import cfree

CASES = (*REAL, "convex 500", "flats 36", "grid 200")
AT_MOST = {"benchmr_warehouse": 0.2}


def run(quick: bool) -> Report:
    report = Report(
        "One obstacle moved: its boundary with reuse beside anew, one thread, processor time",
        ("scene", "move", "patches", "kept: least", "anew ms", "reuse ms", "ratio: median", "worst"),
    )
    for case in CASES[1:2] if quick else CASES:
        scene = scene_of(case) if case not in REAL else cfree.load_scene(SCENES / f"{case}.json")
        old = cfree.boundary(scene, threads=1)
        for kind in MOVES:
            changes = [Change(old, k, pose) for k, pose in moves(scene, kind, 4 if quick else 12)]
            times = [measured(change.anew, change.reused, rounds=2 if quick else 5) for change in changes]
            ratios = [reused.best / anew.best for anew, reused in times]
            least = min(change.kept for change in changes)
            anew, reused = (1e3 * statistics.median(pair[k].best for pair in times) for k in (0, 1))
            row = (case, kind, f"{old.stats.patches:,}", f"{least:,}", f"{anew:.3g}", f"{reused:.3g}")
            report.rows.append((*row, f"{statistics.median(ratios):.3f}", f"{max(ratios):.3f}"))
            if case in AT_MOST:
                report.figure(f"one obstacle moved ({kind}), worst", case, max(ratios), "<=", AT_MOST[case])
    return report


class Change:
    """One obstacle moved, in two ways to compute the boundary; both return their processor time."""

    def __init__(self, old: cfree.Boundary, obstacle: int, pose: cfree.Pose) -> None:
        self.old, self.obstacle, self.pose, self.kept = old, obstacle, pose, 0

    def anew(self) -> float:
        return self._seconds(None)

    def reused(self) -> float:
        return self._seconds(self.old)

    def _seconds(self, reuse: cfree.Boundary | None) -> float:
        scene = self.old.scene.moved(self.obstacle, self.pose)
        start = time.process_time()
        result = cfree.boundary(scene, threads=1, reuse=reuse)
        seconds = time.process_time() - start
        if reuse is not None:
            self.kept = result.kept_patches
        return seconds
