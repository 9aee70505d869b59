"""Whole contact surfaces of one pair in the paper's parameters; patches restrict t and phi.

Paper, sections 2 and 3. One formula covers both kinds of ruled surface,

    S(t, phi) = (p + t q - R(phi) (a + t g), phi)

    v-e, eq. (5):  p = b_j, q = E_j, a = a_i, g = 0       cylindrical: its helices are congruent
    e-v, eq. (8):  p = b_j, q = 0,   a = a_i, g = E_i     a saddle: their radii differ

and every curve phi -> S(t, phi) is the helix of Lemma 1, a rotation about p + t q of the robot's point a + t g.
Results are arrays (..., 3) of x, y and phi in double precision; `pose` returns an exact pose.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

import cfree._core as _core
from cfree.arguments import checked
from cfree.contact.contact import (
    EdgeEdge,
    EdgeVertex,
    VertexEdge,
    VertexVertex,
    angle_range,
    direction_against,
    edge_edge_range,
)
from cfree.exact.half_angle import Angle, normalize_angles
from cfree.exact.number import ExactPoint, Number, angle, finite, to_fraction
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.libraries import ArrayLike, Floats, np
from cfree.polygons.polygon import Polygon


@dataclass(frozen=True, slots=True)
class Surface:
    """Contact surface S(t, phi) of a v-e or e-v contact.

    Attributes
    ----------
    contact : VertexEdge or EdgeVertex
    p, q, a, g : pair of Fraction
        The vectors of the formula at the top of this file.

    Examples
    --------
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> S = contact_surface(square, square, VertexEdge(0, 2))
    >>> S([0, 0.5, 1], 0)
    array([[2., 2., 0.],
           [1., 2., 0.],
           [0., 2., 0.]])
    >>> S.pose("1/3", 0).x
    Fraction(4, 3)
    """

    contact: VertexEdge | EdgeVertex
    p: ExactPoint
    q: ExactPoint
    a: ExactPoint
    g: ExactPoint

    @property
    def ruled(self) -> Floats:
        """p, q, a, g as doubles, (8,), like a row of `Boundary.ruled`."""
        return np.array([float(c) for point in (self.p, self.q, self.a, self.g) for c in point])

    def __call__(self, t: ArrayLike, phi: ArrayLike, *, beyond: bool = False) -> Floats:
        """Points (x, y, phi) at t and phi in radians, broadcast against each other: (..., 3).

        Parameters
        ----------
        t : (...) float, in [0, 1]
        phi : (...) float
            Any angles; points outside Phi, see `angle_range`, are on the surface, not on the patch.
        beyond : bool
            Allow any t: the edge is then extended to its line, as on e-e segments.

        Raises
        ------
        ValueError
            If a number is not finite, or t is outside [0, 1] and `beyond` is not set.
        """
        return evaluate(self.ruled, t, phi, beyond=beyond)

    @checked
    def grid(self, t: ArrayLike, phi: ArrayLike) -> Floats:
        """Positions at all pairs of t in [0, 1] and phi: (len(phi), len(t), 2). It is faster than a call.

        Examples
        --------
        >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
        >>> contact_surface(square, square, EdgeVertex(0, 2)).grid([0, 1], [0])
        array([[[2., 2.],
                [0., 2.]]])
        """
        t, phi = np.ascontiguousarray(_on_edge(t, False)), np.ascontiguousarray(finite("phi", phi))
        xy = np.empty((len(phi), len(t), 2))
        _core.evaluate_grid(self.ruled, t, phi, xy)
        return xy

    @checked
    def helix(self, t: Number, *, beyond: bool = False) -> Helix:
        """Return the curve phi -> S(t, phi), along which a point of the robot is fixed; t as in a call."""
        s = to_fraction(t)
        if not (beyond or 0 <= s <= 1):
            raise _not_on_edge(t)
        (px, py), (qx, qy), (ax, ay), (gx, gy) = self.p, self.q, self.a, self.g
        return Helix((px + s * qx, py + s * qy), (ax + s * gx, ay + s * gy))

    @checked
    def pose(self, t: Number, theta: Angle, *, beyond: bool = False) -> Pose:
        """Return the exact pose at t and theta, as in a call."""
        return self.helix(t, beyond=beyond).pose(theta)


def evaluate(ruled: Floats, t: ArrayLike, phi: ArrayLike, *, beyond: bool = False) -> Floats:
    """Points of the surface with the numbers p, q, a, g; see `Surface`."""
    t, phi = np.broadcast_arrays(_on_edge(t, beyond), finite("phi", phi))
    xy = np.empty((t.size, 2))
    _core.evaluate_points(ruled, np.ravel(t), np.ravel(phi), xy)
    return np.concatenate((xy.reshape(*t.shape, 2), phi[..., None]), axis=-1)


def _on_edge(t: ArrayLike, beyond: bool) -> Floats:
    t = finite("t", t)
    outside = np.ravel(t[(t < 0) | (t > 1)])
    if len(outside) and not beyond:
        raise _not_on_edge(float(outside[0]))
    return t


def _not_on_edge(t: Number) -> ValueError:
    return ValueError(f"t = {t}; the edge is [0, 1]: give beyond=True to mean its whole line")


@dataclass(frozen=True, slots=True)
class Helix:
    """Helix of all poses in which a point of the robot is at a point of the plane: Lemma 1, eq. (4).

    Attributes
    ----------
    centre : pair of Fraction
        P in the plane.
    fixed : pair of Fraction
        a in the robot's own coordinates; its length is the radius of the helix.

    Examples
    --------
    >>> helix = rotation_about((3, 0), (1, 0))
    >>> helix(0)
    array([2., 0., 0.])
    >>> helix.pose("180deg").x
    Fraction(4, 1)
    """

    centre: ExactPoint
    fixed: ExactPoint

    def __call__(self, phi: ArrayLike) -> Floats:
        """Points (P - R(phi) a, phi), phi in radians: (..., 3)."""
        phi = np.asarray(phi, dtype=np.float64)
        (px, py), (ax, ay) = (tuple(map(float, point)) for point in (self.centre, self.fixed))
        c, s = np.cos(phi), np.sin(phi)
        return np.stack((px - (c * ax - s * ay), py - (s * ax + c * ay), phi), axis=-1)

    @property
    def radius(self) -> float:
        """Distance of the fixed point from the robot's reference point."""
        return math.hypot(*map(float, self.fixed))

    @checked
    def curvature(self, *, angle_scale: float = 1.0) -> float:
        """Constant curvature r / (r^2 + w^2), in 1 / length; r is the radius, w the `angle_scale`, length per radian.

        Examples
        --------
        >>> helix = rotation_about((3, 0), (1, 0))
        >>> helix.curvature(), helix.torsion(), helix.length(0, 1) ** 2
        (0.5, 0.5, 2.0000000000000004)
        """
        return self.radius / self._square(angle_scale)

    @checked
    def torsion(self, *, angle_scale: float = 1.0) -> float:
        """Constant torsion w / (r^2 + w^2), in 1 / length, of a right-handed screw: it climbs as it turns to the left.

        On the axis, r = 0, the helix is a straight line without torsion; the value is then the limit.
        """
        return angle_scale / self._square(angle_scale)

    @checked
    def length(self, phi_from: float, phi_to: float, *, angle_scale: float = 1.0) -> float:
        """Length between two angles, (phi_to - phi_from) sqrt(r^2 + w^2); negative if the first is larger."""
        return (phi_to - phi_from) * math.sqrt(self._square(angle_scale))

    def _square(self, angle_scale: float) -> float:
        if not 0 < angle_scale < math.inf:
            raise ValueError(f"angle_scale: {angle_scale}; give a finite length per radian above 0")
        return self.radius**2 + angle_scale**2

    @checked
    def pose(self, theta: Angle) -> Pose:
        """Return the exact pose at theta."""
        turn = Pose(0, 0, theta)
        ((x, y),) = turn.apply_exact([self.fixed])
        return Pose(self.centre[0] - x, self.centre[1] - y) @ turn


@dataclass(frozen=True, slots=True)
class EdgeEdgeSegment:
    """Straight curve C(t) = S(t, phi) of an e-e contact, section 3.3.2, or of an e-e pseudo contact.

    Attributes
    ----------
    contact : EdgeEdge
    surface : Surface
        S of the v-e contact of the edge's first vertex.
    phi : float, radians
    t_range : (float, float)
        Closed range of t: see `contact_segment` and `edge_edge_surface`.
    """

    contact: EdgeEdge
    surface: Surface
    phi: float
    t_range: tuple[float, float]

    def __call__(self, t: ArrayLike) -> Floats:
        """Points (x, y, phi): (..., 3); any t, also beyond `t_range`."""
        return self.surface(t, self.phi, beyond=True)


@checked
def contact_surface(robot: Polygon, obstacle: Polygon, contact: VertexEdge | EdgeVertex) -> Surface:
    """Return the contact surface of a v-e contact, eq. (5), or of an e-v contact, eq. (8)."""
    i, j, zero = contact.i, contact.j, (Fraction(0), Fraction(0))
    p, a = obstacle.exact_vertices[j], robot.exact_vertices[i]
    if isinstance(contact, VertexEdge):
        return Surface(contact, p, obstacle.exact_edge(j), a, zero)
    return Surface(contact, p, zero, a, robot.exact_edge(i))


@checked
def contact_helix(robot: Polygon, obstacle: Polygon, contact: VertexVertex) -> Helix:
    """Return the helix of a v-v contact, section 3.3.1: a_i stays at b_j.

    Examples
    --------
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> contact_helix(square, square, VertexVertex(1, 2))(0)
    array([0., 2., 0.])
    """
    return Helix(obstacle.exact_vertices[contact.j], robot.exact_vertices[contact.i])


@checked
def contact_segment(robot: Polygon, obstacle: Polygon, contact: EdgeEdge) -> EdgeEdgeSegment:
    """Return the segment of an e-e contact, over its `t_range`; see `edge_edge_range`.

    Raises
    ------
    ValueError
        If the edges never touch along a length, because of reflex vertices.

    Examples
    --------
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> top = contact_segment(square, square, EdgeEdge(0, 2))
    >>> top(top.t_range)
    array([[ 2.,  2.,  0.],
           [-2.,  2.,  0.]])
    """
    t_range = edge_edge_range(robot, obstacle, contact)
    if t_range is None:
        raise ValueError(f"{contact} has no segment: reflex vertices keep the edges apart; see contact_curves()")
    phi = angle_range(robot, obstacle, contact).phi_min
    return EdgeEdgeSegment(contact, contact_surface(robot, obstacle, VertexEdge(contact.i, contact.j)), phi, t_range)


@checked
def edge_edge_surface(robot: Polygon, obstacle: Polygon, contact: EdgeEdge) -> tuple[EdgeEdgeSegment, EdgeEdgeSegment]:
    """Return the contact surface of an e-e pair, Definition 1: its two segments, contact or only pseudo contact.

    Returns
    -------
    pair of EdgeEdgeSegment
        The edges have opposite directions in the first, at phi_min, and the same direction in the second, at
        phi_min + pi, where all poses are forbidden. Inside `t_range` they share more than a point, at its ends a point.

    Notes
    -----
    Let L be the length of E_i over that of E_j. On the obstacle's line, its edge covers [0, 1]; the robot's edge covers
    [t - L, t] at phi_min, and [t, t + L] at phi_min + pi. So t is in [0, 1 + L], or in [-L, 1]. Reflex vertices do not
    matter for pseudo contacts.

    Examples
    --------
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> against, alongside = edge_edge_surface(square, square, EdgeEdge(0, 2))
    >>> against.phi, against.t_range, alongside.t_range
    (0.0, (0.0, 2.0), (-1.0, 1.0))
    >>> alongside(alongside.t_range).round(9)
    array([[4.        , 2.        , 3.14159265],
           [0.        , 2.        , 3.14159265]])
    """
    c, s = direction_against(robot, obstacle, contact)
    L = math.hypot(*robot.edge(contact.i)) / math.hypot(*obstacle.edge(contact.j))
    S = contact_surface(robot, obstacle, VertexEdge(contact.i, contact.j))
    against, alongside = (float(normalize_angles(angle(*direction))) for direction in ((c, s), (-c, -s)))
    return EdgeEdgeSegment(contact, S, against, (0.0, 1 + L)), EdgeEdgeSegment(contact, S, alongside, (-L, 1.0))


@checked
def rotation_about(centre: Sequence[Number], fixed: Sequence[Number]) -> Helix:
    """Return the helix of rotations that keep a point of the robot, in its own coordinates, at a centre: Lemma 1."""
    (px, py), (ax, ay) = centre, fixed
    return Helix((to_fraction(px), to_fraction(py)), (to_fraction(ax), to_fraction(ay)))


@checked
def helix_through(pose: PoseLike, fixed: Sequence[Number]) -> Helix:
    """Return the helix through a pose that keeps a point of the robot, in its own coordinates, fixed: Remark 2.

    Notes
    -----
    Different points give different helices, and every helix through the pose has such a point. Their tangents are
    (-J R a, 1): every direction except the horizontal ones, each once.

    Examples
    --------
    >>> q = Pose(1, 2, "90deg")
    >>> helix = helix_through(q, (3, 0))
    >>> helix.centre, helix.pose("90deg") == q
    ((Fraction(1, 1), Fraction(5, 1)), True)
    """
    pose = to_pose(pose, "pose")
    x, y = fixed
    a = to_fraction(x), to_fraction(y)
    (P,) = pose.apply_exact([a])
    return Helix(P, a)


@checked
def rotation_of_combination(
    centre: Sequence[Number], points: Iterable[Sequence[Number]], weights: Iterable[Number]
) -> Helix:
    """Return the helix of poses in which a linear combination of robot points is at a centre: Remark 2.

    Raises
    ------
    ValueError
        If the weights add up to zero: the combination is then a vector that turns but never moves. The condition
        leaves the position free, and the poses form no helix.

    Notes
    -----
    Let a = sum lambda_k a_k and sigma = sum lambda_k. The combination of the moved points is sigma r + R(theta) a; it
    is at P on the helix of the point a / sigma about P / sigma.

    Examples
    --------
    >>> rotation_of_combination((2, 2), [(0, 0), (4, 0)], [1, 1])
    Helix(centre=(Fraction(1, 1), Fraction(1, 1)), fixed=(Fraction(2, 1), Fraction(0, 1)))
    """
    rows = [(to_fraction(w), to_fraction(x), to_fraction(y)) for w, (x, y) in zip(weights, points, strict=True)]
    sigma = sum((w for w, _, _ in rows), Fraction(0))
    if sigma == 0:
        raise ValueError("the weights add up to 0, which fixes no point; give weights with another sum")
    px, py = (to_fraction(c) / sigma for c in centre)
    return Helix((px, py), (sum(w * x for w, x, _ in rows) / sigma, sum(w * y for w, _, y in rows) / sigma))
