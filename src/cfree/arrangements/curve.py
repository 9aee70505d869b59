"""Intersection curve of two contact surfaces: x and y as quotients of polynomials in tau = tan(theta / 2).

Two v-e surfaces meet in the motion of a robot that keeps two points on two lines: x and y are a + b cos + c sin, of
degree 2. For two e-v surfaces, two lines of the robot pass through two points. For these, and for one surface of each
kind, the degree is 4, or less if factors cancel.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cfree.arguments import checked
from cfree.arrangements.arc_length import arc_length
from cfree.arrangements.moving_lines import MovingLine
from cfree.exact.algebraic import near, ratio, rounded
from cfree.exact.angle_interval import AlgebraicAngle, AngleInterval
from cfree.exact.forms import Form, W, common_factor, in_chart, plus, product, quotient, reduced, value_at, zeros
from cfree.exact.half_angle import Angle, chart_of, half_tangent, to_chart
from cfree.exact.number import ExactPoint, Number, finite
from cfree.exact.pose import Pose
from cfree.geometry.ruled import check_scale

Floats = NDArray[np.float64]
Harmonics = tuple[Fraction, Fraction, Fraction, Fraction, Fraction]  # 1, cos, sin, cos 2 theta, sin 2 theta


@dataclass(frozen=True, slots=True)
class IntersectionCurve:
    """A curve x(tau) = x / w, y(tau) = y / w on two or more contact surfaces, with edges extended to lines.

    Attributes
    ----------
    x, y, w : tuple of int
        Coefficients of 1, tau, tau^2, ..., all three without common factors. They are forms: at the half turn, tau
        infinite, the values are the ratios of their last coefficients.
    origin : pair of Fraction
        A point of the plane nearby, the origin of computations in doubles.

    Examples
    --------
    A ladder of length 5 between a floor and a wall: its middle is on a circle.

    >>> from cfree import Polygon
    >>> from cfree.arrangements import intersection
    >>> from cfree.contact import VertexEdge, contact_surface
    >>> ladder, room = Polygon([(-2.5, 0), (2.5, 0), (0, 1)]), Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [])
    >>> floor, wall = (contact_surface(ladder, room, VertexEdge(i, j)) for i, j in ((1, 0), (0, 3)))
    >>> curve = intersection(floor, wall).curve
    >>> curve.x, curve.y, curve.w, curve.degree
    ((5, 0, -5), (0, -10, 0), (2, 0, 2), 2)
    >>> [[str(c) for c in row] for row in curve.harmonics[:2]]
    [['0', '5/2', '0', '0', '0'], ['0', '0', '-5/2', '0', '0']]
    >>> curve.point("1/3")
    (Fraction(2, 1), Fraction(-3, 2))
    """

    x: Form
    y: Form
    w: Form
    origin: ExactPoint = field(compare=False)

    @property
    def degree(self) -> int:
        """Degree of x(tau), y(tau): the number of poses with a x + b y = c for general a, b, c, with complex ones."""
        return len(self.w) - 1

    @property
    def asymptotes(self) -> tuple[AlgebraicAngle, ...]:
        """Orientations at which the curve goes to infinity."""
        return tuple(angle for angle, _ in zeros(self.w))

    @property
    def harmonics(self) -> tuple[Harmonics, Harmonics, Harmonics]:
        """Coefficients of 1, cos, sin, cos 2 theta, sin 2 theta in the numerators of x and y and their denominator.

        The denominator is 1 if possible.
        """
        rows = [self.x, self.y, self.w]
        if self.degree % 2:  # a linear denominator: multiply by its opposite
            a, b = _without_unit(self.w)
            rows = [product(row, (b, -a)) for row in rows]
        while len(rows[0]) < 5:
            rows = [product(row, W) for row in rows]
        x, y, w = map(_harmonics, rows)
        unit = w[0] if not any(w[1:]) else Fraction(1)
        return _over(x, unit), _over(y, unit), _over(w, unit)

    @checked
    def point(self, tau: Number | None) -> ExactPoint:
        """Return the exact (x, y) at a half-angle tangent; None is the half turn.

        Raises
        ------
        ValueError
            If `tau` is an asymptote.
        """
        chart, local = to_chart(half_tangent(tau))
        x, y, w = (_value(in_chart(row, chart), local) for row in (self.x, self.y, self.w))
        if w == 0:
            raise ValueError(f"tau = {tau} is an asymptote of the curve; give another")
        return x / w, y / w

    @checked
    def pose(self, theta: Angle) -> Pose:
        """Return the exact pose at an orientation, as `Pose` takes it."""
        turn = Pose(0, 0, theta)
        return Pose(*self.point(turn.tau)) @ turn

    @checked
    def near(self, angle: AlgebraicAngle, bits: int) -> ExactPoint:
        """Return (x, y) at an exact angle that is no asymptote, with errors of at most 2^-bits."""
        x, y, w = (value_at(row, angle) for row in (self.x, self.y, self.w))
        return near(ratio(x, w), bits), near(ratio(y, w), bits)

    @checked
    def rounded(self, angle: AlgebraicAngle) -> tuple[float, float]:
        """Return (x, y) at an exact angle in doubles, each within 0.51 units of its last place."""
        x, y, w = (value_at(row, angle) for row in (self.x, self.y, self.w))
        return rounded(ratio(x, w)), rounded(ratio(y, w))

    def __call__(self, theta: ArrayLike) -> Floats:
        """Points (x, y, theta), theta in radians: (..., 3); infinite or huge at asymptotes."""
        angles = finite("theta", theta)
        xy = self._series(angles)[..., 0]
        return np.concatenate((xy + [float(c) for c in self.origin], angles[..., None]), axis=-1)

    @checked
    def tangent(self, theta: ArrayLike, *, angle_scale: float = 1.0) -> Floats:
        """Unit tangents towards greater theta, in coordinates x, y, angle_scale * theta: (..., 3); NaN at an asymptote.

        Examples
        --------
        >>> helix = IntersectionCurve((1, 0, -1), (0, 2, 0), (1, 0, 1), (Fraction(0), Fraction(0)))
        >>> helix.tangent(0.0) * 2**0.5
        array([0., 1., 1.])
        """
        first = self._derivatives(theta, angle_scale)[0]
        with np.errstate(invalid="ignore"):
            return np.asarray(first / np.linalg.norm(first, axis=-1, keepdims=True))

    @checked
    def curvature(self, theta: ArrayLike, *, angle_scale: float = 1.0) -> Floats:
        """Curvature of the space curve, in 1 / length, (...); a radian has length `angle_scale`, 1 in the paper.

        Examples
        --------
        >>> helix = IntersectionCurve((2, 0, -2), (0, 4, 0), (1, 0, 1), (Fraction(0), Fraction(0)))
        >>> float(helix.curvature(2.5).round(12)), float(helix.torsion(2.5).round(12))
        (0.4, 0.2)
        """
        first, second, _ = self._derivatives(theta, angle_scale)
        with np.errstate(invalid="ignore"):
            return np.asarray(_length(np.cross(first, second)) / _length(first) ** 3)

    @checked
    def torsion(self, theta: ArrayLike, *, angle_scale: float = 1.0) -> Floats:
        """Torsion, in 1 / length, (...): positive for a right-handed screw; NaN where the curve is straight."""
        first, second, third = self._derivatives(theta, angle_scale)
        with np.errstate(invalid="ignore", divide="ignore"):
            normal = np.cross(first, second)
            torsion: Floats = (normal * third).sum(axis=-1) / (normal * normal).sum(axis=-1)
        return np.where(np.isfinite(torsion), torsion, np.nan)

    @checked
    def length(self, interval: AngleInterval, *, angle_scale: float = 1.0) -> tuple[float, float]:
        """Length of the part over an interval of orientations, and a proved bound on its error.

        Notes
        -----
        It is the integral of |(x', y', angle_scale)| in ball arithmetic (Arb, through python-flint), over both charts
        of tau, where the integrand has no poles. Over an asymptote it is infinite, with error 0.

        Examples
        --------
        >>> helix = IntersectionCurve((3, 0, -3), (0, 6, 0), (1, 0, 1), (Fraction(0), Fraction(0)))
        >>> length, error = helix.length(AngleInterval(None, None), angle_scale=4)
        >>> abs(length - 10 * math.pi) <= error < 1e-13
        True
        """
        if any(interval.contains(angle) for angle in self.asymptotes):
            return math.inf, 0.0
        return arc_length((self.x, self.y, self.w), interval, float(check_scale(angle_scale)))

    def _derivatives(self, theta: ArrayLike, angle_scale: float) -> list[Floats]:
        """First three derivatives by the chart's coordinate, (..., 3) each."""
        check_scale(angle_scale)
        angles = finite("theta", theta)
        xy, (_, tau) = self._series(angles), chart_of(angles)
        q = 1 + tau * tau  # theta = 2 atan(tau)
        z = (2 / q, -4 * tau / q**2, (12 * tau * tau - 4) / q**3)
        factors = (1, 2, 6)
        return [
            np.concatenate((factor * xy[..., k + 1], angle_scale * z[k][..., None]), axis=-1)
            for k, factor in enumerate(factors)
        ]

    def _series(self, theta: Floats) -> Floats:
        """Power series of x and y from the origin in the chart's coordinate, up to the third power: (..., 2, 4)."""
        charts, tau = chart_of(theta)
        series = np.empty((*theta.shape, 2, 4))
        rows = self._around_origin()
        for chart in (0, 1):
            chosen = charts == chart
            x, y, w = (_taylor(in_chart(row, chart), tau[chosen]) for row in rows)  # type: ignore[arg-type]
            with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
                series[chosen] = np.stack((_divided(x, w), _divided(y, w)), axis=-2)
        return series

    def _around_origin(self) -> list[list[float]]:
        """Numerators and denominator in doubles of the curve, moved so that the origin is at 0."""
        (a, b), (c, d) = (part.as_integer_ratio() for part in self.origin)
        x, y = (plus(tuple(n * k for k in row), self.w, -m) for row, m, n in ((self.x, a, b), (self.y, c, d)))
        rows = [[d * k for k in x], [b * k for k in y], [b * d * k for k in self.w]]
        largest = max(abs(k) for row in rows for k in row)
        return [[k / largest for k in row] for row in rows]


def curve_on(first: MovingLine, T: Form, D: Form, origin: ExactPoint) -> IntersectionCurve:
    """Return the curve P + t U, t = T / D."""
    x, y = (plus(product(P, D), product(T, U)) for P, U in zip(first.P, first.U, strict=True))
    x, y, w = reduced((x, y, product(W, D, (first.unit,))))
    sign = -1 if next(c for c in w if c) < 0 else 1
    x, y, w = (tuple(sign * c for c in row) for row in (x, y, w))
    return IntersectionCurve(x, y, w, origin)


def _without_unit(w: Form) -> Form:
    while len(w) > 2 and len(factor := common_factor((w, W))) == 3:
        w = quotient(w, factor)
    return w


def _harmonics(form: Form) -> Harmonics:
    """Trigonometric coefficients of a form of degree 4, over W^2."""
    p = [Fraction(c) for c in form]
    middle = (p[0] + p[4]) / 2
    cos2 = (2 * middle - p[2]) / 8
    return middle - cos2, (p[0] - p[4]) / 2, (p[1] + p[3]) / 4, cos2, (p[1] - p[3]) / 8


def _over(row: Harmonics, unit: Fraction) -> Harmonics:
    a, b, c, d, e = (value / unit for value in row)
    return a, b, c, d, e


def _value(form: Form, tau: Fraction) -> Fraction:
    total = Fraction(0)
    for c in reversed(form):
        total = total * tau + c
    return total


def _taylor(form: Sequence[float], tau: Floats) -> Floats:
    """Coefficients of 1, h, h^2, h^3 of a polynomial at tau + h: (..., 4)."""
    rows = [[math.comb(j, k) * c for j, c in enumerate(form)][k:] or [0.0] for k in range(4)]
    return np.stack([np.polynomial.polynomial.polyval(tau, row) for row in rows], axis=-1)


def _divided(x: Floats, w: Floats) -> Floats:
    """Quotient of power series."""
    z = np.empty_like(x)
    for k in range(x.shape[-1]):
        z[..., k] = (x[..., k] - sum(z[..., i] * w[..., k - i] for i in range(k))) / w[..., 0]
    return z


def _length(vectors: Floats) -> Floats:
    lengths: Floats = np.linalg.norm(vectors, axis=-1)
    return lengths
