"""Round shapes in the page, in a real browser: drawn round, touched exactly, moved as a whole, saved as they are."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import cfree
from cfree import Pose, verify, view
from cfree.curves import Arc
from pages import Tried

pytestmark = pytest.mark.slow

DISC = cfree.Curved.circle((0, 0), "1/2")
FLOOR = [(-6, -2), (6, -2), (6, "-1/2"), (-6, "-1/2")]
HILL = cfree.Curved([(-1, -2), (1, -2), Arc((-1, -2), through=(0, "1/3"))], [])


@pytest.fixture
def tried(browser: Any, tmp_path: Path) -> Iterator[Tried]:
    scene = cfree.Scene(
        DISC, [FLOOR, cfree.Curved.circle((0, "5/2"), 1), HILL], start=(-5, 0, 0), goal=(5, 0, 0), name="floor"
    )
    tried = Tried(browser, view(scene, html=tmp_path / "page.html", browser=False))
    tried.ready("floor")
    yield tried
    tried.close()


def saved_and_verified(tried: Tried, folder: Path) -> cfree.Path | cfree.Separated:
    """The saved answer, which is one of the saved scene."""
    scene = cfree.load_scene(tried.saved("scene", folder / "scene.json"))
    answer = cfree.load(tried.saved("answer", folder / "answer.json"))
    assert scene.curved and verify.answer(scene, answer).verified
    return answer


def test_round_shapes_are_drawn_round_and_their_path_is_saved_and_verified(tried: Tried, tmp_path: Path) -> None:
    assert [" ".join(d).count("A") for d in zip(tried.outlines(), strict=True)] == [0, 4, 3]
    assert "A0.5 0.5" in str(tried.page.locator(".body.robot .shape").get_attribute("d"))
    tried.say("#facts", "round shapes are drawn as polygons around them, within 0.0")
    tried.say("#way", "A motion exists")
    tried.say("#pose", "Touching obstacle 0. Allowed.")
    path = saved_and_verified(tried, tmp_path)
    assert isinstance(path, cfree.Path) and (path.start, path.goal) == (Pose(-5, 0), Pose(5, 0))
    assert "polygons" not in json.loads((tmp_path / "answer.json").read_text())


def test_a_disc_dragged_gently_onto_an_arc_touches_it(browser: Any, tmp_path: Path) -> None:
    scene = cfree.Scene(DISC, [HILL], start=(0, 2, 0), name="hill")
    tried = Tried(browser, view(scene, html=tmp_path / "page.html", browser=False))
    tried.ready("hill")
    tried.say("#pose", "Free; ")
    pixels = tried.page.evaluate("document.querySelector('#workspace svg > g').transform.baseVal[0].matrix.a")
    tried.drag("robot", 0, pixels * (2 - 5 / 6) + 4)  # the arc is at 1/3, the radius 1/2
    tried.say("#pose", "Touching obstacle 0. Allowed.")
    tried.drag("robot", 0, 60)
    tried.say("#pose", "Forbidden: the robot overlaps obstacle 0.")
    tried.close()


def test_a_round_obstacle_moves_as_a_whole_and_stays_exact(tried: Tried, tmp_path: Path) -> None:
    page = tried.page
    page.locator("#edit-shapes").click()
    before = tried.outlines()
    tried.built(lambda: tried.pull(page.locator(".obstacle").nth(1), 20, 30))
    assert page.locator(".vertex").count() == 0 and tried.outlines()[0] == before[0]
    moved = cfree.load_scene(tried.saved("scene", tmp_path / "moved.json")).obstacles[1]
    assert isinstance(moved, cfree.Curved) and moved.size == 2 and moved != cfree.Curved.circle((0, "5/2"), 1)
    tried.built(lambda: page.locator("#undo").click())
    assert tried.outlines() == before


def test_other_curves_are_refused_with_the_remedy(tried: Tried) -> None:
    ellipse = {"ellipse": {"center": [0, 0], "radii": [1, 2]}}
    tried.give(json.dumps({"robot": {"circle": {"center": [0, 0], "radius": 1}}, "obstacles": [ellipse]}))
    tried.say("#edit", "obstacles[0].ellipse: the page takes lines and circular arcs; `cfree convert` with --outer")
