"""Plan in a scene that is too large to be read, with the obstacles near the paths found so far.

A separating surface among some of the obstacles separates two poses among all. A path among some is one among all if
all obstacles near it are included. So obstacles are added along the paths that are found, until one of the two is
certain.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from cfree.collision.motion_checker import MotionChecker
from cfree.distributed.portals import StoredAtlas, StoredGround, atlas_of
from cfree.distributed.tasks import Work
from cfree.distributed.tiles import BoxIndex
from cfree.errors import InvariantError, UndecidedError
from cfree.exact.pose import Pose
from cfree.paths.numbering import has_slides
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import NONE, Preferences
from cfree.planning.atlas import LazyAtlas
from cfree.planning.goals import refuse_far
from cfree.planning.options import Options, to_seconds
from cfree.planning.pose_planner import PosePlanner
from cfree.planning.proof import Proof
from cfree.planning.routes import Leg, Router, improved
from cfree.planning.separation import Separated
from cfree.scene.digest import Whole
from cfree.scene.frame import frame_of
from cfree.scene.scene import Scene, vehicle_for
from cfree.vehicles.vehicle import Vehicle

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]
MOST_STEPS = 10_000_000  # along a path, each as long as the robot's reach
MARGIN, WIDER = 2.0, 4.0
"""Distance around a path within which obstacles are added, in reaches of the robot; the factor if some were missing."""


@dataclass
class Surroundings:
    """Obstacles of a stored scene that have been needed so far.

    Attributes
    ----------
    work : Work
    numbers : set of int
        Obstacles that are known.
    read : set of int
        Tiles whose lists have been read.
    """

    work: Work
    numbers: set[int] = field(default_factory=set)
    read: set[int] = field(default_factory=set)

    @cached_property
    def atlas(self) -> StoredAtlas | LazyAtlas:
        """Rooms and portals of the stored scene."""
        return atlas_of(str(self.work.folder), self.work.stamp)

    @property
    def scene(self) -> Scene:
        """Scene with the known obstacles."""
        return self.work.store.scene(sorted(self.numbers))

    @property
    def whole(self) -> Whole:
        """The whole scene, and the numbers of these obstacles in it."""
        return Whole(self.work.store.facts["scene"], tuple(sorted(self.numbers)))

    def around(self, points: Floats, reach: float, spans: bool = False) -> Ints:
        """Obstacles whose boxes are within reach of points, by their edges, or by all that they cover."""
        division = self.work.division
        squares = np.concatenate([points, points], axis=1)
        tiles = BoxIndex(division.spans if spans else division.boxes).near(squares, reach)
        self.read |= set(tiles.tolist())
        lists = [division.listed("obstacles", tile) for tile in tiles.tolist()]
        numbers = np.unique(np.concatenate([np.zeros(0, np.int64), *lists]))
        return numbers[BoxIndex(self.work.store.column("box")[numbers]).near(squares, reach)]

    def add_around(self, path: Path, margin: float = 0.0) -> bool:
        """Add obstacles that the robot may touch on a path, or within a margin of it; False if all were known.

        Raises
        ------
        UndecidedError
            If the path is too long to look at all places along it.
        """
        if path.length > MOST_STEPS * self.work.store.radius:
            raise UndecidedError(
                f"a path was found that is {path.length:.3g} long, too long to look for all obstacles along it; "
                "give the scene bounds, or the vehicle a smaller turning radius"
            )
        ends = np.array([[float(q.x), float(q.y)] for q in (path.start, path.goal)])
        points, radius = path.sample(self.work.store.radius).xy, self.work.store.radius
        near = set(self.around(points, 2 * radius).tolist()) | set(self.around(ends, radius, spans=True).tolist())
        if near <= self.numbers:
            return False
        self.numbers |= near | set(self.around(points, 2 * radius + margin).tolist())
        return True


def plan_among(
    known: Surroundings,
    start: Pose,
    goal: Pose,
    *,
    improve: float | None = None,
    objective: Objective = "balanced",
    preferences: Preferences | None = None,
    vehicle: Vehicle | Literal["any"] | None = None,
) -> Path | Proof:
    """Path or proof, whose scene has the obstacles that it is about; options are those of `cfree.plan`.

    If the goal is far, a route from room to room is tried first. Else obstacles near the paths found decide.
    """
    driver = vehicle_for(known.work.store.head, vehicle)
    options = Options(to_seconds(improve), objective=objective, preferences=preferences or NONE, vehicle=driver)
    refuse_far(start, goal)
    around = MARGIN * known.work.store.radius
    router = Router(known.atlas, start, goal, replace(options, vehicle=None))
    way: Sequence[Pose] | None = None
    if router.is_far and (legs := router.legs(lambda: _apart(known, start, goal))) is not None:
        if driver is None:
            return _as_a_whole(known, start, improved(start, legs, router.atlas.ground, options))
        path = Path(start, [motion for leg in legs for motion in leg.motions])
        known.add_around(path, around)
        way = None if has_slides(path) else path.poses
    for end in (start, goal):
        known.add_around(Path(end, []), around)
    return _explored(known, start, goal, options, way)


def _apart(known: Surroundings, start: Pose, goal: Pose) -> bool:
    """True if the obstacles around the ends separate them, which is fast where one is closed in."""
    near = Surroundings(known.work)
    for end in (start, goal):
        near.add_around(Path(end, []), MARGIN * known.work.store.radius)
    return isinstance(PosePlanner(near.scene).way(start, goal, Options(), few=True), Separated)


def _as_a_whole(known: Surroundings, start: Pose, legs: Sequence[Leg]) -> Path:
    """Path of legs, checked as a whole among all obstacles that the robot may touch on them."""
    path = Path(start, [motion for leg in legs for motion in leg.motions])
    ground = StoredGround(known.work)
    for leg in legs:
        known.read |= set(ground.tiles(leg.box))
        known.numbers |= set(leg.obstacles.tolist())
    scene = known.scene
    if not path.is_free(MotionChecker(scene)):
        raise InvariantError("a path from room to room is not free", state=path)
    return replace(path, units=scene.units, frame=frame_of(scene), scene=scene, whole=known.whole)


def _explored(
    known: Surroundings, start: Pose, goal: Pose, options: Options, way: Sequence[Pose] | None
) -> Path | Proof:
    """Path or proof among the obstacles near the paths found; others are added until one of the two is certain.

    A way from start to goal that is free among the known obstacles, and not only them, needs no search.
    """
    margin = MARGIN * known.work.store.radius

    def is_farther(path: Path) -> bool:
        nonlocal margin
        if not known.add_around(path, margin):
            return False
        margin *= WIDER
        return True

    while True:
        planner = PosePlanner(known.scene)
        if way is None:
            found = planner.way(start, goal, options)
            if isinstance(found, Separated):  # further obstacles do not change that
                return replace(found, whole=known.whole)
            assert found is not None, "the search was complete"
            if is_farther(planner.path(found)):
                continue
            way = found
        try:
            answer = planner.answered(way, options)
        except UndecidedError as error:  # a vehicle needs too many manoeuvres on a path, if that is free among all
            if not isinstance(error.path, Path) or not is_farther(error.path):
                raise
        else:
            if not isinstance(answer, Path) or not is_farther(answer):  # proofs hold among more obstacles
                return replace(answer, whole=known.whole)
        way = None if planner.has_slides else way
