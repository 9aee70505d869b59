"""Polygons: an outer ring and holes, with exact coordinates and the interior on the left of every edge.

Vertices are numbered over all rings, the outer ring first. Edge i goes from vertex i to the next of its
ring (the paper's a_i, E_i and b_j, E_j, from 0 instead of 1). Rings are checked once, exactly, when a
polygon is made: every `Polygon` is simple, its outer ring runs counter-clockwise and its holes clockwise.
"""

from __future__ import annotations

import math
import reprlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeVar

import cfree._core as _core
from cfree.arguments import checked
from cfree.errors import InvalidPolygonError
from cfree.exact.half_angle import Angle, half_angle_rotation, normalize_angles, read_angle
from cfree.exact.number import ExactPoint, IntPoint, Number, angle, to_fraction
from cfree.libraries import Floats, Ints, NDArray, np
from cfree.polygons.rings import Points, Removed, read_rings, restored
from cfree.value import Shown
from cfree.words import counted

if TYPE_CHECKING:
    from shapely import Geometry as ShapelyGeometry
    from shapely import Polygon as ShapelyPolygon
else:
    ShapelyGeometry = ShapelyPolygon = Any  # shapely is imported where it is used

T = TypeVar("T", bound="np.generic")


@dataclass(frozen=True, init=False, eq=False, repr=False)
class Polygon(Shown):
    """A simple polygon, with or without holes.

    Parameters
    ----------
    outer : (n, 2) array or sequence of pairs of numbers
        The ring in either direction; a last point equal to the first is dropped. Numbers as in `cfree.exact.number`.
    holes : sequence of the same
        Inside the outer ring, apart from it and from each other.

    Raises
    ------
    InvalidPolygonError
        The message has the place, the value and the remedy.

    Notes
    -----
    Equality compares the rings exactly, point by point. O(n log n) time, O(n) if convex.

    Examples
    --------
    >>> corner = Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
    >>> corner.exact_area, corner.convex.tolist()
    (Fraction(3, 1), [True, True, True, False, True, True])
    >>> corner.edge(0)
    array([2., 0.])
    >>> Polygon([(0, 0), (2, 2), (2, 0), (0, 3)])  # doctest: +ELLIPSIS
    Traceback (most recent call last):
        ...
    cfree.errors.InvalidPolygonError: outer ring: edges 0 and 2 cross at (6/5, 6/5); split it into simple ...
    """

    __slots__ = ("__dict__", "__weakref__", "_handle")  # `__dict__` is made with the first computed value
    _handle: _core.Polygon

    def __init__(self, outer: Points, holes: Sequence[Points] = ()) -> None:
        object.__setattr__(self, "_handle", read_rings(outer, holes))

    def __len__(self) -> int:
        return len(self._handle)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Polygon):
            return NotImplemented
        return self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)

    def __reduce__(self) -> tuple[Any, ...]:  # without cached results
        return _restored, (self.numerators, self.denominator, self.ring_offsets, self.removed)

    def __repr__(self) -> str:
        holes = len(self.ring_offsets) - 2
        return f"<Polygon of {counted(len(self), 'vertex')}, {counted(holes, 'hole')}>"

    @property
    def _key(self) -> tuple[object, ...]:
        return self.ring_offsets, self.denominator, self.numerators

    # vertices and edges

    @cached_property
    def numerators(self) -> tuple[IntPoint, ...]:
        """Vertices of all rings: their exact coordinates are numerators / denominator."""
        return self._handle.numerators

    @cached_property
    def denominator(self) -> int:
        """Least common denominator of all coordinates."""
        return self._handle.denominator

    @cached_property
    def ring_offsets(self) -> tuple[int, ...]:
        """Ring r holds the vertices ring_offsets[r] to ring_offsets[r + 1] - 1."""
        return tuple(self._handle.ring_offsets)

    @cached_property
    def removed(self) -> tuple[Removed, ...]:
        """Points of the input that are exactly repeated or collinear."""
        removed = self._handle.removed
        return tuple(Removed(ring, index, "repeated" if twice else "collinear") for ring, index, twice in removed)

    @cached_property
    def vertices(self) -> Floats:
        """Vertices rounded to the nearest doubles, (n, 2)."""
        return self._handle.vertices

    @property
    def doubles(self) -> Iterator[tuple[float, float]]:
        """The same one after the other: of few vertices, sooner than numpy is imported."""
        return ((x / self.denominator, y / self.denominator) for x, y in self.numerators)

    @property
    def rings(self) -> list[Floats]:
        """Vertices by ring, rounded; the interior is on the left."""
        return [self.vertices[i:j] for i, j in pairwise(self.ring_offsets)]

    @cached_property
    def exact_vertices(self) -> tuple[ExactPoint, ...]:
        """Exact vertices."""
        d = self.denominator
        return tuple((Fraction(x, d), Fraction(y, d)) for x, y in self.numerators)

    @property
    def exact_rings(self) -> list[tuple[ExactPoint, ...]]:
        """Exact vertices by ring; the interior is on the left."""
        return [self.exact_vertices[i:j] for i, j in pairwise(self.ring_offsets)]

    @cached_property
    def next(self) -> Ints:
        """Index of the vertex after each vertex, in its ring."""
        index = np.arange(1, len(self) + 1, dtype=np.int64)
        index[np.array(self.ring_offsets[1:]) - 1] = self.ring_offsets[:-1]
        return _read_only(index)

    @cached_property
    def previous(self) -> Ints:
        """Index of the vertex before each vertex, in its ring."""
        index = np.empty(len(self), dtype=np.int64)
        index[self.next] = np.arange(len(self))
        return _read_only(index)

    @cached_property
    def edge_numerators(self) -> tuple[IntPoint, ...]:
        """Exact edge vectors times the denominator."""
        v = self.numerators
        return tuple((v[k][0] - x, v[k][1] - y) for (x, y), k in zip(v, self.next.tolist(), strict=True))

    @cached_property
    def edges(self) -> Floats:
        """Edge vectors E_i = a_{i+1} - a_i, rounded once, (n, 2)."""
        return _read_only(_rounded(self.edge_numerators, self.denominator))

    @checked
    def edge(self, i: int) -> Floats:
        """Edge vector E_i."""
        vector: Floats = self.edges[i]
        return vector

    @checked
    def exact_edge(self, i: int) -> ExactPoint:
        """Exact edge vector E_i."""
        x, y = self.edge_numerators[i]
        return Fraction(x, self.denominator), Fraction(y, self.denominator)

    @classmethod
    @checked
    def from_polar(
        cls, outer: Iterable[tuple[Number, Angle]], holes: Iterable[Iterable[tuple[Number, Angle]]] = ()
    ) -> Polygon:
        """Return the polygon of vertices r (cos alpha, sin alpha), the paper's form of the robot in section 1.1.

        Parameters
        ----------
        outer : pairs (r, alpha)
            alpha is read as theta in `Pose`: radians, "90deg" or {"tau": "1/3"}.
        holes : lists of the same

        Examples
        --------
        >>> square = Polygon.from_polar([(1, 0), (1, "90deg"), (1, math.pi), (1, {"tau": -1})])
        >>> square == Polygon([(1, 0), (0, 1), (-1, 0), (0, -1)])
        True
        """
        return cls(_from_polar(outer), [_from_polar(hole) for hole in holes])

    @property
    def polar(self) -> Floats:
        """r and alpha of all vertices, alpha in [0, 2 pi), rounded, (n, 2); alpha is 0 at the origin."""
        alpha = [angle(x, y) if x or y else 0.0 for x, y in self.numerators]
        return np.column_stack((np.hypot(*self.vertices.T), normalize_angles(alpha)))

    # angles and measures

    @cached_property
    def convex(self) -> NDArray[np.bool_]:
        """True for each vertex with an interior angle below pi, exactly, (n,); False for a reflex vertex."""
        return self._handle.convex

    @property
    def is_convex(self) -> bool:
        """True if there is no hole and no reflex vertex."""
        return self._handle.is_convex

    @cached_property
    def interior_angles(self) -> Floats:
        """Interior angles in radians, in (0, 2 pi): the paper's rho and omega, (n,)."""
        edges = self.edge_numerators
        angles = []
        for (ux, uy), (vx, vy) in zip((edges[k] for k in self.previous.tolist()), edges, strict=True):
            # from the edge that leaves to the one that arrives, so that small angles keep their digits
            rho = angle(-(ux * vx + uy * vy), ux * vy - uy * vx)
            angles.append(rho if rho > 0 else rho + 2 * math.pi)
        return _read_only(np.array(angles))

    @cached_property
    def exact_area(self) -> Fraction:
        """Area without the holes."""
        v = self.numerators
        doubled = sum(x * v[k][1] - y * v[k][0] for (x, y), k in zip(v, self.next.tolist(), strict=True))
        return Fraction(doubled, 2 * self.denominator**2)

    @property
    def area(self) -> float:
        """Area rounded to the nearest double, inf beyond the greatest double."""
        try:
            return float(self.exact_area)
        except OverflowError:
            return math.inf

    @cached_property
    def perimeter(self) -> float:
        """Total length of all rings."""
        return math.fsum(math.hypot(x, y) for x, y in self.edges.tolist())

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Least x, least y, greatest x, greatest y."""
        return self._handle.box

    @cached_property
    def pieces(self) -> tuple[tuple[int, ...], ...]:
        """Convex pieces that cover the polygon, counter-clockwise, as indices of vertices."""
        return tuple(map(tuple, self._handle.pieces))

    # other libraries

    def to_shapely(self) -> ShapelyPolygon:
        """Convert to a shapely polygon, rounded to doubles."""
        import shapely

        outer, *holes = (self.vertices[first:end] for first, end in pairwise(self.ring_offsets))
        return shapely.Polygon(outer, holes)

    @classmethod
    def from_shapely(cls, geometry: ShapelyGeometry) -> Polygon:
        """Convert a shapely polygon, with the exact values of its doubles; heights are ignored.

        Examples
        --------
        >>> from shapely import box
        >>> Polygon.from_shapely(box(0, 0, 2, 1)).exact_area
        Fraction(2, 1)
        """
        import shapely

        if not isinstance(geometry, shapely.Geometry):
            raise TypeError(f"geometry: {reprlib.repr(geometry)} is no shapely geometry; give a Polygon")
        if geometry.geom_type != "Polygon" or geometry.is_empty:
            raise InvalidPolygonError(f"{geometry.wkt:.60} is no polygon; give the parts of a collection one by one")
        return cls(
            shapely.get_coordinates(geometry.exterior),
            [shapely.get_coordinates(ring) for ring in geometry.interiors],
        )


def polygon_of(core: _core.Polygon) -> Polygon:
    """Wrap a polygon of the core."""
    polygon = Polygon.__new__(Polygon)
    object.__setattr__(polygon, "_handle", core)
    return polygon


def _from_polar(points: Iterable[tuple[Number, Angle]]) -> list[ExactPoint]:
    vertices = []
    for radius, alpha in points:
        c, s, w = half_angle_rotation(read_angle(alpha)[0])
        r = to_fraction(radius) / w
        vertices.append((r * c, r * s))
    return vertices


def _restored(numerators: Any, denominator: int, ring_offsets: Sequence[int], removed: tuple[Removed, ...]) -> Polygon:
    polygon = polygon_of(restored(numerators, denominator, ring_offsets))
    vars(polygon)["removed"] = removed
    return polygon


def _rounded(numerators: Sequence[IntPoint], denominator: int) -> Floats:
    """Round to the nearest doubles: Python's division of integers rounds once."""
    return np.array([(x / denominator, y / denominator) for x, y in numerators])


def _read_only(array: NDArray[T]) -> NDArray[T]:
    array.setflags(write=False)
    return array
