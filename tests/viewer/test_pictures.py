"""What notebooks show of values: well-formed, small, without anything active, and at the right place."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

import cfree
import cfree.viewer.pictures
from cfree.palette import AHEAD, BACK, PATH
from cfree.planning.unreachable import BoxGrid
from cfree.value import Shown
from cfree.viewer.svg import Panel

ROOM = [(0, 0), (9, 0), (9, 9), (0, 9)]
ROBOT = [(0, 0), (2, 0), (0, 1)]
ROUND = cfree.Curved.circle((0, 0), 1)
DRAWN = {"svg", "g", "path", "circle", "rect", "text", "image"}


def scene_of(**more: Any) -> cfree.Scene:
    wall = [(4, 0), (5, 0), (5, 9), (4, 9)]
    return cfree.Scene(ROBOT, [wall], **({"workspace": ROOM, "start": (1, 1, 0), "goal": (6, 1, 0)} | more))


def drawn(svg: str) -> list[ElementTree.Element]:
    """Its elements, which draw and do nothing else."""
    found = list(ElementTree.fromstring(svg).iter())
    assert {element.tag.removeprefix("{http://www.w3.org/2000/svg}") for element in found} <= DRAWN
    for element in found:
        assert not any(name.startswith("on") or name in ("id", "class", "style") for name in element.attrib)
        assert element.get("href", "data:image/png;base64,").startswith("data:image/png;base64,")
    return found


@pytest.fixture(scope="module")
def values() -> dict[str, Any]:
    scene = scene_of()
    boundary = cfree.boundary(scene)
    space = cfree.free_space(boundary)
    path = cfree.plan(scene, goal=(1, 7, "90deg"))
    goals = cfree.plan(scene_of(goal=[(6, 1, 0), (6, 5)]))
    start, goal = cfree.Pose(1, 1), cfree.Pose(6, 1)
    held = cfree.Stuck(start, goal, cfree.Car(1), "start", "pieces", (start,), (0,), scene=scene)
    grid = BoxGrid((Fraction(0), Fraction(0)), Fraction(1), Fraction(1), 1, 1, 8)
    car = cfree.Car(1, gears="forward")
    shut = cfree.Unreachable(start, goal, car, "start", (), grid, b"", scene=scene)
    parts = shut, scene, boundary, space, space.cells[0], path, cfree.plan(scene), goals, boundary.slice(0.3), held
    return {type(value).__name__: value for value in (*parts, boundary.mesh(0.5), scene.obstacles[0], ROUND)}


def test_values_are_drawn(values: dict[str, Any]) -> None:
    kinds = {kind.__name__ for kind in vars(cfree.viewer.pictures).values() if isinstance(kind, type)}
    assert {kind.__name__ for kind in Shown.__subclasses__()} == set(values) <= kinds
    for value in values.values():
        svg = value._repr_svg_()
        assert len(drawn(svg)) > 3 and len(svg) < 200_000
        assert repr(value)[:20] in "".join(ElementTree.fromstring(svg).itertext())


def test_cells_have_colours_of_their_own(values: dict[str, Any]) -> None:
    cells = values["FreeSpace"].cells
    strokes = [re.findall(r'fill="none" stroke="(#\w+)"', cell._repr_svg_()) for cell in cells]
    assert len(cells) == 2 and len({colour for of in strokes for colour in of}) > 2  # one each, and the workspace's


def test_names_stay_text() -> None:
    name = "</text><script>alert(1)</script><img src=x onerror='alert(1)'>\x00\u202e"
    svg = scene_of(name=name, obstacle_names=[name])._repr_svg_()
    assert svg is not None and "<img src=x" in "".join(e.text or "" for e in drawn(svg))


def test_robot_is_drawn_at_its_start() -> None:
    panel = Panel((0, 0, 4, 2), 400, 400)
    assert panel.pixels(np.array([(0.0, 0.0), (4.0, 2.0)])).tolist() == [[0, 300], [400, 100]]
    left, right = (scene_of(workspace=None, goal=None, start=(x, 1, 0))._repr_svg_() for x in (-3, 12))
    place = [float(next(e for e in drawn(str(svg)) if e.tag.endswith("circle")).get("cx", "")) for svg in (left, right)]
    assert place[0] < 3200 < place[1]


@pytest.mark.slow
def test_many_obstacles_make_a_small_picture() -> None:
    x, y = np.divmod(np.arange(10_000), 200)
    corners = np.array([(0, 0), (2, 0.25), (1.5, 2), (0.25, 1.5)])
    scene = cfree.Scene(ROBOT, list(np.column_stack([3 * x, 3 * y])[:, None] + corners), start=(-3, 0, 0))
    assert 20_000 < len(str(scene._repr_svg_())) < 500_000


def test_coordinates_of_any_size_are_drawn() -> None:
    far = cfree.Scene(ROBOT, [[(3, 0), ("1e100", 0), (4, 1)]], bounds=(-9, -9, 9, 9), start=(0, 0, 0))
    for scene in (far, cfree.Scene(ROBOT), cfree.Scene([(0, 0), ("1e140", 0), (0, "1e140")])):
        numbers = re.findall(r"-?\d+", " ".join(e.get("d", "") for e in drawn(str(scene._repr_svg_()))))
        assert numbers and max(map(len, numbers)) <= 7


def test_what_is_not_known_is_not_drawn(
    values: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cfree.save(values["Separated"], tmp_path / "answer.json")
    assert cfree.load(tmp_path / "answer.json")._repr_svg_() is None
    assert drawn(cfree.Path(cfree.Pose(0, 0), [cfree.Translation((1, 1))])._repr_svg_() or "")
    monkeypatch.setattr(cfree.Boundary, "complete", False)
    assert values["Boundary"]._repr_svg_() is None and values["FreeSpace"]._repr_svg_() is None


def test_paths_have_few_ghosts_and_slices_say_where_the_reference_point_may_be(values: dict[str, Any]) -> None:
    far = cfree.Path(cfree.Pose(0, 0), [cfree.Translation((900, 0))], scene=cfree.Scene(ROBOT))
    for path in (values["Path"], far):
        ghosts = re.findall('fill-opacity=".3"', str(path._repr_svg_()))
        assert 0 < len(ghosts) <= 15
    assert len(ghosts) == 15
    assert "the reference point may be here" in str(values["Slice"]._repr_svg_())


def test_paths_of_vehicles_have_the_colours_of_their_gears_and_dots_where_these_change() -> None:
    scene = cfree.Scene(ROBOT)
    moves = [cfree.Translation((5, 0)), cfree.Translation((-2, 0))]
    for vehicle, colours, dots in ((cfree.Car(2), (AHEAD, BACK), 1), (None, (PATH,), 2)):
        path = cfree.Path(cfree.Pose(0, 0), moves, vehicle=vehicle, scene=scene)
        svg = str(path._repr_svg_())
        assert drawn(svg)
        assert {colour for colour in (AHEAD, BACK, PATH) if f'stroke="{colour}"' in svg} == {*colours}
        assert svg.count("<circle") == dots  # without a vehicle those of start and goal


def test_names_beside_one_robot_do_not_touch() -> None:
    svg = str(scene_of(start=(1, 3, 0), goal=(1, 3, 0))._repr_svg_())
    start, goal = (
        (float(e.get("x", "")), float(e.get("y", ""))) for e in drawn(svg) if (e.text or "") in ("start", "goal")
    )
    assert abs(start[0] - goal[0]) > 300 or abs(start[1] - goal[1]) > 150  # tenths of a pixel
