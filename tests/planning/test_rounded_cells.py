"""Proofs by cells among rounded shapes: found where polygons cannot decide, saved, and checked by other code."""

from __future__ import annotations

from fractions import Fraction as F
from pathlib import Path as FilePath
from typing import Any

import pytest

import cfree
import cfree.verify
from arc_rings import shape
from cfree import Curved, Pose, Scene
from cfree.planning.options import Options
from cfree.planning.rounded_cells import separated_by_cells

HAIR = F(1, 2**60)
WALLS = [
    [(-9, 1), (F(-1, 2), 1), (F(-1, 2), 3), (-9, 3)],
    [(F(1, 2), 1), (9, 1), (9, 3), (F(1, 2), 3)],
    [(-9, 8), (9, 8), (9, 9), (-9, 9)],
    [(-10, 1), (-9, 1), (-9, 9), (-10, 9)],
    [(9, 1), (10, 1), (10, 9), (9, 9)],
]
PEG = [(-1, F(-1, 4)), (1, F(-1, 4)), (1, F(1, 4)), (-1, F(1, 4))]
OUTSIDE, INSIDE = Pose(0, -3), Pose(0, F(11, 2), {"tau": 1})


def rooms(robot: Any, gap: F = F(1, 2)) -> tuple[Scene, Pose, Pose]:
    """Two rooms, with discs on both sides of a gap."""
    discs = [Curved.circle((0, y), 1) for y in (gap + 1, -gap - 1)]
    walls = [[(-1, 1 + gap), (1, 1 + gap), (1, 9), (-1, 9)], [(-1, -9), (1, -9), (1, -1 - gap), (-1, -1 - gap)]]
    rim = [[(-9, 9), (9, 9), (9, 10), (-9, 10)], [(-9, -10), (9, -10), (9, -9), (-9, -9)]]
    sides = [[(9, -10), (10, -10), (10, 10), (9, 10)], [(-10, -10), (-9, -10), (-9, 10), (-10, 10)]]
    return Scene(robot, [*discs, *walls, *rim, *sides]), Pose(-5, 0), Pose(5, 0)


def test_a_disc_too_large_for_a_gap_by_a_hair_has_a_proof_and_one_that_fits_has_a_path() -> None:
    for excess in (HAIR, F(0), -HAIR):
        scene, start, goal = rooms(Curved.circle((0, 0), F(1, 2) + excess))
        answer = cfree.plan(scene, start, goal)
        assert isinstance(answer, cfree.Path) == (excess <= 0)
        assert cfree.verify.answer(scene, answer).verified


def test_a_peg_too_wide_for_its_slot_by_a_hair_has_a_proof(tmp_path: FilePath) -> None:
    scene = Scene(Curved(PEG, grown=F(1, 4) + HAIR), WALLS, start=OUTSIDE, goal=INSIDE)
    proof = cfree.plan(scene)
    assert isinstance(proof, cfree.Separated) and proof.rounded is not None and proof.curved == scene
    cfree.save(proof, tmp_path / "proof.json")
    read = cfree.load(tmp_path / "proof.json")
    assert read == proof
    result = cfree.verify.answer(scene, str(tmp_path / "proof.json"))
    assert result.verified and "not even one that touches" in result.proved


def test_a_clearance_too_large_by_a_hair_has_a_proof() -> None:
    scene = Scene(PEG, WALLS)
    for excess in (HAIR, F(0), -HAIR):
        answer = cfree.plan(scene, OUTSIDE, INSIDE, clearance=F(1, 4) + excess)
        assert isinstance(answer, cfree.Path) == (excess <= 0)
        assert answer.clearance == F(1, 4) + excess
        assert cfree.verify.answer(scene, answer).verified


def test_a_proof_is_not_one_of_a_scene_with_a_wider_gap() -> None:
    scene, start, goal = rooms(Curved.circle((0, 0), F(1, 2) + HAIR))
    proof = separated_by_cells(scene, start, goal, Options())
    assert proof is not None and cfree.verify.answer(scene, proof).verified
    wider, _, _ = rooms(Curved.circle((0, 0), F(1, 2) + HAIR), F(5, 8))
    assert not cfree.verify.answer(wider, proof).verified


def test_a_proof_with_a_larger_disc_or_a_piece_less_is_refuted() -> None:
    from dataclasses import replace

    scene, start, goal = rooms(Curved.circle((0, 0), F(1, 2) + HAIR))
    proof = separated_by_cells(scene, start, goal, Options())
    assert proof is not None and proof.rounded is not None
    (disc,) = proof.rounded.robot
    larger = replace(proof.rounded, robot=(replace(disc, radius=F(1, 2) + HAIR),))
    assert not cfree.verify.answer(scene, replace(proof, rounded=larger)).verified
    pieces, table = proof.pieces, proof.pieces.table
    fewer = replace(
        pieces,
        kind=pieces.kind[1:],
        robot=pieces.robot[1:],
        obstacle=pieces.obstacle[1:],
        table=type(table)(**{name: getattr(table, name)[1:] for name in table.__dataclass_fields__}),
    )
    assert not cfree.verify.answer(scene, replace(proof, pieces=fewer)).verified


@pytest.mark.parametrize("far", [F(0), F(10**9)])
def test_cells_and_searches_agree_in_random_rooms(far: F) -> None:
    """A proof is given exactly if the disc is wider than the widest gap."""
    for k, (gap, radius) in enumerate([(F(1, 3), F(1, 4)), (F(1, 3), F(2, 5)), (F(2, 7), F(2, 7)), (F(3, 7), F(1, 2))]):
        scene, start, goal = rooms(Curved.circle((far, F(k)), radius), gap)
        start, goal = (Pose(pose.x - far, pose.y - k) for pose in (start, goal))
        proof = separated_by_cells(scene, start, goal, Options())
        assert (proof is None) == (radius <= gap)
        assert proof is None or cfree.verify.answer(scene, proof).verified


TRIANGLE = [(0, 0), (2, 0), (0, 1)]
ROOM = [(0, 0), (10, 0), (10, 10), (0, 10)]


def under_a_wall(robot: Any, thickness: F, **region: Any) -> Scene:
    """A wall that leaves a gap above the bounds, or the workspace."""
    return Scene(robot, [Curved([(4, 2), (5, 2), (5, 15), (4, 15)], grown=thickness)], **region)


@pytest.mark.slow
@pytest.mark.parametrize("excess", [HAIR, F(0), -HAIR])
@pytest.mark.parametrize("name", ["a disc above bounds", "a triangle above bounds", "a disc above a workspace"])
def test_a_gap_at_bounds_or_a_workspace_has_a_proof_or_a_path(name: str, excess: F, tmp_path: FilePath) -> None:
    start, goal = Pose(1, 3), Pose(9, 5)
    if name == "a disc above bounds":
        scene = under_a_wall(Curved.circle((0, 0), 1), 1 + excess, bounds=(0, 0, 10, 10))
    elif name == "a triangle above bounds":
        start = Pose(0, 5, {"tau": -2})
        scene = under_a_wall(Curved(TRIANGLE, grown="1/2"), F(3, 2) + excess, bounds=(0, 0, 10, 10))
    else:
        scene, start, goal = (
            under_a_wall(Curved.circle((0, 0), "1/2"), 1 + excess, workspace=ROOM),
            Pose(1, 3),
            Pose(9, 5),
        )
    answer = cfree.plan(scene, start, goal)
    assert isinstance(answer, cfree.Path) == (excess <= 0)
    assert cfree.verify.answer(scene, answer).verified
    if isinstance(answer, cfree.Separated) and scene.bounds:
        assert answer.bounds is not None and all(
            a < b for a, b in zip(answer.bounds, scene.bounds[:2], strict=False)
        ), "they are larger than the scene's"
        cfree.save(answer, tmp_path / "proof.json")
        assert cfree.load(tmp_path / "proof.json") == answer
        assert cfree.verify.answer(scene, str(tmp_path / "proof.json")).verified
        from dataclasses import replace

        for wrong in (scene.bounds, None):
            assert not cfree.verify.answer(scene, replace(answer, bounds=wrong)).verified


def test_several_goals_have_a_proof_each_and_a_disc_has_one_for_a_place() -> None:
    scene = under_a_wall(Curved.circle((0, 0), "1/2"), 1 + HAIR, workspace=ROOM)
    start, goals = Pose(1, 3), [Pose(9, 5), Pose(8, 6, {"tau": 1}), (8, 3)]
    answer = cfree.plan(scene, start, goals)
    assert isinstance(answer, cfree.AllSeparated) and answer.of == "closed" and len(answer.proofs) == 3
    assert cfree.verify.answer(scene, answer).verified
    one = cfree.plan(scene, start, goals[:1])
    assert isinstance(one, cfree.AllSeparated) and cfree.verify.answer(scene, one).verified
    beside = cfree.plan(scene, start, [*goals, Pose(2, 5)])
    assert isinstance(beside, cfree.Path) and beside.goal == Pose(2, 5)


def test_a_proof_by_cells_at_a_place_is_none_for_a_robot_that_turns() -> None:
    """The proof is about one orientation; verify refuses it for the others."""
    from cfree.planning.goals import all_separated

    scene = under_a_wall(Curved(TRIANGLE, grown="1/2"), F(2), bounds=(0, 0, 10, 10))
    proof = separated_by_cells(scene, Pose(0, 5, {"tau": -2}), Pose(9, 5), Options())
    assert proof is not None
    all_ = all_separated([proof], [(F(9), F(5))], is_whole=True)
    result = cfree.verify.answer(scene, all_)
    assert not result.verified and "turns there" in str(result.findings)


def test_discs_smaller_by_more_digits_than_the_scene_has_prove_a_finer_miss() -> None:
    fine = F(1, 2**200)
    scene, start, goal = rooms(Curved.circle((0, 0), F(1, 2) + fine))
    proof = separated_by_cells(scene, start, goal, Options())
    assert proof is not None and cfree.verify.answer(scene, proof).verified
    narrower, _, _ = rooms(Curved.circle((0, 0), F(1, 2) - fine))
    assert separated_by_cells(narrower, start, goal, Options()) is None


def test_a_fault_of_the_core_leaves_other_ways(monkeypatch: pytest.MonkeyPatch) -> None:
    import cfree._core as core

    def fails(*_: object) -> None:
        raise RuntimeError("no ray in general position")

    scene, start, goal = rooms(Curved.circle((0, 0), F(1, 2) + HAIR))
    monkeypatch.setattr(core, "free_space", fails)
    assert separated_by_cells(scene, start, goal, Options()) is None
    with pytest.raises(cfree.UndecidedError):
        cfree.plan(scene, start, goal)


def test_shapes_that_cannot_be_smaller_have_no_cells() -> None:
    from cfree.planning.rounded_cells import round_cells

    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    room = [(-9, -9), (9, -9), (9, 9), (-9, 9)]
    horseshoe = shape([(0, 0), (6, 0), (6, 4, (5, 4)), (4, 4), (4, 2), (2, 2), (2, 4, (1, 4)), (0, 4)], -8)
    disc = Curved.circle((4, 0), 1)
    for scene in (
        Scene(square, [], bounds=(-9, -9, 9, 9)),
        Scene(square, [square]),
        Scene(horseshoe, [disc], workspace=room),
        Scene(horseshoe, [disc, horseshoe]),
        Scene(square, [Curved.ellipse((4, 0), (1, 2))]),
    ):
        assert round_cells(scene, Options()) is None
    for scene in (
        Scene(square, [disc, square]),
        Scene(horseshoe, [disc]),
        Scene(square, [disc], workspace=room),
        Scene(disc, [], bounds=(-9, -9, 9, 9)),
    ):
        assert round_cells(scene, Options()) is not None


def test_cells_are_not_computed_where_they_take_long() -> None:
    from cfree.planning.rounded_cells import WORK, round_cells, work_for
    from cfree.scene.features import grown_features

    few, _, _ = rooms(Curved.circle((0, 0), F(1, 2)))
    assert 0 < work_for(grown_features(few)) < WORK
    many = Scene(Curved.circle((0, 0), "1/4"), [Curved.circle((k, j), "1/4") for k in range(60) for j in range(60)])
    assert work_for(grown_features(many)) > WORK and round_cells(many, Options()) is None


def test_blockers_of_a_proof_by_cells_are_numbered_as_in_the_scene(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only proofs of polygons inside the shapes number polygons."""
    from cfree.analysis.blockers import _possible
    from cfree.planning.curved import CurvedPlanner
    from cfree.planning.planner import Planner

    scene, start, goal = rooms(Curved.circle((0, 0), F(1, 2) + HAIR))
    planner = CurvedPlanner(Planner(scene))
    proof = planner.plan(start, goal)
    assert isinstance(proof, cfree.Separated) and proof.rounded is not None
    monkeypatch.setattr(CurvedPlanner, "obstacle_of", lambda *_: 0)
    assert _possible(planner, proof, range(len(scene.obstacles))) == set(proof.obstacles)
