"""Pad outlines of robots as nav2 does, without making them smaller anywhere."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Protocol

from cfree.curves.curved import Curved
from cfree.errors import InvalidPolygonError
from cfree.exact.number import ExactPoint
from cfree.exact.orientation import Location, locate
from cfree.polygons.hull import convex_hull
from cfree.polygons.polygon import Polygon
from cfree.scene.reading import Effect, Kind, Note
from cfree.scene.scene import AnyShape

Ring = tuple[ExactPoint, ...]
_ROOT_OF_TWO = Fraction(14142136, 10**7)  # rounded up
_MOST_PAIRS = 5_000  # of edges, in the test whether one outline contains another


class Noting(Protocol):
    """A record of reading that is being written."""

    def note(self, kind: Kind, what: str, effect: Effect = ..., *, size: float | None = ...) -> object:
        """Note a difference."""


class Record:
    """Notes in a list."""

    def __init__(self) -> None:
        self.notes: list[Note] = []

    def note(self, kind: Kind, what: str, effect: Effect = "none", *, size: float | None = None) -> None:
        """Add a note."""
        self.notes.append(Note(kind, what, effect, size=size))


def padded_robot(record: Noting, parts: Sequence[AnyShape], by: Fraction) -> list[AnyShape]:
    """Return the parts of a robot, each padded; round ones are grown by a disc that contains the padding."""
    result: list[AnyShape] = []
    for part in parts:
        if isinstance(part, Curved):
            radius = by * _ROOT_OF_TWO
            record.note("guess", "padded round part, grown by a disc", "more", size=float(radius))
            around = part.outer(part.size / 1000)
            result += [Curved(*_outer_and_holes(polygon), grown=radius) for polygon in around]
        else:
            result += padded(record, part, by)
    return result


def _outer_and_holes(polygon: Polygon) -> tuple[Ring, list[Ring]]:
    outer, *holes = polygon.exact_rings
    return outer, holes


def padded(source: Noting, polygon: Polygon, by: Fraction, is_disc: bool = False) -> list[AnyShape]:
    """Return the outline as drawn and the one that nav2 pads, or one shape that contains both; note it.

    nav2 moves each vertex away from both axes. That leaves parts of many drawn outlines out, and makes some cross
    themselves: then the drawn outline is grown by a disc that contains every vertex of the padded one. The polygon
    around a disc is padded at all sides: nav2 pads a polygon inside of the disc.

    Examples
    --------
    >>> box = Polygon([(1, 1), (-1, 1), (-1, -1), (1, -1)])
    >>> [part.exact_area for part in padded(Record(), box, Fraction(1, 2))]
    [Fraction(9, 1)]
    >>> beside = Polygon([(2, 0), (4, 0), (4, 1), (2, 1)])
    >>> [part.bounds for part in padded(Record(), beside, Fraction(1))]
    [(2.0, 0.0, 4.0, 1.0), (3.0, 0.0, 5.0, 2.0)]
    """
    if by <= 0:
        return [polygon]
    ring, *holes = polygon.exact_rings
    moved = [(x + by * _sign(x), y + by * _sign(y)) for x, y in ring]
    size = float(by)
    if is_disc:
        moved = [
            *Polygon(convex_hull((x + u, y + v) for x, y in ring for u in (-by, by) for v in (-by, by))).exact_vertices
        ]
    try:
        larger = Polygon(moved, holes)
    except InvalidPolygonError:
        size = float(by * _ROOT_OF_TWO)
        what = "padded outline with crossings: the drawn one is grown by a disc"
        source.note("guess", what, "more", size=size)
        return [Curved(ring, holes, grown=by * _ROOT_OF_TWO)]
    if is_disc or contains(larger, polygon):
        source.note("info", "padding by nav2's rule", "more", size=size)
        return [larger]
    what = "padded outline, beside the drawn one: both are the robot"
    source.note("guess", what, "more", size=size)
    return [polygon, larger]


def contains(outer: Polygon, inner: Polygon) -> bool:
    """True if a polygon is proved to contain another; false also if there are holes, or too many edges to try.

    Examples
    --------
    >>> angle = Polygon([(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)])
    >>> contains(angle, Polygon([(0, 0), (1, 0), (1, 3)])), contains(angle, Polygon([(0, 0), (4, 0), (0, 4)]))
    (True, False)
    """
    if len(outer.exact_rings) > 1 or len(outer) * len(inner) > _MOST_PAIRS * (20 if outer.is_convex else 1):
        return False
    ring = outer.exact_rings[0]
    edges = list(zip(ring, (*ring[1:], ring[0]), strict=True))
    corners = inner.exact_rings[0]
    if any(locate(point, edges) is Location.OUTSIDE for point in corners):
        return False
    points: list[ExactPoint] = []
    if not outer.is_convex:
        for p, q in zip(corners, (*corners[1:], corners[0]), strict=True):
            stops = sorted({Fraction(0), Fraction(1), *(t for r, s in edges for t in _meetings(p, q, r, s))})
            middles = ((a + b) / 2 for a, b in pairwise(stops))
            points += [(p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])) for t in middles]
    return all(locate(point, edges) is not Location.OUTSIDE for point in points)


def _meetings(p: ExactPoint, q: ExactPoint, r: ExactPoint, s: ExactPoint) -> list[Fraction]:
    """Return the parameters in (0, 1) at which the segment from p to q meets the segment from r to s."""
    ux, uy, vx, vy, wx, wy = q[0] - p[0], q[1] - p[1], s[0] - r[0], s[1] - r[1], r[0] - p[0], r[1] - p[1]
    side = wx * uy - wy * ux
    if cross := ux * vy - uy * vx:
        parameters = [(wx * vy - wy * vx) / cross] if 0 <= side / cross <= 1 else []
    elif side:
        parameters = []
    else:
        length = ux * ux + uy * uy
        parameters = [(x * ux + y * uy) / length for x, y in ((wx, wy), (wx + vx, wy + vy))]
    return [t for t in parameters if 0 < t < 1]


def _sign(value: Fraction) -> int:
    return (value > 0) - (value < 0)
