"""Curves of a drawing in one noding, and the way back from its edges to lines and curves.

Each line and each chord of a curve is a source of edges, a `Piece`. Ends that differ by less than the rounding of their
digits are one vertex, the first of them. Arcs of one circle are divided at each other's ends, so that parts that are
drawn twice have the same chords. A chord that is cut between its ends is divided at the nearest point of its curve,
until the cut is on the curve.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from cfree.curves.drawn import Arc, Cubic, Line, Ring, Segment, Vector, point_of
from cfree.exact.number import ExactPoint
from cfree.formats.drawings.chords import (
    joints,
    nearest,
    noise,
    part_of,
    place_at,
    range_of,
    steps_of,
)
from cfree.polygons.faces import Cycle, Faces
from cfree.polygons.noding import graph_of

ROUNDS = 8
"""Maximum number of times that cut chords are divided."""
WIDER = 8
"""Growth of the distances between new ends of chords, away from a cut."""
NEAR = 32
"""A node this many times the rounding of doubles away from a curve is on it."""
Run = tuple[int, float, float]
"""A carrier and two parameters; or a number below 0 for a line, 0, and 1 or -1 for its direction."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A source of edges between two vertices: a line, or a chord of a carrier between two parameters."""

    owner: int
    start: int
    end: int
    carrier: int = -1
    first: float = 0.0
    last: float = 0.0


class Mesh:
    """Curves and rings in one graph.

    Attributes
    ----------
    pieces : list of Piece
        Sources of the graph's edges; `owner` is the number of a curve.
    vertices : list of points
        Ends of segments and chords, exact.
    carriers : list of Segment
        Curves that have chords.
    """

    def __init__(self, sagitta: float, spend: Callable[[int], object]) -> None:
        self.sagitta = sagitta
        self.spend = spend
        self.vertices: list[ExactPoint] = []
        self.rounding: list[float] = []
        self.pieces: list[Piece] = []
        self.carriers: list[Segment] = []
        self._parts: list[tuple[Piece, Segment]] = []

    def add(self, owner: int, segments: Sequence[Segment], *, closed: bool, rounding: float = 0.0) -> tuple[int, int]:
        """Add connected segments; return the vertices of their ends."""
        points = list(joints(list(segments), closed=closed))
        chain = [self._vertex(p, rounding + noise(s)) for p, s in zip(points, segments, strict=False)]
        chain.append(chain[0] if closed else self._vertex(points[-1], rounding + noise(segments[-1])))
        for segment, start, end in zip(segments, chain, chain[1:], strict=False):
            last = end
            if isinstance(segment, Line) and segment.end != self.vertices[end]:  # the next one begins elsewhere
                last = self._vertex(segment.end, rounding)
                self._parts.append((Piece(owner, last, end), Line(segment.end, self.vertices[end])))
            self._parts.append((Piece(owner, start, last), segment))
        return chain[0], chain[-1]

    def build(self, loose: Sequence[int] = (), reach: float = 0.0) -> None:
        """Make the graph.

        Parameters
        ----------
        loose : sequence of int
            Vertices that may lie on curves: curves are divided beside them.
        reach : float
            Distance up to which a vertex is beside a curve.
        """
        self.first = self._snapped()
        first = self.first
        parts = [(Piece(piece.owner, first[piece.start], first[piece.end]), segment) for piece, segment in self._parts]
        pieces = [piece for piece, segment in parts if isinstance(segment, Line)]
        chords = [*self._chords([part for part in parts if not isinstance(part[1], Line)])]
        pieces += self._beside(chords, {self.first[vertex] for vertex in loose}, reach)
        self.spend(len(pieces))
        self.graph = graph_of(self.vertices[end] for piece in pieces for end in (piece.start, piece.end))
        self._nodes: dict[int, int] = {}
        self._draw(pieces)
        if chords:
            self._refine()
        self._rounding: dict[int, float] = {}
        for vertex, j in enumerate(self.first):
            node = self._nodes.get(j)
            if node is not None:
                self._rounding[node] = max(self.rounding[vertex], self._rounding.get(node, 0.0))

    def node(self, vertex: int) -> int:
        """Return the point of the graph at a vertex; -1 - k stands for point k itself."""
        if vertex < 0:
            return -1 - vertex
        vertex = self.first[vertex] if vertex < len(self.first) else vertex
        if vertex not in self._nodes:
            self._nodes[vertex] = self.graph.index(self.vertices[vertex])
        return self._nodes[vertex]

    def rounding_at(self, node: int) -> float:
        """Rounding of the ends of curves at a point of the graph."""
        return self._rounding.get(node, 0.0)

    def connect(self, lines: Iterable[tuple[int, int, int]]) -> None:
        """Add lines between two points of the graph, with their owners."""
        lines = list(lines)
        count = len(self.pieces)
        self.pieces += [Piece(owner, -1 - start, -1 - end) for start, end, owner in lines]
        self.graph.join((start, end, count + k) for k, (start, end, _) in enumerate(lines))

    def outline(self, faces: Faces, cycle: Cycle) -> Ring:
        """Return a cycle of half-edges as lines and parts of curves, from the point that was drawn first."""
        runs = [self._run(half) for half in cycle]
        corners = [k for k, run in enumerate(runs) if not _goes_on(runs[k - 1], run)]
        drawn = self.node(self.pieces[self.first_piece(cycle)].start)
        begin = min(corners, key=lambda k: (faces.origin(cycle[k]) != drawn, k), default=0)
        merged: list[tuple[Run, int, int]] = []
        for half, run in zip(cycle[begin:] + cycle[:begin], runs[begin:] + runs[:begin], strict=True):
            start, end = faces.origin(half), faces.origin(half ^ 1)
            if merged and _goes_on(merged[-1][0], run):
                before, first, _ = merged[-1]
                merged[-1] = (run[0], before[1], run[2]), first, end
            else:
                merged.append((run, start, end))
        return [self._segment(*item) for item in merged]

    def first_piece(self, cycle: Cycle) -> int:
        """Return the first source of a cycle's edges."""
        return min(source for half in cycle for source, _ in self.graph.uses[half >> 1])

    def _segment(self, run: Run, start: int, end: int) -> Segment:
        p, q = self.graph.point(start), self.graph.point(end)
        carrier, first, last = run
        return part_of(self.carriers[carrier], first, last, (p, q)) if carrier >= 0 else Line(p, q)

    def owners(self, edge: int) -> Iterator[tuple[int, int]]:
        """Yield the curves that an edge is part of, and the direction in which each runs through it."""
        for source, sign in self.graph.uses[edge]:
            yield self.pieces[source].owner, sign

    def _run(self, half: int) -> Run:
        """Carrier and parameters of a half-edge on a curve; of a line -1 - source, with 0 and its direction."""
        edge = half >> 1
        lines: list[Run] = []
        for source, sign in self.graph.uses[edge]:
            piece = self.pieces[source]
            forward = (sign > 0) == (not half & 1)
            if piece.carrier < 0:
                lines.append((-1 - source, 0.0, 1.0 if forward else -1.0))
                continue
            ends = self.graph.edges[edge] if sign > 0 else self.graph.edges[edge][::-1]
            a, b = (self._parameter(piece, node) for node in ends)
            if a is not None and b is not None and a != b:
                return (piece.carrier, a, b) if forward else (piece.carrier, b, a)
        return min(lines, default=(-1 - len(self.pieces) - half, 0.0, 1.0))

    def _parameter(self, piece: Piece, node: int) -> float | None:
        """Parameter of a node on a chord, if it is on the curve, as far as doubles tell."""
        if node == self.node(piece.start):
            return piece.first
        if node == self.node(piece.end):
            return piece.last
        curve, p = self.carriers[piece.carrier], self.graph.place(node)
        t = nearest(curve, p, piece.first, piece.last)
        return t if math.dist(place_at(curve, t), p) <= NEAR * noise(curve) else None

    def _is_whole(self, edge: int, piece: Piece) -> bool:
        return set(self.graph.edges[edge]) == {self.node(piece.start), self.node(piece.end)}

    def _vertex(self, p: ExactPoint, rounding: float) -> int:
        self.vertices.append(p)
        self.rounding.append(rounding)
        return len(self.vertices) - 1

    def _draw(self, pieces: Sequence[Piece]) -> None:
        count = len(self.pieces)
        self.pieces += pieces
        nodes = [(self.node(piece.start), self.node(piece.end)) for piece in pieces]
        self.graph.join((p, q, count + k) for k, (p, q) in enumerate(nodes))

    # vertices

    def _snapped(self) -> list[int]:
        """Return the first vertex that is the same point as each, as far as the digits say."""
        import shapely

        exact: dict[ExactPoint, int] = {}
        first = [exact.setdefault(p, k) for k, p in enumerate(self.vertices)]
        for k, j in enumerate(first):
            self.rounding[j] = max(self.rounding[j], self.rounding[k])
        some = list(exact.values())
        reach = np.array([self.rounding[k] for k in some])
        if not reach.any():
            return first
        points = shapely.points(np.array([self._float(k) for k in some]))
        a, b = shapely.STRtree(points).query(points, predicate="dwithin", distance=reach + reach.max())
        keep = a < b
        for i, j in sorted(zip(a[keep].tolist(), b[keep].tolist(), strict=True)):
            p, q = some[i], some[j]
            if first[p] == p and first[q] == q and self._distance(p, q) <= self.rounding[p] + self.rounding[q]:
                first[q] = p
        return [first[j] for j in first]

    def _float(self, vertex: int) -> Vector:
        x, y = self.vertices[vertex]
        return float(x), float(y)

    def _distance(self, p: int, q: int) -> float:
        (a, b), (c, d) = self.vertices[p], self.vertices[q]
        return math.hypot(float(a - c), float(b - d))

    # chords

    def _chords(self, parts: list[tuple[Piece, Segment]]) -> Iterator[Piece]:
        """Yield the chords of all curves; arcs of one circle and equal curves share their carrier."""
        for group in self._groups(parts):
            piece, segment = group[0]
            self.carriers.append(segment)
            number = len(self.carriers) - 1
            if len(group) > 1 and isinstance(segment, Arc):
                yield from self._circle(number, group)
                continue
            between: dict[float, int] = {}
            for other, _ in group:
                first, last = range_of(segment)
                if other.start != piece.start:  # the same curve, reversed
                    first, last = last, first
                yield from self._divided(replace(other, carrier=number, first=first, last=last), between)

    def _groups(self, parts: list[tuple[Piece, Segment]]) -> list[list[tuple[Piece, Segment]]]:
        """Group curves that lie on one another."""
        groups: list[list[tuple[Piece, Segment]]] = []
        near: dict[tuple[int, ...], list[int]] = defaultdict(list)
        for piece, segment in parts:
            reach = 2 * max(self.rounding[piece.start], self.rounding[piece.end]) + noise(segment)
            is_arc = isinstance(segment, Arc) and segment.circular
            if is_arc:
                assert isinstance(segment, Arc)
                numbers = (*segment.center, math.hypot(*segment.u))
                cells = _cells(numbers, reach)
            else:
                cells = [(min(piece.start, piece.end), max(piece.start, piece.end))]
            rivals = (k for cell in cells for k in near[cell])
            one = next((k for k in rivals if self._is_one(groups[k][0], (piece, segment), reach)), None)
            if one is not None:
                groups[one].append((piece, segment))
                continue
            groups.append([(piece, segment)])
            near[cells[0]].append(len(groups) - 1)
        return groups

    def _is_one(self, a: tuple[Piece, Segment], b: tuple[Piece, Segment], reach: float) -> bool:
        """True if two curves lie on one circle, or are equal, as far as the digits say."""
        match a[1], b[1]:
            case Arc() as p, Arc() as q:
                if not (p.circular and q.circular):
                    return p == q and a[0].start == b[0].start
                apart = max(math.dist(p.center, q.center), abs(math.hypot(*p.u) - math.hypot(*q.u)))
                return apart <= 2 * reach
            case Cubic(points), Cubic(others):
                if (a[0].start, a[0].end) != (b[0].start, b[0].end):
                    others = (others[3], others[2], others[1], others[0])
                return max(map(math.dist, points, others)) <= 4 * reach
        return False

    def _divided(self, piece: Piece, between: dict[float, int]) -> Iterator[Piece]:
        """Yield the chords of a piece of a curve; `between` has the vertices by their parameters."""
        curve = self.carriers[piece.carrier]
        steps = steps_of(curve, piece.first, piece.last, self.sagitta)
        for t in steps[1:-1]:
            if t not in between:
                between[t] = self._vertex(point_of(*place_at(curve, t)), 0.0)
        yield from _cut(piece, [(t, between[t]) for t in steps[1:-1]])

    def _circle(self, carrier: int, group: list[tuple[Piece, Segment]]) -> Iterator[Piece]:
        """Yield chords of arcs of one circle, divided at the ends of all of them and at angle 0."""
        arc = self.carriers[carrier]
        assert isinstance(arc, Arc)
        (x, y), radius = arc.center, math.hypot(*arc.u)
        curve = self.carriers[carrier] = Arc(arc.center, (radius, 0.0), (0.0, radius), 0.0, math.tau)
        angle: dict[int, float] = {}
        for vertex in (vertex for piece, _ in group for vertex in (piece.start, piece.end)):
            p, q = self._float(vertex)
            angle[vertex] = math.atan2(q - y, p - x) % math.tau
        if 0.0 not in angle.values():
            angle[self._vertex(point_of(*curve.at(0.0)), 0.0)] = 0.0
        marks = sorted(angle, key=angle.__getitem__)
        place = {vertex: k for k, vertex in enumerate(marks)}
        between: dict[float, int] = {}
        for piece, segment in group:
            assert isinstance(segment, Arc)
            (a, b), (c, d) = segment.u, segment.v
            if piece.start == piece.end and abs(segment.last - segment.first) < math.pi:
                continue  # so short that it is a point
            forward = ((a * d - b * c) > 0) == (segment.last > segment.first)
            start, end = (piece.start, piece.end) if forward else (piece.end, piece.start)
            begin, count = place[start], len(marks)
            for k in range(begin, begin + ((place[end] - begin) % count or count)):
                p, q = marks[k % count], marks[(k + 1) % count]
                first, last = angle[p], angle[q] or math.tau
                if not forward:
                    (p, q), (first, last) = (q, p), (last, first)
                yield from self._divided(Piece(piece.owner, p, q, carrier, first, last), between)

    def _beside(self, chords: list[Piece], loose: set[int], reach: float) -> list[Piece]:
        """Divide chords beside loose vertices."""
        import shapely

        if not chords or not loose:
            return chords
        tips = np.array([[self._float(piece.start), self._float(piece.end)] for piece in chords])
        probes = sorted(loose)
        points = shapely.points(np.array([self._float(vertex) for vertex in probes]))
        tree = shapely.STRtree(shapely.linestrings(tips))
        pairs = tree.query(points, predicate="dwithin", distance=max(reach, 2 * self.sagitta))
        marks: dict[int, dict[float, int]] = defaultdict(dict)
        for i, k in zip(*pairs.tolist(), strict=True):
            vertex, piece = probes[i], chords[k]
            if vertex in (piece.start, piece.end):
                continue
            curve = self.carriers[piece.carrier]
            t = nearest(curve, self._float(vertex), piece.first, piece.last)
            if min(piece.first, piece.last) < t < max(piece.first, piece.last):
                place = place_at(curve, t)
                is_on = math.dist(place, self._float(vertex)) <= self.rounding[vertex] + noise(curve)
                marks[k][t] = vertex if is_on else self._vertex(point_of(*place), 0.0)
        return [part for k, piece in enumerate(chords) for part in _cut(piece, list(marks[k].items()))]

    def _refine(self) -> None:
        """Divide cut chords at the nearest points of their curves, until the cuts are on them."""
        graph = self.graph
        for _ in range(ROUNDS):
            marks: dict[int, dict[float, int]] = defaultdict(dict)
            for edge in graph.alive():
                for source, _ in graph.uses[edge]:
                    piece = self.pieces[source]
                    if piece.carrier < 0 or self._is_whole(edge, piece):
                        continue
                    for node in graph.edges[edge]:
                        if node not in (self.node(piece.start), self.node(piece.end)):
                            self._mark(piece, node, marks[source])
            marks = {source: between for source, between in marks.items() if between}
            if not marks:
                return
            graph.remove(set(marks))
            cut = [(self.pieces[source], list(between.items())) for source, between in marks.items()]
            self._draw([part for piece, between in cut for part in _cut(piece, between)])

    def _mark(self, piece: Piece, node: int, between: dict[float, int]) -> None:
        """Find points of a curve around a node on its chord, unless the node is on the curve.

        Near the node the new chords are as short as the node is far from the curve, and longer away from it, so that
        the distance falls about quadratically from round to round.
        """
        if self._parameter(piece, node) is not None:
            return
        curve, p = self.carriers[piece.carrier], self.graph.place(node)
        start, end = (self.graph.place(self.node(vertex)) for vertex in (piece.start, piece.end))
        low, high = sorted((piece.first, piece.last))
        t = nearest(curve, p, low, high)
        if t in (low, high):  # the curve's nearest point is beyond the chord
            share = math.dist(start, p) / (math.dist(start, p) + math.dist(p, end))
            t = piece.first + share * (piece.last - piece.first)
        marks, reach = [t], 4 * math.dist(place_at(curve, t), p) / math.dist(start, end) * (high - low)
        while reach > 0 and (t - reach > low or t + reach < high):
            marks += t - reach, t + reach
            reach *= WIDER
        for mark in marks:
            if low < mark < high:
                between[mark] = self._vertex(point_of(*place_at(curve, mark)), 0.0)


def _cut(piece: Piece, between: list[tuple[float, int]]) -> Iterator[Piece]:
    """Divide a chord at vertices with their parameters."""
    between = sorted(between, reverse=piece.first > piece.last)
    steps = [(piece.first, piece.start), *between, (piece.last, piece.end)]
    for (s, p), (t, q) in pairwise(steps):
        yield Piece(piece.owner, p, q, piece.carrier, s, t)


def _goes_on(before: Run, run: Run) -> bool:
    """True if a run goes on with another one on the same line or curve, in the same direction."""
    if before[0] != run[0]:
        return False
    if run[0] < 0:
        return before == run
    return before[2] == run[1] and (before[2] > before[1]) == (run[2] > run[1])


def _cells(numbers: tuple[float, ...], reach: float) -> list[tuple[int, ...]]:
    """Cells of a grid that hold all numbers within a distance, the own cell first."""
    width = 4 * 2.0 ** math.ceil(math.log2(reach)) if reach else 1.0
    own = tuple(math.floor(value / width) for value in numbers)
    cells: list[tuple[int, ...]] = [()]
    for value in own:
        cells = [(*cell, value + step) for cell in cells for step in (0, -1, 1)]
    return [(*cell, math.frexp(width)[1]) for cell in cells]
