"""Plans against closed forms, floods, and each other: every path free, every refusal proved."""

from __future__ import annotations

import math
from fractions import Fraction
from functools import cache
from itertools import pairwise
from pathlib import Path as FilePath
from typing import Any

import numpy as np
import pytest

from cfree import (
    InvalidPoseError,
    MotionChecker,
    Path,
    Planner,
    Polygon,
    Pose,
    Poses,
    Rotation,
    Scene,
    Separated,
    Slide,
    Translation,
    boundary,
    clearance,
    free_space,
    load_scene,
    motion_between,
    plan,
    plan_many,
)
from cfree.planning.options import Options
from cfree.planning.pose_planner import PosePlanner
from cfree.verify import answer
from compared import plain_of, scene_of
from examples import EXAMPLES
from flood import flood
from shapes import KINDS, Shape, random_scene

ROOT = FilePath(__file__).parents[2]
CLEARANCES = [Fraction(1, 10**k) for k in (1, 3, 6, 9, 12)]

Case = tuple[Scene, Pose, Pose]


def checked(scene: Scene, start: Pose, goal: Pose) -> Path | Separated:
    """The answer, after its own evidence was looked at."""
    found = plan(scene, start, goal)
    assert (found.start, found.goal) == (start, goal)
    result = answer(scene, found)
    assert result.verified, result.findings
    return found


# --- widths at which the answer changes, known in closed form ---


def turned_corner(clearance: Fraction) -> Case:
    """A rod of 8 x 1 round a right angle: critical where it is level, in a corridor whose walls rise at 45 degrees.

    Its upper corners are then on the outer walls y = -|x|, and its lower edge is 5 below the outer corner.
    """
    d, R = 5 + clearance, 40
    workspace = [(-R, -R), (-R, -R - d), (0, -d), (R, -R - d), (R, -R), (0, 0)]
    scene = Scene(robot=[(-4, 0), (4, 0), (4, 1), (-4, 1)], obstacles=[], workspace=workspace)
    return scene, Pose(-25, -28, "45deg"), Pose(25, -28, "-45deg")


def slot(clearance: Fraction) -> Case:
    """A square through a slot as wide as it."""
    w = 2 + clearance
    walls = [[(-9, -9), (0, -9), (0, 20), (-9, 20)], [(w, -9), (12, -9), (12, 20), (w, 20)]]
    scene = Scene(robot=[(0, 0), (2, 0), (2, 2), (0, 2)], obstacles=walls, bounds=(-6, -30, 10, 40))
    return scene, Pose(0, -20), Pose(-5, 30)


def channel(clearance: Fraction) -> Case:
    """A square round a corner, in a channel as wide as it: it can only be pushed."""
    w = 2 + clearance
    workspace = [(0, 0), (20, 0), (20, w), (w, w), (w, 20), (0, 20)]
    if clearance < 0:  # room for start and goal
        workspace[1:3] = [(15, 0), (15, -9), (30, -9), (30, 9), (15, 9), (15, w)]
        workspace[-2:] = [(w, 15), (9, 15), (9, 30), (-9, 30), (-9, 15), (0, 15)]
    return Scene(robot=[(0, 0), (2, 0), (2, 2), (0, 2)], obstacles=[], workspace=workspace), Pose(17, 0), Pose(0, 17)


def peg(clearance: Fraction) -> Case:
    """A peg with a broad head into a blind hole."""
    half = 1 + clearance / 2
    peg = [(-1, 0), (1, 0), (1, 5), (3, 5), (3, 7), (-3, 7), (-3, 5), (-1, 5)]
    block = [(-10, -10), (10, -10), (10, 0), (half, 0), (half, -6), (-half, -6), (-half, 0), (-10, 0)]
    return Scene(robot=peg, obstacles=[block], bounds=(-15, -15, 15, 15)), Pose(-8, 8, "90deg"), Pose(0, -5)


def gap(clearance: Fraction) -> Case:
    """Nearly a disc, 6 wide at its narrowest, through a gap."""
    octagon = [(3, 2), (2, 3), (-2, 3), (-3, 2), (-3, -2), (-2, -3), (2, -3), (3, -2)]
    half = 3 + clearance / 2
    walls = [[(-1, half), (1, half), (1, 60), (-1, 60)], [(-1, -half), (-1, -60), (1, -60), (1, -half)]]
    return Scene(robot=octagon, obstacles=walls, bounds=(-20, -20, 20, 20)), Pose(-10, 5), Pose(10, -5, "30deg")


FAMILIES = {"corner": turned_corner, "slot": slot, "gap": gap, "channel": channel, "peg": peg}


@pytest.mark.slow
@pytest.mark.parametrize("name", FAMILIES)
@pytest.mark.parametrize("clearance", [*CLEARANCES, Fraction(0)], ids=lambda c: f"{float(c):g}")
def test_what_fits_gets_through(name: str, clearance: Fraction) -> None:
    found = checked(*FAMILIES[name](clearance))
    assert isinstance(found, Path)
    assert len(found.motions) < 150


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(FAMILIES.keys() - {"peg"}))
@pytest.mark.parametrize("clearance", CLEARANCES, ids=lambda c: f"-{float(c):g}")
def test_what_does_not_fit_is_proved_apart(name: str, clearance: Fraction) -> None:
    found = checked(*FAMILIES[name](-clearance))
    assert isinstance(found, Separated)
    assert found.of == "closed"


@pytest.mark.slow
@pytest.mark.parametrize("sign", [1, -1])
def test_a_rectangle_round_an_upright_corner(sign: int) -> None:
    """The longest one of width b in corridors of width w is 2 (sqrt(2) w - b) long."""
    w, b = 3, 1
    for digits in (1, 3, 6, 9, 12):
        longest = Fraction(math.isqrt(2 * 10**60)) / 10**30 * 2 * w - 2 * b  # below by less than 1e-29
        length = longest - sign * Fraction(1, 10**digits)
        workspace = [(0, 0), (40, 0), (40, w), (w, w), (w, 40), (0, 40)]
        scene = Scene(robot=[(0, 0), (length, 0), (length, b), (0, b)], obstacles=[], workspace=workspace)
        found = checked(scene, Pose(20, 1), Pose(1, 30, "-90deg"))
        assert isinstance(found, Path if sign > 0 else Separated), digits


@pytest.mark.slow
@pytest.mark.parametrize(
    ("size", "offset"),
    [(Fraction(1, 10**120), 0), (Fraction(10) ** 120, 0), (Fraction(1, 3**40), 0), (Fraction(1), 10**9)],
    ids=["tiny", "huge", "thirds", "far away"],
)
def test_sizes_and_places_do_not_matter(size: Fraction, offset: int) -> None:
    """Neither for the decision nor for the evidence."""
    for gap in (Fraction(1, 1000), Fraction(0), Fraction(-1, 1000)):
        scene, *ends = turned_corner(gap)
        assert scene.workspace
        start, goal = (Pose(size * q.x + offset, size * q.y + offset, {"tau": q.tau}) for q in ends)
        corners = [(size * x + offset, size * y + offset) for x, y in scene.workspace.exact_vertices]
        robot = [(size * x, size * y) for x, y in scene.robot[0].exact_vertices]
        found = checked(Scene(robot, workspace=corners), start, goal)
        assert isinstance(found, Path) == (gap >= 0)


# --- random scenes ---


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
def test_decisions_are_those_of_a_flood(kind: str) -> None:
    for seed in range(1):
        plain = random_scene(seed, kind)
        scene = scene_of(plain)
        space = free_space(boundary(scene, threads=1))
        found = flood(plain, 60)
        poses = list(Poses(found.xy, found.theta))
        rng = np.random.default_rng(seed)
        for _ in range(6 if poses else 0):
            i, j = rng.integers(len(poses), size=2).tolist()
            planned = plan(space, poses[i], poses[j])
            if isinstance(planned, Path):
                assert found.possible[i] == found.possible[j]
                check_densely(scene, planned)
            else:
                assert found.certain[i] != found.certain[j]


def check_densely(scene: Scene, path: Path) -> None:
    """By poses along it, exactly."""
    from cfree import is_free

    assert path.is_free(MotionChecker(scene))
    for k in range(len(path.motions)):
        for share in range(11):
            assert is_free(scene, path.at(k + Fraction(share, 10)))


def reachable(scene: Scene) -> bool:
    assert scene.start and scene.goal
    return isinstance(plan(scene), Path)


@cache
def random_questions(count: int) -> tuple[Scene, ...]:
    """Scenes with start and goal, in cells of their own as often as in one."""
    scenes = []
    for seed in range(count):
        plain = random_scene(seed, KINDS[seed % len(KINDS)])
        found = flood(plain, 45)
        if len(found.theta) < 2:
            continue
        rng = np.random.default_rng(seed)
        i, j = rng.integers(len(found.theta), size=2).tolist()
        poses = Poses(found.xy, found.theta)
        scenes.append(replaced(scene_of(plain), start=poses[i], goal=poses[j]))
    return tuple(scenes)


def replaced(scene: Scene, **parts: Any) -> Scene:
    names = ("robot", "obstacles", "bounds", "workspace", "start", "goal")
    return Scene(**{name: getattr(scene, name) for name in names} | parts)


@pytest.mark.slow
@pytest.mark.long
def test_fewer_obstacles_never_separate() -> None:
    for scene in random_questions(8):
        if reachable(scene):
            for k in range(len(scene.obstacles)):
                rest = [polygon for i, polygon in enumerate(scene.obstacles) if i != k]
                assert reachable(replaced(scene, obstacles=rest))


@pytest.mark.slow
def test_the_way_back_exists_as_the_way_there_does() -> None:
    for scene in random_questions(8):
        assert scene.start and scene.goal
        assert isinstance(plan(scene, scene.goal, scene.start), Path) == reachable(scene)


@pytest.mark.slow
def test_moving_everything_changes_nothing() -> None:
    turn = Pose(3, "-7/2", {"tau": "1/3"})
    for scene in random_questions(8):
        if scene.bounds is not None:
            continue
        assert scene.start and scene.goal
        plain = plain_of(scene)
        image = {
            "obstacles": [carried(turn, shape) for shape in plain.obstacles],
            "workspace": None if plain.workspace is None else carried(turn, plain.workspace),
        }
        moved = replaced(scene, **image, start=turn @ scene.start, goal=turn @ scene.goal)
        assert reachable(moved) == reachable(scene)


def carried(turn: Pose, shape: Shape) -> Polygon:
    outer, holes = shape
    return Polygon(turn.apply_exact(outer), [turn.apply_exact(hole) for hole in holes])


@pytest.mark.slow
def test_a_smaller_robot_is_never_separated() -> None:
    """Of triangles around their reference point, smaller ones are inside."""
    for seed in range(8):
        plain = random_scene(seed, "touching")
        triangle = [(-1, -1), (1, -1), (0, 1)]
        sizes = [Fraction(k, 4) for k in range(1, 7)]
        found = flood(plain, 45)
        rng = np.random.default_rng(seed)
        answers = []
        for size in sizes:
            scene = replaced(scene_of(plain), robot=[(x * size, y * size) for x, y in triangle])
            poses = Poses(found.xy, found.theta)
            i, j = rng.integers(len(poses), size=2).tolist()
            answers.append((scene, poses[i], poses[j]))
        for (scene, start, goal), (less, _, _) in zip(answers[1:], answers, strict=False):
            checker = MotionChecker(scene)
            if all(checker.is_free(pose, Translation((0, 0))) for pose in (start, goal)) and isinstance(
                plan(scene, start, goal), Path
            ):
                assert isinstance(plan(less, start, goal), Path)


# --- what users do ---


def test_a_forbidden_pose_is_named() -> None:
    scene = Scene(robot=[(0, 0), (1, 0), (0, 1)], obstacles=[[(0, 0), (2, 0), (0, 2)]])
    with pytest.raises(InvalidPoseError, match=r"start .* is forbidden"):
        plan(scene, Pose(0, 0), Pose(5, 5))
    with pytest.raises(InvalidPoseError, match="no goal"):
        plan(scene, Pose(5, 5))


@pytest.mark.slow
def test_many_queries_have_the_answers_of_single_ones() -> None:
    scene = load_scene(ROOT / "examples/scenes/flat.json")
    space = free_space(boundary(scene))
    rng = np.random.default_rng(3)
    x0, y0, x1, y1 = map(float, scene.bounds or (0, 0, 10, 10))
    poses = [Pose(rng.uniform(x0, x1), rng.uniform(y0, y1), rng.uniform(0, 6)) for _ in range(60)]
    poses = [pose for pose in poses if space.locate(pose) >= 0]
    queries = list(pairwise(poses))
    answers = plan_many(space, queries, threads=2)
    for (start, goal), found in zip(queries, answers, strict=True):
        single = plan(space, start, goal)
        assert (type(found), found.start, found.goal) == (type(single), start, goal)
        if isinstance(single, Path):
            assert found == single


@pytest.mark.slow
def test_threads_do_not_change_answers_through_exact_fits() -> None:
    scene, start, goal = slot(Fraction(0))
    queries = [(start, Pose(goal.x + Fraction(k, 7), goal.y - Fraction(k, 3), f"{10 * k}deg")) for k in range(6)]
    for _ in range(3):
        space = free_space(boundary(scene))
        found = plan_many(space, queries, threads=6)
        assert [type(answer) for answer in found] == [Path] * 6


def test_a_forbidden_pose_is_forbidden_to_itself_too() -> None:
    scene = Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=[[(-1, -1), (2, -1), (2, 2), (-1, 2)]])
    for start in (Pose(0, 0), Pose("1/2", "1/2", "45deg")):
        with pytest.raises(InvalidPoseError, match="forbidden"):
            plan(scene, start, start)
        with pytest.raises(InvalidPoseError, match=r"query 0: start .* forbidden"):
            plan_many(scene, [(start, start)])
    assert plan(scene, Pose(5, 5), Pose(5, 5)).motions == ()  # type: ignore[union-attr]


T = [(-9, 0), (9, 0), (9, 2), (1, 2), (1, 9), (-1, 9), (-1, 2), (-9, 2)]


@pytest.mark.slow
@pytest.mark.parametrize("start", [Pose(-5, 1), Pose(0, 1), Pose(0, 5, "180deg")])
@pytest.mark.parametrize("goal", [Pose(5, 1, "90deg"), Pose(0, 7), Pose(0, "1.5", "45deg")])
def test_a_square_turns_in_a_junction_of_corridors_as_wide_as_it(start: Pose, goal: Pose) -> None:
    """Next to the upright square there is no room for a rotation: two contacts slide."""
    scene = Scene(robot=[(-1, -1), (1, -1), (1, 1), (-1, 1)], obstacles=[], workspace=T)
    found = checked(scene, start, goal)
    assert isinstance(found, Path)
    turns = (goal.theta - start.theta) % math.tau > 0
    assert any(isinstance(motion, Slide) for motion in found.motions) == turns
    assert clearance(found, scene).least == 0
    back = checked(scene, goal, start)
    assert isinstance(back, Path)


def feet_on_walls() -> Scene:
    """Three feet slide on three walls: free without room, at each angle between two irrational ones one point."""
    half = Fraction(1, 2)
    feet = [
        [(4, 8), (5, 8 - half), (5, 8 + half)],
        [(4, 0), (4 + half, 1), (4 - half, 1)],
        [(0, 4), (-1, 4 - half), (-half, 3)],
    ]
    walls = [
        [(-1, 6), (0, 6), (0, 10), (-1, 10)],
        [(-2, -1), (2, -1), (2, 0), (-2, 0)],
        [(-6, 6), (-2, 2), (-1, 3), (-5, 7)],
    ]
    return Scene(robot=feet, obstacles=walls)


@pytest.mark.slow
def test_three_feet_slide_on_three_walls_and_off_them() -> None:
    scene, middle = feet_on_walls(), Pose(-4, 0)
    checker = MotionChecker(scene)
    assert checker.joins([middle, middle])
    for goal in (Pose(100, 100), Pose(-100, 0, 1)):
        found = checked(scene, middle, goal)
        assert isinstance(found, Path) and isinstance(found.motions[0], Slide)
        assert isinstance(checked(scene, goal, middle), Path)
    # a pose on the curve: where two feet keep their contacts
    (slide,) = (m for m in checked(scene, middle, Pose(100, 100)).motions[:1])
    near = slide.at(middle, "1/2")
    found = checked(scene, middle, near)
    assert isinstance(found, Path) and [type(m) for m in found.motions] == [Slide]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"objective": "fast"}, "objective: 'fast'; give"),
        ({"improve": -1}, "improve -1"),
        ({"improve": math.nan}, "improve nan"),
        ({"goal": Pose(10**200, 0)}, "beyond 1e150"),
    ],
)
def test_bad_wishes_are_refused(options: dict[str, Any], message: str) -> None:
    scene = Scene(robot=[(0, 0), (1, 0), (1, 1)], start=Pose(0, 0), goal=Pose(1, 1))
    with pytest.raises(ValueError, match=message):
        plan(scene, **options)


def test_improving_makes_shorter_paths() -> None:
    scene = load_scene(ROOT / "examples/scenes/five_convex.json")
    first, better = plan(scene, objective="short"), plan(scene, objective="short", improve=0.2)
    assert isinstance(first, Path)
    assert isinstance(better, Path)
    scale = Planner(scene).angle_scale
    assert better.length + scale * better.turning < first.length + scale * first.turning
    assert better.is_free(MotionChecker(scene))


def test_between_two_poses_is_one_motion() -> None:
    rng = np.random.default_rng(1)
    for _ in range(50):
        a, b = (Pose(*rng.uniform(-3, 3, 3)) for _ in range(2))
        assert motion_between(a, b).apply(a) == b
    assert isinstance(motion_between(Pose(0, 0), Pose(1, 0)), Translation)
    half = motion_between(Pose(0, 0), Pose(2, 0, "180deg"))
    assert isinstance(half, Rotation)
    assert half.pole == (1, 0)


@pytest.mark.slow
@pytest.mark.parametrize(
    "path",
    [pytest.param(path, marks=pytest.mark.slow if path.stem == "round_gap" else ()) for path in EXAMPLES],
    ids=lambda path: path.stem,
)
def test_every_example_has_an_answer_that_verifies(path: FilePath) -> None:
    scene = load_scene(path)
    if scene.start is not None and scene.goal is not None:
        found = checked(scene, scene.start, scene.goal)
        assert isinstance(found, Path) == (path.stem not in ("nest_swim", "street_Berlin", "round_gap"))


def test_numbers_of_clear_paths_are_short() -> None:
    """Places on motions to places on motions to places had ever more digits: 2,800 here, and files hold 4,000."""

    def thirds(*rings: list[tuple[int, int]]) -> Polygon:
        outer, hole = ([(Fraction(x, 3), Fraction(y, 3)) for x, y in ring] for ring in rings)
        return Polygon(outer, [hole])

    robot = thirds([(1, -4), (1, 0), (-3, 0), (-3, -4)], [(0, -3), (-1, -3), (-2, -2), (-1, -1), (0, -1)])
    one = thirds([(4, 1), (0, 1), (0, -3), (4, -3)], [(1, -2), (1, -1), (2, 0), (3, -1), (3, -2)])
    other = thirds([(-3, -2), (1, -2), (1, 2), (-3, 2)], [(0, 1), (0, 0), (-1, -1), (-2, 0), (-2, 1)])
    ends = Pose(-2, -7, "180deg"), Pose("-8/7", "5/3", "90deg")
    path = plan(Scene([robot], [one, other]), *ends, objective="clear", improve=0)
    assert isinstance(path, Path)
    assert max(c.denominator.bit_length() for q in path.poses for c in (q.x, q.y, q.tau or q.x)) < 200


def test_a_ray_that_links_surfaces_may_be_along_a_level_edge() -> None:
    diamonds = [[(x - 1, y), (x, y - 1), (x + 1, y), (x, y + 1)] for x, y in ((0, 0), (10, 2))]
    scene = Scene([(0, 0), (2, 0), (0, 1)], diamonds)
    way = PosePlanner(scene).walk(Pose(-9, 0), Pose(20, 0), Options())
    assert way and (way[0], way[-1]) == (Pose(-9, 0), Pose(20, 0)) and MotionChecker(scene).joins(way)
