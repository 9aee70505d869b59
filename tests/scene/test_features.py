"""What the core is given: exact coordinates, one identity for equal features, ranks from geometry."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings

import strategies
from cfree import Scene
from cfree.polygons.polygon import Polygon
from cfree.scene.features import ShapeFeatures, scene_features
from compared import scene_of
from reference_features import classes, ranks
from reference_features import scene_features as expected_features
from shapes import PlainScene, box, frame, l_shape, random_scene

brief = settings(deadline=None, derandomize=True, max_examples=30, database=None)


def test_two_boxes_with_tops_on_one_line_share_it() -> None:
    #  3---2 7---6   edges 2 and 6 lie on one line; 0 and 4 on another
    #  0---1 4---5
    shape = scene_features(scene_of(PlainScene([box(0, 0, 1, 1)], [box(0, 0, 2, 2), box(3, 0, 5, 2)]))).obstacles
    line, direction = shape.core.line, shape.core.direction
    assert line[2] == line[6] and line[0] == line[4]
    assert len({*line.tolist()}) == 6
    assert len({*direction.tolist()}) == 2


def test_classes_number_equal_keys_alike() -> None:
    assert classes(["b", "a", "b", "c"]) == [0, 1, 0, 2]
    assert ranks([0, 0, 1, 0], [5, 3, 9, 4]) == [2, 0, 0, 1]


@brief
@given(strategies.scenes())
def test_equal_features_and_no_others_share_an_identity(plain: PlainScene) -> None:
    features = scene_features(scene_of(plain))
    for shape in (features.robot, features.obstacles):
        core, vertices = shape.core, shape.vertices
        for k, p in enumerate(vertices):
            for m, q in enumerate(vertices[:k]):
                assert (core.point[k] == core.point[m]) == (p == q)
        edges = [(vertices[v], vertices[w]) for v, w in zip(shape.v, shape.w, strict=True)]
        vectors = [(x1 - x0, y1 - y0) for (x0, y0), (x1, y1) in edges]
        for k, (u, ((x, y), _)) in enumerate(zip(vectors, edges, strict=True)):
            for m in range(k):
                v, ((x2, y2), _) = vectors[m], edges[m]
                parallel = u[0] * v[1] == u[1] * v[0]
                on_line = parallel and u[0] * (y2 - y) == u[1] * (x2 - x) and u[0] * v[0] + u[1] * v[1] > 0
                assert (core.direction[k] == core.direction[m]) == parallel
                assert (core.line[k] == core.line[m]) == on_line


@pytest.mark.slow
@pytest.mark.parametrize("factor", [Fraction(1), Fraction(1, 3 * 2**70)])
@pytest.mark.parametrize("offset", [Fraction(0), Fraction(10**9), Fraction(10**30, 7)])
@brief
@given(plain=strategies.scenes())
def test_the_core_numbers_features_as_the_reference_does(plain: PlainScene, factor: Fraction, offset: Fraction) -> None:
    def moved(polygon: Polygon, by: Fraction) -> Polygon:
        points = [(factor * x + by, factor * y - by) for x, y in polygon.exact_vertices]
        outer, *holes = (points[i:j] for i, j in pairwise(polygon.ring_offsets))
        return Polygon(outer, holes)

    given = scene_of(plain)
    scene = Scene(
        [moved(part, Fraction(0)) for part in given.robot],
        [moved(obstacle, offset) for obstacle in given.obstacles],
        bounds=given.bounds and [factor * b + (offset, -offset)[k % 2] for k, b in enumerate(given.bounds)],
        workspace=given.workspace and moved(given.workspace, offset),
    )
    found, expected = scene_features(scene), expected_features(scene)
    assert (found.scale, found.rim) == (expected.scale, expected.rim)
    for shape, other in ((found.robot, expected.robot), (found.obstacles, expected.obstacles)):
        assert shape.vertices == tuple(other.vertices)
        assert (found.core.shift, found.core.near.shift) == (other.shift, other.near_shift)
        for name in other.core.keys() - {"vertices", "shift", "scale", "ring_vertices"}:
            assert np.array_equal(getattr(shape.core, name), other.core[name]), name
        for name in ("owner_polygon", "owner_vertex", "xy", "near"):
            assert np.array_equal(getattr(shape, name), getattr(other, name)), name
    assert found.frame == expected.frame


@pytest.mark.slow
@brief
@given(strategies.scenes())
def test_pieces_are_convex_and_cover_the_area(plain: PlainScene) -> None:
    features = scene_features(scene_of(plain))
    scene = scene_of(plain)
    for shape, polygons in ((features.robot, scene.robot), (features.obstacles, scene.obstacles)):
        twice = 0
        for piece in shape.pieces:
            ring = [shape.vertices[v] for v in piece]
            for p, q, r in zip(ring, ring[1:] + ring[:1], ring[2:] + ring[:2], strict=True):
                assert (q[0] - p[0]) * (r[1] - q[1]) - (q[1] - p[1]) * (r[0] - q[0]) >= 0
            twice += sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(ring, ring[1:] + ring[:1], strict=True))
        assert Fraction(twice, 2 * features.scale**2) == sum(polygon.exact_area for polygon in polygons)


def test_coordinates_are_the_users_times_one_denominator() -> None:
    scene = Scene(
        robot=[("1/3", 0), (1, 0), (0, "1/7")], obstacles=[[(0.1, 0), (1, 0), (0, 0.5)]], bounds=(0, 0, 1, "1/5")
    )
    features = scene_features(scene)
    assert features.scale % (3 * 7 * 5 * Fraction(0.1).denominator) == 0
    assert Fraction(features.robot.vertices[0][0], features.scale) == Fraction(1, 3)
    assert np.array_equal(features.obstacles.xy[:3], scene.obstacles[0].vertices)


def test_owners_name_the_rings_of_the_input() -> None:
    features = scene_features(
        scene_of(PlainScene([l_shape()], [box(9, 9, 10, 10), frame()], (0, 0, 9, 9), box(0, 0, 8, 8)))
    )
    shape: ShapeFeatures = features.obstacles
    assert shape.owner_polygon[:12].tolist() == [0] * 4 + [1] * 8
    assert shape.owner_vertex[:12].tolist() == [*range(4), *range(8)]
    assert set(shape.owner_polygon[12:].tolist()) == {-2, -1}
    assert features.robot.owner_polygon.tolist() == [0] * 6 + [-1]


def test_the_rim_is_beyond_everything_forbidden() -> None:
    for kind in ("bounds", "workspace"):
        for seed in range(6):
            features = scene_features(scene_of(random_scene(seed, kind)))
            assert features.rim is not None
            x0, y0, x1, y1 = features.rim
            radius = np.hypot(*features.robot.xy.T).max()
            pillars = features.obstacles.xy[: len(features.obstacles.previous)]
            assert (pillars.min(axis=0) - (x0, y0)).min() >= 0 and ((x1, y1) - pillars.max(axis=0)).min() >= 0
            assert x1 - x0 > radius < y1 - y0
    assert scene_features(scene_of(random_scene(0, "convex"))).rim is None
