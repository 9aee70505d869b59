"""Ways through exact fits: contact motions between cells, where free space is too thin for any clearance.

C_free is closed. Its closed surfaces may touch at pinches, and its isolated parts are free without being in any cell.
Poses there are found by doubles, made exact from the contacts they are in, and every motion through them is checked
exactly. So a way that is found is a proof; that none is found says nothing: `separated` has the proofs of that.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from cfree.exact import simplest_between
from cfree.features import SceneFeatures
from cfree.planning.sheet import Vector, contact_line, cross, dot, minus, positions, vertex
from cfree.pose import Pose, chart_of, tau_in_chart
from cfree.trapezoids import CURVE

if TYPE_CHECKING:
    from cfree.planning.walk import Walker

NEAR = 1e-9  # of the scene's size: which contacts a place in doubles may be in
STEPS = (4, 8, 14, 22, 32, 44)  # halvings of the robot's radius, and of a radian

Contact = tuple[int, int, int]  # kind, robot feature, obstacle feature
Ray = tuple[Vector, Vector]  # a point of contact, and the direction of the edge there
Way = list[Pose]


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
        self._known: dict[Pose, dict[int, Way]] = {}

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
            if goal in came:
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
                if node in (ways := self.exits(pose)):
                    yield pose, ways[node][::-1]
        else:
            yield from self.exits(node).items()
            for pose in poses:
                if pose != node and self.walker.joins([node, pose]):
                    yield pose, [node, pose]

    def exits(self, pose: Pose) -> dict[int, Way]:
        """Cells that short motions from a pose lead into, with these."""
        if pose not in self._known:
            found: dict[int, Way] = {}
            self._known[pose] = found
            wanted = self._cells_near(pose)
            rays = [self._ray(pose, contact) for contact in self._contacts(pose)]
            for k in STEPS:
                firsts = [q for q in self._moves(pose, rays, k) if self.walker.joins([pose, q])]
                for way in ([pose, q] for q in firsts):
                    self._add(found, way)
                seconds = ([pose, q, p] for q in firsts for p in self._moves(q, rays, k + 3))
                for way in seconds:
                    if wanted <= found.keys():
                        break
                    if self.walker.joins(way[1:]):
                        self._add(found, way)
                if wanted <= found.keys():
                    break
        return self._known[pose]

    def _add(self, found: dict[int, Way], way: Way) -> None:
        """Note the cell that a way ends in."""
        if not self.walker.corridors.may_be_critical(*way[-1].chart):
            cell = self.space.locate(way[-1])
            if cell >= 0:
                found.setdefault(cell, way)

    def _cells_near(self, pose: Pose) -> set[int]:
        """Cells whose boundary is near, with doubles."""
        corridors, table = self.walker.corridors, self.space.walls.trapezoids
        turns = np.round((0.5 * (table.theta_from + table.theta_to) - pose.theta) / math.tau)
        turned = pose.theta + math.tau * turns
        faces = np.flatnonzero((table.theta_from <= turned + NEAR) & (turned <= table.theta_to + NEAR))
        at = np.clip(turned[faces], table.theta_from[faces], table.theta_to[faces])
        away = corridors.distances(faces.astype(np.int32), at, float(pose.x), float(pose.y))
        near = faces[away <= NEAR * self._size]
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
        A, O, scale = self._features.robot, self._features.obstacles, self._features.scale
        if kind == 1:
            (X,) = pose.apply_exact([vertex(A, i, scale)])
            return X, minus(vertex(O, O.w[j], scale), vertex(O, O.v[j], scale))
        p, q = pose.apply_exact([vertex(A, A.v[i], scale), vertex(A, A.w[i], scale)])
        return vertex(O, j, scale), minus(q, p)

    def _contacts(self, pose: Pose) -> list[Contact]:
        """The features that touch, exactly."""
        return [c for c in self._near_contacts(pose) if self._misses(pose, c) == 0]

    def _misses(self, pose: Pose, contact: Contact) -> Fraction:
        P, U = positions(contact_line(self._features, *contact), pose.tau)
        return cross(U, minus((pose.x, pose.y), P))

    def _near_contacts(self, pose: Pose) -> list[Contact]:
        """Features that may touch, with doubles."""
        A, O = self._features.robot, self._features.obstacles
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
            pairs = np.argwhere((away <= NEAR * self._size) & (squared > 0)).tolist()  # the reference point has no edge
            found += [(kind, k, e) if kind == 1 else (kind, e, k) for k, e in pairs]
        return found

    @cached_property
    def places(self) -> list[Pose]:
        """Ends of isolated segments, and poses at which boundaries of cells touch, where they are rational."""
        places = [(x, y, theta) for x, y, theta, _ in self._pinches()]
        table = self.space.boundary.isolated
        for k in np.flatnonzero(table.kind != CURVE).tolist():
            places += self.space.boundary.isolated_part(k).ends
        return list(dict.fromkeys(pose for place in places for pose in self._exact(*place)))

    def _pinches(self) -> Iterator[tuple[float, float, float, set[int]]]:
        """Vertices where several cells meet, with doubles."""
        cells = self.space.complex
        cell = np.empty(cells.vertices, np.int32)
        cell[cells.vertex] = self.space.cell_of[self.space.component[cells.face]]
        theta = np.mod(cells.theta + NEAR, math.tau)
        rows = np.round(np.column_stack((cells.x / self._size, cells.y / self._size, theta)) / NEAR)
        order = np.lexsort(rows.T)
        groups = np.split(order, np.flatnonzero(np.any(np.diff(rows[order], axis=0) != 0, axis=1)) + 1)
        for group in groups:
            if len(group) > 1 and len(members := set(cell[group].tolist())) > 1:
                yield float(cells.x[group[0]]), float(cells.y[group[0]]), float(cells.theta[group[0]]), members

    def _exact(self, x: float, y: float, theta: float) -> Iterator[Pose]:
        """A free pose near a place, fixed by two of the contacts that it may be in."""
        about = Pose(x, y, {"tau": _simple_tau(theta)})
        lines = [positions(contact_line(self._features, *c), about.tau) for c in self._near_contacts(about)]
        for k, (P, u) in enumerate(lines):
            for Q, v in lines[:k]:
                if (d := cross(u, v)) == 0:
                    continue
                t = cross(minus(Q, P), v) / d
                pose = Pose(P[0] + t * u[0], P[1] + t * u[1], {"tau": about.tau})
                if math.hypot(float(pose.x) - x, float(pose.y) - y) <= NEAR * self._size and self.walker.joins(
                    [pose, pose]
                ):
                    yield pose
                    return

    @property
    def _features(self) -> SceneFeatures:
        return self.space.boundary.features

    @cached_property
    def _size(self) -> float:
        cells = self.space.complex
        widest = [np.abs(xy).max(initial=0) for xy in (self._features.obstacles.xy, self._features.robot.xy)]
        return float(max(*widest, np.abs(cells.x).max(initial=0), np.abs(cells.y).max(initial=0)))


def _simple_tau(theta: float) -> Fraction | None:
    """The simplest half-angle tangent near an angle."""
    chart, tau = chart_of(np.array([theta % math.tau]))
    t = Fraction(float(tau[0]))
    low, high = t - Fraction(NEAR), t + Fraction(NEAR)
    near = Fraction(0) if low <= 0 <= high else simplest_between(low, high) if t > 0 else -simplest_between(-high, -low)
    return tau_in_chart(int(chart[0]), near)


def _turned_about(pole: Vector, pose: Pose, tau: Fraction) -> Pose:
    turn = Pose(0, 0, {"tau": tau})
    ((x, y),) = turn.apply_exact([minus((pose.x, pose.y), pole)])
    return Pose(pole[0] + x, pole[1] + y, {"tau": (turn @ pose).tau})
