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

from flint import fmpz_poly

Vector = tuple[int, int]
Form = tuple[int, int, int]
ZERO = (0, 0)


class Fault(Exception):
    """What a file says does not make sense; the message says why."""


def cross(u: Vector, v: Vector) -> int:
    return u[0] * v[1] - u[1] * v[0]


def dot(u: Vector, v: Vector) -> int:
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


@dataclass(frozen=True, slots=True)
class Turn:
    """The rotation of a rational tau in a chart: cos = c / w, sin = s / w, in integers."""

    chart: int
    tau: Fraction
    c: int
    s: int
    w: int

    @classmethod
    def of(cls, chart: int, tau: Fraction) -> Turn:
        p, q, half_turn = tau.numerator, tau.denominator, -1 if chart else 1
        return cls(chart, tau, half_turn * (q * q - p * p), half_turn * 2 * p * q, q * q + p * p)

    def __call__(self, v: Vector) -> Vector:
        """w R v."""
        return self.c * v[0] - self.s * v[1], self.s * v[0] + self.c * v[1]

    def value(self, form: Form) -> int:
        """w times the form."""
        return form[0] * self.w + form[1] * self.c + form[2] * self.s

    def start(self, surface: Surface) -> Vector:
        """w S(0, theta)."""
        (x, y), (bx, by) = self(surface.a), surface.b
        return self.w * bx - x, self.w * by - y

    def along(self, surface: Surface) -> Vector:
        """w U."""
        (x, y), (qx, qy) = self(surface.g), surface.q
        return self.w * qx - x, self.w * qy - y


def polynomial(form: Form, chart: int) -> fmpz_poly:
    """(1 + tau^2) times the form."""
    a, b, c = form if chart == 0 else (form[0], -form[1], -form[2])
    return fmpz_poly([a + b, 2 * c, a - b])


def cut(surface: Surface, other: Surface) -> tuple[Form, Form]:
    """Numerator and denominator of t where another surface's line meets this one's."""
    n, d = other.form(minus(surface.b, other.b), minus(surface.a, other.a)), other.form(surface.q, surface.g)
    if not any(d):
        raise Fault("a curve is cut out by a surface that is parallel at every angle")
    return (-n[0], -n[1], -n[2]), d


def helix(surface: Surface, a: Vector, b: Vector) -> tuple[Form, Form]:
    """Numerator and denominator of t where a vertex pair's helix lies on the surface."""
    alpha, beta = minus(a, surface.a), minus(b, surface.b)
    n, d = dot(beta, surface.q) + dot(alpha, surface.g), dot(surface.q, surface.q) + dot(surface.g, surface.g)
    on_it = all(
        d * x == n * u for at, along in ((beta, surface.q), (alpha, surface.g)) for x, u in zip(at, along, strict=True)
    )
    if not on_it:
        raise Fault("a helix that bounds t does not lie on the surface")
    return (n, 0, 0), (d, 0, 0)


class Curve:
    """t = n / d on a surface in a chart, in lowest terms, and the reference points (x : y : z) along it."""

    __slots__ = ("d", "key", "n", "x", "y", "z")

    def __init__(self, surface: Surface, chart: int, t: tuple[Form, Form]) -> None:
        n, d = (polynomial(form, chart) for form in t)
        common = n.gcd(d)
        self.n, self.d = n // common, d // common
        (ax, ay), (gx, gy), (bx, by), (qx, qy) = surface.a, surface.g, surface.b, surface.q
        x0, x1 = polynomial((bx, -ax, ay), chart), polynomial((qx, -gx, gy), chart)
        y0, y1 = polynomial((by, -ay, -ax), chart), polynomial((qy, -gy, -gx), chart)
        point = [x0 * self.d + x1 * self.n, y0 * self.d + y1 * self.n, fmpz_poly([1, 0, 1]) * self.d]
        common = point[0].gcd(point[1]).gcd(point[2])
        if (point[2] // common).leading_coefficient() < 0:
            common = -common
        self.x, self.y, self.z = (p // common for p in point)
        self.key = chart, *(tuple(map(int, p.coeffs())) for p in (self.x, self.y, self.z))

    def at(self, tau: Fraction) -> Fraction:
        """t at a rational angle."""
        n, d = (sum(int(k) * tau**power for power, k in enumerate(p.coeffs())) for p in (self.n, self.d))
        if d == 0:
            raise Fault("a curve leaves the surface's line to infinity")
        return Fraction(n) / Fraction(d)
