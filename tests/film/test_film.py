"""Films: true poses, continuous motions, captions that the definitions agree with, and files that can be read back."""

import contextlib
import itertools
import math
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from click.testing import CliRunner
from PIL import Image

import cfree
from cfree import Curved
from cfree.cli.app import app
from cfree.collision.arcs import arcs_of
from cfree.collision.motion_checker import MotionChecker
from cfree.collision.pose_checker import is_free
from cfree.contact.definitions import contact_features, is_forbidden
from cfree.curves import Arc
from cfree.errors import UnsupportedError
from cfree.exact.pose import Pose, Poses
from cfree.film.camera import Camera
from cfree.film.contact_motions import Moment, Ring, columns, outward, over_column, roll, surface_of
from cfree.film.encode import write
from cfree.film.frame import Stage, caption
from cfree.film.free_motions import FreeMotions
from cfree.film.montage import LATER, check_options, shots_of, views
from cfree.film.storyboard import STORYBOARDS, Shot, storyboard
from cfree.forbidden.boundary import Boundary, boundary
from cfree.forbidden.kinds import PatchKind
from cfree.formats.scene_file import load_scene
from cfree.plot.boundary import extent
from cfree.scene.features import WORKSPACE
from cfree.scene.scene import Scene, robot_radius

SCENES = Path("examples/scenes")
FIG9, FIVE = SCENES / "paper_fig9.json", SCENES / "five_convex.json"
FRAMES = 160
PAPER = "paper_fig9", "five_convex"
# non-convex robots and obstacles, a workspace, contact with no room, several parts, nothing to touch
OTHERS = ("comb_hook", "degenerate_workspace", "sofa_corner", "degenerate_two_part_robot", "degenerate_no_obstacles",
          "degenerate_own_hole", "degenerate_exact_fit")  # fmt: skip


@pytest.fixture(scope="module")
def fig9() -> Boundary:
    return boundary(load_scene(FIG9))


@pytest.fixture(scope="module")
def five() -> Boundary:
    return boundary(load_scene(FIVE))


@cache
def tale(name: str) -> tuple[Boundary, list[Shot]]:
    result = boundary(load_scene(SCENES / f"{name}.json"))
    return result, storyboard(result, FRAMES)


@pytest.fixture(params=["paper_fig9", "five_convex", *OTHERS])
def told(request: pytest.FixtureRequest) -> tuple[Boundary, list[Shot]]:
    return tale(request.param)


def shot_of(name: str, kind: str) -> Shot:
    (shot,) = (shot for shot in tale(name)[1] if shot.kind == kind)
    return shot


def places(moments: list[Moment]) -> np.ndarray:
    return np.array([(float(m.pose.x), float(m.pose.y), m.pose.theta) for m in moments])


def apart(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Differences of rows x, y, theta, the last one the shorter way round."""
    steps = first - second
    steps[:, 2] = np.mod(steps[:, 2] + math.pi, math.tau) - math.pi
    return steps


# what is shown is true


def test_every_pose_is_free(told: tuple[Boundary, list[Shot]]) -> None:
    result, shots = told
    for shot in shots:
        assert all(is_free(result.checker, moment.pose) for moment in shot.moments)


@pytest.mark.parametrize("name", PAPER)
def test_no_pose_of_the_papers_scenes_is_forbidden_by_any_obstacle(name: str) -> None:
    result, shots = tale(name)
    (robot,) = result.scene.robot
    for shot in shots:
        for moment in shot.moments:
            assert not any(is_forbidden(robot, obstacle, moment.pose) for obstacle in result.scene.obstacles)


def test_captions_agree_with_touch(told: tuple[Boundary, list[Shot]]) -> None:
    result, shots = told
    scene, seen = result.scene, set()
    for moment in (moment for shot in shots for moment in shot.moments if moment.contact is not None):
        contact = moment.contact
        assert contact is not None
        if contact.obstacle.polygon == WORKSPACE:
            continue  # its edges run the other way
        robot, obstacle = scene.robot[contact.robot.polygon], scene.obstacles[contact.obstacle.polygon]
        kinds = {"v-e": "VertexEdge", "e-v": "EdgeVertex", "v-v": "VertexVertex"}
        wanted = kinds[contact.kind], contact.robot.index, contact.obstacle.index
        found = {(type(c).__name__, c.i, c.j) for c in contact_features(robot, obstacle, moment.pose)}
        assert wanted in found
        assert caption(contact).startswith(f"{contact.kind} contact")
        seen.add(contact.kind)
    if any(shot.kind == "helix" for shot in shots) and scene.workspace is None:
        assert seen >= {"v-e", "v-v"}


def test_a_film_is_as_long_as_it_should_be(told: tuple[Boundary, list[Shot]]) -> None:
    result, shots = told
    has_room = len(result.trapezoids) > 0
    assert sum(len(shot.moments) for shot in shots) == (FRAMES if has_room else 0)


def test_shots_without_contact_have_no_caption(told: tuple[Boundary, list[Shot]]) -> None:
    _, shots = told
    for shot in shots:
        free = shot.moments if shot.kind == "path" else shot.moments[: shot.link]
        assert all(moment.contact is None for moment in free)
    assert caption(None) == "no contact"


def test_a_helix_keeps_its_vertex_in_place(fig9: Boundary) -> None:
    shot = shot_of("paper_fig9", "helix")
    contact = shot.moments[0].contact
    assert contact is not None
    (robot,), (obstacle,) = fig9.scene.robot, fig9.scene.obstacles
    for moment in shot.moments:
        (point,) = moment.pose.apply_exact([robot.exact_vertices[contact.robot.index]])
        assert point == obstacle.exact_vertices[contact.obstacle.index]


# it moves as a robot does


def test_motions_are_continuous(told: tuple[Boundary, list[Shot]]) -> None:
    result, shots = told
    x0, y0, x1, y1 = extent(result)
    scale = (1, 1, robot_radius(result.scene))
    bound = 48 / FRAMES * math.hypot(x1 - x0, y1 - y0)
    for shot in shots:
        if len(shot.moments) > 1:
            steps = apart(places(shot.moments)[1:], places(shot.moments)[:-1])
            assert np.linalg.norm(steps * scale, axis=1).max() < bound, shot.kind
            assert np.abs(steps[:, 2]).max() < 1.5, shot.kind
    for before, after in itertools.pairwise(shots):
        gap = np.linalg.norm(apart(places(before.moments[-1:]), places(after.moments[:1])) * scale)
        assert after.cut or gap < bound, after.kind


@pytest.mark.slow
def test_more_frames_mean_smaller_steps(fig9: Boundary) -> None:
    def largest(frames: int) -> float:
        rows = [places(shot.moments) for shot in storyboard(fig9, frames)]
        return max(float(np.abs(apart(row[1:], row[:-1])).max()) for row in rows)

    assert largest(1200) < 0.25 * largest(200)


@pytest.mark.parametrize("name", PAPER)
def test_the_papers_scenes_are_told_without_cuts(name: str) -> None:
    _, shots = tale(name)
    assert [shot.kind for shot in shots] == list(STORYBOARDS["paper"])
    assert not any(shot.cut for shot in shots)
    assert sum(len(shot.moments) for shot in shots) == FRAMES


def test_a_sweep_goes_through_the_whole_range_and_to_and_fro(fig9: Boundary) -> None:
    for shot in (shot_of("paper_fig9", "v-e"), shot_of("paper_fig9", "e-v")):
        assert shot.swept is not None
        moments = shot.moments[shot.link :]
        theta = places(moments)[:, 2]
        low, high = shot.swept.angles[0], shot.swept.angles[-1]
        assert np.ptp(theta) > 0.97 * (high - low)
        patch = fig9.patches[shot.swept.patch]
        assert patch.phi_range == pytest.approx(high - low, abs=1e-9)  # one convex pair: the whole patch
        p = surface_of(fig9.scene, patch)
        edge = p(1, theta)[:, :2] - p(0, theta)[:, :2]
        t = ((places(moments)[:, :2] - p(0, theta)[:, :2]) * edge).sum(axis=1) / (edge**2).sum(axis=1)
        assert t.min() < 0.05 and t.max() > 0.95


def test_the_pillar_is_a_full_turn() -> None:
    for name in PAPER:
        shot = shot_of(name, "pillar")
        theta = places(shot.moments[shot.link :])[:, 2]
        assert theta[0] < 0.05 and theta[-1] > 6.23 and (np.diff(theta) >= 0).all()
    shot = shot_of("paper_fig9", "pillar")
    assert all(moment.contact for moment in shot.moments[shot.link :])  # in contact all the way round


# moves


def test_a_ring_is_the_slice(fig9: Boundary) -> None:
    ring = Ring.near(fig9, 0.7, (-2.0, 0.0))
    cut = fig9.slice(0.7)
    (robot,), (obstacle,) = fig9.scene.robot, fig9.scene.obstacles
    sides = [np.hypot(*np.diff([*p.vertices, p.vertices[0]], axis=0).T).sum() for p in (robot, obstacle)]
    assert ring is not None
    assert ring.perimeter == pytest.approx(sum(sides))  # per(A) + per(O)
    for distance in np.linspace(0, ring.perimeter, 40):
        x, y = float((pose := ring.moment(distance).pose).x), float(pose.y)
        start, stop = cut.segments[:, 0], cut.segments[:, 1]
        share = np.clip((((x, y) - start) * (stop - start)).sum(axis=1) / ((stop - start) ** 2).sum(axis=1), 0, 1)
        assert np.hypot(*(start + share[:, None] * (stop - start) - (x, y)).T).min() < 1e-5


def test_rolling_stops_where_contacts_end(five: Boundary) -> None:
    # along the bounds
    assert roll(five, (0.0, 0.0), np.linspace(0, 1, 50).tolist(), 10.0) is None


def test_columns_tile_the_patches(five: Boundary) -> None:
    found = columns(five)
    parts = [part for column in found for part in column.parts]
    assert len(parts) == len(set(parts))
    height = sum(column.angles[-1] - column.angles[0] for column in found)
    table = five.trapezoids
    chosen = five.patch_kind[table.patch] != 3
    assert height == pytest.approx(float((table.theta_to - table.theta_from)[chosen].sum()))
    for column in found[::17]:
        angles = np.linspace(column.angles[0] + 1e-4, column.angles[-1] - 1e-4, 5)
        for moment in over_column(five, column, np.linspace(0, 1, 5), angles):
            assert is_free(five.checker, moment.pose)


def test_outward_is_away_from_the_forbidden_space(five: Boundary) -> None:
    for column in columns(five)[::9]:
        theta = 0.5 * (column.angles[0] + column.angles[-1])
        (moment,) = over_column(five, column, [0.5], [theta])
        x, y = float(moment.pose.x), float(moment.pose.y)
        dx, dy = 1e-6 * outward(five, column.patch, moment)
        turn = {"inf": "inf"} if moment.pose.tau is None else moment.pose.tau
        inside = Pose(x - dx, y - dy, {"tau": turn})
        assert not is_free(five.checker, inside)


# free motions


def test_shares_of_a_path_are_exact_poses_on_it_at_even_travel(five: Boundary) -> None:
    free = FreeMotions(five, extent(five))
    start, goal = Pose(1, "1.2"), Pose(11, "4.3", "120deg")
    path = free.path(start, goal)
    assert path is not None and path.is_free(MotionChecker(five.scene))
    poses = free.poses(path, np.linspace(0, 1, 200).tolist())
    assert poses[0] == start and (float(poses[-1].x), poses[-1].theta) == pytest.approx((11, goal.theta), abs=1e-9)
    assert all(is_free(five.checker, pose) for pose in poses)
    corners = Poses.from_poses(poses).apply(five.scene.robot[0].vertices)
    moved = np.linalg.norm(np.diff(corners, axis=0), axis=2).max(axis=1)
    assert moved.max() < 1.01 * free.travel(path) / 199 and np.median(moved) > 0.9 * moved.max()


def test_no_path_leads_through_a_wall() -> None:
    wall = [(4, -1), (5, -1), (5, 9), (4, 9)]
    result = boundary(Scene([(0, 0), (1, 0), (0, 1)], [wall], bounds=(0, 0, 8, 8)))
    free = FreeMotions(result, extent(result))
    assert free.path(Pose(1, 4), Pose(7, 4)) is None
    assert free.path(Pose(1, 4), Pose(1, 1, 1.0)) is not None
    far = free.farthest(Pose(1, 1))
    assert far is not None and float(far.x) < 4 and float(far.y) > 4  # on this side


def test_a_full_turn_has_room_where_it_is_made(five: Boundary) -> None:
    turn = FreeMotions(five, extent(five)).full_turn()
    assert turn is not None and turn.turning == pytest.approx(math.tau) and turn.is_free(MotionChecker(five.scene))
    rod, slot = [(-2, -0.25), (2, -0.25), (2, 0.25), (-2, 0.25)], [(-9, -1), (9, -1), (9, 1), (-9, 1)]
    narrow = boundary(Scene(rod, workspace=slot))
    assert FreeMotions(narrow, extent(narrow)).full_turn() is None


# frames


def test_what_is_swept_appears_and_stays(fig9: Boundary) -> None:
    (shots,) = shots_of([fig9], 120, "paper")
    stage = Stage(fig9, (160, 90), 25)
    heights = [(view.shown[:, 1] - view.shown[:, 0]).clip(0).sum() for view, _ in views(stage, shots, 25)]
    assert heights[0] == 0 and (np.diff(heights) > -1e-9).all()
    assert heights[-1] == pytest.approx(np.ptp(stage.space.angles, axis=1).sum())
    swept = next(k for k, (view, _) in enumerate(views(stage, shots, 25)) if view.title == shots[3].title)
    assert heights[swept] == pytest.approx(math.degrees(shots[2].swept.angles[-1] - shots[2].swept.angles[0]))  # type: ignore[union-attr]


@pytest.mark.slow
def test_the_camera_is_smooth_and_stays_in_its_quadrant(fig9: Boundary) -> None:
    (shots,) = shots_of([fig9], 750, "paper")
    azimuth = np.array([view.azimuth for view, _ in views(Stage(fig9, (160, 90), 25), shots, 25)])
    assert np.degrees(azimuth).min() > -90 and np.degrees(azimuth).max() < 0
    assert np.degrees(np.abs(np.diff(azimuth)).max()) < 1.5
    assert np.degrees(np.abs(np.diff(azimuth, 2)).max()) < 0.2


@pytest.mark.slow
def test_a_frame_has_the_colours_of_all_pictures_and_its_words(fig9: Boundary) -> None:
    (shots,) = shots_of([fig9], 120, "paper")
    stage = Stage(fig9, (640, 360), 25)
    frames = [view for view, _ in views(stage, shots, 25) if view.title == shots[4].title]
    image = stage.draw(frames[-1]) / 255
    red, green, blue = image[..., 0], image[..., 1], image[..., 2]
    assert image.shape == (360, 640, 3)
    assert np.count_nonzero((red > 1.5 * green) & (red > 2 * blue)) > 3000  # v-e patches
    assert np.count_nonzero((blue > 1.2 * green) & (green > 2 * red)) > 1500  # e-v patches
    assert np.count_nonzero((blue > 1.5 * green) & (green < 0.35)) > 100  # helices
    assert stage.caption.get_text() == caption(frames[-1].recent[-1].contact)
    assert stage.space.tag.get_text() == "θ = 360°"
    words = [stage.title, stage.note, stage.caption, stage.pose]
    boxes = [word.get_window_extent() for word in words]
    for box, other in itertools.combinations(boxes, 2):
        assert not box.overlaps(other)
    for box in boxes:
        assert box.x0 >= 0 and box.x1 <= 640


@pytest.mark.slow
@pytest.mark.parametrize("name", PAPER)
def test_frames_show_the_robot_in_its_pose_and_the_configuration_space_at_its_orientation(name: str) -> None:
    result, _ = tale(name)
    (shots,) = shots_of([result], 60, "paper")
    stage = Stage(result, (320, 180), 4)
    corners = result.scene.robot[0].vertices
    drawn = [patch.get_path() for patch in stage.plane.body.axes.patches]
    for obstacle in result.scene.obstacles:  # among all obstacles
        assert any({*map(tuple, obstacle.vertices)} <= {*map(tuple, path.vertices)} for path in drawn)
    for view, _ in itertools.islice(views(stage, shots, 4), 3, None, 9):
        image = stage.draw(view)
        pose = view.recent[-1].pose
        x, y, degrees = float(pose.x), float(pose.y), math.degrees(pose.theta)
        assert stage.plane.body.get_path().vertices[: len(corners)] == pytest.approx(pose.apply(corners))
        assert stage.plane.origin.get_xydata()[0] == pytest.approx((x, y))
        cut = result.slice(pose.theta).forbidden
        rings = stage.plane.region.get_path().to_polygons()  # holes run clockwise
        area = sum(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2 for x, y in ((r - r[0]).T for r in rings))
        assert area == pytest.approx(cut.area, rel=1e-6)
        # the point of the configuration space, as the camera sees it at that height
        camera = Camera(stage.space.window, *stage.space.panel, view.azimuth)
        assert stage.space.point.get_xydata()[0] == pytest.approx(camera(np.array([[x, y, degrees]]))[0][0])
        assert stage.space.tag.get_text() == f"θ = {degrees:.0f}°"
        touched = result.patch_kind[result.slice(pose.theta).patches] != PatchKind.BOUND
        assert len(stage.space.section.get_segments()) == touched.sum()
        assert np.ptp(image) > 200


def test_the_title_says_whether_theta_turns_between_slices(fig9: Boundary) -> None:
    for found in (fig9, boundary(Scene([(0, 0), (1, 0), (0, 1)], [[(4, 0), (5, 0), (5, 1), (4, 1)]]))):
        (shot,) = storyboard(found, 60, ("slices",))
        turns = len({moment.pose.theta for moment in shot.moments}) > 1
        assert ("constant orientation" in shot.title) == (not turns) and ("two slices" in shot.title) == turns


def test_later_scenes_show_what_is_new(fig9: Boundary, five: Boundary) -> None:
    first, second = shots_of([fig9, five], 60, "paper")
    assert [shot.kind for shot in first] == list(STORYBOARDS["paper"])
    assert [shot.kind for shot in second] == list(LATER)
    assert sum(len(shot.moments) for shot in [*first, *second]) == 60


# files


def test_orientations_without_contacts_are_left_out() -> None:
    """A rod in a slot that is narrower than the rod is long: forbidden everywhere from 30 to 150 degrees."""
    rod, slot = [(-2, -0.25), (2, -0.25), (2, 0.25), (-2, 0.25)], [(-9, -1), (9, -1), (9, 1), (-9, 1)]
    found = boundary(Scene(rod, [[(4, 0), (5, 0), (5, 0.2), (4, 0.2)]], workspace=slot))
    assert not len(found.slice("90deg").segments) and Ring.near(found, math.pi / 2, (0, 0)) is None
    assert [shot.kind for shot in storyboard(found, 40, ("slices", "helix"))] == ["slices", "helix"]


@pytest.mark.slow
def test_a_gif_of_a_scene_is_read_back(fig9: Boundary, tmp_path: Path) -> None:
    file, shares = tmp_path / "film.gif", []
    cfree.film.save_film([fig9], file, seconds=2, fps=10, size=(320, 180), progress=shares.append)
    with Image.open(file) as film:
        assert film.size == (320, 180)
        assert film.n_frames == 20  # type: ignore[attr-defined]
        assert film.info["duration"] == 100
    assert len(shares) == 20 and shares[-1] == 1 and [f.name for f in file.parent.iterdir()] == ["film.gif"]


@pytest.mark.slow
def test_an_mp4_is_read_back(fig9: Boundary, five: Boundary, tmp_path: Path) -> None:
    av = pytest.importorskip("av")
    file = tmp_path / "film.mp4"
    cfree.film.save_film([fig9, five], file, seconds=2, fps=12, size=(320, 180))
    with av.open(str(file)) as film:
        (stream,) = film.streams.video
        frames = list(film.decode(stream))
        assert (stream.width, stream.height, stream.average_rate) == (320, 180, 12)
    assert len(frames) == 24
    assert np.ptp(frames[5].to_ndarray(format="rgb24")) > 200


def test_without_pyav_one_line_says_what_to_install(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "av", None)
    with pytest.raises(UnsupportedError, match=r"pip install 'cfree\[video\]'"):
        cfree.film.save_film([], tmp_path / "film.mp4")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"seconds": 0}, "seconds"),
        ({"seconds": math.nan}, "seconds"),
        ({"fps": 0}, "frames a second"),
        ({"size": (321, 180)}, "even numbers"),
        ({"size": (20, 10)}, "160x90"),
        ({"scenes": 0}, "no scene"),
    ],
)
def test_options_without_sense_are_refused(options: dict[str, Any], message: str) -> None:
    sensible: dict[str, Any] = {"scenes": 1, "seconds": 10.0, "fps": 25, "size": (320, 180)}
    check_options(**sensible)
    with pytest.raises(ValueError, match=message):
        check_options(**(sensible | options))


# the command


def run(*arguments: object) -> Any:
    return CliRunner().invoke(app, ["film", *(str(argument) for argument in arguments)])


@pytest.mark.slow
def test_the_command_makes_a_film(tmp_path: Path) -> None:
    file = tmp_path / "film.gif"
    result = run(FIG9, "-o", file, "--seconds", 1, "--fps", 10, "--size", "160x90", "--storyboard", "path")
    assert result.exit_code == 0, result.output
    assert str(file) in result.stdout and "160x90" in result.stdout
    with Image.open(file) as film:
        assert film.size == (160, 90)
        assert film.n_frames == 10  # type: ignore[attr-defined]


def test_help_has_examples() -> None:
    result = run("--help")
    assert result.exit_code == 0
    assert "cfree film scene.json -o film.mp4" in " ".join(result.stdout.split())


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([FIG9, "-o", "film.avi"], "name the file .mp4 or .gif"),
        (["missing.json", "-o", "film.gif"], "missing.json"),
        ([FIG9, "-o", "film.gif", "--size", "wide"], "1280x720"),
        ([FIG9, "-o", "film.gif", "--storyboard", "opera"], "--storyboard: 'opera'; give"),
        ([FIG9, "-o", "film.gif", "--seconds", "0"], "seconds"),
        ([FIG9, "-o", FIG9], "is the input"),
        ([SCENES / "degenerate_own_hole.json", "-o", "film.gif"], "nothing to show"),
    ],
)
def test_bad_input_is_one_line_and_exit_code_2(
    arguments: list[object], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    arguments = [argument.resolve() if isinstance(argument, Path) else argument for argument in arguments]
    monkeypatch.chdir(tmp_path)
    result = run(*arguments)
    assert result.exit_code == 2
    assert message in result.stderr and result.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["gif", "mp4"])
def test_an_interrupt_leaves_no_file(suffix: str, tmp_path: Path) -> None:
    if suffix == "mp4":
        pytest.importorskip("av")
    file = tmp_path / f"film.{suffix}"
    process = subprocess.Popen(
        [sys.executable, "-m", "cfree", "film", str(FIG9), "-o", str(file), "--seconds", "60"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    deadline = time.monotonic() + 30
    while not _is_written(process.pid, tmp_path) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert _is_written(process.pid, tmp_path), "the film was never begun"
    time.sleep(0.5)
    os.kill(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=30)
    assert process.returncode == 130 and "interrupted" in errors
    assert not list(tmp_path.iterdir())


def test_an_interrupt_that_a_library_lost_ends_the_film(tmp_path: Path) -> None:
    def frames() -> Iterator[Any]:
        yield np.zeros((2, 2, 3), np.uint8)
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        yield np.ones((2, 2, 3), np.uint8)

    with pytest.raises(KeyboardInterrupt):
        write(frames(), tmp_path / "film.gif", fps=5)
    assert not list(tmp_path.iterdir()) and signal.getsignal(signal.SIGINT) is signal.default_int_handler


def _is_written(process: int, folder: Path) -> bool:
    """Does a process write a file into a folder, with a name or without one yet?"""
    handles = Path(f"/proc/{process}/fd")
    if not handles.exists():
        return bool(list(folder.iterdir()))
    found = False
    for handle in handles.iterdir():
        with contextlib.suppress(FileNotFoundError):  # closed meanwhile
            found |= str(folder) in os.readlink(handle)
    return found


# rounded shapes


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "kinds"),
    [
        ("round_stadium", "slices helix v-e e-v arc-arc pillar path"),
        ("round_gap", "slices helix v-e arc-arc pillar path"),
    ],
)
def test_contacts_of_rounded_shapes_are_shown(name: str, kinds: str) -> None:
    result, shots = tale(name)
    scene = result.scene
    arcs, radius = arcs_of(scene), robot_radius(scene)
    assert arcs is not None and [shot.kind for shot in shots] == kinds.split()
    for moment in (moment for shot in shots for moment in shot.moments):
        assert is_free(scene, moment.pose)
        if moment.contact is None:
            continue
        assert arcs.distance(moment.pose)[1] < 1e-8 * radius
        assert moment.touch is not None and caption(moment.contact, moment.touch).startswith(moment.contact.kind)
        point = shapely.Point(moment.touch.point)
        for line in (moment.touch.robot, moment.touch.obstacle):  # of arcs chords
            feature = shapely.LineString(line) if len(line) > 1 else shapely.Point(line[0])
            assert feature.distance(point) < 5e-3 * radius


def test_round_features_have_their_names() -> None:
    """A plate with two round corners against a disc: its edge, its arc and its corner touch."""
    plate = Curved([(-2, -1), (1, -1), Arc((2, 0), center=(1, 0)), Arc((1, 1), center=(1, 0)), (-2, 1)])
    scene = Scene(plate, [Curved.circle((6, 0), 1)])
    names, titles = set(), {}
    result = boundary(scene)
    for shot in storyboard(result, 60):
        titles[shot.kind] = shot.title
        names |= {caption(moment.contact, moment.touch) for moment in shot.moments if moment.contact is not None}
    assert titles["e-v"] == "An edge slides over an arc: an e-v patch"
    assert titles["arc-arc"] in {f"{first} slides over an arc: an arc-arc patch" for first in ("A vertex", "An arc")}
    assert any("edge" in name and name.endswith("on arc $b_{1}$ of $O_{1}$") for name in names)
    assert any("arc $a_{" in name for name in names) and any("vertex $a_{" in name for name in names)


@pytest.mark.slow
def test_a_film_among_rounded_shapes_is_written(tmp_path: Path) -> None:
    disc, file = tmp_path / "discs.json", tmp_path / "discs.gif"
    discs = [Curved.circle((x, 0), 1) for x in (0, 4)]
    cfree.save(Scene(discs[0], discs[1:], start=(0, 0, 0), goal=(4, 3, 0), bounds=(-2, -2, 6, 4)), disc)
    result = run(disc, "-o", file, "--seconds", 1, "--fps", 7, "--size", "160x90")
    assert result.exit_code == 0 and file.exists(), result.output
    refused = run(disc, "-o", file, "--storyboard", "separation")
    assert refused.exit_code == 2 and "there is a path from start to goal" in refused.output
