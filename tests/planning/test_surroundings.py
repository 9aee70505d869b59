"""Two poses joined or apart by the surfaces around them, as all of the free space says."""

from __future__ import annotations

import pathlib
import random
import time
from collections.abc import Iterable
from copy import copy
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import cfree
from cfree import (
    FreeSpace,
    MotionChecker,
    Path,
    Planner,
    Pose,
    PoseChecker,
    Scene,
    boundary,
    free_space,
    load_scene,
    plan,
)
from cfree._core import Connecting, Verdict
from cfree.planning.core_ways import numbers_of, way_of
from cfree.planning.separation import known_scene
from cfree.scene.scene import robot_radius
from questions import random_question
from shapes import KINDS, random_scene
from spaces import INSIDE, OUTSIDE, room

ROOT = pathlib.Path(__file__).parents[2]


def connected(scene: Scene, start: Pose, goal: Pose) -> tuple[Connecting, Verdict]:
    found = known_scene(MotionChecker(scene)).connecting(numbers_of(start), numbers_of(goal))
    return found, found.decide()


def agrees(space: FreeSpace, start: Pose, goal: Pose) -> Verdict:
    """With all of the free space, off contacts; a way that is found is free, a surface one of all, however found."""
    scene = space.boundary.scene
    found, verdict = connected(scene, start, goal)
    if verdict == Verdict.JOINED:
        way = way_of(found.way(robot_radius(scene)), space.boundary.features, {})
        assert (way[0], way[-1]) == (start, goal) and MotionChecker(scene).joins(way)
    if min(space.locate([start, goal])) >= 0 and not any(len(space.nearby(pose).on) for pose in (start, goal)):
        same = space.common_cell(start, goal) is not None
        assert verdict == Verdict.UNCLEAR or verdict == (Verdict.JOINED if same else Verdict.APART)
    if verdict == Verdict.APART:
        surface = rows_of(found)
        again = known_scene(MotionChecker(scene)).connecting(numbers_of(start), numbers_of(goal))
        assert again.decide() == Verdict.APART and again.inside == found.inside
        assert rows_of(again) == surface
        assert any(
            surface == rows(space.surfaces.trapezoids, np.flatnonzero(space.component == k))
            for k in range(len(space.parent))
        )
    return verdict


def rows_of(found: Connecting) -> list[tuple[int | float, ...]]:
    """Of the surface."""
    assert found.surface is not None
    table = found.surface.boundary.trapezoids
    return rows(table, range(len(table.patch)))


def rows(table: Any, faces: Iterable[int]) -> list[tuple[int | float, ...]]:
    """Trapezoids in their order, by what they are."""
    columns = table.patch, table.chart, table.lower, table.upper, table.from_lo, table.to_hi
    return [tuple(column[k].item() for column in columns) for k in faces]


@pytest.mark.parametrize("kind", sorted(KINDS))
@pytest.mark.parametrize("seed", [1, *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(2, 8))])
def test_random_scenes_as_all_of_the_free_space_says(kind: str, seed: int) -> None:
    rng = random.Random(f"{kind} {seed}")
    asked = random_question(rng, random_scene(rng, kind))
    if asked is None:
        return
    space = free_space(boundary(asked.scene))
    forth, back = agrees(space, asked.start, asked.goal), agrees(space, asked.goal, asked.start)
    assert forth == back


@pytest.mark.parametrize("gap", ["1/2", "1/1000000", 1, "3/2"])
def test_a_room_that_opens(gap: str | int) -> None:
    space = room(Fraction(gap))
    assert agrees(space, INSIDE, OUTSIDE) == (Verdict.APART if Fraction(gap) <= 1 else Verdict.JOINED)


def test_islands_and_what_is_far_away() -> None:
    boxes = [[(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)] for x, y in ((0, 0), (-4, 0), (-9, 0), (0, 5), (-5, 5))]
    scene = Scene([(0, 0), (1, 0), (0, 1)], boxes)
    space = free_space(boundary(scene))
    assert agrees(space, Pose("5/2", "1/3"), Pose(3, "21/4", "170deg")) == Verdict.JOINED
    empty = Scene([(0, 0), (1, 0), (0, 1)], [], bounds=(0, 0, 4, 4))
    assert (
        agrees(free_space(boundary(empty)), Pose(0, 0), Pose(4, 4, "90deg")) == Verdict.JOINED
    )  # corners of the bounds


def test_cost_follows_the_answer() -> None:
    """What is far away is not trimmed: a hundred times as many obstacles."""
    near = [[(0, 0), (1, 0), (1, 9), (0, 9)], [(3, 0), (4, 0), (4, 9), (3, 9)]]
    far = [[(x, y), (x + 3, y), (x + 3, y + 3), (x, y + 3)] for x in range(50, 150, 5) for y in range(0, 50, 5)]
    scene = Scene([(0, 0), (1, 0), (0, 1)], near + far)
    found, verdict = connected(scene, Pose("3/2", 4), Pose(20, 4))
    assert verdict == Verdict.JOINED
    assert found.trimmed_patches < 0.05 * MotionChecker(scene).features.patches


@pytest.mark.slow
def test_answers_are_those_of_a_built_space() -> None:
    for name in ("nest_swim", "benchmr_parking1", "flat"):
        scene = load_scene(ROOT / f"examples/scenes/{name}.json")
        fresh = plan(scene, improve=0)
        built = plan(free_space(boundary(scene)), scene.start, scene.goal, improve=0)
        assert type(fresh) is type(built)
        assert cfree.verify.answer(scene, fresh).verified


def random_free(rng: random.Random, checker: PoseChecker) -> Pose:
    x, y = zip(*(point for part in checker.scene.obstacles for point in part.exact_vertices), strict=True)
    while True:
        pose = Pose(
            rng.uniform(float(min(x)), float(max(x))), rng.uniform(float(min(y)), float(max(y))), rng.uniform(0, 6)
        )
        if checker.is_free(pose):
            return pose


@pytest.mark.slow
@pytest.mark.parametrize("name", ["nest_shirts", "nest_swim"])
def test_a_kept_planner_answers_as_fresh_ones_do_and_gets_no_slower(name: str) -> None:
    """Trimmed patches and explored trapezoids are kept; a question's work follows the question, not those before it."""
    scene, rng, count = load_scene(ROOT / f"examples/scenes/{name}.json"), random.Random(5), 24
    checker = PoseChecker(scene)
    asked = [(random_free(rng, checker), random_free(rng, checker)) for _ in range(count)]
    kept, times, same = Planner(scene), np.zeros((2, count)), 0
    for k, (start, goal) in enumerate(asked):
        answers = []
        for row, planner in enumerate((Planner(copy(scene)), kept)):
            begin = time.process_time()
            answers.append(planner.plan(start, goal, improve=0))
            times[row, k] = time.process_time() - begin
        one, other = answers
        assert type(one) is type(other)
        same += len(one) == len(other) if isinstance(one, Path) and isinstance(other, Path) else 1
    assert same >= 0.9 * count
    fresh, ours = times[:, count // 2 :].sum(axis=1)
    assert times[1].sum() < 1.1 * times[0].sum() and ours < 1.1 * fresh
