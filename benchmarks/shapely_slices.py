"""The baseline of slices: convex hulls of the sums O_k (+) -R A_p over convex pieces, united by shapely.

Pieces are those of cfree and are prepared beforehand, as arrays grouped by their number of vertices. Two ways to make
the sums: `sums_by_hull` as shapely offers it, and `sums_by_merging`, which needs no hull since both are convex:
the edges of the sum are the edges of the two, sorted by direction.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product

import numpy as np
import shapely
from numpy.typing import NDArray

import cfree

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Pieces:
    """Convex pieces with the same number of vertices, and their edges.

    corners, edges : (pieces, n, 2); angles : (pieces, n)
    """

    corners: Floats
    edges: Floats
    angles: Floats

    @classmethod
    def of(cls, corners: Floats) -> Pieces:
        edges = np.roll(corners, -1, axis=1) - corners
        return cls(corners, edges, np.arctan2(edges[..., 1], edges[..., 0]))

    def first(self) -> Floats:
        """Where the edge of least angle starts, (pieces, 2)."""
        return np.take_along_axis(self.corners, self.angles.argmin(1)[:, None, None], 1)[:, 0]


def pieces_of(polygons: Iterable[cfree.Polygon]) -> list[Pieces]:
    return grouped(polygon.vertices[list(piece)] for polygon in polygons for piece in polygon.pieces)


def grouped(pieces: Iterable[Floats]) -> list[Pieces]:
    by_size: dict[int, list[Floats]] = {}
    for piece in pieces:
        by_size.setdefault(len(piece), []).append(piece)
    return [Pieces.of(np.array(corners)) for corners in by_size.values()]


def turned(robot: list[Pieces], theta: float) -> list[Pieces]:
    """-R(theta) A."""
    c, s = math.cos(theta), math.sin(theta)
    return [Pieces.of(-part.corners @ np.array([[c, s], [-s, c]])) for part in robot]


def sums_by_hull(robot: list[Pieces], obstacles: list[Pieces], theta: float) -> NDArray[np.object_]:
    sums = []
    for a, b in product(turned(robot, theta), obstacles):
        points = b.corners[None, :, :, None] + a.corners[:, None, None]
        pairs, each = len(a.corners) * len(b.corners), points.shape[2] * points.shape[3]
        owner = np.repeat(np.arange(pairs), each)
        sums.append(shapely.convex_hull(shapely.multipoints(points.reshape(-1, 2), indices=owner)))
    return np.concatenate(sums)


def sums_by_merging(robot: list[Pieces], obstacles: list[Pieces], theta: float) -> NDArray[np.object_]:
    sums = []
    for a, b in product(turned(robot, theta), obstacles):
        shape = len(a.corners), len(b.corners), a.corners.shape[1] + b.corners.shape[1]
        order = np.argsort(_pairs(a.angles, b.angles).reshape(shape), axis=2)
        edges = np.take_along_axis(_pairs(a.edges, b.edges).reshape(*shape, 2), order[..., None], axis=2)
        start = (a.first()[:, None] + b.first()[None])[:, :, None]
        rings = np.concatenate([start, start + np.cumsum(edges, axis=2)], axis=2)
        rings[:, :, -1] = rings[:, :, 0]
        sums.append(shapely.polygons(rings.reshape(-1, shape[2] + 1, 2)))
    return np.concatenate(sums)


def _pairs(a: Floats, b: Floats) -> Floats:
    """Items of a and of b, for each pair of pieces, one after the other."""
    rest = a.shape[2:]
    left = np.broadcast_to(a[:, None], (len(a), len(b), a.shape[1], *rest))
    right = np.broadcast_to(b[None], (len(a), len(b), b.shape[1], *rest))
    return np.concatenate([left, right], axis=2)
