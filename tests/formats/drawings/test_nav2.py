"""Footprints in parameters, and their padding."""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from cfree.curves.curved import Curved
from cfree.errors import FormatError
from cfree.formats.drawings.source import Reading, Source
from cfree.formats.padding import contains, padded
from cfree.formats.readers import read_file
from cfree.formats.shapes import Shapes
from cfree.polygons.polygon import Polygon


def read(folder: Path, text: str, **options: Any) -> Shapes:
    (folder / "n.yaml").write_text(text)
    shapes = read_file(folder / "n.yaml", Reading(**options))
    assert isinstance(shapes, Shapes)
    return shapes


def region(parts: Any) -> Any:
    """The union of polygons."""
    return shapely.union_all([polygon.to_shapely() for polygon in parts])


def as_nav2_pads(points: Any, by: float) -> Any:
    """The padded outline of nav2."""
    moved = [(x + math.copysign(by, x) * (x != 0), y + math.copysign(by, y) * (y != 0)) for x, y in points]
    return shapely.Polygon(moved)


def test_the_collision_monitors_polygons_are_the_robot_by_role(tmp_path: Path) -> None:
    text = """collision_monitor: {ros__parameters: {polygons: ["Stop", "Round"],
 Stop: {type: polygon, points: [0.3, 0.3, 0.3, -0.3, 0.0, -0.3], action_type: stop},
 Old: {points: "[[0.3, 0.3], [0.3, -0.3], [0.0, -0.3]]"}, Round: {type: circle, radius: 0.5}}}"""
    with pytest.raises(FormatError, match='give one of the zones the role, such as --role "Stop=robot"'):
        read(tmp_path, text)
    for name in ("Stop", "Old"):
        shapes = read(tmp_path, text, roles={name: "robot"})
        assert shapes.polygons == (Polygon([("0.3", "0.3"), ("0.3", "-0.3"), (0, "-0.3")]),)
    shapes = read(tmp_path, text, roles={"Round": "robot", "Stop": "obstacle", "Old": "ignore"})
    assert [(shape.role, shape.name) for shape in shapes.shapes] == [("robot", None), ("obstacle", "Stop")]
    assert round(shapes.polygons[0].area, 2) == 0.79
    shapes = read(tmp_path, f"footprint: [[0, 0], [1, 0], [0, 1]]\n{text}")
    assert [(note.kind, note.where) for note in shapes.reading] == [("hidden", n) for n in ("Stop", "Old", "Round")]


@pytest.mark.parametrize(
    ("model", "area"),
    [
        ("{type: polygon, vertices: [[0, 0], [1, 0], [0, 1]]}", 0.5),
        ("{type: circular, radius: 0.5}", math.pi / 4),
        ("{type: two_circles, front_offset: 1, front_radius: 0.5, rear_offset: 2, rear_radius: 1}", math.pi * 1.25),
    ],
)
@pytest.mark.parametrize("form", ["{}", "dots", "slashes"])
def test_footprint_models_of_teb(tmp_path: Path, model: str, area: float, form: str) -> None:
    text = f"TebLocalPlannerROS: {{footprint_model: {model}}}"
    if form != "{}":
        mark = "." if form == "dots" else "/"
        members = model.strip("{}").replace("], [", "];[").split(", ")
        rows = [f"  footprint_model{mark}{member.replace('];[', '], [')}" for member in rejoined(members)]
        text = "TebLocalPlannerROS:\n" + "\n".join(rows)
    shapes = read(tmp_path, text)
    assert region(shapes.polygons).area == pytest.approx(area, rel=5e-3)
    if "two" in model:
        x0, _, x1, _ = region(shapes.polygons).bounds
        assert (x0, x1) == pytest.approx((-3, 1.5), abs=5e-3)


def rejoined(members: list[str]) -> list[str]:
    """Members of a mapping, lists of points whole."""
    rows: list[str] = []
    for member in members:
        if ":" in member:
            rows.append(member)
        else:
            rows[-1] += f", {member}"
    return rows


@pytest.mark.parametrize("kind", ["point", "line"])
def test_a_model_without_an_area_is_lost_or_no_robot(tmp_path: Path, kind: str) -> None:
    text = f"a: {{footprint_model: {{type: {kind}, line_start: [0, 0], line_end: [1, 0]}}}}"
    with pytest.raises(FormatError, match='no "footprint" and no "robot_radius"'):
        read(tmp_path, text)
    shapes = read(tmp_path, f"{text}\nb: {{robot_radius: 1}}")
    assert (shapes.reading[0].kind, shapes.reading[0].where) == ("lost", kind)


def test_a_costmap_uses_its_radius_only_without_a_footprint(tmp_path: Path) -> None:
    shapes = read(tmp_path, 'a: {footprint: "[]", robot_radius: 1}')
    assert round(shapes.polygons[0].area, 1) == 3.1
    shapes = read(tmp_path, "a: {footprint: [[0, 0], [1, 0], [0, 1]], robot_radius: 0}")
    assert shapes.polygons[0].exact_area == Fraction(1, 2)
    assert [(note.kind, note.what) for note in shapes.reading] == [
        ("info", "unused robot_radius: there is a footprint")
    ]


def test_the_padded_robot_is_drawn_and_padded(tmp_path: Path) -> None:
    text = "footprint: [[2, 0], [4, 0], [4, 1], [2, 1]]\nfootprint_padding: 0.5"
    shapes = read(tmp_path, text)
    assert [polygon.bounds for polygon in shapes.polygons] == [(2, 0, 4, 1), (2.5, 0, 4.5, 1.5)]
    assert [(note.kind, note.effect, note.size) for note in shapes.reading] == [("guess", "more", 0.5)]
    option = read(tmp_path, text.partition("\n")[0], padding=0.5)
    assert (option.polygons, option.reading) == (shapes.polygons, shapes.reading)
    assert read(tmp_path, text, padding=0.25).polygons == shapes.polygons
    box = "footprint: [[1, 1], [-1, 1], [-1, -1], [1, -1]]"
    assert read(tmp_path, box, padding=0.5).polygons[0].bounds == (-1.5, -1.5, 1.5, 1.5)
    apart = f"a: {{footprint_padding: 0.5}}\nb:\n  {box}\nc: {{robot_radius: 0.1, footprint_padding: 3}}"
    assert [part.bounds for part in read(tmp_path, apart.replace("3", "0")).polygons] == [(-1.5, -1.5, 1.5, 1.5)]
    negative = read(tmp_path, f"{box}\nfootprint_padding: -0.5")
    assert negative.polygons[0].bounds == (-1, -1, 1, 1)
    assert [note.what for note in negative.reading] == ["negative footprint_padding, not applied"]


@pytest.mark.parametrize("seed", range(60))
def test_no_padding_makes_the_robot_smaller_than_drawn_or_than_nav2_pads_it(seed: int) -> None:
    random = np.random.default_rng(seed)
    count = int(random.integers(4, 9))
    angles = (np.arange(count) + random.uniform(0, 0.9, count)) * math.tau / count
    radii = random.uniform(0.2, 1, count) if seed % 2 else np.ones(count)
    shift = random.uniform(-0.8, 0.8, 2) if seed % 3 else np.zeros(2)
    points = np.round(np.c_[np.cos(angles), np.sin(angles)] * radii[:, None] + shift, 3)
    drawn, by = Polygon([(str(x), str(y)) for x, y in points]), Fraction(1, 10)
    parts = padded(Source(""), drawn, by)
    larger = as_nav2_pads(points.tolist(), 0.1)
    if not larger.is_valid:
        (part,) = parts
        assert isinstance(part, Curved)
        assert float(part.grown) >= 0.1 * math.sqrt(2)
        return
    whole = region(parts)
    for outline in (drawn.to_shapely(), larger):
        assert outline.difference(whole).area < 1e-9
    assert whole.difference(shapely.union(drawn.to_shapely(), larger)).area < 1e-9


def test_an_outline_that_crosses_itself_when_padded_is_grown_by_a_disc() -> None:
    source = Source("")
    drawn = Polygon([(-1, 4), (4, -4), (0, 1), (-2, -4)])
    assert not as_nav2_pads(drawn.exact_vertices, 2).is_valid
    (grown,) = padded(source, drawn, Fraction(2))
    assert isinstance(grown, Curved)
    assert 2 * math.sqrt(2) <= float(grown.grown) < 2.83
    (note,) = source.notes
    assert (note.kind, note.effect) == ("guess", "more")


@pytest.mark.parametrize("radius", [0.22, 0.5, 3])
def test_a_padded_radius_contains_the_disc_and_the_padded_polygon_of_nav2(tmp_path: Path, radius: float) -> None:
    (robot,) = read(tmp_path, f"robot_radius: {radius}\nfootprint_padding: 0.1").polygons
    sixteen = [(math.cos(k * math.tau / 16) * radius, math.sin(k * math.tau / 16) * radius) for k in range(16)]
    outline = robot.to_shapely().buffer(1e-12)
    assert outline.covers(as_nav2_pads(sixteen, 0.1))
    assert outline.covers(shapely.Point(0, 0).buffer(radius))
    assert robot.bounds == pytest.approx((-radius - 0.1, -radius - 0.1, radius + 0.1, radius + 0.1), rel=5e-3)


@pytest.mark.parametrize("seed", range(40))
def test_containment_is_exact(seed: int) -> None:
    random = np.random.default_rng(seed)

    def star() -> Polygon:
        n = int(random.integers(4, 9))
        angles = np.arange(n) * math.tau / n
        radii = random.integers(1, 9, n)
        return Polygon(
            [(int(8 * r * math.cos(a)), int(8 * r * math.sin(a))) for r, a in zip(radii, angles, strict=True)]
        )

    outer, inner = star(), star()
    assert contains(outer, inner) == outer.to_shapely().covers(inner.to_shapely())
    assert contains(outer, outer)


def test_the_frame_of_the_robot_is_kept(tmp_path: Path) -> None:
    assert read(tmp_path, "robot_radius: 1").settings["source"] == {"robot frame": "base_link"}
    named = read(tmp_path, "robot_radius: 1\nrobot_base_frame: base_footprint")
    assert named.settings["source"] == {"robot frame": "base_footprint"}
