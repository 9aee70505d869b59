"""The oracles against closed forms, hand-made answers and each other."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given, settings

import oracles
from shapes import (
    KINDS,
    NAMED,
    Shape,
    box,
    frame,
    moved,
    paper_like,
    random_convex,
    random_scene,
    regular,
    scaled,
    u_shape,
)
from strategies import convex_polygons, polygons, poses, scenes

SQUARE = box(0, 0, 1, 1)


def body(shape: Shape) -> shapely.Polygon:
    return shapely.Polygon(*shape)


def mixed_area_twice(A: Shape, B: Shape) -> float:
    """2 V(A, B): over the edges of B, length times the support of A along the outward normal."""
    a, b = np.array(A[0], dtype=float), np.array(B[0], dtype=float)
    normals = (np.roll(b, -1, axis=0) - b) @ np.array([[0, -1], [1, 0]])
    return float((a @ normals.T).max(axis=0).sum())


# --- examples ---


def test_two_boxes_sum_to_a_box() -> None:
    slice_ = oracles.forbidden_slice([SQUARE], [box(4, 2, 6, 5)], 0.0)
    assert slice_.equals(shapely.box(3, 1, 6, 5))
    half_turned = oracles.forbidden_slice([SQUARE], [box(4, 2, 6, 5)], math.pi)
    assert half_turned.symmetric_difference(shapely.box(4, 2, 7, 6)).area < 1e-12


def test_a_frame_leaves_a_hole_for_a_small_robot_and_none_for_a_large_one() -> None:
    (hole,) = oracles.forbidden_slice([SQUARE], [frame()], 0.0).interiors
    assert hole.equals(shapely.box(1, 1, 4, 4).exterior)
    assert not oracles.forbidden_slice([box(0, 0, 5, 1)], [frame()], 0.0).interiors


def test_a_robot_with_a_hole_may_hold_an_obstacle() -> None:
    robot, obstacle = [moved(frame(), -3, -3)], [box(-1, -1, 1, 1)]
    assert not oracles.overlaps(robot, obstacle, (0, 0, 0))
    assert not oracles.exact_overlaps(robot, obstacle, 1, 1, Fraction(0))  # in contact, inside
    assert oracles.exact_overlaps(robot, obstacle, 1 + Fraction(1, 10**30), 0, Fraction(0))


def test_bounds_forbid_the_outside_of_a_rectangle() -> None:
    free = oracles.free_slice([SQUARE], [box(4, 4, 6, 6)], 0.0, bounds=(0, 0, 5, 5))
    assert free.equals(shapely.box(0, 0, 5, 5).difference(shapely.box(3, 3, 6, 6)))


def test_a_workspace_keeps_every_point_of_the_robot_inside() -> None:
    free = oracles.free_slice([SQUARE], [], 0.0, workspace=box(0, 0, 10, 6))
    assert free.equals(shapely.box(0, 0, 9, 5))
    free = oracles.free_slice([SQUARE], [], 0.0, workspace=scaled(frame(), 3))
    assert free.equals(shapely.box(0, 0, 17, 17).difference(shapely.box(2, 2, 15, 15)))
    assert oracles.exact_is_forbidden([SQUARE], [], 100, 0, None, workspace=box(0, 0, 10, 6))
    assert not oracles.exact_is_forbidden([SQUARE], [], 1, 1, None, workspace=box(0, 0, 10, 6))


def test_touching_is_free_and_the_least_overlap_is_not() -> None:
    tiny = Fraction(1, 10**40)
    wall = [box(1, 0, 2, 1)]
    hulls = oracles.exact_hulls([SQUARE], wall, Fraction(0))
    for x, forbidden in ((Fraction(0), False), (tiny, True)):
        assert oracles.exact_overlaps([SQUARE], wall, x, 0, Fraction(0)) is forbidden
        assert oracles.in_some_hull((x, 0), hulls) is forbidden


def test_a_slot_as_wide_as_the_robot_is_free_exactly_and_lost_in_the_closure() -> None:
    slot = [u_shape(3, 3, 1)]
    assert not oracles.exact_overlaps([SQUARE], slot, 1, Fraction(3, 2), Fraction(0))
    assert oracles.forbidden_slice([SQUARE], slot, 0.0).contains(shapely.Point(1, 1.5))


def test_contact_distance_is_the_gap() -> None:
    assert oracles.boundary_contact_distance([SQUARE], [box(3, 0, 4, 1)], (0, 0, 0)) == 2
    assert oracles.boundary_contact_distance([SQUARE], [], (1, 2, 0), bounds=(0, 0, 9, 9)) == 1
    assert oracles.boundary_contact_distance([SQUARE], [], (1, 2, 0), workspace=box(0, 0, 9, 9)) == 1


# --- closed forms ---


@pytest.mark.parametrize("seed", range(20))
def test_area_of_a_convex_sum_is_the_areas_plus_twice_the_mixed_area(seed: int) -> None:
    rng = random.Random(seed)
    A, O = random_convex(rng), random_convex(rng, (3.0, 1.0))
    theta = rng.uniform(0, 2 * math.pi)
    c, s = math.cos(theta), math.sin(theta)
    turned = [(-c * x + s * y, -s * x - c * y) for x, y in A[0]], []
    expected = body(A).area + body(O).area + mixed_area_twice(turned, O)
    slice_ = oracles.forbidden_slice([A], [O], theta)
    assert math.isclose(slice_.area, expected, rel_tol=1e-12)
    assert math.isclose(slice_.length, body(A).length + body(O).length, rel_tol=1e-12)


def test_mean_slice_of_a_convex_pair_has_the_area_of_the_principal_kinematic_formula() -> None:
    scene = paper_like()
    A, O = (body(shapes[0]) for shapes in scene[:2])
    count = 720
    slices = [oracles.forbidden_slice(*scene[:2], 2 * math.pi * k / count) for k in range(count)]
    mean = sum(slice_.area for slice_ in slices) / count
    assert math.isclose(mean, A.area + O.area + A.length * O.length / (2 * math.pi), rel_tol=1e-4)


@settings(deadline=None)
@given(convex_polygons(), convex_polygons())
def test_exact_hull_has_the_exact_area(A: Shape, O: Shape) -> None:
    hull = oracles.exact_hull((bx - ax, by - ay) for bx, by in O[0] for ax, ay in A[0])
    turned = [(-x, -y) for x, y in A[0]], []
    expected = oracles.exact_area([A, O]) + Fraction(mixed_area_twice(turned, O))
    assert oracles.ring_area([(Fraction(x), Fraction(y)) for x, y in hull]) == expected


# --- each oracle against the others ---


@pytest.mark.parametrize("kind", KINDS)
def test_slices_agree_with_overlap_at_random_poses(kind: str) -> None:
    for seed in range(4):
        robot, obstacles, bounds, workspace = random_scene(seed, kind)
        rng = random.Random(seed)
        tau = Fraction(rng.randint(-9, 9), rng.randint(1, 9))
        theta = 2 * math.atan(tau)
        slice_ = oracles.forbidden_slice(robot, obstacles, theta, bounds, workspace)
        assert slice_.is_valid
        x0, y0, x1, y1 = slice_.bounds
        for _ in range(8):
            x, y = Fraction(rng.uniform(x0, x1)), Fraction(rng.uniform(y0, y1))
            if slice_.boundary.distance(shapely.Point(x, y)) < 1e-9:
                continue
            inside = slice_.contains(shapely.Point(x, y))
            assert oracles.exact_is_forbidden(robot, obstacles, x, y, tau, bounds, workspace) is inside
            if bounds is None and workspace is None:
                assert oracles.overlaps(robot, obstacles, (x, y, theta)) is inside


@pytest.mark.parametrize("kind", KINDS)
def test_points_on_the_rim_of_a_slice_are_in_contact(kind: str) -> None:
    for seed in range(4):
        robot, obstacles, bounds, workspace = random_scene(seed, kind)
        theta = random.Random(seed).uniform(0, 2 * math.pi)
        free = oracles.free_slice(robot, obstacles, theta, bounds, workspace)
        rim = oracles.window(robot, obstacles, bounds, workspace).exterior
        forbidden = oracles.forbidden_slice(robot, obstacles, theta, bounds, workspace)
        for position in np.linspace(0, 1, 7, endpoint=False):
            point = forbidden.boundary.interpolate(position, normalized=True)
            if rim.distance(point) > 1e-9:
                pose = (point.x, point.y, theta)
                gap = oracles.boundary_contact_distance(robot, obstacles, pose, bounds, workspace)
                assert gap < 1e-9
                assert free.distance(point) < 1e-9


@pytest.mark.parametrize("kind", KINDS)
def test_exact_hulls_unite_to_the_slice(kind: str) -> None:
    robot, obstacles, *_ = random_scene(1, kind)
    tau = Fraction(2, 7)
    hulls = oracles.exact_hulls(robot, obstacles, tau)
    rounded = [shapely.Polygon(np.array(hull, dtype=float)) for hull in hulls]
    slice_ = oracles.forbidden_slice(robot, obstacles, 2 * math.atan(tau))
    assert shapely.union_all(rounded).symmetric_difference(slice_).area < 1e-9


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(scenes(), poses())
def test_exact_hulls_and_separating_axes_agree_even_in_contact(scene, pose) -> None:  # type: ignore[no-untyped-def]
    x, y, tau = pose
    hulls = oracles.exact_hulls(scene.robot, scene.obstacles, tau)
    for point in ((x, y), *hulls[0][:2]):  # anywhere, and in vertex-vertex contact
        expected = oracles.exact_overlaps(scene.robot, scene.obstacles, *point, tau)
        assert oracles.in_some_hull(point, hulls) is expected


# --- triangles, shapes and scenes ---


@settings(deadline=None)
@given(polygons())
def test_exact_triangles_have_the_area_of_the_polygon(shape: Shape) -> None:
    areas = map(oracles.ring_area, oracles.exact_triangles([shape]))
    assert sum(areas) == oracles.exact_area([shape])


def test_exact_triangles_where_doubles_see_no_width() -> None:
    """A hole touches the slanted side of its outer ring in a point that no double has."""
    third, hair = Fraction(1, 3), Fraction(1, 10**40)
    touching = ([(0, 0), (3, 1), (0, 2)], [[(1, third), (4 * third, 1), (Fraction(1, 2), 1)]])
    split = ([(0, 0), (9, 0), (9, 9), (third + hair, 9), (third, 1), (third, 9), (0, 9)], [])
    for polygon in (touching, split):
        triangles = oracles.exact_triangles([polygon])
        assert all(oracles.ring_area(triangle) > 0 for triangle in triangles)
        assert sum(map(oracles.ring_area, triangles)) == oracles.exact_area([polygon])


@pytest.mark.parametrize("name", NAMED)
def test_named_shapes_are_valid_and_have_their_interior_on_the_left(name: str) -> None:
    shape = NAMED[name]()
    polygon = body(shape)
    assert polygon.is_valid
    assert polygon.exterior.is_ccw
    assert not any(hole.is_ccw for hole in polygon.interiors)
    assert sum(map(oracles.ring_area, oracles.exact_triangles([shape]))) == oracles.exact_area([shape])


@pytest.mark.parametrize("kind", KINDS)
def test_random_scenes_are_valid_and_the_same_for_the_same_seed(kind: str) -> None:
    for seed in range(20):
        scene = random_scene(seed, kind)
        assert scene == random_scene(seed, kind)
        for shape in [*scene.robot, *scene.obstacles, *([scene.workspace] if scene.workspace else [])]:
            polygon = body(shape)
            assert polygon.is_valid
            assert polygon.exterior.is_ccw
            assert not any(hole.is_ccw for hole in polygon.interiors)


def test_pieces_are_convex() -> None:
    for piece in oracles.convex_pieces([u_shape(), regular(7), frame()]):
        assert math.isclose(body((piece.tolist(), [])).convex_hull.area, body((piece.tolist(), [])).area)
