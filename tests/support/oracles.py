"""Slow answers that share no algorithm with the package: pairwise hulls, area of overlap, separating axes.

Everything here takes plain coordinates, so that a mistake in the package cannot hide itself:

    polygon = (outer, holes)            rings are sequences of points, in any orientation
    robot, obstacles = [polygon, ...]   the robot's reference point is the origin of its own coordinates
    pose = (x, y, theta)                floats; exact functions take Fractions x, y and tau = tan(theta/2)
                                        instead, tau = None meaning the half turn

Floating-point answers come from shapely and are good to about 1e-12 of the scene's size. They describe the
CLOSURE of the forbidden region: a slit as wide as the robot is invisible to them. The answers named `exact`
hold on the boundary too, where the pose is free because C_forb is open.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
import shapely

Ring = Sequence[Any]
Polygon = tuple[Ring, Sequence[Ring]]
ExactPoint = tuple[Fraction, Fraction]
ExactRing = tuple[ExactPoint, ...]
Box = tuple[Any, Any, Any, Any]


class AtALoss(Exception):
    """A floating-point answer that would not be the scene's."""


# --- floating point, by shapely ---


def forbidden_slice(
    robot: Sequence[Polygon],
    obstacles: Sequence[Polygon],
    theta: float,
    bounds: Box | None = None,
    workspace: Polygon | None = None,
) -> shapely.Geometry:
    """Forbidden places of the reference point at one theta: the union of O_k (+) -R A_p over convex pieces.

    With `bounds` or `workspace` the true region has no end; it is then given up to the rim of `window`.
    """
    radius = robot_radius(robot)
    walls = [*obstacles, *(complement(workspace, 3 * radius) if workspace else [])]
    sums = pairwise_sums(robot, walls, theta)
    if bounds is None and workspace is None:
        return _union(sums)
    rim = window(robot, obstacles, bounds, workspace)
    frames = [rim.difference(shapely.box(*map(float, bounds)))] if bounds else []
    if workspace:  # beyond this box no point of the robot is inside the workspace
        frames.append(rim.difference(shapely.box(*enlarged(box_of([workspace]), 1.5 * radius))))
    return rim.intersection(_union([*sums, *frames]))


def _union(shapes: Sequence[shapely.Geometry]) -> shapely.Geometry:
    """Unite once more on a fine grid: rarely, rounding takes one of its holes from a union of needles."""
    union = shapely.union_all(shapes)
    size = np.fmax.reduce(np.abs(union.bounds), initial=1)
    if abs(union.area - shapely.union_all(shapes, grid_size=2.0**-40 * size).area) > 1e-9 * size**2:
        raise AtALoss("two unions of the same polygons differ")
    return union


def free_slice(
    robot: Sequence[Polygon],
    obstacles: Sequence[Polygon],
    theta: float,
    bounds: Box | None = None,
    workspace: Polygon | None = None,
) -> shapely.Geometry:
    """The window without the forbidden region; bounded by `bounds` or `workspace` where given."""
    rim = window(robot, obstacles, bounds, workspace)
    return rim.difference(forbidden_slice(robot, obstacles, theta, bounds, workspace))


def window(
    robot: Sequence[Polygon],
    obstacles: Sequence[Polygon],
    bounds: Box | None = None,
    workspace: Polygon | None = None,
) -> shapely.Polygon:
    """A box well beyond every forbidden region of the obstacles, bounds and workspace, at any theta."""
    boxes = [box_of([polygon]) for polygon in [*obstacles, *([workspace] if workspace else [])]]
    boxes += [tuple(map(float, bounds))] if bounds else []
    lows = np.min([box[:2] for box in boxes] or [(0, 0)], axis=0)
    highs = np.max([box[2:] for box in boxes] or [(0, 0)], axis=0)
    return shapely.box(*enlarged((*lows, *highs), 4 * robot_radius(robot)))


def overlap_area(robot: Sequence[Polygon], obstacles: Sequence[Polygon], pose: Sequence[float]) -> float:
    """Area of the intersection of the placed robot with the obstacles."""
    placed, walls = _placed(robot, pose), _shapely(_floats(obstacles))
    return sum(float(shapely.area(shapely.intersection(part, walls)).sum()) for part in placed)


def overlaps(robot: Sequence[Polygon], obstacles: Sequence[Polygon], pose: Sequence[float]) -> bool:
    """True if the interiors intersect. This is for poses off contact; on contact use `exact_overlaps`."""
    return overlap_area(robot, obstacles, pose) > 0


def boundary_contact_distance(
    robot: Sequence[Polygon],
    obstacles: Sequence[Polygon],
    pose: Sequence[float],
    bounds: Box | None = None,
    workspace: Polygon | None = None,
) -> float:
    """Least distance between rings of the placed robot and of the obstacles: 0 at a (pseudo) contact.

    `workspace` counts as one more set of rings; the rim of `bounds` is measured from the reference point.
    """
    walls = shapely.boundary(_shapely(_floats([*obstacles, *([workspace] if workspace else [])])))
    rings = [shapely.boundary(part) for part in _placed(robot, pose)]
    distances = [float(d) for ring in rings for d in shapely.distance(ring, walls)]
    if bounds:
        rim = shapely.box(*map(float, bounds)).exterior
        distances.append(shapely.distance(rim, shapely.Point(pose[0], pose[1])))
    return min(distances, default=math.inf)


def pairwise_sums(robot: Sequence[Polygon], obstacles: Sequence[Polygon], theta: float) -> list[shapely.Geometry]:
    """Convex hulls of the vertex sums O_k (+) -R A_p, one for each pair of convex pieces."""
    c, s = math.cos(theta), math.sin(theta)
    turned = [-piece @ np.array([[c, s], [-s, c]]) for piece in convex_pieces(robot)]
    by_size: dict[int, list[np.ndarray]] = {}
    for piece in convex_pieces(obstacles):
        by_size.setdefault(len(piece), []).append(piece)
    sums: list[shapely.Geometry] = []
    for size, pieces in by_size.items():
        stack = np.array(pieces)
        for part in turned:
            points = (stack[:, :, None, :] + part[None, None, :, :]).reshape(-1, 2)
            owner = np.repeat(np.arange(len(stack)), size * len(part))
            sums += list(shapely.convex_hull(shapely.multipoints(points, indices=owner)))
    return sums


def convex_pieces(polygons: Sequence[Polygon]) -> list[np.ndarray]:
    """Convex polygons as they are, the others as triangles: arrays (k, 2), counter-clockwise."""
    return [np.array(piece) for polygon in _floats(polygons) for piece in _convex_pieces(polygon)]


def complement(workspace: Polygon, margin: float) -> list[Polygon]:
    """The outside of `workspace` as obstacles: a frame `margin` wide about its box, and its holes filled."""
    outer, holes = workspace
    x0, y0, x1, y1 = enlarged(box_of([workspace]), math.ceil(margin))
    x0, y0, x1, y1 = math.floor(x0), math.floor(y0), math.ceil(x1), math.ceil(y1)
    return [([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], [outer]), *((hole, []) for hole in holes)]


def robot_radius(robot: Sequence[Polygon]) -> float:
    """Greatest distance of a robot vertex from the reference point."""
    return max(math.hypot(float(x), float(y)) for outer, _ in robot for x, y in outer)


def box_of(polygons: Sequence[Polygon]) -> tuple[float, float, float, float]:
    points = np.array([(float(x), float(y)) for outer, _ in polygons for x, y in outer])
    return (*points.min(axis=0).tolist(), *points.max(axis=0).tolist())


def enlarged(box: Box, margin: float) -> tuple[float, float, float, float]:
    x0, y0, x1, y1 = box
    return x0 - margin, y0 - margin, x1 + margin, y1 + margin


# --- exact, by rational arithmetic ---


@lru_cache(maxsize=10_000)
def exact_rotation(tau: Fraction | None) -> tuple[Fraction, Fraction]:
    """Cosine and sine of 2 atan(tau); None is the half turn."""
    if tau is None:
        return Fraction(-1), Fraction(0)
    tau = Fraction(tau)
    return (1 - tau * tau) / (1 + tau * tau), 2 * tau / (1 + tau * tau)


def exact_place(ring: Iterable[Any], x: Fraction, y: Fraction, tau: Fraction | None) -> ExactRing:
    c, s = exact_rotation(tau)
    points = ((Fraction(u), Fraction(v)) for u, v in ring)
    return tuple((x + c * u - s * v, y + s * u + c * v) for u, v in points)


def exact_hulls(
    robot: Sequence[Polygon],
    obstacles: Sequence[Polygon],
    tau: Fraction | None,
    workspace: Polygon | None = None,
) -> list[ExactRing]:
    """Hulls of the sums O_k (+) -R A_p over triangles; C_forb at tau is the union of their INTERIORS.

    With `workspace` that holds for reference points within the robot's radius of the workspace's box.
    """
    walls = [*obstacles, *(complement(workspace, 3 * robot_radius(robot)) if workspace else [])]
    parts = [exact_place(part, Fraction(0), Fraction(0), tau) for part in exact_triangles(robot)]
    return [
        exact_hull((bx - ax, by - ay) for bx, by in wall for ax, ay in part)
        for wall in exact_triangles(walls)
        for part in parts
    ]


def in_some_hull(point: Sequence[Any], hulls: Iterable[ExactRing]) -> bool:
    """True if the rational point is strictly inside one of the convex counter-clockwise rings."""
    p = (Fraction(point[0]), Fraction(point[1]))
    return any(all(orient(a, b, p) > 0 for a, b in edges(hull)) for hull in hulls)


def exact_overlaps(
    robot: Sequence[Polygon], obstacles: Sequence[Polygon], x: Any, y: Any, tau: Fraction | None
) -> bool:
    """True if the interiors intersect, by separating axes on pairs of triangles; holds also at contact."""
    parts = [exact_place(part, Fraction(x), Fraction(y), tau) for part in exact_triangles(robot)]
    x0, y0, x1, y1 = exact_box(point for part in parts for point in part)
    for wall in exact_triangles(obstacles):
        u0, v0, u1, v1 = exact_box(wall)
        if u0 < x1 and x0 < u1 and v0 < y1 and y0 < v1 and any(interiors_meet(part, wall) for part in parts):
            return True
    return False


def exact_is_forbidden(
    robot: Sequence[Polygon],
    obstacles: Sequence[Polygon],
    x: Any,
    y: Any,
    tau: Fraction | None,
    bounds: Box | None = None,
    workspace: Polygon | None = None,
) -> bool:
    """True if the pose is in C_forb: an obstacle or the outside of the workspace overlapped, or the bounds left."""
    x, y = Fraction(x), Fraction(y)
    if bounds:
        x0, y0, x1, y1 = map(Fraction, bounds)
        if not (x0 <= x <= x1 and y0 <= y <= y1):
            return True
    walls = list(obstacles)
    if workspace:
        radius = robot_radius(robot)
        x0, y0, x1, y1 = map(Fraction, enlarged(box_of([workspace]), 1.5 * radius))
        if not (x0 <= x <= x1 and y0 <= y <= y1):
            return True
        walls += complement(workspace, 3 * radius)
    return exact_overlaps(robot, walls, x, y, tau)


def exact_triangles(polygons: Sequence[Polygon]) -> list[ExactRing]:
    """Counter-clockwise triangles that tile the polygons exactly.

    Shapely proposes them on rounded vertices. They are taken if the exact ones prove that they tile: every triangle
    is positive, every ring edge is used once, every diagonal once in each direction. Else they are computed exactly.
    """
    return [triangle for polygon in polygons for triangle in _exact_triangles(_fractions(polygon))]


def exact_area(polygons: Sequence[Polygon]) -> Fraction:
    """Sum of the areas without holes; overlaps count twice."""
    total = Fraction()
    for outer, holes in map(_fractions, polygons):
        total += abs(ring_area(outer)) - sum(abs(ring_area(hole)) for hole in holes)
    return total


def exact_hull(points: Iterable[ExactPoint]) -> ExactRing:
    """Vertices of the convex hull, counter-clockwise, none collinear (Andrew's monotone chain)."""
    ordered = sorted(set(points))
    chains: list[list[ExactPoint]] = []
    for run in (ordered, ordered[::-1]):
        chain: list[ExactPoint] = []
        for p in run:
            while len(chain) > 1 and orient(chain[-2], chain[-1], p) <= 0:
                chain.pop()
            chain.append(p)
        chains.append(chain[:-1])
    return tuple(chains[0] + chains[1])


def exact_box(points: Iterable[ExactPoint]) -> tuple[Fraction, Fraction, Fraction, Fraction]:
    xs, ys = zip(*points, strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def interiors_meet(first: ExactRing, second: ExactRing) -> bool:
    """True if the interiors of two convex counter-clockwise rings intersect."""
    for one, other in ((first, second), (second, first)):
        if any(all(orient(a, b, p) <= 0 for p in other) for a, b in edges(one)):
            return False
    return True


def orient(p: ExactPoint, q: ExactPoint, r: ExactPoint) -> Fraction:
    """Twice the signed area of pqr: positive for a left turn."""
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def edges(ring: Sequence[Any]) -> Iterable[tuple[Any, Any]]:
    return zip(ring, [*ring[1:], ring[0]], strict=True)


def ring_area(ring: Sequence[Any]) -> Any:
    """Signed area, positive for counter-clockwise."""
    return sum(p[0] * q[1] - q[0] * p[1] for p, q in edges(ring)) / 2


# --- preparation, cached because the same scene is queried at many poses ---


def _floats(polygons: Sequence[Polygon]) -> tuple[Any, ...]:
    def ring(points: Ring) -> tuple[tuple[float, float], ...]:
        return tuple((float(x), float(y)) for x, y in points)

    return tuple((ring(outer), tuple(map(ring, holes))) for outer, holes in polygons)


def _fractions(polygon: Polygon) -> tuple[ExactRing, tuple[ExactRing, ...]]:
    def ring(points: Ring) -> ExactRing:
        return tuple((Fraction(x), Fraction(y)) for x, y in points)

    return ring(polygon[0]), tuple(map(ring, polygon[1]))


@lru_cache(maxsize=64)
def _shapely(polygons: tuple[Any, ...]) -> np.ndarray:
    shapes = np.array([shapely.Polygon(outer, holes) for outer, holes in polygons], dtype=object)
    if not shapely.is_valid(shapes).all():
        raise AtALoss("rounded to doubles, a polygon crosses itself")
    return shapes


def _placed(robot: Sequence[Polygon], pose: Sequence[float]) -> list[shapely.Polygon]:
    x, y, theta = map(float, pose)
    c, s = math.cos(theta), math.sin(theta)
    turn = np.array([[c, s], [-s, c]])
    parts = _shapely(_floats(robot))
    return [shapely.transform(part, lambda points: points @ turn + (x, y)) for part in parts]


@lru_cache(maxsize=100_000)
def _convex_pieces(polygon: Any) -> tuple[tuple[tuple[float, float], ...], ...]:
    outer, holes = polygon
    ring = outer if ring_area(outer) > 0 else outer[::-1]
    corners = zip(ring, ring[1:] + ring[:1], ring[2:] + ring[:2], strict=True)
    if not holes and all(orient(*corner) >= 0 for corner in corners):
        return (ring,)
    return _triangles(polygon)


def _triangles(polygon: Any) -> tuple[tuple[tuple[float, float], ...], ...]:
    (shape,) = _shapely((polygon,))
    triangles = shapely.orient_polygons(shapely.get_parts(shapely.constrained_delaunay_triangles(shape)))
    assert math.isclose(shapely.area(triangles).sum(), shape.area, rel_tol=1e-9)
    return tuple(tuple(map(tuple, triangle.exterior.coords[:-1])) for triangle in triangles)


@lru_cache(maxsize=10_000)
def _exact_triangles(polygon: tuple[ExactRing, tuple[ExactRing, ...]]) -> tuple[ExactRing, ...]:
    outer, holes = polygon
    rings = [outer if ring_area(outer) > 0 else outer[::-1]]
    rings += [hole if ring_area(hole) < 0 else hole[::-1] for hole in holes]
    exact = {(float(x), float(y)): (x, y) for ring in rings for x, y in ring}
    try:
        proposed = tuple(tuple(exact[p] for p in t) for t in _triangles(*_floats([polygon])))
    except AtALoss:
        proposed = ()
    if _tile(proposed, rings):
        return proposed
    found = _triangles_between_verticals(rings)
    assert sum(map(ring_area, found)) == sum(map(ring_area, rings))
    return found


def _tile(triangles: Sequence[ExactRing], rings: Sequence[ExactRing]) -> bool:
    """True if the triangles certainly tile what the rings bound."""
    uses = Counter(edge for triangle in triangles for edge in edges(triangle))
    sides = {edge for ring in rings for edge in edges(ring)}
    return (
        all(orient(*triangle) > 0 for triangle in triangles)
        and all(count == 1 for count in uses.values())
        and sides <= uses.keys()
        and all((q, p) in uses for p, q in uses.keys() - sides)
    )


def _triangles_between_verticals(rings: Sequence[ExactRing]) -> tuple[ExactRing, ...]:
    """Triangles of the pieces into which vertical lines through all vertices cut what the rings bound."""
    sides = [side if side[0] < side[1] else side[::-1] for ring in rings for side in edges(ring)]
    found = []
    for x0, x1 in pairwise(sorted({x for ring in rings for x, _ in ring})):
        across = sorted(
            (
                [(x, y + (x - u) * (v - y) / (w - u)) for x in (x0, x1)]
                for (u, y), (w, v) in sides
                if u <= x0 and x1 <= w
            ),
            key=lambda ends: ends[0][1] + ends[1][1],
        )
        for (a, b), (d, c) in zip(across[::2], across[1::2], strict=True):
            found += [triangle for triangle in ((a, b, c), (a, c, d)) if orient(*triangle) > 0]
    return tuple(found)
