"""Parts, places and layouts as values."""

from __future__ import annotations

import itertools

import pytest
import shapely

import cfree
from cfree import Curved
from cfree.nesting import Nesting, Part, Placed

SQUARE = Part([(0, 0), (2, 0), (2, 2), (0, 2)], "square", 2)
SHEET = [(0, 0), (4, 0), (4, 4), (0, 4)]


def test_a_part_has_the_area_of_its_shapes() -> None:
    assert SQUARE.area == 4
    assert Part(Curved.circle((0, 0), 1)).area == pytest.approx(3.14159, abs=1e-4)
    assert Part(Curved([(0, 0), (2, 0), (2, 1), (0, 1)], grown=1)).area == pytest.approx(2 + 6 + 3.14159, abs=1e-3)


def test_a_placed_part_is_turned_and_moved_exactly() -> None:
    (shape,) = Placed(SQUARE, (3, 1, "90deg")).shapes
    assert isinstance(shape, cfree.Polygon) and set(shape.exact_vertices) == {(1, 1), (3, 1), (3, 3), (1, 3)}


def test_the_density_is_that_of_used_sheets() -> None:
    nesting = Nesting([SHEET, SHEET], [Placed(SQUARE, (0, 0, 0), 1)])
    assert nesting.density == 0.25 and nesting.used == (1,)
    assert Nesting([], []).density == 0 and Nesting([], []).box == (0, 0, 0, 0)


def test_a_scene_of_a_part_has_all_others_of_its_sheet() -> None:
    nesting = Nesting([SHEET] * 2, [Placed(SQUARE, (0, 0, 0)), Placed(SQUARE, (2, 0, 0)), Placed(SQUARE, (0, 0, 0), 1)])
    scene = nesting.scene(0)
    assert scene.obstacle_names == ("square (part 1)",) and scene.workspace is not None and scene.start is not None


def test_bad_values_are_refused() -> None:
    with pytest.raises(ValueError, match=r"^quantity: 0; give at least 1$"):
        Part(SHEET, quantity=0)
    with pytest.raises(ValueError, match=r"^rotations: there is none"):
        Part(SHEET, rotations=[])
    with pytest.raises(ValueError, match=r"^placed\[0\]: sheet 1 of 1; count from 0$"):
        Nesting([SHEET], [Placed(SQUARE, (0, 0, 0), 1)])


def test_a_picture_marks_overlaps_and_has_a_panel_for_each_sheet() -> None:
    nesting = Nesting([SHEET] * 2, [Placed(SQUARE, (0, 0, 0)), Placed(SQUARE, (1, 0, 0)), Placed(SQUARE, (0, 0, 0), 1)])
    figure = nesting.plot()
    assert len(figure.axes) == 2 and "1 overlap" in figure.get_suptitle()
    assert nesting._repr_svg_().startswith("<svg")


def test_numbers_of_thin_parts_do_not_cover_each_other() -> None:
    strip = Part([(0, 0), (120, 0), (120, 1), (0, 1)], "strip")
    sheet = [(0, 0), (200, 0), (200, 100), (0, 100)]
    (ax,) = Nesting([sheet], [Placed(strip, (0, y, 0)) for y in range(9)]).plot().axes
    boxes = [shapely.box(*text.get_window_extent().extents) for text in ax.texts]
    assert len(boxes) == 9 and not any((a & b).area for a, b in itertools.combinations(boxes, 2))
