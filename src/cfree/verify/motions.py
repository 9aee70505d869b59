"""Check a path motion by motion: convex pieces of robot and obstacles never overlap if a line separates them.

Every pose of a motion is a quotient of polynomials in u, 0 <= u <= 1. So is the height of a vertex of one piece over an
edge of the other: a polynomial over a positive one. Two pieces are apart on an interval of u if none of the heights
over one of their edges is positive there; Bernstein coefficients may prove this. Where no edge does, the interval is
halved. Where that does not end, because two edges take turns at a contact, the roots of all heights cut it into parts
with one sample each.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from cfree.collision.motion import Translation
from cfree.collision.slide import Touch
from cfree.exact.algebraic import sign
from cfree.forbidden.columns import Ints
from cfree.verify.arc_motions import ArcWorld
from cfree.verify.course import ALL, Course, Interval, Placed, combined, place_of
from cfree.verify.polygons import Ring, near
from cfree.verify.positivity import is_nowhere_positive, positive, samples
from cfree.verify.result import Finding
from cfree.verify.surfaces import Fault
from cfree.verify.world import numbers

if TYPE_CHECKING:
    from cfree.collision.motion import Motion
    from cfree.exact.pose import Pose
    from cfree.paths.path import Path
    from cfree.planning.proof import Proof
    from cfree.verify.world import World

    AnyWorld = World | ArcWorld

ENDS, CONTINUOUS, FREE, KEPT = "start and goal", "continuous", "free of collisions", "contacts kept"
DECIMALS, CLEARANCE = "decimals", "clearance"
TOO_NEAR = {
    DECIMALS: 'they are claimed to be "free", and this is too near to something; say "approximate"',
    CLEARANCE: "it is nearer to something than that, or its polygon around a disc is; claim less",
}
STANDING, ZERO = Translation((0, 0)), Fraction(0)
HALVINGS = 16


def path_findings(
    path: Path, world: AnyWorld, report: Callable[[float], object], larger: dict[str, AnyWorld] | None = None
) -> Iterator[Finding]:
    """Findings about a path in a scene, and in worlds of larger robots in which it is claimed to be free.

    Each of these has the name of its check, and a pose free there is free in the scene.
    """
    placed, open_ = place_of(path.start, world.scale), dict(larger or {})

    def too_near(motion: Motion, place: str) -> Iterator[Finding]:
        for name, there in list(open_.items()):
            if collision(there, _course_in(there, placed, motion, world)) is not None:
                yield Finding(name, place, TOO_NEAR[name])
                del open_[name]

    yield from too_near(STANDING, "start")
    for k, motion in enumerate(path.motions):
        report(k / len(path.motions))
        course = Course(placed, motion, world.scale)
        if not course.is_defined or course.at(ZERO) != placed:
            yield Finding(CONTINUOUS, f"motion {k}", "its formula divides by zero, or begins elsewhere")
            return
        for touch in motion.contacts:
            why = "slides are for polygons" if isinstance(world, ArcWorld) else _not_kept(world, course, touch)
            if why is not None:
                yield Finding(KEPT, f"motion {k}", f"{touch.kind} {touch.robot}, {touch.obstacle}: {why}")
        yield from too_near(motion, f"motion {k}")
        if not open_ and (u := collision(world, course)) is not None:
            yield Finding(FREE, f"motion {k}", f"it is forbidden at u = {u}, near {float(u):.6g}")
        placed = course.at(Fraction(1))
    if placed != place_of(path.goal, world.scale):
        yield Finding(CONTINUOUS, "goal", "the motions do not lead to it")


def _course_in(there: AnyWorld, placed: Placed, motion: Motion, world: AnyWorld) -> Course:
    """The same motion in the coordinates of another world."""
    x, y, c, s = placed
    factor = there.scale // world.scale
    return Course((factor * x, factor * y, c, s), motion, there.scale)


def end_findings(answer: Path | Proof, world: AnyWorld) -> Iterator[Finding]:
    """Findings for a forbidden start and goal."""
    for name, pose in (("start", answer.start), ("goal", answer.goal)):
        if (fault := fault_at(pose, world)) is not None:
            yield Finding(ENDS, name, fault)


def fault_at(pose: Pose, world: AnyWorld) -> str | None:
    """Fault of a pose; None if it is free."""
    if isinstance(world, ArcWorld):
        return None if world.is_free(place_of(pose, world.scale)) else "it is forbidden"
    placed = place_of(pose, world.scale)
    where = _beyond(world, placed)
    if where is None and collision(world, Course(placed, STANDING, world.scale)) is not None:
        return "it is forbidden"
    return where


def touches(world: World, pose: Pose) -> bool:
    """True if the robot at a free pose has no distance from something: an obstacle, bounds or workspace."""
    course = Course(place_of(pose, world.scale), STANDING, world.scale)
    if world.scene.bounds and any(value in world.scene.bounds[k::2] for k, value in enumerate((pose.x, pose.y))):
        return True
    return any(
        all(
            any(sign(height, ZERO) >= 0 for height in heights)
            for heights in course.heights(ring, world.obstacle_pieces[k])
        )
        for ring in world.parts
        for k in near(world.obstacle_boxes, course.box(ring, ALL, world.unit))
    )


def _beyond(world: World, placed: Placed) -> str | None:
    """Fault if the robot is outside the frame around the workspace, which it cannot pass later."""
    if world.scene.workspace is None:
        return None
    x, y, c, s = placed
    rim = [[v * world.scale for v in axis] for axis in zip(*world.scene.workspace.exact_vertices, strict=True)]
    for (a, b), *_ in world.parts:
        point = x + c * a - s * b, y + s * a + c * b
        if any(not min(axis) <= v <= max(axis) for v, axis in zip(point, rim, strict=True)):
            return "it is outside the workspace"
    return None


def _not_kept(world: World, course: Course, touch: Touch) -> str | None:
    """Reason why a slide does not keep a contact: a vertex is not on an edge all the way."""
    is_vertex_edge = touch.kind == "vertex-edge"
    try:
        (i,), (j,) = numbers(world.robot, [touch.robot]), numbers(world.obstacles, [touch.obstacle])
        surface = world.contact((1 if is_vertex_edge else 2, int(i), int(j)))
    except Fault as fault:
        return str(fault)
    (ax, ay), (bx, by), c, s, d = surface.a, surface.b, course.c, course.s, course.d
    if is_vertex_edge:  # from the edge's beginning to the vertex, times d
        u, v = surface.q
        x, y = combined((1, ax, -ay, -bx), course.x, c, s, d), combined((1, ay, ax, -by), course.y, c, s, d)
    else:
        u, v = surface.g
        x, y = combined((-1, bx, by, -ax), course.xi, c, s, d), combined((-1, by, -bx, -ay), course.eta, c, s, d)
    if any(combined((u, -v), y, x)):
        return "the vertex is not on the edge's line all the way"
    squared = u * u + v * v
    for beyond in (combined((-u, -v), x, y), combined((u, v, -squared), x, y, d)):
        if (place := positive(beyond)) is not None:
            return f"the vertex is beyond an end of the edge at u = {place}"
    return None


def collision(world: AnyWorld, course: Course) -> Fraction | None:
    """Some u at which a pose is forbidden, if there is one."""
    if isinstance(world, ArcWorld):
        return world.collision(course)
    for k, b in enumerate(world.bounds):
        sign = -1 if k < 2 else 1
        over = combined((sign, -sign * b), (course.x, course.y)[k % 2], course.d)
        if (place := positive(over)) is not None:
            return place
    for ring in world.parts:
        place = _collision(world, course, ring, ALL, np.arange(len(world.obstacle_pieces), dtype=np.int32))
        if place is not None:
            return place
    return None


def _collision(world: World, course: Course, part: Ring, interval: Interval, pieces: Ints) -> Fraction | None:
    around = course.box(part, interval, world.unit)
    a, b, n = interval
    last = n >= 1 << HALVINGS
    pieces, left = pieces[near(world.obstacle_boxes[pieces], around)], []
    if np.isinf(around[0]) and not last:
        left, pieces = pieces.tolist(), pieces[:0]
    for k in pieces.tolist():
        edges = list(course.heights(part, world.obstacle_pieces[k]))
        if any(all(is_nowhere_positive(height, interval) for height in heights) for heights in edges):
            continue
        left.append(k)
        every = [height for heights in edges for height in heights]
        for u in samples(every, interval) if last else [Fraction(a + b, 2 * n)]:
            if all(any(sign(height, u) > 0 for height in heights) for heights in edges):
                return u
    if last or not left:
        return None
    for half in ((2 * a, a + b, 2 * n), (a + b, 2 * b, 2 * n)):
        place = _collision(world, course, part, half, np.array(left, np.int32))
        if place is not None:
            return place
    return None
