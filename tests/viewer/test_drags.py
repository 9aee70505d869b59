"""What the page says of goals dragged at random is what Python says, and its paths are free."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

import cfree
from cfree import Pose
from drags import Dragged

SCENES = Path(__file__).parents[2] / "examples" / "scenes"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["paper_fig9", "comb_hook", "sofa_corner", "five_convex", "degenerate_two_part_robot"])
def test_dragged_goals_get_the_verdict_of_python(browser: Any, name: str) -> None:
    dragged = Dragged(browser, (SCENES / f"{name}.json").read_text(), seed=1)
    checker = cfree.MotionChecker(dragged.planner.scene)
    for _ in range(4):
        said, expected, seen = dragged.drag()
        assert said == expected, seen
        assert (said == "path") == bool(seen["poses"])
        poses = [Pose(x, y, {"tau": tau}) for x, y, tau in map(str.split, seen["poses"].splitlines())]
        if poses:
            path = cfree.Path(poses[0], [cfree.motion_between(a, b) for a, b in pairwise(poses)])
            assert path.goal == Pose(seen["goal"]["x"], seen["goal"]["y"], {"tau": seen["goal"]["tau"]})
            assert path.is_free(checker)
    dragged.page.close()
