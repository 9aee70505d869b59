"""A* over cells of x, y and theta, free or not by a test at their centres that numba compiles.

A cell has 26 neighbours; it is tested when the search first touches it. Start and goal are joined to the free centres
among the 27 cells around them.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
from bench_free import numba_kernel

Box = tuple[float, float, float, float]
Rows = np.ndarray  # (n, 3): x, y, theta


def search(box: Box, across: int, turns: int, radius: float, start: Any, goal: Any, tables: Any) -> Rows | None:
    """Poses from start to goal, or None; `across` cells along the longer side, `turns` of theta."""
    cell = max(box[2] - box[0], box[3] - box[1]) / across
    shape = (*(max(1, math.ceil((box[k + 2] - box[k]) / cell)) for k in (0, 1)), turns)
    way = _compiled()(np.array(box[:2]), np.array(shape), cell, radius, np.array(start), np.array(goal), *tables)
    return np.vstack([start, way, goal]) if len(way) else None


@cache
def _compiled() -> Any:
    import heapq

    import numba

    free = numba_kernel()

    @numba.njit
    def cells_around(pose, low, shape, cell):
        u, v = int((pose[0] - low[0]) / cell), int((pose[1] - low[1]) / cell)
        w = int((pose[2] % math.tau) / math.tau * shape[2])
        found = []
        for i in range(max(0, u - 1), min(shape[0], u + 2)):
            for j in range(max(0, v - 1), min(shape[1], v + 2)):
                for k in range(w - 1, w + 2):
                    found.append((i * shape[1] + j) * shape[2] + k % shape[2])
        return found

    @numba.njit
    def centre(index, low, shape, cell, row):
        k, rest = index % shape[2], index // shape[2]
        row[0, 0] = low[0] + (rest // shape[1] + 0.5) * cell
        row[0, 1] = low[1] + (rest % shape[1] + 0.5) * cell
        row[0, 2] = (k + 0.5) * math.tau / shape[2]

    @numba.njit
    def distance(row, goal, radius):
        turn = (row[0, 2] - goal[2]) % math.tau
        return math.sqrt((row[0, 0] - goal[0]) ** 2 + (row[0, 1] - goal[1]) ** 2
                         + (radius * min(turn, math.tau - turn)) ** 2)  # fmt: skip

    @numba.njit
    def search(low, shape, cell, radius, start, goal, a, a_first, b, b_first, boxes):
        count, row, none = shape[0] * shape[1] * shape[2], np.empty((1, 3)), np.empty((0, 3))
        cost, parent = np.full(count, np.inf, np.float32), np.full(count, -1, np.int32)
        state = np.zeros(count, np.int8)  # 0 not yet tested, 1 free, 2 not, 3 done
        heap = [(0.0, -1)]
        heap.pop()
        for index in cells_around(start, low, shape, cell):
            centre(index, low, shape, cell, row)
            state[index] = 1 if free(row, a, a_first, b, b_first, boxes)[0] else 2
            if state[index] == 1:
                cost[index] = distance(row, start, radius)
                heapq.heappush(heap, (cost[index] + distance(row, goal, radius), index))
        ends = cells_around(goal, low, shape, cell)
        turn = radius * math.tau / shape[2]
        while len(heap):
            index = heapq.heappop(heap)[1]
            if state[index] == 3:
                continue
            state[index] = 3
            if index in ends:
                way = [index]
                while parent[way[-1]] >= 0:
                    way.append(parent[way[-1]])
                poses = np.empty((len(way), 3))
                for n in range(len(way)):
                    centre(way[n], low, shape, cell, row)
                    poses[len(way) - 1 - n] = row[0]
                return poses
            k, rest = index % shape[2], index // shape[2]
            i, j = rest // shape[1], rest % shape[1]
            for di in range(-1, 2):
                for dj in range(-1, 2):
                    if not (0 <= i + di < shape[0] and 0 <= j + dj < shape[1]):
                        continue
                    for dk in range(-1, 2):
                        other = ((i + di) * shape[1] + j + dj) * shape[2] + (k + dk) % shape[2]
                        if state[other] >= 2:
                            continue
                        centre(other, low, shape, cell, row)
                        if state[other] == 0:
                            state[other] = 1 if free(row, a, a_first, b, b_first, boxes)[0] else 2
                            if state[other] == 2:
                                continue
                        step = math.sqrt((di * di + dj * dj) * cell * cell + dk * dk * turn * turn)
                        if cost[index] + step < cost[other]:
                            cost[other] = cost[index] + step
                            parent[other] = index
                            heapq.heappush(heap, (cost[other] + distance(row, goal, radius), other))
        return none

    return search
