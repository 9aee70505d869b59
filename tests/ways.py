"""Free paths to draw and to film: two trees of random poses, every motion checked exactly."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise

import numpy as np

from cfree.mesh import robot_radius
from cfree.motion import Motion, Rotation, Translation
from cfree.motion_check import MotionChecker
from cfree.path import Path
from cfree.pose import Pose
from cfree.scene import Scene


def motion_between(start: Pose, goal: Pose) -> Motion:
    """The one translation or rotation, of at most half a turn, from one pose to another (Chasles)."""
    whole = goal @ start.inverse()
    if whole.tau == 0:
        return Translation((whole.x, whole.y))
    if whole.tau is None:
        return Rotation((whole.x / 2, whole.y / 2), {"tau": "inf"})
    pole = (whole.x - whole.y / whole.tau) / 2, (whole.y + whole.x / whole.tau) / 2
    return Rotation(pole, {"tau": whole.tau})


def crude_path(scene: Scene, seed: int = 0, tries: int = 40_000) -> Path:
    """A free path from the start to the goal of a scene with bounds, shortened a little."""
    assert scene.start is not None and scene.goal is not None and scene.bounds is not None
    random, checker = np.random.default_rng(seed), MotionChecker(scene)
    x0, y0, x1, y1 = map(float, scene.bounds)
    scale = np.array([1, 1, robot_radius(scene)])
    step = 0.08 * max(x1 - x0, y1 - y0)
    trees: list[list[Pose]] = [[scene.start], [scene.goal]]
    parents: list[list[int]] = [[0], [0]]

    def gap(places: np.ndarray, place: np.ndarray) -> np.ndarray:
        d = places - place
        d[..., 2] = (d[..., 2] + math.pi) % math.tau - math.pi
        return np.linalg.norm(d * scale, axis=-1)

    def grow(side: int, target: np.ndarray, exact: Pose | None) -> bool:
        """Towards a target as far as it is free; has it arrived?"""
        while True:
            places = np.array([_place(q) for q in trees[side]])
            near = int(gap(places, target).argmin())
            whole = float(gap(places[near], target))
            turn = (target[2] - places[near, 2] + math.pi) % math.tau - math.pi
            share = min(1.0, step / max(whole, 1e-12))
            x, y = places[near, :2] + share * (target[:2] - places[near, :2])
            arrives = share == 1.0 and exact is not None
            pose = exact if arrives and exact else _pose(x, y, places[near, 2] + share * turn)
            if pose == trees[side][near] or not checker.is_free(
                trees[side][near], motion_between(trees[side][near], pose)
            ):
                return False
            trees[side].append(pose)
            parents[side].append(near)
            if exact is None or arrives:
                return arrives

    for k in range(tries):
        side = k % 2
        before = len(trees[side])
        grow(side, random.uniform((x0, y0, 0), (x1, y1, math.tau)), None)
        if len(trees[side]) > before and grow(1 - side, _place(trees[side][-1]), trees[side][-1]):
            first, second = (_branch(trees[s], parents[s]) for s in (0, 1))
            poses = [*first[::-1], *second[1:]]
            return Path(scene.start, _motions(_shortened(poses, checker, random)), scene.units)
    raise AssertionError("no path found")


def _shortened(poses: list[Pose], checker: MotionChecker, random: np.random.Generator) -> list[Pose]:
    for _ in range(20 * len(poses)):
        i, j = sorted(random.integers(0, len(poses), 2).tolist())
        if j - i > 1 and poses[i] != poses[j] and checker.is_free(poses[i], motion_between(poses[i], poses[j])):
            poses = poses[: i + 1] + poses[j:]
    return poses


def _motions(poses: list[Pose]) -> list[Motion]:
    return [motion_between(a, b) for a, b in pairwise(poses)]


def _branch(tree: list[Pose], parents: list[int]) -> list[Pose]:
    k, found = len(tree) - 1, [tree[-1]]
    while k:
        k = parents[k]
        found.append(tree[k])
    return found


def _place(pose: Pose) -> np.ndarray:
    return np.array([float(pose.x), float(pose.y), pose.theta])


def _pose(x: float, y: float, theta: float) -> Pose:
    half = Fraction(math.tan(theta / 2)).limit_denominator(1000)
    return Pose(Fraction(x).limit_denominator(1000), Fraction(y).limit_denominator(1000), {"tau": half})
