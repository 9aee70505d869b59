"""The side of a closed surface of grown cores that a pose is on: crossings of a ray towards -x.

A free pose of the true robot keeps the surface's side if it is moved a little, for no pose near it is on the surface.
So the ray begins at a pose nearby at which all signs are certain.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from fractions import Fraction

from flint import arb, fmpq

from cfree.exact.pose import Pose
from cfree.verify.parity import chart_of
from cfree.verify.round_algebra import Ball, Turn
from cfree.verify.round_pieces import Piece, Scale
from cfree.verify.round_surfaces import UndecidedError, at_turn, direction

MOST = 40  # poses that are tried


def is_inside(pose: Pose, pieces: Sequence[Piece], scale: Scale, shift: arb, turn: arb) -> bool:
    """True if a ray from a pose meets the pieces an odd number of times. Raises UndecidedError.

    Parameters
    ----------
    shift, turn
        No more than this the pose is moved, and turned in tau.
    """
    rng = random.Random("rays")
    for _ in range(MOST):
        dx, dy, dt = (arb(fmpq(rng.randint(-(2**20), 2**20), 2**20)) for _ in range(3))
        chart, tau = chart_of(pose)
        place = arb(_q(pose.x)) + shift * dx, arb(_q(pose.y)) + shift * dy
        where = scale.integer(arb(_q(tau)) + turn * dt)
        if abs(where) >= 1 << scale.bits:
            chart, where = 1 - chart, where - ((2 << scale.bits) if where > 0 else -(2 << scale.bits))
            where = max(min(where, (1 << scale.bits) - 1), 1 - (1 << scale.bits))
        count = _crossings(chart, where, (place[0].mid(), place[1].mid()), pieces, scale)
        if count is not None:
            return count % 2 == 1
    raise UndecidedError("rays from near the pose meet ends of pieces")


def _q(x: Fraction) -> fmpq:
    return fmpq(x.numerator, x.denominator)


def _crossings(chart: int, where: int, place: tuple[arb, arb], pieces: Sequence[Piece], scale: Scale) -> int | None:
    """Number of pieces that a ray meets; None if that is not certain."""
    turn, far, count = scale.turn(chart, where), scale.near * 1024, 0
    for piece in pieces:
        if piece.chart != chart or where < piece.start - scale.step or where > piece.stop + scale.step:
            continue
        if where < piece.start + 4 * scale.step or where > piece.stop - 4 * scale.step:
            return None
        ends = [curve.point(turn) for curve in (piece.lower, piece.upper)]
        heights = [y - place[1] for _, y in ends]
        if not all(abs(h) > far for h in heights):
            return None
        if (heights[0] > 0) == (heights[1] > 0):
            continue
        x = _crossing(piece, turn, place[1], ends[0])
        if not abs(x - place[0]) > far:
            return None
        count += bool(x < place[0])
    return count


def _crossing(piece: Piece, turn: Turn, height: arb, on: tuple[Ball, Ball]) -> Ball:
    """Coordinate x at which a line, or a quadrant, has a height."""
    s = piece.surface
    if s.edge is not None:
        u, v = direction(s, turn)
        return on[0] + (height - on[1]) * u / v
    x, y = at_turn((s.b, s.a), turn)
    half = (arb(s.radius) ** 2 - (height - y) * (height - y)).sqrt()  # no power of a ball around 0
    return x + half if (piece.quadrant in (0, 3)) == (s.radius > 0) else x - half
