"""Paths among round shapes, or a proof that there is none: both in scenes of polygons.

In the outer scene all is forbidden that is forbidden among the round shapes, in the inner one nothing else: a path in
the outer scene is one among them, and what no path joins in the inner scene none joins among them. Where neither
answers, shapes that the inner scene's path overlaps in the outer one have their error divided by 4, down to a
tolerance. docs/theory/curved-shapes.md has the proofs.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.collision.approximations import Approximations
from cfree.collision.nearest_free import ForbiddenPoseError
from cfree.errors import IncompleteError, InvalidPoseError, UndecidedError
from cfree.exact.number import Number, to_fraction
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.free.space import FreeSpace
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import Preferences
from cfree.planning.caller import OutOfWork, Work
from cfree.planning.goals import AllSeparated
from cfree.planning.planner import Planner
from cfree.planning.separation import Separated

Answer = Path | Separated | AllSeparated
Ask = Callable[[Planner, float | None, Number | None], Answer]
POSES = 400  # of a path, at which it is seen what it overlaps
PATCHES = 100_000  # contact patches that are trimmed for one question, unless more is asked for; about 10 s
AROUND = 4  # errors of polygons, by which a clearance differs that is asked for to bound the largest
NARROW = 0.002  # of a clearance: polygons for it tell no more
TOUCHING = "these touch, or all but do; give a smaller tolerance, or other shapes"
OUT_OF_WORK = f"{PATCHES:,} contact patches were not enough; give max_seconds or a tolerance for more, or other shapes"


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
        self._planner, self._max_seconds = planner, planner.max_seconds
        self._is_limited = tolerance is None and planner.max_seconds is None

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

        def ask(planner: Planner, improve: float | None, clearance: Number | None) -> Answer:
            return planner.plan(*ends, clearance=clearance, improve=improve, objective=objective)

        found = self._answer(ask, ends, improve, clearance)
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

        def ask(planner: Planner, improve: float | None, clearance: Number | None) -> Answer:
            return planner.plan_any(first, goals, clearance=clearance, improve=improve, objective=objective)

        ends = first, *(goal for goal in goals if isinstance(goal, Pose))
        found = self._answer(ask, ends, improve, clearance)
        assert not isinstance(found, Separated)
        return found

    def _answer(self, ask: Ask, ends: Sequence[Pose], improve: float | None, clearance: Number | None) -> Answer:
        self._begin, self._work = time.monotonic(), Work(PATCHES) if self._is_limited else None
        self._interval, self._reason = (0.0, math.inf), ""
        try:
            return self._refined(lambda planner, improve: ask(planner, improve, clearance), ends, improve)
        except UndecidedError as error:
            if clearance is None:
                raise
            lo, hi = self._around(ask, to_fraction(clearance), error.error)
            message = f"{error}; the largest clearance that a path keeps is between {lo:.8g} and {hi:.8g}"
            raise UndecidedError(message, lo=lo, hi=hi, error=error.error) from None

    def _around(self, ask: Ask, clearance: Fraction, error: float) -> tuple[float, float]:
        """Bounds of the largest clearance: some less and some more is asked for, in the scenes that gave answers."""
        lo, hi = self._interval
        for outward, planner in self._decided.items():
            other = clearance + (-AROUND if outward else AROUND) * Fraction(error)
            planner.work = Work(PATCHES)
            with suppress(IncompleteError, InvalidPoseError):
                found = ask(planner, 0.0, other) if other > 0 else None
                if outward and isinstance(found, Path):
                    lo = max(lo, float(other))
                elif not outward and found is not None and not isinstance(found, Path):
                    hi = min(hi, float(other))
        return lo, hi

    def _refined(
        self, ask: Callable[[Planner, float | None], Answer], ends: Sequence[Pose], improve: float | None
    ) -> Answer:
        self._decided: dict[bool, Planner] = {}
        while True:
            apart, within, refused = None, None, None
            try:
                found = self._asked(ask, improve, outward=True)
                if isinstance(found, Path):
                    return self._for_curves(found)
                apart = found
            except InvalidPoseError as error:  # the inner scene says whether it is so here, too
                refused = error
            try:
                found = self._asked(ask, 0.0, outward=False)
                if found is not None and refused is None and not isinstance(found, Path):
                    return self._for_curves(found)
                within = found if refused is None and isinstance(found, Path) else None
            except ForbiddenPoseError as error:
                raise _for_both(error, refused) from None
            lo, hi = self._interval
            if self._is_limited and 0 < hi - lo <= NARROW * lo:
                raise self._undecided("the clearance is too near to the largest; give another, or a tolerance")
            if not self.near.refine(_poses(within, ends), () if apart is None else apart.obstacles):
                raise self._undecided(self._reason or TOUCHING)

    def _asked(
        self, ask: Callable[[Planner, float | None], Answer], improve: float | None, *, outward: bool
    ) -> Answer | None:
        """Return the answer in one of the two scenes of polygons; None if there is no such scene, or none in it."""
        try:
            planner = self._planner._of(self.near.scene(outward=outward))
        except UndecidedError as error:
            self._reason = str(error)
            return None
        planner.work = self._work
        if self._max_seconds is not None:
            planner.max_seconds = max(0.0, self._max_seconds - (time.monotonic() - self._begin))
        try:
            answer = ask(planner, improve)
        except OutOfWork:
            raise self._undecided(OUT_OF_WORK) from None
        except UndecidedError as error:
            lo, hi = self._interval
            self._interval = (max(lo, error.lo), hi) if outward else (lo, min(hi, error.hi))
            return None
        except IncompleteError:
            raise self._undecided(f"{self._max_seconds:g} seconds were not enough; give more") from None
        self._planner, self.scene, self._decided[outward] = planner, planner.scene, planner
        return answer

    def _undecided(self, reason: str) -> UndecidedError:
        error = self.near.reached
        message = f"polygons within {error:.3g} of the round shapes decide neither way: {reason}"
        return UndecidedError(message, error=error)

    def _for_curves(self, found: Answer) -> Answer:
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
