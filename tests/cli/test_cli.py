"""The command line: what it prints and writes, exit codes, one clear message on bad input."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
import trimesh
from click.testing import CliRunner
from PIL import Image

import cfree
from cfree.cli.app import app
from cfree.formats.boundaries.boundary_file import signed
from examples import POLYGONS

SCENES = Path("examples/scenes")
FIG9 = str(SCENES / "paper_fig9.json")
PARKING = str(SCENES / "benchmr_parking1.json")
TRIANGLE = '{"outer": [[0, 0], [1, 0], [0, 1]]}'

Result = Any
Run = Callable[..., Result]


@pytest.fixture
def run() -> Run:
    """The command, in this process."""
    return lambda *arguments: CliRunner().invoke(app, [str(argument) for argument in arguments])


def in_a_new_process(*arguments: str, **options: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "cfree", *arguments], capture_output=True, text=True, **options)


# help


def test_help_has_examples(run: Run) -> None:
    assert "cfree boundary" in run("--help").stdout
    for command in ("check", "boundary", "slice", "verify"):
        result = run(command, "--help")
        assert result.exit_code == 0
        assert f"cfree {command} scene.json" in " ".join(result.stdout.split())
        assert "--json" in result.stdout
    assert "cfree figures -o pictures" in " ".join(run("figures", "--help").stdout.split())


def test_no_arguments_mean_help(run: Run) -> None:
    assert "Usage" in run().output


def test_the_version_is_the_packages(run: Run) -> None:
    assert run("--version").stdout == f"cfree {cfree.__version__}\n"
    assert in_a_new_process("--version").stdout == f"cfree {cfree.__version__}\n"


@pytest.mark.slow
def test_help_and_import_are_quick() -> None:
    heavy = {"numpy", "matplotlib", "shapely", "pydantic", "trimesh", "flint", "cfree._core"}
    program = (
        "import sys, cfree\n"
        "from cfree.cli.app import app\n"
        "try: app(['--help'])\n"
        "except SystemExit: pass\n"
        f"print('heavy:', sorted({heavy!r} & set(sys.modules)))\n"
    )
    answer = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert answer.stdout.endswith("heavy: []\n")
    assert min(cpu_seconds_of_help() for _ in range(4)) < 0.3


def cpu_seconds_of_help() -> float:
    resource = pytest.importorskip("resource")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    in_a_new_process("--help")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return float(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def test_completion_is_offered() -> None:
    environment = {**os.environ, "_CFREE_COMPLETE": "bash_complete", "COMP_WORDS": "cfree bou", "COMP_CWORD": "1"}
    assert "boundary" in in_a_new_process(env=environment).stdout


# check


def test_check_describes_the_car_park(run: Run) -> None:
    facts = json.loads(run("check", PARKING, "--json").stdout)
    assert facts["robot"] == {
        "polygons": 1, "vertices": 20, "convex": 20, "reflex": 0, "holes": 0, "pieces": 1,
    }  # fmt: skip
    assert facts["obstacles"]["polygons"] == 13
    assert facts["patches"] == {"v-e": 4500, "e-v": 4500, "bound": 4, "total": 9004}
    assert facts["start"]["free"] and facts["goal"]["free"]
    assert facts["source"]["licence"].startswith("MIT")
    text = run("check", PARKING).stdout
    assert "9,000 contact patches before trimming: 4,500 v-e, 4,500 e-v; and 4 sides of the bounds" in text
    assert "licence: MIT" in text and "theta 90 degrees: free" in text


@pytest.mark.parametrize("file", [p for p in POLYGONS if p.stem[0] != "n"], ids=lambda file: file.stem)
def test_check_expects_the_patches_there_are(file: Path, run: Run) -> None:
    expected = json.loads(run("check", file, "--json").stdout)["patches"]["total"]
    assert run("check", file).exit_code == 0
    found = run("boundary", file, "--json")
    if found.exit_code == 0:
        assert json.loads(found.stdout)["patches"] == expected
    else:
        assert found.exit_code == 2 and "documented limit" in found.stderr


def test_check_reports_removed_points_and_forbidden_poses(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "scene.json"
    ring = "[[3, 0], [4, 0], [5, 0], [5, 1], [3, 1]]"
    file.write_text(
        f'{{"robot": {TRIANGLE}, "obstacles": [{{"name": "bench", "outer": {ring}}}], '
        '"start": [2, 0, 0], "goal": [4, 0.5, "90deg"]}'
    )
    text = run("check", file).stdout
    assert "removed    obstacle 0 (bench), 2 x 1 at (4, 0.5): outer ring, point 1: collinear" in text
    assert "theta 0 degrees: free" in text  # touching is free
    assert "theta 90 degrees: FORBIDDEN" in text


@pytest.mark.parametrize(
    ("pose", "free"),
    [
        ([0, 0, 0], True),
        ([3, 3, 0], True),
        ([2.5, 2.5, 0], False),
        ([1, 1, 0], True),
        ([1.001, 1, 0], False),
        ([4, 0, 0], False),
    ],
)
def test_poses_are_checked_against_workspace_and_bounds(
    pose: list[float], free: bool, run: Run, tmp_path: Path
) -> None:
    file = tmp_path / "scene.json"
    room = '{"outer": [[0, 0], [8, 0], [8, 8], [0, 8]], "holes": [[[2, 1], [2, 3], [4, 3], [4, 1]]]}'
    file.write_text(
        f'{{"robot": {TRIANGLE}, "obstacles": [], "workspace": {room}, "bounds": [0, 0, 3.5, 7], "start": {pose}}}'
    )
    assert json.loads(run("check", file, "--json").stdout)["start"]["free"] is free


# boundary


@pytest.mark.slow
def test_boundary_writes_all_files_and_their_names(run: Run, tmp_path: Path) -> None:
    files = {"-o": "fig9.npz", "--mesh": "fig9.glb", "--picture": "fig9.png"}
    result = run("boundary", FIG9, *(x for option, name in files.items() for x in (option, tmp_path / name)))
    assert result.exit_code == 0, result.output
    counts = dict(
        line.rsplit(maxsplit=1) for line in result.stdout.splitlines() if "patches" in line or "sides" in line
    )
    assert counts == {
        " contact patches": "18", " live contact patches": "18",
        " sides of the bounds": "4", " live sides of the bounds": "4",
    }  # fmt: skip
    assert "trapezoids" in result.stdout
    assert all(str(tmp_path / name) in result.stdout for name in files.values())
    found = cfree.load(tmp_path / "fig9.npz")
    assert found == cfree.boundary(cfree.load_scene(FIG9))
    again = trimesh.load(tmp_path / "fig9.glb", process=False)
    assert {"v-e", "e-v"} <= set(again.geometry) and len(again.to_geometry().faces) > len(found.trapezoids)
    with Image.open(tmp_path / "fig9.png") as image:
        seen = np.asarray(image.convert("RGB"), float)
    assert (seen[..., 0] > 1.6 * seen[..., 1]).sum() > 10_000  # orange patches
    assert sorted(file.name for file in tmp_path.rglob("*") if file.is_file()) == ["fig9.glb", "fig9.npz", "fig9.png"]


def test_boundary_in_json_has_the_stats_and_the_files(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "fig9.npz"
    facts = json.loads(run("boundary", FIG9, "-o", file, "--threads", 1, "--json").stdout)
    assert (facts["patches"], facts["live_patches"], facts["files"]) == (22, 22, {"boundary": str(file)})
    assert facts["seconds"]["total"] > 0


def test_a_boundary_file_stands_for_its_scene(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "fig9.npz"
    run("boundary", FIG9, "-o", file)
    from_file = json.loads(run("slice", file, "--theta", "20deg", "--json").stdout)
    from_scene = json.loads(run("slice", FIG9, "--theta", "20deg", "--json").stdout)
    assert {**from_file, "file": ""} == {**from_scene, "file": ""}
    assert run("boundary", file, "--mesh", tmp_path / "fig9.ply").exit_code == 0


# slice


@pytest.mark.parametrize(
    ("text", "degrees"),
    [
        ("30deg", 30), ("30°", 30), ("-30deg", 330), ("0.5", 28.64789), ("tau:1/3", 36.869898), ("tau:-2", 233.1301),
        ("-360deg", 0), ("750deg", 30), ("1e3 deg", 280), ("61/2deg", 30.5), ("0.5rad", 28.64789), ("90rad", 116.62016),
        ("-6.28", 0.18254), ("tau:90", 178.7268),
    ],
)  # fmt: skip
def test_angles_are_written_in_three_ways(text: str, degrees: float, run: Run) -> None:
    facts = json.loads(run("slice", FIG9, "--theta", text, "--json").stdout)
    assert facts["degrees"] == pytest.approx(degrees, abs=1e-4)
    assert facts["length v-e"] > 0


def test_internal_counters_are_shown_only_when_asked_for(run: Run) -> None:
    internal = "patch and pillar pairs", "decided by intervals", "seconds, trim"
    for options, shown in (((), False), (("-v",), True), (("--verbose",), True)):
        said = run("boundary", FIG9, *options).stdout
        assert "contact patches" in said and all((words in said) == shown for words in internal)
    assert "decided_by_filter" in json.loads(run("boundary", FIG9, "--json").stdout)


@pytest.mark.parametrize("text", ["90", "-90", "30", "1e3", "22/3", "6.3", "-6.5"])
def test_an_angle_of_more_than_a_turn_needs_its_unit(text: str, run: Run, tmp_path: Path) -> None:
    remedy = f"{text} is more than a whole turn in radians; write {text}deg or {text}rad"
    for arguments in (
        ["slice", FIG9, "--theta", text],
        ["plan", FIG9, "--start", f"0,0,{text}"],
        ["plan", FIG9, "--goal", f"4,-2.6,{text}"],
        ["plan", FIG9, "--goal", "1,1", "--goal", f"4,-2.6, {text}"],
        ["plan", FIG9, "-o", tmp_path / "way.csv", "--turn", text],
    ):
        result = run(*arguments)
        assert result.exit_code == 2 and result.stderr.startswith(f"error: {arguments[-2]}: ")
        assert result.stderr.endswith(f"{remedy}\n") and result.stderr.count("\n") == 1


def test_slices_are_written_as_geojson(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "slice.geojson"
    result = run("slice", FIG9, "--theta", "30deg", "-o", file, "--picture", tmp_path / "slice.png")
    assert result.exit_code == 0, result.output
    region, *contacts = json.loads(file.read_text())["features"]
    assert shapely.geometry.shape(region["geometry"]).is_valid
    assert {contact["properties"]["kind"] for contact in contacts} == {"v-e", "e-v", "bound"}
    assert {contact["properties"]["obstacle"] for contact in contacts} == {"triangle", "bounds"}
    length = sum(shapely.geometry.shape(contact["geometry"]).length for contact in contacts)
    facts = json.loads(run("slice", FIG9, "--theta", "30deg", "--json").stdout)
    assert length == pytest.approx(sum(facts[f"length {kind}"] for kind in ("v-e", "e-v", "bound")))


def test_the_free_area_is_that_of_bounds_without_the_region(run: Run) -> None:
    facts = json.loads(run("slice", FIG9, "--theta", "30deg", "--json").stdout)
    scene = cfree.load_scene(FIG9)
    region = cfree.boundary(cfree.Scene(robot=scene.robot, obstacles=scene.obstacles)).slice("30deg").forbidden
    assert facts["free area"] == pytest.approx(80 - region.area)


# bad input


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('{"robot": ', "scene.json:1:11"),
        ('{"robot": 3, "obstacles": []}', "robot"),
        (f'{{"robot": {TRIANGLE}, "obstacles": [{{"outer": [[0, 0], [2, 2], [2, 0], [0, 3]]}}]}}', "cross"),
        (f'{{"robot": {TRIANGLE}, "obstacles": [{{"outer": [[0, 0], [NaN, 2], [2, 0]]}}]}}', "NaN is not finite"),
        ('{"robot": [], "obstacles": []}', "robot"),
        (f'{{"robot": {TRIANGLE}, "name": "{"x" * 10_000_000}", "obstacles": 1}}', "obstacles"),
        ("[" * 100_000, "scene.json:1"),
        ("", "scene.json:1:1"),
        ("\x00\x01", "scene.json:1:1"),
    ],
)
@pytest.mark.parametrize("command", [["check"], ["boundary"], ["slice", "--theta", "1"]])
def test_broken_files_get_one_clear_message(
    command: list[str], text: str, message: str, run: Run, tmp_path: Path
) -> None:
    file = tmp_path / "scene.json"
    file.write_text(text)
    result = run(*command, file)
    assert result.exit_code == 2
    assert isinstance(result.exception, SystemExit)
    assert result.stdout == ""
    assert result.stderr.startswith("error: ") and message in result.stderr
    assert len(result.stderr) < 3000


def test_all_faults_of_a_file_are_listed(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "scene.json"
    file.write_text(f'{{"robot": {TRIANGLE},\n "obstacles": [{{"outer": [[0, 0]]}},\n {{"outer": [[1, "x"]]}}]}}')
    lines = run("check", file).stderr.splitlines()
    assert f"{file}:2:" in lines[0] and f"{file}:3:" in lines[1]


@pytest.mark.slow
def test_damaged_boundary_files_get_one_clear_message(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "fig9.npz"
    run("boundary", FIG9, "-o", file)
    file.write_bytes(file.read_bytes()[:-500])
    result = in_a_new_process("slice", str(file), "--theta", "1")
    assert result.returncode == 2 and result.stderr.startswith(f"error: {file}: ")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["slice", FIG9, "--theta", "north"], "theta"),
        (["slice", FIG9, "--theta", "tau:1/x"], "1/x"),
        (["slice", FIG9], "--theta"),
        (["slice", FIG9, "--theta", "1", "-o", "."], "directory"),
        (["boundary", FIG9, "--mesh", "mesh.dae"], "name the file .glb"),
        (["boundary", FIG9, "--picture", "picture.docx"], "name the file .png"),
        (["boundary", FIG9, "-o", FIG9], "is the input"),
        (["boundary", FIG9, "-o", f"{FIG9}/boundary.npz"], "cannot be made in"),
        (["boundary", FIG9, "--threads", "0"], "threads"),
        (["check", "missing.json"], "No such file"),
        (["check", "."], "directory"),
        (["simplify", FIG9], "simplify"),
        (["check", FIG9, "--colour"], "--colour"),
    ],
)
def test_bad_arguments_get_one_clear_message(arguments: list[str], message: str, run: Run) -> None:
    before = Path(FIG9).read_bytes()
    result = run(*arguments)
    assert result.exit_code == 2
    assert message in " ".join(result.stderr.replace("│", " ").split())
    assert "Traceback" not in result.output
    assert Path(FIG9).read_bytes() == before


# interruption


@pytest.mark.slow
def test_an_interrupt_ends_with_one_line_and_leaves_nothing(tmp_path: Path) -> None:
    program = (
        "import os, signal, sys, time, cfree.forbidden.boundary\n"
        "def slow(scene, **options):\n"
        "    print('started', flush=True)\n"
        "    time.sleep(60)\n"
        "cfree.forbidden.boundary.boundary = slow\n"
        "from cfree.cli.app import main\n"
        f"sys.argv = ['cfree', 'boundary', {FIG9!r}, '-o', {str(tmp_path / 'fig9.npz')!r}]\n"
        "main()\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout is not None and process.stdout.readline() == "started\n"
    process.send_signal(signal.SIGINT)
    _, stderr = process.communicate(timeout=10)
    assert (process.returncode, stderr) == (130, "error: interrupted; no file was left half-written\n")
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_bar_is_shown_on_terminals_only() -> None:
    pty = pytest.importorskip("pty")
    leader, follower = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "cfree", "boundary", FIG9], stdout=subprocess.PIPE, stderr=follower, text=True
    )
    stdout, _ = process.communicate(timeout=20)
    os.close(follower)
    assert b"boundary" in os.read(leader, 10_000) and "contact patches" in stdout
    os.close(leader)
    assert "\r" not in in_a_new_process("boundary", FIG9).stderr


# verify


@pytest.fixture
def fig9_boundary(run: Run, tmp_path: Path) -> Path:
    file = tmp_path / "fig9.npz"
    run("boundary", FIG9, "-o", file)
    return file


def test_verify_says_what_is_proved_and_what_is_sampled(run: Run, fig9_boundary: Path) -> None:
    result = run("verify", FIG9, fig9_boundary)
    assert result.exit_code == 0 and result.stderr == ""
    for word in ("PROVED", "SAMPLED", "closed surface", "verified ("):
        assert word in result.stdout
    facts = json.loads(run("verify", FIG9, fig9_boundary, "--sample", 5, "--slices", 1, "--json").stdout)
    assert facts["verified"] and {check["how"] for check in facts["checks"]} == {"PROVED", "SAMPLED", "SKIPPED"}


def test_verify_deep_counts_euler_numbers_again_and_is_for_boundaries(run: Run, fig9_boundary: Path) -> None:
    result = run("verify", FIG9, fig9_boundary, "--deep", "--slices", 0)
    assert result.exit_code == 0 and "Euler by slices   SAMPLED" in result.stdout and "Gauss map" in result.stdout
    for file in ([], [FIG9]):
        refused = run("verify", FIG9, *file, "--deep")
        assert refused.exit_code == 2 and "--deep: is for a boundary in one file" in refused.output


def test_verify_refutes_with_exit_code_1(run: Run, fig9_boundary: Path) -> None:
    result = run("verify", SCENES / "five_convex.json", fig9_boundary)
    assert result.exit_code == 1 and "not the scene" in result.stdout
    arrays = dict(np.load(fig9_boundary))
    arrays["lower"], arrays["upper"] = arrays["upper"], arrays["lower"]
    header = json.loads(arrays.pop("header").tobytes())
    header = np.frombuffer(json.dumps(signed(header, arrays)).encode(), np.uint8)
    np.savez(fig9_boundary, header=header, **arrays)
    result = run("verify", FIG9, fig9_boundary)
    assert result.exit_code == 1 and result.stderr == ""
    assert "domains           REFUTED" in result.stdout and "not shown" in result.stdout


def test_verify_refuses_bad_files_with_exit_code_2(run: Run, fig9_boundary: Path) -> None:
    cut = fig9_boundary.with_name("cut.npz")
    cut.write_bytes(fig9_boundary.read_bytes()[:-100])
    for scene, file in ((FIG9, FIG9), (FIG9, cut), (FIG9, "missing.npz"), ("missing.json", fig9_boundary)):
        result = run("verify", scene, file)
        assert result.exit_code == 2
        assert result.stderr.startswith("error: ") and result.stderr.count("\n") == 1


def test_a_limit_of_time_or_memory_has_exit_code_3_and_a_marked_file(run: Run, tmp_path: Path) -> None:
    scene, file = SCENES / "benchmr_warehouse.json", tmp_path / "part.npz"
    for limit in (("--max-seconds", "0"), ("--max-memory", "1 MB")):
        result = run("boundary", scene, "-o", file, *limit)
        assert result.exit_code == 3 and "incomplete" in result.stderr and str(file) in result.stderr
        assert run("slice", file, "--theta", "0").exit_code == 2
        file.unlink()
    result = run("boundary", scene, "--max-memory", "a lot")
    assert result.exit_code == 2 and '"500MB"' in result.stderr


# figures


def test_view_writes_a_page_with_the_scene_in_it(run: Run, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    result = run("view", FIG9, "--html", page, "--no-browser")
    assert result.exit_code == 0 and result.stdout.strip() == str(page)
    assert "coordinates of our own" in page.read_text().rpartition('id="given"')[2]
    refused = run("view", FIG9, FIG9, "--html", tmp_path / "other.html", "--no-browser")
    assert refused.exit_code == 2 and "no path and no proof" in refused.stderr
    assert not (tmp_path / "other.html").exists()


@pytest.mark.slow
def test_figures_are_written_as_asked(run: Run, tmp_path: Path) -> None:
    result = run("figures", "-o", tmp_path / "new", "--only", "6,2", "--format", "svg,png", "--json")
    assert result.exit_code == 0
    names = [Path(file).name for file in json.loads(result.stdout)["files"]]
    assert names == ["06-edge-edge.svg", "06-edge-edge.png", "02-contacts.svg", "02-contacts.png"]
    assert sorted(names) == sorted(file.name for file in (tmp_path / "new").iterdir())
    assert "figure 6" in run("figures", "-o", tmp_path, "--only", "6", "--format", "png").stdout


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--only", "25"), "there are the figures 1 to 24"),
        (("--renderer", "gl"), "pyvista"),
        (("--only", "6,x"), 'as in "7" or "7,9"'),
        (("--format", "png,gif"), "--format: 'gif'; give"),
        (("--only", ""), "give numbers of figures"),
    ],
)
def test_bad_wishes_for_figures_write_nothing(options: tuple[str, str], message: str, run: Run, tmp_path: Path) -> None:
    result = run("figures", "-o", tmp_path / "new", *options)
    assert result.exit_code == 2 and message in result.stderr
    assert list(tmp_path.iterdir()) == []


def test_figures_in_space_say_who_would_draw_them_better(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("cfree.plot.rendered.find_spec", lambda _: None)
    in_space, in_plane = (run("figures", "-o", tmp_path, "--only", n, "--format", "png") for n in ("16", "6"))
    assert in_space.exit_code == in_plane.exit_code == 0
    assert in_plane.stderr == ""
    assert in_space.stderr.strip().endswith("pip install 'cfree[render]'") and in_space.stderr.count("\n") == 1
    refused = run("figures", "-o", tmp_path / "none", "--renderer", "pyvista")
    assert refused.exit_code == 2 and "cfree[render]" in refused.stderr and not (tmp_path / "none").exists()


def test_figures_need_a_directory(run: Run, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine")
    result = run("figures", "-o", tmp_path / "file", "--only", "6")
    assert result.exit_code == 2 and "give a directory" in result.stderr
    assert (tmp_path / "file").read_text() == "mine"
