"""Volume of the poses in which one convex polygon meets another: Blaschke's kinematic formula.

docs/theory/volumes.md has the proof. The measure dx dy dtheta is the same in every frame.
"""

from __future__ import annotations

import math

from cfree.arguments import checked
from cfree.polygons.polygon import Polygon


@checked
def meeting_volume(robot: Polygon, obstacle: Polygon) -> float:
    """Volume of the poses of a convex robot that meet a convex obstacle, in closed form.

    Returns
    -------
    float
        2 pi (A_1 + A_2) + L_1 L_2 of areas A and perimeters L, in length^2 radians; its relative error is below 1e-14.

    Raises
    ------
    ValueError
        If a polygon is not convex, or has holes.

    Examples
    --------
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> meeting_volume(square, square) == 4 * math.pi + 16
    True
    """
    for name, polygon in (("robot", robot), ("obstacle", obstacle)):
        if not polygon.is_convex:
            raise ValueError(f"{name}: not convex; the formula is for convex polygons without holes")
    return math.tau * (robot.area + obstacle.area) + robot.perimeter * obstacle.perimeter
