"""The core's sweep over the edges of rings, which finds crossings, touches of rings, and their nesting.

Shamos and Hoey's sweep from left to right (the vertical line leans, so that points are met in the order of
their pairs of coordinates). It keeps the edges it cuts in their order from below to above; edges that cross
are neighbours there just before they do, so testing new neighbours finds a crossing if there is one.
O(n log n) exact comparisons.

    edge k goes from point k to the next point of its ring
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

from cfree.errors import InvariantError
from cfree.exact.number import IntPoint
from cfree.exact.orientation import Location, Meeting, Orientation, locate_in_sector, meet, orient


@dataclass(frozen=True, slots=True)
class EdgesMeet:
    """Two edges that cross or overlap, or touch though they belong to one ring and are no neighbours."""

    edges: tuple[int, int]


@dataclass(frozen=True, slots=True)
class Nesting:
    """Nesting of rings that do not cross.

    Attributes
    ----------
    below : dict
        For each ring, from left to right, the edge right below its first point, None if there is none.
    rightward : list of bool
        True if the sweep runs along edge k from its start to its end.
    touching : dict
        For each edge that points of other rings lie on, ends excepted: these points.
    """

    below: dict[int, int | None]
    rightward: list[bool]
    touching: dict[int, list[int]]


def sweep(points: Sequence[IntPoint], offsets: Sequence[int]) -> EdgesMeet | Nesting:
    """Find two edges that must not meet and do, or else the nesting of the rings.

    Parameters
    ----------
    points : sequence of pairs of int
        All rings, one after the other, without repeated or collinear neighbours and without spikes.
    offsets : sequence of int
        Ring r holds the points offsets[r] to offsets[r + 1] - 1.

    Examples
    --------
    >>> sweep([(0, 0), (2, 2), (2, 0), (0, 2)], [0, 4])
    EdgesMeet(edges=(0, 2))
    >>> square, dot = [(0, 0), (9, 0), (9, 9), (0, 9)], [(3, 0), (3, 4), (4, 4)]
    >>> found = sweep(square + dot, [0, 4, 7])
    >>> found.below, found.touching
    ({0: None, 1: 0}, {0: [4]})
    """
    n = len(points)
    following, ring_of = [0] * n, [0] * n
    for ring, (first, beyond) in enumerate(pairwise(offsets)):
        following[first:beyond] = [*range(first + 1, beyond), first]
        ring_of[first:beyond] = [ring] * (beyond - first)
    preceding = [0] * n
    for k, after in enumerate(following):
        preceding[after] = k
    rightward = [points[k] < points[following[k]] for k in range(n)]
    start = [points[k if right else following[k]] for k, right in enumerate(rightward)]
    end = [points[following[k] if right else k] for k, right in enumerate(rightward)]

    def may_not_meet(e: int, f: int) -> bool:
        if following[e] == f or following[f] == e:
            return False  # neighbours in a ring without spikes share one point only
        meeting = meet(start[e], end[e], start[f], end[f])
        return meeting is not Meeting.APART and (meeting is not Meeting.TOUCH or ring_of[e] == ring_of[f])

    vertices_at = defaultdict(list)
    for k, point in enumerate(points):
        vertices_at[point].append(k)
    active: list[int] = []  # edges cut by the sweep line, from below to above
    nesting = Nesting({}, rightward, {})
    for point in sorted(vertices_at):
        here = vertices_at[point]
        place = _count_below(point, active, start, end)
        beyond = place
        while beyond < len(active) and _passes(point, start[active[beyond]], end[active[beyond]]):
            beyond += 1
        incident = [e for k in here for e in (preceding[k], k)]
        passing = [e for e in active[place:beyond] if end[e] != point]
        corners = [(k, points[following[k]], points[preceding[k]]) for k in here]
        corners += [(e, end[e], start[e]) for e in passing]
        for one, other in combinations(corners, 2):
            if ring_of[one[0]] == ring_of[other[0]] or _interleave(point, one[1:], other[1:]):
                return EdgesMeet((min(one[0], other[0]), max(one[0], other[0])))
        if {e for e in active[place:beyond] if end[e] == point} != {e for e in incident if end[e] == point}:
            raise InvariantError("the sweep lost an edge", state=(point, incident))
        leaving = _from_below(point, [e for e in incident if start[e] == point] + passing, end)
        active[place:beyond] = leaving
        for above in dict.fromkeys((place, place + len(leaving))):
            if 0 < above < len(active) and may_not_meet(active[above - 1], active[above]):
                return EdgesMeet((min(active[above - 1 : above + 1]), max(active[above - 1 : above + 1])))
        for m, e in enumerate(leaving, place):
            nesting.below.setdefault(ring_of[e], active[m - 1] if m else None)
        for e in passing:
            nesting.touching.setdefault(e, []).extend(here)
    return nesting


def _count_below(point: IntPoint, active: Sequence[int], start: Sequence[IntPoint], end: Sequence[IntPoint]) -> int:
    """Number of active edges that pass below a point."""
    low, high = 0, len(active)
    while low < high:
        middle = (low + high) // 2
        e = active[middle]
        if orient(start[e], end[e], point) is Orientation.LEFT:
            low = middle + 1
        else:
            high = middle
    return low


def _passes(point: IntPoint, start: IntPoint, end: IntPoint) -> bool:
    return orient(start, end, point) is Orientation.COLLINEAR


def _from_below(point: IntPoint, edges: list[int], end: Sequence[IntPoint]) -> list[int]:
    """Edges that leave a point rightwards, by slope: few, so each is inserted in turn."""
    ordered: list[int] = []
    for e in edges:
        place = sum(orient(point, end[f], end[e]) is Orientation.LEFT for f in ordered)
        ordered.insert(place, e)
    return ordered


def _interleave(point: IntPoint, one: Sequence[IntPoint], other: Sequence[IntPoint]) -> bool:
    """True if two rings cross or overlap at a point both pass through, with their neighbouring points there."""
    (a, b), (c, d) = ([(x - point[0], y - point[1]) for x, y in pair] for pair in (one, other))
    c_side, d_side = locate_in_sector(c, a, b), locate_in_sector(d, a, b)
    return c_side is not d_side or c_side is Location.BOUNDARY
