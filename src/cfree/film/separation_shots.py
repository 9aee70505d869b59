"""Shots of a separation: the robot tries to reach its goal, and the separating surface closes around it."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from cfree.film.contact_motions import Moment
from cfree.film.free_motions import FreeMotions
from cfree.film.storyboard import Shot, eased
from cfree.palette import PATH
from cfree.planning.separation import Separated
from cfree.plot.answer import around_surface
from cfree.plot.boundary import around
from cfree.scene.features import BOUNDS, WORKSPACE

if TYPE_CHECKING:
    from cfree.exact.pose import Pose
    from cfree.forbidden.boundary import Boundary
    from cfree.plot.workspace import Window

SHARES = 0.35, 0.4  # shares of the film in which the robot tries and the surface closes
GLASS = 0.45  # opacity of the surface above the robot's orientation
NAMED = 6  # obstacles named at most


def separation_window(answer: Separated, surface: Boundary) -> Window:
    """Return the rectangle around the surface and the robot's start."""
    x, y = float(answer.start.x), float(answer.start.y)
    return around([around_surface(surface), (x, y, x, y)])


def separation_shots(boundary: Boundary, answer: Separated, window: Window, frames: int) -> list[Shot]:
    """Return three shots: the robot goes as near to the goal as it can, the surface closes, the robot tries elsewhere.

    Parameters
    ----------
    boundary : Boundary
    answer : Separated
        The answer for its scene.
    window : four floats
        x0, y0, x1, y1 around the places that the robot tries to reach.
    frames : int
        Number of moments in all.
    """
    free = FreeMotions(boundary, window)
    places = free.tried(answer.start, answer.goal)
    stops = [answer.start, *places, answer.start]
    paths = [free.path(a, b) for a, b in pairwise(stops)]
    counts = [round(share * frames) for share in SHARES]
    counts.append(frames - sum(counts))
    moments: list[Moment] = []
    for share, path in zip(np.diff(np.rint(np.linspace(0, frames, len(paths) + 1))).astype(int), paths, strict=True):
        rest = moments[-1].pose if moments else answer.start
        poses: list[Pose] = [rest] * int(share) if path is None else free.poses(path, eased(0, 1, int(share)))
        moments.extend(Moment(pose) for pose in poses)
    first, second, third = np.split(np.arange(frames), np.cumsum(counts)[:-1])
    level = np.degrees(eased(0, math.tau, counts[1]))
    shot = Shot("separation", "", _blocking(answer), [], ghost=GLASS, colour=PATH, goal=answer.goal)
    return [
        replace(shot, title="The robot tries to get to its goal", note="", moments=[moments[k] for k in first]),
        replace(shot, title="Contacts close a surface", moments=[moments[k] for k in second], level=level),
        replace(shot, title="No path: every path ends at the surface", moments=[moments[k] for k in third]),
    ]


def _blocking(answer: Separated) -> str:
    """Name the blocking obstacles, whose contacts form the surface."""
    special = {BOUNDS: "the bounds", WORKSPACE: "the workspace"}
    names = [special.get(k) or f"$O_{{{k + 1}}}$" for k in answer.obstacles]
    names[NAMED:] = ["..."] * (len(names) > NAMED)
    return "start and goal are separated by " + ", ".join(names)
