"""Paths that keep a distance from obstacles and workspace, or a proof that none does.

The poses at which the robot keeps the distance are those that are free for its Minkowski sum with a disc. Polygons
around a disc and within it have more and more sides: a path for the robot and the polygon around it keeps the distance,
and where none joins start and goal for the robot and the one within it, none keeps it. Bounds stay for the reference
point. docs/theory/separations.md, "With a clearance", has the proof.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

from cfree.collision.nearer import require_distance
from cfree.collision.nearest_free import require_free
from cfree.collision.pose_checker import is_free
from cfree.errors import UndecidedError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.paths.path import Objective, Path
from cfree.planning.asked import Planner
from cfree.planning.separation import Separated
from cfree.polygons.disc import around_disc, inside_disc
from cfree.polygons.minkowski import convex_sum
from cfree.polygons.polygon import Polygon
from cfree.scene.dilation import cores, grown_by
from cfree.scene.scene import Bounds, Scene, with_robot

SIDES = (8, 28, 100)  # of the polygons: the last two differ by less than 0.1 % of the radius
BEYOND = Fraction(1, 2**30)  # of the clearance: how much wider bounds are for a proof
THINNER = Fraction(1, 2**20)  # of the clearance: how much smaller cores are than the robot's pieces
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
        require_free(scene, pose, name)
        require_distance(scene, pose, clearance, name)
    hi, disc, inside = math.inf, list[ExactPoint](), list[ExactPoint]()

    def kept(path: Path | Separated | None) -> Path | None:
        """As a path of the scene's robot; none with slides, whose contacts are those of the larger one."""
        if not isinstance(path, Path) or any(motion.contacts for motion in path.motions):
            return None
        return replace(path, scene=scene, clearance=clearance, disc=tuple(disc))

    for sides in SIDES:
        disc, inside = around_disc(clearance, sides), inside_disc(clearance, sides)
        larger = _grown(scene, disc, scene.bounds)
        ends_fit = is_free(larger, start) and is_free(larger, goal)
        outer = planner(larger)
        if ends_fit:
            way = [start] if start == goal else outer.quick(start, goal)
            if way and (path := kept(outer.improved(way, improve, objective))):
                return path
        if proof := _proof(scene, start, goal, clearance, inside, planner):
            return proof
        found = outer.plan(start, goal, improve=improve, objective=objective) if ends_fit else None
        if path := kept(found):
            return path
        if found is None or (isinstance(found, Separated) and found.of == "closed"):
            hi = _farthest(disc)
    inner = planner(_grown(scene, inside, scene.bounds))
    is_joined = inner.free_space.common_cell(start, goal) is not None  # within the bounds, too
    lo = _nearest(inside) if is_joined else 0.0
    raise UndecidedError(
        f"clearance {float(clearance):g} is too near to the largest that a path keeps: that is between {lo:.8g} and "
        f"{hi:.8g}; give another",
        lo=lo,
        hi=hi,
    )


def _grown(scene: Scene, ring: Sequence[ExactPoint], bounds: Bounds | None) -> Scene:
    return with_robot(scene, grown_by(scene, ring), bounds)


def _proof(
    scene: Scene,
    start: Pose,
    goal: Pose,
    clearance: Fraction,
    ring: Sequence[ExactPoint],
    planner: Callable[[Scene], Planner],
) -> Separated | None:
    """That no path keeps the clearance, if a robot all of which is nearer to the scene's proves it.

    Where that robot touches an obstacle, the scene's is nearer than the clearance. Bounds are wider, so that none of
    its contacts is one with the scene's.
    """
    by, within = BEYOND * clearance, cores(scene, THINNER * clearance)
    x0, y0, x1, y1 = scene.bounds or (by, by, -by, -by)
    robot = [Polygon(convex_sum(core.exact_vertices, ring)) for core in within]
    inner = with_robot(scene, robot, scene.bounds and (x0 - by, y0 - by, x1 + by, y1 + by))
    if (found := planner(inner).barrier(start, goal)) is None:
        return None
    return replace(Separated._of(found, scene, start, goal), clearance=clearance, cores=tuple(within))


def _farthest(ring: Sequence[ExactPoint]) -> float:
    """The radius of a disc around a polygon, or more."""
    return math.sqrt(float(max(x * x + y * y for x, y in ring))) * (1 + ROUNDING)


def _nearest(ring: Sequence[ExactPoint]) -> float:
    """The radius of a disc within a polygon, or less."""
    squares = [(x * v - y * u) ** 2 / ((u - x) ** 2 + (v - y) ** 2) for (x, y), (u, v) in pairwise([*ring, ring[0]])]
    return math.sqrt(float(min(squares))) * (1 - ROUNDING)
