"""The scene at one angle, rational or critical: what the open pillars leave free.

A pair of convex pieces forbids the inside of a convex polygon, the pillar O_k (+) -R A_p, and the bounds forbid what is
beyond them. All is decided in the field of the angle.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction

import numpy as np

from cfree.exact.algebraic import Exact, Number, ratio
from cfree.verify.polygons import Ring, boxes, convex_sum, corners, near
from cfree.verify.surfaces import Line, Surface, Turn, Vector, cross, minus
from cfree.verify.world import World

Interval = tuple[Exact, Exact]
ERROR = Fraction(1, 1 << 45)  # of a rounded point, in the world's unit; boxes are larger by 2^-40


class Section:
    """Open pillars at one angle; each is made when first needed."""

    def __init__(self, world: World, turn: Turn) -> None:
        self.world, self.turn = world, turn
        self._parts = [_mirrored(turn, part) for part in world.parts]
        rounded = turn.rounded
        part_boxes = boxes((_mirrored(rounded, part) for part in world.parts), rounded.w * world.unit)
        sums = (world.wall_boxes[:, None] + part_boxes[None]).reshape(-1, 4)
        self._boxes = np.concatenate([sums, boxes(world.beyond, world.unit)])
        self._made: dict[int, Ring] = {}

    def _pillar(self, k: int) -> Ring:
        if k not in self._made:
            world = self.world
            wall, part = divmod(k, len(world.parts))
            if wall < len(world.walls):
                self._made[k] = convex_sum([self.turn.fixed(p) for p in world.walls[wall]], self._parts[part])
            else:
                beyond = world.beyond[k - len(world.walls) * len(world.parts)]
                self._made[k] = [self.turn.fixed(p) for p in beyond]
        return self._made[k]

    def _near(self, points: Ring, w: Exact) -> Iterator[Ring]:
        (box,) = boxes([points], w * self.world.unit)
        return map(self._pillar, near(self._boxes, box))

    def on_contact(self, surface: Surface) -> list[Interval]:
        """Closed intervals of t in [0, 1] that are free on a contact."""
        rounded = self.turn.rounded
        rough = rounded.line(surface)
        return left_over(self._near([rough.start, rough.point(1)], rounded.w), self.turn.line(surface))

    def on_segment(self, line: Line) -> list[Interval]:
        """The same from a line's start to start + along."""
        return left_over(self._around(line.start, line.point(1)), line)

    def _around(self, *points: Vector) -> Iterator[Ring]:
        error = ERROR * self.world.unit
        rough = [(_rounded(x, error), _rounded(y, error)) for x, y in points]
        return self._near(rough, _rounded(self.turn.w, ERROR))

    def encloses(self, point: Vector, along: Vector | None = None) -> bool:
        """Is a point free, and from it every direction into an open pillar, but for those along a line?

        Notes
        -----
        A pillar that touches the point takes an open cone of directions. If some are left over, so is a side of a
        cone, or, if all of them are along the line, one of its normals.
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
        found = set()
        for ring in self._around(line.start, line.point(1)):
            for p in ring:
                if cross(line.along, minus(p, line.start)) == 0:
                    t = ratio(p[line.axis] - line.start[line.axis], line.along[line.axis])
                    found |= {t} if 0 < t < 1 else set()
        return sorted(found)


def _mirrored(turn: Turn, part: Ring) -> Ring:
    return [(-u, -v) for u, v in map(turn, part)]


def _rounded(x: Exact, error: Fraction) -> Fraction:
    return x.rounded(error) if isinstance(x, Number) else x


def crossing(pillar: Ring, line: Line) -> Iterator[Interval]:
    """The open interval of t, if any, at which a line is inside a convex polygon; cut off beyond [-1, 2]."""
    lo, hi = -1, 2
    for _, p, q in corners(pillar):
        u = minus(q, p)
        height, slope = cross(u, minus(line.start, p)), cross(u, line.along)  # inside: height + t slope > 0
        if height <= 0 and height + slope <= 0:
            return  # nowhere in [0, 1]
        if slope > 0:
            lo = max(lo, ratio(-height, slope))
        elif slope < 0:
            hi = min(hi, ratio(-height, slope))
    if lo < hi:
        yield lo, hi


def left_over(pillars: Iterable[Ring], line: Line) -> list[Interval]:
    """[0, 1] without open intervals; some are points."""
    found, at = [], 0
    for lo, hi in sorted(interval for pillar in pillars for interval in crossing(pillar, line)):
        if at <= lo:
            found.append((at, lo))
        at = max(at, hi)
    return [(lo, min(hi, 1)) for lo, hi in [*found, (at, 1)] if lo <= min(hi, 1)]
