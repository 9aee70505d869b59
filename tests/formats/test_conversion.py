"""`cfree.convert`: files of any kind become files of another, with the record of reading."""

import json
from pathlib import Path
from typing import Any

import pytest

import cfree
import drawings
from cfree.errors import UnsupportedError
from cfree.scene.reading import Note

FOOTPRINT = "[[0.1, 0], [0, 0.1], [-0.1, 0]]"
ROUND = Path("examples/scenes/round_disc.json")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    drawings.put(tmp_path)
    return tmp_path


def test_a_converted_file_has_the_scene_that_is_returned(folder: Path) -> None:
    scene = cfree.convert(folder / "map.yaml", folder / "a.json", robot=cfree.footprint(FOOTPRINT), unknown="free")
    assert (
        cfree.load_scene(folder / "a.json")
        == scene
        == cfree.load_shapes(folder / "map.yaml", unknown="free").scene(cfree.footprint(FOOTPRINT))
    )
    assert scene.reading and cfree.load_scene(folder / "a.json").reading == scene.reading
    assert {note.file for note in scene.reading} == {"map.yaml"}


def test_the_robot_may_be_a_file_with_its_own_record(folder: Path) -> None:
    by_file = cfree.convert(folder / "map.yaml", folder / "a.json", robot=folder / "nav.yaml")
    by_shapes = cfree.load_shapes(folder / "map.yaml").scene(cfree.load_shapes(folder / "nav.yaml"))
    assert by_file == by_shapes and by_file.reading == by_shapes.reading
    assert {note.file for note in by_file.reading} == {"map.yaml", "nav.yaml"}


def test_notes_about_writing_are_returned(tmp_path: Path) -> None:
    triangle = [(0, 0), ("1/3", 0), (0, 1)]
    cfree.save(cfree.Scene(triangle, [triangle]), tmp_path / "thirds.json")
    scene = cfree.convert(tmp_path / "thirds.json", tmp_path / "thirds.svg")
    assert scene.reading == (Note("near", "number rounded to 14 digits", "near", 2),)
    straight = cfree.convert(ROUND, tmp_path / "round.svg", tolerance=0.01)
    (note,) = straight.reading
    assert (note.kind, note.effect, note.size) == ("near", "near", 0.01)
    assert cfree.load_scene(tmp_path / "round.svg").reading[0].what == "polygon around a round shape"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"outer": 1.0, "inner": 1.0}, "outer and inner: give one of them"),
        ({"outer": 0.0}, "outer: 0.0; give a length above 0"),
        ({"tolerance": -1.0}, "tolerance: -1.0; give a length above 0"),
        ({"robot": 3}, "robot"),
    ],
)
def test_wrong_options_leave_no_file(options: dict[str, Any], message: str, tmp_path: Path) -> None:
    with pytest.raises((TypeError, ValueError), match=message):
        cfree.convert(ROUND, tmp_path / "a.json", **options)
    assert not (tmp_path / "a.json").exists()
    with pytest.raises(UnsupportedError, match=r"name the file \.json"):
        cfree.convert(ROUND, tmp_path / "a.stl")


def test_polygons_around_and_inside_are_written(tmp_path: Path) -> None:
    around = cfree.convert(ROUND, tmp_path / "a.json", outer=0.01)
    inside = cfree.convert(ROUND, tmp_path / "b.json", inner=0.01)
    assert not around.curved and not inside.curved and around != inside
    record = json.loads((tmp_path / "b.json").read_text())["reading"][0]
    assert (record["what"], record["size"]) == ("polygon inside a round shape", 0.01)


def test_options_about_the_scene_alone_have_no_effect_on_a_robot_file(tmp_path: Path) -> None:
    svg = '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm" viewBox="0 0 9 9">{}</svg>'
    drawn = '<path fill="none" d="M 0 0 L 5 5"/><rect x="6" width="2" height="2"/>'
    (tmp_path / "plan.svg").write_text(svg.format(drawn))
    (tmp_path / "robot.svg").write_text(svg.format('<path fill="none" d="M 0 0 H 1 V 1 H 0 Z M 3 3 H 4"/>'))
    options: dict[str, Any] = {"strokes": 0.1, "min_area": 2.0, "scale": 2, "units": "mm"}
    scene = cfree.convert(tmp_path / "plan.svg", tmp_path / "a.json", robot=tmp_path / "robot.svg", **options)
    (robot,) = scene.robot
    assert robot.area == 1, "an outline with strokes would be hollow"
    assert any(shape.area == 16 for shape in scene.obstacles) and len(scene.obstacles) > 1
    (lost,) = (note for note in scene.reading if note.kind == "lost")
    assert lost.file == "robot.svg" and lost.remedy == "close the outline in the drawing"
