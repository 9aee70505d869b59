"""Scenes made in Python: one or many shapes of several kinds, names, bounds, refusals."""

import dataclasses
import pickle
from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest
import shapely

from cfree.collision.pose_checker import is_free
from cfree.curves.curved import Curved
from cfree.curves.similar import moved_shape
from cfree.errors import InvalidPolygonError, InvalidPoseError, UnsupportedError
from cfree.exact.pose import Pose
from cfree.polygons.polygon import Polygon
from cfree.scene.reading import Note
from cfree.scene.scene import Scene, with_reading

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


SHELF, DISC = [(5, 0), (9, 0), (9, 1), (5, 1)], Curved.circle((20, 0), 1)
ROUNDED = Curved([(30, 0), (32, 0), (32, 3)], grown="1/4")
FULL = Scene(
    TRIANGLE,
    [SHELF, DISC, ROUNDED, shapely.MultiPolygon([shapely.box(50, 50, 60, 60), shapely.box(70, 50, 80, 60)])],
    obstacle_names=["shelf", None, "post", "lake"],
    bounds=(-99, -99, 99, 99),
    start=(0, 0, 0),
    goals=[(1, 1, 0), (2, 2)],
    name="hall",
    note="a note",
    source={"by": "hand"},
    check={"free": True},
)


@pytest.mark.parametrize("k", range(5))
def test_a_scene_with_a_moved_obstacle_is_the_scene_made_with_it(k: int) -> None:
    pose = Pose("1/3", -2, {"tau": "1/7"})
    moved = FULL.moved(k, pose)
    obstacles = list(FULL.obstacles)
    obstacles[k] = moved_shape(obstacles[k], pose)
    assert moved == dataclasses.replace(FULL, obstacles=tuple(obstacles), goal=None, check={})
    assert moved.moved(k, pose.inverse()) == dataclasses.replace(FULL, goal=None, check={})
    assert FULL.check == {"free": True}


def test_an_obstacle_moves_by_index_and_name_alike() -> None:
    pose = (1, 2, "30deg")
    assert FULL.moved("post", pose) == FULL.moved(2, pose) == FULL.moved(np.int64(2), list(pose))


def test_moves_about_the_origin_turn_first_and_then_shift() -> None:
    corner = Scene(TRIANGLE, [SQUARE]).moved(0, (10, 0, "90deg")).obstacles[0].exact_vertices[0]
    assert corner == (8, 2)


def test_many_moves_give_the_scene_of_their_product() -> None:
    one, other = Pose(1, "1/3", {"tau": "1/5"}), Pose(-2, 4, {"tau": 7})
    assert FULL.moved(0, one).moved(0, other) == FULL.moved(0, other @ one)


def test_a_scene_with_one_obstacle_more_and_less_is_the_one_before() -> None:
    for shape in ([(1, 1), (2, 1), (2, 3)], DISC, ROUNDED, Polygon(SQUARE), shapely.box(7, 7, 8, 8)):
        for name in ("new", None):
            more = FULL.with_obstacle(shape, name)
            assert more.obstacle_names == (*FULL.obstacle_names, name or "obstacle 5")
            assert more.without_obstacle(5) == dataclasses.replace(FULL, goal=None, check={})
    lakes = FULL.with_obstacle(shapely.MultiPolygon([shapely.box(0, 9, 1, 10), shapely.box(3, 9, 4, 10)]))
    assert lakes.obstacle_names[5:] == ("obstacle 5", "obstacle 6")
    assert FULL.obstacle_names == ("shelf", "obstacle 1", "post", "lake", "lake")


def test_obstacles_named_by_their_index_are_so_after_one_is_removed() -> None:
    less = FULL.without_obstacle("shelf")
    assert less.obstacle_names == ("obstacle 0", "post", "lake", "lake")
    assert less.obstacles == FULL.obstacles[1:]
    assert Scene(TRIANGLE, [SHELF]).without_obstacle(0) == Scene(TRIANGLE)


def test_a_scene_is_curved_as_long_as_a_shape_of_it_is() -> None:
    flat = Scene(TRIANGLE, [SHELF])
    round_one = flat.with_obstacle(DISC)
    assert [s.curved for s in (flat, round_one, round_one.moved(1, (1, 0, 0)), round_one.without_obstacle(1))] == [
        False, True, True, False,
    ]  # fmt: skip
    assert is_free(round_one, (5, 5, 0)) and not is_free(round_one.moved(1, (-15, 5, 0)), (5, 5, 0))


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        (lambda s: s.moved(5, (0, 0, 0)), IndexError, r"obstacle: 5, and the scene has 5 obstacles; an index from 0"),
        (lambda s: s.moved(-1, (0, 0, 0)), IndexError, r"obstacle: -1, and the scene has 5 obstacles"),
        (lambda s: s.without_obstacle(7), IndexError, r"obstacle: 7, and"),
        (lambda s: Scene(TRIANGLE).without_obstacle(0), IndexError, r"has 0 obstacles; with_obstacle adds some"),
        (lambda s: s.moved("shelve", (0, 0, 0)), ValueError, r"'shelve' is the name of none; did you mean 'shelf'\?"),
        (lambda s: s.without_obstacle("xyz"), ValueError, r"'xyz' is the name of none; give an index"),
        (lambda s: s.moved("lake", (0, 0, 0)), ValueError, r"'lake' is the name of obstacles 3, 4; give an index"),
        (lambda s: s.moved(0, (0, 0)), InvalidPoseError, r"pose: \(0, 0\) is no pose"),
        (lambda s: s.moved(0, 5), TypeError, r"pose: 5"),
        (lambda s: s.moved(True, (0, 0, 0)), TypeError, r"obstacle: True"),
        (lambda s: s.moved(1.0, (0, 0, 0)), TypeError, r"obstacle: 1.0 is a float; give an int or a str"),
        (lambda s: s.with_obstacle([(0, 0), (1, 1)], "rod"), InvalidPolygonError, r"obstacle \(rod\): .*a segment or"),
        (lambda s: s.with_obstacle(3), InvalidPolygonError, r"obstacle: .*3 is no ring"),
        (lambda s: s.with_obstacle(SQUARE, 4), TypeError, r"name: 4 is an int"),
    ],
)  # fmt: skip
def test_impossible_changes_are_refused(change: Callable[[Scene], Scene], error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        change(FULL)


def test_a_move_out_of_range_is_refused() -> None:
    with pytest.raises(UnsupportedError, match=r"shelf: .*1e150"):
        Scene(TRIANGLE, [SHELF], obstacle_names=["shelf"]).moved(0, ("1e151", 0, 0))
    with pytest.raises(UnsupportedError, match=r"obstacle 0: .*1e150"):
        Scene(TRIANGLE).with_obstacle([(0, 0), ("1e151", 0), (1, 1)])


def test_a_change_keeps_nothing_that_was_prepared_for_the_scene_before() -> None:
    scene = Scene(TRIANGLE, [SQUARE])
    assert not is_free(scene, (2, 2, 0))
    assert is_free(scene.moved(0, (10, 0, 0)), (2, 2, 0)) and not is_free(scene.moved(0, (10, 0, 0)), (12, 2, 0))
    assert is_free(scene.without_obstacle(0), (2, 2, 0)) and not is_free(scene, (2, 2, 0))


def test_a_change_keeps_the_record_of_reading() -> None:
    note = Note(kind="info", what="thing")
    scene = with_reading(Scene(TRIANGLE, [SQUARE]), [note])
    assert scene.moved(0, (1, 0, 0)).reading == scene.with_obstacle(SHELF).reading == (note,)
