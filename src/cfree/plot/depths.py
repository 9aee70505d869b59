"""Arrangements drawn by depth: regions of a slice, and faces in (x, y, theta)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from mpl_toolkits.mplot3d.axes3d import Axes3D
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.arrangements.arranged import Arrangement
from cfree.arrangements.regions import planar_cells
from cfree.exact.half_angle import Angle
from cfree.palette import FREE, INK, SEQUENTIAL
from cfree.plot.boundary import around, legend_below, new_axes, new_figure, new_space, set_space, set_window
from cfree.plot.pieces import FINE, SURFACE, Pieces, faces_of, shaded
from cfree.plot.strips import step_for, strips
from cfree.plot.workspace import path_of, rings_of_geometry
from cfree.scene.scene import robot_radius


@checked
def plot_depths(whole: Arrangement, theta: Angle, ax: Axes | None = None) -> Axes:
    """Draw the number of pairs that overlap at each position, at one orientation.

    Parameters
    ----------
    whole : Arrangement
    theta : float in radians, "30deg" or {"tau": "p/q"}
    ax : matplotlib axes, optional

    Returns
    -------
    matplotlib axes
    """
    from matplotlib.collections import LineCollection
    from matplotlib.patches import Patch, PathPatch

    ax = ax or new_axes((7, 6))
    cut, colours = whole.slice(theta), depth_colours(whole)
    ax.set_facecolor(colours[0])
    cells = planar_cells(whole, theta)
    depths = [int(whole.cell_depth[cell]) for _, cell in cells]
    for (region, _), depth in zip(cells, depths, strict=True):
        ax.add_patch(PathPatch(path_of(rings_of_geometry(region)), facecolor=colours[depth], edgecolor="none"))
    ax.add_collection(LineCollection(list(cut.segments), colors=INK, linewidths=0.6))
    if len(cut.segments):
        low, high = cut.segments.min(axis=(0, 1)).tolist(), cut.segments.max(axis=(0, 1)).tolist()
        set_window(ax, around([(*low, *high)]), whole.scene.units)
    ax.set_title(f"depth at θ = {math.degrees(cut.theta):.4g}°")
    handles = [Patch(facecolor=colours[depth], edgecolor=INK, label=str(depth)) for depth in sorted({0, *depths})]
    legend_below(ax, handles=handles, title="pairs that overlap", ncols=len(handles))
    return ax


@checked
def plot_faces(whole: Arrangement, ax: Axes3D | None = None, *, depth: int | None = None) -> Axes3D:
    """Draw faces in (x, y, theta), coloured by their depth; those of one depth alone if it is given.

    Parameters
    ----------
    whole : Arrangement
    ax : matplotlib axes with ``projection="3d"``, optional
    depth : int, optional
        The faces of depth 0 are the boundary of the free space.

    Returns
    -------
    matplotlib axes with three dimensions
    """
    from matplotlib.patches import Patch

    from cfree.plot.depth_sort import Painting

    if ax is None:
        ax = new_space(new_figure((8, 7)), (0.02, 0.1, 0.9, 0.86))
    space: Any = ax
    pieces, depths = _pieces(whole)
    if depth is not None:
        pieces, depths = pieces.chosen(depths == depth), depths[depths == depth]
    corners = pieces.corners.reshape(-1, 3)
    low, high = (corners.min(axis=0), corners.max(axis=0)) if len(corners) else (np.zeros(3), np.ones(3))
    space.add_collection(Painting(pieces), autolim=False)
    set_space(space, (low[0], low[1], high[0], high[1]), whole.scene.units)
    colours = depth_colours(whole)
    handles = [Patch(color=colours[k], label=f"depth {k}") for k in sorted(set(depths.tolist()))]
    space.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.02), ncols=6, frameon=False)
    return space


def depth_colours(whole: Arrangement) -> NDArray[np.float64]:
    """Return a colour (d, 3) for each depth: the colour of the free space, then darker for deeper."""
    from matplotlib import colormaps
    from matplotlib.colors import to_rgb

    most = int(whole.cell_depth.max())
    colours: NDArray[np.float64] = colormaps[SEQUENTIAL](np.linspace(0.97, 0.1, most + 1))[:, :3]
    colours[0] = to_rgb(FREE)
    return colours


def _pieces(whole: Arrangement) -> tuple[Pieces, NDArray[np.int64]]:
    """Return the pieces to draw, and the depth of each."""
    rows = strips(whole.sheets, step_for(whole.sheets, FINE.rows, FINE.steps))
    points = rows.points.reshape(-1, 2)
    widest = float(np.hypot(*np.ptp(points, axis=0))) / FINE.cells if len(points) else 1.0
    corners, strip, _ = faces_of(rows, widest)
    depths = whole.depth_of_pieces[rows.trapezoid[rows.joined]][strip]
    rgb = shaded(depth_colours(whole)[depths], corners, robot_radius(whole.scene))
    n = len(corners)
    part = rows.part[rows.joined][strip]
    return Pieces(corners, rgb, np.full(n, SURFACE), np.arange(n), np.zeros(n), part), depths
