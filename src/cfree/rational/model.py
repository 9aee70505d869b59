"""Contacts in the rational model C^rat = {(x, y, tau)}, tau = tan(theta / 2), without rounding.

Paper, eq. (2) and section 5. The rotation by theta is the rational matrix

    M(tau) = 1 / (1 + tau^2) ((1 - tau^2, -2 tau), (2 tau, 1 - tau^2)),    M(inf) = R(pi),

so eqs. (4), (5), (8) and the curves of section 3.3 are rational functions of tau and t, and map fractions to
fractions. tau runs through all numbers and infinity, which is one point, the half turn: None among exact numbers, inf
in arrays. The sub-domain Phi ends at numbers with one square root (`cfree.exact.surd`).

    contact     surface or curve                     on fractions                 a contact for
    v-e, e-v    S(t, tau) = p + t q - M (a + t g)    x, y, tau fractions          t in [0, 1], tau in Phi
    v-v         C(tau) = b_j - M a_i                 x, y, tau fractions          tau in Phi
    e-e         C(t) = S(t, tau_min), S of v-e       x, y, tau with one root      t in `t_range`

A *surface* has all poses in which the contact is at least a pseudo contact: t in [0, 1], every tau. `point` and calls
evaluate it there and raise an error for any other t, which is no contact of any sort. `locate` tests for the patch.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cfree.arguments import checked
from cfree.contact.contact import (
    Contact,
    EdgeEdge,
    EdgeVertex,
    VertexEdge,
    VertexVertex,
    direction_against,
    end_directions,
)
from cfree.contact.surface import Helix, Surface, contact_helix, contact_surface
from cfree.exact.half_angle import half_angle_rotation, half_tangent, rational_rotation, tau_of, theta_of_tau
from cfree.exact.number import Number, to_fraction
from cfree.exact.orientation import Location, Order, compare_directions, locate_in_sector
from cfree.exact.surd import ExactAngle, Surd
from cfree.polygons.polygon import Polygon

Floats = NDArray[np.float64]
HalfTangent = Fraction | None
RationalPoint = tuple[Fraction, Fraction, HalfTangent]


@dataclass(frozen=True, slots=True)
class RationalRange:
    """Range Phi of eq. (6): the closed range of orientations of a contact type, counter-clockwise from start to end.

    Attributes
    ----------
    start, end : ExactAngle
        phi_min and phi_max; equal for an e-e contact only.

    Examples
    --------
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> Phi = rational_range(square, square, VertexEdge(0, 3))       # from 90 to 180 degrees
    >>> [tau and str(tau) for interval in Phi.domain for tau in interval]
    ['1', None]
    >>> Phi.locate(2), Phi.locate(None), Phi.locate(0)
    (<Location.INSIDE: 'inside'>, <Location.BOUNDARY: 'boundary'>, <Location.OUTSIDE: 'outside'>)
    """

    start: ExactAngle
    end: ExactAngle

    @property
    def domain(self) -> tuple[tuple[Surd | None, Surd | None], ...]:
        """Phi as one interval of tau, or two if it passes infinity: [tau_min, inf] and [inf, tau_max].

        None is infinity, and belongs to Phi: as a lower end it is -inf, as an upper end +inf; two of them are the half
        turn alone. Eq. (6) cuts the circle at theta = 0, the rational model cuts it at theta = pi.
        """
        tau_min, tau_max = self.start.tau, self.end.tau
        if tau_min is None or tau_max is None or self.locate(None) is Location.OUTSIDE:
            return ((tau_min, tau_max),)
        return (tau_min, None), (None, tau_max)

    @checked
    def locate(self, tau: Number | None) -> Location:
        """Location of an orientation: inside Phi, at an end, or outside; decided by signs of integers."""
        c, s, _ = half_angle_rotation(half_tangent(tau))
        return self._locate((c, s))

    @checked
    def inside(self, bits: int) -> tuple[HalfTangent, HalfTangent]:
        """Return the widest part of Phi with ends of a stated precision.

        Parameters
        ----------
        bits : int
            An end that is not rational is replaced by one whose tau is a multiple of 2^-bits; or whose 1 / tau is, if
            that is in [-1, 1]. At most 2^(1 - bits) radians are lost there.

        Raises
        ------
        ValueError
            If no part of positive width is left.

        Examples
        --------
        >>> triangle, square = Polygon([(0, 0), (2, 0), (1, 1)]), Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
        >>> Phi = rational_range(triangle, square, VertexEdge(1, 2))
        >>> [str(tau) for tau in Phi.domain[0]], Phi.inside(4)
        (['-1 - sqrt(2)', '0'], (Fraction(-16, 7), Fraction(0, 1)))
        """
        if self.start == self.end:
            raise ValueError("the range is a single orientation; there is no interval in it")
        first, last = self.start.neighbours(bits)[1], self.end.neighbours(bits)[0]
        c, s, _ = half_angle_rotation(first)
        rest = RationalRange(ExactAngle(c, s), self.end)
        if first == last or Location.OUTSIDE in (self.locate(first), rest.locate(last)):
            raise ValueError(f"no part of the range has ends that are multiples of 2^-{bits}; give more bits")
        return first, last

    @checked
    def outside(self, bits: int) -> tuple[HalfTangent, HalfTangent]:
        """Return the narrowest range with ends of a stated precision that contains Phi; see `inside`.

        Raises
        ------
        ValueError
            If its ends would pass each other.
        """
        last, first = RationalRange(self.end, self.start).inside(bits)
        return first, last

    def _locate(self, direction: tuple[int, int]) -> Location:
        start, end = (self.start.c, self.start.s), (self.end.c, self.end.s)
        if self.start == self.end:
            return Location.BOUNDARY if compare_directions(start, direction) is Order.SAME else Location.OUTSIDE
        return locate_in_sector(direction, start, end)


@dataclass(frozen=True, slots=True)
class RationalSurface:
    """Surface S(t, tau) of a v-e or e-v contact, eqs. (5) and (8), and the range Phi of its patch.

    Attributes
    ----------
    surface : Surface
    Phi : RationalRange or None
        None at a reflex vertex: all poses are pseudo contacts then, and there is no patch.

    Examples
    --------
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> S = rational_surface(square, square, EdgeVertex(0, 2))
    >>> S.point("1/4", "-1/2")
    (Fraction(17, 10), Fraction(12, 5), Fraction(-1, 2))
    >>> S(0.25, -0.5)
    array([ 1.7,  2.4, -0.5])
    >>> S.locate("1/4", "-1/2"), S.locate(0, "-1/2"), S.locate("1/4", 3)
    (<Location.INSIDE: 'inside'>, <Location.BOUNDARY: 'boundary'>, <Location.OUTSIDE: 'outside'>)
    """

    surface: Surface
    Phi: RationalRange | None

    def __call__(self, t: ArrayLike, tau: ArrayLike) -> Floats:
        """Points (x, y, tau) in doubles, t and tau broadcast against each other: (..., 3)."""
        t, tau = np.broadcast_arrays(_checked(t, 0.0, 1.0), np.asarray(tau, dtype=np.float64))
        S = self.surface
        (px, py), (qx, qy), (ax, ay), (gx, gy) = (tuple(map(float, v)) for v in (S.p, S.q, S.a, S.g))
        return _placed((px + t * qx, py + t * qy), tau, (ax + t * gx, ay + t * gy))

    @checked
    def point(self, t: Number, tau: Number | None) -> RationalPoint:
        """The exact point (x, y, tau)."""
        s = to_fraction(t)
        if not 0 <= s <= 1:
            raise _beyond(s, "0", "1")
        return _exactly_placed(self.surface.helix(s), tau)

    @checked
    def locate(self, t: Number, tau: Number | None) -> Location:
        """Exact location of S(t, tau): inside the patch, on its rim, or outside."""
        s, in_range = to_fraction(t), self.Phi.locate(tau) if self.Phi else Location.OUTSIDE
        if not 0 <= s <= 1:
            return Location.OUTSIDE
        return Location.BOUNDARY if s in (0, 1) and in_range is Location.INSIDE else in_range


@dataclass(frozen=True, slots=True)
class RationalHelix:
    """Helix C(tau) of a v-v contact, section 3.3.1: a rational cubic in (x, y, tau).

    Attributes
    ----------
    helix : Helix
    Phi : RationalRange

    Examples
    --------
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> C = rational_helix(square, square, VertexVertex(1, 2))
    >>> C.point("1/2"), C.locate("1/2")
    ((Fraction(4, 5), Fraction(2, 5), Fraction(1, 2)), <Location.OUTSIDE: 'outside'>)
    >>> C.point(None), C.locate(None)
    ((Fraction(4, 1), Fraction(2, 1), None), <Location.BOUNDARY: 'boundary'>)
    """

    helix: Helix
    Phi: RationalRange

    def __call__(self, tau: ArrayLike) -> Floats:
        """Points (x, y, tau) in doubles: (..., 3)."""
        (px, py), (ax, ay) = (tuple(map(float, v)) for v in (self.helix.centre, self.helix.fixed))
        return _placed((px, py), np.asarray(tau, dtype=np.float64), (ax, ay))

    @checked
    def point(self, tau: Number | None) -> RationalPoint:
        """The exact point (x, y, tau)."""
        return _exactly_placed(self.helix, tau)

    @checked
    def locate(self, tau: Number | None) -> Location:
        """Exact location of C(tau): inside the arc of contacts, at an end, or outside."""
        return self.Phi.locate(tau)


@dataclass(frozen=True, slots=True)
class RationalSegment:
    """Segment C(t) of an e-e contact, section 3.3.2, or pseudo contact: one orientation, in general a square root.

    Attributes
    ----------
    surface : Surface
        S of the v-e contact of the edge's first vertex.
    angle : ExactAngle
        phi_min, or phi_min + pi.
    t_range : (Surd, Surd)
        Closed range of t: see `rational_segment` and `rational_edge_edge_surface`.

    Examples
    --------
    >>> triangle, square = Polygon([(0, 0), (2, 0), (1, 1)]), Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> C = rational_segment(triangle, square, EdgeEdge(1, 2))
    >>> [str(t) for t in C.t_range]
    ['0', '1 + 1/2 sqrt(2)']
    >>> [str(c) for c in C.point("1/2")]
    ['1 + sqrt(2)', '2 + sqrt(2)', '-1 - sqrt(2)']
    >>> C.locate("17/10"), C.locate("18/10")
    (<Location.INSIDE: 'inside'>, <Location.OUTSIDE: 'outside'>)
    """

    surface: Surface
    angle: ExactAngle
    t_range: tuple[Surd, Surd]

    def __call__(self, t: ArrayLike) -> Floats:
        """Points (x, y, tau) in doubles, t up to the rounded ends of its range: (..., 3)."""
        low, high = self.t_range
        s, tau = _checked(t, float(low), float(high)), self.angle.tau
        S = self.surface
        (px, py), (qx, qy), (ax, ay) = (tuple(map(float, v)) for v in (S.p, S.q, S.a))
        angle = np.full(s.shape, np.inf if tau is None else float(tau))
        return _placed((px + s * qx, py + s * qy), angle, (ax, ay))

    @checked
    def point(self, t: Number) -> tuple[Surd, Surd, Surd | None]:
        """The exact point (x, y, tau)."""
        s, (low, high) = to_fraction(t), self.t_range
        if self.locate(s) is Location.OUTSIDE:
            raise _beyond(s, str(low), str(high))
        (x, y), (ax, ay) = self.surface.helix(s, beyond=True).centre, self.surface.a
        cos, sin, n = self.angle.c, self.angle.s, self.angle.n
        return Surd(x, (sin * ay - cos * ax) / n, n), Surd(y, -(sin * ax + cos * ay) / n, n), self.angle.tau

    @checked
    def locate(self, t: Number) -> Location:
        """Exact location of C(t): inside the segment, at an end, or outside."""
        after_low, before_high = self.t_range[0].compare(t), self.t_range[1].compare(t)
        if after_low is Order.AFTER or before_high is Order.BEFORE:
            return Location.OUTSIDE
        return Location.BOUNDARY if Order.SAME in (after_low, before_high) else Location.INSIDE


@checked
def rational_range(robot: Polygon, obstacle: Polygon, contact: Contact) -> RationalRange:
    """Return the exact range Phi of a contact.

    Raises
    ------
    ValueError
        If the contact type is never a contact, as in `cfree.contact.contact.angle_range`.

    Notes
    -----
    Remark 4: the matrix M of eq. (7) holds no trigonometric function, R(pi / 2) being rational. Up to a positive factor
    (cos phi_min, sin phi_min) is -(E_i . E_j, E_i x E_j), so its half-angle tangent has one square root.

    Examples
    --------
    >>> triangle, square = Polygon([(0, 0), (2, 0), (1, 1)]), Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> Phi = rational_range(triangle, square, VertexEdge(2, 2))
    >>> Phi.start, Phi.end
    (ExactAngle(c=-1, s=1), ExactAngle(c=-1, s=-1))
    >>> [tau and str(tau) for interval in Phi.domain for tau in interval]
    ['1 + sqrt(2)', None, None, '-1 - sqrt(2)']
    """
    start, end = end_directions(robot, obstacle, contact)
    return RationalRange(ExactAngle(*start), ExactAngle(*end))


@checked
def rational_surface(robot: Polygon, obstacle: Polygon, contact: VertexEdge | EdgeVertex) -> RationalSurface:
    """Return surface and patch of a v-e or e-v contact; there is no patch at a reflex vertex.

    Examples
    --------
    >>> corner = Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
    >>> S = rational_surface(corner, corner, VertexEdge(3, 0))           # the reflex vertex on an edge
    >>> S.Phi, S.point("1/2", 1), S.locate("1/2", 1)
    (None, (Fraction(2, 1), Fraction(-1, 1), Fraction(1, 1)), <Location.OUTSIDE: 'outside'>)
    """
    is_convex = robot.convex[contact.i] if isinstance(contact, VertexEdge) else obstacle.convex[contact.j]
    Phi = rational_range(robot, obstacle, contact) if is_convex else None
    return RationalSurface(contact_surface(robot, obstacle, contact), Phi)


@checked
def rational_helix(robot: Polygon, obstacle: Polygon, contact: VertexVertex) -> RationalHelix:
    """Return the helix of a v-v contact; a ValueError if reflex vertices leave it no angle."""
    return RationalHelix(contact_helix(robot, obstacle, contact), rational_range(robot, obstacle, contact))


@checked
def rational_segment(robot: Polygon, obstacle: Polygon, contact: EdgeEdge) -> RationalSegment:
    """Return the segment of an e-e contact; a ValueError if reflex vertices keep the edges apart."""
    angle = rational_range(robot, obstacle, contact).start
    S = contact_surface(robot, obstacle, VertexEdge(contact.i, contact.j))
    return RationalSegment(S, angle, _t_range(robot, obstacle, contact))


@checked
def rational_edge_edge_surface(
    robot: Polygon, obstacle: Polygon, contact: EdgeEdge
) -> tuple[RationalSegment, RationalSegment]:
    """Return both segments of an e-e pair's contact surface, Definition 1: the exact `contact.edge_edge_surface`.

    Examples
    --------
    >>> triangle, square = Polygon([(0, 0), (2, 0), (1, 1)]), Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> for C in rational_edge_edge_surface(triangle, square, EdgeEdge(1, 2)):
    ...     print(C.angle.tau, *C.t_range, sep=", ")
    -1 - sqrt(2), 0, 1 + 1/2 sqrt(2)
    -1 + sqrt(2), - 1/2 sqrt(2), 1
    """
    c, s = direction_against(robot, obstacle, contact)
    S = contact_surface(robot, obstacle, VertexEdge(contact.i, contact.j))
    q, n = _ratio_of_lengths(robot, obstacle, contact)
    against, alongside = (Surd(0), Surd(1, q, n)), (Surd(0, -q, n), Surd(1))
    return RationalSegment(S, ExactAngle(c, s), against), RationalSegment(S, ExactAngle(-c, -s), alongside)


@checked
def to_rational(points: ArrayLike) -> Floats:
    """Convert points (x, y, theta) of the geometrical model to (x, y, tau), in doubles.

    Parameters
    ----------
    points : (..., 3) array
        theta in radians, any value. Values within one unit in the last place of a multiple of pi / 2 mean that
        multiple.

    Returns
    -------
    (..., 3) float64
        tau is inf at the half turn.

    Raises
    ------
    ValueError
        If the shape is different, or a number is not finite.

    Notes
    -----
    Measured on random points: theta to tau to theta returns within one unit in its last place. Near the half turn tau
    is large and has no more digits than pi - theta. So tau to theta to tau returns with a relative error of at most
    2^-50 over the sine of theta, and as inf from about 1e16 on. Whole turns are lost. A `Pose` is exact in both models,
    with `tau`, `theta` and `theta_error`.

    Examples
    --------
    >>> import math
    >>> to_rational([[1, 2, math.pi / 2], [1, 2, math.pi]])
    array([[ 1.,  2.,  1.],
           [ 1.,  2., inf]])
    """
    table = _triples(points)
    if not np.isfinite(table).all():
        raise ValueError("a coordinate is not finite; give finite x, y, theta")
    return np.concatenate((table[..., :2], tau_of(table[..., 2])[..., None]), axis=-1)


@checked
def to_geometrical(points: ArrayLike) -> Floats:
    """Convert points (x, y, tau) of the rational model to (x, y, theta), theta in [0, 2 pi), in doubles.

    Parameters
    ----------
    points : (..., 3) array
        tau is inf or -inf at the half turn.

    Raises
    ------
    ValueError
        If the shape is different, x or y is not finite, or tau is NaN.

    Notes
    -----
    theta is rounded, as a rational tau other than 0 and +-1 has a transcendental angle; see `to_rational`.

    Examples
    --------
    >>> to_geometrical([1, 2, -1]) / (1, 1, np.pi)
    array([1. , 2. , 1.5])
    """
    table = _triples(points)
    if not np.isfinite(table[..., :2]).all():
        raise ValueError("a coordinate is not finite; give finite x, y")
    return np.concatenate((table[..., :2], theta_of_tau(table[..., 2])[..., None]), axis=-1)


def _exactly_placed(helix: Helix, tau: Number | None) -> RationalPoint:
    """Exact point P - M(tau) a of a helix."""
    tangent = half_tangent(tau)
    c, s, w = half_angle_rotation(tangent)
    (px, py), (ax, ay) = helix.centre, helix.fixed
    return px - (c * ax - s * ay) / w, py - (s * ax + c * ay) / w, tangent


def _placed(P: tuple[ArrayLike, ArrayLike], tau: Floats, a: tuple[ArrayLike, ArrayLike]) -> Floats:
    """Points P - M(tau) a for arrays of the shape of tau."""
    c, s = rational_rotation(tau)
    (px, py), (ax, ay) = (np.asarray(v, dtype=np.float64) for v in P), (np.asarray(v, dtype=np.float64) for v in a)
    return np.stack((px - (c * ax - s * ay), py - (s * ax + c * ay), tau), axis=-1)


def _t_range(robot: Polygon, obstacle: Polygon, contact: EdgeEdge) -> tuple[Surd, Surd]:
    """`edge_edge_range` of a range that is not empty, with L = |E_i| / |E_j| as it is."""
    i, j, root = contact.i, contact.j, _ratio_of_lengths(robot, obstacle, contact)
    zero, one, L, both = Surd(0), Surd(1), Surd(0, *root), Surd(1, *root)
    L_is_long = L.compare(1) is Order.AFTER
    from_a, from_b = not robot.convex[i], not obstacle.convex[j]
    to_a, to_b = not robot.convex[robot.next[i]], not obstacle.convex[obstacle.next[j]]
    low = L if from_b and (L_is_long or not from_a) else one if from_a else zero
    high = L if to_a and not (to_b and L_is_long) else one if to_b else both
    return low, high


def _ratio_of_lengths(robot: Polygon, obstacle: Polygon, contact: EdgeEdge) -> tuple[Fraction, int]:
    """q and n of the length q sqrt(n) of E_i over that of E_j."""
    (ux, uy), (vx, vy) = robot.exact_edge(contact.i), obstacle.exact_edge(contact.j)
    L2 = (ux * ux + uy * uy) / (vx * vx + vy * vy)
    return Fraction(1, L2.denominator), L2.numerator * L2.denominator


def _checked(t: ArrayLike, low: float, high: float) -> Floats:
    s = np.asarray(t, dtype=np.float64)
    bad = ~((s >= low) & (s <= high))
    if bad.any():
        raise _beyond(float(s[bad][0]), str(low), str(high))
    return s


def _beyond(t: float | Fraction, low: str, high: str) -> ValueError:
    return ValueError(f"t = {t} is not on the edge, and no contact of any sort; give t in [{low}, {high}]")


def _triples(points: ArrayLike) -> Floats:
    table = np.asarray(points, dtype=np.float64)
    if table.ndim == 0 or table.shape[-1] != 3:
        raise ValueError(f"points: shape {table.shape}; give (..., 3)")
    return table
