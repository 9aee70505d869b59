"""Drag goals in the page at random, and compare its verdicts with Python's.

`python tests/support/drags.py --count 1000 SCENE.json ...` tries more than the tests do.
"""

from __future__ import annotations

import argparse
import random
import sys
import time
from collections import Counter
from itertools import pairwise
from pathlib import Path
from typing import Any

import cfree
from cfree.formats.scene_file import scene_from_text
from cfree.viewer.page_text import hosted_page
from pages import CHROMIUM, SWIFTSHADER

FRAME = """(page) => new Promise((ready) => {
  const frame = document.createElement("iframe");
  frame.style.cssText = "position:fixed;inset:0;width:100%;height:100%;border:0";
  window.addEventListener("message", ({ data }) => {
    if (data.cfree === "ready") ready();
    if (data.cfree === "seen") window.seen = data.seen;
  });
  frame.srcdoc = page;
  document.body.append(frame);
})"""
SHOW = "given => frames[0].postMessage({ cfree: 'show', given }, '*')"
SAID = {  # beginnings of the page's texts, and Python's answers for them
    "A motion exists": "path",
    "No motion, not even touching": "closed",
    "No motion with clearance": "interior",
    "Goal: ": "forbidden",
}


class Dragged:
    """The page in a frame, with a scene whose goal is dragged."""

    def __init__(self, browser: Any, seed: int) -> None:
        self.page = browser.new_page(viewport={"width": 1000, "height": 700})
        self.random = random.Random(seed)
        self.page.evaluate(FRAME, hosted_page())
        self.frame = self.page.frame_locator("iframe")
        self.way = self.frame.locator("#way:not(.old):not(:empty)").filter(has_not_text="Looking for")

    def open(self, path: Path) -> None:
        """Open another scene, which has a name and bounds."""
        text = path.read_text()
        scene = scene_from_text(path.name, text)
        self.planner, self.checker = cfree.Planner(scene), cfree.MotionChecker(scene)
        self.page.evaluate(SHOW, {"scene": text})
        self.frame.locator(f"body[data-ready='{scene.name}']").wait_for(timeout=120_000)
        self.way.wait_for()
        self.frame.locator("#space").evaluate("view => { view.style.display = 'none'; }")  # so that nothing is painted
        for other in ("robot", "start"):  # which may be in front of the goal
            self.frame.locator(f".body.{other}").evaluate("body => { body.style.pointerEvents = 'none'; }")
        self.floor = self.frame.locator(".bounds").bounding_box()
        self.at = self._point()

    def _point(self) -> tuple[float, float]:
        box = self.frame.locator(".body.goal .point").bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag(self) -> tuple[str, str, dict[str, Any]]:
        """Drag the goal somewhere else; return the page's text, Python's answer, and the drawn state."""
        x, y, w, h = (self.floor[name] for name in ("x", "y", "width", "height"))
        self.page.evaluate("window.before = JSON.stringify(seen.goal)")
        target = x + w * self.random.uniform(0.05, 0.95), y + h * self.random.uniform(0.05, 0.95)
        self.page.mouse.move(*self.at)
        self.page.mouse.down()
        self.page.mouse.move(*target)
        self.page.mouse.up()
        self.page.wait_for_function("JSON.stringify(seen.goal) !== before")
        self.way.wait_for(timeout=60_000)
        seen, said = self.page.evaluate("seen"), self.way.inner_text()
        self.at = self._point()
        return next((kind for words, kind in SAID.items() if said.startswith(words)), said), self.expected(seen), seen

    def expected(self, seen: dict[str, Any]) -> str:
        """Verdict of Python in the words of `SAID`; a path that the page has found is checked."""
        ends = [cfree.Pose(end["x"], end["y"], {"tau": end["tau"]}) for end in (seen["start"], seen["goal"])]
        if seen["poses"]:
            poses = [cfree.Pose(x, y, {"tau": tau}) for x, y, tau in map(str.split, seen["poses"].splitlines())]
            path = cfree.Path(poses[0], [cfree.motion_between(a, b) for a, b in pairwise(poses)])
            assert [path.start, path.goal] == ends and path.is_free(self.checker), seen
        try:
            answer = self.planner.plan(*ends)
        except cfree.ForbiddenPoseError:
            return "forbidden"
        return answer.of if isinstance(answer, cfree.Separated) else "path"


def main() -> int:
    from playwright.sync_api import sync_playwright

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="+", type=Path)
    parser.add_argument("--count", type=int, default=1000, help="of drags in all")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    differ, each = 0, -(-options.count // len(options.scenes))
    with sync_playwright() as running:
        browser = running.chromium.launch(executable_path=str(CHROMIUM), args=SWIFTSHADER)
        dragged = Dragged(browser, options.seed)
        for path in options.scenes:
            dragged.open(path)
            counts, began = Counter[str](), time.perf_counter()
            for _ in range(each):
                said, expected, seen = dragged.drag()
                counts[expected] += 1
                if said != expected:
                    differ += 1
                    print(f"{path.stem}, goal {seen['goal']}: the page says {said}, Python {expected}", flush=True)
            seconds = (time.perf_counter() - began) / each
            memory = dragged.page.evaluate("performance.memory.usedJSHeapSize / 1e6")
            print(f"{path.stem}: {dict(counts)}, {1000 * seconds:.0f} ms a drag, {memory:.0f} MB", flush=True)
    print(f"{differ} of {each * len(options.scenes)} differ")
    return differ > 0


if __name__ == "__main__":
    sys.exit(main())
