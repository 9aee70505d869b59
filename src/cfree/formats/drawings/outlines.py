"""Turn the content of a drawing into shapes: find outlines, apply roles and the robot's pivot, and make polygons."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from cfree.curves.curved import Curved
from cfree.curves.drawn import IDENTITY, Affine, Ring, carried, decimal, translation
from cfree.curves.from_drawing import curved_of
from cfree.curves.hulls import Outline, box_of, in_range, polygon_of
from cfree.errors import InvalidPolygonError, UndecidedError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.formats.drawings.content import Curve, Drawn, Lines
from cfree.formats.drawings.regions import filled_outlines, layer_outlines
from cfree.formats.drawings.source import Source, role_of, shapes_of, tolerance_of
from cfree.formats.drawings.strokes import walls
from cfree.formats.shapes import IGNORE, Shape, Shapes
from cfree.formats.text.findings import InvalidFileError, Problem
from cfree.scene.scene import explained

PIVOT = "pivot"


def shapes_of_drawing(
    source: Source, form: str, content: Sequence[Drawn | Lines], settings: Mapping[str, Any], remedy: str
) -> Shapes:
    """Return the shapes of a drawing; raise all its problems."""
    rings = {id(item): _rings_of(item) for item in content}
    for item in content:
        if not in_range(rings[id(item)]):
            source.refuse("a coordinate that is not finite, or beyond 1e150; scale the drawing", item.line)
    pivots = [item for item in content if item.names and item.names[0].lower() == PIVOT]
    items = [(item, *role_of(source, *item.names)) for item in content if item not in pivots and any(rings[id(item)])]
    pivot = _center(rings[id(pivots[0])]) if pivots else None
    if len(pivots) > 1:
        source.refuse(f"{len(pivots)} pivots; mark one point", pivots[1].line)
    every = [ring for item, _, _ in items for ring in rings[id(item)]]
    size = _size(every)
    tolerance = tolerance_of(source, every)
    hatched = {item.names[:1] for item, _, _ in items if isinstance(item, Drawn)}
    makers = _Makers(source, tolerance)
    for item, role, name in items:
        if role == IGNORE:
            source.note("lost", f"{name}: ignored", "less")
            continue
        shift = translation(-pivot[0], -pivot[1]) if role == "robot" and pivot else IDENTITY
        place = _Place(item.line, role, name)
        if isinstance(item, Drawn):
            moved = [carried(ring, shift) if shift != IDENTITY else ring for ring in item.rings]
            makers.add(place, filled_outlines(source, moved, item.even_odd, tolerance))
            continue
        curves = [_moved(curve, shift) for curve in item.curves]
        if source.reading.strokes != "ignore":
            makers.walls(place, curves)
            continue
        layer = next(iter(item.names), "")
        makers.add(
            place,
            layer_outlines(
                source, layer, curves, item.names[:1] in hatched,
                size=size, tolerance=tolerance, workspace=role == "workspace",
            ),
        )  # fmt: skip
    shapes = makers.finish()
    completed = dict(settings)
    if pivot and "start" not in completed and any(shape.role == "robot" for shape in shapes):
        completed["start"] = Pose(*pivot, 0)
        source.note("info", "the pivot is the robot's reference point, and its place the start")
    return shapes_of(source, form, shapes, completed, remedy)


@dataclass(frozen=True, slots=True)
class _Place:
    """Line, role and name of a shape in a drawing."""

    line: int
    role: str
    name: str | None


class _Makers:
    """Shapes made of outlines, and the problems of those that cannot be made."""

    def __init__(self, source: Source, tolerance: float) -> None:
        self.source = source
        self.tolerance = tolerance
        self.shapes: list[Shape] = []
        self.problems: list[Problem] = []
        self.curves = 0

    def add(self, place: _Place, outlines: Sequence[Outline]) -> None:
        """Make polygons of outlines."""
        role, name = place.role, place.name
        for outline in outlines:
            if outline.curved and self.source.reading.curves and (shape := _round_shape(outline)):
                self.shapes.append(Shape(role, name, shape))
                continue
            self.curves += outline.curved
            try:
                polygon = polygon_of(outline, self.tolerance, role == "workspace", self.source.spend)
            except InvalidPolygonError as error:
                self.problems.append(Problem(place.line, 1, name or role, explained(error)))
            except UndecidedError as error:
                message = f"{error}; draw it wider, or leave it out"
                self.problems.append(Problem(place.line, 1, name or role, message))
            else:
                self.shapes.append(Shape(role, name, polygon))

    def walls(self, place: _Place, curves: Sequence[Curve]) -> None:
        """Make walls of curves."""
        polygons = walls(self.source, curves, place.name or place.role)
        self.shapes += [Shape(place.role, place.name, polygon) for polygon in polygons]

    def finish(self) -> list[Shape]:
        """Return the shapes; raise the problems."""
        if self.curves:
            self.source.note(
                "near", f"outline with curves: a polygon around it (a workspace: inside) within {self.tolerance:g}",
                "near", count=self.curves, size=self.tolerance,
            )  # fmt: skip
        if self.problems:
            raise InvalidFileError(self.source.findings.file, self.problems)
        return self.shapes


def _round_shape(outline: Outline) -> Curved | None:
    """Return the round shape of an outline, or None if no polygon around it can be proved."""
    try:
        return curved_of(outline)
    except (InvalidPolygonError, UndecidedError):
        return None


def _rings_of(item: Drawn | Lines) -> list[Ring]:
    return item.rings if isinstance(item, Drawn) else [curve.segments for curve in item.curves]


def _moved(curve: Curve, shift: Affine) -> Curve:
    return curve if shift == IDENTITY else replace(curve, segments=carried(curve.segments, shift))


def _size(rings: Sequence[Ring]) -> float:
    x0, y0, x1, y1 = box_of(rings)
    return max(x1 - x0, y1 - y0)


def _center(rings: Sequence[Ring]) -> ExactPoint:
    x0, y0, x1, y1 = box_of(rings)
    return decimal((x0 + x1) / 2), decimal((y0 + y1) / 2)
