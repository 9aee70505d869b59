"""Cars without reverse gear: boxes that exclude a path, searches within them, and what stays open."""

from __future__ import annotations

import math
import pickle
import random
import zlib
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

import cfree
import cfree.verify
from cfree import Car, Path, Pose, PoseChecker, Scene, Stuck, UndecidedError, Unreachable, plan, plan_many
from cfree.planning import reach
from second_opinion import verified, verified_in_a_file
from vehicles import FORWARD, faults, room

ROBOT: list[tuple[Any, Any]] = [("-1/2", "-1/2"), ("3/2", "-1/2"), ("3/2", "1/2"), ("-1/2", "1/2")]
CAR = Car((3, 4), gears="forward")
# a dead end too narrow to turn round
ALLEY = Scene(ROBOT, [], workspace=[(0, 0), (12, 0), (12, 4), (0, 4)], start=(3, 2, 0), goal=(3, 2, "180deg"))


def unreachable_in(scene: Scene, car: Car = CAR, **changes: Any) -> Unreachable:
    answer = plan(scene, vehicle=car, improve=0, **changes)
    assert isinstance(answer, Unreachable)
    return answer


def test_a_reversing_car_turns_round_in_a_dead_end_where_a_forward_one_cannot() -> None:
    path = plan(ALLEY, vehicle=Car((3, 4)), improve=0)
    assert isinstance(path, Path) and path.cusps > 0
    proof = unreachable_in(ALLEY)
    assert proof.vehicle == CAR and proof.scene is ALLEY and proof.count > 0
    assert 0 < proof.margin < 0.5 and proof.pose in (ALLEY.start, ALLEY.goal)
    with pytest.raises(TypeError, match="Unreachable: a proof"):
        bool(proof)
    assert proof.sentence().startswith("no path of a car with turning radii of 3 and 4 and no reverse gear leads")


@pytest.mark.slow
@pytest.mark.long
def test_proofs_from_both_ends_are_verified_by_both_checkers(tmp_path: Any) -> None:
    # an open field, with a nook that is left ahead only, or entered only
    nook = [
        [(0, 0), (4, 0), (4, "3/10"), (0, "3/10")],
        [(0, "17/10"), (4, "17/10"), (4, 2), (0, 2)],
        [(-1, 0), (0, 0), (0, 2), (-1, 2)],
    ]
    field = Scene(ROBOT, nook)
    into, out = Pose(2, 1, "180deg"), Pose(1, 1, 0)
    sides = set()
    for start, goal in ((Pose(9, 9, 0), out), (into, Pose(9, 9, 0))):
        proof = unreachable_in(field, start=start, goal=goal)
        sides.add(proof.at)
        assert verified_in_a_file(field, proof).verified
    assert sides == {"start", "goal"}
    assert isinstance(plan(field, Pose(9, 9, 0), into, vehicle=CAR, improve=0), Path)


@pytest.mark.slow
def test_bounds_of_the_reference_point_shut_boxes() -> None:
    scene = Scene(ROBOT, [], bounds=(0, 0, 9, 3), start=(3, 2, 0), goal=(3, 2, "180deg"))
    for car in (CAR, Car(3, axle=(0, "1/2"), heading="90deg", gears="forward")):
        assert verified_in_a_file(scene, unreachable_in(scene, car)).verified


@pytest.mark.slow
def test_proofs_are_saved_loaded_pickled_and_answered_with_others(tmp_path: Any) -> None:
    proof = unreachable_in(ALLEY)
    file = tmp_path / "proof.json"
    cfree.save(proof, file)
    assert cfree.load(file) == proof == pickle.loads(pickle.dumps(proof))
    (answer,) = plan_many(ALLEY, [(ALLEY.start, ALLEY.goal)], vehicle=CAR, improve=0)
    assert answer == proof
    several = plan(ALLEY, goal=[(3, 2, "180deg"), (4, 2, "180deg")], vehicle=CAR, improve=0)
    assert isinstance(several, cfree.AllSeparated) and (several.of, len(several.proofs)) == ("pieces", 2)
    assert cfree.verify.answer(Scene(ROBOT, [], workspace=ALLEY.workspace), several).verified
    cfree.save(several, file)
    assert cfree.load(file) == several


def changed(proof: Unreachable, slice_row_column: tuple[int, int, int], *, to: bool) -> Unreachable:
    """A proof with one box left out, or listed."""
    k, j, i = slice_row_column
    grid = proof.grid
    bits = bytearray(zlib.decompress(proof.boxes))
    at = (k * grid.rows + j) * grid.columns + i
    bits[at // 8] = bits[at // 8] | 1 << at % 8 if to else bits[at // 8] & ~(1 << at % 8)
    return replace(proof, boxes=zlib.compress(bytes(bits)))


@pytest.mark.slow
@pytest.mark.long
def test_changed_proofs_by_boxes_are_refuted(tmp_path: Any) -> None:
    proof = unreachable_in(ALLEY)
    grid, file = proof.grid, tmp_path / "proof.json"
    bits = int.from_bytes(zlib.decompress(proof.boxes), "little")
    boxes = [at for at in range(bits.bit_length()) if bits >> at & 1]
    rng, wrong = random.Random(1), list[Unreachable]()
    for at in rng.sample(boxes, 4):
        row, column = divmod(at, grid.columns)
        wrong.append(changed(proof, (*divmod(row, grid.rows), column), to=False))
    turned = 0 if proof.at == "goal" else grid.slices // 2
    end = (3 - grid.corner[0]) // grid.side, (2 - grid.corner[1]) // grid.side
    for k in (turned - 1, turned):
        wrong.append(changed(proof, (k % grid.slices, int(end[1]), int(end[0])), to=True))
    half = Fraction(1, 2)
    wrong += [
        replace(proof, at="goal" if proof.at == "start" else "start"),
        replace(proof, vehicle=Car(1, gears="forward")),
        replace(proof, grid=replace(grid, side=grid.side * half)),
        replace(proof, grid=replace(grid, step=grid.step * 2)),
        replace(proof, grid=replace(grid, step=Fraction(10))),
        replace(proof, grid=replace(grid, corner=(grid.corner[0] + 1, grid.corner[1]))),
        replace(proof, pieces=(tuple((2 * x, 2 * y) for x, y in proof.pieces[0]),)),
        replace(proof, pieces=(proof.pieces[0][::-1],)),
        replace(proof, boxes=zlib.compress(bytes((grid.count + 7) // 8))),
    ]
    assert verified_in_a_file(ALLEY, proof).verified
    for mutant in wrong:
        cfree.save(mutant, file)
        assert not verified(ALLEY, file).verified, mutant


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"gears": "forward"', '"gears": "both"', 'no car with "gears": "forward"'),
        ('"boxes": "', '"boxes": "?', "expected bytes in base64"),
        ('"slices": ', '"slices": -', "slices"),
        ('"pieces": [', '"pieces": [[["0", "0"]], ', "pieces"),
    ],
)
def test_files_of_proofs_by_boxes_are_read_strictly(old: str, new: str, said: str, tmp_path: Any) -> None:
    file = tmp_path / "proof.json"
    cfree.save(unreachable_in(ALLEY), file)
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))
    with pytest.raises(cfree.FormatError, match=said):
        cfree.load(file)


@pytest.mark.slow
def test_files_whose_boxes_are_not_those_of_the_grid_are_refuted_or_unreadable(tmp_path: Any) -> None:
    proof = unreachable_in(ALLEY)
    for boxes in (b"", proof.boxes[:-1], zlib.compress(b"1"), zlib.compress(bytes(10**6))):
        assert not cfree.verify.answer(ALLEY, replace(proof, boxes=boxes)).verified


@pytest.mark.slow
@pytest.mark.parametrize("number", range(4))
def test_what_a_car_drives_stays_in_the_boxes(number: int) -> None:
    rng = random.Random(f"boxes {number}")
    scene, car = room(rng), FORWARD[number % len(FORWARD)]
    search, checker = reach.Reach(scene, car, scene.start, scene.goal), PoseChecker(scene)  # type: ignore[arg-type]
    left, right = (1 / float(radius) for radius in car.radii)
    back = car.frame.inverse()
    (fx, fy), heading = map(float, (back.x, back.y)), back.theta
    stayed = 0
    for count in (2**16, 2**19):
        grid = search.grid(count)
        for side, sense in (("start", 1), ("goal", -1)):
            boxes = search.boxes(grid, side)  # type: ignore[arg-type]
            assert boxes.run(10**12)
            for _ in range(40):
                end = search.ends[side]
                x, y, theta = float(end.x), float(end.y), end.theta
                travel, curvature, on = rng.random() * float(grid.step), 0.0, True
                while on:
                    for _ in range(20):
                        if rng.random() < 0.2:
                            curvature = rng.choice((-right, 0, left, rng.uniform(-right, left)))
                        part = sense * travel / 20
                        middle = theta + curvature * part / 2
                        x, y, theta = x + part * math.cos(middle), y + part * math.sin(middle), theta + curvature * part
                        c, s = math.cos(theta), math.sin(theta)
                        pose = x + c * fx - s * fy, y + s * fx + c * fy, theta + heading
                        on = on and bool(checker.is_free([pose], threads=1)[0])
                    if on:
                        stayed, travel = stayed + 1, float(grid.step)
                        turned = theta if side == "start" else theta + math.pi
                        assert boxes.steps_to((x, y, turned)) >= 0
    assert stayed > 50


@pytest.mark.slow
@pytest.mark.parametrize("number", range(6))
def test_no_room_has_both_a_path_and_a_proof_by_boxes(number: int) -> None:
    rng = random.Random(f"forward {number}")
    scene, car = room(rng), FORWARD[0]
    try:
        answer = plan(scene, vehicle=car, improve=0)
    except UndecidedError as error:
        assert error.margin > 0
        return
    if isinstance(answer, Path):
        assert not faults(scene, answer) and {part.gear for part in answer.driving} == {"forward"}
        search = reach.Reach(scene, car, answer.start, answer.goal)
        for side in reach.SIDES:
            boxes = search.boxes(search.grid(2**19), side)
            assert boxes.run(10**12) and boxes.meets_goal
    elif isinstance(answer, Unreachable):
        assert verified_in_a_file(scene, answer).verified


def test_an_open_question_states_its_margin(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reach, "BOXES", (2**9,))
    monkeypatch.setattr("cfree.planning.vehicles.POSES", 10)
    said = r"none is excluded: boxes with sides of .*, in which a robot smaller"
    with pytest.raises(UndecidedError, match=said) as error:
        plan(ALLEY, vehicle=CAR, improve=0)
    assert error.value.margin > 0.1


def test_contacts_that_hold_the_car_come_before_boxes() -> None:
    flush = [[(2, -1), (3, -1), (3, 1), (2, 1)], [(-3, -1), (-2, -1), (-2, 1), (-3, 1)]]
    scene = Scene([(-2, -1), (2, -1), (2, 1), (-2, 1)], flush, start=(0, 0, 0), goal=(0, 6, 0))
    assert isinstance(plan(scene, vehicle=Car(4, gears="forward")), Stuck)


def test_a_pose_in_contact_is_excluded_by_boxes() -> None:
    scene = replace_start(ALLEY, ("1/2", 2, 0))
    assert isinstance(plan(scene, vehicle=CAR, improve=0), Unreachable)


def replace_start(scene: Scene, start: Any) -> Scene:
    return Scene(scene.robot, [], workspace=scene.workspace, start=start, goal=scene.goal)


@pytest.mark.slow
@pytest.mark.long
def test_a_nook_in_a_wide_hall_is_excluded_by_boxes_near_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reach, "BOXES", (2**19,))
    walls = (0, 0, 4, "3/10"), (0, "17/10", 4, 2), (-1, 0, 0, 2), (300, 0, 301, 1), (0, 300, 1, 301)
    hall = Scene(ROBOT, [[(x0, y0), (x1, y0), (x1, y1), (x0, y1)] for x0, y0, x1, y1 in walls])
    proof = unreachable_in(hall, start=(99, 99, 0), goal=(1, 1, 0))
    grid = proof.grid
    assert proof.at == "goal" and grid.corner[0] + grid.columns * grid.side < 99
    assert verified_in_a_file(hall, proof).verified
    # a grid that the car leaves, and that does not hold the other end
    open_field = Scene(ROBOT, [[(300, 0), (301, 0), (300, 1)]])
    wrong = replace(proof, goal=Pose(1, 1, 0), boxes=zlib.compress(b"\xff" * (grid.count // 8)), scene=open_field)
    assert not verified_in_a_file(open_field, wrong).verified


@pytest.mark.slow
def test_a_proof_by_boxes_among_round_shapes_is_about_polygons_inside_them(tmp_path: Any) -> None:
    column = cfree.Curved.circle((9, 2), "1/2")
    scene = Scene(ROBOT, [column], workspace=ALLEY.workspace, start=ALLEY.start, goal=ALLEY.goal)
    proof = unreachable_in(scene)
    assert proof.curved == scene
    cfree.save(proof, tmp_path / "proof.json")
    assert cfree.load(tmp_path / "proof.json") == proof
    assert cfree.verify.answer(scene, tmp_path / "proof.json").verified
