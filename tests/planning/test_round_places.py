"""Places at which any orientation will do, among round shapes: free, forbidden, moved, or undecided."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

import cfree
import cfree.verify
from cfree import Curved, InvalidPoseError, Pose, Scene
from cfree.planning.round_places import is_free_place
from fuzz_round import Frame, box, stadium

PEG = stadium(1, 1)  # as wide as 2
YARD = (-12, -12, 12, 12)
FLOOR = box(-9, -9, 9, -1)


def slot(half: Any, frame: Frame | None = None) -> list[Any]:
    walls = [box(-6, -6, 6, -Fraction(half)), box(-6, half, 6, 6)]
    return [frame.shape(wall) for wall in walls] if frame else walls


@pytest.mark.parametrize(
    ("robot", "obstacles", "is_free"),
    [
        (Curved.circle((0, 0), 1), [FLOOR], True),  # it touches the floor
        (Curved.circle((0, 0), 1), [box(-9, -9, 9, "-0.99")], False),
        (PEG, slot(1), True),
        (PEG, slot("0.99999"), False),
        (PEG, slot(1, Frame(Fraction(1, 3))), True),
        (Curved.ellipse((0, 0), (2, 1)), slot("1.1"), True),
        (Curved.ellipse((0, 0), (2, 1)), slot("0.9"), False),
        (Curved.ellipse((0, 0), (2, 1)), slot(1), None),  # polygons decide neither way
    ],
)
def test_a_place_is_free_if_an_orientation_is(robot: Curved, obstacles: list[Any], is_free: bool | None) -> None:
    assert is_free_place(Scene(robot, obstacles), (Fraction(0), Fraction(0))) is is_free


POST = {
    "polygons": (box(-1, -1, 1, 1), box(4, -1, 6, 1)),
    "arcs": (Curved.circle((0, 0), 1), Curved.circle((5, 0), 1)),
    "other curves": (Curved.ellipse((0, 0), (1, "1.2")), Curved.ellipse((5, 0), (1, "1.5"))),
}


@pytest.mark.parametrize("kind", POST)
@pytest.mark.parametrize(("clearance", "place", "why"), [(None, 5, "no orientation is free"), ("1/2", "2.8", "nearer")])
def test_a_forbidden_place_is_refused_beside_a_goal_that_is_free(
    kind: str, clearance: str | None, place: Any, why: str
) -> None:
    robot, post = POST[kind]
    scene = Scene(robot, [post], bounds=(-9, -9, 9, 9))
    for k, goals in enumerate(([(place, "0.1"), (0, 5, 0)], [(0, 5, 0), (place, "0.1")])):
        with pytest.raises(InvalidPoseError, match=rf"goal {k} .*{why}.*give another place"):
            cfree.plan(scene, (-5, 0, 0), goals, clearance=clearance)


@pytest.mark.slow
@pytest.mark.parametrize("goal", [(0, 0), Pose(0, 0)])
@pytest.mark.parametrize(("half", "clearance"), [(1, None), (2, 1)])
def test_a_goal_that_is_free_is_not_moved(goal: Any, half: int, clearance: int | None) -> None:
    """The peg touches both sides of its slot, or has the clearance from them exactly."""
    scene = Scene(PEG, slot(half), bounds=YARD)
    path = cfree.plan(scene, (-10, 0, 0), goal, nearest_free=True, clearance=clearance)
    assert isinstance(path, cfree.Path) and path.moved is None and (path.goal.x, path.goal.y) == (0, 0)
    assert cfree.verify.answer(scene, path).verified


@pytest.mark.slow
def test_a_start_and_a_place_that_touch_are_not_moved() -> None:
    scene = Scene(Curved.circle((0, 0), 1), [FLOOR], bounds=YARD)
    path = cfree.plan(scene, (-5, 0, 0), (5, 0), nearest_free=True)
    assert isinstance(path, cfree.Path) and path.moved is None and path.start == Pose(-5, 0)
    sunk = cfree.plan(scene, (-5, "-1/10", 0), (5, "-1/10"), nearest_free=True)
    assert isinstance(sunk, cfree.Path) and sunk.moved is not None
    assert sunk.moved.start == Pose(-5, "-1/10") and sunk.moved.goal == (5, Fraction(-1, 10))
