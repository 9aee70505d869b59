"""The core's predicates again, in plain Python: a second opinion for comparison with the core.

It is written from ``docs/theory/lines.md`` and ``docs/theory/degrees.md``, with the names of
``cfree/predicates/predicates.hpp``. Numbers are integers, fractions and polynomials in tau (python-flint). A critical
angle is a root of an irreducible polynomial. So two are equal exactly if the polynomial and the place among its roots
are. No float decides anything.

In chart k, tau = tan((theta - k pi) / 2) is in [-1, 1]. Everything is multiplied by w = 1 + tau^2 > 0:

    w R = (-1)^k (1 - tau^2, -2 tau; 2 tau, 1 - tau^2).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cmp_to_key, lru_cache
from itertools import pairwise
from typing import NamedTuple

from flint import fmpq, fmpq_poly, fmpz_poly

Point = tuple[int, int]
Vector = tuple[fmpz_poly, fmpz_poly]
NONE, VERTEX_EDGE, EDGE_VERTEX, VERTEX_VERTEX, EDGE_EDGE = range(5)
W = fmpz_poly([1, 0, 1])


class Feature(NamedTuple):
    kind: int
    robot: int
    obstacle: int


class Shape(NamedTuple):
    vertices: Sequence[Point]
    edges: Sequence[tuple[int, int]]

    def edge(self, e: int) -> Point:
        v, w = self.edges[e]
        return minus(self.vertices[w], self.vertices[v])


def minus(p: Point, q: Point) -> Point:
    return p[0] - q[0], p[1] - q[1]


def cross(p: tuple, q: tuple):
    return p[0] * q[1] - p[1] * q[0]


def dot(p: tuple, q: tuple):
    return p[0] * q[0] + p[1] * q[1]


def sign(x) -> int:
    return (x > 0) - (x < 0)


def rational(x: Fraction) -> fmpq:
    return fmpq(x.numerator, x.denominator)


# --- real roots ---


class Angle:
    """A critical tau: a root of an irreducible polynomial, between lo and hi, and only that one there.

    `place` numbers the polynomial's roots in [-2, 2]. A rational tau has lo = hi; any other is strictly between.
    """

    def __init__(self, polynomial: fmpz_poly, lo: Fraction, hi: Fraction, place: int = 0) -> None:
        self.polynomial, self.lo, self.hi, self.place = polynomial, lo, hi, place

    @classmethod
    def of(cls, tau: Fraction) -> Angle:
        return cls(fmpz_poly([-tau.numerator, tau.denominator]), tau, tau)

    def halve(self) -> None:
        if self.lo == self.hi:
            return
        mid = (self.lo + self.hi) / 2
        left = sign(self.polynomial(rational(self.lo)))
        if sign(self.polynomial(rational(mid))) == left:
            self.lo = mid
        else:
            self.hi = mid

    def compare(self, other: Angle) -> int:
        if self.polynomial == other.polynomial:
            return sign(self.place - other.place)
        while self.lo <= other.hi and other.lo <= self.hi:
            self.halve()
            other.halve()
        return -1 if self.hi < other.lo else 1

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Angle) and self.compare(other) == 0

    def __lt__(self, other: Angle) -> bool:
        return self.compare(other) < 0

    def __repr__(self) -> str:
        return f"Angle({self.polynomial}, {float(self.lo)!r})"


FIRST, LAST = Angle.of(Fraction(-1)), Angle.of(Fraction(1))


def rational_between(x: Angle, y: Angle) -> Fraction:
    while not x.hi < y.lo:
        x.halve()
        y.halve()
    return (x.hi + y.lo) / 2


def sign_after(polynomial: fmpz_poly, x: Angle) -> int:
    """Sign of a polynomial that is not zero, just after an angle in (-2, 2)."""
    next_root = next((root.angle for root in real_roots(polynomial) if x < root.angle), Angle.of(Fraction(2)))
    return sign(polynomial(rational(rational_between(x, next_root))))


def sign_before(polynomial: fmpz_poly, x: Angle) -> int:
    """Sign of a polynomial that is not zero, just before an angle in (-2, 2)."""
    before = [root.angle for root in real_roots(polynomial) if root.angle < x]
    last_root = before[-1] if before else Angle.of(Fraction(-2))
    return sign(polynomial(rational(rational_between(last_root, x))))


def sign_at(polynomial: fmpz_poly, x: Angle) -> int:
    rest = (fmpq_poly(polynomial) % fmpq_poly(x.polynomial)).numer()  # over a positive denominator
    return 0 if rest == 0 else sign_after(rest, x)


class Root(NamedTuple):
    angle: Angle
    multiplicity: int


def real_roots(polynomial: fmpz_poly) -> list[Root]:
    """Roots in [-2, 2] of a polynomial that is not zero, in order."""
    return list(_real_roots(tuple(int(c) for c in polynomial.coeffs())))


@lru_cache(maxsize=20000)
def _real_roots(coefficients: tuple[int, ...]) -> tuple[Root, ...]:
    _, factors = fmpz_poly(list(coefficients)).factor()
    roots = []
    for factor, multiplicity in factors:
        normal = factor if factor[factor.degree()] > 0 else -factor
        if normal.degree() == 1:
            tau = Fraction(-int(normal[0]), int(normal[1]))
            if abs(tau) <= 2:
                roots.append(Root(Angle(normal, tau, tau), multiplicity))
        elif normal.degree() > 1:
            parts = isolating(normal, sturm_chain(normal), Fraction(-2), Fraction(2))
            roots += [Root(Angle(normal, lo, hi, place), multiplicity) for place, (lo, hi) in enumerate(parts)]
    return tuple(sorted(roots, key=cmp_to_key(lambda x, y: x.angle.compare(y.angle))))


def sturm_chain(polynomial: fmpz_poly) -> list[fmpq_poly]:
    chain = [fmpq_poly(polynomial), fmpq_poly(polynomial.derivative())]
    while chain[-1].degree() > 0:
        chain.append(-(chain[-2] % chain[-1]))
    return chain


def isolating(
    polynomial: fmpz_poly, chain: list[fmpq_poly], lo: Fraction, hi: Fraction
) -> list[tuple[Fraction, Fraction]]:
    """Intervals with one root each; the ends are none."""

    def variations(tau: Fraction) -> int:
        signs = [s for s in (sign(p(rational(tau))) for p in chain) if s]
        return sum(s != t for s, t in pairwise(signs))

    count = variations(lo) - variations(hi)
    if count <= 1:
        return [(lo, hi)] * count
    mid = (lo + hi) / 2
    return isolating(polynomial, chain, lo, mid) + isolating(polynomial, chain, mid, hi)


# --- identity ---


def same_feature(robot: Shape, obstacles: Shape, x: Feature, y: Feature) -> bool:
    """True if `code` is the same: one vertex by its point, one edge by its directed line, parallels by direction."""

    def same_point(s: Shape, p: int, q: int) -> bool:
        return s.vertices[p] == s.vertices[q]

    def parallel(s: Shape, e: int, f: int) -> bool:
        return cross(s.edge(e), s.edge(f)) == 0

    def same_line(s: Shape, e: int, f: int) -> bool:
        apart = minus(s.vertices[s.edges[f][0]], s.vertices[s.edges[e][0]])
        return parallel(s, e, f) and dot(s.edge(e), s.edge(f)) > 0 and cross(s.edge(e), apart) == 0

    if x.kind != y.kind:
        return False
    if x.kind == NONE:
        return True
    of_robot = {VERTEX_EDGE: same_point, EDGE_VERTEX: same_line, VERTEX_VERTEX: same_point, EDGE_EDGE: parallel}
    of_obstacle = {VERTEX_EDGE: same_line, EDGE_VERTEX: same_point, VERTEX_VERTEX: same_point, EDGE_EDGE: parallel}
    return of_robot[x.kind](robot, x.robot, y.robot) and of_obstacle[x.kind](obstacles, x.obstacle, y.obstacle)


# --- predicates on one surface in one chart ---


class Predicates:
    """Signs and orders on the contact surface (kind, i, j), kind being VERTEX_EDGE or EDGE_VERTEX."""

    def __init__(self, robot: Shape, obstacles: Shape, contact: Feature, chart: int) -> None:
        self.A, self.O, self.contact = robot, obstacles, contact
        turn = -1 if chart else 1
        self.c, self.s = fmpz_poly([turn, 0, -turn]), fmpz_poly([0, 2 * turn])
        self.on_edge = contact.kind == VERTEX_EDGE
        # the line P + t U at tau, both times w; forbidden on its left
        i, j = contact.robot, contact.obstacle
        if self.on_edge:
            self.P, self.U = self.placed(i, obstacles.edges[j][0]), self.fixed(obstacles.edge(j))
        else:
            x, y = self.turned(robot.edge(i))
            self.P, self.U = self.placed(robot.edges[i][0], j), (-x, -y)

    def turned(self, u: Point) -> Vector:
        return self.c * u[0] - self.s * u[1], self.s * u[0] + self.c * u[1]

    def fixed(self, u: Point) -> Vector:
        return W * u[0], W * u[1]

    def placed(self, s: int, v: int) -> Vector:
        """Position b_v - R a_s of the reference point when robot vertex s is at obstacle vertex v, times w."""
        b, a = self.fixed(self.O.vertices[v]), self.turned(self.A.vertices[s])
        return b[0] - a[0], b[1] - a[1]

    def offset(self, s: int, v: int) -> fmpz_poly:
        """Offset of b_v - R a_s from the line, positive on its left, times w: a quadratic."""
        x, y = self.placed(s, v)
        return exact_quotient(cross(self.U, (x - self.P[0], y - self.P[1])))

    def parallel(self, g: int, f: int) -> fmpz_poly:
        """R E_g x E_f, times w: a quadratic."""
        return cross(self.turned(self.A.edge(g)), self.O.edge(f))

    def curve(self, feature: Feature) -> tuple[fmpz_poly, fmpz_poly]:
        """N and D of the curve t = N / D, both times w: quadratics."""
        kind, i, j = feature
        if kind == VERTEX_VERTEX:  # a helix in the surface: where its vertex is on the edge
            shape, e, v = (self.O, self.contact.obstacle, j) if self.on_edge else (self.A, self.contact.robot, i)
            edge = shape.edge(e)
            along = minus(shape.vertices[v], shape.vertices[shape.edges[e][0]])
            return W * dot(along, edge), W * dot(edge, edge)
        if kind == VERTEX_EDGE:  # along E_j through b_j - R a_i
            Q, V = self.placed(i, self.O.edges[j][0]), self.fixed(self.O.edge(j))
        else:  # along -R E_i
            x, y = self.turned(self.A.edge(i))
            Q, V = self.placed(self.A.edges[i][0], j), (-x, -y)
        away = self.P[0] - Q[0], self.P[1] - Q[1]
        return exact_quotient(-cross(V, away)), exact_quotient(cross(V, self.U))

    def polynomial(self, first: Feature, second: Feature) -> fmpz_poly:
        """Polynomial whose root is the angle that two features define; see `Event` in predicates.hpp."""
        if second.kind != NONE:
            (N1, D1), (N2, D2) = self.curve(first), self.curve(second)
            return N1 * D2 - N2 * D1
        if first.kind == EDGE_EDGE:
            return self.parallel(first.robot, first.obstacle)
        return self.offset(first.robot, first.obstacle)

    # signs

    @staticmethod
    def sign_on(polynomial: fmpz_poly, lo: Fraction, hi: Fraction) -> int:
        """The sign, if there is one on the whole closed interval, within [-2, 2]; else 0."""
        if polynomial == 0 or any(
            r.angle.compare(Angle.of(lo)) >= 0 >= r.angle.compare(Angle.of(hi)) for r in real_roots(polynomial)
        ):
            return 0
        return sign(polynomial(rational(lo)))

    def offset_sign(self, s: int, v: int, tau: Fraction) -> int:
        return sign(self.offset(s, v)(rational(tau)))

    def parallel_sign(self, g: int, f: int, tau: Fraction) -> int:
        return sign(self.parallel(g, f)(rational(tau)))

    def cross_sign(self, of_robot: bool, e: int, f: int) -> int:
        shape = self.A if of_robot else self.O
        return sign(cross(shape.edge(e), shape.edge(f)))

    # angles

    @staticmethod
    def order(x: Angle, y: Angle | Fraction) -> int:
        return x.compare(Angle.of(y) if isinstance(y, Fraction) else y)

    @staticmethod
    def between(x: Angle, y: Angle) -> Fraction:
        return rational_between(x, y)

    def roots_within(self, first: Feature, second: Feature, lo: Fraction, hi: Fraction) -> list[Angle]:
        """All angles that an event may mean: different roots of its polynomial in a closed interval."""
        if first.kind == NONE:
            return [Angle.of(lo)]
        angles = [root.angle for root in real_roots(self.polynomial(first, second))]
        return [x for x in angles if x.compare(Angle.of(lo)) >= 0 >= x.compare(Angle.of(hi))]

    def place(self, x: Angle, first: Feature, second: Feature, lo: Fraction, hi: Fraction) -> int:
        """Place of an angle: 0 if it is alone in its interval, else its number there, from 1."""
        angles = self.roots_within(first, second, lo, hi)
        return 0 if len(angles) == 1 else 1 + angles.index(x)

    # roots between two angles

    @staticmethod
    def roots(polynomial: fmpz_poly, from_: Angle, to: Angle) -> list[Angle]:
        """Roots of a polynomial that is not zero, strictly between two angles, touches included."""
        return [x for x, _ in real_roots(polynomial) if from_ < x and x < to]

    def offset_roots(self, s: int, v: int, from_: Angle, to: Angle) -> tuple[list[Angle], bool]:
        polynomial = self.offset(s, v)
        return ([], True) if polynomial == 0 else (self.roots(polynomial, from_, to), False)

    def parallel_roots(self, g: int, f: int, from_: Angle, to: Angle) -> tuple[list[Angle], bool]:
        return self.roots(self.parallel(g, f), from_, to), False

    def compare(self, p: Feature, q: Feature, from_: Angle, to: Angle) -> tuple[list[Angle], list[int]]:
        """Meetings of two curves, and signs of t_p - t_q before, between and after; both are finite in between."""
        difference = self.polynomial(p, q)
        cuts = [] if difference == 0 else self.roots(difference, from_, to)
        samples = [rational_between(x, y) for x, y in pairwise([from_, *cuts, to])]
        return cuts, [self.order_at(p, q, tau) for tau in samples]

    def order_at(self, p: Feature, q: Feature, tau: Fraction) -> int:
        """Order of two curves at a tau where both are finite."""
        (N1, D1), (N2, D2) = self.curve(p), self.curve(q)
        x = rational(tau)
        return sign(N1(x) / D1(x) - N2(x) / D2(x))

    def range_end(self, g: int, f: int, is_start: bool) -> tuple[int, Angle]:
        """Chart and tau of the angle from E_g to -E_f; at the end of a chart those of the range that starts or ends."""
        G, F = self.A.edge(g), self.O.edge(f)
        x, y = -dot(G, F), -cross(G, F)  # |G| |F| (cos, sin) of the angle
        if x == 0:  # a quarter turn ends chart 0 and starts chart 1
            chart = int(y > 0) if is_start else int(y < 0)
            return chart, FIRST if is_start else LAST
        chart = int(x < 0)
        # sin(theta) x = cos(theta) y
        polynomial = fmpz_poly([0, 2]) * x - fmpz_poly([1, 0, -1]) * y
        return chart, Predicates.roots(polynomial, FIRST, LAST)[0]


# --- several surfaces at one critical angle ---

Place = tuple[fmpz_poly, fmpz_poly, fmpz_poly]  # x and y over a denominator that is not zero at the angle


class Junction:
    """Contact lines at one critical angle, and just before and after it."""

    def __init__(self, robot: Shape, obstacles: Shape, chart: int, angle: Angle) -> None:
        self.angle = angle
        self.on = lru_cache(maxsize=None)(lambda contact: Predicates(robot, obstacles, contact, chart))

    def sign(self, polynomial: fmpz_poly) -> int:
        return sign_at(polynomial, self.angle)

    def turn(self, x: Feature, y: Feature) -> int:
        """Side of the direction of y from that of x: 1 to its left, -1 to its right, 0 parallel."""
        return self.sign(cross(self.on(x).U, self.on(y).U))

    def parallel(self, x: Feature, y: Feature) -> int:
        """Parallelism: 1 the same direction, -1 the opposite, 0 not parallel."""
        U, V = self.on(x).U, self.on(y).U
        return 0 if self.sign(cross(U, V)) else self.sign(dot(U, V))

    def side(self, x: Feature, y: Feature) -> int:
        """Side of parallel lines: y is left of x (1), right of it (-1), or on it (0)."""
        return self.side_of_place(x, (*self.on(y).P, fmpz_poly([1])))

    def side_of_helix(self, x: Feature, a: int, b: int) -> int:
        return self.sign(self.on(x).offset(a, b))

    def place(self, surface: Feature, curve: Feature) -> Place | None:
        """Place where a curve on a surface arrives, by continuity; None if that is at infinity."""
        on = self.on(surface)
        N, D = on.curve(curve)
        if D == 0:
            return None
        common = N.gcd(D)
        N, D = N // common, D // common
        return None if self.sign(D) == 0 else (on.P[0] * D + on.U[0] * N, on.P[1] * D + on.U[1] * N, D)

    @staticmethod
    def same_place(p: Place, q: Place) -> bool:
        """True if the curves are one at every angle."""
        return all(p[k] * q[2] == q[k] * p[2] for k in (0, 1))

    def lies_on(self, place: Place, surface: Feature) -> bool:
        """True if the curve is on a surface at every angle."""
        (X, Y, D), on = place, self.on(surface)
        return bool(cross(on.U, (X - on.P[0] * D, Y - on.P[1] * D)) == 0)

    def side_of_place(self, x: Feature, place: Place) -> int:
        (X, Y, D), on = place, self.on(x)
        return self.sign(cross(on.U, (X - on.P[0] * D, Y - on.P[1] * D))) * self.sign(D)

    def along(self, line: Feature, place: Place) -> tuple[fmpz_poly, fmpz_poly]:
        """Numerator and denominator of t on a line through a place."""
        (X, Y, D), on = place, self.on(line)
        return dot(on.U, (X - on.P[0] * D, Y - on.P[1] * D)), dot(on.U, on.U) * D

    def order(self, line: Feature, p: Place, q: Place) -> int:
        (n, d), (m, e) = self.along(line, p), self.along(line, q)
        return self.sign(n * e - m * d) * self.sign(d) * self.sign(e)

    def order_to(self, line: Feature, place: Place, t: Fraction) -> int:
        """Order of a place and the one at t."""
        n, d = self.along(line, place)
        return self.sign(n * t.denominator - t.numerator * d) * self.sign(d)

    def is_on_patch(self, line: Feature, place: Place) -> bool:
        n, d = self.along(line, place)
        return self.sign(n) * self.sign(d) >= 0 and self.sign(d - n) * self.sign(d) >= 0

    def across(self, x: Feature, y: Feature, p: Place, q: Place, after: bool) -> int:
        """Side of x from y, with one line here, between two places, just after or before the angle; 1 is left."""
        t = self.rational_between(x, p, q)
        u, v = self.on(x), self.on(y)
        point = [c * t.denominator + t.numerator * d for c, d in zip(u.P, u.U, strict=True)]
        offset = cross(v.U, tuple(c - t.denominator * d for c, d in zip(point, v.P, strict=True)))
        if offset == 0:
            return 0
        return sign_after(offset, self.angle) if after else sign_before(offset, self.angle)

    def rational_between(self, line: Feature, p: Place, q: Place) -> Fraction:
        """A rational t strictly between two different places on a line."""

        def orders(t: Fraction) -> list[int]:
            pairs = (self.along(line, place) for place in (p, q))
            return [self.sign(n * t.denominator - t.numerator * d) * self.sign(d) for n, d in pairs]

        hi = Fraction(1)
        while sum(orders(hi)) > -2 or sum(orders(-hi)) < 2:
            hi *= 2
        lo = -hi
        while True:
            mid = (lo + hi) / 2
            both = orders(mid)
            if 0 not in both and sum(both) == 0:
                return mid
            lo, hi = (mid, hi) if sum(both) > 0 else (lo, mid)

    def value(self, line: Feature, place: Place) -> Fraction:
        """Approximate t of a place."""
        n, d = self.along(line, place)
        x = Angle(self.angle.polynomial, self.angle.lo, self.angle.hi)
        least = Fraction(1, 2**40)
        while True:
            lo = rational(x.lo)
            if d(lo):
                t = n(lo) / d(lo)
                middle = Fraction(int(t.p), int(t.q))
                sides = (n * b.denominator - b.numerator * d for b in (middle - least, middle + least))
                below, above = (self.sign(side) * self.sign(d) for side in sides)
                if below > 0 > above:
                    return middle
            for _ in range(32):
                x.halve()


def exact_quotient(polynomial: fmpz_poly) -> fmpz_poly:
    """Divide by w a polynomial that was multiplied by w twice."""
    quotient, remainder = divmod(polynomial, W)
    assert remainder == 0
    return quotient
