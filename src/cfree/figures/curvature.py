"""Figures 10 and 11: asymptotic and principal directions of an e-v surface, and its curvature as a colour.

The formulas of section 4, in the metric dx^2 + dy^2 + dtheta^2: a radian is as long as the unit.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import colormaps

from cfree import palette
from cfree.contact.contact import EdgeVertex
from cfree.contact.surface import contact_surface
from cfree.figures.space import curve, draw_frame, new_space, paint, sheet
from cfree.figures.style import new_figure
from cfree.geometry.local import local_geometry
from cfree.geometry.rulings import striction_parameter
from cfree.polygons.polygon import Polygon

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ROBOT = Polygon([(-1, "-0.6"), ("1.4", "-0.4"), ("-0.3", 1)])
OBSTACLE = Polygon([(0, 0), (2, 1), (1, 2)])
CONTACT = EdgeVertex(0, 0)
SURFACE = contact_surface(ROBOT, OBSTACLE, CONTACT)


POINT = (0.5, math.radians(40))
REACH = 0.5
"""Length of the directions drawn, on both sides of the point."""


def directions() -> Figure:
    """Figure 10: asymptotic and principal directions at a point of an e-v surface."""
    from matplotlib.patheffects import withStroke

    t0, phi0 = POINT
    t, phi = np.linspace(0.15, 0.85, 71), phi0 + np.linspace(-0.62, 0.62, 71)
    points = SURFACE(t[None, :], phi[:, None])
    low, high = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    figure = new_figure(6.4, 4.2)
    window = (low[0], low[1], high[0], high[1])
    degrees = (math.degrees(low[2]), math.degrees(high[2]))
    ax = new_space(
        figure, (-0.03, -0.4, 1.06, 1.46), window, angle_scale=1.0, view=(30.0, -75.0), degrees=degrees, zoom=1.22
    )
    at = local_geometry(SURFACE.ruled, t0, phi0)
    parts = [sheet(points, palette.FAINT, 1.0)]
    parts += [curve(SURFACE(s, phi), palette.GREY, 0.7) for s in np.linspace(t[0], t[-1], 9)]
    parts += [curve(SURFACE(t, angle), palette.GREY, 0.7) for angle in np.linspace(phi[0], phi[-1], 9)]
    paint(ax, parts)
    p = SURFACE(t0, phi0)
    for xis, colour, names in (
        (at.asymptotic_directions, palette.FRAME, (r"$\xi = 0$", r"$\xi = \arctan\frac{2v}{F}$")),
        (at.principal_directions, palette.VERTEX_EDGE, (r"$\xi_1$", r"$\xi_2$")),
    ):
        for xi, name in zip(xis, names, strict=True):
            along = at.tangent(xi)
            ends = np.stack((p - REACH * along, p + REACH * along)) * (1, 1, 180 / math.pi)
            ax.plot(*ends.T, color=colour, linewidth=2.6, zorder=10, solid_capstyle="round")
            x, y, z = (p + 1.2 * REACH * along) * (1, 1, 180 / math.pi)
            halo = [withStroke(linewidth=3, foreground="white", alpha=0.8)]
            ax.text(x, y, z, name, color=colour, fontsize=15, ha="center", va="center", zorder=12, path_effects=halo)
    ax.plot(
        *(p * (1, 1, 180 / math.pi))[:, None], "o", color=palette.INK, markersize=6, zorder=11, markeredgecolor="white"
    )
    return figure


def gaussian() -> Figure:
    """Figure 11: the Gaussian curvature of an e-v patch as a colour, and K and H over t."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    t, phi = np.linspace(0, 1, 61), np.linspace(0, math.tau, 301)
    points = SURFACE(t[None, :], phi[:, None])
    low, high = points.min(axis=(0, 1)) - 0.2, points.max(axis=(0, 1)) + 0.2
    figure = new_figure(9.4, 5.6)
    window = (low[0], low[1], high[0], high[1])
    ax = new_space(figure, (-0.02, 0.0, 0.6, 1.0), window, angle_scale=0.7, view=palette.VIEW, zoom=1.0)
    draw_frame(ax, range(-5, 6))
    middle = (t[1:] + t[:-1]) / 2
    K = local_geometry(SURFACE.ruled, middle, 0).gaussian_curvature
    norm, scale = Normalize(-1, 0), colormaps[palette.SEQUENTIAL]
    colours = np.tile(scale(norm(K))[:, :3], (len(phi) - 1, 1, 1))
    star = float(striction_parameter(SURFACE) or 0)
    rim = [curve(SURFACE(s, phi), palette.INK, 1.0) for s in (0.0, 1.0)]
    paint(ax, [sheet(points, colours, 0.7), *rim, curve(SURFACE(star, phi), "white", 2.2)])
    bar = figure.colorbar(ScalarMappable(norm, scale), cax=figure.add_axes((0.6, 0.2, 0.015, 0.6)))
    bar.ax.set_title("$K$", fontsize=13)
    graph = figure.add_axes((0.74, 0.2, 0.23, 0.6))
    fine = np.linspace(0, 1, 401)
    at = local_geometry(SURFACE.ruled, fine, 0)
    graph.plot(fine, at.gaussian_curvature, color=palette.INK, label="$K(t)$")
    graph.plot(fine, at.mean_curvature, color=palette.INK, linestyle="--", label="$H(t)$")
    graph.axvline(star, color=palette.GREY, linewidth=0.8, linestyle=":")
    graph.text(star, 1.02, "$t_*$", ha="center", va="bottom", transform=graph.get_xaxis_transform())
    graph.set(xlabel="$t$", xlim=(0, 1), ylim=(-1.05, 0.32), yticks=np.arange(-1, 0.3, 0.2))
    graph.spines[["top", "right"]].set_visible(False)
    graph.legend(loc="best")
    return figure
