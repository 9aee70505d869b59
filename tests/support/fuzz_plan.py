"""Ask questions on random scenes, degenerate ones included: ``python tests/support/fuzz_plan.py 10000 --seed 1``.

Each scene has pairs of poses in one cell, walked from one to the other without a search, and pairs in different cells,
separated and verified by both checkers. Certain results of a flood must agree. It prints faults, and exits with 1.
"""

from __future__ import annotations

import argparse
import random
import sys
from collections import Counter
from itertools import combinations, islice
from itertools import count as numbers

import numpy as np

import fuzz
from cfree import MotionChecker, Path, Planner, Pose, Poses, Scene, boundary, free_space
from cfree.errors import InvalidPolygonError, UnsupportedError
from cfree.planning.options import Options
from cfree.planning.pose_planner import PosePlanner
from compared import scene_of
from flood import flood
from oracles import AtALoss
from second_opinion import verified_in_a_file
from shapes import KINDS, PlainScene, random_scene

STEPS = 60  # orientations of a flood


def questions(scene: Scene, rng: random.Random, count: int) -> tuple[Planner, list[Pose], list[int]]:
    """Random free poses, and their cells."""
    space = free_space(boundary(scene, threads=1))
    x0, y0, x1, y1 = _box(scene)
    poses = [
        Pose(
            rng.choice((rng.uniform(x0, x1), rng.randint(int(x0), int(x1)))), rng.uniform(y0, y1), rng.uniform(0, 6.28)
        )
        for _ in range(count)
    ]
    poses += [Pose(rng.randint(int(x0), int(x1)), rng.randint(int(y0), int(y1)), f"{90 * k}deg") for k in range(4)]
    cells = space.locate(poses).tolist()
    free = [k for k, cell in enumerate(cells) if cell >= 0]
    return Planner(space.boundary.scene, space), [poses[k] for k in free], [cells[k] for k in free]


def _box(scene: Scene) -> tuple[float, float, float, float]:
    if scene.bounds is not None:
        x0, y0, x1, y1 = map(float, scene.bounds)
        return x0, y0, x1, y1
    corners = np.vstack([p.vertices for p in (scene.workspace and [scene.workspace]) or scene.obstacles or scene.robot])
    (x0, y0), (x1, y1) = corners.min(axis=0) - 2, corners.max(axis=0) + 2
    return x0, y0, x1, y1


def scene_named(kind: str, number: int) -> PlainScene:
    """Scene of `fuzz`, or of `shapes`."""
    return fuzz.scene(kind, number) if kind in fuzz.KINDS else random_scene(number, kind)


def mistakes(kind: str, number: int, tally: Counter[str], most: int = 3) -> list[str]:
    """Faults of the answers in one random scene."""
    rng, plain = random.Random(f"{kind} {number}"), scene_named(kind, number)
    scene = scene_of(plain)
    planner, poses, cells = questions(scene, rng, 12)
    checker, wrong = MotionChecker(scene), []
    pairs = list(combinations(range(len(poses)), 2))
    rng.shuffle(pairs)
    for i, j in [(i, j) for i, j in pairs if cells[i] == cells[j]][:most]:
        between = PosePlanner(scene, planner.space)
        way = between.walk(poses[i], poses[j], Options())
        assert way is not None
        walked = between.path(way)
        tally["walks"] += 1
        if not (walked.is_free(checker) and walked.start == poses[i] and walked.goal == poses[j]):
            wrong.append(f"walk from {poses[i]} to {poses[j]} is not free")
    for i, j in [(i, j) for i, j in pairs if cells[i] != cells[j]][:most]:
        answer = planner.plan(poses[i], poses[j])
        tally["contact paths" if isinstance(answer, Path) else answer.of] += 1
        result = verified_in_a_file(scene, answer)
        if not result.verified:
            wrong.append(f"from {poses[i]} to {poses[j]}: {result.findings[:3]}")
    if number % 10 == 0:
        try:
            known = flood(plain, STEPS)
        except AtALoss:
            tally["floods at a loss"] += 1
            return wrong
        tally["floods"] += 1
        located = planner.free_space.locate(Poses(known.xy, known.theta))
        for name, ours, theirs in (("joins", known.certain, located), ("parts", located, known.possible)):
            rows = np.unique(np.column_stack([ours, theirs]), axis=0)
            if len(np.unique(rows[:, 0])) != len(rows):
                wrong.append(f"the flood {name} what the cells do not")
    return wrong


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", type=int, help="scenes")
    parser.add_argument("--seed", type=int, default=0)
    chosen = parser.parse_args()
    tally: Counter[str] = Counter()
    names = ((kind, k) for k in numbers(chosen.seed * 1_000_000) for kind in (*fuzz.KINDS, *KINDS))
    for kind, number in islice(names, chosen.count):
        try:
            wrong = mistakes(kind, number, tally)
        except (InvalidPolygonError, UnsupportedError):
            continue
        except Exception as error:
            wrong = [repr(error)[:400]]
        tally["scenes"] += 1
        if wrong:
            tally["wrong"] += 1
            print(f"{kind} {number}", *wrong, sep="\n  ", flush=True)
        if tally["scenes"] % 200 == 0:
            print(dict(tally), flush=True)
    print(dict(tally))
    sys.exit(tally["wrong"] > 0)


if __name__ == "__main__":
    main()
