"""Exact fits as lines to draw: curves, segments at one orientation, and points (lines of length 0)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cfree.exact.half_angle import tau_in
from cfree.forbidden.columns import CURVE

if TYPE_CHECKING:
    from cfree.forbidden.record import BoundaryRecord

Floats = NDArray[np.float64]

STEP = math.radians(2)
SAME = 1e-9  # radians; for pictures only


def isolated_lines(boundary: BoundaryRecord) -> list[Floats]:
    """Return lines of all isolated parts, (k, 3) each: x, y and theta in degrees, in [0, 360].

    A curve across theta = 0 is cut there.
    """
    parts, lines = boundary.isolated, []
    for k, (kind, first, last) in enumerate(zip(parts.kind, parts.theta_from, parts.theta_to, strict=True)):
        if kind != CURVE:
            theta = np.array([first, last])
            patch, t = [parts.lower_patch[k], parts.upper_patch[k]], [parts.first_t[k], parts.last_t[k]]
            lines.append(_raised(boundary.evaluate(patch, t, theta), theta))
            continue
        pieces = [(first, last)] if first >= 0 or last <= 0 else [(first, 0.0), (0.0, last)]
        for start, stop in pieces:
            theta = np.linspace(start, stop, 2 + int((stop - start) / STEP))
            lines.append(_raised(_on_curve(boundary, k, theta), theta))
    return lines


def isolated_at(boundary: BoundaryRecord, theta: float) -> list[Floats]:
    """Return the isolated parts at one orientation: points (1, 2) of curves, segments and points (2, 2)."""
    parts, lines = boundary.isolated, []
    for k, (kind, first, last) in enumerate(zip(parts.kind, parts.theta_from, parts.theta_to, strict=True)):
        turned = first + (theta - first + SAME) % math.tau - SAME
        if turned > last + SAME:
            continue
        if kind == CURVE:
            lines.append(_on_curve(boundary, k, np.array([turned])))
        else:
            patch, t = [parts.lower_patch[k], parts.upper_patch[k]], [parts.first_t[k], parts.last_t[k]]
            lines.append(boundary.evaluate(patch, t, [turned, turned]))
    return lines


def _on_curve(boundary: BoundaryRecord, k: int, theta: Floats) -> Floats:
    """Return points of the isolated curve k, (n, 2), where the curve that names it meets its patch's line."""
    chart = np.full(len(theta), boundary.isolated.chart[k])
    t = boundary._slicer.isolated_curve(k, np.ascontiguousarray(tau_in(chart, theta)))
    return boundary.evaluate(np.full(len(theta), boundary.isolated.lower_patch[k]), t, theta)


def _raised(xy: Floats, theta: Floats) -> Floats:
    """Return x, y and degrees in [0, 360]: lines below 0 are raised by a turn."""
    turn = 360.0 if theta.mean() < -SAME else 0.0
    return np.column_stack((xy, np.degrees(theta) + turn))
