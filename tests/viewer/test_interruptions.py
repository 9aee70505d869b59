"""What is stopped stops at once; a lost context comes back; many triangles turn, and nothing is drawn at rest."""

from __future__ import annotations

import time
from io import BytesIO
from typing import Any

import numpy as np
import pytest
from PIL import Image

from pages import Tried

pytestmark = pytest.mark.slow

STOP = """async () => {
    const began = performance.now(), said = () => document.getElementById("facts").textContent;
    document.getElementById("stop").click();
    while (!said().startsWith("stopped")) await new Promise((done) => setTimeout(done, 1));
    return performance.now() - began;
}"""
LOSE = """async () => {
    const canvas = document.querySelector("#space canvas"), gl = canvas.getContext("webgl2");
    const ending = gl.getExtension("WEBGL_lose_context");
    const told = (name) => new Promise((done) => canvas.addEventListener(name, done, { once: true }));
    const lost = told("webglcontextlost");
    ending.loseContext();
    await lost;
    const back = told("webglcontextrestored");
    await new Promise((done) => setTimeout(done, 100));
    ending.restoreContext();
    await back;
}"""


def test_work_is_stopped_at_once_and_another_scene_is_answered(tried: Tried) -> None:
    tried.page.select_option("#scenes", "nest_swim")
    tried.page.locator("#stop").wait_for(timeout=30_000)
    assert tried.page.evaluate(STOP) < 200
    tried.page.select_option("#scenes", "comb_hook")
    tried.ready("comb_hook")
    tried.say("#way", "A motion exists")


def test_context_that_is_lost_comes_back(tried: Tried) -> None:
    def pixels() -> np.ndarray[Any, Any]:
        tried.page.wait_for_timeout(800)
        image = Image.open(BytesIO(tried.page.locator("#space canvas").screenshot())).convert("RGB")
        return np.asarray(image).astype(int)

    def differ(before: np.ndarray[Any, Any]) -> float:
        return float(np.abs(pixels() - before).max(axis=2).mean())

    tried.say("#way", "A motion exists")
    for _ in range(10):  # until all is drawn
        before = pixels()
        if differ(before) == 0:
            break
    tried.page.evaluate(LOSE)
    assert any(differ(before) < 1 for _ in range(10))


def frames(tried: Tried) -> int:
    return int(tried.page.locator("#space").get_attribute("data-frames"))


def turned(tried: Tried, seconds: float = 3) -> float:
    """Frames a second while the right view is turned."""
    mouse, box = tried.page.mouse, tried.page.locator("#space canvas").bounding_box()
    mouse.move(box["x"] + 200, box["y"] + 300)
    mouse.down()
    before, began = frames(tried), time.perf_counter()
    while (passed := time.perf_counter() - began) < seconds:
        mouse.move(box["x"] + 200 + 40 * passed, box["y"] + 300)
    mouse.up()
    return (frames(tried) - before) / passed


@pytest.mark.long
def test_a_hundred_thousand_triangles_turn_and_rest(tried: Tried) -> None:
    tried.page.set_viewport_size({"width": 1280, "height": 720})
    tried.page.select_option("#scenes", "paper_fig9")
    tried.ready("paper_fig9")
    few = turned(tried)  # as fast as this machine is now
    tried.page.select_option("#scenes", "nest_swim")
    tried.ready("nest_swim")
    tried.say("#way", "No motion, not even touching")
    many = turned(tried)
    triangles = int(tried.page.locator("#space").get_attribute("data-triangles"))
    print(f"{triangles} triangles: {many:.1f} frames a second, against {few:.1f}")
    assert triangles > 100_000 and many > few / 6
    tried.page.wait_for_timeout(2000)
    resting = frames(tried)
    tried.page.wait_for_timeout(1000)
    assert frames(tried) == resting
