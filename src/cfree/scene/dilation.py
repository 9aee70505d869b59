"""Slightly larger or smaller robots: convex polygons around everything within a distance of the robot, or inside it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

from cfree.exact.number import ExactPoint
from cfree.polygons.minkowski import convex_sum
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene, robot_radius

SIDES = 16  # of the polygon that stands for a disc
ROUNDING = 1 + 2**-20  # exceeds the rounding of its coordinates
FARTHEST_OUT = ROUNDING**2 / math.cos(math.pi / SIDES)  # distance of its farthest point from the middle, in radii


def grown(scene: Scene, radius: Fraction) -> list[Polygon]:
    """Return the robot's Minkowski sum with a polygon of 16 sides around a disc, in convex pieces that overlap.

    Wherever this robot is free, the scene's robot is at least `radius` from everything.

    Examples
    --------
    >>> square = Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> (piece,) = grown(square, Fraction(1, 2))
    >>> [round(b, 2) for b in piece.bounds]
    [-0.51, -0.51, 1.51, 1.51]
    """
    return grown_by(scene, [(radius * x, radius * y) for x, y in _around_a_disc()])


def grown_by_square(scene: Scene, half: Fraction) -> list[Polygon]:
    """Return the robot's Minkowski sum with the square [-half, half]^2, in convex pieces that overlap."""
    return grown_by(scene, [(-half, -half), (half, -half), (half, half), (-half, half)])


def grown_by(scene: Scene, ring: Sequence[ExactPoint]) -> list[Polygon]:
    """Return the Minkowski sums of the robot's convex pieces with a convex polygon, in the order of the pieces."""
    rings = ([part.exact_vertices[k] for k in piece] for part in scene.robot for piece in part.pieces)
    return [Polygon(convex_sum(piece, ring)) for piece in rings]


def cores(scene: Scene, by: Fraction) -> list[Polygon]:
    """Return the robot's convex pieces, shrunk so that they are inside it: no vertex moves by more than `by`."""
    smaller = []
    share = Fraction(2) ** min(math.frexp(by)[1] - 3 - math.frexp(robot_radius(scene))[1], -10)
    for part in scene.robot:
        for piece in part.pieces:
            ring = [part.exact_vertices[k] for k in piece]
            x, y = ((a + 2 * b + c) / 4 for a, b, c in zip(*ring[:3], strict=True))  # inside, with short numbers
            smaller.append(Polygon([(u + share * (x - u), v + share * (y - v)) for u, v in ring]))
    return smaller


def _around_a_disc() -> list[ExactPoint]:
    grid, far = 2**30, ROUNDING / math.cos(math.pi / SIDES)
    angles = [2 * math.pi * k / SIDES for k in range(SIDES)]
    return [
        (Fraction(round(far * math.cos(a) * grid), grid), Fraction(round(far * math.sin(a) * grid), grid))
        for a in angles
    ]
