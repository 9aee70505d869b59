"""A scene of rounded shapes as convex pieces of cores with radii, and the corners of their rims, for the verifier."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from flint import arb, fmpq
from numpy.typing import NDArray

from cfree.exact.number import ExactPoint
from cfree.exact.vectors import cross, minus
from cfree.polygons.polygon import Polygon
from cfree.scene.grown_cores import CoreArc, Cores, Rounded
from cfree.scene.scene import Scene
from cfree.verify.arcs import Part as LinePart
from cfree.verify.arcs import Region, Spot, crossings, exact
from cfree.verify.polygons import frame, rectangle, rings_of, tile
from cfree.verify.round_algebra import Ball, Turn
from cfree.verify.round_inside import rim_parts
from cfree.verify.surds import surd_sign

Place = tuple[Ball, Ball]
Complexes = NDArray[np.complex128]


@dataclass(frozen=True)
class Disc:
    """A vertex of a convex piece, grown; of an arc only directions from the first normal to the last one."""

    x: arb
    y: arb
    radius: Fraction
    normals: tuple[Place, Place] | None = None


@dataclass(frozen=True)
class Part:
    """A convex piece of a core, counter-clockwise; or the ends of a segment, or a point; all grown.

    Attributes
    ----------
    points : exact points
    radius : Fraction
    arc : CoreArc, optional
        The piece is what is between the arc and its chord; the points are the arc's end and its start.
    """

    points: tuple[ExactPoint, ...]
    radius: Fraction
    arc: CoreArc | None = None

    @cached_property
    def rough(self) -> Complexes:
        """Corners, and the center of the arc."""
        return np.array([complex(*p) for p in (*self.points, *([self.arc.center] if self.arc else []))])

    @cached_property
    def radii(self) -> NDArray[np.float64]:
        """Radius of each of these."""
        arc = [self.arc.radius] if self.arc else []
        return np.array([float(self.radius + r) for r in [*[Fraction(0)] * len(self.points), *arc]])

    @cached_property
    def edges(self) -> list[int]:
        """Corners at which its edges begin."""
        return [0] if self.arc else [*range(len(self.points))] if len(self.points) > 1 else []

    @cached_property
    def discs(self) -> list[Disc]:
        """Discs, and the arc, of which it is the convex hull, with as many bits as there are at the first call."""
        discs = [Disc(_ball(x), _ball(y), self.radius) for x, y in self.points]
        if self.arc:
            (x, y), r = self.arc.center, self.arc.radius
            first, last = (
                (_ball((p - x) / r), _ball((q - y) / r)) for p, q in (self.arc.start, self.arc.end)
            )  # rational, and of length 1
            discs.append(Disc(_ball(x), _ball(y), r + self.radius, (first, last)))
        return discs


@dataclass(frozen=True)
class Fillet:
    """The triangle of a concave arc's ends and a point beyond it, less the arc's disc; of a shape grown by a radius."""

    arc: CoreArc
    grown: Fraction

    @cached_property
    def points(self) -> tuple[ExactPoint, ...]:
        """Center, end, point beyond and start of the arc, counter-clockwise."""
        assert self.arc.beyond is not None
        return self.arc.center, self.arc.end, self.arc.beyond[1], self.arc.start

    @cached_property
    def rough(self) -> Complexes:
        return np.array([complex(*p) for p in self.points])

    def room(self, radius: Fraction) -> Fraction:
        """Distance from the center within which a disc is in that of the arc."""
        return self.arc.radius - self.grown - radius


@dataclass(frozen=True)
class Corner:
    """A vertex of a rim between places on its two tangents, the interior on the left; a point has itself as neighbours.

    Attributes
    ----------
    radius : float
    is_convex : bool
    is_hollow : bool
        True for the center of a concave arc, whose radius is negative.
    start, along, width : complex, complex, float
        The edge that begins here, and by how much it is grown; `along` is 0 if there is none.
    """

    before: complex
    place: complex
    after: complex
    radius: float
    is_convex: bool
    start: complex
    along: complex
    width: float
    is_hollow: bool = False


class RoundWorld:
    """The pieces and corners of robot and obstacles in two layers: bodies, and the reference point with the bounds.

    Attributes
    ----------
    layers : list of pairs of lists of Part
        The robot's pieces and those of obstacles.
    corners : list of pairs of lists of Corner
    fillets : pair of lists of Fillet
        Those of the robot and of obstacles; they are beside the pieces.
    untiled : list of str
        Shapes whose pieces are not convex, or do not tile them, or whose fillets are not beside these in the shape.
    """

    def __init__(self, scene: Scene, cores: Cores) -> None:
        self.untiled: list[str] = []
        self.fillets: tuple[list[Fillet], list[Fillet]] = ([], [])
        robot, obstacles = list[Part](), list[Part]()
        robot_corners, obstacle_corners = list[Corner](), list[Corner]()
        for k, shape in enumerate(cores.robot):
            robot += self._pieces(shape, f"robot[{k}]")
            self.fillets[0].extend(_fillets_of(shape))
            robot_corners += _corners_of(shape)
        first_frame = len(cores.obstacles) - cores.frames
        for k, shape in enumerate(cores.obstacles):
            obstacles += self._pieces(shape, f"obstacle {k}" if k < first_frame else "workspace")
            self.fillets[1].extend(_fillets_of(shape))
            # the rim of a frame stands for infinity
            obstacle_corners += _corners_of(shape, first_ring=int(cores.frames > 0 and k == first_frame))
        reach = max(abs(c) for part in robot for p in part.points for c in p)
        far = reach + max((abs(c) for part in obstacles for p in part.points for c in p), default=Fraction(0))
        far += max(part.radius + (part.arc.radius if part.arc else 0) for part in robot + obstacles)
        if isinstance(scene.workspace, Polygon):
            x0, y0, x1, y1 = map(Fraction, scene.workspace.bounds)
            margin = 1 + 4 * far + x1 - x0 + y1 - y0
            around = rectangle(*(int(v) for v in (x0 - margin, y0 - margin, x1 + margin, y1 + margin)))
            outer, *holes = scene.workspace.exact_rings
            for k, polygon in enumerate([Polygon(around, [outer]), *map(Polygon, holes)]):
                obstacles += self._pieces(Rounded(polygon, Fraction(0)), f"part {k} of the workspace's complement")
            obstacle_corners += _corners(scene.workspace, 0.0, is_reversed=True)
        self.layers = [(robot, obstacles)]
        self.corners = [(robot_corners, obstacle_corners)]
        if scene.bounds:
            bounds = [Fraction(b) for b in scene.bounds]
            span = 1 + far + sum(map(abs, bounds))  # no contact is beyond it
            wide = [bounds[0] - span, bounds[1] - span, bounds[2] + span, bounds[3] + span]
            beyond = [Part(tuple(ring), Fraction(0)) for ring in frame(wide, bounds)]  # type: ignore[arg-type]
            inner = [complex(*p) for p in rectangle(*bounds)[::-1]]  # type: ignore[arg-type]
            self.layers.append(([Part(((Fraction(0), Fraction(0)),), Fraction(0))], beyond))
            self.corners.append(([Corner(0, 0, 0, 0, True, 0, 0, 0)], list(_around(inner, 0.0))))

    def _pieces(self, shape: Rounded, name: str) -> Iterator[Part]:
        core, radius = shape.core, shape.radius
        if not isinstance(core, Polygon):
            yield Part(core, radius)
            return
        scale = core.denominator
        vertices = [(x, y) for x, y in core.numerators]
        pieces = [[vertices[k] for k in piece] for piece in core.pieces]
        if not tile(pieces, rings_of(core, scale)) or not _has_fillets_inside(shape):
            self.untiled.append(name)
        for piece in pieces:
            yield Part(tuple((Fraction(x, scale), Fraction(y, scale)) for x, y in piece), radius)
        for arc in shape.arcs:
            if arc.is_convex:
                yield Part((arc.end, arc.start), radius, arc)

    @cached_property
    def fillet_pairs(self) -> list[FilletPair]:
        """Fillets of one side with the vertices of the pieces of the other one that are small enough for them."""
        pairs = []
        for own, parts in ((0, self.layers[0][1]), (1, self.layers[0][0])):
            vertices = {(p, part.radius) for part in parts for p in part.points}
            for fillet in self.fillets[own]:
                pairs += [FilletPair(fillet, own == 0, *v) for v in sorted(vertices) if fillet.room(v[1]) > 0]
        return pairs

    @cached_property
    def arc_fillet_pairs(self) -> list[ArcFilletPair]:
        """Fillets of one side with the convex arcs of the other one."""
        return [
            ArcFilletPair(fillet, own == 0, part.arc, part.radius + part.arc.radius)
            for own, parts in ((0, self.layers[0][1]), (1, self.layers[0][0]))
            for fillet in self.fillets[own]
            for part in parts
            if part.arc is not None
        ]

    @property
    def size(self) -> float:
        """Number that no coordinate and no radius exceeds by far."""
        parts = [part for layer in self.layers for side in layer for part in side]
        return max(1e-300, *(float((np.abs(part.rough) + part.radii).max()) for part in parts))


@dataclass(frozen=True)
class FilletPair:
    """A fillet of the robot, or of an obstacle, and a disc about a vertex of the other one's pieces.

    They overlap if the vertex is in the fillet's quadrangle, farther from its center than the room there. Conversely,
    one of these pairs overlaps if shapes do, none of whose pieces do. docs/theory/rounded-shapes.md has the proof.
    """

    fillet: Fillet
    is_of_robot: bool
    vertex: ExactPoint
    radius: Fraction

    def overlaps(self, turn: Turn, place: Place, near: arb) -> bool:
        """True if the two overlap by more than `near` where the robot is at a place."""
        x, y = map(_ball, self.vertex)
        if self.is_of_robot:
            x, y = x - place[0], y - place[1]
            x, y = turn.cos * x + turn.sin * y, turn.cos * y - turn.sin * x
        else:
            x, y = turn.cos * x - turn.sin * y + place[0], turn.sin * x + turn.cos * y + place[1]
        points = [(_ball(p), _ball(q)) for p, q in self.fillet.points]
        (p, q), room = points[0], _ball(self.fillet.room(self.radius))
        if not _length(x - p, y - q) > room + near:
            return False
        return _is_deep_in(points, (x, y), near)


@dataclass(frozen=True)
class ArcFilletPair:
    """A fillet of the robot, or of an obstacle, and a convex arc of the other one's pieces.

    They overlap if the place of the arc that is farthest from the fillet's center is in the fillet's quadrangle, beyond
    the fillet's arc. docs/theory/rounded-shapes.md has the proof.
    """

    fillet: Fillet
    is_of_robot: bool
    arc: CoreArc
    radius: Fraction

    @cached_property
    def directions(self) -> tuple[complex, complex]:
        """Directions of the arc's ends from its center."""
        first, last = (complex(*minus(p, self.arc.center)) for p in (self.arc.start, self.arc.end))
        return first / abs(first), last / abs(last)

    def overlaps(self, turn: Turn, place: Place, near: arb) -> bool:
        """True if the two overlap by more than `near` where the robot is at a place."""
        x, y = map(_ball, self.arc.center)
        ends = [tuple(map(_ball, minus(p, self.arc.center))) for p in (self.arc.start, self.arc.end)]
        cos, sin = turn.cos, turn.sin
        if self.is_of_robot:  # in the robot's frame
            x, y = x - place[0], y - place[1]
            x, y = cos * x + sin * y, cos * y - sin * x
            ends = [(cos * p + sin * q, cos * q - sin * p) for p, q in ends]
        else:
            x, y = cos * x - sin * y + place[0], sin * x + cos * y + place[1]
            ends = [(cos * p - sin * q, sin * p + cos * q) for p, q in ends]
        points = [(_ball(p), _ball(q)) for p, q in self.fillet.points]
        away = x - points[0][0], y - points[0][1]
        distance, room, radius = (
            _length(*away),
            _ball(self.fillet.room(self.radius)),
            _ball(self.radius + self.fillet.grown),
        )
        (p, q), (v, w) = ends
        if not (distance > room + near and distance > near):
            return False
        if not (p * away[1] - q * away[0] > 0 and away[0] * w - away[1] * v > 0 and p * away[0] + q * away[1] > 0):
            return False
        x, y = x + radius * away[0] / distance, y + radius * away[1] / distance  # the place farthest from the center
        return _is_deep_in(points, (x, y), near)


def _is_deep_in(ring: list[tuple[arb, arb]], point: tuple[Ball, Ball], near: arb) -> bool:
    """True if a point is in a convex ring, farther than `near` from the lines of its sides."""
    x, y = point
    sides = zip(ring, ring[1:] + ring[:1], strict=True)
    return all((c - a) * (y - b) - (d - b) * (x - a) > near * _length(c - a, d - b) for (a, b), (c, d) in sides)


def _length(x: Ball, y: Ball) -> arb:
    """Return the length of a vector; the power of a ball around 0 would be no number."""
    length: arb = (x * x + y * y).sqrt()
    return length


def _fillets_of(shape: Rounded) -> Iterator[Fillet]:
    return (Fillet(arc, shape.radius) for arc in shape.arcs if not arc.is_convex and arc.radius > shape.radius)


def _has_fillets_inside(shape: Rounded) -> bool:
    """True if the fillets of a core are in its shape, and each is all that the polygon leaves out there.

    The two lines from an arc's ends to the point beyond it meet the rim at these ends only, and that point is in the
    shape. So the fillet, which they bound with the arc, has no rim inside if no ring begins there.
    """
    rings = [*rim_parts(shape)]
    region = Region(tuple(map(tuple, rings)))
    for arc in shape.arcs:
        if arc.beyond is None:
            continue
        first, last = exact(arc.start), exact(arc.end)
        inner, outer = map(exact, arc.beyond)
        if not _is_within((first, outer, last), inner) or not region.holds(Spot.of(outer)):
            return False
        for leg in (LinePart(first, outer), LinePart(outer, last)):
            for part in region.parts:
                if leg.runs_along(part):
                    ends = (Spot.of(p) for p in (part.p, part.q) if p not in (first, last))
                    if any(leg.holds(end) for end in ends):
                        return False
                elif any(not _is_at(spot, (first, last)) for spot in crossings(leg, part)):
                    return False
        corners = {part.p for part in region.parts} - {first, last}
        if any(_is_within((first, outer, last), p) for p in corners):
            return False
    return True


def _is_at(spot: Spot, points: Sequence[Any]) -> bool:
    return any(surd_sign(spot.square_from(p)) == 0 for p in points)


def _is_within(ring: Sequence[Any], point: Any) -> bool:
    """True if a point is strictly inside a triangle, in any direction."""
    signs = set()
    for k, p in enumerate(ring):
        q = ring[k - 1]
        turn = (p[0] - q[0]) * (point[1] - q[1]) - (p[1] - q[1]) * (point[0] - q[0])
        signs.add(1 if turn > 0 else -1 if turn < 0 else 0)
    return signs in ({1}, {-1})


def _corners_of(shape: Rounded, first_ring: int = 0) -> Iterator[Corner]:
    if shape.arcs:
        return _corners_with_arcs(shape, first_ring)
    return _corners(shape.core, float(shape.radius), first_ring=first_ring)


def _tangent(arc: CoreArc, p: ExactPoint) -> ExactPoint:
    """Return the direction of an arc at one of its points."""
    x, y = minus(p, arc.center)
    return (-y, x) if arc.is_convex else (y, -x)


def _ball(x: Fraction) -> arb:
    return arb(fmpq(x.numerator, x.denominator))


def _corners(
    core: Polygon | tuple[ExactPoint, ...], radius: float, *, is_reversed: bool = False, first_ring: int = 0
) -> Iterator[Corner]:
    rings: Sequence[Sequence[ExactPoint]] = core.exact_rings if isinstance(core, Polygon) else [core]
    for ring in rings[first_ring:]:
        points = [complex(*p) for p in ring]
        yield from _around(points[::-1] if is_reversed else points, radius)


def _around(points: Sequence[complex], radius: float) -> Iterator[Corner]:
    count = len(points)
    for k, p in enumerate(points):
        before, after = points[k - 1], points[(k + 1) % count]
        turn = ((p - before).conjugate() * (after - p)).imag
        yield Corner(before, p, after, radius, count < 3 or turn > 0, p, after - p, radius)


def _corners_with_arcs(shape: Rounded, first_ring: int) -> Iterator[Corner]:
    """Yield corners, and centers of arcs; where an arc is smooth with its neighbour the corner only has the edge."""
    assert isinstance(shape.core, Polygon)
    arcs, width = {(arc.start, arc.end): arc for arc in shape.arcs}, float(shape.radius)
    beyond = {arc.beyond[0] for arc in shape.arcs if arc.beyond}
    for points in shape.core.exact_rings[first_ring:]:
        ring = [p for p in points if p not in beyond]
        for before, p, after in zip([ring[-1], *ring[:-1]], ring, [*ring[1:], ring[0]], strict=True):
            one, other = arcs.get((before, p)), arcs.get((p, after))
            into = _tangent(one, p) if one else minus(p, before)
            out = _tangent(other, p) if other else minus(after, p)
            place = complex(*p)
            along = 0 if other else complex(*out)
            is_convex = cross(into, out) > 0
            yield Corner(place - complex(*into), place, place + complex(*out), width, is_convex, place, along, width)
            if other:
                center, is_convex = complex(*other.center), other.is_convex
                first, last = place - center, complex(*after) - center
                if not is_convex:  # normals to the center, that of the end first
                    first, last = -last, -first
                radius = width + float(other.signed_radius)
                yield Corner(
                    center - 1j * first, center, center + 1j * last, radius, is_convex, center, 0, width, not is_convex
                )


def is_apart(robot: Part, obstacle: Part, turn: Turn, place: Place, near: arb) -> bool:
    """True if two grown pieces do not overlap where the robot is at a place, or by less than `near`.

    Notes
    -----
    Convex sets do not overlap exactly if a line separates them. It can be taken along an edge of one, or square to the
    line through the centers of two of the discs or arcs of which they are the hulls. Doubles choose the order in which
    these lines are tried.
    """

    def turned(x: Any, y: Any) -> Place:
        return turn.cos * x - turn.sin * y, turn.sin * x + turn.cos * y

    moved = []
    for disc in robot.discs:
        x, y = turned(disc.x, disc.y)
        normals = disc.normals and (turned(*disc.normals[0]), turned(*disc.normals[1]))
        moved.append(Disc(x + place[0], y + place[1], disc.radius, normals))
    discs = moved, obstacle.discs
    lines: list[tuple[Disc, Disc, int]] = []  # from the first to the second, and quarter turns from there
    for own, part, turns in ((0, robot, -1), (1, obstacle, 1)):
        lines += [(discs[own][k], discs[own][(k + 1) % len(part.points)], turns) for k in part.edges]
    lines += [(a, b, 0) for a in discs[0] for b in discs[1] if a.radius or b.radius]
    for k in np.argsort(-_gaps(lines, *discs), kind="stable"):
        p, q, turns = lines[k]
        x, y = q.x - p.x, q.y - p.y
        u = (-turns * y, turns * x) if turns else (x, y)
        if x * x + y * y > 0 and _is_between(u, *discs, near):
            return True
    return False


def _gaps(
    lines: Sequence[tuple[Disc, Disc, int]], robot: Sequence[Disc], obstacle: Sequence[Disc]
) -> NDArray[np.float64]:
    """Estimate how far two sets of discs are apart along lines, below 0 where they overlap."""

    def rough(x: Any, y: Any) -> complex:
        return complex(float(x.mid()), float(y.mid()))

    places = {id(disc): rough(disc.x, disc.y) for disc in (*robot, *obstacle)}
    along = np.array([1j**turns * (places[id(q)] - places[id(p)]) for p, q, turns in lines])
    along /= np.maximum(np.abs(along), 1e-300)

    def tops(discs: Sequence[Disc], along: Complexes) -> NDArray[np.float64]:
        heights = np.full(len(along), -np.inf)
        for disc in discs:
            height = (along.conj() * places[id(disc)]).real + float(disc.radius)
            if disc.normals:
                first, last = (rough(*normal) for normal in disc.normals)
                is_there = ((first.conjugate() * along).imag >= 0) & ((along.conj() * last).imag >= 0)
                height[~is_there] = -np.inf
            heights = np.maximum(heights, height)
        return heights

    return -tops(obstacle, -along) - tops(robot, along)


def _is_between(u: Place, robot: Sequence[Disc], obstacle: Sequence[Disc], near: arb) -> bool:
    """True if a line square to a vector u has the robot before it and the obstacle behind it, or nearly so."""
    length = (u[0] * u[0] + u[1] * u[1]).sqrt()
    back = -u[0], -u[1]
    tops = [_height(disc, u, length) for disc in robot if _has(disc, u)]
    bottoms = [-_height(disc, back, length) for disc in obstacle if _has(disc, back)]
    return all(top - near * length < bottom for top in tops for bottom in bottoms)


def _height(disc: Disc, u: Place, length: Ball) -> Ball:
    return disc.x * u[0] + disc.y * u[1] + _ball(disc.radius) * length


def _has(disc: Disc, u: Place) -> bool:
    """True if an arc may have a point in a direction; at its ends it is as high as its corners are."""
    if disc.normals is None:
        return True
    (a, b), (c, d) = disc.normals
    return not (a * u[1] - b * u[0] < 0 or u[0] * d - u[1] * c < 0)
