"""Places where contacts of vertices, arcs and segments hold a robot: on a line, about a point, or on a circle.

Two contacts that oppose each other, with no room between them or a little, hold the robot on a line; an arc in an arc
of its own radius turns about its center; an arc that fills the channel between two arcs about one center goes around.
Numbers that are not rational are replaced by rational ones close to them, so all that comes from here is a proposal, to
be proved free.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import chain, combinations, islice, product

from cfree.collision.arcs import Curve, curves_of
from cfree.exact.half_angle import half_angle_rotation, sum_of_angles
from cfree.exact.number import ExactPoint, rational_root, simplest_between
from cfree.exact.pose import Pose, pose_at
from cfree.libraries import Floats, NDArray, np
from cfree.scene.scene import AnyShape, Scene

MOST_CONTACTS = 40  # contacts near one place that are paired
MOST_ANGLES = 8  # orientations near one place
ASKEW = 0.05  # radians by which a robot may be askew that is turned to be parallel
ROUNDING = 2.0**-40  # relative, of distances in doubles
DIGITS = 1 << 80  # of square roots that are not rational


@dataclass(frozen=True)
class Round:
    """A vertex or arc: its radius grown by the shape's, negative for a shape outside of it."""

    center: ExactPoint
    radius: Fraction


@dataclass(frozen=True)
class Side:
    """A segment from a point along a vector; the shape is grown by a radius."""

    point: ExactPoint
    vector: ExactPoint
    length: Fraction
    radius: Fraction


Feature = Round | Side


@dataclass(frozen=True)
class Center:
    """A point of the robot, held at a point of the plane."""

    own: ExactPoint
    place: ExactPoint

    def pose(self, tau: Fraction | None) -> Pose:
        """Return the pose at an orientation."""
        (x, y), (a, b) = self.place, _rotated(self.own, tau)
        return pose_at(x - a, y - b, tau)


@dataclass(frozen=True)
class Ring:
    """A circle on which contacts hold a point of the robot; directions from the center where they may end.

    Directions are tangents of half their angles.
    """

    own: ExactPoint
    center: ExactPoint
    radius: Fraction
    ends: tuple[Fraction | None, ...]

    def seen(self, x: float, y: float, theta: float) -> complex:
        """Return the way from the center to the robot's point at a pose."""
        at = complex(x, y) + cmath.rect(1, theta) * complex(*map(float, self.own))
        return at - complex(*map(float, self.center))

    def directions(self, pose: Pose) -> list[Fraction | None]:
        """Return the direction of the robot's point at a pose, or nothing if it is not on the circle."""
        a, b = _rotated(self.own, pose.tau)
        x, y = pose.x + a - self.center[0], pose.y + b - self.center[1]
        if x * x + y * y != self.radius**2:
            return []
        return [y / (x + self.radius) if x + self.radius else None]

    def turning(self, direction: Fraction | None, tau: Fraction | None) -> Center:
        """Return what turns with the robot about the center, its point in a direction at an orientation."""
        u, v = _rotated((self.radius, Fraction(0)), sum_of_angles(direction, tau and -tau))
        return Center((self.own[0] - u, self.own[1] - v), self.center)


@dataclass(frozen=True)
class Line:
    """A line on which contacts hold the reference point, at one orientation; its direction.

    If one arc or vertex of the robot has both contacts, they hold its center at all orientations.
    """

    pose: Pose
    along: ExactPoint
    center: Center | None


@dataclass(frozen=True)
class _Held:
    """A contact: the reference point p is at n . p = h, n a unit vector; or at a distance from a center.

    Contacts with bounds have no feature of the robot, `own`.
    """

    n: ExactPoint | None = None
    h: Fraction = Fraction(0)
    center: ExactPoint = (Fraction(0), Fraction(0))
    radius: Fraction = Fraction(0)
    own: Feature | None = field(default=None, compare=False)


@dataclass(frozen=True)
class _Rows:
    """Features in doubles, which only tell which contacts are worth exact numbers.

    The centers or points, the unit vectors of sides, or 0, and their lengths; and the radii.
    """

    point: Floats
    along: Floats
    length: Floats
    radius: Floats

    @staticmethod
    def of(features: Sequence[Feature]) -> _Rows:
        sides = [feature if isinstance(feature, Side) else None for feature in features]
        point = [feature.point if isinstance(feature, Side) else feature.center for feature in features]
        along = [tuple(part / side.length for part in side.vector) if side else (0, 0) for side in sides]
        length = [side.length if side else 0 for side in sides]
        return _Rows(*(np.array(row, float) for row in (point, along, length, [f.radius for f in features])))

    def turned(self, tau: Fraction | None) -> _Rows:
        q, s, w = half_angle_rotation(tau)
        turn = np.array([[q / w, s / w], [-s / w, q / w]], float)
        return _Rows(self.point @ turn, self.along @ turn, self.length, self.radius)


def _may_touch(robot: _Rows, others: _Rows, place: tuple[float, float], near: float) -> NDArray[np.bool_]:
    """Return which features (n) of the robot, turned already, may be near which others (m) at a place: (n, m)."""
    offset = np.array(place) + robot.point[:, None] - others.point[None]
    size = max(map(abs, place)) + float(max(abs(robot.point).max(), abs(others.point).max()))
    near += ROUNDING * (size + float(max(abs(robot.radius).max(), abs(others.radius).max())))
    along = robot.along[:, None] + others.along[None]  # of pairs with one side
    is_side, is_other = robot.length > 0, others.length > 0
    height = abs(along[..., 0] * offset[..., 1] - along[..., 1] * offset[..., 0])
    foot = (along * offset).sum(axis=2) * np.where(is_side, -1, 1)[:, None]
    is_beside = (-near <= foot) & (foot <= robot.length[:, None] + others.length[None] + near)
    has_side = is_side[:, None] != is_other[None]
    distance = np.where(has_side, height, np.hypot(offset[..., 0], offset[..., 1]))
    off = abs(distance - abs(robot.radius[:, None] + others.radius[None]))
    return (off <= near) & np.where(has_side, is_beside, ~(is_side[:, None] & is_other[None]))


class Fits:
    """The vertices, arcs and segments of a scene, and its bounds.

    Parameters
    ----------
    scene : Scene
        All of its shapes are of segments and circular arcs.
    """

    def __init__(self, scene: Scene) -> None:
        others: list[AnyShape] = [*scene.obstacles, *([scene.workspace] if scene.workspace else [])]
        self._robot = [*dict.fromkeys(chain.from_iterable(map(_features, scene.robot)))]
        self._others = [*dict.fromkeys(chain.from_iterable(map(_features, others)))]
        self._reach = max(map(_extent, self._robot))
        self._rows = _Rows.of(self._robot)
        x0, y0, x1, y1 = map(Fraction, scene.bounds or (0, 0, 0, 0))
        zero, one = Fraction(0), Fraction(1)
        sides = ((one, zero, x0), (-one, zero, -x1), (zero, one, y0), (zero, -one, -y1))
        self._bounds = [_Held((u, v), h) for u, v, h in sides] if scene.bounds else []

    def angles(self, x: float, y: float, theta: float, near: float, most: float = ASKEW) -> list[Fraction | None]:
        """Return half-angle tangents near an orientation: those parallel to something near, and the simplest."""
        others = self._close(x, y, near)
        ways = [*_parallel(_directions(self._robot), [*_directions(others), *_across(others)], theta, most)]
        nearest = islice(dict.fromkeys(tau for _, tau in sorted(ways, key=lambda way: way[0])), MOST_ANGLES)
        return [*dict.fromkeys([*nearest, *_simple(theta)])]

    def lines(self, place: ExactPoint, tau: Fraction | None, near: float) -> Iterator[Line]:
        """Yield lines on which two contacts near a pose hold the robot, or all but hold it."""
        for one, other in combinations(islice(self._contacts(place, tau, near), MOST_CONTACTS), 2):
            if fit := _between(one, other, place):
                (x, y), along = fit
                own, center = one.own, None
                if own is None or other.own is None:  # bounds hold the reference point
                    own = own or other.own
                    is_held = isinstance(own, Round) and not any(own.center)
                else:
                    is_held = own == other.own
                if is_held and isinstance(own, Round):
                    a, b = _rotated(own.center, tau)
                    center = Center(own.center, (x + a, y + b))
                yield Line(pose_at(x, y, tau), along, center)

    def tangents(self, pose: Pose, near: float) -> Iterator[ExactPoint]:
        """Yield the directions of contacts at a pose."""
        for held in islice(self._contacts((pose.x, pose.y), pose.tau, near), MOST_CONTACTS):
            x, y = held.n or (pose.x - held.center[0], pose.y - held.center[1])
            if x or y:
                yield -y, x

    def centers(self, place: ExactPoint, tau: Fraction | None, near: float) -> Iterator[Center]:
        """Yield the centers of arcs of the robot that are near the center of an arc of the same radius."""
        rounds = [other for other in self._close(float(place[0]), float(place[1]), near) if isinstance(other, Round)]
        for own in self._robot:
            if isinstance(own, Round) and own.radius:
                a, b = _rotated(own.center, tau)
                for other in rounds:
                    (u, v) = other.center
                    if own.radius == -other.radius and math.hypot(place[0] + a - u, place[1] + b - v) <= near:
                        yield Center(own.center, other.center)

    def rings(self, place: ExactPoint, tau: Fraction | None, near: float) -> Iterator[Ring]:
        """Yield circles on which two arcs about one center, near a pose, hold an arc of the robot between them."""
        for one, other in combinations(islice(self._contacts(place, tau, near), MOST_CONTACTS), 2):
            inner, outer = (one, other) if one.radius > 0 else (other, one)
            are_circles = one.n is None and other.n is None and isinstance(one.own, Round) and one.own == other.own
            if are_circles and one.center == other.center and 0 < inner.radius <= -outer.radius:
                assert isinstance(one.own, Round)
                own, (a, b) = one.own, _rotated(one.own.center, tau)
                center = one.center[0] + a, one.center[1] + b
                ends = self._ends(center, {inner.radius - own.radius, own.radius - outer.radius})
                yield Ring(own.center, center, (inner.radius - outer.radius) / 2, tuple(ends))

    def _ends(self, center: ExactPoint, radii: set[Fraction]) -> Iterator[Fraction | None]:
        """Yield directions from a center to the vertices at some distances."""
        for other in self._others:
            if isinstance(other, Round):
                x, y = other.center[0] - center[0], other.center[1] - center[1]
                radius = rational_root(x * x + y * y)
                if radius in radii:
                    yield y / (x + radius) if x + radius else None

    def _close(self, x: float, y: float, near: float) -> list[Feature]:
        return [other for other in self._others if _distance(other, x, y) <= self._reach + near]

    def _contacts(self, place: ExactPoint, tau: Fraction | None, near: float) -> Iterator[_Held]:
        """Yield the contacts near a pose, the nearest first."""
        held = dict[_Held, float]()
        x, y = map(float, place)
        others = self._close(x, y, near)
        rows = _Rows.of(others) if others else None
        may_touch = _may_touch(self._rows.turned(tau), rows, (x, y), near) if rows else np.zeros((1, 0), bool)
        for k in np.flatnonzero(may_touch.any(axis=1)).tolist():
            own = self._robot[k]
            turned = _turned(own, tau)
            for j in np.flatnonzero(may_touch[k]).tolist():
                if contact := _contact(turned, others[j], place, near):
                    held.setdefault(replace(contact[0], own=own), contact[1])
        for bound in self._bounds:
            assert bound.n is not None
            if (off := abs(float(bound.n[0] * place[0] + bound.n[1] * place[1] - bound.h))) <= near:
                held.setdefault(bound, off)
        yield from sorted(held, key=held.__getitem__)


def _features(shape: AnyShape) -> Iterator[Feature]:
    curves = curves_of(shape)
    assert curves is not None
    grown, rings = curves
    for curve in chain.from_iterable(rings):
        yield from _feature(curve, grown)


def _feature(curve: Curve, grown: Fraction) -> Iterator[Feature]:
    (px, py), (qx, qy), (cx, cy), turn = curve
    yield Round((px, py), grown)
    if not turn:
        yield Side((px, py), (qx - px, qy - py), _root((qx - px) ** 2 + (qy - py) ** 2), grown)
        return
    radius = _root((px - cx) ** 2 + (py - cy) ** 2)
    yield Round((cx, cy), radius + grown)
    if radius > grown:
        yield Round((cx, cy), grown - radius)


def _root(square: Fraction) -> Fraction:
    """Square root; if it is not rational, a rational number close to it."""
    if (root := rational_root(square)) is not None:
        return root
    return Fraction(math.isqrt(square.numerator * square.denominator * DIGITS**2), square.denominator * DIGITS)


def _rotated(p: ExactPoint, tau: Fraction | None) -> ExactPoint:
    q, s, w = half_angle_rotation(tau)
    return (q * p[0] - s * p[1]) / Fraction(w), (s * p[0] + q * p[1]) / Fraction(w)


def _turned(feature: Feature, tau: Fraction | None) -> Feature:
    if isinstance(feature, Round):
        return Round(_rotated(feature.center, tau), feature.radius)
    return Side(_rotated(feature.point, tau), _rotated(feature.vector, tau), feature.length, feature.radius)


def _extent(own: Feature) -> float:
    """Largest distance of a feature's points from the origin."""
    if isinstance(own, Round):
        return math.hypot(*own.center) + abs(float(own.radius))
    (x, y), (u, v) = own.point, own.vector
    return max(math.hypot(x, y), math.hypot(x + u, y + v)) + float(own.radius)


def _distance(other: Feature, x: float, y: float) -> float:
    """Distance of a point from a feature."""
    if isinstance(other, Round):
        return abs(math.hypot(float(other.center[0]) - x, float(other.center[1]) - y) - abs(float(other.radius)))
    px, py, u, v = float(other.point[0]) - x, float(other.point[1]) - y, float(other.vector[0]), float(other.vector[1])
    t = min(1.0, max(0.0, -(px * u + py * v) / (u * u + v * v)))
    return math.hypot(px + t * u, py + t * v) - float(other.radius)


def _contact(own: Feature, other: Feature, place: ExactPoint, near: float) -> tuple[_Held, float] | None:
    """Return the contact of a turned feature of the robot, if it is near at a place, and how far it is from it."""
    if isinstance(own, Round) and isinstance(other, Round):
        (a, b), (u, v), total = own.center, other.center, own.radius + other.radius
        center, is_inside = (u - a, v - b), min(own.radius, other.radius) < 0
        off = abs(math.hypot(place[0] - center[0], place[1] - center[1]) - abs(float(total)))
        if off > near or is_inside == (total > 0) or (total == 0 and not own.radius):
            return None
        return _Held(center=center, radius=-abs(total) if is_inside else total), off
    if isinstance(own, Side) and isinstance(other, Side):
        return None
    side, circle = (own, other) if isinstance(own, Side) else (other, own)
    assert isinstance(side, Side) and isinstance(circle, Round)
    if circle.radius < 0:
        return None
    (u, v), (a, b), (x, y) = side.point, circle.center, place
    sign = 1 if side is other else -1
    middle = sign * (u - a), sign * (v - b)  # where the circle's center would be on the side's start
    offset = x - middle[0], y - middle[1]
    foot = float((side.vector[0] * offset[0] + side.vector[1] * offset[1]) / side.length) * sign
    n = -side.vector[1] / side.length, side.vector[0] / side.length
    height, total = n[0] * offset[0] + n[1] * offset[1], side.radius + circle.radius
    if height < 0:
        n = -n[0], -n[1]
    off = float(abs(abs(height) - total))
    held = _Held(n, n[0] * middle[0] + n[1] * middle[1] + total)
    return (held, off) if off <= near and -near <= foot <= side.length + near else None


def _between(one: _Held, other: _Held, place: ExactPoint) -> tuple[ExactPoint, ExactPoint] | None:
    """Return a place on the line in the middle between two contacts that oppose each other, and its direction."""
    if one.n is not None and other.n is not None:
        (a, b), (u, v) = one.n, other.n
        if a * v != b * u or a * u + b * v > 0 or one.h + other.h > 0:
            return None
        return _moved(place, one.n, (one.h - other.h) / 2), (-one.n[1], one.n[0])
    if one.n is None and other.n is None:
        (a, b), (u, v) = one.center, other.center
        apart, total = (u - a, v - b), one.radius + other.radius
        if min(one.radius, other.radius) <= 0 or apart[0] ** 2 + apart[1] ** 2 < total**2:
            return None
        share = one.radius / total
        return (a + share * apart[0], b + share * apart[1]), (-apart[1], apart[0])
    line, circle = (one, other) if one.n is not None else (other, one)
    assert line.n is not None
    height = line.n[0] * circle.center[0] + line.n[1] * circle.center[1] - line.h
    if circle.radius <= 0 or height < circle.radius:
        return None
    return _moved(circle.center, line.n, line.h + (height - circle.radius) / 2), (-line.n[1], line.n[0])


def _moved(point: ExactPoint, n: ExactPoint, h: Fraction) -> ExactPoint:
    """Move a point along a unit vector to the line n . p = h."""
    (x, y), (u, v) = point, n
    by = h - u * x - v * y
    return x + by * u, y + by * v


def _directions(features: Sequence[Feature]) -> Iterator[ExactPoint]:
    """Yield the vectors of segments, and between the centers of equal arcs."""
    yield from (feature.vector for feature in features if isinstance(feature, Side))
    rounds = [feature for feature in features if isinstance(feature, Round) and feature.radius]
    for one, other in islice(combinations(rounds, 2), MOST_CONTACTS**2):
        if one.center != other.center and one.radius == other.radius:
            yield other.center[0] - one.center[0], other.center[1] - one.center[1]


def _across(others: Sequence[Feature]) -> Iterator[ExactPoint]:
    """Yield the directions in which a robot moves between two vertices or arcs."""
    rounds = dict.fromkeys(other.center for other in others if isinstance(other, Round) and other.radius >= 0)
    for (a, b), (u, v) in islice(combinations(rounds, 2), MOST_CONTACTS**2):
        yield b - v, u - a


def _simple(theta: float) -> Iterator[Fraction | None]:
    turn = math.remainder(theta, math.tau)
    if math.pi - abs(turn) < ASKEW:
        yield None
    if abs(turn) < 3:
        tau = math.tan(turn / 2)
        for width in (ASKEW / 2, 1e-3, 1e-6):
            yield simplest_between(Fraction(tau - width), Fraction(tau + width))


def _parallel(
    own: Iterator[ExactPoint], others: Sequence[ExactPoint], theta: float, most: float
) -> Iterator[tuple[float, Fraction | None]]:
    """Yield half-angle tangents that make vectors of the robot parallel to others, and their distance from an angle."""
    directions = dict.fromkeys(others)
    for (a, b), (u, v) in product(dict.fromkeys(own), directions):
        # the quotient of the vectors as complex numbers is that of their lengths times exp(i theta)
        re, im = u * a + v * b, v * a - u * b
        off = math.remainder(math.atan2(im, re) - theta, math.pi)
        if abs(off) > most:
            continue
        square = re * re + im * im
        length = _root(square)
        if length * length == square:
            if abs(math.remainder(math.atan2(im, re) - theta, math.tau)) > math.pi / 2:
                re, im = -re, -im
            yield abs(off), None if re == -length else im / (length + re)
