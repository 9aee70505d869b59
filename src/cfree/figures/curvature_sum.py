"""Figure 14: the shares of a closed surface's curvature, as the length of a radian grows, and their sum."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from cfree.arguments import checked
from cfree.figures.scenes import five_boundary
from cfree.geometry.curvature_sum import gauss_bonnet
from cfree.palette import EDGE_VERTEX, GREY, HELIX, INK, VERTEX_EDGE

SCALES = np.geomspace(0.1, 10, 41)


@checked
def gauss_and_bonnet(ax: Axes) -> Axes:
    """Figure 14: curvature of the boundary of figure 12, which is one surface."""
    surface = five_boundary()
    sums = []
    for w in SCALES:
        parts = gauss_bonnet(surface, angle_scale=float(w))
        sums.append([parts.faces.sum(), parts.sides.sum(), parts.vertices.sum()])
    faces, edges, vertices = np.array(sums).T / math.tau
    ax.set(xscale="log", xlim=SCALES[[0, -1]], xlabel="length of a radian", ylabel=r"curvature / $2\pi$")
    for values, name, colour in (
        (vertices, "at vertices", VERTEX_EDGE),
        (faces, "on faces", EDGE_VERTEX),
        (edges, "along edges", HELIX),
    ):
        ax.plot(SCALES, values, color=colour, label=name, linewidth=1.8)
    chi = int(surface.complex.euler.sum())
    ax.plot(SCALES, faces + edges + vertices, color=INK, label=rf"all together: $\chi = {chi}$", linewidth=2.4)
    ax.set_xticks([0.1, 1, 10], ["0.1", "1", "10"])
    ax.minorticks_off()
    ax.set_ylim(-32, 30)
    ax.set_yticks(range(-30, 31, 10))
    ax.axhline(0, color=GREY, linewidth=0.8)
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(loc="upper right", frameon=False)
    return ax
