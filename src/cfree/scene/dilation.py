"""Robots a little larger: convex polygons around all that is within a distance of the robot, or in that."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

from cfree.exact.number import ExactPoint
from cfree.polygons.minkowski import convex_sum
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene, robot_radius

SIDES = 16  # of the polygon that stands for a disc
ROUNDING = 1 + 2**-20  # more than that of its coordinates
FARTHEST_OUT = ROUNDING**2 / math.cos(math.pi / SIDES)  # of its points, in radii


def grown(scene: Scene, radius: Fraction) -> list[Polygon]:
    """The robot's Minkowski sum with a polygon of 16 sides around a disc, in convex pieces that overlap.

    A pose at which this robot is free is one at which the scene's is at least `radius` from everything.

    Examples
    --------
    >>> square = Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> (piece,) = grown(square, Fraction(1, 2))
    >>> [round(b, 2) for b in piece.bounds]
    [-0.51, -0.51, 1.51, 1.51]
    """
    return grown_by(scene, [(radius * x, radius * y) for x, y in _around_a_disc()])


def grown_by_square(scene: Scene, half: Fraction) -> list[Polygon]:
    """The robot's Minkowski sum with the square [-half, half]^2, in the same way."""
    return grown_by(scene, [(-half, -half), (half, -half), (half, half), (-half, half)])


def grown_by(scene: Scene, ring: Sequence[ExactPoint]) -> list[Polygon]:
    """The robot's Minkowski sum with a convex polygon, in the same way; one of each convex piece, in their order."""
    rings = ([part.exact_vertices[k] for k in piece] for part in scene.robot for piece in part.pieces)
    return [Polygon(convex_sum(piece, ring)) for piece in rings]


def cores(scene: Scene, by: Fraction) -> list[Polygon]:
    """The robot's convex pieces, a little smaller, so that they are inside: no vertex moves by more than `by`."""
    found = []
    share = Fraction(2) ** min(math.frexp(by)[1] - 3 - math.frexp(robot_radius(scene))[1], -10)
    for part in scene.robot:
        for piece in part.pieces:
            ring = [part.exact_vertices[k] for k in piece]
            x, y = ((a + 2 * b + c) / 4 for a, b, c in zip(*ring[:3], strict=True))  # inside, with short numbers
            found.append(Polygon([(u + share * (x - u), v + share * (y - v)) for u, v in ring]))
    return found


def _around_a_disc() -> list[ExactPoint]:
    grid, far = 2**30, ROUNDING / math.cos(math.pi / SIDES)
    angles = [2 * math.pi * k / SIDES for k in range(SIDES)]
    return [
        (Fraction(round(far * math.cos(a) * grid), grid), Fraction(round(far * math.sin(a) * grid), grid))
        for a in angles
    ]
