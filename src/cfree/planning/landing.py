"""Where a straight way from a pose meets the boundary of its cell, and free segments that link its closed surfaces."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from cfree.collision.motion import Translation
from cfree.exact.pose import Pose
from cfree.planning.departures import Departures
from cfree.planning.exact_face import FAR, Sheet, Vector, between
from cfree.planning.face_graph import Landing, Link

if TYPE_CHECKING:
    from cfree.collision.motion_checker import MotionChecker

DIRECTIONS = ((1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1))


class Landings:
    """Ways from poses in a cell to its boundary.

    Parameters
    ----------
    reach : Fraction
        No point of the robot is farther from its reference point.
    """

    def __init__(self, departures: Departures, reach: Fraction) -> None:
        self.departures = departures
        self.faces = departures.faces
        self.space = departures.faces.space
        self.checker: MotionChecker = departures.checker
        self.reach = reach
        self._links: dict[int, list[Link]] = {}

    def room(self, pose: Pose, direction: Vector) -> Fraction:
        """A share of the direction, at most 1, as far as a translation is free."""
        found = self.checker.first_contact(pose, Translation(direction))
        return Fraction(1) if found is None else found.at.p

    def off(self, sheet: Sheet, t: Fraction, tau: Fraction) -> Pose:
        """Half way from the contact at (t, tau) to the next."""
        pose, (x, y) = sheet.pose(t, tau), sheet.away(tau)
        longest = self.reach / (abs(x) + abs(y))
        direction = x * longest, y * longest
        room = self.room(pose, direction)
        share = between(room / 4, 3 * room / 4) if room else room
        return Pose(pose.x + share * direction[0], pose.y + share * direction[1], {"tau": pose.tau})

    def of(self, pose: Pose, cell: int) -> list[Landing]:
        """Ways from a pose, in a cell or on its boundary, to the boundary."""
        if here := self.departures.of(pose).get(cell):
            return here
        return [landing for x, y in DIRECTIONS for landing in self._straight(pose, x, y, cell)]

    def _straight(self, pose: Pose, x: int, y: int, cell: int) -> list[Landing]:
        """What a straight way leads to; a way far away is one to the left."""
        far = Pose(self._far, pose.y, {"tau": pose.tau})
        is_left = x < 0 and y == 0
        length = max(self._extent, pose.x - far.x) if is_left else self._extent
        contact = self.checker.first_contact(pose, Translation((x * length, y * length)))
        if contact is None:
            return [Landing(FAR, (pose, far))] if is_left and self.checker.joins([pose, far]) else []
        share = contact.at.p * length
        there = Pose(pose.x + share * x, pose.y + share * y, {"tau": pose.tau})
        return [Landing(landing.face, (pose, *landing.way)) for landing in self.departures.of(there).get(cell, ())]

    @cached_property
    def _extent(self) -> Fraction:
        xs, ys = self.space.complex.x, self.space.complex.y
        return Fraction(float(2 * (np.ptp(xs) + np.ptp(ys)))) + 2 * self.reach + self._rounding

    @cached_property
    def _far(self) -> Fraction:
        return Fraction(float(self.space.complex.x.min())) - 2 * self.reach - self._rounding

    @cached_property
    def _rounding(self) -> Fraction:
        """More than doubles are off, of positions on the boundary."""
        return Fraction(float(np.abs([self.space.complex.x, self.space.complex.y]).max())) / 2**40

    def links(self, cell: int) -> list[Link]:
        """Free segments that link all closed surfaces of a cell, and `FAR` if it is unbounded.

        Notes
        -----
        All that lie on one ray towards -x, for each surface but the outer one. The ray leaves the cell and comes back
        over the same surface, as no other bounds that part of the forbidden space from there: so they link its ends.
        """
        if cell not in self._links:
            bounded = self.space.cells[cell].bounded
            components = self.space.cells[cell].components[bounded:]
            self._links[cell] = [link for component in components for link in self._links_of(component, cell)]
        return self._links[cell]

    def _links_of(self, component: int, cell: int) -> Iterator[Link]:
        table = self.space.surfaces.trapezoids
        faces = np.flatnonzero(self.space.component == component)
        f = self.faces.sheet(int(faces[np.argmax((table.tau_to - table.tau_from)[faces])]))
        tau = between(f.low, f.high)
        while True:
            pose = self.off(f, f.middle(tau), tau)
            nearby = self.space.nearby(pose)
            crossed = {self._crossing(face, pose) for face in nearby.crossed}
            if nearby.generic and not nearby.on and None not in crossed:
                break
            tau = between(tau, f.high)
        xs = sorted((x for x in crossed if x is not None), reverse=True)
        middles = [Pose((x + other) / 2, pose.y, {"tau": pose.tau}) for x, other in pairwise([*xs, self._far])]
        landing = Landing(f.face, (pose, f.pose(f.middle(tau), tau)))
        for found in self._straight(pose, -1, 0, cell)[:1]:
            yield Link((landing, found))
        for middle in middles:
            if self.space.locate(middle) == cell:
                right, left = (self._straight(middle, x, 0, cell) for x in (1, -1))
                if right and left:
                    yield Link((right[0], left[0]))

    def _crossing(self, face: int, pose: Pose) -> Fraction | None:
        """Where the line of a trapezoid is at a pose's height and orientation; None if it is level there."""
        f = self.faces.sheet(face)
        (x, y), (u, v) = f.at(f.local(pose))
        return x + (pose.y - y) / v * u if v else None
