"""Corridors exactly as wide as a rounded robot, and touches along a whole turn: no interior, so no cell."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction as F

import pytest

import cfree._core as core
from cfree import Curved, Pose, Scene, boundary, free_space
from cfree.free.space import NO_CELL

Point = tuple[F, F]
Turn = Callable[[object, object], Point]
TURNS = {"level": (F(1), F(0)), "3-4-5": (F(3, 5), F(4, 5)), "5-12-13": (F(5, 13), F(-12, 13))}
HAIRS = F(1, 2**20), F(1, 2**60)
BOUNDS = (0, 0, 10, 10)


def turned_by(name: str) -> Turn:
    c, s = TURNS[name]
    return lambda x, y: (c * F(x) - s * F(y), s * F(x) + c * F(y))  # type: ignore[arg-type]


def box(x0: object, y0: object, x1: object, y1: object, turn: Turn | None = None) -> list[Point]:
    turn = turn or turned_by("level")
    return [turn(x0, y0), turn(x1, y0), turn(x1, y1), turn(x0, y1)]


def rooms(robot: object, obstacles: list[object], turn: Turn) -> Scene:
    return Scene(robot, obstacles, workspace=box(-9, -9, 9, 9, turn))  # type: ignore[arg-type]


def grown(corners: list[Point], radius: object) -> Curved:
    return Curved(corners, grown=radius)  # type: ignore[arg-type]


def cells(scene: Scene) -> int:
    return len(free_space(boundary(scene)).cells)


# a corridor along the right bound: room beyond the width of the robot -> scene; cells with more room, and without
AT_BOUNDS: dict[str, tuple[Callable[[F], Scene], int, int]] = {
    "a disc and a wall": (
        lambda more: Scene(Curved.circle((0, 0), 1), [box(2, -5, 9 - more, 15)], bounds=BOUNDS), 2, 1,
    ),
    "a disc and walls on both sides": (
        lambda more: Scene(Curved.circle((0, 0), 1), [box(1 + more, -5, 9 - more, 15)], bounds=BOUNDS), 2, 0,
    ),
    "a disc and a round wall": (
        lambda more: Scene(Curved.circle((0, 0), "1/2"), [grown(box(2, -5, 9 - more, 15), "1/2")], bounds=BOUNDS), 2, 1,
    ),
    "a grown vertex at the reference point": (
        lambda more: Scene(
            grown([(F(0), F(0)), (F(2), F(0)), (F(0), F(1))], "1/2"), [box(3, -5, F(19, 2) - more, 15)], bounds=BOUNDS
        ), 2, 1,
    ),
    "a disc at the reference point, and more of the robot": (
        lambda more: Scene(
            [Curved.circle((x, 0), "1/2") for x in (0, 2)], [box(3, -5, F(19, 2) - more, 15)], bounds=BOUNDS
        ), 2, 1,
    ),
    "a disc above a bound": (
        lambda more: Scene(
            Curved.circle((0, 0), "1/2"),
            [Curved.circle((5, F(3, 2) + more), 1), box("9/2", 2, "11/2", 15)],
            bounds=BOUNDS,
        ), 1, 2,
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", AT_BOUNDS)
def test_a_slit_at_bounds_is_in_no_cell(name: str) -> None:
    made, with_room, without = AT_BOUNDS[name]
    assert cells(made(F(0))) == without
    for hair in HAIRS:
        assert cells(made(hair)) == with_room
        assert cells(made(-hair)) == without


def test_poses_in_a_slit_at_bounds_are_free_and_in_no_cell() -> None:
    made, _, _ = AT_BOUNDS["a disc and a wall"]
    space = free_space(boundary(made(F(0))))
    assert core.may_have_slits(space.boundary.features.core) and space.surfaces is not space.boundary
    assert space.locate([Pose(10, 5), Pose(10, 5, {"tau": 1}), Pose("19/2", 5), Pose("1/2", 5)]).tolist() == [
        NO_CELL, NO_CELL, -1, 0,
    ]  # fmt: skip
    assert not core.may_have_slits(boundary(made(HAIRS[1])).features.core)


# a gap between two rooms; a robot around a disc, and far from it
GAPS: dict[str, Callable[[F, Turn], Scene]] = {
    "a disc between walls": lambda more, turn: rooms(
        Curved.circle(turn(0, 0), 1), [box(-1, 1 + more, 1, 20, turn), box(-1, -20, 1, -1, turn)], turn
    ),
    "a disc between a wall and a round one": lambda more, turn: rooms(
        Curved.circle(turn(0, 0), "1/2"),
        [grown(box(-1, F(5, 4) + more, 1, 20, turn), "1/4"), box(-1, -20, 1, 0, turn)],
        turn,
    ),
    "a disc between the workspace and a wall": lambda more, turn: rooms(
        Curved.circle(turn(0, 0), 1), [box(-1, -7 + more, 1, 20, turn)], turn
    ),
    "two discs of a robot, along the corridor": lambda more, turn: rooms(
        [Curved.circle(turn(0, 0), 1), Curved.circle(turn("1/2", 0), 1)],
        [box(-1, 1 + more, 1, 20, turn), box(-1, -20, 1, -1, turn)],
        turn,
    ),
    "a disc between a disc and a wall": lambda more, turn: rooms(
        Curved.circle(turn(0, 0), 1),
        [Curved.circle(turn(0, 2 + more), 1), box("-1/2", 2, "1/2", 20, turn), box(-2, -20, 2, -1, turn)],
        turn,
    ),
    "a disc between discs": lambda more, turn: rooms(
        Curved.circle(turn(0, 0), 1),
        [
            *(Curved.circle(turn(0, y), 1) for y in (2 + more, -2)),
            box("-1/2", 2, "1/2", 20, turn),
            box("-1/2", -20, "1/2", -2, turn),
        ],
        turn,
    ),
    "a disc between a corner and a wall": lambda more, turn: rooms(
        Curved.circle(turn(0, 0), 1),
        [[turn(0, 1 + more), turn(2, 5), turn(2, 20), turn(-2, 20), turn(-2, 5)], box(-2, -20, 2, -1, turn)],
        turn,
    ),
}


def flask(more: F, turn: Turn, radius: F) -> Scene:
    """Return a robot with a mouth as wide as a disc."""
    half = F(1, 2) + radius
    right = [(3, -3), (3, 3), (half + more, 3), (half + more, 2), (2, 2), (2, -2)]
    corners = [*right, *((-x, y) for x, y in right[::-1])]
    places = [turn(x if x > 0 else min(x + more, -half), y) if abs(x) < 2 else turn(x, y) for x, y in corners]
    robot = grown(places, radius) if radius else places
    return Scene(robot, [Curved.circle((0, 0), "1/2")], bounds=(-20, -20, 20, 20))  # type: ignore[arg-type]


def tongs(more: F, turn: Turn, radius: F) -> Scene:
    """Return a robot with two tips that are as far apart as a disc is wide."""
    tip = F(1, 2) + radius + more / 2
    upper = [(-5, 3), (-1, 3), (0, tip), (1, 4), (-6, 4)]
    places = [turn(x, y) for x, y in [*((x, -y) for x, y in upper[::-1]), *upper]]
    robot = grown(places, radius) if radius else places
    return Scene(robot, [Curved.circle((3, 4), "1/2")], bounds=(-20, -20, 20, 20))  # type: ignore[arg-type]


GAPS["a mouth around a disc"] = lambda more, turn: flask(more, turn, F(0))
GAPS["a round mouth around a disc"] = lambda more, turn: flask(more, turn, F(1, 4))
GAPS["tips around a disc"] = lambda more, turn: tongs(more, turn, F(0))
GAPS["round tips around a disc"] = lambda more, turn: tongs(more, turn, F(1, 4))


@pytest.mark.slow
@pytest.mark.parametrize("name", GAPS)
@pytest.mark.parametrize("turn", TURNS)
def test_a_gap_exactly_as_wide_is_in_no_cell(name: str, turn: str) -> None:
    """Cells are those of a gap narrower by a hair; one wider by a hair joins two of them."""
    scene = GAPS[name]
    assert cells(scene(F(0), turned_by(turn))) == cells(scene(-HAIRS[0], turned_by(turn))) == 2
    for hair in HAIRS:
        assert cells(scene(hair, turned_by(turn))) == 1


@pytest.mark.parametrize("turn", TURNS)
def test_slits_that_meet_in_one_place_are_in_no_cell(turn: str) -> None:
    """Four unit squares at spacing 3/2, and a disc of radius 1/4: no ray of their slits was in general position."""
    place = turned_by(turn)
    corners = [(F(3, 2) * i, F(3, 2) * j) for i in (0, 1) for j in (0, 1)]
    squares = [box(x, y, x + 1, y + 1, place) for x, y in corners]
    space = free_space(boundary(Scene(Curved.circle((0, 0), "1/4"), squares)))  # type: ignore[arg-type]
    assert len(space.cells) == 2 and space.cells[1].caged


@pytest.mark.parametrize("turn", [(1, 0), (0, 1), (-1, 0), (0, -1)])
@pytest.mark.parametrize(
    "wall", [[(39, 27), (41, 27), (41, 30)], [(20, 27), (60, 27), (40, 30)], [(40, 27), (60, 27), (60, 30)]]
)
@pytest.mark.parametrize("length", [0, 2])
def test_a_bound_owns_what_it_has_in_common_with_a_wall_less_a_radius(
    length: int, wall: list[Point], turn: tuple[int, int]
) -> None:
    """A disc about the reference point touches a wall where that point is on the bounds: the wall changes nothing."""
    robot = grown([(0, 0), (length, F(1, 8)), (length, F(-1, 8))], F(1)) if length else Curved.circle((0, 0), 1)
    c, s = turn

    def place(x: int, y: int) -> tuple[int, int]:
        return c * x - s * y, s * x + c * y

    low, high = (place(x, y) for x, y in ((32, 20), (48, 26)))
    bounds = tuple(f(a, b) for f in (min, max) for a, b in zip(low, high, strict=True))
    walls = [[place(x, y) for x, y in wall], [place(x, y) for x, y in ((30, 10), (31, 10), (31, 11))]]
    space = free_space(boundary(Scene(robot, walls, bounds=bounds)))  # type: ignore[arg-type]
    assert len(space.cells) == 1 and (length or abs(space.volumes[0] - 16 * 6 * 2 * math.pi) < 1e-9)
