"""What is stopped stops at once; a lost context comes back; many triangles turn, and nothing is drawn while nothing moves."""

from __future__ import annotations

import time
from collections.abc import Iterator
from importlib.resources import files
from io import BytesIO
from pathlib import Path
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


@pytest.fixture
def tried(browser: Any, tmp_path: Path) -> Iterator[Tried]:
    page = tmp_path / "page.html"
    page.write_bytes(files("cfree.viewer").joinpath("page.html").read_bytes())
    tried = Tried(browser, page)
    tried.ready("paper_fig9")
    yield tried
    tried.close()


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

    tried.say("#way", "A motion exists")
    before = pixels()
    tried.page.evaluate(LOSE)
    assert np.abs(pixels() - before).max(axis=2).mean() < 1


def test_a_hundred_thousand_triangles_turn_and_rest(tried: Tried) -> None:
    page = tried.page
    page.set_viewport_size({"width": 1280, "height": 720})
    page.select_option("#scenes", "nest_swim")
    tried.ready("nest_swim")
    tried.say("#way", "No motion, not even touching")
    page.wait_for_timeout(3000)

    def frames() -> int:
        return int(page.locator("#space").get_attribute("data-frames"))

    resting = frames()
    page.wait_for_timeout(1500)
    assert frames() == resting
    box = page.locator("#space canvas").bounding_box()
    page.mouse.move(box["x"] + 200, box["y"] + 300)
    page.mouse.down()
    began = time.perf_counter()
    while time.perf_counter() - began < 4:
        page.mouse.move(box["x"] + 200 + 40 * (time.perf_counter() - began), box["y"] + 300)
    seconds = time.perf_counter() - began
    page.mouse.up()
    shown = (frames() - resting) / seconds
    print(f"{shown:.1f} frames a second, {page.locator('#space').get_attribute('data-triangles')} triangles")
    assert shown > 5
