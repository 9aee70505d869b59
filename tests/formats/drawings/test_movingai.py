"""MovingAI's maps."""

from pathlib import Path

import pytest

import cfree
from cfree.errors import FormatError

HEAD = "type octile\nheight 3\nwidth 4\nmap\n"


def test_the_first_row_is_the_top_and_cells_are_1_by_1(tmp_path: Path) -> None:
    (tmp_path / "a.map").write_text(HEAD + "..@S\nG.WO\n.T..\n")
    shapes = cfree.load_shapes(tmp_path / "a.map")
    room = shapes.of("workspace")[0].polygon
    assert room == cfree.Polygon([(0, 0), (4, 0), (4, 3), (0, 3)])
    assert sorted(shape.polygon.bounds for shape in shapes.of("obstacle")) == [(1, 0, 2, 1), (2, 1, 4, 3)]
    assert ("info", "swamp: free", 1) in [(note.kind, note.what, note.count) for note in shapes.reading]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (HEAD + "..@S\nG.Ww\n.T..\n", r"a.map:6:4 'w' is no cell; give one of .GS@OTW"),
        (HEAD + "..@S\nG.é.\n.T..\n", r"a.map:6:3 'é' is no cell"),
        (HEAD + "..@S\nG.W\n.T..\n", "a.map:6:1 3 letters, the width is 4"),
        (HEAD + "..@S\n", "1 rows of 3; give all of them"),
        (HEAD + "..@S\nG.W.\n.T..\n....\n", "a.map:8:1 more than 3 rows; set the height"),
        ("", "no map of MovingAI"),
        ("type octile\nheight 3\nmap\n...\n", "no map of MovingAI"),
        ("type octile\nheight -3\nwidth 4\nmap\n", "no map of MovingAI"),
        ("type octile\nheight 99999\nwidth 99999\nmap\n", "more than 67,108,864 cells"),
    ],
)
def test_faults_have_their_place(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "a.map").write_text(text, encoding="utf-8")
    with pytest.raises(FormatError, match=message):
        cfree.load_shapes(tmp_path / "a.map")
