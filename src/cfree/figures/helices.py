"""Figure 16, Remark 2: infinitely many helices through every pose, one for each point that may stay."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from mpl_toolkits.mplot3d.axes3d import Axes3D

from cfree import palette
from cfree.arguments import checked
from cfree.contact.surface import Helix, helix_through
from cfree.exact.pose import Pose
from cfree.figures.plane import arc, dot, frame, label, set_plane, shape
from cfree.figures.space import around, curve, draw_frame, mark, note, paint, set_space
from cfree.palette import CATEGORIES, FRAME, INK, paler
from cfree.polygons.polygon import Polygon

ROBOT = Polygon([("1.1", "-0.7"), ("0.9", "0.8"), ("-0.9", "0.7"), ("-1.1", "-0.6")])
POSE = Pose(1, "0.5", "150deg")
FIXED = [("1.1", "-0.7"), ("0.9", "0.8"), ("-1.1", "-0.6"), ("0", "-1.5"), ("-1.8", "0.6")]
"""Centres of the turns: points of the robot, and two beside it."""
COLOURS = (CATEGORIES[0], CATEGORIES[1], CATEGORIES[2], CATEGORIES[3], CATEGORIES[5])


def _helices() -> list[tuple[Helix, str]]:
    return [(helix_through(POSE, point), colour) for point, colour in zip(FIXED, COLOURS, strict=True)]


@checked
def helices_through_a_pose(ax: Axes3D) -> Axes3D:
    """Figure 16: five helices through one pose q, each the turning about a point of the robot."""
    theta = np.linspace(0, math.tau, 241)
    lines = [(helix(theta), colour) for helix, colour in _helices()]
    set_space(ax, around(np.array([points for points, _ in lines]), 0.3), angle_scale=0.75)
    draw_frame(ax)
    shadows = [curve(points * (1, 1, 0), paler(colour, 0.5), 1.2) for points, colour in lines]
    paint(ax, [*shadows, *(curve(points, colour, 2.4) for points, colour in lines)])
    q = np.array([float(POSE.x), float(POSE.y), POSE.theta])
    mark(ax, q, size=9)
    note(ax, q + np.array([0.45, 0, 0.3]), r"$\mathbf{q}$", size=16)
    return ax


@checked
def turns_about_points(ax: Axes) -> Axes:
    """Figure 16: the robot in that pose, the points, and the circles of the reference point about them."""
    corners = POSE.apply(ROBOT.vertices)
    shape(ax, corners, palette.ROBOT)
    x, y = float(POSE.x), float(POSE.y)
    points = []
    for helix, colour in _helices():
        px, py = map(float, helix.centre)
        arc(ax, (px, py), helix.radius, (0, math.tau), colour, fill=False, width=1.6)
        dot(ax, (px, py), colour, 9)
        points += [(px - helix.radius, py - helix.radius), (px + helix.radius, py + helix.radius)]
    frame(ax, (x, y, POSE.theta), 0.7, FRAME)
    label(ax, (x, y), r"$R_0(\mathbf{q})$", (20, 12), INK, 13)
    (x0, y0), (x1, y1) = np.min(points, axis=0) - 0.2, np.max(points, axis=0) + 0.2
    set_plane(ax, (x0, y0, x1, y1))
    return ax
