"""Unfilled curves of SVG: their groups, their strokes, and ends that miss their begins by rounding."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from cfree.curves.drawn import Affine
from cfree.curves.hulls import box_of
from cfree.formats.drawings.content import Cap, Curve, Join, Lines
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
    elements: list[tuple[tuple[str, ...], int, list[Curve]]] = field(default_factory=list)
    doubtful: list[Curve] = field(default_factory=list)  # filled curves that may be pieces of an outline

    def lines(self, together: bool) -> Iterator[Lines]:
        """Yield the curves of all elements together, or the open curves together and each closed element."""
        open_curves = [curve for _, _, own in self.elements for curve in own if together or not curve.closed]
        if open_curves:
            names, line = self.elements[0][:2] if len(self.elements) == 1 else (self.names, self.elements[0][1])
            yield Lines(open_curves + self.doubtful, names, line)
        for names, line, own in () if together else self.elements:
            if closed := [curve for curve in own if curve.closed]:
                yield Lines(closed, names, line)


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
            width = float(measure.length(source, style["stroke-width"], "diagonal"))
            self.width = max(0.0, width) * (1.0 if fixed else self.scale)
        if source.reading.strokes != "ignore" and self.width:
            self._note(fixed)

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
