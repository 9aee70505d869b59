"""Features of segments and arcs that touch where a motion becomes forbidden.

The core decides where a motion becomes forbidden, and which two shapes meet. Doubles then choose the features: of all
pairs that touch there, the one that comes together fastest.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

from cfree.collision.motion import Motion, Translation
from cfree.contact.arcs import ArcArc, ArcContact, ArcEdge, EdgeArc
from cfree.contact.features import shape_features
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.scene.features import BOUNDS, WORKSPACE
from cfree.scene.scene import AnyShape, Scene

CLOSE = 1e-9  # largest gap of features that touch, relative to the robot, and error of a normal's angle
Vector = tuple[float, float]


@dataclass(frozen=True)
class _Arc:
    """An arc or a vertex: a signed radius, and normals from one angle to another."""

    center: Vector
    radius: float
    first: float
    last: float
    is_convex: bool

    def has(self, n: Vector) -> bool:
        beyond = (math.atan2(n[1], n[0]) - self.first + CLOSE) % math.tau
        return beyond <= self.last - self.first + 2 * CLOSE


@dataclass(frozen=True)
class _Edge:
    start: Vector
    along: Vector  # a unit vector; the inside is on its left
    length: float
    offset: float

    def has(self, n: Vector) -> bool:
        u, v = self.along
        return v * n[0] - u * n[1] > 0.5  # `_normals` yields those of edges


def entered_contact(scene: Scene, part: int, number: int, pose: Pose, motion: Motion) -> ArcContact | None:
    """Return the contact that a motion enters at a pose, in the numbering of `cfree.contact.shape_features`.

    Parameters
    ----------
    scene : Scene
        Of segments and circular arcs.
    part, number : int
        The robot's shape, and that of an obstacle, -1 for the bounds or -2 for the workspace.
    pose : Pose
        The last free one, or close to it.
    motion : Translation or Rotation

    Returns
    -------
    ArcEdge, EdgeArc, ArcArc or None
        None for the bounds, and if no features touch.
    """
    obstacle = scene.workspace if number == WORKSPACE else None if number == BOUNDS else scene.obstacles[number]
    if obstacle is None:
        return None
    own = [*_features(scene.robot[part], Pose(0, 0, {"tau": pose.tau}))]
    others = [*_features(obstacle, Pose(-pose.x, -pose.y), is_outside=number == WORKSPACE)]
    close = CLOSE * max(_size(feature) for _, feature in own)
    touching = list[tuple[float, ArcContact]]()
    for (i, one), (j, other) in product(own, others):
        kind = ArcEdge if isinstance(other, _Edge) else EdgeArc if isinstance(one, _Edge) else ArcArc
        for n in _normals(one, other, close):
            if other.has(n) and one.has((-n[0], -n[1])):
                touching.append((_speed(motion, pose, one, other, n), kind(i, j)))
    return min(touching, key=lambda pair: pair[0])[1] if touching else None


def _features(shape: AnyShape, placed: Pose, *, is_outside: bool = False) -> Iterator[tuple[int, _Arc | _Edge]]:
    """Yield the features of a placed shape, or of all outside of it, with their numbers; no reflex vertices."""
    features, sign = shape_features(shape), -1 if is_outside else 1

    def point(p: ExactPoint) -> Vector:
        ((x, y),) = placed.apply_exact([p])
        return float(x), float(y)

    for k, arc in enumerate(features.arcs):
        is_convex = arc.is_convex is not is_outside
        if arc.signed_square or is_convex:
            first = arc.first + placed.theta + (math.pi if is_outside else 0)
            yield k, _Arc(point(arc.centre), sign * arc.signed_radius, first, first + arc.width, is_convex)
    for k, edge in enumerate(features.edges):
        (x, y), (dx, dy) = edge.start, edge.along
        (a, b), (c, d) = [point((x, y)), point((x + dx, y + dy))][::sign]
        length = math.hypot(c - a, d - b)
        yield k, _Edge((a, b), ((c - a) / length, (d - b) / length), length, sign * float(edge.offset))


def _size(feature: _Arc | _Edge) -> float:
    """Bound of the distance of a feature's points from the reference point."""
    if isinstance(feature, _Arc):
        return math.hypot(*feature.center) + abs(feature.radius)
    return math.hypot(*feature.start) + feature.length + feature.offset


def _normals(own: _Arc | _Edge, other: _Arc | _Edge, close: float) -> Iterator[Vector]:
    """Yield normals of the second feature at which the first one touches its line or circle from outside."""
    if isinstance(own, _Arc) and isinstance(other, _Arc):
        x, y, reach = own.center[0] - other.center[0], own.center[1] - other.center[1], own.radius + other.radius
        far = math.hypot(x, y)
        if not (own.is_convex or other.is_convex) or (own.is_convex is not other.is_convex and reach > close):
            return
        if abs(reach) <= close and far <= close:
            ends = own.first + math.pi, own.last + math.pi, other.first, other.last
            yield from ((math.cos(angle), math.sin(angle)) for angle in ends)
        elif abs(far - abs(reach)) <= close:
            side = math.copysign(far, reach)
            yield x / side, y / side
        return
    edge, arc, sign = (other, own, 1) if isinstance(other, _Edge) else (own, other, -1)
    if isinstance(edge, _Edge) and isinstance(arc, _Arc) and arc.is_convex:
        (u, v), x, y = edge.along, arc.center[0] - edge.start[0], arc.center[1] - edge.start[1]
        if abs(v * x - u * y - arc.radius - edge.offset) <= close and -close <= u * x + v * y <= edge.length + close:
            yield sign * v, -sign * u


def _speed(motion: Motion, pose: Pose, own: _Arc | _Edge, other: _Arc | _Edge, n: Vector) -> float:
    """Return the speed along a normal of the second feature of the robot's point there."""
    if isinstance(motion, Translation):
        u, v = map(float, motion.vector)
        return u * n[0] + v * n[1]
    arc = own if isinstance(own, _Arc) else other
    assert isinstance(arc, _Arc) and motion.pole is not None
    (x, y), (px, py) = arc.center, motion.pole
    # the point is on the line through the arc's center along n, so that its speed along n is that of the center
    return math.copysign(1, motion.turn) * ((float(py - pose.y) - y) * n[0] + (x - float(px - pose.x)) * n[1])
