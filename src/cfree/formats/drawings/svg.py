"""Read SVG: outlines of paths and basic shapes, in the root's user units or in the unit of its width.

y points upwards in a scene, so (x, y) of the drawing is (x, -y) there. Roles come from ``data-role``, labels, ids and
classes of elements and of the groups around them; a circle with the role ``pivot`` marks the robot's reference point.

The steps: `xml_tree` reads the elements, `svg_style` the style sheets, `svg_walk` goes from element to element, with
`svg_transforms`, `svg_lengths` and `svg_clips`; `svg_forms` and `svg_paths` give outlines.
"""

from __future__ import annotations

import json
from fractions import Fraction
from typing import Any

from cfree.curves.drawn import IDENTITY, Affine, compose
from cfree.formats.drawings.outlines import shapes_of_drawing
from cfree.formats.drawings.signals import ask
from cfree.formats.drawings.source import Source
from cfree.formats.drawings.svg_lengths import UNITS, Measure, unit_of
from cfree.formats.drawings.svg_viewports import box_of_view
from cfree.formats.drawings.svg_walk import Walk
from cfree.formats.drawings.xml_tree import Node, read_tree
from cfree.formats.scenes.scene_settings import read_settings
from cfree.formats.shapes import Shapes

_FLIP: Affine = (Fraction(1), Fraction(0), Fraction(0), Fraction(-1), Fraction(0), Fraction(0))


def read_svg(source: Source) -> Shapes:
    """Read the outlines of a drawing."""
    root = read_tree(source)
    if root.tag != "svg":
        source.refuse(f"expected an element svg, got {root.tag[:40]}; give SVG", root.line)
    try:
        scale, unit, size = _scale(source, root)
    except (ValueError, ZeroDivisionError) as error:
        source.refuse(f"{error}", root.line, place="svg")
    content = Walk(source, root, compose(_FLIP, scale), size).content()
    ask(source, content)
    settings = _settings(source, root) if "data-cfree" in root.attributes else {"units": unit}
    remedy = 'call a group, a layer or an element "robot"'
    return shapes_of_drawing(source, "SVG", content, settings, remedy)


def _settings(source: Source, root: Node) -> dict[str, Any]:
    try:
        data = json.loads(root.attributes["data-cfree"])
    except (ValueError, RecursionError):
        source.findings.at(0, "svg.data-cfree", "no JSON; leave it out")
        return {}
    return read_settings(source.findings, data, ("svg", "data-cfree"))


def _scale(source: Source, root: Node) -> tuple[Affine, str, Measure]:
    """Return the map from user units to the unit of the drawing's width, that unit, and the viewport's size."""
    box = box_of_view(root)
    width, height = (unit_of(root.attributes.get(key, "")) for key in ("width", "height"))
    size = Measure(box[2], box[3]) if box and all(box[2:]) else Measure(_pixels(width), _pixels(height))
    if not width or width[1] in ("", "px") or not box:
        return IDENTITY, "px", size
    if not all(box[2:]) or width[0] <= 0 or (height and height[0] <= 0):
        raise ValueError("viewBox, width and height do not fit; give sizes above 0")
    x = width[0] / box[2]
    y = height[0] / box[3] if height and height[1] == width[1] else x
    aspect = root.attributes.get("preserveAspectRatio", "")
    if x != y and aspect.strip() != "none":
        x = y = max(x, y) if "slice" in aspect else min(x, y)
    if x != 1:
        source.note("info", f"a user unit is {float(x):g} {width[1]}")
    return (x, Fraction(0), Fraction(0), y, Fraction(0), Fraction(0)), width[1], size


def _pixels(length: tuple[Fraction, str] | None) -> Fraction | None:
    return length[0] * UNITS[length[1].lower() or "px"] if length else None
