"""Polygons for the round shapes of a scene, each as near as it has to be."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.affinity import affine_transform

from cfree.curves.curved import Curved
from cfree.scene.scene import Scene, polygons_for, shapes_of, size_of, with_polygons

FIRST, FINEST = 64, 4096  # parts of a shape's size: the first error, and the least one that is started with
OF_ROBOT = 8  # or part of the robot's size, if that is less
TOLERANCE = 2.0**-14  # of the robot's size, unless given
FINER = 4  # of an error: twice as many edges


class Approximations:
    """Errors of a scene's shapes, which become less where it matters.

    Parameters
    ----------
    scene : Scene
    tolerance : float, optional
        The least error; a 2**14th of the robot's size if left out.
    """

    def __init__(self, scene: Scene, tolerance: float | None = None) -> None:
        if tolerance is not None and not 0 < tolerance < np.inf:
            raise ValueError(f"tolerance {tolerance}: give a length above 0")
        self.exact, self.shapes = scene, shapes_of(scene)
        size = max(map(size_of, scene.robot))
        self.tolerance = tolerance or size * TOLERANCE
        self.errors = [_first(shape, size) if isinstance(shape, Curved) else 0.0 for shape in self.shapes]
        self.reached = max(self.errors)

    def scene(self, *, outward: bool) -> Scene:
        """With polygons around what is forbidden, or inside of it."""
        return with_polygons(self.exact, self.errors, outward=outward)

    def refine(self, poses: NDArray[np.float64]) -> bool:
        """Divide the errors of what may overlap at these poses; False if they are as small as they may be.

        What overlaps is looked up in doubles: it is about where to look closer, and decides nothing.
        """
        least = [max(self.tolerance, shape.least_error) if isinstance(shape, Curved) else 0.0 for shape in self.shapes]
        open_ = {k for k, error in enumerate(self.errors) if error > least[k]}
        overlapping = self._overlapping(poses)
        chosen = overlapping & open_ if overlapping else open_
        self.reached = max((self.errors[k] for k in overlapping or range(len(self.errors))), default=0.0)
        for k in chosen:
            self.errors[k] = max(self.errors[k] / FINER, least[k])
        return bool(chosen)

    def _overlapping(self, poses: NDArray[np.float64]) -> set[int]:
        """Which shapes, polygons around them, overlap at one of the poses."""
        parts, count = len(self.exact.robot), len(self.exact.robot) + len(self.exact.obstacles)
        geometries = [
            shapely.union_all([polygon.to_shapely() for polygon in polygons_for(shape, error, k < count)])
            for k, (shape, error) in enumerate(zip(self.shapes, self.errors, strict=True))
        ]
        tree, found = shapely.STRtree(geometries[parts:count]), set[int]()
        for x, y, theta in poses:
            motion = [np.cos(theta), -np.sin(theta), np.sin(theta), np.cos(theta), x, y]
            for k, geometry in enumerate(geometries[:parts]):
                placed = affine_transform(geometry, motion)
                met = [parts + int(j) for j in tree.query(placed, predicate="intersects")]
                met = [j for j in met if self.errors[k] or self.errors[j]]
                if len(geometries) > count and not geometries[count].contains_properly(placed):
                    met.append(count)
                found |= {k, *met} if met else set()
        return found


def _first(shape: Curved, robot: float) -> float:
    size = shape.size
    return max(min(size / FIRST, max(robot / OF_ROBOT, size / FINEST)), shape.least_error)
