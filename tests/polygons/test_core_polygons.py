"""The core's polygons against those of the reference: the same vertices, pieces and words about what is wrong."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import strategies
from cfree.errors import InvalidPolygonError
from cfree.polygons.polygon import Polygon
from reference_pieces import convex_pieces
from reference_rings import read_rings
from shapes import Shape

Rings = list[list[tuple[Any, Any]]]
SIZES = [1, Fraction(1, 10), Fraction(1, 3), 0.125, 10**40, Fraction(1, 2**70)]
PLACES = [0, 10**9, Fraction(1, 7), Fraction(10**30, 13)]


def same(rings: Rings) -> bool:
    """Compares what becomes of rings; are they a polygon?"""
    outer, *holes = rings
    try:
        expected = read_rings(outer, holes)
    except InvalidPolygonError as error:
        with pytest.raises(InvalidPolygonError) as caught:
            Polygon(outer, holes)
        assert (str(caught.value), caught.value.ring, caught.value.edges) == (str(error), error.ring, error.edges)
        return False
    found = Polygon(outer, holes)
    assert (found.numerators, found.denominator) == (expected.numerators, expected.denominator)
    assert (found.ring_offsets, found.removed) == (expected.offsets, expected.removed)
    assert found.vertices.tolist() == [[float(x), float(y)] for x, y in found.exact_vertices]
    assert found.pieces == convex_pieces(found)
    return True


# examples


def test_pieces_of_a_cocircular_polygon_are_fans_from_its_least_vertex() -> None:
    #   a plus sign: its eight outer corners lie on one circle
    cross = [(1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (2, 2), (2, 3), (1, 3), (1, 2), (0, 2), (0, 1), (1, 1)]
    assert same([cross])
    assert len(Polygon(cross).pieces) == 3


def test_a_stroke_of_a_long_comb_is_cut() -> None:
    teeth = [p for x in range(40, 0, -2) for p in ((x, 9), (x, 1), (x - 1, 1), (x - 1, 9))]
    assert same([[(0, 0), (42, 0), (42, 9), *teeth, (0, 9)]])


# random


@given(strategies.polygons())
def test_a_polygon_is_that_of_the_reference(shape: Shape) -> None:
    outer, holes = shape
    assert same([list(outer), *map(list, holes)])


@given(
    st.lists(st.lists(st.tuples(*[st.integers(0, 4)] * 2), min_size=3, max_size=8), min_size=1, max_size=3),
    st.sampled_from(SIZES),
    st.sampled_from(PLACES),
)
def test_whatever_is_wrong_with_rings_is_said_in_the_same_words(rings: Rings, size: Any, place: Any) -> None:
    same([[(x * size + place, y * size - place) for x, y in ring] for ring in rings])


@pytest.mark.slow
@pytest.mark.parametrize("grain", [None, 1, 4])
def test_stars_with_holes_are_those_of_the_reference(grain: int | None) -> None:
    rng = random.Random(f"stars {grain}")
    polygons = 0
    while polygons < 40:
        n = rng.choice([8, 15, 30, 60])
        rings: Rings = [[]]
        for k in range(n):
            r, angle = rng.choice([1, 2, 3, rng.uniform(0.5, 3.5)]) * 20, 2 * math.pi * k / n
            x, y = r * math.cos(angle), r * math.sin(angle)
            rings[0].append((x, y) if grain is None else (Fraction(round(x * grain), grain), round(y)))
        for _ in range(rng.randrange(6)):
            x, y = rng.randrange(-14, 14), rng.randrange(-14, 14)
            rings.append([(x + rng.randrange(4), y + rng.randrange(4)) for _ in range(rng.choice([3, 3, 4]))])
        polygons += same(rings)


# degenerate


@pytest.mark.parametrize("gap", [Fraction(1, 2**k) for k in (3, 60, 300)])
def test_gaps_of_any_width_are_seen(gap: Fraction) -> None:
    square = [(0, 0), (12, 0), (12, 12), (0, 12)]
    for near in (Fraction(0), gap, -gap):
        hole = [(near, 6), (3, 5), (3, 7)]
        assert same([square, hole]) == (near >= 0)
        slit = [(1, 1), (4, 4 + near), (4, 4), (1, 4)]
        same([slit])


@pytest.mark.parametrize("numbers", [["0.1", "1e-3", "-2.5E+2"], [" 1/3", "-2 / 7", "+4"], ["1_000", ".5", "5."]])
def test_numbers_are_read_as_the_reference_reads_them(numbers: list[str]) -> None:
    a, b, c = numbers
    same([[(a, b), (b, c), (c, a), ("1e3", "1e3")]])


@pytest.mark.parametrize(
    "wrong", ["x", "1/0", "nan", "1e9999", "1" * 5000, None, True, float("inf"), 10**400, [1], "\ud800"]
)
def test_what_is_no_number_is_said_in_the_same_words(wrong: Any) -> None:
    assert not same([[(0, 0), (1, 0), (0, wrong)]])
    assert not same([[(0, 0), (1, 0), (0, 1)], [(0, 0), wrong]])
