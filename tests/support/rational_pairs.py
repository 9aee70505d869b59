"""Pairs of polygons, and contacts of the rational model placed by the paper's matrix, entry by entry."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

import strategies
from cfree.contact.contact import (
    Contact,
    EdgeEdge,
    VertexVertex,
)
from cfree.polygons.polygon import Polygon
from cfree.rational.model import (
    RationalHelix,
    RationalPoint,
    RationalSegment,
    RationalSurface,
    rational_helix,
    rational_segment,
    rational_surface,
)
from shapes import Shape

SQUARE = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
L_SHAPE = Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
TRIANGLE = Polygon([(-1, -1), (3, -1), (0, 2)])
pairs = st.tuples(strategies.polygons(), strategies.polygons())
convex_pairs = st.tuples(strategies.convex_polygons(), strategies.convex_polygons())
inner = st.fractions(Fraction(1, 9), Fraction(8, 9), max_denominator=9)
ts = st.fractions(0, 1, max_denominator=12)
taus = strategies.half_tangents() | st.fractions(max_denominator=10**6)
Vec = tuple[Fraction, Fraction]


def polygons(shapes: tuple[Shape, Shape]) -> tuple[Polygon, Polygon]:
    return Polygon(*shapes[0]), Polygon(*shapes[1])


def M(tau: Fraction | None, a: Vec) -> Vec:
    """The paper's matrix, entry by entry."""
    if tau is None:
        return -a[0], -a[1]
    w = 1 + tau * tau
    return ((1 - tau * tau) * a[0] - 2 * tau * a[1]) / w, (2 * tau * a[0] + (1 - tau * tau) * a[1]) / w


def placed(q: RationalPoint, a: Vec) -> Vec:
    """a(q) = r + M(tau) a."""
    x, y = M(q[2], a)
    return q[0] + x, q[1] + y


def between(p: Vec, q: Vec, t: Fraction) -> Vec:
    return (1 - t) * p[0] + t * q[0], (1 - t) * p[1] + t * q[1]


def of(A: Polygon, O: Polygon, contact: Contact) -> RationalSurface | RationalHelix | RationalSegment:
    match contact:
        case VertexVertex():
            return rational_helix(A, O, contact)
        case EdgeEdge():
            return rational_segment(A, O, contact)
        case _:
            return rational_surface(A, O, contact)
