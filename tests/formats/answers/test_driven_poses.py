"""Sampled poses of vehicles: gear, curvature and axle point in CSV and GeoJSON, the axle's poses in ROS messages."""

import csv
import json
import math
from fractions import Fraction
from pathlib import Path as FilePath

import pytest
import yaml

from cfree import Car, DifferentialDrive, Path, Pose, Rotation, Scene, Translation, save
from cfree.paths import Driven

CAR = Car(2, axle=("1/2", 0), heading="180deg")
MOTIONS = [Translation((-2, 0)), Rotation(("-3/2", -3), "90deg"), Rotation(("-3/2", -3), "-30deg")]
PATH = Path(Pose(0, 0), MOTIONS, vehicle=CAR, scene=Scene([(0, 0), (1, 0), (0, 1)]))


def rows(path: Path, tmp_path: FilePath, **options: float) -> list[dict[str, str]]:
    save(path, tmp_path / "way.csv", **options)  # type: ignore[arg-type]
    with open(tmp_path / "way.csv") as file:
        return list(csv.DictReader(file))


def test_rows_have_gear_curvature_and_axle_point(tmp_path: FilePath) -> None:
    table = rows(PATH, tmp_path, step=1.0, speed=1.0)
    assert list(table[0]) == ["x", "y", "theta", "t", "gear", "curvature", "axle_x", "axle_y"]
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
