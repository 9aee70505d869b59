"""Random regions, each written as SVG in one of many ways: the region is the truth that a reader must find.

    python tests/support/svg_drawings.py --count 20 --seed 0    count the drawings that are read wrongly, by their way

Regions are polygons and discs in a page of 100 by 100 millimetres, x to the right and y downwards.
"""

from __future__ import annotations

import argparse
import math
import random
import tempfile
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import shapely
from shapely import Polygon, affinity
from shapely.geometry.base import BaseGeometry

PAGE = '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">\n{}\n</svg>\n'
TOLERANCE = 0.02
"""Tolerance of curves in reading, and greatest share of wrong area per length of the truth's boundary."""


@dataclass(frozen=True)
class Drawing:
    """The text of a file, and the region that it means.

    Attributes
    ----------
    more : shapely geometry
        The region may have these points as well, if a note says so.
    painted : bool
        True if a renderer fills the region; False if it has outlines without a fill.
    """

    text: str
    truth: BaseGeometry
    more: BaseGeometry | None = None
    painted: bool = True


Way = Callable[[random.Random], Drawing]
WAYS: dict[str, Way] = {}


def way(write: Way) -> Way:
    """Register a way of writing."""
    WAYS[write.__name__] = write
    return write


# --- regions ---


def rectangle(rng: random.Random) -> Polygon:
    x, y, w, h = (round(rng.uniform(low, high), 2) for low, high in ((5, 40), (5, 40), (10, 50), (10, 50)))
    return shapely.box(x, y, x + w, y + h)


def star(rng: random.Random) -> Polygon:
    count, turn = rng.randint(4, 11), rng.uniform(0, 6)
    radii = [rng.uniform(12, 40) for _ in range(count)]
    angles = [turn + math.tau * k / count for k in range(count)]
    places = [(50 + r * math.cos(a), 50 + r * math.sin(a)) for r, a in zip(radii, angles, strict=True)]
    return Polygon([(round(x, 3), round(y, 3)) for x, y in places])


def comb(rng: random.Random) -> Polygon:
    teeth, step, low = rng.randint(1, 4), rng.choice([6, 7.5, 9]), rng.randint(30, 60)
    corners = [(10.0, 90.0), (10 + 2 * teeth * step + step, 90.0)]
    for k in range(2 * teeth, -1, -1):
        top = 10.0 if k % 2 == 0 else float(low)
        corners += [(10 + (k + 1) * step, top), (10 + k * step, top)]
    return Polygon(corners)


def solid(rng: random.Random) -> Polygon:
    return rng.choice([rectangle, star, comb])(rng)


def plate(rng: random.Random) -> Polygon:
    body = shapely.box(10, 15, 90, round(rng.uniform(70, 90), 1))
    hole = affinity.translate(affinity.scale(star(rng), 0.25, 0.25, origin=(50, 50)), rng.choice([-18, 18]), -8)
    return Polygon(body.exterior, [Polygon([(round(x, 3), round(y, 3)) for x, y in hole.exterior.coords]).exterior])


# --- words ---


def number(value: float) -> str:
    return f"{value:.12g}"


def corners(ring: shapely.LinearRing) -> list[tuple[float, float]]:
    return [(x, y) for x, y in ring.coords[:-1]]


def listed(points: list[tuple[float, float]]) -> str:
    return " ".join(f"{number(x)},{number(y)}" for x, y in points)


def data(shape: Polygon, end: str = "Z", backwards: bool = False) -> str:
    rings = [corners(ring) for ring in (shape.exterior, *shape.interiors)]
    return " ".join("M" + "L".join(listed([p]) for p in (ring[::-1] if backwards else ring)) + end for ring in rings)


def stepwise(points: list[tuple[float, float]], digits: int) -> str:
    steps = [(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(points)]
    return f"m{points[0][0]:.{digits}f},{points[0][1]:.{digits}f} " + " ".join(
        f"{x:.{digits}f},{y:.{digits}f}" for x, y in steps
    )


def drawing(body: str, truth: BaseGeometry, **more: object) -> Drawing:
    return Drawing(PAGE.format(body), truth, **more)  # type: ignore[arg-type]


def inverse(matrix: list[float], shape: BaseGeometry) -> BaseGeometry:
    """Return the shape that a matrix of SVG maps to this one."""
    a, b, c, d, e, f = matrix
    det = a * d - b * c
    back = [d / det, -c / det, -b / det, a / det, (c * f - d * e) / det, (b * e - a * f) / det]
    return affinity.affine_transform(shape, back)


# --- ways: outlines ---


@way
def closed_path(rng: random.Random) -> Drawing:
    shape = plate(rng)
    return drawing(f'<path fill-rule="evenodd" d="{data(shape)}"/>', shape)


@way
def filled_path_without_close(rng: random.Random) -> Drawing:
    shape = solid(rng)
    return drawing(f'<path style="fill:#345" d="{data(shape, "")}"/>', shape)


@way
def filled_subpaths_without_close(rng: random.Random) -> Drawing:
    shape = plate(rng)
    return drawing(f'<g fill-rule="evenodd"><path d="{data(shape, "")}"/></g>', shape)


@way
def filled_polyline(rng: random.Random) -> Drawing:
    shape = solid(rng)
    return drawing(f'<polyline points="{listed(corners(shape.exterior))}"/>', shape)


@way
def polygon(rng: random.Random) -> Drawing:
    shape = solid(rng)
    return drawing(f'<polygon points="{listed(corners(shape.exterior))}"/>', shape)


@way
def steps_that_miss_the_begin(rng: random.Random) -> Drawing:
    """Write the steps of an unfilled outline with so few digits that their sum is not 0."""
    shape = affinity.translate(solid(rng), 0.00317, 0.00149)
    points = corners(shape.exterior)
    text = stepwise([*points, points[0]], 3)
    places = [(0.0, 0.0)]
    for word in text[1:].split():
        x, y = map(float, word.split(","))
        places.append((places[-1][0] + x, places[-1][1] + y))
    body = f'<path fill="none" stroke="red" stroke-width=".01" d="{text}"/>'
    return drawing(body, Polygon(places[1:-1]), painted=False)


@way
def unfilled_outline(rng: random.Random) -> Drawing:
    shape = solid(rng)
    return drawing(f'<path style="fill:none;stroke:red" d="{data(shape)}"/>', shape, painted=False)


@way
def packed_numbers(rng: random.Random) -> Drawing:
    x, y, w, h = rng.randint(10, 30), rng.randint(10, 30), rng.randint(20, 50), rng.randint(20, 50)
    text = f"M{x}+{y}h.5.5 {w - 1}e0v{h - 1}.5.5H{x}z"
    return drawing(f'<path d="{text}"/>', shapely.box(x, y, x + w, y + h))


@way
def rounded_rectangle(rng: random.Random) -> Drawing:
    w, h, r = rng.randint(20, 60), rng.randint(20, 60), rng.randint(1, 9)
    core = shapely.box(10 + r, 10 + r, 10 + w - r, 10 + h - r)
    text = rng.choice([f'rx="{r}"', f'ry="{r}"', f'rx="{r}" ry="{r}"', f'rx="auto" ry="{r}"', f'style="rx:{r}px"'])
    if "style" in text:
        text = f'rx="{r}"'
    return drawing(f'<rect x="10" y="10" width="{w}" height="{h}" {text}/>', core.buffer(r, quad_segs=256))


@way
def discs(rng: random.Random) -> Drawing:
    x, y, r = rng.randint(20, 40), rng.randint(20, 40), rng.randint(2, 18)
    a, b = (shapely.Point(c).buffer(r, quad_segs=512) for c in ((x, y), (x + 45, y + 45)))
    text = f"M{x + 45 - r} {y + 45}a{r} {r} 0 10{2 * r} 0 {r} {r} 0 00{-2 * r} 0z"
    return drawing(f'<circle cx="{x}" cy="{y}" r="{r}"/><path d="{text}"/>', shapely.union_all([a, b]))


@way
def turned_ellipse(rng: random.Random) -> Drawing:
    rx, ry, turn = rng.randint(10, 30), rng.randint(4, 9), rng.randint(0, 180)
    disc = affinity.scale(shapely.Point(50, 50).buffer(1, quad_segs=1024), rx, ry)
    shape = affinity.rotate(disc, turn, origin=(50, 50))
    dx, dy = rx * math.cos(math.radians(turn)), rx * math.sin(math.radians(turn))
    begin, end = f"{number(50 - dx)} {number(50 - dy)}", f"{number(50 + dx)} {number(50 + dy)}"
    body = f'<path d="M{begin}A{rx} {ry} {turn} 0 1 {end}A{rx},{ry},{turn},1,1,{begin}"/>'
    return drawing(body, shape)


@way
def arcs(rng: random.Random) -> Drawing:
    """Draw a part of a turned ellipse between two of its points; now and then, radii that are too small."""
    rx, ry, turn = rng.randint(15, 40), rng.randint(8, 30), rng.randint(0, 170)
    first, sweep = rng.uniform(0, 6), rng.choice([-1, 1]) * rng.uniform(0.8, 5.5)
    small = rng.random() < 0.2
    if small:
        sweep = math.copysign(math.pi, sweep)
    c, n = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    points = []
    for k in range(1025):
        x, y = rx * math.cos(first + sweep * k / 1024), ry * math.sin(first + sweep * k / 1024)
        points.append((50 + c * x - n * y, 50 + n * x + c * y))
    share = 0.5 if small else 1
    flags = f"{int(abs(sweep) > math.pi)}{int(sweep > 0)}"
    begin, end = (f"{x:.15g},{y:.15g}" for x, y in (points[0], points[-1]))
    return drawing(f'<path d="M{begin}A{rx * share},{ry * share} {turn} {flags}{end}z"/>', Polygon(points))


@way
def curves(rng: random.Random) -> Drawing:
    """Draw parabolas, by Q and T, and the same as cubics, by C and S."""
    h, w = rng.randint(10, 30), rng.randint(10, 20)
    steps = [k / 256 for k in range(257)]
    first = [(10 + 2 * w * t, 50 - 2 * h * t * (1 - t)) for t in steps]
    second = [(10 + 2 * w + 2 * w * t, 50 + 2 * h * t * (1 - t)) for t in steps]
    shape = Polygon([*first, *second, (10 + 4 * w, 95), (10, 95)])
    if rng.random() < 0.5:
        text = f"M10 50q{w}-{h} {2 * w} 0t{2 * w} 0V95H10z"
    else:
        third, two = 2 * w / 3, 2 * h / 3
        text = (
            f"M10 50c{number(third)} {number(-two)} {number(2 * third)} {number(-two)} {2 * w} 0"
            f"s{number(2 * third)} {number(two)} {2 * w} 0V95H10z"
        )
    return drawing(f'<path d="{text}"/>', shape)


# --- ways: places ---


def random_function(rng: random.Random) -> tuple[str, list[float]]:
    x, y, w = round(rng.uniform(-9, 9), 2), round(rng.uniform(-9, 9), 2), rng.randint(-170, 170)
    s, t = round(rng.uniform(0.5, 2), 2), round(rng.uniform(-2, -0.5), 2)
    c, n = math.cos(math.radians(w)), math.sin(math.radians(w))
    return rng.choice(
        [
            (f"translate({x},{y})", [1, 0, 0, 1, x, y]),
            (f"translate({x})", [1, 0, 0, 1, x, 0]),
            (f"scale({s} {t})", [s, 0, 0, t, 0, 0]),
            (f"scale({s})", [s, 0, 0, s, 0, 0]),
            (f"rotate({w} {x} {y})", [c, n, -n, c, x - c * x + n * y, y - n * x - c * y]),
            (f"skewX({w / 4})", [1, 0, math.tan(math.radians(w / 4)), 1, 0, 0]),
            (f"skewY({w / 4})", [1, math.tan(math.radians(w / 4)), 0, 1, 0, 0]),
            (f"matrix({s} .25,-.5 {s},{x} {y})", [s, 0.25, -0.5, s, x, y]),
        ]
    )


@way
def transforms(rng: random.Random) -> Drawing:
    shape, here = solid(rng), []
    for _ in range(rng.randint(1, 4)):
        here.append(random_function(rng))
    local: BaseGeometry = shape
    for _, matrix in here:
        local = inverse(matrix, local)
    assert isinstance(local, Polygon)
    body = f'<path d="{data(local)}"/>'
    if rng.random() < 0.5:
        return drawing(f'<g transform="{" ".join(text for text, _ in here)}">{body}</g>', shape)
    for text, _ in reversed(here):
        body = f'<g transform="{text}">{body}</g>'
    return drawing(body, shape)


@way
def turned_about_an_origin(rng: random.Random) -> Drawing:
    shape, w, x, y = solid(rng), rng.randint(10, 350), rng.randint(0, 100), rng.randint(0, 100)
    local = affinity.rotate(shape, -w, origin=(x, y))
    text = rng.choice(
        [
            f'transform="rotate({w})" transform-origin="{x} {y}"',
            f'style="transform:rotate({w}deg);transform-origin:{x}px {y}px"',
            f'transform="rotate({w})" style="transform-origin:{x}% {y}%"',
            f'style="transform:rotate({number(w / 360)}turn);transform-origin:{x}% {y}px"',
        ]
    )
    return drawing(f'<path {text} d="{data(local)}"/>', shape)


@way
def css_transform(rng: random.Random) -> Drawing:
    shape, x, y, s = solid(rng), rng.randint(5, 30), rng.randint(-30, 30), rng.choice([0.5, 1.25, 2])
    local = inverse([s, 0, 0, s, x, y], shape)
    assert isinstance(local, Polygon)
    css = f"transform: translate({x}px, {y}px) scale({s})"
    body = rng.choice(
        ['<path style="{0}" d="{1}"/>', '<style>path {{{0}}}</style><path transform="scale(9)" d="{1}"/>']
    )
    return drawing(body.format(css, data(local)), shape)


@way
def turned_about_its_own_middle(rng: random.Random) -> Drawing:
    shape, w = rectangle(rng), rng.randint(10, 80)
    x, y, right, low = shape.bounds
    css = f"transform:rotate({w}deg);transform-origin:center;transform-box:fill-box"
    body = f'<rect style="{css}" x="{x}" y="{y}" width="{number(right - x)}" height="{number(low - y)}"/>'
    return drawing(body, affinity.rotate(shape, w, origin="center"))


ALIGNS = ["none", *(f"x{a}Y{b}" for a in ("Min", "Mid", "Max") for b in ("Min", "Mid", "Max"))]


def viewport(rng: random.Random) -> tuple[str, str, list[float], BaseGeometry]:
    """Return attributes of a viewBox, and of its place; the matrix from one to the other; and the viewport."""
    bx, by, bw, bh = rng.randint(-5, 5), rng.randint(-5, 5), rng.randint(8, 20), rng.randint(8, 20)
    x, y, w, h = rng.randint(5, 20), rng.randint(5, 20), rng.randint(30, 60), rng.randint(30, 60)
    align, fit = rng.choice(ALIGNS), rng.choice(["meet", "slice"])
    sx, sy = w / bw, h / bh
    if align != "none":
        sx = sy = min(sx, sy) if fit == "meet" else max(sx, sy)
    share = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}
    left, top = (
        (0.0, 0.0) if align == "none" else (share[align[1:4]] * (w - bw * sx), share[align[5:8]] * (h - bh * sy))
    )
    view = f'viewBox="{bx} {by} {bw} {bh}" preserveAspectRatio="{align} {fit}"'
    return (
        view,
        f'x="{x}" y="{y}" width="{w}" height="{h}"',
        [sx, 0, 0, sy, x - bx * sx + left, y - by * sy + top],
        shapely.box(x, y, x + w, y + h),
    )


def in_viewport(rng: random.Random, body: str, sizes: bool = True) -> Drawing:
    view, place, matrix, port = viewport(rng)
    box = view.split('"')[1].split()
    bx, by, bw, bh = map(float, box)
    x, y, w, h = bx + bw / 4, by + bh / 4, bw * rng.uniform(0.2, 0.5), bh * rng.uniform(0.2, 0.5)
    inner = f'<rect x="{x}" y="{y}" width="{number(w)}" height="{number(h)}"/>'
    whole = affinity.affine_transform(shapely.box(x, y, x + w, y + h), [matrix[k] for k in (0, 2, 1, 3, 4, 5)])
    return drawing(body.format(view=view, place=place, inner=inner), whole.intersection(port), more=whole)


@way
def nested_svg(rng: random.Random) -> Drawing:
    return in_viewport(rng, "<svg {place} {view}>{inner}</svg>")


@way
def use_of_a_symbol(rng: random.Random) -> Drawing:
    return in_viewport(rng, '<symbol id="s" {view}>{inner}</symbol><use href="#s" {place}/>')


@way
def use_of_an_svg(rng: random.Random) -> Drawing:
    return in_viewport(
        rng, '<defs><svg id="t" width="3" height="7" {view}>{inner}</svg></defs><use href="#t" {place}/>'
    )


@way
def viewport_that_clips(rng: random.Random) -> Drawing:
    x, y, w, h = (rng.randint(10, 40) for _ in range(4))
    whole, port = shapely.box(x - 5, y - 5, x + 2 * w, y + 2 * h), shapely.box(x, y, x + w, y + h)
    inner = f'<rect x="-5" y="-5" width="{2 * w + 5}" height="{2 * h + 5}"/>'
    seen = rng.random() < 0.3
    looks = ' overflow="visible"' if seen else ""
    body = f'<svg x="{x}" y="{y}" width="{w}" height="{h}"{looks}>{inner}</svg>'
    return drawing(body, whole if seen else port, more=whole)


@way
def uses(rng: random.Random) -> Drawing:
    w, h = rng.randint(4, 12), rng.randint(4, 12)
    body, shapes = f'<defs><g id="t" transform="translate(1 2)"><rect width="{w}" height="{h}"/></g></defs>', []
    for k in range(3):
        x, y = 5 + 25 * k, rng.randint(5, 80)
        body += f'<use href="#t" x="{x - 3}" y="{y}" transform="translate(3 0)"/>'
        shapes.append(shapely.box(x + 1, y + 2, x + 1 + w, y + 2 + h))
    return drawing(body, shapely.union_all(shapes))


@way
def percents(rng: random.Random) -> Drawing:
    x, y, w, h = rng.randint(10, 40), rng.randint(10, 40), rng.randint(10, 50), rng.randint(10, 50)
    if rng.random() < 0.5:
        body = f'<rect x="{x}%" y="{y}%" width="{w}%" height="{h}%"/>'
        return drawing(body, shapely.box(x, y, x + w, y + h))
    body = f'<svg width="80" height="40"><circle cx="25%" cy="50%" r="{w / 4}%" /></svg>'
    radius = w / 400 * math.sqrt((80**2 + 40**2) / 2)
    return drawing(body, shapely.Point(20, 20).buffer(radius, quad_segs=256).intersection(shapely.box(0, 0, 80, 40)))


@way
def units(rng: random.Random) -> Drawing:
    unit, pixels = rng.choice(
        [("in", 96.0), ("cm", 96 / 2.54), ("mm", 9.6 / 2.54), ("pt", 4 / 3), ("pc", 16.0), ("px", 1.0)]
    )
    w = rng.randint(10, 90)
    body = f'<rect x="5" y="5" width="{number(w / pixels)}{unit}" height="10px"/>'
    return drawing(body, shapely.box(5, 5, 5 + w, 15))


# --- ways: parts that are not drawn ---


@way
def hidden_parts(rng: random.Random) -> Drawing:
    a, b = shapely.box(10, 10, 30, 20 + rng.randint(1, 20)), shapely.box(60, 60, 80, 90)
    off, on = f'<path d="{data(b)}"/>', f'<path visibility="visible" display="inline" d="{data(a)}"/>'
    body = rng.choice(
        [
            f'<g display="none">{off}</g>{on}',
            f'<g visibility="hidden">{off}{on}</g>',
            f'<g style="visibility:collapse">{off}{on}</g>',
            f'<style>.x g > path {{ display: none }} #a {{display:inline}}</style><g class="x"><g>{off}</g></g>{on}',
            f'<style>@media all {{ .x {{ visibility: hidden }} }}</style><g class="x">{off}{on}</g>',
            f"<style>g {{ display: inline !important }} .x {{ display: none !important }}</style>"
            f'<g class="x" style="display:inline">{off}</g>{on}',
            f'<defs>{off}</defs><symbol>{off}</symbol><pattern id="p">{off}</pattern>{on}',
            f'<switch><g systemLanguage="xx">{off}</g><g systemLanguage="en, de">{on}</g>{off}</switch>',
            f'<switch><g requiredExtensions="http://example.org/none">{off}</g>{on}{off}</switch>',
            f'<g transform="scale(0)">{off}</g>{on}',
        ]
    )
    return drawing(body, a)


@way
def clip_path(rng: random.Random) -> Drawing:
    whole, kept = shapely.box(5, 5, 95, 95), rng.choice([rectangle, star, comb])(rng)
    body = f'<clipPath id="c"><path d="{data(kept)}"/></clipPath><path clip-path="url(#c)" d="{data(whole)}"/>'
    return drawing(body, kept, more=whole)


@way
def clip_of_several_shapes(rng: random.Random) -> Drawing:
    """Clip a plate by a union with rules, uses, hidden shapes and another clip."""
    whole, a, b = plate(rng), star(rng), rectangle(rng)
    other = affinity.translate(comb(rng), rng.randint(-5, 30), rng.randint(-5, 5))
    turn = rng.randint(5, 85)
    disc = shapely.Point(70, 70).buffer(15, quad_segs=512)
    extra = f'<path d="{data(b)}" transform="rotate({turn} 50 50)"/>'
    body = (
        f'<defs><path id="u" d="{data(a)}"/></defs><clipPath id="o"><path d="{data(other)}"/></clipPath>'
        f'<clipPath id="c"><use href="#u" clip-path="url(#o)"/>{extra}<circle cx="70" cy="70" r="15"/>'
        f'<rect visibility="hidden" width="99" height="99"/><rect display="none" width="99" height="99"/></clipPath>'
        f'<path fill-rule="evenodd" clip-path="url(#c)" d="{data(whole)}"/>'
    )
    kept = shapely.union_all([a.intersection(other), affinity.rotate(b, turn, origin=(50, 50)), disc])
    return drawing(body, whole.intersection(kept))


@way
def clip_in_shares_of_a_box(rng: random.Random) -> Drawing:
    body, even = rectangle(rng), rng.random() < 0.5
    x, y, right, low = body.bounds
    shares = [(rng.randint(0, 60) / 100, rng.randint(0, 60) / 100) for _ in range(2)]
    boxes = [shapely.box(p, q, p + 0.4, q + 0.4) for p, q in shares]
    rule = "evenodd" if even else "nonzero"
    text = (
        f'<clipPath id="c" clipPathUnits="objectBoundingBox"><path clip-rule="{rule}" d="{"".join(map(data, boxes))}"/>'
        f'</clipPath><rect clip-path="url(#c)" x="{x}" y="{y}" width="{number(right - x)}" height="{number(low - y)}"/>'
    )
    union = boxes[0].symmetric_difference(boxes[1]) if even else boxes[0].union(boxes[1])
    kept = affinity.translate(affinity.scale(union, right - x, low - y, origin=(0, 0)), x, y)
    return drawing(text, body.intersection(kept))


@way
def clipped_curves(rng: random.Random) -> Drawing:
    r, x, y = rng.randint(15, 40), rng.randint(30, 70), rng.randint(30, 70)
    kept = solid(rng)
    body = f'<clipPath id="c"><polygon points="{listed(corners(kept.exterior))}"/></clipPath>'
    disc = shapely.Point(x, y).buffer(r, quad_segs=512)
    return drawing(f'{body}<g clip-path="url(#c)"><circle cx="{x}" cy="{y}" r="{r}"/></g>', disc.intersection(kept))


@way
def broken_path(rng: random.Random) -> Drawing:
    shape = solid(rng)
    fault = rng.choice(["L 5", "x", "L 1 1,,2 2", "A 1 1 0 2 0 5 5", "L 1e", "h x"])
    return drawing(f'<path d="{data(shape)}{fault} 90 90 L 0 90"/>', shape)


@way
def pentagram(rng: random.Random) -> Drawing:
    even, turn = rng.random() < 0.5, rng.uniform(0, 6)
    tips = [
        (50 + 40 * math.cos(turn + 4 * math.pi * k / 5), 50 + 40 * math.sin(turn + 4 * math.pi * k / 5))
        for k in range(5)
    ]
    lines = shapely.union_all([shapely.LineString([tips[k - 1], tips[k]]) for k in range(5)])
    faces = list(shapely.polygonize([*lines.geoms]).geoms)
    middle = max(faces, key=lambda face: len(face.exterior.coords))
    truth = shapely.union_all([face for face in faces if not even or face is not middle])
    return drawing(f'<path fill-rule="{"evenodd" if even else "nonzero"}" d="M{listed(tips)}z"/>', truth)


@way
def overlapping_subpaths(rng: random.Random) -> Drawing:
    a, b, even = rectangle(rng), rectangle(rng), rng.random() < 0.5
    truth = a.symmetric_difference(b) if even else a.union(b)
    return drawing(f'<path fill-rule="{"evenodd" if even else "nonzero"}" d="{data(a)}{data(b)}"/>', truth)


@way
def spike(rng: random.Random) -> Drawing:
    w, h = rng.randint(20, 50), rng.randint(20, 50)
    return drawing(f'<path d="M20 20h{w}v{h}h-{w / 2}v9v-9h0h-{w / 2}z"/>', shapely.box(20, 20, 20 + w, 20 + h))


def pieces(rng: random.Random, shape: Polygon) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """Return the sides of a polygon in any order and direction."""
    sides = []
    for ring in (shape.exterior, *shape.interiors):
        points = corners(ring)
        sides += [
            (p, q) if rng.random() < 0.5 else (q, p) for p, q in zip(points, points[1:] + points[:1], strict=True)
        ]
    rng.shuffle(sides)
    return sides


@way
def outline_of_pieces(rng: random.Random) -> Drawing:
    shape = plate(rng)
    look = rng.choice(['fill="none" stroke="red"', 'stroke="red"', ""])
    sides = [
        f'<path {look} d="M{listed([p])}L{listed([q])}"/>'
        if rng.random() < 0.5
        else f'<line x1="{p[0]}" y1="{p[1]}" x2="{q[0]}" y2="{q[1]}"/>'
        for p, q in pieces(rng, shape)
    ]
    return drawing(f"<g>{''.join(sides)}</g>", shape, painted=False)


@way
def pieces_around_a_circle(rng: random.Random) -> Drawing:
    body, r = shapely.box(10, 10, 90, rng.randint(60, 90)), rng.randint(5, 20)
    sides = "".join(f'<line x1="{p[0]}" y1="{p[1]}" x2="{q[0]}" y2="{q[1]}"/>' for p, q in pieces(rng, body))
    circle = f'<circle cx="50" cy="35" r="{r}" fill="none" stroke="red"/>'
    shape = body.difference(shapely.Point(50, 35).buffer(r, quad_segs=256))
    return drawing(f"<g>{sides}{circle}</g>", shape, painted=False)


@way
def frame_around_furniture(rng: random.Random) -> Drawing:
    """Draw an unfilled frame, unfilled furniture in it, and a line that belongs to neither."""
    frame, table = shapely.box(5, 5, 95, 95), rectangle(rng)
    looks = 'fill="none" stroke="red"'
    body = f'<path {looks} d="{data(frame)}"/><path {looks} d="{data(table)}"/><line x1="1" y1="1" x2="3" y2="2"/>'
    return drawing(body, frame, painted=False)


TRUSTED = {
    "packed_numbers": ("resvg",),
    "css_transform": ("cairosvg",),
    "turned_about_an_origin": (),
    "turned_about_its_own_middle": (),
    "hidden_parts": ("resvg",),
    "rounded_rectangle": ("resvg",),
    "broken_path": ("resvg",),
    "use_of_an_svg": ("resvg",),
    "clip_of_several_shapes": ("resvg",),
    "clip_in_shares_of_a_box": ("resvg",),
}
"""Renderers that draw a way rightly, if not all do."""


def make(name: str, seed: int) -> Drawing:
    """Return the drawing of a way and a seed."""
    return WAYS[name](random.Random(f"{name} {seed}"))


def verdict(drawn: Drawing, path: Path) -> str:
    """Read a drawing; return its fault, or the empty string if it is read rightly or its faults are said."""
    import cfree

    path.write_text(drawn.text)
    shapes = cfree.load_shapes(path, tolerance=TOLERANCE)
    region = shapely.union_all([shape.polygon.to_shapely() for shape in shapes.shapes])
    region = affinity.scale(region, 1, -1, origin=(0, 0))
    slack = 2 * TOLERANCE * drawn.truth.length + 1e-9
    missing = drawn.truth.difference(region).area
    invented = region.difference(drawn.truth).area
    if missing > 1e-3 * slack:
        return f"{missing:.3g} of {drawn.truth.area:.5g} is missing"
    if invented > slack:
        said = drawn.more is not None and any(note.effect == "more" for note in shapes.reading)
        if not said or region.difference(drawn.more).area > slack:
            return f"{invented:.3g} beside {drawn.truth.area:.5g} is invented"
    return ""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--way", nargs="*")
    options = parser.parse_args()
    wrong: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for name in options.way or WAYS:
            for seed in range(options.seed, options.seed + options.count):
                try:
                    fault = verdict(make(name, seed), Path(folder, "a.svg"))
                except Exception as error:
                    fault = f"{type(error).__name__}: {str(error)[-120:]}"
                if fault:
                    wrong[name] += 1
                    if wrong[name] == 1:
                        print(f"{name} {seed}: {fault}")
    print(dict(wrong), f"{wrong.total()} wrong")
    return int(bool(wrong))


if __name__ == "__main__":
    raise SystemExit(main())
