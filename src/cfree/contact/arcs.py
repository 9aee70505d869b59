"""Contacts of shapes with circular arcs: their pairs, orientations and surfaces.

The paper ends with this case (section 5); docs/theory/arcs.md has the proofs. Let alpha and beta be the centres of an
arc of the robot and of the obstacle, rho_A and rho_O their signed radii, s_A and s_O the offsets of edges (see
`cfree.contact.features`), and u the obstacle's unit outward normal at the contact.

    arc on edge   r = b + t E + (rho_A + s_O) n - R(phi) alpha          the v-e surface of the centre, moved
    edge on arc   r = beta - R(phi) (a + t G + (rho_O + s_A) n)         the e-v surface of the edge, moved outwards
    arc on arc    r = beta - R(phi) alpha + sigma u(psi),    sigma = rho_A + rho_O

The third surface is new. It is a contact where the normal psi is in the obstacle's cone and psi + pi - phi in the
robot's: a parallelogram of (psi, phi). A vertex is an arc of radius 0, so v-e and e-v contacts are the first two kinds,
and where sigma is 0, as for two vertices, the third one is a helix.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeVar

from cfree.arguments import checked
from cfree.contact.contact import AngleRange, EdgeVertex, VertexEdge
from cfree.contact.features import ArcFeature, EdgeFeature, ShapeFeatures, shape_features, signed_root
from cfree.contact.surface import Helix, Surface, evaluate
from cfree.curves.curved import Curved
from cfree.exact.half_angle import Angle, normalize_angles
from cfree.exact.number import ExactPoint, IntPoint, Number, angle, finite
from cfree.exact.orientation import Location, Vector
from cfree.exact.pose import Pose
from cfree.libraries import ArrayLike, Floats, np
from cfree.polygons.polygon import Polygon

F = TypeVar("F", ArcFeature, EdgeFeature)
Shape = Polygon | Curved
ZERO = (Fraction(0), Fraction(0))
ROBOT_ARC, ROBOT_EDGE = "arc of the robot", "edge of the robot"
OBSTACLE_ARC, OBSTACLE_EDGE = "arc of the obstacle", "edge of the obstacle"


@checked
@dataclass(frozen=True, slots=True, order=True)
class ArcEdge:
    """Arc or vertex i of the robot on edge j of the obstacle."""

    i: int
    j: int


@checked
@dataclass(frozen=True, slots=True, order=True)
class EdgeArc:
    """Edge i of the robot on arc or vertex j of the obstacle."""

    i: int
    j: int


@checked
@dataclass(frozen=True, slots=True, order=True)
class ArcArc:
    """Arc or vertex i of the robot on arc or vertex j of the obstacle."""

    i: int
    j: int


ArcContact = ArcEdge | EdgeArc | ArcArc


@dataclass(frozen=True, slots=True)
class OffsetSurface:
    """Contact surface of an arc on an edge, or of an edge on an arc: a v-e or e-v surface with an offset.

    Attributes
    ----------
    contact : ArcEdge or EdgeArc
    core : Surface
        The v-e surface of the arc's centre and the edge, or the e-v surface of the edge and the arc's centre.
    signed_square : Fraction
        ``rho |rho|`` of the arc.
    edge_offset : Fraction
        Offset of the edge.

    Examples
    --------
    A disc of radius 1 on the edge y = 0 of a half-plane, at the height 1.

    >>> slab = Polygon([(0, -1), (0, 0), (-4, 0), (-4, -1)])
    >>> j = [edge.start for edge in shape_features(slab).edges].index((0, 0))
    >>> S = arc_surface(Curved.circle((0, 0), 1), slab, ArcEdge(0, j))
    >>> S([0, 0.5], 2.0)
    array([[ 0.,  1.,  2.],
           [-2.,  1.,  2.]])
    >>> S.pose("1/4", "90deg") == Pose(-1, 1, "90deg")
    True
    """

    contact: ArcEdge | EdgeArc
    core: Surface
    signed_square: Fraction
    edge_offset: Fraction

    @property
    def offset(self) -> float:
        """Distance rho + s from the core surface's edge, to the outside if positive, rounded."""
        return math.copysign(math.sqrt(abs(self.signed_square)), self.signed_square) + float(self.edge_offset)

    @property
    def ruled(self) -> Floats:
        """p, q, a, g as doubles, (8,), for `cfree.geometry`; those of `exact` rounded."""
        row = self.core.ruled
        x, y = row[2:4] + row[6:8]
        moved = slice(0, 2) if isinstance(self.contact, ArcEdge) else slice(4, 6)
        row[moved] += self.offset / math.hypot(x, y) * np.array([y, -x])
        return row

    @property
    def exact(self) -> Surface | None:
        """The same surface in fractions; None if the radius or the length of the edge is irrational.

        Examples
        --------
        >>> disc, triangle = Curved.circle((0, 0), 1), Polygon([(0, 0), (4, 0), (0, 3)])
        >>> arc_surface(disc, triangle, ArcEdge(0, 1)).exact.p
        (Fraction(23, 5), Fraction(4, 5))
        >>> arc_surface(disc, Polygon([(0, 0), (1, 0), (0, 1)]), ArcEdge(0, 1)).exact is None
        True
        """
        rho, S = signed_root(self.signed_square), self.core
        x, y = (S.q[0] + S.g[0], S.q[1] + S.g[1])
        length = signed_root(x * x + y * y)
        if self.signed_square == 0 and self.edge_offset == 0:
            return S
        if rho is None or length is None:
            return None
        share = (rho + self.edge_offset) / length
        if isinstance(self.contact, ArcEdge):
            return Surface(S.contact, (S.p[0] + share * y, S.p[1] - share * x), S.q, S.a, S.g)
        return Surface(S.contact, S.p, S.q, (S.a[0] + share * y, S.a[1] - share * x), S.g)

    def __call__(self, t: ArrayLike, phi: ArrayLike, *, beyond: bool = False) -> Floats:
        """Points (x, y, phi) at t and phi in radians, (..., 3); see `Surface`."""
        return evaluate(self.ruled, t, phi, beyond=beyond)

    @checked
    def helix(self, t: Number, *, beyond: bool = False) -> Helix:
        """Return the curve phi -> S(t, phi) of a rational surface; see `exact` and `Surface.helix`."""
        return self._rational().helix(t, beyond=beyond)

    @checked
    def pose(self, t: Number, theta: Angle, *, beyond: bool = False) -> Pose:
        """Return the exact pose at t and theta of a rational surface; see `exact` and `Surface.pose`."""
        return self._rational().pose(t, theta, beyond=beyond)

    def _rational(self) -> Surface:
        if (surface := self.exact) is None:
            raise _irrational(self.contact, "radius or length of the edge")
        return surface


@dataclass(frozen=True, slots=True)
class ArcArcSurface:
    """Contact surface S(psi, phi) = (p - R(phi) a + sigma u(psi), phi) of an arc on an arc.

    Attributes
    ----------
    contact : ArcArc
    robot, obstacle : ArcFeature
        The two arcs; p and a are their centres.

    Examples
    --------
    Two discs of radii 1 and 2 touch where their centres are 3 apart.

    >>> S = arc_surface(Curved.circle((1, 0), 1), Curved.circle((0, 0), 2), ArcArc(0, 0))
    >>> S.sigma, S(0, [0, 1.5])
    (Fraction(3, 1), array([[ 2.        ,  0.        ,  0.        ],
           [ 2.9292628 , -0.99749499,  1.5       ]]))
    >>> S.pose("90deg", "90deg") == Pose(0, 2, "90deg")
    True
    """

    contact: ArcArc
    robot: ArcFeature
    obstacle: ArcFeature

    @property
    def p(self) -> ExactPoint:
        """Centre beta of the obstacle's arc."""
        return self.obstacle.centre

    @property
    def a(self) -> ExactPoint:
        """Centre alpha of the robot's arc, in the robot's own coordinates."""
        return self.robot.centre

    @property
    def sigma(self) -> Fraction | None:
        """Sum of both signed radii as a fraction; None if it is irrational."""
        if self.robot.signed_square == -self.obstacle.signed_square:
            return Fraction(0)
        rho_A, rho_O = self.robot.radius, self.obstacle.radius
        return None if rho_A is None or rho_O is None else rho_A + rho_O

    @property
    def sign(self) -> int:
        """Exact sign of sigma, which is that of the sum of the signed squares, as ``x |x|`` grows with x."""
        total = self.robot.signed_square + self.obstacle.signed_square
        return (total > 0) - (total < 0)

    @property
    def circular(self) -> Floats:
        """p, a, sigma as doubles, (5,), for `cfree.geometry`."""
        sigma = self.robot.signed_radius + self.obstacle.signed_radius if self.sigma is None else float(self.sigma)
        return np.array([*map(float, self.p), *map(float, self.a), sigma])

    @property
    def is_possible(self) -> bool:
        """True if the two do not overlap near such a contact, inside their cones: curvatures add up to 0 or more.

        Two convex arcs always touch so, a convex one and a concave one if the radius of the convex one is not the
        larger: sigma <= 0. Two concave arcs never do.
        """
        if self.robot.is_convex and self.obstacle.is_convex:
            return True
        return (self.robot.is_convex or self.obstacle.is_convex) and self.sign <= 0

    @property
    def parallelogram(self) -> Floats:
        """Corners (psi, phi) of the domain, (4, 2), counter-clockwise from the least phi; angles are not reduced.

        Examples
        --------
        >>> square = Curved([(0, 0), (1, 0), (1, 1), (0, 1)], grown=1)
        >>> (arc_surface(square, square, ArcArc(0, 2)).parallelogram / (math.pi / 2)).round(12) + 0.0
        array([[0., 3.],
               [1., 4.],
               [1., 5.],
               [0., 4.]])
        """
        (low, high), (first, last) = ((arc.first, arc.first + arc.width) for arc in (self.obstacle, self.robot))
        corners = np.array([(low, last), (high, last), (high, first), (low, first)])
        corners[:, 1] = corners[:, 0] + math.pi - corners[:, 1]
        corners[:, 1] -= math.tau * math.floor(corners[0, 1] / math.tau)
        return corners

    def __call__(self, psi: ArrayLike, phi: ArrayLike) -> Floats:
        """Points (x, y, phi) at the normal's angle psi and at phi, in radians, broadcast: (..., 3).

        Any angles; points outside of the parallelogram, see `locate`, are on the surface, not on the patch.
        """
        psi, phi = np.broadcast_arrays(finite("psi", psi), finite("phi", phi))
        px, py, ax, ay, sigma = self.circular
        c, s = np.cos(phi), np.sin(phi)
        x, y = px - (c * ax - s * ay) + sigma * np.cos(psi), py - (s * ax + c * ay) + sigma * np.sin(psi)
        return np.stack((x, y, phi), axis=-1)

    @checked
    def grid(self, psi: ArrayLike, phi: ArrayLike) -> Floats:
        """Positions at all pairs of psi and phi: (len(phi), len(psi), 2)."""
        return self(finite("psi", psi)[None, :], finite("phi", phi)[:, None])[..., :2]

    @checked
    def locate(self, normal: Vector, turn: Vector) -> Location:
        """Location of (psi, phi) in the parallelogram, from the exact directions of both angles, up to length.

        Examples
        --------
        >>> square = Curved([(0, 0), (1, 0), (1, 1), (0, 1)], grown=1)
        >>> S = arc_surface(square, square, ArcArc(0, 2))
        >>> S.locate((1, 1), (1, 0)), S.locate((1, 0), (1, 0)), S.locate((1, 1), (-1, 0))
        (<Location.INSIDE: 'inside'>, <Location.BOUNDARY: 'boundary'>, <Location.OUTSIDE: 'outside'>)
        """
        places = self.obstacle.locate(normal), self.robot.locate(opposite_in_robot(normal, turn))
        if Location.OUTSIDE in places:
            return Location.OUTSIDE
        return Location.BOUNDARY if Location.BOUNDARY in places else Location.INSIDE

    @checked
    def helix(self, psi: Angle) -> Helix:
        """Return the curve of one psi: the robot turns about the centre of its own arc, its point a.

        `cfree.Rotation(helix.centre, angle)` follows it from each of its poses. An angle whose half-angle tangent is
        irrational is replaced as in `cfree.Pose`.

        Raises
        ------
        ValueError
            If sigma is irrational: the helix then has no rational centre.
        """
        (x, y), (px, py) = self._normal(psi), self.p
        return Helix((px + x, py + y), self.a)

    @checked
    def rolling_helix(self, chi: Angle) -> Helix:
        """Return the curve of one chi = psi - phi: the robot turns about the obstacle's centre p.

        The robot's normal at the contact, chi + pi in its own coordinates, stays. Else as `helix`.

        Examples
        --------
        >>> S = arc_surface(Curved.circle((1, 0), 1), Curved.circle((0, 0), 2), ArcArc(0, 0))
        >>> helix = S.rolling_helix("180deg")
        >>> helix.centre == (0, 0), helix.fixed == (4, 0), helix.pose("90deg") == S.pose("270deg", "90deg")
        (True, True, True)
        """
        (x, y), (ax, ay) = self._normal(chi), self.a
        return Helix(self.p, (ax - x, ay - y))

    @checked
    def pose(self, psi: Angle, theta: Angle) -> Pose:
        """Return the exact pose at psi and theta; a ValueError if sigma is irrational."""
        return self.helix(psi).pose(theta)

    def _normal(self, psi: Angle) -> ExactPoint:
        """Exact vector sigma u(psi)."""
        if (sigma := self.sigma) is None:
            raise _irrational(self.contact, "sum of the radii")
        ((x, y),) = Pose(0, 0, psi).apply_exact([(sigma, 0)])
        return x, y


@checked
def arc_contacts(robot: Shape, obstacle: Shape) -> tuple[ArcContact, ...]:
    """All pairs of features that have a contact patch with two parameters.

    Notes
    -----
    These are convex arcs and vertices on edges, edges on these, and pairs of arcs that are possible (see
    `ArcArcSurface.is_possible`) with sigma != 0. The curves left out, sigma = 0, are those of `arc_curves`.

    Examples
    --------
    >>> square, disc = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)]), Curved.circle((0, 0), 1)
    >>> [len(arc_contacts(disc, square)), len(arc_contacts(square, square)), len(arc_contacts(disc, disc))]
    [8, 32, 1]
    """
    A, O = shape_features(robot), shape_features(obstacle)
    return (
        *(ArcEdge(i, j) for i, arc in enumerate(A.arcs) if arc.is_convex for j in range(len(O.edges))),
        *(EdgeArc(i, j) for i in range(len(A.edges)) for j, arc in enumerate(O.arcs) if arc.is_convex),
        *(S.contact for S in _pairs(A, O) if S.is_possible and S.sign),
    )


@checked
def arc_curves(robot: Shape, obstacle: Shape) -> tuple[ArcArc, ...]:
    """All possible pairs of arcs with sigma = 0: two convex vertices, or an arc in one of its own radius.

    The second is an exact fit: the robot turns about the common centre. Pairs with a reflex vertex are left to
    `contact_curves`.

    Examples
    --------
    >>> from cfree.curves import Circle
    >>> hole = Curved([(-3, -3), (3, -3), (3, 3), (-3, 3)], holes=[Circle((0, 0), 1)])
    >>> arc_curves(Curved.circle((0, 0), 1), hole)
    (ArcArc(i=0, j=4),)
    """
    A, O = shape_features(robot), shape_features(obstacle)
    return tuple(
        S.contact
        for S in _pairs(A, O)
        if S.sign == 0 and S.is_possible and (S.robot.signed_square or (S.robot.is_convex and S.obstacle.is_convex))
    )


@checked
def arc_range(robot: Shape, obstacle: Shape, contact: ArcContact) -> AngleRange:
    """Range of orientations at which a pair of features can be in contact.

    Returns
    -------
    AngleRange
        Its width is the turn of the arc, t_i or t_j, and for two arcs t_i + t_j: the parallelogram's height, at most a
        full turn. A range of a full turn has equal ends, and no boundary there.

    Raises
    ------
    ValueError
        If the contact is impossible; see `arc_contacts`.

    Notes
    -----
    With the obstacle's normal n and the robot's normal m in its own coordinates R(phi) m = -n; the last m of the
    robot's cone is the first to come.

    Examples
    --------
    >>> square, round_square = (Curved([(0, 0), (1, 0), (1, 1), (0, 1)], grown=r) for r in (0, "1/2"))
    >>> arc_range(round_square, round_square, ArcEdge(0, 0)).domain == ((math.pi, 1.5 * math.pi),)
    True
    >>> arc_range(Curved.circle((0, 0), 1), round_square, ArcEdge(0, 0)).phi_range == 2 * math.pi
    True
    """
    A, O = shape_features(robot), shape_features(obstacle)
    match contact:
        case ArcEdge(i, j):
            arc, n = _feature(A.arcs, i, ROBOT_ARC), _feature(O.edges, j, OBSTACLE_EDGE).outward
            possible, width, start, end = arc.is_convex, arc.width, _turn(n, arc.end), _turn(n, arc.start)
        case EdgeArc(i, j):
            arc, m = _feature(O.arcs, j, OBSTACLE_ARC), _feature(A.edges, i, ROBOT_EDGE).outward
            possible, width, start, end = arc.is_convex, arc.width, _turn(arc.start, m), _turn(arc.end, m)
        case ArcArc(i, j):
            S = ArcArcSurface(contact, _feature(A.arcs, i, ROBOT_ARC), _feature(O.arcs, j, OBSTACLE_ARC))
            possible, width = S.is_possible, S.robot.width + S.obstacle.width
            start, end = _turn(S.obstacle.start, S.robot.end), _turn(S.obstacle.end, S.robot.start)
    if not possible:
        raise ValueError(f"{contact} is never a contact: its curvatures leave no room; see arc_contacts()")
    if width > math.tau - 1e-6:  # ends tell a little more than a full turn from a little less
        rest = angle(start[0] * end[0] + start[1] * end[1], start[0] * end[1] - start[1] * end[0]) % math.tau
        if not math.pi < rest:
            width, end = math.tau, start
    return AngleRange(float(normalize_angles(angle(*start))), width, start, end)


@checked
def arc_surface(robot: Shape, obstacle: Shape, contact: ArcContact) -> OffsetSurface | ArcArcSurface:
    """Return the contact surface of a pair of features, contacts and pseudo contacts."""
    A, O = shape_features(robot), shape_features(obstacle)
    match contact:
        case ArcArc(i, j):
            return ArcArcSurface(contact, _feature(A.arcs, i, ROBOT_ARC), _feature(O.arcs, j, OBSTACLE_ARC))
        case ArcEdge(i, j):
            arc, edge = _feature(A.arcs, i, ROBOT_ARC), _feature(O.edges, j, OBSTACLE_EDGE)
            core = Surface(VertexEdge(i, j), edge.start, edge.along, arc.centre, ZERO)
        case EdgeArc(i, j):
            edge, arc = _feature(A.edges, i, ROBOT_EDGE), _feature(O.arcs, j, OBSTACLE_ARC)
            core = Surface(EdgeVertex(i, j), arc.centre, ZERO, edge.start, edge.along)
    return OffsetSurface(contact, core, arc.signed_square, edge.offset)


def _feature(features: tuple[F, ...], k: int, name: str) -> F:
    if 0 <= k < len(features):
        return features[k]
    raise ValueError(f"{name} {k}: there are {len(features)}, counted from 0; see shape_features()")


def opposite_in_robot(normal: Vector, turn: Vector) -> Vector:
    """Direction, in the robot's coordinates, of the robot's outward normal where the obstacle's is `normal`."""
    (x, y), (c, s) = normal, turn
    return -(c * x + s * y), s * x - c * y


def _pairs(A: ShapeFeatures, O: ShapeFeatures) -> list[ArcArcSurface]:
    return [ArcArcSurface(ArcArc(i, j), a, o) for i, a in enumerate(A.arcs) for j, o in enumerate(O.arcs)]


def _turn(n: IntPoint, m: IntPoint) -> IntPoint:
    """Direction of the rotation that brings m to -n, up to length."""
    return -(m[0] * n[0] + m[1] * n[1]), -(m[0] * n[1] - m[1] * n[0])


def _irrational(contact: ArcContact, number: str) -> ValueError:
    return ValueError(f"{contact}: {number} irrational; use the points in doubles, or radii that are fractions")
