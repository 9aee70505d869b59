"""Read back the contents of figures from the artists: shapes, lines, texts, and pieces in space."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Polygon as Outline

from cfree.figures import draw
from cfree.figures.style import styled
from cfree.plot.depth_sort import Painting
from cfree.plot.pieces import CURVE, SURFACE, Pieces


@cache
def figure(number: int) -> Figure:
    with styled():
        return draw(number)


def axes(number: int) -> Any:
    return figure(number).axes[0]


def outlines(ax: Axes, colour: str) -> list[np.ndarray]:
    """Corners of the shapes drawn in a colour."""
    return [
        np.asarray(patch.get_xy())[:-1]
        for patch in ax.patches
        if isinstance(patch, Outline) and not patch.get_fill() and to_hex(patch.get_edgecolor()) == to_hex(colour)
    ]


def lines(ax: Axes, colour: str) -> list[np.ndarray]:
    """Points of the lines drawn in a colour; dots are none."""
    drawn = [np.asarray(line.get_xydata()) for line in ax.lines if to_hex(line.get_color()) == to_hex(colour)]
    return [points for points in drawn if len(points) > 1]


def named(ax: Axes) -> dict[str, np.ndarray]:
    """Places of texts."""
    return {text.get_text(): np.array(text.xy) for text in ax.texts if hasattr(text, "xy")}


def pieces(number: int, k: int = 0) -> Pieces:
    """All pieces painted on axes."""
    (painting,) = [c for c in figure(number).axes[k].collections if isinstance(c, Painting)]
    return painting._pieces


def strokes(number: int, colour: str, k: int = 0) -> np.ndarray:
    """Ends of the parts of curves painted in a colour, (n, 2, 3), theta in degrees."""
    painted = pieces(number, k)
    return painted.corners[(painted.sort == CURVE) & (np.abs(painted.rgb - to_rgb(colour)).max(axis=1) < 1e-12)][:, :2]


def faces(number: int, k: int = 0) -> Pieces:
    """Faces of surfaces among all painted pieces."""
    painted = pieces(number, k)
    return painted.chosen(painted.sort == SURFACE)
