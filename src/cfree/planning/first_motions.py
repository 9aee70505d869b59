"""First motions of a vehicle whose robot touches something, decided by signs of rationals.

A *control* is a direction (v, w): the axle point moves with speed v along forward, and the heading turns with rate w.
In the axle's frame let f be the distance, times a length, of a point p of one convex piece outside an edge of the
other. Two pieces do not overlap if some edge of either has f >= 0 for all points of the other. Along the motion of a
control the sign of f, from 0 on, is that of the first derivative that is not 0; if the first two are 0, f stays 0.
docs/theory/vehicles.md, "Contacts", has the proofs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Literal

from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene
from cfree.vehicles.vehicle import Vehicle

ZERO, ONE = Fraction(0), Fraction(1)
BOUNDS, WORKSPACE = -1, -2  # numbers of obstacles
BEYOND = 50  # width of the frame around a workspace, at least
ROUNDING = 1 + 1e-9

Ring = tuple[ExactPoint, ...]
Gear = Literal[1, -1]


@dataclass(frozen=True)
class Touch:
    """A point on the line of an edge: n points out of the obstacle, and `side` is 1 if the point is the robot's."""

    n: ExactPoint
    point: ExactPoint
    side: int

    def sign(self, control: Control) -> int:
        """Sign of f for a short while: 0 if it stays 0."""
        slope = self.slope(control)
        if slope:
            return (slope > 0) - (slope < 0)
        (nx, ny), (x, y), v, w = self.n, self.point, control.v, control.w
        bend = self.side * w * (ny * (v - w * y) - nx * w * x)
        return (bend > 0) - (bend < 0)

    def slope(self, control: Control) -> Fraction:
        """The first derivative of f."""
        (nx, ny), (x, y) = self.n, self.point
        return nx * (control.v - control.w * y) + ny * control.w * x


@dataclass(frozen=True)
class Pair:
    """Two convex pieces in contact: each edge that separates them, by the points on its line."""

    obstacle: int
    edges: tuple[tuple[Touch, ...], ...]

    def sign(self, control: Control) -> int:
        """1 if they part, 0 if they keep touching, -1 if they overlap."""
        return max(min(touch.sign(control) for touch in edge) for edge in self.edges)


@dataclass(frozen=True)
class Control:
    """Speed along forward, and rate of turning; `is_break` if it is one at which a sign may change."""

    v: Fraction
    w: Fraction
    is_break: bool = True


class Touching:
    """Contacts of a vehicle's robot in a scene.

    Parameters
    ----------
    scene : Scene
        Without round shapes.
    vehicle : Car or DifferentialDrive
    gears : tuple of 1 and -1
        The gears it may use: (-1,) for the last motions of a vehicle without reverse gear, backwards in time.
    """

    def __init__(self, scene: Scene, vehicle: Vehicle, gears: tuple[Gear, ...] = (1, -1)) -> None:
        self.scene, self.vehicle, self.gears = scene, vehicle, gears
        self.back = vehicle.frame.inverse()
        self.robot = [ring for part in scene.robot for ring in convex_pieces(part, self.back)]
        (self.reference,) = self.back.apply_exact([(ZERO, ZERO)])
        self.reach = max(math.hypot(float(x), float(y)) for ring in self.robot for x, y in ring) * ROUNDING

    @cached_property
    def frame(self) -> Polygon | None:
        """A frame around the workspace: its complement, as far as the robot can be."""
        room = self.scene.workspace
        if room is None:
            return None
        xs, ys = zip(*room.exact_rings[0], strict=True)
        by = max(max(xs) - min(xs), max(ys) - min(ys)) + BEYOND + Fraction(math.ceil(2 * self.reach))
        x0, y0, x1, y1 = min(xs) - by, min(ys) - by, max(xs) + by, max(ys) + by
        return Polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], [list(room.exact_rings[0])])

    def near(self, axle: Pose, within: float = 0.0) -> Iterator[tuple[int, Ring]]:
        """Yield the convex pieces of obstacles near the robot, with their obstacle's number, in the axle's frame."""
        x, y, reach = float(axle.x), float(axle.y), (self.reach + within) * ROUNDING
        shapes = list(enumerate(self.scene.obstacles))
        if self.frame is not None:
            shapes.append((WORKSPACE, self.frame))
            if self.scene.workspace is not None:
                shapes += [(WORKSPACE, Polygon(hole)) for hole in self.scene.workspace.exact_rings[1:]]
        back = axle.inverse()
        for k, shape in shapes:
            x0, y0, x1, y1 = map(float, shape.bounds)
            if x0 <= x + reach and x - reach <= x1 and y0 <= y + reach and y - reach <= y1:
                for ring in convex_pieces(shape, back):
                    yield k, ring

    def pairs(self, pose: Pose) -> list[Pair] | None:
        """Return the pairs in contact at a pose of the robot; None if something overlaps."""
        axle = pose @ self.vehicle.frame
        pairs = list[Pair]()
        for k, other in self.near(axle):
            for ring in self.robot:
                edges = list[tuple[Touch, ...]]()
                for one, points, side in ((other, ring, 1), (ring, other, -1)):
                    edges += _separating(one, points, side)
                if () in edges:
                    continue  # they are apart
                if not edges:
                    return None
                pairs.append(Pair(k, tuple(edges)))
        for n, room in self._rooms(axle):
            if room < 0:
                return None
            if room == 0:
                pairs.append(Pair(BOUNDS, ((Touch(n, self.reference, 1),),)))
        return pairs

    def _rooms(self, axle: Pose) -> Iterator[tuple[ExactPoint, Fraction]]:
        """Yield each side of the bounds: its direction inward, and the reference point's distance."""
        if self.scene.bounds is None:
            return
        x0, y0, x1, y1 = self.scene.bounds
        ((x, y),) = axle.apply_exact([self.reference])
        c, s = axle.cos, axle.sin
        for nx, ny, room in ((ONE, ZERO, x - x0), (-ONE, ZERO, x1 - x), (ZERO, ONE, y - y0), (ZERO, -ONE, y1 - y)):
            yield (nx * c + ny * s, ny * c - nx * s), room

    def controls(self, pairs: list[Pair], *, of_any_vehicle: bool = False) -> list[Control]:
        """Return all controls at which a sign may change, and one between each two that follow each other."""
        breaks = {ratio for pair in pairs for edge in pair.edges for touch in edge for ratio in _breaks(touch)}
        left, right = self.vehicle.radii
        inner = list[tuple[Fraction, bool]]()
        if self.vehicle.kind == "car" and not of_any_vehicle:
            low, high = -1 / right, 1 / left
            inside = sorted({k for k in breaks if low < k < high} | {low, high})
            inner.append((inside[0], True))
        else:
            inside = sorted(breaks) or [ZERO]
            inner += [(inside[0] - 1, False), (inside[0], True)]
        for one, other in pairwise(inside):
            inner += [((one + other) / 2, False), (other, True)]
        if self.vehicle.kind != "car" or of_any_vehicle:
            inner.append((inside[-1] + 1, False))
        gears: tuple[Gear, ...] = (1, -1) if of_any_vehicle else self.gears
        controls = [Control(Fraction(g), g * k, is_break) for g in gears for k, is_break in inner]
        if self.vehicle.kind != "car" or of_any_vehicle:
            controls += [Control(ZERO, ONE), Control(ZERO, -ONE)]
        return controls

    def signs(self, pairs: list[Pair]) -> list[tuple[Control, int]]:
        """Return each control with 1 if it leaves at once, 0 if it keeps touching, -1 if it is not free."""
        return [(control, sign_of(pairs, control)) for control in self.controls(pairs)]

    def is_rigid(self, pairs: list[Pair]) -> bool:
        """True if no path of finite length leaves, of any number of pieces: no control is free to first order."""
        return not any(
            all(any(all(t.slope(c) >= 0 for t in edge) for edge in pair.edges) for pair in pairs)
            for c in self.controls(pairs, of_any_vehicle=True)
        )


def sign_of(pairs: list[Pair], control: Control) -> int:
    """Return the least sign of all pairs."""
    return min((pair.sign(control) for pair in pairs), default=1)


def area(p: ExactPoint, q: ExactPoint, r: ExactPoint) -> Fraction:
    """Twice the signed area of a triangle."""
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def _separating(ring: Ring, points: Ring, side: int) -> Iterator[tuple[Touch, ...]]:
    """Yield the points on the line of each edge of a ring that has none of them inside; () if none is on it."""
    for a, b in zip(ring, (*ring[1:], ring[0]), strict=True):
        areas = [area(a, b, point) for point in points]
        if max(areas) <= 0:
            n = side * (b[1] - a[1]), side * (a[0] - b[0])
            yield tuple(Touch(n, point, side) for point, size in zip(points, areas, strict=True) if size == 0)


def _breaks(touch: Touch) -> Iterator[Fraction]:
    """Yield the curvatures at which the sign of a touch may change."""
    (nx, ny), (x, y) = touch.n, touch.point
    rate = ny * x - nx * y
    if rate:
        yield -nx / rate
    elif nx == 0:
        yield ZERO
        if y:
            yield 1 / y


def convex_pieces(shape: Polygon, pose: Pose) -> Iterator[Ring]:
    """Yield the convex pieces of a shape at a pose."""
    points = pose.apply_exact(shape.exact_vertices)
    for piece in shape.pieces:
        yield tuple(points[k] for k in piece)
