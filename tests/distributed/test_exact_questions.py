"""Poses asked of a folder have the verdicts of the whole scene, also where doubles cannot tell them apart."""

from __future__ import annotations

import random
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cfree
from cfree import Pose, Poses
from cfree.distributed import Sharded, boundary

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
WALLS = [[(x, -20), (x + 1, -20), (x + 1, 20), (x, 20)] for x in (2, 40, 80)]
SCENE = cfree.Scene(SQUARE, WALLS, bounds=(-50, -50, 100, 100))
SPACE = cfree.free_space(cfree.boundary(SCENE))
SMALL = [Fraction(1, 10**k) for k in (15, 17, 30, 300)]


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> Sharded:
    return boundary(SCENE, folder=tmp_path_factory.mktemp("walls") / "x", tiles=3)


def near_contact() -> list[Pose]:
    """Beside walls, bounds and corners, and off these by less than doubles can say."""
    poses = [Pose(x + s, y) for x in (3, 1, 41, 100, -50) for y in (0,) for e in (*SMALL, 0) for s in (e, -e)]
    poses += [Pose(3, y + s) for y in (20, -21, 100) for e in (*SMALL, 0) for s in (e, -e)]
    turn = {
        "tau": Fraction(1, 3)
    }  # cos 4/5, sin 3/5: the lowest corner is the reference point, the leftmost one at -3/5
    return poses + [Pose(3 + Fraction(3, 5) + s, 0, turn) for e in SMALL for s in (e, -e)]


def test_exact_poses_have_the_verdicts_of_the_whole_scene(found: Sharded) -> None:
    poses = near_contact()
    expected = cfree.is_free(SCENE, poses)
    assert expected.any() and not expected.all()
    assert np.array_equal(found.is_free(poses), expected)
    assert found.locate(poses).tolist() == SPACE.locate(poses).tolist()
    assert [found.is_free(pose) for pose in poses] == expected.tolist()


def test_a_square_that_overlaps_a_wall_by_ten_to_the_minus_thirty_is_forbidden(found: Sharded) -> None:
    inside, beside = Pose(3 - Fraction(1, 10**30), 0), Pose(3, 0)
    assert (found.is_free(inside), found.is_free(beside)) == (False, True)
    assert found.is_free([inside, beside]).tolist() == [False, True]
    assert (found.locate(inside), found.locate(beside)) == (-1, 0)


@pytest.mark.parametrize("far", [10**20, 10**299, 10**301, 10**400, Fraction(10**400, 3)])
def test_poses_beyond_doubles_have_an_answer(far: Any, found: Sharded, tmp_path: Path) -> None:
    poses = [Pose(far, 0), Pose(0, -far), Pose(-far, far)]
    assert found.is_free(poses).tolist() == cfree.is_free(SCENE, poses).tolist() == [False] * 3
    assert found.locate(poses).tolist() == [-1] * 3
    without = boundary(cfree.Scene(SQUARE, WALLS), folder=tmp_path / "x")
    assert without.is_free(poses).tolist() == [True] * 3 and without.locate(poses).tolist() == [0] * 3


@pytest.mark.parametrize(
    "pose", [Pose(3, 0), (3, 0, 0), [3, "0", "0deg"], np.array([3.0, 0, 0]), (Fraction(5, 2), 0, 0.5), (2.5, 0, 7)]
)
def test_one_pose_has_one_verdict(pose: Any, found: Sharded) -> None:
    assert found.is_free(pose) is cfree.is_free(SCENE, pose)


@pytest.mark.parametrize(
    "poses",
    [
        [(3, 0, 0), (2.5, 0, 0), (3, 0, 9)],
        [(3, "0", 0), (2.5, 0, "1deg"), (3, 0, 0)],
        [Pose(3, 0), (2.5, 0, 0), (3, 0, -1)],
        np.array([[3.0, 0, 0], [2.5, 0, 0], [2.9999999, 3, -4]]),
        np.zeros((0, 3)),
        Poses([[3, 0], [2.5, 0], [0, 0]], [0, 0, -7]),
    ],
    ids=str,
)
def test_many_poses_are_taken_as_is_free_takes_them(poses: Any, found: Sharded) -> None:
    answer = found.is_free(poses)
    assert answer.dtype == bool and answer.tolist() == cfree.is_free(SCENE, poses).tolist()


def test_poses_may_come_one_after_the_other(found: Sharded) -> None:
    assert found.is_free(pose for pose in [(3, 0, 0), (2.5, 0, 0)]).tolist() == [True, False]
    assert found.is_free([]).shape == (0,)


def test_what_is_no_pose_is_named(found: Sharded) -> None:
    with pytest.raises(ValueError, match=r"poses\[1\]: theta: 'north' is no number"):
        found.is_free([(0, 0, 0), (0, 0, "north")])
    with pytest.raises(ValueError, match=r"give \(n, 3\)"):
        found.is_free(np.zeros((2, 2)))


@pytest.mark.slow
def test_random_exact_poses_have_the_verdicts_of_the_whole_scene(found: Sharded) -> None:
    rng = random.Random(3)
    poses = []
    for _ in range(300):
        tau = Fraction(rng.randint(-9, 9), rng.randint(1, 9))
        corner = rng.choice(Pose(0, 0, {"tau": tau}).apply_exact(SQUARE))
        x, y = rng.choice([2, 3, 40, 41, 80, 81]) - corner[0], rng.choice([-20, 20, 0, 7]) - corner[1]
        poses.append(Pose(x + rng.choice([1, 0, -1]) * rng.choice(SMALL), y, {"tau": tau}))
    assert found.is_free(poses).tolist() == cfree.is_free(SCENE, poses).tolist()
    assert found.locate(poses).tolist() == SPACE.locate(poses).tolist()
