"""Repair: the exact union of rings by a fill rule."""

import random
from fractions import Fraction

import numpy as np
import pytest
import shapely

import cfree
from cfree.errors import InvalidPolygonError
from cfree.polygons import noding

BOW_TIE = [(0, 0), (2, 2), (2, 0), (0, 2)]
SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]
LARGE = [(-1, -1), (5, -1), (5, 5), (-1, 5)]


def total(polygons: tuple[cfree.Polygon, ...]) -> Fraction:
    return sum((polygon.exact_area for polygon in polygons), Fraction(0))


def test_a_bow_tie_becomes_two_triangles() -> None:
    assert [polygon.exact_area for polygon in cfree.repaired(BOW_TIE)] == [1, 1]
    with pytest.raises(InvalidPolygonError):
        cfree.Polygon(BOW_TIE)


@pytest.mark.parametrize(
    "shape",
    [
        pytest.param([*SQUARE, (0, 2), (0, 0)], id="repeated points"),
        pytest.param([(0, 0), (2, 0), (9, 0), (2, 0), (2, 2), (0, 2)], id="spike"),
        pytest.param([(0, 0), (2, 0), (2, 2), (1, 2), (1, 1), (1, 2), (0, 2)], id="cut"),
        pytest.param([SQUARE, SQUARE[::-1]], id="twice"),
        pytest.param([SQUARE, [(0, 0), (1, 0), (1, 1)]], id="one in another"),
        pytest.param(np.array(SQUARE), id="array"),
        pytest.param(shapely.Polygon(SQUARE), id="shapely"),
        pytest.param(shapely.MultiPolygon([shapely.Polygon(SQUARE), shapely.box(1, 1, 2, 2)]), id="overlapping parts"),
        pytest.param([cfree.Polygon(SQUARE)], id="valid"),
    ],
)
def test_these_are_a_square(shape: object) -> None:
    (polygon,) = cfree.repaired(shape)
    assert set(polygon.exact_vertices) == set(SQUARE)
    assert len(polygon) == 4


def test_holes_stay_and_holes_that_reach_out_are_cut_off() -> None:
    plate = shapely.Polygon(LARGE, [SQUARE])
    assert total(cfree.repaired(plate)) == 32
    crossing = shapely.Polygon(LARGE, [[(3, 0), (9, 0), (9, 2), (3, 2)]])
    (polygon,) = cfree.repaired(crossing)
    assert polygon.exact_area == 36 - 4
    assert len(polygon.ring_offsets) == 2


def test_the_rules_differ_where_a_ring_winds_twice() -> None:
    twice = [(0, 0), (6, 0), (6, 6), (2, 6), (2, 2), (8, 2), (8, 8), (0, 8)]
    assert total(cfree.repaired(twice)) - total(cfree.repaired(twice, rule="evenodd")) == 16
    holes = shapely.Polygon([(-9, -9), (20, -9), (20, 20), (-9, 20)], [twice])
    assert total(cfree.repaired(holes)) - total(cfree.repaired(holes, rule="evenodd")) == 16


@pytest.mark.parametrize("seed", range(5))
def test_unions_are_those_of_shapely(seed: int) -> None:
    rng = random.Random(seed)
    boxes = [
        shapely.box(x, y, x + rng.randrange(1, 6), y + rng.randrange(1, 6))
        for x, y in ((rng.randrange(12), rng.randrange(12)) for _ in range(12))
    ]
    assert float(total(cfree.repaired(boxes))) == pytest.approx(shapely.unary_union(boxes).area)


def test_nothing_without_an_interior_is_left() -> None:
    for shape in ([(0, 0), (1, 1), (2, 2)], []):
        with pytest.raises(InvalidPolygonError, match="nothing is left"):
            cfree.repaired(shape)


@pytest.mark.parametrize("shape", ["POLYGON", 3, shapely.Point(0, 0), [(0, 0), (1, "x"), (2, 2)], [(0, 0), (1, 1)]])
def test_no_shapes_are_refused(shape: object) -> None:
    with pytest.raises(InvalidPolygonError):
        cfree.repaired(shape)


def test_rings_that_cross_too_often_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(noding, "MOST_MEETINGS", 100)
    zigzag = [(x, y) for k in range(40) for x, y in ((k, 0), (40 - k, 50))]
    with pytest.raises(InvalidPolygonError, match="cross too often"):
        cfree.repaired(zigzag)
