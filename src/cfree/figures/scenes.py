"""Figures 12 and 13: the boundary among many obstacles, and a stack of slices beside the surface they come from."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from mpl_toolkits.mplot3d.axes3d import Axes3D

from cfree.arguments import checked
from cfree.figures.pillars import LEGEND, SCALE, WINDOW, pillar_boundary
from cfree.figures.plane import label, placed, set_plane, shape
from cfree.figures.space import DETAIL, draw_frame, legend, paint, set_space
from cfree.forbidden.boundary import Boundary, boundary
from cfree.palette import EDGE_VERTEX, FORBIDDEN, GREY, OBSTACLE, ROBOT, VERTEX_EDGE
from cfree.plot.pieces import SURFACE, Pieces, level, of_line, of_one_colour, pieces_of
from cfree.scene.scene import Scene

FIVE = Scene(
    robot=[("-0.7", "-0.5"), ("0.9", "-0.4"), ("-0.2", "0.9")],
    obstacles=[
        [("1.2", "5.2"), ("3.6", "4.6"), ("3.1", "7.4")],
        [("2.2", "1.1"), ("4.3", "0.8"), ("4.8", "2.6"), ("2.6", "3.1")],
        [("5.3", 4), ("6.7", "3.5"), ("7.8", "4.6"), ("7.2", 6), ("5.7", "5.9")],
        [(8, "0.9"), ("9.5", "0.6"), ("10.6", "1.7"), ("10.2", "3.1"), ("8.8", "3.5"), ("7.7", "2.4")],
        [("9.3", 6), (11, "5.4"), ("11.4", "7.3"), ("9.9", "8.1")],
    ],
    start=(1, "1.2", 0),
    goal=(11, "4.3", "120deg"),
)
"""`examples/scenes/five_convex.json`, which is not installed, without its bounds."""
AROUND = (-0.6, -0.8, 12.6, 9.6)
TURNED = (33.0, -118.0)
"""A camera that faces the meeting of the pillars of O_3 and O_4."""
SLICES = 37


@cache
def five_boundary() -> Boundary:
    """Compute the boundary of figures 12 and 14."""
    return boundary(FIVE, threads=1)


@checked
def five_obstacles(ax: Axes) -> Axes:
    """Figure 12: five obstacles in the plane, the robot at its start and goal."""
    set_plane(ax, (-0.3, -0.3, 12.2, 9))
    for k, obstacle in enumerate(FIVE.obstacles):
        shape(ax, obstacle.vertices, OBSTACLE)
        label(ax, obstacle.vertices.mean(axis=0), f"$O_{k + 1}$", colour=OBSTACLE, size=14)
    for pose, name, tint in ((FIVE.start, "start", 0.6), (FIVE.goal, "goal", 0.3)):
        if pose is not None:
            corners = placed(FIVE.robot[0].vertices, (float(pose.x), float(pose.y), pose.theta))
            shape(ax, corners, ROBOT, alpha=tint)
            label(ax, (float(pose.x), corners[:, 1].min()), name, (0, -10), GREY, 12)
    return ax


@checked
def five_pillars(ax: Axes3D) -> Axes3D:
    """Figure 12: the whole boundary of the five obstacles; patches trim each other where pillars meet."""
    set_space(ax, AROUND, angle_scale=1.3, view=TURNED, zoom=1.02)
    draw_frame(ax, 3)
    paint(ax, [pieces_of(five_boundary(), AROUND, line=1.6, detail=DETAIL)])
    for k, obstacle in enumerate(FIVE.obstacles):
        top: Any = (*obstacle.vertices.mean(axis=0), 360)
        ax.text(*top, f"$O_{k + 1}$", ha="center", va="center", zorder=12, fontsize=14, color=OBSTACLE)
    legend(ax, LEGEND)
    return ax


@checked
def slice_stack(ax: Axes3D) -> Axes3D:
    """Figure 13: slices at equal steps of theta."""
    set_space(ax, WINDOW, angle_scale=SCALE)
    draw_frame(ax)
    # the view is from above: no slice hides one above it
    for k, degrees in enumerate(np.linspace(0, 360, SLICES).tolist()):
        paint(ax, slice_pieces(pillar_boundary(), degrees), 1 + k, "matplotlib")
    legend(ax, [("-" + VERTEX_EDGE, "v-e contacts"), ("-" + EDGE_VERTEX, "e-v contacts")])
    return ax


@checked
def slice_source(ax: Axes3D) -> Axes3D:
    """Figure 13: the surface that contains the slices' rims."""
    set_space(ax, WINDOW, angle_scale=SCALE)
    draw_frame(ax)
    paint(ax, [pieces_of(pillar_boundary(), WINDOW, line=2.0, detail=DETAIL)])
    legend(ax, LEGEND, columns=2)
    return ax


def slice_pieces(surface: Boundary, degrees: float) -> list[Pieces]:
    """Return the forbidden region at one orientation, and its rim in the colours of its contacts."""
    cut = surface.slice(f"{degrees}deg")
    inside = level(cut.forbidden, degrees)
    colours = {1: VERTEX_EDGE, 2: EDGE_VERTEX}
    rim = [
        of_line(np.column_stack((segment, (degrees, degrees))), colours[kind], 1.5)
        for segment, kind in zip(cut.segments, surface.patch_kind[cut.patches].tolist(), strict=True)
    ]
    return [of_one_colour(inside, FORBIDDEN, SURFACE, np.full(len(inside), -1)), *rim]
