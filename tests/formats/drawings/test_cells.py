"""Cells of maps: what is said about them, despeckling, and the options of reading."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

import cfree
import drawings
from cfree.errors import FormatError
from cfree.formats.drawings.grid import specks
from cfree.formats.drawings.source import Reading
from cfree.formats.readers import read_file
from cfree.formats.shapes import Shapes

HEAD = "image: m.png\nresolution: 0.5\norigin: [1, 2, 0]\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path


def read(folder: Path, rows: list[list[int]], text: str = "", **options: Any) -> Shapes:
    """Read a map of grey values."""
    (folder / "m.png").write_bytes(drawings.png(rows))
    (folder / "m.yaml").write_text(HEAD + text)
    shapes = read_file(folder / "m.yaml", Reading(**options))
    assert isinstance(shapes, Shapes)
    return shapes


def said(shapes: Shapes, what: str) -> list[tuple[str, str, int, str, str]]:
    """The notes whose subject contains some words."""
    notes = [note for note in shapes.reading if what in note.what]
    return [(note.kind, note.effect, note.count, note.where, note.remedy) for note in notes]


def area(shapes: Shapes) -> float:
    """The number of cells that are obstacles."""
    return sum(float(shape.polygon.exact_area) for shape in shapes.of("obstacle")) * 4


def test_black_is_occupied_at_thresholds_of_1_and_0_by_the_strict_rules_and_those_of_nav2(folder: Path) -> None:
    text = "mode: trinary\noccupied_thresh: 1.0\nfree_thresh: 0.0"
    cells = {rules: area(read(folder, [[255, 0, 255]], text, unknown="free", map_rules=rules)) for rules in RULES}
    assert cells == {"strict": 1, "nav2": 1, "nav2-old": 0, "ros1": 0}
    shapes = read(folder, [[255, 0, 255]], text, unknown="free", map_rules="ros1")
    assert said(shapes, "another map server") == [("assumption", "less", 1, "", "--map-rules strict")]
    assert said(shapes, "cells by the ros1 rules") == [("info", "none", 1, "", "")]


RULES = ("strict", "nav2", "nav2-old", "ros1")


def test_free_cells_of_grey_205_are_warned_of_with_count_and_remedy(folder: Path) -> None:
    rows = [[0, 205, 254], [205, 254, 254]]
    text = "occupied_thresh: 0.65\nfree_thresh: 0.25"
    (note,) = [note for note in read(folder, rows, text).reading if note.kind == "warning"]
    assert (note.count, note.effect, note.where, note.at) == (2, "less", "grey 205", (1.75, 2.75))
    assert note.remedy == "--free-thresh 0.196 or --unknown-grey 205"
    for remedy in ({"free_thresh": 0.196}, {"unknown_grey": 205}):
        mended = read(folder, rows, text, **remedy)
        assert not [note for note in mended.reading if note.kind == "warning"]
        assert area(mended) == 3
        assert area(read(folder, rows, text, unknown="free", **remedy)) == 1
    assert not [note for note in read(folder, rows, "free_thresh: 0.196").reading if note.kind == "warning"]


def test_options_that_free_cells_are_assumptions(folder: Path) -> None:
    looser = read(folder, [[0, 150, 254]], "free_thresh: 0.196", free_thresh=0.5)
    assert said(looser, "another threshold") == [("assumption", "less", 1, "", "--free-thresh 0.5")]
    grey = read(folder, [[0, 150, 254]], unknown="free", unknown_grey=0)
    assert said(grey, "taken as unknown") == [("assumption", "less", 1, "", "--unknown-grey 0")]
    unknown = read(folder, [[0, 150, 254]], unknown="free")
    assert said(unknown, "unknown cell") == [("assumption", "less", 1, "", "--unknown obstacle")]


@pytest.mark.parametrize("unknown", ["obstacle", "free"])
def test_cells_in_between_are_forbidden_and_said_with_count_and_range(folder: Path, unknown: str) -> None:
    rows, text = [[0, 100, 200, 255]], "mode: scale\noccupied_thresh: 1.0\nfree_thresh: 0.0"
    shapes = read(folder, rows, text, unknown=unknown)
    assert area(shapes) == 3
    assert said(shapes, "in between") == [("guess", "more", 2, "values 22 to 61", "--occupied 65")]
    from_50 = read(folder, rows, text, unknown=unknown, occupied=50)
    assert area(from_50) == 2
    assert said(from_50, "in between") == [("assumption", "less", 1, "values 22 to 61", "--occupied 50")]
    raw = read(folder, [[0, 64, 65, 100, 110, 255]], "mode: raw", unknown="free", occupied=65)
    assert area(raw) == 3  # ROS 1 publishes 110


def test_specks_are_freed_and_listed(folder: Path) -> None:
    #  # . . . . ?     a speck at the edge stays, as does one beside an unknown cell
    #  . . # . . #     two cells that meet in a corner are one speck
    #  . # . . . .
    #  . . . . # .
    #  . . . . . .
    rows = np.full((5, 6), 254)
    for row, column in ((0, 0), (1, 2), (2, 1), (3, 4), (1, 5)):
        rows[row, column] = 0
    rows[0, 5] = 205
    text = "free_thresh: 0.196"
    assert [area(read(folder, rows.tolist(), text, unknown="free", despeckle=n)) for n in (0, 1, 2, 3)] == [5, 5, 4, 2]
    shapes = read(folder, rows.tolist(), text, unknown="free", despeckle=3)
    (note,) = [note for note in shapes.reading if note.what == "speck"]
    assert (note.kind, note.effect, note.count, note.size) == ("assumption", "less", 2, 0.5)
    assert note.at in [(1.75, 3.25), (2.25, 3.75)]
    assert [item.at for item in note.items if item.size == 0.25] == [(3.25, 2.75)]
    assert said(shapes, "occupied cell in a speck") == [("assumption", "less", 3, "", "--despeckle 0")]


@pytest.mark.parametrize("seed", range(30))
def test_specks_are_parts_connected_over_corners_among_free_cells(seed: int) -> None:
    random = np.random.default_rng(seed)
    states = random.choice([0, 1, 2], random.integers(2, 12, 2), p=[0.6, 0.3, 0.1])
    mask, free = states == 1, states == 0
    expected = set()
    left = {(int(r), int(c)) for r, c in np.argwhere(mask)}
    while left:
        part = [left.pop()]
        for r, c in part:
            near = {(r + u, c + v) for u in (-1, 0, 1) for v in (-1, 0, 1)} & left
            left -= near
            part += near
        around = {(r + u, c + v) for r, c in part for u in (-1, 0, 1) for v in (-1, 0, 1)} - set(part)
        inside = all(0 <= r < mask.shape[0] and 0 <= c < mask.shape[1] and free[r, c] for r, c in around)
        if inside and len(part) < 4:
            expected.add(frozenset(part))
    parts = [list(zip(rows.tolist(), columns.tolist(), strict=True)) for (rows, columns), _ in specks(mask, free, 4)]
    assert {frozenset(part) for part in parts} == expected
    assert len(parts) == len(expected)


def test_a_map_without_an_obstacle_is_said(folder: Path) -> None:
    assert said(read(folder, [[254, 254]], unknown="free"), "without an obstacle")


def test_crossed_thresholds_are_warned_of(folder: Path) -> None:
    text = "occupied_thresh: 0.2\nfree_thresh: 0.6"
    assert said(read(folder, [[254]], text), "below free_thresh") == [("warning", "unknown", 1, "", "")]
    assert not said(read(folder, [[254]], f"{text}\nmode: raw"), "below free_thresh")


def test_an_image_may_have_its_absolute_path_in_the_maps_folder(folder: Path) -> None:
    rows, mark = [[254, 0]], "image: m.png"
    expected = read(folder, rows).polygons
    (folder / "m.yaml").write_text(HEAD.replace(mark, f"image: {folder / 'm.png'}"))
    assert cfree.load_polygons(folder / "m.yaml") == expected
    (folder / "below").mkdir()
    (folder / "below" / "m.yaml").write_text(HEAD.replace(mark, f"image: {folder / 'm.png'}"))
    with pytest.raises(FormatError, match="is outside of the map's folder; put it beside the map"):
        cfree.load_polygons(folder / "below" / "m.yaml")


def test_a_map_names_its_frame(folder: Path) -> None:
    shapes = read(folder, [[254, 0]])
    scene = shapes.scene([(0, 0), (1, 0), (0, 1)])
    assert (scene.units, scene.source["frame"]) == ("m", "map")
    cfree.save(scene, folder / "s.json")
    assert cfree.load_scene(folder / "s.json").source["frame"] == "map"


@pytest.mark.parametrize("bits", [8, 16])
def test_images_of_8_and_16_bits_have_the_same_cells(folder: Path, bits: int) -> None:
    grey = [0, 102, 205, 254]  # the second is on the threshold
    data = bytes(grey) if bits == 8 else b"".join((257 * g).to_bytes(2, "big") for g in grey)
    (folder / "m.png").write_bytes(b"P5 4 1 %d\n" % (2**bits - 1) + data)
    (folder / "m.yaml").write_text(HEAD + "free_thresh: 0.196\noccupied_thresh: 0.6")
    shapes = read_file(folder / "m.yaml", Reading(unknown="free"))
    assert isinstance(shapes, Shapes)
    cells = shapely.union_all([polygon.to_shapely() for polygon in shapes.polygons])
    assert cells.equals(shapely.box(1, 2, 2, 2.5))
