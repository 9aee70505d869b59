"""Thin and flat round shapes, turned and far away, and exact points on their rims."""

from __future__ import annotations

import random
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from typing import Any

import cfree
from cfree.curves import Arc, Bezier, Spline
from cfree.curves.drawn import Line
from cfree.curves.rings import Cubic, Piece, Span, exact_ring
from cfree.exact.number import ExactPoint

FAMILIES = ("ellipse", "stadium", "lens", "moon", "spline", "flat arc", "flat cubic", "hollow", "pocket", "ring")


def thin_shape(rng: random.Random, family: str, thin: Fraction) -> Any:
    """A shape of length about 2 and the requested thinness or flatness; turned, and placed near or far."""
    a, h = Fraction(rng.randrange(50, 151), 100), thin
    ellipse = [(a, 0), Arc((-a, 0), center=(0, 0), conjugate=(0, h)), Arc((a, 0), center=(0, 0), conjugate=(0, -h))]
    lens = [(a, 0), Arc((-a, 0), through=(0, h)), Arc((a, 0), through=(0, -h / rng.randrange(1, 9)))]
    holes: list[Any] = []
    match family:
        case "ellipse":
            ring: list[Any] = ellipse
        case "stadium":
            ring = [(-a, -h), (a, -h), Arc((a, h), center=(a, 0)), (-a, h), Arc((-a, -h), center=(-a, 0))]
        case "lens":
            ring = lens
        case "moon":
            ring = [(a, 0), Arc((-a, 0), through=(0, a)), Arc((a, 0), through=(0, a + h))]
        case "spline":
            ring = [(a, 0), Spline([(a / 2, h), (-a / 3, h / 2), (-a, h), (-a, -h), (0, -h), (a, -h), (a, 0)])]
        case "flat arc":  # bulges out of a square, or into it
            side = rng.choice([-1, 1])
            ring = [(0, 0), (0, -a), (2 * a, -a), (2 * a, 0), Arc((0, 0), through=(a, side * h))]
        case "flat cubic":
            ring = [(0, 0), (0, -a), (2 * a, -a), (2 * a, 0)]
            heights = h * rng.choice([-1, 0, 1]), h * rng.choice([-1, 1])
            ring += [Bezier([(a * Fraction(4, 3), heights[0]), (a / 2, heights[1]), (0, 0)])]
        case "hollow":
            ring, holes = [(-2, -2), (2, -2), (2, 2), (-2, 2)], [rng.choice([ellipse, lens])]
        case "pocket":  # a slot from above that ends in half an ellipse; not so thin that it seems to cross itself
            h, w = max(h, Fraction(1, 2**12)), Fraction(1, 4)
            end = Arc((-h, 0), center=(0, 0), conjugate=(0, -w), clockwise=True)
            ring = [(-1, -1), (1, -1), (1, 1), (h, 1), (h, 0), end, (-h, 1), (-1, 1)]
        case _:
            ring, holes = [(a, 0), Arc((a, 0), center=(0, 0))], [[(a - h, 0), Arc((a - h, 0), center=(0, 0))]]
    return turned(ring, holes, *placement(rng))


def placement(rng: random.Random) -> tuple[Fraction, ExactPoint]:
    """The tangent of half an angle, often a long rational, and a vector, often a long one."""
    tau = rng.choice([Fraction(0), Fraction(1, 3), Fraction(rng.randrange(10**17), 10**17 + 9), Fraction(-22, 7)])
    far = rng.choice([0, 0, 10**9, Fraction(10**12, 7)])
    return tau, (far * rng.choice([-1, 1]), Fraction(rng.randrange(9), 7) + far)


def turned(ring: list[Any], holes: list[Any], tau: Fraction, by: ExactPoint) -> cfree.Curved:
    """A shape of paths, turned by 2 arctan(tau) and then moved."""
    square = 1 + tau * tau
    c, s = (1 - tau * tau) / square, 2 * tau / square

    def direction(p: Any) -> Any:
        return p and (c * p[0] - s * p[1], s * p[0] + c * p[1])

    def point(p: Any) -> Any:
        return p and tuple(x + y for x, y in zip(direction(p), by, strict=True))

    def moved(item: Any) -> Any:
        match item:
            case Arc():
                to, through, center = map(point, (item.to, item.through, item.center))
                return Arc(to, through, center, item.clockwise, direction(item.conjugate))
            case Bezier() | Spline():
                return type(item)([point(p) for p in item.points])
        return point(item)

    return cfree.Curved([*map(moved, ring)], [[*map(moved, hole)] for hole in holes])


def rim_points(ring: Any, rng: random.Random, many: int) -> list[ExactPoint]:
    """Exact points on a ring."""
    pieces = exact_ring(ring)
    return [_on(rng.choice(pieces), rng) for _ in range(many)]


def _on(piece: Piece, rng: random.Random) -> ExactPoint:
    t = rng.choice([Fraction(0), Fraction(1, 2), Fraction(1), Fraction(rng.randrange(1001), 1000)])
    match piece:
        case Line(start, end):
            row = [start, end]
        case Cubic(points):
            row = [*points]
        case _:
            if piece.quarters:
                return piece.at(rng.randrange(piece.quarters), t)
            return piece.at(0, t * piece.rest)
    while len(row) > 1:
        row = [(p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])) for p, q in pairwise(row)]
    return row[0]


def touching(rng: random.Random, thin: Fraction) -> Iterator[tuple[cfree.Scene, cfree.Pose, bool, str]]:
    """Yield scenes with poses at which a sharp corner is a little beyond the rim of a convex shape, or a little within.

    Yields
    ------
    scene, pose, bool, str
        The pose is free if the third is True; the last names the role of the shape.
    """
    a, h = Fraction(rng.randrange(50, 151), 100), thin
    family = rng.choice(["ellipse", "lens", "flat arc"])
    t = Fraction(rng.randrange(250, 751), 1000)  # far from the tips
    if family == "ellipse":
        halves = [Arc((-k * a, 0), center=(0, 0), conjugate=(0, k * h)) for k in (1, -1)]
        ring: list[Any] = [(a, 0), *halves]
    elif family == "lens":
        ring = [(a, 0), Arc((-a, 0), through=(0, h)), Arc((a, 0), through=(0, -h))]
    else:
        ring = [(a, 0), Arc((-a, 0), through=(0, h)), (-a, -a), (a, -a)]
    span = exact_ring(tuple(ring))[0]
    assert isinstance(span, Span)
    p = span.at(0, t) if span.quarters else span.at(0, t * span.rest)
    c, s = p[0] - span.center[0], p[1] - span.center[1]
    normal = (c / a**2, s / h**2) if family == "ellipse" else (c, s)
    high = max(map(abs, normal))
    n = normal[0] / high, normal[1] / high
    by = h / 2 ** rng.randrange(3, 12) * rng.choice([-1, 1])
    tau, far = placement(rng)
    shape, (tip, up) = turned(ring, [], tau, far), _turned([p, n], tau)
    tip = tip[0] + far[0], tip[1] + far[1]
    place = tip[0] + by * up[0], tip[1] + by * up[1]
    wings = [(up[0] - k * up[1] / 4, up[1] + k * up[0] / 4) for k in (-1, 1)]
    probe = [(Fraction(0), Fraction(0)), *((x / 2, y / 2) for x, y in wings)]  # away from the shape
    yield cfree.Scene(probe, [shape]), cfree.Pose(*place), by > 0, f"obstacle, {family}"
    standing = [(x + place[0], y + place[1]) for x, y in probe]
    yield cfree.Scene(shape, [standing]), cfree.Pose(0, 0), by > 0, f"robot, {family}"
    dart = [(Fraction(0), Fraction(0)), *((-x * h / 64, -y * h / 64) for x, y in wings)]  # into the shape
    yield cfree.Scene(dart, workspace=shape), cfree.Pose(*place), by < 0, f"workspace, {family}"
    if family != "flat arc":
        x0, y0, x1, y1 = (c + k for c, k in zip(shape.box, (-1, -1, 1, 1), strict=True))
        plate = cfree.Curved([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], [shape.path])
        yield cfree.Scene(dart, [plate]), cfree.Pose(*place), by < 0, f"hole, {family}"


def _turned(vectors: list[ExactPoint], tau: Fraction) -> list[ExactPoint]:
    square = 1 + tau * tau
    c, s = (1 - tau * tau) / square, 2 * tau / square
    return [(c * x - s * y, s * x + c * y) for x, y in vectors]


def side(p: ExactPoint, rings: Any) -> int:
    """Side of a polygon of exact rings: 1 if a point is inside, 0 on its boundary, -1 outside."""
    is_odd = False
    for ring in rings:
        for a, b in zip(ring, [*ring[1:], ring[0]], strict=True):
            cross = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
            if cross == 0 and all(min(a[k], b[k]) <= p[k] <= max(a[k], b[k]) for k in (0, 1)):
                return 0
            if (a[1] <= p[1]) != (b[1] <= p[1]) and (cross > 0) == (b[1] > a[1]):
                is_odd = not is_odd
    return 1 if is_odd else -1
