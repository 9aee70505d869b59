"""Slides from a pose that is in two contacts: the rational curve on which both are kept.

At an orientation the reference point is on a line for each contact. In the half-angle tangent t of the turning both
lines are rational, and so is the point where they meet; if they coincide at t = 0, common factors are divided out.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np
from flint import fmpq, fmpq_poly

from cfree.collision.slide import Slide, Touch, control_points, terms_of
from cfree.contact.kind import Kind
from cfree.errors import InvalidPoseError
from cfree.exact.half_angle import half_angle_rotation
from cfree.exact.pose import Pose
from cfree.planning.exact_face import Contact, Curve, as_flint, contact_line, curve_cross, positions_over
from cfree.scene.features import SceneFeatures, ShapeFeatures


def slide(features: SceneFeatures, pose: Pose, first: Contact, last: Contact, tau: Fraction) -> Slide | None:
    """Along two contacts that a pose is in, as far as the half-angle tangent; it need not be free.

    None if a contact is not one of the scene's own features, the lines become parallel or do not meet at the pose, or
    Bernstein coefficients do not say that the points of contact stay within their edges: shorter slides may exist.
    """
    touches = [touch(features, *contact) for contact in (first, last)]
    meeting = _meeting(features, pose, first, last)
    if None in touches or meeting is None or not all(_within_edge(*share, tau) for share in meeting[1]):
        return None
    x, y, d = map(terms_of, meeting[0])
    try:
        return Slide((touches[0], touches[1]), x, y, d, tau)
    except InvalidPoseError:  # the lines are parallel on the way, or do not meet at the pose
        return None


def same_line(features: SceneFeatures, contact: Contact) -> Iterator[Contact]:
    """A contact, and the contacts of other edges on its edge's line: a curve's name stands for all of them."""
    kind, i, j = contact
    shape, edge = (features.obstacles, j) if kind == Kind.VERTEX_EDGE else (features.robot, i)
    line = shape.core.line
    for other in np.flatnonzero(line[: len(shape.previous)] == line[edge]).tolist():
        yield (kind, i, other) if kind == Kind.VERTEX_EDGE else (kind, other, j)


def touch(features: SceneFeatures, kind: int, i: int, j: int) -> Any:
    """A contact as files name it; None if no vertex of the scene is there, or the two never touch."""

    def feature(shape: ShapeFeatures, k: int) -> tuple[int, int]:
        return int(shape.owner_polygon[k]), int(shape.owner_vertex[k])

    robot, obstacle = feature(features.robot, i), feature(features.obstacles, j)
    together = features.robot.core.layer[i] == features.obstacles.core.layer[j]  # only the reference point has bounds
    if not together or min(robot[1], obstacle[1]) < 0:
        return None
    return Touch("vertex-edge" if kind == Kind.VERTEX_EDGE else "edge-vertex", robot, obstacle)


def _meeting(
    features: SceneFeatures, pose: Pose, first: Contact, last: Contact
) -> tuple[tuple[fmpq_poly, ...], list[Curve]] | None:
    """x, y, d: where two contact lines meet, from the pose; and the shares of both edges. None if they never do."""
    c, s, w = half_angle_rotation(pose.tau)
    c0, s0 = fmpq(c, w), fmpq(s, w)
    turn = fmpq_poly([c0, -2 * s0, -c0]), fmpq_poly([s0, 2 * c0, -s0]), fmpq_poly([1, 0, 1])
    (P, U), (Q, V) = (positions_over(contact_line(features, *contact), *turn) for contact in (first, last))
    across = curve_cross(U, V)
    if not across:
        return None
    # P + s U = Q + r V, s = (Q - P) x V / U x V and r = (Q - P) x U / U x V; all of them are over w
    between = Q[0] - P[0], Q[1] - P[1]
    along = curve_cross(between, V)
    d = turn[2] * across
    x, y = (P[k] * across + along * U[k] - as_flint((pose.x, pose.y)[k]) * d for k in (0, 1))
    return _reduced(x, y, d), [_reduced(along, across), _reduced(curve_cross(between, U), across)]


def _reduced(*parts: fmpq_poly) -> Any:
    """Without common factors."""
    common = parts[-1]
    for part in parts[:-1]:
        common = common.gcd(part)
    return tuple(part // common for part in parts)


def _within_edge(share: fmpq_poly, whole: fmpq_poly, tau: Fraction) -> bool:
    """Is a quotient certainly between 0 and 1 for t from 0 to tau?"""
    low, high, positive = (
        min(control_points(terms_of(part * whole(0)), tau)) for part in (share, whole - share, whole)
    )
    return positive > 0 and low >= 0 and high >= 0
