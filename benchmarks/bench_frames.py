"""Frames of a costmap, each a new scene with a plan: `Planner.updated`, beside a new `Planner` for each frame.

The grids are those of `families.frames`. Processor time of one frame: reading the grid, updating the planner, and the
first path between two corners, without improvement.
"""

from __future__ import annotations

import time
from collections import Counter
from dataclasses import dataclass, field

import numpy as np
from families import Floats, frames
from measure import Report

import cfree

ROBOT = [("-0.3", "-0.2"), ("0.3", "-0.2"), ("0.3", "0.2"), ("-0.3", "0.2")]
CELL = "0.05"
SIZES = (100, 200)
AT_MOST = 20.0
STEPS = ("grid", "planner", "plan")


def run(quick: bool) -> Report:
    report = Report(
        "Frames of a costmap with a plan each, processor time in ms a frame: means, then of all three steps",
        ("cells", "obstacles", "vertices", "planner", "frames", "paths", *STEPS, "mean", "median", "p99", "worst"),
    )
    count = 30 if quick else 1000
    for size in SIZES[:1] if quick else SIZES:
        for is_updated in (True, False):
            stream = Stream(size, is_updated)
            for grid in frames(count, size):
                stream.add(grid)
            seconds = 1e3 * stream.table[1:]  # the first one imports
            each = seconds.sum(axis=1)
            scene = stream.planner.scene if stream.planner else None
            vertices = sum(map(len, scene.obstacles)) if scene else 0
            what = "updated" if is_updated else "new"
            row = (f"{size} x {size}", str(len(scene.obstacles) if scene else 0), f"{vertices:,}", what, f"{count:,}")
            means = (*seconds.mean(axis=0), each.mean(), np.median(each), np.percentile(each, 99), each.max())
            report.rows.append((*row, f"{stream.answers['Path']:,}", *(f"{x:.1f}" for x in means)))
            if is_updated:
                report.figure("frame of a costmap, mean", f"{size} x {size}", each.mean(), "<=", AT_MOST, " ms")
    return report


@dataclass
class Stream:
    """Frames one after another."""

    size: int
    is_updated: bool
    planner: cfree.Planner | None = None
    rows: list[list[float]] = field(default_factory=list)
    answers: Counter[str] = field(default_factory=Counter)

    @property
    def table(self) -> Floats:
        """Seconds of each frame, a column for each of `STEPS`."""
        return np.array(self.rows)

    def add(self, grid: object) -> None:
        """Plan in one more frame."""
        far = f"{(self.size - 24) * 0.05:.2f}"
        times = [time.process_time()]
        scene = cfree.Scene.from_grid(ROBOT, grid, CELL)
        times.append(time.process_time())
        is_kept = self.is_updated and self.planner is not None
        self.planner = self.planner.updated(scene) if is_kept and self.planner else cfree.Planner(scene)
        times.append(time.process_time())
        try:
            answer: object = self.planner.plan(("0.9", "0.9", 0), (far, far, 0), improve=0)
        except cfree.InvalidPoseError as error:
            answer = error
        times.append(time.process_time())
        self.answers[type(answer).__name__] += 1
        self.rows.append(np.diff(times).tolist())
