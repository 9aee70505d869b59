"""Compaction: parts slide and turn until they touch, by motions that are free as a whole."""

from __future__ import annotations

import pytest

import cfree
from cfree import Curved
from cfree.nesting import Compacted, Nesting, Part, Placed, compact, overlaps

SQUARE = Part([(0, 0), (2, 0), (2, 2), (0, 2)], "square")
WEDGE = Part([(0, 0), (2, 0), (0, 1)], "wedge")
ELL = Part([(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)], "ell")
SHEET = [(0, 0), (9, 0), (9, 4), (0, 4)]


def replayed(start: Nesting, result: Compacted) -> None:
    """Check every motion among all other parts by the motion checker, and the places at the end."""
    placed = list(start.placed)
    for each in result.motions:
        assert each.start == placed[each.part].pose
        now = Nesting(start.sheets, placed)
        assert cfree.is_free_motion(now.scene(each.part), each.start, each.motion)
        placed[each.part] = placed[each.part].at(each.motion.apply(each.start))
    assert tuple(placed) == result.nesting.placed and overlaps(result.nesting) == ()


@pytest.mark.parametrize("side", ["left", "right", "down", "up", (1, 2)])
def test_every_motion_is_free_and_the_layout_is_the_last_place(side: object) -> None:
    start = Nesting([SHEET], [Placed(SQUARE, (1, 1, "20deg")), Placed(WEDGE, (4, 1, "30deg")), Placed(ELL, (6, 1, 0))])
    result = compact(start, side)  # type: ignore[arg-type]
    assert result.motions
    replayed(start, result)


def test_slides_between_polygons_end_in_exact_contact() -> None:
    result = compact(Nesting([SHEET], [Placed(SQUARE, (1, "1/3", 0)), Placed(SQUARE, ("5.1", 0, 0))]), "left")
    assert [one.pose.x for one in result.nesting.placed] == [0, 2]


def test_a_part_on_a_corner_turns_until_it_lies_flat() -> None:
    start = Nesting([SHEET], [Placed(SQUARE, (1, 1, "20deg"))])
    turned, slid = compact(start, "down"), compact(start, "down", turning=False)
    assert any(isinstance(each.motion, cfree.Rotation) for each in turned.motions)
    assert turned.nesting.placed[0].pose.tau == 0 and turned.nesting.placed[0].pose.y == 0
    assert slid.nesting.placed[0].pose.tau == start.placed[0].pose.tau


def test_a_part_slides_along_the_edge_that_stops_it() -> None:
    ramp = Part([(0, 0), (4, 0), (0, 2)], "ramp")
    start = Nesting([SHEET], [Placed(ramp, (0, 0, 0)), Placed(SQUARE, (1, 2, 0))])
    result = compact(start, "down", turning=False)
    assert result.nesting.placed[1].pose == cfree.Pose(4, 0)
    replayed(start, result)


def test_discs_touch_the_edge_and_each_other() -> None:
    disc = Part(Curved.circle((0, 0), 1), "disc")
    start = Nesting([SHEET], [Placed(disc, (4, 2, 0)), Placed(disc, (7, 2, 0))])
    result = compact(start, "left")
    assert [float(one.pose.x) for one in result.nesting.placed] == pytest.approx([1, 3])
    replayed(start, result)


@pytest.mark.slow
def test_parts_with_other_curves_are_compacted_and_stay_what_they_are() -> None:
    leaf = Part(Curved.ellipse((0, 0), (1, "0.5")), "leaf")
    start = Nesting([SHEET], [Placed(leaf, (3, 2, "30deg")), Placed(SQUARE, (5, 1, 0))])
    result = compact(start, "left")
    assert [one.part for one in result.nesting.placed] == [leaf, SQUARE] and not overlaps(result.nesting)
    assert result.nesting.box[0] == pytest.approx(0, abs=2e-3) and result.nesting.box[2] < 5


def test_overlapping_parts_are_refused() -> None:
    with pytest.raises(ValueError, match=r"^nesting: square \(part 0\) and .*: 1 deep.*; free it first$"):
        compact(Nesting([SHEET], [Placed(SQUARE, (0, 0, 0)), Placed(SQUARE, (1, 0, 0))]))


def test_no_direction_and_no_pass_are_refused() -> None:
    nesting = Nesting([SHEET], [Placed(SQUARE, (0, 0, 0))])
    with pytest.raises(ValueError, match=r"^direction: \(0, 0\); give a vector that is not zero$"):
        compact(nesting, (0, 0))
    with pytest.raises(ValueError, match=r"^passes: 0; give at least 1$"):
        compact(nesting, passes=0)


def test_without_a_sheet_a_part_with_nothing_before_it_stays() -> None:
    result = compact(Nesting([], [Placed(SQUARE, (0, 0, 0)), Placed(SQUARE, (5, 0, 0))]), "left")
    assert [one.pose.x for one in result.nesting.placed] == [0, 2]


def test_one_slide_is_written_in_the_singular() -> None:
    assert repr(compact(Nesting([SHEET], [Placed(SQUARE, (1, 0, 0))]))).startswith("<Compacted by 1 slide and 0 turns")
