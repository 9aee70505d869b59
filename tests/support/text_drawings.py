"""Random regions as GeoJSON, well-known text and maps; the region is the truth that a reader must find."""

from __future__ import annotations

import json
import math
import random
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import shapely
from shapely import Polygon, affinity
from shapely.geometry.base import BaseGeometry

from svg_drawings import plate, rectangle, solid, star


@dataclass(frozen=True)
class Text:
    """A file, the region that it means, the options that it needs, and the files beside it."""

    name: str
    content: bytes
    truth: BaseGeometry
    options: dict[str, Any] = field(default_factory=dict)
    beside: dict[str, bytes] = field(default_factory=dict)


Way = Callable[[random.Random], Text]
WAYS: dict[str, Way] = {}


def way(write: Way) -> Way:
    """Register a way of writing."""
    WAYS[write.__name__] = write
    return write


def rings(shape: Polygon) -> list[list[list[float]]]:
    return [[list(point) for point in ring.coords] for ring in (shape.exterior, *shape.interiors)]


def geojson(truth: BaseGeometry, *features: tuple[dict[str, Any], dict[str, Any] | None], **options: Any) -> Text:
    """Return a collection; all features have the name of the layer, "walls"."""
    listed = [
        {"type": "Feature", "properties": {"name": "walls"} | more, "geometry": geometry} for more, geometry in features
    ]
    return Text("a.geojson", json.dumps({"type": "FeatureCollection", "features": listed}).encode(), truth, options)


@way
def geojson_polygon(rng: random.Random) -> Text:
    shape = rng.choice([plate, solid])(rng)
    return geojson(shape, ({}, {"type": "Polygon", "coordinates": rings(shape)}))


@way
def geojson_collection(rng: random.Random) -> Text:
    shapes = [rectangle(rng), star(rng), plate(rng)]
    inner = [{"type": "Polygon", "coordinates": rings(shape)} for shape in shapes]
    geometry = {
        "type": "GeometryCollection",
        "geometries": [inner[0], {"type": "GeometryCollection", "geometries": inner[1:]}],
    }
    return geojson(shapely.union_all(shapes), ({}, geometry), ({}, None), ({"role": "ignore"}, inner[0]))


@way
def geojson_overlapping(rng: random.Random) -> Text:
    shapes = [rectangle(rng) for _ in range(rng.randint(2, 5))]
    geometry = {"type": "MultiPolygon", "coordinates": [rings(shape) for shape in shapes]}
    return geojson(shapely.union_all(shapes), ({}, geometry), repair=True)


@way
def geojson_bow_tie(rng: random.Random) -> Text:
    w, h = rng.randint(9, 50), rng.randint(9, 50)
    points = [[20, 20], [20 + w, 20 + h], [20 + w, 20], [20, 20 + h], [20, 20]]
    middle = (20 + w / 2, 20 + h / 2)
    truth = Polygon([(20, 20), middle, (20, 20 + h)]).union(Polygon([(20 + w, 20 + h), middle, (20 + w, 20)]))
    return geojson(truth, ({}, {"type": "Polygon", "coordinates": [points]}), repair=True)


def line(rng: random.Random) -> list[tuple[float, float]]:
    return [(round(rng.uniform(0, 90), 2), round(rng.uniform(0, 90), 2)) for _ in range(rng.randint(2, 5))]


def wall(points: list[tuple[float, float]], width: float) -> BaseGeometry:
    return shapely.LineString(points).buffer(width / 2, cap_style="round", join_style="round", quad_segs=32)


@way
def geojson_lines_of_a_width(rng: random.Random) -> Text:
    lines, width = [line(rng) for _ in range(3)], round(rng.uniform(0.2, 5), 2)
    truth = shapely.union_all([wall(points, width) for points in lines])
    geometry = {"type": "MultiLineString", "coordinates": lines[:2]}
    last = {"type": "LineString", "coordinates": lines[2]}
    if rng.random() < 0.5:
        return geojson(truth, ({}, geometry), ({}, last), strokes=width)
    return geojson(truth, ({"width": width}, geometry), ({"width": width}, last))


@way
def geojson_points(rng: random.Random) -> Text:
    places, radius = line(rng), round(rng.uniform(0.2, 9), 2)
    truth = shapely.MultiPoint(places).buffer(radius, quad_segs=64)
    return geojson(truth, ({"radius": radius}, {"type": "MultiPoint", "coordinates": places}))


@way
def wkt(rng: random.Random) -> Text:
    shapes = [plate(rng), *(rectangle(rng) for _ in range(2))]
    words = [f"walls: {shapes[0].wkt}", f"walls: {shapely.MultiPolygon(shapes[1:]).wkt}"]
    return Text("a.wkt", "\n".join(words).encode(), shapely.union_all(shapes), {"repair": True})


@way
def trinary_map(rng: random.Random) -> Text:
    columns, rows, size = rng.randint(2, 9), rng.randint(2, 9), rng.choice([0.05, 0.1, 0.5])
    x, y, yaw = round(rng.uniform(-9, 9), 2), round(rng.uniform(-9, 9), 2), rng.choice([0, 0, 0.5, -2])
    cells = [[rng.choice([0, 60, 254, 255, 205]) for _ in range(columns)] for _ in range(rows)]
    unknown = rng.choice(["obstacle", "free"])
    solid_greys = {0, 60} | ({205} if unknown == "obstacle" else set())
    squares = [
        shapely.box(k * size, (rows - 1 - row) * size, (k + 1) * size, (rows - row) * size)
        for row in range(rows)
        for k in range(columns)
        if cells[row][k] in solid_greys
    ]
    truth = affinity.affine_transform(
        shapely.union_all(squares), [math.cos(yaw), -math.sin(yaw), math.sin(yaw), math.cos(yaw), x, y]
    )
    text = f"image: m.pgm\nresolution: {size}\norigin: [{x}, {y}, {yaw}]\nnegate: 0\n"
    text += "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    pixels = b"P5 %d %d 255\n" % (columns, rows) + bytes(grey for row in cells for grey in row)
    return Text("m.yaml", text.encode(), truth, {"unknown": unknown}, {"m.pgm": pixels})


def make(name: str, seed: int) -> Text:
    """Return the drawing of a way and a seed."""
    return WAYS[name](random.Random(f"{name} {seed}"))
