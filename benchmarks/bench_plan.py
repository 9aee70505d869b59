"""From start to goal: `cfree.plan` beside OMPL's RRTConnect with a motion test compiled by numba.

OMPL's test looks at poses a step apart: a hundredth of the space's extent, its default, or a thousandth. Its paths are
looked at again, by `MotionChecker.sweep_is_free` and at a hundred times as many poses. CAP=5 in the environment gives
it five seconds a run instead of thirty.
"""

from __future__ import annotations

import math
import os
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from importlib.util import find_spec
from itertools import pairwise
from typing import Any

import numpy as np
from bench_free import numba_kernel, numba_tables, pieces_of
from measure import REAL, SCENES, Report, measured

import cfree
from cfree.scene.features import scene_features

CAP, RUNS, ROUNDS, IMPROVE = float(os.environ.get("CAP", 30)), 5, 5, 1.0
STEPS = {"default": 0.01, "fine": 0.001}
FINER = 100


def run(quick: bool) -> Report:
    report = Report(
        "From start to goal",
        ("scene", "answer", "first ms", "whole ms", "RRTConnect ms", "solved", "clip", "fine ms", "solved", "clip",
         "fine / first", "length", "OMPL's", "ratio"),
        notes=[
            f"from a scene just read to the answer, or first exact solution in {RUNS} runs of at most {CAP:g} s",
            "first: cfree.plan, not improved; whole: all of the free space, and then the answer",
            "imports and numba's compilation are not counted, convex pieces are, on both sides; ratios: of medians",
            "clip: solutions that are not free; those with ? come too close to an obstacle to tell",
            f"length: travel + robot's radius x turning, after {IMPROVE:g} s of improvement",
            "OMPL's: of the fine ones, simplified for as long, the median of those that do not clip",
        ],
    )  # fmt: skip
    missing = [name for name in ("numba", "ompl") if find_spec(name) is None]
    if missing:
        report.notes.append(f"nothing to compare: no {', no '.join(missing)}; pip install -e '.[bench,ompl]'")
        return report
    names = [*REAL, *sorted(path.stem for path in SCENES.glob("*.json") if path.stem not in REAL)]
    rows = [compare(name, report, quick) for name in (names[:1] if quick else names)]
    for what, ratios, most in (
        ("first answer", [row.first_ratio for row in rows], 1),
        ("free space and answer", [row.whole_ratio for row in rows], 10),
    ):
        report.figure(
            f"{what}, in RRTConnect's time (fine)", f"median of {len(rows)} scenes", median(ratios), "<=", most
        )
    lengths = [row.length_ratio for row in rows if math.isfinite(row.length_ratio)]
    report.figure("plan, length to OMPL's simplified", f"median of {len(lengths)} scenes", median(lengths), "<=", 1.05)
    report.figure("plan, paths that are free", f"{len(rows)} scenes", min(row.free for row in rows), ">=", 1)
    return report


@dataclass(slots=True)
class Row:
    first_ratio: float
    whole_ratio: float
    length_ratio: float
    free: bool


@dataclass(slots=True)
class Runs:
    """Of one planner on one scene."""

    seconds: list[float] = field(default_factory=list)
    solved: int = 0
    clip: int = 0
    undecided: int = 0
    lengths: list[float] = field(default_factory=list)

    def text(self) -> tuple[str, str, str]:
        times = [1e3 * s for s in self.seconds]
        clip = str(self.clip) + (f" +{self.undecided}?" if self.undecided else "")
        return f"{median(times):.3g} ({min(times):.3g}–{max(times):.3g})", f"{self.solved}/{len(times)}", clip


def compare(name: str, report: Report, quick: bool) -> Row:
    def fresh() -> cfree.Scene:
        return cfree.load_scene(SCENES / f"{name}.json")

    scene = fresh()
    cap, runs = (2.0, 1) if quick else (CAP, RUNS)
    first, whole = measured(
        lambda: seconds_of(first_answer, fresh()),
        lambda: seconds_of(whole_answer, fresh()),
        rounds=1 if quick else ROUNDS,
    )
    answer = cfree.plan(scene, improve=IMPROVE, objective="short")
    found = isinstance(answer, cfree.Path)
    rivals = {key: rival(fresh, step, cap, runs) for key, step in STEPS.items()}
    length = answer.length + robot_radius(scene) * answer.turning if found else math.nan
    theirs = median(rivals["fine"].lengths)
    ratios = [median(list(times.rounds)) / median(rivals["fine"].seconds) for times in (first, whole)]
    report.rows.append((
        name, "path" if found else "separated", first.text(), whole.text(), *rivals["default"].text(),
        *rivals["fine"].text(), f"{1 / ratios[0]:.3g}", f"{length:.4g}", f"{theirs:.4g}", f"{length / theirs:.3g}",
    ))  # fmt: skip
    free = not found or answer.is_free(cfree.MotionChecker(scene))
    return Row(*ratios, length / theirs, free)


def first_answer(scene: cfree.Scene) -> object:
    return cfree.plan(scene, improve=0)


def whole_answer(scene: cfree.Scene) -> object:
    space = cfree.free_space(cfree.boundary(scene))
    assert scene.start and scene.goal
    return cfree.plan(space, scene.start, scene.goal, improve=0)


def seconds_of(call: Callable[[cfree.Scene], object], scene: cfree.Scene) -> float:
    start = time.perf_counter()
    call(scene)
    return time.perf_counter() - start


def rival(fresh: Callable[[], cfree.Scene], step: float, cap: float, runs: int) -> Runs:
    """OMPL on a scene, read anew for each run."""
    from ompl import geometric, util

    util.setLogLevel(util.LogLevel.LOG_NONE)
    motion_kernel()
    result, checker, radius = Runs(), cfree.PoseChecker(fresh()), robot_radius(fresh())
    for _ in range(runs):
        scene = fresh()
        start = time.perf_counter()
        setup = prepared(scene, step)
        setup.setPlanner(geometric.RRTConnect(setup.getSpaceInformation()))
        setup.solve(cap)
        result.seconds.append(time.perf_counter() - start)
        if not setup.haveExactSolutionPath():
            continue
        result.solved += 1
        verdict = looked_at_again(checker, setup, step)
        result.clip += verdict == "clips"
        result.undecided += verdict == "undecided"
        setup.simplifySolution(IMPROVE)
        if looked_at_again(checker, setup, step) != "clips":
            result.lengths.append(length_of(setup, radius))
    return result


@cache
def motion_kernel() -> Any:
    """Are so many poses of the motion between two, the last included, free? One compiled call."""
    import numba

    free = numba_kernel()

    @numba.njit
    def test(x, y, theta, dx, dy, turn, count, a, a_first, b, b_first, boxes):
        row = np.empty((1, 3))
        for k in range(count, 0, -1):
            u = k / count
            row[0, 0], row[0, 1], row[0, 2] = x + u * dx, y + u * dy, theta + u * turn
            if not free(row, a, a_first, b, b_first, boxes)[0]:
                return False
        return True

    far = [np.full((3, 2), 1e300)]
    test(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1, *numba_tables(far, far))  # compiled now
    return test


def prepared(scene: cfree.Scene, step: float) -> Any:
    """OMPL's set-up of a scene that nothing is known of yet."""
    from ompl import base, geometric

    from cfree.ompl import set_pose, state_space, sweep_of

    features, kernel = scene_features(scene), motion_kernel()
    obstacles = pieces_of(features.obstacles) or [np.full((3, 2), 1e300)]
    tables = numba_tables(pieces_of(features.robot), obstacles)
    space = state_space(scene)
    setup = geometric.SimpleSetup(space)
    longest = step * space.getMaximumExtent()

    class Valid(base.StateValidityChecker):
        def isValid(self, state: Any) -> bool:
            return space.satisfiesBounds(state) and kernel(
                state.getX(), state.getY(), state.getYaw(), 0.0, 0.0, 0.0, 1, *tables
            )

    class Motions(base.MotionValidator):
        def checkMotion(self, start: Any, goal: Any) -> bool:
            pose, by = sweep_of(start, goal)
            count = max(1, math.ceil((math.hypot(by[0], by[1]) + 0.5 * abs(by[2])) / longest))
            return space.satisfiesBounds(goal) and kernel(*pose, *by, count, *tables)

    si = setup.getSpaceInformation()
    setup.setStateValidityChecker(Valid(si))
    si.setMotionValidator(Motions(si))
    ends = []
    for pose in (scene.start, scene.goal):
        state = space.allocState()
        set_pose(state, float(pose.x), float(pose.y), pose.theta)
        ends.append(state)
    setup.setStartAndGoalStates(*ends)
    return setup


def looked_at_again(checker: cfree.PoseChecker, setup: Any, step: float) -> str:
    """Whether a path of OMPL is free, clips, or comes too close to an obstacle to tell."""
    from cfree.ompl import sweep_of

    longest = step * setup.getStateSpace().getMaximumExtent() / FINER
    verdict = "free"
    for start, goal in pairwise(setup.getSolutionPath().getStates()):
        pose, by = sweep_of(start, goal)
        if checker.sweep_is_free(pose, by):
            continue
        count = math.ceil((math.hypot(by[0], by[1]) + 0.5 * abs(by[2])) / longest) + 1
        if not checker.is_free(np.array(pose) + np.linspace(0, 1, count)[:, None] * np.array(by)).all():
            return "clips"
        verdict = "undecided"
    return verdict


def length_of(setup: Any, scale: float) -> float:
    from cfree.ompl import sweep_of

    steps = [sweep_of(*ends)[1] for ends in pairwise(setup.getSolutionPath().getStates())]
    return sum(math.hypot(dx, dy) + scale * abs(turn) for dx, dy, turn in steps)


def robot_radius(scene: cfree.Scene) -> float:
    return max(float(np.hypot(*part.vertices.T).max()) for part in scene.robot)


def median(values: list[float]) -> float:
    return statistics.median(values) if values else math.nan
