"""What the scene forbids, and which contacts it has, recomputed from its exact coordinates.

Coordinates are integers, the scene's times `scale`. `cfree.features` serves as the address book that says which vertex
a number in the file means; whether two features make a contact is decided here, from the rings.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import gcd, inf, nextafter
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cfree.features import scene_features, unpacked
from cfree.polygon import Polygon
from cfree.verify.surfaces import ZERO, Fault, Form, Surface, Turn, Vector, cross, cut, dot, helix, minus

if TYPE_CHECKING:
    from cfree.scene import Scene

Ring = list[Vector]
Corner = tuple[Vector, Vector, Vector]  # a vertex between its neighbours, the interior on the left
Name = tuple[int, int, int]  # kind, robot feature, obstacle feature
Pose = tuple[Vector, int]  # reference point (x, y) / denominator


@dataclass
class World:
    """A scene: contacts and convex pieces.

    Attributes
    ----------
    parts, walls : list of Ring
        Convex pieces of the robot and of the obstacles, the complement of the workspace among them.
    beyond : list of Ring
        What is outside the bounds, for the reference point.
    untiled : list of str
        Shapes whose pieces are not convex, or do not tile them.
    """

    scene: Scene
    scale: int = field(init=False)
    parts: list[Ring] = field(default_factory=list)
    walls: list[Ring] = field(default_factory=list)
    untiled: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        scene, features = self.scene, scene_features(self.scene)
        self.scale = features.scale
        self.robot, self.obstacles = features.robot, features.obstacles
        robot = [rings_of(p, self.scale) for p in scene.robot]
        obstacles = [rings_of(p, self.scale) for p in scene.obstacles]
        for k, polygon in enumerate(scene.robot):
            self._add_pieces(self.parts, polygon, f"robot[{k}]")
        for k, polygon in enumerate(scene.obstacles):
            self._add_pieces(self.walls, polygon, f"obstacle {k}")
        workspace = scene.workspace and rings_of(scene.workspace, self.scale)
        bounds = [int(b * self.scale) for b in scene.bounds or ()]
        points = [p for rings in (*obstacles, workspace or [[]]) for p in rings[0]]
        points += zip(bounds[::2], bounds[1::2], strict=True)
        margin = 1 + 4 * max(abs(c) for ring in robot for p in ring[0] for c in p)
        (x0, *_, x1), (y0, *_, y1) = (sorted(axis) for axis in zip(*points, *[ZERO] * 2, strict=True))
        around = x0 - margin, y0 - margin, x1 + margin, y1 + margin  # holds the robot at every contact
        self.bounds, self.beyond = (tuple(bounds), frame(around, bounds)) if bounds else ((), [])
        if workspace:
            outer, *holes = workspace
            for k, polygon in enumerate([Polygon(rectangle(*around), [outer]), *map(Polygon, holes)]):
                self._add_pieces(self.walls, polygon, f"part {k} of the workspace's complement", scale=1)
            obstacles.append([ring[::-1] for ring in workspace])
        self.robot_corners = [corner for rings in robot for ring in rings for corner in corners(ring)]
        self.obstacle_corners = [corner for rings in obstacles for ring in rings for corner in corners(ring)]
        inner = rectangle(*bounds)[::-1] if bounds else []  # the complement is on the left
        self.bound_edges = [(p, q) for _, p, q in corners(inner)]
        self._contacts = {id(self.robot): set(self.robot_corners), id(self.obstacles): set(self.obstacle_corners)}
        self.wall_boxes = boxes(self.walls, self.scale)

    def _add_pieces(self, pieces: list[Ring], polygon: Polygon, name: str, scale: int = 0) -> None:
        factor = (scale or self.scale) // polygon.denominator
        vertices = [(x * factor, y * factor) for x, y in polygon.numerators]
        found = [[vertices[k] for k in piece] for piece in polygon.pieces]
        if not tile(found, rings_of(polygon, scale or self.scale)):
            self.untiled.append(name)
        pieces += found

    # --- contacts ---

    def contacts(self) -> Iterator[Surface]:
        """Every contact surface of the scene."""
        convex = [corner for corner in self.robot_corners if is_convex(corner)]
        for corner in self.obstacle_corners:
            yield from (vertex_edge(c, corner[1], corner[2]) for c in convex)
            if is_convex(corner):
                yield from (edge_vertex(a, b, corner) for _, a, b in self.robot_corners)
        for p, q in self.bound_edges:
            yield Surface(ZERO, ZERO, p, minus(q, p))

    def contact(self, name: Name) -> Surface:
        """The contact surface that a patch of the file is part of."""
        kind, i, j = name
        a, b = corner_of(self.robot, i), corner_of(self.obstacles, j)
        if kind == 1 and a == (ZERO, ZERO, ZERO) and b[1:] in self.bound_edges:
            return Surface(ZERO, ZERO, b[1], minus(b[2], b[1]))
        if a not in self._contacts[id(self.robot)] or b not in self._contacts[id(self.obstacles)]:
            raise Fault("its features are no features of one robot polygon and one obstacle")
        if not is_convex(a if kind == 1 else b):
            raise Fault("a contact at a reflex vertex")
        return vertex_edge(a, b[1], b[2]) if kind == 1 else edge_vertex(a[1], a[2], b)

    def curve(self, surface: Surface, name: Name) -> tuple[Form, Form]:
        """Numerator and denominator of the curve that a pair of features names on a surface."""
        kind, i, j = name
        if kind == 3:
            return helix(surface, self.robot.vertices[i], self.obstacles.vertices[j])
        if kind not in (1, 2):
            raise Fault("a curve without a name")
        if kind == 1:
            b, end = edge_of(self.obstacles, j)
            return cut(surface, Surface(self.robot.vertices[i], ZERO, b, minus(end, b)))
        a, end = edge_of(self.robot, i)
        return cut(surface, Surface(a, minus(end, a), self.obstacles.vertices[j], ZERO))

    def angle(self, surface: Surface, name: Name) -> Form:
        """Zero at the angle that one pair of features names."""
        kind, i, j = name
        if kind == 3:
            return surface.form(minus(self.obstacles.vertices[j], surface.b), minus(self.robot.vertices[i], surface.a))
        if kind != 4:
            raise Fault("an angle whose name is neither a helix nor a pair of edges")
        (a, a_end), (b, b_end) = edge_of(self.robot, i), edge_of(self.obstacles, j)
        g, f = minus(a_end, a), minus(b_end, b)
        return 0, cross(g, f), -dot(g, f)

    # --- what is forbidden ---

    def is_forbidden(self, turn: Turn, pose: Pose) -> bool:
        """Is a pose forbidden, at which the robot touches an obstacle or the reference point the bounds?"""
        (x, y), d = pose
        if self.bounds:
            x0, y0, x1, y1 = (d * b for b in self.bounds)
            if not (x0 <= x <= x1 and y0 <= y <= y1):
                return True
        k = d // turn.w
        for part in self.parts:
            placed = [(x + k * u, y + k * v) for u, v in map(turn, part)]
            (box,) = boxes([placed], d * self.scale)
            for wall in near(self.wall_boxes, box):
                if interiors_meet(placed, [(u * d, v * d) for u, v in self.walls[wall]]):
                    return True
        return False


# --- contacts ---


def vertex_edge(corner: Corner, b: Vector, end: Vector) -> Surface:
    """Both edges at the robot's vertex leave the obstacle's edge to its right: q x R E_i, q x -R E_{i-1} < 0."""
    before, a, after = corner
    q = minus(end, b)
    limits = tuple((0, cross(q, e), dot(q, e)) for e in (minus(after, a), minus(before, a)))
    return Surface(a, ZERO, b, q, limits)


def edge_vertex(a: Vector, end: Vector, corner: Corner) -> Surface:
    """Both edges at the obstacle's vertex leave the robot's edge to its right: R g x F_j, R g x -F_{j-1} < 0."""
    before, b, after = corner
    g = minus(end, a)
    limits = tuple((0, cross(g, f), -dot(g, f)) for f in (minus(after, b), minus(before, b)))
    return Surface(a, g, b, ZERO, limits)


def corners(ring: Ring) -> list[Corner]:
    return list(zip(ring[-1:] + ring[:-1], ring, ring[1:] + ring[:1], strict=True))


def is_convex(corner: Corner) -> bool:
    return cross(minus(corner[1], corner[0]), minus(corner[2], corner[1])) > 0


def corner_of(shape: Any, k: int) -> Corner:
    previous = shape.vertices[int(shape.previous[k])]
    return previous, shape.vertices[k], shape.vertices[int(shape.w[k])]


def edge_of(shape: Any, k: int) -> tuple[Vector, Vector]:
    return shape.vertices[int(shape.v[k])], shape.vertices[int(shape.w[k])]


def name_of(code: int) -> Name:
    kind, i, j = unpacked(code)
    return kind, i, j


# --- convex pieces ---


def rectangle(x0: int, y0: int, x1: int, y1: int) -> Ring:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def frame(outer: Sequence[int], inner: Sequence[int]) -> list[Ring]:
    """Four rectangles that cover what is between two."""
    (X0, Y0, X1, Y1), (x0, y0, x1, y1) = outer, inner
    return [rectangle(*side) for side in ((X0, Y0, x0, Y1), (x1, Y0, X1, Y1), (X0, Y0, X1, y0), (X0, y1, X1, Y1))]


def rings_of(polygon: Polygon, scale: int) -> list[Ring]:
    factor = scale // polygon.denominator
    return [[(x * factor, y * factor) for x, y in polygon.numerators[i:j]] for i, j in pairwise(polygon.ring_offsets)]


def tile(pieces: Iterable[Ring], rings: Iterable[Ring]) -> bool:
    """Are the pieces convex, and do they cover the region of rings without overlap?

    Notes
    -----
    On every line the pieces' directed edges have to add up to those of the rings: then the sum of the pieces'
    indicators is the rings' winding number. A sum of directed segments of one line vanishes if their ends cancel.
    """
    ends: Counter[tuple[Vector, int, Vector]] = Counter()
    for shapes, times in ((pieces, 1), (rings, -1)):
        for ring in shapes:
            around = corners(ring)
            fan = [(ring[0], p, q) for _, p, q in around[1:-1]]
            if times == 1 and not all(map(is_convex, around + fan)):
                return False
            for _, p, q in around:
                u = primitive(minus(q, p))
                ends[u, cross(u, p), q] += times
                ends[u, cross(u, p), p] -= times
    return not any(ends.values())


def primitive(u: Vector) -> Vector:
    """The shortest integer vector along a line, one of its two."""
    k = gcd(*u) if u > (0, 0) else -gcd(*u)
    return u[0] // k, u[1] // k


def interiors_meet(first: Ring, second: Ring) -> bool:
    """Do the interiors of two convex counter-clockwise polygons meet? If not, an edge of one separates them."""
    for one, other in ((first, second), (second, first)):
        for _, p, q in corners(one):
            u = minus(q, p)
            level = cross(u, p)
            if all(cross(u, r) <= level for r in other):
                return False
    return True


def boxes(rings: Sequence[Ring], scale: int) -> NDArray[np.float64]:
    """Boxes around rings, rounded outwards: for looking around, never for a decision."""

    def box(ring: Ring) -> list[float]:
        bound: list[tuple[Callable[..., int], float]] = [(min, -inf), (max, inf)]
        return [nextafter(of(axis) / scale, away) for of, away in bound for axis in zip(*ring, strict=True)]

    return np.array([box(ring) for ring in rings]).reshape(-1, 4)


def near(around: NDArray[np.float64], box: NDArray[np.float64]) -> list[int]:
    """Which boxes meet a box."""
    meets = (around[:, :2] <= box[2:]) & (box[:2] <= around[:, 2:])
    found: list[int] = np.flatnonzero(meets.all(axis=1)).tolist()
    return found
