from __future__ import annotations

from hypothesis import given

import strategies
from cfree.polygons.polygon import Polygon
from reference_ears import clip_ears
from reference_pieces import is_cover, outline
from shapes import Shape


def clips(polygon: Polygon) -> bool:
    v, rings = polygon.numerators, outline(polygon)
    return is_cover(v, rings, clip_ears(v, rings))


def test_a_hole_is_joined_and_cut_around() -> None:
    polygon = Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(3, 3), (6, 3), (6, 6), (3, 6)]])
    assert clips(polygon)
    assert len(clip_ears(polygon.numerators, outline(polygon))) == 8


@given(strategies.polygons())
def test_ears_cover_their_polygon(shape: Shape) -> None:
    assert clips(Polygon(*shape))


def test_holes_on_one_line_are_joined_one_to_the_next() -> None:
    holes = [[(x, 4), (x + 1, 4), (x + 1, 5), (x, 5)] for x in range(1, 30, 2)]
    assert clips(Polygon([(0, 0), (40, 0), (40, 9), (0, 9)], holes))


def test_touching_holes_are_cut_around() -> None:
    square = [(0, 0), (12, 0), (12, 12), (0, 12)]
    for holes in (
        [[(0, 0), (2, 1), (1, 2)]],
        [[(0, 6), (6, 5), (12, 6), (6, 7)]],
        [[(2, 0), (3, 3), (1, 3)], [(3, 3), (5, 3), (5, 5)]],
        [[(2, 2), (4, 4), (2, 6)], [(6, 6), (4, 4), (6, 2)], [(4, 4), (5, 9), (3, 9)]],
        [[(0, 3), (3, 0), (3, 3)], [(12, 9), (9, 12), (9, 9)], [(3, 3), (9, 9), (4, 8)]],
        [[(6, 0), (12, 6), (6, 12), (0, 6)]],
        [[(6, 0), (8, 6), (6, 12), (4, 6)], [(0, 6), (4, 6), (2, 7)], [(12, 6), (10, 7), (8, 6)]],
    ):
        assert clips(Polygon(square, holes))


def test_holes_that_touch_the_outer_ring_at_one_point_are_told_apart() -> None:
    square = [(0, 0), (6, 0), (6, 6), (0, 6)]
    for holes in (
        [[(5, 3), (4, 3), (6, 4)], [(5, 4), (2, 5), (5, 6), (6, 4)]],
        [[(4, 4), (0, 3), (3, 3)], [(3, 0), (0, 3), (6, 2)]],
        [[(5, 5), (4, 2), (1, 5)], [(4, 1), (2, 0), (1, 5), (3, 1)]],
    ):
        assert clips(Polygon(square, holes))
