"""Pictures of the record of reading: each kind in its colour, in a window that holds all of it."""

from pathlib import Path
from typing import Any

import pytest
from matplotlib.colors import to_hex

import cfree
import drawings
from cfree.palette import GUESSED, LOST, PATH
from cfree.scene.reading import Item, Note

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
RING = ((5.0, 5.0), (7.0, 5.0), (7.0, 6.0), (5.0, 5.0))
NOTES = (
    Note("lost", "open line", "less", 2, items=(Item("1", points=((3.0, 3.0), (4.0, 3.5))), Item("2", (-8.0, 0.0)))),
    Note("hidden", "line", items=(Item("3", points=((0.0, 4.0), (1.0, 4.0))),)),
    Note("guess", "outline", "more", items=(Item("4", points=RING),)),
    Note("joined", "end", "near", items=(Item("5", (5.0, 5.0)),)),
    Note("assumption", "speck", "less", 2, items=(Item("6", points=RING), Item("7", (2.0, 3.0)))),
    Note("info", "a user unit is 2 mm", items=(Item("8", (99.0, 99.0)),)),
)
SCENE = cfree.Scene(SQUARE, [[(3, 0), (4, 0), (4, 1)]], reading=NOTES)


def artists(figure: Any) -> list[tuple[str, str]]:
    """Kind and colour of what is drawn over the scene."""
    (ax,) = figure.axes
    shown = [artist for artist in (*ax.lines, *ax.patches, *ax.artists) if artist.get_zorder() in (8, 9)]
    colour = {"Line2D": "get_color", "Polygon": "get_edgecolor"}
    return sorted((type(a).__name__, to_hex(getattr(a, colour[type(a).__name__])())) for a in shown)


def test_each_kind_is_drawn_in_its_colour() -> None:
    expected = [("Line2D", LOST)] * 4 + [("Line2D", PATH), ("Polygon", GUESSED), ("Polygon", LOST)]
    assert artists(SCENE.plot()) == sorted(expected)


def test_guessed_outlines_are_hatched() -> None:
    (ax,) = SCENE.plot().axes
    hatched = [patch for patch in ax.patches if patch.get_hatch()]
    assert [to_hex(patch.get_edgecolor()) for patch in hatched] == [GUESSED]


def test_the_window_holds_what_was_lost_and_the_legend_names_it() -> None:
    figure = SCENE.plot()
    (ax,) = figure.axes
    assert ax.get_xlim()[0] < -8 and ax.get_xlim()[1] < 99
    names = [text.get_text() for text in ax.get_legend().get_texts()]
    assert names == ["lost", "assumed away", "guessed", "joined"]


def test_a_scene_without_a_record_is_drawn_as_before() -> None:
    (ax,) = cfree.Scene(SQUARE, SCENE.obstacles).plot().axes
    assert ax.get_legend() is None and not [line for line in ax.lines if line.get_zorder() in (8, 9)]


@pytest.mark.parametrize("name", ["a.svg", "a.dxf", "map.yaml", "nav.yaml", "n.json"])
def test_shapes_of_any_file_are_drawn(name: str, tmp_path: Path) -> None:
    drawings.put(tmp_path)
    shapes = cfree.load_shapes(tmp_path / name)
    (ax,) = shapes.plot().axes
    assert ax.get_title().startswith(f"Shapes of {name}") and len(ax.patches) >= 1


def test_layers_and_shapes_without_any_are_drawn() -> None:
    shapes = cfree.load_shapes("examples/scenes/flat.json")
    (ax,) = shapes.layers["outer walls"].plot().axes
    assert len(ax.patches) == 1
    with pytest.raises(ValueError, match="drawn alone"):
        cfree.plot.picture(shapes, SCENE)
