"""Pictures of boundaries among rounded shapes."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import shapely

from cfree import Curved, Pose, Scene, Separated, boundary, free_space, load, save
from cfree.forbidden.kinds import PatchKind
from cfree.planning.options import Options
from cfree.planning.rounded_cells import round_cells
from cfree.plot import plot_boundary, plot_overview, plot_slice
from cfree.plot.answer import around_surface, surface_of
from cfree.plot.answer import picture as picture_of
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


HALL = [(0, 0), (12, 0), (12, 6), (0, 6)]
POSTS = [(6, 1), (6, 3), (6, 5)]
DISC = Scene(Curved.circle((0, 0), 1), [Curved.circle(at, 1) for at in POSTS], workspace=HALL)
BAR = Scene([(-1, -1), (1, -1), (1, 1), (-1, 1)], [[(5, 0), (7, 0), (7, 4), (5, 4)]], workspace=HALL)


@pytest.mark.parametrize(("scene", "clearance"), [(DISC, None), (BAR, "1/2")], ids=["discs", "a clearance of polygons"])
def test_the_surface_of_a_proof_by_round_contacts_is_made_of_contacts(
    scene: Scene, clearance: str | None, tmp_path: Path
) -> None:
    options = Options(clearance=Fraction(clearance or 0))
    cells = round_cells(scene, options)
    proof = None if cells is None else cells.proof(Pose(2, 3), Pose(10, 3))
    assert isinstance(proof, Separated) and proof.rounded is not None
    save(proof, tmp_path / "proof.json")
    held = shapely.union_all([shapely.LinearRing(HALL), *(o.to_shapely() for o in scene.outer(1e-3).obstacles)])
    robot = scene.outer(1e-3).robot[0].vertices
    for answer in (proof, load(tmp_path / "proof.json")):
        rows = strips(surface_of(answer, scene), 0.5)
        for ends, theta in zip(rows.points[::7], rows.theta[::7], strict=True):
            for x, y in ends:
                placed = shapely.Polygon(Pose(x, y, theta).apply(robot))
                assert placed.distance(held) == pytest.approx(float(options.clearance), abs=3e-3)
        x0, _, x1, _ = around_surface(surface_of(answer, scene), 0.0)
        assert x1 < 6 or x0 > 6  # around one of the two rooms
    assert len(picture_of(proof, scene).axes) == 2
