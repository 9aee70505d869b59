"""The page in Chromium while an obstacle is dragged: changes shown in the left view, frames of the right one, a second.

A change is shown once the boundary of the changed scene is trimmed and its slice drawn. The pointer moves along a
circle every 16 ms, by events from within the page: those from outside wait for the screen. Chromium draws in software
here, with the processor that the core needs.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

from measure import SCENES, Report

import cfree
from cfree.viewer.page_text import page

CHROMIUM = Path("/usr/bin/chromium")
DRAWN_BY_PROCESSOR = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
CASES = {"benchmr_parking1": 30.0, "benchmr_warehouse": None, "nest_shirts": None}  # with targets
RADIUS = 12  # of the circle, in pixels
STEPS = 90  # of a turn


def run(quick: bool) -> Report:
    report = Report(
        "An obstacle dragged in the page, in Chromium",
        ("scene", "trapezoids", "seconds", "moves", "changes a second", "frames a second"),
    )
    if not CHROMIUM.exists():
        report.notes.append(f"no {CHROMIUM}: nothing is measured")
        return report
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(executable_path=str(CHROMIUM), args=DRAWN_BY_PROCESSOR)
        for case, least in list(CASES.items())[: 1 if quick else None]:
            scene = cfree.load_scene(SCENES / f"{case}.json")
            file = Path(folder) / f"{case}.html"
            file.write_text(page(scene), encoding="utf-8")
            tried = browser.new_page(viewport={"width": 1280, "height": 800})
            tried.goto(file.as_uri())
            tried.locator("body[data-ready]").wait_for(timeout=120_000)
            seconds, moves, changes, frames = _dragged(tried, 2 if quick else 6)
            trapezoids = tried.locator("#facts").inner_text().split(" ")[0]
            row = (case, trapezoids, f"{seconds:.1f}", str(moves))
            report.rows.append((*row, f"{changes / seconds:.1f}", f"{frames / seconds:.1f}"))
            if least:
                report.figure("page, changes a second in the left view", case, changes / seconds, ">=", least)
            tried.close()
        browser.close()
    return report


DRAG = """async ([x, y, radius, steps, seconds]) => {
  const target = document.elementFromPoint(x, y);
  const fire = (type, px, py) => target.dispatchEvent(new PointerEvent(type, {
    bubbles: true, clientX: px, clientY: py, pointerId: 1, isPrimary: true, pointerType: "mouse",
    buttons: type === "pointerup" ? 0 : 1, button: type === "pointermove" ? -1 : 0,
  }));
  const of = (element, what) => Number(element.dataset[what] ?? 0);
  const counts = () => [of(document.body, "sliced"), of(document.querySelector("#space"), "frames")];
  fire("pointerdown", x, y);
  const before = counts(), began = performance.now();
  let moves = 0;
  while (performance.now() - began < 1000 * seconds) {
    const angle = 2 * Math.PI * ++moves / steps;
    fire("pointermove", x + radius * Math.sin(angle), y + radius * (1 - Math.cos(angle)));
    await new Promise((ready) => setTimeout(ready, 16));
  }
  const passed = (performance.now() - began) / 1000, after = counts();
  fire("pointerup", x, y);
  return [passed, moves, after[0] - before[0], after[1] - before[1]];
}"""


def _dragged(tried: Any, seconds: float) -> tuple[float, int, int, int]:
    """Drag the smallest obstacle that is seen for some seconds: the time taken, moves, changes shown, and frames."""
    tried.locator("#edit-shapes").click()
    boxes = tried.locator(".obstacle").evaluate_all(
        "all => all.map(one => one.getBoundingClientRect()).map(({x, y, width, height}) => [x, y, width, height])"
    )
    x, y, width, height = min((box for box in boxes if min(box[2:]) > 6), key=lambda box: box[2] * box[3])
    passed, moves, changes, frames = tried.evaluate(DRAG, [x + width / 2, y + height / 2, RADIUS, STEPS, seconds])
    return passed, moves, changes, frames
