"""The figure of both models: same grid, labelled axes, the patch in its colour."""

from __future__ import annotations

import math

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb

from cfree.contact.contact import EdgeVertex, VertexEdge, angle_range
from cfree.contact.surface import contact_surface
from cfree.forbidden.kinds import COLOURS
from cfree.plot.rational import SHOWN, cells, plot_models
from cfree.polygons.polygon import Polygon
from cfree.rational.model import rational_range

A = Polygon([(-1, -1), (2, -1), (0, 2)])
O = Polygon([(3, 0), (6, 1), (4, 4)])
SQUARE = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])


def pixels(contact: VertexEdge | EdgeVertex) -> np.ndarray:
    canvas = FigureCanvasAgg(plot_models(A, O, contact))
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3] / 255


def test_axes_are_labelled_in_both_models() -> None:
    geometrical, rational = plot_models(A, O, EdgeVertex(1, 2)).axes
    for axes, name, limits in ((geometrical, "θ", (-180, 180)), (rational, "τ = tan(θ/2)", (-SHOWN, SHOWN))):
        assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_zlabel()) == ("x", "y", name)
        assert tuple(axes.get_zlim()) == limits
    assert "1 (90°)" in [label.get_text() for label in rational.get_zticklabels()]


@pytest.mark.slow
@pytest.mark.parametrize(("contact", "kind"), [(VertexEdge(1, 0), 1), (EdgeVertex(1, 2), 2)])
def test_both_halves_show_the_patch_in_its_colour(contact: VertexEdge | EdgeVertex, kind: int) -> None:
    image = pixels(contact)
    strongest = int(np.argmax(to_rgb(COLOURS[kind])))
    others = [k for k in range(3) if k != strongest]
    coloured = (image[..., [strongest]] > 1.5 * image[..., others]).all(axis=-1)
    half = image.shape[1] // 2
    assert coloured[:, :half].sum() > 3000 and coloured[:, half:].sum() > 3000


def test_cells_are_on_the_surface_and_the_patch_is_phi() -> None:
    S, Phi = contact_surface(A, O, VertexEdge(1, 0)), rational_range(A, O, VertexEdge(1, 0))
    outlines, on_patch = cells(S, Phi, 180)
    points = outlines.reshape(-1, 3)
    n = S.q
    d = (points[:, 0] - float(S.p[0])) * -float(n[1]) + (points[:, 1] - float(S.p[1])) * float(n[0])
    a = S.a
    c, s = np.cos(points[:, 2]), np.sin(points[:, 2])
    moved = -float(n[1]) * (c * float(a[0]) - s * float(a[1])) + float(n[0]) * (s * float(a[0]) + c * float(a[1]))
    np.testing.assert_allclose(d + moved, 0, atol=1e-12)  # a_i is on the line of E_j
    heights = np.ptp(outlines[..., 2], axis=1)
    assert heights[on_patch].sum() / 8 == pytest.approx(angle_range(A, O, VertexEdge(1, 0)).phi_range)
    assert heights.sum() / 8 == pytest.approx(math.tau)


def test_a_surface_without_width_is_drawn() -> None:
    # the reference point is the vertex: its helices are upright lines over the edge
    figure = plot_models(SQUARE, SQUARE, VertexEdge(0, 2))
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    image = np.asarray(canvas.buffer_rgba())[..., :3] / 255
    colour, half = to_rgb(COLOURS[1]), image.shape[1] // 2
    strongest = int(np.argmax(colour))
    others = [k for k in range(3) if k != strongest]
    coloured = (image[..., [strongest]] > 1.5 * image[..., others]).all(axis=-1)
    for k, axes in enumerate(figure.axes):
        (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
        assert x0 < 0 < 2 < x1 and y0 < 2 < y1 < 3  # what has no width gets a window that has
        shown = coloured[:, half * k : half * (k + 1)]
        assert shown.sum() > 100
    contact = VertexEdge(0, 2)
    S, Phi = contact_surface(SQUARE, SQUARE, contact), rational_range(SQUARE, SQUARE, contact)
    corners = cells(S, Phi, 180)[0].reshape(-1, 3)
    assert (corners[:, 1] == 2).all() and (corners[:, 0].min(), corners[:, 0].max()) == (0, 2)


def test_a_reflex_vertex_has_no_patch_to_show() -> None:
    corner = Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
    with pytest.raises(ValueError, match="never a contact"):
        plot_models(corner, SQUARE, VertexEdge(3, 0))
