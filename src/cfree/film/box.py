"""The box around the configuration space: floor and back walls with a grid, axes with ticks and names.

The axes keep their places for all azimuths within one quadrant: x and y run along the near edges of the floor,
theta up the left edge. In the usual quadrant these are y = y0, x = x1, and the edge over x0, y0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from cfree.palette import FAINT, INK, RIM, WALL

if TYPE_CHECKING:
    from cfree.film.camera import Camera
    from cfree.plot.workspace import Window

Floats = NDArray[np.float64]
Point = tuple[float, float, float]

CORNER = 0.88  # share of an axis that has numbers: they would touch where two axes meet
LENGTH, GAP, FAR = 4.0, 12.0, 30.0  # tick length, distances of its number and of an axis' name, in points


@dataclass(frozen=True)
class _Label:
    """A tick, or the name of an axis if it has no lines: place, axis, grid lines and text."""

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
    names : (str, str)
        Names of the axes x and y.
    quadrant : int
        The camera's quadrant: 0 for azimuths of -90 to 0 degrees, 1 for 0 to 90, and so on.
    """

    def __init__(self, ax: Any, window: Window, names: tuple[str, str], quadrant: int = 0) -> None:
        self._point = ax.figure.dpi / 72
        x0, y0, x1, y1 = window
        ring = (x0, y0), (x1, y0), (x1, y1), (x0, y1)
        a, b, c, d = ring[quadrant:] + ring[:quadrant]  # left, near, right, far
        floor = (*a, 0), (*b, 0), (*c, 0), (*d, 0)
        left = (*a, 0), (*d, 0), (*d, 360), (*a, 360)
        back = (*d, 0), (*c, 0), (*c, 360), (*d, 360)
        self._faces = np.array([floor, left, back], dtype=np.float64)
        self._edges = np.array([floor[:2], floor[1:3], (left[0], left[3])], dtype=np.float64)
        self._labels = _labels(window, names, quadrant)
        self._grid = np.array([line for label in self._labels for line in label.lines])
        self.walls = ax.add_collection(PolyCollection([], facecolors=WALL, edgecolors=RIM, lw=0.8, zorder=1))
        self.grid = ax.add_collection(LineCollection([], colors=FAINT, lw=0.7, zorder=1.1))
        self.axes = ax.add_collection(LineCollection([], colors=INK, lw=0.9, zorder=5))
        self.texts = [
            ax.text(0, 0, label.text, fontsize=9 if label.lines else 11, zorder=6, va="center",
                    ha="right" if label.axis == 2 else "center")
            for label in self._labels
        ]  # fmt: skip

    def show(self, visible: bool) -> None:
        """Show the box, or hide it."""
        for artist in (self.walls, self.grid, self.axes, *self.texts):
            artist.set_visible(visible)

    def draw(self, camera: Camera) -> None:
        """Project everything by a camera."""
        self.walls.set_verts(list(camera(self._faces)[0]))
        self.grid.set_segments(list(camera(self._grid)[0]))
        places, _ = camera(np.array([label.place for label in self._labels]))
        ends, _ = camera(self._faces[0])
        # directions away from the box, on the near edges
        away = np.array([_outwards(ends[0] - ends[3]), _outwards(ends[1] - ends[0]), (-1.0, 0.0)])
        away = away[[label.axis for label in self._labels]]
        gap = np.array([_gap(label) for label in self._labels]) * self._point
        for text, place in zip(self.texts, places + gap[:, None] * away, strict=True):
            text.set_position((float(place[0]), float(place[1])))
        taken: list[Any] = []
        for text in self.texts:  # names first; numbers that would touch earlier texts are left out
            text.set_visible(True)
            box = text.get_window_extent()
            text.set_visible(not any(box.overlaps(other) for other in taken))
            if text.get_visible():
                taken.append(box)
        ticks = np.stack((places, places + LENGTH * self._point * away), axis=1)
        has_tick = np.array([bool(label.lines) for label in self._labels])
        self.axes.set_segments([*camera(self._edges)[0], *ticks[has_tick]])


def _gap(label: _Label) -> float:
    if label.axis == 2:  # written up to its place, not around it
        return GAP / 2
    return GAP if label.lines else FAR


def _outwards(direction: Floats) -> Floats:
    """Bend a direction downwards, so that labels keep clear of the axis."""
    bent = direction / np.linalg.norm(direction) + (0.0, -0.45)
    return np.asarray(bent / np.linalg.norm(bent))


def _labels(window: Window, names: tuple[str, str], quadrant: int) -> list[_Label]:
    x0, y0, x1, y1 = window
    side = max(x1 - x0, y1 - y0)
    near_x, far_x = (x1, x0) if quadrant in (0, 1) else (x0, x1)
    near_y, far_y = (y0, y1) if quadrant in (0, 3) else (y1, y0)
    left = ((x0, y0), (x1, y0), (x1, y1), (x0, y1))[quadrant]
    xs, ys = (
        np.asarray(MaxNLocator(max(2, round(5 * (high - low) / side)), integer=side >= 5).tick_values(low, high))
        for low, high in ((x0, x1), (y0, y1))
    )
    first = quadrant % 2  # the axis, x or y, that runs from the left corner to the near one
    labels = [
        _Label((0.5 * (x0 + x1), near_y, 0.0), first, (), names[0]),
        _Label((near_x, 0.5 * (y0 + y1), 0.0), 1 - first, (), names[1]),
        _Label((*left, 315.0), 2, (), "θ"),
    ]
    for x in xs[np.abs(2 * xs - x0 - x1) < CORNER * (x1 - x0)].tolist():
        lines = ((x, near_y, 0), (x, far_y, 0)), ((x, far_y, 0), (x, far_y, 360))
        labels.append(_Label((x, near_y, 0.0), first, lines, _number(x)))
    for y in ys[np.abs(2 * ys - y0 - y1) < CORNER * (y1 - y0)].tolist():
        lines = ((near_x, y, 0), (far_x, y, 0)), ((far_x, y, 0), (far_x, y, 360))
        labels.append(_Label((near_x, y, 0.0), 1 - first, lines, _number(y)))
    for z in range(0, 361, 90):
        lines = ((far_x, y0, z), (far_x, y1, z)), ((x0, far_y, z), (x1, far_y, z))
        labels.append(_Label((*left, float(z)), 2, lines, f"{z}°"))
    return labels


def _number(value: float) -> str:
    return f"{value:g}".replace("-", "−")
