"""Forbidden space and contacts of the scene, recomputed from its exact coordinates.

Coordinates are integers, the scene's times `scale`. `cfree.scene.features` is the address book: it maps numbers in the
file to vertices. The contacts of two features are decided here, from the rings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import chain
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cfree.forbidden.columns import Ints
from cfree.polygons.polygon import Polygon
from cfree.scene.features import ShapeFeatures, scene_features, unpacked
from cfree.verify.heights import Contacts, Pillars, columns, rough_rotation
from cfree.verify.polygons import (
    Boxes,
    Corner,
    Ring,
    boxes,
    corners,
    frame,
    is_convex,
    rectangle,
    rings_of,
    shortest,
    tile,
)
from cfree.verify.surfaces import ZERO, Fault, Form, Surface, Turn, Vector, cross, cut, dot, helix, minus

if TYPE_CHECKING:
    from cfree.scene.scene import Scene

Cut = tuple[list[Ring], list[Ring]]
Directed = tuple[list[Vector], NDArray[np.int64], NDArray[np.int64]]
Name = tuple[int, int, int]  # kind, robot feature, obstacle feature
VERTEX_EDGE, EDGE_VERTEX, HELIX, PARALLEL = 1, 2, 3, 4  # kinds
Feature = tuple[str, str, int]  # of "robot" or "obstacles", "vertex" or "edge", number


@dataclass
class World:
    """A scene: contacts and convex pieces.

    Attributes
    ----------
    auxiliary : mapping, optional
        Points of features that names may use and the scene does not have. The default are the features' own: diagonals
        of pieces, corners beyond the bounds.
    parts, obstacle_pieces : list of Ring
        Convex pieces of the robot and of the obstacles, the complement of the workspace among them.
    beyond : list of Ring
        Region outside the bounds, for the reference point.
    untiled : list of str
        Shapes whose pieces are not convex, or do not tile them.
    bounds : list of int
        xmin, ymin, xmax, ymax; empty if there are none.
    unit : int
        No vertex, and no reference point at a contact, has a larger coordinate.
    """

    scene: Scene
    auxiliary: Mapping[Feature, Sequence[Vector]] | None = None
    scale: int = field(init=False)
    bounds: list[int] = field(init=False)

    def __post_init__(self) -> None:
        scene, features = self.scene, scene_features(self.scene)
        self.scale = features.scale
        self.robot, self.obstacles = features.robot, features.obstacles
        self.bounds = [int(b * self.scale) for b in scene.bounds or ()]
        self._robot = [rings_of(p, self.scale) for p in scene.robot]
        self._obstacles = [rings_of(p, self.scale) for p in scene.obstacles]
        self._workspace = rings_of(scene.workspace, self.scale) if scene.workspace else []
        # the complement is on the left
        self.bound_corners = corners(rectangle(*self.bounds)[::-1]) if self.bounds else []

    @cached_property
    def _around(self) -> tuple[int, int, int, int]:
        """Box that holds the robot at every contact."""
        points = [ZERO, *(p for rings in (*self._obstacles, self._workspace) if rings for p in rings[0])]
        points += zip(self.bounds[::2], self.bounds[1::2], strict=True)
        margin = 1 + 4 * max(abs(c) for rings in self._robot for p in rings[0] for c in p)
        xs, ys = zip(*points, strict=True)
        return min(xs) - margin, min(ys) - margin, max(xs) + margin, max(ys) + margin

    @cached_property
    def unit(self) -> int:
        return max(map(abs, self._around))

    @cached_property
    def beyond(self) -> list[Ring]:
        return frame(self._around, self.bounds) if self.bounds else []

    @cached_property
    def parts(self) -> list[Ring]:
        return [piece for pieces, _ in self._cut_robot for piece in pieces]

    @cached_property
    def obstacle_pieces(self) -> list[Ring]:
        return [piece for pieces, _ in self._cut_obstacles for piece in pieces]

    @property
    def untiled(self) -> list[str]:
        names = [f"robot[{k}]" for k in range(len(self._robot))]
        names += [f"obstacle {k}" for k in range(len(self._obstacles))]
        names += [f"part {k} of the workspace's complement" for k in range(len(self._workspace))]
        return [
            name
            for name, (pieces, rings) in zip(names, (*self._cut_robot, *self._cut_obstacles), strict=True)
            if not tile(pieces, rings)
        ]

    @cached_property
    def obstacle_boxes(self) -> Boxes:
        return boxes(self.obstacle_pieces, self.unit)

    @cached_property
    def _cut_robot(self) -> list[Cut]:
        return list(map(_cut, self.scene.robot, self._robot))

    @cached_property
    def _cut_obstacles(self) -> list[Cut]:
        cuts = list(map(_cut, self.scene.obstacles, self._obstacles))
        if self._workspace:
            outer, *holes = self._workspace
            for polygon in (Polygon(rectangle(*self._around), [outer]), *map(Polygon, holes)):
                cuts.append(_cut(polygon, rings_of(polygon, 1)))
        return cuts

    @cached_property
    def robot_corners(self) -> list[Corner]:
        return [corner for rings in self._robot for ring in rings for corner in corners(ring)]

    @cached_property
    def obstacle_corners(self) -> list[Corner]:
        rings = [ring for rings in self._obstacles for ring in rings] + [ring[::-1] for ring in self._workspace]
        return [corner for ring in rings for corner in corners(ring)]

    @cached_property
    def _contacts(self) -> dict[int, set[Corner]]:
        return {id(self.robot): set(self.robot_corners), id(self.obstacles): set(self.obstacle_corners)}

    @cached_property
    def pillars(self) -> Pillars:
        """All pairs of convex pieces, rounded and exact."""
        return Pillars(self)

    # --- contacts ---

    def contacts(self) -> Iterator[Surface]:
        """Yield every contact surface of the scene."""
        convex = [corner for corner in self.robot_corners if is_convex(corner)]
        for corner in self.obstacle_corners:
            yield from (vertex_edge(c, corner[1], corner[2]) for c in convex)
            if is_convex(corner):
                yield from (edge_vertex(a, b, corner) for _, a, b in self.robot_corners)
        yield from self._bounding()

    def contacts_at(self, turn: Turn) -> tuple[Contacts, Callable[[int], Surface]]:
        """Contacts whose closed range holds an angle: rounded, and a function that makes the surface of one."""
        (robot, here, before), (obstacles, there, behind) = self._directions
        sign = sides(obstacles, robot, turn)
        side = sign[there][:, here]  # (obstacle edges, robot edges)
        convex_a, convex_b = (
            np.array([is_convex(corner) for corner in corners], bool)
            for corners in (self.robot_corners, self.obstacle_corners)
        )
        on_edge = (side <= 0) & (sign[there][:, before] >= 0) & convex_a
        on_vertex = (side >= 0) & (sign[behind][:, here] <= 0) & convex_b[:, None]
        bounds = list(self._bounding())
        (ej, ei), (vj, vi) = np.nonzero(on_edge), np.nonzero(on_vertex)
        i, j = np.concatenate([ei, vi]), np.concatenate([ej, vj])
        is_edge = np.arange(len(i)) < len(ei)

        def surface(k: int) -> Surface:
            if k >= len(i):
                return bounds[k - len(i)]
            a, b = self.robot_corners[i[k]], self.obstacle_corners[j[k]]
            return vertex_edge(a, b[1], b[2]) if is_edge[k] else edge_vertex(a[1], a[2], b)

        def rounded(name: str, vectors: Sequence[NDArray[np.float64]], numbers: NDArray[np.int64], factor: Any) -> Any:
            more = columns([getattr(bound, name) for bound in bounds], self.unit)
            return [np.append(factor * column[numbers], m) for column, m in zip(vectors, more, strict=True)]

        (a, g), (b, q) = self._rounded
        arrays = rounded("a", a, i, 1), rounded("g", g, i, ~is_edge), rounded("b", b, j, 1), rounded("q", q, j, is_edge)
        return arrays, surface

    @cached_property
    def _directions(self) -> tuple[Directed, Directed]:
        return directed(self.robot_corners), directed(self.obstacle_corners)

    @cached_property
    def _rounded(self) -> Sequence[Sequence[tuple[NDArray[np.float64], NDArray[np.float64]]]]:
        """Vertices, and the edges that start there, first for the robot's corners, then for the obstacles'."""
        return [
            [columns([p for _, p, _ in them], self.unit), columns([minus(q, p) for _, p, q in them], self.unit)]
            for them in (self.robot_corners, self.obstacle_corners)
        ]

    def _bounding(self) -> Iterator[Surface]:
        return (Surface(ZERO, ZERO, p, minus(q, p)) for _, p, q in self.bound_corners)

    def contact(self, name: Name) -> Surface:
        """Contact surface that a patch of the file is part of."""
        kind, i, j = name
        a, b = corner_of(self.robot, i), corner_of(self.obstacles, j)
        if kind == VERTEX_EDGE and a == (ZERO, ZERO, ZERO) and b in self.bound_corners:
            return Surface(ZERO, ZERO, b[1], minus(b[2], b[1]))
        if a not in self._contacts[id(self.robot)] or b not in self._contacts[id(self.obstacles)]:
            raise Fault("its features are no features of one robot polygon and one obstacle")
        if not is_convex(a if kind == VERTEX_EDGE else b):
            raise Fault("a contact at a reflex vertex")
        return vertex_edge(a, b[1], b[2]) if kind == VERTEX_EDGE else edge_vertex(a[1], a[2], b)

    def curve(self, surface: Surface, name: Name) -> tuple[Form, Form]:
        """Numerator and denominator of the curve that a pair of features names on a surface."""
        return helix(surface, *self.vertices(name)) if name[0] == HELIX else cut(surface, self.surface(name))

    def surface(self, name: Name) -> Surface:
        """Surface that a pair of features names, for its lines alone."""
        kind, i, j = name
        if kind == VERTEX_EDGE:
            b, end = self.edge(self.obstacles, j)
            return Surface(self.vertex(self.robot, i), ZERO, b, minus(end, b))
        if kind != EDGE_VERTEX:
            raise Fault("a curve without a name")
        a, end = self.edge(self.robot, i)
        return Surface(a, minus(end, a), self.vertex(self.obstacles, j), ZERO)

    def vertices(self, name: Name) -> tuple[Vector, Vector]:
        """Two vertices that a helix is named by."""
        return self.vertex(self.robot, name[1]), self.vertex(self.obstacles, name[2])

    def angle(self, surface: Surface, name: Name) -> Form:
        """Form that is zero at the angle that one pair of features names."""
        kind, i, j = name
        if kind == HELIX:
            a, b = self.vertices(name)
            return surface.form(minus(b, surface.b), minus(a, surface.a))
        if kind != PARALLEL:
            raise Fault("an angle whose name is neither a helix nor a pair of edges")
        (a, a_end), (b, b_end) = self.edge(self.robot, i), self.edge(self.obstacles, j)
        g, f = minus(a_end, a), minus(b_end, b)
        return 0, cross(g, f), -dot(g, f)

    def vertex(self, shape: ShapeFeatures, k: int) -> Vector:
        if self.auxiliary is None or self.is_own(shape, k):
            return shape.vertices[k]
        return self._foreign(shape, "vertex", k)[0]

    def edge(self, shape: ShapeFeatures, k: int) -> tuple[Vector, Vector]:
        if self.auxiliary is None or self.is_own(shape, k):
            return shape.vertices[int(shape.v[k])], shape.vertices[int(shape.w[k])]
        first, last = self._foreign(shape, "edge", k)
        return first, last

    def is_own(self, shape: ShapeFeatures, k: int) -> bool:
        """True if it is a feature of a polygon of the scene, or of its bounds."""
        own = self._own[id(shape)]
        return k < len(own) and own[k]

    @cached_property
    def _own(self) -> dict[int, list[bool]]:
        return {id(shape): (shape.owner_vertex >= 0).tolist() for shape in (self.robot, self.obstacles)}

    def _foreign(self, shape: ShapeFeatures, kind: str, k: int) -> list[Vector]:
        side = "robot" if shape is self.robot else "obstacles"
        if self.auxiliary is None or (points := self.auxiliary.get((side, kind, k))) is None:
            raise Fault(f"{kind} {k} of the {side} is neither in the scene nor among the auxiliary features")
        scaled = [(x * self.scale, y * self.scale) for x, y in points]
        if any(c.denominator > 1 for point in scaled for c in point):
            raise Fault(f"auxiliary {kind} {k} of the {side} has another denominator than the scene")
        return [(int(x), int(y)) for x, y in scaled]


def _cut(polygon: Polygon, rings: list[Ring]) -> Cut:
    """Convex pieces of a polygon, and its rings."""
    vertices = list(chain.from_iterable(rings))
    return [[vertices[k] for k in piece] for piece in polygon.pieces], rings


def directed(corners: Sequence[Corner]) -> Directed:
    """Directions of edges, each once; and the numbers of the directions that start, and end, at each corner."""
    numbers: dict[Vector, int] = {}
    edges = [[minus(q, p), minus(p, before)] for before, p, q in corners]
    edge_numbers = [[numbers.setdefault(shortest(u), len(numbers)) for u in both] for both in edges]
    starts, ends = np.array(edge_numbers, np.int64).reshape(-1, 2).T
    return list(numbers), starts, ends


def sides(fixed: Sequence[Vector], turned: Sequence[Vector], turn: Turn) -> NDArray[np.int64]:
    """Signs of f x R e for every f and e.

    Notes
    -----
    It is that of cos (f x e) + sin (f . e). Both vectors are divided by their greater coordinates, so no product is
    greater than 1; the seven operations and the roundings of cos, sin and quotients are off by less than 2^-46.
    """
    f, e = (np.array([_scaled(u) for u in them], np.float64).reshape(-1, 2) for them in (fixed, turned))
    c, s = rough_rotation(turn)
    (fx, fy), (ex, ey) = f.T[:, :, None], e.T[:, None]
    rough: NDArray[np.float64] = c * (fx * ey - fy * ex) + s * (fx * ex + fy * ey)
    sign: NDArray[np.int64] = np.sign(rough).astype(np.int64)
    for i, j in np.argwhere(abs(rough) < 2.0**-44).tolist():
        exact = turn.value((0, cross(fixed[i], turned[j]), dot(fixed[i], turned[j])))
        sign[i, j] = (exact > 0) - (exact < 0)
    return sign


def _scaled(u: Vector) -> tuple[float, float]:
    most = max(abs(u[0]), abs(u[1]))
    return u[0] / most, u[1] / most


def vertex_edge(corner: Corner, b: Vector, end: Vector) -> Surface:
    """Contact of a vertex: both edges there leave the obstacle's edge to its right: q x R E_i, q x -R E_{i-1} < 0."""
    before, a, after = corner
    q = minus(end, b)
    limits = tuple((0, cross(q, e), dot(q, e)) for e in (minus(after, a), minus(before, a)))
    return Surface(a, ZERO, b, q, limits)


def edge_vertex(a: Vector, end: Vector, corner: Corner) -> Surface:
    """Contact of an edge: both edges at the vertex leave it to its right: R g x F_j, R g x -F_{j-1} < 0."""
    before, b, after = corner
    g = minus(end, a)
    limits = tuple((0, cross(g, f), -dot(g, f)) for f in (minus(after, b), minus(before, b)))
    return Surface(a, g, b, ZERO, limits)


def corner_of(shape: Any, k: int) -> Corner:
    previous = shape.vertices[int(shape.previous[k])]
    return previous, shape.vertices[k], shape.vertices[int(shape.w[k])]


@lru_cache(maxsize=1 << 16)
def name_of(code: int) -> Name:
    kind, i, j = unpacked(code)
    return kind, i, j


def numbers(shape: ShapeFeatures, named: Iterable[Sequence[int]]) -> Ints:
    """Numbers of features that an answer names by polygon and vertex."""
    owners = zip(shape.owner_polygon.tolist(), shape.owner_vertex.tolist(), strict=True)
    number = {owner: k for k, owner in enumerate(owners) if owner[1] >= 0}
    try:
        return np.array([number[polygon, vertex] for polygon, vertex in named], np.int32)
    except KeyError as error:
        polygon, vertex = error.args[0]
        raise Fault(f"there is no vertex {vertex} of polygon {polygon}") from None
