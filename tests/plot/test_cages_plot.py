"""Pictures of taking apart: names of parts cover no other text."""

import pytest

import cfree
from cfree.disassembly import Assembly, removal_order
from overlaps import touching, written


@pytest.mark.slow
def test_names_of_parts_cover_no_other_text_and_are_in_lines_where_the_part_is_narrow() -> None:
    shapes = {str(shape.name): shape.polygon for shape in cfree.load_shapes("examples/cages/frame.geojson").shapes}
    figure = removal_order(Assembly(shapes, fixed=["frame"])).plot()
    assert list(touching(figure)) == []
    assert {"left\nblock", "right\nblock", "wedge", "frame"} <= {text for text, _ in written(figure)}
