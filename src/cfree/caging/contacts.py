"""Contacts of a body with fingers at a pose, exactly: gaps as functions of the motion, to second order.

Each contact is of a line or a circle of the body with a line or a circle of a finger; corners are circles of radius 0.
The gap is the distance of their osculating lines and circles, times a positive number that makes all terms rational:
theory and signs are in docs/theory/immobility.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from cfree.analysis.inset_shapes import double_area
from cfree.caging.fingers import Finger
from cfree.collision.arcs import Curve, curves_of
from cfree.errors import UnsupportedError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.exact.vectors import cross, dot, minus
from cfree.scene.scene import AnyShape

Velocity = tuple[Fraction, Fraction, Fraction]
"""Velocities of the reference point, and of turning."""
ZERO = Fraction(0)


@dataclass(frozen=True)
class Gap:
    """Derivatives of a gap: it is free motion if the gap does not become negative.

    Attributes
    ----------
    gradient : (3,) Fraction
        Derivative by the velocity (x, y, turning).
    square, mixed, turning : Fraction, ExactPoint, Fraction
        The second derivative in directions across the gradient, without acceleration: square (x^2 + y^2) +
        2 turning' (mixed . (x, y)) + turning turning'^2.
    """

    gradient: Velocity
    square: Fraction = ZERO
    mixed: ExactPoint = (ZERO, ZERO)
    turning: Fraction = ZERO


def slope(gap: Gap, v: Velocity) -> Fraction:
    """Return the first derivative of a gap along a velocity."""
    return sum((a * b for a, b in zip(gap.gradient, v, strict=True)), ZERO)


def bend(gap: Gap, v: Velocity) -> Fraction:
    """Return the second derivative of a gap along a velocity across its gradient."""
    x, y, w = v
    return gap.square * (x * x + y * y) + 2 * w * (gap.mixed[0] * x + gap.mixed[1] * y) + gap.turning * w * w


@dataclass(frozen=True)
class Contact:
    """A contact of the body with a finger.

    Attributes
    ----------
    finger : int
    point : (x, y)
        Rounded.
    normal : (x, y)
        Exact, of any length: from the finger to the body.
    any_of : tuple of tuples of Gap
        The body is forbidden near this contact unless all gaps of one tuple stay open.
    enough : tuple of tuples of Gap
        The body is free near this contact if all gaps of one of these stay open; mostly the same.
    """

    finger: int
    point: tuple[float, float]
    normal: ExactPoint
    any_of: tuple[tuple[Gap, ...], ...]
    enough: tuple[tuple[Gap, ...], ...]


@dataclass(frozen=True)
class _Line:
    """An edge, the interior on its left; `grown` is the distance of the rim from it."""

    p: ExactPoint
    q: ExactPoint
    grown: Fraction
    closed: tuple[bool, bool]  # True at an end that is no corner

    @property
    def direction(self) -> ExactPoint:
        return minus(self.q, self.p)

    @property
    def outward(self) -> ExactPoint:
        x, y = self.direction
        return y, -x


@dataclass(frozen=True)
class _Circle:
    """A corner or an arc: the square of its radius, and 1 if it is convex, -1 if concave."""

    center: ExactPoint
    square: Fraction
    sign: int = 1
    ends: tuple[ExactPoint, ExactPoint] | None = None  # of an arc, counter-clockwise about the center
    closed: tuple[bool, bool] = (True, True)


@dataclass(frozen=True)
class _Corner:
    """A corner of the rim: tangents away from it, the pieces' features, and whether it is convex."""

    place: ExactPoint
    directions: tuple[ExactPoint, ...]
    pieces: tuple[_Line | _Circle, ...]
    is_convex: bool


@dataclass
class _Features:
    lines: list[_Line]
    circles: list[_Circle]
    corners: list[_Corner]


def contacts_at(body: Sequence[AnyShape], fingers: Sequence[Finger], pose: Pose) -> list[Contact]:
    """Return all contacts at a free pose.

    Raises
    ------
    UnsupportedError
        If a shape has other curves than segments and circular arcs.
    """
    mine, r, result = [_features(part, pose) for part in body], (pose.x, pose.y), list[Contact]()
    for k, finger in enumerate(fingers):
        theirs = _point(finger) if isinstance(finger, tuple) else _features(finger, None)
        for own in mine:
            result += _contacts(own, theirs, r, k)
    return result


# --- features ---


def _point(p: ExactPoint) -> _Features:
    return _Features([], [_Circle(p, ZERO)], [_Corner(p, (), (), True)])


def _features(shape: AnyShape, pose: Pose | None) -> _Features:
    curves = curves_of(shape)
    if curves is None:
        raise UnsupportedError("immobility: of shapes with segments and circular arcs only; give scene.outer(error)")
    grown, rings = curves
    result = _Features([], [], [])
    for k, ring in enumerate(rings):
        placed = [(*(pose.apply_exact(points) if pose else points), turn) for *points, turn in ring]
        _add_ring(result, _counter_clockwise(placed, is_hole=k > 0), grown)
    return result


def _counter_clockwise(ring: list[Curve], *, is_hole: bool) -> list[Curve]:
    """Return a ring with the interior on its left."""
    if (double_area(ring) > 0) == is_hole:
        return [(end, start, center, -turn) for start, end, center, turn in reversed(ring)]
    return ring


def _tangent(curve: Curve, place: ExactPoint) -> ExactPoint:
    start, end, center, turn = curve
    x, y = minus(place, center)
    return (-turn * y, turn * x) if turn else minus(end, start)


def _add_ring(features: _Features, ring: list[Curve], grown: Fraction) -> None:
    ring = _joined(ring)
    smooth = list[bool]()
    turns = list[Fraction]()
    for one, other in zip([ring[-1], *ring[:-1]], ring, strict=True):
        before, after = _tangent(one, one[1]), _tangent(other, other[0])
        turns.append(cross(before, after))
        smooth.append(not turns[-1] and dot(before, after) > 0)
    pieces = list[_Line | _Circle]()
    for k, (start, end, center, turn) in enumerate(ring):
        ends = smooth[k], smooth[(k + 1) % len(ring)]
        if turn:
            w = minus(start, center)
            sides = (start, end) if turn > 0 else (end, start)
            whole = None if start == end else sides
            pieces.append(_Circle(center, dot(w, w), turn, whole, ends if turn > 0 else ends[::-1]))
        else:
            pieces.append(_Line(start, end, grown, ends))
    features.lines += [piece for piece in pieces if isinstance(piece, _Line)]
    features.circles += [piece for piece in pieces if isinstance(piece, _Circle)]
    for k, (one, other) in enumerate(zip([ring[-1], *ring[:-1]], ring, strict=True)):
        if smooth[k]:
            continue
        place = other[0]
        x, y = _tangent(one, place)
        is_convex = turns[k] > 0 or (not turns[k])  # a cusp counts as convex
        features.corners.append(
            _Corner(place, ((-x, -y), _tangent(other, place)), (pieces[k - 1], pieces[k]), is_convex)
        )
        if is_convex:
            features.circles.append(_Circle(place, grown * grown))


def _joined(ring: list[Curve]) -> list[Curve]:
    """Return a ring whose arcs about one center are one arc each; a whole circle has equal ends."""
    result = list[Curve]()
    for curve in ring:
        if result and curve[3] and result[-1][3] == curve[3] and result[-1][2] == curve[2]:
            result[-1] = (result[-1][0], curve[1], curve[2], curve[3])
        else:
            result.append(curve)
    first, last = result[0], result[-1]
    if len(result) > 1 and first[3] and first[3] == last[3] and first[2] == last[2]:
        result[0] = (last[0], first[1], first[2], first[3])
        result.pop()
    return result


# --- pairs ---


def _contacts(body: _Features, finger: _Features, r: ExactPoint, k: int) -> Iterator[Contact]:
    raw = list[tuple[ExactPoint, tuple[float, float], Gap]]()
    for circle in body.circles:
        for line in finger.lines:
            if _touch_line(line, circle):
                n, a = line.outward, minus(circle.center, r)
                gap = Gap((*n, cross(a, n)), turning=-dot(n, a))
                raw.append((n, _foot(line, circle), gap))
    for line in body.lines:
        for circle in finger.circles:
            if _touch_line(line, circle):
                (x, y), c = line.outward, minus(circle.center, r)
                n, turned = (-x, -y), (-y, x)
                gap = Gap((*n, dot(turned, c)), mixed=(y, -x), turning=-(x * c[0] + y * c[1]))
                raw.append((n, _foot(line, circle), gap))
    for one in body.circles:
        for other in finger.circles:
            sign = _touch_circle(one, other)
            if sign:
                w, a = minus(one.center, other.center), minus(one.center, r)
                n = sign * w[0], sign * w[1]
                gap = Gap(
                    (*n, cross(a, n)),
                    square=Fraction(sign),
                    mixed=(-sign * a[1], sign * a[0]),
                    turning=sign * (dot(a, a) - dot(w, a)),
                )
                raw.append((n, _on(one, (-n[0], -n[1])), gap))
    yield from _grouped(raw, k)
    for mine in body.corners:
        for theirs in finger.corners:
            if mine.place == theirs.place and _is_sharp(body, mine) and _is_sharp(finger, theirs):
                yield _corners(mine, theirs, r, k)


def _is_sharp(features: _Features, corner: _Corner) -> bool:
    return not any(isinstance(piece, _Line) and piece.grown for piece in corner.pieces)


def _grouped(raw: list[tuple[ExactPoint, tuple[float, float], Gap]], k: int) -> Iterator[Contact]:
    """Yield contacts. Those with one normal line are of neighbouring pieces: each of their gaps may be the true one."""
    groups = list[list[tuple[ExactPoint, tuple[float, float], Gap]]]()
    for item in raw:
        n, _, gap = item
        for group in groups:
            m, _, other = group[0]
            same_line = gap.gradient[2] * dot(m, m) == other.gradient[2] * dot(n, m)
            near = max(abs(a - b) for a, b in zip(item[1], group[0][1], strict=True)) < 1e-9 * (1 + abs(item[1][0]))
            if not cross(n, m) and dot(n, m) > 0 and same_line and near:
                group.append(item)
                break
        else:
            groups.append([item])
    for group in groups:
        gaps = tuple(dict.fromkeys((gap,) for _, _, gap in group))
        yield Contact(k, group[0][1], group[0][0], gaps, (sum(gaps, ()),))


def _touch_line(line: _Line, circle: _Circle) -> bool:
    """True if a circle touches a line from outside, at a place of both that is no corner of two."""
    d, to, n = line.direction, minus(circle.center, line.p), line.outward
    height, length = dot(n, to), dot(d, d)
    if height < 0 or circle.sign < 0:
        return False
    if not _is_sum(height * height / length, line.grown * line.grown, 1, circle.square, 1):
        return False
    share = dot(d, to) / length
    rounded = line.grown or circle.square
    first, last = (bool(rounded) or closed for closed in line.closed)
    if not ((share > 0 or (first and share == 0)) and (share < 1 or (last and share == 1))):
        return False
    return _has_direction(circle, (-n[0], -n[1]), is_round=True)


def _touch_circle(one: _Circle, other: _Circle) -> int:
    """Return the sign of the sum of the signed radii of two circles that touch; 0 if they do not, or it is 0."""
    w = minus(one.center, other.center)
    square = dot(w, w)
    if not square:
        return 0
    if one.sign < 0 and other.sign < 0:
        return 0
    sign = 1
    if one.sign != other.sign:
        convex, concave = (one, other) if one.sign > 0 else (other, one)
        if convex.square >= concave.square:
            return 0
        sign = -1
        if not _is_sum(square, concave.square, 1, convex.square, -1):
            return 0
    elif not _is_sum(square, one.square, 1, other.square, 1):
        return 0
    n = sign * w[0], sign * w[1]
    towards = (-n[0], -n[1]), n
    for circle, direction, partner in ((one, towards[0], other), (other, towards[1], one)):
        x, y = direction
        outward = (x, y) if circle.sign > 0 else (-x, -y)
        if not _has_direction(circle, outward, is_round=bool(partner.square)):
            return 0
    return sign


def _has_direction(circle: _Circle, direction: ExactPoint, *, is_round: bool) -> bool:
    """True if an arc has a point in a direction; at an end only if that is smooth, or the other shape is round."""
    if circle.ends is None:
        return True
    u, v = (minus(end, circle.center) for end in circle.ends)
    for end, closed in zip((u, v), circle.closed, strict=True):
        if not cross(end, direction) and dot(end, direction) > 0:
            return closed or is_round
    if cross(u, v) > 0 or (not cross(u, v) and dot(u, v) < 0):
        return cross(u, direction) > 0 and cross(direction, v) > 0 if cross(u, v) else cross(u, direction) > 0
    return not (cross(v, direction) > 0 and cross(direction, u) > 0)


def _is_sum(square: Fraction, one: Fraction, sign: int, other: Fraction, other_sign: int) -> bool:
    """True if the root of a square is the sum of two signed roots, the first of which is the larger if they differ."""
    rest = square - one - other
    if rest * rest != 4 * one * other:
        return False
    return not rest or (rest > 0) == (sign == other_sign)


def _corners(mine: _Corner, theirs: _Corner, r: ExactPoint, k: int) -> Contact:
    """Return the contact of two corners at one place: some edge at it separates the two."""
    place, sides = mine.place, list[tuple[Gap, ...]]()
    a = minus(place, r)
    straight, normal, flush = True, (ZERO, ZERO), list[Gap]()
    for corner, other, is_body in ((theirs, mine, False), (mine, theirs, True)):
        for piece in corner.pieces:
            n = _outward(piece, place)
            above = [dot(n, e) for e in other.directions]
            is_above = min(above, default=ZERO) >= 0
            if other.is_convex and (is_above or not corner.is_convex):
                # edges that lie on each other have a second contact where they end, so that one gap will do
                sides.append((_gap_at(piece, n, a, r, place, is_body=is_body),))
                flush += sides[-1] if not all(above) else ()
                straight = straight and isinstance(piece, _Line)
                m = (-n[0], -n[1]) if is_body else n
                size = max(map(abs, m))
                normal = normal[0] + m[0] / size, normal[1] + m[1] / size
    if not (mine.is_convex and theirs.is_convex):  # a corner in a notch: both sides of the notch hold it
        sides = [tuple(gap for side in sides for gap in side)]
        flush.clear()
    # edges on one line: after a turn and a shift, the other one of the two gaps may be the true one
    enough = [tuple(flush), *(side for side in sides if side[0] not in flush)] if flush else sides
    if not straight:
        enough = [tuple(gap for side in sides for gap in side)]
    return Contact(k, (float(place[0]), float(place[1])), normal, tuple(sides), tuple(enough))


def _outward(piece: _Line | _Circle, place: ExactPoint) -> ExactPoint:
    if isinstance(piece, _Line):
        return piece.outward
    x, y = minus(place, piece.center)
    return (x, y) if piece.sign > 0 else (-x, -y)


def _gap_at(
    piece: _Line | _Circle, n: ExactPoint, a: ExactPoint, r: ExactPoint, place: ExactPoint, *, is_body: bool
) -> Gap:
    """Return the gap of a corner and a piece with an outward normal there; the piece is the body's, or the finger's."""
    x, y = n
    if isinstance(piece, _Line):
        if not is_body:
            return Gap((x, y, cross(a, n)), turning=-dot(n, a))
        return Gap((-x, -y, dot((-y, x), a)), mixed=(y, -x), turning=-dot(n, a))
    center, sign = piece.center, piece.sign
    one, other = (center, place) if is_body else (place, center)
    w, b = minus(one, other), minus(one, r)
    m = sign * w[0], sign * w[1]
    return Gap(
        (*m, cross(b, m)),
        square=Fraction(sign),
        mixed=(-sign * b[1], sign * b[0]),
        turning=sign * (dot(b, b) - dot(w, b)),
    )


def _foot(line: _Line, circle: _Circle) -> tuple[float, float]:
    d, n = line.direction, line.outward
    share = float(dot(d, minus(circle.center, line.p)) / dot(d, d))
    size = float(dot(n, n)) ** 0.5
    x, y = (
        float(p) + share * float(v) + float(line.grown) * float(m) / size for p, v, m in zip(line.p, d, n, strict=True)
    )
    return x, y


def _on(circle: _Circle, direction: ExactPoint) -> tuple[float, float]:
    size = float(dot(direction, direction)) ** 0.5
    radius = circle.sign * float(circle.square) ** 0.5
    x, y = (float(c) + radius * float(v) / size for c, v in zip(circle.center, direction, strict=True))
    return x, y
