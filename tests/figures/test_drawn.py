"""What is drawn in the paper's figures is true: read back from the artists, their data and colours."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np
import pytest
import shapely
from matplotlib.axes import Axes
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Polygon as Outline

from cfree import Polygon, Pose, palette
from cfree.contact import (
    EdgeEdge,
    EdgeVertex,
    Surface,
    VertexEdge,
    VertexVertex,
    angle_range,
    contact_features,
    contact_helix,
    contact_segment,
    contact_surface,
    is_contact,
    is_forbidden,
)
from cfree.figures import curvature, curves, draw, plane, poses, ranges, scenes, surfaces
from cfree.figures.style import styled
from cfree.forbidden.boundary import boundary
from cfree.plot.depth_sort import Painting
from cfree.plot.pieces import CURVE, ON_TOP, SURFACE, Pieces
from cfree.scene.scene import Scene


@cache
def figure(number: int) -> Figure:
    with styled():
        return draw(number)


def axes(number: int) -> Any:
    return figure(number).axes[0]


def outlines(ax: Axes, colour: str) -> list[np.ndarray]:
    """Corners of the shapes drawn in a colour."""
    return [
        np.asarray(patch.get_xy())[:-1]
        for patch in ax.patches
        if isinstance(patch, Outline) and not patch.get_fill() and to_hex(patch.get_edgecolor()) == to_hex(colour)
    ]


def lines(ax: Axes, colour: str) -> list[np.ndarray]:
    """Points of the lines drawn in a colour; dots are none."""
    found = [np.asarray(line.get_xydata()) for line in ax.lines if to_hex(line.get_color()) == to_hex(colour)]
    return [points for points in found if len(points) > 1]


def named(ax: Axes) -> dict[str, np.ndarray]:
    """Where texts are put."""
    return {text.get_text(): np.array(text.xy) for text in ax.texts if hasattr(text, "xy")}


def pieces(number: int, k: int = 0) -> Pieces:
    """All that is painted on axes."""
    (painting,) = [c for c in figure(number).axes[k].collections if isinstance(c, Painting)]
    return painting._pieces


def strokes(number: int, colour: str, k: int = 0) -> np.ndarray:
    """Ends of the parts of curves painted in a colour, (n, 2, 3), theta in degrees."""
    found = pieces(number, k)
    return found.corners[(found.sort == CURVE) & (np.abs(found.rgb - to_rgb(colour)).max(axis=1) < 1e-12)][:, :2]


# figures 1 to 6, in the plane


def test_figure_1_obeys_the_papers_conventions() -> None:
    ax = axes(1)
    rest, moved = outlines(ax, palette.ROBOT)
    (obstacle,) = outlines(ax, palette.OBSTACLE)
    angles = np.mod(np.arctan2(*rest[:, ::-1].T), 2 * math.pi)
    assert (np.diff(angles) > 0).all() and Polygon(rest).is_convex
    assert Polygon(rest).to_shapely().contains(shapely.Point(0, 0))
    x, y, theta = poses.MOVED
    assert moved == pytest.approx(Pose(x, y, theta).apply(rest)) and obstacle.shape == (4, 2)
    names = named(ax)
    for k in range(5):
        assert names[f"$a_{k + 1}$"] == pytest.approx(rest[k])
        assert names[rf"$a_{k + 1}(\mathbf{{q}})$"] == pytest.approx(moved[k])
    assert names["$R_0$"] == pytest.approx((0, 0)) and names[r"$R_0(\mathbf{q})$"] == pytest.approx((x, y))


def test_figure_2_has_the_contacts_of_its_caption() -> None:
    ax, q = axes(2), poses.POSE
    first, second, third = outlines(ax, palette.OBSTACLE)
    (robot,) = outlines(ax, palette.ROBOT)
    shapes = poses.O1, poses.O2, poses.O3
    assert robot == pytest.approx(q.apply(poses.FIVE.vertices))
    for drawn, shape in zip((first, second, third), shapes, strict=True):
        assert drawn == pytest.approx(shape.vertices)
    # indices count from 0 here
    of = [contact_features(poses.FIVE, shape, q) for shape in shapes]
    assert of == [
        (VertexEdge(1, 2),), (EdgeVertex(3, 2),), (VertexVertex(2, 1), VertexVertex(3, 0), EdgeEdge(2, 0)),
    ]  # fmt: skip
    assert [is_contact(poses.FIVE, shape, q) for shape in shapes] == [True, False, True]
    assert is_forbidden(poses.FIVE, poses.O2, q)
    (yellow,) = lines(ax, palette.EDGE_EDGE)
    assert yellow == pytest.approx(third[:2])
    (hatched,) = [patch for patch in ax.patches if patch.get_hatch()]
    both = shapely.intersection(shapely.Polygon(robot), shapely.Polygon(second))
    assert shapely.Polygon(hatched.get_xy()).equals(both) and both.area > 0.05
    written = " ".join(text.get_text() for text in ax.texts)
    for name in ("($v_2$-$e_3$)", "($e_4$-$v_3$)", "($v_4$-$v_1$)", "($e_3$-$e_1$)", "($v_3$-$v_2$)"):
        assert name in written


@pytest.mark.parametrize(
    ("robot", "obstacle", "contact", "t"),
    [
        (ranges.ROBOT, ranges.GROUND, VertexEdge(0, 0), ranges.T0_VERTEX_EDGE),
        (ranges.LEVER, ranges.CORNER, EdgeVertex(0, 0), ranges.T0_EDGE_VERTEX),
    ],
)
def test_figures_3_and_4_show_contacts_between_their_angles_and_none_beyond(
    robot: Polygon, obstacle: Polygon, contact: VertexEdge | EdgeVertex, t: float
) -> None:
    found, S = angle_range(robot, obstacle, contact), contact_surface(robot, obstacle, contact)
    ax = axes(3 if isinstance(contact, VertexEdge) else 4)
    assert outlines(ax, palette.OBSTACLE)[0] == pytest.approx(obstacle.vertices)
    for phi, drawn in zip((found.phi_min, found.phi_max), outlines(ax, palette.ROBOT), strict=True):
        assert drawn == pytest.approx(plane.placed(robot.vertices, S(t, phi)))
    inside = np.linspace(found.phi_min + 0.01, found.phi_max - 0.01, 7).tolist()
    for phi in inside:
        assert is_contact(robot, obstacle, S.pose(Fraction(t), phi))
    for phi in (found.phi_min - 0.01, found.phi_max + 0.01):
        assert is_forbidden(robot, obstacle, S.pose(Fraction(t), phi))
    # the way of the reference point between both: dotted, about the point of contact
    (way,) = [points for points in lines(ax, palette.GREY) if len(points) > 2]
    on_it = np.array([S(t, phi)[:2] for phi in np.linspace(found.phi_min, found.phi_max, 400)])
    assert max(np.hypot(*(on_it - point).T).min() for point in way) < 0.02


def test_figure_3_shows_the_neighbours_on_the_line_of_the_edge() -> None:
    ax = axes(3)
    first, last = outlines(ax, palette.ROBOT)
    (ground,) = outlines(ax, palette.OBSTACLE)
    b, E = ground[0], ground[1] - ground[0]
    for corners, on_line, off in ((first, 1, 3), (last, 3, 1)):
        a = corners - b
        side = E[0] * a[:, 1] - E[1] * a[:, 0]
        assert side[[0, on_line]] == pytest.approx(0, abs=1e-12) and side[off] < -0.1
    found = angle_range(ranges.ROBOT, ranges.GROUND, VertexEdge(0, 0))
    assert found.phi_range == pytest.approx(math.pi - ranges.ROBOT.interior_angles[0])
    turned = [np.arctan2(*(corners[1] - corners[0])[::-1]) for corners in (first, last)]
    assert (turned[1] - turned[0]) % math.tau == pytest.approx(found.phi_range)


def test_figure_4_shows_the_ends_of_the_edge_on_the_lines_of_the_neighbours() -> None:
    ax = axes(4)
    first, last = outlines(ax, palette.ROBOT)
    (b,) = outlines(ax, palette.OBSTACLE)
    for corners, k, end in ((first, 1, b[3]), (last, 0, b[1])):
        a = corners[k] - b[0]
        assert a[0] * end[1] - a[1] * end[0] == pytest.approx(0, abs=1e-12) and a @ end > 0
    turned = [np.arctan2(*(corners[1] - corners[0])[::-1]) for corners in (first, last)]
    assert (turned[1] - turned[0]) % math.tau == pytest.approx(math.pi - ranges.CORNER.interior_angles[0])


def test_figure_5_keeps_two_vertices_together() -> None:
    contact = VertexVertex(0, 0)
    found, C = angle_range(curves.ROBOT, curves.CORNER, contact), contact_helix(curves.ROBOT, curves.CORNER, contact)
    rho, omega = curves.ROBOT.interior_angles[0], curves.CORNER.interior_angles[0]
    assert found.phi_range == pytest.approx(2 * math.pi - rho - omega)
    for phi in np.linspace(found.phi_min + 0.01, found.phi_max - 0.01, 7).tolist():
        assert contact_features(curves.ROBOT, curves.CORNER, C.pose(phi)) == (contact,)
        assert is_contact(curves.ROBOT, curves.CORNER, C.pose(phi))
    ax = axes(5)
    (corner,) = outlines(ax, palette.OBSTACLE)
    for phi, drawn in zip((found.phi_min, found.phi_max), outlines(ax, palette.ROBOT), strict=True):
        assert drawn[0] == pytest.approx(corner[0])
        assert drawn == pytest.approx(plane.placed(curves.ROBOT.vertices, C(phi)))
    (arc,) = [line.get_xydata() for line in ax.lines if line.get_linewidth() == 1.8]
    expected = C(np.linspace(found.phi_min, found.phi_max, 2000))[:, :2]
    assert arc[0] == pytest.approx(expected[0]) and math.dist(arc[-1], expected[-1]) < 0.15  # an arrow's head goes on
    assert max(np.hypot(*(expected - point).T).min() for point in arc) < 2e-3


def test_figure_6_keeps_edges_together_beyond_t_1() -> None:
    robot, obstacle = curves.SLIDER, curves.GROUND
    C = contact_segment(robot, obstacle, EdgeEdge(0, 0))
    end = Fraction(1) + Fraction(1.6) / 3
    assert C.t_range == (0.0, pytest.approx(float(end)))
    for t, kinds in (
        (Fraction(0), {VertexVertex(0, 0)}),
        (Fraction(1), {VertexVertex(0, 1), EdgeEdge(0, 0)}),
        (Fraction(5, 4), {EdgeEdge(0, 0)}),
    ):
        q = C.surface.pose(t, 0, beyond=True)
        assert is_contact(robot, obstacle, q)
        assert kinds <= set(contact_features(robot, obstacle, q))
    assert not contact_features(robot, obstacle, C.surface.pose(end + Fraction(1, 100), 0, beyond=True))
    ax = axes(6)
    for t, drawn in zip((0.0, 1.0, float(end)), outlines(ax, palette.ROBOT), strict=True):
        assert drawn == pytest.approx(plane.placed(robot.vertices, C(t)))
    solid, dashed = (line for line in ax.lines if to_hex(line.get_color()) == to_hex(palette.EDGE_EDGE))
    assert solid.get_xydata() == pytest.approx(C([0, 1])[:, :2]) and not solid.is_dashed()
    assert dashed.get_xydata() == pytest.approx(C([1, float(end)])[:, :2]) and dashed.is_dashed()


# figures 7 to 9: surfaces


@pytest.mark.parametrize(
    ("number", "contact", "colour"),
    [(7, VertexEdge(1, 0), palette.VERTEX_EDGE), (8, EdgeVertex(0, 1), palette.EDGE_VERTEX)],
)
def test_figures_7_and_8_draw_a_surface_its_helices_and_its_rulings(number: int, contact: Any, colour: str) -> None:
    S = contact_surface(surfaces.ROBOT, surfaces.OBSTACLE, contact)
    found = pieces(number)
    corners = found.corners[found.sort == SURFACE].reshape(-1, 3)
    t = on_surface(S, corners)
    assert t.min() == pytest.approx(0, abs=1e-9) and t.max() == pytest.approx(1)
    assert corners[:, 2].min() == 0 and corners[:, 2].max() == pytest.approx(360)
    faces = found.rgb[found.sort == SURFACE]
    assert np.corrcoef(faces.mean(axis=0), to_rgb(colour))[0, 1] > 0.95
    # helices: t is constant along each, and they go all the way up
    black = strokes(number, "black")
    ends = on_surface(S, black.reshape(-1, 3)).reshape(-1, 2)
    assert ends[:, 0] == pytest.approx(ends[:, 1], abs=1e-9)
    assert np.unique(ends.round(9)).tolist() == [0, 0.25, 0.5, 0.75, 1]
    assert np.ptp(black[..., 2], axis=1).sum() == pytest.approx(5 * 360)
    # rulings: level, and as long as the edge
    yellow = strokes(number, palette.EDGE_EDGE)
    edge = math.hypot(*S.ruled[2:4], *S.ruled[6:8])
    assert np.ptp(yellow[..., 2], axis=1).max() < 1e-9
    assert np.hypot(*(yellow[:, 1] - yellow[:, 0])[:, :2].T).sum() == pytest.approx(25 * edge)
    on_surface(S, yellow.reshape(-1, 3))


def on_surface(S: Surface, points: np.ndarray) -> np.ndarray:
    """t of points (n, 3) that are on a surface, theta in degrees."""
    phi = np.radians(points[:, 2])
    start, stop = S(0, phi)[:, :2], S(1, phi)[:, :2]
    along = stop - start
    t = ((points[:, :2] - start) * along).sum(axis=1) / (along * along).sum(axis=1)
    assert np.abs(start + t[:, None] * along - points[:, :2]).max() < 1e-9
    return t


def test_figure_9_draws_all_patches_helices_and_segments_of_two_triangles() -> None:
    A, O = surfaces.ROBOT, surfaces.OBSTACLE
    # each curve is painted with both patches beside it
    yellow = strokes(9, palette.EDGE_EDGE)
    lengths = np.add.outer(*(np.hypot(*shape.edges.T) for shape in (A, O)))
    assert np.hypot(*(yellow[:, 1] - yellow[:, 0])[:, :2].T).sum() == pytest.approx(2 * lengths.sum())
    heights = np.ptp(strokes(9, palette.HELIX)[..., 2], axis=1).sum()
    angles = np.add.outer(A.interior_angles, O.interior_angles)
    assert heights == pytest.approx(2 * np.degrees(2 * math.pi - angles).sum())
    # the robot touches the obstacle at the middle of every face
    found = pieces(9)
    middles = found.corners[found.sort == SURFACE][::40].mean(axis=1)
    for x, y, degrees in middles:
        placed = shapely.Polygon(plane.placed(A.vertices, (x, y, math.radians(degrees))))
        overlap = placed.intersection(O.to_shapely())
        assert placed.distance(O.to_shapely()) < 0.01 and overlap.area < 0.01


# figures 10 and 11: curvature


def test_figure_10_draws_the_directions_at_its_point() -> None:
    t0, phi0 = curvature.POINT
    scaled = [
        (np.column_stack(line.get_data_3d()) * (1, 1, math.pi / 180), to_hex(line.get_color()))
        for line in axes(10).lines
    ]
    p = curvature.SURFACE(t0, phi0)
    (dot,) = [points for points, _ in scaled if len(points) == 1]
    assert dot[0] == pytest.approx(p)
    N, curving = shape_at(curvature.SURFACE, t0, phi0)
    found: dict[str, list[Any]] = {}
    for points, colour in scaled:
        if len(points) == 2:
            assert points.mean(axis=0) == pytest.approx(p)
            along = points[1] - points[0]
            along /= np.linalg.norm(along)
            assert along @ N == pytest.approx(0, abs=1e-9)
            found.setdefault(colour, []).append((along, curving(along)))
    asymptotic, principal = found[to_hex(palette.FRAME)], found[to_hex(palette.VERTEX_EDGE)]
    assert [k for _, k in asymptotic] == pytest.approx([0, 0], abs=1e-4)
    (u, k1), (v, k2) = principal
    assert u @ v == pytest.approx(0, abs=1e-9)
    turns = [curving(math.cos(a) * u + math.sin(a) * v) for a in np.linspace(0, math.pi, 181)]
    assert {round(min(turns), 4), round(max(turns), 4)} == {round(k1, 4), round(k2, 4)}
    bisected = [abs(direction @ u) for direction, _ in asymptotic]
    assert bisected[0] == pytest.approx(bisected[1])  # principal directions halve the angles


def shape_at(S: Surface, t: float, phi: float, h: float = 1e-4) -> tuple[np.ndarray, Callable[[np.ndarray], float]]:
    """Unit normal, and the normal curvature in a direction, by finite differences."""
    at = lambda u, v: S(t + u * h, phi + v * h)  # noqa: E731
    first = (at(1, 0) - at(-1, 0)) / (2 * h), (at(0, 1) - at(0, -1)) / (2 * h)
    N = np.cross(*first)
    N /= np.linalg.norm(N)

    def curving(along: np.ndarray) -> float:
        u, v = np.linalg.lstsq(np.column_stack(first), along, rcond=None)[0]
        return float((at(u, v) - 2 * at(0, 0) + at(-u, -v)) @ N / h**2)

    return N, curving


def test_figure_11_draws_k_and_h_of_section_4() -> None:
    A = curvature.ROBOT.vertices
    a, g = A[0], A[1] - A[0]
    graph = figure(11).axes[-1]
    K, H = (line.get_xydata() for line in graph.lines[:2])
    assert [line.get_label() for line in graph.lines[:2]] == ["$K(t)$", "$H(t)$"]
    E, F = g @ g, a[0] * A[1][1] - a[1] * A[1][0]
    v2 = E * (1 + ((a + K[:, :1] * g) ** 2).sum(axis=1)) - F**2
    assert K[:, 1] == pytest.approx(-(E**2) / v2**2) and H[:, 1] == pytest.approx(E * F / (2 * v2**1.5))
    star = -(a @ g) / E
    assert graph.lines[2].get_xdata() == pytest.approx([star, star])
    assert K[K[:, 1].argmin(), 0] == pytest.approx(star, abs=3e-3)
    white = strokes(11, "white")
    assert on_surface(curvature.SURFACE, white.reshape(-1, 3)) == pytest.approx(star)


# figures 12 and 13


def test_figure_12_draws_five_obstacles_and_both_poses() -> None:
    plan, space = figure(12).axes
    drawn = outlines(plan, palette.OBSTACLE)
    assert len(drawn) == 5
    for corners, obstacle in zip(drawn, scenes.FIVE.obstacles, strict=True):
        assert corners == pytest.approx(obstacle.vertices)
    for corners, pose in zip(outlines(plan, palette.ROBOT), (scenes.FIVE.start, scenes.FIVE.goal), strict=True):
        assert pose is not None and corners == pytest.approx(pose.apply(scenes.FIVE.robot[0].vertices))
    assert space.get_zlim() == (0, 360) and len(strokes(12, palette.HELIX, 1)) > 100


def test_figure_13_draws_slices_at_equal_steps() -> None:
    stack, _ = figure(13).axes
    heights = [c._pieces.corners[..., 2] for c in stack.collections if isinstance(c, Painting)]
    levels = [float(z.min()) for z in heights]
    assert all(np.ptp(z) == 0 for z in heights) and levels == pytest.approx(np.linspace(0, 360, scenes.SLICES).tolist())


def test_slices_are_drawn_at_their_height_with_closed_rims() -> None:
    found = boundary(Scene(robot=surfaces.ROBOT, obstacles=surfaces.OBSTACLE), threads=1)
    inside, *rim = scenes.slice_pieces(found, 70.0)
    assert (inside.sort == SURFACE).all() and len(rim) == 6  # a hexagon
    points = np.concatenate([part.corners for part in rim])
    assert (points[..., 2] == 70).all() and all((part.sort == ON_TOP).all() for part in rim)
    assert np.abs((points[:, 1] - points[:, 0]).sum(axis=0)).max() < 1e-12
    cut = found.slice("70deg")
    p, q, r = (inside.corners[:, k, :2] for k in range(3))
    areas = 0.5 * ((q - p)[:, 0] * (r - p)[:, 1] - (q - p)[:, 1] * (r - p)[:, 0])
    assert areas.sum() == pytest.approx(cut.forbidden.area)


# figure 14


def test_figure_14_adds_up_to_eulers_number_in_every_metric() -> None:
    (ax,) = figure(14).axes
    *parts, total, zero = ax.lines
    assert [line.get_label() for line in parts] == ["at vertices", "on faces", "along edges"]
    values = np.array([line.get_ydata() for line in parts])
    np.testing.assert_allclose(values.sum(axis=0), total.get_ydata(), atol=1e-12)
    chi = int(boundary(scenes.FIVE).complex.euler.sum())
    np.testing.assert_allclose(total.get_ydata(), chi, atol=1e-8)
    assert str(chi) in total.get_label() and not np.any(zero.get_ydata())
    assert (values[1] < 0).all() and np.ptp(values[1]) > 1
