"""The complement of a round workspace as obstacles: a frame, thicker than the robot, and the holes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from cfree.curves.curved import Curved
from cfree.curves.pieces import power_of_two
from cfree.value import kept

if TYPE_CHECKING:
    from cfree.scene.scene import AnyShape, Scene

FINENESS = 8  # steps of the frame's rim in its width


def complement(scene: Scene) -> tuple[AnyShape, ...]:
    """Return a frame around a round workspace and all obstacles, then the holes of the workspace; else nothing.

    Examples
    --------
    >>> from cfree.scene.scene import Scene
    >>> room = Scene([(0, 0), (1, 0), (0, 1)], workspace=Curved.circle((0, 0), 3))
    >>> frame, = complement(room)
    >>> [float(c) for c in frame.box]
    [-7.0, -7.0, 7.0, 7.0]
    """
    return kept(scene, _complement) if isinstance(scene.workspace, Curved) else ()


def _complement(scene: Scene) -> tuple[AnyShape, ...]:
    from cfree.scene.scene import box_of

    return complement_among(scene, list(map(box_of, scene.obstacles)))


def complement_among(scene: Scene, obstacles: Sequence[Sequence[float]]) -> tuple[AnyShape, ...]:
    """Return the same of a scene with other obstacles, which are in these boxes."""
    from cfree.scene.scene import box_of, robot_radius

    workspace = scene.workspace
    assert isinstance(workspace, Curved)
    boxes = [box_of(workspace), *obstacles, *([scene.bounds] if scene.bounds else [])]
    low = [Fraction(min(box[k] for box in boxes)) for k in (0, 1)]
    high = [Fraction(max(box[k] for box in boxes)) for k in (2, 3)]
    thickness = 4 * Fraction(robot_radius(scene))
    step = power_of_two(max(b - a for a, b in zip(low, high, strict=True)) + thickness) / FINENESS
    x0, y0 = (math.floor((c - thickness) / step) * step for c in low)
    x1, y1 = (math.ceil((c + thickness) / step) * step for c in high)
    frame = Curved([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], [workspace.path])
    shapes = frame, *map(Curved, workspace.holes)
    return tuple(shape._base() if shape.is_polygon else shape for shape in shapes)
