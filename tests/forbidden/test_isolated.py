"""Free poses without any room: curves, segments at one orientation, points; compared with exact overlap tests."""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import oracles
from cfree import Boundary, boundary, load_scene
from cfree.forbidden.columns import ISOLATED_COLUMNS
from cfree.forbidden.patch import IsolatedPart
from compared import cross, minus, placed, plain_of, rotation, scene_of, slit_length
from shapes import PlainScene, box, mapped, moved, random_scene, rational_regular, scaled

ROOT = Path(__file__).parents[2]
RIM = [(-9, -9), (9, -9), (9, 9), (-9, 9)]
FAR = Fraction(1, 10**9)


def parts(plain: PlainScene) -> list[IsolatedPart]:
    result = boundary(scene_of(plain), threads=1)
    assert result.complex.components >= 0
    found = [result.isolated_part(k) for k in range(len(result.isolated))]
    for part in found:
        check(plain, result, part)
    return found


def forbidden(plain: PlainScene, x: Fraction, y: Fraction, turn: tuple[int, Fraction]) -> bool:
    """By separating axes, at chart and tau."""
    chart, tau = turn
    robot = [mapped(part, lambda u, v: (-u, -v)) for part in plain.robot] if chart else plain.robot
    return oracles.exact_is_forbidden(robot, plain.obstacles, x, y, tau, plain.bounds, plain.workspace)


def check(plain: PlainScene, result: Boundary, part: IsolatedPart) -> None:
    """The part is free, and next to it, at its own orientation, there is nothing free but the part itself."""
    columns = result.isolated
    chart = int(columns.chart[part.index])
    lo, hi = part.start.interval
    if part.kind == "curve":
        tau = (Fraction(part.start.interval[1]) + Fraction(part.stop.interval[0])) / 2
        x, y = crossing(result, part, chart, tau)
        assert not forbidden(plain, x, y, (chart, tau))
        for step in range(12):
            away = Fraction(math.cos(step)) * FAR, Fraction(math.sin(step)) * FAR
            assert forbidden(plain, x + away[0], y + away[1], (chart, tau))
        return
    (x0, y0, _), (x1, y1, _) = part.ends
    assert (part.kind == "point") == (math.hypot(x1 - x0, y1 - y0) < 1e-9)
    tau = simple(lo, hi)
    if tau is None:
        return
    place = Fraction(round((x0 + x1) / 2 * 2**20), 2**20), Fraction(round((y0 + y1) / 2 * 2**20), 2**20)
    exact = [Fraction(round(v * 5040)) / 5040 for v in ((x0 + x1) / 2, (y0 + y1) / 2)]
    if max(abs(float(e) - v) for e, v in zip(exact, ((x0 + x1) / 2, (y0 + y1) / 2), strict=True)) < 1e-12:
        place = exact[0], exact[1]
        assert not forbidden(plain, *place, (chart, tau))
    if part.kind == "segment":
        sideways = Fraction(y0 - y1) / 10**6, Fraction(x1 - x0) / 10**6
        for sign in (1, -1):
            assert forbidden(plain, place[0] + sign * sideways[0], place[1] + sign * sideways[1], (chart, tau))


def crossing(result: Boundary, part: IsolatedPart, chart: int, tau: Fraction) -> tuple[Fraction, Fraction]:
    """The exact place of a curve at tau: where its patch's line meets the one that it is named by."""
    from compared import own_contact

    turn = rotation(chart, tau)
    point, direction = placed(result.scene, own_contact(result.patches[part.patch]), turn)
    other, across = placed(result.scene, part.lower, turn)
    if part.lower.kind == "v-v":
        return other
    t = cross(minus(other, point), across) / cross(direction, across)
    return point[0] + t * direction[0], point[1] + t * direction[1]


def simple(lo: float, hi: float) -> Fraction | None:
    """The rational of few digits in an interval, if there is one."""
    guess = Fraction((lo + hi) / 2).limit_denominator(1000)
    return guess if Fraction(lo) <= guess <= Fraction(hi) else None


def kinds(found: list[IsolatedPart]) -> list[str]:
    return sorted(part.kind for part in found)


def degrees(found: list[IsolatedPart]) -> list[float]:
    return sorted(round(math.degrees(part.start.theta) % 360, 6) for part in found)


def test_a_corridor_as_wide_as_the_robot() -> None:
    corridor = PlainScene([box(0, 0, 2, 1)], [box(-5, -1, 5, 0), box(-5, 1, 5, 2)])
    found = parts(corridor)
    assert kinds(found) == ["segment", "segment"] and degrees(found) == [0, 180]
    assert found[0].ends[0][:2] != found[0].ends[1][:2]
    (x0, y0, _), (x1, y1, _) = found[0].ends
    assert {y0, y1} == {0.0} and sorted((x0, x1)) == [-7.0, 5.0]


def test_a_corridor_a_little_wider_or_narrower_has_none() -> None:
    for gap in (1 + FAR, 1 - FAR):
        assert parts(PlainScene([box(0, 0, 2, 1)], [box(-5, -1, 5, 0), box(-5, gap, 5, 2)])) == []


@pytest.mark.parametrize(
    ("peg", "orientations"),
    [
        (box(0, 0, 1, 1), 4),
        (box(0, 0, 2, 1), 2),
        (([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], []), 1),
        (([(1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (2, 2), (2, 3), (1, 3), (1, 2), (0, 2), (0, 1), (1, 1)], []), 4),
        (([(0, 0), (4, 0), (0, 3)], []), 1),
    ],
    ids=["square", "2 x 1", "L", "plus", "3-4-5 triangle"],
)
def test_a_peg_in_a_hole_of_its_own_shape(peg, orientations: int) -> None:
    found = parts(PlainScene([peg], [(RIM, [peg[0][::-1]])]))
    assert kinds(found) == ["point"] * orientations
    quarters = 360 / orientations
    assert degrees(found) == [round(k * quarters, 6) for k in range(orientations)]


def test_a_peg_in_its_hole_turned_by_a_rational_angle() -> None:
    turn = Fraction(3, 5), Fraction(4, 5)
    hole = mapped(box(0, 0, 2, 1), lambda x, y: (turn[0] * x - turn[1] * y, turn[1] * x + turn[0] * y))
    found = parts(PlainScene([box(0, 0, 2, 1)], [(RIM, [hole[0][::-1]])]))
    angle = round(math.degrees(math.atan2(4, 3)), 6)
    assert kinds(found) == ["point", "point"] and degrees(found) == [angle, round(angle + 180, 6)]


def test_a_hexagon_in_its_hole() -> None:
    hexagon = rational_regular(6, 2)
    found = parts(PlainScene([hexagon], [(RIM, [hexagon[0][::-1]])]))
    assert kinds(found) in (["point"], ["point"] * 2)  # rational coordinates: only nearly regular
    assert 0.0 in degrees(found)


def test_between_two_pins_as_far_apart_as_the_robot_is_wide() -> None:
    # the pins are 5 apart, in the direction (3, 4): the strip fits across it at one angle, touching
    pin = ([(0, 0), (1, 0), (0, 1)], [])
    strip = box(-20, 0, 20, 5)
    pins = [moved(scaled(pin, -1), 0, 0), moved(pin, 3, 4)]
    found = parts(PlainScene([strip], pins))
    angle = math.degrees(math.atan2(4, 3)) - 90
    assert kinds(found) == ["segment", "segment"]
    assert degrees(found) == sorted(round(a % 360, 6) for a in (angle, angle + 180))


def test_three_feet_that_slide_on_three_walls() -> None:
    # a1, a2, a3 stay on the lines x = 0, y = 0, x + y = 0 while the robot turns: free is one point at each angle
    half = Fraction(1, 2)
    feet = [
        ([(4, 8), (5, 8 - half), (5, 8 + half)], []),
        ([(4, 0), (4 + half, 1), (4 - half, 1)], []),
        ([(0, 4), (-1, 4 - half), (-half, 3)], []),
    ]
    walls = [box(-1, 6, 0, 10), box(-2, -1, 2, 0), ([(-6, 6), (-2, 2), (-1, 3), (-5, 7)], [])]
    found = parts(PlainScene(feet, walls))
    assert "curve" in kinds(found)
    at_zero = [p for p in found if p.kind == "curve" and p.start.theta < 0 < p.stop.theta]
    assert len(at_zero) == 1


def test_a_segment_whose_ends_are_named_alike_on_two_surfaces_is_no_point() -> None:
    robot = [(Fraction(6, 5), Fraction(8, 5)), (Fraction(18, 5), -Fraction(1, 5)), (Fraction(13, 5), Fraction(9, 5))]
    walls = [
        ([(-1, 0), (-4, -1), (0, -3)], []),
        ([(-7, 1), (-4, 2), (-4, 3)], []),
        ([(-1, -1), (4, -1), (4, 4)], [[(2, 1), (2, 0), (1, 0)]]),
        ([(1, 4), (-3, 4), (-3, -1), (1, -1)], [[(-2, 3), (0, 3), (0, 0), (-2, 0)]]),
    ]
    found = parts(PlainScene([(robot, [])], walls))
    assert kinds(found) == ["segment", "segment"]
    (alike,) = (part for part in found if part.lower == part.upper)
    assert [tuple(round(c, 9) for c in end[:2]) for end in alike.ends] == [(-6, 4), (-6, 3)]


def test_a_curve_that_ends_at_a_chart_wall_ends_in_no_point_of_the_other_chart() -> None:
    # two feet turn about a vertex, free but without room, up to a right angle
    third, sixth = Fraction(1, 3), Fraction(1, 6)
    feet = [
        ([(2 * third, 0), (1, 0), (2 * third, sixth)], []),
        ([(2 * third, third), (2 * third, sixth), (1, third)], []),
    ]
    walls = [
        ([(1, 2 * third), (2 * third, 1), (2 * third, 2 * third)], []),
        ([(2 * third, 2 * third), (third, -2 * third), (2 * third, -2 * third)], []),
    ]
    (found,) = parts(PlainScene(feet, walls))
    assert found.kind == "curve" and found.stop.kind == "chart end"


def test_isolated_parts_reach_from_room_to_room() -> None:
    # two rooms joined by a slot as wide as the robot: the segment ends on the boundary of both
    half = Fraction(1, 2)
    upper = [(-8, 3), (-2, 3), (-2, half), (2, half), (2, 3), (8, 3)]
    hollow = upper + [(x, -y) for x, y in reversed(upper)]
    result = boundary(scene_of(PlainScene([box(-1, -half, 1, half)], [(RIM, [hollow])])))
    assert kinds([result.isolated_part(k) for k in range(len(result.isolated))]) == ["segment", "segment"]
    for k in range(2):
        (x0, *_), (x1, *_) = result.isolated_part(k).ends
        assert sorted((round(x0, 9), round(x1, 9))) == [-3.0, 3.0]


def test_bounds_and_workspaces_fit_exactly_too() -> None:
    # the workspace is as high as the robot
    found = parts(PlainScene([box(0, 0, 2, 1)], [], workspace=box(0, 0, 6, 1)))
    assert kinds(found) == ["segment", "segment"]
    # an obstacle leaves the reference point only the line x = 0 of its bounds, while an edge is upright
    found = parts(PlainScene([box(-1, -1, 1, 1)], [box(1, -9, 2, 9)], bounds=(0, -5, 2, 5)))
    assert kinds(found) == ["segment"] * 4


@pytest.mark.parametrize("kind", ["axis_parallel", "integer_grid", "touching", "bounds", "workspace", "overlapping"])
def test_parts_of_random_scenes_are_isolated(kind: str) -> None:
    for seed in range(20):
        parts(random_scene(seed, kind))


EXAMPLES = {"degenerate_exact_fit": 2, "degenerate_own_hole": 5, "degenerate_workspace": 4, "flat": 6}


@pytest.mark.parametrize(("name", "count"), EXAMPLES.items())
def test_examples(name: str, count: int) -> None:
    scene = load_scene(ROOT / f"examples/scenes/{name}.json")
    assert len(parts(plain_of(scene))) == count


def test_the_same_bytes_for_any_number_of_threads() -> None:
    scene = load_scene(ROOT / "examples/scenes/flat.json")
    one, two = boundary(scene, threads=1).isolated, boundary(scene, threads=2).isolated
    assert all(np.array_equal(getattr(one, name), getattr(two, name)) for name in ISOLATED_COLUMNS)


def test_regularized_leaves_out_what_has_no_width() -> None:
    scene = load_scene(ROOT / "examples/scenes/flat.json")
    whole = boundary(scene, threads=1)
    view = whole.regularized
    assert len(whole.isolated) == 6 and len(view.isolated) == 0
    assert np.array_equal(view.trapezoids.lower, whole.trapezoids.lower)
    # the reference point is a corner of the robot, a wall stands on a bound: a slit of no width
    slit = boundary(scene_of(PlainScene([box(0, 0, 1, 1)], [box(-2, -1, 0, 3)], bounds=(-4, -4, 0, 4))), threads=1)
    assert slit_length(slit.slice("-45deg").segments, 1e-12) > 0
    assert slit_length(slit.regularized.slice("-45deg").segments, 1e-12) == 0
    assert slit.complex.components > 0 and slit.regularized.complex.components > 0


def test_regularized_boundaries_are_closed() -> None:
    for seed in range(30):
        assert np.all(boundary(scene_of(random_scene(seed, "bounds")), threads=1).regularized.complex.euler <= 2)
