"""Exact scales, margins and insets of polygons: decided for robots a little smaller and larger.

Run it for many scenes: `python tests/support/fuzz_exact_values.py FIRST LAST`.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from fractions import Fraction
from typing import Any

from cfree import Pose, Scene, boundary, free_space, max_margin, max_scale, nearest_miss
from cfree.analysis.inset_shapes import exact_inset
from cfree.curves.similar import similar
from cfree.scene.scene import grown_scene, with_shapes

NEAR = Fraction(1, 2**40)


def scene_of(seed: int) -> Scene:
    """A robot before a gate, or two one behind the other; gaps are mostly between parallel edges, some at corners."""
    r = random.Random(seed)
    a, b, c = (Fraction(r.randint(3, 12), r.choice([4, 7])) for _ in range(3))
    robot: Any = r.choice(
        [
            [(-a, -b), (a, -b), (a, b), (-a, b)],
            [(-a, -b), (a, -b), (a, b), (0, b + c), (-a, b)],
            [(-3 * a, -4 * a), (3 * a, -4 * a), (0, 4 * a)],
        ]
    )
    obstacles: list[Any] = []
    for y in (0, -8)[: r.randint(1, 2)]:
        x, gap, shift = r.randint(-3, 3), Fraction(r.randint(4, 30), 7), r.choice([0, 0, 3])
        obstacles += [[(-30, y), (x, y), (x, y + 1), (-30, y + 2)]]
        obstacles += [[(x + gap, y + shift), (30, y + shift), (30, y + shift + 3), (x + gap, y + shift + 3)]]
    start, goal = Pose(r.randint(-9, 9), 12, r.choice([0, "90deg"])), Pose(r.randint(-9, 9), -16, 0)
    return Scene(robot, obstacles, workspace=[(-20, -24), (20, -24), (20, 20), (-20, 20)], start=start, goal=goal)


def joined(scene: Scene) -> bool:
    assert scene.start and scene.goal
    return free_space(boundary(scene)).common_cell(scene.start, scene.goal) is not None


def check(seed: int) -> list[str]:
    """Check one scene; return what is known exactly."""
    scene, known = scene_of(seed), list[str]()
    scale = max_scale(scene, tolerance=0.05).exact
    if scale is not None:
        known.append("scale")
        for by, expected in ((-NEAR, True), (NEAR, False)):
            assert joined(with_shapes(scene, [similar(part, scale.p + by) for part in scene.robot])) is expected, seed
    if joined(scene):
        margin = max_margin(scene, tolerance=0.05).exact
        if margin is not None:
            known.append("margin")
            assert margin <= NEAR or joined(grown_scene(scene, margin.p - NEAR)), seed
            assert not joined(grown_scene(scene, margin.p + NEAR)), seed
    else:
        miss = nearest_miss(scene, tolerance=0.05)
        if miss is not None and miss.exact is not None:
            known.append("miss")
            for by, expected in ((-NEAR, False), (NEAR, True)):
                smaller = exact_inset(scene.robot[0], miss.exact.p + by)
                assert smaller is None or joined(with_shapes(scene, [smaller])) is expected, seed  # None: irrational
    return known or ["nothing"]


def main(first: int, last: int) -> None:
    print(Counter(what for seed in range(first, last) for what in check(seed)))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
