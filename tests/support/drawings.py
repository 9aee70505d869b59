"""Small files of each kind that cfree reads, in the manner of hand-made ones."""

from __future__ import annotations

import gzip
from functools import cache
from io import BytesIO, StringIO
from pathlib import Path

NAMESPACE = "http://www.w3.org/2000/svg"
SVG = """<?xml version="1.0"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
     xmlns:xlink="http://www.w3.org/1999/xlink" width="210mm" height="297mm" viewBox="0 0 105 148.5">
 <defs><g id="chair"><rect width="4" height="4" rx="1"/></g></defs>
 <g inkscape:label="walls" transform="translate(10.1,10.2)">
  <rect x="0.1" y="0.2" width="100" height="2"/>
  <path id="lake" fill-rule="evenodd" d="m 20,20 c 10,-10 20,10 30,0 v 30 h -30 z m 5,12 h 10 v 10 h -10 z"/>
  <g transform="rotate(30 60 60) scale(2)"><ellipse cx="10" cy="60" rx="8" ry="3" transform="skewX(20)"/></g>
  <path d="M 70 100 A 10 6 30 1 1 90 100 A 10 6 30 0 1 70 100"/><line x2="5" y2="5"/><text>hi</text>
 </g>
 <use xlink:href="#chair" x="100" y="150"/><use href="other.svg#a"/><rect width="9" height="9" style="display: none"/>
 <g id="Robot"><path d="M 10 200 h 20 a 5 5 0 0 1 0 10 h -20 a 5 5 0 0 1 0 -10 z"/></g>
 <circle id="pivot" cx="12" cy="205" r="1"/>
</svg>
"""
STYLED_SVG = """<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60">
 <style>@media (min-width: 9px) {.a {opacity: 0.5}} .off, g > .b {display: none !important}
  #t {fill-rule: evenodd}</style>
 <symbol id="s" viewBox="0 0 10 20" preserveAspectRatio="xMaxYMin slice"><path d="m1 1h8v18-8 0"/></symbol>
 <clipPath id="c"><path id="k" d="M5 5L50 9 30 50z" clip-rule="evenodd"/><use href="#k" x="3"/></clipPath>
 <g clip-path="url(#c)"><circle cx="30%" cy="20" r="9" style="transform:scale(1.5) rotate(10deg)"/></g>
 <use href="#s" x="60" y="5" width="20" height="12"/><path id="t" d="M5 55L20 40 20 55 5 40z" class="a"/>
 <switch><g systemLanguage="de"><rect width="9" height="9"/></g><path d="M70 40q5-9 9 0t9 0v9h-18z"/></switch>
 <g id="plate" fill="none" stroke="red" stroke-width="2%"><path d="M40 40H55"/><path d="M55 40V55L40 55"/>
  <line x1="40" y1="55" x2="40" y2="40"/><circle cx="47" cy="47" r="3"/><rect class="off" width="9" height="9"/></g>
 <svg x="80" y="30" width="15" height="9"><rect id="robot" x="-2" width="10" height="4" transform-origin="1 2"
  transform="rotate(3) skewX(2)"/></svg><path mask="url(#m)" d="M90 45a2 3 20 104-2z"/><path d="M90 55h5v3 x"/>
</svg>
"""
MAP = """image: map.pgm
resolution: 0.05
origin: [-1.5, 2, 0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""
PGM = "P2\n# a comment\n4 3\n255\n254 254 254 254\n254 0 0 254\n254 254 0 205\n"
NAV2 = """local_costmap:
  local_costmap:
    ros__parameters:
      footprint: "[[0.5, 0.25], [-.5,0.25], [-0.5, -0.25], [.5, -0.25]]"
      footprint_padding: 0.01
global_costmap: {global_costmap: {ros__parameters: {robot_radius: .22}}}
"""
URDF = """<robot name="r"><link name="base"><collision><geometry><box size="0.6 0.4 0.2"/></geometry></collision></link>
<link name="wheel"><collision><origin rpy="1.5708 0 0"/><geometry><cylinder radius="0.1" length="0.05"/></geometry>
</collision></link><link name="lidar"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
<joint name="j" type="continuous"><parent link="base"/><child link="wheel"/><origin xyz="0.1 0.225 0"/></joint>
<joint name="k" type="fixed"><parent link="base"/><child link="lidar"/><origin xyz="0.3 0 0.2" rpy="0 0.3 0"/></joint>
</robot>
"""
NESTING = """{"name": "swim", "items": [
 {"id": 0, "demand": 3, "allowed_orientations": [0, 180], "shape": {"type": "simple_polygon",
  "data": [[0, 0], [4, 0], [0, 3], [0, 0]]}},
 {"id": 1, "demand": 1, "shape": {"type": "polygon", "data": {"outer": [[0, 0], [4, 0], [4, 4], [0, 4]],
  "inner": [[[1, 1], [2, 1], [1, 2]]]}}}], "strip_height": 10,
 "solution": {"strip_width": 30, "layout": {"container_id": 0, "density": 0.5, "placed_items": [
  {"item_id": 0, "transformation": {"rotation": 3.1415927, "translation": [8, 8]}},
  {"item_id": 1, "transformation": {"rotation": 0, "translation": [12, 1]}}]}}}
"""

MOVINGAI = "type octile\nheight 3\nwidth 4\nmap\n..@S\nG.WO\n.T..\n"
MONITOR = """collision_monitor: {ros__parameters: {polygons: ["Stop"],
 Stop: {type: polygon, points: [1, 1, 1, -1, 0, -1]}}}
FollowPath:
  footprint_model: {type: two_circles, front_offset: 0.2, front_radius: 0.2, rear_offset: 0.3, rear_radius: 0.25}
costmap: {footprint: [[2, 0], [4, 0], [4, 1], [2, 1]], footprint_padding: 0.1}
"""
GEOJSON = """{"type": "FeatureCollection", "features": [
 {"type": "Feature", "properties": {"role": "robot", "start": [1, 2, "30deg"], "units": "m"},
  "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 2], [0, 2], [0, 0]]]}},
 {"type": "Feature", "properties": {"name": "walls", "width": 0.25},
  "geometry": {"type": "MultiLineString", "coordinates": [[[0, 9], [5, 9], [9, 5, 1]], [[0, 12], [3, 12.5]]]}},
 {"type": "Feature", "properties": {"name": "tree", "radius": 0.5},
  "geometry": {"type": "Point", "coordinates": [8, 8]}},
 {"type": "Feature", "properties": {"role": "ignore"}, "geometry": {"type": "Point", "coordinates": [1, 1]}},
 {"type": "Feature", "properties": null, "geometry": {"type": "GeometryCollection", "geometries": [
  {"type": "MultiPolygon", "coordinates": [[[[20, 0], [24, 0], [24, 4], [20, 4], [20, 0]],
   [[21, 1], [21, 2], [22, 2], [21, 1]]], [[[30, 0], [33, 0], [33, 3], [30, 3], [30, 0]]]]}]}},
 {"type": "Feature", "properties": {"name": "lake"}, "geometry": null}]}
"""
WKT = """robot: POLYGON ((0 0, 1 0, 1 1/2, 0 0.5, 0 0))
# walls
walls: SRID=4326; MULTIPOLYGON Z (((3 0 1, 5 0 1, 5 2 1, 3 0 1)), ((6 0 1, 9 0 1, 9 3 1, 6 3 1, 6 0 1)))
workspace: POLYGON ((-9 -9, 20 -9, 20 20, -9 20, -9 -9), (-1 -1, -2 -1, -2 -2, -1 -1))
"""
SCENE = """{"version": 1, "name": "a", "units": "m", "robot": [{"outer": [[0, 0], ["1/3", 0], [0, 0.1]]},
 {"circle": {"center": [0, 0], "radius": 0.1}}], "bounds": [-9, -9, 9, 9], "start": [0, 0, "30deg"],
 "obstacles": [{"name": "walls", "outer": [[1, 1], [4, 1], [4, 4], [1, 4]], "holes": [[[2, 2], [3, 2], [3, 3]]]},
  {"outer": [[5, 0], [6, 0], [6, 1], [5, 1]]}], "goals": [[5, 5], [7, 7, {"tau": "1/2"}]],
 "reading": [{"kind": "lost", "effect": "less", "count": 2, "what": "open line", "at": [1, 2], "size": 3}]}
"""


@cache
def dxf() -> str:
    """A drawing with a curve of each kind, blocks, a hatch, and layers that are roles or off."""
    import ezdxf

    document = ezdxf.new("R2010")
    document.units = 4
    for name in ("robot", "walls", "pivot", "off", "part"):
        document.layers.add(name)
    document.layers.get("off").off()
    space = document.modelspace()

    def on(layer: str) -> dict[str, dict[str, str]]:
        return {"dxfattribs": {"layer": layer}}

    space.add_lwpolyline([(0, 0, 0), (10, 0, 1), (10, 4, 0), (0, 4, 1)], format="xyb", close=True, **on("robot"))
    space.add_circle((2, 2), 0.5, **on("pivot"))
    space.add_lwpolyline([(30, 0), (40.1, 0), (40.1, 4.2), (30, 4.2)], close=True, **on("part"))
    space.add_circle((35, 2), 1, **on("part"))
    space.add_line((0, 20), (10, 20), **on("walls"))
    space.add_line((10, 24), (0, 24), **on("walls"))
    space.add_arc((10, 22), 2, -90, 90, **on("walls"))
    space.add_arc((0, 22), 2, 90, 270, **on("walls"))
    space.add_ellipse((30, 30), (5, 2), 0.4, **on("ellipse"))
    space.add_spline([(50, 0), (60, 5), (65, 15), (50, 20), (45, 10), (50, 0)], **on("spline"))
    block = document.blocks.new("B")
    block.add_lwpolyline([(0, 0), (1, 0), (1, 2), (0, 2)], close=True)
    space.add_blockref("B", (20, 40), dxfattribs={"layer": "furniture", "xscale": -1, "yscale": 3})
    hatch = space.add_hatch(**on("hatch"))
    hatch.paths.add_polyline_path([(50, 30), (60, 30), (60, 40), (50, 40)], is_closed=True)
    hatch.paths.add_polyline_path([(52, 32), (54, 32), (54, 34)], is_closed=True)
    space.add_circle((0, 0), 100, **on("off"))
    space.add_text("hi")
    space.add_line((0, 0), (1, 1))
    space.add_lwpolyline([(-50, -50), (120, -50), (120, 100), (-50, 100)], close=True, **on("Workspace"))
    stream = StringIO()
    document.write(stream)
    return stream.getvalue()


def files() -> dict[str, bytes]:
    """Contents of the files by name."""
    head = f'<!DOCTYPE svg [<!ENTITY ns "{NAMESPACE}">]>'
    named = head + SVG[SVG.index("<svg") :].replace(NAMESPACE, "&ns;")
    texts = {"a.svg": SVG, "nav.yaml": NAV2, "r.urdf": URDF, "n.json": NESTING, "a.dxf": dxf(), "map.yaml": MAP}
    texts |= {"c.svg": STYLED_SVG, "grid.map": MOVINGAI, "teb.yaml": MONITOR}
    texts |= {"g.geojson": GEOJSON, "a.wkt": WKT, "s.json": SCENE}
    return {name: text.encode() for name, text in texts.items()} | {"b.svgz": gzip.compress(named.encode(), mtime=0)}


def put(folder: Path) -> None:
    """Write all of them, and the map's image."""
    for name, content in files().items():
        (folder / name).write_bytes(content)
    (folder / "map.pgm").write_text(PGM)


def png(rows: list[list[int]]) -> bytes:
    """An image of grey values."""
    import numpy as np
    from PIL import Image

    stream = BytesIO()
    Image.fromarray(np.array(rows, dtype=np.uint8)).save(stream, "PNG")
    return stream.getvalue()
