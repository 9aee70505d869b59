"""`cfree plan --vehicle`: options, report, exit codes."""

from __future__ import annotations

import csv
import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
import yaml
from click.testing import CliRunner, Result

from cfree import Car, DifferentialDrive, Unreachable, load
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


def test_answers_of_vehicles_have_pictures_and_a_proof_of_existence_as_well(tmp_path: Path) -> None:
    picture = tmp_path / "drawn.svg"
    for radius, changes, code, words in (
        ("1", {}, 0, ("ahead", "a path for a car with a turning radius of 1")),
        ("4", {"obstacles": HELD, "start": [0, 0, 0], "goal": [0, 3, 0]}, 1, ("stuck: no motion leaves its start",)),
        ("1e12", {}, 3, ("undecided: a path exists",)),
    ):
        options = "--vehicle", "car", "--turning-radius", radius, "--improve", "0", "--picture", str(picture)
        result = run(tmp_path, *options, **changes)
        assert result.exit_code == code, result.output
        text = " ".join(picture.read_text().split())
        assert all(word in text for word in words)
        assert "picture" in result.output
        picture.unlink()


CAR = ["--vehicle", "car", "--turning-radius", "2", "--axle", "0,1/2", "--improve", "0"]
LIMITS = ["--speed", "0.5", "--acceleration", "0.2", "--steer-rate", "20deg", "--wheelbase", "1.5"]


def test_times_and_stops_are_reported_and_written(tmp_path: Path) -> None:
    result = run(tmp_path, *CAR, *LIMITS, "-o", str(tmp_path / "way.csv"), "--step", "0.1", "--json")
    facts, table = json.loads(result.stdout), list(csv.DictReader((tmp_path / "way.csv").read_text().splitlines()))
    drive, stops = facts["drive"], facts["drive"]["stops"]
    assert facts["driving"]["stops"] == len(stops) > facts["driving"]["cusps"]
    assert float(table[-1]["t"]) == drive["duration"]
    assert drive["standing"] == pytest.approx(sum(stop["pause"] for stop in stops))
    assert sum(a["t"] != b["t"] and a["x"] == b["x"] and a["y"] == b["y"] for a, b in pairwise(table)) == sum(
        stop["pause"] > 0 for stop in stops
    )
    said = " ".join(run(tmp_path, *CAR, *LIMITS, "-o", str(tmp_path / "way.csv")).stdout.split())
    assert f" stops {len(stops)} " in said and f"drive time {drive['duration']:.6g} s, " in said
    assert "s of it standing" in said


def test_the_error_of_driving_through_jumps_of_curvature_is_reported(tmp_path: Path) -> None:
    command = [*CAR, *LIMITS, "--stops", "cusps", "-o", str(tmp_path / "way.csv")]
    drive = json.loads(run(tmp_path, *command, "--json", "--speed", "0.01").stdout)["drive"]
    assert len(drive["through"]) > 0 and drive["room"] < drive["proved clearance"]
    said = " ".join(run(tmp_path, *command, "--speed", "0.01").stdout.split())
    assert "jumps of curvature; until the wheels have turned it is off by at most" in said
    assert "at up to 0.01 a second each jump stays clear of obstacles" in said
    tight = json.loads(run(tmp_path, *command, "--json", "--steer-rate", "1.2", "--speed", "1").stdout)["drive"]
    assert tight["room"] > tight["proved clearance"]
    said = " ".join(run(tmp_path, *command, "--steer-rate", "1.2", "--speed", "1").stdout.split())
    assert "lower --speed, leave out --stops, or give --clearance" in said
    said = " ".join(run(tmp_path, *CAR, "--speed", "1", *command[-4:]).stdout.split())
    assert "jumps of curvature; give --steer-rate and --wheelbase for the error of this" in said


def test_ros_files_by_gear_are_listed(tmp_path: Path) -> None:
    output = tmp_path / "way.yaml"
    result = run(tmp_path, *CAR, *LIMITS, "-o", str(output), "--per-gear")
    files = sorted(tmp_path.glob("way-*.yaml"))
    assert files and not output.exists() and all(str(file) in result.stdout for file in files)
    assert all(len(yaml.safe_load(file.read_text())["poses"]) > 1 for file in files)
    assert files[0].name == "way-1-forward.yaml"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ("--acceleration 1", "--acceleration: only with a speed; give --speed as well"),
        ("--stops cusps --wheelbase 1", "--wheelbase, --stops: only with a speed; give --speed as well"),
        ("--speed 1 --acceleration 0", "--acceleration: '0'; give an acceleration above 0"),
        ("--speed 1 --acceleration nan", "--acceleration: 'nan'; give an acceleration above 0"),
        ("--speed 1 --steer-rate -5deg --wheelbase 1", "--steer-rate: '-5deg'; give an angle a second above 0"),
        ("--speed 1 --steer-rate 1e999 --wheelbase 1", "--steer-rate: '1e999'; give an angle a second above 0"),
        ("--speed 1 --steer-rate 1", "--steer-rate: the wheelbase is missing; give it as well"),
        ("--speed 1 --wheelbase 0", "--wheelbase: '0'; give a length above 0"),
        ("--speed 1 --stops few", '--stops: \'few\'; give "all" or "cusps"'),
        ("--per-gear", "--per-gear: only for ROS messages; give -o with .yaml"),
        ("--format ros -o - --per-gear", "--per-gear: it writes several files; give -o with the name of a .yaml"),
        ("--vehicle any --speed 1 --steer-rate 1", "--steer-rate: of a vehicle's path only; give a vehicle"),
        ("--vehicle any --speed 1 --wheelbase 1", "--wheelbase: of a vehicle's path only; give a vehicle"),
        ("--vehicle any -o {folder}/w.yaml --per-gear", "--per-gear: of a vehicle's path only; give --vehicle"),
        ("--vehicle differential --speed 1 --wheelbase 1", "--wheelbase: a differential drive has one if its wheel"),
    ],
)
def test_limits_that_do_not_fit_end_with_2_and_one_line(options: str, said: str, tmp_path: Path) -> None:
    words = options.format(folder=tmp_path).split()
    sampled = [] if "-o" in words or words == ["--per-gear"] else ["-o", str(tmp_path / "way.csv")]
    result = run(tmp_path, *([] if "--vehicle" in words else CAR), *words, *sampled)
    assert (result.exit_code, result.stdout) == (2, ""), result.output
    assert result.stderr.startswith(f"error: {said}") and result.stderr.count("\n") == 1


@pytest.mark.parametrize("vehicle", ["car --turning-radius 1 --axle 1e9,0", "differential --axle 0,1e9"])
def test_an_axle_far_away_ends_with_3_and_is_named(vehicle: str, tmp_path: Path) -> None:
    result = run(tmp_path, *f"--vehicle {vehicle} --improve 0".split())
    assert (result.exit_code, result.stdout) == (3, "")
    assert result.stderr.endswith("manoeuvres: its axle point is 1e+09 away from the robot, correct it\n")


@pytest.mark.parametrize(
    "changes",
    [
        {"robot": [{"outer": [[0, 0], [1, 0], [1, 1], [0, 1]]}, {"outer": [[-3, 0], [-2, 0], [-2, 1], [-3, 1]]}]},
        {"bounds": [-2, -1, 4, 4]},
        {"robot": {"circle": {"center": [0, 0], "radius": "1/2"}}, "start": [-2, 0, 0], "goal": [4, 0, 0]},
    ],
    ids=["several parts", "bounds that cut the axle line", "round shapes"],
)
@pytest.mark.slow
def test_unusual_scenes_are_answered_and_the_answer_is_verified(changes: dict[str, Any], tmp_path: Path) -> None:
    answer = tmp_path / "way.json"
    result = run(tmp_path, *f"--vehicle car --turning-radius 1 --axle 0,-2 --improve 0 -o {answer}".split(), **changes)
    assert result.exit_code == 0, result.output
    verified = CliRunner().invoke(app, ["verify", str(tmp_path / "scene.json"), str(answer)])
    assert verified.exit_code == 0 and " drivable " in verified.stdout, verified.output


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ("--vehicle car", "--vehicle car: no turning radius; give --turning-radius"),
        ("--turning-radius 4", "--turning-radius: of a vehicle; give --vehicle"),
        ("--axle 1,2 --gears forward", "--axle, --gears: of a vehicle; give --vehicle"),
        ("--vehicle forklift --turning-radius 4", "--turning-radius: not of --vehicle forklift; leave it out"),
        ("--vehicle any --axle 1,2", "--axle: not of --vehicle any; leave it out"),
        ("--vehicle car --turning-radius 0", "--turning-radius: 0; give a length above 0"),
        ("--vehicle car --turning-radius -1", "--turning-radius: -1; give a length above 0"),
        ("--vehicle car --turning-radius 1,0", "--turning-radius: 0 to the right; give a length above 0"),
        ("--vehicle car --turning-radius nan", "--turning-radius: NaN is not finite; give a finite number"),
        ("--vehicle car --turning-radius 4m", "--turning-radius: '4m' is no number; write it like '0.1'"),
        ("--vehicle car --turning-radius 1e200", "--turning-radius: a length beyond 1e150; scale the scene"),
        ("--vehicle car --turning-radius 1,2,3", "--turning-radius: '1,2,3'; give a length, or two, to the left"),
        ("--vehicle car --turning-radius 4 --axle 1", "--axle: '1'; give two numbers such as 1.5,0"),
        ("--vehicle differential --axle nan,0", "--axle: NaN is not finite; give a finite number"),
        (
            "--vehicle car --turning-radius 4 --heading 30deg",
            "--heading: 30deg; the tangent of its half is not rational: give a multiple of 90deg, or tau:209/780, w",
        ),
        ("--vehicle differential --heading 90", "--heading: 90 is more than a whole turn in radians; write 90deg"),
        ("--vehicle car --turning-radius 4 --gears back", '--gears: \'back\'; give "both" or "forward"'),
        ("--vehicle bus", "--vehicle: 'bus'; give"),
        (
            "--vehicle car --turning-radius 4 --prefer cusp=-1",
            "--prefer: 'cusp=-1': cusp=-1.0: give a length of 0 or more",
        ),
        (
            "--vehicle car --turning-radius 4 --prefer stop=nan",
            "--prefer: 'stop=nan': stop=nan: give a length of 0 or more",
        ),
    ],
)
def test_bad_options_end_with_2_and_one_line(options: str, said: str, tmp_path: Path) -> None:
    result = run(tmp_path, *options.split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith(f"error: {said}") and result.stderr.count("\n") == 1


@pytest.mark.slow
def test_a_goal_that_a_car_without_reverse_gear_does_not_reach_ends_with_1(tmp_path: Path) -> None:
    answer, room = tmp_path / "boxes.json", [[-3, -2], [9, -2], [9, 2], [-3, 2]]
    alley: dict[str, Any] = {"obstacles": [], "bounds": None, "workspace": room}
    alley |= {"start": [0, 0, 0], "goal": [0, 0, "180deg"]}
    options = "--vehicle car --turning-radius 3 --gears forward --improve 0"
    result = run(tmp_path, *options.split(), "-o", str(answer), **alley)
    assert result.exit_code == 1, result.output
    text = " ".join(result.stdout.split())
    assert "unreachable, proved: no path of a car with a turning radius of 3 and no reverse gear leads from" in text
    assert "hold what it reaches" in text and "size of a box" in text
    assert isinstance(load(answer), Unreachable)
    facts = json.loads(run(tmp_path, *options.split(), "--json", **alley).stdout)
    assert facts["answer"] == "unreachable" and facts["boxes"] > 0 and facts["side"] > 0
    checked = CliRunner().invoke(app, ["verify", str(tmp_path / "scene.json"), str(answer)])
    assert checked.exit_code == 0 and "closed boxes PROVED" in " ".join(checked.stdout.split())
    picture = tmp_path / "boxes.png"
    assert run(tmp_path, *options.split(), "--picture", str(picture), **alley).exit_code == 1 and picture.exists()
