"""Figures 21 to 23, contacts of arcs: a disc among polygons, a rounded pillar, curvature of an arc on an arc."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from matplotlib import colormaps
from matplotlib.axes import Axes
from mpl_toolkits.mplot3d.axes3d import Axes3D

from cfree.arguments import checked
from cfree.contact.arcs import (
    ArcArc,
    ArcArcSurface,
    ArcContact,
    ArcEdge,
    EdgeArc,
    Shape,
    arc_contacts,
    arc_range,
    arc_surface,
)
from cfree.contact.features import shape_features
from cfree.curves.curved import Curved
from cfree.curves.rings import Arc
from cfree.exact.pose import Pose
from cfree.figures.pillars import SCALE, WINDOW
from cfree.figures.plane import dot, label, line, set_plane, shape
from cfree.figures.space import Floats, curve, draw_frame, legend, paint, set_space, sheet
from cfree.figures.surfaces import OTHER
from cfree.geometry.arcs import arc_geometry, parabolic_angles, zero_mean_angles
from cfree.palette import (
    ARC_ARC,
    DIVERGING,
    EDGE_EDGE,
    EDGE_VERTEX,
    FORBIDDEN,
    FRAME,
    GREY,
    HELIX,
    INK,
    OBSTACLE,
    PATH,
    ROBOT,
    VERTEX_EDGE,
)
from cfree.plot.pieces import SECTION, Pieces, level, of_one_colour
from cfree.polygons.polygon import Polygon

STEP = math.radians(4)
ACROSS = 9  # points across a patch
SIDES = 48  # of an arc
CLOSE = 1e-9
COLOURS = {ArcEdge: VERTEX_EDGE, EdgeArc: EDGE_VERTEX, ArcArc: ARC_ARC}


# patches of a convex pair


def pillar_pieces(robot: Shape, obstacle: Shape, angle_scale: float, width: float = 1.8) -> list[Pieces]:
    """Make the pieces of all contact patches of a convex pair, their helices and segments, and its section."""
    parts: list[Pieces] = []
    for contact in arc_contacts(robot, obstacle):
        for points in patch_grids(robot, obstacle, contact):
            parts.append(sheet(points, COLOURS[type(contact)], angle_scale))
            parts += [curve(below_the_top(points[:, end]), HELIX, width) for end in (0, -1)]
    parts += [curve(points, EDGE_EDGE, 2.4) for points in segments(robot, obstacle)]
    a, o = outline(robot), outline(obstacle)
    region = shapely.MultiPoint((o[:, None] - a[None]).reshape(-1, 2)).convex_hull
    corners = level(region, 360.0)
    return [*parts, of_one_colour(corners, FORBIDDEN, SECTION, np.full(len(corners), -1))]


def below_the_top(points: Floats) -> Floats:
    """Leave out the last bit of a curve to theta = 2 pi: behind the section it would stand out as a dot."""
    kept = points.copy()
    if kept[-1, 2] > math.tau - CLOSE:
        kept[-1] = kept[-2] + 0.2 * (kept[-1] - kept[-2])
    return kept


def patch_grids(robot: Shape, obstacle: Shape, contact: ArcContact) -> Iterator[Floats]:
    """Grids (angles, across, 3) of points of a patch, cut where theta is a full turn."""
    S, Phi = arc_surface(robot, obstacle, contact), arc_range(robot, obstacle, contact)
    low, high, bends = Phi.phi_min, Phi.phi_max, [math.tau, 2 * math.tau]
    if isinstance(S, ArcArcSurface):
        turns = S.robot.width, S.obstacle.width
        if math.tau in turns:  # a whole circle has all orientations alike
            low, high = 0.0, math.tau
        else:
            high = low + sum(turns)
            bends += [low + turn for turn in turns]
    cuts = [low, *sorted(bend for bend in bends if low + CLOSE < bend < high - CLOSE), high]
    sweep = S.obstacle.width if isinstance(S, ArcArcSurface) else 0.0
    across = np.linspace(0, 1, max(ACROSS, 1 + math.ceil(sweep / (2 * STEP))))
    for start, stop in pairwise(cuts):
        phi = np.linspace(start, stop, 2 + math.ceil((stop - start) / STEP))[:, None]
        if isinstance(S, ArcArcSurface):
            first, last = _normals(S, phi, low)
            points = S(first + across * (last - first), phi)
        else:
            points = S(across, phi)
        yield points - (0, 0, math.tau * math.floor((start + CLOSE) / math.tau))


def _normals(S: ArcArcSurface, phi: Floats, low: float) -> tuple[Floats, Floats]:
    """First and last psi of the contact at angles phi, of which low is the least of the parallelogram."""
    first, last = S.obstacle.first + np.zeros_like(phi), S.obstacle.first + S.obstacle.width + np.zeros_like(phi)
    if S.robot.is_whole:
        return first, last
    if S.obstacle.is_whole:
        start = phi - math.pi + S.robot.first
        return start, start + S.robot.width
    # psi + pi - phi is the last angle of the robot's cone at the least phi, and the first at the greatest
    start = first + phi - low - S.robot.width
    return np.clip(start, first, last), np.clip(start + S.robot.width, first, last)


def segments(robot: Shape, obstacle: Shape) -> Iterator[Floats]:
    """End points (2, 3) of the e-e segments of a convex pair."""
    for own in shape_features(robot).edges:
        for edge in shape_features(obstacle).edges:
            (x, y), (u, v) = own.along, edge.along
            phi = (
                math.atan2(float(y * u - x * v), float(-x * u - y * v)) % math.tau
            )  # brings own to the opposite of edge
            a = complex(*map(float, own.start)) * np.exp(1j * phi)
            b, along = complex(*map(float, edge.start)), complex(*map(float, edge.along))
            start = b - a - 1j * along / edge.length * float(own.offset + edge.offset)
            stop = start + along * (1 + own.length / edge.length)
            yield np.array([(place.real, place.imag, phi) for place in (start, stop)])


def outline(of_shape: Shape) -> Floats:
    """Points of the rim of a shape of one ring, (n, 2)."""
    return shape_features(of_shape).rims(SIDES - 1)[0]


# figure 21


RADIUS = "0.55"
DISC = Curved.circle(("0.75", "0.25"), RADIUS)
"""A disc that turns about a point beside it."""
AMONG = (
    Polygon([("-0.3", "0.1"), ("1.8", "-0.3"), ("1.1", "1.3")]),
    Polygon([("4.5", "-0.6"), ("6.0", "0.2"), ("5.6", "1.6"), ("4.3", "1.2")]),
    Polygon([("2.2", "3.6"), ("3.5", "3.5"), ("4.4", "4.5"), ("3.3", "5.4"), ("1.9", "4.9")]),
)
TOUCHING = ((ArcEdge(0, 3), 1, (0.5, math.radians(60))), (ArcArc(0, 0), 2, (math.radians(235), math.radians(-30))))
"""Two contacts of the disc, each with its obstacle and its place on the surface."""
ROOM = (-2.1, -2.3, 7.5, 7.0)


@checked
def disc_among_polygons(ax: Axes) -> Axes:
    """Figure 21: three polygons, the disc in two contacts, and where its centre touches: the polygons grown."""
    set_plane(ax, (-1.0, -1.4, 6.7, 6.1))
    for k, obstacle in enumerate(AMONG):
        shape(ax, obstacle.vertices, OBSTACLE)
        label(ax, obstacle.vertices.mean(axis=0), f"$O_{k + 1}$", colour=OBSTACLE, size=14)
        rim = outline(Curved(obstacle.exact_vertices, grown=RADIUS))
        ax.plot(*np.concatenate([rim, rim[:1]]).T, color=GREY, linewidth=1.1, linestyle=(0, (4, 3)), zorder=3)
    for contact, k, place in TOUCHING:
        x, y, theta = arc_surface(DISC, AMONG[k], contact)(*place).tolist()
        at = Pose(x, y, theta)
        (centre,) = at.apply(np.array([shape_features(DISC).arcs[0].centre], float))
        shape(ax, at.apply(outline(DISC)), ROBOT)
        line(ax, (x, y), centre, FRAME, width=1.2)
        dot(ax, centre, ROBOT, 5)
        dot(ax, (x, y), FRAME, 7)
        label(ax, (x, y), "$R_0$", (0, -14), FRAME)
        dot(ax, contact_point(contact, k, place), COLOURS[type(contact)], 9)
    return ax


@checked
def disc_pillars(ax: Axes3D) -> Axes3D:
    """Figure 21: all contact patches of the disc and the three polygons."""
    set_space(ax, ROOM, angle_scale=1.25, view=(30.0, -62.0), zoom=1.06)
    draw_frame(ax, 2)
    parts = [piece for obstacle in AMONG for piece in pillar_pieces(DISC, obstacle, 1.25, 1.3)]
    paint(ax, parts)
    legend(ax, [
        (VERTEX_EDGE, "arc on edge"), (ARC_ARC, "arc on vertex"), ("-" + HELIX, "helices"),
        (FORBIDDEN, r"section at $\theta = 2\pi$"),
    ])  # fmt: skip
    return ax


def contact_point(contact: ArcContact, k: int, place: tuple[float, float]) -> Floats:
    """Return the point at which the disc touches obstacle k."""
    features = shape_features(AMONG[k])
    if isinstance(contact, ArcEdge):
        edge = features.edges[contact.j]
        return np.array(edge.start, float) + place[0] * np.array(edge.along, float)
    return np.array(features.arcs[contact.j].centre, float)


# figure 22


ROUND = Curved([("-0.4", "-0.4"), ("0.4", "-0.4"), ("0.4", "0.4"), ("-0.4", "0.4")], grown="0.55")
"""A square with rounded corners."""


@checked
def rounded_pillar(ax: Axes3D) -> Axes3D:
    """Figure 22: all contact patches of a rounded square and the triangle of figure 9."""
    set_space(ax, WINDOW, angle_scale=SCALE, zoom=1.02)
    draw_frame(ax)
    paint(ax, pillar_pieces(ROUND, OTHER, SCALE))
    legend(ax, [
        (VERTEX_EDGE, "arc on edge"), (EDGE_VERTEX, "edge on vertex"), (ARC_ARC, "arc on vertex"),
        ("-" + HELIX, "helices"), ("-" + EDGE_EDGE, "e-e segments"), (FORBIDDEN, r"section at $\theta = 2\pi$"),
    ], columns=3)  # fmt: skip
    return ax


@checked
def rounded_workspace(ax: Axes) -> Axes:
    """Figure 22: the rounded square and the triangle."""
    set_plane(ax, (-1.7, -1.6, 5.8, 2.1))
    rim, b = outline(ROUND), OTHER.vertices + np.array([3.6, 0.1])
    shape(ax, rim, ROBOT)
    shape(ax, b, OBSTACLE)
    for corner in np.array(ROUND.path, float):
        dot(ax, corner, ROBOT, 4)
    for place, colour, name in ((rim.mean(axis=0), ROBOT, "A"), (b.mean(axis=0), OBSTACLE, "O")):
        label(ax, place, f"${name}$", size=15, colour=colour)
    return ax


# figure 23


HEAD = Curved([("0.2", 0), Arc(("2.2", 0), center=("1.2", 0)), ("2.2", 1), ("0.2", 1)])
BLOCK = Curved([("-1.6", 0), Arc(("1.6", 0), center=(0, 0)), ("1.6", 1), ("-1.6", 1)])
PAIR = next(
    ArcArcSurface(ArcArc(i, j), a, o)
    for i, a in enumerate(shape_features(HEAD).arcs)
    for j, o in enumerate(shape_features(BLOCK).arcs)
    if a.signed_square and o.signed_square
)
"""The surface of two arcs with radii 1 and 1.6 and |a| = 1.2, so that H = 0 on two curves."""
MOST = 0.5  # greatest Gaussian curvature shown
PALE = 0.62  # share of white beside the patch
DASHES = 30


@checked
def arc_curvature(ax: Axes3D) -> Axes3D:
    """Figure 23: K on the surface of an arc on an arc, its parabolic curves, those of H = 0, and its patch."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    psi, phi = np.linspace(0, math.tau, 121), np.linspace(0, math.tau, 121)
    points = PAIR(psi, phi[:, None])
    side = float(np.abs(points[..., :2]).max()) + 0.15
    set_space(ax, (-side, -side, side, side), angle_scale=1.0, view=(22.0, -58.0), zoom=1.05)
    draw_frame(ax, 2)
    middle = (psi[1:] + psi[:-1]) / 2
    K = arc_geometry(PAIR.circular, middle, (phi[1:, None] + phi[:-1, None]) / 2).gaussian_curvature
    norm, scale = Normalize(-MOST, MOST), colormaps[DIVERGING]
    nu = middle + math.pi - (phi[1:, None] + phi[:-1, None]) / 2
    inside = np.ones(K.shape, dtype=bool)
    for arc, angles in ((PAIR.obstacle, middle), (PAIR.robot, nu)):
        inside &= np.mod(angles - arc.first, math.tau) < arc.width
    rgb = scale(norm(K))[..., :3]
    parts = [sheet(points, np.where(inside[..., None], rgb, PALE + (1 - PALE) * rgb), 1.0)]
    parts += [curve(PAIR(phi + chi, phi), INK, 2.2) for chi in parabolic_angles(PAIR)]
    for chi in zero_mean_angles(PAIR):
        for start in np.linspace(0, math.tau, DASHES, endpoint=False):
            dash = start + np.linspace(0, 0.5 * math.tau / DASHES, 4)
            parts.append(curve(PAIR(dash + chi, dash), INK, 2.2))
    for grid in patch_grids(HEAD, BLOCK, PAIR.contact):
        parts += [curve(grid[:, end], PATH, 3.2) for end in (0, -1)]
    paint(ax, parts)
    bar: Any = ax.figure.colorbar(ScalarMappable(norm, scale), ax=ax, shrink=0.5, aspect=28, pad=0.03)
    bar.ax.set_title("$K$", fontsize=13, pad=8)
    bar.outline.set_visible(False)
    legend(ax, [("-" + INK, "$K = 0$"), ("-" + INK, "$H = 0$"), ("-" + PATH, "the patch of two arcs")], columns=3)
    ax.get_legend().get_lines()[1].set_linestyle((0, (1.6, 1.0)))
    return ax


@checked
def arc_curvature_around(ax: Axes) -> Axes:
    """Figure 23: K and H over the angle delta between the normal and the robot's centre."""
    delta = np.linspace(-math.pi, math.pi, 721)
    forms = arc_geometry(PAIR.circular, delta, 0.0)
    ax.plot(delta, forms.gaussian_curvature, color=INK, label="$K$")
    ax.plot(delta, forms.mean_curvature, color=INK, linestyle="--", label="$H$")
    ax.axhline(0, color=GREY, linewidth=0.8)
    first = PAIR.robot.first - math.pi - math.atan2(float(PAIR.a[1]), float(PAIR.a[0]))
    ax.axvspan(first, first + PAIR.robot.width, color=PATH, alpha=0.09, linewidth=0)
    for angle in (-math.pi / 2, math.pi / 2):
        ax.axvline(angle, color=GREY, linewidth=0.8, linestyle=":")
    ax.set(xlabel=r"$\delta = \psi - \varphi - \arg \alpha$", xlim=(-math.pi, math.pi))
    ax.set_xticks(
        [-math.pi, -math.pi / 2, 0, math.pi / 2, math.pi],
        [r"$-\pi$", r"$-\frac{\pi}{2}$", "$0$", r"$\frac{\pi}{2}$", r"$\pi$"],
    )
    ax.spines[["top", "right"]].set_visible(False)
    for place, name in ((-0.75 * math.pi, "elliptic"), (0, "hyperbolic"), (0.75 * math.pi, "elliptic")):
        ax.text(
            place, 1.02, name, transform=ax.get_xaxis_transform(), ha="center", va="bottom", fontsize=10, color=GREY
        )
    ax.legend(loc="lower center", frameon=False, fontsize=11)
    return ax
