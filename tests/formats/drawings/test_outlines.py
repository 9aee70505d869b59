"""The content of a drawing becomes shapes: layers, hatches, roles, strokes."""

import math
from pathlib import Path

import pytest

import cfree
from cfree.curves.drawn import Cubic, Line, arc_of_circle
from cfree.curves.hulls import Outline
from cfree.formats.drawings import outlines
from cfree.formats.drawings.chord_polygons import chord_polygons
from cfree.formats.drawings.content import Drawn, Lines
from cfree.formats.drawings.outlines import shapes_of_drawing
from cfree.formats.drawings.source import Reading, Source
from cfree.formats.shapes import Shapes
from cfree.polygons.polygon import Polygon
from enclosures import area, box, closed, is_in, lines, pieces, point


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
    found = cfree.load_shapes(tmp_path / "a.svg", tolerance=0.01)
    total = sum(polygon.area for polygon in found.polygons)
    assert 96.4 < total < 96.4 + 56 * 0.01  # the hole has 3.6, all rings together a length of less than 56
    assert not found.dropped and {note.kind for note in found.reading} <= {"near", "info"}


def test_a_hole_thinner_than_the_tolerance_may_be_filled(tmp_path: Path) -> None:
    thin = "M2 2 C4 2.0000001 6 2.0000001 8 2 C6 1.9999999 4 1.9999999 2 2 Z"
    (tmp_path / "a.svg").write_text(f'<svg><path fill-rule="evenodd" d="M0 0 H10 V10 H0 Z {thin}"/></svg>')
    found = cfree.load_shapes(tmp_path / "a.svg")
    assert 99.9 < sum(polygon.area for polygon in found.polygons) < 100.1
    assert {note.kind for note in found.reading} <= {"near", "info"}


def test_round_shapes_below_the_least_area_are_left_out_as_an_assumption(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text('<svg><circle cx="5" cy="5" r="1"/><circle cx="9" cy="5" r="2"/></svg>')
    found = cfree.load_shapes(tmp_path / "a.svg", curves=True, min_area=4)
    assert [float(shape.polygon.size) for shape in found.shapes] == [4]
    assert [note.count for note in found.reading if note.kind == "assumption"] == [1]


def test_lost_lines_can_be_drawn(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text('<svg><path fill="none" stroke="red" d="M0 0 H4 V3"/></svg>')
    (note,) = (note for note in cfree.load_shapes(tmp_path / "a.svg").reading if note.kind == "lost")
    assert [item.points for item in note.items if item.points] == [((0, 0), (4, 0), (4, -3))]


@pytest.mark.parametrize("role", ["walls", "workspace"])
def test_curves_that_touch_cost_neither_the_file_nor_what_is_drawn(role: str) -> None:
    crescent = Lines(closed([arc_of_circle((0, 0), 5)], [arc_of_circle((1, 0), 4)]), (role,))  # they touch at (5, 0)
    found = shapes(crescent, tolerance=0.02)
    assert {note.kind for note in found.reading} == {"near"}
    fallback = any(note.what == "outline with curves that nearly touch" for note in found.reading)
    assert fallback == (role == "workspace")
    total = sum(value for *_, value in areas(found))
    assert total == pytest.approx(9 * math.pi, abs=0.02 * 18 * math.pi)
    assert (total < 9 * math.pi) == (role == "workspace")


def test_polygons_of_chords_contain_the_curves_or_are_inside_of_them() -> None:
    crescent = Outline([arc_of_circle((0, 0), 5)], ([arc_of_circle((1, 0), 4)],))  # they touch at (5, 0)
    around, within = (chord_polygons(crescent, 0.01, inside=inside) for inside in (False, True))
    assert area(within) < 9 * math.pi < area(around)
    assert area(around) - area(within) < 0.02 * 2 * 2 * math.pi * 9
    for k in range(400):
        t, share = k * 0.7, (k % 20 + 0.5) / 20
        p, q = (5 * math.cos(t), 5 * math.sin(t)), (1 + 4 * math.cos(t), 4 * math.sin(t))
        middle = p[0] + (q[0] - p[0]) * share, p[1] + (q[1] - p[1]) * share
        if math.hypot(middle[0] - 1, middle[1]) - 4 > 1e-3 and math.hypot(*middle) < 5 - 1e-3:
            assert is_in(around, middle)
        assert not is_in(within, (1.001 * p[0], 1.001 * p[1]))
    curved = Outline([Cubic(((0, 0), (9, 9), (-5, 9), (4, 0))), Line(point(4, 0), point(0, 0))])
    around, within = (chord_polygons(curved, 0.01, inside=inside) for inside in (False, True))
    assert 0 < area(around) - area(within) < 1


def test_hidden_elements_can_be_drawn(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text(
        '<svg><rect width="2" height="1" display="none"/><rect width="9" height="9"/></svg>'
    )
    (note,) = (note for note in cfree.load_shapes(tmp_path / "a.svg").reading if note.kind == "hidden")
    assert {(2, 0), (2, -1), (0, -1)} <= set(note.items[0].points)
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.new()
    document.layers.add("off").off()
    document.modelspace().add_lwpolyline([(0, 0), (4, 0), (4, 3)], dxfattribs={"layer": "off"})
    document.modelspace().add_circle((9, 9), 2)
    document.saveas(tmp_path / "a.dxf")
    (note,) = (note for note in cfree.load_shapes(tmp_path / "a.dxf").reading if note.kind == "hidden")
    assert note.items[0].points == ((0, 0), (4, 0), (4, 3))
