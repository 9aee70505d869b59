"""Figures: on given axes, with labels, legend and the paper's colours, without a display."""

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import rgb_to_hsv, to_rgb
from matplotlib.figure import Figure
from PIL import Image

from cfree.errors import UnsupportedError
from cfree.exact.pose import Pose
from cfree.forbidden.boundary import Boundary, boundary
from cfree.forbidden.isolated import isolated_at, isolated_lines
from cfree.forbidden.kinds import COLOURS, PatchKind
from cfree.formats.scene_file import load_scene
from cfree.palette import EDGE_EDGE, EDGE_VERTEX, HELIX, MARK, VERTEX_EDGE
from cfree.plot import depth_sort, pieces
from cfree.plot.boundary import (
    extent,
    legend_below,
    new_axes,
    plot_boundary,
    plot_overview,
    plot_slice,
    plot_workspace,
    save_figure,
)
from cfree.scene.scene import Scene
from compared import scene_of
from overlaps import touching
from shapes import PlainScene, box

SCENES = Path("examples/scenes")
TRIANGLE = [(0, 0), (1, 0), (0, 1)]
SQUARE = [(3, 3), (5, 3), (5, 5), (3, 5)]


@pytest.fixture(scope="module")
def fig9() -> Boundary:
    return boundary(load_scene(SCENES / "paper_fig9.json"))


@pytest.mark.parametrize("count", [4, 6, 9])
def test_a_legend_is_in_the_figure_whatever_its_width(count: int) -> None:
    ax = new_axes((7, 6))
    for k in range(count):
        ax.plot([0, 1], [k, 2], label=f"contact {k}")
    ax.set_aspect("equal")
    legend_below(ax, ncols=count)
    ax.figure.canvas.draw()
    legend = ax.get_legend()
    assert legend is not None
    box, figure = legend.get_window_extent(), ax.figure.bbox
    assert figure.x0 <= box.x0 and box.x1 <= figure.x1 + 1


def pixels(figure: Figure) -> np.ndarray:
    canvas = figure.canvas
    assert isinstance(canvas, FigureCanvasAgg)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3] / 255


# the boundary in three dimensions


@pytest.mark.slow
def test_axes_are_labelled_and_the_legend_names_every_colour(fig9: Boundary) -> None:
    ax = plot_boundary(fig9)
    ax.figure.canvas.draw()
    assert (ax.get_xlabel(), ax.get_ylabel(), ax.get_zlabel()) == ("x", "y", "θ")
    assert [label.get_text() for label in ax.get_zticklabels()] == ["0°", "90°", "180°", "270°", "360°"]
    names = [text.get_text() for text in ax.get_legend().get_texts()]
    assert names == ["v-e patch", "e-v patch", "v-v helix", "e-e line", "bounds", "section at 360°"]


@pytest.mark.slow
def test_the_palettes_colours_are_seen(fig9: Boundary) -> None:
    ax = plot_boundary(fig9)
    ax.get_legend().remove()
    seen = rgb_to_hsv(pixels(ax.figure))
    for colour, least in ((VERTEX_EDGE, 10_000), (EDGE_VERTEX, 10_000), (HELIX, 200), (EDGE_EDGE, 200)):
        hue, _, value = rgb_to_hsv(to_rgb(colour))
        near = (np.abs(seen[..., 0] - hue) < 0.03) & (seen[..., 1] > 0.45) & (np.abs(seen[..., 2] - value) < 0.3)
        assert np.count_nonzero(near) > least, colour


def test_units_are_in_the_labels() -> None:
    ax = plot_boundary(boundary(Scene(robot=TRIANGLE, obstacles=SQUARE, units="m")))
    assert ax.get_xlabel() == "x (m)"


@pytest.mark.slow
def test_given_axes_are_used(fig9: Boundary) -> None:
    figure = Figure()
    space, plane = figure.add_subplot(1, 2, 1, projection="3d"), figure.add_subplot(1, 2, 2)
    assert plot_boundary(fig9, space) is space
    assert plot_slice(fig9.slice(0.3), plane) is plane
    assert plot_workspace(fig9.scene, plane) is plane
    with pytest.raises(TypeError, match="give an Axes3D or None"):
        plot_boundary(fig9, plane)


def test_pieces_of_one_convex_pair_are_those_of_the_paper() -> None:
    scene = load_scene(SCENES / "paper_fig9.json")
    result = boundary(Scene(robot=scene.robot, obstacles=scene.obstacles))
    shown = pieces.pieces_of(result, extent(result))
    assert shown.corners[..., 2].min() == 0 and shown.corners[..., 2].max() == pytest.approx(360)
    curves = {
        colour: (shown.sort == pieces.CURVE) & (shown.rgb == to_rgb(colour)).all(axis=1)
        for colour in (pieces.Colours.helix, pieces.Colours.edge_edge)
    }
    # n m = 9 e-e lines, |E_i| + |E_j| long, level, each between the ends of patches above and below it
    lines = shown.corners[curves[pieces.Colours.edge_edge]]
    assert np.ptp(lines[..., 2], axis=1).max() < 1e-12
    lengths = np.add.outer(*(np.hypot(*shape.edges.T) for shape in (scene.robot[0], scene.obstacles[0])))
    assert np.hypot(*(lines[:, 1] - lines[:, 0])[:, :2].T).sum() == pytest.approx(2 * lengths.sum(), rel=1e-9)
    # n m helices, 2 pi - rho - omega high, each between two patches
    heights = np.ptp(shown.corners[curves[pieces.Colours.helix]][..., 2], axis=1).sum()
    angles = np.add.outer(scene.robot[0].interior_angles, scene.obstacles[0].interior_angles)
    assert heights == pytest.approx(2 * np.degrees(2 * np.pi - angles).sum(), rel=1e-9)


@pytest.mark.slow
def test_the_free_side_is_in_front_and_the_forbidden_side_a_ghost(fig9: Boundary) -> None:
    ax = plot_boundary(fig9)
    ax.figure.canvas.draw()
    (painting,) = ax.collections
    alpha = painting.get_facecolor()[:, 3]
    assert {depth_sort.GHOST, depth_sort.GLASS, 1.0} <= set(np.round(alpha, 12))


@pytest.mark.slow
def test_depth_is_sorted_again_when_the_view_turns(fig9: Boundary) -> None:
    ax = plot_boundary(fig9)
    ax.figure.canvas.draw()
    (painting,) = ax.collections
    before = painting.get_facecolor().copy()
    ax.view_init(30, 120)
    ax.figure.canvas.draw()
    after = painting.get_facecolor()
    assert before.shape != after.shape or (before != after).any()


# in the plane


def test_slices_show_the_region_and_the_kinds_of_contact(fig9: Boundary) -> None:
    ax = plot_slice(fig9.slice("80deg"))
    assert {c.get_label() for c in ax.collections} == {"v-e", "e-v", "bound"}
    red = next(c for c in ax.collections if c.get_label() == "v-e")
    assert tuple(red.get_colors()[0][:3]) == to_rgb(COLOURS[1])
    assert ax.get_aspect() == 1 and "θ = " in ax.get_title()


def test_the_workspace_shows_the_robot_at_start_and_goal() -> None:
    scene = load_scene(SCENES / "benchmr_parking1.json")
    ax = plot_workspace(scene)
    assert {"start", "goal"} <= {text.get_text() for text in ax.texts}
    x0, x1 = ax.get_xlim()
    assert x0 < float(scene.bounds[0]) and x1 > float(scene.bounds[2])


def test_goals_are_robots_or_stars_where_they_are() -> None:
    ax = plot_workspace(Scene(TRIANGLE, SQUARE, start=(0, 0, 0), goals=[(9, 0), (0, 3, "90deg")]))
    (star,) = [line for line in ax.lines if line.get_marker() == "*"]
    assert star.get_xydata().tolist() == [[9, 0]] and star.get_label() == "goal, any theta"
    assert {"start", "goal 1"} == {text.get_text() for text in ax.texts} - {""}
    corners = [patch.get_path().vertices[:3].round(9).tolist() for patch in ax.patches]
    assert [[0, 3], [0, 4], [-1, 3]] in corners and [[0, 0], [1, 0], [0, 1]] in corners


def test_without_poses_the_robot_stands_at_rest() -> None:
    ax = plot_workspace(Scene(robot=TRIANGLE, obstacles=SQUARE))
    assert "at rest" in {text.get_text() for text in ax.texts}


def test_holes_are_seen_through() -> None:
    island = load_scene(SCENES / "degenerate_island.json")
    ax = plot_workspace(Scene(robot=[(4.9, 4.9), (5.1, 4.9), (5, 5.1)], obstacles=island.obstacles))
    image = pixels(ax.figure)

    def at(x: float, y: float) -> np.ndarray:
        column, row = ax.transData.transform((x, y)).astype(int)
        return image[len(image) - row, column]

    assert (at(0.5, 0.5) < 0.5).all() and (at(2, 7) == 1).all() and (at(4, 4) < 0.5).all()


# everything at once


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["five_convex", "degenerate_no_obstacles", "degenerate_own_hole", "degenerate_workspace"]
)
def test_overviews_of_all_sorts_of_scenes_are_drawn(name: str, tmp_path: Path) -> None:
    file, found = tmp_path / f"{name}.png", boundary(load_scene(SCENES / f"{name}.json"))
    figure = plot_overview(found)
    plan, first, second, space = figure.axes
    assert plan.get_title() == "workspace" and figure.get_suptitle() == found.scene.name
    assert len(plan.patches) >= len(found.scene.obstacles)
    for ax in (first, second):
        theta = float(ax.get_title().removeprefix("slice at θ = ").removesuffix("°"))
        inside, workspace = found.slice(f"{theta}deg").forbidden, found.scene.workspace
        inside = inside if workspace is None else inside.intersection(workspace.to_shapely())
        assert drawn_area(ax) == pytest.approx(inside.area, rel=1e-3)
    (painting,) = [c for c in space.collections if isinstance(c, depth_sort.Painting)]
    faces = painting._pieces.sort < pieces.SECTION
    assert faces.any() == bool(len(found.trapezoids))
    save_figure(figure, file)
    with Image.open(file) as image:
        assert image.size == tuple(int(160 * inches) for inches in figure.get_size_inches())
    assert [entry.name for entry in file.parent.iterdir()] == [file.name]


def test_overviews_count_contact_patches_and_sides_of_the_bounds_apart() -> None:
    figure = plot_overview(boundary(load_scene(SCENES / "paper_fig9.json")))
    (counts,) = [text.get_text() for text in figure.texts if "patches" in text.get_text()]
    assert counts.startswith("18 of 18 contact patches and 4 of 4 sides of the bounds bound the forbidden space: 38")


def drawn_area(ax: Any) -> float:
    """Of the region that is drawn as forbidden; its rings are closed, and holes run clockwise."""
    (region,) = [patch.get_path() for patch in ax.patches if patch.get_label() == "forbidden"]
    corners, total = region.vertices, 0.0
    starts = [*np.flatnonzero(region.codes == region.MOVETO), len(corners)] if len(corners) else [0]
    for i, j in pairwise(starts):
        x, y = (corners[i:j] - corners[i]).T
        total += (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    return total


@pytest.mark.slow
def test_an_empty_boundary_can_be_drawn() -> None:
    empty = boundary(Scene(robot=TRIANGLE))
    figure = plot_overview(empty)
    assert np.ptp(pixels(figure)) > 0.9
    assert set(re.findall(r"\d+", " ".join(text.get_text() for text in figure.texts))) == {"0"}  # of everything
    plan, *cuts, space = figure.axes
    outlines = [patch.get_path().vertices for patch in plan.patches]
    assert any({*map(tuple, TRIANGLE)} <= {*map(tuple, corners)} for corners in outlines)
    assert [drawn_area(ax) for ax in cuts] == [0, 0]  # nothing is forbidden
    (painting,) = [found for found in space.collections if isinstance(found, depth_sort.Painting)]
    assert not (painting._pieces.sort < pieces.SECTION).any()


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".svg", ".pdf", ".jpg", ".webp"])
def test_other_formats_are_written(fig9: Boundary, suffix: str, tmp_path: Path) -> None:
    file, ax = tmp_path / f"slice{suffix}", plot_slice(fig9.slice(1.0))
    save_figure(ax.figure, file)
    width, height = ax.figure.get_size_inches()
    if suffix == ".svg":
        root = ElementTree.parse(file).getroot()
        shades = {part.lower() for e in root.iter() for part in re.findall(r"#[0-9a-fA-F]{6}", e.get("style", ""))}
        assert {COLOURS[kind] for kind in (PatchKind.VERTEX_EDGE, PatchKind.EDGE_VERTEX)} <= shades
    elif suffix == ".pdf":
        assert file.read_bytes().startswith(b"%PDF") and file.read_bytes().rstrip().endswith(b"%%EOF")
    else:
        with Image.open(file) as image:
            assert image.size == (160 * width, 160 * height)
            seen = np.asarray(image.convert("RGB")) / 255
        assert (np.abs(seen - to_rgb(COLOURS[PatchKind.VERTEX_EDGE])).max(axis=-1) < 0.2).sum() > 200


def test_unknown_formats_are_refused(fig9: Boundary, tmp_path: Path) -> None:
    with pytest.raises(UnsupportedError, match=r"name the file \.png"):
        save_figure(plot_slice(fig9.slice(1.0)).figure, tmp_path / "slice.docx")
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_no_global_state_of_pyplot_is_touched() -> None:
    program = (
        "import sys, cfree\n"
        "assert 'matplotlib' not in sys.modules\n"
        "sys.modules['pyvista'] = None\n"  # imports pyplot itself
        "import cfree.plot.boundary as plot\n"
        "scene = cfree.load_scene('examples/scenes/paper_fig9.json')\n"
        "plot.plot_boundary(cfree.boundary(scene)).figure.canvas.draw()\n"
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


# exact fits


MAGENTA = to_rgb(MARK)

# three vertices stay on three walls while the robot turns: free is one point at each angle
HALF, THIRD = Fraction(1, 2), Fraction(1, 3)
THREE_FEET = PlainScene(
    [
        ([(4, 8), (5, 8 - HALF), (5, 8 + HALF)], []),
        ([(4, 0), (4 + HALF, 1), (4 - HALF, 1)], []),
        ([(0, 4), (-1, 4 - HALF), (-HALF, 3)], []),
    ],
    [box(-1, 6, 0, 10), box(-2, -1, 2, 0), ([(-6, 6), (-2, 2), (-1, 3), (-5, 7)], [])],
)
# two feet turn about a vertex
TWO_FEET = PlainScene(
    [
        ([(2 * THIRD, 0), (1, 0), (2 * THIRD, THIRD / 2)], []),
        ([(2 * THIRD, THIRD), (2 * THIRD, THIRD / 2), (1, THIRD)], []),
    ],
    [
        ([(1, 2 * THIRD), (2 * THIRD, 1), (2 * THIRD, 2 * THIRD)], []),
        ([(2 * THIRD, 2 * THIRD), (THIRD, -2 * THIRD), (2 * THIRD, -2 * THIRD)], []),
    ],
)


def legend_of(ax: Any) -> list[str]:
    return [text.get_text() for text in ax.get_legend().get_texts()]


@pytest.mark.slow
@pytest.mark.parametrize(
    "file",
    [
        "examples/scenes/degenerate_exact_fit.json",
        "tests/cases/fits/square_in_crossing_corridors.json",
        "tests/cases/fits/plus_peg.json",
    ],
)
def test_exact_fits_are_drawn_above_the_rest_and_named(file: str) -> None:
    found = boundary(load_scene(file))
    assert len(found.isolated)
    space = plot_boundary(found)
    assert legend_of(space)[-1] == "exact fit"
    space.get_legend().remove()
    assert magenta(pixels(space.figure)) > 20
    assert all(line.zorder > painting.zorder for line in space.lines for painting in space.collections)
    plane = plot_slice(found.slice(float(found.isolated.theta_from[0])))
    assert "exact fit" in legend_of(plane)
    plane.get_legend().remove()
    assert magenta(pixels(plane.figure)) > 20


def test_without_exact_fits_there_is_no_legend_of_them(fig9: Boundary) -> None:
    assert "exact fit" not in legend_of(plot_boundary(fig9)) + legend_of(plot_slice(fig9.slice(0)))
    fits = boundary(load_scene(SCENES / "degenerate_exact_fit.json"))
    assert "exact fit" not in legend_of(plot_slice(fits.slice(0.1)))


def magenta(image: np.ndarray) -> int:
    return int(np.count_nonzero(np.abs(image - MAGENTA).max(axis=-1) < 0.02))


@pytest.mark.slow
@pytest.mark.parametrize(
    "folder", ["tests/cases/fits", "tests/cases/bounds", "tests/cases/tangencies", "tests/cases/flats"]
)
def test_lines_of_exact_fits_run_between_their_ends(folder: str) -> None:
    count = 0
    for file in sorted(Path(folder).glob("*.json")):
        found = boundary(load_scene(file), threads=1)
        for k, line in enumerate(isolated_lines(found)):
            part = found.isolated_part(k)
            assert line[[0, -1], :2] == pytest.approx(np.array(part.ends)[:, :2], abs=1e-9)
            turned = (np.degrees(np.array(part.ends)[:, 2]) - line[[0, -1], 2]) / 360
            assert turned == pytest.approx(np.round(turned), abs=1e-9)
            check_slices(found, line)
            count += 1
    assert count or folder.endswith("flats")


@pytest.mark.parametrize("plain", [THREE_FEET, TWO_FEET], ids=["three feet", "two feet"])
def test_curves_of_exact_fits_are_in_the_slices_they_pass(plain: PlainScene) -> None:
    found = boundary(scene_of(plain), threads=1)
    curves = [k for k in range(len(found.isolated)) if found.isolated_part(k).kind == "curve"]
    lines = [line for line in isolated_lines(found) if np.ptp(line[:, 2]) > 0]
    # one that crosses theta = 0 is drawn in two
    assert len(curves) <= len(lines) <= len(curves) + 1
    drawn = sum(float(np.ptp(line[:, 2])) for line in lines)
    assert drawn == pytest.approx(np.degrees(found.isolated.theta_to - found.isolated.theta_from).sum())
    for line in lines:
        assert line[:, 2].min() >= 0 and line[:, 2].max() <= 360
        check_slices(found, line)
        check_free(plain, line[len(line) // 2])


def check_slices(found: Boundary, line: np.ndarray) -> None:
    """Each point of a line is at the isolated parts of its own orientation."""
    for x, y, degrees in line:
        near = np.concatenate(isolated_at(found, np.radians(degrees)))
        assert np.hypot(*(near - (x, y)).T).min() < 1e-6


def check_free(plain: PlainScene, pose: np.ndarray) -> None:
    """The robot overlaps nothing there, up to rounding; a little aside it does."""
    import shapely

    def overlap(dx: float, dy: float) -> float:
        x, y, degrees = pose
        turned = [shapely.Polygon(Pose(x + dx, y + dy, f"{degrees}deg").apply(part)) for part, _ in floats(plain.robot)]
        walls = shapely.union_all([shapely.Polygon(outer, holes) for outer, holes in floats(plain.obstacles)])
        return float(shapely.intersection(shapely.union_all(turned), walls).area)

    assert overlap(0, 0) < 1e-9
    aside = [overlap(0.01 * np.cos(turn), 0.01 * np.sin(turn)) for turn in np.linspace(0, 6, 12)]
    assert min(aside) > 1e-8


def floats(shapes: Any) -> list[tuple[Any, Any]]:
    return [
        ([(float(x), float(y)) for x, y in outer], [[(float(x), float(y)) for x, y in hole] for hole in holes])
        for outer, holes in shapes
    ]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["paper_fig9", "benchmr_parking1"])
def test_numbers_of_axes_in_space_do_not_touch(name: str) -> None:
    ax = plot_boundary(boundary(load_scene(SCENES / f"{name}.json")))
    ax.findobj(depth_sort.Painting)[0].set_visible(False)
    assert list(touching(ax.figure)) == []
