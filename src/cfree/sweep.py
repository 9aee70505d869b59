"""One exact sweep over the edges of rings: do any two meet, and if not, which ring lies in which?

Shamos and Hoey's sweep from left to right (the vertical line leans, so that points are met in the order of
their pairs of coordinates). It keeps the edges it cuts in their order from below to above; edges that meet
are neighbours there just before they do, so testing new neighbours finds a meeting if there is one.
O(n log n) exact comparisons.

    edge k goes from point k to the next point of its ring
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from cfree.errors import InvariantError
from cfree.exact import IntPoint
from cfree.predicates import Meeting, Orientation, meet, orient


@dataclass(frozen=True, slots=True)
class EdgesMeet:
    """Two edges that are no neighbours in a ring and have a point in common."""

    edges: tuple[int, int]


@dataclass(frozen=True, slots=True)
class Below:
    """For each ring the edge right below its first point in the sweep, None if there is none.

    `rightward[k]` says whether the sweep runs along edge k from its start to its end.
    """

    edges: tuple[int | None, ...]
    rightward: tuple[bool, ...]


def sweep(points: Sequence[IntPoint], offsets: Sequence[int]) -> EdgesMeet | Below:
    """Find two edges that meet, or else what lies below every ring.

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
    >>> square, dot = [(0, 0), (9, 0), (9, 9), (0, 9)], [(3, 3), (3, 4), (4, 4)]
    >>> sweep(square + dot, [0, 4, 7]).edges
    (None, 0)
    """
    following, preceding, ring_of = [0] * len(points), [0] * len(points), [0] * len(points)
    for ring, (first, beyond) in enumerate(pairwise(offsets)):
        for k in range(first, beyond):
            following[k] = k + 1 if k + 1 < beyond else first
            preceding[following[k]] = k
            ring_of[k] = ring
    rightward = [points[k] < points[following[k]] for k in range(len(points))]
    start = [points[k if right else following[k]] for k, right in enumerate(rightward)]
    end = [points[following[k] if right else k] for k, right in enumerate(rightward)]

    def do_meet(e: int, f: int) -> bool:
        if following[e] == f or following[f] == e:
            return False  # neighbours in a ring without spikes share one point only
        return meet(start[e], end[e], start[f], end[f]) is not Meeting.APART

    order = sorted(range(len(points)), key=points.__getitem__)
    for k, m in pairwise(order):
        if points[k] == points[m]:
            return EdgesMeet((min(k, m), max(k, m)))
    active: list[int] = []  # edges cut by the sweep line, from below to above
    below: list[int | None] = [None] * (len(offsets) - 1)
    seen = [False] * len(below)
    for k in order:
        place = _first_not_below(points[k], active, start, end)
        incident = (preceding[k], k)
        ending = [e for e in incident if end[e] == points[k]]
        starting = [e for e in incident if start[e] == points[k]]
        for e in active[place : place + len(ending) + 1]:
            if e not in ending and orient(start[e], end[e], points[k]) is Orientation.COLLINEAR:
                return EdgesMeet((min(e, k), max(e, k)))
        if set(active[place : place + len(ending)]) != set(ending):
            raise InvariantError("the sweep lost an edge", state=(points[k], ending))
        if not seen[ring_of[k]]:
            seen[ring_of[k]] = True
            below[ring_of[k]] = active[place - 1] if place else None
        if len(starting) == 2 and orient(points[k], end[starting[0]], end[starting[1]]) is Orientation.RIGHT:
            starting.reverse()
        active[place : place + len(ending)] = starting
        for above in {place, place + len(starting)}:
            if 0 < above < len(active) and do_meet(active[above - 1], active[above]):
                return EdgesMeet((min(active[above - 1 : above + 1]), max(active[above - 1 : above + 1])))
    return Below(tuple(below), tuple(rightward))


def _first_not_below(
    point: IntPoint, active: Sequence[int], start: Sequence[IntPoint], end: Sequence[IntPoint]
) -> int:
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
