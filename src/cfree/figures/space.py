"""Drawing in configuration space: axes of x, y and theta, sheets of a surface, curves on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from cfree import palette
from cfree.plot.depth_sort import Painting
from cfree.plot.pieces import SURFACE, Pieces, joined, of_line, shaded

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Floats = NDArray[np.float64]
Box = tuple[float, float, float, float]

TURNS = {0: "0", 90: r"$\frac{\pi}{2}$", 180: r"$\pi$", 270: r"$\frac{3\pi}{2}$", 360: r"$2\pi$"}


def new_space(
    figure: Figure, place: Box, window: Box, *, angle_scale: float, view: tuple[float, float],
    degrees: tuple[float, float] = (0, 360), zoom: float = 1.0,
) -> Any:  # fmt: skip
    """Axes of a rectangle of the plane and a range of theta, a radian as long as `angle_scale`, with no frame yet."""
    import mpl_toolkits.mplot3d  # noqa: F401  registers the projection

    x0, y0, x1, y1 = window
    ax: Any = figure.add_axes(place, projection="3d", computed_zorder=False)
    ax.set(xlim=(x0, x1), ylim=(y0, y1), zlim=degrees)
    ax.set_box_aspect((x1 - x0, y1 - y0, angle_scale * math.radians(degrees[1] - degrees[0])), zoom=zoom)
    ax.set_proj_type("persp", focal_length=palette.FOCAL_LENGTH)
    ax.view_init(*view)
    ax.set_axis_off()
    return ax


def draw_frame(ax: Any, ticks: Sequence[float]) -> None:
    """Floor and two back walls with a faint grid, and numbers along three edges; for views from -90 to 0 degrees."""
    from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

    (x0, x1), (y0, y1), (z0, z1) = ax.get_xlim(), ax.get_ylim(), ax.get_zlim()
    walls = [
        [(x0, y0, z0), (x1, y0, z0), (x1, y1, z0), (x0, y1, z0)],
        [(x0, y0, z0), (x0, y1, z0), (x0, y1, z1), (x0, y0, z1)],
        [(x0, y1, z0), (x1, y1, z0), (x1, y1, z1), (x0, y1, z1)],
    ]
    ax.add_collection3d(
        Poly3DCollection(
            walls, facecolor=palette.WALL, edgecolor=palette.FAINT, linewidth=0.7, zorder=-2, clip_on=False
        )
    )
    xs, ys = ([t for t in ticks if low < t < high] for low, high in ((x0, x1), (y0, y1)))
    zs = [z for z in TURNS if z0 < z < z1]
    grid = [
        *([(x, y0, z0), (x, y1, z0), (x, y1, z1)] for x in xs),
        *([(x1, y, z0), (x0, y, z0), (x0, y, z1)] for y in ys),
        *([(x0, y0, z), (x0, y1, z), (x1, y1, z)] for z in zs),
    ]
    ax.add_collection3d(Line3DCollection(grid, colors=palette.FAINT, linewidths=0.6, zorder=-1, clip_on=False))
    dx, dy = 0.05 * (x1 - x0), 0.05 * (y1 - y0)
    center: Any = {"ha": "center", "va": "center", "fontsize": 11, "color": palette.GREY}
    for x in xs:
        ax.text(x, y0 - dy, z0, f"{x:g}", **center)
    for y in ys:
        ax.text(x1 + dx, y, z0, f"{y:g}", **center)
    for z, name in TURNS.items():
        if z0 <= z <= z1:
            ax.text(x0 - dx, y0 - dy, z, name, **{**center, "fontsize": 13})
    named = {**center, "fontsize": 15, "color": "black"}
    ax.text((x0 + x1) / 2, y0 - 3.6 * dy, z0, "$x$", **named)
    ax.text(x1 + 3.6 * dx, (y0 + y1) / 2, z0, "$y$", **named)
    ax.text(x0 - 2.2 * dx, y0 - 2.2 * dy, (z0 + z1) / 2, r"$\theta$", **named)


def paint(ax: Any, parts: list[Pieces], z: float = 1) -> None:
    """Pieces from back to front; as pixels in vector formats, where thousands of faces are slow and have seams."""
    painting = Painting(joined(parts), ghost=0)
    painting.set(rasterized=True, zorder=z, clip_on=False)
    ax.add_collection(painting, autolim=False)


def legend(figure: Figure, names: Sequence[tuple[str, str]], height: float = 0.035) -> None:
    """A row of colours and what they mean, below; lines are named by a colour that begins with a dash."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles = [
        Line2D([], [], color=colour[1:], linewidth=2.5, label=name)
        if colour.startswith("-")
        else Patch(color=colour, label=name)
        for colour, name in names
    ]
    figure.legend(
        handles=handles, loc="center", bbox_to_anchor=(0.5, height), ncols=len(handles), handlelength=1.3,
        columnspacing=1.6, fontsize=12,
    )  # fmt: skip


def sheet(points: Floats, colour: str | Floats, angle_scale: float) -> Pieces:
    """Both sides of a grid of points (m, n, 3), theta in radians, in one colour or one for each face (m - 1, n - 1, 3).

    Each side is a face of its own, lit from its own side, so that the one turned away need not be drawn.
    """
    p = points * (1, 1, 180 / math.pi)
    corners = np.stack((p[:-1, :-1], p[:-1, 1:], p[1:, 1:], p[1:, :-1]), axis=2).reshape(-1, 4, 3)
    n = len(corners)
    rgb = np.tile(to_rgb(colour), (n, 1)) if isinstance(colour, str) else colour.reshape(-1, 3)
    both = np.concatenate((corners, corners[:, ::-1]))
    lit = shaded(np.concatenate((rgb, rgb)), both, angle_scale)
    return Pieces(both, lit, np.full(2 * n, SURFACE), np.arange(2 * n), np.zeros(2 * n), np.full(2 * n, -1))


def curve(points: Floats, colour: str, width: float) -> Pieces:
    """A curve of points (k, 3), theta in radians."""
    return of_line(points * (1, 1, 180 / math.pi), colour, width)
