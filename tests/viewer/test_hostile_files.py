"""Files that are no scenes, or whose texts look like markup: a clear message, no script, and the page goes on."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest

import cfree
from cfree import view
from pages import Tried

pytestmark = pytest.mark.slow

ACTIVE = '<img src=x onerror="window.hacked=1"><script>window.hacked=1</script></script><!--'
TRIANGLE = {"outer": [[0, 0], [1, 0], [0, 1]]}


def scene(**more: Any) -> str:
    return json.dumps({"robot": TRIANGLE, "start": [5, 5, 0], "goal": [6, 6, 0], **more})


LONG = "<long>"  # stands for ten million characters: points, and any text

REFUSED = {
    "nothing": ("", "line 1, column 1: JSON value expected"),
    "no text": ("\x00\x01\u202e", ""),
    "half": (scene()[:40], "line 1, column 41: "),
    "not a number": ('{"robot": {"outer": [\n[0,0],[1,0],[NaN,1]]}}', "line 2, column 14: "),
    "infinite": (scene(bounds=[0, 0, "inf", 9]), "bounds[2]"),
    "too large": (scene(obstacles=[{"outer": [[0, 0], ["1e400", 0], [0, 1]]}]), "1e150"),
    "deep": ("[" * 200_000, "nested deeper than 64"),
    "deep objects": ('{"robot":' * 100 + "1" + "}" * 100, "nested deeper than 64"),
    "unknown key": (scene(**{ACTIVE: 1}), 'unknown key "<img src=x'),
    "a text for a number": (scene(bounds=[ACTIVE, 0, 1, 1]), "<img src=x"),
    "prototype": ('{"__proto__": {"robot": 1}, "robot": 1}', ""),
    "crossing": (scene(obstacles=[{"outer": [[0, 0], [1, 1], [1, 0], [0, 1]], "name": ACTIVE}]), "cross"),
    "no start": (scene(start=[1, 2, {"tau": ACTIVE}]), "start[2].tau"),
    "10 MB of vertices": (
        scene(obstacles=[{"outer": [LONG]}]).replace(f'"{LONG}"', LONG),
        "more than 100,000 vertices",
    ),
    "10 MB of a name": (scene(name=LONG, robot=1), "robot"),
    "20 MB": (LONG + LONG, "this page reads 16"),
}


@pytest.fixture(scope="module")
def tried(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tried]:
    path = view(
        cfree.Scene([(0, 0), (1, 0), (0, 1)], [[(3, 0), (4, 0), (4, 1)]], name="first", start=(0, 0, 0)),
        html=tmp_path_factory.mktemp("page") / "page.html",
        browser=False,
    )
    tried = Tried(browser, path)
    tried.ready("first")
    tried.page.locator("#space").evaluate("view => { view.style.display = 'none'; }")  # so that nothing is painted
    yield tried
    tried.close()


DROP = """([name, text]) => {
  const given = new DataTransfer();
  given.items.add(new File([text.replaceAll("<long>", "[1, 2], ".repeat(1_250_000) + "[3, 4]")], name));
  document.dispatchEvent(new DragEvent("drop", { dataTransfer: given }));
}"""


def give(tried: Tried, text: str, name: str = "scene.json") -> None:
    """By the button that opens files; if it is long, by dropping it."""
    if LONG in text:
        tried.page.evaluate(DROP, [name, text])
    else:
        tried.give(text, name)


def is_untouched(tried: Tried) -> None:
    assert tried.page.evaluate("window.hacked") is None
    assert tried.page.locator("img").count() == 0
    assert tried.page.locator("script").count() == 5 and tried.page.locator("body > *").count() < 12


@pytest.mark.parametrize("name", REFUSED)
def test_refused_with_a_clear_message(tried: Tried, name: str) -> None:
    text, message = REFUSED[name]
    give(tried, scene(name="between"))
    tried.ready("between")
    give(tried, text, f"{ACTIVE}.json")
    tried.page.locator("#edit:not(:empty)").wait_for(timeout=20_000)
    said = tried.page.locator("#edit").inner_text()
    assert message in said and 5 < len(said) < 300 and "undefined" not in said and "fault of cfree" not in said, said
    is_untouched(tried)
    assert tried.page.title() == "between: cfree"  # and the last scene is still there
    give(tried, scene(name="after"))
    tried.ready("after")
    assert tried.page.locator("#edit").inner_text() == ""


def test_names_are_texts_wherever_they_are_shown(tried: Tried) -> None:
    block = {"outer": [[4, 4], [7, 4], [7, 7], [4, 7]], "name": f"{ACTIVE}\u202e"}
    give(
        tried, scene(name=ACTIVE, units=ACTIVE, note=ACTIVE, source={"of": ACTIVE}, obstacles=[block], start=[0, 0, 0])
    )
    tried.page.locator("body[data-ready^='<img']").wait_for()
    tried.say("#way", "Goal: the robot overlaps obstacle 0 (<img src=x")
    assert tried.page.title().startswith("<img src=x") and "\u202e" not in tried.page.locator("#way").inner_text()
    assert tried.page.locator(".obstacle title").text_content().startswith("<img src=x")
    is_untouched(tried)


@pytest.mark.long
def test_large_file_is_read(tried: Tried) -> None:
    give(tried, scene(name="large", note=LONG, obstacles=[{"outer": [[40, 40], [50, 40], [50, 60]]}]))
    tried.ready("large")
    tried.say("#way", "A motion exists")
