"""DXF, entity by entity: the region that is drawn is the region that is read, and each loss is noted."""

import math
from io import BytesIO, StringIO
from pathlib import Path
from typing import Any

import ezdxf
import ezdxf.recover
import pytest
import shapely

import cfree
import dxf_drawings
from cfree.errors import FormatError
from cfree.formats.drawings import source as source_module
from cfree.formats.drawings.content import Lines
from cfree.formats.drawings.dxf import read_dxf
from cfree.formats.drawings.dxf_tags import mended
from cfree.formats.drawings.dxf_walk import Layers, Place, Walk
from cfree.formats.drawings.source import Reading, Source
from cfree.formats.readers import read_file
from cfree.formats.shapes import Shapes
from cfree.scene.reading import Note

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]


def plain(*entities: str, version: str = "") -> str:
    """Return a file of entities, each a line of codes and values."""
    rows = ["0", "SECTION", "2", "ENTITIES"]
    for entity in entities:
        rows += entity.split()
    head = ["0", "SECTION", "2", "HEADER", "9", "$ACADVER", "1", version, "0", "ENDSEC"] if version else []
    return "\n".join([*head, *rows, "0", "ENDSEC", "0", "EOF", ""])


def read(text: str, folder: Path, **options: Any) -> Shapes:
    (folder / "a.dxf").write_text(text)
    shapes = read_file(folder / "a.dxf", Reading(**options))
    assert isinstance(shapes, Shapes)
    return shapes


def written(document: Any) -> str:
    stream = StringIO()
    document.write(stream)
    return stream.getvalue()


def notes(shapes: Shapes, *kinds: str) -> list[Note]:
    return [note for note in shapes.reading if note.kind in kinds]


def areas(shapes: Shapes) -> list[float]:
    return sorted(round(float(shape.polygon.exact_area), 6) for shape in shapes.shapes)


LWPOLYLINE = "0 LWPOLYLINE 8 part 90 4 70 1 10 0 20 0 10 4 20 0 10 4 20 3 10 0 20 3"
LINE = "0 LINE 8 rest 10 0 20 0 30 0 11 1 21 0 31 0"


@pytest.mark.slow
@pytest.mark.parametrize("marked", [True, False])
@pytest.mark.parametrize("name", dxf_drawings.WAYS)
def test_each_kind_of_entity_is_the_region_that_is_drawn(name: str, marked: bool, tmp_path: Path) -> None:
    for seed in range(3):
        assert not dxf_drawings.fault(dxf_drawings.drawing(name, seed, marked=marked), tmp_path / "a.dxf")


@pytest.mark.parametrize("version", ["", "AC1009", "AC1015", "AC1027"])
def test_entities_without_markers_are_read_in_files_of_any_version(version: str, tmp_path: Path) -> None:
    shapes = read(plain(LWPOLYLINE, version=version), tmp_path)
    assert areas(shapes) == [12]
    mark = notes(shapes, "mended")[0]
    assert (mark.what, mark.count) == ("entity without subclass markers", 1)


def test_markers_are_found_in_a_file_without_a_version(tmp_path: Path) -> None:
    marked = LWPOLYLINE.replace("8 part", "5 6E 100 AcDbEntity 8 part 100 AcDbPolyline")
    shapes = read(plain(marked), tmp_path)
    assert areas(shapes) == [12] and not notes(shapes, "lost")
    assert mended(plain(marked).encode()).mended == 0


@pytest.mark.parametrize(
    ("entity", "fault"),
    [
        ("0 CIRCLE 5 6E 8 part 10 x 20 0 40 3", "CIRCLE that cannot be read: 'x' is no number"),
        (
            "0 SPLINE 5 6E 8 part 70 0 71 3 72 4 73 4 74 0 40 0 40 0 40 1 40 1 10 0 20 0 10 1 20 0 10 1 20 1 10 0 20 1",
            "SPLINE that is removed, since it is not valid",
        ),
        (
            "0 POLYLINE 5 6E 8 part 66 1 70 1 0 VERTEX 8 part 10 0 20 0 0 VERTEX 8 part 10 a 20 0 0 SEQEND 8 part",
            "POLYLINE that cannot be read: 'a' is no number",
        ),
        ("0 INSERT 5 6E 8 part 2 nowhere 10 0 20 0", "INSERT that is removed, since it is not valid"),
        ("0 CIRCLE 5 6E 8 part 10 nan 20 0 40 3", "CIRCLE that cannot be read: "),
        ("0 CIRCLE 5 6E 8 part 10 1 20 0 broken 40 3", "CIRCLE that cannot be read: a line is missing, or there "),
    ],
)
def test_a_bad_entity_costs_itself_and_is_named(entity: str, fault: str, tmp_path: Path) -> None:
    shapes = read(plain(LWPOLYLINE, entity, LINE), tmp_path)
    assert areas(shapes) == [12]
    bad = next(note for note in notes(shapes, "lost") if note.what.startswith(fault))
    assert (bad.where, bad.effect, bad.count) == ("part", "less", 1)
    assert bad.items[0].handle == f"6E, line {plain(LWPOLYLINE).splitlines().index('ENDSEC')}"


def test_a_file_with_damaged_tables_is_read_and_said(tmp_path: Path) -> None:
    document = ezdxf.new()
    document.modelspace().add_lwpolyline(SQUARE, close=True)
    text = written(document).replace("  2\nLAYER\n", "  2\nLAYER\n 70\nmany\n", 1)
    shapes = read(text, tmp_path)
    assert areas(shapes) == [16]
    assert notes(shapes, "mended")


def test_paper_space_is_read_if_it_alone_is_drawn_on_and_else_said(tmp_path: Path) -> None:
    document = ezdxf.new()
    document.layout("Layout1").add_lwpolyline(SQUARE, close=True)
    shapes = read(written(document), tmp_path)
    assert areas(shapes) == [16]
    assert [(note.what, note.where) for note in notes(shapes, "info")] == [
        ("paper space, read since the model space is empty", "Layout1")
    ]
    document.modelspace().add_circle((50, 50), 1)
    shapes = read(written(document), tmp_path)
    assert len(shapes.shapes) == 1
    (lost,) = notes(shapes, "lost")
    assert (lost.what, lost.where, lost.count) == ("entity in paper space", "Layout1", 1)
    assert lost.remedy == "--space Layout1"
    shapes = read(written(document), tmp_path, space="layout1")
    assert areas(shapes) == [16]
    assert [note.what for note in notes(shapes, "lost")] == ["entity in the model space"]
    with pytest.raises(FormatError, match="no layout 'Layout9'; give one of Model, Layout1"):
        read(written(document), tmp_path, space="Layout9")


def test_hidden_layers_and_entities_are_counted_and_are_no_loss(tmp_path: Path) -> None:
    document = ezdxf.new()
    document.layers.add("off").off()
    document.layers.add("cold").freeze()
    space = document.modelspace()
    block = document.blocks.new("B")
    block.add_lwpolyline([(20, 0), (21, 0), (21, 1)], close=True, dxfattribs={"layer": "shown"})
    block.add_circle((0, 0), 1)  # on layer 0: as its reference
    space.add_blockref("B", (0, 0), dxfattribs={"layer": "off"})
    space.add_blockref("B", (0, 0), dxfattribs={"layer": "cold"})
    for _ in range(3):
        space.add_circle((0, 0), 5, dxfattribs={"layer": "off"})
    space.add_circle((0, 0), 5, dxfattribs={"invisible": 1})
    shapes = read(written(document), tmp_path)
    assert areas(shapes) == [0.5]
    assert {(note.what, note.where): note.count for note in notes(shapes, "hidden")} == {
        ("entity on a layer that is off", "off"): 4,
        ("entity on a frozen layer", "cold"): 1,
        ("invisible entity", "0"): 1,
    }
    assert not notes(shapes, "lost")


def test_layers_that_are_not_plotted_are_read_and_said(tmp_path: Path) -> None:
    document = ezdxf.new()
    document.layers.add("help").dxf.plot = 0
    document.modelspace().add_lwpolyline(SQUARE, close=True, dxfattribs={"layer": "help"})
    shapes = read(written(document), tmp_path)
    assert areas(shapes) == [16]
    assert [(note.what, note.where) for note in notes(shapes, "info")] == [
        ("entity on a layer that is not plotted", "help")
    ]


def test_texts_are_paint_and_bodies_references_and_images_are_lost(tmp_path: Path) -> None:
    document = ezdxf.new("R2000")
    space = document.modelspace()
    space.add_text("a")
    space.add_mtext("b")
    space.add_point((1, 1))
    space.add_linear_dim(base=(0, 2), p1=(0, 0), p2=(3, 0)).render()
    space.add_region().sat = ("400 0 1 0",)
    space.add_xline((0, 0), (1, 1))
    with space.add_mesh().edit_data() as mesh:
        mesh.add_face([(0, 0, 0), (1, 0, 0), (1, 1, 0)])
    document.add_xref_def("other.dwg", "other")
    space.add_blockref("other", (0, 0))
    space.add_blockref("nowhere", (0, 0))
    shapes = read(written(document), tmp_path)
    assert {note.what: note.count for note in notes(shapes, "paint")} == {"text": 2, "point": 1, "dimension": 1}
    assert {note.what: note.count for note in notes(shapes, "lost")} == {
        "endless line": 1,
        "external reference": 1,
        "ACIS body": 1,
        "mesh": 1,
        "INSERT that is removed, since it is not valid": 1,
    }


def test_entities_of_other_kinds_are_named(tmp_path: Path) -> None:
    (note,) = notes(read(plain(LWPOLYLINE, "0 ROBOTS 8 part 10 1"), tmp_path), "lost")
    assert note.what == "ROBOTS entity"


def test_blocks_that_nothing_inserts_are_said(tmp_path: Path) -> None:
    document = ezdxf.new()
    document.blocks.new("PART").add_circle((0, 0), 2)
    (note,) = read(written(document), tmp_path).reading
    assert (note.kind, note.what, note.where) == ("lost", "block that nothing inserts", "PART")


def test_heights_are_said(tmp_path: Path) -> None:
    def drawn(*heights: float) -> list[tuple[str, float | None]]:
        document = ezdxf.new()
        for k, z in enumerate(heights):
            document.modelspace().add_polyline3d([(x + 9 * k, y, z) for x, y in SQUARE], close=True)
        shapes = read(written(document), tmp_path)
        assert areas(shapes) == [16] * len(heights)
        return [(note.what, note.size) for note in notes(shapes, "info")]

    assert drawn(0, 0) == []
    assert drawn(3, 3) == [("elevation", 3)]
    assert drawn(0, 3) == [("drawing with heights, seen from above", 3)]


def test_entities_that_stand_in_space_are_lost(tmp_path: Path) -> None:
    document = ezdxf.new()
    document.modelspace().add_circle((0, 0), 1, dxfattribs={"extrusion": (1, 0, 0)})
    (note,) = notes(read(written(document), tmp_path), "lost")
    assert note.what == "CIRCLE that stands in space"


def test_a_clipped_block_is_read_whole_and_said_and_a_clipped_workspace_is_refused(tmp_path: Path) -> None:
    from ezdxf.xclip import XClip

    def clipped(layer: str) -> str:
        document = ezdxf.new()
        document.blocks.new("B").add_lwpolyline(SQUARE, close=True, dxfattribs={"layer": layer})
        reference = document.modelspace().add_blockref("B", (0, 0))
        XClip(reference).set_block_clipping_path([(0, 0), (2, 2)])
        return written(document)

    shapes = read(clipped("part"), tmp_path)
    assert areas(shapes) == [16]
    assert [(note.what, note.effect) for note in notes(shapes, "guess")] == [("clipped block, read whole", "more")]
    with pytest.raises(FormatError, match="layer workspace: a workspace in a clipped block; explode the block"):
        read(clipped("workspace"), tmp_path)


def test_hatches_that_ignore_inner_rings_are_filled(tmp_path: Path) -> None:
    document = ezdxf.new()
    hatch = document.modelspace().add_hatch(dxfattribs={"hatch_style": 2})
    for points in (SQUARE, [(1, 1), (1, 2), (2, 2), (2, 1)]):
        hatch.paths.add_polyline_path(points, is_closed=True)
    assert areas(read(written(document), tmp_path)) == [16]


def test_an_upright_face_is_a_line_from_above(tmp_path: Path) -> None:
    document = ezdxf.new()
    document.modelspace().add_3dface([(0, 0, 0), (5, 0, 0), (5, 0, 3), (0, 0, 3)])
    shapes = read(written(document), tmp_path, strokes=0.5)
    assert areas(shapes)[0] == pytest.approx(2.5 + 3.14159 / 16, abs=0.02)


@pytest.mark.parametrize(("code", "unit"), [(4, "mm"), (6, "m"), (1, "in"), (3, "mi")])
def test_units_are_the_files(code: int, unit: str, tmp_path: Path) -> None:
    document = ezdxf.new()
    document.units = code
    document.modelspace().add_circle((0, 0), 1)
    assert read(written(document), tmp_path).settings["units"] == unit
    document.units = 0
    assert read(written(document), tmp_path, units="cm").settings["units"] == "cm"
    document.units = 18  # astronomical units
    assert [note.what for note in notes(read(written(document), tmp_path), "warning")] == [
        "unit that has no name here: the scene has none"
    ]


def test_ends_of_curves_are_rounded_by_the_digits_of_the_file() -> None:
    def roundings(text: str) -> list[float]:
        walk = Walk(Source("a.dxf"), Layers(frozenset(), frozenset(), frozenset()), tags := mended(text.encode()))
        document, _ = ezdxf.recover.read(BytesIO(tags.raw))
        walk.all(document.modelspace(), Place())
        return [curve.rounding for item in walk.content() if isinstance(item, Lines) for curve in item.curves]

    line = "0 LINE 8 0 10 0.000000 20 0.000000 11 9.123456 21 0.000000"
    arc = "0 ARC 8 0 10 9.000000 20 0.000000 40 2.000000 50 0.0000 51 90.0000"
    first, second = roundings(plain(line, arc))
    assert first == pytest.approx(1e-6 / 2**0.5, abs=1e-11)
    assert second == pytest.approx(1e-6 / 2**0.5 + 5e-7 + 2 * 1e-4 * 3.14159265 / 360, abs=1e-11)
    assert max(roundings(plain("0 LINE 8 0 10 0 20 0 11 9 21 0", "0 LINE 8 0 10 0 20 2 11 9.5 21 0"))) < 1e-11


def test_reading_is_limited_by_steps_and_tells_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    document = ezdxf.new()
    for k in range(30):
        document.modelspace().add_lwpolyline([(x + 9 * k, y) for x, y in SQUARE], close=True)
    (tmp_path / "a.dxf").write_text(written(document))
    monkeypatch.setattr(source_module, "REPORTED", 50)
    told: list[int] = []
    read_file(tmp_path / "a.dxf", progress=told.append)
    assert told == sorted(told) and len(told) > 3
    monkeypatch.setattr(source_module, "MOST_STEPS", 100)
    with pytest.raises(FormatError, match="more than 100 elements and points"):
        read_dxf(Source(str(tmp_path / "a.dxf")))


def test_line_weights_are_no_widths(tmp_path: Path) -> None:
    document = ezdxf.new()
    document.modelspace().add_line((0, 0), (9, 0), dxfattribs={"lineweight": 50})
    shapes = read(written(document), tmp_path, strokes="drawn")
    assert [note.what for note in shapes.reading] == [
        "line without a width",
        "line weight, which is paint and no width",
    ]


def test_closed_polylines_with_a_width_are_solids_unless_strokes_are_walls(tmp_path: Path) -> None:
    document = ezdxf.new()
    document.modelspace().add_lwpolyline(SQUARE, close=True, dxfattribs={"const_width": 1})
    shapes = read(written(document), tmp_path)
    assert dxf_drawings.region(shapes).area == 25
    (guess,) = notes(shapes, "guess")
    assert (guess.what, guess.effect) == ("closed polyline with a width, read as a solid", "more")
    shapes = read(written(document), tmp_path, strokes=guess.remedy.split()[1])
    assert dxf_drawings.region(shapes).area == 25 - 9


@pytest.mark.parametrize("width", [0, 1])
def test_walls_around_a_workspace_are_obstacles_and_a_robot_stays_solid(width: int, tmp_path: Path) -> None:
    document = ezdxf.new()
    for layer in ("workspace", "robot"):
        document.modelspace().add_lwpolyline(
            SQUARE, close=True, dxfattribs={"layer": layer, **({"const_width": width} if width else {})}
        )
    shapes = read(written(document), tmp_path, strokes=1)
    assert [float(shape.polygon.exact_area) for shape in shapes.of("workspace")] == [16]
    room = shapely.Polygon(SQUARE).difference(dxf_drawings.region(shapes))
    assert room.area == 9
    robot = shapely.unary_union([shape.polygon.to_shapely() for shape in shapes.of("robot")])
    assert robot.contains(shapely.box(0, 0, 4, 4)) and robot.area > 24.7


def test_lines_that_divide_a_workspace_are_lost_unless_they_are_walls(tmp_path: Path) -> None:
    document = ezdxf.new()
    space = document.modelspace()
    for k in range(4):
        space.add_line(SQUARE[k - 1], SQUARE[k])
    space.add_line((2, 0), (2, 4))
    space.add_line((0, 2), (1, 2))
    shapes = read(written(document), tmp_path, roles={"0": "workspace"})
    assert [float(shape.polygon.exact_area) for shape in shapes.shapes] == [16]
    assert [(note.what, note.effect, note.size, note.remedy) for note in shapes.reading if note.kind == "lost"] == [
        ("line between free regions", "less", 4, "--strokes 0.01"),
        ("open line", "less", 1, "--strokes 0.01"),
    ]
    walled = read(written(document), tmp_path, roles={"0": "workspace"}, strokes=0.01)
    assert len(walled.of("obstacle")) == 6 and not [note for note in walled.reading if note.kind == "lost"]


def test_lines_in_a_workspace_that_are_walls_are_no_losses(tmp_path: Path) -> None:
    document = ezdxf.new()
    document.modelspace().add_lwpolyline(SQUARE, close=True, dxfattribs={"layer": "workspace"})
    document.modelspace().add_line((2, 0), (2, 3), dxfattribs={"layer": "workspace"})
    assert [note.kind for note in read(written(document), tmp_path, strokes=1).reading if note.kind == "lost"] == []
    assert [note.kind for note in read(written(document), tmp_path).reading if note.kind == "lost"] == ["lost"]


def test_hostile_blocks_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    document = ezdxf.new()
    document.blocks.new("B0").add_circle((0, 0), 1)
    for k in range(1, 9):
        block = document.blocks.new(f"B{k}")
        for _ in range(20):
            block.add_blockref(f"B{k - 1}", (0, 0))
    document.modelspace().add_blockref("B8", (0, 0))
    monkeypatch.setattr(source_module, "MOST_STEPS", 10_000)
    with pytest.raises(FormatError, match="elements and points, references expanded"):
        read(written(document), tmp_path)
    document = ezdxf.new()
    document.blocks.new("B").add_circle((0, 0), 1)
    rows = {"row_count": 30000, "column_count": 30000, "row_spacing": 1, "column_spacing": 1}
    document.modelspace().add_blockref("B", (0, 0), dxfattribs=rows)
    with pytest.raises(FormatError, match="elements and points, references expanded"):
        read(written(document), tmp_path)


def test_a_room_of_lines_is_asked_about(tmp_path: Path) -> None:
    room = ezdxf.new()
    space = room.modelspace()
    space.add_lwpolyline([(0, 0), (12, 0), (12, 8), (0, 8)], close=True, dxfattribs={"layer": "A-WALL"})
    for k in range(4):
        space.add_circle((2 + 2 * k, 3), 0.5, dxfattribs={"layer": "FURNITURE"})
    asked = [note for note in read(written(room), tmp_path).reading if "around nearly" in note.what]
    assert [(note.what, note.where, note.remedy) for note in asked] == [
        ("line around nearly everything, read as a solid", "A-WALL", "--role A-WALL=workspace or --strokes 0.1")
    ]
    assert not [note for note in read(written(room), tmp_path, strokes=0.1).reading if "solid" in note.what]
    loose = ezdxf.new()
    for ends in (((0, 0), (12, 0)), ((12, 1), (12, 8)), ((12, 8), (0, 8)), ((0, 8), (0, 0))):
        loose.modelspace().add_line(*ends, dxfattribs={"layer": "A-WALL"})
    loose.modelspace().add_circle((2, 3), 0.5, dxfattribs={"layer": "FURNITURE"})
    asked = [note for note in read(written(loose), tmp_path).reading if "around nearly" in note.what]
    assert [note.what for note in asked] == ["line around nearly everything, with others a possible solid"]
    for entity in space.query("LWPOLYLINE"):
        entity.dxf.layer = "plate"
    assert not [note for note in read(written(room), tmp_path).reading if "around nearly" in note.what]
    for x in (3, 6, 9):  # dividing walls: T junctions
        space.add_line((x, 0), (x, 8), dxfattribs={"layer": "plate"})
    assert [note for note in read(written(room), tmp_path).reading if "around nearly" in note.what]


def test_circles_and_arcs_without_a_radius_are_noted(tmp_path: Path) -> None:
    document = ezdxf.new()  # type: ignore[attr-defined]
    space = document.modelspace()
    space.add_circle((0, 0), 5)
    space.add_circle((0, 0), 0)
    space.add_arc((0, 0), 0, 0, 90)
    space.add_circle((1, 1), -1)
    space.add_arc((1, 1), -2, 0, 90)
    space.add_lwpolyline([(0, 0, math.nan), (1, 0, 0), (0, 1, 0)], format="xyb", close=True)
    document.saveas(tmp_path / "a.dxf")
    notes = {note.what: note.kind for note in cfree.load_shapes(tmp_path / "a.dxf", curves=True).reading}
    assert notes["circle that is a point"] == notes["arc that is a point"] == "info"
    assert notes["CIRCLE that cannot be read: radius -1, which is no length"] == "lost"
    assert notes["ARC that cannot be read: radius -2, which is no length"] == "lost"
    assert notes["LWPOLYLINE that cannot be read: bulge nan is not finite"] == "lost"
