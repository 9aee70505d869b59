"""Repair polygons: exact unions of rings that cross or touch themselves and each other, by a fill rule.

All rings are noded exactly; the result is what they fill. Spikes, repeated points and rings without interior vanish,
a bow tie becomes two polygons, and shapes that overlap or share edges become one.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from typing import Any, Literal

import numpy as np

from cfree.arguments import checked
from cfree.errors import InvalidPolygonError
from cfree.exact.number import ExactPoint
from cfree.polygons.faces import Cycle, Faces
from cfree.polygons.noding import CrowdedError, graph_of
from cfree.polygons.polygon import Polygon
from cfree.polygons.rings import plain_ring

Rule = Literal["nonzero", "evenodd"]
Rings = Sequence[Sequence[ExactPoint]]
"""An outer ring and holes."""
FARTHEST = 10**150
"""Bound of coordinates: products of two are doubles."""


@checked
def repaired(shape: Any, *, rule: Rule = "nonzero") -> tuple[Polygon, ...]:
    """Return valid polygons for a shape that may cross itself, exactly.

    Parameters
    ----------
    shape : ring, Polygon, shapely geometry, or sequence of these
        A ring is a sequence of points (x, y). A shapely polygon or multipolygon may be invalid. Shapes of a sequence
        are united.
    rule : "nonzero" or "evenodd"
        Where rings cross themselves: "nonzero" fills all points around which the outer ring winds, and leaves out those
        around which a hole winds an odd number of times; it is for obstacles and robots. "evenodd" fills points around
        which the outer ring winds an odd number of times, and leaves out all that a hole winds around; it is for
        workspaces. Without crossings the two are the same.

    Returns
    -------
    tuple of Polygon
        They touch each other at most in points.

    Raises
    ------
    InvalidPolygonError
        If nothing with an interior is left, or rings cross too often.

    Examples
    --------
    >>> bow_tie = [(0, 0), (2, 2), (2, 0), (0, 2)]
    >>> [polygon.vertices.tolist() for polygon in repaired(bow_tie)]
    [[[0.0, 2.0], [0.0, 0.0], [1.0, 1.0]], [[2.0, 0.0], [2.0, 2.0], [1.0, 1.0]]]
    >>> spike = [(0, 0), (4, 0), (9, 0), (4, 0), (4, 4), (4, 4), (0, 4)]
    >>> [polygon.exact_area for polygon in repaired(spike)]
    [Fraction(16, 1)]
    >>> square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> [polygon.exact_area for polygon in repaired([square, [(1, 1), (3, 1), (3, 3), (1, 3)]])]
    [Fraction(7, 1)]
    """
    polygons = united(list(_shapes(shape)), rule)
    if not polygons:
        raise InvalidPolygonError("nothing is left: the shape has no interior; give it width")
    return polygons


def united(shapes: Sequence[Rings], rule: Rule = "nonzero") -> tuple[Polygon, ...]:
    """Return the union of shapes of exact rings, see `repaired`; nothing, if they have no interior.

    Raises
    ------
    InvalidPolygonError
        If a point is beyond 1e150, or rings cross too often.
    """
    if any(abs(x) >= FARTHEST for rings in shapes for ring in rings for point in ring for x in point):
        raise InvalidPolygonError("a point lies beyond 1e150; scale the coordinates")
    graph = graph_of(p for rings in shapes for ring in rings for p in ring)
    owner: list[tuple[int, bool]] = []  # shape of each ring; True for holes
    segments: list[tuple[ExactPoint, ExactPoint, int]] = []
    for number, rings in enumerate(shapes):
        for k, ring in enumerate(rings):
            segments += [(ring[j - 1], p, len(owner)) for j, p in enumerate(ring)]
            owner.append((number, k > 0))
    try:
        graph.add(segments)
    except CrowdedError:
        raise InvalidPolygonError("rings that cross too often; simplify them") from None
    faces = Faces(graph)
    windings: list[dict[int, int]] = [{} for _ in range(faces.count)]
    for half, right, left in faces.crossings():
        winding = Counter(windings[right])
        for source, sign in graph.uses[half >> 1]:
            winding[source] += -sign if half & 1 else sign
        windings[left] = {source: times for source, times in winding.items() if times}
    solid = [_is_inside(winding, owner, rule) for winding in windings]

    def points(cycle: Cycle) -> list[ExactPoint]:
        return [graph.point(faces.origin(half)) for half in cycle]

    outlines = sorted(faces.outlines(solid), key=lambda rings: min(map(faces.origin, rings[0])))
    return tuple(Polygon(points(outer), list(map(points, holes))) for outer, *holes in outlines)


def _is_inside(winding: dict[int, int], owner: Sequence[tuple[int, bool]], rule: Rule) -> bool:
    """True if some outer ring fills a face and no hole of its shape empties it."""
    filled: dict[int, bool] = defaultdict(bool)
    emptied: set[int] = set()
    for ring, times in winding.items():
        shape, is_hole = owner[ring]
        is_odd = times % 2 == 1
        if is_hole and (is_odd or rule == "evenodd"):
            emptied.add(shape)
        elif not is_hole:
            filled[shape] |= is_odd or rule == "nonzero"
    return any(inside and shape not in emptied for shape, inside in filled.items())


def _shapes(shape: Any) -> Iterable[Rings]:
    """Yield the rings of each shape."""
    if isinstance(shape, Polygon):
        yield shape.exact_rings
    elif hasattr(shape, "geom_type"):
        yield from _of_shapely(shape)
    elif isinstance(shape, np.ndarray):
        yield [plain_ring(0, shape.tolist())]
    elif isinstance(shape, str) or not isinstance(shape, Iterable):
        raise InvalidPolygonError(f"{type(shape).__name__} is no shape; give a ring of points, or several")
    elif (items := list(shape)) and _is_point(items[0]):
        yield [plain_ring(0, items)]
    else:
        for item in items:
            yield from _shapes(item)


def _is_point(item: Any) -> bool:
    if isinstance(item, np.ndarray):
        return bool(item.shape == (2,))
    return isinstance(item, tuple | list) and len(item) == 2 and not isinstance(item[0], tuple | list)


def _of_shapely(geometry: Any) -> Iterable[Rings]:
    import shapely

    if geometry.geom_type == "Polygon":
        rings = [] if geometry.is_empty else [geometry.exterior, *geometry.interiors]
        yield [plain_ring(k, shapely.get_coordinates(ring).tolist()) for k, ring in enumerate(rings)]
    elif hasattr(geometry, "geoms"):
        for part in geometry.geoms:
            yield from _of_shapely(part)
    else:
        raise InvalidPolygonError(f"{geometry.wkt:.60} is no polygon; give polygons")
