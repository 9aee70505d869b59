"""The scene at one angle, rational or critical, and its free part outside the open pillars.

A pair of convex pieces forbids the inside of a convex polygon, the pillar O_k (+) -R A_p; the bounds forbid everything
beyond them. All is decided in the field of the angle.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from cfree.exact.algebraic import Exact, Number, ratio
from cfree.polygons.minkowski import summands
from cfree.verify.polygons import Ring, boxes, corners, near, roughly
from cfree.verify.surfaces import Line, Surface, Turn, Vector, cross, minus
from cfree.verify.world import World

Interval = tuple[Exact, Exact]
ERROR = Fraction(1, 1 << 45)  # error of a rounded point, in the world's unit; boxes are larger by 2^-40


class Pillar:
    """A convex polygon, times w, and its vertices x + yi, rounded, in the world's unit."""

    def __init__(self, ring: Ring, rough: NDArray[np.complex128]) -> None:
        self.ring, self._rough = ring, rough
        u = np.concatenate([rough[1:], rough[:1]]) - rough
        self._across = (u / np.maximum(abs(u), 1e-300)).conj()

    def guess(self, start: np.complex128, end: np.complex128) -> tuple[int, int, int]:
        """Guess edges that a line is outside of, or enters and leaves by."""
        height, slope = (self._across * (start - self._rough)).imag, (self._across * (end - start)).imag
        outside = np.maximum(height, height + slope).argmin()
        with np.errstate(all="ignore"):
            t = -height / slope
        return int(outside), int(np.where(slope > 0, t, -np.inf).argmax()), int(np.where(slope < 0, t, np.inf).argmin())


class Section:
    """Open pillars at one angle; each is made when first needed."""

    def __init__(self, world: World, turn: Turn) -> None:
        self.world, self.turn = world, turn
        self._parts = [_mirrored(turn, part) for part in world.parts]
        rounded = turn.rounded
        parts = [_mirrored(rounded, part) for part in world.parts]
        part_boxes = boxes(parts, rounded.w * world.unit)
        self._rough_parts = [roughly(part, rounded.w * world.unit) for part in parts]
        sums = (world.obstacle_boxes[:, None] + part_boxes[None]).reshape(-1, 4)
        self._boxes = np.concatenate([sums, boxes(world.beyond, world.unit)])
        self._made: dict[int, Pillar] = {}

    def _pillar(self, k: int) -> Pillar:
        if k not in self._made:
            self._made[k] = self._sum(k)
        return self._made[k]

    def _sum(self, k: int) -> Pillar:
        world = self.world
        number, part_number = divmod(k, len(world.parts))
        if number >= len(world.obstacle_pieces):
            beyond = world.beyond[k - len(world.obstacle_pieces) * len(world.parts)]
            return Pillar([self.turn.fixed(p) for p in beyond], roughly(beyond, world.unit))
        obstacle, part = [self.turn.fixed(p) for p in world.obstacle_pieces[number]], self._parts[part_number]
        i, j = zip(*(pairs := summands(obstacle, part)), strict=True)
        rough = roughly(world.obstacle_pieces[number], world.unit)[list(i)] + self._rough_parts[part_number][list(j)]
        return Pillar([(obstacle[i][0] + part[j][0], obstacle[i][1] + part[j][1]) for i, j in pairs], rough)

    def _near(self, points: Ring, w: Exact) -> Iterator[Pillar]:
        (box,) = boxes([points], w * self.world.unit)
        return map(self._pillar, near(self._boxes, box))

    def _left_over(self, rough: Ring, w: Exact, line: Line) -> list[Interval]:
        """Intervals that pillars near two rounded points, times w, leave of a line from one to the other."""
        return left_over(self._near(rough, w), line, roughly(rough, w * self.world.unit))

    def ring(self, number: int) -> Ring:
        """Return a pillar."""
        return self._pillar(number).ring

    def at_point(self, point: Vector) -> list[int]:
        """Numbers of the pillars that have a point inside or on their rim."""
        points, w = self._rounded(point)
        (box,) = boxes([points], w * self.world.unit)
        numbers = map(int, near(self._boxes, box))
        return [
            k for k in numbers if all(cross(minus(q, p), minus(point, p)) >= 0 for _, p, q in corners(self.ring(k)))
        ]

    def on_contact(self, surface: Surface) -> list[Interval]:
        """Closed intervals of t in [0, 1] that are free on a contact."""
        rounded = self.turn.rounded
        rough = rounded.line(surface)
        return self._left_over([rough.start, rough.point(1)], rounded.w, self.turn.line(surface))

    def on_segment(self, line: Line) -> list[Interval]:
        """Closed free intervals from a line's start to start + along."""
        return self._left_over(*self._rounded(line.start, line.point(1)), line)

    def _around(self, *points: Vector) -> Iterator[Ring]:
        return (pillar.ring for pillar in self._near(*self._rounded(*points)))

    def _rounded(self, *points: Vector) -> tuple[Ring, Fraction]:
        error = ERROR * self.world.unit
        return [(_rounded(x, error), _rounded(y, error)) for x, y in points], _rounded(self.turn.w, ERROR)

    def encloses(self, point: Vector, along: Vector | None = None) -> bool:
        """True if a point is free, and every direction from it is into an open pillar, except those along a line.

        Notes
        -----
        A pillar that touches the point takes an open cone of directions. If some are left over, so is a side of a cone,
        or, if all of them are along the line, one of its normals.
        """
        cones = []
        for ring in self._around(point):
            heights = [(cross(minus(q, p), minus(point, p)), minus(q, p)) for _, p, q in corners(ring)]
            if all(height > 0 for height, _ in heights):
                return False
            if all(height >= 0 for height, _ in heights):
                cones.append([u for height, u in heights if height == 0])
        rays = [ray for cone in cones for u, v in cone for ray in ((u, v), (-u, -v))]
        if along is not None:
            u, v = along
            rays = [ray for ray in rays if cross(ray, along) != 0] + [(-v, u), (v, -u)]
        return bool(cones) and all(any(all(cross(u, ray) > 0 for u in cone) for cone in cones) for ray in rays)

    def touching(self, line: Line) -> list[Exact]:
        """Values of t in (0, 1) at which a line passes a vertex of a pillar."""
        places = set()
        for ring in self._around(line.start, line.point(1)):
            for p in ring:
                if cross(line.along, minus(p, line.start)) == 0:
                    t = ratio(p[line.axis] - line.start[line.axis], line.along[line.axis])
                    places |= {t} if 0 < t < 1 else set()
        return sorted(places)


def _mirrored(turn: Turn, part: Ring) -> Ring:
    return [(-u, -v) for u, v in map(turn, part)]


def _rounded(x: Exact, error: Fraction) -> Fraction:
    return x.rounded(error) if isinstance(x, Number) else x


def crossing(pillar: Pillar, line: Line, rough: NDArray[np.complex128]) -> Interval | None:
    """Open interval of t at which a line is inside a pillar; None if that is nowhere in [0, 1].

    Notes
    -----
    Doubles only choose the edges that are tried first. Decided exactly: that the line is outside of one edge from t = 0
    to 1; or that it comes in through one and goes out through another.
    """
    ring, count = pillar.ring, len(pillar.ring)

    def edge(k: int) -> tuple[Exact, Exact]:
        """Height over an edge, positive inside, at t = 0, and its growth."""
        p, q = ring[k % count], ring[(k + 1) % count]
        u = minus(q, p)
        return cross(u, minus(line.start, p)), cross(u, line.along)

    def passed(k: int, sign: int) -> int | None:
        """Edge that leaves one side of the line, 1 for its left; None if all is on one side. Begin at edge k."""

        def side(k: int) -> Exact:
            return sign * cross(line.along, minus(ring[k % count], line.start))

        a, b = side(k), side(k + 1)
        for _ in range(2 * count):  # round a convex polygon `side` rises once and falls once
            if a > 0 >= b:
                return k
            if a > b and a <= 0:
                k, a, b = k - 1, side(k - 1), a
                if a <= b:
                    return None
            else:
                falls = a > b
                k, a, b = k + 1, b, side(k + 2)
                if falls and a <= b:
                    return None
        return None

    outside, enter, leave = pillar.guess(*rough)
    height, slope = edge(outside)
    if height <= 0 and height + slope <= 0:
        return None
    first, last = passed(enter, 1), passed(leave, -1)
    if first is None or last is None:
        return None
    lo, hi = (ratio(-height, slope) for height, slope in map(edge, (first, last)))
    return (lo, hi) if lo < 1 and hi > 0 else None


def left_over(pillars: Iterable[Pillar], line: Line, rough: NDArray[np.complex128]) -> list[Interval]:
    """Remainder of [0, 1] outside open intervals; some parts are points."""
    gaps, end = [], 0
    for lo, hi in sorted(filter(None, (crossing(pillar, line, rough) for pillar in pillars))):
        if end <= lo:
            gaps.append((end, lo))
        end = max(end, hi)
    return [(lo, min(hi, 1)) for lo, hi in [*gaps, (end, 1)] if lo <= min(hi, 1)]
