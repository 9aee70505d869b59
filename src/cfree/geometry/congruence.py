"""Congruent helices, contact surfaces and contact patches of a pair: Remark 3, decided exactly.

Two sets in C = R^2 x S^1 are *congruent* if an isometry of C carries one onto the other. Isometries of C move the plane
and the circle: (x, theta) -> (M x + m, sigma theta + c), M orthogonal, sigma = 1 or -1. One that carries a helix
P - R(phi) a with a != 0 onto such a helix has det M = sigma, since M R(phi) = R(det M phi) M. So, for any length of a
radian, helices keep their radius |a|, rulings their length, angle ranges their width. It remains to compare

    v-v helix     |a_i|^2
    v-e surface   |E_j|^2 and |a_i|^2
    e-v surface   |E_i|^2 and the set of |a_i|^2 and |a_{i+1}|^2
    v-v arc       |a_i|^2 and the width 2 pi - rho_i - omega_j
    v-e patch     |E_j|^2, |a_i|^2, the width pi - rho_i, and cos 2 beta
    e-v patch     as the surface, and the width pi - omega_j

beta is the angle between a_i and the bisector of the robot's corner there. In the middle of the range the bisector is
normal to E_j; an isometry may change only the side on which a_i is, and the end of E_j. Cosines are stored as their
squares with their signs, so that every entry is rational in the input.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import TypeVar

from cfree.arguments import checked
from cfree.contact.contact import EdgeVertex, VertexEdge, VertexVertex, angle_range, contact_curves, contacts
from cfree.exact.number import ExactPoint
from cfree.exact.vectors import dot
from cfree.polygons.polygon import Polygon

Key = tuple[object, ...]
C = TypeVar("C", VertexEdge | EdgeVertex, VertexVertex)


@checked
def surface_classes(robot: Polygon, obstacle: Polygon) -> tuple[tuple[VertexEdge | EdgeVertex, ...], ...]:
    """Classes of congruent contact surfaces, t in [0, 1] and all orientations, reflex vertices included.

    Returns
    -------
    tuple of tuples of contacts
        Contacts of a class are in the order of `contacts`, and so are the classes, by their first contact.

    Notes
    -----
    Exact; time and memory are linear in the number of contacts.

    Examples
    --------
    A vertex of the robot slides along the four edges of a square in the same way. Two squares, the robot's reference
    point in its middle, have two classes: v-e and e-v.

    >>> square = Polygon([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    >>> [len(members) for members in surface_classes(square, square)]
    [16, 16]
    >>> [len(members) for members in surface_classes(Polygon([(0, 0), (2, 0), (2, 2), (0, 2)]), square)]
    [4, 8, 4, 8, 8]
    """
    pairs = [(i, j) for i in range(len(robot)) for j in range(len(obstacle))]
    every: list[VertexEdge | EdgeVertex] = [VertexEdge(i, j) for i, j in pairs]
    every += [EdgeVertex(i, j) for i, j in pairs]
    return _classes(every, lambda contact: _surface_key(robot, obstacle, contact))


@checked
def patch_classes(robot: Polygon, obstacle: Polygon) -> tuple[tuple[VertexEdge | EdgeVertex, ...], ...]:
    """Classes of congruent contact patches, of the contacts that have one; see `surface_classes`.

    Examples
    --------
    >>> square, box = Polygon([(-1, -1), (1, -1), (1, 1), (-1, 1)]), Polygon([(-2, -1), (2, -1), (2, 1), (-2, 1)])
    >>> [len(members) for members in patch_classes(square, box)]
    [8, 8, 16]
    """
    return _classes(contacts(robot, obstacle), lambda contact: _patch_key(robot, obstacle, contact))


@checked
def helix_classes(robot: Polygon, obstacle: Polygon) -> tuple[tuple[VertexVertex, ...], ...]:
    """Classes of congruent v-v helices, all orientations, of all pairs of vertices; see `surface_classes`.

    Notes
    -----
    Every helix on a v-e surface of a_i is in the class of a_i's v-v helices. On an e-v surface the helices at t and t'
    are congruent only if t + t' = 2 t_*: Remark 5.

    Examples
    --------
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> [len(members) for members in helix_classes(square, square)]
    [4, 8, 4]
    """
    every = [VertexVertex(i, j) for i in range(len(robot)) for j in range(len(obstacle))]
    return _classes(every, lambda contact: (_square(robot.exact_vertices[contact.i]),))


@checked
def arc_classes(robot: Polygon, obstacle: Polygon) -> tuple[tuple[VertexVertex, ...], ...]:
    """Classes of congruent arcs of v-v helices on which there is contact; see `surface_classes`.

    Examples
    --------
    >>> square = Polygon([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    >>> [len(members) for members in arc_classes(square, square)]
    [16]
    """
    arcs = [curve for curve in contact_curves(robot, obstacle) if isinstance(curve, VertexVertex)]
    return _classes(arcs, lambda arc: (_square(robot.exact_vertices[arc.i]), *_width_key(robot, obstacle, arc)))


def _classes(members: Iterable[C], key: Callable[[C], Key]) -> tuple[tuple[C, ...], ...]:
    classes: dict[Key, list[C]] = {}
    for member in members:
        classes.setdefault(key(member), []).append(member)
    return tuple(map(tuple, classes.values()))


def _surface_key(robot: Polygon, obstacle: Polygon, contact: VertexEdge | EdgeVertex) -> Key:
    i, j, a = contact.i, contact.j, robot.exact_vertices
    if isinstance(contact, VertexEdge):
        return VertexEdge, _square(obstacle.exact_edge(j)), _square(a[i])
    radii = sorted((_square(a[i]), _square(a[int(robot.next[i])])))
    return EdgeVertex, _square(robot.exact_edge(i)), *radii


def _patch_key(robot: Polygon, obstacle: Polygon, contact: VertexEdge | EdgeVertex) -> Key:
    key = *_surface_key(robot, obstacle, contact), *_width_key(robot, obstacle, contact)
    if isinstance(contact, EdgeVertex):
        return key
    # 2 beta: from the product of both edges, reversed, to the square of a_i, all as complex numbers
    i, a = contact.i, robot.exact_vertices[contact.i]
    u, v = robot.exact_edge(i), robot.exact_edge(int(robot.previous[i]))
    return *key, _signed_square(-dot(_product(a, a), _product(u, v)), _square(u) * _square(v))


def _width_key(robot: Polygon, obstacle: Polygon, contact: VertexEdge | EdgeVertex | VertexVertex) -> Key:
    """Key of the width, below 2 pi, of the contact's angle range: its cosine, and True if it is above pi."""
    r = angle_range(robot, obstacle, contact)
    (ux, uy), (vx, vy) = r.start, r.end
    squares = Fraction((ux * ux + uy * uy) * (vx * vx + vy * vy))
    return _signed_square(Fraction(ux * vx + uy * vy), squares), ux * vy < uy * vx


def _signed_square(value: Fraction, squares: Fraction) -> Fraction:
    """Square of value / sqrt(squares), with the sign of value."""
    return value * abs(value) / squares


def _square(u: ExactPoint) -> Fraction:
    return dot(u, u)


def _product(u: ExactPoint, v: ExactPoint) -> ExactPoint:
    """Product as complex numbers."""
    return u[0] * v[0] - u[1] * v[1], u[0] * v[1] + u[1] * v[0]
