"""Proofs by cells where concave arcs face convex ones that are no whole discs."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

import cfree
import cfree.verify
from arc_rings import DROP, shape
from cfree import Pose, Scene
from cfree.planning.options import Options
from cfree.planning.rounded_cells import separated_by_cells
from round_cages import JAR, decided, random_facing_cage

HAIR = Fraction(1, 2**60)
LEAST_WIDTH = Fraction(49, 5)  # of a drop: from its arc to a line on the other side, across the center
ABOVE, BELOW = Pose(0, 10), Pose(0, 0)


@pytest.mark.slow
def test_a_drop_too_wide_for_the_mouth_of_a_jar_by_a_hair_has_a_proof(tmp_path: Path) -> None:
    """The mouth is 6 wide, the round hole below it 10."""
    narrow, wide = (Scene(shape(DROP, by=(6 + by) / LEAST_WIDTH), [shape(JAR)]) for by in (-HAIR, HAIR))
    assert separated_by_cells(narrow, ABOVE, BELOW, Options()) is None
    proof = separated_by_cells(wide, ABOVE, BELOW, Options())
    assert proof is not None and proof.rounded is not None and proof.rounded.has_concave
    cfree.save(proof, tmp_path / "proof.json")
    assert cfree.load(tmp_path / "proof.json") == proof
    assert cfree.verify.answer(wide, proof).verified
    assert not cfree.verify.answer(narrow, proof).verified


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0])
def test_proofs_in_random_cages_of_facing_arcs_agree_with_floods(seed: int) -> None:
    scene = random_facing_cage(seed)
    for start, goal, is_joined in decided(scene, 2, seed):
        proof = separated_by_cells(scene, start, goal, Options())
        assert proof is None or not is_joined
        if proof is not None:
            assert cfree.verify.answer(scene, proof).verified
