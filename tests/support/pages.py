"""The page in a browser: actions on it, and its state."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

from cfree import Scene
from cfree.formats.scene_file import scene_text

CHROMIUM = Path("/usr/bin/chromium")
SWIFTSHADER = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


def bare_page(folder: Path) -> Path:
    """Page of the package, without a scene of one's own, as a file."""
    page = folder / "page.html"
    page.write_bytes(files("cfree.viewer").joinpath("page.html").read_bytes())
    return page


class Tried:
    """A page of a scene; closing it checks that there were no complaints and no requests to the outside."""

    def __init__(self, browser: Any, path: Path, fragment: str = "", **device: Any) -> None:
        self.context = browser.new_context(**{"viewport": {"width": 1280, "height": 800}} | device)
        self.page = self.context.new_page()
        self.faults: list[str] = []
        self.page.on("console", lambda message: self.faults.append(message.text) if message.type == "error" else None)
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("request", lambda request: self._see(request.url))
        self.page.goto(f"{path.as_uri()}{fragment}")

    def _see(self, url: str) -> None:
        if not url.startswith(("file:", "blob:", "data:")):
            self.faults.append(url)

    def ready(self, name: str) -> None:
        self.page.locator(f"body[data-ready='{name}']").wait_for(timeout=120_000)

    def give(self, text: str, name: str = "scene.json") -> None:
        """Give it a file, by the button that opens files."""
        self.page.set_input_files("#file", {"name": name, "mimeType": "application/json", "buffer": text.encode()})

    def show(self, scene: Scene) -> None:
        """Give it another scene, as a file; shapes are not edited then, and patches are coloured by contact."""
        if self.page.locator("#edit-shapes").get_attribute("aria-pressed") == "true":
            self.page.locator("#edit-shapes").click()
        self.page.select_option("#colour", "contact")
        self.page.evaluate("delete document.body.dataset.ready, scrollTo(0, 0)")
        self.give(scene_text(scene))
        self.ready(scene.name)

    def answered(self) -> None:
        """Wait until it tells the way that is looked for, or that there is none."""
        way = self.page.locator("#way:not(.old):not(:empty)").filter(has_not_text="Looking for")
        way.wait_for(timeout=60_000)

    def say(self, which: str, text: str) -> None:
        """Wait until an element has this text; else raise an error with the text that it has."""
        try:
            self.page.locator(which).filter(has_text=text).wait_for(timeout=30_000)
        except Exception as fault:
            raise AssertionError(f"{which}: {self.page.locator(which).all_inner_texts()}, not {text!r}") from fault

    def drag(self, who: str, dx: float, dy: float) -> None:
        """Drag the point of the robot, or of a ghost, by pixels."""
        self.pull(self.page.locator(f".body.{who} .point"), dx, dy)

    def pull(self, handle: Any, dx: float, dy: float) -> None:
        """Drag a handle by pixels from its middle."""
        box = handle.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        for step in range(1, 9):
            self.page.mouse.move(x + dx * step / 8, y + dy * step / 8)
        self.page.mouse.up()

    def resting(self, *which: str) -> list[Any]:
        """Boxes of elements, once the page has not moved them for half a second: words above them may still change."""
        boxes = None
        while boxes != (boxes := [self.page.locator(one).bounding_box() for one in which]):
            self.page.wait_for_timeout(500)
        return boxes

    def built(self, act: Callable[[], object]) -> None:
        """Act, and wait until another boundary is there."""
        before = int(self.page.evaluate("document.body.dataset.built"))
        act()
        self.page.wait_for_timeout(300)
        for _ in range(100):
            if int(self.page.evaluate("document.body.dataset.built")) > before:
                return
            self.page.wait_for_timeout(100)
        raise AssertionError("no other boundary was built")

    def outlines(self) -> list[str]:
        return [str(d) for d in self.page.locator(".obstacle").evaluate_all("all => all.map(p => p.getAttribute('d'))")]

    def saved(self, what: str, file: Path) -> Path:
        with self.page.expect_download() as download:
            self.page.select_option("#save", what)
        download.value.save_as(file)
        return file

    def slice(self) -> str:
        return str(self.page.locator(".slice .forbidden").get_attribute("d"))

    def close(self) -> None:
        self.context.close()
        assert not self.faults, self.faults


PHONE = {"viewport": {"width": 390, "height": 760}, "has_touch": True, "is_mobile": True, "device_scale_factor": 1}
TABLET = {"viewport": {"width": 1024, "height": 768}, "has_touch": True, "is_mobile": True, "device_scale_factor": 1}

Place = tuple[float, float]


class Fingers:
    """Fingers on a page, whose touches go through the browser's own handling: it may take them for scrolling."""

    def __init__(self, page: Any) -> None:
        self.page = page
        self.client = page.context.new_cdp_session(page)

    def touch(self, kind: str, *places: Place) -> None:
        """Send "Start", "Move", "End" or "Cancel", with the places of all fingers that are down."""
        points = [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(places)]
        self.client.send("Input.dispatchTouchEvent", {"type": f"touch{kind}", "touchPoints": points})

    def glide(self, begin: Sequence[Place], end: Sequence[Place]) -> None:
        """Move fingers that are down from places to others in ten steps."""
        for step in range(1, 11):
            self.touch("Move", *(_between(a, b, step / 10) for a, b in zip(begin, end, strict=True)))
            self.page.wait_for_timeout(15)

    def drag(self, begin: Place, dx: float, dy: float, end: str = "End") -> None:
        """Drag one finger by pixels; it is lifted, or its touch is cancelled."""
        to = begin[0] + dx, begin[1] + dy
        self.touch("Start", begin)
        self.glide([begin], [to])
        self.touch(end)

    def pinch(self, middle: Place, first: float, last: float, end: str = "End") -> None:
        """Move two fingers side by side from one distance to another."""
        (x, y), apart = middle, (first / 2, last / 2)
        begin, to = ([(x - half, y), (x + half, y)] for half in apart)
        self.touch("Start", begin[0])
        self.touch("Start", *begin)
        self.glide(begin, to)
        self.touch(end)


def _between(a: Place, b: Place, share: float) -> Place:
    return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])
