"""Shapes of the plane for matplotlib: the robot's surroundings, and the robot in a pose."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cfree.palette import GHOST, GREY, OBSTACLE, OBSTACLE_RIM, ROBOT

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.path import Path

    from cfree.exact.pose import Pose
    from cfree.forbidden.slice import Slice
    from cfree.scene.scene import Scene

Floats = NDArray[np.float64]
Window = tuple[float, float, float, float]


def draw_surroundings(ax: Axes, scene: Scene, *, frame: bool = True) -> list[Window]:
    """Draw obstacles, workspace, and the frame of the bounds; return the rectangles they fill."""
    from matplotlib.patches import PathPatch, Rectangle

    boxes: list[Window] = [polygon.bounds for polygon in scene.obstacles]
    if scene.workspace is not None:
        ax.set_facecolor(OBSTACLE)
        inside = path_of(rings_of([scene.workspace]))
        ax.add_patch(PathPatch(inside, facecolor="white", edgecolor=OBSTACLE, linewidth=0.8, zorder=0.5))
        boxes.append(scene.workspace.bounds)
    obstacles = path_of(rings_of(scene.obstacles))
    ax.add_patch(PathPatch(obstacles, facecolor=OBSTACLE, edgecolor=OBSTACLE_RIM, linewidth=0.5, label="obstacles"))
    if frame and scene.bounds is not None:
        x0, y0, x1, y1 = map(float, scene.bounds)
        ax.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, edgecolor=GREY, linestyle=(0, (5, 3))))
        boxes.append((x0, y0, x1, y1))
    return boxes


def draw_robot(ax: Axes, scene: Scene, pose: Pose, *, faint: bool, mark: bool = True) -> Window:
    """Draw the robot in a pose; with `mark` its reference point and its first axis. Return the rectangle it fills."""
    from matplotlib.patches import PathPatch

    rings = [pose.apply(ring) for ring in rings_of(scene.robot)]
    fill, style = (GHOST, "--") if faint else (ROBOT, "-")
    shape = path_of(rings)
    ax.add_patch(PathPatch(shape, facecolor=fill, alpha=0.85, linewidth=0, zorder=3))
    ax.add_patch(PathPatch(shape, fill=False, edgecolor=ROBOT, linewidth=1.2, linestyle=style, zorder=3))
    if mark:
        _mark(ax, pose, rings)
    points = np.concatenate(rings)
    return (*points.min(axis=0).tolist(), *points.max(axis=0).tolist())


def _mark(ax: Axes, pose: Pose, rings: list[Floats]) -> None:
    """Draw the reference point, and the robot's first axis."""
    from matplotlib.patheffects import withStroke

    points = np.concatenate(rings)
    x, y = float(pose.x), float(pose.y)
    dx, dy = (pose.apply([0.7 * np.hypot(*(points - (x, y)).T).max(), 0.0]) - (x, y)).tolist()
    halo = [withStroke(linewidth=2.5, foreground="white")]
    arrow = {"arrowstyle": "->", "shrinkA": 0, "shrinkB": 0, "zorder": 7}
    ax.annotate("", xy=(x + dx, y + dy), xytext=(x, y), arrowprops=arrow, zorder=7)
    ax.plot(x, y, "o", color="black", markersize=4, path_effects=halo, zorder=7)


def roomiest(cut: Slice, window: Window) -> Pose | None:
    """Return the pose of a slice with most room around its reference point in a window; None if none is free."""
    import shapely

    from cfree.exact.pose import Pose

    free = shapely.box(*window).difference(cut.forbidden)
    if free.area <= 0:
        return None
    x, y = shapely.maximum_inscribed_circle(free, 1e-2 * math.sqrt(free.area)).coords[0]
    return Pose(x, y, cut.theta)


def rings_of(polygons: Iterable[Any]) -> list[Floats]:
    """Return the rings of polygons, the interior on the left."""
    return [ring for polygon in polygons for ring in polygon.rings]


def rings_of_geometry(geometry: Any) -> list[Floats]:
    """Return the rings of a shapely geometry's polygons, the interior on the left."""
    import shapely

    parts = [part for part in shapely.get_parts(geometry) if part.geom_type == "Polygon" and part.area > 0]
    rings = [ring for part in shapely.orient_polygons(parts) for ring in shapely.get_rings(part)]
    return [shapely.get_coordinates(ring)[:-1] for ring in rings]


def path_of(rings: Iterable[Floats]) -> Path:
    """Return one path of closed rings: clockwise rings are holes.

    Examples
    --------
    >>> len(path_of([np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])]))
    4
    """
    from matplotlib.path import Path

    points, codes = [np.empty((0, 2))], [np.empty(0, dtype=np.uint8)]
    for ring in rings:
        points.extend((ring, ring[:1]))
        code = np.full(len(ring) + 1, Path.LINETO, dtype=np.uint8)
        code[0], code[-1] = Path.MOVETO, Path.CLOSEPOLY
        codes.append(code)
    return Path(np.concatenate(points), np.concatenate(codes))
