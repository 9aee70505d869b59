"""Shapes of the plane as SVG: small, without scripts, ids or anything from outside; no text in it becomes markup."""

from __future__ import annotations

import unicodedata
from base64 import b64encode
from collections.abc import Iterable
from html import escape
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from cfree.palette import INK
from cfree.plot.labels import ALL_AROUND, GAPS, LABEL, LEADER, Room

Floats = NDArray[np.float64]
Window = tuple[float, float, float, float]

UNIT = 10  # coordinates in the file are whole tenths of a pixel
MANY = 20_000  # points of one drawing; more are rounded to whole pixels
MOST = 60_000  # points of one drawing; of more only some are drawn
SIZE = 12.5  # pixels of letters
FAR = 20_000  # pixels from the middle; farther points are moved there
FONT = "system-ui,-apple-system,'Segoe UI',Roboto,Arial,sans-serif"


class Panel:
    """A part of a drawing that shows a window of the plane, y upwards.

    Parameters
    ----------
    window : four floats
        x0, y0, x1, y1: the rectangle that is visible in full.
    width, height : float
        Size in pixels.
    left, top : float, optional
        Place of its corner in the drawing.
    """

    def __init__(self, window: Window, width: float, height: float, left: float = 0.0, top: float = 0.0) -> None:
        x0, y0, x1, y1 = window
        self.window = window
        self.scale = min(width / (x1 - x0), height / (y1 - y0))
        self.middle = np.array([x0 + (x1 - x0) / 2, y0 + (y1 - y0) / 2])
        self.size, self.corner = np.array([width, height]), np.array([left, top])
        self.parts: list[str] = []
        self.room = Room((left, top, left + width, top + height), 1.0)

    def pixels(self, points: Floats) -> Floats:
        """Return the pixels of points (n, 2)."""
        placed = (points - self.middle) * self.scale * (1.0, -1.0)
        shown: Floats = np.clip(placed, -FAR, FAR) + self.size / 2 + self.corner
        return shown

    def shapes(self, rings: Iterable[Floats], style: str, frame: bool = False) -> None:
        """Draw rings as one shape, winding numbers other than 0 inside; with `frame`, even-odd within the panel."""
        whole = list(rings)
        count = sum(map(len, whole))
        step = max(1, count // MOST)
        grain = UNIT if count > MANY else 1
        thin = [ring[::step] if len(ring) > 3 * step else ring[:3] for ring in whole]
        placed = np.rint(self.pixels(np.concatenate([*thin, np.empty((0, 2))])) * UNIT / grain).astype(np.int64) * grain
        ends = np.cumsum([0, *map(len, thin)]).tolist()
        points = placed.tolist()
        texts = dict.fromkeys(f"M{_run(points[i:j])}z" for i, j in pairwise(ends))
        if frame:
            (x, y), (w, h) = (self.corner * UNIT).astype(int), (self.size * UNIT).astype(int)
            self.parts.append(f'<path d="M{x} {y}h{w}v{h}h{-w}z{"".join(texts)}" fill-rule="evenodd" {style}/>')
        elif texts:
            self.parts.append(f'<path d="{"".join(texts)}" {style}/>')

    def line(self, points: Floats, style: str) -> None:
        """Draw a line through points (n, 2)."""
        placed = np.rint(self.pixels(points) * UNIT).astype(np.int64)
        if len(placed):
            self.parts.append(f'<path d="M{_run(placed.tolist())}" fill="none" {style}/>')

    def segments(self, ends: Floats, style: str) -> None:
        """Draw segments (n, 2, 2), without the shortest if they are many."""
        placed = np.rint(self.pixels(ends.reshape(-1, 2)) * UNIT).astype(np.int64).reshape(-1, 4)
        length = np.abs(placed[:, :2] - placed[:, 2:]).max(axis=1, initial=0)
        if len(placed) > MANY // 10:
            placed = placed[length > 2 * UNIT]
        texts = dict.fromkeys(f"M{a} {b}l{c - a} {d - b}" for a, b, c, d in placed.tolist())
        if texts:
            self.parts.append(f'<path d="{"".join(texts)}" fill="none" {style}/>')

    def dot(self, point: Floats, radius: float, style: str) -> None:
        """Draw a disc of a radius in pixels."""
        ((x, y),) = np.rint(self.pixels(point.reshape(1, 2)) * UNIT).astype(int).tolist()
        self.parts.append(f'<circle cx="{x}" cy="{y}" r="{round(radius * UNIT)}" {style}/>')

    def image(self, png: bytes) -> None:
        """Draw an image that fills the panel."""
        (x, y), (w, h) = (self.corner * UNIT).astype(int), (self.size * UNIT).astype(int)
        data = b64encode(png).decode()
        self.parts.append(f'<image x="{x}" y="{y}" width="{w}" height="{h}" href="data:image/png;base64,{data}"/>')

    def avoid(self, rings: Iterable[Floats], cost: float) -> None:
        """Keep words clear of shapes of the plane, if there is room elsewhere."""
        self.room.keep([shapely.Polygon(self.pixels(ring)) for ring in rings], cost)

    def label(self, words: str, points: Floats, style: str) -> None:
        """Write words beside one of some points, clear of other words."""
        half = np.array([0.29 * SIZE * len(words), 0.6 * SIZE])
        place = self.room.best(self.pixels(points), half, ALL_AROUND, GAPS)
        (x, y), (u, v) = place.centre.tolist(), place.anchor.tolist()
        self.room.keep([place.box], LABEL)
        if shapely.distance(place.box, shapely.Point(u, v)) > LEADER:
            ends = f'd="M{u * UNIT:.0f} {v * UNIT:.0f}L{x * UNIT:.0f} {y * UNIT:.0f}"'
            for colour, width in (("#fff", 36), (INK, 13)):
                self.parts.append(f'<path {ends} stroke="{colour}" stroke-width="{width}"/>')
        halo = 'paint-order="stroke" stroke="#fff" stroke-width="40"'
        self.parts.append(text(words, x, y + 0.35 * SIZE, f'text-anchor="middle" {halo} {style}'))


def drawing(panels: Iterable[Panel], width: float, height: float, caption: str) -> str:
    """Join panels, and a caption below them, into one SVG."""
    line = text(caption, 10, height + 17, f'fill="{INK}"')
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height + 26:.0f}" '
        f'viewBox="0 0 {width * UNIT:.0f} {(height + 26) * UNIT:.0f}" role="img" aria-label="{plain(caption, 400)}" '
        'stroke-linejoin="round" stroke-linecap="round">',
        '<rect width="100%" height="100%" rx="60" fill="#fff"/>',
    ]
    for panel in panels:
        (x, y), (w, h) = (panel.corner * UNIT).astype(int), (panel.size * UNIT).astype(int)
        parts += [f'<svg x="{x}" y="{y}" width="{w}" height="{h}" viewBox="{x} {y} {w} {h}">', *panel.parts, "</svg>"]
    return "".join([*parts, line, "</svg>"])


def text(words: str, x: float, y: float, style: str) -> str:
    """Write words at a place in pixels."""
    return (
        f'<text x="{x * UNIT:.0f}" y="{y * UNIT:.0f}" font-family="{FONT}" font-size="{SIZE * UNIT:.0f}" {style}>'
        f"{plain(words, 100)}</text>"
    )


def plain(words: str, most: int) -> str:
    """Escape words for markup, without characters that XML forbids or that change the direction of text.

    Examples
    --------
    >>> plain("<b>\\u202e\\x00 & co", 80), plain("long", 3)
    ('&lt;b&gt; &amp; co', 'lo…')
    """
    allowed = "".join(c for c in words if unicodedata.category(c) not in ("Cc", "Cf", "Cs", "Co", "Cn"))
    return escape(allowed if len(allowed) <= most else f"{allowed[: most - 1]}…")


def _run(points: list[list[int]]) -> str:
    """Write steps from point to point; a repeated point is left out."""
    (x, y), *rest = points
    parts = [f"{x} {y}"]
    for u, v in rest:
        if (u, v) != (x, y):
            parts.append(f"l{u - x} {v - y}")
            x, y = u, v
    return "".join(parts)
