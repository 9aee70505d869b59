"""Curvature of closed surfaces of rounded shapes adds up to their Euler numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest

import cfree
from arc_rings import random_arcs, random_concave
from cfree import Scene, boundary
from cfree.geometry import gauss_bonnet, gauss_map
from rounded_scenes import MIXED, SCENES, TRIANGLE, disc, grown, random_scene
from rounded_ties import SCENES as TIES
from rounded_ties import scene_of


def check(scene: Scene, angle_scale: float = 1.0) -> None:
    result = boundary(scene)
    sums = gauss_bonnet(result, angle_scale=angle_scale)
    assert np.abs(sums.euler - result.complex.euler).max() < 1e-5
    assert sums.gap < 1e-5


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_curvature_of_rounded_shapes_adds_up_to_euler_numbers(name: str) -> None:
    check(SCENES[name])
    check(SCENES[name], 2.5)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_curvature_of_random_rounded_scenes_adds_up(seed: int) -> None:
    check(random_scene(seed))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(20))
def test_curvature_among_arcs_as_sides_adds_up(seed: int) -> None:
    check(random_arcs(seed))


@pytest.mark.slow
@pytest.mark.parametrize("name", TIES)
def test_curvature_adds_up_where_circles_only_touch(name: str) -> None:
    scene = scene_of(name)
    if scene is not None and scene.curved:
        check(scene)


def test_the_sum_of_a_smooth_torus_has_all_digits() -> None:
    result = boundary(Scene(grown(TRIANGLE, "1/4"), [disc(4, 1, "1/2")]))
    assert np.abs(gauss_bonnet(result).euler).max() < 1e-12
    assert result.complex.euler.tolist() == [0]


def check_degrees(scene: Scene, angle_scale: float = 1.0) -> bool:
    """Check degrees; False if their error is infinite."""
    result = boundary(scene)
    degrees = gauss_map(result, angle_scale=angle_scale)
    if not np.isfinite(degrees.error).all():
        return False
    assert np.abs(degrees.degree - result.complex.euler / 2).max() < 1e-3
    return True


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_degree_is_half_the_euler_number_among_rounded_shapes(name: str) -> None:
    assert check_degrees(SCENES[name]) and check_degrees(SCENES[name], 2.5)


@pytest.mark.slow
@pytest.mark.long
def test_degree_is_half_the_euler_number_among_random_arcs_with_a_finite_error() -> None:
    for kind in (random_scene, random_arcs, random_concave):
        assert sum(check_degrees(kind(seed)) for seed in range(12)) >= 10


@pytest.mark.slow
def test_degree_is_half_the_euler_number_where_circles_touch() -> None:
    scenes = [scene for name in TIES if (scene := scene_of(name)) is not None and scene.curved]
    assert sum(check_degrees(scene) for scene in scenes) >= len(scenes) - 6


def test_surfaces_that_are_balls_have_the_degree_one() -> None:
    scene = scene_of("A15")
    assert scene is not None and check_degrees(scene)
    assert 2 in boundary(scene).complex.euler


def test_smooth_joints_have_no_edges_for_curvature() -> None:
    """Along a joint both faces have the same tangent plane, so that their geodesic curvatures cancel."""
    result = boundary(Scene(grown(TRIANGLE, "1/4"), [disc(4, 1, "1/2")]))
    sides, twin = gauss_bonnet(result).sides, result.complex.twin
    assert math.isclose(np.abs(sides + sides[twin]).max(), 0, abs_tol=1e-9)
    assert np.abs(sides).max() > 0.1


def test_sums_of_rounded_shapes_are_shown() -> None:
    assert "euler" in repr(cfree.geometry.gauss_bonnet(boundary(MIXED)))
