"""Eight steps, through the paper and to a car: each has a scene to compute, a text with formulas, something to do."""

from __future__ import annotations

import pytest

from pages import Tried

STEPS = ["contacts", "helix", "vertex_edge", "edge_vertex", "round_corners", "trimming", "start_to_goal", "park_car"]


@pytest.mark.slow
def test_every_step_has_scene_text_and_formulas(tried: Tried) -> None:
    tried.page.locator("#learn").click()
    formulas = 0
    for name in STEPS:
        tried.ready(name)
        shown = tried.page.locator("#lessons article:visible")
        assert shown.count() == 1 and shown.locator(".try").inner_text()
        formulas += shown.locator("math").count()
        assert "$" not in shown.inner_text()
        tried.page.locator("#lesson-next").click()
    assert formulas > 15 and tried.page.locator("#lessons").is_hidden()


@pytest.mark.slow
def test_door_that_is_closed_takes_the_path_away(tried: Tried) -> None:
    tried.page.locator("#learn").click()
    for name in STEPS[:-1]:
        tried.ready(name)
        if name != STEPS[-2]:
            tried.page.locator("#lesson-next").click()
    tried.say("#way", "A motion exists")
    tried.page.locator("#edit-shapes").click()
    tried.page.locator(".obstacle").first.focus()
    for _ in range(2):
        tried.built(lambda: tried.page.keyboard.press("ArrowDown"))
    tried.say("#way", "No motion, not even touching")
