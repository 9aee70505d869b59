"""The side of a closed surface that a pose is on, by pieces on a ray towards -x, just after its orientation.

The pose's own orientation may be critical. A pose that is on no piece keeps its side when it is turned a little, so all
signs are those at tau + epsilon: those of the first derivative that is not zero.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from math import inf, lcm, nextafter
from typing import TYPE_CHECKING

import numpy as np
from flint import fmpz_poly

from cfree.exact.algebraic import sign
from cfree.verify.surfaces import Curve, Fault, Surface, Turn, Vector, dot, polynomial
from cfree.verify.trapezoids import Trapezoid

if TYPE_CHECKING:
    from cfree.exact.pose import Pose
    from cfree.verify.columns import Columns


def chart_of(pose: Pose) -> tuple[int, Fraction]:
    """Chart and tau of an orientation; the end of a chart is the beginning of the next."""
    tau = pose.tau
    if tau is not None and -1 <= tau < 1:
        return 0, tau
    return 1, Fraction(0) if tau is None else -1 / tau


def around(columns: Columns, pose: Pose, scale: int) -> list[int]:
    """Numbers of the pieces that may hold a pose, or be on the ray from it.

    Notes
    -----
    Left out are those of other orientations, and those with both ends strictly above the ray, or below.
    """
    table, numbers = columns.table, set[int]()
    for turn in (Turn(*place) for place in Turn.of(*chart_of(pose)).in_charts()):
        tau = float(turn.tau)
        holds = (table.from_lo <= nextafter(tau, inf)) & (nextafter(tau, -inf) <= table.to_hi)
        rows = np.flatnonzero(holds & (table.chart == turn.chart)).tolist()
        numbers.update(k for k in rows if abs(sum(_heights(columns, k, turn, pose.y * scale))) < 2)
    return sorted(numbers)


def _heights(columns: Columns, k: int, turn: Turn, y: Fraction) -> Iterator[int]:
    """Yield the signs of the heights of both ends of a piece over a line; 0 is also one that is not known."""
    line = turn.line(columns.surfaces[k])
    above = y.denominator * line.start[1] - turn.w * y.numerator
    for n, d in columns.forms(k):
        z = turn.value(d)
        height = (above * z + y.denominator * line.along[1] * turn.value(n)) * z
        yield (height > 0) - (height < 0)


def is_inside(pose: Pose, scale: int, pieces: Iterable[Trapezoid]) -> bool:
    """True if the ray from a pose meets pieces an odd number of times. Raises Fault if the pose is on one of them."""
    chart, tau = chart_of(pose)
    turn, q = Turn.of(chart, tau), (pose.x * scale, pose.y * scale)
    crossings = 0
    for piece in pieces:
        for where in (Turn(*place) for place in turn.in_charts() if place[0] == piece.chart):
            if piece.start <= where.root <= piece.stop and _is_on(piece, where, q):
                raise Fault("it is on the surface")
        if piece.chart == chart and piece.start <= turn.root < piece.stop:
            crossings += _is_crossed(piece, turn, q)
    return crossings % 2 == 1


def _is_on(piece: Trapezoid, turn: Turn, q: Vector) -> bool:
    """True if a point is on a piece at an orientation."""
    line = turn.line(piece.surface)
    beyond = turn.w * q[0] - line.start[0], turn.w * q[1] - line.start[1]
    if line.along[0] * beyond[1] != line.along[1] * beyond[0]:
        return False
    t = dot(beyond, line.along) / Fraction(dot(line.along, line.along))
    return bool(piece.lower.at(turn.tau) <= t <= piece.upper.at(turn.tau))


def _is_crossed(piece: Trapezoid, turn: Turn, q: Vector) -> bool:
    """True if the ray from a point meets a piece just after an orientation.

    Notes
    -----
    Ends that several pieces share count the same for all: as above the ray only if they are strictly above it.
    """
    lower, upper = (_is_above(curve, piece.surface, turn, q) for curve in (piece.lower, piece.upper))
    if lower == upper:
        return False
    s, unit = piece.surface, lcm(q[0].denominator, q[1].denominator)
    beta, alpha = (int(unit * (q[0] - s.b[0])), int(unit * (q[1] - s.b[1]))), (-unit * s.a[0], -unit * s.a[1])
    side = _sign_after(polynomial(s.form(beta, alpha), turn.chart), turn.tau)  # of U x (q - S(0))
    if side == 0:
        raise Fault("it is on the surface")
    return (side < 0) == upper


def _is_above(curve: Curve, s: Surface, turn: Turn, q: Vector) -> bool:
    """True if the point of a curve is strictly above a point just after an orientation."""
    unit = q[1].denominator
    fixed = polynomial((s.b[1] * unit - q[1].numerator, -s.a[1] * unit, -s.a[0] * unit), turn.chart)
    along = polynomial((s.q[1] * unit, -s.g[1] * unit, -s.g[0] * unit), turn.chart)
    height = _sign_after(fixed * curve.d + along * curve.n, turn.tau)
    return height * _sign_after(curve.d, turn.tau) > 0


def _sign_after(poly: fmpz_poly, tau: Fraction) -> int:
    """Sign of a polynomial just after a number; 0 only if it vanishes everywhere."""
    while poly:
        if here := sign([int(c) for c in poly.coeffs()], tau):
            return here
        poly = poly.derivative()
    return 0
