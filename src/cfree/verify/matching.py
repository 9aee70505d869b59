"""Match the sides of all trapezoids, to prove the surface closed; the result is counted: V - E + F.

Sides lie on curves, or on lines at critical angles. The ends of all sides on one of them cut each into *edges*. The
forbidden side of a patch is on its left. So, going round an edge, sheets with free space after them and sheets with
free space before them take turns, and run opposite ways. Two that bound one free sector are partners. If every edge has
one, the result is closed surfaces.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cmp_to_key
from itertools import pairwise
from typing import Any

from cfree.exact.algebraic import Exact, Root, between, part, ratio
from cfree.verify.surfaces import Turn, Vector, cross, dot
from cfree.verify.trapezoids import Reader, Side

START, UPPER, STOP, LOWER = range(4)
Sheet = tuple[int, int]  # trapezoid, side


@dataclass
class Matching:
    """Closed surfaces, if nothing is `unmatched`.

    Attributes
    ----------
    unmatched : Counter
        Edges without a partner, by the trapezoids that meet there.
    edges : int
        Pairs of partners.
    pinched : int
        Edges where more than two sheets meet.
    euler : list of int
        V - E + F of every closed surface, in order; vertices are counted once for each surface that meets there.
    """

    unmatched: Counter[tuple[int, ...]] = field(default_factory=Counter)
    edges: int = 0
    pinched: int = 0
    euler: list[int] = field(default_factory=list)


def matched(reader: Reader, loops: dict[int, list[Side | None]]) -> Matching:
    """Match the sides of trapezoids."""
    result = Matching()
    on: dict[bytes, list[Sheet]] = defaultdict(list)
    for k, loop in loops.items():
        for number, side in enumerate(loop):
            if side is not None:
                on[side[0]].append((k, number))
    edges: dict[Sheet, list[int]] = {}  # of a side, numbered as its loop runs
    partner: dict[int, int] = {}
    count = 0
    for sheets in on.values():
        if len(sheets) == 2:  # mostly they are the same from both sides
            (_, *one), (_, *other) = (_side(loops, sheet) for sheet in sheets)
            if one == other[::-1]:
                edges[sheets[0]], edges[sheets[1]] = [count], [count + 1]
                partner[count], partner[count + 1] = count + 1, count
                count += 2
                continue
        ends = sorted({end for k, number in sheets for end in _side(loops, (k, number))[1:]})
        rank = {end: r for r, end in enumerate(ends)}
        along: list[list[tuple[Sheet, bool, int]]] = [[] for _ in ends[1:]]
        for sheet in sheets:
            _, begin, end = _side(loops, sheet)
            first, last = rank[begin], rank[end]
            steps = range(first, last) if first < last else range(first - 1, last - 1, -1)
            edges[sheet] = list(range(count, count + len(steps)))
            for r, edge in zip(steps, edges[sheet], strict=True):
                along[r].append((sheet, first < last, edge))
            count += len(steps)
        for (lo, hi), meeting in zip(pairwise(ends), along, strict=True):
            if len(meeting) > 2:
                result.pinched += 1
                meeting = _around(reader, meeting, lo, hi)
            ways = [forwards for _, forwards, _ in meeting]
            if any(a == b for a, b in zip(ways, ways[1:] + ways[:1], strict=True)):
                result.unmatched[tuple(sorted({k for (k, _), _, _ in meeting}))] += 1
                continue
            numbers = [edge for _, _, edge in meeting]
            for k in range(0 if ways[:1] == [True] else 1, len(numbers), 2):
                a, b = numbers[k], numbers[(k + 1) % len(numbers)]
                partner[a], partner[b] = b, a
    result.edges = len(partner) // 2
    if not result.unmatched:
        faces = [[edge for number in range(4) for edge in edges.get((k, number), [])] for k in loops]
        result.euler = euler_numbers(faces, partner)
    return result


def _side(loops: dict[int, list[Side | None]], sheet: Sheet) -> Side:
    side = loops[sheet[0]][sheet[1]]
    assert side is not None
    return side


# --- the order of sheets around an edge ---


def _around(reader: Reader, meeting: list[Any], lo: Exact, hi: Exact) -> list[Any]:
    """Sort sheets counter-clockwise round an edge. Those in one place have free space, of no width, after the first."""
    is_curve = isinstance(lo, Root)
    if is_curve:
        part(lo, hi)
    middle = between(lo.hi, hi.lo) if is_curve else (lo + hi) / 2
    order = _ray if is_curve else _slope
    keys = {sheet: order(reader, sheet, middle) for sheet, _, _ in meeting}

    def compared(x: Any, y: Any) -> int:
        return _compare(keys[x[0]], keys[y[0]]) or y[1] - x[1]

    return sorted(meeting, key=cmp_to_key(compared))


def _compare(x: tuple[int, Any], y: tuple[int, Any]) -> int:
    """Compare half turns, then directions in them, vectors or slopes."""
    if x[0] != y[0]:
        return x[0] - y[0]
    first, second = (0, cross(x[1], y[1])) if isinstance(x[1], tuple) else (x[1], y[1])
    return int(first > second) - int(first < second)


def _ray(reader: Reader, sheet: Sheet, tau: Fraction) -> tuple[int, Vector]:
    """Direction in which a trapezoid leaves one of its curves, at one angle."""
    k, number = sheet
    t = reader.table
    u, v = Turn.of(int(t.chart[k]), tau).line(reader.surface(int(t.patch[k]))).along
    if number == UPPER:
        u, v = -u, -v
    return 0 if v > 0 or (v == 0 and u > 0) else 1, (u, v)


def _slope(reader: Reader, sheet: Sheet, position: Exact) -> tuple[int, Exact]:
    """Speed of a patch's line to the left of the side's, at a position, as theta grows; first those after it.

    Notes
    -----
    The line of a surface is where h = U x (P - b + R a) vanishes. It moves to the left of the side's direction D at the
    rate -h' / (U . D), where h' = -R' g x (P - b + R a) + U x R' a and R' = J R. Going round, rates fall among sheets
    after the side, and among those before it. If rates are equal the surfaces are. Two of one kind then belong to one
    vertex. Those of a v-e and an e-v contact differ in all but one position, where a vertex of the boundary would be.
    """
    k, number = sheet
    t = reader.table
    patch, end = int(t.patch[k]), "from" if number == START else "to"
    surface = reader.surface(patch)
    turn = Turn(int(t.chart[k]), reader.angle(t, k, end, patch))
    line = turn.line(surface)
    x, y = line.point(ratio(position * turn.w - line.start[line.axis], line.along[line.axis]))
    (a, b), (bx, by) = turn(surface.a), turn.fixed(surface.b)
    # w^2 h', for J u x v = -u . v and u x J v = u . v
    h = dot(turn(surface.g), (x - bx + a, y - by + b)) + dot(line.along, (a, b))
    return number == STOP, ratio(h, line.along[line.axis])


# --- counting ---


def euler_numbers(faces: Iterable[list[int]], partner: dict[int, int]) -> list[int]:
    """V - E + F of the surfaces that loops of edges make with their partners."""
    before, face_of = {}, {}
    parent = []
    for face, loop in enumerate(faces):
        parent.append(face)
        for first, second in zip(loop, loop[1:] + loop[:1], strict=True):
            before[second], face_of[first] = first, face

    def component(face: int) -> int:
        while parent[face] != face:
            parent[face] = face = parent[parent[face]]
        return face

    for a, b in partner.items():
        parent[component(face_of[a])] = component(face_of[b])
    count = Counter(component(face) for face in range(len(parent)))
    count.subtract(component(face_of[a]) for a, b in partner.items() if a < b)
    todo = set(before)
    while todo:  # a vertex: from an edge that begins there to the next
        edge = todo.pop()
        count[component(face_of[edge])] += 1
        while (edge := partner[before[edge]]) in todo:
            todo.remove(edge)
    return sorted(count.values())
