"""Exact triangulation by ear clipping: slow, O(n^2) as a rule, but independent of any rounding.

Holes are first joined to the outer ring by diagonals run there and back:

    outer 0 1 2 3, hole 4 5 6, diagonal 3-4:   0 1 2 3 4 5 6 4 3
"""

from __future__ import annotations

from collections.abc import Sequence

from cfree.errors import InvariantError
from cfree.exact.number import IntPoint
from cfree.exact.orientation import Location, Meeting, Orientation, locate_in_sector, meet, orient
from reference_rings import doubled_area


def clip_ears(v: Sequence[IntPoint], rings: Sequence[Sequence[int]]) -> list[tuple[int, int, int]]:
    """Triangles that cover the region of rings.

    Parameters
    ----------
    v : sequence of pairs of int
    rings : sequence of sequences of indices into v
        The interior on the left, the outer ring first. Rings may touch at vertices, which then have one index.

    Examples
    --------
    >>> clip_ears([(0, 0), (2, 0), (2, 2), (0, 2)], [[0, 1, 2, 3]])
    [(3, 0, 1), (3, 1, 2)]
    """
    triangles: list[tuple[int, int, int]] = []
    for ring in _join(v, rings):
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
    """True if the triangle abc is free of other vertices. Its corners may occur again, at joints."""
    if orient(v[a], v[b], v[c]) is not Orientation.LEFT:
        return False
    return not any(
        orient(v[a], v[b], v[k]) is not Orientation.RIGHT
        and orient(v[b], v[c], v[k]) is not Orientation.RIGHT
        and orient(v[c], v[a], v[k]) is not Orientation.RIGHT
        for k in ring
        if k not in (a, b, c)
    )


def _join(v: Sequence[IntPoint], rings: Sequence[Sequence[int]]) -> list[list[int]]:
    """Rings without holes, one for each connected part of the region.

    Holes are joined from left to right: then a diagonal from the first point of a hole to a point before it
    cannot meet holes that are not joined yet.
    """
    cycles = _cycles(v, rings)
    areas = [doubled_area([v[k] for k in cycle]) for cycle in cycles]
    parts = [cycle for cycle, area in zip(cycles, areas, strict=True) if area > 0]
    holes = [cycle for cycle, area in zip(cycles, areas, strict=True) if area < 0]
    for hole in sorted(holes, key=lambda them: min(v[k] for k in them)):
        h = min(hole, key=v.__getitem__)
        part, place = _visible_place(v, parts, h)
        m = next(m for m, k in enumerate(hole) if k == h and _opens(v, hole, m, part[place]))
        part[place : place + 1] = [part[place], *hole[m:], *hole[:m], h, part[place]]
    return parts


def _cycles(v: Sequence[IntPoint], rings: Sequence[Sequence[int]]) -> list[list[int]]:
    """Rings linked anew, so that each goes round one part of the region or one group of touching holes.

    Where rings touch, the interior's corner left of an arriving edge ends at the first leaving edge clockwise.
    """
    leaving: dict[int, list[int]] = {}
    for ring in rings:
        for k, after in zip(ring, (*ring[1:], ring[0]), strict=True):
            leaving.setdefault(k, []).append(after)
    unused = {(k, after): None for k, heads in leaving.items() for after in heads}
    cycles = []
    while unused:
        (k, after), cycle = next(iter(unused)), []
        while (k, after) in unused:
            del unused[k, after]
            cycle.append(k)
            before, k = k, after
            after = next(q for q in leaving[k] if not any(_opens(v, (before, k, q), 1, other) for other in leaving[k]))
        cycles.append(cycle)
    return cycles


def _opens(v: Sequence[IntPoint], ring: Sequence[int], place: int, towards: int) -> bool:
    """True if the direction from a place of the ring towards a vertex runs inside."""
    here, before, after = (v[ring[p]] for p in (place, place - 1, (place + 1) % len(ring)))
    d, start, end = ((x - here[0], y - here[1]) for x, y in (v[towards], after, before))
    return locate_in_sector(d, start, end) is Location.INSIDE


def _visible_place(v: Sequence[IntPoint], parts: Sequence[list[int]], h: int) -> tuple[list[int], int]:
    """Part and place in it of the nearest vertex before h from which h is visible."""
    edges = [edge for part in parts for edge in zip(part, (*part[1:], part[0]), strict=True)]

    def distance(visit: tuple[list[int], int]) -> int:
        part, place = visit
        (x, y), (hx, hy) = v[part[place]], v[h]
        return (x - hx) ** 2 + (y - hy) ** 2

    def is_clear(k: int) -> bool:
        return all(
            met is Meeting.APART or (met is Meeting.TOUCH and k in (p, q))
            for p, q in edges
            for met in [meet(v[k], v[h], v[p], v[q])]
        )

    before = [(part, place) for part in parts for place, k in enumerate(part) if v[k] < v[h]]
    for part, place in sorted(before, key=distance):
        if _opens(v, part, place, h) and is_clear(part[place]):
            return part, place
    raise InvariantError("a hole that sees no vertex before it", state=(v, parts, h))
