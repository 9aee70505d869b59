"""Pictures of driven paths: gears by colour, changes of direction as dots, the axle's track, and wheels."""

import math
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import to_hex

import cfree
from cfree import Car, DifferentialDrive, Path, Pose, Rotation, Scene, Stuck, Translation, UndecidedError, plan
from cfree.palette import AHEAD, BACK, IN_PLACE
from cfree.plot.answer import picture
from cfree.plot.gears import CHANGE, GEARS, SHOWN, Wheels, steered
from cfree.plot.path import Track, plot_path

BODY = [(-2, -1), (2, -1), (2, 1), (-2, 1)]
FAR = [[(90, 90), (91, 90), (91, 91)]]
CAR, DRIVE = Car(2, axle=(-1, 0)), DifferentialDrive(axle=(-1, 0))
FORTH_AND_BACK = Path(
    Pose(0, 0), [Translation((6, 0)), Rotation((5, 3), "-90deg"), Translation((0, 4)), Rotation((5, 7), "90deg")],
    vehicle=CAR,
)  # fmt: skip
TURNS = Path(
    Pose(0, 0), [Translation((4, 0)), Rotation((3, 0), "90deg"), Translation((0, 4)), Translation((0, -2))],
    vehicle=DRIVE,
)  # fmt: skip


def room(path: Path, body: Any = BODY) -> Scene:
    return Scene(body, FAR, vehicle=path.vehicle, units="m")


def artists(ax: Any) -> dict[str, Any]:
    drawn = [*ax.patches, *ax.collections, *ax.lines]
    return {artist.get_label(): artist for artist in drawn if not artist.get_label().startswith("_")}


def axles(path: Path) -> list[Any]:
    """The axle point before each motion, and at the end."""
    assert path.vehicle is not None
    axle = [float(value) for value in path.vehicle.axle]
    return [pose.apply([axle])[0] for pose in path.poses]


def words(ax: Any) -> list[str]:
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_each_gear_has_its_colour_and_the_legend_its_word() -> None:
    for path, colours, names in (
        (FORTH_AND_BACK, [AHEAD, BACK, AHEAD], ["ahead", "back", CHANGE]),
        (TURNS, [AHEAD, IN_PLACE, AHEAD, BACK], ["ahead", "back", "turns in place", CHANGE]),
        (FORTH_AND_BACK[:1], [AHEAD], ["ahead"]),
    ):
        ax = plot_path(path, room(path))
        track = artists(ax)["axle's track"]
        assert [to_hex(colour) for colour in track.get_color()] == [GEARS[part.gear][0] for part in path.driving]
        assert {*colours} == {to_hex(colour) for colour in track.get_color()}
        assert words(ax) == names


def test_dots_are_the_axle_point_at_changes_of_direction() -> None:
    for path, places in ((FORTH_AND_BACK, (1, 3)), (TURNS, (3,)), (FORTH_AND_BACK[:1], ())):
        dots = artists(plot_path(path, room(path)))[CHANGE].get_xydata()
        assert len(dots) == path.cusps
        changes = [axles(path)[k] for k in places]
        assert dots == pytest.approx(np.reshape(changes, (-1, 2)))


def test_turns_in_place_are_marked_where_they_are() -> None:
    spots = artists(plot_path(TURNS, room(TURNS)))["turns in place"].get_xydata()
    assert spots == pytest.approx(np.array([[3, 0]]))


def test_the_track_is_that_of_the_axle_point() -> None:
    tracks = artists(plot_path(FORTH_AND_BACK, room(FORTH_AND_BACK)))["axle's track"].get_segments()
    assert tracks[0][0] == pytest.approx(axles(FORTH_AND_BACK)[0])
    assert tracks[-1][-1] == pytest.approx(axles(FORTH_AND_BACK)[-1])
    for track, part in zip(tracks, FORTH_AND_BACK.driving, strict=True):
        assert np.hypot(*np.diff(track, axis=0).T).sum() == pytest.approx(part.length, rel=1e-3)


def test_wheels_stand_at_start_goal_and_changes_of_direction() -> None:
    ax = plot_path(FORTH_AND_BACK, room(FORTH_AND_BACK))
    stands = [artist.get_segments() for artist in ax.collections if artist.get_label() == "axles"]
    middles = [axle.mean(axis=0) for lines in stands for axle in lines]
    expected = [axles(FORTH_AND_BACK)[k] for k in (1, 3)]
    expected += [axles(FORTH_AND_BACK)[0], axles(FORTH_AND_BACK)[-1]]
    assert np.array(middles) == pytest.approx(np.array(expected))
    assert sum(patch.get_label() == "wheels" for patch in ax.patches) == len(expected)


def test_front_wheels_are_drawn_if_the_wheelbase_is_known_and_point_to_the_pole() -> None:
    scene = room(FORTH_AND_BACK)
    bare, steering = (Wheels.of(scene, Car(2, axle=(-1, 0), wheelbase=base)) for base in (None, "2.5"))
    assert len(bare.rings(Pose(0, 0), 0.5)) == 2 and len(bare.axles(Pose(0, 0))) == 1
    for curvature in (0.5, -0.4, 0.05):
        rings = steering.rings(Pose(0, 0), curvature)
        assert len(rings) == 4 and len(steering.axles(Pose(0, 0))) == 2
        for ring in rings[2:]:  # the line through a wheel's middle across it meets the axle's line in the pole
            middle, along = ring.mean(axis=0), ring[1] - ring[0]
            assert float(np.dot(np.array([-1, 1 / curvature]) - middle, along)) == pytest.approx(0, abs=1e-9)
    straight = steering.rings(Pose(0, 0), 0.0)
    assert all((ring[1] - ring[0])[1] == pytest.approx(0) for ring in straight)
    assert math.degrees(steered(math.inf, 2, 0)) == pytest.approx(90)


def test_front_wheels_have_the_angle_of_the_motion_that_follows() -> None:
    gears = Track.of(FORTH_AND_BACK, room(FORTH_AND_BACK)).gears
    assert gears is not None
    assert gears.curvature("start") == FORTH_AND_BACK.driving[0].curvature
    assert gears.curvature("goal") == FORTH_AND_BACK.driving[-1].curvature
    for (_, curvature), k in zip(gears.stands, gears.changes, strict=True):
        assert curvature == FORTH_AND_BACK.driving[k].curvature


@pytest.mark.parametrize("axle", [(-1, 0), (-5, 0), (0, 3), (10**9, 0)])
@pytest.mark.parametrize("body", [BODY, [BODY, [(3, 0), (4, 0), (4, 1)]]])
def test_axle_points_anywhere_and_robots_of_several_parts_are_drawn(axle: Any, body: Any) -> None:
    path = Path(Pose(0, 0), [Translation((4, 0)), Translation((-1, 0))], vehicle=Car(3, axle=axle))
    ax = plot_path(path, Scene(body, FAR))
    assert len(artists(ax)[CHANGE].get_xydata()) == 1
    x0, x1 = ax.get_xlim()
    shown = x0 <= float(axle[0]) <= x1
    assert shown == (axle[0] < 10**9) and x1 - x0 < 100


@pytest.mark.parametrize("heading", ["90deg", "180deg", {"tau": "1/2"}])
def test_the_triangle_is_at_the_front(heading: Any) -> None:
    vehicle = Car(3, heading=heading)
    nose = Wheels.of(Scene(BODY, FAR), vehicle).nose(Pose(0, 0))
    forward = vehicle.frame.apply([(1.0, 0.0)])[0]
    assert float(nose[1] @ forward) > max(float(nose[0] @ forward), float(nose[2] @ forward)) > 0


def test_many_changes_of_direction_have_all_dots_and_few_outlines() -> None:
    zigzag = Path(Pose(0, 0), [Translation((3 + k / 4 if k % 2 == 0 else -3, 0)) for k in range(40)], vehicle=CAR)
    drawn = artists(plot_path(zigzag, room(zigzag)))
    assert len(drawn[CHANGE].get_xydata()) == zigzag.cusps == 39
    assert 1 < len(drawn["stands"].get_paths()) <= SHOWN


def test_a_path_without_a_vehicle_has_no_gears() -> None:
    path = Path(Pose(0, 0), FORTH_AND_BACK.motions)
    ax = plot_path(path, room(path))
    assert "trace" in artists(ax) and not {"axle's track", "wheels", CHANGE} & {*artists(ax)}
    assert ax.get_legend() is None and "change" not in ax.get_title()


def test_a_path_of_no_motion_has_its_wheels() -> None:
    ax = plot_path(Path(Pose(0, 0), [], vehicle=CAR), room(FORTH_AND_BACK))
    assert "wheels" in artists(ax) and "0 changes of direction" in ax.get_title()


def test_a_path_that_its_vehicle_cannot_drive_is_refused() -> None:
    path = Path(Pose(0, 0), [Translation((0, 1))], vehicle=CAR)
    with pytest.raises(ValueError, match="motion 0"):
        plot_path(path, room(path))


def test_the_picture_names_vehicle_and_changes_of_direction() -> None:
    figure = FORTH_AND_BACK.plot(room(FORTH_AND_BACK))
    headline, details = (text.get_text() for text in figure.texts)
    assert headline == "a path for a car with a turning radius of 2 m"
    assert f"{FORTH_AND_BACK.cusps} changes of direction" in details
    assert "a path for a differential drive" in TURNS.plot(room(TURNS)).texts[0].get_text()


@pytest.mark.slow
def test_the_path_in_space_has_the_colours_of_the_gears() -> None:
    scene = cfree.load_scene("examples/scenes/parking_bay.json")
    path = plan(scene, improve=0)
    assert isinstance(path, Path)
    track = Track.of(path, scene)
    assert track.gears is not None
    gears = [track.gears.parts[k].gear for k in track.gears.part_at(track.steps).tolist()]
    assert [to_hex(colour) for colour in track.at_steps()] == [GEARS[gear][0] for gear in gears]
    figure = path.plot(scene, cfree.boundary(scene))
    assert len(figure.axes) == 2 and len(artists(figure.axes[0])[CHANGE].get_xydata()) == path.cusps


# what holds a vehicle, and what it could do

BESIDE = [[(2, -1), (3, -1), (3, 1), (2, 1)], [(-3, -1), (-2, -1), (-2, 1), (-3, 1)]]


def test_the_contacts_of_a_stuck_vehicle_are_marked_with_what_it_touches() -> None:
    scene = Scene(BODY, [*BESIDE, *FAR], start=(0, 0, 0), goal=(0, 6, 0), vehicle=CAR)
    for ends, at in (((scene.start, scene.goal), "start"), ((scene.goal, scene.start), "goal")):
        proof = plan(scene, *ends)
        assert isinstance(proof, Stuck)
        figure = proof.plot(scene)
        (ax,) = figure.axes
        contacts = artists(ax)["contacts"].get_xydata()
        assert sorted(map(tuple, contacts.round(6))) == [(-2, 0), (2, 0)]
        texts = [" ".join(text.get_text().split()) for text in ax.texts]
        assert {"touches obstacle 0", "touches obstacle 1", f"{at}: stuck"} <= {*texts}
        assert [text.get_text() for text in figure.texts][1] == proof.sentence()
        lines = artists(ax)["lines"].get_segments()
        assert sorted(abs(line[1] - line[0])[1] for line in lines) == pytest.approx([2, 2])


def test_the_places_that_a_car_without_reverse_gear_reaches_are_shaded() -> None:
    alley = [(0, 0), (12, 0), (12, 4), (0, 4)]
    robot, ends = [(-0.5, -0.5), (1.5, -0.5), (1.5, 0.5), (-0.5, 0.5)], {"start": (3, 2, 0), "goal": (3, 2, "180deg")}
    scene = Scene(robot, [], workspace=alley, vehicle=Car(3, gears="forward"), **ends)
    proof = plan(scene, improve=0)
    assert isinstance(proof, cfree.Unreachable)
    figure = proof.plot(scene)
    (ax,) = figure.axes
    assert figure.texts[0].get_text() == "unreachable without reverse gear, proved"
    drawn = artists(ax)
    assert "wheels" in drawn
    (boxes,) = ax.images
    shaded, (left, _, low, _) = boxes.get_array(), boxes.get_extent()
    side = float(proof.grid.side)
    for k, reached in ((proof.pose, True), (Pose(11.9, 0.1), False)):
        column, row = int((float(k.x) - left) / side), int((float(k.y) - low) / side)
        assert bool(shaded[row, column]) is reached if not np.ma.is_masked(shaded[row, column]) else not reached


def test_long_numbers_leave_the_name_of_the_axis_inside_of_the_figure() -> None:
    hall = [(0, 0), (24000, 0), (24000, 18000), (0, 18000)]
    robot = [(0, 0), (6000, 0), (6000, 2000), (0, 2000)]
    scene = Scene(robot, [], workspace=hall, start=(0, 0, 0), goal=(15000, 15000, 0), units="mm")
    path = plan(scene, improve=0)
    assert isinstance(path, Path)
    for figure in (path.plot(scene, cfree.boundary(scene)), picture(scene)):
        box = figure.axes[0].yaxis.get_tightbbox()
        assert box is not None and box.x0 > 0


def test_a_corner_on_a_wall_is_one_contact_and_few_poses_of_a_rail_are_drawn() -> None:
    walls = [[(-20, -3), (20, -3), (20, -1), (-20, -1)], *([(x, -3), (x + 2, -3), (x + 2, 4), (x, 4)] for x in (-7, 5))]
    scene = Scene(BODY, walls, start=(0, 0, 0), goal=(-13, 12, 0), vehicle=Car(4, axle=(-1, 0)))
    proof = plan(scene)
    assert isinstance(proof, Stuck)
    (ax,) = proof.plot(scene).axes
    drawn = len(artists(ax)["reached"].get_paths())
    assert 0 < drawn < len(proof.rail)
    many = replace(proof, rail=tuple(Pose(Fraction(x, 100), 0) for x in range(300)))
    assert len(artists(many.plot(scene).axes[0])["reached"].get_paths()) == SHOWN
    point = Scene(BODY, [[(2, 0), (3, -1), (3, 1)], [(-2, 0), (-3, 1), (-3, -1)]])
    tip = Stuck(Pose(0, 0), Pose(0, 9), CAR, "start", "pieces", (Pose(0, 0),), (0, 1))
    contacts = artists(tip.plot(point).axes[0])["contacts"].get_xydata()
    assert sorted(map(tuple, contacts.round(5) + 0.0)) == [(-2, 0), (2, 0)]


def test_an_undecided_vehicle_has_the_picture_of_the_path_that_proves_it() -> None:
    path = Path(Pose(0, 0), [Translation((0, 3))])
    error = UndecidedError("too many", path=path, manoeuvres=1234)
    figure = picture(error, Scene(BODY, FAR))
    headline, details = (text.get_text() for text in figure.texts)
    assert headline == "undecided: a path exists" and "about 1,234 motions" in details
    assert "trace" in artists(figure.axes[0])
    with pytest.raises(ValueError, match="there is no path to draw"):
        picture(UndecidedError("no"), Scene(BODY, FAR))
