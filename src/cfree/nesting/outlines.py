"""Outlines of a union of open convex polygons, exactly: rings, and free segments and points without width.

A point of an edge is on the outline if no polygon of the union has it inside. Doubles with a wide margin drop the edges
that one polygon covers, and pairs that are apart; exact numbers decide all others.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cmp_to_key
from typing import Any, NamedTuple

import numpy as np
from flint import fmpq

from cfree.exact.number import ExactPoint, IntPoint
from cfree.libraries import Floats
from cfree.nesting.sums import IntRing, Sums

MARGIN = 1e-9
"""Share of the size: decisions that are nearer are left to exact numbers."""

Place = tuple[Any, Any]  # a point of rational coordinates
Span = tuple[Any, Any]  # the positions of two points on a line
Line = tuple[int, int, int]  # direction u without a common factor, and u x p of its points p


class Outlines(NamedTuple):
    """Outline of a forbidden region.

    Attributes
    ----------
    rings : tuple of rings
        The forbidden region is on the left of each: outer rings run counter-clockwise, holes clockwise.
    segments : tuple of pairs of points
        Free segments with forbidden positions on both sides.
    points : tuple of points
        Free points with forbidden positions all around.
    """

    rings: tuple[tuple[ExactPoint, ...], ...]
    segments: tuple[tuple[ExactPoint, ExactPoint], ...]
    points: tuple[ExactPoint, ...]


def outlines(sums: Sums) -> Outlines:
    """Return the outline of a union of open convex polygons.

    Examples
    --------
    >>> from cfree.nesting.sums import sums_of
    >>> from cfree.polygons.polygon import Polygon
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> [[tuple(map(int, p)) for p in ring] for ring in outlines(sums_of([square], [square])).rings]
    [[(-1, -1), (1, -1), (1, 1), (-1, 1)]]
    """
    lines, single = _uncovered(sums)
    slits = {line: _common(spans, lines.get(_reversed(line), []), line) for line, spans in lines.items()}
    rims = [
        edge for line, spans in lines.items() for span in _without(spans, slits[line]) for edge in [_ends(line, *span)]
    ]
    segments = [_ends(line, *span) for line, spans in slits.items() for span in spans if (line[0], line[1]) > (0, 0)]
    points = [p for p in sorted(single) if not _is_on(p, lines)]
    scale = sums.scale
    return Outlines(
        tuple(tuple(_exact(p, scale) for p in ring) for ring in _chained(rims)),
        tuple((_exact(p, scale), _exact(q, scale)) for p, q in sorted(segments)),
        tuple(_exact(p, scale) for p in points),
    )


def _exact(p: Place, scale: int) -> ExactPoint:
    x, y = p
    return Fraction(int(x.p), int(x.q) * scale), Fraction(int(y.p), int(y.q) * scale)


def _uncovered(sums: Sums) -> tuple[dict[Line, list[Span]], set[Place]]:
    """Return the parts of edges that no polygon covers, united by line, and single points."""
    edges = sums.edges
    gathered: dict[Line, list[Span]] = defaultdict(list)
    single: set[Place] = set()
    for k, near in _candidates(sums, edges):
        (x, y), (x1, y1) = edges[k]
        dx, dy = x1 - x, y1 - y
        g = math.gcd(dx, dy)
        u, v = dx // g, dy // g
        start, length = u * x + v * y, u * dx + v * dy
        for low, high in _gaps(edges[k], [sums.rings[j] for j in near]):
            if low < high:
                gathered[u, v, u * y - v * x].append((start + low * length, start + high * length))
            else:
                single.add((x + low * dx, y + low * dy))
    return {line: _united(spans) for line, spans in gathered.items()}, single


def _candidates(sums: Sums, edges: Sequence[tuple[IntPoint, IntPoint]]) -> Iterator[tuple[int, list[int]]]:
    """Yield each edge that no polygon certainly covers, with the polygons that may meet it."""
    ends = np.array([[[c / sums.scale for c in p] for p in edge] for edge in edges], float).reshape(-1, 2, 2)
    margin = MARGIN * sums.size
    low, high = ends.min(axis=1), ends.max(axis=1)
    is_open = np.ones(len(edges), bool)
    near: list[list[int]] = [[] for _ in edges]
    sizes = (sums.boxes[:, 2:] - sums.boxes[:, :2]).prod(axis=1)
    for j in np.argsort(-sizes, kind="stable").tolist():  # large ones cover most edges
        ring, box = sums.rings[j], sums.boxes[j]
        rows = np.flatnonzero(is_open & (low < box[2:] + margin).all(axis=1) & (high > box[:2] - margin).all(axis=1))
        if not len(rows):
            continue
        heights = _heights(np.array([[c / sums.scale for c in p] for p in ring], float), ends[rows])
        is_open[rows[heights.min(axis=(1, 2)) > margin]] = False
        apart = (heights.max(axis=1) < -margin).any(axis=1)
        for k in rows[~apart].tolist():
            near[k].append(j)
    yield from ((k, near[k]) for k in np.flatnonzero(is_open).tolist())


def _heights(ring: Floats, ends: Floats) -> Floats:
    """Return the distances of the ends of edges to the left of the sides of a ring, (edges, 2, sides)."""
    sides = np.roll(ring, -1, axis=0) - ring
    sides /= np.hypot(*sides.T)[:, None]
    off = ends[:, :, None, :] - ring
    heights: Floats = sides[:, 0] * off[..., 1] - sides[:, 1] * off[..., 0]
    return heights


def _gaps(edge: tuple[IntPoint, IntPoint], rings: Iterable[IntRing]) -> Iterator[Span]:
    """Yield closed intervals of [0, 1] in which an edge is inside no ring, single points included."""
    covered = sorted(span for ring in rings if (span := _inside(edge, ring)))
    reach = fmpq(0)
    for low, high in covered:
        if low >= reach:
            yield reach, low
        reach = max(reach, high)
        if reach > 1:
            return
    yield reach, fmpq(1)


def _inside(edge: tuple[IntPoint, IntPoint], ring: IntRing) -> Span | None:
    """Return the open interval in which an edge is inside a ring; beyond [0, 1] it ends at -1 or 2."""
    (px, py), (qx, qy) = edge
    low, low_unit, high, high_unit = -1, 1, 2, 1
    a, b = ring[-1]
    for c, d in ring:
        u, v = c - a, d - b
        first, last = u * (py - b) - v * (px - a), u * (qy - b) - v * (qx - a)
        if first <= 0 and last <= 0:
            return None
        if first <= 0:
            if -first * low_unit > low * (last - first):
                low, low_unit = -first, last - first
        elif last <= 0 and first * high_unit < high * (first - last):
            high, high_unit = first, first - last
        a, b = c, d
    return (fmpq(low, low_unit), fmpq(high, high_unit)) if low * high_unit < high * low_unit else None


def _united(spans: Iterable[Span]) -> list[Span]:
    """Unite closed intervals that meet."""
    result: list[Span] = []
    for low, high in sorted(spans):
        if result and low <= result[-1][1]:
            result[-1] = result[-1][0], max(result[-1][1], high)
        else:
            result.append((low, high))
    return result


def _reversed(line: Line) -> Line:
    return -line[0], -line[1], -line[2]


def _common(spans: list[Span], others: list[Span], line: Line) -> list[Span]:
    """Return the parts of positive length in both of some intervals, and of others that run the other way."""
    both = ((max(low, -last), min(high, -first)) for low, high in spans for first, last in others)
    return sorted((low, high) for low, high in both if low < high)


def _without(spans: list[Span], taken: list[Span]) -> Iterator[Span]:
    """Yield the parts of positive length of some intervals outside of disjoint others."""
    for low, high in spans:
        for first, last in taken:
            if low < last and first < high:
                if low < first:
                    yield low, first
                low = last
        if low < high:
            yield low, high


def _ends(line: Line, low: Any, high: Any) -> tuple[Place, Place]:
    """Return the points of a line at two positions."""
    u, v, offset = line
    square = u * u + v * v
    return ((u * low - v * offset) / square, (v * low + u * offset) / square), (
        (u * high - v * offset) / square,
        (v * high + u * offset) / square,
    )


def _is_on(p: Place, lines: dict[Line, list[Span]]) -> bool:
    """True if a point is on one of some segments."""
    x, y = p
    return any(
        u * y - v * x == offset and any(low <= u * x + v * y <= high for low, high in spans)
        for (u, v, offset), spans in lines.items()
    )


def _chained(edges: list[tuple[Place, Place]]) -> list[list[Place]]:
    """Return closed rings of edges; where several meet, each ring goes around the region on its left alone."""
    leaving: dict[Place, list[int]] = defaultdict(list)
    for k, (p, _) in enumerate(edges):
        leaving[p].append(k)
    rings, used = [], [False] * len(edges)
    for first in range(len(edges)):
        ring, k = list[Place](), first
        while not used[k]:
            used[k] = True
            ring.append(edges[k][0])
            k = _next(edges, k, leaving[edges[k][1]])
        rings += [corners for part in _simple(ring) if (corners := _corners(part))]
    return sorted(rings, key=min)


def _simple(ring: list[Place]) -> Iterator[list[Place]]:
    """Split a ring where it visits a point again."""
    path: list[Place] = []
    place: dict[Place, int] = {}
    for p in ring:
        if p in place:
            first = place[p]
            yield path[first:]
            for other in path[first:]:
                del place[other]
            del path[first:]
        place[p] = len(path)
        path.append(p)
    yield path


def _corners(ring: list[Place]) -> list[Place]:
    """Return a ring without points on straight lines, the least point first."""
    turns = [
        p
        for (ax, ay), p, (cx, cy) in zip((ring[-1:] + ring)[:-1], ring, ring[1:] + ring[:1], strict=True)
        if (p[0] - ax) * (cy - p[1]) != (p[1] - ay) * (cx - p[0])
    ]
    k = turns.index(min(turns)) if turns else 0
    return turns[k:] + turns[:k]


def _next(edges: list[tuple[Place, Place]], k: int, leaving: list[int]) -> int:
    """Return the edge after edge k around the region on its left: the first one clockwise from the way back."""
    if len(leaving) == 1:
        return leaving[0]
    (ax, ay), (bx, by) = edges[k]
    x, y = ax - bx, ay - by

    def turned(j: int) -> tuple[Any, Any]:
        """Direction of an edge, seen from the way back and mirrored."""
        (px, py), (qx, qy) = edges[j]
        dx, dy = qx - px, qy - py
        return x * dx + y * dy, y * dx - x * dy

    def compared(i: int, j: int) -> int:
        (a, b), (c, d) = turned(i), turned(j)
        upper, other = _is_upper(a, b), _is_upper(c, d)
        if upper != other:
            return -1 if upper else 1
        cross = a * d - b * c
        return -1 if cross > 0 else int(cross < 0)

    return min(leaving, key=cmp_to_key(compared))


def _is_upper(x: Any, y: Any) -> bool:
    """True for angles in (0, 180] degrees; the way back itself comes last."""
    return bool(y > 0 or (y == 0 and x < 0))
