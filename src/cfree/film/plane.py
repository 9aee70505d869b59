"""The workspace in a frame: obstacles, the robot in its pose, the contact, the forbidden region of the slice."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from cfree.exact.pose import Pose
from cfree.film.contact_motions import Moment, Touch, shape_of
from cfree.film.driving import DrawnDriving
from cfree.film.names import Names
from cfree.forbidden.patch import Contact, Place
from cfree.palette import ARC_ARC, EDGE_VERTEX, FORBIDDEN, GREY, HELIX, INK, OBSTACLE, OBSTACLE_RIM, ROBOT, VERTEX_EDGE
from cfree.plot.boundary import space_numbers
from cfree.plot.gears import Gears
from cfree.plot.workspace import Window, path_of, rings_of_geometry
from cfree.scene.features import WORKSPACE
from cfree.scene.scene import box_of, robot_radius
from cfree.scene.smooth import smooth_geometries

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from cfree.forbidden.slice import Slice
    from cfree.scene.scene import Scene

Floats = NDArray[np.float64]
Mark = tuple[Floats, str, Floats, Floats]  # points of a feature, its name, the name's place, inward direction

TOUCH = {"v-e": VERTEX_EDGE, "e-v": EDGE_VERTEX, "v-v": HELIX, "arc-arc": ARC_ARC}
NAMES = 0.055  # distance of a name from its feature, as a share of the width
RIM = 0.035  # distance of a name from the frame, at least
FAINTEST = 0.15  # opacity of an old trail
TRIED = 6  # places tried for the name of a feature


def whole(scene: Scene, window: Window) -> Window:
    """Return the rectangle around obstacles and positions of the reference point, with a margin."""
    boxes = np.array([window, *map(box_of, scene.obstacles)], dtype=np.float64)
    margin = robot_radius(scene)
    (x0, y0), (x1, y1) = boxes[:, :2].min(axis=0) - margin, boxes[:, 2:].max(axis=0) + margin
    return float(x0), float(y0), float(x1), float(y1)


class Plane:
    """The panel of the workspace.

    Parameters
    ----------
    figure : matplotlib figure
    place : four floats
        Left, bottom, width, height, as shares of the figure.
    scene : Scene
    window : four floats
        x0, y0, x1, y1: the rectangle shown.
    names : (str, str)
        Names of the axes x and y.
    trail : float
        Frames until the trail of the reference point has faded.
    """

    def __init__(
        self, figure: Figure, place: Window, scene: Scene, window: Window, names: tuple[str, str], trail: float
    ) -> None:
        self.scene, self._age = scene, trail
        bodies = smooth_geometries(scene, scene.obstacles)
        self._robot = [ring for body in smooth_geometries(scene, scene.robot) for ring in rings_of_geometry(body)]
        self._driving: DrawnDriving | None = None
        ax: Any = figure.add_axes(place)
        x0, y0, x1, y1 = window
        self._window = window
        self._reach = NAMES * (x1 - x0), 0.3 * robot_radius(scene)
        ax.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal", anchor="C", xlabel=names[0], ylabel=names[1])
        space_numbers(ax)
        ax.tick_params(length=3, labelsize=9)

        def shape(rings: list[Floats], **style: Any) -> Any:
            return ax.add_patch(PathPatch(path_of(rings), **style))

        self.region = shape([], facecolor=FORBIDDEN, lw=0, zorder=1)
        if scene.workspace is not None:
            frame = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
            (room,) = smooth_geometries(scene, [scene.workspace])
            outside = [frame, *(ring[::-1] for ring in rings_of_geometry(room))]
            shape(outside, facecolor=OBSTACLE, lw=0, zorder=2)
        rings = [ring for body in bodies for ring in rings_of_geometry(body)]
        shape(rings, facecolor=OBSTACLE, edgecolor=OBSTACLE_RIM, lw=0.6, zorder=2)
        if scene.bounds is not None:
            left, bottom, right, top = map(float, scene.bounds)
            dashed: Any = {"fill": False, "edgecolor": GREY, "linestyle": (0, (5, 3)), "zorder": 2.1}
            ax.add_patch(Rectangle((left, bottom), right - left, top - bottom, **dashed))
        self.trail = ax.add_collection(LineCollection([], linewidths=2.0, zorder=3, capstyle="round"), autolim=False)
        self.touched = ax.add_collection(
            LineCollection([], linewidths=4.0, zorder=4.9, capstyle="round"), autolim=False
        )
        self.target = shape([], fill=False, edgecolor=ROBOT, lw=1.2, ls="--", zorder=3.5)
        self.body = shape([], facecolor=ROBOT, alpha=0.85, lw=0, zorder=4)
        self.rim = shape([], fill=False, edgecolor=INK, lw=0.8, zorder=4.1)
        self.edges = [ax.plot([], [], lw=3.4, zorder=5, solid_capstyle="round")[0] for _ in range(2)]
        (self.vertex,) = ax.plot([], [], "o", ms=7, mec="white", mew=1.2, zorder=6)
        (self.origin,) = ax.plot([], [], "o", ms=5, color=INK, mec="white", mew=1.2, zorder=6)
        halo = [withStroke(linewidth=2.4, foreground="white")]
        self.names = [
            ax.text(0, 0, "", ha="center", va="center", fontsize=12.5, zorder=7, path_effects=halo) for _ in range(2)
        ]
        self.shapes = Names(ax, bodies, smooth_geometries(scene, scene.robot))

    def draw(
        self, recent: Sequence[Moment], cut: Slice, line: tuple[str, Floats], goal: Pose | None,
        driven: tuple[Gears, float] | None,
    ) -> None:  # fmt: skip
        """Draw everything for one frame; see `cfree.film.frame.View`."""
        moment = recent[-1]
        pose = moment.pose
        rings = self._robot
        self.region.set_path(path_of(rings_of_geometry(cut.forbidden)))
        self.body.set_path(path_of(map(pose.apply, rings)))
        self.rim.set_path(path_of(map(pose.apply, rings)))
        self.target.set_path(path_of([] if goal is None else map(goal.apply, rings)))
        colour, places = line
        self.trail.set_segments(list(np.stack((places[:-1, :2], places[1:, :2]), axis=1)))
        self.trail.set_color([(*to_rgb(colour), share) for share in self._fresh(len(places), FAINTEST)])
        self._draw_touched(recent)
        self.origin.set_data([float(pose.x)], [float(pose.y)])
        self._draw_contact(moment)
        self._draw_driven(pose, driven)
        self.shapes.draw(pose, self.names)

    def _draw_driven(self, pose: Pose, driven: tuple[Gears, float] | None) -> None:
        """Draw wheels and gears in place of the reference point and its trail, while a vehicle drives."""
        for artist in (self.trail, self.origin):
            artist.set_visible(driven is None)
        if driven is not None:
            gears, travel = driven
            if self._driving is None:
                self._driving = DrawnDriving(self.body.axes, gears)
            self._driving.draw(travel, pose)
        if self._driving is not None:
            self._driving.show(visible=driven is not None)

    def _fresh(self, count: int, faintest: float) -> list[float]:
        """Return opacities of the parts of a line through `count` places: they fade with their age."""
        shares: list[float] = np.clip(1 - np.arange(count - 2, -1, -1) / self._age, faintest, 1).tolist()
        return shares

    def _draw_touched(self, recent: Sequence[Moment]) -> None:
        """Draw the recent contact points as a fading line."""
        contacts = [moment.contact for moment in recent]
        places = [self._touch(moment) for moment in recent]
        parts = [
            (np.stack((a, b)), (*to_rgb(TOUCH[now.kind]), share))
            for a, b, now, share in zip(places, places[1:], contacts[1:], self._fresh(len(places), 0.0), strict=False)
            if now is not None and a is not None and b is not None
        ]
        self.touched.set_segments([part for part, _ in parts])
        self.touched.set_color([colour for _, colour in parts])

    def _touch(self, moment: Moment) -> Floats | None:
        """Return the contact point: the robot's own vertex, or the obstacle's; None without contact."""
        if moment.contact is None:
            return None
        if moment.touch is not None:
            return moment.touch.point
        robot, obstacle = moment.contact.robot, moment.contact.obstacle
        if robot.end is None:
            vertices = self.scene.robot[robot.polygon].vertices
            return np.asarray(moment.pose.apply(vertices[robot.index : robot.index + 1])[0])
        return np.asarray(shape_of(self.scene, obstacle).vertices[obstacle.index])

    def _draw_contact(self, moment: Moment) -> None:
        contact = moment.contact
        for artist in (*self.edges, self.vertex, *self.names):
            artist.set_visible(contact is not None)
        if contact is None:
            return
        marks = self._marks(contact, moment.pose) if moment.touch is None else self._round_marks(contact, moment.touch)
        for edge, name, (points, text, place, inwards) in zip(self.edges, self.names, marks, strict=True):
            edge.set_visible(len(points) > 1)
            edge.set(xdata=points[:, 0], ydata=points[:, 1], color=TOUCH[contact.kind])
            name.set(text=text, position=self._inside(place), color=TOUCH[contact.kind])
            for k in range(1, TRIED):  # move it farther inside while it covers the other name
                if name is self.names[0] or not name.get_window_extent().overlaps(self.names[0].get_window_extent()):
                    break
                name.set_position(self._inside(place + k * inwards))
            if len(points) == 1:
                self.vertex.set(xdata=points[:, 0], ydata=points[:, 1], markerfacecolor=TOUCH[contact.kind])
        if moment.touch is not None:
            ((x, y),) = moment.touch.point[None].tolist()
            self.vertex.set(xdata=[x], ydata=[y], markerfacecolor=TOUCH[contact.kind])

    def _inside(self, place: Floats) -> tuple[float, float]:
        """Return the nearest place at which a name is within the frame."""
        rim = RIM * (self._window[2] - self._window[0])
        x, y = np.clip(place, np.array(self._window[:2]) + rim, np.array(self._window[2:]) - rim).tolist()
        return x, y

    def _marks(self, contact: Contact, pose: Pose) -> tuple[Mark, Mark]:
        """Return the marks of the robot's feature and of the obstacle's."""
        robot, obstacle = self.scene.robot[contact.robot.polygon], shape_of(self.scene, contact.obstacle)
        inwards = -1 if contact.obstacle.polygon == WORKSPACE else 1
        return (
            self._mark(contact.robot, pose.apply(robot.vertices), robot.ring_offsets, "aA", min(self._reach)),
            self._mark(contact.obstacle, obstacle.vertices, obstacle.ring_offsets, "bO", inwards * self._reach[0]),
        )

    def _round_marks(self, contact: Contact, touch: Touch) -> tuple[Mark, Mark]:
        """Return the same marks of edges, arcs and vertices of rounded shapes."""
        marks = []
        for letters, place, points, inwards in (
            ("aA", contact.robot, touch.robot, min(self._reach) * touch.normal),
            ("bO", contact.obstacle, touch.obstacle, -self._reach[0] * touch.normal),
        ):
            number = feature_number(place)
            letter = letters[0] if place.end is None else "E"
            text = (
                ""
                if number is None
                else f"${letter}_{{{number}}}{'^A' if letters[1] == 'A' and letter == 'E' else ''}$"
            )
            beside = touch.point if place.end is None else points.mean(axis=0)
            marks.append((points, text, beside + 1.5 * inwards, inwards))
        return marks[0], marks[1]

    def _mark(self, place: Place, vertices: Floats, offsets: Any, letters: str, inwards: float) -> Mark:
        """Return the mark of a feature, with its name at this distance inside its shape."""
        if place.end is not None:
            points = vertices[[place.index, place.end]]
            x, y = (points[1] - points[0]) / np.linalg.norm(points[1] - points[0])
            letter = "^A" if letters[1] == "A" else ""
            inside = abs(inwards) * np.array([-y, x])
            return points, f"$E_{{{edge_number(place)}}}{letter}$", points.mean(axis=0) + inside, inside
        k, first, count = place.index, offsets[place.ring], offsets[place.ring + 1] - offsets[place.ring]
        before, point, after = (vertices[first + (k - first + step) % count] for step in (-1, 0, 1))
        u, v = (point - before) / np.linalg.norm(point - before), (after - point) / np.linalg.norm(after - point)
        inside = np.array([-(u + v)[1], (u + v)[0]])  # the interior is on the left
        inside *= 1.5 * inwards / max(float(np.linalg.norm(inside)), 1e-12)
        return point[None], f"${letters[0]}_{{{k + 1}}}$", point + inside, inside


def feature_number(place: Place) -> int | None:
    """Number, from 1, of a vertex, an arc, or an edge; None for an edge beside an arc, whose ends have no number."""
    if place.end is None:
        return place.index + 1
    return None if min(place.index, place.end) < 0 else edge_number(place)


def edge_number(place: Place) -> int:
    """Number, from 1, the vertex where an edge begins; edges of the workspace run against its rings."""
    assert place.end is not None
    return 1 + (place.end if place.polygon == WORKSPACE else place.index)


def obstacle_name(place: Place) -> str:
    """Name an obstacle as in the figures, or the workspace."""
    return "the workspace" if place.polygon == WORKSPACE else f"$O_{{{place.polygon + 1}}}$"
