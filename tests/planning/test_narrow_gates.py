"""Gates that are narrower than the robot: a polygon inside the robot proves that there is no path."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from typing import Any

import pytest

import cfree
import cfree.verify

PLANK = [(-2, "-1/2"), (2, "-1/2"), (2, "1/2"), (-2, "1/2")]
TENTHS = [
    (-19, -5), (19, -5), (20, -4), (20, 4), (19, 5), (5, 5), (5, 0), (-5, 0), (-5, 5), (-19, 5), (-20, 4), (-20, -4)
]  # fmt: skip
NOTCHED = [(Fraction(x, 10), Fraction(y, 10)) for x, y in TENTHS]  # with cut corners, and a notch in the upper side
AROUND: dict[str, dict[str, Any]] = {
    "workspace": {"workspace": [(0, 0), (24, 0), (24, 12), (0, 12)]},
    "bounds": {"bounds": (0, 0, 24, 12)},
}


def rooms(gap: Fraction, robot: Any, seed: int = 0, **around: Any) -> cfree.Scene:
    """Two rooms with furniture, and a wall between them with a gate."""
    rng = random.Random(seed)
    walls = [[(11, -9), (12, -9), (12, 5), (11, 5)], [(11, 5 + gap), (12, 5 + gap), (12, 21), (11, 21)]]
    places = [(Fraction(rng.randint(60, 150), 8), rng.choice([1, 2, 9, 10])) for _ in range(12)]  # none before the gate
    posts = [[(x, y), (x + Fraction(1, 4), y), (x, y + Fraction(1, 4))] for x, y in places]
    return cfree.Scene(robot, walls + posts, start=(3, 6, 1), goal=(21, 6, 2), **around)


@pytest.mark.parametrize("around", AROUND)
@pytest.mark.parametrize("gap", [Fraction(3, 4), 1 - Fraction(1, 1 << 12)])
def test_few_vertices_prove_it(gap: Fraction, around: str) -> None:
    scene = rooms(gap, NOTCHED, **AROUND[around])
    answer = cfree.plan(scene)
    assert isinstance(answer, cfree.Separated)
    assert answer.of == "closed"
    assert [len(part) for part in answer.robot] == [4]
    assert cfree.verify.answer(scene, answer).verified
    back = cfree.plan(scene, (21, 6, 2), (3, 6, 1))
    assert isinstance(back, cfree.Separated)
    assert cfree.verify.answer(scene, back.reversed()).verified


@pytest.mark.parametrize("around", AROUND)
@pytest.mark.parametrize("gap", [1 - Fraction(1, 1 << 40), Fraction(1), 1 + Fraction(1, 1 << 12), Fraction(3, 2)])
@pytest.mark.parametrize("robot", [PLANK, NOTCHED], ids=["plank", "notched"])
def test_gates_about_as_wide_as_the_robot_are_decided_as_before(gap: Fraction, around: str, robot: Any) -> None:
    scene = rooms(gap, robot, **AROUND[around])
    answer = cfree.plan(scene, improve=0)
    assert isinstance(answer, cfree.Path) == (gap >= 1)
    assert cfree.verify.answer(scene, answer).verified


@pytest.mark.parametrize("seed", range(6))
def test_a_wall_that_can_be_passed_at_its_end_is_no_proof(seed: int) -> None:
    scene = rooms(Fraction(1, 2), NOTCHED, seed)
    answer = cfree.plan(scene, improve=0)
    assert isinstance(answer, cfree.Path)
    assert cfree.verify.answer(scene, answer).verified


def test_an_updated_planner_takes_such_a_proof() -> None:
    scene = rooms(Fraction(3, 4), NOTCHED, **AROUND["workspace"])
    planner = cfree.Planner(scene)
    assert isinstance(planner.plan((3, 6, 1), (21, 6, 2)), cfree.Separated)
    moved = scene.moved(len(scene.obstacles) - 1, cfree.Pose(Fraction(1, 8), 0))
    answer = planner.updated(moved).plan((3, 6, 1), (21, 6, 2))
    assert isinstance(answer, cfree.Separated)
    assert cfree.verify.answer(moved, answer).verified


@pytest.mark.parametrize("power", [-161, -158, -156, -149, 0, 100])
def test_sizes_at_the_ends_of_doubles_do_no_harm(power: int) -> None:
    unit = 10.0**power
    disc = [(unit * math.cos(math.tau * k / 100), unit * math.sin(math.tau * k / 100)) for k in range(100)]
    box, room = ([(-c, -c), (c, -c), (c, c), (-c, c)] for c in (3 * unit, 2 * unit))
    answer = cfree.plan(cfree.Scene(disc, [cfree.Polygon(box, [room])]), (0, 0, 0), (50 * unit, 0, 0), improve=0)
    assert isinstance(answer, cfree.Separated)
