"""Layouts checked exactly: overlaps, their depth, and the translation that ends them."""

from __future__ import annotations

import math
from fractions import Fraction

import cfree
from cfree import Curved, Polygon
from cfree.nesting import Nesting, Part, Placed, overlaps

SQUARE = Part([(0, 0), (2, 0), (2, 2), (0, 2)], "square")
DISC = Part(Curved.circle((0, 0), 1), "disc")
SHEET = [(0, 0), (9, 0), (9, 4), (0, 4)]


def layout(*places: tuple[Part, object]) -> Nesting:
    return Nesting([SHEET], [Placed(part, pose) for part, pose in places])  # type: ignore[arg-type]


def test_touching_is_no_overlap() -> None:
    assert overlaps(layout((SQUARE, (0, 0, 0)), (SQUARE, (2, 0, 0)), (SQUARE, (6, 2, "180deg")))) == ()


def test_the_least_overlap_is_found() -> None:
    tiny = Fraction(1, 10**40)
    (found,) = overlaps(layout((SQUARE, (0, 0, 0)), (SQUARE, (2 - tiny, 0, 0))))
    assert found.vector == (-tiny, 0) and found.depth.lo <= 1e-40 <= found.depth.hi


def test_the_deepest_pair_comes_first_and_its_translation_frees_it() -> None:
    nesting = layout((SQUARE, (0, 0, 0)), (SQUARE, ("1.9", 0, 0)), (SQUARE, ("4.5", 1, "30deg")), (SQUARE, (5, 1, 0)))
    found = overlaps(nesting)
    assert [one.parts for one in found] == [(2, 3), (0, 1)] and found[0].depth.lo > found[1].depth.hi
    for one in found:
        assert one.vector is not None
        first, second = (nesting.placed[k] for k in one.parts)
        x, y = first.pose.x + one.vector[0], first.pose.y + one.vector[1]
        moved = Nesting([], [first.at(cfree.Pose(x, y, {"tau": first.pose.tau})), second])
        assert overlaps(moved) == ()
        back = Fraction(999, 1000)
        x, y = first.pose.x + back * one.vector[0], first.pose.y + back * one.vector[1]
        assert overlaps(Nesting([], [first.at(cfree.Pose(x, y, {"tau": first.pose.tau})), second]))


def test_a_part_outside_of_its_sheet_is_moved_inside() -> None:
    (found,) = overlaps(layout((SQUARE, ("7.5", -1, 0))))
    assert found.parts == (0, -1) and found.vector == (Fraction(-1, 2), 1)
    assert "the edge of the sheet" in str(found)


def test_a_part_that_fits_nowhere_has_no_translation() -> None:
    (found,) = overlaps(Nesting([[(0, 0), (1, 0), (1, 1), (0, 1)]], [Placed(SQUARE, (0, 0, 0))]))
    assert found.vector is None and math.isinf(found.depth.lo) and "no translation" in str(found)


def test_discs_are_decided_exactly_and_their_depth_is_enclosed() -> None:
    assert overlaps(layout((DISC, (1, 1, 0)), (DISC, (3, 1, 0)))) == ()
    (found,) = overlaps(layout((DISC, (1, 1, 0)), (DISC, ("2.5", 1, 0))))
    assert found.depth.lo <= 0.5 <= found.depth.hi < 0.51 and found.vector is not None
    x, y = 1 + found.vector[0], 1 + found.vector[1]
    assert overlaps(Nesting([], [Placed(DISC, (x, y, 0)), Placed(DISC, ("2.5", 1, 0))])) == ()


def test_a_part_in_a_hole_does_not_overlap() -> None:
    plate = Part(Polygon([(0, 0), (4, 0), (4, 4), (0, 4)], [[(1, 1), (1, 3), (3, 3), (3, 1)]]), "plate")
    assert overlaps(layout((plate, (0, 0, 0)), (SQUARE, (1, 1, 0)))) == ()
    (found,) = overlaps(layout((plate, (0, 0, 0)), (SQUARE, ("1.25", 1, 0))))
    assert found.vector == (Fraction(1, 4), 0)  # the plate moves, and the square is in its hole again


def test_parts_of_different_sheets_do_not_overlap() -> None:
    nesting = Nesting([SHEET, SHEET], [Placed(SQUARE, (0, 0, 0), 0), Placed(SQUARE, (1, 0, 0), 1)])
    assert overlaps(nesting) == ()
