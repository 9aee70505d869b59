"""Boundary and cells of a scene of which one obstacle has moved: with `reuse=`, beside the same computed anew.

Obstacles and motions are those of `families.moves`. Processor time of one thread, of a new scene each time; that of a
boundary includes its features, that of cells is what they take beside it; both together are the whole.
"""

from __future__ import annotations

import statistics
import time
from dataclasses import dataclass

from bench_exact import scene_of
from families import MOVES, moves
from measure import REAL, SCENES, Report

import cfree

CASES = (*REAL, "flats 36")
AT_MOST = {"benchmr_warehouse": 0.2, "street_Berlin": 0.35}
PARTS = ("boundary", "cells", "both")


def run(quick: bool) -> Report:
    report = Report(
        "One obstacle moved: boundary and cells with reuse beside anew, one thread, processor time",
        ("scene", "move", "part", "patches", "kept: least", "anew ms", "reuse ms", "ratio: median", "worst"),
    )
    worst = dict.fromkeys(PARTS, 0.0)
    for case in CASES[1:2] if quick else CASES:
        scene = scene_of(case) if case not in REAL else cfree.load_scene(SCENES / f"{case}.json")
        old = cfree.free_space(cfree.boundary(scene, threads=1), threads=1)
        for kind in MOVES:
            changes = [Change(old, k, pose) for k, pose in moves(scene, kind, 4 if quick else 8)]
            times = [change.times(rounds=2 if quick else 3) for change in changes]
            least = min(change.kept for change in changes)
            for part in range(len(PARTS)):
                ratios = [reused[part] / anew[part] for anew, reused in times]
                anew, reused = (1e3 * statistics.median(pair[k][part] for pair in times) for k in (0, 1))
                row = (case, kind, PARTS[part], f"{old.boundary.stats.patches:,}", f"{least:,}")
                report.rows.append(
                    (*row, f"{anew:.3g}", f"{reused:.3g}", f"{statistics.median(ratios):.3f}", f"{max(ratios):.3f}")
                )
                worst[PARTS[part]] = max(worst[PARTS[part]], max(ratios))
                if case in AT_MOST:
                    what = f"{PARTS[part]}, one obstacle moved ({kind}), worst"
                    report.figure(what, case, max(ratios), "<=", AT_MOST[case])
    for part, ratio in worst.items():
        report.notes.append(f"worst of all, {part}: {ratio:.3f}")
    return report


@dataclass
class Change:
    """One obstacle moved."""

    old: cfree.FreeSpace
    obstacle: int
    pose: cfree.Pose
    kept: int = 0

    def times(self, rounds: int) -> tuple[list[float], list[float]]:
        """Return the least processor times of boundary, cells and both in some rounds: anew, and with reuse."""
        both = [(self._seconds(False), self._seconds(True)) for _ in range(rounds)]
        anew, reused = ([min(part) for part in zip(*side, strict=True)] for side in zip(*both, strict=True))
        return anew, reused

    def _seconds(self, is_reused: bool) -> tuple[float, float, float]:
        old = self.old if is_reused else None
        scene = self.old.boundary.scene.moved(self.obstacle, self.pose)
        start = time.process_time()
        boundary = cfree.boundary(scene, threads=1, reuse=old and old.boundary)
        between = time.process_time()
        cfree.free_space(boundary, threads=1, reuse=old)
        end = time.process_time()
        self.kept = boundary.kept_patches if is_reused else self.kept
        return between - start, end - between, end - start
