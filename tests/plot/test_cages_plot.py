"""Pictures of taking apart: names of parts cover no other text."""

import math

import numpy as np
import pytest
import shapely

import cfree
from cfree.caging import is_caged
from cfree.disassembly import Assembly, removal_order
from overlaps import touching, written

FRAME = [(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)]


@pytest.mark.slow
def test_the_name_of_a_finger_that_is_a_point_is_beside_it() -> None:
    figure = is_caged([(-1, -1), (1, -1), (1, 1), (-1, 1)], [(0, 1), (1, 0), (0, -1), (-1, 0), (3, 3)]).plot()
    name = dict(written(figure))["finger 4"]
    assert not name.contains(shapely.Point(figure.axes[0].transData.transform((3, 3))))
    assert list(touching(figure)) == []


@pytest.mark.slow
def test_names_of_parts_cover_no_other_text_and_are_in_lines_where_the_part_is_narrow() -> None:
    shapes = {
        str(shape.name).replace("block", "block of oak"): shape.polygon
        for shape in cfree.load_shapes("examples/cages/frame.geojson").shapes
    }
    figure = removal_order(Assembly(shapes, fixed=["frame"])).plot()
    assert list(touching(figure)) == []
    wrapped = {"left\nblock\nof\noak", "right\nblock\nof\noak", "wedge", "frame"}
    assert wrapped <= {text for text, _ in written(figure)}


def test_the_steps_of_taking_apart_are_drawn_large_and_alike() -> None:
    shapes = {"frame": FRAME, "peg": [(1, 1), (3, 1), (3, 2), (1, 2)], "lid": [(0, 3), (4, 3), (4, 4), (0, 4)]}
    figure = removal_order(Assembly(shapes, fixed=["frame"])).plot()
    first, second = figure.axes
    assert first.get_xlim() == second.get_xlim() and first.get_ylim() == second.get_ylim()
    assert np.ptp(first.get_xlim()) < 2 * 4  # the parts are 4 wide: they fill more than half


@pytest.mark.slow
def test_the_closed_surface_around_a_cage_fills_its_panel() -> None:
    hand = cfree.load_scene("examples/cages/hand.json")
    cage = is_caged(hand.robot, hand.obstacles, (0, 0, "355deg"))
    workspace, space = cage.plot().axes
    assert math.degrees(cage.pose.theta) == pytest.approx(355)
    low, high = space.get_zlim()
    assert low < 355 < high and high - low < 90 and np.ptp(space.get_xlim()) < 4  # it turns by 30 degrees at most
    swept = workspace.patches[0].get_path().get_extents()
    assert -1.3 < swept.x0 < -0.75 and 4.75 < swept.x1 < 5.3  # it moves by 3/4 without turning, and a little more
