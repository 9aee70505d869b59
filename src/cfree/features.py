"""The scene as the core takes it: integer coordinates, and an identity for every feature.

Coordinates are multiplied by one common denominator. Coincident vertices get one *point*, directed edges on one line with
one direction one *line*, parallel edges one *direction*: equality of features is settled here, exactly, once. The core then
names curves and critical angles by these, and most ties need no arithmetic.

Two layers meet only themselves: the robot's polygons with the obstacles (and the complement of `workspace`), and the robot's
reference point, as a shape of its own, with the complement of `bounds`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cfree.polygon import Polygon

if TYPE_CHECKING:
    from cfree.scene import Scene

Point = tuple[int, int]
BODY, REFERENCE = 0, 1  # layers


@dataclass(frozen=True, slots=True)
class Owner:
    """Where a ring vertex comes from: polygon and vertex of the user's robot or obstacle."""

    polygon: int  # index into robot or obstacles; -1 reference point or bounds, -2 workspace
    vertex: int


BOUNDS, WORKSPACE = -1, -2


@dataclass(slots=True)
class ShapeFeatures:
    """Flat arrays of the robot or of the obstacles; see ``cpp/include/cfree/scene.hpp``."""

    vertices: list[Point] = field(default_factory=list)
    edges: list[tuple[int, int]] = field(default_factory=list)
    previous: list[int] = field(default_factory=list)
    convex: list[bool] = field(default_factory=list)
    emit: list[bool] = field(default_factory=list)
    layer: list[int] = field(default_factory=list)
    owners: list[Owner] = field(default_factory=list)
    pieces: list[list[int]] = field(default_factory=list)  # vertices
    piece_layer: list[int] = field(default_factory=list)

    def add_ring(
        self, ring: Sequence[Point], convex: Sequence[bool], layer: int, owners: Iterable[Owner], emit: bool
    ) -> None:
        first, n = len(self.vertices), len(ring)
        self.vertices.extend(ring)
        self.edges.extend((first + k, first + (k + 1) % n) for k in range(n))
        self.previous.extend(first + (k - 1) % n for k in range(n))
        self.convex.extend(convex)
        self.emit.extend([emit] * n)
        self.layer.extend([layer] * n)
        self.owners.extend(owners)

    def add_polygon(self, polygon: Polygon, scale: int, layer: int, index: int, emit_outer: bool = True) -> None:
        factor, first = scale // polygon.denominator, len(self.vertices)
        points = [(x * factor, y * factor) for x, y in polygon.numerators]
        convex = polygon.convex.tolist()
        offsets = polygon.ring_offsets
        for ring, (i, j) in enumerate(zip(offsets, offsets[1:], strict=False)):
            owners = (Owner(index, v) for v in range(i, j))
            self.add_ring(points[i:j], convex[i:j], layer, owners, emit_outer or ring > 0)
        for piece in polygon.pieces:
            self.pieces.append([first + v for v in piece])
            self.piece_layer.append(layer)


def scene_features(scene: Scene) -> tuple[ShapeFeatures, ShapeFeatures, int]:
    """Features of the robot and of the obstacles, and the denominator of their coordinates."""
    polygons = [*scene.robot, *scene.obstacles, *([scene.workspace] if scene.workspace else [])]
    numbers = [p.denominator for p in polygons] + [b.denominator for b in scene.bounds or ()]
    scale = math.lcm(*numbers)
    robot, obstacles = ShapeFeatures(), ShapeFeatures()
    for k, polygon in enumerate(scene.robot):
        robot.add_polygon(polygon, scale, BODY, k)
    for k, polygon in enumerate(scene.obstacles):
        obstacles.add_polygon(polygon, scale, BODY, k)
    if scene.workspace is not None:
        for polygon in complement(scene.workspace, robot.vertices, obstacles.vertices, scale):
            obstacles.add_polygon(polygon, scale, BODY, WORKSPACE, emit_outer=not polygon_is_frame(polygon))
    if scene.bounds is not None:
        robot.add_ring([(0, 0)], [True], REFERENCE, [Owner(BOUNDS, 0)], True)
        robot.pieces.append([len(robot.vertices) - 1])
        robot.piece_layer.append(REFERENCE)
        add_bounds(obstacles, robot, tuple(int(b * scale) for b in scene.bounds))
    return robot, obstacles, scale


def polygon_is_frame(polygon: Polygon) -> bool:
    return len(polygon.ring_offsets) > 2


def complement(workspace: Polygon, robot: list[Point], obstacles: list[Point], scale: int) -> list[Polygon]:
    """What the robot must stay out of: a frame around the workspace, thicker than the robot, and the workspace's holes."""
    factor = scale // workspace.denominator
    points = [(x * factor, y * factor) for x, y in workspace.numerators]
    offsets = workspace.ring_offsets
    rings = [points[i:j] for i, j in zip(offsets, offsets[1:], strict=False)]
    thickness = 1 + 2 * sum(max(abs(c) for c in axis) for axis in zip(*robot, strict=True))
    frame = rectangle(*(side * thickness + at for side, at in zip((-1, -1, 1, 1), box(points + obstacles), strict=True)))
    from fractions import Fraction

    def exact(ring: list[Point]) -> list[tuple[Fraction, Fraction]]:
        return [(Fraction(x, scale), Fraction(y, scale)) for x, y in ring]

    return [Polygon(exact(frame), [exact(rings[0])]), *(Polygon(exact(ring)) for ring in rings[1:])]


def box(points: Sequence[Point]) -> tuple[int, int, int, int]:
    xs, ys = zip(*points, strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def rectangle(x0: int, y0: int, x1: int, y1: int) -> list[Point]:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def add_bounds(obstacles: ShapeFeatures, robot: ShapeFeatures, bounds: tuple[int, ...]) -> None:
    """The complement of the bounds: four overlapping rectangles, wide enough to hold every pillar that leaves the bounds."""
    x0, y0, x1, y1 = bounds
    reach = 1 + sum(max(abs(c) for c in axis) for axis in zip(*robot.vertices, strict=True))
    points = [*rectangle(x0, y0, x1, y1), *obstacles.vertices]
    X0, Y0, X1, Y1 = (at + side * reach for side, at in zip((-1, -1, 1, 1), box(points), strict=True))
    inner = [(x0, y0), (x0, y1), (x1, y1), (x1, y0)]  # a hole: clockwise
    obstacles.add_ring(inner, [False] * 4, REFERENCE, (Owner(BOUNDS, k) for k in range(4)), True)
    for side in ((X0, Y0, x0, Y1), (x1, Y0, X1, Y1), (X0, Y0, X1, y0), (X0, y1, X1, Y1)):
        first = len(obstacles.vertices)
        obstacles.vertices.extend(rectangle(*side))
        obstacles.pieces.append(list(range(first, first + 4)))
        obstacles.piece_layer.append(REFERENCE)


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


def limbs(points: Sequence[Point]) -> NDArray[np.int64]:
    """Coordinates as two's complement 64-bit limbs, least first: (n, 2, limbs)."""
    widest = max((max(x.bit_length(), y.bit_length()) for x, y in points), default=0)
    count = widest // 64 + 1
    data = b"".join(c.to_bytes(8 * count, "little", signed=True) for p in points for c in p)
    return np.frombuffer(data, np.int64).reshape(len(points), 2, count)


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
    vertices, ring_vertices = shape.vertices, len(shape.previous)
    lines, directions = [], []
    for v, w in edges:
        (x, y), (x2, y2) = vertices[v], vertices[w]
        dx, dy = x2 - x, y2 - y
        divisor = math.gcd(dx, dy) or 1
        dx, dy = dx // divisor, dy // divisor
        lines.append((dx, dy, dx * y - dy * x) if dx or dy else (v,))
        directions.append((dx, dy) if (dx, dy) > (0, 0) else (-dx, -dy))
    point, line = classes(vertices), classes(lines)
    around = [
        (vertices[edges[v][1]], vertices[shape.previous[v]]) for v in range(ring_vertices)
    ]  # geometry, not numbering, decides who owns what coincides
    ends = [(vertices[v], vertices[w]) for v, w in edges[:ring_vertices]]
    ints = {
        "point": point,
        "v": [v for v, _ in edges],
        "w": [w for _, w in edges],
        "line": line,
        "direction": classes(directions),
        "previous": shape.previous,
        "layer": shape.layer,
        "vertex_rank": ranks(point, around),
        "edge_rank": ranks(line, ends),
        "piece": np.cumsum([0, *map(len, shape.pieces)]),
        "piece_vertex": [v for piece in shape.pieces for v in piece],
        "piece_edge": piece_edges,
        "piece_layer": shape.piece_layer,
    }
    arrays: dict[str, Any] = {name: np.array(column, np.int32) for name, column in ints.items()}
    arrays |= {name: np.array(getattr(shape, name), np.int8) for name in ("convex", "emit")}
    return arrays | {"coordinates": limbs(vertices), "ring_vertices": ring_vertices}
