"""Sampled poses of vehicles: gear, curvature and axle point in CSV and GeoJSON, the axle's poses in ROS messages."""

import csv
import json
import math
from fractions import Fraction
from itertools import pairwise
from pathlib import Path as FilePath
from typing import Any

import pytest
import yaml

from cfree import Car, DifferentialDrive, Path, Pose, Rotation, Scene, Translation, UnsupportedError, load, save, timed
from cfree.paths import Driven

CAR = Car(2, axle=("1/2", 0), heading="180deg")
MOTIONS = [Translation((-2, 0)), Rotation(("-3/2", -3), "90deg"), Rotation(("-3/2", -3), "-30deg")]
PATH = Path(Pose(0, 0), MOTIONS, vehicle=CAR, scene=Scene([(0, 0), (1, 0), (0, 1)]))


def rows(path: Path, tmp_path: FilePath, **options: Any) -> list[dict[str, str]]:
    save(path, tmp_path / "way.csv", **options)
    with open(tmp_path / "way.csv") as file:
        return list(csv.DictReader(file))


def test_rows_have_gear_curvature_and_axle_point(tmp_path: FilePath) -> None:
    table = rows(PATH, tmp_path, step=1.0, speed=1.0)
    columns = ["x", "y", "theta", "t", "gear", "curvature", "axle_x", "axle_y", "speed", "turn_rate"]
    assert list(table[0]) == columns and list(rows(PATH, tmp_path)[0]) == [*columns[:3], *columns[4:8]]
    gears = [int(row["gear"]) for row in table]
    assert gears == sorted(gears, reverse=True) and set(gears) == {1, -1}
    assert {float(row["curvature"]) for row in table} == {0.0, 1 / 3}
    for row in table:
        x, y, theta = (float(row[name]) for name in ("x", "y", "theta"))
        assert float(row["axle_x"]) == pytest.approx(x + math.cos(theta) / 2)
        assert float(row["axle_y"]) == pytest.approx(y + math.sin(theta) / 2)


def test_a_turn_in_place_has_no_gear_and_infinite_curvature(tmp_path: FilePath) -> None:
    path = Path(Pose(0, 0), [Rotation((0, 0), "90deg")], vehicle=DifferentialDrive(), scene=PATH.scene)
    assert {(row["gear"], row["curvature"]) for row in rows(path, tmp_path)} == {("0", "inf")}


def test_paths_without_a_vehicle_have_their_columns_as_before(tmp_path: FilePath) -> None:
    assert list(rows(Path(Pose(0, 0), MOTIONS, scene=PATH.scene), tmp_path)[0]) == ["x", "y", "theta"]


def test_geojson_has_gear_curvature_and_axle(tmp_path: FilePath) -> None:
    save(PATH, tmp_path / "way.geojson", step=3.0)
    *_, goal = json.loads((tmp_path / "way.geojson").read_text())["features"]
    assert goal["properties"]["gear"] == -1 and goal["properties"]["curvature"] == 1 / 3
    axle = PATH.goal @ CAR.frame
    assert goal["properties"]["axle"] == pytest.approx([float(axle.x), float(axle.y)])


def test_a_ros_message_has_the_poses_of_the_axle(tmp_path: FilePath) -> None:
    save(PATH, tmp_path / "way.yaml", step=3.0)
    first = yaml.safe_load((tmp_path / "way.yaml").read_text())["poses"][0]["pose"]
    assert (first["position"]["x"], first["position"]["y"]) == (0.5, 0.0)
    assert abs(first["orientation"]["z"]) == pytest.approx(1)  # it points back


@pytest.mark.parametrize("radius", ["3", "49", "-3", "1/49", "-7/3", "10/3"])
def test_a_curvature_is_never_more_than_that_of_the_radius(radius: str) -> None:
    exact = Fraction(radius)
    value = Driven("forward", exact, 1.0, 1.0, 0, 0).curvature
    assert abs(Fraction(value)) <= abs(1 / exact) and value == pytest.approx(float(1 / exact))


LIMITS: dict[str, Any] = {"speed": 0.7, "acceleration": 0.3, "steer_rate": 0.4, "wheelbase": 2}


def test_a_file_has_the_times_of_a_steer_rate_in_degrees(tmp_path: FilePath) -> None:
    degrees = {**LIMITS, "steer_rate": "45deg"}
    assert rows(PATH, tmp_path, **degrees) == rows(PATH, tmp_path, **LIMITS | {"steer_rate": math.radians(45)})


def test_a_pause_has_two_rows_with_speed_0_and_the_second_has_the_next_gear_and_curvature(tmp_path: FilePath) -> None:
    table = rows(PATH, tmp_path, step=0.5, **LIMITS)
    stops = timed(PATH, **LIMITS).stops
    pairs = [(a, b) for a, b in pairwise(table) if [a[name] for name in ("x", "y")] == [b[name] for name in ("x", "y")]]
    assert [stop.pause > 0 for stop in stops] == [True, False]  # the cusp is on one arc
    [(stands, goes_on)] = pairs
    assert float(stands["t"]) == stops[0].time
    assert float(goes_on["t"]) - float(stands["t"]) == pytest.approx(math.atan(2 / 3) / 0.4)
    assert float(stands["speed"]) == float(goes_on["speed"]) == float(goes_on["turn_rate"]) == 0
    assert (stands["curvature"], float(goes_on["curvature"])) == ("0.0", 1 / 3)
    assert float(table[0]["speed"]) == float(table[-1]["speed"]) == 0
    for row in table:
        assert float(row["turn_rate"]) == pytest.approx(
            int(row["gear"]) * float(row["speed"]) * float(row["curvature"]), abs=1e-12
        )


def test_a_turn_in_place_has_a_rate_and_no_speed(tmp_path: FilePath) -> None:
    path = Path(Pose(0, 0), [Rotation((0, 0), "-90deg")], vehicle=DifferentialDrive(), scene=PATH.scene)
    table = rows(path, tmp_path, speed=2, acceleration=100)
    assert {float(row["speed"]) for row in table} == {0.0}
    assert min(float(row["turn_rate"]) for row in table) == pytest.approx(-2)  # its farthest point is 1 away


def test_geojson_and_ros_have_the_times_of_csv(tmp_path: FilePath) -> None:
    times = [float(row["t"]) for row in rows(PATH, tmp_path, step=0.5, **LIMITS)]
    save(PATH, tmp_path / "way.geojson", step=0.5, **LIMITS)
    _, *outlines = json.loads((tmp_path / "way.geojson").read_text())["features"]
    assert [outline["properties"]["t"] for outline in outlines] == times == sorted(times)
    assert {outline["properties"]["role"] for outline in outlines[1:-1]} == {"pose"}
    speeds = [outline["properties"]["speed"] for outline in outlines]
    assert speeds[0] == speeds[-1] == 0 and max(speeds) <= 0.7
    save(PATH, tmp_path / "way.yaml", step=0.5, **LIMITS)
    assert stamps(tmp_path / "way.yaml") == pytest.approx(times, abs=1e-9)


def stamps(file: FilePath) -> list[float]:
    found = [pose["header"]["stamp"] for pose in yaml.safe_load(file.read_text())["poses"]]
    return [stamp["sec"] + stamp["nanosec"] / 1e9 for stamp in found]


def test_each_run_in_one_gear_is_a_ros_message_that_begins_where_the_gear_changes(tmp_path: FilePath) -> None:
    turn = Rotation((0, 0), "90deg")
    motions = [turn, Translation((0, 2)), Translation((0, -1)), Rotation((0, 1), "30deg")]
    path = Path(Pose(0, 0), motions, vehicle=DifferentialDrive(), scene=PATH.scene)
    for limits in ({}, LIMITS):
        save(path, tmp_path / "way.yaml", step=0.5, per_gear=True, **limits)
        files = sorted(tmp_path.glob("*.yaml"))
        names = ["way-1-turning.yaml", "way-2-forward.yaml", "way-3-backward.yaml", "way-4-turning.yaml"]
        assert [file.name for file in files] == names
        messages = [yaml.safe_load(file.read_text()) for file in files]
        for one, other in pairwise(messages):
            assert one["poses"][-1]["pose"] == other["poses"][0]["pose"]
            assert one["header"]["frame_id"] == "world" and len(other["poses"]) > 1
        times = [stamps(file) for file in files]
        assert all(its == sorted(its) for its in times)
        if limits:
            gaps = [other[0] - one[-1] for one, other in pairwise(times)]
            assert gaps == pytest.approx([stop.pause for stop in timed(path, **LIMITS).stops], abs=1e-8)
            assert gaps[0] == pytest.approx(math.pi / 2 / 0.4) and gaps[1] == 0


def test_runs_are_numbered_in_the_order_of_their_names(tmp_path: FilePath) -> None:
    motions = [Translation((1 - 2 * (k % 2), 0)) for k in range(11)]
    save(Path(Pose(0, 0), motions, vehicle=Car(2), scene=PATH.scene), tmp_path / "way.yaml", per_gear=True)
    names = sorted(file.name for file in tmp_path.glob("*.yaml"))
    assert names[0] == "way-01-forward.yaml" and names[-1] == "way-11-forward.yaml" and len(names) == 11


def test_options_that_do_not_fit_a_path_are_refused(tmp_path: FilePath) -> None:
    plain = Path(Pose(0, 0), MOTIONS, scene=PATH.scene)
    for path, name, options, said in (
        (plain, "way.yaml", {"per_gear": True}, "per_gear: of a vehicle's path only"),
        (PATH, "way.csv", {"per_gear": True}, "per_gear: only for ROS messages"),
        (PATH, "way.csv", {"acceleration": 1.0}, "acceleration: only with a speed"),
        (PATH, "way.csv", {"stops": "cusps"}, "stops: only with a speed"),
        (plain, "way.csv", {"speed": 1.0, "steer_rate": 1.0}, "steer_rate: of a vehicle's path only"),
        (PATH, "way.csv", {"speed": 1.0, "steer_rate": 1.0}, "steer_rate: the wheelbase is missing"),
        (PATH.scene, "way.svg", {"per_gear": True}, "per_gear: a Scene is no path"),
        (PATH.scene, "way.svg", {"stops": "cusps"}, "stops: a Scene is no path"),
    ):
        with pytest.raises(ValueError, match=said):
            save(path, tmp_path / name, **options)  # type: ignore[arg-type]
    with pytest.raises(UnsupportedError, match=r"stamps of ROS end at 2\^31"):
        save(PATH, tmp_path / "way.yaml", speed=1e-9)
    assert not [*tmp_path.iterdir()]


def test_the_wheelbase_of_a_car_is_used_saved_and_loaded(tmp_path: FilePath) -> None:
    car = Car.with_wheelbase("2.7", "35deg")
    scene = Scene(robot=[(0, 0), (1, 0), (0, 1)], vehicle=car)
    save(scene, tmp_path / "scene.json")
    again = load(tmp_path / "scene.json")
    assert isinstance(again, Scene) and again.vehicle is not None and again.vehicle.wheelbase == Fraction(27, 10)
    path = Path(Pose(0, 0), [Translation((1, 0)), Rotation((1, 4), "10deg")], vehicle=car, scene=scene)
    save(path, tmp_path / "way.json")
    loaded = load(tmp_path / "way.json")
    assert isinstance(loaded, Path) and loaded.vehicle is not None and loaded.vehicle.wheelbase == Fraction(27, 10)
    pause = timed(loaded, scene, speed=1, steer_rate=1).stops[0].pause
    assert pause == pytest.approx(math.atan(2.7 / 4))
    assert repr(Car(4, wheelbase="2.7")) == "Car(4, axle=(0, 0), wheelbase=27/10)"
    with pytest.raises(ValueError, match="wheelbase: 0; give a length above 0"):
        Car(4, wheelbase=0)
