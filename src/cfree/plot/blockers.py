"""Blocking obstacles: each single obstacle whose removal opens a path, and that path."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from cfree.analysis.blockers import Blocker
from cfree.arguments import checked
from cfree.palette import BARRIER
from cfree.paths.path import Path
from cfree.paths.preferences import NONE, Preferences
from cfree.plot.boundary import new_figure, plain
from cfree.plot.path import Track, draw_track, statement
from cfree.plot.workspace import path_of, rings_of
from cfree.polygons.polygon import Polygon
from cfree.scene.naming import numbered, placed
from cfree.scene.scene import AnyShape, Scene, box_of, largest_of, polygons_for
from cfree.scene.smooth import EDGES, smooth

ACROSS = 3  # panels beside each other


@checked
def plot_blockers(found: Sequence[Blocker], scene: Scene, *, preferences: Preferences | None = None) -> Figure:
    """Draw each single obstacle whose removal opens a path, hatched, and that path.

    Parameters
    ----------
    found : sequence of Blocker
        At least one blocker, from `cfree.blockers`.
    scene : Scene
        The scene with all obstacles.
    preferences : Preferences, optional
        Motions penalised by these preferences are marked.

    Returns
    -------
    matplotlib figure

    Raises
    ------
    ValueError
        If there is no blocker.

    Examples
    --------
    >>> from cfree import Scene, blockers
    >>> wall = [(2, -9), (3, -9), (3, 9), (2, 9)]
    >>> scene = Scene([(0, 0), (1, 0), (1, 1), (0, 1)], [wall], bounds=(-5, -5, 5, 5))
    >>> [ax.get_title() for ax in plot_blockers(blockers(scene, (0, 0, 0), (4, 0, 0)), scene).axes]
    ['without obstacle 0, 1 x 18 at (2.5, 0)\\n1 motion, length 4, turning 0°']
    """
    from matplotlib.patches import PathPatch

    if not found:
        raise ValueError("no obstacle opens a way: there is nothing to draw")
    across, down = min(ACROSS, len(found)), math.ceil(len(found) / ACROSS)
    tracks = [Track.of(blocker.path, _looks(blocker.path, scene)) for blocker in found]
    x0, y0, x1, y1 = tracks[0].window
    width, height = 7 * across, down * float(np.clip(1.6 + 6 * (y1 - y0) / (x1 - x0), 3.3, 9.3))
    figure = new_figure((width, height))
    figure.subplots_adjust(
        left=0.8 / width, right=1 - 0.9 / width, bottom=0.7 / height, top=1 - 0.7 / height,
        wspace=1.6 / (width / across - 1.6), hspace=1.4 / (height / down - 1.4),
    )  # fmt: skip
    for k, (blocker, track) in enumerate(zip(found, tracks, strict=True)):
        ax = figure.add_subplot(down, across, k + 1)
        labels = draw_track(ax, track, preferences or NONE)
        gone = path_of(rings_of(_polygons(scene, scene.obstacles[blocker.obstacle])))
        ax.add_patch(
            PathPatch(gone, fill=False, edgecolor=BARRIER, hatch="///", linewidth=1.4, zorder=2.6, label="gone")
        )
        name = plain(numbered(scene, blocker.obstacle))
        labels.point_at(box_of(scene.obstacles[blocker.obstacle]), name, BARRIER)
        ax.set_title(f"without {plain(placed(scene, blocker.obstacle))}\n{statement(track)}", fontsize=10)
    return figure


def _looks(path: Path, scene: Scene) -> Scene:
    """Return the scene of a path; polygons that look round replace its round shapes."""
    return smooth(path.curved or path.scene or scene)


def _polygons(scene: Scene, shape: AnyShape) -> tuple[Polygon, ...]:
    return polygons_for(shape, largest_of(scene) / EDGES, True)
