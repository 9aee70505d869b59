"""Outlines of SVG elements: fills with their rule, unfilled curves by groups, clips, and notes of losses."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from fractions import Fraction

from cfree.curves.drawn import Ring, points_along
from cfree.curves.hulls import box_of
from cfree.formats.drawings.content import Curve, Drawn, Lines
from cfree.formats.drawings.outlines import PIVOT
from cfree.formats.drawings.source import Source, role_of
from cfree.formats.drawings.svg_clips import Clip
from cfree.formats.drawings.svg_curves import Group, Pen
from cfree.formats.drawings.svg_element import Element
from cfree.formats.drawings.svg_paint import Painted, note_painted
from cfree.formats.drawings.svg_paths import Subpath, closed_by_a_line, end_of, on_a_line
from cfree.formats.drawings.svg_viewports import corners_in


class Outlines:
    """The outlines of all elements."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.filled: list[Drawn | Lines] = []
        self.painted: list[Painted] = []
        self.groups: list[Group] = []
        self.page: Clip | None = None
        self._own: dict[tuple[int, str], Group] = {}

    def group(self, names: tuple[str, ...]) -> Group:
        """Begin a group of unfilled curves."""
        self.groups.append(Group(names))
        return self.groups[-1]

    def content(self) -> list[Drawn | Lines]:
        """Return filled elements in the order of the file, then unfilled curves by their groups."""
        note_painted(self.source, self.painted)
        groups = [group for group in self.groups if group.elements]
        if not groups:
            return self.filled
        rings = [ring for item in self.painted for ring in item.drawn.rings]
        rings += [curve.segments for group in groups for item in group.elements for curve in item.curves]
        x0, y0, x1, y1 = box_of(rings)
        size = max(x1 - x0, y1 - y0)
        return self.filled + [lines for group in groups for lines in group.lines(self.source, size)]

    def hide(self, element: Element) -> None:
        """Note a hidden path or basic shape, with its outline for pictures."""
        what, points = f"hidden {element.node.tag}", []
        with suppress(ValueError, ArithmeticError):  # a fault of a hidden element is none
            points = [p for part in element.form().parts()[0][:1] for p in points_along(part.segments)]
        self.source.note("hidden", what, "less", where=element.name, points=points)

    def add(self, element: Element) -> None:
        """Add the outline of a path or a basic shape."""
        style, names = element.state.style, element.state.names
        if style["visibility"].lower() != "visible":
            return self.hide(element)
        parts, fault = element.form().parts()
        if fault is not None:
            self._broken(element, parts, fault)
        if any(style[f"marker-{place}"].lower() != "none" for place in ("start", "mid", "end")):
            self.source.note("lost", "marker", "less", where=element.name)
        if not parts:
            return
        role, _ = role_of(self.source, *names)
        if role == "workspace" and element.state.unsure:
            element.refuse("a workspace with a rule of a style sheet that is not obeyed; write it at the element")
        if role in ("workspace", "robot") and (style["filter"].lower() != "none" or "url(" in style["fill"]):
            what = f"{role} with a filter, a gradient or a pattern: its outline is read"
            self.source.note("info", what, where=element.name)
        if role == "workspace" and self.page and self.page.effect([part.segments for part in parts]) != "none":
            self.source.note("warning", "workspace beyond the page: read whole", "less", where=element.name)
        pivot = bool(names) and names[0].lower() == PIVOT
        if pivot or (element.node.tag != "line" and style["fill"].lower() != "none"):
            self._fill(element, parts, role)
        else:
            self._lines(element, parts, role)

    def _broken(self, element: Element, parts: list[Subpath], fault: int) -> None:
        x, y = end_of(parts[-1].segments) if parts else (None, None)
        self.source.note(
            "lost",
            f"{element.node.tag} with a fault: not read from there on",
            "unknown",
            where=element.name,
            at=None if x is None or y is None else (float(x), float(y)),
            handle=f"line {element.node.line}, character {fault + 1}",
        )

    def _fill(self, element: Element, parts: list[Subpath], role: str) -> None:
        """Add a filled element; its parts on a line are lines."""
        style = element.state.style
        flat = [part for part in parts if not part.closed and on_a_line(part.segments)]
        if flat:
            self._lines(element, flat, role)
            lines = set(map(id, flat))
            parts = [part for part in parts if id(part) not in lines]
        rings = [closed_by_a_line(part) for part in parts]
        even_odd = style["fill-rule"].lower() == "evenodd"
        if rings and element.state.clips:
            _, rings, even_odd = self._clipped(element, role, rings, even_odd)
        if not rings:
            return
        drawn = Drawn(rings, element.state.names, element.node.line, even_odd)
        self.filled.append(drawn)
        self.painted.append(Painted(drawn, role, style["fill"].lower() or "black"))
        if not style["fill"] and len(parts) == 1 and len(parts[0].segments) == 1 and not parts[0].closed:
            self._group_of(element, role).doubtful += self._curves(element, parts)
        if self.source.reading.strokes == "drawn" and style["stroke"].lower() != "none":
            self.filled.append(Lines(self._curves(element, parts), element.state.names, element.node.line))

    def _lines(self, element: Element, parts: list[Subpath], role: str) -> None:
        """Add an unfilled element to its group; by itself, if a clip cuts it or was not applied."""
        lines = Lines(self._curves(element, parts), element.state.names, element.node.line)
        if (
            role == "obstacle"
            and element.state.style["stroke"].lower() == "none"
            and any(c.closed for c in lines.curves)
        ):
            what = "outline that paints nothing, without fill and stroke: read as a solid"
            self.source.note("guess", what, "more", where=element.name, handle=element.handle)
        rings = [curve.segments for curve in lines.curves]
        whole, left, _ = False, rings, True
        if element.state.clips:
            cuts = self.source.reading.strokes == "ignore" and all(curve.closed for curve in lines.curves)
            whole, left, _ = self._clipped(element, role, rings, True, cuts)
        if left is not rings and left:
            self.filled.append(Drawn(left, lines.names, lines.line))
        elif whole:
            self.filled.append(lines)
        elif left:
            self._group_of(element, role).elements.append(lines)

    def _group_of(self, element: Element, role: str) -> Group:
        """Return the group around an element; another one for elements with a role that the group does not give."""
        group = element.state.group
        if role_of(self.source, *group.names)[0] == role:
            return group
        key = id(group), role
        if key not in self._own:
            self._own[key] = self.group(element.state.names)
        return self._own[key]

    def _curves(self, element: Element, parts: list[Subpath]) -> list[Curve]:
        state = element.state
        pen = Pen(self.source, state.style, state.measure, state.frame, element.name)
        return [pen.curve(part, element.handle) for part in parts]

    def _clipped(
        self, element: Element, role: str, rings: list[Ring], even_odd: bool, cuts: bool = True
    ) -> tuple[bool, list[Ring], bool]:
        """Return True if some clip was not applied, what the others leave of rings, and the rule that fills it.

        Without `cuts`, clips that cut are not applied.
        """
        whole = False
        where = element.name or element.handle
        for clip in element.state.clips:
            effect = clip.effect(rings)
            if effect == "cut" and cuts:
                rings, even_odd = clip.cut(self.source, rings, even_odd), True
            if effect == "all" or not rings:
                self.source.note("hidden", f"{element.node.tag} outside of its {clip.what}", "less", where=where)
                return whole, [], even_odd
            if effect == "none" or (effect == "cut" and cuts):
                continue
            if role == "workspace":
                element.refuse(f"a workspace with a {clip.what} would be larger than drawn; draw what is left of it")
            whole = True
            x0, y0, x1, y1 = box_of(rings)
            middle = (x0 + x1) / 2, (y0 + y1) / 2
            self.source.note("guess", f"{clip.what} not applied: larger than drawn", "more", where=where, at=middle)
        return whole, rings, even_odd

    # elements without an outline

    def text(self, element: Element) -> None:
        """Note a text with its place."""
        middle, _ = _box(element)
        self.source.note("paint", "text", "less", where=element.name, at=middle)

    def picture(self, element: Element) -> None:
        """Note a picture or a piece of another language, with its middle and its longer side."""
        middle, size = _box(element)
        remedy = "trace it in the drawing"
        self.source.note("lost", element.node.tag, "less", where=element.name, at=middle, size=size, remedy=remedy)


def _box(element: Element) -> tuple[tuple[float, float] | None, float | None]:
    """Return middle and longer side of an element's box; None if it has none."""
    quiet = replace(element, source=Source(""))
    try:
        width, height = quiet.sizes()
        corners = corners_in(quiet.state.frame, quiet.corner(), (width or Fraction(0), height or Fraction(0)))
    except ValueError:  # lists of places, one for each letter
        return None, None
    xs, ys = zip(*((float(x), float(y)) for x, y in corners), strict=True)
    middle = (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2
    return middle, max(max(xs) - min(xs), max(ys) - min(ys))
