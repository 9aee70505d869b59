"""Figure 17: a v-e patch beside its development: the patch unrolls into the plane, lengths and angles unchanged."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from mpl_toolkits.mplot3d.axes3d import Axes3D

from cfree.arguments import checked
from cfree.contact.contact import VertexEdge, angle_range
from cfree.contact.surface import contact_surface
from cfree.figures.space import around, curve, draw_frame, grid, note, paint, set_space, sheet
from cfree.figures.surfaces import OTHER, TRIANGLE
from cfree.palette import EDGE_EDGE, INK, VERTEX_EDGE
from cfree.plot.development import HELICES, RULINGS, plot_development

CONTACT = VertexEdge(1, 0)


@checked
def patch_in_space(ax: Axes3D) -> Axes3D:
    """Figure 17: the v-e patch of figure 7 in the configuration space."""
    S, Phi = contact_surface(TRIANGLE, OTHER, CONTACT), angle_range(TRIANGLE, OTHER, CONTACT)
    t, phi = np.linspace(0, 1, 25), Phi.phi_min + Phi.phi_range * np.linspace(0, 1, 73)
    points = grid(S, t, phi)
    ends = math.degrees(phi[0]) - 12, math.degrees(phi[-1]) + 12
    set_space(ax, around(points, 0.3), angle_scale=1.0, degrees=ends, zoom=0.95)
    draw_frame(ax)
    lines = [curve(S(t, angle), EDGE_EDGE, 1.4) for angle in np.linspace(phi[0], phi[-1], RULINGS)]
    lines += [curve(S(s, phi), INK, 1.6 if s in (0, 1) else 0.7) for s in np.linspace(0, 1, HELICES)]
    paint(ax, [sheet(points, VERTEX_EDGE, 1.0), *lines])
    for angle, name in ((phi[0], "min"), (phi[-1], "max")):
        note(ax, S(1.0, angle) + np.array([0.25, 0, 0]), rf"$\phi_{{\{name}}}$", ha="left", size=14)
    return ax


@checked
def patch_unrolled(ax: Axes) -> Axes:
    """Figure 17: the same patch in the plane: its rulings are parallel, its helices are one curve moved along them."""
    plot_development(TRIANGLE, OTHER, CONTACT, ax=ax)
    ax.set_title("")
    return ax
