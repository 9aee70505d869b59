"""Contact surfaces of grown cores, seen in the plane at one orientation: lines and circles, and their meetings.

With rho = r + s, C = b - R a, and V an edge F of an obstacle or -R G of the robot, the position x touches where

    V x (x - C) + rho |V| = 0    (a vertex on an edge),        |x - C| = rho    (two vertices).

On a line x = C + t V - rho J V / |V|, on a circle x = C + rho u. There rho is negative if one vertex is the center of a
concave arc: the position is opposite to the direction u, and free inside of the circle. Curves are quotients of forms
a + b cos + c sin, and of square roots of such.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import permutations
from typing import Any

from flint import arb, fmpq

from cfree.verify.round_algebra import (
    Ball,
    Balls,
    Moving,
    Number,
    Point,
    Polynomial,
    Scalar,
    Trig,
    Turn,
    cross,
    dot,
    quarter,
    root,
)

NIL: Point = (fmpq(0), fmpq(0))
AXES: tuple[Point, ...] = ((fmpq(1), fmpq(0)), (fmpq(0), fmpq(1)), (fmpq(-1), fmpq(0)), (fmpq(0), fmpq(-1)))


class Fault(Exception):
    """A statement of a proof is false or makes no sense; the message gives the reason."""


class UndecidedError(Exception):
    """The bits do not suffice for a statement."""


UNDECIDED = "undecided: "
"""Begins a finding's text where it is no fault but undecided."""


@dataclass(frozen=True)
class Surface:
    """A line, with `edge` on an obstacle or on the robot, or a circle.

    Attributes
    ----------
    a, b : points of the robot and of the obstacles
        Vertices, or the beginning of an edge.
    edge : moving vector, optional
    radius : Number
        The sum of both radii; that of a concave arc is negative, and so may be the sum.
    ends : pairs of a moving unit vector and a sign
        Of a contact of arcs: directions from the obstacle to the robot are on the left (1) or right (-1) of each.
    """

    a: Point
    b: Point
    edge: Moving | None
    radius: Number
    ends: tuple[tuple[Moving, int], ...] = ()

    @cached_property
    def square(self) -> Number:
        assert self.edge is not None
        (fx, fy), (gx, gy) = self.edge
        return fx * fx + fy * fy + gx * gx + gy * gy

    @cached_property
    def key(self) -> tuple[Any, ...]:
        """Name of the line or the circle; equal names mean equal surfaces."""
        if self.edge is None:
            return self.a, self.b, self.radius
        (f, g) = self.edge
        u, on, fixed = (f, self.b, self.a) if f != NIL else (g, self.a, self.b)
        most = max(abs(u[0]), abs(u[1]))
        u = u[0] / most, u[1] / most
        return fixed, u, u[0] * on[1] - u[1] * on[0], f != NIL, self.radius

    def end(self, k: int) -> tuple[Point, Point]:
        """Vertices a and b at one end of the edge."""
        assert self.edge is not None
        (f, g) = self.edge
        return (self.a[0] + k * g[0], self.a[1] + k * g[1]), (self.b[0] + k * f[0], self.b[1] + k * f[1])

    def joint_end(self, circle: Surface) -> int | None:
        """End of a line in which a circle touches it at every angle, in a joint; None if none does.

        The circle is about the end itself, or about a point beside it, square to the edge, with a radius that is larger
        or smaller by the distance.
        """
        if self.edge is None or circle.edge is not None:
            return None
        (f, g), more = self.edge, circle.radius - self.radius
        for k in (0, 1):
            a, b = self.end(k)
            on_robot = f == NIL
            fixed, d, e = (
                (circle.b == b, _minus(circle.a, a), g) if on_robot else (circle.a == a, _minus(circle.b, b), f)
            )
            height = e[0] * d[1] - e[1] * d[0]
            if fixed and e[0] * d[0] + e[1] * d[1] == 0 and d[0] ** 2 + d[1] ** 2 == more**2 and height * more >= 0:
                return k
        return None

    def touches(self, other: Surface) -> Moving | None:
        """Direction from a circle's center in which another circle, around it or in it, touches it at every angle."""
        less = self.radius - other.radius
        if self.edge is not None or other.edge is not None or less == 0:
            return None
        for d, is_fixed, on_robot in (
            (_minus(other.b, self.b), self.a == other.a, False),
            (_minus(other.a, self.a), self.b == other.b, True),
        ):
            if is_fixed and d[0] ** 2 + d[1] ** 2 == less**2:
                e = d[0] / less, d[1] / less
                return (NIL, e) if on_robot else (e, NIL)
        return None

    def to(self, other: Surface) -> Moving:
        """Vector from this surface's point C to another's."""
        return _minus(other.b, self.b), _minus(other.a, self.a)


def _minus(u: Point, v: Point) -> Point:
    return u[0] - v[0], u[1] - v[1]


def _along(line: Surface) -> Moving:
    assert line.edge is not None
    return line.edge


@dataclass(frozen=True)
class Forms:
    """Forms of surfaces, in one kind of number."""

    ring: Any  # Balls, or Surd

    def trig(self, three: tuple[Number, Number, Number]) -> Trig:
        a, b, c = map(self.ring.number, three)
        return Trig(a, b, c)

    def length(self, line: Surface) -> Scalar:
        return self.ring.root(line.square)

    def radius(self, x: Surface) -> Scalar:
        return self.ring.number(x.radius)

    def offset(self, line: Surface, x: Surface) -> Trig:
        """Height of a surface's C over a line, times the edge's length, positive on the left."""
        return self.trig(cross(_along(line), line.to(x))).plus(self.radius(line) * self.length(line))

    def apart(self, x: Surface, y: Surface) -> Trig:
        """Squared distance of two C."""
        return self.trig(dot(x.to(y), x.to(y)))

    # --- a circle's point C + rho u is inside of another surface where rho n . u > delta ---

    def normal(self, circle: Surface, other: Surface) -> Moving:
        if other.edge is not None:
            return quarter(other.edge)
        (p, q) = circle.to(other)
        return (2 * p[0], 2 * p[1]), (2 * q[0], 2 * q[1])

    def delta(self, circle: Surface, other: Surface) -> Trig:
        if other.edge is not None:
            return -self.offset(other, circle)
        return self.apart(circle, other).plus(self.ring.number(circle.radius**2 - other.radius**2))

    def norm(self, circle: Surface, other: Surface) -> Trig:
        n = self.normal(circle, other)
        return self.trig(dot(n, n))

    def on_both(self, circle: Surface, y: Surface, z: Surface, chart: int) -> list[Polynomial]:
        """Polynomials that vanish if both points of a circle and y are on z."""
        m, n = self.normal(circle, y), self.normal(circle, z)
        d, e, square, both = (
            self.ring.poly(form.coefficients(chart))
            for form in (
                self.delta(circle, y),
                self.delta(circle, z),
                self.norm(circle, y),
                self.trig(dot(m, n)),
            )
        )
        return [d * both - e * square, self.ring.poly(self.trig(cross(m, n)).coefficients(chart))]

    # --- forms that vanish where something happens ---

    def touching(self, x: Surface, y: Surface, side: int) -> Trig:
        """Zero where a line touches a circle or a line's C grown, on one side, or two circles touch."""
        if x.edge is not None:
            return self.offset(x, y).plus(self.ring.number(side * abs(y.radius)) * self.length(x))
        if y.edge is not None:
            return self.touching(y, x, side)
        return self.apart(x, y).plus(-self.ring.number((abs(x.radius) + side * abs(y.radius)) ** 2))

    def joint(self, line: Surface, circle: Surface, on: Surface) -> Trig:
        """Zero where the joint of a line and a circle is on a third surface; inside it is positive on a line."""
        v, length, rho = _along(line), self.length(line), self.radius(circle)
        if on.edge is not None:
            return self.offset(on, circle).times(length) - self.trig(dot(on.edge, v)).times(rho)
        d = on.to(circle)
        rest = self.ring.number(circle.radius**2 - on.radius**2)
        return self.trig(dot(d, d)).plus(rest).times(length) - self.trig(cross(v, d)).times(rho + rho)

    def axis(self, circle: Surface, e: Moving, on: Surface) -> Trig:
        """Zero where the point C + rho e, as the end of a quadrant, is on another surface."""
        if on.joint_end(circle) is not None:
            return self.trig(dot(_along(on), e))
        if on.edge is not None:
            return self.offset(on, circle) + self.trig(cross(on.edge, e)).times(self.radius(circle))
        d, rho = on.to(circle), self.radius(circle)
        rest = self.ring.number(circle.radius**2 - on.radius**2)
        return self.trig(dot(d, d)).plus(rest) + self.trig(dot(d, e)).times(rho + rho)

    def meeting(self, x: Surface, y: Surface, z: Surface, chart: int) -> Polynomial:
        """Polynomial in tau that vanishes where three surfaces have a point in common."""

        def poly(f: Trig) -> Polynomial:
            return self.ring.poly(f.coefficients(chart))

        if len({x.key, y.key, z.key}) < 3:
            raise Fault("an angle at which a surface meets itself")
        for line, circle, on in permutations((x, y, z)):
            if line.joint_end(circle) is not None:
                return poly(self.joint(line, circle, on))
        for circle, other, on in permutations((x, y, z)):
            if (e := circle.touches(other)) is not None:
                return poly(self.axis(circle, e, on))
        lines = [s for s in (x, y, z) if s.edge is not None]
        if len(lines) == 3:
            # sum of (offset constant of each line about x's C) times (cross product of the other two)
            u, v, w = map(_along, (x, y, z))
            own = Trig(self.radius(x) * self.length(x), self.ring.number(fmpq(0)), self.ring.number(fmpq(0)))
            return (
                poly(own) * poly(self.trig(cross(v, w)))
                + poly(self.offset(y, x)) * poly(self.trig(cross(w, u)))
                + poly(self.offset(z, x)) * poly(self.trig(cross(u, v)))
            )
        circle = next(s for s in (x, y, z) if s.edge is None)
        one, two = [s for s in (x, y, z) if s is not circle]
        m, n = self.normal(circle, one), self.normal(circle, two)
        d, e = poly(self.delta(circle, one)), poly(self.delta(circle, two))
        both, c = poly(self.trig(dot(m, n))), poly(self.trig(cross(m, n)))
        zero = self.ring.number(fmpq(0))
        rho = poly(Trig(self.ring.number(circle.radius**2), zero, zero))
        return (
            d * d * poly(self.norm(circle, two))
            + e * e * poly(self.norm(circle, one))
            - (both + both) * d * e
            - rho * c * c
        )


def axis(turns: int) -> Moving:
    """Unit vector, a number of quarter turns from the x axis."""
    return AXES[turns % 4], NIL


def at_turn(e: Moving, turn: Turn) -> tuple[Ball, Ball]:
    """Coordinates of a moving vector at an angle."""
    ((p, q), (r, s)) = e
    return arb(p) - turn.cos * arb(r) + turn.sin * arb(s), arb(q) - turn.sin * arb(r) - turn.cos * arb(s)


def middle(surface: Surface, one: tuple[Ball, Ball], other: tuple[Ball, Ball], turn: Turn) -> tuple[Ball, Ball]:
    """Point half-way between two of a line; of a circle that of the chord, moved away from the center onto it."""
    x, y = (one[0] + other[0]) / 2, (one[1] + other[1]) / 2
    if surface.edge is not None:
        return x, y
    p, q = at_turn((surface.b, surface.a), turn)
    far = abs(arb(surface.radius)) / ((x - p) * (x - p) + (y - q) * (y - q)).sqrt()  # no powers of balls around 0
    return p + far * (x - p), q + far * (y - q)


BALLS = Forms(Balls)
Made = Callable[[Forms], list[Trig]]
Place = Callable[[Turn], Any]


class Curve:
    """The curve that another surface, or the end of a quadrant, leaves on a surface.

    Attributes
    ----------
    limits, existence : functions of `Forms`
        Forms that vanish where the curve passes the ends of its patch, or of its arcs; and where it, or its branches,
        end or meet.
    place : function of an angle
        On a line t times the edge's length, on a circle the unit vector u.
    """

    def __init__(self, on: Surface, quadrant: int, other: Surface | int, branch: int) -> None:
        self.on, self.quadrant, self.other, self.branch = on, quadrant, other, branch
        self.limits, self.existence = self._walls()
        self.square: Callable[[Turn], Ball] | None = None  # positive where two branches exist
        self.place = self._placed()

    @cached_property
    def key(self) -> frozenset[Any]:
        """Name of all curves in which the two surfaces meet."""
        return frozenset([self.on.key, self.other if isinstance(self.other, int) else self.other.key])

    @cached_property
    def name(self) -> Any:
        """The key; of a joint, the line and its end, for all surfaces that have it in common."""
        if not isinstance(self.other, int):
            for line, circle in ((self.on, self.other), (self.other, self.on)):
                if (k := line.joint_end(circle)) is not None:
                    return line.key, line.end(k)
        return self.key

    @cached_property
    def ends(self) -> tuple[tuple[Moving, int], ...]:
        """Directions between which those of a circle's patch are."""
        q = self.quadrant
        return ((axis(q), 1), (axis(q + 1), -1), *self.on.ends)

    def rests(self, place: Any, turn: Turn) -> list[Ball]:
        """Numbers that are positive before, and after, the ends of the patch."""
        if self.on.edge is not None:
            return [place, BALLS.length(self.on) - place]
        rests = []
        for e, sign in self.ends:
            u, v = at_turn(e, turn)
            rests.append(sign * (u * place[1] - v * place[0]))
        return rests

    def _walls(self) -> tuple[Made, Made]:
        x, y = self.on, self.other
        if isinstance(y, int):
            return (lambda f: [f.trig(cross(e, axis(y))) for e, _ in self.ends]), (lambda _: [])
        if x.edge is None:
            limits = lambda f: [f.axis(x, e, y) for e, _ in self.ends]  # noqa: E731
            if y.joint_end(x) is not None:
                return limits, lambda _: []
            return limits, lambda f: [
                f.touching(y, x, 1),
                f.touching(y, x, -1),
                *([f.apart(x, y)] if y.edge is None else []),
            ]
        if x.joint_end(y) is not None:
            return (lambda _: []), (lambda _: [])
        ends = [Surface(*x.end(k), None, x.radius) for k in (0, 1)]
        limits = lambda f: [f.joint(x, end, y) for end in ends]  # noqa: E731
        if y.edge is not None:
            return limits, lambda f: [f.trig(cross(_along(x), _along(y)))]
        return limits, lambda f: [f.touching(x, y, 1), f.touching(x, y, -1)]

    def _placed(self) -> Place:
        x, y, branch = self.on, self.other, self.branch
        f = BALLS
        if isinstance(y, int):
            fixed = tuple(map(arb, AXES[y % 4]))
            return lambda _: fixed
        if x.edge is not None:
            length = f.length(x)
            if (k := x.joint_end(y)) is not None:
                fixed_place = k * length
                return lambda _: fixed_place
            if y.edge is not None:
                # |V| t = (rho_x V . U - |U| offset of x's C from y) / (V x U)
                n = f.trig(dot(y.edge, x.edge)).times(f.radius(x)) - f.offset(y, x).times(length)
                d = f.trig(cross(y.edge, x.edge))
                return lambda turn: n.at(turn) / d.at(turn)
            near, height = f.trig(dot(x.to(y), x.edge)), f.offset(x, y)
            reach = f.radius(y) * length

            def gap(turn: Turn) -> Ball:
                m = height.at(turn)
                return (reach - m) * (reach + m)

            def along(turn: Turn) -> Ball:
                return (near.at(turn) + branch * root(gap(turn))) / length

            self.square = gap

            return along
        if y.joint_end(x) is not None:
            v, over = _along(y), f.length(y)
            coordinates = [f.trig(dot(quarter(v), (e, NIL))) for e in AXES[:2]]
            return lambda turn: tuple(-c.at(turn) / over for c in coordinates)
        toward = f.normal(x, y)
        parts = [f.trig(dot(toward, (e, NIL))) for e in AXES[:2]]
        delta, rho = f.delta(x, y), f.radius(x)
        square = None if y.edge is None else f.radius(x) * arb(y.square)

        def left(turn: Turn) -> Ball:
            p, q, d = parts[0].at(turn), parts[1].at(turn), delta.at(turn)
            return rho * rho * (p * p + q * q) - d * d

        self.square = left

        def around(turn: Turn) -> tuple[Ball, Ball]:
            p, q, d = parts[0].at(turn), parts[1].at(turn), delta.at(turn)
            norm = p * p + q * q
            s = branch * root(rho * rho * norm - d * d)
            over = rho * norm if square is None else square
            return (d * p - s * q) / over, (d * q + s * p) / over

        return around

    @cached_property
    def _start(self) -> tuple[Trig, Trig]:
        x, f = self.on, BALLS
        return tuple(f.trig(dot((x.b, x.a), (e, NIL))) for e in AXES[:2])  # type: ignore[return-value]

    def point(self, turn: Turn) -> tuple[Ball, Ball]:
        """Point of the plane."""
        x, place = self.on, self.place(turn)
        p, q = (c.at(turn) for c in self._start)
        rho = arb(x.radius)
        if x.edge is None:
            return p + rho * place[0], q + rho * place[1]
        u, v = direction(x, turn)
        return p + place * u + rho * v, q + place * v - rho * u


def direction(line: Surface, turn: Turn) -> tuple[Ball, Ball]:
    """Unit vector along a line."""
    (f, g), length = _along(line), BALLS.length(line)
    u, v = arb(f[0]), arb(f[1])
    if g != NIL:
        u, v = u - (turn.cos * arb(g[0]) - turn.sin * arb(g[1])), v - (turn.sin * arb(g[0]) + turn.cos * arb(g[1]))
    return u / length, v / length
