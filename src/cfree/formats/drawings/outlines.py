"""Turn the content of a drawing into shapes: find outlines, apply roles and the robot's pivot, and make polygons."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from cfree.curves.curved import Curved
from cfree.curves.drawn import IDENTITY, Affine, Ring, carried, decimal, ends, points_along, translation
from cfree.curves.from_drawing import curved_of
from cfree.curves.hulls import Outline, area, box_of, in_range, polygon_of, rough
from cfree.errors import InvalidPolygonError, UndecidedError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.formats.drawings.chord_polygons import chord_polygons
from cfree.formats.drawings.content import Drawn, Lines
from cfree.formats.drawings.regions import FINER, filled_outlines, layer_outlines
from cfree.formats.drawings.source import Source, role_of, shapes_of, tolerance_of
from cfree.formats.drawings.strokes import walls
from cfree.formats.shapes import IGNORE, Shape, Shapes
from cfree.formats.text.findings import InvalidFileError, Problem
from cfree.polygons.polygon import Polygon
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
    makers = _Makers(source, size, tolerance)
    for item, role, name in items:
        if role == IGNORE:
            for ring in rings[id(item)]:
                source.note("hidden", "ignored shape", "less", where=name or "", points=points_along(ring))
            continue
        shift = translation(-pivot[0], -pivot[1]) if role == "robot" and pivot else IDENTITY
        makers.add(_Place(item.line, role, name), _moved(item, shift), hatched=item.names[:1] in hatched)
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
    """Shapes made of the content of a drawing, and the problems of those that cannot be made."""

    def __init__(self, source: Source, size: float, tolerance: float) -> None:
        self.source = source
        self.size = size
        self.tolerance = tolerance
        self.shapes: list[Shape] = []
        self.problems: list[Problem] = []
        self.curves = 0

    def add(self, place: _Place, item: Drawn | Lines, *, hatched: bool) -> None:
        """Make shapes of an item; `hatched` if its layer has filled items, too."""
        if isinstance(item, Lines) and self.source.reading.strokes != "ignore":
            role = "obstacle" if place.role == "workspace" else place.role
            solids = walls(self.source, item.curves, place.name or place.role)
            self.shapes += [Shape(role, place.name, solid) for solid in solids]
            if role == "obstacle" and place.role != "workspace":
                return  # outlines of robot and workspace keep their meaning
        try:
            outlines = self._outlines(place, item, hatched)
        except InvalidPolygonError as error:
            self._fail(place, explained(error))
            return
        for outline in outlines:
            if not self._is_dust(place, outline):
                self.shapes += [Shape(place.role, place.name, shape) for shape in self._shapes(place, outline)]

    def _shapes(self, place: _Place, outline: Outline) -> Sequence[Polygon | Curved]:
        """Return the round shape of an outline, or polygons; more than one only if its curves nearly touch."""
        if outline.curved and self.source.reading.curves and (shape := _round_shape(outline)):
            return [shape]
        self.curves += outline.curved
        inside, message = place.role == "workspace", ""
        try:
            polygon = polygon_of(outline, self.tolerance, inside, self.source.spend)
            if inside or len(polygon.rings) > len(outline.holes):  # else a hole is filled
                return [polygon]
        except InvalidPolygonError as error:
            message = explained(error)
        except UndecidedError as error:
            message = f"{error}; draw it wider, or leave it out"
        polygons = chord_polygons(outline, self.tolerance / FINER, inside=inside) if outline.curved else ()
        if polygons:
            what = "outline with curves that nearly touch"
            self.source.note("near", what, "near", where=place.name or place.role, size=self.tolerance)
        else:
            self._fail(place, message)
        return polygons

    def _is_dust(self, place: _Place, outline: Outline) -> bool:
        """True if an obstacle is smaller than the option says; it is noted."""
        least = self.source.reading.min_area
        if place.role != "obstacle" or not least:
            return False
        size = abs(area(rough(outline.outer))) - sum(abs(area(rough(hole))) for hole in outline.holes)
        if size < least:
            at, where = ends(outline.outer[0])[0], place.name or place.role
            self.source.note("assumption", "shape below the least area", "less", where=where, at=at, size=size)
        return size < least

    def _outlines(self, place: _Place, item: Drawn | Lines, hatched: bool) -> list[Outline]:
        if isinstance(item, Drawn):
            return filled_outlines(self.source, item.rings, item.even_odd, self.tolerance)
        return layer_outlines(
            self.source,
            next(iter(item.names), ""),
            item.curves,
            hatched,
            size=self.size,
            tolerance=self.tolerance,
            workspace=place.role == "workspace",
        )

    def _fail(self, place: _Place, message: str) -> None:
        self.problems.append(Problem(place.line, 1, place.name or place.role, message))

    def finish(self) -> list[Shape]:
        """Return the shapes; raise the problems."""
        if self.curves:
            self.source.note(
                "near", "outline with curves", "near", count=self.curves, size=self.tolerance, remedy="--tolerance"
            )
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


def _moved(item: Drawn | Lines, shift: Affine) -> Drawn | Lines:
    if shift == IDENTITY:
        return item
    if isinstance(item, Drawn):
        return replace(item, rings=[carried(ring, shift) for ring in item.rings])
    return replace(item, curves=[replace(curve, segments=carried(curve.segments, shift)) for curve in item.curves])


def _size(rings: Sequence[Ring]) -> float:
    x0, y0, x1, y1 = box_of(rings)
    return max(x1 - x0, y1 - y0)


def _center(rings: Sequence[Ring]) -> ExactPoint:
    x0, y0, x1, y1 = box_of(rings)
    return decimal((x0 + x1) / 2), decimal((y0 + y1) / 2)
