"""`cfree plan --vehicle`: options, report, exit codes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from cfree import Car, DifferentialDrive, load
from cfree import Path as Motions
from cfree.cli.app import app

SCENE: dict[str, Any] = {
    "robot": [[0, 0], [1, 0], [1, 1], [0, 1]], "obstacles": [[[2, -9], [3, -9], [3, 1], [2, 1]]],
    "bounds": [-5, -5, 5, 5], "start": [-2, 0, 0], "goal": [4, 0, 0],
}  # fmt: skip
HELD = [[[1, 0], [2, 0], [2, 1], [1, 1]], [[-1, 0], [0, 0], [0, 1], [-1, 1]]]


def run(folder: Path, *arguments: str, **changes: Any) -> Result:
    file = folder / "scene.json"
    file.write_text(json.dumps(SCENE | changes))
    return CliRunner().invoke(app, ["plan", str(file), *arguments])


def test_the_options_make_the_vehicle_and_the_report_tells_how_it_drives(tmp_path: Path) -> None:
    answer = tmp_path / "way.json"
    options = "--vehicle car --turning-radius 2,1.5 --axle 0.5,-1/3 --heading 90deg --prefer backward=3,cusp=2"
    result = run(tmp_path, *options.split(), "--improve", "0", "-o", str(answer))
    assert result.exit_code == 0, result.output
    path = load(answer)
    assert isinstance(path, Motions) and path.vehicle == Car((2, "1.5"), axle=("0.5", "-1/3"), heading="90deg")
    for row in ("changes of direction", "backward", "least radius", "shortest motion"):
        assert f"\n {row} " in result.stdout
    assert "which a car with turning radii of 2 and 1.5 can drive" in " ".join(result.stdout.split())


def test_a_forklift_is_a_differential_drive_about_its_fixed_axle(tmp_path: Path) -> None:
    answer = tmp_path / "way.json"
    result = run(tmp_path, "--vehicle", "forklift", "--axle", "1/2,1/2", "--improve", "0", "-o", str(answer))
    path = load(answer)
    assert result.exit_code == 0 and isinstance(path, Motions) and path.vehicle == DifferentialDrive(("1/2", "1/2"))
    assert "turned in place" in result.stdout


def test_numbers_for_machines(tmp_path: Path) -> None:
    result = run(tmp_path, "--vehicle", "differential", "--improve", "0", "--json")
    facts = json.loads(result.stdout)["driving"]
    assert facts["vehicle"] == "differential" and facts["travel"] > 6 and facts["cusps"] >= 0


def test_the_vehicle_of_the_scene_drives_unless_any_is_asked(tmp_path: Path) -> None:
    vehicle = {"type": "car", "turning_radius": 1}
    assert "can drive" in " ".join(run(tmp_path, "--improve", "0", vehicle=vehicle).stdout.split())
    assert "can drive" not in " ".join(run(tmp_path, "--vehicle", "any", vehicle=vehicle).stdout.split())


def test_a_vehicle_that_is_stuck_ends_with_1(tmp_path: Path) -> None:
    ends = {"start": [0, 0, 0], "goal": [0, 3, 0], "obstacles": HELD}
    answer = tmp_path / "stuck.json"
    result = run(tmp_path, "--vehicle", "car", "--turning-radius", "4", "-o", str(answer), **ends)
    assert result.exit_code == 1
    assert " answer                stuck, proved: no path of finite length" in result.stdout
    assert CliRunner().invoke(app, ["verify", str(tmp_path / "scene.json"), str(answer)]).exit_code == 0
    facts = json.loads(run(tmp_path, "--vehicle", "car", "--turning-radius", "4", "--json", **ends).stdout)
    assert (facts["answer"], facts["at"], facts["of"], facts["obstacles"]) == ("stuck", "start", "paths", [0, 1])


def test_too_many_manoeuvres_end_with_3(tmp_path: Path) -> None:
    result = run(tmp_path, "--vehicle", "car", "--turning-radius", "1e12", "--improve", "0")
    assert (result.exit_code, result.stdout) == (3, "")
    assert result.stderr.startswith("error: a path of a car with a turning radius of 1e+12 exists, as start and goal")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ("--vehicle car", "--vehicle car: no turning radius; give --turning-radius"),
        ("--turning-radius 4", "--turning-radius: of a vehicle; give --vehicle"),
        ("--axle 1,2 --gears forward", "--axle, --gears: of a vehicle; give --vehicle"),
        ("--vehicle forklift --turning-radius 4", "--turning-radius: not of --vehicle forklift; leave it out"),
        ("--vehicle any --axle 1,2", "--axle: not of --vehicle any; leave it out"),
        ("--vehicle car --turning-radius 0", "turning_radius 0: give a length above 0"),
        ("--vehicle car --turning-radius nan", "turning_radius: NaN is not finite; give a finite number"),
        ("--vehicle car --turning-radius 1,2,3", "--turning-radius: '1,2,3'; give two numbers such as 1.5,0"),
        ("--vehicle car --turning-radius 4 --axle 1", "--axle: '1'; give two numbers such as 1.5,0"),
        ("--vehicle car --turning-radius 4 --heading 30deg", "heading 30deg: the tangent of its half is not rational"),
        (
            "--vehicle car --turning-radius 4 --prefer cusp=-1",
            "--prefer: 'cusp=-1': cusp=-1.0: give a length of 0 or more",
        ),
    ],
)
def test_bad_options_end_with_2_and_one_line(options: str, said: str, tmp_path: Path) -> None:
    result = run(tmp_path, *options.split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith(f"error: {said}") and result.stderr.count("\n") == 1
