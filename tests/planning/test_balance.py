"""Paths that keep a distance where there is room."""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path as FilePath

import numpy as np
import pytest

import cfree
from cfree import Path, Pose, Scene, clearance, narrowest, plan
from cfree.planning.options import Options
from cfree.planning.pose_planner import PosePlanner

ROOT = FilePath(__file__).resolve().parents[2]

Ring = list[tuple[float, float]]


def box(x: float, y: float, width: float, height: float) -> Ring:
    return [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]


def found(scene: Scene, **options: object) -> Path:
    path = plan(scene, **options)  # type: ignore[arg-type]
    assert isinstance(path, Path) and path.start == scene.start and path.goal == scene.goal
    assert path.is_free(cfree.MotionChecker(scene))
    return path


def least(path: Path, scene: Scene) -> float:
    place = clearance(path, scene)
    assert place is not None
    return place.found


def throat(width: float) -> Scene:
    """Two rooms, and between them a throat a little wider than the robot, which has to turn on both sides."""
    gap = 0.5 + width / 2
    walls = [box(4, -5, 1, 5 - gap), box(4, gap, 1, 5 - gap)]
    room, robot = box(0, -5, 10, 10), box(-1, -0.5, 2, 1)
    return Scene(robot, walls, workspace=room, start=Pose(1.5, 1, 0.3), goal=Pose(8, -1, 2.0))


@pytest.mark.parametrize("width", [1e-1, 2e-2])
def test_a_throat_is_passed_in_its_middle(width: float) -> None:
    scene = throat(width)
    path = found(scene)
    assert least(path, scene) >= 0.5 * width / 2
    assert len(path.motions) <= 16


def test_it_keeps_more_where_there_is_more() -> None:
    walls = [box(4, -9, 1, 8.45), box(4, 0.55, 1, 8.45), box(14, -9, 1, 8), box(14, 1, 1, 8)]
    robot, room = box(-0.5, -0.5, 1, 1), box(-5, -9, 30, 18)
    scene = Scene(robot, walls, workspace=room, start=Pose(0, 4), goal=Pose(20, 4))
    path = found(scene)
    first, second = narrowest(path, scene, 2)
    assert first.found >= 0.5 * 0.05 and {first.obstacle[0], second.obstacle[0]} & {0, 1} and second.found >= 0.5 * 0.5
    short = found(scene, objective="short")
    assert path.length + path.turning < 1.15 * (short.length + short.turning)


def test_a_peg_goes_before_its_hole_turns_and_goes_in() -> None:
    walls = [box(5, -4, 3, 3.75), box(5, 0.25, 3, 3.75)]
    scene = Scene(box(-1, -0.2, 2, 0.4), walls, workspace=box(-4, -4, 12, 8), start=(0, 2, "90deg"), goal=(6.5, 0, 0))
    path = found(scene)
    assert len(path.motions) <= 5 and path.turning < 1.01 * math.pi / 2 and least(path, scene) >= 0.025


@pytest.mark.parametrize("width", [2.0**-6, 2.0**-10, 2.0**-13])
def test_a_long_slot_is_passed_straight_turned_before_and_after(width: float) -> None:
    gap = 0.5 + width / 2
    walls, room = [box(0, -9, 12, 9 - gap), box(0, gap, 12, 8)], box(-12, -9.5, 36, 19)
    robot, ends = box(-1.5, -0.5, 3, 1), {"start": Pose(-8, 4, "50deg"), "goal": Pose(20, -5, "-100deg")}
    scene = Scene(robot, walls, workspace=room, **ends)  # type: ignore[arg-type]
    path = found(scene)
    assert least(path, scene) >= 0.5 * width / 2
    assert len(path.motions) <= 9 and path.turning < 1.01 * math.radians(150)


def test_a_maze_is_passed_without_needless_turning() -> None:
    walls = [box(2 * k, -1 if k % 2 else 0, 0.25, 5) for k in range(1, 5)]
    scene = Scene(box(-0.3, -0.15, 0.6, 0.3), walls, workspace=box(0, -1, 10, 6), start=Pose(1, 0), goal=Pose(9, 3))
    path = found(scene)
    assert path.turning < math.pi and len(path.motions) <= 26 and least(path, scene) >= 0.2


def test_a_way_that_touches_by_necessity_stays() -> None:
    walls = [box(3, -5, 2, 4.5), box(3, 0.5, 2, 4.5)]
    scene = Scene(box(-0.5, -0.5, 1, 1), walls, workspace=box(-5, -5, 15, 10), start=Pose(0, 2), goal=Pose(8, 2))
    assert least(found(scene), scene) == 0


def test_bounds_are_no_walls_but_hold() -> None:
    scene = Scene(box(0, 0, 1, 1), [box(3, -2, 1, 3)], bounds=(0, -2, 8, 2), start=Pose(0, 0), goal=Pose(7, 0, "90deg"))
    path = found(scene)
    assert least(path, scene) > 0.3


def test_a_ridge_goes_beside_bounds_and_not_on_them() -> None:
    """Walls in line leave much room above them, as far as the bounds: there arcs between poses would leave these."""
    scene = cfree.load_scene(ROOT / "examples/scenes/degenerate_collinear_walls.json")
    path = found(scene)
    assert least(path, scene) >= 1.1 and len(path.motions) <= 9


def test_the_goal_is_reached_where_turning_takes_so_much_that_travel_is_rounded_away() -> None:
    far = 2**60
    robot = [(-far, 0), (-2 * far, 0), (-2 * far, -far), (-far, -far)]
    found(Scene(robot, [], bounds=(0, 5, 7, 8), start=Pose(7, 5, "180deg"), goal=Pose(0, 8)))


def test_poses_nearer_than_doubles_tell_are_two() -> None:
    for start, goal in (
        (Pose(1, 1, "90deg"), Pose(7 - Fraction(1, 2**156), 1)),
        (Pose(1, 1), Pose(1 - Fraction(1, 2**90), 1)),
    ):
        found(Scene(box(0, 0, 1, 1), [box(3, 0, 1, 3)], workspace=box(0, 0, 9, 9), start=start, goal=goal))


def test_many_motions_become_few() -> None:
    scene = cfree.load_scene(ROOT / "examples/scenes/flat.json")
    assert len(found(scene).motions) <= 10 < len(found(scene, improve=0).motions)


def test_the_answer_depends_on_no_thread_and_no_time() -> None:
    rng = np.random.default_rng(3)
    boxes = [box(*rng.uniform(1, 17, 2), 1, 1) for _ in range(25)]
    scene = Scene(box(-0.4, -0.2, 0.8, 0.4), boxes, bounds=(0, 0, 20, 20))
    ends = (Pose(0.5, 0.5), Pose(19, 19, 1.0))
    one, other = (plan(scene, *ends) for _ in range(2))
    space = cfree.free_space(cfree.boundary(scene))
    assert one == other == cfree.plan_many(space, [ends] * 3, threads=3)[2]


@pytest.mark.slow
def test_time_makes_it_shorter_not_nearer() -> None:
    scene = throat(0.1)
    first, better = found(scene), found(scene, improve=0.3)
    assert better.length + better.turning <= 1.01 * (first.length + first.turning)
    assert least(better, scene) >= 0.5 * 0.05


@pytest.mark.slow
def test_other_ways_are_looked_for_if_there_is_time() -> None:
    """The search's first way past these racks is nearly twice as long as the shortest; each core tries others."""
    racks = [box(x, y, 4, 1) for x in (2, 8) for y in (2, 6, 10)]
    ends = {"start": Pose(7, 1), "goal": Pose(1, 8, "90deg")}
    scene = Scene(box(-0.4, -0.5, 2, 1), racks, workspace=box(0, 0, 14, 13), **ends)
    assert found(scene, improve=1.5).length < 0.8 * found(scene).length


def test_improving_ends_with_the_wish_to_stop() -> None:
    scene = throat(0.1)
    options = Options()
    poses = list(found(scene, improve=0).poses)
    options.stop.set()
    with pytest.raises(KeyboardInterrupt):
        PosePlanner(scene).improver(poses, options).balanced(poses, 60.0)


def test_what_doubles_guided_wrongly_is_not_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = throat(0.1)
    poses = [q for q in found(scene, improve=0).poses]
    monkeypatch.setattr(cfree.MotionChecker, "joins", lambda self, way: False)
    assert PosePlanner(scene).improver(poses, Options()).balanced(poses, None) is poses
