"""Which parts of curves faces leave to be seen: a depth buffer of the faces, as fine as the eye needs it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

SIDE = 700  # cells of the buffer along its longer side
PARTS = 4  # of a piece of a curve; each is seen or not
SLACK = 0.004  # of all depth: a curve lies on its faces
SHORT = 6  # parts of a curve; shorter gaps are rounding


def depth_buffer(corners: Floats, low: Floats, size: float, shape: tuple[int, int]) -> Floats:
    """Least depth of flat convex polygons in each cell of a grid, infinite where there is none.

    Parameters
    ----------
    corners : (n, k, 3) float64
        x and y as the eye sees them, and the depth, which is affine on each polygon.
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
    of = np.repeat(np.arange(len(count)), count)
    k = np.arange(len(of)) - (np.cumsum(count) - count)[of]
    column, row = first[of, 0] + k % width[of], first[of, 1] + k // width[of]
    x, y = column + 0.5 - p[of, 0], row + 0.5 - p[of, 1]
    u = (x * r[of, 1] - y * r[of, 0]) / area[of]
    v = (y * q[of, 0] - x * q[of, 1]) / area[of]
    inside = (u >= 0) & (v >= 0) & (u + v <= 1)
    depth = (p[of, 2] + u * q[of, 2] + v * r[of, 2])[inside]
    buffer = np.full(shape, np.inf)
    np.minimum.at(buffer, (row[inside], column[inside]), depth)
    return buffer


def seen_parts(ends: Floats, faces: Floats) -> tuple[Floats, Mask]:
    """Pieces of curves in `PARTS`, and which of these no face hides.

    Parameters
    ----------
    ends : (n, 2, 3) float64
        Start and stop of each: x and y as the eye sees them, and the depth.
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
    # a curve on the rim of a face is beside it as often as on it: the farthest of the cells around counts
    around = np.stack([buffer[row + j, column + i] for j in (-1, 0, 1) for i in (-1, 0, 1)]).max(axis=0)
    return parts, np.asarray(middle[:, 2] <= around + SLACK * (high[2] - low[2]))


def polylines(parts: Floats, seen: Mask, look: NDArray[np.int64]) -> tuple[list[Floats], list[int]]:
    """Parts that are seen, joined where one begins as another of the same look ends; the look of each line."""
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
    """Without gaps, and then without ends, of fewer than `SHORT` parts within one curve."""
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
