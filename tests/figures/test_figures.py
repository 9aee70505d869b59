"""The paper's figures: what they show is true, their labels are legible, their files are whole."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

from cfree import load_scene
from cfree.figures import FIGURES, draw, draw_all, scenes, surfaces
from cfree.figures.style import FORMATS, styled, write
from cfree.plot.depth_sort import Painting
from drawn import figure as drawn
from overlaps import touching, written

NUMBERS = [entry.number for entry in FIGURES]


# files


@pytest.mark.slow
def test_figures_are_written_whole_in_all_formats(tmp_path: Path) -> None:
    shares: list[float] = []
    chosen = {"01-rest-and-moved": 1, "08-edge-vertex-surface": 8}  # in the plane and in space
    files = draw_all(tmp_path / "a" / "b", only=chosen.values(), progress=shares.append)
    assert sorted(files) == sorted((tmp_path / "a" / "b").iterdir())
    assert {file.name for file in files} == {f"{stem}.{suffix}" for stem in chosen for suffix in FORMATS}
    assert shares == [0, 0.5, 1]
    for file in files:
        width, height = FIGURES[chosen[file.stem] - 1].size
        if file.suffix == ".png":
            with Image.open(file) as image:
                assert image.width / image.height == pytest.approx(width / height, rel=0.01)
                seen = np.asarray(image.convert("RGB")).reshape(-1, 3)
            # ink on paper
            assert 0.3 < (seen == 255).all(axis=1).mean() < 0.99
        elif file.suffix == ".svg":
            root = ElementTree.parse(file).getroot()
            box = [float(part) for part in root.attrib["viewBox"].split()]
            assert box[2] / box[3] == pytest.approx(width / height, rel=0.01)
            assert sum(element.tag.endswith(("path", "image")) for element in root.iter()) > 10
        else:
            assert file.read_bytes().startswith(b"%PDF") and file.read_bytes().rstrip().endswith(b"%%EOF")


@pytest.mark.slow
def test_files_have_the_same_bytes_each_time(tmp_path: Path) -> None:
    first, second = (draw_all(tmp_path / name, only=[5]) for name in "ab")
    assert [file.read_bytes() for file in first] == [file.read_bytes() for file in second]


def test_a_figure_that_cannot_be_written_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (file,) = draw_all(tmp_path, only=[6], formats=["png"])
    before = file.read_bytes()

    def fail(*_: Any, **__: Any) -> None:
        raise OSError("full")

    monkeypatch.setattr(Figure, "savefig", fail)
    with pytest.raises(OSError, match="full"):
        draw_all(tmp_path, only=[6], formats=["png"])
    assert file.read_bytes() == before and list(tmp_path.iterdir()) == [file]


def test_the_gallery_shows_all_figures(request: pytest.FixtureRequest) -> None:
    docs = request.config.rootpath / "docs"
    page = (docs / "figures.md").read_text()
    for entry in FIGURES:
        image = docs / "images" / "figures" / f"{entry.stem}.png"
        assert f"images/figures/{image.name}" in page and image.stat().st_size < 200_000
        with Image.open(image) as shown:
            width, height = entry.size
            assert shown.width / shown.height == pytest.approx(width / height, rel=0.02)


# legibility


@pytest.mark.slow
@pytest.mark.parametrize("number", NUMBERS)
def test_labels_are_on_the_page_and_do_not_overlap(number: int) -> None:
    figure = drawn(number)
    # the names of what is drawn, not what it is drawn of: surfaces are left out, which takes longest
    for painting in figure.findobj(Painting):
        painting.set_visible(False)
    with styled():
        boxes = written(figure)
        assert list(touching(figure)) == []
    assert len(boxes) >= 4
    width, height = figure.bbox.size
    for text, box in boxes:
        x0, y0, x1, y1 = box.bounds
        assert x0 >= 0 and y0 >= 0 and x1 <= width and y1 <= height, text


def test_the_triangles_and_the_five_obstacles_are_those_of_the_examples() -> None:
    fig9, five = (load_scene(f"examples/scenes/{name}.json") for name in ("paper_fig9", "five_convex"))
    assert (fig9.robot, fig9.obstacles) == ((surfaces.TRIANGLE,), (surfaces.OTHER,))
    assert (scenes.FIVE.robot, scenes.FIVE.obstacles) == (five.robot, five.obstacles)
    assert (scenes.FIVE.start, scenes.FIVE.goal) == (five.start, five.goal)


def test_drawing_leaves_the_settings_of_matplotlib_alone(tmp_path: Path) -> None:
    from matplotlib import rcParams

    before = json.dumps({key: str(value) for key, value in rcParams.items()})
    with styled():
        write(draw(1), tmp_path / "one.svg")
    assert json.dumps({key: str(value) for key, value in rcParams.items()}) == before
