"""Answers among round shapes."""

import dataclasses
import json
import math
import random
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import cfree
import cfree.verify
from cfree import Pose
from cfree.curves import Arc
from cfree.verify.curves import mismatches
from fuzz_curves import fault
from round_shapes import Sampled


def pillars(count: int, far: float, radius: object) -> list[cfree.Curved]:
    """Around the origin."""
    turns = [math.tau * k / count for k in range(count)]
    return [cfree.Curved.circle((round(far * math.cos(t), 6), round(far * math.sin(t), 6)), radius) for t in turns]  # type: ignore[arg-type]


def caged(gap: float) -> cfree.Scene:
    """A disc among five pillars, the gap between two of them wider than the disc by so much, or less wide."""
    radius = round((4 * math.sin(math.pi / 5) - 1 - gap) / 2, 9)
    start, goal = (0, 0, 0), (8, 8, "30deg")
    return cfree.Scene(cfree.Curved.circle((0, 0), "1/2"), pillars(5, 2, radius), start=start, goal=goal)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(5))
def test_random_scenes(seed: int) -> None:
    assert fault(seed)[1] == ""


@pytest.mark.slow
@pytest.mark.parametrize("gap", [0.3, 0.05, 0.01, 0.002])
def test_a_disc_gets_through_a_gap_that_is_wide_enough(gap: float) -> None:
    scene = caged(gap)
    path = cfree.plan(scene, improve=0.0)
    assert isinstance(path, cfree.Path) and path.curved is scene and cfree.verify.answer(scene, path).verified


@pytest.mark.slow
@pytest.mark.parametrize("gap", [-0.3, -0.01])
def test_a_disc_does_not_get_through_a_gap_that_is_not(gap: float) -> None:
    scene = caged(gap)
    proof = cfree.plan(scene)
    assert isinstance(proof, cfree.Separated) and proof.of == "closed" and cfree.verify.answer(scene, proof).verified


def test_a_disc_goes_along_a_gap_that_just_fits() -> None:
    scene = cfree.Scene(
        cfree.Curved.circle((0, 0), 1),
        workspace=[(-4, -1), (4, -1), (4, 1), (-4, 1)],
        start=(-2, 0, 0),
        goal=(2, 0, 0),
    )
    path = cfree.plan(scene, tolerance=0.001)
    assert isinstance(path, cfree.Path) and cfree.is_free_motion(scene, path.start, path.motions[0])
    assert cfree.verify.answer(scene, path).verified


def test_a_gap_that_is_just_too_narrow_has_a_proof_by_cells_or_is_left_undecided(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    walls = [[(-1, y), (1, y), (1, z), (-1, z)] for y, z in ((-9, "-0.9999999"), (1, 9))]
    scene = cfree.Scene(cfree.Curved.circle((0, 0), 1), walls, bounds=(-4, -4, 4, 4), start=(-3, 0, 0), goal=(3, 0, 0))
    proof = cfree.plan(scene, tolerance=0.001)
    assert isinstance(proof, cfree.Separated) and cfree.verify.answer(scene, proof).verified
    monkeypatch.setattr("cfree.planning.curved.round_cells", lambda *_: None)
    with pytest.raises(cfree.UndecidedError, match="touch, or all but") as caught:
        cfree.plan(scene, tolerance=0.001)
    assert 0 < caught.value.error <= 0.001


@pytest.mark.slow
def test_a_disc_turns_in_its_own_hole_and_stays_there() -> None:
    hole = cfree.Curved([(-3, -3), (3, -3), (3, 3), (-3, 3)], [cfree.curves.Circle((0, 0), 1)])
    scene = cfree.Scene(cfree.Curved.circle((0, 0), 1), [hole])
    assert cfree.is_free(scene, Pose(0, 0)) is True
    turned = cfree.plan(scene, (0, 0, 0), (0, 0, "90deg"), tolerance=0.01)
    assert isinstance(turned, cfree.Path) and turned.length == 0
    assert isinstance(cfree.plan(scene, (0, 0, 0), (9, 0, 0), tolerance=0.01), cfree.Separated)


def test_overlap_at_the_start_is_bad_input() -> None:
    with pytest.raises(cfree.InvalidPoseError, match="start"):
        cfree.plan(caged(0.1), (2, 0, 0), (8, 8, 0))


def test_the_free_pose_that_is_named_is_free() -> None:
    scene = cfree.Scene(cfree.Curved.circle((0, 0), 1), [cfree.Curved.circle((1, 0), 1)])
    with pytest.raises(
        cfree.ForbiddenPoseError, match=r"overlaps obstacle 0, 2 x 2 at \(1, 0\); .* is free and near by"
    ) as caught:
        cfree.plan(scene, (0, 0, 0), (9, 9, 0))
    assert caught.value.free is not None and cfree.is_free(scene, caught.value.free) is True


@pytest.mark.parametrize("distance", [Fraction(1, 10), Fraction(1, 100), Fraction(1, 1000)])
def test_near_contact_at_the_start(distance: Fraction) -> None:
    """Polygons become finer until the start is free, or is not."""
    scene = cfree.Scene(cfree.Curved.circle((0, 0), 1), [cfree.Curved.circle((2 + distance, 0), 1)])
    assert isinstance(cfree.plan(scene, (0, 0, 0), (-3, 1, 1)), cfree.Path)
    closer = cfree.Scene(cfree.Curved.circle((0, 0), 1), [cfree.Curved.circle((2 - distance, 0), 1)])
    with pytest.raises(cfree.InvalidPoseError):
        cfree.plan(closer, (0, 0, 0), (-3, 1, 1))


@pytest.mark.slow
def test_poses_among_ellipses_are_free_or_not_or_undecided() -> None:
    """Arcs are decided exactly: tests/collision/test_arcs.py."""
    disc = cfree.Curved([(1, 0), Arc((1, 0), center=(0, 0), conjugate=(0, 1))])
    far = cfree.Curved.ellipse((9, 9), (1, 2))  # makes the scene one of polygons
    scene = cfree.Scene(disc, [cfree.Curved.circle((4, 0), 1), [(0, 3), (1, 3), (1, 4)], far])
    rows = np.array([[0, 0, 0], [2, 0, 0], [3, 0, 0], [2.001, 0, 2], [1.999, 0, 0], [1.99, 0, 1]])
    assert cfree.is_free(scene, rows, tolerance=0.1).tolist() == [True, None, False, None, True, True]
    assert cfree.is_free(scene, rows, tolerance=1e-7).tolist() == [True, None, False, False, True, True]
    assert cfree.is_free(scene, [Pose(*row) for row in rows.tolist()]).tolist() == cfree.is_free(scene, rows).tolist()
    assert [cfree.is_free(scene, Pose(x, 0)) for x in (0, 2, 3)] == [True, None, False]
    assert cfree.is_free(scene, np.empty((0, 3))).tolist() == []
    with pytest.raises(ValueError, match="tolerance"):
        cfree.is_free(cfree.Scene([(0, 0), (1, 0), (0, 1)]), Pose(0, 0), tolerance=0.1)


@pytest.mark.slow
def test_poses_among_random_shapes_are_free_as_in_doubles() -> None:
    from round_shapes import random_scene

    rng = random.Random(8)
    for seed in range(15):
        scene = random_scene(seed)
        rows = [[rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(0, 6)] for _ in range(40)]
        found = cfree.is_free(scene, np.array(rows))
        smaller, larger = (Sampled(scene, by).overlap(rows) > 0 for by in (-2e-4, 2e-4))
        assert not (smaller & (found == True)).any() and not (~larger & (found == False)).any()  # noqa: E712


@pytest.mark.slow
def test_answers_in_files(tmp_path: Path) -> None:
    for gap in (0.1, -0.5):
        scene = caged(gap)
        answer = cfree.plan(scene)
        assert not isinstance(answer, cfree.AllSeparated)
        cfree.save(answer, tmp_path / "answer.json")
        again = cfree.load(tmp_path / "answer.json")
        assert again == answer and isinstance(again, cfree.Path | cfree.Separated)
        if isinstance(answer, cfree.Path):
            assert again.scene is answer.scene is None  # it was found among the true shapes
        else:
            assert again.scene is not None and answer.scene is not None and again.scene.robot == answer.scene.robot
        assert cfree.verify.answer(scene, tmp_path / "answer.json").verified
        cfree.save(again, tmp_path / "again.json", **({"scene": scene} if isinstance(again, cfree.Path) else {}))
        assert (tmp_path / "again.json").read_text() == (tmp_path / "answer.json").read_text()
        other = cfree.Scene(scene.robot, pillars(4, 2, "0.3"))
        assert not cfree.verify.answer(other, tmp_path / "answer.json").verified


@pytest.mark.slow
def test_polygons_that_do_not_fit_are_found(tmp_path: Path) -> None:
    """Each vertex of them moved to the wrong side, one after the other; an ellipse is not decided without polygons."""
    cage, far = caged(0.1), cfree.Curved.ellipse((50, 50), (2, 1))
    scene = cfree.Scene(cage.robot, [*cage.obstacles, far], bounds=cage.bounds, start=cage.start, goal=cage.goal)
    path = cfree.plan(scene)
    cfree.save(path, tmp_path / "path.json")
    data = json.loads((tmp_path / "path.json").read_text())
    for k, ring in ((0, data["polygons"]["robot"][0]["outer"]), (3, data["polygons"]["obstacles"][3]["outer"])):
        for j in (0, len(ring) // 2):
            old = ring[j]
            x, y = (0.0, 0.0) if not k else (2 * math.cos(math.tau * k / 5), 2 * math.sin(math.tau * k / 5))
            ring[j] = [str((9 * Fraction(c) + Fraction(middle)) / 10) for c, middle in zip(old, (x, y), strict=True)]
            (tmp_path / "bad.json").write_text(json.dumps(data))
            found = cfree.verify.answer(scene, tmp_path / "bad.json")
            assert not found.verified and "round shapes" in {finding.kind for finding in found.findings}
            ring[j] = old
    for key in ("polygons",):
        without = {name: value for name, value in data.items() if name != key}
        (tmp_path / "bad.json").write_text(json.dumps(without))
        assert not cfree.verify.answer(scene, tmp_path / "bad.json").verified
    data["polygons"]["obstacles"].pop()
    (tmp_path / "bad.json").write_text(json.dumps(data))
    assert not cfree.verify.answer(scene, tmp_path / "bad.json").verified


@pytest.mark.slow
def test_a_proof_needs_polygons_inside() -> None:
    scene = caged(-0.1)
    proof = cfree.plan(scene)
    assert isinstance(proof, cfree.Separated) and proof.scene is not None
    assert list(mismatches(scene, proof.scene, outward=False)) == []
    outer = cfree.plan(scene.outer(0.05))
    assert isinstance(outer, cfree.Separated)
    assert not cfree.verify.answer(scene, outer).verified  # it is a proof for larger shapes


@pytest.mark.slow
def test_several_goals_and_places() -> None:
    scene = caged(0.1)
    assert isinstance(cfree.plan(scene, (0, 0, 0), [(8, 8, 0), (9, 9)]), cfree.Path)
    shut = dataclasses.replace(caged(-0.5), goal=None)
    proof = cfree.plan(shut, (0, 0, 0), [(8, 8, 0), (9, 9)])
    assert isinstance(proof, cfree.AllSeparated) and proof.curved is shut and cfree.verify.answer(shut, proof).verified


@pytest.mark.slow
def test_a_clearance_among_round_shapes() -> None:
    scene = caged(1)
    path = cfree.plan(scene, clearance=0.45)
    assert isinstance(path, cfree.Path) and cfree.verify.answer(scene, path).verified
    proof = cfree.plan(scene, clearance=0.55)
    assert isinstance(proof, cfree.Separated) and cfree.verify.answer(scene, proof).verified


def test_a_car_with_round_corners_turns_where_the_box_does_not() -> None:
    """In a hall as wide as the box's diagonal is not."""
    corners = [(-2, -1), (2, -1), (2, 1), (-2, 1)]
    round_ = cfree.Curved([(1.5, 0.5), (-1.5, 0.5), (-1.5, -0.5), (1.5, -0.5)], grown="1/2")
    half = Fraction(211, 100)  # the box's radius is 2.236, the round car's 2.08
    hall = [(-9, -half), (9, -half), (9, half), (-9, half)]
    ends = {"start": (0, 0, 0), "goal": (0, 0, "180deg")}
    for robot, kind in ((round_, cfree.Path), (corners, cfree.Separated)):
        scene = cfree.Scene(robot, workspace=hall, **ends)  # type: ignore[arg-type]
        answer = cfree.plan(scene)
        assert isinstance(answer, kind) and cfree.verify.answer(scene, answer).verified


def test_a_stadium_in_a_round_room() -> None:
    stadium = cfree.Curved([(-1, -1), (1, -1), Arc((1, 1), center=(1, 0)), (-1, 1), Arc((-1, -1), center=(-1, 0))])
    for radius, kind in ((Fraction(21, 10), cfree.Path), (Fraction(19, 10), None)):
        scene = cfree.Scene(stadium, workspace=cfree.Curved.circle((0, 0), radius))
        if kind is None:
            with pytest.raises(cfree.InvalidPoseError):
                cfree.plan(scene, (0, 0, 0), (0, 0, "90deg"))
        else:
            assert isinstance(cfree.plan(scene, (0, 0, 0), (0, 0, "90deg")), kind)
