"""Read the image of a map: the colours in it, and which of them each pixel has."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.formats.drawings.map_rules import Colours

MOST_CELLS = 1 << 26
FORMATS = ["PPM", "PNG", "BMP"]
Pixels = NDArray[Any]


@dataclass(frozen=True)
class MapImage:
    """An image of a map: its colours, the index of each pixel's by rows from the top, and the pixels of each."""

    colours: Colours
    pixels: Pixels
    counts: NDArray[np.int64]
    has_palette: bool


def read_image(raw: bytes) -> MapImage:
    """Read a PGM, PNG or BMP image.

    Raises
    ------
    ValueError
        If there are too many pixels. Pillow's readers raise errors of many other types.
    """
    from PIL import Image

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with Image.open(BytesIO(raw), formats=FORMATS) as image:
            width, height = image.size
            if width * height > MOST_CELLS:
                raise ValueError(f"{width} x {height} cells; give at most {MOST_CELLS:,}")
            plain = _plain(image)
            colours, pixels = _colours(plain)
            if plain.mode == "L":
                counts = np.array(plain.histogram())
            else:
                counts = np.bincount(pixels.ravel(), minlength=len(colours.rgb))
            return MapImage(colours, pixels, counts, image.mode == "P")


def _plain(image: Any) -> Any:
    """Return the image in one of the modes L, LA, RGB, RGBA or I."""
    is_transparent = "transparency" in image.info
    if image.mode in ("1", "L"):
        return image.convert("LA" if is_transparent else "L")
    if image.mode in ("LA", "RGBA") or (image.mode == "RGB" and not is_transparent):
        return image
    if image.mode.startswith("I"):
        return image
    if image.mode in ("P", "PA", "RGB"):
        return image.convert("RGBA" if is_transparent or image.mode == "PA" else "RGB")
    raise ValueError(f"pixels of mode {image.mode}")


def _colours(image: Any) -> tuple[Colours, Pixels]:
    pixels = np.asarray(image)
    if image.mode == "L":
        return Colours(_greys(np.arange(256))), pixels
    if pixels.ndim == 2:
        return Colours(_greys(np.arange(65536)) // 257), np.clip(pixels, 0, 65535).astype(np.uint16)
    if image.mode == "LA":
        return _with_alpha(pixels[..., 0], pixels[..., 1], is_grey=True)
    red, green, blue = (pixels[..., k] for k in range(3))
    if (red == green).all() and (red == blue).all():
        if image.mode == "RGB":
            return Colours(_greys(np.arange(256)), is_grey=False), red
        return _with_alpha(red, pixels[..., 3], is_grey=False)
    packed = red.astype(np.uint32) << 16 | green.astype(np.uint32) << 8 | blue
    alpha = pixels[..., 3] if image.mode == "RGBA" else None
    if alpha is not None and not (alpha == 255).all():
        keys, index = np.unique(packed | alpha.astype(np.uint32) << 24, return_inverse=True)
        return Colours(_channels(keys), (keys >> 24).astype(np.int64) * 257, is_grey=False), index.reshape(red.shape)
    present = np.zeros(1 << 24, dtype=bool)
    present[packed] = True
    keys = np.flatnonzero(present)
    number = np.zeros(1 << 24, dtype=np.uint32)
    number[keys] = np.arange(len(keys))
    opaque = None if alpha is None else np.full(len(keys), 65535)
    return Colours(_channels(keys), opaque, is_grey=False), number[packed]


def _channels(keys: NDArray[Any]) -> NDArray[np.int64]:
    return np.stack([keys >> shift & 255 for shift in (16, 8, 0)], axis=1).astype(np.int64) * 257


def _with_alpha(grey: Pixels, alpha: Pixels, is_grey: bool) -> tuple[Colours, Pixels]:
    every = np.arange(65536)
    return Colours(_greys(every >> 8), (every & 255) * 257, is_grey), grey.astype(np.uint16) << 8 | alpha


def _greys(values: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.repeat(values[:, None] * 257, 3, axis=1)
