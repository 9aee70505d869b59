"""Cells of the free space, against closed forms, brute-force floods and exact overlap tests."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

import oracles
from cfree import FreeSpace, Polygon, Pose, Poses, Scene, boundary, free_space, load_scene
from compared import plain_of, scene_of
from flood import flood
from shapes import KINDS, PlainScene, box, random_scene

ROOT = Path(__file__).parents[1]
SMALL = sorted(p for p in (ROOT / "examples/scenes").glob("*.json") if p.stat().st_size < 6_000)


def space_of(plain: PlainScene) -> FreeSpace:
    return free_space(boundary(scene_of(plain), threads=1))


def hollow(
    outer: tuple[int, int, int, int], inner: tuple[int, int, int, int]
) -> tuple[list[tuple[int, int]], list[list[tuple[int, int]]]]:
    return box(*outer)[0], [box(*inner)[0][::-1]]


ROD = box(-3, -1, 3, 1)
TIGHT = hollow((-5, -3, 5, 3), (-4, -2, 4, 2))  # the rod turns a little, but not round


def check_against_flood(plain: PlainScene, space: FreeSpace, steps: int) -> int:
    """How many cells the flood tells apart with certainty."""
    found = flood(plain, steps)
    cell = space.locate(Poses(found.xy, found.theta))
    assert np.all(cell >= 0)
    for numbers, other in ((found.certain, cell), (cell, found.possible)):
        pairs = np.unique(np.column_stack([numbers, other]), axis=0)
        assert len(np.unique(pairs[:, 0])) == len(pairs)  # one `other` for each number
    return len(np.unique(found.possible))


@pytest.mark.parametrize("kind", KINDS)
def test_cells_are_those_of_a_flood(kind: str) -> None:
    for seed in range(3):
        plain = random_scene(seed, kind)
        check_against_flood(plain, space_of(plain), 90)


@pytest.mark.parametrize("path", SMALL, ids=lambda path: path.stem)
def test_cells_of_examples_are_those_of_a_flood(path: Path) -> None:
    scene = load_scene(path)
    check_against_flood(plain_of(scene), free_space(boundary(scene, threads=1)), 120)


def test_a_rod_in_a_tight_box_has_two_caged_cells() -> None:
    plain = PlainScene([ROD], [TIGHT])
    space = space_of(plain)
    assert [(c.bounded, c.caged, c.turns) for c in space.cells] == [(False, False, 1), (True, True, 0), (True, True, 0)]
    assert check_against_flood(plain, space, 400) == 3
    assert space.locate([Pose(0, 0, 0), Pose(0, 0, math.pi)]).tolist() in ([1, 2], [2, 1])
    for cell in space.cells[1:]:
        start, stop = cell.theta_range
        # the diagonal of the rod, (6, 2), is as high as the box at its extreme angle: 6 sin + 2 cos = 4
        extreme = math.asin(4 / math.hypot(6, 2)) - math.atan2(2, 6)
        assert stop - start == pytest.approx(2 * extreme, abs=1e-12)


def test_no_obstacles() -> None:
    space = free_space(boundary(Scene(robot=ROD[0])))
    assert len(space) == 1 and not space.cells[0].bounded and space.locate(Pose(0, 0)) == 0
    assert space.locate([]).tolist() == []
    empty = free_space(boundary(Scene(robot=ROD[0], workspace=box(0, 0, 1, 1)[0])))
    assert len(empty) == 0 and empty.locate(Pose(0, 0)) == -1


def test_a_room_in_a_room() -> None:
    # robot at large in the outer room, around a box whose inside is a room, too
    plain = PlainScene([box(0, 0, 1, 1)], [hollow((10, 10, 30, 30), (12, 12, 28, 28))], bounds=(0, 0, 40, 40))
    space = space_of(plain)
    assert sorted((c.caged, c.full_turn, len(c.components)) for c in space.cells) == [(False, True, 2), (True, True, 1)]
    assert space.depth.tolist().count(2) == 1
    inside, outside = space.locate([Pose(20, 20), Pose(5, 5)])
    assert space.cells[inside].caged and not space.cells[outside].caged
    assert space.locate([Pose(50, 5), Pose(11, 11)]).tolist() == [-1, -1]


def test_poses_on_the_boundary_are_in_the_cell_they_bound() -> None:
    plain = PlainScene([box(0, 0, 1, 1)], [hollow((-1, -1, 5, 5), (0, 0, 4, 4))])
    space = space_of(plain)
    third = Fraction(1, 3)
    inside = [Pose(0, third), Pose(3, third), Pose(3, 3), Pose(0, 0), Pose(4, 4, "180deg"), Pose(1, 2, "90deg")]
    assert space.locate(inside).tolist() == [1] * 6
    assert space.locate([Pose(-2, third), Pose(5, third), Pose(-2, -2)]).tolist() == [0] * 3
    tiny = Fraction(1, 10**40)
    assert space.locate([Pose(-tiny, third), Pose(tiny, third), Pose(3 + tiny, 3)]).tolist() == [-1, 1, -1]
    turned = Pose(2, 2, {"tau": "1/3"})  # lowest corner at the origin of the robot: on the floor
    assert space.locate([Pose(2, 0, {"tau": "1/3"}), Pose(2, -tiny, {"tau": "1/3"}), turned]).tolist() == [1, -1, 1]


def test_an_exact_fit_is_free_and_in_no_cell() -> None:
    square = box(0, 0, 1, 1)
    space = space_of(PlainScene([square], [hollow((-1, -1, 2, 2), (0, 0, 1, 1))]))
    assert space.locate([Pose(0, 0), Pose(1, 0, "90deg"), Pose("1/9", 0)]).tolist() == [-2, -2, -1]
    assert len(space) == 1


@pytest.mark.parametrize("kind", KINDS)
def test_location_agrees_with_exact_overlap(kind: str) -> None:
    rng = np.random.default_rng(0)
    for seed in range(2):
        plain = random_scene(seed + 7, kind)
        space = space_of(plain)
        x0, y0, x1, y1 = oracles.box_of([*plain.obstacles, *([plain.workspace] if plain.workspace else [])])
        for _ in range(25):  # simple numbers: many contacts
            x, y = (
                Fraction(int(rng.integers(2 * math.floor(a), 2 * math.ceil(b))), 2) for a, b in ((x0, x1), (y0, y1))
            )
            tau = rng.choice([Fraction(0), Fraction(1), Fraction(-1), Fraction(1, 2), Fraction(-3, 7), None])
            free = not oracles.exact_is_forbidden(
                plain.robot, plain.obstacles, x, y, tau, plain.bounds, plain.workspace
            )
            assert (space.locate(Pose(x, y, {"tau": tau})) != -1) == free


@pytest.mark.parametrize("seed", range(4))
def test_removing_an_obstacle_never_splits_a_cell(seed: int) -> None:
    plain = random_scene(seed, "bounds")
    found = flood(plain, 40)
    poses = Poses(found.xy, found.theta)
    spaces = [space_of(plain._replace(obstacles=plain.obstacles[:k])) for k in (len(plain.obstacles), 1, 0)]
    for more, fewer in pairwise(space.locate(poses) for space in spaces):
        assert np.all(fewer >= 0)
        assert len(np.unique(np.column_stack([more, fewer]), axis=0)) == len(np.unique(more))
