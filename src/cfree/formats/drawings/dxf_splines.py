"""Cubic Bézier curves of B-splines, seen from above: exact up to degree 3 without weights, else within a bound.

The control points of a span are values of the spline's blossom at its ends (Ramshaw, "Blossoms are polar forms", 1989),
which holds for any knots: clamped or not, repeated or not.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Any

from cfree.curves.drawn import Cubic, Line, Ring, Segment, Vector, cubic_at, point_of, quadratic

DEEPEST, SHARE = 8, 1e-6
"""Halvings of a span, and the error aimed at, as a share of the curve's size."""
Row = tuple[float, ...]
"""Weighted coordinates, and the weight."""


def cubics(spline: Any, spend: Callable[[int], object]) -> tuple[Ring, float]:
    """Return a spline's curves, and their distance from it, sampled: 0 if they are exact.

    Parameters
    ----------
    spline : ezdxf.math.BSpline
    spend : callable
        Called with the number of steps before they are taken.
    """
    degree, knots = int(spline.degree), [float(knot) for knot in spline.knots()]
    weights = [float(weight) for weight in spline.weights()] or [1.0] * spline.count
    rows = [(w * p.x, w * p.y, w) for p, w in zip(spline.control_points, weights, strict=True)]
    if len(knots) != len(rows) + degree + 1 or knots != sorted(knots) or not 1 <= degree <= 16:
        raise ValueError("its knots do not fit its points")
    if min(weights) <= 0:
        raise ValueError("a weight that is not positive")
    exact = degree <= 3 and len(set(weights)) == 1
    size = max(max(column) - min(column) for column in zip(*((x / w, y / w) for x, y, w in rows), strict=True))
    ring: Ring = []
    worst = 0.0
    for span in range(degree, len(rows)):
        if knots[span] < knots[span + 1]:
            spend(degree)
            points = [_blossom(rows, knots, degree, span, k) for k in range(degree + 1)]
            if exact:
                ring.append(_bezier([(x / w, y / w) for x, y, w in points]))
                continue
            for cubic, error in _near(points, SHARE * size, 0, spend):
                ring.append(cubic)
                worst = max(worst, error)
    return ring, worst


def _blossom(rows: Sequence[Row], knots: Sequence[float], degree: int, span: int, count: int) -> Row:
    """Return control point `count` of a span: the blossom at its end, `count` times, and at its start."""
    values = [knots[span]] * (degree - count) + [knots[span + 1]] * count
    points = list(rows[span - degree : span + 1])
    for level, value in enumerate(values, 1):
        for k in range(degree, level - 1, -1):
            low, high = knots[span - degree + k], knots[span + 1 + k - level]
            share = (value - low) / (high - low)
            points[k] = tuple((1 - share) * a + share * b for a, b in zip(points[k - 1], points[k], strict=True))
    return points[degree]


def _bezier(p: list[Vector]) -> Segment:
    match p:
        case [a, b]:
            return Line(point_of(*a), point_of(*b))
        case [a, b, c]:
            return quadratic(a, b, c)
        case _:
            return Cubic((p[0], p[1], p[2], p[3]))


def _near(
    points: Sequence[Row], error: float, depth: int, spend: Callable[[int], object]
) -> Iterator[tuple[Cubic, float]]:
    """Yield cubics with the ends and end tangents of a rational Bézier curve or its halves, and their distances."""
    spend(len(points))
    (a, u), (b, v) = _end(points), _end(points[::-1])
    cubic = (a, (a[0] + u[0] / 3, a[1] + u[1] / 3), (b[0] + v[0] / 3, b[1] + v[1] / 3), b)
    distance = max(math.dist(cubic_at(cubic, t), _place(_split(points, t)[0][-1])) for t in (0.25, 0.5, 0.75))
    if distance <= error or depth == DEEPEST:
        yield Cubic(cubic), distance
        return
    for half in _split(points, 0.5):
        yield from _near(half, error, depth + 1, spend)


def _end(points: Sequence[Row]) -> tuple[Vector, Vector]:
    """Return the first point of a rational Bézier curve, and its derivative there."""
    p, q = _place(points[0]), _place(points[1])
    share = (len(points) - 1) * points[1][2] / points[0][2]
    return p, (share * (q[0] - p[0]), share * (q[1] - p[1]))


def _place(row: Row) -> Vector:
    return row[0] / row[2], row[1] / row[2]


def _split(points: Sequence[Row], t: float) -> tuple[list[Row], list[Row]]:
    left, right, row = [points[0]], [points[-1]], list(points)
    while len(row) > 1:
        row = [tuple((1 - t) * a + t * b for a, b in zip(p, q, strict=True)) for p, q in pairwise(row)]
        left.append(row[0])
        right.append(row[-1])
    return left, right[::-1]
