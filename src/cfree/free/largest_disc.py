"""Poses of a cell with much room around them: discs inscribed in slices."""

from __future__ import annotations

import math

import numpy as np
import shapely

from cfree.arguments import checked
from cfree.exact.pose import Pose
from cfree.free.space import Cell

ORIENTATIONS = 9
PRECISION = 1e-3  # of a disc's radius, relative to its slice's extent


@checked
def largest_disc(cell: Cell) -> tuple[Pose, float] | None:
    """Return a pose in a cell, and the radius of a collision-free disc of positions around it at its orientation.

    Returns
    -------
    (Pose, float) or None
        The largest disc at nine orientations of the cell; None if the cell is too narrow there for a disc larger than
        rounding. In an unbounded cell, the largest near the obstacles; infinite if there are none.

    Examples
    --------
    >>> import cfree
    >>> room = [(0, 0), (4, 0), (4, 4), (0, 4)]
    >>> scene = cfree.Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], workspace=room)
    >>> pose, radius = largest_disc(cfree.free_space(cfree.boundary(scene)).cells[0])
    >>> round(radius, 3)
    1.5
    """
    boundary = cell.free_space.surfaces
    start, stop = cell.theta_range
    if len(boundary.trapezoids) == 0:
        return Pose(0, 0), math.inf
    best: tuple[Pose, float] | None = None
    for k in range(ORIENTATIONS):
        theta = float(np.mod(start + (stop - start) * (k + 0.5) / ORIENTATIONS, 2 * np.pi))
        forbidden = boundary.slice(theta).forbidden
        frame = boundary.features.rim or _around(forbidden)
        for part in shapely.get_parts(shapely.box(*frame).difference(forbidden)).tolist():
            disc = shapely.maximum_inscribed_circle(part, PRECISION * part.length)
            (x, y), radius = disc.coords[0], shapely.length(disc)
            if best is not None and radius <= best[1]:
                continue
            pose = Pose(x, y, theta)
            if cell.free_space.locate(pose) == cell.index:
                best = pose, float(radius)
    return best


def _around(region: shapely.Geometry) -> tuple[float, float, float, float]:
    """Return a rectangle around a region, wider by a quarter on each side."""
    x0, y0, x1, y1 = region.bounds
    margin = max(x1 - x0, y1 - y0) / 4
    return x0 - margin, y0 - margin, x1 + margin, y1 + margin
