"""What the page says of goals dragged at random is what Python says, and its paths are free."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from drags import Dragged

SCENES = Path(__file__).parents[2] / "examples" / "scenes"


@pytest.fixture(scope="module")
def dragged(browser: Any) -> Iterator[Dragged]:
    made = Dragged(browser, seed=1)
    yield made
    made.page.close()


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("name", ["paper_fig9", "comb_hook", "sofa_corner", "five_convex", "degenerate_two_part_robot"])
def test_dragged_goals_get_the_verdict_of_python(dragged: Dragged, name: str) -> None:
    dragged.open(SCENES / f"{name}.json")
    for _ in range(4):
        said, expected, seen = dragged.drag()
        assert said == expected, seen
        assert (said == "path") == bool(seen["poses"])
