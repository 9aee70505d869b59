"""Figures 10 and 11: directions at a point of an e-v surface and a normal section; its curvature as a colour.

The formulas of section 4, in the metric dx^2 + dy^2 + dtheta^2: a radian is as long as the unit.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from mpl_toolkits.mplot3d.axes3d import Axes3D

from cfree.arguments import checked
from cfree.contact.contact import EdgeVertex
from cfree.contact.surface import contact_surface
from cfree.figures.plane import dot, label, line, set_plane
from cfree.figures.space import DEGREES, Floats, around, curve, draw_frame, grid, mark, note, paint, set_space, sheet
from cfree.geometry.local import LocalGeometry, local_geometry
from cfree.geometry.rulings import striction_parameter
from cfree.palette import FAINT, FRAME, GREY, INK, PATH, SEQUENTIAL, VERTEX_EDGE
from cfree.polygons.polygon import Polygon

ROBOT = Polygon([(-1, "-0.6"), ("1.4", "-0.4"), ("-0.3", 1)])
OBSTACLE = Polygon([(0, 0), (2, 1), (1, 2)])
SURFACE = contact_surface(ROBOT, OBSTACLE, EdgeVertex(0, 0))
POINT = (0.5, math.radians(40))
AT = local_geometry(SURFACE.ruled, *POINT)
REACH = 0.5
"""Length of the drawn directions, on both sides of the point."""
NAMES = (r"$\xi = 0$", r"$\xi = \arctan\frac{2v}{F}$"), (r"$\xi_1$", r"$\xi_2$")


# figure 10


@checked
def directions(ax: Axes3D) -> Axes3D:
    """Figure 10: asymptotic and principal directions at a point of an e-v surface, its normal and a normal section."""
    t, phi = np.linspace(0.12, 0.88, 39), POINT[1] + np.linspace(-0.62, 0.62, 39)
    points = grid(SURFACE, t, phi)
    degrees = math.degrees(phi[0]), math.degrees(phi[-1])
    set_space(ax, around(points, 0.0), angle_scale=1.0, view=(26.0, 100.0), degrees=degrees, zoom=1.1)
    net = [curve(SURFACE(s, phi), GREY, 0.5) for s in t[::6]]
    net += [curve(SURFACE(t, angle), GREY, 0.5) for angle in phi[::6]]
    p, section = SURFACE(*POINT), normal_section()
    paint(ax, [sheet(points, FAINT, 1.0), *net, curve(section, PATH, 2.4)])
    _draw_normal_plane(ax, section)
    for xis, colour, names in zip(
        (AT.asymptotic_directions, AT.principal_directions), (FRAME, VERTEX_EDGE), NAMES, strict=True
    ):
        for xi, name in zip(xis, names, strict=True):
            along = AT.tangent(xi)
            ends = np.stack((p - REACH * along, p + REACH * along)) * DEGREES
            ax.plot(*ends.T, color=colour, linewidth=2.6, zorder=10, solid_capstyle="round")
            note(ax, p + 1.22 * REACH * along, name, colour, 15)
    top = p + REACH * AT.normal
    ax.plot(*(np.stack((p, top)) * DEGREES).T, color=INK, linewidth=2.0, zorder=10)
    note(ax, p + 1.15 * REACH * AT.normal, "$N$", size=15)
    note(ax, section[0] + 0.1 * AT.normal, "normal section", PATH, 12)
    mark(ax, p)
    return ax


def normal_section() -> Floats:
    """Return the section of the surface, near the point, by the plane of normal and second principal direction."""
    p, across = SURFACE(*POINT), AT.tangent(AT.principal_directions[0])
    phi = POINT[1] + np.linspace(-0.6, 0.6, 241)
    # a ruling is a line: it meets the plane once
    start, along = SURFACE(0, phi), SURFACE(1, phi) - SURFACE(0, phi)
    t = ((p - start) @ across) / (along @ across)
    points: Floats = start + t[:, None] * along
    near: Floats = points[(np.abs(points - p).max(axis=1) < 1.1 * REACH) & (t > 0.12) & (t < 0.88)]
    return near


def _draw_normal_plane(ax: Any, section: Floats) -> None:
    """Draw the part of the plane above the surface."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    p, along = SURFACE(*POINT), AT.tangent(AT.principal_directions[1])
    top = p + np.outer((section - p) @ along, along) + 0.9 * REACH * AT.normal
    outline = np.concatenate((section, top[::-1])) * DEGREES
    ax.add_collection3d(Poly3DCollection([outline], facecolor=PATH, alpha=0.13, edgecolor="none", zorder=5))


@checked
def indicatrix(ax: Axes) -> Axes:
    """Figure 10: Dupin's indicatrix in the tangent plane, the vectors X with II(X, X) = 1 or -1.

    Its distance in each direction is 1 / sqrt(abs(normal curvature)).
    """
    reach = 2.3 * float(AT.dupin_radius(AT.principal_directions).min())
    set_plane(ax, (-1.25 * reach, -1.25 * reach, 1.25 * reach, 1.25 * reach))
    asymptotic, principal = AT.asymptotic_directions, AT.principal_directions
    for xis, colour, names, way in ((asymptotic, FRAME, NAMES[0], 1.0), (principal, VERTEX_EDGE, NAMES[1], 1.0)):
        for xi, name in zip(xis.tolist(), names, strict=True):
            end = reach * np.array([math.cos(xi), math.sin(xi)])
            line(ax, -end, end, colour, width=1.8)
            label(ax, 1.13 * way * end, name if name != NAMES[0][1] else r"$\xi = \arctan\frac{2v}{F}$", colour=colour)
    for points, is_positive in conics(AT, reach):
        place = min(
            points[len(points) // 7], points[-(len(points) // 7)], key=lambda point: abs(point[1])
        )  # beside a ruling
        name = r"$\mathrm{II}(X, X) = 1$" if is_positive else r"$\mathrm{II}(X, X) = -1$"
        label(ax, place, name, 26 * points[len(points) // 2] / np.hypot(*points[len(points) // 2]), PATH, 12)
        ax.plot(*points.T, color=PATH, linewidth=2.2, linestyle="-" if is_positive else (0, (4, 2)), zorder=5)
    dot(ax, (0, 0), size=6)
    return ax


def conics(forms: LocalGeometry, reach: float) -> list[tuple[Floats, bool]]:
    """Return the four branches of the indicatrix within a radius, each with True if its curvature is positive."""
    first, second = forms.asymptotic_directions.tolist()
    branches = []
    for low, high in ((first, second), (second, first + math.pi)):
        xi = np.linspace(low, high, 2001)[1:-1]
        radius = forms.dupin_radius(xi)
        xi, radius = xi[radius < reach], radius[radius < reach]
        branch = radius[:, None] * np.column_stack((np.cos(xi), np.sin(xi)))
        is_positive = bool(forms.normal_curvature((low + high) / 2) > 0)
        branches += [(branch, is_positive), (-branch, is_positive)]
    return branches


# figure 11


@checked
def gaussian_curvature(ax: Axes3D) -> Axes3D:
    """Figure 11: the Gaussian curvature of an e-v surface as a colour; the striction curve is white."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    t, phi = np.linspace(0, 1, 25), np.linspace(0, math.tau, 181)
    points = grid(SURFACE, t, phi)
    set_space(ax, around(points, 0.2), angle_scale=0.7)
    draw_frame(ax)
    K = local_geometry(SURFACE.ruled, (t[1:] + t[:-1]) / 2, 0).gaussian_curvature
    norm, scale = Normalize(-1, 0), colormaps[SEQUENTIAL]
    colours = np.tile(scale(norm(K))[:, :3], (len(phi) - 1, 1, 1))
    rim = [curve(SURFACE(s, phi), INK, 1.0) for s in (0.0, 1.0)]
    paint(ax, [sheet(points, colours, 0.7), *rim, curve(SURFACE(_star(), phi), "white", 2.4)])
    bar: Any = ax.figure.colorbar(ScalarMappable(norm, scale), ax=ax, shrink=0.55, aspect=28, pad=0.03)
    bar.ax.set_title("$K$", fontsize=13, pad=8)
    bar.outline.set_visible(False)
    return ax


@checked
def curvature_along(ax: Axes) -> Axes:
    """Figure 11: K and H along a ruling; K is least where the striction curve crosses it."""
    t, star = np.linspace(0, 1, 401), _star()
    forms = local_geometry(SURFACE.ruled, t, 0)
    ax.plot(t, forms.gaussian_curvature, color=INK, label="$K(t)$")
    ax.plot(t, forms.mean_curvature, color=INK, linestyle="--", label="$H(t)$")
    ax.axvline(star, color=GREY, linewidth=0.8, linestyle=":")
    ax.text(star, 1.02, "$t_*$", ha="center", va="bottom", transform=ax.get_xaxis_transform())
    ax.set(xlabel="$t$", xlim=(0, 1), ylim=(-1.05, 0.32), yticks=np.arange(-1, 0.3, 0.2))
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(loc="best", frameon=False)
    return ax


def _star() -> float:
    return float(striction_parameter(SURFACE) or 0)
