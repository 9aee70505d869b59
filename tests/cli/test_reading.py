"""The record of reading on the screen: lines on standard error, the last line of a result, `--strict`, pictures."""

import json
import shlex
from dataclasses import replace
from pathlib import Path
from typing import Any

import click
import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

import cfree
from cfree.cli.app import app
from cfree.cli.reading import MOST_LINES
from cfree.formats.drawings.source import Source, shapes_of
from cfree.formats.shapes import Shape
from cfree.scene.reading import Item, Note

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
WALL = [(4, -3), (5, -3), (5, 8), (4, 8)]
LOST = Note("lost", "open line", "less", 39, "A-WALL", (6.0, 4.0), 2.0, (Item("5F", (6, 4), 2.0, ((6, 4), (8, 4))),))
GUESS = Note("guess", "outline closed only by a join", "more", 2, "desk")
WARNING = Note("warning", "cell of grey 205", "less", 17269, remedy="--free-thresh 0.196")
INFO = Note("info", "a user unit is 2 mm")
FIRST = "LOST      39 open lines of A-WALL (the largest 2 at 6, 4)"


def run(*arguments: object) -> Any:
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def scene(*notes: Note, wall: bool = False) -> cfree.Scene:
    ends = {"start": (1, 1, 0), "goal": (7, 1, 0)}
    obstacles = [WALL] if wall else [[(4, 3), (5, 3), (5, 5), (4, 5)]]
    return cfree.Scene(SQUARE, obstacles, bounds=(-1, -1, 9, 5), reading=notes, **ends)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    cfree.save(scene(INFO, LOST, WARNING), tmp_path / "a.json")
    cfree.save(scene(INFO, LOST, wall=True), tmp_path / "closed.json")
    cfree.save(scene(INFO, LOST, GUESS, wall=True), tmp_path / "guessed.json")
    cfree.save(scene(), tmp_path / "plain.json")
    cfree.save(cfree.plan(cfree.load_scene(tmp_path / "a.json"), improve=0), tmp_path / "path.json")
    cfree.save(cfree.boundary(cfree.load_scene(tmp_path / "a.json")), tmp_path / "a.npz")
    return tmp_path


COMMANDS = (
    "plan a.json",
    "plan a.npz",
    "view a.json --no-browser --html page.html",
    "slice a.json --theta 0",
    "slice a.npz --theta 0",
    "boundary a.json",
    "boundary a.json --folder shards",
    "check a.json",
    "convert a.json b.json",
    "convert a.json b.svg",
    "verify a.json path.json",
    "verify a.json a.npz --sample 1 --slices 0",
)
FILM = "film a.json path.json -o a.gif --size 160x90 --fps 2"


def words(command: str, folder: Path) -> list[str]:
    return [str(folder / word) if "." in word or word == "shards" else word for word in command.split()]


@pytest.mark.parametrize("command", [*COMMANDS, pytest.param(FILM, marks=pytest.mark.slow)])
def test_every_command_that_reads_prints_the_record_to_standard_error(command: str, folder: Path) -> None:
    result = run(*words(command, folder))
    assert result.exit_code == 0, result.output
    lines = [line for line in result.stderr.splitlines() if line[:4] in ("LOST", "warn", "info")]
    assert lines[:3] == [
        FIRST,
        "warning   17,269 cells of grey 205: --free-thresh 0.196",
        "info      a user unit is 2 mm",
    ]
    assert FIRST not in result.stdout


@pytest.mark.parametrize("command", [command for command in COMMANDS if "view" not in command])
def test_results_end_with_the_worst_note(command: str, folder: Path) -> None:
    last = run(*words(command, folder)).stdout.splitlines()[-1]
    worst = "39 open lines of A-WALL"
    if "verify" in command:
        assert last.startswith(f"PROVED for the scene in this file, which was read with losses: {worst}")
    else:
        assert last.endswith(f"in the scene as read: {worst} are not in it")


@pytest.mark.parametrize("command", [command for command in COMMANDS if "view" not in command])
def test_json_has_the_whole_record(command: str, folder: Path) -> None:
    facts = json.loads(run(*words(command, folder), "--json").stdout)
    assert [(note["kind"], note["count"]) for note in facts["reading"]][:3] == [
        ("lost", 39), ("warning", 17269), ("info", 1),
    ]  # fmt: skip
    assert facts["reading"][0]["items"] == [{"handle": "5F", "at": [6.0, 4.0], "size": 2.0}]


@pytest.mark.parametrize("command", [*COMMANDS, "plan {strict} a.json", FILM])
@pytest.mark.parametrize("option", ["--strict", "--strict=lost"])
def test_strict_makes_losses_errors_and_lists_all(command: str, option: str, folder: Path) -> None:
    before = sorted(folder.iterdir())
    placed = command.replace("{strict}", option)
    result = run(*words(placed, folder), *([] if option in placed else [option]))
    assert (result.exit_code, result.stdout) == (2, ""), result.output
    assert FIRST in result.stderr
    assert ("17,269 cells" in result.stderr) == (option == "--strict")
    assert result.stderr.splitlines()[-1].startswith("error: ") and "user unit" not in result.stderr
    assert sorted(folder.iterdir()) == before


def test_strict_takes_a_file_without_losses(folder: Path) -> None:
    cfree.save(scene(INFO, WARNING), folder / "warned.json")
    assert run("plan", folder / "plain.json", "--strict").exit_code == 0
    assert run("plan", folder / "warned.json", "--strict=lost").exit_code == 0
    assert run("plan", folder / "warned.json", "--strict").exit_code == 2
    assert "does not take a value" in run("plan", folder / "plain.json", "--strict=all").stderr


def test_strict_lists_more_losses_than_a_screen_has_lines(folder: Path) -> None:
    cfree.save(scene(*(replace(LOST, where=f"layer{k}") for k in range(20))), folder / "many.json")
    result = run("plan", folder / "many.json", "--strict")
    assert sum(line.startswith("LOST") for line in result.stderr.splitlines()) == 20


def test_more_lines_than_eight_are_counted_and_check_prints_them(folder: Path) -> None:
    file = folder / "many.json"
    cfree.save(scene(*(replace(LOST, where=f"layer{k}") for k in range(MOST_LINES + 5))), file)
    lines = run("slice", file, "--theta", "0").stderr.splitlines()
    assert len(lines) == MOST_LINES + 1 and lines[-1] == f"and 5 more: cfree check {file}"
    assert len(run("check", file).stderr.splitlines()) == MOST_LINES + 5
    robot = "[[0.3, 0], [0, 0.3], [0, 0]]"
    named = run("slice", file, "--theta", "0", "--robot", robot, "--pivot", "0,0").stderr.splitlines()[-1]
    command = shlex.split(named.partition(": ")[2])
    assert command == ["cfree", "check", str(file), "--robot", robot, "--pivot", "0,0"]
    assert run(*command[1:]).exit_code == 0


@pytest.mark.slow
def test_the_lines_of_several_scenes_are_below_their_names(folder: Path) -> None:
    files = [folder / "a.json", folder / "plain.json", folder / "closed.json"]
    small = "--size", "160x90", "--fps", "4", "--storyboard", "turntable"
    result = run("film", *files, "-o", folder / "a.gif", *small)
    assert result.exit_code == 0, result.stderr
    assert [line for line in result.stderr.splitlines() if line == FIRST or line.endswith(":")] == [
        FIRST, f"{files[2]}:", FIRST,
    ]  # fmt: skip


def test_a_scene_without_a_record_is_read_in_silence(folder: Path) -> None:
    result = run("plan", folder / "plain.json")
    assert result.stderr == "" and "as read" not in result.stdout


def test_the_claim_that_a_note_harms_is_told(folder: Path) -> None:
    free = run("plan", folder / "a.json").stdout.splitlines()[-1]
    assert free == "a path, each motion proved free, in the scene as read: 39 open lines of A-WALL are not in it"
    closed = run("plan", folder / "closed.json")
    assert closed.exit_code == 1
    assert closed.stdout.splitlines()[-1] == "no path at all, proved; what was left out could only forbid more"
    guessed = run("plan", folder / "guessed.json").stdout.splitlines()[-1]
    assert guessed == (
        "no path at all, proved, in the scene as read: "
        "more may be forbidden than drawn (2 outlines of desk closed only by a join)"
    )


def test_answers_keep_the_record_and_verify_repeats_it_for_a_scene_without(folder: Path) -> None:
    answer = json.loads((folder / "path.json").read_text())
    assert [note["what"] for note in answer["scene"]["reading"]] == [
        "open line",
        "cell of grey 205",
        "a user unit is 2 mm",
    ]
    result = run("verify", folder / "plain.json", folder / "path.json")
    assert result.exit_code == 0
    assert "read with losses: 39 open lines of A-WALL" in result.stdout.splitlines()[-1]


def test_a_plan_in_a_folder_repeats_the_record(folder: Path) -> None:
    run("boundary", folder / "plain.json", "--obstacles", folder / "a.json", "--folder", folder / "shards")
    result = run("plan", folder / "shards")
    assert FIRST in result.stderr and result.stdout.splitlines()[-1].endswith("are not in it")
    assert run("verify", folder / "shards", "--strict").exit_code == 2


def test_the_robots_file_is_reported_like_the_scenes(folder: Path) -> None:
    cfree.save(scene(replace(LOST, file="robot.dxf")), folder / "robot.json")
    cfree.save(scene(replace(INFO, file="plan.svg")), folder / "scene.json")
    result = run("check", folder / "scene.json", "--robot", folder / "robot.json")
    assert result.stderr.splitlines() == [
        FIRST.replace("39", "robot.dxf: 39"), "info      plan.svg: a user unit is 2 mm",
    ]  # fmt: skip
    assert run("convert", folder / "scene.json", folder / "b.json", "--robot", folder / "robot.json").exit_code == 0
    reading = cfree.load_scene(folder / "b.json").reading
    assert [note.file for note in reading] == ["robot.dxf", "plan.svg"]
    assert reading[0].items == (Item("5F", None, 2.0),), "places in the robot's frame are none in the scene's"


def test_a_file_in_which_nothing_is_drawn_is_reported(tmp_path: Path) -> None:
    (tmp_path / "empty.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>')
    for command in ("check", "plan"):
        result = run(command, tmp_path / "empty.svg")
        assert result.exit_code == 2
        assert "nothing is drawn in empty.svg" in result.stderr and "there is no robot" in result.stderr


def test_a_file_without_any_obstacle_is_reported(tmp_path: Path) -> None:
    file = tmp_path / "robot.geojson"
    ring = [[0, 0], [1, 0], [0, 1], [0, 0]]
    feature = {
        "type": "Feature",
        "properties": {"role": "robot"},
        "geometry": {"type": "Polygon", "coordinates": [ring]},
    }
    file.write_text(json.dumps(feature))
    assert "nothing forbids a pose: no obstacle and no workspace" in run("check", file).stderr


def test_losses_are_reported_also_if_there_is_no_robot(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = Source("walls.dxf")
    source.note("lost", "open line", "less", count=39, where="A-WALL", at=(6, 4), size=2)
    shapes = shapes_of(source, "DXF", [Shape("obstacle", None, cfree.Polygon(SQUARE))], {}, "draw it")
    monkeypatch.setattr("cfree.formats.scene_file.read_shapes", lambda *_: shapes)
    result = run("plan", "walls.dxf")
    assert result.exit_code == 2 and FIRST in result.stderr and "there is no robot" in result.stderr


def test_check_draws_what_was_lost_in_red(folder: Path) -> None:
    for name in ("a", "plain"):
        assert run("check", folder / f"{name}.json", "--picture", folder / f"{name}.png").exit_code == 0
    red = {name: count_of_red(folder / f"{name}.png") for name in ("a", "plain")}
    assert red["plain"] == 0 and red["a"] > 100
    assert f"picture    {folder / 'b.png'}" in run("check", folder / "a.json", "--picture", folder / "b.png").stdout


def test_check_draws_a_file_without_a_robot_before_it_is_refused(tmp_path: Path) -> None:
    rings = '<rect width="9" height="9"/><path fill="none" d="M 0 0 L 5 5"/>'
    (tmp_path / "a.svg").write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9">{rings}</svg>')
    result = run("check", tmp_path / "a.svg", "--picture", tmp_path / "a.png")
    assert result.exit_code == 2 and "there is no robot" in result.stderr
    assert (tmp_path / "a.png").stat().st_size > 1000


def count_of_red(file: Path) -> int:
    """Number of pixels that are red."""
    with Image.open(file) as image:
        red, green, blue = np.moveaxis(np.array(image.convert("RGB")), 2, 0)
    return int(((red > 200) & (green < 30) & (blue < 30)).sum())


def test_all_commands_that_read_take_strict() -> None:
    scenes = {"plan", "view", "slice", "boundary", "film", "check", "convert", "verify"}
    trades = {"reach", "audit", "nest", "cage", "disassemble"}
    commands = {name for name, command in app.commands.items() for p in command.params if "--strict" in p.opts}
    assert commands == scenes | trades
    assert isinstance(app, click.Group)


def test_a_start_in_a_closed_line_names_the_options_that_make_walls_or_a_room_of_it(tmp_path: Path) -> None:
    file = tmp_path / "room.svg"
    wall = '<rect width="12" height="8" fill="none" stroke="black" stroke-width="0.2"/>'
    file.write_text(f'<svg width="12m" height="8m" viewBox="0 0 12 8"><g id="A-WALL">{wall}</g></svg>')
    robot = "[[0.3, 0.2], [-0.3, 0.2], [-0.3, -0.2], [0.3, -0.2]]"
    question = "plan", file, "--robot", robot, "--start", "2,-2,0", "--goal", "9,-2,0"
    error = run(*question).stderr
    assert "if the lines of A-WALL are walls: --strokes drawn" in error and "--role A-WALL=workspace" in error
    assert run(*question, "--strokes", "drawn").exit_code == run(*question, "--role", "A-WALL=workspace").exit_code == 0


def test_a_footprint_given_as_text_has_the_unit_of_the_drawing_which_is_reported(tmp_path: Path) -> None:
    size = 'xmlns="http://www.w3.org/2000/svg" width="9{0}" height="9{0}" viewBox="0 0 9 9"'
    for unit in ("mm", "m"):
        (tmp_path / "a.svg").write_text(f'<svg {size.format("mm")}><rect x="5" width="1" height="1"/></svg>')
        scale = ("--scale", "0.001", "--units", "m") if unit == "m" else ()
        result = run("check", tmp_path / "a.svg", "--robot", "[[0.3, 0], [0, 0.3], [0, 0]]", *scale)
        assert result.exit_code == 0
        assert ("footprint taken in mm" in result.stderr) == (unit == "mm")


def test_the_frame_of_the_scene_is_that_of_its_poses(tmp_path: Path) -> None:
    scene = cfree.Scene([(0, 0), (1, 0), (0, 1)], bounds=(-9, -9, 9, 9), start=(0, 0, 0), goal=(3, 0, 0))
    cfree.save(scene, tmp_path / "a.json")
    question = "plan", tmp_path / "a.json", "--format", "ros", "-o", tmp_path / "p.yaml"
    assert run(*question, "--frame", "odom").exit_code == 0
    assert 'frame_id: "odom"' in (tmp_path / "p.yaml").read_text()
    assert run(*question).exit_code == 0
    assert "odom" not in (tmp_path / "p.yaml").read_text()
