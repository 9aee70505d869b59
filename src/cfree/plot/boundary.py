"""Figures: the workspace, slices, and the boundary in three dimensions.

Every function draws on matplotlib axes, given or new, and returns them. New axes belong to a figure without a
window, so nothing here needs a display: ``plot_slice(s).figure.savefig("slice.png")``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from os import PathLike
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from mpl_toolkits.mplot3d.axes3d import Axes3D
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.exact.pose import Pose
from cfree.forbidden.boundary import Boundary
from cfree.forbidden.isolated import isolated_at, isolated_lines
from cfree.forbidden.kinds import COLOURS, KINDS, PatchKind
from cfree.forbidden.record import BoundaryRecord
from cfree.forbidden.slice import Slice
from cfree.formats.text.atomic import checked_suffix, replacing
from cfree.palette import FAINT, FORBIDDEN, GREY, INK, MARK, ROBOT, WALL
from cfree.plot.labels import BODY, GHOST, MAY, Labels
from cfree.plot.strips import THIN, strips
from cfree.plot.workspace import Window, draw_robot, draw_surroundings, path_of, rings_of_geometry, roomiest
from cfree.scene.scene import Scene
from cfree.scene.smooth import smooth
from cfree.words import counted

CORNER = 0.9  # share of an axis that has numbers
EDGE = 4.0  # pixels between the edge of a figure and the name of an axis
SLIMMEST = 0.4  # least ratio of a window's shorter side to the longer one


@checked
def plot_workspace(scene: Scene, ax: Axes | None = None) -> Axes:
    """Draw obstacles, bounds, workspace, and the robot at start and goal, its reference point marked.

    Parameters
    ----------
    scene : Scene
    ax : matplotlib axes, optional

    Returns
    -------
    matplotlib axes

    Notes
    -----
    The robot of a scene without start and goal is drawn as in its file, with the reference point at the origin.
    """
    from cfree.exact.pose import Pose

    scene = smooth(scene)
    ax = ax or new_axes((7, 6))
    boxes = draw_surroundings(ax, scene)
    ends = {"start": scene.start, "goal": scene.goal}
    ends |= {f"goal {k}": goal for k, goal in enumerate(scene.goals) if isinstance(goal, Pose)}
    poses = {name: pose for name, pose in ends.items() if pose is not None}
    poses = poses or {"at rest": Pose(0, 0)}
    for name, pose in poses.items():
        boxes.append(draw_robot(ax, scene, pose, faint=name != "start"))
    for x, y in (goal for goal in scene.goals if not isinstance(goal, Pose)):
        ax.plot(float(x), float(y), "*", color=INK, markersize=12, label="goal, any theta")
        boxes.append((float(x), float(y), float(x), float(y)))
    set_window(ax, roomy(around(boxes)), scene.units)
    labels = Labels(ax, scene)
    labels.avoid_robot(scene, poses.values(), BODY)
    for name, pose in poses.items():
        labels.name_robot(scene, pose, name)
    labels.name_bounds(scene)
    ax.set_title("workspace")
    return ax


@checked
def plot_slice(cut: Slice, ax: Axes | None = None) -> Axes:
    """Draw the forbidden region of the reference point at one orientation, with its contacts, over the obstacles.

    The robot is drawn in that orientation at the roomiest place.

    Parameters
    ----------
    cut : Slice
    ax : matplotlib axes, optional

    Returns
    -------
    matplotlib axes
    """
    ax = ax or new_axes((7, 6))
    _draw_slice(cut, ax)
    _draw_inside(ax, cut, extent(cut.boundary))
    legend_below(ax, ncols=5)
    return ax


def _draw_slice(cut: Slice, ax: Axes) -> None:
    """Draw the forbidden region among the obstacles, and the contacts around it."""
    from matplotlib.collections import LineCollection
    from matplotlib.patches import PathPatch

    boundary = cut.boundary
    shown = smooth(boundary.scene)
    inside = cut.forbidden if shown.workspace is None else cut.forbidden.intersection(shown.workspace.to_shapely())
    region = path_of(rings_of_geometry(inside))
    draw_surroundings(ax, shown, frame=False)
    ax.add_patch(PathPatch(region, facecolor=FORBIDDEN, edgecolor="none", zorder=0.6, label="forbidden"))
    kinds = boundary.patch_kind[cut.patches]
    width = min(1.2, max(0.3, math.sqrt(2000 / max(1, len(kinds)))))
    for kind, name in KINDS.items():
        chosen = [cut.lines[k] for k in np.flatnonzero(kinds == kind)]
        if chosen:
            style = (0, (5, 3)) if name == "bound" else "solid"
            ax.add_collection(
                LineCollection(chosen, colors=_line_colour(kind), linewidths=width, linestyles=[style], label=name)
            )
    fits = isolated_at(boundary, cut.theta)
    _draw_fits(ax, fits)
    if fits:
        ax.lines[-1].set_label("exact fit")
    set_window(ax, extent(boundary), boundary.scene.units)
    ax.set_title(f"slice at θ = {math.degrees(cut.theta):.4g}°")


def _draw_inside(ax: Axes, cut: Slice, window: Window) -> None:
    """Draw the robot where its reference point has most room, with a label that explains the place."""
    import shapely

    scene = smooth(cut.boundary.scene)
    labels = Labels(ax, scene)
    labels.avoid(shapely.get_parts(cut.forbidden), GHOST)
    pose = roomiest(cut, window)
    if pose is None:
        x0, y0, x1, y1 = window
        labels.put(f"{MAY} nowhere", ((x0 + x1) / 2, (y0 + y1) / 2), needed=False)
        return
    draw_robot(ax, scene, pose, faint=True)
    labels.avoid_robot(scene, [pose], BODY)
    labels.put(f"{MAY} here", (float(pose.x), float(pose.y)), needed=False, ring=3.0)


@checked
def plot_boundary(boundary: Boundary, ax: Axes3D | None = None) -> Axes3D:
    """Draw contact patches in (x, y, theta), v-e orange, e-v blue; `cfree.plot.depth_sort` orders the faces.

    Parameters
    ----------
    boundary : Boundary
    ax : matplotlib axes with ``projection="3d"``, optional

    Returns
    -------
    matplotlib axes with three dimensions
    """
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    from cfree.plot.depth_sort import Painting
    from cfree.plot.pieces import Colours, pieces_of

    if ax is None:
        ax = new_space(new_figure((8, 7)), (0.02, 0.1, 0.9, 0.86))
    space: Any = ax
    window = extent(boundary)
    space.add_collection(Painting(pieces_of(boundary, window)), autolim=False)
    _draw_fits(space, isolated_lines(boundary))
    set_space(space, window, boundary.scene.units)
    handles = [
        *(Patch(color=COLOURS[k], label=f"{KINDS[k]} patch") for k in contact_kinds(boundary)),
        Line2D([], [], color=Colours.helix, label="joint" if boundary.scene.curved else "v-v helix"),
        Line2D([], [], color=Colours.edge_edge, label="e-e line"),
        Patch(facecolor=COLOURS[PatchKind.BOUND], edgecolor=GREY, alpha=0.4, label="bounds"),
        Patch(facecolor=FORBIDDEN, edgecolor=GREY, label="section at 360°"),
    ]
    if len(boundary.isolated):
        handles.append(Line2D([], [], color=MARK, label="exact fit"))
    space.legend(
        handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.02), ncols=6 if len(handles) <= 6 else 4,
        frameon=False, handlelength=1.4, columnspacing=1.4,
    )  # fmt: skip
    return space


@checked
def plot_overview(boundary: Boundary) -> Figure:
    """Draw everything in one figure: the workspace, two slices, and the boundary.

    The slices are those of start and goal; if these are equal or missing, the second is a quarter turn further.
    """
    scene = boundary.scene
    figure = new_figure((14, 7.4))
    grid = figure.add_gridspec(2, 2, left=0.045, right=0.45, bottom=0.09, top=0.86, height_ratios=(2, 1), hspace=0.3)
    plot_workspace(scene, figure.add_subplot(grid[0, :]))
    for k, (theta, pose) in enumerate(_chosen_angles(scene)):
        ax = figure.add_subplot(grid[1, k])
        _draw_slice(boundary.slice(theta), ax)
        ax.set_ylabel("")
        if pose is not None:
            ax.plot(float(pose.x), float(pose.y), "o", color=ROBOT, markersize=5)
    plot_boundary(boundary, new_space(figure, (0.46, 0.09, 0.53, 0.82)))
    figure.suptitle(plain(scene.name) or "boundary of the forbidden space", weight="bold", fontsize=15)
    trapezoids = counted(boundary.stats.trapezoids, "trapezoid")
    figure.text(0.5, 0.915, f"{boundary.patch_counts} bound the forbidden space: {trapezoids}", ha="center")
    return figure


def extent(boundary: BoundaryRecord) -> Window:
    """Return the rectangle around everything visible of a boundary: the bounds if there are any."""
    if boundary.scene.bounds is not None:
        x0, y0, x1, y1 = map(float, boundary.scene.bounds)
        return x0, y0, x1, y1
    points = strips(boundary, math.radians(10)).points.reshape(-1, 2)
    if not len(points):
        return around([(-1.0, -1.0, 1.0, 1.0)])
    return around([(*points.min(axis=0).tolist(), *points.max(axis=0).tolist())])


def save_figure(figure: Figure | SubFigure, path: str | PathLike[str]) -> None:
    """Write a figure, whole or not at all; the suffix selects the format.

    Raises
    ------
    UnsupportedError
        If matplotlib cannot write that format.
    """
    suffix = check_picture_path(path)
    with replacing(path) as unfinished:
        figure.figure.savefig(unfinished, dpi=160, format=suffix[1:])


def check_picture_path(path: str | PathLike[str]) -> str:
    """Return the suffix of a file that `save_figure` can write.

    Examples
    --------
    >>> check_picture_path("parking.docx")
    Traceback (most recent call last):
        ...
    cfree.errors.UnsupportedError: parking.docx: no picture format; name the file .png, .svg, .pdf, .jpg or .webp
    """
    return checked_suffix(path, "picture", (".png", ".svg", ".pdf", ".jpg", ".webp"))


# axes


def new_figure(size: tuple[float, float]) -> Figure:
    """Make a figure of its own, with a canvas and no window."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, facecolor="white")
    FigureCanvasAgg(figure)
    return figure


def new_space(figure: Figure, place: tuple[float, float, float, float]) -> Axes3D:
    """Add axes with three dimensions and a faint grid."""
    import mpl_toolkits.mplot3d  # noqa: F401  registers the projection
    from matplotlib import rc_context

    with rc_context({"grid.color": FAINT, "grid.linewidth": 0.6}):
        return figure.add_axes(place, projection="3d")


def set_space(ax: Any, window: Window, units: str, *, height: float = 0.75, zoom: float = 1.08) -> None:
    """Set limits, proportions, ticks and names of axes for a rectangle of the plane and a full turn of theta.

    The turn is `height` times as high as the longer side.
    """
    x0, y0, x1, y1 = window
    side = max(x1 - x0, y1 - y0)
    ax.set(xlim=(x0, x1), ylim=(y0, y1), zlim=(0, 360), zlabel="θ")
    ax.set_box_aspect((x1 - x0, y1 - y0, height * side), zoom=zoom)
    ax.set_zticks(range(0, 361, 90), labels=[f"{degrees}°" for degrees in range(0, 361, 90)])
    for axis, name, length in ((ax.xaxis, "x", x1 - x0), (ax.yaxis, "y", y1 - y0)):
        set_ticks(axis, 1 + round(5 * length / side))
        axis.set_label_text(with_unit(name, units))
    for axis in (ax.xaxis, ax.yaxis, ax.zaxis):
        axis.set_pane_color(WALL)


def set_ticks(axis: Any, count: int) -> None:
    """Put some numbers on an axis in space, clear of the corners, where two axes meet."""
    from matplotlib.ticker import MaxNLocator

    low, high = axis.get_view_interval()
    ticks = MaxNLocator(count).tick_values(low, high)
    ticks = ticks[np.abs(ticks - (low + high) / 2) < CORNER * (high - low) / 2]
    axis.set_ticks(ticks, [number_on_axis(tick) for tick in ticks.tolist()])


def new_axes(size: tuple[float, float], place: tuple[float, float, float, float] = (0.1, 0.15, 0.86, 0.77)) -> Axes:
    """Make axes in a figure of their own, its size in inches, the place in shares of the figure."""
    return new_figure(size).add_axes(place)


def set_window(ax: Axes, window: Window, units: str) -> None:
    """Set limits with a margin, as many numbers as fit, and the names of the axes."""
    x0, y0, x1, y1 = window
    margin = 0.03 * max(x1 - x0, y1 - y0)
    ax.set(xlim=(x0 - margin, x1 + margin), ylim=(y0 - margin, y1 + margin), aspect="equal")
    space_numbers(ax)
    ax.set_xlabel(with_unit("x", units))
    ax.set_ylabel(with_unit("y", units))
    keep_inside(ax)


def keep_inside(ax: Axes) -> None:
    """Move axes to the right where long numbers push the name of the axis out of the figure."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    figure = ax.figure
    if not isinstance(figure.canvas, FigureCanvasAgg) or figure.get_layout_engine() is not None:
        return
    names = ax.yaxis.get_tightbbox()
    outside = EDGE - names.x0 if names is not None else 0.0
    if outside > 0:
        place, by = ax.get_position(original=True), outside / figure.bbox.width
        ax.set_position((place.x0 + by, place.y0, place.width, place.height))


def space_numbers(ax: Axes) -> None:
    """Put as many numbers beside axes of a final size as fit."""
    from matplotlib.ticker import MaxNLocator

    ax.apply_aspect()
    box, inch = ax.get_window_extent(), ax.figure.dpi
    for axis, inches in ((ax.xaxis, box.width / 0.8 / inch), (ax.yaxis, box.height / 0.4 / inch)):
        axis.set_major_locator(MaxNLocator(int(np.clip(inches, 1, 6))))
        axis.set_major_formatter(lambda value, _: number_on_axis(value))


def number_on_axis(value: float) -> str:
    """Write the number of a tick in full, so that no offset or power of ten stands elsewhere."""
    return f"{value + 0.0:.12g}".replace("-", "\N{MINUS SIGN}")


def with_unit(name: str, units: str) -> str:
    """Name an axis, with the unit in brackets."""
    return f"{name} ({plain(units)})" if units else name


def plain(text: str) -> str:
    """Prepare text of a scene for a figure: literal, not a formula, with characters that have no glyph escaped.

    Examples
    --------
    >>> print(plain("$5\\t"))
    \\$5\\t
    """
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text).replace("$", r"\$")


def contact_kinds(boundary: Boundary) -> list[PatchKind]:
    """Return the kinds of contact patches for a legend: all live ones among round shapes, else both."""
    if not boundary.scene.curved:
        return [PatchKind.VERTEX_EDGE, PatchKind.EDGE_VERTEX]
    live = np.unique(boundary.patch_kind[boundary.trapezoids.patch]).tolist()
    return [PatchKind(kind) for kind in live if kind != PatchKind.BOUND]


def _line_colour(kind: PatchKind) -> str:
    return GREY if kind == PatchKind.BOUND else COLOURS[kind]


def _draw_fits(ax: Any, lines: list[NDArray[np.float64]]) -> None:
    """Draw exact fits above all else: those without length are dots."""
    for points in lines:
        is_dot = bool(np.ptp(points, axis=0).max() < THIN)
        ax.plot(*points.T, "o" if is_dot else "-", color=MARK, markersize=5, linewidth=2.2, zorder=20)


def legend_below(ax: Axes, ncols: int, **options: Any) -> None:
    """Add a legend below the axis label, for any height of the axes; farther left, or of fewer columns, if wide."""
    from matplotlib.transforms import ScaledTranslation

    figure: Any = ax.figure
    below = ax.transAxes + ScaledTranslation(0, -0.5, figure.dpi_scale_trans)
    ax.apply_aspect()
    for columns in range(ncols, 0, -1):
        legend = ax.legend(
            loc="upper left", bbox_to_anchor=(0, 0), bbox_transform=below, frameon=False, ncols=columns, **options
        )
        extent, window = legend.get_window_extent(), ax.get_window_extent()
        beyond = extent.x1 - figure.bbox.x1
        if beyond <= extent.x0:
            legend.set_bbox_to_anchor((-max(0.0, beyond) / window.width, 0), below)
            break


def around(boxes: Iterable[Window]) -> Window:
    """Return the rectangle around rectangles."""
    corners = np.array(list(boxes))
    x0, y0 = corners[:, :2].min(axis=0).tolist()
    x1, y1 = corners[:, 2:].max(axis=0).tolist()
    return x0, y0, x1, y1


def roomy(window: Window) -> Window:
    """Return the same rectangle, or a higher or wider one around it with room for words.

    Examples
    --------
    >>> roomy((0, 0, 10, 1))
    (0.0, -1.5, 10.0, 2.5)
    """
    low, high = np.array(window, dtype=np.float64).reshape(2, 2)
    more = np.maximum(0.0, SLIMMEST * (high - low).max() - (high - low)) / 2
    (left, bottom), (right, top) = (low - more).tolist(), (high + more).tolist()
    return left, bottom, right, top


def _chosen_angles(scene: Scene) -> list[tuple[float, Pose | None]]:
    start, goal = scene.start, scene.goal
    first = start.theta if start else 0.0
    if start and goal and start.tau != goal.tau:
        return [(first, start), (goal.theta, goal)]
    return [(first, start), (first + math.pi / 2, None)]
