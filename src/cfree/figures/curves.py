"""Figures 5 and 6: motions that keep a contact: v-v while the robot turns, e-e while it slides."""

from __future__ import annotations

import math

from matplotlib.axes import Axes

from cfree import palette
from cfree.arguments import checked
from cfree.contact.contact import EdgeEdge, VertexVertex, angle_range
from cfree.contact.surface import contact_helix, contact_segment
from cfree.figures.plane import arc, arrow, dot, label, line, on_arc, placed, set_plane, shape
from cfree.polygons.polygon import Polygon

ROBOT = Polygon([(-1.3, 0.05), (1.14, -0.84), (0.98, 0.18), (-0.3, 0.6)])
CORNER = Polygon([(0, 0), (-1.5, -1.9), (0.9, -2.5), (2.5, -1.3)])
SLIDER = Polygon([(-0.75, -0.5), (0.85, -0.5), (0.6, 0.45), (-0.35, 0.75)])
GROUND = Polygon([(3.0, 0), (0.0, 0), (0.25, -0.9), (2.8, -0.9)])


@checked
def vertex_vertex(ax: Axes) -> Axes:
    """Figure 5: a_i stays at b_j while the robot turns from phi_min to phi_max."""
    contact = VertexVertex(0, 0)
    angles, C = angle_range(ROBOT, CORNER, contact), contact_helix(ROBOT, CORNER, contact)
    set_plane(ax, (-3.4, -2.75, 3.7, 2.2))
    low, high = C(angles.phi_min), C(angles.phi_max)
    first, last = placed(ROBOT.vertices, low), placed(ROBOT.vertices, high)
    b = CORNER.vertices
    shape(ax, b, palette.OBSTACLE)
    shape(ax, first, palette.ROBOT, alpha=0.5)
    shape(ax, last, palette.ROBOT, palette.GHOST, alpha=0.5)
    along, width = math.atan2(*(b[-1] - b[0])[::-1]), angles.phi_range
    rho, omega = float(ROBOT.interior_angles[0]), float(CORNER.interior_angles[0])
    arc(ax, b[0], 0.7, (along, along + width), palette.FRAME, tip=True, width=1.6)
    label(ax, on_arc(b[0], 1.0, along + 0.62 * width), r"$\phi_{\mathrm{range}}$", colour=palette.FRAME)
    arc(ax, b[0], 0.85, (along + width, along + width + rho))
    label(ax, on_arc(b[0], 1.1, along + width + rho / 2), r"$\rho_i$")
    arc(ax, b[0], 0.5, (along - omega, along))
    label(ax, on_arc(b[0], 0.75, along - omega / 2), r"$\omega_j$")
    start = math.atan2(low[1], low[0])
    arc(ax, b[0], math.hypot(*low[:2]), (start, start + width), palette.HELIX, fill=False, tip=True, width=1.8)
    label(ax, on_arc(b[0], 1.62, start + 0.47 * width), r"$C(\phi)$", colour=palette.HELIX, size=14)
    for q, name, way in ((low, r"$C(\phi_{\min})$", (25, 10)), (high, r"$C(\phi_{\max})$", (-27, -6))):
        dot(ax, q[:2], palette.HELIX, 6)
        label(ax, q[:2], name, way, palette.HELIX, 12)
    dot(ax, b[0], palette.INK, 6.5)
    for corners, k, name, point in (
        (first, 1, r"$a_{i+1}$", (16, 6)), (first, 3, r"$a_{i-1}$", (6, -13)),
        (last, 1, r"$a_{i+1}$", (-8, 11)), (last, 3, r"$a_{i-1}$", (4, -13)),
        (b, 0, "$a_i = b_j$", (-2, 15)), (b, 3, "$b_{j-1}$", (14, -6)), (b, 1, "$b_{j+1}$", (-12, -10)),
    ):  # fmt: skip
        label(ax, corners[k], name, point)
    label(ax, (0.5, -1.6), "$O$", size=16, colour=palette.OBSTACLE)
    return ax


@checked
def edge_edge(ax: Axes) -> Axes:
    """Figure 6: E_i slides along E_j; at t = 1 the vertex a_i has reached its end, and the contact goes on."""
    C = contact_segment(SLIDER, GROUND, EdgeEdge(0, 0))
    end = C.t_range[1]
    set_plane(ax, (-2.6, -1.9, 4.9, 1.85))
    b, E = GROUND.vertices, GROUND.edge(0)
    shape(ax, b, palette.OBSTACLE)
    for t, name in ((0.0, "$C(0)$"), (1.0, "$C(1)$"), (end, "")):
        q = placed(SLIDER.vertices, C(t))
        shape(ax, q, palette.ROBOT, palette.GHOST, alpha=0.5 if t <= 1 else 0.2)
        dot(ax, q[0], palette.INK, 6)
        label(ax, C(t)[:2], name, (0, 14), size=12)
        label(ax, q[0], "$a_i$", (9, 11))
        label(ax, q[1], r"$a_{i+1}$", (-15, 11))
    low, one, high = C(0.0)[:2], C(1.0)[:2], C(end)[:2]
    line(ax, low, one, palette.EDGE_EDGE, width=3.5)
    line(ax, one, high, palette.EDGE_EDGE, width=3.5, dashes=True)
    for point in (low, one, high):
        dot(ax, point, palette.INK, 6)
    label(ax, high, r"$C(1 + \|E_i^A\| / \|E_j^O\|)$", (-4, 62), size=12)
    label(ax, b[0], "$b_j$", (-11, -10))
    label(ax, b[1], "$b_{j+1}$", (19, -10))
    label(ax, (1.5, -0.22), "$E_j^O$")
    label(ax, (1.5, -0.65), "$O$", size=16, colour=palette.OBSTACLE)
    # where a_i is
    for t, u, name in ((0.0, 1.0, r"$0 \leq t \leq 1$"), (1.0, end, r"$1 \leq t \leq 1 + \|E_i^A\| / \|E_j^O\|$")):
        start, stop = (b[0] + s * E - (0, 1.3) for s in (t, u))
        arrow(ax, start, stop, palette.GREY)
        label(ax, 0.5 * (start + stop), name, (0, -13), size=12)
    for t in (0.0, 1.0, end):
        line(ax, b[0] + t * E - (0, 0.12), b[0] + t * E - (0, 1.4), palette.GREY, width=0.7, dashes=True)
    return ax
