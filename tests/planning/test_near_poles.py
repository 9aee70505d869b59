from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cfree import MotionChecker, Pose, Rotation, Scene
from cfree.collision.motion import motion_between
from cfree.planning.near_poles import near_poles
from cfree.planning.pose_planner import PosePlanner
from shapes import box

ROD = Scene(box(0, 0, 4, 1)[0], [box(-9, -1, 30, 0)[0], box(-9, 9, 30, 10)[0]])  # its corner slides on a floor
SIZE = 39


def poles(poses: list[Pose]) -> list[float]:
    """How far they are, of the motions that turn."""
    pairs = [(a, motion_between(a, b)) for a, b in pairwise(poses)]
    return [math.hypot(m.pole[0] - a.x, m.pole[1] - a.y) for a, m in pairs if isinstance(m, Rotation)]


@pytest.mark.parametrize("tau", ["1e-5", "1e-9", "1e-60", "-1e-9"])
@pytest.mark.parametrize("y", [0, 3])
def test_a_small_turn_on_a_long_way_is_a_turn_and_a_translation(tau: str, y: int) -> None:
    if y == 0 and tau.startswith("-"):  # into the floor
        return
    checker, way = MotionChecker(ROD), [Pose(0, y), Pose(20, y, {"tau": tau})]
    assert min(poles(way)) > 1000 * SIZE
    found = near_poles(ROD, checker, way)
    assert (found[0], found[-1]) == (way[0], way[1]) and len(found) == 3
    assert checker.joins(found) and max(poles(found)) <= 1000 * SIZE


@pytest.mark.slow
@settings(max_examples=50, deadline=None)
@given(*[st.fractions(1, 4, max_denominator=99)] * 2, st.fractions("1e-15", "1e-6"))
def test_paths_have_no_far_poles_where_there_is_room(x: Fraction, y: Fraction, tau: Fraction) -> None:
    goal = Pose(x, y, {"tau": tau})
    path = PosePlanner(ROD).path([Pose(0, 2), goal])
    assert path.goal == goal and len(path.motions) <= 8 and max(poles([*path.poses])) <= 1000 * SIZE


def test_where_no_proof_succeeds_a_far_pole_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(MotionChecker, "first_free", lambda *_: None)
    way = [Pose(0, 3), Pose(20, 3, {"tau": "1e-9"}), Pose(20, 4)]
    assert near_poles(ROD, MotionChecker(ROD), way) == way


def test_near_poles_and_translations_are_left_alone() -> None:
    way = [Pose(0, 3), Pose(9, 3), Pose(9, 4, {"tau": "1/9"})]
    assert near_poles(ROD, MotionChecker(ROD), way) == way
