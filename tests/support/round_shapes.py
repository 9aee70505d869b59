"""Round shapes at random, and their rims in doubles, from their definitions alone."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

import cfree
from cfree.curves import Arc, Bezier, Circle, Ellipse, Spline

Floats = NDArray[np.float64]
MANY = 128  # points of a segment


def rim(ring: Any, many: int = MANY) -> Floats:
    """Points on a ring, many for each of its segments."""
    s = np.linspace(0, 1, many, endpoint=False)
    if isinstance(ring, Circle | Ellipse):
        a, b = (ring.radius, ring.radius) if isinstance(ring, Circle) else ring.radii
        turn = 0.0 if isinstance(ring, Circle) else ring.turned.theta
        x, y = float(a) * np.cos(math.tau * s), float(b) * np.sin(math.tau * s)
        c, d = math.cos(turn), math.sin(turn)
        return np.column_stack([c * x - d * y, d * x + c * y]) + np.array(ring.center, float)
    points, place = [np.array([ring[0]], float)], np.array(ring[0], float)
    for item in ring[1:]:
        samples = _segment(place, item, s)
        points.append(samples[1:])
        place = np.array(
            item.to if isinstance(item, Arc) else item if isinstance(item, tuple) else item.points[-1], float
        )
        points.append(place[None])
    return np.concatenate(points)


def _segment(start: Floats, item: Any, s: Floats) -> Floats:
    match item:
        case Arc():
            return _arc(start, item, s)
        case Bezier(points):
            control = np.vstack([start, np.array(points, float)])
            n = len(control) - 1
            basis = [math.comb(n, k) * s**k * (1 - s) ** (n - k) for k in range(n + 1)]
            return np.column_stack(basis) @ control
        case Spline(points):
            control = np.vstack([start, np.array(points, float)])
            count = len(control) - 3
            knots = np.clip(np.arange(len(control) + 4) - 3, 0, count)
            return np.column_stack([_basis(knots, k, 3, s * count) for k in range(len(control))]) @ control
        case _:
            return start + s[:, None] * (np.array(item, float) - start)


def _basis(knots: Any, k: int, degree: int, t: Floats) -> Floats:
    """Basis function of Cox and de Boor."""
    if degree == 0:
        return ((knots[k] <= t) & (t < knots[k + 1])).astype(float)
    values = np.zeros_like(t)
    for low, high, part in ((knots[k], knots[k + degree], k), (knots[k + degree + 1], knots[k + 1], k + 1)):
        if high != low:
            values += (t - low) / (high - low) * _basis(knots, part, degree - 1, t)
    return values


def _arc(start: Floats, arc: Arc, s: Floats) -> Floats:
    end = np.array(arc.to, float)
    if arc.through is not None:
        through = np.array(arc.through, float)
        p, q = through - start, end - start
        center = start + np.linalg.solve(2 * np.array([p, q]), [p @ p, q @ q])
        ccw = p[0] * q[1] - p[1] * q[0] > 0
    else:
        center, ccw = np.array(arc.center, float), not arc.clockwise
    u = start - center
    v = np.array([-u[1], u[0]]) if arc.conjugate is None else np.array(arc.conjugate, float)
    if (u[0] * v[1] - u[1] * v[0] > 0) != ccw:
        v = -v
    c, d = np.linalg.solve(np.column_stack([u, v]), end - center)
    sweep = math.atan2(d, c) % math.tau
    sweep = math.tau if min(sweep, math.tau - sweep) < 1e-12 else sweep
    return center + np.outer(np.cos(sweep * s), u) + np.outer(np.sin(sweep * s), v)


def region(shape: Any, many: int = MANY) -> Any:
    """The shape in doubles, as a shapely geometry: vertices are on its rim."""
    if isinstance(shape, cfree.Polygon):
        return shape.to_shapely()
    polygon = shapely.make_valid(shapely.Polygon(rim(shape.path, many), [rim(hole, many) for hole in shape.holes]))
    return polygon.buffer(float(shape.grown), quad_segs=many) if shape.grown else polygon


def random_shape(rng: random.Random, size: float = 1.0) -> Any:
    """Round shape, or now and then a polygon, about the origin."""

    def number(low: float, high: float) -> Fraction:
        return Fraction(round(rng.uniform(low, high) * 1000 * size), 1000)

    kind = rng.randrange(9)
    x, y = number(-0.3, 0.3), number(-0.3, 0.3)
    a, b = number(0.3, 1), number(0.1, 0.6)
    if kind == 0:
        return cfree.Curved.circle((x, y), a)
    if kind == 1:
        return cfree.Curved.ellipse((x, y), (a, b), rng.choice(["30deg", "0deg", "77deg", "90deg"]))
    if kind == 2:  # a stadium, or a rounded rectangle
        arcs = Arc((x + a, y + 2 * b), center=(x + a, y + b)), Arc((x - a, y), center=(x - a, y + b))
        return cfree.Curved([(x - a, y), (x + a, y), arcs[0], (x - a, y + 2 * b), arcs[1]])
    if kind == 3:
        ring = [(x - a, y - b), (x + a, y - b), (x + a, y + b), (x - a, y + b)]
        return cfree.Curved(rng.choice([ring, ring[:3], [*ring[:3], (x, y)]]), grown=number(0.05, 0.3))
    if kind == 4:  # half an ellipse, or a crescent
        half = Arc((x - a, y), center=(x, y), conjugate=(0, b))
        back = rng.choice([[], [Arc((x + a, y), through=(x, y + b / 2))]])
        return cfree.Curved([(x + a, y), half, *back])
    if kind == 5:
        points = [(number(0.4, 1) * c, number(0.4, 1) * d) for c, d in ((1, 0), (1, 1), (0, 1), (-1, 0), (0, -1))]
        return cfree.Curved([points[0], Bezier(points[1:3]), points[3], Bezier([points[4], points[0]])])
    if kind == 6:
        points = [(number(0.5, 1) * c, number(0.5, 1) * d) for c, d in ((1, 0), (1, 1), (-1, 1), (-1, -1), (1, -1))]
        return cfree.Curved([points[0], Spline([*points[1:], points[0]])])
    if kind == 7:
        hole = Circle((x, y), a / 3)
        return cfree.Curved(Circle((x, y), a), [hole])
    return cfree.Polygon([(x - a, y - b), (x + a, y - b), (x + b, y + b)])


def placed(shape: Any, x: Fraction, y: Fraction) -> Any:
    """Same shape somewhere else."""
    if isinstance(shape, cfree.Polygon):
        return cfree.Polygon([(p + x, q + y) for p, q in shape.exact_vertices])

    def point(p: Any) -> Any:
        return p and (p[0] + x, p[1] + y)

    def ring(shape: Any) -> Any:
        match shape:
            case Circle(center, radius):
                return Circle(point(center), radius)
            case Ellipse(center, radii, turned):
                return Ellipse(point(center), radii, {"tau": turned.tau})
        items: list[Any] = []
        for item in shape:
            match item:
                case Arc():
                    items.append(
                        Arc(point(item.to), point(item.through), point(item.center), item.clockwise, item.conjugate)
                    )
                case Bezier(points):
                    items.append(Bezier([*map(point, points)]))
                case Spline(points):
                    items.append(Spline([*map(point, points)]))
                case _:
                    items.append(point(item))
        return items

    return cfree.Curved(ring(shape.path), [*map(ring, shape.holes)], grown=shape.grown)


def random_scene(seed: int) -> cfree.Scene:
    """A robot among round obstacles, in bounds, and now and then in a round workspace."""
    rng = random.Random(f"round scene {seed}")
    robot = [random_shape(rng, 0.6) for _ in range(rng.choice([1, 1, 1, 2]))]
    count = rng.randrange(3, 9)
    obstacles = []
    for _ in range(count):
        x, y = (Fraction(rng.randrange(-40, 41), 10) for _ in range(2))
        obstacles.append(placed(random_shape(rng, rng.choice([0.5, 1.0, 1.8])), x, y))
    if rng.random() < 0.6:  # a ring of pillars
        many, far = rng.randrange(6, 13), rng.uniform(2, 3)
        radius = Fraction(round(rng.uniform(0.5, 1.05) * far * math.sin(math.pi / many) * 1000), 1000)
        for k in range(many):
            x, y = (Fraction(round(far * f(math.tau * k / many) * 100), 100) for f in (math.cos, math.sin))
            obstacles.append(cfree.Curved.circle((x, y), radius))
    workspace = cfree.Curved.circle((0, 0), 5) if rng.random() < 0.3 else None
    return cfree.Scene(robot, obstacles, workspace=workspace, bounds=(-5, -5, 5, 5))


class Sampled:
    """A scene in doubles, to check that a pose is free for shapes a little smaller, or a little larger."""

    def __init__(self, scene: cfree.Scene, by: float) -> None:
        self.robot = shapely.union_all([region(part) for part in scene.robot]).buffer(by)
        bodies = [region(shape) for shape in scene.obstacles]
        if scene.workspace is not None:
            bodies.append(shapely.box(-50, -50, 50, 50).difference(region(scene.workspace)))
        self.bodies = shapely.union_all(bodies).buffer(by)
        shapely.prepare(self.bodies)
        self.bounds = scene.bounds

    def overlap(self, rows: Sequence[Sequence[float]]) -> Floats:
        """Areas of overlap at poses x, y, theta."""
        areas = []
        for x, y, theta in rows:
            placed = shapely.affinity.affine_transform(
                self.robot, [math.cos(theta), -math.sin(theta), math.sin(theta), math.cos(theta), x, y]
            )
            areas.append(placed.intersection(self.bodies).area if self.bodies.intersects(placed) else 0.0)
        return np.array(areas)
