"""Proofs by cells where shapes have concave arcs: found, saved, checked by other code, and never of joined poses."""

from __future__ import annotations

import json
import random
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction as F
from pathlib import Path as FilePath
from typing import Any

import pytest

import cfree
import cfree.verify
from answer_mutations import (
    change_a_chart,
    change_a_contact,
    drop_a_piece,
    drop_an_arc,
    enlarge_an_arc,
    grow_a_core,
    move_a_center,
    mutants,
    repeat_a_piece,
    swap_from_and_to,
    swap_lower_and_upper,
    take_a_curve_of_another,
    take_an_angle_of_another,
)
from answers import text_of
from arc_rings import BAY, BRACKET, CONCAVE, plate, shape
from cfree import Curved, Pose, Scene
from cfree.planning.options import Options
from cfree.planning.rounded_cells import round_cells, separated_by_cells
from cfree.planning.smaller_shapes import smaller
from cfree.scene.rounded import rounded
from cfree.verify.round_inside import is_same, room
from round_cages import JAR, decided, random_hollow_cage

HAIR = F(1, 2**60)
ABOVE, BELOW = Pose(0, 10), Pose(0, 0)


def square(half: F) -> list[Any]:
    return [(-half, -half), (half, -half), (half, half), (-half, half)]


ROBOTS = {
    "disc": lambda by: Curved.circle((0, 0), 3 + by),
    "disc beside its place": lambda by: Curved.circle(("1/3", 0), 3 + by),
    "rounded square": lambda by: Curved(square(F(2)), grown=1 + by),
    "square": lambda by: square(3 + by),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_too_large_for_the_mouth_of_a_jar_by_a_hair_has_a_proof(name: str, tmp_path: FilePath) -> None:
    """The mouth is 6 wide, the round hole below it 10."""
    for excess in (HAIR, F(0), -HAIR):
        scene = Scene(ROBOTS[name](excess), [shape(JAR)])
        answer = cfree.plan(scene, ABOVE, BELOW)
        assert isinstance(answer, cfree.Path) == (excess <= 0)
        assert cfree.verify.answer(scene, answer).verified
        proof = separated_by_cells(scene, ABOVE, BELOW, Options())
        if excess < 0 or name == "disc":
            assert (proof is None) == (excess <= 0)
        if proof is None:
            continue
        assert proof.rounded is not None and proof.rounded.has_concave
        cfree.save(proof, tmp_path / "proof.json")
        assert cfree.load(tmp_path / "proof.json") == proof
        result = cfree.verify.answer(scene, str(tmp_path / "proof.json"))
        assert result.verified and "not even one that touches" in result.proved
        wider = Scene(ROBOTS[name](-HAIR), [shape(JAR)])
        assert not cfree.verify.answer(wider, proof).verified


@pytest.mark.slow
def test_a_disc_in_a_bay_whose_mouth_a_bar_narrows() -> None:
    for excess in (F(1, 8), HAIR, F(0), -HAIR):
        bar = [(-1 + excess, 3), (5, 3), (5, 4), (-1 + excess, 4)]  # leaves 2 of the mouth, from -3 to -1
        scene = Scene(Curved.circle((0, 0), 1), [shape(BAY), bar])
        ends = Pose(0, "3/2"), Pose(0, 8)
        assert (separated_by_cells(scene, *ends, Options()) is None) == (excess >= 0)
        if excess in (F(1, 8), -HAIR):
            answer = cfree.plan(scene, *ends)
            assert isinstance(answer, cfree.Path) == (excess > 0)
            assert cfree.verify.answer(scene, answer).verified


@pytest.mark.slow
def test_a_clearance_too_large_for_the_mouth_by_a_hair_has_a_proof() -> None:
    for excess in (HAIR, -HAIR):
        scene = Scene(Curved.circle((0, 0), 2), [shape(JAR)])
        answer = cfree.plan(scene, ABOVE, BELOW, clearance=1 + excess)
        assert isinstance(answer, cfree.Path) == (excess < 0) and answer.clearance == 1 + excess
        assert cfree.verify.answer(scene, answer).verified


@pytest.mark.slow
def test_obstacles_become_smaller_if_the_robot_has_concave_arcs() -> None:
    """A bracket holds a pin that is too large, by a hair, for the gap between its ends and a second pin's room."""
    for excess in (HAIR, -HAIR):
        pin = Curved.circle((0, 0), 3 + excess)
        scene = Scene(shape(JAR), [pin])
        start, goal = Pose(0, 0), Pose(0, -20)
        answer = cfree.plan(scene, start, goal)
        assert isinstance(answer, cfree.Path) == (excess < 0)
        assert cfree.verify.answer(scene, answer).verified
        if isinstance(answer, cfree.Separated):
            assert answer.rounded is not None and answer.rounded.obstacles[0].radius < 3 + excess


def test_cells_are_left_out_if_no_side_can_be_smaller() -> None:
    """Both have concave arcs; or the robot has them in a workspace. A disc around a core makes it smaller."""
    both = Scene(shape(BRACKET), [shape(BAY, 20)])
    room_of = [(-20, -20), (20, -20), (20, 20), (-20, 20)]
    for scene in (both, Scene(shape(BRACKET), [], workspace=room_of)):
        assert round_cells(scene, Options()) is None
    core = rounded(shape(BRACKET))
    assert core is not None and smaller([core], F(1, 8)) is None
    assert smaller([replace(core, radius=F(1))], F(1, 8)) == (replace(core, radius=F(7, 8)),)
    assert round_cells(both, Options(clearance=F(1, 8))) is not None


@pytest.mark.parametrize("name", [*CONCAVE, "plate"])
def test_a_core_with_concave_arcs_is_its_shape_and_in_no_other_by_a_hair(name: str) -> None:
    def made(x: Any = 0, by: Any = 1) -> Curved:
        return plate(x, 0, 5 * F(by), 3 * F(by)) if name == "plate" else shape(CONCAVE[name], x, 0, by)

    core = rounded(made())
    assert core is not None and core.has_concave
    assert is_same(core, made()) and room(core, made()) == 0
    for other in (made(HAIR), made(0, 1 - HAIR)):
        assert room(core, other) is None and not is_same(core, other)
    assert not is_same(core, made(0, 1 + HAIR))
    k = next(k for k, arc in enumerate(core.arcs) if arc.beyond)
    without = replace(core, arcs=(*core.arcs[:k], *core.arcs[k + 1 :]))
    assert not is_same(without, made()), "it has the vertex beyond the arc"
    assert room(replace(core, radius=HAIR), made()) is None


# --- against floods of slices ---


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("seed", range(5))
def test_proofs_in_random_hollow_cages_are_given_where_a_flood_finds_no_way(seed: int) -> None:
    scene = random_hollow_cage(seed)
    cells = round_cells(scene, Options(), 10**7)
    assert cells is not None
    for start, goal, is_joined in decided(scene, 6, seed):
        proof = cells.proof(start, goal)
        assert (proof is None) == is_joined
        assert proof is None or cfree.verify.answer(scene, proof).verified


# --- answers that were changed ---


def proof_of_jar(robot: Any) -> tuple[Scene, Any]:
    scene = Scene(robot, [shape(JAR)])
    proof = separated_by_cells(scene, ABOVE, BELOW, Options())
    assert proof is not None and proof.rounded is not None
    return scene, proof


MUTATIONS = (
    drop_a_piece, repeat_a_piece, change_a_contact, change_a_chart, take_an_angle_of_another, swap_from_and_to,
    swap_lower_and_upper, take_a_curve_of_another, drop_an_arc, move_a_center, enlarge_an_arc, grow_a_core,
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("mutate", MUTATIONS, ids=lambda f: f.__name__)
def test_changed_proofs_with_concave_arcs_are_refused(mutate: Any, tmp_path: FilePath) -> None:
    rng = random.Random(mutate.__name__)
    for name in ("disc beside its place", "rounded square"):
        scene, proof = proof_of_jar(ROBOTS[name](HAIR))
        for bad in mutants(rng, proof, mutate, 4):
            (tmp_path / "bad.json").write_text(json.dumps(bad))
            with suppress(cfree.FormatError):
                assert not cfree.verify.answer(scene, tmp_path / "bad.json").verified, bad


def test_a_concave_arc_in_a_file_has_to_be_one(tmp_path: FilePath) -> None:
    _, proof = proof_of_jar(Curved.circle((0, 0), 3 + HAIR))
    data = json.loads(text_of(proof))
    arcs = data["rounded"]["obstacles"][0]["arcs"]
    for name, value, text in (
        ("start", arcs[0]["end"], "expected an arc of a radius above 0, clockwise"),
        ("radius", "-5", "expected an arc of a radius above 0, clockwise"),
        ("beyond", None, "expected an arc of a radius above 0, counter-clockwise"),
        ("beyond", [["9", "9"], ["10", "10"]], "from each a vertex to the next one, past that of"),
        ("beyond", [["9", "9"]], "beyond"),
    ):
        wrong = json.loads(json.dumps(data))
        wrong["rounded"]["obstacles"][0]["arcs"][0][name] = value
        (tmp_path / "wrong.json").write_text(json.dumps(wrong))
        with pytest.raises(cfree.FormatError, match=text):
            cfree.load(tmp_path / "wrong.json")


def test_a_proof_with_another_concave_arc_is_refuted() -> None:
    scene, proof = proof_of_jar(Curved.circle((0, 0), 3 + HAIR))
    (jar,) = proof.rounded.obstacles
    shallow = rounded(shape(JAR, by=1 - HAIR))
    for wrong in (replace(jar, arcs=jar.arcs[1:]), replace(jar, radius=HAIR), shallow):
        cores = replace(proof.rounded, obstacles=(wrong,))
        assert not cfree.verify.answer(scene, replace(proof, rounded=cores)).verified
