"""OMPL's own planners with exact checks: what they accept is free; the conservative check of even motions."""

from __future__ import annotations

import importlib
import math
import subprocess
import sys
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import oracles
from cfree import (
    Car,
    DifferentialDrive,
    InvalidPoseError,
    MotionChecker,
    Pose,
    PoseChecker,
    Rotation,
    Scene,
    Translation,
    is_drivable,
    load_scene,
)
from compared import plain_of, scene_of
from shapes import KINDS, box, random_scene

ROOT = Path(__file__).parents[1]


@pytest.fixture
def exact() -> Any:
    pytest.importorskip("ompl", reason="the extra `ompl` is not installed")
    from ompl import util

    util.setLogLevel(util.LogLevel.LOG_ERROR)
    return importlib.import_module("cfree.ompl")


def test_without_ompl_there_is_one_clear_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ompl", None)
    monkeypatch.delitem(sys.modules, "cfree.ompl", raising=False)
    with pytest.raises(ImportError, match=r"pip install 'cfree\[ompl\]'"):
        importlib.import_module("cfree.ompl")


ROOM = Scene(
    robot=box(-2, "-1/2", 2, "1/2")[0],
    obstacles=[box(0, 0, 1, 8)[0], box(4, 3, 5, 12)[0]],
    bounds=(-6, -2, 12, 12),
    start=Pose(-4, 5),
    goal=Pose(9, 6, "180deg"),
)


PLANNERS = ["RRTConnect", "RRT", "RRTstar", "PRM", "KPIECE1", "LBKPIECE1"]


@pytest.mark.parametrize("planner", PLANNERS)
@pytest.mark.parametrize("kind", ["linear", "rotation"])
def test_what_planners_find_is_free(exact: Any, planner: str, kind: str) -> None:
    from ompl import geometric

    setup = exact.simple_setup(ROOM)
    si, checker = setup.getSpaceInformation(), MotionChecker(ROOM)
    setup.setPlanner(getattr(geometric, planner)(si))
    if kind == "rotation":
        si.setMotionValidator(exact.MotionValidator(si, checker))
    setup.solve(1.0 if planner == "RRTstar" else 10.0)
    if not setup.haveExactSolutionPath():
        pytest.skip("no solution in time")
    path = setup.getSolutionPath()
    found = exact.to_path(path, ROOM)
    assert found.is_free(checker)
    assert (found.start, found.goal) == (ROOM.start, ROOM.goal)
    if kind == "rotation":  # every motion is one that was proved
        assert len(found.motions) == path.getStateCount() - 1
        simplifier = geometric.PathSimplifier(si)
        simplifier.reduceVertices(path)
        simplifier.collapseCloseVertices(path)
        assert len(exact.to_path(path, ROOM).motions) == path.getStateCount() - 1
    else:
        setup.simplifySolution(1.0)
        states = path.getStates()
        assert all(exact.linear_is_free(PoseChecker(ROOM), p, q) for p, q in pairwise(states))
        assert exact.to_path(path, ROOM).is_free(checker)


def test_the_car_park(exact: Any) -> None:
    scene = load_scene(ROOT / "examples/scenes/benchmr_parking1.json")
    setup = exact.simple_setup(scene)
    assert setup.solve(60.0) and setup.haveExactSolutionPath()
    setup.simplifySolution(0.5)
    found = exact.to_path(setup.getSolutionPath(), scene)
    assert found.is_free(MotionChecker(scene)) and found.units == scene.units


def test_a_path_that_is_not_free_is_refused(exact: Any) -> None:
    from ompl import base, geometric

    space = exact.state_space(ROOM)
    si = base.SpaceInformation(space)
    start, goal = space.allocState(), space.allocState()
    exact.set_pose(start, -4, 0, 0)
    exact.set_pose(goal, 9, 1, 0)
    with pytest.raises(ValueError, match="motion 0 of 1 is not free near 0"):
        exact.to_path(geometric.PathGeometric(si, start, goal), ROOM)


def test_ompl_has_no_use_for_an_interpolation_of_ours(exact: Any) -> None:
    # if this fails, OMPL's bindings call Python's `interpolate`: then let the space rotate about poles
    from ompl import base, geometric

    calls = []

    class Space(base.SE2StateSpace):  # type: ignore[misc]
        def interpolate(self, *args: Any) -> None:
            calls.append(args)

    space, limits = Space(), base.RealVectorBounds(2)
    limits.setLow(-1)
    limits.setHigh(1)
    space.setBounds(limits)
    states = [space.allocState() for _ in range(2)]
    for state in states:
        exact.set_pose(state, 0, 0, 0)
    geometric.PathGeometric(base.SpaceInformation(space), *states).subdivide()
    assert not calls


def test_start_and_goal_are_needed_and_free(exact: Any) -> None:
    with pytest.raises(ValueError, match="no start or no goal"):
        exact.simple_setup(Scene(ROOM.robot))
    with pytest.raises(InvalidPoseError, match=r"goal .* is forbidden: robot part 0 overlaps obstacle 0"):
        exact.simple_setup(Scene(ROOM.robot, ROOM.obstacles, start=Pose(-4, 5), goal=Pose(0, 0)))


def test_motions_between_poses_are_exact(exact: Any) -> None:
    rng = np.random.default_rng(0)
    for k in range(200):
        start, goal = (
            Pose(*(Fraction(int(n), 7) for n in rng.integers(-9, 9, 2)), {"tau": Fraction(int(rng.integers(-5, 6)), 3)})
            for _ in range(2)
        )
        if k % 4 == 0:
            goal = Pose(goal.x, goal.y, {"tau": start.tau})
        if k % 4 == 1:
            goal = Pose(goal.x, goal.y, {"tau": -1 / start.tau if start.tau else None})
        motion = exact.motion_between(start, goal)
        assert motion.apply(start) == goal
        assert isinstance(motion, Translation if k % 4 == 0 else Translation | Rotation)


def test_half_turns_are_free_both_ways(exact: Any) -> None:
    from ompl import base

    rod = Scene(box(-3, 0, 0, "1/2")[0], [box(-1, -4, 1, -1)[0]])
    space = exact.state_space(rod)
    si = base.SpaceInformation(space)
    si.setStateValidityChecker(exact.StateValidityChecker(si, PoseChecker(rod)))
    left, right = space.allocState(), space.allocState()
    exact.set_pose(left, 0, 0, 0)
    exact.set_pose(right, 0, 0, math.pi)
    checker = MotionChecker(rod)
    ways = [checker.is_free(exact.pose_of(p), Rotation((0, 0), {"tau": None})) for p in (left, right)]
    assert ways == [False, True]
    valid = exact.MotionValidator(si, checker)
    assert not valid.checkMotion(left, right) and not valid.checkMotion(right, left)


PLANS_TWICE = """
import cfree.ompl
from cfree import MotionChecker, Polygon, Pose, Scene
from ompl import util

util.setLogLevel(util.LogLevel.LOG_ERROR)
box = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
scene = Scene(box, [], bounds=(0, 0, 9, 9), start=Pose(2, 2), goal=Pose(5, 5, "90deg"))
for function in (False, True):
    setup = cfree.ompl.simple_setup(scene)
    si = setup.getSpaceInformation()
    if function:
        setup.setStateValidityChecker(lambda state: True)
    si.setMotionValidator(cfree.ompl.MotionValidator(si, MotionChecker(scene)))
    setup.solve(9.0)
    cfree.ompl.to_path(setup.getSolutionPath(), scene)
"""


@pytest.mark.usefixtures("exact")
def test_python_ends_without_leaked_instances() -> None:
    run = subprocess.run([sys.executable, "-c", PLANS_TWICE], capture_output=True, text=True)
    assert (run.returncode, run.stdout + run.stderr) == (0, "")


def test_motions_need_a_checker_of_states_first(exact: Any) -> None:
    from ompl import base

    si = base.SpaceInformation(exact.state_space(ROOM))
    with pytest.raises(ValueError, match=r"call si\.setStateValidityChecker first"):
        exact.MotionValidator(si, MotionChecker(ROOM))


def test_goals_of_motions_are_valid_for_the_checker_of_states(exact: Any) -> None:
    from ompl import base

    space = exact.state_space(ROOM)
    si = base.SpaceInformation(space)
    si.setStateValidityChecker(lambda state: state.getX() < 10)
    validator = exact.MotionValidator(si, MotionChecker(ROOM))
    start, near, far = (space.allocState() for _ in range(3))
    for state, x in ((start, 9), (near, 9.5), (far, 10.5)):
        exact.set_pose(state, x, 6, math.pi / 2)
    assert validator.checkMotion(start, near) and not validator.checkMotion(start, far)


def test_validity_is_exact(exact: Any) -> None:
    from ompl import base

    scene = Scene(box(0, 0, 1, 1)[0], [box(2, 0, 3, 1)[0]], bounds=(-5, -5, 5, 5))
    space = exact.state_space(scene)
    si = base.SpaceInformation(space)
    valid, state = exact.StateValidityChecker(si, PoseChecker(scene)), space.allocState()
    for x, expected in ((1.0, True), (math.nextafter(1, 2), False), (6.0, False), (5.0, True)):
        exact.set_pose(state, x, 0.0, 0.0)
        assert valid.isValid(state) == expected


@pytest.mark.parametrize("kind", KINDS)
def test_even_motions_told_free_are_free(kind: str) -> None:
    rng, told = np.random.default_rng(5), 0
    for seed in range(4):
        plain = random_scene(seed, kind)
        scene = scene_of(plain)
        checker = PoseChecker(scene)
        xy = np.concatenate([polygon.vertices for polygon in scene.obstacles])
        size = float(np.ptp(xy, axis=0).max())
        for _ in range(60):
            start = np.array([*rng.uniform(xy.min(0) - 0.2 * size, xy.max(0) + 0.2 * size), rng.uniform(-9, 9)])
            by = rng.normal(0, 1, 3) * (0.1 * size, 0.1 * size, 1)
            rows = start + np.linspace(0, 1, 400)[:, None] * by
            free = bool(checker.is_free(rows).all())
            if checker.sweep_is_free(start, by):
                told += 1
                assert free
                x, y, theta = rows[137].tolist()
                assert not oracles.overlaps(plain_of(scene).robot, plain_of(scene).obstacles, (x, y, theta))
    assert told > 0


def test_even_motions_with_room_are_told_free() -> None:
    wall = box(3, -50, 9, 50)[0]
    checker = PoseChecker(Scene(box(-1, -1, 1, 1)[0], [wall], bounds=(-9, -40, 99, 40)))
    reach = 3 - math.sqrt(2)
    for gap in (1, 1e-2, 1e-3):
        assert checker.sweep_is_free((reach - gap, -30, 0), (0, 60, 7))
    assert not checker.sweep_is_free((reach + 1e-3, -30, 0), (0, 60, 7))
    assert not checker.sweep_is_free((2, -30, 0), (0, 60, 0))  # it touches all the way: too close to tell
    assert not checker.sweep_is_free((0, -30, 0), (0, 90, 0))  # out of the bounds
    assert checker.sweep_is_free((-9, -40, 0), (0, 80, 0))  # along the bounds, which are exact
    assert PoseChecker(Scene(box(-1, -1, 1, 1)[0], [wall])).sweep_is_free((-1e6, -1e6, 0), (0, 2e6, 100))


LOT = Scene(
    robot=box(-2, -1, 2, 1)[0],
    obstacles=[box(-9, 3, 1, 6)[0], box(7, 3, 15, 6)[0]],
    bounds=(-8, -6, 14, 5),
    start=Pose(-5, 0),
    goal=Pose(4, "9/2", "90deg"),
)


def driven_by(exact: Any, scene: Scene, car: Car, space: Any, fraction: float = 0.001) -> Any:
    """A set-up of OMPL in a space of words, its states tested exactly."""
    from ompl import base, geometric

    (x0, y0, x1, y1), checker, to_robot = map(float, scene.bounds or ()), PoseChecker(scene), car.frame.inverse()
    limits = base.RealVectorBounds(2)
    for k, (low, high) in enumerate(((x0, x1), (y0, y1))):
        limits.setLow(k, low - 2)
        limits.setHigh(k, high + 2)
    space.setBounds(limits)
    setup = geometric.SimpleSetup(space)
    setup.setStateValidityChecker(lambda state: checker.is_free(exact.pose_of(state) @ to_robot))
    space.setLongestValidSegmentFraction(fraction)
    states = []
    for pose in (scene.start, scene.goal):
        assert pose is not None
        axle, state = pose @ car.frame, space.allocState()
        exact.set_pose(state, float(axle.x), float(axle.y), axle.theta)
        states.append(state)
    setup.setStartAndGoalStates(*states)
    return setup


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [1, 1.001], ids=["same radius", "larger radius"])
def test_paths_of_reeds_and_shepp_become_exact_and_are_proved(exact: Any, ratio: float) -> None:
    from ompl import base, geometric

    car = Car(3, axle=("-5/4", 0))
    setup = driven_by(exact, LOT, car, base.ReedsSheppStateSpace(3 * ratio))
    setup.setPlanner(geometric.RRTConnect(setup.getSpaceInformation()))
    assert setup.solve(20.0) and setup.haveExactSolutionPath()
    for _ in ("raw", "simplified"):
        path = setup.getSolutionPath()
        found = exact.to_path(path, LOT, vehicle=car)
        assert found.is_free(MotionChecker(LOT)) and is_drivable(found, car)
        assert (found.start, found.goal, found.vehicle) == (LOT.start, LOT.goal, car)
        assert sum(part.length for part in found.driving) == pytest.approx(path.length(), rel=1e-3)
        setup.simplifySolution(0.5)


def word_between(exact: Any, space: Any, *rows: tuple[float, float, float]) -> Any:
    """A path of OMPL through states, which nobody has tested."""
    from ompl import base, geometric

    limits = base.RealVectorBounds(2)
    limits.setLow(-50)
    limits.setHigh(50)
    space.setBounds(limits)
    states = []
    for row in rows:
        states.append(space.allocState())
        exact.set_pose(states[-1], *row)
    path = geometric.PathGeometric(base.SpaceInformation(space))
    for state in states:
        path.append(state)
    return path


def test_dubins_paths_go_forward_only(exact: Any) -> None:
    from ompl import base

    rows = [(0.0, 0.0, 0.0), (2.0, 7.0, -2.0), (9.0, -3.0, 1.0)]
    field = Scene(box(-1, -1, 1, 1)[0], [])
    for symmetric, gears in ((False, "forward"), (False, "both"), (True, "both")):
        car = Car(1, gears=gears)
        path = word_between(exact, base.DubinsStateSpace(1.0, symmetric), *rows)
        found = exact.to_path(path, field, vehicle=car)
        assert is_drivable(found, car) and (symmetric or found.cusps == 0)
        assert sum(part.length for part in found.driving) == pytest.approx(path.length(), rel=1e-3)
    with pytest.raises(ValueError, match="no reverse gear"):
        path = word_between(exact, base.ReedsSheppStateSpace(1.0), *rows)
        exact.to_path(path, field, vehicle=Car(1, gears="forward"))


def test_the_word_is_ompl_s_own_where_two_are_as_short(exact: Any) -> None:
    from ompl import base

    field, car = Scene(box(-1, -1, 1, 1)[0], []), Car(1)
    for rows in ([(0.0, 0.0, 0.0), (0.0, 0.0, 3.141592653589793)], [(0.0, 0.0, 0.0), (0.0, 0.01, 0.0)]):
        space = base.ReedsSheppStateSpace(1.001)
        path = word_between(exact, space, *rows)
        found, middle = exact.to_path(path, field, vehicle=car), space.allocState()
        first, last = path.getStates()
        for share in (0.2, 0.5, 0.9):
            space.interpolate(first, last, share, middle)
            poses = found.sample(0.001, 0.001)
            gaps = np.abs(poses.xy - (middle.getX(), middle.getY())).max(axis=1)
            turns = np.abs([math.remainder(theta - middle.getYaw(), math.tau) for theta in poses.theta])
            assert (gaps + turns).min() < 0.003


def test_a_differential_drive_takes_words_of_any_radius(exact: Any) -> None:
    from ompl import base

    field, drive = Scene(box(-1, -1, 1, 1)[0], []), DifferentialDrive(axle=("1/2", 0))
    for radius in (0.003, 0.4, 7.0):
        for rows in (
            [(0, 0, 0), (3, 1, 2), (5, -4, 0)],
            [(0, 0, 0.5), (math.cos(0.5), math.sin(0.5), 0.5)],
            [(1, 2, 3)],
        ):
            path = word_between(exact, base.ReedsSheppStateSpace(radius), *rows)
            found = exact.to_path(path, field, vehicle=drive)
            assert is_drivable(found, drive)
            assert sum(part.length for part in found.driving) == pytest.approx(path.length(), rel=1e-3)


def test_a_word_that_clips_is_refused_with_its_place(exact: Any) -> None:
    from ompl import base

    path = word_between(exact, base.ReedsSheppStateSpace(4.0), (-3, 0, 0), (1, 0, 0), (1, 0.5, 0), (9, 0.5, 0))
    scene = Scene(box(-1, -1, 1, 1)[0], [box(20, 9, 21, 10)[0], box(7, -1, 8, 1)[0]])
    with pytest.raises(ValueError, match=r"^motion 2 of 3 is not free near 0\.625 of it: at \(6, .* obstacle 1, 1 x 2"):
        exact.to_path(path, scene, vehicle=Car("3.99"))


def test_paths_of_other_spaces_and_radii_are_refused(exact: Any) -> None:
    from ompl import base

    rows, field = [(0.0, 0.0, 0.0), (0.0, 3.0, 1.0)], Scene(box(-1, -1, 1, 1)[0], [])
    for space in (base.SE2StateSpace(), base.ReedsSheppStateSpace(0.9)):
        with pytest.raises(
            ValueError, match=r"give OMPL's space a turning radius of at least 1|ReedsSheppStateSpace\(1\)"
        ):
            exact.to_path(word_between(exact, space, *rows), field, vehicle=Car(1))
