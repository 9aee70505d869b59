"""Trapezoids of a boundary, exactly: poses on them at rational t and tau."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING

from cfree.exact import simplest_between
from cfree.features import SceneFeatures, ShapeFeatures, unpacked
from cfree.half_angle import half_angle_rotation, tau_in_chart
from cfree.pose import Pose

if TYPE_CHECKING:
    from cfree.forbidden import Boundary

FINEST = 32  # bits of tau that doubles are trusted with
AngleOf = Callable[[int, bool, int], tuple[Fraction, Fraction]]
Vector = tuple[Fraction, Fraction]
Line = tuple[Vector, Vector, Vector, Vector]  # p, q, a, g of a surface


def between(low: Fraction, high: Fraction) -> Fraction:
    """A simple fraction in the middle half of an interval."""
    quarter = (high - low) / 4
    return simplest_between(low + quarter, high - quarter)


def cross(u: Vector, v: Vector) -> Fraction:
    return u[0] * v[1] - u[1] * v[0]


def dot(u: Vector, v: Vector) -> Fraction:
    return u[0] * v[0] + u[1] * v[1]


def minus(u: Vector, v: Vector) -> Vector:
    return u[0] - v[0], u[1] - v[1]


def vertex(shape: ShapeFeatures, index: int, scale: int) -> Vector:
    """Coordinates of a vertex."""
    x, y = shape.vertices[int(index)]
    return Fraction(x, scale), Fraction(y, scale)


def contact_line(features: SceneFeatures, kind: int, i: int, j: int) -> Line:
    """p, q, a, g of a contact surface, by the features that touch."""
    A, O, scale = features.robot, features.obstacles, features.scale
    zero = Fraction(0), Fraction(0)
    if kind == 1:
        p = vertex(O, O.v[j], scale)
        return p, minus(vertex(O, O.w[j], scale), p), vertex(A, i, scale), zero
    a = vertex(A, A.v[i], scale)
    return vertex(O, j, scale), zero, a, minus(vertex(A, A.w[i], scale), a)


def positions(line: Line, tau: Fraction | None) -> tuple[Vector, Vector]:
    """P and U: positions P + t U of contact at an orientation."""
    p, q, a, g = line
    c, s, w = half_angle_rotation(tau)

    def turned(v: Vector) -> Vector:
        return (c * v[0] - s * v[1]) / w, (s * v[0] + c * v[1]) / w

    return minus(p, turned(a)), minus(q, turned(g))


class Sheet:
    """A trapezoid.

    Attributes
    ----------
    low, high : Fraction
        All orientations from the first to the second, in its chart, are strictly within; `refine` makes them more.

    Parameters
    ----------
    angle : callable, optional
        `FreeSpace.angle`, to know them better.
    isolated : bool
        An isolated part of the boundary and not a trapezoid, of a number in their table.
    """

    def __init__(self, boundary: Boundary, face: int, angle: AngleOf | None = None, isolated: bool = False) -> None:
        table = boundary.isolated if isolated else boundary.trapezoids
        self.face = face
        self._angle = angle
        self.chart = int(table.chart[face])
        self.low, self.high = Fraction(float(table.from_hi[face])), Fraction(float(table.to_lo[face]))
        self.codes = int(table.lower[face]), int(table.upper[face])
        self._features = boundary.features
        patch = int(table.patch[face])
        contact = (int(c[patch]) for c in (boundary.contact_kind, boundary.contact_robot, boundary.contact_obstacle))
        self.line = contact_line(boundary.features, *contact)
        bits = FINEST
        while angle and self.low >= self.high:
            bits *= 2
            self.refine(bits)

    def refine(self, bits: int) -> None:
        """Come as near as 2**-bits to its first and last orientation."""
        if self._angle:
            (_, self.low), (self.high, _) = (self._angle(self.face, last, bits) for last in (False, True))

    def at(self, tau: Fraction) -> tuple[Vector, Vector]:
        """P and U: positions P + t U, at tau in the chart."""
        return positions(self.line, tau_in_chart(self.chart, tau))

    def limits(self, tau: Fraction) -> tuple[Fraction, Fraction]:
        """Of t, at an orientation strictly between the trapezoid's."""
        P, U = self.at(tau)
        lower, upper = (self._limit(code, tau, P, U) for code in self.codes)
        return lower, upper

    def _limit(self, code: int, tau: Fraction, P: Vector, U: Vector) -> Fraction:
        kind, i, j = unpacked(code)
        if kind == 3:
            p, q, a, g = self.line
            A, O, scale = self._features.robot, self._features.obstacles, self._features.scale
            along, w = (q, minus(vertex(O, j, scale), p)) if any(q) else (g, minus(vertex(A, i, scale), a))
            return dot(w, along) / dot(along, along)
        Q, V = positions(contact_line(self._features, kind, i, j), tau_in_chart(self.chart, tau))
        return cross(minus(Q, P), V) / cross(U, V)

    def pose(self, t: Fraction, tau: Fraction) -> Pose:
        """On it."""
        P, U = self.at(tau)
        return Pose(P[0] + t * U[0], P[1] + t * U[1], {"tau": tau_in_chart(self.chart, tau)})

    def middle(self, tau: Fraction) -> Fraction:
        """A simple t well within."""
        return between(*self.limits(tau))

    def away(self, tau: Fraction) -> Vector:
        """The direction off the contact: to the right of U."""
        _, (x, y) = self.at(tau)
        return y, -x

    def t_of(self, pose: Pose, tau: Fraction) -> Fraction:
        """t of a pose on its line, at this orientation."""
        P, U = self.at(tau)
        return dot(minus((pose.x, pose.y), P), U) / dot(U, U)

    def holds(self, pose: Pose) -> bool:
        """Is a pose on it, and not at its first or last orientation?"""
        chart, tau = pose.chart
        if chart != self.chart or not self.low < tau < self.high:
            return False
        P, U = self.at(tau)
        low, high = self.limits(tau)
        return cross(U, minus((pose.x, pose.y), P)) == 0 and low <= self.t_of(pose, tau) <= high

    def contact_point(self, t: Fraction) -> Vector:
        """In the robot's own coordinates."""
        _, _, a, g = self.line
        return a[0] + t * g[0], a[1] + t * g[1]


def rotated(pose: Pose, point: Vector, tau: Fraction | None) -> Pose:
    """The pose turned to an orientation about a point of the robot."""
    ((X, Y),) = pose.apply_exact([point])
    ((x, y),) = Pose(0, 0, {"tau": tau}).apply_exact([point])
    return Pose(X - x, Y - y, {"tau": tau})


def common_part(f: Sheet, sigma: Fraction, g: Sheet, tau: Fraction) -> tuple[Fraction, Fraction] | None:
    """t on two sheets at orientations of theirs where one is beside the other: in the middle of what they share."""
    low, high = f.limits(sigma)
    beside = sorted(f.t_of(g.pose(t, tau), sigma) for t in g.limits(tau))
    low, high = max(low, beside[0]), min(high, beside[1])
    if low >= high:
        return None
    t = between(low, high)
    s = g.t_of(f.pose(t, sigma), tau)
    least, most = g.limits(tau)
    return (t, s) if least < s < most else None
