"""`tools/check_answer.py` decides paths among segments and circular arcs, and agrees with `cfree.verify`."""

from __future__ import annotations

import json
import random
from dataclasses import replace
from fractions import Fraction
from itertools import product
from pathlib import Path as FilePath
from typing import Any

import pytest
from shapely.affinity import affine_transform

import fuzz_arcs
from answers import rounded, tee, text_of
from arc_shapes import BAY, CAR, DISC, FILLET, MOON, STADIUM, dense
from arc_shapes import SHAPES as MANY_SHAPES
from cfree import Car, Curved, Path, Pose, Rotation, Scene, Translation, load_scene, plan, save
from cfree.curves import Arc, Bezier, Circle, Spline
from cfree.errors import CfreeError
from cfree.formats.scene_file import scene_from_text, scene_text
from cfree.scene.digest import stamp_of
from cfree.verify.arc_motions import ArcWorld
from cfree.verify.course import Course, place_of
from second_opinion import check_answer, verified_in_a_file
from shapes import box

ROOT = FilePath(__file__).parents[2]
EPS, TINY = Fraction(1, 2**60), Fraction(1, 10**30)
UNIT = Curved.circle((0, 0), 1)
FLOOR = box(-9, -9, 9, 0)[0]
HOLE = Curved(box(-3, -3, 3, 3)[0], [Circle((0, 0), 1)])
PEG = Curved([(-2, -1), (2, -1), Arc((2, 1), center=(2, 0)), (-2, 1), Arc((-2, -1), center=(-2, 0))])
SLOT = Curved([(-9, -1), (9, -1), Arc((9, 1), center=(9, 0)), (-9, 1), Arc((-9, -1), center=(-9, 0))])
SLAB = Curved([(0, 0), (2, 0), (2, 1), (0, 1)], grown="1/2")
HAMMER = Curved([(0, 0), (3, -4), (2, 0)], grown="1/2")  # its lowest point, in the middle of a swing, is at -11/2
SWING = Rotation((0, 0), {"tau": "-3/4"})
ACROSS, TURN = Translation((6, 0)), Rotation((0, 0), {"tau": "inf"})


def read(scene: Scene) -> Any:
    return check_answer.read_scene(check_answer.decoded(scene_text(scene)))


@pytest.mark.parametrize(
    ("scene", "start", "motion", "is_free"),
    [
        (Scene(UNIT, [FLOOR]), Pose(-3, 1), ACROSS, True),
        (Scene(UNIT, [FLOOR]), Pose(-3, 1), Translation((6, -EPS)), False),
        (Scene(UNIT, [FLOOR]), Pose(-3, 1 - TINY), ACROSS, False),
        (Scene(Curved.circle((0, 0), 1 + EPS), [FLOOR]), Pose(-3, 1), ACROSS, False),
        (Scene(UNIT, [HOLE]), Pose(0, 0), TURN, True),
        (Scene(UNIT, [HOLE]), Pose(0, 0), Rotation((TINY, 0), {"tau": "1/9"}), False),
        (Scene(UNIT, [UNIT]), Pose(2, 0), TURN, True),
        (Scene(UNIT, [UNIT]), Pose(2, 0), Rotation((TINY, 0), {"tau": "inf"}), False),
        (Scene(UNIT, [UNIT]), Pose(-5, 2), Translation((10, 0)), True),
        (Scene(UNIT, [Curved.circle((0, EPS), 1)]), Pose(-5, 2), Translation((10, 0)), False),
        (Scene(PEG, workspace=SLOT), Pose(-7, 0), Translation((14, 0)), True),
        (Scene(PEG, workspace=SLOT), Pose(-7, 0), Translation((14 + EPS, 0)), False),
        (Scene(PEG, workspace=SLOT), Pose(0, 0), Rotation((0, 0), {"tau": TINY}), False),
        (Scene(PEG, [box(-9, 1, 9, 2)[0], box(-9, -2, 9, -1)[0]]), Pose(-3, 0), ACROSS, True),
        (Scene(PEG, [box(-9, 1 - EPS, 9, 2)[0], box(-9, -2, 9, -1)[0]]), Pose(-13, 0), Translation((9, 0)), False),
        (Scene(SLAB, [FLOOR]), Pose(-3, "1/2"), ACROSS, True),
        (Scene(SLAB, [FLOOR]), Pose(-3, "1/2"), Translation((6, -TINY)), False),
        (Scene(SLAB, [SLAB]), Pose(3, 0), Translation((0, 5)), True),
        (Scene(SLAB, [SLAB]), Pose(3 - EPS, 0), TURN, False),
        (Scene(UNIT, workspace=Curved.circle((0, 0), 3)), Pose(2, 0), TURN, True),
        (Scene(UNIT, workspace=Curved.circle((0, 0), 3 - EPS)), Pose(1, 0), Translation((1, 0)), False),
        (Scene(UNIT, bounds=(-2, -2, 2, 2), obstacles=[FLOOR]), Pose(-2, 1), Translation((4, 0)), True),
        (Scene(UNIT, bounds=(-2, -2, 2, 2), obstacles=[FLOOR]), Pose(-2, 1), Translation((4 + EPS, 0)), False),
        (Scene(HAMMER, [box(-9, -9, 9, "-11/2")[0]]), Pose(0, 0), SWING, True),
        (Scene(HAMMER, [box(-9, -9, 9, Fraction(-11, 2) + EPS)[0]]), Pose(0, 0), SWING, False),
        (Scene(HAMMER, [Curved.circle((0, -7), "3/2")]), Pose(0, 0), SWING, True),
        (Scene(HAMMER, [Curved.circle((0, -7), Fraction(3, 2) + EPS)]), Pose(0, 0), SWING, False),
    ],
)
def test_exact_fits_of_arcs_are_verified_and_the_least_overlap_is_not(
    scene: Scene, start: Pose, motion: Any, is_free: bool
) -> None:
    assert verified_in_a_file(scene, Path(start, [motion])).verified is is_free


@pytest.mark.parametrize(
    ("clearance", "height", "keeps"),
    [
        ("1/2", Fraction(3, 2), True),
        ("1/2", Fraction(3, 2) - EPS, False),
        (Fraction(1, 2) + EPS, Fraction(3, 2), False),
    ],
)
def test_a_clearance_is_that_of_a_robot_grown_by_a_disc(clearance: Any, height: Fraction, keeps: bool) -> None:
    path = Path(Pose(-3, height), [ACROSS], clearance=Fraction(clearance))
    assert verified_in_a_file(Scene(UNIT, [FLOOR]), path).verified is keeps


def test_a_clearance_from_a_round_wall_is_exact() -> None:
    """The nearest points of disc and wall are beyond the disc's center, as that of the wall has it."""
    path = Path(Pose(0, 0), [Translation(("6/5", "8/5"))], clearance=Fraction(1, 2))
    for radius, keeps in ((Fraction(7, 2), True), (Fraction(7, 2) - EPS, False)):
        assert verified_in_a_file(Scene(UNIT, workspace=Curved.circle((0, 0), radius)), path).verified is keeps


def test_decimals_are_free_only_if_a_disc_of_their_leeway_is(tmp_path: FilePath) -> None:
    """The leeway of this path is 2^-52: a claim for a robot nearer than that is refuted by both."""
    third = Fraction(1, 3)
    for height, is_claimed in ((1 + Fraction(1, 2**40), True), (Fraction(1), False)):
        path = Path(Pose(-3, height), [Translation((third, 0))])
        scene = Scene(UNIT, [FLOOR], bounds=(-9, -9, 9, 9))
        file = tmp_path / "path.json"
        save(replace(path, scene=scene), file)
        text = file.read_text()
        assert ('"decimals": "free"' in text) is is_claimed
        claimed = text.replace('"approximate"', '"free"')
        assert check_answer.verdict(scene_text(scene), claimed)[0] == (0 if is_claimed else 1)
        low = Scene(UNIT, [FLOOR], bounds=(-9, -9, 9, height))
        save(replace(path, scene=low), file)  # the bounds are smaller by as much
        code, line = check_answer.verdict(scene_text(low), file.read_text().replace('"approximate"', '"free"'))
        assert code == 1 and "its decimals are not free" in line


@pytest.mark.slow
def test_a_path_along_arcs_and_changes_of_it_by_the_least_amounts() -> None:
    """A stadium in a corridor of its width turns in a room of radius sqrt(10), touching a disc."""
    scene, path = rounded()
    assert verified_in_a_file(scene, path).verified
    one, turn, last = path.motions
    assert isinstance(turn, Rotation)
    free = replace(scene, start=None, goal=None)
    for changed in (
        Path(path.start, [one, Rotation((TINY, 0), {"tau": 1}), last]),
        Path(path.start, [one, Rotation((0, -TINY), {"tau": 1}), last]),
        Path(path.start, [one, turn, Translation((0, 7 + EPS))]),
        Path(path.start, [one, turn, Translation((EPS, 5))]),
    ):
        assert not verified_in_a_file(free, changed).verified
    for wrong in (
        replace(free, obstacles=[Curved.circle((Fraction(5, 2) - EPS, 0), "1/2")], obstacle_names=None),
        replace(free, obstacles=[Curved.circle(("5/2", 0), Fraction(1, 2) + EPS)], obstacle_names=None),
    ):
        assert not verified_in_a_file(wrong, path).verified
    right = replace(free, obstacles=[Curved.circle((Fraction(5, 2) + EPS, 0), "1/2")], obstacle_names=None)
    assert verified_in_a_file(right, path).verified


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(60))
def test_random_poses_and_motions_are_decided_alike(seed: int) -> None:
    rng = random.Random(seed)
    scene = fuzz_arcs.scene_of(rng)
    if rng.random() < 0.3:
        scene = Scene(scene.robot, scene.obstacles, workspace=Curved.circle((0, 0), rng.randint(6, 30)))
    mine, other = check_answer.RoundWorld(read(scene)), ArcWorld(scene)
    if rng.random() < 0.3:
        by = Fraction(rng.randint(1, 8), 8)
        mine, other = mine.grown(by), other.with_robot(by)
    for _ in range(4):
        pose, motion = fuzz_arcs.rational_pose(rng), fuzz_arcs.motion_of(rng)
        place, asked = place_of(pose, 1), check_answer.Pose(pose.x, pose.y, pose.tau)
        is_free = other.is_free(place)
        assert (check_answer.collision(mine, next(check_answer.STANDING.courses(asked, 1))) is None) is is_free
        if is_free and isinstance(motion, Translation):
            course = next(check_answer.Motion(vector=motion.vector).courses(asked, 1))
            assert (check_answer.collision(mine, course) is None) is (other.collision(Course(place, motion, 1)) is None)
        elif is_free and motion.tau is not None and abs(motion.tau) <= 1:
            course = next(check_answer.Motion(pole=motion.pole, tau=motion.tau).courses(asked, 1))
            assert (check_answer.collision(mine, course) is None) is (other.collision(Course(place, motion, 1)) is None)


@pytest.mark.slow
def test_poses_are_those_of_fine_polygons() -> None:
    rng, decided = random.Random(1), 0
    regions = {name: check_answer.region_around(read(Scene(shape)).robot[0]) for name, shape in MANY_SHAPES.items()}
    drawn = {name: dense(shape) for name, shape in MANY_SHAPES.items()}
    for one, other in product(MANY_SHAPES, repeat=2):
        x, y, tau = (Fraction(rng.randint(-30, 30), 8) for _ in range(3))
        c, s = (1 - tau * tau) / (1 + tau * tau), 2 * tau / (1 + tau * tau)
        placed = affine_transform(drawn[one], [float(v) for v in (c, -s, s, c, x, y)])
        area, apart = placed.intersection(drawn[other]).area, placed.distance(drawn[other])
        if area > 1e-3 or apart > 1e-3:
            decided += 1
            assert check_answer.overlap(regions[one].moved((x, y, c, s)), regions[other]) is (area > 1e-3), (one, other)
    assert decided > 80


SOLID = [STADIUM, BAY, MOON, FILLET]


@pytest.mark.slow
@pytest.mark.long
def test_planned_paths_in_random_round_scenes_are_verified_by_both() -> None:
    planned = 0
    for seed in range(12):
        rng = random.Random(seed)
        robot = rng.choice([DISC, STADIUM, CAR, MOON, FILLET, Curved.circle((0, 0), "1/2")])
        obstacles = [fuzz_arcs.moved([*shape.path], *fuzz_arcs.point(rng, 9)) for shape in rng.choices(SOLID, k=4)]
        scene = Scene(robot, obstacles, workspace=Curved.circle((0, 0), 16))
        poses = (Pose(*fuzz_arcs.point(rng, 11), f"{rng.randint(0, 359)}deg") for _ in range(40))
        start, goal, *_ = (pose for pose in poses if ArcWorld(scene).is_free(place_of(pose, 1)))
        answer = plan(scene, start, goal, improve=0, clearance=rng.choice([None, "1/16"]))
        if isinstance(answer, Path) and answer.scene is None:
            planned += 1
            assert verified_in_a_file(scene, answer).verified
    assert planned > 8


@pytest.mark.slow
@pytest.mark.parametrize("name", ["round_car", "round_disc", "round_pallet_truck"])
def test_paths_among_the_round_examples_are_verified_by_both(name: str) -> None:
    scene = load_scene(ROOT / f"examples/scenes/{name}.json")
    assert verified_in_a_file(scene, plan(scene, improve=0)).verified


@pytest.mark.slow
def test_a_car_with_round_corners_can_drive_it() -> None:
    scene = Scene(
        SLAB, [Curved.circle((6, 6), 2)], vehicle=Car(turning_radius=2), start=(0, 0, 0), goal=(11, 5, "90deg")
    )
    path = plan(scene, improve=0)
    assert isinstance(path, Path) and path.vehicle and verified_in_a_file(scene, path).verified
    narrow = replace(path, vehicle=Car(turning_radius=9))
    assert not verified_in_a_file(scene, narrow).verified


RANDOM = [kind(random.Random(seed)) for kind in fuzz_arcs.KINDS for seed in range(12)]


@pytest.mark.slow
def test_round_shapes_are_read_alike() -> None:
    """Hashes of scenes and boxes of robots: arcs through points, clockwise, with conjugate radii."""
    quarter = Arc((0, 1), center=(0, 0), conjugate=(0, 1))
    shapes = [
        *RANDOM, *MANY_SHAPES.values(), PEG, SLOT, SLAB, HOLE,
        Curved([(1, 0), Arc((1, 0), center=(0, 0), clockwise=True)]),
        Curved([(1, 0), quarter, (0, 0)]), Curved([(1, 0), (1, 0), (2, 0), (3, 0), (1, 3), (1, 0)]),
        Curved([(1, 0), Arc((-1, 0), center=(0, 0), conjugate=(0, -1), clockwise=True)]),
        Curved([(0, 0), Arc((1, 1), through=("1/7", "2/3"))]),
    ]  # fmt: skip
    for shape in shapes:
        scene = Scene(shape, [shape])
        mine, stamp = read(scene), stamp_of(scene)
        assert (mine.sha256, tuple(mine.box)) == (stamp.sha256, stamp.robot)


@pytest.mark.parametrize(
    "shape",
    [
        {"circle": {"center": [0, 0], "radius": 0}},
        {"circle": {"center": [0, 0], "radius": 1}, "grown": 1},
        {"circle": {"center": [0, 0], "radius": 1}, "path": [[0, 0], [1, 0], [0, 1]]},
        {"grown": 1},
        {"outer": [[0, 0], [1, 0], [0, 1]], "grown": -1},
        {"path": [[0, 0], [4, 0], [0, 4], [4, 4]]},
        {"path": [[0, 0], [4, 0], [2, 0]]},
        {"path": [[0, 0], {"arc": {"to": [2, 0], "center": ["1.1", 0]}}]},
        {"path": [[0, 0], {"arc": {"to": [2, 0], "through": [1, 0]}}, [0, 2]]},
        {"path": [[0, 0], {"arc": {"to": [2, 0], "through": [1, 1], "center": [1, 0]}}]},
        {"path": [[0, 0], {"arc": {"to": [2, 0]}}]},
        {"path": [[0, 0], {"arc": {"to": [2, 0], "through": [1, 1], "clockwise": True}}]},
        {"path": [[0, 0], {"arc": {"to": None, "center": [1, 0]}}]},
        {"path": [[-2, 0], [2, 0], {"arc": {"to": [-2, 0], "through": [0, -1]}}, [0, 4]]},
        {"path": []},
        {"path": [{"arc": {"to": [2, 0], "through": [1, 1]}}]},
        {"circle": {"center": [0, 0], "radius": 1}, "holes": [{"circle": {"center": [5, 0], "radius": 1}}]},
        {"circle": {"center": [0, 0], "radius": 2}, "holes": [{"circle": {"center": [2, 0], "radius": 1}}]},
        {
            "circle": {"center": [0, 0], "radius": 9},
            "holes": [{"circle": {"center": [0, 0], "radius": r}} for r in (1, 2)],
        },
        {"outer": [[0, 0], {"arc": {"to": [2, 0], "through": [1, 1]}}], "grown": 0},
    ],
)  # fmt: skip
def test_round_shapes_that_are_none_are_refused_by_both(shape: dict[str, Any]) -> None:
    text = json.dumps({"robot": shape})
    with pytest.raises(CfreeError):
        scene_from_text("scene.json", text)
    with pytest.raises(check_answer.BadFileError):
        check_answer.read_scene(check_answer.decoded(text))
    with pytest.raises(check_answer.BadFileError, match="workspace"):
        text = json.dumps({"robot": [[0, 0], [1, 0], [0, 1]], "workspace": {"outer": box(0, 0, 9, 9)[0], "grown": 1}})
        check_answer.read_scene(check_answer.decoded(text))


def test_other_curves_are_refused_in_one_line_that_names_the_shape() -> None:
    path = text_of(Path(Pose(0, 0), [ACROSS], scene=Scene(UNIT)))
    for shape, name in (
        (Curved.ellipse((9, 9), (1, 2)), "an ellipse"),
        (Curved([(9, 9), Arc((7, 9), center=(8, 9), conjugate=(0, 2))]), "an arc of an ellipse"),
        (Curved([(9, 9), Bezier([(12, 9), (9, 12)])]), "a Bezier curve"),
        (Curved([(9, 9), Spline([(12, 9), (12, 12), (9, 12)])]), "a spline"),
    ):
        code, line = check_answer.verdict(scene_text(Scene(UNIT, [FLOOR, shape])), path)
        assert code == 2 and line == f"cannot be read: obstacles[1]: {name}; `cfree verify` reads it"


def test_answers_about_polygons_for_round_shapes_are_refused_in_one_line(tmp_path: FilePath) -> None:
    scene = Scene(UNIT, [box(-9, -1, 9, 1)[0]], bounds=(-8, -8, 8, 8), start=(0, 5, 0), goal=(0, -5, 0))
    save(plan(scene), tmp_path / "proof.json")
    code, line = check_answer.verdict(scene_text(scene), (tmp_path / "proof.json").read_text())
    assert code == 2 and "about polygons" in line and "`cfree verify` reads it" in line


def test_slides_among_round_shapes_are_refuted_by_both() -> None:
    scene, path = tee()
    beside = replace(scene, obstacles=[Curved.circle((50, 50), 1)], obstacle_names=None)
    assert not verified_in_a_file(beside, path).verified


def test_signs_of_sums_of_square_roots_are_exact() -> None:
    zero, two, eight = Fraction(0), Fraction(2), Fraction(8)
    assert check_answer.root_sign(Fraction(-3), (1, two), (1, Fraction(3)), (0, eight)) == 1
    assert check_answer.root_sign(zero, (1, two), (1, two), (-1, eight)) == 0
    assert check_answer.root_sign(-TINY, (1, two), (1, two), (-1, eight)) == -1
    assert check_answer.root_sign(zero, (1, two), (1, Fraction(18)), (-1, Fraction(32) + TINY**9)) == -1
    assert check_answer.root_sign(Fraction(-5), (1, Fraction(9)), (1, Fraction(4))) == 0
