"""Compare answers among random round shapes with dense sampling and their own checker.

    python tests/support/fuzz_curves.py --count 1000 --seed 0

A path is sampled every hundredth of a robot, with shapes a little smaller: nothing may overlap. For separated poses, a
flood over a grid of poses may not go from start to goal; its shapes are so much larger that the robot is free between
two of them. Each answer is checked by `cfree.verify`.
"""

from __future__ import annotations

import argparse
import math
import random
import time
from collections import Counter, deque
from contextlib import suppress

import numpy as np
import shapely

import cfree
import cfree.verify
from cfree.scene.scene import size_of
from round_shapes import Sampled, random_scene

SMALLER = 2e-4  # than the shapes are, by more than the sampling errs
STEP, TURNS = 0.25, 24  # of the grid


def ends(scene: cfree.Scene, rng: random.Random) -> list[cfree.Pose]:
    """Two poses at which there is a little room."""
    around, poses = Sampled(scene, 0.01), list[cfree.Pose]()
    for _ in range(400):
        far = 4.5 if poses else rng.choice([1.0, 4.5])
        row = [round(rng.uniform(-far, far), 2), round(rng.uniform(-far, far), 2), round(rng.uniform(0, 6), 2)]
        if around.overlap([row])[0] == 0:
            poses.append(cfree.Pose(*row))
            if len(poses) == 2:
                return poses
    return []


def is_joined(scene: cfree.Scene, start: cfree.Pose, goal: cfree.Pose) -> bool:
    """True if a flood of the grid certainly leads from start to goal."""
    reach = max(size_of(part) for part in scene.robot) * 1.5
    by = STEP / 2 + reach * math.pi / TURNS
    around = Sampled(scene, by * 0.75)
    shapely.prepare(around.bodies)
    n = round(10 / STEP)
    free: dict[tuple[int, int, int], bool] = {}

    def is_free(cell: tuple[int, int, int]) -> bool:
        i, j, k = cell
        if not (0 <= i <= n and 0 <= j <= n):
            return False
        cell = (i, j, k % TURNS)
        if cell not in free:
            row = [-5 + STEP * i, -5 + STEP * j, math.tau * cell[2] / TURNS]
            free[cell] = bool(around.overlap([row])[0] == 0)
        return free[cell]

    def near(pose: cfree.Pose) -> list[tuple[int, int, int]]:
        """Cells to which a pose certainly moves freely: the robot has the room at the cell that the path needs."""
        i, j = (round((float(c) + 5) / STEP) for c in (pose.x, pose.y))
        k = round(pose.theta / math.tau * TURNS) % TURNS
        return [(i, j, k)] if is_free((i, j, k)) else []

    seen, waiting = set(near(start)), deque(near(start))
    aims = set(near(goal))
    while waiting and aims:
        i, j, k = waiting.popleft()
        if (i, j, k) in aims:
            return True
        for di, dj, dk in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)):
            cell = i + di, j + dj, (k + dk) % TURNS
            if cell not in seen and is_free(cell):
                seen.add(cell)
                waiting.append(cell)
    return False


def fault(seed: int) -> tuple[str, str]:
    """Kind of the answer, and its fault."""
    scene = random_scene(seed)
    pair = ends(scene, random.Random(f"round ends {seed}"))
    if not pair:
        return "no room", ""
    try:
        answer = cfree.plan(scene, *pair, improve=0.0)
    except cfree.UndecidedError:
        return "undecided", ""
    kind = type(answer).__name__ + getattr(answer, "of", "")
    result = cfree.verify.answer(scene, answer)
    if not result.verified:
        return kind, f"refuted: {result.findings[:2]}"
    if isinstance(answer, cfree.Path):
        poses = answer.sample(0.01, 0.02)
        areas = Sampled(scene, -SMALLER).overlap(np.column_stack([poses.xy, poses.theta]).tolist())
        return kind, f"overlaps by {areas.max():g}" if areas.max() > 0 else ""
    return kind, "a flood joins them" if is_joined(scene, *pair) else ""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    counted, begin, wrong = Counter[str](), time.monotonic(), 0
    with suppress(KeyboardInterrupt):
        for seed in range(options.seed, options.seed + options.count):
            try:
                kind, text = fault(seed)
            except Exception as error:
                kind, text = "error", f"{type(error).__name__}: {error}"
            counted[kind] += 1
            if text:
                wrong += 1
                print(f"scene {seed}: {kind}: {text}", flush=True)
    print(f"{sum(counted.values())} scenes, {wrong} faults, {time.monotonic() - begin:.0f} s: {dict(counted)}")


if __name__ == "__main__":
    main()
