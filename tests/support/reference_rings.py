"""The core's treatment of rings, in Python: read, clean, check, turn around."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import accumulate
from typing import Any

import numpy as np

from cfree.errors import InvalidPolygonError
from cfree.exact.number import MAX_DIGITS, ExactPoint, IntPoint, to_ratio
from cfree.exact.orientation import (
    Meeting,
    Orientation,
    Vector,
    crossing_point,
    is_opposed,
    is_upper,
    meet,
    orient,
    turn,
)
from cfree.polygons.rings import Points, Removed
from reference_sweep import EdgesMeet, Nesting, sweep

Ratios = list[tuple[tuple[int, int], tuple[int, int]]]


@dataclass(frozen=True, slots=True)
class Rings:
    """Checked rings, the interior on the left; the attributes are those of `Polygon`."""

    numerators: tuple[IntPoint, ...]
    denominator: int
    offsets: tuple[int, ...]
    removed: tuple[Removed, ...]


@dataclass(frozen=True, slots=True)
class _Ring:
    """Vertices of one ring in the order given; `source` holds their indices in the input."""

    points: list[IntPoint]
    source: list[int]
    removed: list[Removed]


def read_rings(outer: Points, holes: Sequence[Points]) -> Rings:
    """Check and normalise the rings of one polygon; see `Polygon` for the accepted input.

    Examples
    --------
    >>> read_rings([(0, 0), (0, "1/2"), (1, 0)], []).numerators
    ((0, 0), (2, 0), (0, 1))
    """
    if isinstance(holes, str | bytes | Mapping) or not isinstance(holes, Iterable):
        raise InvalidPolygonError(f"holes: {type(holes).__name__} is no list of rings; give one, or nothing")
    read = [_read_points(r, points) for r, points in enumerate((outer, *holes))]
    denominator = math.lcm(*{d for ring in read for x, y in ring for d in (x[1], y[1])})
    if denominator.bit_length() > 4 * MAX_DIGITS:
        raise InvalidPolygonError(
            "the common denominator of the coordinates is too long; give decimals or fractions of fewer denominators"
        )
    rings = [
        _clean(r, [(x * (denominator // p), y * (denominator // q)) for (x, p), (y, q) in ring])
        for r, ring in enumerate(read)
    ]
    areas = [doubled_area(ring.points) for ring in rings]
    if len(rings) > 1 or not _is_convex(rings[0].points):
        _check(rings, areas, denominator)
    oriented = [
        ring.points if (area > 0) == (r == 0) else [ring.points[0], *ring.points[:0:-1]]
        for r, (ring, area) in enumerate(zip(rings, areas, strict=True))
    ]
    # removed points may leave a common factor
    common = math.gcd(denominator, *(c for ring in oriented for point in ring for c in point))
    return Rings(
        tuple((x // common, y // common) for ring in oriented for x, y in ring),
        denominator // common,
        tuple(accumulate(map(len, oriented), initial=0)),
        tuple(removed for ring in rings for removed in ring.removed),
    )


def doubled_area(points: Sequence[IntPoint]) -> int:
    """Twice the signed area of a ring, positive if counter-clockwise."""
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(points, (*points[1:], points[0]), strict=True))


# phases, in the order they run


def _read_points(ring: int, points: Points) -> Ratios:
    """Coordinates as quotients of integers, without a closing point."""
    rows = points.tolist() if isinstance(points, np.ndarray) else points
    if isinstance(rows, str) or not isinstance(rows, Iterable):
        raise _fault(ring, f"{reprlib.repr(rows)} is no ring; give a sequence of points (x, y)")
    ratios: Ratios = []
    for k, row in enumerate(rows):
        if type(row) is tuple and len(row) == 2:
            pair: Sequence[Any] = row
        elif isinstance(row, str) or not isinstance(row, Iterable) or len(pair := tuple(row)) != 2:
            raise _fault(ring, f"point {k} = {reprlib.repr(row)} is no point; give a pair (x, y)")
        try:
            x, y = to_ratio(pair[0]), to_ratio(pair[1])
        except ValueError as error:
            raise _fault(ring, f"point {k}: {error}") from None
        if max(n.bit_length() - d.bit_length() for n, d in (x, y)) >= 1023:
            raise _fault(ring, f"point {k} lies beyond 4e307; scale the coordinates")
        ratios.append((x, y))
    if len(ratios) > 1 and ratios[0] == ratios[-1]:
        ratios.pop()
    if len(ratios) < 3:
        raise _fault(ring, f"{len(ratios)} points; give at least 3")
    return ratios


def _clean(ring: int, points: list[IntPoint]) -> _Ring:
    """Leave out repeated and collinear points; refuse rings on a line and spikes."""
    removed = [Removed(ring, k, "repeated") for k, point in enumerate(points) if point == points[k - 1]]
    repeated = {r.index for r in removed}
    source = [k for k in range(len(points)) if k not in repeated]
    if len(source) < 3:
        raise _fault(ring, "fewer than 3 different points; give at least 3")
    corners, spikes = [], []
    for before, k, after in zip([source[-1], *source], source, [*source[1:], source[0]], strict=False):
        p, q, r = points[before], points[k], points[after]
        if orient(p, q, r) is not Orientation.COLLINEAR:
            corners.append(k)
        elif is_opposed(_minus(q, p), _minus(r, q)):
            spikes.append(k)
        else:
            removed.append(Removed(ring, k, "collinear"))
    if not corners:
        raise _fault(ring, "its points lie on one line, its area is zero; give points that bound an area")
    if spikes:
        raise _fault(ring, f"the angle at point {spikes[0]} is zero; remove this spike", spikes[0])
    return _Ring([points[k] for k in corners], corners, sorted(removed, key=lambda r: r.index))


def _is_convex(points: Sequence[IntPoint]) -> bool:
    """True if a ring without straight vertices turns to one side only, and once round."""
    edges = [_minus(q, p) for p, q in zip(points, (*points[1:], points[0]), strict=True)]
    following = (*edges[1:], edges[0])
    sides = {turn(u, v) for u, v in zip(edges, following, strict=True)}
    changes = sum(is_upper(u) != is_upper(v) for u, v in zip(edges, following, strict=True))
    return len(sides) == 1 and changes == 2


def _check(rings: Sequence[_Ring], areas: Sequence[int], denominator: int) -> None:
    """Refuse rings whose edges meet and holes that are not right inside the outer ring."""
    offsets = tuple(accumulate((len(ring.points) for ring in rings), initial=0))
    nesting = sweep([point for ring in rings for point in ring.points], offsets)
    places = [(r, k) for r, ring in enumerate(rings) for k in range(len(ring.points))]
    if isinstance(nesting, EdgesMeet):
        first, second = sorted(places[e] for e in nesting.edges)
        raise _meeting(rings, first, second, denominator)
    container = containers(areas, nesting, [r for r, _ in places])
    for hole in range(1, len(rings)):
        around = container[hole]
        if container[0] == hole:
            raise _fault(hole, "it lies around the outer ring; swap the two")
        if around is None:
            raise _fault(hole, "it lies outside the outer ring; move it, or leave it out")
        if around != 0:
            raise _fault(hole, f"it lies inside {_name(around)}; give it as another polygon")


def containers(areas: Sequence[int], nesting: Nesting, ring_of: Sequence[int]) -> dict[int, int | None]:
    """Innermost ring around each ring."""
    container: dict[int, int | None] = {}
    for ring, edge in nesting.below.items():
        if edge is None:
            container[ring] = None
        else:
            other = ring_of[edge]
            inside = nesting.rightward[edge] == (areas[other] > 0)
            container[ring] = other if inside else container[other]
    return container


# messages


def _meeting(
    rings: Sequence[_Ring], first: tuple[int, int], second: tuple[int, int], denominator: int
) -> InvalidPolygonError:
    """Fault of two edges, each (ring, position in the ring), that meet."""
    (p, q), (r, s) = (
        (rings[ring].points[k], rings[ring].points[(k + 1) % len(rings[ring].points)]) for ring, k in (first, second)
    )
    kind = meet(p, q, r, s)
    common: Vector = max(min(p, q), min(r, s))  # where they are collinear, or end in one point
    if kind is Meeting.CROSS or (kind is Meeting.TOUCH and not {p, q} & {r, s}):
        common = crossing_point(p, q, r, s)
    elif kind is Meeting.TOUCH:
        common = ({p, q} & {r, s}).pop()
    place = _show((Fraction(common[0]) / denominator, Fraction(common[1]) / denominator))
    one, other = rings[first[0]].source[first[1]], rings[second[0]].source[second[1]]
    if first[0] == second[0]:
        message = f"edges {one} and {other} {kind.value} at {place}; split it into simple polygons"
        return _fault(first[0], message, one, other)
    verb = {Meeting.CROSS: "crosses", Meeting.TOUCH: "touches", Meeting.OVERLAP: "overlaps"}[kind]
    message = f"edge {other} {verb} edge {one} of {_name(first[0])} at {place}; keep the rings apart"
    return _fault(second[0], message, other, one)


def _fault(ring: int, message: str, *edges: int) -> InvalidPolygonError:
    return InvalidPolygonError(f"{_name(ring)}: {message}", ring=ring, edges=edges)


def _name(ring: int) -> str:
    return f"hole {ring - 1}" if ring else "outer ring"


def _show(point: ExactPoint) -> str:
    """A point, exactly if that is short."""
    x, y = str(point[0]), str(point[1])
    return f"({x}, {y})" if len(x + y) <= 24 else f"about ({float(point[0])!r}, {float(point[1])!r})"


def _minus(q: IntPoint, p: IntPoint) -> IntPoint:
    return q[0] - p[0], q[1] - p[1]
