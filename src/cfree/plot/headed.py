"""Figures of answers: the workspace, alone or with room for the configuration space at its right, and a headline."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cfree.exact.pose import Pose
from cfree.plot.boundary import around, new_figure, plain, roomy
from cfree.plot.workspace import Window
from cfree.scene.scene import Scene


def new_picture(window: Window, with_space: bool, *, below: float = 0.65) -> tuple[Figure, Any]:
    """Make a figure with room for a headline, and its axes of the workspace, alone or at the left.

    `below` is the room below the axes, in inches.
    """
    room = 0.95 + below
    shape = (window[3] - window[1]) / (window[2] - window[0])
    if with_space:
        height = float(np.clip(6.0 * shape, 4.2, 6.0)) + room
        figure = new_figure((15, height))
        return figure, figure.add_axes((0.045, below / height, 0.4, 1 - room / height))
    height = float(np.clip(6.6 * shape, 2.5, 8.5)) + room
    figure = new_figure((8.4, height))
    return figure, figure.add_axes((0.09, below / height, 0.78, 1 - room / height))


def headed(figure: Figure, scene: Scene, headline: str, details: str) -> None:
    """Write the headline, after the name of the scene, and details below it."""
    title = f"{plain(scene.name)}: {headline}" if scene.name else headline
    height = float(figure.get_size_inches()[1])
    figure.text(0.5, 1 - 0.32 / height, title, ha="center", va="center", weight="bold", fontsize=14)
    figure.text(0.5, 1 - 0.64 / height, details, ha="center", va="center", fontsize=11)


def window_of(scene: Scene, poses: Iterable[Pose]) -> Window:
    """Return the rectangle around everything in the scene, and the robot in some poses."""
    robots = np.concatenate([q.apply(part.vertices) for q in poses for part in scene.robot])
    boxes: list[Window] = [(*robots.min(axis=0).tolist(), *robots.max(axis=0).tolist())]
    boxes += [body.bounds for body in (*scene.obstacles, *([scene.workspace] if scene.workspace else []))]
    if scene.bounds is not None:
        x0, y0, x1, y1 = map(float, scene.bounds)
        boxes.append((x0, y0, x1, y1))
    return roomy(around(boxes))
