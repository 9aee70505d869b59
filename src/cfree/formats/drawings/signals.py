"""Notice unfilled outlines that may be rooms, or lines that may be walls. Signals ask; none changes a shape.

Exporters write floor plans and parts with the same lines, and nothing in a file decides between them. One outline
around nearly everything is suspicious if its name means a wall or a room, if quarter arcs end on lines (doors), or if
lines end inside the sides of others (walls that divide rooms).
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from cfree.curves.drawn import Arc, Line, Vector, ends
from cfree.curves.hulls import box_of
from cfree.formats.drawings.content import Curve, Drawn, Lines
from cfree.formats.drawings.source import Source, role_of
from cfree.formats.drawings.strokes import usual_width

NAMES = re.compile(r"wall|wand|w[aä]nde|mur|muro|pared|a-wall|room|raum|r[aä]ume|zimmer|floor|outline", re.IGNORECASE)
MOST_OF = 0.8
"""Share of the other shapes, or of the drawing's box, that such an outline contains."""
JUNCTIONS = 3
"""Number of lines that end inside others, from which on they are divided rooms."""
NEAR = 1e-4
"""Distance of an end from a line that it meets, per size."""

Box = tuple[float, float, float, float]


def ask(source: Source, content: Sequence[Drawn | Lines]) -> None:
    """Note each unfilled outline that is read as a solid, contains nearly everything, and may be a room or walls."""
    if source.reading.strokes != "ignore":
        return
    boxes = [box_of([curve.segments]) for item in content if isinstance(item, Lines) for curve in item.curves]
    boxes += [box_of(item.rings) for item in content if isinstance(item, Drawn)]
    if not boxes:
        return
    whole = _united(boxes)
    for item in content:
        if not isinstance(item, Lines) or role_of(source, *item.names)[0] != "obstacle":
            continue
        outline = _outline(item)
        if not outline:
            continue
        box = box_of([curve.segments for curve in outline])
        others = len(boxes) - len(outline)
        inside = sum(_contains(box, other) for other in boxes) - len(outline)
        if (others and inside > MOST_OF * others) or (others and _area(box) > MOST_OF * _area(whole)):
            name = item.names[0] if item.names else ""
            role = f"--role {name}=workspace or " if name else ""
            if NAMES.search(name) or _has_doors(item, whole) or _junctions(source, item, whole) >= JUNCTIONS:
                solid = "read as a solid" if outline[0].closed else "with others a possible solid"
                source.note(
                    "info",
                    f"line around nearly everything, {solid}",
                    "more",
                    where=name,
                    at=ends(outline[0].segments[0])[0],
                    size=max(box[2] - box[0], box[3] - box[1]),
                    handle=outline[0].handle,
                    remedy=f"{role}--strokes {_width(item.curves)}",
                )


def _width(curves: Sequence[Curve]) -> str:
    """Return a value for the option `strokes`."""
    return "drawn" if all(curve.width > 0 for curve in curves) else f"{usual_width(curves):g}"


def _outline(item: Lines) -> list[Curve]:
    """Return the largest closed curve of a layer, or its open ones if they may close an outline together."""
    closed = [curve for curve in item.curves if curve.closed]
    loose = [curve for curve in item.curves if not curve.closed]
    largest = max(closed, key=lambda curve: _area(box_of([curve.segments])), default=None)
    if len(loose) > JUNCTIONS and (
        largest is None or _area(box_of([c.segments for c in loose])) > _area(box_of([largest.segments]))
    ):
        return loose
    return [largest] if largest else []


def _has_doors(item: Lines, whole: Box) -> bool:
    """True if a quarter arc of a circle ends on the end of a line."""
    near = NEAR * max(whole[2] - whole[0], whole[3] - whole[1])
    tips = {_cell(p, near) for curve in item.curves for s in curve.segments if isinstance(s, Line) for p in ends(s)}
    for curve in item.curves:
        for segment in curve.segments if not curve.closed else ():
            is_quarter = isinstance(segment, Arc) and abs(abs(segment.last - segment.first) - math.pi / 2) < 0.02
            if is_quarter and any(_cell(p, near) in tips for p in ends(segment)):
                return True
    return False


def _junctions(source: Source, item: Lines, whole: Box) -> int:
    """Count ends of open curves that are on a straight side, away from the side's ends."""
    import numpy as np
    import shapely

    near = NEAR * max(whole[2] - whole[0], whole[3] - whole[1])
    sides = np.array([ends(s) for curve in item.curves for s in curve.segments if isinstance(s, Line)])
    loose = [curve.segments for curve in item.curves if not curve.closed]
    source.spend(len(sides) + len(loose))
    if not len(sides) or not loose:
        return 0
    tips = shapely.points([p for ring in loose for p in (ends(ring[0])[0], ends(ring[-1])[1])])
    tip, side = shapely.STRtree(shapely.linestrings(sides)).query(tips, predicate="dwithin", distance=near)
    corners = shapely.points(sides)
    away = np.minimum(*(shapely.distance(tips[tip], corners[side, end]) for end in (0, 1))) > 10 * near
    return len(np.unique(tip[away]))


def _cell(p: Vector, near: float) -> tuple[int, int]:
    return (round(p[0] / near), round(p[1] / near)) if near else (0, 0)


def _united(boxes: Sequence[Box]) -> Box:
    x0, y0, x1, y1 = zip(*boxes, strict=True)
    return min(x0), min(y0), max(x1), max(y1)


def _area(box: Box) -> float:
    return (box[2] - box[0]) * (box[3] - box[1])


def _contains(outer: Box, inner: Box) -> bool:
    return outer[0] <= inner[0] and outer[1] <= inner[1] and inner[2] <= outer[2] and inner[3] <= outer[3]
