"""Random and degenerate scenes of rounded shapes, and the smallest of those that once failed; see `fuzz_rounded.py`."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from fuzz_rounded import (
    Draw,
    Truth,
    all_faults,
    built,
    counts,
    euler_numbers,
    location_faults,
    signed_area,
    slice_rings,
    surface_faults,
)
from rounded_families import (
    FAMILIES,
    HALF,
    SQUARE,
    TURNS,
    RoundScene,
    Shape,
    all_mapped,
    core,
    mapped,
    mirrored,
    scene,
    swapped,
)

TRIANGLE = [(0, 0), (2, 0), (0, 1)]


def shape(points: Any, radius: Any) -> Shape:
    return Shape(core(points), Fraction(radius))


def among(robot: Shape, *obstacles: Shape, bounds: tuple[int, ...] | None = None) -> RoundScene:
    return RoundScene((robot,), obstacles, None, bounds and tuple(map(Fraction, bounds)))


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
def test_random_scenes_have_no_faults(family: str) -> None:
    for seed in range(6):
        assert all_faults(scene(family, seed), f"{family} {seed}") == [], seed


def test_a_radius_that_is_not_the_scenes_is_found() -> None:
    """The search itself works: cells of one scene against distances of another."""
    plain = among(shape(TRIANGLE, "1/4"), shape([(0, 0)], 1))
    other = among(shape(TRIANGLE, "3/4"), shape([(0, 0)], 1))
    assert list(location_faults(built(plain), Truth(other), Draw("1")))


# Euler numbers are the closed surfaces'.
CORNER_ON_CIRCLE = {
    "same centre": among(shape(TRIANGLE, 0), shape([(0, 0)], 1), shape([(0, 0)], 0)),
    "rim": among(shape(TRIANGLE, 0), shape([(0, 0)], 1), shape([(1, 0)], 0)),
    "triangle": among(shape(TRIANGLE, 0), shape([(0, 0)], 1), shape([(0, 0), ("1/2", 0), (0, "1/2")], 0)),
}


@pytest.mark.parametrize("name", CORNER_ON_CIRCLE)
def test_corner_that_stays_on_a_circle_covers_what_is_beside_it(name: str) -> None:
    """A corner without radius is on a larger circle at every angle: this enters and leaves there."""
    space = built(CORNER_ON_CIRCLE[name])
    assert euler_numbers(space.cells) == [0]
    assert not list(surface_faults(space))


@pytest.mark.parametrize(("bounds", "euler"), [((-1, -5, 5, 5), [-2]), ((-1, -5, 1, 5), [-4])])
def test_line_that_lies_in_a_bound_at_one_angle(bounds: tuple[int, ...], euler: list[int]) -> None:
    """Its end is on the bound then, where the curve of both does not end."""
    space = built(among(shape([("1/2", -1), ("1/2", 1)], "1/8"), shape([(0, 0)], "3/8"), bounds=bounds))
    assert euler_numbers(space.cells) == euler
    assert not list(surface_faults(space))


def test_angles_are_as_narrow_as_doubles_however_they_were_found() -> None:
    """Two edges and a radius give an angle that only exact numbers find; it was left in an interval of 0.14."""
    square, triangle = [(0, "1/2"), (1, "1/2"), (1, "3/2"), (0, "3/2")], [(-2, 2), (-2, 3), (-3, 2)]
    block = [(-1, -1), (0, -1), (0, 0), (-1, 0)]
    plain = among(shape(square, "3/2"), shape(triangle, 2), shape(block, 1), bounds=(-3, -3, 2, 2))
    for scene_of_it in (plain, mirrored(plain)):
        rows = built(scene_of_it).boundary.trapezoids
        for low, high in ((rows.from_lo, rows.from_hi), (rows.to_lo, rows.to_hi)):
            assert np.all(high - low < 1e-11)
    one, other = (counts(built(each)).volumes for each in (plain, mirrored(plain)))
    assert np.allclose(one, other, rtol=1e-12, atol=0)
    near = shape([(Fraction(-1, 2**74), 0)], 1)  # numbers of two doubles leave 2^-26 of an angle of the two discs
    assert not list(surface_faults(built(among(shape([(0, 0), (2, 0), (0, 2)], 1), shape([(0, 0)], 1), near))))


def discs(*places: tuple[Any, Any, Any]) -> list[Shape]:
    return [shape([(x, y)], radius) for x, y, radius in places]


FLOOR, CEILING = shape([(-3, -2), (3, -2), (3, -1), (-3, -1)], 0), shape([(-3, 1), (3, 1), (3, 2), (-3, 2)], 0)
ENDS = [shape([(x, -2), (x, 2)], "1/2") for x in (-3, 3)]
# robot among obstacles that leave just no room for it between them: cells, one of them around all
PINCHED = {
    "discs of radius 1, 2 and 3": (among(shape([(0, 0)], 0), *discs((0, 0, 1), (3, 0, 2), (0, 4, 3))), 2),
    "the same, a reference point elsewhere": (among(shape([(1, 2)], 0), *discs((0, 0, 1), (3, 0, 2), (0, 4, 3))), 2),
    "discs on a lattice": (among(shape([(0, 0)], "1/4"), *discs(*((x, y, "1/4") for x in (0, 1) for y in (0, 1)))), 2),
    "a disc in a corridor": (among(shape([(0, 0)], 0), FLOOR, CEILING, *ENDS, *discs((0, 0, 1))), 3),
    "a disc with room": (among(shape([(0, 0)], 0), FLOOR, CEILING, *ENDS, *discs((0, 0, "99/100"))), 2),
    "stadiums at a joint": (among(shape([(0, 1)], 0), shape([(0, 1), (2, 1)], 1), shape([(1, -2), (2, -1)], 1)), 1),
    "a corner of the robot": (among(shape(TRIANGLE, "1/4"), *discs((0, 0, "3/4"), ("6/5", "8/5", "3/4"))), 1),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", PINCHED)
def test_a_touch_at_every_angle_parts_cells_in_any_direction(name: str) -> None:
    """Whether it is in the direction of an axis, where patches end anyway, or not."""
    plain, cells = PINCHED[name]
    first = counts(built(plain))
    assert first.cells == cells
    for turn in TURNS:
        other = counts(built(all_mapped(plain, turn=turn)))
        assert (other.surfaces, other.cells) == (first.surfaces, cells), turn
        assert np.allclose(other.volumes, first.volumes, rtol=1e-12, atol=0)
    if (exchanged := swapped(plain)) is not None:
        assert counts(built(exchanged)).surfaces == first.surfaces


@pytest.mark.parametrize(
    ("x", "radius"), [(Fraction(1, 2**65), 1), (Fraction(1, 2**65), 1 + Fraction(1, 2**66)), (Fraction(1, 2**40), 1)]
)
def test_slices_of_circles_that_are_almost_one(x: Fraction, radius: Any) -> None:
    """The curve of two circles depends on differences that doubles of their centres and radii do not have."""
    plain = among(shape([(1, 0), (2, 0)], "1/4"), shape([(0, 0)], 1), shape([(x, 0)], radius))
    space, rho = built(plain), 1.25
    assert not list(surface_faults(space))
    area = sum(signed_area(ring) for ring in slice_rings(space, 0, 0.3))
    assert np.isclose(area, np.pi * rho**2 + 2 * rho, rtol=1e-3)


def block(x: Any, y: Any) -> Shape:
    return Shape(mapped(SQUARE, Fraction(x) + HALF, Fraction(y) + HALF), Fraction(0))


HALL = [shape([(x, -2), (x, 2)], "1/4") for x in (-1, 4)] + [shape([(-1, y), (4, y)], "1/4") for y in (-2, 2)]
BEAMS = shape([("1/2", 1), ("1/2", 2)], "1/8"), shape([(2, -2), (2, 0)], "1/8")
# a slit as wide as the disc, between blocks of which one is higher: surfaces and cells; each half turn has its own slit
SLITS = {
    "alone": (among(shape([(0, 0)], "1/4"), block(0, 0), block("3/2", "1/3")), 1, 1),
    "in a hall": (among(shape([(0, 0)], "1/4"), block(0, 0), block("3/2", "1/3"), *HALL, *BEAMS), 4, 4),
    "of a corner": (among(shape([(1, 0)], "1/4"), block(0, 0), block("3/2", "1/3")), 1, 1),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", SLITS)
def test_slits_end_where_either_of_their_lines_does(name: str) -> None:
    plain, surfaces, cells = SLITS[name]
    for turn in TURNS[:3]:
        found = counts(built(all_mapped(plain, turn=turn)))
        assert (len(found.surfaces), found.cells) == (surfaces, cells), turn


def test_surfaces_around_little_have_a_ray() -> None:
    """A slit of which some samples are at critical angles, and a pocket as small as the last digit of its height."""
    stone = shape([(2, 0), (4, 0), (4, 1), (3, 1), (3, 2), (2, 2)], 1)
    ell = shape([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], 0)
    slit = among(ell, stone, shape([(3, 3), (3, 5)], "1/2"), bounds=(-1, -1, 6, 8))
    assert counts(built(slit)).cells == counts(built(mirrored(slit))).cells == 2
    x = Fraction(-15, 2) + Fraction(1, 2**53)
    pocket = among(shape([(0, 0), (1, 0), (0, 2)], "1/2"), shape([(0, 0), (3, 0), (0, 4)], 2))
    walls = core([(x, "-1/2"), (x + 12, "-1/2"), (x + 12, 6), (x, 6)])
    assert counts(built(pocket._replace(workspace=walls))).cells == 3


@pytest.mark.parametrize("turn", [(1, 0), (0, 1), *TURNS[1:3]])
@pytest.mark.parametrize(
    ("robot", "obstacles", "euler"),
    [
        (
            shape([(0, 0), (1, 0)], "1/2"),
            [shape([(0, 0), (-1, 0)], "1/2"), shape([(-3, 3), (7, 3), (7, 4)], "1/2")],
            -4,
        ),
        (
            shape([(0, 0), (1, 0)], 0),
            [shape([(0, 0), (2, 0)], "3/4"), shape([("3/2", -4), ("5/2", -2), ("3/2", -2)], "1/4")],
            -4,
        ),
        (
            shape([(0, 0), (0, "3/2")], "1/4"),
            [shape([(2, HALF), ("7/2", HALF)], "1/4"), shape([(3, "-5/2"), (5, -2), (3, -2)], "1/4")],
            -4,
        ),
    ],
)
def test_surfaces_part_where_an_edge_touches_a_patch_at_one_angle(
    robot: Shape, obstacles: list[Shape], euler: int, turn: Any
) -> None:
    """A gap as wide as the robot is long, at two orientations: two tori are joined twice, wherever the charts end."""
    space = built(all_mapped(among(robot, *obstacles), turn=turn))
    assert euler_numbers(space.cells) == [euler]


@pytest.mark.parametrize("turn", [(1, 0), (0, 1), *TURNS[1:3]])
def test_surfaces_part_where_a_wall_touches_the_bounds_at_one_angle(turn: Any) -> None:
    """The reference point may be as far above a wall as the robot is long."""
    robot, wall = shape([(0, 0), (1, 0)], HALF), shape([(-2, -1), (2, -1), (0, -2)], HALF)
    plain = among(robot, wall, bounds=(-9, -9, 9, 1))
    space = built(plain._replace(robot=(Shape(mapped(robot.core, turn=turn), robot.radius),)))
    assert euler_numbers(space.cells) == [-2]


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("bits", [10, 30, 49, 60])
def test_circles_that_are_nearly_one_are_told_apart_by_their_branches(bits: int, sign: int) -> None:
    """Near 90 degrees two circles of nearly one radius have nearly one centre, and cross a third one on both sides."""
    radius = 1 + Fraction(sign, 2**bits)
    robot, discs = shape([(0, 0), (2, 1), (1, 1), (1, 2)], 1), (shape([(0, 0)], 1), shape([(-1, -1)], radius))
    assert not list(surface_faults(built(among(robot, *discs))))


def test_a_root_beside_a_double_one_is_an_angle_of_its_own() -> None:
    """A length that differs by 2^-88 parts a touch from a crossing, at the end of a chart."""
    robot = shape([(0, 0), (2, 1), (1, 1), (0, 2)], HALF / 2)
    wall = shape([(3 - Fraction(1, 2**88), -5 * HALF), (3 * HALF - Fraction(1, 2**88), -5 * HALF)], HALF / 2)
    assert not list(surface_faults(built(among(robot, shape([(0, 0)], HALF / 2), wall))))


@pytest.mark.parametrize(("family", "seed"), [("chain", 200701), ("lattice", 200045)])
def test_errors_of_volumes_count_circles_that_nearly_touch(family: str, seed: int) -> None:
    """Their crossing is known to half a double's digits: another frame gives a volume that differs by 1e-8."""
    assert all_faults(scene(family, seed), f"{family} {seed}", True) == []
