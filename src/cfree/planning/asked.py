"""Interface of a planner for code that combines several of its answers."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Protocol

import cfree._core as _core
from cfree.exact.pose import Pose
from cfree.free.space import FreeSpace
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import Preferences
from cfree.planning.separation import Separated
from cfree.scene.scene import Scene


class Planner(Protocol):
    """See `cfree.Planner`."""

    scene: Scene
    preferences: Preferences

    @property
    def free_space(self) -> FreeSpace: ...
    def quick(self, start: Pose, goal: Pose) -> Sequence[Pose] | None: ...
    def way(self, start: Pose, goal: Pose, *, few: bool = False) -> list[Pose] | Separated | None: ...
    def barrier(self, start: Pose, goal: Pose) -> _core.Separation | None: ...
    def improved(self, way: Sequence[Pose], improve: float | None, objective: Objective) -> Path: ...
    def plan(
        self,
        start: Pose,
        goal: Pose,
        *,
        clearance: Fraction | None = None,
        improve: float | None,
        objective: Objective,
    ) -> Path | Separated: ...
