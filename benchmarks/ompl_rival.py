"""OMPL's RRTConnect on a scene of cfree, its motions tested at poses a step apart by code that numba compiles.

This proves nothing: its paths are looked at again, exactly, and where that says no at a hundred times as many poses.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from bench_free import numba_kernel, numba_tables, pieces_of

import cfree
from cfree.scene.features import scene_features
from cfree.scene.scene import robot_radius

STEP = 0.001  # of the extent of the space; OMPL's default is 0.01
FINER = 100
SIMPLIFY = 0.5  # seconds

Sweep = tuple[tuple[float, float, float], tuple[float, float, float]]  # where a motion begins, what it adds


@dataclass(slots=True)
class Runs:
    """Of one scene: processor seconds, and of the paths that do not clip when simplified, lengths and waypoints."""

    seconds: list[float] = field(default_factory=list)
    solved: int = 0
    clip: int = 0
    undecided: int = 0
    lengths: list[float] = field(default_factory=list)
    waypoints: list[int] = field(default_factory=list)


def rival(fresh: Callable[[], cfree.Scene], cap: float, runs: int, step: float = STEP) -> Runs:
    """OMPL on a scene, read anew for each run, at most `cap` processor seconds; motions are tested every `step` of the
    extent."""
    from ompl import geometric, util

    util.setLogLevel(util.LogLevel.LOG_NONE)
    motion_kernel()
    result, checker, radius = Runs(), cfree.PoseChecker(fresh()), robot_radius(fresh())
    for _ in range(runs):
        scene = fresh()
        start = time.process_time()
        setup = prepared(scene, step)
        setup.setPlanner(geometric.RRTConnect(setup.getSpaceInformation()))
        while (left := cap - (time.process_time() - start)) > 0.01 and not setup.haveExactSolutionPath():
            setup.solve(left)  # of the clock, which other processes share; the trees go on growing
        result.seconds.append(time.process_time() - start)
        if not setup.haveExactSolutionPath():
            continue
        result.solved += 1
        finer = step * setup.getStateSpace().getMaximumExtent() / FINER
        verdict = looked_at_again(checker, sweeps_of(setup), finer)
        result.clip += verdict == "clips"
        result.undecided += verdict == "undecided"
        setup.simplifySolution(SIMPLIFY)
        if looked_at_again(checker, sweeps_of(setup), finer) != "clips":
            result.lengths.append(length_of(setup, radius))
            result.waypoints.append(setup.getSolutionPath().getStateCount())
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


def looked_at_again(checker: cfree.PoseChecker, sweeps: Iterable[Sweep], finer: float) -> str:
    """Whether a path is free, clips, or comes too close to an obstacle to tell by poses `finer` apart."""
    verdict = "free"
    for pose, by in sweeps:
        if checker.sweep_is_free(pose, by):
            continue
        count = math.ceil((math.hypot(by[0], by[1]) + 0.5 * abs(by[2])) / finer) + 1
        if not checker.is_free(np.array(pose) + np.linspace(0, 1, count)[:, None] * np.array(by)).all():
            return "clips"
        verdict = "undecided"
    return verdict


def sweeps_of(setup: Any) -> list[Sweep]:
    from cfree.ompl import sweep_of

    return [sweep_of(*ends) for ends in pairwise(setup.getSolutionPath().getStates())]


def length_of(setup: Any, scale: float) -> float:
    return sum(math.hypot(dx, dy) + scale * abs(turn) for _, (dx, dy, turn) in sweeps_of(setup))
