"""Figures 1 and 2: a robot at rest and moved, and the contacts and pseudo contacts of one configuration."""

from __future__ import annotations

import math
from fractions import Fraction

from matplotlib.axes import Axes

from cfree import palette
from cfree.arguments import checked
from cfree.exact.pose import Pose
from cfree.figures.plane import (
    arc,
    arrow,
    corner_labels,
    dot,
    edge_label,
    frame,
    label,
    line,
    on_arc,
    placed,
    set_plane,
    shape,
)  # fmt: skip
from cfree.polygons.polygon import Polygon

ROBOT = Polygon([(1.6, 0.25), (0.5, 1.3), (-1.0, 0.85), (-1.15, -0.65), (0.55, -1.05)])
OBSTACLE = Polygon([(2.5, -1.6), (4.6, -1.9), (5.3, -0.75), (3.2, 0.05)])
MOVED = (4.35, 2.1, math.radians(50))


@checked
def rest_and_moved(ax: Axes) -> Axes:
    """Figure 1: the robot at rest and in a pose q = (r, theta), its local frame, one obstacle."""
    set_plane(ax, (-1.9, -2.4, 6.2, 4.0))
    a, b, q = ROBOT.vertices, OBSTACLE.vertices, placed(ROBOT.vertices, MOVED)
    shape(ax, a, palette.ROBOT, alpha=0.55)
    shape(ax, q, palette.ROBOT, palette.GHOST, alpha=0.55)
    shape(ax, b, palette.OBSTACLE)
    corner_labels(ax, a, ["$a_1$", "$a_2$", "$a_3$", "$a_4$", "$a_5$"])
    corner_labels(ax, q, [rf"$a_{k}(\mathbf{{q}})$" for k in range(1, 6)], 18)
    corner_labels(ax, b, ["$b_1$", "$b_2$", "$b_3$", "$b_4$"])
    edge_label(ax, a[2], a[3], "$E_3^A$", 14)
    edge_label(ax, b[1], b[2], "$E_2^{O_1}$", 16)
    for corner, turn, span, name in ((a[3], a, 3, r"$\rho_4$"), (b[3], b, 3, r"$\omega_4$")):
        after, before = turn[(span + 1) % len(turn)] - corner, turn[span - 1] - corner
        start = math.atan2(after[1], after[0])
        stop = start + (math.atan2(before[1], before[0]) - start) % math.tau
        arc(ax, corner, 0.36, (start, stop))
        label(ax, on_arc(corner, 0.58, (start + stop) / 2), name, size=12)
    # polar coordinates of a vertex
    line(ax, (0, 0), a[1], dashes=True)
    alpha = math.atan2(a[1, 1], a[1, 0])
    arc(ax, (0, 0), 0.45, (0, alpha))
    label(ax, on_arc((0, 0), 0.66, 0.66 * alpha), r"$\alpha_2$", size=12)
    label(ax, 0.75 * a[1], "$r_2$", (10, -3), size=12)
    # the pose
    x, y, theta = MOVED
    arrow(ax, (0, 0), (x, y), palette.GREY)
    label(ax, (0.52 * x, 0.52 * y), r"$\vec r$", (-6, 9))
    line(ax, (x, y), (x + 1.15, y), palette.GREY, dashes=True)
    arc(ax, (x, y), 0.62, (0, theta), palette.FRAME, tip=True)
    label(ax, on_arc((x, y), 0.84, theta / 2), r"$\theta$", colour=palette.FRAME)
    frame(ax, (0, 0, 0), 1.0, palette.FRAME)
    frame(ax, MOVED, 1.0, palette.FRAME)
    label(ax, (0, 0), "$R_0$", (-11, -8), palette.FRAME)
    label(ax, (x, y), r"$R_0(\mathbf{q})$", (17, -11), palette.FRAME)
    label(ax, (0.45, -0.55), r"$A(\mathbf{0})$", size=16, colour=palette.ROBOT)
    label(ax, (4.3, 1.4), r"$A(\mathbf{q})$", size=16, colour=palette.ROBOT)
    label(ax, (4.05, -1.05), "$O_1$", size=16, colour=palette.OBSTACLE)
    return ax


POSE = Pose(Fraction(1, 5), Fraction(1, 10), {"tau": "1/3"})
PLACED = [("-1.6", "-0.3"), ("0.2", "-1.5"), ("1.7", "-0.5"), ("1.3", "1.2"), ("-0.9", "1.4")]
FIVE = Polygon(POSE.inverse().apply_exact([(Fraction(x), Fraction(y)) for x, y in PLACED]))
O1 = Polygon([("-1.2", "-2.8"), ("1.4", "-3"), ("1.6", "-1.8"), ("-1.2", "-1.2")])
O2 = Polygon([("-0.4", "2.7"), ("-2.5", "0.7"), ("0.2", "1.3")])
O3 = Polygon([("1.3", "1.2"), ("1.7", "-0.5"), ("3.3", "-0.4"), ("3.1", "1.5")])


@checked
def contacts(ax: Axes) -> Axes:
    """Figure 2: one contact with O1, a pseudo contact with O2, and three contacts with O3, at once."""
    import shapely

    set_plane(ax, (-2.9, -3.2, 4.7, 3.1))
    q = POSE.apply(FIVE.vertices)
    b1, b2, b3 = O1.vertices, O2.vertices, O3.vertices
    for b in (b1, b2, b3):
        shape(ax, b, palette.OBSTACLE)
    shape(ax, q, palette.ROBOT, palette.GHOST, alpha=0.6)
    common = shapely.get_coordinates(shapely.intersection(shapely.Polygon(q), shapely.Polygon(b2)))
    ax.fill(*common.T, facecolor="none", edgecolor=palette.INK, hatch="////", linewidth=0, alpha=0.5, zorder=3)
    corner_labels(ax, q, ["$a_1$", "$a_2$", "", "", ""])
    for point, name, way in (
        (q[2], "$a_3$", (-12, 3)), (q[3], "$a_4$", (-10, -8)), (q[4], "$a_5$", (10, -10)),
        (b1[2], "$b_3$", (10, 4)), (b1[3], "$b_4$", (-9, 6)), (b2[2], "$b_3$", (7, 11)), (b2[0], "$b_1$", (6, 9)),
        (b2[1], "$b_2$", (-10, -4)), (b3[0], "$b_1$", (2, 12)), (b3[1], "$b_2$", (2, -12)),
    ):  # fmt: skip
        label(ax, point, name, way)
    for point in (q[1], b2[2], b3[0], b3[1]):
        dot(ax, point, palette.INK, 6.5)
    line(ax, b3[0], b3[1], palette.EDGE_EDGE, width=4)
    frame(ax, (float(POSE.x), float(POSE.y), POSE.theta), 0.7, palette.FRAME)
    label(ax, (float(POSE.x), float(POSE.y)), r"$R_0(\mathbf{q})$", (-4, -13), palette.FRAME)
    for place, name in (((0.2, -2.35), "$O_1$"), ((-0.85, 1.95), "$O_2$"), ((2.55, 0.75), "$O_3$")):
        label(ax, place, name, size=16, colour=palette.OBSTACLE)
    label(ax, (-0.75, -0.3), r"$A(\mathbf{q})$", size=16, colour=palette.ROBOT)
    notes = (
        ((3.05, -1.2), "contact", ["($v_2$-$e_3$)"], (2.4, -1.4), q[1]),
        ((1.15, 2.75), "pseudo contact", ["($e_4$-$v_3$)"], (0.75, 2.3), b2[2]),
        ((4.05, 0.95), "contacts", ["($v_4$-$v_1$)", "($e_3$-$e_1$)", "($v_3$-$v_2$)"], None, None),
    )
    for place, title, types, start, target in notes:
        label(ax, place, title, colour=palette.GREY, size=11)
        for k, text in enumerate(types):
            label(ax, place, text, (0, -16 - 17 * k), size=14)
        if start is not None and target is not None:
            line(ax, start, target, palette.GREY)
    return ax
