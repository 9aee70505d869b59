"""Curvature of closed surfaces of rounded shapes adds up to their Euler numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest

import cfree
from arc_rings import random_arcs
from cfree import Scene, boundary
from cfree.geometry import gauss_bonnet
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


def test_smooth_joints_have_no_edges_for_curvature() -> None:
    """Along a joint both faces have the same tangent plane, so that their geodesic curvatures cancel."""
    result = boundary(Scene(grown(TRIANGLE, "1/4"), [disc(4, 1, "1/2")]))
    sides, twin = gauss_bonnet(result).sides, result.complex.twin
    assert math.isclose(np.abs(sides + sides[twin]).max(), 0, abs_tol=1e-9)
    assert np.abs(sides).max() > 0.1


def test_sums_of_rounded_shapes_are_shown() -> None:
    assert "euler" in repr(cfree.geometry.gauss_bonnet(boundary(MIXED)))
