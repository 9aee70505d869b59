"""Paths of cars and differential drives: they exist wherever the robot has a path with room, and can be driven."""

from __future__ import annotations

import copy
import math
import pickle
import random
import signal
import threading
import time
from fractions import Fraction
from typing import Any

import pytest

import cfree
from cfree import (
    Car,
    Curved,
    DifferentialDrive,
    MotionChecker,
    Path,
    Pose,
    Preferences,
    Scene,
    Separated,
    Stuck,
    UndecidedError,
    clearance,
    is_drivable,
    plan,
    plan_many,
)
from cfree.curves import Arc
from cfree.planning import vehicles
from cfree.scene.digest import stamp_of
from second_opinion import verified_in_a_file
from vehicles import VEHICLES, faults, room


def box(x0: Any, y0: Any, x1: Any, y1: Any) -> list[tuple[Any, Any]]:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


WALL = Scene(box(0, 0, 1, 1), [box(2, -9, 3, 1)], bounds=(-5, -5, 5, 5), start=(-2, 0, 0), goal=(4, 0, 0))
CLOSED = Scene(box(0, 0, 1, 1), [box(2, -9, 3, 9)], bounds=(-5, -5, 5, 5), start=(-2, 0, 0), goal=(4, 0, 0))
PARKING = cfree.load_scene("examples/scenes/benchmr_parking1.json")
CAR = Car(4, axle=("-1.3", "0.111"))


def path_in(scene: Scene, vehicle: Any, **options: Any) -> Path:
    """The path of a vehicle, checked: free, drivable, exactly to the goal, and free by integration and shapely."""
    path = plan(scene, vehicle=vehicle, **options)
    assert isinstance(path, Path), path
    assert (path.start, path.vehicle) == (scene.start, vehicle)
    assert path.is_free(MotionChecker(scene)) and is_drivable(path, vehicle)
    assert faults(scene, path) == []
    return path


@pytest.mark.parametrize("vehicle", VEHICLES, ids=repr)
def test_a_path_of_a_vehicle_is_free_and_drivable_and_ends_exactly_at_the_goal(
    vehicle: Car | DifferentialDrive,
) -> None:
    assert path_in(WALL, vehicle, improve=0).goal == WALL.goal


@pytest.mark.parametrize("seed", [0, 1, 3, 5])
def test_a_vehicle_has_a_path_if_and_only_if_the_robot_has_one(seed: int) -> None:
    rng = random.Random(f"quick {seed}")
    scene, vehicle = room(rng), VEHICLES[seed]
    plain = plan(scene, improve=0)
    answer = plan(scene, vehicle=vehicle, improve=0)
    assert isinstance(answer, Path) == isinstance(plain, Path)
    assert not isinstance(answer, Path) or faults(scene, answer) == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
def test_random_rooms_of_the_fuzz_family(seed: int) -> None:
    from collections import Counter

    from fuzz_vehicles import mistakes

    assert mistakes(seed, Counter(), []) == []


@pytest.mark.parametrize("vehicle", [Car(1), Car(1, gears="forward"), DifferentialDrive()])
def test_a_separation_is_a_proof_for_every_vehicle(vehicle: Any) -> None:
    answer = plan(CLOSED, vehicle=vehicle)
    assert isinstance(answer, Separated) and answer == plan(CLOSED)


@pytest.mark.slow
def test_a_car_parks_and_keeps_half_of_the_distance_that_the_robot_keeps() -> None:
    robot, path = plan(PARKING), path_in(PARKING, CAR)
    assert isinstance(robot, Path)
    of_robot, of_car = clearance(robot, PARKING), clearance(path, PARKING)
    assert of_robot and of_car
    assert of_car.least >= min(of_robot.least / 2, 0.2) * 0.98
    assert path.cusps <= 6


@pytest.mark.slow
def test_short_paths_keep_no_distance_and_cost_less() -> None:
    short, balanced = (path_in(PARKING, CAR, objective=objective) for objective in ("short", "balanced"))
    cost = Preferences().cost
    assert cost(short, PARKING) <= cost(balanced, PARKING) * 1.05


def test_the_scene_has_the_vehicle_unless_another_is_given() -> None:
    scene = Scene(WALL.robot, WALL.obstacles, bounds=WALL.bounds, start=WALL.start, goal=WALL.goal, vehicle=Car(1))
    path, robot = plan(scene, improve=0), plan(scene, vehicle="any", improve=0)
    assert isinstance(path, Path) and isinstance(robot, Path)
    assert (path.vehicle, path.cusps > 0 or len(path.driving) > 0) == (Car(1), True)
    assert (robot.vehicle, robot.driving, robot.cusps) == (None, (), 0)
    other = plan(scene, vehicle=DifferentialDrive(), improve=0)
    assert isinstance(other, Path) and other.vehicle == DifferentialDrive()


def test_the_digest_of_a_scene_does_not_depend_on_its_vehicle() -> None:
    scenes = [Scene(WALL.robot, WALL.obstacles, vehicle=vehicle) for vehicle in (None, Car(1), DifferentialDrive())]
    assert len({stamp_of(scene) for scene in scenes}) == 1
    assert len(set(scenes)) == 3


def test_start_and_goal_may_be_the_same() -> None:
    path = plan(WALL, (-2, 0, 0), (-2, 0, 0), vehicle=Car(1))
    assert isinstance(path, Path) and (len(path), path.cusps, path.driving) == (0, 0, ())


@pytest.mark.parametrize("across", ["1", "1e-3", "1e-9", "1e-15"])
def test_a_step_sideways_is_as_small_as_asked(across: str) -> None:
    path = plan(WALL, (-2, 2, 0), (-2, 2 + Fraction(across), 0), vehicle=Car(1), improve=0)
    assert isinstance(path, Path) and path.goal == Pose(-2, 2 + Fraction(across))
    assert path.length < 8 * math.sqrt(float(Fraction(across))) + 1e-12


@pytest.mark.slow
def test_ctrl_c_ends_shortening_with_the_path_so_far(monkeypatch: pytest.MonkeyPatch) -> None:
    shorten, has_begun, main = vehicles._shortened, threading.Event(), threading.main_thread().ident
    assert main is not None

    def shortened(*arguments: Any) -> Any:
        has_begun.set()
        return shorten(*arguments)

    def interrupt() -> None:
        if has_begun.wait(60):
            time.sleep(0.2)
            signal.pthread_kill(main, signal.SIGINT)

    monkeypatch.setattr(vehicles, "_shortened", shortened)
    threading.Thread(target=interrupt).start()
    begin = time.monotonic()
    path = path_in(PARKING, CAR, improve=120)
    assert path.goal == PARKING.goal and time.monotonic() - begin < 60


def test_half_a_turn_in_place() -> None:
    drive = plan(WALL, (-2, 2, 0), (-2, 2, "180deg"), vehicle=DifferentialDrive())
    car = plan(WALL, (-2, 2, 0), (-2, 2, "180deg"), vehicle=Car(1))
    assert isinstance(drive, Path) and isinstance(car, Path)
    assert ({part.gear for part in drive.driving}, drive.length) == ({"turning"}, 0)
    assert "turning" not in {part.gear for part in car.driving} and car.cusps >= 1


@pytest.mark.slow
def test_a_clearance_is_kept() -> None:
    path = path_in(WALL, Car(1), clearance="0.3")
    place = clearance(path, WALL)
    assert place and place.least >= 0.3 * (1 - 1e-9) and path.clearance == Fraction(3, 10)
    assert verified_in_a_file(WALL, path).verified


@pytest.mark.slow
def test_any_of_several_goals_and_places_will_do() -> None:
    near, far = Pose(-1, 2), Pose(4, 0)
    assert path_in(WALL, Car(1), goal=[far, near]).goal == near
    at_place = path_in(WALL, Car(1), goal=(-1, 2))
    assert (at_place.goal.x, at_place.goal.y) == (-1, 2)


@pytest.mark.slow
def test_many_queries_are_answered_in_their_order() -> None:
    queries = [((-2, 0, 0), (4, 0, 0)), ((4, 0, 0), (-2, 0, 1))]
    answers = plan_many(WALL, queries, vehicle=Car(1), improve=0)
    assert [answer.goal for answer in answers] == [Pose(4, 0), Pose(-2, 0, 1)]
    assert all(isinstance(answer, Path) and answer.vehicle == Car(1) for answer in answers)
    assert answers == plan_many(WALL, queries, vehicle=Car(1), improve=0, threads=1)


@pytest.mark.slow
def test_the_same_query_has_the_same_answer() -> None:
    assert plan(WALL, vehicle=Car(1)) == plan(WALL, vehicle=Car(1))


@pytest.mark.slow
def test_preferences_count_at_the_axle_point() -> None:
    car = Car(1, axle=(0, "1/2"))
    plain = path_in(WALL, car, preferences=Preferences(backward=1, cusp=0))
    dear = path_in(WALL, car, preferences=Preferences(backward=5))

    assert Preferences(backward=5).cost(dear, WALL) <= 1.2 * Preferences(backward=5).cost(plain, WALL)
    cost = sum(part.length * (5 if part.gear == "backward" else 1) for part in dear.driving)
    cost += dear.cusps + 0.25 * (dear.stops - dear.cusps)
    assert Preferences(backward=5).cost(dear, WALL) == pytest.approx(cost)


def test_a_cusp_costs_the_length_of_the_robot_by_default_a_stop_a_quarter_and_backward_half_more() -> None:
    path = plan(WALL, vehicle=Car(1), improve=0)
    assert isinstance(path, Path)
    cost = sum(part.length * (1.5 if part.gear == "backward" else 1) for part in path.driving)
    cost += path.cusps + 0.25 * (path.stops - path.cusps)
    assert Preferences().cost(path, WALL) == pytest.approx(cost)


def test_a_robot_of_several_parts() -> None:
    scene = Scene(
        [box(0, 0, 1, 1), box(3, 0, 4, 1)], [box(2, -9, 3, 1)], bounds=(-9, -5, 9, 8), start=(-5, 0, 0), goal=(4, 0, 0)
    )
    assert path_in(scene, Car(2), improve=0).goal == scene.goal


@pytest.mark.slow
def test_round_shapes_are_decided_like_the_rest() -> None:
    shapes = [Curved.circle((-1, 3), 1), box(2, -9, 3, 1)]
    scene = Scene(Curved.circle((0, 0), "1/2"), shapes, bounds=(-5, -5, 5, 5), start=(-2, 0, 0), goal=(4, 0, 0))
    path = plan(scene, vehicle=Car(1), improve=0)
    assert isinstance(path, Path) and path.curved == scene and path.vehicle == Car(1)
    assert is_drivable(path, Car(1)) and cfree.verify.answer(scene, path).verified


@pytest.mark.slow
@pytest.mark.parametrize("vehicle", [Car(1), Car(1, gears="forward"), DifferentialDrive()])
def test_a_separation_among_round_shapes_is_a_proof_for_every_vehicle(vehicle: Any) -> None:
    shapes = [Curved.circle((2, 0), 1), box(2, -9, 3, 9)]
    scene = Scene(Curved.circle((0, 0), "1/2"), shapes, bounds=(-5, -5, 5, 5), start=(-2, 0, 0), goal=(4, 0, 0))
    answer = plan(scene, vehicle=vehicle, improve=0)
    assert isinstance(answer, Separated) and answer == plan(scene, improve=0)


def test_a_planner_keeps_its_vehicle_in_copies_and_is_another_with_another() -> None:
    planner = cfree.Planner(WALL, vehicle=Car(1))
    for other in (copy.copy(planner), copy.deepcopy(planner), pickle.loads(pickle.dumps(planner))):
        assert (other.vehicle, other) == (Car(1), planner)
    assert planner != cfree.Planner(WALL) and planner != cfree.Planner(WALL, vehicle=Car(2))


def test_a_first_path_needs_no_balanced_path_of_the_robot(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither where few words suffice, nor where the robot's first path is too near to obstacles."""
    monkeypatch.setattr(vehicles, "_roomy", lambda *_: pytest.fail("a path was balanced"))
    for scene, car, most in ((WALL, Car(1), 30), (PARKING, CAR, 60)):
        assert path_in(scene, car, improve=0).cusps <= most


@pytest.mark.parametrize("radius", ["1e-9", "1e-12", "1e-100", ("1e-15", 2), ("1/3", "1e-30")])
def test_a_car_drives_with_any_tiny_radius(radius: Any) -> None:
    car = Car(radius, axle=("-1/3", 0))
    path = plan(WALL, vehicle=car, improve=0)
    assert isinstance(path, Path) and is_drivable(path, car)
    assert path.cusps <= 8 and path.is_free(MotionChecker(WALL)) and path.goal == WALL.goal


@pytest.mark.slow
def test_too_many_manoeuvres_are_an_error_with_a_proof_that_a_path_exists() -> None:
    with pytest.raises(UndecidedError, match=r"a path of a car with a turning radius of 1e\+09 exists") as caught:
        plan(WALL, vehicle=Car(10**9))
    assert isinstance(caught.value.path, Path) and caught.value.manoeuvres > 1000
    assert "its turning radius is 1e+09, correct it, or give the robot more room" in str(caught.value)
    assert verified_in_a_file(WALL, caught.value.path).verified
    place = clearance(caught.value.path, WALL)
    assert place and place.least > 0


@pytest.mark.slow
def test_too_many_manoeuvres_with_a_clearance_are_proved_by_a_path_that_keeps_it() -> None:
    with pytest.raises(UndecidedError, match=r"a path of a car") as caught:
        plan(WALL, vehicle=Car(10**9), clearance="0.3", improve=0)
    proof = caught.value.path
    assert isinstance(proof, Path) and (proof.scene, proof.clearance) == (WALL, Fraction(3, 10))
    assert verified_in_a_file(WALL, proof).verified


@pytest.mark.slow
@pytest.mark.long
def test_too_many_manoeuvres_among_round_shapes_are_told_at_once() -> None:
    scene = Scene(Curved.circle((0, 0), "1/2"), [Curved.circle((2, 0), 1)], bounds=(-5, -5, 5, 5))
    with pytest.raises(UndecidedError, match=r"^a path of a car") as caught:
        plan(scene, (-2, 0, 0), (4, 0, 0), vehicle=Car(10**9), improve=0)
    assert caught.value.manoeuvres > 1000
    assert isinstance(caught.value.path, Path) and caught.value.path.curved == scene
    assert cfree.verify.answer(scene, caught.value.path).verified


@pytest.mark.parametrize("exponent", [9, 17, 30, 150])
def test_an_axle_far_away_is_no_fault_and_named(exponent: int) -> None:
    for vehicle in (Car(1, axle=(10**exponent, 0)), DifferentialDrive(axle=(0, 10**exponent))):
        with pytest.raises(UndecidedError, match=rf" exists, .*axle point is 1e\+{exponent:02} away from the robot"):
            plan(WALL, vehicle=vehicle, improve=0)


def test_an_axle_somewhat_away_is_driven_about() -> None:
    for vehicle in (Car(1, axle=(9, -9)), DifferentialDrive(axle=(-20, 3))):
        assert path_in(WALL, vehicle, improve=0).goal == WALL.goal


def test_bounds_may_cut_the_axle_line() -> None:
    scene = Scene(box(0, 0, 1, 1), [], bounds=(0, 0, 5, 5), start=("1/10", 1, "90deg"), goal=(4, "1/10", 0))
    assert path_in(scene, Car(1, axle=(0, -2)), improve=0).goal == scene.goal


def test_a_vehicle_without_reverse_gear_goes_forward_only() -> None:
    scene = Scene(WALL.robot, WALL.obstacles, bounds=(-9, -5, 9, 9), start=(-6, 0, 0), goal=(6, 3, 0))
    path = path_in(scene, Car(1, gears="forward"))
    assert {part.gear for part in path.driving} == {"forward"} and path.cusps == 0


def test_slots_as_wide_as_the_robot_are_driven_along_and_not_across() -> None:
    scene = cfree.load_scene("examples/scenes/degenerate_exact_fit.json")
    along = plan(scene, vehicle=Car(1, axle=("-1/2", 0)), improve=0)
    assert isinstance(along, Path) and along.goal == scene.goal and along.is_free(MotionChecker(scene))
    for heading in ("90deg", {"tau": Fraction(1, 10**9)}):
        with pytest.raises(UndecidedError, match="along contacts"):
            plan(scene, vehicle=Car(1, axle=("-1/2", 0), heading=heading))


def test_both_ends_in_one_slot_are_joined_along_the_contact() -> None:
    slot = Scene(box(-1, -1, 1, 1), [box(-9, -3, 9, -1), box(-9, 1, 9, 3)], start=(-5, 0, 0), goal=(3, 0, 0))
    path = path_in(slot, Car(3))
    assert path.length == 8 and {motion.kind for motion in path.motions} == {"translation"}


# --- contacts ---

ROBOT = box(-2, -1, 2, 1)
FLUSH = [box(2, -1, 3, 1), box(-3, -1, -2, 1)]
ASKEW = [box(2, "1/2", 4, 3), box(-4, -3, -2, "-1/2")]
NEEDLES = [[(-1, 1), (0, 3), (-2, 3)], [(-1, -1), (-2, -3), (0, -3)]]
ALONG = box(-20, -3, 9, -1)
TABLE: dict[str, tuple[list[Any], Any, str]] = {
    "flush in front and behind, car": (FLUSH, Car(4, axle=(-1, 0)), "paths"),
    "flush in front and behind, drive": (FLUSH, DifferentialDrive(axle=(-1, 0)), "paths"),
    "front left half, rear right half, car": ([box(2, "1/2", 4, 3), box(-4, -3, -2, "-1/2")], Car(4), "pieces"),
    "front left half, rear right half, drive": (
        [box(2, "1/2", 4, 3), box(-4, -3, -2, "-1/2")],
        DifferentialDrive(),
        "",
    ),
    "flush in front": ([box(2, -1, 3, 1)], Car(4, axle=(-1, 0)), ""),
    "flush along a wall": ([ALONG], Car(4, axle=(-1, 0)), ""),
    "the same, wall in front": ([ALONG, box(2, -3, 4, 4)], Car(4, axle=(-1, 0)), ""),
    "slot exactly as wide": ([box(-9, -3, 9, -1), box(-9, 1, 9, 3)], DifferentialDrive(axle=(-1, 0)), ""),
    "a point on the axle line": ([[(-1, 1), (0, 3), (-2, 3)]], Car(4, axle=(-1, 0)), ""),
    "two needles on the axle line": (
        [[(-1, 1), (0, 3), (-2, 3)], [(-1, -1), (-2, -3), (0, -3)]],
        Car(4, axle=(-1, 0)),
        "",
    ),
    "corner in a concave corner": ([box(2, -9, 4, 9), box(-9, 1, 9, 4)], Car(4, axle=(-1, 0)), ""),
    "corner to corner": ([box(2, 1, 4, 4)], Car(4, axle=(-1, 0)), ""),
    "along a wall between walls": (
        [box(-20, -3, 20, -1), box(5, -3, 7, 4), box(-7, -3, -5, 4)],
        Car(4, axle=(-1, 0)),
        "pieces",
    ),
}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow) if "half" in name else name for name in TABLE]
)
def test_first_motions_decide_for_a_start_in_contact(name: str) -> None:
    obstacles, vehicle, held = TABLE[name]
    scene = Scene(ROBOT, obstacles, start=(0, 0, 0), goal=(-13, 12, 0), vehicle=vehicle)
    for ends in ((scene.start, scene.goal), (scene.goal, scene.start)):
        answer = plan(scene, *ends, improve=0)
        if not held:
            assert isinstance(answer, Path) and is_drivable(answer, vehicle)
            assert answer.is_free(MotionChecker(scene)) and (answer.start, answer.goal) == ends
            continue
        assert isinstance(answer, Stuck)
        assert (answer.of, answer.at, answer.pose) == (held, "start" if ends[0] == scene.start else "goal", scene.start)
        whole = Scene(ROBOT, obstacles)
        assert verified_in_a_file(whole, answer).verified
    assert isinstance(plan(scene, vehicle="any", improve=0), Path)


@pytest.mark.parametrize("name", [name for name, row in TABLE.items() if row[2] and "between" not in name])
def test_an_obstacle_away_by_the_least_bit_holds_nothing(name: str) -> None:
    obstacles, vehicle, _ = TABLE[name]
    moved = [[(Fraction(x) + Fraction(1, 10**30), y) for x, y in obstacles[0]], *obstacles[1:]]
    try:
        answer = plan(Scene(ROBOT, moved), (0, 0, 0), (-13, 12, 0), vehicle=vehicle, improve=0)
    except UndecidedError as error:
        assert "exists" in str(error)
    else:
        assert isinstance(answer, Path)


@pytest.mark.slow
def test_contacts_that_hold_only_polygons_around_shapes_leave_the_question_open() -> None:
    """Of round shapes, and of a robot that has exactly its clearance at the start."""
    apart = Scene(ROBOT, [box(3, -1, 4, 1), box(-4, -1, -3, 1)], start=(0, 0, 0), goal=(0, 6, 0))
    curved = Scene(ROBOT, [*FLUSH, Curved.circle((0, 20), 1)], start=(0, 0, 0), goal=(0, 6, 0))
    held = "start: no path of finite length lets a vehicle with this axle leave its start"
    for goal in (apart.goal, [(0, 6, 0), (9, 9, 0)]):
        with pytest.raises(UndecidedError, match=f"{held}.*if it keeps a little more than 1; give another clearance"):
            plan(apart, goal=goal, vehicle=Car(4), clearance=1, improve=0)
    with pytest.raises(UndecidedError, match=f"{held}.*, among polygons around the round shapes"):
        plan(curved, vehicle=Car(4), improve=0)
    with pytest.raises(UndecidedError, match="contacts hold the vehicle, among polygons around the round shapes"):
        plan(curved, goal=[(0, 6, 0), (9, 9, 0)], vehicle=Car(4), improve=0)


@pytest.mark.slow
@pytest.mark.parametrize("height", ["1.8", "2.5"])
def test_a_rail_in_a_hall_with_a_niche_is_verified_whatever_pieces_the_checkers_cut_it_into(height: str) -> None:
    hall = [(0, 0), (30, 0), (30, height), (20, height), (20, 10), (0, 10)]
    body = [("-1", "-0.9"), (3, "-0.9"), (3, "0.9"), ("-1", "0.9")]
    proof = plan(scene := Scene(body, [], workspace=hall), (3, 5, 0), (26, "0.9", 0), vehicle=Car(4))
    assert isinstance(proof, Stuck) and proof.at == "goal"
    assert verified_in_a_file(scene, proof).verified


def test_stuck_has_no_truth_value_and_is_saved_and_loaded(tmp_path: Any) -> None:
    scene = Scene(ROBOT, FLUSH, start=(0, 0, 0), goal=(0, 6, 0), vehicle=Car((4, 5), gears="forward"))
    answer = plan(scene)
    assert isinstance(answer, Stuck)
    with pytest.raises(TypeError, match="Stuck: a proof"):
        bool(answer)
    cfree.save(answer, tmp_path / "stuck.json")
    assert cfree.load(tmp_path / "stuck.json") == answer
    both = plan(scene, goal=[(0, 6, 0), (9, 9, 0)])
    assert isinstance(both, cfree.AllSeparated) and (both.of, len(both.proofs)) == ("pieces", 2)
    cfree.save(both, tmp_path / "both.json")
    assert cfree.load(tmp_path / "both.json") == both
    text = (tmp_path / "both.json").read_text()
    for old, new, said in (
        (
            '"answer": "stuck"',
            '"answer": "held"',
            r'proofs\[0\]: expected a proof with "answer": "separated", "stuck" or "unreachable"',
        ),
        ('"rail": ', '"rails": ', r'proofs\[0\]: key "rail" is missing'),
        ('"of": "pieces"', '"of": "closed"', 'all of them of "closed"'),
    ):
        (tmp_path / "wrong.json").write_text(text.replace(old, new, 1))
        with pytest.raises(cfree.FormatError, match=said):
            cfree.load(tmp_path / "wrong.json")
    anywhere = Scene(ROBOT, FLUSH)
    assert cfree.verify.answer(anywhere, tmp_path / "both.json").verified


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"at": "start"', '"at": "goal"'),
        ('"of": "pieces"', '"of": "paths"'),
        ('"turning_radius": "4"', '"turning_radius": "1/10"'),
        ('"type": "car", "turning_radius": "4", ', '"type": "differential", '),
        ('"axle": ["0", "0"]', '"axle": ["0", "9"]'),
        ('"obstacles": [0, 1]', '"obstacles": [0]'),
    ],
)
def test_changed_proofs_that_a_car_is_stuck_are_refuted(old: str, new: str, tmp_path: Any) -> None:
    scene = Scene(ROBOT, ASKEW)
    answer = plan(scene, (0, 0, 0), (-13, 12, 0), vehicle=Car(4))
    file = tmp_path / "stuck.json"
    cfree.save(answer, file)
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))
    try:
        assert not cfree.verify.answer(scene, file).verified
    except cfree.FormatError:
        assert "at" in old


def test_a_rail_with_a_pose_left_out_is_refuted(tmp_path: Any) -> None:
    from dataclasses import replace

    obstacles, vehicle, _ = TABLE["along a wall between walls"]
    scene = Scene(ROBOT, obstacles)
    answer = plan(scene, (0, 0, 0), (-13, 12, 0), vehicle=vehicle)
    assert isinstance(answer, Stuck) and [pose.x for pose in answer.rail] == [0, 1.5, 3, -1.5, -3]
    assert verified_in_a_file(scene, answer).verified
    for k in (2, 4):  # the ends; the start is between them, and stands for the other two
        assert not verified_in_a_file(scene, replace(answer, rail=answer.rail[:k] + answer.rail[k + 1 :])).verified


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(30))
def test_first_motions_are_free_as_the_signs_tell(seed: int) -> None:
    """Random contacts: admitted motions are free if short, forbidden ones never; strict ones touch nothing after."""
    from cfree.planning.first_motions import Touching
    from cfree.planning.rails import motion_of

    rng = random.Random(f"contact {seed}")
    robot = [(0, 0), (rng.randint(2, 4), 0), (3, rng.randint(1, 3)), (0, 2)]
    corner = rng.randint(0, 3)
    touching = [
        box(-5, -5, rng.randint(1, 4), 0),
        [(3, robot[2][1]), (6, 4), (3, 7)],
        box(-3, 2, 0, 5),
        box(-4, 0, 0, rng.randint(1, 2)),
    ]
    scene = Scene(
        robot, [shape for k, shape in enumerate(touching) if k != corner and rng.random() < 0.7] or touching[:1]
    )
    vehicle = rng.choice([Car(2), Car((1, 3), axle=(1, 1), heading={"tau": "1/3"}), DifferentialDrive(axle=(2, -1))])
    contacts, checker, pose = Touching(scene, vehicle), MotionChecker(scene), Pose(0, 0)
    pairs = contacts.pairs(pose)
    assert pairs is not None
    for control, sign in contacts.signs(pairs):
        axle = pose @ vehicle.frame
        motions = [motion_of(axle, control, Fraction(1, 2**k)) for k in (10, 20, 40, 80)]
        assert checker.is_free(pose, motions[-1]) == (sign >= 0)
        assert sign >= 0 or not any(checker.is_free(pose, motion) for motion in motions)
        if sign >= 0:
            assert (contacts.pairs(motions[-1].apply(pose)) == []) == (sign > 0)


def test_a_vehicle_leaves_contacts_with_round_shapes_and_drives_along_them() -> None:
    disc, floor = Curved.circle((0, 0), 1), box(-9, -9, 9, 0)
    for goal in ((4, 1, 0), (4, 4, "45deg")):
        scene = Scene(disc, [floor], start=(-4, 1, 0), goal=goal)
        path = plan(scene, vehicle=Car(1), improve=0)
        assert isinstance(path, Path) and path.goal == scene.goal
        assert is_drivable(path, Car(1)) and cfree.verify.answer(scene, path).verified


def test_contacts_that_hold_a_vehicle_among_round_shapes_stay_undecided() -> None:
    car = Curved([(0, -1), (3, -1), Arc((3, 1), center=(3, 0)), (0, 1)])
    scene = Scene(car, [box(4, -2, 5, 2), box(-2, -2, 0, 2)], start=(0, 0, 0), goal=(0, 9, 0))
    with pytest.raises(UndecidedError, match="start: the robot touches something there, and no first motion was found"):
        plan(scene, vehicle=Car(2))
