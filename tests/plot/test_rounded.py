"""Pictures of boundaries among rounded shapes."""

from __future__ import annotations

import numpy as np
import pytest

from cfree import Curved, Scene, boundary, free_space
from cfree.forbidden.kinds import PatchKind
from cfree.plot import plot_boundary, plot_overview, plot_slice
from cfree.plot.strips import CHORDS, strips
from cfree.viewer.pictures import picture

SCENE = Scene(
    Curved([(-1, -1), (2, 0), (0, 1)], grown="1/2"),
    [Curved.circle((4, 0), 1), Curved([(0, 4), (2, 4), (1, 6)], grown=1)],
)


def test_arcs_are_drawn_as_several_chords() -> None:
    result = boundary(SCENE)
    rows = strips(result, 0.1)
    on_circle = result.patch_kind[result.trapezoids.patch[rows.trapezoid]] == PatchKind.ARC_ARC
    assert np.isclose(rows.share[on_circle, 1] - rows.share[on_circle, 0], 1 / CHORDS).all()
    assert (rows.share[~on_circle] == (0, 1)).all()
    centre = result.ruled[result.trapezoids.patch[rows.trapezoid]]
    c, s = np.cos(rows.theta), np.sin(rows.theta)
    middle = centre[:, :2] - np.stack(
        (c * centre[:, 4] - s * centre[:, 5], s * centre[:, 4] + c * centre[:, 5]), axis=1
    )
    off = np.hypot(*(rows.points - middle[:, None]).transpose(2, 0, 1))
    radius = result.patch_radius[result.trapezoids.patch[rows.trapezoid]]
    assert np.allclose(off[on_circle], radius[on_circle, None])


@pytest.mark.slow
def test_boundary_slice_and_overview_of_rounded_shapes_are_drawn() -> None:
    result = boundary(SCENE)
    legend = [text.get_text() for text in plot_boundary(result).get_legend().get_texts()]
    assert legend[:4] == ["v-e patch", "e-v patch", "arc-arc patch", "joint"]
    assert "arc-arc" in plot_slice(result.slice(0)).get_legend_handles_labels()[1]
    plot_overview(result).canvas.draw()


def test_notebooks_show_boundaries_slices_and_cells_of_rounded_shapes() -> None:
    result = boundary(SCENE)
    for value in (result, result.slice("30deg"), free_space(result)):
        assert "<svg" in (picture(value) or "")
