"""Shapes with round edges, and polygons around them and inside, to any precision.

docs/theory/curved-shapes.md has the proofs.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from cfree.arguments import checked
from cfree.curves.hulls import FINEST, Outline, is_short, polygon_of
from cfree.curves.pieces import Box, Frame, box_of, drawn_of, hull_points, is_proved
from cfree.curves.rings import Circle, Ellipse, GivenRing, Piece, Point, Span, exact_ring, given_ring
from cfree.errors import InvalidPolygonError, InvariantError, UndecidedError, UnsupportedError
from cfree.exact.half_angle import Angle
from cfree.exact.number import ExactPoint, Number, to_fraction
from cfree.polygons.disc import around_disc, inside_disc
from cfree.polygons.minkowski import convex_sum
from cfree.polygons.polygon import Polygon
from cfree.value import Shown
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.curves.healing import Change

ROUGH = 64  # the constructor checks a shape with an error of its size / ROUGH
LEAST_SIDES, MOST_SIDES = 8, 4096  # sides of polygons for discs
KEPT = 4096  # cached polygons
REFUSED = (
    "there are round shapes, and this takes polygons; give scene.outer(error) or scene.inner(error), "
    "on the command line what cfree convert --outer or --inner writes"
)


@checked
@dataclass(frozen=True, init=False, repr=False)
class Curved(Shown):
    """A shape with round edges, or a polygon grown by a disc.

    Parameters
    ----------
    path : sequence of points (x, y), `Arc`, `Bezier` and `Spline`, or a `Circle` or an `Ellipse`
        The outer ring, in either direction. A path begins with a point; a point in it is the end of a line, and a line
        closes it.
    holes : sequence of the same
    grown : number
        All points within this distance also belong to the shape; its rings must then consist of lines.

    Raises
    ------
    InvalidPolygonError
        If the rings bound no shape; the message has place, value and remedy.

    Notes
    -----
    All numbers and curves are exact; the inside is the region that a ring goes around. Polygons with an error of at
    most a 64th of the size detect rings that cross themselves, so a ring that nearly touches itself may be refused.

    Examples
    --------
    >>> from cfree.curves import Arc
    >>> stadium = Curved([(0, 0), (4, 0), Arc((4, 2), center=(4, 1)), (0, 2), Arc((0, 0), center=(0, 1))])
    >>> (around,), (within,) = stadium.outer(0.01), stadium.inner(0.01)
    >>> [round(float(polygon.exact_area), 2) for polygon in (within, around)], round(8 + math.pi, 2)
    ([11.11, 11.16], 11.14)
    >>> car = Curved([(0, 0), (4, 0), (4, 1), (0, 1)], grown="1/2")
    >>> [float(b) for b in car.box]
    [-0.5, -0.5, 4.5, 1.5]
    """

    path: GivenRing
    holes: tuple[GivenRing, ...]
    grown: Fraction

    def __init__(self, path: Sequence[Any] | Circle | Ellipse, holes: Sequence[Any] = (), *, grown: Number = 0) -> None:
        values = {"path": given_ring(path), "holes": tuple(map(given_ring, holes)), "grown": to_fraction(grown)}
        for name, value in values.items():
            object.__setattr__(self, name, value)
        if self.grown < 0:
            raise InvalidPolygonError(f"grown: {grown}; give a length, 0 or more")
        try:
            error = self.size / ROUGH
            if not error:
                raise InvalidPolygonError("it is smaller than doubles can tell; scale the shape")
            if self.grown:
                self._base()
            else:
                self.outer(error)
        except OverflowError:
            raise InvalidPolygonError("a coordinate is beyond the range of doubles; scale the shape") from None

    @staticmethod
    @checked
    def circle(center: Point, radius: Number) -> Curved:
        """Return a disc.

        Examples
        --------
        >>> Curved.circle((1, "1/3"), 2).box
        (Fraction(-1, 1), Fraction(-5, 3), Fraction(3, 1), Fraction(7, 3))
        """
        return Curved(Circle(center, radius))

    @staticmethod
    @checked
    def ellipse(center: Point, radii: Sequence[Number], angle: Angle = 0) -> Curved:
        """Return the inside of an ellipse; `angle`, as in `cfree.Pose`, leads from the x-axis to its first radius."""
        return Curved(Ellipse(center, radii, angle))

    def __repr__(self) -> str:
        x0, y0, x1, y1 = map(float, self.box)
        return f"<Curved in ({x0:g}, {y0:g}, {x1:g}, {y1:g}), {counted(len(self.holes), 'hole')}>"

    def __getattr__(self, name: str) -> Any:
        if name == "_handle" or (hasattr(Polygon, name) and not name.startswith("__")):
            raise UnsupportedError(REFUSED)
        raise AttributeError(name)

    def __len__(self) -> int:
        raise UnsupportedError(REFUSED)

    def __bool__(self) -> bool:
        return True

    @property
    def curves(self) -> tuple[tuple[Piece, ...], ...]:
        """Outer ring and holes, as exact lines, spans of ellipses and cubic Bézier curves."""
        return tuple(map(_pieces, (self.path, *self.holes)))

    @property
    def box(self) -> tuple[Fraction, Fraction, Fraction, Fraction]:
        """Least x and y, greatest x and y: exact if rational, else at most a 2**20th of the size off."""
        x0, y0, x1, y1 = box = _box_of(self.path)
        if not self.grown:
            return box
        return x0 - self.grown, y0 - self.grown, x1 + self.grown, y1 + self.grown

    @property
    def size(self) -> float:
        """Longer side of the box."""
        x0, y0, x1, y1 = self.box
        return float(max(x1 - x0, y1 - y0))

    @property
    def least_error(self) -> float:
        """Least error of polygons for the shape; doubles are too coarse for less."""
        disc, curves = float(self.grown) * 2**-18, 4 * FINEST * self.size
        return curves if not self.grown else disc if self.is_polygon else 2 * max(disc, curves)

    @checked
    def outer(self, error: float) -> tuple[Polygon, ...]:
        """Return a polygon proved to contain the shape; for a grown shape, one for each convex piece.

        Parameters
        ----------
        error : float
            No point of the polygon's boundary is farther from the shape.

        Raises
        ------
        ValueError
            If the error is less than `least_error`.
        UndecidedError
            If no polygon can be proved to contain it. A hole too thin to have a polygon inside is filled.

        Examples
        --------
        >>> (octagon,) = Curved.circle((0, 0), 1).outer(0.2)
        >>> len(octagon), all(math.hypot(x, y) > 1 for x, y in octagon.vertices)
        (8, True)
        """
        return self._polygons(error, inside=False)

    @checked
    def inner(self, error: float) -> tuple[Polygon, ...]:
        """Return a polygon proved to be inside, no boundary point farther than `error` from the shape's boundary.

        The tuple is empty if none can be proved: the shape is too thin for doubles, or has cusps. Parameters are those
        of `outer`.

        Examples
        --------
        >>> (octagon,) = Curved.circle((0, 0), 1).inner(0.2)
        >>> len(octagon), all(math.hypot(x, y) < 1 for x, y in octagon.vertices)
        (8, True)
        """
        return self._polygons(error, inside=True)

    @checked
    def healed(self, tolerance: float | None = None) -> Curved:
        """Return the shape with arcs exactly tangent to lines and arcs where they nearly are, and with rational radii.

        Parameters
        ----------
        tolerance : float, optional
            Ends of pieces and middles of arcs move by this length at most; a joint that needs more stays as it is. The
            default is a billionth of the size.

        Notes
        -----
        Lines at such arcs get directions that are rational unit vectors; axis-parallel ones stay as they are. Radii
        become simple numbers, but for two in a chain of arcs. Corners of more than 0.01 radians stay. An arc between
        two of them keeps its ends, and gets a rational radius. So most shapes of lines and arcs become exact for
        `cfree.boundary`.

        Examples
        --------
        >>> from cfree.curves import Arc
        >>> bend = Arc(("3.70710678", "0.29289322"), through=("3.38268343", "0.07612047"))
        >>> arc = Curved([(0, 0), (3, 0), bend, (5, "1.58578644"), (0, 6)]).healed(1e-6).path[2]
        >>> arc.center[1], arc.to != bend.to
        (Fraction(1, 1), True)
        """
        return healed_with_changes(self, self.size * 1e-9 if tolerance is None else tolerance)[0]

    def _polygons(self, error: float, *, inside: bool) -> tuple[Polygon, ...]:
        if not self.least_error <= error < math.inf:
            raise ValueError(f"error {error}: give a length, {self.least_error:.3g} or more")
        if self.grown and self.is_polygon:
            return _grown(self._base(), self.grown, error, inside)
        if self.grown:
            bases = self._grown_by(-self.grown)._polygons(error / 2, inside=inside)
            return tuple(part for base in bases for part in _grown(base, self.grown, error / 2, inside))
        result = _placed(self, error, inside)
        if isinstance(result, Polygon):
            return (result,)
        if inside:
            return ()
        if isinstance(result, InvalidPolygonError) and result.edges:  # of the polygon
            from cfree.curves.crossings import crossing

            place = crossing(self.curves, (self.path, *self.holes))
            result = InvalidPolygonError(f"{place}; divide the shape there, or move them apart", ring=result.ring)
        raise result.with_traceback(None)

    @property
    def _frame(self) -> Frame:
        """Frame of the shape's size, with a point of short coordinates as origin."""
        first, (x0, y0, x1, y1) = self.curves[0][0], self.box
        (x, y), *_ = hull_points(first)
        if isinstance(first, Span) and x0 <= first.center[0] <= x1 and y0 <= first.center[1] <= y1:
            x, y = first.center
        scale, zero = Fraction(2) ** math.frexp(self.size)[1], Fraction(0)
        if not is_short((x, y)):
            step = scale / 1024
            x, y = round(x / step) * step, round(y / step) * step
        return Frame((x, y), (scale, zero), (zero, scale))

    @property
    def is_polygon(self) -> bool:
        """True if its rings, without growth, are polygons."""
        rings = (self.path, *self.holes)
        return all(isinstance(ring, tuple) and all(isinstance(p, tuple) for p in ring) for ring in rings)

    def _grown_by(self, by: Fraction) -> Curved:
        """Return the shape grown further, whatever its curves; files and `Curved` itself take grown polygons only."""
        other = copy(self)
        object.__setattr__(other, "grown", self.grown + by)
        return other

    def _base(self) -> Polygon:
        rings = (self.path, *self.holes)
        if not self.is_polygon:
            raise UnsupportedError("grown: of polygons only; give the larger circle, or a path of points")
        outer, *holes = rings
        return Polygon(outer, holes)  # type: ignore[arg-type]


def healed_with_changes(shape: Curved, tolerance: float) -> tuple[Curved, list[Change]]:
    """Return the shape that `Curved.healed` returns, and its arcs that changed."""
    if not 0 < tolerance < math.inf:
        raise ValueError(f"tolerance {tolerance}: give a length above 0")
    if shape.grown:
        return shape, []
    from cfree.curves.healing import healed_ring
    from cfree.curves.rational_radii import with_rational_radii

    rings, changes = [], []
    for pieces, ring in zip(shape.curves, (shape.path, *shape.holes), strict=True):
        for heal in (healed_ring, with_rational_radii):
            ring, its = heal(pieces, tolerance) or (ring, [])
            pieces = _pieces(ring)
            changes += its
        rings.append(ring)
    try:
        return (Curved(rings[0], rings[1:]), changes) if changes else (shape, [])
    except InvalidPolygonError:  # a tolerance as large as the shape
        return shape, []


@lru_cache(KEPT)
def _pieces(ring: GivenRing) -> tuple[Piece, ...]:
    return tuple(exact_ring(ring))


@lru_cache(KEPT)
def _box_of(ring: GivenRing) -> Box:
    return box_of(_pieces(ring))


# Curves without a polygon inside -> the largest error tried for it, and the fault, which has the smallest.
_nothing_inside: dict[tuple[tuple[Piece, ...], ...], tuple[float, UndecidedError]] = {}


@lru_cache(KEPT)
def _near(curves: tuple[tuple[Piece, ...], ...], error: float, inside: bool) -> Polygon | Exception:
    """Return the polygon around curves, or inside; or the reason why there is none."""
    if inside and curves in _nothing_inside:
        most, fault = _nothing_inside[curves]
        if fault.error <= error <= most:
            return fault
    outer, *holes = map(drawn_of, curves)
    try:
        return polygon_of(Outline(outer, tuple(holes), curves), error, inside)
    except InvalidPolygonError as crossing:
        return crossing
    except UndecidedError as fault:
        if inside:
            if len(_nothing_inside) == KEPT:
                _nothing_inside.clear()
            _nothing_inside[curves] = error, fault
        return fault


@lru_cache(KEPT)
def _placed(shape: Curved, error: float, inside: bool) -> Polygon | Exception:
    """Return the polygon around a shape without growth, or inside; or the reason why there is none."""
    frame = shape._frame
    result = _near(tuple(tuple(frame.local(curve)) for curve in shape.curves), error / frame.length, inside)
    if isinstance(result, Polygon):
        outer, *holes = ([frame.world(p) for p in ring] for ring in result.exact_rings)
        return Polygon(outer, holes)
    return result


@lru_cache(KEPT)
def _grown(polygon: Polygon, radius: Fraction, error: float, inside: bool) -> tuple[Polygon, ...]:
    """Minkowski sums of the polygon's convex pieces and a polygon for the disc."""
    share = error / float(radius)
    turn = math.acos(max(0.0, 1 - share / 2) if inside else 1 / (1 + share / 2))
    sides = min(max(LEAST_SIDES, 4 * math.ceil(math.pi / (4 * turn))), MOST_SIDES)
    ring = [(radius * x, radius * y) for x, y in _disc(sides, inside)]
    return tuple(Polygon(convex_sum([polygon.exact_vertices[k] for k in piece], ring)) for piece in polygon.pieces)


@lru_cache(KEPT)
def _disc(sides: int, inside: bool) -> tuple[ExactPoint, ...]:
    """Return a polygon proved to be around the disc of radius 1, or inside."""
    one = Fraction(1)
    ring = (inside_disc if inside else around_disc)(one, sides)
    if not is_proved(Polygon(ring), 0, exact_ring(Circle((0, 0), one)), within=inside):
        raise InvariantError(f"a polygon of {sides} sides for a disc is not {'inside' if inside else 'around'} it")
    return tuple(ring)
