"""Scenes that prove a path's distance: a robot larger by a square or a disc, in smaller bounds."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from fractions import Fraction
from itertools import pairwise
from math import lcm

from cfree.exact.number import ExactPoint
from cfree.planning.separation import Separated
from cfree.polygons.minkowski import convex_sum
from cfree.polygons.polygon import Polygon
from cfree.verify.inside import is_near
from cfree.verify.polygons import Ring, rectangle
from cfree.verify.surfaces import cross, dot, minus
from cfree.verify.world import World

TURNING = Fraction(1, 2**21)  # of a clearance: half the square by which a smaller robot is larger where it turns


def roomier(world: World, leeway: Fraction) -> World | None:
    """World in which only poses are free at which the robot keeps a distance; None if nothing is left of the bounds.

    The robot is larger by the square [-leeway, leeway]^2 in its own frame, and so by a disc of that radius.
    """
    larger = _finer(world, leeway.denominator)
    by = int(leeway * larger.scale)
    if world.bounds:
        x0, y0, x1, y1 = larger.bounds
        larger.bounds = [x0 + by, y0 + by, x1 - by, y1 - by]
        if x0 + by >= x1 - by or y0 + by >= y1 - by:
            return None
    if by:
        larger.parts = [convex_sum(ring, rectangle(-by, -by, by, by)) for ring in larger.parts]
    return larger


def with_disc(world: World, disc: Sequence[ExactPoint]) -> World:
    """World in which the robot is larger by a convex polygon in its own frame."""
    larger = _finer(world, lcm(*(c.denominator for point in disc for c in point)))
    ring = [(int(x * larger.scale), int(y * larger.scale)) for x, y in disc]
    larger.parts = [convex_sum(part, ring) for part in larger.parts]
    return larger


def turning(world: World, proof: Separated) -> World | None:
    """World of the smaller robot of a proof about a clearance, larger by a square.

    Where this robot is free at a place, the smaller one turns without touching. Orientations at which the scene's robot
    keeps the clearance are among these if all of this one is nearer to it than that. Else the result is None.
    """
    by = TURNING * proof.clearance
    square = [(-by, -by), (by, -by), (by, by), (-by, by)]
    larger = [Polygon(convex_sum(part.exact_vertices, square)) for part in proof.robot]
    cores = zip(proof.robot, larger, proof.cores, strict=True)
    if not all(_is_convex(part) and is_near(grown, core, proof.clearance) for part, grown, core in cores):
        return None
    smaller = _finer(world, lcm(*(part.denominator for part in larger)))
    smaller.parts = [
        [(int(x * smaller.scale), int(y * smaller.scale)) for x, y in part.exact_vertices] for part in larger
    ]
    return smaller


def _is_convex(polygon: Polygon) -> bool:
    return len(polygon.ring_offsets) == 2 and bool(polygon.convex.all())


def is_around_disc(ring: Sequence[ExactPoint], radius: Fraction) -> bool:
    """True if a ring is a convex polygon, counter-clockwise, with a disc about the origin inside."""
    ends = list(pairwise([*ring, *ring[:2]]))
    turns = (cross(minus(q, p), minus(s, q)) > 0 for (p, q), (_, s) in pairwise(ends))
    heights = (cross(p, q) for p, q in ends)
    squares = (radius**2 * dot(minus(q, p), minus(q, p)) for p, q in ends)
    far = (h > 0 and h * h >= square for h, square in zip(heights, squares, strict=True))
    upwards = sum(p[1] < 0 <= q[1] for p, q in ends[:-1])  # once around, and not twice
    return all(turns) and all(far) and upwards == 1


def _finer(world: World, factor: int) -> World:
    """The same world in other coordinates."""
    finer = copy(world)
    finer.scale, finer.unit = factor * world.scale, factor * world.unit
    finer.bounds = [factor * b for b in world.bounds]
    finer.obstacle_pieces = [_scaled(ring, factor) for ring in world.obstacle_pieces]
    finer.parts = [_scaled(ring, factor) for ring in world.parts]
    return finer


def _scaled(ring: Ring, factor: int) -> Ring:
    return [(factor * x, factor * y) for x, y in ring]
