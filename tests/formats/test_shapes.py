"""Shapes of other programs: GeoJSON and WKT; layers and the record of reading."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

import cfree
from cfree.errors import FormatError
from cfree.formats.drawings.source import Source, shapes_of
from cfree.formats.scene_file import load_polygons, load_scene, load_shapes
from cfree.formats.shapes import Shape, Shapes
from cfree.polygons.polygon import Polygon
from cfree.scene.reading import MOST_POINTS, Note
from cfree.scene.scene import Scene
from scene_texts import GEOJSON, WKT, faults, read


@pytest.mark.parametrize(
    ("text", "name"),
    [(GEOJSON, "map.geojson"), (GEOJSON, "map.json"), (WKT, "map.wkt"), (WKT, "map.txt")],
)
def test_geojson_and_wkt_hold_the_same_scene(text: str, name: str, tmp_path: Path) -> None:
    scene = read(tmp_path, text, name)
    assert scene == Scene(
        robot=[(0, 0), (1, 0), (0, "0.1")],
        obstacles=[
            Polygon([(5, 5), (9, 5), (5, 9)], [[(6, 6), (6, 7), (7, 6)]]),
            [(1, 5), (2, 5), (1, 6)],
            [(11, 5), (12, 5), (11, 6)],
        ],
        obstacle_names=["lakes", "lakes", None],
        workspace=[(-9, -9), (20, -9), (20, 20), (-9, 20)],
    )
    assert len(load_polygons(tmp_path / name)) == 5


def test_one_geometry_is_geojson_too(tmp_path: Path) -> None:
    file = tmp_path / "a.json"
    file.write_text('{"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [0, 0.1]]]}')
    assert load_polygons(file) == (Polygon([(0, 0), (1, 0), (0, "0.1")]),)
    with pytest.raises(FormatError, match='there is no robot; give its feature the property "role": "robot"'):
        load_scene(file)


def test_faults_of_geojson_are_placed(tmp_path: Path) -> None:
    text = """{"type": "FeatureCollection", "features": [
 {"type": "Feature", "properties": {"role": "robto", "name": 5},
  "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], ["a", 1]]]}},
 {"type": "Feature", "properties": null, "geometry": {"type": "LineString", "coordinates": [[0, 0], [1, 0]]}},
 {"type": "Feature", "properties": null, "geometry": null},
 {"type": "MultiPolygon",
  "coordinates": [[[[0, 0], [4, 0], [0, 4]], [[5, 5], [6, 5], [5, 6]]], [[[0, 0], [1, 0]]]]},
 {"type": "Polygon"}, {"type": ["a"]}, 7, {"type": "FeatureCollection"}, {"type": "Feature"}
]}"""
    assert faults(tmp_path, text, "map.geojson") == [
        'map.geojson:2:45 features[0].properties.role: expected one of robot, obstacle, workspace, ignore, got "robto"',
        "map.geojson:2:62 features[0].properties.name: expected text in quotes, got 5",
        'map.geojson:3:69 features[0].geometry.coordinates[0][2][0]: expected a number or "p/q", got "a"',
        "map.geojson:7:46 features[3].coordinates[0][1]: "
        "hole 0: it lies outside the outer ring; move it, or leave it out, or give --repair",
        "map.geojson:7:74 features[3].coordinates[1][0]: outer ring: 2 points; give at least 3: "
        "shapes are closures of their interiors: a segment or a point forbids nothing",
        'map.geojson:8:2 features[4]: a Polygon needs "coordinates"',
        'map.geojson:8:23 features[5]: expected a GeoJSON feature or geometry with polygons, got {"type": ["a"]}',
        "map.geojson:8:40 features[6]: expected a GeoJSON feature or geometry with polygons, got 7",
        'map.geojson:8:43 features[7]: a FeatureCollection needs a list "features"',
        'map.geojson:8:74 features[8]: expected a GeoJSON feature or geometry with polygons, got {"type": "Feature"}',
    ]


def test_faults_of_wkt_are_placed(tmp_path: Path) -> None:
    text = """lake: POLYGON ((0 0, 1 0, x/3 nan))
POLYGON ((0 0, 1 0, 0 1)
POLYGON Z ((0 0, 1 0, 0 1))
POLYGON FULL
LINESTRING (0 0, 1 1)
POLYGON ((0 0, 4 0, 0 4), (5 5, 6 5, 5 6))
POLYGON ((0 0, 4 0, 0 4)) foo
POLYGON ((0 0, 4, 0 4))
hello
MULTIPOLYGON (((0 0, 1 0, 0 1)), ((0 0, 1 0)))
"""
    reason = "shapes are closures of their interiors: a segment or a point forbids nothing"
    assert faults(tmp_path, text, "a.wkt") == [
        "a.wkt:1:27 lake: 'x/3' is no number; write it like '0.1', '-2e3' or '1/3'",
        "a.wkt:1:31 lake: NaN is not finite; give a finite number",
        'a.wkt:2:25 expected "," or ")", got the end of the line',
        "a.wkt:3:16 expected 3 numbers a point, got ,",
        'a.wkt:4:9 expected "(", got FULL',
        f"a.wkt:5:1 LINESTRING: {reason}; give it width",
        "a.wkt:6:27 hole 0: it lies outside the outer ring; move it, or leave it out, or give --repair",
        "a.wkt:7:27 expected the end of the line, got foo",
        "a.wkt:8:17 expected two numbers x y, got ,",
        "a.wkt:9:1 expected POLYGON (...) or MULTIPOLYGON (...), got hello",
        f"a.wkt:10:35 outer ring: 2 points; give at least 3: {reason}",
    ]


@pytest.mark.parametrize(
    "line",
    [
        "POLYGON Z ((3 0 7, 4 0 8, 4 1 9, 3 0 7))",
        "POLYGONZ((3 0 7, 4 0 8, 4 1 9))",
        "polygon m ((3 0 1, 4 0 2, 4 1 3))",
        "MULTIPOLYGON ZM (((3 0 1 2, 4 0 1 2, 4 1 1 2)), EMPTY)",
        "SRID=4326;POLYGON((3 0, 4 0, 4 1), EMPTY)",
        "lake: srid = 25832 ; POLYGON ((3 0 1, 4 0 1, 4 1 1))",
    ],
)
def test_wkt_is_read_as_databases_write_it(line: str, tmp_path: Path) -> None:
    empty = "POLYGON EMPTY\nSRID=4326;MULTIPOLYGON Z EMPTY\n"
    scene = read(tmp_path, f"robot: POLYGON ((0 0, 1 0, 0 1))\n{empty}{line}\n", "map.wkt")
    assert scene.obstacles == (Polygon([(3, 0), (4, 0), (4, 1)]),)
    assert scene.obstacle_names == ("lake" if line.startswith("lake") else "obstacle 0",)


# the record of reading


def source_of(*notes: Note, shapes: Sequence[Shape] = ()) -> Shapes:
    """Shapes as a reader gives them."""
    source = Source("folder/plan.dxf")
    for note in notes:
        source.note(note.kind, note.what, note.effect, count=note.count, where=note.where)  # type: ignore[arg-type]
    return shapes_of(source, "DXF", list(shapes), {}, "draw it")


LOST = Note("lost", "open line", "less", 3, "A-WALL")
DESK = Shape("obstacle", "desk", Polygon([(5, 5), (9, 5), (5, 9)]))
ROBOT = Shape("robot", None, Polygon([(0, 0), (1, 0), (0, 1)]))


def test_layers_have_their_shapes_and_notes() -> None:
    shapes = source_of(LOST, Note("guess", "outline", "more", 1, "desk"), shapes=[ROBOT, DESK, DESK])
    assert list(shapes.layers) == ["robot", "desk", "A-WALL"]
    desk, wall = shapes.layers["desk"], shapes.layers["A-WALL"]
    assert desk.shapes == (DESK, DESK) and [note.kind for note in desk.reading] == ["guess"]
    assert wall.shapes == () and [note.count for note in wall.reading] == [3]


def test_the_text_of_shapes_tells_counts_and_losses() -> None:
    assert repr(source_of(LOST, Note("info", "unit"), shapes=[DESK, ROBOT, DESK])) == (
        "<Shapes of plan.dxf (DXF): 1 robot, 2 obstacles; 3 losses: 3 open lines of A-WALL>"
    )
    assert repr(source_of()) == "<Shapes of plan.dxf (DXF): none; no losses>"


def test_the_scene_of_shapes_has_their_record_and_that_of_its_robot() -> None:
    shapes, robot = source_of(LOST, shapes=[DESK]), source_of(Note("lost", "point", "less"), shapes=[ROBOT])
    scene = shapes.scene(replace(robot, file="robot.svg"))
    assert [(note.what, note.file) for note in scene.reading] == [("open line", "plan.dxf"), ("point", "robot.svg")]
    assert scene.robot == (ROBOT.polygon,)
    assert [note.what for note in shapes.scene(ROBOT.polygon).reading] == ["open line"]


def test_no_shape_at_all_is_never_silent() -> None:
    assert [note.what for note in source_of().reading] == ["nothing is drawn in plan.dxf"]
    assert [note.what for note in source_of(Note("info", "a user unit is 2 mm")).reading] == [
        "a user unit is 2 mm", "nothing is drawn in plan.dxf",
    ]  # fmt: skip
    assert [note.what for note in source_of(LOST).reading] == ["open line"]
    assert [note.what for note in source_of(Note("info", "shape ignored", where="desk")).reading] == ["shape ignored"]
    bare = source_of(shapes=[ROBOT]).scene()
    assert [note.what for note in bare.reading] == ["nothing forbids a pose: no obstacle and no workspace"]


def test_items_of_notes_have_places_and_lines_for_pictures() -> None:
    source = Source("plan.dxf")
    line = [(0.0, float(k)) for k in range(500)]
    source.note("lost", "open line", "less", at=(0, 0), size=499, handle="5F", points=line)
    source.note("lost", "open line", "less", points=line[:2])
    (note,) = source.notes
    first, second = note.items
    assert (first.handle, first.at, first.size, len(first.points)) == ("5F", (0, 0), 499, MOST_POINTS)
    assert second.points == ((0, 0), (0, 1))


def test_a_missing_robot_names_the_option_that_gives_one(tmp_path: Path) -> None:
    svg = '<svg xmlns="http://www.w3.org/2000/svg">{}</svg>'
    (tmp_path / "a.svg").write_text(svg.format('<rect width="9" height="9"/>'))
    (tmp_path / "line.svg").write_text(svg.format('<path fill="none" d="M 0 0 H 9"/>'))
    shapes = load_shapes(tmp_path / "a.svg")
    with pytest.raises(FormatError, match=r'a\.svg: there is no robot; call .* "robot", or give --robot with a file'):
        shapes.scene()
    with pytest.raises(FormatError, match=r"line\.svg: nothing in it can be the robot; draw its outline closed"):
        shapes.scene(load_shapes(tmp_path / "line.svg"))


def test_a_scene_without_a_known_unit_has_that_of_its_robot(tmp_path: Path) -> None:
    svg = '<svg xmlns="http://www.w3.org/2000/svg"{}><rect width="9" height="9"/></svg>'
    (tmp_path / "plan.svg").write_text(svg.format(""))
    (tmp_path / "robot.svg").write_text(svg.format(' width="9mm" height="9mm" viewBox="0 0 9 9"'))
    plan, robot = (load_shapes(tmp_path / f"{name}.svg") for name in ("plan", "robot"))
    assert (plan.settings["units"], plan.scene(robot).units, robot.scene(plan).units) == ("px", "mm", "mm")
    assert "no unit in plan.svg, taken as mm" in [note.what for note in plan.scene(robot).reading]


def test_a_role_of_a_name_that_no_file_has_is_warned_of(tmp_path: Path) -> None:
    svg = '<svg xmlns="http://www.w3.org/2000/svg"><rect id="{}" width="9" height="9"/></svg>'
    (tmp_path / "plan.svg").write_text(svg.format("walls"))
    (tmp_path / "body.svg").write_text(svg.format("body"))
    roles = {"wall": "workspace", "walls": "workspace", "body": "robot"}
    plan, body = (load_shapes(tmp_path / f"{name}.svg", roles=roles) for name in ("plan", "body"))
    assert plan.roles == {"wall": False, "walls": True, "body": False}
    scene = plan.scene(body)
    assert scene.workspace and [note.what for note in scene.reading if note.kind == "warning"] == [
        'role without effect: nothing is called "wall"'
    ]


def test_padding_pads_the_robot_of_a_file_of_any_kind(tmp_path: Path) -> None:
    svg = '<svg xmlns="http://www.w3.org/2000/svg" width="90{0}" height="90{0}" viewBox="0 0 90 90">{1}</svg>'
    (tmp_path / "plan.svg").write_text(svg.format("mm", '<rect x="50" width="9" height="9"/>'))
    (tmp_path / "robot.svg").write_text(svg.format("cm", '<path d="M -2 -1 H 2 V 1 H -2 Z"/>'))
    (tmp_path / "disc.svg").write_text(svg.format("mm", '<circle id="robot" r="2"/>'))
    plan = load_shapes(tmp_path / "plan.svg", padding=0.5)
    padded = plan.scene(load_shapes(tmp_path / "robot.svg", padding=0.5))
    assert padded.robot[0].bounds == (-25, -15, 25, 15) and "padding by nav2's rule" in [n.what for n in padded.reading]
    assert plan.scene([(-2, -1), (2, -1), (2, 1), (-2, 1)]).robot[0].bounds == (-2.5, -1.5, 2.5, 1.5)
    moved = plan.scene([(0, 0), (4, 0), (4, 2), (0, 2)], pivot="centroid")
    assert moved.robot[0].bounds == (-2.5, -1.5, 2.5, 1.5), "padded about the reference point"
    (disc,) = load_shapes(tmp_path / "disc.svg", padding=0.5, curves=True).scene().robot
    assert disc.box[2] >= 2.7


def test_a_scale_between_two_units_without_a_new_unit_is_warned_of(tmp_path: Path) -> None:
    size = 'width="9mm" height="9mm" viewBox="0 0 9 9"'
    text = f'<svg xmlns="http://www.w3.org/2000/svg" {size}><rect width="9" height="9"/></svg>'
    (tmp_path / "a.svg").write_text(text)
    options = ("1/1000", ""), (2, ""), ("1/1000", "m")
    notes = [load_shapes(tmp_path / "a.svg", scale=scale, units=unit).reading for scale, unit in options]
    assert [[(note.kind, note.remedy) for note in some if "multiplied" in note.what] for some in notes] == [
        [("warning", "--units m")], [("info", "")], [("info", "")],
    ]  # fmt: skip


def test_lengths_of_a_scaled_file_have_the_unit_of_the_scene(tmp_path: Path) -> None:
    text = '<svg xmlns="http://www.w3.org/2000/svg"><circle r="30"/><line x1="1" x2="4" stroke="red"/></svg>'
    (tmp_path / "a.svg").write_text(text)
    plain = cfree.load_shapes(tmp_path / "a.svg", tolerance=0.1)
    scaled = cfree.load_shapes(tmp_path / "a.svg", tolerance=100, scale=1000)
    assert [p.exact_area * 10**6 for p in plain.polygons] == [p.exact_area for p in scaled.polygons]
    assert {note.size for note in scaled.reading if note.kind == "near"} == {100}
    (lost,) = [note for note in scaled.reading if note.kind == "lost"]
    assert [item.points for item in lost.items if item.points] == [((1000, 0), (4000, 0))]
    cfree.load_shapes(tmp_path / "a.svg", tolerance=1e9, scale="1e-320")  # no double, and no fault


def test_names_of_wkt_take_roles(tmp_path: Path) -> None:
    (tmp_path / "a.wkt").write_text("walls: POLYGON ((0 0, 1 0, 0 1))\nbot: POLYGON ((5 0, 6 0, 5 1))")
    shapes = cfree.load_shapes(tmp_path / "a.wkt", roles={"bot": "robot", "walls": "ignore"})
    assert [(shape.role, shape.name) for shape in shapes.shapes] == [("robot", "bot")]
    assert [(note.kind, note.effect, note.where) for note in shapes.reading] == [("assumption", "less", "walls")]


def test_strokes_wider_than_any_drawing_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"strokes: 1e\+300; give a width above 0 and below 1e150"):
        cfree.load_shapes(tmp_path / "a.svg", strokes=1e300)


def test_a_scale_beyond_doubles_is_refused_by_its_name(tmp_path: Path) -> None:
    (tmp_path / "a.wkt").write_text("POLYGON ((0 0, 1e200 0, 0 1))")
    with pytest.raises(ValueError, match=r"scale: the shapes would be too large: .*beyond 4e307"):
        cfree.load_shapes(tmp_path / "a.wkt", scale="1e200")
