"""GeoJSON: lines with a width and points with a radius are walls; what forbids nothing is said.

Polygons read while the file is decoded are those of its numbers, with the same faults.
"""

import json
import random
import tracemalloc
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest

from cfree.errors import FormatError
from cfree.formats.drawings.source import Reading, Source
from cfree.formats.readers import _read_geojson, read_file, read_json_file
from cfree.formats.shapes import Shapes
from cfree.formats.text.findings import Findings
from cfree.formats.text.json_text import read_literals
from scene_texts import place_in

SQUARE = {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]]]}


def feature(geometry: Any, **properties: Any) -> dict[str, Any]:
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def shape(kind: str, coordinates: Any) -> dict[str, Any]:
    return {"type": kind, "coordinates": coordinates}


def read(folder: Path, *features: Any, **options: Any) -> Shapes:
    (folder / "a.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    shapes = read_file(folder / "a.geojson", Reading(**options))
    assert isinstance(shapes, Shapes)
    return shapes


def noted(shapes: Shapes) -> list[tuple[str, str, str, int]]:
    return [(note.kind, note.what, note.where, note.count) for note in shapes.reading]


def test_a_line_with_a_width_is_a_wall(tmp_path: Path) -> None:
    line = shape("LineString", [[0, 0], [10, 0]])
    shapes = read(tmp_path, feature(line, name="wall", width=0.5))
    (wall,) = shapes.of("obstacle")
    assert wall.name == "wall"
    assert float(wall.polygon.exact_area) == pytest.approx(5 + 3.1416 / 16, rel=0.01)
    assert wall.polygon.bounds == (-0.25, -0.25, 10.25, 0.25)
    again = read(tmp_path, feature(line), strokes=0.5)
    assert again.shapes[0].polygon == wall.polygon
    lines = shape("MultiLineString", [[[0, 0], [1, 0]], [[5, 0], [6, 0], [6, 2]]])
    assert len(read(tmp_path, feature(lines, width="1/3")).shapes) == 3


def test_a_point_with_a_radius_is_a_disc(tmp_path: Path) -> None:
    shapes = read(tmp_path, feature(shape("Point", [1, 2]), name="tree", radius=0.5))
    (tree,) = shapes.of("obstacle")
    assert 0.7854 < float(tree.polygon.exact_area) < 0.79
    assert tree.polygon.bounds == (0.5, 1.5, 1.5, 2.5)
    assert len(read(tmp_path, feature(shape("MultiPoint", [[0, 0], [4, 4]]), radius=1)).shapes) == 2


def test_geometries_without_a_width_are_said_and_cost_only_themselves(tmp_path: Path) -> None:
    shapes = read(
        tmp_path,
        feature(SQUARE),
        feature(shape("Point", [1, 1]), name="poi"),
        feature(shape("LineString", [[0, 0], [9, 12]]), name="route"),
        feature(None, name="nothing"),
        feature(shape("MultiPolygon", [])),
    )
    assert len(shapes.shapes) == 1
    assert noted(shapes) == [
        ("lost", "open line", "route", 1),
        ("lost", "point without a radius", "poi", 1),
        ("info", "feature without a geometry", "nothing", 1),
        ("info", "geometry without coordinates", "", 1),
    ]
    line = shapes.reading[0]
    assert (line.size, line.at, line.remedy) == (15, (0, 0), "--strokes 0.1")


def test_features_can_be_ignored_before_they_are_refused(tmp_path: Path) -> None:
    bad = feature(shape("Polygon", [[[0, 0], [1, 0]]]), name="draft", role="ignore")
    assert noted(read(tmp_path, feature(SQUARE), bad)) == [("hidden", "feature that is ignored", "draft", 1)]
    bad["properties"].pop("role")
    shapes = read(tmp_path, feature(SQUARE), bad, roles={"draft": "ignore"})
    assert noted(shapes) == [("assumption", "feature that is ignored", "draft", 1)]
    with pytest.raises(FormatError, match="outer ring: 2 points"):
        read(tmp_path, feature(SQUARE), bad)


def test_roles_by_name_count_before_the_property(tmp_path: Path) -> None:
    shapes = read(tmp_path, feature(SQUARE, name="agv", role="obstacle"), roles={"agv": "robot"})
    assert [shape.role for shape in shapes.shapes] == ["robot"]


def test_collections_have_the_width_of_their_feature(tmp_path: Path) -> None:
    both = {"type": "GeometryCollection", "geometries": [SQUARE, shape("LineString", [[9, 0], [9, 5]])]}
    assert len(read(tmp_path, feature(both, width=1)).shapes) == 2
    with pytest.raises(FormatError, match="a workspace needs a Polygon, and this is a LineString"):
        read(tmp_path, feature(both, width=1, role="workspace"))


@pytest.mark.parametrize("width", [-1, "wide", [1]])
def test_a_width_that_is_none_is_a_fault(width: Any, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"properties.width: expected a length, 0 or more, below 1e150, got"):
        read(tmp_path, feature(shape("LineString", [[0, 0], [1, 0]]), width=width))


def test_repair_unites_the_polygons_of_a_geometry(tmp_path: Path) -> None:
    tie = shape("Polygon", [[[0, 0], [4, 4], [4, 0], [0, 4], [0, 0]]])
    with pytest.raises(FormatError, match=r"edges 0 and 2 cross at \(2, 2\); split it .*, or give --repair"):
        read(tmp_path, feature(tie))
    shapes = read(tmp_path, feature(tie, name="tie"), repair=True)
    assert [float(s.polygon.exact_area) for s in shapes.shapes] == [4, 4]
    assert noted(shapes) == [("mended", "polygon that crosses itself or others", "tie", 1)]
    boxes = [[[[x, 0], [x + 4, 0], [x + 4, 4], [x, 4], [x, 0]]] for x in (0, 2)]
    (one,) = read(tmp_path, feature(shape("MultiPolygon", boxes)), repair=True).shapes
    assert one.polygon.exact_area == 24
    with pytest.raises(FormatError, match=r"coordinates\[0\]\[1\]"):  # faults of numbers stay faults
        read(tmp_path, feature(shape("Polygon", [[[0, 0], ["x", 1], [1, 1]]])), repair=True)
    assert not read(tmp_path, feature(shape("Polygon", [[]])), repair=True).shapes


def test_lines_and_points_too_far_away_or_too_wide_are_faults_with_their_place(tmp_path: Path) -> None:
    far = 10**200
    with pytest.raises(FormatError, match=r"a.geojson:1:\d+ .*a coordinate beyond 1e150; scale the drawing"):
        read(tmp_path, feature(shape("LineString", [[0, 0], [far, 0]]), width=1))
    with pytest.raises(FormatError, match=r"radius: expected a length, 0 or more, below 1e150"):
        read(tmp_path, feature(shape("Point", [0, 0]), radius=far))


def test_the_error_of_a_disc_with_the_most_sides_is_said(tmp_path: Path) -> None:
    shapes = read(tmp_path, feature(shape("Point", [0, 0]), radius=9), tolerance=1e-6)
    (note,) = [note for note in shapes.reading if note.kind == "near"]
    farthest = max((float(x) ** 2 + float(y) ** 2) ** 0.5 for x, y in shapes.shapes[0].polygon.exact_vertices)
    assert note.size is not None and 1e-6 < farthest - 9 <= note.size * 1.0001


RING: Any = [[0, 0, 7], ["4", 0], [4.5, 4e0], [0, "9/2"], [0, 0]]
HOLED = [RING, [[1, 1], [2, 1], [1, 2]]]
CAR = feature(shape("Polygon", [[[0, 0], [1, 0], [0, 1]]]), role="robot", check={"a": [1, 0.5]}, start=[9, 9, 0])
RICH: Any = {
    "type": "FeatureCollection",
    "features": [
        CAR,
        feature(shape("Polygon", HOLED), name="house"),
        {**feature(shape("MultiPolygon", [HOLED, [[[9, 0], [9.25, 0], [9, "1/3"]]]])), "id": 3, "bbox": [0, 0, 9, 9]},
        feature(shape("Polygon", [RING]), role="ignore", name="tree"),
        feature({"type": "GeometryCollection", "geometries": [SQUARE, shape("LineString", [[0, 0], [1, 1]])]}, width=1),
        {"type": "FeatureCollection", "features": [feature(SQUARE, role="workspace")]},
        SQUARE,
    ],
}
ODD: tuple[Any, ...] = (
    None, True, -1.5, 1e400, "", "1/0", [], {}, [0, 0], [[]], [0, 0, "x"], {"outer": RING}, [[0, 0], [2, 2], [2, 0]],
    {"outer": [[0, 0], [1, 0], [0, 1]]}, {"outer": [[0, 0], [1, 0], [0, 1]], "name": None}, SQUARE, CAR, feature(CAR),
    "Feature", "Polygon", "MultiPolygon", "robot", feature(SQUARE, role="robot", check={"a": CAR}), {"answer": 1},
)  # fmt: skip


def told(read: Any) -> Any:
    """What a reader gives, as it can be compared: shapes, settings and notes, or the faults with their places."""
    try:
        shapes = read()
    except FormatError as error:
        return str(error)
    return shapes.shapes, repr(shapes.settings), shapes.reading, [shape.polygon.removed for shape in shapes.shapes]


def both_agree(data: Any) -> bool:
    """True if GeoJSON has shapes; those read while it is decoded are those of its numbers."""
    text = json.dumps(data)
    findings, source = Findings("a.geojson", text), Source("a.geojson")
    source.findings = findings
    in_full = told(lambda: _read_geojson(source, read_literals(findings)))
    assert told(lambda: read_json_file(Findings("a.geojson", text))) == in_full, text
    return not isinstance(in_full, str)


@pytest.mark.parametrize("data", [RICH, CAR, feature(SQUARE), feature(SQUARE, role="robot", check={"a": CAR})])
def test_features_are_read_while_they_are_decoded(data: Any) -> None:
    assert both_agree(data)


@pytest.mark.slow
def test_whatever_is_changed_features_are_read_as_by_their_numbers() -> None:
    rng, kept = random.Random(5), 0
    for _ in range(500):
        data = deepcopy(RICH)
        around, step = place_in(data, rng, 0.2)
        if rng.random() < 0.2:
            del around[step]
        else:
            around[step] = rng.choice(ODD)
        if isinstance(data, dict) and "type" in data and "answer" not in data:
            kept += both_agree(data)
    assert 40 < kept < 450


def test_numbers_of_features_are_not_kept_while_others_are_read() -> None:
    rings = [[[9 * k + 0.1, 0.2], [9 * k + 1.3, 0.4], [9 * k + 0.5, 1.6], [9 * k + 0.7, 0.8]] for k in range(500)]
    text = json.dumps({"type": "FeatureCollection", "features": [feature(shape("Polygon", [ring])) for ring in rings]})
    read_json_file(Findings("a.geojson", text))
    tracemalloc.start()
    shapes = read_json_file(Findings("a.geojson", text))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert isinstance(shapes, Shapes) and len(shapes.shapes) == 500
    assert peak < 2000 * 200  # with all numbers 1,000 a vertex
