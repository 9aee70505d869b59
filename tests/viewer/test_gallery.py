"""The page as it is in the package, from a disk: every scene of its gallery is drawn in both views."""

from __future__ import annotations

from io import BytesIO
from typing import Any

import numpy as np
import pytest
from PIL import Image

from pages import Tried

pytestmark = pytest.mark.slow


def drawn(view: Any) -> float:
    """The share of a view, without its rim and headings, that is not of its commonest colour."""
    pixels = np.asarray(Image.open(BytesIO(view.screenshot())).convert("RGB"))[60:-60, 20:-20]
    colours = pixels.reshape(-1, 3) @ (1 << 16, 1 << 8, 1)
    return 1.0 - np.unique(colours, return_counts=True)[1].max() / len(colours)


@pytest.mark.long
def test_every_scene_of_the_gallery_is_drawn(tried: Tried) -> None:
    names = tried.page.locator("#scenes option").evaluate_all("options => options.map(of => of.value)")
    assert len(names) == len(set(names)) == 12 and names[-1] == ""
    views = [tried.page.locator(view) for view in ("#workspace", "#space")]
    for name in names[:-1]:
        tried.page.select_option("#scenes", name)
        tried.ready(name)
        tried.answered()
        apart = tried.page.locator("#way").inner_text().startswith("No motion, not even touching")
        assert apart == (name in ("caged_part", "nest_swim"))
        assert tried.page.locator(".obstacle, .bounds, .room").count() > 0
        assert min(map(drawn, views)) > 0.03, name
