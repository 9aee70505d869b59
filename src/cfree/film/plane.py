"""The workspace in a frame: obstacles, the robot in its pose, what touches, where the reference point may not be."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from cfree.exact.pose import Pose
from cfree.film.box import INK
from cfree.film.moves import Moment, shape_of
from cfree.forbidden.kinds import COLOURS, PatchKind
from cfree.forbidden.patch import Contact, Place
from cfree.palette import FORBIDDEN, GREY, OBSTACLE, ROBOT
from cfree.plot.pieces import Colours
from cfree.plot.workspace import Window, path_of, rings_of, rings_of_geometry
from cfree.scene.features import WORKSPACE
from cfree.scene.scene import robot_radius

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from cfree.forbidden.slice import Slice
    from cfree.scene.scene import Scene

Floats = NDArray[np.float64]
Mark = tuple[Floats, str, Floats]  # points of a feature, its name, where to write it

TOUCH = {"v-e": COLOURS[PatchKind.VERTEX_EDGE], "e-v": COLOURS[PatchKind.EDGE_VERTEX], "v-v": Colours.helix}
PLACE = 0.055, 0.17, 0.38, 0.655
NAMES = 0.055  # distance of a name from its feature, a part of the width


class Plane:
    """Axes of the workspace.

    Parameters
    ----------
    figure : matplotlib figure
    scene : Scene
    window : four floats
        x0, y0, x1, y1 around all positions of the reference point.
    names : (str, str)
        Of the axes x and y.
    """

    def __init__(self, figure: Figure, scene: Scene, window: Window, names: tuple[str, str]) -> None:
        self.scene = scene
        ax: Any = figure.add_axes(PLACE)
        boxes = np.array([window, *(polygon.bounds for polygon in scene.obstacles)], dtype=np.float64)
        margin = 0.6 * robot_radius(scene)
        (x0, y0), (x1, y1) = boxes[:, :2].min(axis=0) - margin, boxes[:, 2:].max(axis=0) + margin
        self._reach = NAMES * (x1 - x0), 0.3 * robot_radius(scene)
        ax.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal", anchor="C", xlabel=names[0], ylabel=names[1])
        for axis in (ax.xaxis, ax.yaxis):
            axis.set_major_locator(MaxNLocator(6, integer=max(x1 - x0, y1 - y0) >= 5))
        ax.tick_params(length=3, labelsize=9)

        def shape(rings: list[Floats], **style: Any) -> Any:
            return ax.add_patch(PathPatch(path_of(rings), **style))

        self.region = shape([], facecolor=FORBIDDEN, lw=0, zorder=1)
        if scene.workspace is not None:
            frame = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
            outside = [frame, *(ring[::-1] for ring in rings_of([scene.workspace]))]
            shape(outside, facecolor=OBSTACLE, lw=0, zorder=2)
        shape(rings_of(scene.obstacles), facecolor=OBSTACLE, edgecolor="#3c434d", lw=0.6, zorder=2)
        if scene.bounds is not None:
            left, bottom, right, top = map(float, scene.bounds)
            dashed: Any = {"fill": False, "edgecolor": GREY, "linestyle": (0, (5, 3)), "zorder": 2.1}
            ax.add_patch(Rectangle((left, bottom), right - left, top - bottom, **dashed))
        (self.tail,) = ax.plot([], [], lw=1.6, zorder=3, solid_capstyle="round")
        self.target = shape([], fill=False, edgecolor=ROBOT, lw=1.1, ls="--", zorder=3.5)
        self.body = shape([], facecolor=ROBOT, alpha=0.72, lw=0, zorder=4)
        self.rim = shape([], fill=False, edgecolor="#1b4a80", lw=1.1, zorder=4.1)
        self.edges = [ax.plot([], [], lw=3.4, zorder=5, solid_capstyle="round")[0] for _ in range(2)]
        (self.vertex,) = ax.plot([], [], "o", ms=7, mec="white", mew=1.2, zorder=6)
        (self.origin,) = ax.plot([], [], "o", ms=5, color=INK, mec="white", mew=1.2, zorder=6)
        halo = [withStroke(linewidth=2.4, foreground="white")]
        self.names = [
            ax.text(0, 0, "", ha="center", va="center", fontsize=12, zorder=7, path_effects=halo) for _ in range(2)
        ]

    def draw(self, moment: Moment, cut: Slice, line: tuple[str, Floats], goal: Pose | None) -> None:
        """Everything as it is in one frame; see `cfree.film.frame.View`."""
        pose = moment.pose
        rings = rings_of(self.scene.robot)
        self.region.set_path(path_of(rings_of_geometry(cut.forbidden)))
        self.body.set_path(path_of(map(pose.apply, rings)))
        self.rim.set_path(path_of(map(pose.apply, rings)))
        self.target.set_path(path_of([] if goal is None else map(goal.apply, rings)))
        colour, places = line
        self.tail.set(xdata=places[:, 0], ydata=places[:, 1], color=colour)
        self.origin.set_data([float(pose.x)], [float(pose.y)])
        self._draw_contact(moment)

    def _draw_contact(self, moment: Moment) -> None:
        contact = moment.contact
        for artist in (*self.edges, self.vertex, *self.names):
            artist.set_visible(contact is not None)
        if contact is None:
            return
        marks = self._marks(contact, moment.pose)
        for edge, name, (points, text, place) in zip(self.edges, self.names, marks, strict=True):
            edge.set_visible(len(points) == 2)
            edge.set(xdata=points[:, 0], ydata=points[:, 1], color=TOUCH[contact.kind])
            name.set(text=text, position=place.tolist(), color=TOUCH[contact.kind])
            if len(points) == 1:
                self.vertex.set(xdata=points[:, 0], ydata=points[:, 1], markerfacecolor=TOUCH[contact.kind])

    def _marks(self, contact: Contact, pose: Pose) -> tuple[Mark, Mark]:
        """The robot's feature and the obstacle's."""
        robot, obstacle = self.scene.robot[contact.robot.polygon], shape_of(self.scene, contact.obstacle)
        inwards = -1 if contact.obstacle.polygon == WORKSPACE else 1
        return (
            self._mark(contact.robot, pose.apply(robot.vertices), robot.ring_offsets, "aA", min(self._reach)),
            self._mark(contact.obstacle, obstacle.vertices, obstacle.ring_offsets, "bO", inwards * self._reach[0]),
        )

    def _mark(self, place: Place, vertices: Floats, offsets: Any, letters: str, inwards: float) -> Mark:
        """A feature, with its name written this far inside its shape."""
        if place.end is not None:
            points = vertices[[place.index, place.end]]
            x, y = (points[1] - points[0]) / np.linalg.norm(points[1] - points[0])
            name = rf"$E_{{{edge_number(place)}}}^{letters[1]}$"
            return points, name, points.mean(axis=0) + abs(inwards) * np.array([-y, x])
        k, first, count = place.index, offsets[place.ring], offsets[place.ring + 1] - offsets[place.ring]
        before, point, after = (vertices[first + (k - first + step) % count] for step in (-1, 0, 1))
        u, v = (point - before) / np.linalg.norm(point - before), (after - point) / np.linalg.norm(after - point)
        inside = np.array([-(u + v)[1], (u + v)[0]])  # the interior is on the left
        at = point + 1.5 * inwards * inside / max(float(np.linalg.norm(inside)), 1e-12)
        return point[None], f"${letters[0]}_{{{k}}}$", at


def edge_number(place: Place) -> int:
    """The vertex at which an edge begins; edges of the workspace run against its rings."""
    assert place.end is not None
    return place.end if place.polygon == WORKSPACE else place.index
