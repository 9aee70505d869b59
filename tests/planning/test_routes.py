"""Routes from room to room, in scenes that are asked as if they had many obstacles."""

from __future__ import annotations

import threading
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cfree
from cfree.collision.slide import Slide
from cfree.exact.pose import Pose
from cfree.planning import planner as planner_of_scenes
from cfree.planning import routes
from cfree.planning.large import SceneGround, edges_of, path_around
from cfree.planning.options import Options
from cfree.planning.rooms import divided
from cfree.planning.routes import Leg, Router, improved, in_threads, joined
from stones import ROBOT, stones

STONES = cfree.Scene(ROBOT, stones(9))
START, GOAL = Pose(-3, -3), Pose(95, 95, "90deg")
FIRST = Options(improve=0.0)


def ground_in_rooms(scene: cfree.Scene, most: int) -> SceneGround:
    """Obstacles of a scene whose rooms have few edges."""
    ground = SceneGround(scene)
    ground.atlas.rooms = divided(edges_of(scene.obstacles), ground.radius, scene.bounds, most)
    return ground


def router_among(scene: cfree.Scene, start: Pose, goal: Pose, most: int = 12) -> Router:
    return Router(ground_in_rooms(scene, most).atlas, start, goal, FIRST)


def refused() -> None:
    raise AssertionError("no step at an end is refused")


def test_legs_join_start_and_goal_and_stay_in_their_boxes() -> None:
    router = router_among(STONES, START, GOAL)
    legs = router.legs(refused)
    assert router.is_far and legs is not None and len(legs) > 3
    path = cfree.Path(START, [motion for leg in legs for motion in leg.motions])
    assert path.goal == GOAL and path.is_free(cfree.MotionChecker(STONES))
    pose = START
    for leg in legs:
        part = cfree.Path(pose, leg.motions)
        bounded = cfree.Scene(ROBOT, [STONES.obstacles[k] for k in leg.obstacles], bounds=leg.box)
        assert part.is_free(cfree.MotionChecker(bounded))
        pose = part.goal


def test_a_path_of_legs_is_checked_as_a_whole() -> None:
    ground = ground_in_rooms(STONES, 12)
    through = Leg((-9, -9, 99, 99), np.arange(81), (cfree.Translation((98, 98)),))
    with pytest.raises(cfree.errors.InvariantError, match="not free"):
        joined(START, [through], ground)


def test_motions_of_a_known_route_are_not_planned_again(monkeypatch: pytest.MonkeyPatch) -> None:
    atlas = ground_in_rooms(STONES, 12).atlas
    calls: list[Any] = []
    plain = Router._motions
    monkeypatch.setattr(
        Router, "_motions", lambda self, step, options: calls.append(step) or plain(self, step, options)
    )
    counts = []
    for _ in range(2):
        Router(atlas, START, GOAL, FIRST).legs(refused)
        counts.append(len(calls))
    assert counts[0] > 4 and counts[1] == counts[0] + 2


def test_a_step_that_its_room_refuses_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    router = router_among(STONES, START, GOAL)
    first = router.route()
    assert first is not None
    shut = {first[2].ends}
    plain = Router._motions
    monkeypatch.setattr(
        Router, "_motions", lambda self, step, options: None if step.ends in shut else plain(self, step, options)
    )
    legs = router.legs(refused)
    assert legs is not None and sum(len(leg.motions) for leg in legs) > 0
    again = router.route()
    assert again is not None and shut.isdisjoint(step.ends for step in again)


def test_a_route_is_given_up_where_rooms_refuse_too_much(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Router, "_motions", lambda self, step, options: None)
    asked: list[bool] = []
    assert router_among(STONES, START, GOAL).legs(lambda: asked.append(True)) is None
    assert asked == [True]


@pytest.mark.slow
def test_no_route_leads_into_a_closed_court() -> None:
    ring = cfree.Polygon([(20, 20), (80, 20), (80, 80), (20, 80)], [[(21, 21), (21, 79), (79, 79), (79, 21)]])
    blocks = [[(x, 5), (x + 2, 5), (x + 2, 9)] for x in range(0, 100, 4)]
    scene = cfree.Scene(
        ROBOT, [ring, *blocks, *[[(x, y + 30) for x, y in block] for block in blocks if 24 < block[0][0] < 74]]
    )
    router = router_among(scene, Pose(0, 0), Pose(50, 60), most=6)
    assert router.legs(lambda: None) is None
    assert path_around(ground_in_rooms(scene, 6), Pose(0, 0), Pose(50, 60), FIRST) is None
    assert isinstance(cfree.plan(scene, (0, 0, 0), (50, 60, 0)), cfree.Separated)


def test_the_search_ends_soon_where_the_goal_is_shut_in(monkeypatch: pytest.MonkeyPatch) -> None:
    router = router_among(STONES, START, GOAL)
    monkeypatch.setattr(routes, "MANY", 1)
    assert router.route() is not None
    for room in router._rooms[routes.GOAL]:
        for portal in router.atlas.entry(room).portals:
            router._banned.add((routes.GOAL, portal.key))
    assert router._is_shut(1)


@pytest.mark.slow
@pytest.mark.parametrize("improve", [None, 0.05])
def test_improved_legs_are_shorter_and_free(improve: float | None) -> None:
    ground = ground_in_rooms(STONES, 12)
    legs = Router(ground.atlas, START, GOAL, FIRST).legs(refused)
    assert legs is not None
    before, _ = joined(START, legs, ground)
    after, numbers = joined(START, improved(START, legs, ground, Options(improve=improve)), ground)
    assert after.goal == GOAL and after.length + after.turning < before.length + before.turning
    assert after.is_free(cfree.MotionChecker(STONES)) and numbers == sorted(set(numbers))
    assert improved(START, legs, ground, FIRST) == legs


@pytest.mark.slow
def test_a_scene_of_many_vertices_is_planned_in_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planner_of_scenes, "LARGE", 100)
    path = cfree.plan(STONES, START, GOAL)
    assert isinstance(path, cfree.Path) and path.scene is STONES and path.goal == GOAL
    assert path.is_free(cfree.MotionChecker(STONES)) and cfree.verify.answer(STONES, path).verified


def test_a_proof_in_a_scene_of_many_vertices_names_its_obstacles(monkeypatch: pytest.MonkeyPatch) -> None:
    ring = cfree.Polygon(
        [(-20, -20), (-10, -20), (-10, -10), (-20, -10)], [[(-19, -19), (-19, -11), (-11, -11), (-11, -19)]]
    )
    scene = cfree.Scene(ROBOT, [*STONES.obstacles, ring])
    monkeypatch.setattr(planner_of_scenes, "LARGE", 100)
    proof = cfree.plan(scene, (-15, -15, 0), GOAL)
    assert isinstance(proof, cfree.Separated) and proof.scene is scene and proof.obstacles == (81,)
    assert cfree.verify.answer(scene, proof).verified


# three feet stand on three walls: the robot leaves them by a slide
FEET = [[(4, 8), (5, "7.5"), (5, "8.5")], [(4, 0), ("4.5", 1), ("3.5", 1)], [(0, 4), (-1, "3.5"), ("-0.5", 3)]]
WALLS = [
    [(-1, 6), (0, 6), (0, 10), (-1, 10)],
    [(-2, -1), (2, -1), (2, 0), (-2, 0)],
    [(-6, 6), (-2, 2), (-1, 3), (-5, 7)],
]


def touched(path: cfree.Path) -> set[int]:
    """Obstacles that the first motion, a slide, keeps in contact."""
    assert isinstance(path.motions[0], Slide)
    return {touch.obstacle[0] for touch in path.motions[0].contacts}


def test_slides_keep_the_numbers_of_their_obstacles(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = cfree.Scene(FEET, [[(500, 0), (501, 0), (500, 1)], *WALLS])
    monkeypatch.setattr(planner_of_scenes, "LARGE", 0)
    path = cfree.plan(scene, (-4, 0, 0), (60, 60, 0), improve=0.0)
    assert isinstance(path, cfree.Path) and touched(path) <= {1, 2, 3}
    assert cfree.verify.answer(scene, path).verified


def test_slides_on_a_route_keep_the_numbers_of_their_obstacles() -> None:
    far = [[(40 * i + x, 40 * j + y) for x, y in ((60, 0), (64, 0), (60, 4))] for i in range(5) for j in range(-2, 3)]
    scene, start = cfree.Scene(FEET, [*far, *WALLS]), Pose(-4, 0)
    ground = SceneGround(scene)
    ground.atlas.rooms = divided(edges_of(scene.obstacles), ground.radius / 4, None, 9)
    legs = Router(ground.atlas, start, Pose(240, 20), FIRST).legs(refused)
    assert legs is not None and len(legs) > 2
    path, numbers = joined(start, legs, ground)
    assert {numbers[k] for k in touched(path)} <= {25, 26, 27}


def test_ctrl_c_ends_all_threads() -> None:
    late: list[str] = []

    def wait(options: Options) -> None:
        if not options.stop.wait(10):
            late.append("too late")

    own = replace(FIRST, stop=threading.Event())
    timer = threading.Timer(0.05, own.stop.set)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        in_threads([wait, wait, wait], own)
    assert late == []
