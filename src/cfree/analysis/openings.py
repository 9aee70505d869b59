"""Openings of a floor plan, such as doors: narrow places of the floor, between two wider parts of it.

An opening is a segment between two walls whose disc, the one with the segment as diameter, is free of walls. Such
segments join a corner of a wall with a wall or with another corner. They are tried from the narrowest one on. One is an
opening if it parts the floor near by, without the openings before it, and the floor is wider on both sides.
"""

from __future__ import annotations

import math
from typing import Any

from cfree.libraries import Floats, np, shapely

Point = tuple[float, float]
Segment = tuple[Point, Point]
WIDER = 1.05  # width of the floor on both sides of an opening, in its own
NEAR, FAR = 2.0, 8.0  # widths from an opening within which both sides are not joined, and wider
DISC = 0.999  # of the disc is free, for rounding
BAR = 2.0**-20  # half of a bar's thickness, and its length beyond both ends, in widths
SIDE = 2.0**-14  # distance of points beside a segment, in widths
TOO_FAR = 1.5  # half lengths from the middle of a segment within which there is a wall


def openings_of(floor: Any, widest: float) -> list[Segment]:
    """Return the openings of a floor, a shapely geometry, that are no wider than a limit; the narrowest first.

    Examples
    --------
    >>> two_rooms = shapely.box(0, 0, 9, 4) - shapely.box(4, 0, 4.2, 2) - shapely.box(4, 3, 4.2, 4)
    >>> openings_of(two_rooms, 2.0)
    [((4.0, 2.0), (4.0, 3.0))]
    """
    chosen = list[Segment]()
    bars = list[Any]()
    for segment in _narrow(floor, widest):
        if not _is_repeated(segment, chosen) and _parts_wider(floor, segment, bars):
            chosen.append(segment)
            bars.append(bar(segment))
    return chosen


def bar(segment: Segment) -> Any:
    """Return a thin rectangle around a segment, a little longer than it."""
    (x, y), (u, v) = segment
    dx, dy = BAR * (u - x), BAR * (v - y)
    x, y, u, v = x - dx, y - dy, u + dx, v + dy
    return shapely.Polygon([(x + dy, y - dx), (u + dy, v - dx), (u - dy, v + dx), (x - dy, y + dx)])


def middle_of(segment: Segment) -> Point:
    """Return the middle of a segment."""
    (x, y), (u, v) = segment
    return (x + u) / 2, (y + v) / 2


def beside(segment: Segment) -> list[Any]:
    """Return a point on each side of the middle of a segment, beyond its bar."""
    ((x, y), (u, v)), (mx, my) = segment, middle_of(segment)
    return [shapely.Point(mx + side * (v - y), my - side * (u - x)) for side in (-SIDE, SIDE)]


def to_walls(floor: Any, segment: Segment) -> Segment | None:
    """Return a segment on the same line whose ends are on walls; None if there are none near both ends."""
    (x, y), (u, v) = segment
    mx, my, dx, dy = (x + u) / 2, (y + v) / 2, TOO_FAR * (u - x) / 2, TOO_FAR * (v - y) / 2
    line = shapely.LineString([(mx - dx, my - dy), (mx + dx, my + dy)]) & floor
    near = [part for part in shapely.get_parts(line).tolist() if part.distance(shapely.Point(mx, my)) < 1e-9]
    if len(near) != 1:
        return None
    first, *_, last = near[0].coords
    whole = math.hypot(2 * dx, 2 * dy)
    if any(math.dist(end, (mx + s * dx, my + s * dy)) < 1e-9 * whole for end, s in ((first, -1), (last, 1))):
        return None
    return (first[0], first[1]), (last[0], last[1])


def _narrow(floor: Any, widest: float) -> list[Segment]:
    """Return segments from corners to other walls whose discs are free, the narrowest first."""
    rings = [shapely.get_coordinates(ring) for ring in shapely.get_rings(shapely.get_parts(floor)).tolist()]
    if not rings:
        return []
    corners: Floats = np.concatenate([ring[:-1] for ring in rings])
    edges = shapely.linestrings(np.concatenate([np.stack([ring[:-1], ring[1:]], axis=1) for ring in rings]))
    points = shapely.points(corners)
    which, edge = shapely.STRtree(edges).query(points, predicate="dwithin", distance=widest)
    lines = shapely.shortest_line(points[which], edges[edge])
    lines = lines[shapely.length(lines) > 0]
    width = shapely.length(lines)
    middle = shapely.line_interpolate_point(lines, 0.5, normalized=True)
    shapely.prepare(floor)
    is_free = shapely.covers(floor, shapely.buffer(middle, DISC * width / 2))
    ends = shapely.get_coordinates(lines).reshape(-1, 2, 2)
    order = [k for k in np.argsort(width, kind="stable").tolist() if is_free[k]]
    segments = list[Segment]()
    for k in order:
        (x, y), (u, v) = sorted(map(tuple, ends[k].tolist()))
        segments.append(((x, y), (u, v)))
    return list(dict.fromkeys(segments))


def _is_repeated(segment: Segment, chosen: list[Segment]) -> bool:
    """True if the middle is on an opening before it, but for rounding: points beside it would be beyond both."""
    middle = shapely.Point(middle_of(segment))
    return any(shapely.LineString(other).distance(middle) <= SIDE * math.dist(*segment) for other in chosen)


def _parts_wider(floor: Any, segment: Segment, bars: list[Any]) -> bool:
    """True if a segment has wider parts of the floor on both sides, which are not joined near by."""
    width, (mx, my) = math.dist(*segment), middle_of(segment)
    points = beside(segment)

    def parts_within(widths: float) -> list[Any]:
        """Return the parts of the floor beside the segment, as far as so many widths from it."""
        near = floor & shapely.Point(mx, my).buffer(widths * width)
        shut = [bar(segment), *(other for other in bars if other.intersects(near))]
        parts = shapely.get_parts(near.difference(shapely.union_all(shut)))
        return [part for point in points for part in parts[shapely.intersects(parts, point)].tolist()]

    near = parts_within(NEAR)
    if len(near) != 2 or near[0].equals(near[1]):
        return False
    return all(not part.buffer(-WIDER * width / 2).is_empty for part in parts_within(FAR))
