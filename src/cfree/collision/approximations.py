"""Polygons for the round shapes of a scene, each as near as it has to be."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.affinity import affine_transform

from cfree.curves.curved import Curved
from cfree.errors import UndecidedError
from cfree.polygons.polygon import Polygon
from cfree.scene.features import WORKSPACE
from cfree.scene.scene import AnyShape, Scene, polygons_for, shapes_of, size_of, with_polygons

FIRST, FINEST = 256, 4096  # parts of a shape's size: the first error, and the least one that is started with
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

    def refine(self, poses: NDArray[np.float64], others: Iterable[int] = ()) -> bool:
        """Divide the errors of what may overlap at these poses; False if they are as small as they may be.

        Of two shapes that overlap the error of the one that has the larger becomes less, or that of both; then those of
        other obstacles become as small. What overlaps is looked up in doubles: it is about where to look closer, and
        decides nothing.

        Parameters
        ----------
        poses : (n, 3) array
            Rows x, y, theta.
        others : iterable of int
            Obstacles of the scene of polygons, by number: -2 is the workspace.
        """
        pairs = self._overlapping(poses)
        concerned = {k for pair in pairs for k in pair} or set(range(len(self.shapes)))
        self.reached = max(self.errors[k] for k in concerned)
        wanted: dict[int, float] = {}
        for pair in pairs or [(k,) for k in concerned]:
            target = max(self.errors[k] for k in pair) / FINER
            for k in pair:
                wanted[k] = min(target, wanted.get(k, target))
        if pairs:
            target = min(max(wanted.values()), self.reached / FINER)
            for k in others:
                owner = self._owner(k)
                wanted[owner] = min(target, wanted.get(owner, target))
        before = list(self.errors)
        for k, target in wanted.items():
            if isinstance(shape := self.shapes[k], Curved):
                self.errors[k] = min(before[k], max(target, self.tolerance, shape.least_error))
        return self.errors != before

    def _owner(self, number: int) -> int:
        """The shape that an obstacle's polygon is for."""
        if number == WORKSPACE:
            return len(self.shapes) - 1
        counts = [
            len(_polygons_for(shape, error, True))
            for shape, error in zip(self.exact.obstacles, self.errors[len(self.exact.robot) :], strict=False)
        ]
        return len(self.exact.robot) + int(np.searchsorted(np.cumsum(counts), number, side="right"))

    def _overlapping(self, poses: NDArray[np.float64]) -> set[tuple[int, int]]:
        """Which two shapes, one of them round, polygons around them, overlap at one of the poses."""
        parts, count = len(self.exact.robot), len(self.exact.robot) + len(self.exact.obstacles)
        geometries = [
            shapely.union_all([polygon.to_shapely() for polygon in _polygons_for(shape, error, k < count)])
            for k, (shape, error) in enumerate(zip(self.shapes, self.errors, strict=True))
        ]
        tree, found = shapely.STRtree(geometries[parts:count]), set[tuple[int, int]]()
        for x, y, theta in poses:
            motion = [np.cos(theta), -np.sin(theta), np.sin(theta), np.cos(theta), x, y]
            for k, geometry in enumerate(geometries[:parts]):
                placed = affine_transform(geometry, motion)
                met = [parts + int(j) for j in tree.query(placed, predicate="intersects")]
                if len(geometries) > count and not geometries[count].contains_properly(placed):
                    met.append(count)
                found |= {(k, j) for j in met if self.errors[k] or self.errors[j]}
        return found


def _polygons_for(shape: AnyShape, error: float, outward: bool) -> tuple[Polygon, ...]:
    """None where none can be proved: where to look closer decides nothing."""
    with suppress(UndecidedError):
        return polygons_for(shape, error, outward)
    return ()


def _first(shape: Curved, robot: float) -> float:
    size = shape.size
    return max(min(size / FIRST, max(robot / OF_ROBOT, size / FINEST)), shape.least_error)
