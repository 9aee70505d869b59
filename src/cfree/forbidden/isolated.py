"""Exact fits as lines to draw: curves, segments and arcs at one orientation, and points (lines of length 0)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from cfree.contact.kind import Kind
from cfree.exact.half_angle import tau_in
from cfree.forbidden.columns import CURVE, SEGMENT
from cfree.libraries import Floats, np

if TYPE_CHECKING:
    from cfree.forbidden.record import BoundaryRecord

STEP = math.radians(2)
SAME = 1e-9  # radians; for pictures only


def isolated_lines(boundary: BoundaryRecord) -> list[Floats]:
    """Return lines of all isolated parts, (k, 3) each: x, y and theta in degrees, in [0, 360].

    A curve across theta = 0 is cut there.
    """
    parts, lines = boundary.isolated, []
    for k, (kind, first, last) in enumerate(zip(parts.kind, parts.theta_from, parts.theta_to, strict=True)):
        if kind != CURVE:
            place = _at_one_angle(boundary, k, float(first))
            lines.append(_raised(place, np.full(len(place), first)))
            continue
        pieces = [(first, last)] if first >= 0 or last <= 0 else [(first, 0.0), (0.0, last)]
        for start, stop in pieces:
            theta = np.linspace(start, stop, 2 + int((stop - start) / STEP))
            lines.append(_raised(_on_curve(boundary, k, theta), theta))
    return lines


def isolated_at(boundary: BoundaryRecord, theta: float) -> list[Floats]:
    """Return the isolated parts at an orientation: points (1, 2) of curves, segments and points (2, 2), arcs (n, 2)."""
    parts, lines = boundary.isolated, []
    for k, (kind, first, last) in enumerate(zip(parts.kind, parts.theta_from, parts.theta_to, strict=True)):
        turned = first + (theta - first + SAME) % math.tau - SAME
        if turned > last + SAME:
            continue
        if kind == CURVE:
            lines.append(_on_curve(boundary, k, np.array([turned])))
        else:
            lines.append(_at_one_angle(boundary, k, float(turned)))
    return lines


def is_isolated_arc(boundary: BoundaryRecord, k: int) -> bool:
    """True if an isolated part is an arc at one orientation."""
    parts = boundary.isolated
    is_on_circle = boundary.contact_kind[parts.patch[k]] & 15 == Kind.VERTEX_VERTEX
    return bool(parts.kind[k] == SEGMENT and is_on_circle)


def _at_one_angle(boundary: BoundaryRecord, k: int, theta: float) -> Floats:
    """Return the ends of a segment, a point twice, or points along an arc, which is in a quadrant of its circle."""
    parts = boundary.isolated
    patch, t = [parts.lower_patch[k], parts.upper_patch[k]], [parts.first_t[k], parts.last_t[k]]
    ends = boundary.evaluate(patch, t, [theta, theta])
    if not is_isolated_arc(boundary, k):
        return ends
    one = int(parts.patch[k])
    rho, quadrant = float(boundary.patch_radius[one]), int(boundary.contact_kind[one]) >> 4
    psi = math.pi / 2 * (quadrant + (rho < 0))  # where t is 0
    center = boundary.evaluate([one], [0.0], [theta])[0] - rho * np.array([math.cos(psi), math.sin(psi)])
    first, last = (math.atan2(y, x) for x, y in ends - center)
    turn = (last - first + math.pi) % math.tau - math.pi
    along = np.linspace(first, first + turn, 2 + int(abs(turn) / STEP))
    return np.asarray(center + abs(rho) * np.column_stack((np.cos(along), np.sin(along))))


def _on_curve(boundary: BoundaryRecord, k: int, theta: Floats) -> Floats:
    """Return points of the isolated curve k, (n, 2), where the curve that names it meets its patch's line."""
    chart = np.full(len(theta), boundary.isolated.chart[k])
    t = boundary._slicer.isolated_curve(k, np.ascontiguousarray(tau_in(chart, theta)))
    return boundary.evaluate(np.full(len(theta), boundary.isolated.lower_patch[k]), t, theta)


def _raised(xy: Floats, theta: Floats) -> Floats:
    """Return x, y and degrees in [0, 360]: lines below 0 are raised by a turn."""
    turn = 360.0 if theta.mean() < -SAME else 0.0
    return np.column_stack((xy, np.degrees(theta) + turn))
