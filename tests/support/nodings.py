"""Segments to be noded, and an exact check of the result."""

import random
from fractions import Fraction

from cfree.polygons.noding import Graph, graph_of, orientation

Segment = tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction], int]


def noded(segments: list[Segment]) -> Graph:
    graph = graph_of(p for segment in segments for p in segment[:2])
    graph.add(segments)
    return graph


def decimals(*values: float | str) -> tuple[Fraction, Fraction]:
    x, y = (Fraction(str(value)) for value in values)
    return x, y


def soup(rng: random.Random, count: int, digits: int, size: float = 20) -> list[Segment]:
    def point(x: float, y: float) -> tuple[Fraction, Fraction]:
        return Fraction(round(x * 10**digits), 10**digits), Fraction(round(y * 10**digits), 10**digits)

    segments = []
    for k in range(count):
        x, y = rng.uniform(0, size), rng.uniform(0, size)
        segments.append((point(x, y), point(x + rng.uniform(-6, 6), y + rng.uniform(-6, 6)), k))
    return segments


def share_ends_only(graph: Graph) -> bool:
    """True if no two edges meet besides at common ends, by exact brute force."""
    edges = [(graph.points[u], graph.points[v]) for u, v in (graph.edges[e] for e in graph.alive())]
    for k, (p, q) in enumerate(edges):
        for r, s in edges[:k]:
            a, b, c, d = orientation(p, q, r), orientation(p, q, s), orientation(r, s, p), orientation(r, s, q)
            if (a > 0) != (b > 0) and (c > 0) != (d > 0) and a and b and c and d:
                return False
            axis = 0 if p[0] != q[0] else 1
            low, high = sorted((p[axis], q[axis]))
            if any(not side and low < end[axis] < high for side, end in ((a, r), (b, s))):
                return False
    return True
