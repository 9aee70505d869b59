"""The page in a real browser, Debian's chromium: what is seen and said while somebody drags."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import cfree
from cfree import view
from pages import Tried, bare_page

OTHER = '{"name": "other", "robot": {"outer": [[0, 0], [1, 0], [0, 1]]}, "start": [0, 0, 0]}'
SCENES = Path(__file__).parents[2] / "examples" / "scenes"


@pytest.fixture(scope="module")
def page_of_fig9(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tried]:
    scene = cfree.load_scene(SCENES / "paper_fig9.json")
    tried = Tried(browser, view(scene, html=tmp_path_factory.mktemp("page") / "page.html", browser=False))
    tried.ready("paper_fig9")
    yield tried
    tried.close()


@pytest.fixture
def fig9(page_of_fig9: Tried) -> Tried:
    """As it begins: after another scene it is opened again."""
    page = page_of_fig9.page
    if page.locator("#edit-shapes").get_attribute("aria-pressed") == "true":
        page.locator("#edit-shapes").click()
    page_of_fig9.give(OTHER)
    page_of_fig9.ready("other")
    page.set_input_files("#file", SCENES / "paper_fig9.json")
    page_of_fig9.ready("paper_fig9")
    return page_of_fig9


def test_path_is_found_and_drawn(fig9: Tried) -> None:
    fig9.say("#way", "A motion exists")
    assert fig9.page.locator(".trace path").count() == 1
    assert len(set(fig9.page.locator("#space").screenshot()[-4000:])) > 50  # not one colour
    fig9.say("#pose", "Free")


def test_slider_cuts_anew(fig9: Tried) -> None:
    fig9.page.locator(".slice .forbidden").wait_for(state="attached")
    before = fig9.slice()
    fig9.page.locator("#theta").focus()
    for _ in range(8):
        fig9.page.keyboard.press("PageUp")
    fig9.page.wait_for_timeout(500)
    assert fig9.slice() != before and fig9.page.locator("#degrees").inner_text() != "0°"


def test_robot_dragged_into_an_obstacle_is_forbidden(fig9: Tried) -> None:
    fig9.drag("robot", 180, -130)
    fig9.say("#pose", "Forbidden: the robot overlaps obstacle 0 (triangle).")
    assert fig9.page.locator(".body.robot").get_attribute("data-tone") == "bad"
    fig9.page.locator("#undo").click()
    fig9.say("#pose", "Free")


def test_goal_in_an_obstacle_is_said(fig9: Tried) -> None:
    fig9.say("#way", "A motion exists")
    fig9.drag("goal", -190, 130)
    fig9.say("#way", "Goal: the robot overlaps obstacle 0 (triangle).")


def test_keys_move_the_robot(fig9: Tried) -> None:
    robot = fig9.page.locator(".body.robot")
    before = robot.get_attribute("transform")
    robot.focus()
    for key in ("ArrowRight", "ArrowUp", "[", "Shift+ArrowLeft"):
        fig9.page.keyboard.press(key)
    fig9.page.wait_for_timeout(500)
    assert robot.get_attribute("transform") != before
    assert "turned by" in str(robot.get_attribute("aria-label"))


def test_link_brings_the_state_back(browser: Any, fig9: Tried, tmp_path: Path) -> None:
    fig9.drag("start", 60, 40)
    fig9.page.wait_for_timeout(900)
    fragment = "#" + fig9.page.url.partition("#")[2]
    place = fig9.page.locator(".body.start").get_attribute("transform")
    linked = Tried(browser, bare_page(tmp_path), fragment)
    linked.ready("paper_fig9")
    assert linked.page.locator(".body.start").get_attribute("transform") == place
    linked.close()


def test_patch_that_is_clicked_is_named_and_touched(fig9: Tried) -> None:
    box = fig9.page.locator("#space canvas").bounding_box()
    assert box
    fig9.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    for text in ("of obstacle 0 (triangle)", "K = ", "trimmed by: robot ", "Cell 0: volume 418.7 rad; bounded, not by"):
        fig9.say("#picked", text)
    fig9.say("#pose", "Touching: ")


def test_shapes_are_changed_by_dragging_and_undone(fig9: Tried, tmp_path: Path) -> None:
    page, before = fig9.page, fig9.outlines()
    page.locator("#edit-shapes").click()
    fig9.built(lambda: fig9.pull(page.locator(".obstacle"), -30, 20))
    moved = cfree.load_scene(fig9.saved("scene", tmp_path / "moved.json"))
    assert fig9.outlines() != before
    assert all(c == round(c, 2) for c in moved.obstacles[0].vertices.ravel())  # of a grid
    vertex = page.locator(".vertex")
    fig9.built(lambda: fig9.pull(vertex.nth(2), 20, -40))
    a, b = vertex.nth(0).bounding_box(), vertex.nth(1).bounding_box()
    middle = [(a[c] + b[c] + a[size]) / 2 for c, size in (("x", "width"), ("y", "height"))]
    fig9.built(lambda: page.mouse.dblclick(*middle))
    assert vertex.count() == 4 and fig9.slice()
    for _ in range(3):
        fig9.built(lambda: page.locator("#undo").click())
    assert fig9.outlines() == before
    fig9.built(lambda: page.locator("#redo").click())
    assert cfree.load_scene(fig9.saved("scene", tmp_path / "again.json")).obstacles == moved.obstacles
    robot = page.locator(".body.robot .shape").get_attribute("d")
    page.locator(".body.robot").focus()
    fig9.built(lambda: fig9.pull(vertex.nth(1), 30, 10))
    assert page.locator(".body.robot .shape").get_attribute("d") != robot


def test_outline_that_crosses_itself_is_refused_with_its_place(fig9: Tried) -> None:
    page = fig9.page
    page.locator("#edit-shapes").click()
    page.locator(".obstacle").focus()
    page.locator(".vertex").first.focus()
    fig9.built(lambda: page.keyboard.press("Insert"))
    fig9.pull(page.locator(".vertex").nth(1), 200, -220)
    fig9.say("#edit", "obstacle 0: outer ring: edges 0 and 2 cross at (")
    page.wait_for_timeout(500)  # until what was dropped is refused, too
    page.keyboard.press("ArrowDown")  # on with the last one that was well
    page.locator("#edit:empty").wait_for(state="attached", timeout=10_000)


def test_obstacles_are_drawn_and_changed_by_keys(fig9: Tried) -> None:
    page = fig9.page
    page.locator("#space canvas").focus()
    page.keyboard.press("n")
    fig9.built(lambda: page.keyboard.press("Enter"))
    assert len(fig9.outlines()) == 2
    page.locator(".obstacle").nth(1).focus()
    for key in ("ArrowRight", "[", "Enter", "ArrowUp", "Insert"):
        before = fig9.outlines()
        fig9.built(lambda key=key: page.keyboard.press(key)) if key != "Enter" else page.keyboard.press(key)
        assert (fig9.outlines() == before) == (key == "Enter")
    assert page.locator(".vertex").count() == 4
    page.locator(".obstacle").nth(1).focus()
    fig9.built(lambda: page.keyboard.press("Delete"))
    box = page.locator("#workspace").bounding_box()
    page.locator("#draw").click()
    for x, y in ((0.6, 0.6), (0.75, 0.6), (0.7, 0.7)):
        page.mouse.click(box["x"] + x * box["width"], box["y"] + y * box["height"])
    fig9.built(lambda: page.keyboard.press("Enter"))
    assert len(fig9.outlines()) == 2
    fig9.say("#way", "A motion exists")


def test_colours_tell_contacts_curvatures_and_clearance(fig9: Tried) -> None:
    fig9.say("#way", "A motion exists")
    pictures = set()
    for colour in ("contact", "cell", "gaussian", "mean", "clearance"):
        fig9.page.select_option("#colour", colour)
        fig9.page.wait_for_timeout(400)
        pictures.add(fig9.page.locator("#space canvas").screenshot())
    fig9.page.select_option("#palette", "paper")
    fig9.page.wait_for_timeout(400)
    pictures.add(fig9.page.locator("#space canvas").screenshot())
    assert len(pictures) == 6


def test_a_proof_names_the_blocking_obstacles(browser: Any, tmp_path: Path) -> None:
    ring = {"outer": [[0, 0], [9, 0], [9, 9], [0, 9]], "holes": [[[1, 1], [1, 8], [8, 8], [8, 1]]], "name": "ring"}
    text = {"name": "caught", "robot": {"outer": [[0, 0], [2, 0], [0, 2]]}, "obstacles": [ring]}
    (tmp_path / "scene.json").write_text(json.dumps(text | {"start": [3, 3, 0], "goal": [20, 3, 0]}))
    scene = cfree.load_scene(tmp_path / "scene.json")
    tried = Tried(browser, view(scene, cfree.plan(scene), html=tmp_path / "page.html", browser=False))
    tried.ready("caught")
    tried.say("#way", "No motion, not even touching: separated by obstacle 0 (ring).")
    tried.close()


def test_hostile_names_stay_text(browser: Any, tmp_path: Path) -> None:
    name = "</title><img src=x onerror=\"document.title='bad'\">"
    triangle = [(0, 0), (1, 0), (0, 1)]
    scene = cfree.Scene(
        triangle, [[(3, 0), (4, 0), (4, 1)]], obstacle_names=[name], name="<b>hostile", start=(0, 0, 0), goal=(0, 3, 0)
    )
    tried = Tried(browser, view(scene, html=tmp_path / "page.html", browser=False))
    tried.ready("<b>hostile")
    assert tried.page.locator("img").count() == 0 and tried.page.title() == "<b>hostile: cfree"
    tried.close()
