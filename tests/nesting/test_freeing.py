"""Parts that can leave their sheet, and parts that others hold."""

from __future__ import annotations

import pytest

import cfree
from cfree import Polygon
from cfree.nesting import Nesting, Part, Placed, can_be_cut_free, way_out

RING = Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(2, 2), (2, 7), (7, 7), (7, 2)]])
JAW = Polygon([(0, 0), (9, 0), (9, 2), (2, 2), (2, 7), (9, 7), (9, 9), (0, 9)])
BAR = Placed(Part([(0, 0), (4, 0), (4, 1), (0, 1)], "bar"), (3, 4, 0))


def test_a_bar_leaves_a_jaw_and_not_a_ring() -> None:
    held, loose = (Nesting([], [Placed(Part(shape), (0, 0, 0)), BAR]) for shape in (RING, JAW))
    assert [can_be_cut_free(nesting, 1) for nesting in (held, loose)] == [False, True]
    assert isinstance(way_out(held, 1), cfree.Separated) and isinstance(way_out(loose, 1), cfree.Path)


def test_the_edge_of_the_sheet_does_not_hold_a_part() -> None:
    sheet = [(0, 0), (9, 0), (9, 9), (0, 9)]
    assert can_be_cut_free(Nesting([sheet], [Placed(Part(JAW), (0, 0, 0)), BAR]), -1)


def test_a_path_of_a_disc_out_of_a_jaw_is_free() -> None:
    disc = Placed(Part(cfree.Curved.circle((0, 0), 1)), (4, 4, 0))
    path = way_out(Nesting([], [Placed(Part(JAW), (0, 0, 0)), disc]), 1)
    assert isinstance(path, cfree.Path)


def test_an_index_beyond_the_parts_is_refused() -> None:
    with pytest.raises(IndexError, match=r"^part: 1 of 1 placed part; count from 0$"):
        can_be_cut_free(Nesting([], [BAR]), 1)


def test_parts_that_overlap_are_named() -> None:
    with pytest.raises(
        cfree.InvalidPoseError, match=r"^part 1 overlaps another one: bar \(part 0\) and bar \(part 1\): 1 deep"
    ):
        can_be_cut_free(Nesting([], [BAR, BAR]), 1)
