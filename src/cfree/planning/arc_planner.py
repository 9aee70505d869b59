"""Planner among segments and circular arcs: searches in polygons inside of the shapes, decisions on the shapes."""

from __future__ import annotations

import math
from functools import cached_property

import cfree._core as _core
from cfree.collision.approximations import Approximations
from cfree.collision.arcs import ArcScene
from cfree.collision.motion_checker import MotionChecker
from cfree.exact.pose import Pose
from cfree.planning.contact_fits import Fits
from cfree.planning.options import Options
from cfree.planning.pose_planner import PosePlanner
from cfree.scene.scene import Scene

ROUNDED = 1 + 2.0**-40  # more than the rounding of a sum


class TrueMotions(MotionChecker):
    """Exact checks of motions among round shapes, with the interface of a checker of the polygons inside of them."""

    def __init__(self, inner: Scene, arcs: ArcScene) -> None:
        super().__init__(inner)
        self._handle = _core.MotionChecker(self.features.core, arcs.motions)


class ArcPlanner(PosePlanner):
    """Searches among round shapes, at one error of the polygons inside of them.

    Parameters
    ----------
    arcs : ArcScene
        The exact shapes.
    near : Approximations
        Their polygons.

    Attributes
    ----------
    true : Scene
        The scene of the exact shapes.

    Raises
    ------
    UndecidedError
        If a robot or workspace has no polygon inside.
    """

    is_among_arcs = True

    def __init__(self, arcs: ArcScene, near: Approximations) -> None:
        super().__init__(near.scene(outward=False))
        self.arcs, self.true = arcs, near.exact
        count = len(near.exact.robot)
        errors = near.errors[:count], near.errors[count:]
        few = len(self.scene.obstacles) < len(near.exact.obstacles)  # one has no polygon inside
        self._slack = math.inf if few else sum(max(part, default=0.0) for part in errors) * ROUNDED

    @cached_property
    def checker(self) -> MotionChecker:
        """Checker of motions among the shapes themselves."""
        return TrueMotions(self.scene, self.arcs)

    @cached_property
    def fits(self) -> Fits:
        """The vertices, arcs and segments that hold the robot where it fits exactly."""
        return Fits(self.true)

    @cached_property
    def _known(self) -> _core.KnownScene:
        return _core.KnownScene(self.checker.features.made, self.checker._handle, self._slack)

    def way(self, start: Pose, goal: Pose, options: Options, *, few: bool = False) -> list[Pose] | None:
        """Return poses of a path, if simple ways or a search give one."""
        found = self.quick(start, goal, options)
        return None if found is None else [*found]
