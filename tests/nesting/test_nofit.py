"""No-fit polygons and inner-fit regions: worked examples, and the exact slices of an independent oracle."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import pytest
import shapely

import cfree
from cfree import Curved, Polygon
from cfree.curves import Circle
from cfree.nesting import NFP, InnerFit, RoundedFit, inner_fit, nfp
from fuzz_nesting import TAUS, check_pair, random_pair

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
SLOT = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (3, 2), (3, 3), (0, 3)]
ROOM = [(0, 0), (10, 0), (10, 6), (0, 6)]


def test_a_key_in_its_slot_keeps_its_segment() -> None:
    """The exact fit that libnfporb (issues 22 and 32) and Minkowski sums of rings drop."""
    result = nfp(SLOT, SQUARE)
    assert isinstance(result, NFP)
    assert result.segments == (((1, 1), (3, 1)),) and not result.points
    assert result.rings == (((-1, -1), (3, -1), (3, 3), (-1, 3)),)
    assert not result.overlaps((2, 1)) and result.overlaps((2, Fraction(10**30 + 1, 10**30)))


def test_a_part_in_a_hole_of_its_own_shape_keeps_its_point() -> None:
    """The isolated point that CGAL's Minkowski sums drop (issue 2517)."""
    plate = Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(2, 2), (2, 5), (5, 2)]])
    result = nfp(plate, [(0, 0), (3, 0), (0, 3)])
    assert isinstance(result, NFP) and result.points == ((2, 2),)
    assert not result.overlaps((2, 2)) and result.overlaps((2, "2.000000000001"))


def test_a_part_moves_in_a_larger_hole() -> None:
    plate = Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(2, 2), (2, 6), (6, 6), (6, 2)]])
    result = nfp(plate, SQUARE)
    assert isinstance(result, NFP)
    assert result.rings[1] == ((2, 2), (2, 5), (5, 5), (5, 2))
    assert result.exact_area == 100 - 9 == result.to_shapely().area


@pytest.mark.parametrize("tau", [*TAUS, Fraction(7, 9)])
def test_a_no_fit_polygon_is_the_minkowski_sum_of_shapely(tau: Fraction | None) -> None:
    fixed, moving = Polygon(SLOT), Polygon([(0, 0), (2, 0), (2, "0.5"), ("0.5", 2)])
    result = nfp(fixed, moving, {"tau": tau})
    turned = cfree.Pose(0, 0, {"tau": tau}).apply(moving.vertices)
    sums = [
        shapely.MultiPoint([(x - u, y - v) for x, y in fixed.vertices[list(p)] for u, v in turned[list(q)]]).convex_hull
        for p in fixed.pieces
        for q in moving.pieces
    ]
    assert shapely.symmetric_difference(shapely.union_all(sums), result.to_shapely()).area < 1e-9


@pytest.mark.parametrize("seed", range(30))
def test_random_pairs_equal_exact_slices(seed: int) -> None:
    draw = random.Random(f"test {seed}")
    check_pair(*random_pair(draw), draw.choice(TAUS))


@pytest.mark.slow
@pytest.mark.long
def test_many_random_pairs_equal_exact_slices() -> None:
    for seed in range(300):
        draw = random.Random(f"slow test {seed}")
        check_pair(*random_pair(draw), draw.choice(TAUS))


def test_an_inner_fit_keeps_segments_and_points() -> None:
    wide, whole = inner_fit(ROOM, [(0, 0), (10, 0), (10, 2), (0, 2)]), inner_fit(ROOM, ROOM)
    assert isinstance(wide, InnerFit) and wide.segments == (((0, 0), (0, 4)),) and not wide.rings
    assert isinstance(whole, InnerFit) and whole.points == ((0, 0),)
    none = inner_fit(ROOM, ROOM, "45deg")
    assert isinstance(none, InnerFit) and none.is_empty and not inner_fit(ROOM, SQUARE).area - 45


def test_an_inner_fit_goes_around_faults() -> None:
    sheet = Polygon([(0, 0), (10, 0), (10, 6), (0, 6)], [[(4, 2), (4, 4), (6, 4), (6, 2)]])
    result = inner_fit(sheet, SQUARE)
    assert isinstance(result, InnerFit) and result.exact_area == 45 - 9 and len(result.rings) == 2


def test_rounded_parts_have_arcs() -> None:
    result = nfp(Polygon(SQUARE), Curved.circle((0, 0), 1))
    assert isinstance(result, RoundedFit)
    arcs = [edge for edge in result.edges if edge.center is not None]
    assert len(arcs) == 4 and {edge.radius for edge in arcs} == {1.0}
    assert result.area == pytest.approx(1 + 4 + math.pi)
    assert result.overlaps((-1 + Fraction(1, 10**20), 0)) and not result.overlaps((-1, 0))


@pytest.mark.parametrize("theta", ["0deg", "25deg", "180deg"])
def test_arcs_of_a_turned_part_are_where_it_touches(theta: str) -> None:
    stadium = Curved([(0, 0), (4, 0), (4, 1), (0, 1)], grown="1/2")
    result = nfp(stadium, Curved([(0, 0), (2, 0), (0, 1)], grown="1/4"), theta)
    assert isinstance(result, RoundedFit)
    for edge in result.edges:
        if edge.center is not None:
            assert math.dist(edge.start, edge.center) == pytest.approx(edge.radius)
            assert math.dist(edge.end, edge.center) == pytest.approx(edge.radius)
    assert result.area == pytest.approx(result.to_shapely().area, rel=1e-3)


@pytest.mark.parametrize(
    ("container", "part", "segments", "points"),
    [
        ([(0, 0), (2, 0), (2, 2), (0, 2)], Curved.circle((0, 0), 1), (), {(1, 1)}),
        ([(0, 0), (4, 0), (0, 3)], Curved.circle((0, 0), 1), (), {(1, 1)}),
        ([(0, 0), (6, 0), (6, 2), (0, 2)], Curved.circle((0, 0), 1), {((1, 1), (5, 1))}, set()),
        (
            [(0, 0), (6, 0), (6, 2), (0, 2)],
            Curved([(0, 0), (1, 0), (1, 1), (0, 1)], grown="1/2"),
            {((Fraction(1, 2), Fraction(1, 2)), (Fraction(9, 2), Fraction(1, 2)))},
            set(),
        ),
        ([(0, 0), (8, 0), (8, 6), (0, 6)], Curved.circle((0, 0), 1), (), set()),
    ],
)
def test_exact_fits_of_round_parts_are_kept(container: object, part: Curved, segments: object, points: object) -> None:
    result = inner_fit(container, part)
    assert isinstance(result, RoundedFit)
    assert {tuple(sorted(segment)) for segment in result.segments} == set(segments)  # type: ignore[call-overload]
    assert set(result.points) == points
    for place in (*result.points, *(end for segment in result.segments for end in segment)):
        assert not result.overlaps(place)


def test_a_part_between_two_discs_has_a_segment() -> None:
    discs = [Curved.circle((0, 0), 1), Curved.circle((4, 0), 1)]
    for theta, x in (("0deg", 1), ("90deg", 3)):
        result = nfp(discs, [(0, 0), (2, 0), (2, 2), (0, 2)], theta)
        assert isinstance(result, RoundedFit)
        assert {tuple(sorted(segment)) for segment in result.segments} == {((x, -2), (x, 0))}


def test_a_peg_in_a_square_hole_is_a_point() -> None:
    plate = Polygon([(-9, -9), (9, -9), (9, 9), (-9, 9)], [[(0, 0), (0, 2), (2, 2), (2, 0)]])
    result = nfp(plate, Curved.circle((0, 0), 1), "17deg")
    assert isinstance(result, RoundedFit) and result.points == ((1, 1),) and not result.segments


def test_parts_fit_in_round_containers() -> None:
    """Discs about the corners of a unit square contain those of the part; a peg of the same radius fits exactly."""
    fit = inner_fit(Curved.circle((0, 0), 5), SQUARE)
    discs = [shapely.Point(-x, -y).buffer(5, 2000) for x, y in SQUARE]
    assert isinstance(fit, RoundedFit) and math.isclose(fit.area, shapely.intersection_all(discs).area, rel_tol=1e-5)
    assert not fit.overlaps((0, 0)) and fit.overlaps((4, 3))
    peg = inner_fit(Curved.circle((0, 0), 1), Curved.circle((2, "1/3"), 1))
    assert isinstance(peg, RoundedFit) and peg.points == ((-2, Fraction(-1, 3)),) and peg.area == 0


def test_areas_count_concave_arcs_clockwise() -> None:
    plate = Curved([(-5, -5), (5, -5), (5, 5), (-5, 5)], [Circle((0, 0), 3)])
    fit = nfp(plate, Curved.circle((0, 0), 1))
    assert isinstance(fit, RoundedFit) and math.isclose(fit.area, 100 + 40 + math.pi - 4 * math.pi, rel_tol=1e-9)


def test_the_nearest_free_position_may_be_in_a_hole() -> None:
    plate = Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(2, 2), (2, 6), (6, 6), (6, 2)]])
    result = nfp(plate, SQUARE)
    assert isinstance(result, NFP)
    assert result.nearest((Fraction(3, 2), Fraction(3))) == (2, 3)


def test_two_containers_are_refused() -> None:
    with pytest.raises(ValueError, match=r"^container: 2 polygons; give one"):
        inner_fit([Polygon(SQUARE), Polygon(ROOM)], SQUARE)


def test_a_picture_shows_exact_fits() -> None:
    for fit in (nfp(SLOT, SQUARE), inner_fit(ROOM, ROOM), nfp(SQUARE, Curved.circle((0, 0), 1))):
        assert fit.plot().axes
