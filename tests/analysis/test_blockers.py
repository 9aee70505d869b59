"""Obstacles without which there is a way: all of them, and no others."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from cfree import MotionChecker, Path, Pose, Scene, blockers, plan
from compared import scene_of
from fuzz_plan import questions, scene_named
from shapes import KINDS, box
from spaces import hollow

SQUARE = box(0, 0, 1, 1)


def without(scene: Scene, k: int) -> Scene:
    others = [o for i, o in enumerate(scene.obstacles) if i != k]
    return Scene(scene.robot, others, bounds=scene.bounds, workspace=scene.workspace)


def by_trying_each(scene: Scene, start: Pose, goal: Pose) -> list[int]:
    count = len(scene.obstacles)
    return [k for k in range(count) if isinstance(plan(without(scene, k), start, goal, improve=0), Path)]


def test_one_of_two_walls_is_in_the_way_and_neither_of_two_in_a_row() -> None:
    low, high, other = box(2, -9, 3, -1)[0], box(2, -1, 3, 9)[0], box(-4, -4, -3, -3)[0]
    bounds, start, goal = (-5, -5, 5, 5), Pose(0, 0), Pose(4, 0)
    scene = Scene(SQUARE[0], [other, low, high], obstacle_names=["box", "low", "high"], bounds=bounds)
    found = blockers(scene, start, goal)
    assert [blocker.obstacle for blocker in found] == [1, 2]
    for blocker in found:
        assert blocker.path.is_free(MotionChecker(without(scene, blocker.obstacle))) and blocker.path.goal == goal
        assert blocker.path.scene and len(blocker.path.scene.obstacle_names) == 2
    again = Scene(SQUARE[0], [other, low, high, box("2.5", -9, 4, 9)[0]], bounds=bounds)
    assert blockers(again, start, Pose(5, 0)) == ()


def test_bounds_and_workspace_are_none() -> None:
    scene = Scene(SQUARE[0], [box(2, -9, 3, 9)[0]], workspace=hollow((-5, -5, 9, 5), (6, -4, 8, 4))[0])
    assert [b.obstacle for b in blockers(scene, (0, 0, 0), (4, 0, 0))] == [0]
    caged = Scene(SQUARE[0], [box(20, 0, 21, 1)[0]], bounds=(0, 0, 1, 1))
    with pytest.raises(ValueError, match="start and goal are joined: nothing is in the way"):
        blockers(caged, (0, 0, 0), (1, 1, 0))


def test_paths_that_touch_count() -> None:
    """In a slot as wide as the robot only one that touches leads out; a lid that is on no surface shuts it."""
    slot = [box(-3, 0, 0, 9)[0], box(1, 0, 4, 9)[0]]
    scene = Scene(SQUARE[0], [*slot, box(-1, -5, 2, -1)[0], box(-3, 9, 4, 10)[0]], bounds=(-8, -8, 8, 12))
    start, goal = Pose(0, 8), Pose(6, 0)
    asked = [k for k in range(4) if isinstance(plan(without(scene, k), start, goal, improve=0), Path)]
    if isinstance(plan(scene, start, goal), Path):
        with pytest.raises(ValueError, match="nothing is in the way"):
            blockers(scene, start, goal)
    else:
        assert [b.obstacle for b in blockers(scene, start, goal)] == asked
    shut = Scene(scene.robot, [*scene.obstacles, box(-3, -1, 4, 0)[0]], bounds=scene.bounds)
    assert [b.obstacle for b in blockers(shut, start, goal)] == by_trying_each(shut, start, goal) != []


def test_with_a_clearance() -> None:
    walls = [box(2, -9, 3, -1)[0], box(2, 1, 3, 9)[0], box(-4, 3, -3, 4)[0]]
    scene, ends = Scene(SQUARE[0], walls, bounds=(-5, -5, 5, 5)), (Pose(0, 0), Pose(4, 0))
    found = blockers(scene, *ends, clearance="0.6")
    assert [b.obstacle for b in found] == [0, 1] and all(b.path.clearance == Fraction("0.6") for b in found)
    with pytest.raises(ValueError, match="nothing is in the way"):
        blockers(scene, *ends, clearance="0.4")


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_all_of_them_and_no_others(kind: str) -> None:
    """In random scenes, with a frame of four walls around half of each so that something separates."""
    asked = 0
    for seed in range(2):
        plain, rng = scene_named(kind, seed), random.Random(f"{kind} {seed}")
        walls = [box(-3, -3, 6, "-2.5"), box(-3, 5, 6, "5.5"), box(-3, -3, "-2.5", 5), box("5.5", -3, 6, 5)]
        scene = scene_of(plain._replace(obstacles=[*plain.obstacles, *walls]))
        _, poses, cells = questions(scene, rng, 10)
        pairs = [(p, q) for p, i in zip(poses, cells, strict=True) for q, j in zip(poses, cells, strict=True) if i < j]
        for start, goal in rng.sample(pairs, min(2, len(pairs))):
            if isinstance(plan(scene, start, goal, improve=0), Path):
                continue
            found = [blocker.obstacle for blocker in blockers(scene, start, goal)]
            assert found == by_trying_each(scene, start, goal)
            asked += 1
    assert asked or kind == "workspace"
