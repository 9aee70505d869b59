"""Paths among round shapes, or a proof that there is none: both in scenes of polygons.

In the outer scene all is forbidden that is forbidden among the round shapes, in the inner one nothing else: a path in
the outer scene is one among them, and what no path joins in the inner scene none joins among them. Where neither
answers, shapes that the inner scene's path overlaps in the outer one have their error divided by 4, down to a
tolerance. docs/theory/curved-shapes.md has the proofs.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.collision.approximations import Approximations
from cfree.collision.nearest_free import ForbiddenPoseError
from cfree.errors import InvalidPoseError, UndecidedError
from cfree.exact.number import Number
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.free.space import FreeSpace
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import Preferences
from cfree.planning.goals import AllSeparated
from cfree.planning.planner import Planner
from cfree.planning.separation import Separated

Answer = Path | Separated | AllSeparated
POSES = 400  # of a path, at which it is seen what it overlaps


@checked
class CurvedPlanner:
    """Answers questions about a scene with round shapes, as a `Planner` does about polygons.

    Parameters
    ----------
    planner : Planner
        Of the scene; its settings are those of the planners for polygons.
    tolerance : float, optional
        As in `cfree.plan`.

    Attributes
    ----------
    scene : Scene
        With round shapes; after a question that of polygons in which it was answered.
    """

    def __init__(self, planner: Planner, tolerance: float | None = None) -> None:
        self.exact = self.scene = planner.scene
        self.near = Approximations(planner.scene, tolerance)
        self._planner = planner

    @property
    def preferences(self) -> Preferences:
        return self._planner.preferences

    @property
    def angle_scale(self) -> float:
        """Of the scene of polygons."""
        return self._planner.angle_scale

    @property
    def free_space(self) -> FreeSpace:
        """Of the scene of polygons."""
        return self._planner.free_space

    @checked
    def plan(
        self,
        start: PoseLike,
        goal: PoseLike,
        *,
        clearance: Number | None = None,
        improve: float | None = None,
        objective: Objective = "balanced",
    ) -> Path | Separated:
        """See `cfree.plan`."""
        ends = to_pose(start, "start"), to_pose(goal, "goal")

        def ask(planner: Planner, improve: float | None) -> Answer:
            return planner.plan(*ends, clearance=clearance, improve=improve, objective=objective)

        found = self._answer(ask, ends, improve)
        assert not isinstance(found, AllSeparated)
        return found

    @checked
    def plan_any(
        self,
        start: PoseLike,
        goals: Sequence[Any],
        *,
        clearance: Number | None = None,
        improve: float | None = None,
        objective: Objective = "balanced",
    ) -> Path | AllSeparated:
        """See `cfree.plan`, for several goals, or places."""
        first = to_pose(start, "start")

        def ask(planner: Planner, improve: float | None) -> Answer:
            return planner.plan_any(first, goals, clearance=clearance, improve=improve, objective=objective)

        found = self._answer(ask, (first, *(goal for goal in goals if isinstance(goal, Pose))), improve)
        assert not isinstance(found, Separated)
        return found

    def _answer(
        self, ask: Callable[[Planner, float | None], Answer], ends: Sequence[Pose], improve: float | None
    ) -> Answer:
        while True:
            outer, apart, refused = self._planner_of(outward=True), None, None
            try:
                found = ask(outer, improve)
                if isinstance(found, Path):
                    return self._for_curves(found, outer)
                apart = found
            except InvalidPoseError as error:  # the inner scene says whether it is so here, too
                refused = error
            except UndecidedError:
                pass
            inner, within = self._planner_of(outward=False), None
            try:
                found = ask(inner, 0.0)
                if refused is None and not isinstance(found, Path):
                    return self._for_curves(found, inner)
                within = found if refused is None and isinstance(found, Path) else None
            except ForbiddenPoseError as error:
                raise _for_both(error, refused) from None
            except UndecidedError:
                pass
            if not self.near.refine(_poses(within, ends), apart.obstacles if apart else ()):
                least = self.near.reached
                raise UndecidedError(
                    f"polygons within {least:.3g} of the round shapes decide neither way: these touch, or all but do; "
                    "give a smaller tolerance, or other shapes",
                    error=least,
                )

    def _planner_of(self, *, outward: bool) -> Planner:
        return self._planner._of(self.near.scene(outward=outward))

    def _for_curves(self, found: Answer, planner: Planner) -> Answer:
        self._planner, self.scene = planner, planner.scene
        if isinstance(found, AllSeparated):
            return replace(found, proofs=tuple(replace(proof, curved=self.exact) for proof in found.proofs))
        return replace(found, curved=self.exact)


def _for_both(inner: ForbiddenPoseError, outer: InvalidPoseError | None) -> ForbiddenPoseError:
    """What overlaps in the inner scene does; what is free in the outer one is."""
    overlap, free = str(inner).partition(";")[0], str(outer or "").partition(";")[2]
    return ForbiddenPoseError(f"{overlap};{free}" if free else overlap, free=getattr(outer, "free", None))


def _poses(path: Path | None, ends: Sequence[Pose]) -> NDArray[np.float64]:
    """Rows x, y, theta of start and goals, and along a path."""
    table = [[float(pose.x), float(pose.y), pose.theta] for pose in ends]
    if path is None or not path.motions:
        return np.array(table)
    found = path.sample(max(path.length, 1e-300) / POSES, max(path.turning, 1e-9) / POSES)
    return np.vstack([table, np.column_stack([found.xy, found.theta])])
