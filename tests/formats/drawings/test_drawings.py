"""SVG and DXF: what is drawn is what is read; curves are surrounded; what cannot be read is one error with its line."""

import gzip
import math
import xml.etree.ElementTree as ElementTree
from fractions import Fraction
from pathlib import Path

import pytest
import shapely

import cfree
import drawings
from cfree.curves.drawn import Arc, Cubic, Line, Ring, bulged, ends, point_of
from cfree.curves.hulls import Outline, polygon_of
from cfree.errors import FormatError
from cfree.formats.drawings import source


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    drawings.put(tmp_path)
    return tmp_path


def of(shapes: cfree.formats.Shapes, name: str) -> list[cfree.Polygon]:
    return [shape.polygon for shape in shapes.shapes if shape.name == name]


def test_svg_is_read_as_it_is_drawn(folder: Path) -> None:
    shapes = cfree.load_shapes(folder / "a.svg", tolerance=0.4)
    wall, *ellipses = of(shapes, "walls")
    x, y = Fraction("10.2"), Fraction("-10.4")  # exactly: the transform's decimals are added as decimals
    corners = [(2 * x, 2 * y - 4), (2 * x + 200, 2 * y - 4), (2 * x + 200, 2 * y), (2 * x, 2 * y)]
    assert set(wall.exact_vertices) == set(corners)
    assert [round(float(e.exact_area) / 4 / math.pi, 1) for e in ellipses] == [
        96.7,
        87.4,
    ]  # 4 times 24; grown to reach its ends, 86.7
    (lake,) = of(shapes, "lake")
    assert len(lake.ring_offsets) == 3
    (chair,) = of(shapes, "chair")
    assert chair.bounds == pytest.approx((200, -308, 208, -300), abs=0.1)
    scene = shapes.scene()
    assert (scene.units, scene.start) == ("mm", cfree.Pose(24, -410))
    assert "a user unit is 2 mm" in shapes.changed
    assert sorted(shapes.dropped) == ["hidden rect", "open line", "text", "use of an element that is not in this file"]


def test_dxf_is_read_as_it_is_drawn(folder: Path) -> None:
    shapes = cfree.load_shapes(folder / "a.dxf", tolerance=0.001)
    (slot,), (part,), (ellipse,) = of(shapes, "walls"), of(shapes, "part"), of(shapes, "ellipse")
    assert float(slot.exact_area) == pytest.approx(40 + 4 * math.pi, abs=0.02)
    assert float(part.exact_area) == pytest.approx(10.1 * 4.2 - math.pi, abs=0.01)
    assert part.exact_area > Fraction("42.42") - Fraction(math.pi)  # outside of the true shape's hole
    assert float(ellipse.exact_area) == pytest.approx(math.pi * 29 * 0.4, abs=0.02)
    assert set(of(shapes, "furniture")[0].exact_vertices) == {(19, 40), (20, 40), (20, 46), (19, 46)}
    assert len(of(shapes, "hatch")[0].ring_offsets) == 3
    scene = shapes.scene()
    assert (scene.units, scene.start) == ("mm", cfree.Pose(2, 2))
    assert scene.workspace == cfree.Polygon([(-50, -50), (120, -50), (120, 100), (-50, 100)])
    hidden = [(note.what, note.where, note.count) for note in shapes.reading if note.kind == "hidden"]
    assert hidden == [("entity on a layer that is off", "off", 1)]


def test_packed_svg_is_read_like_its_text(folder: Path, tmp_path: Path) -> None:
    packed = gzip.compress(drawings.SVG.encode())
    (tmp_path / "b.svgz").write_bytes(packed)
    assert cfree.load_shapes(tmp_path / "b.svgz").shapes == cfree.load_shapes(folder / "a.svg").shapes
    for content, message in (
        (packed[:-20], "its end is missing; pack it anew"),
        (packed[:40] + b"\xff" + packed[41:], "damaged: "),
        (gzip.compress(bytes(source.MOST_BYTES + 1)), "more than 65,536 KiB when unpacked"),
    ):
        (tmp_path / "b.svgz").write_bytes(content)
        with pytest.raises(FormatError, match=message):
            cfree.load_shapes(tmp_path / "b.svgz")


def test_entities_that_are_names_of_namespaces_are_read(tmp_path: Path) -> None:
    names = '<!DOCTYPE svg [<!ENTITY ns_svg "http://www.w3.org/2000/svg">\n<!ENTITY ns_ai "http://ns.adobe.com/">]>'
    text = '<svg xmlns="&ns_svg;" xmlns:i="&ns_ai;"><i:x/><rect width="2" height="1"/></svg>'
    (tmp_path / "a.svg").write_text(names + text)
    assert [shape.polygon.exact_area for shape in cfree.load_shapes(tmp_path / "a.svg").shapes] == [2]


def test_lines_that_are_drawn_twice_or_are_points_count_once(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.new()
    space = document.modelspace()
    corners = [(0, 0), (4, 0), (4, 3), (0, 3)]
    for k, a in enumerate(corners):
        space.add_line(a, corners[k - 1])
        space.add_line(corners[k - 1], a)
    space.add_line((9, 9), (9 + 1e-12, 9))
    space.add_line((6, 0), (7, 0))  # there and back: no ring of two points
    space.add_line((7, 0), (6, 0))
    for first in (0, 180, 180):  # two half circles have the same ends
        space.add_arc((20, 0), 2, first, first + 180)
    document.saveas(tmp_path / "a.dxf")
    shapes = cfree.load_shapes(tmp_path / "a.dxf", tolerance=0.02)
    assert [round(float(shape.polygon.exact_area)) for shape in shapes.shapes] == [12, 13]
    assert {note.what: note.count for note in shapes.reading if note.kind == "lost"} == {"open line": 2}


@pytest.mark.parametrize("path", ["M0 0 L4 0 L2 0 Z", "M0 0 L4 0 L2 0 Z M0 0 L4 4 L4 4 Z"])
def test_rings_on_a_line_are_dropped(path: str, tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text(f"<svg><path d='{path}'/><rect width='1' height='1'/></svg>")
    shapes = cfree.load_shapes(tmp_path / "a.svg")
    assert len(shapes.shapes) == 1
    assert "ring on a line: it forbids nothing; give it width" in shapes.dropped[0]


def test_small_shapes_far_away_are_no_lines(tmp_path: Path) -> None:
    x = 10**12
    points = f"{x}.00000001 3, {x}.00000003 3, {x}.00000002 3.00000001"
    (tmp_path / "a.svg").write_text(f"<svg><polygon points='{points}'/></svg>")
    (shape,) = cfree.load_shapes(tmp_path / "a.svg").shapes
    assert shape.polygon.exact_area == Fraction(1, 10**16)


def test_roles_can_be_given(folder: Path) -> None:
    shapes = cfree.load_shapes(folder / "a.dxf", roles={"hatch": "ignore", "part": "robot"})
    assert (of(shapes, "hatch"), len(shapes.of("robot"))) == ([], 2)
    with pytest.raises(ValueError, match="roles: part: 'wall'; give \"robot\""):
        cfree.load_shapes(folder / "a.dxf", roles={"part": "wall"})


RINGS: dict[str, Ring] = {
    "circle": [Arc((3.1, -2), (2, 0), (0, 2), 0.3, 0.3 + math.tau)],
    "ellipse": [Arc((0, 0), (5, 1), (0.2, -0.7), 0, -math.tau)],
    "bulges": [bulged((0, 0), (4, 0), 0.7), bulged((4, 0), (4, 3), -0.4), Line(point_of(4, 3), point_of(0, 0))],
    "s": [
        Cubic(((0, 0), (3, -4), (5, 4), (8, 0))),
        Line(point_of(8, 0), point_of(8, 6)),
        Cubic(((8, 6), (6, 3), (1, 9), (0, 6))),
        Line(point_of(0, 6), point_of(0, 0)),
    ],
}


def sampled(ring: Ring) -> list[tuple[float, float]]:
    points = []
    for segment in ring:
        for t in (k / 500 for k in range(500)):
            if isinstance(segment, Arc):
                points.append(segment.at(segment.first + t * (segment.last - segment.first)))
            else:
                p = segment.points if isinstance(segment, Cubic) else ends(segment)
                weights = (1 - t, t) if len(p) == 2 else ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3)
                points.append(tuple(sum(w * q[k] for w, q in zip(weights, p, strict=True)) for k in (0, 1)))
    return points


@pytest.mark.slow
@pytest.mark.parametrize("name", RINGS)
@pytest.mark.parametrize("error", [0.3, 0.001])
def test_polygons_are_around_curves_or_inside_and_near(name: str, error: float) -> None:
    curve = shapely.Polygon(sampled(RINGS[name]))
    points = shapely.points(sampled(RINGS[name]))
    for inside in (False, True):
        polygon = polygon_of(Outline(RINGS[name]), error, inside).to_shapely()
        assert shapely.distance(polygon.boundary, points).max() <= error
        assert polygon.boundary.hausdorff_distance(curve.boundary) <= error + 1e-4
        strangers = points[
            shapely.contains_properly(polygon, points) if inside else ~shapely.intersects(polygon, points)
        ]
        assert not len(strangers) or shapely.distance(polygon, strangers).max() == 0 or not inside
        assert all(shapely.distance(polygon.boundary, p) < 1e-12 for p in strangers)  # on straight sides, rounded


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.svg", "<svg>\n<g>", "a.svg:2:4 no element found; give XML"),
        ("a.svg", '<svg><g transform="turn(3)"/></svg>', "a.svg:1:1 g: transform: 'turn(3)'; write it like"),
        ("a.svg", '<svg><path d="M0 0h9a5-1e308 0 0 1 0 9z"/></svg>', "-1e308 is no coordinate"),
        ("a.svg", "<html/>", "a.svg:1:1 expected an element svg, got html; give SVG"),
        ("a.svg", "<svg>" + "<g>" * 200, "nested more than 100 deep"),
        ("a.svg", '<svg>\n<rect width="7x" height="3"/></svg>', "a.svg:2:1 rect: width: '7x' is no length"),
        ("a.svg", '<svg><g id="a"><use href="#a"/></g></svg>', "nested more than 100 deep"),
        (
            "a.svg",
            '<!DOCTYPE svg [<!ENTITY a "b">\n<!ENTITY c "&a;&a;">]><svg>&c;</svg>',
            "entity c: only texts of up to 200 characters are read",
        ),
        ("a.svg", f'<!DOCTYPE svg [<!ENTITY a "{"b" * 201}">]><svg/>', "entity a: only texts of up to 200 characters"),
        ("a.svg", '<!DOCTYPE svg [<!ENTITY a SYSTEM "/etc/passwd">]><svg>&a;</svg>', "entity a: only texts of up"),
        (
            "a.svg",
            '<svg><g id="a0"><rect width="1" height="1"/></g>'
            + "".join(f'<g id="a{k + 1}">' + f'<use href="#a{k}"/>' * 10 + "</g>" for k in range(12))
            + "</svg>",
            "more than 3,000 elements and points, references expanded",
        ),
        ("a.dxf", "hello", "a.dxf:1:1"),
        ("a.urdf", '<robot><joint name="j"/></robot>', "a.urdf:1:1 joint j: its links are not there"),
        ("a.yaml", "a: [b", "a.yaml:1:6"),
        ("a.yaml", "image: ../map.pgm\nresolution: 1\norigin: [0, 0, 0]", "is outside of the map's folder"),
        ("a.yaml", "image: /etc/passwd\nresolution: 1\norigin: [0, 0, 0]", "is outside of the map's folder"),
        ("a.yaml", "image: a.pgm\nresolution: x\norigin: [0, 0]", "a.yaml:2:13 resolution: 'x' is no number"),
        ("a.yaml", 'footprint: "[[1, 2], [3]]"', "a.yaml:1:12 footprint: '[[1, 2], [3]]'; write it like"),
        ("a.yaml", "a: &a [*a]\nfootprint: *a", "write it like"),
        ("a.json", '{"items": [{"shape": {"type": "circle"}}]}', 'a.json:1:22 items[0].shape: expected a shape'),
    ],
)  # fmt: skip
def test_what_cannot_be_read_is_one_error_with_its_place(
    name: str, text: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(source, "MOST_STEPS", 3000)
    (tmp_path / name).write_text(text)
    with pytest.raises(FormatError) as caught:
        cfree.load_shapes(tmp_path / name)
    assert message in str(caught.value)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["paper_fig9", "flat", "street_Berlin", "degenerate_workspace", "benchmr_parking1"])
@pytest.mark.parametrize("suffix", [".geojson", ".svg", ".dxf"])
def test_written_scenes_are_read_as_they_were(name: str, suffix: str, tmp_path: Path) -> None:
    scene = cfree.load_scene(f"examples/scenes/{name}.json")
    cfree.save(scene, tmp_path / f"a{suffix}")
    assert cfree.load(tmp_path / f"a{suffix}") == scene


def test_names_and_exact_numbers_survive_where_they_can(tmp_path: Path) -> None:
    scene = cfree.Scene(
        [(0, 0), ("1/3", 0), (0, 1)],
        [[(3, 0), (4, 0), (4, "0.1")]],
        obstacle_names=['robot "<a>"'],
        goals=[(1, 2), (3, 4)],
    )
    cfree.save(scene, tmp_path / "a.geojson")
    assert cfree.load(tmp_path / "a.geojson") == scene
    cfree.save(scene, tmp_path / "a.svg")
    drawn = cfree.load(tmp_path / "a.svg")
    assert isinstance(drawn, cfree.Scene)
    assert (drawn.obstacles, drawn.obstacle_names, drawn.goals) == (scene.obstacles, scene.obstacle_names, scene.goals)
    assert drawn.robot[0].exact_vertices[1][0] == Fraction("0.33333333333333")
    ElementTree.parse(tmp_path / "a.svg")


def test_a_thin_ellipse_in_a_drawing_does_not_turn_inside_out(tmp_path: Path) -> None:
    for ry in ("0.2", "0.0002", "0.0000002"):
        text = f'<svg><ellipse id="workspace" cx="5" cy="3" rx="4" ry="{ry}" transform="rotate(30)"/></svg>'
        (tmp_path / "thin.svg").write_text(text)
        (room,) = cfree.load_shapes(tmp_path / "thin.svg", tolerance=0.007).shapes
        share = float(room.polygon.exact_area) / (math.pi * 4 * float(ry))
        assert room.role == "workspace" and 0.9 < share < 1, ry
        (tmp_path / "thin.svg").write_text(text.replace("workspace", "obstacle"))
        (wall,) = cfree.load_shapes(tmp_path / "thin.svg", tolerance=0.007).shapes
        assert 1 < float(wall.polygon.exact_area) / (math.pi * 4 * float(ry)) < 1.1, ry
