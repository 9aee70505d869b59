"""Lines of positions at which an arc or vertex of one shape touches an edge of another, exactly, at one orientation.

Let n be the outward unit normal of an obstacle's edge s + t a, grown by o, and c the center of an arc of the part, of
radius rho. They touch where n . r = n . (s - c) + o + rho, and the part overlaps on the smaller side. An edge of the
part on an arc of an obstacle is the same with the roles exchanged. Edges with irrational unit normals are left out.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from typing import Any

from cfree.contact.features import shape_features
from cfree.exact.number import ExactPoint, rational_root
from cfree.exact.pose import Pose
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene

MOST = 20_000  # pairs of lines that are crossed


@dataclass(frozen=True)
class ContactLine:
    """Positions p with normal . p = distance, between two places along the line; the part overlaps where it is less.

    The place of a position is its product with the normal turned left.
    """

    normal: ExactPoint
    distance: Fraction
    first: Fraction
    last: Fraction

    def at(self, place: Fraction) -> ExactPoint:
        """Return the position at a place."""
        (x, y), d = self.normal, self.distance
        return d * x - place * y, d * y + place * x

    def cut_by(self, others: Sequence[ContactLine]) -> Iterator[Fraction]:
        """Yield the places at which other lines cross this one, and those of their ends if they are on it."""
        (x, y), d = self.normal, self.distance
        for other in others:
            (u, v), e = other.normal, other.distance
            slope = x * v - y * u
            if slope:
                yield (e - d * (x * u + y * v)) / slope
            elif (u, v, e) == (x, y, d):
                yield from (other.first, other.last)
            elif (u, v, e) == (-x, -y, -d):
                yield from (-other.first, -other.last)


def contact_lines(scene: Scene, pose: Pose) -> list[ContactLine]:
    """Return the lines of all pairs of an edge and an arc or vertex, the robot's orientation that of a pose."""
    lines: list[ContactLine] = []
    robot = [shape_features(shape) for shape in scene.robot]
    others = [(shape_features(shape), 1) for shape in scene.obstacles]
    if isinstance(scene.workspace, Polygon):  # its edges face inwards
        others.append((shape_features(scene.workspace), -1))
    for part in robot:
        for other, side in others:
            for edge in other.edges:
                for arc in part.arcs:
                    if arc.radius is not None and arc.is_convex:
                        lines += _line(
                            edge.start, edge.along, side, edge.offset + arc.radius, _turned(pose, arc.centre)
                        )
            for edge in part.edges:
                start, along = _turned(pose, edge.start), _turned(pose, edge.along)
                for arc in other.arcs:
                    if arc.radius is not None and arc.is_convex is (side > 0):
                        lines += _mirrored(_line(start, along, 1, edge.offset + abs(arc.radius), arc.centre))
    return list(dict.fromkeys(lines))


def _turned(pose: Pose, p: ExactPoint) -> ExactPoint:
    c, s, w = pose.rotation
    return Fraction(c * p[0] - s * p[1], w), Fraction(s * p[0] + c * p[1], w)


def _line(start: ExactPoint, along: ExactPoint, side: int, apart: Fraction, center: ExactPoint) -> list[ContactLine]:
    """Return the line of a center that is so far apart from an edge, outside of it."""
    length = rational_root(along[0] ** 2 + along[1] ** 2)
    if not length:
        return []
    x, y = side * along[1] / length, -side * along[0] / length
    u, v = start[0] - center[0], start[1] - center[1]
    ends = [x * b - y * a for a, b in ((u, v), (u + along[0], v + along[1]))]
    return [ContactLine((x, y), x * u + y * v + apart, min(ends), max(ends))]


def _mirrored(lines: list[ContactLine]) -> list[ContactLine]:
    """Return lines of the other shape's positions as those of this one: they are opposite."""
    return [ContactLine((-a.normal[0], -a.normal[1]), a.distance, a.first, a.last) for a in lines]


def crossings(lines: Sequence[ContactLine]) -> Iterator[ExactPoint]:
    """Yield positions at which two lines cross, within both."""
    for one, other in _few(lines):
        (x, y), (u, v) = one.normal, other.normal
        slope = x * v - y * u
        if slope:
            place = (other.distance - one.distance * (x * u + y * v)) / slope
            p = one.at(place)
            if one.first <= place <= one.last and other.first <= u * p[1] - v * p[0] <= other.last:
                yield p


def _few(lines: Sequence[ContactLine]) -> Iterator[tuple[ContactLine, ContactLine]]:
    for k, pair in enumerate(combinations(lines, 2)):
        if k == MOST:
            return
        yield pair


def facing(lines: Sequence[ContactLine]) -> Iterator[tuple[Fraction, Fraction, ContactLine]]:
    """Yield places from first to last on a line where contacts of both sides are in force; overlaps are united."""
    by_line: dict[Any, list[ContactLine]] = defaultdict(list)
    for line in lines:
        by_line[line.normal, line.distance].append(line)
    for (normal, distance), same in by_line.items():
        if normal < (0, 0):
            continue
        spans = [
            (max(one.first, -other.last), min(one.last, -other.first))
            for one in same
            for other in by_line.get(((-normal[0], -normal[1]), -distance), [])
        ]
        reach: Fraction | None = None
        start = Fraction(0)
        for first, last in sorted(span for span in spans if span[0] < span[1]):
            if reach is None or first > reach:
                if reach is not None:
                    yield start, reach, same[0]
                start, reach = first, last
            reach = max(reach, last)
        if reach is not None:
            yield start, reach, same[0]


def is_between(p: ExactPoint, a: ExactPoint, b: ExactPoint) -> bool:
    """True if a point is on a segment, its ends included."""
    if (b[0] - a[0]) * (p[1] - a[1]) != (b[1] - a[1]) * (p[0] - a[0]):
        return False
    return min(a[0], b[0]) <= p[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= p[1] <= max(a[1], b[1])
