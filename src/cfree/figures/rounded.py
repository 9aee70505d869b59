"""Figure 24: the trimmed boundary of rounded shapes; figure 9's triangle rounded, and a disc."""

from __future__ import annotations

from functools import cache

import numpy as np
from matplotlib.axes import Axes
from mpl_toolkits.mplot3d.axes3d import Axes3D

from cfree.arguments import checked
from cfree.curves.curved import Curved
from cfree.figures.arcs import outline
from cfree.figures.plane import label, set_plane, shape
from cfree.figures.space import DETAIL, draw_frame, legend, paint, set_space
from cfree.figures.surfaces import OTHER, TRIANGLE
from cfree.forbidden.boundary import Boundary, boundary
from cfree.palette import ARC_ARC, EDGE_EDGE, EDGE_VERTEX, FORBIDDEN, HELIX, OBSTACLE, ROBOT, VERTEX_EDGE
from cfree.plot.pieces import pieces_of
from cfree.scene.scene import Scene

RADIUS = "0.3"
ROBOT_TRIANGLE = Curved(TRIANGLE.exact_vertices, grown=RADIUS)
DISC = Curved.circle(("0.6", "0.2"), "0.5")
"""A disc that turns about a point beside it."""
OBSTACLES = tuple(
    Curved([(x + dx, y + dy) for x, y in OTHER.exact_vertices], grown=RADIUS) for dx, dy in ((0, 0), (3, 2))
)
WINDOW = (-4.0, -4.0, 7.0, 6.0)
SCALE = 1.5
LEGEND = [
    (VERTEX_EDGE, "arc on edge"), (EDGE_VERTEX, "edge on arc"), (ARC_ARC, "arc on arc"), ("-" + HELIX, "smooth joints"),
    ("-" + EDGE_EDGE, "edge on edge"), (FORBIDDEN, r"section at $\theta = 2\pi$"),
]  # fmt: skip


@cache
def boundary_of_robot(robot: Curved) -> Boundary:
    """Compute the boundary of one of the two robots."""
    return boundary(Scene(robot=robot, obstacles=OBSTACLES), threads=1)


@checked
def shapes_in_the_plane(ax: Axes) -> Axes:
    """Figure 24: two rounded triangles, and the two robots at rest."""
    set_plane(ax, (-8.0, -1.6, 5.2, 4.0))
    for k, obstacle in enumerate(OBSTACLES):
        shape(ax, outline(obstacle), OBSTACLE)
        label(ax, outline(obstacle).mean(axis=0), f"$O_{k + 1}$", colour=OBSTACLE, size=14)
    for dx, name, robot in ((-3.6, "$A$", ROBOT_TRIANGLE), (-6.6, "$D$", DISC)):
        points = outline(robot) + np.array([dx, 0.0])
        shape(ax, points, ROBOT)
        label(ax, points.mean(axis=0), name, colour=ROBOT, size=14)
    return ax


@checked
def rounded_triangles(ax: Axes3D) -> Axes3D:
    """Figure 24: the whole boundary of the rounded triangle."""
    return _drawn(ax, ROBOT_TRIANGLE)


@checked
def disc_boundary(ax: Axes3D) -> Axes3D:
    """Figure 24: the whole boundary of the disc."""
    return _drawn(ax, DISC)


def _drawn(ax: Axes3D, robot: Curved) -> Axes3D:
    set_space(ax, WINDOW, angle_scale=SCALE, view=(30.0, -62.0))
    draw_frame(ax, 2)
    paint(ax, [pieces_of(boundary_of_robot(robot), WINDOW, line=1.6, detail=DETAIL)])
    legend(ax, LEGEND, columns=3)
    return ax
