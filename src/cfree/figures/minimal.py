"""Figure 15, Lemma 3: an e-v surface is minimal, a helicoid, if the line of its edge contains the reference point."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from mpl_toolkits.mplot3d.axes3d import Axes3D

from cfree.arguments import checked
from cfree.contact.contact import EdgeVertex
from cfree.contact.surface import contact_surface
from cfree.figures.plane import dot, label, line, set_plane, shape
from cfree.figures.space import around, curve, draw_frame, grid, legend, paint, set_space, sheet
from cfree.geometry.local import local_geometry
from cfree.geometry.rulings import striction_parameter
from cfree.palette import DIVERGING, FRAME, INK, ROBOT
from cfree.polygons.polygon import Polygon

CORNER = Polygon([(0, 0), (1, -1), (1, 1)])
THROUGH = Polygon([("-0.7", 0), ("1.5", 0), ("0.3", "1.1")])
BESIDE = Polygon([("-0.7", "-0.5"), ("1.5", "-0.5"), ("0.3", "0.6")])
"""Two robots: the line of the first edge passes through the reference point, or beside it."""
SCALE = 0.55
MOST = 0.4  # greatest mean curvature shown


@checked
def helicoid(ax: Axes3D) -> Axes3D:
    """Figure 15: the line of the edge contains the reference point: H = 0, a helicoid."""
    _surface(ax, THROUGH)
    legend(ax, [("-" + FRAME, "striction curve: the axis"), (to_hex(colormaps[DIVERGING](0.5)), "$H = 0$")])
    return ax


@checked
def generic(ax: Axes3D) -> Axes3D:
    """Figure 15: the line passes beside the reference point: H has one sign; its striction curve is a helix."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    _surface(ax, BESIDE)
    legend(ax, [("-" + FRAME, "striction curve")])
    colours = ScalarMappable(Normalize(-MOST, MOST), colormaps[DIVERGING])
    bar: Any = ax.figure.colorbar(colours, ax=ax, shrink=0.55, aspect=28, pad=0.03)
    bar.ax.set_title("$H$", fontsize=13, pad=8)
    bar.outline.set_visible(False)
    return ax


@checked
def edge_through(ax: Axes) -> Axes:
    """Figure 15: the robot whose edge lies on a line through the reference point."""
    return _robot(ax, THROUGH)


@checked
def edge_beside(ax: Axes) -> Axes:
    """Figure 15: the robot whose edge lies on a line beside the reference point."""
    return _robot(ax, BESIDE)


def _surface(ax: Axes3D, robot: Polygon) -> Axes3D:
    S = contact_surface(robot, CORNER, EdgeVertex(0, 0))
    t, phi = np.linspace(0, 1, 25), np.linspace(0, math.tau, 181)
    points = grid(S, t, phi)
    x0, y0, x1, y1 = around(points, 0.2)
    side = max(-x0, -y0, x1, y1)
    set_space(ax, (-side, -side, side, side), angle_scale=SCALE)
    draw_frame(ax)
    H = local_geometry(S.ruled, (t[1:] + t[:-1]) / 2, 0).mean_curvature
    rgb = colormaps[DIVERGING](0.5 + H / (2 * MOST))[:, :3]
    lines = [curve(S(s, phi), INK, 1.0) for s in np.linspace(0, 1, 5)]
    lines += [curve(S(t, angle), INK, 0.5) for angle in np.linspace(0, math.tau, 25)]
    striction = curve(S(float(striction_parameter(S) or 0), phi), FRAME, 3.0)
    paint(ax, [sheet(points, np.tile(rgb, (len(phi) - 1, 1, 1)), SCALE), *lines, striction])
    return ax


def _robot(ax: Axes, robot: Polygon) -> Axes:
    a = robot.vertices
    set_plane(ax, (-1.5, -1.1, 2.3, 1.3))
    shape(ax, a, ROBOT)
    p, q = a[0], a[1]
    line(ax, p - 0.35 * (q - p), q + 0.35 * (q - p), dashes=True)
    line(ax, p, q, INK, width=2.2)
    dot(ax, (0, 0), FRAME, 7)
    label(ax, (0, 0), "$R_0$", (14, 10), FRAME)
    label(ax, (p + 3 * q) / 4, "$E_i^A$", (0, -14))
    return ax
