"""A scene of rounded shapes as convex pieces of cores with radii, and the corners of their rims, for the verifier."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
from flint import arb, fmpq
from numpy.typing import NDArray

from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon
from cfree.scene.rounded import Cores
from cfree.scene.scene import Scene
from cfree.verify.polygons import frame, rectangle, rings_of, tile
from cfree.verify.round_algebra import Ball, Turn

Core = Polygon | tuple[ExactPoint, ...]
Place = tuple[Ball, Ball]
Complexes = NDArray[np.complex128]


@dataclass(frozen=True)
class Part:
    """A convex piece of a core, counter-clockwise; or the ends of a segment, or a point."""

    points: tuple[ExactPoint, ...]
    radius: Fraction

    @cached_property
    def rough(self) -> Complexes:
        return np.array([complex(x, y) for x, y in self.points])

    @cached_property
    def exact(self) -> list[tuple[arb, arb]]:
        return [(_ball(x), _ball(y)) for x, y in self.points]


@dataclass(frozen=True)
class Corner:
    """A vertex of a rim between its neighbours, the interior on the left; a point has itself as neighbours."""

    before: complex
    place: complex
    after: complex
    radius: float
    is_convex: bool


class RoundWorld:
    """The pieces and corners of robot and obstacles in two layers: bodies, and the reference point with the bounds.

    Attributes
    ----------
    layers : list of pairs of lists of Part
        The robot's pieces and those of obstacles.
    corners : list of pairs of lists of Corner
    untiled : list of str
        Shapes whose pieces are not convex, or do not tile them.
    """

    def __init__(self, scene: Scene, cores: Cores) -> None:
        self.untiled: list[str] = []
        robot, obstacles = list[Part](), list[Part]()
        robot_corners, obstacle_corners = list[Corner](), list[Corner]()
        for k, shape in enumerate(cores.robot):
            robot += self._pieces(shape.core, shape.radius, f"robot[{k}]")
            robot_corners += _corners(shape.core, shape.radius)
        for k, shape in enumerate(cores.obstacles):
            obstacles += self._pieces(shape.core, shape.radius, f"obstacle {k}")
            obstacle_corners += _corners(shape.core, shape.radius)
        reach = max(abs(c) for part in robot for p in part.points for c in p)
        far = reach + max((abs(c) for part in obstacles for p in part.points for c in p), default=Fraction(0))
        far += max(shape.radius for shape in cores.robot)
        if isinstance(scene.workspace, Polygon):
            x0, y0, x1, y1 = map(Fraction, scene.workspace.bounds)
            margin = 1 + 4 * far + x1 - x0 + y1 - y0
            around = rectangle(*(int(v) for v in (x0 - margin, y0 - margin, x1 + margin, y1 + margin)))
            outer, *holes = scene.workspace.exact_rings
            for k, polygon in enumerate([Polygon(around, [outer]), *map(Polygon, holes)]):
                obstacles += self._pieces(polygon, Fraction(0), f"part {k} of the workspace's complement")
            obstacle_corners += _corners(scene.workspace, Fraction(0), is_reversed=True)
        self.layers = [(robot, obstacles)]
        self.corners = [(robot_corners, obstacle_corners)]
        if scene.bounds:
            bounds = [Fraction(b) for b in scene.bounds]
            span = 1 + bounds[2] - bounds[0] + bounds[3] - bounds[1]
            wide = [bounds[0] - span, bounds[1] - span, bounds[2] + span, bounds[3] + span]
            beyond = [Part(tuple(ring), Fraction(0)) for ring in frame(wide, bounds)]  # type: ignore[arg-type]
            inner = [complex(*p) for p in rectangle(*bounds)[::-1]]  # type: ignore[arg-type]
            self.layers.append(([Part(((Fraction(0), Fraction(0)),), Fraction(0))], beyond))
            self.corners.append(([Corner(0, 0, 0, 0, True)], list(_around(inner, 0.0))))

    def _pieces(self, core: Core, radius: Fraction, name: str) -> Iterator[Part]:
        if not isinstance(core, Polygon):
            yield Part(core, radius)
            return
        scale = core.denominator
        vertices = [(x, y) for x, y in core.numerators]
        pieces = [[vertices[k] for k in piece] for piece in core.pieces]
        if not tile(pieces, rings_of(core, scale)):
            self.untiled.append(name)
        for piece in pieces:
            yield Part(tuple((Fraction(x, scale), Fraction(y, scale)) for x, y in piece), radius)

    @property
    def size(self) -> float:
        """Number that no coordinate and no radius exceeds by far."""
        parts = [part for layer in self.layers for side in layer for part in side]
        return max(1e-300, *(float(np.abs(part.rough).max()) + float(part.radius) for part in parts))


def _ball(x: Fraction) -> arb:
    return arb(fmpq(x.numerator, x.denominator))


def _around(points: Sequence[complex], radius: float) -> Iterator[Corner]:
    count = len(points)
    for k, p in enumerate(points):
        before, after = points[k - 1], points[(k + 1) % count]
        turn = ((p - before).conjugate() * (after - p)).imag
        yield Corner(before, p, after, radius, count < 3 or turn > 0)


def _corners(core: Core, radius: Fraction, *, is_reversed: bool = False) -> Iterator[Corner]:
    rings: Iterable[Sequence[ExactPoint]] = core.exact_rings if isinstance(core, Polygon) else [core]
    for ring in rings:
        points = [complex(*p) for p in ring]
        yield from _around(points[::-1] if is_reversed else points, float(radius))


def is_apart(robot: Part, obstacle: Part, turn: Turn, place: Place, near: arb) -> bool:
    """True if two grown pieces do not overlap where the robot is at a place, or by less than `near`.

    Notes
    -----
    Convex cores are at least rho apart exactly if one has an edge with the other beyond it by rho, or if vertices a and
    b at least rho apart have both cores behind the lines through them across a b.
    """
    rho = _ball(robot.radius + obstacle.radius) - near
    x, y = place
    moved = [(turn.cos * p - turn.sin * q + x, turn.sin * p + turn.cos * q + y) for p, q in robot.exact]
    cores = moved, obstacle.exact
    for core, other in (cores, cores[::-1]):
        for k, (p, q) in enumerate(core):
            u, v = core[(k + 1) % len(core)][0] - p, core[(k + 1) % len(core)][1] - q
            if len(core) > 1 and all((s - p) * v - (t - q) * u >= rho * (u * u + v * v).sqrt() for s, t in other):
                return True
    if robot.radius + obstacle.radius == 0:
        return False
    for k, a in enumerate(moved):
        for m, b in enumerate(obstacle.exact):
            d = b[0] - a[0], b[1] - a[1]
            if not d[0] * d[0] + d[1] * d[1] >= rho * abs(rho):
                continue
            behind = [(moved[j], a, -1) for j in (k - 1, (k + 1) % len(moved))]
            behind += [(obstacle.exact[j], b, 1) for j in (m - 1, (m + 1) % len(obstacle.exact))]
            if all(sign * ((p[0] - q[0]) * d[0] + (p[1] - q[1]) * d[1]) > -near for p, q, sign in behind):
                return True
    return False
