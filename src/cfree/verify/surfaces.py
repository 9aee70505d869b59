"""Contact surfaces, the curves on them, and the polynomials in tau that the names of a boundary file define.

A surface is S(t, theta) = b + t q - R (a + t g): of v-e contacts g = 0, of e-v contacts q = 0. Its direction is
U = q - R g, and the forbidden side is on the left of it. For another surface's U and a vector beta - R alpha,

    U x (beta - R alpha) = q x beta + g x alpha  -  cos (q x alpha + g x beta)  -  sin (q . alpha - g . beta),

and everything below is such a *form* (constant, cos, sin). In chart 0 tau = tan(theta / 2), in chart 1 the sines and
cosines change sign; times 1 + tau^2 a form is a quadratic in tau.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from hashlib import blake2b
from typing import Any

from flint import fmpz_poly

from cfree.exact.algebraic import Exact, Number, Root, at, homogeneous, ratio

Vector = tuple[Exact, Exact]
LineKey = tuple[Exact | None, Exact]  # slope, None if upright, and the place where the line meets an axis
Form = tuple[int, int, int]
ZERO = (0, 0)
WEIGHT = fmpz_poly([1, 0, 1])  # 1 + tau^2


class Fault(Exception):
    """A statement in a file makes no sense; the message gives the reason."""


def digest(*key: Any) -> bytes:
    """32 bytes that stand for an exact key: different keys do not collide in practice."""
    return blake2b(repr(key).encode(), digest_size=32).digest()


def cross(u: Vector, v: Vector) -> Exact:
    return u[0] * v[1] - u[1] * v[0]


def dot(u: Vector, v: Vector) -> Exact:
    return u[0] * v[0] + u[1] * v[1]


def minus(u: Vector, v: Vector) -> Vector:
    return u[0] - v[0], u[1] - v[1]


@dataclass(frozen=True, slots=True)
class Surface:
    """S(t, theta) = b + t q - R (a + t g); a contact where all of `limits` are negative."""

    a: Vector
    g: Vector
    b: Vector
    q: Vector
    limits: tuple[Form, ...] = ()

    def form(self, beta: Vector, alpha: Vector) -> Form:
        """U x (beta - R alpha)."""
        q, g = self.q, self.g
        return cross(q, beta) + cross(g, alpha), -cross(q, alpha) - cross(g, beta), dot(g, beta) - dot(q, alpha)


class Turn:
    """The rotation at a critical or rational angle: cos = c / w, sin = s / w, in integers if tau is rational."""

    def __init__(self, chart: int, root: Root) -> None:
        self.chart, self.root, self.tau = chart, root, root.value
        p, q = (self.tau.numerator, self.tau.denominator) if isinstance(self.tau, Fraction) else (self.tau, 1)
        half_turn = -1 if chart else 1
        self.c, self.s, self.w = half_turn * (q * q - p * p), half_turn * 2 * p * q, q * q + p * p

    @classmethod
    def of(cls, chart: int, tau: Fraction) -> Turn:
        return cls(chart, Root.of(tau))

    @cached_property
    def key(self) -> tuple[Any, ...]:
        return angle_key(self.chart, self.root)

    def in_charts(self) -> list[tuple[int, Root]]:
        """Angle in its chart, or in both."""
        other = [(1 - self.chart, Root.of(-self.tau))] if self.tau in (1, -1) else []
        return [(self.chart, self.root), *other]

    @cached_property
    def rounded(self) -> Turn:
        """Rational angle beside it, for rough searches, never for a decision."""
        while self.root.hi - self.root.lo > Fraction(1, 1 << 60):
            self.root.narrow()
        return Turn.of(self.chart, self.root.lo)

    def __str__(self) -> str:
        return f"tau {self.tau if isinstance(self.tau, Fraction) else float(self.root.lo)} in chart {self.chart}"

    def __call__(self, v: Vector) -> Vector:
        """w R v."""
        return self.c * v[0] - self.s * v[1], self.s * v[0] + self.c * v[1]

    def value(self, form: Form) -> Exact:
        """w times the form."""
        return form[0] * self.w + form[1] * self.c + form[2] * self.s

    def fixed(self, v: Vector) -> Vector:
        """w v."""
        return self.w * v[0], self.w * v[1]

    def line(self, surface: Surface) -> Line:
        """Line from w S(0, theta) along w U."""
        return Line(minus(self.fixed(surface.b), self(surface.a)), minus(self.fixed(surface.q), self(surface.g)))


def angle_key(chart: int, root: Root) -> tuple[Any, ...]:
    """Key, equal for equal angles: the charts share their ends."""
    if root.value in (1, -1):
        return ("end", chart == (root.value < 0))
    return chart, *root.key


class Line:
    """start + t along, both times w. A *position* on it is w x, or w y if it is upright."""

    def __init__(self, start: Vector, along: Vector) -> None:
        self.start, self.along = start, along
        self.axis = 1 if along[0] == 0 else 0

    @cached_property
    def key(self) -> LineKey:
        (x, y), (u, v) = self.start, self.along
        slope = None if self.axis else ratio(v, u)
        return slope, x if slope is None else y - slope * x

    @property
    def ascends(self) -> bool:
        """True if positions grow with t."""
        return bool(self.along[self.axis] > 0)

    def position(self, t: Exact) -> Exact:
        return self.start[self.axis] + t * self.along[self.axis]

    def point(self, t: Exact) -> Vector:
        return self.start[0] + t * self.along[0], self.start[1] + t * self.along[1]


def point_at(key: LineKey, position: Exact) -> Vector:
    """w times the point of a line at a position."""
    slope, offset = key
    return (offset, position) if slope is None else (position, slope * position + offset)


def position_of(key: LineKey, point: Vector) -> Exact | None:
    """Position of a point on a line, None if it is beside it."""
    position = point[1 if key[0] is None else 0]
    return position if point_at(key, position) == point else None


def polynomial(form: Form, chart: int) -> fmpz_poly:
    """(1 + tau^2) times the form."""
    a, b, c = form if chart == 0 else (form[0], -form[1], -form[2])
    return fmpz_poly([a + b, 2 * c, a - b])


def meeting(surface: Surface, other: Surface) -> tuple[Form, Form]:
    """Numerator and denominator of t where another surface's line meets this one's; both vanish if it is parallel."""
    n, d = other.form(minus(surface.b, other.b), minus(surface.a, other.a)), other.form(surface.q, surface.g)
    return (-n[0], -n[1], -n[2]), d


def cut(surface: Surface, other: Surface) -> tuple[Form, Form]:
    """`meeting`, of surfaces that are not parallel at every angle."""
    n, d = meeting(surface, other)
    if not any(d):
        raise Fault("a curve is cut out by a surface that is parallel at every angle")
    return n, d


def helix(surface: Surface, a: Vector, b: Vector) -> tuple[Form, Form]:
    """Numerator and denominator of t where a vertex pair's helix lies on the surface."""
    alpha, beta = minus(a, surface.a), minus(b, surface.b)
    if (alpha, beta) in ((ZERO, ZERO), (surface.g, surface.q)):  # one of its ends
        return (int((alpha, beta) != (ZERO, ZERO)), 0, 0), (1, 0, 0)
    n, d = dot(beta, surface.q) + dot(alpha, surface.g), dot(surface.q, surface.q) + dot(surface.g, surface.g)
    on_it = all(
        d * x == n * u
        for start, along in ((beta, surface.q), (alpha, surface.g))
        for x, u in zip(start, along, strict=True)
    )
    if not on_it:
        raise Fault("a helix that bounds t does not lie on the surface")
    return (n, 0, 0), (d, 0, 0)


class Moving:
    """Line of a surface as tau changes in a chart: S(0) and U as polynomials, times 1 + tau^2, and so U x S(0)."""

    __slots__ = ("across", "along", "chart", "limits", "start", "surface")

    def __init__(self, surface: Surface, chart: int) -> None:
        self.surface, self.chart = surface, chart
        (ax, ay), (gx, gy), (bx, by), (qx, qy) = surface.a, surface.g, surface.b, surface.q
        self.start = polynomial((bx, -ax, ay), chart), polynomial((by, -ay, -ax), chart)
        self.along = polynomial((qx, -gx, gy), chart), polynomial((qy, -gy, -gx), chart)
        self.across = polynomial(surface.form(surface.b, surface.a), chart)
        self.limits = [polynomial(limit, chart) for limit in surface.limits]

    def key(self, tau: Exact) -> LineKey:
        """Line at an angle; equal for equal lines. The places (x, y) on it have U x (x, y) = U x S(0)."""
        u, v = (at(poly, tau) for poly in self.along)
        if u == 0:
            return None, ratio(-at(self.across, tau), v)
        inverse = ratio(1, u)
        return v * inverse, at(self.across, tau) * inverse

    def line(self, angle: Root) -> tuple[int, bytes]:
        """Axis of positions on the line at an angle, and a digest of both."""
        slope, place = self.key(angle.value)
        plain = [x.key if isinstance(x, Number) else x for x in (slope, place)]
        return int(slope is None), digest(angle_key(self.chart, angle), *plain)


class Curve:
    """Curve t = n / d on a surface in a chart, in lowest terms; `key` is made of its reference points (x : y : z)."""

    __slots__ = ("_coefficients", "_digest", "d", "key", "n", "point")

    def __init__(self, moving: Moving, t: tuple[Form, Form]) -> None:
        n, d = (polynomial(form, moving.chart) for form in t)
        if not (common := n.gcd(d)).is_one():
            n, d = n // common, d // common
        self.n, self.d = n, d
        self._digest: bytes | None = None
        self._coefficients = [int(c) for c in n.coeffs()], [int(c) for c in d.coeffs()]
        x, y = (start * d + along * n for start, along in zip(moving.start, moving.along, strict=True))
        z = WEIGHT * d
        common = z.gcd(x).gcd(y)
        if z.leading_coefficient() < 0:
            common = -common
        self.point = (x, y, z) if common.is_one() else (x // common, y // common, z // common)
        self.key = moving.chart, *(tuple(map(int, poly.coeffs())) for poly in self.point)

    @property
    def digest(self) -> bytes:
        if self._digest is None:
            self._digest = digest(self.key)
        return self._digest

    def place(self, axis: int, tau: Exact) -> Exact:
        """Coordinate x or y of its reference point at an angle."""
        z = at(self.point[2], tau)
        if z == 0:
            raise Fault("a curve leaves the surface's line to infinity")
        return ratio(at(self.point[axis], tau), z)

    def at(self, tau: Exact) -> Exact:
        """t at an angle."""
        if isinstance(tau, Fraction):
            (n, below), (d, beside) = (homogeneous(poly, tau) for poly in self._coefficients)
            if d == 0:
                raise Fault("a curve leaves the surface's line to infinity")
            return Fraction(n * beside, d * below)
        d = at(self.d, tau)
        if d == 0:
            raise Fault("a curve leaves the surface's line to infinity")
        return at(self.n, tau) / d
