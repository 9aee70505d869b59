"""Features of a scene in the numbering of the core, in Python: integer coordinates, and an identity for each.

Coordinates are multiplied by one common denominator. Coincident vertices get one *point*, directed edges on one line
with one direction one *line*, parallel edges one *direction*: equality of features is settled here, exactly, once. The
core then names curves and critical angles by these, and most ties need no arithmetic.

Two layers meet only themselves: the robot's polygons with the obstacles (and the complement of `workspace`), and the
robot's reference point, as a shape of its own, with the complement of `bounds`.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree import _core
from cfree.polygons.polygon import Polygon
from cfree.scene.features import BODY, BOUNDS, REFERENCE, WORKSPACE
from cfree.scene.scene import Scene

Point = tuple[int, int]
Box = tuple[int, int, int, int]
FAR = 2**10  # sizes: farther away shapes are measured from a place near them
LARGEST_BITS = 100  # of the core's doubles, so that products of four of their products stay finite
RING_COLUMNS = ("previous", "convex", "emit", "layer", "owner_polygon", "owner_vertex")


class ShapeFeatures:
    """Flat arrays of the robot or of the obstacles; see ``cpp/include/cfree/scene/scene.hpp`` for those the core takes.

    Attributes
    ----------
    shift : int
        The core's doubles are the integer coordinates times ``2 ** -shift``, the same for both shapes.
    xy : (n, 2) float64
        Vertices in the user's units, correctly rounded.
    v, w : (e,) int32
        Ends of the directed edges: edge k of a ring starts at vertex k; the pieces' diagonals come last.
    previous : (r,) int32
        The vertex before, for the vertices of rings, which come first.
    owner_polygon, owner_vertex : (r,) int32
        Their owners; polygon is `BOUNDS` or `WORKSPACE` if they belong to no user's polygon.
    """

    def __init__(self, scale: int) -> None:
        self.scale = scale
        self.shift = self.near_shift = 0
        self.origin: Point = (0, 0)
        self.vertices: list[Point] = []
        self.edges: list[tuple[int, int]] = []
        self.pieces: list[list[int]] = []  # of vertices
        self.piece_layer: list[int] = []
        self.rings: dict[str, list[Any]] = {name: [] for name in RING_COLUMNS}

    def add_ring(self, ring: Sequence[Point], **columns: Sequence[Any]) -> None:
        first, n = len(self.vertices), len(ring)
        self.vertices.extend(ring)
        self.edges.extend((first + k, first + (k + 1) % n) for k in range(n))
        self.rings["previous"].extend(first + (k - 1) % n for k in range(n))
        for name, values in columns.items():
            self.rings[name].extend(values)

    def add_polygon(
        self,
        polygon: Polygon,
        layer: int,
        index: int,
        *,
        emit_outer: bool = True,
        owner_vertex: Mapping[Point, int] | None = None,
    ) -> None:
        factor, first = self.scale // polygon.denominator, len(self.vertices)
        points = [(x * factor, y * factor) for x, y in polygon.numerators]
        convex, offsets = polygon.convex.tolist(), polygon.ring_offsets
        for ring, (i, j) in enumerate(pairwise(offsets)):
            n = j - i
            self.add_ring(
                points[i:j],
                convex=convex[i:j],
                emit=[emit_outer or ring > 0] * n,
                layer=[layer] * n,
                owner_polygon=[index] * n,
                owner_vertex=range(i, j) if owner_vertex is None else [owner_vertex[p] for p in points[i:j]],
            )
        for piece in polygon.pieces:
            self.add_piece([first + v for v in piece], layer)

    def add_piece(self, vertices: list[int], layer: int) -> None:
        self.pieces.append(vertices)
        self.piece_layer.append(layer)

    @cached_property
    def xy(self) -> NDArray[np.float64]:
        return np.array([(x / self.scale, y / self.scale) for x, y in self.vertices]).reshape(-1, 2)

    @cached_property
    def near(self) -> NDArray[np.float64]:
        """`xy` from the origin: all digits, however far away that is."""
        x0, y0 = self.origin
        return np.array([((x - x0) / self.scale, (y - y0) / self.scale) for x, y in self.vertices]).reshape(-1, 2)

    @cached_property
    def core(self) -> dict[str, Any]:
        """Arguments of ``_core.Shape``: the arrays, with an identity for every feature."""
        return core_arrays(self)

    @property
    def v(self) -> NDArray[np.int32]:
        return self.core["v"]  # type: ignore[no-any-return]

    @property
    def w(self) -> NDArray[np.int32]:
        return self.core["w"]  # type: ignore[no-any-return]

    @property
    def previous(self) -> NDArray[np.int32]:
        return self.core["previous"]  # type: ignore[no-any-return]

    @cached_property
    def owner_polygon(self) -> NDArray[np.int32]:
        return np.array(self.rings["owner_polygon"], np.int32)

    @cached_property
    def owner_vertex(self) -> NDArray[np.int32]:
        return np.array(self.rings["owner_vertex"], np.int32)


@dataclass(frozen=True)
class SceneFeatures:
    """Features of the robot and of the obstacles.

    Attributes
    ----------
    scale : int
        Common denominator of all coordinates.
    rim : (xmin, ymin, xmax, ymax) or None
        If bounds or a workspace are given: a rectangle around all patches.
    """

    robot: ShapeFeatures
    obstacles: ShapeFeatures
    scale: int
    rim: tuple[float, float, float, float] | None

    @cached_property
    def core(self) -> _core.Scene:
        """Return the same features in the core; objects made of the scene there share them."""
        a, b = self.robot, self.obstacles
        shapes = _core.Shape(**a.core), _core.Shape(**b.core)
        return _core.Scene(*shapes, self.scale, a.shift, self.rim is not None, a.origin, b.origin, a.near_shift)

    @cached_property
    def frame(self) -> tuple[float, float, float, float]:
        """Origins of the obstacles and of the robot: shapes near by have doubles from these."""
        (x, y), (a, b) = self.obstacles.origin, self.robot.origin
        return x / self.scale, y / self.scale, a / self.scale, b / self.scale


def scene_features(scene: Scene) -> SceneFeatures:
    """Number everything in a scene that the core needs."""
    polygons = [*scene.robot, *scene.obstacles, *([scene.workspace] if scene.workspace else [])]
    numbers = [p.denominator for p in polygons] + [b.denominator for b in scene.bounds or ()]
    scale = math.lcm(*numbers)
    robot, obstacles = ShapeFeatures(scale), ShapeFeatures(scale)
    for k, polygon in enumerate(scene.robot):
        robot.add_polygon(polygon, BODY, k)
    for k, polygon in enumerate(scene.obstacles):
        obstacles.add_polygon(polygon, BODY, k)
    if scene.workspace is not None:
        factor = scale // scene.workspace.denominator
        corners = [(x * factor, y * factor) for x, y in scene.workspace.numerators]
        offsets = scene.workspace.ring_offsets
        rings = [dict(zip(corners[i:j], range(i, j), strict=True)) for i, j in pairwise(offsets)]
        edges = [int(b * scale) for b in scene.bounds or ()]
        around = box([*corners, *obstacles.vertices, *zip(edges[::2], edges[1::2], strict=True)])
        parts = complement(rings, box(robot.vertices), around, scale)
        for part, ring in zip(parts, rings, strict=True):
            # the frame's rim stands for infinity, and has no owner
            named = ring if part is not parts[0] else defaultdict(lambda: -1, ring)
            obstacles.add_polygon(part, BODY, WORKSPACE, emit_outer=part is not parts[0], owner_vertex=named)
    rim = None
    if scene.bounds is not None or scene.workspace is not None:
        reach = sum(max(abs(c) for c in axis) for axis in zip(*robot.vertices, strict=True))
        bounds = [int(b * scale) for b in scene.bounds or ()]
        around = box([*obstacles.vertices, *zip(bounds[::2], bounds[1::2], strict=True)])
        step = coarse_step(around, scale)  # so that doubles resolve the difference
        outer = outwards(around, reach + step, step)
        rim = (outer[0] / scale, outer[1] / scale, outer[2] / scale, outer[3] / scale)
        if bounds:
            add_bounds(robot, obstacles, bounds, outer)
    widest = max((abs(c) for p in robot.vertices + obstacles.vertices for c in p), default=0)
    robot.shift = obstacles.shift = max(0, widest.bit_length() - LARGEST_BITS)
    shapes = robot, obstacles
    for shape in shapes:
        shape.origin = place_near(shape.vertices, scale)
    widest = max((abs(c - o) for s in shapes for p in s.vertices for c, o in zip(p, s.origin, strict=True)), default=0)
    robot.near_shift = obstacles.near_shift = max(0, widest.bit_length() - LARGEST_BITS)
    return SceneFeatures(robot, obstacles, scale, rim)


def complement(rings: Sequence[Iterable[Point]], robot: Box, around: Box, scale: int) -> list[Polygon]:
    """Polygons that the robot must stay out of: a frame around the workspace, thicker than the robot, and its holes."""
    thickness = 1 + 2 * sum(map(abs, robot))
    frame = rectangle(*outwards(around, thickness, coarse_step(around, scale)))

    def exact(ring: Iterable[Point]) -> list[tuple[Fraction, Fraction]]:
        return [(Fraction(x, scale), Fraction(y, scale)) for x, y in ring]

    outer, *holes = map(exact, rings)
    return [Polygon(exact(frame), [outer]), *map(Polygon, holes)]


def box(points: Sequence[Point]) -> Box:
    xs, ys = zip(*points, strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def place_near(points: Sequence[Point], scale: int) -> Point:
    """The middle of points that are far away, on a coarse grid; else 0."""
    if not points:
        return 0, 0
    x0, y0, x1, y1 = around = box(points)
    size = max(x1 - x0, y1 - y0)
    if max(map(abs, around)) <= FAR * size:
        return 0, 0
    step = coarse_step(around, scale)
    return (x0 + x1) // (2 * step) * step, (y0 + y1) // (2 * step) * step


def coarse_step(around: Box, scale: int) -> int:
    """Return the least power of two, in units of the user, of an eighth of the size or more, if it is an integer."""
    x0, y0, x1, y1 = around
    step = scale // (scale & -scale)
    while 8 * step < max(x1 - x0, y1 - y0):
        step *= 2
    return step


def outwards(around: Box, margin: int, step: int) -> Box:
    """Return a box with a margin, then outwards to multiples of a step."""
    x0, y0, x1, y1 = around
    low = [(c - margin) // step * step for c in (x0, y0)]
    high = [-((-c - margin) // step) * step for c in (x1, y1)]
    return low[0], low[1], high[0], high[1]


def rectangle(x0: int, y0: int, x1: int, y1: int) -> list[Point]:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def add_bounds(robot: ShapeFeatures, obstacles: ShapeFeatures, bounds: Sequence[int], outer: Sequence[int]) -> None:
    """Add the reference point and the complement of the bounds: overlapping rectangles that reach past every pillar."""
    common: dict[str, list[Any]] = {"layer": [REFERENCE], "emit": [True], "owner_polygon": [BOUNDS]}
    robot.add_ring([(0, 0)], convex=[True], owner_vertex=[0], **common)
    robot.add_piece([len(robot.vertices) - 1], REFERENCE)
    (x0, y0, x1, y1), (X0, Y0, X1, Y1) = bounds, outer
    inner = [(x0, y0), (x0, y1), (x1, y1), (x1, y0)]  # a hole: clockwise
    columns = {name: values * 4 for name, values in common.items()}
    obstacles.add_ring(inner, convex=[False] * 4, owner_vertex=[0, 1, 2, 3], **columns)
    for side in ((X0, Y0, x0, Y1), (x1, Y0, X1, Y1), (X0, Y0, X1, y0), (X0, y1, X1, Y1)):
        first = len(obstacles.vertices)
        obstacles.vertices.extend(rectangle(*side))
        obstacles.add_piece(list(range(first, first + 4)), REFERENCE)


def classes(keys: Iterable[Any]) -> list[int]:
    """Number equal keys alike, in order of appearance."""
    seen: dict[Any, int] = {}
    return [seen.setdefault(key, len(seen)) for key in keys]


def ranks(group: Sequence[int], keys: Sequence[Any]) -> list[int]:
    """Place of each item among those of its group, by key; most groups have one member."""
    members: dict[int, list[int]] = {}
    for item, g in enumerate(group[: len(keys)]):
        members.setdefault(g, []).append(item)
    rank = [0] * len(keys)
    for items in members.values():
        if len(items) > 1:
            for place, item in enumerate(sorted(items, key=lambda k: (keys[k], k))):
                rank[item] = place
    return rank


def core_arrays(shape: ShapeFeatures) -> dict[str, Any]:
    """Arguments of ``_core.Shape``, with the identities of all features."""
    edges = list(shape.edges)
    numbers = {edge: k for k, edge in enumerate(edges)}
    piece_edges = []
    for piece in shape.pieces:
        ring = zip(piece, piece[1:] + piece[:1], strict=True) if len(piece) > 1 else ((piece[0], piece[0]),)
        for edge in ring:
            if edge not in numbers:
                numbers[edge] = len(edges)
                edges.append(edge)
            piece_edges.append(numbers[edge])
    vertices, previous = shape.vertices, shape.rings["previous"]
    lines, directions = [], []
    for v, w in edges:
        (x, y), (x2, y2) = vertices[v], vertices[w]
        dx, dy = x2 - x, y2 - y
        divisor = math.gcd(dx, dy) or 1
        dx, dy = dx // divisor, dy // divisor
        lines.append((dx, dy, dx * y - dy * x) if dx or dy else (v,))
        directions.append((dx, dy) if (dx, dy) > (0, 0) else (-dx, -dy))
    point, line = classes(vertices), classes(lines)
    # geometry, not numbering, decides the owner of coincident features
    ends = [(vertices[v], vertices[w]) for v, w in edges[: len(previous)]]
    around = [(w, vertices[p]) for (_, w), p in zip(ends, previous, strict=True)]
    ints = {
        "point": point,
        "v": [v for v, _ in edges],
        "w": [w for _, w in edges],
        "line": line,
        "direction": classes(directions),
        "previous": previous,
        "layer": shape.rings["layer"],
        "vertex_rank": ranks(point, around),
        "edge_rank": ranks(line, ends),
        "piece": np.cumsum([0, *map(len, shape.pieces)]),
        "piece_vertex": [v for piece in shape.pieces for v in piece],
        "piece_edge": piece_edges,
        "piece_layer": shape.piece_layer,
    }
    arrays: dict[str, Any] = {name: np.array(column, np.int32) for name, column in ints.items()}
    arrays |= {name: np.array(shape.rings[name], np.int8) for name in ("convex", "emit")}
    scalars = {"shift": shape.shift, "scale": shape.scale, "ring_vertices": len(previous)}
    return arrays | scalars | {"vertices": vertices}
