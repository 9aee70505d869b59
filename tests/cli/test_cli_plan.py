"""`cfree plan` and `cfree verify` of its answers, as users call them."""

from __future__ import annotations

import csv
import json
import math
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from click.testing import CliRunner
from matplotlib.colors import to_rgb
from PIL import Image

import cfree
from cfree.cli.app import app
from cfree.palette import BARRIER, MARK

SCENES = Path("examples/scenes")
PARKING, SWIM, CONVEX = (str(SCENES / f"{name}.json") for name in ("benchmr_parking1", "nest_swim", "five_convex"))

Run = Callable[..., Any]


@pytest.fixture
def run() -> Run:
    return lambda *arguments: CliRunner().invoke(app, [str(argument) for argument in arguments])


@pytest.mark.slow
def test_a_path_is_written_drawn_and_verified(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("cfree.film.film_path", partial(cfree.film.film_path, seconds=1, fps=4))
    answer, picture, film = (tmp_path / name for name in ("way.json", "way.png", "way.gif"))
    result = run("plan", CONVEX, "-o", answer, "--picture", picture, "--film", film, "--improve", "50ms")
    assert result.exit_code == 0, result.output
    assert "a path, each motion proved free" in result.stdout
    with Image.open(picture) as drawn, Image.open(film) as shown:
        seen = np.asarray(drawn.convert("RGB"), float) / 255
        assert shown.n_frames == 4  # type: ignore[attr-defined]
    assert (np.abs(seen - to_rgb(BARRIER)).max(axis=-1) < 0.05).sum() > 100  # the least clearance is marked
    data = json.loads(answer.read_text())
    scene = cfree.load_scene(CONVEX)
    assert data["answer"] == "path" and scene.start and scene.goal
    for name, pose in (("start", scene.start), ("goal", scene.goal)):
        assert data[name] == [float(pose.x), float(pose.y), pose.theta]
    x, y, theta = data["start"]
    for motion in data["motions"]:  # as a reader without fractions applies them
        if motion["type"] == "translation":
            x, y = x + motion["vector"][0], y + motion["vector"][1]
        else:
            (px, py), angle = motion["pole"], motion["angle"]
            c, s = math.cos(angle), math.sin(angle)
            x, y = px + c * (x - px) - s * (y - py), py + s * (x - px) + c * (y - py)
            theta += angle
    assert math.hypot(x - data["goal"][0], y - data["goal"][1]) < 1e-6
    assert abs(math.remainder(theta - data["goal"][2], math.tau)) < 1e-9
    assert run("verify", CONVEX, answer).exit_code == 0


@pytest.mark.slow
def test_a_proof_has_exit_code_1(run: Run, tmp_path: Path) -> None:
    answer = tmp_path / "proof.json"
    result = run("plan", SWIM, "-o", answer, "--json")
    assert result.exit_code == 1
    facts = json.loads(result.stdout)
    assert (facts["answer"], facts["of"], facts["obstacles"]) == ("separated", "closed", [0, 26])
    assert json.loads(answer.read_text())["answer"] == "separated"
    assert run("verify", SWIM, answer).exit_code == 0
    assert run("verify", CONVEX, answer).exit_code != 0


def test_the_nearest_miss_is_told_when_asked_for(run: Run, tmp_path: Path) -> None:
    scene = tmp_path / "door.json"
    walls = [[[-9, -1], [-1, -1], [-1, 1], [-9, 1]], [[1, -1], [9, -1], [9, 1], [1, 1]]]
    square = [[-1.25, -1.25], [1.25, -1.25], [1.25, 1.25], [-1.25, 1.25]]
    data = {
        "robot": {"outer": square},
        "obstacles": [{"outer": wall} for wall in walls],
        "workspace": {"outer": [[-9, -9], [9, -9], [9, 9], [-9, 9]]},
    }
    scene.write_text(json.dumps(data | {"start": [0, 5, 0], "goal": [0, -5, 0]}))
    result = run("plan", scene, "--nearest-miss")
    assert result.exit_code == 1
    assert "an inset of exactly 1/4 would just do: about 0.5 too wide between" in " ".join(result.stdout.split())
    assert "nearest miss" not in run("plan", scene).stdout


@pytest.mark.slow
def test_a_proof_is_no_path_to_sample_but_can_be_filmed(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("cfree.film.film_separation", partial(cfree.film.film_separation, seconds=1, fps=6))
    result = run("plan", SWIM, "-o", tmp_path / "way.csv", "--film", tmp_path / "way.gif")
    assert result.exit_code == 1
    assert "there is no path" in result.output
    assert [file.name for file in tmp_path.iterdir()] == ["way.gif"]


def test_start_and_goal_are_given_in_any_form(run: Run, tmp_path: Path) -> None:
    answer = tmp_path / "way.json"
    ends = "--start", "1/2,0,90deg", "--goal", "0.5,1e-1,tau:1/3"
    empty = tmp_path / "scene.json"
    empty.write_text('{"robot": {"outer": [[0, 0], [1, 0], [0, 1]]}, "obstacles": []}')
    assert run("plan", empty, *ends, "-o", answer).exit_code == 0
    data = json.loads(answer.read_text())
    assert data["exact"] == {"start": ["1/2", "0", {"tau": "1"}], "goal": ["1/2", "1/10", {"tau": "1/3"}]}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["way.csv", "way.yaml", "way.geojson"])
def test_paths_for_other_programs(run: Run, tmp_path: Path, name: str) -> None:
    file = tmp_path / name
    assert run("plan", CONVEX, "-o", file).exit_code == 0
    if name.endswith("csv"):
        rows = list(csv.DictReader(file.read_text().splitlines()))
        assert list(rows[0]) == ["x", "y", "theta"] and len(rows) > 10
    elif name.endswith("yaml"):
        message = yaml.safe_load(file.read_text())
        assert message["header"]["frame_id"] == "world" and len(message["poses"]) > 10
    else:
        assert json.loads(file.read_text())["type"] == "FeatureCollection"


def test_a_form_may_be_asked_for(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "poses.txt"
    assert run("plan", CONVEX, "-o", file, "--format", "ros").exit_code == 0
    assert yaml.safe_load(file.read_text())["poses"]
    assert run("plan", CONVEX, "-o", file, "--format", "xml").exit_code == 2


@pytest.mark.slow
def test_goals_may_be_in_the_scene(run: Run, tmp_path: Path) -> None:
    scene, picture = tmp_path / "scene.json", tmp_path / "scene.png"
    shape, walls = {"outer": [[-1, -1], [1, -1], [1, 1], [-1, 1]]}, [{"outer": [[4, -9], [5, -9], [5, 9], [4, 9]]}]
    goals = {"start": [0, 0, 0], "goals": [[9, 0], [0, 3, 0]], "bounds": [-9, -9, 9, 9]}
    scene.write_text(json.dumps({"robot": shape, "obstacles": walls} | goals))
    said = run("check", scene).stdout
    assert "goal 0     x 9, y 0, any theta: free" in said and "goal 1     x 0, y 3, theta 0 degrees: free" in said
    assert json.loads(run("plan", scene, "--json").stdout)["goal reached"] == [0, 3, 0]
    assert run("plan", scene, "--goal", "9,0").exit_code == 1
    assert run("boundary", scene, "--picture", picture).exit_code == 0
    with Image.open(picture) as drawn:
        seen = np.asarray(drawn.convert("RGB"), float)
    assert (seen[..., 0] > 2 * seen[..., 1]).sum() > 1000 < (seen[..., 1] > 1.4 * seen[..., 0]).sum()  # both kinds


def test_the_picture_shows_what_is_in_the_way(run: Run, tmp_path: Path) -> None:
    scene, picture = tmp_path / "scene.json", tmp_path / "way.svg"
    shape = {"outer": [[-1, -1], [1, -1], [1, 1], [-1, 1]]}
    walls = [
        {"name": name, "outer": [[x, -9], [x + 1, -9], [x + 1, 9], [x, 9]]} for name, x in (("gate", 4), ("fence", 4.5))
    ]
    ends = {"start": [0, 0, 0], "goal": [9, 0, 0], "bounds": [-9, -9, 12, 9]}
    scene.write_text(json.dumps({"robot": shape, "obstacles": walls[:1]} | ends))
    result = run("plan", scene, "--what-if", "--picture", picture)
    assert result.exit_code == 1 and "there is a path without obstacle 0 (gate), 1 x 18 at (4.5, 0)" in " ".join(
        result.stdout.split()
    )
    assert "<!-- without obstacle 0 (gate), 1 x 18 at (4.5, 0) -->" in picture.read_text()
    scene.write_text(json.dumps({"robot": shape, "obstacles": walls} | ends))
    result = run("plan", scene, "--what-if", "--picture", picture)
    assert "no single obstacle" in result.stdout and "separated by" in picture.read_text()


@pytest.mark.slow
def test_what_if_and_the_nearest_miss_among_round_shapes(run: Run, tmp_path: Path) -> None:
    """A disc as wide as 1.1 at gaps of 1; the proof is verified, the picture has a panel for each blocker."""
    posts = [cfree.Curved.circle((x, 0), 1) for x in (0, 3, 6)]
    room, names = [(0, -3), (6, -3), (6, 3), (0, 3)], ["left", "middle", "right"]
    ends: dict[str, Any] = {"start": (3, 2, 0), "goal": (3, -2, 0), "workspace": room, "obstacle_names": names}
    scene, answer, picture = (str(tmp_path / name) for name in ("scene.json", "answer.json", "way.svg"))
    cfree.save(cfree.Scene(cfree.Curved.circle((0, 0), "0.55"), posts, **ends), scene)
    result = run("plan", scene, "--what-if", "--nearest-miss", "--picture", picture, "-o", answer)
    said = " ".join(result.stdout.split())
    assert result.exit_code == 1 and "no path at all, proved" in said
    assert "an inset of exactly 1/20 would just do: about 0.1 too wide between obstacle" in said
    assert "there is a path without one of these: obstacle 0 (left), 2 x 2 at (0, 0); obstacle 1 (middle)" in said
    assert "<!-- without obstacle 1 (middle), 2 x 2 at (3, 0) -->" in Path(picture).read_text()
    assert run("verify", scene, answer).exit_code == 0
    assert json.loads(run("plan", scene, "--what-if", "--json").stdout)["what if"] == [0, 1, 2]


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["arcs", "other curves"])
def test_obstacles_of_an_answer_are_named_by_the_round_shapes_not_by_polygons(
    run: Run, tmp_path: Path, kind: str
) -> None:
    """The first obstacle becomes several polygons, so that the numbers of the others' polygons are larger."""
    first = cfree.Curved([(1, 2), (2, 2), (2, "2.2"), ("1.2", "2.2"), ("1.2", 3), (1, 3)], grown="0.02")
    posts = [
        cfree.Curved.circle((x, 0), 1) if kind == "arcs" else cfree.Curved.ellipse((x, 0), (1, 1)) for x in (0, 3, 6)
    ]
    room, names = [(0, -4), (6, -4), (6, 4), (0, 4)], ["angle", "left", "middle", "right"]
    ends: dict[str, Any] = {"start": (4, 2, 0), "workspace": room, "obstacle_names": names}
    scene = str(tmp_path / "scene.json")
    cfree.save(cfree.Scene(cfree.Curved.circle((0, 0), "0.55"), [first, *posts], **ends), scene)
    for options in ([], ["--improve", "0.1"]):
        said = " ".join(run("plan", scene, "--goal", "3,-2,0", *options).stdout.split())
        posts_said = "obstacle 1 (left), 2 x 2 at (0, 0); obstacle 2 (middle), 2 x 2 at (3, 0); obstacle 3 (right), 2"
        assert f"blocking obstacles the workspace; {posts_said}" in said
        facts = json.loads(run("plan", scene, "--goal", "3,-2,0", "--json", *options).stdout)
        assert facts["obstacles"] == [-2, 1, 2, 3]
    said = " ".join(run("plan", scene, "--goal", "4.5,0.8,0").stdout.split())
    assert "to obstacle 3 (right), 2 x 2 at (6, 0)" in said or "to obstacle 2 (middle), 2 x 2 at (3, 0)" in said
    place = json.loads(run("plan", scene, "--goal", "4.5,0.8,0", "--json").stdout)["clearance"]["obstacle"]
    assert place in (2, 3)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--start", "1,2"], "--start: '1,2'"),
        (["--goal", "1,2,sideways"], "--goal: '1,2,sideways'"),
        (["--start", "inf,0,0"], "--start"),
        (["--improve", "soon"], "--improve: 'soon'"),
        (["--objective", "fast"], "--objective: 'fast'"),
        (["--prefer", "crab=2"], "--prefer: 'crab=2': no 'crab'; give some of sideways, backward, turning"),
        (["--prefer", "sideways=0.5"], "--prefer: 'sideways=0.5': sideways=0.5"),
        (["-o", "way.doc"], "way.doc: paths are written as"),
        (["--picture", "way.doc"], "way.doc"),
        (["--film", "way.doc"], "way.doc"),
    ],
)
def test_bad_wishes_get_one_clear_message(run: Run, arguments: list[str], message: str) -> None:
    result = run("plan", PARKING, *arguments)
    assert result.exit_code == 2
    assert message in result.output
    assert "Traceback" not in result.output


@pytest.mark.slow
def test_a_path_says_where_it_does_what_is_dear(run: Run, tmp_path: Path) -> None:
    scene = tmp_path / "corridor.json"
    hall = [[0, 0], [2, 0], [2, 9], [0, 9]]
    ends = {"start": [1, 1, 0], "goal": [1, 8, 0], "units": "m"}
    robot = [[-1, -0.5], [1, -0.5], [1, 0.5], [-1, 0.5]]
    scene.write_text(json.dumps({"robot": {"outer": robot}, "obstacles": [], "workspace": {"outer": hall}} | ends))
    marked, plain = tmp_path / "marked.svg", tmp_path / "plain.svg"
    result = run("plan", scene, "--prefer", "sideways=5,turning=2", "--picture", marked)
    assert "7 m sideways in motion 0" in result.stdout
    run("plan", scene, "--picture", plain)
    assert MARK in marked.read_text() and MARK not in plain.read_text()
    facts = json.loads(run("plan", scene, "--prefer", "sideways=5", "--json").stdout)
    assert facts["rather not"] == [{"kind": "sideways", "amount": 7.0, "first": 0, "last": 0}]
    assert json.loads(run("plan", scene, "--prefer", "turning=5", "--json").stdout)["rather not"] == []


def test_a_forbidden_start_is_explained(run: Run, tmp_path: Path) -> None:
    answer = tmp_path / "way.json"
    result = run("plan", PARKING, "--start", "1,-2,0", "-o", answer)
    assert result.exit_code == 2
    assert "start (1, -2, 0 deg) is forbidden: robot part 0 overlaps obstacle" in result.output
    assert "is free and near by" in result.output
    assert not answer.exists()


def test_a_scene_without_a_goal_needs_one(run: Run, tmp_path: Path) -> None:
    scene = tmp_path / "scene.json"
    scene.write_text('{"robot": {"outer": [[0, 0], [1, 0], [0, 1]]}, "obstacles": [], "start": [0, 0, 0]}')
    result = run("plan", scene)
    assert result.exit_code == 2
    assert "no goal" in result.output


LIMITED = {
    "plan SCENE --goal 9,0,0 -o NEW/way.json": "not enough to compute the free space; give more",
    "cage SCENE --critical all -o NEW/cage.json --save-scene NEW/hand.json": "not enough",
    "disassemble SCENE --part body -o NEW/steps": "not enough",
    "nest examples/drawings/parts.svg -o NEW/layout.svg --json": "no part was placed in time; give more --max-seconds",
}


def star(x: float, y: float, seed: int) -> list[tuple[float, float]]:
    draw = random.Random(seed)
    radii = [0.5 + 0.5 * draw.random() for _ in range(8)]
    at = [(x + r * math.cos(k * math.tau / 8), y + r * math.sin(k * math.tau / 8)) for k, r in enumerate(radii)]
    return [(round(u, 3), round(v, 3)) for u, v in at]


@pytest.mark.parametrize("words", LIMITED)
def test_a_limit_has_exit_code_3_and_writes_nothing(run: Run, tmp_path: Path, words: str) -> None:
    scene, new = tmp_path / "five.json", tmp_path / "new"
    new.mkdir()
    ring = [(1.75 * math.cos(k * math.tau / 5), 1.75 * math.sin(k * math.tau / 5)) for k in range(5)]
    around = [star(x, y, k) for k, (x, y) in enumerate(ring)]  # the body cannot leave, which takes a while to prove
    cfree.save(cfree.Scene(star(0, 0, 8), around, start=(0, 0, 0), name="body"), scene)
    given = words.replace("SCENE", str(scene)).replace("NEW", str(new)).split()
    result = run(*given, "--max-seconds", "0", "--picture", new / "drawn.png")
    assert result.exit_code == 3 and LIMITED[words] in result.stderr
    assert result.stdout == "" and result.stderr.splitlines()[-1].startswith("error: ")
    assert not [*new.iterdir()]


def test_a_boundary_file_stands_for_its_scene(run: Run, tmp_path: Path) -> None:
    boundary = tmp_path / "boundary.npz"
    assert run("boundary", CONVEX, "-o", boundary).exit_code == 0
    assert run("plan", boundary).exit_code == 0


def interrupted(after: float, *arguments: str) -> tuple[int, str]:
    process = subprocess.Popen([sys.executable, "-m", "cfree", *arguments], stderr=subprocess.PIPE, text=True)
    time.sleep(after)
    process.send_signal(signal.SIGINT)
    _, message = process.communicate(timeout=20)
    return process.returncode, message


@pytest.mark.slow
def test_an_interrupt_ends_improving_and_keeps_the_path(tmp_path: Path) -> None:
    answer = tmp_path / "way.json"
    code, _ = interrupted(4, "plan", PARKING, "-o", str(answer), "--improve", "60s")
    assert code == 0
    found = cfree.load(answer)
    assert isinstance(found, cfree.Path) and found.is_free(cfree.MotionChecker(cfree.load_scene(PARKING)))


@pytest.mark.slow
def test_an_interrupt_while_filming_leaves_no_film(tmp_path: Path) -> None:
    film = tmp_path / "way.gif"
    code, message = interrupted(2.5, "plan", PARKING, "--film", str(film))
    assert code == 130
    assert message.splitlines()[-1] == "error: interrupted; no file was left half-written"
    assert not list(tmp_path.iterdir())


def test_clearances_and_several_goals(run: Run, tmp_path: Path) -> None:
    """Verdicts, exit codes, files that are verified, and what is said of bad ones."""
    walls = [[(-9, -1), (-1, -1), (-1, 1), (-9, 1)], [(1, -1), (9, -1), (9, 1), (1, 1)]]
    rod = [("-1/2", -2), ("1/2", -2), ("1/2", 2), ("-1/2", 2)]
    scene = cfree.Scene(rod, walls, workspace=[(-9, -9), (9, -9), (9, 9), (-9, 9)], start=(0, 5, 0), goal=(0, -5, 0))
    file, answer = str(tmp_path / "gate.json"), str(tmp_path / "answer.json")
    cfree.save(scene, file)
    for options, code, said in (
        (["--clearance", "1/2"], 0, "each motion proved free and to keep 0.5"),
        (["--clearance", "0.51"], 1, "no path that keeps 0.51, proved"),
        (["--clearance", "0.51", "--what-if"], 1, "there is a path without one of these: obstacle 0, "),
        (["--goal", "0,-5"], 0, "goal reached"),
        (["--goal", "3,5", "--goal", "0,-5,0"], 0, "goal reached"),
    ):
        result = run("plan", file, *options, "-o", answer)
        assert result.exit_code == code and said in result.stdout
        asked = cfree.load_scene(file)
        if "--goal" not in options:
            assert run("verify", file, answer).exit_code == 0 and asked.goal
    for options, said in (
        (["--clearance", "0"], "--clearance: '0'; give a length above 0"),
        (["--clearance", "x"], "--clearance: 'x'; give a length above 0"),
        (["--clearance", "4"], "2 away from the workspace, and the clearance is 4; move it"),
        (["--goal", "3"], "--goal: '3': 1 number;"),
        (["--goal", "5,0"], "goal (5, 0): no orientation is free there; give another place"),
    ):
        result = run("plan", file, *options)
        assert result.exit_code == 2 and said in result.stderr, result.stderr


@pytest.mark.slow
def test_poses_with_times_and_standard_output(run: Run, tmp_path: Path) -> None:
    """As close as asked for, no point faster than the speed; the report goes elsewhere."""
    rod, block = [(0, -1), (5, -1), (5, 1), (0, 1)], [(9, 9), (10, 9), (10, 10)]
    scene, file = cfree.Scene(rod, [block], start=(0, 0, 0), goal=(30, 0, 3)), str(tmp_path / "scene.json")
    cfree.save(scene, file)
    sampled = ["--step", "0.5", "--turn", "2deg", "--speed", "2"]
    result = run("plan", file, "-o", "-", "--format", "csv", *sampled)
    assert result.exit_code == 0 and "motion proved free" in result.stderr
    rows = list(csv.DictReader(result.stdout.splitlines()))
    table = [[float(row[name]) for name in ("x", "y", "theta", "t")] for row in rows]
    assert table[0][3] == 0 and table[-1][:2] == [30, 0]
    for one, other in pairwise(table):
        before, after = (cfree.Poses([q[:2]], [q[2]]).apply(scene.robot[0].vertices)[0].tolist() for q in (one, other))
        assert max(map(math.dist, before, after)) <= 2 * (other[3] - one[3]) * (1 + 1e-9)
        assert math.dist(one[:2], other[:2]) <= 0.5 * (1 + 1e-9)
        assert abs(other[2] - one[2]) <= math.radians(2) * (1 + 1e-9)
    run("plan", file, "-o", tmp_path / "way.yaml", *sampled)
    stamps = [pose["header"]["stamp"] for pose in yaml.safe_load((tmp_path / "way.yaml").read_text())["poses"]]
    assert [s["sec"] + s["nanosec"] / 1e9 for s in stamps] == pytest.approx([row[3] for row in table], abs=1e-8)
    run("plan", file, "-o", tmp_path / "way.geojson", *sampled)
    outlines = json.loads((tmp_path / "way.geojson").read_text())["features"][1:]
    assert [outline["properties"]["t"] for outline in outlines] == [row[3] for row in table]
    (tmp_path / "exact.json").write_text(run("plan", file, "-o", "-").stdout)
    assert run("verify", file, tmp_path / "exact.json").exit_code == 0
    for options, said in (
        (["-o", "-", "--json"], "-o -: --json prints to standard output as well; leave one of them out"),
        (["--step", "1"], "--step: only for sampled poses; give -o with .csv, .yaml or .geojson, or --format"),
        (["-o", "w.csv", "--speed", "0"], "--speed: '0'; give a speed above 0"),
        (["-o", "w.csv", "--step", "0"], "--step: '0'; give a length above 0"),
        (["-o", "w.csv", "--turn", "-5deg"], "--turn: -5deg; give an angle above 0"),
        (["-o", "w.csv", "--turn", "x"], "--turn: 'x' is no number"),
    ):
        result = run("plan", file, *options)
        assert result.exit_code == 2 and said in result.stderr


def test_improving_says_what_there_was_before(run: Run) -> None:
    flat = "examples/scenes/flat.json"
    facts = json.loads(run("plan", flat, "--improve", "300ms", "--json").stdout)
    before, gained = facts["before it was improved"], facts["gained"]
    assert facts["length"] <= before["length"] and gained["length"] == before["length"] - facts["length"]
    said = run("plan", flat, "--improve", "100ms").stdout
    assert "before it was improved" in said and "least clearance" in said and "shorter" in said
    assert "before it was improved" not in run("plan", flat, "--improve", "0").stdout


def ring_of_posts(folder: Path) -> Path:
    posts = [(x, y) for x in range(12) for y in (0, 11)] + [(x, y) for x in (0, 11) for y in range(1, 11)]
    shapes = [[[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]] for x, y in posts]
    file = folder / "posts.json"
    robot = [[0, 0], [1, 0], [1, 1], [0, 1]]
    file.write_text(json.dumps({"robot": robot, "obstacles": shapes, "start": [5, 5, 0], "goal": [20, 5, 0]}))
    return file


@pytest.mark.parametrize("columns", [60, 80, 132])
def test_tables_are_wrapped_at_the_terminal_and_name_eight_obstacles(
    run: Run, tmp_path: Path, columns: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = ring_of_posts(tmp_path)
    monkeypatch.setenv("COLUMNS", str(columns))
    result = run("plan", scene, "-o", tmp_path / "answer.json")
    assert result.exit_code == 1
    for said in (result.stdout, run("verify", scene, tmp_path / "answer.json").stdout):
        lines = [line for line in said.splitlines() if str(tmp_path) not in line and "No path" not in line]
        assert max(map(len, lines)) <= columns, said
    shown = " ".join(result.stdout.split())
    assert shown.count("1 x 1 at (") == 8 and "; ... of 40 " in shown
    assert "obstacle 2, 1 x 1 at (1.5, 0.5);" in shown


def test_a_forbidden_end_is_moved_when_asked_for(run: Run, tmp_path: Path) -> None:
    file, answer = tmp_path / "scene.json", tmp_path / "answer.json"
    square, wall = [[0, 0], [1, 0], [1, 1], [0, 1]], [[2, 0], [3, 0], [3, 9], [2, 9]]
    ends = {"start": [1.25, 2, 0], "goals": [[2.25, 2], [40, 40, 0]]}
    room = [[-9, -9], [9, -9], [9, 9], [-9, 9]]
    file.write_text(json.dumps({"robot": square, "obstacles": [wall], "workspace": room} | ends))
    refused = run("plan", file)
    assert (
        refused.exit_code == 2
        and "start (1.25, 2, 0 deg) is forbidden: robot part 0 overlaps obstacle 0, 1 x 9" in refused.stderr
    )
    assert refused.stderr.endswith("is free and near by; or give --nearest-free\n")
    said = run("plan", file, "--nearest-free", "-o", answer)
    assert said.exit_code == 0
    lines = [" ".join(line.split()) for line in said.stdout.splitlines()]
    assert lines[1:4] == [
        "answer a path, each motion proved free",
        "start moved from (1.25, 2, 0 deg) to (1, 2, 0 deg)",
        "goal moved from (2.25, 2, any) to (3, 2, any)",
    ]
    verified = " ".join(run("verify", file, answer).stdout.split())
    assert "start from (1.25, 2, 0 deg) to (1, 2, 0 deg), goal from (2.25, 2, any) to (3, 2, 0 deg)" in verified
    assert (
        "leads from (1, 2, 0 deg) [moved from (1.25, 2, 0 deg)] to (3, 2, 0 deg) [moved from (2.25, 2, any)]"
        in verified
    )
    facts = json.loads(run("plan", file, "--nearest-free", "--json").stdout)
    assert facts["moved"] == {
        "start": {"from": [1.25, 2, 0], "to": [1, 2, 0]},
        "goal": {"from": [2.25, 2], "to": [3, 2]},
    }
    assert run("plan", file, "--start", "0,2,0", "--nearest-free").exit_code == 0  # the goal is the scene's
    one = run("plan", file, "--start", "0,2,0", "--goal", "2.25,2,0", "--nearest-free", "--clearance", "0.1")
    assert "goal moved" in one.stdout and "start moved" not in one.stdout and "(3.1, 2, 0 deg)" in one.stdout
    free = run("plan", file, "--start", "0,2,0", "--goal", "4.5,0.8,0", "--nearest-free")
    assert free.exit_code == 0 and "start moved" not in free.stdout and "goal moved" not in free.stdout


def test_a_place_and_a_clearance(run: Run, tmp_path: Path) -> None:
    answer = tmp_path / "answer.json"
    for scene, goal, clearance, code, said in (
        (PARKING, "4,-2.6", "0.05", 0, "a path, each motion proved free and to keep 0.05"),
        (SWIM, "9267.18,4601.6", "10", 1, "to none of the goals: no path that keeps 10, proved"),
    ):
        found = run("plan", scene, "--goal", goal, "--clearance", clearance, "-o", answer)
        assert found.exit_code == code and said in " ".join(found.stdout.split()), found.output


@pytest.mark.slow
def test_decimals_of_an_exact_fit_among_round_shapes_are_approximate(run: Run, tmp_path: Path) -> None:
    """The path touches two walls, and not only the polygons that guided the search."""
    walls = [[[-3, y], [3, y], [3, y + 3], [-3, y + 3]] for y in (1, -4)]
    scene, answer = tmp_path / "fit.json", tmp_path / "answer.json"
    disc = {"circle": {"center": [0, 0], "radius": 1}}
    data = {"robot": disc, "obstacles": walls, "bounds": [-9, -5, 9, 5], "start": [-6, 0.5, 0], "goal": [6, 0, 0]}
    scene.write_text(json.dumps(data))
    assert run("plan", scene, "--improve", "0", "-o", answer).exit_code == 0
    assert json.loads(answer.read_text())["decimals"] == "approximate"
    verified = run("verify", scene, answer)
    assert verified.exit_code == 0 and "its decimals are approximate" in verified.stdout, verified.stdout
