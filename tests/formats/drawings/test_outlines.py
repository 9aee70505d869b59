"""The content of a drawing becomes shapes: layers, hatches, roles, strokes."""

from pathlib import Path

import pytest

import cfree
from cfree.formats.drawings import outlines
from cfree.formats.drawings.content import Drawn, Lines
from cfree.formats.drawings.outlines import shapes_of_drawing
from cfree.formats.drawings.source import Reading, Source
from cfree.formats.shapes import Shapes
from cfree.polygons.polygon import Polygon
from enclosures import box, closed, lines, pieces


def shapes(*content: Drawn | Lines, **options: object) -> Shapes:
    return shapes_of_drawing(Source("a.dxf", reading=Reading(**options)), "DXF", content, {}, "")  # type: ignore[arg-type]


def areas(found: Shapes) -> list[tuple[str, str | None, float]]:
    return [(shape.role, shape.name, float(shape.polygon.exact_area)) for shape in found.shapes]


def test_layers_and_hatches_are_apart() -> None:
    walls = Lines(pieces(box(0, 0, 9, 9), box(2, 2, 5, 5)), ("walls",))
    robot = Lines(closed(box(0, 0, 1, 1)), ("robot",))
    hatch = Drawn([box(2, 2, 5, 5)], ("walls",))
    assert areas(shapes(walls, robot, hatch)) == [
        ("obstacle", "walls", 56),
        ("robot", None, 1),
        ("obstacle", "walls", 25),
    ]


def test_hatches_alone_are_solid_if_the_option_says_so() -> None:
    walls, hatch = Lines(closed(box(0, 0, 9, 9)), ("walls",)), Drawn([box(2, 2, 5, 5)], ("walls",))
    others = Lines(closed(box(20, 0, 1, 1)), ("others",))
    assert [area for *_, area in areas(shapes(walls, hatch, others, fills="hatches"))] == [25, 1]


def test_the_joining_distance_is_a_share_of_the_whole_drawing() -> None:
    gap = Lines(lines((0, 0, 9, 0), (9, 0, 9, 9), (9, 9, 0, 9), (0, 9, 0, "0.00005")), ("walls",))
    assert not shapes(gap).shapes
    assert len(shapes(gap, Drawn([box(100, 0, 1, 1)], ("far",))).shapes) == 2


def test_a_layer_to_ignore_is_noted_and_refuses_nothing() -> None:
    crossing = Lines(closed([*box(0, 0, 1, 1)]), ("notes",))
    found = shapes(crossing, Lines(closed(box(0, 0, 2, 2)), ("walls",)), roles={"notes": "ignore"})
    assert len(found.shapes) == 1
    (note,) = found.reading
    assert (note.kind, note.what, note.where) == ("hidden", "ignored shape", "notes")


def test_lines_are_walls_with_the_option_strokes(monkeypatch: pytest.MonkeyPatch) -> None:
    wall = Polygon([(0, 0), (9, 0), (9, 1)])
    monkeypatch.setattr(outlines, "walls", lambda source, curves, where: [wall] * len(curves))
    walls, hatch = Lines(closed(box(0, 0, 9, 9), box(2, 2, 5, 5)), ("walls",)), Drawn([box(0, 0, 1, 1)], ("desk",))
    found = shapes(walls, hatch, strokes=0.1)
    assert [shape.polygon for shape in found.shapes[:2]] == [wall, wall]
    assert len(found.shapes) == 3


def test_a_workspace_with_an_ambiguous_outline_is_not_larger() -> None:
    room = Lines(closed(box(0, 0, 9, 9), box(5, 5, 9, 9)), ("workspace",))
    assert sum(area for *_, area in areas(shapes(room))) == 2 * 65


CUSP = "M0 0 H10 V10 H0 Z M3 3 H6 C3 3 3 6 6 6 H3 Z"  # a curve that leaves a line backwards


def test_an_outline_with_a_cusp_is_read_within_the_tolerance(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text(f'<svg><path fill-rule="evenodd" d="{CUSP}"/></svg>')
    shapes = cfree.load_shapes(tmp_path / "a.svg", tolerance=0.01)
    area = sum(polygon.area for polygon in shapes.polygons)
    assert 96.4 < area < 96.4 + 56 * 0.01  # the hole has 3.6, all rings together a length of less than 56
    assert not shapes.dropped and [note.kind for note in shapes.reading if note.kind != "info"] == ["near"]


def test_a_hole_thinner_than_the_tolerance_may_be_filled(tmp_path: Path) -> None:
    thin = "M2 2 C4 2.0000001 6 2.0000001 8 2 C6 1.9999999 4 1.9999999 2 2 Z"
    (tmp_path / "a.svg").write_text(f'<svg><path fill-rule="evenodd" d="M0 0 H10 V10 H0 Z {thin}"/></svg>')
    shapes = cfree.load_shapes(tmp_path / "a.svg")
    assert 99.9 < sum(polygon.area for polygon in shapes.polygons) < 100.1
    assert [note.kind for note in shapes.reading if note.kind != "info"] == ["near"]


def test_round_shapes_below_the_least_area_are_left_out_as_an_assumption(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text('<svg><circle cx="5" cy="5" r="1"/><circle cx="9" cy="5" r="2"/></svg>')
    shapes = cfree.load_shapes(tmp_path / "a.svg", curves=True, min_area=4)
    assert [float(shape.polygon.size) for shape in shapes.shapes] == [4]
    assert [note.count for note in shapes.reading if note.kind == "assumption"] == [1]


def test_lost_lines_can_be_drawn(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text('<svg><path fill="none" stroke="red" d="M0 0 H4 V3"/></svg>')
    (note,) = (note for note in cfree.load_shapes(tmp_path / "a.svg").reading if note.kind == "lost")
    assert note.items[0].points == ((0, 0), (4, 0), (4, -3))
