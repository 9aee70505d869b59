"""Whether one pose is free, exactly, from the polygons alone."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from cfree.polygon import Polygon
from cfree.pose import Pose
from cfree.scene import Scene
from cfree.touch import is_forbidden


def is_free(scene: Scene, pose: Pose) -> bool:
    """Is a pose free? Exact; touching is free, because the forbidden space is open.

    Examples
    --------
    >>> from cfree.scene import Scene
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> scene = Scene(robot=square, obstacles=square, bounds=(-2, -2, 2, 2))
    >>> is_free(scene, Pose(1, 0)), is_free(scene, Pose("0.999", 0)), is_free(scene, Pose(3, 0))
    (True, False, False)
    """
    if scene.bounds is not None:
        x0, y0, x1, y1 = scene.bounds
        if not (x0 <= pose.x <= x1 and y0 <= pose.y <= y1):
            return False
    for part in scene.robot:
        box = _box(pose.apply(part.vertices))
        # boxes apart by more than rounding decide most pairs
        near = [shape for shape in scene.obstacles if _boxes_meet(box, shape.bounds)]
        outside = _complement(scene.workspace, box) if scene.workspace else []
        if any(is_forbidden(part, shape, pose) for shape in [*near, *outside]):
            return False
    return True


def _complement(workspace: Polygon, box: Sequence[float]) -> list[Polygon]:
    """The outside of a workspace as far as a box reaches, and its holes."""
    x0, y0, x1, y1 = (int(value) for value in _box(np.array([*workspace.vertices, box[:2], box[2:]])))
    frame = [(x0 - 9, y0 - 9), (x1 + 9, y0 - 9), (x1 + 9, y1 + 9), (x0 - 9, y1 + 9)]
    points, offsets = workspace.exact_vertices, workspace.ring_offsets
    outer, *holes = (points[i:j] for i, j in pairwise(offsets))
    return [Polygon(frame, [outer]), *map(Polygon, holes)]


def _box(points: Any) -> tuple[float, ...]:
    return (*points.min(axis=0).tolist(), *points.max(axis=0).tolist())


def _boxes_meet(box: Sequence[float], other: Sequence[float]) -> bool:
    slack = 1e-9 * max(map(abs, (*box, *other)))
    return all(box[k] <= other[k + 2] + slack and other[k] <= box[k + 2] + slack for k in (0, 1))
