"""A path among the patches of the boundary, in (x, y, theta), theta unrolled so that the path is one curve."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cfree.mesh import robot_radius
from cfree.outlines import Window
from cfree.plot import new_figure, new_space, with_unit
from cfree.plot3d import (
    CURVE,
    ON_TOP,
    OVER,
    SECTION,
    WALL,
    Colours,
    Painting,
    Pieces,
    joined,
    level,
    of_line,
    pieces_of,
)
from cfree.plot_path import Track

if TYPE_CHECKING:
    from mpl_toolkits.mplot3d.axes3d import Axes3D

    from cfree.forbidden import Boundary
    from cfree.path import Path

Floats = NDArray[np.float64]
Range = tuple[float, float]

PALE = Colours("#f3c7a1", "#a9cdea", "#6b7fa8", "#c9b458")
INK, FLOOR = "#20242b", "#dcdfe5"
MARGIN, LEAST = 15.0, 90.0  # degrees above and below a path, and shown at least
NEAR = 2.0  # robot's radii: patches farther from the path are left out
DASH = 8  # steps of the path


def plot_path_space(path: Path, boundary: Boundary, ax: Axes3D | None = None) -> Axes3D:
    """A path in the configuration space, coloured by clearance, among the patches of the boundary.

    Parameters
    ----------
    path : Path
    boundary : Boundary
        Of the scene in which it is free.
    ax : matplotlib axes with ``projection="3d"``, optional

    Returns
    -------
    matplotlib axes with three dimensions
        Theta is unrolled: it begins at the start's and goes on beyond full turns. What is above and below the path by more than
        some degrees is cut off, and of very many patches only those near the path are drawn. Where patches hide the
        path it is dotted.

    Raises
    ------
    ValueError
        If the path is not free, or the axes have two dimensions.
    """
    if ax is None:
        ax = new_space(new_figure((8, 7)), (0.02, 0.04, 0.94, 0.94))
    if ax.name != "3d":
        raise ValueError(f'axes of {ax.name} projection; make them with projection="3d"')
    draw_track_space(ax, Track.of(path, boundary.scene), boundary)
    return ax


def draw_track_space(ax: Any, track: Track, boundary: Boundary) -> None:
    """The path among the patches, on axes."""
    rows = track.rows * (1, 1, 180 / math.pi)
    low, high = range_of(rows[:, 2])
    near = rows[:: max(1, len(rows) // 80)]
    window = track.window
    draw_patches(ax, boundary, window, (low, high), near, [_line(track, rows)])
    ax.plot(rows[:, 0], rows[:, 1], np.full(len(rows), low), color="#8a92a0", linewidth=1.2, zorder=0.5)
    for row, name in ((rows[0], "start"), (rows[-1], "goal")):
        mark(ax, row, name)


def mark(ax: Any, row: Floats, name: str) -> None:
    """A configuration x, y, theta in degrees, and its name."""
    from matplotlib.patheffects import withStroke

    x, y, theta = row.tolist()
    ax.plot([x], [y], [theta], "o", color=INK, markersize=6, markeredgecolor="white", zorder=21)
    halo = [withStroke(linewidth=2.5, foreground="white")]
    ax.text(x, y, theta, f"  {name}", zorder=22, path_effects=halo)


def draw_patches(
    ax: Any, boundary: Boundary, window: Window, degrees: Range, near: Floats | None, parts: list[Pieces]
) -> None:
    """The patches between two angles, and other pieces among them; axes with ticks and names."""
    import shapely
    from matplotlib.ticker import MaxNLocator, MultipleLocator
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    low, high = degrees
    x0, y0, x1, y1 = window
    side = max(x1 - x0, y1 - y0)
    every = _unrolled(pieces_of(boundary, window, PALE), degrees)
    every = _inside(every, window)
    if near is not None:
        every = _chosen(
            every, _distance(every, near, robot_radius(boundary.scene)) < NEAR * robot_radius(boundary.scene)
        )
    ax.computed_zorder = False
    ax.add_collection(Painting(joined([every, *parts])), autolim=False)
    ax.collections[-1].set(zorder=1, rasterized=True)
    obstacles = shapely.union_all([obstacle.to_shapely() for obstacle in boundary.scene.obstacles])
    floor = level(shapely.intersection(obstacles, shapely.box(*window)), low)[:, :3]
    ax.add_collection(
        Poly3DCollection(floor, facecolor=FLOOR, edgecolor=FLOOR, linewidth=0.3, zorder=0.2), autolim=False
    )
    ax.set(xlim=(x0, x1), ylim=(y0, y1), zlim=(low, high))
    height = side * min(1.0, max(0.4, 0.75 * (high - low) / 360))
    ax.set_box_aspect((x1 - x0, y1 - y0, height), zoom=0.95)
    ax.view_init(38, -60)
    step = next(step for step in (15, 30, 45, 90, 180, 360, 1e9) if (high - low) / step <= 6)
    ax.zaxis.set_major_locator(MultipleLocator(step))
    ax.zaxis.set_major_formatter(lambda value, _: f"{value:g}°")
    for axis, name, length in ((ax.xaxis, "x", x1 - x0), (ax.yaxis, "y", y1 - y0)):
        axis.set_major_locator(MaxNLocator(1 + round(5 * length / side)))
        axis.set_label_text(with_unit(name, boundary.scene.units))
    ax.set_zlabel("θ")
    for axis in (ax.xaxis, ax.yaxis, ax.zaxis):
        axis.set_pane_color((0.97, 0.97, 0.98, 1.0))


def range_of(degrees: Floats) -> Range:
    """Angles around those of a path."""
    low, high = float(degrees.min()) - MARGIN, float(degrees.max()) + MARGIN
    more = max(0.0, LEAST - (high - low)) / 2
    return low - more, high + more


def _line(track: Track, rows: Floats) -> Pieces:
    """The path, coloured by clearance, with a white rim; dashed where it is hidden."""
    rgb = track.colour((track.distance[1:] + track.distance[:-1]) / 2)[:, :3]
    rim = of_line(rows, "white", 5.0)
    line = replace(of_line(rows, INK, 3.0, OVER), rgb=rgb)
    above = replace(of_line(rows, INK, 1.8, ON_TOP), rgb=rgb)
    return joined([rim, line, _chosen(above, np.arange(len(rgb)) % DASH < DASH / 2)])


def _unrolled(pieces: Pieces, degrees: Range) -> Pieces:
    """Copies a turn apart, cut off at two angles, without the section at a full turn."""
    low, high = degrees
    pieces = _chosen(pieces, pieces.sort != SECTION)
    found, count = [], 0
    for turn in range(math.floor(low / 360), math.ceil(high / 360)):
        corners = pieces.corners + (0, 0, 360 * turn)
        z = corners[..., 2]
        copy = _chosen(replace(pieces, corners=corners), (z.max(axis=1) > low) & (z.min(axis=1) < high))
        found.append(replace(copy, corners=_cut(copy, degrees), owner=np.where(copy.owner < 0, -1, copy.owner + count)))
        count += len(copy.corners)
    return joined(found)


def _cut(pieces: Pieces, degrees: Range) -> Floats:
    """Corners moved along the sides that rise, to between two angles."""
    corners = pieces.corners
    is_curve = (pieces.sort >= CURVE)[:, None]
    other = np.where(is_curve[..., None], corners[:, [1, 0, 3, 2]], corners[:, [3, 2, 1, 0]])
    z, beyond = corners[..., 2], other[..., 2]
    rise = np.where(beyond == z, 1.0, beyond - z)
    share = (np.clip(z, *degrees) - z) / rise
    return np.asarray(corners + share[..., None] * (other - corners))


def _chosen(pieces: Pieces, mask: NDArray[np.bool_]) -> Pieces:
    """Some of the pieces, without the curves on faces that are not among them."""
    kept = mask & (mask[pieces.owner] | (pieces.owner < 0))
    number = np.cumsum(kept) - 1
    owner = np.where(pieces.owner < 0, -1, number[pieces.owner])[kept]
    return Pieces(pieces.corners[kept], pieces.rgb[kept], pieces.sort[kept], owner, pieces.width[kept])


def _inside(pieces: Pieces, window: Window) -> Pieces:
    """Without the walls of the bounds, which would be in front of everything, and what is outside the window."""
    x, y = pieces.corners[..., 0].mean(axis=1), pieces.corners[..., 1].mean(axis=1)
    inside = (x >= window[0]) & (x <= window[2]) & (y >= window[1]) & (y <= window[3])
    return _chosen(pieces, inside & (pieces.sort != WALL))


def _distance(pieces: Pieces, rows: Floats, radius: float) -> Floats:
    """How far the middles of pieces are from poses, a radian as long as the radius."""
    scale = np.array([1, 1, math.radians(radius)])
    middle = pieces.corners.mean(axis=1) * scale
    found = np.full(len(middle), math.inf)
    for row in rows * scale:
        np.minimum(found, ((middle - row) ** 2).sum(axis=1), out=found)
    return np.sqrt(found)
