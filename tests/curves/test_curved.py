"""Polygons around round shapes and inside of them: that they are, exactly, and how near."""

import math
import random
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely

import cfree
from cfree.curves import Arc, Bezier, Circle
from cfree.scene.scene import Scene
from cfree.verify.curves import mismatches
from round_shapes import placed, random_shape, region

ROBOT = [(0, 0), (1, 0), (0, 1)]


def around_and_inside(shape: Any, error: float) -> list[Any]:
    return [
        shapely.union_all([p.to_shapely() for p in polygons]) for polygons in (shape.outer(error), shape.inner(error))
    ]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(60))
def test_polygons_are_around_and_inside_and_near(seed: int) -> None:
    rng = random.Random(f"near {seed}")
    shape = random_shape(rng)
    if isinstance(shape, cfree.Polygon):
        return
    where = rng.choice([(0, 0), (10**9, -(10**9)), (Fraction(1, 3), Fraction(-7, 11)), (Fraction(10**12, 7), 5)])
    shape = placed(shape, *map(Fraction, where))
    error = shape.size * 10 ** rng.uniform(-4, -1)
    error = max(error, shape.least_error)
    scene = Scene(ROBOT, [shape])
    outer, inner = scene.outer(error), scene.inner(error)
    assert list(mismatches(scene, outer, outward=True)) == []
    assert list(mismatches(scene, inner, outward=False)) == []
    assert list(mismatches(scene, outer, outward=False))
    assert list(mismatches(scene, inner, outward=True))
    if max(map(abs, where)) < 100:
        true = region(shape, 3000)
        for found in around_and_inside(shape, error):
            assert shapely.hausdorff_distance(found.boundary, true.boundary) <= 1.001 * error + 1e-4 * shape.size


def test_more_edges_for_less_error() -> None:
    circle = cfree.Curved.circle((0, 0), 1)
    counts = [len(circle.outer(error)[0]) for error in (0.1, 0.01, 0.001, 0.0001)]
    assert all(2.5 < more / less < 4 for less, more in pairwise(counts)), counts


@pytest.mark.parametrize("scale", [Fraction(1, 10**120), Fraction(1, 10**9), Fraction(10**9), Fraction(10**120)])
def test_sizes_do_not_matter(scale: Fraction) -> None:
    shape = cfree.Curved([(0, 0), (scale, 0), Arc((0, scale), center=(0, 0))])
    (around,), (within,) = (f(float(scale) / 100) for f in (shape.outer, shape.inner))
    areas = [float(p.exact_area / scale**2) for p in (within, around)]
    assert areas[0] < math.pi / 4 < areas[1] and areas[1] - areas[0] < 0.04
    scene = Scene([(0, 0), (scale, 0), (0, scale)], [shape])
    assert list(mismatches(scene, scene.outer(float(scale) / 100), outward=True)) == []


def test_errors_out_of_range() -> None:
    circle = cfree.Curved.circle((0, 0), 1)
    for error in (0.0, -1.0, math.inf, math.nan, circle.least_error / 2):
        with pytest.raises(ValueError, match="give a length"):
            circle.outer(error)


def test_a_cusp_has_polygons_around_and_none_inside() -> None:
    drop = cfree.Curved([(0, 0), Bezier([(4, 0), (4, 2), (2, 2)]), Bezier([(0, 2), (-1, 0), (0, 0)])])
    tip = cfree.Curved([(1, 0), Arc((0, 1), center=(0, 0)), Arc((1, 0), through=("63/50", "8/5"))])
    for shape in (drop, tip):
        assert shape.outer(0.1)
    cusp = cfree.Curved([(0, 0), Arc((2, 2), center=(0, 2)), Arc((0, 0), through=("2/5", "4/5"))])
    assert cusp.outer(0.01)


def test_grown_shapes_are_sums() -> None:
    shape = cfree.Curved([(0, 0), (4, 0), (4, 4), (3, 4), (3, 1), (0, 1)], grown=Fraction(1, 4))
    true = region(shape, 400)
    for found, bigger in zip(around_and_inside(shape, 0.01), (True, False), strict=True):
        assert found.buffer(1e-9).contains(true) if bigger else true.buffer(1e-9).contains(found)
        assert shapely.hausdorff_distance(found.boundary, true.boundary) < 0.011


def test_a_robot_grows_with_its_scene() -> None:
    scene = Scene([ROBOT, cfree.Curved.circle((2, 2), 1)], [[(9, 9), (10, 9), (9, 10)]], bounds=(0, 0, 9, 9))
    larger = scene.grown(Fraction(1, 2))
    assert larger.robot[1] == cfree.Curved.circle((2, 2), Fraction(3, 2))
    assert larger.robot[0] == cfree.Curved(ROBOT, grown=Fraction(1, 2))
    assert larger.grown(1).robot[0] == cfree.Curved(ROBOT, grown=Fraction(3, 2))
    assert (larger.obstacles, larger.bounds) == (scene.obstacles, scene.bounds)
    with pytest.raises(cfree.UnsupportedError, match="circles only"):
        Scene(cfree.Curved.ellipse((0, 0), (1, 2))).grown(1)


def test_a_workspace_shrinks_in_the_outer_scene() -> None:
    room = cfree.Curved(Circle((0, 0), 5), [Circle((0, 0), 1)])
    scene = Scene(ROBOT, workspace=room)
    outer, inner = (s.workspace.to_shapely() for s in (scene.outer(0.1), scene.inner(0.1)) if s.workspace)
    true = region(room, 2000)
    assert true.buffer(1e-6).contains(outer) and inner.buffer(1e-6).contains(true)
    assert list(mismatches(scene, scene.outer(0.1), outward=True)) == []
    assert list(mismatches(scene, scene.inner(0.1), outward=True))


def test_what_takes_polygons_says_so() -> None:
    scene = Scene(ROBOT, [cfree.Curved.circle((3, 3), 1)], bounds=(0, 0, 9, 9), start=(0, 0, 0), goal=(1, 1, 0))
    pose = cfree.Pose(0, 0)
    for call in (
        lambda: cfree.turn_in_place(scene, pose),
        lambda: cfree.arrangements.arrangement(scene),
        lambda: cfree.save(scene, "round.svg"), lambda: cfree.save(scene, "round.geojson"),
    ):  # fmt: skip
        with pytest.raises(cfree.UnsupportedError, match=r"scene\.outer\(error\) or scene\.inner\(error\)"):
            call()


def test_polygons_stay_what_they_are() -> None:
    plain = Scene(ROBOT, [[(3, 3), (4, 3), (3, 4)]])
    assert plain.outer(0.1) is plain and plain.inner(0.1) is plain and not plain.curved
    mixed = Scene(ROBOT, [[(3, 3), (4, 3), (3, 4)], cfree.Curved.circle((9, 9), 1)], obstacle_names=["a", "b"])
    assert mixed.curved and mixed.outer(0.1).obstacles[0] == plain.obstacles[0]
    assert mixed.outer(0.1).obstacle_names == ("a", "b")
    assert np.allclose(mixed.outer(0.1).obstacles[1].vertices.mean(axis=0), 9)


@pytest.mark.parametrize("far", [10**400, "1e400"], ids=["int", "text"])
def test_numbers_beyond_doubles_are_refused(far: Any) -> None:
    makers = (
        lambda: cfree.Curved.circle((0, 0), far),
        lambda: cfree.Curved.circle((far, 0), 1),
        lambda: cfree.Curved([(0, 0), (1, 0), (1, 1)], grown=far),
    )
    for make in makers:
        with pytest.raises(cfree.InvalidPolygonError, match="beyond"):
            make()
