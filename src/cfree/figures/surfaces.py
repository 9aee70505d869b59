"""Figures 7 and 8: whole contact surfaces of both kinds, their patches in full colour."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from mpl_toolkits.mplot3d.axes3d import Axes3D

from cfree.arguments import checked
from cfree.contact.contact import AngleRange, EdgeVertex, VertexEdge, angle_range
from cfree.contact.surface import Surface, contact_surface
from cfree.figures.space import Floats, around, curve, draw_frame, grid, legend, note, paint, set_space, sheet
from cfree.palette import EDGE_EDGE, EDGE_VERTEX, INK, VERTEX_EDGE, VIEW, paler
from cfree.plot.pieces import Pieces
from cfree.polygons.polygon import Polygon

TRIANGLE = Polygon([(-1, "-0.6"), ("1.2", "-0.4"), ("-0.3", 1)])
OTHER = Polygon([("-1.5", -1), ("1.6", "-0.7"), ("0.2", "1.4")])
"""The robot and the obstacle of figures 7 to 9."""
REST = 0.62
"""Share of white in the part of a surface where contacts are pseudo contacts."""


@checked
def vertex_edge_surface(ax: Axes3D) -> Axes3D:
    """Figure 7: a v-e contact surface, its patch brighter; its helices are congruent."""
    return _surface(ax, VertexEdge(1, 0), VERTEX_EDGE)


@checked
def edge_vertex_surface(ax: Axes3D) -> Axes3D:
    """Figure 8: an e-v contact surface, its patch brighter; its helices have different radii."""
    return _surface(ax, EdgeVertex(0, 1), EDGE_VERTEX)


def _surface(ax: Axes3D, contact: VertexEdge | EdgeVertex, colour: str) -> Axes3D:
    S, Phi = contact_surface(TRIANGLE, OTHER, contact), angle_range(TRIANGLE, OTHER, contact)
    window = around(grid(S, np.linspace(0, 1, 9), np.linspace(0, math.tau, 73)), 0.3)
    scale = 0.08 * (window[2] - window[0] + window[3] - window[1])
    set_space(ax, window, angle_scale=scale, zoom=0.94)
    draw_frame(ax)
    t = np.linspace(0, 1, 41)
    helices = [curve(S(s, np.linspace(0, math.tau, 181)), INK, 1.2) for s in np.linspace(0, 1, 5)]
    rulings = [curve(S(t, angle), EDGE_EDGE, 1.2) for angle in np.linspace(0, math.tau, 25)]
    ends = [Phi.phi_min % math.tau, Phi.phi_max % math.tau]
    rims = [curve(S(t, angle), EDGE_EDGE, 3.2) for angle in ends]
    paint(ax, [surface_with_patch(S, Phi, colour, scale), *rulings, *helices, *rims])
    right = np.array([-math.sin(math.radians(VIEW[1])), math.cos(math.radians(VIEW[1])), 0])
    for angle, name in zip(ends, ("min", "max"), strict=True):
        end = max(S(np.array([0.0, 1.0]), angle), key=lambda point: float(point @ right))
        note(ax, end + 0.28 * right, rf"$\phi_{{\{name}}}$", size=14, ha="left")
    rest = paler(colour, REST)
    names = [(colour, r"patch: contacts, $\phi \in \Phi$"), (rest, "pseudo contacts")]
    names += [("-" + INK, r"helices $\phi \mapsto S(t, \phi)$"), ("-" + EDGE_EDGE, r"rulings $t \mapsto S(t, \phi)$")]
    legend(ax, names, columns=2)
    return ax


def surface_with_patch(S: Surface, Phi: AngleRange, colour: str, scale: float) -> Pieces:
    """Make pieces of a surface over a full turn, paler where contacts are pseudo contacts."""
    ends = np.mod([Phi.phi_min, Phi.phi_max], math.tau)
    t, phi = np.linspace(0, 1, 13), np.union1d(np.linspace(0, math.tau, 181), ends)
    inside = is_inside(Phi, (phi[1:] + phi[:-1]) / 2)
    rgb = np.where(inside[:, None, None], _rgb(colour), _rgb(paler(colour, REST)))
    return sheet(grid(S, t, phi), np.tile(rgb, (1, len(t) - 1, 1)), scale)


def is_inside(Phi: AngleRange, phi: Floats) -> Any:
    """Return True for angles in a range."""
    return np.mod(phi - Phi.phi_min, math.tau) < Phi.phi_range


def _rgb(colour: str) -> Floats:
    from matplotlib.colors import to_rgb

    return np.array(to_rgb(colour))
