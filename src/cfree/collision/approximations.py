"""Polygons for the round shapes of a scene, each as fine as a decision needs."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from functools import cached_property

from cfree.curves.curved import Curved
from cfree.errors import InvalidPolygonError, UndecidedError
from cfree.libraries import NDArray, np, shapely
from cfree.polygons.polygon import Polygon
from cfree.scene.features import WORKSPACE
from cfree.scene.scene import AnyShape, Scene, polygons_for, shapes_of, size_of, with_polygons

FIRST, FINEST = 256, 4096  # parts of a shape's size: its first error, and the least first error
OF_ROBOT = 8  # part of the robot's size, which is the first error if that is less
TOLERANCE = 2.0**-14  # the default, in robot sizes
FINER = 4  # divisor of an error in a step: twice as many edges


class Approximations:
    """Errors of the polygons for a scene's shapes, reduced where a decision needs it.

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
        self._size = max(map(size_of, scene.robot))
        self.tolerance = tolerance or self._size * TOLERANCE

    @cached_property
    def errors(self) -> list[float]:
        """The error of each shape's polygons; 0 for a polygon."""
        return [_first(shape, self._size) if isinstance(shape, Curved) else 0.0 for shape in self.shapes]

    @cached_property
    def reached(self) -> float:
        """The largest error that was to be reduced last; at first the largest."""
        return max(self.errors)

    def least(self, shape: int) -> float:
        """Return the least error that a shape's polygons may have; 0 for a polygon."""
        its = self.shapes[shape]
        return max(self.tolerance, its.least_error) if isinstance(its, Curved) else 0.0

    def scene(self, *, outward: bool) -> Scene:
        """Return the scene with polygons around everything that is forbidden, or inside it."""
        return with_polygons(self.exact, self.errors, outward=outward)

    def nearby(self) -> Scene:
        """Return the scene with polygons inside the shapes, or around those that have none inside."""
        return with_polygons(self.exact, self.errors, outward=False, always=True)

    def refine(self, poses: NDArray[np.float64], others: Iterable[int] = ()) -> bool:
        """Divide the errors of shapes that may overlap at these poses; False if no error can become smaller.

        Of two shapes that overlap, the larger error is divided, or both are. Then the errors of the other obstacles
        become as small. Overlaps are looked up in doubles: they only choose the shapes to refine, and decide nothing.

        Parameters
        ----------
        poses : (n, 3) array
            Rows x, y, theta.
        others : iterable of int
            More obstacles to refine, numbered as in the scene of polygons; -2 is the workspace.
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
                owner = self.shape_of(k, outward=True)
                wanted[owner] = min(target, wanted.get(owner, target))
        before = list(self.errors)
        for k, target in wanted.items():
            if isinstance(shape := self.shapes[k], Curved):
                self.errors[k] = min(before[k], max(target, self.tolerance, shape.least_error))
        return self.errors != before

    def obstacle_of(self, number: int, *, outward: bool = False) -> int:
        """Return the obstacle that a polygon of the inner scene replaces, or one of the outer scene.

        Bounds and workspace keep their numbers.
        """
        return number if number < 0 else self.shape_of(number, outward=outward) - len(self.exact.robot)

    def shape_of(self, number: int, *, outward: bool) -> int:
        """Return the shape that an obstacle's polygon replaces."""
        if number == WORKSPACE:
            return len(self.shapes) - 1
        counts = [
            len(_polygons_for(shape, error, outward))
            for shape, error in zip(self.exact.obstacles, self.errors[len(self.exact.robot) :], strict=False)
        ]
        return len(self.exact.robot) + int(np.searchsorted(np.cumsum(counts), number, side="right"))

    def _overlapping(self, poses: NDArray[np.float64]) -> set[tuple[int, int]]:
        """Return pairs of shapes, one of them round, whose outer polygons overlap at one of the poses."""
        from shapely.affinity import affine_transform

        parts, count = len(self.exact.robot), len(self.exact.robot) + len(self.exact.obstacles)
        geometries = [
            shapely.union_all([polygon.to_shapely() for polygon in _polygons_for(shape, error, k < count)])
            for k, (shape, error) in enumerate(zip(self.shapes, self.errors, strict=True))
        ]
        tree, pairs = shapely.STRtree(geometries[parts:count]), set[tuple[int, int]]()
        for x, y, theta in poses:
            motion = [np.cos(theta), -np.sin(theta), np.sin(theta), np.cos(theta), x, y]
            for k, geometry in enumerate(geometries[:parts]):
                placed = affine_transform(geometry, motion)
                met = [parts + int(j) for j in tree.query(placed, predicate="intersects")]
                if len(geometries) > count and not geometries[count].contains_properly(placed):
                    met.append(count)
                pairs |= {(k, j) for j in met if self.errors[k] or self.errors[j]}
        return pairs


def _polygons_for(shape: AnyShape, error: float, outward: bool) -> tuple[Polygon, ...]:
    """Return polygons for a shape, or none where none can be proved; their choice decides nothing."""
    with suppress(UndecidedError, InvalidPolygonError):  # a thin ring may have none so coarse
        return polygons_for(shape, error, outward)
    return ()


def _first(shape: Curved, robot: float) -> float:
    size = shape.size
    return max(min(size / FIRST, max(robot / OF_ROBOT, size / FINEST)), shape.least_error)
