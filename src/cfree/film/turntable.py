"""A boundary that turns once around: all of it, from all sides."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import PolyCollection
from numpy.typing import NDArray

from cfree.film.box import Box
from cfree.film.camera import Camera
from cfree.film.frame import axis_names, image_of, legend, new_frame
from cfree.film.space import FACETS, GHOST, LINE
from cfree.palette import FORBIDDEN, GREY, INK, VIEW
from cfree.plot.boundary import extent, plain
from cfree.plot.depth_sort import paint
from cfree.plot.pieces import WALL, pieces_of

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary

Image = NDArray[np.uint8]

ALL_AROUND = -math.pi, math.pi


class Turntable:
    """Turntable: draws a boundary from any azimuth.

    Parameters
    ----------
    boundary : Boundary
    size : (int, int)
        Width and height in pixels.
    """

    def __init__(self, boundary: Boundary, size: tuple[int, int]) -> None:
        self.figure, height = new_frame(size)
        width, scene = self.figure.get_figwidth(), boundary.scene
        place = 0.0, 0.5 / height, 1.0, 1 - 1.2 / height
        ax: Any = self.figure.add_axes(place)
        self.panel = self.figure.bbox.width * place[2], self.figure.bbox.height * place[3]
        ax.set(xlim=(0, self.panel[0]), ylim=(0, self.panel[1]))
        ax.axis("off")
        self.window = extent(boundary)
        pieces = pieces_of(boundary, self.window, line=LINE, detail=FACETS)
        self.pieces = pieces.chosen(pieces.sort != WALL)
        self.boxes = [Box(ax, self.window, axis_names(scene), quadrant) for quadrant in range(4)]
        self.painting = ax.add_collection(PolyCollection([], zorder=2, joinstyle="round"), autolim=False)
        text: Any = {"va": "center", "color": INK}
        title = plain(scene.name[:40]) or "the boundary of the forbidden space"
        self.figure.text(0.2 / width, 1 - 0.3 / height, title, fontsize=16, weight="bold", **text)
        note = f"{boundary.patch_counts} bound the forbidden space"
        self.figure.text(0.2 / width, 1 - 0.63 / height, note, fontsize=12, **text | {"color": GREY})
        legend(self.figure, boundary, 0.25 / height, 6, {"section at 360°": FORBIDDEN})

    def draw(self, azimuth: float) -> Image:
        """Draw the frame from an azimuth in radians, as (height, width, 3) bytes."""
        camera = Camera(self.window, *self.panel, azimuth, ALL_AROUND)
        quadrant = math.floor(azimuth / (math.pi / 2) + 1) % 4
        for k, box in enumerate(self.boxes):
            box.show(k == quadrant)
        self.boxes[quadrant].draw(camera)
        flat, depth = camera(self.pieces.corners)
        paint(self.painting, self.pieces, flat, depth.mean(axis=1), camera.span, ghost=GHOST)
        return image_of(self.figure)


def turntable_frames(boundary: Boundary, frames: int, size: tuple[int, int]) -> Iterator[Image]:
    """Yield the frames of one turn, from the usual view back to it."""
    table = Turntable(boundary, size)
    for k in range(frames):
        yield table.draw(math.radians(VIEW[1]) + math.tau * k / frames)
