"""Paths along the boundary of a cell: the core walks, and asks here for slides along two contacts."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import cfree._core as _core
from cfree.collision.motion_checker import MotionChecker
from cfree.collision.slide import Slide
from cfree.errors import InvariantError
from cfree.exact.pose import Pose
from cfree.free.space import surfaces_with_slits
from cfree.planning.curve_motions import CurveMotions, Numbers, from_numbers, numbers_of
from cfree.planning.exact_face import Sheet

if TYPE_CHECKING:
    from cfree.free.space import FreeSpace

LAST = 2  # the side of a trapezoid at its last angle


class Walker:
    """Paths along the boundaries of the cells of a free space.

    Parameters
    ----------
    slides : dict
        The slides found are added to it, by the poses that they join; `motion_between` joins all others.
    """

    def __init__(
        self, space: FreeSpace, checker: MotionChecker, angle_scale: float, slides: dict[tuple[Pose, Pose], Slide]
    ) -> None:
        self.space = space
        self.checker = checker
        self.angle_scale = angle_scale
        self.curves = CurveMotions(checker, slides)
        self._core = _core.BoundaryWalker(space.core, space.surfaces.core_complex, checker.core, angle_scale)

    @cached_property
    def with_slits(self) -> Walker | None:
        """On closed surfaces with slits of no width, where bounds leave such."""
        space = surfaces_with_slits(self.space.boundary)
        return Walker(space, self.checker, self.angle_scale, self.curves.slides) if space else None

    def sheet(self, face: int) -> Sheet:
        """A trapezoid of the surfaces."""
        return Sheet.of(self.space.surfaces, face, self.space.angle)

    def cell_at(self, face: int) -> int:
        """The cell that a face bounds."""
        return int(self.space.cell_of[self.space.component[face]])

    def walk(self, start: Pose, goal: Pose, cell: int) -> list[Pose]:
        """Poses from the start to the goal, both in the cell or on its boundary; the motions between them are free.

        Raises
        ------
        InvariantError
            If none is found, a fault of cfree.
        """
        try:
            return [*map(from_numbers, self._core.walk(_end(start), _end(goal), cell, self.curves.slid_by_numbers))]
        except RuntimeError as error:
            raise InvariantError(str(error), state=(start, goal)) from error

    def turn(self, coedge: int, other: int, attempts: int) -> list[Pose] | None:
        """From the middle of one face to that of another, over sides at critical angles that are one edge."""
        cells = self.space.complex
        first, last = ((int(cells.face[k]), bool(cells.side[k] == LAST)) for k in (coedge, other))
        found = self._core.turn(first, last, attempts)
        return [*map(from_numbers, found)] if found else None


def _end(pose: Pose) -> tuple[Numbers, tuple[float, float, float]]:
    return numbers_of(pose), (float(pose.x), float(pose.y), pose.theta)
