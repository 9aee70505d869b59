"""Places where rings of a round shape cross or touch, for messages: found in doubles."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from cfree.curves.drawn import Line
from cfree.curves.pieces import Curve
from cfree.curves.rings import Cubic, GivenRing, Piece, items_of
from cfree.libraries import shapely

CHORDS = 256  # of each piece
JOINT = 1e-6  # pieces that follow each other may meet this near to their joint, relative to the shape


@dataclass(frozen=True)
class _Part:
    ring: int
    name: str
    line: shapely.LineString


def crossing(curves: Sequence[Curve], rings: Sequence[GivenRing]) -> str:
    """Describe the place where pieces of rings cross or touch, or else come closest, with their names."""
    parts = [
        _Part(r, name, shapely.LineString([*map(_at, [piece] * (CHORDS + 1), range(CHORDS + 1))]))
        for r, (curve, ring) in enumerate(zip(curves, rings, strict=True))
        for piece, name in zip(curve, items_of(ring), strict=True)
    ]
    x0, y0, x1, y1 = shapely.total_bounds([part.line for part in parts])
    near = JOINT * max(x1 - x0, y1 - y0)

    def at(point: tuple[float, float]) -> str:
        x, y = (round(value / near) * near + 0.0 for value in point)
        return f"at about ({x:.6g}, {y:.6g})"

    for part in parts:
        if len(part.line.coords) > 2 and not (part.line.is_simple or part.line.is_ring):
            return f"{_ring(part.ring)}: {part.name} crosses itself {at(shapely.node(part.line).geoms[0].coords[-1])}"
    places = list[tuple[bool, float, str]]()
    for one, other in combinations(parts, 2):
        ends = shapely.MultiPoint([one.line.coords[0], one.line.coords[-1]]).buffer(near)
        far = other.line.difference(ends) if one.ring == other.ring else other.line
        if far.is_empty:
            continue
        point, _ = shapely.shortest_line(one.line, far).coords
        crosses, apart = bool(one.line.crosses(far)), float(one.line.distance(far))
        what = "cross" if crosses else "touch" if apart <= near else "are too near to each other"
        first, second = (f"{part.name} of {_ring(part.ring)}" for part in (one, other))
        names = f"{_ring(one.ring)}: {one.name} and {other.name}" if one.ring == other.ring else f"{first} and {second}"
        places.append((not crosses, apart, f"{names} {what} {at(point)}"))
    return min(places)[2]


def _ring(number: int) -> str:
    return f"hole {number - 1}" if number else "outer ring"


def _at(piece: Piece, k: int) -> tuple[float, float]:
    """Return the k-th of the points that divide a piece."""
    s = k / CHORDS
    if isinstance(piece, Line):
        (p, q), (u, v) = piece.start, piece.end
        return float(p) + s * float(u - p), float(q) + s * float(v - q)
    if isinstance(piece, Cubic):
        weights = (1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s * s * (1 - s), s**3
        x, y = (sum(w * float(p[i]) for w, p in zip(weights, piece.points, strict=True)) for i in (0, 1))
        return x, y
    t = s * piece.sweep
    a, b = (float(piece.center[i]) + math.cos(t) * float(piece.u[i]) + math.sin(t) * float(piece.v[i]) for i in (0, 1))
    return a, b
