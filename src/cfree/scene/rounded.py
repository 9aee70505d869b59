"""Rounded shapes: points, segments and polygons grown by discs, the shapes whose boundary of C the core trims exactly.

A polygon, a grown polygon, a disc, and a convex shape whose arcs of one radius are tangent to its lines are rounded
shapes. docs/theory/rounded-shapes.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

import cfree._core as _core
from cfree.curves.curved import Curved
from cfree.curves.drawn import Line
from cfree.curves.rings import Circle, Piece, Span
from cfree.exact.number import ExactPoint, rational_root
from cfree.exact.vectors import cross, dot, minus
from cfree.polygons.polygon import Polygon

if TYPE_CHECKING:
    from cfree.scene.scene import AnyShape, Scene


@dataclass(frozen=True)
class Rounded:
    """A core grown by a disc.

    Attributes
    ----------
    core : Polygon, or tuple of one or two points
    radius : Fraction
    """

    core: Polygon | tuple[ExactPoint, ...]
    radius: Fraction

    @property
    def handle(self) -> _core.Polygon:
        """The core's form of `core`."""
        if isinstance(self.core, Polygon):
            return self.core._handle
        thin = _core.Polygon.thin([list(p) for p in self.core])
        assert thin is not None, "its numbers are fractions"
        return thin


@dataclass(frozen=True)
class Cores:
    """Rounded shapes in place of those of a scene.

    Attributes
    ----------
    robot : tuple of Rounded
        Its parts, of one radius.
    obstacles : tuple of Rounded
    """

    robot: tuple[Rounded, ...]
    obstacles: tuple[Rounded, ...]


def rounded(shape: AnyShape) -> Rounded | None:
    """Return a shape as a grown core; None if it is none, or its radius is irrational.

    Examples
    --------
    >>> rounded(Curved.circle((1, 2), "1/3"))
    Rounded(core=((Fraction(1, 1), Fraction(2, 1)),), radius=Fraction(1, 3))
    >>> from cfree.curves import Arc
    >>> stadium = Curved([(0, 0), (4, 0), Arc((4, 2), center=(4, 1)), (0, 2), Arc((0, 0), center=(0, 1))])
    >>> [tuple(map(int, p)) for p in rounded(stadium).core], rounded(Curved.ellipse((0, 0), (1, 2))) is None
    ([(4, 1), (0, 1)], True)
    """
    if isinstance(shape, Polygon):
        return Rounded(shape, Fraction(0))
    if shape.grown and shape.is_polygon:
        return Rounded(shape._base(), shape.grown)
    if shape.holes:
        return None
    if isinstance(shape.path, Circle):
        return Rounded((shape.path.center,), shape.path.radius + shape.grown)
    found = _convex(shape.curves[0])
    return None if found is None else Rounded(found.core, found.radius + shape.grown)


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


def core_rings(shape: AnyShape) -> Sequence[int]:
    """Return where the rings of a rounded shape's core begin among its vertices, and their end."""
    if isinstance(shape, Polygon):
        return shape.ring_offsets
    found = rounded(shape)
    assert found is not None, "the scene has rounded shapes"
    return found.core.ring_offsets if isinstance(found.core, Polygon) else (0, len(found.core))


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
    obstacle 0: not a polygon, segment or point grown by a rational radius; ...
    """
    remedy = "give scene.outer(error) or scene.inner(error), on the command line what cfree convert --outer writes"
    if isinstance(scene.workspace, Curved):
        return f"workspace: round; give it as a polygon, or {remedy}"
    names = [f"robot[{k}]" if len(scene.robot) > 1 else "robot" for k in range(len(scene.robot))]
    for name, shape in zip((*names, *scene.obstacle_names), (*scene.robot, *scene.obstacles), strict=True):
        if rounded(shape) is None:
            return f"{name}: not a polygon, segment or point grown by a rational radius; {remedy}"
    radii = [part.radius for shape in scene.robot if (part := rounded(shape))]
    other = next(k for k, radius in enumerate(radii) if radius != radii[0])
    return (
        f"robot[{other}]: grown by {radii[other]}, and robot[0] by {radii[0]}; give its parts one radius, or {remedy}"
    )


def rounded_shapes(scene: Scene) -> Cores | None:
    """Return the cores of a scene's robot and obstacles; None if a shape is not rounded."""
    if isinstance(scene.workspace, Curved):
        return None
    robot, obstacles = ([rounded(shape) for shape in shapes] for shapes in (scene.robot, scene.obstacles))
    parts, others = [x for x in robot if x], [x for x in obstacles if x]
    if len(parts) < len(robot) or len(others) < len(obstacles) or len({part.radius for part in parts}) > 1:
        return None
    return Cores(tuple(parts), tuple(others))
