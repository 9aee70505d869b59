"""Exact noding: cut segments where they meet, cross or overlap, so that edges share nothing but ends.

All decimals of a drawing have a common denominator, so points are integers of one scale, and only crossings are
fractions. Candidates are pairs of boxes that meet. A filter in doubles drops pairs that are certainly apart; exact
numbers decide the rest.

Let u = 2^-53, and M the largest coordinate. A rounded coordinate is off by u M at most, a difference d by
2 u M + u |d|. So the two products l, r of an orientation and their difference are off by less than
4 u (|l| + |r|) + 2 u M (sum of the four differences) + 8 u^2 M^2, which the bound below exceeds.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.exact.number import ExactPoint

Scaled = tuple[Any, Any]
"""A point in the graph's scale: integers, or fractions."""
Use = tuple[int, int]
"""A source of an edge, and 1 if it runs as the edge does, or -1."""

MOST_MEETINGS = 500_000
"""Maximum number of pairs of segments that exact numbers decide."""
MOST_PAIRS = 60_000_000
"""Maximum number of pairs of boxes that meet."""
MOST_BITS = 1 << 11
"""Maximum size of the common denominator; beyond it all points stay fractions."""
_CHUNK = 1 << 22  # most pairs of boxes at a time, about


class CrowdedError(Exception):
    """Too many segments meet."""


class Graph:
    """Points and edges of a noding; `add` cuts further segments into it.

    Attributes
    ----------
    points : list of pairs
        Exact, in units of 1 / `scale`.
    edges : list of pairs of int
        Ends of each edge, the lesser index first; an edge that was removed has no uses.
    uses : list of lists
        Sources of each edge with their directions.

    Examples
    --------
    >>> graph = Graph()
    >>> graph.add([((0, 0), (2, 2), 0), ((0, 2), (2, 0), 1)])
    >>> len(graph.alive()), graph.point(4)
    (4, (Fraction(1, 1), Fraction(1, 1)))
    """

    def __init__(self, scale: int = 1) -> None:
        self.scale = scale
        self.points: list[Scaled] = []
        self.edges: list[tuple[int, int]] = []
        self.uses: list[list[Use]] = []
        self._index: dict[Scaled, int] = {}
        self._edge: dict[tuple[int, int], int] = {}
        self._center: Scaled = (0, 0)
        self._floats: list[tuple[float, float]] = []

    def point(self, k: int) -> ExactPoint:
        """Return a point in its own unit."""
        x, y = self.points[k]
        return Fraction(x, self.scale), Fraction(y, self.scale)

    def place(self, k: int) -> tuple[float, float]:
        """Return a point in doubles."""
        x, y = self.points[k]
        return ratio(x, self.scale), ratio(y, self.scale)

    def index(self, p: Sequence[Any]) -> int:
        """Return the index of a point, which becomes one if it is new."""
        return self.node_at((_scaled(p[0], self.scale), _scaled(p[1], self.scale)))

    @property
    def floats(self) -> NDArray[np.float64]:
        """All points in doubles, with the first point as origin."""
        if not self._floats and self.points:
            self._center = self.points[0]
        a, b = self._center
        for x, y in self.points[len(self._floats) :]:
            self._floats.append((ratio(x - a, self.scale), ratio(y - b, self.scale)))
        return np.array(self._floats, dtype=np.float64).reshape(-1, 2)

    def add(self, segments: Iterable[tuple[Sequence[Any], Sequence[Any], int]]) -> None:
        """Add segments from one point to another, with their sources."""
        self.join((self.index(p), self.index(q), source) for p, q, source in segments)

    def join(self, segments: Iterable[tuple[int, int, int]]) -> None:
        """Add segments between points of the graph, with their sources."""
        fresh = {edge for p, q, source in segments if p != q for edge in self._segment(p, q, [(source, 1)])}
        if not fresh:
            return
        cuts: dict[int, set[int]] = {}
        for a, b in _meetings(self, sorted(fresh)):
            self._cut(a, b, cuts)
        for edge, between in cuts.items():
            self._split(edge, between)

    def remove(self, sources: set[int]) -> None:
        """Remove the edges of sources, but for other uses of them."""
        for edge, uses in enumerate(self.uses):
            if any(source in sources for source, _ in uses):
                self.uses[edge] = [use for use in uses if use[0] not in sources]
                if not self.uses[edge]:
                    del self._edge[self.edges[edge]]

    def alive(self) -> list[int]:
        """Return the edges that are in use."""
        return [edge for edge, uses in enumerate(self.uses) if uses]

    def node_at(self, p: Scaled) -> int:
        """Return the index of a point in the scale of the graph."""
        k = self._index.setdefault(p, len(self.points))
        if k == len(self.points):
            self.points.append(p)
        return k

    def _segment(self, p: int, q: int, uses: list[Use]) -> Iterator[int]:
        """Add an edge, or uses to an edge that is there; yield a new one."""
        if p > q:
            p, q, uses = q, p, [(source, -sign) for source, sign in uses]
        edge = self._edge.setdefault((p, q), len(self.edges))
        if edge == len(self.edges):
            self.edges.append((p, q))
            self.uses.append(list(uses))
            yield edge
        else:
            self.uses[edge] += uses

    def _cut(self, a: int, b: int, cuts: dict[int, set[int]]) -> None:
        """Record the points at which two edges cut each other."""
        (i, j), (k, l) = self.edges[a], self.edges[b]
        p, q, r, s = self.points[i], self.points[j], self.points[k], self.points[l]
        to_r, to_s = orientation(p, q, r), orientation(p, q, s)
        to_p, to_q = orientation(r, s, p), orientation(r, s, q)
        if to_r and to_s and to_p and to_q:
            if (to_r > 0) != (to_s > 0) and (to_p > 0) != (to_q > 0):
                share = Fraction(to_p) / (to_p - to_q)
                node = self.node_at((_reduced(p[0] + (q[0] - p[0]) * share), _reduced(p[1] + (q[1] - p[1]) * share)))
                cuts.setdefault(a, set()).add(node)
                cuts.setdefault(b, set()).add(node)
            return
        for edge, ends, others in (
            (a, (p, q), ((k, r, to_r), (l, s, to_s))),
            (b, (r, s), ((i, p, to_p), (j, q, to_q))),
        ):
            for node, other, side in others:
                if not side and _between(ends[0], other, ends[1]):
                    cuts.setdefault(edge, set()).add(node)

    def _split(self, edge: int, between: set[int]) -> None:
        p, q = self.edges[edge]
        uses, self.uses[edge] = self.uses[edge], []
        del self._edge[p, q]
        a, b = self.points[p], self.points[q]
        axis = 0 if a[0] != b[0] else 1
        chain = [p, *sorted(between, key=lambda k: self.points[k][axis], reverse=bool(a[axis] > b[axis])), q]
        for u, v in pairwise(chain):
            for _ in self._segment(u, v, uses):
                pass


def graph_of(points: Iterable[Sequence[Fraction]]) -> Graph:
    """Return an empty graph in the scale of points: their common denominator, if it is not too large."""
    scale = 1
    for denominator in {value.denominator for p in points for value in p}:
        scale = math.lcm(scale, denominator)
        if scale.bit_length() > MOST_BITS:
            return Graph()
    return Graph(scale)


def orientation(p: Scaled, q: Scaled, r: Scaled) -> Any:
    """Cross product of q - p and r - p: above 0 if r is to the left."""
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def ratio(value: Any, scale: int) -> float:
    """Quotient of an integer or a fraction and a scale, rounded once."""
    if isinstance(value, Fraction):
        return value.numerator / (value.denominator * scale)
    return float(value / scale)


def _scaled(value: Any, scale: int) -> Any:
    denominator = value.denominator
    return value.numerator * (scale // denominator) if scale % denominator == 0 else _reduced(Fraction(value * scale))


def _reduced(value: Any) -> Any:
    return value.numerator if isinstance(value, Fraction) and value.denominator == 1 else value


def _between(p: Scaled, r: Scaled, q: Scaled) -> bool:
    """True if a point on the line through two others is strictly between them."""
    axis = 0 if p[0] != q[0] else 1
    return bool(p[axis] < r[axis] < q[axis] or q[axis] < r[axis] < p[axis])


def _meetings(graph: Graph, fresh: list[int]) -> Iterator[tuple[int, int]]:
    """Yield pairs of edges that may meet besides at common ends; one of each pair is fresh.

    Raises
    ------
    CrowdedError
        If there are too many.
    """
    import shapely

    alive = np.array(graph.alive())
    ends = np.array(graph.edges)[alive]
    places = graph.floats
    low = np.minimum(places[ends[:, 0]], places[ends[:, 1]])
    high = np.maximum(places[ends[:, 0]], places[ends[:, 1]])
    most = float(np.abs(places).max())
    margin = most * 2.0**-40
    boxes = shapely.box(low[:, 0] - margin, low[:, 1] - margin, high[:, 0] + margin, high[:, 1] + margin)
    tree = shapely.STRtree(boxes)
    is_fresh = np.zeros(len(graph.edges), dtype=bool)
    is_fresh[fresh] = True
    asked = np.flatnonzero(is_fresh[alive])
    step = max(1, _CHUNK // len(alive))
    pairs = meetings = 0
    first = 0
    while first < len(asked):
        a, b = tree.query(boxes[asked[first : first + step]])
        a = asked[first + a]
        first += step
        step = 2 * step if len(a) < _CHUNK // 32 else step
        pairs += len(a)
        keep = (a < b) | ~is_fresh[alive[b]] & (a != b)
        a, b = a[keep], b[keep]
        keep = _may_meet(places, ends[a], ends[b], most)
        meetings += int(keep.sum())
        if pairs > MOST_PAIRS or meetings > MOST_MEETINGS:
            raise CrowdedError
        yield from zip(alive[a[keep]].tolist(), alive[b[keep]].tolist(), strict=True)


def _may_meet(places: NDArray[Any], a: NDArray[Any], b: NDArray[Any], most: float) -> NDArray[np.bool_]:
    """True for each pair of edges, unless doubles prove that they share at most a common end."""
    p, q, r, s = places[a[:, 0]], places[a[:, 1]], places[b[:, 0]], places[b[:, 1]]
    to_r, to_s = _signs(p, q, r, most), _signs(p, q, s, most)
    to_p, to_q = _signs(r, s, p, most), _signs(r, s, q, most)
    apart = (to_r * to_s > 0) | (to_p * to_q > 0)
    same_start, same_end = a[:, 0] == b[:, 0], a[:, 1] == b[:, 1]
    chain, back = a[:, 1] == b[:, 0], a[:, 0] == b[:, 1]
    # with a common end, the other ends have to be beside the other edge
    apart |= (same_start | back) & (to_q != 0) | (same_end | chain) & (to_p != 0)
    result: NDArray[np.bool_] = ~apart
    return result


def _signs(p: NDArray[Any], q: NDArray[Any], r: NDArray[Any], most: float) -> NDArray[Any]:
    """Proven signs of orientations, 0 where doubles do not decide."""
    d, e = q - p, r - p
    left, right = d[:, 0] * e[:, 1], d[:, 1] * e[:, 0]
    size = np.abs(d).sum(axis=1) + np.abs(e).sum(axis=1)
    bound = 6e-16 * (np.abs(left) + np.abs(right)) + 6e-16 * most * size + 1e-30 * most * most
    value = left - right
    signs: NDArray[Any] = np.where(np.abs(value) > bound, np.sign(value), 0).astype(np.int8)
    return signs
