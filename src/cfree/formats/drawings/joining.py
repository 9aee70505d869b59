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
from functools import cached_property

import numpy as np
import shapely

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


class Ends:
    """The loose ends of a mesh, and what is near to them.

    Attributes
    ----------
    owners : dict
        The curve that ends at each node with one edge.
    """

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self.graph = mesh.graph
        self.alive = self.graph.alive()
        self.star: dict[int, list[int]] = defaultdict(list)
        for edge in self.alive:
            u, v = self.graph.edges[edge]
            self.star[u].append(edge)
            self.star[v].append(edge)
        loose = ((node, edges[0]) for node, edges in self.star.items() if len(edges) == 1)
        self.owners = {node: next(mesh.owners(edge))[0] for node, edge in sorted(loose)}

    def joins(self, reach: float) -> list[Join]:
        """Return the joins up to a distance, or up to the rounding of the ends if that is more; shortest first."""
        far = {node: max(reach, 2 * self.mesh.rounding_at(node)) for node in self.owners}
        satisfied: set[int] = set()
        result: list[Join] = []
        for end, edge, gap in sorted(self.nearest(far), key=lambda item: (item[2], item[0].node)):
            if end.node in satisfied:
                continue
            target = foot(self.graph, end.node, edge)
            satisfied |= {end.node, target}
            result.append(Join(end.node, target, gap, end.owner))
        return result

    def nearest(self, reach: dict[int, float]) -> Iterator[tuple[Loose, int, float]]:
        """Yield loose ends, each with the nearest edge that it may join within a distance of its own, and the gap."""
        nodes = [node for node, distance in reach.items() if distance > 0]
        if not nodes:
            return
        places = self.graph.floats
        points = shapely.points(places[nodes])
        distances = np.array([reach[node] for node in nodes])
        a, b = self._tree.query(points, predicate="dwithin", distance=distances)
        gaps = shapely.distance(points[a], self._tree.geometries[b])
        by_end: dict[int, list[tuple[float, int]]] = defaultdict(list)
        for i, j, gap in zip(a.tolist(), b.tolist(), gaps.tolist(), strict=True):
            by_end[i].append((gap, self.alive[j]))
        for i, candidates in by_end.items():
            if len(candidates) == 1:
                continue  # its own edge
            end = self._walked(nodes[i], 2 * reach[nodes[i]])
            for gap, edge in sorted(candidates):
                if end.may_join(edge, gap):
                    yield end, edge, gap
                    break

    def least_distances(self, size: float) -> dict[int, float]:
        """Return the distance to what each loose end could join, if that is below a hundredth of the size."""
        some = list(self.owners)[:MOST_ENDS]
        result: dict[int, float] = {}
        for share in (1e-5, 1e-4, 1e-3, 1e-2):
            waiting = {node: share * size for node in some if node not in result}
            result |= {end.node: gap for end, _, gap in self.nearest(waiting)}
        return result

    @cached_property
    def _tree(self) -> shapely.STRtree:
        return shapely.STRtree(shapely.linestrings(self.graph.floats[np.array(self.graph.edges)[self.alive]]))

    def _walked(self, node: int, limit: float) -> Loose:
        """Follow the only way from a loose end, up to a distance or to the first junction."""
        graph, along = self.graph, dict[int, float]()
        length, here, edge, owner = 0.0, node, self.star[node][0], self.owners[node]
        while True:
            along[edge] = length
            u, v = graph.edges[edge]
            there = v if here == u else u
            length += math.dist(graph.place(here), graph.place(there))
            here = there
            following = [other for other in self.star[here] if other != edge]
            if len(following) != 1:
                return Loose(node, owner, along, length, frozenset(following))
            if length > limit or following[0] in along:
                return Loose(node, owner, along)
            edge = following[0]


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


def _reduced(value: Fraction) -> int | Fraction:
    return value.numerator if value.denominator == 1 else value
