"""Paths that keep a distance from obstacles and workspace, or a proof that none does.

The robot keeps the distance at the poses that are free for its Minkowski sum with a disc. Polygons around a disc and
inside it get more and more sides. A path for the robot's sum with the outer polygon keeps the distance; if there is no
path for the sum with the inner one, no path keeps it. Where these leave it open, paths are searched for the sum with
the disc itself, and exact fits tried. Bounds apply to the reference point, unchanged.
docs/theory/separations.md, "With a clearance", has the proof.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from cfree.collision.approximations import Approximations
from cfree.collision.nearer import require_distance
from cfree.collision.nearest_free import refuse_forbidden
from cfree.collision.pose_checker import PoseChecker, is_free_at
from cfree.errors import UndecidedError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.free.turn_in_place import free_orientations
from cfree.paths.path import Path
from cfree.planning.goals import AllSeparated, all_separated, cheapest, name_of, no_orientation, pose_in
from cfree.planning.options import Options
from cfree.planning.pose_planner import PosePlanner
from cfree.planning.proof import Proof
from cfree.planning.rounded_cells import FEW, RoundCells, round_cells, separated_by_cells
from cfree.planning.separation import Separated
from cfree.planning.stuck import Stuck
from cfree.planning.true_shapes import TrueShapes
from cfree.planning.unreachable import Unreachable
from cfree.polygons.disc import around_disc, inside_disc
from cfree.polygons.minkowski import convex_sum
from cfree.polygons.polygon import Polygon
from cfree.scene.dilation import cores, grown_by
from cfree.scene.frame import frame_of
from cfree.scene.goals import Goal
from cfree.scene.scene import Bounds, Scene, with_robot

SIDES = (8, 28, 100)  # of the polygons: the last two differ by less than 0.1 % of the radius
BEYOND = Fraction(1, 2**30)  # widening of the bounds for a proof, as a part of the clearance
THINNER = Fraction(1, 2**20)  # shrinking of the robot's pieces to cores, as a part of the clearance
TURNING = Fraction(1, 2**21)  # half the side of the square added to a robot that turns, as a part of the clearance
ROUNDING = 2.0**-40  # relative; exceeds the rounding of a radius


def plan_at_distance(scene: Scene, start: Pose, goal: Pose, options: Options) -> Path | Separated:
    """Plan a path that keeps a clearance above 0, or prove that none does; see `cfree.plan`.

    Raises
    ------
    InvalidPoseError
        If start or goal has less clearance.
    UndecidedError
        If the largest clearance of a path is within 0.1 % of this one.
    """
    for pose, name in ((start, "start"), (goal, "goal")):
        _require(scene, pose, options.clearance, name)
    answer = _to_one(_Query(scene, start, options), goal, "goal")
    return answer if isinstance(answer, Path) else answer[0]


def plan_any_at_distance(scene: Scene, start: Pose, goals: Sequence[Goal], options: Options) -> Path | AllSeparated:
    """Plan a path to one of several goals that keeps a clearance, or prove that none does; see `cfree.plan`.

    Raises
    ------
    InvalidPoseError
        If the start or a goal has less clearance; at a place, in all orientations.
    UndecidedError
        If no path was found, and for a goal the largest clearance is within 0.1 % of this one.
    """
    for pose, name in ((start, "start"), *((goal, name_of(goals, k)) for k, goal in enumerate(goals))):
        if isinstance(pose, Pose):
            _require(scene, pose, options.clearance, name)
    query = _Query(scene, start, options.shared(len(goals)))
    paths, proofs, undecided = list[Path](), list[Separated](), None
    for k, goal in enumerate(goals):
        try:
            answer = _to_one(query, goal, name_of(goals, k))
        except UndecidedError as error:
            undecided = error
        else:
            paths += [answer] if isinstance(answer, Path) else []
            proofs += [] if isinstance(answer, Path) else answer
    if paths:
        return cheapest(paths, scene, options.preferences)
    if undecided is not None:
        raise undecided
    return all_separated(proofs, goals, is_whole=True)


@dataclass(frozen=True)
class _Query:
    """A query for paths from one start that keep a clearance."""

    scene: Scene
    start: Pose
    options: Options


def _require(scene: Scene, pose: Pose, clearance: Fraction, name: str) -> None:
    refuse_forbidden(PoseChecker(scene), pose, name)
    require_distance(scene, pose, clearance, name)


def _to_one(query: _Query, goal: Goal, name: str) -> Path | list[Separated]:
    """Return a path to a pose or place; or a proof for the pose, or for each interval of orientations at the place."""
    scene, start, options, clearance = query.scene, query.start, query.options, query.options.clearance
    hi, disc, inside = math.inf, list[ExactPoint](), list[ExactPoint]()
    cells: RoundCells | None = None

    def for_scene(path: Path | Proof) -> Path | None:
        """Convert to a path of the scene's robot; None if it has slides, which keep contacts of the larger robot."""
        if not isinstance(path, Path) or any(motion.contacts for motion in path.motions):
            return None
        return replace(path, scene=scene, frame=frame_of(scene), clearance=clearance, disc=tuple(disc))

    try:
        for sides in SIDES:
            disc, inside = around_disc(clearance, sides), inside_disc(clearance, sides)
            larger = _grown(scene, disc, scene.bounds)
            outer = PosePlanner(larger)
            ends = _ends(larger, start, goal) if is_free_at(PoseChecker(larger), start) else []
            ways = ([start] if start == end else outer.quick(start, end, options) for end in ends)
            answers: list[Path | Proof] = [outer.answered(way, options) for way in ways if way]
            if paths := [path for path in map(for_scene, answers) if path]:
                return cheapest(paths, larger, options.preferences)
            if proofs := _proofs(query, goal, inside, name):
                return proofs
            if sides == SIDES[0] and isinstance(goal, Pose) and options.exact_discs:
                cells = round_cells(scene, options, FEW)
                proof = cells.proof(start, goal) if cells else None
                if proof is not None:
                    return [proof]
            answers = [outer.path_or_proof(start, end, options) for end in ends]
            if paths := [path for path in map(for_scene, answers) if path]:
                return cheapest(paths, larger, options.preferences)
            if all(isinstance(answer, Separated) and answer.of == "closed" for answer in answers):
                hi = _farthest(disc)
    except UndecidedError as error:  # of a vehicle
        if isinstance(error.path, Path):
            error.path = for_scene(error.path)
        raise
    for held in answers:
        if isinstance(held, Stuck | Unreachable):
            more = f"if it keeps a little more than {float(clearance):g}"
            raise UndecidedError(f"{held.said()}, {more}; give another clearance")
    if options.exact_discs and (paths := _among_discs(query, goal)):
        return cheapest(paths, larger, options.preferences)
    if isinstance(goal, Pose) and options.exact_discs and cells is None:
        proof = separated_by_cells(scene, start, goal, options)
        if proof is not None:
            return [proof]
    smaller = _grown(scene, inside, scene.bounds)
    inner = PosePlanner(smaller)
    # the scene's bounds, not the wider ones of a proof
    ends = _ends(smaller, start, goal)
    is_joined = any(inner.free_space(options).common_cell(start, end) is not None for end in ends)
    lo = _nearest(inside) if is_joined else 0.0
    raise UndecidedError(
        f"clearance {float(clearance):g} is too near to the largest that a path keeps: that is between {lo:.8g} and "
        f"{hi:.8g}; give another",
        lo=lo,
        hi=hi,
    )


def _among_discs(query: _Query, goal: Goal) -> list[Path]:
    """Return paths of the robot grown by the disc itself, to a pose or to poses at a place."""
    scene, start, options = query.scene, query.start, query.options
    true = TrueShapes(scene, Approximations(scene), options.clearance)
    planner, paths = true.planner(), list[Path]()
    inner = planner.guide.scene
    for end in _ends(inner, start, goal):
        with suppress(UndecidedError):
            if not true.arcs.is_free(end):
                continue
            answer: Path | Proof | None = planner.first_path(start, end, options)
            if answer is None:
                plain = replace(options, improve=0.0, objective="balanced", vehicle=None)
                guide = PosePlanner(inner).path_or_proof(start, end, plain)
                answer = planner.mended(guide, options) if isinstance(guide, Path) else None
            paths += [answer] if isinstance(answer, Path) else []
    return paths


def _ends(scene: Scene, start: Pose, goal: Goal) -> list[Pose]:
    """Return the goal if it is a free pose; at a place, one pose for each interval of free orientations."""
    if isinstance(goal, Pose):
        return [goal] if is_free_at(PoseChecker(scene), goal) else []
    poses = (pose_in(interval, start, goal) for interval in free_orientations(scene, goal))
    return [pose for pose in poses if pose]


def _proofs(query: _Query, goal: Goal, ring: Sequence[ExactPoint], name: str) -> list[Separated]:
    """Prove that no path keeps the clearance, using a robot that stays within that distance; return [] if not proved.

    Where that robot touches an obstacle, the scene's robot is nearer than the clearance. Its bounds are wider, so that
    no contact with them is one with the scene's. At a place, it turns without contact where it is free if grown a
    little: so one pose in each interval of such orientations is enough.
    """
    scene, clearance = query.scene, query.options.clearance
    by, within = BEYOND * clearance, cores(scene, THINNER * clearance)
    x0, y0, x1, y1 = scene.bounds or (by, by, -by, -by)
    robot = [Polygon(convex_sum(core.exact_vertices, ring)) for core in within]
    ends = [goal] if isinstance(goal, Pose) else _turned(query, goal, robot, name)
    inner = with_robot(scene, robot, scene.bounds and (x0 - by, y0 - by, x1 + by, y1 + by))
    planner, proofs = PosePlanner(inner), list[Separated]()
    for end in ends:
        if (proof := planner.proof(query.start, end, query.options)) is None:
            return []
        proofs.append(replace(proof, units=scene.units, scene=scene, clearance=clearance, cores=tuple(within)))
    return proofs


def _turned(query: _Query, place: ExactPoint, robot: Sequence[Polygon], name: str) -> list[Pose]:
    """Return one pose for each interval of orientations at a place that are free for a slightly grown robot.

    The grown robot stays within the clearance of the scene's robot. So at single orientations, where it fits exactly,
    the scene's robot has less clearance.
    """
    by = TURNING * query.options.clearance
    square = [(-by, -by), (by, -by), (by, by), (-by, by)]
    larger = with_robot(
        query.scene, [Polygon(convex_sum(part.exact_vertices, square)) for part in robot], query.scene.bounds
    )
    intervals = [interval for interval in free_orientations(larger, place) if not interval.is_single]
    if not intervals:
        raise no_orientation(name, place, query.options.clearance)
    poses = [pose_in(interval, query.start, place) for interval in intervals]
    return [pose for pose in poses if pose]


def _grown(scene: Scene, ring: Sequence[ExactPoint], bounds: Bounds | None) -> Scene:
    return with_robot(scene, grown_by(scene, ring), bounds)


def _farthest(ring: Sequence[ExactPoint]) -> float:
    """Return an upper bound of the radius of the least disc about the origin that contains a polygon."""
    return math.sqrt(float(max(x * x + y * y for x, y in ring))) * (1 + ROUNDING)


def _nearest(ring: Sequence[ExactPoint]) -> float:
    """Return a lower bound of the radius of the largest disc about the origin inside a polygon."""
    squares = [(x * v - y * u) ** 2 / ((u - x) ** 2 + (v - y) ** 2) for (x, y), (u, v) in pairwise([*ring, ring[0]])]
    return math.sqrt(float(min(squares))) * (1 - ROUNDING)
