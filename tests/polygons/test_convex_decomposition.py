from __future__ import annotations

import math
import random
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

import strategies
from cfree.exact.number import IntPoint
from cfree.exact.orientation import Location, Orientation, locate, orient
from cfree.polygons.polygon import Polygon
from reference_pieces import delaunay, is_cover, outline
from reference_rings import doubled_area
from shapes import Shape

L_SHAPE = Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
SQUARE = [(0, 0), (12, 0), (12, 12), (0, 12)]


def check(polygon: Polygon) -> int:
    """Pieces are strictly convex, apart, inside, and as large as the polygon; returns their number."""
    v, pieces = polygon.numerators, polygon.pieces
    total = 0
    for piece in pieces:
        assert piece[0] == min(piece)
        for a, b, c in zip((piece[-1], *piece), piece, (*piece[1:], piece[0]), strict=False):
            assert orient(v[a], v[b], v[c]) is Orientation.LEFT
        total += doubled_area([v[k] for k in piece])
    assert Fraction(total, 2 * polygon.denominator**2) == polygon.exact_area
    assert pieces == tuple(sorted(pieces))
    reflex = int((~polygon.convex).sum())
    assert 1 + reflex // 2 // max(1, len(polygon.ring_offsets)) <= len(pieces) <= 1 + 2 * reflex
    return len(pieces)


def edges(ring: list[IntPoint]) -> list[tuple[IntPoint, IntPoint]]:
    return list(zip(ring, [*ring[1:], ring[0]], strict=True))


def star(n: int, seed: int = 1) -> Polygon:
    rng = random.Random(seed)
    ring = []
    for k in range(n):
        r = rng.uniform(0.2, 1)
        ring.append((r * math.cos(2 * math.pi * k / n), r * math.sin(2 * math.pi * k / n)))
    return Polygon(ring)


def grid_of_holes(count: int) -> Polygon:
    size = 3 * count
    holes = [
        [(3 * i + 1, 3 * j + 1), (3 * i + 2, 3 * j + 1), (3 * i + 1, 3 * j + 2)]
        for i in range(count)
        for j in range(count)
    ]
    return Polygon([(0, 0), (size, 0), (size, size), (0, size)], holes)


# examples


def test_an_l_shape_falls_into_two_pieces() -> None:
    assert L_SHAPE.pieces == ((0, 1, 2, 3), (0, 3, 4, 5))


def test_a_convex_polygon_is_one_piece() -> None:
    assert Polygon(SQUARE).pieces == ((0, 1, 2, 3),)


def test_straight_vertices_of_pieces_are_left_out() -> None:
    # a cross: 4 reflex vertices, on two horizontal lines
    cross = Polygon([(1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (2, 2), (2, 3), (1, 3), (1, 2), (0, 2), (0, 1), (1, 1)])
    assert check(cross) == 3


def test_a_square_ring_falls_into_four_pieces() -> None:
    assert check(Polygon(SQUARE, [[(4, 4), (8, 4), (8, 8), (4, 8)]])) == 4


def test_a_missing_or_doubled_triangle_is_no_cover() -> None:
    v, rings = L_SHAPE.numerators, outline(L_SHAPE)
    triangles = delaunay(v, rings)
    assert is_cover(v, rings, triangles)
    assert not is_cover(v, rings, triangles[1:])
    assert not is_cover(v, rings, [*triangles, triangles[0]])
    assert not is_cover(v, rings, [(b, a, c) for a, b, c in triangles])
    assert not is_cover(v, rings, [(0, 1, 2), (0, 2, 4), (0, 4, 5)])


# properties


@given(strategies.polygons())
def test_pieces_are_convex_and_cover_the_polygon(shape: Shape) -> None:
    check(Polygon(*shape))


@pytest.mark.slow
@given(strategies.polygons(), st.tuples(strategies.fractions(), strategies.fractions()))
def test_a_point_is_in_the_polygon_exactly_if_it_is_in_a_piece(shape: Shape, point: tuple[Fraction, Fraction]) -> None:
    polygon = Polygon(*shape)
    d, v = polygon.denominator, polygon.numerators
    scaled = (point[0] * d, point[1] * d)
    own = [(v[k], v[m]) for k, m in enumerate(polygon.next.tolist())]
    places = {locate(scaled, edges([v[k] for k in piece])) for piece in polygon.pieces}
    if locate(scaled, own) is Location.OUTSIDE:
        assert places == {Location.OUTSIDE}
    else:
        assert places != {Location.OUTSIDE}


# degenerate


@pytest.mark.parametrize(
    "holes",
    [
        [[(0, 0), (2, 1), (1, 2)]],
        [[(0, 6), (3, 5), (3, 7)]],
        [[(2, 0), (3, 3), (1, 3)], [(3, 3), (5, 3), (5, 5)]],
        [[(0, 6), (6, 5), (12, 6), (6, 7)]],
        [[(2, 2), (4, 4), (2, 6)], [(6, 6), (4, 4), (6, 2)], [(4, 4), (5, 9), (3, 9)]],
        [[(0, 3), (3, 0), (3, 3)], [(12, 9), (9, 12), (9, 9)], [(3, 3), (9, 9), (4, 8)]],
    ],
)
def test_rings_that_touch_are_decomposed(holes: list[list[tuple[int, int]]]) -> None:
    check(Polygon(SQUARE, holes))


@pytest.mark.parametrize("scale", [2.0**330, 2.0**-330])
def test_scale_changes_no_piece(scale: float) -> None:
    ring = [(3.0, 1.0), (9.0, 2.0), (5.0, 4.0), (8.0, 9.0), (4.0, 5.0), (1.0, 8.0), (2.0, 4.0)]
    assert Polygon([(x * scale, y * scale) for x, y in ring]).pieces == Polygon(ring).pieces


def test_a_hairline_corridor_is_decomposed() -> None:
    hair = Fraction(1, 10**40)
    check(Polygon([(0, 0), (9, 0), (9, hair), (hair, hair), (hair, 9), (0, 9)]))
    check(Polygon([(1e9, 0), (1e9 + 1, 0), (math.nextafter(1e9, 2e9), 1), (1e9 + 1, 2), (1e9, 2)]))


def test_points_that_doubles_cannot_tell_apart_are_decomposed_exactly() -> None:
    hair = Fraction(1, 10**40)
    comb = [(0, 0), (9, 0)]
    for k in range(5, 0, -1):
        comb += [(1 + 2 * k * hair, 9), (1 + (2 * k - 1) * hair, 5)]
    polygon = Polygon([*comb, (0, 9)], [[(2, 1), (2 + hair, 1), (2, 1 + hair)]])
    v, rings = polygon.numerators, outline(polygon)
    assert not is_cover(v, rings, delaunay(v, rings))
    check(polygon)


def test_many_holes_are_cut_apart() -> None:
    check(grid_of_holes(30))


@pytest.mark.slow
def test_many_vertices_are_cut_apart() -> None:
    check(star(20_000))
