"""Paths and proofs where little or nothing is to spare: gaps of 2^-k, exact fits turned by long rationals."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, permutations
from typing import Any

import pytest

import cfree.verify
from cfree import MotionChecker, Path, Pose, Scene, Slide, boundary, free_space, nearest_miss, plan
from cfree.errors import InvalidPoseError
from cfree.planning.options import Options
from cfree.planning.pose_planner import PosePlanner

F = Fraction
Ring = Sequence[tuple[Any, Any]]
LONG = F(1234567890123456789, 9876543210987654361)
TURNS = [F(0), F(10007, 30011), F(30011, 90017), LONG]
SQUARE = [(F(-1, 2), F(-1, 2)), (F(1, 2), F(-1, 2)), (F(1, 2), F(1, 2)), (F(-1, 2), F(1, 2))]


def placed(rings: Sequence[Ring], tau: Fraction, offset: int) -> list[Ring]:
    at = Pose(offset, -offset, {"tau": tau})
    return [at.apply_exact(ring) for ring in rings]


def posed(x: Any, y: Any, theta: Any, tau: Fraction, offset: int) -> Pose:
    return Pose(offset, -offset, {"tau": tau}) @ Pose(x, y, theta)


def answered(scene: Scene, start: Pose, goal: Pose) -> str:
    """The verdict, the same both ways, verified."""
    verdicts = set()
    for first, last in ((start, goal), (goal, start)):
        found = plan(scene, first, last, improve=0)
        assert (found.start, found.goal) == (first, last)
        result = cfree.verify.answer(scene, found)
        assert result.verified, result.findings
        verdicts.add("path" if isinstance(found, Path) else found.of)
    (verdict,) = verdicts
    return verdict


def walked(scene: Scene, start: Pose, goal: Pose) -> Path:
    """Without a search."""
    space = free_space(boundary(scene))
    planner = PosePlanner(space.boundary.scene, space)
    way = planner.walk(start, goal, Options())
    assert way is not None
    return planner.path(way)


def slot(gap: Fraction | int, tau: Fraction, offset: int, reference: int = 0) -> Scene:
    """For a unit square, as long as two of it, in a room; the square's reference point is to the left of it."""
    half = F(gap) / 2
    lower = [(1, -9), (3, -9), (3, -half), (1, -half)]
    upper = [(1, half), (3, half), (3, 9), (1, 9)]
    *walls, room = placed([lower, upper, [(-9, -9), (9, -9), (9, 9), (-9, 9)]], tau, offset)
    return Scene([(x + reference, y) for x, y in SQUARE], walls, workspace=room)


# --- in one cell ---


@pytest.mark.slow
@pytest.mark.parametrize("k, offset, tau", [(1, 0, F(0)), (42, 10**9, LONG), (100, 0, F(0)), (300, 0, F(1, 3))])
def test_a_rectangle_turns_in_a_room_hardly_wider_than_its_diagonal(k: int, offset: int, tau: Fraction) -> None:
    side = 5 * (1 + F(1, 2**k))
    (room,) = placed([[(0, 0), (side, 0), (side, side), (0, side)]], tau, offset)
    scene = Scene([(0, 0), (4, 0), (4, 3), (0, 3)], [], workspace=room)
    ends = posed(0, 0, 0, tau, offset), posed(side, 0, "90deg", tau, offset)
    assert len(walked(scene, *ends).motions) < 1000
    assert answered(scene, *ends) == "path"


@pytest.mark.slow
@pytest.mark.parametrize("k", [30, 42, 100, 300])
def test_a_slot_hardly_wider_than_a_rod_can_be_left(k: int) -> None:
    half = (1 + F(1, 2**k)) / 2
    walls = [[(half, -9), (9, -9), (9, 9), (half, 9)], [(-9, -9), (-half, -9), (-half, 9), (-9, 9)]]
    scene = Scene([("-1/2", -2), ("1/2", -2), ("1/2", 2), ("-1/2", 2)], walls, bounds=(-20, -30, 20, 30))
    for start in (Pose(0, 0), Pose(F(1, 2 ** (k + 1)), 0), Pose(0, 0, {"tau": F(1, 2 ** (k + 3))})):
        path = walked(scene, start, Pose(0, 20, "90deg"))
        assert path.is_free(MotionChecker(scene))


# --- exact fits ---


@pytest.mark.slow
@pytest.mark.parametrize("offset", [0, 10**9])
@pytest.mark.parametrize("tau", TURNS)
def test_a_square_goes_through_a_slot_as_wide_as_it_however_both_are_turned(tau: Fraction, offset: int) -> None:
    scene = slot(1, tau, offset)
    ends = posed(-4, "1/3", {"tau": "1/3"}, tau, offset), posed(6, "-1/7", {"tau": "-1/5"}, tau, offset)
    assert answered(scene, *ends) == "path"
    assert answered(scene, posed("3/2", 0, 0, tau, offset), ends[1]) == "path"


@pytest.mark.slow
@pytest.mark.parametrize("reference", [1, 80, 1000])
def test_the_reference_point_does_not_matter(reference: int) -> None:
    scene = slot(1, LONG, 0, reference)
    ends = (posed(x, y, theta, LONG, 0) @ Pose(-reference, 0) for x, y, theta in ((-4, 1, "9deg"), (6, 1, "-7deg")))
    assert answered(scene, *ends) == "path"


@pytest.mark.parametrize("k", [120, 300])
def test_orientations_in_trapezoids_thinner_than_doubles_tell(k: int) -> None:
    """A key in a hole of its shape but for 2^-k, the reference point a million away: angles nearer than doubles."""
    tiny = F(1, 2**k)
    hole = [(1, -2), (1, 2), (-2, 1 + tiny), (0, 1 + tiny), (0, -1 - tiny)]
    scene = Scene([(x - 10**6, y) for x, y in ((1, -1), (1, 1), (-1, 1), (-1, -1))], [hole], bounds=None)
    ends = (Pose(x, y, theta) @ Pose(10**6, 0) for x, y, theta in ((-9, -1, "180deg"), (5, 1, "90deg")))
    assert answered(scene, *ends) == "path"


@pytest.mark.slow
@pytest.mark.parametrize("k", [30, 170, 300])
def test_a_slot_narrower_by_however_little_is_closed(k: int) -> None:
    scene = slot(1 - F(1, 2**k), F(1, 3), 0)
    ends = posed(-4, "1/3", {"tau": "1/3"}, F(1, 3), 0), posed(6, "-1/7", {"tau": "-1/5"}, F(1, 3), 0)
    assert answered(scene, *ends) == "closed"


def test_a_curve_named_by_another_edge_on_its_line_is_slid_along() -> None:
    """The hypotenuses of the triangles lie on two lines: the names of curves stand for all edges on a line."""
    corners = [[(1, 0), (1, 1), (0, 1)], [(0, 2), (1, 2), (0, 3)], [(4, 0), (4, 1), (3, 1)], [(3, 2), (4, 2), (3, 3)]]
    scene = Scene([(0, 0), (0, 1), ("-1/2", 1)], corners, workspace=[(0, 0), (4, 0), (4, 4), (0, 4)])
    assert answered(scene, Pose("3/2", 1, {"tau": "-1/2"}), Pose(0, 2, "180deg")) in ("path", "closed")


# --- both directions ---


def test_the_way_back_has_the_same_verdict_in_slits_along_bounds() -> None:
    scene = Scene([(0, -4), (5, -4), (5, 0), (0, 0)], [[(3, 4), (3, 5), (2, 5)]], bounds=(2, -1, 6, 5))
    assert answered(scene, Pose(2, 5, "90deg"), Pose(2, "31/7", "270deg")) == "path"


def test_slits_between_bounds_and_a_wall_are_gone_through() -> None:
    """The reference point, a vertex of the robot, slides down the bounds on a wall, and the robot turns there."""
    walls = [[(-1, -1), (0, -1), (0, 2), (-1, 2)], [(0, -3), (5, -3), (5, 0), (0, 0)]]
    scene = Scene([(0, -1), (1, -1), (1, 0), (0, 0)], walls, bounds=(-1, -1, 1, 4))
    assert answered(scene, Pose(-1, 3, "180deg"), Pose(-1, -1, 0)) == "path"


def test_poses_beyond_the_bounds_are_refused_before_any_search() -> None:
    scene = Scene([(0, 0), (1, 0), (0, 1)], bounds=(-5, -5, 1, 1))
    with pytest.raises(InvalidPoseError, match="start"):
        plan(scene, Pose(6, 7), Pose(4, 8), improve=0)


def test_slides_on_bounds_are_kept_by_the_reference_point() -> None:
    scene = Scene([(0, -1), (2, -1), (0, 1)], [[(5, 2), (4, 3), (0, 6)], [(0, 0), (2, 5), (1, 5)]], bounds=(0, 0, 9, 6))
    ends = Pose(6, "7/2", {"tau": "1/3"}), Pose("1/7", "32/7", {"tau": "-3"})
    assert answered(scene, *ends) == "path"
    for motion in plan(scene, *ends).motions:  # type: ignore[union-attr]
        for touch in motion.contacts if isinstance(motion, Slide) else ():
            assert (touch.robot[0] == -1) == (touch.obstacle[0] == -1)


# --- how much is missing ---


@pytest.mark.slow
@pytest.mark.parametrize("half", [F(1, 40), F(1, 60), F(1, 1000)])
def test_the_nearest_miss_of_a_narrow_slot(half: Fraction) -> None:
    walls = [[(-9, -1), (-half, -1), (-half, 1), (-9, 1)], [(half, -1), (9, -1), (9, 1), (half, 1)]]
    scene = Scene([(-1, -1), (1, -1), (1, 1), (-1, 1)], walls, workspace=[(-9, -9), (9, -9), (9, 9), (-9, 9)])
    miss = nearest_miss(scene, Pose(0, 5), Pose(0, -5))
    assert miss is not None and miss.lo <= 1 - half <= miss.hi


def test_the_nearest_miss_of_a_sofa_whose_inset_vanishes_before_its_largest_disc() -> None:
    """The legs are 0.8 wide and the disc in the corner has a radius of 0.46."""
    w = F(4, 5)
    sofa = [(0, 0), (3, 0), (3, w), (w, w), (w, 3), (0, 3)]
    walls = [[(-9, "-1/4"), ("-1/4", "-1/4"), ("-1/4", "1/4"), (-9, "1/4")]]
    walls += [[("1/4", "-1/4"), (9, "-1/4"), (9, "1/4"), ("1/4", "1/4")]]
    scene = Scene(sofa, walls, workspace=[(-9, -9), (9, -9), (9, 9), (-9, 9)])
    miss = nearest_miss(scene, Pose(0, 3), Pose(0, -7))
    assert miss is not None and 0.3 < miss.lo < miss.hi < 0.4


@pytest.mark.slow
def test_a_slit_goes_on_over_a_wall_at_an_irrational_orientation() -> None:
    """The bounds end where the workspace begins: only on that line the reference point may be."""
    obstacles = [[(1, 0), (1, 2), (0, 2)], [(2, 0), (2, 5), (0, 5)], [(0, 0), (2, 5), (0, 5)]]
    room = [(0, 0), (6, 0), (6, 6), (0, 6)]
    scene = Scene([(0, 0), (-1, 2), (-2, 0)], obstacles, workspace=room, bounds=(2, -3, 6, 0))
    for start, goal in permutations([Pose(2, 0, "270deg"), Pose(5, 0, 0)]):
        answer = plan(scene, start, goal, improve=0)
        assert isinstance(answer, Path) and cfree.verify.answer(scene, answer).verified


@pytest.mark.parametrize("wedge", [((1, 1), (1, -1)), ((5, 3), (3, -5)), ((1, 3), (1, -3)), ((3, 1), (3, -1))])
def test_slits_along_the_bounds_meet_in_their_corners(wedge: Ring) -> None:
    """An obstacle fills the bounds: the reference point goes around it, and the robot turns about each corner.

    A right-angled wedge leaves both slits there at one irrational orientation, a wider one turns along a curve between.
    """
    scene = Scene([(0, 0), *wedge], [[(-1, 0), (0, 0), (0, 1), (-1, 1)]], bounds=(-1, 0, 0, 1))
    sides = [Pose(0, "1/2", 0), Pose("-1/2", 1, "90deg"), Pose(-1, "1/2", "180deg"), Pose("-1/2", 0, "270deg")]
    assert {answered(scene, *ends) for ends in combinations(sides, 2)} == {"path"}


@pytest.mark.parametrize("at", [0, 10**9])
def test_the_reference_point_slides_on_bounds_where_a_vertex_of_the_robot_is(at: int) -> None:
    """A curve that both are on has the name of the vertex, which the bounds do not keep."""
    holed = cfree.Polygon([(2, -1), (2, 3), (-2, 3), (-2, -1)], [[(1, 0), (0, 1), (0, 0), (-1, 2), (1, 2)]])
    stop = [(at - 5, 0), (at - 5, -5), (at - 2, -5), (at - 2, 0)]
    scene = Scene([holed, [(2, 2), (-1, 1), (-1, -1)]], [stop], bounds=(at - 6, 0, at - 5, 2))
    for start, goal in permutations([Pose(at - 6, "2/3", "90deg"), Pose(at - 6, 2, "270deg")]):
        answer = plan(scene, start, goal, improve=0)
        assert isinstance(answer, Path) and cfree.verify.answer(scene, answer).verified


@pytest.mark.slow
@pytest.mark.parametrize("tau", TURNS)
def test_a_vertex_of_one_cell_is_on_an_edge_of_another(tau: Fraction) -> None:
    """The second has no vertex there."""
    turned = Pose(0, 0, {"tau": tau})
    obstacles = [[(-3, 0), (-2, 2), (-3, 5), (-6, 2), (-7, 0)], [(4, 2), (-1, 2), (-1, -2), (4, -2)]]
    scene = Scene(turned.apply_exact([(2, -1), (0, -1), (0, -2)]), obstacles, bounds=(-4, 0, -2, 4))
    for start, goal in permutations([Pose("-8/3", 4, "90deg"), Pose(-4, 4, "225deg")]):
        answer = plan(scene, start @ turned.inverse(), goal @ turned.inverse(), improve=0)
        assert isinstance(answer, Path) and cfree.verify.answer(scene, answer).verified


@pytest.mark.slow
def test_slides_keep_no_vertex_of_the_robot_on_the_bounds() -> None:
    """Though one is at the reference point, which alone is kept in them, and an obstacle's edge is on their line."""
    turn = F(46940192103, 183994963916)
    robot = [
        [(1, 2), (0, 2), (0, 0)],
        [(-1, 0), (-1, 2), (-2, 2), (-2, 0)],
        [(1, -1), (3, -1), (3, 0), (1, 0)],
    ]
    posed = Pose(0, 0, {"tau": turn})
    parts = [[(q.x, q.y) for q in (posed @ Pose(x, y) for x, y in part)] for part in robot]
    obstacles = [[(3, 0), (1, 0), (1, -3)], [(2, 2), (2, 3), (0, 3), (0, 2)]]
    scene = Scene(parts, obstacles, bounds=(-3, 0, 5, 3))
    for start, goal in permutations([Pose(-3, 3, "270deg") @ posed.inverse(), Pose(5, 1) @ posed.inverse()]):
        answer = plan(scene, start, goal, improve=0)
        assert isinstance(answer, Path) and cfree.verify.answer(scene, answer).verified


@pytest.mark.parametrize("frame", TURNS)
@pytest.mark.parametrize("quarters", range(4))
def test_bounds_that_an_obstacle_only_touches_are_gone_along(quarters: int, frame: Fraction) -> None:
    """At one orientation, at which no trapezoid of the bound ends, unless charts do."""
    turn, own = Pose(0, 0, f"{90 * quarters}deg"), Pose(0, 0, {"tau": frame})
    half = F(1, 2)
    obstacle = turn.apply_exact([(-3 * half, 3), (-3, 3 * half), (-5 * half, half)])
    (x0, y0), (x1, y1) = turn.apply_exact([(-4, 3 * half), (3 * half, 5 * half)])
    robot = own.apply_exact([(-half, 0), (-1, 0), (-1, -half)])
    scene = Scene(robot, [obstacle], bounds=(min(x0, x1), min(y0, y1), max(x0, x1), max(y0, y1)))
    start, goal = (turn @ at @ own.inverse() for at in (Pose(-4, 5 * half), Pose(3 * half, 5 * half, {"tau": F(4, 3)})))
    assert answered(scene, start, goal) == "path"
