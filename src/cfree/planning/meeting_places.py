"""Places where parts of the free space meet without width: cells and isolated parts, at rational orientations exactly.

Doubles say where to look; what is there, and what holds it, is computed. Where parts seem to meet at an irrational
orientation a slide along two contacts may lead from one to another, and through it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, permutations, product
from typing import TYPE_CHECKING

import numpy as np
import shapely

from cfree.exact.pose import Pose
from cfree.forbidden.columns import Ints
from cfree.forbidden.critical_angle import rational_critical_angle
from cfree.planning.clusters import clusters
from cfree.planning.exact_face import Sheet, between, common_tau
from cfree.planning.thin_parts import ThinPart

if TYPE_CHECKING:
    from cfree.planning.boundary_walk import Walker

NEAR = 1e-9  # of the scene's size: what doubles do not tell apart
UPPER, LOWER = 1, 3  # sides of a trapezoid
MOST_TURNS = 256  # attempts at one, nearer and nearer to the critical angle
HALVINGS = (4, 16, 64)  # of the way to the other end: how near to an irrational orientation a slide begins


@dataclass(frozen=True)
class Part:
    """An isolated part, as something that holds poses."""

    index: int


@dataclass(frozen=True)
class Surface:
    """A closed surface with slits of no width, as something that holds poses."""

    index: int


Holder = int | Part | Surface  # or a cell


@dataclass(frozen=True)
class Meeting:
    """Faces and isolated parts that doubles do not tell apart at some vertex."""

    faces: tuple[int, ...]
    parts: tuple[int, ...]
    theta: float


class Places:
    """Where cells and isolated parts of a walker's free space meet."""

    def __init__(self, walker: Walker) -> None:
        self.walker = walker
        self.space = walker.space
        self.parts = [ThinPart(walker, k) for k in range(len(self.space.boundary.isolated))]
        self.slits = walker.with_slits
        self._known: dict[int, tuple[Pose, ...]] = {}  # corners by face

    def holders(self, pose: Pose) -> list[Holder]:
        """What holds a free pose: cells on whose boundary it is, or that it is in, and isolated parts."""
        found: list[Holder] = [*dict.fromkeys(self.walker.cell_at(face) for face in self.space.nearby(pose).on)]
        if not found and (cell := self.space.locate(pose)) >= 0:
            return [cell]
        if self.slits:
            faces = self.slits.space.nearby(pose).on
            found += dict.fromkeys(Surface(self.slits.cell_at(face)) for face in faces)
        return [*found, *(Part(k) for k in self._parts_near(pose) if self.parts[k].holds(pose))]

    def way(self, start: Pose, goal: Pose, holder: Holder) -> list[Pose] | None:
        """Between two poses that a holder holds; None if none was found along an isolated part."""
        if isinstance(holder, Part):
            return self.parts[holder.index].way(start, goal)
        if isinstance(holder, Surface):
            assert self.slits
            return self.slits.walk(start, goal, holder.index)
        return self.walker.walk(start, goal, holder)

    def _parts_near(self, pose: Pose) -> list[int]:
        if self._tree is None:
            return []
        found: list[int] = self._tree.query(shapely.Point(float(pose.x), float(pose.y))).tolist()
        return sorted(found)

    @cached_property
    def _tree(self) -> shapely.STRtree | None:
        """Boxes around the isolated parts."""
        boxes = [part.box(NEAR * self.size) for part in self.parts]
        return shapely.STRtree([shapely.box(*box) for box in boxes]) if boxes else None

    @cached_property
    def rational(self) -> list[Pose]:
        """Where two of them or more meet."""
        edges = self._at_edges(self.walker)
        found = dict.fromkeys([*self._at_meetings(), *edges, *self._at_parts(), *self._on_surfaces()])
        return [pose for pose in found if len(self.holders(pose)) > 1]

    def _on_surfaces(self) -> Iterator[Pose]:
        """Of surfaces with slits: a pose well within each face, its corners, and where surfaces touch."""
        if self.slits is None:
            return
        for face in range(len(self.slits.space.component)):
            sheet = self.slits.sheet(face)
            tau = between(sheet.low, sheet.high)
            yield sheet.pose(sheet.middle(tau), tau)
            yield from _corners(self.slits, face)
        yield from self._at_edges(self.slits)

    # --- at vertices ---

    @cached_property
    def size(self) -> float:
        cells, features = self.space.complex, self.space.boundary.features
        arrays = features.obstacles.xy, features.robot.xy, cells.x, cells.y
        return float(max(np.abs(array).max(initial=0) for array in arrays)) or 1.0

    @cached_property
    def _faces_at(self) -> tuple[Ints, Ints]:
        """Faces by vertex, and where each vertex's faces begin."""
        cells = self.space.complex
        order = np.argsort(cells.vertex, kind="stable")
        return cells.face[order], np.searchsorted(cells.vertex[order], np.arange(cells.vertices + 1)).astype(np.int32)

    @cached_property
    def meetings(self) -> list[Meeting]:
        """Of vertices that bound several cells, or are near to isolated parts."""
        cells, (face, first) = self.space.complex, self._faces_at
        cell = np.array([self.walker.cell_at(int(face[k])) for k in first[:-1]], np.int32)
        ends = np.array([end for part in self.parts for end in part.rounded], float).reshape(-1, 3)
        xyt = np.vstack((np.column_stack((cells.x, cells.y, cells.theta)), ends))
        points = np.column_stack((xyt[:, :2] / self.size, np.cos(xyt[:, 2]), np.sin(xyt[:, 2])))
        found = []
        for group in clusters(points, NEAR):
            vertices, of = group[group < cells.vertices], (group[group >= cells.vertices] - cells.vertices) // 2
            if len(set(cell[vertices].tolist())) + len(set(of.tolist())) > 1:
                faces = {int(f) for v in vertices for f in face[first[v] : first[v + 1]]}
                found.append(Meeting(tuple(sorted(faces)), tuple(sorted(set(of.tolist()))), float(xyt[group[0], 2])))
        return found

    def _at_meetings(self) -> Iterator[Pose]:
        for meeting in self.meetings:
            yield from (pose for face in meeting.faces for pose in self._corners(face))

    def _corners(self, face: int) -> tuple[Pose, ...]:
        """Of a face, at its first and last orientations as far as they are rational."""
        if face not in self._known:
            self._known[face] = _corners(self.walker, face)
        return self._known[face]

    # --- along edges ---

    def _at_edges(self, walker: Walker) -> Iterator[Pose]:
        """Within curves along which cells touch."""
        cells = walker.space.complex
        for edge in cells.pinched.tolist():
            coedges = cells.at_edge(edge)
            faces = cells.face[coedges].tolist()
            side = int(cells.side[coedges[0]])
            if side in (1, 3) and len({walker.cell_at(face) for face in faces}) > 1:
                f, *others = (walker.sheet(face) for face in faces)
                tau = common_tau(f, *others)
                yield f.pose(f.limits(tau)[side == 1], tau)

    # --- on isolated parts ---

    def _at_parts(self) -> Iterator[Pose]:
        """Their ends, where they cross, and corners of faces that are on them."""
        for part in self.parts:
            yield from (pose for pose in part.ends if pose is not None)
            for k in self._tree.query(shapely.box(*part.box(NEAR * self.size))).tolist() if self._tree else ():
                if k != part.k and (pose := part.crossing(self.parts[k])) is not None:
                    yield pose
            yield from (pose for face in self._faces_near(part) for pose in self._corners(face))

    def _faces_near(self, part: ThinPart) -> tuple[int, ...]:
        """Faces with a vertex near a part."""
        cells, (face, first) = self.space.complex, self._faces_at
        x0, y0, x1, y1 = part.box(NEAR * self.size)
        low, high = (theta + by for theta, by in zip(part.theta, (-NEAR, NEAR), strict=True))
        inside = (cells.x >= x0) & (cells.x <= x1) & (cells.y >= y0) & (cells.y <= y1)
        vertices = np.flatnonzero(inside & (np.mod(cells.theta - low, math.tau) <= high - low))
        return tuple(sorted({int(f) for v in vertices for f in face[first[v] : first[v + 1]]}))

    # --- through irrational orientations ---

    def slides(self) -> Iterator[tuple[Pose, Pose]]:
        """Places joined by free slides through vertices at irrational orientations where several parts seem to meet."""
        for meeting in self.meetings:
            for one, other in permutations(self._curves(meeting), 2):
                if one.holder != other.holder and one.name == other.name:
                    yield from self._slid(one, other)

    def turns(self) -> Iterator[list[Pose]]:
        """Ways over critical angles along which cells or surfaces with slits touch: free turns about a place within."""
        for walker in filter(None, (self.walker, self.slits)):
            cells = walker.space.complex
            for edge in cells.pinched.tolist():
                coedges = cells.at_edge(edge).tolist()
                if cells.side[coedges[0]] in (LOWER, UPPER):
                    continue
                for h, k in combinations(coedges, 2):
                    f, g = (int(cells.face[c]) for c in (h, k))
                    if walker.cell_at(f) != walker.cell_at(g) and (way := walker.turn(h, k, MOST_TURNS)):
                        yield way

    def _curves(self, meeting: Meeting) -> Iterator[Tail]:
        """What begins or ends at a meeting, if its orientation is irrational."""
        if any(
            abs(math.remainder(pose.theta - meeting.theta, math.tau)) <= NEAR for pose in self._rational_poses(meeting)
        ):
            return
        thin = (self.parts[k] for k in meeting.parts)
        parts: list[tuple[Sheet, Holder]] = [(part.sheet, Part(part.k)) for part in thin if part.is_curve]
        parts += [(self.walker.sheet(face), self.walker.cell_at(face)) for face in meeting.faces]
        for sheet, holder in parts:
            apart = [math.remainder(theta - meeting.theta, math.tau) for theta in sheet.theta]
            for last, side in product((False, True), (0, 1)):
                if abs(apart[last]) <= NEAR and not (isinstance(holder, Part) and side):
                    yield Tail(sheet, side, last, holder)

    def _rational_poses(self, meeting: Meeting) -> Iterator[Pose]:
        """Rational poses of what meets."""
        yield from (pose for face in meeting.faces for pose in self._corners(face))
        yield from (pose for k in meeting.parts for pose in self.parts[k].ends if pose is not None)

    def _slid(self, one: Tail, other: Tail) -> Iterator[tuple[Pose, Pose]]:
        for halvings in HALVINGS:
            a, b = one.pose(halvings), other.pose(halvings)
            if self.walker.curves.along(a, b, one.sheet, one.sheet.codes[one.side]):
                yield a, b
                return


@dataclass(frozen=True)
class Tail:
    """One of the curves of a sheet, 0 or 1, near its first or last orientation, and what holds it."""

    sheet: Sheet
    side: int
    is_last: bool
    holder: Holder

    @property
    def name(self) -> tuple[int, tuple[str, ...]]:
        """The same for the same curve."""
        return self.sheet.chart, self.sheet.trace(self.side)

    def pose(self, halvings: int) -> Pose:
        """On it, nearer and nearer to its end."""
        low, high = self.sheet.low, self.sheet.high
        share = (high - low) / 2**halvings
        tau = between(high - share, high) if self.is_last else between(low, low + share)
        return self.sheet.pose(self.sheet.limits(tau)[self.side], tau)


def _corners(walker: Walker, face: int) -> tuple[Pose, ...]:
    """Of a face, at its first and last orientations as far as they are rational."""
    sheet, surfaces = walker.sheet(face), walker.space.surfaces
    ends = (rational_critical_angle(surfaces, surfaces.trapezoids, face, last) for last in (False, True))
    taus = [tau for tau in ends if tau is not None]
    return tuple(dict.fromkeys(sheet.pose(t, tau) for tau in taus for t in sheet.limits(tau)))
