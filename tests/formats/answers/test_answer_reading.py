"""Answers in files keep the record of reading of their scene."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import cfree
import cfree.verify
from cfree.errors import FormatError
from cfree.scene.reading import Item, Note
from second_opinion import check_answer

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
LOST = Note("lost", "open line", "less", 39, "A-WALL", (6.0, 4.0), 2.0, (Item("5F", (6.0, 4.0), 2.0, ((6.0, 4.0),)),))
MORE = Note("guess", "outline closed only by a join", "more")
NOTES = (LOST, MORE, Note("zebra", "stripe"))
OPEN = cfree.Scene(
    SQUARE, [[(4, 3), (5, 3), (5, 5)]], bounds=(-1, -1, 9, 5), start=(1, 1, 0), goal=(7, 1, 0), reading=NOTES
)
CLOSED = replace(OPEN, obstacles=[[(4, -3), (5, -3), (5, 8), (4, 8)]], obstacle_names=None)
SEVERAL = replace(CLOSED, goal=None, goals=[(7, 1), (8, 2)])
ROUND = replace(OPEN, obstacles=[cfree.Curved.circle((4, 4), 1)], obstacle_names=None)


@pytest.mark.parametrize("scene", [OPEN, CLOSED, SEVERAL, ROUND], ids=["path", "separated", "all", "round"])
def test_the_file_of_an_answer_keeps_the_record(scene: cfree.Scene, tmp_path: Path) -> None:
    file = tmp_path / "answer.json"
    answer = cfree.plan(scene)
    cfree.save(answer, file)
    again: Any = cfree.load(file)
    expected = (replace(LOST, items=(Item("5F", (6.0, 4.0), 2.0),)), *NOTES[1:])
    assert again == answer and again.stamp.reading == expected
    cfree.save(again, tmp_path / "again.json")
    assert cfree.load(tmp_path / "again.json").stamp.reading == expected  # type: ignore[union-attr]


@pytest.mark.parametrize("scene", [OPEN, CLOSED, SEVERAL, ROUND], ids=["path", "separated", "all", "round"])
def test_verify_repeats_the_record_of_scene_and_answer_once(scene: cfree.Scene, tmp_path: Path) -> None:
    cfree.save(cfree.plan(scene), tmp_path / "answer.json")
    worst = (
        "39 open lines of A-WALL (the largest 2 at 6, 4)"
        if scene in (OPEN, ROUND)
        else "1 outline closed only by a join"
    )
    for own in (scene, replace(scene, reading=())):
        result = cfree.verify.answer(own, tmp_path / "answer.json")
        assert result.verified and [note.count for note in result.reading] == [39, 1, 1]
        assert result.as_read == f"PROVED for the scene in this file, which was read with losses: {worst}"
        assert str(result).endswith(result.as_read)


def test_verify_of_a_clean_scene_adds_nothing(tmp_path: Path) -> None:
    clean = replace(OPEN, reading=())
    cfree.save(cfree.plan(clean), tmp_path / "answer.json")
    result = cfree.verify.answer(clean, tmp_path / "answer.json")
    assert result.as_read == "" and result.reading == ()
    assert cfree.verify.boundary(cfree.boundary(OPEN), OPEN, slices=0).as_read.endswith("closed only by a join")


def test_verify_of_a_refuted_answer_proves_nothing(tmp_path: Path) -> None:
    result = cfree.verify.answer(CLOSED, cfree.plan(OPEN))
    assert not result.verified and result.as_read == ""


def test_the_check_without_cfree_takes_records(tmp_path: Path) -> None:
    cfree.save(OPEN, tmp_path / "scene.json")
    cfree.save(cfree.plan(OPEN), tmp_path / "answer.json")
    texts = ((tmp_path / name).read_text() for name in ("scene.json", "answer.json"))
    assert check_answer.verdict(*texts)[0] == check_answer.VERIFIED


def test_outlines_along_a_path_keep_the_record(tmp_path: Path) -> None:
    cfree.save(cfree.plan(OPEN), tmp_path / "way.geojson")
    data = json.loads((tmp_path / "way.geojson").read_text())
    assert [note["kind"] for note in data["reading"]] == ["lost", "guess", "zebra"]


def test_faults_of_a_record_in_an_answer_have_their_places(tmp_path: Path) -> None:
    file = tmp_path / "answer.json"
    cfree.save(cfree.plan(OPEN), file)
    file.write_text(file.read_text().replace('"count": 39', '"count": "many"'))
    with pytest.raises(
        FormatError, match=r'scene\.reading\[0\]\.count: expected a whole number, 0 or more, got "many"'
    ):
        cfree.load(file)
