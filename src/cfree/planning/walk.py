"""A path on the boundary of a cell, made of translations and rotations that are proved free.

A trapezoid's lines of constant theta are translations, its lines of constant t rotations about the point of contact;
steps along them are free because the trapezoid is part of the boundary. They are taken where nothing better is: poses
off the contact, by half of the room there, are joined by one motion where that is free. docs/theory.md, "Paths".
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from cfree.errors import InvariantError, UnsupportedError
from cfree.motion import Translation
from cfree.motion_check import MotionChecker
from cfree.planning.corridor import FAR, LAST, LOWER, UPPER, Corridors, Landing, Link, place_of
from cfree.planning.exits import Exits
from cfree.planning.sheet import FINEST, Sheet, Vector, between, common_part, rotated
from cfree.pose import Pose
from cfree.slide import Slide

if TYPE_CHECKING:
    from cfree.cells import FreeSpace

FARTHEST = 2.0**40  # from the origin, in extents, that doubles still tell places apart
MOST_HALVINGS = 200
MOST_TURNS = 30  # halvings of a radian, where a turn may leave
REFINED = 8  # steps towards a critical angle before it is known better
RAYS = 3  # from each closed surface, where one would do if doubles saw all that it crosses
DIRECTIONS = ((1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1))


class Walker:
    """Paths along the boundaries of the cells of a free space.

    Parameters
    ----------
    slides : dict
        The slides found are added to it, by the poses that they join; `motion_between` joins all others.
    """

    def __init__(
        self, space: FreeSpace, checker: MotionChecker, angle_scale: float, slides: dict[tuple[Pose, Pose], Slide]
    ) -> None:
        self.space = space
        self.checker = checker
        self.slides = slides
        self.corridors = Corridors(space, angle_scale)
        self.reach = Fraction(angle_scale)
        self.exits = Exits(self)
        self._links: dict[int, list[Link]] = {}

    def room(self, pose: Pose, direction: Vector) -> Fraction:
        """A share of the direction, at most 1, as far as a translation is free."""
        found = self.checker.first_contact(pose, Translation(direction))
        return Fraction(1) if found is None else found.at.p

    def _sheet(self, face: int) -> Sheet:
        return Sheet(self.space.walls, face, self.space.angle)

    # --- on one sheet ---

    def off(self, sheet: Sheet, t: Fraction, tau: Fraction) -> Pose:
        """Half way from the contact at (t, tau) to the next."""
        pose, (x, y) = sheet.pose(t, tau), sheet.away(tau)
        longest = self.reach / (abs(x) + abs(y))
        direction = x * longest, y * longest
        room = self.room(pose, direction)
        share = between(room / 4, 3 * room / 4) if room else room
        return Pose(pose.x + share * direction[0], pose.y + share * direction[1], {"tau": pose.tau})

    def along(self, sheet: Sheet, first: Fraction, last: Fraction) -> Iterator[Pose]:
        """From off the middle at one orientation to the same at another; without the first pose."""
        stack = [(first, last, 0)]
        while stack:
            tau, to, depth = stack.pop()
            t, end = sheet.middle(tau), sheet.middle(to)
            p, q = self.off(sheet, t, tau), self.off(sheet, end, to)
            C, D = sheet.pose(t, tau), sheet.pose(end, to)
            turned = rotated(C, sheet.contact_point(t), D.tau)
            slid = sheet.pose(end, tau)
            slid_off = rotated(slid, sheet.contact_point(end), D.tau)
            way = self.checker.first_free([[p, q], [p, C, turned, D, q], [p, C, slid, slid_off, q]])
            if way is not None:
                yield from way[1:]
            elif depth == MOST_HALVINGS:
                raise InvariantError(f"no way along trapezoid {sheet.face}", state=(first, last))
            else:
                middle = between(min(tau, to), max(tau, to))
                stack += [(middle, to, depth + 1), (tau, middle, depth + 1)]

    # --- from sheet to sheet ---

    def over_curve(self, f: Sheet, g: Sheet, tau: Fraction, side: int) -> Sequence[Pose]:
        """From off the middle of one to off the middle of the other, over a curve that they share."""
        t, end = f.middle(tau), g.middle(tau)
        p, q = self.off(f, t, tau), self.off(g, end, tau)
        corner = f.pose(f.limits(tau)[side], tau)
        way = self.checker.first_free([[p, q], [p, f.pose(t, tau), corner, g.pose(end, tau), q]])
        if way is None:
            raise InvariantError(f"no way from trapezoid {f.face} to {g.face}", state=tau)
        return way

    def over_wall(self, f: Sheet, g: Sheet, h: int, tau: Fraction) -> tuple[Fraction, Sequence[Pose], Fraction]:
        """From off the middle of one to off that of the other, over a critical angle; the first is at tau now."""
        cells = self.space.complex
        at_end = [bool(cells.side[k] == LAST) for k in (h, int(cells.twin[h]))]
        aims = [tau, between(g.low, g.high)]
        for k in range(MOST_HALVINGS):
            if k % REFINED == REFINED - 1:
                f.refine(FINEST + 4 * k)
                g.refine(FINEST + 4 * k)
            ends = [s.high if end else s.low for s, end in zip((f, g), at_end, strict=True)]
            aims = [_nearer(a, end, 1 + k // REFINED) for a, end in zip(aims, ends, strict=True)]
            sigma, tau = aims
            if (places := common_part(f, sigma, g, tau)) is None:
                continue
            t, s = places
            C, D = f.pose(t, sigma), g.pose(s, tau)
            p, q = self.off(f, t, sigma), self.off(g, s, tau)
            turned = rotated(C, f.contact_point(t), D.tau)
            way = self.checker.first_free([[p, q], [p, C, turned, D, q], [p, C, turned, q], [p, C, D, q]])
            if way is not None:
                m, n = f.middle(sigma), g.middle(tau)
                begin, end = self.off(f, m, sigma), self.off(g, n, tau)
                head = self.checker.first_free([[begin, p], [begin, f.pose(m, sigma), C, p]])
                tail = self.checker.first_free([[q, end], [q, D, g.pose(n, tau), end]])
                assert head and tail
                return sigma, [*head[1:-1], *way[:-1], *tail], tau
        raise InvariantError(f"no way from trapezoid {f.face} to {g.face}", state=aims)

    # --- the whole way ---

    def walk(self, start: Pose, goal: Pose, cell: int) -> list[Pose]:
        """Poses from the start to the goal, both in the cell or on its boundary; the motions between them are free.

        Raises
        ------
        UnsupportedError
            If the scene is so far from the origin that doubles do not tell its places apart; or if an end is in
            contacts that no translation or rotation was found to leave.
        InvariantError
            If none is found, a fault of cfree.
        """
        if len(self.space.component) == 0:
            return [start, _turned(start, goal), goal]
        if self._farthest > FARTHEST * float(self._extent):
            raise UnsupportedError("the scene is 2**40 times its size from the origin: move it there")
        head, landings = self.leave(start, cell)
        tail, takeoffs = self.leave(goal, cell)
        links = self.links(cell)
        way = self.corridors.shortest(place_of(head[-1]), landings, place_of(tail[-1]), takeoffs, links)
        if way is None:
            raise InvariantError(f"no way in cell {cell}", state=(start, goal))
        first = next(x for x in landings if x.face == way[0][0])
        last = next(x for x in takeoffs if x.face == way[-1][0])
        poses = [*head, *self._realized(way, links, first, last), *tail[::-1]]
        return [a for k, a in enumerate(poses) if k == 0 or a != poses[k - 1]]

    def _realized(self, way: list[tuple[int, int]], links: list[Link], first: Landing, last: Landing) -> Iterator[Pose]:
        """From a pose on the first face to one on the last."""
        base = len(self.space.complex.face)
        ends = [end for link in links for end in link.ends]
        entered: Landing | None = first  # None: over a side, and now off the middle
        tau = Fraction(0)
        for k, (face, h) in enumerate(way):
            left = last if k + 1 == len(way) else ends[h - base] if h >= base else None
            if face == FAR:
                assert entered and left
                yield from (entered.pose, _turned(entered.pose, left.pose), left.pose)
            else:
                f = self._sheet(face)
                if entered:
                    tau = entered.pose.chart[1]
                    yield from (entered.pose, f.pose(f.middle(tau), tau), self.off(f, f.middle(tau), tau))
                if left:
                    end = left.pose.chart[1]
                    yield from (*self.along(f, tau, end), f.pose(f.middle(end), end), left.pose)
                else:
                    end, steps, after = self._over(f, self._sheet(way[k + 1][0]), h, tau)
                    yield from (*self.along(f, tau, end), *steps)
                    tau = after
            entered = None
            if h >= base and k + 1 < len(way):
                yield from links[(h - base) // 2].between[:: -1 if h - base & 1 else 1]
                entered = ends[(h - base) ^ 1]

    def _over(self, f: Sheet, g: Sheet, h: int, tau: Fraction) -> tuple[Fraction, Sequence[Pose], Fraction]:
        """Over a side of f to g: at which orientation, poses up to off the middle of g, and the orientation there."""
        cells = self.space.complex
        if cells.side[h] in (LOWER, UPPER):
            bits = FINEST
            while max(f.low, g.low) >= min(f.high, g.high):
                bits *= 2
                f.refine(bits)
                g.refine(bits)
            end = between(max(f.low, g.low), min(f.high, g.high))
            return end, self.over_curve(f, g, end, int(cells.side[h] == UPPER))[1:], end
        return self.over_wall(f, g, h, tau)

    def leave(self, pose: Pose, cell: int) -> tuple[Sequence[Pose], list[Landing]]:
        """From a pose to one in the interior of the cell from which straight ways lead well within faces, and these."""
        for k in range(3, MOST_TURNS, 2):
            for by in (Fraction(1, 2**k), -Fraction(1, 2**k)):
                turned = _turned(pose, pose @ Pose(0, 0, {"tau": by}))
                is_inside = self.checker.joins([pose, turned]) and self.space.locate(turned) == cell
                if is_inside and (landings := self.landings(turned, cell)):
                    return [pose, turned], landings
        way = self.exits.of(pose).get(cell)
        if way is None:
            x, y, theta = place_of(pose)
            place = f"({x:g}, {y:g}, {math.degrees(theta):g} deg)"
            raise UnsupportedError(f"no motion was found that leaves {place}; start beside it")
        return way, self.landings(way[-1], cell)

    def landings(self, pose: Pose, cell: int) -> list[Landing]:
        """Where straight ways from a pose lead to that is on the boundary of a cell."""
        found = filter(None, (self._landing(pose, x, y) for x, y in DIRECTIONS))
        return [landing for landing in found if self._cell_at(landing.face) == cell]

    def _cell_at(self, face: int) -> int:
        return self.space.outside if face == FAR else int(self.space.cell_of[self.space.component[face]])

    def _landing(self, pose: Pose, x: int, y: int) -> Landing | None:
        """Where a straight way leads to, if it is well within a face or far away; a way far away is one to the left."""
        direction = x * self._extent, y * self._extent
        contact = self.checker.first_contact(pose, Translation(direction))
        if contact is None:
            far = Pose(self._far, pose.y, {"tau": pose.tau})
            return Landing(FAR, far) if y == 0 and x < 0 and self.checker.joins([pose, far]) else None
        there = Pose(pose.x + contact.at.p * direction[0], pose.y + contact.at.p * direction[1], {"tau": pose.tau})
        faces = (face for face in self.corridors.near(there) if self._sheet(face).holds(there))
        return next((Landing(face, there) for face in faces), None)

    @cached_property
    def _extent(self) -> Fraction:
        xs, ys = self.space.complex.x, self.space.complex.y
        return Fraction(float(2 * (np.ptp(xs) + np.ptp(ys)))) + 2 * self.reach

    @cached_property
    def _farthest(self) -> float:
        """From the origin, of positions on the boundary."""
        return float(max(np.abs(self.space.complex.x).max(), np.abs(self.space.complex.y).max()))

    @cached_property
    def _far(self) -> Fraction:
        return Fraction(float(self.space.complex.x.min())) - 2 * self.reach

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
            self._links[cell] = [link for component in components for link in self._links_of(component)]
        return self._links[cell]

    def _links_of(self, component: int) -> Iterator[Link]:
        table = self.space.walls.trapezoids
        faces = np.flatnonzero((self.space.component == component) & self.corridors.open)
        for face in faces[np.argsort(-(table.tau_to - table.tau_from)[faces], kind="stable")[:RAYS]].tolist():
            f = self._sheet(face)
            tau = between(f.low, f.high)
            while self.corridors.may_be_critical(f.chart, tau):
                tau = (tau + f.high) / 2
            pose = self.off(f, f.middle(tau), tau)
            if left := self._landing(pose, -1, 0):
                yield Link((Landing(face, f.pose(f.middle(tau), tau)), left), (pose,))
            for x, other in pairwise([*self.corridors.crossings(pose).tolist(), float(self._far)]):
                middle = Pose((x + other) / 2, pose.y, {"tau": pose.tau})
                if self.checker.joins([middle, middle]):
                    first, last = self._landing(middle, 1, 0), self._landing(middle, -1, 0)
                    if first and last:
                        yield Link((first, last))


def _nearer(tau: Fraction, end: Fraction, halvings: int) -> Fraction:
    """A simple tau between one and an end: nearer to that."""
    tau = end + (tau - end) / 2 ** (halvings - 1)
    return between(min(tau, end), max(tau, end))


def _turned(pose: Pose, to: Pose) -> Pose:
    """In the same place, with the other's orientation."""
    return Pose(pose.x, pose.y, {"tau": to.tau})
