"""Labels of pictures: none touches another, whatever the scene; and they keep clear of walls where there is room."""

from typing import Any

import numpy as np
import pytest
import shapely
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d import proj3d

import cfree
from cfree.collision.motion import Translation
from cfree.exact.pose import Pose
from cfree.paths.path import Path
from cfree.plot.answer import picture, plot_path_space
from cfree.plot.boundary import plot_slice, plot_workspace
from cfree.plot.labels import FRAME
from cfree.plot.path import plot_path
from cfree.scene.scene import Scene
from overlaps import touching, written
from questions_of_all_sorts import scenes

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
KEPT = ("robot", "obstacles", "bounds", "workspace", "units", "name")
WALL = [(-3, "1.25"), (9, "1.25"), (9, 2), (-3, 2)]


def test_texts_that_touch_are_found() -> None:
    figure = Figure()
    for x, text in ((0.2, "one"), (0.22, "two"), (0.8, "three"), (0.2, " ")):
        figure.text(x, 0.5, text)
    figure.text(0.2, 0.9, "hidden", visible=False)
    figure.text(0.21, 0.9, "slanting", rotation=45)
    figure.text(0.25, 0.9, "below it", va="top")
    assert list(touching(figure)) == [("one", "two")]


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 5])
def test_no_label_of_an_answer_touches_another(seed: int) -> None:
    for k, (scene, start, goal) in enumerate(scenes(seed)):
        figure = picture(cfree.plan(scene, start, goal), scene, cfree.boundary(scene) if k % 3 == 0 else None)
        assert {"start", "goal"} <= {text for text, _ in written(figure)}
        assert list(touching(figure)) == [], (k, scene)


@pytest.mark.slow
def test_no_label_of_a_scene_or_a_slice_touches_another() -> None:
    for k, (scene, start, goal) in enumerate(scenes(3)):
        ends = Scene(**{name: getattr(scene, name) for name in KEPT}, start=start, goal=goal)
        assert list(touching(plot_workspace(ends).figure)) == [], k
        figure = plot_slice(cfree.boundary(ends).slice(0.3)).figure
        assert list(touching(figure)) == [], k
        assert any("reference point may be" in text.replace("\n", " ") for text, _ in written(figure)), k


def boxes_in_the_plane(figure: Figure) -> dict[str, shapely.Geometry]:
    ax = figure.axes[0]
    back = ax.transData.inverted().transform
    return {text: shapely.transform(box, back) for text, box in written(figure)}


@pytest.mark.slow
def test_start_and_goal_are_clear_of_walls_and_robots() -> None:
    for scene, start, goal in scenes(4):
        path = cfree.plan(scene, start, goal)
        if not isinstance(path, Path):
            continue
        seen = boxes_in_the_plane(plot_path(path, scene).figure)
        walls = [obstacle.to_shapely() for obstacle in scene.obstacles]
        robots = [shapely.Polygon(q.apply(part.vertices)) for q in (start, goal) for part in scene.robot]
        for name in ("start", "goal"):
            assert not shapely.intersects(seen[name], [*walls, *robots]).any()


def test_the_clearance_stands_beside_the_robots_with_a_leader_to_its_place() -> None:
    scene = Scene(robot=SQUARE, obstacles=[WALL], units="m")
    path = Path(Pose(0, 0), [Translation((5, 0))])
    figure = plot_path(path, scene).figure
    seen = boxes_in_the_plane(figure)["0.25 m"]
    swept = shapely.box(0, 0, 6, 1)
    assert not seen.intersects(swept) and not seen.intersects(shapely.Polygon(WALL))
    (leader,) = (line for line in figure.axes[0].lines if line.get_label() == "_leader" and _ends_at(line, seen))
    mark = next(line for line in figure.axes[0].lines if line.get_marker() == "o" and line.get_markersize() == 11)
    begin = figure.axes[0].transData.transform(leader.get_xydata()[0])
    middle = figure.axes[0].transData.transform(mark.get_xydata()[0])
    assert np.hypot(*(begin - middle)) == pytest.approx(5.5 * figure.dpi / 72, rel=0.01)


def _ends_at(line: Any, box: shapely.Geometry) -> bool:
    return shapely.Point(line.get_xydata()[-1]).distance(box) < 0.1


@pytest.mark.slow
def test_the_frame_of_the_bounds_says_what_it_is_where_it_is_seen() -> None:
    near = Scene(robot=SQUARE, obstacles=[WALL], bounds=(-4, -4, 10, 6))
    path = Path(Pose(0, 0), [Translation((5, 0))])
    box = boxes_in_the_plane(plot_path(path, near).figure)[FRAME]
    assert 0 < box.distance(shapely.box(-4, -4, 10, 6).exterior) < 0.5
    for scene in (Scene(robot=SQUARE, obstacles=[WALL]), Scene(robot=SQUARE, bounds=(-900, -900, 900, 900))):
        assert FRAME not in boxes_in_the_plane(plot_path(path, scene).figure)


@pytest.mark.slow
def test_names_in_space_follow_the_camera() -> None:
    scene = Scene(robot=SQUARE, obstacles=[WALL])
    ax = plot_path_space(Path(Pose(0, 0), [Translation((5, 0))]), cfree.boundary(scene))
    start = next(text for text in ax.texts if text.get_text() == "start")
    boxes = []
    for azimuth in (-58, 20):
        ax.view_init(24, azimuth)
        boxes.append(dict(written(ax.figure))["start"].centroid)
        (mark,) = (line for line in ax.lines if line.get_marker() == "o" and line.get_data_3d()[0][0] == 0)
        x, y, _ = proj3d.proj_transform(*(values[0] for values in mark.get_data_3d()), ax.get_proj())
        assert np.hypot(*(ax.transData.transform((x, y)) - (boxes[-1].x, boxes[-1].y))) < 60
    assert boxes[0].distance(boxes[1]) > 30 and start.get_visible()
