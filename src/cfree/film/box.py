"""The box around the configuration space: floor and back walls with a grid, axes with ticks and names.

Seen from azimuths within one quadrant, x runs along the near edge of the floor at y = y0, y along that at x = x1, and
theta up the left edge: the axes never change places.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

if TYPE_CHECKING:
    from cfree.film.eye import Eye
    from cfree.plot.workspace import Window

Floats = NDArray[np.float64]
Point = tuple[float, float, float]

INK, WALL, RIM, GRID = "#1d2129", "#f4f5f8", "#c4c8d1", "#d9dce3"
LENGTH, GAP, FAR = 0.007, 0.028, 0.08  # of a tick, of its number, and of an axis' name; parts of the panel's height


@dataclass(frozen=True)
class _Label:
    """A tick, or the name of an axis if it has no lines: where, which axis, its grid lines, what is written."""

    place: Point
    axis: int
    lines: tuple[tuple[Point, Point], ...]
    text: str


class Box:
    """Artists of the box, on axes in pixels.

    Parameters
    ----------
    ax : matplotlib axes
    window : four floats
        x0, y0, x1, y1.
    height : float
        Of the panel, in pixels.
    names : (str, str)
        Of the axes x and y.
    """

    def __init__(self, ax: Any, window: Window, height: float, names: tuple[str, str]) -> None:
        self._height = height
        x0, y0, x1, y1 = window
        floor = (x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)
        left = (x0, y0, 0), (x0, y1, 0), (x0, y1, 360), (x0, y0, 360)
        back = (x0, y1, 0), (x1, y1, 0), (x1, y1, 360), (x0, y1, 360)
        self._faces = np.array([floor, left, back], dtype=np.float64)
        self._edges = np.array([floor[:2], floor[1:3], (left[0], left[3])], dtype=np.float64)
        self._labels = _labels(window, names)
        self._grid = np.array([line for label in self._labels for line in label.lines])
        self.walls = ax.add_collection(PolyCollection([], facecolors=WALL, edgecolors=RIM, lw=0.8, zorder=1))
        self.grid = ax.add_collection(LineCollection([], colors=GRID, lw=0.7, zorder=1.1))
        self.axes = ax.add_collection(LineCollection([], colors=INK, lw=0.9, zorder=5))
        self.texts = [
            ax.text(0, 0, label.text, fontsize=9 if label.lines else 11, zorder=6, va="center",
                    ha="right" if label.axis == 2 else "center")
            for label in self._labels
        ]  # fmt: skip

    def draw(self, eye: Eye) -> None:
        """Project everything."""
        self.walls.set_verts(list(eye(self._faces)[0]))
        self.grid.set_segments(list(eye(self._grid)[0]))
        at, _ = eye(np.array([label.place for label in self._labels]))
        ends, _ = eye(self._faces[0])
        # away from the box: what x points to is where y comes from
        away = np.array([_outwards(ends[0] - ends[3]), _outwards(ends[1] - ends[0]), (-1.0, 0.0)])
        away = away[[label.axis for label in self._labels]]
        gap = np.array([_gap(label) for label in self._labels]) * self._height
        for text, place in zip(self.texts, at + gap[:, None] * away, strict=True):
            text.set_position((float(place[0]), float(place[1])))
        ticks = np.stack((at, at + LENGTH * self._height * away), axis=1)
        has_tick = np.array([bool(label.lines) for label in self._labels])
        self.axes.set_segments([*eye(self._edges)[0], *ticks[has_tick]])


def _gap(label: _Label) -> float:
    if label.axis == 2:  # written up to its place, not around it
        return GAP / 2
    return GAP if label.lines else FAR


def _outwards(direction: Floats) -> Floats:
    """The same direction, bent downwards, so that labels keep clear of the axis."""
    bent = direction / np.linalg.norm(direction) + (0.0, -0.45)
    return np.asarray(bent / np.linalg.norm(bent))


def _labels(window: Window, names: tuple[str, str]) -> list[_Label]:
    x0, y0, x1, y1 = window
    locator = MaxNLocator(5, integer=max(x1 - x0, y1 - y0) >= 5)
    found = [_Label((0.5 * (x0 + x1), y0, 0.0), 0, (), names[0]), _Label((x1, 0.5 * (y0 + y1), 0.0), 1, (), names[1])]
    found.append(_Label((x0, y0, 315.0), 2, (), "θ"))
    for x in (float(tick) for tick in locator.tick_values(x0, x1) if x0 < tick < x1):
        found.append(_Label((x, y0, 0.0), 0, (((x, y0, 0), (x, y1, 0)), ((x, y1, 0), (x, y1, 360))), _number(x)))
    for y in (float(tick) for tick in locator.tick_values(y0, y1) if y0 < tick < y1):
        found.append(_Label((x1, y, 0.0), 1, (((x1, y, 0), (x0, y, 0)), ((x0, y, 0), (x0, y, 360))), _number(y)))
    for z in range(0, 361, 90):
        lines = ((x0, y0, z), (x0, y1, z)), ((x0, y1, z), (x1, y1, z))
        found.append(_Label((x0, y0, float(z)), 2, lines, f"{z}°"))
    return found


def _number(value: float) -> str:
    return f"{value:g}".replace("-", "−")
