"""The picture of an unrolled patch."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

from cfree.contact.contact import EdgeVertex, VertexEdge, angle_range
from cfree.contact.surface import contact_surface
from cfree.geometry.integrals import patch_areas
from cfree.plot.development import plot_development
from cfree.polygons.polygon import Polygon

ROBOT, OBSTACLE = Polygon([(0, 0), (1, 0), (0, 1)]), Polygon([(3, 3), (5, 3), (5, 5), (3, 5)])


def test_an_unrolled_patch_has_its_area() -> None:
    contact = VertexEdge(1, 2)
    ax = plot_development(ROBOT, OBSTACLE, contact, angle_scale=0.5)
    ax.figure.canvas.draw()
    (outline,) = ax.patches
    x, y = outline.get_xy().T
    S, Phi = contact_surface(ROBOT, OBSTACLE, contact), angle_range(ROBOT, OBSTACLE, contact)
    expected = patch_areas(S.ruled, Phi.phi_min, Phi.phi_range, angle_scale=0.5)
    assert abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2 == pytest.approx(float(expected), rel=1e-3)
    assert "(v1 - e2)" in ax.get_title() and ax.get_aspect() == 1


def test_given_axes_are_used_and_e_v_contacts_refused() -> None:
    given = Figure().add_subplot()
    assert plot_development(ROBOT, OBSTACLE, VertexEdge(0, 0), ax=given) is given
    with pytest.raises(TypeError, match="give a VertexEdge"):
        plot_development(ROBOT, OBSTACLE, EdgeVertex(1, 2))
