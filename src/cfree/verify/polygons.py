"""Rings of exact points, the interior on the left: convex pieces, sums, and boxes for rough searches."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import gcd

import numpy as np
from numpy.typing import NDArray

from cfree.exact.algebraic import Exact
from cfree.polygons.polygon import Polygon
from cfree.verify.surfaces import Vector, cross, minus

Ring = list[Vector]
Corner = tuple[Vector, Vector, Vector]  # a vertex between its neighbours


def rings_of(polygon: Polygon, scale: int) -> list[Ring]:
    factor = scale // polygon.denominator
    return [[(x * factor, y * factor) for x, y in polygon.numerators[i:j]] for i, j in pairwise(polygon.ring_offsets)]


def corners(ring: Ring) -> list[Corner]:
    return list(zip(ring[-1:] + ring[:-1], ring, ring[1:] + ring[:1], strict=True))


def is_convex(corner: Corner) -> bool:
    return bool(cross(minus(corner[1], corner[0]), minus(corner[2], corner[1])) > 0)


def rectangle(x0: int, y0: int, x1: int, y1: int) -> Ring:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def frame(outer: Sequence[int], inner: Sequence[int]) -> list[Ring]:
    """Four rectangles that cover the space between two boxes."""
    (X0, Y0, X1, Y1), (x0, y0, x1, y1) = outer, inner
    return [rectangle(*side) for side in ((X0, Y0, x0, Y1), (x1, Y0, X1, Y1), (X0, Y0, X1, y0), (X0, y1, X1, Y1))]


def tile(pieces: Iterable[Ring], rings: Iterable[Ring]) -> bool:
    """True if the pieces are convex, and cover the region of rings without overlap.

    Notes
    -----
    On every line the pieces' directed edges must add up to those of the rings: then the sum of the pieces' indicators
    is the rings' winding number. An edge and its reverse cancel. A sum of other directed segments of one line vanishes
    if their ends cancel.
    """
    left: dict[tuple[Vector, Vector], int] = {}
    for shapes, times in ((pieces, 1), (rings, -1)):
        for ring in shapes:
            if times == 1 and not _turns_left(ring):
                return False
            for p, q in zip(ring, ring[1:] + ring[:1], strict=True):
                edge, reverse = ((p, q), (q, p))[::times]
                if times_left := left.get(reverse):
                    left[reverse] = times_left - 1
                else:
                    left[edge] = left.get(edge, 0) + 1
    ends: Counter[tuple[Vector, int, Vector]] = Counter()
    for (p, q), times in left.items():
        if times:
            u = primitive(minus(q, p))
            ends[u, cross(u, p), q] += times
            ends[u, cross(u, p), p] -= times
    return not any(ends.values())


def _turns_left(ring: Ring) -> bool:
    """True if a ring is convex, counter-clockwise, and once around."""
    if len(ring) == 3:
        return is_convex((ring[0], ring[1], ring[2]))
    around = corners(ring)
    return all(map(is_convex, around)) and all(is_convex((ring[0], p, q)) for _, p, q in around[1:-1])


def primitive(u: Vector) -> Vector:
    """The shortest integer vector along a line, one of its two."""
    k = gcd(*u) if u > (0, 0) else -gcd(*u)
    return u[0] // k, u[1] // k


def shortest(u: Vector) -> Vector:
    """The shortest integer vector in a direction."""
    k = gcd(*u)
    return u[0] // k, u[1] // k


# --- rough searches, in doubles ---

Boxes = NDArray[np.float64]  # (n, 4): xmin, ymin, xmax, ymax


def boxes(rings: Iterable[Ring], unit: Exact) -> Boxes:
    """Boxes around rings of integers, in a unit as large as the scene; larger by more than their rounding."""
    extremes = [[extreme(axis) / unit for extreme in (min, max) for axis in zip(*ring, strict=True)] for ring in rings]
    return np.array(extremes, float).reshape(-1, 4) + 2.0**-40 * np.array([-1, -1, 1, 1])


def roughly(ring: Iterable[Vector], unit: Exact) -> NDArray[np.complex128]:
    """Points x + yi, rounded."""
    return np.array([complex(x / unit, y / unit) for x, y in ring])


def near(around: Boxes, box: Boxes) -> list[int]:
    """Numbers of the boxes that meet a box."""
    meets = (around[:, :2] <= box[2:]) & (box[:2] <= around[:, 2:])
    numbers: list[int] = np.flatnonzero(meets.all(axis=1)).tolist()
    return numbers
