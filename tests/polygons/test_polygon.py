from __future__ import annotations

import math
import pickle
import time
from decimal import Decimal
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

import strategies
from cfree.errors import InvalidPolygonError
from cfree.polygons.polygon import Polygon
from cfree.polygons.rings import Removed
from shapes import Shape

L_SHAPE = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
SQUARE = [(0, 0), (6, 0), (6, 6), (0, 6)]


def star(n: int, seed: int = 1) -> list[tuple[float, float]]:
    """Star-shaped ring with random radii in [0.2, 1]."""
    radii = np.random.default_rng(seed).uniform(0.2, 1, n)
    return [(r * math.cos(2 * math.pi * k / n), r * math.sin(2 * math.pi * k / n)) for k, r in enumerate(radii)]


# examples


def test_polar_coordinates_are_those_of_section_1_1() -> None:
    polygon = Polygon([(3, 4), (-5, 12), (0, -2)])
    assert polygon.polar[:, 0].tolist() == [5, 13, 2]
    np.testing.assert_allclose(polygon.polar[:, 1], [math.atan2(4, 3), math.atan2(12, -5), 1.5 * math.pi], rtol=1e-15)
    tangents = [(5, {"tau": "1/2"}), (13, {"tau": "3/2"}), ("2", "270deg")]
    assert Polygon.from_polar(tangents) == polygon
    ring = Polygon.from_polar([(9, f"{90 * k}deg") for k in range(4)], [[(1, "0deg"), (1, "90deg"), (1, "180deg")]])
    assert ring.exact_area == 162 - 1


@given(strategies.polygons())
def test_polar_coordinates_lead_back_up_to_rounding(shape: Shape) -> None:
    polygon = Polygon(*shape)
    rings = [polygon.polar[i:j] for i, j in pairwise(polygon.ring_offsets)]
    back = [r[:, :1] * np.column_stack((np.cos(r[:, 1]), np.sin(r[:, 1]))) for r in rings]
    np.testing.assert_allclose(np.concatenate(back), polygon.vertices, atol=1e-14)
    assert ((polygon.polar[:, 1] >= 0) & (polygon.polar[:, 1] < math.tau)).all()
    if len(rings) == 1 and polygon.is_convex:
        again = Polygon.from_polar(polygon.polar)
        if len(again) == len(polygon):  # rounding may make neighbours collinear
            np.testing.assert_allclose(again.vertices, polygon.vertices, atol=1e-14)


def test_an_l_shape_has_one_reflex_vertex() -> None:
    #   5---4
    #   |   |
    #   |   3---2
    #   |       |
    #   0-------1
    polygon = Polygon(L_SHAPE)
    assert polygon.convex.tolist() == [True, True, True, False, True, True]
    assert not polygon.is_convex
    np.testing.assert_allclose(polygon.interior_angles / (math.pi / 2), [1, 1, 1, 3, 1, 1])
    assert (polygon.exact_area, polygon.area, polygon.perimeter) == (3, 3.0, 8.0)
    assert polygon.bounds == (0, 0, 2, 2)
    assert polygon.next.tolist() == [1, 2, 3, 4, 5, 0]
    assert polygon.previous.tolist() == [5, 0, 1, 2, 3, 4]
    np.testing.assert_array_equal(polygon.edges, [[2, 0], [0, 1], [-1, 0], [0, 1], [-1, 0], [0, -2]])
    np.testing.assert_array_equal(polygon.edge(4), [-1, 0])
    assert repr(polygon) == "<Polygon of 6 vertices, 0 holes>"


def test_rings_are_turned_so_that_the_interior_is_on_the_left() -> None:
    hole = [(1, 1), (2, 1), (1, 2)]
    polygon = Polygon(SQUARE[::-1], [hole])
    assert polygon.numerators == ((0, 6), (0, 0), (6, 0), (6, 6), (1, 1), (1, 2), (2, 1))
    assert polygon.ring_offsets == (0, 4, 7)
    assert polygon.next.tolist() == [1, 2, 3, 0, 5, 6, 4]
    assert polygon.exact_area == Fraction(71, 2)
    assert not polygon.convex[4:].any()
    np.testing.assert_allclose(polygon.interior_angles[4:], [3 * math.pi / 2, 7 * math.pi / 4, 7 * math.pi / 4])
    assert polygon == Polygon(SQUARE[::-1], [hole[:1] + hole[:0:-1]])


def test_numbers_are_taken_as_they_are_written() -> None:
    decimal = Polygon([("0.1", 0), (1, Decimal("0.1")), ("1/3", Fraction(7, 3))])
    assert decimal.exact_vertices == (
        (Fraction(1, 10), 0),
        (1, Fraction(1, 10)),
        (Fraction(1, 3), Fraction(7, 3)),
    )
    assert (decimal.denominator, decimal.numerators) == (30, ((3, 0), (30, 3), (10, 70)))
    assert Polygon([(0.1, 0), (1, 0), (0, 1)]) != Polygon([("0.1", 0), (1, 0), (0, 1)])
    np.testing.assert_array_equal(decimal.vertices, [[0.1, 0], [1, 0.1], [1 / 3, 7 / 3]])


def test_superfluous_points_are_removed_and_reported() -> None:
    ring = [(0, 0), (0, 0), (2, 0), (4, 0), (4, 4), (4, 4), (4, 4), (0, 4), (0, 2), (0, 0)]
    polygon = Polygon(ring, [[(1, 1), (1, 2), (1, 3), (3, 3)]])
    assert polygon.numerators == ((0, 0), (4, 0), (4, 4), (0, 4), (1, 1), (1, 3), (3, 3))
    assert polygon.removed == (
        Removed(0, 1, "repeated"),
        Removed(0, 2, "collinear"),
        Removed(0, 5, "repeated"),
        Removed(0, 6, "repeated"),
        Removed(0, 8, "collinear"),
        Removed(1, 1, "collinear"),
    )


def test_the_input_may_be_an_array_of_any_number_type() -> None:
    expected = Polygon(L_SHAPE)
    for dtype in (np.int32, np.float32, np.float64, object):
        assert Polygon(np.array(L_SHAPE, dtype=dtype)) == expected
    assert Polygon(map(list, L_SHAPE)) == expected  # type: ignore[arg-type]
    assert len({Polygon(L_SHAPE), expected}) == 1
    assert pickle.loads(pickle.dumps(expected)) == expected


def test_shapely_polygons_come_and_go() -> None:
    polygon = Polygon(SQUARE, [[(1, 1), (2, 1), (1, 2)]])
    assert polygon.to_shapely().area == polygon.area
    assert Polygon.from_shapely(polygon.to_shapely()) == polygon
    assert Polygon.from_shapely(shapely.from_wkt("POLYGON Z ((0 0 5, 1 0 5, 0 1 5, 0 0 5))")).area == 0.5
    for wkt in ("POLYGON EMPTY", "LINESTRING (0 0, 1 1)", "MULTIPOLYGON (((0 0, 1 0, 0 1, 0 0)))"):
        with pytest.raises(InvalidPolygonError, match="is no polygon; give"):
            Polygon.from_shapely(shapely.from_wkt(wkt))


@pytest.mark.parametrize(
    ("outer", "holes", "message"),
    [
        ([(0, 0), (2, 2), (2, 0), (0, 3)], [], "outer ring: edges 0 and 2 cross at (6/5, 6/5); split"),
        ([(0, 0), (1, 0), (2, 2), (2, 0), (0, 3)], [], "outer ring: edges 1 and 3 cross at (10/7, 6/7)"),
        ([(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)], [], "outer ring: edges 0 and 3 touch at (2, 0)"),
        ([(0, 0), (4, 0), (4, 2), (3, 0), (1, 0), (0, 3)], [], "outer ring: edges 0 and 4 touch at (1, 0)"),
        ([(0, 0), (4, 0), (2, 2), (4, 4), (0, 4), (2, 2)], [], "outer ring: edges 2 and 5 touch at (2, 2)"),
        ([(0, 0), (4, 0), (2, 0), (0, 3)], [], "outer ring: the angle at point 1 is zero; remove this spike"),
        ([(0, 0), (4, 0), (4, 4), (4, 9), (4, 4), (0, 4)], [], "the angle at point 3 is zero"),
        ([(0, 0), (1, 1)], [], "outer ring: 2 points; give at least 3"),
        ([(0, 0), (1, 1), (0, 0)], [], "outer ring: 2 points; give at least 3"),
        ([(0, 0), (1, 1), (1, 1), (0, 0), (0, 0)], [], "outer ring: fewer than 3 different points"),
        ([(0, 0), (1, 1), (3, 3), (2, 2)], [], "outer ring: its points lie on one line, its area is zero"),
        ([], [], "outer ring: 0 points"),
        ([(0, 0), (math.nan, 1), (1, 1)], [], "outer ring: point 1: nan is not finite; give a finite number"),
        ([(0, 0), (1, "x"), (1, 1)], [], "outer ring: point 1: 'x' is no number"),
        ([(0, 0), (1, 2, 3), (1, 1)], [], "outer ring: point 1 = (1, 2, 3) is no point; give a pair (x, y)"),
        ([(0, 0), "12", (1, 1)], [], "outer ring: point 1 = '12' is no point"),
        ([0, 1, 2], [], "outer ring: point 0 = 0 is no point"),
        ("POLYGON", [], "outer ring: 'POLYGON' is no ring; give a sequence of points"),
        (None, [], "outer ring: None is no ring"),
        (
            [(0, 0), ("1e309", 0), (0, 1)],
            [],
            "outer ring: point 1 lies beyond 4e307; scale the coordinates",
        ),
        ([(0, 0), (10**308, 0), (0, 1)], [], "outer ring: point 1 lies beyond 4e307"),
        ([(0, 0), (10**5000, 0), (0, 1)], [], "outer ring: point 1 lies beyond 4e307"),
        (
            SQUARE,
            [[(8, 8), (9, 8), (8, 9)]],
            "hole 0: it lies outside the outer ring; move it, or leave it out",
        ),
        (
            SQUARE,
            [[(-1, -1), (9, -1), (9, 9), (-1, 9)]],
            "hole 0: it lies around the outer ring; swap the two",
        ),
        (
            SQUARE,
            [[(1, 1), (5, 1), (5, 5), (1, 5)], [(2, 2), (3, 2), (2, 3)]],
            "hole 1: it lies inside hole 0; give it as another polygon",
        ),
        (SQUARE, [[(1, 1), (1, 7), (2, 1)]], "hole 0: edge 0 crosses edge 2 of outer ring at (1, 6)"),
        (SQUARE, [[(1, 0), (2, 0), (1, 1)]], "hole 0: edge 0 overlaps edge 0 of outer ring at (1, 0)"),
        (SQUARE, [SQUARE], "hole 0: edge 0 overlaps edge 0 of outer ring at (0, 0)"),
        (
            SQUARE,
            [[(1, 1), (4, 1), (1, 4)], [(1, 5), (2, 2), (5, 5)]],
            "hole 1: edge 0 crosses edge 1 of hole 0 at (3/2, 7/2); keep the rings apart",
        ),
    ],
)
def test_faults_are_named_with_their_place(outer: Any, holes: Any, message: str) -> None:
    with pytest.raises(InvalidPolygonError) as raised:
        Polygon(outer, holes)
    assert message in str(raised.value)
    ring, edges = raised.value.ring, raised.value.edges
    assert ring == (0 if message.startswith("outer") or "hole" not in message else 1 + int(message[5]))
    assert len(edges) in (0, 1, 2)


def test_a_fault_carries_its_edges() -> None:
    with pytest.raises(InvalidPolygonError) as raised:
        Polygon([(0, 0), (1, 0), (2, 2), (2, 0), (0, 3)])
    assert (raised.value.ring, raised.value.edges) == (0, (1, 3))


# properties


@given(strategies.polygons())
def test_measures_agree_with_shapely(shape: Shape) -> None:
    polygon = Polygon(*shape)
    reference = polygon.to_shapely()
    assert reference.is_valid
    assert math.isclose(polygon.area, reference.area, rel_tol=1e-12)
    assert math.isclose(polygon.perimeter, reference.length, rel_tol=1e-12)
    assert polygon.bounds == reference.bounds


@given(strategies.polygons())
def test_exterior_angles_of_each_ring_add_up_to_one_turn(shape: Shape) -> None:
    polygon = Polygon(*shape)
    for r, (first, end) in enumerate(pairwise(polygon.ring_offsets)):
        turning = np.sum(math.pi - polygon.interior_angles[first:end])
        assert math.isclose(turning, -2 * math.pi if r else 2 * math.pi, rel_tol=1e-12)
    assert ((polygon.interior_angles < math.pi) == polygon.convex).all()
    assert (polygon.interior_angles > 0).all()


@given(strategies.polygons(), st.randoms(use_true_random=False))
def test_direction_of_the_rings_given_does_not_matter(shape: Shape, random: Any) -> None:
    outer, holes = shape

    def turned(ring: list[Any]) -> list[Any]:
        return ring[:1] + ring[:0:-1] if random.random() < 0.5 else [*ring, ring[0]]

    polygon = Polygon(outer, holes)
    other = Polygon(turned(outer), [turned(hole) for hole in holes])
    assert other == polygon or polygon.removed  # which may be a ring's first point
    assert other.exact_area == polygon.exact_area
    assert polygon.exact_area > 0


@given(strategies.polygons(), st.fractions(-5, 5).filter(bool), strategies.fractions(), strategies.fractions())
def test_moving_and_scaling_change_measures_accordingly(shape: Shape, f: Fraction, dx: Fraction, dy: Fraction) -> None:
    polygon = Polygon(*shape)
    outer, *holes = (
        [(f * x + dx, f * y + dy) for x, y in polygon.exact_vertices[first:end]]
        for first, end in pairwise(polygon.ring_offsets)
    )
    moved = Polygon(outer, holes)
    assert moved.exact_area == f**2 * polygon.exact_area
    assert moved.convex.tolist() == polygon.convex.tolist()
    np.testing.assert_allclose(moved.interior_angles, polygon.interior_angles, rtol=1e-15)


@given(strategies.polygons())
def test_vertices_in_doubles_are_the_nearest(shape: Shape) -> None:
    polygon = Polygon(*shape)
    assert polygon.vertices.tolist() == [[float(x), float(y)] for x, y in polygon.exact_vertices]


lattice_rings = st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5)), min_size=3, max_size=8)


@given(lattice_rings)
def test_a_ring_is_accepted_exactly_if_shapely_finds_it_valid(ring: list[tuple[int, int]]) -> None:
    try:
        Polygon(ring)
        accepted = True
    except InvalidPolygonError as error:
        accepted = False
        assert str(error).startswith("outer ring: ")
    assert accepted == shapely.Polygon(ring).is_valid


@given(lattice_rings, lattice_rings)
def test_a_hole_is_accepted_exactly_if_shapely_finds_it_valid(
    one: list[tuple[int, int]], other: list[tuple[int, int]]
) -> None:
    outer = [(-1, -1), (6, -1), (6, 6), (-1, 6)]
    reference = shapely.Polygon(outer, [one, other])
    try:
        polygon = Polygon(outer, [one, other])
    except InvalidPolygonError:
        assert not reference.is_valid
    else:
        # rings that touch twice may cut the interior in two, which shapely refuses and cfree does not
        reason = shapely.is_valid_reason(reference)
        assert reference.is_valid or reason.startswith("Interior is disconnected")
        assert polygon.area == reference.area


# degenerate


@pytest.mark.parametrize("scale", [1e100, 1e-100, 1e150, 1e-150])
def test_huge_and_tiny_coordinates_change_nothing(scale: float) -> None:
    polygon = Polygon([(x * scale, y * scale) for x, y in L_SHAPE])
    assert polygon.convex.tolist() == Polygon(L_SHAPE).convex.tolist()
    np.testing.assert_allclose(polygon.interior_angles, Polygon(L_SHAPE).interior_angles)
    assert math.isclose(polygon.area / scale, 3 * scale, rel_tol=1e-12)


def test_a_hairline_polygon_is_a_polygon() -> None:
    ulp = math.ulp(1e6)
    polygon = Polygon([(1e6, 1e6), (1e6 + 1, 1e6), (1e6 + 1, 1e6 + ulp), (1e6, 1e6 + ulp)])
    assert polygon.is_convex
    assert polygon.area == ulp
    needle = Polygon([(0, 0), (1, 0), (1, Fraction(1, 10**30))])
    assert math.isclose(needle.interior_angles[0], 1e-30, rel_tol=1e-12)


def test_a_vertex_one_ulp_off_a_line_is_kept() -> None:
    assert len(Polygon([(0, 0), (0.5, -5e-324), (1, 0), (0, 1)])) == 4
    assert len(Polygon([(0, 0), (0.5, 0.0), (1, 0), (0, 1)])) == 3


@pytest.mark.parametrize("n", [3, 4, 7, 64, 1000])
def test_regular_polygons_in_doubles_are_convex(n: int) -> None:
    polygon = Polygon([(math.cos(2 * math.pi * k / n), math.sin(2 * math.pi * k / n)) for k in range(n)])
    assert len(polygon) == n
    assert polygon.is_convex


def test_a_winding_number_of_two_is_no_convex_ring() -> None:
    pentagram = [(math.cos(4 * math.pi * k / 5), math.sin(4 * math.pi * k / 5)) for k in range(5)]
    with pytest.raises(InvalidPolygonError, match=r"edges \d and \d cross at about"):
        Polygon(pentagram)


def test_rings_may_touch_in_single_points() -> None:
    corner, side = [(0, 0), (2, 1), (1, 2)], [(6, 3), (5, 4), (4, 3)]
    polygon = Polygon(SQUARE, [corner, side, [(2, 1), (3, 1), (3, 2)]])
    assert polygon.exact_area == 36 - Fraction(3, 2) - 1 - Fraction(1, 2)


def test_arrays_cannot_be_changed() -> None:
    polygon = Polygon(L_SHAPE)
    for array in (polygon.vertices, polygon.edges, polygon.next, polygon.convex, polygon.interior_angles):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    with pytest.raises(AttributeError):
        polygon.denominator = 2  # type: ignore[misc]


def test_an_area_beyond_all_doubles_is_infinite() -> None:
    polygon = Polygon([(0, 0), (1e200, 0), (0, 1e200)])
    assert polygon.area == math.inf
    assert polygon.exact_area == Fraction(1e200) ** 2 / 2


def test_coordinates_without_a_manageable_common_denominator_are_refused() -> None:
    with pytest.raises(InvalidPolygonError, match="common denominator of the coordinates is too long"):
        Polygon([(Fraction(k, 10**9 + k), k * k) for k in range(1000)])


def test_denominators_that_are_powers_of_two_have_the_same_bound() -> None:
    corner = (0, Fraction(1, 2**15999))
    assert Polygon([(0, 0), (1, 0), corner]).denominator == 2**15999
    with pytest.raises(InvalidPolygonError, match="common denominator of the coordinates is too long"):
        Polygon([(0, 0), (1, 0), (0, Fraction(1, 2**16000))])


def test_many_vertices_take_seconds() -> None:
    started = time.perf_counter()
    polygon = Polygon(star(20_000))
    assert len(polygon) == 20_000
    assert time.perf_counter() - started < 10
