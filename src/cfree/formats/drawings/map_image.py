"""Read the image of a map: the colours in it, and which of them each pixel has."""

from __future__ import annotations

import warnings
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.formats.drawings.map_rules import Colours

MOST_CELLS = 1 << 26
FORMATS = ["PPM", "PNG", "BMP"]
Pixels = NDArray[Any]


def read_image(raw: bytes) -> tuple[Colours, Pixels, bool]:
    """Return colours, the index of each pixel's colour by rows from the top, and whether the image has a palette.

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
            has_palette = image.mode == "P"
            return *_colours(_plain(image)), has_palette


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
    packed = np.zeros(red.shape, dtype=np.uint32)
    for channel in range(pixels.shape[2]):
        packed = packed << 8 | pixels[..., channel]
    keys, index = np.unique(packed, return_inverse=True)
    table = np.stack([keys >> 8 * k & 255 for k in reversed(range(pixels.shape[2]))], axis=1).astype(np.int64) * 257
    alpha = table[:, 3] if pixels.shape[2] == 4 else None
    return Colours(table[:, :3], alpha, is_grey=False), index.reshape(red.shape)


def _with_alpha(grey: Pixels, alpha: Pixels, is_grey: bool) -> tuple[Colours, Pixels]:
    every = np.arange(65536)
    return Colours(_greys(every >> 8), (every & 255) * 257, is_grey), grey.astype(np.uint16) << 8 | alpha


def _greys(values: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.repeat(values[:, None] * 257, 3, axis=1)
