"""One frame: the workspace at the left, the configuration space at the right, and the contact in words."""

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
from cfree.film.contact_motions import Moment, Touch
from cfree.film.plane import TOUCH, Plane, feature_number, obstacle_name, whole
from cfree.film.space import Space
from cfree.forbidden.kinds import COLOURS, KINDS
from cfree.forbidden.patch import Contact, Place
from cfree.palette import EDGE_EDGE, FORBIDDEN, FREE, GREY, HELIX, INK, RIM
from cfree.plot.boundary import contact_kinds, extent, roomy, with_unit
from cfree.plot.gears import Gears

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary
    from cfree.plot.workspace import Window
    from cfree.scene.scene import Scene

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]

TRAIL = 4.0  # seconds until the line of a motion has faded
DOTS, INCHES = 80, (4.5, 7.2)  # dots per inch, and limits of the height: letters stay large enough to read
MONO = "DejaVu Sans Mono"
SHORT = 4  # letters at most of a unit that stands at the axes
ROOMY = 11.0  # inches of width from which on the legend is one row


@dataclass(frozen=True)
class View:
    """The state of one frame: all that changes from frame to frame.

    Attributes
    ----------
    title, note : str
    recent : sequence of Moment
        The moments of the trail, the present one last.
    azimuth : float, radians
    shown : (parts, 2) float64, degrees
        The range of angles in which each part of the boundary is drawn.
    ghost : float
        Opacity of everything above the plane.
    lines : sequence of (colour, (n, 3) float64)
        Motions so far, theta in degrees, the present one last.
    goal : Pose or None
        The pose the robot moves to, drawn as an outline.
    stays : (parts,) bool
        True for parts that have been swept: these are visible above the plane as well.
    driven : (Gears, float), optional
        The path that a vehicle drives, and the robot's travel on it.
    surface : str
        Describes a surface that is not the boundary's, in place of the contact.
    """

    title: str
    note: str
    recent: Sequence[Moment]
    azimuth: float
    shown: Floats
    ghost: float
    lines: Sequence[tuple[str, Floats]]
    goal: Pose | None
    stays: NDArray[np.bool_]
    driven: tuple[Gears, float] | None = None
    surface: str = ""


def new_frame(size: tuple[int, int]) -> tuple[Figure, float]:
    """Return a figure of this size in pixels, with a canvas, and its height in inches."""
    width, height = size
    inches = float(np.clip(height / DOTS, *INCHES))
    figure = Figure(figsize=(inches * width / height, inches), dpi=height / inches, facecolor="white")
    FigureCanvasAgg(figure)
    return figure, inches


def image_of(figure: Figure) -> Image:
    """Draw the figure as (height, width, 3) bytes."""
    canvas: Any = figure.canvas
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()


class Stage:
    """The film set of one scene: draws its frames.

    Parameters
    ----------
    boundary : Boundary
    size : (int, int)
        Width and height in pixels.
    fps : int
        Frames a second.
    surface : Boundary, optional
        The patches shown, by default all of the boundary.
    window : four floats, optional
        x0, y0, x1, y1: the rectangle shown, by default everything.
    scene : Scene, optional
        The scene drawn at the left, by default the boundary's.
    """

    def __init__(
        self, boundary: Boundary, size: tuple[int, int], fps: int, surface: Boundary | None = None,
        window: Window | None = None, scene: Scene | None = None,
    ) -> None:  # fmt: skip
        self.boundary, trail = boundary, TRAIL * fps
        self.figure, height = new_frame(size)
        figure, width = self.figure, self.figure.get_figwidth()
        view = roomy(window or whole(boundary.scene, _with_ends(boundary)))
        window, names = window or _with_ends(boundary), axis_names(boundary.scene)
        low, top = 1.25 / height, 1 - 0.95 / height
        place = 0.65 / width, low, 0.43 - 0.65 / width, top - low
        self.plane = Plane(figure, place, scene or boundary.scene, view, names, trail)
        place = 0.45, 0.72 / height, 0.54, 1 - 1.28 / height
        self.space = Space(figure, place, boundary, window, names, trail, surface)
        left = 0.2 / width
        text: Any = {"color": INK, "va": "center"}
        self.title = figure.text(left, 1 - 0.3 / height, "", fontsize=16, weight="bold", **text)
        self.note = figure.text(left, 1 - 0.63 / height, "", fontsize=12, **text | {"color": GREY})
        self.pose = figure.text(1 - left, 1 - 0.63 / height, "", fontsize=10.5, ha="right", family=MONO, **text)
        self.dot = figure.text(left, 0.33 / height, "●", fontsize=16, va="center")
        self.caption = figure.text(left + 0.25 / width, 0.34 / height, "", fontsize=12.5, **text)
        legend(figure, boundary, 0.34 / height, 7 if width > ROOMY else 3, {"forbidden": FORBIDDEN, "free": FREE})

    def draw(self, view: View) -> Image:
        """Draw the frame as (height, width, 3) bytes."""
        pose, contact = view.recent[-1].pose, view.recent[-1].contact
        cut = self.boundary.slice(pose.theta)
        self.plane.draw(view.recent, cut, view.lines[-1], view.goal, view.driven)
        self.space.draw(pose, cut, view.azimuth, view.shown, view.ghost, view.lines, view.stays)
        self.title.set_text(view.title)
        word, colour = (view.note, GREY) if view.driven is None else view.driven[0].word(view.driven[1])
        self.note.set(text=word, color=colour)
        self.caption.set_text(view.surface or caption(contact, view.recent[-1].touch))
        self.dot.set_color(RIM if contact is None else TOUCH[contact.kind])
        self.pose.set_text(numbers(pose))
        return image_of(self.figure)


def _with_ends(boundary: Boundary) -> Window:
    """Return the rectangle around a boundary, and start and goal of its scene."""
    ends = [(float(pose.x), float(pose.y)) for pose in (boundary.scene.start, boundary.scene.goal) if pose is not None]
    x0, y0, x1, y1 = extent(boundary)
    xs, ys = zip((x0, y0), (x1, y1), *ends, strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def axis_names(scene: Scene) -> tuple[str, str]:
    """Name the axes x and y, with the unit if it is an abbreviation."""
    units = scene.units if len(scene.units) <= SHORT else ""
    return with_unit("x", units), with_unit("y", units)


def numbers(pose: Pose) -> str:
    """Write a pose in figures of constant width."""
    x, y = (f"{value:#.4g}".rjust(8) for value in (float(pose.x), float(pose.y)))
    return f"x {x}  y {y}  θ {math.degrees(pose.theta):5.1f}°".replace("-", "−")


def caption(contact: Contact | None, touch: Touch | None = None) -> str:
    """Describe a contact in words; numbers count from 1, as in the figures.

    Examples
    --------
    >>> from cfree.forbidden.patch import Place
    >>> caption(Contact("v-e", Place(0, "robot", 0, 2), Place(0, "kite", 0, 3, 0)))
    'v-e contact: vertex $a_{3}$ on edge $E_{4}$ of $O_{1}$'
    >>> caption(None)
    'no contact'
    """
    if contact is None:
        return "no contact"
    robot, obstacle = (None, None) if touch is None else (touch.robot, touch.obstacle)
    first, second = _named(contact.robot, "a", robot), _named(contact.obstacle, "b", obstacle)
    return f"{contact.kind} contact: {first} on {second} of {obstacle_name(contact.obstacle)}"


def _named(place: Place, letter: str, points: Floats | None) -> str:
    """Name a feature: an edge, or a vertex, which is an arc if it has many points."""
    number = feature_number(place)
    if place.end is not None:
        return "an edge" if number is None else f"edge $E_{{{number}}}{'^A' if letter == 'a' else ''}$"
    return f"{'arc' if points is not None and len(points) > 1 else 'vertex'} ${letter}_{{{number}}}$"


def legend(figure: Figure, boundary: Boundary, y: float, columns: int, regions: dict[str, str]) -> None:
    """Add a legend of the colours of contacts in a boundary, and of the regions' colours given."""
    handles = [
        *(Patch(color=COLOURS[kind], label=f"{KINDS[kind]} patch") for kind in contact_kinds(boundary)),
        Line2D([], [], color=HELIX, lw=2.5, label="helix" if boundary.scene.curved else "v-v helix"),
        Line2D([], [], color=EDGE_EDGE, lw=2.5, label="e-e line"),
        *(Patch(facecolor=colour, label=name) for name, colour in regions.items()),
    ]
    figure.legend(
        handles=handles, loc="center right", bbox_to_anchor=(0.995, y), ncols=columns, frameon=False,
        fontsize=9.5, handlelength=1.2, columnspacing=1.1, handletextpad=0.5, labelspacing=0.3,
    )  # fmt: skip
