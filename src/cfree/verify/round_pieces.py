"""Pieces of contact surfaces of grown cores: their angles, and curves that stay on their patches between these."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from typing import Any

from flint import arb, fmpq, fmpz

from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon
from cfree.verify.round_algebra import Surd, Trig, Turn, cross, dot
from cfree.verify.round_angles import quadratic_roots, root_in, trimmed
from cfree.verify.round_proof import BOUNDS, WORKSPACE, Core, RoundSeparation
from cfree.verify.round_surfaces import AXES, BALLS, NIL, UNDECIDED, Curve, Fault, Forms, Surface, UndecidedError

SURDS = Forms(Surd)
NONE, VERTEX_EDGE, EDGE_VERTEX, CIRCLE, PARALLEL, SEAM = range(6)
Key = tuple[Any, ...]


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
        self._rims = [_rims(cores) for cores in (proof.robot, proof.obstacles)]

    # --- features ---

    def _radius(self, i: int, j: int) -> fmpq:
        owner, other = self.proof.robot_features.owners[i], self.proof.obstacle_features.owners[j]
        total = self.proof.radius if owner >= 0 else 0
        total += self.proof.radii[other] if other >= 0 else 0
        return _rational(total)

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

    def check_contact(self, k: int) -> None:
        """Prove that the piece's features are those of cores, both of the same layer."""
        proof = self.proof
        kind, i, j = int(proof.kind[k]) & 15, int(proof.robot_feature[k]), int(proof.obstacle_feature[k])
        ends = []
        for side, features, number, is_edge in (
            (0, proof.robot_features, i, kind == EDGE_VERTEX),
            (1, proof.obstacle_features, j, kind == VERTEX_EDGE),
        ):
            if number < 0:
                raise IndexError
            both = features.edges[number] if is_edge else (number,)
            owner = features.owners[both[0]]
            ends.append(owner)
            points = tuple(features.points[p] for p in both)
            if points not in self._rim(side, owner):
                raise Fault(f"its {'edge' if is_edge else 'vertex'} is none of its core")
        if (ends[0] == BOUNDS) != (ends[1] == BOUNDS):
            raise Fault("a contact of the bounds with another point than the reference point")

    def _rim(self, side: int, owner: int) -> set[tuple[ExactPoint, ...]]:
        if owner >= 0:
            return self._rims[side][owner]
        if side == 0:
            return {((Fraction(0), Fraction(0)),)} if owner == BOUNDS else set()
        if owner == WORKSPACE and self.proof.workspace is not None:
            return _rim(self.proof.workspace, is_reversed=True)
        if owner == BOUNDS and self.proof.bounds is not None:
            x0, y0, x1, y1 = self.proof.bounds
            corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
            pairs = list(zip(corners, corners[1:] + corners[:1], strict=True))
            return {*pairs, *((q, p) for p, q in pairs), *((p,) for p in corners)}
        return set()

    def _curve(self, contact: tuple[int, int, int], quadrant: int, code: int) -> Curve:
        kind, branch, i, j = unpacked(code)
        on = self.surface(*contact)
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
            return _poly(BALLS.axis(x, branch2, y), chart)
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
        self.check_contact(k)
        kind, quadrant = int(proof.kind[k]) & 15, int(proof.kind[k]) >> 4
        contact = kind, int(proof.robot_feature[k]), int(proof.obstacle_feature[k])
        surface, chart = self.surface(*contact), int(t.chart[k])
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
        lower, upper = (self.curve(contact, quadrant, int(code)) for code in (t.lower[k], t.upper[k]))
        piece = Piece(k, surface, quadrant, chart, start, stop, lower, upper)
        for number, curve in enumerate((lower, upper)):
            piece.touches[number] = self._stays(curve, chart, start, stop)
        turn = self.scale.turn(chart, (start + stop) // 2)
        low, high = lower.place(turn), upper.place(turn)
        gap = high - low if surface.edge is not None else low[0] * high[1] - low[1] * high[0]
        if not gap > -self.scale.near:
            raise Fault("its upper curve is below the lower one")
        return piece

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
        always: list[bool] = []  # limits, then existence: True if zero at every angle
        for made, is_end in ((curve.limits, False), (curve.existence, True)):
            for number, form in enumerate(made(BALLS)):
                zeros = quadratic_roots(form, chart)
                always.append(zeros is None)
                if zeros is None and not made(SURDS)[number].is_zero:
                    raise UndecidedError("a form that may vanish at every angle")
                inside = [root for root in zeros or () if not (root < below or root > above)]
                roots += inside
                touches += [scale.integer(root) for root in inside if is_end]
        roots.sort(key=scale.integer)
        last = below
        for root in [*roots, above]:
            if last < root:
                self._is_inside(curve, Turn.of(chart, ((last + root) / 2).mid()), always)
            if root is not above and not self._is_near(curve.place(Turn.of(chart, root)), curve):
                raise Fault("a curve leaves its patch")
            last = root
        return touches

    def _is_inside(self, curve: Curve, turn: Turn, always: list[bool]) -> None:
        """Prove that a curve exists and is on its patch, at an angle and so up to the next zero of a form.

        Notes
        -----
        Where the forms of its limits are not zero it is not at an end. If such a form is zero at every angle, one
        branch is at that end always; it is this one if the other is not there.
        """
        if curve.square is not None and not any(always[2:]) and not curve.square(turn) > 0:
            raise Fault("a curve that does not exist between its angles")
        place = curve.place(turn)
        if not always:  # a joint, or the end of a quadrant
            if not self._is_near(place, curve):
                raise Fault("a curve leaves its patch")
            return
        other = Curve(curve.on, curve.quadrant, curve.other, -curve.branch).place(turn) if any(always[:2]) else place
        for rest, rest_of_other, is_zero in zip(
            self._rests(place, curve), self._rests(other, curve), always, strict=False
        ):
            is_there = is_zero and abs(rest) < self.scale.near
            if is_there and curve.branch and not any(always[2:]) and not abs(rest_of_other) > self.scale.near:
                raise UndecidedError("two branches at the end of a patch")
            if not is_there and not rest > 0:
                raise Fault("a curve is beyond an end of its patch")

    def _is_near(self, place: Any, curve: Curve) -> bool:
        """True if a place is on its patch, or hardly beyond its ends."""
        return all(rest > -self.scale.near for rest in self._rests(place, curve))

    def _rests(self, place: Any, curve: Curve) -> tuple[arb, arb]:
        """Numbers that are positive before, and after, the two ends of a patch."""
        if curve.on.edge is not None:
            return place, BALLS.length(curve.on) - place
        start, stop = AXES[curve.quadrant], AXES[(curve.quadrant + 1) % 4]
        after, before = (place[0] * arb(e[0]) + place[1] * arb(e[1]) for e in (stop, start))
        return after, before


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


def _rims(cores: Any) -> list[set[tuple[ExactPoint, ...]]]:
    return [_rim(core) for core in cores]


def _rim(core: Core, *, is_reversed: bool = False) -> set[tuple[ExactPoint, ...]]:
    """Vertices and directed edges of a core."""
    rings = core.exact_rings if isinstance(core, Polygon) else [core]
    rim: set[tuple[ExactPoint, ...]] = set()
    for ring in rings:
        points = [*ring][::-1] if is_reversed else [*ring]
        rim |= {(p,) for p in points}
        rim |= {(p, q) for p, q in zip(points, points[1:] + points[:1], strict=True) if p != q}
    return rim
