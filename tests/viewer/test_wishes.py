"""Wishes for a path in the page: a clearance and preferences; a proof in a frame, and beside it how much is missing."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import cfree
from cfree import verify
from pages import Tried

pytestmark = pytest.mark.slow

WALLS = [[(-9, -1), (-1, -1), (-1, 1), (-9, 1)], [(1, -1), (9, -1), (9, 1), (1, 1)]]
BAR = [("-0.5", -1), ("0.5", -1), ("0.5", 1), ("-0.5", 1)]
ROOM = [(-9, -9), (9, -9), (9, 9), (-9, 9)]


@pytest.fixture
def gap(tried: Tried) -> Tried:
    tried.show(cfree.Scene(BAR, WALLS, workspace=ROOM, start=(0, 5, 0), goal=(0, -5, 0), name="gap", units="m"))
    return tried


def wish(tried: Tried, name: str, text: str) -> None:
    tried.page.fill(f"#{name}", text)
    tried.page.locator(f"#{name}").press("Tab")


def saved(tried: Tried, folder: Path) -> Any:
    scene = cfree.load_scene(tried.saved("scene", folder / "scene.json"))
    answer = cfree.load(tried.saved("answer", folder / "answer.json"))
    assert verify.answer(scene, answer).verified
    return answer


def test_a_clearance_is_kept_or_proved_impossible_and_undone(gap: Tried, tmp_path: Path) -> None:
    page = gap.page
    wish(gap, "clearance", "0.4")
    gap.say("#way", "A motion exists that keeps 0.4 m: ")
    assert "A0.4 0.4" in str(page.locator(".body.robot .halo").get_attribute("d"))
    assert str(saved(gap, tmp_path).clearance) == "2/5"
    wish(gap, "clearance", "6/10")
    gap.say("#way", "No motion that keeps 6/10 m: separated by ")
    gap.say("#missing", "Missing: the robot gets there if all its sides move inwards by 0.1")
    assert isinstance(saved(gap, tmp_path), cfree.Separated)
    page.locator("#undo").click()
    gap.say("#way", "A motion exists that keeps 0.4 m: ")
    assert page.locator("#clearance").input_value() == "0.4" and page.locator("#missing").inner_text() == ""
    wish(gap, "clearance", "-1")
    gap.say("#edit", "clearance -1: give a length, 0 or more")


def test_preferences_change_the_path_and_a_link_keeps_them(gap: Tried) -> None:
    page = gap.page
    turning = re.compile(r"turning (\d+) degrees")
    gap.say("#way", "turning 0 degrees")
    wish(gap, "sideways", "5")
    page.locator("#way").filter(has_text=re.compile(r"turning [1-9]\d+ degrees")).wait_for(timeout=30_000)
    found = turning.search(page.locator("#way").inner_text())
    assert found and int(found[1]) >= 45
    page.wait_for_timeout(500)
    page.reload()
    gap.ready("gap")
    wish(gap, "turning", "0.5")
    gap.say("#edit", "turning 0.5: give a factor of 1 or more")
    page.locator("input[name=moves][value=car]").check(force=True)
    assert not page.locator("#objective").is_visible() and page.locator("#clearance").is_visible()


def test_a_proof_is_framed_and_beside_it_is_how_much_is_missing(tried: Tried) -> None:
    square = [("-1.25", "-1.25"), ("1.25", "-1.25"), ("1.25", "1.25"), ("-1.25", "1.25")]
    scene = cfree.Scene(square, WALLS, workspace=ROOM, start=(0, 5, 0), goal=(0, -5, 0), name="tight", units="m")
    tried.show(scene)
    page = tried.page
    tried.say("#way", "No motion, not even touching: separated by the workspace, obstacle 0 and obstacle 1.")
    tried.say("#missing", "Missing: the robot gets there if all its sides move inwards by 0.25 m, and not by 0.248 m.")
    border = page.locator(".answer").evaluate("of => getComputedStyle(of).outlineWidth")
    assert (
        border == "2px" and page.locator(".obstacle.blocks").count() == 2 and page.locator(".room.blocks").count() == 1
    )
    assert "separates start and goal" in page.locator("#legend").inner_text()
    frames = page.locator("#space").get_attribute("data-frames")
    page.locator("#frame-proof").click()
    page.locator(f"#space:not([data-frames='{frames}'])").wait_for()
    tried.drag("goal", 0, -240)  # to the start's side
    tried.say("#way", "A motion exists")
    assert page.locator(".blocks").count() == 0 and not page.locator("#frame-proof").is_visible()
    assert page.locator("#missing").inner_text() == ""


def test_legends_are_those_of_the_colouring(gap: Tried) -> None:
    page = gap.page
    legend = page.locator("#legend span")
    assert legend.all_inner_texts() == ["vertex on edge", "edge on vertex", "helix", "edge on edge"]
    page.select_option("#colour", "obstacle")
    assert legend.all_inner_texts() == ["obstacle 0", "obstacle 1", "the workspace", "helix", "edge on edge"]
    sign = page.locator("#legend i.own").first
    assert sign.evaluate("of => getComputedStyle(of).backgroundColor") == "rgb(0, 114, 178)"
    page.select_option("#colour", "cell")
    assert legend.all_inner_texts() == ["cell 0", "helix", "edge on edge"]
    page.select_option("#colour", "gaussian")
    assert legend.all_inner_texts() == ["helix", "edge on edge"]
    assert page.locator("#scale").inner_text().startswith("-10 · K r²")
    page.select_option("#colour", "clearance")
    assert re.match(r"0\S+ m · path: near", page.locator("#scale").inner_text())
    assert "vertex on edge" in legend.all_inner_texts()


def test_a_dragged_obstacle_has_its_slice_at_once(tried: Tried) -> None:
    scene = cfree.load_scene(Path(__file__).parents[2] / "examples" / "scenes" / "benchmr_parking1.json")
    tried.show(scene)
    page = tried.page
    page.locator("#edit-shapes").click()
    slice_before, built = tried.slice(), page.evaluate("document.body.dataset.built")
    tried.built(lambda: tried.pull(page.locator(".obstacle").nth(6), 30, 20))
    sliced = int(page.evaluate("document.body.dataset.sliced ?? 0"))
    assert sliced >= 1 and int(page.evaluate("document.body.dataset.built")) > int(built)
    assert tried.slice() != slice_before
