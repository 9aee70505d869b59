"""Contact patches as rational Bezier surfaces, with exact control points and weights.

Paper, eqs. (5) and (8) in the model of eq. (2). With e = p + t q, f = a + t g and J the quarter turn, a contact surface
is S = N / w, where

    w = 1 + tau^2,    N_xy = (e - f) - 2 tau J f + tau^2 (e + f),    N_tau = tau + tau^3.

All are linear in t and of degree 2 or 3 in tau: a rational Bezier surface of bidegree (1, 3) in (x, y, tau), and of
bidegree (1, 2) in (x, y) alone. Control points are values of the polar form; so are the weights. Over [u, v] they are

    degree 2:  1 + u^2,   1 + u v,                  1 + v^2
    degree 3:  1 + u^2,   1 + (u^2 + 2 u v) / 3,   1 + (2 u v + v^2) / 3,   1 + v^2.

The middle weight of degree 2 is positive exactly if the angle spans less than half a turn; the weights of degree 3 are
at least 2/3 for u and v in one chart. The half turn has no tau: a patch that passes it is cut, and its part with
|tau| > 1 is written in the other chart of `cfree.exact.half_angle`.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations, pairwise
from math import comb, prod
from os import PathLike
from typing import Any, Literal, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.contact.surface import Surface
from cfree.exact.half_angle import chart_intervals, seen_in_chart
from cfree.exact.number import ExactPoint, Number, to_fraction
from cfree.formats.text.atomic import replacing
from cfree.rational.model import RationalSurface

Floats = NDArray[np.float64]
Row = tuple[tuple[Fraction, ...], ...]


@runtime_checkable
class SavedPatch(Protocol):
    """A patch with a form in JSON."""

    def as_json(self) -> dict[str, Any]: ...


@dataclass(frozen=True, slots=True)
class BezierPatch:
    """A rational Bezier surface, of degree 1 in t over [0, 1] and of degree 2 or 3 in tau over an interval.

    Attributes
    ----------
    chart : int
        Third coordinate and parameter: tau = tan(theta / 2) for 0, tan((theta - pi) / 2) for 1.
    interval : pair of Fraction
        (from, to) of the parameter, ``tau`` below.
    weights : tuple of Fraction
        One for each control point of a row: 1 + tau^2 does not depend on t.
    points : pair of rows
        points[k][l]: control point of t = k and of index l in tau, (x, y, tau) or (x, y) as fractions.

    Notes
    -----
    The rows of `points` are the control polygons of the two v-v helices that bound the patch.

    Examples
    --------
    >>> from cfree.contact.contact import EdgeVertex
    >>> from cfree.polygons.polygon import Polygon
    >>> from cfree.contact.surface import contact_surface
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> patch = bezier_patch(contact_surface(square, square, EdgeVertex(0, 2)), 0, 1)
    >>> [str(w) for w in patch.weights]
    ['1', '1', '4/3', '2']
    >>> [[str(c) for c in point] for point in patch.points[0]]
    [['2', '2', '0'], ['2', '2', '1/3'], ['2', '2', '1/2'], ['2', '2', '1']]
    >>> patch("1/4", "1/2")
    (Fraction(17, 10), Fraction(8, 5), Fraction(1, 2))
    """

    chart: int
    interval: tuple[Fraction, Fraction]
    weights: tuple[Fraction, ...]
    points: tuple[Row, Row]

    def __call__(self, t: Number, tau: Number) -> tuple[Fraction, ...]:
        """Return the exact point at t and tau, by de Casteljau's algorithm.

        Raises
        ------
        ValueError
            If t is outside [0, 1], or tau outside the interval: a control net is not used beyond its ends.
        """
        along, (low, high) = to_fraction(t), self.interval
        local = (to_fraction(tau) - low) / (high - low)
        if not (0 <= along <= 1 and 0 <= local <= 1):
            raise ValueError(f"(t, tau) = ({t}, {tau}) is not in [0, 1] x [{low}, {high}]; give a point of the patch")
        rows = [[(*(w * c for c in p), w) for p, w in zip(row, self.weights, strict=True)] for row in self.points]
        *point, weight = de_casteljau([de_casteljau(row, local) for row in rows], along)
        return tuple(c / weight for c in point)

    def arrays(self) -> tuple[Floats, Floats]:
        """Control points (2, d + 1, 3 or 2) and weights (2, d + 1) in doubles, each rounded once."""
        points, weights = np.array(self.points, dtype=np.float64), np.array(self.weights, dtype=np.float64)
        return points, np.tile(weights, (2, 1))

    def as_json(self) -> dict[str, Any]:
        """Return chart, interval, degrees, weights and points; numbers are exact strings such as "2/3"."""
        return {
            "chart": self.chart,
            "interval": exact_texts(self.interval),
            "degrees": [1, len(self.weights) - 1],
            "weights": exact_texts(self.weights),
            "points": [[exact_texts(point) for point in row] for row in self.points],
        }


@checked
def bezier_patch(
    surface: Surface, start: Number, stop: Number, *, chart: int = 0, dimension: Literal[2, 3] = 3
) -> BezierPatch:
    """Return a contact surface over an interval of tau as a rational Bezier surface.

    Parameters
    ----------
    surface : Surface
    start, stop : int, float, Fraction, Decimal or str
        The interval of tau, or of the coordinate in the chart.
    chart : {0, 1}, optional
        See `BezierPatch`.
    dimension : {3, 2}, optional
        3: (x, y, tau), of bidegree (1, 3). 2: (x, y), of bidegree (1, 2).

    Raises
    ------
    ValueError
        If start < stop does not hold, there is no such chart, or the interval is so wide that a weight is not positive.

    Notes
    -----
    The interval may leave the contact's range: `bezier_patches` stays within it.

    Examples
    --------
    >>> from cfree.contact.contact import VertexEdge
    >>> from cfree.polygons.polygon import Polygon
    >>> from cfree.contact.surface import contact_surface
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> S = contact_surface(square, square, VertexEdge(0, 2))
    >>> [str(w) for w in bezier_patch(S, "-1/2", 1, dimension=2).weights]
    ['5/4', '1/2', '2']
    >>> bezier_patch(S, -2, 2)
    Traceback (most recent call last):
        ...
    ValueError: over [-2, 2] the weights are 5, -1/3, -1/3, 5; cut the interval where its angle spans less
    """
    u, v, degree = to_fraction(start), to_fraction(stop), dimension
    if not u < v:
        raise ValueError(f"the interval [{u}, {v}] has no width; give start < stop")
    if chart not in (0, 1):
        raise ValueError(f"there is no chart {chart!r}; give 0 or 1")
    arguments = [(u,) * (degree - l) + (v,) * l for l in range(degree + 1)]
    weights = tuple(_polar((1, 0, 1), args) for args in arguments)
    if min(weights) <= 0:
        values = ", ".join(map(str, weights))
        raise ValueError(f"over [{u}, {v}] the weights are {values}; cut the interval where its angle spans less")
    turned = replace(surface, a=seen_in_chart(chart, surface.a), g=seen_in_chart(chart, surface.g))

    def row(t: int) -> Row:
        numerators = _numerators(turned, t)[:dimension]
        return tuple(tuple(_polar(c, args) / w for c in numerators) for args, w in zip(arguments, weights, strict=True))

    return BezierPatch(chart, (u, v), weights, (row(0), row(1)))


@checked
def bezier_patches(patch: RationalSurface, bits: int = 53) -> tuple[BezierPatch, ...]:
    """Convert a whole contact patch in (x, y, tau), except slivers at ends that are not rational.

    Parameters
    ----------
    patch : RationalSurface
    bits : int, optional
        Precision of the ends, see `cfree.rational.model.RationalRange.inside`.

    Returns
    -------
    tuple of BezierPatch
        One or two patches in the order of the angle, the second in the other chart. All points are contacts.

    Raises
    ------
    ValueError
        If nothing of the patch is left: give more bits. Also at a reflex vertex, which has no patch.

    Examples
    --------
    >>> from cfree.contact.contact import VertexEdge
    >>> from cfree.polygons.polygon import Polygon
    >>> from cfree.rational.model import rational_surface
    >>> triangle, square = Polygon([(0, 0), (2, 0), (1, 1)]), Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> patch = rational_surface(triangle, square, VertexEdge(1, 2))     # from -135 to 0 degrees
    >>> [(part.chart, *map(str, part.interval)) for part in bezier_patches(patch, bits=8)]
    [(1, '107/256', '1'), (0, '-1', '0')]
    """
    if patch.Phi is None:
        raise ValueError(f"{patch.surface.contact} is never a contact and has no patch; see contacts()")
    parts = chart_intervals(*patch.Phi.inside(bits))
    return tuple(bezier_patch(patch.surface, low, high, chart=chart) for chart, low, high in parts)


@checked
def save_bezier(patches: Iterable[SavedPatch], path: str | PathLike[str]) -> None:
    """Write `BezierPatch` and `BezierNet` as a JSON list of their `as_json`, completely or not at all."""
    with replacing(path) as unfinished:
        unfinished.write_text(json.dumps([patch.as_json() for patch in patches]) + "\n", encoding="utf-8")


def _numerators(S: Surface, t: int) -> tuple[Sequence[Fraction | int], ...]:
    """Coefficients, lowest first, of w x, w y and w tau at t."""
    (ex, ey), (fx, fy) = (_at(S.p, S.q, t), _at(S.a, S.g, t))
    return (ex - fx, 2 * fy, ex + fx), (ey - fy, -2 * fx, ey + fy), (0, 1, 0, 1)


def _at(start: ExactPoint, along: ExactPoint, t: int) -> ExactPoint:
    return start[0] + t * along[0], start[1] + t * along[1]


def _polar(coefficients: Sequence[Fraction | int], arguments: Sequence[Fraction]) -> Fraction:
    """Polar form: symmetric, affine in each argument, equal to the polynomial if all arguments are equal."""
    d = len(arguments)
    return sum(
        (c * Fraction(sum(map(prod, combinations(arguments, k))), comb(d, k)) for k, c in enumerate(coefficients)),
        Fraction(0),
    )


def de_casteljau(points: Sequence[tuple[Fraction, ...]], s: Fraction) -> tuple[Fraction, ...]:
    while len(points) > 1:
        points = [tuple((1 - s) * a + s * b for a, b in zip(p, q, strict=True)) for p, q in pairwise(points)]
    return points[0]


def exact_texts(numbers: Iterable[Fraction]) -> list[str]:
    return [str(number) for number in numbers]
