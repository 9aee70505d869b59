"""Robots a little larger: convex polygons around all that is within a distance of the robot."""

from __future__ import annotations

import math
from fractions import Fraction

from cfree.exact.number import ExactPoint
from cfree.polygons.minkowski import convex_sum
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene

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
    ring = [(radius * x, radius * y) for x, y in _around_a_disc()]
    return [piece for part in scene.robot for piece in _sums(part, ring)]


def grown_by_square(scene: Scene, half: Fraction) -> list[Polygon]:
    """The robot's Minkowski sum with the square [-half, half]^2, in the same way."""
    ring = [(-half, -half), (half, -half), (half, half), (-half, half)]
    return [piece for part in scene.robot for piece in _sums(part, ring)]


def _around_a_disc() -> list[ExactPoint]:
    grid, far = 2**30, ROUNDING / math.cos(math.pi / SIDES)
    angles = [2 * math.pi * k / SIDES for k in range(SIDES)]
    return [
        (Fraction(round(far * math.cos(a) * grid), grid), Fraction(round(far * math.sin(a) * grid), grid))
        for a in angles
    ]


def _sums(polygon: Polygon, ring: list[ExactPoint]) -> list[Polygon]:
    """Convex polygons that cover the Minkowski sum of a polygon and a convex ring."""
    vertices = polygon.exact_vertices
    return [Polygon(convex_sum([vertices[k] for k in piece], ring)) for piece in polygon.pieces]
