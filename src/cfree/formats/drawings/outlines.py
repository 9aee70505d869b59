"""Turn outlines of a drawing into shapes: nest rings, apply roles and the robot's pivot, replace curves by polygons."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from cfree.curves.drawn import Line, Ring, Vector, carried, decimal, straight, translation, turn
from cfree.curves.hulls import Outline, area, box_of, in_range, polygon_of, rough
from cfree.errors import InvalidPolygonError, UndecidedError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.formats.drawings.content import Drawn
from cfree.formats.drawings.source import Source, role_of, shapes_of, tolerance_of
from cfree.formats.shapes import IGNORE, Shape, Shapes
from cfree.formats.text.findings import InvalidFileError, Problem
from cfree.scene.scene import explained
from cfree.words import counted

PIVOT = "pivot"


def shapes_of_drawing(
    source: Source, form: str, drawn: Sequence[Drawn], settings: Mapping[str, Any], remedy: str
) -> Shapes:
    """Return the shapes of a drawing; raise all its problems."""
    pivots = [item for item in drawn if item.names and item.names[0].lower() == PIVOT]
    items = [(item, *role_of(source, *item.names)) for item in drawn if item not in pivots and any(item.rings)]
    for item in drawn:
        if not in_range(item.rings):
            source.refuse("a coordinate that is not finite, or beyond 1e150; scale the drawing", item.line)
    pivot = _center(pivots[0]) if pivots else None
    if len(pivots) > 1:
        source.refuse(f"{len(pivots)} pivots; mark one point", pivots[1].line)
    tolerance = tolerance_of(source, [ring for item, _, _ in items for ring in item.rings])
    shapes: list[Shape] = []
    problems: list[Problem] = []
    curves = 0
    for item, role, name in items:
        if role == IGNORE:
            source.note("lost", f"{name}: ignored", "less")
            continue
        rings = item.rings
        if role == "robot" and pivot:
            rings = [carried(ring, translation(-pivot[0], -pivot[1])) for ring in rings]
        for outline in nested(source, rings, item.even_odd):
            curves += outline.curved
            try:
                polygon = polygon_of(outline, tolerance, role == "workspace", source.spend)
            except InvalidPolygonError as error:
                problems.append(Problem(item.line, 1, name or role, explained(error)))
            except UndecidedError as error:
                problems.append(Problem(item.line, 1, name or role, f"{error}; draw it wider, or leave it out"))
            else:
                shapes.append(Shape(role, name, polygon))
    if curves:
        source.note(
            "info",
            f"{counted(curves, 'outline')} with curves: polygons around (a workspace: inside) within {tolerance:g}",
        )
    if problems:
        raise InvalidFileError(source.findings.file, problems)
    completed = dict(settings)
    if pivot and "start" not in completed and any(shape.role == "robot" for shape in shapes):
        completed["start"] = Pose(*pivot, 0)
        source.note("info", "the pivot is the robot's reference point, and its place the start")
    return shapes_of(source, form, shapes, completed, remedy)


def _center(item: Drawn) -> ExactPoint:
    x0, y0, x1, y1 = box_of(item.rings)
    return decimal((x0 + x1) / 2), decimal((y0 + y1) / 2)


def nested(source: Source, rings: Sequence[Ring], even_odd: bool) -> list[Outline]:
    """Return outer rings with their holes, by the rule that fills them.

    Parameters
    ----------
    rings : sequence of rings
        They do not cross each other.
    even_odd : bool
        Fill by the even-odd rule; if False, fill points with a winding number other than 0.
    """
    import shapely

    points: list[list[Vector]] = [rough(ring) for ring in rings]
    solid = [k for k in range(len(rings)) if not _is_flat(rings[k], points[k])]
    if len(solid) < len(rings):
        source.note("lost", "ring on a line: it forbids nothing; give it width", "less", count=len(rings) - len(solid))
    if len(solid) == 1:
        return [Outline(rings[solid[0]])]
    areas = [area(part) for part in points]
    order = sorted(solid, key=lambda k: -abs(areas[k]))
    bodies = [shapely.Polygon(points[k]) for k in order]
    tree = shapely.STRtree(bodies)
    winding: dict[int, int] = {}
    parent: dict[int, int | None] = {}
    holes: dict[int, list[int]] = {}
    for place, k in enumerate(order):
        probe = shapely.Point(points[k][0])
        around = sorted(int(j) for j in tree.query(probe) if j < place and _inside(source, points[order[j]], points[k]))
        source.spend(1 + len(points[k]))
        outside = winding[order[around[-1]]] if around else 0
        step = 1 if even_odd or areas[k] > 0 else -1
        winding[k] = (outside + step) % 2 if even_odd else outside + step
        parent[k] = order[around[-1]] if around else None
        if not outside and winding[k]:
            holes[k] = []
        elif outside and not winding[k]:
            owner = parent[k]
            while owner is not None and owner not in holes:
                owner = parent[owner]
            if owner is not None:
                holes[owner].append(k)
        else:
            source.note("info", "a ring inside of a filled one: filled already")
    return [Outline(rings[k], tuple(rings[j] for j in sorted(inner))) for k, inner in sorted(holes.items())]


def _is_flat(ring: Ring, rough_points: Sequence[Vector]) -> bool:
    """True if all points of a ring are on the line of its first two different ones; points of lines are exact."""
    exact = [segment.start for segment in ring if isinstance(segment, Line)]
    points: Sequence[Sequence[Any]] = exact if straight(ring) else rough_points
    if len(points) < 3:
        return True
    p = points[0]
    q = next((other for other in points if other != p), p)
    return all(turn(p, q, r) == 0 for r in points)


def _inside(source: Source, outer: list[Vector], inner: list[Vector]) -> bool:
    """True if most points of a sample of the inner ring are inside the outer one. The rings may touch."""
    source.spend(1 + len(outer) // 8)
    few = inner[:: max(1, len(inner) // 7)]
    return sum(_contains(outer, p) for p in few) * 2 > len(few)


def _contains(ring: list[Vector], p: Vector) -> bool:
    odd = False
    for (x0, y0), (x1, y1) in zip(ring, [*ring[1:], *ring[:1]], strict=True):
        if (y0 > p[1]) != (y1 > p[1]) and p[0] < x0 + (p[1] - y0) * (x1 - x0) / (y1 - y0):
            odd = not odd
    return odd
