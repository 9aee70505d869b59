"""Films of paths: even speed, true clearances, files that can be read back, and nothing half-written."""

import math
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path as FilePath
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from PIL import Image

import cfree
from cfree.collision.motion import Rotation, Translation, rotations
from cfree.errors import UnsupportedError
from cfree.exact.pose import Pose
from cfree.film.path_film import REST, SECONDS, PathStage, path_frames
from cfree.forbidden.boundary import Boundary, boundary
from cfree.formats.scene_file import load_scene
from cfree.palette import ROBOT
from cfree.paths.path import Path
from cfree.plot.path import Track
from cfree.scene.scene import Scene

SMALL = 320, 180
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
WALL = Scene(robot=SQUARE, obstacles=[(3, "1.25"), (5, "1.25"), (5, 3), (3, 3)], units="m", name="a square")
WAY = Path(Pose(0, 0), [Translation((6, 0)), Rotation((6, 0), "-90deg"), Translation((0, -2))])


@pytest.fixture(scope="module")
def five() -> tuple[Path, Boundary]:
    scene = load_scene("examples/scenes/five_convex.json")
    path = cfree.plan(scene)
    assert isinstance(path, Path)
    return path, boundary(scene)


def frames_of(path: Path, scene: Scene, seconds: float | None = 1.0, fps: int = 10) -> list[Any]:
    return list(path_frames(Track.of(path, scene), None, seconds, fps, SMALL, None))


def test_the_robot_moves_at_even_speed_and_rests_before_and_after(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[float] = []
    monkeypatch.setattr(PathStage, "draw", lambda self, travel, share: seen.append(travel) or np.zeros(1))
    frames = frames_of(WAY, WALL, 4.0, 25)
    total = Track.of(WAY, WALL).travel.total
    before, after = (round(rest * 25) for rest in REST)
    assert len(frames) == before + 100 + after
    assert seen[: before + 1] == [0] * (before + 1) and seen[-1] == total
    steps = np.diff(seen[before:])
    assert steps == pytest.approx(total / 99)


@pytest.mark.parametrize(("length", "seconds"), [(1, SECONDS[0]), (10, 10 / math.sqrt(2)), (1000, SECONDS[1])])
def test_long_ways_take_longer_within_limits(length: int, seconds: float, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(PathStage, "draw", lambda self, travel, share: np.zeros(1))
    frames = frames_of(Path(Pose(0, 0), [Translation((length, 0))]), Scene(robot=SQUARE), None, 10)
    assert len(frames) == round(10 * seconds) + sum(round(10 * rest) for rest in REST)


def test_a_frame_shows_the_robot_its_trace_and_its_clearance() -> None:
    track = Track.of(WAY, WALL)
    stage = PathStage(track, None, SMALL)
    for travel, distance in ((3.5, 0.25), (0.0, math.hypot(2, 0.25))):
        stage.draw(travel, 0.0)
        outline = stage.body.get_path().vertices
        assert outline[:, 0].min() == pytest.approx(travel) and outline[:, 1].max() == pytest.approx(1)
        trace = np.array(stage.trace.get_segments())
        assert trace[-1, 1] == pytest.approx([travel, 0])
        (first, second) = stage.gap.get_xydata()
        assert math.dist(first, second) == pytest.approx(distance)
        assert stage.value.get_text() == f"clearance {distance:.3g} m"
        assert stage.pointer.get_xdata() == pytest.approx([min(distance, track.most)])
        assert all(path.vertices[:, 0].min() <= travel for path in stage.ghosts.get_paths())
    stage.draw(track.travel.total, 1.0)
    assert stage.origin.get_xydata()[0] == pytest.approx([6, -2])
    assert len(stage.ghosts.get_paths()) == len(track.ghosts)


def test_the_line_in_configuration_space_has_the_colours_of_the_trace(five: tuple[Path, Boundary]) -> None:
    path, found = five
    track = Track.of(path, found.scene)
    stage = PathStage(track, found, SMALL)
    assert stage.space is not None
    lines: list[Any] = []
    stage.space.draw = lambda *arguments: lines.extend(arguments[-2])  # type: ignore[method-assign]
    stage.draw(track.travel.total / 2, 0.5)
    assert len({colour for colour, _ in lines}) > 1
    joined = [np.array_equal(before[-1], after[0]) for (_, before), (_, after) in pairwise(lines)]
    assert all(joined) and lines[0][1][0] == pytest.approx(stage.line[0])
    assert lines[-1][1][-1, :2] == pytest.approx(track.travel.at([track.travel.total / 2])[0, :2])


def test_a_gif_is_read_back(tmp_path: FilePath) -> None:
    shares: list[float] = []
    cfree.film.film_path(WAY, WALL, tmp_path / "way.gif", seconds=1, fps=5, size=SMALL, progress=shares.append)
    with Image.open(tmp_path / "way.gif") as film:
        assert film.size == SMALL
        assert 2 < film.n_frames <= 5 + sum(round(5 * rest) for rest in REST)  # equal frames are one
    assert shares == sorted(shares) and shares[-1] == 1
    assert [file.name for file in tmp_path.iterdir()] == ["way.gif"]


@pytest.mark.slow
def test_an_mp4_with_its_configuration_space_is_read_back(five: tuple[Path, Boundary], tmp_path: FilePath) -> None:
    av = pytest.importorskip("av")
    path, found = five
    cfree.film.film_path(path, found.scene, tmp_path / "way.mp4", boundary=found, seconds=1, fps=4, size=SMALL)
    with av.open(str(tmp_path / "way.mp4")) as film:
        frames = [frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)]
    assert len(frames) == 4 + sum(round(4 * rest) for rest in REST)
    assert frames[0].shape == (180, 320, 3)
    assert (np.abs(frames[0].astype(int) - frames[-1]) > 40).any()


def interrupt(share: float) -> None:
    if share > 0.3:
        raise KeyboardInterrupt


@pytest.mark.slow
@pytest.mark.parametrize("name", ["way.gif", "way.mp4"])
def test_an_interrupted_film_leaves_what_was_there(name: str, tmp_path: FilePath) -> None:
    if name.endswith("mp4"):
        pytest.importorskip("av")
    (tmp_path / name).write_text("before")
    with pytest.raises(KeyboardInterrupt):
        cfree.film.film_path(WAY, WALL, tmp_path / name, seconds=1, fps=5, size=SMALL, progress=interrupt)
    assert [file.name for file in tmp_path.iterdir()] == [name] and (tmp_path / name).read_text() == "before"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"seconds": 61}, "61 seconds; give more than 0, and 60 at most"),
        ({"seconds": 0}, "0 seconds"),
        ({"seconds": math.nan}, "nan seconds"),
        ({"fps": 0}, "0 frames a second"),
        ({"size": (321, 180)}, "size 321x180; give even numbers"),
        ({"path": Path(Pose(0, 0), [Translation((0, 1))])}, None),
        ({"path": Path(Pose(0, 0), [Translation((3, 1))])}, "not free"),
    ],
)
def test_options_without_sense_are_refused(change: dict[str, Any], message: str | None, tmp_path: FilePath) -> None:
    options: dict[str, Any] = {"path": WAY, "scene": WALL, "seconds": 1, "fps": 2, "size": SMALL, **change}
    make: Callable[[], None] = lambda: cfree.film.film_path(file=tmp_path / "way.gif", **options)  # noqa: E731
    if message is None:
        make()
        return
    with pytest.raises(ValueError, match=message):
        make()
    assert not list(tmp_path.iterdir())


def test_other_formats_are_refused(tmp_path: FilePath) -> None:
    with pytest.raises(UnsupportedError, match=r"name the file \.mp4 or \.gif"):
        cfree.film.film_path(WAY, WALL, tmp_path / "way.avi")


@pytest.mark.slow
@pytest.mark.parametrize("obstacles", [[], [[(4, 0), (5, 0), (5, 1)]]], ids=["nothing", "a triangle"])
def test_films_of_full_turns_and_of_empty_scenes(obstacles: list[Any], tmp_path: FilePath) -> None:
    scene = Scene(robot=SQUARE, obstacles=obstacles)
    path = Path(Pose(0, 0, "350deg"), rotations((0, 0), "400deg"))
    cfree.film.film_path(path, scene, tmp_path / "way.gif", boundary=boundary(scene), seconds=1, fps=3, size=SMALL)
    still = Path(Pose(0, 0), [])
    cfree.film.film_path(still, scene, tmp_path / "still.gif", seconds=1, fps=3, size=SMALL)
    with Image.open(tmp_path / "way.gif") as film:
        # rest, three frames of motion, rest: equal frames are one, and 350 and 750 degrees are not equal
        assert film.size == SMALL and film.n_frames >= 3
        first, last = (frame_of(film, k) for k in (0, film.n_frames - 1))
    assert (np.abs(first - last).max(axis=2) > 60).sum() > 50
    with Image.open(tmp_path / "still.gif") as film:
        assert film.n_frames == 1  # nothing moves
        image = frame_of(film, 0)
    assert (np.abs(image - np.array(to_rgb(ROBOT)) * 255).max(axis=2) < 60).sum() > 100
    # what is seen in the frames: the robot turned by 350 and by 750 degrees, and each obstacle
    stage = PathStage(Track.of(path, scene), boundary(scene), SMALL)
    for travel, degrees in ((0.0, 350), (stage.track.travel.total, 750)):
        stage.draw(travel, 0.0)
        expected = Pose(0, 0, f"{degrees}deg").apply(SQUARE)
        assert stage.body.get_path().vertices[:4] == pytest.approx(expected)
    drawn = [{*map(tuple, patch.get_path().vertices.tolist())} for patch in stage.body.axes.patches]
    assert all(any({*map(tuple, obstacle)} <= corners for corners in drawn) for obstacle in obstacles)


def frame_of(film: Any, k: int) -> np.ndarray:
    film.seek(k)
    return np.asarray(film.convert("RGB"), dtype=float)
