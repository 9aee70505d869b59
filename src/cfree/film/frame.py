"""One frame: the workspace at the left, the configuration space at the right, and what is touched in words."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from cfree.exact.pose import Pose
from cfree.film.box import INK
from cfree.film.moves import Moment
from cfree.film.plane import TOUCH, Plane, edge_number
from cfree.film.space import FREE, SOLID, Space
from cfree.forbidden.kinds import COLOURS, PatchKind
from cfree.forbidden.patch import Contact
from cfree.plot.boundary import extent, plain, with_unit
from cfree.plot.pieces import Colours

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]

GREY, NOTHING = "#6b7280", "#b9bec8"
INCHES = 7.2  # height of the figure; type is as large as in a picture of this height
MONO = "DejaVu Sans Mono"


@dataclass(frozen=True)
class View:
    """All that changes from frame to frame.

    Attributes
    ----------
    title, note : str
    moment : Moment
    azimuth : float, radians
    shown : (parts, 2) float64, degrees
        Between which angles each part of the boundary is drawn.
    ghost : float
        Opacity of what is above the plane.
    lines : sequence of (colour, (n, 3) float64)
        Motions so far, theta in degrees, the present one last.
    goal : Pose or None
        Where the robot goes, to be outlined.
    """

    title: str
    note: str
    moment: Moment
    azimuth: float
    shown: Floats
    ghost: float
    lines: Sequence[tuple[str, Floats]]
    goal: Pose | None


class Stage:
    """Draws the frames of one scene.

    Parameters
    ----------
    boundary : Boundary
    size : (int, int)
        Width and height in pixels.
    """

    def __init__(self, boundary: Boundary, size: tuple[int, int]) -> None:
        self.boundary = boundary
        width, height = size
        figure = Figure(figsize=(INCHES * width / height, INCHES), dpi=height / INCHES, facecolor="white")
        self.canvas: Any = FigureCanvasAgg(figure)
        window, units = extent(boundary), boundary.scene.units
        names = with_unit("x", units), with_unit("y", units)
        self.plane = Plane(figure, boundary.scene, window, names)
        self.space = Space(figure, boundary, window, names)
        self.title = figure.text(0.03, 0.945, "", fontsize=18, weight="bold", color=INK, va="center")
        self.note = figure.text(0.03, 0.89, "", fontsize=13, color=GREY, va="center")
        self.pose = figure.text(0.985, 0.945, "", fontsize=11, color=INK, va="center", ha="right", family=MONO)
        self.dot = figure.text(0.03, 0.052, "●", fontsize=17, va="center")
        self.caption = figure.text(0.052, 0.054, "", fontsize=14, color=INK, va="center")
        _legend(figure)

    def draw(self, view: View) -> Image:
        """The frame as (height, width, 3) bytes."""
        pose, contact = view.moment.pose, view.moment.contact
        cut = self.boundary.slice(pose.theta)
        self.plane.draw(view.moment, cut, view.lines[-1], view.goal)
        self.space.draw(pose, cut, view.azimuth, view.shown, view.ghost, view.lines)
        self.title.set_text(view.title)
        self.note.set_text(view.note)
        self.caption.set_text(caption(contact))
        self.dot.set_color(NOTHING if contact is None else TOUCH[contact.kind])
        numbers = f"x {float(pose.x):8.3f}   y {float(pose.y):8.3f}   θ {math.degrees(pose.theta):6.1f}°"
        self.pose.set_text(numbers.replace("-", "−"))
        self.canvas.draw()
        return np.asarray(self.canvas.buffer_rgba())[..., :3].copy()


def caption(contact: Contact | None) -> str:
    """A contact in words.

    Examples
    --------
    >>> from cfree.forbidden.patch import Place
    >>> caption(Contact("v-e", Place(0, "robot", 0, 2), Place(0, "kite", 0, 3, 0)))
    'v-e contact: vertex $a_{2}$ on edge $E_{3}^O$ of kite'
    >>> caption(None)
    'no contact'
    """
    if contact is None:
        return "no contact"
    a, b = contact.robot, contact.obstacle
    first = f"vertex $a_{{{a.index}}}$" if a.end is None else f"edge $E_{{{edge_number(a)}}}^A$"
    second = f"vertex $b_{{{b.index}}}$" if b.end is None else f"edge $E_{{{edge_number(b)}}}^O$"
    return f"{contact.kind} contact: {first} on {second} of {plain(b.name)}"


def _legend(figure: Figure) -> None:
    handles = [
        Patch(color=COLOURS[PatchKind.VERTEX_EDGE], label="v-e patch"),
        Patch(color=COLOURS[PatchKind.EDGE_VERTEX], label="e-v patch"),
        Line2D([], [], color=Colours.helix, lw=2.5, label="v-v helix"),
        Line2D([], [], color=Colours.edge_edge, lw=2.5, label="e-e line"),
        Patch(facecolor=SOLID, label="forbidden"),
        Patch(facecolor=FREE, label="free"),
    ]
    figure.legend(
        handles=handles, loc="center right", bbox_to_anchor=(0.992, 0.054), ncols=6, frameon=False,
        fontsize=9.5, handlelength=1.2, columnspacing=1.1, handletextpad=0.5,
    )  # fmt: skip
