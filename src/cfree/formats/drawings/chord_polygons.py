"""Polygons for outlines whose curves nearly touch each other or themselves, where `polygon_of` proves none.

Each chord gets a triangle that contains its piece of the curve, up to the rounding of doubles. The union of the chords'
polygon and these triangles contains the shape; the polygon without the triangles is inside it. Both are exact unions,
so that nothing has to be simple before.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from cfree.curves.drawn import Arc, Cubic, Line, Segment, point_of
from cfree.curves.hulls import Outline
from cfree.exact.number import ExactPoint
from cfree.formats.drawings.chords import joints, part_of, place_at, range_of, steps_of
from cfree.polygons.polygon import Polygon
from cfree.polygons.repair import united

Points = list[ExactPoint]


def chord_polygons(outline: Outline, sagitta: float, *, inside: bool) -> tuple[Polygon, ...]:
    """Return polygons around an outline, or inside it, with chords within a distance of its curves.

    Examples
    --------
    >>> from cfree.curves.drawn import arc_of_circle
    >>> disc = Outline([arc_of_circle((0, 0), 1)])
    >>> areas = [chord_polygons(disc, 0.01, inside=inside)[0].area for inside in (False, True)]
    >>> areas[0] > 3.1416 > areas[1] > 3.05
    True
    """
    rings: list[Points] = []
    triangles: list[Points] = []
    for ring in outline.rings:
        points: Points = []
        for segment, (start, end) in zip(ring, pairwise(joints(ring, closed=True)), strict=True):
            points.append(start)
            if not isinstance(segment, Line):
                steps = steps_of(segment, *range_of(segment), sagitta)
                between = [point_of(*place_at(segment, t)) for t in steps[1:-1]]
                points += between
                for (s, t), (p, q) in zip(pairwise(steps), pairwise([start, *between, end]), strict=True):
                    triangles += _around(segment, s, t, p, q)
        rings.append(points)
    if inside:
        return united([[*rings, *triangles]], "evenodd")
    return united([rings, *([triangle] for triangle in triangles)])


def _around(curve: Segment, first: float, last: float, start: ExactPoint, end: ExactPoint) -> Iterator[Points]:
    """Yield triangles that contain a piece of a curve."""
    if isinstance(curve, Arc):
        yield [start, point_of(*curve.at((first + last) / 2, (last - first) / 2)), end]
        return
    piece = part_of(curve, first, last, (start, end))
    assert isinstance(piece, Cubic)
    b, c = (point_of(*p) for p in piece.points[1:3])
    yield from ([start, b, c], [b, c, end], [start, c, end], [start, b, end])
