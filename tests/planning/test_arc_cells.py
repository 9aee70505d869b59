"""Proofs by cells where sides are arcs or the robot's parts have several radii: found, saved, checked by other code."""

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
    drop_all_pieces,
    drop_an_arc,
    enlarge_an_arc,
    grow_a_core,
    move_a_center,
    move_an_end,
    mutants,
    repeat_a_piece,
    swap_from_and_to,
    swap_lower_and_upper,
    take_a_curve_of_another,
    take_an_angle_of_another,
)
from answers import text_of
from arc_rings import RINGS, random_arcs, shape
from cfree import Curved, Pose, Scene
from cfree.curves.similar import moved_shape
from cfree.planning.options import Options
from cfree.planning.rounded_cells import round_cells, separated_by_cells
from cfree.planning.smaller_shapes import smaller
from cfree.polygons.polygon import Polygon
from cfree.scene.grown_cores import Cores, Rounded
from cfree.scene.rounded import rounded
from cfree.verify.round_answers import surface_of
from cfree.verify.round_inside import is_same, room
from cfree.verify.round_separation import round_separation_findings
from round_cages import decided, random_cage

HAIR = F(1, 2**60)
LEVEL, SLANTED = Pose(0, 0), Pose("1/3", "-2/7", {"tau": "1/2"})
WIDTHS = {"half": 5, "dome": 2, "sector": 4, "lens": 4, "corners": 8, "hat": 8, "drop": F(49, 5)}  # least, of rings
MIDDLES: dict[str, tuple[Any, Any]] = {"half": (0, F(5, 2)), "dome": (0, 4), "sector": (3, 2), "corners": (5, 4)}


def rooms(robot: Any, at: Pose = LEVEL, start: Any = (-6, 0), goal: Any = (6, 0)) -> tuple[Scene, Pose, Pose]:
    """Two rooms joined by a gap between two discs, as wide as 1; the whole scene is moved."""
    shapes: list[Any] = [Curved.circle((0, y), 1) for y in (F(3, 2), F(-3, 2))]
    shapes += [[(-1, F(3, 2)), (1, F(3, 2)), (1, 9), (-1, 9)], [(-1, -9), (1, -9), (1, F(-3, 2)), (-1, F(-3, 2))]]
    shapes += [[(-9, y), (9, y), (9, y + 1), (-9, y + 1)] for y in (9, -10)]
    shapes += [[(x, -10), (x + 1, -10), (x + 1, 10), (x, 10)] for x in (-10, 9)]
    obstacles = [moved_shape(Scene(robot, [one]).obstacles[0], at) for one in shapes]
    (c, s, w) = at.rotation
    ends = [Pose(at.x + (c * x - s * y) / w, at.y + (s * x + c * y) / w, {"tau": at.tau}) for x, y in (start, goal)]
    return Scene(robot, obstacles), ends[0], ends[1]


def ring_of_width(name: str, width: F) -> Curved:
    by = width / WIDTHS[name]
    x, y = MIDDLES.get(name, (0, 0))
    return shape(RINGS[name], -by * x, -by * y, by)


# --- gaps that are open or closed by a hair ---


@pytest.mark.slow
@pytest.mark.parametrize("at", [LEVEL, SLANTED], ids=["level", "slanted"])
@pytest.mark.parametrize("name", WIDTHS)
def test_a_shape_with_arcs_too_wide_for_a_gap_by_a_hair_has_a_proof(name: str, at: Pose, tmp_path: FilePath) -> None:
    scene, start, goal = rooms(ring_of_width(name, 1 + HAIR), at)
    proof = separated_by_cells(scene, start, goal, Options())
    assert proof is not None and proof.rounded is not None and proof.curved == scene
    cfree.save(proof, tmp_path / "proof.json")
    assert cfree.load(tmp_path / "proof.json") == proof
    result = cfree.verify.answer(scene, str(tmp_path / "proof.json"))
    assert result.verified and "not even one that touches" in result.proved
    narrower, start, goal = rooms(ring_of_width(name, F(1) if at is LEVEL else 1 - HAIR), at)
    assert separated_by_cells(narrower, start, goal, Options()) is None
    assert not cfree.verify.answer(narrower, proof).verified


@pytest.mark.slow
@pytest.mark.parametrize("power", [5, 20, 60, 90])
@pytest.mark.parametrize("name", ["half", "sector"])
def test_plans_of_shapes_with_arcs_are_decided_on_both_sides_of_an_exact_fit(name: str, power: int) -> None:
    for excess in (F(1, 2**power), F(0), -F(1, 2**power)):
        scene, start, goal = rooms(ring_of_width(name, 1 + excess))
        answer = cfree.plan(scene, start, goal)
        assert isinstance(answer, cfree.Path) == (excess <= 0)
        assert cfree.verify.answer(scene, answer).verified


def car(excess: F) -> list[Any]:
    """A body with a round bumper as wide as 1."""
    half = F(1, 2) + excess
    body = [(-1, -half), (0, -half), (0, half), (-1, half)]
    return [body, shape([(0, -1, (0, 0)), (0, 1)], by=half)]


@pytest.mark.slow
@pytest.mark.parametrize("at", [LEVEL, SLANTED], ids=["level", "slanted"])
def test_a_robot_whose_parts_have_several_radii_has_a_proof_or_a_path(at: Pose) -> None:
    robots: list[Any] = [lambda by: [Curved.circle((0, 0), F(1, 2) + by), Curved.circle((1, 0), F(1, 3))]]
    for parts in robots + [car] * (at is LEVEL):  # the car takes too long for cells where it is slanted
        for excess in (HAIR, -HAIR):
            scene, start, goal = rooms(parts(excess), at)
            answer = cfree.plan(scene, start, goal)
            assert isinstance(answer, cfree.Path) == (excess < 0)
            assert cfree.verify.answer(scene, answer).verified


@pytest.mark.slow
def test_a_clearance_of_a_shape_with_arcs_too_large_by_a_hair_has_a_proof() -> None:
    for excess in (HAIR, -HAIR):
        scene, start, goal = rooms(ring_of_width("half", F(1, 2)))
        answer = cfree.plan(scene, start, goal, clearance=F(1, 4) + excess)
        assert isinstance(answer, cfree.Path) == (excess < 0) and answer.clearance == F(1, 4) + excess
        assert cfree.verify.answer(scene, answer).verified


@pytest.mark.slow
@pytest.mark.parametrize("excess", [HAIR, F(0), -HAIR])
def test_a_triangle_in_a_cage_of_discs_of_several_radii(excess: F) -> None:
    """Pairs of discs of radii 1, 2 and 3 leave gaps of one half; the triangle's least height is as large."""
    centers = [(F(0), F(0), 1), (F(7, 2), F(0), 2), (F(7, 2), F(11, 2), 3), (F(-1), F(11, 2), 1)]
    cage = [Curved.circle((x, y), r) for x, y, r in centers]
    cage += [[(-3, -1), (0, -1), (0, F(11, 2)), (-3, F(11, 2))]]
    height = F(1, 2) + excess
    scene = Scene([(-height, 0), (height, 0), (0, height)], cage, bounds=(-20, -20, 20, 20))
    start, goal = Pose(1, 3), Pose(F(7, 4), -5)
    answer = cfree.plan(scene, start, goal)
    assert isinstance(answer, cfree.Path) == (excess <= 0)
    assert cfree.verify.answer(scene, answer).verified


@pytest.mark.slow
def test_angles_closer_than_doubles_leave_a_proof_that_other_code_checks() -> None:
    scene, start, goal = rooms([*car(HAIR), Curved.circle((-1, 0), F(1, 4))])
    proof = separated_by_cells(scene, start, goal, Options())
    assert proof is not None and cfree.verify.answer(scene, proof).verified


@pytest.mark.slow
def test_several_goals_have_a_proof_each() -> None:
    scene, start, goal = rooms(car(HAIR))
    answer = cfree.plan(scene, start, [goal, Pose(5, 3, {"tau": 1})])
    assert isinstance(answer, cfree.AllSeparated) and answer.of == "closed"
    assert cfree.verify.answer(scene, answer).verified


def test_queries_in_one_scene_share_its_cells(monkeypatch: pytest.MonkeyPatch) -> None:
    import cfree._core as core

    scene, start, goal = rooms([Curved.circle((0, 0), F(1, 2) + HAIR), Curved.circle((1, 0), F(1, 3))])
    made, compute = list[Any](), core.compute_boundary
    monkeypatch.setattr(core, "compute_boundary", lambda *given: made.append(1) or compute(*given))
    first = separated_by_cells(scene, start, goal, Options())
    second = separated_by_cells(scene, goal, start, Options())
    assert first is not None and second is not None and first.rounded is second.rounded
    assert made == [1]
    assert separated_by_cells(scene, start, goal, Options(clearance=F(1, 100))) is not None
    assert made == [1, 1], "a clearance has cells of its own"


# --- against floods of slices ---


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 4, 5, 95])  # of the last one some angles are closer than doubles
def test_proofs_in_random_cages_are_given_where_a_flood_finds_no_way(seed: int) -> None:
    scene = random_cage(seed)
    cells, number = round_cells(scene, Options(), 10**7), 0
    assert cells is not None
    for start, goal, is_joined in decided(scene, 6, seed):
        proof = cells.proof(start, goal)
        assert (proof is None) == is_joined
        number += 1
        assert proof is None or cfree.verify.answer(scene, proof).verified
    assert number


# --- smaller shapes ---


@pytest.mark.parametrize("seed", range(12))
def test_smaller_shapes_are_strictly_inside_by_other_code(seed: int) -> None:
    scene, by = random_arcs(seed), F(1, 2 ** random.Random(seed).randint(2, 120))
    for part in (*scene.robot, *scene.obstacles):
        core = rounded(part)
        assert core is not None and is_same(core, part) and room(core, part) == 0
        less = smaller([core], by)
        assert less is not None
        inside = room(less[0], part)
        assert inside is not None and 0 < inside < 9 * by


@pytest.mark.parametrize("name", RINGS)
def test_a_shape_that_is_larger_or_moved_by_a_hair_is_not_inside(name: str) -> None:
    core = rounded(shape(RINGS[name]))
    assert core is not None
    for other in (shape(RINGS[name], HAIR), shape(RINGS[name], 0, -HAIR), shape(RINGS[name], by=1 - HAIR)):
        assert room(core, other) is None and not is_same(core, other)
    larger = replace(core, radius=HAIR)
    assert room(larger, shape(RINGS[name])) is None and not is_same(larger, shape(RINGS[name]))


def test_parts_are_scaled_about_one_point_if_all_are_seen_from_it() -> None:
    by = F(1, 2**10)
    parts = [core for core in map(rounded, (shape(RINGS["half"]), shape(RINGS["dome"]))) if core]
    one, other = smaller(parts, by) or ()
    assert {arc.center for arc in one.arcs} == {arc.center for arc in other.arcs}, "both arcs are about the origin"
    apart = [core for core in map(rounded, (shape(RINGS["half"]), shape(RINGS["dome"], 30))) if core]
    assert all(room(part, whole) for part, whole in zip(smaller(apart, by) or (), map(shape_of, apart), strict=True))


def shape_of(core: Rounded) -> Any:
    assert isinstance(core.core, Polygon)
    return shape(RINGS["half"]) if core.core.bounds[0] < 0 else shape(RINGS["dome"], 30)


def test_a_polygon_that_is_not_seen_from_one_point_has_its_edges_moved() -> None:
    horseshoe = Polygon([(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)])
    parts = smaller([Rounded(horseshoe, F(0))], F(1, 2**100))
    assert parts is not None
    inside = room(parts[0], horseshoe)
    assert inside is not None and 0 < inside < F(1, 2**98)


# --- answers that were changed ---


def proof_of_half() -> tuple[Scene, Any]:
    scene, start, goal = rooms(ring_of_width("half", 1 + HAIR))
    proof = separated_by_cells(scene, start, goal, Options())
    assert proof is not None and proof.rounded is not None
    return scene, proof


def with_robot(proof: Any, part: Rounded) -> Any:
    return replace(proof, rounded=Cores((part,), proof.rounded.obstacles))


@pytest.mark.slow
def test_a_proof_with_other_arcs_is_refuted() -> None:
    scene, proof = proof_of_half()
    (part,) = proof.rounded.robot
    first, second = part.arcs
    true = rounded(scene.robot[0])
    assert true is not None
    for wrong in (
        replace(part, arcs=(first,)),  # the other one has only its chord
        replace(part, arcs=()),
        replace(part, radius=HAIR),
        true,
        replace(part, arcs=(replace(first, radius=first.radius + HAIR), second)),
        replace(part, arcs=(replace(first, center=(first.center[0] + HAIR, first.center[1])), second)),
    ):
        assert not cfree.verify.answer(scene, with_robot(proof, wrong)).verified


@pytest.mark.slow
def test_a_contact_beyond_the_ends_of_an_arc_is_none() -> None:
    """The circle of an arc goes on beyond the shape; a disc in place of the half disc has contacts there."""
    scene, start, goal = rooms(Curved.circle((0, 0), F(3, 5)))
    disc = separated_by_cells(scene, start, goal, Options())
    half = Scene(shape(RINGS["half"], by=F(13, 100)), scene.obstacles)
    proof = separated_by_cells(rooms(shape(RINGS["half"], by=F(21, 100)))[0], start, goal, Options())
    assert disc is not None and proof is not None
    result = cfree.verify.answer(half, proof)
    assert not result.verified


@pytest.mark.slow
def test_a_file_with_an_arc_that_is_none_is_refused(tmp_path: FilePath) -> None:
    _, proof = proof_of_half()
    cfree.save(proof, tmp_path / "proof.json")
    data = json.loads((tmp_path / "proof.json").read_text())
    for name, value, text in (
        ("radius", "1/7", "expected an arc"),
        ("start", ["3", "4"], "expected an arc"),
        ("radius", "-1", "expected an arc"),
    ):
        wrong = json.loads(json.dumps(data))
        wrong["rounded"]["robot"][0]["arcs"][0][name] = value
        (tmp_path / "wrong.json").write_text(json.dumps(wrong))
        with pytest.raises(cfree.FormatError, match=text):
            cfree.load(tmp_path / "wrong.json")
    wrong = json.loads(json.dumps(data))
    wrong["rounded"]["robot"][0]["arcs"][0] = {
        "start": ["9", "0"],
        "end": ["0", "9"],
        "center": ["0", "0"],
        "radius": "9",
    }
    (tmp_path / "wrong.json").write_text(json.dumps(wrong))
    with pytest.raises(cfree.FormatError, match="from each a vertex to the next one"):
        cfree.load(tmp_path / "wrong.json")


@pytest.mark.slow
def test_contacts_beyond_the_ends_of_an_arc_are_found() -> None:
    """The sector's arc ends earlier than that of the proof: the circle about its center goes on."""
    scene, start, goal = rooms(ring_of_width("sector", 1 + HAIR))
    proof = separated_by_cells(scene, start, goal, Options())
    assert proof is not None and proof.rounded is not None
    (part,) = proof.rounded.robot
    (arc,) = part.arcs
    assert isinstance(part.core, Polygon)
    r = arc.radius
    end = arc.center[0] + F(4, 5) * r, arc.center[1] + F(3, 5) * r
    ring = [end if p == arc.end else p for p in part.core.exact_vertices]
    shorter = Rounded(Polygon(ring), F(0), (replace(arc, end=end),))
    assert room(shorter, scene.robot[0]), "it is inside the scene's robot"
    assert not cfree.verify.answer(scene, with_robot(proof, shorter)).verified
    true = surface_of(proof, proof.rounded, scene)
    assert true is not None and not list(round_separation_findings(true, scene))
    texts = {finding.text for finding in round_separation_findings(replace(true, robot=[shorter]), scene)}
    assert {"a curve is beyond an end of its patch", "a contact beyond the ends of its arc"} <= texts


MUTATIONS = (
    drop_a_piece, repeat_a_piece, drop_all_pieces, change_a_contact, change_a_chart, take_an_angle_of_another,
    swap_from_and_to, swap_lower_and_upper, take_a_curve_of_another, move_an_end,
    drop_an_arc, move_a_center, enlarge_an_arc, grow_a_core,
)  # fmt: skip


def is_renamed(good: Any, bad: Any) -> bool:
    """True if only an angle has another name."""
    pieces = [*zip(good["surface"], bad["surface"], strict=False)]
    changed = [(one, two) for one, two in pieces if one != two]
    if len(good["surface"]) != len(bad["surface"]) or len(changed) != 1:
        return False
    one, two = changed[0]
    ends = [abs(one[end]["tau"][0] - two[end]["tau"][0]) < 1e-9 for end in ("from", "to")]
    return all(ends) and all(one[key] == two[key] for key in ("contact", "chart", "lower", "upper"))


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("mutate", MUTATIONS, ids=lambda f: f.__name__)
def test_changed_answers_are_refused(mutate: Any, tmp_path: FilePath) -> None:
    rng = random.Random(mutate.__name__)
    for name in ("half", "sector"):
        scene, start, goal = rooms(ring_of_width(name, 1 + HAIR))
        proof = separated_by_cells(scene, start, goal, Options())
        assert proof is not None
        good = json.loads(text_of(proof))
        for bad in mutants(rng, proof, mutate, 4):
            if is_renamed(good, bad):
                continue
            (tmp_path / "bad.json").write_text(json.dumps(bad))
            with suppress(cfree.FormatError):
                assert not cfree.verify.answer(scene, tmp_path / "bad.json").verified, bad
