"""Exact triangulation by ear clipping: slow, O(n^2) as a rule, but independent of any rounding.

Holes are first joined to the outer ring by diagonals run there and back, or where they touch it:

    outer 0 1 2 3, hole 4 5 6, diagonal 3-4:   0 1 2 3 4 5 6 4 3
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from cfree.errors import InvariantError
from cfree.exact import IntPoint
from cfree.predicates import Location, Meeting, Orientation, locate_in_sector, meet, orient
from cfree.rings import doubled_area


def clip_ears(v: Sequence[IntPoint], rings: Sequence[Sequence[int]]) -> list[tuple[int, int, int]]:
    """Triangles that cover the region of rings.

    Parameters
    ----------
    v : sequence of pairs of int
    rings : sequence of sequences of indices into v
        The interior on the left, the outer ring first. Rings may touch at vertices, then of one index.

    Examples
    --------
    >>> clip_ears([(0, 0), (2, 0), (2, 2), (0, 2)], [[0, 1, 2, 3]])
    [(3, 0, 1), (3, 1, 2)]
    """
    triangles: list[tuple[int, int, int]] = []
    for ring in _separate(v, _join(v, rings)):
        k = failed = 0
        while len(ring) > 2:
            a, b, c = ring[k - 1], ring[k], ring[(k + 1) % len(ring)]
            if _is_ear(v, a, b, c, ring):
                triangles.append((a, b, c))
                del ring[k]
                failed = 0
            elif failed > len(ring):
                raise InvariantError("a ring without an ear", state=(v, rings, ring))
            else:
                k += 1
                failed += 1
            k %= len(ring)
    return triangles


def _is_ear(v: Sequence[IntPoint], a: int, b: int, c: int, ring: Sequence[int]) -> bool:
    """Is the triangle abc free of other vertices? Its corners may occur again, at joints."""
    if orient(v[a], v[b], v[c]) is not Orientation.LEFT:
        return False
    return not any(
        orient(v[a], v[b], v[k]) is not Orientation.RIGHT
        and orient(v[b], v[c], v[k]) is not Orientation.RIGHT
        and orient(v[c], v[a], v[k]) is not Orientation.RIGHT
        for k in ring
        if k not in (a, b, c)
    )


def _join(v: Sequence[IntPoint], rings: Sequence[Sequence[int]]) -> list[int]:
    """One ring through all vertices.

    Holes are joined from left to right: then a diagonal from the first point of a hole to a point before it
    cannot meet holes that are not joined yet.
    """
    ring = list(rings[0])
    for hole in sorted(rings[1:], key=lambda them: min(v[k] for k in them)):
        shared = [m for m, k in enumerate(hole) if k in ring]
        m = shared[0] if shared else min(range(len(hole)), key=lambda m: v[hole[m]])
        loop = [*hole[m:], *hole[:m]]
        if shared:
            place = next(p for p, k in enumerate(ring) if k == loop[0] and _opens(v, ring, p, loop[1]))
            ring[place : place + 1] = [*loop, loop[0]]
        else:
            place = _visible_place(v, ring, loop[0])
            ring[place : place + 1] = [ring[place], *loop, loop[0], ring[place]]
    return ring


def _separate(v: Sequence[IntPoint], ring: list[int]) -> list[list[int]]:
    """Parts of the region that rings touching more than once cut from each other.

    At a joint, one part of the ring runs round a hole, clockwise; where the region is cut, neither does.
    """
    whole, parts = [ring], []
    while whole:
        ring = whole.pop()
        for m, n in _repetitions(ring):
            halves = ring[m:n], ring[n:] + ring[:m]
            if all(doubled_area([v[k] for k in half]) > 0 for half in halves):
                whole += halves
                break
        else:
            parts.append(ring)
    return parts


def _repetitions(ring: Sequence[int]) -> Iterator[tuple[int, int]]:
    """Pairs of places where the same vertex stands."""
    places: dict[int, list[int]] = {}
    for n, k in enumerate(ring):
        earlier = places.setdefault(k, [])
        yield from ((m, n) for m in earlier)
        earlier.append(n)


def _opens(v: Sequence[IntPoint], ring: Sequence[int], place: int, towards: int) -> bool:
    """Does the direction from a place of the ring towards a vertex run inside?"""
    here, before, after = (v[ring[p]] for p in (place, place - 1, (place + 1) % len(ring)))
    d, start, end = ((x - here[0], y - here[1]) for x, y in (v[towards], after, before))
    return locate_in_sector(d, start, end) is Location.INSIDE


def _visible_place(v: Sequence[IntPoint], ring: Sequence[int], h: int) -> int:
    """Where in the ring the nearest vertex stands that sees h from before it."""

    def distance(place: int) -> int:
        (x, y), (hx, hy) = v[ring[place]], v[h]
        return (x - hx) ** 2 + (y - hy) ** 2

    def is_clear(k: int) -> bool:
        for p, q in zip(ring, (*ring[1:], ring[0]), strict=True):
            met = meet(v[k], v[h], v[p], v[q])
            if met is not Meeting.APART and not (met is Meeting.TOUCH and k in (p, q)):
                return False
        return True

    for place in sorted((p for p, k in enumerate(ring) if v[k] < v[h]), key=distance):
        if _opens(v, ring, place, h) and is_clear(ring[place]):
            return place
    raise InvariantError("a hole that sees no vertex before it", state=(v, ring, h))
