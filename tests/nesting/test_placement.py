"""Placement: exact fits, holes, gaps, and never an overlap."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

import pytest
import shapely

import cfree
from cfree import Curved, Polygon
from cfree.nesting import Nesting, Part, overlaps, place
from fuzz_nesting import check_layout, random_layout

SQUARE = Part([(0, 0), (2, 0), (2, 2), (0, 2)], "square")
RING = Part(Polygon([(0, 0), (6, 0), (6, 6), (0, 6)], [[(1, 1), (1, 5), (5, 5), (5, 1)]]), "ring")
SHEET = [(0, 0), (12, 0), (12, 9), (0, 9)]


def test_squares_fill_a_sheet_exactly() -> None:
    result = place(Part([(0, 0), (2, 0), (2, 2), (0, 2)], "square", 6), [(0, 0), (6, 0), (6, 4), (0, 4)])
    assert result.density == 1 and not result.left and overlaps(result) == ()


def test_a_bar_goes_into_its_slot_without_room_to_move() -> None:
    plate = Part([(0, 0), (6, 0), (6, 1), (1, 1), (1, 2), (6, 2), (6, 4), (0, 4)], "plate")
    bar = Part([(0, 0), (5, 0), (5, 1), (0, 1)], "bar")
    result = place([bar, plate], [(0, 0), (6, 0), (6, 4), (0, 4)])
    assert result.density == 1 and [one.part.name for one in result.placed] == ["plate", "bar"]


def test_thirds_fill_a_sheet() -> None:
    third = Part([(0, 0), ("1/3", 0), ("1/3", "1/3"), (0, "1/3")], "third", 9)
    assert place(third, [(0, 0), (1, 0), (1, 1), (0, 1)]).density == pytest.approx(1)


@pytest.mark.parametrize("far", ["0", "1e6", "1e9", "-123456789.125"])
@pytest.mark.parametrize("size", ["1", "1e-6", "1e6"])
def test_parts_and_sheets_far_from_the_origin_are_placed_as_beside_it(far: str, size: str) -> None:
    x, s = Fraction(far), Fraction(size)
    wedge = Part([(x, x), (x + 3 * s, x), (x, x + s)], "wedge", 2)
    sheet = [(-x, x), (4 * s - x, x), (4 * s - x, x + 4 * s), (-x, x + 4 * s)]
    placed = place(wedge, sheet).placed
    assert len(placed) == 2 and overlaps(Nesting([sheet], placed)) == ()
    tops = [max(y for _, y in shape.exact_vertices) for one in placed for shape in one.shapes]  # type: ignore[union-attr]
    if abs(x) < 10**8 * s:
        assert [float((top - x) / s) for top in tops] == pytest.approx([1, 1], abs=1e-3)


def test_a_part_fills_a_hole_of_its_own_shape() -> None:
    hole = [(1, 1), (1, 3), (3, 1)]
    plate = Part(Polygon([(0, 0), (4, 0), (4, 4), (0, 4)], [hole]), "plate")
    result = place([plate, Part([(0, 0), (2, 0), (0, 2)], "triangle")], [(0, 0), (4, 0), (4, 4), (0, 4)])
    assert len(result.placed) == 2 and (result.placed[1].pose.x, result.placed[1].pose.y) == (1, 1)


def test_holes_are_filled_by_smaller_parts() -> None:
    result = place([RING, Part(SQUARE.shapes, "square", 4)], [(0, 0), (6, 0), (6, 6), (0, 6)])
    assert len(result.placed) == 5 and overlaps(result) == ()


def test_faults_of_a_sheet_stay_free() -> None:
    sheet = Polygon([(0, 0), (6, 0), (6, 2), (0, 2)], [[(1, "0.5"), (1, 1), (2, 1), (2, "0.5")]])
    result = place(Part(SQUARE.shapes, "square", 3), sheet)
    assert [one.pose.x for one in result.placed] == [2, 4] and result.left[0].quantity == 1


@pytest.mark.parametrize(("gap", "kerf", "apart", "inset"), [(1, 0, 1, 1), (0, 1, 1, "1/2"), ("1/2", "1/2", 1, "3/4")])
def test_gap_and_kerf_keep_parts_apart(gap: Any, kerf: Any, apart: Any, inset: Any) -> None:
    result = place(Part(SQUARE.shapes, "square", 2), [(0, 0), (9, 0), (9, 9), (0, 9)], gap=gap, kerf=kerf)
    first, second = (one.pose for one in result.placed)
    assert (first.x, first.y) == (Fraction(inset), Fraction(inset))
    assert (second.x - first.x, second.y - first.y) == (2 + apart, 0)


def test_slanted_parts_keep_a_gap() -> None:
    parts = [Part([(0, 0), (4, 0), (1, 3)], "a", 3), Part([(0, 0), (3, 1), (2, 3)], "b", 3)]
    result = place(parts, SHEET, gap="0.3", rotations="any")
    shapes = [one.shapes[0].to_shapely() for one in result.placed]  # type: ignore[union-attr]
    gaps = [shapely.distance(a, b) for k, a in enumerate(shapes) for b in shapes[:k]]
    assert 0.3 - 1e-9 < min(gaps) < 0.31 and len(result.placed) == 6


def test_toward_left_is_for_strips() -> None:
    low, left = (place(Part(SQUARE.shapes, "square", 2), SHEET, toward=side) for side in ("bottom", "left"))  # type: ignore[arg-type]
    assert [(one.pose.x, one.pose.y) for one in low.placed] == [(0, 0), (2, 0)]
    assert [(one.pose.x, one.pose.y) for one in left.placed] == [(0, 0), (0, 2)]


def test_any_rotation_lays_edges_along_edges() -> None:
    """A bar along a diagonal is too long for the sheet in quarter turns, and fits along its slanted side."""
    sheet = [(0, 0), (40, 30), (37, 34), (-3, 4)]
    bar = Part([(0, 0), (50, 0), (50, 5), (0, 5)], "bar")
    assert not place(bar, sheet).placed
    (one,) = place(bar, sheet, rotations="any").placed
    assert one.pose.cos == Fraction(4, 5)


def test_own_rotations_of_a_part_win() -> None:
    bar = Part([(0, 0), (5, 0), (5, 1), (0, 1)], "bar", rotations=["90deg"])
    (one,) = place(bar, SHEET, rotations=1).placed
    assert one.pose.tau == 1


def test_several_sheets_are_filled_in_turn() -> None:
    result = place(Part(SQUARE.shapes, "square", 3), [[(0, 0), (4, 0), (4, 2), (0, 2)]] * 3)
    assert [one.sheet for one in result.placed] == [0, 0, 1] and result.used == (0, 1)


def test_round_parts_do_not_overlap() -> None:
    disc, stadium = (
        Part(Curved.circle((0, 0), 1), "disc", 4),
        Part(Curved([(0, 0), (3, 0), (3, 1), (0, 1)], grown="1/2")),
    )
    result = place([disc, stadium], SHEET)
    assert len(result.placed) == 5 and overlaps(result) == ()
    assert float(result.placed[1].pose.y) < 1.01


def test_a_layout_is_placed_anew() -> None:
    layout = cfree.nesting.load_nesting("examples/drawings/nest.json")
    result = place(layout)
    assert len(result.placed) == len(layout.placed) and result.box[2] <= 20


def test_progress_ends_at_one_and_a_limit_leaves_parts() -> None:
    shares: list[float] = []
    result = place(Part(SQUARE.shapes, "square", 4), SHEET, max_seconds=0, progress=shares.append)
    assert shares[-1] == 1 and result.left[0].quantity == 4 and not result.placed


@pytest.mark.parametrize("seed", range(6))
def test_random_layouts_never_overlap(seed: int) -> None:
    check_layout(random_layout(random.Random(f"layout {seed}")))


@pytest.mark.slow
@pytest.mark.long
def test_many_random_layouts_never_overlap() -> None:
    for seed in range(40):
        check_layout(random_layout(random.Random(f"slow layout {seed}")))


@pytest.mark.slow
def test_numbers_stay_short_in_long_chains() -> None:
    draw = random.Random(3)
    parts = [
        Part(
            [(0, 0), (draw.randint(20, 40), draw.randint(0, 9)), (draw.randint(5, 30), draw.randint(20, 50))],
            f"t{k}",
            4,
        )
        for k in range(8)
    ]
    result = place(parts, [(0, 0), (400, 0), (397, 301), (0, 300)])
    assert not result.left and overlaps(result) == ()
    assert max(one.pose.x.denominator for one in result.placed) <= 10**12


@pytest.mark.parametrize(
    ("arguments", "fault"),
    [
        (([], SHEET), "parts: there is none; give at least one"),
        ((SQUARE, []), "sheets: there is none; give at least one polygon"),
        ((SQUARE,), "sheets: there is none; give at least one polygon"),
    ],
)
def test_no_part_and_no_sheet_are_refused(arguments: tuple[Any, ...], fault: str) -> None:
    with pytest.raises(ValueError, match=f"^{fault}$"):
        place(*arguments)


@pytest.mark.parametrize(
    ("options", "fault"),
    [
        ({"gap": -1}, "gap: -1; give a length, 0 or more"),
        ({"kerf": "-0.5"}, "kerf: -1/2; give a length, 0 or more"),
        ({"rotations": 0}, "rotations: 0; give 1 to 360 steps of a full turn"),
        ({"rotations": []}, "rotations: there is none; give at least one angle"),
        ({"rotations": "all"}, "rotations: 'all'; give \"any\""),
    ],
)
def test_wrong_options_are_refused(options: dict[str, Any], fault: str) -> None:
    with pytest.raises(ValueError, match=f"^{fault}"):
        place(SQUARE, SHEET, **options)


def test_a_part_that_fits_nowhere_is_left() -> None:
    result = place([RING, SQUARE], [(0, 0), (3, 0), (3, 3), (0, 3)])
    assert [part.name for part in result.left] == ["ring"] and isinstance(result, Nesting)
