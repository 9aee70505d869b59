"""Maps of reach: regions are those of cells, images those of regions, and files are read back."""

from __future__ import annotations

import json
import math
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

import cfree
from cfree.curves import Arc
from cfree.plot import plot_reach

ROOM = [(0, 0), (9, 0), (9, 5), (0, 5)]
WALL = [(4, 0), (5, 0), (5, 4), (4, 4)]  # leaves a passage 1 wide, and two rooms 4 wide


def rod(half: Any, thick: Any) -> list[tuple[Any, Any]]:
    return [(f"-{half}", f"-{thick}"), (half, f"-{thick}"), (half, thick), (f"-{half}", thick)]


def scene_with(robot: Any, **more: Any) -> cfree.Scene:
    return cfree.Scene(robot, [WALL], workspace=ROOM, **more)


@pytest.mark.parametrize("robot", [rod("1", "0.25"), rod("1", "0.6"), [(0, 0), ("1.2", 0), (0, "0.8")]])
def test_reached_positions_are_those_that_are_in_a_cell_of_a_start(robot: Any) -> None:
    scene = scene_with(robot)
    reached = cfree.reach(scene, [(2, 2, 0)], 24)
    space = cfree.free_space(cfree.boundary(scene))
    cell, rng = space.locate((2, 2, 0)), random.Random(0)
    for _ in range(400):
        x, y, k = rng.uniform(0, 9), rng.uniform(0, 5), rng.randrange(24)
        found = space.locate((x, y, f"{15 * k}deg"))
        assert shapely.Point(x, y).intersects(reached.reached[k]) == (found == cell)
        assert shapely.Point(x, y).intersects(reached.free[k]) == (found >= 0)


def test_a_passage_as_wide_as_the_robot_leads_nowhere_and_a_wider_one_does() -> None:
    exact, smaller = (cfree.reach(scene_with(rod("1", half)), [(2, 2, 0)], 8) for half in ("0.5", "0.49"))
    assert exact.some.bounds[2] < 4 and smaller.some.bounds[2] > 6


def test_starts_in_several_cells_add_up() -> None:
    scene = scene_with(rod("1", "0.6"))
    left, right, both = (cfree.reach(scene, starts, 8) for starts in ([(2, 2, 0)], [(7, 2, 0)], [(2, 2, 0), (7, 2, 0)]))
    assert both.some.area == pytest.approx(left.some.area + right.some.area)
    assert left.some.intersection(right.some).area == 0


@pytest.mark.slow
def test_an_image_has_the_middles_of_its_pixels() -> None:
    reached = cfree.reach(scene_with(rod("1", "0.6")), [(2, 2, 0)], 12)
    free = shapely.union_all(list(reached.free))
    for which in ("some", "every", "turning"):
        image, region = reached.image(0.13, which), getattr(reached, which)
        assert image.shape == (39, 70)
        for row, column in np.ndindex(*image.shape):
            middle = shapely.Point(0.13 * (column + 0.5), 0.13 * (image.shape[0] - row - 0.5))
            expected = 254 if region.intersects(middle) else 205 if free.intersects(middle) else 0
            assert image[row, column] == expected
    counts = reached.counts(0.13)
    assert ((counts > 0) == (reached.image(0.13) == 254)).all() and counts.max() <= 12


@pytest.mark.slow
def test_the_robot_turns_round_in_place_exactly_where_the_map_has_room() -> None:
    scene = scene_with(rod("1", "0.25"))
    reached, rng = cfree.reach(scene, [(2, 2, 0)], 4), random.Random(1)
    counts = [0, 0]
    for _ in range(60):
        x, y = rng.uniform(0, 9), rng.uniform(0, 5)
        intervals = cfree.turn_in_place(scene, (x, y, 0))
        turns = len(intervals) == 1 and intervals[0].start is None
        assert shapely.Point(x, y).intersects(reached.turning) == turns
        counts[turns] += 1
    assert min(counts) > 5


def test_a_differential_drive_turns_about_its_axle() -> None:
    about = cfree.reach(scene_with(rod("1", "0.25"), vehicle=cfree.DifferentialDrive(axle=("-0.5", 0))), [(2, 2, 0)], 4)
    x0, _, x1, _ = about.turning.bounds  # of the reference point, half ahead of the axle, at orientation 0
    assert x0 == pytest.approx(0.5 + math.hypot(1.5, 0.25), abs=1e-3) and x1 <= 9


@pytest.mark.parametrize("vehicle", [cfree.Car(5), cfree.DifferentialDrive()])
def test_a_vehicle_with_both_gears_reaches_what_the_robot_does(vehicle: Any) -> None:
    scene = scene_with(rod("1", "0.25"), vehicle=vehicle)
    assert (
        cfree.reach(scene, [(2, 2, 0)], 8).reached == cfree.reach(scene_with(rod("1", "0.25")), [(2, 2, 0)], 8).reached
    )
    path = cfree.plan(scene, (2, 2, 0), (7, 2, "90deg"), improve=0)
    assert isinstance(path, cfree.Path) and cfree.is_drivable(path, vehicle)


@pytest.mark.parametrize(
    ("options", "error", "said"),
    [
        ({}, cfree.InvalidPoseError, "no start: the scene has none"),
        ({"starts": [(4, 2, 0)]}, cfree.ForbiddenPoseError, r"starts\[0\]"),
        ({"starts": [(2, 2, 0)], "orientations": 0}, ValueError, "orientations: 0; give 1 to 3600"),
    ],
)
def test_faults_are_named_with_their_remedy(options: Any, error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        cfree.reach(scene_with(rod("1", "0.25")), **options)


def test_vehicles_for_which_cells_do_not_decide_are_refused() -> None:
    forward = scene_with(rod("1", "0.25"), vehicle=cfree.Car(1, gears="forward"))
    with pytest.raises(cfree.UnsupportedError, match="a car without reverse gear may not reach all of a cell"):
        cfree.reach(forward, [(2, 2, 0)])
    with pytest.raises(cfree.InvalidPoseError, match="touches an obstacle"):
        cfree.reach(scene_with(rod("1", "0.25"), vehicle=cfree.Car(1)), [(1, 2, 0)])


def test_a_scene_without_walls_around_has_a_map_beyond_its_obstacles() -> None:
    reached = cfree.reach(cfree.Scene(rod("1", "0.25"), [WALL]), [(0, 0, 0)], 4)
    x0, y0, x1, y1 = reached.extent
    assert x0 < 0 and y0 < -2 and x1 > 7 and y1 > 6 and reached.every.area > 0


def test_turning_circles_have_their_closed_forms() -> None:
    car = [(-1, -1), (3, -1), (3, 1), (-1, 1)]
    assert cfree.turning_circle(car) == pytest.approx(2 * math.hypot(3, 1), rel=1e-14)
    assert cfree.turning_circle(car, cfree.DifferentialDrive(axle=(1, 0))) == pytest.approx(
        2 * math.hypot(2, 1), rel=1e-14
    )
    assert cfree.turning_circle(car, cfree.Car(4)) == pytest.approx(2 * math.hypot(3, 5), rel=1e-14)
    assert cfree.turning_circle(car, cfree.Car((4, 3))) == pytest.approx(
        2 * math.hypot(3, 4), rel=1e-14
    )  # to the right
    scene = cfree.Scene(cfree.Curved.circle((0, 0), 2), vehicle=cfree.DifferentialDrive())
    assert cfree.turning_circle(scene) == pytest.approx(4, rel=1e-14)


def test_round_machines_turn_in_the_circle_of_their_arcs() -> None:
    disc = cfree.Curved.circle((3, 4), 1)
    bullet = cfree.Curved([(0, 0), (18, 0), Arc((18, 12), center=(18, 6)), (0, 12)])
    grown = cfree.Curved([(-1, 0), (3, 0), (3, 4)], grown="1/2")
    assert cfree.turning_circle(disc) == pytest.approx(12, rel=1e-14)
    assert cfree.turning_circle(bullet) == pytest.approx(2 * (math.hypot(18, 6) + 6), rel=1e-14)
    assert cfree.turning_circle(bullet, cfree.DifferentialDrive(axle=(30, 6))) == pytest.approx(
        2 * math.hypot(30, 6), rel=1e-14
    )  # away from the arc
    assert cfree.turning_circle(grown) == pytest.approx(11, rel=1e-14)


@pytest.mark.slow
def test_a_ros_map_is_read_again_and_geojson_has_the_regions(tmp_path: Path) -> None:
    reached = cfree.reach(scene_with(rod("1", "0.6")), [(2, 2, 0)], 8)
    cfree.save(reached, tmp_path / "reach.yaml", resolution=0.1)
    shapes = cfree.load_shapes(tmp_path / "reach.yaml")
    again = shapes.scene(robot=[(0, 0), ("0.001", 0), (0, "0.001")])
    assert cfree.is_free(again, (2, 2, 0)) and not cfree.is_free(again, (7, 2, 0))  # free, but not reached: unknown
    assert not cfree.is_free(again, ("4.5", 2, 0))
    cfree.save(reached, tmp_path / "reach.geojson")
    features = json.loads((tmp_path / "reach.geojson").read_text())["features"]
    assert len(features) == 8 + 3
    for feature, region in zip(features, reached.reached, strict=False):
        assert shapely.geometry.shape(feature["geometry"]).symmetric_difference(region).area < 1e-12
    with pytest.raises(cfree.UnsupportedError, match=r"no map format; name the file \.yaml or \.geojson"):
        cfree.save(reached, tmp_path / "reach.tif")
    with pytest.raises(ValueError, match=r"resolution: 1e-06 gives .* pixels"):
        cfree.save(reached, tmp_path / "reach.yaml", resolution=1e-6)
    with pytest.raises(ValueError, match="a Scene is no map of reach"):
        cfree.save(reached.scene, tmp_path / "scene.json", resolution=0.1)


def test_a_picture_has_the_share_of_orientations() -> None:
    ax = plot_reach(cfree.reach(scene_with(rod("1", "0.6")), [(2, 2, 0)], 8))
    assert ax.get_title() == "reached at a share of 8 orientations" and len(ax.get_images()) == 1
