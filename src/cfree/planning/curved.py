"""Paths among round shapes, or proofs that there is none: both in scenes of polygons.

The outer scene forbids every pose that the round shapes forbid; the inner scene forbids no other pose. So a path in the
outer scene is also free among the round shapes, and a proof in the inner scene also holds for them. If neither answers,
the error of the shapes that the inner scene's path overlaps in the outer scene is divided by 4, down to a tolerance.
docs/theory/curved-shapes.md has the proofs. Among segments and circular arcs, the shapes are searched themselves first.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from typing import Any

from cfree.arguments import checked
from cfree.collision.approximations import Approximations
from cfree.collision.arcs import arcs_of
from cfree.collision.nearest_free import ForbiddenPoseError, refuse_forbidden
from cfree.collision.pose_checker import PoseChecker
from cfree.errors import IncompleteError, InvalidPoseError, UndecidedError
from cfree.exact.number import Number
from cfree.exact.pose import Pose, PoseLike, pose_at, to_pose
from cfree.free.space import FreeSpace
from cfree.free.turn_in_place import free_orientations
from cfree.libraries import NDArray, np
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import Preferences
from cfree.planning.caller import OutOfWork, Work
from cfree.planning.goals import (
    AllSeparated,
    all_separated,
    cheapest,
    name_of,
    no_orientation,
    pose_in,
    refuse_far,
    several,
)
from cfree.planning.options import Options
from cfree.planning.planner import Planner, answer_for_any, answer_for_one
from cfree.planning.pose_planner import PosePlanner
from cfree.planning.proof import Proof
from cfree.planning.reach import Reach
from cfree.planning.round_places import STRAIGHT, is_free_place
from cfree.planning.rounded_cells import FEW as FEW_PAIRS
from cfree.planning.rounded_cells import WORK as PAIRS
from cfree.planning.rounded_cells import RoundCells, round_cells
from cfree.planning.separation import Separated
from cfree.planning.stuck import Stuck
from cfree.planning.true_shapes import TruePlanner, TrueShapes
from cfree.planning.unreachable import Unreachable
from cfree.planning.widest_way import widest_way
from cfree.scene.frame import frame_of
from cfree.scene.goals import Goal
from cfree.scene.rounded import is_disc_about_reference
from cfree.scene.scene import Scene, robot_radius
from cfree.vehicles.vehicle import Car, Vehicle

Answer = Path | Proof | AllSeparated
Ask = Callable[[PosePlanner, Options], Answer]
Decided = tuple[PosePlanner, Options]  # a planner for polygons that gave an answer, and its options
POSES = 400  # poses of a path at which overlaps are looked up
PATCHES = 80_000  # default limit of contact patches trimmed for one query; about 10 s
AROUND = 4  # errors of polygons by which a clearance is changed to bound the largest
FEW, MANY = 48_000, 80_000  # guesses of searches among the shapes themselves, before the first polygons and after
MOST_AT_PLACE = 6  # orientations at a place to which a path among the shapes themselves is searched
COARSE = 2  # finenesses of boxes
NARROW = 0.002  # width of an interval, relative to the clearance, that finer polygons do not reduce
AMONG = ", among polygons around the round shapes"
TOUCHING = "these touch, or all but do; give a smaller tolerance, or other shapes"
MORE = "give max_seconds or a tolerance for more, or other shapes"


@checked
class CurvedPlanner:
    """Planner for a scene with round shapes, with the methods of `Planner`.

    Parameters
    ----------
    planner : Planner
        A planner of the scene, whose settings are used.
    tolerance : float, optional
        As in `cfree.plan`.

    """

    def __init__(self, planner: Planner, tolerance: float | None = None) -> None:
        self._settings, self._tolerance = planner, tolerance
        self._near = Approximations(planner.scene, tolerance)
        self._last: tuple[PosePlanner | TruePlanner, Options] | None = None

    @property
    def scene(self) -> Scene:
        """The scene of polygons of the last answer; that of the round shapes before, and if they have none inside."""
        with suppress(UndecidedError):
            if decided := self._decided:
                return decided[0].scene
        return self._settings.scene

    @property
    def _decided(self) -> Decided | None:
        if self._last is None:
            return None
        planner, options = self._last
        return planner.guide if isinstance(planner, TruePlanner) else planner, options

    @property
    def preferences(self) -> Preferences:
        return self._settings.preferences

    @property
    def vehicle(self) -> Vehicle | None:
        """The vehicle that drives; None for a robot that moves in any direction."""
        return self._settings.vehicle

    @property
    def exact(self) -> Scene:
        """The scene with round shapes."""
        return self._near.exact

    def obstacle_of(self, number: int, *, outward: bool = False) -> int:
        """Return the obstacle that a polygon of the last answer replaces; bounds and workspace keep their numbers.

        The polygons are inside the shapes, as in proofs, or around them if `outward`, as in paths.
        """
        return self._near.obstacle_of(number, outward=outward)

    @property
    def angle_scale(self) -> float:
        """Length per radian in the scene of polygons."""
        return robot_radius(self.scene)

    @property
    def free_space(self) -> FreeSpace:
        """The free space of the scene of polygons."""
        if self._decided is None:
            return self._settings.free_space
        planner, options = self._decided
        return planner.free_space(options)

    @checked
    def plan(
        self,
        start: PoseLike,
        goal: PoseLike,
        *,
        clearance: Number | None = None,
        improve: float | None = None,
        objective: Objective = "balanced",
    ) -> Path | Proof:
        """See `cfree.plan`."""
        begin, end = to_pose(start, "start"), to_pose(goal, "goal")
        options = self._settings._options(clearance, improve, objective)
        refuse_far(begin, end)

        def ask(planner: PosePlanner, options: Options) -> Answer:
            return answer_for_one(planner, begin, end, options)

        answer = self._answer(ask, (begin, end), options)
        assert not isinstance(answer, AllSeparated)
        return answer

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
        """See `cfree.plan`; for several goals, or places."""
        begin, ends = to_pose(start, "start"), several(goals)
        options = self._settings._options(clearance, improve, objective)
        refuse_far(begin, ends)

        def ask(planner: PosePlanner, options: Options) -> Answer:
            return answer_for_any(planner, begin, ends, options)

        answer = self._answer(ask, (begin, *ends), options, for_any=True)
        assert not isinstance(answer, Proof)
        return answer

    def _answer(self, ask: Ask, ends: Sequence[Goal], options: Options, *, for_any: bool = False) -> Answer:
        query = CurvedQuery(self._near, replace(options, tolerance=self._tolerance))
        try:
            return query.answer(ask, ends, for_any=for_any)
        finally:
            self._last = query.last or self._last


class CurvedQuery:
    """One query in a scene with round shapes.

    Parameters
    ----------
    near : Approximations
        The scene's polygons, which the query refines.
    options : Options
    thorough : bool
        False leaves out the long searches among segments and arcs: those among polygons around the shapes, those near
        fine polygons, and long pushes away from obstacles. The answer may be undecided more often.

    Attributes
    ----------
    last : (PosePlanner or TruePlanner, Options) or None
        The planner that gave the last answer, and its options.
    """

    def __init__(self, near: Approximations, options: Options, *, thorough: bool = True) -> None:
        self.near, self.options, self._thorough = near, options, thorough
        self.last: tuple[PosePlanner | TruePlanner, Options] | None = None
        self._begin, self._interval, self._reason = time.monotonic(), (0.0, math.inf), ""
        self._is_limited = options.tolerance is None and options.max_seconds is None
        self._work = Work(PATCHES) if self._is_limited else options.work
        self._decided: dict[bool, Decided] = {}
        self._cells: RoundCells | None = None
        has_arcs = arcs_of(near.exact) is not None
        self._true = TrueShapes(near.exact, near, options.clearance) if has_arcs else None

    def answer(self, ask: Ask, ends: Sequence[Goal], *, for_any: bool = False) -> Answer:
        """Answer the query; `ask` answers it in a scene of polygons, for any of several goals or for the only one.

        Raises
        ------
        UndecidedError
            If polygons within the tolerance decide neither way.
        """
        self._refuse(ends)
        try:
            return self._refined(ask, ends, for_any=for_any)
        except UndecidedError as error:
            if not self.options.clearance or error.path is not None:
                raise
            lo, hi, largest = self._largest(ends) or self._around(ask, error.error)
            message = f"{error}; the largest clearance that a path keeps is {largest}"
            raise UndecidedError(message, lo=lo, hi=hi, error=error.error) from None

    def _largest(self, ends: Sequence[Goal]) -> tuple[float, float, str] | None:
        """Return the largest clearance of a disc, between doubles and in words; None if infinite, or of others."""
        start, goal = ends if len(ends) == 2 else (None, None)
        way = widest_way(self.near.exact, start, goal) if isinstance(start, Pose) and isinstance(goal, Pose) else None
        if way is None or way.margin is None:
            return None
        return *way.margin.floats_around, f"exactly {way.margin}, {way.at}"

    def _around(self, ask: Ask, error: float) -> tuple[float, float, str]:
        """Bound the largest clearance by queries for a smaller and a larger one, in the scenes that gave answers."""
        lo, hi = self._interval
        for outward, (planner, options) in self._decided.items():
            other = options.clearance + (-AROUND if outward else AROUND) * Fraction(error)
            own = replace(options, clearance=other, improve=0.0, work=Work(PATCHES))
            with suppress(IncompleteError, InvalidPoseError):
                answer = ask(planner, own) if other > 0 else None
                if outward and isinstance(answer, Path):
                    lo = max(lo, math.nextafter(float(other), 0.0))  # rounded down
                elif not outward and answer is not None and not isinstance(answer, Path):
                    hi = min(hi, math.nextafter(float(other), math.inf))  # rounded up
        return lo, hi, f"between {lo:.8g} and {hi:.8g}"

    def _refuse(self, ends: Sequence[Goal]) -> None:
        """Refuse ends that are forbidden among lines and circular arcs, or nearer to something than the clearance."""
        arcs = arcs_of(self.near.exact)
        if arcs is None or self._true is None:
            return
        for k, end in enumerate(ends):
            name = "start" if k == 0 else name_of(ends[1:], k - 1)
            if not isinstance(end, Pose):
                if is_free_place(self._true.grown, end, self.options.tolerance) is False:
                    raise no_orientation(name, end, self.options.clearance)
                continue
            refuse_forbidden(PoseChecker(self.near.exact), end, name)
            if not self._true.arcs.is_free(end):
                least, most = arcs.distance(end)
                away = f"{least:.6g}" if f"{least:.6g}" == f"{most:.6g}" else f"between {least:.6g} and {most:.6g}"
                remedy = "move it, or give a smaller clearance"
                asked = f"the clearance is {float(self.options.clearance):g}"
                raise InvalidPoseError(f"{name}: {away} away from obstacles and workspace, and {asked}; {remedy}")

    def _first_path(self, planner: TruePlanner, ends: Sequence[Pose], guesses: int) -> Path | None:
        """Return the cheapest path among the shapes themselves, if a search finds one."""
        options = self._within_time()
        paths = list[Path]()
        for goal in ends[1:]:
            try:
                path = planner.first_path(ends[0], goal, options.shared(len(ends) - 1), guesses)
            except UndecidedError as error:  # of a vehicle
                self._reason = str(error)
            else:
                paths += [path] if isinstance(path, Path) else []
        if not paths:
            return None
        self.last = planner, options
        return cheapest(paths, self.near.exact, options.preferences)

    def _poses_for(self, ends: Sequence[Goal], planner: TruePlanner) -> Iterator[Pose]:
        """Yield the poses, and some at each place that are free among segments and arcs."""
        start = ends[0]
        assert isinstance(start, Pose)
        for end in ends:
            if isinstance(end, Pose):
                yield end
                continue
            near = list[Pose]()
            with suppress(UndecidedError):  # the robot has no polygon inside
                intervals = free_orientations(planner.guide.scene, end)
                near = [pose for interval in intervals if (pose := pose_in(interval, start, end))]
            taus = [start.tau, *STRAIGHT, *(tau for pose in near for tau in planner.taus_near(pose))]
            some = dict.fromkeys([*near, *(pose_at(*end, tau) for tau in taus)])
            yield from islice(filter(planner.arcs.is_free, some), MOST_AT_PLACE)

    def _within_time(self) -> Options:
        seconds = self.options.max_seconds
        if seconds is None:
            return self.options
        return replace(self.options, max_seconds=max(0.0, seconds - (time.monotonic() - self._begin)))

    def _refined(self, ask: Ask, goals: Sequence[Goal], *, for_any: bool) -> Answer:
        searches, ends = [FEW, MANY], [end for end in goals if isinstance(end, Pose)]
        while True:
            apart, inner, refused = None, None, None
            true = self._true.planner() if self._true else None
            if true:
                poses, is_early = [*self._poses_for(goals, true)], bool(searches)
                if is_early and (path := self._first_path(true, poses, searches.pop(0))):
                    return path
                inner = self._asked(ask, outward=False)
                if not isinstance(inner, Path) and inner is not None:
                    return self._for_curves(inner)
                by_cells = self._by_cells(goals, FEW_PAIRS, for_any=for_any) if is_early else None
                if by_cells is not None:
                    return by_cells
                if isinstance(inner, Path):
                    guides = self._guides(true, inner, poses) if self._thorough or is_early else ()
                    if path := next(filter(None, (self._mended(true, guide) for guide in guides)), None):
                        return path
                if is_early and self._thorough:
                    by_cells = self._by_cells(goals, PAIRS, for_any=for_any)
                if by_cells is not None:
                    return by_cells
            try:
                answer = self._asked(ask, outward=True) if self._thorough or not true else None
                if isinstance(answer, Path):
                    return self._for_curves(answer)
                apart = answer
            except InvalidPoseError as error:  # the inner scene decides if the round shapes also refuse the pose
                refused = error
            try:
                inner = inner if true else self._asked(ask, outward=False)
                if inner is not None and refused is None and not isinstance(inner, Path):
                    return self._for_curves(inner)
            except ForbiddenPoseError as error:
                raise _for_both(error, refused) from None
            within = inner if isinstance(inner, Path) and (true or refused is None) else None
            is_one = len(ends) == len(goals) == 2
            if within is not None and is_one and (proof := self._excluded(within)) is not None:
                return self._for_curves(proof)
            lo, hi = self._interval
            if self._is_limited and 0 < hi - lo <= NARROW * lo:
                raise self._undecided("the clearance is too near to the largest; give another, or a tolerance")
            if not self.near.refine(_poses(within, ends), () if apart is None else apart.obstacles):
                raise self._undecided(self._reason or TOUCHING)

    def _by_cells(self, goals: Sequence[Goal], most: int, *, for_any: bool) -> Separated | AllSeparated | None:
        """Return a proof by cells among the shapes themselves; None without one, or if it was tried.

        Goals are poses; or places, if the robot is a disc about its reference point.
        """
        is_disc = is_disc_about_reference(self.near.exact)
        start, *ends = poses = [
            goal if isinstance(goal, Pose) else pose_at(*goal, Fraction(0))
            for goal in goals
            if is_disc or isinstance(goal, Pose)
        ]
        if self._cells is not None or len(poses) < len(goals):
            return None
        self._cells = round_cells(self.near.exact, self._within_time(), most)
        proofs = list[Separated]()
        for end in ends:
            proof = self._cells.proof(start, end) if self._cells else None
            if proof is None:
                return None
            proofs.append(proof)
        return all_separated(proofs, goals[1:], is_whole=True) if for_any else proofs[0]

    def _guides(self, true: TruePlanner, inner: Path, poses: Sequence[Pose]) -> Iterator[Path]:
        """Yield a path among inner polygons; those to exact poses instead if it ends at a place in an inexact one."""
        if true.arcs.is_free(inner.goal):
            yield inner
            return
        options = replace(self._within_time(), improve=0.0, vehicle=None, work=self._work)
        for goal in poses[1 : 1 + MOST_AT_PLACE]:
            with suppress(IncompleteError):
                guide = PosePlanner(true.guide.scene).path_or_proof(inner.start, goal, options)
                if isinstance(guide, Path):
                    yield guide

    def _mended(self, true: TruePlanner, path: Path) -> Path | None:
        """Return a path among the shapes near one among the polygons inside of them."""
        options = self._within_time()
        with suppress(UndecidedError):
            mended = true.mended(path, options, thorough=self._thorough)
            if isinstance(mended, Path):
                self.last = true, options
                return mended
        return None

    def _asked(self, ask: Ask, *, outward: bool) -> Answer | None:
        """Return the answer in one of the two scenes of polygons; None if there is no such scene, or no answer."""
        try:
            planner = PosePlanner(self.near.scene(outward=outward))
        except UndecidedError as error:
            self._reason = str(error)
            return None
        options, seconds = replace(self.options, work=self._work, exact_discs=False), self.options.max_seconds
        if not outward:
            # a path here is a guide; a proof holds for every vehicle
            options = replace(options, improve=0.0, objective="balanced", vehicle=None)
        if seconds is not None:
            options = replace(options, max_seconds=max(0.0, seconds - (time.monotonic() - self._begin)))
        try:
            answer = ask(planner, options)
        except OutOfWork as error:
            raise self._undecided(f"{error}; {MORE}") from None
        except UndecidedError as error:
            if isinstance(error.path, Path):  # finer polygons need no fewer manoeuvres
                proof = self._for_curves(error.path)
                raise UndecidedError(str(error), path=proof, manoeuvres=error.manoeuvres) from None
            lo, hi = self._interval
            self._interval = (max(lo, error.lo), hi) if outward else (lo, min(hi, error.hi))
            if options.vehicle and not options.clearance:
                self._reason = str(error)
            return None
        except IncompleteError:
            raise self._undecided(f"{seconds:g} seconds were not enough; give more") from None
        self.last = self._decided[outward] = planner, options
        if isinstance(answer, Stuck | Unreachable):
            self._reason = f"{answer.said()}{AMONG}"
            return None
        if isinstance(answer, AllSeparated) and answer.of == "pieces":
            what = "contacts" if any(isinstance(proof, Stuck) for proof in answer.proofs) else "boxes"
            self._reason = f"{what} hold the vehicle{AMONG}"
        return answer

    def _excluded(self, path: Path) -> Unreachable | None:
        """Return a proof by boxes among inner polygons for a car without reverse gear, beside a path of the robot."""
        car = self.options.vehicle
        if not isinstance(car, Car) or car.gears != "forward" or self.options.clearance:
            return None
        assert path.scene is not None
        levels = islice(Reach(path.scene, car, path.start, path.goal).levels(), COARSE)
        proofs = (level.proof for level in levels)
        return next((proof for proof in proofs if proof is not None), None)

    def _undecided(self, reason: str) -> UndecidedError:
        error = self.near.reached
        message = f"polygons within {error:.3g} of the round shapes decide neither way: {reason}"
        return UndecidedError(message, error=error)

    def _for_curves(self, answer: Answer) -> Answer:
        exact = self.near.exact
        frame = frame_of(exact)
        if isinstance(answer, AllSeparated):
            proofs = (replace(proof, curved=exact, frame=frame) for proof in answer.proofs)
            return replace(answer, proofs=tuple(proofs))
        return replace(answer, curved=exact, frame=frame)


def _for_both(inner: ForbiddenPoseError, outer: InvalidPoseError | None) -> ForbiddenPoseError:
    """Combine the overlap of the inner scene's message, which is proved, with the free pose of the outer scene's."""
    overlap, free = str(inner).partition(";")[0], str(outer or "").partition(";")[2]
    return ForbiddenPoseError(f"{overlap};{free}" if free else overlap, free=getattr(outer, "free", None))


def _poses(path: Path | None, ends: Sequence[Pose]) -> NDArray[np.float64]:
    """Return rows x, y, theta of start and goals, and along a path."""
    table = [[float(pose.x), float(pose.y), pose.theta] for pose in ends]
    if path is None or not path.motions:
        return np.array(table)
    poses = path.sample(max(path.length, 1e-300) / POSES, max(path.turning, 1e-9) / POSES)
    return np.vstack([table, np.column_stack([poses.xy, poses.theta])])
