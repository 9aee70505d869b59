"""Films of driven paths: gears, changes of direction and wheels, frame by frame."""

from pathlib import Path as FilePath

import numpy as np
import pytest
from matplotlib.colors import to_hex
from PIL import Image

import cfree
from cfree import Car, DifferentialDrive, Path, Pose, Rotation, Scene, Translation
from cfree.film.frame import Stage
from cfree.film.montage import shots_of, views
from cfree.film.path_film import PathStage
from cfree.palette import AHEAD, BACK, IN_PLACE
from cfree.plot.path import Track

SMALL = 320, 180
WORDS = {"forward": (AHEAD, "ahead"), "backward": (BACK, "back"), "turning": (IN_PLACE, "turns in place")}
BODY = [(-2, -1), (2, -1), (2, 1), (-2, 1)]
WALL = Scene(BODY, [[(3, "3.25"), (5, "3.25"), (5, 5), (3, 5)]], units="m")
CAR = Path(
    Pose(0, 0), [Translation((6, 0)), Rotation((5, -3), "20deg")], vehicle=Car(2, axle=(-1, 0), wheelbase=3)
)  # fmt: skip
DRIVE = Path(
    Pose(0, 0), [Translation((2, 0)), Rotation((1, 0), "-90deg"), Translation((0, -4)), Translation((0, 1))],
    vehicle=DifferentialDrive(axle=(-1, 0)),
)  # fmt: skip


def stage_of(path: Path) -> PathStage:
    return PathStage(Track.of(path, WALL), None, SMALL)


@pytest.mark.parametrize("path", [CAR, DRIVE])
def test_a_frame_has_the_track_so_far_and_the_present_gear(path: Path) -> None:
    stage = stage_of(path)
    travel = stage.track.travel
    for k, part in enumerate(path.driving):
        middle = (float(travel.until[part.first]) + float(travel.until[part.last + 1])) / 2
        stage.draw(middle, 0.5)
        assert stage.driving is not None
        tracks = stage.driving.tracks[1]
        colour, word = WORDS[part.gear]
        assert (stage.gear.get_text(), stage.gear.get_color()) == (word, colour)
        assert len(tracks.get_segments()) == k + 1 and to_hex(tracks.get_color()[-1]) == colour
        (row,) = travel.at([middle])
        (axle,) = stage.driving.gears.axle(row[None])
        assert tracks.get_segments()[-1][-1] == pytest.approx(axle, abs=1e-9)
        assert stage.driving.wheels.axles.get_segments()[0].mean(axis=0) == pytest.approx(axle, abs=1e-9)


@pytest.mark.parametrize("path", [CAR, DRIVE])
def test_dots_appear_when_the_direction_changes(path: Path) -> None:
    stage = stage_of(path)
    counts = []
    for travel in np.linspace(0, stage.track.travel.total, 30).tolist():
        stage.draw(travel, 0.0)
        assert stage.driving is not None
        counts.append(len(stage.driving.dots.get_xydata()))
    assert counts == sorted(counts) and counts[0] == 0 and counts[-1] == path.cusps == 1


def test_front_wheels_turn_with_the_motion() -> None:
    stage = stage_of(CAR)
    assert stage.driving is not None
    shapes = []
    for travel in (1.0, stage.track.travel.total - 0.1):
        stage.draw(travel, 0.0)
        path = stage.driving.wheels.shapes.get_path()
        assert (path.codes == path.MOVETO).sum() == 5  # four wheels, and the triangle at the front
        front = path.vertices[2 * 5 : 3 * 5]
        rear = path.vertices[:5]
        shapes.append([edge[1] - edge[0] for edge in (rear, front)])
    (rear, front), (_, turned) = shapes
    behind = shapes[1][0]
    assert rear[0] * front[1] - rear[1] * front[0] == pytest.approx(0, abs=1e-9)
    assert abs(behind[0] * turned[1] - behind[1] * turned[0]) > 1e-3


def test_a_path_without_a_vehicle_has_no_wheels_in_its_film() -> None:
    stage = stage_of(Path(Pose(0, 0), DRIVE.motions))
    stage.draw(1.0, 0.0)
    assert stage.driving is None and stage.gear.get_text() == "" and stage.origin.get_visible()


def test_the_film_of_a_driven_path_is_read_back(tmp_path: FilePath) -> None:
    cfree.film.film_path(DRIVE, WALL, tmp_path / "way.gif", seconds=1, fps=5, size=SMALL)
    with Image.open(tmp_path / "way.gif") as film:
        assert film.size == SMALL and film.n_frames > 3


@pytest.mark.slow
def test_the_storyboard_shows_the_path_of_the_scenes_vehicle() -> None:
    start, goal = Pose(0, 0), Pose(6, -2, "90deg")
    for vehicle in (None, Car(2, axle=(-1, 0))):
        scene = Scene(BODY, WALL.obstacles, bounds=(-6, -9, 14, 4), start=start, goal=goal, vehicle=vehicle)
        boundary = cfree.boundary(scene)
        (shots,) = shots_of([boundary], 24, "path")
        frames = list(views(Stage(boundary, SMALL, 4), shots, 4))
        title, driven = frames[-1][0].title, frames[-1][0].driven
        if vehicle is None:
            assert title == "A path through the free space" and driven is None
            continue
        assert title == "A path for a car" and driven is not None
        gears, travel = driven
        assert travel == pytest.approx(gears.travel.total) and gears.path.goal == goal
        colours = {colour for colour, _ in frames[-1][0].lines}
        assert colours <= {AHEAD, BACK}
        stage = Stage(boundary, SMALL, 4)
        stage.draw(frames[-1][0])
        assert len(stage.plane._driving.dots.get_xydata()) == gears.path.cusps
