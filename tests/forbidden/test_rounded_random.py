"""Random and degenerate scenes of rounded shapes, and the smallest of those that once failed; see `fuzz_rounded.py`."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from fuzz_rounded import Draw, Truth, all_faults, built, counts, euler_numbers, location_faults, surface_faults
from rounded_scenes import FAMILIES, RoundScene, Shape, core, mirrored, scene

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
            assert np.all(high - low < 1e-13)
    one, other = (counts(built(each)).volumes for each in (plain, mirrored(plain)))
    assert np.allclose(one, other, rtol=1e-12, atol=0)
