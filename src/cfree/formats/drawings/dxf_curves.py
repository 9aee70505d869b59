"""Curves of DXF entities as segments, seen from above."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from cfree.curves.drawn import (
    Affine,
    Arc,
    Line,
    Ring,
    Vector,
    arc_of_circle,
    bulged,
    carried,
    ends,
    point_of,
    reversed_ring,
)
from cfree.curves.hulls import area, rough
from cfree.formats.drawings.dxf_splines import cubics

Spend = Callable[[int], object]
FLATTEST = 1e-12
"""A bulge below this is a line: its arc is nearer to the chord than the digits of a double."""
FIT, FRAME = 4, 16
"""Flag of a polyline with a fitted spline, and of the control points among its vertices."""
LOOKED_AT = 64
"""Number of edges of a hatch that are tried as the next one."""
TEXT_BOX = 8
"""Flag of a ring of a hatch around a text."""
_MIRRORED: Affine = (Fraction(-1), Fraction(0), Fraction(0), Fraction(1), Fraction(0), Fraction(0))


class InSpaceError(ValueError):
    """Raised for an entity that is not in a plane parallel to that of x and y."""


@dataclass(frozen=True, slots=True)
class Corners:
    """Corners of a polyline: (x, y, bulge, width at the start, width at the end) of each segment."""

    rows: list[tuple[float, float, float, float, float]]
    closed: bool
    heights: tuple[float, ...] = ()


def in_plane(entity: Any, ring: Ring) -> Ring:
    """Return a ring of an entity in the drawing's plane; an entity drawn from below is mirrored in x."""
    return ring if is_upright(entity) else carried(ring, _MIRRORED)


def is_upright(entity: Any) -> bool:
    """True if the entity is drawn from above, False from below.

    Raises
    ------
    InSpaceError
        If it stands in space.
    """
    z = entity.dxf.get("extrusion", (0, 0, 1))
    if abs(z[0]) > 1e-9 or abs(z[1]) > 1e-9:
        raise InSpaceError
    return bool(z[2] > 0)


def radius_of(entity: Any) -> float:
    """Return the radius of a circle or an arc, 0 or more.

    Raises
    ------
    ValueError
        If it is below 0, or not finite.
    """
    radius = float(entity.dxf.radius)
    if not 0 <= radius < math.inf:
        raise ValueError(f"radius {radius:g}, which is no length")
    return radius


def arc_of(center: Any, radius: float, degrees: tuple[float, float]) -> Arc:
    """Return the counter-clockwise arc between two angles; the whole circle, if they are equal."""
    first, last = map(math.radians, degrees)
    sweep = (last - first) % math.tau or math.tau
    return arc_of_circle((float(center[0]), float(center[1])), float(radius), first, first + sweep)


def ellipse_of(entity: Any) -> tuple[Arc, bool]:
    """Return the arc of an ELLIPSE; True if it is whole."""
    is_upright(entity)
    c, u, v = entity.dxf.center, entity.dxf.major_axis, entity.minor_axis
    first, last = float(entity.dxf.start_param), float(entity.dxf.end_param)
    sweep = (last - first) % math.tau
    whole = sweep < 1e-9 or sweep > math.tau - 1e-9
    return Arc((c.x, c.y), (u.x, u.y), (v.x, v.y), first, first + (math.tau if whole else sweep)), whole


def lwpolyline(entity: Any) -> Corners:
    """Return the corners of an LWPOLYLINE."""
    points = list(entity.get_points("xybse"))
    width = 0.0 if any(row[3] or row[4] for row in points) else float(entity.dxf.get("const_width", 0.0))
    rows = [(float(x), float(y), float(b), float(s) or width, float(e) or width) for x, y, b, s, e in points]
    return _corners(rows, bool(entity.closed), (float(entity.dxf.get("elevation", 0.0)),))


def polyline(entity: Any) -> Corners:
    """Return the corners of a POLYLINE in the plane or in space; not of a mesh."""
    frame = entity.dxf.flags & FIT
    vertices = [v for v in entity.vertices if not (frame and v.dxf.get("flags", 0) & FRAME)]
    flat = entity.is_2d_polyline
    start, end = (float(entity.dxf.get(f"default_{name}_width", 0.0)) if flat else 0.0 for name in ("start", "end"))
    rows = [
        (
            float(v.dxf.location.x),
            float(v.dxf.location.y),
            float(v.dxf.get("bulge", 0.0)) if flat else 0.0,
            float(v.dxf.get("start_width", start)) if flat else 0.0,
            float(v.dxf.get("end_width", end)) if flat else 0.0,
        )
        for v in vertices
    ]
    heights = [entity.dxf.elevation.z] if flat else [v.dxf.location.z for v in vertices]
    return _corners(rows, bool(entity.is_closed), tuple(map(float, heights)))


def _corners(rows: list[tuple[float, float, float, float, float]], closed: bool, heights: tuple[float, ...]) -> Corners:
    """Return corners; a polyline that ends where it begins is closed."""
    if not closed and len(rows) > 2 and rows[0][:2] == rows[-1][:2]:
        return Corners(rows[:-1], True, heights)
    return Corners(rows, closed, heights)


def segments(corners: Corners) -> tuple[Ring, list[tuple[float, float]]]:
    """Return the segments of a polyline, without those that have no length, and the widths at their ends."""
    ring: Ring = []
    widths: list[tuple[float, float]] = []
    following = [*corners.rows[1:], *corners.rows[:1]] if corners.closed else corners.rows[1:]
    for (x, y, bulge, *width), after in zip(corners.rows, following, strict=False):
        if (x, y) != after[:2]:
            ring.append(bulge_of((x, y), (after[0], after[1]), bulge))
            widths.append((width[0], width[1]))
    return ring, widths


def bulge_of(a: Vector, b: Vector, bulge: float) -> Line | Arc:
    """Return the segment of a polyline from a to b."""
    if not math.isfinite(bulge):
        raise ValueError(f"bulge {bulge} is not finite")
    return bulged(a, b, bulge) if abs(bulge) > FLATTEST else Line(point_of(*a), point_of(*b))


# hatches


def hatch_rings(entity: Any, spend: Spend) -> tuple[list[Ring], int]:
    """Return the rings of a hatch, and the number of boxes of texts, which are left out.

    The style that ignores inner rings has them filled: all rings are then counter-clockwise, for the nonzero rule.
    """
    rings: list[Ring] = []
    boxes = 0
    for path in entity.paths:
        if path.path_type_flags & TEXT_BOX:
            boxes += 1
            continue
        if hasattr(path, "vertices"):
            spend(len(path.vertices))
            rows = [(float(x), float(y), float(bulge), 0.0, 0.0) for x, y, bulge in path.vertices]
            parts = [segments(Corners(rows, True))[0]]
        else:
            spend(len(path.edges))
            parts = chained([edge for edge in (_edge(edge, spend) for edge in path.edges) if edge], spend)
        rings += [in_plane(entity, part) for part in parts if part]
    if entity.dxf.get("hatch_style", 0) == 2:
        rings = [ring if area(rough(ring)) > 0 else reversed_ring(ring) for ring in rings]
    return [ring for ring in rings if ring], boxes


def _edge(edge: Any, spend: Spend) -> Ring:
    """Return an edge of a hatch in its direction."""
    kind = type(edge).__name__
    if kind == "LineEdge":
        a, b = (point_of(float(p[0]), float(p[1])) for p in (edge.start, edge.end))
        return [Line(a, b)] if a != b else []
    if kind == "ArcEdge":
        ring: Ring = [arc_of(edge.center, edge.radius, (edge.start_angle, edge.end_angle))]
    elif kind == "EllipseEdge":
        tool = edge.construction_tool()
        c, u, v = tool.center, tool.major_axis, tool.minor_axis
        sweep = (tool.end_param - tool.start_param) % math.tau
        sweep = math.tau if sweep < 1e-9 else sweep
        ring = [Arc((c.x, c.y), (u.x, u.y), (v.x, v.y), tool.start_param, tool.start_param + sweep)]
    elif kind == "SplineEdge":
        return cubics(edge.construction_tool(), spend)[0]
    else:
        raise ValueError(f"an edge {kind}")
    return ring if edge.ccw else reversed_ring(ring)


def chained(parts: Sequence[Ring], spend: Spend) -> list[Ring]:
    """Return rings of edges, in the file's order if that joins them, turned where needed; lines close gaps."""
    near = 1e-6 * max((abs(x) for part in parts for segment in part for p in ends(segment) for x in p), default=0.0)
    waiting, rings = list(parts), list[Ring]()
    while waiting:
        ring = list(waiting.pop(0))
        while waiting and math.dist(*_tips(ring)) > near:
            spend(1)
            gap, k, end = _next(waiting, _tips(ring)[1], near)
            if gap > near and _next(waiting, _tips(ring)[0], near)[0] <= near:
                ring = reversed_ring(ring)
                gap, k, end = _next(waiting, _tips(ring)[1], near)
            part = waiting.pop(k)
            part = reversed_ring(part) if end else part
            ring += [*_bridge(_tips(ring)[1], _tips(part)[0]), *part]
        rings.append([*ring, *_bridge(*_tips(ring)[::-1])])
    return rings


def _next(waiting: Sequence[Ring], tip: Vector, near: float) -> tuple[float, int, int]:
    """Return gap, index and end of the first edge near a point; of the nearest one, if none is near."""
    best = math.inf, 0, 0
    for k, part in enumerate(waiting[:LOOKED_AT]):
        for end in (0, 1):
            gap = math.dist(tip, _tips(part)[end])
            if gap < best[0]:
                best = gap, k, end
        if best[0] <= near:
            break
    return best


def _bridge(p: Vector, q: Vector) -> Ring:
    a, b = point_of(*p), point_of(*q)
    return [Line(a, b)] if a != b else []


def _tips(part: Ring) -> tuple[Vector, Vector]:
    return ends(part[0])[0], ends(part[-1])[1]


# multilines

SQUARE, INNER, ROUND = (16, 256), (32, 512), (64, 1024)
"""Flags of the style of an MLINE for its caps: at the start, at the end."""
FILLED, CLOSED, UNCAPPED = 1, 2, (4, 8)


@dataclass(frozen=True, slots=True)
class Multiline:
    """An MLINE: curves of its elements and caps, each closed or not, and rings that are filled together."""

    curves: list[tuple[Ring, bool]]
    fills: list[Ring]


def multiline(entity: Any, style: Any) -> Multiline:
    """Return the elements of an MLINE, by the offsets in its vertices; caps and fill by its style, if it has one."""
    if not is_upright(entity):
        raise InSpaceError
    rows: list[list[Vector]] = []
    for vertex in entity.vertices:
        p, d = vertex.location, vertex.miter_direction
        offsets = [float(params[0]) if params else 0.0 for params in vertex.line_params]
        rows.append([(p.x + s * d.x, p.y + s * d.y) for s in offsets])
    count = min(map(len, rows), default=0)
    if len(rows) < 2 or not count:
        raise ValueError("fewer than two vertices, or no elements")
    flags, closed = int(entity.dxf.get("flags", 1)), bool(entity.dxf.get("flags", 1) & CLOSED)
    of_style = int(style.dxf.get("flags", 0)) if style is not None else 0
    lines = [_polygon([row[k] for row in rows], closed) for k in range(count)]
    curves = [(line, closed) for line in lines if line]
    if not closed:
        for end, row in enumerate((rows[0], rows[-1])):
            if not flags & UNCAPPED[end]:
                curves += [(cap, False) for cap in _caps(row[:count], of_style, end)]
    fills: list[Ring] = []
    if of_style & FILLED and count > 1:
        outer = [(row[0], row[count - 1]) for row in rows]
        for (a, b), (c, d) in zip(outer, [*outer[1:], *outer[:1]] if closed else outer[1:], strict=False):
            fills.append(_polygon([a, b, d, c], True))
        for end, (a, b) in enumerate((outer[0], outer[-1])):
            if not closed and of_style & ROUND[end] and not flags & UNCAPPED[end] and a != b:
                fills.append([*_half(a, b, end), Line(point_of(*b), point_of(*a))])
    return Multiline(curves, [ring for ring in fills if ring])


def _polygon(points: Sequence[Vector], closed: bool) -> Ring:
    after = [*points[1:], *points[:1]] if closed else points[1:]
    exact = ((point_of(*a), point_of(*b)) for a, b in zip(points, after, strict=False))
    return [Line(a, b) for a, b in exact if a != b]


def _caps(row: Sequence[Vector], flags: int, end: int) -> Iterator[Ring]:
    """Yield the caps of a multiline at its start (0) or end (1)."""
    first, last = row[0], row[-1]
    if first == last:
        return
    if flags & SQUARE[end]:
        yield _polygon([first, last], False)
    if flags & ROUND[end]:
        yield _half(first, last, end)
    if flags & INNER[end]:
        for k in range(1, len(row) // 2):
            if row[k] != row[-k - 1]:
                yield _half(row[k], row[-k - 1], end)


def _half(a: Vector, b: Vector, end: int) -> Ring:
    """Return the half circle from a to b beyond the start or the end; the first element is to the left."""
    return [bulged(a, b, 1.0 if end == 0 else -1.0)]
