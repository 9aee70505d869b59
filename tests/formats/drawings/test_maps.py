"""ROS maps, footprints, URDF and nesting instances."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import shapely

import cfree
import drawings
from cfree.errors import FormatError
from cfree.formats.drawings.grid import outlines


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    drawings.put(tmp_path)
    return tmp_path


@pytest.mark.parametrize("tolerance", [1e-300, 1e-15])
def test_a_tolerance_that_asks_for_too_many_sides_is_refused(tolerance: float, folder: Path) -> None:
    with pytest.raises(FormatError, match="more than 3,000,000 elements and points"):
        cfree.load_shapes(folder / "r.urdf", tolerance=tolerance)


def test_a_padding_beyond_doubles_is_a_fault_with_its_place(folder: Path) -> None:
    (folder / "p.yaml").write_text("robot_radius: 1\nfootprint_padding: 1e400\n")
    with pytest.raises(FormatError, match=r"p.yaml:2:20 footprint_padding: 1e9 or more; give a shorter length"):
        cfree.load_shapes(folder / "p.yaml")


def test_a_map_has_exact_cells(folder: Path) -> None:
    #    . . . .      the image's first row is the top; ? is unknown
    #    . # # .
    #    . . # ?      its lower left corner is the origin
    shapes = cfree.load_shapes(folder / "map.yaml", unknown="free")
    left, low, cell = Fraction("-1.5"), Fraction(2), Fraction("0.05")
    corners = [(2, 0), (3, 0), (3, 2), (1, 2), (1, 1), (2, 1)]
    (found,) = shapes.polygons
    assert set(found.exact_vertices) == {(left + x * cell, low + y * cell) for x, y in corners}
    assert [note.what for note in shapes.reading if note.effect == "less"] == ["unknown cell: free"]
    both = cfree.load_shapes(folder / "map.yaml")
    assert [shape.role for shape in both.shapes] == ["obstacle", "workspace"]
    assert both.polygons[0].exact_area == 4 * cell**2
    assert both.polygons[1].exact_area == 12 * cell**2
    with pytest.raises(FormatError, match="there is no robot; give one: --robot"):
        cfree.load_scene(folder / "map.yaml")
    robot = cfree.load_polygons(folder / "nav.yaml")
    assert both.scene(robot).robot == robot


def test_a_map_may_be_turned_negated_and_a_png(folder: Path) -> None:
    (folder / "map.png").write_bytes(drawings.png([[255, 0], [0, 0]]))
    text = (
        drawings.MAP.replace("pgm", "png").replace("negate: 0", "negate: 1").replace("2, 0]", "2, 1.5707963267948966]")
    )
    (folder / "b.yaml").write_text(text)
    (cell,) = cfree.load_shapes(folder / "b.yaml", unknown="free").polygons
    r = Fraction("0.05")
    x, y = Fraction("-1.5") - r, Fraction(2)  # the top left pixel is the upper cell: after a quarter turn the left one
    assert set(cell.exact_vertices) == {(x - r, y), (x, y), (x, y + r), (x - r, y + r)}


@pytest.mark.parametrize("seed", range(40))
def test_outlines_are_simple_and_cover_the_cells(seed: int) -> None:
    random = np.random.default_rng(seed)
    mask = random.random(random.integers(1, 9, 2)) < random.random()
    polygons = [cfree.Polygon(outer, holes) for outer, *holes in outlines(mask)]  # it refuses rings that touch
    assert not any(polygon.removed for polygon in polygons)
    assert sum(polygon.exact_area for polygon in polygons) == mask.sum()
    cells = shapely.union_all([shapely.box(c, r, c + 1, r + 1) for r, c in zip(*np.nonzero(mask), strict=True)])
    assert shapely.union_all([polygon.to_shapely() for polygon in polygons]).equals(cells)


def test_footprints(folder: Path) -> None:
    shapes = cfree.load_shapes(folder / "nav.yaml")
    box = cfree.Polygon([("0.5", "0.25"), ("-0.5", "0.25"), ("-0.5", "-0.25"), ("0.5", "-0.25")])
    assert box == cfree.footprint("[[.5,.25],[-.5,.25],[-.5,-.25],[.5,-.25]]")
    (padded,) = shapes.polygons  # the disc of the other costmap is in it
    assert padded.bounds == (-0.51, -0.26, 0.51, 0.26)
    assert [(note.kind, note.what) for note in shapes.reading if note.effect == "more"] == [
        ("guess", "different footprint: the robot is all of them"),
        ("info", "padding by nav2's rule"),
    ]
    (folder / "radius.yaml").write_text("robot_radius: 0.22")
    (disc,) = cfree.load_polygons(folder / "radius.yaml")
    assert 0.22 < min(np.hypot(*disc.vertices.T)) < 0.221
    assert shapely.Point(0, 0).buffer(0.22).within(disc.to_shapely())
    for text in ("", "[]", "[[1, 2]", "[[1, 2], [3, 4]]", "[[0, 0], [1, 0], [0, x]]", "[[0, 0], [1, 0], [0, 1]"):
        with pytest.raises(FormatError, match="footprint: "):
            cfree.footprint(text)


def test_two_different_footprints_are_both_the_robot(folder: Path) -> None:
    (folder / "two.yaml").write_text("a: {robot_radius: 1}\nb: {footprint: [[0, 0], [3, 0], [0, 3]]}")
    shapes = cfree.load_shapes(folder / "two.yaml")
    disc, triangle = shapes.polygons
    assert (round(disc.area, 2), triangle.exact_area) == (3.14, Fraction(9, 2))
    assert [(note.kind, note.count) for note in shapes.reading if note.effect == "more"] == [("guess", 2)]


def test_urdf_seen_from_above(folder: Path) -> None:
    a, b = Fraction("0.3"), Fraction("0.2")
    base, wheel, lidar = cfree.load_scene(folder / "r.urdf").robot
    assert set(base.exact_vertices) == {(x, y) for x in (a, -a) for y in (b, -b)}
    assert wheel.bounds == pytest.approx((0.0, 0.2, 0.2, 0.25), abs=1e-3)
    assert shapely.Point(0.3, 0).buffer(0.05).within(lidar.to_shapely())


def test_nesting(folder: Path) -> None:
    shapes = cfree.load_shapes(folder / "n.json")
    first, second, strip = shapes.polygons
    assert first == cfree.Polygon([(8, 8), (4, 8), (8, 5)])  # a half turn, exactly, since it is allowed
    assert second == cfree.Polygon([(12, 1), (16, 1), (16, 5), (12, 5)], [[(13, 2), (14, 2), (13, 3)]])
    assert strip == cfree.Polygon([(0, 0), (30, 0), (30, 10), (0, 10)])
    scene = cfree.load_shapes(folder / "n.json", roles={"item 0": "robot"}).scene()
    assert (scene.robot, scene.obstacle_names) == ((cfree.Polygon([(0, 0), (4, 0), (0, 3)]),), ("item 1",))
    (folder / "old.json").write_text(
        '{"Name": "a", "Items": [{"Demand": 1, "Shape": {"Type": "SimplePolygon", "Data": [[0, 0], [1, 0], [0, 1]]}}]}'
    )
    assert cfree.load_polygons(folder / "old.json") == (cfree.Polygon([(0, 0), (1, 0), (0, 1)]),)


def test_what_nesting_leaves_out_is_said(folder: Path) -> None:
    def notes(roles: dict[str, str], text: str = "") -> list[tuple[str, str, int, str]]:
        (folder / "m.json").write_text(text or drawings.NESTING)
        shapes = cfree.load_shapes(folder / "m.json", roles=roles)
        return [(note.kind, note.what, note.count, note.where) for note in shapes.reading]

    often = ("info", "item, wanted several times and read once", 1, "")
    assert notes({}) == [often]
    assert notes({"item 0": "robot"})[1:] == [("info", "unread place: its item is the robot", 1, "item 0")]
    assert notes({"item 1": "ignore"})[0] == ("assumption", "ignored item", 1, "item 1")
    again = drawings.NESTING.replace('"placed_items": [', '"placed_items": [{"item_id": 0},')
    lost = ("lost", "further copy of the robot's item", 1, "item 0")
    assert lost in notes({"item 0": "robot"}, again)
    alone = drawings.NESTING.replace('"solution"', '"other"')
    assert notes({}, alone)[0] == ("lost", "item without a place, in no scene", 2, "")
    assert ("info", "strip without a length, no workspace", 1, "") in notes({}, alone)
    first = drawings.NESTING.replace('{"item_id": 0, "transformation"', '{"item_id": 1, "transformation"')
    assert ("lost", "item without a place, in no scene", 1, "") in notes({}, first)


def test_visual_shapes_of_a_link_without_collision_shapes_are_read(tmp_path: Path) -> None:
    box = '<geometry><box size="2 1 1"/></geometry>'
    mesh = '<geometry><mesh filename="a.stl"/></geometry>'
    for collision, size, kinds in (
        ("", 2, ["guess"]),
        (f"<collision>{mesh}</collision>", 2, ["lost", "guess"]),
        (f"<collision>{box.replace('2', '4')}</collision>", 4, []),
    ):
        link = f'<link name="body">{collision}<visual>{box}</visual></link>'
        (tmp_path / "r.urdf").write_text(f'<robot name="r">{link}</robot>')
        shapes = cfree.load_shapes(tmp_path / "r.urdf")
        assert shapes.polygons[0].exact_area == size
        assert [note.kind for note in shapes.reading] == kinds
        assert shapes.settings["source"] == {"robot frame": "body"}


def test_geojson_properties_of_the_robot_are_the_scenes(tmp_path: Path) -> None:
    text = """{"type": "Feature", "properties": {"role": "robot", "bounds": [0, 0, 9, 9.5], "start": [1, 1, "90deg"],
 "goal": [8, "7/3"], "colour": 3, "goals": null}, "geometry": {"type": "Polygon",
 "coordinates": [[[0, 0], [1, 0], [0, 1]]]}}"""
    (tmp_path / "a.geojson").write_text(text)
    scene = cfree.load_scene(tmp_path / "a.geojson")
    assert (scene.bounds, scene.start, scene.goals) == (
        (0, 0, 9, Fraction("9.5")),
        cfree.Pose(1, 1, "90deg"),
        ((8, Fraction(7, 3)),),
    )
    (tmp_path / "b.geojson").write_text(text.replace('"90deg"', '"90dg"').replace("9.5", '"x"'))
    with pytest.raises(FormatError) as caught:
        cfree.load_scene(tmp_path / "b.geojson")
    assert "b.geojson:1:73 properties.bounds[3]: expected a number" in str(caught.value)
    assert "properties.start[2]: " in str(caught.value)
