"""Faces of a noding: half-edges around each point, the faces to their left, and the outlines of a set of faces.

Edge e of the graph from u to v is half-edge 2 e, and 2 e + 1 runs from v to u. Components that lie apart are nested:
the face around a component is a face of the component that contains it. Face 0 is unbounded.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cmp_to_key
from itertools import pairwise
from math import atan2
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.polygons.noding import Graph, orientation, ratio

Cycle = list[int]
"""Half-edges, each from the end of the one before."""
_NEAR = 1e-9  # angles that are nearer are compared exactly


class Faces:
    """The faces that some edges of a graph make.

    Attributes
    ----------
    edges : list of int
        Edges of the graph that are in use.
    face : list of int
        Face to the left of each half-edge, -1 for edges that are left out.
    count : int
        Number of faces.
    component : dict
        Component of each point that has edges.
    around : list of int
        Face around each component.

    Examples
    --------
    >>> graph = Graph()
    >>> corners = [(0, 0), (2, 0), (2, 2), (0, 2)]
    >>> graph.add([(corners[k - 1], corners[k], k) for k in range(4)])
    >>> faces = Faces(graph)
    >>> faces.count, [len(ring) for ring, *_ in faces.outlines([False, True])]
    (2, [4])
    """

    def __init__(self, graph: Graph, edges: Iterable[int] | None = None) -> None:
        self.graph = graph
        self.edges = graph.alive() if edges is None else list(edges)
        self._star = _stars(graph, self.edges)
        self._next = _followers(self._star, 2 * len(graph.edges))
        self.component = self._components()
        cycle, count = self._cycles()
        self.face, self.count, self.around = self._nested(cycle, count)

    def origin(self, half: int) -> int:
        """Return the point where a half-edge begins."""
        return self.graph.edges[half >> 1][half & 1]

    def is_between(self, edge: int) -> bool:
        """True if the faces beside an edge differ; if not, it is a tail or a bridge."""
        return self.face[2 * edge] != self.face[2 * edge + 1]

    def crossings(self) -> Iterator[tuple[int, int, int]]:
        """Yield a half-edge, the face to its right, and the new face to its left, until all faces are reached."""
        sides: dict[int, list[int]] = defaultdict(list)
        for edge in self.edges:
            for half in (2 * edge, 2 * edge + 1):
                sides[self.face[half ^ 1]].append(half)
        reached, waiting = {0}, [0]
        while waiting:
            right = waiting.pop()
            for half in sides[right]:
                left = self.face[half]
                if left not in reached:
                    reached.add(left)
                    waiting.append(left)
                    yield half, right, left

    def windings(self, weights: Mapping[int, int]) -> list[int]:
        """Return the winding number of each face, if edge e counts `weights[e]` in its own direction."""
        winding = [0] * self.count
        for half, right, left in self.crossings():
            weight = weights.get(half >> 1, 0)
            winding[left] = winding[right] + (weight if not half & 1 else -weight)
        return winding

    def outlines(self, solid: Sequence[bool]) -> list[list[Cycle]]:
        """Return the rings around each connected set of solid faces, the outer one first.

        Rings visit a point once, and touch at most in points; solid faces that share an edge are connected.
        """
        parent = list(range(self.count))
        border: list[int] = []
        for edge in self.edges:
            a, b = self.face[2 * edge], self.face[2 * edge + 1]
            if solid[a] and solid[b]:
                parent[root(parent, a)] = root(parent, b)
            elif solid[a] or solid[b]:
                border.append(2 * edge if solid[a] else 2 * edge + 1)
        regions: dict[int, list[Cycle]] = {}
        is_border, done = set(border), set[int]()
        for first in border:
            if first in done:
                continue
            cycle, half = [], first
            while half not in done:
                done.add(half)
                cycle.append(half)
                half = self._next[half]
                while half not in is_border:
                    half = self._next[half ^ 1]
            regions.setdefault(root(parent, self.face[first]), []).extend(self._simple(cycle))
        return [sorted(rings, key=self._is_hole) for rings in regions.values()]

    def outer_edges(self, edges: Iterable[int]) -> list[list[int]]:
        """Return the edges on the outer contour of each connected part of some edges."""
        star: dict[int, list[int]] = defaultdict(list)
        for edge in edges:
            for half in (2 * edge, 2 * edge + 1):
                star[self.origin(half)].append(half)
        contours: list[list[int]] = []
        reached: set[int] = set()
        for start in star:
            if start in reached:
                continue
            part, waiting = [start], [start]
            reached.add(start)
            while waiting:
                for half in star[waiting.pop()]:
                    end = self.origin(half ^ 1)
                    if end not in reached:
                        reached.add(end)
                        part.append(end)
                        waiting.append(end)
            least = min(part, key=self.graph.points.__getitem__)
            outside = self.face[_around(self.graph, star[least])[-1]]
            sides = (half for point in part for half in star[point])
            contours.append([half >> 1 for half in sides if self.face[half] == outside])
        return contours

    def _is_hole(self, ring: Cycle) -> bool:
        """True if a simple ring runs clockwise."""
        points = self.graph.points
        k = min(range(len(ring)), key=lambda k: points[self.origin(ring[k])])
        p, q, r = (points[self.origin(half)] for half in (ring[k - 1], ring[k], ring[(k + 1) % len(ring)]))
        return bool(orientation(p, q, r) < 0)

    def _simple(self, cycle: Cycle) -> Iterator[Cycle]:
        """Split a cycle where it visits a point again."""
        path: Cycle = []
        place: dict[int, int] = {}
        for half in cycle:
            point = self.origin(half)
            if point in place:
                first = place[point]
                ring, path = path[first:], path[:first]
                for other in ring:
                    del place[self.origin(other)]
                yield ring
            place[point] = len(path)
            path.append(half)
        yield path

    def _components(self) -> dict[int, int]:
        component: dict[int, int] = {}
        count = 0
        for start in self._star:
            if start in component:
                continue
            component[start] = count
            waiting = [start]
            while waiting:
                for half in self._star[waiting.pop()]:
                    end = self.origin(half ^ 1)
                    if end not in component:
                        component[end] = count
                        waiting.append(end)
            count += 1
        return component

    def _cycles(self) -> tuple[list[int], int]:
        """Number the cycles of half-edges from 1."""
        cycle = [-1] * len(self._next)
        count = 1
        for edge in self.edges:
            for half in (2 * edge, 2 * edge + 1):
                if cycle[half] < 0:
                    while cycle[half] < 0:
                        cycle[half] = count
                        half = self._next[half]
                    count += 1
        return cycle, count

    def _nested(self, cycle: list[int], count: int) -> tuple[list[int], int, list[int]]:
        """Unite the outer cycle of each component with the face around it."""
        points = self.graph.points
        least: dict[int, int] = {}
        for point, part in self.component.items():
            if part not in least or points[point] < points[least[part]]:
                least[part] = point
        # at the least point all edges leave to the right, and the outside is to the left of the highest
        outer = {part: cycle[_around(self.graph, self._star[point])[-1]] for part, point in least.items()}
        below = _below(self, least) if len(least) > 1 else {}
        face = list(range(count))
        for part in sorted(least, key=lambda part: points[least[part]]):  # what is below begins further left
            half = below.get(part)
            face[outer[part]] = 0 if half is None else face[cycle[half]]
        numbers = {0: 0}
        for own in face:
            numbers.setdefault(own, len(numbers))
        of_cycle = [numbers[own] for own in face]
        around = [of_cycle[outer[part]] for part in range(len(least))]
        return [of_cycle[k] if k >= 0 else -1 for k in cycle], len(numbers), around


def root(parent: list[int], k: int) -> int:
    """Return the representative of a set in a forest, and shorten the way to it."""
    while parent[k] != k:
        parent[k] = parent[parent[k]]
        k = parent[k]
    return k


def _stars(graph: Graph, edges: list[int]) -> dict[int, list[int]]:
    """Half-edges that leave each point, counter-clockwise."""
    star: dict[int, list[int]] = defaultdict(list)
    for edge in edges:
        u, v = graph.edges[edge]
        star[u].append(2 * edge)
        star[v].append(2 * edge + 1)
    return {point: _around(graph, halves) if len(halves) > 2 else halves for point, halves in star.items()}


def _around(graph: Graph, halves: list[int]) -> list[int]:
    """Sort half-edges from a point counter-clockwise, from the direction (-1, 0) on."""
    points, scale = graph.points, graph.scale
    directions: dict[int, tuple[Any, Any]] = {}
    angles: dict[int, float] = {}
    for half in halves:
        ends = graph.edges[half >> 1]
        (x, y), (p, q) = points[ends[half & 1]], points[ends[1 - (half & 1)]]
        d = directions[half] = p - x, q - y
        angles[half] = atan2(ratio(d[1], scale), ratio(d[0], scale)) if d[1] or d[0] > 0 else -4.0
    halves = sorted(halves, key=angles.__getitem__)
    if any(angles[b] - angles[a] < _NEAR for a, b in pairwise(halves)):

        def compared(a: int, b: int) -> int:
            if abs(angles[a] - angles[b]) >= _NEAR:
                return -1 if angles[a] < angles[b] else 1
            (x, y), (p, q) = directions[a], directions[b]
            cross = x * q - y * p
            return -1 if cross > 0 else int(cross < 0)

        halves = sorted(halves, key=cmp_to_key(compared))
    return halves


def _followers(star: dict[int, list[int]], count: int) -> list[int]:
    """Half-edge after each, with the same face to the left."""
    follower = [-1] * count
    for halves in star.values():
        for k, half in enumerate(halves):
            follower[half ^ 1] = halves[k - 1]
    return follower


def _below(faces: Faces, least: dict[int, int]) -> dict[int, int]:
    """Return the half-edge of another component right below the least point of each, to its right side first.

    The edge runs from left to right, so that the point is in the face to its left.
    """
    import shapely

    graph, points = faces.graph, faces.graph.points
    places = graph.floats
    edges = np.array(faces.edges)
    ends = np.array(graph.edges)[edges]
    flip = places[ends[:, 0], 0] > places[ends[:, 1], 0]
    left, right = np.where(flip, ends[:, 1], ends[:, 0]), np.where(flip, ends[:, 0], ends[:, 1])
    most = float(np.abs(places).max())
    noise = 16 * most * 2.0**-52 + 1e-300
    low = np.minimum(places[left, 1], places[right, 1])
    high = np.maximum(places[left, 1], places[right, 1])
    tree = shapely.STRtree(shapely.box(places[left, 0] - noise, low - noise, places[right, 0] + noise, high + noise))
    parts = np.array(sorted(least))
    probes = np.array([least[part] for part in parts.tolist()])
    component = np.array([faces.component[point] for point in ends[:, 0].tolist()])
    bottom = float(places[:, 1].min()) - 1 - noise
    result: dict[int, int] = {}
    step = max(1, (1 << 22) // len(edges))
    for first in range(0, len(parts), step):
        some = probes[first : first + step]
        x, y = places[some, 0], places[some, 1]
        a, b = tree.query(shapely.box(x - noise, np.full(len(x), bottom), x + noise, y + noise))
        keep = component[b] != parts[first + a]
        a, b = a[keep], b[keep]
        best: dict[int, int] = {}
        for k, edge in _highest(places, x[a], y[a], left[b], right[b], a, b, noise):
            half = _to_the_right(graph, int(edges[edge]))
            if half is None or not _is_below(graph, half, points[some[k]]):
                continue
            if k not in best or _is_higher(graph, half, best[k], points[some[k]]):
                best[k] = half
        result |= {int(parts[first + k]): half for k, half in best.items()}
    return result


def _highest(
    places: NDArray[Any],
    x: NDArray[Any],
    y: NDArray[Any],
    left: NDArray[Any],
    right: NDArray[Any],
    probe: NDArray[Any],
    edge: NDArray[Any],
    noise: float,
) -> Iterator[tuple[int, int]]:
    """Yield a probe and each edge that may be the highest one below it."""
    p, q = places[left], places[right]
    width = q[:, 0] - p[:, 0]
    slope = (q[:, 1] - p[:, 1]) / np.where(width > 0, width, 1)
    height = p[:, 1] + slope * np.clip(x - p[:, 0], 0, width)
    error = noise * (4 + 4 * np.abs(slope))
    error = np.where(width > 4 * noise, error, np.abs(q[:, 1] - p[:, 1]) + 4 * noise)
    sure = (width > 4 * noise) & (x > p[:, 0] + noise) & (x < q[:, 0] - noise) & (height + error < y)
    floor = np.full(int(probe.max()) + 1 if len(probe) else 0, -np.inf)
    np.maximum.at(floor, probe[sure], (height - error)[sure])
    keep = (height + error >= floor[probe]) & (height - error <= y)
    yield from zip(probe[keep].tolist(), edge[keep].tolist(), strict=True)


def _to_the_right(graph: Graph, edge: int) -> int | None:
    u, v = graph.edges[edge]
    a, b = graph.points[u][0], graph.points[v][0]
    return None if a == b else 2 * edge if a < b else 2 * edge + 1


def _ends(graph: Graph, half: int) -> tuple[Any, Any]:
    ends = graph.edges[half >> 1]
    return graph.points[ends[half & 1]], graph.points[ends[1 - (half & 1)]]


def _is_below(graph: Graph, half: int, p: Any) -> bool:
    """True if a point's vertical line meets a half-edge, but for its right end, below the point."""
    a, b = _ends(graph, half)
    return bool(a[0] <= p[0] < b[0] and orientation(a, b, p) > 0)


def _is_higher(graph: Graph, half: int, other: int, p: Any) -> bool:
    """True if a half-edge is above another one right of a point's vertical line."""
    (a, b), (c, d) = _ends(graph, half), _ends(graph, other)
    u, v, w, z = b[0] - a[0], b[1] - a[1], d[0] - c[0], d[1] - c[1]
    # heights at p: a.y + v (p.x - a.x) / u
    first = (a[1] * u + v * (p[0] - a[0])) * w
    second = (c[1] * w + z * (p[0] - c[0])) * u
    return bool(first > second or (first == second and v * w > z * u))
