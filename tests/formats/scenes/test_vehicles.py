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
    ("vehicle", "place", "said"),
    [
        ('"car"', "10 vehicle", 'expected a vehicle {"type": "car" or "differential", ...}, got "car"'),
        ("{}", "10 vehicle", 'key "type" is missing; add "car" or "differential"'),
        ('{"type": "car"}', "10 vehicle", 'key "turning_radius" is missing; add it'),
        ('{"type": "tank"}', "19 vehicle.type", 'expected "car" or "differential", got "tank"'),
        ('{"type": "forklift"}', "19 vehicle.type", 'a forklift is a "differential" about its fixed axle'),
        ('{"type": "car", "turning_radius": 0}', "44 vehicle.turning_radius", "0; give a length above 0"),
        ('{"type": "car", "turning_radius": -0.5}', "44 vehicle.turning_radius", "-1/2; give a length above 0"),
        ('{"type": "car", "turning_radius": [2, -1]}', "44 vehicle.turning_radius", "-1 to the right; give a length"),
        ('{"type": "car", "turning_radius": NaN}', "44 vehicle.turning_radius", "NaN is not finite; give a finite"),
        ('{"type": "car", "turning_radius": "inf"}', "44 vehicle.turning_radius", "Infinity is not finite; give a f"),
        ('{"type": "car", "turning_radius": null}', "44 vehicle.turning_radius", 'a number or "p/q", got null'),
        ('{"type": "car", "turning_radius": [1, 2, 3]}', "44 vehicle.turning_radius", "two as [left, right], got [1"),
        ('{"type": "car", "turning_radius": [1, "x"]}', "48 vehicle.turning_radius[1]", 'a number or "p/q", got "x"'),
        ('{"type": "car", "turning_radius": 1e200}', "44 vehicle.turning_radius", "a length beyond 1e150; scale"),
        ('{"type": "differential", "axle": [1]}', "43 vehicle.axle", "expected [x, y], got [1]"),
        ('{"type": "differential", "axle": [0, "a"]}', "47 vehicle.axle[1]", 'expected a number or "p/q", got "a"'),
        ('{"type": "differential", "axle": [-1e200, 0]}', "43 vehicle.axle", "a length beyond 1e150; scale"),
        ('{"type": "differential", "axel": [1, 0]}', "43 vehicle.axel", 'unknown key "axel"; did you mean "axle"?'),
        (
            '{"type": "differential", "gears": "both"}',
            "44 vehicle.gears",
            'unknown key "gears"; the keys here are type',
        ),
        ('{"type": "differential", "heading": "30deg"}', "46 vehicle.heading", "30deg; the tangent of its half is not"),
        (
            '{"type": "differential", "heading": "x"}',
            "46 vehicle.heading",
            'expected radians, "90deg" or {"tau": "p/q"}',
        ),
        ('{"type": "car", "turning_radius": 4, "wheelbase": 0}', "60 vehicle.wheelbase", "0; give a length above 0"),
        ('{"type": "car", "turning_radius": 4, "gears": "back"}', "56 vehicle.gears", '\'back\'; give "both" or "forw'),
    ],
)
def test_faults_of_vehicles_have_their_place_and_remedy(vehicle: str, place: str, said: str, tmp_path: Path) -> None:
    file = tmp_path / "scene.json"
    file.write_text(f'{{"robot": [[0, 0], [1, 0], [0, 1]],\n"vehicle":{vehicle}}}')
    with pytest.raises(FormatError) as caught:
        load(file)
    (line,) = str(caught.value).splitlines()
    column, path = place.split()
    assert line.startswith(f"{file}:2:{int(column) + 1} {path}: ") and said in line
