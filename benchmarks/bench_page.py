"""The page in Chromium while an obstacle is dragged: changes shown in the left view, and frames of the right one, a second.

A change is shown once the boundary of the changed scene is trimmed and its slice drawn. Chromium draws the right view in software
here, with the processor that the core needs. The mouse moves in small steps for some seconds, along a circle.
"""

from __future__ import annotations

import math
import tempfile
import time
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
        ("scene", "trapezoids", "right view", "seconds", "mouse moves", "changes a second", "frames a second"),
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
            for is_shown in (True, False):
                tried = browser.new_page(viewport={"width": 1280, "height": 800})
                tried.goto(file.as_uri())
                tried.locator("body[data-ready]").wait_for(timeout=120_000)
                if not is_shown:
                    tried.locator("#space").evaluate("view => { view.style.display = 'none'; }")
                seconds, moves, changes, frames = _dragged(tried, 2 if quick else 6)
                trapezoids = tried.locator("#facts").inner_text().split(" ")[0]
                row = (case, trapezoids, "shown" if is_shown else "hidden", f"{seconds:.1f}", str(moves))
                report.rows.append((*row, f"{changes / seconds:.1f}", f"{frames / seconds:.1f}"))
                if least and not is_shown:
                    what = "page, changes a second in the left view"
                    report.figure(what, case, changes / seconds, ">=", least)
                tried.close()
        browser.close()
    return report


def _dragged(tried: Any, seconds: float) -> tuple[float, int, int, int]:
    """Drag the smallest obstacle that is seen for some seconds: the time taken, moves, changes shown, and frames."""
    tried.locator("#edit-shapes").click()
    boxes = tried.locator(".obstacle").evaluate_all(
        "all => all.map(one => one.getBoundingClientRect()).map(({x, y, width, height}) => [x, y, width, height])"
    )
    x, y, width, height = min((box for box in boxes if min(box[2:]) > 6), key=lambda box: box[2] * box[3])
    middle = x + width / 2, y + height / 2
    tried.mouse.move(*middle)
    tried.mouse.down()
    before, began, moves = _counts(tried), time.perf_counter(), 0
    while (passed := time.perf_counter() - began) < seconds:
        angle = 2 * math.pi * moves / STEPS
        tried.mouse.move(middle[0] + RADIUS * math.sin(angle), middle[1] + RADIUS * (1 - math.cos(angle)))
        moves += 1
    changes, frames = (new - old for new, old in zip(_counts(tried), before, strict=True))
    tried.mouse.up()
    return passed, moves, changes, frames


def _counts(tried: Any) -> tuple[int, int]:
    script = "[document.body.dataset.trimmed ?? 0, document.querySelector('#space').dataset.frames ?? 0].map(Number)"
    trimmed, frames = tried.evaluate(script)
    return trimmed, frames
