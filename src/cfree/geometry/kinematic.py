"""Volume of the poses in which one convex shape meets another: Blaschke's kinematic formula.

docs/theory/volumes.md has the proof. The measure dx dy dtheta is the same in every frame.
"""

from __future__ import annotations

import math

from cfree.arguments import checked
from cfree.contact.features import shape_features
from cfree.curves.curved import Curved
from cfree.polygons.polygon import Polygon


@checked
def meeting_volume(robot: Polygon | Curved, obstacle: Polygon | Curved) -> float:
    """Volume of the poses of a convex robot that meet a convex obstacle, in closed form.

    Parameters
    ----------
    robot, obstacle : Polygon or Curved
        Convex shapes of segments and circular arcs.

    Returns
    -------
    float
        2 pi (A_1 + A_2) + L_1 L_2 of areas A and perimeters L, in length^2 radians; its relative error is below 1e-14.

    Raises
    ------
    ValueError
        If a shape is not convex, or has holes.
    UnsupportedError
        If a shape has an ellipse, a Bézier curve or a spline.

    Examples
    --------
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> meeting_volume(square, square) == 4 * math.pi + 16
    True

    Two discs of radii 1 and 2 meet where their centres are less than 3 apart.

    >>> meeting_volume(Curved.circle((0, 0), 1), Curved.circle((0, 0), 2)) / (18 * math.pi**2)
    1.0
    """
    (area, length), (other_area, other_length) = _measures("robot", robot), _measures("obstacle", obstacle)
    return math.tau * (area + other_area) + length * other_length


def _measures(name: str, shape: Polygon | Curved) -> tuple[float, float]:
    """Area and perimeter of a convex shape."""
    convex = shape if isinstance(shape, Polygon) else shape_features(shape)
    if not convex.is_convex:
        raise ValueError(f"{name}: not convex; the formula is for convex shapes without holes")
    return convex.area, convex.perimeter
