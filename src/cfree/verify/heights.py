"""Segments against open pillars, many at a time: doubles with a bound decide the certain cases, exact numbers the rest.

The pillar of a convex piece of an obstacle and a convex part of the robot holds the points x to which the part, turned,
cannot be moved without overlapping the piece. It is the intersection of open half planes. The *heights* over them,

    u x (x - p) + max over vertices a of u x R a         for an edge of the piece, from p along u,
    max over vertices y of R v x (y - x - R a)           for an edge of the part, from a along v,

are linear in x, and positive inside. They alone decide that a segment has no point in the open pillar.

Notes
-----
Coordinates are divided by the world's unit: then none is larger than 1, nor than 1/4 in the robot. A quotient of
integers is rounded once, cos and sin are off by 2^-50 at most (`rough_rotation`), so the coordinates of x, p and R a
are off by 2^-48. Of u x (x - p + R a) each of at most eight products is at most 3 (|u_x| + |u_y|), and is off by that
times 2^-47 at most. `ERROR` times |u_x| + |u_y|, and `LEAST` for underflows, are more than all errors together.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from cfree.exact.algebraic import Exact, ratio
from cfree.verify.polygons import Ring
from cfree.verify.surfaces import ZERO, Line, Surface, Turn, Vector, cross, minus

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Interval = tuple[Exact, Exact]
Contacts = Sequence[tuple[Floats, Floats]]
"""The vectors a, g, b and q of surfaces, each x and y, rounded."""
ERROR, LEAST = 2.0**-42, 2.0**-980
NEAR = 2.0**-40  # boxes are larger by more than their rounding
MOST = 1 << 22  # pairs of a box and a segment that are compared at a time


class Shape:
    """A convex ring, exactly and rounded."""

    def __init__(self, ring: Ring, unit: int, *, is_point: bool = False) -> None:
        self.ring = ring
        along = [] if is_point else [minus(q, p) for p, q in zip(ring, ring[1:] + ring[:1], strict=True)]
        self.x, self.y = columns(ring, unit)
        self.u, self.v = columns(along, unit)
        self.bound = ERROR * (abs(self.u) + abs(self.v)) + LEAST
        """Bounds of the errors of heights over each edge."""

    def turned(self, c: Floats, s: Floats) -> tuple[Floats, Floats]:
        """(k, n) its vertices at every angle."""
        return _turned(self.x, self.y, c, s)


@dataclass(frozen=True)
class Segments:
    """Segments at orientations, rounded.

    Attributes
    ----------
    c, s : (n,) or (1,) float64
        Cosines and sines.
    x, y : (2, n) float64
        Both ends.
    """

    c: Floats
    s: Floats
    x: Floats
    y: Floats

    @classmethod
    def of(cls, turns: Sequence[Turn], contacts: Contacts, t: Floats) -> Segments:
        """Parts of contacts, from t[0] to t[1], at one orientation for all or one for each."""
        c, s = np.array([rough_rotation(turn) for turn in turns]).reshape(-1, 2).T
        (ax, ay), (gx, gy), (bx, by), (qx, qy) = contacts
        rx, ry = ax + t * gx, ay + t * gy
        return cls(c, s, bx + t * qx - (c * rx - s * ry), by + t * qy - (s * rx + c * ry))

    def some(self, chosen: Ints) -> Segments:
        rows = chosen if len(self.c) > 1 else slice(None)
        return Segments(self.c[rows], self.s[rows], self.x[:, chosen], self.y[:, chosen])


class World(Protocol):
    """The convex pieces of a scene, and its contacts; `cfree.verify.world.World` is one."""

    @property
    def unit(self) -> int: ...
    @property
    def parts(self) -> list[Ring]: ...
    @property
    def obstacle_pieces(self) -> list[Ring]: ...
    @property
    def beyond(self) -> list[Ring]: ...
    @property
    def pillars(self) -> Pillars: ...
    def contacts_at(self, turn: Turn) -> tuple[Contacts, Callable[[int], Surface]]: ...


class Pillars:
    """All open pillars of a world, numbered as in `Section`."""

    def __init__(self, world: World) -> None:
        self.unit = world.unit
        self._parts = [Shape(ring, world.unit) for ring in world.parts]
        self._pieces = [Shape(ring, world.unit) for ring in world.obstacle_pieces]
        self._beyond = [Shape(ring, world.unit) for ring in world.beyond]
        self._point = Shape([ZERO], world.unit, is_point=True)

    def __getitem__(self, number: int) -> tuple[Shape, Shape]:
        """A piece and a part."""
        k, part = divmod(number, len(self._parts))
        if k < len(self._pieces):
            return self._pieces[k], self._parts[part]
        return self._beyond[number - len(self._pieces) * len(self._parts)], self._point

    @cached_property
    def _boxes(self) -> tuple[Floats, Floats]:
        """(2, pieces) least and greatest coordinates."""
        boxes = [
            [[extreme(shape.x), extreme(shape.y)] for shape in (*self._pieces, *self._beyond)]
            for extreme in (np.min, np.max)
        ]
        low, high = (np.array(box, np.float64).reshape(-1, 2).T for box in boxes)
        return low, high

    def near(self, segments: Segments) -> Iterator[tuple[int, Ints]]:
        """Numbers of pillars, each with the segments that may meet it."""
        count, (low, high) = len(self._pieces), self._boxes
        groups = [(part, slice(0, count), m) for m, part in enumerate(self._parts)]
        groups.append((self._point, slice(count, None), 0))
        for part, pieces, m in groups:
            meets: NDArray[np.bool_] = np.ones((low[0, pieces].size, segments.x.shape[1]), bool)
            turned = part.turned(segments.c, segments.s)
            for ends, arm, lo, hi in zip(
                (segments.x, segments.y), turned, low[:, pieces], high[:, pieces], strict=True
            ):
                meets &= lo[:, None] <= ends.max(axis=0) + arm.max(axis=0) + NEAR
                meets &= hi[:, None] >= ends.min(axis=0) + arm.min(axis=0) - NEAR
            for k in np.flatnonzero(meets.any(axis=1)).tolist():
                number = k * len(self._parts) + m if part is not self._point else count * len(self._parts) + k
                yield number, np.flatnonzero(meets[k])

    def blocks(self, segments: Segments) -> Iterator[Ints]:
        """Numbers of segments, so few at a time that little memory is needed."""
        count = segments.x.shape[1]
        step = max(1, MOST // max(1, len(self._pieces) + len(self._beyond)))
        return (np.arange(k, min(k + step, count)) for k in range(0, count, step))


def rough_rotation(turn: Turn) -> tuple[float, float]:
    """Cosine and sine, off by 2^-50 at most: neither changes more than twice as fast as tau, |tau| <= 1."""
    tau = float(turn.tau if isinstance(turn.tau, Fraction) else turn.rounded.tau)
    w = 1 + tau * tau
    sign = -1 if turn.chart else 1
    return sign * (1 - tau) * (1 + tau) / w, sign * 2 * tau / w


def heights(piece: Shape, part: Shape, segments: Segments) -> tuple[Floats, Floats]:
    """(2, edges, n) heights of both ends, over the piece's edges, then the part's; (edges,) bounds of their errors."""
    rx, ry = part.turned(segments.c, segments.s)
    u, v = piece.u[:, None], piece.v[:, None]
    farthest = (u[:, None] * ry - v[:, None] * rx).max(axis=1) - (piece.u * piece.y - piece.v * piece.x)[:, None]
    over_piece = farthest + u * segments.y[:, None] - v * segments.x[:, None]
    tu, tv = _turned(part.u, part.v, segments.c, segments.s)
    y, x = piece.y[:, None], piece.x[:, None]
    farthest = (tu[:, None] * y - tv[:, None] * x).max(axis=1)
    farthest -= (part.u * part.y[: len(part.u)] - part.v * part.x[: len(part.u)])[:, None]
    over_part = farthest - tu * segments.y[:, None] + tv * segments.x[:, None]
    return np.concatenate([over_piece, over_part], axis=1), np.concatenate([piece.bound, 2 * part.bound])


class HalfPlanes:
    """The same heights at one angle, exactly; each is made when first needed."""

    def __init__(self, turn: Turn) -> None:
        self._turn, self._rough = turn, rough_rotation(turn)
        self._made: dict[tuple[int, int, int], tuple[Vector, Exact]] = {}

    def over(self, piece: Shape, part: Shape, edge: int, line: Line) -> tuple[Exact, Exact]:
        """Height over an edge at a line's t = 0, and its growth; times w, or times its square."""
        key = id(piece), id(part), edge
        if key not in self._made:
            self._made[key] = self._edge(piece, part, edge)
        u, constant = self._made[key]
        return cross(u, line.start) + constant, cross(u, line.along)

    def _edge(self, piece: Shape, part: Shape, edge: int) -> tuple[Vector, Exact]:
        """Vector u and constant of the height u x (w x) + constant over an edge."""
        ring, other, (c, s) = piece.ring, part.ring, self._rough
        if edge < len(ring):
            p = ring[edge]
            u = minus(ring[(edge + 1) % len(ring)], p)
            ru, rv = piece.u[edge] * c + piece.v[edge] * s, piece.v[edge] * c - piece.u[edge] * s
            highest = _highest(ru * part.y - rv * part.x, piece.bound[edge])
            return u, max(cross(u, self._turn(other[a])) for a in highest) - cross(u, self._turn.fixed(p))
        k = edge - len(ring)
        v = self._turn(minus(other[(k + 1) % len(other)], other[k]))
        ru, rv = part.u[k] * c - part.v[k] * s, part.u[k] * s + part.v[k] * c
        highest = _highest(ru * piece.y - rv * piece.x, 2 * part.bound[k])
        above = max(cross(v, self._turn.fixed(ring[y])) for y in highest)
        return (-v[0], -v[1]), above - cross(v, self._turn(other[k]))

    def meet(self, piece: Shape, part: Shape, line: Line, ends: Interval, edges: Iterable[int]) -> bool:
        """True if an open pillar holds a point of the open part of a line from one t to another; edges in any order."""
        lo, hi = ends
        for edge in edges:
            height, slope = self.over(piece, part, edge, line)
            if height + slope * ends[0] <= 0 and height + slope * ends[1] <= 0:
                return False
            if slope > 0:
                lo = max(lo, ratio(-height, slope))
            elif slope < 0:
                hi = min(hi, ratio(-height, slope))
            if lo >= hi:
                return False
        return True

    def crossing(self, piece: Shape, part: Shape, line: Line, edges: Iterable[int]) -> Interval | None:
        """The open interval of t at which a line is inside a pillar, from -1 to 2; None if that is nowhere in [0, 1].

        Only some edges are given: over the others the line is inside from t = 0 to 1.
        """
        lo: Exact = -1
        hi: Exact = 2
        for edge in edges:
            height, slope = self.over(piece, part, edge, line)
            if height <= 0 and height + slope <= 0:
                return None
            if slope > 0:
                lo = max(lo, ratio(-height, slope))
            elif slope < 0:
                hi = min(hi, ratio(-height, slope))
        return (lo, hi) if lo < hi and lo < 1 and hi > 0 else None


def _highest(values: Floats, bound: float) -> list[int]:
    """Numbers of the values, each off by a bound at most, that may be the greatest."""
    numbers: list[int] = np.flatnonzero(values >= values.max() - 2 * bound).tolist()
    return numbers


# --- queries ---


def covered(world: World, items: Sequence[tuple[Surface, Turn, Fraction, Fraction]]) -> list[int]:
    """Numbers of the parts of contacts that an open pillar covers, each at its own rational angle, t in [0, 1].

    Decided exactly: an edge that a segment is outside of, by doubles, counts only beyond their error.
    """
    pillars, numbers = world.pillars, set[int]()
    t = np.array([[float(item[2]) for item in items], [float(item[3]) for item in items]])
    surfaces, turns = [item[0] for item in items], [item[1] for item in items]
    contacts = [columns([getattr(surface, name) for surface in surfaces], pillars.unit) for name in "agbq"]
    segments = Segments.of(turns, contacts, t)
    exact = [HalfPlanes(turn) for turn in turns]
    for block in pillars.blocks(segments):
        for number, near in pillars.near(segments.some(block)):
            piece, part = pillars[number]
            chosen = block[near]
            here = segments.some(chosen)
            above, bound = heights(piece, part, here)
            highest = above.max(axis=0)  # of both ends
            left = np.flatnonzero(~(highest <= -bound[:, None]).any(axis=0))
            if not len(left):
                continue
            order = highest[:, left].argsort(axis=0)
            touching = _is_own(piece, part, here.some(left), order[0])
            for k, edges, vertex in zip(chosen[left].tolist(), order.T.tolist(), touching.tolist(), strict=True):
                surface, turn, *ends = items[k]
                if vertex >= 0 and lies_along(surface, piece, part, edges[0], vertex):
                    continue
                if exact[k].meet(piece, part, turn.line(surface), (ends[0], ends[1]), edges):
                    numbers.add(k)
    return sorted(numbers)


def _is_own(piece: Shape, part: Shape, segments: Segments, edge: Ints) -> Ints:
    """Vertex over which the height over an edge, one for each segment, is counted; -1 where that is uncertain."""
    count, result = len(piece.ring), np.full(len(edge), -1)
    for is_piece in (True, False):
        which = np.flatnonzero((edge < count) == is_piece)
        if not len(which):
            continue
        k, here = edge[which] if is_piece else edge[which] - count, segments.some(which)
        if is_piece:
            rx, ry = part.turned(here.c, here.s)
            values, bound = piece.u[k] * ry - piece.v[k] * rx, piece.bound[k]
        else:
            tu, tv = part.u[k], part.v[k]
            tu, tv = here.c * tu - here.s * tv, here.s * tu + here.c * tv
            values, bound = tu * piece.y[:, None] - tv * piece.x[:, None], 2 * part.bound[k]
        values = np.broadcast_to(values, (len(values), len(which)))
        if len(values) > 1:
            second, first = np.partition(values, -2, axis=0)[-2:]
            result[which] = np.where(first - second > 2 * bound, values.argmax(axis=0), -1)
    return result


def lies_along(surface: Surface, piece: Shape, part: Shape, edge: int, vertex: int) -> bool:
    """True if a contact is that of an edge and the vertex that counts over it; then its height is 0 all along."""
    count = len(piece.ring)
    if edge < count:
        p, q = piece.ring[edge], piece.ring[(edge + 1) % count]
        return (surface.g, surface.b, surface.a) == (ZERO, p, part.ring[vertex]) and minus(q, p) == surface.q
    a, end = part.ring[edge - count], part.ring[(edge - count + 1) % len(part.ring)]
    return (surface.q, surface.a, surface.b) == (ZERO, a, piece.ring[vertex]) and minus(end, a) == surface.g


def left_over(world: World, turn: Turn) -> Iterator[tuple[Surface, list[Interval]]]:
    """Closed intervals of t in [0, 1] that open pillars leave of contacts at one angle; no contact without any."""
    pillars, exact = world.pillars, HalfPlanes(turn)
    contacts, surface_of = world.contacts_at(turn)
    segments = Segments.of([turn], contacts, np.array([[0.0], [1.0]]))
    for block in pillars.blocks(segments):
        inside: list[list[_Sure]] = [[] for _ in block]
        is_covered = np.zeros(len(block), bool)
        for number, near in pillars.near(segments.some(block)):
            near = near[~is_covered[near]]
            if not len(near):
                continue
            piece, part = pillars[number]
            above, bound = heights(piece, part, segments.some(block[near]))
            asked = np.asarray((above <= bound[:, None]).any(axis=0))  # edges without both ends surely inside
            left = np.asarray(asked.any(axis=0))
            is_covered[near[~left]] = True
            left &= ~(above <= -bound[:, None]).all(axis=0).any(axis=0)  # surely outside of an edge
            lo, hi = _surely_inside(above - bound[:, None])
            for k in np.flatnonzero(left).tolist():
                edges = np.flatnonzero(asked[:, k]).tolist()
                inside[near[k]].append(_Sure(float(lo[k]), float(hi[k]), piece, part, edges))
        for k in np.flatnonzero(~is_covered).tolist():
            if not _cover_all(inside[k]):
                surface = surface_of(int(block[k]))
                line = turn.line(surface)
                crossings = (exact.crossing(sure.piece, sure.part, line, sure.edges) for sure in inside[k])
                if free := without(filter(None, crossings)):
                    yield surface, free


@dataclass(frozen=True)
class _Sure:
    """An interval in which a line is certainly inside a pillar, and the edges that decide its exact ends."""

    lo: float
    hi: float
    piece: Shape
    part: Shape
    edges: list[int]


def _surely_inside(above: Floats) -> tuple[Floats, Floats]:
    """Open interval of t for each segment in which heights are certainly positive; from -1 or to 2 if ends are in."""
    first, last = above
    with np.errstate(all="ignore"):
        t = first / (first - last)
    is_in = above > 0
    lo = np.where(is_in[0], -1.0, np.where(is_in[1], t + NEAR, 2.0)).max(axis=0)
    hi = np.where(is_in[1], 2.0, np.where(is_in[0], t - NEAR, -1.0)).min(axis=0)
    return lo, hi


def _cover_all(known: Sequence[_Sure]) -> bool:
    """True if open intervals certainly cover all of [0, 1]."""
    end = -1.0
    for sure in sorted(known, key=lambda sure: sure.lo):
        if sure.lo < end or sure.lo == end == -1.0:
            end = max(end, sure.hi)
    return end > 1


def without(intervals: Iterable[Interval]) -> list[Interval]:
    """Remainder of [0, 1] outside open intervals; some parts of it are points."""
    gaps: list[Interval] = []
    end: Exact = 0
    for lo, hi in sorted(intervals):
        if end <= lo:
            gaps.append((end, lo))
        end = max(end, hi)
    return [(lo, min(hi, 1)) for lo, hi in [*gaps, (end, 1)] if lo <= min(hi, 1)]


def columns(points: Sequence[Vector], unit: int) -> tuple[Floats, Floats]:
    """Coordinates of integers in a unit, each rounded once."""
    x, y = (np.array([p[k] / unit for p in points], np.float64) for k in (0, 1))
    return x, y


def _turned(x: Floats, y: Floats, c: Floats, s: Floats) -> tuple[Floats, Floats]:
    x, y = x[:, None], y[:, None]
    return c * x - s * y, s * x + c * y
