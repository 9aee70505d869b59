"""SVG files in the page: what it reads is what the package reads; else it names the command."""

from __future__ import annotations

from pathlib import Path

import pytest

import cfree
from pages import Tried

pytestmark = pytest.mark.slow

ROOMS = """<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="100mm" viewBox="0 0 200 100">
  <g id="workspace" style="fill:none;stroke:#000"><rect x="0" y="0" width="200" height="100"/></g>
  <g id="walls"><rect x="95" y="0" width="10" height="38"/>
    <path d="M95 100 v-38 a5 5 0 0 1 10 0 v38 z"/><circle cx="150" cy="60" r="12"/>
    <rect id="table" x="20" y="60" width="30" height="20" rx="6"/>
    <path id="plate" fill-rule="evenodd" d="M130 10h40v25h-40zM140 15v15h20v-15z"/>
    <polygon points="40,10 60,10 50,27.5" transform="translate(5 2) rotate(90 50 15)"/></g>
  <circle id="pivot" cx="25" cy="40" r="1"/><g id="robot"><path d="M17 36 h16 v8 h-16 z"/></g>
  <text x="10" y="10">room</text><line x1="0" y1="50" x2="20" y2="50" stroke="black"/></svg>"""
ISLANDS = """<svg xmlns="http://www.w3.org/2000/svg"><rect class="robot" x="-2" y="-1" width="4" height="2"/>
  <path id="rings" d="M20 0H60V40H20Z M30 10V30H50V10Z M36 16H44V24H36Z" transform="matrix(0 1 -1 0 3 0.5)"/>
  <path d="M-30 -30 l 3e0,.5-1,4 z m 10 0 a 4 4 0 1 1 -.001 3" transform="scale(1.5)"/>
  <g transform="rotate(30)"><rect x="-60" width="9" height="5"/></g>
  <g display="none"><rect width="99" height="99"/></g></svg>"""


@pytest.mark.parametrize(
    ("content", "left_out"),
    [
        (ROOMS, "Left out: 1 text, 1 open line; `cfree convert drawing.svg scene.json --strokes drawn` makes walls"),
        (ISLANDS, "Left out: 1 hidden element. Of 1 arc the center is rounded."),
    ],
    ids=["rooms", "islands"],
)
def test_shapes_of_a_plain_svg_are_those_of_the_package(
    tried: Tried, content: str, left_out: str, tmp_path: Path
) -> None:
    file = tmp_path / "drawing.svg"
    file.write_text(content)
    tried.built(lambda: tried.give(content, "drawing.svg"))
    tried.say("#edit", left_out)
    found, expected = cfree.load_scene(tried.saved("scene", tmp_path / "found.json")), cfree.load_scene(file)
    assert (found.start, found.units, found.obstacle_names) == (
        expected.start,
        expected.units,
        expected.obstacle_names,
    )
    assert len(found.obstacles) == len(expected.obstacles) and (found.workspace == expected.workspace)
    pairs = zip((*found.robot, *found.obstacles), (*expected.robot, *expected.obstacles), strict=True)
    for one, other in pairs:
        if isinstance(one, cfree.Polygon):
            assert one == other
            continue
        # arcs are written in another way
        assert isinstance(other, cfree.Curved) and len(one.holes) == len(other.holes)
        near = cfree.Scene(cfree.Curved.circle((0, 0), "1/1000"), [one])
        far = cfree.Scene(cfree.Curved.circle((0, 0), "1/1000"), [other])
        places = [(x + 0.0107, y + 0.0093, 0) for x in range(-60, 200, 3) for y in range(-100, 62, 3)]
        free = [cfree.is_free(near, place) for place in places]
        assert free == [cfree.is_free(far, place) for place in places] and not all(free)


SVG = '<svg xmlns="http://www.w3.org/2000/svg">{}</svg>'
ROBOT = '<rect id="robot" width="10" height="5"/>'


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        (
            "a.svg",
            SVG.format(ROBOT + '<path d="M9 9 C 1 2 3 4 5 6"/>'),
            "`cfree convert a.svg scene.json --outer 0.01`",
        ),
        (
            "a.svg",
            SVG.format(ROBOT + '<ellipse rx="1" ry="2"/>'),
            "an ellipse. The page reads plain SVG; `cfree convert",
        ),
        ("a.svg", SVG.format(ROBOT + '<circle r="1" transform="scale(1 2)"/>'), "an arc that its transform stretches"),
        ("a.svg", SVG.format(ROBOT + "<use href='#robot'/>"), "the element use. The page reads plain SVG"),
        ("a.svg", SVG.format(ROBOT + "<style>rect { width: 3px }</style>"), "a style sheet"),
        ("a.svg", SVG.format(ROBOT + '<g clip-path="url(#a)"/>'), "g: clip-path"),
        ("a.svg", SVG.format(ROBOT + '<rect width="1e" height="2"/>'), '"1e": expected a number'),
        ("a.svg", SVG.format(ROBOT + '<rect width="50%" height="2"/>'), '"50%": expected a number'),
        ("a.svg", SVG.format('<rect width="10" height="5"/>'), "`cfree convert a.svg scene.json --robot robot.json`"),
        ("a.svg", "<svg", "a.svg: no SVG: "),
        ("floor.dxf", "0\nSECTION", "`cfree convert floor.dxf scene.json --robot robot.json`"),
        ("map.yaml", "image: map.pgm", "`cfree convert map.yaml scene.json --robot robot.json`"),
        ("map.pgm", "P5", "open the YAML file that describes the map"),
    ],
)
def test_what_is_no_plain_svg_names_the_command_and_the_scene_stays(
    tried: Tried, name: str, content: str, told: str
) -> None:
    before = tried.outlines()
    tried.give(content, name)
    tried.say("#edit", told)
    assert tried.outlines() == before


def test_a_hostile_svg_runs_nothing_and_loads_nothing(tried: Tried) -> None:
    hostile = (
        "<script>alert(1)</script><image href='https://example.org/a.png'/>"
        "<rect onload='alert(2)' x='20' width='3' height='3'/>"
    )
    tried.page.on("dialog", lambda dialog: tried.faults.append("a script ran") or dialog.dismiss())
    tried.built(lambda: tried.give(SVG.format(ROBOT + hostile), "hostile.svg"))
    tried.say("#edit", "Left out: 1 picture.")
    assert len(tried.outlines()) == 1
    blocked = [fault for fault in tried.faults if fault.startswith("Executing inline event handler violates")]
    for fault in blocked:  # some browsers tell so: no other is left for the end
        tried.faults.remove(fault)


def test_a_drawing_without_start_and_goal_gets_them_where_the_robot_is(tried: Tried) -> None:
    shapes = '<rect id="robot" x="20" y="40" width="30" height="20"/><rect x="100" y="0" width="9" height="60"/>'
    room = '<rect id="workspace" width="240" height="100" fill="none" stroke="#000"/>'
    drawing = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 240 100">{room}{shapes}</svg>'
    tried.built(lambda: tried.give(drawing, "drawing.svg"))
    tried.say("#pose", "Free")  # where it is drawn
    tried.say("#way", "No start and goal in this scene")
    tried.page.click("#start-here")
    tried.say("#way", "No goal in this scene")
    tried.drag("robot", 100, 60)
    tried.page.click("#goal-here")
    tried.say("#way", "motion")
    assert not tried.page.locator("#start-here, #goal-here").filter(visible=True).count()
    tried.page.click("#undo")
    tried.say("#way", "No goal in this scene")
