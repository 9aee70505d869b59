"""Walk over the entities of a DXF drawing, blocks expanded, to filled rings and the unfilled curves of each layer."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

from cfree.curves.drawn import Line, Ring, ends, point_of, polyline, turn
from cfree.formats.drawings import dxf_curves as curves
from cfree.formats.drawings.content import Curve, Drawn, Lines
from cfree.formats.drawings.dxf_curves import InSpaceError
from cfree.formats.drawings.dxf_splines import cubics
from cfree.formats.drawings.dxf_tags import Tags
from cfree.formats.drawings.source import DEEPEST, Source, role_of
from cfree.formats.drawings.strokes import wall
from cfree.formats.text.findings import InvalidFileError

COPYING = 8
"""Steps for an entity of a block that is copied to its place."""
NOISE = 1e-13
"""Rounding of coordinates to 14 digits, per size."""
PAINT = {
    "TEXT": "text",
    "MTEXT": "text",
    "RTEXT": "text",
    "ARCALIGNEDTEXT": "text",
    "ATTDEF": "text",
    "ATTRIB": "text",
    "DIMENSION": "dimension",
    "ARC_DIMENSION": "dimension",
    "LARGE_RADIAL_DIMENSION": "dimension",
    "TOLERANCE": "tolerance",
    "LEADER": "leader",
    "MULTILEADER": "leader",
    "MLEADER": "leader",
    "POINT": "point",
    "ACAD_TABLE": "table",
    "WIPEOUT": "wipeout",
    "SHAPE": "symbol",
    "GEOPOSITIONMARKER": "marker",
    "POSITIONMARKER": "marker",
    "LIGHT": "light",
    "SUN": "light",
    "CAMERA": "camera",
    "SECTIONOBJECT": "section line",
    "VIEWPORT": "viewport",
}
"""Nouns of entities that are no outlines and forbid nothing."""
LOST = {
    "REGION": "ACIS body",
    "BODY": "ACIS body",
    "3DSOLID": "ACIS body",
    "SURFACE": "ACIS body",
    "EXTRUDEDSURFACE": "ACIS body",
    "LOFTEDSURFACE": "ACIS body",
    "REVOLVEDSURFACE": "ACIS body",
    "SWEPTSURFACE": "ACIS body",
    "PLANESURFACE": "ACIS body",
    "MESH": "mesh",
    "RAY": "endless line",
    "XLINE": "endless line",
    "IMAGE": "image",
    "OLEFRAME": "OLE object",
    "OLE2FRAME": "OLE object",
    "PDFUNDERLAY": "underlay",
    "DWFUNDERLAY": "underlay",
    "DGNUNDERLAY": "underlay",
    "ACAD_PROXY_ENTITY": "proxy entity",
}
"""Nouns of entities that are drawn and not read."""


@dataclass(frozen=True, slots=True)
class Place:
    """A block reference around an entity.

    Attributes
    ----------
    layer : str, optional
        Layer of the reference, which the block's layer 0 stands for.
    scale : float
        Greatest scale of all references around it.
    clipped : bool
        True if one of them is clipped.
    depth : int
    handle : str
        Handle of the outermost one.
    """

    layer: str | None = None
    scale: float = 1.0
    clipped: bool = False
    depth: int = 0
    handle: str = ""


@dataclass(frozen=True, slots=True)
class Layers:
    """Layers by their state, in small letters."""

    off: frozenset[str]
    frozen: frozenset[str]
    not_plotted: frozenset[str]


MOST_TRACED = 300
"""Maximum number of hidden entities that have points for pictures."""


class Walk:
    """The curves and fills of a drawing."""

    def __init__(self, source: Source, layers: Layers, tags: Tags) -> None:
        self.source, self.layers, self.tags = source, layers, tags
        self.lines: dict[str, list[Curve]] = defaultdict(list)
        self.filled: list[Drawn] = []
        self.left_to_trace = MOST_TRACED
        self.heights = (math.inf, -math.inf)

    def all(self, entities: Iterable[Any], place: Place) -> None:
        """Read entities of a layout or of a block."""
        if place.depth > DEEPEST:
            self.source.refuse(f"blocks nested more than {DEEPEST} deep; explode them")
        for entity in entities:
            self.source.spend(COPYING if place.depth else 1)
            layer = str(_value(entity, "layer", "0"))
            layer = place.layer if layer == "0" and place.layer is not None else layer
            try:
                if self.is_shown(entity, layer):
                    self.one(entity, layer, place)
            except InvalidFileError:
                raise
            except InSpaceError:
                self.lose(entity, f"{entity.dxftype()} that stands in space", layer, place)
            except Exception as error:  # ezdxf raises errors of many types
                fault = str(error)[:80] or type(error).__name__
                self.lose(entity, f"{entity.dxftype()} that cannot be read: {fault}", layer, place)

    def is_shown(self, entity: Any, layer: str) -> bool:
        """True if an entity is visible; note it as hidden if not."""
        name = layer.lower()
        if name in self.layers.frozen:
            hidden = "entity on a frozen layer"
        elif name in self.layers.off and entity.dxftype() != "INSERT":  # a block's other layers stay visible
            hidden = "entity on a layer that is off"
        elif _value(entity, "invisible", 0):
            hidden = "invisible entity"
        else:
            if name in self.layers.not_plotted and entity.dxftype() in DRAWING:
                self.source.note("info", "entity on a layer that is not plotted", where=layer)
            return True
        self.source.note("hidden", hidden, where=layer, points=self.traced(entity))
        return False

    def traced(self, entity: Any) -> list[tuple[float, float]]:
        """Return points along a hidden entity for pictures; nothing after the first hundreds."""
        if self.left_to_trace == 0:
            return []
        self.left_to_trace -= 1
        from ezdxf import path

        with suppress(Exception):  # of kinds without an outline, and of damaged ones
            outline = path.make_path(entity)
            return [(point.x, point.y) for point in outline.flattening(1.0, segments=8)]
        return []

    def one(self, entity: Any, layer: str, place: Place) -> None:
        kind = entity.dxftype()
        if place.clipped and kind in READERS and role_of(self.source, layer)[0] == "workspace":
            self.source.refuse(f"layer {layer}: a workspace in a clipped block; explode the block, and trim it")
        if kind in READERS:
            READERS[kind](self, entity, layer, place)
        elif kind == "INSERT":
            self.block(entity, layer, place)
        elif kind in PAINT:
            self.source.note("paint", PAINT[kind])
        else:
            self.lose(entity, LOST.get(kind, f"{kind} entity"), layer, place)

    def lose(self, entity: Any, what: str, layer: str, place: Place, effect: Any = "less") -> None:
        self.source.note("lost", what, effect, where=layer, handle=self.named(entity, place))

    def named(self, entity: Any, place: Place) -> str:
        """Return handle and line of an entity, or of the block reference around it; empty text if it has none."""
        handle, line = self.found(entity, place)
        if self.tags.lines is None:
            return handle
        return f"{handle}, line {line}" if line else ""

    def found(self, entity: Any, place: Place) -> tuple[str, int]:
        """Return handle and line of an entity, or of the block reference around it; the line is 0 if there is none."""
        handle = place.handle or str(entity.dxf.get("handle") or "")
        return handle, (self.tags.lines or {}).get(handle, 0)

    def height(self, *heights: float) -> None:
        low, high = self.heights
        self.heights = min(low, *heights), max(high, *heights)

    def block(self, entity: Any, layer: str, place: Place) -> None:
        definition = entity.block()
        if definition is None or definition.block is None:
            self.lose(entity, "reference to a block that is not in the file", layer, place)
            return
        if definition.block.is_xref or definition.block.dxf.get("xref_path", ""):
            self.lose(entity, "external reference", layer, place)
            return
        clipped = _is_clipped(entity)
        if clipped:
            name = self.named(entity, place)
            self.source.note("guess", "clipped block, read whole", "more", where=layer, handle=name)
        if entity.attribs:
            self.source.note("paint", "text", count=len(entity.attribs))
        if entity.mcount > 1:
            self.source.spend(COPYING * entity.mcount)
        scale = place.scale * max(abs(entity.dxf.get("xscale", 1.0)), abs(entity.dxf.get("yscale", 1.0)))
        handle = place.handle or str(entity.dxf.get("handle") or "")
        inner = Place(layer, scale, clipped or place.clipped, place.depth + 1, handle)

        def skipped(other: Any, reason: str) -> None:
            if other.dxftype() not in PAINT:
                self.lose(other, f"{other.dxftype()} that cannot be placed: {reason}", layer, inner)

        for copy in _copies(entity):
            self.all(copy.virtual_entities(skipped_entity_callback=skipped), inner)

    # content

    def add(
        self, entity: Any, layer: str, place: Place, ring: Ring, closed: bool, angle: float = 0.0, length: float = 0.0
    ) -> None:
        """Keep an unfilled curve; its ends are rounded by an angle in degrees at a radius, and by a share of a unit."""
        if not ring:
            return
        if self.source.reading.strokes == "drawn" and _value(entity, "lineweight", -1) > 0:
            self.source.note("info", "line weight, which is paint and no width", where=layer)
        largest = max(abs(x) for segment in ring for p in ends(segment) for x in p)
        point_of(largest, largest)  # raises an error if it is no coordinate
        unit = self.tags.unit * place.scale
        rounding = unit * (math.sqrt(0.5) + length) + angle * self.tags.unit_of_angles * math.pi / 360
        rounding += self.tags.unit * (place.depth > 0) + NOISE * largest
        self.lines[layer].append(Curve(ring, closed, self.named(entity, place), rounding))

    def fill(self, entity: Any, layer: str, place: Place, rings: list[Ring], *, even_odd: bool = True) -> None:
        """Keep rings that are filled together."""
        if rings:
            self.filled.append(Drawn(rings, (layer,) if layer else (), self.found(entity, place)[1] or 1, even_odd))

    def content(self) -> list[Drawn | Lines]:
        """Return the unfilled curves of each layer, and the fills."""
        unit = self.tags.unit
        points = [p for curves in self.lines.values() for curve in curves for s in curve.segments for p in ends(s)]
        size = max((max(axis) - min(axis) for axis in zip(*points, strict=True)), default=0.0)
        is_rounded = 0 < unit <= COARSEST * size  # fewer digits are no rounding, but a drawing in round numbers
        lines = [
            Lines(
                curves if is_rounded else [replace(c, rounding=min(c.rounding, NOISE * size)) for c in curves], (name,)
            )
            for name, curves in self.lines.items()
        ]
        return [*lines, *self.filled]

    # entities

    def line(self, entity: Any, layer: str, place: Place) -> None:
        start, end = entity.dxf.start, entity.dxf.end
        self.height(start.z, end.z)
        a, b = (point_of(p.x, p.y) for p in (start, end))
        if a != b:
            self.add(entity, layer, place, [Line(a, b)], False)
        else:
            self.source.note("info", "line that is a point from above", where=layer)

    def arc(self, entity: Any, layer: str, place: Place) -> None:
        c, radius = entity.dxf.center, curves.radius_of(entity)
        arc = curves.arc_of(c, radius, (entity.dxf.start_angle, entity.dxf.end_angle))
        ring = curves.in_plane(entity, [arc])
        self.height(c.z if curves.is_upright(entity) else -c.z)
        if radius > 0:
            self.add(entity, layer, place, ring, arc.closed, radius, 0.5)
        else:
            self.source.note("info", "arc that is a point", where=layer)

    def circle(self, entity: Any, layer: str, place: Place) -> None:
        c, radius = entity.dxf.center, curves.radius_of(entity)
        ring = curves.in_plane(entity, [curves.arc_of(c, radius, (0, 360))])
        self.height(c.z if curves.is_upright(entity) else -c.z)
        if radius > 0:
            self.add(entity, layer, place, ring, True, 0.0, 0.5)
        else:
            self.source.note("info", "circle that is a point", where=layer)

    def ellipse(self, entity: Any, layer: str, place: Place) -> None:
        arc, whole = curves.ellipse_of(entity)
        self.height(entity.dxf.center.z)
        self.add(entity, layer, place, [arc], whole, 0.0, 1.0)

    def polyline(self, entity: Any, layer: str, place: Place) -> None:
        """Read an LWPOLYLINE or a POLYLINE; wide ones are walls."""
        if entity.dxftype() == "LWPOLYLINE":
            corners = curves.lwpolyline(entity)
        elif entity.is_2d_polyline or entity.is_3d_polyline:
            corners = curves.polyline(entity)
        else:
            self.lose(entity, "mesh", layer, place)
            return
        self.source.spend(len(corners.rows))
        ring, widths = curves.segments(corners)
        upright = (entity.dxftype() == "POLYLINE" and entity.is_3d_polyline) or curves.is_upright(entity)
        if not upright:
            ring = curves.in_plane(entity, ring)
        self.height(*(z if upright else -z for z in corners.heights or (0.0,)))
        if not ring:
            self.source.note("info", "polyline that is a point", where=layer)
            return
        if any(max(pair) > 0 for pair in widths):
            role = role_of(self.source, layer)[0]
            self.wide(entity, layer, place, Curve(ring, corners.closed, cap="butt"), widths, role)
            if role == "obstacle":
                if not corners.closed or self.source.reading.strokes != "ignore":
                    return
                self.source.note(
                    "guess",
                    "closed polyline with a width, read as a solid",
                    "more",
                    where=layer,
                    at=ends(ring[0])[0],
                    handle=self.named(entity, place),
                    remedy="--strokes drawn",
                )
        self.add(entity, layer, place, ring, corners.closed)

    def wide(
        self, entity: Any, layer: str, place: Place, curve: Curve, widths: list[tuple[float, float]], role: str
    ) -> None:
        """Keep the walls of a polyline; those of a workspace's outline are obstacles in it."""
        if any(min(pair) < 0 for pair in widths):
            raise ValueError("a width below zero")
        self.source.note("info", "polyline with a width, read as a wall", where=layer)
        for polygon in wall(self.source, curve, widths, "drawn", layer):
            name = layer if role != "workspace" else ""
            self.fill(entity, name, place, [polyline(polygon.exact_vertices)])

    def spline(self, entity: Any, layer: str, place: Place) -> None:
        tool = entity.construction_tool()
        self.source.spend(tool.count)
        self.height(*(float(p.z) for p in tool.control_points))
        ring, error = cubics(tool, self.source.spend)
        if not len(entity.control_points):
            self.source.note("near", "spline through points without its control points", "unknown", where=layer)
        elif error:
            self.source.note("near", "spline with weights or of a degree above three", "near", where=layer, size=error)
        a, b = ends(ring[0])[0], ends(ring[-1])[1]
        near = self.tags.unit * place.scale if entity.dxf.flags & 1 else NOISE * max(map(abs, (*a, *b)))
        closed = math.dist(a, b) <= near
        self.add(entity, layer, place, ring, closed)

    def solid(self, entity: Any, layer: str, place: Place) -> None:
        """Read a SOLID, TRACE or 3DFACE; one that stands upright is a line from above."""
        if entity.dxftype() != "3DFACE":
            curves.is_upright(entity)
        corners = list(entity.wcs_vertices())
        self.height(*(p.z for p in corners))
        points = list(dict.fromkeys(point_of(p.x, p.y) for p in corners))
        low, high = min(points), max(points)
        if any(turn(low, high, p) for p in points):
            self.fill(entity, layer, place, [polyline(points)])
        elif low != high:
            self.add(entity, layer, place, [Line(low, high)], False)
        else:
            self.source.note("info", "face that is a point from above", where=layer)

    def hatch(self, entity: Any, layer: str, place: Place) -> None:
        """Read a hatch, which is filled by itself."""
        upright = curves.is_upright(entity)
        z = entity.dxf.get("elevation", (0, 0, 0))[2]
        self.height(z if upright else -z)
        rings, boxes = curves.hatch_rings(entity, self.source.spend)
        if boxes:
            self.source.note("guess", "text box in a hatch, filled", "more", count=boxes, where=layer)
        if not entity.dxf.get("solid_fill", 1):
            self.source.note("info", "hatch with a pattern, read as a solid", "more", where=layer)
        if not rings:
            self.lose(entity, "hatch without an outline", layer, place)
        self.fill(entity, layer, place, rings, even_odd=entity.dxf.get("hatch_style", 0) != 2)

    def mline(self, entity: Any, layer: str, place: Place) -> None:
        multiline = curves.multiline(entity, entity.style)
        self.source.spend(sum(len(ring) for ring, _ in multiline.curves))
        self.height(*(vertex.location.z for vertex in entity.vertices))
        for ring, closed in multiline.curves:
            self.add(entity, layer, place, ring, closed, 0.0, 1.0)
        for ring in multiline.fills:
            self.fill(entity, layer, place, [ring])


READERS: dict[str, Callable[[Walk, Any, str, Place], None]] = {
    "LINE": Walk.line,
    "ARC": Walk.arc,
    "CIRCLE": Walk.circle,
    "ELLIPSE": Walk.ellipse,
    "LWPOLYLINE": Walk.polyline,
    "POLYLINE": Walk.polyline,
    "SPLINE": Walk.spline,
    "HELIX": Walk.spline,
    "SOLID": Walk.solid,
    "TRACE": Walk.solid,
    "3DFACE": Walk.solid,
    "HATCH": Walk.hatch,
    "MPOLYGON": Walk.hatch,
    "MLINE": Walk.mline,
}
DRAWING = {*READERS, *LOST, "INSERT"}
"""Entities that draw more than text."""
COARSEST = 1e-5
"""Greatest unit of the last decimal place, per size of the drawing, that is taken for rounding."""


def _value(entity: Any, name: str, default: Any) -> Any:
    """Return an attribute of an entity of any type, also of those that ezdxf does not load."""
    return entity.dxf.get(name, default) if entity.dxf.is_supported(name) else default


def _copies(insert: Any) -> Iterable[Any]:
    """Return the references of an array, or the one reference itself."""
    if insert.mcount <= 1:
        return (insert,)
    if not insert.dxf.row_spacing:  # ezdxf goes through coincident rows one by one, however many a file asks for
        insert.dxf.row_count = 1
    if not insert.dxf.column_spacing:
        insert.dxf.column_count = 1
    return insert.multi_insert()  # type: ignore[no-any-return]


def _is_clipped(entity: Any) -> bool:
    from ezdxf.xclip import XClip

    clip = XClip(entity)
    return bool(clip.has_clipping_path and clip.is_clipping_enabled)
