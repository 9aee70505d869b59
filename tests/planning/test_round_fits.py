"""Exact fits among rounded shapes, level and slanted: found, and not passed if the robot is wider by a hair."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction as F

import pytest

import cfree
import cfree.verify
from cfree import Curved, Pose, Scene
from cfree.curves import Arc, Circle

Point = tuple[F, F]
Turn = Callable[[object, object], Point]
Corners = tuple[object, object, object, object]
HAIR = F(1, 2**60)
TURNS = {"level": (F(1), F(0), F(0)), "3-4-5": (F(3, 5), F(4, 5), F(1, 2))}  # cosine, sine, half-angle tangent


def turned_by(name: str) -> Turn:
    c, s, _ = TURNS[name]
    return lambda x, y: (c * F(x) - s * F(y), s * F(x) + c * F(y))  # type: ignore[arg-type]


def box(turn: Turn, x0: object, y0: object, x1: object, y1: object) -> list[Point]:
    return [turn(x0, y0), turn(x1, y0), turn(x1, y1), turn(x0, y1)]


def room(turn: Turn) -> list[list[Point]]:
    return [box(turn, *sides) for sides in ((-9, 8, 9, 9), (-9, -9, 9, -8), (-9, -9, -8, 9), (8, -9, 9, 9))]


def disc(excess: F) -> Curved:
    return Curved.circle((0, 0), F(1, 2) + excess)


def stadium(excess: F) -> Curved:
    return Curved([(-1, "-1/4"), (1, "-1/4"), (1, "1/4"), (-1, "1/4")], grown=F(1, 4) + excess)


L_CORRIDOR: list[Corners] = [
    (-4, "1/2", "-1/2", 4),
    (-4, -8, 4, "-1/2"),
    ("1/2", "-1/2", 4, 4),
    (-8, 4, "-1/2", "9/2"),
    (4, "7/2", 8, 4),
]
Z_CORRIDOR: list[Corners] = [
    (-4, "1/2", "-1/2", 4),
    (-4, -8, "1/2", "-1/2"),
    ("1/2", -8, 4, "3/2"),
    ("-1/2", "5/2", 4, 8),
    (-4, 4, 0, 8),
]
STRAIGHT: list[Corners] = [(-3, "1/2", 3, 8), (-3, -8, 3, "-1/2")]


def pocket(turn: Turn) -> Curved:
    """Return a block with a hole of half a disc at its end."""
    corners = [(0, -3), (6, -3), (6, 3), (0, 3), (0, "1/2"), (3, "1/2")]
    return Curved([*(turn(x, y) for x, y in corners), Arc(turn(3, "-1/2"), through=turn("7/2", 0)), turn(0, "-1/2")])


def block(turn: Turn, hole: list[object]) -> Curved:
    """Return a block with a hole of points and of arcs about the middle, which have a point and a sense."""
    ring = [
        Arc(turn(*item[0]), center=turn(0, 0), clockwise=item[1]) if isinstance(item[0], tuple) else turn(*item)
        for item in hole  # type: ignore[index, misc]
    ]
    return Curved(box(turn, -9, -9, 9, 9), [ring])


def half_ring(turn: Turn) -> list[object]:
    """Two rooms that a half ring joins, of the width of a disc."""
    bay: list[object] = [(4, 0), ((-4, 0), False), (-4, -5), (4, -5)]
    core = [turn(3, 0), Arc(turn(-3, 0), center=turn(0, 0))]
    stem = [turn(*p) for p in ((-3, -1), (-1, -1), (-1, -5), (1, -5), (1, -1), (3, -1))]
    return [block(turn, bay), Curved([*core, *stem])]


def bend(turn: Turn) -> list[object]:
    """A corridor with a round bend, everywhere of the width of a disc."""
    return [block(turn, [(4, 0), ((0, 4), False), (-3, 4), (-3, 3), (0, 3), ((3, 0), True), (3, -3), (4, -3)])]


def among(boxes: list[Corners]) -> Callable[[Turn], list[object]]:
    """Return the obstacles of a turned room with these boxes."""
    return lambda turn: [*room(turn), *(box(turn, *corners) for corners in boxes)]


# robot, obstacles and places of start and goal; the robot lies along the x axis that is turned
Place = tuple[object, object]
FITS: dict[str, tuple[Callable[[F], Curved], Callable[[Turn], list[object]], Place, Place]] = {
    "a disc around a corner": (disc, among(L_CORRIDOR), (-6, 0), (0, 6)),
    "a disc around two corners": (disc, among(Z_CORRIDOR), (-6, 0), (6, 2)),
    "a peg along a corridor": (stadium, among(STRAIGHT), (-6, 0), (6, 0)),
    "a disc into a round pocket": (disc, lambda turn: [pocket(turn)], (-5, 2), (3, 0)),
    "a disc around a half ring": (disc, half_ring, ("-5/2", -3), ("5/2", -3)),
    "a disc along a round bend": (disc, bend, (-2, "7/2"), ("7/2", -2)),
    "between two discs": (
        disc,
        lambda turn: [
            *room(turn),
            *(Curved.circle(turn(0, y), 1) for y in ("3/2", "-3/2")),
            box(turn, "-1/2", "3/2", "1/2", 8),
            box(turn, "-1/2", -8, "1/2", "-3/2"),
        ],
        (-6, 0),
        (6, 0),
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.long) if "half ring" in name else name for name in FITS]
)
def test_an_exact_fit_is_passed_and_one_too_narrow_by_a_hair_is_not(name: str, turn: str) -> None:
    robot, obstacles, start, goal = FITS[name]
    place, tau = turned_by(turn), TURNS[turn][2]
    begin, end = (Pose(*place(*at), {"tau": tau}) for at in (start, goal))
    scene = Scene(robot(F(0)), obstacles(place))  # type: ignore[arg-type]
    path = cfree.plan(scene, begin, end)
    assert isinstance(path, cfree.Path) and cfree.verify.answer(scene, path).verified
    if "pocket" in name or "bend" in name:  # the goal is free no more
        return
    wider = Scene(robot(HAIR), obstacles(place))  # type: ignore[arg-type]
    proof = cfree.plan(wider, begin, end)
    assert isinstance(proof, cfree.Separated) and proof.of == "closed"
    assert cfree.verify.answer(wider, proof).verified


HOLE = [(5, 0), (-3, 4), (-3, -4)]  # on a circle of radius 5, on all sides of its middle
WALLS = [[(-5, y), (5, y), (5, y + 1), (-5, y + 1)] for y in (F(1, 2), F(-3, 2))]
HELD = {
    "along a slot": (Scene(stadium(F(0)), WALLS), Pose(-4, 0), Pose(4, 0)),
    "out of a slot, and back turned": (Scene(stadium(F(0)), WALLS), Pose(0, 0), Pose(0, 0, "180deg")),
    "in a hole": (
        Scene(Curved.circle((0, 0), 2), [Curved.circle(at, 3) for at in HOLE]), Pose(0, 0), Pose(0, 0, "77deg")
    ),
    "discs around a disc": (
        Scene([Curved.circle(at, 3) for at in HOLE], [Curved.circle((0, 0), 2)]), Pose(0, 0), Pose(0, 0, "200deg")
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", HELD)
def test_a_path_joins_poses_on_isolated_parts(name: str) -> None:
    scene, start, goal = HELD[name]
    assert len(cfree.boundary(scene).isolated)
    path = cfree.plan(scene, start, goal)
    assert isinstance(path, cfree.Path) and (path.start, path.goal) == (start, goal)
    assert cfree.verify.answer(scene, path).verified


@pytest.mark.parametrize("place", [(0, 0), (1, 0)])
def test_a_disc_turns_around_in_a_ring_that_it_fills_and_does_not_leave_it(place: Point) -> None:
    """The reference point may be elsewhere: the disc turns with the robot, then about its own center."""
    ring = Curved([(-6, -6), (6, -6), (6, 6), (-6, 6)], [Circle((0, 0), 4)])
    scene = Scene(Curved.circle(place, 1), [ring, Curved.circle((0, 0), 2)])
    start, *goals = [Pose(x - place[0], y - place[1]) for x, y in ((3, 0), (0, 3), (-3, 0))]
    for goal in goals:
        path = cfree.plan(scene, start, goal)
        assert isinstance(path, cfree.Path) and cfree.verify.answer(scene, path).verified
    proof = cfree.plan(scene, start, Pose(9, 9))
    assert isinstance(proof, cfree.Separated) and proof.of == "closed"


def test_no_path_leaves_a_point_or_a_curve_that_is_held_on_all_sides() -> None:
    square = Curved([(-1, -1), (1, -1), (1, 1), (-1, 1)], grown=F(1, 2))
    room = [(F(-3, 2), F(-3, 2)), (F(3, 2), F(-3, 2)), (F(3, 2), F(3, 2)), (F(-3, 2), F(3, 2))]
    turned = cfree.plan(Scene(square, [], workspace=room), Pose(0, 0), Pose(0, 0, "90deg"))
    assert isinstance(turned, cfree.Separated) and turned.of == "closed"
