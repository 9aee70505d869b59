"""Write layouts as SVG, DXF and GeoJSON; arcs stay arcs, and one arc stays one."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from os import PathLike
from pathlib import Path
from typing import Any

from cfree.arguments import checked
from cfree.curves.drawn import Line
from cfree.curves.rings import Cubic, Span
from cfree.formats.text.atomic import checked_suffix, replacing
from cfree.formats.text.extras import needed
from cfree.formats.text.number_text import number_text
from cfree.nesting.layout import Nesting, label, shape_box
from cfree.palette import CATEGORIES, OBSTACLE, OBSTACLE_RIM
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import AnyShape

SUFFIXES = (".svg", ".dxf", ".geojson")
SVG_UNITS = ("mm", "cm", "in", "px", "pt", "pc")
CHORDS = 4000  # of the size: error of polygons for curves that a format does not have
APART = 0.05  # share of the widest sheet between two sheets

Place = tuple[float, float]


@dataclass(frozen=True)
class Edge:
    """An edge to draw, from the end of the one before: a line, an arc by its sweep, or a cubic Bézier curve.

    Attributes
    ----------
    end : (x, y)
    center : (x, y) or None
    sweep : float
        Radians, counter-clockwise if positive; less than a full turn.
    controls : pairs of points
        Of a Bézier curve.
    """

    end: Place
    center: Place | None = None
    sweep: float = 0.0
    controls: tuple[Place, ...] = ()


Outline = tuple[Place, list[Edge]]  # the first point, and the edges


@checked
def save_nesting(nesting: Nesting, path: str | PathLike[str]) -> None:
    """Write a layout to a file, all of it or nothing.

    Parameters
    ----------
    nesting : Nesting
    path : path
        Several sheets are side by side. ``.svg``: lines, arcs and Bézier curves, 14 digits. ``.dxf``: closed polylines
        with arcs, doubles, a layer for each part. ``.geojson``: exact coordinates, with the pose and the sheet of each
        part as properties; fine polygons inside of round shapes.

    Raises
    ------
    UnsupportedError
        If the suffix is another.
    OSError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from cfree.curves.curved import Curved
    >>> from cfree.nesting.layout import Part, Placed
    >>> disc = Placed(Part(Curved.circle((0, 0), 1), "disc"), (2, 2, 0))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_nesting(Nesting([[(0, 0), (4, 0), (4, 4), (0, 4)]], [disc]), f"{folder}/disc.svg")
    ...     Path(f"{folder}/disc.svg").read_text().count("A 1 1")
    2
    """
    suffix = checked_suffix(path, "layout", SUFFIXES)
    text = {".svg": nesting_svg, ".dxf": _dxf, ".geojson": _geojson}[suffix](nesting)
    with replacing(Path(path)) as unfinished:
        unfinished.write_text(text, encoding="utf-8", newline="\n")


def check_nesting_path(path: str | PathLike[str]) -> None:
    """Refuse names of files that `save_nesting` cannot write."""
    checked_suffix(path, "layout", SUFFIXES)


def shifts(nesting: Nesting) -> list[int]:
    """Return how far each sheet is drawn to the right, so that sheets are side by side: whole units."""
    boxes = [shape_box(sheet) for sheet in nesting.sheets]
    apart = math.ceil(APART * max((float(x1 - x0) for x0, _, x1, _ in boxes), default=0.0))
    result: list[int] = []
    end: Any = 0
    for k, (x0, _, x1, _) in enumerate(boxes):
        result.append(math.ceil(end + apart - x0) if k else 0)
        end = x1 + result[-1]
    return result or [0]


def outlines_of(shape: AnyShape) -> list[Outline]:
    """Return the rings of a shape as lines, arcs and curves; of grown and skewed ones as fine polygons."""
    if isinstance(shape, Polygon) or shape.grown or not all(map(_is_plain, (p for ring in shape.curves for p in ring))):
        return [_polygonal(ring) for polygon in fine(shape) for ring in polygon.rings]
    return [_ring(ring) for ring in shape.curves]


def fine(shape: AnyShape) -> list[Polygon]:
    """Return polygons that look like a shape: inside of it, so that shapes that touch do not overlap."""
    if isinstance(shape, Polygon):
        return [shape]
    error = max(shape.size / CHORDS, shape.least_error)
    polygons = shape.inner(error) or shape.outer(error)
    if len(polygons) == 1:
        return list(polygons)
    import shapely

    whole = shapely.union_all([polygon.to_shapely() for polygon in polygons])
    return [Polygon.from_shapely(part) for part in shapely.get_parts(whole)]


def _is_plain(piece: Any) -> bool:
    return isinstance(piece, Line | Cubic) or piece.is_circular


def _polygonal(ring: Any) -> Outline:
    first, *others = [(float(x), float(y)) for x, y in ring]
    return first, [Edge(p) for p in others]


def _ring(ring: Sequence[Any]) -> Outline:
    """Return a closed ring; spans of one circle that follow each other become one arc, a full circle two."""
    arcs: list[tuple[Any, float]] = []  # the last span, and the sweep of all joined
    for piece in ring:
        sweep = piece.sense * piece.sweep if isinstance(piece, Span) else 0.0
        if arcs and _joins(arcs[-1][0], piece) and abs(arcs[-1][1] + sweep) < math.tau * (1 - 1e-9):
            arcs[-1] = piece, arcs[-1][1] + sweep
        else:
            arcs.append((piece, sweep))
    first = _start(ring[0])
    edges: list[Edge] = []
    for piece, sweep in arcs:
        if isinstance(piece, Line):
            edges.append(Edge(_double(piece.end)))
        elif isinstance(piece, Cubic):
            edges.append(Edge(_double(piece.points[3]), controls=tuple(map(_double, piece.points[1:3]))))
        else:
            center, end = _double(piece.center), _double(piece.end)
            if abs(sweep) > math.tau * (1 - 1e-9):
                edges.append(Edge((2 * center[0] - end[0], 2 * center[1] - end[1]), center, sweep / 2))
                sweep /= 2
            edges.append(Edge(end, center, sweep))
    return first, edges


def _joins(one: Any, other: Any) -> bool:
    """True if two spans are on one circle, in the same sense."""
    if not (isinstance(one, Span) and isinstance(other, Span)):
        return False
    (a, b), (c, d) = one.u, other.u
    return one.center == other.center and a * a + b * b == c * c + d * d and one.sense == other.sense


def _start(piece: Any) -> Place:
    if isinstance(piece, Line):
        return _double(piece.start)
    if isinstance(piece, Cubic):
        return _double(piece.points[0])
    return _double((piece.center[0] + piece.u[0], piece.center[1] + piece.u[1]))


def _double(p: Any) -> Place:
    return float(p[0]), float(p[1])


def nesting_svg(nesting: Nesting) -> str:
    """Return a layout as SVG, y upwards, a path for each sheet and part."""
    at = shifts(nesting)
    sheets = [(f"sheet {k}", sheet, at[k]) for k, sheet in enumerate(nesting.sheets)]
    parts = [
        (k, shape, at[min(one.sheet, len(at) - 1)]) for k, one in enumerate(nesting.placed) for shape in one.shapes
    ]
    boxes = [
        (float(x0) + dx, float(y0), float(x1) + dx, float(y1))
        for _, shape, dx in (*sheets, *parts)
        for x0, y0, x1, y1 in [shape_box(shape)]
    ]
    x0, y0, x1, y1 = (
        f(each) for f, each in zip((min, min, max, max), zip(*boxes or [(0, 0, 1, 1)], strict=True), strict=True)
    )
    margin = max(x1 - x0, y1 - y0) / 50
    box = f"{x0 - margin:.6g} {-y1 - margin:.6g} {x1 - x0 + 2 * margin:.6g} {y1 - y0 + 2 * margin:.6g}"
    width, height = (float(f"{side + 2 * margin:.6g}") for side in (x1 - x0, y1 - y0))
    size = f' width="{width:g}{nesting.units}" height="{height:g}{nesting.units}"' if nesting.units in SVG_UNITS else ""
    colours = {name: CATEGORIES[k % len(CATEGORIES)] for k, name in enumerate(_names(nesting))}
    lines = [
        f'  <path data-role="workspace" data-name="{name}" fill="none" stroke="{OBSTACLE}"{_THIN}'
        f' d="{_path(shape, dx)}"/>'
        for name, shape, dx in sheets
    ]
    lines += [
        f'  <path data-role="obstacle" data-name="{escape(_plain(nesting.placed[k].part.name or label(nesting, k)))}"'
        f' fill="{colours[nesting.placed[k].part.name]}" stroke="{OBSTACLE_RIM}"{_THIN} fill-rule="evenodd"'
        f' d="{_path(shape, dx)}"/>'
        for k, shape, dx in parts
    ]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}"{size}>\n<g transform="scale(1 -1)">\n'
        + "\n".join(lines)
        + "\n</g>\n</svg>\n"
    )


_THIN = ' vector-effect="non-scaling-stroke"'


def _names(nesting: Nesting) -> list[str]:
    return [*dict.fromkeys(one.part.name for one in nesting.placed)]


def _plain(name: str) -> str:
    return "".join(c if c.isprintable() else " " for c in name)


def _path(shape: AnyShape, dx: float) -> str:
    def text(p: Place) -> str:
        return f"{p[0] + dx:.14g} {p[1]:.14g}"

    words = []
    for first, edges in outlines_of(shape):
        words.append(f"M {text(first)}")
        here = first
        for edge in edges:
            if edge.center is not None:
                radius = f"{math.dist(here, edge.center):.14g}"
                words.append(
                    f"A {radius} {radius} 0 {int(abs(edge.sweep) > math.pi)} {int(edge.sweep > 0)} {text(edge.end)}"
                )
            elif edge.controls:
                words.append(f"C {' '.join(map(text, (*edge.controls, edge.end)))}")
            else:
                words.append(f"L {text(edge.end)}")
            here = edge.end
        words.append("Z")
    return " ".join(words)


def _dxf(nesting: Nesting) -> str:
    from io import StringIO

    ezdxf = needed("ezdxf", "dxf", "DXF")
    from cfree.formats.drawings.dxf import UNITS

    document = ezdxf.new("R2010")
    document.units = next((code for code, unit in UNITS.items() if unit == nesting.units), 0)
    space, at = document.modelspace(), shifts(nesting)
    shapes = [(f"sheet {k}", sheet, at[k], 5) for k, sheet in enumerate(nesting.sheets)]
    shapes += [
        (label(nesting, k), shape, at[min(one.sheet, len(at) - 1)], 7)
        for k, one in enumerate(nesting.placed)
        for shape in one.shapes
    ]
    for name, shape, dx, colour in shapes:
        layer = "".join("_" if c in '<>/\\":;?*|=`' or not c.isprintable() else c for c in name[:200])
        if layer not in document.layers:
            document.layers.add(layer, color=colour)
        for outline in _without_curves(shape):
            space.add_lwpolyline(list(_bulges(outline, dx)), format="xyb", close=True, dxfattribs={"layer": layer})
    stream = StringIO()
    document.write(stream)
    return stream.getvalue()


def _without_curves(shape: AnyShape) -> list[Outline]:
    """Return outlines of lines and arcs alone."""
    rings = outlines_of(shape)
    if any(edge.controls for _, edges in rings for edge in edges):
        return [_polygonal(ring) for polygon in fine(shape) for ring in polygon.rings]
    return rings


def _bulges(outline: Outline, dx: float) -> Iterator[tuple[float, float, float]]:
    """Yield points of a closed polyline, each with the bulge of the edge that leaves it."""
    first, edges = outline
    points = [first, *(edge.end for edge in edges)]
    bulges = [math.tan(edge.sweep / 4) for edge in edges]
    if len(points) > 1 and points[-1] == first:
        points.pop()
    else:
        bulges.append(0.0)
    yield from ((x + dx, y, bulge) for (x, y), bulge in zip(points, bulges, strict=True))


def _geojson(nesting: Nesting) -> str:
    at = shifts(nesting)
    rows: list[tuple[dict[str, Any], AnyShape, int]] = [
        ({"role": "workspace", "name": f"sheet {k}", "sheet": k}, sheet, at[k])
        for k, sheet in enumerate(nesting.sheets)
    ]
    for k, one in enumerate(nesting.placed):
        pose = one.pose
        tau = "inf" if pose.tau is None else str(pose.tau)
        place = {"x": str(pose.x), "y": str(pose.y), "tau": tau, "degrees": math.degrees(pose.theta)}
        properties = {"role": "obstacle", "name": one.part.name or label(nesting, k), "sheet": one.sheet, **place}
        rows += [(properties, shape, at[min(one.sheet, len(at) - 1)]) for shape in one.shapes]
    lines = [
        f'{{"type": "Feature", "properties": {json.dumps(properties, ensure_ascii=False)}, "geometry": '
        f'{{"type": "Polygon", "coordinates": [{", ".join(_coordinates(ring, dx) for ring in polygon.exact_rings)}]}}}}'
        for properties, shape, dx in rows
        for polygon in fine(shape)
    ]
    return '{"type": "FeatureCollection", "features": [\n' + ",\n".join(lines) + "\n]}\n"


def _coordinates(ring: Any, dx: int) -> str:
    return f"[{', '.join(f'[{number_text(x + dx)}, {number_text(y)}]' for x, y in (*ring, ring[0]))}]"
