"""Pieces of contact surfaces of rounded shapes: their angles, and curves that stay on their patches between these."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise, product
from typing import Any

from flint import arb, fmpq, fmpz

from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon
from cfree.scene.grown_cores import CoreArc, Rounded, is_arc
from cfree.verify.round_algebra import Moving, Surd, Trig, Turn, cross, dot
from cfree.verify.round_angles import quadratic_roots, root_in, trimmed
from cfree.verify.round_proof import BOUNDS, WORKSPACE, RoundSeparation
from cfree.verify.round_surfaces import BALLS, NIL, UNDECIDED, Curve, Fault, Forms, Surface, UndecidedError, axis

SURDS = Forms(Surd)
NONE, VERTEX_EDGE, EDGE_VERTEX, CIRCLE, PARALLEL, SEAM = range(6)
Key = tuple[Any, ...]
Cone = tuple[tuple[Any, int], ...]  # unit vectors, with the side of each that is in it: left (1) or right (-1)


@dataclass(frozen=True)
class Scale:
    """Precision of a verification.

    Attributes
    ----------
    near : arb
        Places of less than this distance count as one; it is far below what the true robot is larger.
    bits : int
        Angles are integers over 2^bits.
    step : int
        A piece is cut off so much before and after its angles, to avoid quotients 0 / 0.
    """

    near: arb
    bits: int
    step: int = 1 << 64

    def turn(self, chart: int, angle: int) -> Turn:
        return Turn.of(chart, self.tau(angle))

    def tau(self, angle: int) -> arb:
        return arb(fmpz(angle)) * arb(2) ** -self.bits

    def integer(self, tau: arb) -> int:
        return rounded(tau * arb(2) ** self.bits)

    @property
    def width(self) -> arb:
        """Error of an angle."""
        return arb(2) ** -(self.bits + 4)


def rounded(x: arb) -> int:
    """Integer near the middle of a ball."""
    mantissa, exponent = x.mid().man_exp()
    m, e = int(mantissa), int(exponent)
    return m << e if e >= 0 else (m >> -e - 1) + 1 >> 1


@dataclass
class Piece:
    """A trapezoid, from one angle of a chart to another."""

    number: int
    surface: Surface
    quadrant: int
    chart: int
    start: int
    stop: int
    lower: Curve
    upper: Curve
    touches: dict[int, list[int]] = field(default_factory=dict)  # of lower (0), upper (1): where branches meet


class Reader:
    """Features and pieces of a proof, in balls."""

    def __init__(self, proof: RoundSeparation, scale: Scale) -> None:
        self.proof, self.scale = proof, scale
        self.robot, self.obstacles = (_exact(f.points) for f in (proof.robot_features, proof.obstacle_features))
        self.surface = lru_cache(maxsize=None)(self._surface)
        self.curve = lru_cache(maxsize=None)(self._curve)
        self.angle = lru_cache(maxsize=None)(self._angle)
        self._rims = [[Rim.of(shape) for shape in shapes] for shapes in (proof.robot, proof.obstacles)]

    # --- features ---

    def _radius(self, i: int, j: int) -> fmpq:
        return _rational(self.proof.robot_features.radii[i] + self.proof.obstacle_features.radii[j])

    def _surface(self, kind: int, i: int, j: int) -> Surface:
        surface = self._named(kind, i, j)
        if surface.edge is not None and surface.square == 0:
            raise Fault("an edge without length")
        return surface

    def _named(self, kind: int, i: int, j: int) -> Surface:
        proof = self.proof
        if kind == VERTEX_EDGE:
            v, w = proof.obstacle_features.edges[j]
            (x, y), (p, q) = self.obstacles[v], self.obstacles[w]
            return Surface(self.robot[i], (x, y), ((p - x, q - y), NIL), self._radius(i, v))
        if kind == EDGE_VERTEX:
            v, w = proof.robot_features.edges[i]
            (x, y), (p, q) = self.robot[v], self.robot[w]
            return Surface((x, y), self.obstacles[j], (NIL, (p - x, q - y)), self._radius(v, j))
        if kind == CIRCLE:
            return Surface(self.robot[i], self.obstacles[j], None, self._radius(i, j))
        raise Fault("a surface that is neither a line nor a circle")

    def contacts(self, k: int) -> list[Surface]:
        """Prove that the piece's features are those of shapes, both of the same layer; return its surface.

        There is one for each two arcs that have the features as centers, with their directions.
        """
        proof = self.proof
        kind, i, j = int(proof.kind[k]) & 15, int(proof.robot_feature[k]), int(proof.obstacle_feature[k])
        owners, cones = list[int](), list[list[tuple[tuple[Moving, int], ...]]]()
        for side, features, number, is_edge in (
            (0, proof.robot_features, i, kind == EDGE_VERTEX),
            (1, proof.obstacle_features, j, kind == VERTEX_EDGE),
        ):
            if number < 0:
                raise IndexError
            both = features.edges[number] if is_edge else (number,)
            owner = features.owners[both[0]]
            owners.append(owner)
            points, radius = tuple(features.points[p] for p in both), features.radii[both[0]]
            own = [cone for rim in self._rims_of(side, owner) for cone in rim.directions(points, radius)]
            if not own:
                raise Fault(f"its {'edge' if is_edge else 'vertex'} is none of its core")
            cones.append([tuple(((e, NIL) if side else (NIL, e), sign) for e, sign in cone) for cone in own])
        if (owners[0] == BOUNDS) != (owners[1] == BOUNDS):
            raise Fault("a contact of the bounds with another point than the reference point")
        surface = self.surface(kind, i, j)
        return [replace(surface, ends=(*one, *other)) for one, other in product(*cones)]

    def _rims_of(self, side: int, owner: int) -> list[Rim]:
        """Return the rim of an owner of features; a round workspace has one for each shape of its complement."""
        if side == 1 and owner == WORKSPACE and self.proof.frames:
            return self._rims[1][-self.proof.frames :]
        return [self._rim(side, owner)]

    def _rim(self, side: int, owner: int) -> Rim:
        if owner >= 0:
            return self._rims[side][owner]
        if side == 0:
            return Rim({((Fraction(0), Fraction(0)),)} if owner == BOUNDS else set())
        if owner == WORKSPACE and self.proof.workspace is not None:
            return Rim({*_outline(self.proof.workspace, is_reversed=True)})
        if owner == BOUNDS and self.proof.bounds is not None:
            x0, y0, x1, y1 = self.proof.bounds
            corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
            pairs = list(zip(corners, corners[1:] + corners[:1], strict=True))
            return Rim({*pairs, *((q, p) for p, q in pairs), *((p,) for p in corners)})
        return Rim(set())

    def _curve(self, on: Surface, quadrant: int, code: int) -> Curve:
        kind, branch, i, j = unpacked(code)
        if kind == SEAM:
            if on.edge is not None or self.surface(CIRCLE, i, j).key != on.key:
                raise Fault("the end of a quadrant of another circle")
            return Curve(on, quadrant, branch % 4, 0)
        other = self.surface(kind, i, j)
        if other.key == on.key:
            raise Fault("a curve of a surface with itself")
        is_smooth = on.joint_end(other) is not None or other.joint_end(on) is not None
        needs = (on.edge is None or other.edge is None) and not is_smooth
        if needs and branch not in (-1, 1):
            touching = Curve(on, quadrant, other, 1).existence(SURDS)
            if branch != 0 or not any(form.is_zero for form in touching):  # one point at every angle has no branch
                raise Fault("a curve without a branch")
        return Curve(on, quadrant, other, branch if needs else 0)

    # --- angles ---

    def polynomial(self, contact: tuple[int, int, int], chart: int, first: int, second: int) -> Any:
        """Polynomial of the event that two names define on a surface."""
        x = self.surface(*contact)
        (kind, branch, i, j), (kind2, branch2, i2, j2) = unpacked(first), unpacked(second)
        if kind == PARALLEL:
            (v, w), (p, q) = self.proof.robot_features.edges[i], self.proof.obstacle_features.edges[j]
            g, f = _difference(self.robot[w], self.robot[v]), _difference(self.obstacles[q], self.obstacles[p])
            return _poly(BALLS.trig(cross((NIL, (-g[0], -g[1])), (f, NIL))), chart)
        y = self.surface(kind, i, j)
        if kind2 == NONE:
            return _poly(BALLS.touching(x, y, branch), chart)
        if kind2 == SEAM:
            return _poly(BALLS.axis(x, axis(branch2), y), chart)
        z = self.surface(kind2, i2, j2)
        if kind2 == CIRCLE and branch2 == 2:
            if y.edge is not None:
                return _poly(BALLS.trig(dot(y.edge, x.to(z))), chart)
            form = cross(x.to(y), x.to(z)) if x.edge is None else dot(x.edge, y.to(z))
            return _poly(BALLS.trig(form), chart)
        return BALLS.meeting(x, y, z, chart)

    def _angle(
        self, contact: tuple[int, int, int], chart: int, first: int, second: int, low: float, high: float, place: int
    ) -> int:
        """Critical angle, an integer."""
        if not first:
            if low != high or abs(low) != 1 or second or place:
                raise Fault("an angle without a name is no end of a chart")
            return int(low) << self.scale.bits
        if not -2 < low <= high < 2:
            raise Fault("an angle is beyond the chart")
        poly = self.polynomial(contact, chart, first, second)
        if not trimmed(poly):
            raise Fault("an angle is named by what holds at every angle")
        angle = self.scale.integer(root_in(poly, low, high, place, self.scale.width))
        if abs(angle) > (1 << self.scale.bits) + 8:
            raise Fault("an angle is beyond the chart")
        return angle

    # --- pieces ---

    def piece(self, k: int) -> Piece:
        """Piece k, with its angles; `check` proves the rest. Raises Fault and IndexError."""
        proof, t = self.proof, self.proof.table
        surfaces = self.contacts(k)
        kind, quadrant = int(proof.kind[k]) & 15, int(proof.kind[k]) >> 4
        contact = kind, int(proof.robot_feature[k]), int(proof.obstacle_feature[k])
        surface, chart = surfaces[0], int(t.chart[k])
        if chart not in (0, 1) or quadrant > 3 or (quadrant and surface.edge is not None):
            raise Fault("no chart or no quadrant has its number")
        angles = []
        for end in ("from", "to"):
            names = [getattr(t, f"{end}_{name}")[k].item() for name in ("first", "second", "lo", "hi", "place")]
            angles.append(self.angle(contact, chart, *names))
        start, stop = angles
        if start >= stop:
            raise Fault("it does not end after it begins")
        if stop - start < 8 * self.scale.step:
            raise UndecidedError("its angles are too near to each other")
        for last, on in enumerate(surfaces, 1 - len(surfaces)):
            try:
                curves = [self.curve(on, quadrant, int(code)) for code in (t.lower[k], t.upper[k])]
                piece = Piece(k, on, quadrant, chart, start, stop, curves[0], curves[1])
                self._check(piece)
            except Fault:
                if last == 0:
                    raise
            else:
                break
        return piece

    def _check(self, piece: Piece) -> None:
        """Prove that a piece's curves are on its patch between its angles, and in order."""
        surface, lower, upper = piece.surface, piece.lower, piece.upper
        if surface.edge is not None:
            self._points_to_arcs(piece)
        for number, curve in enumerate((lower, upper)):
            piece.touches[number] = self._stays(curve, piece.chart, piece.start, piece.stop)
        turn = self.scale.turn(piece.chart, (piece.start + piece.stop) // 2)
        low, high = lower.place(turn), upper.place(turn)
        gap = high - low if surface.edge is not None else low[0] * high[1] - low[1] * high[0]
        if surface.edge is None and surface.radius < 0:
            gap = -gap  # clockwise, so that forbidden is on the left
        if not gap > -self.scale.near:
            raise Fault("its upper curve is below the lower one")

    def _points_to_arcs(self, piece: Piece) -> None:
        """Prove that the normal of a line's edge is a direction of the arc that touches it, between two angles."""
        scale, edge = self.scale, piece.surface.edge
        assert edge is not None
        below, above = scale.tau(piece.start + scale.step), scale.tau(piece.stop - scale.step)
        for e, sign in piece.surface.ends:
            form = BALLS.trig(dot(e, edge))  # that of e x n, times the edge's length, is the opposite
            if any(not (root < below or root > above) for root in quadratic_roots(form, piece.chart) or ()):
                raise Fault("a contact beyond the ends of its arc")
            if not -sign * form.at(scale.turn(piece.chart, (piece.start + piece.stop) // 2)) > 0:
                raise Fault("a contact beyond the ends of its arc")

    def piece_or_fault(self, k: int) -> Piece | str:
        """Return a piece with its angles and curves, or what is wrong with it."""
        try:
            return self.piece(k)
        except Fault as fault:
            return str(fault)
        except UndecidedError as reason:
            return f"{UNDECIDED}{reason}"
        except IndexError:
            return "it names a feature that does not exist"

    def _stays(self, curve: Curve, chart: int, start: int, stop: int) -> list[int]:
        """Prove that a curve exists and is on its patch between two angles. Return where its branches meet."""
        scale = self.scale
        below, above = scale.tau(start + scale.step), scale.tau(stop - scale.step)
        roots, touches = list[arb](), list[int]()
        always: tuple[list[bool], list[bool]] = [], []  # limits, and existence: True if zero at every angle
        for made, is_end in ((curve.limits, False), (curve.existence, True)):
            for number, form in enumerate(made(BALLS)):
                zeros = quadratic_roots(form, chart)
                always[is_end].append(zeros is None)
                if zeros is None and not made(SURDS)[number].is_zero:
                    raise UndecidedError("a form that may vanish at every angle")
                inside = [root for root in zeros or () if not (root < below or root > above)]
                roots += inside
                touches += [scale.integer(root) for root in inside if is_end]
        roots.sort(key=scale.integer)
        last = below
        for root in [*roots, above]:
            if last < root:
                self._is_inside(curve, Turn.of(chart, ((last + root) / 2).mid()), *always)
            if root is not above and not self._is_near(curve, Turn.of(chart, root)):
                raise Fault("a curve leaves its patch")
            last = root
        return touches

    def _is_inside(self, curve: Curve, turn: Turn, always: list[bool], touch: list[bool]) -> None:
        """Prove that a curve exists and is on its patch, at an angle and so up to the next zero of a form.

        Notes
        -----
        Where the forms of its limits are not zero it is not at an end. If such a form is zero at every angle, one
        branch is at that end always; it is this one if the other is not there. The circles of two branches touch at
        every angle where their existence is zero.
        """
        if curve.square is not None and not any(touch) and not curve.square(turn) > 0:
            raise Fault("a curve that does not exist between its angles")
        if not always:  # the joint at an end of a line
            return
        rests = curve.rests(curve.place(turn), turn)
        other = Curve(curve.on, curve.quadrant, curve.other, -curve.branch) if any(always) else curve
        for rest, rest_of_other, is_zero in zip(rests, curve.rests(other.place(turn), turn), always, strict=True):
            is_there = is_zero and abs(rest) < self.scale.near
            if is_there and curve.branch and not any(touch) and not abs(rest_of_other) > self.scale.near:
                raise UndecidedError("two branches at the end of a patch")
            if not is_there and not rest > 0:
                raise Fault("a curve is beyond an end of its patch")

    def _is_near(self, curve: Curve, turn: Turn) -> bool:
        """True if a curve is on its patch at an angle, or hardly beyond its ends."""
        return all(rest > -self.scale.near for rest in curve.rests(curve.place(turn), turn))


@dataclass(frozen=True)
class Rim:
    """Corners and edges of a core, all grown by one radius, and its arcs.

    Attributes
    ----------
    outline : set of tuples of points
        Points alone, and both ends of directed edges.
    """

    outline: set[tuple[ExactPoint, ...]]
    radius: Fraction = Fraction(0)
    arcs: tuple[CoreArc, ...] = ()

    @classmethod
    def of(cls, shape: Rounded) -> Rim:
        chords: set[tuple[ExactPoint, ...]] = set()
        for arc in shape.arcs:
            beyond = arc.beyond[:1] if arc.beyond else ()
            chords |= {*pairwise((arc.start, *beyond, arc.end)), *((p,) for p in beyond)}
        return cls({*_outline(shape.core)} - chords, shape.radius, tuple(filter(is_arc, shape.arcs)))

    def directions(self, points: tuple[ExactPoint, ...], radius: Fraction) -> list[Cone]:
        """Cones of directions in which a point, or an edge, grown by a radius, is in the shape."""
        if radius == self.radius and points in self.outline:
            return [()]
        r = radius - self.radius
        own = [arc for arc in self.arcs if points == (arc.center,) and arc.signed_radius == r]
        ends = [[_over(_difference(p, arc.center), r) for p in (arc.start, arc.end)] for arc in own]
        turn = 1 if r > 0 else -1  # of the normals along an arc
        return [((first, turn), (last, -turn)) for first, last in ends]


def unpacked(code: int) -> tuple[int, int, int, int]:
    """Kind, branch or end of a quadrant, and the two features of a name."""
    kind, bits = code >> 61, code >> 59 & 3
    branch = -1 if bits == 3 and kind != SEAM else bits
    return kind, branch, code >> 31 & 0xFFFFFFF, code & 0x7FFFFFFF


def _poly(form: Trig, chart: int) -> Any:
    return BALLS.ring.poly(form.coefficients(chart))


def _rational(x: Any) -> fmpq:
    return fmpq(x.numerator, x.denominator)


def _exact(points: Any) -> list[tuple[fmpq, fmpq]]:
    return [(_rational(x), _rational(y)) for x, y in points]


def _difference(p: Any, q: Any) -> tuple[fmpq, fmpq]:
    return p[0] - q[0], p[1] - q[1]


def _over(p: Any, r: Any) -> tuple[fmpq, fmpq]:
    return _rational(p[0] / r), _rational(p[1] / r)


def _outline(core: Polygon | tuple[ExactPoint, ...], *, is_reversed: bool = False) -> Iterator[tuple[ExactPoint, ...]]:
    """Vertices and directed edges of a core."""
    rings = core.exact_rings if isinstance(core, Polygon) else [core]
    for ring in rings:
        points = [*ring][::-1] if is_reversed else [*ring]
        yield from ((p,) for p in points)
        yield from ((p, q) for p, q in zip(points, points[1:] + points[:1], strict=True) if p != q)
