"""Two poses in one cell or apart, found out from the closed surfaces around them, without the rest of the boundary.

docs/theory/one-surface.md tells how. What is unclear here the whole free space decides.
"""

from __future__ import annotations

from collections.abc import Callable

import cfree._core as _core
from cfree.collision.motion_checker import MotionChecker
from cfree.errors import InvariantError
from cfree.exact.pose import Pose
from cfree.forbidden.boundary import Boundary
from cfree.forbidden.record import Stats
from cfree.planning.core_ways import Slides, numbers_of, way_of
from cfree.scene.scene import Scene

STEP = 64  # trapezoids around each of two poses; then twice as many each time


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

    def connecting(self, start: Pose, goal: Pose) -> Connecting:
        """What finds out about two free poses."""
        return Connecting(self, _core.Connecting(self._core, numbers_of(start), numbers_of(goal)), (start, goal))


class Connecting:
    """Two poses, of which more and more is found out; see `Surroundings.connecting`."""

    def __init__(self, around: Surroundings, core: _core.Connecting, ends: tuple[Pose, Pose]) -> None:
        self._around = around
        self._core = core
        self._ends = ends

    @property
    def verdict(self) -> _core.Verdict:
        return self._core.verdict

    def run(self, most: int) -> bool:
        """Go on by about so many trapezoids around each of the two; whether that was enough, or no more can be said."""
        self._call(self._core.run, most)
        return self.verdict != _core.Verdict.OPEN

    def decide(self, end: int | None = None) -> _core.Verdict:
        """Go on to the end; first around one of the two, start (0) or goal (1), if that is likely to be enough."""
        if end is not None:
            self._call(self._core.run_around, end)
        most = STEP
        while not self.run(most):
            most *= 2
        return self.verdict

    def _call(self, run: Callable[[int], None], of: int) -> None:
        try:
            run(of)
        except RuntimeError as error:
            raise InvariantError(str(error), state=self._ends) from error

    @property
    def inside(self) -> int:
        """Of two poses that are apart, the one that the surface is around: start (0) or goal (1)."""
        return self._core.inside

    def way(self, angle_scale: float, slides: Slides) -> list[Pose] | None:
        """Poses from the start to the goal, the motions between them free; None if none are found on the surfaces."""
        try:
            found = self._core.way(angle_scale)
        except RuntimeError:
            return None
        return way_of(found, self._around.checker.features, slides)

    @property
    def surface(self) -> Boundary:
        """The closed surface between two poses that are apart: a boundary of which that is all."""
        found = self._core.surface
        assert found is not None
        core, table = found.boundary, found.boundary.trapezoids
        stats = Stats(len(core.trimmed), 0, len(table.patch), 0, 0, 0, 0, 0, {})
        return Boundary._of(self._around.scene, self._around.checker.features, core, stats)
