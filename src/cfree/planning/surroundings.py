"""Two poses in one cell or apart, found out from the closed surfaces around them, without the rest of the boundary.

docs/theory/one-surface.md tells how. What is unclear here the whole free space decides.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import cfree._core as _core
from cfree.collision.motion_checker import MotionChecker
from cfree.collision.slide import Slide
from cfree.errors import IncompleteError, InvariantError
from cfree.exact.pose import Pose
from cfree.forbidden.boundary import Boundary
from cfree.forbidden.record import Stats
from cfree.planning.boundary_walk import from_numbers, numbers_of
from cfree.planning.curve_motions import CurveMotions
from cfree.scene.scene import Scene


class Surroundings:
    """Closed surfaces of a scene, found when poses are asked for; those found are kept.

    Parameters
    ----------
    scene : Scene
    checker : MotionChecker
        Of the scene.
    """

    def __init__(self, scene: Scene, checker: MotionChecker) -> None:
        self.scene = scene
        self.checker = checker
        features = checker.features
        self._core = _core.Surroundings(features.core, checker.core, _core.may_have_slits(features.core))

    def connection(self, start: Pose, goal: Pose, max_seconds: float | None = None) -> _core.Connection:
        """What the surfaces around two free poses say.

        Raises
        ------
        IncompleteError
            If it takes longer.
        """
        try:
            limit = math.inf if max_seconds is None else max_seconds
            found = self._core.connection(numbers_of(start), numbers_of(goal), limit)
        except RuntimeError as error:
            raise InvariantError(str(error), state=(start, goal)) from error
        if found.verdict == _core.Verdict.LATE:
            raise IncompleteError(f"{max_seconds} seconds were not enough to find out what is free; give more")
        return found

    def way(
        self, joined: _core.Connection, angle_scale: float, slides: dict[tuple[Pose, Pose], Slide]
    ) -> list[Pose] | None:
        """Poses from the start to the goal, the motions between them free; None if none are found on the surfaces."""
        curves = CurveMotions(self.checker, slides)

        def slid(pose: Sequence[int], goal: Sequence[int], contact: Sequence[int], curve: int) -> bool:
            kind, i, j = contact
            return curves.slid(from_numbers(pose), from_numbers(goal), (kind, i, j), curve)

        try:
            return [*map(from_numbers, self._core.way(joined, angle_scale, slid))]
        except RuntimeError:
            return None

    def surface(self, found: _core.Connection) -> Boundary:
        """The closed surface between two poses that are apart: a boundary of which that is all."""
        assert found.surface is not None
        core, table = found.surface.boundary, found.surface.boundary.trapezoids
        stats = Stats(len(core.trimmed), 0, len(table.patch), 0, 0, 0, 0, 0, {})
        return Boundary._of(self.scene, self.checker.features, core, stats)
