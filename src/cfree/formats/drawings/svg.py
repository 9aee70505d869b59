"""Read SVG: closed outlines of paths and basic shapes, in the root's user units or in the unit of its width.

This module walks the elements, with limits; svgelements reads path data, transforms and lengths. y points upwards in a
scene, so (x, y) of the drawing is (x, -y) there. Roles come from ``data-role``, labels, ids and classes of elements and
of the groups around them; a circle with the role ``pivot`` marks the robot's reference point.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import pi, tau
from typing import Any

from cfree.curves.drawn import (
    IDENTITY,
    Affine,
    Arc,
    Cubic,
    Line,
    Ring,
    carried,
    compose,
    decimal,
    point_of,
    polyline,
    quadratic,
    translation,
)
from cfree.exact.number import to_fraction
from cfree.formats.drawings.content import Drawn
from cfree.formats.drawings.outlines import shapes_of_drawing
from cfree.formats.drawings.source import DEEPEST, Source
from cfree.formats.drawings.xml_tree import Node, read_tree
from cfree.formats.scenes.scene_settings import read_settings
from cfree.formats.shapes import Shapes
from cfree.formats.text.extras import needed
from cfree.formats.text.findings import InvalidFileError

_HIDDEN = {"defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata", "style", "title", "desc", "namedview"}
_GROUPS = {"svg", "g", "a", "switch"}
_FORMS = {"path", "rect", "circle", "ellipse", "polygon", "polyline", "line"}
_LENGTH = re.compile(r"\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?)\s*(px|mm|cm|in|pt|pc|Q|m)?\s*")
_TRANSFORM = re.compile(r"\s*(?:(?:matrix|translate|scale|rotate|skewX|skewY)\s*\([^()]*\)[\s,]*)*+")
_FLIP: Affine = (Fraction(1), Fraction(0), Fraction(0), Fraction(-1), Fraction(0), Fraction(0))
MOST_CHARACTERS = 1 << 22
"""Maximum length of one path."""


def read_svg(source: Source) -> Shapes:
    """Read the outlines of a drawing."""
    library = needed("svgelements", "svg", "SVG")
    root = read_tree(source)
    if root.tag != "svg":
        source.refuse(f"expected an element svg, got {root.tag[:40]}; give SVG", root.line)
    scale, unit = _scale(source, root)
    walk = _Walk(source, library, root)
    drawn = list(walk.drawn(root, compose(_FLIP, scale), []))
    settings = _settings(source, root) if "data-cfree" in root.attributes else {"units": unit}
    remedy = 'call a group, a layer or an element "robot"'
    return shapes_of_drawing(source, "SVG", drawn, settings, remedy)


def _settings(source: Source, root: Node) -> dict[str, Any]:
    try:
        data = json.loads(root.attributes["data-cfree"])
    except (ValueError, RecursionError):
        source.findings.at(0, "svg.data-cfree", "no JSON; leave it out")
        return {}
    return read_settings(source.findings, data, ("svg", "data-cfree"))


def _scale(source: Source, root: Node) -> tuple[Affine, str]:
    """Return the map from user units to the unit of the drawing's width, and that unit."""
    box = _words(root.attributes.get("viewBox", ""))
    width, height = (_LENGTH.fullmatch(root.attributes.get(key, "")) for key in ("width", "height"))
    if not width or not width[2] or width[2] == "px" or len(box) != 4:
        return IDENTITY, "px"
    try:
        x = decimal(float(width[1])) / decimal(float(box[2]))
        y = decimal(float(height[1])) / decimal(float(box[3])) if height and height[2] == width[2] else x
        if x <= 0 or y <= 0:
            raise ValueError
    except (ValueError, ZeroDivisionError):
        source.refuse("viewBox, width and height do not fit; give sizes above 0", root.line)
    if x != y and root.attributes.get("preserveAspectRatio", "").strip() != "none":
        x = y = min(x, y)
    if x != 1:
        source.note("info", f"a user unit is {float(x):g} {width[2]}")
    return (x, Fraction(0), Fraction(0), y, Fraction(0), Fraction(0)), width[2]


@dataclass
class _Walk:
    """Walk the elements below the root."""

    source: Source
    library: Any
    root: Node

    def __post_init__(self) -> None:
        self.known: dict[str, Node] = {}
        waiting = [self.root]
        while waiting:
            node = waiting.pop()
            if "id" in node.attributes:
                self.known.setdefault(node.attributes["id"], node)
            waiting += node.children

    def drawn(self, node: Node, outer: Affine, names: list[str], depth: int = 0, used: bool = False) -> Iterator[Drawn]:
        """Yield outlines with the names that give their roles, the innermost first."""
        self.source.spend(4)
        if depth > DEEPEST:
            self.source.refuse(f"groups and references nested more than {DEEPEST} deep; flatten them", node.line)
        if _invisible(node):
            self.source.note("lost", f"hidden {node.tag}", "less")
            return
        if node.tag in _HIDDEN and not (used and node.tag == "symbol"):
            if node.tag == "style":
                self.source.note("lost", "style sheet: not applied, so it hides and moves nothing", "less")
            return
        frame = compose(outer, self._transform(node)) if "transform" in node.attributes else outer
        names = [
            name for key in ("data-role", "label", "data-name", "id", "class") if (name := node.attributes.get(key))
        ] + names
        if node.tag in _GROUPS or node.tag == "symbol":
            if node is not self.root and node.tag in ("svg", "symbol"):
                frame = compose(frame, self._placed(node))
            for child in node.children:
                yield from self.drawn(child, frame, names, depth + 1)
        elif node.tag == "use":
            yield from self._used(node, frame, names, depth)
        elif node.tag in _FORMS:
            try:
                rings = self._rings(node)
            except InvalidFileError:
                raise
            except Exception as error:  # svgelements raises errors of many types
                reason = str(error)[:80] or type(error).__name__
                self.source.refuse(f"{reason}; mend it", node.line, place=node.tag)
            style = node.attributes.get("style", "")
            rule = re.search(r"fill-rule\s*:\s*(\w+)", style)
            even = (rule[1] if rule else node.attributes.get("fill-rule", "")) == "evenodd"
            try:
                placed = [carried(ring, frame) for ring in rings]
            except OverflowError:
                self.source.refuse("a coordinate beyond 1e308; scale the drawing", node.line, place=node.tag)
            yield Drawn(placed, tuple(names), node.line, even)
        else:
            self.source.note("lost", f"{node.tag[:40]}: no outline", "less")

    def _used(self, node: Node, frame: Affine, names: list[str], depth: int) -> Iterator[Drawn]:
        link = node.attributes.get("href", "")
        target = self.known.get(link[1:]) if link.startswith("#") else None
        if target is None:
            self.source.note("lost", f"use: {link[:60]!r} is not in this file", "less")
            return
        x, y = (self._number(node, key) for key in ("x", "y"))
        moved = compose(frame, translation(x, y))
        yield from self.drawn(target, moved, names, depth + 1, used=True)

    def _transform(self, node: Node) -> Affine:
        if not _TRANSFORM.fullmatch(node.attributes["transform"]):
            text = node.attributes["transform"][:60]
            self.source.refuse(
                f"transform: {text!r}; write it like translate(1 2) rotate(30)", node.line, place=node.tag
            )
        try:
            m = self.library.Matrix(node.attributes["transform"])
            a, b, c, d, e, f = (decimal(float(value)) for value in (m.a, m.b, m.c, m.d, m.e, m.f))
        except Exception as error:
            self.source.refuse(f"transform: {str(error)[:80]}; mend it", node.line, place=node.tag)
        return a, b, c, d, e, f

    def _placed(self, node: Node) -> Affine:
        """Return the map of an inner svg."""
        x, y = (self._number(node, key) for key in ("x", "y"))
        box = _words(node.attributes.get("viewBox", ""))
        if len(box) != 4:
            return translation(x, y)
        size = [node.attributes.get(key, box[k]) for k, key in ((2, "width"), (3, "height"))]
        try:
            text = self.library.Viewbox.viewbox_transform(
                float(x), float(y), *(float(self.library.Length(part)) for part in size),
                *map(float, box), node.attributes.get("preserveAspectRatio"),
            )  # fmt: skip
        except Exception as error:
            self.source.refuse(f"viewBox: {str(error)[:80]}; mend it", node.line, place=node.tag)
        return self._transform(Node(node.tag, {"transform": text}, node.line))

    def _number(self, node: Node, key: str, default: str = "0") -> Fraction:
        """Return a length in user units, 96 an inch."""
        text = node.attributes.get(key, default)
        match = _LENGTH.fullmatch(text)
        if not match:
            self.source.refuse(
                f"{key}: {text[:60]!r} is no length; write it like 10 or 2.5mm", node.line, place=node.tag
            )
        value = to_fraction(match[1])
        return value * _UNITS[match[2] or "px"]

    def _rings(self, node: Node) -> list[Ring]:
        """Return the closed rings of an element; drop open ones, with a note."""

        def number(key: str, default: str = "0") -> Fraction:
            return self._number(node, key, default)

        def size(key: str) -> Fraction | None:
            text = node.attributes.get(key, "auto")
            return None if text.strip() == "auto" else number(key)

        self.source.spend(1 + sum(map(len, node.attributes.values())) // 16)
        if node.tag == "line":
            self.source.note("lost", "line: it forbids nothing", "less")
            return []
        if node.tag in ("circle", "ellipse"):
            rx, ry = (number("r"),) * 2 if node.tag == "circle" else (size("rx"), size("ry"))
            rx, ry = _radii(rx, ry)
            return [_ellipse(number("cx"), number("cy"), rx, ry)] if rx > 0 and ry > 0 else []
        if node.tag == "rect":
            x, y, w, h = (number(key) for key in ("x", "y", "width", "height"))
            return _rectangle(x, y, w, h, size("rx"), size("ry"))
        if node.tag in ("polygon", "polyline"):
            values = [to_fraction(text) for text in _words(node.attributes.get("points", ""))]
            points = list(zip(values[::2], values[1::2], strict=False))
            if node.tag == "polyline" and points[:1] != points[-1:]:
                self.source.note("lost", "open polyline: it forbids nothing", "less")
                return []
            return [polyline(points)] if len(points) > 2 else []
        text = node.attributes.get("d", "")
        if len(text) > MOST_CHARACTERS:
            raise ValueError("a path of more than 4 MiB; cut it into several")
        if len(re.findall("[zZ]", text)) > len(re.findall("[mM]", text)) + 100:  # svgelements looks back from each
            raise ValueError("a path that closes more often than it begins")
        return self._path(text)

    def _path(self, text: str) -> list[Ring]:
        rings: list[Ring] = []
        ring: Ring = []
        begin: Any = None
        lib = self.library
        for item in lib.Path(text):
            self.source.spend()
            if isinstance(item, lib.Move):
                self._drop(ring)
                ring, begin = [], item.end
                continue
            closes = isinstance(item, lib.Close)
            if item.start is not None and item.end is not None:
                ring += _line(item) if closes else _segment(lib, item)
            if ring and (closes or point_of(item.end.x, item.end.y) == point_of(begin.x, begin.y)):
                rings.append(ring)
                ring = []
        self._drop(ring)
        return rings

    def _drop(self, ring: Ring) -> None:
        if ring:
            self.source.note("lost", "open path: it forbids nothing; close it, or make its stroke a path", "less")


_UNITS = {
    "px": Fraction(1), "in": Fraction(96), "cm": Fraction(9600, 254), "mm": Fraction(960, 254),
    "m": Fraction(960000, 254), "Q": Fraction(240, 254), "pt": Fraction(4, 3), "pc": Fraction(16),
}  # fmt: skip


def _invisible(node: Node) -> bool:
    style = node.attributes.get("style", "").replace(" ", "")
    return (
        node.attributes.get("display") == "none"
        or node.attributes.get("visibility") in ("hidden", "collapse")
        or "display:none" in style
        or "visibility:hidden" in style
    )


def _line(item: Any) -> Ring:
    a, b = point_of(item.start.x, item.start.y), point_of(item.end.x, item.end.y)
    return [Line(a, b)] if a != b else []


def _segment(lib: Any, item: Any) -> Ring:
    """Convert a segment of svgelements; return nothing if it has no length."""
    if isinstance(item, lib.Line):
        return _line(item)

    def point(p: Any) -> tuple[float, float]:
        return float(p.x), float(p.y)

    if isinstance(item, lib.QuadraticBezier):
        return [quadratic(point(item.start), point(item.control), point(item.end))]
    if isinstance(item, lib.CubicBezier):
        return [Cubic((point(item.start), point(item.control1), point(item.control2), point(item.end)))]
    if isinstance(item, lib.Arc):
        if not item.rx or not item.ry:
            return _line(item)
        c, first = point(item.center), float(item.get_start_t())
        u, v = (((p.x - c[0]), (p.y - c[1])) for p in (item.prx, item.pry))
        return [Arc(c, u, v, first, first + float(item.sweep))]
    raise ValueError(f"{type(item).__name__} in a path")


def _radii(rx: Fraction | None, ry: Fraction | None) -> tuple[Fraction, Fraction]:
    """Return both radii; a missing one equals the other."""
    return rx if rx is not None else ry or Fraction(0), ry if ry is not None else rx or Fraction(0)


def _words(text: str) -> list[str]:
    """Split a list at blanks and commas."""
    return [word for word in re.split(r"[\s,]+", text) if word]


def _ellipse(cx: Fraction, cy: Fraction, rx: Fraction, ry: Fraction) -> Ring:
    return [Arc((float(cx), float(cy)), (float(rx), 0.0), (0.0, float(ry)), 0.0, tau)]


def _rectangle(
    x: Fraction, y: Fraction, w: Fraction, h: Fraction, rx: Fraction | None, ry: Fraction | None
) -> list[Ring]:
    """Return a rectangle with round or sharp corners."""
    if w <= 0 or h <= 0:
        return []
    rx, ry = _radii(rx, ry)
    rx, ry = min(rx, w / 2), min(ry, h / 2)
    if rx <= 0 or ry <= 0:
        return [polyline([(x, y), (x + w, y), (x + w, y + h), (x, y + h)])]
    left, right, low, high = x + rx, x + w - rx, y + ry, y + h - ry
    corners = [
        ((right, y), (right, low), (x + w, low)),
        ((x + w, high), (right, high), (right, y + h)),
        ((left, y + h), (left, high), (x, high)),
        ((x, low), (left, low), (left, y)),
    ]
    ring: Ring = []
    before = corners[-1][2]
    for k, (begin, center, end) in enumerate(corners):
        if before != begin:
            ring.append(Line(before, begin))
        c, first = (float(center[0]), float(center[1])), (k - 1) * pi / 2
        ring.append(Arc(c, (float(rx), 0.0), (0.0, float(ry)), first, first + pi / 2))
        before = end
    return [ring]
