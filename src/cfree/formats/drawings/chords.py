"""Chords of arcs and Bézier curves: points at parameters, nearest points, and parts between two parameters."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

from cfree.curves.drawn import Arc, Cubic, Line, Segment, Vector, ends, point_of
from cfree.exact.number import ExactPoint

NOISE = 2.0**-43
"""Rounding of points of curves, relative to the numbers that they are computed from."""
MOST_CHORDS = 4096
"""Maximum number of chords of a curve."""
Range = tuple[float, float]


def range_of(curve: Segment) -> Range:
    """Return the parameters of a curve's ends."""
    return (curve.first, curve.last) if isinstance(curve, Arc) else (0.0, 1.0)


def noise(segment: Segment) -> float:
    """Bound of the rounding of a segment's computed ends; 0 for lines, whose ends are exact."""
    match segment:
        case Arc(center, u, v):
            return NOISE * (math.hypot(*center) + math.hypot(*u) + math.hypot(*v))
        case Cubic(points):
            return NOISE * max(math.hypot(*p) for p in points)
    return 0.0


def place_at(curve: Segment, t: float) -> Vector:
    """Return the point of a curve at a parameter."""
    if isinstance(curve, Arc):
        return curve.at(t)
    assert isinstance(curve, Cubic)
    a, b, c, d = curve.points
    s = 1 - t
    w = s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t
    return (
        w[0] * a[0] + w[1] * b[0] + w[2] * c[0] + w[3] * d[0],
        w[0] * a[1] + w[1] * b[1] + w[2] * c[1] + w[3] * d[1],
    )


def nearest(curve: Segment, p: Vector, first: float, last: float) -> float:
    """Return the parameter in a short range whose point is nearest to another point."""
    if isinstance(curve, Arc) and curve.circular:
        (x, y), (a, b), (c, d) = curve.center, curve.u, curve.v
        dx, dy = p[0] - x, p[1] - y
        t = math.atan2(dx * c + dy * d, dx * a + dy * b)
        low, high = sorted((first, last))
        middle = (low + high) / 2
        t += math.tau * round((middle - t) / math.tau)
        return min(max(t, low), high)
    low, high = first, last
    for _ in range(64):  # ternary search: the distance has one minimum beside a chord
        a, b = low + (high - low) / 3, high - (high - low) / 3
        if math.dist(place_at(curve, a), p) < math.dist(place_at(curve, b), p):
            high = b
        else:
            low = a
    return (low + high) / 2


def steps_of(curve: Segment, first: float, last: float, sagitta: float) -> list[float]:
    """Parameters of chords within a distance of the curve, the same for both directions."""
    sweep = abs(last - first)
    if isinstance(curve, Arc):
        reach = max(math.hypot(*curve.u), math.hypot(*curve.v))
        share = min(1.0, sagitta / reach) if reach else 1.0
        count = sweep / min(math.pi / 4, 2 * math.acos(1 - share) if share > 1e-12 else math.sqrt(8 * share))
    else:
        assert isinstance(curve, Cubic)
        a, b, c, d = curve.points
        bend = max(math.hypot(p[0] - 2 * q[0] + r[0], p[1] - 2 * q[1] + r[1]) for p, q, r in ((a, b, c), (b, c, d)))
        count = sweep * math.sqrt(0.75 * bend / sagitta)
    number = max(2, math.ceil(min(count, MOST_CHORDS)))
    low, high = sorted((first, last))
    steps = [low, *(low + (high - low) * k / number for k in range(1, number)), high]
    return steps if first < last else steps[::-1]


def part_of(curve: Segment, first: float, last: float, tips: tuple[ExactPoint, ExactPoint]) -> Segment:
    """Return a curve between two parameters, with its exact ends."""
    if isinstance(curve, Arc):
        return replace(curve, first=first, last=last, tips=tips)
    assert isinstance(curve, Cubic)
    low, high = sorted((first, last))
    points = list(_split(list(curve.points), high)[0])
    if low:
        points = list(_split(points, low / high)[1])
    p, q, r, s = points if first < last else points[::-1]
    return Cubic((p, q, r, s), tips)


def _split(row: list[Vector], t: float) -> tuple[list[Vector], list[Vector]]:
    left, right = [row[0]], [row[-1]]
    while len(row) > 1:
        row = [(p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t) for p, q in pairwise(row)]
        left.append(row[0])
        right.append(row[-1])
    return left, right[::-1]


def joints(segments: list[Segment], *, closed: bool) -> Iterator[ExactPoint]:
    """Yield the exact ends of connected segments: of a line if one of the two is a line."""
    for k, segment in enumerate(segments):
        if k or closed:
            yield _joint(segments[k - 1], segment)
        else:
            yield tip(segment, 0)
    yield _joint(segments[-1], segments[0]) if closed else tip(segments[-1], 1)


def tip(segment: Segment, which: int) -> ExactPoint:
    """Return the exact first or last point of a segment."""
    if isinstance(segment, Line):
        return segment.end if which else segment.start
    return segment.tips[which] if segment.tips else point_of(*ends(segment)[which])


def _joint(before: Segment, segment: Segment) -> ExactPoint:
    return tip(segment, 0) if isinstance(segment, Line) or not isinstance(before, Line) else before.end
