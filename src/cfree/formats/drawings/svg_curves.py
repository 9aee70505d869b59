"""Unfilled curves of SVG: their groups, their strokes, and ends that miss their begins by rounding."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from cfree.curves.drawn import Affine
from cfree.curves.hulls import box_of, rough
from cfree.formats.drawings.content import Cap, Curve, Join, Lines
from cfree.formats.drawings.regions import layer_outlines
from cfree.formats.drawings.source import Source
from cfree.formats.drawings.svg_lengths import Measure
from cfree.formats.drawings.svg_paths import Subpath, closed_by_a_line, end_of, start_of
from cfree.formats.drawings.svg_style import Style
from cfree.formats.drawings.svg_transforms import stretch

LARGEST_MISS = 1e-3
"""Maximum distance, per size of a curve, that the digits of its numbers explain."""
LARGEST_ROUNDING = 1e-5
"""The same for ends of different curves."""

_CAPS: dict[str, Cap] = {"butt": "butt", "square": "square", "round": "round"}
_JOINS: dict[str, Join] = {"miter": "miter", "round": "round", "bevel": "bevel"}


@dataclass(slots=True)
class Group:
    """Unfilled curves below a group that has a name, or of an element that has a role."""

    names: tuple[str, ...]
    elements: list[Lines] = field(default_factory=list)
    doubtful: list[Curve] = field(default_factory=list)  # filled curves that may be pieces of an outline

    def lines(self, source: Source, size: float) -> Iterator[Lines]:
        """Yield its curves: closed elements each by itself, but for those inside of an outline of open curves.

        A frame around everything must not turn furniture into holes; the circle in a plate drawn by lines is one.
        """
        together = source.reading.holes == "nested" or source.reading.strokes != "ignore"
        loose = [curve for element in self.elements for curve in element.curves if together or not curve.closed]
        closed = [] if together else [_closed(element) for element in self.elements]
        whole = [element for element in closed if element.curves]
        if loose:
            loose += self.doubtful
            held = _held(source, loose, whole, size)
            loose += [curve for element in whole if id(element) in held for curve in element.curves]
            whole = [element for element in whole if id(element) not in held]
            names = self.elements[0].names if len(self.elements) == 1 else self.names
            yield Lines(loose, names, self.elements[0].line)
        yield from whole


def _closed(element: Lines) -> Lines:
    return replace(element, curves=[curve for curve in element.curves if curve.closed])


def _held(source: Source, loose: list[Curve], elements: list[Lines], size: float) -> set[int]:
    """Return the identities of closed elements that are inside of an outline which open curves close."""
    if not elements:
        return set()
    import shapely

    outlines = layer_outlines(Source(source.findings.file, reading=source.reading), "", loose, size=size)
    bodies = [shapely.Polygon(points) for outline in outlines if len(points := rough(outline.outer)) > 2]
    rims = [shapely.MultiPoint([p for curve in item.curves for p in rough(curve.segments)]) for item in elements]
    held: set[int] = set()
    for body in bodies:
        if body.is_valid:
            shapely.prepare(body)
            inside = shapely.covers(body, rims).tolist()
            held |= {id(element) for element, held_here in zip(elements, inside, strict=True) if held_here}
    return held


class Pen:
    """The stroke of an element, and the curves that it draws.

    Parameters
    ----------
    source : Source
        The file, which gets notes.
    style : Style
        The element's computed style.
    measure : Measure
        The viewport.
    frame : Affine
        From the element's coordinates to the scene's.
    where : str
        The element's name.
    """

    def __init__(self, source: Source, style: Style, measure: Measure, frame: Affine, where: str) -> None:
        self.source, self.style, self.where = source, style, where
        self.scale, self.least = stretch(frame)
        self.width = 0.0
        fixed = style["vector-effect"].lower() == "non-scaling-stroke"
        if style["stroke"].lower() != "none":
            self.width = self._width(measure) * (1.0 if fixed else self.scale)
        if source.reading.strokes != "ignore" and self.width:
            self._note(fixed)

    def _width(self, measure: Measure) -> float:
        """Return the width in user units; strokes that are not read need no notes."""
        source = self.source if self.source.reading.strokes != "ignore" else Source("")
        try:
            return max(0.0, float(measure.length(source, self.style["stroke-width"], "diagonal")))
        except ValueError:
            source.note("guess", "width of a stroke that is no length: taken as 1", "unknown", where=self.where)
            return 1.0

    def _note(self, fixed: bool) -> None:
        note, where = self.source.note, self.where
        if fixed:
            note("info", "stroke that does not scale: its width in user units", "unknown", where=where)
        elif self.scale > self.least * (1 + 1e-9):
            note("info", "stroke stretched in one direction: its greatest width", "more", where=where)
        if self.style["stroke-dasharray"].lower() != "none":
            note("info", "dashed line: read whole", "more", where=where)

    def curve(self, part: Subpath, handle: str) -> Curve:
        """Return a part as a curve; one that misses its begin by the rounding of its numbers is closed."""
        segments = part.segments
        closed = part.closed or start_of(segments) == end_of(segments)
        x0, y0, x1, y1 = box_of([segments])
        size, miss = max(x1 - x0, y1 - y0), part.miss * self.scale
        if not closed and len(segments) > 1 and self.source.reading.join != 0:
            (ax, ay), (bx, by) = (tuple(map(float, p)) for p in (start_of(segments), end_of(segments)))
            gap = math.hypot(bx - ax, by - ay)
            if gap <= min(miss, LARGEST_MISS * size):
                segments, closed = closed_by_a_line(part), True
                self.source.note(
                    "joined", "end that misses its begin by rounding", "near", where=self.where, at=(ax, ay), size=gap
                )
        rounding = min(miss, LARGEST_ROUNDING * size)
        cap = _CAPS.get(self.style["stroke-linecap"].lower(), "butt")
        join = _JOINS.get(self.style["stroke-linejoin"].lower(), "miter")
        return Curve(segments, closed, handle, rounding, self.width, cap, join, self._miter())

    def _miter(self) -> float:
        try:
            return max(1.0, float(self.style["stroke-miterlimit"]))
        except ValueError:
            return 4.0
