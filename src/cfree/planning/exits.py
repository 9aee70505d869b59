"""Ways off a pose that touches obstacles, into the cells it is on the boundary of.

Short motions are tried that contacts suggest, ever shorter ones, and each is checked exactly. Slides come last.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from cfree.features import SceneFeatures
from cfree.planning.sheet import Vector, contact_line, cross, dot, minus, positions, vertex
from cfree.planning.slides import Contact, slides
from cfree.pose import Pose

if TYPE_CHECKING:
    from cfree.planning.walk import Walker

NEAR = 1e-9  # of the scene's size: which contacts a place in doubles may be in
STEPS = (4, 8, 14, 22, 32, 44)  # halvings of the robot's radius, and of a radian

Ray = tuple[Vector, Vector]  # a point of contact, and the direction of the edge there
Way = list[Pose]


class Exits:
    """Ways off poses in the free space of a walker."""

    def __init__(self, walker: Walker) -> None:
        self.walker = walker
        self.space = walker.space
        self._known: dict[Pose, dict[int, Way]] = {}

    def of(self, pose: Pose) -> dict[int, Way]:
        """Cells that short motions from a pose lead into, with these."""
        if pose not in self._known:
            found: dict[int, Way] = {}
            wanted, contacts = self._cells_near(pose), self._contacts(pose)
            rays = [self._ray(pose, contact) for contact in contacts]
            for sliding, k in product((False, True), STEPS):
                if sliding:
                    firsts = [q for sign in (1, -1) for q in self.slid(pose, contacts, Fraction(sign, 2**k))]
                else:
                    firsts = [q for q in self._moves(pose, rays, k) if self.walker.checker.joins([pose, q])]
                for way in ([pose, q] for q in firsts):
                    self._add(found, way)
                seconds = ([pose, q, p] for q in firsts for p in self._moves(q, rays, k + 3))
                for way in seconds:
                    if wanted <= found.keys():
                        break
                    if self.walker.checker.joins(way[1:]):
                        self._add(found, way)
                if wanted <= found.keys():
                    break
            self._known[pose] = found
        return self._known[pose]

    def slid(self, pose: Pose, contacts: Sequence[Contact], tau: Fraction) -> Iterator[Pose]:
        """Where free slides along two of some contacts lead that turn by this half-angle tangent."""
        for slide in slides(self.features, pose, contacts, tau):
            if self.walker.checker.is_free(pose, slide):
                end = slide.apply(pose)
                self.walker.slides[pose, end] = slide
                yield end

    def slid_to(self, pose: Pose, goal: Pose) -> Way | None:
        """A free slide from a pose to another, along two contacts that both are in."""
        turn = Pose(0, 0, {"tau": goal.tau}) @ Pose(0, 0, {"tau": pose.tau}).inverse()
        common = [contact for contact in self._contacts(pose) if self._misses(goal, contact) == 0]
        if turn.tau and goal in self.slid(pose, common, turn.tau):
            return [pose, goal]
        return None

    def _add(self, found: dict[int, Way], way: Way) -> None:
        """Note the cell that a way ends in."""
        cell = self.space.locate(way[-1])
        if cell >= 0 and cell not in found and self.walker.landings(way[-1], cell):
            found[cell] = way

    def _cells_near(self, pose: Pose) -> set[int]:
        """Cells whose boundary is near, with doubles."""
        corridors, table = self.walker.corridors, self.space.walls.trapezoids
        turns = np.round((0.5 * (table.theta_from + table.theta_to) - pose.theta) / math.tau)
        turned = pose.theta + math.tau * turns
        faces = np.flatnonzero((table.theta_from <= turned + NEAR) & (turned <= table.theta_to + NEAR))
        at = np.clip(turned[faces], table.theta_from[faces], table.theta_to[faces])
        away = corridors.distances(faces.astype(np.int32), at, float(pose.x), float(pose.y))
        near = faces[away <= NEAR * self.size]
        return set(self.space.cell_of[self.space.component[near]].tolist())

    def _moves(self, pose: Pose, rays: Sequence[Ray], halvings: int) -> Iterator[Pose]:
        """Short rotations about where normals of contacts meet, short translations along contacts and off them."""
        small = Fraction(1, 2**halvings)
        for pole in self._poles(pose, rays):
            for sign in (1, -1):
                yield _turned_about(pole, pose, sign * small)
        for x, y in {(Fraction(1), Fraction(0))}.union(*({u, (u[1], -u[0])} for _, u in rays)):
            size = small * self.walker.reach / (abs(x) + abs(y))
            for sign in (1, -1):
                yield Pose(pose.x + sign * size * x, pose.y + sign * size * y, {"tau": pose.tau})

    @staticmethod
    def _poles(pose: Pose, rays: Sequence[Ray]) -> list[Vector]:
        """Where two normals of contacts meet, the reference point, points of contact."""
        poles = []
        for k, (X, u) in enumerate(rays):
            for Y, v in rays[:k]:
                if (d := cross(u, v)) != 0:  # (p - X) . u = (p - Y) . v = 0
                    a, b = dot(X, u), dot(Y, v)
                    poles.append(((a * v[1] - b * u[1]) / d, (u[0] * b - v[0] * a) / d))
        return list(dict.fromkeys([*poles, (pose.x, pose.y), *(X for X, _ in rays)]))

    def _ray(self, pose: Pose, contact: Contact) -> Ray:
        kind, i, j = contact
        A, O, scale = self.features.robot, self.features.obstacles, self.features.scale
        if kind == 1:
            (X,) = pose.apply_exact([vertex(A, i, scale)])
            return X, minus(vertex(O, O.w[j], scale), vertex(O, O.v[j], scale))
        p, q = pose.apply_exact([vertex(A, A.v[i], scale), vertex(A, A.w[i], scale)])
        return vertex(O, j, scale), minus(q, p)

    def _contacts(self, pose: Pose) -> list[Contact]:
        """The features that touch, exactly."""
        return [c for c in self.near_contacts(pose) if self._misses(pose, c) == 0]

    def _misses(self, pose: Pose, contact: Contact) -> Fraction:
        P, U = positions(contact_line(self.features, *contact), pose.tau)
        return cross(U, minus((pose.x, pose.y), P))

    def near_contacts(self, pose: Pose) -> list[Contact]:
        """Features that may touch, with doubles."""
        A, O = self.features.robot, self.features.obstacles
        n, m = len(A.previous), len(O.previous)
        robot, fixed = pose.apply(A.xy), O.xy
        found = []
        for kind, points, shape, corners in ((1, robot[:n], O, fixed), (2, fixed[:m], A, robot)):
            count = len(shape.previous)
            starts, ends = corners[shape.v[:count]], corners[shape.w[:count]]
            U, d = ends - starts, points[:, None] - starts
            squared = (U * U).sum(axis=1)
            t = np.clip((d * U).sum(axis=2) / np.maximum(squared, 1e-300), 0, 1)
            away = np.hypot(*np.moveaxis(d - t[..., None] * U, 2, 0))
            pairs = np.argwhere((away <= NEAR * self.size) & (squared > 0)).tolist()  # the reference point has no edge
            found += [(kind, k, e) if kind == 1 else (kind, e, k) for k, e in pairs]
        return found

    @property
    def features(self) -> SceneFeatures:
        return self.space.boundary.features

    @cached_property
    def size(self) -> float:
        cells = self.space.complex
        widest = [np.abs(xy).max(initial=0) for xy in (self.features.obstacles.xy, self.features.robot.xy)]
        return float(max(*widest, np.abs(cells.x).max(initial=0), np.abs(cells.y).max(initial=0)))


def _turned_about(pole: Vector, pose: Pose, tau: Fraction) -> Pose:
    turn = Pose(0, 0, {"tau": tau})
    ((x, y),) = turn.apply_exact([minus((pose.x, pose.y), pole)])
    return Pose(pole[0] + x, pole[1] + y, {"tau": (turn @ pose).tau})
