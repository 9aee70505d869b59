"""Figures 12 and 13: the boundary among many obstacles, and a stack of slices beside the surface they come from."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from cfree import palette
from cfree.figures.plane import label, placed, shape
from cfree.figures.space import draw_frame, new_space, paint
from cfree.figures.style import new_figure
from cfree.figures.surfaces import OBSTACLE, ROBOT, colours_of, patch_legend
from cfree.forbidden.boundary import Boundary, boundary
from cfree.plot.pieces import ON_TOP, SURFACE, Pieces, level, of_line, of_one_colour, pieces_of
from cfree.scene.scene import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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
SLICES = 37


def five_obstacles() -> Figure:
    """Figure 12: five obstacles in the plane, and all of the boundary they make without bounds."""
    found = boundary(FIVE, threads=1)
    figure = new_figure(10.4, 5.8)
    plane = figure.add_axes((0.01, 0.17, 0.35, 0.76))
    plane.set(xlim=(0, 12), ylim=(-0.2, 9), aspect="equal")
    plane.set_axis_off()
    for k, obstacle in enumerate(FIVE.obstacles):
        shape(plane, obstacle.vertices, palette.OBSTACLE)
        label(plane, obstacle.vertices.mean(axis=0), f"$O_{k + 1}$", colour=palette.OBSTACLE)
    for pose, name, tint in ((FIVE.start, "start", 0.6), (FIVE.goal, "goal", 0.3)):
        if pose is not None:
            q = (float(pose.x), float(pose.y), pose.theta)
            shape(plane, placed(FIVE.robot[0].vertices, q), palette.ROBOT, alpha=tint)
            label(plane, q[:2], name, (0, -26), palette.GREY, 11)
    window = (-0.6, -0.8, 12.6, 9.6)
    ax = new_space(figure, (0.36, 0.06, 0.64, 0.94), window, angle_scale=1.3, view=(36.0, -62.0), zoom=1.08)
    draw_frame(ax, range(0, 13, 3))
    paint(ax, [pieces_of(found, window, colours_of(), 1.6)])
    patch_legend(figure)
    return figure


def slices() -> Figure:
    """Figure 13: slices at equal steps of theta, and the surface they are cut from."""
    found = boundary(Scene(robot=ROBOT, obstacles=OBSTACLE), threads=1)
    figure = new_figure(10.4, 5.6)
    window = (-3.2, -2.8, 3.2, 3.0)
    axes: list[Any] = [
        new_space(figure, (left, 0.06, 0.48, 0.94), window, angle_scale=1.1, view=palette.VIEW, zoom=1.0)
        for left in (0.025, 0.515)
    ]
    for ax in axes:
        draw_frame(ax, range(-5, 6))
    # seen from above, no slice hides one above it
    for k, degrees in enumerate(np.linspace(0, 360, SLICES).tolist()):
        paint(axes[0], slice_pieces(found, degrees), 1 + k)
    paint(axes[1], [pieces_of(found, window, colours_of(), 2.4)])
    patch_legend(figure)
    return figure


def slice_pieces(found: Boundary, degrees: float) -> list[Pieces]:
    """The forbidden region at one orientation, and its rim in the colours of its contacts."""
    cut = found.slice(f"{degrees}deg")
    inside = level(cut.forbidden, degrees)
    colours = {1: palette.VERTEX_EDGE, 2: palette.EDGE_VERTEX}
    rim = [
        of_line(np.column_stack((segment, (degrees, degrees))), colours[kind], 1.5, ON_TOP)
        for segment, kind in zip(cut.segments, found.patch_kind[cut.patches].tolist(), strict=True)
    ]
    return [of_one_colour(inside, palette.FORBIDDEN, SURFACE, np.full(len(inside), -1)), *rim]
