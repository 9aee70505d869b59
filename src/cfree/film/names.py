"""Names within shapes, as in the figures: A in the robot, O_1, O_2, ... in the obstacles, if they fit."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from numpy.typing import NDArray

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from cfree.exact.pose import Pose

Floats = NDArray[np.float64]

SIZE = 11.0  # size of letters, in typographic points
ROOM = 0.7  # radius needed within a shape, as a share of the size
MANY = 300  # obstacles named at most


class Names:
    """Artists of the names on axes whose limits and place are final.

    Parameters
    ----------
    ax : matplotlib axes
    obstacles, robot : sequence of shapely geometries
        One for each obstacle, and each part of the robot.
    is_robot_named : bool
    """

    def __init__(
        self, ax: Any, obstacles: Sequence[BaseGeometry], robot: Sequence[BaseGeometry], *, is_robot_named: bool = True
    ) -> None:
        ax.apply_aspect()
        pixels = float(ax.transData.transform((1.0, 0.0))[0] - ax.transData.transform((0.0, 0.0))[0])
        needed = ROOM * SIZE * ax.figure.dpi / 72 / pixels
        style = {"ha": "center", "va": "center", "fontsize": SIZE, "color": "white", "clip_on": True}
        (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
        shapes = [shapely.clip_by_rect(obstacle, x0, y0, x1, y1) for obstacle in obstacles[:MANY]]
        self._obstacles = [
            ax.text(*centre, f"$O_{{{k + 1}}}$", zorder=2.5, **style)
            for k, shape in enumerate(shapes)
            for centre, radius in [_disc(shape)]
            if radius > needed
        ]
        self._boxes = [text.get_window_extent() for text in self._obstacles]
        dot = shapely.Point(0, 0).buffer(0.5 * needed)  # the reference point: the name is beside it
        discs = [_disc(part.difference(dot)) for part in robot]
        self._centre, radius = max(discs, key=lambda disc: disc[1])
        self._robot = ax.text(0, 0, "$A$", zorder=5.5, **style) if is_robot_named and radius > 0.8 * needed else None

    def draw(self, pose: Pose, others: Iterable[Any]) -> None:
        """Write the robot's name inside the robot, and hide all names that other texts cover."""
        taken = [text.get_window_extent() for text in others if text.get_visible()]
        if self._robot is not None:
            (place,) = pose.apply(np.array([self._centre])).tolist()
            self._robot.set_position(place)
            self._robot.set_visible(True)
            box = self._robot.get_window_extent()
            self._robot.set_visible(not any(box.overlaps(other) for other in taken))
            taken.append(box)
        for text, box in zip(self._obstacles, self._boxes, strict=True):
            text.set_visible(not any(box.overlaps(other) for other in taken))


def _disc(shape: BaseGeometry) -> tuple[tuple[float, float], float]:
    """Return centre and radius of a largest disc within a shape, approximately."""
    if shape.area <= 0:
        return (0.0, 0.0), 0.0
    line = shapely.maximum_inscribed_circle(shape, 0.02 * shape.area**0.5)
    (x, y), _ = line.coords
    return (x, y), line.length
