"""Plan in a scene that is too large to be read, with the obstacles near the paths found so far.

A separating surface among some of the obstacles separates two poses among all. A path among some is one among all if
all obstacles near it are included. So obstacles are added along the paths that are found, until one of the two is
certain.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.distributed.tasks import Work
from cfree.distributed.tiles import BoxIndex
from cfree.errors import UndecidedError
from cfree.exact.pose import Pose
from cfree.paths.path import Path
from cfree.planning.plan import plan
from cfree.planning.proof import Proof
from cfree.scene.digest import Whole
from cfree.scene.scene import Scene

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


def plan_among(known: Surroundings, start: Pose, goal: Pose, **wishes: Any) -> Path | Proof:
    """Path or proof, whose scene has the obstacles that it is about; `wishes` are options of `cfree.plan`."""
    for end in (start, goal):
        known.add_around(Path(end, []), MARGIN * known.work.store.radius)
    for wish in ({"improve": 0.0}, wishes):
        margin = MARGIN * known.work.store.radius
        while True:
            try:
                answer = plan(known.scene, start, goal, **wishes | wish)
            except UndecidedError as error:  # a vehicle needs too many manoeuvres on a path, if that is free among all
                if isinstance(error.path, Path) and known.add_around(error.path, margin):
                    margin *= WIDER
                    continue
                raise
            if isinstance(answer, Proof):  # further obstacles do not change that
                return replace(answer, whole=known.whole)
            assert isinstance(answer, Path)
            if not known.add_around(answer, margin):
                break
            margin *= WIDER
    assert isinstance(answer, Path)
    return replace(answer, whole=known.whole)
