"""The rules of the map servers, against their loops over pixels written out one by one."""

from __future__ import annotations

import math
from collections.abc import Iterator
from io import BytesIO
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from cfree.formats.drawings.map_rules import SERVERS, Colours, Thresholds, published
from cfree.formats.drawings.source import Reading
from cfree.formats.readers import read_file
from cfree.formats.shapes import Shapes

f32 = np.float32
Pixel = tuple[int, ...]
"""Bytes of a pixel: grey, grey and alpha, red, green and blue, or these and alpha."""


def ros1(pixel: Pixel, occ_th: float, free_th: float, negate: bool, mode: str) -> int:
    p = (pixel[0], pixel[0], pixel[0], pixel[1]) if len(pixel) == 2 else pixel  # SDL_image
    n_channels = len(p)
    avg_channels = n_channels if mode == "trinary" or n_channels != 4 else 3
    color_avg = sum(p[:avg_channels]) / avg_channels
    alpha = 1 if n_channels == 1 else p[-1]
    if negate:
        color_avg = 255 - color_avg
    if mode == "raw":
        value = int(color_avg)
        return value if value < 128 else value - 256  # a signed char
    occ = (255 - color_avg) / 255.0
    if occ > occ_th:
        return 100
    if occ < free_th:
        return 0
    if mode == "trinary" or alpha < 1.0:
        return -1
    ratio = (occ - free_th) / (occ_th - free_th) if occ_th > free_th else math.nan
    return -1 if math.isnan(ratio) else int(99 * ratio)


def nav2_old(pixel: Pixel, occ_th: float, free_th: float, negate: bool, mode: str) -> int:
    deep = [257 * byte for byte in pixel]
    alpha = deep[-1] if len(pixel) in (2, 4) else None
    channels = deep[:3] if len(pixel) > 2 else deep[:1] * 3
    if mode == "trinary" and alpha is not None:
        channels.append(alpha)
    shade = float(sum(channels)) / len(channels) / 65535.0
    occ = shade if negate else 1.0 - shade
    if mode == "raw":
        percent = math.floor(shade * 255 + 0.5)
        return percent if 0 <= percent <= 100 else -1
    if mode == "scale" and alpha is not None and alpha != 65535:
        return -1
    if occ_th < occ:
        return 100
    if occ < free_th:
        return 0
    if mode == "trinary" or occ_th <= free_th:
        return -1
    return round((occ - free_th) / (occ_th - free_th) * 100.0)


def nav2(pixel: Pixel, occ_th: float, free_th: float, negate: bool, mode: str) -> int:
    red, green, blue = pixel[:3] if len(pixel) > 2 else pixel[:1] * 3
    grey = (306 * 257 * red + 601 * 257 * green + 117 * 257 * blue) // 1024 // 257
    if mode == "raw":
        value = grey if grey < 128 else grey - 256
        return value if 0 <= value <= 100 else -1
    normalized = f32(grey) / f32(255)
    if not negate:
        normalized = f32(1) - normalized
    result = -1
    if normalized >= f32(occ_th):
        result = 100
    if normalized <= f32(free_th):
        result = 0
    if mode == "scale" and f32(free_th) < normalized < f32(occ_th):
        scaled = (normalized - f32(free_th)) / f32(occ_th - free_th) * f32(100)
        result = int(f32(math.floor(float(scaled) + 0.5)))
    if len(pixel) in (2, 4) and pixel[-1] < 255:
        result = -1
    return result


ORACLES = dict(zip(SERVERS, (ros1, nav2_old, nav2), strict=True))
LIMITS = [
    (0.65, 0.196),
    (0.65, 0.25),
    (1.0, 0.0),
    (0.8, 0.2),
    (0.6, 0.4),
    (0.4, 0.4),
    (0.3, 0.7),
    (0.5, 0.196079),
    (0.19607843, 0.1),
]


def rank(value: int) -> int:
    """How much a value forbids: free, unknown, in between, occupied."""
    return {0: 0, -1: 1, 100: 3}.get(value, 2)


def plain(value: int) -> int:
    """The value of a server as an occupancy: ROS 1 publishes more than 100, and negative ones."""
    return -1 if value < 0 else min(value, 100)


def is_near(pixel: Pixel, limits: tuple[float, float]) -> bool:
    """True if some server's share of a pixel is as good as on a threshold."""
    shades = [pixel[0] / 255, *([(3 * pixel[0] + pixel[1]) / 4 / 255] if len(pixel) == 2 else [])]
    return any(abs(share - limit) < 2e-6 for shade in shades for share in (shade, 1 - shade) for limit in limits)


def cases(alphas: tuple[int | None, ...]) -> Iterator[tuple[tuple[float, float], bool, Any, list[Pixel], Colours]]:
    for limits, negate, mode, alpha in product(LIMITS, (False, True), ("trinary", "scale", "raw"), alphas):
        rgb = np.repeat(np.arange(256)[:, None] * 257, 3, axis=1)
        opacity = None if alpha is None else np.full(256, 257 * alpha)
        pixels = [(grey,) if alpha is None else (grey, alpha) for grey in range(256)]
        yield limits, negate, mode, pixels, Colours(rgb, opacity)


@pytest.mark.parametrize("alphas", [(None,), pytest.param((0, 1, 128, 254, 255), marks=pytest.mark.slow)])
def test_each_rule_is_that_of_its_server_and_strict_is_the_strictest(alphas: tuple[int | None, ...]) -> None:
    for limits, negate, mode, pixels, colours in cases(alphas):
        results = {server: published(server, colours, Thresholds(*limits, negate, mode)) for server in SERVERS}
        strict = published("strict", colours, Thresholds(*limits, negate, mode))
        for k, pixel in enumerate(pixels):
            expected = {name: plain(oracle(pixel, *limits, negate, mode)) for name, oracle in ORACLES.items()}
            case = f"{pixel} {limits} {negate} {mode} {expected}"
            for server in SERVERS:
                value = int(results[server][k])
                if is_near(pixel, limits) and mode != "raw":
                    assert rank(value) >= rank(expected[server]), f"{case} {server} {value}"
                else:
                    assert value == expected[server], f"{case} {server} {value}"
            assert rank(int(strict[k])) >= max(map(rank, expected.values())), f"{case} strict {strict[k]}"
            if not is_near(pixel, limits):
                most = max(expected.values())
                assert strict[k] == (most if most > 0 else min(expected.values())), f"{case} strict {strict[k]}"


def test_a_share_on_a_threshold_counts_as_on_it() -> None:
    grey = Colours(np.array([[153 * 257] * 3, [204 * 257] * 3, [51 * 257] * 3]))
    assert published("nav2", grey, Thresholds(0.4, 0.1))[0] == 100  # in single precision the share is below 0.4
    assert published("nav2-old", grey, Thresholds(0.9, 0.2))[1] == -1  # in doubles it is below 0.2
    assert published("nav2", grey, Thresholds(0.9, 0.2))[1] == 0
    assert published("ros1", grey, Thresholds(0.8, 0.2))[2] == -1
    assert published("strict", grey, Thresholds(0.8, 0.2)).tolist() == [-1, -1, 100]
    clear = Colours(np.zeros((1, 3), int), np.zeros(1, int))  # black and transparent: no server publishes 100
    assert published("strict", clear, Thresholds(1.0, 0.2)) == 100


def image(mode: str, seed: int) -> tuple[bytes, list[list[Pixel]]]:
    """A random PNG of a mode, and the bytes of its pixels."""
    random = np.random.default_rng(seed)
    palette = np.array([0, 51, 89, 100, 127, 204, 205, 255])
    channels = {"L": 1, "LA": 2, "RGB": 3, "RGBA": 4}[mode]
    pixels = random.choice(palette, (7, 9, channels)).astype(np.uint8)
    if mode in ("LA", "RGBA"):
        pixels[..., -1] = random.choice([0, 128, 255, 255], (7, 9))
    stream = BytesIO()
    Image.fromarray(pixels[..., 0] if channels == 1 else pixels, mode).save(stream, "PNG")
    return stream.getvalue(), [[tuple(int(b) for b in pixel) for pixel in row] for row in pixels]


@pytest.mark.parametrize("mode", ["trinary", "scale", "raw"])
@pytest.mark.parametrize("channels", ["L", "LA", "RGB", "RGBA"])
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_cells_of_images_are_as_the_servers_publish_them(tmp_path: Path, channels: str, mode: str) -> None:
    content, rows = image(channels, 7)
    (tmp_path / "m.png").write_bytes(content)
    text = f"image: m.png\nresolution: 1\norigin: [0, 0, 0]\nmode: {mode}\noccupied_thresh: 0.66\nfree_thresh: 0.26\n"
    (tmp_path / "m.yaml").write_text(text)
    for server, oracle in ORACLES.items():
        shapes = read_file(tmp_path / "m.yaml", Reading(unknown="free", map_rules=server))
        assert isinstance(shapes, Shapes)
        forbidden = {
            (x, 6 - y)
            for y, row in enumerate(rows)
            for x, pixel in enumerate(row)
            if plain(oracle(pixel, 0.66, 0.26, False, mode)) > 0
        }
        assert sum(polygon.exact_area for polygon in shapes.polygons) == len(forbidden), server
        import shapely

        region = shapely.union_all([polygon.to_shapely() for polygon in shapes.polygons])
        assert all(region.covers(shapely.box(x, y, x + 1, y + 1)) for x, y in forbidden), server
