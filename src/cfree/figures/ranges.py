"""Figures 3 and 4: the orientations of a v-e and of an e-v contact."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from cfree import palette
from cfree.arguments import checked
from cfree.contact.contact import AngleRange, EdgeVertex, VertexEdge, angle_range
from cfree.contact.surface import contact_surface
from cfree.figures.plane import (
    Floats,
    arc,
    dot,
    edge_label,
    frame,
    ghost,
    label,
    line,
    on_arc,
    placed,
    set_plane,
    shape,
)
from cfree.polygons.polygon import Polygon

# the contact of both figures: feature 0 with feature 0
ROBOT = Polygon([(-1.3, 0.05), (1.14, -0.84), (0.98, 0.18), (-0.3, 0.6)])
LEVER = Polygon([(-1.94, 0.23), (0.5, -0.66), (0.34, 0.36), (-0.94, 0.77)])
GROUND = Polygon([(3.05, 0.3), (-3.05, -0.3), (-2.5, -1.3), (2.6, -1.1)])
CORNER = Polygon([(0, 0), (0.8, -2.2), (2.9, -1.7), (3.2, 0.25)])
T0_VERTEX_EDGE, T0_EDGE_VERTEX = 0.5, 0.22


@checked
def vertex_edge_range(ax: Axes) -> Axes:
    """Figure 3: a_i stays at P on E_j while the robot turns from phi_min to phi_max."""
    contact = VertexEdge(0, 0)
    angles, S = angle_range(ROBOT, GROUND, contact), contact_surface(ROBOT, GROUND, contact)
    set_plane(ax, (-3.8, -1.55, 3.8, 2.7))
    low, high = S(T0_VERTEX_EDGE, angles.phi_min), S(T0_VERTEX_EDGE, angles.phi_max)
    middle = S(T0_VERTEX_EDGE, angles.phi_min + angles.phi_range / 2)
    first, last = placed(ROBOT.vertices, low), placed(ROBOT.vertices, high)
    b, P = GROUND.vertices, first[0]
    shape(ax, b, palette.OBSTACLE)
    _poses(ax, first, placed(ROBOT.vertices, middle), last)
    along = math.atan2(*(b[0] - b[1])[::-1])  # direction of -E_j
    line(ax, on_arc(P, -3.7, along), on_arc(P, 3.7, along), dashes=True)
    _range_at(ax, P, 0.7, along, angles.phi_range)
    inner = (along + angles.phi_range, along + math.pi)
    arc(ax, P, 0.85, inner)
    label(ax, on_arc(P, 1.08, sum(inner) / 2), r"$\rho_i$")
    _turn(ax, P, low, high, angles)
    dot(ax, P, palette.INK, 6.5)
    label(ax, P, r"$P = a_i$", (4, -13))
    for corners, k, name, way in (
        (first, 1, r"$a_{i+1}$", (2, -13)), (first, 3, r"$a_{i-1}$", (7, -11)),
        (last, 1, r"$a_{i+1}$", (-4, 12)), (last, 3, r"$a_{i-1}$", (0, -13)),
        (b, 0, "$b_j$", (10, -10)), (b, 1, "$b_{j+1}$", (-14, -8)),
    ):  # fmt: skip
        label(ax, corners[k], name, way)
    label(ax, 0.82 * b[1] + 0.18 * b[0], "$E_j^O$", (-2, -15))
    label(ax, (0.3, -0.85), "$O$", size=16, colour=palette.OBSTACLE)
    _names(ax, (3.0, 1.35), (-3.0, 1.95))
    return ax


@checked
def edge_vertex_range(ax: Axes) -> Axes:
    """Figure 4: a point of E_i stays at b_j while the robot turns from phi_min to phi_max."""
    contact = EdgeVertex(0, 0)
    angles, S = angle_range(LEVER, CORNER, contact), contact_surface(LEVER, CORNER, contact)
    set_plane(ax, (-3.1, -2.6, 3.9, 2.3))
    low, high = S(T0_EDGE_VERTEX, angles.phi_min), S(T0_EDGE_VERTEX, angles.phi_max)
    middle = S(T0_EDGE_VERTEX, angles.phi_min + angles.phi_range / 2)
    first, last = placed(LEVER.vertices, low), placed(LEVER.vertices, high)
    b = CORNER.vertices
    shape(ax, b, palette.OBSTACLE)
    _poses(ax, first, placed(LEVER.vertices, middle), last)
    along = math.atan2(*(b[-1] - b[0])[::-1])  # direction of -E_{j-1}
    line(ax, on_arc(b[0], 2.2, along + math.pi), b[0], dashes=True)
    line(ax, on_arc(b[0], 2.3, along + angles.phi_range), b[0], dashes=True)
    _range_at(ax, b[0], 0.5, along, angles.phi_range)
    inner = (along + angles.phi_range - math.pi, along)
    arc(ax, b[0], 0.5, inner)
    label(ax, on_arc(b[0], 0.75, sum(inner) / 2), r"$\omega_j$")
    _turn(ax, b[0], low, high, angles)
    dot(ax, b[0], palette.INK, 6.5)
    for corners, k, name, way in (
        (first, 0, "$a_i$", (-11, -2)), (first, 1, r"$a_{i+1}$", (6, -13)),
        (last, 0, "$a_i$", (-11, -4)), (last, 1, r"$a_{i+1}$", (16, 4)), (b, 0, "$b_j$", (-11, -9)),
        (b, 3, "$b_{j-1}$", (14, 8)), (b, 1, "$b_{j+1}$", (-4, -12)),
    ):  # fmt: skip
        label(ax, corners[k], name, way)
    edge_label(ax, b[3], b[0], "$E_{j-1}^O$", -16, at=0.2)
    edge_label(ax, b[0], b[1], "$E_j^O$", 16, at=0.75)
    label(ax, (2.0, -1.0), "$O$", size=16, colour=palette.OBSTACLE)
    _names(ax, (3.0, 1.35), (-2.2, 1.8))
    return ax


def _names(ax: Axes, first: tuple[float, float], last: tuple[float, float]) -> None:
    """Write the names of the first and the last pose."""
    for place, end in ((first, "min"), (last, "max")):
        label(ax, place, rf"$A(\mathbf{{q}}_i(\phi_{{\{end}}}))$", size=14, colour=palette.ROBOT)


def _poses(ax: Axes, first: Floats, middle: Floats, last: Floats) -> None:
    """Draw the first pose dark, the last one light, and between them a ghost in the middle of the range."""
    ghost(ax, middle)
    shape(ax, first, palette.ROBOT, alpha=0.55)
    shape(ax, last, palette.ROBOT, palette.GHOST, alpha=0.6)


def _range_at(ax: Axes, centre: Floats, radius: float, along: float, width: float) -> None:
    arc(ax, centre, radius, (along, along + width), palette.FRAME, tip=True, width=1.6)
    label(ax, on_arc(centre, radius + 0.28, along + 0.5 * width), r"$\phi_{\mathrm{range}}$", colour=palette.FRAME)


def _turn(ax: Axes, centre: Floats, low: Floats, high: Floats, angles: AngleRange) -> None:
    """Draw the reference point's arc about the centre, and phi_min and phi_max at its ends."""
    offset = low[:2] - centre
    start = math.atan2(offset[1], offset[0])
    radius = float(np.hypot(*offset))
    arc(ax, centre, radius, (start, start + angles.phi_range), palette.GREY, fill=False, tip=True, dotted=True)
    for q, name in ((low, r"$\phi_{\min}$"), (high, r"$\phi_{\max}$")):
        turn = float(q[2]) % math.tau
        line(ax, q[:2], np.add(q[:2], (0.75, 0)), palette.GREY, dashes=True)
        frame(ax, q, 0.55, palette.FRAME)
        arc(ax, q[:2], 0.38, (0, turn), palette.FRAME)
        label(ax, on_arc(q[:2], 0.85 if turn < 1 else 0.58, turn / 2), name, colour=palette.FRAME, size=12)
