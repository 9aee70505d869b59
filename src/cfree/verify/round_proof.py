"""A separation among rounded shapes as data: cores with arcs, features, the pieces of a closed surface, two poses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.forbidden.columns import Trapezoids
from cfree.polygons.polygon import Polygon
from cfree.scene.grown_cores import Rounded

if TYPE_CHECKING:
    from cfree.scene.features import ShapeFeatures

BOUNDS, WORKSPACE = -1, -2


@dataclass(frozen=True)
class Features:
    """Numbered points and edges of cores: corners, centers of arcs, and others that only name curves.

    Attributes
    ----------
    points : exact points
    edges : pairs of numbers of points
    owners : numbers
        For each point its core; -1 the bounds, or the reference point; -2 the workspace.
    radii : Fraction each
        By which each point is grown; an edge is grown as its first point.
    """

    points: tuple[ExactPoint, ...]
    edges: tuple[tuple[int, int], ...]
    owners: tuple[int, ...]
    radii: tuple[Fraction, ...]

    @classmethod
    def numbered(cls, shape: ShapeFeatures) -> Features:
        """Take the features of a scene in its numbering."""
        points = tuple((Fraction(x, shape.scale), Fraction(y, shape.scale)) for x, y in shape.vertices)
        rings, ends = shape.owner_polygon.tolist(), shape.owner_of_end.tolist()
        owners = [*rings, *[BOUNDS] * (len(points) - len(rings) - len(ends)), *ends]
        edges = tuple(zip(map(int, shape.v), map(int, shape.w), strict=True))
        radii = [Fraction(r, shape.scale) for r in shape.core.radius] or [Fraction(0)] * len(points)
        return cls(points, edges, tuple(owners), tuple(radii))


@dataclass(frozen=True, eq=False)
class RoundSeparation:
    """Rounded shapes, and pieces of contact surfaces that separate two poses.

    Attributes
    ----------
    robot : sequence of Rounded
    obstacles : sequence of Rounded
        In the order of the scene's obstacles.
    robot_features, obstacle_features : Features
    kind : (N,) uint8
        1 a vertex of the robot on an edge, 2 an edge of the robot on a vertex, 3 + 16 quadrant two vertices.
    robot_feature, obstacle_feature : (N,) int32
    table : Trapezoids
        Their angles and curves; piece k is on patch k.
    start, goal : Pose
    bounds : four numbers, optional
        Larger bounds than the scene's.
    workspace : Polygon, optional
    frames : int
        How many of the last obstacles are the complement of a round workspace.
    """

    robot: Sequence[Rounded]
    obstacles: Sequence[Rounded]
    robot_features: Features
    obstacle_features: Features
    kind: NDArray[np.uint8]
    robot_feature: NDArray[np.int32]
    obstacle_feature: NDArray[np.int32]
    table: Trapezoids
    start: Pose
    goal: Pose
    bounds: tuple[Fraction, Fraction, Fraction, Fraction] | None = None
    workspace: Polygon | None = None
    frames: int = 0

    def __len__(self) -> int:
        return len(self.kind)
