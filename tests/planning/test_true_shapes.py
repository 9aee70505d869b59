"""Paths among segments and circular arcs: exact fits, contacts at the ends, clearances, and what is done with them."""

from __future__ import annotations

import json
import math
import pickle
from dataclasses import replace
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

import pytest

import cfree
import cfree.verify
from cfree import Curved, Pose, Scene
from cfree.curves import Arc, Circle
from cfree.planning import contact_fits
from cfree.planning.contact_fits import Fits
from cfree.planning.improving import Improver
from fuzz_round import Frame, box, fault, rounded, stadium

HALF = Fraction(1, 2)
TURNS = [Fraction(0), Fraction(1, 2), Fraction(-1, 5)]


def planned(scene: Scene, start: object, goal: object, **options: Any) -> cfree.Path:
    """A path without improving, verified."""
    path = cfree.plan(scene, start, goal, improve=0.0, **options)  # type: ignore[call-overload]
    assert isinstance(path, cfree.Path) and cfree.verify.answer(scene, path).verified
    return path


def dumbbell(frame: Frame, robot: Any, half: Fraction, off: Fraction = HALF) -> tuple[Scene, Pose, Pose]:
    """Two rooms, a corridor between them; the ends are not on its line."""
    ring = [(-9, -4), (-3, -4), (-3, -half), (3, -half), (3, -4), (9, -4)]
    ring += [(-x, -y) for x, y in ring]
    return Scene(robot, workspace=frame.shape(ring)), frame.pose(-6, off), frame.pose(6, -off)


# --- exact fits ---


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("turn", TURNS[:2])
@pytest.mark.parametrize("robot", [Curved.circle((0, 0), 1), stadium(1, 1), rounded(-2, -1, 2, 1, HALF)])
def test_a_robot_fits_a_corridor_of_its_own_width(robot: Curved, turn: Fraction) -> None:
    planned(*dumbbell(Frame(turn, Fraction(1), (Fraction(7, 3), Fraction(1, 7))), robot, Fraction(1)))


@pytest.mark.slow
@pytest.mark.parametrize("turn", [TURNS[0], *(pytest.param(turn, marks=pytest.mark.long) for turn in TURNS[1:])])
def test_a_robot_fits_between_discs(turn: Fraction) -> None:
    frame = Frame(Fraction(turn), shift=(Fraction(10**9), Fraction(-3)))
    discs = [*map(frame.shape, [Curved.circle((0, 3), 2), Curved.circle((0, -3), 2)])]
    walls = [*map(frame.shape, [box(-1, 3, 1, 9), box(-1, -9, 1, -3)])]
    scene = Scene(stadium(1, 1), discs + walls, workspace=frame.shape(box(-9, -8, 9, 8)))
    planned(scene, frame.pose(-6, 1), frame.pose(6, -1))


@pytest.mark.slow
@pytest.mark.parametrize(("gap", "turn"), [(Fraction(1, 2**60), TURNS[0]), (Fraction(1, 500), TURNS[1])])
def test_a_little_room_is_enough(gap: Fraction, turn: Fraction) -> None:
    planned(*dumbbell(Frame(Fraction(turn)), stadium(1, 1), 1 + gap))


@pytest.mark.slow
def test_a_disc_goes_from_hole_to_hole_of_a_lattice_that_just_lets_it_pass() -> None:
    discs = [Curved.circle((3 * i, 3 * j), 1) for i in range(4) for j in range(4)]
    scene = Scene(Curved.circle((0, 0), HALF), discs, workspace=box(0, 0, 9, 9))
    planned(scene, ("3/2", "3/2", 0), ("15/2", "15/2", 0))


@pytest.mark.slow
@pytest.mark.parametrize("length", [HALF, Fraction(1), Fraction(4)])
@pytest.mark.parametrize("gap", [Fraction(0), Fraction(1, 10**6)])
def test_two_discs_pass_a_corridor_that_holds_one_at_a_time(length: Fraction, gap: Fraction) -> None:
    """The first disc holds the robot on a line, about which it may turn, then the second one does."""
    frame, half, x = Frame(Fraction(1, 3), shift=(Fraction(7, 3), Fraction(1))), 1 + gap / 2, length / 2
    ring = [(-12, -6), (-x, -6), (-x, -half), (x, -half), (x, -6), (12, -6)]
    ring += [(-a, -b) for a, b in ring]
    robot = [Curved.circle((0, 0), 1), Curved.circle(("-9/4", 0), 1)]
    planned(Scene(robot, workspace=frame.shape(ring)), frame.pose(-7, 1, Fraction(1, 4)), frame.pose(7, -1))


@pytest.mark.slow
@pytest.mark.parametrize("seed", [338, 675])
def test_a_disc_goes_around_the_corner_of_two_corridors_of_its_width(seed: int) -> None:
    """Two lines hold it; both end where they meet."""
    assert fault(seed) == ("bent, exact: Path", "")


@pytest.mark.slow
@pytest.mark.parametrize("seed", [449, 964])
def test_a_disc_passes_many_gaps_of_a_lattice_one_after_the_other(seed: int) -> None:
    assert not fault(seed)[1] and fault(seed)[0].endswith(": Path")


@pytest.mark.slow
@pytest.mark.long
def test_a_clear_path_through_an_exact_fit_is_free_among_the_shapes_themselves() -> None:
    """Its detours with a margin are found among polygons inside of the shapes."""
    assert fault(999) == ("gate of discs, exact: Path", "")


@pytest.mark.slow
def test_a_peg_leaves_a_round_slot_of_its_own_radius() -> None:
    bay = Arc((-2, 1), center=(-2, 0), clockwise=True)
    block = Curved([(-2, -5), (4, -5), (4, -1), (-2, -1), bay, (4, 1), (4, 5), (-8, 5), (-8, -5)])
    for turn in TURNS:
        frame = Frame(Fraction(turn))
        scene = Scene(stadium(2, 1), [frame.shape(block)])
        planned(scene, frame.pose(0, 0), frame.pose(12, 1, "1/3"))
        planned(scene, frame.pose(12, 1, "1/3"), frame.pose(0, 0))


@pytest.mark.slow
@pytest.mark.parametrize("center", [(0, 0), ("1/3", -2)])
def test_a_half_disc_turns_in_a_hole_of_its_radius_about_a_center_that_is_not_the_reference_point(center: Any) -> None:
    x, y = map(Fraction, center)
    robot = Curved([(x, y - 2), Arc((x, y + 2), center=(x, y))])
    scene = Scene(robot, [Curved(box(-5, -5, 5, 5), [Circle((0, 0), 2)])])
    planned(scene, Pose(-x, -y), Pose(y, -x, "90deg"))
    planned(scene, Pose(-x, -y), Pose(x, y, "180deg"))


# --- contacts at the ends ---


@pytest.mark.slow
def test_a_start_in_two_contacts_is_left_along_them() -> None:
    for turn in TURNS:
        frame = Frame(Fraction(turn))
        scene = Scene(Curved.circle((0, 0), 1), [*map(frame.shape, [Curved.circle((6, 2), 1), box(-12, -4, 12, -1)])])
        planned(scene, frame.pose(6, 0), frame.pose(0, 1))
        planned(scene, frame.pose(0, 1), frame.pose(6, 0))


def test_ends_in_contact_are_no_overlap() -> None:
    scene = Scene(Curved.circle((0, 0), 1), [Curved.circle((3, 0), 2)])
    planned(scene, (0, 0, 0), (6, 0, 0))
    with pytest.raises(cfree.InvalidPoseError, match="start"):
        cfree.plan(scene, (Fraction(1, 2**60), 0, 0), (6, 0, 0))


def test_angles_below_zero_are_made_parallel() -> None:
    """Once they had been normalised to a turn, and were never near another angle."""
    walls = [[(-9, -9), (9, -9), (9, -1), (-9, -1)], [(-9, 1), (9, 1), (9, 9), (-9, 9)]]
    fits = Fits(Scene(rounded(-2, -1, 2, 1, HALF), walls))
    for theta in (-0.01, math.tau - 0.01, 0.01, math.pi + 0.01, math.pi - 0.01):
        tau = fits.angles(0, 0, theta, 0.1)[0]
        assert tau == (None if abs(theta - math.pi) < 1 else 0)


# --- clearance among polygons ---


@pytest.mark.slow
@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("off", [Fraction(0), HALF])
def test_a_clearance_that_is_just_left_is_kept(turn: Fraction, off: Fraction, tmp_path: FilePath) -> None:
    robot = box(-1, -HALF, 1, HALF)
    scene, start, goal = dumbbell(Frame(Fraction(turn)), robot, Fraction(3, 4), off)
    path = planned(scene, start, goal, clearance="1/4")
    cfree.save(path, tmp_path / "path.json")
    assert cfree.verify.answer(scene, tmp_path / "path.json").verified and cfree.load(tmp_path / "path.json") == path
    proof = cfree.plan(scene, start, goal, clearance=Fraction(1, 4) + Fraction(1, 10**9))
    assert isinstance(proof, cfree.Separated) and cfree.verify.answer(scene, proof).verified


@pytest.mark.slow
def test_a_clearance_without_a_polygon_is_checked_with_the_disc_itself(tmp_path: FilePath) -> None:
    scene, start, goal = dumbbell(Frame(Fraction(1, 5)), box(-1, -HALF, 1, HALF), Fraction(3, 4))
    path = planned(scene, start, goal, clearance="1/4")
    cfree.save(replace(path, disc=()), tmp_path / "path.json")
    text = (tmp_path / "path.json").read_text()
    assert "disc" not in json.loads(text) and cfree.verify.answer(scene, tmp_path / "path.json").verified
    (tmp_path / "path.json").write_text(text.replace('"clearance": "1/4"', '"clearance": "250001/1000000"'))
    assert not cfree.verify.answer(scene, tmp_path / "path.json").verified


# --- first paths ---


@pytest.mark.parametrize("name", ["round_car", "round_disc", "round_stadium"])
def test_a_first_path_with_some_room_needs_no_polygons(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = cfree.load_scene(FilePath(__file__).parents[2] / "examples" / "scenes" / f"{name}.json")
    with monkeypatch.context() as without:
        without.setattr("cfree.collision.approximations.Approximations.scene", None)
        path = cfree.plan(scene, improve=0)
    assert isinstance(path, cfree.Path) and cfree.verify.answer(scene, path).verified


def test_a_robot_too_thin_for_a_polygon_inside_finds_a_path() -> None:
    moon = Curved([(1, 0), Arc((-1, 0), through=(0, 1)), Arc((1, 0), through=(0, "1.000000000001"))])
    assert not moon.inner(0.01)
    scene, ends = Scene(moon, [box(-1, 2, 1, 3)]), ((0, 0, 0), (0, 5, "90deg"))
    for options in ({"improve": 0}, {}, {"objective": "clear"}):
        path = cfree.plan(scene, *ends, **options)  # type: ignore[call-overload]
        assert isinstance(path, cfree.Path) and cfree.verify.answer(scene, path).verified


# --- what is done with such paths ---


def through_an_exact_fit() -> tuple[Scene, cfree.Path]:
    """A disc on the floor, under another."""
    scene = Scene(
        Curved.circle((0, 0), 1),
        [Curved.circle((0, 3), 2)],
        workspace=[(-4, -1), (4, -1), (4, 4), (-4, 4)],
        start=(-2, 0, 0),
        goal=(2, 0, 0),
    )
    return scene, planned(scene, scene.start, scene.goal)


def test_its_clearance_is_that_of_the_true_shapes() -> None:
    scene, path = through_an_exact_fit()
    touching = cfree.clearance(path, scene)
    assert touching is not None and touching.least == touching.found == 0
    higher = Scene(scene.robot, [Curved.circle((0, "3.25"), 2)], bounds=(-4, -1, 4, 4))
    least = cfree.clearance(path, higher)
    assert least is not None and 0.249 < least.least <= least.found and abs(least.found - 0.25) < 1e-9
    assert (least.motion, least.obstacle[0]) == (0, 0) and abs(least.share - 0.5) < 1e-3
    lower = Scene(scene.robot, [Curved.circle((0, "2.9999999"), 2)])
    with pytest.raises(ValueError, match="the path is not free"):
        cfree.clearance(path, lower)
    with pytest.raises(ValueError, match="tolerance"):
        cfree.clearance(path, higher, tolerance=-1)
    assert cfree.clearance(path, Scene(scene.robot)) is None


def test_it_is_timed_pickled_and_written(tmp_path: FilePath) -> None:
    scene, path = through_an_exact_fit()
    assert pickle.loads(pickle.dumps(path)) == path and path.scene is None and path.curved == scene
    assert cfree.timed(path, speed=2).duration == 2
    for name in ("a.csv", "a.yaml", "a.geojson"):
        cfree.save(path, tmp_path / name, speed=2)
    shapes = json.loads((tmp_path / "a.geojson").read_text())["features"]
    assert len(shapes) > 2 and len(shapes[1]["geometry"]["coordinates"][0]) > 50
    cfree.save(path, tmp_path / "a.json")
    assert "polygons" not in json.loads((tmp_path / "a.json").read_text())


@pytest.mark.slow
def test_it_is_drawn_and_filmed(tmp_path: FilePath) -> None:
    from cfree.film import film_path

    scene, path = through_an_exact_fit()
    cfree.save(path, tmp_path / "a.json")
    read = cfree.load(tmp_path / "a.json")
    assert isinstance(read, cfree.Path) and path._repr_svg_()
    for drawn in (path.plot(), read.plot(scene)):
        assert any("clearance 0 (" in text.get_text() for text in drawn.texts)
    film_path(path, scene, tmp_path / "a.gif", seconds=1, fps=4, size=(160, 120))
    assert (tmp_path / "a.gif").stat().st_size > 1000


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("seed", range(12))
def test_random_scenes_of_known_truth(seed: int) -> None:
    assert fault(seed)[1] == ""


def test_many_queries_have_the_answers_of_one_each() -> None:
    posts = [cfree.Curved.circle((0, y), "1/2") for y in (-4, -2, 0, 2, 4)]
    scene = cfree.Scene(cfree.Curved.circle((0, 0), "1/2"), posts, workspace=[(-5, -6), (5, -6), (5, 6), (-5, 6)])
    pairs = [((-3, 0, 0), (3, 1, 0)), ((-3, 1, 0), (-2, 4, 0)), ((-3, 1, 0), (3, 1, 0))]
    for threads in (1, 2):
        answers = cfree.plan_many(scene, pairs, improve=0, threads=threads)
        assert answers == [cfree.plan(scene, *pair, improve=0) for pair in pairs]
        assert all(cfree.verify.answer(scene, answer).verified for answer in answers)


def test_a_clearance_that_the_gap_just_leaves_is_kept_with_the_disc_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    """The scenes of polygons that stand for this one are not searched for it once more."""
    searched: list[object] = []
    monkeypatch.setattr("cfree.planning.clearance._among_discs", lambda *arguments: searched.append(arguments) or [])
    disc, bounds = cfree.Curved.circle((0, 0), 1), (-4, -2, 4, 2)
    walls = [cfree.Curved.circle((0, y), 1) for y in (-3, 3)]
    scene = cfree.Scene(disc, walls, bounds=bounds, start=(-3, 0, 0), goal=(3, 0, 0))
    path = cfree.plan(scene, clearance=1)
    assert isinstance(path, cfree.Path) and cfree.verify.answer(scene, path).verified
    proof = cfree.plan(scene, clearance="1.0001", tolerance=0.01)
    assert isinstance(proof, cfree.Separated) and cfree.verify.answer(scene, proof).verified
    assert not searched


# --- places, vehicles, objectives ---

FLOOR = [(-9, 0), (9, 0), (9, 9), (-9, 9)]


@pytest.mark.slow
def test_a_place_on_the_floor_is_reached_lying_there() -> None:
    """Any orientation will do; the one free range is a single pose, or all of a disc's, in contact."""
    for robot, place in ((Curved.circle((0, 0), 1), (5, 1)), (stadium(1, 1), (5, 1)), (stadium(1, 1), (8, 2))):
        for goals in ([place], [place, (6, 6, 0)], [(6, 6, 0), (5, 5)]):
            scene = Scene(robot, [Curved.circle((0, 1), 1)], workspace=FLOOR, start=(-4, 1, 0), goals=goals)
            path = cfree.plan(scene, improve=0)
            assert isinstance(path, cfree.Path) and path.scene is None and cfree.verify.answer(scene, path).verified
    with pytest.raises(cfree.InvalidPoseError, match="no orientation is free"):
        cfree.plan(scene, goal=(8, 1))


@pytest.mark.slow
@pytest.mark.parametrize("turn", TURNS[1:])
def test_a_place_where_one_slanted_orientation_fits_is_reached(turn: Fraction) -> None:
    """Two discs on a bar, in a corridor of their own width; polygons inside of them also fit turned a little."""
    frame, robot = Frame(turn), [*(Curved.circle((x, 0), 1) for x in (-1, 1)), box(-1, -HALF, 1, HALF)]
    scene, start, _ = dumbbell(frame, robot, Fraction(1))
    place = frame.at((0, 0))
    path = cfree.plan(scene, Pose(start.x, start.y, 2), place, improve=0)
    assert isinstance(path, cfree.Path) and (path.goal.x, path.goal.y) == place
    asked = cfree.Scene(scene.robot, workspace=scene.workspace, start=path.start, goals=[place])
    assert cfree.verify.answer(asked, path).verified


@pytest.mark.slow
def test_a_place_in_a_closed_ring_is_proved_out_of_reach() -> None:
    ring = Curved(Circle((4, 4), 4), [Circle((4, 4), "2.5")])
    scene = Scene(stadium(1, 1), [ring], bounds=(-9, -9, 9, 9), start=(-5, 1, 0))
    proof = cfree.plan(scene, goal=(4, 4))
    assert isinstance(proof, cfree.AllSeparated) and proof.of == "closed" and cfree.verify.answer(scene, proof).verified


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize(
    ("vehicle", "objective"),
    [
        *((None, objective) for objective in ("balanced", "short", "clear")),
        (cfree.Car(1), "balanced"),
        (cfree.Car(1, gears="forward"), "clear"),
        (cfree.DifferentialDrive(), "short"),
    ],
)
def test_vehicles_reach_poses_places_and_lists_among_arcs(vehicle: Any, objective: Any) -> None:
    scene = Scene(stadium(1, 1), [Curved.circle((0, 1), 1)], workspace=FLOOR, start=(-4, 2, 0), vehicle=vehicle)
    preferences = cfree.Preferences(backward=3, turning=2, cusp=2) if vehicle else cfree.Preferences(sideways=5)
    for goal in ((5, 3, "90deg"), (5, 3), [(5, 3), (6, 6, 0)]):
        path = cfree.plan(scene, goal=goal, objective=objective, preferences=preferences)
        assert isinstance(path, cfree.Path) and path.vehicle == vehicle and cfree.verify.answer(scene, path).verified


def test_an_undecided_query_among_many_is_named() -> None:
    scene = Scene(stadium(1, 1), [Curved.circle((0, 1), 1)], workspace=FLOOR)
    with pytest.raises(cfree.UndecidedError, match="query 1: "):
        cfree.plan_many(scene, [((-4, 2, 0), (5, 3, 1)), ((-4, 1, 0), (5, 1, 0))], vehicle=cfree.Car(1), improve=0)


@pytest.mark.slow
@pytest.mark.parametrize("vehicle", [cfree.Car(2), cfree.Car(2, gears="forward"), cfree.DifferentialDrive()])
@pytest.mark.parametrize("goals", [[(6, 0)], [(6, 0, 0), (6, 3, 0)]])
def test_a_vehicle_with_a_round_robot_drives_to_a_place_or_one_of_several_poses(vehicle: Any, goals: list[Any]) -> None:
    walls = [[(2, -9), (3, -9), (3, -3), (2, -3)], [(2, 3), (3, 3), (3, 9), (2, 9)]]
    scene = Scene(Curved.circle((0, 0), 1), walls, bounds=(-9, -9, 12, 9))
    path = cfree.plan(scene, (0, 0, 0), goals, vehicle=vehicle, improve=0)
    assert isinstance(path, cfree.Path) and cfree.verify.answer(scene, path).verified


def test_many_paths_of_a_robot_too_thin_for_a_polygon_inside_are_kept() -> None:
    low, high = (Arc((1, 0), through=("1/2", "-10001/100000")), Arc((0, 0), through=("1/2", "-10000/100000")))
    scene = Scene(Curved([(0, 0), low, high]), [[(4, -9), (5, -9), (5, 9), (4, 9)]], bounds=(-9, -9, 9, 9))
    [path] = cfree.plan_many(scene, [((0, 0, 0), (2, 2, 0))])
    assert isinstance(path, cfree.Path)


# --- objectives ---


def moon(x: int, y: int, thin: Any = "1e-12") -> Curved:
    """Too thin to have a polygon inside."""
    inner, outer = (x, y + 1), (x, y + 1 + Fraction(thin))
    return Curved([(x + 1, y), Arc((x - 1, y), through=inner), Arc((x + 1, y), through=outer)])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("robot", "others"), [(moon(0, 0), []), (moon(0, 0, "1e-4"), []), (Curved.circle((0, 0), HALF), [moon(0, -4)])]
)
def test_an_objective_is_kept_where_a_shape_has_no_polygon_inside(robot: Curved, others: list[Curved]) -> None:
    scene = Scene(robot, [Curved.circle((0, 0), 2), Curved.circle((0, 6), 1), *others], bounds=(-8, -8, 8, 8))
    least = list[float]()
    for objective in ("short", "balanced", "clear"):
        path = cfree.plan(scene, (-6, 0, 0), (6, 0, 0), objective=objective)
        assert isinstance(path, cfree.Path) and cfree.verify.answer(scene, path).verified
        place = cfree.clearance(path, scene)
        assert place is not None
        least.append(place.least)
    assert least[0] < 0.1 < least[1] and least[2] > 0.1


# --- work ---


@pytest.mark.parametrize("tau", [Fraction(0), Fraction(1, 3), None])
@pytest.mark.parametrize("robot", [stadium(1, HALF), rounded(-1, -1, 1, HALF, Fraction(1, 4)), box(-1, -HALF, 1, HALF)])
def test_doubles_leave_out_no_contact_that_exact_numbers_find(robot: Any, tau: Fraction | None) -> None:
    discs = [Curved.circle((3 * i, 2 * j), 1) for i in range(3) for j in range(3)]
    fits = Fits(Scene(robot, [*discs, box(-9, -9, 9, -3), box(8, -3, 9, 9)], bounds=(-9, -9, 9, 9)))
    for k in range(20):
        place, near = (Fraction(k, 2), Fraction(-7 * k % 11, 3) - 2), (1e-3, 0.1, 1.0)[k % 3]
        held = dict[Any, float]()
        for own in fits._robot:
            for other in fits._close(float(place[0]), float(place[1]), near):
                if contact := contact_fits._contact(contact_fits._turned(own, tau), other, place, near):
                    held.setdefault(replace(contact[0], own=own), contact[1])
        shapes = [contact for contact in fits._contacts(place, tau, near) if contact.own]  # bounds have none
        assert shapes == sorted(held, key=held.__getitem__)


@pytest.mark.slow
def test_a_path_that_polygons_leave_open_is_pushed_off_obstacles_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The disc does not fit through the gap: both pushes are of one ridge, of small distances."""
    ridges, pushed = list[int](), Improver.pushed

    def counted(self: Improver, poses: Any, motions: Any) -> Any:
        ridges.append(len(motions))
        return pushed(self, poses, motions)

    monkeypatch.setattr(Improver, "pushed", counted)
    scene = cfree.load_scene(FilePath(__file__).parents[2] / "examples" / "scenes" / "round_gap.json")
    proof = cfree.plan(scene)
    assert isinstance(proof, cfree.Separated) and ridges == [2]
