"""Polygons proved to be around rings of lines and curves, or inside, with a given error.

A piece of a curve lies in the hull of its control points; an arc lies in the triangle of its ends and the intersection
of its end tangents. If the shape is to the left of a ring, the chain of hull vertices to the right of each piece is a
polygon around it. The chain follows the tangents of a piece that turns left, and the chord of one that turns right.
Pieces are halved until their hulls are flat. Vertices of this chain that are not ends of segments then move outwards,
by far more than the error of doubles, and become short decimals. Ends of straight segments stay fixed, if the polygon
then contains the shape, and their numbers are short: else those of a whole scene would be over a denominator of
thousands of digits.

                T                the arc from P to Q turns left around the shape below it;
             .     .             around: P, T, Q     inside: P, Q
          P ---------- Q

All this is done in doubles and yields only a candidate. The core decides exactly whether a polygon is around the curve,
or inside (`pieces.is_proved`). If it is not, a smaller error is tried.
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
from cfree.curves.pieces import Curve, drawn_of, exact_of, is_proved, thin_frame
from cfree.errors import InvalidPolygonError, UndecidedError
from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon

DEEPEST = 24  # halvings of a piece of a curve
FINEST = 1e-9  # least error that doubles can guarantee, per size of the drawing
NOISE = 1e-14  # bound of the rounding of doubles, per size of the drawing
Spend = Callable[[int], object]
TRIES = 4  # each with an eighth of the error, if rings cross
SMALLER = 8
LONGEST = 1 << 64  # denominator of a vertex that stays where it is
MOST = 1 << 12  # rings with more vertices are not tried with a smaller error


@dataclass(frozen=True, slots=True)
class Outline:
    """Rings of one shape, the outer one and its holes, with their exact curves if known."""

    outer: Ring
    holes: tuple[Ring, ...] = ()
    exact: tuple[Curve, ...] = ()

    @property
    def rings(self) -> tuple[Ring, ...]:
        """All rings, the outer one first."""
        return self.outer, *self.holes

    @property
    def curved(self) -> bool:
        """True if some ring is not straight."""
        return not all(map(straight, self.rings))


def polygon_of(outline: Outline, tolerance: float, inside: bool = False, spend: Spend = abs) -> Polygon:
    """Return a polygon that is proved to be around a shape, or inside it.

    Parameters
    ----------
    outline : Outline
        Rings in any direction.
    tolerance : float
        No point of the polygon's boundary is farther from the shape's.
    inside : bool
        For workspaces: points outside the shape stay outside.
    spend : callable
        Called with the number of steps before they are taken; it may refuse.

    Raises
    ------
    InvalidPolygonError
        If the rings cross at every error tried.
    UndecidedError
        If no polygon can be proved to be around the outer ring, or inside it: doubles are too coarse for it. For a
        polygon around the shape, a hole too thin to have a polygon inside is filled.

    Examples
    --------
    >>> from cfree.curves.drawn import arc_of_circle
    >>> disc = Outline([arc_of_circle((0, 0), 1)])
    >>> around, within = (polygon_of(disc, 0.1, inside) for inside in (False, True))
    >>> len(around), round(float(around.exact_area), 2), round(float(within.exact_area), 2)
    (10, 3.27, 2.92)
    """
    error = tolerance
    curves = outline.exact or tuple(() if straight(ring) else exact_of(ring) for ring in outline.rings)
    for attempt in range(TRIES):
        outer, *holes = (
            _proved(ring, curve, error, inside == (k == 0), spend, needed=inside or k == 0)
            for k, (ring, curve) in enumerate(zip(outline.rings, curves, strict=True))
        )
        try:
            return Polygon(outer, [hole for hole in holes if hole])
        except InvalidPolygonError:
            if attempt == TRIES - 1 or not outline.curved or sum(map(len, holes), len(outer)) > MOST:
                raise
            error /= SMALLER
    raise AssertionError


def _proved(ring: Ring, curve: Curve, error: float, within: bool, spend: Spend, *, needed: bool) -> list[ExactPoint]:
    """Vertices of a ring proved to be within a curve, or around it; an empty list if there is none and none needed."""
    if straight(ring):
        spend(len(ring))
        return [segment.start for segment in ring if isinstance(segment, Line)]
    frame, local = thin_frame(curve), curve
    if frame:
        local, error = frame.local(curve), error / frame.length
        ring = drawn_of(local)
    ring = _counterclockwise(ring)
    least, crossings = _least_error(ring), 0
    while True:
        for keep in (True, False):
            points = _chain(ring, max(error, least), within, keep, spend)
            try:
                polygon = Polygon(points)
            except InvalidPolygonError:
                crossings += 1
                if not within and crossings == TRIES:
                    raise
                break
            if is_proved(polygon, 0, local, within=within):
                return [frame.world(p) for p in points] if frame else points
        if error <= least or len(points) > MOST:
            break
        error /= SMALLER
    if not needed:
        return []
    kind = "inside" if within else "around"
    raise UndecidedError(
        f"no polygon {kind} it can be proved: it is too thin, has cusps, or is too near to itself",
        error=error * (frame.length if frame else 1.0),
    )


def is_short(p: ExactPoint) -> bool:
    """True if a point's denominators have at most as many bits as those of decimals and doubles."""
    return max(x.denominator for x in p) <= LONGEST


def box_of(rings: Sequence[Ring]) -> tuple[float, float, float, float]:
    """Box around the control points of rings."""
    points = [p for ring in rings for segment in ring for p in _control(segment)] or [(0.0, 0.0)]
    xs, ys = zip(*points, strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def in_range(rings: Sequence[Ring]) -> bool:
    """True if every coordinate is finite and within the range of scenes."""
    try:
        return all(abs(x) < 1e150 for ring in rings for segment in ring for p in _control(segment) for x in p)
    except (OverflowError, ValueError):  # beyond doubles; the cosine of infinity
        return False


def rough(ring: Ring) -> list[Vector]:
    """Some points of a ring in order, enough to determine its direction."""
    return [p for segment in ring for piece in _halved(segment, 3) for p in piece[:1]]


def area(points: Sequence[Vector]) -> float:
    """Signed area: positive if counter-clockwise."""
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, [*points[1:], *points[:1]], strict=True)) / 2


def _counterclockwise(ring: Ring) -> Ring:
    return ring if area(rough(ring)) > 0 else reversed_ring(ring)


def _least_error(ring: Ring) -> float:
    """Least error for a ring: it grows with the largest number from which points are computed."""
    x0, y0, x1, y1 = box_of([ring])
    far = [abs(x) for arc in ring if isinstance(arc, Arc) and not arc.base for x in (*arc.center, *arc.u, *arc.v)]
    return FINEST * max(x1 - x0, y1 - y0, *map(abs, (x0, y0, x1, y1)), *far)


def _chain(ring: Ring, error: float, within: bool, keep: bool, spend: Spend) -> list[ExactPoint]:
    """Vertices of the chain to the right of a counter-clockwise ring; `within`, to the left."""
    points = _around(reversed_ring(ring) if within else ring, error, keep, spend)
    return points[::-1] if within else points


@dataclass(slots=True)
class _Vertex:
    place: Vector
    exact: ExactPoint | None  # set for an end that stays fixed
    joint: bool = False  # a smooth joint of two pieces of one curve
    corner: bool = False  # a vertex of a hull


def _around(ring: Ring, error: float, keep: bool, spend: Spend) -> list[ExactPoint]:
    """Vertices of the chain; with `keep`, joints of a curve and its neighbour stay fixed, else they also move."""
    noise = NOISE / FINEST * _least_error(ring)
    chain: list[_Vertex] = []
    for k, segment in enumerate(ring):
        before = ring[k - 1]
        if isinstance(segment, Line):
            stays = keep or isinstance(before, Line)
            chain.append(_Vertex(ends(segment)[0], segment.start if stays and is_short(segment.start) else None))
            continue
        start = ends(segment)[0]
        fixed = None
        if isinstance(before, Line):
            fixed = before.end if is_short(before.end) else None
        elif len(ring) > 1 and not _smooth(before, segment):
            fixed = segment.tips[0] if segment.tips else point_of(*start)
        joint = isinstance(segment, Arc) and segment.closed
        for piece in _pieces(segment, 0.9 * error, spend):
            chain.append(_Vertex(piece[0], fixed if keep else None, joint))
            chain += [_Vertex(p, None, corner=True) for p in _right_of(piece, noise)]
            fixed, joint = None, True
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
    """Move a vertex to the right of both its edges, by `step` to 1.5 times `step`."""
    d, e = _unit(before, p), _unit(p, after)
    x, y = d[0] + e[0], d[1] + e[1]
    square = max(x * x + y * y, 1e-3)  # 2 + 2 cos of the turn
    x, y = p[0] + 2 * step * y / square, p[1] - 2 * step * x / square
    return _on_grid(x, grid), _on_grid(y, grid)


def _on_grid(value: float, grid: Decimal) -> Fraction:
    return Fraction(round(Fraction(value) / Fraction(grid))) * Fraction(grid)


def _pieces(segment: Segment, error: float, spend: Spend) -> Iterator[tuple[Vector, ...]]:
    """Control points of pieces with flat hulls, in order."""
    if isinstance(segment, Arc):
        reach = max(math.hypot(*segment.u), math.hypot(*segment.v)) * math.sqrt(2)
        sweep = abs(segment.last - segment.first)
        share = error / reach if reach else 1.0
        step = min(math.pi / 4, 2 * math.atan(math.sqrt(share * (2 + share))))  # 2 acos(1 / (1 + share))
        count = max(1, math.ceil(min(sweep / step, 1e6)))
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
    """Split an arc into equal pieces: start, intersection of the end tangents, end."""
    step = (arc.last - arc.first) / count
    for k in range(count):
        t = arc.first + k * step
        yield arc.at(t), arc.at(t + step / 2, step / 2), arc.at(t + step)


def _control(segment: Segment) -> tuple[Vector, ...]:
    match segment:
        case Cubic(points, _):
            return points
        case Arc():
            sweep = abs(segment.last - segment.first)
            count = math.ceil(sweep / (math.pi / 8)) if sweep < 1e3 else 1  # more is no angle
            return tuple(p for part in _divided(segment, max(1, count)) for p in part)
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
    """Split a Bézier curve in the middle, by de Casteljau's algorithm."""
    left, right, row = [piece[0]], [piece[-1]], list(piece)
    while len(row) > 1:
        row = [((p[0] + q[0]) / 2, (p[1] + q[1]) / 2) for p, q in pairwise(row)]
        left.append(row[0])
        right.append(row[-1])
    return tuple(left), tuple(right[::-1])


def _flat(piece: tuple[Vector, ...], error: float) -> bool:
    """True if the control polygon is near the chord, monotone along it, and turns by less than a right angle."""
    x, y = piece[-1][0] - piece[0][0], piece[-1][1] - piece[0][1]
    length = math.hypot(x, y)
    if not length:
        return all(p == piece[0] for p in piece)
    along = [(p[0] - piece[0][0]) * x + (p[1] - piece[0][1]) * y for p in piece]
    beside = [abs((p[1] - piece[0][1]) * x - (p[0] - piece[0][0]) * y) for p in piece]
    legs = [_unit(p, q) for p, q in pairwise(piece) if p != q]
    turns = all(a[0] * b[0] + a[1] * b[1] > 0.1 for a, b in pairwise(legs))
    return turns and along == sorted(along) and max(beside) <= error * length


def _right_of(piece: tuple[Vector, ...], noise: float) -> list[Vector]:
    """Hull vertices to the right of the chord, in order; the chord's middle if doubles cannot decide.

    The piece is monotone along its chord.
    """
    (x0, y0), (x1, y1) = first, last = piece[0], piece[-1]
    length = math.hypot(x1 - x0, y1 - y0)
    if all(abs(turn(first, last, p)) <= noise * length for p in piece[1:-1]):
        return [((x0 + x1) / 2, (y0 + y1) / 2)]
    hull: list[Vector] = []
    for p in piece:
        while len(hull) > 1 and turn(hull[-2], hull[-1], p) <= 0:
            hull.pop()
        hull.append(p)
    return hull[1:-1]


def _smooth(before: Segment, after: Segment) -> bool:
    """True if there is no sharp corner between two curves."""
    a, b = _halved(before, 2)[-1], _halved(after, 2)[0]
    d, e = _unit(a[0], a[-1]), _unit(b[0], b[-1])
    return d[0] * e[0] + d[1] * e[1] > 0.5


def _unit(p: Vector, q: Vector) -> Vector:
    x, y = q[0] - p[0], q[1] - p[1]
    length = math.hypot(x, y) or 1.0
    return x / length, y / length
