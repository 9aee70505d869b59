from __future__ import annotations

import gc
import math
import pickle
import random
from collections.abc import Iterator
from copy import copy, deepcopy
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any
from weakref import ref

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import cfree.collision.motion_checker
import oracles
import shapes
import strategies
from cfree import (
    FreeSpace,
    InvalidPoseError,
    MotionChecker,
    Polygon,
    Pose,
    PoseChecker,
    Poses,
    Scene,
    Translation,
    boundary,
    free_space,
    is_free,
    is_free_motion,
    load_scene,
)
from cfree.collision.pose_checker import UNCERTAIN
from cfree.contact import is_forbidden
from cfree.scene.digest import stamp_of
from cfree.scene.features import scene_features
from cfree.scene.scene import with_ends
from compared import plain_of, scene_of
from examples import POLYGONS
from shapes import PlainScene

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
TRIANGLE = [(0, 0), (2, 0), (0, 1)]


def oracle(plain: PlainScene, pose: Pose) -> bool:
    robot, obstacles, bounds, workspace = plain
    return not oracles.exact_is_forbidden(robot, obstacles, pose.x, pose.y, pose.tau, bounds, workspace)


def contact_poses(scene: Scene, rng: random.Random, count: int) -> Iterator[Pose]:
    """A vertex on an edge, or vertices in one point, at a random angle: pseudo contacts, many of them contacts."""
    rings = [
        [(points[i:j], k) for i, j in pairwise(part.ring_offsets) for k in range(j - i)]
        for part in (scene.robot[0], rng.choice(scene.obstacles))
        for points in [part.exact_vertices]
    ]
    for _ in range(count):
        (a, i), (b, j) = rng.choice(rings[0]), rng.choice(rings[1])
        tau = rng.choice([Fraction(rng.randint(-9, 9), rng.randint(1, 9)), Fraction(0), Fraction(1), None])
        s, t = (Fraction(rng.randint(0, 6), 6), Fraction(0))[:: rng.choice([1, -1])]
        ((ax, ay), (cx, cy)) = Pose(0, 0, {"tau": tau}).apply_exact([a[i], a[(i + 1) % len(a)]])
        (bx, by), (dx, dy) = b[j], b[(j + 1) % len(b)]
        yield Pose(bx + t * (dx - bx) - ax - s * (cx - ax), by + t * (dy - by) - ay - s * (cy - ay), {"tau": tau})


def around(scene: Scene) -> tuple[float, float, float, float]:
    """A box of positions that reaches a little further than the scene."""
    shapes_ = [*scene.obstacles, *([scene.workspace] if scene.workspace else [])]
    points = np.concatenate([np.zeros((1, 2)), *(shape.vertices for shape in shapes_)])
    reach = 1.5 * max(float(np.hypot(*part.vertices.T).max()) for part in scene.robot)
    (x0, y0), (x1, y1) = points.min(axis=0) - reach, points.max(axis=0) + reach
    return x0, y0, x1, y1


def random_poses(scene: Scene, count: int, seed: int = 1) -> np.ndarray:
    x0, y0, x1, y1 = around(scene)
    return np.random.default_rng(seed).uniform((x0, y0, 0), (x1, y1, 2 * math.pi), (count, 3))


def thrice(scene: Scene | PoseChecker, poses: object) -> list[bool]:
    """By each pose itself, then by what has been found for the box of poses around it."""
    checker = PoseChecker(scene) if isinstance(scene, Scene) else scene
    answers = [checker.is_free(poses).tolist() for _ in range(3)]
    assert answers[0] == answers[1] == answers[2]
    return answers[0]


# beside exact oracles


@pytest.mark.slow
@settings(max_examples=150)
@given(plain=st.one_of(strategies.scenes(), strategies.bounded_scenes(), strategies.walled_scenes()),
       poses=st.lists(strategies.poses(), min_size=1, max_size=6), seed=st.integers(0, 10**6))  # fmt: skip
def test_degenerate_scenes_and_poses(plain: PlainScene, poses: list[tuple], seed: int) -> None:
    scene = scene_of(plain)
    checker = PoseChecker(scene)
    found = [Pose(x, y, {"tau": tau}) for x, y, tau in poses]
    if scene.obstacles:
        found += contact_poses(scene, random.Random(seed), 6)
    for pose in found:
        assert checker.is_free(pose) == oracle(plain, pose)
    rounded = Poses.from_poses(found)
    assert thrice(checker, rounded) == [oracle(plain, pose) for pose in rounded]


def test_poses_on_the_limits() -> None:
    """Where a grid ends: bounds on an obstacle, and workspaces, most of them squares."""
    rng = random.Random(1)
    for _ in range(60):
        width, height = (rng.randint(1, 999) / rng.choice((1, 2, 64, 10, 7)) for _ in "xy")
        height = rng.choice((width, width, height))
        x, y = (rng.choice((0, rng.uniform(-9, 9))) for _ in "xy")
        room = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
        robot = [(0, 0), (1, 0), (1, rng.choice((2, 0.3, 17))), (0, 2)]
        rim = Polygon([(x - 99, y - 99), (x + 1999, y - 99), (x + 1999, y + 1999), (x - 99, y + 1999)])
        among = Scene(robot, [rim], bounds=(x, y, x + width, y + height))
        for checker in (PoseChecker(among), PoseChecker(Scene(robot, workspace=room))):
            x0, y0, x1, y1 = map(float, checker.limits)
            poses = [(u, v, 0.0) for u in (x0, (x0 + x1) / 2, x1) for v in (y0, (y0 + y1) / 2, y1)]
            inside = [Pose(*pose) for pose in poses]
            assert checker.is_free(np.array(poses)).tolist() == [checker.is_free(pose) for pose in inside]


@pytest.mark.parametrize("kind", shapes.KINDS)
def test_random_scenes(kind: str) -> None:
    plain = shapes.random_scene(3, kind)
    scene = scene_of(plain)
    table = random_poses(scene, 150)
    poses = Poses(table[:, :2], table[:, 2])
    expected = [oracle(plain, pose) for pose in poses]
    assert 0 < sum(expected) < 150
    assert thrice(scene, poses) == expected


@pytest.mark.parametrize("seed", range(4))
def test_contacts_of_one_pair_and_one_hairline_off(seed: int) -> None:
    rng = random.Random(seed)
    robot, obstacle = (Polygon(*shapes.random_lattice_shape(rng)) for _ in range(2))
    scene = Scene(robot=robot, obstacles=obstacle)
    checker, answers = PoseChecker(scene), []
    for pose in contact_poses(scene, rng, 40):
        hair = Fraction(rng.choice([-1, 1]), 10**40)
        for moved in (
            pose,
            Pose(pose.x + hair, pose.y, {"tau": pose.tau}),
            Pose(pose.x, pose.y + hair, {"tau": pose.tau}),
        ):
            answers.append(checker.is_free(moved))
            assert answers[-1] != is_forbidden(robot, obstacle, moved)
    assert 0 < sum(answers) < len(answers)


def test_what_doubles_are_certain_of_is_true() -> None:
    """Poses 1e-9 to 1e-18 off contact: some certain, some not."""
    rng, certain, uncertain = random.Random(5), 0, 0
    for kind in ("nonconvex", "holed", "regular", "touching"):
        plain = shapes.random_scene(1, kind)
        scene = scene_of(plain)
        checker = PoseChecker(scene)
        for pose in contact_poses(scene, rng, 60):
            off = 10.0 ** -rng.uniform(9, 18)
            row = Poses([[float(pose.x) + off * rng.uniform(-1, 1), float(pose.y) + off]], [pose.theta])
            verdict = np.empty(1, np.uint8)
            checker._handle.check(np.column_stack([row.xy, row.theta]), 1, verdict)
            expected = oracle(plain, row[0])
            assert checker.is_free(row).tolist() == [expected]
            if verdict[0] == UNCERTAIN:
                uncertain += 1
            else:
                certain += 1
                assert verdict[0] == expected
    assert certain > 20 and uncertain > 20


@pytest.mark.parametrize("path", POLYGONS, ids=lambda path: path.stem)
def test_shipped_scenes_beside_areas_of_shapely(path: Path) -> None:
    scene = load_scene(path)
    robot, obstacles, bounds, workspace = plain_of(scene)
    if workspace:
        obstacles = [*obstacles, *oracles.complement(workspace, 4 * oracles.robot_radius(robot))]
    poses = random_poses(scene, 120, 7)
    for pose, free in zip(poses, thrice(scene, poses), strict=True):
        if bounds and not (bounds[0] <= pose[0] <= bounds[2] and bounds[1] <= pose[1] <= bounds[3]):
            assert not free
        else:
            assert free != oracles.overlaps(robot, obstacles, pose)


# touching is free


def test_a_slot_as_wide_as_the_robot() -> None:
    walls = [[(-1, -5), (0, -5), (0, 5), (-1, 5)], [(1, -5), (2, -5), (2, 5), (1, 5)]]
    checker = PoseChecker(Scene(robot=SQUARE, obstacles=walls))
    tiny = 5e-324
    rows = [(0, y, 0) for y in (-6, -1.5, 0, 4)] + [
        (tiny, 0, 0),
        (-tiny, 0, 0),
        (0, 0, 1e-300),
        (1, 1, math.pi),
        (0, 1, 0.1),
    ]
    assert thrice(checker, rows) == [True, True, True, True, False, False, False, True, False]


@pytest.mark.parametrize(("towards", "free"), [(math.inf, True), (0.0, False)])
def test_one_unit_in_the_last_place(towards: float, free: bool) -> None:
    scene = Scene(robot=SQUARE, obstacles=SQUARE)
    for x in (1.0, -1.0):
        assert is_free(scene, [[math.nextafter(x, math.copysign(towards, x)), 0.25, 0]]).tolist() == [free]
        assert is_free(scene, [[x, 0.25, 0]]).tolist() == [True]


def test_bounds_are_closed_and_exact() -> None:
    scene = Scene(robot=SQUARE, bounds=("1/3", 0, "2/3", 1))
    below, above = 1 / 3, 2 / 3  # both doubles are below the fractions
    rows = [
        (below, 0, 0),
        (math.nextafter(below, 1), 0, 0),
        (above, 1, 0),
        (math.nextafter(above, 1), 1, 0),
        (0.5, -1e-300, 0),
    ]
    assert is_free(scene, rows).tolist() == [False, True, True, False, False]
    assert is_free(scene, Pose("1/3", 0)) and not is_free(scene, Pose(Fraction(1, 3) - Fraction(1, 10**60), 0))


def test_outside_a_workspace_nothing_is_free_however_far() -> None:
    scene = Scene(robot=SQUARE, workspace=[(0, 0), (3, 0), (3, 3), (0, 3)])
    rows = [
        (0, 0, 0),
        (2, 2, 0),
        (2.5, 0, 0),
        (-1, 0, 0),
        (-1e3, 0, 1),
        (1e308, -1e308, 2),
        (1.5, 1.5, 1),
        (3, 3, math.pi),
    ]
    assert is_free(scene, rows).tolist() == [True, True, False, False, False, False, True, True]
    assert not is_free(scene, Pose(10**400, 0)) and is_free(Scene(robot=SQUARE, obstacles=SQUARE), Pose(10**400, 0))


@pytest.mark.parametrize("size", ["1e-140", "1e-9", "1e140"])
@pytest.mark.parametrize("far", [0, "1e9", "1e140"])
def test_any_size_and_place(size: str, far: str | int) -> None:
    a, x = Fraction(size), Fraction(far)
    square = [(p * a, q * a) for p, q in SQUARE]
    checker = PoseChecker(Scene(robot=square, obstacles=[[(x + p, q) for p, q in square]]))
    assert [checker.is_free(Pose(x + k * a / 8, a / 3)) for k in range(-9, 10, 1)] == [
        True,
        True,
        *[False] * 15,
        True,
        True,
    ]
    rows = [(float(x) + k * float(a), 0, 0) for k in (-5, -0.5, 0, 0.5, 5)]
    assert thrice(checker, rows) == [checker.is_free(Pose(*row)) for row in rows]


def test_ahead_of_the_tip_of_a_sliver() -> None:
    """So thin that doubles do not know which side of its edges a point is on."""
    sliver = [(0, 0), (1000, 0), (1000, Fraction(1, 10**15))]
    scene = Scene(robot=[(-1, -1), (1, -1), (1, 1), (-1, 1)], obstacles=sliver)
    rows = [(x, y, theta) for x in np.linspace(-8, 8, 33) for y in (0, 1e-17, 0.99, 1.0, 1.5) for theta in (0, 0.4)]
    expected = [not is_forbidden(scene.robot[0], scene.obstacles[0], Pose(*row)) for row in rows]
    assert thrice(scene, rows) == expected


# the call


def test_arrays_mean_the_poses_they_hold() -> None:
    scene = load_scene("examples/scenes/five_convex.json")
    table = np.random.default_rng(2).uniform((0, 0, -20), (12, 9, 20), (300, 3))
    poses = Poses(table[:, :2], table[:, 2])
    checker = PoseChecker(scene)
    expected = [checker.is_free(pose) for pose in poses]
    assert is_free(scene, table).tolist() == expected == checker.is_free(poses).tolist()
    assert 0 < sum(expected) < len(expected)


def in_all_forms(scene: Scene, x: float, y: float, theta: float) -> list[bool]:
    """One pose in doubles, given in each way, to a scene and to a checker."""
    row, answers = (x, y, theta), []
    for asked in (scene, PoseChecker(scene)):
        for poses in (row, list(row), np.array(row), Pose(*row), (Fraction(x), str(Fraction(y)), theta)):
            answers.append(is_free(asked, poses))
            assert type(answers[-1]) is bool
        for table in ([row], [list(row)], (row,), np.array([row]), Poses([row[:2]], [theta])):
            found = is_free(asked, table)
            assert found.shape == (1,) and found.dtype == bool
            assert found[0] == is_free(asked, Poses([row[:2]], [theta])[0])
    return answers


@pytest.mark.parametrize("seed", range(3))
def test_one_pose_in_doubles_has_the_verdict_of_its_exact_pose(seed: int) -> None:
    """Poses in contact, or all but so, at angles of all kinds: turned further by whole turns, negative, tiny, huge."""
    rng = random.Random(seed)
    plain = shapes.random_scene(seed, ("nonconvex", "holed", "touching")[seed])
    scene, contacts = scene_of(plain), 0
    for pose in contact_poses(scene, rng, 12):
        x, y = float(pose.x), float(pose.y)
        turned = (pose.theta - math.tau, pose.theta + 3 * math.tau, round(pose.theta / (math.pi / 2)) * math.pi / 2)
        for theta in (pose.theta, *turned, rng.choice((-1, 1)) * 10.0 ** rng.uniform(-320, 300), -0.0):
            expected = oracle(plain, Pose(x, y, theta))
            assert in_all_forms(scene, x, y, theta) == [expected] * 10
            contacts += any(oracle(plain, Pose(x + off, y, theta)) != expected for off in (-1e-9, 1e-9))
    assert contacts


def test_one_pose_goes_straight_to_the_core(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is checked, converted or divided among threads on the way; touching poses and turned ones included."""
    scene, motion = Scene(SQUARE, TRIANGLE, bounds=(-9, -9, 9, 9)), Translation((1, 0))
    space, checker, motions = free_space(boundary(scene)), PoseChecker(scene), MotionChecker(scene)
    for home, name in (
        (cfree.collision.pose_checker, "_is_free"),
        (cfree.collision.motion_checker, "_is_free_motion"),
        (PoseChecker, "_is_free"),
        (MotionChecker, "_is_free"),
        (FreeSpace, "_located"),
        (Pose, "__init__"),
    ):
        monkeypatch.setattr(home, name, None)
    far = (5.0, 2, -40.5)
    for pose in (far, (2.0, 0.0, 0.0), list(far), np.array(far)):
        for asked in (scene, checker):
            assert is_free(asked, pose) is True and is_free(asked, pose, threads=2) is True
        assert is_free_motion(scene, pose, motion) and motions.is_free(pose, motion) and space.locate(pose) == 0
    for table in ([far], np.array([far])):
        assert is_free(scene, table).tolist() == checker.is_free(table).tolist() == [True]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["five_convex", "degenerate_workspace", "nest_swim"])
def test_one_of_many_poses_is_as_free_as_all_at_once(name: str) -> None:
    scene = load_scene(f"examples/scenes/{name}.json")
    table = random_poses(scene, 20_000)
    table[:, 2] = np.where(np.arange(len(table)) % 3, table[:, 2], table[:, 2].round())
    at_once = is_free(copy(scene), table)
    assert [is_free(scene, row) for row in table] == [is_free(scene, tuple(row)) for row in table.tolist()]
    assert [is_free(scene, row) for row in table] == at_once.tolist() and 0 < at_once.sum() < len(table)


@pytest.mark.parametrize("bounds", [("1/3", "1/3", "2/3", "2/3"), (0.1, 0.1, 0.7, 0.7), (-1, -1, 1, 1)])
def test_limits_hold_exactly_for_one_pose(bounds: tuple) -> None:
    scene = Scene(SQUARE, [[(90, 90), (91, 90), (91, 91)]], bounds=bounds)
    low, high = (Fraction(bounds[k]) for k in (0, 2))
    for end, inwards in ((low, 1), (high, -1)):
        for off in (0, inwards * Fraction(1, 10**40), -inwards * Fraction(1, 10**40)):
            assert is_free(scene, Pose(end + off, (low + high) / 2)) == (low <= end + off <= high)
            assert is_free(scene, Pose((low + high) / 2, end + off)) == (low <= end + off <= high)
        for x in (float(end), math.nextafter(end, math.inf), math.nextafter(end, -math.inf)):
            assert is_free(scene, (x, 0.5, 0)) == (low <= Fraction(x) <= high and low <= 0.5 <= high)


@pytest.mark.parametrize(
    ("pose", "said"),
    [
        ((0.0, 0.0, math.nan), "poses: theta: nan is not finite"),
        ((math.inf, 0.0, 0.0), "poses: x: inf is not finite"),
        ((0.0, "north", 0.0), "poses: y: 'north' is no number"),
        ((0.0, True, 0.0), "poses"),
        (np.array([0, 0, math.nan]), "poses: theta: nan is not finite"),
        ((0.0, 0.0), "poses"),
        ([], "shape"),
    ],
)
def test_what_is_no_single_pose_is_refused_with_its_place(pose: Any, said: str) -> None:
    scene = Scene(SQUARE, SQUARE)
    for asked in (scene, PoseChecker(scene)):
        with pytest.raises((InvalidPoseError, TypeError), match=said):
            is_free(asked, pose)


def test_a_scene_keeps_its_checker_and_is_the_same_value() -> None:
    def values(scene: Scene) -> tuple[Any, ...]:
        return scene, hash(scene), repr(scene), pickle.dumps(scene), stamp_of(scene)

    asked, other = (Scene(SQUARE, TRIANGLE, bounds=(-5, -5, 5, 5), start=(2, 2, 0)) for _ in range(2))
    for ask in (lambda: is_free(asked, (3, 3, 0)), lambda: is_free_motion(asked, (3, 3, 0), Translation((1, 0)))):
        assert ask() and values(asked) == values(other)
    assert (
        PoseChecker(asked)._handle is PoseChecker(asked)._handle
        and MotionChecker(asked)._handle is MotionChecker(asked)._handle
    )
    for same in (copy(asked), deepcopy(asked), pickle.loads(pickle.dumps(asked)), replace_start(asked)):
        assert same == asked and not hasattr(same, "_kept")
        assert PoseChecker(same)._handle is not PoseChecker(asked)._handle
    larger = asked.grown(1)  # made of a copy
    assert is_free(asked, (3, 0, 0)) and is_free(larger, (2.5, 0, 0)) is False


def test_what_a_scene_keeps_ends_with_it() -> None:
    gc.collect()
    gc.disable()
    try:
        scene = Scene(SQUARE, TRIANGLE)
        assert is_free(scene, (3, 3, 0)) and is_free_motion(scene, (3, 3, 0), Translation((1, 0)))
        kept_features = ref(scene_features(scene).robot)
        del scene
        assert kept_features() is None
    finally:
        gc.enable()


def replace_start(scene: Scene) -> Scene:
    return with_ends(scene, scene.start, None)


def test_threads_and_what_was_prepared_change_nothing() -> None:
    scene = load_scene("examples/scenes/nest_shirts.json")
    poses = random_poses(scene, 20000)
    one = is_free(scene, poses, threads=1)
    built = boundary(load_scene("examples/scenes/five_convex.json"))
    assert (is_free(scene, poses, threads=3) == one).all() and 0 < one.sum() < len(one)
    assert (is_free(built.checker, poses) == is_free(built.scene, poses)).all()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sofa_corner", "degenerate_island", "nest_swim"])
def test_boxes_of_poses(name: str) -> None:
    """Where a box of poses is known to be free or forbidden, so is each pose in it."""
    scene = load_scene(f"examples/scenes/{name}.json")
    warm = PoseChecker(scene)
    x0, y0, x1, y1 = around(scene)
    corner, rng = (x0 + 0.4 * (x1 - x0), y0 + 0.4 * (y1 - y0), 1.0), np.random.default_rng(4)
    poses = rng.uniform(corner, (corner[0] + 0.1 * (x1 - x0), corner[1] + 0.1 * (y1 - y0), 1.5), (30000, 3))
    answers = [warm.is_free(poses) for _ in range(3)]
    exactly = [warm.is_free(pose) for pose in Poses(poses[:500, :2], poses[:500, 2])]
    assert (answers[0] == answers[2]).all() and answers[2][:500].tolist() == exactly
    cold = np.concatenate([PoseChecker(copy(scene)).is_free(part) for part in np.array_split(poses[:2000], 200)])
    assert (cold == answers[2][:2000]).all()


def test_nothing_at_all() -> None:
    scene = Scene(robot=TRIANGLE)
    assert is_free(scene, np.empty((0, 3))).shape == (0,)
    assert is_free(scene, [[1e308, 5, 1]]).tolist() == [True]


@pytest.mark.parametrize("poses", [[[1, 2, 3, 4]], [[1, 2]], [[0, 0, math.nan]], [[math.inf, 0, 0]]])
def test_what_is_no_pose_is_refused(poses: object) -> None:
    with pytest.raises(InvalidPoseError):
        is_free(Scene(robot=TRIANGLE), poses)  # type: ignore[call-overload]


def test_no_threads_are_refused() -> None:
    with pytest.raises(ValueError, match="threads: 0"):
        is_free(Scene(robot=TRIANGLE), [[0, 0, 0]], threads=0)


@pytest.mark.parametrize("far", [0, 10**9, Fraction(10**12, 7), -(10**9) - Fraction(1, 3)])
@pytest.mark.parametrize("height", [Fraction(1, 2**k) for k in (3, 20, 40, 70)])
def test_a_strip_thinner_than_doubles_tell_holds_the_robot_or_does_not(far: Fraction, height: Fraction) -> None:
    """Limits of the reference point are then the same double, or in the wrong order."""
    y = far + Fraction(3, 7)
    room = [(far, y), (far + 1, y), (far + 1, y + height), (far, y + height)]
    dart = [(0, 0), (height / 8, -height / 8), (-height / 8, -height / 8)]
    checker = PoseChecker(Scene(dart, workspace=room))
    x = far + Fraction(1, 2)
    for share, free in ((Fraction(1, 2), True), (Fraction(1), True), (Fraction(9, 8), False), (Fraction(1, 8), True)):
        assert checker.is_free(Pose(x, y + share * height)) is free
    assert checker.is_free(Pose(x, y + height / 16)) is False
