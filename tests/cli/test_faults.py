"""How the command ends: no exit code of ours for another meaning, no half file, nothing a terminal would obey."""

import errno
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import cfree
from cfree.cli.app import app
from cfree.formats.text.atomic import replacing

FIG9 = "examples/scenes/paper_fig9.json"
TRIANGLE = '{"outer": [[0, 0], [1, 0], [0, 1]]}'


def run(*arguments: object) -> Any:
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def shell(command: str, **options: Any) -> subprocess.CompletedProcess[str]:
    """What a shell says; `cfree` in it is the command."""
    text = re.sub(r"\bcfree\b", f"{sys.executable} -m cfree", command)
    return subprocess.run(["bash", "-c", text], capture_output=True, text=True, **options)


def with_fault(raised: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """The command, where reading a scene raises something."""
    program = (
        "import errno, os, signal, sys, cfree.formats.readers\n"
        f"def read_file(*arguments):\n    {raised}\n"
        "cfree.formats.readers.read_file = read_file\n"
        "from cfree.cli.app import main\n"
        f"sys.argv = ['cfree', *{arguments or ('boundary', FIG9)!r}]\n"
        "main()\n"
    )
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)


# exit codes


@pytest.mark.slow
@pytest.mark.parametrize("command", ["cfree --help", f"cfree check {FIG9} --json", f"cfree plan {FIG9} --improve 0"])
def test_a_closed_pipe_has_the_exit_code_of_its_signal(command: str) -> None:
    answer = shell(f"{command} | true; echo ${{PIPESTATUS[0]}}")
    assert (answer.stdout, answer.stderr) == (f"{128 + signal.SIGPIPE}\n", "")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("raised", "code", "said"),
    [
        ("raise MemoryError", 3, "error: out of memory\n"),
        ("os.kill(os.getpid(), signal.SIGINT); import time; time.sleep(9)", 130, "error: interrupted;"),
        ("raise ImportError('initialization failed') from KeyboardInterrupt()", 130, "error: interrupted;"),
        ("exec('raise KeyboardInterrupt')", 130, "error: interrupted;"),
        ("raise RuntimeError('\\x1b[2J')", 4, "error: this is a bug in cfree, please report it\n"),
        ("raise RecursionError", 4, "error: this is a bug in cfree, please report it\n"),
        ("raise AssertionError", 4, "error: this is a bug in cfree, please report it\n"),
        ("raise ImportError('no matplotlib')", 4, "error: this is a bug in cfree, please report it\n"),
        ("raise OSError(errno.EIO, 'Input/output error', 'x.json')", 2, "error: x.json: Input/output error\n"),
        ("raise TimeoutError", 2, "error: "),
        ("sys.stderr.close(); os.close(2); raise ValueError", 2, ""),
    ],
)
def test_only_a_proof_and_a_refutation_end_with_1(raised: str, code: int, said: str) -> None:
    result = with_fault(raised)
    assert result.returncode == code and said in result.stderr and "\x1b" not in result.stderr


@pytest.mark.parametrize("command", ["", "--colour", "simplify", "check", "check a b", "plan --improve", "film -o"])
def test_usage_errors_end_with_2(command: str) -> None:
    result = shell(f"cfree {command}")
    assert result.returncode == 2 and "Traceback" not in result.stderr


def test_a_fault_outside_of_a_command_is_no_answer() -> None:
    program = (
        "import sys, cfree.cli.app\n"
        "def broken(**options):\n    raise RuntimeError\n"
        "cfree.cli.app.app = broken\n"
        "cfree.cli.app.main()\n"
    )
    assert subprocess.run([sys.executable, "-c", program], capture_output=True).returncode == 4


# files that cannot be written


@pytest.mark.slow
def test_a_full_disk_names_the_file_and_nothing_is_left(tmp_path: Path) -> None:
    for option, name in (("-o", "a.npz"), ("--mesh", "a.glb"), ("--picture", "a.png")):
        (tmp_path / name).symlink_to("/dev/full")
        result = run("boundary", FIG9, option, tmp_path / name)
        assert (result.exit_code, result.stderr) == (2, f"error: {tmp_path / name}: No space left on device\n")
        (tmp_path / name).unlink()
    result = run("plan", FIG9, "-o", "/dev/full", "--format", "csv", "--improve", "0")
    assert (result.exit_code, result.stderr) == (2, "error: /dev/full: No space left on device\n")
    assert not list(tmp_path.iterdir()) and Path("/dev/full").is_char_device()


@pytest.mark.slow
def test_a_full_disk_under_the_output_is_no_success() -> None:
    for command in (f"check {FIG9}", f"check {FIG9} --json", "--version"):
        result = shell(f"cfree {command} > /dev/full")
        assert (result.returncode, result.stderr) == (2, "error: standard output: No space left on device\n")


@pytest.mark.parametrize(
    ("command", "file"),
    [
        (f"boundary {FIG9} -o", "a.npz"),
        (f"boundary {FIG9} --mesh", "a.glb"),
        (f"boundary {FIG9} --picture", "a.png"),
        (f"plan {FIG9} -o", "a.json"),
        (f"plan {FIG9} --film", "a.gif"),
        (f"plan {FIG9} --picture", "a.png"),
        (f"slice {FIG9} --theta 1 -o", "a.geojson"),
        (f"slice {FIG9} --theta 1 --picture", "a.svg"),
        (f"film {FIG9} -o", "a.gif"),
    ],
)
def test_outputs_are_checked_before_anything_is_computed(
    command: str, file: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def too_late(*arguments: object, **options: object) -> None:
        raise AssertionError("computed")

    for place in (
        "cfree.planning.planner.Planner",  # first: it imports the others as they are
        "cfree.formats.scene_file.read_file",
        "cfree.forbidden.boundary.boundary",
    ):
        monkeypatch.setattr(place, too_late)
    missing = run(*command.split(), tmp_path / "new" / file)
    assert (missing.exit_code, missing.stderr[:-1]) == (
        2,
        f"error: {tmp_path / 'new'}: there is no such folder; make it, or give another",
    )
    foreign = run(*command.split(), tmp_path / "a.docx")
    assert foreign.exit_code == 2 and "name the file" in foreign.stderr
    assert not list(tmp_path.iterdir())


def test_a_killed_run_leaves_nothing(tmp_path: Path) -> None:
    for number in (signal.SIGTERM, signal.SIGKILL):
        program = (
            "import time, cfree.formats.text.atomic\n"
            f"with cfree.formats.text.atomic.replacing({str(tmp_path / 'b.png')!r}) as unfinished:\n"
            "    unfinished.write_bytes(b'half')\n"
            "    print('half', flush=True)\n"
            "    time.sleep(60)\n"
        )
        process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE)
        assert process.stdout is not None and process.stdout.readline() == b"half\n"
        process.send_signal(number)
        assert process.wait(10) == -number
        process.stdout.close()
        assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("nameless", [True, False])
def test_a_file_is_replaced_whole_with_its_rights(
    nameless: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not nameless:  # as on file systems that know no files without a name
        monkeypatch.delattr(os, "O_TMPFILE")
    file = tmp_path / "note.txt"
    for text in ("one", "two"):
        with replacing(file) as unfinished:
            unfinished.write_text(text)
        assert file.read_text() == text and list(tmp_path.iterdir()) == [file]
        file.chmod(0o640)
    assert file.stat().st_mode & 0o777 == 0o640
    with pytest.raises(OSError, match=r"File too large: .*note.txt") as caught, replacing(file):
        raise OSError(errno.EFBIG, os.strerror(errno.EFBIG))
    assert caught.value.filename == str(file)
    assert file.read_text() == "two" and list(tmp_path.iterdir()) == [file]


# what a terminal is shown

EVIL = "\x1b]0;owned\x07\x9b2J\u202egnp.\ud800"


def test_names_from_files_are_shown_and_not_obeyed(tmp_path: Path) -> None:
    file = tmp_path / "scene.json"
    evil = json.dumps(EVIL[:-1] + " [bold] :bug:")
    ring = "[[3, 0], [4, 0], [5, 0], [5, 1], [3, 1]]"
    file.write_text(
        f'{{"robot": {TRIANGLE}, "obstacles": [{{"name": {evil}, "outer": {ring}}}], "name": {evil}, "units": {evil},'
        f'"note": {evil}, "source": {{{evil}: {evil}}}, "start": [0, 0, 0], "goal": [0, 5, 0]}}'
    )
    for arguments in (["check"], ["check", "--json"], ["boundary"], ["plan"], ["plan", "--json"]):
        shown = run(*arguments, file).stdout
        assert not set(EVIL) & set(shown) - set("]0;owned2Jgnp."), arguments
    assert "\\x1b]0;owned\\x07\\x9b2J\\u202egnp. [bold] :bug:" in run("check", file).stdout
    assert json.loads(run("check", file, "--json").stdout)["name"] == json.loads(evil)
    file.write_text(f'{{"robot": {TRIANGLE}, "obstacles": [], {evil}: 1}}'.replace("\\u001b", "\x1b"))
    assert "\x1b" not in run("check", file).stderr


@pytest.mark.slow
def test_letters_that_the_output_cannot_write_are_escaped(tmp_path: Path) -> None:
    file = tmp_path / "scene.json"
    file.write_text(f'{{"robot": {TRIANGLE}, "obstacles": [], "name": "Bühne"}}', encoding="utf-8")
    result = shell(f"cfree check {file}", env={**os.environ, "PYTHONIOENCODING": "ascii"})
    assert result.returncode == 0 and result.stdout.startswith("B\\xfchne\n")


def test_each_phase_of_a_plan_has_its_name() -> None:
    names: list[str] = []

    @contextmanager
    def phase(name: str) -> Iterator[None]:
        names.append(name)
        yield

    wall, room = [(4, 0), (5, 0), (5, 9), (4, 9)], [(0, 0), (9, 0), (9, 9), (0, 9)]
    scene = cfree.Scene([(0, 0), (2, 0), (0, 1)], [wall], workspace=room)
    cfree.Planner(scene, phase=phase).plan((1, 1, 0), (6, 1, 0))
    assert names == ["simple ways", "search", "surfaces around the two poses"]
    names.clear()
    cfree.Planner(scene, phase=phase).plan((1, 1, 0), (1, 2, 0))
    assert names == ["simple ways", "shorter paths"]
