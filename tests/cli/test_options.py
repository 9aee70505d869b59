"""What is asked for is done or refused: files by their suffix, options without effect, answers of other scenes."""

import re
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import click
import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

import cfree
import cfree.film
from cfree.cli import terminal
from cfree.cli.app import app

SCENES = Path("examples/scenes")
FIG9 = SCENES / "paper_fig9.json"
ROUND = SCENES / "round_disc.json"
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
HALL = cfree.Scene(SQUARE, [[(4, 0), (5, 0), (5, 2), (4, 2)]], bounds=(-1, -1, 9, 5), start=(1, 1, 0), goal=(7, 1, 0))
SMALL = "--size", "160x90", "--fps", "2"


def run(*arguments: object) -> Any:
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A scene, its path and its boundary; another scene; a scene without start and goal, and one with a place."""
    cfree.save(HALL, tmp_path / "hall.json")
    cfree.save(cfree.plan(HALL, improve=0), tmp_path / "path.json")
    cfree.save(cfree.boundary(HALL), tmp_path / "hall.npz")
    closed = cfree.Scene(
        SQUARE, [[(4, -2), (5, -2), (5, 6), (4, 6)]], bounds=HALL.bounds, start=HALL.start, goal=HALL.goal
    )
    cfree.save(closed, tmp_path / "closed.json")
    cfree.save(cfree.plan(closed), tmp_path / "proof.json")
    cfree.save(cfree.Scene(SQUARE, HALL.obstacles, bounds=HALL.bounds), tmp_path / "bare.json")
    place = cfree.Scene(SQUARE, HALL.obstacles, bounds=HALL.bounds, start=HALL.start, goals=[(7, 1)])
    cfree.save(place, tmp_path / "place.json")
    return tmp_path


def refusal(command: str, folder: Path) -> str:
    """The one line that refuses a command, in which names in braces are files of the folder."""
    before = sorted(folder.iterdir())
    result = run(*(re.sub(r"\{(.*)\}", lambda name: str(folder / name[1]), word) for word in command.split()))
    assert result.exit_code == 2, result.output
    assert result.stdout == "" and result.stderr.count("\n") == 1
    assert sorted(folder.iterdir()) == before
    return str(result.stderr).replace(f"{folder}/", "")


# suffixes

WRITTEN = {
    "boundary {hall.json} -o": ".npz or .parquet",
    "boundary {hall.json} --mesh": ".glb, .ply, .obj or .stl",
    "boundary {hall.json} --picture": ".png, .svg, .pdf, .jpg or .webp",
    "convert {hall.json}": ".json, .geojson, .svg or .dxf",
    "film {hall.json} -o": ".mp4 or .gif",
    "film {hall.json} {path.json} -o": ".mp4 or .gif",
    "plan {hall.json} -o": ".json, .csv, .yaml, .geojson",
    "plan {hall.json} --format csv -o": ".csv or .txt",
    "plan {hall.json} --format json -o": ".json or .txt",
    "plan {hall.json} --format ros -o": ".yaml, .yml or .txt",
    "plan {hall.json} --format geojson -o": ".geojson, .json or .txt",
    "plan {hall.json} --film": ".mp4 or .gif",
    "plan {hall.json} --picture": ".png, .svg, .pdf, .jpg or .webp",
    "slice {hall.json} --theta 1 -o": ".geojson or .json",
    "slice {hall.json} --theta 1 --picture": ".png, .svg, .pdf, .jpg or .webp",
    "view {hall.json} --no-browser --html": ".html or .htm",
}
SUFFIXES = ["stl", "json", "csv", "yaml", "geojson", "svg", "png", "npz", "gif", "html", "txt", "wkt", "docx"]


@pytest.mark.parametrize("command", WRITTEN)
def test_a_file_is_refused_whose_suffix_does_not_fit(
    command: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def too_late(*_: object, **__: object) -> None:
        raise AssertionError("computed")

    for place in ("cfree.planning.planner.Planner", "cfree.forbidden.boundary.boundary"):
        monkeypatch.setattr(place, too_late)
    fitting = re.findall(r"\.(\w+)", WRITTEN[command])
    for suffix in SUFFIXES:
        if suffix not in fitting:
            assert WRITTEN[command] in refusal(f"{command} {{out.{suffix}}}", folder)


def test_the_part_of_a_folder_is_refused_unless_it_is_named_as_a_scene(folder: Path) -> None:
    (folder / "shards").mkdir()
    assert "name the file .json, .geojson, .svg or .dxf" in refusal("plan {shards} --part {out.stl}", folder)


@pytest.mark.parametrize("suffix", ["html", "HTM"])
def test_pages_have_either_suffix(suffix: str, folder: Path) -> None:
    assert run("view", folder / "hall.json", "--no-browser", "--html", folder / f"page.{suffix}").exit_code == 0


# options

IDLE = [
    ("boundary {hall.json} --tiles 2", "--tiles"),
    ("boundary {hall.json} --workers 2 --scheduler a:1", "--workers, --scheduler"),
    ("boundary {hall.json} --obstacles {bare.json}", "--obstacles"),
    ("boundary {hall.json} --folder {new} --threads 2", "--threads"),
    ("boundary {hall.json} --folder {new} --max-seconds 2", "--max-seconds"),
    ("boundary {hall.json} --folder {new} --max-memory 2GB", "--max-memory"),
    ("boundary {hall.json} --folder {new} --picture {a.png} -o {a.npz}", "--output, --picture"),
    ("boundary {hall.npz} --max-seconds 2", "--max-seconds"),
    ("boundary {hall.npz} --max-memory 2GB", "--max-memory"),
    ("boundary {hall.npz} --threads 1", "--threads"),
    ("boundary {hall.json} --error 1", "--error"),
    ("slice {hall.npz} --theta 1 --threads 1", "--threads"),
    ("plan {hall.json} --format csv", "--format"),
    ("plan {hall.json} --format json", "--format"),
    ("plan {hall.json} --step 1", "--step"),
    ("plan {hall.json} --turn 5deg", "--turn"),
    ("plan {hall.json} -o {a.json} --speed 1", "--speed"),
    ("plan {hall.json} -o {a.json} --speed 1 --acceleration 1 --steer-rate 1", "--speed, --acceleration, --steer-rate"),
    ("plan {hall.json} --wheelbase 1 --stops all", "--wheelbase, --stops"),
    ("plan {hall.json} -o {a.json} --per-gear", "--per-gear"),
    ("plan {hall.json} --part {a.json}", "--part"),
    ("plan {hall.json} --tolerance 1", "--tolerance"),
    ("plan {hall.npz} --tolerance 1", "--tolerance"),
    ("plan {hall.npz} --max-seconds 1", "--max-seconds"),
    ("plan {hall.json} --objective short --improve 0", "--objective"),
    ("film {hall.json} {path.json} -o {a.gif} --storyboard path", "--storyboard"),
    ("verify {hall.json} {path.json} --sample 1", "--sample"),
    ("verify {hall.json} {path.json} --slices 12", "--slices"),
    ("verify {hall.json} {path.json} --seed 1", "--seed"),
    ("verify {hall.json} {path.json} --workers 1", "--workers"),
    ("verify {hall.json} {hall.npz} --scheduler a:1", "--scheduler"),
    ("verify {hall.json} {hall.npz} --slices 0 --seed 1", "--seed"),
    ("figures -o {new} --only 1,2 --renderer matplotlib", "--renderer"),
    ("check {hall.json} --unknown free", "--unknown"),
    ("check {hall.json} --tolerance 1", "--tolerance"),
    ("check {hall.json} --role a=robot", "--role"),
    ("convert {hall.json} {a.json} --unknown obstacle", "--unknown"),
    ("convert {hall.json} {a.svg} --tolerance 1", "--tolerance"),
    ("convert {hall.json} {a.json} --role a=robot", "--role"),
    ("convert {hall.json} {a.json} --outer 1", "--outer"),
    ("convert {hall.json} {a.json} --inner 1", "--inner"),
]


@pytest.mark.parametrize(("command", "options"), IDLE)
def test_an_option_that_would_do_nothing_is_refused(command: str, options: str, folder: Path) -> None:
    assert refusal(command, folder).startswith(f"error: {options}:")


@pytest.mark.parametrize(
    ("command", "option"),
    [
        ("verify {shards} --slices 3", "--slices"),
        ("verify {shards} --seed 3", "--seed"),
        ("verify {shards} {path.json} --sample 3", "--sample"),
        ("verify {shards} {path.json} --workers 3", "--workers"),
        ("plan {shards} --max-seconds 3", "--max-seconds"),
        ("plan {shards} --tolerance 3", "--tolerance"),
        ("plan {shards} --clearance 3", "--clearance"),
    ],
)
def test_an_option_that_would_do_nothing_with_a_folder_is_refused(command: str, option: str, folder: Path) -> None:
    assert run("boundary", folder / "hall.json", "--folder", folder / "shards").exit_code == 0
    assert refusal(command, folder).startswith(f"error: {option}:")


def test_options_that_do_something_are_taken(folder: Path) -> None:
    for command in (
        "boundary hall.npz --mesh a.glb --threads 1",
        "plan hall.json --objective clear --improve 0",
        "plan hall.json -o a.txt --format csv --step 1",
        "plan hall.json --max-seconds 20",
        "verify hall.json hall.npz --sample 1 --slices 0 --seed 3",
        "verify hall.json hall.npz --slices 1 --seed 3",
    ):
        words = [folder / word if "." in word else word for word in command.split()]
        assert run(*words).exit_code == 0, command
    assert run("convert", ROUND, folder / "a.svg", "--tolerance", "0.01").exit_code == 0
    assert run("convert", ROUND, folder / "b.json", "--outer", "0.01").exit_code == 0


# answers


@pytest.mark.parametrize(
    "other",
    [
        HALL.obstacles,
        [*HALL.obstacles, [(8, 4), (9, 4), (9, 5)]],
    ],
    ids=["another robot", "one obstacle more"],
)
@pytest.mark.parametrize("answer", ["path.json", "proof.json"])
def test_the_answer_of_another_scene_is_refused_in_the_words_of_verify(other: Any, answer: str, folder: Path) -> None:
    robot = [(0, 0), ("1.1", 0), (1, 1), (0, 1)] if other is HALL.obstacles else SQUARE
    scene = cfree.Scene(robot, other, bounds=HALL.bounds, start=HALL.start, goal=HALL.goal)
    cfree.save(scene, folder / "other.json")
    words = run("verify", folder / "other.json", folder / answer).stdout
    said = next(line for line in words.splitlines() if line.startswith("scene: another scene: "))
    for command in (f"view {{other.json}} {{{answer}}} --no-browser", f"film {{other.json}} {{{answer}}} -o {{a.gif}}"):
        assert refusal(command, folder) == f"error: {answer}: {said}\n"
    with pytest.raises(ValueError, match=re.escape(said)):
        cfree.view(scene, cfree.load(folder / answer), html=folder / "a.html", browser=False)


def test_the_page_is_no_answer_and_replaces_none(folder: Path) -> None:
    (folder / "path.html").write_text((folder / "path.json").read_text())
    assert "is the input" in refusal("view {hall.json} {path.html} --no-browser --html {path.html}", folder)
    assert "no path and no proof" in refusal("view {hall.json} {bare.json} --no-browser --html {a.html}", folder)


# films


@pytest.mark.parametrize("storyboard", ["paper", "path", "separation"])
def test_a_film_without_start_and_goal_is_refused_at_once(
    storyboard: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("cfree.forbidden.boundary.boundary", lambda *_, **__: pytest.fail("computed"))
    for scenes, said in (
        ("{bare.json}", "bare.json: no start and no goal; put them into the scene"),
        ("{hall.json} {bare.json}", "bare.json: no start and no goal; put them into the scene"),
        ("{place.json}", "place.json: several goals, or a place for one; plan, and give the answer after the scene"),
    ):
        assert said in refusal(f"film {scenes} -o {{a.gif}} --storyboard {storyboard}", folder)


@pytest.mark.slow
def test_a_turntable_needs_no_start_and_no_goal(folder: Path) -> None:
    result = run("film", folder / "bare.json", "-o", folder / "a.gif", "--storyboard", "turntable", *SMALL)
    assert result.exit_code == 0, result.output
    assert length(folder / "a.gif") == 6


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scene", "answer"), [("hall.json", "path.json"), ("hall.npz", "path.json"), ("closed.json", "proof.json")]
)
def test_a_film_shows_the_answer_in_a_file(
    scene: str, answer: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown: list[Any] = []
    import cfree.film

    for name in ("film_path", "film_separation"):
        kept = getattr(cfree.film, name)

        def seen(given: Any, *rest: Any, kept: Any = kept, **options: Any) -> None:
            shown.append(given)
            kept(given, *rest, **options)

        monkeypatch.setattr(cfree.film, name, seen)
    result = run("film", folder / scene, folder / answer, "-o", folder / "a.gif", *SMALL)
    assert result.exit_code == 0, result.output
    assert shown == [cfree.load(folder / answer)]
    assert length(folder / "a.gif") == 6
    result = run("film", folder / scene, folder / answer, "-o", folder / "a.gif", "--seconds", "4", *SMALL)
    assert result.exit_code == 0 and length(folder / "a.gif") == 4


@pytest.mark.slow
def test_a_film_shows_an_answer_among_round_shapes(tmp_path: Path) -> None:
    assert run("plan", ROUND, "-o", tmp_path / "path.json", "--improve", "0").exit_code == 0
    result = run("film", ROUND, tmp_path / "path.json", "-o", tmp_path / "a.gif", "--seconds", "2.5", *SMALL)
    assert result.exit_code == 0, result.output


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ("{path.json}", "path.json: an answer; give it after one scene"),
        ("{hall.json} {closed.json} {path.json}", "path.json: an answer; give it after one scene"),
        ("{hall.json} {path.json} --seconds 1.8", "--seconds: 1.8; give more than 1.8"),
        ("{closed.json} {proof.json} --seconds 0", "0.0 seconds"),
        ("{hall.json} {path.json} --fps 0", "0 frames a second"),
    ],
)
def test_what_no_film_can_show_is_refused(
    arguments: str, said: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("cfree.forbidden.boundary.boundary", lambda *_, **__: pytest.fail("computed"))
    assert said in refusal(f"film {arguments} -o {{a.gif}}", folder)


@pytest.mark.slow
@pytest.mark.parametrize(("suffix", "way", "proof"), [("gif", (6, 6), 6), ("mp4", (5.8, 21.8), 12)])
def test_the_film_of_a_plan_is_as_long_as_is_said(
    suffix: str, way: tuple[float, float], proof: float, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lengths: list[float] = []

    def write(frames: Iterable[object], path: Path, fps: int) -> None:
        lengths.append(sum(1 for _ in frames) / fps)
        path.touch()

    monkeypatch.setattr("cfree.film.encode.write", write)
    for stage in ("cfree.film.path_film.PathStage", "cfree.film.frame.Stage"):
        monkeypatch.setattr(f"{stage}.draw", lambda *_: np.zeros((2, 2, 3)))
    for scene in ("hall.json", "closed.json"):
        assert run("plan", folder / scene, "--improve", "0", "--film", folder / f"a.{suffix}").exit_code < 2
    assert way[0] <= lengths[0] <= way[1] and lengths[1:] == [proof]


def length(gif: Path) -> float:
    """Seconds of a film."""
    with Image.open(gif) as film:
        total = 0
        for k in range(film.n_frames):  # type: ignore[attr-defined]
            film.seek(k)
            total += film.info["duration"]
    return total / 1000


# progress


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "told"),
    [
        ("boundary {hall.json}", "boundary"),
        ("boundary {hall.json} --folder {new}", r"\d of 1 tile"),
        ("plan {hall.json}", ""),
        ("film {hall.json} -o {a.gif} --storyboard path --seconds 3 --size 160x90 --fps 4", r"film \d+%"),
        ("film {hall.json} {path.json} -o {a.gif} --seconds 3 --size 160x90 --fps 4", r"film \d+%"),
        ("verify {hall.json} {hall.npz}", r"verify \d+%"),
        ("figures -o {new} --only 1,2 --format png", r"figures \d+%"),
        ("slice {hall.json} --theta 1 --picture {a.png}", "picture"),
        ("check {hall.json}", ""),
        ("convert {hall.json} {a.svg}", ""),
        ("view {hall.json} --no-browser --html {a.html}", ""),
    ],
)
def test_progress_is_told_in_lines_where_there_is_no_terminal(
    command: str, told: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(terminal, "EVERY", 0.0001)
    result = run(*(re.sub(r"\{(.*)\}", lambda name: str(folder / name[1]), word) for word in command.split()))
    assert result.exit_code == 0, result.output
    assert re.search(told, result.stderr) and "\r" not in result.stderr and "%" not in result.stdout


def test_lines_are_told_every_few_seconds_also_where_nothing_is_done(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(terminal, "EVERY", 0.1)
    begin = time.monotonic()
    with terminal.status() as say:
        say("reading ...")
        time.sleep(0.25)
        for k in range(100):
            say(f"film {k}%")
            time.sleep(0.001)
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) <= (time.monotonic() - begin) / 0.1 + 1
    of_reading = lines.count("reading ...")
    assert of_reading >= 2 and lines[:of_reading] == ["reading ..."] * of_reading and lines[of_reading:]
    assert all(re.fullmatch(r"film \d+%", line) for line in lines[of_reading:])


def test_short_phases_of_a_long_command_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(terminal, "EVERY", 0.1)

    @click.command()
    def phases() -> None:
        for k in range(6):
            with terminal.status() as say:
                say(f"phase {k}")
                time.sleep(0.05)

    begin = time.monotonic()
    lines = CliRunner().invoke(phases).stderr.splitlines()
    assert 1 <= len(lines) <= (time.monotonic() - begin) / 0.1 + 1 and all(line.startswith("phase ") for line in lines)
