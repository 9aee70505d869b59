"""Contact types that hold in one exact pose; contacts and pseudo contacts. Paper, section 1.2.

Pseudo contact: the boundaries meet. Contact: they meet, and the interiors do not. A pose is forbidden if the
interiors meet: the forbidden space is open, touching is free. Everything is decided on integers; O(n m) time.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise

from cfree.arguments import checked
from cfree.contact.contact import Contact, EdgeEdge, EdgeVertex, VertexEdge, VertexVertex
from cfree.exact.number import IntPoint
from cfree.exact.orientation import Location, Meeting, is_inside_segment, is_opposed, locate, meet
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.polygons.polygon import Polygon

Edge = tuple[IntPoint, IntPoint]


@checked
def contact_features(robot: Polygon, obstacle: Polygon, pose: PoseLike) -> tuple[Contact, ...]:
    """All contact types that hold in a pose, contact or pseudo contact.

    Notes
    -----
    The definitions of section 1.2. Edges that merely cross make a pseudo contact of none of the four types.

    Examples
    --------
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> contact_features(square, square, Pose(1, 1, 0))
    (VertexVertex(i=0, j=2),)
    """
    pose = to_pose(pose, "pose")
    placed = _Placed.of(robot, obstacle, pose)
    types: set[Contact] = set()
    for i, j, met in placed.meetings():
        (a, a_next), (b, b_next) = placed.robot[i], placed.obstacle[j]
        if a == b:
            types.add(VertexVertex(i, j))
        if met is Meeting.OVERLAP:
            types.add(EdgeEdge(i, j))
        if is_inside_segment(a, b, b_next):
            types.add(VertexEdge(i, j))
        if is_inside_segment(b, a, a_next):
            types.add(EdgeVertex(i, j))
    kinds = (VertexEdge, EdgeVertex, VertexVertex, EdgeEdge)
    return tuple(sorted(types, key=lambda contact: (kinds.index(type(contact)), contact.i, contact.j)))


@checked
def is_pseudo_contact(robot: Polygon, obstacle: Polygon, pose: PoseLike) -> bool:
    """True if the boundaries meet.

    Examples
    --------
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> is_pseudo_contact(square, square, Pose("1/2", "1/2", 0)), is_contact(square, square, Pose("1/2", "1/2", 0))
    (True, False)
    """
    pose = to_pose(pose, "pose")
    return any(True for _ in _Placed.of(robot, obstacle, pose).meetings())


@checked
def is_contact(robot: Polygon, obstacle: Polygon, pose: PoseLike) -> bool:
    """True if the boundaries meet, but the interiors do not."""
    pose = to_pose(pose, "pose")
    return is_pseudo_contact(robot, obstacle, pose) and not is_forbidden(robot, obstacle, pose)


@checked
def is_forbidden(robot: Polygon, obstacle: Polygon, pose: PoseLike) -> bool:
    """True if the interiors meet.

    Notes
    -----
    They meet if edges cross. Otherwise cut one boundary at the other's vertices: they meet if a part of it runs inside
    the other polygon, or along its boundary in the same direction, since both interiors are on the left. In all other
    cases no boundary separates parts of one interior by the other, and nothing is common.

    Examples
    --------
    >>> square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> is_forbidden(square, square, Pose(0, 0, 0)), is_forbidden(square, square, Pose(0, 1, 0))
    (True, False)
    """
    pose = to_pose(pose, "pose")
    placed = _Placed.of(robot, obstacle, pose)
    cuts: dict[Edge, set[IntPoint]] = {}
    for i, j, met in placed.meetings():
        if met is Meeting.CROSS:
            return True
        one, other = placed.robot[i], placed.obstacle[j]
        for edge, points in ((one, other), (other, one)):
            cuts.setdefault(edge, set()).update(point for point in points if is_inside_segment(point, *edge))
        if met is Meeting.OVERLAP and not is_opposed(*(_vector(edge) for edge in (one, other))):
            return True
    return any(
        locate(middle, others) is Location.INSIDE
        for own, others in ((placed.robot, placed.obstacle), (placed.obstacle, placed.robot))
        for edge in own
        for middle in _middles(edge, cuts.get(edge, ()))
    )


@dataclass(frozen=True, slots=True)
class _Placed:
    """Edges of the robot in its pose and of the obstacle, times a common number that makes middles integers."""

    robot: list[Edge]
    obstacle: list[Edge]

    @classmethod
    def of(cls, robot: Polygon, obstacle: Polygon, pose: Pose) -> _Placed:
        c, s, w = pose.rotation
        unit = 2 * math.lcm(pose.x.denominator, pose.y.denominator, w * robot.denominator, obstacle.denominator)
        turned, still = unit // (w * robot.denominator), unit // obstacle.denominator
        dx, dy = int(pose.x * unit), int(pose.y * unit)
        placed = [((c * x - s * y) * turned + dx, (s * x + c * y) * turned + dy) for x, y in robot.numerators]
        fixed = [(x * still, y * still) for x, y in obstacle.numerators]
        return cls(
            [(placed[i], placed[k]) for i, k in enumerate(robot.next.tolist())],
            [(fixed[j], fixed[k]) for j, k in enumerate(obstacle.next.tolist())],
        )

    def meetings(self) -> Iterator[tuple[int, int, Meeting]]:
        """Indices of edges that meet, with their `Meeting`."""
        for i, (p, q) in enumerate(self.robot):
            x0, x1 = sorted((p[0], q[0]))
            y0, y1 = sorted((p[1], q[1]))
            for j, (r, s) in enumerate(self.obstacle):
                if (r[0] > x1 and s[0] > x1) or (r[0] < x0 and s[0] < x0):
                    continue
                if (r[1] > y1 and s[1] > y1) or (r[1] < y0 and s[1] < y0):
                    continue
                met = meet(p, q, r, s)
                if met is not Meeting.APART:
                    yield i, j, met


def _vector(edge: Edge) -> IntPoint:
    (x0, y0), (x1, y1) = edge
    return x1 - x0, y1 - y0


def _middles(edge: Edge, cuts: Iterable[IntPoint]) -> Iterator[IntPoint]:
    """Middles of the parts of an edge between its cuts."""
    points = sorted({*edge, *cuts})
    for (x0, y0), (x1, y1) in pairwise(points):
        yield (x0 + x1) // 2, (y0 + y1) // 2
