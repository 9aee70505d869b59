"""What a path keeps its distance from: the scene, for a robot larger by a square, in smaller bounds."""

from __future__ import annotations

from copy import copy
from fractions import Fraction

from cfree.polygons.minkowski import convex_sum
from cfree.verify.polygons import Ring, rectangle
from cfree.verify.world import World


def roomier(world: World, leeway: Fraction) -> World | None:
    """A world in which only poses are free at which the robot keeps a distance; None if nothing is left of the bounds.

    The robot is larger by the square [-leeway, leeway]^2 in its own frame, and so by a disc of that radius.
    """
    factor = leeway.denominator
    found = copy(world)
    found.scale, found.unit = factor * world.scale, factor * world.unit
    by = int(leeway * found.scale)
    if world.bounds:
        x0, y0, x1, y1 = (factor * b for b in world.bounds)
        found.bounds = [x0 + by, y0 + by, x1 - by, y1 - by]
        if x0 + by >= x1 - by or y0 + by >= y1 - by:
            return None
    found.walls = [_scaled(ring, factor) for ring in world.walls]
    found.parts = [_scaled(ring, factor) for ring in world.parts]
    if by:
        found.parts = [convex_sum(ring, rectangle(-by, -by, by, by)) for ring in found.parts]
    return found


def _scaled(ring: Ring, factor: int) -> Ring:
    return [(factor * x, factor * y) for x, y in ring]
