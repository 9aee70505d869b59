"""Damaged and hostile files: each is read or refused with one error; `fuzz_readers.py` tries as many as one likes."""

import random
import time
from pathlib import Path

import pytest

import cfree
import hostile
from cfree.errors import FormatError
from cfree.scene.reading import Item, Note
from fuzz_readers import BOMBS, result_of, words_of, wrong_note

BOMB = {name: k * BOMBS + BOMBS - 1 for k, name in enumerate(sorted(hostile.BOMBS))}
"""Number of the first file of each kind of bomb."""


@pytest.mark.parametrize("tens", range(3))
def test_damaged_files_are_read_or_refused_with_one_error(tens: int, tmp_path: Path) -> None:
    for number in range(10 * tens, 10 * tens + 10):
        assert not result_of(number, tmp_path)[2], f"file {number}"


SLOW = ("svg_uses_of_uses", "svg_crossing_curves", "dxf_polyline", "svg_clips_of_clips")  # even with few parts


@pytest.mark.parametrize("name", [name for name in BOMB if name not in SLOW])
def test_small_bombs_are_read_or_refused_with_one_error(name: str, tmp_path: Path) -> None:
    came = result_of(BOMB[name], tmp_path, most=10)
    assert came[0] == name and not came[2]


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("name", BOMB)
def test_bombs_of_thousands_of_parts_are_read_or_refused(name: str, tmp_path: Path) -> None:
    assert not result_of(BOMB[name], tmp_path, most=3_000)[2]


@pytest.mark.slow
@pytest.mark.long
def test_many_damaged_files_are_read_or_refused_with_one_error(tmp_path: Path) -> None:
    for number in range(700_000, 700_300):
        assert not result_of(number, tmp_path)[2], f"file {number}"


def test_a_bomb_has_about_as_many_parts_as_it_is_given() -> None:
    name, content = hostile.BOMBS["svg_many_uses"](random.Random(0), 50)
    assert (name, content.count(b"<use")) == ("bomb.svg", 50)


@pytest.mark.parametrize(
    ("note", "fault"),
    [
        (Note("lost", "open line", "less", 2, "A", (1.0, 2.0), 3.0, (Item("5F", (0.0, 1.0)),)), ""),
        (Note("gone", "open line"), "kind"),
        (Note("lost", "open line", "fewer"), "effect"),
        (Note("lost", "", count=0), "count, what"),
        (Note("lost", "open line", at=(1, float("nan"))), "places"),
        (Note("lost", "open line", size=-1.0), "sizes"),
        (Note("lost", "open\nline"), "one line"),
    ],
)
def test_notes_of_a_wrong_shape_are_faults(note: Note, fault: str) -> None:
    assert wrong_note(note) == fault


def test_options_are_words_of_the_command() -> None:
    options = {"join": 0.5, "repair": False, "join_holes": True, "roles": {"a": "robot"}, "curves": True}
    assert words_of(options) == ["--join", "0.5", "--no-repair", "--join-holes", "--role", "a=robot"]


def test_uses_of_uses_that_are_too_many_are_refused_at_once(tmp_path: Path) -> None:
    uses = [f"<use href='#a{k}'/>" * 10 for k in range(29)]
    groups = "".join(f"<g id='a{k + 1}'>{use}</g>" for k, use in enumerate(uses))
    file = tmp_path / "a.svg"
    file.write_text(f"<svg><defs><rect id='a0' width='1' height='1'/>{groups}</defs><use href='#a29'/></svg>")
    begin = time.process_time()
    with pytest.raises(FormatError, match="more than 3,000,000 elements and points"):
        cfree.load_shapes(file)
    assert time.process_time() - begin < 2
    file.write_text(f"<svg><defs><rect id='a0' width='1' height='1'/>{groups}</defs><use href='#a2'/></svg>")
    assert len(cfree.load_shapes(file).shapes) == 100
