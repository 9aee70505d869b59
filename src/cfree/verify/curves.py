"""Compare round shapes with an answer's polygons: around the shapes for a path, inside them for a separation.

A ring of a shape is cut into pieces until no edge of the polygon's ring meets the hull of any. An arc of an ellipse
lies in the triangle of its ends and the point where their tangents meet, a Bézier curve in the hull of its control
points. Then each piece is on one side, given by the place of its hull. All of it is in rationals.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise, zip_longest
from typing import Any

from flint import fmpq

from cfree.curves.curved import Curved
from cfree.curves.drawn import Line
from cfree.curves.rings import Cubic, Piece
from cfree.exact.number import ExactPoint as FractionPoint
from cfree.polygons.polygon import Polygon
from cfree.scene.naming import placed
from cfree.scene.scene import AnyShape, Scene
from cfree.verify.arcs import exact, rational

DEEPEST = 60  # times that a piece is halved

Curve = Sequence[Piece]
Number = Any  # fmpq, which is many times quicker than Fraction
ExactPoint = tuple[Number, Number]
Ring = Sequence[ExactPoint]
Edge = tuple[ExactPoint, ExactPoint]
Wrong = Iterator[tuple[str, str]]


def mismatches(scene: Scene, polygons: Scene, *, outward: bool) -> Wrong:
    """Places and texts where polygons of a scene are not around the round shapes of another, or not inside of them.

    A shape too thin to have a polygon inside has none in an answer; the polygons of the others keep their order.
    """
    parts = [(f"robot[{k}]", shape) for k, shape in enumerate(scene.robot)]
    obstacles = [(placed(scene, k), shape) for k, shape in enumerate(scene.obstacles)]
    yield from _list("robot", parts, polygons.robot, outward)
    yield from _list("obstacles", obstacles, polygons.obstacles, outward)
    if (scene.workspace is None) != (polygons.workspace is None):
        yield "workspace", "only one of scene and answer has it"
    elif scene.workspace is not None and polygons.workspace is not None and scene.workspace != polygons.workspace:
        own = [polygons.workspace] if isinstance(polygons.workspace, Polygon) else []
        yield from _shape("workspace", scene.workspace, own, not outward)
    if scene.bounds != polygons.bounds:
        yield "bounds", "those of the answer are others"


def _list(place: str, shapes: Sequence[tuple[str, AnyShape]], polygons: Sequence[AnyShape], outward: bool) -> Wrong:
    """Shapes of the robot, or obstacles, and their polygons one after the other, or the shapes themselves."""
    missing = sum(_count(shape) for _, shape in shapes) - len(polygons)
    k = 0
    for name, shape in shapes:
        if isinstance(shape, Curved) and [*polygons[k : k + 1]] == [shape]:
            k += 1
            continue
        own = [polygon for polygon in polygons[k : k + _count(shape)] if isinstance(polygon, Polygon)]
        faults = [*_shape(name, shape, own, outward)]
        if faults and missing > 0 and not outward and isinstance(shape, Curved) and not shape.grown:
            missing -= 1
            continue
        yield from faults
        k += _count(shape)
    if k < len(polygons) and not (outward and place == "obstacles"):  # more forbid more
        yield place, "the answer has more polygons than the scene has shapes"


def _count(shape: AnyShape) -> int:
    return len(_base(shape).pieces) if isinstance(shape, Curved) and shape.grown else 1


def _base(shape: Curved) -> Polygon:
    return Polygon(shape.path, shape.holes)  # type: ignore[arg-type]


def _shape(name: str, shape: AnyShape, polygons: Sequence[Polygon], outward: bool) -> Wrong:
    """Compare one shape with its polygons; a grown shape has as many as it has convex pieces."""
    if isinstance(shape, Polygon):
        if list(polygons) != [shape]:
            yield name, "the answer's polygon is another"
        return
    if shape.grown:
        base, radius = _base(shape), rational(shape.grown)
        for number, (piece, polygon) in enumerate(zip_longest(base.pieces, polygons)):
            corners = _ring([base.exact_vertices[k] for k in piece])
            fits = polygon is not None and len(polygon.ring_offsets) == 2
            check = _is_around_sum if outward else _is_inside_sum
            if not (fits and check(corners, radius, _ring(polygon.exact_vertices))):
                yield f"{name}, piece {number}", f"it is not {'around' if outward else 'inside'} the grown piece"
        return
    rings = polygons[0].exact_rings if polygons else ()
    if not rings or len(rings) > len(shape.curves) or (not outward and len(rings) < len(shape.curves)):
        yield name, "there is no polygon for it, or one with other holes"
        return
    curves = shape.curves if len(rings) == len(shape.curves) else _with_polygons(shape.curves, rings)
    for k, (curve, ring) in enumerate(zip(curves, rings, strict=True)):
        contains = outward == (k == 0)
        if not (_is_around if contains else _is_inside)(curve, _ring(ring)):
            yield (
                f"{name}, {f'hole {k - 1}' if k else 'outer ring'}",
                (f"the polygon's ring is not {'around' if contains else 'inside'} the curve, or too near to tell"),
            )


def _with_polygons(curves: Sequence[Curve], rings: Sequence[Sequence[FractionPoint]]) -> list[Curve]:
    """Outer curve, and for each hole of a polygon the curve around it, or else any; other holes are filled."""
    outer, *holes = curves
    return [outer, *(next((hole for hole in holes if _is_inside(hole, _ring(ring))), holes[0]) for ring in rings[1:])]


def _ring(points: Sequence[FractionPoint]) -> list[ExactPoint]:
    return [*map(exact, points)]


# --- grown shapes ---


def _is_around_sum(piece: Ring, radius: Number, ring: Ring) -> bool:
    """True if a disc about each vertex of a convex piece is inside a convex ring."""
    return _is_convex(ring) and all(
        (height := _cross(a, b, p)) > 0 and height**2 >= radius**2 * _square(a, b)
        for a, b in _edges(ring)
        for p in piece
    )


def _is_inside_sum(piece: Ring, radius: Number, ring: Ring) -> bool:
    """True if each vertex of a ring is within the radius of a convex piece."""
    return all(_is_in_hull(p, piece) or any(_is_near(p, a, b, radius) for a, b in _edges(piece)) for p in ring)


def _is_convex(ring: Ring) -> bool:
    """True if the ring is counter-clockwise and turns left everywhere; a polygon's ring goes around once."""
    return all(_cross(a, b, c) > 0 for (a, b), (_, c) in pairwise([*_edges(ring), (ring[0], ring[1])]))


def _is_in_hull(p: ExactPoint, ring: Ring) -> bool:
    return all(_cross(a, b, p) >= 0 for a, b in _edges(ring))


def _is_near(p: ExactPoint, a: ExactPoint, b: ExactPoint, radius: Number) -> bool:
    along = (p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])
    if along <= 0:
        return bool(_square(a, p) <= radius**2)
    if along >= _square(a, b):
        return bool(_square(b, p) <= radius**2)
    return bool(_cross(a, b, p) ** 2 <= radius**2 * _square(a, b))


# --- rings of curves ---


@dataclass(frozen=True)
class _Arc:
    """Center + u (1 - s^2) / (1 + s^2) + v 2 s / (1 + s^2), for s from `first` to `last`, both from 0 to 1."""

    center: ExactPoint
    u: ExactPoint
    v: ExactPoint
    first: Number
    last: Number

    def hull(self) -> list[ExactPoint]:
        s, t = self.first, self.last
        return [self._at(1 - s * s, 2 * s, 1 + s * s), self._at(1 - s * t, s + t, 1 + s * t),
                self._at(1 - t * t, 2 * t, 1 + t * t)]  # fmt: skip

    def halves(self) -> tuple[_Arc, _Arc]:
        middle = (self.first + self.last) / 2
        fixed = self.center, self.u, self.v
        return _Arc(*fixed, self.first, middle), _Arc(*fixed, middle, self.last)

    def _at(self, c: Number, s: Number, w: Number) -> ExactPoint:
        (x, y), (p, q), (r, t) = self.center, self.u, self.v
        return x + (c * p + s * r) / w, y + (c * q + s * t) / w


@dataclass(frozen=True)
class _Bezier:
    points: tuple[ExactPoint, ...]

    def hull(self) -> list[ExactPoint]:
        return list(self.points)

    def halves(self) -> tuple[_Bezier, _Bezier]:
        left, right, row = [self.points[0]], [self.points[-1]], list(self.points)
        while len(row) > 1:
            row = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in pairwise(row)]
            left.append(row[0])
            right.append(row[-1])
        return _Bezier(tuple(left)), _Bezier(tuple(right[::-1]))


def _parts(piece: Piece) -> Iterator[_Arc | _Bezier]:
    match piece:
        case Line(start, end):
            yield _Bezier((exact(start), exact(end)))
        case Cubic(points):
            yield _Bezier(tuple(map(exact, points)))
        case _:
            center, u, v = map(exact, (piece.center, piece.u, piece.v))
            for _ in range(piece.quarters):
                yield _Arc(center, u, v, fmpq(0), fmpq(1))
                u, v = v, (-u[0], -u[1])
            if piece.rest:
                yield _Arc(center, u, v, fmpq(0), rational(piece.rest))


def _is_around(curve: Sequence[Piece], ring: Ring) -> bool:
    """True if all of a closed curve is inside a polygon's ring, or on it."""
    return _cut(curve, ring, lambda p: _side(p, ring) >= 0) is not None


def _is_inside(curve: Sequence[Piece], ring: Ring) -> bool:
    """True if no point of a closed curve is inside the ring, and the curve goes around it."""
    chords = _cut(curve, ring, lambda p: _side(p, ring) <= 0)
    return chords is not None and _turns(_point_inside(ring), chords) != 0


def _cut(curve: Sequence[Piece], ring: Ring, is_right: Callable[[ExactPoint], bool]) -> list[ExactPoint] | None:
    """Ends of pieces whose hulls no edge of the ring meets, if all are on the right side; else None."""
    ends: list[ExactPoint] = []
    edges, is_known = _edges(ring), False  # True if the next hull is on the same side as the last
    for piece in curve:
        for part in _parts(piece):
            waiting = [(part, 0, edges)]
            while waiting:
                item, depth, near = waiting.pop()
                hull = _convex_hull(item.hull())
                near = _met(hull, near)
                if len(hull) < 3:
                    if not all(map(is_right, _middles(hull, near))):
                        return None
                elif any(_meets_interior(hull, *edge) for edge in near):
                    if depth == DEEPEST:
                        return None
                    left, right = item.halves()
                    waiting += [(right, depth + 1, near), (left, depth + 1, near)]
                    continue
                elif not (is_known or is_right(_centroid(hull))):
                    return None
                first, *_, last = item.hull()
                ends.append(first)
                is_known = not any(_between(a, b, last) and _cross(a, b, last) == 0 for a, b in near)
    return ends


def _met(hull: Ring, edges: Sequence[Edge]) -> list[Edge]:
    """Edges whose boxes meet that of a hull."""
    (x0, y0), (x1, y1) = (tuple(end(p[k] for p in hull) for k in (0, 1)) for end in (min, max))
    return [
        (a, b)
        for a, b in edges
        if not (
            (a[0] < x0 and b[0] < x0)
            or (a[0] > x1 and b[0] > x1)
            or (a[1] < y0 and b[1] < y0)
            or (a[1] > y1 and b[1] > y1)
        )
    ]


def _meets_interior(hull: Ring, a: ExactPoint, b: ExactPoint) -> bool:
    """True if a segment meets the interior of a convex polygon."""
    low, high = fmpq(0), fmpq(1)
    for p, q in _edges(hull):
        start, end = _cross(p, q, a), _cross(p, q, b)
        if start <= 0 and end <= 0:
            return False
        if start < 0:
            low = max(low, start / (start - end))
        elif end < 0:
            high = min(high, start / (start - end))
    return low < high


def _middles(line: Ring, edges: Sequence[Edge]) -> Iterator[ExactPoint]:
    """A point of each part of a segment between the edges that it meets."""
    if len(line) < 2:
        yield from line
        return
    (a, b), places = line, {fmpq(0), fmpq(1)}
    long = _square(a, b)
    for p, q in edges:
        one, other = _cross(a, b, p), _cross(a, b, q)
        if one != other and one * other <= 0:
            x, y = (p[k] + (q[k] - p[k]) * one / (one - other) for k in (0, 1))
            places.add(((x - a[0]) * (b[0] - a[0]) + (y - a[1]) * (b[1] - a[1])) / long)
        elif one == other == 0:
            places |= {((c[0] - a[0]) * (b[0] - a[0]) + (c[1] - a[1]) * (b[1] - a[1])) / long for c in (p, q)}
    inside = sorted(place for place in places if 0 <= place <= 1)
    for s, t in pairwise(inside):
        m = (s + t) / 2
        yield a[0] + m * (b[0] - a[0]), a[1] + m * (b[1] - a[1])


def _side(p: ExactPoint, ring: Ring) -> int:
    """Side of a ring: 1 inside, 0 on the ring, -1 outside."""
    if any(_between(a, b, p) and _cross(a, b, p) == 0 for a, b in _edges(ring)):
        return 0
    return 1 if _turns(p, ring) else -1


def _turns(p: ExactPoint, ring: Ring) -> int:
    """Number of times a closed polygon that does not pass through a point goes around it."""
    count = 0
    for a, b in _edges(ring):
        if a[1] <= p[1] < b[1] and _cross(a, b, p) > 0:
            count += 1
        elif b[1] <= p[1] < a[1] and _cross(a, b, p) < 0:
            count -= 1
    return count


def _point_inside(ring: Ring) -> ExactPoint:
    """Point between the first two crossings of a horizontal line that passes through no vertex."""
    low, high, *_ = sorted({y for _, y in ring})
    y = (low + high) / 2
    xs = sorted(a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) for a, b in _edges(ring) if (a[1] < y) != (b[1] < y))
    return (xs[0] + xs[1]) / 2, y


def _convex_hull(points: Sequence[ExactPoint]) -> list[ExactPoint]:
    """Convex hull, counter-clockwise; two points if all are on one line."""
    ordered, halves = sorted(set(points)), list[list[ExactPoint]]()
    if len(ordered) < 3:
        return ordered
    for row in (ordered, ordered[::-1]):
        half: list[ExactPoint] = []
        for p in row:
            while len(half) > 1 and _cross(half[-2], half[-1], p) <= 0:
                half.pop()
            half.append(p)
        halves.append(half[:-1])
    return [*halves[0], *halves[1]]


def _centroid(ring: Ring) -> ExactPoint:
    return sum(x for x, _ in ring) / len(ring), sum(y for _, y in ring) / len(ring)


def _edges(ring: Ring) -> list[Edge]:
    return [*pairwise([*ring, ring[0]])]


def _cross(a: ExactPoint, b: ExactPoint, p: ExactPoint) -> Number:
    """Cross product, above 0 if p is to the left of the line from a to b."""
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def _square(a: ExactPoint, b: ExactPoint) -> Number:
    return (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2


def _between(a: ExactPoint, b: ExactPoint, p: ExactPoint) -> bool:
    return all(a[k] <= p[k] <= b[k] or b[k] <= p[k] <= a[k] for k in (0, 1))
