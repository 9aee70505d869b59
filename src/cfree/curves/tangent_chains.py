"""Chains of arcs, each made exactly tangent to the next one.

A joint of a chain has a rational unit vector n, the normal to the left of its direction. Let an arc lead from the joint
P with the normal n to the joint Q with the normal m, about the center P + r n; r is below 0 if it is clockwise. Then
Q = P + r (n - m). So rational normals and radii make all joints and centers rational. A chain closes by two of its
radii, or by lengths of the lines at its ends: they solve two linear equations.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, pairwise

from cfree.exact.number import ExactPoint, simplest_between
from cfree.exact.vectors import along, cross, dot, minus


@dataclass(frozen=True)
class Chain:
    """Joints of successive arcs, and the normals of those where they are tangent to what is beside them.

    Attributes
    ----------
    joints : tuple of points
        One more than arcs; the last one is the first one if the chain is closed.
    normals : tuple of unit vectors or None
        At each joint; None at an end that is a corner.
    """

    joints: tuple[ExactPoint, ...]
    normals: tuple[ExactPoint | None, ...]

    @property
    def is_closed(self) -> bool:
        return self.joints[0] == self.joints[-1]


Tangent = tuple[list[ExactPoint], list[ExactPoint]]  # joints and centers


def tangent_chain(chain: Chain, rounding: Fraction) -> Tangent | None:
    """Return joints and centers of a chain near one that is nearly tangent; None if there is none.

    Ends with a normal move along their lines. Ends without one stay, and so do all joints of a closed chain of two
    arcs. Radii are rounded by `rounding` at most.
    """
    joints, normals = chain.joints, [n for n in chain.normals if n is not None]
    if chain.normals[0] is None or chain.normals[-1] is None:
        return _to_corners(chain, rounding)
    if chain.is_closed and len(joints) == 3:  # two arcs of one circle
        radius = _radius_to(joints[0], normals[0], joints[1])
        return None if radius is None else ([*joints], [along(joints[0], radius, normals[0])] * 2)
    steps, radii, place = [minus(n, m) for n, m in pairwise(normals)], list[Fraction](), joints[0]
    for target, step in zip(joints[1:], steps, strict=True):
        radius = _radius(place, target, step, rounding)
        if radius is None:
            return None
        radii.append(radius)
        place = along(place, radius, step)
    ways = [*steps] if chain.is_closed else [*steps, _turned(normals[0]), _turned(normals[-1])]
    gap = minus(joints[-1], place)
    i, j = max(combinations(range(len(ways)), 2), key=lambda pair: abs(cross(ways[pair[0]], ways[pair[1]])))
    across = cross(ways[i], ways[j])
    if not across:
        return None
    start = joints[0]
    for k, share in ((i, cross(gap, ways[j]) / across), (j, cross(ways[i], gap) / across)):
        if k < len(steps):
            radii[k] += share
        elif k == len(steps):
            start = along(start, share, ways[k])
    places = [start]
    for radius, step in zip(radii, steps, strict=True):
        places.append(along(places[-1], radius, step))
    return places, [along(p, r, n) for p, r, n in zip(places, radii, normals, strict=False)]


def _to_corners(chain: Chain, rounding: Fraction) -> Tangent | None:
    """Return a chain that ends at corners, at one end or both."""
    joints, normals = chain.joints, chain.normals
    if normals[-1] is not None:
        return _reversed(_to_corners(Chain(joints[::-1], (*map(_opposite, normals[::-1]),)), rounding))
    if normals[0] is None:  # the second joint stays
        first = _reversed(_to_corners(Chain(joints[1::-1], (_opposite(normals[1]), None)), rounding))
        rest = _to_corners(Chain(joints[1:], normals[1:]), rounding)
        return first and rest and ([joints[0], *rest[0]], [*first[1], *rest[1]])
    places, centers = [joints[0]], list[ExactPoint]()
    for target, n, m in zip(joints[1:], normals, normals[1:], strict=False):
        assert n is not None
        place, step = places[-1], None if m is None else minus(n, m)
        radius = _radius_to(place, n, target) if step is None else _radius(place, target, step, rounding)
        if radius is None:
            return None
        centers.append(along(place, radius, n))
        places.append(target if step is None else along(place, radius, step))
    return places, centers


def _reversed(chain: Tangent | None) -> Tangent | None:
    return chain and (chain[0][::-1], chain[1][::-1])


def _opposite(n: ExactPoint | None) -> ExactPoint | None:
    return n and (-n[0], -n[1])


def _radius(start: ExactPoint, target: ExactPoint, step: ExactPoint, rounding: Fraction) -> Fraction | None:
    """Return the simplest radius about the one by which the end, start + radius step, is nearest to a target."""
    square = dot(step, step)
    if not square:
        return None
    best = dot(minus(target, start), step) / square
    return simplest_between(best - rounding, best + rounding) or None


def _radius_to(start: ExactPoint, n: ExactPoint, end: ExactPoint) -> Fraction | None:
    """Return the radius of the arc that begins with the normal n and ends at a point."""
    chord = minus(end, start)
    across = 2 * dot(n, chord)
    return dot(chord, chord) / across if across else None


def _turned(n: ExactPoint) -> ExactPoint:
    return n[1], -n[0]
