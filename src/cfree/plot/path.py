"""Pictures of a path in the workspace: ghosts of the robot, coloured by clearance or gear, and the least clearance."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.collision.distance import EdgeDistances
from cfree.collision.motion import Translation
from cfree.exact.pose import Pose, Poses
from cfree.palette import BARRIER, MARK, ROBOT, SEQUENTIAL
from cfree.paths.clearance import Clearance, distances_beside, own_clearance, own_scene, rounded_down
from cfree.paths.path import Path
from cfree.paths.preferences import NONE, Preferences, Unwanted, unwanted
from cfree.paths.travel import SAME, Travel, ghosts
from cfree.plot.boundary import around, keep_inside, new_axes, plain, roomy, set_window, with_unit
from cfree.plot.gears import Gears, draw_axle_track, draw_legend, draw_stands, draw_vehicle
from cfree.plot.labels import BODY, GHOST, LINE, Labels
from cfree.plot.looks import looks, of_polygons, own
from cfree.plot.workspace import Window, draw_robot, draw_surroundings, path_of, rings_of
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene, robot_radius
from cfree.words import counted, is_abbreviation

Floats = NDArray[np.float64]

TRACE = 600
WIDE = 64  # characters of a line of the title
RING = 5.5  # typographic points: radius of the mark where the clearance is least
NEAR = 2.0  # obstacles within this multiple of the least clearance limit it


@dataclass(frozen=True, eq=False)
class Track:
    """A path, sampled for drawing.

    Attributes
    ----------
    steps : (TRACE,) float64
        Travel of the robot, at even steps.
    rows : (TRACE, 3) float64
        x, y and theta, unrolled, after that travel.
    distance : (TRACE,) float64
        Distances to the nearest obstacle or workspace there, or NaN without any.
    least : Clearance, optional
    closest : (2, 2) float64
        The two points of robot and obstacle at the least clearance, if there is one.
    window : four floats
        x0, y0, x1, y1: the part of the workspace near the path.
    most : float
        End of the scale of colours.
    colours : ScalarMappable
        Map of distances to colours.
    gears : Gears, optional
        The path as its vehicle drives it.
    """

    path: Path
    scene: Scene
    travel: Travel
    steps: Floats
    rows: Floats
    distance: Floats
    least: Clearance | None
    closest: Floats
    window: Window
    most: float
    colours: ScalarMappable
    gears: Gears | None

    @classmethod
    def of(cls, path: Path, scene: Scene) -> Track:
        from matplotlib import colormaps
        from matplotlib.cm import ScalarMappable
        from matplotlib.colors import Normalize

        travel, distances = Travel(path, scene), distances_beside(path, own_scene(path, scene))
        steps = np.linspace(0, travel.total, TRACE)
        rows = travel.at(steps)
        least = own_clearance(path, scene)
        distance, closest, edges = np.full(TRACE, math.nan), np.empty((0, 2)), distances.placed(rows)
        if least is not None:
            distance, _, _ = distances.nearest(edges)
            closest = _closest(path, distances, least)
        farthest = float(np.nanmax(distance, initial=0.0))
        # clearances beyond the robot's own size need no different colours
        most = min(farthest, 2 * distances.radius) if farthest > SAME * distances.radius else distances.radius
        colours = ScalarMappable(Normalize(0.0, most), colormaps[SEQUENTIAL])
        gears = Gears.of(path, scene, travel)
        swept = edges.reshape(-1, 2)
        window = _window(scene, swept if gears is None else np.concatenate((swept, gears.near(rows))))
        return cls(path, scene, travel, steps, rows, distance, least, closest, window, most, colours, gears)

    def colour(self, distance: Floats) -> Floats:
        """Return colours (n, 4) of distances; one colour if there is no obstacle."""
        from matplotlib.colors import to_rgba

        if self.least is None:
            return np.tile(to_rgba(ROBOT), (len(distance), 1))
        return np.asarray(self.colours.to_rgba(distance))

    def at_steps(self) -> Floats:
        """Return the colours (TRACE, 4) of all rows: of their gears, or of their clearances."""
        return self.colour(self.distance) if self.gears is None else self.gears.colours(self.steps)

    def between_steps(self) -> Floats:
        """Return the colours (TRACE - 1, 4) of the lines from row to row."""
        if self.gears is not None:
            return self.gears.colours((self.steps[1:] + self.steps[:-1]) / 2)
        return self.colour((self.distance[1:] + self.distance[:-1]) / 2)

    @property
    def ghosts(self) -> NDArray[np.int64]:
        """Return the rows between start and goal at which the robot is drawn."""
        return ghosts(self.rows, self.scene)


@checked
def plot_path(path: Path, scene: Scene, ax: Axes | None = None, *, preferences: Preferences | None = None) -> Axes:
    """Draw a path in the workspace, coloured by clearance; a path of a vehicle by gear.

    Parameters
    ----------
    path : Path
    scene : Scene
        The scene in which the path is free.
    ax : matplotlib axes, optional
    preferences : Preferences, optional
        Motions penalised by these preferences are marked.

    Returns
    -------
    matplotlib axes
        They show start and goal, ghosts of the robot at even steps of its farthest point, and the reference point's
        trace. The place of least clearance is marked, with the obstacles that limit it: those within twice that
        distance. A path of a vehicle has the track of its axle point instead, a colour for each gear and a dot at each
        change of direction, and the robot with its wheels there, at six of them at most. The front wheels of a car
        with a wheelbase have the angle of the motion that follows.

    Raises
    ------
    ValueError
        If the path is not free, or its vehicle cannot drive it.

    Notes
    -----
    The title has the least clearance found, and a proved lower bound: see `Path.clearance`. Colours are distances at
    600 poses, in doubles.

    Examples
    --------
    >>> from cfree.collision.motion import Rotation, Translation
    >>> from cfree.paths.path import Path
    >>> from cfree.exact.pose import Pose
    >>> from cfree.scene.scene import Scene
    >>> scene = Scene(robot=[(0, 0), (2, 0), (2, 1), (0, 1)], obstacles=[[(2, 3), (5, 3), (5, 4)]], units="m")
    >>> ax = plot_path(Path(Pose(0, 0), [Translation((4, 0)), Rotation((6, 0), "-90deg")]), scene)
    >>> ax.get_title()
    '2 motions, length 7.14 m, turning 90°, clearance 0.926 m (≥ 0.924 proved)'
    """
    track = Track.of(own(path, scene), of_polygons(path, scene))
    if ax is None:
        x0, y0, x1, y1 = track.window
        height = float(np.clip(1.3 + 6.2 * (y1 - y0) / (x1 - x0), 3, 9))
        place = (0.09, 0.1, 0.78, 0.83) if track.gears is None else (0.09, 1 / height, 0.88, 1 - 1.6 / height)
        ax = new_axes((8, height), place)
    draw_track(ax, track, preferences or NONE)
    ax.set_title(statement(track) if track.gears is None else fill(statement(track), WIDE))
    return ax


def draw_track(ax: Any, track: Track, preferences: Preferences) -> Labels:
    """Draw the path among the obstacles; return the labels on the axes, for adding more."""
    import shapely
    from matplotlib.collections import LineCollection, PathCollection

    track = replace(track, scene=looks(track.path, track.scene))
    scene, path, gears = track.scene, track.path, track.gears
    draw_surroundings(ax, scene)
    rings = rings_of(scene.robot)
    ghost_rows = track.ghosts
    colours = track.at_steps()[ghost_rows]
    shapes = [path_of(pose.apply(ring) for ring in rings) for pose in poses_of(track.rows[ghost_rows])]
    fill, rim = colours.copy(), colours.copy()
    fill[:, 3], rim[:, 3] = (0.22, 0.9) if gears is None else (0.07, 0.4)
    ax.add_collection(
        PathCollection(shapes, facecolors=fill, edgecolors=rim, linewidths=0.8, zorder=2, label="ghosts"), autolim=False
    )
    xy = track.rows[:, :2] if gears is None else gears.axle(track.rows)
    if gears is None:
        ends = np.stack((xy[:-1], xy[1:]), axis=1)
        for colour, width in (("white", 3.6), (track.between_steps(), 2.0)):
            line = LineCollection(list(ends), colors=colour, linewidths=width, capstyle="round", zorder=4)
            ax.add_collection(line, autolim=False)
        ax.collections[-1].set_label("trace")
    else:
        draw_stands(ax, scene, gears)
        draw_axle_track(ax, gears)
        draw_legend(ax, gears)
    rests = {"start": path.start, "goal": path.goal}
    for name, pose in rests.items():
        if gears is None:
            draw_robot(ax, scene, pose, faint=name == "goal")
        else:
            draw_vehicle(ax, scene, pose, gears.wheels, gears.curvature(name), faint=name == "goal")
    set_window(ax, track.window, scene.units)
    if track.least is not None and gears is None:
        _draw_scale(ax, track)
    labels = Labels(ax, scene)
    labels.avoid_robot(scene, poses_of(track.rows[ghost_rows]), GHOST)
    labels.avoid([shapely.LineString(xy)], LINE)
    labels.avoid_robot(scene, rests.values(), BODY)
    if track.least is not None:
        _draw_least(ax, track, labels)
    for name, pose in rests.items():
        labels.name_robot(scene, pose, name)
    for part in unwanted(path, scene, preferences):
        _draw_unwanted(ax, path, part, labels)
    labels.name_bounds(scene)
    return labels


def _draw_unwanted(ax: Any, path: Path, part: Unwanted, labels: Labels) -> None:
    """Draw penalised motions with their kind, or the spot of a turn in place."""
    shares = np.linspace(0, 1, 20)
    ends = zip(path.poses[part.first : part.last + 1], path.motions[part.first : part.last + 1], strict=True)
    xy = np.concatenate([motion.sample(pose, shares).xy for pose, motion in ends])
    is_spot = part.kind == "turning"
    ax.plot(*xy.T, "s" if is_spot else "--", color=MARK, linewidth=2.0, markersize=7, zorder=4.5, label=part.kind)
    text = f"{math.degrees(part.amount):.0f}°" if is_spot else part.kind
    labels.put(text, xy[len(xy) // 2], color=MARK)


def _draw_scale(ax: Any, track: Track) -> None:
    """Draw the colour scale of clearances beside axes, with the least clearance marked on it."""
    from mpl_toolkits.axes_grid1 import make_axes_locatable

    beside = make_axes_locatable(ax).append_axes("right", size="2.5%", pad=0.12)
    above = bool(np.nanmax(track.distance) > track.most)
    ax.figure.colorbar(track.colours, cax=beside, extend="max" if above else "neither")
    beside.set_ylabel(with_unit("clearance", track.scene.units))
    if track.least is not None:
        beside.axhline(track.least.found, color=BARRIER, linewidth=2)
    keep_inside(ax)


def statement(track: Track) -> str:
    """Describe the path in one line."""
    path, units = track.path, track.scene.units
    count = len(path.motions)
    parts = [counted(count, "motion"), f"length {quantity(path.length, units)}"]
    parts.append(f"turning {quantity(math.degrees(path.turning), '')}°")
    if track.gears is not None:
        parts.append(counted(path.cusps, "change") + " of direction")
    if track.least is not None:
        parts.append(f"clearance {quantity(track.least.found, units)} (≥ {rounded_down(track.least.least, 3)} proved)")
    return ", ".join(parts)


def quantity(value: float, units: str) -> str:
    """Write a length with its unit, if that is an abbreviation.

    Examples
    --------
    >>> quantity(0.12345, "m"), quantity(2345.6, "corridor widths")
    ('0.123 m', '2346')
    """
    number = f"{value:.0f}" if 1000 <= value < 1_000_000 else f"{value:.3g}"
    return f"{number} {plain(units)}" if is_abbreviation(units) else number


def _draw_least(ax: Any, track: Track, labels: Labels) -> None:
    """Draw the robot at its least clearance, the obstacles that limit it, and the distance."""
    from matplotlib.patches import PathPatch

    scene, least = track.scene, track.least
    assert least is not None
    pose = _pose_of_least(track.path, least)
    shape = path_of(pose.apply(ring) for ring in rings_of(scene.robot))
    ax.add_patch(PathPatch(shape, fill=False, edgecolor=BARRIER, linewidth=1.6, zorder=5, label="least clearance"))
    limits = path_of(rings_of(_limiting(scene, pose, NEAR * least.found)))
    ax.add_patch(
        PathPatch(limits, fill=False, edgecolor=BARRIER, linewidth=1.8, zorder=2.5, label="limiting obstacles")
    )
    ax.plot(*track.closest.T, "-", color=BARRIER, linewidth=2, zorder=6, solid_capstyle="butt")
    middle = track.closest.mean(axis=0)
    ax.plot(*middle, "o", markersize=2 * RING, markerfacecolor="none", color=BARRIER, markeredgewidth=1.6, zorder=6)
    labels.avoid_robot(scene, [pose], BODY)
    labels.put(quantity(least.found, scene.units), middle, ring=RING, color=BARRIER, weight="bold")


def _window(scene: Scene, swept: Floats) -> Window:
    """Return the part of the scene's rectangle that is near points (n, 2) of the path."""
    near = np.concatenate((swept.min(axis=0), swept.max(axis=0)))
    x0, y0, x1, y1 = near.tolist()
    bodies = [*scene.obstacles, *([scene.workspace] if scene.workspace else [])]
    boxes: list[Window] = [(x0, y0, x1, y1), *(body.bounds for body in bodies)]
    if scene.bounds is not None:
        left, bottom, right, top = map(float, scene.bounds)
        boxes.append((left, bottom, right, top))
    everything: Floats = np.array(around(boxes))
    margin = 0.4 * float((near[2:] - near[:2]).max()) + 2 * robot_radius(scene)
    x0, y0 = np.maximum(near[:2] - margin, everything[:2]).tolist()
    x1, y1 = np.minimum(near[2:] + margin, everything[2:]).tolist()
    return roomy((x0, y0, x1, y1))


def _limiting(scene: Scene, pose: Pose, reach: float) -> list[Polygon]:
    """Return the obstacles, and the workspace, within reach of the robot in a pose."""
    import shapely

    bodies = [*scene.obstacles, *([scene.workspace] if scene.workspace else [])]
    outlines = [shapely.boundary(body.to_shapely()) for body in bodies]
    robot = shapely.multilinestrings([shapely.linearrings(pose.apply(ring)) for ring in rings_of(scene.robot)])
    near = shapely.distance(robot, outlines) <= reach + SAME * robot_radius(scene)
    return [bodies[k] for k in np.flatnonzero(near)]


def _pose_of_least(path: Path, least: Clearance) -> Pose:
    motions = path.motions or (Translation((0, 0)),)
    return motions[least.motion].sample(path.poses[least.motion], [least.share])[0]


def _closest(path: Path, distances: EdgeDistances, least: Clearance) -> Floats:
    """Return the points of robot and obstacle, (2, 2), at the least clearance."""
    edge = _pose_of_least(path, least).apply(distances.robot[distances.robot_names.index(least.robot)])
    return distances.between(edge, distances.names.index(least.obstacle))


def poses_of(rows: Floats) -> Poses:
    """Convert rows x, y, theta to poses."""
    return Poses(rows[:, :2], rows[:, 2])
