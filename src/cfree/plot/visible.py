"""Visible parts of curves among faces, by a depth buffer of the faces, as fine as a picture needs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

SIDE = 700  # cells of the buffer along its longer side
PARTS = 4  # parts of a piece of a curve; each is visible or hidden
SLACK = 0.004  # share of the depth range: a curve lies on its faces
SHORT = 6  # parts of a curve; shorter gaps are rounding


def depth_buffer(corners: Floats, low: Floats, size: float, shape: tuple[int, int]) -> Floats:
    """Return the least depth of flat convex polygons in each cell of a grid, infinite if there is none.

    Parameters
    ----------
    corners : (n, k, 3) float64
        Projected x and y, and the depth, which is affine on each polygon.
    low : (2,) float64
        Corner of the grid.
    size : float
        Side of a cell.
    shape : (int, int)
        Cells in y and x.

    Returns
    -------
    (ny, nx) float64
    """
    fans = [corners[:, [0, k, k + 1]] for k in range(1, corners.shape[1] - 1)]
    triangles = np.concatenate([((fan - (*low, 0)) / (size, size, 1)) for fan in fans])
    # the depth on a triangle's plane: z = c + n.x + m.y
    p, q, r = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    area = q[:, 0] * r[:, 1] - q[:, 1] * r[:, 0]
    seen = np.abs(area) > 1e-12
    p, q, r, area, triangles = p[seen], q[seen], r[seen], area[seen], triangles[seen]
    # cells whose middles may be inside
    first = np.clip(np.ceil(triangles[..., :2].min(axis=1) - 0.5).astype(np.int64), 0, np.array(shape)[::-1])
    last = np.clip(np.floor(triangles[..., :2].max(axis=1) + 0.5).astype(np.int64), 0, np.array(shape)[::-1])
    width, height = np.maximum(last - first, 0).T
    count = width * height
    polygon = np.repeat(np.arange(len(count)), count)
    k = np.arange(len(polygon)) - (np.cumsum(count) - count)[polygon]
    column, row = first[polygon, 0] + k % width[polygon], first[polygon, 1] + k // width[polygon]
    x, y = column + 0.5 - p[polygon, 0], row + 0.5 - p[polygon, 1]
    u = (x * r[polygon, 1] - y * r[polygon, 0]) / area[polygon]
    v = (y * q[polygon, 0] - x * q[polygon, 1]) / area[polygon]
    inside = (u >= 0) & (v >= 0) & (u + v <= 1)
    depth = (p[polygon, 2] + u * q[polygon, 2] + v * r[polygon, 2])[inside]
    buffer = np.full(shape, np.inf)
    np.minimum.at(buffer, (row[inside], column[inside]), depth)
    return buffer


def seen_parts(ends: Floats, faces: Floats) -> tuple[Floats, Mask]:
    """Split pieces of curves into `PARTS`, and return these and a mask of those that no face hides.

    Parameters
    ----------
    ends : (n, 2, 3) float64
        Start and stop of each: projected x and y, and the depth.
    faces : (m, 4, 3) float64

    Returns
    -------
    (n PARTS, 2, 3) float64
    (n PARTS,) bool
    """
    share = np.linspace(0, 1, PARTS + 1)[:, None]
    points = ends[:, None, 0] * (1 - share) + ends[:, None, 1] * share
    parts = np.stack((points[:, :-1], points[:, 1:]), axis=2).reshape(-1, 2, 3)
    if not len(faces) or not len(ends):
        return parts, np.ones(len(parts), bool)
    everything = np.concatenate((faces.reshape(-1, 3), ends.reshape(-1, 3)))
    low, high = everything.min(axis=0), everything.max(axis=0)
    size = max(*(high - low)[:2], 1e-300) / SIDE
    nx, ny = (np.ceil((high - low)[:2] / size).astype(int) + 3).tolist()
    buffer = depth_buffer(faces, low[:2] - 1.5 * size, size, (ny, nx))
    middle = parts.mean(axis=1)
    column, row = np.floor((middle[:, :2] - low[:2]) / size + 1.5).astype(int).T
    # a curve on a face's rim is beside it as often as on it: the farthest of the cells around counts
    around = np.stack([buffer[row + j, column + i] for j in (-1, 0, 1) for i in (-1, 0, 1)]).max(axis=0)
    return parts, np.asarray(middle[:, 2] <= around + SLACK * (high[2] - low[2]))


def polylines(parts: Floats, seen: Mask, look: NDArray[np.int64]) -> tuple[list[Floats], list[int]]:
    """Join visible parts where one begins at the end of another of the same look; return the look of each line."""
    follows = np.zeros(len(parts), bool)
    follows[1:] = (np.abs(parts[1:, 0] - parts[:-1, 1]).max(axis=1) < 1e-9) & (look[1:] == look[:-1])
    seen = _closed(seen, follows)
    chosen = np.flatnonzero(seen)
    if not len(chosen):
        return [], []
    joined = np.zeros(len(chosen), bool)
    joined[1:] = follows[chosen[1:]] & (np.diff(chosen) == 1)
    runs = np.split(chosen, np.flatnonzero(~joined)[1:])
    return [np.concatenate((parts[run, 0, :2], parts[run[-1:], 1, :2])) for run in runs], [
        int(look[r[0]]) for r in runs
    ]


def _closed(seen: Mask, follows: Mask) -> Mask:
    """Remove gaps, and then ends, of fewer than `SHORT` parts within one curve."""
    curve = np.cumsum(~follows)
    for value in (False, True):
        start = np.flatnonzero(np.concatenate(([True], (seen[1:] != seen[:-1]) | (curve[1:] != curve[:-1]))))
        stop = np.append(start[1:], len(seen))
        inner = np.zeros(len(start), bool)
        inner[1:-1] = (curve[start[1:-1] - 1] == curve[start[1:-1]]) & (curve[start[1:-1]] == curve[start[2:]])
        for a, b in zip(start[inner], stop[inner], strict=True):
            if seen[a] == value and b - a < SHORT:
                seen[a:b] = not value
    return seen
