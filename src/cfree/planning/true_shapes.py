"""Paths among segments and circular arcs: searches look at the shapes themselves, and these decide.

Where searches fail, polygons inside the shapes are a guide. They forbid less than the shapes, and their distances are
too large by at most a known slack. Every motion of a path is proved free among the shapes: docs/theory/exact-arcs.md.
So a fit along a line or about a point is found.
"""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import replace
from fractions import Fraction
from functools import cached_property

from cfree.collision.approximations import Approximations
from cfree.collision.arcs import ArcScene, arcs_of
from cfree.exact.pose import Pose
from cfree.paths.path import Path
from cfree.planning.arc_planner import ArcPlanner, with_boxes, with_inner_polygons, with_polygons_near
from cfree.planning.narrow_fits import NEAR, way_out_of_contacts, way_through_fits
from cfree.planning.options import Options
from cfree.planning.stuck import Stuck
from cfree.scene.frame import frame_of
from cfree.scene.scene import Scene, grown_scene

FINER = 4  # errors of polygons are divided by this where a path is improved
EACH = 4  # part of a search's guesses for each way out of contacts
PUSHES = 100, 400  # motions checked to push a path away from obstacles, before and after fits are tried


class TruePlanner:
    """Planner that finds and finishes the paths of one query among round shapes.

    Parameters
    ----------
    exact : Scene
        The scene of the query.
    clearance : Fraction
        A distance that a path keeps: the robot of `arcs` is grown by a disc of that radius.
    arcs : ArcScene
        The exact shapes.
    near : Approximations
        Their polygons.

    Attributes
    ----------
    arcs : ArcScene
    """

    def __init__(self, exact: Scene, clearance: Fraction, arcs: ArcScene, near: Approximations) -> None:
        self.arcs, self._search, self._near = arcs, with_boxes(arcs, near.exact), near
        self._exact, self._clearance = exact, clearance
        self._planners: dict[tuple[bool, bool], ArcPlanner] = {}

    @cached_property
    def guide(self) -> ArcPlanner:
        """A planner with polygons inside the shapes, away from which it pushes paths."""
        return with_inner_polygons(self.arcs, self._near)

    def _improving(self, options: Options) -> ArcPlanner:
        """Return a planner with polygons; finer ones improve paths, as their distances are nearer to the truth."""
        key = options.improve != 0, options.vehicle is not None
        if key not in self._planners:
            near = copy(self._near)
            if options.improve != 0:
                errors = enumerate(near.errors)
                near.errors = [max(error / FINER, near.least(k)) if error else error for k, error in errors]
            make = with_inner_polygons if options.vehicle else with_polygons_near
            self._planners[key] = make(self.arcs, near)
        return self._planners[key]

    def first_path(self, start: Pose, goal: Pose, options: Options, guesses: int | None = None) -> Path | Stuck | None:
        """Return a path between free poses, if simple ways or searches give one."""
        search = self._search
        way = [start] if start == goal else search.quick(start, goal, options, 0)
        way = way or way_out_of_contacts(search, start, goal, options, guesses and guesses // EACH)
        way = way or search.quick(start, goal, options, guesses)
        return self.finished(way, options) if way else None

    def joins(self, start: Pose, goal: Pose, guesses: int) -> bool:
        """True if simple ways, or a search of so many guesses, join two free poses."""
        return self._search.quick(start, goal, Options(), guesses) is not None

    def taus_near(self, pose: Pose) -> list[Fraction | None]:
        """Return half-angle tangents near a pose's at which something is parallel, and simple ones."""
        return self._search.fits.angles(float(pose.x), float(pose.y), pose.theta, NEAR * max(self._near.errors))

    def mended(self, path: Path, options: Options, *, thorough: bool = True) -> Path | Stuck | None:
        """Return a path near one among the polygons, if all motions of it, or of one farther from them, are free."""
        poses: Sequence[Pose] = path.poses
        search, slides = self._search, any(motion.contacts for motion in path.motions)
        if not slides and search.checker.joins(poses):
            return self.finished(poses, options)
        # a few help where there is room; more are dear near exact fits, which are tried first
        pushes = PUSHES if thorough else PUSHES[:1]
        pushed = iter(()) if slides else self.guide.improver(poses, options).pushed(poses, pushes)
        if (first := next(pushed, None)) and search.checker.joins(first):
            return self.finished(first, options)
        through = way_through_fits(search, path, options, max(self._near.errors), thorough=thorough)
        if through is not None and search.checker.joins(through):
            return self.finished(through, options)
        if (last := next(pushed, None)) and search.checker.joins(last):
            return self.finished(last, options)
        return None

    def finished(self, way: Sequence[Pose], options: Options) -> Path | Stuck | None:
        """Improve a path, given by its poses, and return it as one among the shapes."""
        planner = self._search
        if options.improve != 0 or options.vehicle or options.objective == "clear":
            planner = self._improving(options)
        answer = planner.answered(way, options)
        if not isinstance(answer, Path):
            return None
        exact = self._exact
        scene = None if exact.curved else exact
        answer = replace(answer, scene=scene, curved=exact if exact.curved else None, clearance=self._clearance)
        return replace(answer, frame=frame_of(exact), units=exact.units)


class TrueShapes:
    """Planners on the true shapes of a scene, with the robot grown by a disc, at finer and finer polygons.

    Parameters
    ----------
    scene : Scene
        All shapes are of lines and circular arcs.
    near : Approximations
        Its polygons, which are refined elsewhere.
    clearance : Fraction
        Radius of the disc.

    Attributes
    ----------
    grown : Scene
    arcs : ArcScene
        The exact shapes of `grown`.
    """

    def __init__(self, scene: Scene, near: Approximations, clearance: Fraction) -> None:
        self._scene, self._near, self._clearance = scene, near, clearance
        self.grown = grown_scene(scene, clearance) if clearance else scene
        arcs = arcs_of(self.grown)
        assert arcs is not None, "all shapes are of lines and circular arcs"
        self.arcs = arcs

    def planner(self) -> TruePlanner:
        """Return a planner with the polygons of now."""
        near = self._near
        if self._clearance:
            near = Approximations(self.grown, near.tolerance)
            pairs = enumerate(zip(near.errors, self._near.errors, strict=True))
            near.errors = [min(own, max(error, near.least(k))) if error else own for k, (own, error) in pairs]
        return TruePlanner(self._scene, self._clearance, self.arcs, near)
