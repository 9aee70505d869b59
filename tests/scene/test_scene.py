"""Scenes made in Python: one or many shapes of several kinds, names, bounds, refusals."""

import dataclasses
import pickle
from fractions import Fraction

import numpy as np
import pytest
import shapely

from cfree.errors import InvalidPolygonError
from cfree.exact.pose import Pose
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene

TRIANGLE = [(0, 0), (1, 0), (0, 1)]
SQUARE = [(2, 2), (3, 2), (3, 3), (2, 3)]


@pytest.mark.parametrize(
    "robot",
    [
        TRIANGLE,
        tuple(TRIANGLE),
        [TRIANGLE],
        Polygon(TRIANGLE),
        [Polygon(TRIANGLE)],
        np.array(TRIANGLE),
        np.array(TRIANGLE, dtype=np.float32),
        [np.array(TRIANGLE)],
        np.array([TRIANGLE]),
        list(np.array(TRIANGLE)),
        shapely.Polygon(TRIANGLE),
        shapely.MultiPolygon([shapely.Polygon(TRIANGLE)]),
        (shapely.Polygon(TRIANGLE) for _ in range(1)),
    ],
)
def test_a_robot_is_one_shape_or_many_of_any_kind(robot: object) -> None:
    assert Scene(robot=robot).robot == (Polygon(TRIANGLE),)


def test_many_shapes_of_different_kinds_make_a_scene() -> None:
    lakes = shapely.MultiPolygon([shapely.box(5, 5, 6, 6), shapely.box(7, 5, 8, 6)])
    scene = Scene(
        robot=[TRIANGLE, np.array(SQUARE)],
        obstacles=[SQUARE, lakes, Polygon([("1/3", 0), (1, 0), (1, "0.1")])],
        obstacle_names=["wall", "lake", None],
    )
    assert len(scene.robot) == 2
    assert scene.obstacle_names == ("wall", "lake", "lake", "obstacle 3")
    assert scene.obstacles[3].exact_vertices[2] == (1, Fraction(1, 10))


def test_floats_are_the_doubles_they_are() -> None:
    scene = Scene(robot=np.array([(0, 0), (0.1, 0), (0, 1)]))
    assert scene.robot[0].exact_vertices[1][0] == Fraction(0.1) != Fraction(1, 10)


def test_a_scene_needs_no_obstacles() -> None:
    scene = Scene(robot=TRIANGLE)
    assert scene.obstacles == scene.obstacle_names == ()
    assert repr(scene) == "Scene(robot: 3 vertices; 0 obstacles)"


@pytest.mark.parametrize("robot", [[], (), np.empty((0, 3, 2)), shapely.MultiPolygon()])
def test_an_empty_robot_is_an_error(robot: object) -> None:
    with pytest.raises(InvalidPolygonError, match="the robot is empty; give at least one polygon"):
        Scene(robot=robot)


@pytest.mark.parametrize(
    ("shape", "words"),
    [
        (shapely.LineString([(0, 0), (1, 1)]), "LineString"),
        (shapely.Point(1, 1), "Point"),
        ([(0, 0), (1, 1)], "2 points"),
        ([(1, 1)], "1 points"),
        (np.array([(0, 0), (1, 1), (2, 2)]), "on one line"),
        ([(0, 0), (1, 1), (0, 0), (1, 1)], "on one line"),
    ],
)
def test_segments_and_points_are_refused_with_the_reason(shape: object, words: str) -> None:
    with pytest.raises(InvalidPolygonError, match=rf"^obstacle 1 \(thin\): .*{words}.*forbids nothing"):
        Scene(robot=TRIANGLE, obstacles=[SQUARE, shape], obstacle_names=[None, "thin"])


def test_a_fault_names_the_shape_and_keeps_its_edges() -> None:
    with pytest.raises(InvalidPolygonError, match=r"^robot\[1\]: outer ring: edges 0 and 2 cross") as caught:
        Scene(robot=[TRIANGLE, [(0, 0), (2, 2), (2, 0), (0, 3)]])
    assert (caught.value.ring, caught.value.edges) == (0, (0, 2))


@pytest.mark.parametrize("robot", [None, 3, "abc", {"outer": TRIANGLE}, [None]])
def test_what_is_no_shape_is_refused(robot: object) -> None:
    with pytest.raises(InvalidPolygonError, match="give"):
        Scene(robot=robot)


def test_names_and_obstacles_agree_in_number() -> None:
    with pytest.raises(ValueError, match="1 name for 2 obstacles"):
        Scene(robot=TRIANGLE, obstacles=[SQUARE, SQUARE], obstacle_names=["a"])


@pytest.mark.parametrize("bounds", [(0, 0, 0, 1), (0, 1, 1, 1), (2, 0, 1, 1)])
def test_empty_bounds_are_refused(bounds: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match="are empty; give xmin < xmax"):
        Scene(robot=TRIANGLE, bounds=bounds)


def test_the_workspace_is_one_polygon() -> None:
    assert Scene(robot=TRIANGLE, workspace=SQUARE).workspace == Polygon(SQUARE)
    with pytest.raises(InvalidPolygonError, match="workspace: 2 polygons; give one"):
        Scene(robot=TRIANGLE, workspace=[SQUARE, TRIANGLE])


def test_configurations_are_poses_or_triples() -> None:
    scene = Scene(robot=TRIANGLE, start=(1, "1/3", "90deg"), goal=Pose(0, 0, {"tau": "inf"}))
    assert scene.start == Pose(1, Fraction(1, 3), {"tau": 1})
    assert scene.goal == Pose(0, 0, "180deg")


def test_a_scene_is_a_value() -> None:
    licence = {"licence": "MIT"}
    scene = Scene(robot=TRIANGLE, obstacles=SQUARE, bounds=(0, 0, 1, 1), source=licence, name="a")
    again = Scene(robot=[TRIANGLE], obstacles=[SQUARE], bounds=(0, 0, 1, 1), source=licence, name="a")
    assert scene == again == pickle.loads(pickle.dumps(scene))
    assert hash(scene) == hash(again)
    unbounded = Scene(robot=TRIANGLE, obstacles=SQUARE, source=licence, name="a")
    assert dataclasses.replace(scene, bounds=None) == unbounded
    with pytest.raises(dataclasses.FrozenInstanceError):
        scene.name = "b"  # type: ignore[misc]
    assert repr(scene) == "Scene('a', robot: 3 vertices; 1 obstacle: 4 vertices)"
