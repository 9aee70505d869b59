"""Many queries to a folder, here or on a cluster."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.collision.pose_checker import PoseChecker, clamped
from cfree.distributed.planning import Surroundings, plan_among
from cfree.distributed.tasks import Work, opened
from cfree.exact.pose import Pose
from cfree.libraries import Floats
from cfree.paths.path import Path
from cfree.planning.proof import Proof

Rows = Floats | list[Pose]
"""Poses x, y and theta in double precision, or exact ones."""


def plan_task(folder: str, stamp: str, start: Pose, goal: Pose, wishes: dict[str, Any]) -> Path | Proof:
    """Answer one query, as `Sharded.plan` does."""
    return plan_among(Surroundings(opened(folder, stamp)), start, goal, **wishes)


def free_task(folder: str, stamp: str, rows: Rows) -> NDArray[np.bool_]:
    """Flags of the poses that are free among the obstacles near them."""
    known = Surroundings(opened(folder, stamp))
    xy = places(rows)
    for spans in (False, True):
        known.numbers |= set(known.around(xy, known.work.store.radius, spans=spans).tolist())
    return np.asarray(PoseChecker(known.scene).is_free(rows), np.bool_)


def places(rows: Rows) -> Floats:
    """Positions of poses, (n, 2), rounded: for searches, never for decisions."""
    if isinstance(rows, list):
        points = [[clamped(pose.x), clamped(pose.y)] for pose in rows]
        return np.array(points, np.float64).reshape(-1, 2)
    return rows[:, :2]


def taken(rows: Rows, numbers: NDArray[np.int64]) -> Rows:
    """Some of the poses."""
    return [rows[k] for k in numbers] if isinstance(rows, list) else rows[numbers]


def groups(work: Work, rows: Rows, most: int = 100_000) -> list[NDArray[np.int64]]:
    """Poses by the first tile that they are in, so that those of one task need few tiles."""
    boxes, xy = work.division.boxes, places(rows)
    tile = np.full(len(xy), len(boxes))
    for k in range(len(boxes) - 1, -1, -1):
        x0, y0, x1, y1 = boxes[k]
        tile[(xy[:, 0] >= x0) & (xy[:, 0] <= x1) & (xy[:, 1] >= y0) & (xy[:, 1] <= y1)] = k
    order = np.argsort(tile, kind="stable")
    cuts = set(np.flatnonzero(np.diff(tile[order])) + 1) | set(range(most, len(order), most))
    return [part for part in np.split(order, sorted(cuts)) if len(part)]
