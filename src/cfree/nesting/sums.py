"""Forbidden positions of a part at one orientation, exactly: a union of open convex polygons.

The interiors of a part and of an obstacle meet exactly if those of two convex pieces do. So the forbidden positions
are the open sums of the obstacle's pieces and the mirrored pieces of the part. Coordinates are integers over one scale.

A free position beside forbidden ones is a contact: it is on the sum of an edge of one shape and a convex vertex of the
other whose two edges enclose the direction of that edge. These sums, the edges of the convolution, are few.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise, product

import numpy as np

from cfree.exact.number import ExactPoint, IntPoint
from cfree.libraries import Floats
from cfree.polygons.minkowski import convex_sum
from cfree.polygons.polygon import Polygon

IntRing = tuple[IntPoint, ...]


@dataclass(frozen=True)
class Sums:
    """Open convex polygons, and edges that contain the outline of their union.

    Attributes
    ----------
    scale : int
        Coordinates are those of `rings` and `edges` over it.
    rings : tuple of tuples of (int, int)
        Counter-clockwise.
    edges : tuple of pairs of (int, int)
        Forbidden positions are on the left of each.
    """

    scale: int
    rings: tuple[IntRing, ...]
    edges: tuple[tuple[IntPoint, IntPoint], ...]

    @cached_property
    def boxes(self) -> Floats:
        """Least x, least y, greatest x, greatest y of each ring, rounded, (n, 4)."""
        rows = [(min(xs), min(ys), max(xs), max(ys)) for xs, ys in (zip(*ring, strict=True) for ring in self.rings)]
        return np.array([[c / self.scale for c in row] for row in rows], float).reshape(-1, 4)

    @cached_property
    def size(self) -> float:
        """Greatest coordinate."""
        return float(np.abs(self.boxes).max(initial=0.0))

    def cover(self, point: ExactPoint) -> bool:
        """True if a point is inside one of the polygons; their edges are outside.

        Examples
        --------
        >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
        >>> sums = sums_of([square], [square])
        >>> sums.cover((Fraction(1, 2), Fraction(0))), sums.cover((Fraction(1), Fraction(0)))
        (True, False)
        """
        x, y = map(float, point)
        margin = 1e-9 * (self.size + abs(x) + abs(y))
        low, high = self.boxes[:, :2] - margin, self.boxes[:, 2:] + margin
        near = np.flatnonzero((low <= (x, y)).all(axis=1) & (high >= (x, y)).all(axis=1)).tolist()
        if not near:
            return False
        unit = math.lcm(point[0].denominator, point[1].denominator)
        p, q = (self.scale * c.numerator * (unit // c.denominator) for c in point)
        return any(_is_inside(self.rings[k], p, q, unit) for k in near)


def _is_inside(ring: IntRing, x: int, y: int, unit: int) -> bool:
    """True if (x, y) over a unit is inside a ring."""
    a, b = ring[-1]
    for c, d in ring:
        if (c - a) * (y - unit * b) <= (d - b) * (x - unit * a):
            return False
        a, b = c, d
    return True


def sums_of(obstacles: Iterable[Polygon], parts: Iterable[Polygon], grown: Sequence[ExactPoint] = ()) -> Sums:
    """Return the forbidden positions of parts that move together among obstacles; `grown` is a convex ring to add."""
    solids, robot = list(obstacles), list(parts)
    scale = math.lcm(
        *(polygon.denominator for polygon in (*solids, *robot)), *(c.denominator for p in grown for c in p)
    )
    walls = [ring for polygon in solids for ring in pieces_of(polygon, scale)]
    mirrored = [_mirrored(ring) for polygon in robot for ring in pieces_of(polygon, scale)]
    outlines = [
        [ring for polygon in solids for ring in _rings_of(polygon, scale)],
        [_mirrored(ring) for polygon in robot for ring in _rings_of(polygon, scale)],
    ]
    if grown:
        added = [(int(x * scale), int(y * scale)) for x, y in grown]
        mirrored = [convex_sum(ring, added) for ring in mirrored]
        outlines.append([added])
    sums = dict.fromkeys(tuple(convex_sum(wall, piece)) for wall in walls for piece in mirrored)
    return Sums(scale, tuple(sums), tuple(dict.fromkeys(_convolution(outlines))))


def _convolution(shapes: Sequence[Sequence[list[IntPoint]]]) -> Iterator[tuple[IntPoint, IntPoint]]:
    """Yield sums of an edge of one of some shapes and of convex vertices of the others that face it."""
    corners = [[corner for ring in shape for corner in _convex_corners(ring)] for shape in shapes]
    for k, shape in enumerate(shapes):
        others = [corners[j] for j in range(len(shapes)) if j != k]
        for ring in shape:
            for (x, y), (x1, y1) in zip(ring[-1:] + ring[:-1], ring, strict=True):
                u, v = x1 - x, y1 - y
                facing = ([p for p, (a, b), (c, d) in each if a * v >= b * u and u * d >= v * c] for each in others)
                for points in product(*facing):
                    dx, dy = sum(p[0] for p in points), sum(p[1] for p in points)
                    yield (x + dx, y + dy), (x1 + dx, y1 + dy)


def _convex_corners(ring: Sequence[IntPoint]) -> Iterator[tuple[IntPoint, IntPoint, IntPoint]]:
    """Yield each convex vertex of a ring, and the directions of the edges before and after it."""
    for k, (x, y) in enumerate(ring):
        (p, q), (r, s) = ring[k - 1], ring[(k + 1) % len(ring)]
        before, after = (x - p, y - q), (r - x, s - y)
        if before[0] * after[1] > before[1] * after[0]:
            yield (x, y), before, after


def _mirrored(ring: Iterable[IntPoint]) -> list[IntPoint]:
    return [(-x, -y) for x, y in ring]


def _rings_of(polygon: Polygon, scale: int) -> list[list[IntPoint]]:
    """Return the rings of a polygon as integers over a scale, the interior on their left."""
    unit = scale // polygon.denominator
    points = [(x * unit, y * unit) for x, y in polygon.numerators]
    return [points[i:j] for i, j in pairwise(polygon.ring_offsets)]


def complement(container: Polygon, parts: Sequence[Polygon]) -> list[Polygon]:
    """Return solids that a part in a container must not overlap: a thick frame around it, and its holes."""
    (x0, y0, x1, y1), (u0, v0, u1, v1) = box_of([container]), box_of(parts)
    thick = 2 * max(u1 - u0, v1 - v0) + 1
    frame = [(x0 - thick, y0 - thick), (x1 + thick, y0 - thick), (x1 + thick, y1 + thick), (x0 - thick, y1 + thick)]
    outer, *holes = container.exact_rings
    return [Polygon(frame, [outer]), *map(Polygon, holes)]


def pieces_of(polygon: Polygon, scale: int) -> list[list[IntPoint]]:
    """Return the convex pieces of a polygon as integers over a scale."""
    unit, points = scale // polygon.denominator, polygon.numerators
    return [[(points[k][0] * unit, points[k][1] * unit) for k in piece] for piece in polygon.pieces]


def box_of(polygons: Iterable[Polygon]) -> tuple[Fraction, Fraction, Fraction, Fraction]:
    """Least x, least y, greatest x, greatest y of some polygons, exactly."""
    xs, ys = zip(*(point for polygon in polygons for point in polygon.exact_vertices), strict=True)
    return min(xs), min(ys), max(xs), max(ys)
