"""Figure 9: all contact patches of two triangles; figure 18: patches by classes of congruence."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from mpl_toolkits.mplot3d import proj3d
from mpl_toolkits.mplot3d.axes3d import Axes3D

from cfree.arguments import checked
from cfree.contact.contact import EdgeVertex, VertexEdge, angle_range, contacts
from cfree.contact.surface import contact_surface
from cfree.figures.plane import corner_labels, label, set_plane, shape
from cfree.figures.space import DEGREES, DETAIL, Floats, draw_frame, grid, legend, paint, seen, set_space, sheet
from cfree.figures.surfaces import OTHER, TRIANGLE
from cfree.forbidden.boundary import Boundary, boundary
from cfree.geometry.congruence import patch_classes
from cfree.palette import CATEGORIES, EDGE_EDGE, EDGE_VERTEX, FORBIDDEN, HELIX, OBSTACLE, ROBOT, VERTEX_EDGE, VIEW
from cfree.plot.pieces import SECTION, Pieces, level, of_one_colour, pieces_of
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene

WINDOW = (-3.2, -2.8, 3.2, 3.0)
SCALE = 1.1
ROOM = 20  # least typographic points across the middle half of a patch with a name
BEHIND = (VIEW[0], -163.0)
LEGEND = [
    (VERTEX_EDGE, "v-e patches"), (EDGE_VERTEX, "e-v patches"), ("-" + HELIX, "v-v helices"),
    ("-" + EDGE_EDGE, "e-e segments"),
]  # fmt: skip


@cache
def pillar_boundary() -> Boundary:
    """Compute the boundary of figures 9 and 13."""
    return boundary(Scene(robot=TRIANGLE, obstacles=OTHER), threads=1)


@checked
def pillar(ax: Axes3D) -> Axes3D:
    """Figure 9: all contact patches of two triangles with their names, v-v helices and e-e segments."""
    _named_patches(ax, VIEW)
    legend(ax, [*LEGEND, (FORBIDDEN, r"section at $\theta = 2\pi$")], columns=3)
    return ax


@checked
def pillar_from_behind(ax: Axes3D) -> Axes3D:
    """Figure 9: the same patches, seen from half a turn further."""
    _named_patches(ax, BEHIND, 2)
    return ax


@checked
def pillar_workspace(ax: Axes) -> Axes:
    """Figure 9: the two triangles, their vertices and edges named as in the patches."""
    a, b = TRIANGLE.vertices, OTHER.vertices + np.array([3.6, 0.1])
    set_plane(ax, (-1.7, -1.6, 5.8, 2.1))
    for corners, colour, letter, name in ((a, ROBOT, "a", "A"), (b, OBSTACLE, "b", "O")):
        shape(ax, corners, colour)
        corner_labels(ax, corners, [f"${letter}_{k}$" for k in (1, 2, 3)], 10)
        label(ax, corners.mean(axis=0), f"${name}$", size=15, colour=colour)
    return ax


def _named_patches(ax: Any, view: tuple[float, float], step: float = 1) -> None:
    set_space(ax, WINDOW, angle_scale=SCALE, view=view, zoom=1.02)
    draw_frame(ax, step)
    painting = paint(ax, [pieces_of(pillar_boundary(), WINDOW, line=2.4, detail=DETAIL)])
    named = contacts(TRIANGLE, OTHER)
    places = np.array([_inside(contact) for contact in named])
    shown = seen(ax, painting, places.reshape(-1, 3)).reshape(places.shape[:2])
    flat = np.column_stack(proj3d.proj_transform(*(places.reshape(-1, 3) * DEGREES).T, ax.M))[:, :2]
    across = np.ptp(ax.transData.transform(flat)[:, 0].reshape(shown.shape), axis=1) * 72 / ax.figure.dpi
    for contact, place, around, width in zip(named, places[:, 0], shown, across.tolist(), strict=True):
        if around.all() and width > ROOM:
            robots, obstacles = ("v", "e") if isinstance(contact, VertexEdge) else ("e", "v")
            x, y, z = (place * DEGREES).tolist()
            name = f"${robots}_{contact.i + 1}$-${obstacles}_{contact.j + 1}$"
            ax.text(x, y, z, name, fontsize=13, color="white", ha="center", va="center", zorder=12)


def _inside(contact: VertexEdge | EdgeVertex) -> Floats:
    """Return the middle of a patch, and points around it: if all are visible, there is room for a name."""
    S, Phi = contact_surface(TRIANGLE, OTHER, contact), angle_range(TRIANGLE, OTHER, contact)
    t, share = np.array([(0.5, 0.5), (0.25, 0.5), (0.75, 0.5), (0.5, 0.25), (0.5, 0.75)]).T
    # the larger part of a patch that continues beyond a full turn
    low, high = Phi.phi_min % math.tau, Phi.phi_min % math.tau + Phi.phi_range
    low, high = max([(low, min(high, math.tau)), (math.tau, high)], key=lambda part: part[1] - part[0])
    points: Floats = S(t, low + share * (high - low))
    points[:, 2] -= math.tau * (low == math.tau)
    return points


# figure 18


REGULAR = Polygon([(-1, -1), (1, -1), (1, 1), (-1, 1)])
KITE = Polygon([("0", "-1.3"), ("1.1", "0.1"), ("0", "0.9"), ("-1.1", "0.1")])
"""Two robots, a square and a kite about the reference point; both turn among squares."""


WARM = (CATEGORIES[5], CATEGORIES[1], CATEGORIES[6])
COOL = (CATEGORIES[0], CATEGORIES[4], CATEGORIES[7], CATEGORIES[3])
"""Colours of classes of v-e and of e-v patches."""


@checked
def congruent_squares(ax: Axes3D) -> Axes3D:
    """Figure 18: the patches of two squares, coloured by class: regular polygons have one class of each kind."""
    return _classes(ax, REGULAR)


@checked
def congruent_kite(ax: Axes3D) -> Axes3D:
    """Figure 18: the patches of a kite and a square, coloured by class of congruence."""
    return _classes(ax, KITE)


@checked
def squares(ax: Axes) -> Axes:
    """Figure 18: the two squares."""
    return _pair(ax, REGULAR)


@checked
def kite_and_square(ax: Axes) -> Axes:
    """Figure 18: the kite and the square."""
    return _pair(ax, KITE)


def _pair(ax: Axes, robot: Polygon) -> Axes:
    set_plane(ax, (-1.8, -1.5, 4.8, 1.5))
    for corners, colour, name in ((robot.vertices, ROBOT, "A"), (REGULAR.vertices + np.array([3, 0]), OBSTACLE, "O")):
        shape(ax, corners, colour)
        label(ax, corners.mean(axis=0), f"${name}$", (0, 0), colour, 15)
    return ax


def _classes(ax: Axes3D, robot: Polygon) -> Axes3D:
    found = boundary(Scene(robot=robot, obstacles=REGULAR), threads=1)
    set_space(ax, WINDOW, angle_scale=SCALE, zoom=1.0)
    draw_frame(ax)
    parts = [_section(found)]
    shades = {VertexEdge: iter(WARM), EdgeVertex: iter(COOL)}
    names = []
    for members in patch_classes(robot, REGULAR):
        kind = type(members[0])
        colour = next(shades[kind])
        names.append((colour, f"class of {len(members)} {'v-e' if kind is VertexEdge else 'e-v'}"))
        for contact in members:
            parts += _patch(robot, contact, colour)
    paint(ax, parts)
    legend(ax, names, columns=2)
    return ax


def _patch(robot: Polygon, contact: VertexEdge | EdgeVertex, colour: str) -> list[Pieces]:
    """Make the pieces of a patch, cut where theta is a full turn."""
    S, Phi = contact_surface(robot, REGULAR, contact), angle_range(robot, REGULAR, contact)
    low, t, parts = Phi.phi_min % math.tau, np.linspace(0, 1, 7), []
    high = low + Phi.phi_range
    for start, stop, turn in ((low, min(high, math.tau), 0.0), (math.tau, high, math.tau)):
        if start < stop:
            points = grid(S, t, np.linspace(start, stop, 2 + int(20 * (stop - start)))) - (0, 0, turn)
            parts.append(sheet(points, colour, SCALE))
    return parts


def _section(surface: Boundary) -> Pieces:
    corners = level(surface.slice(-1e-6).forbidden, 360.0)
    return of_one_colour(corners, FORBIDDEN, SECTION, np.full(len(corners), -1))
