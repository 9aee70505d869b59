"""SVG by its specification: each way of drawing a region gives the region, and what is left out is said."""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path

import pytest
import shapely

import svg_drawings
from cfree.errors import FormatError
from cfree.formats.drawings.source import Reading, Source
from cfree.formats.drawings.svg_paths import center_of
from cfree.formats.readers import read_file
from cfree.formats.shapes import Shapes
from cfree.scene.reading import Note

PAGE = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 100 100">{}</svg>'
)


def read(tmp_path: Path, body: str, page: str = PAGE, **options: object) -> Shapes:
    (tmp_path / "a.svg").write_text(page.format(body))
    shapes = read_file(tmp_path / "a.svg", Reading(**options))  # type: ignore[arg-type]
    assert isinstance(shapes, Shapes)
    return shapes


def area(shapes: Shapes) -> float:
    return float(shapely.union_all([shape.polygon.to_shapely() for shape in shapes.shapes]).area)


def notes(shapes: Shapes, kind: str) -> list[Note]:
    return [note for note in shapes.reading if note.kind == kind]


@pytest.mark.parametrize("name", svg_drawings.WAYS)
def test_each_way_of_drawing_a_region_gives_the_region(name: str, tmp_path: Path) -> None:
    for seed in range(2):
        assert not svg_drawings.verdict(svg_drawings.make(name, seed), tmp_path / "a.svg"), f"seed {seed}"


def test_a_clipped_workspace_is_what_is_left_and_no_more(tmp_path: Path) -> None:
    body = '<svg width="9" height="9"><circle id="workspace" cx="4" cy="4" r="5"/></svg>'
    (room,) = read(tmp_path, body, tolerance=0.01).shapes
    truth = shapely.Point(4, -4).buffer(5, quad_segs=5000).intersection(shapely.box(0, -9, 9, 0))
    shape = room.polygon.to_shapely()
    assert shape.difference(truth.buffer(1e-6)).area == 0
    assert truth.difference(shape).area < 0.01 * truth.length


@pytest.mark.slow
@pytest.mark.parametrize("name", svg_drawings.WAYS)
def test_many_drawings_of_each_way_are_read_as_they_are_meant(name: str, tmp_path: Path) -> None:
    for seed in range(1000, 1040):
        assert not svg_drawings.verdict(svg_drawings.make(name, seed), tmp_path / "a.svg"), f"seed {seed}"


# numbers


def test_relative_coordinates_are_summed_exactly(tmp_path: Path) -> None:
    steps = " ".join(["0.1,0"] * 70 + ["0,0.1"] * 70 + ["-0.1,0"] * 70 + ["0,-0.1"] * 70)
    (shape,) = read(tmp_path, f'<path d="m0.3,0.2 {steps}"/>').shapes
    assert shape.polygon.exact_area == 49
    assert shape.polygon.bounds == (0.3, -7.2, 7.3, -0.2)
    corners = {(Fraction(3, 10), -Fraction(1, 5)), (Fraction(73, 10), -Fraction(36, 5))}
    assert corners <= set(shape.polygon.exact_vertices)


def test_numbers_of_any_length_are_exact_and_too_long_ones_are_refused(tmp_path: Path) -> None:
    digits = "0." + "3" * 300
    (shape,) = read(tmp_path, f'<path d="M0 0h{digits}v1h-{digits}z"/>').shapes
    assert shape.polygon.exact_area == Fraction(digits)
    for wrong in ("1" * 401, "1e401", "1e-999999999", "-1e308"):
        with pytest.raises(FormatError, match=r"is no coordinate; give 0, or one from 1e-100 to 1e150"):
            read(tmp_path, f'<path d="M0 0h{wrong}v1z"/>')


@pytest.mark.parametrize(
    ("path", "expected", "place"),
    [
        ("M0 0H10V10H0z x L 50 50 0 90", 100, "character 15"),
        ("M0 0H10V10H0zL5", 100, "character 16"),
        ("M0 0H10V10H0zA5 5 0 2 0 9 9", 100, "character 15"),
        ("M0 0H5 10V5 10H0z", 100, None),  # H takes several numbers
        ("L0 0 10 0 10 10", 0, "character 1"),
        ("", 0, None),
        ("M5 5", 0, None),
    ],
)  # fmt: skip
def test_broken_path_data_are_drawn_up_to_the_fault_and_said(
    path: str, expected: float, place: str | None, tmp_path: Path
) -> None:
    shapes = read(tmp_path, f'<path id="p" d="{path}"/>')
    assert area(shapes) == expected
    lost = notes(shapes, "lost")
    assert [note.where for note in lost] == (["p"] if place else [])
    assert not lost or lost[0].items[0].handle == f"line 1, {place}"


def test_a_list_of_points_is_read_up_to_its_fault(tmp_path: Path) -> None:
    shapes = read(tmp_path, '<polygon points="0,0 10,0 10,10 0,10 7"/>')
    assert area(shapes) == 100
    assert [note.what for note in notes(shapes, "lost")] == ["polygon with a fault: not read from there on"]


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('<rect width="calc(1px + 2px)" height="3"/>', r"rect: width: calc\(\) is not read"),
        ('<rect width="3vw" height="3"/>', "rect: width: '3vw' is no length"),
        ('<g style="transform:rotate(45)"/>', "an angle without its unit"),
        ('<g style="transform:translate(9,0)"/>', "a length without its unit"),
        ('<g style="transform:translate(9px 0px)"/>', "a comma is missing"),
        ('<g style="transform:rotate3d(1,0,0,45deg)"/>', "write it like translate"),
        ('<g style="translate:5px"/>', "translate: '5px' is not read"),
        ('<g transform="scale(1,2,3)"/>', "write it like translate"),
        ('<path style="d:path(\'M0 0\')" d="M0 0"/>', "d in a style is not read"),
        ('<svg viewBox="0 0 1"><rect/></svg>', "viewBox: '0 0 1'"),
        ('<svg viewBox="0 0 1 1" preserveAspectRatio="middle"/>', "preserveAspectRatio: 'middle'"),
        ('<style>rect:foo(1) {transform: none}</style>', "its rule moves shapes"),
        ('<style>@media (width>9px) {rect {x: 9px}}</style><rect width="1" height="1"/>', "in a rule of the style"),
        ('<rect style="width:var(--w)" height="1"/>', "variables are not read"),
    ],
)  # fmt: skip
def test_shapes_whose_place_is_not_certain_are_refused(body: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=message):
        read(tmp_path, body)


def test_lengths_in_letters_are_read_and_said(tmp_path: Path) -> None:
    shapes = read(tmp_path, '<g font-size="10px"><rect width="2em" height="1ex"/></g>')
    assert area(shapes) == 100
    assert [note.what for note in notes(shapes, "guess")] == [
        "length in em: a letter is taken as 10 px high",
        "length in ex: a letter is taken as 10 px high",
    ]


def test_shares_of_a_size_that_is_not_given_are_refused(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="give the svg a viewBox"):
        read(tmp_path, '<rect width="50%" height="5"/>', "<svg>{}</svg>")


@pytest.mark.parametrize(
    ("large", "sweep", "center", "quarters"),
    [(False, True, (0, 1), 1), (True, True, (1, 0), 3), (False, False, (1, 0), -1), (True, False, (0, 1), -3)],
)
def test_the_flags_of_an_arc_choose_its_center_and_its_way(
    large: bool, sweep: bool, center: tuple[int, int], quarters: int
) -> None:
    middle, _, _, first, last = center_of(1, 1, 1, 1, 0, large, sweep)
    assert middle == pytest.approx(center, abs=1e-12)
    assert last - first == pytest.approx(quarters * math.pi / 2)


# styles


@pytest.mark.parametrize(
    ("style", "element", "filled"),
    [
        ("", 'fill="none"', False),
        ("", 'fill="none" style="fill:red"', True),
        ("path {fill: none}", 'fill="red"', False),
        ("path {fill: none}", 'style="fill:red"', True),
        ("path {fill: none !important}", 'style="fill:red"', False),
        ("path {fill: none !important}", 'style="fill:red !important"', True),
        ("path {fill: none} .a {fill: red}", 'class="b a"', True),
        (".a {fill: red} path {fill: none}", 'class="a"', True),
        ("#p {fill: none} .a {fill: red}", 'id="p" class="a"', False),
        ("g path {fill: none}", "", False),
        ("@media print {path {stroke: red}} g > path:first-child {fill: none}", "", False),
        ("/* path {fill: none} */", "", True),
        ("path {fill: nonsense()}", "", True),
        ("<![CDATA[ path {fill: none} ]]>", "", False),
    ],
)  # fmt: skip
def test_styles_win_by_the_order_of_css(style: str, element: str, filled: bool, tmp_path: Path) -> None:
    body = f'<style>{style}</style><g><path {element} d="M0 0H9V9"/></g>'
    assert bool(read(tmp_path, body).shapes) is filled


def test_rules_that_are_not_understood_are_said_and_a_workspace_with_one_is_refused(tmp_path: Path) -> None:
    sheet = "<style>@media (min-width: 3px) {.a {display: none} .b {opacity: .5}}</style>"
    shapes = read(
        tmp_path, f'{sheet}<rect class="a" width="2" height="2"/><rect class="b" x="5" width="2" height="2"/>'
    )
    assert area(shapes) == 8
    assert [note.what for note in notes(shapes, "guess")] == ["rule of a style sheet not obeyed: display"]
    with pytest.raises(FormatError, match="a workspace with a rule of a style sheet that is not obeyed"):
        read(tmp_path, f'{sheet}<g class="a"><rect id="workspace" width="2" height="2"/></g>')


def test_rules_that_are_not_understood_and_only_paint_are_one_note(tmp_path: Path) -> None:
    sheet = "<style>rect:foo(1) {stroke: red} @media print {rect {stroke: red}} ::x {}</style>"
    shapes = read(tmp_path, f'{sheet}<rect width="2" height="2"/>')
    assert [note.kind for note in shapes.reading] == ["paint", "paint"]
    assert {note.what for note in shapes.reading} == {"rule of a style sheet not obeyed: it only paints"}


def test_a_workspace_beyond_the_page_is_read_whole_and_said(tmp_path: Path) -> None:
    shapes = read(tmp_path, '<rect id="workspace" width="101" height="5"/>')
    assert [(note.what, note.effect) for note in notes(shapes, "warning")] == [
        ("workspace beyond the page: read whole", "less")
    ]
    assert not notes(read(tmp_path, '<rect id="workspace" width="100" height="100"/>'), "warning")


def test_style_sheets_of_other_files_are_not_read_and_said(tmp_path: Path) -> None:
    page = '<?xml-stylesheet href="a.css"?>' + PAGE
    shapes = read(tmp_path, '<style>@import url("b.css");</style><rect width="2" height="2"/>', page)
    assert [(note.what, note.count) for note in notes(shapes, "guess")] == [
        ("style sheet of another file: not read", 2)
    ]


# clips


def test_a_clip_that_is_not_applied_keeps_the_shape_whole_and_says_it(tmp_path: Path) -> None:
    shapes = read(tmp_path, '<mask id="m"/><rect id="a" mask="url(#m)" x="2" width="10" height="10"/>')
    (note,) = notes(shapes, "guess")
    assert (area(shapes), note.what, note.effect, note.where, note.at) == (
        100, "mask not applied: larger than drawn", "more", "a", (7, -5),
    )  # fmt: skip


@pytest.mark.parametrize(
    "body",
    [
        '<mask id="m"/><rect id="workspace" mask="url(#m)" width="10" height="10"/>',
        '<clipPath id="c"><text>a</text></clipPath><rect id="workspace" clip-path="url(#c)" width="9" height="9"/>',
        '<clipPath id="c" clip-path="url(#c)"/><rect id="workspace" clip-path="url(#c)" width="9" height="9"/>',
        '<g style="clip-path:circle(3px)"><rect id="workspace" width="9" height="9"/></g>',
    ],
)
def test_a_workspace_with_a_clip_that_is_not_applied_is_refused(body: str, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"a workspace with a (mask|clip-path|viewport) would be larger than drawn"):
        read(tmp_path, body)


def test_clips_are_applied_exactly(tmp_path: Path) -> None:
    clip = '<clipPath id="c" transform="translate(1)"><polygon points="0,0 12,0 0,12"/></clipPath>'
    shapes = read(tmp_path, f'{clip}<rect id="workspace" clip-path="url(#c)" x="1" width="9" height="9"/>')
    assert shapes.shapes[0].polygon.exact_area == 81 - 18
    shapes = read(tmp_path, f'{clip}<g clip-path="url(#c)"><rect id="gone" x="50" width="9" height="9"/></g>')
    assert not shapes.shapes
    assert notes(shapes, "hidden")[0].what == "rect outside of its clip-path"


# what is left out


def test_parts_that_draw_no_outline_are_said_with_their_places(tmp_path: Path) -> None:
    body = (
        '<image id="map" x="10" y="20" width="80" height="60" xlink:href="m.png"/><foreignObject width="8" height="4"/>'
        '<text x="3" y="4">hi</text><text x="3 4" y="1">hi</text><path marker-end="url(#m)" d="M0 0H9V9"/>'
        '<use href="b.svg#a"/><blob/><rect width="-5" height="5"/>'
    )
    lost = {note.what: note for note in read(tmp_path, body).reading}
    assert (lost["image"].at, lost["image"].size, lost["image"].where) == ((50, -50), 80, "map")
    assert lost["foreignObject"].size == 8
    assert (lost["text"].kind, lost["text"].count, lost["text"].items[0].at) == ("paint", 2, (3, -4))
    expected = {"marker", "use of an element that is not in this file", "rect of a size below 0"}
    assert expected <= {what for what, note in lost.items() if note.kind == "lost" and note.effect == "less"}
    assert lost["blob: no element that draws"].kind == "lost"


def test_hidden_elements_are_said_and_are_no_loss(tmp_path: Path) -> None:
    body = '<g id="g" display="none"><rect width="2" height="2"/></g><rect visibility="hidden" width="1" height="1"/>'
    shapes = read(tmp_path, body)
    assert [(note.kind, note.what, note.where) for note in shapes.reading] == [
        ("hidden", "hidden g", "g"), ("hidden", "hidden rect", ""),
    ]  # fmt: skip


def test_the_first_of_two_elements_with_an_id_is_used_and_said(tmp_path: Path) -> None:
    shapes = read(
        tmp_path, '<defs><rect id="a" width="2" height="2"/><rect id="a" width="9" height="9"/></defs><use href="#a"/>'
    )
    assert area(shapes) == 4
    assert [note.where for note in notes(shapes, "warning")] == ["a"]


def test_a_switch_takes_the_branch_of_the_language(tmp_path: Path) -> None:
    branches = "".join(
        f'<rect systemLanguage="{tag}" width="{k}" height="1"/>' for k, tag in enumerate(("fr", "de-AT", "en-GB"), 1)
    )
    body = f"<switch><title/>{branches}<rect width='9' height='1'/></switch>"
    assert [area(read(tmp_path, body, language=word)) for word in ("en", "de", "fr", "xx")] == [3, 2, 1, 9]
    (note,) = notes(read(tmp_path, body), "hidden")
    assert (note.what, note.count) == ("branch of a switch", 3)


def test_elements_of_other_namespaces_are_no_shapes(tmp_path: Path) -> None:
    shapes = read(
        tmp_path, '<b:rect xmlns:b="b" width="3" height="3"/><rect xmlns:b="b" b:width="9" width="2" height="2"/>'
    )
    assert area(shapes) == 4
    assert [note.what for note in notes(shapes, "lost")] == ["rect of another namespace"]


def test_animations_are_said(tmp_path: Path) -> None:
    shapes = read(tmp_path, '<rect width="2" height="2"><animate/></rect><g style="animation: a 3s"><animate/></g>')
    assert [note.what for note in notes(shapes, "warning")] == ["animation: read as it stands without it"]


# outlines without a fill


def lines_of(tmp_path: Path, body: str, **options: object) -> list[object]:
    """Return what the reader hands on, before outlines are made of it."""
    from cfree.curves.drawn import IDENTITY
    from cfree.formats.drawings.svg_lengths import Measure
    from cfree.formats.drawings.svg_walk import Walk
    from cfree.formats.drawings.xml_tree import read_tree

    (tmp_path / "a.svg").write_text(PAGE.format(body))
    source = Source(str(tmp_path / "a.svg"), reading=Reading(**options))  # type: ignore[arg-type]
    return list(Walk(source, read_tree(source), IDENTITY, Measure(Fraction(100), Fraction(100))).content())


def test_unfilled_pieces_of_a_group_with_a_name_go_together(tmp_path: Path) -> None:
    line = '<line x2="{}" y2="1"/>'
    body = f'<g id="a">{line.format(1)}<g>{line.format(2)}</g></g><g id="b">{line.format(3)}</g>{line.format(4)}'
    content = lines_of(tmp_path, body)
    assert [(item.names, len(item.curves)) for item in content] == [((), 1), (("a",), 2), (("b",), 1)]


def test_pieces_with_a_role_go_together(tmp_path: Path) -> None:
    body = "".join(f'<line id="robot-{k}" x2="{k}" y2="1"/><line id="wall-{k}" x2="{k}" y2="2"/>' for k in (1, 2))
    assert [(item.names, len(item.curves)) for item in lines_of(tmp_path, body)] == [((), 2), (("robot-1",), 2)]


def test_filled_paths_on_a_line_are_lines(tmp_path: Path) -> None:
    (item,) = lines_of(tmp_path, '<path d="M0 0L9 9"/><polyline points="0,0 4,0 2,0"/><path d="M0 0A5 5 0 0 1 9 9"/>')[
        1:
    ]
    assert [curve.closed for curve in item.curves] == [False, False, False]


def test_closed_elements_are_solids_of_their_own_unless_nested_holes_are_wanted(tmp_path: Path) -> None:
    looks = 'fill="none" stroke="red"'
    body = f'<rect {looks} width="9" height="9"/><circle {looks} cx="5" cy="5" r="2"/><line x2="3" y2="4"/>'
    assert sorted(len(item.curves) for item in lines_of(tmp_path, body)) == [1, 1, 1]
    assert [len(item.curves) for item in lines_of(tmp_path, body, holes="nested")] == [3]


def test_a_room_of_lines_is_asked_about(tmp_path: Path) -> None:
    room = '<path id="walls" d="M0 0H90V60H0z"/>'
    inside = '<rect x="9" y="9" width="9" height="9" fill="red"/><circle cx="50" cy="30" r="9" fill="red"/>'
    body = '<g fill="none" stroke="black" stroke-width="2">{}</g>'
    (note,) = [note for note in read(tmp_path, body.format(room + inside)).reading if "nearly everything" in note.what]
    assert (note.effect, note.where, note.remedy) == ("more", "walls", "--role walls=workspace or --strokes drawn")
    for quiet in (room.replace("walls", "plate") + inside, inside):
        assert not [note for note in read(tmp_path, body.format(quiet)).reading if "nearly everything" in note.what]


def test_strokes_have_the_width_and_the_form_that_is_drawn(tmp_path: Path) -> None:
    body = (
        '<g transform="scale(2 3)" stroke="red" stroke-linejoin="round"><line stroke-width="1.5" x2="9" y2="4"/>'
        '<line stroke-width="10%" stroke-linecap="square" x2="9" y2="4"/><line stroke="none" x2="9" y2="4"/>'
        '<line vector-effect="non-scaling-stroke" x2="9" y2="4"/></g>'
    )
    (item,) = lines_of(tmp_path, body, strokes="drawn")
    assert [curve.width for curve in item.curves] == [4.5, 30, 0, 1]
    assert {curve.join for curve in item.curves} == {"round"}
    assert [curve.cap for curve in item.curves] == ["butt", "square", "butt", "butt"]
    filled = lines_of(tmp_path, '<rect stroke="red" width="3" height="3"/>', strokes="drawn")
    assert [type(item).__name__ for item in filled] == ["Drawn", "Lines"]


def test_outlines_that_paint_nothing_are_solids_and_this_is_said(tmp_path: Path) -> None:
    shapes = read(tmp_path, '<path fill="none" d="M0 0h24v24H0z"/><path fill="none" stroke="red" d="M30 0h4v4z"/>')
    assert [(note.count, note.effect) for note in notes(shapes, "guess")] == [(1, "more")]
    assert len(shapes.shapes) == 2


def test_the_width_of_a_stroke_that_is_no_length_costs_no_file(tmp_path: Path) -> None:
    body = '<line stroke="red" stroke-width="thick" x2="5" y2="5"/>'
    body += '<rect stroke="red" stroke-width="2em" width="5" height="5"/>'
    assert not notes(read(tmp_path, body), "guess")
    (item,) = lines_of(tmp_path, body, strokes="drawn")[2:]
    assert item.curves[0].width == 1


def test_an_end_that_misses_its_begin_by_its_digits_closes_the_outline(tmp_path: Path) -> None:
    body = '<path fill="none" d="m0,0 33.30,0 0,33.33 -33.31,0.01 0,-33.33"/>'
    (item,) = lines_of(tmp_path, body)
    assert item.curves[0].closed
    (note,) = notes(read(tmp_path, body), "joined")
    assert note.size == pytest.approx(0.01 * 2**0.5) and note.effect == "near"
    assert not lines_of(tmp_path, body, join=0.0)[0].curves[0].closed
    assert not lines_of(tmp_path, body.replace("-33.31", "-33.5"))[0].curves[0].closed


# hostile files


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('<g id="a"><use href="#a"/></g>', "nested more than 100 deep"),
        ('<clipPath id="c"><path clip-path="url(#c)" d="M0 0"/></clipPath><g clip-path="url(#c)"/>', None),
        ("<style>" + "a:not(" * 9000 + "</style>", None),
        ("<style>" + "{" * 90_000 + "</style>", None),
        ("<style>/*" + "x" * (1 << 20) + "*/</style>", "style sheets of more than 1,024 KiB"),
        ("<style>g ~ g ~ g {fill: red}</style>" + "<g/>" * 9000, "more than 3,000,000 elements"),
        ("<style>" + "*[a] {fill: red}" * 30_000 + "</style>" + "<g/>" * 3000, "more than 3,000,000 elements"),
        ('<path d="' + "M0 0h1" * 1_600_000 + '"/>', "more than 3,000,000 elements"),
        ('<path d="M0 0' + "1" * 5000 + '"/>', "to 1e150"),
        ('<g transform="' + "scale(1.000000000000001)" * 3000 + '"><rect width="1" height="1"/></g>', None),
    ],
)  # fmt: skip
@pytest.mark.slow
@pytest.mark.long
def test_hostile_files_are_refused_or_read_with_counted_work(body: str, message: str | None, tmp_path: Path) -> None:
    import time

    begin = time.process_time()
    if message:
        with pytest.raises(FormatError, match=message):
            read(tmp_path, body)
    else:
        read(tmp_path, body)
    assert time.process_time() - begin < 60


def test_shapes_painted_upon_others_are_solids_and_this_is_said(tmp_path: Path) -> None:
    plate = '<rect fill="black" width="50" height="50"/>'
    shapes = read(tmp_path, f'{plate}<circle fill="white" cx="20" cy="20" r="5"/><circle cx="40" cy="40" r="5"/>')
    assert area(shapes) == 2500
    (note,) = [note for note in shapes.reading if note.what.startswith("shape painted upon another")]
    assert (note.count, note.kind) == (1, "info")
