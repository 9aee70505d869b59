"""Polygons around rings of lines and curves, or inside of them, with a given error.

A piece of a curve lies in the hull of its control points; that of an arc in the triangle of its ends and of the point
where their tangents meet. If the shape is to the left of a ring, the chain of hull vertices to the right of each
piece is a polygon around it: of a piece that turns left it runs along tangents, of one that turns right it is the
chord. Pieces are halved until their hulls are flat. Vertices on this chain that are no ends of segments then move
outwards, far more than doubles err, and become short decimals: no new edge crosses an old one, so the polygon
contains the shape. Ends of straight segments stay what they are.

                T                the arc from P to Q turns left around the shape below it;
             .     .             around: P, T, Q     inside: P, Q
          P ---------- Q
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from itertools import pairwise

from cfree.curves.drawn import (
    Arc,
    Cubic,
    Line,
    Ring,
    Segment,
    Vector,
    ends,
    point_of,
    reversed_ring,
    straight,
    turn,
)
from cfree.errors import InvalidPolygonError
from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon

DEEPEST = 24  # times that a piece of a curve is halved
FINEST = 1e-9  # of the drawing's size: the least error that doubles can promise
Spend = Callable[[int], object]
TRIES = 4  # with an eighth of the error each, where the polygon crosses itself


@dataclass(frozen=True, slots=True)
class Outline:
    """Rings of one shape: the outer one, and its holes."""

    outer: Ring
    holes: tuple[Ring, ...] = ()

    @property
    def curved(self) -> bool:
        """Is not all of it straight?"""
        return not all(map(straight, (self.outer, *self.holes)))


def polygon_of(outline: Outline, tolerance: float, inside: bool = False, spend: Spend = abs) -> Polygon:
    """The polygon around a shape, or inside of it.

    Parameters
    ----------
    outline : Outline
        In any direction.
    tolerance : float
        No point of the polygon's boundary is farther from the shape's.
    inside : bool
        For workspaces: what is outside stays outside.
    spend : callable
        Called with the number of steps that are taken; it may refuse.

    Raises
    ------
    InvalidPolygonError
        If the rings cross, however small the error.

    Examples
    --------
    >>> from cfree.curves.drawn import arc_of_circle
    >>> disc = Outline([arc_of_circle((0, 0), 1)])
    >>> around, within = (polygon_of(disc, 0.1, inside) for inside in (False, True))
    >>> len(around), round(float(around.exact_area), 2), round(float(within.exact_area), 2)
    (10, 3.27, 2.92)
    """
    error = tolerance
    for attempt in range(TRIES):
        try:
            outer, *holes = (
                _points(_directed(ring, k == 0), error, inside, spend)
                for k, ring in enumerate((outline.outer, *outline.holes))
            )
            return Polygon(outer, holes)
        except InvalidPolygonError:
            if attempt == TRIES - 1 or not outline.curved:
                raise
            error /= 8
    raise AssertionError


def box_of(rings: Sequence[Ring]) -> tuple[float, float, float, float]:
    """A box around the control points of rings."""
    points = [p for ring in rings for segment in ring for p in _control(segment)] or [(0.0, 0.0)]
    xs, ys = zip(*points, strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def in_range(rings: Sequence[Ring]) -> bool:
    """Is every coordinate finite, and one that a scene may have?"""
    try:
        return all(abs(x) < 1e150 for ring in rings for segment in ring for p in _control(segment) for x in p)
    except (OverflowError, ValueError):  # beyond doubles; the cosine of infinity
        return False


def rough(ring: Ring) -> list[Vector]:
    """Some points of a ring in their order, enough to tell its direction."""
    return [p for segment in ring for piece in _halved(segment, 3) for p in piece[:1]]


def area(points: Sequence[Vector]) -> float:
    """Signed area: positive if counter-clockwise."""
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, [*points[1:], *points[:1]], strict=True)) / 2


def _directed(ring: Ring, outer: bool) -> Ring:
    """The ring with the shape on its left."""
    return ring if (area(rough(ring)) > 0) == outer else reversed_ring(ring)


def _points(ring: Ring, error: float, inside: bool, spend: Spend) -> list[ExactPoint]:
    """Vertices of the chain to the right of a ring with the shape on its left, or to the left of it."""
    if straight(ring):
        spend(len(ring))
        return [segment.start for segment in ring if isinstance(segment, Line)]
    points = _around(reversed_ring(ring) if inside else ring, error, spend)
    return points[::-1] if inside else points


@dataclass(slots=True)
class _Vertex:
    place: Vector
    exact: ExactPoint | None  # of an end that stays
    joint: bool = False  # of two pieces of one curve, where it is smooth
    corner: bool = False  # a vertex of a hull


def _around(ring: Ring, error: float, spend: Spend) -> list[ExactPoint]:
    x0, y0, x1, y1 = box_of([ring])
    error = max(error, FINEST * max(x1 - x0, y1 - y0, *map(abs, (x0, y0, x1, y1))))
    chain: list[_Vertex] = []
    for k, segment in enumerate(ring):
        if isinstance(segment, Line):
            chain.append(_Vertex(ends(segment)[0], segment.start))
            continue
        before = ring[k - 1]
        start = ends(segment)[0]
        kept = None
        if isinstance(before, Line):
            kept = before.end
        elif len(ring) > 1 and not _smooth(before, segment):
            kept = segment.tips[0] if segment.tips else point_of(*start)
        joint = isinstance(segment, Arc) and segment.closed
        for piece in _pieces(segment, 0.9 * error, spend):
            chain.append(_Vertex(piece[0], kept, joint))
            chain += [_Vertex(p, None, corner=True) for p in _right_of(piece)]
            kept, joint = None, True
    chain = [
        vertex
        for k, vertex in enumerate(chain)
        if not (vertex.joint and chain[k - 1].corner and chain[(k + 1) % len(chain)].corner)
    ]
    step = error / 32
    grid = Decimal(1).scaleb(math.floor(math.log10(step / 4)))
    return [
        vertex.exact or _moved(chain[k - 1].place, vertex.place, chain[(k + 1) % len(chain)].place, step, grid)
        for k, vertex in enumerate(chain)
    ]


def _moved(before: Vector, p: Vector, after: Vector, step: float, grid: Decimal) -> ExactPoint:
    """A vertex moved to the right of both its edges by `step` at least, and up to 1.5 times of it."""
    d, e = _unit(before, p), _unit(p, after)
    x, y = d[0] + e[0], d[1] + e[1]
    square = max(x * x + y * y, 1e-3)  # 2 + 2 cos of the turn
    x, y = p[0] + 2 * step * y / square, p[1] - 2 * step * x / square
    return _on_grid(x, grid), _on_grid(y, grid)


def _on_grid(value: float, grid: Decimal) -> Fraction:
    return Fraction(round(Fraction(value) / Fraction(grid))) * Fraction(grid)


def _pieces(segment: Segment, error: float, spend: Spend) -> Iterator[tuple[Vector, ...]]:
    """Control points of pieces with flat hulls, in their order."""
    if isinstance(segment, Arc):
        reach = max(math.hypot(*segment.u), math.hypot(*segment.v)) * math.sqrt(2)
        sweep = abs(segment.last - segment.first)
        step = min(math.pi / 4, max(1e-5, 2 * math.acos(1 / (1 + error / reach))) if reach else 1.0)
        count = max(1, math.ceil(sweep / step))
        spend(count)
        yield from _divided(segment, count)
        return
    waiting = [(_control(segment), 0)]
    while waiting:
        piece, depth = waiting.pop()
        spend(1)
        if depth >= DEEPEST or _flat(piece, error):
            yield piece
        else:
            left, right = _split(piece)
            waiting += [(right, depth + 1), (left, depth + 1)]


def _divided(arc: Arc, count: int) -> Iterator[tuple[Vector, ...]]:
    """Ends of equal pieces, and where the tangents there meet."""
    step = (arc.last - arc.first) / count
    scale = 1 / math.cos(step / 2)
    for k in range(count):
        t = arc.first + k * step
        yield arc.at(t), arc.at(t + step / 2, scale), arc.at(t + step)


def _control(segment: Segment) -> tuple[Vector, ...]:
    match segment:
        case Cubic(points, _):
            return points
        case Arc(center, u, v, _, _, _):
            x, y = (math.hypot(u[k], v[k]) for k in (0, 1))
            low, high = (center[0] - x, center[1] - y), (center[0] + x, center[1] + y)
            return segment.at(segment.first), low, high, segment.at(segment.last)
        case Line():
            return ends(segment)


def _halved(segment: Segment, depth: int) -> list[tuple[Vector, ...]]:
    if isinstance(segment, Arc):
        return list(_divided(segment, 4 << depth))
    pieces = [_control(segment)]
    for _ in range(depth if isinstance(segment, Cubic) else 0):
        pieces = [half for piece in pieces for half in _split(piece)]
    return pieces


def _split(piece: tuple[Vector, ...]) -> tuple[tuple[Vector, ...], tuple[Vector, ...]]:
    """De Casteljau at the middle."""
    left, right, row = [piece[0]], [piece[-1]], list(piece)
    while len(row) > 1:
        row = [((p[0] + q[0]) / 2, (p[1] + q[1]) / 2) for p, q in pairwise(row)]
        left.append(row[0])
        right.append(row[-1])
    return tuple(left), tuple(right[::-1])


def _flat(piece: tuple[Vector, ...], error: float) -> bool:
    """Does its control polygon go on along the chord, near to it, and turn by less than a right angle?"""
    x, y = piece[-1][0] - piece[0][0], piece[-1][1] - piece[0][1]
    length = math.hypot(x, y)
    if not length:
        return all(p == piece[0] for p in piece)
    along = [(p[0] - piece[0][0]) * x + (p[1] - piece[0][1]) * y for p in piece]
    beside = [abs((p[1] - piece[0][1]) * x - (p[0] - piece[0][0]) * y) for p in piece]
    legs = [_unit(p, q) for p, q in pairwise(piece) if p != q]
    turns = all(a[0] * b[0] + a[1] * b[1] > 0.1 for a, b in pairwise(legs))
    return turns and along == sorted(along) and max(beside) <= error * length


def _right_of(piece: tuple[Vector, ...]) -> list[Vector]:
    """Hull vertices strictly to the right of the chord, in their order; the piece goes on along it."""
    hull: list[Vector] = []
    for p in piece:
        while len(hull) > 1 and turn(hull[-2], hull[-1], p) <= 0:
            hull.pop()
        hull.append(p)
    return hull[1:-1]


def _smooth(before: Segment, after: Segment) -> bool:
    """Is there no sharp corner between two curves?"""
    a, b = _halved(before, 2)[-1], _halved(after, 2)[0]
    d, e = _unit(a[0], a[-1]), _unit(b[0], b[-1])
    return d[0] * e[0] + d[1] * e[1] > 0.5


def _unit(p: Vector, q: Vector) -> Vector:
    x, y = q[0] - p[0], q[1] - p[1]
    length = math.hypot(x, y) or 1.0
    return x / length, y / length
