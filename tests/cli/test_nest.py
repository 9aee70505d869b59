"""The command `cfree nest`: files in and out, exit codes, faults in one line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from cfree.cli.app import app

ROOT = Path(__file__).parents[2]
PARTS, ITEMS = ROOT / "examples/drawings/parts.svg", ROOT / "examples/drawings/nest.json"


def run(*words: object) -> Result:
    return CliRunner(env={"COLUMNS": "140"}).invoke(app, ["nest", *map(str, words)])


@pytest.fixture(scope="module")
def layout(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("nest") / "layout.svg"
    assert run(PARTS, "-o", file).exit_code == 0
    return file


def test_parts_of_a_drawing_are_placed_on_its_sheet(layout: Path, tmp_path: Path) -> None:
    result = run(PARTS, "--json", "--picture", tmp_path / "a.png")
    facts = json.loads(result.stdout)
    assert (facts["parts"], facts["sheets"], facts["left"], facts["overlaps"]) == (5, 1, {}, [])
    assert facts["placed"][0] == {"part": "frame", "sheet": 0, "x": "0", "y": "-90", "theta": 0}
    assert (tmp_path / "a.png").stat().st_size > 5000
    assert run(layout, "--check").exit_code == 0


def test_overlaps_are_exit_code_1_and_listed() -> None:
    result = run(PARTS, "--check", "--json")
    assert result.exit_code == 1
    assert json.loads(result.stdout)["overlaps"][0]["vector"] == ["-130", "30"]


def test_a_layout_is_compacted(layout: Path, tmp_path: Path) -> None:
    result = run(layout, "--compact", "left", "-o", tmp_path / "a.dxf")
    assert result.exit_code == 0 and "all proved free" in result.stdout


def test_a_strip_is_cut_off_at_its_last_part(tmp_path: Path) -> None:
    facts = json.loads(run(ITEMS, "--json").stdout)
    assert facts["box"][2] < 20 and facts["density"] > 0.5
    facts = json.loads(run(ITEMS, "--strip", "12", "--json").stdout)
    assert facts["sheets"] == 1 and not facts["left"]


def test_sheets_of_a_size_and_of_a_file(tmp_path: Path) -> None:
    facts = json.loads(run(PARTS, "--sheet", "75x75", "--sheets", 4, "--gap", "1/2", "--kerf", "0.2", "--json").stdout)
    assert facts["sheets"] > 1 and not facts["left"]
    facts = json.loads(run(ITEMS, "--sheet", PARTS, "--rotations", "0deg,90deg", "--json").stdout)
    assert facts["sheets"] == 1 and not facts["left"]


def test_copies_are_placed_and_the_rest_is_left() -> None:
    facts = json.loads(run(PARTS, "--copies", 3, "--json").stdout)
    assert facts["parts"] + sum(facts["left"].values()) == 15 and facts["left"]


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (["--sheet", "10xten"], "--sheet: '10xten' is no size and no file; give a size as in \"1000x500\""),
        (["--sheet", "0x10"], "--sheet: 0x10: its width is 0; give a width and a height above 0"),
        (["--sheet", "5x-10"], "--sheet: 5x-10: its height is -10; give a width and a height above 0"),
        (["--sheet", "1e300x5"], "--sheet: 1e300x5 is beyond 1e150, the largest coordinate; give a smaller number"),
        (["--sheet", "1x2x3"], "--sheet: '1x2x3' is no size and no file"),
        (["--strip", "1e160"], "--strip: 1e160 is beyond 1e150, the largest coordinate; give a smaller number"),
        (["--gap", "1e300"], "--gap: 1e300 is beyond 1e150, the largest coordinate; give a smaller number"),
        (["--rotations", ""], "or give any, or a number of steps of a full turn"),
        (["--rotations", "-1"], "rotations: -1; give 1 to 360 steps of a full turn"),
        (["--sheet", "10x10", "--strip", "5"], "--sheet and --strip: give one of them"),
        (["--gap", "-1"], "--gap: -1; give a length, 0 or more"),
        (["--kerf", "wide"], "--kerf: 'wide' is no length; give a number as in \"2.5\""),
        (["--strip", "0"], "--strip: 0; give a length above 0"),
        (["--rotations", "0"], "rotations: 0; give 1 to 360 steps of a full turn"),
        (["--rotations", "north"], 'or give any, or a number of steps of a full turn, as in "4"'),
        (["--check", "--gap", "1"], "--gap: only to place parts; leave it out"),
        (["--check", "--compact", "left"], "--check and --compact: give one of them"),
        (["--compact", "north"], '--compact: \'north\'; give "left", "right", "down" or "up"'),
        (["--robot", "[[0, 0], [1, 0], [0, 1]]"], "--robot: nesting has no robot; leave it out"),
        (["--sheets", "2"], "--sheets: only with --sheet; leave it out"),
        (["-o", "a.step"], "a.step: no layout format; name the file .svg, .dxf or .geojson"),
    ],
)
def test_faults_are_one_line_and_exit_code_2(words: list[str], fault: str) -> None:
    result = run(PARTS, *words)
    assert result.exit_code == 2 and fault in result.stderr and "Traceback" not in result.output
    assert len([line for line in result.stderr.splitlines() if line.startswith("error")]) == 1


def test_nothing_placed_is_exit_code_1(tmp_path: Path) -> None:
    result = run(PARTS, "--sheet", "1x1", "-o", tmp_path / "a.svg")
    assert result.exit_code == 1 and " 0 placed\n" in result.stdout
    assert "error: no part has a place on a sheet; give a larger sheet" in result.stderr
    result = run(PARTS, "--sheet", "1x1", "--json")
    assert result.exit_code == 1 and json.loads(result.stdout)["left"]["frame"] == 1
    assert run(PARTS, "--sheet", "60x60").exit_code == 0  # some have a place
    assert "no part has a place" in " ".join(run("--help").stdout.split())


def test_parts_that_are_too_many_or_too_large_are_named(tmp_path: Path) -> None:
    triangle = {"type": "simple_polygon", "data": [[0, 0], [1, 0], [0, 1], [0, 0]]}
    file = tmp_path / "many.json"
    item = {"id": 0, "demand": 10**7, "allowed_orientations": [0.0], "shape": triangle}
    file.write_text(json.dumps({"name": "many", "items": [item], "strip_height": 5}))
    result = run(file)
    assert result.exit_code == 2 and "parts: 10,000,000 with all copies; give 1,000,000 at most" in result.stderr
    result = run(PARTS, "--copies", 10**9)
    assert result.exit_code == 2 and "1000000000 is not in the range 1<=x<=100000" in result.stderr
    large = {"type": "Polygon", "coordinates": [[[0, 0], [1e200, 0], [1, 1], [0, 0]]]}
    shape = {"type": "Feature", "properties": {"name": "a"}, "geometry": large}
    file = tmp_path / "large.geojson"
    file.write_text(json.dumps({"type": "FeatureCollection", "features": [shape]}))
    result = run(file, "--sheet", "9x9")
    assert result.exit_code == 2 and "error: part a: a coordinate is larger than 1e150; scale it" in result.stderr
    drawing = tmp_path / "empty.svg"
    drawing.write_text('<svg xmlns="http://www.w3.org/2000/svg"/>')
    assert "no part: the file has no closed shape; draw one" in run(drawing, "--sheet", "9x9").stderr


def test_options_of_drawings_are_refused_for_instances() -> None:
    result = run(ITEMS, "--scale", "2")
    assert result.exit_code == 2
    assert "--scale: only for drawings, and this file is read as nesting JSON" in result.stderr


def test_a_drawing_without_a_sheet_names_the_ways_to_give_one(tmp_path: Path) -> None:
    file = tmp_path / "a.svg"
    file.write_text('<svg xmlns="http://www.w3.org/2000/svg"><rect width="5" height="4"/></svg>')
    assert 'no sheet: give --sheet 1000x500, --strip 500, or a layer named "sheet"' in run(file).stderr
    file.write_text('<svg xmlns="http://www.w3.org/2000/svg"><rect id="sheet" width="5" height="4"/></svg>')
    assert "no part: the file has only sheets" in run(file).stderr
