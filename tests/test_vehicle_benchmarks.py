"""Parts of the benchmark of cars: its questions, the check by controls and shapely, and the rival's input."""

from __future__ import annotations

import importlib
import subprocess
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

import cfree
from cfree import Car, Path, Pose, Rotation, Scene, Translation
from shapes import box


@pytest.fixture
def load(monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> Any:
    monkeypatch.syspath_prepend(str(request.config.rootpath / "benchmarks"))
    return importlib.import_module


@pytest.mark.parametrize("name", ["parking1", "parking2", "parking3", "warehouse1", "warehouse2"])
def test_real_scenes_have_ends_that_touch_nothing(load: Any, name: str) -> None:
    scene = load("vehicle_scenes").real(name).fresh()
    for pose in (scene.start, scene.goal):
        assert cfree.clearance(Path(pose, []), scene).least > 0.4 * (name != "parking1")
    assert isinstance(cfree.plan(scene, improve=0), Path)


def test_seeded_cars_are_the_same_each_time(load: Any) -> None:
    seeded = load("vehicle_scenes").seeded
    assert seeded("maze", 0).car == seeded("maze", 0).car
    assert seeded("maze", 0).fresh() == seeded("maze", 0).fresh()


def test_a_robot_gets_round_aisles_of_more_than_the_least_width_only(load: Any) -> None:
    scenes = load("vehicle_scenes")
    questions = [scenes.aisle(k) for k in range(scenes.AISLES)]
    widths = [float(question.name.split()[1]) for question in questions]
    assert scenes.least_width() < widths[0] < 1.02 * scenes.least_width()
    assert widths[-1] == pytest.approx(1.3 * scenes.least_width(), rel=1e-3)
    assert isinstance(cfree.plan(questions[0].fresh(), improve=0), Path)
    narrow = scenes.aisle(-2, 1000)  # narrower by 0.03 %
    assert isinstance(cfree.plan(narrow.fresh(), improve=0), cfree.Separated)


ROOM = Scene(
    box(-1, "-1/2", 1, "1/2")[0], [box(4, 2, 6, 4)[0]], bounds=(-5, -5, 9, 9), workspace=box(-9, -9, 12, 12)[0]
)


def test_controls_lead_along_the_exact_path_and_shapely_finds_it_free(load: Any) -> None:
    driven = load("integrate").driven
    car = Car(2, axle=("-1/2", 0))
    motions = [Translation((2, 0)), Rotation(("3/2", -2), "-1rad"), Translation((0, 0)), Rotation(("3/2", -2), "3rad")]
    answer = driven(Path(Pose(0, 0), motions, vehicle=car), ROOM)
    assert answer.is_right and answer.miss < 1e-9 and answer.looks > 500


def test_a_clipping_path_or_a_wrong_pose_is_told(load: Any) -> None:
    driven = load("integrate").driven
    car = Car(2, axle=("-1/2", 0))
    ahead = Path(Pose(0, "5/2"), [Translation((8, 0))], vehicle=car)
    assert not driven(ahead, ROOM).is_right
    assert driven(ahead[:0], ROOM).is_right
    near = Path(Pose(0, Fraction(3, 2)), [Translation((8, 0))], vehicle=car)  # it touches the obstacle
    assert driven(near, ROOM).is_right
    poses = (*near.poses[:-1], Pose(8, Fraction(3, 2) + Fraction(1, 10**5)))
    wrong = replace(near)
    wrong.__dict__["poses"] = poses
    assert not driven(wrong, ROOM).is_right


def test_the_rival_gets_exact_numbers_and_the_axle_s_poses(load: Any) -> None:
    scene = replace(ROOM, start=Pose("1/3", 0), goal=Pose(5, 0, "90deg"))
    lines = list(load("ompl_vehicles").question(scene, Car("5/2", axle=("-1/2", 0), gears="forward"), 0.001))
    assert lines[0] == "robot -1 -1/2 1 -1/2 1 1/2 -1 1/2"
    assert "bounds -5 -5 9 9" in lines and "forward" in lines
    assert "car 2.5 -0.5 0.0 0.0" in lines
    goal = next(line.split()[1:] for line in lines if line.startswith("goal"))
    assert [float(number) for number in goal] == pytest.approx([5, -0.5, 1.5707963267948966])


@pytest.mark.slow
def test_the_rival_finds_a_path_and_tells_a_clip(load: Any) -> None:
    rival = load("ompl_vehicles")
    try:
        program = rival.compiled()
    except subprocess.CalledProcessError:  # the core's library is of another build
        program = None
    if program is None:
        pytest.skip("libompl-dev is not installed, or the core's library does not fit it")
    scene = replace(ROOM, start=Pose(0, 0), goal=Pose(8, 5, "90deg"))
    first, best = rival.runs(scene, Car(2, axle=("-1/2", 0)), ["first 1 10", "best 1 1"])
    assert first.paths == 1 and first.seconds < 10 and first.clipped == 0 and first.length >= 9
    assert best.length <= first.length
    coarse = rival.runs(scene, Car(2, axle=("-1/2", 0)), ["best 1 1"], step=0.1)
    assert coarse[0].clipped > 0
