"""The pictures of docs/comparison.md: times beside verdicts, and what slices do not see."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch

import cfree
from cfree.palette import BARRIER, GREY, INK, LETTERS, MARK, PATH, ROBOT
from cfree.plot.workspace import draw_robot, draw_surroundings, path_of, rings_of

PINS = 45
MARKS = {  # of a verdict: what draws it, and its words
    "sure": {"marker": "o", "color": ROBOT, "label": "right and sure"},
    "right": {"marker": "o", "color": ROBOT, "fillstyle": "none", "label": "right"},
    "clips": {"marker": "X", "color": MARK, "label": "path clips"},
    "missed": {"marker": "v", "color": BARRIER, "label": "path missed"},
    "false": {"marker": "^", "color": PATH, "label": "path where none is"},
    "nothing": {"marker": "_", "color": GREY, "label": "no answer in 5 s"},
}


def needle() -> cfree.Scene:
    """Made to mislead: a needle on an axle with some play, and around it 45 pins, halfway between 45 orientations."""
    angles = 2 * np.pi * (np.arange(PINS) + 0.5) / PINS
    square = 0.05 * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    pins = [square + 4.8 * np.array([math.cos(angle), math.sin(angle)]) for angle in angles]
    body = [(-0.5, -0.05), (5, -0.05), (5, 0.05), (-0.5, 0.05)]
    return cfree.Scene(body, pins, start=(0, 0, 0), goal=(0, 0, "120deg"), bounds=(-0.05, -0.05, 0.05, 0.05))


def draw_times(dots: dict[str, list[tuple[str, float]]]) -> Figure:
    """Seconds of each answer, a row a way, in the colours of verdicts."""
    import matplotlib

    with matplotlib.rc_context(LETTERS | {"font.size": 11}):
        figure = Figure(figsize=(9, 6), layout="constrained")
        ax = figure.subplots()
        for row, pairs in enumerate(dots.values()):
            for k, (verdict, seconds) in enumerate(pairs):
                height = row + 0.5 * (k / max(1, len(pairs) - 1) - 0.5)
                ax.plot(seconds, height, linestyle="none", markersize=5, alpha=0.85, **MARKS[verdict] | {"label": None})
        for mark in MARKS.values():
            ax.plot([], [], linestyle="none", **mark)
        ax.set(xscale="log", xlabel="processor seconds", ylim=(len(dots) - 0.4, -0.6))
        ax.set_yticks(range(len(dots)), list(dots))
        ax.grid(axis="x", color=GREY, alpha=0.25, linewidth=0.6)
        for edge in (1.5, 3.5, 6.5, 9.5):
            ax.axhline(edge, color=GREY, alpha=0.4, linewidth=0.6)
        ax.spines[["top", "right"]].set_visible(False)
        figure.legend(loc="outside upper center", ncols=6, handletextpad=0.1, columnspacing=1.0)
    return figure


def draw_slices(throat: cfree.Scene) -> Figure:
    """Left: what turns from slice to slice jump over. Right: a way at an orientation that has no slice."""
    import matplotlib

    with matplotlib.rc_context(LETTERS | {"font.size": 12}):
        figure = Figure(figsize=(11, 4.6), layout="constrained")
        left, right = figure.subplots(1, 2, width_ratios=(1, 1.15))
        scene, step = needle(), 2 * math.pi / PINS
        draw_surroundings(left, scene, frame=False)
        for theta in (0, step):
            draw_robot(left, scene, cfree.Pose(0, 0, theta), faint=True)
        draw_overlapping(left, scene, cfree.Pose(0, 0, step / 2))
        left.set(xlim=(3.9, 5.2), ylim=(-0.35, 1.1), title="two slices overlap: a path where none is")
        path = cfree.plan(throat)
        assert isinstance(path, cfree.Path)
        walls = [np.mean(polygon.vertices, axis=0) for polygon in throat.obstacles[:2]]
        middle, sampled = np.mean(walls, axis=0), path.sample(0.01)
        at = np.hypot(*(sampled.xy - middle).T).argmin()
        (x, y), theta = sampled.xy[at], sampled.theta[at]
        draw_surroundings(right, throat)
        right.plot(*sampled.xy.T, color=PATH, linewidth=1.2, zorder=4)
        draw_robot(right, throat, cfree.Pose(x, y, theta), faint=True)
        for k in (math.floor(theta / step), math.ceil(theta / step)):
            draw_overlapping(right, throat, cfree.Pose(x, y, k * step))
        right.set(xlim=(x - 1.6, x + 1.6), ylim=(y - 1.5, y + 1.5), title="no slice at this orientation: a path missed")
        for ax in (left, right):
            ax.set(aspect="equal", xticks=[], yticks=[])
    return figure


def draw_overlapping(ax: Any, scene: cfree.Scene, pose: cfree.Pose) -> None:
    """The outline of the robot in a pose, and what it has in common with obstacles."""
    rings = [pose.apply(ring) for ring in rings_of(scene.robot)]
    ax.add_patch(PathPatch(path_of(rings), fill=False, edgecolor=INK, linewidth=1, linestyle=(0, (4, 3)), zorder=5))
    body = shapely.union_all([shapely.Polygon(ring) for ring in rings])
    obstacles = [shapely.Polygon(polygon.rings[0], polygon.rings[1:]) for polygon in scene.obstacles]
    for part in shapely.get_parts(shapely.intersection(body, shapely.union_all(obstacles))):
        if isinstance(part, shapely.Polygon):
            ring = path_of([np.array(part.exterior.coords)[:-1]])
            ax.add_patch(PathPatch(ring, facecolor=BARRIER, linewidth=0, zorder=6))
