"""Faces and curves in depth order: what is hidden is not seen, whoever draws."""

from __future__ import annotations

import importlib.util
import sys
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from cfree.errors import UnsupportedError
from cfree.figures import draw_all
from cfree.figures.space import curve, paint, set_space, sheet
from cfree.plot.depth_sort import Painting
from cfree.plot.rendered import MISSING, best_renderer
from cfree.plot.visible import PARTS, depth_buffer, polylines, seen_parts


@given(st.integers(0, 10_000))
@settings(max_examples=30, deadline=None)
def test_the_buffer_holds_the_least_depth_of_what_covers_a_cell(seed: int) -> None:
    random = np.random.default_rng(seed)
    triangles = random.uniform(-3, 13, (6, 3, 3))
    buffer = depth_buffer(triangles, np.array([0.0, 0.0]), 1.0, (10, 9))
    for row, column in random.integers(0, (10, 9), (20, 2)):
        point, depths = np.array([column + 0.5, row + 0.5]), []
        for triangle in triangles:
            matrix = np.vstack((triangle[:, :2].T, np.ones(3)))
            share = np.linalg.solve(matrix, (*point, 1))
            if (share >= 0).all():
                depths.append(float(share @ triangle[:, 2]))
        assert buffer[row, column] == pytest.approx(min(depths, default=np.inf))


def test_a_curve_is_seen_beside_a_face_and_in_front_of_it_and_not_behind() -> None:
    face = np.array([[(0.3, -1, 0), (0.7, -1, 0), (0.7, 1, 0), (0.3, 1, 0)]], dtype=float)
    steps = np.linspace(0, 1, 101)
    for depth, expected in ((-1.0, 1.0), (1.0, 0.6), (0.0, 1.0)):  # in front, behind, on the face
        points = np.column_stack((steps, 0 * steps, depth + 0 * steps))
        parts, seen = seen_parts(np.stack((points[:-1], points[1:]), axis=1), face)
        assert len(parts) == 100 * PARTS and seen.mean() == pytest.approx(expected, abs=0.01)
        lines, looks = polylines(parts, seen, np.zeros(len(parts), int))
        assert len(lines) == len(looks) == (2 if depth > 0 else 1)
        ends = sorted(float(x) for line in lines for x in line[[0, -1], 0])
        assert ends == pytest.approx([0, 0.3, 0.7, 1] if depth > 0 else [0, 1], abs=0.01)


def test_short_gaps_of_one_curve_are_closed_and_curves_stay_apart() -> None:
    x = np.arange(41.0)
    points = np.column_stack((x, 0 * x, 0 * x))
    parts = np.stack((points[:-1], points[1:]), axis=1)
    seen = np.ones(40, bool)
    seen[10:12] = False  # rounding
    seen[20:30] = False  # behind something
    lines, _ = polylines(parts, seen, np.zeros(40, int))
    assert [(line[0, 0], line[-1, 0]) for line in lines] == [(0, 20), (30, 40)]
    look = np.repeat([0, 1], 20)
    lines, looks = polylines(parts, np.ones(40, bool), look)
    assert looks == [0, 1] and [(line[0, 0], line[-1, 0]) for line in lines] == [(0, 20), (20, 40)]


def test_nothing_is_drawn_of_nothing() -> None:
    assert polylines(np.empty((0, 2, 3)), np.empty(0, bool), np.empty(0, int)) == ([], [])
    parts, seen = seen_parts(np.empty((0, 2, 3)), np.empty((0, 4, 3)))
    assert len(parts) == len(seen) == 0


# on axes


RED, BLUE = "#ff0000", "#0000ff"


def crossing(renderer: Any) -> Figure:
    """Two squares that go through each other, and a line below one of them: seen at its ends alone."""
    figure = Figure(figsize=(4, 4), facecolor="white")
    FigureCanvasAgg(figure)
    ax: Any = figure.add_axes((0, 0, 1, 1), projection="3d")
    set_space(ax, (-2, -2, 2, 2), angle_scale=1.0, view=(50.0, -60.0))
    u = np.linspace(-1, 1, 25)
    flat = np.stack(np.meshgrid(u, u), axis=-1)
    level = np.concatenate((flat, np.full((25, 25, 1), 3.0)), axis=-1)
    upright = np.stack((flat[..., 0], 0 * flat[..., 0], 3.0 + flat[..., 1]), axis=-1)
    behind = np.column_stack((np.linspace(-2, 2, 81), np.full(81, 0.9), np.full(81, 2.0)))
    paint(ax, [sheet(level, RED, 1.0), sheet(upright, BLUE, 1.0), curve(behind, "#00ff00", 3.0)], renderer=renderer)
    return figure


def pixels(figure: Figure) -> np.ndarray:
    figure.canvas.draw()
    canvas: Any = figure.canvas
    return np.asarray(canvas.buffer_rgba())[..., :3].astype(float)


def test_faces_that_cross_hide_half_of_each_other() -> None:
    figure = crossing("matplotlib")
    image = pixels(figure)
    (painting,) = figure.findobj(Painting)
    assert len(painting.get_facecolor()) == 2 * 24 * 24  # one side of each
    # on the ray to a place, the nearer surface is seen: places of both squares, before and behind the other one
    for place, is_red in (((0.0, -0.6, 3.0), True), ((0.0, 0.0, 3.6), False), ((0.0, 0.0, 2.4), True)):
        x, y = project(painting, place)
        colour = image[-1 - round(y), round(x)]
        assert (colour[0] > colour[2]) == is_red, place
    green = (image[..., 1] > 1.5 * image[..., 0]) & (image[..., 1] > 1.5 * image[..., 2])
    columns = np.flatnonzero(green.any(axis=0))
    assert np.ptp(columns) > 80 and (np.diff(columns) > 20).sum() == 1  # hidden between its two ends


def project(painting: Painting, place: tuple[float, float, float]) -> tuple[float, float]:
    """Pixels of a place, theta in radians."""
    from mpl_toolkits.mplot3d import proj3d

    axes: Any = painting.axes
    x, y, _ = proj3d.proj_transform(place[0], place[1], np.degrees(place[2]), axes.M)
    pixel = axes.transData.transform((float(x), float(y)))
    return float(pixel[0]), float(pixel[1])


@pytest.mark.slow
def test_both_renderers_draw_the_same() -> None:
    pytest.importorskip("pyvista", reason="the extra `render` is not installed")
    first, second = (pixels(crossing(renderer)) for renderer in ("matplotlib", "pyvista"))
    assert (np.abs(first - second).max(axis=-1) > 60).mean() < 0.01
    assert (first < 250).any(axis=-1).mean() > 0.03


def test_a_renderer_that_cannot_be_imported_is_not_chosen(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "pyvista.py").write_text("raise ImportError('libGL.so.1: cannot open shared object file')")
    for name in [name for name in sys.modules if name.partition(".")[0] == "pyvista"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.syspath_prepend(tmp_path)
    assert best_renderer() == "matplotlib"


def test_a_missing_renderer_is_named_in_one_line(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    found = importlib.util.find_spec
    monkeypatch.setattr("cfree.plot.rendered.find_spec", lambda name: None if name == "pyvista" else found(name))
    assert best_renderer() == "matplotlib"
    with pytest.raises(UnsupportedError, match=r"pip install 'cfree\[render\]'") as caught:
        draw_all(tmp_path / "none", only=[8], renderer="pyvista")
    assert "\n" not in str(caught.value) == MISSING and not (tmp_path / "none").exists()
