"""The option `repair`: on for drawings, off for WKT and GeoJSON, and noted."""

import json
from pathlib import Path

import pytest

import cfree
from cfree import load_shapes
from cfree.errors import FormatError
from cfree.formats.drawings.source import Reading
from cfree.formats.readers import read_file
from cfree.formats.shapes import Shapes

RING = "[[0, 0], [4, 4], [4, 0], [0, 4]]"
BOW_TIE = "((0 0, 4 4, 4 0, 0 4, 0 0))"


def read(path: Path, text: str, **options: object) -> Shapes:
    path.write_text(text)
    shapes = read_file(path, Reading(**options))  # type: ignore[arg-type]
    assert isinstance(shapes, Shapes)
    return shapes


def test_errors_of_polygons_that_cross_name_the_option(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"edges 0 and 2 cross at \(2, 2\); split it .*, or give --repair"):
        read(tmp_path / "a.wkt", f"POLYGON {BOW_TIE}")


def test_repaired_polygons_are_noted(tmp_path: Path) -> None:
    shapes = read(tmp_path / "a.wkt", f"desk: POLYGON {BOW_TIE}\nPOLYGON ((9 0, 10 0, 10 1))", repair=True)
    assert [(shape.name, float(shape.polygon.exact_area)) for shape in shapes.shapes] == [
        ("desk", 4),
        ("desk", 4),
        (None, 0.5),
    ]
    (note,) = shapes.reading
    assert (note.kind, note.where, note.at) == ("mended", "desk", (0, 0))


def test_geojson_is_repaired_by_the_option_alone(tmp_path: Path) -> None:
    bow_tie, overlapping = [[0, 0], [4, 4], [4, 0], [0, 4]], [[[[0, 0], [4, 0], [4, 4]]], [[[3, 0], [4, 0], [4, 9]]]]
    text = json.dumps({"type": "Polygon", "coordinates": [bow_tie]})
    with pytest.raises(FormatError, match=r"edges 0 and 2 cross at \(2, 2\); split it .*, or give --repair"):
        read(tmp_path / "a.geojson", text)
    shapes = read(tmp_path / "a.geojson", text, repair=True)
    assert [shape.polygon.exact_area for shape in shapes.shapes] == [4, 4]
    assert [note.kind for note in shapes.reading] == ["mended"]
    several = json.dumps({"type": "MultiPolygon", "coordinates": overlapping})
    assert len(read(tmp_path / "a.geojson", several).shapes) == 2
    assert len(read(tmp_path / "a.geojson", several, repair=True).shapes) == 1


def test_overlapping_parts_are_united(tmp_path: Path) -> None:
    parts = "workspace: MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4)), ((2 2, 6 2, 6 6, 2 6)))"
    (room,) = read(tmp_path / "a.wkt", parts, repair=True).shapes
    assert room.polygon.exact_area == 28
    apart = "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4)), ((7 7, 8 7, 8 8)))"
    shapes = read(tmp_path / "a.wkt", apart, repair=True)
    assert shapes.shapes == read(tmp_path / "a.wkt", apart).shapes
    assert not shapes.reading


def test_an_ambiguous_workspace_gets_the_least(tmp_path: Path) -> None:
    twice = "POLYGON ((0 0, 6 0, 6 6, 2 6, 2 2, 8 2, 8 8, 0 8))"
    areas = [
        float(sum(shape.polygon.exact_area for shape in read(tmp_path / "a.wkt", text, repair=True).shapes))
        for text in (twice, f"workspace: {twice}")
    ]
    assert areas[0] - areas[1] == 16


def test_a_polygon_on_a_line_is_a_loss(tmp_path: Path) -> None:
    shapes = read(tmp_path / "a.wkt", "POLYGON ((0 0, 4 0, 2 0, 0 0))", repair=True)
    assert not shapes.shapes
    assert [note.kind for note in shapes.reading] == ["lost"]


def test_drawings_are_repaired_unless_it_is_off(tmp_path: Path) -> None:
    text = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0 L4 4 L4 0 L0 4 Z"/></svg>'
    assert len(read(tmp_path / "a.svg", text).shapes) == 2
    with pytest.raises(FormatError, match=r"a.svg:1:1 .*crosses or touches itself at \(2, -?2\); --repair"):
        read(tmp_path / "a.svg", text, repair=False)


def test_shapes_below_the_least_area_are_an_assumption(tmp_path: Path) -> None:
    text = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h9v9h-9z"/><path d="M20 0h1v1h-1z"/></svg>'
    shapes = read(tmp_path / "a.svg", text, min_area=2.0)
    assert [shape.polygon.exact_area for shape in shapes.shapes] == [81]
    (note,) = (note for note in shapes.reading if note.kind == "assumption")
    assert (note.effect, note.size) == ("less", 1)


@pytest.mark.parametrize("name", ["a.wkt", "a.geojson", "a.json"])
def test_polygons_too_far_away_to_be_repaired_are_refused_with_their_place(name: str, tmp_path: Path) -> None:
    far = f"1{'0' * 320}"
    ring = f"[[0, 0], [{far}, 0], [0, 1], [0, 0]]"
    text = {
        "a.wkt": f"POLYGON ((0 0, {far} 0, 0 1))",
        "a.geojson": f'{{"type": "Polygon", "coordinates": [{ring}]}}',
        "a.json": f'{{"robot": {ring}}}',
    }[name]
    with pytest.raises(FormatError, match=rf"{name}:1:\d+ .*beyond"):
        read(tmp_path / name, text, repair=True)


def test_repair_of_a_scene_leaves_its_faults_to_the_reader(tmp_path: Path) -> None:
    for text in ('{"robot": []}', '{"robot": {"outer": [[0, 0], [1, 0], [0, 1]], "holes": null}}', '{"workspace": []}'):
        with pytest.raises(FormatError, match=r"a\.json:1"):
            read(tmp_path / "a.json", text, repair=True)


def test_repaired_is_public() -> None:
    assert "repaired" in dir(cfree)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.geojson", '{"type": "Polygon", "coordinates": [RING]}'),
        ("a.json", '{"robot": [[0, 0], [1, 0], [0, 1]], "obstacles": [{"name": "desk", "outer": RING}, RING]}'),
        ("b.json", '{"robot": RING, "obstacles": [[[9, 0], [10, 0], [9, 1]]]}'),
        ("n.json", '{"items": [{"id": 0, "shape": {"type": "simple_polygon", "data": RING}}]}'),
    ],
)
def test_rings_of_json_are_repaired_with_the_option_alone(name: str, text: str, tmp_path: Path) -> None:
    file = tmp_path / name
    file.write_text(text.replace("RING", RING))
    with pytest.raises(FormatError, match=r"edges 0 and 2 cross at \(2, 2\)"):
        load_shapes(file)
    shapes = load_shapes(file, repair=True)
    assert {float(shape.polygon.exact_area) for shape in shapes.shapes} <= {4, 0.5}
    assert "mended" in {note.kind for note in shapes.reading}


def test_scenes_without_faults_are_the_same_with_repair(tmp_path: Path) -> None:
    file = tmp_path / "a.json"
    file.write_text(
        '{"robot": {"outer": [[0, 0], [1, 0], [0, 1]]}, "obstacles": [{"grown": 1, "circle": [3, 3], "radius": 1}]}'
    )
    with pytest.raises(FormatError):
        load_shapes(file, repair=True)
    plain = load_shapes("examples/scenes/flat.json")
    assert load_shapes("examples/scenes/flat.json", repair=True) == plain
