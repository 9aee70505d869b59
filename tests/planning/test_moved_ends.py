"""Starts and goals that are not free are moved to the nearest free poses, and answers say so."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

import pytest

import cfree.verify
from cfree import (
    AllSeparated,
    Curved,
    FormatError,
    InvalidPoseError,
    Path,
    Pose,
    Scene,
    Separated,
    load,
    plan,
    save,
)
from cfree.planning import Moved
from second_opinion import check_answer, verified_in_a_file
from shapes import box

SQUARE = box(0, 0, 1, 1)[0]
ROOM = box(-9, -9, 9, 9)[0]
WALL, FLOOR = box(2, 0, 3, 9)[0], box(-9, -2, 9, -1)[0]
IN_WALL = Pose("1.25", 2)
OPEN, SHUT = Scene(SQUARE, [WALL], workspace=ROOM), Scene(SQUARE, [WALL, FLOOR], workspace=ROOM)


def again(answer: Any, folder: FilePath) -> Any:
    save(answer, folder / "answer.json")
    return load(folder / "answer.json")


def test_a_forbidden_start_is_moved_and_the_answer_says_from_where(tmp_path: FilePath) -> None:
    path = plan(OPEN, IN_WALL, (5, 0, 0), nearest_free=True)
    assert isinstance(path, Path) and path.start == Pose(1, 2) and path.moved == Moved(start=IN_WALL)
    assert again(path, tmp_path) == path != replace(path, moved=None)
    asked = Scene(SQUARE, [WALL], workspace=ROOM, start=IN_WALL, goal=(5, 0, 0))
    result = verified_in_a_file(asked, path)
    assert result.proved.startswith(
        f"A path of {len(path.motions)} motions leads from (1, 2, 0 deg) [moved from (1.25, 2, 0 deg)] to (5, 0, 0 deg)"
    )
    assert "start from (1.25, 2, 0 deg) to (1, 2, 0 deg); it is forbidden there" in str(result)
    assert not cfree.verify.answer(asked, replace(path, moved=None)).verified, "it begins elsewhere"


@pytest.mark.parametrize("clearance", [None, "1/10"])
def test_goals_are_moved_poses_places_and_lists(clearance: str | None, tmp_path: FilePath) -> None:
    by, far = Fraction(clearance or 0), Fraction(clearance or 0) / 50
    for goal in (Pose("2.25", 2), (Fraction("2.25"), Fraction(2)), [(Fraction("2.25"), Fraction(2)), Pose(40, 40)]):
        path = plan(OPEN, (0, 2, 0), goal, nearest_free=True, clearance=clearance)
        assert isinstance(path, Path) and path.moved
        assert path.moved == Moved(None, goal[0] if isinstance(goal, list) else goal)
        assert 3 + by <= path.goal.x <= 3 + by + far and path.goal.y == 2
        assert again(path, tmp_path) == path and verified_in_a_file(OPEN, path).verified


def test_free_ends_stay_where_they_are() -> None:
    for goal in ((5, 0, 0), (5, 0), [(5, 0), (-5, 0, 0)]):
        path = plan(OPEN, (0, 0, 0), goal, nearest_free=True, clearance="1/2")
        assert isinstance(path, Path) and path.moved is None and path == plan(OPEN, (0, 0, 0), goal, clearance="1/2")


def test_an_end_that_touches_is_free_and_one_nearer_than_the_clearance_is_moved() -> None:
    touching = Pose(1, 2)
    path = plan(OPEN, touching, (0, 0, 0), nearest_free=True)
    assert isinstance(path, Path) and path.moved is None
    path = plan(OPEN, touching, (0, 0, 0), nearest_free=True, clearance="1/5")
    assert isinstance(path, Path) and path.moved == Moved(touching) and path.clearance == Fraction(1, 5)
    exactly = plan(OPEN, (Fraction(4, 5), 2, 0), (0, 0, 0), nearest_free=True, clearance="1/5")
    assert isinstance(exactly, Path) and exactly.moved is None


def test_proofs_say_what_was_moved(tmp_path: FilePath) -> None:
    proof = plan(SHUT, IN_WALL, (0, "-2.5", 0), nearest_free=True)
    assert isinstance(proof, Separated) and proof.moved == Moved(IN_WALL, Pose(0, "-2.5"))
    assert again(proof, tmp_path) == proof and verified_in_a_file(SHUT, proof).verified
    assert proof.reversed().moved is None
    thick = Scene(SQUARE, [WALL, box(-9, -6, 9, -1)[0]], workspace=ROOM)
    all_of = plan(thick, IN_WALL, [(0, -5), (0, -8, 0)], nearest_free=True)
    assert isinstance(all_of, AllSeparated) and all_of.moved_goals == {(0, -7): (0, -5)}
    assert again(all_of, tmp_path) == all_of
    for goals, same in (([(0, -5), (0, -8, 0)], True), ([(0, -4), (0, -8, 0)], False), ([(0, -7), (0, -8, 0)], False)):
        asked = Scene(SQUARE, thick.obstacles, workspace=ROOM, start=IN_WALL, goals=goals)
        result = cfree.verify.answer(asked, all_of)
        assert result.verified == same, result
    moved = "(1, 2, 0 deg) [moved from (1.25, 2, 0 deg)] to any of (0, -7, any) [moved from (0, -5, any)], (0, -8, "
    assert f"leads from {moved}" in cfree.verify.answer(thick, all_of).proved


def test_what_was_moved_and_need_not_have_been_is_refuted() -> None:
    path = plan(OPEN, (0, 0, 0), (5, 0, 0))
    for moved in (Moved(Pose(0, 1)), Moved(goal=Pose(5, 1)), Moved(IN_WALL, Pose(1, 2))):
        assert isinstance(path, Path)
        assert not verified_in_a_file(OPEN, replace(path, moved=moved)).verified
    room = cfree.verify.answer(OPEN, replace(path, moved=Moved(goal=(Fraction(5), Fraction(1)))))
    assert "(5, 1, any) is free, and it was moved" in str(room.findings[0])
    bounded = Scene(SQUARE, [], bounds=(0, 0, 5, 5))
    outside = plan(bounded, (0, 0, 0), (7, 7), nearest_free=True)
    assert isinstance(outside, Path) and outside.goal == Pose(5, 5) and cfree.verify.answer(bounded, outside).verified


def test_files_say_it_as_described(tmp_path: FilePath) -> None:
    file = tmp_path / "answer.json"
    save(plan(OPEN, IN_WALL, ("2.25", 2), nearest_free=True), file)
    data = json.loads(file.read_text())
    assert data["moved"] == {"start": ["5/4", "2", {"tau": "0"}], "goal": ["9/4", "2"]}
    for wrong in ({}, {"start": None}, {"start": ["1", "2"]}, {"end": ["1", "2", 0]}, 5):
        text = json.dumps(data | {"moved": wrong})
        file.write_text(text)
        with pytest.raises(FormatError, match="moved"):
            load(file)
        with pytest.raises(check_answer.BadFileError):
            check_answer.PathAnswer(check_answer.decoded(text))
    older = {key: value for key, value in data.items() if key != "moved"}
    file.write_text(json.dumps(older))
    assert load(file).moved is None  # type: ignore[union-attr]


def test_among_round_shapes_ends_are_moved_too() -> None:
    scene = Scene(Curved.circle((0, 0), "1/2"), [Curved.circle((0, 0), 1)], workspace=ROOM)
    path = plan(scene, ("1.3", 0, 0), (-3, 0, 0), nearest_free=True)
    assert isinstance(path, Path) and path.moved == Moved(Pose("1.3", 0)) and path.start == Pose("1.5", 0)
    result = cfree.verify.answer(scene, path)
    assert result.verified and "[moved from (1.3, 0, 0 deg)]" in result.proved


@pytest.mark.slow
def test_among_arcs_ends_that_keep_exactly_the_clearance_stay_where_they_are() -> None:
    scene = Scene(Curved.circle((0, 0), "1/2"), [Curved.circle((0, 0), 1)], workspace=ROOM)
    path = plan(scene, ("1.7", 0, 0), (-3, 0, 0), nearest_free=True, clearance="0.2")
    assert isinstance(path, Path) and path.moved is None and cfree.verify.answer(scene, path).verified
    path = plan(scene, ("1.6", 0, 0), ("-1.6", 0), nearest_free=True, clearance="0.2")
    assert isinstance(path, Path) and path.start == Pose("1.7", 0) and -1.71 < path.goal.x < -1.7
    assert cfree.verify.answer(scene, path).verified


def test_where_nothing_is_free_it_is_refused() -> None:
    cell = Scene(SQUARE, [box(-1, -1, 3, 3)[0]], bounds=(0, 0, 1, 1))
    with pytest.raises(InvalidPoseError, match=r"start \(0, 0, 0 deg\): no pose near by is free; give another"):
        plan(cell, (0, 0, 0), (1, 1, 0), nearest_free=True)
    narrow = Scene(SQUARE, [], workspace=box(0, 0, 4, 4)[0])
    with pytest.raises(
        InvalidPoseError, match=r"start \(1, 1, 0 deg\): no pose near by is free and 2 away from everything"
    ):
        plan(narrow, (1, 1, 0), (2, 2), nearest_free=True, clearance=2)
