"""A motion from a pose, as quotients of polynomials in its parameter u, 0 <= u <= 1.

With half-angle vectors h(u) that run straight from one to the other, translations and rotations need quadratics; a
slide has degree 6 (docs/theory/motions.md). On an interval of u a polynomial is between its Bernstein coefficients.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import lru_cache
from math import comb, gcd, inf, isqrt, lcm
from operator import mul
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cfree.collision.motion import Translation
from cfree.collision.slide import Slide
from cfree.exact.algebraic import homogeneous
from cfree.verify.polygons import Ring, corners
from cfree.verify.surfaces import minus

if TYPE_CHECKING:
    from cfree.collision.motion import Motion
    from cfree.exact.pose import Pose

Poly = tuple[int, ...]  # constant term first
Placed = tuple[Fraction, Fraction, Fraction, Fraction]  # x, y, cos, sin
Interval = tuple[int, int, int]  # from a / n to b / n
Box = NDArray[np.float64]
Row = NDArray[Any]  # Fractions
ALL: Interval = 0, 1, 1
EVEN = 2**20  # denominators whose Bernstein coefficients differ by more make no useful box


class Course:
    """A motion from a pose: cos, sin, position, and position in the robot's frame, all times d."""

    def __init__(self, placed: Placed, motion: Motion, scale: int) -> None:
        x, y, c, s = placed
        if isinstance(motion, Translation):
            v, w = (part * scale for part in motion.vector)
            one = _row(1)
            columns = [one, c * one, s * one, _row(x, v), _row(y, w)]
            columns += [c * columns[3] + s * columns[4], c * columns[4] - s * columns[3]]
        elif isinstance(motion, Slide):
            t, d = motion.tau, _in_u(motion.d, motion.tau)
            weight, cosine, sine = _row(1, 0, t * t), _row(1, 0, -t * t), _row(0, 2 * t)
            C, S = c * cosine - s * sine, c * sine + s * cosine
            X, Y = x * d + scale * _in_u(motion.x, t), y * d + scale * _in_u(motion.y, t)
            columns = [np.convolve(f, g) for f, g in ((weight, d), (C, d), (S, d), (weight, X), (weight, Y))]
            columns += [np.convolve(C, X) + np.convolve(S, Y), np.convolve(C, Y) - np.convolve(S, X)]
        else:
            q, p = (0, -1 if motion.clockwise else 1) if motion.tau is None else motion.tau.as_integer_ratio()[::-1]
            first = isqrt(q * q + p * p)
            px, py = motion.pole[0] * scale, motion.pole[1] * scale
            rx, ry = x - px, y - py
            h0, h1 = np.array([first, q - first], object), np.array([0, p], object)
            even, odd, both = np.convolve(h0, h0), np.convolve(h1, h1), 2 * np.convolve(h0, h1)
            d, k = even + odd, even - odd  # cos and sin of the angle turned are k / d and both / d
            columns = [d, c * k - s * both, c * both + s * k]
            columns += [px * d + rx * k - ry * both, py * d + rx * both + ry * k]
            columns += [px * columns[1] + py * columns[2] + (c * rx + s * ry) * d]
            columns += [py * columns[1] - px * columns[2] + (c * ry - s * rx) * d]
        unit = lcm(*(Fraction(value).denominator for column in columns for value in column))
        numbers = [[int(unit * value) for value in column] for column in columns]
        divisor = gcd(*(value for column in numbers for value in column))
        self.d, self.c, self.s, self.x, self.y, self.xi, self.eta = (
            tuple(value // divisor for value in column) for column in numbers
        )

    @property
    def is_defined(self) -> bool:
        """True if d is certainly positive."""
        first, *middle, last = bernstein(self.d, ALL)
        return min(first, last) > 0 and min(middle) >= 0

    def at(self, u: Fraction) -> Placed:
        d, c, s, x, y = (Fraction(*homogeneous(poly, u)) for poly in (self.d, self.c, self.s, self.x, self.y))
        return x / d, y / d, c / d, s / d

    def box(self, part: Ring, interval: Interval, unit: int) -> Box:
        """Box around all places of a part, in doubles; larger by more than their rounding.

        Notes
        -----
        A place is a mean of quotients of Bernstein coefficients where those of d are positive. Else: the whole plane.
        """
        d, c, s, x, y = (bernstein(poly, interval) for poly in (self.d, self.c, self.s, self.x, self.y))
        if min(d) * EVEN < max(d):
            return np.array([-inf, -inf, inf, inf])
        columns = list(zip(x, y, c, s, d, strict=True))
        xs = [(f + u * g - v * h) / (unit * w) for u, v in part for f, _, g, h, w in columns]
        ys = [(f + u * h + v * g) / (unit * w) for u, v in part for _, f, g, h, w in columns]
        return np.array([min(xs), min(ys), max(xs), max(ys)]) + 2.0**-40 * np.array([-1, -1, 1, 1])

    def heights(self, part: Ring, obstacle: Ring) -> Iterator[list[Poly]]:
        """Yield, for every edge of both, the heights of the other's vertices over it, times d; they grow inwards."""
        d, c, s = self.d, self.c, self.s
        for _, (bx, by), end in corners(obstacle):
            e, f = minus(end, (bx, by))
            k = f * bx - e * by
            base = combined((e, -f, k), self.y, self.x, d)
            yield [combined((1, e * u + f * v, e * v - f * u), base, s, c) for u, v in part]
        for _, (ax, ay), end in corners(part):
            g, h = minus(end, (ax, ay))
            base = combined((-g, h, h * ax - g * ay), self.eta, self.xi, d)
            yield [combined((1, g * v - h * u, -g * u - h * v), base, c, s) for u, v in obstacle]


def place_of(pose: Pose, scale: int) -> Placed:
    """Position of the reference point, and the robot's cos and sin."""
    x, y, tau = pose.x * scale, pose.y * scale, pose.tau
    if tau is None:
        return x, y, Fraction(-1), Fraction(0)
    return x, y, (1 - tau * tau) / (1 + tau * tau), 2 * tau / (1 + tau * tau)


def combined(factors: Sequence[int], *polys: Poly) -> Poly:
    """Sum of polynomials of one length, each times its factor."""
    return tuple([sum(map(mul, factors, column)) for column in zip(*polys, strict=True)])


def bernstein(poly: Poly, interval: Interval) -> list[int]:
    """Bernstein coefficients of a polynomial on an interval, all times the same positive number."""
    return [sum(map(mul, row, poly)) for row in bernstein_rows(len(poly) - 1, interval)]


@lru_cache(maxsize=1 << 10)
def bernstein_rows(degree: int, interval: Interval) -> list[list[int]]:
    """Matrix that gives them: row of u^k, by the products of k arguments of its polar form."""
    a, b, n = interval
    whole = lcm(*(comb(degree, k) for k in range(degree + 1)))
    return [
        [
            whole // comb(degree, k) * n ** (degree - k)
            * sum(comb(i, j) * comb(degree - i, k - j) * b**j * a ** (k - j) for j in range(k + 1))
            for k in range(degree + 1)
        ]
        for i in range(degree + 1)
    ]  # fmt: skip


def _row(*values: Fraction | int) -> Row:
    """Row of three coefficients."""
    return np.array([*values, 0, 0][:3], object)


def _in_u(terms: Sequence[Fraction], tau: Fraction) -> Row:
    """A polynomial in t = u tau."""
    return np.array([c * tau**k for k, c in enumerate(terms)], object)
