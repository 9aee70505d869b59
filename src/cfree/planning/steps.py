"""Steps of routes: motions in one room, planned among its polygons, or among its segments and arcs."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from typing import Protocol

from cfree.collision.approximations import Approximations
from cfree.collision.nearest_free import refuse_forbidden
from cfree.collision.pose_checker import PoseChecker
from cfree.errors import IncompleteError, InvariantError
from cfree.exact.pose import Pose
from cfree.forbidden.boundary import boundary
from cfree.free.space import FreeSpace, free_space
from cfree.paths.path import Path
from cfree.planning.caller import Work
from cfree.planning.options import Options
from cfree.planning.pose_planner import PosePlanner
from cfree.planning.rounded_cells import work_for
from cfree.planning.separation import Separated
from cfree.planning.true_shapes import TruePlanner, TrueShapes
from cfree.scene.features import grown_features
from cfree.scene.frame import frame_of
from cfree.scene.rounded import rounded_shapes
from cfree.scene.scene import Scene

PATCHES = 20_000  # most contact patches trimmed for one step
GUESSES = 2_000  # motions guessed by a search among segments and arcs, before cells and polygons inside are asked
PAIRS = 10_000  # most pairs of a patch and a pillar near it for which a room's cells are computed


class StepPlanner(Protocol):
    """Planner of the steps in one room."""

    @property
    def space(self) -> FreeSpace | None:
        """The room's free space; None if the core does not resolve it."""

    def joins(self, start: Pose, goal: Pose, guesses: int) -> bool:
        """True if a search of so many guesses joins two free poses."""

    def path(self, start: Pose, goal: Pose, options: Options) -> Path | None:
        """Return a path, not improved; None if there is none, or a few patches do not decide.

        Raises
        ------
        InvalidPoseError
            If an end is forbidden.
        """

    def improved(self, path: Path, options: Options) -> Path:
        """Improve a path."""

    def proof(self, start: Pose, goal: Pose) -> Separated | None:
        """Return a proof by a few surfaces, fast where obstacles close an end in; None without one."""


def step_planner(scene: Scene) -> StepPlanner:
    """Return a planner of a room's scene."""
    return AmongArcs(scene) if scene.curved else AmongPolygons(scene)


class AmongPolygons:
    """Steps among polygons.

    Parameters
    ----------
    scene : Scene
    """

    def __init__(self, scene: Scene) -> None:
        self._planner, self._scene = PosePlanner(scene), scene

    @cached_property
    def space(self) -> FreeSpace:
        """See `StepPlanner`."""
        return free_space(boundary(self._scene, threads=1), threads=1)

    def joins(self, start: Pose, goal: Pose, guesses: int) -> bool:
        """See `StepPlanner`."""
        return self._planner.quick(start, goal, Options(), guesses) is not None

    def path(self, start: Pose, goal: Pose, options: Options) -> Path | None:
        """See `StepPlanner`."""
        with suppress(IncompleteError):
            way = self._planner.way(start, goal, replace(options, work=Work(PATCHES)))
            return self._planner.path(way) if isinstance(way, list) else None
        return None

    def improved(self, path: Path, options: Options) -> Path:
        """See `StepPlanner`."""
        self._planner.keep_slides(path)
        return self._planner.improved(path.poses, options)

    def proof(self, start: Pose, goal: Pose) -> Separated | None:
        """See `StepPlanner`."""
        found = self._planner.way(start, goal, Options(), few=True)
        return found if isinstance(found, Separated) else None


class AmongArcs:
    """Steps among segments and arcs, which decide; polygons inside of them are a guide where a search fails.

    Parameters
    ----------
    scene : Scene
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene

    @cached_property
    def _planner(self) -> TruePlanner:
        return TrueShapes(self._scene, Approximations(self._scene), Fraction(0)).planner()

    def joins(self, start: Pose, goal: Pose, guesses: int) -> bool:
        """See `StepPlanner`."""
        return self._planner.joins(start, goal, guesses)

    def path(self, start: Pose, goal: Pose, options: Options) -> Path | None:
        """See `StepPlanner`."""
        for name, end in (("start", start), ("goal", goal)):
            refuse_forbidden(PoseChecker(self._scene), end, name)
        first = replace(options, improve=0.0, objective="balanced", vehicle=None)
        with suppress(IncompleteError):
            found = self._planner.first_path(start, goal, first, GUESSES)
            if found is None and not self._are_in_two_cells(start, goal):
                guide = self._among_inner(start, goal, first)
                found = guide and self._planner.mended(guide, first, thorough=False)
            return found if isinstance(found, Path) else None
        return None

    def _are_in_two_cells(self, start: Pose, goal: Pose) -> bool:
        """True if no cell has both; they may still be joined by exact fits. False if cells take too long to compute."""
        if rounded_shapes(self._scene) is None or work_for(grown_features(self._scene)) > PAIRS:
            return False
        return self.space is not None and self.space.common_cell(start, goal) is None

    @cached_property
    def space(self) -> FreeSpace | None:
        """See `StepPlanner`; None as well if shapes are not rounded."""
        if rounded_shapes(self._scene) is None:
            return None
        try:
            return free_space(boundary(self._scene, threads=1), threads=1)
        except InvariantError:  # a tie; other ways to an answer are left
            return None

    def _among_inner(self, start: Pose, goal: Pose, options: Options) -> Path | None:
        """Return a path among polygons inside of the shapes; without one there is none among these."""
        planner = PosePlanner(self._planner.guide.scene)
        way = planner.way(start, goal, replace(options, work=Work(PATCHES)))
        return planner.path(way) if isinstance(way, list) else None

    def improved(self, path: Path, options: Options) -> Path:
        """See `StepPlanner`."""
        return self.finished(path.poses, options) or path

    def finished(self, way: Sequence[Pose], options: Options) -> Path | None:
        """Improve a free path, given by its poses; a vehicle drives near it, or is stuck: None.

        Raises
        ------
        UndecidedError
            If a vehicle needs too many manoeuvres.
        """
        found = self._planner.finished(way, options)
        return found if isinstance(found, Path) else None

    def proof(self, start: Pose, goal: Pose) -> Separated | None:
        """See `StepPlanner`."""
        exact = self._scene
        with suppress(IncompleteError):
            found = PosePlanner(self._planner.guide.scene).way(start, goal, Options(), few=True)
            if isinstance(found, Separated):  # the shapes forbid no less than the polygons inside of them
                return replace(found, curved=exact, frame=frame_of(exact))
        return None
