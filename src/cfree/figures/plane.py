"""Drawing in the plane: shapes, labels, angles, arrows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cfree.palette import GHOST, INK, ROBOT

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Floats = NDArray[np.float64]


def set_plane(ax: Axes, window: tuple[float, float, float, float]) -> None:
    """Make axes show x0, y0, x1, y1, without frame and numbers."""
    x0, y0, x1, y1 = window
    ax.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal")
    ax.set_axis_off()


def shape(ax: Axes, points: ArrayLike, colour: str, inside: str = "", *, alpha: float = 0.35) -> None:
    """Draw a polygon, tinted inside with another colour if one is given."""
    from matplotlib.patches import Polygon as Outline

    corners = np.asarray(points)
    ax.add_patch(Outline(corners, facecolor=inside or colour, alpha=alpha, linewidth=0, zorder=2))
    ax.add_patch(Outline(corners, fill=False, edgecolor=colour, linewidth=1.4, joinstyle="round", zorder=2.1))


def ghost(ax: Axes, points: ArrayLike) -> None:
    """Draw the robot in a pose between others: its outline, dashed."""
    from matplotlib.patches import Polygon as Outline

    look: Any = {"facecolor": GHOST, "edgecolor": ROBOT, "linewidth": 1.1, "linestyle": (0, (4, 3))}
    ax.add_patch(Outline(np.asarray(points), alpha=0.4, zorder=1.8, label="ghost", **look))


def line(ax: Axes, p: ArrayLike, q: ArrayLike, colour: str = INK, *, width: float = 1, dashes: bool = False) -> None:
    """Draw a segment, above shapes."""
    (x0, y0), (x1, y1) = np.asarray(p), np.asarray(q)
    ax.plot([x0, x1], [y0, y1], color=colour, linewidth=width, linestyle=(0, (4, 3)) if dashes else "-", zorder=4)


def arrow(ax: Axes, p: ArrayLike, q: ArrayLike, colour: str = INK, *, width: float = 1.4) -> None:
    """Draw an arrow from p to q."""
    (x0, y0), (x1, y1) = np.asarray(p, float).tolist(), np.asarray(q, float).tolist()
    look = {"arrowstyle": "-|>,head_width=0.22,head_length=0.5", "color": colour, "linewidth": width}
    ax.annotate("", (x1, y1), (x0, y0), arrowprops={**look, "shrinkA": 0, "shrinkB": 0, "joinstyle": "miter"}, zorder=5)


def dot(ax: Axes, p: ArrayLike, colour: str = INK, size: float = 4.5) -> None:
    """Draw a point with a white rim."""
    x, y = np.asarray(p)
    ax.plot(x, y, "o", color=colour, markersize=size, markeredgecolor="white", markeredgewidth=0.8, zorder=7)


def label(ax: Axes, p: ArrayLike, text: str, way: ArrayLike = (0, 0), colour: str = INK, size: float = 13) -> None:
    """Write text at a point, moved by (dx, dy) typographic points, with a white halo."""
    from matplotlib.patheffects import withStroke

    halo = [withStroke(linewidth=2.5, foreground="white", alpha=0.85)]
    x, y = np.asarray(p, float).tolist()
    dx, dy = np.asarray(way, float).tolist()
    ax.annotate(
        text, (x, y), (dx, dy), textcoords="offset points", ha="center", va="center",
        color=colour, fontsize=size, path_effects=halo, zorder=8, annotation_clip=False,
    )  # fmt: skip


def corner_labels(ax: Axes, points: ArrayLike, names: Sequence[str], distance: float = 11) -> None:
    """Write names outside the corners of a convex polygon; an empty name leaves its corner unnamed."""
    corners = np.asarray(points, float)
    for k, name in enumerate(names):
        if name:
            before, after = corners[k - 1] - corners[k], corners[(k + 1) % len(corners)] - corners[k]
            out = -(before / np.hypot(*before) + after / np.hypot(*after))
            label(ax, corners[k], name, distance * out / np.hypot(*out))


def edge_label(ax: Axes, p: ArrayLike, q: ArrayLike, text: str, distance: float = 11, at: float = 0.5) -> None:
    """Write text beside the edge from p to q, on its right, which is outside."""
    p, q = np.asarray(p, float), np.asarray(q, float)
    x, y = (q - p) / np.hypot(*(q - p))
    label(ax, (1 - at) * p + at * q, text, (distance * y, -distance * x))


def frame(ax: Axes, q: ArrayLike, length: float, colour: str) -> None:
    """Draw the robot's local frame in the pose (x, y, theta)."""
    x, y, theta = np.asarray(q, float).tolist()
    for turn in (theta, theta + math.pi / 2):
        arrow(ax, (x, y), (x + length * math.cos(turn), y + length * math.sin(turn)), colour, width=1.6)
    dot(ax, (x, y), colour, 5.5)


def arc(
    ax: Axes, centre: ArrayLike, radius: float, span: tuple[float, float], colour: str = INK, *,
    tip: bool = False, fill: bool = True, width: float = 1.2, dotted: bool = False,
) -> None:  # fmt: skip
    """Draw an arc over a span of angles in radians, with a tinted sector, and an arrow at its end if wanted."""
    from matplotlib.patches import Wedge

    (x, y), (start, stop) = np.asarray(centre, float).tolist(), span
    if fill:
        sector = Wedge((x, y), radius, math.degrees(start), math.degrees(stop))
        sector.set(facecolor=colour, alpha=0.13, linewidth=0, zorder=3)
        ax.add_patch(sector)
    head = min(0.5 * (stop - start), 0.12 / radius) if tip else 0.0
    turn = np.linspace(start, stop - 0.5 * head, 100)
    px, py = x + radius * np.cos(turn), y + radius * np.sin(turn)
    ax.plot(px, py, color=colour, linewidth=width, linestyle=(0, (1, 2)) if dotted else "-", zorder=4)
    if tip:
        arrow(ax, on_arc(centre, radius, stop - head), on_arc(centre, radius, stop), colour, width=width)


def on_arc(centre: ArrayLike, radius: float, angle: float) -> Floats:
    """Return a point of a circle."""
    return np.asarray(centre, float) + radius * np.array([math.cos(angle), math.sin(angle)])


def placed(vertices: ArrayLike, q: ArrayLike) -> Floats:
    """Return points of the robot in the pose (x, y, theta), eq. (3)."""
    x, y, theta = np.asarray(q, float).tolist()
    c, s = math.cos(theta), math.sin(theta)
    moved: Floats = np.asarray(vertices, float) @ np.array([[c, s], [-s, c]]) + (x, y)
    return moved
