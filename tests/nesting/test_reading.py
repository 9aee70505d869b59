"""Nesting JSON with bins, strips and solutions; drawings with sheets."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

import cfree
from cfree.nesting import load_nesting, overlaps, place

ITEMS = [
    {"id": 7, "demand": 3, "allowed_orientations": [0, 90], "shape": {"type": "rectangle",
     "data": {"x_min": 0, "y_min": 0, "width": 2, "height": 1}}},
    {"id": 8, "demand": 1, "shape": {"type": "simple_polygon", "data": [[0, 0], [1, 0], [0, 1]]}},
]  # fmt: skip
BINS = [
    {"id": 1, "stock": 2, "shape": {"type": "rectangle", "data": {"x_min": 0, "y_min": 0, "width": 2, "height": 2}}},
    {"id": 2, "stock": None, "shape": {"type": "simple_polygon", "data": [[0, 0], [5, 0], [5, 5], [0, 5]]}},
]


def written(folder: Path, data: Any) -> Path:
    file = folder / "instance.json"
    file.write_text(json.dumps(data))
    return file


def test_bins_are_sheets_as_often_as_they_are_in_stock(tmp_path: Path) -> None:
    nesting = load_nesting(written(tmp_path, {"name": "plates", "items": ITEMS, "bins": BINS}))
    assert nesting.name == "plates" and len(nesting.sheets) == 2 + 4 and not nesting.placed
    assert [(part.name, part.quantity, part.rotations) for part in nesting.left] == [
        ("item 7", 3, (0, 1)),
        ("item 8", 1, None),
    ]
    result = place(nesting)
    assert not result.left and overlaps(result) == ()


def test_a_solution_of_several_bins_is_a_layout(tmp_path: Path) -> None:
    def one(item: int, x: float, y: float, turn: float = 0.0) -> dict[str, Any]:
        return {"item_id": item, "transformation": {"rotation": turn, "translation": [x, y]}}

    layouts = [
        {"container_id": 1, "placed_items": [one(7, 0, 0), one(7, 0, 1)]},
        {"container_id": 2, "placed_items": [one(7, 1, 0, math.pi / 2)]},
    ]
    nesting = load_nesting(written(tmp_path, {"items": ITEMS, "bins": BINS, "solution": {"layouts": layouts}}))
    assert [one.sheet for one in nesting.placed] == [0, 1, 1] or [one.sheet for one in nesting.placed] == [0, 0, 1]
    assert overlaps(nesting) == () and [part.name for part in nesting.left] == ["item 8"]
    assert nesting.placed[2].pose == cfree.Pose(1, 0, "90deg")


def test_capital_keys_and_objects_are_read(tmp_path: Path) -> None:
    shape = {
        "Type": "Polygon",
        "Data": {"Outer": [[0, 0], [4, 0], [4, 4], [0, 4]], "Inner": [[[1, 1], [1, 2], [2, 1]]]},
    }
    items = [
        {
            "Demand": 2,
            "AllowedOrientations": [0.0],
            "Shape": {"Type": "SimplePolygon", "Data": [[0, 0], [1, 0], [0, 1]]},
        }
    ]
    nesting = load_nesting(
        written(tmp_path, {"Name": "old", "Items": items, "Objects": [{"Stock": 1, "Shape": shape}]})
    )
    assert len(nesting.sheets) == 1 and nesting.left[0].quantity == 2


def test_a_strip_has_its_height_and_room_for_all(tmp_path: Path) -> None:
    nesting = load_nesting(written(tmp_path, {"items": ITEMS, "strip_height": 2}))
    assert nesting.sheets[0].bounds[3] == 2 and not place(nesting, toward="left").left  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"strip_height": -1}, "strip_height: the height of a strip; give a number above 0"),
        ({"items": 3}, "items: expected a list of items, got 3"),
        ({"items": []}, "items: there is none; give at least one"),
        ({"bins": [{"shape": {"type": "blob"}}]}, r"bins\[0\].shape: expected a shape"),
        ({"items": [ITEMS[0] | {"demand": "two"}]}, r'items\[0\].demand: expected a whole number, got "two"'),
        ({"items": [ITEMS[0] | {"demand": -1}]}, r"items\[0\].demand: expected a number of copies, 0 or more, got -1"),
        ({"items": [ITEMS[0] | {"allowed_orientations": ["a"]}]}, r"items\[0\].allowed_orientations: expected a list"),
        ({"items": [ITEMS[0] | {"allowed_orientations": 90}]}, r"items\[0\].allowed_orientations: expected a list"),
        ({"bins": [{"stock": 1.5, "shape": ITEMS[0]["shape"]}]}, r"bins\[0\].stock: expected a whole number, got 1.5"),
    ],
)
def test_faults_have_their_place(tmp_path: Path, change: dict[str, Any], fault: str) -> None:
    with pytest.raises(cfree.FormatError, match=fault):
        load_nesting(written(tmp_path, {"items": ITEMS, **change}))


def test_layers_named_sheet_are_sheets_and_copies_are_one_part(tmp_path: Path) -> None:
    file = tmp_path / "drawing.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 99 99">'
        '<rect id="Sheet A" x="0" y="0" width="50" height="40"/>'
        '<rect id="a" x="1" y="1" width="5" height="4"/><rect id="b" x="11" y="1" width="5" height="4"/>'
        '<circle id="c" cx="30" cy="20" r="5"/></svg>'
    )
    nesting = load_nesting(file)
    assert len(nesting.sheets) == 1 and [one.part.name for one in nesting.placed] == ["a", "a", "c"]
    assert overlaps(nesting) == () and nesting.placed[2].part.is_round


@pytest.mark.parametrize(
    ("name", "sheets"),
    [("sheet2", 2), ("sheet_b", 2), ("Sheets", 2), ("bin-7", 2), ("stock:2", 2), ("binder", 1), ("sheeting", 1)],
)
def test_a_name_that_begins_with_the_word_is_a_sheet_whatever_follows_but_letters(
    tmp_path: Path, name: str, sheets: int
) -> None:
    file = tmp_path / "drawing.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 99 99">'
        '<rect id="sheet" x="0" y="0" width="50" height="40"/>'
        f'<rect id="{name}" x="60" y="0" width="30" height="40"/></svg>'
    )
    assert len(load_nesting(file).sheets) == sheets


def test_options_of_drawings_are_refused_for_instances(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"^join: only for drawings"):
        load_nesting(written(tmp_path, {"items": ITEMS}), join=1.0)
