"""What machines would rather not do: costs that paths obey, and that change no verdict."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

import cfree
from cfree import (
    Car,
    DifferentialDrive,
    MotionChecker,
    Path,
    Pose,
    Preferences,
    Rotation,
    Scene,
    Translation,
    motion_between,
    plan,
    unwanted,
)
from cfree._core import Searcher
from cfree.planning.core_ways import end_of
from cfree.planning.separation import known_scene

Ring = list[tuple[float, float]]
EVERYTHING = Preferences(2, 2, 2)


def box(x: float, y: float, width: float, height: float) -> Ring:
    return [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]


def amount(path: Path, scene: Scene, kind: str) -> float:
    return sum(part.amount for part in unwanted(path, scene, EVERYTHING) if part.kind == kind)


def planned(scene: Scene, objective: cfree.paths.path.Objective, preferences: Preferences | None = None) -> Path:
    path = plan(scene, objective=objective, preferences=preferences)
    assert isinstance(path, Path)
    return path


@pytest.fixture(scope="module")
def hall() -> Scene:
    racks = [box(x, y, 4, 1) for x in (2, 8) for y in (2, 6, 10)]
    ends = {"start": Pose(1, 1, "90deg"), "goal": Pose(13, 11, "-90deg")}
    return Scene(box(-0.4, -0.5, 2, 1), racks, workspace=box(0, 0, 14, 13), **ends)


@pytest.mark.parametrize("objective", ["balanced", "short"])
def test_a_forklift_does_not_crab(hall: Scene, objective: cfree.paths.path.Objective) -> None:
    plain = plan(hall, objective=objective)
    driven = plan(hall, objective=objective, preferences=Preferences(sideways=20))
    assert isinstance(plain, Path) and isinstance(driven, Path) and driven.is_free(MotionChecker(hall))
    assert amount(driven, hall, "sideways") < min(1.0, amount(plain, hall, "sideways") / 2)


@pytest.mark.parametrize(("objective", "share"), [("balanced", 0.9), ("short", 0.5)])
def test_ahead_where_back_is_dear_and_few_turns_on_the_spot_where_they_are(
    hall: Scene, objective: cfree.paths.path.Objective, share: float
) -> None:
    ahead, round_it = Preferences(sideways=20, backward=20), Preferences(turning=20)
    plain = planned(hall, objective)
    assert ahead.cost(planned(hall, objective, ahead), hall) < share * ahead.cost(plain, hall)
    assert amount(planned(hall, objective, round_it), hall, "turning") < 0.5 * amount(plain, hall, "turning")


def test_what_is_dear_is_done_where_nothing_else_is_possible_and_the_answer_says_where() -> None:
    corridor = Scene(box(-1, -0.5, 2, 1), [], workspace=box(0, 0, 2.2, 9), start=Pose(1.1, 1), goal=Pose(1.1, 8))
    path = plan(corridor, preferences=Preferences(sideways=100))
    assert isinstance(path, Path)
    (part,) = unwanted(path, corridor, Preferences(sideways=100))
    assert part.kind == "sideways" and part.amount == pytest.approx(7, rel=1e-3)
    wall = Scene(corridor.robot, [box(-1, 4, 9, 0.1)], workspace=box(0, 0, 2.2, 9), start=(1.1, 1, 0), goal=(1.1, 8, 0))
    assert plan(wall, preferences=EVERYTHING) == plan(wall)


def test_the_core_and_the_report_count_the_same() -> None:
    rng = np.random.default_rng(1)
    scene = Scene(box(-1, -0.5, 3, 1), [])
    for _ in range(20):
        preferences = Preferences(*rng.uniform(1, 9, 3))
        poses = [Pose(*row) for row in rng.uniform(-3, 3, (6, 3)).tolist()]
        costs = math.hypot(2, 0.5), *preferences.factors
        ends = [*map(end_of, poses)]
        known = known_scene(MotionChecker(scene))
        searcher = Searcher(known, [place for _, place in ends], costs, (0.0, 0.0, 0.0), None)
        path = Path(poses[0], [motion_between(a, b) for a, b in pairwise(poses)])
        core = searcher.shortener(ends, 0).length()
        assert preferences.cost(path, scene) == pytest.approx(core, rel=1e-9)
        # counted at an axle, as the path of the axle's poses
        x, y, angle = rng.uniform(-2, 2, 3).tolist()
        inverse = Pose(x, y, angle).inverse()
        robot = [end_of(pose @ inverse) for pose in poses]
        at_axle = Searcher(known, [place for _, place in robot], costs, (x, y, angle), None)
        assert at_axle.shortener(robot, 0).length() == pytest.approx(core, rel=1e-9)


def test_a_stop_costs_a_quarter_of_a_cusp_unless_another_cost_is_given() -> None:
    scene = Scene(box(-1, -0.5, 3, 1), [])
    motions = [Translation((1, 0)), Rotation((1, 2), {"tau": "1/3"}), Rotation((1, 2), {"tau": "-1/9"})]
    path = Path(Pose(0, 0), motions, scene=scene, vehicle=Car(2))
    assert (path.stops, path.cusps) == (2, 1)
    free = Preferences(cusp=0, stop=0).cost(path, scene)
    assert Preferences(cusp=8).cost(path, scene) == pytest.approx(free + 8 + 2)
    assert Preferences().cost(path, scene) == pytest.approx(free + 3 + 3 / 4)
    assert Preferences(cusp=8, stop=1).cost(path, scene) == pytest.approx(free + 9)
    turn = Path(Pose(0, 0), [Translation((1, 0)), Rotation((1, 0), "90deg")], vehicle=DifferentialDrive())
    free = Preferences(stop=0).cost(turn, scene)
    assert Preferences(stop=1).cost(turn, scene) == pytest.approx(free + 1) and turn.stops == 1
    for value in (-1, math.nan, math.inf):
        with pytest.raises(ValueError, match=f"stop={value}: give a length of 0 or more"):
            Preferences(stop=value)


@pytest.mark.slow
def test_dear_stops_are_avoided() -> None:
    scene = Scene(box(-1, -0.5, 3, 1), [box(4, -9, 1, 9.5), box(9, 1, 1, 9)], start=(0, 0, 0), goal=(14, 2, 0))
    few, many = (plan(scene, vehicle=Car(3), preferences=Preferences(stop=stop)) for stop in (9, 0))
    assert isinstance(few, Path) and isinstance(many, Path)
    assert few.stops <= many.stops and Preferences(stop=9).cost(few, scene) < Preferences(stop=9).cost(many, scene)


def test_all_ones_are_no_preferences(hall: Scene) -> None:
    path = plan(hall)
    assert isinstance(path, Path) and path == plan(hall, preferences=Preferences())
    assert unwanted(path, hall, Preferences()) == ()
    radius = math.hypot(1.6, 0.5)
    assert Preferences().cost(path, hall) == pytest.approx(path.length + radius * path.turning)


@pytest.mark.parametrize("factor", [0.5, math.nan, math.inf])
def test_factors_are_one_or_more(factor: float) -> None:
    with pytest.raises(ValueError, match="give a factor of 1 or more"):
        Preferences(backward=factor)
