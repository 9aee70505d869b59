"""The forbidden slice at a rational tau, exactly: its boundary as oriented segments, and its isolated free points.

It shares nothing with the package: convex pieces by recursive cuts, sums as hulls of all pairwise sums, and every edge
of every sum cut by all the others. C_forb is open, so the remainder of an edge is closed: segments, and single points.

    Segments    {line: [(low, high), ...]}, disjoint closed intervals in ascending order
    line        (ux, uy, offset): primitive integer direction u, u x p = offset; forbidden is on its left
    low, high   positions u . p of the ends

Both sides of a slit of no width are there, on lines of opposite directions.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise, product
from typing import Any, NamedTuple

from flint import fmpq

from oracles import edges, exact_hull, exact_rotation, orient, ring_area
from shapes import PlainScene, Shape, box

Point = tuple[Any, Any]
Ring = tuple[Point, ...]
Line = tuple[int, int, Fraction]
Interval = tuple[Fraction, Fraction]
Segments = dict[Line, list[Interval]]


class ExactSlice(NamedTuple):
    """Boundary of the forbidden slice; `points` are the free points that have no free point near them."""

    segments: Segments
    points: set[Point]

    @property
    def slits(self) -> Segments:
        """Free segments of no width, each once in either direction. With the points, they are the free part outside the
        closure of the interior of free space."""
        return common(self.segments, reverse(self.segments))


class Region(NamedTuple):
    """An open convex set of integer points, where ux * y - uy * x > offset for all (ux, uy, offset) of `sides`.

    `rim` are the visible sides, `box` surrounds it if it is bounded.
    """

    sides: list[tuple[int, int, int]]
    rim: list[tuple[Point, Point]]
    box: tuple[int, int, int, int] | None = None

    @classmethod
    def left_of(cls, sides: Iterable[tuple[Point, Point]], box: Any = None) -> Region:
        rim = list(sides)
        lines = [(q[0] - p[0], q[1] - p[1], q[0] * p[1] - q[1] * p[0]) for p, q in rim]
        return cls(lines, rim, box)


def exact_slice(plain: PlainScene, tau: Fraction | None) -> ExactSlice:
    """Boundary of the forbidden slice at tan(theta/2) = tau; None is the half turn."""
    c, s = exact_rotation(tau)
    turned = [[(c * x - s * y, s * x + c * y) for x, y in part] for part in _pieces(plain.robot)]
    walls = _pieces(_walls(plain))
    limits = [tuple(map(Fraction, limit)) for limit in _limits(plain)]
    numbers = [v for ring in [*turned, *walls] for p in ring for v in p] + [v for limit in limits for v in limit]
    scale = math.lcm(*(v.denominator for v in numbers))

    def whole(ring: Iterable[Point]) -> list[Point]:
        return [(int(x * scale), int(y * scale)) for x, y in ring]

    sums = {_sum(wall, part) for part in map(whole, turned) for wall in map(whole, walls)}
    regions = [Region.left_of(edges(ring), _box(ring)) for ring in sums]
    for k, (x0, y0, x1, y1) in enumerate(limits):
        ring = whole([(x0, y0), (x0, y1), (x1, y1), (x1, y0)])  # clockwise: forbidden outside
        shown = k == 0 and plain.bounds is not None
        beyond = [Region.left_of([side]) for side in edges(ring)]
        regions += beyond if shown else [region._replace(rim=[]) for region in beyond]
    return _visible(regions, scale)


def _visible(regions: Sequence[Region], scale: int) -> ExactSlice:
    """Parts of the rims that are in no region."""
    parts: list[tuple[Line, Interval]] = []
    single: set[Point] = set()
    for region in regions:
        for p, q in region.rim:
            ux, uy = q[0] - p[0], q[1] - p[1]
            g = math.gcd(ux, uy)
            line = ux // g, uy // g, Fraction(ux // g * p[1] - uy // g * p[0], scale)
            start, length = ux // g * p[0] + uy // g * p[1], (ux * ux + uy * uy) // g
            for low, high in _uncovered(p, q, regions):
                if low < high:
                    parts.append((line, ((start + low * length) / scale, (start + high * length) / scale)))
                else:
                    single.add((Fraction(p[0] + low * ux) / scale, Fraction(p[1] + low * uy) / scale))
    segments = united(parts)
    return ExactSlice(segments, {p for p in single if not on_some(p, segments)})


def _uncovered(p: Point, q: Point, regions: Sequence[Region]) -> list[Interval]:
    """Closed intervals of [0, 1] where p + t (q - p) is in no region; a point may be left between open intervals."""
    x0, x1, y0, y1 = min(p[0], q[0]), max(p[0], q[0]), min(p[1], q[1]), max(p[1], q[1])
    covered = []
    for region in regions:
        if region.box:
            u0, v0, u1, v1 = region.box
            if x1 <= u0 or u1 <= x0 or y1 <= v0 or v1 <= y0:
                continue
        inside = _inside(p, q, region.sides)
        if inside:
            if inside[0] < 0 and inside[1] > 1:
                return []
            covered.append(inside)
    left, reach = [], fmpq(0)
    for low, high in sorted(covered):
        if low >= reach:
            left.append((reach, low))
        reach = max(reach, high)
    if reach <= 1:
        left.append((reach, fmpq(1)))
    return [(_fraction(low), _fraction(high)) for low, high in left]


def _fraction(x: fmpq) -> Fraction:
    return Fraction(int(x.p), int(x.q))


def _inside(p: Point, q: Point, sides: Sequence[tuple[int, int, int]]) -> tuple[fmpq, fmpq] | None:
    """The open interval of t where p + t (q - p) is left of all sides; beyond [0, 1] it ends at -1 or 2."""
    low, low_by, high, high_by = -1, 1, 2, 1
    for ux, uy, offset in sides:
        at_p, at_q = ux * p[1] - uy * p[0] - offset, ux * q[1] - uy * q[0] - offset
        if at_p <= 0:
            if at_q <= 0:
                return None
            if -at_p * low_by > low * (at_q - at_p):
                low, low_by = -at_p, at_q - at_p
        elif at_q <= 0 and at_p * high_by < high * (at_p - at_q):
            high, high_by = at_p, at_p - at_q
    return (fmpq(low, low_by), fmpq(high, high_by)) if low * high_by < high * low_by else None


def _sum(wall: Sequence[Point], part: Sequence[Point]) -> Ring:
    """Sum wall (+) -part."""
    return exact_hull((bx - ax, by - ay) for (bx, by), (ax, ay) in product(wall, part))


def _box(ring: Ring) -> tuple[int, int, int, int]:
    xs, ys = zip(*ring, strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def _pieces(shapes: Iterable[Shape]) -> list[Ring]:
    return [piece for shape in shapes for piece in convex_pieces(_fractions(shape))]


def _walls(plain: PlainScene) -> list[Shape]:
    """Polygons that the robot must not overlap."""
    solids = list(plain.obstacles)
    if plain.workspace:
        outer, holes = plain.workspace
        x0, y0, x1, y1 = _around(plain, 3)
        solids += [(box(x0, y0, x1, y1)[0], [list(outer)]), *((list(hole), []) for hole in holes)]
    return solids


def _limits(plain: PlainScene) -> list[tuple[Any, Any, Any, Any]]:
    """Boxes that hold the reference point: the bounds, and one around the workspace, whose complement is a frame."""
    return [*([plain.bounds] if plain.bounds else []), *([_around(plain, 2)] if plain.workspace else [])]


def _around(plain: PlainScene, times: int) -> tuple[Fraction, Fraction, Fraction, Fraction]:
    """The workspace's box, enlarged by a multiple of the robot's radius, or more."""
    assert plain.workspace is not None
    radius = max(abs(Fraction(x)) + abs(Fraction(y)) for outer, _ in plain.robot for x, y in outer)
    xs, ys = zip(*((Fraction(x), Fraction(y)) for x, y in plain.workspace[0]), strict=True)
    reach = times * radius
    return min(xs) - reach, min(ys) - reach, max(xs) + reach, max(ys) + reach


# --- convex pieces ---


def _fractions(shape: Shape) -> tuple[Ring, ...]:
    """Rings with the interior on their left."""
    rings = [tuple((Fraction(x), Fraction(y)) for x, y in ring) for ring in (shape[0], *shape[1])]
    return tuple(ring if (ring_area(ring) > 0) == (k == 0) else ring[::-1] for k, ring in enumerate(rings))


@lru_cache(maxsize=10_000)
def convex_pieces(rings: tuple[Ring, ...]) -> tuple[Ring, ...]:
    """Convex rings that tile a polygon with holes: cut from a reflex vertex to a visible one, until there is none.

    A cut to a hole joins its ring to the first; a cut within the first divides it, and each hole goes to its part.
    Where rings touch, the cut has no length; those come first, so that no hole touches a ring that is divided.
    """
    corners = {p for ring in rings for p in ring}
    parts = [tuple(_with_touches(ring, corners) for ring in rings)]
    pieces = []
    while parts:
        rings = parts.pop()
        cut = _next_cut(rings)
        if cut is None:
            pieces.append(rings[0])
        else:
            parts += _divided(rings, *cut)
    return tuple(pieces)


def _with_touches(ring: Ring, corners: set[Point]) -> Ring:
    """The ring with those of the corners on it that lie between its own."""
    whole: list[Point] = []
    for a, b in edges(ring):
        on = [v for v in corners if orient(a, b, v) == 0 and _between(a, v, b)]
        whole += [a, *sorted(on, reverse=b < a)]
    return tuple(whole)


Visit = tuple[int, int]  # ring, and vertex of it


def _next_cut(rings: Sequence[Ring]) -> tuple[Visit, Visit] | None:
    """Two visits to join, one of them on the first ring, or none if that is all there is and convex."""
    visits = [(r, k) for r, ring in enumerate(rings) for k in range(len(ring))]
    reflex = [(r, k) for r, k in visits if _corner(rings[r], k) < 0]
    pairs = [(one, other) for one in reflex for other in visits if one != other and 0 in (one[0], other[0])]
    touches = [(one, other) for one, other in pairs if _touch(rings, one, other)]
    if touches:
        return max(touches, key=lambda touch: touch[0][0] != touch[1][0])  # holes first
    seen = next(((one, other) for one, other in pairs if _sees(rings, one, other)), None)
    assert seen or not reflex, "a reflex vertex that sees no vertex"
    return seen


def _divided(rings: Sequence[Ring], one: Visit, other: Visit) -> list[tuple[Ring, ...]]:
    """Polygon cut open from one visit to the other: with a hole less, or its two parts."""
    (r, k), (s, m) = (one, other) if one[0] == 0 else (other, one)
    first, second = (rings[n][v:] + rings[n][:v] for n, v in ((r, k), (s, m)))
    bridge = int(first[0] != second[0])  # a cut without length has its ends but once
    if r != s:
        joined = (*first, *first[:bridge], *second, *second[:bridge])
        return [(joined, *(ring for n, ring in enumerate(rings[1:], 1) if n != s))]
    m = (m - k) % len(first)
    halves = first[: m + bridge], (*first[m:], *first[:bridge])
    return [(half, *(hole for hole in rings[1:] if _contains(half, hole[0]))) for half in halves]


def _corner(ring: Ring, k: int) -> Any:
    return orient(ring[k - 1], ring[k], ring[(k + 1) % len(ring)])


def _touch(rings: Sequence[Ring], one: Visit, other: Visit) -> bool:
    """True if one is in the corner at the other, at the same point."""
    ring, k = rings[one[0]], one[1]
    near, m = rings[other[0]], other[1]
    return ring[k] == near[m] and any(_in_corner(ring, k, p) for p in (near[m - 1], near[(m + 1) % len(near)]))


def _sees(rings: Sequence[Ring], one: Visit, other: Visit) -> bool:
    """True if the open segment between two vertices is inside the polygon, touching nothing."""
    p, q = rings[one[0]][one[1]], rings[other[0]][other[1]]
    if p == q or not (_in_corner(rings[one[0]], one[1], q) and _in_corner(rings[other[0]], other[1], p)):
        return False
    return not any(_blocks(a, b, p, q) for ring in rings for a, b in edges(ring))


def _in_corner(ring: Ring, k: int, p: Point) -> bool:
    before, here, after = ring[k - 1], ring[k], ring[(k + 1) % len(ring)]
    left = orient(before, here, p) > 0, orient(here, after, p) > 0
    return any(left) if _corner(ring, k) < 0 else all(left)


def _blocks(a: Point, b: Point, p: Point, q: Point) -> bool:
    """True if the edge ab meets the open segment pq."""
    sides = orient(p, q, a), orient(p, q, b)
    if sides[0] == 0 or sides[1] == 0:
        return any(side == 0 and _between(p, v, q) for side, v in zip(sides, (a, b), strict=True)) or (
            sides == (0, 0) and _between(a, p, b) and _between(a, q, b)
        )
    return sides[0] * sides[1] < 0 and orient(a, b, p) * orient(a, b, q) < 0


def _between(p: Point, v: Point, q: Point) -> bool:
    """True if v, on the line pq, is strictly between p and q."""
    return (v[0] - p[0]) * (v[0] - q[0]) + (v[1] - p[1]) * (v[1] - q[1]) < 0


def _contains(ring: Ring, p: Point) -> bool:
    """True if p, not on the ring, is inside it, by crossings with the ray to the right."""
    crossings = 0
    for a, b in edges(ring):
        if (a[1] > p[1]) != (b[1] > p[1]):
            crossings += (orient(a, b, p) > 0) == (b[1] > a[1])
    return crossings % 2 == 1


# --- sets of oriented segments ---


def united(parts: Iterable[tuple[Line, Interval]]) -> Segments:
    """Intervals of each line; those that touch or overlap are joined."""
    gathered: dict[Line, list[Interval]] = {}
    for line, interval in parts:
        gathered.setdefault(line, []).append(interval)
    return {line: _merged(intervals) for line, intervals in gathered.items()}


def _merged(intervals: Iterable[Interval]) -> list[Interval]:
    merged: list[Interval] = []
    for low, high in sorted(intervals):
        if merged and low <= merged[-1][1]:
            merged[-1] = merged[-1][0], max(merged[-1][1], high)
        else:
            merged.append((low, high))
    return merged


def oriented(p: Point, q: Point) -> tuple[Line, Interval]:
    """The segment from p to q, distinct rational points."""
    m = math.lcm(*(v.denominator for v in (*p, *q)))
    x, y, x1, y1 = (v.numerator * (m // v.denominator) for v in (*p, *q))
    g = math.gcd(x1 - x, y1 - y)
    ux, uy = (x1 - x) // g, (y1 - y) // g
    return (ux, uy, Fraction(ux * y - uy * x, m)), (Fraction(ux * x + uy * y, m), Fraction(ux * x1 + uy * y1, m))


def ends(segments: Segments) -> list[tuple[Point, Point]]:
    """Every segment as (from, to), forbidden on its left."""

    def at(line: Line, position: Fraction) -> Point:
        ux, uy, offset = line
        square = ux * ux + uy * uy
        return (ux * position - uy * offset) / square, (uy * position + ux * offset) / square

    return [(at(line, low), at(line, high)) for line, intervals in segments.items() for low, high in intervals]


def area(segments: Segments) -> Fraction:
    """Area of the forbidden part if it is bounded, else minus the area of the free part."""
    return sum((p[0] * q[1] - p[1] * q[0] for p, q in ends(segments)), Fraction(0)) / 2


def reverse(segments: Segments) -> Segments:
    return {
        (-ux, -uy, -offset): [(-high, -low) for low, high in reversed(intervals)]
        for (ux, uy, offset), intervals in segments.items()
    }


def both(first: Segments, second: Segments) -> Segments:
    return united(
        (line, each) for segments in (first, second) for line, intervals in segments.items() for each in intervals
    )


def common(first: Segments, second: Segments) -> Segments:
    """The segments in both; single points are left out."""
    parts = [
        (line, (max(low, bottom), min(high, top)))
        for line in first.keys() & second.keys()
        for (low, high), (bottom, top) in product(first[line], second[line])
    ]
    return united((line, interval) for line, interval in parts if interval[0] < interval[1])


def without(first: Segments, second: Segments) -> Segments:
    """Remainder of the first outside the second, closed again."""
    parts = []
    for line, intervals in first.items():
        taken = second.get(line, [])
        for low, high in intervals:
            cuts = [low, *(min(max(low, v), high) for interval in taken for v in interval), high]
            parts += [(line, gap) for gap in list(pairwise(cuts))[::2] if gap[0] < gap[1]]
    return united(parts)


def on_some(p: Point, segments: Segments) -> bool:
    return any(
        ux * p[1] - uy * p[0] == offset and any(low <= ux * p[0] + uy * p[1] <= high for low, high in intervals)
        for (ux, uy, offset), intervals in segments.items()
    )
