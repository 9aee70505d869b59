"""Faces of a noding: as many as Euler says, nested, with the outlines that shapely finds."""

import random
from fractions import Fraction

import pytest
import shapely
from shapely.ops import polygonize

from cfree.polygons.faces import Faces
from cfree.polygons.noding import Graph, graph_of
from cfree.polygons.polygon import Polygon
from nodings import noded, soup


def polygons(faces: Faces, solid: list[bool]) -> list[Polygon]:
    def points(ring: list[int]) -> list[tuple[Fraction, Fraction]]:
        return [faces.graph.point(faces.origin(half)) for half in ring]

    return [Polygon(points(outer), list(map(points, holes))) for outer, *holes in faces.outlines(solid)]


def squares(*boxes: tuple[int, int, int]) -> Graph:
    corners = [[(x, y), (x + w, y), (x + w, y + w), (x, y + w)] for x, y, w in boxes]
    graph = graph_of([])
    graph.add([(ring[k - 1], ring[k], number) for number, ring in enumerate(corners) for k in range(4)])
    return graph


@pytest.mark.parametrize("seed", range(8))
def test_faces_and_their_union_are_those_of_shapely(seed: int) -> None:
    rng = random.Random(seed)
    segments = soup(rng, rng.choice((30, 300)), rng.choice((0, 3)))
    graph = noded(segments)
    faces = Faces(graph)
    nodes = {node for edge in faces.edges for node in graph.edges[edge]}
    assert faces.count == len(faces.edges) - len(nodes) + len(faces.around) + 1
    lines = [shapely.LineString([tuple(map(float, p)), tuple(map(float, q))]) for p, q, _ in segments if p != q]
    parts = list(polygonize(shapely.unary_union(lines)))
    assert len(parts) == faces.count - 1
    union = polygons(faces, [False] + [True] * (faces.count - 1))
    assert sum(polygon.area for polygon in union) == pytest.approx(shapely.unary_union(parts).area if parts else 0)


@pytest.mark.parametrize("seed", range(6))
def test_any_set_of_faces_has_valid_outlines_of_its_area(seed: int) -> None:
    rng = random.Random(seed)
    graph = noded(soup(rng, 150, 0))  # whole numbers: many points of four and more edges
    faces = Faces(graph)
    areas = []
    for face in range(1, faces.count):
        (one,) = polygons(faces, [other == face for other in range(faces.count)])
        areas.append(one.exact_area)
    solid = [False] + [rng.random() < 0.5 for _ in areas]
    union = polygons(faces, solid)
    assert sum(polygon.exact_area for polygon in union) == sum(
        area for area, inside in zip(areas, solid[1:], strict=True) if inside
    )


def test_components_are_nested_in_faces() -> None:
    faces = Faces(squares((0, 0, 10), (1, 1, 2), (5, 5, 4), (6, 6, 2), (20, 0, 3)))
    outer, first, second, inner, apart = range(5)
    assert faces.around[outer] == faces.around[apart] == 0
    assert faces.around[first] == faces.around[second] != 0
    assert faces.around[inner] not in (0, faces.around[first])
    ring, *holes = faces.outlines([face == faces.around[first] for face in range(faces.count)])[0]
    assert (len(ring), len(holes)) == (4, 2)


@pytest.mark.parametrize("flip", [1, -1])
def test_a_component_right_above_a_corner_is_outside(flip: int) -> None:
    corners = [(0, 0), (10, 5 * flip), (10, -5 * flip)]
    graph = graph_of([])
    graph.add([(corners[k - 1], corners[k], 0) for k in range(3)])
    graph.add([((0, 3), (1, 3), 1), ((1, 3), (1, 4), 1), ((1, 4), (0, 3), 1)])
    assert Faces(graph).around == [0, 0]


def test_tails_and_bridges_are_beside_one_face() -> None:
    graph = squares((0, 0, 4), (10, 0, 4))
    graph.add([((4, 2), (10, 2), 9), ((0, 4), (0, 9), 9)])
    faces = Faces(graph)
    assert sum(not faces.is_between(edge) for edge in faces.edges) == 2
    assert len(faces.outlines([False, *[True] * (faces.count - 1)])) == 2


def test_the_outer_contour_leaves_dividing_edges_out() -> None:
    graph = squares((0, 0, 4))
    graph.add([((2, 0), (2, 4), 9)])
    faces = Faces(graph)
    (contour,) = faces.outer_edges(faces.edges)
    assert len(contour) == 6 == len(faces.edges) - 1


def test_rings_that_touch_in_a_point_are_simple() -> None:
    faces = Faces(squares((0, 0, 4), (0, 0, 2), (4, 4, 2)))
    assert [len(rings) for rings in faces.outlines([False] + [True] * (faces.count - 1))] == [1, 1]
