"""Loops of edges on the closed surfaces of a cell, which generate its first homology group."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass

from cfree.arguments import checked
from cfree.forbidden.cell_complex import CellComplex
from cfree.free.space import Cell
from cfree.libraries import Floats, Ints, np
from cfree.value import Value


@dataclass(frozen=True, eq=False, repr=False)
class Loop(Value):
    """A closed walk along edges of a closed surface.

    Attributes
    ----------
    component : int
        The closed surface.
    coedges : (n,) int32
        Its coedges in `FreeSpace.complex`, each of which ends where the next one starts.
    points : (n + 1, 3) float64
        x, y and theta where they start, and where the last one ends; theta goes on beyond whole turns.
    turns : int
        Full turns in theta, counter-clockwise.
    """

    component: int
    coedges: Ints
    points: Floats
    turns: int


@checked
def surface_loops(cell: Cell) -> tuple[Loop, ...]:
    """Return loops on the closed surfaces of a cell, whose classes generate its first homology group.

    Returns
    -------
    tuple of Loop
        Two for each handle of a surface, so 2 b1 loops in a bounded cell, of which b1 are independent in the cell. In
        the unbounded cell a full turn far away from all obstacles is a generator as well.

    Notes
    -----
    A tree of edges spans the vertices, another one spans the faces across the remaining edges. Each edge in neither of
    them closes one loop. Trees are searched breadth first, from the same vertex.

    Examples
    --------
    >>> import cfree
    >>> scene = cfree.Scene([(0, 0), (1, 0), (0, 1)], workspace=[(0, 0), (9, 0), (9, 9), (0, 9)])
    >>> (cell,) = cfree.free_space(cfree.boundary(scene)).cells       # a room in which the robot can turn round
    >>> cell.homology
    Homology(b0=1, b1=1, b2=0)
    >>> sorted(abs(loop.turns) for loop in surface_loops(cell))       # the second one runs along the walls
    [0, 1]
    """
    complex = cell.free_space.complex
    walker = _Walker(complex)
    faces = cell.free_space.component
    return tuple(loop for k in cell.components for loop in walker.loops(k, np.flatnonzero(faces == k).astype(np.int32)))


class _Walker:
    """Edges of closed surfaces as pairs of twins."""

    def __init__(self, complex: CellComplex) -> None:
        self.complex = complex
        count = len(complex.face)
        following = np.arange(1, count + 1)
        following[complex.first[1:] - 1] = complex.first[:-1]
        self.end = complex.vertex[following]
        self.out: dict[int, list[int]] = {}
        for h, vertex in enumerate(complex.vertex.tolist()):
            self.out.setdefault(vertex, []).append(h)

    def loops(self, component: int, faces: Ints) -> Iterator[Loop]:
        """Yield the loops of one closed surface."""
        complex = self.complex
        first, twin, end = complex.first, complex.twin, self.end
        coedges = [h for face in faces.tolist() for h in range(int(first[face]), int(first[face + 1]))]
        root = int(complex.vertex[coedges[0]])
        arrival = {root: -1}  # the coedge by which the tree arrives at a vertex
        waiting = deque([root])
        while waiting:
            for h in self.out[waiting.popleft()]:
                if (vertex := int(end[h])) not in arrival:
                    arrival[vertex] = h
                    waiting.append(vertex)
        used = {k for h in arrival.values() if h >= 0 for k in (h, int(twin[h]))}
        reached = {int(faces[0])}
        waiting = deque(reached)
        while waiting:
            face = waiting.popleft()
            for h in range(int(first[face]), int(first[face + 1])):
                other = int(complex.face[twin[h]])
                if h not in used and other not in reached:
                    used |= {h, int(twin[h])}
                    reached.add(other)
                    waiting.append(other)
        for h in coedges:
            if h not in used:
                used |= {h, int(twin[h])}
                yield self._loop(component, self._closed(h, arrival))

    def _closed(self, h: int, arrival: dict[int, int]) -> list[int]:
        """Return the loop from a coedge through the tree: without what both ways to the root have in common."""
        complex, ways = self.complex, list[list[int]]()
        for vertex in (int(complex.vertex[h]), int(self.end[h])):
            way: list[int] = []
            while (last := arrival[vertex]) >= 0:
                way.append(last)
                vertex = int(complex.vertex[last])
            ways.append(way[::-1])
        there, back = ways
        common = next((k for k, (a, b) in enumerate(zip(there, back, strict=False)) if a != b), min(map(len, ways)))
        return [*there[common:], h, *(int(complex.twin[k]) for k in back[common:][::-1])]

    def _loop(self, component: int, coedges: list[int]) -> Loop:
        complex = self.complex
        steps = [self._step(h) for h in coedges]
        start = complex.vertex[coedges]
        theta = complex.theta[start[0]] + np.concatenate([[0.0], np.cumsum(steps)])
        around = [*start.tolist(), int(start[0])]
        points = np.column_stack([complex.x[around], complex.y[around], theta])
        return Loop(component, np.array(coedges, np.int32), points, round(math.fsum(steps) / math.tau))

    def _step(self, h: int) -> float:
        """Return the change of theta along a coedge: walls have none, upper curves run up and lower curves down."""
        complex = self.complex
        side = int(complex.side[h])
        if side in (0, 2):
            return 0.0
        change = float(complex.theta[self.end[h]] - complex.theta[complex.vertex[h]])
        sign = 1 if side == 1 else -1
        return change + sign * math.tau if sign * change < -math.pi / 2 else change
