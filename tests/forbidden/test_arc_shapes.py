"""Boundaries of shapes with convex arcs, against exact tests of poses, slices in shapely, and closed formulas."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import shapely

import cfree._core as core
from arc_rings import CONVEX, HALF, RINGS, SECTOR, random_arcs, shape
from cfree import Curved, Pose, Scene, boundary, free_space, is_free
from cfree.contact import shape_features
from cfree.curves import Arc
from cfree.planning.smaller_shapes import smaller
from cfree.scene.features import features_of_cores
from cfree.scene.grown_cores import Cores
from cfree.scene.rounded import rounded, rounded_shapes


def fine(shape: Any, n: int = 400) -> Any:
    """The shape in shapely, its arcs by many chords."""
    form = rounded(shape)
    assert form is not None
    region = shapely.Polygon(form.core.vertices)  # type: ignore[union-attr]
    for arc in form.arcs:
        (x, y), r = map(float, arc.center), float(arc.radius)
        first, last = (math.atan2(float(p[1]) - y, float(p[0]) - x) for p in (arc.start, arc.end))
        angles = np.linspace(first, first + (last - first) % math.tau, n)
        region = region.union(shapely.Polygon(np.column_stack([x + r * np.cos(angles), y + r * np.sin(angles)])))
    return region


@pytest.mark.parametrize("name", RINGS)
def test_chords_and_arcs_are_the_shape(name: str) -> None:
    form = rounded(shape(RINGS[name]))
    assert form is not None and form.arcs and form.radius == 0
    assert math.isclose(fine(shape(RINGS[name])).area, shape_features(shape(RINGS[name])).area, rel_tol=1e-4)
    for arc in form.arcs:
        for end in (arc.start, arc.end):
            assert sum((p - c) ** 2 for p, c in zip(end, arc.center, strict=True)) == arc.radius**2


def test_chords_that_meet_other_sides_are_cut_finer() -> None:
    notched = Curved([(5, 0), Arc((-5, 0), center=(0, 0)), (-1, 0), (3, 3), (1, 0)])
    form = rounded(notched)
    assert form is not None and len(form.arcs) > 2
    assert math.isclose(fine(notched).area, shape_features(notched).area, rel_tol=1e-4)


@pytest.mark.parametrize(
    "curved",
    [
        Curved([(0, 0), (4, 0), Arc((0, 4), center=(4, 4), clockwise=True)]),  # concave
        Curved([(0, 0), (2, 0), Arc((0, 2), through=("3/2", "3/2"))]),  # of an irrational radius
        Curved.ellipse((0, 0), (2, 1)),
    ],
)
def test_other_shapes_are_not_rounded(curved: Curved) -> None:
    assert rounded(curved) is None


@pytest.mark.slow
@pytest.mark.parametrize(("one", "other"), [(a, b) for a in CONVEX for b in CONVEX if a <= b])
def test_volume_of_a_convex_pair_is_that_of_the_formula(one: str, other: str) -> None:
    robot, obstacle = shape(RINGS[one], 1, 2), shape(RINGS[other], 7, -3, "1/2")
    a, b = shape_features(robot), shape_features(obstacle)
    # the mean over all orientations of the area of a sum
    expected = 2 * math.pi * (a.area + b.area) + a.perimeter * b.perimeter
    space = free_space(boundary(Scene(robot, [obstacle], bounds=(-40, -40, 40, 40))))
    assert abs(float(space.volumes.sum()) - (math.tau * 6400 - expected)) < 1e-8
    assert space.volume_errors.sum() < 1e-8


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_cells_and_slices_of_random_scenes(seed: int) -> None:
    scene, rng = random_arcs(seed), random.Random(seed)
    found = boundary(scene)
    space = free_space(found)
    assert np.all(found.complex.euler % 2 == 0)
    theta = rng.uniform(0, math.tau)
    cut = found.slice(theta)
    x0, y0, x1, y1 = cut.forbidden.bounds
    for _ in range(200):
        pose = Pose(rng.uniform(x0, x1), rng.uniform(y0, y1), rng.uniform(0, math.tau))
        assert (space.locate(pose) >= 0) == is_free(scene, pose), pose
    for _ in range(100):
        x, y = rng.uniform(x0, x1), rng.uniform(y0, y1)
        if shapely.boundary(cut.forbidden).distance(shapely.Point(x, y)) > 2 * cut.error:
            assert is_free(scene, Pose(x, y, theta)) == (not cut.forbidden.contains(shapely.Point(x, y)))


def test_parts_of_a_robot_have_radii_of_their_own() -> None:
    car = [
        Curved([(0, 0), (4, 0), (4, 2), (0, 2)], grown="1/4"),
        Curved.circle((5, 1), "1/2"),
        [(-1, 0), (0, 1), (-1, 2)],
    ]
    scene = Scene(car, [Curved.circle((9, 1), 1), [(0, 4), (8, 5), (0, 6)]])
    space = free_space(boundary(scene))
    rng = random.Random(3)
    for _ in range(100):
        pose = Pose(rng.uniform(-3, 12), rng.uniform(-4, 8), rng.uniform(0, math.tau))
        assert (space.locate(pose) >= 0) == is_free(scene, pose), pose


def test_three_circles_through_one_point_at_every_angle() -> None:
    """Two corners of the robot are on a disc of its own; a disc of that size is one radius away from a small one."""
    robot = [Curved.circle((-3, -2), 5), [(1, 1), (-1, 0), (0, -1)], [(-2, 0), (0, -6), (2, -2)]]
    scene = Scene(robot, [Curved.circle((2, -3), 5), Curved.circle((-4, -3), 1), Curved.circle((20, 0), 1)])
    found = boundary(scene)
    space = free_space(found)
    assert np.all(found.complex.euler % 2 == 0)
    rng = random.Random(5)
    for _ in range(200):
        pose = Pose(rng.uniform(-15, 15), rng.uniform(-15, 15), rng.uniform(0, math.tau))
        assert (space.locate(pose) >= 0) == is_free(scene, pose), pose


def test_places_of_arcs_have_names() -> None:
    found = boundary(Scene(shape(HALF, by="1/5"), [shape(SECTOR, 3, 0), [(0, 5), (2, 5), (1, 7)]]))
    kinds = {patch.kind for patch in found.patches if patch.is_live}
    assert kinds == {"v-e", "e-v", "arc-arc"}
    for k in range(len(found.trapezoids)):
        part = found.trapezoid(k)
        named = [part.lower, part.upper, *part.start.features, *part.stop.features]
        assert all(feature.obstacle.polygon in (0, 1) and feature.robot.polygon == 0 for feature in named)


@pytest.mark.slow
@pytest.mark.parametrize("power", [30, 56, 60, 70, 100])
def test_boundaries_are_glued_where_angles_are_closer_than_doubles(power: int) -> None:
    scene = random_arcs(15)
    shapes = rounded_shapes(scene)
    assert shapes is not None
    parts = [smaller([part], Fraction(1, 2**power)) for part in shapes.robot]
    features = features_of_cores(Cores(tuple(part[0] for part in parts if part), shapes.obstacles), scene, None)
    found = core.compute_boundary(features.core, 1, True, lambda _: True)
    places = np.concatenate([found.trapezoids.from_place, found.trapezoids.to_place])
    assert places.any() == (power > 40), "places of angles among others of one interval"
    volumes, _ = core.free_space(core.glue(found, 1)).volumes()
    assert np.allclose(np.sort(volumes), np.sort(free_space(boundary(scene)).volumes))
