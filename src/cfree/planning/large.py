"""Plan in a scene of many obstacles by those near the path: along a route, or around the ends.

Only paths: a proof among some obstacles would name them by other numbers, and the planner of the whole scene gives it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from weakref import WeakKeyDictionary

import numpy as np

from cfree.errors import IncompleteError
from cfree.exact.pose import Pose
from cfree.paths.numbering import has_slides, renumbered
from cfree.paths.path import Path
from cfree.planning.among import MARGIN, check_length, plan_around, proof_at_ends
from cfree.planning.atlas import LazyAtlas
from cfree.planning.box_tree import BoxTree
from cfree.planning.options import Options
from cfree.planning.pose_planner import PosePlanner
from cfree.planning.rooms import Box, Floats, Ints, divided
from cfree.planning.routes import is_distant, joined, legs_along
from cfree.planning.separation import Separated
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene, robot_radius, with_bounds, with_obstacles

WIDE = 1 + 1e-9  # factor for the rounding of a radius
_GROUNDS: WeakKeyDictionary[PosePlanner, SceneGround] = WeakKeyDictionary()


class SceneGround:
    """Obstacles of a scene of polygons, to be looked up by place.

    Parameters
    ----------
    scene : Scene
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.radius = robot_radius(scene) * WIDE
        self._tree = BoxTree((polygon._handle.box for polygon in scene.obstacles), len(scene.obstacles))

    @cached_property
    def atlas(self) -> LazyAtlas:
        """Rooms, and portals made on the way."""
        walls = [*self.scene.obstacles, *([] if self.scene.workspace is None else [self.scene.workspace])]
        return LazyAtlas(self, divided(edges_of(walls), self.radius, self.scene.bounds))

    def near(self, box: Box) -> Ints:
        """Obstacles whose boxes are within the robot's radius of a box."""
        return self.around(np.array([box]), self.radius)

    def around(self, boxes: Floats, reach: float) -> Ints:
        """Obstacles whose boxes are within a distance of boxes along both axes, in order; rounding adds some."""
        rim = reach + 16 * float(np.spacing(np.abs(boxes).max(initial=0.0)))
        return self._tree.meeting(boxes + np.array([-rim, -rim, rim, rim]))

    def part(self, numbers: Ints, bounds: Box | None) -> Scene:
        """Scene with some of the obstacles, whose names are those of the whole."""
        own = self.scene
        chosen = numbers.tolist()
        names = [own.obstacle_names[k] for k in chosen]
        scene = with_obstacles(own, [own.obstacles[k] for k in chosen], names)
        return scene if bounds is None else with_bounds(scene, bounds)


class KnownPart:
    """Obstacles of a scene in memory that have been needed so far."""

    def __init__(self, ground: SceneGround) -> None:
        self.ground, self.radius = ground, ground.radius
        self.numbers: set[int] = set()

    @property
    def scene(self) -> Scene:
        """Scene with the known obstacles."""
        return self.ground.part(np.array(sorted(self.numbers), np.int64), None)

    def add_around(self, path: Path, margin: float = 0.0) -> bool:
        """Add obstacles that the robot may touch on a path, or within a margin of it; False if all were known."""
        check_length(path, self.radius)
        points = path.sample(self.radius).xy
        boxes = np.concatenate([points, points], axis=1)
        near = set(self.ground.around(boxes, 2 * self.radius).tolist())
        if near <= self.numbers:
            return False
        self.numbers |= near | set(self.ground.around(boxes, 2 * self.radius + margin).tolist())
        return True


def ground_of(planner: PosePlanner) -> SceneGround:
    """Obstacles of a planner's scene, looked up for as long as there is the planner."""
    if planner not in _GROUNDS:
        _GROUNDS[planner] = SceneGround(planner.scene)
    return _GROUNDS[planner]


def path_around(ground: SceneGround, start: Pose, goal: Pose, options: Options) -> Path | None:
    """Path among all obstacles, planned among those near it; None if there is none, or that does not decide."""
    known = KnownPart(ground)
    way: Sequence[Pose] | None = None
    try:
        if is_distant(start, goal, ground.radius):
            legs = legs_along(ground.atlas, start, goal, options, lambda: proof_at_ends(known, start, goal))
            if isinstance(legs, Separated):
                return None
            if legs is not None:
                path, numbers = joined(start, legs, ground)
                if options.vehicle is None:
                    return replace(renumbered(path, numbers), scene=ground.scene)
                known.numbers = set(numbers)
                known.add_around(path, MARGIN * ground.radius)
                way = None if has_slides(path) else path.poses
        answer = plan_around(known, start, goal, options, way)
    except IncompleteError:
        return None
    if not isinstance(answer, Path):
        return None
    return replace(renumbered(answer, sorted(known.numbers)), scene=ground.scene)


def edges_of(polygons: Sequence[Polygon]) -> Floats:
    """Boxes around all edges, (n, 4), rounded.

    Examples
    --------
    >>> edges_of([Polygon([(0, 0), (2, 0), (1, 3)])]).tolist()
    [[0.0, 0.0, 2.0, 0.0], [1.0, 0.0, 2.0, 3.0], [0.0, 0.0, 1.0, 3.0]]
    """
    boxes, end = np.empty((sum(map(len, polygons)), 4)), 0
    for polygon in polygons:
        a = polygon._handle.vertices  # not kept in memory
        after = np.arange(1, len(a) + 1)
        offsets = np.array(polygon._handle.ring_offsets)
        after[offsets[1:] - 1] = offsets[:-1]
        begin, end = end, end + len(a)
        np.minimum(a, a[after], out=boxes[begin:end, :2])
        np.maximum(a, a[after], out=boxes[begin:end, 2:])
    return boxes
