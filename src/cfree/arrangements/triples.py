"""Poses with three contacts of a robot: intersections of three contact surfaces.

The lines P_k + t U_k of three surfaces have a point in common only if

    det (U_k,x  U_k,y  P_k x U_k) = 0,

and then they have one, unless all three are parallel. The determinant is a polynomial of degree 2 in tau for surfaces
of one kind, and of degree 4 for both kinds. If it is 0 everywhere, the surfaces have a curve in common, like surfaces
at one vertex.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from typing import Literal

from cfree.arguments import checked
from cfree.arrangements.curve import IntersectionCurve, curve_on
from cfree.arrangements.intersections import SharedLine, overlap_at, shared_line
from cfree.arrangements.moving_lines import AnySurface, MovingLine, between, cross, moving_lines, whole
from cfree.arrangements.ranges import along, is_inside_patches, is_on_patches, ranges_of, ranges_on
from cfree.contact.surface import Surface
from cfree.exact.algebraic import ratio, rounded
from cfree.exact.angle_interval import AlgebraicAngle, AngleInterval
from cfree.exact.forms import ZERO_ANGLE, Form, W, common_factor, plus, primitive, product, quotient, value_at, zeros
from cfree.exact.half_angle import tau_in_chart
from cfree.exact.number import ExactPoint
from cfree.exact.orientation import Location
from cfree.exact.pose import Pose
from cfree.rational.model import RationalSurface
from cfree.words import counted

Pair = tuple[int, int]


@dataclass(frozen=True, slots=True)
class TripleContact:
    """A pose on three contact surfaces, with edges extended to lines.

    Attributes
    ----------
    angle : AlgebraicAngle
        Its orientation, a zero of `Triple.polynomial`; its own polynomial is an irreducible factor.
    multiplicity : int
        Multiplicity of that zero; if above 1, the curves of two pairs of surfaces touch there.
    curve : IntersectionCurve
        A curve through the pose: x and y are quotients of polynomials in tau.
    t : (float, float, float)
        Parameters on the three edges.
    location : Location
        Inside all three surfaces, or patches; at the rim of one and outside none; or outside one.
    """

    angle: AlgebraicAngle
    multiplicity: int
    curve: IntersectionCurve
    t: tuple[float, float, float]
    location: Location

    @property
    def xy(self) -> tuple[float, float]:
        """Position in doubles, each within 0.51 units of its last place."""
        return self.curve.rounded(self.angle)

    @property
    def pose(self) -> Pose | None:
        """Exact pose if tau is rational, else None; see `near`."""
        local = self.angle.coordinate
        return self.curve.pose({"tau": tau_in_chart(self.angle.chart, local)}) if isinstance(local, Fraction) else None

    @checked
    def near(self, bits: int) -> ExactPoint:
        """Position with errors of at most 2^-bits."""
        return self.curve.near(self.angle, bits)


@dataclass(frozen=True, slots=True, repr=False)
class Triple:
    """Intersection of three contact surfaces; edges count as lines, except in `contacts`, `ranges` and `t_range`.

    Attributes
    ----------
    surfaces : three of Surface or RationalSurface
        The arguments; only the patch of a `RationalSurface` counts.
    relation : {"points", "curve", "parallel", "identical"}
        Points: only at zeros of the polynomial. Curve: a whole curve is on all three. Parallel: at every orientation
        all three lines are parallel. Identical: they are one surface.
    polynomial : tuple of int
        Coefficients of 1, tau, tau^2, ..., at most 5, of the polynomial whose zeros are the orientations of `poses`. If
        the last one is 0, the half turn is a zero. Three parallel lines may be disjoint at a zero. The value is (0,)
        unless the relation is "points".
    poses : tuple of TripleContact
        Poses from theta = 0 on.
    lines : tuple of SharedLine
        Orientations at which all three lines are equal.
    curve : IntersectionCurve or None
    ranges : tuple of AngleInterval
        Intervals on which the curve, or the common part of identical surfaces, is on all three.

    Examples
    --------
    >>> from cfree import Polygon
    >>> from cfree.contact import EdgeVertex, VertexEdge, contact_surface
    >>> robot, room = Polygon([(0, 0), (2, 0), (0, 2)]), Polygon([(-3, 0), (3, 0), (3, 3), (0, 1), (-3, 3)])
    >>> contacts = VertexEdge(0, 0), VertexEdge(1, 0), EdgeVertex(1, 3)
    >>> meeting = triple(*(contact_surface(robot, room, contact) for contact in contacts))
    >>> meeting.polynomial, [(pose.angle.theta, pose.xy, pose.location.value) for pose in meeting.poses]
    ((0, -1, 2, 1, 0), [(0.0, (-1.0, 0.0), 'inside'), (3.141592653589793, (3.0, 0.0), 'outside')])
    """

    surfaces: tuple[AnySurface, AnySurface, AnySurface]
    relation: Literal["points", "curve", "parallel", "identical"]
    polynomial: Form
    poses: tuple[TripleContact, ...] = ()
    lines: tuple[SharedLine, ...] = ()
    curve: IntersectionCurve | None = None
    ranges: tuple[AngleInterval, ...] = ()

    def __repr__(self) -> str:
        return f"<Triple: {self.relation}, {counted(len(self.poses), 'pose')}, {counted(len(self.lines), 'line')}>"

    @property
    def contacts(self) -> tuple[TripleContact, ...]:
        """Poses on all three surfaces, or patches, ends included."""
        return tuple(pose for pose in self.poses if pose.location is not Location.OUTSIDE)


@checked
def triple(
    first: Surface | RationalSurface, second: Surface | RationalSurface, third: Surface | RationalSurface
) -> Triple:
    """Intersect three contact surfaces of one robot and any obstacles.

    Parameters
    ----------
    first, second, third : Surface or RationalSurface
        A `Surface` stands for all its pseudo contacts, a `RationalSurface` for its patch.

    Notes
    -----
    The result is exact. Its time depends only on the length of the numbers. See the theory's page on intersections.
    """
    return triple_of((first, second, third), True)


def triple_of(surfaces: tuple[AnySurface, AnySurface, AnySurface], outside: bool) -> Triple:
    """Intersect three contact surfaces; poses outside one of them are included only if `outside` is set."""
    lines = moving_lines(surfaces)
    origin = whole(surfaces[0]).p
    D = {(i, j): cross(lines[i].U, lines[j].U) for i, j in combinations(range(3), 2)}
    gaps = [cross(between(lines[i].P, lines[j].P), lines[i].U) for i, j in D]
    polynomial = _determinant(lines, D)
    coincident = common_factor([*D.values(), *gaps])
    shared = tuple(shared_line(angle, 1, lines) for angle, _ in zeros(coincident)) if any(coincident) else ()
    if any(polynomial):
        angles = {line.angle for line in shared}
        poses = (_contact(a, times, lines, origin, D, outside) for a, times in zeros(polynomial) if a not in angles)
        return Triple(surfaces, "points", polynomial, tuple(pose for pose in poses if pose), shared)
    pair = next((pair for pair in D if any(D[pair])), None)
    if pair is not None:
        curve = _curve(pair, lines, origin, D)
        return Triple(surfaces, "curve", polynomial, (), shared, curve, ranges_on(curve, lines))
    if any(map(any, gaps)):
        return Triple(surfaces, "parallel", polynomial, (), shared)
    return Triple(surfaces, "identical", polynomial, ranges=ranges_of(lines) if overlap_at(lines, ZERO_ANGLE) else ())


def _determinant(lines: tuple[MovingLine, ...], D: dict[Pair, Form]) -> Form:
    """Determinant of three lines without its factors W: a form of degree at most 4."""
    d = [cross(line.P, line.U) for line in lines]
    total = plus(product(D[0, 1], d[2]), plus(product(D[1, 2], d[0]), product(D[0, 2], d[1]), -1))
    if not any(total):
        return (0,)
    while len(common_factor((total, W))) == len(W):
        total = quotient(total, W)
    return primitive(total)


def _contact(
    angle: AlgebraicAngle,
    times: int,
    lines: tuple[MovingLine, ...],
    origin: ExactPoint,
    D: dict[Pair, Form],
    outside: bool,
) -> TripleContact | None:
    """Pose at a zero of the determinant; None if three parallel lines are disjoint there, or if it is not wanted."""
    pair = next((pair for pair in D if value_at(D[pair], angle) != 0), None)
    if pair is None:
        return None
    curve = _curve(pair, lines, origin, D)
    t = [ratio(*(value_at(form, angle) for form in along(curve, line))) for line in lines]
    if not is_on_patches(lines, angle) or not all(0 <= s <= 1 for s in t):
        if not outside:
            return None
        location = Location.OUTSIDE
    else:
        location = (
            Location.INSIDE if all(0 < s < 1 for s in t) and is_inside_patches(lines, angle) else Location.BOUNDARY
        )
    return TripleContact(angle, times, curve, (rounded(t[0]), rounded(t[1]), rounded(t[2])), location)


def _curve(pair: Pair, lines: tuple[MovingLine, ...], origin: ExactPoint, D: dict[Pair, Form]) -> IntersectionCurve:
    one, other = (lines[k] for k in pair)
    return curve_on(one, cross(between(one.P, other.P), other.U), D[pair], origin)
