"""Pictures of cages, of contacts that hold a body, and of parts that are taken apart."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch

from cfree.arguments import checked
from cfree.caging.cage import Cage
from cfree.caging.fingers import Finger
from cfree.caging.immobile import Immobility
from cfree.collision.pose_checker import is_free
from cfree.disassembly.leaving import Leaving
from cfree.disassembly.order import Disassembly
from cfree.exact.pose import Pose, Poses
from cfree.libraries import Floats
from cfree.palette import BARRIER, GHOST, INK, MARK, ROBOT
from cfree.paths.path import Path
from cfree.paths.travel import Travel, ghosts
from cfree.planning.separation import Separated
from cfree.plot.answer import angles_around, around_surface, draw_barrier, draw_surface, picture, surface_of
from cfree.plot.boundary import around, new_figure, plain, set_window
from cfree.plot.headed import headed, new_picture, window_of
from cfree.plot.labels import BODY, Labels
from cfree.plot.looks import looks, of_polygons, own
from cfree.plot.names import put_inside
from cfree.plot.unrolled import Range
from cfree.plot.workspace import Window, draw_robot, draw_surroundings, path_of, rings_of_geometry
from cfree.scene.scene import AnyShape, Scene, polygons_for, size_of
from cfree.scene.smooth import EDGES, smooth
from cfree.words import counted, listed

SAMPLES = 400  # poses of a way out from which some are drawn
ROOM = 0.25  # beside all parts, in shares of their extent
FAINT = 0.25  # opacity of a part on its way
STEPS, TURNS = 25, 48  # poses of a grid inside of a cage, along a side and around
ACROSS = 3  # panels beside each other
SHARE = 0.12  # length of a normal, in shares of the picture


@checked
def plot_cage(cage: Cage) -> Figure:
    """Draw a caged body with all that it sweeps, and the closed surface around its poses; or the path out.

    Parameters
    ----------
    cage : Cage

    Returns
    -------
    matplotlib figure
        The swept region is that of free poses of a grid that neighbours join: it shows the cage, and proves nothing.

    Examples
    --------
    >>> from cfree.caging import is_caged
    >>> square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    >>> figure = plot_cage(is_caged(square, [(1, 0), (2, 1), (1, 2), (0, 1)]))
    >>> [text.get_text() for text in figure.texts]
    ['caged', 'held by finger 0, finger 1, finger 2, finger 3; no motion leads out, proved']
    """
    if isinstance(cage.answer, Path):
        figure = picture(cage.answer, cage.scene)
        _draw_points(figure.axes[0], cage.fingers)
        return figure
    names = listed([cage.scene.obstacle_names[k] for k in cage.holding], ", ")
    figure, ax = _held(cage.scene, cage.answer, "caged", f"held by {plain(names)}; no motion leads out, proved")
    _draw_points(ax, cage.fingers)
    return figure


@checked
def plot_immobility(answer: Immobility) -> Figure:
    """Draw a body with its contacts, their normals, and a free velocity if there is one.

    Parameters
    ----------
    answer : Immobility

    Returns
    -------
    matplotlib figure

    Examples
    --------
    >>> from cfree.caging import immobility
    >>> square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    >>> figure = plot_immobility(immobility(square, [(0, -1), (1, 0), (0, 1), (-1, 0)]))
    >>> [text.get_text() for text in figure.texts]
    ['immobile to order 2', '4 contacts, by curvature']
    """
    fingers = [finger for finger in answer.fingers if not isinstance(finger, tuple)]
    scene = smooth(Scene(answer.body, fingers))
    window = _with_points(window_of(scene, [answer.pose]), answer.fingers)
    size = SHARE * max(window[2] - window[0], window[3] - window[1])
    moved = [] if answer.velocity is None else [_moved(answer.pose, answer.velocity, size)]
    window = _with_points(window_of(scene, [answer.pose, *moved]), answer.fingers)
    figure, ax = new_picture(window, False)
    draw_surroundings(ax, scene)
    for pose in moved:
        draw_robot(ax, scene, pose, faint=True, mark=False)
    draw_robot(ax, scene, answer.pose, faint=False, mark=False)  # an arrow ahead would look like a velocity
    _draw_points(ax, answer.fingers)
    arrow = {"arrowstyle": "->", "color": BARRIER, "linewidth": 1.6, "shrinkA": 0, "shrinkB": 0}
    for contact in answer.contacts:
        (x, y), n = contact.point, np.array([float(v) for v in contact.normal])
        u, v = (size * n / np.hypot(*n)).tolist() if n.any() else (0.0, 0.0)
        ax.annotate("", xy=(x + u, y + v), xytext=(x, y), arrowprops=arrow, zorder=8)
        ax.plot(x, y, "o", color=MARK, markersize=5, zorder=8)
    set_window(ax, window, answer.units)
    headed(figure, scene, *answer.sentence().split(": ", 1))
    return figure


def _moved(pose: Pose, velocity: Sequence[Any], size: float) -> Pose:
    """Return a pose after a short time with a velocity."""
    x, y, turning = map(float, velocity)
    time = min(size / max(1e-300, math.hypot(x, y)), 0.2 / max(1e-300, abs(turning)))
    return Pose(float(pose.x) + time * x, float(pose.y) + time * y, pose.theta + time * turning)


@checked
def plot_leaving(leaving: Leaving) -> Figure:
    """Draw the path on which a part leaves; or the parts that hold it, and the closed surface around its poses.

    Parameters
    ----------
    leaving : Leaving

    Returns
    -------
    matplotlib figure

    Examples
    --------
    >>> from cfree.disassembly import Assembly, can_leave
    >>> frame = [(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)]
    >>> lid, peg = [(0, 3), (4, 3), (4, 4), (0, 4)], [(1, 1), (3, 1), (3, 2), (1, 2)]
    >>> figure = plot_leaving(can_leave("peg", Assembly({"frame": frame, "peg": peg, "lid": lid})))
    >>> [text.get_text() for text in figure.texts]
    ['peg: it cannot leave', 'held by frame, lid, proved']
    """
    if isinstance(leaving.answer, Path):
        return picture(leaving.answer, leaving.scene)
    names = listed(list(leaving.holding), ", ")
    figure, _ = _held(leaving.scene, leaving.answer, "it cannot leave", f"held by {names}, proved")
    return figure


@checked
def plot_disassembly(answer: Disassembly) -> Figure:
    """Draw the steps of taking apart in turn: the part that leaves, and its path; then the parts that cannot.

    Parameters
    ----------
    answer : Disassembly

    Returns
    -------
    matplotlib figure

    Examples
    --------
    >>> from cfree.disassembly import Assembly, removal_order
    >>> frame = [(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)]
    >>> lid, peg = [(0, 3), (4, 3), (4, 4), (0, 4)], [(1, 1), (3, 1), (3, 2), (1, 2)]
    >>> figure = plot_disassembly(removal_order(Assembly({"frame": frame, "peg": peg, "lid": lid}, fixed=["frame"])))
    >>> [ax.get_title() for ax in figure.axes if ax.get_title()]
    ['1. lid: 1 motion, straight', '2. peg: 1 motion, straight']
    """
    steps = [*answer.removed, *answer.held]
    if not steps:
        raise ValueError("no part was decided: there is nothing to draw")
    window = _window_of_parts(answer)
    across, down = min(ACROSS, len(steps)), math.ceil(len(steps) / ACROSS)
    shape = float(np.clip((window[3] - window[1]) / (window[2] - window[0]), 0.5, 1.5))
    width, height = 5.4 * across, (4.7 * shape + 1.1) * down
    figure = new_figure((width, height))
    figure.subplots_adjust(left=0.7 / width, right=1 - 0.2 / width, bottom=0.6 / height, top=1 - 0.4 / height,
                           wspace=0.2, hspace=0.35 / shape)  # fmt: skip
    for k, step in enumerate(steps):
        ax = figure.add_subplot(down, across, k + 1)
        title = _draw_step(ax, step, k, window)
        _name(ax, step.scene, [step.part])
        ax.set_title(title, fontsize=12)
    return figure


# --- parts of pictures ---


def _held(scene: Scene, proof: Separated, headline: str, details: str) -> tuple[Figure, Any]:
    """Draw a body that is held, all that it sweeps, and the separating surface beside it."""
    polygons = of_polygons(proof, scene)
    shown = looks(proof, polygons)
    window, swept, theta = window_of(shown, [proof.start]), None, proof.start.theta
    if len(proof.pieces):
        surface = surface_of(proof, scene)
        swept = _swept(scene, proof.start, around_surface(surface, 0.0), angles_around(surface, math.degrees(theta)))
        window = window if swept is None else around([window, swept.bounds])
    figure, ax = new_picture(window, len(proof.pieces) > 0)
    if swept is not None:
        shape = path_of(rings_of_geometry(swept))
        ax.add_patch(PathPatch(shape, facecolor=GHOST, alpha=0.45, edgecolor=ROBOT, linewidth=0.6, zorder=0.9))
    draw_surroundings(ax, shown)
    draw_barrier(ax, shown, proof.obstacles)
    draw_robot(ax, shown, proof.start, faint=False)
    set_window(ax, window, scene.units)
    labels = Labels(ax, polygons)
    labels.avoid_robot(polygons, [proof.start], BODY)
    if len(proof.pieces):
        draw_surface(figure, ax, proof, scene, labels, close=True)
    _name(ax, scene)
    headed(figure, scene, headline, details)
    return figure, ax


def _draw_step(ax: Any, step: Leaving, k: int, window: Window) -> str:
    """Draw a part that leaves, with poses on its way, or one that cannot; return the title."""
    if not isinstance(step.answer, Path):
        shown = smooth(step.scene)
        draw_surroundings(ax, shown)
        draw_barrier(ax, looks(step.answer, shown), step.answer.obstacles if step.answer.curved is None else ())
        draw_robot(ax, shown, step.answer.start, faint=False, mark=False)
        set_window(ax, window, step.scene.units)
        return f"{plain(step.part)} cannot leave"
    path = own(step.answer, step.scene)
    shown = looks(path, of_polygons(step.answer, step.scene))
    draw_surroundings(ax, shown)
    travel = Travel(path, shown)
    rows = travel.at(np.linspace(0, travel.total, SAMPLES))
    for row in rows[ghosts(rows, shown)]:
        draw_robot(ax, shown, Pose(*row.tolist()), faint=True, mark=False)
    for patch in ax.patches[1:]:
        patch.set_alpha(FAINT)
    ax.plot(*rows[:, :2].T, color="white", linewidth=4, zorder=4)
    ax.plot(*rows[:, :2].T, color=MARK, linewidth=2, zorder=4)
    draw_robot(ax, shown, step.answer.start, faint=False, mark=False)
    set_window(ax, window, step.scene.units)
    return f"{k + 1}. {plain(step.part)}: {_motions(step.answer)}"


def _window_of_parts(answer: Disassembly) -> Window:
    """Return a rectangle around all parts at their places, with room for the beginning of each way out."""
    parts = [(name, answer.assembly.scene(name)) for name in answer.assembly.names]
    x0, y0, x1, y1 = around(window_of(smooth(scene), [scene.start]) for _, scene in parts if scene.start is not None)
    room = ROOM * max(x1 - x0, y1 - y0)
    return x0 - room, y0 - room, x1 + room, y1 + room


def _motions(path: Path) -> str:
    turning = f", turning {math.degrees(path.turning):.4g}°" if path.turning else ", straight"
    return f"{counted(len(path), 'motion')}{turning}"


def _name(ax: Any, scene: Scene, own: Sequence[str] = ()) -> None:
    """Write the names of the obstacles on them, and of the robot at its start."""
    from matplotlib.patheffects import withStroke

    halo = [withStroke(linewidth=2.5, foreground="white")]
    places = [(name, _polygons([shape])) for name, shape in zip(scene.obstacle_names, scene.obstacles, strict=True)]
    if own and scene.start is not None:
        body = shapely.union_all([polygon.to_shapely() for polygon in _polygons(scene.robot)])
        placed = _placed(body, float(scene.start.x), float(scene.start.y), scene.start.theta)
        places += [(name, [placed]) for name in own]
    for name, polygons in places:
        shape = shapely.union_all([p if isinstance(p, shapely.Geometry) else p.to_shapely() for p in polygons])
        part = shapely.get_geometry(shape, 0)
        middle = shapely.maximum_inscribed_circle(part, 1e-2 * math.sqrt(part.area)).coords[0]
        style = {"ha": "center", "va": "center", "fontsize": 9, "color": INK, "path_effects": halo, "zorder": 9}
        put_inside(ax, ax.text(*middle, plain(name), **style), part)


def _swept(scene: Scene, start: Pose, box: Window, degrees: Range) -> Any:
    """Return the union of the body in free poses of a grid that neighbours join with a pose; None if there are none."""
    x0, y0, x1, y1 = box
    low, high = degrees
    (xs, i), (ys, j) = (_around(float(at), *ends, STEPS) for at, ends in ((start.x, (x0, x1)), (start.y, (y0, y1))))
    turns, k = _around(math.degrees(start.theta), low, high, TURNS)
    if high - low >= 360:
        turns, k = math.degrees(start.theta) + 360 * np.arange(TURNS) / TURNS, 0
    x, y, theta = (grid.ravel() for grid in np.meshgrid(xs, ys, np.radians(turns), indexing="ij"))
    free = is_free(scene, Poses(np.column_stack([x, y]), theta)).reshape(len(xs), len(ys), len(turns))
    reached = np.zeros_like(free)
    reached[i, j, k] = free[i, j, k]
    while True:
        wider = reached.copy()
        wider[1:] |= reached[:-1]
        wider[:-1] |= reached[1:]
        wider[:, 1:] |= reached[:, :-1]
        wider[:, :-1] |= reached[:, 1:]
        wider |= np.roll(reached, 1, 2) | np.roll(reached, -1, 2)  # a part of a turn ends in poses that are not free
        wider &= free
        if np.array_equal(wider, reached):
            break
        reached = wider
    chosen = np.flatnonzero(reached.ravel())
    if not len(chosen):
        return None
    body = shapely.union_all([p.to_shapely() for p in _polygons(scene.robot)])
    return shapely.union_all([_placed(body, x[k], y[k], theta[k]) for k in chosen.tolist()])


def _around(middle: float, low: float, high: float, count: int) -> tuple[Floats, int]:
    """Return steps from a number to both ends, about so many, and which of them it is."""
    step = (high - low) / (count - 1) or 1.0
    first, last = math.ceil((low - middle) / step - 1e-9), math.floor((high - middle) / step + 1e-9)
    steps: Floats = np.arange(min(0, first), max(0, last) + 1, dtype=np.float64) * step + middle
    return steps, -min(0, first)


def _polygons(shapes: Sequence[AnyShape]) -> list[Any]:
    return [polygon for shape in shapes for polygon in polygons_for(shape, size_of(shape) / EDGES, True)]


def _placed(shape: Any, x: float, y: float, theta: float) -> Any:
    c, s = math.cos(theta), math.sin(theta)
    return shapely.transform(shape, lambda p: p @ np.array([[c, s], [-s, c]]) + (x, y))


def _draw_points(ax: Any, fingers: Sequence[Finger]) -> None:
    points = [finger for finger in fingers if isinstance(finger, tuple)]
    if points:
        xy: Floats = np.array([[float(x), float(y)] for x, y in points])
        ax.plot(*xy.T, "o", color=INK, markersize=6, markeredgecolor="white", zorder=7)


def _with_points(window: Window, fingers: Sequence[Finger]) -> Window:
    points = [finger for finger in fingers if isinstance(finger, tuple)]
    xs, ys = [float(x) for x, _ in points], [float(y) for _, y in points]
    return min([window[0], *xs]), min([window[1], *ys]), max([window[2], *xs]), max([window[3], *ys])
