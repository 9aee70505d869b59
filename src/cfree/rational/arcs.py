"""Surfaces of an arc on an arc as rational Bezier surfaces, with exact control points and weights.

With kappa = tan(psi / 2) and tau = tan(theta / 2) the surface of `cfree.contact.ArcArcSurface` is the sum of a v-v
helix and a circle,

    p - M(tau) a    +    sigma (1 - kappa^2, 2 kappa) / (1 + kappa^2).

So is its net over a rectangle of kappa and tau: the control point of (k, l) is the sum of the circle's k-th and the
helix's l-th, and its weight is their product. The bidegree is (2, 3) in (x, y, tau) and (2, 2) in (x, y).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal

import numpy as np

from cfree.arguments import checked
from cfree.contact.arcs import ArcArcSurface
from cfree.contact.contact import VertexEdge
from cfree.contact.surface import Surface
from cfree.exact.number import Number, to_fraction
from cfree.rational.bezier import Floats, Row, bezier_patch, de_casteljau, exact_texts

ZERO = (Fraction(0), Fraction(0))


@dataclass(frozen=True, slots=True)
class BezierNet:
    """A rational Bezier surface of an arc on an arc, of degree 2 in kappa and 2 or 3 in tau, over intervals of both.

    Attributes
    ----------
    charts : pair of int
        Of kappa and of tau: 0 for the tangent of half the angle, 1 for that of the angle minus half a turn.
    intervals : pair of pairs of Fraction
        (from, to) of kappa, and of tau.
    weights : tuple of tuples of Fraction
        weights[k][l] of the control point of index k in kappa and l in tau.
    points : tuple of rows
        points[k][l]: (x, y, tau) or (x, y) as fractions.
    """

    charts: tuple[int, int]
    intervals: tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]
    weights: tuple[tuple[Fraction, ...], ...]
    points: tuple[Row, ...]

    def __call__(self, kappa: Number, tau: Number) -> tuple[Fraction, ...]:
        """Return the exact point at kappa and tau, by de Casteljau's algorithm.

        Raises
        ------
        ValueError
            If one of them is outside its interval.
        """
        shares = []
        for name, value, (low, high) in zip(("kappa", "tau"), (kappa, tau), self.intervals, strict=True):
            share = (to_fraction(value) - low) / (high - low)
            if not 0 <= share <= 1:
                raise ValueError(f"{name} = {value} is not in [{low}, {high}]; give a point of the net")
            shares.append(share)
        rows = [
            [(*(w * c for c in point), w) for point, w in zip(row, weights, strict=True)]
            for row, weights in zip(self.points, self.weights, strict=True)
        ]
        *point, weight = de_casteljau([de_casteljau(row, shares[1]) for row in rows], shares[0])
        return tuple(c / weight for c in point)

    def arrays(self) -> tuple[Floats, Floats]:
        """Control points (3, d + 1, 3 or 2) and weights (3, d + 1) in doubles, each rounded once."""
        return np.array(self.points, dtype=np.float64), np.array(self.weights, dtype=np.float64)

    def as_json(self) -> dict[str, Any]:
        """Return charts, intervals, degrees, weights and points; numbers are exact strings such as "2/3"."""
        return {
            "charts": list(self.charts),
            "intervals": [exact_texts(interval) for interval in self.intervals],
            "degrees": [2, len(self.weights[0]) - 1],
            "weights": [exact_texts(row) for row in self.weights],
            "points": [[exact_texts(point) for point in row] for row in self.points],
        }


@checked
def arc_bezier_net(
    surface: ArcArcSurface, kappa_from: Number, kappa_to: Number, start: Number, stop: Number,
    *, charts: tuple[int, int] = (0, 0), dimension: Literal[2, 3] = 3,
) -> BezierNet:  # fmt: skip
    """Return a surface of an arc on an arc, over a rectangle of kappa and tau, as a rational Bezier surface.

    Parameters
    ----------
    surface : ArcArcSurface
    kappa_from, kappa_to : int, float, Fraction, Decimal or str
        The interval of kappa, or of the coordinate in its chart.
    start, stop : the same
        The interval of tau.
    charts : pair of {0, 1}, optional
        See `BezierNet`.
    dimension : {3, 2}, optional
        3: (x, y, tau), of bidegree (2, 3). 2: (x, y), of bidegree (2, 2).

    Raises
    ------
    ValueError
        If sigma is irrational or 0, an interval has no width, there is no such chart, or an interval is so wide that a
        weight is not positive: less than half a turn is narrow enough for both.

    Examples
    --------
    >>> from cfree import Curved
    >>> from cfree.contact import ArcArc, arc_surface
    >>> S = arc_surface(Curved.circle((1, 0), 1), Curved.circle((0, 0), 2), ArcArc(0, 0))
    >>> net = arc_bezier_net(S, 0, 1, 0, 1)
    >>> [[str(w) for w in row] for row in net.weights]
    [['1', '1', '4/3', '2'], ['1', '1', '4/3', '2'], ['2', '2', '8/3', '4']]
    >>> [[str(c) for c in row[0]] for row in net.points]
    [['2', '0', '0'], ['2', '3', '0'], ['-1', '3', '0']]
    >>> net("1/2", "1/3") == (Fraction(9, 5) - Fraction(4, 5), Fraction(12, 5) - Fraction(3, 5), Fraction(1, 3))
    True
    """
    sigma = surface.sigma
    if not sigma:
        kind = "irrational" if sigma is None else "0, its surface a helix"
        raise ValueError(f"{surface.contact}: sigma is {kind}; give arcs whose radii have a rational sum other than 0")
    (px, py), (ax, ay) = surface.p, surface.a
    still = VertexEdge(0, 0)
    # the circle is the helix of the point -sigma about 0, and the helix one ruling of a v-e surface of any edge
    circle = Surface(still, ZERO, ZERO, (-sigma, Fraction(0)), ZERO)
    helix = Surface(still, (px, py), ZERO, (ax, ay), ZERO)
    across = bezier_patch(circle, kappa_from, kappa_to, chart=charts[0], dimension=2)
    along = bezier_patch(helix, start, stop, chart=charts[1], dimension=dimension)
    points = tuple(tuple((x + u, y + v, *rest) for u, v, *rest in along.points[0]) for x, y in across.points[0])
    weights = tuple(tuple(c * w for w in along.weights) for c in across.weights)
    return BezierNet(charts, (across.interval, along.interval), weights, points)
