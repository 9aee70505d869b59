"""Length of curves whose x and y are rational functions of tau, in ball arithmetic (Arb)."""

from __future__ import annotations

import math
from fractions import Fraction

from flint import acb, arb, ctx, fmpq, fmpz_poly

from cfree.exact.algebraic import near
from cfree.exact.angle_interval import AlgebraicAngle, AngleInterval
from cfree.exact.forms import Form, in_chart

PRECISION = 128  # bits; more if an end is close to an asymptote


def arc_length(rows: tuple[Form, Form, Form], interval: AngleInterval, angle_scale: float) -> tuple[float, float]:
    """Length of (x / w, y / w, angle_scale theta) over orientations where w is not 0, and a bound on its error.

    Notes
    -----
    In a chart, theta = 2 atan(tau), up to a half turn. Let u = x' w - x w' and v = y' w - y w'. The integrand
    is sqrt((u^2 + v^2) / w^4 + (2 angle_scale / (1 + tau^2))^2), analytic around the interval.
    """
    bits = PRECISION
    while True:
        with ctx.workprec(bits):
            total = sum((_over(rows, angle_scale, *part) for part in _parts(interval, bits)), arb(0))
            if total.is_finite():
                value = float(total)
                return value, math.nextafter(float(abs(total - value).upper()), math.inf)
        bits *= 2


def _over(rows: tuple[Form, Form, Form], angle_scale: float, chart: int, low: arb, high: arb) -> arb:
    x, y, w = (fmpz_poly(list(in_chart(row, chart))) for row in rows)
    u, v = (z.derivative() * w - z * w.derivative() for z in (x, y))

    def speed(tau: acb, analytic: bool) -> acb:
        below, turning = w(tau) ** 2, 2 * angle_scale / (1 + tau * tau)
        return ((u(tau) / below) ** 2 + (v(tau) / below) ** 2 + turning**2).sqrt(analytic=analytic)

    return acb.integral(speed, low, high).real


def _parts(interval: AngleInterval, bits: int) -> list[tuple[int, arb, arb]]:
    """Parts of an interval: chart, start and stop in it."""
    whole = arb(-1), arb(1)
    if interval.start is None or interval.stop is None:
        return [(0, *whole), (1, *whole)]
    first, last = interval.start, interval.stop
    start, stop = _ball(first, bits), _ball(last, bits)
    if first.chart == last.chart and not last < first:
        return [(first.chart, start, stop)]
    between = [] if first.chart != last.chart else [(1 - first.chart, *whole)]
    return [(first.chart, start, whole[1]), *between, (last.chart, whole[0], stop)]


def _ball(angle: AlgebraicAngle, bits: int) -> arb:
    place = near(angle.coordinate, bits)
    is_exact = isinstance(angle.coordinate, Fraction)
    return arb(fmpq(*place.as_integer_ratio()), 0 if is_exact else fmpq(1, 1 << bits))
