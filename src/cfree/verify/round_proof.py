"""A separation among grown cores as data: cores, radii, features, the pieces of a closed surface, and two poses."""

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

if TYPE_CHECKING:
    from cfree.scene.features import ShapeFeatures

Core = Polygon | tuple[ExactPoint, ...]  # a polygon, or the ends of a segment, or a point
BOUNDS, WORKSPACE = -1, -2


@dataclass(frozen=True)
class Features:
    """Numbered points and edges of cores, and of diagonals of their pieces.

    Attributes
    ----------
    points : exact points
    edges : pairs of numbers of points
    owners : numbers
        For each point its core; -1 the bounds, or the reference point; -2 the workspace.
    """

    points: tuple[ExactPoint, ...]
    edges: tuple[tuple[int, int], ...]
    owners: tuple[int, ...]

    @classmethod
    def numbered(cls, shape: ShapeFeatures) -> Features:
        """Take the features of a scene in its numbering."""
        points = tuple((Fraction(x, shape.scale), Fraction(y, shape.scale)) for x, y in shape.vertices)
        owners = [*shape.owner_polygon.tolist(), *[BOUNDS] * len(points)][: len(points)]
        edges = tuple(zip(map(int, shape.v), map(int, shape.w), strict=True))
        return cls(points, edges, tuple(owners))


@dataclass(frozen=True, eq=False)
class RoundSeparation:
    """Cores with radii, and pieces of contact surfaces that separate two poses.

    Attributes
    ----------
    robot : cores
    radius : Fraction
    obstacles : cores
        In the order of the scene's obstacles.
    radii : Fraction each
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
    """

    robot: Sequence[Core]
    radius: Fraction
    obstacles: Sequence[Core]
    radii: Sequence[Fraction]
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

    def __len__(self) -> int:
        return len(self.kind)
