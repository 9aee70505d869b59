"""The paper's figures: what they show is true, their labels are legible, their files are whole."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.text import Text
from mpl_toolkits.mplot3d import proj3d
from mpl_toolkits.mplot3d.art3d import Text3D

from cfree import Polygon, Pose, load_scene
from cfree.contact import contact_features, is_contact, is_forbidden
from cfree.contact.contact import EdgeEdge, EdgeVertex, VertexEdge, VertexVertex, angle_range
from cfree.contact.surface import contact_helix, contact_segment, contact_surface
from cfree.figures import FIGURES, curves, draw, draw_all, plane, poses, ranges, scenes, surfaces
from cfree.figures.style import FORMATS, PAPER, SAFE, Palette, styled, write
from cfree.forbidden.boundary import boundary
from cfree.plot.pieces import ON_TOP, SURFACE
from cfree.scene.scene import Scene

NUMBERS = [entry.number for entry in FIGURES]


@pytest.fixture(scope="module")
def drawn() -> dict[int, Figure]:
    with styled():
        return {number: draw(number) for number in NUMBERS}


# files


@pytest.mark.slow
def test_all_figures_are_written_in_all_formats(tmp_path: Path) -> None:
    shares: list[float] = []
    files = draw_all(tmp_path / "a" / "b", progress=shares.append)
    assert len(files) == len(FIGURES) * len(FORMATS) and all(file.stat().st_size > 3000 for file in files)
    assert sorted(files) == sorted((tmp_path / "a" / "b").iterdir())
    assert shares[0] == 0 and shares[-1] == 1 and shares == sorted(shares)
    starts = {".png": b"\x89PNG", ".pdf": b"%PDF", ".svg": b"<?xml"}
    assert all(file.read_bytes().startswith(starts[file.suffix]) for file in files)


@pytest.mark.slow
def test_files_have_the_same_bytes_each_time(tmp_path: Path) -> None:
    first, second = (draw_all(tmp_path / name, only=[5]) for name in "ab")
    assert [file.read_bytes() for file in first] == [file.read_bytes() for file in second]


def test_a_figure_that_cannot_be_written_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (file,) = draw_all(tmp_path, only=[6], formats=["png"])
    before = file.read_bytes()

    def fail(*_: Any, **__: Any) -> None:
        raise OSError("full")

    monkeypatch.setattr(Figure, "savefig", fail)
    with pytest.raises(OSError, match="full"):
        draw_all(tmp_path, only=[6], formats=["png"])
    assert file.read_bytes() == before and list(tmp_path.iterdir()) == [file]


def test_the_gallery_shows_all_figures(request: pytest.FixtureRequest) -> None:
    docs = request.config.rootpath / "docs"
    page = (docs / "figures.md").read_text()
    for entry in FIGURES:
        image = docs / "images" / "figures" / f"{entry.stem}.png"
        assert f"images/figures/{image.name}" in page and 5_000 < image.stat().st_size < 200_000


# legibility


@pytest.mark.slow
@pytest.mark.parametrize("number", NUMBERS)
def test_labels_are_on_the_page_and_do_not_overlap(number: int, drawn: dict[int, Figure]) -> None:
    figure = drawn[number]
    with styled():
        figure.canvas.draw()
    boxes = {}
    for text in texts(figure):
        box = text.get_window_extent()
        boxes[text.get_text(), round(box.x0), round(box.y0)] = box
        assert box.x0 >= 0 and box.y0 >= 0, text
        assert box.x1 <= figure.bbox.width and box.y1 <= figure.bbox.height, text
    assert len(boxes) >= 4
    for (name, one), (other, two) in combinations(boxes.items(), 2):
        width = min(one.x1, two.x1) - max(one.x0, two.x0)
        height = min(one.y1, two.y1) - max(one.y0, two.y0)
        assert width <= 1 or height <= 1, (name, other)


def texts(figure: Figure) -> Iterator[Text]:
    """Text that is seen; that in space is put where it is projected to."""
    for text in figure.findobj(Text):
        if isinstance(text, Text3D):
            x, y, _ = proj3d.proj_transform(*text.get_position_3d(), text.axes.M)
            Text.set_position(text, (x, y))
        on_axes = text.axes is not None and not text.axes.axison and text not in text.axes.texts
        if text.get_text() and text.get_visible() and not on_axes:
            yield text


@pytest.mark.parametrize("deficiency", ["protanopia", "deuteranopia"])
def test_safe_colours_stay_apart_for_eyes_that_lack_a_cone(deficiency: str) -> None:
    groups = [
        ("vertex_edge", "edge_vertex", "helix", "edge_edge"), ("robot", "obstacle", "frame"),
        ("robot_moved", "obstacle"), ("asymptotic", "principal"),
    ]  # fmt: skip

    def least(palette: Palette) -> float:
        return min(
            math.dist(seen(getattr(palette, one), deficiency), seen(getattr(palette, other), deficiency))
            for group in groups
            for one, other in combinations(group, 2)
        )

    assert least(SAFE) > 25
    assert least(SAFE) > least(PAPER)


def seen(colour: str, deficiency: str) -> tuple[float, float, float]:
    """L*a*b* of a colour as simulated by the matrices of Machado, Oliveira and Fernandes (2009), severity 1."""
    matrices = {
        "protanopia": [
            [0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998],
        ],
        "deuteranopia": [
            [0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881],
        ],
    }  # fmt: skip
    rgb = np.array(to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    linear = (np.array(matrices[deficiency]) @ linear).clip(0, 1)
    to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    ratio = (np.array(to_xyz) @ linear) / (0.9505, 1.0, 1.089)
    f = np.where(ratio > 0.008856, np.cbrt(ratio), 7.787 * ratio + 16 / 116)
    return float(116 * f[1] - 16), float(500 * (f[0] - f[1])), float(200 * (f[1] - f[2]))


# what is drawn is true


def test_figure_1_obeys_the_papers_conventions() -> None:
    angles = np.mod(np.arctan2(*poses.ROBOT.vertices[:, ::-1].T), 2 * math.pi)
    assert (np.diff(angles) > 0).all() and poses.ROBOT.is_convex
    assert poses.ROBOT.to_shapely().covers(Polygon([(0, 0), ("0.01", 0), (0, "0.01")]).to_shapely())
    x, y, theta = poses.MOVED
    assert plane.placed(poses.ROBOT.vertices, poses.MOVED) == pytest.approx(
        Pose(x, y, theta).apply(poses.ROBOT.vertices)
    )


def test_figure_2_has_the_contacts_of_its_caption() -> None:
    A, q = poses.FIVE, poses.POSE
    # indices count from 0 here
    assert contact_features(A, poses.O1, q) == (VertexEdge(1, 2),)
    assert is_contact(A, poses.O1, q)
    assert contact_features(A, poses.O2, q) == (EdgeVertex(3, 2),)
    assert is_forbidden(A, poses.O2, q) and not is_contact(A, poses.O2, q)
    assert contact_features(A, poses.O3, q) == (VertexVertex(2, 1), VertexVertex(3, 0), EdgeEdge(2, 0))
    assert is_contact(A, poses.O3, q)


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
    inside = np.linspace(found.phi_min + 0.01, found.phi_max - 0.01, 7).tolist()
    for phi in inside:
        assert is_contact(robot, obstacle, S.pose(Fraction(t), phi))
    for phi in (found.phi_min - 0.01, found.phi_max + 0.01):
        assert is_forbidden(robot, obstacle, S.pose(Fraction(t), phi))


def test_figure_3_shows_the_neighbours_on_the_line_of_the_edge() -> None:
    found = angle_range(ranges.ROBOT, ranges.GROUND, VertexEdge(0, 0))
    S = contact_surface(ranges.ROBOT, ranges.GROUND, VertexEdge(0, 0))
    b, E = ranges.GROUND.vertices[0], ranges.GROUND.edge(0)
    for phi, on_line, off in ((found.phi_min, 1, 3), (found.phi_max, 3, 1)):
        a = plane.placed(ranges.ROBOT.vertices, S(ranges.T0_VERTEX_EDGE, phi)) - b
        side = E[0] * a[:, 1] - E[1] * a[:, 0]
        assert side[[0, on_line]] == pytest.approx(0, abs=1e-12) and side[off] < -0.1
    assert found.phi_range == pytest.approx(math.pi - ranges.ROBOT.interior_angles[0])


def test_figure_4_shows_the_ends_of_the_edge_on_the_lines_of_the_neighbours() -> None:
    found = angle_range(ranges.LEVER, ranges.CORNER, EdgeVertex(0, 0))
    S = contact_surface(ranges.LEVER, ranges.CORNER, EdgeVertex(0, 0))
    b = ranges.CORNER.vertices
    for phi, k, end in ((found.phi_min, 1, b[3]), (found.phi_max, 0, b[1])):
        a = plane.placed(ranges.LEVER.vertices, S(ranges.T0_EDGE_VERTEX, phi))[k]
        assert a[0] * end[1] - a[1] * end[0] == pytest.approx(0, abs=1e-12) and a @ end > 0
    assert found.phi_range == pytest.approx(math.pi - ranges.CORNER.interior_angles[0])


def test_figure_5_keeps_two_vertices_together() -> None:
    contact = VertexVertex(0, 0)
    found, C = (
        angle_range(curves.ROBOT, curves.CORNER, contact),
        contact_helix(curves.ROBOT, curves.CORNER, contact),
    )
    rho, omega = curves.ROBOT.interior_angles[0], curves.CORNER.interior_angles[0]
    assert found.phi_range == pytest.approx(2 * math.pi - rho - omega)
    for phi in np.linspace(found.phi_min + 0.01, found.phi_max - 0.01, 7).tolist():
        assert contact_features(curves.ROBOT, curves.CORNER, C.pose(phi)) == (contact,)
        assert is_contact(curves.ROBOT, curves.CORNER, C.pose(phi))


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


def test_the_triangles_and_the_five_obstacles_are_those_of_the_examples() -> None:
    fig9, five = (load_scene(f"examples/scenes/{name}.json") for name in ("paper_fig9", "five_convex"))
    assert (fig9.robot, fig9.obstacles) == ((surfaces.ROBOT,), (surfaces.OBSTACLE,))
    assert (scenes.FIVE.robot, scenes.FIVE.obstacles) == (five.robot, five.obstacles)
    assert (scenes.FIVE.start, scenes.FIVE.goal) == (five.start, five.goal)


# slices


def test_slices_are_drawn_at_their_height_with_closed_rims() -> None:
    found = boundary(Scene(robot=surfaces.ROBOT, obstacles=surfaces.OBSTACLE), threads=1)
    inside, *rim = scenes.slice_pieces(found, 70.0, PAPER)
    assert (inside.sort == SURFACE).all() and len(rim) == 6  # a hexagon
    points = np.concatenate([part.corners for part in rim])
    assert (points[..., 2] == 70).all() and all((part.sort == ON_TOP).all() for part in rim)
    assert np.abs((points[:, 1] - points[:, 0]).sum(axis=0)).max() < 1e-12
    cut = found.slice("70deg")
    p, q, r = (inside.corners[:, k, :2] for k in range(3))
    areas = 0.5 * ((q - p)[:, 0] * (r - p)[:, 1] - (q - p)[:, 1] * (r - p)[:, 0])
    assert areas.sum() == pytest.approx(cut.forbidden.area)


def test_drawing_leaves_the_settings_of_matplotlib_alone(tmp_path: Path) -> None:
    from matplotlib import rcParams

    before = json.dumps({key: str(value) for key, value in rcParams.items()})
    with styled():
        write(draw(1), tmp_path / "one.svg")
    assert json.dumps({key: str(value) for key, value in rcParams.items()}) == before
