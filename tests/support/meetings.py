"""Contact surfaces of one robot and several obstacles, and their lines by the paper's matrix, entry by entry."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

import shapes
import strategies
from cfree.contact.contact import EdgeVertex, VertexEdge
from cfree.contact.surface import Surface, contact_surface
from cfree.polygons.polygon import Polygon
from rational_pairs import M, Vec

Line = tuple[Vec, Vec]
LARGE, THIRD, TINY = Fraction(10**9), Fraction(1, 3), Fraction(7, 10**12)


def line_at(surface: Surface, tau: Fraction | None) -> Line:
    """Point and vector: the reference point for t = 0, and its displacement until t = 1."""
    (px, py), (qx, qy) = surface.p, surface.q
    (ax, ay), (gx, gy) = M(tau, surface.a), M(tau, surface.g)
    return (px - ax, py - ay), (qx - gx, qy - gy)


def cross(u: Vec, v: Vec) -> Fraction:
    return u[0] * v[1] - u[1] * v[0]


def difference(p: Vec, q: Vec) -> Vec:
    return p[0] - q[0], p[1] - q[1]


def parameter(line: Line, point: Vec) -> Fraction | None:
    """Parameter t of a point, None if it is not on the line."""
    P, U = line
    offset = difference(point, P)
    if cross(offset, U):
        return None
    return (offset[0] * U[0] + offset[1] * U[1]) / (U[0] ** 2 + U[1] ** 2)


def crossing(one: Line, other: Line) -> Vec | None:
    """Point where two lines meet; None if they are parallel."""
    D = cross(one[1], other[1])
    if D == 0:
        return None
    t = cross(difference(other[0], one[0]), other[1]) / D
    return one[0][0] + t * one[1][0], one[0][1] + t * one[1][1]


@st.composite
def surfaces(draw: st.DrawFn, count: int) -> tuple[Surface, ...]:
    """Draw surfaces of small shapes: parallel edges, shared vertices, congruent; some far away or with long numbers."""
    robot = draw(strategies.polygons())
    others = [draw(st.one_of(st.just(robot), strategies.polygons())) for _ in range(draw(st.integers(1, 2)))]
    offset, scale = draw(st.sampled_from([(Fraction(0), Fraction(1)), (LARGE, Fraction(1)), (THIRD, TINY)]))
    A = Polygon(*robot)
    drawn = []
    for _ in range(count):
        O = Polygon(*shapes.moved(shapes.scaled(draw(st.sampled_from(others)), scale), offset, -offset))
        kind = draw(st.sampled_from((VertexEdge, EdgeVertex)))
        contact = kind(draw(st.integers(0, len(A) - 1)), draw(st.integers(0, len(O) - 1)))
        drawn.append(contact_surface(A, O, contact))
    return tuple(drawn)
