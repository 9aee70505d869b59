"""Figures 7 to 9: whole contact surfaces of both kinds, and all contact patches of two triangles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from cfree import palette
from cfree.contact.contact import EdgeVertex, VertexEdge
from cfree.contact.surface import Surface, contact_surface
from cfree.figures.space import curve, draw_frame, legend, new_space, paint, sheet
from cfree.figures.style import new_figure
from cfree.forbidden.boundary import boundary
from cfree.plot.pieces import Colours, pieces_of
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ROBOT = Polygon([(-1, "-0.6"), ("1.2", "-0.4"), ("-0.3", 1)])
OBSTACLE = Polygon([("-1.5", -1), ("1.6", "-0.7"), ("0.2", "1.4")])


def vertex_edge() -> Figure:
    """Figure 7: a v-e contact surface; its helices are congruent."""
    return _surface(contact_surface(ROBOT, OBSTACLE, VertexEdge(1, 0)), palette.VERTEX_EDGE)


def edge_vertex() -> Figure:
    """Figure 8: an e-v contact surface; its helices have different radii."""
    return _surface(contact_surface(ROBOT, OBSTACLE, EdgeVertex(0, 1)), palette.EDGE_VERTEX)


def _surface(S: Surface, colour: str) -> Figure:
    t, phi = np.linspace(0, 1, 41), np.linspace(0, math.tau, 301)
    points = S(t[None, :], phi[:, None])
    (x0, y0), (x1, y1) = points[..., :2].min(axis=(0, 1)) - 0.3, points[..., :2].max(axis=(0, 1)) + 0.3
    figure = new_figure(6.2, 6.4)
    scale = 0.16 * (x1 - x0 + y1 - y0) / 2
    ax = new_space(figure, (0.02, 0.05, 0.96, 0.95), (x0, y0, x1, y1), angle_scale=scale, view=palette.VIEW, zoom=0.98)
    draw_frame(ax, range(-5, 6))
    helices = [curve(S(s, phi), "black", 1.4) for s in np.linspace(0, 1, 5)]
    rulings = [curve(S(t, angle), palette.EDGE_EDGE, 1.6) for angle in np.linspace(0, math.tau, 25)]
    paint(ax, [sheet(points, colour, scale), *rulings, *helices])
    names = (
        ("-black", r"helices $\phi \mapsto S(t, \phi)$"),
        ("-" + palette.EDGE_EDGE, r"rulings $t \mapsto S(t, \phi)$"),
    )
    legend(figure, names)
    return figure


def pillar() -> Figure:
    """Figure 9: all contact patches of two triangles, v-v helices and e-e segments."""
    found = boundary(Scene(robot=ROBOT, obstacles=OBSTACLE), threads=1)
    window = (-3.2, -2.8, 3.2, 3.0)
    figure = new_figure(6.2, 7)
    ax = new_space(figure, (0.02, 0.05, 0.96, 0.95), window, angle_scale=1.1, view=palette.VIEW, zoom=1.02)
    draw_frame(ax, range(-5, 6))
    paint(ax, [pieces_of(found, window, colours_of(), 3.0)])
    patch_legend(figure)
    return figure


def colours_of() -> Colours:
    """The colours of patches and curves."""
    return Colours(palette.VERTEX_EDGE, palette.EDGE_VERTEX, palette.HELIX, palette.EDGE_EDGE)


def patch_legend(figure: Figure) -> None:
    """What the colours of patches and curves mean."""
    names = ("v-e patches", "e-v patches", "v-v helices", "e-e segments")
    shown = (palette.VERTEX_EDGE, palette.EDGE_VERTEX, "-" + palette.HELIX, "-" + palette.EDGE_EDGE)
    legend(figure, list(zip(shown, names, strict=True)))
