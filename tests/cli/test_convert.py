"""`cfree convert` and `cfree check` of drawings and maps: what they write, and say was changed and dropped."""

import json
from pathlib import Path
from typing import Any

import pyarrow.parquet
import pytest
from click.testing import CliRunner

import cfree
import drawings
from cfree.cli.app import app
from cfree.forbidden.columns import COLUMNS
from cfree.formats.text import extras


def run(*arguments: object) -> Any:
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    drawings.put(tmp_path)
    return tmp_path


def test_a_map_and_a_footprint_become_a_scene(folder: Path) -> None:
    result = run("convert", folder / "map.yaml", folder / "a.json", "--robot", folder / "nav.yaml")
    assert result.exit_code == 0
    assert "unknown cell" in result.stderr
    scene = cfree.load_scene(folder / "a.json")
    assert scene == cfree.load_shapes(folder / "map.yaml").scene(cfree.load_polygons(folder / "nav.yaml"))
    text = "[[0.1, 0], [0, 0.1], [-0.1, 0]]"
    given = ("--robot", text, "--unknown", "free", "--json")
    facts = json.loads(run("convert", folder / "map.yaml", folder / "a.svg", *given).stdout)
    assert facts["changed"] == ["unknown cell: free", "cells by the strict rules"]
    assert facts["files"] == {"scene": str(folder / "a.svg")}
    assert cfree.load_scene(folder / "a.svg").robot == (cfree.footprint(text),)


def test_check_says_what_was_changed_and_dropped(folder: Path) -> None:
    result = run("check", folder / "a.dxf", "--tolerance", "0.01", "--role", "hatch=ignore")
    assert "read as    DXF" in result.stdout
    assert "ignored shape" in result.stderr


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("map.yaml", "a.json"), "map.yaml: there is no robot; give one: --robot"),
        (("a.svg", "new.wkt"), "new.wkt: no scene format; name the file .json, .geojson, .svg or .dxf"),
        (("a.svg", "a.stl"), "a.stl: no scene format; name the file .json, .geojson, .svg or .dxf"),
        (("a.svg", "a"), "a: no scene format; name the file .json, .geojson, .svg or .dxf"),
        (("a.svg", "a.json", "--role", "walls"), "--role: 'walls'; write it like \"walls=obstacle\""),
        (("a.svg", "a.json", "--tolerance", "0"), "tolerance: 0.0 is no length; give one above 0"),
        (("none.dxf", "a.json"), "none.dxf: No such file"),
    ],
)
def test_what_is_wrong_leaves_no_file(arguments: tuple[str, ...], message: str, folder: Path) -> None:
    files, rest = arguments[:2], arguments[2:]
    result = run("convert", *(folder / name for name in files), *rest)
    assert result.exit_code == 2
    assert message in result.stderr.replace(f"{folder}/", "")
    assert not (folder / files[1]).exists()


def test_a_missing_extra_is_named_in_one_line(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: str) -> Any:
        raise ImportError(name)

    monkeypatch.setattr(extras, "import_module", missing)
    result = run("check", folder / "a.svg")
    assert (result.exit_code, result.stderr) == (
        2,
        "error: SVG needs tinycss2; install it: pip install 'cfree[svg]'\n",
    )


def test_boundaries_are_written_as_tables(tmp_path: Path) -> None:
    built = cfree.boundary(cfree.load_scene("examples/scenes/paper_fig9.json"))
    cfree.save(built, tmp_path / "a.parquet")
    table = pyarrow.parquet.read_table(tmp_path / "a.parquet")
    assert table.column_names == [*COLUMNS, "contact_kind", "contact_robot", "contact_obstacle"]
    assert table["patch"].to_pylist() == built.trapezoids.patch.tolist()
    assert table["contact_robot"].to_pylist() == built.contact_robot[built.trapezoids.patch].tolist()
    (tmp_path / "scene.json").write_bytes(table.schema.metadata[b"scene"])
    assert cfree.load_scene(tmp_path / "scene.json") == built.scene


def test_a_robot_drawn_by_an_outline_is_solid_also_with_strokes(tmp_path: Path) -> None:
    svg = '<svg xmlns="http://www.w3.org/2000/svg"><path fill="none" d="M 0 0 H {0} V {0} H 0 Z"/></svg>'
    (tmp_path / "plan.svg").write_text(svg.format(90))
    (tmp_path / "robot.svg").write_text(svg.format(1))
    options = ["--robot", tmp_path / "robot.svg", "--strokes", 0.1, "--min-area", 2]
    result = run("convert", tmp_path / "plan.svg", tmp_path / "a.json", *options)
    assert result.exit_code == 0, result.output
    scene = cfree.load_scene(tmp_path / "a.json")
    assert [part.area for part in scene.robot] == [1] and len(scene.obstacles) == 4
