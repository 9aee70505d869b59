"""Degree of the Gauss map on the closed surfaces of a boundary: how often their normals cover the sphere.

The normal towards the free side is a point of the sphere, as C = R^2 x S^1 has the frame x, y, theta everywhere. Faces
cover areas of the sphere. Edges cover the arcs between the normals of the two faces that meet there, and vertices cover
the areas that these arcs enclose. The areas of a closed surface, with their signs, add up to 4 pi times a whole number,
the *degree*, which is half the Euler number. docs/theory/surface-geometry.md, "The Gauss map", has the proof.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

import cfree._core as _core
from cfree.arguments import checked
from cfree.errors import UnsupportedError
from cfree.forbidden.boundary import Boundary
from cfree.forbidden.cell_complex import CellComplex
from cfree.forbidden.kinds import PatchKind
from cfree.geometry.arcs import arc_geometry
from cfree.geometry.ruled import Floats, check_scale, read_ruled
from cfree.value import Value

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

UPPER = 1  # number of the upper side of a trapezoid; the walls are 0 and 2
TIE = 1e-3  # if the sum of two unit normals is shorter, the arc between them passes through `_middle`
ROUNDING = 1e-12  # two unit normals are opposite if their sum is shorter
SHORT, APART = 1e-9, 1e-6  # radians along an edge; distance of its end between faces, per length of a radian
ONE_WAY = 1e-6  # the mean of equal directions is shorter than 1 by at most this
ROUNDS = 400  # steps of the search for a half of the sphere around the normals of a vertex
PRECISION, SURE, HALVINGS = 1e-9, 6, 30  # areas along edges; more than 6 halvings only while they help
BLOCK = 8192  # edges at a time

NODES, WEIGHTS = legendre.leggauss(16)
_MODES = np.linalg.inv(legendre.legvander(NODES, 15))
DERIVATIVE = legendre.legvander(NODES, 14) @ legendre.legder(np.eye(16), axis=0) @ _MODES
AT_START, AT_END = legendre.legvander(np.array([-1.0, 1.0]), 14) @ legendre.legder(np.eye(16), axis=0) @ _MODES


@checked
@dataclass(frozen=True, eq=False)
class GaussMap(Value):
    """Areas of the sphere that the normals of closed surfaces cover; see `gauss_map`.

    Attributes
    ----------
    faces : (F,) float64
        Integral of K over each trapezoid.
    edges : (H,) float64
        Half of the area between the normals of a coedge's face and those of its twin's face.
    vertices : (V,) float64
        Area within the normals around each vertex. Going round from twin to twin yields the vertices.
    degree : (C,) float64
        Sum of the areas of each closed surface, over 4 pi.
    error : (C,) float64
        Change of `degree` when the intervals of quadrature are halved: a measured error. For each coedge, the rounding
        of the greatest coordinate, in radians, is added. It is infinite if an edge is too short for doubles: its faces
        then compute different places for the same vertex. Among arcs it is also infinite if no half of the sphere
        contains the normals at a vertex, where circles touch: their directions alone do not decide the area there.
    """

    faces: Floats
    edges: Floats
    vertices: Floats
    degree: Floats
    error: Floats

    def __repr__(self) -> str:
        sums = ", ".join(f"{x:.9f}" for x in self.degree[:8]) + ", ..." * (len(self.degree) > 8)
        return f"GaussMap(degree [{sums}])"


@checked
def gauss_map(boundary: Boundary, *, angle_scale: float = 1.0) -> GaussMap:
    """Degree of the Gauss map on each closed surface of a boundary, from areas of the sphere.

    Parameters
    ----------
    boundary : Boundary
    angle_scale : float, length per radian
        1 in the paper. Areas depend on it; degrees do not.

    Returns
    -------
    GaussMap

    Raises
    ------
    IncompleteError
        If the boundary is incomplete.
    UnsupportedError
        If an edge has no length in doubles.
    ValueError
        If `angle_scale` is not positive.

    Notes
    -----
    The sum contains no count of vertices, edges or faces. It uses both faces at an edge and all faces around a vertex,
    in the order in which they are glued. So a degree that is half of `CellComplex.euler` checks the gluing, which
    `gauss_bonnet` cannot. Sheets at a pinched edge are taken in the pairs in which they are glued. Isolated parts
    belong to no closed surface and have no area.

    All is computed in doubles: if shapes are 1e12 times as large as others, or nearly touch, `error` is so large that
    the degree means nothing. Time is linear in the number of coedges, some 50 microseconds each.

    Examples
    --------
    >>> import cfree
    >>> scene = cfree.Scene([(0, 0), (1, 0), (0, 1)], [[(4, 4), (6, 4), (5, 5)]], bounds=(0, 0, 9, 9))
    >>> result = cfree.boundary(scene)
    >>> gauss_map(result).degree.round(9) + 0.0, result.complex.euler      # both surround the circle of theta: tori
    (array([0., 0.]), array([0, 0]))
    """
    w, cells = check_scale(angle_scale), boundary.complex
    sides = _Sides(boundary, cells, w)
    faces, faces_off = _core.trapezoid_curvatures(boundary._handle, w)
    edges, edges_off, arriving, is_sharp = _along_edges(sides)
    vertex, vertices, is_around = _at_vertices(sides, arriving, is_sharp)
    component = np.zeros(len(vertices), np.int64)
    component[vertex] = surface = cells.component[cells.face]

    def summed(*parts: tuple[Floats, NDArray[Any]]) -> Floats:
        sums = [math.fsum(x for values, n in parts for x in values[n == k].tolist()) for k in range(cells.components)]
        return np.array(sums, np.float64) / (2 * math.tau)

    degree = summed((faces, cells.component), (edges, surface), (vertices, component))
    lost = np.full(len(surface), np.spacing(float(np.abs(cells.near).max(initial=0.0))) / w)
    lost[_is_unsettled(sides, vertex) | (is_around[vertex] & boundary.scene.curved)] = np.inf
    error = summed((faces_off, cells.component), (edges_off, surface), (lost, surface))
    return GaussMap(faces, edges, vertices, degree, error)


class _Sides:
    """Coedges as curves on the surface of their face, and the face's normals along them."""

    def __init__(self, boundary: Boundary, cells: CellComplex, w: float) -> None:
        self.boundary, self.cells, self.w = boundary, cells, w
        count, first = len(cells.face), cells.first
        self.before: Ints = np.arange(count) - 1
        self.before[first[:-1]] = first[1:] - 1
        self.after: Ints = np.empty(count, np.int64)
        self.after[self.before] = np.arange(count)
        self.is_curve = cells.side % 2 == 1
        self.patch = boundary.trapezoids.patch[cells.face]
        arcs = boundary.patch_kind[self.patch] == PatchKind.ARC_ARC
        edges = boundary.ruled[self.patch].reshape(-1, 8)[~arcs]
        if not (edges[:, 2:4] + edges[:, 6:8]).any(axis=-1).all():
            raise UnsupportedError("gauss_map: an edge has no length in doubles beside the largest coordinates")
        self.theta, self.t, self.place = self._starts()
        self.normal = self._surfaces(np.arange(count)).normal(self.t, self.theta, w)

    def _surfaces(self, h: Ints, *, near: bool = False) -> _Surfaces:
        """Return the surfaces of coedges, near the origin of the features if wanted."""
        return _Surfaces(self.boundary, self.patch[h], near=near)

    def _starts(self) -> tuple[Floats, Floats, Floats]:
        """Theta and t of the starts of coedges on the surface of their face; and their place, NaN inside a wall."""
        cells = self.cells
        start = _core.side_curvatures(self.boundary._complex_handle, self.w)[3].reshape(-1, 3).copy()
        place = start[:, :2].copy()
        within = ~np.isfinite(start[:, 0])  # inside a wall: only the vertex has a place
        start[within, :2] = cells.near[cells.vertex[within]]
        theta = start[:, 2] / self.w
        surfaces = self._surfaces(np.arange(len(theta)), near=True)
        return theta, surfaces.parameter(start[:, :2], theta), place

    def along(self, h: Ints, share: Floats) -> tuple[Floats, Floats]:
        """Normals and points at shares (m, n) of coedges (m,): (m, n, 3) each."""
        theta = (1 - share) * self.theta[h, None] + share * self.theta[self.after[h], None]
        t = (1 - share) * self.t[h, None] + share * self.t[self.after[h], None]
        curves = self.is_curve[h]
        own, n = h[curves], share.shape[1]
        lower, upper = self.boundary.limits(np.repeat(self.cells.face[own], n), theta[curves].ravel())
        t[curves] = np.where(np.repeat(self.cells.side[own] == UPPER, n), upper, lower).reshape(-1, n)
        surfaces = self._surfaces(np.repeat(h, n))
        flat = t.ravel(), theta.ravel()
        points = np.column_stack([surfaces.place(*flat), self.w * flat[1]])
        return surfaces.normal(*flat, self.w).reshape(*t.shape, 3), points.reshape(*t.shape, 3)


class _Surfaces:
    """Surfaces S(t, theta) of patches: ruled, or of an arc on an arc of radius `rho` other than 0."""

    def __init__(self, boundary: Boundary, patch: NDArray[Any], *, near: bool) -> None:
        self.patch, self.rho = patch, boundary.patch_radius[patch]
        self.rows = (boundary.ruled_near if near else boundary.ruled)[patch].reshape(-1, 8)
        self.first = math.pi / 2 * ((boundary.contact_kind[patch] >> 4) + (self.rho < 0))  # psi at t = 0
        self.arcs = self.rho != 0
        self._evaluate = boundary.evaluate_near if near else boundary.evaluate

    def place(self, t: Floats, theta: Floats) -> Floats:
        """Positions in the plane."""
        return self._evaluate(self.patch, t, theta)

    def parameter(self, place: Floats, theta: Floats) -> Floats:
        """Parameters t of positions."""
        along = place - self.place(np.zeros(len(theta)), theta)
        t = np.empty(len(theta))
        lines, arcs = ~self.arcs, self.arcs
        surface = read_ruled(self.rows[lines])
        t[lines] = (along[lines] * surface.ruling(theta[lines])).sum(axis=-1) / surface.L
        first = self.first[arcs]
        x, y = (along[arcs] / self.rho[arcs, None]).T + np.stack([np.cos(first), np.sin(first)])
        turn = np.remainder(np.arctan2(y, x) - first + math.pi, math.tau) - math.pi
        t[arcs] = np.tan(np.copysign(turn / 2, turn * self.rho[arcs]))
        return t

    def normal(self, t: Floats, theta: Floats, w: float) -> Floats:
        """Unit normals towards the free side: S_t x S_theta."""
        normal = np.empty((len(t), 3))
        lines, arcs = ~self.arcs, self.arcs
        surface = read_ruled(self.rows[lines])
        u, (s, _) = surface.ruling(theta[lines]), surface.across_and_along(t[lines], theta[lines])
        normal[lines] = np.column_stack([w * u[:, 1], -w * u[:, 0], s]) / np.hypot(w, s)[:, None]
        if arcs.any():
            psi = self.first[arcs] + 2 * np.copysign(np.arctan(t[arcs]), t[arcs] * self.rho[arcs])
            circular = np.column_stack([self.rows[arcs, 0:2], self.rows[arcs, 4:6], self.rho[arcs]])
            normal[arcs] = arc_geometry(circular, psi, theta[arcs], angle_scale=w).normal
        return normal


# --- edges ---


def _along_edges(sides: _Sides) -> tuple[Floats, Floats, Floats, Bools]:
    """Areas along coedges, their errors, the directions in which they arrive at their end, and `_is_sharp` near it."""
    twin = sides.cells.twin
    count = len(twin)
    areas, errors = np.zeros(count), np.zeros(count)
    arriving, is_sharp = np.zeros((count, 3)), np.zeros(count, bool)
    whole = np.flatnonzero(np.arange(count) < twin)
    for first in range(0, len(whole), BLOCK):
        h = whole[first : first + BLOCK]
        start, size, least = np.zeros(len(h)), 1.0, np.full(len(h), np.inf)
        area = _covered(sides, h, start, start + size)[0]
        for k in range(HALVINGS):  # both halves, until they agree with the whole
            size /= 2
            low, high = (_covered(sides, h, start + x, start + x + size) for x in (0.0, size))
            off = np.abs(low[0] + high[0] - area)
            again = (off > PRECISION) & (off < least) & (k < HALVINGS - 1)
            done = ~again
            np.add.at(areas, h[done], (low[0] + high[0])[done])
            np.add.at(errors, h[done], off[done])
            first_half, last_half = done & (start == 0), done & (start + 2 * size == 1)
            ends = (h, last_half, high[1]), (twin[h], first_half, low[2])
            for coedge, mask, (direction, sharp) in ends:
                arriving[coedge[mask]], is_sharp[coedge[mask]] = direction[mask], sharp[mask]
            h, start = np.tile(h[again], 2), np.concatenate([start[again], start[again] + size])
            area, least = np.concatenate([half[0][again] for half in (low, high)]), np.tile(off[again], 2)
            if k < SURE:
                least[:] = np.inf
            if not len(h):
                break
    for values in (areas, errors):  # each twin has half of it
        values[whole] /= 2
        values[twin[whole]] = values[whole]
    return areas, errors, arriving, is_sharp


def _covered(
    sides: _Sides, h: Ints, start: Floats, stop: Floats
) -> tuple[Floats, tuple[Floats, Bools], tuple[Floats, Bools]]:
    """Area covered by arcs from a coedge's normals to its twin's; the direction and `_is_sharp` at the end of each.

    Notes
    -----
    Arcs of length d and pole n that move sideways by A' and B' at their ends cover tan(d / 2) (A' + B') . n in each
    unit of time. With A x B = n sin d, that is det(A, B, A' + B') / (1 + A . B).
    """
    share = (start[:, None] + stop[:, None] + (stop - start)[:, None] * NODES) / 2
    A, points = sides.along(h, share)
    B, others = (x[:, ::-1] for x in sides.along(sides.cells.twin[h].astype(np.int64), 1 - share[:, ::-1]))
    with np.errstate(divide="ignore", invalid="ignore"):
        rate = _sideways(A, B)
    sums = np.linalg.norm(A + B, axis=-1)
    length = np.linalg.norm(points[:, -1] - points[:, 0], axis=-1)
    narrow = (sums.max(axis=-1) < 1) & (sums.min(axis=-1) < length / np.abs(points).max(axis=(-2, -1)))
    if narrow.any():  # rounding moves a tangent there less than it moves the sum of the normals
        a, b, tangent = A[narrow], B[narrow], _unit(_change(points[narrow]))
        middle = _middle(a, tangent, _is_sharp(a, b, tangent))
        rate[narrow] = _sideways(a, middle) + _sideways(middle, b)
    end, start = _unit(AT_END @ points), -_unit(AT_START @ others)
    last, first = (_is_sharp(A[:, k], B[:, k], tangent) for k, tangent in ((-1, end), (0, -start)))
    return rate @ WEIGHTS, (end, last), (start, first)


def _is_sharp(A: Floats, B: Floats, tangent: Floats) -> Bools:
    """True for a sharp forbidden edge, and False for the end of a narrow free space, between two normals.

    Notes
    -----
    Free space may have width 0 along an edge: slits do. A forbidden edge has an angle above 0, but at ends of edges
    among arcs, where circles touch.
    """
    sums = A + B
    sharp = (_dot(sums, np.cross(A, tangent)) < 0) & (np.linalg.norm(sums, axis=-1) > ROUNDING)
    return np.asarray(sharp)


def _middle(A: Floats, tangent: Floats, is_sharp: Bools) -> Floats:
    """Direction through which the arc to a nearly opposite normal leads: normal to the edge and to the first normal.

    It leads into the face around the end of a narrow free space, and away from it around a sharp forbidden edge.
    """
    into = np.cross(A, tangent)
    return np.asarray(np.where(is_sharp[..., None], -into, into))


def _sideways(A: Floats, B: Floats) -> Floats:
    both = A + B  # A x B = A x (A + B) and 2 + 2 A . B = |A + B|^2, without cancellation where the sum is small
    return np.asarray(2 * (np.cross(A, both) * _change(both)).sum(axis=-1) / (both**2).sum(axis=-1))


def _change(values: Floats) -> Floats:
    """Derivatives at the nodes."""
    return np.asarray(DERIVATIVE @ values)


def _unit(vectors: Floats) -> Floats:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.asarray(np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0))


# --- vertices ---


def _at_vertices(sides: _Sides, arriving: Floats, is_sharp: Bools) -> tuple[Ints, Floats, Bools]:
    """Vertex at which each coedge starts, the area of the normals around each vertex, and if no half contains them.

    Notes
    -----
    The polygon of normals is cut into triangles from a centre; none of them contains the centre's opposite point. They
    are the area of the vertex if that does not contain the opposite point. If all normals are on the centre's half of
    the sphere, so is the area. Else, as at some saddles, the centre is a direction whose height has no critical point
    at the vertex: a plane normal to it crosses the link of the vertex exactly twice. At the tip of a spike all edges
    leave in one direction, which is the centre, since free space is inside.
    """
    following = sides.cells.twin[sides.before].astype(np.int64)
    vertex, count = _cycles(following)
    start = sides.normal
    stop = start[following]
    middle = start + stop
    length = np.linalg.norm(middle, axis=-1, keepdims=True)
    aside = _middle(start, arriving[sides.before], is_sharp[sides.before])  # across the edge between the two
    middle = np.where(length > TIE, middle / np.maximum(length, TIE), aside)
    leaving = -arriving[sides.cells.twin]
    centre, height = _centres(np.concatenate([start, middle]), np.tile(vertex, 2), count)
    _regular(centre, height, vertex, leaving, leaving[following])
    own = centre[vertex]
    areas = np.bincount(vertex, _triangle(own, start, middle) + _triangle(own, middle, stop), count)
    return vertex, areas.astype(np.float64), height <= 0


def _is_unsettled(sides: _Sides, vertex: Ints) -> Bools:
    """True for coedges that start at an end of a very short edge for which faces compute different places."""
    short = sides.is_curve & (np.abs(sides.theta[sides.after] - sides.theta) < SHORT)
    count = int(vertex.max(initial=-1)) + 1
    at_short = np.zeros(count, bool)
    at_short[vertex[short]] = at_short[vertex[sides.after[short]]] = True
    low, high = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    known = np.isfinite(sides.place[:, 0])
    np.minimum.at(low, vertex[known], sides.place[known])
    np.maximum.at(high, vertex[known], sides.place[known])
    apart = (high - low > APART * sides.w).any(axis=-1)
    return np.asarray((at_short & apart)[vertex])


def _centres(points: Floats, owner: Ints, count: int) -> tuple[Floats, Floats]:
    """Centres of halves of the sphere around sets of points, and the height of each set's lowest point over the rim.

    Notes
    -----
    Rosenblatt's perceptron: centres move towards the lowest points. Heights of 0 and less need not be the greatest
    possible.
    """
    centre = np.zeros((count, 3))
    np.add.at(centre, owner, points)
    best, height = centre, np.full(count, -np.inf)
    active = np.arange(len(points))
    for k in range(ROUNDS):
        centre = centre / np.maximum(np.linalg.norm(centre, axis=-1, keepdims=True), 1e-12)
        heights = (points[active] * centre[owner[active]]).sum(axis=-1)
        lowest = np.full(count, np.inf)
        np.minimum.at(lowest, owner[active], heights)
        better = (lowest > height) & np.isfinite(lowest)
        best, height = np.where(better[:, None], centre, best), np.where(better, lowest, height)
        low = active[heights <= lowest[owner[active]]]
        np.add.at(centre, owner[low], points[low] / math.sqrt(k + 1))
        active = active[height[owner[active]] < TIE]
        if not len(active):
            break
    return best, height


def _regular(centre: Floats, height: Floats, vertex: Ints, leaving: Floats, following: Floats) -> None:
    """Set the centres of vertices to directions in which the height is regular, if their edges have one.

    Notes
    -----
    Faces have angles of at most pi. So a plane crosses the face between two consecutive edges, once, exactly if the
    heights of these edges have different signs.
    """
    along = np.zeros_like(centre)
    np.add.at(along, vertex, leaving / np.bincount(vertex)[vertex, None])
    spike = (height < TIE) & (np.linalg.norm(along, axis=-1) > 1 - ONE_WAY)
    centre[spike] = along[spike]
    left = np.flatnonzero((height <= 0) & ~spike)
    for direction in DIRECTIONS:
        if not len(left):
            return
        own = np.isin(vertex, left)
        changes = (leaving[own] @ direction > 0) != (following[own] @ direction > 0)
        regular = left[np.bincount(vertex[own], changes, len(centre))[left] == 2]
        centre[regular] = direction
        left = np.setdiff1d(left, regular)


def _directions(count: int) -> Floats:
    """Unit vectors all over the sphere, along a spiral."""
    k = np.arange(count) + 0.5
    z, angle = 1 - 2 * k / count, k * math.pi * (1 + 5**0.5)
    return np.column_stack([np.sqrt(1 - z * z) * np.cos(angle), np.sqrt(1 - z * z) * np.sin(angle), z])


DIRECTIONS = _directions(500)


def _cycles(following: Ints) -> tuple[Ints, int]:
    """Number of each element's cycle in a permutation, and the number of cycles."""
    least, ahead = np.arange(len(following)), following
    for _ in range(len(following).bit_length()):
        least, ahead = np.minimum(least, least[ahead]), ahead[ahead]
    firsts, number = np.unique(least, return_inverse=True)
    return number.astype(np.int64), len(firsts)


def _dot(u: Floats, v: Floats) -> Floats:
    return np.asarray((u * v).sum(axis=-1))


def _triangle(a: Floats, p: Floats, q: Floats) -> Floats:
    """Area of a spherical triangle, positive if it is counter-clockwise from outside."""
    return np.asarray(2 * np.arctan2(_dot(a, np.cross(p, q)), 1 + _dot(a, p) + _dot(p, q) + _dot(q, a)))
