"""Generated drawings with known regions, read in all roles with random options; `fuzz_drawings.py` tries more."""

from dataclasses import replace
from pathlib import Path

import pytest
import shapely

from fuzz_drawings import WAYS, Case, case, fault

SQUARE = b'<svg xmlns="http://www.w3.org/2000/svg"><g id="walls"><rect width="4" height="4"/></g></svg>'
DISC = b'<svg xmlns="http://www.w3.org/2000/svg"><g id="walls"><circle r="4"/></g></svg>'
PLAIN = Case("square", "a.svg", SQUARE, shapely.box(0, -4, 4, 0), {"tolerance": 0.1}, "obstacle")
ROOM = {"tolerance": 0.1, "roles": {"walls": "workspace"}}


@pytest.mark.parametrize("way", range(len(WAYS)), ids=[name for _, name in WAYS])
def test_no_obstacle_is_smaller_than_drawn_and_no_workspace_larger(way: int, tmp_path: Path) -> None:
    assert not fault(case(way), tmp_path)[1]


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("way", range(len(WAYS)), ids=[name for _, name in WAYS])
def test_many_drawings_are_read_as_large_as_they_are_drawn(way: int, tmp_path: Path) -> None:
    for turn in range(500, 515):
        number = turn * len(WAYS) + way
        assert not fault(case(number), tmp_path)[1], f"drawing {number}"


def test_regions_that_are_missing_or_invented_are_faults(tmp_path: Path) -> None:
    assert fault(PLAIN, tmp_path) == ("right", "")
    assert fault(replace(PLAIN, truth=shapely.box(0, -5, 4, 0)), tmp_path)[0] == "missing"
    assert fault(replace(PLAIN, truth=shapely.box(0, -3, 4, 0)), tmp_path)[0] == "invented"
    room = replace(PLAIN, options=ROOM, role="workspace")
    assert fault(room, tmp_path) == ("right", "")
    assert fault(replace(room, truth=shapely.box(0, -3.9, 4, 0)), tmp_path)[0] == "invented"
    assert fault(replace(room, truth=shapely.box(0, -5, 4, 0)), tmp_path)[0] == "missing"
    line = SQUARE.replace(b"<rect", b'<line x2="9" stroke="red"/><rect')
    said = replace(PLAIN, content=line, truth=shapely.box(0, -5, 4, 0))
    assert fault(said, tmp_path) == ("missing and said", "")


@pytest.mark.parametrize("role", ["obstacle", "robot", "workspace"])
def test_round_shapes_have_the_region_of_the_drawing(role: str, tmp_path: Path) -> None:
    options = {"tolerance": 0.1, "curves": True, "roles": {"walls": role}}
    disc = Case("disc", "a.svg", DISC, shapely.Point(0, 0).buffer(4, quad_segs=512), options, role)
    assert fault(disc, tmp_path) == ("right", "")
    for radius in (3.5, 4.5):
        assert fault(replace(disc, truth=shapely.Point(0, 0).buffer(radius)), tmp_path)[1]
