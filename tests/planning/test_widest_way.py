"""The largest discs that get from start to goal: closed forms, ties, contact, and cells of discs near them."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

import fuzz_widest
from cfree import Curved, Path, Pose, Scene, Separated, UndecidedError, max_margin, plan
from cfree.curves import Arc
from cfree.exact.surd import Surd
from cfree.planning.widest_way import WidestWay, widest_way
from shapes import box

POINT = Curved.circle((0, 0), "1/8")
WEDGE = [(-60, -1), (0, 0), (-60, 1)]  # its corner is at the origin
ROOM = box(-40, -99, 40, 99)[0]


def way_among(obstacles: Any, start: Any = (0, 80, 0), goal: Any = (0, -80, 0), **limits: Any) -> WidestWay:
    way = widest_way(Scene(POINT, obstacles, **{"workspace": ROOM, **limits}), Pose(*start), Pose(*goal))
    assert way is not None
    return way


@pytest.mark.parametrize(
    "one, other, radius",
    [
        (box(-60, -2, -1, 2)[0], box("4/3", -2, 60, 2)[0], Fraction(7, 6)),
        (
            [(-60, -2), (0, -2), (3, 2), (-60, 2)],
            [(2, -2), (60, -2), (60, 2), (5, 2)],
            Fraction(4, 5),
        ),  # a slope of 4:3
        (WEDGE, [(3, 2), (60, 2), (60, 3)], Surd(0, Fraction(1, 2), 13)),
        (WEDGE, [(0, -5), (60, -5), (60, 10), (5, 5)], Surd(0, Fraction(1, 2), 5)),  # an edge, two to the right
        (Curved.circle((-60, 0), 60), Curved.circle((63, 2), 60), Surd(-60, Fraction(1, 2), 15133)),
        (WEDGE, Curved([(5, 2), (60, 2), (60, 3)], grown=1), Surd(Fraction(-1, 2), Fraction(1, 2), 29)),
    ],
)
def test_a_gap_is_half_as_wide_as_its_sides_are_apart(one: Any, other: Any, radius: Any) -> None:
    found = way_among([one, other])
    assert found.radius == radius and found.at and found.at.obstacles == (0, 1)
    assert found.margin is not None and found.margin + Fraction(1, 8) == radius


def test_a_lattice_of_equal_gaps_has_the_width_of_one() -> None:
    """All gaps of the lattice are tied, and so are some of those beside the workspace."""
    posts = [Curved.circle((4 * x, 4 * y), 1) for x in range(-3, 4) for y in (0, 1)]
    squares = [box(4 * x - 1, 4 * y - 1, 4 * x + 1, 4 * y + 1)[0] for x in range(-3, 4) for y in (0, 1)]
    for obstacles in (posts, squares):
        for half in (14, "31/2"):
            found = way_among(obstacles, (0, 25, 0), (0, -25, 0), workspace=box(-Fraction(half), -30, half, 30)[0])
            assert found.radius == max(1, (Fraction(half) - 13) / 2)


def test_the_ends_and_the_bounds_stop_discs_too() -> None:
    found = way_among([], (-39, 0, 0))
    assert found.radius == 1 and str(found.at) == "beside the workspace at the start"
    wall = box(-9, -1, 3, 1)[0]
    found = way_among([wall], bounds=(-9, -99, 6, 99))  # to the rim of the bounds, which may be touched
    assert found.radius == 3 and found.at and found.at.obstacles == (0, -1) and found.at.point[0] == 6
    assert way_among([wall], (6, 80, 0), (6, -80, 0), bounds=(-9, -99, 6, 99)).radius == 3
    assert way_among([wall], bounds=(-9, -99, 3, 99)).radius == 0
    assert way_among([wall], (0, 0, 0)).radius == 0
    assert way_among([wall], (50, 0, 0)).radius == 0  # outside of the workspace
    free = widest_way(Scene(POINT, bounds=(-9, -9, 9, 9)), Pose(0, 0), Pose(1, 1))
    assert free and free.radius is None and free.margin is None


def test_other_scenes_are_left_to_intervals() -> None:
    def is_known(robot: Any, *obstacles: Any, **limits: Any) -> bool:
        return widest_way(Scene(robot, obstacles, **limits), Pose(0, 9), Pose(9, 0)) is not None

    aside, oval = Curved.circle((1, 0), 1), Curved.ellipse((0, 0), (1, 2))
    assert is_known(POINT) and is_known(aside, WEDGE)
    assert not is_known(WEDGE) and not is_known(aside, bounds=(-9, -9, 9, 9)) and not is_known([POINT, aside])
    assert not is_known(POINT, oval) and not is_known(POINT, workspace=Curved.ellipse((0, 0), (20, 30)))


def wall(arc: Arc, x: Any, y: Any, up: int) -> Curved:
    """A wall from -60 to 60 below a line, or above it, with an arc around (x, y) in the place of a piece of it."""
    a, b = 60 * up, y - 9 * up
    return Curved([(2 * x - arc.to[0], y), arc, (-a, y), (-a, b), (a, b), (a, y)])


def bump(x: Any, y: Any, up: int) -> Curved:
    x, y = Fraction(x), Fraction(y)
    return wall(Arc((x - up, y), center=(x, y)), x, y, up)


def bay(up: int) -> Curved:
    return wall(Arc((-3 * up, 0), center=(0, 0), clockwise=True), 0, 0, up)


@pytest.mark.parametrize(
    "obstacles, x, y, radius",
    [
        ([bump(0, 0, 1), bump(2, 4, -1)], 40, 2, Surd(-1, 1, 5)),  # two arcs
        ([bump(0, 0, 1), box(-60, 4, 60, 9)[0]], 40, 2, Fraction(3, 2)),  # an arc and an edge
        (
            [bump(0, 0, 1), [(1, 3), (60, 90), (-60, 90)]],
            40,
            2,
            Surd(Fraction(-1, 2), Fraction(1, 2), 10),
        ),  # and a corner
        ([bump(0, 0, 1), bump("1/2", "15/8", -1)], 40, 1, Fraction(0)),  # arcs that cross
        ([bay(1), Curved.circle((0, -1), 1), box(-60, 0, 60, 9)[0]], 2, -1, Fraction(1, 2)),  # a pin in a bay
        ([bay(1), [(0, -2), (1, 1), (-1, 1)], box(-60, 0, 60, 9)[0]], 2, -1, Fraction(1, 2)),  # a corner in a bay
        ([bay(1), bay(-1), box(-1, -9, 1, 1)[0]], 2, 0, Surd(Fraction(3, 2), Fraction(-1, 2), 2)),  # a bar across a bay
    ],
)
def test_gaps_at_arcs_have_closed_forms(obstacles: Any, x: int, y: int, radius: Any) -> None:
    """From the left to the right."""
    way = widest_way(Scene(POINT, obstacles, workspace=box(-50, -99, 50, 99)[0]), Pose(-x, y), Pose(x, y))
    assert way and way.radius == radius


@pytest.mark.parametrize("seed", [6, 15, 19])
def test_cells_of_discs_a_little_smaller_and_larger_agree(seed: int) -> None:
    assert fuzz_widest.check(seed)


@pytest.mark.parametrize("seed", range(4))
def test_cells_agree_among_shapes_with_arcs(seed: int) -> None:
    assert fuzz_widest.check(seed, fuzz_widest.with_arcs)


@pytest.mark.slow
def test_the_largest_clearance_is_decided_at_itself_and_named_where_time_runs_out() -> None:
    posts = [Curved.circle((x, 0), 1) for x in (0, 3, 6)]
    scene = Scene(POINT, posts, workspace=box(0, -3, 6, 3)[0], start=(3, 2, 0), goal=(3, -2, 0))
    largest = max_margin(scene).exact
    assert largest == Fraction(3, 8)
    for more, expected in ((0, Path), (Fraction(1, 2**40), Separated)):
        assert isinstance(plan(scene, clearance=largest.p + more, improve=0), expected)
    with pytest.raises(UndecidedError, match="that a path keeps is exactly 3/8, between obstacle") as caught:
        plan(scene, clearance="0.376", max_seconds=1e-9)
    assert caught.value.lo <= largest <= caught.value.hi
