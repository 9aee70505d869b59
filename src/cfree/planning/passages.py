"""Ways through exact fits: contact motions between cells, where free space is too thin for any clearance.

C_free is closed. Its closed surfaces may touch at pinches, and its isolated parts are free without being in any cell.
Poses there are found by doubles, made exact from the contacts they are in, and every motion through them is checked
exactly. So a way that is found is a proof; that none is found says nothing: `separated` has the proofs of that.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from cfree.cells import NO_CELL
from cfree.exact import simplest_between
from cfree.features import BOUNDS
from cfree.half_angle import chart_of, tau_in_chart
from cfree.planning.exits import NEAR, Way
from cfree.planning.search import simple_ways
from cfree.planning.sheet import Sheet, between, contact_line, cross, minus, positions
from cfree.pose import Pose
from cfree.trapezoids import CURVE

if TYPE_CHECKING:
    from cfree.planning.walk import Walker

BEYOND = (6, 12, 20, 30)  # halvings of a radian: how far beyond the ends of a curve


class Passages:
    """Ways between cells, and from poses in no cell, through exact fits.

    Parameters
    ----------
    walker : Walker
        Of the free space.
    """

    def __init__(self, walker: Walker) -> None:
        self.walker = walker
        self.space = walker.space
        self.exits = walker.exits

    def path(self, start: Pose, goal: Pose) -> Way | None:
        """Poses from start to goal, or None if no way was found: the fewest cells first."""
        came: dict[int | Pose, tuple[int | Pose, Way]] = {start: (start, [start])}
        queue: deque[int | Pose] = deque([start])
        while queue:
            node = queue.popleft()
            for other, way in self._ways(node, goal):
                if other not in came:
                    came[other] = node, way
                    queue.append(other)
                if other == goal:
                    return self._joined(came, goal)
        return None

    def _joined(self, came: dict[int | Pose, tuple[int | Pose, Way]], goal: Pose) -> Way:
        """Ways into cells and out of them, joined by walks inside."""
        ways = []
        node: int | Pose = goal
        while came[node][0] != node:
            node, way = came[node][0], came[node][1]
            ways.append((node, way))
        path: Way = []
        for node, way in reversed(ways):
            if isinstance(node, int):
                path += self.walker.walk(path[-1], way[0], node)
            path += way
        return path

    def _ways(self, node: int | Pose, goal: Pose) -> Iterator[tuple[int | Pose, Way]]:
        """From a cell to poses on its boundary, or from a pose to cells and to poses in the same thin part."""
        poses = [goal, *self.places]
        if isinstance(node, int):
            for pose in poses:
                if node in (ways := self.exits.of(pose)):
                    yield pose, ways[node][::-1]
        else:
            for pose in poses:
                # a segment is one motion; where bounds leave a slit more may be needed
                tried = simple_ways(node, pose) if self._slits else [[node, pose]]
                if pose != node and (way := self.walker.checker.first_free(tried) or self.exits.slid_to(node, pose)):
                    yield pose, list(way)
            yield from self.exits.of(node).items()

    @cached_property
    def places(self) -> list[Pose]:
        """Ends of isolated parts and of slits, poses at which cells touch, where they are rational; poses on curves."""
        places = list(self._pinches())
        for k in range(len(self.space.boundary.isolated)):
            places += self.space.boundary.isolated_part(k).ends
        ends = (pose for place in places for pose in self._exact(*place))
        return list(dict.fromkeys([*ends, *self._on_curves(), *self._slits]))

    def _on_curves(self) -> Iterator[Pose]:
        """A pose well within each isolated curve, and free ones a little beyond its ends, in the same contacts."""
        for k in np.flatnonzero(self.space.boundary.isolated.kind == CURVE).tolist():
            sheet = Sheet(self.space.boundary, k, isolated=True)
            if sheet.low < sheet.high:
                taus = [between(sheet.low, sheet.high)]
                taus += [tau for b in BEYOND for tau in (sheet.low - Fraction(1, 2**b), sheet.high + Fraction(1, 2**b))]
                for tau in taus:
                    try:
                        pose = sheet.pose(sheet.limits(tau)[0], tau)
                    except ZeroDivisionError:  # beyond an end the two lines may be parallel
                        continue
                    if self.walker.checker.joins([pose, pose]):
                        yield pose

    @cached_property
    def _slits(self) -> list[Pose]:
        """Ends, at one orientation each, of trapezoids between bounds and an obstacle, with free space of no width."""
        boundary = self.space.boundary
        if boundary is self.space.walls:
            return []
        found = []
        owner = boundary.features.obstacles.owner_polygon[boundary.contact_obstacle]
        for face in np.flatnonzero(owner[boundary.trapezoids.patch] == BOUNDS).tolist():
            sheet = Sheet(boundary, face)
            if sheet.low < sheet.high:
                tau = between(sheet.low, sheet.high)
                low, high = sheet.limits(tau)
                if self.space.locate(sheet.pose(between(low, high), tau)) == NO_CELL:
                    found += [sheet.pose(t, tau) for t in (low, high)]
        return found

    def _pinches(self) -> Iterator[tuple[float, float, float]]:
        """Vertices where several cells meet, with doubles."""
        cells = self.space.complex
        cell = np.empty(cells.vertices, np.int32)
        cell[cells.vertex] = self.space.cell_of[self.space.component[cells.face]]
        theta = np.mod(cells.theta + NEAR, math.tau)
        rows = np.round(np.column_stack((cells.x / self.exits.size, cells.y / self.exits.size, theta)) / NEAR)
        order = np.lexsort(rows.T)
        groups = np.split(order, np.flatnonzero(np.any(np.diff(rows[order], axis=0) != 0, axis=1)) + 1)
        for group in groups:
            if len(set(cell[group].tolist())) > 1:
                yield float(cells.x[group[0]]), float(cells.y[group[0]]), float(cells.theta[group[0]])

    def _exact(self, x: float, y: float, theta: float) -> Iterator[Pose]:
        """A free pose near a place, fixed by two of the contacts that it may be in."""
        about = Pose(x, y, {"tau": _simple_tau(theta)})
        lines = [positions(contact_line(self.exits.features, *c), about.tau) for c in self.exits.near_contacts(about)]
        for k, (P, u) in enumerate(lines):
            for Q, v in lines[:k]:
                if (d := cross(u, v)) == 0:
                    continue
                t = cross(minus(Q, P), v) / d
                pose = Pose(P[0] + t * u[0], P[1] + t * u[1], {"tau": about.tau})
                if math.hypot(
                    float(pose.x) - x, float(pose.y) - y
                ) <= NEAR * self.exits.size and self.walker.checker.joins([pose, pose]):
                    yield pose
                    return


def _simple_tau(theta: float) -> Fraction | None:
    """The simplest half-angle tangent near an angle."""
    chart, tau = chart_of(np.array([theta % math.tau]))
    t = Fraction(float(tau[0]))
    return tau_in_chart(int(chart[0]), simplest_between(t - Fraction(NEAR), t + Fraction(NEAR)))
