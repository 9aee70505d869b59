"""The commands `cfree cage` and `cfree disassemble`, and the pages that show them."""

from __future__ import annotations

import doctest
import json
import re
import shlex
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

import cfree
from cfree.cli.app import app

ROOT = Path(__file__).parents[2]
HAND, FRAME, PUZZLE = (f"examples/cages/{name}" for name in ("hand.json", "frame.geojson", "puzzle.geojson"))
TIME = re.compile(r"\(\d+\.\d s\)")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(*words: str) -> Result:
    return CliRunner(env={"COLUMNS": "140"}).invoke(app, [*words])


def test_a_cage_is_proved_and_its_answer_verified() -> None:
    result = run("cage", HAND, "-o", "cage.json", "--json")
    assert result.exit_code == 0 and json.loads(result.stdout)["holding"] == [0, 1]
    assert cfree.verify.answer(cfree.load_scene(HAND), "cage.json").verified


def test_an_escape_has_exit_code_1_and_a_path_that_is_verified() -> None:
    Path("one.json").write_text(json.dumps({**json.loads(Path(HAND).read_text()), "obstacles": []}))
    result = run("cage", "one.json", "--finger", "2,1", "-o", "way.json", "--save-scene", "one.scene.json")
    assert result.exit_code == 1 and "not caged" in result.stdout
    assert cfree.verify.answer(cfree.load_scene("one.scene.json"), "way.json").verified


def test_points_on_the_command_line_need_their_triangles_for_verify() -> None:
    result = run("cage", HAND, "--finger", "2,-1", "-o", "cage.json")
    assert result.exit_code == 2 and "give --save-scene FILE as well" in result.stderr
    result = run("cage", HAND, "--finger", "2,-1", "-o", "cage.json", "--save-scene", "hand.json")
    assert result.exit_code == 0 and cfree.verify.answer(cfree.load_scene("hand.json"), "cage.json").verified


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["cage", HAND, "--finger", "2"], "error: --finger: '2'; give X,Y for a point, or X,Y,R for a disc"),
        (["cage", HAND, "--finger", "2,x"], "error: --finger: '2,x': 'x' is no number"),
        (["cage", HAND, "--finger", "2,1,-1"], 'error: --finger: \'-1\'; give a radius above 0 such as "0.3" or "1/3"'),
        (["cage", HAND, "--finger", "2,2.5"], "error: pose: finger 2 at (2, 2.5) is inside the body"),
        (["cage", HAND, "--precision", "0.1"], "error: --precision: only for the intervals of --critical"),
        (["cage", HAND, "--immobility", "--fewest"], "error: --fewest: not with --immobility"),
        (["cage", HAND, "--ignore-bounds"], "error: --ignore-bounds: only for a scene with bounds or workspace"),
        (
            ["cage", "examples/scenes/parking_bay.json"],
            "error: the scene has a workspace, out of which nothing escapes",
        ),
        (["cage", "none.json"], "error: none.json"),
        (
            ["disassemble", FRAME, "--fixed", "fram"],
            "fixed: 'fram' is the name of no part; did you mean 'frame'?",
        ),
        (["disassemble", FRAME, "--part", "x"], "error: part: 'x' is the name of no part"),
        (
            ["disassemble", PUZZLE, "--fixed", "housing", "--fixed", "key"],
            "error: --fixed: all of the 2 parts, so that there is none to take out; leave one of them out",
        ),
        (
            ["disassemble", FRAME, "--fixed", "frame", "--part", "frame"],
            "error: --part: 'frame' is fixed, and is not taken out; leave out --fixed for it",
        ),
        (
            ["cage", HAND, "--finger", "1e300,0"],
            "error: --finger: '1e300,0' is beyond 1e150, the largest coordinate; give",
        ),
        (
            ["cage", HAND, "--finger", "1,0,1e200"],
            "error: --finger: '1e200' is beyond 1e150, the largest coordinate; give",
        ),
        (
            ["cage", HAND, "--start", "1e300,0,0"],
            "error: --start: '1e300,0,0' is beyond 1e150, the largest coordinate; give",
        ),
        (["disassemble", FRAME, "--gap"], "error: --gap: only for one part; give --part as well"),
        (["disassemble", FRAME, "-o", FRAME], "this is a file; give the name of a folder"),
        (["disassemble", "examples/scenes/parking_bay.json"], "out of which nothing can leave"),
    ],
)
def test_faults_end_with_exit_code_2_in_one_line(words: list[str], text: str) -> None:
    result = run(*words)
    last = result.stderr.strip().splitlines()[-1]
    assert result.exit_code == 2 and text in last and last.startswith("error: ") and "Traceback" not in result.stderr


def test_answer_and_scene_in_one_file_are_refused_before_either_is_written() -> None:
    result = run("cage", HAND, "-o", "cage.json", "--save-scene", "./cage.json")
    assert result.exit_code == 2 and "this would be the answer and the scene in one file" in result.stderr
    assert not Path("cage.json").exists()


@pytest.mark.slow
def test_fingers_have_the_names_of_the_scene_in_answers_scenes_and_numbers() -> None:
    words = ["cage", HAND, "--finger", "9,9", "--finger", "2,-1"]
    result = run(*words, "--critical", "spread", "--save-scene", "named.json")
    assert "lower, upper" in result.stdout and re.search(r"between lower and\s+upper", result.stdout)
    assert cfree.load_scene("named.json").obstacle_names == ("lower", "upper", "finger 2", "finger 3")
    result = run("cage", HAND, "--finger", "2,0.5", "--fewest", "--save-scene", "fewest.json")
    chosen = cfree.load_scene("fewest.json").obstacle_names
    assert re.search(rf"fingers +{', '.join(chosen)}\n", result.stdout) and len(chosen) == 2
    assert json.loads(run(*words, "--json").stdout)["names"] == ["lower", "upper", "finger 2", "finger 3"]
    assert run("cage", HAND, "--immobility").stdout.count("mobile: no finger touches it") == 1


def test_names_that_are_there_twice_or_look_like_numbers_are_numbers() -> None:
    scene = json.loads(Path(HAND).read_text())
    lower, upper = scene["obstacles"]
    for one, other in (("tip", "tip"), ("finger 1", "finger 0")):
        scene["obstacles"] = [lower | {"name": one}, upper | {"name": other}]
        Path("twice.json").write_text(json.dumps(scene))
        assert "finger 0, finger 1" in run("cage", "twice.json").stdout


def test_undecided_cages_end_with_exit_code_3() -> None:
    part = {"version": 1, "robot": {"outer": [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]]}}
    Path("bracket.json").write_text(json.dumps(part))
    result = run("cage", "bracket.json", "--finger=1.2,1.2", "--finger=-0.2,1", "--finger=1,-0.2")
    assert result.exit_code == 3 and "undecided" in result.stderr


def test_bounds_are_left_out_on_demand_only() -> None:
    scene = json.loads(Path(HAND).read_text()) | {"bounds": [-9, -9, 9, 9]}
    Path("bounded.json").write_text(json.dumps(scene))
    assert run("cage", "bounded.json").exit_code == 2
    assert run("cage", "bounded.json", "--ignore-bounds").exit_code == 0


@pytest.mark.slow
def test_numbers_of_the_cage_are_printed_for_machines() -> None:
    facts = json.loads(run("cage", HAND, "--critical", "spread", "--json").stdout)
    spread = facts["critical"]["spread"]
    assert facts["caged"] and 1 < spread["caged"] < spread["escapes"] < 1.3 and spread["puncture"]["fingers"] == [0, 1]


@pytest.mark.slow
def test_immobility_is_decided_and_drawn() -> None:
    part = {"version": 1, "robot": {"outer": [[0, 0], [12, 0], [0, 5]]}}
    Path("triangle.json").write_text(json.dumps(part))
    fingers = ["--finger", "2,0", "--finger", "0,2", "--finger", "36/13,50/13"]
    result = run("cage", "triangle.json", *fingers, "--immobility", "--picture", "held.svg")
    assert result.exit_code == 0 and "immobile to order 2: 3 contacts" in result.stdout and Path("held.svg").exists()
    assert run("cage", "triangle.json", *fingers[:4], "--immobility").exit_code == 1


@pytest.mark.slow
def test_steps_of_taking_apart_are_written_drawn_and_verified() -> None:
    result = run("disassemble", FRAME, "--fixed", "frame", "-o", "steps", "--picture", "steps.png")
    assert result.exit_code == 0 and Path("steps.png").exists()
    answers = sorted(Path("steps").glob("*.answer.json"))
    assert answers[0].name == "1-wedge.answer.json" and len(answers) == 3
    for file in answers:
        scene = cfree.load_scene(str(file).replace("answer", "scene"))
        assert cfree.verify.answer(scene, file).verified


def test_a_part_that_is_held_has_exit_code_1_and_its_blockers() -> None:
    result = run("disassemble", FRAME, "--part", "left block", "--json")
    rows = json.loads(result.stdout)
    assert result.exit_code == 1 and rows["held by"] == ["frame", "wedge"] == rows["without"]
    assert run("disassemble", PUZZLE, "--part", "key").exit_code == 0


def test_the_robot_of_a_scene_is_a_part_at_its_start() -> None:
    result = run("disassemble", HAND, "--json")
    assert result.exit_code == 0 and {*json.loads(result.stdout)["order"]} == {"hand", "lower", "upper"}


@pytest.mark.parametrize("command", ["cage", "disassemble"])
def test_help_has_examples_of_options_that_exist(command: str) -> None:
    text = run(command, "--help").stdout
    lines = [line.strip() for line in text.split("Examples:")[1].splitlines() if line.strip().startswith("cfree")]
    assert len(lines) >= 4
    known = {name for parameter in app.commands[command].params for name in parameter.opts}
    for line in lines:
        used = [word.split("=")[0] for word in shlex.split(line) if word.startswith("-") and f" {command} " in line]
        assert {*used} <= known | {"--help"}, line


@pytest.mark.slow
@pytest.mark.parametrize("page", ["caging", "disassembly"])
def test_the_page_runs_and_its_commands_print_the_lines_that_are_shown(page: str) -> None:
    text = (ROOT / "docs" / f"{page}.md").read_text()
    assert doctest.testfile(str(ROOT / "docs" / f"{page}.md"), module_relative=False).failed == 0
    blocks = "\n".join(re.findall(r"^```console\n(.*?)^```$", text, re.S | re.M))
    printed: list[str] = []
    for line in blocks.splitlines():
        if line.startswith("$ cfree "):
            result = run(*shlex.split(line.removeprefix("$ cfree ")))
            assert result.exit_code in (0, 1), result.output
            printed = [TIME.sub("", other) for other in (result.stdout + result.stderr).splitlines()]
        else:
            assert not line or TIME.sub("", line) in printed, (line, printed)
    assert "Who should use something else" in text
