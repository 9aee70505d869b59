"""Read URDF: the footprint of a robot, all collision geometry seen from above.

It reads boxes, cylinders and spheres of all links, joints at 0, in the root link's frame: x forward, y to the left.
Each becomes the convex polygon around its projection on the ground, and all of them move together. If the collision
geometry of a link has none of these, its visual geometry is read.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.curves.drawn import point_of
from cfree.errors import InvalidPolygonError
from cfree.exact.number import to_fraction
from cfree.formats.drawings.nav2 import ROBOT_FRAME
from cfree.formats.drawings.source import CURVE_SHARE, Source, shapes_of
from cfree.formats.drawings.strokes import sides_around
from cfree.formats.drawings.xml_tree import Node, read_tree
from cfree.formats.padding import padded
from cfree.formats.shapes import IGNORE, Shape, Shapes
from cfree.polygons.hull import convex_hull
from cfree.polygons.polygon import Polygon

Matrix = NDArray[np.float64]
_SAFE = 1 + 1e-9  # scale of polygons around circles, far above rounding errors of doubles


def read_urdf(source: Source) -> Shapes:
    """Read the robot."""
    root = read_tree(source)
    if root.tag != "robot":
        source.refuse(f"expected an element robot, got {root.tag[:40]}; give URDF", root.line)
    links = list(_links(source, root))
    solids = [solid for link, matrix in links for solid in _of_link(source, link, matrix)]
    round_ones = [solid for solid in solids if len(solid) == 3]
    corners = [p for solid in solids for p in _corners(solid, 4)]
    size = max((np.ptp([p[k] for p in corners]) for k in (0, 1)), default=0.0) if corners else 0.0
    tolerance = source.reading.tolerance or float(size) / CURVE_SHARE or 1.0
    padding = to_fraction(source.reading.padding)
    shapes: list[Shape] = []
    for solid in solids:
        name = solid[0]
        radius = max((math.hypot(*u) for u in solid[2]), default=0.0) * 2 if len(solid) == 3 else 0.0
        sides = max(4, math.ceil(sides_around(tolerance / radius))) if radius else 7
        source.spend(sides)
        points = _corners(solid, sides)
        try:
            outline = Polygon(convex_hull(point_of(*map(float, p)) for p in points))
        except (InvalidPolygonError, ValueError):
            source.note("lost", "shape without an area from above", "less", where=name)
        else:
            shapes += [Shape("robot", None, part) for part in padded(source, outline, padding)]
    what = "polygon around a round shape"
    source.note("near", what, "near", count=len(round_ones), size=tolerance, remedy="--tolerance")
    remedy = "its links have no box, cylinder or sphere as collision geometry; add one"
    if not shapes:
        source.findings.at(0, "", f"there is no robot; {remedy}")
    settings = {"units": "m", "source": {ROBOT_FRAME: links[0][0].attributes.get("name", "")}}
    return shapes_of(source, "URDF", shapes, settings, remedy)


def _children(node: Node, tag: str) -> list[Node]:
    return [child for child in node.children if child.tag == tag]


def _links(source: Source, root: Node) -> Iterator[tuple[Node, Matrix]]:
    """Yield links with their transforms to the root link's frame, joints at 0."""
    links = {link.attributes.get("name", ""): link for link in _children(root, "link")}
    below: dict[str, list[tuple[str, Matrix]]] = {}
    carried: set[str] = set()
    for joint in _children(root, "joint"):
        parent, child = (
            next((part.attributes.get("link", "") for part in _children(joint, tag)), "") for tag in ("parent", "child")
        )
        if parent not in links or child not in links or child in carried:
            message = f"joint {joint.attributes.get('name', '')}: its links are not there, or joined twice; mend it"
            source.refuse(message, joint.line)
        carried.add(child)
        below.setdefault(parent, []).append((child, _origin(source, joint)))
        if joint.attributes.get("type") not in ("fixed", None):
            source.note("info", "moving joint at 0", "unknown")
    tops = [name for name in links if name not in carried]
    if len(tops) != 1:
        source.refuse(f"{len(tops)} root links; join the links to one tree", root.line)
    waiting: list[tuple[str, Matrix]] = [(tops[0], np.eye(4))]
    while waiting:
        name, matrix = waiting.pop()
        source.spend()
        yield links[name], matrix
        waiting += [(child, matrix @ step) for child, step in reversed(below.get(name, []))]


def _numbers(source: Source, node: Node, key: str, count: int, default: str | None = None) -> list[float]:
    text = node.attributes.get(key, default)
    try:
        values = [float(part) for part in (text or "").split()]
    except ValueError:
        values = []
    if len(values) != count or not all(-1e6 < value < 1e6 for value in values):
        what = "a number" if count == 1 else f"{count} numbers"
        source.refuse(f"{key}: {(text or '')[:60]!r}; give {what}", node.line, place=node.tag)
    return values


def _origin(source: Source, node: Node) -> Matrix:
    """Return the transform of an origin: roll, pitch and yaw about fixed axes, then the translation."""
    origins = _children(node, "origin")
    matrix = np.eye(4)
    if origins:
        roll, pitch, yaw = _numbers(source, origins[0], "rpy", 3, "0 0 0")
        matrix[:3, :3] = _turn(2, yaw) @ _turn(1, pitch) @ _turn(0, roll)
        matrix[:3, 3] = _numbers(source, origins[0], "xyz", 3, "0 0 0")
    return matrix


_QUARTER = 1e-4
"""Tolerance in radians of multiples of a quarter turn: URDF files write 1.5708 for one."""


def _turn(axis: int, angle: float) -> Matrix:
    c, s = math.cos(angle), math.sin(angle)
    if abs(math.remainder(angle, math.pi / 2)) < _QUARTER:
        c, s = float(round(c)), float(round(s))
    matrix = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = -s, s
    return matrix


Solid = tuple[Any, ...]
"""Name and corners seen from above; for round solids centers, and two conjugate radii for each."""


def _of_link(source: Source, link: Node, matrix: Matrix) -> list[Solid]:
    """Return the solids of a link: of its collision geometry, else of its visual geometry."""
    name = link.attributes.get("name", "")
    if source.wanted_role(name) == IGNORE:
        source.note("assumption", "ignored link", "less", where=name)
        return []
    for tag in ("collision", "visual"):
        solids = [solid for node in _children(link, tag) for solid in _solids(source, link, node, matrix)]
        if solids:
            if tag == "visual":
                what = "visual shape in place of collision shapes"
                source.note("guess", what, "more", count=len(solids), where=name, remedy=f'--role "{name}=ignore"')
            return solids
    return []


def _solids(source: Source, link: Node, collision: Node, outer: Matrix) -> Iterator[Solid]:
    matrix = outer @ _origin(source, collision)
    name = link.attributes.get("name", "")
    for geometry in _children(collision, "geometry"):
        for form in geometry.children:
            if form.tag == "box":
                size = _numbers(source, form, "size", 3)
                corners = [[(-1) ** (k >> i & 1) * size[i] / 2 for i in range(3)] + [1] for k in range(8)]
                yield name, [tuple((matrix @ corner)[:2]) for corner in np.array(corners)]
            elif form.tag == "cylinder":
                (radius,), (length,) = (_numbers(source, form, key, 1) for key in ("radius", "length"))
                ends = [matrix @ np.array([0, 0, z * length / 2, 1]) for z in (-1, 1)]
                yield name, [tuple(end[:2]) for end in ends], [tuple(matrix[:2, k] * radius) for k in (0, 1)]
            elif form.tag == "sphere":
                (radius,) = _numbers(source, form, "radius", 1)
                yield name, [tuple(matrix[:2, 3])], [(radius, 0.0), (0.0, radius)]
            else:
                what = "unread mesh" if form.tag == "mesh" else "unread geometry"
                source.note("lost", what, "less", where=name)


def _corners(solid: Solid, count: int) -> list[tuple[float, float]]:
    """Return corners; those of round solids are the meeting points of tangents at equal steps."""
    if len(solid) == 2:
        return list(solid[1])
    _, centers, (u, v) = solid
    scale = _SAFE / math.cos(math.pi / count)
    turns = [(math.cos(t) * scale, math.sin(t) * scale) for t in np.arange(count) * math.tau / count + math.pi / count]
    return [(x + u[0] * c + v[0] * s, y + u[1] * c + v[1] * s) for x, y in centers for c, s in turns]
