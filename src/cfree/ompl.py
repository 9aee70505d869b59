"""OMPL with exact checks: every motion that a planner accepts is proved free. Needs the extra ``ompl``.

A state of OMPL's SE2StateSpace means the exact `Pose` of its x, y and yaw. Two kinds of motion join states:

- `LinearMotionValidator`: OMPL's own, x, y and yaw changing evenly; certified, conservatively. OMPL's simplified paths
  consist of parts of accepted motions, and are free for that reason.
- `MotionValidator`: the rotation about a pole, or translation (Chasles), that leads from one exact pose to the other;
  decided exactly, so that touching is free. Python cannot give OMPL (2.0) another interpolation, so OMPL must not
  divide such motions: only its simplifiers `reduceVertices` and `collapseCloseVertices` leave them whole.

`to_path` makes a `Path` of a plan found with either, and proves it free once more. It does the same with plans in a
ReedsSheppStateSpace or DubinsStateSpace, whose states are poses of a vehicle's axle.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

try:
    from ompl import base as ob
    from ompl import geometric as og
except ImportError as error:
    raise ImportError("cfree.ompl needs OMPL; install it: pip install 'cfree[ompl]'", name="ompl") from error

import cfree._core as _core
from cfree.collision.motion import Motion, motion_between
from cfree.collision.motion_checker import MotionChecker
from cfree.collision.nearest_free import require_free
from cfree.collision.pose_checker import PoseChecker
from cfree.exact.pose import Pose
from cfree.paths.path import Path
from cfree.planning.separation import known_scene
from cfree.planning.through_states import driven_path
from cfree.scene.frame import frame_of
from cfree.scene.goals import text_of
from cfree.scene.scene import Scene, robot_radius
from cfree.vehicles.vehicle import Vehicle

MOST_HALVINGS = 30


def pose_of(state: Any) -> Pose:
    """Return the exact pose of an SE(2) state."""
    return Pose(state.getX(), state.getY(), state.getYaw())


def set_pose(state: Any, x: float, y: float, theta: float) -> None:
    """Write a pose into an SE(2) state, its yaw in [-pi, pi)."""
    yaw = math.remainder(theta, math.tau)
    state.setXY(x, y)
    state.setYaw(yaw if yaw < math.pi else -math.pi)


def state_space(scene: Scene) -> Any:
    """Return OMPL's SE2StateSpace with limits for positions.

    The limits are the bounds of the scene; else the box of its workspace; else the box of obstacles, start and goal,
    enlarged by twice the robot's radius.
    """
    space, limits = ob.SE2StateSpace(), ob.RealVectorBounds(2)
    places = [(float(pose.x), float(pose.y), pose.theta) for pose in (scene.start, scene.goal) if pose]
    x0, y0, x1, y1 = _core.search_area(known_scene(MotionChecker(scene)), places, robot_radius(scene))
    for k, (low, high) in enumerate(((x0, x1), (y0, y1))):
        limits.setLow(k, low)
        limits.setHigh(k, high)
    space.setBounds(limits)
    return space


class StateValidityChecker(ob.StateValidityChecker):
    """Exact test that a state is free and within the bounds of the space; touching is free."""

    def __init__(self, si: Any, checker: PoseChecker) -> None:
        super().__init__(si)
        self._space, self._checker = si.getStateSpace(), checker

    def isValid(self, state: Any) -> bool:
        pose = (state.getX(), state.getY(), state.getYaw())
        return bool(self._space.satisfiesBounds(state)) and self._checker.is_free(pose)


class MotionValidator(ob.MotionValidator):
    """Exact test that the rotation or translation from one state to another is free, in closed form.

    A goal must also be valid for the state validity checker that `si` has when the validator is made.

    Raises
    ------
    ValueError
        If `si` has no state validity checker.

    Notes
    -----
    The validator holds that checker and not `si`, because `si` holds the validator. Python cannot collect a cycle of
    references through OMPL: the two would stay in memory, and nanobind would list them as leaked when Python ends.
    """

    def __init__(self, si: Any, checker: MotionChecker) -> None:
        super().__init__(si)
        self._valid, self._checker = si.getStateValidityChecker(), checker
        if self._valid is None:
            raise ValueError("si: it has no state validity checker; call si.setStateValidityChecker first")

    def checkMotion(self, start: Any, goal: Any) -> bool:
        if not self._valid.isValid(goal):
            return False
        first, last = pose_of(start), pose_of(goal)
        motion, back = motion_between(first, last), motion_between(last, first)
        # half a turn is counter-clockwise either way, and planners use motions both ways
        return self._checker.is_free(first, motion) and (
            motion.displacement.tau is not None or self._checker.is_free(last, back)
        )


class LinearMotionValidator(ob.MotionValidator):
    """Certified test that OMPL's motion between two states is free; see `PoseChecker.sweep_is_free`.

    It accepts no motion that is not free. It may refuse a free one that comes very close to an obstacle.
    """

    def __init__(self, si: Any, checker: PoseChecker) -> None:
        super().__init__(si)
        self._checker = checker

    def checkMotion(self, start: Any, goal: Any) -> bool:
        return linear_is_free(self._checker, start, goal)


def linear_is_free(checker: PoseChecker, start: Any, goal: Any) -> bool:
    """True if x, y and yaw may change evenly from one state to another, the yaw the shorter way round."""
    return checker.sweep_is_free(*sweep_of(start, goal))


def simple_setup(scene: Scene) -> Any:
    """Return an ``ompl.geometric.SimpleSetup`` for a scene with start and goal: exact states, certified motions.

    Raises
    ------
    ValueError
        If the scene has no start or no goal.
    InvalidPoseError
        If one of them is forbidden; the message names the overlapping polygons, and a free pose near by.
    """
    if scene.start is None or scene.goal is None:
        raise ValueError(f"{scene.name or 'the scene'} has no start or no goal; give both")
    checker = PoseChecker(scene)
    space = state_space(scene)
    setup = og.SimpleSetup(space)
    si = setup.getSpaceInformation()
    setup.setStateValidityChecker(StateValidityChecker(si, checker))
    si.setMotionValidator(LinearMotionValidator(si, checker))
    states = []
    for name, pose in (("start", scene.start), ("goal", scene.goal)):
        state = space.allocState()
        set_pose(state, float(pose.x), float(pose.y), pose.theta)
        require_free(checker, pose_of(state), name)
        states.append(state)
    setup.setStartAndGoalStates(*states)
    return setup


def to_path(path: Any, scene: Scene, vehicle: Vehicle | None = None) -> Path:
    """Convert an OMPL path to rotations and translations through its states, proved free.

    Parameters
    ----------
    path : ompl.geometric.PathGeometric
        In an SE2StateSpace; with a vehicle, in a ReedsSheppStateSpace or DubinsStateSpace.
    scene : Scene
    vehicle : Car or DifferentialDrive, optional
        The vehicle of the path. The states are then poses of its axle: place of the axle point, and yaw of forward. A
        car with gears="forward" takes paths of a DubinsStateSpace.

    Returns
    -------
    Path
        It leads from the exact pose of the first state to that of the last. If the rotation from one state to the next
        is not free, the motion is halved as OMPL does, until the parts are.

        With a vehicle each motion is OMPL's word, made exact, and the vehicle can drive it. States that are the scene's
        start and goal up to rounding are these exactly.

    Raises
    ------
    ValueError
        If a motion halved thirty times is not free; the message has its number. Motions that `LinearMotionValidator`
        accepts are always free. With a vehicle: if a motion is not free; the message has its number, the share of it
        after which it overlaps, the robot's pose there and the obstacle. Further, if the motions are not the vehicle's.

    Notes
    -----
    Words with exactly the car's turning radius have in general no rational form. If OMPL has no larger radius, arcs get
    one larger by 2^-16, or 0.0015 %. Their poses differ from OMPL's by at most a thousandth of the radius, usually by
    a hundred-thousandth. If the radius in OMPL's space is larger than the car's by 0.01 % or more, all states are kept.
    """
    if vehicle is not None:
        return _driven_path(path, scene, vehicle)
    checker, states = MotionChecker(scene), path.getStates()
    motions: list[Motion] = []
    for k, (start, goal) in enumerate(pairwise(states)):
        sweep = sweep_of(start, goal)
        whole = pose_of(start), pose_of(goal)
        todo = [(0.0, 1.0, *whole)]
        while todo:
            low, high, first, last = todo.pop()
            motion = motion_between(first, last)
            if checker.is_free(first, motion):
                motions.append(motion)
                continue
            if high - low < 2.0**-MOST_HALVINGS:
                place = f"near {low:.6g} of it: at {text_of(first)}"
                raise ValueError(f"motion {k} of {len(states) - 1} is not free {place}")
            half = (low + high) / 2
            middle = Pose(*(a + half * d for a, d in zip(*sweep, strict=True)))
            todo += [(half, high, middle, last), (low, half, first, middle)]
    return Path(pose_of(states[0]), motions, scene.units, frame_of(scene), scene)


def _driven_path(path: Any, scene: Scene, vehicle: Vehicle) -> Path:
    """Convert a path in a ReedsSheppStateSpace or DubinsStateSpace."""
    rows, finer = _rows(path), og.PathGeometric(path)
    if len(rows) < 2:
        return driven_path(rows, scene, vehicle)
    for _ in range(2):
        finer.subdivide()  # as the path's own space does it
    steps = (len(_rows(finer)) - 1) // (len(rows) - 1)
    middles = np.stack([_rows(finer)[k::steps][: len(rows) - 1] for k in range(1, steps)], axis=1)
    return driven_path(rows, scene, vehicle, length=path.length(), middles=middles)


def _rows(path: Any) -> NDArray[np.float64]:
    return np.array([(state.getX(), state.getY(), state.getYaw()) for state in path.getStates()])


def sweep_of(start: Any, goal: Any) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Start (x, y, yaw) of the motion of OMPL's SE2StateSpace, and its change of x, y and yaw."""
    x, y, yaw = start.getX(), start.getY(), start.getYaw()
    turn = goal.getYaw() - yaw
    if abs(turn) > math.pi:
        turn -= math.copysign(math.tau, turn)
    return (x, y, yaw), (goal.getX() - x, goal.getY() - y, turn)
