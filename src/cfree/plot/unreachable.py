"""Pictures of a car without reverse gear that does not reach its goal: all places of its axle point in the boxes."""

from __future__ import annotations

import zlib
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cfree.palette import AHEAD, BACK, paler
from cfree.planning.unreachable import Unreachable
from cfree.plot.boundary import set_window
from cfree.plot.gears import Wheels, draw_vehicle
from cfree.plot.headed import headed, new_picture, window_of
from cfree.plot.labels import BODY, Labels
from cfree.plot.workspace import draw_surroundings
from cfree.scene.scene import Scene
from cfree.scene.smooth import smooth


def picture_of_unreachable(answer: Unreachable, scene: Scene) -> Figure:
    """Draw start and goal of a car, and the squares below all boxes of the proof."""
    scene = smooth(scene)
    ends = {"start": answer.start, "goal": answer.goal}
    window = window_of(scene, ends.values())
    figure, ax = new_picture(window, False)
    draw_surroundings(ax, scene)
    colour, meaning = (AHEAD, "reached from the start") if answer.at == "start" else (BACK, "leading to the goal")
    _draw_boxes(ax, answer, paler(colour, 0.6))
    wheels = Wheels.of(scene, answer.vehicle)
    for name, pose in ends.items():
        draw_vehicle(ax, scene, pose, wheels, 0.0, faint=name == "goal")
    set_window(ax, window, scene.units)
    labels = Labels(ax, scene)
    labels.avoid_robot(scene, ends.values(), BODY)
    for name, pose in ends.items():
        labels.name_robot(scene, pose, name)
    labels.name_bounds(scene)
    headed(figure, scene, "unreachable without reverse gear, proved", f"shaded: all places of the axle point {meaning}")
    return figure


def _draw_boxes(ax: Any, answer: Unreachable, colour: str) -> None:
    """Shade the squares of the plane that have a box at some heading."""
    from matplotlib.colors import ListedColormap

    grid = answer.grid
    bits = np.frombuffer(zlib.decompress(answer.boxes), dtype=np.uint8)
    boxes = np.unpackbits(bits, count=grid.count, bitorder="little").reshape(grid.slices, grid.rows, grid.columns)
    squares = boxes.any(axis=0)
    (x, y), side = map(float, grid.corner), float(grid.side)
    ax.imshow(
        np.ma.masked_equal(squares, 0), cmap=ListedColormap([colour]), origin="lower", interpolation="nearest",
        extent=(x, x + side * grid.columns, y, y + side * grid.rows), zorder=1.5, label="boxes",
    )  # fmt: skip
