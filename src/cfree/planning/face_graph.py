"""Which trapezoids a path along the boundary of a cell crosses: the shortest way over common sides, in doubles.

Nothing is decided here: `boundary_walk` makes poses of it, exactly. Where a cell has several closed surfaces, free
segments link them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cfree._core as _core
from cfree.exact.pose import Pose

if TYPE_CHECKING:
    from cfree.free.space import FreeSpace

UPPER, LAST, LOWER = 1, 2, 3


Place = tuple[float, float, float]


def place_of(pose: Pose) -> Place:
    """Its x, y, theta."""
    return float(pose.x), float(pose.y), pose.theta


@dataclass(frozen=True)
class Landing:
    """A free way to a pose on a face, strictly between its first and last orientation, or to `FAR`."""

    face: int
    way: tuple[Pose, ...]

    @property
    def pose(self) -> Pose:
        """Where it ends."""
        return self.way[-1]

    @property
    def place(self) -> Place:
        """Its x, y, theta."""
        return place_of(self.pose)


@dataclass(frozen=True)
class Link:
    """From one landing to another: the first one's way backwards, then the second one's."""

    ends: tuple[Landing, Landing]


class Corridors:
    """Shortest ways over the faces of a free space.

    Notes
    -----
    Lengths are travel plus `angle_scale` times turning between the middles of sides. A search takes O(H log H) time in
    the number H of sides.
    """

    def __init__(self, space: FreeSpace, angle_scale: float) -> None:
        self.angle_scale = angle_scale
        self._core = _core.FaceGraph(space.surfaces.core_complex, angle_scale)

    def shortest(
        self, start: Place, starts: list[Landing], goal: Place, goals: list[Landing], links: list[Link]
    ) -> list[tuple[int, int]]:
        """Coedges to leave faces by, from a place over one of the starts, and one of the goals, to another place.

        Returns
        -------
        list of (face, coedge)
            A face, and by which coedge it is left. From H on they stand for links, H + 2 k for the first end of link k,
            H + 2 k + 1 for the second; after them comes the end of the way. Empty if there is no way.
        """
        ends = [end for link in links for end in link.ends]
        first, last, between = ([(x.face, x.place) for x in marks] for marks in (starts, goals, ends))
        return self._core.shortest(start, first, goal, last, between)
