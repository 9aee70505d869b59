"""Joins: bridges from the loose ends of curves to what is nearest, up to a distance. No curve is moved.

A loose end is a point of the noding with one edge. It joins another end, or the nearest point of an edge, which is
rational. An end that sticks out by less than the distance, beyond a crossing, is no loose end.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np

from cfree.formats.drawings.mesh import Mesh
from cfree.polygons.noding import Graph

MOST_ENDS = 2000
"""Maximum number of loose ends for which the distance that joins them is computed."""


@dataclass(frozen=True, slots=True)
class Join:
    """A bridge between two nodes, and the owner of the loose end."""

    start: int
    end: int
    gap: float
    owner: int


@dataclass(frozen=True, slots=True)
class Loose:
    """A loose end: the distance along its curve to each edge nearby, and to the first junction and its edges."""

    node: int
    owner: int
    along: dict[int, float] = field(default_factory=dict)
    junction: float = math.inf
    crossing: frozenset[int] = frozenset()

    def may_join(self, edge: int, gap: float) -> bool:
        """True if an edge at this distance is another part of the drawing, and not the end's own curve."""
        return gap < self.junction and edge not in self.crossing and self.along.get(edge, math.inf) > 2 * gap


def joins(mesh: Mesh, reach: float) -> list[Join]:
    """Return the joins up to a distance, or up to the rounding of the ends if that is more; the shortest first."""
    wanted = [
        (gap, end, edge)
        for end, edge, gap in nearest(mesh, {node: _reach(mesh, node, reach) for node, _ in loose_ends(mesh)})
    ]
    graph = mesh.graph
    satisfied: set[int] = set()
    result: list[Join] = []
    for gap, end, edge in sorted(wanted, key=lambda item: (item[0], item[1].node)):
        if end.node in satisfied:
            continue
        target = foot(graph, end.node, edge)
        if target != end.node:
            satisfied |= {end.node, target}
            result.append(Join(end.node, target, gap, end.owner))
    return result


def loose_ends(mesh: Mesh) -> list[tuple[int, int]]:
    """Return the nodes with one edge, and the curves that end there."""
    graph = mesh.graph
    count: dict[int, int] = defaultdict(int)
    last: dict[int, int] = {}
    for edge in graph.alive():
        for node in graph.edges[edge]:
            count[node] += 1
            last[node] = edge
    return [(node, next(mesh.owners(last[node]))[0]) for node in sorted(count) if count[node] == 1]


def nearest(mesh: Mesh, reach: dict[int, float]) -> Iterator[tuple[Loose, int, float]]:
    """Yield each loose end with the nearest edge that it may join within a distance of its own, and the gap."""
    import shapely

    graph = mesh.graph
    wanted = {node: distance for node, distance in reach.items() if distance > 0}
    if not wanted:
        return
    owners = dict(loose_ends(mesh))
    alive = graph.alive()
    places = graph.floats
    star: dict[int, list[int]] = defaultdict(list)
    for edge in alive:
        for node in graph.edges[edge]:
            star[node].append(edge)
    nodes = sorted(wanted)
    lines = shapely.linestrings(places[np.array(graph.edges)[alive]])
    points = shapely.points(places[nodes])
    distances = np.array([wanted[node] for node in nodes])
    a, b = shapely.STRtree(lines).query(points, predicate="dwithin", distance=distances)
    gaps = shapely.distance(points[a], lines[b])
    by_end: dict[int, list[tuple[float, int]]] = defaultdict(list)
    for i, j, gap in zip(a.tolist(), b.tolist(), gaps.tolist(), strict=True):
        by_end[i].append((gap, alive[j]))
    for i, candidates in by_end.items():
        end = _walked(graph, star, nodes[i], owners[nodes[i]], 2 * wanted[nodes[i]])
        for gap, edge in sorted(candidates):
            if end.may_join(edge, gap):
                yield end, edge, gap
                break


def least_distances(mesh: Mesh, size: float) -> dict[int, float]:
    """Return the distance to what each loose end could join, if that is below a hundredth of the size."""
    open_ends = [node for node, _ in loose_ends(mesh)][:MOST_ENDS]
    result: dict[int, float] = {}
    for share in (1e-5, 1e-4, 1e-3, 1e-2):
        waiting = {node: share * size for node in open_ends if node not in result}
        result |= {end.node: gap for end, _, gap in nearest(mesh, waiting)}
    return result


def foot(graph: Graph, node: int, edge: int) -> int:
    """Return the point of an edge that is nearest to a node; an end of the edge, or an exact point on it."""
    ends = graph.edges[edge]
    p, q, r = graph.points[ends[0]], graph.points[ends[1]], graph.points[node]
    dx, dy = q[0] - p[0], q[1] - p[1]
    share = Fraction((r[0] - p[0]) * dx + (r[1] - p[1]) * dy) / Fraction(dx * dx + dy * dy)
    if share <= 0 or share >= 1:
        return ends[0] if share <= 0 else ends[1]
    return graph.node_at((_reduced(p[0] + dx * share), _reduced(p[1] + dy * share)))


def square(graph: Graph, start: int, end: int, half: float) -> list[int]:
    """Return the corners of a square around the middle of two points, with half a side."""
    (a, b), (c, d) = graph.points[start], graph.points[end]
    x, y, width = Fraction(a + c) / 2, Fraction(b + d) / 2, Fraction(half) * graph.scale
    signs = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    return [graph.node_at((_reduced(x + u * width), _reduced(y + v * width))) for u, v in signs]


def _reach(mesh: Mesh, node: int, reach: float) -> float:
    return max(reach, 2 * mesh.rounding_at(node))


def _reduced(value: Fraction) -> int | Fraction:
    return value.numerator if value.denominator == 1 else value


def _walked(graph: Graph, star: dict[int, list[int]], node: int, owner: int, limit: float) -> Loose:
    """Follow the only way from a loose end, up to a distance or to the first junction."""
    along: dict[int, float] = {}
    length, here, edge = 0.0, node, star[node][0]
    while True:
        along[edge] = length
        u, v = graph.edges[edge]
        there = v if here == u else u
        length += math.dist(graph.place(here), graph.place(there))
        here = there
        following = [other for other in star[here] if other != edge]
        if len(following) != 1:
            return Loose(node, owner, along, length, frozenset(following))
        if length > limit or following[0] in along:
            return Loose(node, owner, along)
        edge = following[0]
