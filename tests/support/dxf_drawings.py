"""Random DXF drawings whose regions are known: entities of each kind, and lines with a width.

    python tests/support/dxf_drawings.py --count 100 --seed 7

A way adds entities to a drawing and returns what must be forbidden, as a shapely geometry. Each drawing is also written
without the markers of subclasses, and with a version that has none. A reader may forbid more by a tolerance only.
"""

from __future__ import annotations

import argparse
import math
import random
import re
import sys
import tempfile
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path
from typing import Any

import shapely

from cfree.errors import CfreeError
from cfree.formats.drawings.source import Reading
from cfree.formats.readers import read_file
from cfree.formats.shapes import Shapes

TOLERANCE = 0.02
Way = Callable[[random.Random, Any], shapely.Geometry]
WAYS: dict[str, tuple[Way, Reading]] = {}
Point = tuple[float, float]


@dataclass
class Drawing:
    """A file, what it forbids, and how it is read."""

    text: str
    must: shapely.Geometry
    reading: Reading = field(default_factory=Reading)


def way(**options: Any) -> Callable[[Way], Way]:
    def register(make: Way) -> Way:
        WAYS[make.__name__] = make, Reading(tolerance=TOLERANCE, **options)
        return make

    return register


def drawing(name: str, seed: int, *, marked: bool = True) -> Drawing:
    """Return a drawing of a way, with the markers of subclasses or without."""
    import ezdxf

    make, reading = WAYS[name]
    document = ezdxf.new("R2000")
    must = make(random.Random(f"{name} {seed}"), document)
    stream = StringIO()
    document.write(stream)
    text = stream.getvalue()
    return Drawing(text if marked else unmarked(text), must, reading)


def unmarked(text: str) -> str:
    """Return a file without header, and without markers in its entities."""
    head, entities = text.split("  2\nENTITIES\n", 1)
    entities, rest = entities.split("  0\nENDSEC\n", 1)
    tables = head[head.index("  2\nCLASSES\n") - len("  0\nSECTION\n") :]
    return tables + "  2\nENTITIES\n" + re.sub(r"100\nAcDb\w+\n", "", entities) + "  0\nENDSEC\n" + rest


def region(shapes: Shapes) -> shapely.Geometry:
    return shapely.unary_union([shape.polygon.to_shapely() for shape in shapes.of("obstacle")])  # type: ignore[union-attr]


def fault(case: Drawing, path: Path) -> str:
    """Return the fault of reading a drawing: area that is lost or invented."""
    path.write_text(case.text, encoding="utf-8")
    shapes = read_file(path, case.reading)
    assert isinstance(shapes, Shapes)
    came = region(shapes)
    lost = case.must.difference(came.buffer(1e-7)).area
    invented = came.difference(case.must.buffer(3 * TOLERANCE, join_style="mitre", mitre_limit=20)).area
    return f"lost {lost:.3g}, invented {invented:.3g}: {shapes.reading}" if max(lost, invented) > 1e-6 else ""


# entities


def rectangle(rng: random.Random) -> list[Point]:
    x, y, w, h = (round(rng.uniform(5, 40), 3) for _ in range(4))
    return [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]


def star(rng: random.Random, x: float = 50.0, y: float = 50.0, r: float = 30.0) -> list[Point]:
    count = rng.randint(5, 11)
    points = []
    for k in range(count):
        s, t = r * rng.uniform(0.5, 1), math.tau * k / count
        points.append((round(x + s * math.cos(t), 4), round(y + s * math.sin(t), 4)))
    return points


def flat(ring: list[Point], bulges: list[float]) -> list[Point]:
    """Return points of a polyline with bulges."""
    points = []
    for k, ((x0, y0), bulge) in enumerate(zip(ring, bulges, strict=True)):
        x1, y1 = ring[(k + 1) % len(ring)]
        points.append((x0, y0))
        if bulge:
            half = 2 * math.atan(bulge)
            rise = 1 / math.tan(half) / 2
            cx, cy = (x0 + x1) / 2 - (y1 - y0) * rise, (y0 + y1) / 2 + (x1 - x0) * rise
            r, t = math.hypot(x0 - cx, y0 - cy), math.atan2(y0 - cy, x0 - cx)
            angles = (t + 2 * half * j / 500 for j in range(1, 500))
            points += [(cx + r * math.cos(a), cy + r * math.sin(a)) for a in angles]
    return points


@way()
def closed_polyline(rng: random.Random, document: Any) -> shapely.Geometry:
    ring = star(rng)
    bulges = [rng.choice([0, 0.2, 0.1]) for _ in ring]
    rows = [(*p, b) for p, b in zip(ring, bulges, strict=True)]
    document.modelspace().add_lwpolyline(rows, format="xyb", close=True)
    return shapely.Polygon(flat(ring, bulges))


@way()
def polyline_at_a_height(rng: random.Random, document: Any) -> shapely.Geometry:
    ring, z = star(rng), rng.choice([0, 2.5])
    document.modelspace().add_polyline3d([(x, y, z) for x, y in ring], close=True)
    return shapely.Polygon(ring)


@way()
def polyline_with_a_frame(rng: random.Random, document: Any) -> shapely.Geometry:
    ring = star(rng)
    line = document.modelspace().add_polyline2d(ring, close=True)
    line.dxf.flags |= 4
    frame = [(0, 0), (90, 0), (0, 90)]
    line.append_vertices(frame)
    for vertex in line.vertices[-len(frame) :]:
        vertex.dxf.flags = 16
    return shapely.Polygon(ring)


@way()
def seen_from_below(rng: random.Random, document: Any) -> shapely.Geometry:
    ring = star(rng)
    rows = [(-x, y, 0.15) for x, y in ring]
    line = document.modelspace().add_lwpolyline(rows, format="xyb", close=True)
    line.dxf.extrusion = (0, 0, -1)
    return shapely.Polygon(flat(ring, [-0.15] * len(ring)))


@way()
def faces(rng: random.Random, document: Any) -> shapely.Geometry:
    a, b, c, d = rectangle(rng)
    space = document.modelspace()
    space.add_solid([a, b, d, c])
    space.add_3dface([(x + 45, y + 45, 1) for x, y in (a, b, c, d)])
    space.add_trace([(x, y - 50) for x, y in (a, b, d, c)])
    one = shapely.Polygon([a, b, c, d])
    moved = [shapely.transform(one, lambda points, by=by: points + by) for by in ((45, 45), (0, -50))]
    return shapely.unary_union([one, *moved])


@way()
def hatch_over_its_outline(rng: random.Random, document: Any) -> shapely.Geometry:
    ring, space = star(rng), document.modelspace()
    space.add_lwpolyline(ring, close=True)
    space.add_hatch().paths.add_polyline_path(ring, is_closed=True)
    return shapely.Polygon(ring)


@way()
def hatches_in_layers(rng: random.Random, document: Any) -> shapely.Geometry:
    ring, space = star(rng), document.modelspace()
    inner = [((x + 100) / 3, (y + 100) / 3) for x, y in ring]
    for points in (ring, inner):  # each by itself: the inner one is no hole
        space.add_hatch().paths.add_polyline_path(points, is_closed=True)
    return shapely.Polygon(ring)


@way()
def hatch_of_edges(rng: random.Random, document: Any) -> shapely.Geometry:
    hatch = document.modelspace().add_hatch()
    corners = rectangle(rng)
    path = hatch.paths.add_edge_path()
    for k in rng.sample(range(4), 4):  # in any order and direction
        a, b = corners[k], corners[(k + 1) % 4]
        path.add_line(*((a, b) if rng.random() < 0.5 else (b, a)))
    (x0, y0), _, (x1, y1), _ = corners
    cx, cy, u, ratio = (x0 + x1) / 2, (y0 + y1) / 2, (x1 - x0) / 4, rng.uniform(0.2, 0.9)
    u *= min(1.0, (y1 - y0) / (x1 - x0))
    turn = rng.uniform(0, math.pi)
    hole = hatch.paths.add_edge_path()
    axis = (u * math.cos(turn), u * math.sin(turn))
    hole.add_ellipse((cx, cy), axis, ratio, 0, 180, ccw=rng.random() < 0.5)
    hole.add_ellipse((cx, cy), axis, ratio, 180, 360, ccw=True)
    ellipse = shapely.Polygon(ellipse_points((cx, cy), axis, ratio))
    return shapely.Polygon(corners).difference(ellipse)


def ellipse_points(center: Point, axis: Point, ratio: float) -> list[Point]:
    c = [(math.cos(math.tau * k / 720), ratio * math.sin(math.tau * k / 720)) for k in range(720)]
    return [(center[0] + s * axis[0] - t * axis[1], center[1] + s * axis[1] + t * axis[0]) for s, t in c]


@way()
def ellipse_or_circle(rng: random.Random, document: Any) -> shapely.Geometry:
    axis, ratio = (rng.uniform(5, 20), rng.uniform(-9, 9)), rng.uniform(0.1, 1)
    document.modelspace().add_ellipse((30, 40), axis, ratio)
    document.modelspace().add_circle((90, 90), 7)
    ellipse = shapely.Polygon(ellipse_points((30, 40), axis, ratio))
    return shapely.union(ellipse, shapely.Polygon(ellipse_points((90, 90), (7, 0), 1)))


@way()
def spline(rng: random.Random, document: Any) -> shapely.Geometry:
    from ezdxf.math import BSpline

    degree = rng.choice([2, 3, 3, 4, 5])
    points = star(rng)
    weights = [rng.uniform(0.5, 2) for _ in range(len(points) + 1)] if rng.random() < 0.5 else None
    tool = BSpline([(x, y, 0) for x, y in [*points, points[0]]], order=degree + 1, weights=weights)
    entity = document.modelspace().add_spline()
    entity.apply_construction_tool(tool)
    return shapely.Polygon([(p.x, p.y) for p in tool.approximate(1500)])


@way()
def multiline(rng: random.Random, document: Any) -> shapely.Geometry:
    style = document.mline_styles.new("WALL")
    half = rng.uniform(0.3, 2)
    style.elements.append(half)
    style.elements.append(-half)
    style.dxf.flags = 1
    line = [(10, 10), (rng.uniform(40, 60), 12), (70, rng.uniform(50, 80))]
    document.modelspace().add_mline(line, dxfattribs={"style_name": "WALL", "justification": 1})
    return shapely.LineString(line).buffer(half, cap_style="flat", join_style="mitre")


@way()
def blocks(rng: random.Random, document: Any) -> shapely.Geometry:
    block = document.blocks.new("B", base_point=(1, 2))
    ring = rectangle(rng)
    block.add_lwpolyline(ring, close=True)
    scale, turn = (rng.choice([-1, 1]) * rng.uniform(0.5, 2), rng.uniform(0.5, 2)), rng.uniform(0, 360)
    document.modelspace().add_blockref(
        "B", (7, 9), dxfattribs={"xscale": scale[0], "yscale": scale[1], "rotation": turn}
    )
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    local = [((x - 1) * scale[0], (y - 2) * scale[1]) for x, y in ring]
    return shapely.Polygon([(7 + c * x - s * y, 9 + s * x + c * y) for x, y in local])


# lines with a width


@way()
def wide_polyline(rng: random.Random, document: Any) -> shapely.Geometry:
    line, width = [(10, 10), (50, rng.uniform(5, 40)), (80, 70), (95, rng.uniform(75, 95))], rng.uniform(0.2, 4)
    document.modelspace().add_lwpolyline(line, dxfattribs={"const_width": width})
    return shapely.LineString(line).buffer(width / 2, cap_style="flat", join_style="mitre", mitre_limit=4)


@way()
def polyline_of_varying_width(rng: random.Random, document: Any) -> shapely.Geometry:
    (x, y), (u, v) = (10.0, 10.0), (rng.uniform(30, 90), rng.uniform(20, 90))
    a, b = rng.uniform(0, 6), rng.uniform(1, 6)
    document.modelspace().add_lwpolyline([(x, y, a, b), (u, v, 0, 0)], format="xyse")
    length = math.hypot(u - x, v - y)
    nx, ny = (y - v) / length / 2, (u - x) / length / 2
    return shapely.Polygon(
        [(x + a * nx, y + a * ny), (x - a * nx, y - a * ny), (u - b * nx, v - b * ny), (u + b * nx, v + b * ny)]
    )


@way()
def wide_arc(rng: random.Random, document: Any) -> shapely.Geometry:
    width, bulge = rng.uniform(0.2, 9), rng.choice([-1, 1]) * rng.uniform(0.2, 1)
    line = document.modelspace().add_polyline2d([(20, 30), (60, 50)])
    line.vertices[0].dxf.bulge = bulge
    line.dxf.default_start_width = line.dxf.default_end_width = width
    half = 2 * math.atan(bulge)
    rise = 1 / math.tan(half) / 2
    x, y = 40 - 20 * rise, 40 + 40 * rise
    r, first = math.hypot(20 - x, 30 - y), math.atan2(30 - y, 20 - x)
    angles = [first + 2 * half * k / 500 for k in range(501)]
    rims = [[(x + q * math.cos(t), y + q * math.sin(t)) for t in angles] for q in (r - width / 2, r + width / 2)]
    return shapely.Polygon([*rims[0], *rims[1][::-1]]).buffer(-1e-3)  # the chords of the inner rim are inside of it


@way(strokes=1.5)
def lines_of_a_width(rng: random.Random, document: Any) -> shapely.Geometry:
    space, walls = document.modelspace(), []
    for _ in range(4):
        a, b = ((rng.uniform(0, 99), rng.uniform(0, 99)) for _ in range(2))
        space.add_line(a, b)
        walls.append(shapely.LineString([a, b]))
    ring = star(rng)
    space.add_lwpolyline(ring, close=True)  # encloses nothing
    walls.append(shapely.LinearRing(ring))
    space.add_arc((30, 30), 20, 10, 100)
    angles = [math.radians(10 + 90 * k / 500) for k in range(501)]
    walls.append(shapely.LineString([(30 + 20 * math.cos(t), 30 + 20 * math.sin(t)) for t in angles]))
    return shapely.unary_union(walls).buffer(0.75, quad_segs=64).buffer(-1e-4)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--way", nargs="*", choices=WAYS)
    options = parser.parse_args()
    wrong = Counter[str]()
    with tempfile.TemporaryDirectory() as folder:
        for name in options.way or WAYS:
            for seed in range(options.seed, options.seed + options.count):
                for marked in (True, False):
                    try:
                        text = fault(drawing(name, seed, marked=marked), Path(folder) / "a.dxf")
                    except CfreeError as error:
                        text = str(error)
                    if text:
                        wrong[name] += 1
                        print(f"{name} {seed} {'marked' if marked else 'unmarked'}: {text[:300]}")
            print(f"{name:28} {wrong[name]} wrong", flush=True)
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
