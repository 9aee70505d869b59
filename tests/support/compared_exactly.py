"""Compare a boundary's slices with the exact ones, as sets of oriented segments on lines: equal, no tolerance."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from cfree import Boundary
from cfree.contact.kind import Kind
from cfree.forbidden.columns import Trapezoids
from cfree.forbidden.patch import contact
from cfree.scene.features import SceneFeatures, ShapeFeatures, unpacked
from compared import Point, cross, minus, plain_of, turned
from exact_slices import Segments, both, common, ends, exact_slice, on_some, oriented, united, without
from shapes import PlainScene

Whole = tuple[int, int]
BEFORE, AFTER = -1, 1


class Undecided(Exception):
    """A tau in the interval of a critical angle whose condition needs more than this file can decide."""


class Orientation(NamedTuple):
    """theta = 2 atan(tau) + chart * pi, tau in [-1, 1]."""

    chart: int
    tau: Fraction

    @classmethod
    def of(cls, half_tangent: Fraction | None, side: int = AFTER) -> Orientation:
        """Orientation in the chart that holds the angle and those just before or after it; None is the half turn."""
        if half_tangent is None:
            return cls(1, Fraction(0))
        tau = Fraction(half_tangent)
        if abs(tau) < 1 or tau == -side:
            return cls(0, tau)
        return cls(1, -1 / tau)


def differences(result: Boundary, half_tangent: Fraction | None, plain: PlainScene | None = None) -> list[str]:
    """Faults of a boundary at an orientation, critical or not: none if all is well.

    The limits of its slices from before and after it, and the isolated parts, are the exact slice's boundary, no more
    and no less. Each limit has all of it but slits, which may be there on one side only, or at this angle only.
    """
    exact = exact_slice(plain or plain_of(result.scene), half_tangent)
    (reached, closed), wrong = ({}, set[Point]()), []
    for side, name in ((BEFORE, "before"), (AFTER, "after")):
        limits = list(slice_ends(result, half_tangent, side))
        stored = united(oriented(p, q) for p, q in limits if p != q)
        closed |= {p for p, q in limits if p == q}
        reached = both(reached, stored)
        missing = without(without(exact.segments, stored), exact.slits)
        wrong += _told(f"{name}, is missing", missing)
        wrong += _told(f"{name}, is no boundary", without(stored, exact.segments))
    segments, points = isolated_at(result, half_tangent)
    wrong += _told("isolated, is no slit", without(segments, exact.slits))
    wrong += _told("isolated, is on a trapezoid", common(segments, reached))
    wrong += _told("of a slit, is missing", without(without(exact.segments, reached), segments))
    wrong += [f"the point {p} is missing" for p in exact.points - points - closed]
    wrong += [f"the point {p} is not free" for p in points - exact.points if not on_some(p, exact.segments)]
    return [f"tau {half_tangent}: {line}" for line in wrong]


def _told(what: str, segments: Segments) -> list[str]:
    return [
        "from ({:.9g}, {:.9g}) to ({:.9g}, {:.9g}), {}".format(*map(float, (*p, *q)), what) for p, q in ends(segments)
    ]


def slice_segments(result: Boundary, half_tangent: Fraction | None, side: int = AFTER) -> Segments:
    """Segments of the trapezoids at an angle, exactly; at a critical one their limits from before or after it."""
    return united(oriented(p, q) for p, q in slice_ends(result, half_tangent, side) if p != q)


def slice_ends(result: Boundary, half_tangent: Fraction | None, side: int) -> Iterator[tuple[Point, Point]]:
    """Both ends of each trapezoid at an angle, the same where it closes there."""
    angle, columns = Orientation.of(half_tangent, side), result.trapezoids
    for k in trapezoids_at(result, angle, side):
        own = own_code(result, int(columns.patch[k]))
        low, high = (limit(result, own, int(curve[k]), angle) for curve in (columns.lower, columns.upper))
        assert 0 <= low <= high <= 1, f"trapezoid {k} at {angle}: t from {low} to {high}"
        yield _on(result, own, low, angle), _on(result, own, high, angle)


def limit(result: Boundary, own: int, curve: int, angle: Orientation) -> Fraction:
    """Value t = N / D of a curve on a patch's line; its limit where both vanish."""
    numerator, denominator = _quotient(result, own, curve, angle)
    if denominator:
        return Fraction(numerator, denominator)
    # N and D are quadratics in tau: their values, first and second differences determine them near by
    (n0, d0), (n1, d1) = (_quotient(result, own, curve, angle._replace(tau=angle.tau + step)) for step in (-1, 1))
    before = numerator
    for n, d in ((n1 - n0, d1 - d0), (n1 + n0, d1 + d0)):  # the values themselves are 0
        assert before == 0, f"{contact(result, curve)} has no limit on {contact(result, own)} at {angle}"
        if d:
            return Fraction(n, d)
        before = n
    raise AssertionError(f"{contact(result, curve)} lies on the surface of {contact(result, own)}")


def _quotient(result: Boundary, own: int, curve: int, angle: Orientation) -> tuple[int, int]:
    """N and D, as polynomials in tau, times a positive constant: one for all tau with the same denominator."""
    first, second = _placed(result.features, own, angle), _placed(result.features, curve, angle)
    (origin, along), (point, direction), w = first, second, _w(angle)
    u = minus(point, origin)
    if curve >> 61 == Kind.VERTEX_VERTEX:
        assert cross(u, along) == 0, f"{contact(result, curve)} is not on the surface of {contact(result, own)}"
        return u[0] * along[0] + u[1] * along[1], along[0] ** 2 + along[1] ** 2
    # R a x R g = a x g, so that one of the two w's that a product has is a factor of it
    n, d = (divmod(cross(vector, direction), w) for vector in (u, along))
    assert n[1] == d[1] == 0
    return n[0], d[0]


@lru_cache(maxsize=10_000)
def _placed(features: SceneFeatures, code: int, angle: Orientation) -> tuple[Whole, Whole]:
    """Point and direction of a packed pair in a slice, forbidden on its left; for two edges, their directions.

    In integers, times the scale and w. Named by number and not by place: corners of the frame have none.
    """
    kind, i, j = unpacked(code)
    robot, obstacles = features.robot, features.obstacles
    p, q = angle.tau.numerator, angle.tau.denominator
    w, sign = _w(angle), -1 if angle.chart else 1
    turn = sign * (q * q - p * p), sign * 2 * p * q

    def fixed(vector: Whole) -> Whole:
        return w * vector[0], w * vector[1]

    def edge(shape: ShapeFeatures, k: int) -> Whole:
        return minus(shape.vertices[shape.w[k]], shape.vertices[shape.v[k]])

    if kind == Kind.EDGE_EDGE:
        return turned(turn, edge(robot, i)), fixed(edge(obstacles, j))
    a = robot.vertices[robot.v[i] if kind == Kind.EDGE_VERTEX else i]
    b = obstacles.vertices[obstacles.v[j] if kind == Kind.VERTEX_EDGE else j]
    direction = 0, 0
    if kind == Kind.VERTEX_EDGE:
        direction = fixed(edge(obstacles, j))
    if kind == Kind.EDGE_VERTEX:
        direction = turned(turn, minus((0, 0), edge(robot, i)))
    return minus(fixed(b), turned(turn, a)), direction


def _w(angle: Orientation) -> int:
    return angle.tau.numerator**2 + angle.tau.denominator**2


def _on(result: Boundary, own: int, t: Fraction, angle: Orientation) -> Point:
    """The point t of a contact's line."""
    (x, y), (u, v) = _placed(result.features, own, angle)
    n, d = t.numerator, t.denominator
    size = result.features.scale * _w(angle) * d
    return Fraction(d * x + n * u, size), Fraction(d * y + n * v, size)


def isolated_at(result: Boundary, half_tangent: Fraction | None) -> tuple[Segments, set[Point]]:
    """Isolated segments, in both directions, and isolated points at an angle; a curve is a point there."""
    parts, segments, points = result.isolated, [], set[Point]()
    for angle in {Orientation.of(half_tangent, side) for side in (BEFORE, AFTER)}:
        for k in rows_near(parts, angle):
            orders = [angle_order(result, parts, k, end, angle.tau) for end in ("from", "to")]
            if orders[0] < 0 or orders[1] > 0:
                continue
            p, q = (
                _point(result, int(patch[k]), int(curve[k]), angle)
                for patch, curve in ((parts.lower_patch, parts.lower), (parts.upper_patch, parts.upper))
            )
            if p == q:
                points.add(p)
            else:
                segments += [oriented(p, q), oriented(q, p)]
    return united(segments), points


def _point(result: Boundary, patch: int, curve: int, angle: Orientation) -> Point:
    own = own_code(result, patch)
    return _on(result, own, limit(result, own, curve, angle), angle)


def trapezoids_at(result: Boundary, angle: Orientation, side: int) -> list[int]:
    """Trapezoids that exist just before or just after an angle."""
    chosen = []
    for k in rows_near(result.trapezoids, angle):
        start, stop = (angle_order(result, result.trapezoids, k, end, angle.tau) for end in ("from", "to"))
        if start >= (side == BEFORE) and stop <= -(side == AFTER):
            chosen.append(k)
    return chosen


def rows_near(columns: Trapezoids, angle: Orientation) -> list[int]:
    near = (columns.from_lo <= float(angle.tau) + 1e-9) & (columns.to_hi >= float(angle.tau) - 1e-9)
    rows: list[int] = np.flatnonzero(near & (columns.chart == angle.chart)).tolist()
    return rows


def angle_order(result: Boundary, columns: Trapezoids, k: int, end: str, tau: Fraction) -> int:
    """Order of tau and a critical angle of a row: -1 before, 0 at, 1 after it."""
    lo, hi = (Fraction(float(getattr(columns, f"{end}_{name}")[k])) for name in ("lo", "hi"))
    if not lo <= tau <= hi:
        return 1 if tau > hi else -1
    if lo == hi:
        return 0
    if getattr(columns, f"{end}_place")[k]:
        raise Undecided(f"tau {tau} in [{lo}, {hi}], which holds several roots")
    values = [condition(result, columns, k, end, value) for value in (lo, tau, hi)]
    if values[1] == 0:
        return 0
    if values[0] * values[2] >= 0:
        raise Undecided(f"tau {tau} in [{lo}, {hi}]")
    return -1 if values[0] * values[1] > 0 else 1


def rational_angles(result: Boundary, digits: int = 3) -> list[Fraction | None]:
    """Half-angle tangents of few digits that are, or are very near to, critical angles."""
    columns, angles = result.trapezoids, set[Fraction | None]()
    for end in ("from", "to"):
        rows = zip(columns.chart, getattr(columns, f"{end}_lo"), getattr(columns, f"{end}_hi"), strict=True)
        for chart, lo, hi in {(int(chart), float(lo), float(hi)) for chart, lo, hi in rows}:
            tau = Fraction(lo).limit_denominator(10**digits)
            if lo <= tau <= hi:
                angles.add((-1 / tau if tau else None) if chart else tau)
    return sorted(angles, key=lambda tau: (tau is None, tau or 0))


def condition(result: Boundary, columns: Trapezoids, k: int, end: str, tau: Fraction) -> int:
    """Condition, zero where a row begins or ends: parallel edges, a helix on its surface, three concurrent lines."""
    codes = [int(getattr(columns, f"{end}_{name}")[k]) for name in ("first", "second")]
    patch = getattr(columns, f"{end}_patch", columns.patch)  # an isolated part's angles may be named on others
    angle = Orientation(int(columns.chart[k]), tau)
    own, first, *second = (
        _placed(result.features, code, angle) for code in (own_code(result, int(patch[k])), *codes) if code
    )
    if codes[0] >> 61 == Kind.EDGE_EDGE:
        return cross(*first)
    (p, u), (q, v) = own, first
    if not second:
        return cross(u, minus(q, p))
    ((r, w),) = second
    if codes[0] >> 61 == Kind.VERTEX_VERTEX:
        return cross(w, minus(r, q))
    if codes[1] >> 61 == Kind.VERTEX_VERTEX:
        return cross(v, minus(q, r))
    return cross(minus(q, p), v) * cross(u, w) - cross(minus(r, p), w) * cross(u, v)


def own_code(result: Boundary, patch: int) -> int:
    kind, i, j = (int(column[patch]) for column in (result.contact_kind, result.contact_robot, result.contact_obstacle))
    return kind << 61 | i << 31 | j
