from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

import strategies
from cfree.errors import InvalidPolygonError
from cfree.exact.orientation import Orientation, orient
from cfree.polygons.polygon import Polygon
from cfree.polygons.rings import Removed
from reference_rings import doubled_area
from shapes import Shape


def test_a_clockwise_ring_keeps_its_first_point() -> None:
    assert Polygon([(0, 0), (0, 2), (3, 2), (3, 0)], []).numerators == ((0, 0), (3, 0), (3, 2), (0, 2))


def test_the_denominator_is_the_least_of_the_vertices_kept() -> None:
    rings = Polygon([(0, 0), ("1/7", 0), (1, 0), (0, "1/2")], [])
    assert (rings.denominator, rings.numerators) == (2, ((0, 0), (2, 0), (0, 1)))
    assert rings.removed == (Removed(0, 1, "collinear"),)


@pytest.mark.slow
@given(strategies.polygons())
def test_rings_have_their_interior_on_the_left_and_no_straight_vertex(shape: Shape) -> None:
    rings = Polygon(*shape)
    for r, (first, end) in enumerate(pairwise(rings.ring_offsets)):
        ring = rings.numerators[first:end]
        assert (doubled_area(ring) > 0) == (r == 0)
        for p, q, s in zip((ring[-1], *ring), ring, (*ring[1:], ring[0]), strict=False):
            assert orient(p, q, s) is not Orientation.COLLINEAR


@given(strategies.polygons(), st.lists(st.tuples(st.integers(0, 50), st.integers(1, 4)), max_size=5))
def test_repeated_and_straight_points_put_in_are_taken_out(shape: Shape, places: list[tuple[int, int]]) -> None:
    outer, holes = shape
    more = list(outer)
    for place, parts in places:
        k = place % len(more)
        (px, py), (qx, qy) = more[k - 1], more[k]
        more.insert(k, (px + Fraction(qx - px) / parts, py + Fraction(qy - py) / parts))
    plain, rings = Polygon(outer, holes), Polygon(more, holes)
    assert len(rings.removed) - len(plain.removed) in (len(places), len(places) - 1)  # one may close the ring
    assert sorted(rings.numerators[: rings.ring_offsets[1]]) == sorted(plain.numerators[: plain.ring_offsets[1]])


@pytest.mark.parametrize("count", [0, 1, 2])
def test_a_ring_of_less_than_three_points_is_refused(count: int) -> None:
    with pytest.raises(InvalidPolygonError, match=f"hole 0: {count} points; give at least 3"):
        Polygon([(0, 0), (9, 0), (0, 9)], [[(1, 1), (2, 1)][:count]])
