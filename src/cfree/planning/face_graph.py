"""Which trapezoids a path along the boundary of a cell crosses: the shortest way over common sides, in doubles.

Nothing is decided here: `boundary_walk` makes poses of it, exactly. Where a cell has several closed surfaces, free
segments link them.
"""

from __future__ import annotations

import heapq
import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from cfree.exact.pose import Pose
from cfree.forbidden.columns import Floats
from cfree.planning.exact_face import FAR

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
        self.space = space
        self.angle_scale = angle_scale

    @cached_property
    def middles(self) -> Floats:
        """(H, 3) places x, y, theta in the middle of coedges."""
        surfaces, cells = self.space.surfaces, self.space.complex
        table = surfaces.trapezoids
        start = np.arange(len(cells.face))
        stop = np.where(np.isin(start + 1, cells.first), cells.first[cells.face], start + 1)
        a, b = cells.vertex[start], cells.vertex[stop]
        xy = np.stack((cells.x[a] + cells.x[b], cells.y[a] + cells.y[b]), axis=1) / 2
        low, high = table.theta_from[cells.face], table.theta_to[cells.face]
        ends = [np.clip(_within_half_turn(cells.theta[v], (low + high) / 2), low, high) for v in (a, b)]
        theta = np.where(cells.side == 0, low, np.where(cells.side == LAST, high, (ends[0] + ends[1]) / 2))
        on_curve = np.flatnonzero((cells.side == LOWER) | (cells.side == UPPER))
        lower, upper = surfaces.limits(cells.face[on_curve], theta[on_curve])
        t = np.where(cells.side[on_curve] == LOWER, lower, upper)
        xy[on_curve] = surfaces.evaluate(table.patch[cells.face[on_curve]], t, theta[on_curve])
        return np.column_stack((xy, theta))

    def shortest(
        self, start: Place, starts: list[Landing], goal: Place, goals: list[Landing], links: list[Link]
    ) -> list[tuple[int, int]] | None:
        """Coedges to leave faces by, from a place over one of the starts, and one of the goals, to another place.

        Returns
        -------
        list of (face, coedge)
            A face, and by which coedge it is left. From H on they stand for links, H + 2 k for the first end of link k,
            H + 2 k + 1 for the second; after them comes the end of the way. None if there is no way.

        Notes
        -----
        A*: what is left is at least as long as the straight way.
        """
        first, twin, face_of, middles = self._lists
        base = len(face_of)
        ends = [end for link in links for end in link.ends]
        places = [*middles, *(end.place for end in ends), goal]
        x, y, theta = np.array(places).T
        turn = np.abs(np.remainder(theta - goal[2] + np.pi, math.tau) - np.pi)
        left = (np.hypot(x - goal[0], y - goal[1]) + self.angle_scale * turn).tolist()
        at_face: dict[int, list[int]] = {}
        for k, end in enumerate(ends):
            at_face.setdefault(end.face, []).append(base + k)
        at_goal: dict[int, list[Place]] = {}
        for landing in goals:
            at_goal.setdefault(landing.face, []).append(landing.place)
        last = len(places) - 1
        came: dict[int, tuple[int, int]] = {}  # the coedge before, and the face after that
        heap: list[tuple[float, float, int, int, int]] = []

        def relax(cost: float, face: int, at: Place, before: int) -> None:
            sides = range(first[face], first[face + 1]) if face != FAR else ()
            for h in (*sides, *at_face.get(face, ())):
                if h not in came:
                    there = cost + self.apart(at, places[h])
                    heapq.heappush(heap, (there + left[h], there, h, before, face))
            for place in at_goal.get(face, ()):
                there = cost + self.apart(at, place) + self.apart(place, goal)
                heapq.heappush(heap, (there, there, last, before, face))

        for landing in starts:
            relax(self.apart(start, landing.place), landing.face, landing.place, -1)
        while heap:
            _, cost, h, before, face = heapq.heappop(heap)
            if h in came:
                continue
            came[h] = before, face
            if h == last:
                way = []
                while h >= 0:
                    before, face = came[h]
                    way.append((face, h))
                    h = before
                return way[::-1]
            if h < base:
                came[twin[h]] = before, face
                relax(cost, face_of[twin[h]], places[h], h)
            else:
                other = base + ((h - base) ^ 1)
                relax(cost + self.apart(places[h], places[other]), ends[other - base].face, places[other], h)
        return None

    @cached_property
    def _lists(self) -> tuple[list[int], list[int], list[int], list[Place]]:
        """Of the complex: first, twin, face; and the middles."""
        cells = self.space.complex
        return cells.first.tolist(), cells.twin.tolist(), cells.face.tolist(), [*map(tuple, self.middles.tolist())]

    def apart(self, a: Place, b: Place) -> float:
        """Length of the way between two places."""
        turn = math.remainder(b[2] - a[2], math.tau)
        return math.hypot(b[0] - a[0], b[1] - a[1]) + self.angle_scale * abs(turn)


def _within_half_turn(theta: Floats, to: Floats) -> Floats:
    """The same angles within half a turn of others."""
    near: Floats = theta + math.tau * np.round((to - theta) / math.tau)
    return near
