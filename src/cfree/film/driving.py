"""A vehicle in films: its wheels, the track of its axle point so far, and changes of direction so far."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.collections import LineCollection

from cfree.exact.pose import Pose
from cfree.plot.gears import GEARS, DrawnWheels, Gears, draw_marks


class DrawnDriving:
    """Artists of a vehicle on its path, on axes of the plane.

    Parameters
    ----------
    ax : matplotlib axes
    gears : Gears
        The path.
    """

    def __init__(self, ax: Any, gears: Gears) -> None:
        self.gears = gears
        self.wheels = DrawnWheels(ax, gears.wheels, 5.2)
        lines = (("white", 4.0), (None, 2.6))
        self.tracks = [
            ax.add_collection(
                LineCollection([], colors=colour, linewidths=width, capstyle="round", zorder=5.4), autolim=False
            )
            for colour, width in lines
        ]
        self.spots, self.dots = draw_marks(ax, gears)
        for marks in (self.spots, self.dots):
            marks.set_zorder(5.6)

    def draw(self, travel: float, pose: Pose) -> None:
        """Draw the vehicle in a pose of its path, after some travel of the robot."""
        gears = self.gears
        part = int(gears.part_at(np.array([travel]))[0])
        tracks = gears.tracks_until(travel)
        for lines in self.tracks:
            lines.set_segments(tracks)
        self.tracks[1].set_color([GEARS[part.gear][0] for part in gears.parts[: len(tracks)]])
        self.dots.set_data(*gears.dots[: sum(k <= part for k in gears.changes)].T)
        turns = sum(part.gear == "turning" for part in gears.parts[: part + 1])
        self.spots.set_data(*gears.spots[:turns].T)
        self.wheels.place(pose, gears.parts[part].curvature if gears.parts else 0.0)

    def show(self, *, visible: bool) -> None:
        """Show or hide all artists."""
        for artist in (*self.tracks, self.spots, self.dots, self.wheels.axles, self.wheels.shapes):
            artist.set_visible(visible)
