"""Planner among segments and circular arcs: the shapes themselves decide, polygons in their place are a guide."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cached_property

import cfree._core as _core
from cfree.collision.approximations import Approximations
from cfree.collision.arcs import ArcScene
from cfree.collision.motion_checker import MotionChecker
from cfree.curves.curved import Curved
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.paths.path import Path
from cfree.planning.contact_fits import Fits
from cfree.planning.options import Options
from cfree.planning.pose_planner import PosePlanner
from cfree.scene.scene import AnyShape, Scene, robot_radius

ROUNDED = 1 + 2.0**-40  # more than the rounding of a sum
BITS = 20  # of the numbers of a box


class TrueMotions(MotionChecker):
    """Exact checks of motions among round shapes, with the interface of a checker of polygons in their place."""

    def __init__(self, guide: Scene, arcs: ArcScene) -> None:
        super().__init__(guide)
        self._handle = _core.MotionChecker(self.features.core, arcs.motions)


class ArcPlanner(PosePlanner):
    """Searches among round shapes, which decide.

    Parameters
    ----------
    arcs : ArcScene
        The exact shapes.
    true : Scene
        Their scene.
    guide : Scene
        Polygons in place of the shapes.
    slack : float
        The distances of these may be too large by as much; if it is infinite, nothing keeps a distance.

    Attributes
    ----------
    true : Scene
    """

    is_among_arcs = True

    def __init__(self, arcs: ArcScene, true: Scene, guide: Scene, slack: float = math.inf) -> None:
        super().__init__(guide)
        self.arcs, self.true, self._slack = arcs, true, slack
        self.center = _middle(true.robot)

    @cached_property
    def checker(self) -> MotionChecker:
        """Checker of motions among the shapes themselves."""
        return TrueMotions(self.scene, self.arcs)

    @cached_property
    def angle_scale(self) -> float:
        """Length per radian: the radius of the robot itself."""
        return robot_radius(self.true)

    @cached_property
    def fits(self) -> Fits:
        """The vertices, arcs and segments that hold the robot where it fits exactly."""
        return Fits(self.true)

    @cached_property
    def _known(self) -> _core.KnownScene:
        return _core.KnownScene(self.checker.features.made, self.checker._handle, self._slack, self.arcs.poses)

    def improved(self, way: Sequence[Pose], options: Options) -> Path:
        """Improve a path of a robot that moves in any direction; it turns no more than it needs to."""
        return super().improved(self.improver(way, options).turning_less(way), options)

    def way(self, start: Pose, goal: Pose, options: Options, *, few: bool = False) -> list[Pose] | None:
        """Return poses of a path, if simple ways or a search give one."""
        found = self.quick(start, goal, options)
        return None if found is None else [*found]


def with_inner_polygons(arcs: ArcScene, near: Approximations) -> ArcPlanner:
    """Return a planner with polygons inside the shapes, near enough to push paths away from them.

    Raises
    ------
    UndecidedError
        If a robot or workspace has no polygon inside.
    """
    inner = near.scene(outward=False)
    few = len(inner.obstacles) < len(near.exact.obstacles)  # one has no polygon inside
    return ArcPlanner(arcs, near.exact, inner, math.inf if few else _slack(near))


def with_polygons_near(arcs: ArcScene, near: Approximations) -> ArcPlanner:
    """Return the same planner; shapes that have no polygon inside are replaced by polygons around them.

    Their distances are enough to push paths away, and too small. What is planned for a vehicle needs polygons inside.
    """
    return ArcPlanner(arcs, near.exact, near.nearby(), _slack(near))


def _slack(near: Approximations) -> float:
    count = len(near.exact.robot)
    errors = near.errors[:count], near.errors[count:]
    return sum(max(part, default=0.0) for part in errors) * ROUNDED


def with_boxes(arcs: ArcScene, true: Scene) -> ArcPlanner:
    """Return a planner with boxes around robot, obstacles and workspace, of short numbers: enough for searches."""
    room = true.workspace
    obstacles = [_box(true.obstacles)] if true.obstacles else []
    guide = Scene(_box(true.robot), obstacles, workspace=room and _box([room]), bounds=true.bounds)
    return ArcPlanner(arcs, true, guide)


def _box(shapes: Sequence[AnyShape]) -> list[ExactPoint]:
    """Return a box around shapes."""
    x0, y0, x1, y1 = _sides(shapes)
    unit = Fraction(2) ** (math.frexp(max(x1 - x0, y1 - y0))[1] - BITS)
    left, low, right, high = ((x // unit + k) * unit for x, k in ((x0, 0), (y0, 0), (x1, 1), (y1, 1)))
    return [(left, low), (right, low), (right, high), (left, high)]


def _middle(shapes: Sequence[AnyShape]) -> tuple[float, float]:
    x0, y0, x1, y1 = _sides(shapes)
    return float(x0 + x1) / 2, float(y0 + y1) / 2


def _sides(shapes: Sequence[AnyShape]) -> Iterator[Fraction]:
    """Return the sides x0, y0, x1, y1 of the least box around shapes."""
    boxes = (shape.box if isinstance(shape, Curved) else map(Fraction, shape.bounds) for shape in shapes)
    return (choose(row) for choose, row in zip((min, min, max, max), zip(*boxes, strict=True), strict=True))
