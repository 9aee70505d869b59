"""Hostile files for readers: small texts that ask for much depth, time or memory."""

from __future__ import annotations

import gzip
import json
import math
import random
import zlib
from collections.abc import Callable

Bomb = Callable[[random.Random, int], tuple[str, bytes]]
BOMBS: dict[str, Bomb] = {}
"""Writers of a file of about n parts; each returns the file's name and content."""
SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="90mm" viewBox="0 0 90 90">{}</svg>'


def bomb(write: Bomb) -> Bomb:
    """Register a writer."""
    BOMBS[write.__name__] = write
    return write


def made(name: str, rng: random.Random, most: int) -> tuple[str, bytes]:
    """Return a bomb of a random size up to `most`; each power of ten is as probable."""
    return BOMBS[name](rng, round(10 ** rng.uniform(0.5, math.log10(most))))


def svg(body: str, head: str = "") -> tuple[str, bytes]:
    return "bomb.svg", (head + SVG.format(body)).encode()


def _points(rng: random.Random, n: int) -> list[tuple[float, float]]:
    return [(round(rng.uniform(0, 90), 3), round(rng.uniform(0, 90), 3)) for _ in range(n)]


# SVG


@bomb
def svg_deep_groups(rng: random.Random, n: int) -> tuple[str, bytes]:
    tag = rng.choice(["g", "svg", "switch", "a", "clipPath", "defs"])
    return svg(f"<{tag}>" * n + "<rect width='3' height='4'/>" + f"</{tag}>" * n)


@bomb
def svg_entities(rng: random.Random, n: int) -> tuple[str, bytes]:
    fold = rng.choice([2, 10])
    entities = "".join(f'<!ENTITY e{k + 1} "{f"&e{k};" * fold}">' for k in range(min(n, 300)))
    last = f"&e{min(n, 300)};"
    return svg(f"<text>{last}</text><path d='{last}'/>", f'<!DOCTYPE svg [<!ENTITY e0 "1 2">{entities}]>')


@bomb
def svg_outer_entity(rng: random.Random, n: int) -> tuple[str, bytes]:
    name = rng.choice(["/etc/passwd", "http://localhost:1/", "../a.svg", "map.pgm"])
    return svg("<text>&a;</text><image href='/etc/passwd'/>", f'<!DOCTYPE svg [<!ENTITY a SYSTEM "{name}">]>')


@bomb
def svg_many_uses(rng: random.Random, n: int) -> tuple[str, bytes]:
    return svg("<defs><rect id='a' width='3' height='4'/></defs>" + "<use href='#a' x='1'/>" * n)


@bomb
def svg_uses_of_uses(rng: random.Random, n: int) -> tuple[str, bytes]:
    fold, depth = rng.choice([1, 2, 10]), min(n, 2000)
    uses = [f"<use href='#a{k}' y='{k}'/>" * fold for k in range(depth - 1)]
    groups = [f"<g id='a{k + 1}'>{use}</g>" for k, use in enumerate(uses)]
    cycle = f"<use href='#a{depth - 1}'/>" if rng.random() < 0.3 else ""
    return svg(f"<defs><g id='a0'>{cycle}<circle r='1'/></g>{''.join(groups)}</defs><use href='#a{depth - 1}'/>")


@bomb
def svg_crossing_lines(rng: random.Random, n: int) -> tuple[str, bytes]:
    lines = "".join(
        f"<line x1='{a}' y1='0' x2='{b}' y2='90' stroke-width='{rng.choice(['.1', '9'])}'/>" for a, b in _points(rng, n)
    )
    return svg(f"<g fill='none' stroke='red'>{lines}</g>")


@bomb
def svg_crossing_outline(rng: random.Random, n: int) -> tuple[str, bytes]:
    points = " ".join(f"{x},{y}" for x, y in _points(rng, n))
    return svg(f"<polygon fill-rule='{rng.choice(['evenodd', 'nonzero'])}' points='{points}'/>")


@bomb
def svg_crossing_curves(rng: random.Random, n: int) -> tuple[str, bytes]:
    parts = (f"C{x} {y} {y} {x} {x / 2} {y}" for x, y in _points(rng, n))
    return svg(f"<path d='M1 1{''.join(parts)}z'/>")


@bomb
def svg_clips_of_clips(rng: random.Random, n: int) -> tuple[str, bytes]:
    depth = min(n, 3000)
    clips = (
        f"<clipPath id='c{k}' clip-path='url(#c{k - 1})'>"
        f"<rect width='{50 + k}' height='70' clip-path='url(#c{k - 1})'/>"
        f"<circle r='{k}' clip-path='url(#c{k - 1})'/></clipPath>"
        for k in range(depth)
    )
    return svg(f"{''.join(clips)}<g clip-path='url(#c{depth - 1})'><circle r='80'/></g>")


@bomb
def svg_clip_of_many(rng: random.Random, n: int) -> tuple[str, bytes]:
    discs = "".join(f"<circle cx='{x}' cy='{y}' r='5'/>" for x, y in _points(rng, n))
    return svg(f"<clipPath id='c'>{discs}</clipPath><rect clip-path='url(#c)' width='90' height='90'/>")


@bomb
def svg_styles(rng: random.Random, n: int) -> tuple[str, bytes]:
    n = min(n, 30_000)
    rule = rng.choice(["g g g > rect.a{k} + rect", ":not(.b{k})", "#x{k}, .y{k} ~ rect", "*", "rect:nth-child({k}n+1)"])
    rules = "".join(rule.replace("{k}", str(k)) + "{fill-rule:evenodd;transform:scale(1)}" for k in range(n))
    return svg(f"<style>{rules}</style>" + "<rect class='a b' width='1' height='1'/>" * n)


@bomb
def svg_nested_styles(rng: random.Random, n: int) -> tuple[str, bytes]:
    a, b = rng.choice(["()", "[]", "{}", ("@media all{", "}"), (":not(", ")"), ("calc(", ")"), ("url(", ")")])
    place = rng.choice(
        ["<style>{}</style><rect/>", "<rect style='transform:{}'/>", "<rect transform='{}'/>", "<rect width='{}'/>"]
    )
    return svg(place.format(a * n + "1" + b * n))


@bomb
def svg_transforms(rng: random.Random, n: int) -> tuple[str, bytes]:
    part = rng.choice(["rotate(17.3)", "scale(1.37)", "skewX(89.9999)", "matrix(1 2 3 4 5 6.7)", "scale(1e-9)"])
    return svg(f"<rect transform='{part * n}' width='1' height='1'/>")


@bomb
def svg_long_numbers(rng: random.Random, n: int) -> tuple[str, bytes]:
    number = rng.choice(["9" * n, "0." + "1" * n, f"1e{n}", f"-1e-{n}", "1" + "0" * n + f"e-{n}"])
    place = rng.choice(
        [
            "<rect width='{0}' height='1'/>",
            "<path d='M0 0L{0} 1 1 {0}z'/>",
            "<circle r='{0}'/>",
            "<path d='M0 0a{0} 1 {0} 1 0 5 5z'/>",
        ]
    )
    return svg(place.format(number))


@bomb
def svg_settings(rng: random.Random, n: int) -> tuple[str, bytes]:
    data = rng.choice(["[" * n, '{"goals":' + "[" * n + "]" * n + "}", "9" * n, f'{{"bounds": [0, 0, 1e{n}, 1]}}'])
    return "bomb.svg", SVG.replace("<svg ", f"<svg data-cfree='{data}' ").format(
        "<rect width='1' height='1'/>"
    ).encode()


@bomb
def svgz_of_zeros(rng: random.Random, n: int) -> tuple[str, bytes]:
    return "bomb.svgz", gzip.compress(SVG.format(" " * min(1000 * n, 200_000_000)).encode(), 1, mtime=0)


# DXF


def dxf_text(entities: str, blocks: str = "") -> tuple[str, bytes]:
    parts = {"BLOCKS": blocks, "ENTITIES": entities}
    sections = (f"  0\nSECTION\n  2\n{name}\n{body}  0\nENDSEC\n" for name, body in parts.items())
    return "bomb.dxf", f"{''.join(sections)}  0\nEOF\n".encode()


def tags(*pairs: object) -> str:
    return "".join(f"{code:>3}\n{value}\n" for code, value in zip(pairs[::2], pairs[1::2], strict=True))


@bomb
def dxf_blocks_of_blocks(rng: random.Random, n: int) -> tuple[str, bytes]:
    fold, depth = rng.choice([1, 2, 10]), min(n, 300)
    blocks = ""
    for k in range(depth):
        inner = tags(0, "CIRCLE", 8, "0", 10, 1, 20, 1, 40, 1)
        if k or rng.random() < 0.2:
            inner = tags(0, "INSERT", 8, "0", 2, f"B{(k or depth) - 1}", 10, k, 20, 1) * fold
        blocks += tags(0, "BLOCK", 8, "0", 2, f"B{k}", 70, 0, 10, 0, 20, 0) + inner + tags(0, "ENDBLK", 8, "0")
    return dxf_text(tags(0, "INSERT", 8, "0", 2, f"B{depth - 1}", 10, 0, 20, 0), blocks)


@bomb
def dxf_rows_and_columns(rng: random.Random, n: int) -> tuple[str, bytes]:
    blocks = tags(
        0, "BLOCK", 8, "0", 2, "B", 70, 0, 10, 0, 20, 0, 0, "CIRCLE", 8, "0", 10, 1, 20, 1, 40, 1, 0, "ENDBLK", 8, "0"
    )
    rows = rng.choice([n, n * n, -1, 32767])
    return dxf_text(
        tags(0, "INSERT", 8, "0", 2, "B", 10, 0, 20, 0, 70, rows, 71, n, 44, rng.choice([0, 2]), 45, 2), blocks
    )


@bomb
def dxf_crossing_lines(rng: random.Random, n: int) -> tuple[str, bytes]:
    lines = (tags(0, "LINE", 8, "a", 10, a, 20, 0, 11, b, 21, 90) for a, b in _points(rng, n))
    return dxf_text("".join(lines))


@bomb
def dxf_crossing_circles(rng: random.Random, n: int) -> tuple[str, bytes]:
    return dxf_text("".join(tags(0, "CIRCLE", 8, "a", 10, a, 20, b, 40, 40) for a, b in _points(rng, n)))


@bomb
def dxf_doubled_lines(rng: random.Random, n: int) -> tuple[str, bytes]:
    box = ((0, 0, 9, 0), (9, 0, 9, 9), (9, 9, 0, 9), (0, 9, 0, 0))
    return dxf_text("".join(tags(0, "LINE", 8, "a", 10, a, 20, b, 11, c, 21, d) for a, b, c, d in box) * n)


@bomb
def dxf_spline(rng: random.Random, n: int) -> tuple[str, bytes]:
    degree = rng.choice([1, 3, 5, 11, 100, n])
    knots = [rng.choice([k, 0, 1e300, -k]) if rng.random() < 0.1 else k for k in range(min(n + degree + 1, 300_000))]
    weights = [rng.choice([1, 0, -1, 1e300]) for _ in range(n)] if rng.random() < 0.3 else []
    text = tags(0, "SPLINE", 100, "AcDbEntity", 8, "a", 100, "AcDbSpline", 70, 1, 71, degree, 72, len(knots), 73, n)
    text += "".join(tags(40, k) for k in knots) + "".join(tags(41, w) for w in weights)
    return dxf_text(text + "".join(tags(10, x, 20, y, 30, 0) for x, y in _points(rng, n)))


@bomb
def dxf_polyline(rng: random.Random, n: int) -> tuple[str, bytes]:
    text = tags(0, "LWPOLYLINE", 8, "a", 90, rng.choice([n, 10**9]), 70, 1, 43, rng.choice([0, 0, 3]))
    bulges = [rng.choice([0, 0.3, 1e9, -1, 1e-12]) for _ in range(4)]
    return dxf_text(text + "".join(tags(10, x, 20, y, 42, bulges[k % 4]) for k, (x, y) in enumerate(_points(rng, n))))


@bomb
def dxf_hatch(rng: random.Random, n: int) -> tuple[str, bytes]:
    text = tags(0, "HATCH", 8, "a", 10, 0, 20, 0, 30, 0, 2, "SOLID", 70, 1, 71, 0, 91, n)
    for x, y in _points(rng, n):
        text += tags(
            92, 3, 72, 0, 73, 1, 93, 4, 10, x, 20, y, 10, x + 9, 20, y, 10, x + 9, 20, y + 9, 10, x, 20, y + 9, 97, 0
        )
    return dxf_text(text + tags(75, 0, 76, 1, 98, 0))


@bomb
def dxf_ellipses(rng: random.Random, n: int) -> tuple[str, bytes]:
    angle = rng.choice([7, 1e9, 1e300])
    ratio = rng.choice([1, 0, 1e-12, 1e9, -1])
    return dxf_text(
        "".join(
            tags(0, "ELLIPSE", 8, "a", 10, x, 20, y, 11, 9, 21, 3, 40, ratio, 41, 0, 42, angle)
            for x, y in _points(rng, n)
        )
    )


# text and JSON


@bomb
def json_depth(rng: random.Random, n: int) -> tuple[str, bytes]:
    a, b = rng.choice([("[", "]"), ('{"type":"GeometryCollection","geometries":[', "]}"), ('{"outer":', "}")])
    return "bomb.json", (a * n + b * n).encode()


@bomb
def geojson_rings(rng: random.Random, n: int) -> tuple[str, bytes]:
    if rng.random() < 0.5:
        points = [*_points(rng, n)]
        shape: dict[str, object] = {"type": "Polygon", "coordinates": [[*points, points[0]]]}
    else:
        boxes = [[[[x, y], [x + 9, y], [x + 9, y + 9], [x, y + 9], [x, y]]] for x, y in _points(rng, n)]
        shape = {"type": "MultiPolygon", "coordinates": boxes}
    return "bomb.geojson", json.dumps(shape).encode()


@bomb
def geojson_lines(rng: random.Random, n: int) -> tuple[str, bytes]:
    width = rng.choice([0, 1, 1e-9, 100])
    kind, key = rng.choice([("LineString", "width"), ("MultiPoint", "radius")])
    geometry = {"type": kind, "coordinates": _points(rng, n)}
    return "bomb.geojson", json.dumps({"type": "Feature", "geometry": geometry, "properties": {key: width}}).encode()


@bomb
def wkt_depth(rng: random.Random, n: int) -> tuple[str, bytes]:
    points = ", ".join(f"{x} {y}" for x, y in _points(rng, n))
    return "bomb.wkt", rng.choice([f"POLYGON {'(' * n}", f"POLYGON (({points}))", "POLYGON ((" + "9" * n]).encode()


@bomb
def scene_of_notes(rng: random.Random, n: int) -> tuple[str, bytes]:
    note = {
        "kind": "lost",
        "what": rng.choice(["x", "a\nb", "\x1b[2J", ""]),
        "count": rng.choice([1, 2**62, 2**70]),
        "at": [1, 2],
    }
    shape = {"outer": [[0, 0], [1, 0], [0, 1]]}
    return "bomb.json", json.dumps(
        {"robot": shape, "obstacles": [], "reading": [note | {"where": str(k)} for k in range(n)]}
    ).encode()


@bomb
def nesting_demand(rng: random.Random, n: int) -> tuple[str, bytes]:
    shape = {"type": "simple_polygon", "data": [[0, 0], [1, 0], [0, 1]]}
    item = {"id": 0, "demand": rng.choice([n, 10**n if n < 4000 else 1]), "shape": shape}
    place = {"item_id": 0, "transformation": {"rotation": 1e9, "translation": [1, 2]}}
    layout = {"container_id": 0, "density": 0.5, "placed_items": [place] * n}
    data = {"name": "x", "items": [item], "strip_height": 10, "solution": {"strip_width": 3, "layout": layout}}
    return "bomb.json", json.dumps(data).encode()


# YAML and maps


@bomb
def yaml_depth(rng: random.Random, n: int) -> tuple[str, bytes]:
    return "bomb.yaml", rng.choice(
        ["[" * n, "{a: " * n, "- " * n, "? " * n, "".join(f"{' ' * k}a:\n" for k in range(min(n, 3000)))]
    ).encode()


@bomb
def yaml_aliases(rng: random.Random, n: int) -> tuple[str, bytes]:
    lines = ["a0: &a0 [[1, 2], [3, 4]]"] + [
        f"a{k}: &a{k} [{', '.join([f'*a{k - 1}'] * 10)}]" for k in range(1, min(n, 2000))
    ]
    return "bomb.yaml", "\n".join([*lines, f"footprint: *a{min(n, 2000) - 1}"]).encode()


MAP = "image: {}\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"


@bomb
def map_of_a_huge_image(rng: random.Random, n: int) -> tuple[str, bytes]:
    return "map.yaml", MAP.format("map.pgm").encode()  # the image comes from `image`


@bomb
def movingai(rng: random.Random, n: int) -> tuple[str, bytes]:
    side = min(n, 3000)
    rows = "\n".join("".join("@."[(row + k) % 2] for k in range(side)) for row in range(side))
    size = rng.choice([side, 10**9, side + 1, "9" * n])
    return "bomb.map", f"type octile\nheight {side}\nwidth {size}\nmap\n{rows}\n".encode()


def image(rng: random.Random, n: int) -> bytes:
    """Return the image of a map: a header that promises much, a bomb of zeros, specks, or a chessboard."""
    side = min(n, 2500)
    match rng.randrange(5):
        case 0:
            return b"P5 %d %d 255\n\0" % (n, rng.choice([n, 1, 10**9]))
        case 1:
            return _png(n, n)
        case 2:
            return b"P5 %d %d 255\n" % (side, side) + rng.randbytes(side * side)
        case 3:
            return b"P2 %d 1 255\n" % side + b"0 254 " * side
        case _:
            row = bytes([0, 254]) * side
            return b"P5 %d %d 255\n" % (2 * side, side) + (row + row[::-1]) * (side // 2 + 1)


def _png(width: int, height: int) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return len(data).to_bytes(4, "big") + kind + data + zlib.crc32(kind + data).to_bytes(4, "big")

    head = width.to_bytes(4, "big") + height.to_bytes(4, "big") + b"\x08\0\0\0\0"
    rows = zlib.compress(bytes((width + 1) * min(height, 100_000_000 // width)), 1)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


@bomb
def urdf_chain(rng: random.Random, n: int) -> tuple[str, bytes]:
    link = '<link name="l{0}"><collision><geometry><box size="1 1 1"/></geometry></collision></link>'
    joint = '<joint name="j{0}" type="fixed"><parent link="l{0}"/><child link="l{1}"/><origin rpy="0 0.1 1"/></joint>'
    last = rng.choice([0, n])
    parts = "".join(link.format(k) + joint.format(k, k + 1 if k < n - 1 else last) for k in range(n))
    return "bomb.urdf", f'<robot name="r">{parts}</robot>'.encode()
