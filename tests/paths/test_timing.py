"""Times along paths: within limits, at rest where wheels turn, equal to a numeric integration."""

import math
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.support.vehicles import drive

from cfree import Car, Curved, DifferentialDrive, Path, Pose, Rotation, Scene, Translation, timed
from cfree.paths import Stop, Timed

ROBOT = Scene(robot=[(-1, -1), (3, -1), (3, 1), (-1, 1)])
CAR = Car(2, axle=("1/2", "1/3"), heading={"tau": "1/2"})
DRIVE = DifferentialDrive(axle=(0, "1/2"))
LINES = st.tuples(st.just("line"), st.sampled_from(["3", "-2", "1/7", "-1/5", "9"]), st.just(0))
TAUS = st.sampled_from([Fraction(1, 3), Fraction(-1, 2), Fraction(1, 40), Fraction(-1)])
ARCS = st.tuples(st.just("arc"), st.sampled_from(["2", "-2", "5/2", "-7", "100"]), TAUS)
TURNS = st.tuples(st.just("turn"), st.just("0"), TAUS)
LIMITS = st.fixed_dictionaries(
    {"speed": st.floats(0.1, 10), "acceleration": st.none() | st.floats(0.05, 5), "steer_rate": st.floats(0.1, 3)}
)


@st.composite
def paths(draw: st.DrawFn) -> Path:
    """Draw a path of a car or a differential drive."""
    vehicle, kinds = draw(st.sampled_from([(CAR, LINES | ARCS), (DRIVE, LINES | ARCS | TURNS)]))
    parts = draw(st.lists(kinds, min_size=1, max_size=6))
    return drive(vehicle, Pose("1/2", 2, {"tau": "1/5"}), parts, ROBOT)


def straight(length: float, **limits: Any) -> Timed:
    return timed(Path((0, 0, 0), [Translation((length, 0))], vehicle=Car(2), scene=ROBOT), **limits)


def test_a_long_line_is_a_trapezoid_and_a_short_one_a_triangle() -> None:
    assert straight(10, speed=2, acceleration=0.5).duration == pytest.approx(10 / 2 + 2 / 0.5)
    assert straight(6, speed=2, acceleration=0.5).duration == pytest.approx(2 * math.sqrt(6 / 0.5))
    assert straight(6, speed=2, acceleration=0.5).speeds([math.sqrt(12)])[0] == pytest.approx(math.sqrt(3))
    assert straight(10, speed=2).duration == 5


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(paths(), LIMITS, st.sampled_from(["all", "cusps"]))
def test_speeds_integrated_over_time_are_the_travel(path: Path, limits: dict[str, Any], stops: Any) -> None:
    its = timed(path, **limits, wheelbase=1.5, stops=stops)
    t = np.linspace(0, its.duration, 20_001)
    middles = (t[1:] + t[:-1]) / 2
    travel = float(its.speeds(middles).sum() * (t[1] - t[0]))
    assert travel == pytest.approx(
        math.fsum(part.length for part in path.driving), rel=1e-3, abs=10 * limits["speed"] * (t[1] - t[0])
    )
    ends = its.sample([0.0, its.duration])
    assert np.allclose(ends.xy, [[float(q.x), float(q.y)] for q in (path.start, path.goal)], atol=1e-9)


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(paths(), LIMITS)
def test_no_point_is_faster_and_no_speed_changes_faster_than_the_limits(path: Path, limits: dict[str, Any]) -> None:
    its = timed(path, **limits, wheelbase=1.5)
    t = np.linspace(0, its.duration, 4001)
    poses, dt = its.sample(t), t[1] - t[0]
    vehicle = path.vehicle
    assert vehicle is not None
    points = np.vstack([ROBOT.robot[0].vertices, [[float(c) for c in vehicle.axle]]])
    steps = np.hypot(*np.diff(poses.apply(points), axis=0).transpose(2, 0, 1))
    assert steps.max() <= limits["speed"] * dt * (1 + 1e-6) + 1e-12
    if limits["acceleration"] is not None:
        most = limits["acceleration"] * dt
        assert np.abs(np.diff(its.speeds(t))).max() <= most * (1 + 1e-6) + 1e-9
        assert np.abs(np.diff(steps / dt, axis=0)).max() <= most * 1.01 + limits["speed"] * 1e-2


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(paths(), LIMITS)
def test_a_vehicle_stands_at_its_stops_for_as_long_as_its_wheels_turn(path: Path, limits: dict[str, Any]) -> None:
    its = timed(path, **limits, wheelbase=1.5)
    for stop in its.stops:
        assert stop.pause == pytest.approx(stop.wheels / limits["steer_rate"])
        moments = np.linspace(stop.time, stop.time + stop.pause, 5)
        here, place = its.sample(moments), path.poses[stop.motion]
        assert np.allclose(here.xy, [float(place.x), float(place.y)], atol=1e-9)
        assert stop.pause == 0 or not its.speeds(moments[1:-1]).any()
    moving = [stretch.duration for stretch in its.stretches]
    assert its.duration == pytest.approx(math.fsum(moving) + math.fsum(stop.pause for stop in its.stops))


def test_pauses_are_the_change_of_the_steering_angle_over_its_rate() -> None:
    path = drive(Car(2, wheelbase=2), Pose(0, 0), [("line", 3, 0), ("arc", 2, "1/3"), ("arc", -4, "1/3")], ROBOT)
    its = timed(path, speed=1, steer_rate=math.radians(10))
    assert [(stop.why, stop.motion) for stop in its.stops] == [("steering", 1), ("cusp", 2)]
    assert [stop.pause for stop in its.stops] == pytest.approx([4.5, 4.5 + math.degrees(math.atan(0.5)) / 10])
    assert its.stops[0].time == pytest.approx(3)
    assert timed(path, speed=1, steer_rate=math.radians(10), wheelbase=4).stops[0].pause > 6
    assert timed(path, speed=1, steer_rate="10deg") == timed(path, speed=1, steer_rate="10 °") == its
    assert timed(path, speed=1, steer_rate="1/4") == timed(path, speed=1, steer_rate="0.25rad")


def test_wheels_that_turn_by_less_than_a_hundredth_of_a_degree_need_no_stop() -> None:
    angle = math.radians(0.01)
    for factor, count in ((0.99, 0), (1.01, 1)):
        radius = Fraction(2 / math.tan(factor * angle))
        path = drive(Car(2, wheelbase=2), Pose(0, 0), [("line", 3, 0), ("arc", radius, "1/100000")], ROBOT)
        assert path.stops == len(timed(path, speed=1).stops) == count


def test_a_differential_drive_stops_at_cusps_and_turns_in_place_only() -> None:
    parts = [("line", 3, 0), ("arc", 2, "1/3"), ("turn", 0, "1/2"), ("line", 1, 0), ("line", -1, 0)]
    path = drive(DRIVE, Pose(0, 0), parts, ROBOT)
    its = timed(path, speed=1)
    assert [(stop.why, stop.motion, stop.pause) for stop in its.stops] == [
        ("turning", 2, 0.0), ("turning", 3, 0.0), ("cusp", 4, 0.0)
    ]  # fmt: skip
    assert path.stops == 3
    forklift = timed(path, speed=1, steer_rate=1, wheelbase=2)
    across = [stop.wheels for stop in forklift.stops if stop.why == "turning"]
    assert across == pytest.approx([math.pi / 2 - math.atan(1), math.pi / 2])
    assert forklift.stops[0] == Stop(1, "steering", math.pi / 4, 3.0, math.pi / 4)


def test_cusps_only_drives_through_jumps_that_leave_room_for_the_wheels_to_turn() -> None:
    parts = [("line", 3, 0), ("arc", 2, "1/3"), ("line", "1/100", 0), ("line", -1, 0)]
    path = drive(Car(2, wheelbase=2), Pose(0, 0), parts, ROBOT)
    slow = timed(path, speed=0.1, steer_rate=1, stops="cusps")
    assert [ramp.motion for ramp in slow.through] == [1]  # the last line is too short
    assert [(stop.why, stop.motion) for stop in slow.stops] == [("steering", 2), ("cusp", 3)]
    fast = timed(path, speed=10, steer_rate=1, stops="cusps")
    assert not fast.through and len(fast.stops) == 3
    at_once = timed(path, speed=10, stops="cusps")
    assert [stop.why for stop in at_once.stops] == ["cusp"] and not at_once.through


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(paths(), LIMITS, st.floats(0.05, 2), st.floats(0.02, 1.5))
def test_rows_are_in_order_and_doubled_at_pauses(path: Path, limits: dict[str, Any], step: float, turn: float) -> None:
    its = timed(path, **limits, wheelbase=1.5)
    rows = its.rows(step, turn)
    assert (np.diff(rows.seconds) >= 0).all() and rows.seconds[0] == 0 and rows.seconds[-1] == its.duration
    again = np.flatnonzero(np.diff(rows.index) == 0)
    assert len(again) == sum(stop.pause > 0 for stop in its.stops)
    for k, stop in zip(again, (stop for stop in its.stops if stop.pause > 0), strict=True):
        assert rows.seconds[k + 1] - rows.seconds[k] == pytest.approx(stop.pause)
        assert rows.motion[k + 1] == stop.motion > rows.motion[k]
        assert not rows.speeds[[k, k + 1]].any() and not rows.turn_rates[[k, k + 1]].any()
    assert rows.speeds[0] == rows.speeds[-1] == 0
    sampled, poses = its.sample(rows.seconds), path.sample(step, turn)
    assert np.allclose(sampled.xy, poses.xy[rows.index], atol=1e-6)


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(paths(), st.floats(-150, 150), st.floats(-150, 150))
def test_limits_of_any_size_give_finite_times_or_an_error(path: Path, speed: float, acceleration: float) -> None:
    try:
        its = timed(path, speed=10**speed, acceleration=10**acceleration)
    except ValueError as error:
        assert "longer than numbers go" in str(error)
        return
    assert math.isfinite(its.duration) and its.duration > 0
    assert np.isfinite(its.rows(1.0, 1.0).seconds).all()


@settings(deadline=None, max_examples=40)
@given(paths(), LIMITS)
def test_times_scale_with_the_limits(path: Path, limits: dict[str, Any]) -> None:
    acceleration = limits["acceleration"]
    faster = {"speed": 2 * limits["speed"], "acceleration": acceleration and 4 * acceleration}
    one, other = timed(path, speed=limits["speed"], acceleration=acceleration), timed(path, **faster)
    assert one.duration == pytest.approx(2 * other.duration)


def test_motions_that_move_nothing_take_no_time() -> None:
    still = Translation((0, 0))
    motions = [still, Translation((3, 0)), still, still, Rotation((3, 2), {"tau": "1/2"}), still]
    for acceleration in (None, 0.5):
        its = timed(
            Path((0, 0, 0), motions, vehicle=Car(2, wheelbase=2), scene=ROBOT),
            speed=1, acceleration=acceleration, steer_rate=1,
        )  # fmt: skip
        plain = timed(
            Path((0, 0, 0), [motions[1], motions[4]], vehicle=Car(2, wheelbase=2), scene=ROBOT),
            speed=1, acceleration=acceleration, steer_rate=1,
        )  # fmt: skip
        assert its.duration == pytest.approx(plain.duration)
        assert [stop.motion for stop in its.stops] == [4]
        rows = its.rows(1.0, 1.0)
        assert np.isfinite(rows.speeds).all() and (np.diff(rows.seconds) >= 0).all()


def test_a_path_without_motions_takes_no_time() -> None:
    for vehicle in (None, Car(2)):
        its = timed(Path((1, 2, 0), [], vehicle=vehicle, scene=ROBOT), speed=1)
        assert its.duration == 0 and its.sample([0.0, 1.0]).xy.tolist() == [[1, 2], [1, 2]]
        assert its.rows(1.0, 1.0).seconds.tolist() == [0.0] and its.speeds([0.0]).tolist() == [0.0]


@pytest.mark.parametrize(
    ("vehicle", "limits", "said"),
    [
        (CAR, {"speed": 0}, "speed 0: give a positive one"),
        (CAR, {"speed": -1}, "speed -1: give a positive one"),
        (CAR, {"speed": math.nan}, "speed nan: give a positive one"),
        (CAR, {"speed": math.inf}, "speed inf: give a positive one"),
        (CAR, {"speed": 1, "acceleration": 0}, "acceleration 0: give a positive one"),
        (CAR, {"speed": 1, "acceleration": math.nan}, "acceleration nan"),
        (CAR, {"speed": 1, "steer_rate": -1, "wheelbase": 1}, "steer_rate -1: give a positive one"),
        (CAR, {"speed": 1, "steer_rate": "-5deg", "wheelbase": 1}, "steer_rate: '-5deg'; give an angle a second"),
        (CAR, {"speed": 1, "steer_rate": "fast", "wheelbase": 1}, "steer_rate: 'fast'; give an angle a second"),
        (CAR, {"speed": 1, "steer_rate": 1, "wheelbase": 0}, "wheelbase 0: give a positive one"),
        (CAR, {"speed": 1, "steer_rate": 1}, "steer_rate: the wheelbase is missing; give it as well"),
        (CAR, {"speed": 1, "stops": "none"}, 'stops: \'none\'; give "all" or "cusps"'),
        (DRIVE, {"speed": 1, "steer_rate": 1}, "steer_rate: the wheelbase is missing"),
        (DRIVE, {"speed": 1, "wheelbase": 1}, "wheelbase: a differential drive has one if its wheel is steered"),
        (None, {"speed": 1, "steer_rate": 1, "wheelbase": 1}, "steer_rate, wheelbase: of a vehicle's path only"),
        (None, {"speed": 1, "acceleration": 1}, "acceleration: of a vehicle's path only"),
        (None, {"speed": 1, "stops": "cusps"}, "stops: of a vehicle's path only"),
    ],
)
def test_limits_that_do_not_fit_are_refused(vehicle: Any, limits: dict[str, Any], said: str) -> None:
    path = Path((0, 0, 0), [Rotation((0, 0), 0)], vehicle=vehicle, scene=ROBOT)
    with pytest.raises(ValueError, match=said.replace("(", r"\(")):
        timed(path, **limits)


def test_a_missing_scene_is_named_and_a_round_robot_turns_with_its_radius() -> None:
    with pytest.raises(ValueError, match="no scene; give the one whose robot moves"):
        timed(Path((0, 0, 0), []), speed=1)
    disc = Scene(robot=Curved.circle((0, 0), 1))
    path = Path((0, 0, 0), [Translation((3, 0))])
    turn = Path((0, 0, 0), [Rotation((0, 0), "90deg")], curved=disc)
    assert math.pi / 2 <= timed(turn, speed=1).duration <= 1.001 * math.pi / 2
    assert timed(path, disc, speed=1).duration == 3
    assert timed(path, disc.outer(0.1), speed=1).duration == 3
    assert timed(replace(path, scene=disc.outer(0.1)), disc, speed=1).duration == 3
