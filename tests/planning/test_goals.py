"""Goals without theta, and several goals: the one that is reached, or proofs that none is."""

from __future__ import annotations

import json
import math
import random
from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from pathlib import Path as FilePath
from typing import Any

import numpy as np
import pytest

import cfree.verify
from cfree import (
    AllSeparated,
    FormatError,
    InvalidPoseError,
    MotionChecker,
    Path,
    Pose,
    Scene,
    Separated,
    UndecidedError,
    boundary,
    free_space,
    is_free,
    load,
    plan,
    save,
)
from cfree.exact import AlgebraicAngle, AngleInterval
from cfree.planning.goals import pose_in
from cfree.plot.boundary import around
from cfree.verify.orientations import left_out
from cfree.verify.world import World
from compared import scene_of
from second_opinion import verified_in_a_file
from shapes import KINDS, box, random_scene

ROD = box("-1/2", -2, "1/2", 2)[0]
START = Pose(0, 5)


def gate(half: Any, robot: Any = ROD, **more: Any) -> Scene:
    """A rod upright above a gap of twice `half` between two walls."""
    walls = [box(-9, -1, -Fraction(half), 1)[0], box(Fraction(half), -1, 9, 1)[0]]
    return Scene(robot, walls, workspace=box(-9, -9, 9, 9)[0], **more)


OPEN, SHUT = gate(1), gate("2/5")


def test_any_orientation_at_a_place_will_do() -> None:
    path = plan(OPEN, START, (0, -5))
    assert isinstance(path, Path) and (path.goal.x, path.goal.y) == (0, -5)
    assert path.is_free(MotionChecker(OPEN)) and path.turning == 0
    aside = plan(OPEN, START, ("-8.25", 0 + 4))  # upright, or nearly so: its start's
    assert isinstance(aside, Path) and aside.goal == Pose("-8.25", 4)
    turned = plan(OPEN, START, (0, "8.4"))  # only level ones
    assert isinstance(turned, Path) and is_free(OPEN, turned.goal)
    assert abs(math.remainder(turned.goal.theta, math.pi)) > math.radians(60)


def test_a_proof_has_no_truth_value() -> None:
    """So `if plan(scene)` never takes a proof for a path."""
    one, several = plan(SHUT, START, (0, -5, 0)), plan(SHUT, START, (0, -5))
    assert isinstance(one, Separated) and isinstance(several, AllSeparated)
    for proof in (one, several):
        for ask in (bool, lambda answer: not answer, lambda answer: answer or None, lambda answer: any([answer])):
            with pytest.raises(TypeError, match=rf"^{type(proof).__name__}: .*isinstance\(answer, cfree\.Path\)$"):
                ask(proof)


def test_of_several_the_nearest_is_reached() -> None:
    for goals, best in (
        ([(8, -5), (3, 5)], (3, 5)),
        ([(3, 5, 0), (0, 6, 0), (2, 5)], (0, 6)),
        ([START, (3, 5)], (0, 5)),
    ):
        path = plan(OPEN, START, goals)
        assert isinstance(path, Path) and (path.goal.x, path.goal.y) == best
    some = plan(SHUT, START, [(0, -5), (3, 5, "30deg")])
    assert isinstance(some, Path) and some.goal == Pose(3, 5, "30deg")
    assert some == plan(free_space(boundary(SHUT)), START, [(0, -5), (3, 5, "30deg")], improve=None)


def test_goals_of_a_scene_are_what_is_asked() -> None:
    place = gate(1, start=START, goal=(0, -5))
    path = plan(place)
    assert isinstance(path, Path) and (path.goal.x, path.goal.y) == (0, -5)
    assert verified_in_a_file(place, path).verified
    assert not verified_in_a_file(gate(1, start=START, goal=(0, -6)), path).verified
    several = gate(1, start=START, goals=[(0, -5), Pose(3, 5)])
    found = plan(several)
    assert isinstance(found, Path) and found.goal == Pose(3, 5) and verified_in_a_file(several, found).verified
    none = plan(gate("2/5", start=START, goals=[(0, -5), Pose(0, -6)]))
    assert isinstance(none, AllSeparated) and len(none.goals) == 2
    assert cfree.verify.answer(gate("2/5", start=START, goals=[(0, -5)]), none).verified
    assert not cfree.verify.answer(gate("2/5", start=START, goals=[(0, -5), (1, -5)]), none).verified
    with pytest.raises(InvalidPoseError, match="no goal: the scene has several, or a place"):
        cfree.max_margin(several)


@pytest.mark.slow
def test_if_none_is_there_is_a_proof_for_each_interval() -> None:
    proof = plan(SHUT, START, [(0, -5), (8, "-4.5", 0), (0, "-2.6")])
    assert isinstance(proof, AllSeparated) and proof.of == "closed" and len(proof.proofs) == 4
    assert proof.goals == ((0, -5), (0, Fraction("-2.6")), Pose(8, "-4.5"))
    result = cfree.verify.answer(SHUT, proof)
    assert result.verified and result.proved.endswith(
        "any of (0, -5, any), (0, -2.6, any), (8, -4.5, 0 deg), not even one that touches."
    )
    for one in proof.proofs:
        assert verified_in_a_file(SHUT, one).verified


@pytest.mark.slow
def test_a_proof_that_lacks_an_interval_is_refuted() -> None:
    proof = plan(SHUT, START, (0, "-2.6"))
    assert isinstance(proof, AllSeparated) and len(proof.proofs) == 2
    for k in (0, 1):
        result = cfree.verify.answer(SHUT, replace(proof, proofs=(proof.proofs[k],)))
        assert not result.verified and "1 interval and 0 single ones" in str(result.findings[0])
    other = replace(proof.proofs[0], start=Pose(0, "5.1"))
    assert not cfree.verify.answer(SHUT, replace(proof, proofs=(proof.proofs[1], other))).verified
    assert not cfree.verify.answer(OPEN, proof).verified
    asked = gate("2/5", start=START, goal=(0, -5, 0))
    assert "is none of them" in str(cfree.verify.answer(asked, proof).findings[0])


def test_one_orientation_stands_for_an_interval() -> None:
    rod = Scene(box(-5, -1, 5, 1)[0], [box(-20, 4, 20, 5)[0], box(-20, -5, 20, -4)[0]])
    interval, place = cfree.turn_in_place(rod, (0, 0, 0))[0], (Fraction(0), Fraction(0))
    end = interval.start
    assert end and len(end.polynomial) == 3
    assert pose_in(AngleInterval(end, end), START, place) is None, "single, and irrational"
    assert pose_in(interval, Pose(0, 0, "180deg"), place) == Pose(0, 0, "180deg")
    for start in (Pose(0, 0, "135deg"), Pose(0, 0, "225deg"), START):
        found = pose_in(interval, start, place)
        assert found and interval.contains({"tau": found.tau})
    right = AngleInterval(
        AlgebraicAngle.of((0, 0, "90deg")), AlgebraicAngle.of((0, 0, {"tau": 1 + Fraction(1, 2**90)}))
    )
    found = pose_in(right, START, place)
    assert found and found.tau and right.contains({"tau": found.tau})


def test_ends_that_are_not_free_are_named() -> None:
    for goal, message in (
        ((0, 0), r"goal \(0, 0\): no orientation is free there; give another place"),
        ([(3, 5), (0, 0)], r"goal 1 \(0, 0\): no orientation is free there"),
        ([(3, 5), (0, 0, 0)], r"goal 1 \(0, 0, 0 deg\) is forbidden"),
        ([(3, 5), (0,)], r"goal 1: \(0,\) is no pose"),
        ([], r"goal: \[\] is no pose"),
        ((1, "x"), "goal: .*'x' is no number"),
    ):
        with pytest.raises(InvalidPoseError, match=message):
            plan(SHUT, START, goal)  # type: ignore[call-overload]
    with pytest.raises(InvalidPoseError, match="goal 1: its position is beyond 1e150"):
        plan(SHUT, START, [(3, 5), (10**151, 0)])
    for wish, said in (({"improve": -1}, "improve -1: give seconds"), ({"objective": "x"}, "objective: 'x'; give "),
                       ({"clearance": 0}, "clearance 0: give a length above 0")):  # fmt: skip
        with pytest.raises(ValueError, match=said):
            plan(SHUT, START, [(3, 5, 0)], **wish)  # type: ignore[call-overload]
    with pytest.raises(InvalidPoseError, match=r"start .* is forbidden"):
        plan(SHUT, (0, 0, 0), (3, 5))
    with pytest.raises(InvalidPoseError, match=r"goal \(0, 8.4\): however it is turned there, .* nearer .* 0.2"):
        plan(OPEN, START, (0, "8.4"), clearance="0.2")
    with pytest.raises(InvalidPoseError, match=r"goal 1 \(9, 9\): however it is turned there"):
        plan(OPEN, START, [(3, 5), (9, 9)], clearance="0.2")


@pytest.mark.slow
def test_several_goals_and_a_clearance() -> None:
    goals = [(0, -5, 0), (4, 5, 0)]
    path = plan(SHUT, START, goals, clearance="1/2")
    assert isinstance(path, Path) and path.goal == Pose(4, 5) and path.clearance == Fraction(1, 2)
    proof = plan(SHUT, START, [goals[0], (1, -5, 0)], clearance="1/2")
    assert isinstance(proof, AllSeparated) and proof.clearance == Fraction(1, 2)
    assert cfree.verify.answer(SHUT, proof).proved.startswith(
        "No path that keeps 0.5 from obstacles and workspace leads"
    )


@pytest.mark.slow
def test_files(tmp_path: FilePath) -> None:
    proof, file = plan(SHUT, START, [(0, "-2.6"), (8, -5, 0)]), tmp_path / "proofs.json"
    save(proof, file)
    assert load(file) == proof and cfree.verify.answer(SHUT, file).verified
    assert not cfree.verify.answer(OPEN, file).verified
    text = file.read_text()
    for old, new, message in (
        ('"of": "closed",\n "places"', '"of": "open",\n "places"', 'of: expected "closed", "interior" or "pieces"'),
        ('"places": [["0", ', '"places": [["1", ', "there is no proof for one of the places"),
        ('"start": ["0", "5"', '"start": ["0", "5.25"', "not all proofs have the same start and scene"),
        ('"surface": [', '"surfaces": [', r"proofs\[0\].*surface"),
        ('"start": [0.0, 5.0', '"start": [0.0, 5.5', r"proofs\[0\].start\[1\].*moves the robot"),
    ):
        assert old in text, old
        file.write_text(text.replace(old, new, 1))
        with pytest.raises(FormatError, match=message):
            load(file)
    file.write_text(json.dumps(json.loads(text) | {"proofs": []}))
    with pytest.raises(FormatError, match="proofs"):
        load(file)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_intervals_left_out_are_those_that_turning_finds(kind: str) -> None:
    """By other code; the poses that stand for them are in each."""
    for seed in range(4):
        scene = scene_of(random_scene(seed, kind))
        world, rng = World(scene), random.Random(seed)
        for _ in range(4):
            place = Fraction(rng.randint(-40, 80), 10), Fraction(rng.randint(-4, 8))
            intervals = cfree.turn_in_place(scene, Pose(*place))
            if not intervals:
                continue
            single = sum(interval.is_single for interval in intervals)
            assert left_out(world, place, []) == (len(intervals) - single, single)
            middles = [Pose(*place, sum(i.theta) / 2) for i in intervals if not i.is_single]
            assert left_out(world, place, middles) == (0, single)
            assert left_out(world, place, middles[1:]) == (min(1, len(middles)), single)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_verdicts_are_those_of_the_cells(kind: str) -> None:
    rng, checked, found = random.Random(kind), 0, set()
    for seed in range(1, 9):
        scene = scene_of(random_scene(seed, kind))
        space = free_space(boundary(scene, threads=1))
        low, high = np.array(scene.bounds or (-4, -4, 8, 8), float).reshape(2, 2)
        corners = rng.choices(range(17), k=12), rng.choices(range(17), k=12)
        places = [tuple(Fraction(c) for c in low + (high - low) * np.array(k) / 16) for k in zip(*corners, strict=True)]
        held = {place: cfree.turn_in_place(scene, Pose(*place)) for place in places}
        for one, other in combinations([place for place, intervals in held.items() if intervals], 2):
            start = Pose(*one, sum(held[one][0].theta) / 2)
            if not is_free(scene, start):
                continue
            cells = {space.locate(Pose(*other, sum(interval.theta) / 2)) for interval in held[other]}
            answer = plan(space, start, other, improve=0)
            found.add(type(answer))
            if isinstance(answer, Path):  # through an exact fit it may lead into another cell
                assert answer.is_free(MotionChecker(scene))
            else:
                assert space.locate(start) not in cells and cfree.verify.answer(scene, answer).verified
            checked += 1
            if checked % 6 == 0:
                break
        if checked > 6 and len(found) > 1:
            break
    assert checked > 6 and Path in found


# a place, and a clearance


def test_a_path_to_a_place_keeps_a_clearance() -> None:
    for goal, clearance in (((0, -5), "1/2"), ((0, "8.4"), "0.05"), ([(0, -5), (5, 5, 0)], "0.3"), ((0, 5), "0.1")):
        path = plan(OPEN, START, goal, clearance=clearance)
        assert isinstance(path, Path) and path.clearance == Fraction(clearance)
        assert verified_in_a_file(OPEN, path).verified
        least = cfree.clearance(path, OPEN)
        assert least is not None and least.found >= float(path.clearance) * (1 - 1e-9)


@pytest.mark.slow
def test_no_path_to_a_place_keeps_a_clearance_is_proved_for_each_interval(tmp_path: FilePath) -> None:
    several = [(0, -5), (0, "-2.6"), (3, -5, 0)]
    for scene, goal, clearance, count in (
        (OPEN, (0, -5), "0.501", 1), (SHUT, (0, "-2.6"), "0.05", 2), (SHUT, several, "0.05", 4)
    ):  # fmt: skip
        proof = plan(scene, START, goal, clearance=clearance)
        assert isinstance(proof, AllSeparated) and proof.of == "closed" and len(proof.proofs) == count
        assert proof.clearance == Fraction(clearance)
        result = cfree.verify.answer(scene, proof)
        assert result.verified and result.proved.startswith(f"No path that keeps {float(proof.clearance):g} from")
        save(proof, tmp_path / "proof.json")
        assert load(tmp_path / "proof.json") == proof
        assert cfree.verify.answer(scene, tmp_path / "proof.json").verified
        for one in proof.proofs:
            assert verified_in_a_file(scene, one).verified


@pytest.mark.slow
def test_proofs_for_a_place_and_a_clearance_that_lack_something_are_refuted() -> None:
    proof = plan(SHUT, START, (0, "-2.6"), clearance="0.05")
    assert isinstance(proof, AllSeparated)
    for k in (0, 1):
        result = cfree.verify.answer(SHUT, replace(proof, proofs=(proof.proofs[k],)))
        assert not result.verified and "no proof for 1 interval " in str(result.findings[0])
    first, other = proof.proofs
    finer = plan(SHUT, START, (0, "-2.6"), clearance="0.06")
    assert isinstance(finer, AllSeparated)
    mixed = cfree.verify.answer(SHUT, replace(proof, proofs=(first, finer.proofs[1])))
    assert "the smaller robots of its proofs differ" in str(mixed.findings[-1])
    # a clearance so small that the robot, a little larger, is not nearer than that
    less = [replace(one, clearance=one.clearance * (1 - Fraction(1, 2**20))) for one in (first, other)]
    assert not cfree.verify.answer(SHUT, replace(proof, proofs=tuple(less))).verified


@pytest.mark.slow
def test_where_only_the_clearance_keeps_the_robot_from_turning_round_each_side_needs_a_proof() -> None:
    place = Fraction(0), Fraction("-3.1")
    assert [interval.start for interval in cfree.turn_in_place(SHUT, Pose(*place))] == [None], "it can turn round there"
    proof = plan(SHUT, START, place, clearance="0.1")
    assert isinstance(proof, AllSeparated) and len(proof.proofs) == 8, "each of its corners by itself, both ways"
    assert cfree.verify.answer(SHUT, proof).verified
    for k in (0, 3, 7):
        lacking = replace(proof, proofs=(*proof.proofs[:k], *proof.proofs[k + 1 :]))
        assert "no proof for 1 interval " in str(cfree.verify.answer(SHUT, lacking).findings[0])


def keeps(scene: Scene, start: Pose, place: Any, clearance: Fraction, count: int) -> set[str]:
    """The oracle: what planning to many orientations at a place says, one by one."""
    said = set()
    for k in range(count):
        try:
            found = plan(scene, start, Pose(*place, f"{Fraction(360 * k, count)}deg"), clearance=clearance, improve=0)
        except InvalidPoseError:
            continue
        except UndecidedError:
            said.add("undecided")
        else:
            said.add(type(found).__name__)
    return said


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_a_place_is_reached_if_one_of_many_orientations_there_is(kind: str) -> None:
    rng, decided = random.Random(kind), 0
    for seed in range(20):
        drawn = scene_of(random_scene(seed, kind))
        x0, y0, x1, y1 = around([o.bounds for o in drawn.obstacles])
        room = box(*(round(c) for c in (x0 - 2, y0 - 2, x1 + 2, y1 + 2)))[0]
        scene = Scene(drawn.robot, drawn.obstacles, workspace=room)
        for _ in range(3 if decided < 3 else 0):
            places = [(rng.uniform(x0 - 2, x1 + 2), rng.uniform(y0 - 2, y1 + 2)) for _ in range(2)]
            start, clearance = Pose(*places[0], rng.uniform(0, 6)), Fraction(rng.randint(1, 40), 100)
            try:
                found = plan(scene, start, places[1], clearance=clearance, improve=0)
            except InvalidPoseError as error:
                if "however it is turned" in str(error):
                    assert not keeps(scene, start, places[1], clearance, 24)
                continue
            except UndecidedError:
                continue
            said = keeps(scene, start, places[1], clearance, 24)
            decided += 1
            if isinstance(found, Path):
                assert cfree.verify.answer(scene, found).verified
            else:
                assert said <= {"Separated", "undecided"}, (kind, seed, places, clearance)
                assert cfree.verify.answer(scene, found).verified
            if "Path" in said:
                assert isinstance(found, Path)
    assert decided
