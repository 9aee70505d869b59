"""The pages about files of other programs: commands print the lines that are shown, Python runs, options are named."""

from __future__ import annotations

import csv
import doctest
import re
import runpy
import shlex
from pathlib import Path
from types import SimpleNamespace

import pytest
import yaml
from click.testing import CliRunner

import cfree
from cfree.cli.app import app
from cfree.cli.drawing import _OPTIONS

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "docs" / name for name in ("from-your-file.md", "formats.md")]
Command = tuple[str, list[str]]


def commands(page: Path) -> list[Command]:
    """Commands of the page's blocks `console`, each with the lines below it."""
    result: list[Command] = []
    for indent, block in re.findall(r"^( *)```console\n(.*?)^ *```$", page.read_text(), re.S | re.M):
        for line in block.splitlines():
            line = line.removeprefix(indent)
            if line.startswith("$ cfree "):
                result.append((line.removeprefix("$ cfree "), []))
            else:
                result[-1][1].append(line)
    return result


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.slow
@pytest.mark.usefixtures("here")
@pytest.mark.parametrize(("command", "lines"), [item for page in PAGES for item in commands(page)])
def test_commands_print_the_lines_that_are_shown(command: str, lines: list[str]) -> None:
    result = CliRunner(env={"COLUMNS": "140"}).invoke(app, shlex.split(command))
    assert result.exit_code == 2 if lines and lines[-1].startswith("error") else result.exit_code in (0, 1), (
        result.output
    )
    printed = iter([*result.stderr.splitlines(), *result.stdout.splitlines()])
    for line in lines:
        assert line in printed, f"{line}\n\n{result.output}"


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.usefixtures("here")
def test_the_forklift_is_led_from_the_map_to_poses() -> None:
    page = ROOT / "docs" / "forklift.md"
    for command, lines in commands(page):  # they follow each other, in one folder
        test_commands_print_the_lines_that_are_shown(command, lines)
    rows = list(csv.DictReader(Path("way.csv").read_text().splitlines()))
    assert {"gear", "curvature", "axle_x", "axle_y", "t"} <= rows[0].keys() and len(rows) > 100
    (first, *_, last) = yaml.safe_load(Path("way.yaml").read_text())["poses"]
    assert first["pose"]["position"] == {"x": 8.475, "y": 4.6, "z": 0}
    assert last["pose"]["position"] == pytest.approx({"x": 11.075, "y": 7.7, "z": 0})
    result = doctest.testfile(str(page), module_relative=False)
    assert result.attempted >= 12 and not result.failed


@pytest.mark.slow
@pytest.mark.usefixtures("here")
def test_the_page_about_nesting_leads_from_a_drawing_to_a_compacted_layout() -> None:
    page = ROOT / "docs" / "nesting.md"
    for command, lines in commands(page):
        test_commands_print_the_lines_that_are_shown(command, lines)
    result = doctest.testfile(str(page), module_relative=False)
    assert result.attempted >= 15 and not result.failed


@pytest.mark.slow
@pytest.mark.usefixtures("here")
def test_the_clinic_is_audited_as_the_page_about_buildings_shows() -> None:
    page = ROOT / "docs" / "buildings.md"
    for command, lines in commands(page):  # they follow each other, in one folder
        test_commands_print_the_lines_that_are_shown(command, lines)
    assert cfree.load_shapes("reach.yaml").form == "ROS map" and Path("audit.png").stat().st_size > 10_000
    result = doctest.testfile(str(page), module_relative=False)
    assert result.attempted >= 14 and not result.failed


@pytest.mark.slow
@pytest.mark.usefixtures("here")
@pytest.mark.parametrize(("name", "least"), [("teaching", 10), ("ompl", 8)])
def test_pages_for_teachers_and_users_of_ompl_run(name: str, least: int) -> None:
    if name == "ompl":
        pytest.importorskip("ompl")
    result = doctest.testfile(str(ROOT / "docs" / f"{name}.md"), module_relative=False, optionflags=doctest.ELLIPSIS)
    assert result.attempted >= least and not result.failed


@pytest.mark.slow
@pytest.mark.usefixtures("here")
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_python_of_the_pages_runs(page: Path) -> None:
    import numpy as np

    assert not doctest.testfile(str(page), module_relative=False).failed

    info = SimpleNamespace(height=2, width=3, resolution=0.05)
    message = SimpleNamespace(data=[0, 100, -1, 0, 0, 0], info=info)
    names: dict[str, object] = {"cfree": cfree, "np": np, "message": message, "robot": [(0, 0), (1, 0), (0, 1)]}
    names |= dict.fromkeys(("x", "y", "yaw"), 0)
    for block in re.findall(r"^```python\n(?!>>>)(.*?)^```$", page.read_text(), re.S | re.M):
        exec(block, names)
    assert names.get("scene")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_every_option_of_reading_is_on_the_page(page: Path) -> None:
    options = {name for names, _ in _OPTIONS for name in names[0].split("/") if name.startswith("--")}
    text = page.read_text()
    assert [option for option in options if not re.search(rf"{option}\b", text)] == []


@pytest.mark.slow
def test_pictures_of_the_page_are_those_that_the_tool_draws() -> None:
    pictures = runpy.run_path(str(ROOT / "tools" / "file_images.py"))["PICTURES"]
    names = re.findall(r"\(images/files/([\w-]+)\.png\)", PAGES[0].read_text())
    assert names == [*pictures] == [name for name in pictures if (ROOT / f"docs/images/files/{name}.png").exists()]
    for file, panels in pictures.values():
        for title, options in panels.items():
            cfree.load_shapes(ROOT / "examples" / "drawings" / (file or title.split()[0]), **options)
