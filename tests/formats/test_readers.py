"""The option `repair` mends the polygons of JSON scenes."""

import json
from pathlib import Path

import pytest

import cfree
from cfree.errors import FormatError

SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]


@pytest.fixture
def file(tmp_path: Path) -> Path:
    bow_tie = {"outer": [[5, 0], [9, 4], [9, 0], [5, "8/2"]], "name": "tie"}
    spike = [[20, 0], [24, 0], [29, 0], [24, 0], [24, 4], [20, 4]]
    path = tmp_path / "scene.json"
    path.write_text(
        json.dumps({"robot": SQUARE, "obstacles": [bow_tie, spike, {"circle": {"center": [0, 9], "radius": 2}}]})
    )
    return path


def test_polygons_that_cross_themselves_are_repaired_on_request(file: Path) -> None:
    with pytest.raises(FormatError, match="cross"):
        cfree.load_shapes(file)
    scene = cfree.load_shapes(file, repair=True).scene()
    assert [float(o.area) for o in scene.obstacles if isinstance(o, cfree.Polygon)] == [4, 4, 16]
    assert scene.obstacle_names[:2] == ("tie", "tie")
    assert {note.where for note in scene.reading if note.kind == "mended"} == {"tie", "obstacle"}


def test_faults_that_are_no_crossings_keep_their_error(file: Path) -> None:
    file.write_text('{"robot": [[0, 0], [1, 0], ["a", 1]], "obstacles": []}')
    with pytest.raises(FormatError, match=r"robot\[2\]\[0\]|expected a number"):
        cfree.load_shapes(file, repair=True)
