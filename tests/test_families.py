"""The benchmarks' scene families: valid, repeatable, of the size they say."""

from __future__ import annotations

import importlib
import itertools
from types import ModuleType

import numpy as np
import pytest
import shapely

import cfree


@pytest.fixture
def families(monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> ModuleType:
    monkeypatch.syspath_prepend(str(request.config.rootpath / "benchmarks"))
    return importlib.import_module("families")


@pytest.mark.parametrize("name", ["convex", "stars", "combs", "noisy", "flats", "warehouse", "grid", "city"])
def test_a_family_is_valid_and_the_same_each_time(families: ModuleType, name: str) -> None:
    size = families.SIZES[name][0]
    scene, again = families.FAMILIES[name](size), families.FAMILIES[name](size)
    assert np.array_equal(scene.vertices, again.vertices)
    for ring in [scene.robot, *scene.rings()]:
        polygon = shapely.Polygon(ring)
        assert polygon.is_valid
        assert polygon.exterior.is_ccw


def test_convex_obstacles_have_4_vertices_and_a_third_and_keep_their_density(families: ModuleType) -> None:
    for count in families.SIZES["convex"][:3]:
        scene = families.convex(count)
        assert len(scene.offsets) == count + 1
        assert abs(len(scene.vertices) / count - 4.3) < 0.1
        assert abs(np.prod(np.ptp(scene.vertices, axis=0)) / count - 9) < 2
        polygons = [shapely.Polygon(ring) for ring in scene.rings()[:99]]
        assert np.allclose(shapely.area(shapely.convex_hull(polygons)), shapely.area(polygons))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["maze", "trap", "barrier", "field", "nest", "throat", "large"])
def test_a_question_is_the_same_each_time_and_has_free_ends(families: ModuleType, name: str) -> None:
    scene = families.QUESTIONS[name](0)
    assert scene == families.QUESTIONS[name](0) != families.QUESTIONS[name](1)
    assert len(scene.obstacles) >= 30
    checker = cfree.MotionChecker(scene)
    for pose in (scene.start, scene.goal):
        assert checker.joins([pose, pose])


def test_frames_of_a_costmap_change_a_few_cells_and_are_the_same_each_time(families: ModuleType) -> None:
    frames, again = list(families.frames(3, 100)), list(families.frames(3, 100))
    assert all(np.array_equal(one, other) for one, other in zip(frames, again, strict=True))
    for one, other in itertools.pairwise(frames):
        assert 0 < np.count_nonzero(one != other) < 60
    assert {*np.unique(frames)} == {0, 100}
