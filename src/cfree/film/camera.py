"""The camera of a film: it sees the box around the configuration space from above, at azimuths in one quadrant."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cfree.palette import VIEW
from cfree.plot.workspace import Window

Floats = NDArray[np.float64]

HEIGHT = 0.82  # height of the box, its longer side being 1
ELEVATION, DISTANCE = math.radians(VIEW[0]), 4.2
REACH = 0.7  # depths differ from the distance by at most this
AZIMUTHS = math.radians(-78), math.radians(-12)  # within one quadrant the axes keep their places


class Camera:
    """Projection of the box to a panel, in pixels from its lower left corner.

    Parameters
    ----------
    window : four floats
        x0, y0, x1, y1 of the box.
    width, height : float
        Size of the panel, in pixels.
    azimuth : float, radians
    azimuths : (float, float)
        Range in which the box keeps its scale.

    Attributes
    ----------
    span : (float, float)
        Nearest and farthest depth of the box.
    """

    span = DISTANCE - REACH, DISTANCE + REACH

    def __init__(
        self, window: Window, width: float, height: float, azimuth: float, azimuths: tuple[float, float] = AZIMUTHS
    ) -> None:
        x0, y0, x1, y1 = window
        self.side = max(x1 - x0, y1 - y0)
        self.middle = np.array([0.5 * (x0 + x1), 0.5 * (y0 + y1), 180.0])
        self.unit = np.array([1 / self.side, 1 / self.side, HEIGHT / 360])
        self.azimuth = azimuth
        box = np.array([(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (0.0, 360.0)])
        flat = [self._flat(box, azimuth)[0] for azimuth in np.linspace(*azimuths, 17)]
        low, high = np.min([s.min(axis=0) for s in flat], axis=0), np.max([s.max(axis=0) for s in flat], axis=0)
        # one scale and one place for all azimuths: the box only turns
        self.scale = min(0.8 * width / (high[0] - low[0]), 0.84 * height / (high[1] - low[1]))
        self.offset = 0.5 * np.array([1.0 * width, 1.04 * height]) - 0.5 * self.scale * (low + high)

    def __call__(self, points: ArrayLike) -> tuple[Floats, Floats]:
        """Project points (..., 3), theta in degrees, to places (..., 2) and depths (...)."""
        flat, depth = self._flat(np.asarray(points, dtype=np.float64), self.azimuth)
        return self.offset + self.scale * flat, depth

    def _flat(self, points: Floats, azimuth: float) -> tuple[Floats, Floats]:
        p = (points - self.middle) * self.unit
        c, s, ce, se = math.cos(azimuth), math.sin(azimuth), math.cos(ELEVATION), math.sin(ELEVATION)
        depth = DISTANCE - p @ np.array([ce * c, ce * s, se])
        flat = p @ np.array([[-s, -se * c], [c, -se * s], [0, ce]])
        return flat / depth[..., None], depth
