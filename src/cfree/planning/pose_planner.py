"""Paths between exact poses in one scene of polygons, or proofs that there are none.

The C++ core plans (see `planner.hpp`); this module wraps its answers in objects and improves paths. The public planners
have checked all arguments.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from itertools import pairwise

import cfree._core as _core
from cfree.collision.motion import joining
from cfree.collision.motion_checker import MotionChecker
from cfree.collision.nearest_free import refuse_forbidden
from cfree.collision.pose_checker import PoseChecker
from cfree.collision.slide import Slide
from cfree.errors import InvariantError
from cfree.exact.pose import Pose
from cfree.free.space import FreeSpace, built_space
from cfree.lazy import registered
from cfree.paths.path import Path
from cfree.planning.core_ways import Slides, end_of, from_numbers, numbers_of, way_of
from cfree.planning.improving import Improver
from cfree.planning.keep_clear import clear
from cfree.planning.near_poles import near_poles
from cfree.planning.options import Options
from cfree.planning.proof import Proof
from cfree.planning.separation import Separated, known_scene
from cfree.planning.stuck import Stuck
from cfree.planning.unreachable import Unreachable
from cfree.scene.frame import frame_of
from cfree.scene.scene import Scene, robot_radius
from cfree.vehicles.vehicle import Vehicle

COMPLETE = 30_000  # most contact patches of a grown robot whose free space is computed


class PosePlanner:
    """Planner for many pairs of poses in one scene; shared data are computed once.

    Parameters
    ----------
    scene : Scene
    space : FreeSpace, optional
        Computed at first use by default.
    """

    is_among_arcs = False  # True of a planner among round shapes, whose polygons are a guide

    def __init__(self, scene: Scene, space: FreeSpace | None = None) -> None:
        self.scene, self._space = scene, space
        self._slides: Slides = {}  # by the poses that they join
        self.center: tuple[float, float] | None = None  # a point of the robot, about which paths are made to turn less

    @cached_property
    def checker(self) -> MotionChecker:
        """Checker of motions in the scene."""
        return MotionChecker(self.scene)

    @cached_property
    def angle_scale(self) -> float:
        """Length per radian: the robot's radius about its reference point."""
        return robot_radius(self.scene)

    @cached_property
    def _known(self) -> _core.KnownScene:
        return known_scene(self.checker, self._space)

    @cached_property
    def _planner(self) -> _core.Planner:
        return _core.Planner(self._known, self.angle_scale)

    @property
    def has_space(self) -> bool:
        """True if the free space has been computed."""
        return self._space is not None

    @property
    def has_slides(self) -> bool:
        """True if paths of it may slide along contacts."""
        return bool(self._slides)

    def keep_slides(self, path: Path) -> None:
        """Keep the slides of a path as they are when it is improved."""
        slides = ((ends, motion) for ends, motion in zip(pairwise(path.poses), path.motions, strict=True))
        self._slides |= {ends: motion for ends, motion in slides if isinstance(motion, Slide)}

    def updated(self, scene: Scene) -> PosePlanner:
        """Return a planner of another scene that shares what holds in it."""
        other = PosePlanner(scene)
        is_polygonal = not (self.scene.curved or scene.curved)
        if is_polygonal and (self._space is not None or "_known" in self.__dict__):
            other._planner.take(self._planner)
        return other

    def free_space(self, options: Options) -> FreeSpace:
        """Return the free space, computed at first use."""
        if self._space is None:
            built = self._known.build(options.caller())
            self._space = built_space(self.scene, self.checker.features, *built)
        return self._space

    def path_or_proof(self, start: Pose, goal: Pose, options: Options) -> Path | Proof:
        """Return an improved path, or a proof; a clearance is not kept."""
        way = self.way(start, goal, options)
        assert way is not None, "the search was complete"
        return self.answered(way, options) if isinstance(way, list) else way

    def way(self, start: Pose, goal: Pose, options: Options, *, few: bool = False) -> list[Pose] | Separated | None:
        """Return poses of a path, or a proof; None if `few` surfaces do not decide. Swapped ends give the same."""
        try:
            answer = self._planner.plan(end_of(start), end_of(goal), options.caller(), few)
        except InvariantError as error:
            error.state = self.scene, start, goal
            raise
        if answer == "unclear":
            return None
        if isinstance(answer, str):
            refuse_forbidden(PoseChecker(self.scene), start if answer == "start" else goal, answer)
            raise InvariantError(f"{answer} is free, and it is not", state=(self.scene, start, goal))
        if isinstance(answer, _core.Separation):
            return Separated._of(answer, self.scene, start, goal)
        return way_of(answer, self.checker.features, self._slides)

    def proof(self, start: Pose, goal: Pose, options: Options) -> Separated | None:
        """Return a proof for two poses at which the robot touches nothing; None if there is none."""
        barrier = self._known.barrier(numbers_of(start), numbers_of(goal), options.caller())
        return None if barrier is None else Separated._of(barrier, self.scene, start, goal)

    def walk(self, start: Pose, goal: Pose, options: Options) -> list[Pose] | None:
        """Return poses of a path along the boundary of the first cell whose closure contains both; None without one."""
        way = self._planner.walk(end_of(start), end_of(goal), options.caller())
        return None if way is None else way_of(way, self.checker.features, self._slides)

    def quick(self, start: Pose, goal: Pose, options: Options, guesses: int | None = None) -> Sequence[Pose] | None:
        """Return poses of a path between free poses; None if neither simple paths nor a search gives one.

        The search makes so many guesses of motions; by default the more, the more patches there are.
        """
        way = self._planner.quick(end_of(start), end_of(goal), options.caller(), guesses)
        return None if way is None else [*map(from_numbers, way)]

    def answered(self, way: Sequence[Pose], options: Options) -> Path | Stuck | Unreachable:
        """Improve a path, given by its poses; a vehicle drives near it, or may be stuck at its ends."""
        return self.improved(way, options) if options.vehicle is None else self._driven(way, options.vehicle, options)

    def improved(self, way: Sequence[Pose], options: Options) -> Path:
        """Improve a path of a robot that moves in any direction, given by its poses."""
        parts = self._without_slides(way)
        own, objective = options.shared(len(parts)), options.objective
        with options.phase("clearer paths" if objective == "clear" else "shorter paths"):
            if objective == "clear":
                balanced = (self.improver(part, own).balanced(part, None) for part in parts)
                return self.path([q for part in balanced for q in self._cleared(part, own)])

            def better(part: Sequence[Pose]) -> Sequence[Pose]:
                improver = self.improver(part, own)
                method = improver.balanced if objective == "balanced" else improver.shortened
                return method(part, own.improve)

            return self.path([q for part in parts for q in better(part)])

    def path(self, poses: Sequence[Pose]) -> Path:
        """Return a path through these poses, without far poles where that is free; every motion is checked again.

        Raises
        ------
        InvariantError
            If a motion is not free: a fault of cfree.
        """
        parts = self._without_slides(poses)
        poses = [q for part in parts for q in near_poles(self.scene, self.checker, part)]
        motions = [self._slide(a, b) or joining(a, b) for a, b in pairwise(poses) if a != b]
        path = Path(poses[0], motions, self.scene.units, frame_of(self.scene), scene=self.scene)
        if not path.is_free(self.checker):
            raise InvariantError("a path is not free", state=path)
        return path

    def improver(self, poses: Sequence[Pose], options: Options) -> Improver:
        """Return an improver of a path, given by its poses; preferences count at the axle of a vehicle."""
        costs = self.angle_scale, *options.preferences.factors
        frame = options.vehicle.frame if options.vehicle else Pose(0, 0)
        axle = float(frame.x), float(frame.y), frame.theta
        turns_freely = options.vehicle is None and not options.preferences.matter
        center = self.center if turns_freely else None
        searcher = _core.Searcher(self._known, [end_of(pose)[1] for pose in poses], costs, axle, center)
        return Improver(self.scene, self.checker, searcher, options.preferences, options.stop, center is not None)

    def _driven(self, way: Sequence[Pose], vehicle: Vehicle, options: Options) -> Path | Stuck | Unreachable:
        """Return a path of a vehicle between the ends of a path of the robot, or a proof that it is stuck."""
        with options.phase("driving"):
            drive = registered("drive_along")
            answer: Path | Stuck | Unreachable = drive(self, self._known, vehicle, replace(options, vehicle=None), way)
        if answer.goal != way[-1]:
            raise InvariantError("a path of a vehicle ends elsewhere", state=answer)
        return answer

    def _slide(self, a: Pose, b: Pose) -> Slide | None:
        """Return the slide that joins two poses; None if there is none."""
        if not self._slides:
            return None
        back = self._slides.get((b, a))
        return back.reversed() if back else self._slides.get((a, b))

    def _without_slides(self, poses: Sequence[Pose]) -> list[Sequence[Pose]]:
        """Divide a path, given by its poses, at its slides."""
        after = [k for k in range(1, len(poses)) if self._slide(poses[k - 1], poses[k])]
        return [poses[i:j] for i, j in pairwise([0, *after, len(poses)])]

    def _cleared(self, poses: Sequence[Pose], options: Options) -> Sequence[Pose]:
        """Return a path with margins where there is room."""
        end = time.perf_counter() + (options.improve or 0)
        own = Options(preferences=options.preferences)

        def way_between(scene: Scene, start: Pose, goal: Pose) -> Sequence[Pose] | None:
            larger = PosePlanner(scene)
            larger.center = self.center
            way = larger.quick(start, goal, own)
            if way is None and larger.checker.features.patches <= COMPLETE:
                way = larger.walk(start, goal, own)
            if way is None or len(larger._without_slides(way)) > 1:
                return None
            left = options.improve and max(0.0, end - time.perf_counter()) / 3
            improver = larger.improver(way, own)
            return improver.shortened(improver.turning_less(way), left)

        return clear(self.scene, self.checker, poses, self.angle_scale, way_between)
