"""Frames of films: legible, without texts that touch; trails, swept patches, separations and turntables."""

import math
from collections.abc import Iterator
from pathlib import Path as FilePath
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import shapely
from matplotlib.text import Text
from PIL import Image

import cfree
from cfree.collision.pose_checker import is_free
from cfree.exact.pose import Poses
from cfree.film.box import Box
from cfree.film.camera import Camera
from cfree.film.frame import Stage
from cfree.film.montage import shots_of, views
from cfree.film.path_film import PathStage
from cfree.film.separation_film import answer_of, separation_film
from cfree.film.space import STAYS, _within
from cfree.film.turntable import ALL_AROUND, Turntable
from cfree.forbidden.boundary import Boundary, boundary
from cfree.formats.scene_file import load_scene
from cfree.paths.path import Path
from cfree.plot.path import Track
from cfree.scene.scene import Scene, with_ends
from overlaps import touching
from questions_of_all_sorts import scenes

SMALL = 640, 360
HALL, WALL = [(0, 0), (9, 0), (9, 3), (0, 3)], [(4, -1), (5, -1), (5, 4)]


@pytest.fixture(scope="module")
def five() -> Boundary:
    return boundary(load_scene("examples/scenes/five_convex.json"))


@pytest.fixture(scope="module")
def hall() -> Boundary:
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    return boundary(Scene(square, [WALL], workspace=HALL, start=(1, 1, 0), goal=(7, 1, 0), units="corridor widths"))


def some_frames(stage: Stage, shots: list, count: int = 6) -> Iterator[None]:  # type: ignore[type-arg]
    """Draws a few views of a film."""
    seen = [view for view, _ in views(stage, shots, 4)]
    for k in np.linspace(0, len(seen) - 1, count).astype(int).tolist():
        stage.draw(seen[k])
        yield


@pytest.mark.slow
@pytest.mark.long
def test_no_text_of_a_film_touches_another(five: Boundary, hall: Boundary) -> None:
    gap = boundary(load_scene("examples/scenes/round_gap.json"))
    ours, theirs = (shots_of([one], 60, "paper")[0] for one in (five, gap))
    films = [
        (Stage(five, SMALL, 4), ours),
        (Stage(gap, SMALL, 4), theirs),
        separation_film(hall, answer_of(hall), 12, SMALL, 4),
        separation_film(gap, answer_of(gap), 12, SMALL, 4),
    ]
    for stage, chosen in films:
        for _ in some_frames(stage, chosen):
            assert list(touching(stage.figure)) == []
    table = Turntable(hall, SMALL)
    for azimuth in (-1.0, 0.6, 2.2, 3.8):
        table.draw(azimuth)
        assert list(touching(table.figure)) == [], azimuth


@pytest.mark.slow
@pytest.mark.parametrize("seed", [6, 7, 8])
def test_no_text_of_the_film_of_a_path_touches_another(seed: int) -> None:
    for scene, start, goal in scenes(seed, 4):
        path = cfree.plan(scene, start, goal)
        if isinstance(path, Path):
            stage = PathStage(Track.of(path, scene), boundary(scene), SMALL)
            stage.draw(stage.track.travel.total / 2, 0.5)
            assert list(touching(stage.figure)) == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", [9, 10])
def test_no_text_of_films_of_all_sorts_touches_another(seed: int) -> None:
    for scene, start, goal in scenes(seed, 2):
        found = boundary(with_ends(scene, start, goal))
        (shots,) = shots_of([found], 30, "paper")
        stage = Stage(found, SMALL, 4)
        for _ in some_frames(stage, shots, 3):
            assert list(touching(stage.figure)) == []
        table = Turntable(found, SMALL)
        for azimuth in np.linspace(-3, 3, 3).tolist():
            table.draw(azimuth)
            assert list(touching(table.figure)) == []


def test_letters_are_nine_pixels_high_at_least(five: Boundary) -> None:
    for figure in (Stage(five, SMALL, 4).figure, Turntable(five, SMALL).figure):
        sizes = [text.get_fontsize() * figure.dpi / 72 for text in figure.findobj(Text)]  # type: ignore[attr-defined]
        assert min(sizes) > 9


def test_obstacles_are_numbered_from_1_and_the_robot_is_A_where_nothing_is_on_it(five: Boundary) -> None:
    stage = Stage(five, SMALL, 4)
    names = stage.plane.shapes
    assert [text.get_text() for text in names._obstacles] == [f"$O_{{{k}}}$" for k in range(1, 6)]
    for text, obstacle in zip(names._obstacles, five.scene.obstacles, strict=True):
        assert obstacle.to_shapely().contains(shapely.Point(text.get_position()))
    large = Scene(robot=[(0, 0), (5, 0), (5, 5), (0, 5)], obstacles=[[(8, 8), (12, 8), (12, 12)]], goal=(9, 0, 0))
    stage = PathStage(Track.of(cfree.Path((0, 0, 0), []), large), None, SMALL)
    stage.draw(0.0, 0.0)
    assert stage.names._robot is not None and stage.names._robot.get_visible()


@pytest.mark.slow
def test_trails_fade_with_their_age(five: Boundary) -> None:
    (shots,) = shots_of([five], 60, "path")
    stage = Stage(five, SMALL, 4)
    *_, (view, _) = views(stage, shots, 4)
    stage.draw(view)
    alpha = np.array(stage.plane.trail.get_color())[:, 3]
    assert len(alpha) == 59 and (np.diff(alpha) >= 0).all() and alpha[-1] == 1 and alpha[0] < 0.2
    assert (alpha > 0.99).sum() < 4  # of 16 frames, which are 4 seconds


@pytest.mark.slow
def test_where_the_robot_touches_a_trail_stays_for_four_seconds(five: Boundary) -> None:
    (shots,) = shots_of([five], 300, "paper")
    stage = Stage(five, (160, 90), 4)
    sweep = next(k for k, shot in enumerate(shots) if shot.kind == "v-e")
    view, _ = list(views(stage, shots, 4))[sum(len(shot.moments) for shot in shots[: sweep + 1]) - 1]
    stage.draw(view)
    contact = view.recent[-1].contact
    assert contact is not None and contact.obstacle.end is not None and len(view.recent) == 17
    obstacle = five.scene.obstacles[contact.obstacle.polygon].vertices
    edge = shapely.LineString(obstacle[[contact.obstacle.index, contact.obstacle.end]])
    parts, alpha = stage.plane.touched.get_segments(), np.array(stage.plane.touched.get_color())[:, 3]
    assert len(parts) == 16 and all(edge.distance(shapely.LineString(part)) < 1e-9 for part in parts)
    assert (np.diff(alpha) > 0).all() and alpha[-1] == 1 and alpha[0] < 0.1


def test_swept_patches_stay_visible_above_the_plane(five: Boundary) -> None:
    (shots,) = shots_of([five], 60, "paper")
    stage = Stage(five, SMALL, 4)
    pillar = next(k for k, shot in enumerate(shots) if shot.kind == "pillar")
    first = sum(len(shot.moments) for shot in shots[:pillar]) + 4
    view, _ = list(views(stage, shots, 4))[first]
    swept = {part for shot in shots if shot.swept for part in shot.swept.parts}
    assert swept == set(np.flatnonzero(view.stays).tolist())
    assert view.ghost < STAYS / 2
    stage.draw(view)
    shades = np.array(stage.space.above.get_facecolor())[:, 3]
    assert shades.max() == pytest.approx(STAYS)


# separations


def test_a_film_of_a_separation_closes_its_surface_while_the_robot_tries(hall: Boundary) -> None:
    answer = answer_of(hall)
    stage, shots = separation_film(hall, answer, 60, (160, 90), 4)
    assert len(shots) == 3 and sum(len(shot.moments) for shot in shots) == 60
    heights = [(view.shown[:, 1] - view.shown[:, 0]).clip(0).sum() for view, _ in views(stage, shots, 4)]
    first, second = (sum(len(shot.moments) for shot in shots[:k]) for k in (1, 2))
    assert heights[first - 1] == 0 and (np.diff(heights) > -1e-9).all()
    assert heights[second - 1] == pytest.approx(np.ptp(stage.space.angles, axis=1).sum(), rel=1e-3)
    poses = [moment.pose for shot in shots for moment in shot.moments]
    xy, theta = np.array([(float(q.x), float(q.y)) for q in poses]), np.array([q.theta for q in poses])
    assert is_free(hall.scene, Poses(xy, theta)).all()
    assert poses[0] == answer.start and xy[:, 0].max() < 4
    # it comes nearer to the goal, which is to the right, and it goes elsewhere, too
    assert xy[:first, 0].max() > 2.2 and np.ptp(theta) > 1


def test_a_path_and_what_fits_exactly_are_no_separations_to_film(five: Boundary, hall: Boundary) -> None:
    with pytest.raises(ValueError, match="there is a path from start to goal"):
        answer_of(five)
    fits: Any = SimpleNamespace(pieces=())
    with pytest.raises(ValueError, match="no surface separates"):
        separation_film(hall, fits, 12, SMALL, 4)


# turntables


def test_the_axes_stay_at_the_near_edges_all_around() -> None:
    ax = Stage(boundary(Scene([(0, 0), (1, 0), (0, 1)], [WALL])), (160, 90), 4).space.point.axes
    window = (0.0, 0.0, 4.0, 2.0)
    corners = np.array([(x, y, 0.0) for x in (0.0, 4.0) for y in (0.0, 2.0)])
    for azimuth in np.radians(np.arange(-175, 180, 10)).tolist():
        box = Box(ax, window, ("x", "y"), math.floor(azimuth / (math.pi / 2) + 1) % 4)
        camera = Camera(window, 100, 100, azimuth, ALL_AROUND)
        flat, depth = camera(corners)
        edges, _ = camera(box._edges)
        assert edges[2, :, 0].max() < flat[:, 0].min() + 5  # theta rises at the left
        near = flat[depth.argmin()]
        assert np.hypot(*(edges[0, 1] - near)) < 1e-9 and np.hypot(*(edges[1, 0] - near)) < 1e-9
        box.show(False)


def test_a_turntable_counts_contact_patches_and_sides_of_the_bounds_apart() -> None:
    table = Turntable(boundary(load_scene("examples/scenes/paper_fig9.json")), SMALL)
    said = [text.get_text() for text in table.figure.texts]
    assert "18 of 18 contact patches and 4 of 4 sides of the bounds bound the forbidden space" in said


@pytest.mark.slow
def test_a_turntable_is_a_film(hall: Boundary, tmp_path: FilePath) -> None:
    cfree.film.save_film([hall], tmp_path / "turn.gif", seconds=1, fps=8, size=(160, 90), storyboard="turntable")
    with Image.open(tmp_path / "turn.gif") as film:
        assert film.n_frames == 8  # type: ignore[attr-defined]
        frames = []
        for k in range(8):
            film.seek(k)
            frames.append(np.asarray(film.convert("RGB")).astype(int))
    assert all(np.abs(frames[0] - frame).mean() > 0.5 for frame in frames[1:])


def test_segments_of_a_slice_are_cut_at_the_window() -> None:
    random = np.random.default_rng(3)
    segments = random.uniform(-2, 2, (300, 2, 2))
    segments[:60, 1, 0] = segments[:60, 0, 0]
    segments[60:120, 1, 1] = segments[60:120, 0, 1]
    inside, parts = _within(segments, (-1.0, -0.5, 1.0, 0.75))
    cut = shapely.intersection(shapely.linestrings(segments), shapely.box(-1, -0.5, 1, 0.75))
    assert (inside == (shapely.length(cut) > 0)).all()
    assert np.hypot(*(parts[inside, 1] - parts[inside, 0]).T) == pytest.approx(shapely.length(cut)[inside])
