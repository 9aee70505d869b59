"""Is a path free? Motion by motion: robot and obstacles in convex pieces, which never overlap if a line parts them.

With half-angle vectors h(u) that run straight from one to the other, every pose of a motion is a quotient of
quadratics in u, 0 <= u <= 1, and so is the height of a vertex of one piece over an edge of the other: a quadratic
over a positive one. Two pieces are apart on an interval of u if none of the heights over one of their edges is positive
there, and a quadratic says that by its three coefficients. Where no edge does, the interval is halved; where that does
not end, because two edges take turns at a contact, the roots of all heights cut it into parts with one sample each.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import pairwise
from math import gcd, isqrt, lcm
from typing import TYPE_CHECKING

import numpy as np
from flint import fmpz_poly
from numpy.typing import NDArray

from cfree.motion import Translation
from cfree.trapezoids import Ints
from cfree.verify.algebra import Root, between, part, roots
from cfree.verify.polygons import Ring, corners, near
from cfree.verify.result import Finding
from cfree.verify.surfaces import Vector, minus

if TYPE_CHECKING:
    from cfree.motion import Motion
    from cfree.path import Path
    from cfree.pose import Pose
    from cfree.separated import Separated
    from cfree.verify.world import World

ENDS, CONTINUOUS, FREE = "start and goal", "continuous", "free of collisions"
STANDING, ZERO = Translation((0, 0)), Fraction(0)
HALVINGS = 16
Quadratic = tuple[int, int, int]  # constant term first
Placed = tuple[Fraction, Fraction, Fraction, Fraction]  # x, y, cos, sin
Interval = tuple[int, int, int]  # from a / n to b / n
Box = NDArray[np.float64]
OUTER = (min, -1), (max, 1)


def path_findings(path: Path, world: World, report: Callable[[float], object]) -> Iterator[Finding]:
    """All that is wrong with a path in a scene."""
    placed = place_of(path.start, world.scale)
    for k, motion in enumerate(path.motions):
        report(k / len(path.motions))
        course = Course(placed, motion, world.scale)
        if (u := collision(world, course)) is not None:
            yield Finding(FREE, f"motion {k}", f"it is forbidden at u = {u}, near {float(u):.6g}")
        placed = course.at(Fraction(1))
    if placed != place_of(path.goal, world.scale):
        yield Finding(CONTINUOUS, "goal", "the motions do not lead to it")


def end_findings(given: Path | Separated, world: World) -> Iterator[Finding]:
    """Start and goal, if they are forbidden."""
    for name, pose in (("start", given.start), ("goal", given.goal)):
        placed = place_of(pose, world.scale)
        where = _beyond(world, placed)
        if where is None and collision(world, Course(placed, STANDING, world.scale)) is not None:
            where = "it is forbidden"
        if where is not None:
            yield Finding(ENDS, name, where)


def touches(world: World, pose: Pose) -> bool:
    """Has the robot at a free pose no distance from something: an obstacle, bounds or workspace?"""
    course, all_of_it = Course(place_of(pose, world.scale), STANDING, world.scale), (0, 1, 1)
    if world.scene.bounds and any(value in world.scene.bounds[k::2] for k, value in enumerate((pose.x, pose.y))):
        return True
    return any(
        all(any(_value(height, ZERO) >= 0 for height in heights) for heights in course.heights(ring, world.walls[k]))
        for ring in world.parts
        for k in near(world.wall_boxes, course.box(ring, all_of_it, world.unit))
    )


def place_of(pose: Pose, scale: int) -> Placed:
    return _placed(pose.x * scale, pose.y * scale, pose.tau)


def _placed(x: Fraction, y: Fraction, tau: Fraction | None) -> Placed:
    if tau is None:
        return x, y, Fraction(-1), Fraction(0)
    return x, y, (1 - tau * tau) / (1 + tau * tau), 2 * tau / (1 + tau * tau)


def _beyond(world: World, placed: Placed) -> str | None:
    """Is the robot outside the frame around the workspace? It cannot pass the frame later."""
    if world.scene.workspace is None:
        return None
    x, y, c, s = placed
    rim = [[v * world.scale for v in axis] for axis in zip(*world.scene.workspace.exact_vertices, strict=True)]
    for (a, b), *_ in world.parts:
        point = x + c * a - s * b, y + s * a + c * b
        if any(not min(axis) <= v <= max(axis) for v, axis in zip(point, rim, strict=True)):
            return "it is outside the workspace"
    return None


class Course:
    """A motion from a pose: cos, sin, position, and position in the robot's frame, all times d, as quadratics in u."""

    def __init__(self, placed: Placed, motion: Motion, scale: int) -> None:
        x, y, c, s = placed
        one, u = np.array([Fraction(1), 0, 0], object), np.array([0, Fraction(1), 0], object)
        self.half: list[tuple[int, int]] = [(1, 0), (1, 0)]  # of the angle turned, at u = 0 and u = 1
        self.pole: Vector | None = None
        if isinstance(motion, Translation):
            v, w = (part * scale for part in motion.vector)
            found = [one, c * one, s * one, x * one + v * u, y * one + w * u]
            found += [c * found[3] + s * found[4], c * found[4] - s * found[3]]
        else:
            q, p = (0, -1 if motion.clockwise else 1) if motion.tau is None else motion.tau.as_integer_ratio()[::-1]
            first = isqrt(q * q + p * p)
            self.half = [(first, 0), (q, p)]
            px, py = self.pole = (motion.pole[0] * scale, motion.pole[1] * scale)
            rx, ry = x - px, y - py
            h0, h1 = np.array([first, q - first], object), np.array([0, p], object)
            even, odd, both = np.convolve(h0, h0), np.convolve(h1, h1), 2 * np.convolve(h0, h1)
            d, k = even + odd, even - odd  # cos and sin of the angle turned are k / d and both / d
            found = [d, c * k - s * both, c * both + s * k]
            found += [px * d + rx * k - ry * both, py * d + rx * both + ry * k]
            found += [px * found[1] + py * found[2] + (c * rx + s * ry) * d]
            found += [py * found[1] - px * found[2] + (c * ry - s * rx) * d]
        unit = lcm(*(Fraction(value).denominator for column in found for value in column))
        numbers = [[int(unit * value) for value in column] for column in found]
        divisor = gcd(*(value for column in numbers for value in column))
        self.d, self.c, self.s, self.x, self.y, self.xi, self.eta = (
            (f // divisor, g // divisor, h // divisor) for f, g, h in numbers
        )

    def at(self, u: Fraction) -> Placed:
        d, c, s, x, y = (Fraction(f + g * u + h * u * u) for f, g, h in (self.d, self.c, self.s, self.x, self.y))
        return x / d, y / d, c / d, s / d

    def box(self, part: Ring, interval: Interval, unit: int) -> Box:
        """Around all places of a part, in doubles; larger by more than what is rounded."""
        a, b, n = interval
        ends = [self.at(Fraction(k, n)) for k in (a, b)]
        points = [(x + c * u - s * v, y + s * u + c * v) for x, y, c, s in ends for u, v in part]
        bulge = Fraction(0)
        if self.pole is not None:
            (g, h), (k, l) = ([(n - m) * i + m * j for i, j in zip(*self.half, strict=True)] for m in (a, b))
            cosine, sine = g * k + h * l, g * l - h * k
            # an arc leaves its chord by r (1 - cos of half the angle), which is at most r tan^2 / 2
            share = min(Fraction(1), Fraction(sine, cosine) ** 2 / 2) if cosine > 0 else Fraction(1)
            bulge = share * max(abs(x - self.pole[0]) + abs(y - self.pole[1]) for x, y in points)
        lo, hi = ([float((of(axis) + side * bulge) / unit) for axis in zip(*points, strict=True)] for of, side in OUTER)
        return np.array([*lo, *hi]) + 2.0**-40 * np.array([-1, -1, 1, 1])

    def heights(self, part: Ring, wall: Ring) -> Iterator[list[Quadratic]]:
        """For every edge of both, the heights of the other's vertices over it, times d: those of points inside grow."""
        d, c, s = self.d, self.c, self.s
        for _, (bx, by), end in corners(wall):
            e, f = minus(end, (bx, by))
            k = f * bx - e * by
            base = _sum((e, self.y), (-f, self.x), (k, d))
            yield [_sum((1, base), (e * u + f * v, s), (e * v - f * u, c)) for u, v in part]
        for _, (ax, ay), end in corners(part):
            g, h = minus(end, (ax, ay))
            base = _sum((-g, self.eta), (h, self.xi), (h * ax - g * ay, d))
            yield [_sum((1, base), (g * v - h * u, c), (-g * u - h * v, s)) for u, v in wall]


def _sum(*terms: tuple[int, Quadratic]) -> Quadratic:
    f, g, h = (sum(factor * quadratic[k] for factor, quadratic in terms) for k in range(3))
    return f, g, h


def collision(world: World, course: Course) -> Fraction | None:
    """Some u at which a pose is forbidden, if there is one."""
    if world.scene.bounds:
        bounds = [int(b * world.scale) for b in world.scene.bounds]
        for k, b in enumerate(bounds):
            over = _sum((-1 if k < 2 else 1, (course.x, course.y)[k % 2]), (b if k < 2 else -b, course.d))
            if not is_nowhere_positive(over, (0, 1, 1)):
                return next(u for u in _samples([over], (0, 1, 1)) if _value(over, u) > 0)
    for ring in world.parts:
        found = _collision(world, course, ring, (0, 1, 1), np.arange(len(world.walls), dtype=np.int32))
        if found is not None:
            return found
    return None


def _collision(world: World, course: Course, part: Ring, interval: Interval, walls: Ints) -> Fraction | None:
    around = course.box(part, interval, world.unit)
    a, b, n = interval
    left, last = [], n >= 1 << HALVINGS
    for k in walls[near(world.wall_boxes[walls], around)].tolist():
        edges = list(course.heights(part, world.walls[k]))
        if any(all(is_nowhere_positive(height, interval) for height in heights) for heights in edges):
            continue
        left.append(k)
        every = [height for heights in edges for height in heights]
        for u in _samples(every, interval) if last else [Fraction(a + b, 2 * n)]:
            if all(any(_value(height, u) > 0 for height in heights) for heights in edges):
                return u
    if last or not left:
        return None
    for half in ((2 * a, a + b, 2 * n), (a + b, 2 * b, 2 * n)):
        found = _collision(world, course, part, half, np.array(left, np.int32))
        if found is not None:
            return found
    return None


def is_nowhere_positive(quadratic: Quadratic, interval: Interval) -> bool:
    """By its Bernstein coefficients f, m, g: f, g <= 0, and m <= 0 or m^2 <= f g."""
    (c0, c1, c2), (a, b, n) = quadratic, interval
    f, g = c0 * n * n + c1 * a * n + c2 * a * a, c0 * n * n + c1 * b * n + c2 * b * b
    if f > 0 or g > 0:
        return False
    twice = 2 * c0 * n * n + c1 * (a + b) * n + 2 * c2 * a * b
    return twice <= 0 or twice * twice <= 4 * f * g


def _samples(quadratics: list[Quadratic], interval: Interval) -> Iterator[Fraction]:
    """One number between any two neighbouring roots in an interval."""
    lo, hi = Fraction(interval[0], interval[2]), Fraction(interval[1], interval[2])
    found = {root.key: root for q in quadratics if any(q[1:]) for root, _ in roots(fmpz_poly(list(q)), lo, hi)}
    found |= {end.key: end for end in map(Root.of, (lo, hi))}
    for one, other in pairwise(sorted(found.values())):
        part(one, other)
        yield between(one.hi, other.lo)


def _value(quadratic: Quadratic, u: Fraction) -> int:
    """Times a square."""
    (c0, c1, c2), n, d = quadratic, u.numerator, u.denominator
    return c0 * d * d + c1 * n * d + c2 * n * n
