"""Contact types of a robot A and an obstacle O, and the orientations at which each occurs.

Paper, sections 1.2, 3.1.1, 3.2.1 and 3.3. The robot's feature comes first: `VertexEdge(i, j)` is a_i on E_j.

All orientations follow from directions alone. If R(phi) u = -w up to length, the direction (cos phi, sin phi) is
-(u.w, u x w) up to length: exact, no arccosine, no case table.

    v-e  from E_i against E_j     to E_{i-1} against E_j      width pi - rho_i
    e-v  from E_i against E_{j-1} to E_i against E_j          width pi - omega_j
    v-v  from E_i against E_{j-1} to E_{i-1} against E_j      width 2 pi - rho_i - omega_j, where positive
    e-e  E_i against E_j

These hold at convex vertices of any ring; at a reflex vertex there is no v-e or e-v patch.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from cfree.arguments import checked
from cfree.exact.half_angle import normalize_angles
from cfree.exact.number import IntPoint, angle
from cfree.exact.orientation import (
    Location,
    Order,
    Orientation,
    Vector,
    compare_directions,
    compare_lengths,
    locate_in_sector,
    turn,
)
from cfree.polygons.polygon import Polygon


@checked
@dataclass(frozen=True, slots=True, order=True)
class VertexEdge:
    """Vertex a_i of the robot on edge E_j of the obstacle."""

    i: int
    j: int


@checked
@dataclass(frozen=True, slots=True, order=True)
class EdgeVertex:
    """Edge E_i of the robot on vertex b_j of the obstacle."""

    i: int
    j: int


@checked
@dataclass(frozen=True, slots=True, order=True)
class VertexVertex:
    """Vertex a_i of the robot at vertex b_j of the obstacle."""

    i: int
    j: int


@checked
@dataclass(frozen=True, slots=True, order=True)
class EdgeEdge:
    """Edge E_i of the robot along edge E_j of the obstacle."""

    i: int
    j: int


Contact = VertexEdge | EdgeVertex | VertexVertex | EdgeEdge


@dataclass(frozen=True, slots=True)
class AngleRange:
    """Closed range of orientations at which a contact type is a true contact, not only a pseudo contact.

    Attributes
    ----------
    phi_min : float, radians
        Start, in [0, 2 pi).
    phi_range : float, radians
        Width, 0 for an e-e contact.
    start, end : pair of int
        Exact directions of (cos, sin) of both ends.
    """

    phi_min: float
    phi_range: float
    start: IntPoint
    end: IntPoint

    @property
    def phi_max(self) -> float:
        """phi_min + phi_range, in radians; it may exceed 2 pi."""
        return self.phi_min + self.phi_range

    @property
    def domain(self) -> tuple[tuple[float, float], ...]:
        """Phi of eq. (6): one interval of [0, 2 pi), or two if the range passes 0, the first of them half open.

        Examples
        --------
        >>> AngleRange(6.0, 0.5, (1, 0), (0, 1)).domain == ((6.0, 2 * math.pi), (0.0, 6.5 - 2 * math.pi))
        True
        """
        if self.phi_max < 2 * math.pi:
            return ((self.phi_min, self.phi_max),)
        return ((self.phi_min, 2 * math.pi), (0.0, self.phi_max - 2 * math.pi))

    @checked
    def locate(self, direction: Vector) -> Location:
        """Location of the direction (cos phi, sin phi), exact up to length: inside the range, at an end or outside."""
        if self.phi_range == 0:
            is_end = compare_directions(self.start, direction) is Order.SAME
            return Location.BOUNDARY if is_end else Location.OUTSIDE
        return locate_in_sector(direction, self.start, self.end)


@checked
def contacts(robot: Polygon, obstacle: Polygon) -> tuple[VertexEdge | EdgeVertex, ...]:
    """All v-e and e-v pairs that have a contact patch, which are the pairs at convex vertices.

    Examples
    --------
    >>> triangle = Polygon([(0, 0), (1, 0), (0, 1)])
    >>> len(contacts(triangle, triangle))
    18
    """
    n, m = range(len(robot)), range(len(obstacle))
    return (
        *(VertexEdge(i, j) for i in n if robot.convex[i] for j in m),
        *(EdgeVertex(i, j) for i in n for j in m if obstacle.convex[j]),
    )


@checked
def contact_curves(robot: Polygon, obstacle: Polygon) -> tuple[VertexVertex | EdgeEdge, ...]:
    """All v-v pairs that have a helix and all e-e pairs that have a segment.

    Examples
    --------
    >>> triangle = Polygon([(0, 0), (1, 0), (0, 1)])
    >>> len(contact_curves(triangle, triangle))
    18
    """
    pairs = [(i, j) for i in range(len(robot)) for j in range(len(obstacle))]
    return (
        *(v for i, j in pairs if _occurs(robot, obstacle, v := VertexVertex(i, j))),
        *(e for i, j in pairs if edge_edge_range(robot, obstacle, e := EdgeEdge(i, j))),
    )


@checked
def angle_range(robot: Polygon, obstacle: Polygon, contact: Contact) -> AngleRange:
    """Range of orientations at which a contact type is a contact.

    Parameters
    ----------
    robot, obstacle : Polygon
    contact : VertexEdge, EdgeVertex, VertexVertex or EdgeEdge

    Raises
    ------
    ValueError
        If there is none: a v-e or e-v contact at a reflex vertex, or a v-v contact with
        2 pi - rho_i - omega_j <= 0.
    IndexError
        If a polygon has no such vertex or edge.

    Notes
    -----
    Sections 3.1.1, 3.2.1, 3.3.1 and 3.3.2; see the table at the top of this file.

    Examples
    --------
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> angle_range(square, square, VertexEdge(0, 0)).domain == ((math.pi, 1.5 * math.pi),)
    True
    """
    start, end = end_directions(robot, obstacle, contact)
    phi_min, phi_range = normalize_angles(angle(*start)), _angle_between(start, end) % (2 * math.pi)
    return AngleRange(float(phi_min), phi_range, start, end)


def end_directions(robot: Polygon, obstacle: Polygon, contact: Contact) -> tuple[IntPoint, IntPoint]:
    """Exact directions (cos, sin), up to length, of phi_min and phi_max; they are equal for an e-e contact only.

    Raises
    ------
    ValueError
        If the contact type is never a contact, as in `angle_range`.
    IndexError
        If a polygon has no such vertex or edge.

    Notes
    -----
    They are sums of products of the input. So is the solution (x_0, y_0) of eq. (7), except for one square root: no
    function of an angle occurs (Remark 4).

    Examples
    --------
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> end_directions(square, square, VertexEdge(0, 0))
    ((-1, 0), (0, -1))
    """
    _check_indices(robot, obstacle, contact)
    if not _occurs(robot, obstacle, contact):
        raise ValueError(f"{contact} is never a contact: its corners leave no angle; see contacts()")
    return _ends(robot, obstacle, contact)


@checked
def edge_edge_range(robot: Polygon, obstacle: Polygon, contact: EdgeEdge) -> tuple[float, float] | None:
    """Closed range of t on the segment C(t) of an e-e contact, None if it is empty.

    Raises
    ------
    IndexError
        If a polygon has no such edge.

    Notes
    -----
    Section 3.3.2: with L the length of E_i over that of E_j, a_i is at b_j + t E_j and a_{i+1} at b_j + (t - L) E_j.
    The edges overlap for 0 < t < 1 + L; beyond a reflex end vertex the interiors do.

    Examples
    --------
    >>> square, double = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> edge_edge_range(double, square, EdgeEdge(0, 0))
    (0.0, 3.0)
    """
    _check_indices(robot, obstacle, contact)
    i, j = contact.i, contact.j
    from_a, from_b = not robot.convex[i], not obstacle.convex[j]
    to_a, to_b = not robot.convex[robot.next[i]], not obstacle.convex[obstacle.next[j]]
    u, v = robot.edge_numerators[i], obstacle.edge_numerators[j]
    d, e = robot.denominator, obstacle.denominator
    order = compare_lengths((u[0] * e, u[1] * e), (v[0] * d, v[1] * d))  # L compared with 1
    if (
        (from_a and to_b)
        or (from_b and to_a)
        or (from_a and to_a and order is not Order.AFTER)
        or (from_b and to_b and order is not Order.BEFORE)
    ):
        return None
    L = math.hypot(*robot.edge(i)) / math.hypot(*obstacle.edge(j))
    low = max(1.0 if from_a else 0.0, L if from_b else 0.0)
    return low, min(L if to_a else 1 + L, 1.0 if to_b else 1 + L)


def direction_against(robot: Polygon, obstacle: Polygon, contact: EdgeEdge) -> IntPoint:
    """Exact direction (cos, sin), up to length, in which two edges run against each other, in contact or not."""
    return _against(robot.edge_numerators[contact.i], obstacle.edge_numerators[contact.j])


def _check_indices(robot: Polygon, obstacle: Polygon, contact: Contact) -> None:
    for name, polygon, k in (("robot", robot, contact.i), ("obstacle", obstacle, contact.j)):
        count = len(polygon.convex)
        if not 0 <= k < count:
            raise IndexError(f"{contact}: the {name} has {count} vertices and edges; count from 0 to {count - 1}")


def _occurs(robot: Polygon, obstacle: Polygon, contact: Contact) -> bool:
    """True if the contact type is a contact at some orientation."""
    rho_is_convex, omega_is_convex = bool(robot.convex[contact.i]), bool(obstacle.convex[contact.j])
    match contact:
        case VertexEdge():
            return rho_is_convex
        case EdgeVertex():
            return omega_is_convex
        case VertexVertex():
            # beside a reflex vertex, the width is below pi: positive if the end is left of the start
            if rho_is_convex and omega_is_convex:
                return True
            left = turn(*_ends(robot, obstacle, contact)) is Orientation.LEFT
            return (rho_is_convex or omega_is_convex) and left
        case EdgeEdge():
            return edge_edge_range(robot, obstacle, contact) is not None


def _ends(robot: Polygon, obstacle: Polygon, contact: Contact) -> tuple[IntPoint, IntPoint]:
    """Directions of phi_min and phi_max."""
    i, j = contact.i, contact.j
    EA, EO = robot.edge_numerators, obstacle.edge_numerators
    before_i = i if isinstance(contact, EdgeVertex | EdgeEdge) else int(robot.previous[i])
    before_j = j if isinstance(contact, VertexEdge | EdgeEdge) else int(obstacle.previous[j])
    return _against(EA[i], EO[before_j]), _against(EA[before_i], EO[j])


def _against(u: IntPoint, w: IntPoint) -> IntPoint:
    """Direction (cos phi, sin phi) of the rotation that brings u to the direction of -w."""
    return -(u[0] * w[0] + u[1] * w[1]), -(u[0] * w[1] - u[1] * w[0])


def _angle_between(u: IntPoint, v: IntPoint) -> float:
    """Angle from u to v, in (-pi, pi]."""
    return angle(u[0] * v[0] + u[1] * v[1], u[0] * v[1] - u[1] * v[0])
