"""What is missing or to spare, against closed forms; where space opens."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import product
from pathlib import Path

import pytest
import shapely

import cfree.verify
import fuzz_exact_values
from cfree import Pose, Scene, boundary, free_space, load_scene, max_margin, max_scale, nearest_miss, separation
from cfree.analysis.bottleneck import bottlenecks
from cfree.analysis.margins import Interval
from cfree.exact.surd import Surd
from cfree.polygons.offset import inset
from cfree.polygons.polygon import Polygon
from cfree.scene.dilation import FARTHEST_OUT, SIDES, _around_a_disc
from cfree.scene.scene import with_robot
from compared import scene_of
from shapes import PlainScene, box
from spaces import INSIDE, OUTSIDE, hollow, room

ROOT = Path(__file__).parents[2]


def corner(length: Fraction | str, width: Fraction | str) -> Scene:
    """A rod in a corridor of width 1 that turns by a right angle: it passes if length <= 2 sqrt 2 - 2 width."""
    a, b = Fraction(length) / 2, Fraction(width) / 2
    walls = [hollow((-1, -1, 9, 9), (0, 0, 8, 8)), box(1, 1, 9, 9)]
    return scene_of(PlainScene([box(-a, -b, a, b)], walls))


HERE, THERE = Pose(6, "1/2"), Pose("1/2", 6, "270deg")


def test_the_nearest_miss_of_a_rod_in_a_corner() -> None:
    expected = (2.6 + 2 * 0.2 - 2 * 2**0.5) / 6  # both length and width shrink by twice the inset
    miss = nearest_miss(corner("2.6", "0.2"), HERE, THERE)
    assert miss is not None and miss.lo <= expected <= miss.hi <= 1.01 * miss.lo
    (bottleneck,) = miss.bottlenecks
    assert sorted(bottleneck.obstacles) == [0, 1]
    assert math.degrees(bottleneck.pose.theta) % 180 == pytest.approx(135, abs=5)
    assert max(abs(float(c) - 0.95) for c in (bottleneck.pose.x, bottleneck.pose.y)) < 0.1
    assert str(miss).startswith(
        "an inset of 0.02"
    ) and "between obstacle 1, 8 x 8 at (5, 5) and obstacle 0, 10 x 10 at (4, 4) at" in str(miss)


def test_both_ends_of_the_nearest_miss_are_decided() -> None:
    scene = corner("2.6", "0.2")
    miss = nearest_miss(scene, HERE, THERE, tolerance=0.1)
    assert miss is not None
    for by, joined in ((miss.lo, False), (miss.hi, True)):
        space = free_space(boundary(with_robot(scene, inset(scene.robot[0], Fraction(by)), None)))
        proof = separation(space, HERE, THERE)
        assert (proof is None) == joined
        if proof is not None:
            assert cfree.verify.answer(space.boundary.scene, proof).verified


def test_two_gates_one_after_the_other() -> None:
    """The narrower one is the miss; the wider one opens earlier."""
    sides = [(Fraction(gap) / 2, y) for gap, y in (("0.95", 3), ("0.9", -3))]
    gates = [box(x, y, x + 8, y + 1) for half, y in sides for x in (half, -8 - half)]
    half = Fraction(1, 2)
    scene = scene_of(PlainScene([box(-half, -half, half, half)], gates, workspace=box(-7, -7, 7, 7)))
    miss = nearest_miss(scene, Pose(0, 6), Pose(0, -6))
    assert miss is not None and miss.lo <= 0.05 <= miss.hi
    assert [sorted(bottleneck.obstacles) for bottleneck in miss.bottlenecks] == [[2, 3]]


def test_a_miss_that_is_too_small_to_see_and_one_that_nothing_mends() -> None:
    exact = separation(room(1), INSIDE, OUTSIDE)
    assert exact is not None and exact.of == "interior"
    miss = nearest_miss(room(1).boundary.scene, INSIDE, OUTSIDE)
    assert miss is not None and miss.exact == miss.lo == miss.hi == 0 and miss.bottlenecks == ()
    assert str(miss) == "an inset of exactly 0 would just do"
    closed = scene_of(PlainScene([box(0, 0, 1, 1)], [hollow((-5, -5, 5, 5), (-4, -4, 4, 4))]))
    assert nearest_miss(closed, Pose(0, 0), Pose(9, 9)) is None
    with pytest.raises(ValueError, match="start and goal are joined"):
        nearest_miss(closed, Pose(0, 0), Pose(1, 1))
    with pytest.raises(ValueError, match="tolerance 0"):
        nearest_miss(corner("2.6", "0.2"), HERE, THERE, tolerance=0)


@pytest.mark.slow
def test_a_miss_of_less_than_doubles_tell_apart_is_exact() -> None:
    """The gap is narrower than the square by a number with 46 digits."""
    miss = nearest_miss(room(1 - Fraction(1, 10**46)).boundary.scene, INSIDE, OUTSIDE)
    assert miss is not None and miss.exact == Fraction(1, 2 * 10**46) and 0 < miss.lo < miss.hi < 1e-40


def test_scales() -> None:
    """length s <= 2 sqrt 2 - 2 width s."""
    found = max_scale(corner("2.2", "0.2"), HERE, THERE)
    assert found.lo <= 2 * 2**0.5 / 2.6 <= found.hi <= 1.01 * found.lo
    found = max_scale(corner("2.6", "0.2"), HERE, THERE)
    assert found.lo <= 2 * 2**0.5 / 3 <= found.hi <= 1.01 * found.lo
    empty = Scene([(0, 0), (1, 0), (0, 1)], bounds=(-5, -5, 5, 5))
    assert max_scale(empty, Pose(0, 0), Pose(1, 1)).hi == math.inf
    assert max_scale(empty, Pose(0, 0), Pose(9, 9)).lo == 0


def test_margins() -> None:
    shares: list[float] = []
    half = Fraction(1, 2)
    gate = [box(-9, -1, -1, 1), box(1, -1, 9, 1)]
    through = scene_of(PlainScene([box(-half, -half, half, half)], gate, workspace=box(-9, -9, 9, 9)))
    found = max_margin(through, Pose(0, 5), Pose(0, -5), tolerance=0.02, progress=shares.append)
    assert found == Interval(0.5, 0.5, exact=Surd("1/2"))
    assert shares == sorted(shares) and shares[-1] == 1 and 0 <= shares[0] < 0.5
    near = max_margin(through, Pose("-33/4", 5), Pose(0, 5))  # start is 1/4 from the workspace
    assert near.exact == Fraction(1, 4) and near.lo == near.hi == 0.25
    assert max_margin(Scene([(0, 0), (1, 0), (0, 1)]), Pose(0, 0), Pose(1, 1)).hi == math.inf
    with pytest.raises(ValueError, match="start and goal are not joined"):
        max_margin(corner("2.6", "0.2"), HERE, THERE)


def test_numbers_that_are_not_simple_come_from_parallel_edges() -> None:
    """A square of 2.2746 before a gap of 2, all turned by an angle of 4 : 3; the margin of one of 1.0746."""
    c, s = Fraction(3, 5), Fraction(4, 5)

    def scene(half: str) -> Scene:
        h = Fraction(half)
        shapes = [box(-h, -h, h, h), box(-9, -1, -1, 1), box(1, -1, 9, 1), box(-9, -9, 9, 9)]
        robot, *others = ([(c * x - s * y, s * x + c * y) for x, y in ring] for ring, _ in shapes)
        return Scene(robot, others[:2], workspace=others[2], start=(-5 * s, 5 * c, 0), goal=(5 * s, -5 * c, 0))

    large = scene("1.1373")
    miss = nearest_miss(large, tolerance=0.05)
    assert miss is not None and miss.exact == Fraction("0.1373") and miss.lo <= 0.1373 <= miss.hi
    assert max_scale(large, tolerance=0.05).exact == 1 / Fraction("1.1373")
    assert max_margin(scene("0.5373"), tolerance=0.05).exact == Fraction("0.4627")


def test_a_number_is_exact_only_where_smaller_robots_are_inside_larger_ones() -> None:
    """The first is a square about its corner; smaller ones touch as well at its start, in a corner of the workspace."""
    walls = box(0, 0, 9, 1)[0]
    found = max_scale(Scene(box(0, 0, 1, 1)[0], workspace=walls, start=(1, 0, 0), goal=(5, 0, 0)))
    assert found.exact is None
    inside = Scene(box("-1/2", "-1/2", "1/2", "1/2")[0], workspace=walls, start=(1, "1/2", 0), goal=(5, "1/2", 0))
    assert max_scale(inside).exact == 1


@pytest.mark.parametrize("seed", [7, 9])
def test_robots_a_little_smaller_and_larger_agree_with_exact_numbers(seed: int) -> None:
    assert "scale" in fuzz_exact_values.check(seed)


def test_the_polygon_is_around_the_disc_and_inside_the_other() -> None:
    ring = _around_a_disc()
    assert len(ring) == SIDES and FARTHEST_OUT < 1.02
    for (x, y), (u, v) in zip(ring, ring[1:] + ring[:1], strict=True):
        assert (x * v - y * u) ** 2 >= (u - x) ** 2 + (v - y) ** 2  # the line is at least 1 from the centre
        assert x * x + y * y <= Fraction(FARTHEST_OUT) ** 2


def test_insets_are_inside() -> None:
    comb = Polygon([(0, 0), (9, 0), (9, 5), (8, 5), (8, 1), (5, 1), (5, 5), (4, 5), (4, 1), (1, 1), (1, 5), (0, 5)])
    assert [len(inset(comb, by)) for by in map(Fraction, (1e-12, 0.1, 0.49, 0.51))] == [1, 1, 1, 0]
    dumbbell = Polygon([(0, 0), (4, 0), (4, 1), (6, 1), (6, 0), (9, 0), (9, 4), (6, 4), (6, 2), (4, 2), (4, 4), (0, 4)])
    assert len(inset(dumbbell, Fraction(3, 5))) == 2
    ring = Polygon(*hollow((0, 0, 9, 9), (3, 3, 6, 6)))
    (smaller,) = inset(ring, Fraction(1, 2))
    assert smaller.exact_area == 64 - 16
    assert inset(Polygon(box(0, 0, 1, 1)[0]), Fraction(3, 4)) == []  # not a square of the other orientation


def test_a_polygon_is_inside_another_only_without_its_holes() -> None:
    def square(half: int, *holes: tuple[int, int]) -> Polygon:
        return Polygon(box(-half, -half, half, half)[0], [box(x - h, x - h, x + h, x + h)[0] for x, h in holes])

    many = ((), ((0, 1),), ((0, 3),), ((7, 1), (0, 5)))
    shapes = [square(half, *holes) for half in (2, 4, 6, 9) for holes in many if all(x + h < half for x, h in holes)]
    for inner, outer in product(shapes, shapes):
        expected = outer.to_shapely().contains_properly(inner.to_shapely())
        assert inner._handle.is_inside(outer._handle) == expected, (inner, outer)


@pytest.mark.slow
def test_where_the_nest_opens() -> None:
    scene = load_scene(ROOT / "examples/scenes/nest_swim.json")
    start, goal = scene.start, scene.goal
    assert start and goal
    larger, smaller = (
        free_space(boundary(with_robot(scene, inset(scene.robot[0], by), scene.bounds)))
        for by in (Fraction(700, 1000), Fraction(715, 1000))
    )
    (bottleneck,) = bottlenecks(larger, smaller, start, goal)
    assert sorted(bottleneck.obstacles) == [0, 26]
    robot = shapely.Polygon(bottleneck.pose.apply(smaller.boundary.scene.robot[0].vertices))
    assert all(robot.distance(scene.obstacles[k].to_shapely()) < 1 for k in bottleneck.obstacles)  # it is 460 long
    assert bottlenecks(larger, larger, start, start) == ()
