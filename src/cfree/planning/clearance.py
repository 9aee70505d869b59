"""Paths that keep a distance from obstacles and workspace, or a proof that none does.

The poses at which the robot keeps the distance are those that are free for its Minkowski sum with a disc. Polygons
around a disc and within it have more and more sides: a path for the robot and the polygon around it keeps the distance,
and where none joins start and goal for the robot and the one within it, none keeps it. Bounds stay for the reference
point. docs/theory/separations.md, "With a clearance", has the proof.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from cfree.collision.nearer import require_distance
from cfree.collision.nearest_free import require_free
from cfree.collision.pose_checker import is_free
from cfree.errors import InvalidPoseError, UndecidedError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.free.turn_in_place import turn_in_place
from cfree.paths.path import Objective, Path
from cfree.planning.asked import Planner
from cfree.planning.goals import AllSeparated, all_separated, cheapest, name_of, pose_in
from cfree.planning.separation import Separated
from cfree.polygons.disc import around_disc, inside_disc
from cfree.polygons.minkowski import convex_sum
from cfree.polygons.polygon import Polygon
from cfree.scene.dilation import cores, grown_by
from cfree.scene.goals import Goal
from cfree.scene.scene import Bounds, Scene, with_robot

SIDES = (8, 28, 100)  # of the polygons: the last two differ by less than 0.1 % of the radius
BEYOND = Fraction(1, 2**30)  # of the clearance: how much wider bounds are for a proof
THINNER = Fraction(1, 2**20)  # of the clearance: how much smaller cores are than the robot's pieces
TURNING = Fraction(1, 2**21)  # of the clearance: half the square by which what turns at a place is larger
ROUNDING = 2.0**-40  # more than that of a radius, relatively


def plan_at_distance(
    scene: Scene,
    start: Pose,
    goal: Pose,
    clearance: Fraction,
    planner: Callable[[Scene], Planner],
    improve: float | None,
    objective: Objective,
) -> Path | Separated:
    """A path that keeps a clearance above 0, or a proof that none does; see `cfree.plan`.

    Raises
    ------
    InvalidPoseError
        If start or goal is nearer to something.
    UndecidedError
        If the largest clearance of a path is within 0.1 % of this one.
    """
    for pose, name in ((start, "start"), (goal, "goal")):
        _require(scene, pose, clearance, name)
    found = _to_one(_Asked(scene, start, clearance, planner, improve, objective), goal, "goal")
    return found if isinstance(found, Path) else found[0]


def plan_any_at_distance(
    asked: Planner,
    start: Pose,
    goals: Sequence[Goal],
    clearance: Fraction,
    planner: Callable[[Scene], Planner],
    improve: float | None,
    objective: Objective,
) -> Path | AllSeparated:
    """A path to one of several goals that keeps a clearance, or proofs that none leads to any; see `cfree.plan`.

    Raises
    ------
    InvalidPoseError
        If the start, or a goal that is a pose, is nearer to something, or the robot is in all orientations at a place.
    UndecidedError
        If no path was found, and a goal is too near to deciding.
    """
    scene = asked.scene
    for pose, name in ((start, "start"), *((goal, name_of(goals, k)) for k, goal in enumerate(goals))):
        if isinstance(pose, Pose):
            _require(scene, pose, clearance, name)
    question = _Asked(scene, start, clearance, planner, improve and improve / len(goals), objective)
    paths, proofs, undecided = list[Path](), list[Separated](), None
    for k, goal in enumerate(goals):
        try:
            found = _to_one(question, goal, name_of(goals, k))
        except UndecidedError as error:
            undecided = error
        else:
            paths += [found] if isinstance(found, Path) else []
            proofs += [] if isinstance(found, Path) else found
    if paths:
        return cheapest(paths, asked)
    if undecided is not None:
        raise undecided
    return all_separated(proofs, goals, is_whole=True)


@dataclass(frozen=True)
class _Asked:
    """A question about paths from one start that keep a clearance."""

    scene: Scene
    start: Pose
    clearance: Fraction
    planner: Callable[[Scene], Planner]
    improve: float | None
    objective: Objective


def _require(scene: Scene, pose: Pose, clearance: Fraction, name: str) -> None:
    require_free(scene, pose, name)
    require_distance(scene, pose, clearance, name)


def _to_one(asked: _Asked, goal: Goal, name: str) -> Path | list[Separated]:
    """A path to a pose, or to a place in any orientation; or a proof for the pose, or for each interval of these."""
    scene, start, clearance = asked.scene, asked.start, asked.clearance
    hi, disc, inside = math.inf, list[ExactPoint](), list[ExactPoint]()

    def kept(path: Path | Separated) -> Path | None:
        """As a path of the scene's robot; none with slides, whose contacts are those of the larger one."""
        if not isinstance(path, Path) or any(motion.contacts for motion in path.motions):
            return None
        return replace(path, scene=scene, clearance=clearance, disc=tuple(disc))

    for sides in SIDES:
        disc, inside = around_disc(clearance, sides), inside_disc(clearance, sides)
        larger = _grown(scene, disc, scene.bounds)
        outer = asked.planner(larger)
        ends = _ends(larger, start, goal) if is_free(larger, start) else []
        ways = ([start] if start == end else outer.quick(start, end) for end in ends)
        found: list[Path | Separated] = [outer.improved(way, asked.improve, asked.objective) for way in ways if way]
        if paths := [path for path in map(kept, found) if path]:
            return cheapest(paths, outer)
        if proofs := _proofs(asked, goal, inside, name):
            return proofs
        found = [outer.plan(start, end, improve=asked.improve, objective=asked.objective) for end in ends]
        if paths := [path for path in map(kept, found) if path]:
            return cheapest(paths, outer)
        if all(isinstance(answer, Separated) and answer.of == "closed" for answer in found):
            hi = _farthest(disc)
    smaller = _grown(scene, inside, scene.bounds)
    inner = asked.planner(smaller)
    # within the bounds, too
    is_joined = any(inner.free_space.common_cell(start, end) is not None for end in _ends(smaller, start, goal))
    lo = _nearest(inside) if is_joined else 0.0
    raise UndecidedError(
        f"clearance {float(clearance):g} is too near to the largest that a path keeps: that is between {lo:.8g} and "
        f"{hi:.8g}; give another",
        lo=lo,
        hi=hi,
    )


def _ends(scene: Scene, start: Pose, goal: Goal) -> list[Pose]:
    """The goal if it is a free pose; of a place one pose of each interval of free orientations."""
    if isinstance(goal, Pose):
        return [goal] if is_free(scene, goal) else []
    found = (pose_in(interval, start, goal) for interval in turn_in_place(scene, Pose(*goal)))
    return [pose for pose in found if pose]


def _proofs(asked: _Asked, goal: Goal, ring: Sequence[ExactPoint], name: str) -> list[Separated]:
    """Prove by a robot all of which is nearer to the scene's that no path keeps the clearance; none if it does not.

    Where that robot touches an obstacle, the scene's is nearer than the clearance. Bounds are wider, so that none of
    its contacts is one with the scene's. At a place it turns freely, without touching, where it is free if it is a
    little larger: so a pose of each interval of such orientations will do.
    """
    scene, clearance = asked.scene, asked.clearance
    by, within = BEYOND * clearance, cores(scene, THINNER * clearance)
    x0, y0, x1, y1 = scene.bounds or (by, by, -by, -by)
    robot = [Polygon(convex_sum(core.exact_vertices, ring)) for core in within]
    ends = [goal] if isinstance(goal, Pose) else _turned(asked, goal, robot, name)
    inner = with_robot(scene, robot, scene.bounds and (x0 - by, y0 - by, x1 + by, y1 + by))
    planner, proofs = asked.planner(inner), list[Separated]()
    for end in ends:
        if (found := planner.barrier(asked.start, end)) is None:
            return []
        proof = Separated._of(found, scene, asked.start, end)
        proofs.append(replace(proof, clearance=clearance, cores=tuple(within)))
    return proofs


def _turned(asked: _Asked, place: ExactPoint, robot: Sequence[Polygon], name: str) -> list[Pose]:
    """One pose of each interval of orientations at a place that are free for a robot, a little larger.

    All of it is nearer to the scene's robot than the clearance: where it only just fits, single orientations among
    them, that is nearer to something.
    """
    by = TURNING * asked.clearance
    square = [(-by, -by), (by, -by), (by, by), (-by, by)]
    larger = with_robot(
        asked.scene, [Polygon(convex_sum(part.exact_vertices, square)) for part in robot], asked.scene.bounds
    )
    intervals = [interval for interval in turn_in_place(larger, Pose(*place)) if not interval.is_single]
    if not intervals:
        x, y = map(float, place)
        raise InvalidPoseError(
            f"{name} ({x:g}, {y:g}): however it is turned there, the robot is nearer to something than "
            f"{float(asked.clearance):g}; give another place, or less clearance"
        )
    found = [pose_in(interval, asked.start, place) for interval in intervals]
    return [pose for pose in found if pose]


def _grown(scene: Scene, ring: Sequence[ExactPoint], bounds: Bounds | None) -> Scene:
    return with_robot(scene, grown_by(scene, ring), bounds)


def _farthest(ring: Sequence[ExactPoint]) -> float:
    """The radius of a disc around a polygon, or more."""
    return math.sqrt(float(max(x * x + y * y for x, y in ring))) * (1 + ROUNDING)


def _nearest(ring: Sequence[ExactPoint]) -> float:
    """The radius of a disc within a polygon, or less."""
    squares = [(x * v - y * u) ** 2 / ((u - x) ** 2 + (v - y) ** 2) for (x, y), (u, v) in pairwise([*ring, ring[0]])]
    return math.sqrt(float(min(squares))) * (1 - ROUNDING)
