"""Pictures of intersections: what is drawn lies on the surfaces, in their colours, where it is said to be."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from cfree import Polygon
from cfree.arrangements import intersection, triple
from cfree.contact import EdgeVertex, Surface, VertexEdge, contact_surface
from cfree.forbidden.kinds import COLOURS, PatchKind
from cfree.palette import INK
from cfree.plot import plot_intersection
from cfree.plot.pieces import Colours
from cfree.rational import rational_surface

ROBOT = Polygon([(-1, "-0.6"), ("1.2", "-0.4"), ("-0.3", 1)])
NEAR, FAR = Polygon([("-1.5", -1), ("1.6", "-0.7"), ("0.2", "1.4")]), Polygon([("0.4", "0.2"), (3, 1), ("1.5", "2.5")])
PAIR = contact_surface(ROBOT, NEAR, VertexEdge(1, 0)), contact_surface(ROBOT, FAR, EdgeVertex(0, 0))


def off(surface: Surface, points: np.ndarray) -> Any:
    """Distances of points (n, 3), theta in degrees, from the segments of a surface at their angles."""
    phi = np.radians(points[:, 2])
    start, stop = surface(0, phi)[:, :2], surface(1, phi)[:, :2]
    along = stop - start
    t = np.clip(((points[:, :2] - start) * along).sum(axis=1) / (along * along).sum(axis=1), 0, 1)
    return np.hypot(*(start + t[:, None] * along - points[:, :2]).T)


def artists(ax: Any) -> dict[str, Any]:
    """Lines by name, and the painted surfaces of each kind as (corners, colours)."""
    found: dict[str, Any] = {line.get_label(): line for line in ax.lines}
    for painting in ax.collections:
        pieces = painting._pieces
        is_warm = pieces.rgb[:, 0] > pieces.rgb[:, 2]
        for name, chosen in (("v-e", is_warm), ("e-v", ~is_warm)):
            if chosen.any():
                found[name] = pieces.corners[chosen], pieces.rgb[chosen]
    return found


def data(line: Any) -> np.ndarray:
    return np.column_stack(line.get_data_3d()).astype(float)


def test_surfaces_and_their_curve_are_drawn_where_they_are() -> None:
    found = intersection(*PAIR)
    drawn = artists(plot_intersection(found))
    assert set(drawn) == {"v-e", "e-v", "edges as lines", "curve on both"}
    for surface, name in zip(PAIR, ("v-e", "e-v"), strict=True):
        corners = drawn[name][0].reshape(-1, 3)
        assert off(surface, corners).max() < 1e-12 and corners[:, 2].min() == 0 and corners[:, 2].max() == 360
        kind = PatchKind.VERTEX_EDGE if name == "v-e" else PatchKind.EDGE_VERTEX
        shade = np.corrcoef(drawn[name][1].mean(axis=0), to_rgb(COLOURS[kind]))[0, 1]
        assert shade > 0.98
    (part,) = found.ranges
    curve = data(drawn["curve on both"])
    assert np.radians(curve[[0, -1], 2]) == pytest.approx(part.theta)
    assert max(off(surface, curve).max() for surface in PAIR) < 1e-9
    thin = data(drawn["edges as lines"])
    on_both = np.maximum(*(off(surface, thin) for surface in PAIR)) < 1e-9
    inside = [part.contains(float(phi)) for phi in np.radians(thin[:, 2])]
    seen = ~np.isnan(thin[:, 0])
    assert (on_both == inside)[seen].all() and 0 < on_both[seen].sum() < seen.sum()
    assert drawn["curve on both"].get_linewidth() > 2 * drawn["edges as lines"].get_linewidth()


def test_of_patches_nothing_else_is_drawn() -> None:
    patches = rational_surface(ROBOT, NEAR, VertexEdge(1, 0)), rational_surface(ROBOT, FAR, EdgeVertex(0, 0))
    drawn = artists(plot_intersection(intersection(*patches)))
    for patch, name in zip(patches, ("v-e", "e-v"), strict=True):
        assert patch.Phi is not None
        middle = np.radians(drawn[name][0][..., 2].mean(axis=1))
        assert all(patch.Phi.locate(math.tan(phi / 2)).value == "inside" for phi in middle.tolist())
        width = math.degrees(patch.Phi.end.theta - patch.Phi.start.theta) % 360
        assert np.ptp(drawn[name][0][..., 2], axis=1).sum() / 24 == pytest.approx(width)


def test_poses_on_three_surfaces_are_dots() -> None:
    robot, corner = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), Polygon([(0, 0), (9, 0), (0, 9)])
    slope = Polygon([(2, 0), (3, 3), (0, 2)])
    touched = (corner, 0, 0), (corner, 3, 2), (slope, 2, 2)
    found = triple(*(contact_surface(robot, O, VertexEdge(i, j)) for O, i, j in touched))
    ax = plot_intersection(found)
    drawn = artists(ax)
    assert data(drawn["three contacts"]) == pytest.approx(
        np.array([(0, 0, 0), (0.8, 0, 2 * math.degrees(math.atan(0.5)))])
    )
    assert "three, edges as lines" not in drawn and drawn["three contacts"].get_markerfacecolor() == INK
    names = [text.get_text() for text in ax.get_legend().get_texts()]
    assert names == ["v-e", "edges as lines", "curve on both", "three contacts"]
    others = triple(*PAIR, contact_surface(ROBOT, FAR, VertexEdge(2, 2)))
    assert others.poses and not others.contacts
    dots = artists(plot_intersection(others))["three, edges as lines"]
    assert data(dots)[:, :2] == pytest.approx(np.array([pose.xy for pose in others.poses]))
    assert dots.get_markerfacecolor() == "white"


def test_shared_lines_are_yellow() -> None:
    found = intersection(*(contact_surface(ROBOT, NEAR, c) for c in (VertexEdge(0, 0), EdgeVertex(0, 0))))
    ax = plot_intersection(found)
    yellow = [data(line) for line in ax.lines if line.get_color() == Colours.edge_edge]
    assert len(yellow) == len([line for line in found.lines if line.t_range]) == 2
    for line in yellow:
        assert max(off(surface, line).max() for surface in found.surfaces) < 1e-9 and np.ptp(line[:, 2]) == 0


def test_given_axes_are_used_and_everything_can_be_rendered() -> None:
    space = Figure().add_subplot(projection="3d")
    apart = intersection(*(contact_surface(ROBOT, NEAR, VertexEdge(1, 0)) for _ in range(2)))
    assert plot_intersection(apart, space) is space
    FigureCanvasAgg(space.figure).draw()
    assert (space.get_xlabel(), space.get_ylabel(), space.get_zlabel(), space.get_zlim()) == ("x", "y", "θ", (0, 360))
    with pytest.raises(TypeError, match="give an Axes3D or None"):
        plot_intersection(apart, Figure().add_subplot())  # type: ignore[arg-type]
