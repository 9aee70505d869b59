"""No-fit polygons and inner-fit regions at one orientation, exactly; exact fits of no width are kept."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from cfree.arguments import checked
from cfree.curves.similar import moved_shape
from cfree.exact.half_angle import Angle
from cfree.exact.number import ExactPoint, Number, to_fraction
from cfree.exact.pose import Pose
from cfree.exact.vectors import along, foot, minus
from cfree.lazy import registered
from cfree.nesting.outlines import Outlines, outlines
from cfree.nesting.rounded import RoundedFit, rounded_fit
from cfree.nesting.sums import Sums, box_of, complement, sums_of
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import AnyShape, Scene, shapes_in
from cfree.words import counted

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry
else:
    BaseGeometry = Any  # shapely is imported where it is used

Ring = tuple[ExactPoint, ...]


@dataclass(frozen=True, repr=False)
class _Fit:
    """Positions of a part at one orientation: rings around a region, and positions that have no width."""

    rings: tuple[Ring, ...]
    segments: tuple[tuple[ExactPoint, ExactPoint], ...]
    points: tuple[ExactPoint, ...]
    sums: Sums = field(compare=False)

    def __repr__(self) -> str:
        corners = counted(sum(map(len, self.rings)), "vertex")
        fits = [counted(len(self.segments), "segment"), counted(len(self.points), "point")]
        exact = f"; exact fits: {', '.join(fits)}" if self.segments or self.points else ""
        return f"<{type(self).__name__} of {counted(len(self.rings), 'ring')}, {corners}{exact}>"

    @property
    def exact_area(self) -> Fraction:
        """Area of the region."""
        doubled = sum(
            (a[0] * b[1] - a[1] * b[0] for ring in self.rings for a, b in pairwise((*ring, ring[0]))), Fraction(0)
        )
        return doubled / 2

    @property
    def area(self) -> float:
        """Area of the region, rounded."""
        return float(self.exact_area)

    @cached_property
    def edges(self) -> tuple[tuple[ExactPoint, ExactPoint], ...]:
        """Edges of all rings, and the segments."""
        return (*(edge for ring in self.rings for edge in pairwise((*ring, ring[0]))), *self.segments)

    @checked
    def overlaps(self, position: Sequence[Number]) -> bool:
        """True if the part overlaps at this position of its reference point, decided exactly; touching does not."""
        x, y = position
        return self.sums.cover((to_fraction(x), to_fraction(y)))

    @checked
    def nearest(self, position: Sequence[Number]) -> ExactPoint | None:
        """Return the position in contact that is nearest to a position, exactly; None if there is none."""
        x, y = position
        place = to_fraction(x), to_fraction(y)
        feet = [along(p, foot(place, p, q)[1], minus(q, p)) for p, q in self.edges]
        return min((*feet, *self.points), key=lambda p: _square(p, place), default=None)

    def to_shapely(self) -> BaseGeometry:
        """Return the region as a valid shapely geometry, rounded to doubles; exact fits of no width are left out."""
        import shapely

        lines = [shapely.LinearRing([(float(x), float(y)) for x, y in ring]) for ring in self.rings]
        return shapely.build_area(shapely.GeometryCollection(lines))

    def plot(self) -> Any:
        """Draw the region, and exact fits in another colour, by matplotlib; return the figure."""
        return registered("fit_picture")(self)


@dataclass(frozen=True, repr=False)
class NFP(_Fit):
    """No-fit polygon: the positions at which a moving part overlaps a fixed one.

    Attributes
    ----------
    rings : tuple of rings of exact points
        The overlap is on the left: outer rings run counter-clockwise, holes clockwise. On a ring the parts touch.
    segments : tuple of pairs of points
        Exact fits: positions on a segment at which the part touches on both sides, as a key in its slot.
    points : tuple of points
        Exact fits at a single position, as a part in a hole of its own shape.

    Notes
    -----
    The region is open: touching is no overlap. Equality compares rings, segments and points.
    """


@dataclass(frozen=True, repr=False)
class InnerFit(_Fit):
    """Inner-fit region: the positions at which a part is inside a container.

    Attributes
    ----------
    rings : tuple of rings of exact points
        The part fits on the left and on the rings: outer rings run counter-clockwise, holes clockwise.
    segments, points
        Exact fits, as of `NFP`.
    """

    @property
    def is_empty(self) -> bool:
        """True if the part fits nowhere at this orientation."""
        return not (self.rings or self.segments or self.points)


@checked
def nfp(fixed: Any, moving: Any, theta: Angle = 0) -> NFP | RoundedFit:
    """Return the no-fit polygon of a fixed and a moving part, exactly.

    Parameters
    ----------
    fixed, moving : shape or sequence of shapes
        Polygons with or without holes, or round shapes. The moving part is turned about the origin, its reference
        point.
    theta : Angle
        Orientation of the moving part: radians, "30deg" or {"tau": "1/3"}.

    Returns
    -------
    NFP, or RoundedFit if a shape is round

    Raises
    ------
    InvalidPolygonError
        If a shape is not a polygon.
    UnsupportedError
        If a shape has curves other than convex arcs of rational radii.

    Notes
    -----
    Time is about linear in the product of the numbers of convex pieces, about 0.1 s for two parts of 35 vertices.
    For many orientations of the same parts `RotationalNFP` is faster.

    Examples
    --------
    A square fits its own slot exactly, on a segment that other no-fit polygons drop:

    >>> slot = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (3, 2), (3, 3), (0, 3)]
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> result = nfp(slot, square)
    >>> result, [tuple(map(float, p)) for p in result.segments[0]]
    (<NFP of 1 ring, 4 vertices; exact fits: 1 segment, 0 points>, [(1.0, 1.0), (3.0, 1.0)])
    >>> result.overlaps((2, 1)), result.overlaps((2, "1.0001"))
    (False, True)
    """
    solids, parts = shapes_in(fixed, "fixed"), shapes_in(moving, "moving")
    pose = Pose(0, 0, theta)
    if (fixed_ones := polygons_in(solids)) is None or (moving_ones := polygons_in(parts)) is None:
        return rounded_fit(Scene(parts, solids), pose)
    return nfp_of(fixed_ones, turned(moving_ones, pose))


@checked
def inner_fit(container: Any, part: Any, theta: Angle = 0) -> InnerFit | RoundedFit:
    """Return the inner-fit region of a part in a container, exactly.

    Parameters
    ----------
    container : shape
        One shape; the part must keep out of its holes as well.
    part : shape or sequence of shapes
        Turned about the origin, its reference point.
    theta : Angle
        Orientation of the part.

    Returns
    -------
    InnerFit, or RoundedFit if a shape is round

    Examples
    --------
    >>> sheet = [(0, 0), (10, 0), (10, 6), (0, 6)]
    >>> inner_fit(sheet, [(0, 0), (4, 0), (4, 2), (0, 2)]).area
    24.0
    >>> inner_fit(sheet, [(0, 0), (10, 0), (10, 2), (0, 2)]).segments
    (((Fraction(0, 1), Fraction(0, 1)), (Fraction(0, 1), Fraction(4, 1))),)
    >>> inner_fit(sheet, [(0, 0), (11, 0), (0, 1)]).is_empty
    True
    """
    outer, parts = shapes_in(container, "container"), shapes_in(part, "part")
    if len(outer) != 1:
        raise ValueError(f"container: {len(outer)} polygons; give one, whose holes are forbidden")
    pose = Pose(0, 0, theta)
    if (containers := polygons_in(outer)) is None or (moving := polygons_in(parts)) is None:
        return rounded_fit(Scene(parts, workspace=outer[0]), pose)
    return inner_fit_of(containers[0], turned(moving, pose))


def nfp_of(solids: Sequence[Polygon], parts: Sequence[Polygon]) -> NFP:
    """Return the no-fit polygon of polygons that are turned already."""
    sums = sums_of(solids, parts)
    return NFP(*outlines(sums), sums)


def inner_fit_of(container: Polygon, parts: Sequence[Polygon]) -> InnerFit:
    """Return the inner-fit region of polygons that are turned already."""
    sums = sums_of(complement(container, parts), parts)
    (x0, y0, x1, y1), (u0, v0, u1, v1) = box_of([container]), box_of(parts)

    def is_within(point: ExactPoint) -> bool:
        return x0 - u0 <= point[0] <= x1 - u1 and y0 - v0 <= point[1] <= y1 - v1

    around = outlines(sums)
    fits = Outlines(
        tuple(_backwards(ring) for ring in around.rings if is_within(ring[0])),
        tuple(segment for segment in around.segments if is_within(segment[0])),
        tuple(filter(is_within, around.points)),
    )
    return InnerFit(*fits, sums)


def turned(shapes: Iterable[AnyShape], pose: Pose) -> list[Any]:
    """Return shapes at a pose, the same objects if it moves nothing."""
    is_still = not (pose.x or pose.y) and pose.tau == 0
    return [shape if is_still else moved_shape(shape, pose) for shape in shapes]


def polygons_in(shapes: Sequence[AnyShape]) -> list[Polygon] | None:
    """Return shapes that are all polygons; None if one is round."""
    polygons = [shape for shape in shapes if isinstance(shape, Polygon)]
    return polygons if len(polygons) == len(shapes) else None


def _backwards(ring: Ring) -> Ring:
    return ring[:1] + ring[:0:-1]


def _square(p: ExactPoint, q: ExactPoint) -> Fraction:
    return (p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2
