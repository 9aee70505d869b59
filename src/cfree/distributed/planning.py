"""Plan in a scene that is too large to be read: along a route, or with the obstacles near the paths found so far."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from cfree.distributed.portals import StoredAtlas, StoredGround, atlas_of
from cfree.distributed.tasks import Work
from cfree.distributed.tiles import BoxIndex
from cfree.errors import UndecidedError
from cfree.exact.pose import Pose
from cfree.paths.numbering import has_slides
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import NONE, Preferences
from cfree.planning.among import MARGIN, WIDER, add_ends, check_length, plan_around, proof_at_ends
from cfree.planning.atlas import LazyAtlas
from cfree.planning.goals import refuse_far
from cfree.planning.options import Options, to_seconds
from cfree.planning.plan import plan
from cfree.planning.proof import Proof
from cfree.planning.routes import Leg, is_distant, joined, legs_along
from cfree.planning.separation import Separated
from cfree.planning.steps import AmongArcs
from cfree.scene.digest import Whole
from cfree.scene.scene import Scene, vehicle_for
from cfree.vehicles.vehicle import Vehicle

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]


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

    @property
    def radius(self) -> float:
        """Radius of the robot."""
        return self.work.store.radius

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
        check_length(path, self.radius)
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
    way: Sequence[Pose] | None = None
    legs: list[Leg] | Separated | None = None
    if is_distant(start, goal, known.radius):
        legs = legs_along(known.atlas, start, goal, options, lambda: proof_at_ends(known, start, goal))
    if isinstance(legs, Separated):  # further obstacles do not change that
        return replace(legs, whole=known.whole)
    if legs is not None:
        ground = StoredGround(known.work)
        known.read |= {tile for leg in legs for tile in ground.tiles(leg.box)}
        path, numbers = joined(start, legs, ground)
        known.numbers = set(numbers)
        if driver is None:
            return replace(path, whole=known.whole)
        known.add_around(path, MARGIN * known.radius)
        way = None if has_slides(path) else path.poses
    plan_near = _plan_around_rounds if known.work.store.is_round else plan_around
    return replace(plan_near(known, start, goal, options, way), whole=known.whole)


def _plan_around_rounds(
    known: Surroundings, start: Pose, goal: Pose, options: Options, way: Sequence[Pose] | None
) -> Path | Proof:
    """See `plan_around`: by `cfree.plan` among the obstacles near the paths found."""
    margin = MARGIN * known.radius
    add_ends(known, start, goal)
    while True:
        answer: Path | Proof | None = None
        if way is not None:
            with suppress(UndecidedError):  # a vehicle may drive elsewhere
                answer = AmongArcs(known.scene).finished(way, options)
            way = None if answer is None else way
        answer = answer or _answered(known.scene, start, goal, options)
        # proofs hold among more obstacles
        if not isinstance(answer, Path) or not known.add_around(answer, margin):
            return answer
        margin *= WIDER


def _answered(scene: Scene, start: Pose, goal: Pose, options: Options) -> Path | Proof:
    return plan(
        scene,
        start,
        goal,
        improve=options.improve,
        objective=options.objective,
        preferences=options.preferences,
        vehicle=options.vehicle or "any",
    )
