"""Pictures of answers in the configuration space, beside the workspace: paths and separating surfaces."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.axes3d import Axes3D
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.errors import UndecidedError
from cfree.forbidden.boundary import Boundary
from cfree.forbidden.columns import ISOLATED_COLUMNS, IsolatedParts
from cfree.forbidden.kinds import COLOURS, PatchKind
from cfree.formats.shapes import Shapes
from cfree.palette import BARRIER, EDGE_EDGE, EDGE_VERTEX, FORBIDDEN, GREY, HELIX, INK, VERTEX_EDGE, VIEW, paler
from cfree.paths.path import Path
from cfree.paths.preferences import NONE, Preferences
from cfree.planning.goals import AllSeparated
from cfree.planning.proof import Proof
from cfree.planning.separation import Pieces as SurfacePieces
from cfree.planning.separation import Separated
from cfree.planning.stuck import Stuck
from cfree.planning.unreachable import Unreachable
from cfree.plot.boundary import (
    new_figure,
    new_space,
    plain,
    plot_workspace,
    set_ticks,
    set_window,
    with_unit,
)
from cfree.plot.depth_sort import Painting
from cfree.plot.headed import headed, new_picture, window_of
from cfree.plot.labels import BODY, Labels, name_in_space
from cfree.plot.looks import looks, of_polygons, own
from cfree.plot.path import Track, draw_track, statement
from cfree.plot.pieces import ON_TOP, OVER, Colours, Pieces, joined, level, of_line, patches_of
from cfree.plot.reading import plot_shapes, with_record
from cfree.plot.strips import strips
from cfree.plot.stuck import picture_of_stuck
from cfree.plot.unreachable import picture_of_unreachable
from cfree.plot.unrolled import Range, distances, slab
from cfree.plot.workspace import Window, draw_robot, draw_surroundings, path_of, rings_of
from cfree.scene.features import BOUNDS, WORKSPACE, SceneFeatures, ShapeFeatures, features_of_cores, scene_features
from cfree.scene.naming import all_placed, numbered, placed
from cfree.scene.scene import Scene, box_of, grown_scene, robot_radius
from cfree.scene.smooth import smooth
from cfree.words import MOST_NAMES, listed

Floats = NDArray[np.float64]

# pale, so that the path stands out
PALE = Colours(*(paler(colour, 0.6) for colour in (VERTEX_EDGE, EDGE_VERTEX, HELIX, EDGE_EDGE)))
MARGIN, LEAST = 15.0, 90.0  # degrees shown above and below a path, and degrees shown at least
NEAR = 1.6  # robot's radii; patches beyond this and twice the least clearance are left out
BESIDE = 0.06  # share of a surface's size that is free beside it
HIGH = 0.75  # height of the space around a small surface, in its widths
FADE = 0.5  # share of that reach from which on patches are fainter
TINY = 0.03  # share of the window: narrower or lower patches have no outlines
DASH = 8  # steps of the path from dash to dash
WIDEST = 160  # characters of a headline; a longer one leaves out the obstacles' places
STEPS = 1, 2, 5, 15, 30, 45, 90, 180, 360, 3600  # degrees from tick to tick


@checked
def plot_path_space(path: Path, boundary: Boundary, ax: Axes3D | None = None) -> Axes3D:
    """Draw a path in the configuration space, coloured by clearance, among the patches of the boundary near it.

    Parameters
    ----------
    path : Path
    boundary : Boundary
        The boundary of the scene in which the path is free.
    ax : matplotlib axes with ``projection="3d"``, optional

    Returns
    -------
    matplotlib axes with three dimensions
        Theta is unrolled: it begins at the start's and continues beyond full turns. The path is dashed where patches
        hide it. Patches fade with their distance from the path, and are left out beyond 1.6 times the robot's radius or
        twice the least clearance; a radian is as long as the radius. The floor shows the obstacles and the trace of the
        reference point.

    Raises
    ------
    ValueError
        If the path is not free, or the axes have two dimensions.

    Examples
    --------
    >>> from cfree.forbidden.boundary import boundary
    >>> from cfree.collision.motion import rotations
    >>> from cfree.paths.path import Path
    >>> from cfree.exact.pose import Pose
    >>> from cfree.scene.scene import Scene
    >>> scene = Scene(robot=[(0, 0), (2, 0), (2, 1), (0, 1)], obstacles=[[(3, 2), (6, 2), (6, 4)]], units="m")
    >>> ax = plot_path_space(Path(Pose(0, 0), rotations((-1, 0), "400deg")), boundary(scene))
    >>> [float(limit) for limit in ax.get_zlim()]
    [-15.0, 415.0]
    """
    ax = _space(ax)
    _draw_track(ax, Track.of(path, boundary.scene), boundary)
    return ax


@checked
def picture(
    answer: Path | Proof | AllSeparated | UndecidedError | Scene | Shapes,
    scene: Scene | None = None,
    boundary: Boundary | None = None,
    *,
    preferences: Preferences | None = None,
) -> Figure:
    """Draw an answer in the workspace and, beside it, in the configuration space; or a scene, or the shapes of a file.

    Parameters
    ----------
    answer : Path, Separated, Stuck, Unreachable, AllSeparated, UndecidedError, Scene or Shapes
        The first of several proofs is drawn. The contacts of a vehicle that is stuck are marked, and some poses that it
        reaches; of one without reverse gear, the places of its axle point in the proof. Of an `UndecidedError` its path
        is drawn, which proves that a vehicle has one. A scene is drawn as by `plot_workspace`, round shapes with many
        edges.
        Over a scene or shapes the record of reading is drawn: lost lines red, guessed outlines hatched in orange,
        joined gaps as dots.
    scene : Scene, optional
        The scene that the answer is for; its own unless given. An answer that was read from a file has none.
    boundary : Boundary, optional
        The boundary of that scene; if None, a path is drawn in the workspace alone. A separation has its own surface.
    preferences : Preferences, optional
        Motions penalised by these preferences are marked.

    Returns
    -------
    matplotlib figure

    Raises
    ------
    ValueError
        If a path is not free, or its vehicle cannot drive it; if the scene is missing, or given for a scene; if an
        error has no path.

    See Also
    --------
    plot_path, plot_path_space : the two parts of the picture of a path.

    Examples
    --------
    >>> from cfree.planning.plan import plan
    >>> from cfree.exact.pose import Pose
    >>> from cfree.scene.scene import Scene
    >>> hall, wall = [(0, 0), (9, 0), (9, 3), (0, 3)], [(4, -1), (5, -1), (5, 4)]
    >>> scene = Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=[wall], workspace=hall)
    >>> figure = picture(plan(scene, Pose(1, 1), Pose(7, 1)), scene)
    >>> [text.get_text() for text in figure.texts]
    ['no path from start to goal', 'separated by the workspace; obstacle 0, 1 x 5 at (4.5, 1.5)']
    """
    if isinstance(answer, Scene | Shapes):
        if scene is not None or boundary is not None:
            raise ValueError("scene, boundary: a scene is drawn alone; leave them out")
        if isinstance(answer, Shapes):
            ax = plot_shapes(answer)
        else:
            ax = with_record(plot_workspace(smooth(answer)), answer.reading, answer.units)
        drawn = ax.figure
        assert isinstance(drawn, Figure)
        return drawn
    if isinstance(answer, AllSeparated):
        answer = answer.proofs[0]
    if isinstance(answer, Unreachable):
        return picture_of_unreachable(answer, _scene_of(answer, scene))
    if isinstance(answer, Stuck):
        return picture_of_stuck(answer, _scene_of(answer, scene))
    headline, details = "", ""
    if isinstance(answer, UndecidedError):
        headline = "undecided: a path exists"
        details = f"it needs about {answer.manoeuvres:,} motions; here the robot moves in any direction"
        answer = _path_of(answer)
    true = _scene_of(answer, scene)
    scene = of_polygons(answer, true)
    if isinstance(answer, Separated):
        return _picture_of_separation(answer, scene, true)
    track = Track.of(own(answer, true), scene)
    figure, ax = new_picture(track.window, boundary is not None, below=0.65 if track.gears is None else 1.0)
    draw_track(ax, track, preferences or NONE)
    if boundary is not None:
        _draw_track(_right(figure), track, boundary)
    headline = headline or ("a free path" if track.gears is None else f"a path for {track.gears.driver()}")
    headed(figure, scene, headline, details or statement(track))
    return figure


def _path_of(error: UndecidedError) -> Path:
    if not isinstance(error.path, Path):
        raise ValueError(f"answer: {error}; there is no path to draw")
    return error.path


def _scene_of(answer: Path | Proof, scene: Scene | None) -> Scene:
    scene = scene or answer.curved or answer.scene
    if scene is None:
        raise ValueError("scene: the answer knows none, as it was read from a file; give the one it is an answer for")
    return scene


def _picture_of_separation(answer: Separated, scene: Scene, true: Scene) -> Figure:
    """Draw start, goal and the blocking obstacles, as polygons; beside them the separating surface."""
    window, shown = window_of(scene, [answer.start, answer.goal]), looks(answer, scene)
    figure, ax = new_picture(window, len(answer.pieces) > 0)
    draw_surroundings(ax, shown)
    draw_barrier(ax, shown, answer.obstacles)
    ends = {"start": answer.start, "goal": answer.goal}
    for name, pose in ends.items():
        draw_robot(ax, shown, pose, faint=name == "goal")
    set_window(ax, window, scene.units)
    labels = Labels(ax, scene)
    labels.avoid_robot(scene, ends.values(), BODY)
    for name, pose in ends.items():
        labels.name_robot(scene, pose, name)
    if len(answer.pieces):
        draw_surface(figure, ax, answer, true, labels)
    for k in [k for k in answer.obstacles if k >= 0][:MOST_NAMES]:
        labels.point_at(box_of(shown.obstacles[k]), plain(placed(scene, k)), BARRIER)
    labels.name_bounds(scene)
    without = "path" if answer.of == "closed" else "path of positive clearance"
    named = all_placed(scene, answer.obstacles)
    if len(named) > WIDEST:
        named = listed([numbered(scene, k) for k in answer.obstacles], ", ")
    blocking = f"separated by {plain(named)}" if named else "the one or the other touches, and fits exactly"
    headed(figure, scene, f"no {without} from start to goal", blocking)
    return figure


def draw_surface(
    figure: Figure, ax: Any, answer: Separated, scene: Scene, labels: Labels, *, close: bool = False
) -> None:
    """Draw the separating surface, and start and goal if they are within its rectangle.

    With `close` the surface fills the picture: no more is shown around it, and only the angles that it has.
    """
    surface = surface_of(answer, scene)
    box = around_surface(surface, BESIDE if close else None)
    space = _right(figure)
    degrees = angles_around(surface, math.degrees(answer.start.theta)) if close else (0.0, 360.0)
    size = min(1.0, max(box[2] - box[0], box[3] - box[1]) / (2 * robot_radius(surface.scene)))
    patches = patches_of(surface, box, tiny=TINY * size if close else TINY)
    _draw_patches(space, surface, box, degrees, slab(patches, box, degrees) if close else patches, close=close)
    kinds = {"v-e contacts": PatchKind.VERTEX_EDGE, "e-v contacts": PatchKind.EDGE_VERTEX}
    kinds |= {"arc-arc contacts": PatchKind.ARC_ARC, "bounds": PatchKind.BOUND}
    _legend(space, {name: COLOURS[kind] for name, kind in kinds.items() if (surface.patch_kind == kind).any()}, [])
    _frame(ax, box, labels)
    rows = [
        (np.array([float(pose.x), float(pose.y), math.degrees(pose.theta)]), name)
        for pose, name in ((answer.start, "start"), (answer.goal, "goal"))
    ]
    _mark(space, [(row, name) for row, name in rows if box[0] <= row[0] <= box[2] and box[1] <= row[1] <= box[3]])


def surface_of(answer: Separated, scene: Scene) -> Boundary:
    """Return the surface of a separation as a boundary of its trapezoids alone, for drawing only.

    Parameters
    ----------
    answer : Separated
    scene : Scene
        The scene that the answer is for, with its round shapes.
    """
    if answer.rounded:  # round shapes, or polygons grown by a clearance
        scene = grown_scene(scene, answer.clearance) if answer.clearance else scene
        return _surface(answer.pieces, scene, features_of_cores(answer.rounded, scene, answer.bounds))
    scene = of_polygons(answer, scene)
    if answer.of == "closed":
        scene = Scene(answer.robot, scene.obstacles, bounds=answer.bounds, workspace=scene.workspace, units=scene.units)
    return _surface(answer.pieces, scene, scene_features(scene))


def _surface(pieces: SurfacePieces, scene: Scene, features: SceneFeatures) -> Boundary:
    from cfree.forbidden.boundary import Boundary
    from cfree.forbidden.record import Stats

    count = len(pieces)
    robot, obstacle = (
        _features_of(shape, owners)
        for shape, owners in ((features.robot, pieces.robot), (features.obstacles, pieces.obstacle))
    )
    nothing: dict[str, Any] = {name: np.empty(0, np.int32) for name in ISOLATED_COLUMNS}
    stats, trimmed = Stats(count, count, count, 0, 0, 0, 0, 0, {}), np.ones(count, np.uint8)
    return Boundary(
        scene, features, pieces.kind, robot, obstacle, pieces.table, IsolatedParts(**nothing), stats, trimmed
    )


def _features_of(shape: ShapeFeatures, owners: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return the numbers (n,) of the features that belong to polygons and vertices (n, 2)."""
    pairs = zip(shape.owner_polygon.tolist(), shape.owner_vertex.tolist(), strict=True)
    number = {pair: k for k, pair in reversed(list(enumerate(pairs)))}  # the first one counts
    return np.array([number[polygon, vertex] for polygon, vertex in owners.tolist()], dtype=np.int32)


# the plane


def draw_barrier(ax: Any, scene: Scene, numbers: tuple[int, ...]) -> None:
    """Draw the blocking obstacles of a separating surface, and its bounds and workspace."""
    from matplotlib.patches import PathPatch, Rectangle

    shapes = path_of(rings_of([scene.obstacles[k] for k in numbers if k >= 0]))
    style: Any = {"edgecolor": BARRIER, "linewidth": 1.6, "zorder": 2.5}
    ax.add_patch(PathPatch(shapes, facecolor=paler(BARRIER, 0.7), label="barrier", **style))
    if WORKSPACE in numbers and scene.workspace is not None:
        ax.add_patch(PathPatch(path_of(rings_of([scene.workspace])), fill=False, label="workspace", **style))
    if BOUNDS in numbers and scene.bounds is not None:
        x0, y0, x1, y1 = map(float, scene.bounds)
        ax.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, linestyle=(0, (5, 3)), label="bounds", **style))


def _frame(ax: Any, box: Window, labels: Labels) -> None:
    """Draw a frame around the part of the workspace that the space panel shows, unless it shows all."""
    from matplotlib.patches import Rectangle

    x0, y0, x1, y1 = box
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    if not (left < x0 and x1 < right and bottom < y0 and y1 < top):
        return
    style: Any = {"edgecolor": INK, "linewidth": 0.8, "zorder": 6, "label": "shown at right"}
    ax.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, **style))
    labels.put("shown at right", [(x0, y1), (x1, y1), (x0, y0), (x1, y0)], needed=False, color=INK, fontsize=9)


# space


def _draw_track(ax: Any, track: Track, boundary: Boundary) -> None:
    """Draw a path among the patches near it, on axes."""
    rows = track.rows * (1, 1, 180 / math.pi)
    degrees, radius = _range(rows[:, 2]), robot_radius(track.scene)
    reach = max(NEAR * radius, 2 * track.least.found if track.least else 0.0)
    window = _around(rows[:, :2], reach)
    patches = slab(patches_of(boundary, window, PALE, tiny=TINY), window, degrees)
    distance = distances(patches, rows[:: max(1, len(rows) // 80)], radius) / reach
    distance = np.where(patches.owner < 0, distance, np.maximum(distance, distance[patches.owner]))
    near, line = patches.chosen(distance < 1), _line(track, rows)
    fading = np.clip((1 - distance[distance < 1]) / (1 - FADE), 0, 1)
    # half of the colour on white looks the same, without seams
    white = np.where(fading > 0.5, 1 - fading, 0.0)[:, None]
    near = replace(near, rgb=near.rgb + white * (1 - near.rgb))
    opacity = np.concatenate((np.where(fading > 0.5, 1.0, fading), np.ones(len(line.corners))))
    _draw_patches(ax, boundary, window, degrees, joined([near, line]), opacity)
    names = {"v-e patch": PALE.vertex_edge, "e-v patch": PALE.edge_vertex}
    names |= {"arc-arc patch": COLOURS[PatchKind.ARC_ARC]} if boundary.scene.curved else {}
    middle = track.colour(np.array([track.most / 2]))[0] if track.gears is None else track.at_steps()[0]
    _legend(ax, names, [("path, coloured as beside", middle, "-"), ("hidden", middle, (0, (2, 1.5)))])
    shadow = np.full(len(rows), degrees[0])
    ax.plot(*rows[:, :2].T, shadow, color=GREY, linewidth=1.2, zorder=0.5, label="reference point")
    _mark(ax, [(rows[0], "start"), (rows[-1], "goal")], rows)


def _draw_patches(
    ax: Any, boundary: Boundary, window: Window, degrees: Range, pieces: Pieces, opacity: Floats | float = 1.0,
    close: bool = False,
) -> None:  # fmt: skip
    """Draw pieces above the obstacles; give the axes ticks and names."""
    import shapely
    from matplotlib.ticker import FuncFormatter, MultipleLocator
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    (low, high), (x0, y0, x1, y1), units = degrees, window, boundary.scene.units
    side = max(x1 - x0, y1 - y0)
    painting = Painting(pieces, opacity=opacity)
    painting.set(zorder=1, rasterized=True)  # thousands of faces are slow as vectors, with seams
    ax.add_collection(painting, autolim=False)
    obstacles = shapely.union_all([obstacle.to_shapely() for obstacle in smooth(boundary.scene).obstacles])
    floor = level(shapely.intersection(obstacles, shapely.box(*window)), low)[:, :3]
    shadow = Poly3DCollection(floor, facecolor=FORBIDDEN, edgecolor=FORBIDDEN, linewidth=0.3, zorder=0.2)
    ax.add_collection(shadow, autolim=False)
    ax.set(xlim=(x0, x1), ylim=(y0, y1), zlim=degrees, zlabel="θ")
    height = side * (HIGH if close else min(1.0, max(0.4, 0.75 * (high - low) / 360)))
    ax.set_box_aspect((x1 - x0, y1 - y0, height), zoom=1.06)
    ax.view_init(*VIEW)
    ax.zaxis.set_major_locator(MultipleLocator(next((s for s in STEPS if (high - low) / s <= 6), STEPS[-1])))
    ax.zaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}°".replace("-", "−")))
    for axis, name, length in ((ax.xaxis, "x", x1 - x0), (ax.yaxis, "y", y1 - y0)):
        set_ticks(axis, 1 + round(5 * length / side))
        axis.set_label_text(with_unit(name, units))
        axis.labelpad = 9
    for axis in (ax.xaxis, ax.yaxis, ax.zaxis):
        axis.set_pane_color((0.97, 0.97, 0.98, 1.0))


def _legend(ax: Any, patches: dict[str, str], lines: list[tuple[str, Any, Any]]) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles: list[Any] = [Patch(color=colour, label=name) for name, colour in patches.items()]
    handles += [
        Line2D([], [], color=colour, linewidth=2.2, linestyle=style, label=name) for name, colour, style in lines
    ]
    ax.legend(
        handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), frameon=False, fontsize=9, handlelength=1.6,
        ncols=len(handles), columnspacing=1.4,
    )  # fmt: skip


def around_surface(surface: Boundary, beside: float | None = None) -> Window:
    """Return a rectangle around a surface, large enough to show the obstacles it belongs to.

    With `beside` that share of its size is left free on all sides instead.
    """
    points = strips(surface, math.radians(5)).points.reshape(-1, 2)
    extent = float(np.ptp(points, axis=0).max())
    return _around(points, robot_radius(surface.scene) if beside is None else beside * extent)


def angles_around(surface: Boundary, start: float) -> Range:
    """Return the angles of a surface around the start's, in degrees; a whole turn if it has almost all."""
    theta = surface.trapezoids.theta_from, surface.trapezoids.theta_to
    shares = np.sort(np.concatenate([np.linspace(*theta, 9).ravel() * 180 / math.pi - start]) % 360)
    gaps = np.diff(shares, append=shares[0] + 360)
    if gaps.max() < LEAST:
        return 0.0, 360.0
    last = int(gaps.argmax())
    high, low = float(shares[last]), float(shares[(last + 1) % len(shares)])
    low -= 360 if low > high else 0
    middle, half = start + (low + high) / 2, (high - low) / 2
    half *= 1 + BESIDE
    return middle - half, middle + half


def _around(points: Floats, margin: float) -> Window:
    (x0, y0), (x1, y1) = (points.min(axis=0) - margin).tolist(), (points.max(axis=0) + margin).tolist()
    return x0, y0, x1, y1


def _mark(ax: Any, rows: Sequence[tuple[Floats, str]], line: Floats | None = None) -> None:
    """Mark configurations x, y, degrees by dots with names."""
    for row, _ in rows:
        ax.plot(*row[:, None], "o", color=INK, markersize=6, markeredgecolor="white", zorder=21)
    name_in_space(ax, rows, line)


def _range(degrees: Floats) -> Range:
    """Return a range around the angles of a path."""
    low, high = float(degrees.min()) - MARGIN, float(degrees.max()) + MARGIN
    more = max(0.0, LEAST - (high - low)) / 2
    return low - more, high + more


def _line(track: Track, rows: Floats) -> Pieces:
    """Return the path, coloured by clearance, with a white rim, and dashes that nothing hides."""
    rgb = track.between_steps()[:, :3]
    rim = of_line(rows, "white", 5.0)
    line, above = (replace(of_line(rows, INK, width, sort), rgb=rgb) for width, sort in ((3.0, OVER), (1.8, ON_TOP)))
    line.corners[:-1, 1:3] = line.corners[1:, 1:3]  # parts overlap to avoid seams
    return joined([rim, line, above.chosen(np.arange(len(rgb)) % DASH < DASH / 2)])


# figures


def _space(ax: Axes3D | None) -> Any:
    if ax is None:
        ax = new_space(new_figure((8, 7)), (0.02, 0.09, 0.94, 0.89))
    ax.computed_zorder = False
    return ax


def _right(figure: Figure) -> Any:
    return _space(new_space(figure, (0.48, 0.09, 0.5, 0.79)))
