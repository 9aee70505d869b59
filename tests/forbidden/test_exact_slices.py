"""Slices at rational orientations equal those that other code computes with fractions: no tolerance.

`fuzz.py` does the same for as long as one likes.
"""

import random
from copy import copy
from dataclasses import fields, replace
from fractions import Fraction
from typing import Any, TypeVar

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

import fuzz
import oracles
import strategies
from cfree import Boundary, boundary
from compared import scene_of
from compared_exactly import Undecided, differences, rational_angles
from exact_slices import (
    ExactSlice,
    area,
    common,
    convex_pieces,
    ends,
    exact_slice,
    on_some,
    oriented,
    reverse,
    united,
    without,
)
from exact_slices import _fractions as fractions_of
from shapes import NAMED, PlainScene, Point, Shape, box, frame, random_scene, u_shape

T = TypeVar("T")
UNIT = box(0, 0, 1, 1)
ZERO = Fraction(0)
slow = settings(
    deadline=None,
    max_examples=15,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
    phases=[Phase.explicit, Phase.generate],  # `fuzz.reduced` is quicker at making scenes small
)


# --- the oracle ---


def test_two_squares_have_a_square_around() -> None:
    found = exact_slice(PlainScene([UNIT], [box(5, 5, 7, 8)]), ZERO)
    assert area(found.segments) == 3 * 4
    assert len(ends(found.segments)) == 4 and not found.points and not found.slits


def test_a_slot_as_wide_as_the_robot_is_a_slit() -> None:
    #  |  |  |     the reference point goes down from (1, 3) to (1, 1)
    #  |__#__|     both sides of the slit are boundary
    found = exact_slice(PlainScene([UNIT], [u_shape(3, 3, 1)]), ZERO)
    assert {*ends(found.slits)} == {((1, 1), (1, 3)), ((1, 3), (1, 1))}
    assert not found.points
    assert not exact_slice(PlainScene([UNIT], [u_shape(3, 3, 1)]), Fraction(1, 9)).slits


def test_a_hole_as_large_as_the_robot_is_a_point() -> None:
    for tau in (ZERO, Fraction(1), None, Fraction(-1)):
        found = exact_slice(PlainScene([box(-1, -1, 1, 1)], [frame(4, 1)]), tau)
        assert found.points == {(2, 2)} and not found.slits
    assert not exact_slice(PlainScene([box(-1, -1, 1, 1)], [frame(4, 1)]), Fraction(1, 9)).points


def test_bounds_and_workspace_are_open_outside() -> None:
    found = exact_slice(PlainScene([UNIT], [box(0, 0, 1, 1)], bounds=(0, 0, 3, 1)), ZERO)
    assert area(found.segments) == -2  # free: 1 <= x <= 3
    assert {*ends(found.slits)} == {((0, 1), (1, 1)), ((1, 1), (0, 1))}  # on the box, on the edge of the bounds
    assert area(exact_slice(PlainScene([UNIT], [], workspace=box(0, 0, 4, 3)), ZERO).segments) == -6
    assert exact_slice(PlainScene([UNIT], [], workspace=UNIT), ZERO) == ExactSlice({}, {(0, 0)})


@pytest.mark.parametrize("name", NAMED)
def test_convex_pieces_tile(name: str) -> None:
    shape = NAMED[name]()
    pieces = convex_pieces(fractions_of(shape))
    assert sum(map(oracles.ring_area, pieces)) == oracles.exact_area([shape])
    for ring in pieces:
        assert all(oracles.orient(ring[k - 2], ring[k - 1], ring[k]) >= 0 for k in range(len(ring)))


@pytest.mark.parametrize(
    "holes",
    [
        [[(1, 0), (1, -1), (0, 0)]],
        [[(0, 0), (1, 0), (0, 1)], [(0, 0), (0, -1), (-1, 0)]],
        [[(-1, -1), (0, -1), (0, 0)], [(0, 0), (1, 0), (0, 1)]],
        [[(0, 0), (2, -1), (0, 1)], [(0, 0), (-1, 0), (0, -1)]],
    ],
    ids=["twice on the rim", "each other", "a corner and each other", "the corner between"],
)
def test_convex_pieces_tile_where_holes_touch(holes: list[list[Point]]) -> None:
    shape = ([(-1, -1), (2, -1), (-1, 2)], holes)
    pieces = convex_pieces(fractions_of(shape))
    assert sum(map(oracles.ring_area, pieces)) == oracles.exact_area([shape])
    assert all(oracles.orient(ring[k - 2], ring[k - 1], ring[k]) >= 0 for ring in pieces for k in range(len(ring)))
    assert not any(oracles.interiors_meet(tuple(p), tuple(q)) for k, p in enumerate(pieces) for q in pieces[:k])


@pytest.mark.slow
@settings(deadline=None)
@given(strategies.polygons())
def test_convex_pieces_tile_any_polygon(shape: strategies.Shape) -> None:
    pieces = convex_pieces(fractions_of(shape))
    assert sum(map(oracles.ring_area, pieces)) == oracles.exact_area([shape])
    assert not any(oracles.interiors_meet(tuple(p), tuple(q)) for k, p in enumerate(pieces) for q in pieces[:k])


@pytest.mark.slow
@settings(deadline=None)
@given(strategies.scenes(), strategies.half_tangents(), st.randoms(use_true_random=False))
def test_exact_slices_agree_with_overlap_of_triangles(
    plain: PlainScene, tau: Fraction | None, rng: random.Random
) -> None:
    found = exact_slice(plain, tau)
    hair = Fraction(1, 10**30)
    sides = ends(found.segments)
    for p, q in rng.sample(sides, min(4, len(sides))):
        (ux, uy), t = (q[0] - p[0], q[1] - p[1]), Fraction(rng.randint(1, 99), 100)
        x, y = p[0] + t * ux, p[1] + t * uy
        assert not oracles.exact_overlaps(plain.robot, plain.obstacles, x, y, tau)
        assert oracles.exact_overlaps(plain.robot, plain.obstacles, x - hair * uy, y + hair * ux, tau)
        right = oracles.exact_overlaps(plain.robot, plain.obstacles, x + hair * uy, y - hair * ux, tau)
        assert right == on_some((x, y), found.slits)
    for x, y in found.points:
        assert not oracles.exact_overlaps(plain.robot, plain.obstacles, x, y, tau)
        for dx, dy in ((1, 0), (0, 1), (-1, 0), (0, -1), (1, 2), (-3, 1)):
            assert oracles.exact_overlaps(plain.robot, plain.obstacles, x + dx * hair, y + dy * hair, tau)


def test_sets_of_segments() -> None:
    first = united([oriented((0, 0), (4, 0)), oriented((4, 0), (6, 0)), oriented((0, 2), (0, 1))])
    second = united([oriented((1, 0), (2, 0)), oriented((5, 0), (9, 0)), oriented((0, 1), (0, 2))])
    assert {*ends(without(first, second))} == {((0, 0), (1, 0)), ((2, 0), (5, 0)), ((0, 2), (0, 1))}
    assert {*ends(common(first, second))} == {((1, 0), (2, 0)), ((5, 0), (6, 0))}
    assert {*ends(reverse(common(first, reverse(second))))} == {((0, 1), (0, 2))}
    assert without(first, first) == {} and common(first, first) == first


# --- the boundary ---


def compare(plain: PlainScene, seed: int) -> None:
    """Two slices between critical angles, and up to five at critical or simple ones."""
    rng = random.Random(seed)
    result = boundary(scene_of(plain), threads=1)
    for _ in range(2):
        tau = Fraction(rng.randint(-3 * fuzz.PRIME, 3 * fuzz.PRIME), fuzz.PRIME)
        assert not differences(result, tau, plain)
    angles = rational_angles(result)
    for critical in {*rng.sample(angles, min(4, len(angles))), rng.choice([None, ZERO, Fraction(1), Fraction(-1)])}:
        try:
            assert not differences(result, critical, plain)
        except Undecided:
            continue


@pytest.mark.slow
@pytest.mark.parametrize(
    "kind", ["axis_parallel", "congruent", "collinear", "touching", "overlapping", "fitting", "bounded", "walled"]
)
def test_slices_are_exact(kind: str) -> None:
    @slow
    @given(getattr(strategies, f"{kind}_scenes")(), st.integers(0, 10**6))
    def check(plain: PlainScene, seed: int) -> None:
        compare(plain, seed)

    check()


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("kind", fuzz.KINDS)
def test_slices_of_the_kinds_that_are_fuzzed_are_exact(kind: str) -> None:
    compared = 0
    for number in range(6):
        wrong, slices = fuzz.mistakes(fuzz.scene(kind, number), f"{kind} {number}")
        assert not wrong, f"{kind} {number}"
        compared += slices
    assert compared > 15


def test_angles_with_another_root_near_theirs_are_in_order() -> None:
    # a part of 2^-147: angles 2^-137 from a right one, with a second root that Newton's method may find
    e = Fraction(1, 2**147)
    robot: list[Shape] = [([(0, 2), (-2, 2), (0, 0)], []), ([(e, 0), (e, 2 * e), (0, 2 * e)], [])]
    obstacles: list[Shape] = [([(-4, 0), (-5, -5), (-4, -2)], []), ([(-2, 0), (0, 0), (-2, 2)], [])]
    wrong, compared = fuzz.mistakes(PlainScene(robot, obstacles), "tiny")
    assert not wrong and compared > 4


# --- the comparison, and what fuzz does with a difference ---


def rows(columns: T, kept: list[int]) -> T:
    return replace(columns, **{field.name: getattr(columns, field.name)[kept] for field in fields(columns)})


def with_parts(result: Boundary, **parts: Any) -> Boundary:
    other = copy(result)
    for name, columns in parts.items():
        setattr(other, name, columns)
    return other


def without_trapezoid(result: Boundary, k: int) -> Boundary:
    count = len(result.trapezoids)
    return with_parts(result, trapezoids=rows(result.trapezoids, [*range(k), *range(k + 1, count)]))


def test_every_trapezoid_is_missed() -> None:
    plain = PlainScene([box(0, 0, 1, 2)], [box(0, 0, 3, 1), box(3, 0, 4, 4)])
    result = boundary(scene_of(plain), threads=1)
    for k in range(len(result.trapezoids)):
        columns = result.trapezoids
        middle = Fraction(float(columns.tau_from[k] + columns.tau_to[k]) / 2).limit_denominator(fuzz.PRIME)
        tau = -1 / middle if columns.chart[k] else middle
        assert not differences(result, tau)
        assert differences(without_trapezoid(result, k), tau)


def test_every_isolated_part_is_missed() -> None:
    for plain, tau in (
        (PlainScene([UNIT], [frame(3, 1)]), None),
        (PlainScene([UNIT], [u_shape(3, 3, 1)]), ZERO),
        (random_scene(5, "bounds"), Fraction(2_225_278, 1_000_003)),  # a curve: in a corner of the bounds it may turn
    ):
        result = boundary(scene_of(plain), threads=1)
        assert len(result.isolated) and not differences(result, tau)
        assert differences(with_parts(result, isolated=rows(result.isolated, [])), tau)


def test_a_forgotten_obstacle_is_noticed_and_a_wrong_scene_made_small(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = fuzz.boxes(random.Random(5))
    monkeypatch.setattr(fuzz, "scene_of", lambda plain: scene_of(plain._replace(obstacles=plain.obstacles[1:])))
    assert fuzz.mistakes(plain, "x")[0]
    small = fuzz.reduced(plain, lambda other: bool(fuzz.mistakes(other, "x")[0]))
    assert len(small.obstacles) == len(small.robot) == 1
    assert len(small.robot[0][0]) == len(small.obstacles[0][0]) == 3
