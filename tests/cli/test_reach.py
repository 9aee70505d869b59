"""The commands about fleets and buildings: what they print, write and refuse."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from cfree.cli.app import app

BED = "[[1, 0.45], [-1, 0.45], [-1, -0.45], [1, -0.45]]"
FLAT = "examples/scenes/flat.json"
CLINIC = "examples/plans/clinic.svg"


def run(*words: Any) -> Result:
    return CliRunner(env={"COLUMNS": "140"}).invoke(app, [*map(str, words)])


def test_aisles_are_printed_for_all_kinds_that_need_no_width() -> None:
    result = run("aisle", BED)
    assert result.exit_code == 0
    lines = [line.split()[0] for line in result.stdout.splitlines()]
    assert lines == ["smallest", "straight", "turn", "corner", "junction", "turning"]
    widths = json.loads(run("aisle", BED, "--kind", "bay", "--opening", "1.2", "--json").stdout)["widths"]
    assert 1.2 < widths["bay"]["lo"] < widths["bay"]["hi"] < 2


def test_a_heading_turns_the_machine_with_a_vehicle_and_without() -> None:
    plain, drive = (
        json.loads(run("aisle", BED, "--kind", "straight", "--heading", "90deg", "--json", *more).stdout)
        for more in ([], ["--vehicle", "differential"])
    )
    assert plain["widths"]["straight"]["hi"] == pytest.approx(0.9)  # as narrow as it can
    assert drive["widths"]["straight"]["hi"] == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["aisle", BED, "--kind", "bay"], 'opening: missing; kind "bay" needs the width of the opening'),
        (["aisle", BED, "--kind", "bay", "--opening", "x"], "--opening: 'x'; give a length above 0"),
        (["aisle", BED, "--kind", "bay", "--opening", "1e200"], "--opening: '1e200' is beyond 1e150"),
        (["aisle", "missing.json"], "missing.json: No such file"),
        (["aisle", BED, "--turning-radius", "3"], "--turning-radius: of a vehicle; give --vehicle"),
        (["reach", FLAT, "--start", "1,1"], "--start: '1,1': 2 numbers; give X,Y,THETA"),
        (["reach", FLAT, "-o", "reach.tif"], "reach.tif: no map format; name the file .yaml or .geojson"),
        (["reach", FLAT, "--resolution", "0.1"], "--resolution: only for a ROS map; give -o FILE.yaml; leave it out"),
        (["reach", FLAT, "-o", "a.yaml", "--picture", "a.png"], "--picture: a.png is the image of the map"),
        (["reach", FLAT, "--vehicle", "car", "--turning-radius", "3", "--gears", "forward"], "vehicle: a car without"),
        (["audit", FLAT, "--place", "1,2"], "--place: '1,2'; write it like \"kitchen=1,2\""),
        (["audit", FLAT, "--place", "a=1,2", "--place", "a=2,2"], "--place: the name 'a' is there twice; give NAME="),
        (
            ["audit", FLAT, "--machine", BED, "--machine", BED],
            "--machine: the name 'machine' is there twice; give NAME=",
        ),
        (["audit", FLAT, "--opening", "d=1,2"], "--opening: d=1,2; give 4 numbers after the name"),
        (["audit", FLAT, "-o", "doors.pdf"], "doors.pdf: no audit format; name the file .csv or .geojson"),
        (["audit", FLAT, "--robot", BED, "--machine", BED], "--robot: and --machine; give one of them"),
    ],
)
def test_faults_are_one_line_with_a_remedy(words: list[str], said: str, tmp_path: Path, monkeypatch: Any) -> None:
    (tmp_path / "examples").symlink_to(Path("examples").resolve())
    monkeypatch.chdir(tmp_path)
    result = run(*words)
    assert result.exit_code == 2 and result.stdout == ""
    assert result.stderr.splitlines()[-1].startswith(f"error: {said}")
    assert {file.name for file in tmp_path.iterdir()} == {"examples"}


def test_reach_writes_a_map_and_a_picture(tmp_path: Path) -> None:
    files = ["-o", tmp_path / "reach.yaml", "--resolution", "0.1", "--picture", tmp_path / "picture.png"]
    result = run("reach", FLAT, "--orientations", "12", *files)
    assert result.exit_code == 0 and "reached at some" in result.stdout
    assert {file.name for file in tmp_path.iterdir()} == {"reach.yaml", "reach.png", "picture.png"}
    assert "resolution: 0.1\n" in (tmp_path / "reach.yaml").read_text()
    facts = json.loads(run("reach", FLAT, "--orientations", "12", "--json").stdout)
    assert facts["areas"]["some"] > facts["areas"]["every"] > facts["areas"]["turning"] > 0


@pytest.mark.slow
def test_audit_ends_with_1_where_a_door_is_not_passed_and_its_proofs_are_verified(tmp_path: Path) -> None:
    machines = [word for name in ("bed", "wheelchair") for word in ("--machine", f"examples/plans/{name}.geojson")]
    files = ["-o", tmp_path / "doors.csv", "--proofs", tmp_path / "proofs", "--picture", tmp_path / "doors.png"]
    result = run("audit", CLINIC, *machines, "--no-missing", *files)
    assert result.exit_code == 1 and "proved impassable  4" in result.stdout
    assert len((tmp_path / "doors.csv").read_text().splitlines()) == 1 + 2 * 6
    proofs = sorted((tmp_path / "proofs").glob("bed-door-*.json"))
    assert len(proofs) >= 4
    for proof in proofs[:2]:
        assert run("verify", tmp_path / "proofs" / "bed-scene.json", proof).exit_code == 0
    assert run("audit", CLINIC, "--machine", "examples/plans/wheelchair.geojson").exit_code == 0


def test_a_machine_is_named_by_its_file_or_by_its_name(tmp_path: Path) -> None:
    shutil.copy("examples/plans/bed.geojson", tmp_path / "a=b.geojson")
    for word, name in (
        ("examples/plans/bed.geojson", "bed"),
        ("lit=examples/plans/bed.geojson", "lit"),
        (tmp_path / "a=b.geojson", "a=b"),
        (BED, "machine"),
        (f"big bed={BED}", "big bed"),
    ):
        opening = ["--opening", "D=2.3,-4.1,3.25,-4.1", "--no-missing", "--json"]
        facts = json.loads(run("audit", CLINIC, "--machine", word, *opening).stdout)
        assert [door["machine"] for door in facts["doors"]] == [name]


def test_machines_are_taken_in_the_unit_of_the_plan(tmp_path: Path) -> None:
    room, wall = [[0, 0], [4000, 0], [4000, 3000], [0, 3000]], [[2000, 0], [2100, 0], [2100, 1900], [2000, 1900]]
    square = {"outer": [[0, 0], [1, 0], [1, 1], [0, 1]]}
    plan = {"version": 1, "units": "mm", "workspace": {"outer": room}, "obstacles": [{"outer": wall}], "robot": square}
    (tmp_path / "plan.json").write_text(json.dumps(plan))
    machines = []
    for units, radius in (("m", 0.6), ("cm", 45), ("mm", 600)):
        disc = {"version": 1, "units": units, "robot": {"circle": {"center": [0, 0], "radius": radius}}}
        (tmp_path / f"{units}.json").write_text(json.dumps(disc))
        machines += ["--machine", tmp_path / f"{units}.json"]
    words = ["--opening", "D=2050,1900,2050,3000", "--no-missing"]
    result = run("audit", tmp_path / "plan.json", *machines, *words, "--json")
    assert [door["result"] for door in json.loads(result.stdout)["doors"]] == ["blocked", "passes", "blocked"]
    assert "robot in m, converted to mm" in result.stderr
    assert "1.1998 m is too narrow, 1.2002 m will do" in run("aisle", tmp_path / "m.json", "--kind", "straight").stdout
    drawing = '<svg xmlns="http://www.w3.org/2000/svg"><rect id="wall" width="9" height="9"/></svg>'
    (tmp_path / "plan.svg").write_text(drawing)
    assert "there is no machine; give --machine" in run("audit", tmp_path / "plan.svg").stderr
