"""Paths along the boundary of a cell."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import cfree._core as _core
from cfree.collision.motion_checker import MotionChecker
from cfree.errors import InvariantError
from cfree.exact.pose import Pose
from cfree.planning.core_ways import Numbers, Slides, numbers_of, way_of

if TYPE_CHECKING:
    from cfree.free.space import FreeSpace


class Walker:
    """Paths along the boundaries of the cells of a free space.

    Parameters
    ----------
    slides : dict
        The slides found are added to it, by the poses that they join; `motion_between` joins all others.
    """

    def __init__(self, space: FreeSpace, checker: MotionChecker, angle_scale: float, slides: Slides) -> None:
        self.space = space
        self._features, self._slides = checker.features, slides
        surfaces = space.surfaces.core_complex
        self.core = _core.BoundaryWalker(space.core, surfaces, checker.core, angle_scale, _core.FoundSlides())

    def walk(self, start: Pose, goal: Pose, cell: int) -> list[Pose]:
        """Poses from the start to the goal, both in the cell or on its boundary; the motions between them are free.

        Raises
        ------
        InvariantError
            If none is found, a fault of cfree.
        """
        try:
            found = self.core.walk(_end(start), _end(goal), cell)
        except RuntimeError as error:
            raise InvariantError(str(error), state=(start, goal)) from error
        return self.way_of(found)

    def way_of(self, found: tuple[Any, Any]) -> list[Pose]:
        """A way that the core gives; the slides on it are noted."""
        return way_of(found, self._features, self._slides)


def _end(pose: Pose) -> tuple[Numbers, tuple[float, float, float]]:
    return numbers_of(pose), (float(pose.x), float(pose.y), pose.theta)
