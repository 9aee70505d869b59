"""Drawing in configuration space: axes of x, y and theta, sheets of a surface, curves on it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from mpl_toolkits.mplot3d import proj3d
from numpy.typing import ArrayLike, NDArray

from cfree.contact.surface import Surface
from cfree.palette import FAINT, FOCAL_LENGTH, GREY, INK, VIEW, WALL
from cfree.plot.depth_sort import Painting
from cfree.plot.pieces import Detail, Pieces, joined, of_line, of_sheet
from cfree.plot.rendered import Renderer

Floats = NDArray[np.float64]
Box = tuple[float, float, float, float]

DETAIL = Detail(4_000, (math.radians(3), math.radians(15)), 36)
"""Detail of boundaries: fine enough to be smooth, with few enough faces for vectors."""
TURNS = {0: "$0$", 90: r"$\pi/2$", 180: r"$\pi$", 270: r"$3\pi/2$", 360: r"$2\pi$"}
DEGREES = np.array([1.0, 1.0, 180 / math.pi])


def set_space(
    ax: Any, window: Box, *, angle_scale: float, view: tuple[float, float] = VIEW,
    degrees: tuple[float, float] = (0, 360), zoom: float = 1.0,
) -> None:  # fmt: skip
    """Make axes show a rectangle of the plane and a range of theta, one radian as long as `angle_scale`; no frame."""
    x0, y0, x1, y1 = window
    ax.computed_zorder = False
    ax.set(xlim=(x0, x1), ylim=(y0, y1), zlim=degrees)
    ax.set_box_aspect((x1 - x0, y1 - y0, angle_scale * math.radians(degrees[1] - degrees[0])), zoom=zoom)
    ax.set_proj_type("persp", focal_length=FOCAL_LENGTH)
    ax.view_init(*view)
    ax.set_axis_off()
    ax.patch.set_alpha(0)


def draw_frame(ax: Any, step: float = 1) -> None:
    """Draw floor and two back walls with a faint grid; numbers along the near edges, for theta along the left one."""
    from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

    azimuth = math.radians(ax.azim)
    right = np.array([-math.sin(azimuth), math.cos(azimuth)])
    limits = np.array([ax.get_xlim(), ax.get_ylim()])
    z0, z1 = ax.get_zlim()
    # the corner towards the camera, and the one behind it
    near = np.array([limits[0, int(math.cos(azimuth) > 0)], limits[1, int(math.sin(azimuth) > 0)]])
    far = limits.sum(axis=1) - near
    floor = [(near[0], near[1]), (far[0], near[1]), (far[0], far[1]), (near[0], far[1])]
    walls = [[(x, y, z0) for x, y in floor]]
    walls += [[(*p, z0), (*q, z0), (*q, z1), (*p, z1)] for p, q in ((floor[1], floor[2]), (floor[2], floor[3]))]
    style: Any = {"facecolor": WALL, "edgecolor": FAINT, "linewidth": 0.7, "zorder": -2, "clip_on": False}
    ax.add_collection3d(Poly3DCollection(walls, **style))
    # a number at the very end of an edge would touch the first of the next one
    xs, ys = (_multiples(low, high, step) for low, high in limits)
    zs = [z for z in TURNS if z0 < z < z1]
    grid = [
        *([(x, near[1], z0), (x, far[1], z0), (x, far[1], z1)] for x in xs),
        *([(near[0], y, z0), (far[0], y, z0), (far[0], y, z1)] for y in ys),
        *([(near[0], far[1], z), (*far, z), (far[0], near[1], z)] for z in zs),
    ]
    ax.add_collection3d(Line3DCollection(grid, colors=FAINT, linewidths=0.6, zorder=-1, clip_on=False))

    gap = 0.06 * float(np.ptp(limits, axis=1).max())
    out = np.sign(near - far) * gap
    number: Any = {"ha": "center", "va": "center", "fontsize": 11, "color": GREY}
    name: Any = {**number, "fontsize": 15, "color": INK}
    for x in xs:
        ax.text(x, near[1] + out[1], z0, f"{x:g}".replace("-", "\N{MINUS SIGN}"), **number)
    for y in ys:
        ax.text(near[0] + out[0], y, z0, f"{y:g}".replace("-", "\N{MINUS SIGN}"), **number)
    middle = limits.mean(axis=1)
    ax.text(middle[0], near[1] + 3.4 * out[1], z0, "$x$", **name)
    ax.text(near[0] + 3.4 * out[0], middle[1], z0, "$y$", **name)
    left = min((np.array([near[0], far[1]]), np.array([far[0], near[1]])), key=lambda p: float(p @ right))
    for z, turn in TURNS.items():
        if z0 <= z <= z1:
            ax.text(*(left - 1.3 * gap * right), z, turn, **{**number, "fontsize": 12})
    ax.text(*(left - 2.9 * gap * right), (z0 + z1) / 2, r"$\theta$", **name)


def _multiples(low: float, high: float, step: float) -> list[float]:
    margin = 0.07 * (high - low)
    return [step * k for k in range(math.ceil((low + margin) / step), math.floor((high - margin) / step) + 1)]


def paint(ax: Any, parts: Iterable[Pieces], z: float = 1, renderer: Renderer | None = None) -> Painting:
    """Put pieces on axes; those in front hide those behind."""
    painting = Painting(joined(list(parts)), ghost=0, renderer=renderer)
    painting.set(zorder=z, clip_on=False)
    ax.add_collection(painting, autolim=False)
    return painting


def legend(ax: Any, names: Sequence[tuple[str, str]], *, below: float = 0.03, columns: int = 4) -> None:
    """Add a legend of colours below axes; a colour that begins with a dash stands for a line."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles = [
        Line2D([], [], color=colour[1:], linewidth=2.5, label=name)
        if colour.startswith("-")
        else Patch(color=colour, label=name)
        for colour, name in names
    ]
    ax.legend(
        handles=handles, loc="upper center", bbox_to_anchor=(0.5, below), ncols=min(columns, len(handles)),
        handlelength=1.3, columnspacing=1.6, fontsize=11, frameon=False,
    )  # fmt: skip


def note(ax: Any, point: ArrayLike, text: str, colour: str = INK, size: float = 13, **options: Any) -> None:
    """Write text at a point, theta in radians, with a white halo."""
    from matplotlib.patheffects import withStroke

    halo = [withStroke(linewidth=2.5, foreground="white", alpha=0.85)]
    x, y, z = (np.asarray(point) * DEGREES).tolist()
    place: Any = {"ha": "center", "va": "center"} | options
    ax.text(x, y, z, text, color=colour, fontsize=size, zorder=12, path_effects=halo, **place)


def mark(ax: Any, point: ArrayLike, colour: str = INK, size: float = 7) -> None:
    """Draw a dot at a point, theta in radians, that nothing hides."""
    x, y, z = (np.asarray(point) * DEGREES).tolist()
    ax.plot([x], [y], [z], "o", color=colour, markersize=size, markeredgecolor="white", zorder=11, clip_on=False)


def seen(ax: Any, painting: Painting, points: Floats) -> NDArray[np.bool_]:
    """Return True for each of the points (n, 3), theta in radians, that no painted face hides from the camera."""
    ax.M = ax.get_proj()
    painting.do_3d_projection()
    return painting.shows(np.column_stack(proj3d.proj_transform(*(points * DEGREES).T, ax.M)))


def sheet(points: Floats, colour: str | Floats, angle_scale: float) -> Pieces:
    """Make pieces of a grid of points (m, n, 3), theta in radians; see `of_sheet`."""
    return of_sheet(points * DEGREES, colour, angle_scale)


def curve(points: Floats, colour: str, width: float) -> Pieces:
    """Make pieces of a curve of points (k, 3), theta in radians."""
    return of_line(points * DEGREES, colour, width)


def around(points: Floats, margin: float) -> Box:
    """Return the rectangle of the plane around points (..., 3)."""
    flat = points.reshape(-1, 3)[:, :2]
    (x0, y0), (x1, y1) = (flat.min(axis=0) - margin).tolist(), (flat.max(axis=0) + margin).tolist()
    return x0, y0, x1, y1


def grid(S: Surface, t: Floats, phi: Floats) -> Floats:
    """Return points (angles, t, 3) of a surface."""
    points: Floats = S(t[None, :], phi[:, None])
    return points
