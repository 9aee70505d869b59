"""Compare a boundary of rounded shapes with slices that are computed anew from the cores, in doubles.

At an orientation every contact is a segment of a line or an arc of a circle. It is cut where it meets the rims of
pillars; each part is free or covered all along. Parts that doubles leave open, as in slits, are not compared.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from cfree.verify.round_algebra import Turn
from cfree.verify.round_pieces import Piece, Scale
from cfree.verify.round_surfaces import AXES
from cfree.verify.round_world import ArcFilletPair, Complexes, Corner, FilletPair, Part, RoundWorld

SAME, SURE = 1e-7, 1e-8  # lengths, in the scene's size: of curves that are one, and of distances that are certain
LEAST = 1e-5  # parts of less length are not compared
FREE, COVERED, OPEN = 1, -1, 0
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Contact:
    """A segment of a line, from `place` in a direction; or an arc about `place`, with angles as positions.

    The radius of a concave arc is negative: points are in the directions opposite to these angles.
    """

    place: complex
    along: complex  # a unit vector; 0 for a circle
    radius: float
    first: float
    last: float
    own: tuple[complex, complex] = (0, 0)  # vertices of the robot and of an obstacle, or starts of edges

    def points(self, positions: Floats) -> Complexes:
        if self.along:
            return np.asarray(self.place + positions * self.along, complex)
        return np.asarray(self.place + self.radius * np.exp(1j * positions), complex)

    def is_on(self, other: Contact, near: float) -> bool:
        """True if both are on one line, in one direction, or on one circle."""
        if not self.along or not other.along:
            same_kind = not self.along and not other.along
            return same_kind and abs(self.place - other.place) < near and abs(self.radius - other.radius) < near
        off = (self.along.conjugate() * (other.place - self.place)).imag
        return abs(self.along - other.along) < SAME and abs(off) < near

    def has(self, other: Contact, point: complex, near: float) -> bool:
        """True if a point of the other one, on the same line or circle, is in this one, and not near its ends."""
        if self.along:
            position = (self.along.conjugate() * (point - self.place)).real
            return self.first + near < position < self.last - near
        margin = near / abs(self.radius)
        position = self.first + (cmath.phase((point - self.place) / self.radius) - self.first) % math.tau
        return self.first + margin < position < self.last - margin


@dataclass(frozen=True)
class Pillar:
    """The positions that two convex pieces forbid: a convex polygon, a segment or a point, grown.

    Attributes
    ----------
    centers, radii : of circles that its rim may follow
    starts, units : places and directions of lines that it may follow
    robot, obstacle : vertices of the two pieces, where they are
    """

    hull: Complexes
    radius: float
    robot: Complexes
    obstacle: Complexes

    @property
    def centers(self) -> Complexes:
        return self.hull

    @property
    def radii(self) -> Floats:
        return np.full(len(self.hull), self.radius)

    @property
    def units(self) -> Complexes:
        along = np.roll(self.hull, -1) - self.hull
        return along / np.abs(along) if len(along) > 1 else along[:0]

    @property
    def starts(self) -> Complexes:
        return self.hull[: len(self.units)] - 1j * self.radius * self.units

    def room(self, points: Floats | Complexes) -> Floats:
        """Distances from the pillar, negative inside."""
        if len(self.hull) == 1:
            return np.asarray(np.abs(points - self.hull[0])) - self.radius
        start, along = self.hull[:, None], (np.roll(self.hull, -1) - self.hull)[:, None]
        seen = (points[None] - start) * along.conj() / np.abs(along)
        beyond = np.clip(seen.real - np.abs(along), 0, None) + np.clip(-seen.real, 0, None)
        off = np.hypot(seen.imag, beyond).min(axis=0)
        inside = (seen.imag > 0).all(axis=0) if len(self.hull) > 2 else np.zeros(len(points), bool)
        return np.asarray(np.where(inside, -seen.imag.min(axis=0), off)) - self.radius

    def has(self, contact: Contact, near: float) -> bool:
        """True if both vertices of a contact are of these pieces."""
        return _has(self.robot, self.obstacle, contact, near)


@dataclass(frozen=True)
class Hull:
    """Discs, and perhaps an arc, at an orientation; of the arc only directions from an angle on, within another."""

    centers: Complexes
    radii: Floats
    arc: tuple[float, float] | None
    units: Complexes  # of its edges, which it is on the left of

    @classmethod
    def of(cls, part: Part, turned: complex) -> Hull:
        """Turn a piece by a unit number; the opposite of one makes it that of the robot's negative."""
        centers, arc = turned * part.rough, None
        if part.arc is not None:
            first, last = (turned * (complex(*p) - complex(*part.arc.center)) for p in (part.arc.start, part.arc.end))
            arc = cmath.phase(first), cmath.phase(last / first)
        edges = np.array([centers[(k + 1) % len(part.points)] - centers[k] for k in part.edges], complex)
        return cls(centers, part.radii, arc, edges / np.abs(edges))

    @property
    def directions(self) -> Complexes:
        """Normals of the edges, and the ends of the arc's directions."""
        ends = [] if self.arc is None else [cmath.rect(1, self.arc[0]), cmath.rect(1, sum(self.arc))]
        return np.concatenate([-1j * self.units, ends])

    def heights(self, directions: Complexes) -> Floats:
        """Greatest heights in some directions."""
        heights = (self.centers[:, None].conj() * directions[None]).real + self.radii[:, None]
        if self.arc is not None:
            first, extent = self.arc
            heights[-1, np.mod(np.angle(directions) - first + SAME, math.tau) > extent + 2 * SAME] = -np.inf
        return np.asarray(heights.max(axis=0))


@dataclass(frozen=True)
class ArcPillar:
    """The positions that two convex pieces forbid, one of which has an arc; see `Pillar`."""

    hulls: tuple[Hull, Hull]  # of the obstacle, and of the robot's negative

    @cached_property
    def centers(self) -> Complexes:
        one, other = self.hulls
        return np.asarray((one.centers[:, None] + other.centers[None]).ravel())

    @cached_property
    def radii(self) -> Floats:
        one, other = self.hulls
        return np.asarray((one.radii[:, None] + other.radii[None]).ravel())

    @cached_property
    def units(self) -> Complexes:
        return np.concatenate([hull.units for hull in self.hulls])

    @cached_property
    def starts(self) -> Complexes:
        return -1j * self.units * self._heights(-1j * self.units)

    def _heights(self, directions: Complexes) -> Floats:
        return sum((hull.heights(directions) for hull in self.hulls), np.zeros(len(directions)))

    @cached_property
    def _tangents(self) -> tuple[Complexes, Floats]:
        """Directions in which the rim changes from a line or an arc to another, and the heights there."""
        directions = np.concatenate([hull.directions for hull in self.hulls])
        return directions, self._heights(directions)

    def room(self, points: Complexes) -> Floats:
        """Distances from the pillar, negative inside: the greatest height over a tangent."""
        away = points[:, None] - self.centers[None]
        length = np.abs(away)
        away = np.where(length > 0, away / np.where(length > 0, length, 1), 1)
        over = (away.conj() * points[:, None]).real - self._heights(away.ravel()).reshape(away.shape)
        directions, heights = self._tangents
        flat = (directions.conj()[None] * points[:, None]).real - heights[None]
        return np.asarray(np.concatenate([over, flat], axis=1).max(axis=1))

    def has(self, contact: Contact, near: float) -> bool:
        """True if both vertices of a contact are of these pieces."""
        return _has(-self.hulls[1].centers, self.hulls[0].centers, contact, near)


@dataclass(frozen=True)
class HollowPillar:
    """Positions that a fillet forbids: outside of a circle. See `Pillar`."""

    corners: Complexes  # of a quadrangle, the first is the circle's center
    reach: float
    robot: complex
    obstacle: complex

    @property
    def centers(self) -> Complexes:
        return self.corners[:1]

    @property
    def radii(self) -> Floats:
        return np.array([self.reach])

    @property
    def sides(self) -> Complexes:
        """Directions of the quadrangle's sides."""
        along = np.roll(self.corners, -1) - self.corners
        return np.asarray(along / np.abs(along))

    def depth(self, points: Complexes) -> Floats:
        """Distance of points from the nearest line of a side, negative outside of the quadrangle."""
        heights = ((points[None] - self.corners[:, None]) * self.sides[:, None].conj()).imag
        return np.asarray(heights.min(axis=0))

    def has(self, contact: Contact, near: float) -> bool:
        """True if the contact is that of the fillet's arc and the other shape's vertex, or its arc."""
        return _has(np.array([self.robot]), np.array([self.obstacle]), contact, near)


@dataclass(frozen=True)
class FilletPillar(HollowPillar):
    """The positions that a fillet and a vertex of the other shape forbid: a quadrangle less a disc."""

    @classmethod
    def of(cls, pair: FilletPair, turned: complex) -> FilletPillar:
        corners, vertex = pair.fillet.rough, complex(*pair.vertex)
        reach = float(pair.fillet.room(pair.radius))
        if pair.is_of_robot:
            return cls(vertex - turned * corners, reach, turned * complex(corners[0]), vertex)
        return cls(corners - turned * vertex, reach, turned * vertex, complex(corners[0]))

    @property
    def units(self) -> Complexes:
        return self.sides

    @property
    def starts(self) -> Complexes:
        return self.corners

    def room(self, points: Complexes) -> Floats:
        """Numbers that are positive outside, negative inside, and at most a distance from the rim."""
        return np.asarray(np.maximum(-self.depth(points), self.reach - np.abs(points - self.corners[0])))


@dataclass(frozen=True)
class ArcFilletPillar(HollowPillar):
    """The positions at which an arc's place farthest from a fillet's center is in the fillet.

    The quadrangle is that of the fillet, as if the arc's center were the place. The rest of the rim is inside of other
    pillars, and cuts nothing.
    """

    radius: float
    directions: tuple[complex, complex]  # of the arc, from the fillet's center to the place
    least: float  # a distance that decides

    @classmethod
    def of(cls, pair: ArcFilletPair, turned: complex, size: float) -> ArcFilletPillar:
        corners, center = pair.fillet.rough, complex(*pair.arc.center)
        reach, radius = float(pair.fillet.room(pair.radius)), float(pair.radius + pair.fillet.grown)
        first, last = pair.directions
        if pair.is_of_robot:
            moved = center - turned * corners
            own = turned * complex(corners[0]), center
            return cls(moved, reach, *own, radius, (-first, -last), 2 * SURE * size)
        own = turned * center, complex(corners[0])
        return cls(corners - own[0], reach, *own, radius, (turned * first, turned * last), 2 * SURE * size)

    @property
    def units(self) -> Complexes:
        return self.corners[:0]

    starts = units

    def room(self, points: Complexes) -> Floats:
        """Numbers that are positive outside, negative inside, and at most a distance from the rim."""
        away = points - self.corners[0]
        distance = np.abs(away)
        first, last = ((d.conjugate() * away).imag for d in self.directions)
        farthest = points + self.radius * away / np.where(distance > 0, distance, 1)
        beyond = np.maximum(-self.depth(farthest), np.maximum(-first, last))
        return np.asarray(np.maximum(np.minimum(beyond, self.least), self.reach - distance))


AnyPillar = Pillar | ArcPillar | FilletPillar | ArcFilletPillar


def _has(robot: Complexes, obstacle: Complexes, contact: Contact, near: float) -> bool:
    one, other = contact.own
    return bool(np.abs(robot - one).min() < near and np.abs(obstacle - other).min() < near)


def pillar_of(robot: Part, obstacle: Part, turned: complex) -> AnyPillar:
    """Make the pillar of two pieces at an orientation, a unit number."""
    if robot.arc is not None or obstacle.arc is not None:
        return ArcPillar((Hull.of(obstacle, 1), Hull.of(robot, -turned)))
    here, there = turned * robot.rough, obstacle.rough
    return Pillar(_hull((there[:, None] - here[None]).ravel()), float(robot.radius + obstacle.radius), here, there)


def compared(world: RoundWorld, pieces: Sequence[Piece], scale: Scale, chart: int, angle: int) -> tuple[int, list[str]]:
    """Compare at an angle: the number of parts that were compared, and what differs."""
    turn = scale.turn(chart, angle)
    turned = complex(float(turn.cos.mid()), float(turn.sin.mid()))
    size = world.size
    stored = [_contact_of(piece, turn) for piece in pieces if piece.chart == chart and piece.start < angle < piece.stop]
    wrong = [f"trapezoids on one another near {_text(at)}" for at in _doubled(stored, size)]
    met = np.zeros(len(stored), bool)
    number = 0
    pillars: list[AnyPillar] = [
        pillar_of(a, b, turned) for parts, others in world.layers for a in parts for b in others
    ]
    pillars += [FilletPillar.of(pair, turned) for pair in world.fillet_pairs]
    pillars += [ArcFilletPillar.of(pair, turned, size) for pair in world.arc_fillet_pairs]
    for robot, obstacles in world.corners:
        for contact in _contacts(robot, obstacles, turned, size):
            on = [k for k, other in enumerate(stored) if other.is_on(contact, SAME * size)]
            met[on] = True
            for point, state in _parts(contact, pillars, size):
                is_stored = any(stored[k].has(contact, point, 0.0) for k in on)
                number += 1
                if state == FREE and not is_stored:
                    wrong.append(f"a free contact near {_text(point)} is not in the file")
                if state == COVERED and any(stored[k].has(contact, point, LEAST * size) for k in on):
                    wrong.append(f"a contact near {_text(point)} is in the file and not free")
    wrong += [f"a contact near {_text(stored[k].place)} is none of the scene" for k in np.flatnonzero(~met)]
    return number, wrong


def _text(point: complex) -> str:
    return f"({point.real:.6g}, {point.imag:.6g})"


def _contact_of(piece: Piece, turn: Turn) -> Contact:
    """The part of a trapezoid at an angle, from the verifier's own formulas."""
    a, b = (complex(*(float(c.mid()) for c in curve.point(turn))) for curve in (piece.lower, piece.upper))
    s = piece.surface
    if s.edge is not None:
        f, g = (complex(float(v[0]), float(v[1])) for v in s.edge)
        along = f - complex(float(turn.cos.mid()), float(turn.sin.mid())) * g
        along /= abs(along)
        return Contact(a, along, 0.0, 0.0, (along.conjugate() * (b - a)).real)
    turned = complex(float(turn.cos.mid()), float(turn.sin.mid()))
    center = complex(*map(float, s.b)) - turned * complex(*map(float, s.a))
    axis = complex(*map(float, AXES[piece.quadrant]))
    first, last = (cmath.phase((p - center) / axis) + math.pi / 2 * piece.quadrant for p in (a, b))
    if s.radius < 0:  # from the end of a quadrant to its beginning
        first, last = (cmath.phase((center - p) / axis) + math.pi / 2 * piece.quadrant for p in (b, a))
    return Contact(center, 0, float(s.radius), first, last)


def _doubled(stored: Sequence[Contact], size: float) -> Iterator[complex]:
    """Places where two parts of one line or circle overlap."""
    for k, one in enumerate(stored):
        for two in stored[:k]:
            middle = two.points(np.array([(two.first + two.last) / 2]))[0]
            if one.is_on(two, SAME * size):
                mine = one.points(np.array([(one.first + one.last) / 2]))[0]
                if one.has(two, middle, LEAST * size) or two.has(one, mine, LEAST * size):
                    yield middle


def _hull(points: Complexes) -> Complexes:
    """Corners of the convex hull, counter-clockwise, without points that are nearly on its edges."""
    order = sorted({(complex(p).real, complex(p).imag) for p in points})
    size = 1e-13 * max(1e-300, float(np.abs(points - points[0]).max())) ** 2

    def half(places: Iterable[tuple[float, float]]) -> list[tuple[float, float]]:
        chain: list[tuple[float, float]] = []
        for p in places:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-2:]
                if (bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax) > size:
                    break
                chain.pop()
            chain.append(p)
        return chain

    if len(order) == 1:
        return np.array([complex(*order[0])])
    lower, upper = half(order), half(order[::-1])
    return np.array([complex(*p) for p in lower[:-1] + upper[:-1]])


def _contacts(robot: Sequence[Corner], obstacles: Sequence[Corner], turned: complex, size: float) -> Iterator[Contact]:
    """Contacts that are locally possible at an orientation."""
    eps = 1e-9 * size
    for a in robot:
        before, place, after = (turned * p for p in (a.before, a.place, a.after))
        for b in obstacles:
            rho, edge = a.radius + b.radius, b.along
            if a.is_convex and edge:
                n = -1j * edge / abs(edge)
                if all(_dot(p - place, n) > -eps for p in (before, after)):
                    start = b.start - place + (a.radius + b.width) * n
                    yield Contact(start, edge / abs(edge), 0, 0, abs(edge), (place, b.start))
            edge, begin = -turned * a.along, turned * a.start
            if b.is_convex and edge:
                n = -1j * edge / abs(edge)
                if all(_dot(p - b.place, n) < eps for p in (b.before, b.after)):
                    start = b.place - begin + (a.width + b.radius) * n
                    yield Contact(start, edge / abs(edge), 0, 0, abs(edge), (begin, b.place))
            is_inside = (a.is_convex and b.is_hollow) or (a.is_hollow and b.is_convex)
            if (a.is_convex and b.is_convex and rho > 0) or (is_inside and rho < 0):
                yield from _arcs(place, (before, after), b, rho, eps)


def _arcs(a: complex, neighbours: tuple[complex, complex], b: Corner, rho: float, eps: float) -> Iterator[Contact]:
    """Arcs on which the directions from an obstacle's vertex are in the cones of both vertices."""
    ends = {math.pi / 2 * k for k in range(4)}  # the file's quadrants
    spans = [(p - b.place, -1) for p in (b.before, b.after) if p != b.place]
    spans += [(p - a, 1) for p in neighbours if p != a]
    for span, _ in spans:
        ends |= {cmath.phase(1j * span) % math.tau, cmath.phase(-1j * span) % math.tau}
    order = sorted(ends)
    for first, last in zip(order, [*order[1:], order[0] + math.tau], strict=True):
        u = cmath.rect(1, (first + last) / 2)
        if last - first > 1e-12 and all(sign * _dot(span, u) > -eps for span, sign in spans):
            yield Contact(b.place - a, 0, rho, first, last, (a, b.place))


def _dot(u: complex, v: complex) -> float:
    return (u.conjugate() * v).real


def _parts(contact: Contact, pillars: Sequence[AnyPillar], size: float) -> Iterator[tuple[complex, int]]:
    """Middles of the parts of a contact, each FREE, COVERED or OPEN; short parts are left out."""
    ends = np.array([contact.first, contact.last])
    box = contact.points(np.linspace(contact.first, contact.last, 9))
    middle, reach = complex(box.mean()), float(np.abs(box - box.mean()).max()) + abs(contact.radius)
    near = [p for p in pillars if p.room(np.array([middle]))[0] < reach + SURE * size]
    cuts = np.concatenate([ends, *(_cuts(contact, pillar) for pillar in near)])
    cuts = np.unique(cuts[(cuts >= contact.first) & (cuts <= contact.last)])
    length = np.diff(cuts) * (1 if contact.along else abs(contact.radius))
    (long,) = np.nonzero(length > LEAST * size)
    if not len(long):
        return
    points = contact.points((cuts[long] + cuts[long + 1]) / 2)
    least = np.full(len(points), np.inf)
    for pillar in near:
        room = pillar.room(points)
        is_inside = isinstance(pillar, HollowPillar)  # then the circle is free inside
        if pillar.has(contact, SAME * size) and is_inside == (contact.radius < 0):
            room = np.where(np.abs(room) < SURE * size, np.inf, room)  # the contact itself
        least = np.minimum(least, room)
    for point, room in zip(points.tolist(), least.tolist(), strict=True):
        yield point, FREE if room > SURE * size else COVERED if room < -SURE * size else OPEN


def _cuts(contact: Contact, pillar: AnyPillar) -> Floats:
    """Positions at which a contact's line or circle meets the lines and circles of a pillar's rim."""
    result, unit, start = list[Floats](), pillar.units, pillar.starts
    with np.errstate(all="ignore"):
        if contact.along:
            across = (unit.conj() * contact.along).imag
            result.append(-(unit.conj() * (contact.place - start)).imag / across)
        else:
            height = (unit.conj() * (contact.place - start)).imag  # of the centre, on the left
            angle = np.arccos(-height / contact.radius)
            result += [np.angle(1j * unit) + sign * angle for sign in (1, -1)]
        (round_,) = np.nonzero(pillar.radii > 0)
        d, rho = pillar.centers[round_] - contact.place, pillar.radii[round_]
        if contact.along:
            seen = contact.along.conjugate() * d
            root = np.sqrt(rho * rho - seen.imag**2)
            result += [seen.real - root, seen.real + root]
        else:
            away = np.abs(d)
            angle = np.arccos((away**2 + contact.radius**2 - rho * rho) / (2 * away * contact.radius))
            result += [np.angle(d) - angle, np.angle(d) + angle]
    cuts = np.concatenate(result)
    cuts = cuts[np.isfinite(cuts)]
    return cuts if contact.along else contact.first + np.mod(cuts - contact.first, math.tau)
