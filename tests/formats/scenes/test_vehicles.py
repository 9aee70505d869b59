"""Vehicles in files of scenes: written exactly, read again, and faults with their place."""

import json
from pathlib import Path
from typing import Any

import pytest

from cfree import Car, DifferentialDrive, FormatError, Scene, load, load_shapes, save

SHAPES: dict[str, Any] = {"robot": [[0, 0], [1, 0], [0, 1]]}
VEHICLES = [
    Car(4), Car("4.1", axle=("-1.3", "1/3")), Car((4, "9/2"), heading="90deg", gears="forward"),
    Car(1, heading={"tau": "2/7"}), Car(1, heading="180deg"), DifferentialDrive(),
    DifferentialDrive(("1/7", 2), "-90deg"),
]  # fmt: skip


@pytest.mark.parametrize("vehicle", VEHICLES, ids=repr)
@pytest.mark.parametrize("suffix", ["json", "geojson", "svg", "dxf"])
def test_a_scene_is_saved_with_its_vehicle(vehicle: Any, suffix: str, tmp_path: Path) -> None:
    scene = Scene([(0, 0), (1, 0), (0, 1)], vehicle=vehicle)
    save(scene, tmp_path / f"scene.{suffix}")
    read = load(tmp_path / f"scene.{suffix}")
    assert isinstance(read, Scene) and read.vehicle == vehicle


def test_a_vehicle_is_scaled_and_moved_with_its_robot(tmp_path: Path) -> None:
    for vehicle, scaled, moved in [
        (Car((4, 5), (1, 2), "90deg", "forward"), Car((2, "5/2"), ("1/2", 1), "90deg", "forward"),
         Car((4, 5), (-2, 2), "90deg", "forward")),
        (DifferentialDrive((1, 2)), DifferentialDrive(("1/2", 1)), DifferentialDrive((-2, 2))),
    ]:  # fmt: skip
        save(Scene([(0, 0), (1, 0), (0, 1)], vehicle=vehicle), tmp_path / "scene.json")
        assert load_shapes(tmp_path / "scene.json", scale="1/2").scene().vehicle == scaled
        assert load_shapes(tmp_path / "scene.json").scene(pivot=(3, 0)).vehicle == moved


def load_with(vehicle: Any, tmp_path: Path) -> Scene:
    file = tmp_path / "scene.json"
    file.write_text(json.dumps(SHAPES | {"vehicle": vehicle}))
    scene = load(file)
    assert isinstance(scene, Scene)
    return scene


def test_numbers_and_angles_are_read_like_all_others(tmp_path: Path) -> None:
    vehicle = {"type": "car", "turning_radius": [4, "9/2"], "axle": [-1.3, "1/3"], "heading": "90deg"}
    assert load_with(vehicle, tmp_path).vehicle == Car((4, "9/2"), axle=("-1.3", "1/3"), heading="90deg")
    assert load_with(None, tmp_path).vehicle is None


@pytest.mark.parametrize(
    ("vehicle", "said"),
    [
        ({"type": "tank"}, 'expected a vehicle {"type": "car" or "differential", ...}'),
        ("car", "expected a vehicle"),
        ({"type": "car"}, '"turning_radius" of the vehicle is missing'),
        ({"type": "car", "turning_radius": 0}, "give a length above 0"),
        ({"type": "car", "turning_radius": "x"}, 'expected a number or "p/q"'),
        ({"type": "car", "turning_radius": [1, 2, 3]}, "turning_radius of the vehicle: expected two numbers"),
        ({"type": "car", "turning_radius": 4, "axle": [1]}, "axle of the vehicle: expected two numbers"),
        ({"type": "car", "turning_radius": 4, "axel": [1, 0]}, 'unknown key "axel" of a vehicle; did you mean "axle"?'),
        ({"type": "differential", "turning_radius": 4}, 'unknown key "turning_radius" of a vehicle'),
        ({"type": "car", "turning_radius": 4, "heading": "30deg"}, "the tangent of its half is not rational"),
        ({"type": "car", "turning_radius": 4, "gears": "reverse"}, "gears"),
    ],
)
def test_faults_of_vehicles_have_their_place_and_remedy(vehicle: Any, said: str, tmp_path: Path) -> None:
    with pytest.raises(FormatError) as caught:
        load_with(vehicle, tmp_path)
    assert "vehicle" in str(caught.value) and said in str(caught.value)
    assert str(caught.value).startswith(f"{tmp_path / 'scene.json'}:1:")
