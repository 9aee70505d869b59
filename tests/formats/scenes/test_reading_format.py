"""The record of reading in files of scenes: written whole, read with its faults, and lists of older programs."""

import json
from pathlib import Path

import pytest

import cfree
from cfree.formats.scenes.reading_text import MOST_WRITTEN, records
from cfree.scene.reading import Item, Note
from scene_texts import faults, read

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
ROBOT = '"robot": [[0, 0], [1, 0], [0, 1]]'
ITEMS = (Item("5F", (1.5, 2.0), 3.0, ((0.0, 0.0), (1.0, 1.0))), Item("60"))
NOTES = (
    Note("lost", "open line", "less", 39, "A-WALL", (12.25, -2.5), 140.0, ITEMS, "--join 0.0004", "plan.dxf"),
    Note("info", "a user unit is 2 mm"),
    Note("zebra", "stripe", "odd"),
)


def scene(*notes: Note) -> cfree.Scene:
    return cfree.Scene(SQUARE, [[(3, 0), (4, 0), (4, 1)]], reading=notes)


def test_scene_files_keep_the_record(tmp_path: Path) -> None:
    cfree.save(scene(*NOTES), tmp_path / "a.json")
    assert cfree.load_scene(tmp_path / "a.json").reading == NOTES
    cfree.save(scene(), tmp_path / "b.json")
    assert "reading" not in (tmp_path / "b.json").read_text()


@pytest.mark.parametrize("suffix", ["geojson", "svg", "dxf"])
def test_exported_scenes_keep_the_record(suffix: str, tmp_path: Path) -> None:
    cfree.save(scene(*NOTES), tmp_path / f"a.{suffix}")
    reading = cfree.load_scene(tmp_path / f"a.{suffix}").reading
    notes = [(note.kind, note.what, note.effect, note.count, note.where, note.at, note.size) for note in NOTES]
    assert [(n.kind, n.what, n.effect, n.count, n.where, n.at, n.size) for n in reading] == notes
    assert [item.handle for item in reading[0].items] == ["5F", "60"]
    assert reading[0].file == "plan.dxf"


def test_unknown_kinds_and_effects_are_kept(tmp_path: Path) -> None:
    loaded = read(tmp_path, f'{{{ROBOT}, "reading": [{{"kind": "zebra", "what": "stripe", "effect": "odd"}}]}}')
    cfree.save(loaded, tmp_path / "again.json")
    assert cfree.load_scene(tmp_path / "again.json").reading == (Note("zebra", "stripe", "odd"),)


def test_lists_of_older_programs_become_notes(tmp_path: Path) -> None:
    loaded = read(tmp_path, f'{{{ROBOT}, "changed": ["a user unit is 2 mm"], "dropped": ["open line"]}}')
    assert loaded.reading == (Note("info", "a user unit is 2 mm"), Note("info", "open line", "unknown"))


def test_values_that_no_file_can_hold_are_left_out() -> None:
    odd = Note("lost", "line \ud800", "less", 2, "", (float("nan"), 0), float("inf"), (Item("1", (1, 2)),) * 30)
    (record,) = records([odd])
    assert json.loads(json.dumps(record, allow_nan=False)) == {
        "kind": "lost", "effect": "less", "count": 2, "what": "line \\ud800",
        "items": [{"handle": "1", "at": [1.0, 2.0]}] * MOST_WRITTEN,
    }  # fmt: skip


@pytest.mark.parametrize(
    ("reading", "fault"),
    [
        ("7", "reading: expected a list, got 7"),
        ('[{"kind": "lost"}]', 'reading[0]: key "what" is missing; add it'),
        ('[{"kind": "lost", "what": 3}]', "reading[0].what: expected text in quotes, got 3"),
        (
            '[{"kind": "lost", "what": "a", "count": -1}]',
            "reading[0].count: expected a whole number, 0 or more, got -1",
        ),
        ('[{"kind": "lost", "what": "a", "at": [1]}]', "reading[0].at: expected a place [x, y], got [1]"),
        ('[{"kind": "lost", "what": "a", "size": "3"}]', 'reading[0].size: expected a number, got "3"'),
        ('[{"kind": "lost", "what": "a", "wher": "b"}]', 'reading[0].wher: unknown key "wher"; did you mean "where"?'),
        (
            '[{"kind": "lost", "what": "a", "items": [{"handel": ""}]}]',
            'reading[0].items[0].handel: unknown key "handel"; did you mean "handle"?',
        ),
    ],
)
def test_faults_of_a_record_have_their_places(reading: str, fault: str, tmp_path: Path) -> None:
    (line,) = faults(tmp_path, f'{{{ROBOT}, "reading": {reading}}}')
    assert line.partition(" ")[2] == fault
