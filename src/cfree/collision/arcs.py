"""Exact poses and motions among shapes of segments and circular arcs: docs/theory/exact-arcs.md.

Centers and ends of arcs are rational, and so are squares of radii; radii need not be. Shapes with ellipses, Bézier
curves or splines have no exact form here: `arcs_of` returns None for their scenes.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise

import cfree._core as _core
from cfree.collision.motion import Motion, Rotation
from cfree.collision.slide import Slide
from cfree.curves.curved import Curved
from cfree.curves.drawn import Line
from cfree.curves.rings import Piece, Span
from cfree.errors import UnsupportedError
from cfree.exact.number import ExactPoint, common_denominator
from cfree.exact.pose import Pose
from cfree.libraries import NDArray, np
from cfree.polygons.polygon import Polygon
from cfree.scene.features import WORKSPACE
from cfree.scene.scene import AnyShape, Scene
from cfree.value import kept

FREE, UNCERTAIN = 1, 2  # the core's verdicts
KEPT = 1024  # cached shapes
Curve = tuple[ExactPoint, ExactPoint, ExactPoint, int]  # start, end, center, turn
NOWHERE = Fraction(0), Fraction(0)


class ArcScene:
    """A scene of segments and circular arcs, prepared once for the core.

    Attributes
    ----------
    core : ArcScene
        The core's form of it.
    poses, motions
        The core's checkers.
    """

    def __init__(self, scene: Scene, shapes: Sequence[_core.ArcShape]) -> None:
        count = len(scene.robot)
        self.core = _core.ArcScene(shapes[:count], shapes[count:], scene.bounds)
        self.obstacles = len(scene.obstacles)
        self.poses, self.motions = _core.ArcPoseChecker(self.core), _core.ArcMotionChecker(self.core)

    def is_free(self, pose: Pose) -> bool:
        """True if a pose is free, decided exactly. Touching is free."""
        return bool(self.poses.is_free(pose))

    def are_free(self, table: NDArray[np.float64], threads: int | None = None) -> NDArray[np.bool_]:
        """True for each free pose, decided exactly: rows x, y and theta in [0, 2 pi)."""
        verdicts = np.empty(len(table), np.uint8)
        self.poses.check(table, threads or os.cpu_count() or 1, verdicts)
        for k in np.flatnonzero(verdicts == UNCERTAIN).tolist():
            verdicts[k] = bool(self.poses.is_free(table[k].tolist()))
        free: NDArray[np.bool_] = verdicts == FREE
        return free

    def distance(self, pose: Pose, most: float = math.inf) -> tuple[float, float]:
        """Bounds of the robot's distance from everything; (0, 0) or nearly so in contact, infinite if it is far."""
        low, high = self.poses.distance(pose, min(most, 1e300))
        return low, high

    def is_motion_free(self, pose: Pose, motion: Motion) -> bool:
        """True if every pose of a translation or a rotation is free, decided exactly."""
        _refuse_slide(motion)
        return self.motions.is_free(pose, motion, isinstance(motion, Rotation))

    def first_contact(self, pose: Pose, motion: Motion) -> tuple[Fraction, Fraction, int, int] | None:
        """Bounds of the parameter up to which a motion is free, at most 2**-60 apart; the robot's shape, the obstacle.

        None if the motion is free.
        """
        _refuse_slide(motion)
        collision = self.motions.first_collision(pose, motion, isinstance(motion, Rotation))
        if collision is None:
            return None
        n, d, p, q, part, obstacle = collision
        return Fraction(n, d), Fraction(p, q), part, WORKSPACE if obstacle == self.obstacles else obstacle

    def clearance(self, pose: Pose, motion: Motion, width: float) -> tuple[float, float]:
        """Bounds of the least distance along a free motion, at most `width` apart unless that takes too long."""
        _refuse_slide(motion)
        low, high = self.motions.clearance(pose, motion, isinstance(motion, Rotation), width)
        return low, high


def arcs_of(scene: Scene) -> ArcScene | None:
    """Return the scene's segments and arcs, or None if a shape has other curves; the scene caches it.

    Examples
    --------
    >>> scene = Scene(Curved.circle((0, 0), 1), [Curved.circle((3, 0), 2)])
    >>> arcs_of(scene).is_free(Pose(0, 0)), arcs_of(scene).is_free(Pose("1e-30", 0))
    (True, False)
    >>> arcs_of(Scene(Curved.ellipse((0, 0), (1, 2)), [])) is None
    True
    """
    return kept(scene, _prepared)


def _prepared(scene: Scene) -> ArcScene | None:
    shapes = [_arc_shape(shape, False) for shape in (*scene.robot, *scene.obstacles)]
    if scene.workspace is not None:
        shapes.append(_arc_shape(scene.workspace, True))
    exact = [shape for shape in shapes if shape is not None]
    return ArcScene(scene, exact) if len(exact) == len(shapes) else None


@lru_cache(KEPT)
def _arc_shape(shape: AnyShape, is_outside: bool) -> _core.ArcShape | None:
    """Return a shape, or its complement, in the core's form; None if it has other curves."""
    curves = curves_of(shape)
    if curves is None:
        return None
    radius, rings = curves
    scale = common_denominator([radius, *(x for ring in rings for *points, _ in ring for p in points for x in p)])

    def whole(x: Fraction) -> int:
        return x.numerator * (scale // x.denominator)

    numbers = [[(*(whole(x) for p in points for x in p), turn) for *points, turn in ring] for ring in rings]
    return _core.ArcShape(numbers, whole(radius), scale, is_outside)


def curves_of(shape: AnyShape) -> tuple[Fraction, list[list[Curve]]] | None:
    """Return the radius by which a shape is grown, and its rings of segments and arcs; None if it has other curves."""
    if isinstance(shape, Polygon):
        return Fraction(0), [_polyline(ring) for ring in shape.exact_rings]
    if shape.grown and shape.is_polygon:
        return shape.grown, [_polyline(ring) for ring in shape._base().exact_rings]
    rings = _exact_rings(shape)
    return None if rings is None else (shape.grown, rings)


def _polyline(points: Sequence[ExactPoint]) -> list[Curve]:
    return [(p, q, NOWHERE, 0) for p, q in zip(points, [*points[1:], points[0]], strict=True)]


def _exact_rings(shape: Curved) -> list[list[Curve]] | None:
    rings = list[list[Curve]]()
    for curve in shape.curves:
        ring = list[Curve]()
        for piece in curve:
            parts = _parts(piece)
            if parts is None:
                return None
            ring += parts
        rings.append(ring)
    return rings


def _parts(piece: Piece) -> list[Curve] | None:
    """Return a line, or an arc in quarter turns; None for other curves."""
    if isinstance(piece, Line):
        return [(piece.start, piece.end, NOWHERE, 0)]
    if not isinstance(piece, Span):
        return None
    if not piece.is_circular:
        return None
    places = [piece.at(k, Fraction(0)) for k in range(piece.quarters + 1)]
    if piece.rest:
        places.append(piece.end)
    return [(p, q, piece.center, piece.sense) for p, q in pairwise(places)]


def _refuse_slide(motion: Motion) -> None:
    if isinstance(motion, Slide):
        raise UnsupportedError("a slide is decided between polygons only; give scene.outer(error), or another motion")
