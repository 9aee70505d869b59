"""Trapezoids of a boundary, exactly: poses on them at rational t and tau, rational ends included."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

from flint import fmpq, fmpq_poly

from cfree.contact.kind import Kind
from cfree.exact.half_angle import half_angle_rotation, tau_in_chart, theta_in
from cfree.exact.number import simplest_between
from cfree.exact.pose import Pose
from cfree.scene.features import SceneFeatures, ShapeFeatures, unpacked

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary

FINEST = 32  # bits of tau that doubles are trusted with
AngleOf = Callable[[int, bool, int], tuple[Fraction, Fraction]]
Vector = tuple[Fraction, Fraction]
Line = tuple[Vector, Vector, Vector, Vector]  # p, q, a, g of a surface
Contact = tuple[int, int, int]  # kind, robot feature, obstacle feature
Curve = tuple[fmpq_poly, fmpq_poly]


def between(low: Fraction, high: Fraction) -> Fraction:
    """A simple fraction in the middle half of an interval."""
    quarter = (high - low) / 4
    return simplest_between(low + quarter, high - quarter)


def cross(u: Vector, v: Vector) -> Fraction:
    return u[0] * v[1] - u[1] * v[0]


def dot(u: Vector, v: Vector) -> Fraction:
    return u[0] * v[0] + u[1] * v[1]


def minus(u: Vector, v: Vector) -> Vector:
    return u[0] - v[0], u[1] - v[1]


def vertex(shape: ShapeFeatures, index: int, scale: int) -> Vector:
    """Coordinates of a vertex."""
    x, y = shape.vertices[int(index)]
    return Fraction(x, scale), Fraction(y, scale)


def contact_line(features: SceneFeatures, kind: int, i: int, j: int) -> Line:
    """p, q, a, g of a contact surface, by the features that touch."""
    A, O, scale = features.robot, features.obstacles, features.scale
    zero = Fraction(0), Fraction(0)
    if kind == Kind.VERTEX_EDGE:
        p = vertex(O, O.v[j], scale)
        return p, minus(vertex(O, O.w[j], scale), p), vertex(A, i, scale), zero
    a = vertex(A, A.v[i], scale)
    return vertex(O, j, scale), zero, a, minus(vertex(A, A.w[i], scale), a)


def positions(line: Line, tau: Fraction | None) -> tuple[Vector, Vector]:
    """P and U: positions P + t U of contact at an orientation."""
    p, q, a, g = line
    c, s, w = half_angle_rotation(tau)

    def turned(v: Vector) -> Vector:
        return (c * v[0] - s * v[1]) / w, (s * v[0] + c * v[1]) / w

    return minus(p, turned(a)), minus(q, turned(g))


def as_flint(value: Fraction) -> fmpq:
    return fmpq(value.numerator, value.denominator)


def as_fraction(value: fmpq) -> Fraction:
    return Fraction(int(value.p), int(value.q))


def positions_over(line: Line, cosine: fmpq_poly, sine: fmpq_poly, whole: fmpq_poly) -> tuple[Curve, Curve]:
    """P and U times a polynomial, with the rotation's cosine and sine times it."""
    p, q, a, g = line

    def less_turned(fixed: Vector, v: Vector) -> Curve:
        (X, Y), (x, y) = map(as_flint, fixed), map(as_flint, v)
        return X * whole - x * cosine + y * sine, Y * whole - x * sine - y * cosine

    return less_turned(p, a), less_turned(q, g)


def curve_cross(u: Curve, v: Curve) -> fmpq_poly:
    return u[0] * v[1] - u[1] * v[0]


class Sheet:
    """A trapezoid, or an isolated part.

    Attributes
    ----------
    contact : Contact
        Whose surface it is on.
    codes : (int, int)
        The curves that bound it, packed.
    low, high : Fraction
        All orientations from the first to the second, in its chart, are strictly within; `refine` makes them more.
    """

    def __init__(
        self,
        features: SceneFeatures,
        contact: Contact,
        chart: int,
        codes: tuple[int, int],
        ends: tuple[Fraction, Fraction],
        face: int = -1,
    ) -> None:
        self.features, self.contact, self.chart, self.codes, self.face = features, contact, chart, codes, face
        self.low, self.high = ends
        self.line = contact_line(features, *contact)
        self._angle: AngleOf | None = None
        self._bits = 0

    @classmethod
    def of(cls, boundary: Boundary, face: int, angle: AngleOf | None = None) -> Sheet:
        """A trapezoid of a boundary.

        Parameters
        ----------
        angle : callable, optional
            `FreeSpace.angle`, to know its ends better.
        """
        sheet = cls._row(boundary, boundary.trapezoids, face, face)
        sheet._angle = angle
        bits = FINEST
        while angle and sheet.low >= sheet.high:
            bits *= 2
            sheet.refine(bits)
        return sheet

    @classmethod
    def isolated(cls, boundary: Boundary, k: int) -> Sheet:
        """An isolated part: both its curves are it, or name its ends; see `IsolatedParts`."""
        return cls._row(boundary, boundary.isolated, k, -1)

    @classmethod
    def _row(cls, boundary: Boundary, table: object, row: int, face: int) -> Sheet:
        def value(name: str) -> int:
            return int(getattr(table, name)[row])

        ends = Fraction(float(table.from_hi[row])), Fraction(float(table.to_lo[row]))  # type: ignore[attr-defined]
        contact = contact_of(boundary, value("patch"))
        return cls(boundary.features, contact, value("chart"), (value("lower"), value("upper")), ends, face)

    def refine(self, bits: int) -> None:
        """Come as near as 2**-bits to its first and last orientation."""
        if self._angle and bits > self._bits:
            (_, self.low), (self.high, _) = (self._angle(self.face, last, bits) for last in (False, True))
            self._bits = bits

    @property
    def theta(self) -> tuple[float, float]:
        """Its first and last orientation, rounded."""
        low, high = (float(theta_in(self.chart, float(tau))) for tau in (self.low, self.high))
        return low, high

    def at(self, tau: Fraction) -> tuple[Vector, Vector]:
        """P and U: positions P + t U, at tau in the chart."""
        return positions(self.line, tau_in_chart(self.chart, tau))

    def limits(self, tau: Fraction) -> tuple[Fraction, Fraction]:
        """Of t, at an orientation from the trapezoid's first to its last."""
        lower, upper = (as_fraction(n(as_flint(tau)) / d(as_flint(tau))) for n, d in self._curves)
        return lower, upper

    @cached_property
    def _curves(self) -> tuple[Curve, Curve]:
        """t as n / d, in lowest terms: so where a curve ends at a common zero, it has its limit there."""
        lower, upper = map(self._curve, self.codes)
        return lower, upper

    def _curve(self, code: int) -> Curve:
        kind, i, j = unpacked(code)
        if kind == Kind.VERTEX_VERTEX:
            p, q, a, g = self.line
            A, O, scale = self.features.robot, self.features.obstacles, self.features.scale
            along, w = (q, minus(vertex(O, j, scale), p)) if any(q) else (g, minus(vertex(A, i, scale), a))
            return fmpq_poly([as_flint(dot(w, along))]), fmpq_poly([as_flint(dot(along, along))])
        P, U = self._positions(self.line)
        Q, V = self._positions(contact_line(self.features, int(kind), int(i), int(j)))
        n, d = curve_cross((Q[0] - P[0], Q[1] - P[1]), V), curve_cross(U, V)
        common = n.gcd(d)
        return n // common, d // common

    def _positions(self, line: Line) -> tuple[Curve, Curve]:
        """P and U of a contact line times 1 + tau^2, tau in the chart."""
        sign = -1 if self.chart else 1
        return positions_over(line, fmpq_poly([sign, 0, -sign]), fmpq_poly([0, 2 * sign]), fmpq_poly([1, 0, 1]))

    def trace(self, side: int) -> tuple[str, ...]:
        """A name of a curve of the trapezoid in its chart: the same for the same positions."""
        (P, U), (n, d) = self._positions(self.line), self._curves[side]
        parts = [P[0] * d + n * U[0], P[1] * d + n * U[1], d * fmpq_poly([1, 0, 1])]
        common = parts[2] * (1 / parts[2].leading_coefficient())
        for part in parts[:2]:
            common = common.gcd(part)
        common *= parts[2].leading_coefficient()
        return tuple(str(part // common) for part in parts)

    def pose(self, t: Fraction, tau: Fraction) -> Pose:
        """On it."""
        P, U = self.at(tau)
        return Pose(P[0] + t * U[0], P[1] + t * U[1], {"tau": tau_in_chart(self.chart, tau)})

    def middle(self, tau: Fraction) -> Fraction:
        """A simple t well within."""
        return between(*self.limits(tau))


def contact_of(boundary: Boundary, patch: int) -> Contact:
    """What touches on a patch."""
    kind, i, j = boundary.contact_kind, boundary.contact_robot, boundary.contact_obstacle
    return int(kind[patch]), int(i[patch]), int(j[patch])


def isolated_end(boundary: Boundary, k: int, last: bool, tau: Fraction) -> Pose:
    """An end of an isolated part at one orientation, rational: of a segment or a point."""
    table = boundary.isolated
    patch, code = (int(getattr(table, ("lower", "upper")[last] + name)[k]) for name in ("_patch", ""))
    sheet = Sheet(boundary.features, contact_of(boundary, patch), int(table.chart[k]), (code, code), (tau, tau))
    return sheet.pose(sheet.limits(tau)[0], tau)


def common_tau(*sheets: Sheet) -> Fraction:
    """An orientation strictly within sheets that share a part of a curve."""
    bits = FINEST
    while (low := max(f.low for f in sheets)) >= (high := min(f.high for f in sheets)):
        bits *= 2
        for f in sheets:
            f.refine(bits)
    return between(low, high)
