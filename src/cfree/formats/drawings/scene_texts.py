"""Write scenes as GeoJSON, SVG and DXF, which `cfree.load_scene` reads again.

Besides the shapes, each file has bounds, start, goals and texts as members of JSON. GeoJSON has exact numbers, SVG
decimals of 14 digits, DXF doubles: other numbers are rounded, and `write_scene` returns a note with their count.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from html import escape
from pathlib import Path
from typing import Any

from cfree.curves.drawn import decimal
from cfree.formats.drawings.source import Source, role_of
from cfree.formats.scenes.scene_settings import settings_of
from cfree.formats.text.atomic import replacing
from cfree.formats.text.extras import needed
from cfree.formats.text.number_text import number_text
from cfree.palette import OBSTACLE, ROBOT
from cfree.polygons.polygon import Polygon
from cfree.scene.reading import Note
from cfree.scene.scene import Scene

COLOURS = {"robot": ROBOT, "obstacle": OBSTACLE, "workspace": "none"}


def write_scene(scene: Scene, path: Path) -> tuple[Note, ...]:
    """Write a scene in the format of the file's suffix; return notes about its changes."""
    writer = _WRITERS[path.suffix.lower()]
    text, changed = writer(scene)
    with replacing(path) as unfinished:
        unfinished.write_text(text, encoding="utf-8", newline="\n")
    return changed


def _shapes(scene: Scene) -> list[tuple[str, str, Polygon]]:
    """Return role, name and polygon of each shape."""
    return [
        *(("robot", "", part) for part in scene.robot),
        *(("obstacle", name, o) for o, name in zip(scene.obstacles, scene.obstacle_names, strict=True)),
        *([("workspace", "", scene.workspace)] if scene.workspace else []),
    ]


def _rounded(count: int) -> tuple[Note, ...]:
    return (Note("near", "number rounded to 14 digits", "near", count),) if count else ()


def geojson_text(scene: Scene) -> tuple[str, tuple[Note, ...]]:
    """Return a feature for each shape; the robot's first one has the settings."""
    settings: dict[str, Any] = settings_of(scene)
    lines = []
    for role, name, polygon in _shapes(scene):
        properties = {"role": role, **({"name": name} if name else {}), **settings}
        settings = {}
        rings = ", ".join(
            f"[{', '.join(f'[{number_text(x)}, {number_text(y)}]' for x, y in (*ring, ring[0]))}]"
            for ring in polygon.exact_rings
        )
        lines.append(
            f'{{"type": "Feature", "properties": {json.dumps(properties, ensure_ascii=False)}, '
            f'"geometry": {{"type": "Polygon", "coordinates": [{rings}]}}}}'
        )
    return '{"type": "FeatureCollection", "features": [\n' + ",\n".join(lines) + "\n]}\n", ()


def svg_text(scene: Scene) -> tuple[str, tuple[Note, ...]]:
    """Return a path for each shape, in a group that turns y upwards."""
    rounded = 0

    def text(value: Fraction) -> str:
        nonlocal rounded
        shown = decimal(float(value))
        rounded += shown != value
        return f"{float(value):.14g}"

    def data(polygon: Polygon) -> str:
        rings = (" L ".join(f"{text(x)} {text(y)}" for x, y in ring) for ring in polygon.exact_rings)
        return " ".join(f"M {ring} Z" for ring in rings)

    shapes = _shapes(scene)
    x0, y0, x1, y1 = _box(shapes)
    margin = max(x1 - x0, y1 - y0) / 50
    box = f"{x0 - margin:.6g} {-y1 - margin:.6g} {x1 - x0 + 2 * margin:.6g} {y1 - y0 + 2 * margin:.6g}"
    settings = escape(json.dumps(settings_of(scene), ensure_ascii=False))
    lines = [
        f'  <path data-role="{role}"{f" data-name={_quoted(name)}" if name else ""} fill="{COLOURS[role]}"'
        f'{_RIM if role == "workspace" else ""} fill-rule="evenodd" d="{data(polygon)}"/>'
        for role, name, polygon in sorted(shapes, key=lambda shape: shape[0] != "workspace")
    ]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" data-cfree="{settings}">\n'
        f'<g transform="scale(1 -1)">\n' + "\n".join(lines) + "\n</g>\n</svg>\n"
    ), _rounded(rounded)


_RIM = f' stroke="{OBSTACLE}" vector-effect="non-scaling-stroke"'


def _quoted(name: str) -> str:
    return f'"{escape("".join(c if c.isprintable() else " " for c in name))}"'


def _box(shapes: list[tuple[str, str, Polygon]]) -> tuple[float, float, float, float]:
    xs, ys = zip(*(point for _, _, polygon in shapes for point in polygon.vertices.tolist()), strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def dxf_text(scene: Scene) -> tuple[str, tuple[Note, ...]]:
    """Return a hatch for each shape, with its outlines, on a layer of its role or name."""
    from io import StringIO

    ezdxf = needed("ezdxf", "dxf", "DXF")
    from cfree.formats.drawings.dxf import PROPERTY, UNITS

    document = ezdxf.new("R2010")
    document.header.custom_vars.append(PROPERTY, json.dumps(settings_of(scene)))
    document.units = next((code for code, unit in UNITS.items() if unit == scene.units), 0)
    space = document.modelspace()
    rounded, renamed = 0, 0
    for role, name, polygon in _shapes(scene):
        layer = "".join("_" if c in _NO_LAYER or not c.isprintable() else c for c in name[:200]) or role
        if role == "obstacle" and role_of(Source(""), layer)[0] != role:
            layer = f"obstacle {layer}"
        renamed += layer != name and bool(name)
        if layer not in document.layers:
            document.layers.add(layer, color={"robot": 3, "obstacle": 8, "workspace": 5}[role])
        hatch = space.add_hatch(dxfattribs={"layer": layer})
        for k, ring in enumerate(polygon.exact_rings):
            points = [(float(x), float(y)) for x, y in ring]
            rounded += sum(
                decimal(p) != q for a, b in zip(points, ring, strict=True) for p, q in zip(a, b, strict=True)
            )
            hatch.paths.add_polyline_path(points, is_closed=True, flags=1 if k == 0 else 16)
    stream = StringIO()
    document.write(stream)
    names = (Note("info", "name of a layer without the characters that DXF forbids", count=renamed),) if renamed else ()
    return stream.getvalue(), _rounded(rounded) + names


_NO_LAYER = '<>/\\":;?*|=`'
_WRITERS: dict[str, Callable[[Scene], tuple[str, tuple[Note, ...]]]] = {
    ".geojson": geojson_text,
    ".svg": svg_text,
    ".dxf": dxf_text,
}
"""Writers by the suffix of the file."""
