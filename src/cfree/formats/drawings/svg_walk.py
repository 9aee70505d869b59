"""Walk over the elements of an SVG: matrix, viewport, style, names and clips go down, outlines come up."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from cfree.curves.drawn import IDENTITY, Affine, Line, compose, translation
from cfree.curves.hulls import Outline
from cfree.formats.drawings.content import Drawn, Lines
from cfree.formats.drawings.regions import clipped, filled_outlines
from cfree.formats.drawings.source import DEEPEST, MOST_STEPS, Source
from cfree.formats.drawings.svg_clips import Clip, convex_clip
from cfree.formats.drawings.svg_conditions import applies
from cfree.formats.drawings.svg_element import Element, State
from cfree.formats.drawings.svg_forms import FORMS, extent
from cfree.formats.drawings.svg_lengths import EM, Axis, Measure
from cfree.formats.drawings.svg_outlines import Outlines
from cfree.formats.drawings.svg_paths import closed_by_a_line
from cfree.formats.drawings.svg_style import ROOT, Styles, computed
from cfree.formats.drawings.svg_transforms import around, attribute_map, css_map, origin, shortened
from cfree.formats.drawings.svg_viewports import box_of_view, corners_in, fitted
from cfree.formats.drawings.xml_tree import Node
from cfree.formats.text.findings import InvalidFileError

SVG = "http://www.w3.org/2000/svg"
_UNDRAWN = {
    "defs", "symbol", "clipPath", "mask", "marker", "pattern", "linearGradient", "radialGradient", "filter", "metadata",
    "style", "script", "title", "desc", "view", "cursor", "color-profile", "font", "font-face", "namedview",
}  # fmt: skip
_ANIMATIONS = {"animate", "animateTransform", "animateMotion", "animateColor", "set", "discard"}
_PICTURES = {"image", "foreignObject", "video", "canvas", "iframe", "audio"}
_VIEWPORTS = {"svg", "symbol"}
MOST_CLIPS = 20
"""Maximum depth of clip paths that refer to each other."""
_UNIT_BOX = tuple(map(Fraction, (0, 0, 1, 1)))
_NAMES = ("data-role", "label", "data-name", "id", "class")
USING = 8
"""Steps for a use, beside those of its elements."""


class Walk:
    """The outlines of a drawing.

    Parameters
    ----------
    source : Source
        The file.
    root : Node
        The outermost svg.
    frame : Affine
        The map from user units to the scene.
    size : Measure
        Width and height of the viewport.
    """

    def __init__(self, source: Source, root: Node, frame: Affine, size: Measure) -> None:
        self.source, self.root = source, root
        self.styles = Styles(source, root)
        self.outlines = Outlines(source)
        self.begin = State(frame, size, ROOT, (), self.outlines.group(()))
        if size.width and size.height:
            left, top = box_of_view(root)[:2] or (Fraction(0), Fraction(0))
            page = corners_in(frame, (left, top), (size.width, size.height))
            self.outlines.page = convex_clip("page", page)
        self.known: dict[str, Node] = {}
        self.twice: set[str] = set()
        self.clips: dict[tuple[int, Affine], Clip] = {}
        self.expanded: dict[int, int] = {}
        waiting = [root]
        while waiting:
            node = waiting.pop()
            name = node.attributes.get("id")
            if name and self.known.setdefault(name, node) is not node:
                self.twice.add(name)
            waiting += reversed(node.children)

    def content(self) -> list[Drawn | Lines]:
        """Return the outlines of all elements."""
        self._node(self.root, self.begin, 0)
        return self.outlines.content()

    def _node(self, node: Node, state: State, depth: int, used: bool = False) -> None:
        """Walk an element; a symbol only if a use refers to it."""
        self.source.spend(4)
        tag = node.tag
        if depth > DEEPEST:
            message = f"groups and references nested more than {DEEPEST} deep; flatten them"
            self.source.refuse(message, node.line, place=tag[:40])
        if node.space not in ("", SVG, self.root.space):
            if tag in FORMS:
                self.source.note("lost", f"{tag} of another namespace", "less")
            return
        if tag in _ANIMATIONS:
            self.source.note("warning", "animation: read as it stands without it", "unknown")
            return
        if tag in _UNDRAWN and not (used and tag == "symbol"):
            return
        declared = self.styles.declared(node)
        style = computed(state.style, declared)
        names = tuple(name for key in _NAMES if (name := node.attributes.get(key))) + state.names
        group = self.outlines.group(names) if names != state.names and tag not in FORMS else state.group
        state = replace(state, style=style, names=names, group=group)
        element = Element(self.source, node, state, declared)
        if style["display"].lower() == "none" and tag in FORMS:
            self._hide(element)
        elif style["display"].lower() == "none":
            self.source.note("hidden", f"hidden {tag[:40]}", "less", where=element.name)
        elif not applies(self.source, node):
            self.source.note("hidden", f"{tag[:40]} for other languages or programs", "less", where=element.name)
        else:
            try:
                self._drawn(self._placed(element), depth)
            except InvalidFileError:
                raise
            except ValueError as error:
                element.refuse(str(error)[:200])
            except ArithmeticError:
                element.refuse("a coordinate beyond 1e308; scale the drawing")

    def _hide(self, element: Element) -> None:
        try:
            element = self._placed(element)
        except (ValueError, ArithmeticError):
            return self.source.note("hidden", f"hidden {element.node.tag}", "less", where=element.name)
        self.outlines.hide(element)

    def _drawn(self, element: Element, depth: int) -> None:
        tag, state = element.node.tag, element.state
        a, b, c, d = state.frame[:4]
        if a * d == b * c:
            self.source.note("hidden", f"{tag[:40]} that its transform makes flat", "less", where=element.name)
        elif tag in FORMS:
            self.outlines.add(element)
        elif tag in _VIEWPORTS:
            inside = state if element.node is self.root else self._viewport(element)
            self._children(element.node, inside, depth)
        elif tag in ("g", "a"):
            self._children(element.node, state, depth)
        elif tag == "use":
            self._use(element, depth)
        elif tag == "switch":
            self._switch(element, depth)
        elif tag == "text":
            self.outlines.text(element)
        elif tag in _PICTURES:
            self.outlines.picture(element)
        else:
            self.source.note("lost", f"{tag[:40]}: no element that draws", "less", where=element.name)

    def _children(self, node: Node, state: State | None, depth: int) -> None:
        if state:
            for child in node.children:
                self._node(child, state, depth + 1)

    # matrix, viewport, clips

    def _placed(self, element: Element) -> Element:
        """Return an element with its transform, the size of its letters and its clips."""
        state, style, node = element.state, element.state.style, element.node
        if "font-size" in element.declared:
            state = replace(state, measure=replace(state.measure, em=self._em(element)))
        if "transform" in element.declared or "transform" in node.attributes:
            state = replace(state, frame=shortened(compose(state.frame, self._transform(element))))
        if id(node) in self.styles.unsure:
            state = replace(state, unsure=True)
        if style["opacity"].rstrip("%").strip("0.") == "":
            self.source.note("info", "element of opacity 0: read as drawn", "more", where=element.name)
        if style["animation"].lower() != "none" or style["animation-name"].lower() != "none":
            self.source.note("warning", "animation: read as it stands without it", "unknown")
        if style["clip-path"].lower() != "none":
            state = replace(state, clips=state.clips + self._clip_path(element, state))
        if style["mask"].lower() != "none":
            state = replace(state, clips=(*state.clips, Clip("mask")))
        return replace(element, state=state)

    def _em(self, element: Element) -> Fraction:
        """Return the size of letters, on which lengths in em and ex depend."""
        em = element.state.measure.em
        try:
            return Measure(em, em, em).length(Source(""), element.declared["font-size"], "x")
        except ValueError:  # a word
            return EM

    def _transform(self, element: Element) -> Affine:
        """Return the transform of an element, by CSS or by its attribute, about its origin."""
        style, declared = element.state.style, element.declared
        measure, (left, top) = element.state.measure, (Fraction(0), Fraction(0))
        if style["transform-box"].lower() != "view-box":
            measure, (left, top) = self._own_box(element, style["transform-box"].lower())

        def length(text: str, axis: Axis) -> Fraction:
            return measure.length(self.source, text, axis)

        try:
            if declared.get("transform"):
                by = css_map(declared["transform"], length)
            else:
                by = attribute_map(element.node.attributes.get("transform", ""))
            x, y = origin(style["transform-origin"], length) if style["transform-origin"] else (0, 0)
        except ValueError as error:
            raise ValueError(f"transform: {error}") from None
        return around(x + left, y + top, by) if x + left or y + top else by

    def _own_box(self, element: Element, box: str) -> tuple[Measure, tuple[Fraction, Fraction]]:
        """Return size and corner of an element's own box, which is not known of curved paths and groups."""
        parts = element.form(IDENTITY).parts()[0] if element.node.tag in FORMS else []
        rings = [part.segments for part in parts]
        simple = element.node.tag in ("rect", "circle", "ellipse")
        straight = all(isinstance(segment, Line) for ring in rings for segment in ring)
        if not rings or not (simple or straight) or box not in ("fill-box", "content-box"):
            raise ValueError(
                f"transform-box: {box} of curves, groups and strokes is not read; give the origin in numbers"
            )
        x0, y0, x1, y1 = extent(rings)
        return replace(element.state.measure, width=x1 - x0, height=y1 - y0), (x0, y0)

    def _viewport(self, element: Element) -> State | None:
        """Return the state inside of an inner svg or a symbol; None if it draws nothing."""
        state, node = element.state, element.node
        used, own, place = state.sizes or (None, None), element.sizes(), element.corner()
        if node.tag == "symbol" and (any(own) or any(place)):
            self.source.note("guess", "place or size of a symbol itself: not obeyed", "unknown", where=element.name)
            own, place = (None, None), (Fraction(0), Fraction(0))
        width = next((part for part in (used[0], own[0]) if part is not None), None)
        height = next((part for part in (used[1], own[1]) if part is not None), None)
        size = (
            state.measure.whole("x") if width is None else width,
            state.measure.whole("y") if height is None else height,
        )
        if min(size) < 0:
            raise ValueError("a size below 0; give one above 0")
        box = box_of_view(node)
        if not all(size) or (box and not all(box[2:])):
            self.source.note("hidden", f"{node.tag} of size 0", "less", where=element.name)
            return None
        clips = state.clips
        if state.style["overflow"].lower() not in ("visible", "auto"):
            clips += (convex_clip("viewport", corners_in(state.frame, place, size)),)
        by = fitted(place, size, box, node.attributes.get("preserveAspectRatio", "")) if box else translation(*place)
        inner = (box[2], box[3]) if box else size
        measure = replace(state.measure, width=inner[0], height=inner[1])
        return replace(state, frame=shortened(compose(state.frame, by)), measure=measure, clips=clips, sizes=None)

    def _clip_path(self, element: Element, state: State, depth: int = 0) -> tuple[Clip, ...]:
        """Return the clip that an element refers to, which may be unknown."""
        value = state.style["clip-path"]
        if depth > MOST_CLIPS or not value.lower().startswith("url("):
            return (Clip("clip-path"),)
        target = self._target(value[4:].split(")")[0].strip(" \"'"))
        if target is None or target.tag != "clipPath":
            self.source.note("info", "clip-path that is not in this file: no clip", where=element.name)
            return ()
        frame = state.frame
        if target.attributes.get("clipPathUnits") == "objectBoundingBox":
            try:
                measure, corner = self._own_box(element, "fill-box")
            except ValueError:
                return (Clip("clip-path"),)
            frame = compose(frame, fitted(corner, (measure.whole("x"), measure.whole("y")), _UNIT_BOX, "none"))
        key = id(target), frame
        if key not in self.clips:
            self.clips[key] = Clip("clip-path")  # as long as it is not known; for ever, if it refers to itself
            region = self._clip_region(target, replace(state, frame=frame, style=ROOT, clips=()), depth)
            self.clips[key] = Clip("clip-path", None if region is None else tuple(region))
        return (self.clips[key],)

    def _clip_region(self, node: Node, state: State, depth: int) -> list[Outline] | None:
        """Return the union of the shapes of a clipPath; None if some of them has no known outline."""
        self.source.spend(4)
        declared = self.styles.declared(node)
        style = computed(state.style, declared)
        if depth > MOST_CLIPS or style["mask"].lower() != "none" or node.tag == "text":
            return None
        if node.tag in _UNDRAWN - {"clipPath"} | _ANIMATIONS or style["display"].lower() == "none":
            return []
        state = replace(state, style=style, clips=())
        element = Element(self.source, node, state, declared)
        if "transform" in declared or "transform" in node.attributes:
            state = replace(state, frame=shortened(compose(state.frame, self._transform(element))))
        region: list[Outline] = []
        if node.tag in FORMS:
            parts, fault = Element(self.source, node, state, declared).form().parts()
            rings = [closed_by_a_line(part) for part in parts]
            if fault is not None:
                return None
            if rings and style["visibility"].lower() == "visible":
                region = filled_outlines(self.source, rings, style["clip-rule"].lower() == "evenodd")
        elif node.tag in ("clipPath", "use"):
            inside: list[Node | None] = [*node.children]
            if node.tag == "use":
                inside = [self._target(node.attributes.get("href", ""))]
                state = replace(state, frame=compose(state.frame, translation(*element.corner())))
            for child in inside:
                part = self._clip_region(child, state, depth + 1) if child else []
                if part is None:
                    return None
                region += part
        else:
            return None
        if style["clip-path"].lower() != "none":
            for clip in self._clip_path(replace(element, state=state), state, depth + 1):
                if clip.region is None:
                    return None
                region = clipped(self.source, region, clip.region)
        return region

    # references and branches

    def _target(self, link: str) -> Node | None:
        name = link.strip()[1:] if link.strip().startswith("#") else ""
        if name in self.twice:
            self.source.note("warning", "id that is there twice: the first one is used", "unknown", where=name)
        return self.known.get(name)

    def _use(self, element: Element, depth: int) -> None:
        self.source.spend(USING)
        link = element.node.attributes.get("href", "")
        target = self._target(link)
        if target is None:
            what = "use of an element that is not in this file"
            self.source.note("lost", what, "less", where=link[:60], at=None, handle=element.handle)
            return
        if (count := self._expanded(target)) > MOST_STEPS:
            self.source.spend(count)
        sizes = element.sizes() if target.tag in _VIEWPORTS else None
        frame = compose(element.state.frame, translation(*element.corner()))
        self._node(target, replace(element.state, frame=frame, sizes=sizes), depth + 1, used=True)

    def _expanded(self, node: Node, depth: int = 0) -> int:
        """Return the number of elements in an element with all uses expanded, so that a bomb is refused at once."""
        if depth > DEEPEST:
            return 1
        if id(node) not in self.expanded:
            self.expanded[id(node)] = 1  # for references in a circle
            parts = [child for child in node.children if child.tag not in _UNDRAWN]
            if node.tag == "use" and (target := self.known.get(node.attributes.get("href", "").strip()[1:])):
                parts.append(target)
            self.expanded[id(node)] = 1 + sum(self._expanded(part, depth + 1) for part in parts)
        return self.expanded[id(node)]

    def _switch(self, element: Element, depth: int) -> None:
        """Walk the first branch that applies."""
        branches = [child for child in element.node.children if child.tag not in _UNDRAWN | _ANIMATIONS]
        chosen = next((child for child in branches if applies(self.source, child)), None)
        others = len(branches) - (chosen is not None)
        self.source.note("hidden", "branch of a switch", "less", count=others, where=element.name)
        if chosen is not None:
            self._node(chosen, element.state, depth + 1)
