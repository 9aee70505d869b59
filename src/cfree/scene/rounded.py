"""Rounded shapes, which the core trims exactly: points, segments, and polygons with arcs as sides, grown by discs.

Polygons, grown polygons, discs, and shapes of lines and convex arcs of rational radii are rounded shapes.
docs/theory/rounded-shapes.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING

import cfree._core as _core
from cfree.curves.curved import Curved
from cfree.curves.drawn import Line
from cfree.curves.pieces import quarters_of
from cfree.curves.rings import Circle, Piece, Span
from cfree.errors import InvalidPolygonError
from cfree.exact.number import ExactPoint, rational_root
from cfree.exact.vectors import cross, dot, minus
from cfree.polygons.polygon import Polygon

if TYPE_CHECKING:
    from cfree.scene.scene import AnyShape, Scene


FINEST_CUTS = 5  # of a quarter circle in halves, for chords that meet no other side


@dataclass(frozen=True, slots=True)
class CoreArc:
    """A convex arc in place of a side of a core, counter-clockwise and at most a quarter circle."""

    start: ExactPoint
    end: ExactPoint
    center: ExactPoint
    radius: Fraction

    @property
    def numbers(self) -> tuple[Fraction, ...]:
        """All of its numbers, in the core's order."""
        return *self.start, *self.end, *self.center, self.radius


def is_arc(arc: CoreArc) -> bool:
    """True if an arc has its radius, is counter-clockwise, and has at most a quarter of its circle."""
    first, last = minus(arc.start, arc.center), minus(arc.end, arc.center)
    squares = {dot(first, first), dot(last, last), arc.radius**2}
    return len(squares) == 1 and arc.radius > 0 and cross(first, last) > 0 and dot(first, last) >= 0


@dataclass(frozen=True)
class Rounded:
    """A core grown by a disc.

    Attributes
    ----------
    core : Polygon, or tuple of one or two points
    radius : Fraction
    arcs : tuple of CoreArc
        In place of some of the polygon's sides.
    """

    core: Polygon | tuple[ExactPoint, ...]
    radius: Fraction
    arcs: tuple[CoreArc, ...] = ()

    @property
    def handle(self) -> _core.Polygon:
        """The core's form of `core`."""
        if isinstance(self.core, Polygon):
            return self.core._handle
        thin = _core.Polygon.thin([list(p) for p in self.core])
        assert thin is not None, "its numbers are fractions"
        return thin

    @property
    def rounding(self) -> tuple[Fraction, list[tuple[Fraction, ...]]]:
        """The core's form of the rest."""
        return self.radius, [arc.numbers for arc in self.arcs]


@dataclass(frozen=True)
class Cores:
    """Rounded shapes in place of those of a scene.

    Attributes
    ----------
    robot, obstacles : tuple of Rounded
    """

    robot: tuple[Rounded, ...]
    obstacles: tuple[Rounded, ...]

    @property
    def is_round(self) -> bool:
        """True if a shape is no polygon."""
        return any(shape.arcs or shape.radius for shape in (*self.robot, *self.obstacles))


def rounded(shape: AnyShape) -> Rounded | None:
    """Return a shape as a grown core; None if it is none, or a radius is irrational.

    Examples
    --------
    >>> disc = rounded(Curved.circle((1, 2), "1/3"))
    >>> disc.core == ((1, 2),), disc.radius
    (True, Fraction(1, 3))
    >>> from cfree.curves import Arc
    >>> stadium = Curved([(0, 0), (4, 0), Arc((4, 2), center=(4, 1)), (0, 2), Arc((0, 0), center=(0, 1))])
    >>> [tuple(map(int, p)) for p in rounded(stadium).core], rounded(Curved.ellipse((0, 0), (1, 2))) is None
    ([(4, 1), (0, 1)], True)
    >>> half = rounded(Curved([(1, 0), Arc((-1, 0), center=(0, 0))]))
    >>> [tuple(map(int, p)) for p in half.core.exact_vertices], half.radius, len(half.arcs)
    ([(1, 0), (0, 1), (-1, 0)], Fraction(0, 1), 2)
    """
    if isinstance(shape, Polygon):
        return Rounded(shape, Fraction(0))
    if shape.grown and shape.is_polygon:
        return Rounded(shape._base(), shape.grown)
    if isinstance(shape.path, Circle) and not shape.holes:
        return Rounded((shape.path.center,), shape.path.radius + shape.grown)
    found = None if shape.holes else _convex(shape.curves[0])
    found = found or _with_arcs(shape)
    return None if found is None else Rounded(found.core, found.radius + shape.grown, found.arcs)


def _convex(ring: Sequence[Piece]) -> Rounded | None:
    """Return a convex ring of lines and of arcs of one radius, all tangent."""
    radius, centers = None, list[ExactPoint]()
    for before, piece in zip([ring[-1], *ring[:-1]], ring, strict=True):
        if cross(_direction(before, at_end=True), _direction(piece, at_end=False)) != 0:
            return None
        if dot(_direction(before, at_end=True), _direction(piece, at_end=False)) < 0:
            return None
        if isinstance(piece, Line):
            continue
        if not isinstance(piece, Span) or not piece.is_circular:
            return None
        square = dot(piece.u, piece.u)
        if radius is not None and square != radius * radius:
            return None
        radius = rational_root(square)
        if radius is None or piece.sense != _turn(ring):
            return None
        if piece.center not in centers:
            centers.append(piece.center)
    if radius is None:
        return None
    core: Polygon | tuple[ExactPoint, ...] = tuple(centers) if len(centers) < 3 else Polygon(centers)
    return Rounded(core, radius)


def _turn(ring: Sequence[Piece]) -> int:
    """Return the sense of the first arc: that of a convex ring."""
    return next(piece.sense for piece in ring if isinstance(piece, Span))


def _direction(piece: Piece, *, at_end: bool) -> ExactPoint:
    """Return the direction of a line or an arc at one of its ends; of other curves from end to end."""
    if isinstance(piece, Line):
        return minus(piece.end, piece.start)
    if not isinstance(piece, Span):
        return Fraction(0), Fraction(0)
    place = piece.end if at_end else piece.at(0, Fraction(0))
    x, y = minus(place, piece.center)
    return -piece.sense * y, piece.sense * x


# --- arcs in place of sides ---

Side = tuple[ExactPoint, ExactPoint, Span | None]


def _with_arcs(shape: Curved) -> Rounded | None:
    """Return a shape of lines and convex arcs, as the polygon of their chords; None if it is none."""
    rings: list[list[Side]] = []
    for r, ring in enumerate(shape.curves):
        sides = _sides(ring, is_hole=r > 0)
        if sides is None:
            return None
        rings.append(sides)
    for cuts in range(FINEST_CUTS + 1):
        if (found := _on_chords([list(_cut(ring, 2**cuts)) for ring in rings])) is not None:
            return found
    return None


def _sides(ring: Sequence[Piece], *, is_hole: bool) -> list[Side] | None:
    """Return lines and quarters of convex arcs, the shape on their left; None if there are others, or cusps."""
    sides: list[Side] = []
    for piece in ring:
        if isinstance(piece, Line):
            sides.append((piece.start, piece.end, None))
            continue
        if not isinstance(piece, Span) or not piece.is_circular or rational_root(dot(piece.u, piece.u)) is None:
            return None
        for center, u, v, rest in quarters_of(piece):
            part = Span(center, u, v, 0, rest) if rest < 1 else Span(center, u, v, 1, Fraction(0))
            sides.append((part.at(0, Fraction(0)), part.end, part))
    within = [float(cross(start, end)) for start, end, _ in sides]  # twice the area
    beyond = [arc.sense * (arc.sweep - math.sin(arc.sweep)) * float(dot(arc.u, arc.u)) for *_, arc in sides if arc]
    if (math.fsum(within + beyond) < 0) != is_hole:
        sides = [(end, start, arc and _reversed(arc)) for start, end, arc in reversed(sides)]
    for before, after in zip([sides[-1], *sides[:-1]], sides, strict=True):
        into, out = _towards(before, at_end=True), _towards(after, at_end=False)
        if (after[2] and after[2].sense < 0) or (cross(into, out) == 0 and dot(into, out) < 0):
            return None
    return sides


def _reversed(arc: Span) -> Span:
    u = minus(arc.end, arc.center)
    return Span(arc.center, u, (arc.sense * u[1], -arc.sense * u[0]), arc.quarters, arc.rest)


def _towards(side: Side, *, at_end: bool) -> ExactPoint:
    start, end, arc = side
    return _direction(arc or Line(start, end), at_end=at_end)


def _cut(ring: Sequence[Side], parts: int) -> Iterator[Side]:
    for start, end, arc in ring:
        if arc is None or parts == 1:
            yield start, end, arc
            continue
        places = [start, *(arc.at(0, _half_tangent(arc.sweep * k / parts)) for k in range(1, parts)), end]
        for first, last in pairwise(places):
            yield first, last, arc


def _half_tangent(angle: float) -> Fraction:
    """Return a simple number near the tangent of half an angle below a quarter turn."""
    return Fraction(round(math.tan(angle / 2) * 256), 256)


def _on_chords(rings: Sequence[Sequence[Side]]) -> Rounded | None:
    """Return the polygon of chords with its arcs; None if it is no polygon, or has not all ends of arcs as vertices."""
    try:
        outer, *holes = ([start for start, _, _ in ring] for ring in rings)
        core = Polygon(outer, holes)
    except InvalidPolygonError:
        return None
    arcs = []
    for start, end, arc in (side for ring in rings for side in ring):
        if arc is None:
            continue
        radius = rational_root(dot(arc.u, arc.u))
        assert radius is not None, "it has been looked at"
        arcs.append(CoreArc(start, end, arc.center, radius))
    vertices, next_of = core.exact_vertices, core.next
    chords = {(vertices[k], vertices[int(next_of[k])]) for k in range(len(vertices))}
    if any((arc.start, arc.end) not in chords for arc in arcs):
        return None
    return Rounded(core, Fraction(0), tuple(arcs))


def is_disc_about_reference(scene: Scene) -> bool:
    """True if all of the robot's shapes are discs about its reference point: nothing depends on its orientation."""
    paths = [shape.path if isinstance(shape, Curved) and not shape.holes else None for shape in scene.robot]
    return all(isinstance(path, Circle) and not any(path.center) for path in paths)


def why_not_rounded(scene: Scene) -> str:
    """Explain which shape keeps a scene from being one of rounded shapes, and what to do.

    Examples
    --------
    >>> from cfree.scene.scene import Scene
    >>> print(why_not_rounded(Scene(Curved.circle((0, 0), 1), [Curved.ellipse((3, 0), (1, 2))])))
    obstacle 0: not bounded by lines and convex arcs of rational radii; ...
    """
    remedy = "give scene.outer(error) or scene.inner(error), on the command line what cfree convert --outer writes"
    if isinstance(scene.workspace, Curved):
        return f"workspace: round; give it as a polygon, or {remedy}"
    names = [f"robot[{k}]" if len(scene.robot) > 1 else "robot" for k in range(len(scene.robot))]
    shapes = zip((*names, *scene.obstacle_names), (*scene.robot, *scene.obstacles), strict=True)
    name = next(name for name, shape in shapes if rounded(shape) is None)
    return f"{name}: not bounded by lines and convex arcs of rational radii; {remedy}"


def rounded_shapes(scene: Scene) -> Cores | None:
    """Return the cores of a scene's robot and obstacles; None if a shape is not rounded."""
    if isinstance(scene.workspace, Curved):
        return None
    robot, obstacles = ([rounded(shape) for shape in shapes] for shapes in (scene.robot, scene.obstacles))
    parts, others = [x for x in robot if x], [x for x in obstacles if x]
    return Cores(tuple(parts), tuple(others)) if len(parts + others) == len(robot + obstacles) else None
