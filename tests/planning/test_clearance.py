"""Paths that keep a clearance, or proofs that none does: gates, random scenes against slices by shapely, files."""

from __future__ import annotations

import json
import math
import random
from fractions import Fraction
from itertools import combinations
from pathlib import Path as FilePath

import numpy as np
import pytest
import shapely

import cfree.verify
from cfree import InvalidPoseError, Path, Pose, Scene, Separated, UndecidedError, UnsupportedError, load, plan, save
from cfree.planning.clearance import SIDES
from cfree.polygons.disc import around_disc, inside_disc
from cfree.scene.dilation import cores
from cfree.verify.inside import is_near, strictly_inside
from cfree.verify.leeway import is_around_disc
from compared import scene_of
from flood import flood
from second_opinion import verified, verified_in_a_file
from shapes import KINDS, PlainScene, Shape, box, random_scene

SQUARE = box("-1/2", "-1/2", "1/2", "1/2")[0]


def gate(turn: object = 0, robot: object = SQUARE, **more: object) -> Scene:
    """Two walls, a gap of 2 between them, all turned."""
    frame = Pose(0, 0, turn)  # type: ignore[arg-type]
    walls = [
        frame.apply_exact([(Fraction(x), Fraction(y)) for x, y in box(*b)[0]]) for b in ((-9, -1, -1, 1), (1, -1, 9, 1))
    ]
    ring = frame.apply_exact([(Fraction(x), Fraction(y)) for x, y in box(-9, -9, 9, 9)[0]])
    return Scene(robot, [list(wall) for wall in walls], workspace=list(ring), **more)  # type: ignore[arg-type]


UP, DOWN = Pose(0, 5), Pose(0, -5)


@pytest.mark.parametrize("clearance", ["0.3", "0.4999999", "1/2"])
def test_what_has_room_gets_through(clearance: str) -> None:
    path = plan(gate(), UP, DOWN, clearance=clearance)
    assert isinstance(path, Path) and path.clearance == Fraction(clearance)
    result = verified_in_a_file(gate(), path)
    assert result.verified and f"keeps {float(path.clearance):g} from obstacles" in result.proved
    found = cfree.clearance(path, gate())
    assert found and found.found >= float(path.clearance)


@pytest.mark.slow
@pytest.mark.parametrize("clearance", ["0.5001", "0.6", 3])
def test_what_has_none_is_proved_apart(clearance: str) -> None:
    proof = plan(gate(), UP, DOWN, clearance=clearance)
    assert isinstance(proof, Separated) and proof.of == "closed" and proof.clearance == Fraction(clearance)
    assert verified_in_a_file(gate(), proof).verified


@pytest.mark.slow
@pytest.mark.parametrize("objective", ["short", "clear"])
def test_the_path_that_is_improved_keeps_it(objective: str) -> None:
    scene = gate(obstacle_names=None)
    path = plan(scene, (-5, 5, 0), (5, -5, "45deg"), clearance="0.3", improve=0.2, objective=objective)  # type: ignore[arg-type]
    assert isinstance(path, Path) and len(path.motions) > 1
    assert least_by_shapely(scene, path) > 0.3 - 1e-9
    assert verified_in_a_file(scene, path).verified


RHOMBUS = [("1/2", 0), (0, "1/4"), ("-1/2", 0), (0, "-1/4")]


@pytest.mark.slow
@pytest.mark.parametrize("bounds", [None, (-8, -8, 8, 8)])
def test_cells_decide_a_clearance_near_the_largest_and_it_is_open_at_a_place(bounds: tuple[int, ...] | None) -> None:
    """A rhombus is sqrt(1/5) wide: no rational number is what it keeps in the middle of the gate."""
    scene, most = gate({"tau": "1/7"}, RHOMBUS, bounds=bounds), 1 - math.sqrt(1 / 5) / 2
    ends = Pose(0, 5), Pose(0, -5)
    assert cfree.verify.answer(scene, plan(scene, *ends, clearance=most)).verified
    with pytest.raises(UndecidedError, match="too near to the largest that a path keeps") as caught:
        plan(scene, ends[0], [(0, -5)], clearance=most)
    assert caught.value.lo < most < caught.value.hi < 1.001 * caught.value.lo
    assert isinstance(plan(scene, *ends, clearance=Fraction(0.999 * most)), Path)
    assert isinstance(plan(scene, *ends, clearance=Fraction(1.001 * most)), Separated)


@pytest.mark.slow
def test_bounds_have_no_clearance() -> None:
    """They stay for the reference point, also where they leave no way but along themselves."""
    scene = Scene(SQUARE, [box(-1, 2, 1, 3)[0]], bounds=(-5, 0, 5, "5/2"))
    path = plan(scene, (-4, 0, 0), (4, 0, 0), clearance="3/2")
    assert isinstance(path, Path) and verified_in_a_file(scene, path).verified
    for clearance, kind in (("1.499", Path), ("1.501", Separated)):
        answer = plan(scene, (-4, 0, 0), (4, 0, 0), clearance=clearance)
        assert isinstance(answer, kind) and verified_in_a_file(scene, answer).verified


@pytest.mark.parametrize(
    ("pose", "message"),
    [
        (
            (0, -2, 0),
            r"goal: 0.707107 away from obstacle 0, .* at \(.*\), and the clearance is 0.75; move it, or give",
        ),
        ((0, "-8.5", 0), "goal: 0 away from the workspace, and the clearance is 0.75; it touches; move it"),
        ((-3, 0, 0), r"goal \(-3, 0, 0 deg\) is forbidden: robot part 0 overlaps obstacle 0"),
    ],
)
def test_ends_that_are_nearer_are_refused(pose: tuple[object, ...], message: str) -> None:
    with pytest.raises(InvalidPoseError, match=message):
        plan(gate(), UP, pose, clearance="3/4")  # type: ignore[arg-type]


def test_ends_just_as_far_are_not() -> None:
    scene = Scene(SQUARE, [box(2, -1, 3, 1)[0]])
    assert isinstance(plan(scene, (0, 0, 0), (0, 4, 0), clearance="3/2"), Path)
    with pytest.raises(InvalidPoseError):
        plan(scene, (Fraction(1, 10**30), 0, 0), (0, 4, 0), clearance="3/2")
    same = plan(scene, (0, 0, 0), (0, 0, 0), clearance="3/2")
    assert isinstance(same, Path) and verified_in_a_file(scene, same).verified


@pytest.mark.parametrize("clearance", [0, -1, "0"])
def test_a_clearance_is_above_zero(clearance: str) -> None:
    with pytest.raises(ValueError, match=r"clearance .*: give a length above 0"):
        plan(gate(), UP, DOWN, clearance=clearance)


@pytest.mark.parametrize("sides", [4, *SIDES])
def test_polygons_around_and_in_a_disc(sides: int) -> None:
    for radius in (Fraction(1), Fraction(3, 10), Fraction(10**9, 7)):
        outer, inner = around_disc(radius, sides), inside_disc(radius, sides)
        assert is_around_disc(outer, radius) and not is_around_disc(outer, radius * Fraction(10**9 + 1, 10**9))
        assert not is_around_disc(outer[::-1], radius) and not is_around_disc(outer[:2] + outer[3:], radius)
        assert not is_around_disc([*outer, *outer], radius)
        assert all(x * x + y * y < radius * radius for x, y in inner)
        far = max(math.hypot(x, y) for x, y in outer)
        near = min(shapely.LinearRing([(float(x), float(y)) for x, y in inner]).distance(shapely.Point(0, 0)), math.inf)
        if sides == SIDES[-1]:
            assert far - near < 1e-3 * radius


@pytest.mark.parametrize("kind", KINDS)
def test_cores_are_inside(kind: str) -> None:
    scene = scene_of(random_scene(3, kind))
    for by in (Fraction(1, 10**6), Fraction(10**6)):
        for core in cores(scene, by):
            assert is_near(core, core, Fraction(1, 10**9)), "convex"
            assert any(strictly_inside(core, part) for part in scene.robot)


# --- random scenes, against slices of the robot grown by shapely ---


def grown(plain: PlainScene, by: float) -> PlainScene:
    """Polygons within a robot grown by a distance, and around one grown by 0.96 of it."""
    robot: list[Shape] = []
    for outer, holes in plain.robot:
        solid = shapely.Polygon(
            [(float(x), float(y)) for x, y in outer], [[(float(x), float(y)) for x, y in h] for h in holes]
        )
        for part in shapely.get_parts(solid.buffer(by, quad_segs=3)).tolist():
            rings = [list(ring.coords)[:-1] for ring in (part.exterior, *part.interiors)]
            robot.append((rings[0], rings[1:]))
    return plain._replace(robot=robot)


def asked(plain: PlainScene, clearance: float, joined: bool, rng: random.Random) -> int:
    """How many questions were asked, all answered as the slices say."""
    known, count = flood(grown(plain, clearance * (1.06 if joined else 0.99)), 36), 0
    scene, column = scene_of(plain), known.certain if joined else known.possible
    pairs = [(i, j) for i, j in combinations(range(len(column)), 2) if (column[i] == column[j]) == joined]
    for i, j in rng.sample(pairs, min(2, len(pairs))):
        start, goal = (Pose(*known.xy[k].tolist(), float(known.theta[k])) for k in (i, j))
        try:
            answer = plan(scene, start, goal, clearance=clearance, improve=0)
        except (InvalidPoseError, UnsupportedError):  # too near; too many digits
            assert not joined
            continue
        assert isinstance(answer, Path if joined else Separated), (start, goal, clearance)
        assert verified_in_a_file(scene, answer).verified
        if isinstance(answer, Path):
            assert least_by_shapely(scene, answer) >= clearance * (1 - 1e-9)
        count += 1
    return count


def least_by_shapely(scene: Scene, path: Path) -> float:
    """At poses along it."""
    walls = [shapely.Polygon(o.rings[0], o.rings[1:]) for o in scene.obstacles]
    walls += [shapely.Polygon(scene.workspace.rings[0], scene.workspace.rings[1:]).boundary] if scene.workspace else []
    poses = path.sample(0.05, 0.05)
    solids = [
        shapely.Polygon(outer, [hole[k] for hole in holes])
        for part in scene.robot
        for outer, *holes in [[poses.apply(ring) for ring in part.rings]]
        for k, outer in enumerate(outer)
    ]
    return float(min((shapely.distance(solids, wall).min() for wall in walls), default=np.inf))


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
def test_verdicts_are_those_of_slices(kind: str) -> None:
    counts = {True: 0, False: 0}
    for seed in range(1):
        rng, plain = random.Random(f"{kind} {seed}"), random_scene(seed, kind)
        size = max(abs(float(c)) for outer, _ in plain.robot for p in outer for c in p)
        for joined in counts:
            counts[joined] += asked(plain, float(f"{size * rng.choice((0.05, 0.3)):.2g}"), joined, rng)
    assert counts[True]


# --- files ---


def test_files_say_it(tmp_path: FilePath) -> None:
    for clearance in ("0.3", "0.6"):
        answer, file = plan(gate(), UP, DOWN, clearance=clearance), tmp_path / "answer.json"
        save(answer, file)
        assert load(file) == answer and json.loads(file.read_text())["clearance"] == str(Fraction(clearance))


@pytest.mark.parametrize(
    ("clearance", "old", "new", "message"),
    [
        ("0.3", '"clearance": "3/10"', '"clearance": "0"', "clearance: expected a length above 0"),
        ("0.3", '"disc": [[', '"disc": [["x", ', "disc"),
        ("0.3", '"clearance": "3/10",', "", '"disc" is a polygon around a disc of the radius "clearance"'),
        ("0.6", '"clearance": "3/5",', "", '"clearance" belongs to as many "cores" as "smaller_robot"'),
    ],
)
def test_files_that_do_not_say_it_well(clearance: str, old: str, new: str, message: str, tmp_path: FilePath) -> None:
    file = tmp_path / "answer.json"
    save(plan(gate(), UP, DOWN, clearance=clearance), file)
    assert old in file.read_text()
    file.write_text(file.read_text().replace(old, new))
    with pytest.raises(cfree.FormatError, match=message):
        load(file)


def test_files_among_round_shapes_have_a_clearance_without_a_polygon(tmp_path: FilePath) -> None:
    scene = cfree.Scene(cfree.Curved.circle((0, 0), 1), [[(-9, -9), (9, -9), (9, 0), (-9, 0)]])
    path, file = plan(scene, (-3, 3, 0), (3, 3, 0), clearance="1/2", improve=0), tmp_path / "path.json"
    save(path, file)
    assert load(file) == path and "disc" not in json.loads(file.read_text())
    assert cfree.verify.answer(scene, file).verified


def test_a_clearance_among_polygons_is_checked_with_the_disc_itself_without_a_polygon(tmp_path: FilePath) -> None:
    file = tmp_path / "answer.json"
    save(plan(gate(), UP, DOWN, clearance="0.3"), file)
    data = json.loads(file.read_text())
    del data["disc"]
    for clearance, is_kept in (("3/10", True), ("1/2", True), ("501/1000", False)):
        file.write_text(json.dumps(data | {"clearance": clearance}))
        result = verified(gate(), file)
        assert result.verified is is_kept and {finding.kind for finding in result.findings} <= {"clearance"}
