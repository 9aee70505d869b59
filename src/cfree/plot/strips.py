"""Strips of trapezoids between angles: the material of meshes and pictures.

A contact surface is ruled by straight segments of constant theta (eqs. 5 and 8). So *rows* sweep a trapezoid, from its
lower to its upper curve, and two rows bound a strip:

    theta + step   lower o-----------------o upper
                         |                 |
    theta          lower o-----------------o upper    t ->
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cfree.forbidden.kinds import PatchKind

if TYPE_CHECKING:
    from cfree.forbidden.record import BoundaryRecord

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

CHORDS = 12
"""Straight parts of a trapezoid on a quadrant of a circle."""
THIN = 1e-9
"""Radians; lower trapezoids have no visible area, and doubles cannot distinguish their curves."""


@dataclass(frozen=True, eq=False)
class Strips:
    """Rows of all trapezoids; the rows of a *part* follow each other.

    Attributes
    ----------
    trapezoid : (r,) int64
    part : (r,) int64
        A trapezoid is one part, or two if theta = 0 cuts it; on a circle one or two for each of its `CHORDS`.
    theta : (r,) float64, radians, in [0, 2 pi]
    t : (r, 2) float64
        Limits of each row.
    share : (r, 2) float64
        The part of the trapezoid's width between them: 0 and 1, unless a trapezoid of an arc on an arc is divided.
    points : (r, 2, 2) float64
        The ends of each row in the plane.
    joined : (s,) int64
        Rows that bound a strip with the next row.
    """

    trapezoid: Ints
    part: Ints
    theta: Floats
    t: Floats
    share: Floats
    points: Floats
    joined: Ints


def strips(boundary: BoundaryRecord, step: float) -> Strips:
    """Return rows at most `step` radians apart.

    Notes
    -----
    Time and memory grow with the number of trapezoids plus the sum of their heights over `step`.
    """
    boundary.require_complete()
    table = boundary.trapezoids
    first, last = table.theta_from, table.theta_to
    # trapezoids across theta = 0 are cut there; the part below is raised by a turn
    (above,) = np.nonzero(last - np.maximum(first, 0) > THIN)
    (below,) = np.nonzero(np.minimum(last, 0) - first > THIN)
    trapezoid = np.concatenate((above, below))
    start = np.concatenate((np.maximum(first[above], 0), first[below]))
    stop = np.concatenate((last[above], np.minimum(last[below], 0)))
    chords = _chords(boundary)[trapezoid]
    chord = np.arange(int(chords.sum())) - np.repeat(np.cumsum(chords) - chords, chords)
    trapezoid, start, stop, chords = (np.repeat(x, chords) for x in (trapezoid, start, stop, chords))
    turn = np.where(start < 0, math.tau, 0.0)

    count = np.maximum(1, np.ceil((stop - start) / step)).astype(np.int64) + 1  # rows of each part
    part = np.repeat(np.arange(len(count)), count)
    row = np.arange(len(part)) - (np.cumsum(count) - count)[part]
    share = row / (count[part] - 1)
    theta = (1 - share) * start[part] + share * stop[part]

    # a curve may be 0 / 0 at its trapezoid's end (parallel edges): evaluate just inside
    margin = 1e-8 * (stop - start)[part]
    ids, inside = trapezoid[part], np.clip(theta, start[part] + margin, stop[part] - margin)
    limits = [np.clip(t, 0, 1) for t in boundary.limits(ids, inside)]
    patch = table.patch[ids]
    shares = np.stack([chord / chords, (chord + 1) / chords], axis=1)[part]
    if boundary.scene.curved:  # lines have one chord, so that their limits are not changed
        low, high = (np.arctan(t) for t in limits)
        limits = [
            np.where(chords[part] == 1, t, np.tan(low + s * (high - low)))
            for t, s in zip(limits, shares.T, strict=True)
        ]
    points = np.stack([boundary.evaluate(patch, t, theta) for t in limits], axis=1)
    joined = np.flatnonzero(part[1:] == part[:-1])
    return Strips(ids, part, theta + turn[part], np.stack(limits, axis=1), shares, points, joined)


def step_for(boundary: BoundaryRecord, rows: int, limits: tuple[float, float]) -> float:
    """Return the step, in radians within limits, that makes about `rows` rows besides one for each part."""
    heights = boundary.trapezoids.theta_to - boundary.trapezoids.theta_from
    return min(max(float(heights @ _chords(boundary)) / rows, limits[0]), limits[1])


def _chords(boundary: BoundaryRecord) -> Ints:
    """Return the number of straight parts of each trapezoid."""
    return np.where(boundary.patch_kind[boundary.trapezoids.patch] == PatchKind.ARC_ARC, CHORDS, 1)
