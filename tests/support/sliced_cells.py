"""Cells of an arrangement from slices, in doubles: the planar part between two critical angles does not change.

At each orientation the sums of obstacles and turned, mirrored robot parts, triangle by triangle, are overlaid by
shapely. A planar cell is followed from slice to slice by the edges around it, and across a critical angle by its
overlap with the cells beyond. It shares nothing with the package but the critical angles. These are found to be
complete: without one of them the slices to its sides would differ.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import pairwise, product
from typing import Any, NamedTuple

import shapely

from shapes import PlainScene, Shape

NEAR = 5e-6  # distance of the neighbours of a critical angle from it
THIN = 5e-5  # narrower parts at it are not counted
SLIVER, ROUNDED = 1e-13, 1e-10


class Planar(NamedTuple):
    """A planar cell: the pairs that hold it, and the edges around it."""

    pairs: frozenset[tuple[int, int]]
    edges: frozenset[Any]
    region: shapely.Polygon

    @property
    def euler(self) -> int:
        """Euler number of the open region: a hole that touches the rim in a point is none."""
        return _euler(shapely.buffer(self.region, -ROUNDED))


class Unclear(Exception):
    """A case too close for doubles."""


def sliced_cells(plain: PlainScene, angles: Sequence[float]) -> Counter[tuple[frozenset[tuple[int, int]], int]]:
    """Numbers of cells, by the pairs that hold them and their Euler characteristic, except for the outer one.

    A cell is made of prisms over planar cells, which meet in planar regions at critical angles: its characteristic is
    that of the former minus that of the latter.
    """
    ends = sorted({a % math.tau for a in angles})
    ends = [a for k, a in enumerate(ends) if k == 0 or a - ends[k - 1] > 1e-9]
    gaps = [b - a for a, b in pairwise([*ends, ends[0] + math.tau])]
    if min(gaps) < 20 * NEAR:
        raise Unclear
    slabs = []
    for a, gap in zip(ends, gaps, strict=True):
        first, middle, last = (overlay(plain, a + x) for x in (NEAR, gap / 2, gap - NEAR))
        slabs.append((middle, _matched(first, middle), _matched(last, middle)))
    number = [[(k, m) for m in range(len(slab[0]))] for k, slab in enumerate(slabs)]
    parent = {x: x for row in number for x in row}

    def root(x: tuple[int, int]) -> tuple[int, int]:
        while parent[x] != x:
            x = parent[x]
        return x

    meetings = []
    for k, (_, _, below) in enumerate(slabs):
        above = slabs[(k + 1) % len(slabs)][1]
        for cell, m in below:
            for other, n in above:
                if cell.pairs == other.pairs and (meeting := _common(cell.region, other.region)) is not None:
                    meetings.append(((k, m), meeting))
                    parent[root((k, m))] = root(((k + 1) % len(slabs), n))
    euler: Counter[tuple[int, int]] = Counter()
    for k, (middle, _, _) in enumerate(slabs):
        for m, cell in enumerate(middle):
            euler[root((k, m))] += cell.euler
    for node, meeting in meetings:
        euler[root(node)] -= meeting
    pairs = {root((k, m)): cell.pairs for k, slab in enumerate(slabs) for m, cell in enumerate(slab[0])}
    outer = {root((k, m)) for k, slab in enumerate(slabs) for m, cell in enumerate(slab[0]) if not cell.edges}
    return Counter((pairs[x], euler[x]) for x in pairs if x not in outer)


def overlay(plain: PlainScene, theta: float) -> list[Planar]:
    """Planar cells at an orientation; the outer one has no edges."""
    sums: dict[tuple[int, int], list[shapely.Geometry]] = {}
    names, sides = [], []
    for pair, ring in _sums(plain, theta):
        points = [point for point, _ in ring]
        sums.setdefault(pair, []).append(shapely.Polygon(points))
        for (p, first), (q, second) in pairwise([*ring, ring[0]]):
            names.append((pair, first, second))
            sides.append(shapely.LineString([p, q]))
    forbidden = {pair: shapely.union_all(parts) for pair, parts in sums.items()}
    box = shapely.box(*shapely.buffer(shapely.union_all(list(forbidden.values())), 1).bounds)
    regions = [(frozenset[tuple[int, int]](), box)]
    for pair, solid in forbidden.items():
        parts = [(pairs | {pair}, region & solid) for pairs, region in regions] + [
            (pairs, region - solid) for pairs, region in regions
        ]
        regions = [(pairs, part) for pairs, whole in parts for part in _polygons(whole)]
    tree = shapely.STRtree(sides)
    cells = []
    for pairs, region in regions:
        edges = set()
        for ring in (region.exterior, *region.interiors):
            for p, q in pairwise(ring.coords):
                middle = shapely.Point((p[0] + q[0]) / 2, (p[1] + q[1]) / 2)
                edges |= {names[k] for k in tree.query(middle, predicate="dwithin", distance=1e-10)}
        outer = region.exterior.distance(box.exterior) == 0
        cells.append(Planar(pairs, frozenset() if outer else frozenset(edges), region))
    return cells


def _sums(plain: PlainScene, theta: float) -> Iterator[tuple[tuple[int, int], list[Any]]]:
    """Convex polygons whose union a pair forbids: points, and the vertices that they are sums of."""
    c, s = math.cos(theta), math.sin(theta)
    for (i, robot), (j, obstacle) in product(enumerate(plain.robot), enumerate(plain.obstacles)):
        for part, piece in product(_triangles(robot), _triangles(obstacle)):
            turned = [((x, y), (c * x - s * y, s * x + c * y)) for x, y in part]
            points = {(x - a, y - b): (v, (x, y)) for x, y in piece for v, (a, b) in turned}
            hull = shapely.orient_polygons(shapely.convex_hull(shapely.MultiPoint(list(points))))
            yield (i, j), [(point, points[point]) for point in hull.exterior.coords[:-1]]


@cache
def _cut(outer: tuple[Any, ...], holes: tuple[tuple[Any, ...], ...]) -> list[list[tuple[float, float]]]:
    polygon = shapely.Polygon(outer, holes)
    if polygon.equals(shapely.convex_hull(polygon)):
        return [list(polygon.exterior.coords)[:-1]]
    return [list(part.exterior.coords)[:-1] for part in shapely.constrained_delaunay_triangles(polygon).geoms]


def _triangles(shape: Shape) -> list[list[tuple[float, float]]]:
    outer, *holes = (tuple((float(x), float(y)) for x, y in ring) for ring in (shape[0], *shape[1]))
    return _cut(outer, tuple(holes))


def _polygons(region: shapely.Geometry) -> list[shapely.Polygon]:
    return [p for p in shapely.get_parts(region) if isinstance(p, shapely.Polygon) and p.area > SLIVER]


def _matched(cells: list[Planar], others: list[Planar]) -> list[tuple[Planar, int]]:
    """Each planar cell with the number of the same one in another slice of the slab."""
    names = Counter((cell.pairs, len(cell.edges), cell.euler) for cell in cells)
    if names != Counter((cell.pairs, len(cell.edges), cell.euler) for cell in others):
        raise Unclear
    free, result = set(range(len(others))), []
    for cell in cells:
        alike = [k for k in free if others[k].pairs == cell.pairs and len(others[k].edges) == len(cell.edges)]
        alike = [k for k in alike if others[k].euler == cell.euler]
        best = max(alike, key=lambda k: (len(others[k].edges & cell.edges), (others[k].region & cell.region).area))
        free.remove(best)
        result.append((cell, best))
    return result


def _common(one: shapely.Polygon, other: shapely.Polygon) -> int | None:
    """Euler characteristic of the overlap of two planar cells, None if there is none."""
    if not one.intersects(other):
        return None
    meeting = shapely.buffer(one & other, -THIN)
    return None if meeting.is_empty else _euler(meeting)


def _euler(region: shapely.Geometry) -> int:
    return sum(1 - len(part.interiors) for part in shapely.get_parts(region))
