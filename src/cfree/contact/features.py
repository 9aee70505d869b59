"""Features of shapes bounded by segments and circular arcs: edges, and arcs with a signed radius.

A ring has the inside on its left. Three kinds of place in it are one kind of feature, a circle with centre c, signed
radius rho and a cone of outward unit normals u; its points are c + rho u:

    convex arc     rho > 0
    vertex         rho = 0, the cone between the normals of its two sides
    concave arc    rho < 0

A vertex lies only where two sides do not meet smoothly. A polygon grown by a disc has arcs at its vertices, and edges
that lie beside those of the polygon. docs/theory/arcs.md has the proofs.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from cfree.arguments import checked
from cfree.curves.curved import Curved
from cfree.curves.drawn import Line
from cfree.curves.rings import Piece, Span
from cfree.errors import UnsupportedError
from cfree.exact.number import ExactPoint, IntPoint, angle, rational_root
from cfree.exact.orientation import Location, Vector, locate_in_sector
from cfree.exact.vectors import minus
from cfree.libraries import Floats, np
from cfree.polygons.polygon import Polygon


@dataclass(frozen=True, slots=True)
class ArcFeature:
    """A circular arc, or a vertex as an arc of radius 0.

    Attributes
    ----------
    centre : pair of Fraction
    signed_square : Fraction
        ``rho |rho|`` of the signed radius rho: rational, also where rho is not.
    start, end : pair of int
        Exact directions of the first and last outward normal, counter-clockwise from start to end.
    width : float, radians
        Angle between the two, up to a full turn: the sweep of an arc, pi minus the interior angle of a vertex.
    is_convex : bool
        False for concave arcs and reflex vertices.

    Examples
    --------
    >>> arc = shape_features(Curved.circle((1, 2), 3)).arcs[0]
    >>> arc.centre == (1, 2), arc.radius, arc.signed_radius, arc.width == 2 * math.pi
    (True, Fraction(3, 1), 3.0, True)
    """

    centre: ExactPoint
    signed_square: Fraction
    start: IntPoint
    end: IntPoint
    width: float
    is_convex: bool

    @checked
    def points(self, parts: int) -> Floats:
        """`parts` + 1 points (n, 2) along it in the order of its ring, rounded; a vertex once.

        Examples
        --------
        >>> shape_features(Curved.circle((1, 2), 3)).arcs[0].points(2).round(12).tolist()
        [[4.0, 2.0], [-2.0, 2.0], [4.0, 2.0]]
        """
        if not self.signed_square:
            return np.array([self.centre], np.float64)
        share = np.linspace(0, 1, parts + 1)
        psi = self.first + self.width * (share if self.is_convex else share[::-1])
        circle: Floats = np.column_stack([np.cos(psi), np.sin(psi)])
        return np.array(self.centre, np.float64) + self.signed_radius * circle

    @property
    def radius(self) -> Fraction | None:
        """The signed radius as a fraction; None if it is irrational."""
        return signed_root(self.signed_square)

    @property
    def signed_radius(self) -> float:
        """The signed radius, rounded."""
        return math.copysign(math.sqrt(abs(self.signed_square)), self.signed_square)

    @property
    def first(self) -> float:
        """Angle of the first normal, in (-pi, pi]; the last is `width` further."""
        return angle(*self.start)

    @checked
    def locate(self, direction: Vector) -> Location:
        """Location of an exact direction in the cone of outward normals; all are inside if it is a full turn."""
        if self.is_whole:
            return Location.INSIDE
        return locate_in_sector(direction, self.start, self.end)

    @property
    def is_whole(self) -> bool:
        """True for a whole circle."""
        return self.start == self.end


@dataclass(frozen=True, slots=True)
class EdgeFeature:
    """A straight edge start + t along + offset n, with the unit normal n on its right, which is outside.

    Attributes
    ----------
    start, along : pair of Fraction
        The core edge; that of a polygon grown by a disc is the polygon's. Beside a reflex vertex the grown shape's own
        edge ends before it.
    offset : Fraction
        Distance of the edge from the core edge: how much the polygon is grown.
    """

    start: ExactPoint
    along: ExactPoint
    offset: Fraction

    @property
    def outward(self) -> IntPoint:
        """Direction of the outward normal, as integers without common divisors."""
        return _integers((self.along[1], -self.along[0]))

    @property
    def length(self) -> float:
        """Length, rounded."""
        return math.hypot(*map(float, self.along))


@dataclass(frozen=True, slots=True)
class ShapeFeatures:
    """Edges and arcs of a shape, in the order of its rings; see `shape_features`.

    Attributes
    ----------
    rings : tuple of tuples of ArcFeature and EdgeFeature
        The inside is on the left of each ring.
    """

    rings: tuple[tuple[ArcFeature | EdgeFeature, ...], ...]

    @property
    def arcs(self) -> tuple[ArcFeature, ...]:
        """Arcs and vertices, concave ones included."""
        return tuple(feature for ring in self.rings for feature in ring if isinstance(feature, ArcFeature))

    @property
    def edges(self) -> tuple[EdgeFeature, ...]:
        """Straight edges."""
        return tuple(feature for ring in self.rings for feature in ring if isinstance(feature, EdgeFeature))

    @checked
    def rims(self, parts: int) -> tuple[Floats, ...]:
        """Points (n, 2) along each ring, rounded: vertices, and `parts` + 1 points of each arc.

        Beside a reflex vertex a grown shape's own rim is farther out.

        Examples
        --------
        >>> (rim,) = shape_features(Curved([(0, 0), (4, 0), (0, 3)], grown=1)).rims(1)
        >>> rim.round(12).tolist()
        [[-1.0, 0.0], [-0.0, -1.0], [4.0, -1.0], [4.6, 0.8], [0.6, 3.8], [-1.0, 3.0]]
        """
        return tuple(
            np.concatenate([arc.points(parts) for arc in ring if isinstance(arc, ArcFeature)]) for ring in self.rings
        )

    @property
    def is_convex(self) -> bool:
        """True for one ring whose arcs and vertices are all convex."""
        return len(self.rings) == 1 and all(arc.is_convex for arc in self.arcs)

    @property
    def perimeter(self) -> float:
        """Length of all rings, rounded; exact up to rounding for convex shapes and shapes that are not grown."""
        return math.fsum(
            [*(edge.length for edge in self.edges), *(abs(arc.signed_radius) * arc.width for arc in self.arcs)]
        )

    @property
    def area(self) -> float:
        """Area within the rings, by Green's theorem, rounded; as `perimeter`."""
        return math.fsum(part for ring in self.rings for feature in ring for part in _doubled_area(feature)) / 2


@checked
def shape_features(shape: Polygon | Curved) -> ShapeFeatures:
    """Return the edges and arcs of a shape of segments and circular arcs.

    Parameters
    ----------
    shape : Polygon or Curved
        Vertex k of a polygon, also of a grown one, is arc k, and its edge k is edge k.

    Raises
    ------
    UnsupportedError
        If a ring has an ellipse, a Bézier curve or a spline: polygons around such a shape have contact surfaces.

    Examples
    --------
    >>> from cfree.curves import Arc
    >>> stadium = Curved([(0, 0), (4, 0), Arc((4, 2), center=(4, 1)), (0, 2), Arc((0, 0), center=(0, 1))])
    >>> [type(feature).__name__ for feature in shape_features(stadium).rings[0]]
    ['EdgeFeature', 'ArcFeature', 'EdgeFeature', 'ArcFeature']
    >>> car = shape_features(Curved([(0, 0), (4, 0), (4, 1), (0, 1)], grown="1/2"))
    >>> [str(arc.radius) for arc in car.arcs], [str(edge.offset) for edge in car.edges]
    (['1/2', '1/2', '1/2', '1/2'], ['1/2', '1/2', '1/2', '1/2'])
    >>> shape_features(Curved.ellipse((0, 0), (2, 1)))
    Traceback (most recent call last):
        ...
    cfree.errors.UnsupportedError: ring 0, piece 0: neither a segment nor an arc of a circle; give shape.outer(error)
    """
    if isinstance(shape, Polygon):
        return ShapeFeatures(_of_polygon(shape, Fraction(0)))
    if shape.grown:
        base = Polygon(shape.path, shape.holes)  # type: ignore[arg-type]
        return ShapeFeatures(_of_polygon(base, shape.grown))
    sides = [
        [_side(piece, f"ring {r}, piece {k}") for k, piece in enumerate(ring)] for r, ring in enumerate(shape.curves)
    ]
    return ShapeFeatures(tuple(_of_ring(_turned(ring, hole=r > 0)) for r, ring in enumerate(sides)))


def signed_root(signed_square: Fraction) -> Fraction | None:
    """Return the fraction x with ``x |x|`` equal to this number, None if there is none."""
    root = rational_root(abs(signed_square))
    return root if root is None or signed_square > 0 else -root


# --- polygons ---


def _of_polygon(polygon: Polygon, grown: Fraction) -> tuple[tuple[ArcFeature | EdgeFeature, ...], ...]:
    rings = []
    for first, last in zip(polygon.ring_offsets, polygon.ring_offsets[1:], strict=False):
        features: list[ArcFeature | EdgeFeature] = []
        for k in range(first, last):
            before, along = polygon.exact_edge(int(polygon.previous[k])), polygon.exact_edge(k)
            features += [
                _vertex(polygon.exact_vertices[k], before, along, grown),
                EdgeFeature(polygon.exact_vertices[k], along, grown),
            ]
        rings.append(tuple(features))
    return tuple(rings)


def _vertex(point: ExactPoint, before: ExactPoint, after: ExactPoint, grown: Fraction) -> ArcFeature:
    """Make the arc at a vertex between two directions of edges that are neither equal nor opposite."""
    convex = _cross(before, after) > 0
    start, end = (_integers((y, -x)) for x, y in ((before, after) if convex else (after, before)))
    return ArcFeature(point, grown * grown if convex else Fraction(0), start, end, _between(start, end), convex)


# --- rings of lines and arcs ---


@dataclass(frozen=True, slots=True)
class _Side:
    """A segment or an arc of a circle from `start` to `end`; an arc has a centre, a sense and a sweep."""

    start: ExactPoint
    end: ExactPoint
    centre: ExactPoint | None = None
    sense: int = 0  # 1 is counter-clockwise
    sweep: float = 0.0

    @property
    def normals(self) -> tuple[ExactPoint, ExactPoint]:
        """Directions of the first and last normal on the right."""
        if self.centre is None:
            normal = self.end[1] - self.start[1], self.start[0] - self.end[0]
            return normal, normal
        (x, y), s = self.centre, self.sense
        return (s * (self.start[0] - x), s * (self.start[1] - y)), (s * (self.end[0] - x), s * (self.end[1] - y))

    @property
    def signed_square(self) -> Fraction:
        """``rho |rho|`` of an arc."""
        (x, y), _ = self.normals
        return self.sense * (x * x + y * y)

    @property
    def bend(self) -> Fraction:
        """k |k| of the curvature k to the left, 0 on a segment."""
        return Fraction(0) if self.centre is None else 1 / self.signed_square


def _side(piece: Piece, place: str) -> _Side:
    match piece:
        case Line(start, end):
            return _Side(start, end)
        case Span(centre) if piece.is_circular:
            return _Side(piece.at(0, Fraction(0)), piece.end, centre, piece.sense, piece.sweep)
    raise UnsupportedError(f"{place}: neither a segment nor an arc of a circle; give shape.outer(error)")


def _turned(ring: Sequence[_Side], *, hole: bool) -> list[_Side]:
    """Turn a ring so that the shape is on its left: outer rings counter-clockwise, holes clockwise."""
    area = math.fsum(
        float(_cross(side.start, side.end)) + float(side.signed_square) * (side.sweep - math.sin(side.sweep))
        if side.centre is not None
        else float(_cross(side.start, side.end))
        for side in ring
    )
    if (area < 0) == hole:
        return list(ring)
    return [_Side(side.end, side.start, side.centre, -side.sense, side.sweep) for side in reversed(ring)]


def _of_ring(ring: Sequence[_Side]) -> tuple[ArcFeature | EdgeFeature, ...]:
    features: list[ArcFeature | EdgeFeature] = []
    for k, side in enumerate(ring):
        features += _corner(ring[k - 1], side)
        if side.centre is None:
            features.append(EdgeFeature(side.start, minus(side.end, side.start), Fraction(0)))
            continue
        start, end = (_integers(normal) for normal in (side.normals if side.sense > 0 else side.normals[::-1]))
        features.append(ArcFeature(side.centre, side.signed_square, start, end, side.sweep, side.sense > 0))
    return tuple(features)


def _corner(before: _Side, after: _Side) -> list[ArcFeature]:
    """Vertex between two sides, none where they meet smoothly; a cusp turns by half a turn."""
    first, second = before.normals[1], after.normals[0]
    turn = _cross(first, second)
    if turn == 0 and _dot(first, second) > 0:
        return []
    # at a cusp the shape is between its two sides if the second one leaves to the left of the first
    convex = turn > 0 or (turn == 0 and before.bend + after.bend < 0)
    start, end = map(_integers, (first, second) if convex else (second, first))
    width = math.pi if turn == 0 else _between(start, end)
    return [ArcFeature(after.start, Fraction(0), start, end, width, convex)]


# --- numbers ---


def _doubled_area(feature: ArcFeature | EdgeFeature) -> tuple[float, ...]:
    """Parts of twice the area between the feature and the origin."""
    if isinstance(feature, EdgeFeature):
        return float(_cross(feature.start, feature.along)), float(feature.offset) * feature.length
    rho, first, last = feature.signed_radius, feature.first, feature.first + feature.width
    (x, y), swept = map(float, feature.centre), (math.sin(last) - math.sin(first), math.cos(first) - math.cos(last))
    # c x (rho u') over normals that turn to the right on a concave arc
    sense = 1 if feature.is_convex else -1
    return sense * rho * (x * swept[0] + y * swept[1]), sense * rho * rho * feature.width


def _between(start: IntPoint, end: IntPoint) -> float:
    return angle(_dot(start, end), _cross(start, end)) % math.tau


def _integers(direction: ExactPoint) -> IntPoint:
    x, y = direction
    d = math.lcm(x.denominator, y.denominator)
    a, b = int(x * d), int(y * d)
    divisor = math.gcd(a, b)
    return a // divisor, b // divisor


def _cross(u: Sequence[Fraction | int], v: Sequence[Fraction | int]) -> int:
    return u[0] * v[1] - u[1] * v[0]  # type: ignore[return-value]


def _dot(u: Sequence[Fraction | int], v: Sequence[Fraction | int]) -> int:
    return u[0] * v[0] + u[1] * v[1]  # type: ignore[return-value]
