"""Pictures of the record of reading: lost and guessed things over the shapes that were read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from cfree.formats.shapes import ROLES, Shapes
from cfree.palette import GHOST, GUESSED, INK, LOST, OBSTACLE, OBSTACLE_RIM, PATH, ROBOT
from cfree.plot.boundary import around, legend_below, new_axes, plain, roomy, set_window
from cfree.plot.workspace import Window, path_of, rings_of
from cfree.polygons.polygon import Polygon
from cfree.scene.reading import Item, Note
from cfree.scene.scene import AnyShape, box_of, size_of
from cfree.scene.smooth import EDGES

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LEGEND = {"lost": "lost", "hidden": "lost", "assumption": "assumed away", "guess": "guessed", "joined": "joined"}
"""Names of what is drawn, by the kind of the notes."""


def plot_shapes(shapes: Shapes) -> Axes:
    """Draw the shapes of a file as they are in it, also those in no scene, and the record of reading."""
    from matplotlib.patches import PathPatch

    ax = new_axes((7, 6))
    faces = {"robot": ROBOT, "obstacle": OBSTACLE, "workspace": "white"}
    boxes: list[Window] = []
    for role in (*reversed(ROLES), "part"):
        parts = [shape.polygon for shape in shapes.of(role)]  # type: ignore[arg-type]
        if not parts:
            continue
        boxes += map(box_of, parts)
        rings = path_of(rings_of(polygon for part in parts for polygon in _straight(part)))
        rim = OBSTACLE if role == "workspace" else OBSTACLE_RIM
        order = {"workspace": 0.5, "robot": 3}.get(role, 1)
        face = faces.get(role, GHOST)
        ax.add_patch(PathPatch(rings, facecolor=face, edgecolor=rim, linewidth=0.6, zorder=order))
    boxes += draw_record(ax, shapes.reading)
    if boxes:
        set_window(ax, roomy(around(boxes)), str(shapes.settings.get("units", "")))
        _explain(ax)
    ax.set_title(plain(repr(shapes).strip("<>").partition(";")[0]), color=INK)
    return ax


def _straight(shape: AnyShape) -> Sequence[Polygon]:
    """Return polygons that look like a shape."""
    return (shape,) if isinstance(shape, Polygon) else shape.outer(max(size_of(shape) / EDGES, shape.least_error))


def with_record(ax: Axes, notes: Sequence[Note], units: str) -> Axes:
    """Draw a record over the picture of a scene, whose window becomes large enough for it."""
    if boxes := list(draw_record(ax, notes)):
        (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
        if around([(x0, y0, x1, y1), *boxes]) != (x0, y0, x1, y1):
            set_window(ax, around([(x0, y0, x1, y1), *boxes]), units)
        _explain(ax)
    return ax


def _explain(ax: Axes) -> None:
    """Add a legend of what the record has drawn."""
    handles, names = ax.get_legend_handles_labels()
    shown = {name: handle for handle, name in zip(handles, names, strict=True)}
    if used := [shown[name] for name in dict.fromkeys(LEGEND.values()) if name in shown]:
        legend_below(ax, ncols=4, handles=used)


def draw_record(ax: Axes, notes: Iterable[Note]) -> list[Window]:
    """Draw the things of notes at their places; return the rectangles around them."""
    boxes, named = [], set[str]()
    for note in notes:
        name = LEGEND.get(note.kind)
        for item in note.items if name else ():
            for artist in _artists(note.kind, item):
                ax.add_artist(artist)
                artist.set_label("" if name in named else name)
                named.add(str(name))
            points = np.array([*item.points, *([item.at] if item.at else [])])
            if len(points):
                boxes.append((*points.min(axis=0).tolist(), *points.max(axis=0).tolist()))
    return boxes


def _artists(kind: str, item: Item) -> Iterator[Any]:
    """Yield the artists for one thing: its line or outline, or a mark at its place."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Polygon as Outline

    colour = {"guess": GUESSED, "joined": PATH}.get(kind, LOST)
    is_closed = len(item.points) > 3 and item.points[0] == item.points[-1]
    if kind == "joined":
        if place := item.at or next(iter(item.points), None):
            yield Line2D([place[0]], [place[1]], color=colour, marker="o", markersize=4, linestyle="", zorder=9)
    elif is_closed and kind == "guess":
        yield Outline(item.points, fill=False, edgecolor=colour, hatch="////", linewidth=1.2, zorder=8)
    elif is_closed and kind == "assumption":
        yield Outline(item.points, facecolor=colour, edgecolor=colour, linewidth=1.2, zorder=8)
    elif len(item.points) > 1:
        yield Line2D(*np.transpose(item.points), color=colour, linewidth=1.6, zorder=8)
    elif place := item.at or next(iter(item.points), None):
        marker = "s" if kind == "guess" else "." if kind == "assumption" else "x"
        yield Line2D([place[0]], [place[1]], color=colour, marker=marker, markersize=6, linestyle="", zorder=8)
