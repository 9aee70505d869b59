"""Paths among segments and circular arcs turn no more than they need to."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import pytest

import cfree
import cfree.verify
from cfree import Curved, Pose, Preferences, Scene
from fuzz_round import box, rounded, stadium

HALF = Fraction(1, 2)
ROBOTS = {
    "disc": Curved.circle((0, 0), HALF),
    "disc beside its reference point": Curved.circle(("3/10", "1/5"), HALF),
    "stadium": stadium(HALF, Fraction(1, 4)),
    "car": rounded(-HALF, -Fraction(1, 4), HALF, Fraction(1, 4), Fraction(1, 8)),
}
PILLARS = [Curved.circle((x, y), "3/5") for x, y in [(-4, 1), (-2, -2), (0, 2), (1, -1), (3, 3), (4, "-5/2"), (-3, 4)]]
YARD = (-8, -8, 8, 8)


def planned(scene: Scene, start: Any, goal: Any, **options: Any) -> cfree.Path:
    path = cfree.plan(scene, start, goal, **options)
    assert isinstance(path, cfree.Path) and cfree.verify.answer(scene, path).verified
    return path


def needed(path: cfree.Path) -> float:
    """The turn from start to goal."""
    return abs(math.remainder(path.goal.theta - path.start.theta, math.tau))


@pytest.mark.slow
@pytest.mark.parametrize("robot", ROBOTS.values(), ids=ROBOTS)
@pytest.mark.parametrize("tau", [0, "1/3", "-2/3"])
def test_a_path_does_not_turn_if_start_and_goal_agree(robot: Curved, tau: Any) -> None:
    scene = Scene(robot, PILLARS, bounds=YARD)
    for y in (-3, 0, 3):
        for improve in (0.0, None):
            path = planned(scene, (-7, y, {"tau": tau}), (7, -y, {"tau": tau}), improve=improve)
            assert path.turning == 0


@pytest.mark.slow
@pytest.mark.parametrize("robot", ROBOTS.values(), ids=ROBOTS)
@pytest.mark.parametrize("objective", ["short", "balanced"])
def test_a_path_turns_only_from_the_orientation_of_its_start_to_that_of_its_goal(robot: Curved, objective: Any) -> None:
    scene = Scene(robot, PILLARS, bounds=YARD)
    for degrees in ("20deg", "-70deg", "130deg"):
        path = planned(scene, (-7, 2, 0), (7, -1, degrees), objective=objective)
        assert path.turning <= needed(path) + 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("objective", ["short", "balanced", "clear"])
def test_a_disc_that_just_fits_through_gaps_does_not_turn(objective: Any) -> None:
    pillars = [Curved.circle((2 * i, 2 * j), HALF) for i in range(4) for j in range(4)]
    scene = Scene(Curved.circle((0, 0), "0.499999"), pillars, workspace=box(0, 0, 6, 6))
    for improve in (0.0, None):
        assert planned(scene, (1, 1, 0), (5, 5, 0), improve=improve, objective=objective).turning == 0


@pytest.mark.slow
def test_a_robot_that_has_to_turn_turns_there_and_back() -> None:
    walls = [box(-HALF, -9, HALF, -HALF), box(-HALF, HALF, HALF, 9)]
    scene = Scene(stadium(1, Fraction(1, 4)), [*walls, *PILLARS[4:6]], bounds=YARD)
    upright = {"tau": 1}
    path = planned(scene, (-6, 0, upright), (6, 0, upright))
    least = 2 * (math.pi / 2 - math.asin(1 / 2))  # it fits through the gap within this of lying down
    assert least / 2 < path.turning < 1.1 * math.pi


@pytest.mark.slow
def test_a_turn_that_widens_a_narrow_place_much_is_made() -> None:
    """Upright it fits through with a hundredth of room on either side; lying down, with much more."""
    gap = Fraction(5, 4) + Fraction(1, 100)
    walls = [box(-HALF, -9, HALF, -gap), box(-HALF, gap, HALF, 9)]
    scene = Scene(stadium(1, Fraction(1, 4)), [*walls, PILLARS[4]], bounds=YARD)
    upright = {"tau": 1}
    path = planned(scene, (-4, 1, upright), (4, -1, upright))
    place = cfree.clearance(path, scene)
    assert place is not None and place.least > 0.1 and path.turning > 1


@pytest.mark.slow
def test_preferences_still_turn_a_robot_along_its_way() -> None:
    scene = Scene(ROBOTS["car"], PILLARS, bounds=YARD)
    ahead = planned(scene, Pose(-7, 0, "90deg"), Pose(7, 1, "90deg"), preferences=Preferences(sideways=5))
    assert ahead.turning > 1
