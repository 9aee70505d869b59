"""Properties of contact surfaces that follow from their rulings: developable, minimal, striction, distribution.

Paper, section 4 with Lemma 3. The rulings of an e-v surface turn with phi, all at the same rate. They come closest at
the robot's point a + t g nearest to the reference point: t_* = -a.g / |g|^2. The rulings of a v-e surface are parallel.
Predicates are decided exactly, on the surface's fractions. All functions concern the surface, any t and phi, unless
their name has "patch".
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from cfree.arguments import checked
from cfree.contact.arcs import ArcArcSurface, OffsetSurface
from cfree.contact.surface import Helix, Surface
from cfree.geometry.ruled import Floats, check_scale, read_ruled

AnySurface = Surface | OffsetSurface | ArcArcSurface


@checked
def is_developable(surface: AnySurface) -> bool:
    """True if the Gaussian curvature is 0 everywhere: on v-e surfaces, which are cylinders, never on e-v surfaces.

    Offsets change nothing. The surface of an arc on an arc is a cylinder if the robot's arc is about the reference
    point, else not developable.

    Examples
    --------
    >>> from cfree.contact import EdgeVertex, VertexEdge, contact_surface
    >>> from cfree import Polygon
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> [is_developable(contact_surface(square, square, contact)) for contact in (VertexEdge(0, 0), EdgeVertex(0, 0))]
    [True, False]
    """
    if isinstance(surface, ArcArcSurface):
        return not any(surface.a)
    return not any((surface.core if isinstance(surface, OffsetSurface) else surface).g)


@checked
def is_helicoid(surface: AnySurface) -> bool:
    """True if it is an e-v surface whose robot edge lies on a line through the reference point, decided exactly.

    Notes
    -----
    Then S(t, phi) = (b_j - s R(phi) u, phi) is a right helicoid, with a unit vector u and the position s along that
    line. No other e-v surface is a helicoid, since it is not minimal.
    """
    return not is_developable(surface) and is_minimal(surface)


@checked
def is_minimal(surface: AnySurface) -> bool:
    """True if the mean curvature is 0 everywhere, decided exactly.

    Notes
    -----
    Lemma 3, as "if and only if". On an e-v surface H = w E F / (2 v^3) is 0 somewhere only if F = det(a_i, a_{i+1}) is
    0, and then everywhere. On a v-e surface H = -w E F / (2 v^3) with F = q x R(phi) a: it is 0 everywhere only if a_i
    is the reference point, and the surface then lies in a plane. The surface of an arc on an arc is never minimal, and
    an offset c of an edge E changes F to ``F + c |E|``: squares decide.

    Examples
    --------
    >>> from cfree.contact import EdgeVertex, VertexEdge, contact_surface
    >>> from cfree import Polygon
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> [is_minimal(contact_surface(square, square, EdgeVertex(i, 0))) for i in range(4)]
    [True, False, False, True]
    >>> [is_minimal(contact_surface(square, square, VertexEdge(i, 0))) for i in range(4)]
    [True, False, False, False]
    """
    if isinstance(surface, ArcArcSurface):
        return False
    core = surface.core if isinstance(surface, OffsetSurface) else surface
    (ax, ay), (gx, gy) = core.a, core.g
    if not any(core.g):
        return not any(core.a)
    beside = ax * gy - ay * gx
    if not isinstance(surface, OffsetSurface):
        return beside == 0
    # the edge's own offset s and rho sqrt(q): (s + rho) |g| = -beside, compared by squares on both sides of a root
    length = gx * gx + gy * gy
    return _is_sum_of_roots(-beside * abs(beside) / length, surface.signed_square, surface.edge_offset)


@checked
def striction_parameter(surface: Surface) -> Fraction | None:
    """Exact t_* of the striction curve of an e-v surface; None on a v-e surface, whose rulings are parallel.

    Notes
    -----
    t_* = <a_i, a_i - a_{i+1}> / E. There K and H are farthest from 0, unless H = 0; both are even in t - t_*.

    Examples
    --------
    >>> from cfree.contact import EdgeVertex, contact_surface
    >>> from cfree import Polygon
    >>> triangle = Polygon([(1, -1), (4, 2), (0, 1)])
    >>> striction_parameter(contact_surface(triangle, triangle, EdgeVertex(0, 0)))
    Fraction(0, 1)
    """
    if is_developable(surface):
        return None
    (ax, ay), (gx, gy) = surface.a, surface.g
    return -(ax * gx + ay * gy) / (gx * gx + gy * gy)


@checked
def striction_curve(surface: Surface) -> Helix | None:
    """Striction curve phi -> S(t_*, phi) of an e-v surface: the helix of the foot of the perpendicular, or its axis."""
    t = striction_parameter(surface)
    return None if t is None else surface.helix(t, beyond=True)


@checked
def striction_is_on_patch(surface: Surface) -> bool:
    """True if the striction curve is within t in [0, 1], ends included, decided exactly; False on v-e surfaces.

    It then crosses the contact patch, if the contact has one: see `contacts`.
    """
    t = striction_parameter(surface)
    return t is not None and 0 <= t <= 1


@checked
def striction_parameters(ruled: ArrayLike) -> Floats:
    """t_* of many surfaces in double precision, (...,); NaN for v-e surfaces.

    Values are rounded: use `striction_is_on_patch` to decide close cases of t_* in [0, 1].

    Parameters
    ----------
    ruled : (..., 8) float
        `Surface.ruled`, or rows of `Boundary.ruled`.
    """
    _, _, a, g = read_ruled(ruled)
    L = np.hypot(g[..., 0], g[..., 1])
    with np.errstate(invalid="ignore"):
        ux, uy = g[..., 0] / L, g[..., 1] / L
        return -(a[..., 0] * ux + a[..., 1] * uy) / L


@checked
def distribution_parameters(ruled: ArrayLike, *, angle_scale: float = 1.0) -> Floats:
    """Distribution parameter det(c', r, r') / r'.r' of unit rulings r over the directrix c, as a length, (...,).

    Parameters
    ----------
    ruled : (..., 8) float
        `Surface.ruled`, or rows of `Boundary.ruled`.
    angle_scale : float, length per radian

    Notes
    -----
    It is `angle_scale` for every e-v surface: two neighbouring rulings are w dphi apart and turned by dphi. So
    K = -w^2 / (w^2 + s^2)^2 at the distance s from the striction curve. On v-e surfaces r' = 0, and it is NaN.

    Examples
    --------
    >>> distribution_parameters([[0, 0, 0, 0, 1, 2, 3, 4], [0, 0, 1, 0, 1, 2, 0, 0]], angle_scale=2)
    array([ 2., nan])
    """
    return np.where(read_ruled(ruled).is_edge_vertex, check_scale(angle_scale), np.nan)


def _is_sum_of_roots(total: Fraction, first: Fraction, second: Fraction) -> bool:
    """True if x = y + second for the numbers x and y with ``x |x| = total`` and ``y |y| = first``."""
    # (x - y)^2 = second^2 holds exactly if 2 x y = x^2 + y^2 - second^2; the sign of x - y is that of total - first
    product = abs(total) + abs(first) - second * second
    same = (total > 0) == (first > 0) or not total or not first
    is_square = 4 * abs(total * first) == product * product and (product >= 0 if same else product <= 0)
    return is_square and (total > first) == (second > 0) and (total < first) == (second < 0)
