from __future__ import annotations

import math
import random
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import strategies
from cfree.collision.motion import Motion, Rotation, Translation, rotations
from cfree.collision.motion_checker import FirstContact, MotionChecker, is_free_motion
from cfree.collision.pose_checker import is_free
from cfree.contact.contact import VertexEdge
from cfree.errors import InvalidPoseError
from cfree.exact.pose import Pose
from cfree.exact.surd import Surd
from cfree.formats.scene_file import load_scene
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene
from moving import box, motions, poses, turning

BITS = 200  # two different critical parameters of small numbers are farther apart
F = Fraction


def roots(f: list[Fraction]) -> list[Surd]:
    """Of a quadratic polynomial with these values at 0, 1/2, 1."""
    c = f[0]
    b, a = 4 * f[1] - 3 * f[0] - f[2], 2 * (f[0] + f[2] - 2 * f[1])
    if a == 0:
        return [Surd(-c / b)] if b else []
    n = b * b - 4 * a * c
    if n < 0:
        return []
    d = n.denominator
    return [Surd(-b / (2 * a), sign / (2 * a * d), int(n * d * d)) for sign in (F(1), F(-1))]


def weight(motion: Motion, u: Fraction) -> Fraction:
    """Common denominator of a motion's points."""
    if isinstance(motion, Translation):
        return F(1)
    q, p = motion.half
    return ((1 - u) * motion.first + u * q) ** 2 + (u * p) ** 2


def reference(scene: Scene, pose: Pose, motion: Motion) -> Fraction | None:
    """Where a motion becomes forbidden, rounded down; by one exact pose between any two critical parameters."""
    at = [F(0), F(1, 2), F(1)]
    placed = [motion.at(pose, u) for u in at]
    critical = {F(0), F(1)}
    walls = [*scene.obstacles, *([scene.workspace] if scene.workspace else [])]
    for part in scene.robot:
        moved = [q.apply_exact(part.exact_vertices) for q in placed]
        for wall in walls:
            for (i, k), moving in ((pair, moves) for pair in enumerate(part.next.tolist()) for moves in (False, True)):
                for j, (x, y) in enumerate(wall.exact_vertices):
                    (x1, y1) = wall.exact_vertices[int(wall.next[j])]
                    values = []
                    for u, corners in zip(at, moved, strict=True):
                        (ax, ay), (bx, by) = corners[i], corners[k]
                        if moving:  # the corner (x, y) beside the robot's edge
                            side = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
                        else:
                            side = (x1 - x) * (ay - y) - (y1 - y) * (ax - x)
                        values.append(side * weight(motion, u))
                    critical |= {root.neighbours(BITS)[0] for root in roots(values)}
    for k, bound in enumerate(scene.bounds or ()):
        values = [((q.y if k % 2 else q.x) - bound) * weight(motion, u) for u, q in zip(at, placed, strict=True)]
        critical |= {root.neighbours(BITS)[0] for root in roots(values)}
    for u, v in pairwise(sorted(u for u in critical if 0 <= u <= 1)):
        if not is_free(scene, motion.at(pose, (u + v) / 2)):
            return u
    return None


def check(scene: Scene, pose: Pose, motion: Motion) -> FirstContact | None:
    checker = MotionChecker(scene)
    found, expected = checker.first_contact(pose, motion), reference(scene, pose, motion)
    assert checker.is_free(pose, motion) == (expected is None) == (found is None)
    assert checker.is_free(motion.apply(pose), motion.reversed()) == (expected is None)
    if found is not None:
        assert found.at.neighbours(BITS)[0] == expected
    return found


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(strategies.scenes(), poses, motions)
def test_motions_are_free_as_exact_poses_between_all_critical_ones_are(
    plain: strategies.PlainScene, pose: Pose, motion: Motion
) -> None:
    robot, obstacles = ([Polygon(*shape) for shape in shapes] for shapes in (plain.robot, plain.obstacles))
    check(Scene(robot=robot, obstacles=obstacles), pose, motion)


@settings(max_examples=30, deadline=None)
@given(strategies.convex_polygons(3), strategies.simple_polygons(6), poses, motions)
def test_bounds_and_workspaces_hold(
    robot: strategies.Shape, room: strategies.Shape, pose: Pose, motion: Motion
) -> None:
    scene = Scene(robot=Polygon(*robot), obstacles=[], workspace=Polygon(*room), bounds=(-3, -3, 3, 3))
    check(scene, pose, motion)


@pytest.mark.parametrize("seed", range(3))
def test_motions_from_poses_in_doubles_are_those_from_their_exact_poses(seed: int) -> None:
    """With bounds or a workspace or both, from within, on the rim, and far outside."""
    rng = random.Random(seed)
    room = [(-4, -4), (4, -4), (4, 4), (-4, 4)]
    limits = ({"bounds": (-3, -3, 3, 3)}, {"workspace": room}, {"workspace": room, "bounds": (-3, "-10/3", 3, 3)})[seed]
    scene = Scene([[(0, 0), (1, 0), (0, 1)], [(2, 0), (3, 0), (2, 1)]], [[(0, 2), (1, 2), (1, 3)]], **limits)
    checker, verdicts = MotionChecker(scene), []
    for _ in range(150):
        x, y = rng.randint(-40, 40) / 8, rng.choice((0, -3, rng.uniform(-9, 9), 1e9))
        theta = rng.choice((0.0, -2.5, 4.0))
        turn = rng.choice((0.5, "-90deg", {"tau": "inf"}, {"tau": "-inf"}))
        motion = rng.choice((Translation((rng.randint(-3, 3), "1/3")), Rotation((rng.randint(-3, 3), 0), turn)))
        pose = Pose(x, y, theta)
        expected = checker.first_contact(pose, motion) is None
        for start in (pose, (x, y, theta), [x, y, theta], np.array([x, y, theta]), (Fraction(x), y, theta)):
            assert checker.is_free(start, motion) == is_free_motion(scene, start, motion) == expected
        verdicts.append(expected)
    assert 10 < sum(verdicts) < 140


def test_nothing_is_free_beyond_the_frames() -> None:
    """Far outside of bounds or a workspace there is no obstacle in the way of a motion."""
    square, step = [(0, 0), (1, 0), (1, 1), (0, 1)], Translation((1, 0))
    for limits in ({"bounds": (-3, -3, 3, 3)}, {"workspace": [(-3, -3), (3, -3), (3, 3), (-3, 3)]}):
        checker = MotionChecker(Scene(square, [], **limits))
        for x in (0, 1, 2, Fraction(5, 2), 3, 4, 10, 19, 20, 21, 10**9, 10**40):
            is_within = x + 1 + ("workspace" in limits) <= 3
            assert checker.is_free(Pose(x, 0), step) == checker.is_free((float(x), 0, 0), step) == is_within


@pytest.mark.parametrize(
    "name", ["shared_edge", "identical", "square_pair", "two_part_robot", "workspace_with_hole", "l_in_u"]
)
def test_motions_in_degenerate_scenes(name: str) -> None:
    scene = load_scene(f"tests/cases/{name}.json")
    pose = scene.start or Pose(0, 0)
    for motion in (Translation((3, 0)), Translation((-1, 2)), Rotation((0, 0), "90deg"), Rotation((1, 1), "-180deg")):
        for x in (-3, 0, 2):
            check(scene, Pose(pose.x + x, pose.y), motion)


def test_a_rod_slides_through_a_corridor_of_its_width() -> None:
    walls = [box(-9, 1, 9, 2), box(-9, -2, 9, -1)]
    checker = MotionChecker(Scene(robot=box(-2, -1, 2, 1), obstacles=walls))
    assert checker.is_free(Pose(-20, 0), Translation((40, 0)))
    assert not checker.is_free(Pose(-20, 0), Translation((40, F(1, 10**30))))
    assert not checker.is_free(Pose(0, 0), Rotation((0, 0), {"tau": F(1, 10**30)}))
    assert checker.is_free(Pose(0, 0), Rotation((0, 0), 0))
    assert checker.is_free(Pose(0, 0, "180deg"), Translation((-40, 0)))
    turned = Pose(0, 0, {"tau": "1/3"})  # the same corridor along (4, 3)
    walls = [Polygon(turned.apply_exact(wall.exact_vertices)) for wall in walls]
    checker = MotionChecker(Scene(robot=box(-2, -1, 2, 1), obstacles=walls))
    assert checker.is_free(turned, Translation((40, 30)))
    assert not checker.is_free(turned, Translation((40, F(30) + F(1, 10**30))))


def test_a_polygon_turns_in_the_hull_of_its_circle() -> None:
    """The robot's corners are on a circle that the walls of an octagonal hole touch."""
    robot = Polygon([(5, 0), (3, 4), (-3, 4), (-5, 0), (-3, -4), (3, -4)])
    outer = [(9, 9), (-9, 9), (-9, -9), (9, -9)]
    directions = [
        (1, 0),
        (F(3, 5), F(4, 5)),
        (0, 1),
        (F(-3, 5), F(4, 5)),
        (-1, 0),
        (F(-3, 5), F(-4, 5)),
        (0, -1),
        (F(3, 5), F(-4, 5)),
    ]

    def hole(radius: Fraction) -> list[tuple[Fraction, Fraction]]:
        corners = []
        for (a, b), (c, d) in pairwise([*directions, directions[0]]):
            det = F(a * d - b * c)
            corners.append((radius * (d - b) / det, radius * (a - c) / det))
        return corners

    for radius, free in ((F(5), True), (5 - F(1, 10**25), False)):
        checker = MotionChecker(Scene(robot=robot, obstacles=Polygon(outer, [hole(radius)])))
        start = Pose(0, 0, {"tau": "1/7"})
        for turn in rotations((0, 0), "360deg"):
            assert checker.is_free(start, turn) == free
            start = turn.apply(start)


@pytest.mark.parametrize("reverse", [False, True])
def test_first_contacts_name_the_features(reverse: bool) -> None:
    room = [(-5, -5), (5, -5), (5, 5), (-5, 5)]
    scene = Scene(
        robot=[[(-9, -9), (-8, -9), (-8, -8)], [(-1, 0), (0, -1), (1, 0), (0, 1)]][::-1],
        obstacles=[[(3, 1), (3, -1), (4, 0)], [(-3, 0), (-4, 1), (-4, -1)]],
        workspace=[(x * 10, y * 10) for x, y in room[:: -1 if reverse else 1]],
    )
    checker = MotionChecker(scene)

    def contact(motion: Motion) -> tuple[Surd, int, int, object]:
        found = checker.first_contact(Pose(0, 0), motion)
        assert found is not None
        return found.at, found.robot, found.obstacle, found.contact

    at, robot, obstacle, met = contact(Translation((4, 0)))
    assert (at, robot, obstacle) == (Surd("1/2"), 0, 0) and isinstance(met, VertexEdge)
    assert scene.robot[0].exact_vertices[met.i] == (1, 0)
    assert abs(scene.obstacles[0].edge(met.j)).tolist() == [0, 2]
    at, robot, obstacle, met = contact(Translation((-4, 0)))
    assert (at, robot, obstacle) == (Surd("1/2"), 0, 1)
    at, robot, obstacle, met = contact(Translation((0, 98)))
    assert (at, robot, obstacle) == (Surd("1/2"), 0, -2) and isinstance(met, VertexEdge)
    assert scene.robot[0].exact_vertices[met.i] == (0, 1)
    assert scene.workspace is not None
    j = met.j
    assert {scene.workspace.exact_vertices[k] for k in (j, int(scene.workspace.next[j]))} == {(50, 50), (-50, 50)}


def test_the_angle_of_the_first_contact_is_that_of_a_sine() -> None:
    rod = Polygon([(0, -1), (7, -1), (7, 0), (0, 0)])
    for height in (1, 2, 3, 5, 6):
        scene = Scene(robot=rod, obstacles=box(-20, height, 20, 30))
        turn = Rotation((0, 0), "90deg")
        found = MotionChecker(scene).first_contact(Pose(0, 0), turn)
        assert found is not None
        u = float(found.at)
        assert 2 * math.atan(u / ((1 - u) * turn.first + u)) == pytest.approx(math.asin(height / 7), abs=1e-14)


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(poses, motions)
def test_motions_are_displacements(pose: Pose, motion: Motion) -> None:
    end = motion.apply(pose)
    assert motion.at(pose, 0) == pose and motion.at(pose, 1) == end
    assert motion.reversed().apply(end) == pose
    samples = motion.sample(pose, np.array([0.0, 1.0]))
    assert np.allclose(samples.xy, [[float(pose.x), float(pose.y)], [float(end.x), float(end.y)]], atol=1e-12)
    assert math.remainder(samples.theta[1] - end.theta, math.tau) == pytest.approx(0, abs=1e-12)
    if isinstance(motion, Rotation):
        middle = motion.at(pose, F(1, 2))
        for q in (middle, end):
            arm, other = ((p.x - motion.pole[0], p.y - motion.pole[1]) for p in (pose, q))
            assert arm[0] ** 2 + arm[1] ** 2 == other[0] ** 2 + other[1] ** 2


@pytest.mark.slow
@given(
    poses,
    st.one_of(motions, st.sampled_from([turning(), turning("-1/5"), turning(1).between("1/3", 1)])),
    st.floats(0, 1),
)
def test_motions_of_all_kinds_agree_on_shares_and_lengths(pose: Pose, motion: Motion, share: float) -> None:
    u = motion.parameter(share)
    exact, rounded = motion.at(pose, u), motion.sample(pose, [share])[0]
    assert (float(exact.x), float(exact.y)) == pytest.approx((float(rounded.x), float(rounded.y)), abs=1e-9)
    assert math.remainder(exact.theta - rounded.theta, math.tau) == pytest.approx(0, abs=1e-9)
    assert motion.share(u) == pytest.approx(share if motion.turn or motion.kind == "translation" else 0.0, abs=1e-9)
    corners = [(0, 0), (3, 0), (3, 1)]
    placed = motion.sample(pose, np.linspace(0, 1, 400)).apply(corners)
    ways = np.linalg.norm(np.diff(placed, axis=0), axis=2).sum(axis=0)
    assert ways[0] == pytest.approx(motion.length(pose), rel=1e-3, abs=1e-9)
    reach = motion.reach(pose, corners)
    assert reach >= ways.max() - 1e-9 if motion.kind == "slide" else reach == pytest.approx(ways.max(), rel=1e-4)


@given(st.floats(-30, 30))
def test_long_turns_are_divided(angle: float) -> None:
    parts = rotations((1, 2), angle)
    assert math.fsum(part.turn for part in parts) == pytest.approx(angle, abs=1e-12)
    assert all(part.clockwise == (angle < 0) for part in parts)


def test_faults_of_motions_name_the_remedy() -> None:
    with pytest.raises(InvalidPoseError, match=r"half a turn; divide it, as cfree\.collision\.rotations does"):
        Rotation((0, 0), "181deg")
    with pytest.raises(InvalidPoseError, match=r"vector: .*; give two finite numbers"):
        Translation((1, math.inf))
    with pytest.raises(InvalidPoseError, match="'1e9' is more than 1000 half turns; give less"):
        rotations((0, 0), "1e9")
    with pytest.raises(InvalidPoseError, match="pole"):
        Rotation((1, 2, 3), 1)  # type: ignore[arg-type]


@pytest.mark.parametrize("unit", [F(10) ** 140, F(1, 10**140), F(10**20 + 1, 3**30)])
def test_units_do_not_matter(unit: Fraction) -> None:
    """The corridor, the turning rod and their poses, much larger, much smaller, and with long numbers."""
    walls = [box(-9 * unit, unit, 9 * unit, 2 * unit), box(-9 * unit, -2 * unit, 9 * unit, -unit)]
    checker = MotionChecker(Scene(robot=box(-2 * unit, -unit, 2 * unit, unit), obstacles=walls))
    for far in (1, 10**200):
        assert checker.is_free(Pose(-20 * unit * far, 0), Translation((40 * unit * far, 0)))
        assert not checker.is_free(Pose(-20 * unit * far, 0), Translation((40 * unit * far, unit / 10**9)))
        assert not checker.is_free(Pose(0, 0), Rotation((0, far * unit), {"tau": F(1, 10**30)}))
        assert checker.is_free(Pose(0, 5 * unit), Rotation((0, unit), {"tau": F(1, 10**30)}))
    found = checker.first_contact(Pose(0, 5 * unit), Translation((0, -4 * unit)))
    assert found is not None and found.at == Surd(F(1, 2)) and found.obstacle == 0
