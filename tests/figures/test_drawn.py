"""What is drawn in the paper's figures is true: read back from the artists, their data and colours."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
import shapely
from matplotlib.colors import to_hex

from cfree import Polygon, Pose, palette
from cfree.contact import (
    EdgeEdge,
    EdgeVertex,
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
from cfree.figures import curves, plane, poses, ranges
from drawn import axes, lines, named, outlines

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
    (ghost,) = [np.asarray(patch.get_xy())[:-1] for patch in ax.patches if patch.get_label() == "ghost"]
    assert ghost == pytest.approx(plane.placed(robot.vertices, S(t, (found.phi_min + found.phi_max) / 2)))
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
