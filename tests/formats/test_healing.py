"""The option `heal`: arcs of drawings and scenes that are tangent but for rounding become exactly tangent."""

import math
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import ezdxf
import pytest
from click.testing import CliRunner

import cfree
from cfree import Curved
from cfree.cli.app import app
from cfree.curves.drawn import Line
from cfree.curves.rings import Span
from cfree.formats.shapes import Shapes

BULGE = 0.4142136  # tan 22.5 degrees, rounded up: the arcs leave the box by 4e-9
SVG = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="-10 -10 100 20">
<g id="robot"><rect x="-7.1" y="-4.3" width="14.2" height="8.6" rx="1.1"/></g>
<g id="walls"><rect x="20" y="4.3" width="30" height="5" rx="2.5"/><rect x="20" y="-9.3" width="30" height="5" rx="0.7"
/><rect x="60" y="0.1" width="7" height="3" rx="0.3" transform="rotate(20)"/></g></svg>"""
JSON = """{"robot": {"path": [[-1, -1], [1, -1], {"arc": {"to": [1, 0.9999999999], "through": [2.0000000001, 0]}},
  [-1, 1], {"arc": {"to": [-1, -1], "through": [-2, 1e-11]}}]}, "obstacles": [[[-9, 1], [9, 1], [9, 2], [-9, 2]]],
  "start": [-5, 0, 0], "goal": [5, 0, 0]}"""


def joints(shape: Any) -> Iterator[bool]:
    """True for each joint of a line and an arc that is exactly smooth."""
    for curve in shape.curves:
        for before, after in zip((curve[-1], *curve), curve, strict=False):
            for arc, line, end in ((after, before, False), (before, after, True)):
                if isinstance(arc, Span) and isinstance(line, Line):
                    x, y = arc.end if end else arc.at(0, Fraction(0))
                    along = line.end[0] - line.start[0], line.end[1] - line.start[1]
                    yield (x - arc.center[0]) * along[0] + (y - arc.center[1]) * along[1] == 0


@pytest.fixture
def dxf(tmp_path: Path) -> Path:
    """A rounded box between walls as far apart as it is wide, in metres; a stadium, and a box at an angle."""
    document = ezdxf.new()  # type: ignore[attr-defined]
    document.header["$INSUNITS"] = 6
    box = [(-0.55, -0.4), (0.55, -0.4, BULGE), (0.7, -0.25), (0.7, 0.25, BULGE), (0.55, 0.4), (-0.55, 0.4, BULGE)]
    box += [(-0.7, 0.25), (-0.7, -0.25, BULGE)]
    c, s = math.cos(0.3), math.sin(0.3)
    turned = [(round(9 + c * x - s * y, 6), round(s * x + c * y, 6), *bulge) for x, y, *bulge in box]
    walls = [[(2, y), (5, y), (5, y + 1), (2, y + 1)] for y in (0.4, -1.4)]
    stadium = [(6, 3.1), (8, 3.1, 1), (8, 4.2), (6, 4.2, 1)]
    layers = (("robot", box), ("walls", walls[0]), ("walls", walls[1]), ("stadium", stadium), ("turned", turned))
    for layer, points in layers:
        rows = [(*point, 0)[:3] for point in points]
        document.modelspace().add_lwpolyline(rows, format="xyb", close=True, dxfattribs={"layer": layer})
    document.saveas(tmp_path / "fit.dxf")
    return tmp_path / "fit.dxf"


def notes(shapes: Shapes | cfree.Scene) -> dict[str, tuple[int, float]]:
    """Healed arcs and the largest change, by layer."""
    return {note.where: (note.count, note.size or 0) for note in shapes.reading if note.kind == "mended"}


def tangent(path: Path, **options: Any) -> set[str]:
    """Layers of round shapes with smooth joints only."""
    shapes = cfree.load_shapes(path, curves=True, **options).shapes
    return {s.name or s.role for s in shapes if isinstance(s.polygon, Curved) and all(joints(s.polygon))}


def test_arcs_of_dxf_become_tangent_and_the_record_counts_them(dxf: Path) -> None:
    drawn = cfree.load_shapes(dxf, curves=True)
    healed = cfree.load_shapes(dxf, curves=True, heal=1e-5)
    assert not notes(drawn), "no arc is healed by default"
    for before, after in zip(drawn.shapes, healed.shapes, strict=True):
        if before.role == "robot" or before.name == "turned":
            assert not all(joints(before.polygon)) and all(joints(after.polygon))
        else:
            assert before == after, "halves of circles are exact as drawn"
    counts = {layer: count for layer, (count, _) in notes(healed).items()}
    sizes = {layer: size for layer, (_, size) in notes(healed).items()}
    assert counts == {"robot": 4, "turned": 4}
    assert 1e-9 < sizes["robot"] < 1e-8 < sizes["turned"] < 1e-5
    note = next(note for note in healed.reading if note.where == "robot")
    assert (note.effect, note.what, len(note.items)) == ("near", "arc made exact", 4)
    assert note.at is not None and abs(note.at[0]) in (0.55, 0.7)


def test_a_smaller_length_heals_only_smaller_changes(dxf: Path) -> None:
    assert tangent(dxf, heal=1e-12) == {"stadium"}
    assert tangent(dxf, heal=1e-7) == {"stadium", "robot"}
    shapes = cfree.load_shapes(dxf, curves=True, heal=1e-12)
    assert all(size <= 1e-12 for _, size in notes(shapes).values()), "radii become rational, and corners stay"
    assert not notes(cfree.load_shapes(dxf, heal=1e-5)), "polygons have no arcs"


def test_the_length_is_in_the_unit_of_the_scene(dxf: Path) -> None:
    assert tangent(dxf, scale=1000, heal=1e-7) == {"stadium"}
    assert tangent(dxf, scale=1000, heal=1e-4) == {"stadium", "robot"}


def test_a_healed_robot_fits_between_walls_as_far_apart_as_it_is_wide(dxf: Path) -> None:
    assert not cfree.is_free(cfree.load_scene(dxf), cfree.Pose(3, 0))
    scene = cfree.load_scene(dxf, heal=1e-7)
    assert (
        cfree.is_free(scene, cfree.Pose(3, 0))
        and cfree.plan(scene, start=(0, 0, 0), goal=(7, 0, 0), improve=0).length == 7
    )


def test_rounded_rectangles_of_svg_are_tangent_and_turned_ones_become_so(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text(SVG)
    drawn, healed = cfree.load_scene(tmp_path / "a.svg"), cfree.load_scene(tmp_path / "a.svg", heal=1e-9)
    assert [all(joints(shape)) for shape in (*drawn.robot, *drawn.obstacles)] == [True, True, True, False]
    assert all(all(joints(shape)) for shape in (*healed.robot, *healed.obstacles))
    assert healed.robot == drawn.robot
    assert healed.robot[0].box == (Fraction("-7.1"), Fraction("-4.3"), Fraction("7.1"), Fraction("4.3"))


def test_round_shapes_of_scene_files_are_healed(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(JSON)
    assert not cfree.is_free(cfree.load_scene(tmp_path / "a.json"), cfree.Pose(0, 0))
    scene = cfree.load_scene(tmp_path / "a.json", heal=1e-9)
    assert notes(scene)["robot"][0] == 2 and all(joints(scene.robot[0]))
    cfree.save(scene, tmp_path / "healed.json")
    again = cfree.load_scene(tmp_path / "healed.json")
    assert again == scene and notes(again) == notes(scene)
    assert cfree.load_scene(tmp_path / "healed.json", heal=1e-9) == scene, "healing once is enough"


def test_convert_heals(dxf: Path, tmp_path: Path) -> None:
    scene = cfree.convert(dxf, tmp_path / "fit.json", heal=1e-7)
    assert "robot" in notes(scene) and cfree.load_scene(tmp_path / "fit.json") == scene


def run(*words: object) -> Any:
    return CliRunner().invoke(app, [str(word) for word in words])


@pytest.mark.slow
def test_the_commands_heal(dxf: Path, tmp_path: Path) -> None:
    ends = "--start", "0,0,0", "--goal", "7,0,0"
    result = run("plan", dxf, *ends, "--heal", "1e-7", "-o", tmp_path / "way.json")
    assert result.exit_code == 0 and "mended    4 arcs of robot made exact within 3.99e-09 at" in result.output
    assert " translations        1\n" in result.output
    assert run("verify", dxf, tmp_path / "way.json", "--heal", "1e-7").exit_code == 0
    assert run("verify", dxf, tmp_path / "way.json").exit_code == 1, "another scene"
    assert run("convert", dxf, tmp_path / "fit.json", "--heal", "1e-7").exit_code == 0
    assert run("verify", tmp_path / "fit.json", tmp_path / "way.json").exit_code == 0


def test_heal_refuses_what_is_no_length(dxf: Path) -> None:
    for value in (-1, math.nan, math.inf):
        with pytest.raises(ValueError, match=r"heal: .*; give 0 or more"):
            cfree.load_shapes(dxf, curves=True, heal=value)
        with pytest.raises(ValueError, match=r"heal: .*; give 0 or more"):
            cfree.load_scene(dxf, heal=value)
    for word in ("nan", "inf", "-1", "short"):
        result = run("check", dxf, "--heal", word)
        assert result.exit_code == 2 and "heal" in result.output and "Traceback" not in result.output
    result = run("check", "examples/maps/office.yaml", "--heal", "1e-9")
    assert result.exit_code == 2
