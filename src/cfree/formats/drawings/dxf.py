"""Read DXF: closed outlines of the model space, with the layer as role and name; ezdxf reads the file.

It reads polylines with bulges, circles, ellipses, splines, solids, hatches, and lines and arcs of one layer that join
to rings; it expands blocks. A ring inside another ring of its layer is a hole. Frame and unit are the drawing's.
"""

from __future__ import annotations

import json
import logging
import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from io import BytesIO
from typing import Any

from cfree.curves.drawn import (
    Affine,
    Arc,
    Cubic,
    Line,
    Ring,
    Segment,
    Vector,
    arc_of_circle,
    bulged,
    carried,
    ends,
    point_of,
    polyline,
    quadratic,
    reversed_ring,
)
from cfree.exact.number import ExactPoint
from cfree.formats.drawings.content import Curve, Drawn, Lines
from cfree.formats.drawings.outlines import shapes_of_drawing
from cfree.formats.drawings.source import DEEPEST, Source, read_bytes
from cfree.formats.scenes.scene_settings import read_settings
from cfree.formats.shapes import Shapes
from cfree.formats.text.extras import needed
from cfree.formats.text.findings import InvalidFileError
from cfree.words import counted

UNITS = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m", 7: "km", 10: "yd", 14: "dm"}
"""Units by their codes in $INSUNITS."""
PROPERTY = "cfree"
"""The property of the file that holds the settings of a scene, as JSON."""
MOST_BYTES = 1 << 25


def read_dxf(source: Source) -> Shapes:
    """Read the outlines of a drawing."""
    needed("ezdxf", "dxf", "DXF")
    from ezdxf import recover

    logging.getLogger("ezdxf").addHandler(logging.NullHandler())  # its repairs are counted below

    raw = read_bytes(source.findings.file, MOST_BYTES)
    try:
        document, audit = recover.read(BytesIO(raw))
        unit = UNITS.get(document.header.get("$INSUNITS", 0), "")
        text = next((value for tag, value in document.header.custom_vars if tag == PROPERTY), "{}")
        hidden = {layer.dxf.name.lower() for layer in document.layers if layer.is_off() or layer.is_frozen()}
        entities = list(document.modelspace())
    except Exception as error:  # a damaged file raises any of them
        source.refuse(f"{str(error)[:100] or type(error).__name__}; give DXF")
    if audit.fixes:
        source.note("info", "faults of the file, mended by ezdxf", count=len(audit.fixes))
    walk = _Walk(source, hidden)
    walk.all(entities, None, 0)
    drawn = list(walk.drawn())
    try:
        data = json.loads(text)
    except (ValueError, RecursionError):
        data = {}
    settings = {"units": unit} if unit else {}
    settings |= read_settings(source.findings, data, (PROPERTY,))
    return shapes_of_drawing(source, "DXF", drawn, settings, 'call a layer "robot"')


class _Walk:
    """The rings of a drawing by layer."""

    def __init__(self, source: Source, hidden: set[str]) -> None:
        self.source = source
        self.hidden = hidden
        self.closed: dict[str, list[Ring]] = defaultdict(list)
        self.open: dict[str, Ring] = defaultdict(list)
        self.filled: list[Drawn] = []

    def all(self, entities: Iterable[Any], block_layer: str | None, depth: int) -> None:
        """Read entities of the model space or of a block; a block's layer 0 is the layer of its reference."""
        if depth > DEEPEST:
            self.source.refuse(f"blocks nested more than {DEEPEST} deep; explode them")
        for entity in entities:
            self.source.spend()
            kind = entity.dxftype()
            try:
                layer = str(entity.dxf.get("layer", "0"))
                layer = block_layer if layer == "0" and block_layer is not None else layer
                if layer.lower() in self.hidden:
                    self.source.note("lost", f"{kind} on layer {layer}, which is off", "less")
                elif kind == "INSERT":
                    self.block(entity, layer, depth)
                elif kind in _READERS:
                    _READERS[kind](self, entity, layer)
                else:
                    self.source.note("lost", f"{kind}: no outline", "less")
            except InvalidFileError:
                raise
            except Exception as error:  # ezdxf raises errors of many types
                self.source.note("lost", f"{kind}: {str(error)[:80] or type(error).__name__}", "less")

    def block(self, entity: Any, layer: str, depth: int) -> None:
        copies = entity.multi_insert() if entity.mcount > 1 else (entity,)
        if entity.mcount > 1:
            self.source.spend(entity.mcount)
        for copy in copies:
            self.all(copy.virtual_entities(), layer, depth + 1)

    def drawn(self) -> Iterator[Drawn | Lines]:
        """Yield the rings that are filled together: those of each layer, and each hatch."""
        for layer in dict.fromkeys([*self.closed, *self.open]):
            curves = [Curve(ring, True) for ring in self.closed[layer] if ring]
            curves += [Curve([piece]) for piece in self.open[layer]]
            yield Lines(curves, (layer,))
        yield from self.filled

    def goes_on(self, layer: str, pieces: Ring) -> None:
        """Keep pieces with two ends for joining; raise a ValueError if an end is no point."""
        for piece in pieces:
            for end in ends(piece):
                _joint(end)
        self.open[layer] += pieces

    # entities

    def line(self, entity: Any, layer: str) -> None:
        a, b = (point_of(p.x, p.y) for p in (entity.dxf.start, entity.dxf.end))
        if a != b:
            self.goes_on(layer, [Line(a, b)])

    def arc(self, entity: Any, layer: str) -> None:
        arc = _arc(entity.dxf.center, entity.dxf.radius, (entity.dxf.start_angle, entity.dxf.end_angle))
        self.goes_on(layer, _in_plane(entity, [arc]))

    def circle(self, entity: Any, layer: str) -> None:
        if entity.dxf.radius > 0:
            self.closed[layer].append(_in_plane(entity, [_arc(entity.dxf.center, entity.dxf.radius, (0, 360))]))

    def ellipse(self, entity: Any, layer: str) -> None:
        c, u, v = entity.dxf.center, entity.dxf.major_axis, entity.minor_axis
        first, last = float(entity.dxf.start_param), float(entity.dxf.end_param)
        sweep = (last - first) % math.tau
        whole = sweep < 1e-9 or sweep > math.tau - 1e-9
        arc = Arc((c.x, c.y), (u.x, u.y), (v.x, v.y), first, first + (math.tau if whole else sweep))
        if whole:
            self.closed[layer].append([arc])
        else:
            self.goes_on(layer, [arc])

    def polyline(self, entity: Any, layer: str) -> None:
        """Read an LWPOLYLINE, or a POLYLINE in the plane."""
        if entity.dxftype() == "POLYLINE":
            if not entity.is_2d_polyline:
                self.source.note("lost", "POLYLINE in space: no outline", "less")
                return
            corners = [(v.dxf.location.x, v.dxf.location.y, v.dxf.get("bulge", 0.0)) for v in entity.vertices]
            closed = entity.is_closed
        else:
            corners, closed = list(entity.get_points("xyb")), entity.closed
            if entity.dxf.get("const_width", 0.0):
                self.source.note("lost", "width of polylines", "less")
        self.source.spend(len(corners))
        ring = _in_plane(entity, _bulged_ring(corners, closed))
        if not (closed or (len(corners) > 2 and corners[0][:2] == corners[-1][:2])):
            self.goes_on(layer, ring)
        elif ring:
            self.closed[layer].append(ring)

    def spline(self, entity: Any, layer: str) -> None:
        curve = entity.construction_tool()
        self.source.spend(curve.count)
        if curve.degree > 3 or curve.is_rational:
            self.source.note("info", "SPLINE with weights or of a degree above 3: Bezier curves through its points")
            pieces: Iterable[Any] = (piece.control_points for piece in curve.cubic_bezier_approximation(level=8))
        else:
            pieces = curve.bezier_decomposition()
        ring: Ring = []
        for points in pieces:
            self.source.spend()
            ring.append(_bezier([(float(point.x), float(point.y)) for point in points]))
        if ring and _joint(ends(ring[0])[0]) == _joint(ends(ring[-1])[1]):
            self.closed[layer].append(ring)
        else:
            self.goes_on(layer, ring)

    def solid(self, entity: Any, layer: str) -> None:
        points = [point_of(p.x, p.y) for p in entity.wcs_vertices()]
        self.closed[layer].append(polyline(list(dict.fromkeys(points))))

    def hatch(self, entity: Any, layer: str) -> None:
        """Read the rings of a hatch, which fills them by the even-odd rule."""
        rings: list[Ring] = []
        for path in entity.paths:
            ring: Ring = []
            if hasattr(path, "vertices"):
                self.source.spend(len(path.vertices))
                ring = _bulged_ring(list(path.vertices), True)
            else:
                for edge in path.edges:
                    self.source.spend()
                    ring += self.edge(edge)
            if ring:
                rings.append(_in_plane(entity, ring))
        if rings:
            self.filled.append(Drawn(rings, (layer,)))

    def edge(self, edge: Any) -> Ring:
        """Return an edge of a hatch as a ring."""
        kind = type(edge).__name__
        if kind == "LineEdge":
            a, b = (point_of(p[0], p[1]) for p in (edge.start, edge.end))
            return [Line(a, b)] if a != b else []
        if kind == "ArcEdge":
            arc: Ring = [_arc(edge.center, edge.radius, (edge.start_angle, edge.end_angle))]
            return arc if edge.ccw else reversed_ring(arc)
        raise ValueError(f"{kind} at its edge: only polylines, lines and arcs are read")


_READERS: dict[str, Callable[[_Walk, Any, str], None]] = {
    "LINE": _Walk.line,
    "ARC": _Walk.arc,
    "CIRCLE": _Walk.circle,
    "ELLIPSE": _Walk.ellipse,
    "LWPOLYLINE": _Walk.polyline,
    "POLYLINE": _Walk.polyline,
    "SPLINE": _Walk.spline,
    "SOLID": _Walk.solid,
    "TRACE": _Walk.solid,
    "HATCH": _Walk.hatch,
}


def _bezier(p: list[Vector]) -> Segment:
    match p:
        case [a, b]:
            return Line(point_of(*a), point_of(*b))
        case [a, b, c]:
            return quadratic(a, b, c)
        case [a, b, c, d]:
            return Cubic((a, b, c, d))
    raise ValueError(f"a curve of {counted(len(p), 'control point')}")


def _bulged_ring(corners: list[Any], closed: bool) -> Ring:
    ring: Ring = []
    following = [*corners[1:], *corners[:1]] if closed else corners[1:]
    for (x, y, bulge), after in zip(corners, following, strict=False):
        a, b = (float(x), float(y)), (float(after[0]), float(after[1]))
        if a != b:
            ring.append(bulged(a, b, float(bulge)) if bulge else Line(point_of(*a), point_of(*b)))
    return ring


def _in_plane(entity: Any, ring: Ring) -> Ring:
    """Return an entity's ring in the drawing's plane; an entity seen from below is mirrored in x."""
    z = entity.dxf.extrusion
    if abs(z.x) > 1e-9 or abs(z.y) > 1e-9:
        raise ValueError("it stands in space, and not in the plane of x and y")
    return ring if z.z > 0 else carried(ring, _MIRRORED)


_MIRRORED: Affine = (Fraction(-1), Fraction(0), Fraction(0), Fraction(1), Fraction(0), Fraction(0))


def _arc(center: Any, radius: float, degrees: tuple[float, float]) -> Arc:
    """Return the counter-clockwise arc between two angles; the whole circle, if they are equal."""
    first, last = map(math.radians, degrees)
    sweep = (last - first) % math.tau or math.tau
    return arc_of_circle((float(center[0]), float(center[1])), float(radius), first, first + sweep)


def _joint(p: Vector) -> ExactPoint:
    """Round an end to nine digits: ends that differ by less are one."""
    return point_of(
        float(f"{p[0]:.9g}") if abs(p[0]) > 1e-9 else 0.0, float(f"{p[1]:.9g}") if abs(p[1]) > 1e-9 else 0.0
    )
