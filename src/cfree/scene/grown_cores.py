"""Cores grown by discs: points, segments, and polygons with arcs as sides. `rounded.py` finds them in shapes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, cast

import cfree._core as _core
from cfree.exact.number import ExactPoint
from cfree.exact.vectors import cross, dot, minus
from cfree.polygons.polygon import Polygon

if TYPE_CHECKING:
    from cfree.scene.scene import AnyShape


@dataclass(frozen=True, slots=True)
class CoreArc:
    """An arc in place of a side of a core, counter-clockwise and at most a quarter circle.

    A concave arc is clockwise, and in place of two sides that meet in `beyond[0]`. The triangle of its ends and
    `beyond[1]` is in the shape but for the disc; `beyond[0]` is inside it.
    """

    start: ExactPoint
    end: ExactPoint
    center: ExactPoint
    radius: Fraction
    beyond: tuple[ExactPoint, ExactPoint] | None = None

    @property
    def is_convex(self) -> bool:
        return self.beyond is None

    @property
    def signed_radius(self) -> Fraction:
        """The radius; negative if the arc is concave."""
        return self.radius if self.is_convex else -self.radius

    @property
    def numbers(self) -> tuple[Fraction, ...]:
        """All of its numbers, in the core's order."""
        more = (*self.beyond[0], *self.beyond[1]) if self.beyond else ()
        return *self.start, *self.end, *self.center, self.radius, *more


def is_arc(arc: CoreArc) -> bool:
    """True if an arc has its radius, the direction of its kind, and at most a quarter of its circle."""
    first, last = minus(arc.start, arc.center), minus(arc.end, arc.center)
    squares = {dot(first, first), dot(last, last), arc.radius**2}
    turn = cross(first, last) if arc.is_convex else cross(last, first)
    return len(squares) == 1 and arc.radius > 0 and turn > 0 and dot(first, last) >= 0


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
    def has_concave(self) -> bool:
        """True if a side of the core is a concave arc."""
        return any(not arc.is_convex for arc in self.arcs)

    @property
    def is_disc(self) -> bool:
        """True if the core is one point."""
        return len(self.points) == 1

    @property
    def points(self) -> Sequence[ExactPoint]:
        """The core's vertices."""
        return self.core.exact_vertices if isinstance(self.core, Polygon) else self.core

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
    frames : int
        How many of the last obstacles are the complement of a round workspace; see `cfree.scene.complement`.
    """

    robot: tuple[Rounded, ...]
    obstacles: tuple[Rounded, ...]
    frames: int = 0

    @property
    def has_concave(self) -> bool:
        """True if a side of a core is a concave arc."""
        return any(shape.has_concave for shape in (*self.robot, *self.obstacles))

    def straight(self, workspace: AnyShape | None) -> Polygon | None:
        """Return the scene's workspace if it is a polygon; a round one is among the obstacles."""
        return None if self.frames else cast("Polygon | None", workspace)

    @property
    def is_round(self) -> bool:
        """True if a shape is no polygon."""
        return any(shape.arcs or shape.radius for shape in (*self.robot, *self.obstacles))
