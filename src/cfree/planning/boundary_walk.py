"""A path on the boundary of a cell, made of translations and rotations that are proved free.

A trapezoid's lines of constant theta are translations, its lines of constant t rotations about the point of contact;
steps along them are free because the trapezoid is part of the boundary. They are taken where nothing better is: poses
off the contact, by half of the room there, are joined by one motion where that is free. docs/theory/paths.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

from cfree.collision.motion_checker import MotionChecker
from cfree.collision.slide import Slide
from cfree.errors import InvariantError
from cfree.exact.pose import Pose
from cfree.free.space import surfaces_with_slits
from cfree.planning.departures import Departures
from cfree.planning.exact_face import FAR, FINEST, Faces, Sheet, between, common_part, common_tau, rotated
from cfree.planning.face_graph import LAST, LOWER, UPPER, Corridors, Landing, Link, place_of
from cfree.planning.landing import Landings

if TYPE_CHECKING:
    from cfree.free.space import FreeSpace

MOST_HALVINGS = 4096  # more than any scene needs
SLID = 48  # halvings after which slides along a trapezoid's curves are tried as well
REFINED = 8  # steps towards a critical angle before it is known better


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
        self.corridors = Corridors(space, angle_scale)
        self.faces = Faces(space)
        self.departures = Departures(self.faces, checker, slides)
        self.landings = Landings(self.departures, Fraction(angle_scale))

    @cached_property
    def with_slits(self) -> Walker | None:
        """On closed surfaces with slits of no width, where bounds leave such."""
        space = surfaces_with_slits(self.space.boundary)
        return Walker(space, self.checker, self.corridors.angle_scale, self.departures.slides) if space else None

    # --- on one sheet ---

    def along(self, sheet: Sheet, first: Fraction, last: Fraction) -> Iterator[Pose]:
        """From off the middle at one orientation to the same at another; without the first pose."""
        stack = [(first, last, 0)]
        while stack:
            tau, to, depth = stack.pop()
            t, end = sheet.middle(tau), sheet.middle(to)
            p, q = self.landings.off(sheet, t, tau), self.landings.off(sheet, end, to)
            C, D = sheet.pose(t, tau), sheet.pose(end, to)
            turned, slid = sheet.turned(t, tau, to), sheet.pose(end, tau)
            ways = [[p, q], [p, C, turned, D, q], [p, C, slid, sheet.turned(end, tau, to), q]]
            way = self.checker.first_free(ways) or (self._along_curve(sheet, tau, to) if depth > SLID else None)
            if way is not None:
                yield from way[1:]
            elif depth == MOST_HALVINGS:
                raise InvariantError(f"no way along trapezoid {sheet.face}", state=(first, last))
            else:
                middle = between(min(tau, to), max(tau, to))
                stack += [(middle, to, depth + 1), (tau, middle, depth + 1)]

    def _along_curve(self, sheet: Sheet, tau: Fraction, to: Fraction) -> Sequence[Pose] | None:
        """The same by a slide: always on the trapezoid."""
        for code, t, end in zip(sheet.codes, sheet.limits(tau), sheet.limits(to), strict=True):
            on, last = sheet.pose(t, tau), sheet.pose(end, to)
            if self.departures.along_curve(on, last, sheet, code):
                p, q = sheet.middle(tau), sheet.middle(to)
                head = self.landings.off(sheet, p, tau), sheet.pose(p, tau)
                tail = sheet.pose(q, to), self.landings.off(sheet, q, to)
                return [*head, on, last, *tail]
        return None

    # --- from sheet to sheet ---

    def over_curve(self, f: Sheet, g: Sheet, tau: Fraction, side: int) -> Sequence[Pose]:
        """A way from beside the middle of one trapezoid to beside the middle of the other, over their common curve."""
        t, end = f.middle(tau), g.middle(tau)
        p, q = self.landings.off(f, t, tau), self.landings.off(g, end, tau)
        corner = f.pose(f.limits(tau)[side], tau)
        way = self.checker.first_free([[p, q], [p, f.pose(t, tau), corner, g.pose(end, tau), q]])
        if way is None:
            raise InvariantError(f"no way from trapezoid {f.face} to {g.face}", state=tau)
        return way

    def over_angle(self, f: Sheet, g: Sheet, h: int, tau: Fraction) -> tuple[Fraction, Sequence[Pose], Fraction]:
        """A way from beside one trapezoid at tau to beside the middle of the other, over a critical angle."""
        cells = self.space.complex
        at_end = [bool(cells.side[k] == LAST) for k in (h, int(cells.twin[h]))]
        found = self.across(f, g, at_end, [tau, between(g.low, g.high)])
        if found is None:
            raise InvariantError(f"no way from trapezoid {f.face} to {g.face}", state=tau)
        return found

    def across(
        self, f: Sheet, g: Sheet, at_end: Sequence[bool], aims: list[Fraction], most: int = MOST_HALVINGS
    ) -> tuple[Fraction, Sequence[Pose], Fraction] | None:
        """The same over the last or the first angle of each, nearer and nearer to it."""
        for k in range(most):
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
            p, q = self.landings.off(f, t, sigma), self.landings.off(g, s, tau)
            turned = rotated(C, f.contact_point(t), D.tau)
            way = self.checker.first_free([[p, q], [p, C, turned, D, q], [p, C, turned, q], [p, C, D, q]])
            if way is not None:
                m, n = f.middle(sigma), g.middle(tau)
                begin, end = self.landings.off(f, m, sigma), self.landings.off(g, n, tau)
                head = self.checker.first_free([[begin, p], [begin, f.pose(m, sigma), C, p]])
                tail = self.checker.first_free([[q, end], [q, D, g.pose(n, tau), end]])
                assert head and tail
                return sigma, [*head[1:-1], *way[:-1], *tail], tau
        return None

    # --- the whole way ---

    def walk(self, start: Pose, goal: Pose, cell: int) -> list[Pose]:
        """Poses from the start to the goal, both in the cell or on its boundary; the motions between them are free.

        Raises
        ------
        InvariantError
            If none is found, a fault of cfree.
        """
        if len(self.space.component) == 0:
            return [start, _turned(start, goal), goal]
        landings, takeoffs = self.landings.of(start, cell), self.landings.of(goal, cell)
        links = self.landings.links(cell)
        way = self.corridors.shortest(place_of(start), landings, place_of(goal), takeoffs, links)
        if not way:
            raise InvariantError(f"no way in cell {cell}", state=(start, goal))
        first = next(x for x in landings if x.face == way[0][0])
        last = next(x for x in takeoffs if x.face == way[-1][0])
        poses = [start, *self._realized(way, links, first, last), goal]
        return [a for k, a in enumerate(poses) if k == 0 or a != poses[k - 1]]

    def _realized(self, way: list[tuple[int, int]], links: list[Link], first: Landing, last: Landing) -> Iterator[Pose]:
        """From one landing to another, both ways included."""
        base = len(self.space.complex.face)
        ends = [end for link in links for end in link.ends]
        entered: Landing | None = first  # None: over a side, and now off the middle
        tau = Fraction(0)
        for k, (face, h) in enumerate(way):
            left = last if k + 1 == len(way) else ends[h - base] if h >= base else None
            if entered:
                yield from entered.way
            if face == FAR:
                assert entered and left
                yield _turned(entered.pose, left.pose)
            else:
                f = self.faces.sheet(face)
                if entered:
                    tau = entered.pose.chart[1]
                    yield from (f.pose(f.middle(tau), tau), self.landings.off(f, f.middle(tau), tau))
                if left:
                    end = left.pose.chart[1]
                    yield from (*self.along(f, tau, end), f.pose(f.middle(end), end))
                else:
                    end, steps, after = self._over(f, self.faces.sheet(way[k + 1][0]), h, tau)
                    yield from (*self.along(f, tau, end), *steps)
                    tau = after
            if left:
                yield from left.way[::-1]
            entered = ends[(h - base) ^ 1] if h >= base and k + 1 < len(way) else None

    def _over(self, f: Sheet, g: Sheet, h: int, tau: Fraction) -> tuple[Fraction, Sequence[Pose], Fraction]:
        """Over a side of f to g: at which orientation, poses up to off the middle of g, and the orientation there."""
        cells = self.space.complex
        if cells.side[h] in (LOWER, UPPER):
            end = common_tau(f, g)
            return end, self.over_curve(f, g, end, int(cells.side[h] == UPPER))[1:], end
        return self.over_angle(f, g, h, tau)


def _nearer(tau: Fraction, end: Fraction, halvings: int) -> Fraction:
    """A simple tau between one and an end: nearer to that."""
    tau = end + (tau - end) / 2 ** (halvings - 1)
    return between(min(tau, end), max(tau, end))


def _turned(pose: Pose, to: Pose) -> Pose:
    """In the same place, with the other's orientation."""
    return Pose(pose.x, pose.y, {"tau": to.tau})
