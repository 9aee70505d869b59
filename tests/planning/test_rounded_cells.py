"""Proofs by cells among rounded shapes: found where polygons cannot decide, saved, and checked by other code."""

from __future__ import annotations

from fractions import Fraction as F
from pathlib import Path as FilePath
from typing import Any

import pytest

import cfree
import cfree.verify
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
