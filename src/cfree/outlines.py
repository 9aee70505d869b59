"""Shapes of the plane as matplotlib draws them, and the robot in its poses."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.path import Path

    from cfree.pose import Pose
    from cfree.scene import Scene

Floats = NDArray[np.float64]
Window = tuple[float, float, float, float]

ROBOT = "#2b6cb0"


def draw_robots(ax: Axes, scene: Scene) -> Iterator[Window]:
    """The robot at start and goal, or else at rest; the rectangles it fills."""
    from matplotlib.patches import PathPatch

    from cfree.pose import Pose

    poses = {name: pose for name, pose in (("start", scene.start), ("goal", scene.goal)) if pose is not None}
    for name, pose in (poses or {"at rest": Pose(0, 0)}).items():
        rings = [pose.apply(ring) for ring in rings_of(scene.robot)]
        faint = name != "start"
        ax.add_patch(PathPatch(path_of(rings), facecolor=ROBOT, alpha=0.2 if faint else 0.85, linewidth=0))
        ax.add_patch(PathPatch(path_of(rings), fill=False, edgecolor=ROBOT, linewidth=1, ls="--" if faint else "-"))
        _mark(ax, pose, name, rings)
        points = np.concatenate(rings)
        yield (*points.min(axis=0).tolist(), *points.max(axis=0).tolist())


def _mark(ax: Axes, pose: Pose, name: str, rings: list[Floats]) -> None:
    """The reference point, the robot's first axis, and a name below."""
    from matplotlib.patheffects import withStroke

    points = np.concatenate(rings)
    x, y = float(pose.x), float(pose.y)
    dx, dy = (pose.apply([0.7 * np.hypot(*(points - (x, y)).T).max(), 0.0]) - (x, y)).tolist()
    halo = [withStroke(linewidth=2.5, foreground="white")]
    arrow = {"arrowstyle": "->", "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", xy=(x + dx, y + dy), xytext=(x, y), arrowprops=arrow)
    ax.plot(x, y, "o", color="black", markersize=4, path_effects=halo)
    below = float(points[:, 1].min())
    ax.annotate(name, (x, below), (0, -2), textcoords="offset points", ha="center", va="top", path_effects=halo)


def rings_of(polygons: Iterable[Any]) -> list[Floats]:
    """Rings of polygons, the interior on the left."""
    return [p.vertices[i:j] for p in polygons for i, j in pairwise(p.ring_offsets)]


def rings_of_geometry(geometry: Any) -> list[Floats]:
    """Rings of a shapely geometry, the interior on the left."""
    import shapely

    parts = shapely.get_parts(shapely.orient_polygons(geometry))
    rings = [ring for part in parts for ring in shapely.get_rings(part)]
    return [shapely.get_coordinates(ring)[:-1] for ring in rings]


def path_of(rings: Iterable[Floats]) -> Path:
    """One path of closed rings: those that run clockwise are holes.

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
