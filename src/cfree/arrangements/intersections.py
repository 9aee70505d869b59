"""Intersection of two contact surfaces before any trimming: a curve, lines of one orientation, or a whole surface.

At an orientation a contact surface is a line, P + t U (`moving_lines`). With D = U_1 x U_2, two lines meet at

    t_1 = (P_2 - P_1) x U_2 / D,    t_2 = (P_2 - P_1) x U_1 / D

unless they are parallel, D = 0: then they are disjoint or equal. D is constant for two surfaces of one kind; for a v-e
and an e-v surface it is 0 at two opposite orientations. If the lines are equal at an orientation, the surfaces share a
line of theta = constant, and only there they can be tangent.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from cfree.arguments import checked
from cfree.arrangements.curve import IntersectionCurve, curve_on
from cfree.arrangements.moving_lines import AnySurface, MovingLine, between, cross, dot, moving_lines, whole
from cfree.arrangements.ranges import is_on_patches, ranges_of, ranges_on
from cfree.contact.surface import Surface
from cfree.exact.algebraic import Exact, ratio, rounded
from cfree.exact.angle_interval import AlgebraicAngle, AngleInterval
from cfree.exact.forms import ZERO_ANGLE, common_factor, quotient, value_at, zeros
from cfree.rational.model import RationalSurface
from cfree.words import counted


@dataclass(frozen=True, slots=True)
class SharedLine:
    """An orientation at which surfaces have their whole lines in common.

    Attributes
    ----------
    angle : AlgebraicAngle
    multiplicity : int
        2 if two surfaces are tangent along the whole line, which parallel ones can be; else 1.
    t_range : (float, float) or None
        Common part of the edges, or of the patches, as t on the first surface; None, decided exactly, if it is empty.
    tangency : (float, float) or None
        x and y of the only pose on the line at which two surfaces are tangent: their curve crosses the line there. None
        for parallel surfaces, and for three.
    """

    angle: AlgebraicAngle
    multiplicity: int
    t_range: tuple[float, float] | None
    tangency: tuple[float, float] | None


@dataclass(frozen=True, slots=True, repr=False)
class Intersection:
    """Intersection of two contact surfaces; edges count as lines, except in `ranges`, `t_range` and `overlap`.

    Attributes
    ----------
    surfaces : pair of Surface or RationalSurface
        The arguments; only the patch of a `RationalSurface` counts in `ranges`, `t_range` and `overlap`.
    relation : {"curve", "parallel", "identical"}
        Parallel: the lines are parallel at every orientation, so the surfaces share lines or nothing. Identical: they
        are one surface.
    curve : IntersectionCurve or None
    ranges : tuple of AngleInterval
        Closed intervals on which the curve, or the overlap, is on both surfaces, t in [0, 1], from theta = 0 on. An
        interval may be a single orientation.
    lines : tuple of SharedLine
        Shared lines from theta = 0 on.
    overlap : pair of Fraction, or None
        Common part of the edges of identical surfaces, as t on the first.

    Examples
    --------
    >>> from cfree import Polygon
    >>> from cfree.contact import EdgeVertex, VertexEdge, contact_surface
    >>> robot, obstacle = Polygon([(0, 0), (2, 0), (0, 1)]), Polygon([(3, 1), (6, 1), (6, 4), (3, 4)])
    >>> ve, ev = (contact_surface(robot, obstacle, c) for c in (VertexEdge(1, 0), EdgeVertex(2, 0)))
    >>> meeting = intersection(ve, ev)
    >>> meeting.relation, meeting.curve.degree, [part.theta for part in meeting.ranges]
    ('curve', 4, [(0.0, 0.4636476090008061)])
    >>> [line.angle.theta for line in meeting.lines]                                    # theta = 90 and 270 degrees
    []
    """

    surfaces: tuple[AnySurface, AnySurface]
    relation: Literal["curve", "parallel", "identical"]
    curve: IntersectionCurve | None = None
    ranges: tuple[AngleInterval, ...] = ()
    lines: tuple[SharedLine, ...] = ()
    overlap: tuple[Fraction, Fraction] | None = None

    def __repr__(self) -> str:
        return (
            f"<Intersection: {self.relation}, {counted(len(self.ranges), 'range')}, {counted(len(self.lines), 'line')}>"
        )

    @property
    def is_empty(self) -> bool:
        """True if the surfaces have nothing in common, even with edges extended to lines."""
        return self.relation == "parallel" and not self.lines


@checked
def intersection(first: Surface | RationalSurface, second: Surface | RationalSurface) -> Intersection:
    """Intersect two contact surfaces, of one robot and any obstacles, before any trimming.

    Parameters
    ----------
    first, second : Surface or RationalSurface
        v-e or e-v. A `Surface` stands for all its pseudo contacts, a `RationalSurface` for its patch.

    Notes
    -----
    The result is exact. Its time depends only on the length of the numbers. See the theory's page on intersections.

    Examples
    --------
    >>> from cfree import Polygon
    >>> from cfree.contact import VertexEdge, contact_surface
    >>> robot, box = Polygon([(-1, 0), (1, 0), (0, 2)]), Polygon([(0, 0), (9, 0), (9, 2), (0, 2)])
    >>> bottom, top, right = (contact_surface(robot, box, VertexEdge(i, j)) for i, j in ((0, 0), (1, 2), (1, 1)))
    >>> parallel = intersection(bottom, top)
    >>> parallel.relation, [(line.angle.theta, line.multiplicity) for line in parallel.lines]   # 2 high: upright
    ('parallel', [(1.5707963267948966, 2)])
    >>> intersection(bottom, right).curve.degree
    2
    >>> intersection(bottom, bottom).relation
    'identical'
    """
    lines = moving_lines((first, second))
    one, other = lines
    to_other, D = between(one.P, other.P), cross(one.U, other.U)
    gap = cross(to_other, one.U)
    surfaces = first, second
    if any(D):
        T = cross(to_other, other.U)
        shared = common_factor((T, D))
        curve = curve_on(one, quotient(T, shared), quotient(D, shared), whole(first).p)
        coincident = tuple(shared_line(angle, 1, lines, curve) for angle, _ in zeros(shared))
        return Intersection(surfaces, "curve", curve, ranges_on(curve, lines), coincident)
    if any(gap):
        coincident = tuple(shared_line(angle, times, lines) for angle, times in zeros(gap))
        return Intersection(surfaces, "parallel", lines=coincident)
    overlap = overlap_at(lines, ZERO_ANGLE)
    return Intersection(surfaces, "identical", None, ranges_of(lines) if overlap else (), overlap=overlap)


def shared_line(
    angle: AlgebraicAngle, multiplicity: int, lines: Sequence[MovingLine], curve: IntersectionCurve | None = None
) -> SharedLine:
    """Common part of lines that are equal at an orientation."""
    overlap = overlap_at(lines, angle) if is_on_patches(lines, angle) else None
    t_range = (rounded(overlap[0]), rounded(overlap[1])) if overlap else None
    return SharedLine(angle, multiplicity, t_range, curve.rounded(angle) if curve else None)


def overlap_at(lines: Sequence[MovingLine], angle: AlgebraicAngle) -> tuple[Exact, Exact] | None:
    """Common part of edges, as t on the first, at an orientation at which their lines are equal."""
    first, *others = lines
    low, high = Fraction(0), Fraction(1)
    for other in others:
        to_start = between(first.P, other.P)
        U2, start, along = (value_at(dot(first.U, v), angle) for v in (first.U, to_start, other.U))
        ends = ratio(start, U2), ratio(start + along, U2)
        low, high = max(low, min(ends)), min(high, max(ends))
    return (low, high) if low <= high else None
