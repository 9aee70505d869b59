"""Pages of the documentation open the page with a scene: the links are those that the page itself would make."""

from __future__ import annotations

import random
import re
from pathlib import Path
from typing import Any

import pytest

import cfree
from live_links import MOST, fragment
from pages import Tried, bare_page

ROOT = Path(__file__).parents[2]
TRADES = ("nesting", "caging", "disassembly", "buildings", "forklift", "for-geometers", "ompl", "teaching")
LIVE = {
    page: re.findall(r"^```{live} (\S+)\n```$", (ROOT / "docs" / f"{page}.md").read_text(), re.M) for page in TRADES
}


@pytest.mark.parametrize("page", TRADES)
def test_each_page_of_a_trade_opens_the_page_with_its_scene_and_names_its_notebook(page: str) -> None:
    text = (ROOT / "docs" / f"{page}.md").read_text()
    assert LIVE[page] and "## Who should use something else" in text
    for name in LIVE[page]:
        scene = cfree.load_scene(ROOT / name)
        assert scene.start is not None and len(fragment(scene)) <= MOST + 3
    notebooks = re.findall(r"examples/notebooks/\w+\.ipynb", text)
    assert notebooks and all((ROOT / notebook).exists() for notebook in notebooks)
    for name in re.findall(r"\(gallery/(\w+)\.rst\)", text):
        assert (ROOT / "examples/gallery" / f"{name}.py").exists()


def test_a_scene_that_is_too_long_for_a_link_is_refused() -> None:
    draw = random.Random(0)
    places = [(draw.randrange(10**6), draw.randrange(10**6)) for _ in range(1000)]
    triangles = [[(x, y), (x + 9, y), (x, y + 9)] for x, y in places]
    with pytest.raises(ValueError, match="its link has"):
        fragment(cfree.Scene([(0, 0), (1, 0), (0, 1)], triangles))


@pytest.mark.slow
def test_the_page_opens_the_scene_of_a_link(browser: Any, tmp_path: Path) -> None:
    tried = Tried(browser, bare_page(tmp_path), fragment(cfree.load_scene(ROOT / "examples/live/puzzle.json")))
    tried.ready("a key in its housing")
    tried.close()
