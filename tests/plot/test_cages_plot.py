"""Pictures of taking apart: names of parts cover no other text."""

import pytest
import shapely

import cfree
from cfree.caging import is_caged
from cfree.disassembly import Assembly, removal_order
from overlaps import touching, written


@pytest.mark.slow
def test_the_name_of_a_finger_that_is_a_point_is_beside_it() -> None:
    figure = is_caged([(-1, -1), (1, -1), (1, 1), (-1, 1)], [(0, 1), (1, 0), (0, -1), (-1, 0), (3, 3)]).plot()
    name = dict(written(figure))["finger 4"]
    assert not name.contains(shapely.Point(figure.axes[0].transData.transform((3, 3))))
    assert list(touching(figure)) == []


@pytest.mark.slow
def test_names_of_parts_cover_no_other_text_and_are_in_lines_where_the_part_is_narrow() -> None:
    shapes = {str(shape.name): shape.polygon for shape in cfree.load_shapes("examples/cages/frame.geojson").shapes}
    figure = removal_order(Assembly(shapes, fixed=["frame"])).plot()
    assert list(touching(figure)) == []
    assert {"left\nblock", "right\nblock", "wedge", "frame"} <= {text for text, _ in written(figure)}
