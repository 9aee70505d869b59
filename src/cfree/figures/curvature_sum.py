"""Figure 14: where the curvature of a closed surface is, as the length of a radian grows, and what it adds up to."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from cfree import palette
from cfree.figures.scenes import FIVE
from cfree.figures.style import new_figure
from cfree.forbidden.boundary import boundary
from cfree.geometry.curvature_sum import gauss_bonnet

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SCALES = np.geomspace(0.1, 10, 41)


def gauss_and_bonnet() -> Figure:
    """Figure 14: the boundary of figure 12, which is one surface."""
    found = boundary(FIVE, threads=1)
    sums = []
    for w in SCALES:
        of = gauss_bonnet(found, angle_scale=float(w))
        sums.append([of.faces.sum(), of.sides.sum(), of.vertices.sum()])
    faces, edges, vertices = np.array(sums).T / math.tau
    figure = new_figure(7.2, 4.4)
    ax = figure.add_axes((0.11, 0.15, 0.86, 0.8))
    ax.set(xscale="log", xlim=SCALES[[0, -1]], xlabel="length of a radian", ylabel=r"curvature / $2\pi$")
    for values, name, colour in (
        (vertices, "at vertices", palette.VERTEX_EDGE),
        (faces, "on faces", palette.EDGE_VERTEX),
        (edges, "along edges", palette.HELIX),
    ):
        ax.plot(SCALES, values, color=colour, label=name, linewidth=1.8)
    chi = int(found.complex.euler.sum())
    ax.plot(SCALES, faces + edges + vertices, color=palette.INK, label=rf"all together: $\chi = {chi}$", linewidth=2.4)
    ax.set_xticks([0.1, 1, 10], ["0.1", "1", "10"])
    ax.minorticks_off()
    ax.set_ylim(-32, 30)
    ax.set_yticks(range(-30, 31, 10))
    ax.axhline(0, color=palette.GREY, linewidth=0.8)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    ax.legend(loc="best")
    return figure
