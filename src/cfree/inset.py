"""Robots a little smaller: polygons strictly inside the robot's, by exact tests, and the free space they have.

A pose at which the smaller robot touches an obstacle is one at which the robot overlaps it. docs/theory.md,
"Separations", says what that proves.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

import shapely

from cfree.polygon import Polygon
from cfree.scene import Scene

if TYPE_CHECKING:
    from cfree.cells import FreeSpace

FINER = 12  # bits of an inset that survive the rounding of its polygons


def size_power(scene: Scene) -> int:
    """The power of two that is about as large as the robot."""
    x0, y0, x1, y1 = shapely.union_all([part.to_shapely() for part in scene.robot]).bounds
    return math.frexp(max(x1 - x0, y1 - y0))[1]


def inset(polygon: Polygon, by: float) -> list[Polygon]:
    """Polygons strictly inside one, their edges moved inwards; none if nothing is left, or rounding is in the way.

    Corners are mitred, coordinates multiples of a power of two that is finer than the inset.

    Examples
    --------
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> [part.exact_area for part in inset(square, 0.25)], inset(square, 0.5)
    ([Fraction(1, 4)], [])
    """
    from cfree.verify.inside import strictly_inside

    grid = Fraction(2) ** (math.frexp(by)[1] - FINER)

    def snapped(ring: shapely.LinearRing) -> list[tuple[Fraction, Fraction]]:
        x, y = ([round(Fraction(c) / grid) * grid for c in axis] for axis in ring.coords.xy)
        return list(zip(x, y, strict=True))

    found = []
    for part in shapely.get_parts(polygon.to_shapely().buffer(-by, join_style="mitre")):
        try:
            smaller = Polygon(snapped(part.exterior), [snapped(hole) for hole in part.interiors])
        except ValueError:  # too thin for the grid
            continue
        if strictly_inside(smaller, polygon):
            found.append(smaller)
    return found


def inset_space(space: FreeSpace, power: int) -> FreeSpace | None:
    """Free space of a robot smaller by 2**power in bounds as much larger; None if nothing is left of the robot."""
    from cfree.cells import free_space
    from cfree.forbidden import boundary

    if power not in space.insets:
        scene, by = space.boundary.scene, Fraction(2) ** power
        robot = [smaller for part in scene.robot for smaller in inset(part, float(by))]
        x0, y0, x1, y1 = scene.bounds or (by, by, -by, -by)
        bounds = scene.bounds and (x0 - by, y0 - by, x1 + by, y1 + by)
        space.insets[power] = free_space(boundary(with_robot(scene, robot, bounds))) if robot else None
    return space.insets[power]


def with_robot(
    scene: Scene,
    robot: list[Polygon] | tuple[Polygon, ...],
    bounds: tuple[Fraction, Fraction, Fraction, Fraction] | None,
) -> Scene:
    """A scene with another robot, in other bounds."""
    return Scene(robot, scene.obstacles, bounds=bounds, workspace=scene.workspace)
