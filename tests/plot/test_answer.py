"""Pictures of answers: what their artists hold, for paths and separations of all sorts of scenes."""

import doctest
import math
import subprocess
import sys
import textwrap
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any

import numpy as np
import pytest
import shapely
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from PIL import Image

import cfree
from cfree import save
from cfree.collision.motion import Rotation, Translation, rotations
from cfree.collision.motion_checker import MotionChecker
from cfree.errors import UnsupportedError
from cfree.exact.pose import Pose
from cfree.film.frame import caption
from cfree.forbidden.boundary import Boundary, boundary
from cfree.forbidden.patch import Contact, Place
from cfree.formats.scene_file import load_scene
from cfree.palette import BARRIER
from cfree.paths.path import Path
from cfree.paths.travel import GHOSTS
from cfree.plot import unrolled as slab
from cfree.plot.answer import picture, plot_path_space, surface_of
from cfree.plot.blockers import plot_blockers
from cfree.plot.boundary import plot_overview, save_figure
from cfree.plot.depth_sort import Painting
from cfree.plot.path import Track, plot_path, quantity
from cfree.plot.pieces import CURVE, ON_TOP, OVER, WALL, patches_of
from cfree.plot.strips import strips
from cfree.scene.scene import Scene

SCENES = FilePath("examples/scenes")
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
CORRIDOR = [[(-3, "1.25"), (9, "1.25"), (9, 2), (-3, 2)], [(-3, -2), (9, -2), (9, "-0.125"), (-3, "-0.125")]]


@pytest.fixture(scope="module")
def car_park() -> Boundary:
    return boundary(load_scene(SCENES / "benchmr_parking1.json"))


@pytest.fixture(scope="module")
def parking(car_park: Boundary) -> Path:
    assert car_park.scene.start is not None
    moves = Translation(("5.55", "-0.3")), Rotation(("2.55", "-6"), "90deg"), Translation((0, "3.4"))
    return Path(car_park.scene.start, moves)


def artists(ax: Any) -> dict[str, Any]:
    found = [*ax.patches, *ax.collections, *ax.lines]
    return {artist.get_label(): artist for artist in found if not artist.get_label().startswith("_")}


@pytest.mark.slow
def test_the_examples_of_the_documentation_draw_what_it_shows(
    request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch, tmp_path: FilePath
) -> None:
    (tmp_path / "examples").symlink_to(request.config.rootpath / "examples")
    monkeypatch.chdir(tmp_path)
    result = doctest.testfile(str(request.config.rootpath / "docs" / "figures.md"), module_relative=False)
    assert result.attempted > 15 and result.failed == 0
    for name in ("path.png", "separation.png"):  # with what limits the path, or bars it
        with Image.open(tmp_path / name) as image:
            seen = np.asarray(image.convert("RGB")) / 255
        assert (np.abs(seen - to_rgb(BARRIER)).max(axis=-1) < 0.05).sum() > 100


# the plane


def test_the_path_of_the_car_park_is_free(car_park: Boundary, parking: Path) -> None:
    assert parking.is_free(MotionChecker(car_park.scene)) and parking.goal == car_park.scene.goal


@pytest.mark.slow
def test_ghosts_are_poses_of_the_path(car_park: Boundary, parking: Path) -> None:
    ghosts = artists(plot_path(parking, car_park.scene))["ghosts"]
    assert isinstance(ghosts, PathCollection)
    paths = ghosts.get_paths()
    assert 5 < len(paths) <= GHOSTS and len(ghosts.get_edgecolor()) == len(paths)
    obstacles = shapely.union_all([obstacle.to_shapely() for obstacle in car_park.scene.obstacles])
    area = car_park.scene.robot[0].area
    for path in paths:
        shape = shapely.Polygon(path.vertices[:-1])
        assert shape.area == pytest.approx(area, rel=1e-9)
        assert shapely.intersection(shape, obstacles).area < 1e-12


def test_ghosts_are_at_even_steps_and_there_are_none_while_turning_in_place() -> None:
    scene = Scene(robot=[(0, 0), (4, 0), (4, 1), (0, 1)], obstacles=[[(50, 50), (51, 50), (51, 51)]])
    for centre in ((0, 0), (2, "0.5")):  # the reference point, the middle
        turn = rotations(centre, "300deg")
        assert not len(Track.of(Path(Pose(0, 0), turn), scene).ghosts)
        there, back = Translation((30, 0)), Translation((30, 0))
        x = 30 + int(centre[0])
        track = Track.of(Path(Pose(0, 0), [there, *rotations((x, centre[1]), "180deg"), back]), scene)
        at = track.rows[track.ghosts]
        assert len(at) == GHOSTS and all(abs(math.sin(theta)) < 0.05 for theta in at[:, 2])
        xs = np.concatenate((at[np.cos(at[:, 2]) > 0, 0], at[np.cos(at[:, 2]) < 0, 0] - 2 * float(centre[0])))
        assert np.diff(xs) == pytest.approx(60 / 16, abs=0.3)
    around = Path(Pose(0, 0), rotations((20, 0), "90deg"))
    assert len(Track.of(around, scene).ghosts) > 5


@pytest.mark.slow
def test_the_trace_begins_at_the_start_and_ends_at_the_goal(car_park: Boundary, parking: Path) -> None:
    trace = artists(plot_path(parking, car_park.scene))["trace"]
    assert isinstance(trace, LineCollection)
    ends = np.array(trace.get_segments())
    assert ends[0, 0] == pytest.approx([-3, -7.2]) and ends[-1, 1] == pytest.approx([4.05, -2.6])
    assert (ends[1:, 0] == ends[:-1, 1]).all()
    # the rim is below, and as long
    assert np.hypot(*(ends[:, 1] - ends[:, 0]).T).sum() == pytest.approx(parking.length, rel=1e-3)


def test_the_least_clearance_is_marked_with_what_limits_it() -> None:
    scene = Scene(robot=SQUARE, obstacles=[*CORRIDOR, [(20, 20), (21, 20), (21, 21)]], units="m")
    path = Path(Pose(0, 0), [Translation((5, 0))])
    ax = plot_path(path, scene)
    assert "0.125 m" in [text.get_text() for text in ax.texts]
    # 0.125 below and 0.25 above, which is twice that; what is far limits nothing
    ring = artists(ax)["limiting obstacles"].get_path()
    assert (ring.codes == ring.MOVETO).sum() == 2
    assert ax.get_title() == "1 motion, length 5 m, turning 0°, clearance 0.125 m (≥ 0.124 proved)"
    bar = ax.figure.axes[-1]
    assert bar.get_ylabel() == "clearance (m)"
    assert any(line.get_ydata()[0] == pytest.approx(0.125) for line in bar.lines if line.get_color() == BARRIER)


def test_colours_are_those_of_the_clearance() -> None:
    scene = Scene(robot=SQUARE, obstacles=[(2, "1.25"), (5, "1.25"), (5, 3), (2, 3)])
    track = Track.of(Path(Pose(-4, 0), [Translation((12, 0))]), scene)
    walls = scene.obstacles[0].to_shapely()
    for row, distance in zip(track.rows[::60], track.distance[::60], strict=True):
        placed = shapely.Polygon(np.array(SQUARE) + row[:2])
        assert distance == pytest.approx(placed.distance(walls), abs=1e-12)
    near, far = track.colour(np.array([0.0, track.most]))
    # of the scale's two ends the dark one is near: that is seen in grey, too
    assert near[:3].sum() < 0.6 * far[:3].sum()


@pytest.mark.slow
def test_start_and_goal_are_named_and_drawn_where_they_are(parking: Path, car_park: Boundary) -> None:
    ax = plot_path(parking, car_park.scene)
    assert {"start", "goal"} <= {text.get_text() for text in ax.texts}
    dots = np.array([line.get_xydata()[0] for line in ax.lines if len(line.get_xydata()) == 1])
    for end in ((-3, -7.2), (4.05, -2.6)):
        assert np.hypot(*(dots - end).T).min() < 1e-9


def test_a_path_that_is_not_free_is_refused(car_park: Boundary) -> None:
    assert car_park.scene.start is not None
    path = Path(car_park.scene.start, [Translation((20, 5))])
    for draw in (plot_path, picture):
        with pytest.raises(ValueError, match="not free"):
            draw(path, car_park.scene)


@pytest.mark.slow
@pytest.mark.parametrize("size", ["1e-9", "1", "1e9"])
def test_pictures_are_alike_in_any_unit(size: str) -> None:
    n = cfree.exact.number.to_fraction(size)

    def scaled(points: list[tuple[Any, Any]]) -> list[tuple[Any, Any]]:
        return [(cfree.exact.number.to_fraction(x) * n, cfree.exact.number.to_fraction(y) * n) for x, y in points]

    scene = Scene(robot=scaled(SQUARE), obstacles=[scaled(wall) for wall in CORRIDOR])
    path = Path(Pose(0, 0), [Translation((5 * n, 0))])
    figure = picture(path, scene, boundary(scene))
    figure.canvas.draw()
    plane = figure.axes[0]
    x0, x1 = np.array(plane.get_xlim()) / float(n)
    assert (x0, x1) == pytest.approx((-3.36, 9.36), abs=0.5)
    assert len(artists(plane)["ghosts"].get_paths()) == 5


@pytest.mark.slow
@pytest.mark.parametrize("path", [Path(Pose(0, 0), []), Path(Pose(0, 0), rotations((0, 0), "720deg"))])
@pytest.mark.parametrize("obstacles", [[], [[(4, 0), (5, 0), (5, 1)]]], ids=["nothing", "a triangle"])
def test_paths_that_go_nowhere_and_empty_scenes_are_drawn(path: Path, obstacles: list[Any], tmp_path: FilePath) -> None:
    scene = Scene(robot=SQUARE, obstacles=obstacles)
    save_figure(picture(path, scene, boundary(scene)), tmp_path / "way.png")
    assert ("clearance" in picture(path, scene).texts[1].get_text()) == bool(obstacles)


@pytest.mark.slow
def test_a_path_of_500_motions_is_drawn() -> None:
    random = np.random.default_rng(5)
    moves: list[Any] = []
    for _ in range(250):
        x, y = (str(round(float(v), 3)) for v in random.normal(size=2))
        moves += [Translation((x, y)), Rotation((y, x), f"{int(random.integers(-60, 60))}deg")]
    scene = Scene(robot=SQUARE, obstacles=[[(500, 500), (501, 500), (501, 501)]])
    track = Track.of(Path(Pose(0, 0), moves), scene)
    assert len(track.ghosts) == GHOSTS
    plot_path(track.path, scene).figure.canvas.draw()


@pytest.mark.slow
def test_found_paths_are_drawn_in_every_format(tmp_path: FilePath) -> None:
    scene = load_scene(SCENES / "comb_hook.json")
    path, found = cfree.plan(scene), boundary(scene)
    figure = picture(path, scene, found)
    for suffix in (".png", ".svg", ".pdf"):
        save_figure(figure, tmp_path / f"way{suffix}")
    with Image.open(tmp_path / "way.png") as image:
        seen = np.asarray(image.convert("RGB")) / 255
    assert (np.abs(seen - to_rgb(BARRIER)).max(axis=-1) < 0.05).sum() > 100  # the least clearance
    root = ElementTree.parse(tmp_path / "way.svg").getroot()
    assert any(to_hex(BARRIER) in element.get("style", "").lower() for element in root.iter())
    assert (tmp_path / "way.svg").stat().st_size < 3_000_000
    pdf = (tmp_path / "way.pdf").read_bytes()
    assert pdf.startswith(b"%PDF") and pdf.rstrip().endswith(b"%%EOF")
    with pytest.raises(UnsupportedError):
        save_figure(figure, tmp_path / "way.docx")


def test_units_that_are_words_stand_at_the_axes_only() -> None:
    assert quantity(0.0236, "corridor widths") == "0.0236"
    scene = Scene(robot=SQUARE, obstacles=CORRIDOR, units="corridor widths")
    ax = plot_path(Path(Pose(0, 0), [Translation((5, 0))]), scene)
    assert "corridor" not in ax.get_title() and ax.get_xlabel() == "x (corridor widths)"


# configuration space


def painting_of(ax: Any) -> Painting:
    (painting,) = (c for c in ax.collections if isinstance(c, Painting))
    return painting


def test_theta_is_unrolled_beyond_full_turns() -> None:
    scene = Scene(robot=SQUARE, obstacles=[[(2, 0), (3, 0), (3, 1)]])
    start = Pose(0, 0, "300deg")
    ax = plot_path_space(Path(start, rotations((0, 0), "500deg")), boundary(scene))
    assert ax.get_zlim() == pytest.approx((285, 815))
    pieces = painting_of(ax)._pieces
    line = pieces.corners[pieces.sort == OVER]
    assert line[:, 0, 2] == pytest.approx(300 + 500 * np.arange(599) / 599)
    # the patches are there in each turn
    faces = pieces.corners[pieces.sort < CURVE][..., 2].mean(axis=1)
    assert all(((faces > low) & (faces < low + 90)).any() for low in range(290, 720, 90))


@pytest.mark.slow
def test_patches_far_from_the_path_are_left_out(car_park: Boundary, parking: Path) -> None:
    ax = plot_path_space(parking, car_park)
    pieces = painting_of(ax)._pieces
    faces = pieces.sort < CURVE
    track = Track.of(parking, car_park.scene)
    radius = cfree.forbidden.mesh.robot_radius(car_park.scene)
    rows = track.rows * (1, 1, 180 / math.pi)
    assert faces.any() and slab.distances(pieces, rows, radius)[faces].max() < 2 * radius * 1.01
    assert len(pieces.corners) < len(patches_of(car_park, track.window).corners)
    assert not (pieces.sort == WALL).any()


@pytest.mark.slow
def test_hidden_parts_are_dashed_and_the_rest_is_among_the_patches(car_park: Boundary, parking: Path) -> None:
    ax = plot_path_space(parking, car_park)
    pieces = painting_of(ax)._pieces
    line, dashes = ((pieces.sort == sort).sum() for sort in (OVER, ON_TOP))
    assert dashes == pytest.approx(line / 2, abs=8)
    ax.figure.canvas.draw()
    assert {"start", "goal"} == {text.get_text().strip() for text in ax.texts}


def test_pieces_of_a_slab_are_within_its_angles_and_lie_on_the_patches() -> None:
    found = boundary(load_scene(SCENES / "paper_fig9.json"))
    window = (-10.0, -10.0, 20.0, 20.0)
    whole = patches_of(found, window)
    part = slab.slab(whole, window, (-100.0, 420.0))
    z = part.corners[..., 2]
    assert z.min() == -100 and z.max() == 420
    height = {turn: np.ptp(z[(z.mean(axis=1) // 360) == turn], axis=1).sum() for turn in (-1, 0, 1)}
    assert height[0] == pytest.approx(np.ptp(whole.corners[whole.sort != WALL][..., 2], axis=1).sum())
    faces = np.flatnonzero(part.sort < CURVE)
    assert (part.owner[faces] == faces).all()
    curves = (part.sort == CURVE) & (part.owner >= 0)
    assert (part.sort[part.owner[curves]] < CURVE).all()
    # cut ends are on the straight sides of the faces that were cut
    cut = part.corners[(z.max(axis=1) == 420) & (part.sort < CURVE)]
    assert len(cut)
    for corners in cut[:20]:
        at = found.slice(math.radians(60.0)).segments
        ends = corners[2:, :2]
        gap = min(shapely.LineString(segment).distance(shapely.Point(ends[0])) for segment in at)
        assert gap < 0.01


def test_axes_of_two_dimensions_are_refused(car_park: Boundary, parking: Path) -> None:
    with pytest.raises(TypeError, match="give an Axes3D or None"):
        plot_path_space(parking, car_park, Figure().add_subplot())  # type: ignore[arg-type]


@pytest.mark.slow
def test_the_headline_says_what_it_is(car_park: Boundary, parking: Path) -> None:
    figure = picture(parking, car_park.scene, car_park)
    assert [text.get_text() for text in figure.texts] == [
        "benchmr_parking1: a free path",
        "3 motions, length 11.3, turning 90°, clearance 0.171 (≥ 0.17 proved)",
    ]
    assert len(figure.axes) == 3  # workspace, colours, configuration space
    assert len(picture(parking, car_park.scene).axes) == 2


# separations


@pytest.mark.slow
def test_answers_and_scenes_plot_themselves(tmp_path: FilePath) -> None:
    """As `picture` does, of their own scene, or of one that is given to an answer from a file."""

    def texts(figure: Figure) -> list[str]:
        return [text.get_text() for text in (*figure.texts, *(ax.title for ax in figure.axes))]

    wall, hall = [(4, -9), (5, -9), (5, 9), (4, 9)], [(0, 0), (9, 0), (9, 3), (0, 3)]
    scene = Scene(SQUARE, [wall], workspace=hall, start=(1, 1, 0), goals=[(2, 1), (3, 2, 0)], name="hall")
    path, proof, proofs = cfree.plan(scene), cfree.plan(scene, goal=(7, 1, 0)), cfree.plan(scene, goal=(7, 1))
    assert isinstance(path, Path) and isinstance(proof, cfree.Separated) and isinstance(proofs, cfree.AllSeparated)
    whole = boundary(scene)
    for answer in (path, proof, proofs):
        assert texts(answer.plot()) == texts(picture(answer)) == texts(picture(answer, scene))
        save(answer, tmp_path / "answer.json")
        read = cfree.load(tmp_path / "answer.json")
        assert isinstance(read, type(answer)) and texts(read.plot(scene)) == texts(answer.plot())
        with pytest.raises(ValueError, match="scene: the answer knows none"):
            read.plot()
    assert len(path.plot(boundary=whole, preferences=cfree.Preferences(sideways=2)).axes) > len(path.plot().axes)
    assert texts(scene.plot()) == texts(picture(scene)) == ["workspace"]
    with pytest.raises(ValueError, match="a scene is drawn alone"):
        picture(scene, scene)
    disc = Scene(cfree.Curved.circle((0, 0), 1), [wall], bounds=(-3, -3, 3, 3), start=(0, 0, 0), goal=(1, 0, 0))
    assert texts(disc.plot()) == ["workspace"] and texts(cfree.plan(disc).plot())  # type: ignore[union-attr]


def test_nothing_is_drawn_with_before_it_is_asked_for() -> None:
    """matplotlib takes a quarter of a second, which planning does not need."""
    program = """
        import sys, cfree
        scene = cfree.Scene([(0, 0), (1, 0), (0, 1)], start=(0, 0, 0), goal=(1, 0, 0))
        path = cfree.plan(scene)
        assert cfree.is_free(scene, path.goal) and callable(path.plot) and callable(scene.plot)
        assert "matplotlib" not in sys.modules
    """
    subprocess.run([sys.executable, "-c", textwrap.dedent(program)], check=True)


ROOM = [[(0, 0), (8, 0), (8, 1), (0, 1)], [(0, 5), (8, 5), (8, 6), (0, 6)], [(0, 0), (1, 0), (1, 6), (0, 6)],
        [(7, 0), (8, 0), (8, "2.6"), (7, "2.6")], [(7, "3.4"), (8, "3.4"), (8, 6), (7, 6)],
        [(12, 0), (13, 0), (13, 1)]]  # fmt: skip
BOX = [(-1, "-0.45"), (1, "-0.45"), (1, "0.45"), (-1, "0.45")]


@pytest.mark.slow
def test_a_separation_shows_its_barrier_and_its_surface() -> None:
    scene = Scene(robot=BOX, obstacles=ROOM, bounds=(-1, -1, 14, 7), units="m")
    answer = cfree.plan(scene, Pose(3, 3), Pose(11, 3, "90deg"))
    figure = picture(answer, scene)
    assert figure.texts[0].get_text() == "no path from start to goal"
    assert figure.texts[1].get_text().startswith("separated by obstacle 0, ")
    plane, room = figure.axes
    barrier = artists(plane)["barrier"].get_path()
    assert (barrier.codes == barrier.MOVETO).sum() == 5
    pieces = painting_of(room)._pieces
    faces = pieces.corners[pieces.sort < CURVE]
    # the reference point stays inside the room: so does the surface around it
    assert faces[..., :2].min() > 1 and faces[..., 0].max() < 8 and np.ptp(faces[..., 2]) == pytest.approx(360)
    assert [text.get_text().strip() for text in room.texts] == ["start"]  # the goal is out of the picture
    assert [text.get_text() for text in room.get_legend().get_texts()] == ["v-e contacts", "e-v contacts"]
    figure.canvas.draw()


def test_a_surface_is_made_of_contacts(tmp_path: FilePath) -> None:
    scene = Scene(robot=BOX, obstacles=ROOM, bounds=(-1, -1, 14, 7))
    answer = cfree.plan(scene, Pose(3, 3), Pose(11, 3, "90deg"))
    save(answer, tmp_path / "answer.json")
    for proof in (answer, cfree.load(tmp_path / "answer.json")):
        assert isinstance(proof, cfree.Separated) and proof.of == "closed"
        surface = surface_of(proof, scene)
        rows = strips(surface, 0.5)
        walls = shapely.union_all([obstacle.to_shapely() for obstacle in scene.obstacles])
        robot = surface.scene.robot[0].vertices
        for (first, second), theta in zip(rows.points, rows.theta, strict=True):
            for x, y in (first, (first + second) / 2, second):
                placed = shapely.Polygon(Pose(x, y, theta).apply(robot))
                assert placed.distance(walls.boundary) < 1e-9  # it may overlap another wall behind


@pytest.mark.slow
def test_separations_by_bounds_and_workspace_are_marked() -> None:
    hall = [(-9, -9), (20, -9), (20, 9), (-9, 9)]
    wall = [[(4, -10), (5, -10), (5, 10), (4, 10)]]
    scene = Scene(robot=BOX, obstacles=wall, bounds=(-4, -3, 14, 3), workspace=hall)
    answer = cfree.plan(scene, Pose(0, 0), Pose(8, 0))
    assert isinstance(answer, cfree.Separated)
    figure = picture(replace(answer, of="interior", robot=(), bounds=None), scene)
    assert figure.texts[0].get_text() == "no path of positive clearance from start to goal"
    names = artists(picture(answer, scene).axes[0])
    assert {"barrier", "bounds"} <= set(names) and to_rgb(names["bounds"].get_edgecolor()) == to_rgb(BARRIER)
    scene = Scene(robot=BOX, obstacles=wall, workspace=hall, name="hall")
    answer = cfree.plan(scene, Pose(0, 0), Pose(8, 0))
    figure = picture(answer, scene)
    assert to_rgb(artists(figure.axes[0])["workspace"].get_edgecolor()) == to_rgb(BARRIER)
    assert [text.get_text() for text in figure.texts] == [
        "hall: no path from start to goal", "separated by the workspace; obstacle 0, 1 x 20 at (4.5, 0)",
    ]  # fmt: skip


@pytest.mark.slow
def test_names_that_look_like_formulas_or_control_characters_are_shown_as_written(tmp_path: FilePath) -> None:
    name = "$\\bad{$\x1b"
    box = [(3, -9), (5, -9), (5, 9), (3, 9)]
    scene = Scene(SQUARE, [box], obstacle_names=[name], bounds=(0, -3, 8, 3), name=name, units="$\\b")
    blocked, path = cfree.plan(scene, (1, 1, 0), (6, 1, 0)), Path(Pose(1, 1), [Translation((0, -1))])
    for answer, suffix in ((blocked, ".svg"), (path, ".png")):
        figure = picture(answer, scene)
        save_figure(figure, tmp_path / f"answer{suffix}")
        assert figure.texts[0].get_text().startswith(r"\$\bad{\$\x1b: ")
    whole = boundary(scene)
    save_figure(plot_overview(whole), tmp_path / "boundary.png")
    cfree.film.film_path(path, scene, tmp_path / "path.gif", seconds=0.4, fps=5, size=(160, 90))
    contact = Contact("e-v", Place(0, "robot", 0, 0, 1), Place(0, name, 0, 0))
    assert caption(contact).endswith(" of $O_{1}$")


@pytest.mark.slow
def test_a_small_obstacle_that_parts_is_pointed_at() -> None:
    hall = [(-20, -10), (20, -10), (20, 10), (-20, 10)]
    walls = [
        [(0, -10), ("0.5", -10), ("0.5", "-0.2"), (0, "-0.2")],
        [(0, "0.22"), ("0.5", "0.22"), ("0.5", 10), (0, 10)],
    ]
    pin = [("0.2", 0), ("0.22", 0), ("0.22", "0.02"), ("0.2", "0.02")]
    robot = [("-0.2", "-0.2"), ("0.2", "-0.2"), ("0.2", "0.2"), ("-0.2", "0.2")]
    scene = Scene(robot, [*walls, pin], workspace=hall, obstacle_names=[None, None, "pin"])
    answer = cfree.plan(scene, Pose(-5, 0), Pose(5, 3))
    assert isinstance(answer, cfree.Separated) and answer.obstacles == (-2, 0, 1, 2)
    ax = picture(answer, scene).axes[0]
    rings = [line for line in ax.lines if line.get_label() == "pointed at"]
    assert [tuple(map(float, line.get_xydata()[0].round(6))) for line in rings] == [(0.21, 0.01)]
    (name,) = (text for text in ax.texts if text.get_text().startswith("obstacle 2 (pin)"))
    assert "0.02 x 0.02 at" in " ".join(name.get_text().split())
    assert tuple(np.round(name.xy, 6)) == (0.21, 0.01)  # the line to it leads there
    (found,) = plot_blockers(cfree.blockers(scene, Pose(-5, 0), Pose(5, 3))[-1:], scene).axes[:1]
    assert [line.get_label() for line in found.lines].count("pointed at") == 1
