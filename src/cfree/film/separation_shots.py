"""Shots of a separation: the robot tries to reach its goal, and the separating surface closes around it."""

from __future__ import annotations

import math
from collections.abc import Sequence
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
from cfree.scene.scene import robot_radius

if TYPE_CHECKING:
    from cfree.exact.pose import Pose
    from cfree.forbidden.boundary import Boundary
    from cfree.plot.workspace import Window

SHARES = 0.35, 0.4  # shares of the film in which the robot tries and the surface closes
GLASS = 0.45  # opacity of the surface above the robot's orientation
BESIDE = 0.02  # share of a surface's sides between its ends and the places tried
NAMED = 4  # obstacles named at most: the line ends before the pose in small pictures


def separation_window(answer: Separated, surface: Boundary) -> Window:
    """Return the rectangle around the surface and the start, with room for the robot on all sides."""
    x, y, radius = float(answer.start.x), float(answer.start.y), robot_radius(surface.scene)
    return around([around_surface(surface), (x - radius, y - radius, x + radius, y + radius)])


def separation_shots(
    boundary: Boundary, answer: Separated, window: Window, frames: int, obstacles: Sequence[int], surface: str
) -> list[Shot]:
    """Return three shots: the robot goes as near to the goal as it can, the surface closes, the robot tries elsewhere.

    Parameters
    ----------
    boundary : Boundary
        The boundary in which the robot moves.
    answer : Separated
    window : four floats
        x0, y0, x1, y1, the rectangle shown. All of the robot is in it at the places that it tries to reach.
    frames : int
        Number of moments in all.
    obstacles : sequence of int
        The blocking obstacles, as numbered in the picture; -1 is the bounds, -2 the workspace.
    surface : str
        Describes the shapes whose contacts form the surface, if they are not the scene's.
    """
    free = FreeMotions(boundary, _inner(window, robot_radius(boundary.scene)))
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
    shot = Shot("separation", "", _blocking(obstacles), [], ghost=GLASS, colour=PATH, goal=answer.goal, surface=surface)
    begin = replace(shot, title="The robot tries to get to its goal", note="", surface="")
    return [
        replace(begin, moments=[moments[k] for k in first]),
        replace(shot, title="Contacts close a surface", moments=[moments[k] for k in second], level=level),
        replace(shot, title=_conclusion(answer), moments=[moments[k] for k in third]),
    ]


def _inner(window: Window, radius: float) -> Window:
    """Return the rectangle of the places tried: all of the robot is in the window, and they are not at its sides."""
    x0, y0, x1, y1 = window
    dx, dy = (radius + BESIDE * (side - 2 * radius) for side in (x1 - x0, y1 - y0))
    return x0 + dx, y0 + dy, x1 - dx, y1 - dy


def _conclusion(answer: Separated) -> str:
    if answer.clearance:
        return f"No path of clearance {float(answer.clearance):.4g}: each ends at the surface"
    if answer.of == "interior":
        return "No path of positive clearance: each ends at the surface"
    return "No path: every path ends at the surface"


def _blocking(obstacles: Sequence[int]) -> str:
    """Name the blocking obstacles, whose contacts form the surface."""
    special = {BOUNDS: "the bounds", WORKSPACE: "the workspace"}
    names = [special.get(k) or f"$O_{{{k + 1}}}$" for k in obstacles]
    names[NAMED:] = ["..."] * (len(names) > NAMED)
    return "separated by " + ", ".join(names)
