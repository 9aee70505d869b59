"""Frames of a path: the robot among the obstacles, its clearance, and its point in the configuration space."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from cfree.collision.distance import EdgeDistances
from cfree.film.camera import Camera
from cfree.film.driving import DrawnDriving
from cfree.film.frame import MONO, ROOMY, axis_names, image_of, new_frame, numbers
from cfree.film.names import Names
from cfree.film.space import Space
from cfree.palette import BARRIER, FAINT, GREY, INK, RIM, ROBOT
from cfree.plot.boundary import extent, plain, set_window
from cfree.plot.gears import draw_vehicle, gear_handles
from cfree.plot.labels import BODY, LINE, Labels
from cfree.plot.path import Track, poses_of, quantity, statement
from cfree.plot.workspace import Window, draw_robot, draw_surroundings, path_of, rings_of
from cfree.scene.scene import robot_radius
from cfree.scene.smooth import smooth_geometries

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary
    from cfree.scene.scene import Scene

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]

SECONDS = 4.0, 20.0  # limits of a path's default duration: one second per robot radius of travel
AZIMUTHS = math.radians(-62), math.radians(-32)  # the camera turns from one to the other
SHADES = 24  # colours of the line in configuration space
REST = 0.6, 1.2  # seconds for which the robot rests before and after its path
TITLE = 40  # characters of the title at most
DASH = 8  # steps of the path from dash to dash
GLASS = 0.08  # opacity of patches above the robot's orientation


class PathStage:
    """The film set of one path: draws its frames.

    Parameters
    ----------
    track : Track
    boundary : Boundary, optional
        The boundary, if the configuration space is to be shown.
    size : (int, int)
        Width and height in pixels.
    """

    def __init__(self, track: Track, boundary: Boundary | None, size: tuple[int, int]) -> None:
        self.track, self.boundary, scene = track, boundary, track.scene
        self.radius = robot_radius(scene)
        self.figure, height = new_frame(size)
        figure, width = self.figure, self.figure.get_figwidth()
        low, top = 1.15 / height, 1 - 0.85 / height
        right = 0.45 if boundary is not None else 0.98
        self._draw_plane(figure, (0.65 / width, low, right - 0.65 / width, top - low))
        self.space: Space | None = None
        if boundary is not None:
            place = 0.46, 0.3 / height, 0.53, 1 - 1.1 / height
            self.space = Space(figure, place, boundary, extent(boundary), axis_names(scene), 0)
            self.stays = np.zeros(len(self.space.angles), dtype=np.bool_)
            self.dashes = LineCollection([], linewidths=1.8, zorder=7)
            self.space.point.axes.add_collection(self.dashes, autolim=False)
        if track.least is not None:
            self._draw_gauge(figure, (0.3 / width, 0.36 / height, min(0.28, 2.6 / width), 0.15 / height))
        text: Any = {"va": "center", "color": INK}
        figure.text(0.2 / width, 1 - 0.3 / height, _title(scene), fontsize=16, weight="bold", **text)
        small = 11 if track.gears is None or width > ROOMY else 9.5
        figure.text(0.2 / width, 1 - 0.63 / height, statement(track), fontsize=small, **text | {"color": GREY})
        self.gear = figure.text(0.3 / width, 0.75 / height, "", fontsize=12, weight="bold", va="center")
        if track.gears is not None:
            figure.legend(
                handles=gear_handles(track.gears), loc="center right", ncols=4, frameon=False, fontsize=10,
                bbox_to_anchor=(1 - 0.1 / width, 1 - 0.3 / height), handlelength=1.4, columnspacing=1.2,
                handletextpad=0.5, borderaxespad=0,
            )  # fmt: skip
        self.pose = figure.text(1 - 0.2 / width, 0.25 / height, "", fontsize=10.5, ha="right", family=MONO, **text)
        lines = track.rows * (1, 1, 180 / math.pi)
        self.line = np.column_stack((lines[:, :2], lines[:, 2] % 360))
        self.shade = _shades(track)
        self.colours = track.at_steps()
        self.distances = EdgeDistances(scene)

    def _draw_plane(self, figure: Figure, place: Window) -> None:
        """Draw the workspace, and make the artists of everything that moves."""
        track = self.track
        ax: Any = figure.add_axes(place)
        draw_surroundings(ax, track.scene)
        gears, goal = track.gears, track.path.goal
        if gears is None:
            draw_robot(ax, track.scene, goal, faint=True)
        else:
            draw_vehicle(ax, track.scene, goal, gears.wheels, gears.curvature("goal"), faint=True)
        xy = track.rows[:, :2] if gears is None else gears.axle(track.rows)
        ax.plot(*xy.T, color=RIM, linewidth=1.0, linestyle=(0, (4, 3)), zorder=3.5)
        self.ghosts = ax.add_collection(PathCollection([], linewidths=0.7, zorder=2), autolim=False)
        self.trace = ax.add_collection(LineCollection([], linewidths=2.4, capstyle="round", zorder=4), autolim=False)
        self.body = ax.add_patch(PathPatch(path_of([]), facecolor=ROBOT, alpha=0.8, linewidth=0, zorder=5))
        self.rim = ax.add_patch(PathPatch(path_of([]), fill=False, edgecolor=INK, linewidth=0.8, zorder=5.1))
        (self.origin,) = ax.plot([], [], "o", ms=5, color=INK, mec="white", mew=1.2, zorder=6)
        self.driving = None if gears is None else DrawnDriving(ax, gears)
        self.origin.set_visible(gears is None)
        (self.gap,) = ax.plot([], [], "o-", ms=3.5, lw=1.8, color=BARRIER, zorder=7)
        set_window(ax, track.window, track.scene.units)
        ax.tick_params(length=3, labelsize=9)
        labels = Labels(ax, track.scene)
        labels.avoid_robot(track.scene, [goal], BODY)
        labels.avoid([shapely.LineString(xy)], LINE)
        labels.name_robot(track.scene, goal, "goal")
        self.words = [text for text in ax.texts if text.get_text()]
        self.names = Names(
            ax,
            smooth_geometries(track.scene, track.scene.obstacles),
            smooth_geometries(track.scene, track.scene.robot),
            is_robot_named=gears is None,
        )

    def _draw_gauge(self, figure: Figure, place: Window) -> None:
        """Draw a bar of all clearances, and a pointer to the present one."""
        track = self.track
        most = track.most
        ax: Any = figure.add_axes(place)
        if track.gears is None:
            ax.imshow(np.linspace(0, 1, 256)[None], aspect="auto", cmap=track.colours.cmap, extent=(0, most, 0, 1))
        else:  # colours are those of gears
            ax.set_facecolor(FAINT)
        ax.set(yticks=[], xlim=(0, most), ylim=(0, 1))
        ax.xaxis.set_major_locator(MaxNLocator(4))
        ax.tick_params(length=2, labelsize=8.5)
        assert track.least is not None
        ax.axvline(track.least.found, color=BARRIER, linewidth=2)
        (self.pointer,) = ax.plot([], [], "v", color=INK, ms=8, clip_on=False, zorder=5)
        left, bottom, width, height = place
        right, middle = left + width + 0.2 / figure.get_figwidth(), bottom + height / 2
        self.value = figure.text(right, middle, "", fontsize=12, color=INK, va="center")

    def draw(self, travel: float, share: float) -> Image:
        """Draw the frame after this travel, at this share of the film, as (height, width, 3) bytes."""
        track = self.track
        row = track.travel.at([travel])
        (pose,) = poses_of(row)
        outline = path_of(pose.apply(ring) for ring in rings_of(track.scene.robot))
        self.body.set_path(outline)
        self.rim.set_path(outline)
        self.origin.set_data(row[:, 0], row[:, 1])
        done = int(np.searchsorted(track.steps, travel, side="right"))
        colours = self.colours[:done]
        if self.driving is None:
            ends = np.concatenate((track.rows[:done, :2], row[:, :2]))
            self.trace.set_segments(list(np.stack((ends[:-1], ends[1:]), axis=1)))
            self.trace.set_color(colours)
        else:
            self.driving.draw(travel, pose)
            word, colour = self.driving.gears.word(travel)
            self.gear.set(text=word, color=colour)
        past = [k for k in track.ghosts.tolist() if k < done]
        self.ghosts.set_paths(
            [path_of(q.apply(ring) for ring in rings_of(track.scene.robot)) for q in poses_of(track.rows[past])]
        )
        self.ghosts.set_facecolor(colours[past] * (1, 1, 1, 0.14))
        self.ghosts.set_edgecolor(colours[past] * (1, 1, 1, 0.55))
        if track.least is not None:
            self._point(row)
        if self.space is not None and self.boundary is not None:
            azimuth = AZIMUTHS[0] + share * (AZIMUTHS[1] - AZIMUTHS[0])
            here = np.array([[*row[0, :2], math.degrees(pose.theta)]])
            lines = _runs(np.concatenate((self.line[:done], here)), self.shade)
            self.space.draw(pose, self.boundary.slice(pose.theta), azimuth, self.space.angles, GLASS, lines, self.stays)
            self._dash(azimuth, done, colours)
        self.names.draw(pose, self.words)
        self.pose.set_text(numbers(pose))
        return image_of(self.figure)

    def _dash(self, azimuth: float, done: int, colours: Floats) -> None:
        """Draw the path so far in configuration space, in dashes that nothing hides."""
        assert self.space is not None
        camera = Camera(self.space.window, *self.space.panel, azimuth)
        step = np.stack((self.line[: done - 1], self.line[1:done]), axis=1)
        shown = (np.arange(len(step)) % DASH < DASH / 2) & (np.abs(np.diff(step[..., 2], axis=1)[:, 0]) < 180)
        self.dashes.set_segments(list(camera(step[shown])[0]))
        self.dashes.set_color(list(map(tuple, colours[: len(step)][shown].tolist())))

    def _point(self, row: Floats) -> None:
        """Show the clearance in words, on the bar, and in the workspace."""
        edges = self.distances.placed(row)
        (distance,), (edge,), (other,) = self.distances.nearest(edges)
        points = self.distances.between(edges[0, edge], int(other))
        self.gap.set_data(*points.T)
        self.pointer.set_data([min(distance, self.track.most)], [1.6])
        self.value.set_text(f"clearance {quantity(float(distance), self.track.scene.units)}")


def path_frames(
    track: Track, boundary: Boundary | None, seconds: float | None, fps: int, size: tuple[int, int],
    progress: Callable[[float], object] | None,
) -> Iterator[Image]:  # fmt: skip
    """Yield all frames: the robot rests, moves at even speed, and rests."""
    if seconds is None:
        seconds = float(np.clip(track.travel.total / robot_radius(track.scene), *SECONDS))
    before, after = (round(rest * fps) for rest in REST)
    moving = max(2, round((seconds + sum(REST)) * fps) - before - after)
    travel = np.concatenate((np.zeros(before), np.linspace(0, track.travel.total, moving)))
    stage = PathStage(track, boundary, size)
    total = len(travel) + after
    for k, s in enumerate(travel.tolist()):
        frame = stage.draw(s, k / len(travel))
        yield frame
        if progress is not None:
            progress((k + 1) / total)
    for k in range(after):
        yield frame
        if progress is not None:
            progress((len(travel) + k + 1) / total)


def _title(scene: Scene) -> str:
    """Return the name of a scene, shortened if it is long, or a name for a scene without one."""
    name = scene.name or "a free path"
    return plain(name if len(name) <= TITLE else f"{name[:TITLE]}...")


def _shades(track: Track) -> list[str]:
    """Return a colour for each row, from a small set."""
    if track.gears is not None:
        return [to_hex(colour) for colour in track.at_steps()]
    most = track.most
    steps = np.floor(np.nan_to_num(track.distance) / most * SHADES + 0.5) / SHADES * most
    return [to_hex(colour) for colour in track.colour(steps)]


def _runs(line: Floats, shades: list[str]) -> list[tuple[str, Floats]]:
    """Split the line into parts of one colour, each up to the beginning of the next."""
    runs, first = [], 0
    for k in range(1, len(line)):
        if k == len(line) - 1 or shades[k] != shades[first]:
            runs.append((shades[first], line[first : k + 1]))
            first = k
    return runs
